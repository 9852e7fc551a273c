"""What is said of a line that is halted, against inverse kinematics along it and all branches followed."""

import re
import time
from functools import cache

import numpy as np
import pytest

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.words import NearSingularity
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.follow.integrate import traced
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.paths.paths import Path, line
from gelenk.trajectory.problem.problem import Following
from tests.robots import of_table, robot, rows
from tests.trajectory.test_follow import SCARA, XY, moved, pose, starts

XYZ = Task(("x", "y", "z"))
ARMS = {
    "planar_2r": XY,
    "anthropomorphic": XYZ,
    "scara": SCARA,
    "so100": Task(("x", "y", "z", "rx", "ry")),
    "ur5": FULL_POSE,
    "puma560": FULL_POSE,
    "stanford": FULL_POSE,
    "z1": FULL_POSE,
    "kinova": FULL_POSE,
    "panda": FULL_POSE,
    "iiwa": FULL_POSE,
    "talos_left_arm": FULL_POSE,
}
RIGHT = 0.5 * np.pi
IIWA = [(0.36, -RIGHT), (0.0, RIGHT), (0.42, RIGHT), (0.0, -RIGHT), (0.4, -RIGHT), (0.0, RIGHT), (0.126, 0.0)]
"""d and α of a shoulder, elbow and wrist of seven joints."""
BEYOND = re.compile(r"beyond (\S+)% of the path")


@cache
def arm_of(name: str) -> RobotModel:
    """An arm of the catalogue, or of a table."""
    if name != "iiwa":
        return robot(name)
    return of_table(rows("standard", [(0.0, angle, d, 0.0) for d, angle in IIWA], "R" * 7))


def halted(
    name: str, count: int, near: NearSingularity = "stop"
) -> list[tuple[RobotModel, Chain, Path, Array, FollowedPath]]:
    """Random lines, from some within the arm's reach to far beyond it, that are not done to their ends."""
    arm, task = arm_of(name), ARMS[name]
    chain = arm.chain(None, None)
    rng = np.random.default_rng(5)
    found: list[tuple[RobotModel, Chain, Path, Array, FollowedPath]] = []
    for k, q in enumerate(starts(chain, task, count, seed=7, least=0.05)):
        T = pose(chain, q)
        shift = (0.2, 0.5, 2.0)[k % 3] * rng.normal(size=3) * ([1.0, 1.0, 0.0] if task == XY else 1.0)
        turn = (0.0, 0.5, 1.5)[(k + k // 3) % 3] * rng.normal(size=3) * (1.0 if len(task) > 4 else 0.0)
        path = line(T, moved(T, shift, turn))
        way = follow(arm, chain, path, q, Following(task=task, near_singularity=near))
        if way.stop is not None:
            found.append((arm, chain, path, q, way))
    return found


def test_a_limit_before_the_end_does_not_hide_that_the_end_is_out_of_reach() -> None:
    """Two links of 1 m and 0.7 m: the first meets its limit of π behind the base, the end is at a distance of 2.5 m."""
    arm = robot("planar_2r")
    chain = arm.chain(None, None)
    q = np.array([2.9, 0.8])
    T = pose(chain, q)
    path = line(T, moved(T, np.array([-1.5, -2.0, 0.0]) - T[:3, 3], np.zeros(3)))
    way = follow(arm, chain, path, q, Following(task=XY))
    assert way.stop is not None
    assert way.stop.reason == "out_of_reach"
    assert way.stop.joint == "joint_1"
    assert "the end of the path is out of reach: beyond reach" in way.stop.detail
    assert "0.8 m more than the links allow" in way.stop.detail
    assert "joint 'joint_1' meets its upper limit" in way.stop.detail


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ARMS)
def test_out_of_reach_is_what_inverse_kinematics_do_not_reach(name: str) -> None:
    """By all solutions of other searches than those of the verdict, all along what is left of the line."""
    reasons = set()
    for arm, chain, path, q, way in halted(name, 3):
        assert way.stop is not None
        reasons.add(way.stop.reason)
        places = np.linspace(way.stop.s, path.extent, 17)[1:]
        options = Options(task=ARMS[name], every=True, random_seed=1)
        found = inverse_kinematics(arm, chain, path.at(places).poses, q[None], options)
        assert (way.stop.reason == "out_of_reach") == ("unreachable" in found.statuses), way.stop.detail
        assert ("the end of the path is out of reach" in way.stop.detail) == (found.statuses[-1] == "unreachable")
    assert "out_of_reach" in reasons


SLOW = [pytest.param(name, marks=pytest.mark.slow) for name in ("ur5", "puma560", "stanford", "kinova", "iiwa")]


@pytest.mark.quick(1)
@pytest.mark.parametrize("near", ["stop", "slow_down"])
@pytest.mark.parametrize("name", ["planar_2r", *SLOW])
def test_what_is_said_of_all_configurations_holds_for_each(name: str, near: NearSingularity) -> None:
    """Of all that closed forms and a search find, full turns apart included."""
    claims = 0
    for arm, chain, path, q, way in halted(name, 3, near):
        assert way.stop is not None
        if "no configuration" not in way.stop.detail:
            assert "others may exist" in way.stop.detail or "another branch" in way.stop.detail or len(q) > 6
            continue
        claims += 1
        said = float(BEYOND.findall(way.stop.detail)[-1]) / 100.0
        assert way.reached <= (said + 1e-6) * path.extent
        at = path.at(np.zeros(1)).poses
        rng = np.random.default_rng(1)
        seeds = rng.uniform(np.maximum(chain.lower, -7.0), np.minimum(chain.upper, 7.0), (4, len(q)))
        listed = inverse_kinematics(arm, chain, at, q[None], Options(task=ARMS[name], every=True)).qs
        found = [inverse_kinematics(arm, chain, at, seed[None], Options(task=ARMS[name])).qs for seed in seeds]
        field = RateField(chain, path, ARMS[name], (1e-4, 1e-3), 0.01 if near == "stop" else 0.0)
        for other in np.concatenate([listed, *found]):
            one = traced(field, other)
            assert one.ending != "complete"
            assert one.reached <= (said + 1e-6) * path.extent, way.stop.detail
    assert claims or name not in {"planar_2r", "puma560"}


@pytest.mark.slow
@pytest.mark.parametrize("near", ["stop", "slow_down"])
def test_a_way_that_creeps_is_given_up(near: NearSingularity) -> None:
    """Six joints for three directions: near to the end of reach the pieces become ever shorter, thousands of them."""
    arm = robot("kinova")
    chain = arm.chain(None, None)
    q = np.array([-1.0670470843681685, 1.9884063267380552, 2.110312011102249, -0.9477392487505321, 2.2066, 0.65098])
    T = pose(chain, q)
    path = line(
        T, moved(T, np.array([-2.7292876673849373, -3.1848175074360365, 3.31784062787351]) - T[:3, 3], np.zeros(3))
    )
    follow(arm, chain, line(T, moved(T, np.array([0.0, 0.0, 1e-3]), np.zeros(3))), q, Following(task=XYZ))
    before = time.process_time()
    way = follow(arm, chain, path, q, Following(task=XYZ, near_singularity=near))
    assert time.process_time() - before < 3.0
    assert way.stop is not None
    assert way.stop.reason == "out_of_reach"
