"""The subproblems of closed forms: against NumPy's roots of polynomials, and against a fine sweep of the unknown."""

import math
import sys
from collections.abc import Callable, Iterator
from types import FunctionType
from typing import cast

import numba
import numpy as np
import numpy.typing as npt
import pytest
from numpy.polynomial import polynomial
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from gelenk.ik.closed import subproblems
from gelenk.ik.closed.subproblems import (
    Quadratic,
    angle_of,
    angle_onto,
    product,
    roots_of_quartic,
    slides_at,
    slides_of_quadratic,
    turns_at,
    turns_of_quadratic,
    value,
)
from gelenk.kinematics.simd.vectors import Vector
from gelenk.robot import compilation
from gelenk.robot.arrays import Array

TURN = 2.0 * np.pi


def drawn(count: int, size: int, seed: int) -> Array:
    """Coefficients of very different sizes; shape (count, size)."""
    rng = np.random.default_rng(seed)
    numbers = rng.normal(size=(count, size)) * 10.0 ** rng.uniform(-2, 2, (count, size))
    return np.asarray(numbers)


def unit(seed: int, count: int) -> Array:
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))


def real_roots(coefficients: Array, reach: float) -> Array:
    """Real roots of a polynomial from the highest power on: eigenvalues, which are only as good as the largest."""
    roots = np.roots(coefficients)
    real = np.sort(roots[np.abs(roots.imag) < 1e-9 * (1.0 + np.abs(roots))].real)
    for _ in range(3):
        real = real - np.polyval(coefficients, real) / np.polyval(np.polyder(coefficients), real)
    return np.asarray(real[np.abs(real) <= reach])


def of_quartic(coefficients: npt.ArrayLike, reach: float = 1e3) -> Array:
    a, b, c, d, e = np.asarray(coefficients, dtype=float).tolist()
    room = np.full(8, np.nan)
    count = roots_of_quartic(a, b, c, d, e, reach, room)
    return room[:count]


def of_turns(f: Quadratic) -> Array:
    room = np.full(8, np.nan)
    count = turns_of_quadratic(f, room)
    return np.asarray(np.sort(room[:count] % TURN))


def at_turn(f: Quadratic, angle: Array | float) -> Array:
    """A quadratic function of cosine and sine, written out."""
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(f[0] + f[1] * c + f[2] * s + f[3] * c * c + f[4] * c * s + f[5] * s * s)


def swept(f: Quadratic) -> Array:
    """Where it changes its sign, from a sweep in thousandths of a radian."""
    grid = np.linspace(0.0, TURN, 6284)
    values = at_turn(f, grid)
    found = [
        brentq(lambda x: float(at_turn(f, x)), grid[k], grid[k + 1], xtol=1e-15)
        for k in np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
    ]
    return np.sort(np.array(found))


def as_vector(a: Array) -> Vector:
    return float(a[0]), float(a[1]), float(a[2])


def test_the_angle_of_a_turn_of_any_length_is_right_to_rounding() -> None:
    rng = np.random.default_rng(3)
    angles = np.concatenate((rng.uniform(-np.pi, np.pi, 5000), np.arange(-8, 9) * (np.pi / 8), 10.0 ** -np.arange(300)))
    turns = 10.0 ** rng.uniform(-20, 20, len(angles)) * np.array([np.cos(angles), np.sin(angles)])
    found = np.array([angle_of(turn) for turn in zip(*turns.tolist(), strict=True)])
    exact = np.arctan2(turns[1], turns[0])
    np.testing.assert_allclose(found, exact, rtol=3e-16, atol=0.0)


def test_the_angle_of_a_turn_along_an_axis_is_exact_and_that_of_none_is_zero() -> None:
    for cosine, sine in ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (0.0, 0.0)):
        assert angle_of((cosine, sine)) == math.atan2(sine, cosine)
    assert math.isnan(angle_of((math.nan, 1.0)))
    assert math.isnan(angle_of((1.0, math.nan)))


def test_one_vector_is_turned_onto_another() -> None:
    rng = np.random.default_rng(1)
    axes, vectors = unit(2, 200), rng.normal(size=(200, 3))
    for axis, a, angle in zip(axes, vectors, rng.uniform(-np.pi, np.pi, 200), strict=True):
        b = Rotation.from_rotvec(angle * axis).apply(a)
        assert angle_onto(as_vector(axis), as_vector(a), as_vector(b)) == pytest.approx(angle, abs=1e-14)


def test_of_vectors_that_cannot_meet_the_nearest_is_taken() -> None:
    rng = np.random.default_rng(3)
    turns = np.linspace(-np.pi, np.pi, 20001)
    for axis, a, b in zip(unit(4, 20), rng.normal(size=(20, 3)), rng.normal(size=(20, 3)), strict=True):
        misses = np.linalg.norm(Rotation.from_rotvec(turns[:, None] * axis).apply(a) - b, axis=1)
        angle = angle_onto(as_vector(axis), as_vector(a), as_vector(b))
        miss = np.linalg.norm(Rotation.from_rotvec(angle * axis).apply(a) - b)
        assert miss <= misses.min() + 1e-12


@pytest.mark.parametrize("tilt", [1e-3, 1e-6, 1e-9])
def test_a_vector_nearly_along_the_axis_keeps_the_digits_of_its_angle(tilt: float) -> None:
    axis = (0.0, 0.0, 1.0)
    for angle in np.linspace(-3.0, 3.0, 13):
        a, b = (tilt, 0.0, 1.0), (tilt * math.cos(angle), tilt * math.sin(angle), 1.0)
        assert angle_onto(axis, a, b) == pytest.approx(angle, abs=1e-14)


def test_a_linear_equation_in_cosine_and_sine() -> None:
    solvable = 0
    for g in drawn(500, 3, seed=5):
        middle, half, good = turns_at((g[0], g[1], g[2]))
        length = math.hypot(g[1], g[2])
        assert good == (abs(g[0]) <= length * (1.0 + 1e-4))
        if abs(g[0]) > length:
            continue
        solvable += 1
        # By the tangent of half the angle: (g0 - g1) t² + 2 g2 t + g0 + g1.
        expected = np.sort(2.0 * np.arctan(np.roots([g[0] - g[1], 2.0 * g[2], g[0] + g[1]]).real) % TURN)
        found = np.sort(np.array([middle - half, middle + half]) % TURN)
        np.testing.assert_allclose(found, expected, atol=1e-7)
        for angle in found:
            assert abs(g[0] + g[1] * math.cos(angle) + g[2] * math.sin(angle)) <= 4e-15 * (abs(g[0]) + length)
    assert solvable > 100


def test_at_the_rim_the_two_angles_are_one_and_far_beyond_there_is_none() -> None:
    middle, half, good = turns_at((-5.0, 3.0, 4.0))
    assert good
    assert half == 0.0
    assert middle == pytest.approx(math.atan2(4.0, 3.0), abs=1e-15)
    middle, half, good = turns_at((-5.0 * (1.0 + 1e-12), 3.0, 4.0))
    assert good
    assert half == 0.0
    assert not turns_at((-5.1, 3.0, 4.0))[2]
    assert not turns_at((1.0, 0.0, 0.0))[2]
    assert not turns_at((0.0, 0.0, 0.0))[2]


@pytest.mark.parametrize("half", [1e-3, 1e-6, 1e-7])
def test_near_the_rim_the_angles_are_as_good_as_the_equation(half: float) -> None:
    # A rounding of 1 - half²/2 is worth eps / half in the angle.
    g = (-math.cos(half), 1.0, 0.0)
    assert turns_at(g)[1] == pytest.approx(half, abs=3e-16 / half)


def test_a_quadratic_equation() -> None:
    for a, b, c in drawn(500, 3, seed=6):
        middle, half, good = slides_at(a, b, c)
        discriminant = b * b - 4.0 * a * c
        if discriminant < 0.0:
            assert half == 0.0
            assert middle == pytest.approx(-0.5 * b / a, rel=1e-14)
            continue
        assert good
        expected = np.sort(np.roots([a, b, c]).real)
        scale = abs(middle) + half
        np.testing.assert_allclose([middle - half, middle + half], expected, atol=1e-12 * scale)
    assert slides_at(0.0, 2.0, -3.0) == (1.5, 0.0, True)
    assert not slides_at(0.0, 0.0, 1.0)[2]
    assert not slides_at(1.0, 0.0, 1.0)[2]


def test_products_and_values_of_functions_of_a_joint() -> None:
    rng = np.random.default_rng(7)
    for a, b, q in zip(rng.normal(size=(50, 3)), rng.normal(size=(50, 3)), rng.uniform(-3, 3, 50), strict=True):
        first, second = as_vector(a), as_vector(b)
        basis = (1.0, math.cos(q), math.sin(q))
        f = product(first, second)
        expected = float(np.dot(a, basis) * np.dot(b, basis))
        assert float(at_turn(f, q)) == pytest.approx(expected, abs=1e-13)
        assert value(first, basis) * value(second, basis) == pytest.approx(expected, abs=1e-13)
        powers = polynomial.polymul(a, b)
        assert np.allclose([f[0], f[1], f[2] + f[3], f[4], f[5]], powers, atol=1e-13)


@pytest.mark.slow
def test_roots_of_random_quartics() -> None:
    counts = np.zeros(5, dtype=int)
    for coefficients in drawn(3000, 5, seed=8):
        expected = real_roots(coefficients, 1e3)
        if len(expected) > 1 and np.diff(expected).min() < 1e-3 * (1.0 + np.abs(expected).max()):
            continue
        found = of_quartic(coefficients)
        # What touches zero nearly may be offered besides; what is a root may not be missing.
        for root in expected:
            assert np.abs(found - root).min(initial=np.inf) <= 1e-9 * (1.0 + abs(root)), coefficients
        counts[len(expected)] += 1
    assert (counts[[0, 2, 4]] > 100).all()


def inlined_of_quartic() -> Callable[..., int]:
    """`roots_of_quartic` with all that it calls inlined into it, so that values are rounded where they are used."""
    room, options = dict(vars(subproblems)), {**compilation._UNMANAGED, "cache": False, "forceinline": True}
    for name in ("_root_between", "roots_of_quartic"):
        room[name] = numba.njit(**options)(FunctionType(room[name].py_func.__code__, room, name))
    return cast(Callable[..., int], room["roots_of_quartic"])


def quartics_with_roots() -> Iterator[tuple[Array, list[float]]]:
    rng = np.random.default_rng(9)
    for _ in range(50):
        r = np.sort(rng.uniform(-3.0, 3.0, 4))
        if np.diff(r).min() < 0.05:
            continue
        scale = 10.0 ** rng.uniform(-6, 6)
        yield scale * np.poly([r[0], r[0], r[2], r[3]]), [r[0], r[2], r[3]]
        yield scale * np.poly([r[0], r[1], r[3], r[3]]), [r[0], r[1], r[3]]
        yield scale * np.poly([r[0], r[1], r[1], r[3]]), [r[0], r[1], r[3]]
        yield scale * np.poly([r[0], r[0], r[2], r[2]]), [r[0], r[2]]
        yield scale * np.poly([r[0], r[0], 1j, -1j]).real, [r[0]]


@pytest.mark.quick(1)
@pytest.mark.parametrize("way", ["alone", "inlined"])
def test_double_roots_are_found_whichever_side_rounding_puts_them(way: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if way == "inlined":
        monkeypatch.setattr(sys.modules[__name__], "roots_of_quartic", inlined_of_quartic())
    for coefficients, expected in quartics_with_roots():
        found = of_quartic(coefficients)
        assert len(found) <= 8
        for root in expected:
            # Half the digits are all that a double root has.
            assert np.abs(found - root).min(initial=np.inf) < 1e-6, (coefficients, expected, found)


@pytest.mark.parametrize("apart", [1e-2, 1e-4, 1e-6, 1e-8])
def test_roots_that_nearly_meet_are_both_there(apart: float) -> None:
    rng = np.random.default_rng(10)
    for _ in range(100):
        r = np.sort(rng.uniform(-3.0, 3.0, 3))
        if np.diff(r).min() < 0.1:
            continue
        found = of_quartic(np.poly([r[0], r[1], r[1] + apart, r[2]]))
        for root in (r[0], r[1], r[1] + apart, r[2]):
            assert np.abs(found - root).min() < max(1e-12 / apart, 1e-13) + min(apart, 1e-6)


@pytest.mark.parametrize("triple", [-1.3, 0.0, 0.7])
def test_triple_and_fourfold_roots_are_found(triple: float) -> None:
    found = of_quartic(np.poly([triple, triple, triple, triple + 1.0]))
    assert np.abs(found - triple).min() < 1e-4
    assert np.abs(found - triple - 1.0).min() < 1e-9
    assert np.abs(of_quartic(np.poly([triple] * 4)) - triple).min() < 1e-3


def test_quartics_that_are_of_a_lesser_degree() -> None:
    assert of_quartic(np.array([0.0, 1.0, 0.0, -4.0, 0.0])) == pytest.approx([-2.0, 0.0, 2.0], abs=1e-12)
    assert of_quartic(np.array([0.0, 0.0, 1.0, -1.0, -6.0])) == pytest.approx([-2.0, 3.0], abs=1e-12)
    assert of_quartic(np.array([0.0, 0.0, 0.0, 2.0, -3.0])) == pytest.approx([1.5], abs=1e-12)
    assert len(of_quartic(np.array([0.0, 0.0, 0.0, 0.0, 1.0]))) == 0
    assert len(of_quartic(np.array([1.0, 0.0, 0.0, 0.0, 1.0]))) == 0


def test_only_roots_within_reach_are_given() -> None:
    found = of_quartic(np.poly([-5.0, -0.5, 0.5, 7.0]), reach=1.0)
    assert found == pytest.approx([-0.5, 0.5], abs=1e-12)


def test_a_quadratic_function_of_cosine_and_sine_by_a_sweep() -> None:
    counts = np.zeros(5, dtype=int)
    for row in drawn(400, 6, seed=11) / 10.0:
        f: Quadratic = (row[0], row[1], row[2], row[3], row[4], row[5])
        expected, found = swept(f), of_turns(f)
        counts[len(expected)] += 1
        for angle in expected:
            apart = np.abs((found - angle + np.pi) % TURN - np.pi)
            assert apart.min(initial=np.inf) < 1e-7, (f, expected, found)
        # What is offered besides is near to a touch.
        largest = np.abs(row).max()
        assert (np.abs(at_turn(f, found)) <= 1e-4 * largest).all()
    assert counts[0] > 20
    assert counts[2] > 20
    assert counts[4] > 5


def test_a_root_at_half_a_turn_is_no_exception() -> None:
    # (cos q + 1)(cos q - 0.5): the tangent of half the angle would be infinite at π.
    found = of_turns((-0.5, 0.5, 0.0, 1.0, 0.0, 0.0))
    for angle in (np.pi / 3.0, np.pi, 5.0 * np.pi / 3.0):
        assert np.abs(found - angle).min() < 1e-7


def test_the_same_where_the_joint_slides() -> None:
    for row in drawn(300, 6, seed=12):
        f: Quadratic = (row[0], row[1], row[2], row[3], row[4], row[5])
        expected = real_roots(np.array([row[5], row[4], row[2] + row[3], row[1], row[0]]), 50.0)
        room = np.full(8, np.nan)
        found = room[: slides_of_quadratic(f, 50.0, room)]
        if len(expected) > 1 and np.diff(expected).min() < 1e-3 * (1.0 + np.abs(expected).max()):
            continue
        for root in expected:
            assert np.abs(found - root).min(initial=np.inf) < 1e-9 * (1.0 + abs(root))
