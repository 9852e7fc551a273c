"""The search of many starts: the same answers whatever else is asked, everything solved, the near solution first."""

import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.errors import CertificationFailed
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search.retrace import retrace
from gelenk.ik.search.search import Found, start_of
from gelenk.ik.search.task import Task
from gelenk.ik.solve import Options, inverse_kinematics, solve, solve_quickly
from gelenk.ik.verdict.result import COLUMNS
from gelenk.kinematics.judge import judge, own_pose
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.ik.arms import (
    DECOUPLED,
    IRB,
    SINGLES,
    TASKS,
    UR5,
    angles,
    assert_solved,
    catalogue_arm,
    distances,
    draw,
    inside,
    limited,
    middle,
    moved,
    part,
    poses,
    problem,
    repeated,
    same_turn,
    search,
    table_arm,
)
from tests.oracles import catalogue
from tests.robots import of_table, robot, rows, swept

CHAINS = {
    "six joints": ("ur5", None, None),
    "seven joints": ("panda", None, None),
    "five joints": ("so100", None, None),
    "four joints, one sliding": ("scara", None, None),
    "eight joints, one sliding": ("tiago", None, None),
    "continuous joints": ("kinova", None, None),
    "followers": ("pr2", "base_footprint", "l_gripper_tool_frame"),
    "a follower of two": ("talos_full", "torso_2_link", "gripper_left_fingertip_1_link"),
    "from hand to hand": ("baxter", "left_gripper", "right_gripper"),
    "up the tree": ("talos", "arm_left_7_link", "base_link"),
    "up from a finger": ("panda", "panda_rightfinger", "panda_link5"),
    "tip to base": ("panda", "panda_hand_tcp", "panda_link0"),
}
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)

GEARED = """<robot name="geared"><link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<joint name="turn" type="{type}"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>{limit}</joint>
<joint name="follow" type="{type}"><parent link="a"/><child link="b"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/>
{limit}<mimic joint="turn" multiplier="{gear}" offset="0.2"/></joint>
<joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0.1 0.2 0"/><axis xyz="1 0 0"/>
<limit lower="-0.1" upper="0.5" effort="1" velocity="1"/></joint>
<joint name="last" type="continuous"><parent link="c"/><child link="d"/><origin xyz="0 0 0.2"/><axis xyz="0 0 1"/>
</joint></robot>"""
LIMIT = '<limit lower="-2.5" upper="2.8" effort="1" velocity="1"/>'


def chain_of(ends: tuple[str, str | None, str | None]) -> tuple[RobotModel, Chain]:
    """A robot and one of its chains."""
    machine = robot(ends[0])
    return machine, machine.chain(ends[1], ends[2])


def geared(type_: str, gear: float) -> tuple[RobotModel, Chain]:
    """An arm whose second joint follows its first."""
    text = GEARED.format(type=type_, gear=gear, limit=LIMIT if type_ == "revolute" else "")
    machine = RobotModel(read_urdf(text), ("base", "d"))
    return machine, machine.chain(None, None)


def random_arm(count: int, seed: int) -> tuple[RobotModel, Chain]:
    """A chain of turning and sliding joints, every fourth of them sliding on average."""
    rng = np.random.default_rng(seed)
    types = "".join(rng.choice(["R", "P"], size=count, p=[0.75, 0.25]))
    twists = rng.choice([0.0, np.pi / 2, -np.pi / 2, 0.7], size=count)
    parameters = [
        (float(a), float(alpha), float(d), float(theta))
        for a, alpha, d, theta in zip(
            rng.uniform(-0.5, 0.5, count),
            twists,
            rng.uniform(-0.4, 0.4, count),
            rng.uniform(-3.0, 3.0, count),
            strict=True,
        )
    ]
    machine = of_table(rows("modified" if seed % 2 else "standard", parameters, types))
    return machine, machine.chain(None, None)


def same(found: Found, other: Found, order: Sequence[int] | Indices | None = None) -> bool:
    """Whether two answers are equal to the last bit, the second in another order."""
    rows = np.arange(len(found.qs)) if order is None else np.asarray(order)
    return all(
        np.array_equal(getattr(found, name)[rows], getattr(other, name))
        for name in ("qs", "solved", "restarts", "iterations")
    )


# The same whatever else is asked


@pytest.mark.quick(6)
@every_chain
@pytest.mark.parametrize("task", ["full", "position", "free about z", "free about x"])
def test_an_answer_does_not_depend_on_its_batch(ends: tuple[str, str | None, str | None], task: str) -> None:
    machine, chain = chain_of(ends)
    count = 600
    targets, seeds = poses(machine, chain, draw(chain, count)), draw(chain, count, seed=5)
    together = search(chain, targets, seeds, task=TASKS[task])
    assert together.solved.all()
    for threads in (1, 2, 3):
        assert same(together, search(chain, targets, seeds, task=TASKS[task], threads=threads))
    order = np.random.default_rng(3).permutation(count)
    assert same(together, search(chain, part(targets, order), seeds[order], task=TASKS[task]), order)
    for size in (1, 2, 7, 8, 9, 15, 16, 17, 31):
        some = np.arange(count - size, count)
        assert same(together, search(chain, part(targets, some), seeds[some], task=TASKS[task]), some)
    for i in range(120):
        assert same(together, search(chain, part(targets, slice(i, i + 1)), seeds[i : i + 1], task=TASKS[task]), [i])


def test_hopeless_targets_do_not_disturb_others_nor_each_other() -> None:
    machine, chain = catalogue_arm("so100")
    targets = poses(machine, chain, draw(chain, 64))
    targets = moved(
        targets, np.zeros((64, 3)), np.random.default_rng(1).normal(size=(64, 3)) * (np.arange(64) % 3 == 0)[:, None]
    )
    together = search(chain, targets, middle(chain))
    assert 40 <= together.solved.sum() < 64
    for i in range(64):
        assert same(together, search(chain, part(targets, slice(i, i + 1)), middle(chain)), [i])


@pytest.mark.parametrize("budget", [1, 20, 40, 100, 160, 200])
def test_a_small_budget_gives_the_same_in_a_batch_and_alone(budget: int) -> None:
    machine, chain = catalogue_arm("panda")
    targets = poses(machine, chain, draw(chain, 40))
    together = search(chain, targets, middle(chain), max_iterations=budget)
    for i in range(40):
        assert same(together, search(chain, part(targets, slice(i, i + 1)), middle(chain), max_iterations=budget), [i])


def test_one_seed_for_all_is_the_same_as_one_each() -> None:
    machine, chain = catalogue_arm("ur5")
    targets = poses(machine, chain, draw(chain, 300))
    assert same(search(chain, targets, middle(chain)), search(chain, targets, np.repeat(middle(chain), 300, axis=0)))


def test_the_random_seed_decides_the_starts_and_nothing_else_does() -> None:
    machine, chain = catalogue_arm("puma560")
    targets = poses(machine, chain, draw(chain, 200))
    first = search(chain, targets, middle(chain), random_seed=7)
    assert same(first, search(chain, targets, middle(chain), random_seed=7))
    other = search(chain, targets, middle(chain), random_seed=8)
    again = first.restarts > 0
    assert again.sum() > 10
    # What the seed itself solves is the same whatever the other starts are.
    np.testing.assert_array_equal(first.qs[~again], other.qs[~again])
    assert (np.abs(first.qs[again] - other.qs[again]).max(axis=1) > 1e-3).sum() > 0.5 * again.sum()


def test_starts_are_spread_over_the_limits_as_the_mixing_function_says() -> None:
    _, chain = catalogue_arm("panda")
    mask = (1 << 64) - 1

    def uniform(random_seed: int, start: int, variable: int) -> float:
        z = random_seed * 0xD1342543DE82EF95 + start * 0x9E3779B97F4A7C15 + variable * 0xBF58476D1CE4E5B9 & mask
        for factor in (0xBF58476D1CE4E5B9, 0x94D049BB133111EB):
            z = (z ^ (z >> 30)) * factor & mask
        return ((z ^ (z >> 31)) >> 11) * 2.0**-53

    nowhere = Poses(np.zeros((1, 3)), np.eye(3)[None])
    own = problem(chain, nowhere, np.zeros((1, 7)), random_seed=5)
    starts = np.array([start_of(own, 0, start) for start in range(1, 2000)])
    shares = (starts - chain.lower) / (chain.upper - chain.lower)
    for start in (1, 2, 77, 1999):
        np.testing.assert_allclose(shares[start - 1], [uniform(5, start, j) for j in range(7)], atol=1e-12)
    # Evenly spread, and no two variables alike.
    quarters = np.array([np.histogram(column, bins=4, range=(0.0, 1.0))[0] for column in shares.T])
    assert np.abs(quarters - 500).max() < 80
    assert np.abs(np.corrcoef(shares.T) - np.eye(7)).max() < 0.1


# One start


def followed(machine: RobotModel, chain: Chain, target: Poses, start: Array, task: Task, count: int) -> list[Array]:
    """The damped descent of one start in plain NumPy: poses by Pinocchio, Jacobians by differences of them."""
    sequence = [start]
    weights = [i for i, direction in enumerate(SINGLES) if direction in task.directions]
    for _ in range(count):
        q = sequence[-1]
        step = 1e-6
        around = poses(machine, chain, np.concatenate((q[None], q + step * np.eye(len(q)), q - step * np.eye(len(q)))))
        n = len(q)
        turns = Rotation.from_matrix(
            around.rotations[1 : n + 1] @ around.rotations[n + 1 :].transpose(0, 2, 1)
        ).as_rotvec()
        J = np.concatenate((around.positions[1 : n + 1] - around.positions[n + 1 :], turns), axis=1).T / (2 * step)
        w = Rotation.from_matrix(target.rotations[0] @ around.rotations[0].T).as_rotvec()
        angle = np.linalg.norm(w)
        w *= 2.0 * np.sin(angle / 2) / angle if angle > 0.0 else 1.0
        e = np.concatenate((target.positions[0] - around.positions[0], w))[weights]
        J = J[weights]
        slope = J.T @ e
        free = ~(((q <= chain.lower) & (slope < 0.0)) | ((q >= chain.upper) & (slope > 0.0)))
        J = J * free
        step_q = np.linalg.solve(J.T @ J + (0.05 * e @ e + 1e-10) * np.eye(n), J.T @ e)
        step_q /= max(1.0, np.abs(step_q).max())
        sequence.append(np.clip(q + step_q, chain.lower, chain.upper))
    return sequence


@pytest.mark.parametrize("name", ["panda", "z1", "puma560", "stanford", "planar_3r"])
@pytest.mark.parametrize("task", ["full", "position"])
def test_a_start_goes_where_the_damped_steps_lead(name: str, task: str) -> None:
    machine, chain = catalogue_arm(name)
    # Only joints that cannot turn freely, so that nothing is turned back at the end.
    chain = limited(chain, np.maximum(chain.lower, -3.0), np.minimum(chain.upper, 3.0))
    targets = poses(machine, chain, draw(chain, 20))
    found = search(chain, targets, middle(chain), task=TASKS[task])
    compared = 0
    for i in np.flatnonzero(found.iterations <= 14)[:8]:
        start = start_of(problem(chain, targets, middle(chain)), i, int(found.restarts[i]))
        sequence = followed(
            machine, chain, part(targets, slice(i, i + 1)), start, TASKS[task], int(found.iterations[i]) - 1
        )
        np.testing.assert_allclose(found.qs[i], sequence[-1], atol=2e-7)
        compared += 1
    assert compared >= 4


@pytest.mark.quick(2)
@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize("name", ["panda", "ur5", "puma560", "so100", "stanford", "kinova"])
def test_the_steps_can_be_retraced_one_by_one(name: str, task: str) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 60))
    found = search(chain, targets, middle(chain), task=TASKS[task])
    compared = 0
    for i in range(60):
        if found.followed[i] >= 0:
            continue
        tight = problem(
            chain, targets, middle(chain), task=TASKS[task], position_tolerance=1e-15, orientation_tolerance=1e-15
        )
        start = start_of(tight, i, int(found.restarts[i]))
        descent = retrace(tight, i, start, int(found.followed[i]))
        steps = int(found.iterations[i]) - 1
        assert descent.trace is not None
        if steps < len(descent.trace):
            step_by_step = descent.trace[steps].joint_positions
            np.testing.assert_allclose(same_turn(found.qs[i] - step_by_step), 0.0, atol=1e-6)
            compared += 1
    assert compared >= 30


@pytest.mark.parametrize("name", ["panda", "ur5", "so100"])
def test_quick_answers_are_the_same_answers(name: str) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 60))
    closed_form(chain)  # what is not looked at yet takes too long for a quick answer
    given_up = 0
    for i in range(60):
        target = part(targets, slice(i, i + 1))
        few = solve_quickly(replace(problem(chain, target, middle(chain)), robot=machine), 8)
        answer = inverse_kinematics(machine, chain, target, middle(chain), Options())
        if few is None:
            given_up += 1
            assert answer.restarts[0] >= 8
            continue
        assert few.statuses == answer.statuses == ["solved"]
        for column in COLUMNS:
            np.testing.assert_array_equal(getattr(few, column), getattr(answer, column))
    assert given_up < 20
    away = moved(part(targets, slice(0, 2)), np.array([[0.0] * 3, [9.0] * 3]), np.zeros((2, 3)))
    assert solve_quickly(replace(problem(chain, away, middle(chain)), robot=machine), 8) is None


@pytest.mark.parametrize("quantity", ["position", "orientation"])
def test_an_answer_that_pinocchios_own_poses_deny_is_withheld(quantity: str, monkeypatch: pytest.MonkeyPatch) -> None:
    machine, chain = catalogue_arm("panda")
    asked = replace(problem(chain, poses(machine, chain, draw(chain, 3)), middle(chain)), robot=machine)
    closed_form(chain)
    found = solve_quickly(asked, 1000)
    assert found is not None
    assert found.verdicts == {"solved": 3}
    poses_at = judge.poses_at

    def away(own: Poses) -> Poses:
        return moved(own, *(np.full((len(own), 3), 1e-6 * (name == quantity)) for name in ("position", "orientation")))

    def denied(position: Array, rotation: Array, *own: Array) -> tuple[float, float, float]:
        others = away(Poses(*own))
        return pose_errors(position, rotation, others.positions, others.rotations)

    monkeypatch.setattr(judge, "poses_at", lambda *ends: away(poses_at(*ends)))
    monkeypatch.setattr(own_pose, "pose_errors", denied)
    for solver in (solve, lambda asked: solve_quickly(asked, 1000)):
        with pytest.raises(CertificationFailed, match=quantity):
            solver(asked)


@pytest.mark.slow
def test_a_service_that_is_ready_has_loaded_the_kernels_of_quick_answers() -> None:
    code = """
from gelenk.kinematics.warm_up import quick
quick()
from gelenk.ik.quick import _searched
from gelenk.robot.notations import pose_errors, turn_by_quaternions_xyzw
print(*(len(kernel.signatures) for kernel in (_searched, pose_errors, turn_by_quaternions_xyzw)))
"""
    ran = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert ran.stdout.split() == ["1", "2", "1"]  # poses are compared with copies, or where Pinocchio leaves its own


# Everything is solved


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_every_robot_reaches_what_it_can_reach(name: str) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 100, seed=11))
    assert len(chain) > 0
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options())
    assert_solved(machine, chain, targets, answer)


@every_chain
def test_every_kind_of_chain_reaches_what_it_can_reach(ends: tuple[str, str | None, str | None]) -> None:
    machine, chain = chain_of(ends)
    targets = poses(machine, chain, draw(chain, 100, seed=12))
    assert_solved(machine, chain, targets, inverse_kinematics(machine, chain, targets, middle(chain), Options()))


@pytest.mark.parametrize("task", [*TASKS.values(), *(Task((single,)) for single in SINGLES)], ids=str)
@pytest.mark.parametrize("name", ["ur5", "so100", "panda"])
def test_every_kind_of_task_is_solved(name: str, task: Task) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 100, seed=13))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(task=task))
    assert answer.statuses == ["solved"] * 100
    assert inside(chain, answer.qs).all()
    reached = poses(machine, chain, answer.qs)
    linear = [i for i, direction in enumerate("xyz") if direction in task.directions]
    assert np.abs((targets.positions - reached.positions)[:, linear]).max(initial=0.0) < 1e-6
    turns = Rotation.from_matrix(targets.rotations.transpose(0, 2, 1) @ reached.rotations).as_rotvec()
    angular = [i for i, direction in enumerate(("rx", "ry", "rz")) if direction in task.directions]
    if len(angular) == 2:
        axis = ({0, 1, 2} - set(angular)).pop()
        chords = np.linalg.norm(targets.rotations[:, :, axis] - reached.rotations[:, :, axis], axis=1)
        assert chords.max() < 1e-6
    else:
        assert np.abs(turns[:, angular]).max(initial=0.0) < 1e-6


@pytest.mark.quick(4)
@pytest.mark.parametrize("count", [*range(1, 11), 12, 15, 20])
def test_chains_of_any_length(count: int) -> None:
    for seed in range(3):
        machine, chain = random_arm(count, 100 * count + seed)
        targets = poses(machine, chain, draw(chain, 40))
        answer = inverse_kinematics(machine, chain, targets, middle(chain) + 0.1, Options())
        assert_solved(machine, chain, targets, answer)


@pytest.mark.parametrize("gear", [1.0, -1.0, 2.0, 0.5, -1.7, 0.25, 3.3])
@pytest.mark.parametrize("type_", ["revolute", "continuous"])
def test_geared_followers(type_: str, gear: float) -> None:
    machine, chain = geared(type_, gear)
    assert len(chain) == 3
    assert len(chain.flat.joints) == 4
    targets = poses(machine, chain, draw(chain, 60))
    assert_solved(machine, chain, targets, inverse_kinematics(machine, chain, targets, middle(chain), Options()))


@pytest.mark.parametrize("name", ["panda", "ur5", "kinova", "scara"])
def test_without_limits_too(name: str) -> None:
    machine, chain = catalogue_arm(name)
    qs = np.random.default_rng(3).uniform(-9.0, 9.0, (100, len(chain)))
    targets = poses(machine, chain, qs)
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(respect_limits=False))
    assert answer.statuses == ["solved"] * 100
    assert distances(targets, poses(machine, chain, answer.qs)).max() < 1e-6


def test_no_targets_and_no_joints() -> None:
    machine, chain = catalogue_arm("ur5")
    none = Poses(np.empty((0, 3)), np.empty((0, 3, 3)))
    for options in (Options(), Options(every=True), Options(method="newton"), Options(trace=True, time_limit=1.0)):
        answer = inverse_kinematics(machine, chain, none, middle(chain), options)
        assert len(answer) == 0
        assert answer.qs.shape == (0, 6)
        assert answer.firsts.tolist() == [0]
    rigid = machine.chain("wrist_3_link", "tool0")
    target = poses(machine, rigid, np.zeros((1, 0)))
    for options in (Options(), Options(every=True), Options(method="newton"), Options(method="gradient")):
        assert inverse_kinematics(machine, rigid, target, np.zeros((1, 0)), options).statuses == ["solved"]
        away = inverse_kinematics(
            machine, rigid, moved(target, np.ones((1, 3)), np.zeros((1, 3))), np.zeros((1, 0)), options
        )
        assert away.statuses != ["solved"]
        assert away.failures[0].position_error == pytest.approx(np.sqrt(3.0))


def test_a_hundred_thousand_targets() -> None:
    machine, chain = catalogue_arm("ur5")
    qs = draw(chain, 100_000)
    targets = repeated(poses(machine, chain, qs[:1000]), 100)
    began = time.monotonic()
    found = search(chain, targets, middle(chain))
    assert time.monotonic() - began < 30.0
    assert found.solved.all()
    np.testing.assert_array_equal(found.qs.reshape(1000, 100, 6), np.repeat(found.qs[::100, None], 100, axis=1))
    reached = poses(machine, chain, found.qs[::100])
    assert distances(part(targets, slice(None, None, 100)), reached).max() < 1e-6
    assert angles(part(targets, slice(None, None, 100)), reached).max() < 1e-6


# Limits and seeds


@pytest.mark.parametrize("name", ["ur5", "xarm7", "kinova", "anthropomorphic_wrist", "iris", "scara"])
@pytest.mark.parametrize("turns", [0.0, 1.0, -3.0, 1e3])
def test_solutions_are_turned_into_the_limits_and_near_to_the_seed(name: str, turns: float) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 100))
    seed = middle(chain) + 2.0 * np.pi * turns
    found = search(chain, targets, seed)
    assert found.solved.all()
    assert inside(chain, found.qs, 0.0).all()
    slides = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    for j in set(range(len(chain))) - slides:
        for way in (-2.0 * np.pi, 2.0 * np.pi):
            turned = found.qs[:, j] + way
            nearer = np.abs(turned - seed[0, j]) < np.abs(found.qs[:, j] - seed[0, j]) - 1e-9
            allowed = (turned >= chain.lower[j]) & (turned <= chain.upper[j])
            assert not (nearer & allowed).any()


@pytest.mark.parametrize("seed", [10.0, -2e3 * np.pi, 1e5, 1e6])
@pytest.mark.parametrize("name", ["panda", "ur5", "puma560", "scara"])
def test_a_seed_far_outside_the_limits_does_no_harm(name: str, seed: float) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 50))
    seeds = np.full((1, len(chain)), seed)
    assert_solved(machine, chain, targets, inverse_kinematics(machine, chain, targets, seeds, Options()))
    free = inverse_kinematics(machine, chain, targets, seeds, Options(respect_limits=False))
    assert free.statuses == ["solved"] * 50
    slides = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    turning = [j for j in range(len(chain)) if j not in slides]
    assert np.abs(free.qs[:, turning] - seed).max() <= np.pi + 1e-9


def test_joints_without_any_room_stay_where_they_are() -> None:
    machine, chain = catalogue_arm("panda")
    qs = draw(chain, 60)
    for j in range(7):
        lower, upper = chain.lower.copy(), chain.upper.copy()
        lower[j] = upper[j] = qs[0, j]
        narrow = limited(chain, lower, upper)
        qs[:, j] = qs[0, j]
        targets = poses(machine, narrow, qs)
        answer = inverse_kinematics(machine, narrow, targets, middle(narrow), Options())
        assert_solved(machine, narrow, targets, answer)
        np.testing.assert_array_equal(answer.qs[:, j], qs[0, j])
        qs = draw(chain, 60)


def test_an_arm_without_any_room_reaches_one_pose() -> None:
    machine, chain = catalogue_arm("panda")
    q = draw(chain, 1)[0]
    fixed = limited(chain, q, q)
    targets = poses(machine, chain, np.array([q, q + 0.01]))
    answer = inverse_kinematics(machine, fixed, targets, np.zeros((1, 7)), Options())
    assert answer.statuses == ["solved", "outside_limits"]
    np.testing.assert_array_equal(answer.qs, q[None])
    np.testing.assert_array_equal(answer.failures[1].nearest, q)


def test_solutions_at_limits_are_found() -> None:
    for name in ("panda", "puma560", "z1"):
        machine, chain = catalogue_arm(name)
        rng = np.random.default_rng(17)
        qs = draw(chain, 60)
        ends = np.where(rng.random(qs.shape) < 0.5, chain.lower, chain.upper)
        qs = np.where(rng.random(qs.shape) < 0.4, ends, qs)
        targets = poses(machine, chain, qs)
        assert_solved(machine, chain, targets, inverse_kinematics(machine, chain, targets, middle(chain), Options()))


# Near the seed


ARMS = ("ur5", "puma560", "anthropomorphic_wrist", "kinova", "stanford", "panda", "xarm7", "talos", "pr2")


@pytest.mark.parametrize("name", ARMS)
def test_a_small_step_of_the_joints_is_answered_by_a_small_step(name: str) -> None:
    machine, chain = catalogue_arm(name)
    seeds = draw(chain, 1000)
    steps = np.random.default_rng(2).normal(size=seeds.shape)
    for size in (0.003, 0.01, 0.03):
        wanted = np.clip(seeds + size * steps / np.linalg.norm(steps, axis=1)[:, None], chain.lower, chain.upper)
        targets = poses(machine, chain, wanted)
        found = search(chain, targets, seeds)
        assert found.solved.all()
        far = np.abs(found.qs - seeds).max(axis=1) > max(0.05, 10.0 * size)
        assert far.sum() <= 5, f"{far.sum()} of 1000 are far at a step of {size}"


@pytest.mark.quick(1)
@pytest.mark.parametrize("arm", ["ur5", "irb", "decoupled", "panda"])
def test_a_small_step_of_the_tip_is_answered_by_a_small_step(arm: str) -> None:
    tables = {"ur5": UR5, "irb": IRB, "decoupled": DECOUPLED}
    machine, chain = table_arm(tables[arm]) if arm in tables else catalogue_arm(arm)
    chain = limited(chain, chain.lower - 0.3, chain.upper + 0.3)
    seeds = draw(chain, 1000) * 0.9
    rng = np.random.default_rng(4)
    by = rng.normal(size=(1000, 3))
    turned = rng.normal(size=(1000, 3))
    targets = moved(
        poses(machine, chain, seeds),
        0.004 * by / np.linalg.norm(by, axis=1)[:, None],
        0.03 * turned / np.linalg.norm(turned, axis=1)[:, None],
    )
    found = search(chain, targets, seeds)
    # Near a singularity a small step of the tip takes a large one of the joints, or cannot be taken.
    step = 1e-6
    regular = np.array([_smallest_singular_value(machine, chain, q, step) > 0.1 for q in seeds])
    assert regular.sum() > 300
    within = inside(limited(chain, chain.lower + 0.5, chain.upper - 0.5), seeds)
    counted = regular & within
    far = ~found.solved | (np.abs(found.qs - seeds).max(axis=1) > 0.6)
    assert counted.sum() > 100
    assert far[counted].sum() <= 0.005 * counted.sum()


def _smallest_singular_value(machine: RobotModel, chain: Chain, q: Array, step: float) -> float:
    n = len(q)
    around = poses(machine, chain, np.concatenate((q + step * np.eye(n), q - step * np.eye(n))))
    turns = Rotation.from_matrix(around.rotations[:n] @ around.rotations[n:].transpose(0, 2, 1)).as_rotvec()
    J = np.concatenate((around.positions[:n] - around.positions[n:], turns), axis=1) / (2 * step)
    return float(np.linalg.svd(J, compute_uv=False)[-1])


def test_at_the_seed_the_answer_is_the_seed() -> None:
    for name in ARMS:
        machine, chain = catalogue_arm(name)
        seeds = draw(chain, 200, seed=21)
        found = search(chain, poses(machine, chain, seeds), seeds)
        assert np.abs(found.qs - seeds).max() < 1e-6
        assert (found.restarts == 0).all()


def test_at_a_limit_the_answer_does_not_jump_by_a_full_turn() -> None:
    machine, chain = catalogue_arm("anthropomorphic_wrist")
    wanted = draw(chain, 200, seed=9) * 0.9
    wanted[:, 0] = np.pi
    seeds = wanted - 0.01
    found = search(chain, poses(machine, chain, wanted), seeds)
    assert found.solved.all()
    assert (np.abs(found.qs[:, 0] - np.pi) > 0.5).sum() <= 1
