"""The shell of what distance allows: nothing that can be reached is outside, and of links in line it is tight."""

from itertools import pairwise

import numpy as np
import pytest

from gelenk.errors import UnsupportedJoint
from gelenk.ik.search.reach import Reach, reach_of
from gelenk.ik.search.task import Task
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.ik.arms import POSITION, TASKS, UR5, at, catalogue_arm, draw, limited, planar_arm, poses, table_arm
from tests.oracles import catalogue
from tests.robots import robot, swept

OTHERS = [Task(("x", "z", "ry")), Task(("z",)), Task(("x", "y", "z", "rz"))]


def shell(chain: Chain, task: Task, respect_limits: bool = True) -> Reach:
    """The shell, which there must be."""
    reach = reach_of(chain, task, respect_limits)
    assert reach is not None
    return reach


def chains(machine: RobotModel, seed: int) -> list[Chain]:
    """The default chain and some between other frames."""
    rng = np.random.default_rng(seed)
    found = [machine.chain(None, None)]
    for base, tip in rng.choice(machine.description.frames, (6, 2)):
        try:
            found.append(machine.chain(str(base), str(tip)))
        except UnsupportedJoint:
            continue
    return [chain for chain in found if len(chain)]


def extremes(chain: Chain, respect_limits: bool, seed: int) -> Array:
    """Configurations within the limits, or beyond, many of them with joints at the ends."""
    rng = np.random.default_rng(seed)
    lower = np.where(np.isinf(chain.lower) | (not respect_limits), -4.0, chain.lower)
    upper = np.where(np.isinf(chain.upper) | (not respect_limits), 4.0, chain.upper)
    qs = rng.uniform(lower, upper, (120, len(chain)))
    ends = np.where(rng.random(qs.shape) < 0.5, lower, upper)
    zero = np.clip(np.zeros(len(chain)), lower, upper)
    qs[:40] = np.where(rng.random((40, len(chain))) < 0.7, ends[:40], qs[:40])
    qs[40:60] = np.where(rng.random((20, len(chain))) < 0.7, zero, qs[40:60])
    return qs


@pytest.mark.parametrize("respect_limits", [True, False])
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_nothing_that_is_reached_is_outside(name: str, respect_limits: bool) -> None:
    machine = robot(name)
    for chain in chains(machine, 5):
        reached = poses(machine, chain, extremes(chain, respect_limits, 6))
        for task in (*TASKS.values(), *OTHERS):
            reach = reach_of(chain, task, respect_limits)
            if not task.weights[:3].any():
                assert reach is None
                continue
            assert reach is not None
            assert reach.excess(reached).max() < 1e-12 * max(1.0, min(reach.farthest, 1e6)), task
            assert 0.0 <= reach.nearest <= reach.farthest


@pytest.mark.parametrize(("first", "second"), [(1.0, 0.7), (0.7, 1.0), (1.0, 1.0), (2.0, 0.1)])
def test_of_two_links_the_shell_is_the_annulus(first: float, second: float) -> None:
    machine, chain = planar_arm(first, second)
    reach = shell(chain, POSITION)
    assert reach.farthest == pytest.approx(first + second, abs=1e-15)
    assert reach.nearest == pytest.approx(abs(first - second), abs=1e-15)
    stretched = poses(machine, chain, np.array([[0.4, 0.0], [0.4, np.pi]]))
    np.testing.assert_allclose(reach.excess(stretched), 0.0, atol=1e-15)
    for radius, excess in ((first + second + 0.3, 0.3), (first + second, 0.0), (first + second - 0.01, -0.01)):
        assert reach.excess(at(radius, 0.0))[0] == pytest.approx(excess, abs=1e-12)
    if first != second:
        assert reach.excess(at(0.0, 0.0))[0] == pytest.approx(abs(first - second))


@pytest.mark.parametrize("lengths", [(1.0, 0.7, 0.2), (1.0, 0.2, 0.3), (0.5, 0.5, 0.5), (1.0, 0.9, 0.5)])
def test_of_three_links_the_shell_is_the_courses_workspace(lengths: tuple[float, float, float]) -> None:
    _, chain = planar_arm(*lengths)
    reach = shell(chain, POSITION)
    assert reach.farthest == pytest.approx(sum(lengths))
    assert reach.nearest == pytest.approx(max(0.0, 2 * max(lengths) - sum(lengths)), abs=1e-15)
    whole = shell(chain, Task())
    assert whole.farthest == pytest.approx(lengths[0] + lengths[1])
    assert whole.nearest == pytest.approx(abs(lengths[0] - lengths[1]))
    # The last link points from the wrist to the tip whatever the wrist does.
    assert whole.distances(at(0.3, 0.4))[0] == pytest.approx(np.hypot(0.3 - lengths[2], 0.4))


@pytest.mark.parametrize("aside", [0.0, 0.3])
def test_a_slide_is_as_long_as_its_limits_allow(aside: float) -> None:
    machine, chain = table_arm([(0, np.pi / 2, 0.5, 0), (0, np.pi / 2, 0, np.pi / 2), (aside, 0, 0, 0)], "RRP")
    long, short = limited(chain, [-3, -3, 0.4], [3, 3, 1.2]), limited(chain, [-3, -3, -0.2], [3, 3, 0.6])
    # The height of the second joint stands before the first, along whose axis it lies.
    np.testing.assert_allclose(shell(long, POSITION).center, [0.0, 0.0, 0.5], atol=1e-15)
    assert shell(long, POSITION).farthest == pytest.approx(np.hypot(aside, 1.2))
    assert shell(long, POSITION).nearest == pytest.approx(np.hypot(aside, 0.4))
    assert shell(short, POSITION).farthest == pytest.approx(np.hypot(aside, 0.6))
    assert shell(short, POSITION).nearest == pytest.approx(aside)
    assert shell(chain, POSITION, respect_limits=False).farthest == np.inf
    assert shell(chain, POSITION, respect_limits=False).nearest == 0.0
    for narrow in (long, short):
        assert shell(narrow, POSITION).excess(poses(machine, narrow, draw(narrow, 500))).max() < 1e-12


def test_the_shell_is_about_the_first_joint_wherever_it_stands() -> None:
    machine, chain = catalogue_arm("ur5")
    reach = shell(chain, POSITION)
    first = machine.chain("base_link", "shoulder_link")
    np.testing.assert_allclose(reach.center, poses(machine, first, np.zeros((1, 1))).positions[0], atol=1e-12)
    names = ["shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link", "wrist_2_link", "wrist_3_link", "tool0"]
    points = [
        poses(machine, machine.chain("base_link", name), np.zeros((1, i + 1 - (i == 6))))
        for i, name in enumerate(names)
    ]
    lengths = [np.linalg.norm(a.positions - b.positions) for a, b in pairwise(points)]
    assert reach.farthest == pytest.approx(sum(lengths), abs=1e-12)
    assert shell(chain, Task()).farthest == pytest.approx(sum(lengths[:-1]), abs=1e-12)


def test_free_directions_of_the_position_do_not_count() -> None:
    _, chain = planar_arm(1.0, 0.7)
    flat = shell(chain, Task(("x", "y")))
    assert flat.nearest == 0.0
    assert flat.excess(at(1.0, 1.0, 50.0))[0] < 0.0
    assert flat.excess(at(3.0, 4.0, 50.0))[0] == pytest.approx(5.0 - 1.7)


def test_a_reason_says_by_how_much() -> None:
    _, chain = planar_arm(1.0, 0.7)
    reach = shell(chain, POSITION)
    assert "0.3 m more than the links allow" in reach.describe(at(2.0, 0.0))
    assert "at most 1.7 m" in reach.describe(at(2.0, 0.0))
    assert "at least 0.3 m" in reach.describe(at(0.1, 0.0))
    assert "the tip" in reach.describe(at(2.0, 0.0))
    assert "the last joint" in shell(chain, Task()).describe(at(2.0, 0.0))


def test_without_joints_there_is_no_shell() -> None:
    machine, _ = table_arm(UR5)
    assert reach_of(machine.chain("base", "base"), POSITION, True) is None
