"""Triangles: the lecture's numbers, every choice of three parts of random triangles, and what has no triangle."""

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest

from gelenk.course.triangle.triangle import ANGLES, SIDES, Triangle, solved_triangle
from gelenk.course.triangle.triangle_steps import triangle_steps, triangle_warnings
from gelenk.errors import InvalidField

PARTS = (*SIDES, *ANGLES)


def of_corners(corners: np.ndarray[tuple[int, int], np.dtype[np.float64]]) -> dict[str, float]:
    """All six parts, the angles by the law of cosines in exact arithmetic."""
    points = [[Fraction(x) for x in corner] for corner in corners.tolist()]
    squares = [sum((p - q) ** 2 for p, q in zip(*pair, strict=True)) for pair in itertools.combinations(points, 2)]
    c2, b2, a2 = (Fraction(square) for square in squares)
    parts = {name: math.sqrt(square) for name, square in zip(SIDES, (a2, b2, c2), strict=True)}
    for name, k, i, j in zip(ANGLES, (a2, b2, c2), (b2, c2, a2), (c2, a2, b2), strict=True):
        parts[name] = math.acos(float(i + j - k) / (2.0 * math.sqrt(i * j)))
    return parts


def parts_of(triangle: Triangle) -> list[float]:
    return [*triangle.sides, *triangle.angles]


def test_the_lectures_law_of_cosines() -> None:
    given = {"a": 3.0, "b": 4.0, "gamma": math.pi / 3}
    found = solved_triangle(given)
    (triangle,) = found.triangles
    assert found.case == "SAS"
    assert triangle.sides[2] == pytest.approx(3.605551275464, abs=5e-13)
    assert np.degrees(triangle.angles) == pytest.approx([46.102113752, 73.897886248, 60.0], abs=5e-10)
    assert triangle.area == pytest.approx(3.0 * math.sqrt(3.0))
    shown = "\n".join(line for step in triangle_steps(found, given) for line in step.plain)
    assert "c = 3.605551275 m" in shown
    assert "0.8046336771 rad" in shown


@pytest.mark.parametrize("names", [names for names in itertools.combinations(PARTS, 3) if set(names) != set(ANGLES)])
def test_three_parts_give_the_triangle_again(names: tuple[str, ...]) -> None:
    rng = np.random.default_rng(7)
    counts = set()
    for _ in range(20):
        parts = of_corners(rng.uniform(-1.0, 1.0, (3, 2)))
        given = {name: parts[name] for name in names}
        found = solved_triangle(given)
        counts.add(len(found.triangles))
        gaps = [np.abs(np.subtract(parts_of(one), list(parts.values()))).max() for one in found.triangles]
        assert min(gaps) < 1e-9
        for one in found.triangles:
            named = dict(zip(PARTS, parts_of(one), strict=True))
            assert {name: named[name] for name in names} == pytest.approx(given, abs=1e-9)
        assert triangle_steps(found, given)
    assert counts == ({1, 2} if found.case == "SSA" else {1})


@pytest.mark.parametrize(("a", "count"), [(1.999, 0), (2.0, 1), (2.001, 2), (3.999, 2), (4.0, 1), (5.0, 1)])
def test_two_sides_and_an_angle_beside_have_two_triangles_one_or_none(a: float, count: int) -> None:
    given = {"a": a, "b": 4.0, "alpha": math.pi / 6}
    if count == 0:
        with pytest.raises(InvalidField, match="a ≥ b sin alpha is violated"):
            solved_triangle(given)
    else:
        assert len(solved_triangle(given).triangles) == count


def test_a_stretched_triangle_is_flat() -> None:
    found = solved_triangle({"a": 1.0, "b": 2.0, "c": 3.0})
    assert found.triangles[0].angles == (0.0, 0.0, math.pi)
    assert triangle_warnings(found) == ["The triangle is flat: its corners are on one line."]


@pytest.mark.parametrize(
    ("given", "field", "reason"),
    [
        ({"a": 1.0, "b": 2.0, "c": 4.0}, "c", "c ≤ a + b is violated, 4 > 3"),
        ({"a": 9.0, "b": 2.0, "c": 4.0}, "a", "a ≤ b + c is violated, 9 > 6"),
        ({"b": 1.0, "c": 1.0, "beta": 2.0}, "b", "b > c where beta ≥ π/2 is violated, 1 ≤ 1"),
        ({"c": 1.0, "alpha": 2.0, "beta": 1.5}, "beta", "alpha + beta < π is violated, the sum is 3.5"),
        ({"alpha": 1.0, "beta": 1.0, "gamma": 1.0}, "gamma", "at least one side"),
        ({"a": 1.0, "b": 1.0}, "b", "exactly three"),
        ({}, "a", "here are 0"),
    ],
)
def test_what_is_no_triangle_names_the_inequality(given: dict[str, float], field: str, reason: str) -> None:
    with pytest.raises(InvalidField) as refused:
        solved_triangle(given)
    assert refused.value.field == field
    assert reason in str(refused.value)


def test_a_triangle_that_is_nearly_flat_keeps_its_digits() -> None:
    found = solved_triangle({"alpha": 1e-6, "a": 1e-6, "beta": 1e-6})
    assert found.triangles[0].sides == pytest.approx((1e-6, 1e-6, 2e-6 * math.cos(1e-6)), rel=1e-14)
