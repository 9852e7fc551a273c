"""Joints past via points with parabolic blends: limits, ends, how far points are missed, and what is refused."""

import math
from typing import Any

import numpy as np
import pytest

from gelenk.errors import InvalidField
from gelenk.trajectory.joints.motion import point_to_point_motion
from gelenk.trajectory.joints.via_blends import via_blends
from gelenk.trajectory.problem.problem import SegmentLimits
from tests.trajectory.arms import ARMS, arm, end_state, excess, jump

BOUND = SegmentLimits(np.array([1.0, 0.8]), np.array([3.0, 2.0]), np.array([1e6, 1e6]))
START = np.array([0.0, 0.5])
POINTS = np.array([[0.6, 0.1], [0.2, -0.4], [1.0, 0.3]])


@pytest.mark.parametrize("name", ARMS)
def test_past_via_points_of_real_arms(name: str) -> None:
    one, rng = arm(name), np.random.default_rng(7)
    for count in (1, 2, 6):
        bound, qs = one.limits(rng), one.configurations(rng, count + 1)
        found = via_blends(qs[0], qs[1:], bound)
        motion = found.motion
        assert excess(motion, bound, jerk=False) <= 1e-9
        assert max(jump(motion, 0), jump(motion, 1)) <= 1e-9
        for last in (False, True):
            assert np.abs(end_state(motion, 0, last=last) - qs[-1 if last else 0]).max() <= 1e-9
            assert np.abs(end_state(motion, 1, last=last)).max() <= 1e-9
        assert (np.diff(motion.breaks) > 0.0).all()
        with pytest.raises(InvalidField, match="must be at least"):
            via_blends(qs[0], qs[1:], bound, duration=0.999 * motion.duration)
        low, high = np.minimum.reduce(qs) - 1e-9, np.maximum.reduce(qs) + 1e-9
        values = motion.at(np.linspace(0.0, motion.duration, 500))
        assert ((values >= low) & (values <= high)).all()


def test_one_step_is_the_trapezoid() -> None:
    for target in ([2.0, -1.0], [0.1, 0.55], [0.3, 5.0]):
        found = via_blends(START, np.array([target]), BOUND)
        other = point_to_point_motion(START, np.array(target), "trapezoidal", BOUND)
        assert found.motion.duration == pytest.approx(other.duration, rel=1e-9)


def test_it_passes_points_by_no_more_than_it_says() -> None:
    found = via_blends(START, POINTS, BOUND)
    duration = found.motion.duration
    turning = np.abs(np.diff(found.velocities[:, 0], prepend=0.0, append=0.0)) / BOUND.acceleration[0]
    assert turning[1:-1] == pytest.approx(found.durations[1:-1, 0])
    assert (found.deviations[[0, -1]] == 0.0).all()
    assert (found.deviations[1:-1] > 0.0).all()
    values = found.motion.at(np.linspace(0.0, duration, 200_001))
    for point, deviation in zip(POINTS[:-1], found.deviations[1:-1], strict=True):
        distance = float(np.linalg.norm(values - point, axis=1).min())
        assert 0.0 < distance <= float(np.linalg.norm(deviation)) + 1e-6


def test_at_given_times_points_are_missed_by_what_is_told() -> None:
    times = np.array([2.0, 4.0, 7.0])
    found = via_blends(START, POINTS, BOUND, times=times)
    assert found.motion.breaks[-1] == pytest.approx(7.0, abs=1e-12)
    missed = np.abs(found.motion.at(times[:-1]) - POINTS[:-1])
    np.testing.assert_allclose(missed, found.deviations[1:-1], atol=1e-12)
    assert excess(found.motion, BOUND, jerk=False) <= 1e-9


def test_a_given_duration() -> None:
    least = via_blends(START, POINTS, BOUND)
    duration = 1.6 * least.motion.duration
    found = via_blends(START, POINTS, BOUND, duration=duration)
    assert found.motion.duration == pytest.approx(duration, rel=1e-12)
    assert excess(found.motion, BOUND, jerk=False) < 0.0
    assert np.abs(end_state(found.motion, 0, last=True) - POINTS[-1]).max() <= 1e-12
    peak = np.abs(found.motion.derivative(2).coefficients).max(axis=(0, 1))
    assert peak == pytest.approx(np.abs(np.where(found.durations > 0.0, found.accelerations, 0.0)).max(axis=0))
    np.testing.assert_array_equal(found.deviations, least.deviations)


_TIMES = np.array([2.0, 4.0, 7.0])


@pytest.mark.parametrize(
    ("options", "field", "reason"),
    [
        ({"configurations": np.empty((0, 2))}, "waypoints", "at least one"),
        ({"configurations": POINTS[[0, 0, 1]]}, "waypoints.1", "the same as entry 0"),
        ({"times": _TIMES[[1, 0, 2]]}, "times", "have to increase"),
        ({"times": _TIMES, "duration": 7.0}, "duration", "not allowed beside `times`"),
        ({"times": 0.25 * _TIMES}, "limits.joint_acceleration", "too short"),
        ({"duration": 0.5}, "duration", "must be at least"),
        ({"duration": math.inf}, "duration", "greater than 0 s"),
        ({"limits": SegmentLimits(-BOUND.velocity, BOUND.acceleration, BOUND.jerk)}, "limits.joint_velocity", "number"),
    ],
)
def test_what_is_refused(options: dict[str, Any], field: str, reason: str) -> None:
    asked: dict[str, Any] = {"configurations": POINTS, "limits": BOUND, **options}
    with pytest.raises(InvalidField, match=reason) as refusal:
        via_blends(START, **asked)
    assert refusal.value.field == field


def test_a_velocity_that_is_too_high_at_given_times() -> None:
    fast = SegmentLimits(np.array([0.3, 0.8]), np.array([30.0, 20.0]), BOUND.jerk)
    with pytest.raises(InvalidField, match=r"joint 1 reaches .* times its limit of velocity in segment 1") as refusal:
        via_blends(START, POINTS, fast, times=np.array([1.0, 4.0, 7.0]))
    assert refusal.value.field == "times"
