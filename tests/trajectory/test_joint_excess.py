"""What leaves the joints' ranges: when, how far, and the part of a spline that can be done."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.excess import first_limit_excess
from gelenk.trajectory.joints.splines import JointSpline, promised
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Boundary
from gelenk.trajectory.problem.problem import Segment
from tests.trajectory.arms import BOUNDARIES, LAWS, SLOW, START, end_state, excess, free, limits, spline_motion, through


def test_where_a_spline_swings_out() -> None:
    """0, 1, 1, 0 swings above 1 in the middle; the extreme and the crossing against a fine grid."""
    chain = free(1, -1.0, 1.05)
    knots = np.array([[1.0], [1.0], [0.0]])
    segment = Segment("spline", "cubic", limits([1.0], [9.0]), configurations=knots, times=np.array([2.0, 4.0, 6.0]))
    motion = spline_motion(np.zeros(1), segment, chain)
    found = first_limit_excess(chain, motion)
    assert found is not None
    times = np.linspace(0.0, 6.0, 600_001)
    values = motion.at(times)[:, 0]
    assert found.joint == 0
    assert found.bound == 1.05
    assert found.value == pytest.approx(float(values.max()), abs=1e-9)
    assert found.time == pytest.approx(float(times[np.argmax(values > 1.05)]), abs=2e-5)
    assert first_limit_excess(free(1, -1.0, float(values.max()) + 1e-6), motion) is None
    below = first_limit_excess(free(1, -1.05, 1.0), replace(motion, coefficients=-motion.coefficients))
    assert below is not None
    assert below.time == pytest.approx(found.time, abs=1e-12)
    assert below.value == pytest.approx(-found.value, abs=1e-12)


def test_waypoints_at_the_very_limit_are_within() -> None:
    chain = free(2, -0.4, 1.0)
    waypoints = np.array([[1.0, -0.4], [0.5, 0.0]])
    segment = through("cubic", configurations=waypoints[:1])
    assert first_limit_excess(chain, spline_motion(START, segment, chain)) is None


def test_what_begins_outside_is_outside_from_the_start() -> None:
    motion = PiecewisePolynomial(np.array([1.0, 2.0]), np.array([[[3.0, 0.0], [-4.0, 0.0]]]))
    found = first_limit_excess(free(2, -5.0, 1.0), motion)
    assert found is not None
    assert (found.time, found.joint, found.value) == (1.0, 0, 3.0)


def longest_prefix(start: Array, segment: Segment, chain: Chain) -> tuple[PiecewisePolynomial, int]:
    spline = JointSpline.of(start, segment, chain)
    found = first_limit_excess(chain, spline.path)
    assert found is not None
    return spline.prefix(chain, found)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("has_times", [False, True])
def test_the_part_that_can_be_done(law: Law, boundary: Boundary, has_times: bool) -> None:
    chain = free(2, -2.0, 1.01)
    waypoints = np.array([[0.3, 0.5], [0.4, 0.0], [1.0, 0.2], [1.0, -0.9], [0.0, -0.5], START])
    times = np.arange(1.0, 7.0) * 3.0 if has_times else None
    segment = through(law, configurations=waypoints, boundary=boundary, times=times)
    if has_times and (boundary not in {"clamped", "assigned"} or law == "time_optimal"):
        return
    if has_times and law == "jerk_limited" and boundary == "clamped":
        return
    assert first_limit_excess(chain, spline_motion(START, segment, chain)) is not None
    motion, reached = longest_prefix(START, segment, chain)
    assert reached == 3
    assert first_limit_excess(chain, motion) is None
    assert np.abs(end_state(motion, 0, last=True) - waypoints[2]).max() <= 1e-9
    assert np.abs(end_state(motion, 1, last=True)).max() <= 1e-9
    assert excess(motion, SLOW, jerk=promised(segment)[1]) <= 1e-9
    if has_times:
        assert motion.duration == 9.0


def test_a_part_that_would_stop_too_fast_takes_longer() -> None:
    chain = free(1, -2.0, 3.01)
    q = np.array([[1.0], [2.0], [3.0], [3.0], [1.0]])
    segment = Segment(
        "spline", "cubic", limits([1.2], [2.0]), configurations=q, times=np.array([2.0, 3.0, 4.2, 5.5, 8.0])
    )
    assert first_limit_excess(chain, spline_motion(np.zeros(1), segment, chain)) is not None
    motion, reached = longest_prefix(np.zeros(1), segment, chain)
    assert reached == 3
    assert excess(motion, segment.limits, jerk=False) <= 1e-9
    assert first_limit_excess(chain, motion) is None


def test_only_the_first_waypoint_or_none() -> None:
    swinging = np.array([[0.0, 0.5], [1.0, 0.5], [1.0, 0.0], [0.0, 0.0]])
    chain = free(2, -5.0, 1.001)
    _, reached = longest_prefix(swinging[0], through("cubic", configurations=swinging[1:]), chain)
    assert reached == 1
    motion, reached = longest_prefix(np.array([2.0, 0.0]), through("cubic"), free(2, -5.0, 1.001))
    assert reached == 0
    assert motion.duration == 0.0
