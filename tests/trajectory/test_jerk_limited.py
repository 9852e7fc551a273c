"""Jerk-limited motions against the closed form, against Ruckig, and by what they promise."""

import math

import numpy as np
import pytest
import ruckig

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.jerk_limited import at_rest, jerk_limited
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


def limits(*triples: tuple[float, float, float]) -> Array:
    """Velocity, acceleration and jerk of each joint."""
    return np.array(triples).T.copy()


def closed_form(distance: float, v: float, a: float, j: float) -> float:
    """The least duration from rest to rest of one joint [Biagiotti2008, 3.4]."""
    if distance >= v * (2.0 * math.sqrt(v / j) if v * j < a * a else v / a + a / j):
        return distance / v + (2.0 * math.sqrt(v / j) if v * j < a * a else v / a + a / j)
    if distance >= 2.0 * a**3 / j**2:
        peak = 0.5 * (math.sqrt((a * a / j) ** 2 + 4.0 * a * distance) - a * a / j)
        return 2.0 * (peak / a + a / j)
    return 4.0 * math.cbrt(distance / (2.0 * j))


def some(seed: int, *, is_moving: bool, n: int = 7) -> tuple[Array, Array, Array]:
    """Two states and limits that go from tame to wild."""
    rng = np.random.default_rng(seed)
    v = 10.0 ** rng.uniform(-2.0, 1.0, n)
    a = v * 10.0 ** rng.uniform(-0.5, 2.0, n)
    j = a * 10.0 ** rng.uniform(-0.5, 2.5, n)
    q = rng.uniform(-3.0, 3.0, n)
    distances = rng.uniform(-3.0, 3.0, n) * 10.0 ** rng.uniform(-4.0, 0.0, n)

    def state(positions: Array) -> Array:
        if not is_moving:
            return at_rest(positions)
        velocities = rng.uniform(-0.7, 0.7, n) * v
        most = np.minimum(a, np.sqrt(0.5 * v * j))
        return np.array([positions, velocities, rng.uniform(-0.7, 0.7, n) * most])

    return state(q), state(q + distances), np.array([v, a, j])


def ends_missed(motion: PiecewisePolynomial, start: Array, end: Array) -> float:
    worst = 0.0
    for time, state in ((motion.breaks[:1], start), (motion.breaks[-1:], end)):
        for order, wanted in enumerate(state):
            worst = max(worst, float(np.abs((motion.derivative(order) if order else motion).at(time) - wanted).max()))
    return worst


def by_ruckig(start: Array, end: Array, most: Array, shares: Array) -> tuple[float, Array]:
    """Its own duration and positions."""
    n = start.shape[1]
    task, found = ruckig.InputParameter(n), ruckig.Trajectory(n)
    task.current_position, task.current_velocity, task.current_acceleration = start
    task.target_position, task.target_velocity, task.target_acceleration = end
    task.max_velocity, task.max_acceleration, task.max_jerk = most
    ruckig.Ruckig(n).calculate(task, found)
    return found.duration, np.array([found.at_time(share * found.duration)[0] for share in shares])


@pytest.mark.slow
@pytest.mark.parametrize("is_moving", [False, True])
def test_it_ends_where_it_should_keeps_the_limits_and_is_smooth(is_moving: bool) -> None:
    for seed in range(200):
        start, end, most = some(seed, is_moving=is_moving)
        motion = jerk_limited(start, end, most)
        assert motion.coefficients.shape[1] == 4
        assert (np.diff(motion.breaks) > 0.0).all()
        assert ends_missed(motion, start, end) < 1e-9
        times = np.linspace(0.0, motion.duration, 2000)
        for order, bound in enumerate(most, start=1):
            derivative = motion.derivative(order)
            assert (np.abs(peaks(motion, order).values) <= bound * (1.0 + 2e-9)).all()
            assert (np.abs(derivative.at(times)) <= bound * (1.0 + 2e-9)).all()
            if order < 3:
                before = PiecewisePolynomial(derivative.breaks[:-1], derivative.coefficients[:-1])
                gaps = np.abs(before.at(motion.breaks[1:-1] * (1.0 - 1e-16)) - derivative.at(motion.breaks[1:-1]))
                assert (gaps <= 1e-9 * bound).all()


@pytest.mark.parametrize("is_moving", [False, True])
def test_a_joint_alone_moves_as_ruckig_samples_it(is_moving: bool) -> None:
    shares = np.linspace(0.0, 1.0, 37)
    for seed in range(100):
        start, end, most = some(seed, is_moving=is_moving, n=1)
        duration, expected = by_ruckig(start, end, most, shares)
        motion = jerk_limited(start, end, most)
        assert motion.duration == pytest.approx(duration, rel=1e-9)
        np.testing.assert_allclose(motion.at(shares * motion.duration), expected, atol=1e-7)


def any_states(rng: np.random.Generator, n: int) -> tuple[Array, Array, Array]:
    """Two states anywhere within limits that go from tame to wild, as far as they can come from and lead into them."""
    v = 10.0 ** rng.uniform(-2.0, 1.0, n)
    a = v * 10.0 ** rng.uniform(-0.5, 2.0, n)
    j = a * 10.0 ** rng.uniform(-0.5, 2.5, n)
    states = []
    for side in (1.0, -1.0):
        accelerations = rng.uniform(-0.999, 0.999, n) * np.minimum(a, np.sqrt(2.0 * v * j))
        swing = side * 0.5 * accelerations * np.abs(accelerations) / j
        low, high = -v - np.minimum(swing, 0.0), v - np.maximum(swing, 0.0)
        positions = rng.uniform(-3.0, 3.0, n) * 10.0 ** rng.uniform(-4.0, 0.0, n)
        states.append(np.array([positions, rng.uniform(low, high), accelerations]))
    return states[0], states[1], np.array([v, a, j])


@pytest.mark.slow
@pytest.mark.parametrize("n", [1, 3])
def test_ten_thousand_motions_take_as_long_as_ruckigs(n: int) -> None:
    rng = np.random.default_rng(n)
    for _ in range(10_000 // n):
        start, end, most = any_states(rng, n)
        motion = jerk_limited(start, end, most)
        assert motion.duration == pytest.approx(by_ruckig(start, end, most, np.zeros(0))[0], rel=1e-9)


def passing(rng: np.random.Generator) -> tuple[Array, Array, Array]:
    """One joint passes two places at speed, and is soon at the second one, or much later; the other takes some time."""
    start, end = np.array([[0.0, 0.0], [0.6, 0.0], [0.0, 0.0]]), np.array([[0.4, 0.2], [0.6, 0.0], [0.0, 0.0]])
    start[1, 0], end[1, 0], end[0, 1] = *rng.uniform(0.3, 0.9, 2), rng.uniform(0.01, 0.2)
    return start, end, limits((1.0, 2.0, 8.0), (1.0, *rng.uniform(1.0, 9.0, 2)))


def test_joints_that_cannot_take_each_others_time_take_the_next_one() -> None:
    """Ruckig's own wait for a gap in the times that a joint can take."""
    waited = 0
    for seed in range(60):
        start, end, most = passing(np.random.default_rng(seed))
        duration, _ = by_ruckig(start, end, most, np.zeros(0))
        assert jerk_limited(start, end, most).duration == pytest.approx(duration, rel=1e-9)
        alone = max(jerk_limited(start[:, [j]], end[:, [j]], most[:, [j]]).duration for j in range(2))
        waited += duration > alone * (1.0 + 1e-6)
    assert waited > 5


def test_a_given_time_is_taken_or_refused_with_one_that_is_possible() -> None:
    refused = 0
    for seed in range(100):
        rng = np.random.default_rng(seed)
        start, end, most = any_states(rng, 2) if seed % 2 else passing(rng)
        least = jerk_limited(start, end, most).duration
        wanted = least * rng.uniform(1.0, 1.5)
        try:
            motion = jerk_limited(start, end, most, wanted)
        except InvalidField as error:
            refused += 1
            assert error.field == "duration"
            wanted = float(error.reason.split()[-2]) * (1.0 + 1e-9)
            motion = jerk_limited(start, end, most, wanted)
        assert motion.duration == pytest.approx(wanted, rel=1e-12)
        assert ends_missed(motion, start, end) < 1e-9
        for order, bound in enumerate(most, start=1):
            assert (np.abs(peaks(motion, order).values) <= bound * (1.0 + 2e-9)).all()
        with pytest.raises(InvalidField, match=r"must be at least|not all joints"):
            jerk_limited(start, end, most, least * 0.999)
    assert refused > 0


@pytest.mark.parametrize(
    ("distance", "v", "a", "j"),
    [
        (10.0, 1.0, 2.0, 4.0),  # cruises, and reaches the acceleration
        (10.0, 1.0, 5.0, 4.0),  # cruises
        (1.0, 5.0, 1.0, 4.0),  # reaches the acceleration
        (0.01, 5.0, 1.0, 4.0),  # reaches neither
        (1e-9, 2.0, 10.0, 100.0),
        (-3.0, 2.0, 10.0, 100.0),
    ],
)
def test_the_duration_from_rest_to_rest_is_the_closed_form(distance: float, v: float, a: float, j: float) -> None:
    motion = jerk_limited(at_rest(np.array([0.3])), at_rest(np.array([0.3 + distance])), limits((v, a, j)))
    # What is left of a distance after it was added to 0.3.
    assert motion.duration == pytest.approx(closed_form(abs(0.3 + distance - 0.3), v, a, j), rel=1e-9)


def test_joints_end_together_with_the_slowest() -> None:
    for seed in range(100):
        start, end, most = some(seed, is_moving=False)
        alone = [closed_form(abs(d), v, a, j) for d, v, a, j in zip(end[0] - start[0], *most, strict=True)]
        assert jerk_limited(start, end, most).duration == pytest.approx(max(alone), rel=1e-8)


@pytest.mark.parametrize(
    ("distance", "duration"), [(2.0, 3.0), (0.3, 0.866025403784), (0.4, 1.0)], ids=["coast", "none", "limit"]
)
def test_with_a_huge_jerk_it_is_the_trapezoid(distance: float, duration: float) -> None:
    motion = jerk_limited(at_rest(np.zeros(1)), at_rest(np.array([distance])), limits((0.8, 1.6, 1e7)))
    assert motion.duration == pytest.approx(duration, abs=1e-6)
    share = np.linspace(0.0, 1.0, 11)
    ramp = 0.8 / 1.6 if distance > 0.4 else 0.5 * duration
    t = share * duration
    peak = 1.6 * ramp
    expected = np.select(
        [t <= ramp, t <= duration - ramp],
        [0.8 * t**2, peak * t - peak * ramp / 2.0],
        distance - 0.8 * (duration - t) ** 2,
    )
    np.testing.assert_allclose(motion.at(share * motion.duration)[:, 0], expected, atol=1e-6)


def test_back_in_time_takes_as_long() -> None:
    for seed in range(100):
        start, end, most = some(seed, is_moving=True, n=1)
        backwards = np.array([[1.0], [-1.0], [1.0]])
        back = jerk_limited(backwards * end, backwards * start, most)
        assert back.duration == pytest.approx(jerk_limited(start, end, most).duration, rel=1e-6)


def test_no_distance_and_no_joints() -> None:
    q = np.array([1.0, -2.0])
    most = limits((1.0, 1.0, 1.0), (1.0, 1.0, 1.0))
    still = jerk_limited(at_rest(q), at_rest(q), most)
    assert still.duration == 0.0
    np.testing.assert_array_equal(still.at(np.array([0.0])), q[None])
    nothing = at_rest(np.empty(0))
    none = jerk_limited(nothing, nothing, np.empty((3, 0)))
    assert (none.duration, none.at(np.zeros(1)).shape) == (0.0, (1, 0))


def test_limits_far_apart_still_end_where_they_should() -> None:
    start, end = at_rest(np.zeros(2)), at_rest(np.array([1.0, 2.0]))
    for triple in ((1.0, 1.0, 1e9), (1e9, 1.0, 1.0), (1.0, 1e9, 1.0)):
        motion = jerk_limited(start, end, limits(triple, (1.0, 1.0, 1.0)))
        assert ends_missed(motion, start, end) < 1e-9


ONES = at_rest(np.ones(2))
MOST = limits((1.0, 1.0, 1.0), (1.0, 1.0, 1.0))


def with_one(values: Array, row: int, joint: int, value: float) -> Array:
    changed = values.copy()
    changed[row, joint] = value
    return changed


@pytest.mark.parametrize(
    ("field", "changes"),
    [
        ("limits.joint_velocity", {"limits": with_one(MOST, 0, 1, 0.0)}),
        ("limits.joint_acceleration", {"limits": with_one(MOST, 1, 0, -1.0)}),
        ("limits.joint_jerk", {"limits": with_one(MOST, 2, 1, np.nan)}),
        ("limits.joint_jerk", {"limits": with_one(MOST, 2, 0, np.inf)}),
        ("start", {"start": with_one(ONES, 0, 1, 1e300)}),
        ("end", {"end": with_one(ONES, 0, 0, np.nan)}),
        ("start_velocities", {"start": with_one(ONES, 1, 0, 1.1)}),
        ("end_velocities", {"end": with_one(ONES, 1, 1, -1.1)}),
        ("start_accelerations", {"start": with_one(ONES, 2, 1, 1.1)}),
        ("end_accelerations", {"end": with_one(ONES, 2, 0, np.inf)}),
        ("start_accelerations", {"start": np.array([[0.0, 0.0], [0.6, 0.0], [1.0, 0.0]])}),  # too fast soon after
        ("end_accelerations", {"end": np.array([[0.0, 0.0], [0.6, 0.0], [-1.0, 0.0]])}),  # too fast shortly before
        ("duration", {"duration": 1.0}),
    ],
)
def test_what_cannot_be_is_refused_by_name(field: str, changes: dict[str, object]) -> None:
    task: dict[str, object] = {"start": at_rest(np.zeros(2)), "end": ONES, "limits": MOST, **changes}
    with pytest.raises(InvalidField) as refused:
        jerk_limited(**task)  # type: ignore[arg-type]
    assert refused.value.field == field
