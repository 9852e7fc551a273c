"""Cubic, quintic, septic and 4-3-4: the lecture's numbers, and the conditions as systems of equations."""

from math import factorial

import numpy as np
import pytest
from scipy.interpolate import BPoly, CubicHermiteSpline

from gelenk.course.motion.check import MotionClaims, certified
from gelenk.course.motion.time_law_steps import lift_steps, peak_step, two_point_steps
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import Peaks, candidates, peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import between, hermite_pieces, normalised, quartic_cubic_quartic


def column(*values: float) -> Array:
    return np.array(values, dtype=float)[:, None]


def printed(value: float, text: str) -> bool:
    """Whether a number is the printed one, to its last digit."""
    decimals = len(text.partition(".")[2])
    return abs(value - float(text)) <= 0.5000001 * 10.0**-decimals


def highest_first(motion: PiecewisePolynomial, piece: int = 0) -> list[float]:
    found: list[float] = motion.coefficients[piece, ::-1, 0].tolist()
    return found


def from_conditions(starts: Array, ends: Array, duration: float) -> Array:
    """Coefficients, lowest power first, from the conditions written down as equations and solved."""
    m = len(starts)
    A = np.zeros((2 * m, 2 * m))
    for d in range(m):
        for k in range(d, 2 * m):
            A[d, k] = factorial(d) if k == d else 0.0
            A[m + d, k] = factorial(k) / factorial(k - d) * duration ** (k - d)
    return np.asarray(np.linalg.solve(A, np.concatenate([starts, ends])))


# Cubic

CUBIC = (column(0.2, 0.5), column(1.4, -0.3))


def test_the_cubic_of_the_lecture_in_one_second() -> None:
    motion = between(*CUBIC, 1.0)
    (found,) = normalised(motion, np.array([1.2]))
    assert found is not None
    for value, text in zip(found, ("-1.833333333", "2.416666667", ".416666667", "0"), strict=True):
        assert printed(value, text)
    times = np.array([0.0, 0.5, 1.0])
    assert motion.at(times)[1, 0] == pytest.approx(0.9, abs=1e-14)
    assert motion.derivative().at(times)[1, 0] == pytest.approx(1.75, abs=1e-14)
    assert motion.derivative(2).at(times)[[0, 2], 0] == pytest.approx([5.8, -7.4], abs=1e-13)


def test_the_cubic_of_the_lecture_in_two_seconds() -> None:
    motion = between(*CUBIC, 2.0)
    (found,) = normalised(motion, np.array([1.2]))
    assert found is not None
    for value, text in zip(found, ("-1.666666667", "1.833333333", ".833333333", "0"), strict=True):
        assert printed(value, text)
    assert highest_first(motion) == pytest.approx([-0.25, 0.55, 0.5, 0.2], abs=1e-15)
    assert motion.at(np.array([1.0]))[0, 0] == pytest.approx(1.0, abs=1e-15)
    fastest = peaks(motion, 1)
    assert printed(fastest.values[0], ".903333333")
    assert printed(fastest.times[0] / 2.0, ".366666667")


def test_from_rest_to_rest_a_cubic_peaks_at_three_halves_and_six() -> None:
    motion = between(column(0.0, 0.0), column(1.5, 0.0), 3.0)
    assert normalised(motion, np.array([1.5])) == [[-2.0, 3.0, 0.0, 0.0]]
    assert peaks(motion, 1).values[0] == pytest.approx(1.5 * 1.5 / 3.0)
    assert abs(peaks(motion, 2).values[0]) == pytest.approx(6.0 * 1.5 / 9.0)
    assert peaks(motion, 2).times[0] == 0.0


def test_without_displacement_there_is_the_general_form_alone() -> None:
    motion = between(column(0.2, 0.5), column(0.2, -0.3), 2.0)
    assert highest_first(motion) == pytest.approx([0.05, -0.35, 0.5, 0.2], abs=1e-15)
    assert normalised(motion, np.zeros(1)) == [None]


# Quintic and septic


def test_the_quintic_of_the_lecture() -> None:
    motion = between(column(0.2, 0.5, 0.1), column(1.4, -0.3, 0.2), 2.0)
    assert highest_first(motion) == pytest.approx([0.19375, -0.9, 1.025, 0.05, 0.5, 0.2], abs=1e-14)
    assert motion.at(np.array([1.0]))[0, 0] == pytest.approx(1.06875, abs=1e-14)


@pytest.mark.parametrize(
    ("rates", "coefficients"),
    [(3, [6, -15, 10, 0, 0, 0]), (4, [-20, 70, -84, 35, 0, 0, 0, 0])],
    ids=["quintic", "septic"],
)
def test_from_rest_to_rest(rates: int, coefficients: list[float]) -> None:
    ends = np.zeros((rates, 1))
    ends[0] = 2.5
    motion = between(np.zeros((rates, 1)), ends, 4.0)
    assert normalised(motion, np.array([2.5]))[0] == pytest.approx(coefficients, abs=1e-12)


def test_peaks_of_the_quintic_from_rest_to_rest() -> None:
    motion = between(np.zeros((3, 1)), column(2.5, 0.0, 0.0), 4.0)
    assert peaks(motion, 1).values[0] == pytest.approx(1.875 * 2.5 / 4.0, abs=1e-14)
    assert printed(abs(peaks(motion, 2).values[0]) * 16.0 / 2.5, "5.773502692")


@pytest.mark.parametrize("rates", [2, 3, 4])
def test_a_thousand_random_laws_meet_their_conditions(rates: int) -> None:
    rng = np.random.default_rng(rates)
    starts, ends = rng.normal(size=(2, rates, 1000, 3))
    durations = 10.0 ** rng.uniform(-2.0, 2.0, 1000)
    scale = durations[:, None] ** -np.arange(rates)[:, None, None]
    pieces = hermite_pieces(starts * scale, ends * scale, durations)
    for i in range(1000):
        motion = PiecewisePolynomial(np.array([0.0, durations[i]]), pieces[i : i + 1])
        for k in range(rates):
            at_ends = motion.derivative(k).at(motion.breaks) * durations[i] ** k
            assert np.abs(at_ends - [starts[k, i], ends[k, i]]).max() < 1e-9
    for i in range(0, 1000, 50):
        rivals = from_conditions(starts[:, i], ends[:, i], 1.0)
        found = pieces[i] * durations[i] ** np.arange(2 * rates)[:, None]
        assert np.abs(found - rivals).max() < 1e-10 * np.abs(rivals).max()


def test_pieces_are_those_of_scipy() -> None:
    rng = np.random.default_rng(5)
    times = np.cumsum(rng.uniform(0.1, 2.0, 8))
    q, v, a = rng.normal(size=(3, 8, 2))
    fine = np.linspace(times[0], times[-1], 500)
    cubic = PiecewisePolynomial(
        times, hermite_pieces(np.array([q, v])[:, :-1], np.array([q, v])[:, 1:], np.diff(times))
    )
    assert np.abs(cubic.at(fine) - CubicHermiteSpline(times, q, v)(fine)).max() < 1e-12
    both = np.array([q, v, a])
    quintic = PiecewisePolynomial(times, hermite_pieces(both[:, :-1], both[:, 1:], np.diff(times)))
    rival = BPoly.from_derivatives(times, np.moveaxis(both, 0, 1))
    assert np.abs(quintic.at(fine) - rival(fine)).max() < 1e-12


# 4-3-4


def test_the_434_of_the_lecture() -> None:
    motion = quartic_cubic_quartic(np.array([0.0, 0.5, 1.5, 2.0]), column(0.0, 0.3, 1.2, 1.5))
    assert highest_first(motion, 0) == pytest.approx([-5.6, 5.2, 0, 0, 0], abs=1e-13)
    assert highest_first(motion, 1) == pytest.approx([0, 0.4, -0.6, 1.1, 0.3], abs=1e-13)
    assert highest_first(motion, 2) == pytest.approx([5.6, -6.0, 0.6, 1.1, 1.2], abs=1e-13)
    assert motion.derivative().at(np.array([0.5, 1.5]))[:, 0] == pytest.approx([1.1, 1.1], abs=1e-13)


@pytest.mark.slow
def test_a_thousand_random_434_are_smooth_and_meet_their_fourteen_conditions() -> None:
    rng = np.random.default_rng(434)
    for _ in range(1000):
        times = np.concatenate([[rng.normal()], rng.uniform(0.2, 3.0, 3)]).cumsum()
        knots, starts, ends = rng.normal(size=(4, 2)), rng.normal(size=(2, 2)), rng.normal(size=(2, 2))
        motion = quartic_cubic_quartic(times, knots, starts, ends)
        promise = MotionClaims(times, knots, starts, ends, 2, {})
        found = certified(motion, promise)
        assert max(found.boundary_error, found.knot_error, found.continuity_error) < 1e-11
        assert np.abs(motion.at(times) - knots).max() < 1e-9
        for order, (first, last) in enumerate(zip(starts, ends, strict=True), start=1):
            assert np.abs(motion.derivative(order).at(times[[0, -1]]) - [first, last]).max() < 1e-9
        assert np.all(motion.coefficients[1, 4] == 0.0)


# Extremes


@pytest.mark.parametrize("degree", range(8))
def test_peaks_are_those_of_a_fine_grid(degree: int) -> None:
    rng = np.random.default_rng(degree)
    for _ in range(40):
        breaks = np.cumsum(rng.uniform(0.1, 2.0, 5)) + rng.normal()
        coefficients = rng.normal(size=(4, degree + 1, 3)) * (rng.random((4, degree + 1, 3)) > 0.3)
        motion = PiecewisePolynomial(breaks, coefficients)
        for order in (1, 2, 3):
            found, derived = peaks(motion, order), motion.derivative(order)
            values = []
            for i in range(4):
                piece = PiecewisePolynomial(breaks[i : i + 2], derived.coefficients[i : i + 1])
                values.append(piece.at(np.linspace(breaks[i], breaks[i + 1], 400)))
            rival = np.abs(np.concatenate(values)).max(axis=0)
            assert np.all(np.abs(found.values) >= rival * (1.0 - 1e-9))
            assert np.all(np.abs(found.values) <= rival * (1.0 + 2e-3) + 1e-12)


def test_of_two_equal_peaks_the_first_is_told() -> None:
    motion = between(np.zeros((3, 1)), column(1.0, 0.0, 0.0), 1.0)
    assert peaks(motion, 2).times[0] == pytest.approx(0.5 - np.sqrt(3.0) / 6.0, abs=1e-12)


def test_a_motion_of_no_duration_has_its_candidates() -> None:
    times, values = candidates(PiecewisePolynomial(np.zeros(2), np.ones((1, 3, 1))))
    assert np.isfinite(times).all()
    assert np.isfinite(values).all()


@pytest.mark.parametrize("wrong", ["knot", "start", "end", "peak", "time", "join"])
def test_what_is_wrong_is_withheld(wrong: str) -> None:
    times, knots = np.array([0.0, 0.5, 1.5, 2.0]), column(0.0, 0.3, 1.2, 1.5)
    motion = quartic_cubic_quartic(times, knots)
    rest, found = np.zeros((2, 1)), {order: peaks(motion, order) for order in (1, 2, 3)}
    good = MotionClaims(times, knots, rest, rest, 2, found)
    assert certified(motion, good).peak_error < 1e-12
    off = rest + np.array([[0.0], [1e-6]])
    bad = {
        "knot": MotionClaims(times, knots + 1e-6, rest, rest, 2, found),
        "start": MotionClaims(times, knots, off, rest, 2, found),
        "end": MotionClaims(times, knots, rest, off, 2, found),
        "peak": MotionClaims(times, knots, rest, rest, 2, {1: Peaks(found[1].values * (1 - 1e-6), found[1].times)}),
        "time": MotionClaims(times, knots, rest, rest, 2, {1: Peaks(found[1].values, found[1].times + 0.1)}),
        "join": MotionClaims(times, knots, rest, rest, 3, found),
    }[wrong]
    with pytest.raises(Exception, match="withheld"):
        certified(motion, bad)


def test_the_steps_show_the_numbers() -> None:
    motion = between(*CUBIC, 2.0)
    steps = two_point_steps(motion, *CUBIC, normalised(motion, np.array([1.2])))
    text = "\n".join(line for step in steps for line in step.latex)
    assert r"c = \frac{0.5 \cdot 2}{1.2} = 0.8333333333" in text
    assert r"-0.25\,t^{3} + 0.55\,t^{2} + 0.5\,t + 0.2" in text
    still = between(column(0.2, 0.5), column(0.2, -0.3), 2.0)
    titles = [step.title for step in two_point_steps(still, column(0.2, 0.5), column(0.2, -0.3), [None])]
    assert "No normalised form" in titles
    assert "0.9033333333" in peak_step(peaks(motion, 1), peaks(motion, 2)).latex[0]
    lift = lift_steps(quartic_cubic_quartic(np.arange(4.0), np.zeros((4, 5))), np.zeros((4, 5)))
    assert [step.title for step in lift].count("Joint 4: Coefficients") == 1
    assert all("Joint 5" not in step.title for step in lift)
