"""Cubic splines: the lecture's numbers, SciPy as a second way, and what each boundary promises."""

from math import pi

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.linalg import solve_banded

from gelenk.course.motion.check import MotionClaims, certified
from gelenk.course.motion.spline_steps import spline_steps
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.splines import Boundary, EndRates, Spline, cubic_spline, through_samples
from gelenk.trajectory.motion.tridiagonal import Tridiagonal, solution

BOUNDARIES: tuple[Boundary, ...] = ("clamped", "natural", "not_a_knot", "periodic", "assigned")


def column(*values: float) -> Array:
    return np.array(values, dtype=float)[:, None]


def printed(value: float, text: str) -> bool:
    """Whether a number is the printed one, to its last digit."""
    decimals = len(text.partition(".")[2])
    return abs(value - float(text)) <= 0.5000001 * 10.0**-decimals


def all_printed(values: Array, texts: str) -> bool:
    return all(printed(value, text) for value, text in zip(values.ravel(), texts.split(), strict=True))


def ends(*values: float) -> EndRates:
    """Velocities at start and end, then accelerations."""
    v_i, v_f, a_i, a_f = (np.array([value]) for value in (*values, 0.0, 0.0)[:4])
    return EndRates(v_i, v_f, a_i, a_f)


# The lecture's

LECTURE = (np.array([0.0, 2.0, 3.0, 5.0]), column(0.0, 2.0 * pi, pi / 2.0, pi))


def test_the_system_of_the_lecture() -> None:
    found = cubic_spline(*LECTURE, "clamped")
    assert found.matrix is not None
    assert np.array_equal(found.matrix.dense(), [[6.0, 2.0], [2.0, 6.0]])
    assert all_printed(found.right_side, "-18.849555921539 -25.918139392116")
    assert all_printed(found.velocities, "0 -1.914408023281 -3.681553890926 0")
    accelerations = found.motion.derivative(2).at(LECTURE[0])
    assert all_printed(accelerations, "11.339185984 -13.253594007 9.719302272 -6.037748381")
    assert printed(found.motion.at(np.array([1.0]))[0, 0], "3.620194659410")


@pytest.mark.parametrize(
    ("times", "positions"),
    [((0.5, 4.5), ".435291828252 2.932857987856"), ((1.5, 3.5), "3.385117084124 2.028520256437")],
)
def test_fictitious_knots_of_the_lecture(times: tuple[float, float], positions: str) -> None:
    found = cubic_spline(*LECTURE, "assigned", fictitious_times=times)
    assert found.times[list(found.fictitious)].tolist() == list(times)
    assert all_printed(found.knots[list(found.fictitious)], positions)
    assert np.abs(found.motion.derivative(2).at(np.array([0.0, 5.0]))).max() < 1e-12


def test_the_first_exam() -> None:
    found = cubic_spline(np.array([1.0, 2.0, 2.5, 4.0]), column(45, 90, -45, 45), "clamped")
    assert all_printed(found.velocities, "0 -175.714285714 -215.357142857 0")
    fastest, hardest = peaks(found.motion, 1), peaks(found.motion, 2)
    # v_2 - c_2²/(3 c_3) with c_2 = -3405/7, c_3 = 4170/7; the printed 308.111510782 is off in its last digits.
    assert abs(fastest.values[0]) == pytest.approx(1230 / 7 + 3405**2 / (7 * 3 * 4170), abs=1e-10)
    assert abs(fastest.values[0]) == pytest.approx(308.111510782, abs=1e-8)
    assert printed(fastest.times[0], "2.27218")
    assert printed(abs(hardest.values[0]), "972.857142857")
    assert hardest.times[0] == 2.0


def test_the_second_exam_along_a_parameter() -> None:
    s = np.array([0.0, 0.25, 0.5, 1.0])
    q = column(70, -45, 10, 100)
    chords = np.diff(q, axis=0) / np.diff(s)[:, None]
    found = cubic_spline(s, q, "clamped", ends(chords[0, 0], chords[-1, 0]))
    assert all_printed(found.velocities, "-460 -147.272727273 329.090909091 180")
    driven = found.motion.scaled(1.0 / 0.4)
    assert driven.duration == pytest.approx(2.5)
    hardest = peaks(driven, 2)
    assert printed(abs(hardest.values[0]), "800.581818182")
    assert printed(hardest.times[0], ".625")


@pytest.mark.parametrize(
    ("boundary", "velocities"),
    [
        ("clamped", ".2 .138235294118 2.508823529412 1.930392156863 -.1"),
        ("natural", "1.640224358974 -.280448717949 2.441907051282 2.248397435897 -1.874198717949"),
        ("not_a_knot", "3.735714285714 -.854761904762 2.170238095238 3.164285714286 -6.826190476190"),
        ("periodic", "-1.206214689266 .522598870056 2.696327683616 1.302259887006 -1.206214689266"),
    ],
)
def test_five_knots_of_the_lecture(boundary: Boundary, velocities: str) -> None:
    q = column(0.0, 1.0, 0.5, 2.0, 0.0 if boundary == "periodic" else 1.5)
    found = cubic_spline(np.array([0.0, 1.0, 2.5, 3.0, 4.0]), q, boundary, ends(0.2, -0.1))
    assert all_printed(found.velocities, velocities)


# Against SciPy, and what is promised


def random_problem(rng: np.random.Generator, boundary: Boundary, least: int = 2) -> tuple[Array, Array, EndRates]:
    N, n = int(rng.integers(least, 12)), int(rng.integers(1, 5))
    times = np.cumsum(10.0 ** rng.uniform(-2.0, 1.0, N)) + rng.normal()
    q = rng.normal(size=(N, n))
    if boundary == "periodic":
        q[-1] = q[0]
    return times, q, EndRates(*rng.normal(size=(4, n)))


def rival(times: Array, q: Array, boundary: Boundary, given: EndRates) -> CubicSpline:
    conditions = {
        "clamped": ((1, given.start_velocity), (1, given.end_velocity)),
        "natural": "natural",
        "not_a_knot": "not-a-knot",
        "periodic": "periodic",
    }[boundary]
    return CubicSpline(times, q, bc_type=conditions)


@pytest.mark.slow
@pytest.mark.parametrize("boundary", BOUNDARIES[:4])
def test_a_thousand_random_splines_are_those_of_scipy(boundary: Boundary) -> None:
    rng = np.random.default_rng(BOUNDARIES.index(boundary))
    for _ in range(1000):
        times, q, given = random_problem(rng, boundary)
        found, other = cubic_spline(times, q, boundary, given), rival(times, q, boundary, given)
        fine = np.linspace(times[0], times[-1], 60)
        scale = np.abs(other(fine)).max()
        assert np.abs(found.motion.at(fine) - other(fine)).max() <= 1e-9 * scale
        assert np.abs(found.motion.at(times) - q).max() < 1e-9


@pytest.mark.quick(1)
@pytest.mark.parametrize("boundary", BOUNDARIES)
def test_each_boundary_keeps_what_it_promises(boundary: Boundary) -> None:
    rng = np.random.default_rng(42)
    for _ in range(200):
        times, q, given = random_problem(rng, boundary)
        found = cubic_spline(times, q, boundary, given)
        certificate = checked(found, times, q)
        assert certificate < 1e-9
        first, second, third = (found.motion.derivative(k) for k in (1, 2, 3))
        at = times[[0, -1]]
        v, a = np.abs(first.at(found.times)).max(), np.abs(second.at(found.times)).max()
        if boundary in {"clamped", "assigned"}:
            assert np.abs(first.at(at) - [given.start_velocity, given.end_velocity]).max() <= 1e-9 * v
        if boundary == "assigned":
            assert np.abs(second.at(at) - [given.start_acceleration, given.end_acceleration]).max() <= 1e-9 * a
        if boundary == "natural":
            assert np.abs(second.at(at)).max() <= 1e-9 * max(a, v / np.diff(times).min())
        if boundary == "periodic":
            assert np.abs(first.at(at[:1]) - first.at(at[1:])).max() <= 1e-9 * v
            assert np.abs(second.at(at[:1]) - second.at(at[1:])).max() <= 1e-9 * max(a, v / np.diff(times).min())
        if boundary == "not_a_knot" and len(times) > 3:
            jumps = np.diff(third.coefficients[:, 0], axis=0)[[0, -1]]
            assert np.abs(jumps).max() <= 1e-9 * np.abs(third.coefficients).max()


def checked(found: Spline, times: Array, q: Array) -> float:
    """The largest error of the certificate of a spline, of which no end is looked at."""
    none = np.empty((0, q.shape[1]))
    certificate = certified(
        found.motion, MotionClaims(times, q, none, none, 2, {k: peaks(found.motion, k) for k in (1, 2)})
    )
    return max(certificate.knot_error, certificate.continuity_error, certificate.peak_error)


def test_the_assigned_spline_is_the_clamped_one_through_its_fictitious_knots() -> None:
    rng = np.random.default_rng(9)
    for _ in range(200):
        times, q, given = random_problem(rng, "assigned")
        found = cubic_spline(times, q, "assigned", given)
        other = rival(found.times, found.knots, "clamped", given)
        fine = np.linspace(times[0], times[-1], 50)
        assert np.abs(found.motion.at(fine) - other(fine)).max() <= 1e-9 * np.abs(other(fine)).max()
        if found.matrix is not None:
            unknown = found.velocities[list(found.unknowns)]
            left = found.matrix.dense() @ unknown - found.right_side
            assert np.abs(left).max() <= 1e-9 * max(1.0, np.abs(found.right_side).max())


@pytest.mark.parametrize("boundary", BOUNDARIES)
@pytest.mark.parametrize("N", [2, 3])
def test_two_and_three_knots(boundary: Boundary, N: int) -> None:
    times, q = np.array([0.0, 1.0, 3.0])[:N], column(1.0, 2.0, 0.0)[:N]
    if boundary == "periodic":
        q[-1] = q[0]
    found = cubic_spline(times, q, boundary)
    assert checked(found, times, q) < 1e-12
    if boundary == "natural" and N == 2:
        assert np.ptp(found.velocities) < 1e-12
    if boundary == "not_a_knot":
        assert np.abs(found.motion.coefficients[:, N:]).max(initial=0.0) < 1e-12
    assert spline_steps(found, boundary)


def test_joints_do_not_know_each_other() -> None:
    rng = np.random.default_rng(3)
    times, q = np.cumsum(rng.uniform(0.1, 1.0, 9)), rng.normal(size=(9, 6))
    together = cubic_spline(times, q, "natural")
    for j in range(6):
        alone = cubic_spline(times, q[:, [j]], "natural")
        assert np.abs(together.motion.coefficients[:, :, j] - alone.motion.coefficients[:, :, 0]).max() < 1e-10


def test_far_from_zero_no_digits_are_lost() -> None:
    near, far = (cubic_spline(LECTURE[0], LECTURE[1] + offset, "natural") for offset in (0.0, 2.0**20))
    assert np.abs(near.velocities - far.velocities).max() < 1e-8


@pytest.mark.parametrize(
    ("times", "reason"),
    [
        ([0.0, 1.0, 1.0, 2.0], r"1 s is there twice \(entries 1 and 2\)"),
        ([0.0, 2.0, 1.0, 3.0], r"1 s comes after 2 s \(entry 2\)"),
        ([0.0, 1e-6, 1e3, 2e3], "entries 0 and 1 are 1e-06 s apart"),
    ],
)
def test_times_have_to_increase(times: list[float], reason: str) -> None:
    for boundary in BOUNDARIES:
        with pytest.raises(InvalidField, match=reason):
            cubic_spline(np.array(times), np.zeros((4, 1)), boundary)
    with pytest.raises(InvalidField, match=reason):
        through_samples(np.array(times), np.zeros((4, 1)), np.zeros((4, 1)))


def test_what_a_boundary_refuses() -> None:
    with pytest.raises(InvalidField, match="the last one must equal the first"):
        cubic_spline(*LECTURE, "periodic")
    for times in ((2.5, 4.5), (0.5, 2.5), (0.0, 4.5), (0.5, 5.0)):
        with pytest.raises(InvalidField, match="the first is within the first segment"):
            cubic_spline(*LECTURE, "assigned", fictitious_times=times)
    with pytest.raises(InvalidField, match="fictitious_times"):
        cubic_spline(LECTURE[0][:2], LECTURE[1][:2], "assigned", fictitious_times=(1.5, 0.5))


# Samples


def test_samples_with_derivatives_are_met_and_converge() -> None:
    errors = []
    for count in (11, 21):
        t = np.linspace(0.0, 2.0, count)
        q, v, a = np.sin(3.0 * t)[:, None], 3.0 * np.cos(3.0 * t)[:, None], -9.0 * np.sin(3.0 * t)[:, None]
        fine = np.linspace(0.0, 2.0, 777)
        cubic, quintic = through_samples(t, q, v), through_samples(t, q, v, a)
        assert np.abs(quintic.derivative(2).at(t) - a).max() < 1e-10
        errors.append([np.abs(one.at(fine)[:, 0] - np.sin(3.0 * fine)).max() for one in (cubic, quintic)])
    assert errors[0][0] / errors[1][0] == pytest.approx(16.0, rel=0.1)
    assert errors[0][1] / errors[1][1] == pytest.approx(64.0, rel=0.1)


# The system


@pytest.mark.parametrize("N", [*range(1, 12), 100, 257])
@pytest.mark.parametrize("is_periodic", [False, True])
def test_tridiagonal_systems(N: int, is_periodic: bool) -> None:
    rng = np.random.default_rng(N)
    lower, upper = rng.uniform(0.1, 3.0, (2, N))
    if not is_periodic:
        lower[0] = upper[-1] = 0.0
    A = Tridiagonal(lower, (lower + upper) * rng.uniform(1.2, 2.5, N) + 0.1, upper)
    b = rng.normal(size=(N, 3))
    x = solution(A, b)
    assert np.abs(A.dense() @ x - b).max() < 1e-12 * N
    if not is_periodic and N > 1:
        banded = np.array([np.append(0.0, upper[:-1]), A.diagonal, np.append(lower[1:], 0.0)])
        assert np.abs(x - solve_banded((1, 1), banded, b)).max() < 1e-12


def test_the_steps_show_the_system() -> None:
    found = cubic_spline(*LECTURE, "clamped")
    steps = spline_steps(found, "clamped")
    text = "\n".join(line for step in steps for line in step.latex)
    assert r"A = \begin{bmatrix} 6 & 2 \\ 2 & 6 \end{bmatrix}" in text
    assert "-1.914408023" in text
    assert "12 coefficients; 6 positions and 4 continuities" in steps[0].text
    assert "q_f = (0.4352918283" in "\n".join(
        line
        for step in spline_steps(cubic_spline(*LECTURE, "assigned", fictitious_times=(0.5, 4.5)), "assigned")
        for line in step.latex
    )
