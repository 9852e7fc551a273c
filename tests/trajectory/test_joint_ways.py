"""The fastest motion through waypoints in one call: what the steps one by one give, or nothing."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from gelenk.errors import AuditFailed
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.splines import JointSpline
from gelenk.trajectory.joints.ways import fastest_way
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, TrajectoryProblem
from tests.robots import robot
from tests.trajectory.arms import START, WAYPOINTS, arm, free, limits, through

FASTEST = through(law="time_optimal", boundary="clamped", limits=limits([1.0, 0.4], [3.0, 3.0]))


@pytest.mark.parametrize("seed", range(6))
def test_the_motion_is_that_of_the_steps_one_by_one(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = 1 + 3 * seed
    waypoints, bounds = rng.uniform(-1.0, 1.0, (count, 7)), rng.uniform(0.5, 3.0, (2, 7))
    segment = replace(FASTEST, configurations=waypoints, limits=limits(*bounds.tolist()))
    start = rng.uniform(-1.0, 1.0, 7)
    found = fastest_way(free(7), start, segment)
    expected = JointSpline.of(start, segment, free(7)).motion()
    assert found is not None
    np.testing.assert_array_equal(found.breaks, expected.breaks)
    np.testing.assert_array_equal(found.coefficients, expected.coefficients)
    assert found.breaks.flags.writeable, "else all that examines it would be compiled once more"
    assert found.coefficients.flags.writeable


@pytest.mark.slow
def test_the_first_request_for_a_motion_does_not_wait_for_a_compiler() -> None:
    """In a new process, which has called nothing but the warm-up."""
    program = (
        "from gelenk.kinematics.warm_up import warm_up; from gelenk.trajectory.joints.ways import _planned;"
        "from gelenk.trajectory.laws.jerk_profiles import least_times, profiles; warm_up();"
        "print(*(len(kernel.signatures) for kernel in (_planned, least_times, profiles)))"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=500, check=True)
    assert run.stdout == "1 1 1\n"


@pytest.mark.parametrize(
    "segment",
    [
        replace(FASTEST, law="cubic"),
        replace(FASTEST, boundary="natural"),
        replace(FASTEST, times=np.arange(1.0, 1.0 + len(WAYPOINTS))),
        replace(FASTEST, duration=100.0),
        replace(FASTEST, limits=limits([1.0, 1e-12], [3.0, 3.0])),
        replace(FASTEST, limits=limits([1.0, 1.0], [3.0, 3e12])),
        replace(FASTEST, configurations=np.empty((0, 2))),
        replace(FASTEST, configurations=START[None]),
        replace(FASTEST, configurations=np.array([START + 1.0, START + 1.0 + 1e-9, START])),
        replace(FASTEST, configurations=np.array([[1.0, np.nan]])),
        replace(FASTEST, configurations=np.array([[1e10, 1.0]])),
        replace(FASTEST, configurations=np.tile([[1.0, 0.5], [0.0, 0.0]], (6_300, 1)) + START),
    ],
)
def test_all_else_is_left_to_them(segment: Segment) -> None:
    assert fastest_way(free(2), START, segment) is None


def test_what_leaves_the_limits_or_comes_near_them_is_left_to_them() -> None:
    chain = arm("panda").chain
    start, most = 0.5 * (chain.lower + chain.upper), 0.5 * (chain.upper - chain.lower)
    segment = replace(FASTEST, limits=limits([1.0] * 7, [2.0] * 7))

    def is_planned(*waypoints: Array) -> bool:
        return fastest_way(chain, start, replace(segment, configurations=np.array(waypoints))) is not None

    assert is_planned(start + 0.1 * most)
    assert not is_planned(start + most + 1e-6)
    assert not is_planned(start + most, start)


def test_an_end_beside_the_last_waypoint_fails_the_audit(monkeypatch: pytest.MonkeyPatch) -> None:
    panda, chain = robot("panda"), arm("panda").chain
    start = 0.5 * (chain.lower + chain.upper)
    segment = replace(FASTEST, configurations=start + np.full((1, 7), 0.2), limits=limits([1.0] * 7, [2.0] * 7))
    beside = replace(segment, configurations=start + np.full((1, 7), 0.201))
    monkeypatch.setattr("gelenk.trajectory.joint_part.fastest_way", lambda *_: fastest_way(chain, start, beside))
    with pytest.raises(AuditFailed, match=r"position at the end is off by 0\.001"):
        plan(panda, chain, TrajectoryProblem(start, (segment,)))
