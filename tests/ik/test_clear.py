"""Solutions in a cell: free as Coal says, the nearest to the seed, and none only where all are in contact."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.collision.cell import Cell, cell_in
from gelenk.collision.contact.judge import ContactJudge
from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import find_bodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.errors import CertificationFailed
from gelenk.ik.clear import NEAR, _of_self_motion
from gelenk.ik.search.bounds import target_rows
from gelenk.ik.search.problem import Objective, Options, TargetProblem
from gelenk.ik.search.restarts import solutions_from
from gelenk.ik.search.task import Task
from gelenk.ik.solve import solve
from gelenk.kinematics.judge import judge
from gelenk.kinematics.judge.placements import walk_to
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.ik.arms import UR5, draw, middle, poses, table_arm

SEVEN = [
    (0.0, -np.pi / 2, 0.33, 0.0),
    (0.0, np.pi / 2, 0.0, 0.0),
    (0.08, np.pi / 2, 0.32, 0.0),
    (-0.08, -np.pi / 2, 0.0, 0.0),
    (0.0, np.pi / 2, 0.38, 0.0),
    (0.09, np.pi / 2, 0.0, 0.0),
    (0.0, 0.0, 0.1, 0.0),
]
"""An arm without a closed form, of the Panda's proportions."""


def cell_of(arm: tuple[RobotModel, Chain], boxes: int = 8, min_clearance: float = 0.0) -> Cell:
    """Return an arm among boxes; its root is a link of the world."""
    rng, obstacles = np.random.default_rng(3), []
    for i in range(boxes):
        T, angle = np.eye(4), 2.0 * np.pi * i / boxes
        T[:3, 3] = 0.55 * np.cos(angle), 0.55 * np.sin(angle), rng.uniform(0.0, 0.6)
        root = arm[0].description.root
        obstacles.append(Obstacle(f"box {i}", (covered_body(f"box {i}", root, "box", (0.15, 0.15, 0.3), T),)))
    own = find_bodies(arm[0].description, lambda _: None, has_own=False)
    if len(arm[1]) == len(SEVEN):  # Its drawn links overlap.
        own = replace(own, pairs=())
    return cell_in(build_world(*arm, own, tuple(obstacles)), min_clearance)


def free_by_coal(cell: Cell, qs: Array) -> Flags:
    """Return whether Coal finds every pair apart by more than its margin."""
    judge = ContactJudge(cell.world)
    return np.array([judge.least_slack(judge.poses(q), 0.01)[0] > 0.0 for q in qs], dtype=bool)


def asked(arm: tuple[RobotModel, Chain], count: int, **options: object) -> TargetProblem:
    """Return targets that the arm reaches, if perhaps not without contact."""
    robot, chain = arm
    return TargetProblem(robot, chain, poses(robot, chain, draw(chain, count)), middle(chain), Options(**options))  # type: ignore[arg-type]


def nearest(qs: Array, seed: Array) -> float:
    return float(np.linalg.norm(qs - seed, axis=1).min())


@pytest.mark.slow
@pytest.mark.parametrize("min_clearance", [0.0, 0.03])
def test_of_all_branches_the_nearest_free_one_is_the_answer(min_clearance: float) -> None:
    arm = table_arm(UR5)
    cell, problem = cell_of(arm, min_clearance=min_clearance), asked(arm, 40)
    every, one = solve(replace(problem, options=Options(every=True))), solve(problem, cell)
    assert len(one.failures) >= 2
    assert (solve(problem).qs[np.diff(one.firsts) > 0] != one.qs).any()
    for i, status in enumerate(one.statuses):
        branches = every.qs[every.firsts[i] : every.firsts[i + 1]]
        free = branches[free_by_coal(cell, branches)]
        assert (status == "solved") == bool(len(free))
        if status == "solved":
            own = one.qs[one.firsts[i] : one.firsts[i + 1]]
            assert nearest(own, problem.seeds[0]) == pytest.approx(nearest(free, problem.seeds[0]), abs=1e-6)
        else:
            assert one.failures[i].status == "in_collision"
            assert one.failures[i].reason.startswith(f"all {len(branches)} solutions are in contact")
            assert np.abs(branches - one.failures[i].nearest).max(axis=1).min() <= 1e-6


def test_all_branches_are_told_apart_the_free_ones_first() -> None:
    arm = table_arm(UR5)
    cell, problem = cell_of(arm), asked(arm, 12, every=True)
    here, there = solve(problem, cell), solve(problem)
    assert here.touching is not None
    np.testing.assert_array_equal(here.touching, ~free_by_coal(cell, here.qs))
    np.testing.assert_array_equal(here.firsts, there.firsts)
    for i, status in enumerate(here.statuses):
        rows = slice(here.firsts[i], here.firsts[i + 1])
        assert status == ("in_collision" if here.touching[rows].all() else "solved")
        assert (np.diff(here.touching[rows].astype(int)) >= 0).all()
        np.testing.assert_array_equal(np.sort(here.qs[rows], axis=0), np.sort(there.qs[rows], axis=0))
    assert here.complete == there.complete
    assert {"in_collision", "solved"} == set(here.statuses)


def test_a_self_motion_is_left_in_contact_only_if_all_of_it_is() -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 40)
    plain, one = solve(problem), solve(problem, cell)
    assert (~free_by_coal(cell, plain.qs)).sum() > 2 * len(one.failures) > 0
    assert free_by_coal(cell, one.qs).all()
    assert max(one.position_errors.max(), one.orientation_errors.max()) <= 1e-6
    for i in one.failures:
        target, base = target_rows(problem.target(i)), problem.seeds
        goal = replace(problem, options=Options(random_seed=7)).goal(600)
        others, _ = solutions_from(arm[1].flat, goal, target, base, base, NEAR + 1, NEAR)
        assert len(others) > 100
        assert cell.touching(others).all()


@pytest.mark.slow
@pytest.mark.parametrize(("away", "first", "last"), [(0.2, 1, NEAR + 1), (2.0, NEAR + 1, 2 * NEAR + 2)])
def test_of_a_round_of_starts_the_nearest_free_solution_counts(away: float, first: int, last: int) -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 24)
    plain = solve(problem)
    problem.seeds = plain.qs + away
    one = _of_self_motion(problem, cell, plain.qs)
    some, owners = solutions_from(
        arm[1].flat, problem.goal(last), target_rows(problem.targets), plain.qs, problem.seeds, first, NEAR
    )
    is_free = free_by_coal(cell, some)
    found = np.unique(owners[is_free])
    assert len(found) >= 6
    for i in found:
        q, seed = one.qs[one.firsts[i]], problem.seed(i)
        assert one.restarts[one.firsts[i]] == first
        assert nearest(q[None], seed) == nearest(some[is_free & (owners == i)], seed)


@pytest.mark.slow
def test_starts_lead_to_the_same_solutions_alone_and_among_others() -> None:
    robot, chain = table_arm(SEVEN, "RRRRRRR")
    problem, starts = asked((robot, chain), 11), (1, NEAR)
    rows, bases = target_rows(problem.targets), draw(chain, 11)
    qs, owners = solutions_from(chain.flat, problem.goal(20), rows, bases, problem.seeds, *starts)
    alone = [
        solutions_from(chain.flat, problem.goal(20), rows[i : i + 1], bases[i : i + 1], problem.seeds, *starts)[0]
        for i in range(11)
    ]
    np.testing.assert_array_equal(owners, np.repeat(np.arange(11), [len(some) for some in alone]))
    np.testing.assert_array_equal(qs, np.concatenate(alone))
    poses_found = chain_poses(chain.flat, qs)
    np.testing.assert_allclose(poses_found[0], problem.targets.positions[owners], atol=1e-6)
    np.testing.assert_allclose(poses_found[1], problem.targets.rotations[owners], atol=1e-6)


@pytest.mark.slow
def test_a_method_from_one_start_says_that_its_end_is_in_contact() -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 40, method="damped_least_squares")
    plain, here = solve(problem), solve(problem, cell)
    reached = [i for i, status in enumerate(plain.statuses) if status == "solved"]
    free = dict(zip(reached, free_by_coal(cell, plain.qs).tolist(), strict=True))
    assert not all(free.values())
    for i, is_free in free.items():
        assert here.statuses[i] == ("solved" if is_free else "in_collision")
    assert [here.statuses[i] for i in range(40) if i not in free] == [
        plain.statuses[i] for i in range(40) if i not in free
    ]


@pytest.mark.parametrize("every", [False, True])
def test_an_answer_of_several_stages_is_compared_with_pinocchio_once(
    every: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 4, every=every, most=5)
    problem.targets.positions[3] += 5.0
    compared, compare = [], judge.poses_at

    def comparing(robot: RobotModel, chain: Chain, frame: str, full_qs: Array) -> Poses:
        if len(full_qs):
            compared.append(full_qs)
        return compare(robot, chain, frame, full_qs)

    monkeypatch.setattr(judge, "poses_at", comparing)
    found = solve(problem, cell)
    assert 3 in found.failures
    nearest = [failure.nearest for failure in found.failures.values()]
    np.testing.assert_array_equal(compared[0], np.vstack((found.qs, *nearest)))
    assert every or len(compared) == 1, "families of solutions are compared apart"
    wrong = walk_to(arm[0], arm[1].tip_frame).copy()
    wrong[-1, 1] += 1e-8
    monkeypatch.setattr(judge, "walk_to", lambda _, frame: wrong if frame == arm[1].tip_frame else walk_to(_, frame))
    with pytest.raises(CertificationFailed, match="position"):
        solve(problem, cell)


@pytest.mark.slow
def test_what_is_out_of_reach_stays_so_and_joints_may_be_held() -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 12)
    problem.targets.positions[3] += 5.0
    assert solve(problem, cell).statuses[3] == "unreachable"
    held = replace(problem, options=Options(fixed_joints={arm[1].joint_names[6]: 0.3}))
    found = solve(held, cell)
    assert (found.qs[:, 6] == 0.3).all()
    assert free_by_coal(cell, found.qs).all()


@pytest.mark.slow
def test_an_objective_moves_no_solution_into_contact() -> None:
    arm = table_arm(UR5)
    cell = cell_of(arm)
    problem = asked(arm, 30, task=Task(("x", "y", "z")), objective=Objective("posture"))
    here, plain = solve(problem, cell), solve(problem)
    assert free_by_coal(cell, here.qs).all()
    assert not free_by_coal(cell, plain.qs).all()
    assert here.statuses.count("solved") >= 25
    assert (
        np.linalg.norm(here.qs - problem.seeds, axis=1).mean()
        < 1.5 * np.linalg.norm(plain.qs - problem.seeds, axis=1).mean()
    )


@pytest.mark.slow
def test_the_objective_clearance_moves_away_from_contact() -> None:
    arm = table_arm(SEVEN, "RRRRRRR")
    cell, problem = cell_of(arm), asked(arm, 12)
    plain = solve(problem, cell)
    here = solve(replace(problem, options=Options(objective=Objective("clearance"))), cell)
    before, after = cell.nearest(plain.qs).clearances, cell.nearest(here.qs).clearances
    assert (after >= before - 1e-3).all()
    assert (after - before).max() > 0.01
    assert max(here.position_errors.max(), here.orientation_errors.max()) <= 1e-6
    # No small step along the self-motion does better.
    q, target = here.qs, problem.taken(here.owners)
    for size in (0.01, -0.01):
        _, Js = zip(*(target.linearised(i, q[i : i + 1]) for i in range(len(q))), strict=True)
        spare = np.array([np.linalg.svd(J[0])[2][-1] for J in Js])
        inside = (np.abs(q + size * spare) < np.pi).all(axis=1)
        assert (cell.nearest(q + size * spare).clearances <= after + 1e-3)[inside].mean() >= 0.8
