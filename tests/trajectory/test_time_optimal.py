"""The fastest motion along a path against closed forms, a linear program, TOPP-RA's authors, and what it promises."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from gelenk.errors import InvalidField, TooLarge
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.timing.time_optimal import TimeOptimal, time_optimal
from tests.oracles import path_speeds


def spline(knots: Array, s: Array | None = None, boundary: str = "not-a-knot") -> PiecewisePolynomial:
    """A cubic spline through knots of shape (N, n)."""
    s = np.linspace(0.0, 1.0, len(knots)) if s is None else s
    by_scipy = CubicSpline(s, knots, bc_type=boundary)
    return PiecewisePolynomial(by_scipy.x, by_scipy.c[::-1].swapaxes(0, 1).copy())


def line(start: list[float], end: list[float]) -> PiecewisePolynomial:
    return PiecewisePolynomial(np.array([0.0, 1.0]), np.array([[start, np.subtract(end, start)]]))


def task(seed: int, n: int = 7, count: int = 5) -> tuple[Array, Array, Array]:
    """Knots and limits."""
    rng = np.random.default_rng(seed)
    return rng.uniform(-2.0, 2.0, (count, n)), rng.uniform(1.0, 3.0, n), rng.uniform(3.0, 15.0, n)


def trapezoid(distance: float, v: float, a: float) -> float:
    """The course's bang-coast-bang."""
    return distance / v + v / a if distance > v * v / a else 2.0 * float(np.sqrt(distance / a))


def ratios(
    motion: PiecewisePolynomial, velocity: Array, acceleration: Array, per_piece: int = 10
) -> tuple[Array, Array]:
    """|q̇| and |q̈| in fractions of their limits, at many times in each piece; both of shape (N, n)."""
    shares = np.linspace(0.0, 1.0, per_piece, endpoint=False)
    times = (motion.breaks[:-1, None] + shares * np.diff(motion.breaks)[:, None]).ravel()
    return (
        np.abs(motion.derivative(1).at(times)) / velocity,
        np.abs(motion.derivative(2).at(times)) / acceleration,
    )


def assert_sound(found: TimeOptimal, path: PiecewisePolynomial, velocity: Array, acceleration: Array) -> None:
    """Along the path, forwards, from end to end, with no limit passed anywhere."""
    motion, law = found.motion, found.time_law
    assert (np.diff(motion.breaks) > 0.0).all()
    np.testing.assert_array_equal(motion.breaks, law.breaks)
    times = np.linspace(0.0, motion.duration, 3001)
    s = law.at(times)[:, 0]
    assert (np.diff(s) > -1e-12 * path.duration).all()
    np.testing.assert_allclose(s[[0, -1]], path.breaks[[0, -1]], atol=1e-12 * path.duration)
    size = np.abs(path.coefficients[:, 0]).max() + 1.0
    np.testing.assert_allclose(motion.at(times), path.at(s), atol=1e-11 * size)
    for found_ratios in ratios(motion, velocity, acceleration):
        assert found_ratios.max() <= 1.0
    for order, limit in ((1, velocity), (2, acceleration)):
        assert (np.abs(peaks(motion, order).values) <= limit).all()
    assert_joined(motion, 1e-9 * size)


def assert_joined(motion: PiecewisePolynomial, tolerance: float) -> None:
    """Where each piece ends, the next one goes on: in position and velocity."""
    lengths = np.diff(motion.breaks)[:-1, None]
    for order in (0, 1):
        c = motion.derivative(order).coefficients
        ends = sum(c[:-1, k] * lengths**k for k in range(c.shape[1]))
        np.testing.assert_allclose(ends, c[1:, 0], rtol=0.0, atol=tolerance)


def test_a_velocity_that_jumps_at_a_join_is_seen() -> None:
    motion = time_optimal(spline(task(0)[0]), *task(0)[1:]).motion
    assert_joined(motion, 1e-9)
    shifted = motion.coefficients.copy()
    shifted[7, 1] += 1e-6
    with pytest.raises(AssertionError):
        assert_joined(PiecewisePolynomial(motion.breaks, shifted), 1e-9)


# Closed forms


@pytest.mark.parametrize(
    ("distances", "v", "a", "duration"),
    [
        ([2.0], [0.8], [1.6], 3.0),
        ([-0.3], [0.8], [1.6], 0.866025403784),
        ([0.4], [0.8], [1.6], 1.0),
        ([-1.0, 0.7], [0.5, 0.8], [0.8, 0.5], 2.7),
        ([1e3, 1.0], [1.0, 1.0], [1.0, 1.0], 1001.0),
        ([1e-9], [1.0], [1.0], 2.0 * 1e-9**0.5),
    ],
)
def test_along_a_straight_line_it_is_the_trapezoid(
    distances: list[float], v: list[float], a: list[float], duration: float
) -> None:
    path, velocity, acceleration = line([0.0] * len(v), distances), np.array(v), np.array(a)
    found = time_optimal(path, velocity, acceleration)
    assert found.motion.duration == pytest.approx(duration, rel=2e-9, abs=1e-12 if duration < 1.0 else 0.0)
    assert_sound(found, path, velocity, acceleration)


# Other ways to the same number


@pytest.mark.parametrize("seed", range(6))
def test_it_takes_as_long_as_a_linear_program_says(seed: int) -> None:
    knots, v, a = task(seed, n=2 + seed % 3, count=4)
    path = spline(knots)
    expected = path_speeds.duration(path.derivative().at, path.derivative(2).at, v, a, 1200)
    found = time_optimal(path, v, a)
    assert_sound(found, path, v, a)
    assert expected * 0.998 < found.motion.duration < expected * 1.01


@pytest.mark.quick(3)
@pytest.mark.parametrize("seed", range(10))
def test_it_is_within_two_percent_of_another_implementation_on_a_finer_grid(seed: int) -> None:
    toppra = pytest.importorskip("toppra")
    knots, v, a = task(seed)
    kind = toppra.constraint.DiscretizationType.Interpolation
    limits = [
        toppra.constraint.JointVelocityConstraint(np.stack((-v, v), axis=1)),
        toppra.constraint.JointAccelerationConstraint(np.stack((-a, a), axis=1), discretization_scheme=kind),
    ]
    s, grid = np.linspace(0.0, 1.0, len(knots)), np.linspace(0.0, 1.0, 2001)
    other = toppra.algorithm.TOPPRA(limits, toppra.SplineInterpolator(s, knots, "not-a-knot"), gridpoints=grid)
    _, speeds, _ = other.compute_parameterization(0.0, 0.0)
    theirs = float((2.0 * np.diff(grid) / (speeds[1:] + speeds[:-1])).sum())
    found = time_optimal(spline(knots), v, a)
    assert theirs * 0.999 < found.motion.duration < theirs * 1.02
    assert_sound(found, spline(knots), v, a)


def test_some_joint_is_at_a_limit_nearly_always() -> None:
    for seed in range(10):
        knots, v, a = task(seed)
        motion = time_optimal(spline(knots), v, a).motion
        lasting = np.repeat(np.diff(motion.breaks) / 10.0, 10) / motion.duration
        largest = np.maximum(*ratios(motion, v, a)).max(axis=1)
        assert (largest * lasting).sum() > 0.98
        assert lasting[largest > 0.95].sum() > 0.95


@pytest.mark.parametrize("boundary", ["clamped", "natural", "not-a-knot"])
def test_it_is_not_slower_than_uniform_scaling(boundary: str) -> None:
    for seed in range(10):
        knots, v, a = task(seed)
        path = spline(knots, boundary=boundary)
        # s = 3τ² - 2τ³ from rest to rest, slowed down until the limits hold.
        fine = np.linspace(0.0, 1.0, 2001)[:, None]
        s, rate, bend = 3.0 * fine**2 - 2.0 * fine**3, 6.0 * fine * (1.0 - fine), 6.0 - 12.0 * fine
        slope, curve = path.derivative(1).at(s[:, 0]), path.derivative(2).at(s[:, 0])
        k = max(
            float((np.abs(slope * rate) / v).max()),
            float(np.sqrt((np.abs(slope * bend + curve * rate**2) / a).max())),
        )
        assert time_optimal(path, v, a).motion.duration < k


def test_a_time_law_is_a_path_too() -> None:
    """A motion that was planned before, with q' = 0 at both ends, taken as the path."""
    cubic = PiecewisePolynomial(np.array([0.0, 2.0]), np.array([[[0.0], [0.0], [0.75], [-0.25]]]))
    quintic = PiecewisePolynomial(np.array([-1.0, 0.0]), np.array([[[0.0], [0.0], [0.0], [10.0], [-15.0], [6.0]]]))
    one = np.ones(1)
    for path, loss in ((cubic, 0.002), (quintic, 0.01)):
        found = time_optimal(path, one, one)
        assert_sound(found, path, one, one)
        assert 2.0 <= found.motion.duration < 2.0 * (1.0 + loss)


def test_round_a_circle_where_each_joint_turns_back() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 17)
    path = spline(np.stack((np.cos(angle), np.sin(angle)), axis=1).round(15), angle, "periodic")
    v, a = np.array([5.0, 5.0]), np.array([1.0, 1.0])
    found, finer = time_optimal(path, v, a), time_optimal(path, v, a, intervals=2000)
    for each in (found, finer):
        assert_sound(each, path, v, a)
    assert found.motion.duration < 1.003 * finer.motion.duration


def test_wild_paths_keep_the_limits_and_are_near_the_optimum() -> None:
    rng = np.random.default_rng(3)
    for n in (1, 2, 3, 7):
        s = np.sort(rng.uniform(0.0, 1.0, 30))
        path, v, a = spline(rng.uniform(-2.0, 2.0, (30, n)), s), np.full(n, 2.0), np.full(n, 8.0)
        found = time_optimal(path, v, a)
        assert_sound(found, path, v, a)
        assert found.motion.duration < 1.025 * time_optimal(path, v, a, intervals=2000).motion.duration


def test_more_intervals_come_nearer_to_the_optimum() -> None:
    knots, v, a = task(1)
    durations = [time_optimal(spline(knots), v, a, intervals=count).motion.duration for count in (50, 200, 1000)]
    assert durations[0] > durations[1] > durations[2] > 0.99 * durations[1]


# What must not matter


def test_the_parameter_the_units_and_the_direction_do_not_matter() -> None:
    for seed in range(5):
        knots, v, a = task(seed)
        path = spline(knots)
        duration = time_optimal(path, v, a).motion.duration
        stretched = PiecewisePolynomial(3.0 + 1e4 * path.breaks, path.scaled(1e4).coefficients)
        assert time_optimal(stretched, v, a).motion.duration == pytest.approx(duration, rel=1e-6)
        assert time_optimal(path, 10.0 * v, 100.0 * a).motion.duration == pytest.approx(duration / 10.0, rel=1e-6)
        millimetres = PiecewisePolynomial(path.breaks, 1e3 * path.coefficients)
        assert time_optimal(millimetres, 1e3 * v, 1e3 * a).motion.duration == pytest.approx(duration, rel=1e-6)
        assert time_optimal(spline(knots[::-1]), v, a).motion.duration == pytest.approx(duration, rel=5e-3)


def test_it_slows_down_by_a_factor_of_each_place() -> None:
    """Everywhere k, the motion is scaled by k; on one half, k reserves the limits there and little elsewhere."""
    knots, velocity, acceleration = task(4)
    path = spline(knots)
    fastest = time_optimal(path, velocity, acceleration)
    slow = time_optimal(path, velocity, acceleration, slower=lambda nodes: np.full(len(nodes) - 1, 2.0))
    assert slow.motion.duration == pytest.approx(2.0 * fastest.motion.duration, rel=1e-9)
    half = time_optimal(path, velocity, acceleration, slower=lambda nodes: np.where(nodes[1:] > 0.5, 2.0, 1.0))
    assert_sound(half, path, velocity, acceleration)
    late = half.time_law.at(half.motion.breaks[:-1])[:, 0] >= 0.5
    for order, found in enumerate(ratios(half.motion, velocity, acceleration), start=1):
        assert found.reshape(len(late), -1)[late].max() <= 0.5**order * (1.0 + 1e-9)
    assert 1.2 * fastest.motion.duration < half.motion.duration < slow.motion.duration


def test_sizes_from_no_joint_to_many_and_many_pieces() -> None:
    nothing = time_optimal(PiecewisePolynomial(np.array([0.0, 1.0]), np.zeros((1, 2, 0))), np.empty(0), np.empty(0))
    assert nothing.motion.duration == 0.0
    rng = np.random.default_rng(0)
    for n, count in ((1, 2), (32, 5), (2, 300)):
        path = spline(np.cumsum(rng.uniform(0.0, 1.0, (count, n)), axis=0))
        v, a = np.full(n, 2.0), np.full(n, 8.0)
        assert_sound(time_optimal(path, v, a), path, v, a)


def test_a_path_of_no_length_takes_no_time() -> None:
    path = line([1.0, 2.0], [1.0, 2.0 + 1e-14])
    found = time_optimal(path, np.ones(2), np.ones(2))
    assert found.motion.duration == found.time_law.duration == 0.0
    np.testing.assert_allclose(found.motion.at(np.zeros(1)), [[1.0, 2.0]], atol=1e-13)


# What cannot be

STRAIGHT = line([0.0, 0.0], [1.0, 1.0])
ONE = np.ones(2)


def in_pieces(*coefficients: list[list[float]]) -> PiecewisePolynomial:
    return PiecewisePolynomial(np.arange(len(coefficients) + 1.0), np.array(coefficients))


@pytest.mark.parametrize(
    ("field", "changes"),
    [
        ("limits.joint_velocity", {"velocity": np.array([1.0, 0.0])}),
        ("limits.joint_velocity", {"velocity": np.array([np.nan, 1.0])}),
        ("limits.joint_acceleration", {"acceleration": np.array([1.0, -1.0])}),
        ("limits.joint_acceleration", {"acceleration": np.array([np.inf, 1.0])}),
        ("path", {"path": line([0.0, 0.0], [1.0, np.nan])}),
        ("path", {"path": line([0.0, 0.0], [1.0, 1e300])}),
        ("path", {"path": in_pieces([[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [0.0, 0.0]])}),  # stands still
    ],
)
def test_what_cannot_be_is_refused_by_name(field: str, changes: dict[str, object]) -> None:
    asked: dict[str, object] = {"path": STRAIGHT, "velocity": ONE, "acceleration": ONE, **changes}
    with pytest.raises(InvalidField) as refused:
        time_optimal(**asked)  # type: ignore[arg-type]
    assert refused.value.field == field


def test_paths_of_too_many_pieces_are_refused() -> None:
    count = 17_000
    coefficients = np.stack((np.arange(float(count)), np.ones(count)), axis=1)[:, :, None].repeat(2, axis=2)
    with pytest.raises(TooLarge):
        time_optimal(PiecewisePolynomial(np.arange(count + 1.0), coefficients), ONE, ONE)
