"""Joints from point to point: closed forms of the least time, what each law promises, and what is refused."""

import math
from dataclasses import replace

import numpy as np
import pytest

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.motion import compared_point_to_point, point_to_point_motion
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.problem.problem import SegmentLimits
from tests.trajectory.arms import ARMS, LAWS, arm, end_state, excess, jump, limits

WITH_JERK: frozenset[Law] = frozenset({"quintic", "septic", "jerk_limited"})


def trapezoid_time(distance: float, v: float, a: float) -> float:
    """Bang-coast-bang of the course."""
    return distance / v + v / a if distance > v * v / a else 2.0 * math.sqrt(distance / a)


def jerk_limited_time(distance: float, v: float, a: float, j: float) -> float:
    """The least duration from rest to rest of one joint [Biagiotti2008, 3.4]."""
    rise = 2.0 * math.sqrt(v / j) if v * j < a * a else v / a + a / j
    if distance >= v * rise:
        return distance / v + rise
    if distance >= 2.0 * a**3 / j**2:
        peak = 0.5 * (math.sqrt((a * a / j) ** 2 + 4.0 * a * distance) - a * a / j)
        return 2.0 * (peak / a + a / j)
    return 4.0 * math.cbrt(distance / (2.0 * j))


# The course


@pytest.mark.parametrize(
    ("law", "bound", "duration"),
    [
        ("cubic", limits([1.0], [1e9]), 1.5 * 2.0),
        ("cubic", limits([1e9], [1.0]), math.sqrt(6.0 * 2.0)),
        ("quintic", limits([1.0], [1e9]), 1.875 * 2.0),
        ("quintic", limits([1e9], [1.0]), math.sqrt(5.773502692 * 2.0)),
        ("quintic", limits([1e9], [1e9], 1.0), math.cbrt(60.0 * 2.0)),
        ("septic", limits([1.0], [1e9]), 2.1875 * 2.0),
        ("trapezoidal", limits([0.8], [1.6]), 3.0),
        ("time_optimal", limits([0.8], [1.6]), 3.0),
    ],
)
def test_the_least_duration_of_a_law(law: Law, bound: SegmentLimits, duration: float) -> None:
    motion = point_to_point_motion(np.array([0.5]), np.array([-1.5]), law, bound)
    assert motion.duration == pytest.approx(duration, rel=1e-9)


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize(
    ("law", "coefficients"),
    [
        ("cubic", [-2.0, 3.0, 0.0, 0.0]),
        ("quintic", [6.0, -15.0, 10.0, 0.0, 0.0, 0.0]),
        ("septic", [-20.0, 70.0, -84.0, 35.0, 0.0, 0.0, 0.0, 0.0]),
    ],
)
def test_the_binding_limit_is_just_reached(law: Law, coefficients: list[float], order: int) -> None:
    """Against the peaks of the law in λ on a fine grid."""
    if law == "cubic" and order == 3:
        return
    grid = np.linspace(0.0, 1.0, 1_000_001)
    peak = float(np.abs(np.polyval(np.polyder(np.poly1d(coefficients), order), grid)).max())
    velocity, acceleration, jerk = (0.7 if k == order else 1e9 for k in (1, 2, 3))
    motion = point_to_point_motion(np.zeros(1), np.array([3.0]), law, limits([velocity], [acceleration], jerk))
    assert motion.duration == pytest.approx((3.0 * peak / 0.7) ** (1.0 / order), rel=1e-9)


def test_the_exam_synchronises_to_the_slower_joint() -> None:
    """Item 44: d = (-1, 0.7), v = (0.5, 0.8), a = (0.8, 0.5)."""
    motion = point_to_point_motion(np.zeros(2), np.array([-1.0, 0.7]), "trapezoidal", limits([0.5, 0.8], [0.8, 0.5]))
    assert motion.duration == pytest.approx(2.625, abs=5e-13)
    middle = motion.derivative(1).at(np.array([2.625 / 2.0]))[0]
    assert middle == pytest.approx([-0.5, 0.533333333], abs=5e-10)
    assert motion.derivative(2).at(np.zeros(1))[0] == pytest.approx([-0.8, 0.406349206349], abs=5e-13)


def test_the_exam_is_time_optimal() -> None:
    """Item 47: T = max_j T_j. Along the line joint 1 would limit the velocity and joint 2 the acceleration: 2.7 s."""
    bound = limits([0.5, 0.8], [0.8, 0.5])
    motion = point_to_point_motion(np.zeros(2), np.array([-1.0, 0.7]), "time_optimal", bound)
    assert motion.duration == pytest.approx(2.625, abs=1e-12)


def test_a_given_duration_of_the_trapezoid_keeps_the_acceleration() -> None:
    """Item 44: L = 2, a = 1.6, T = 3.5 has T_s = 0.4037, v = 0.6459."""
    motion = point_to_point_motion(np.zeros(1), np.array([2.0]), "trapezoidal", limits([0.8], [1.6]), 3.5)
    assert motion.duration == 3.5
    assert motion.breaks[1] == pytest.approx(0.403708798216, abs=5e-13)
    assert motion.derivative(1).at(np.array([1.0]))[0, 0] == pytest.approx(0.645934077146, abs=5e-13)


def test_uniform_scaling_compared() -> None:
    """Item 48, simple: Δq = (1, -2), cubic, T = 1, v = (1, 2), a = (8, 8)."""
    start, target = np.zeros(2), np.array([1.0, -2.0])
    found = compared_point_to_point(start, target, "cubic", limits([1.0, 2.0], [8.0, 8.0]))
    assert found.velocity_factor == pytest.approx(1.5, abs=1e-12)
    assert found.acceleration_factor == pytest.approx(1.5, abs=1e-12)
    assert found.uniform_duration == pytest.approx(1.5, abs=1e-12)
    assert found.time_optimal_duration == pytest.approx(trapezoid_time(1.0, 1.0, 4.0), abs=1e-12)
    loose = compared_point_to_point(start, target, "cubic", limits([10.0, 10.0], [100.0, 100.0]))
    assert loose.uniform_duration == pytest.approx(0.346410161514, abs=5e-13)


# Real arms


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ARMS)
def test_a_thousand_motions_of_real_arms(name: str) -> None:
    one, rng = arm(name), np.random.default_rng(1)
    for _ in range(28):
        start, target = one.configurations(rng, 2)
        bound = one.limits(rng)
        least = {law: _sound(start, target, law, bound) for law in LAWS}
        by_joint = [
            trapezoid_time(*row) for row in zip(np.abs(target - start), bound.velocity, bound.acceleration, strict=True)
        ]
        assert least["trapezoidal"] == pytest.approx(max(by_joint), rel=1e-12)
        line = _line(np.abs(target - start), bound)
        assert least["time_optimal"] == pytest.approx(least["trapezoidal"], rel=1e-12)
        by_itself = [
            jerk_limited_time(*row)
            for row in zip(np.abs(target - start), bound.velocity, bound.acceleration, bound.jerk, strict=True)
        ]
        assert max(by_itself) <= least["jerk_limited"] * (1.0 + 1e-9)
        assert least["jerk_limited"] <= jerk_limited_time(1.0, *line) * (1.0 + 1e-9)
        for law in LAWS:
            assert least["time_optimal"] <= least[law] * (1.0 + 1e-12)


def _line(steps: Array, bound: SegmentLimits) -> tuple[float, float, float]:
    return tuple(float((values / steps).min()) for values in (bound.velocity, bound.acceleration, bound.jerk))  # type: ignore[return-value]


def _sound(start: Array, target: Array, law: Law, bound: SegmentLimits) -> float:
    """The least duration of a motion that keeps what its law promises; so does a longer one."""
    motion = point_to_point_motion(start, target, law, bound)
    longer = point_to_point_motion(start, target, law, bound, 1.7 * motion.duration)
    assert longer.breaks[-1] == 1.7 * motion.duration
    for one in (motion, longer):
        for last, configuration in ((False, start), (True, target)):
            assert np.abs(end_state(one, 0, last=last) - configuration).max() <= 1e-9
            assert np.abs(end_state(one, 1, last=last)).max() <= 1e-9
            if law in WITH_JERK:
                assert np.abs(end_state(one, 2, last=last)).max() <= 1e-9
        assert excess(one, bound, jerk=law in WITH_JERK) <= 1e-9
        assert max(jump(one, 0), jump(one, 1)) <= 1e-9
        if law in WITH_JERK:
            assert jump(one, 2) <= 1e-9
    if law in {"cubic", "quintic", "septic"}:
        times = np.linspace(0.0, motion.duration, 50)
        s = (motion.at(times) - start) / (target - start)
        assert np.abs(s - s[:, :1]).max() <= 1e-9
    return motion.duration


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("n", [1, 32])
def test_any_number_of_joints(law: Law, n: int) -> None:
    rng = np.random.default_rng(n)
    start, target = rng.uniform(-2.0, 2.0, (2, n))
    _sound(start, target, law, limits([2.0] * n, [5.0] * n, 60.0))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("size", [1e-11, 1e-8, 1e-4, 1e4])
def test_tiny_and_huge_steps(law: Law, size: float) -> None:
    bound = limits([2.0, 1.0], [5.0, 3.0], 60.0)
    start, target = np.array([0.3, -0.2]), np.array([0.3, -0.2]) + size * np.array([1.0, -0.6])
    for duration in (None, 1e5, 1e9):
        motion = point_to_point_motion(start, target, law, bound, duration)
        assert np.isfinite(motion.coefficients).all()
        assert (np.diff(motion.breaks) > 0.0).all()
        assert np.abs(end_state(motion, 0, last=True) - target).max() <= 1e-9 * max(1.0, size)
        assert np.abs(end_state(motion, 1, last=True)).max() <= 1e-9
        assert excess(motion, bound, jerk=law in WITH_JERK) <= 1e-9


@pytest.mark.parametrize("law", LAWS)
def test_a_joint_that_stays_where_it_is(law: Law) -> None:
    start = np.array([0.5, -1.0, 0.2])
    target = start + np.array([1.0, 0.0, 1e-13])
    motion = point_to_point_motion(start, target, law, limits([1.0] * 3, [4.0] * 3, 40.0))
    assert (motion.at(np.linspace(0.0, motion.duration, 9))[:, 1] == -1.0).all()
    assert np.abs(end_state(motion, 0, last=True) - target).max() <= 1e-12


@pytest.mark.parametrize("law", LAWS)
def test_nowhere_to_go(law: Law) -> None:
    q = np.array([0.5, -1.0])
    bound = limits([1.0] * 2, [4.0] * 2, 40.0)
    motion = point_to_point_motion(q, q, law, bound)
    assert motion.duration == 0.0
    assert len(motion.breaks) == 2
    np.testing.assert_array_equal(motion.at(motion.breaks[-1:])[0], q)
    waiting = point_to_point_motion(q, q, law, bound, 3.0)
    assert waiting.duration == 3.0
    np.testing.assert_array_equal(waiting.at(np.linspace(0.0, 3.0, 4)), np.tile(q, (4, 1)))
    assert compared_point_to_point(q, q, law, bound) == (0.0, 0.0, 0.0, 0.0)


@pytest.mark.parametrize("law", LAWS)
def test_time_optimal_is_never_slower_than_uniform_scaling(law: Law) -> None:
    one, rng = arm("panda"), np.random.default_rng(5)
    for _ in range(10):
        start, target = one.configurations(rng, 2)
        found = compared_point_to_point(start, target, law, one.limits(rng))
        assert found.time_optimal_duration <= found.uniform_duration * (1.0 + 1e-12)
        scaled = max(found.velocity_factor, math.sqrt(found.acceleration_factor))
        assert scaled <= found.uniform_duration * (1.0 + 1e-9)
        if law not in WITH_JERK:
            assert scaled == pytest.approx(found.uniform_duration, rel=1e-9)


# Refusals


@pytest.mark.parametrize("law", LAWS)
def test_too_short_a_duration_says_what_is_the_least_and_for_whom(law: Law) -> None:
    start, target = np.zeros(3), np.array([0.1, -2.0, 0.3])
    bound = limits([1.0] * 3, [4.0] * 3, 40.0)
    least = point_to_point_motion(start, target, law, bound).duration
    with pytest.raises(InvalidField, match=r"at least \d.* s, when joint 2 reaches its limit of") as refusal:
        point_to_point_motion(start, target, law, bound, 0.5 * least)
    assert refusal.value.field == "duration"
    told = float(refusal.value.reason.split("at least ")[1].split(" s")[0])
    motion = point_to_point_motion(start, target, law, bound, told)
    assert motion.breaks[-1] == told
    assert excess(motion, bound, jerk=law in WITH_JERK) <= 1e-9


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("duration", [0.0, -1.0, math.nan, math.inf, 1e300])
def test_no_duration(law: Law, duration: float) -> None:
    with pytest.raises(InvalidField, match="greater than 0 s") as refusal:
        point_to_point_motion(np.zeros(1), np.ones(1), law, limits([1.0], [4.0]), duration)
    assert refusal.value.field == "duration"


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, 1e300])
def test_no_limit(law: Law, value: float) -> None:
    good = limits([1.0, 1.0], [4.0, 4.0], 40.0)
    for name in ("velocity", "acceleration", "jerk"):
        bad = replace(good, **{name: np.array([1.0, value])})  # type: ignore[arg-type]
        with pytest.raises(InvalidField, match="joint 2: must be a number from 1e-09 to 1e") as refusal:
            point_to_point_motion(np.zeros(2), np.ones(2), law, bad)
        assert refusal.value.field == f"limits.joint_{name}"


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("value", [math.nan, math.inf, -1e300])
def test_no_configuration(law: Law, value: float) -> None:
    good, bad = np.zeros(2), np.array([0.0, value])
    for name, start, target in (("start", bad, good), ("target", good, bad)):
        with pytest.raises(InvalidField, match="joint 2: must be of magnitude ≤ 1e") as refusal:
            point_to_point_motion(start, target, law, limits([1.0, 1.0], [4.0, 4.0]))
        assert refusal.value.field == name


@pytest.mark.parametrize("law", ["trapezoidal", "time_optimal"])
@pytest.mark.parametrize("distances", [[1.0], [1.0, 1e-9], [-1e-3, 2.0, 0.0]])
def test_an_acceleration_within_no_time(law: Law, distances: list[float]) -> None:
    n, target = len(distances), np.array(distances)
    found = point_to_point_motion(np.zeros(n), target, law, limits([1.0] * n, [1e9] * n))
    assert found.duration == pytest.approx(np.abs(target).max(), rel=1e-5)
    assert np.abs(peaks(found, 1).values).max() <= 1.0 + 1e-9
    np.testing.assert_allclose(found.at(found.breaks[-1:])[0], target, atol=1e-12)
