"""Random arms: what can be reached is reached, and errors are what they are said to be."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.branches import wound_near
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.ik.arms import angles, assert_solved, distances, draw, inside, limited, middle, moved, poses, search
from tests.robots import of_table, rows

SETTINGS = settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))

TWISTS = st.sampled_from([0.0, np.pi / 2, -np.pi / 2, np.pi, 0.6, -1.1])
LENGTHS = st.sampled_from([0.0, 0.05, 0.3, -0.4, 1.0])
ROWS = st.tuples(LENGTHS, TWISTS, LENGTHS, st.sampled_from([0.0, np.pi / 2, -0.8]))


@st.composite
def arms(draw_from: st.DrawFn, least: int = 2, most: int = 8) -> tuple[RobotModel, Chain]:
    """A table of turning and sliding joints, some with narrow limits."""
    count = draw_from(st.integers(least, most))
    parameters = draw_from(st.lists(ROWS, min_size=count, max_size=count))
    types = "".join(draw_from(st.lists(st.sampled_from("RRRP"), min_size=count, max_size=count)))
    machine = of_table(rows(draw_from(st.sampled_from(["standard", "modified"])), parameters, types))
    chain = machine.chain(None, None)
    lower, upper = np.full(count, -1.0), np.full(count, 1.0)
    for j, letter in enumerate(types):
        span = draw_from(st.sampled_from([0.2, 1.0, 3.0, np.pi, 7.0] if letter == "R" else [0.1, 1.0]))
        center = draw_from(st.sampled_from([0.0, 0.5, -2.0] if letter == "R" else [0.0, 0.5]))
        lower[j], upper[j] = center - span, center + span
    return machine, limited(chain, lower, upper)


@pytest.mark.slow
@SETTINGS
@given(arms(), st.integers(0, 2**31))
def test_what_can_be_reached_is_reached(arm: tuple[RobotModel, Chain], seed: int) -> None:
    machine, chain = arm
    targets = poses(machine, chain, draw(chain, 8, seed))
    assert_solved(machine, chain, targets, inverse_kinematics(machine, chain, targets, middle(chain), Options()))


@pytest.mark.slow
@SETTINGS
@given(arms(), st.integers(0, 2**31), st.floats(0.0, 2.0), st.floats(0.0, 3.0))
def test_an_answer_is_right_whatever_is_asked(
    arm: tuple[RobotModel, Chain], seed: int, away: float, turned: float
) -> None:
    machine, chain = arm
    rng = np.random.default_rng(seed)
    targets = moved(
        poses(machine, chain, draw(chain, 3, seed)), away * rng.normal(size=(3, 3)), turned * rng.normal(size=(3, 3))
    )
    seeds = rng.uniform(-10.0, 10.0, (3, len(chain)))
    answer = inverse_kinematics(machine, chain, targets, seeds, Options(max_iterations=2000))
    for i, status in enumerate(answer.statuses):
        target = type(targets)(targets.positions[i : i + 1], targets.rotations[i : i + 1])
        solved = status == "solved"
        row = answer.firsts[i]
        q = answer.qs[row] if solved else answer.failures[i].nearest
        said = (
            (answer.position_errors[row], answer.orientation_errors[row])
            if solved
            else (answer.failures[i].position_error, answer.failures[i].orientation_error)
        )
        reached = poses(machine, chain, q[None])
        assert abs(distances(target, reached)[0] - said[0]) < 1e-12
        assert abs(angles(target, reached)[0] - said[1]) < 1e-7
        assert inside(chain, q[None], 1e-9).all()
        if solved:
            assert max(said) <= 1e-6
        else:
            assert max(said) > 1e-6
        if status == "outside_limits":
            assert answer.failures[i].blocking_joints
            free = inverse_kinematics(machine, chain, target, seeds[i : i + 1], Options(respect_limits=False))
            assert free.statuses == ["solved"]


@pytest.mark.slow
@SETTINGS
@given(arms(), st.integers(0, 2**31))
def test_every_solution_is_one_and_no_two_are_the_same(arm: tuple[RobotModel, Chain], seed: int) -> None:
    machine, chain = arm
    target = poses(machine, chain, draw(chain, 1, seed))
    answer = inverse_kinematics(machine, chain, target, middle(chain), Options(every=True, most=30))
    assert_solved(machine, chain, target, answer)
    assert 1 <= len(answer.qs) <= 30
    for i in range(len(answer.qs)):
        assert (np.abs(answer.qs[:i] - answer.qs[i]).max(axis=1, initial=0.0) > 1e-4).all()


@pytest.mark.slow
@SETTINGS
@given(
    arms(3, 6),
    st.integers(0, 2**31),
    st.sampled_from([FULL_POSE, Task(("x", "y", "z")), Task(("x", "y", "z", "rx", "ry"))]),
)
def test_a_batch_is_its_targets_one_by_one(arm: tuple[RobotModel, Chain], seed: int, task: Task) -> None:
    machine, chain = arm
    targets, seeds = poses(machine, chain, draw(chain, 40, seed)), draw(chain, 40, seed + 1)
    together = search(chain, targets, seeds, task=task)
    for i in range(0, 40, 7):
        alone = search(
            chain,
            type(targets)(targets.positions[i : i + 1], targets.rotations[i : i + 1]),
            seeds[i : i + 1],
            task=task,
        )
        np.testing.assert_array_equal(alone.qs[0], together.qs[i])


@pytest.mark.slow
@SETTINGS
@given(arms(1, 4), st.integers(0, 2**31))
def test_turning_changes_no_pose(arm: tuple[RobotModel, Chain], seed: int) -> None:
    machine, chain = arm
    rng = np.random.default_rng(seed)
    qs = rng.uniform(-20.0, 20.0, (5, len(chain)))
    wound = wound_near(chain, qs, rng.uniform(-20.0, 20.0, len(chain)), chain.lower, chain.upper)
    before, after = poses(machine, chain, qs), poses(machine, chain, wound)
    assert distances(before, after).max() < 1e-12
    assert angles(before, after).max() < 1e-7
