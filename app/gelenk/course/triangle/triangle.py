"""A triangle from three of its sides and angles.

Side a is opposite to the angle α at corner A, and so on. The numbers come from formulas that keep the digits which the
law of cosines loses in slender triangles; the corners' coordinates give all sides and angles once more.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField, certify
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result

TriangleCase: TypeAlias = Literal["SSS", "SAS", "SSA", "ASA", "AAS"]

SIDES: Final = ("a", "b", "c")
ANGLES: Final = ("alpha", "beta", "gamma")
FLAT: Final = 1e-12
"""Relative excess of the longest side at which a triangle counts as flat: its corners are on one line."""
_RECOMPUTED = 1e-11
"""Largest difference of a recomputed side, relative to the longest; angles at short sides are worse in proportion."""


@dataclass(frozen=True, slots=True)
class Triangle:
    """Sides a, b, c [m] and the opposite angles α, β, γ [rad]."""

    sides: tuple[float, float, float]
    angles: tuple[float, float, float]

    @property
    def corners(self) -> Array:
        """A in the origin, B on the x axis, C above it; shape (3, 2), [m]."""
        b, alpha = self.sides[1], self.angles[0]
        return np.array([[0.0, 0.0], [self.sides[2], 0.0], [b * math.cos(alpha), b * math.sin(alpha)]])

    @property
    def area(self) -> float:
        """Its area, [m²]."""
        return 0.5 * self.sides[1] * self.sides[2] * math.sin(self.angles[0])

    @property
    def is_flat(self) -> bool:
        """Whether all corners are on one line, up to rounding."""
        return 2.0 * max(self.sides) >= (1.0 - FLAT) * sum(self.sides)


@dataclass(frozen=True, slots=True)
class TriangleCheck(Result):
    """The corners' coordinates, measured again.

    Attributes:
        max_side_error: Largest difference of a side from the distance of its ends, relative to the longest side.
        max_angle_error: Largest difference of an angle from that between the directions to the other corners, [rad].
    """

    max_side_error: float
    max_angle_error: float


@dataclass(frozen=True, slots=True)
class SolvedTriangle:
    """All triangles with the given parts: two or one.

    Attributes:
        roles: Indices of the parts as the case uses them: SAS the two sides and the third; SSA the side opposite to
            the given angle, the other given side, the third one; ASA and AAS the given side and the two others.
        given: Names of the given parts.
    """

    case: TriangleCase
    roles: tuple[int, int, int]
    triangles: tuple[Triangle, ...]
    given: frozenset[str]
    check: TriangleCheck


def solved_triangle(parts: Mapping[str, float]) -> SolvedTriangle:
    """Find all triangles with three given parts: sides [m] and angles [rad], by name.

    Raises:
        InvalidField: Other than three parts are given, or no side; or no triangle has these parts.
    """
    sides = [i for i, name in enumerate(SIDES) if name in parts]
    angles = [i for i, name in enumerate(ANGLES) if name in parts]
    if len(parts) != 3:
        names = ", ".join((*SIDES, *ANGLES))
        raise InvalidField(["a", *parts][-1], f"exactly three of {names} are given; here are {len(parts)}")
    if not sides:
        raise InvalidField("gamma", "three angles fix the shape of a triangle but not its size: give at least one side")
    case, roles, found = _CASES[len(sides)](parts, sides, angles)
    return SolvedTriangle(case, roles, found, frozenset(parts), _checked(found))


_Found: TypeAlias = tuple[TriangleCase, tuple[int, int, int], tuple[Triangle, ...]]


def _from_three_sides(parts: Mapping[str, float], _sides: list[int], _angles: list[int]) -> _Found:
    a, b, c = (parts[name] for name in SIDES)
    return "SSS", (0, 1, 2), (_of_sides((a, b, c)),)


def _from_two_sides(parts: Mapping[str, float], sides: list[int], angles: list[int]) -> _Found:
    """Solve SAS, or SSA where the angle is opposite to a given side."""
    (k,) = angles
    theta = parts[ANGLES[k]]
    if k not in sides:
        i, j = sides
        p, q = parts[SIDES[i]], parts[SIDES[j]]
        # (p - q)² + 4 p q sin²(θ/2) keeps its digits where p² + q² - 2 p q cos θ loses them.
        third = math.hypot(p - q, 2.0 * math.sqrt(p * q) * math.sin(0.5 * theta))
        return (
            "SAS",
            (i, j, k),
            (_put({i: (p, _across(p, q, theta)), j: (q, _across(q, p, theta)), k: (third, theta)}),),
        )
    (j,) = (side for side in sides if side != k)
    m = 3 - j - k
    opposite, beside = parts[SIDES[k]], parts[SIDES[j]]
    height = beside * math.sin(theta)
    _check_reach(parts, k, j)
    half = math.sqrt(max(0.0, (opposite - height) * (opposite + height)))
    foot = beside * math.cos(theta)
    found = []
    for root in (half, -half) if opposite - height > FLAT * beside else (0.0,):
        third = foot + root
        if third > FLAT * beside:
            angles_by_side = {k: theta, j: math.atan2(height, root), m: _across(third, beside, theta)}
            lengths = {k: opposite, j: beside, m: third}
            found.append(_put({n: (lengths[n], angles_by_side[n]) for n in range(3)}))
    return "SSA", (k, j, m), tuple(found)


def _check_reach(parts: Mapping[str, float], k: int, j: int) -> None:
    """Refuse a side that is too short to reach the line on which the third one lies."""
    opposite, beside, theta = parts[SIDES[k]], parts[SIDES[j]], parts[ANGLES[k]]
    height, names = beside * math.sin(theta), (SIDES[k], SIDES[j], ANGLES[k])
    if opposite < height * (1.0 - FLAT):
        rule = f"{names[0]} ≥ {names[1]} sin {names[2]}"
        raise InvalidField(names[0], f"no triangle: {rule} is violated, {opposite:.10g} < {height:.10g}")
    if theta >= 0.5 * math.pi and opposite <= beside:
        rule = f"{names[0]} > {names[1]} where {names[2]} ≥ π/2"
        raise InvalidField(names[0], f"no triangle: {rule} is violated, {opposite:.10g} ≤ {beside:.10g}")


def _from_one_side(parts: Mapping[str, float], sides: list[int], angles: list[int]) -> _Found:
    """Solve ASA, or AAS where an angle is opposite to the given side, by the law of sines."""
    (i,), (k, m) = sides, angles
    rest = math.pi - parts[ANGLES[k]] - parts[ANGLES[m]]
    if rest <= 0.0:
        names = f"{ANGLES[k]} + {ANGLES[m]} < π"
        total = parts[ANGLES[k]] + parts[ANGLES[m]]
        raise InvalidField(ANGLES[m], f"no triangle: {names} is violated, the sum is {total:.10g}")
    values = {k: parts[ANGLES[k]], m: parts[ANGLES[m]], 3 - k - m: rest}
    # The sine of the sum: that of the third angle would lose digits where it is near π.
    sines = {n: math.sin(angle) for n, angle in values.items()} | {3 - k - m: math.sin(values[k] + values[m])}
    lengths = {n: parts[SIDES[i]] * sines[n] / sines[i] for n in range(3)} | {i: parts[SIDES[i]]}
    triangle = Triangle((lengths[0], lengths[1], lengths[2]), (values[0], values[1], values[2]))
    others = [n for n in range(3) if n != i]
    return ("AAS" if i in angles else "ASA"), (i, others[0], others[1]), (triangle,)


_CASES: Final = {3: _from_three_sides, 2: _from_two_sides, 1: _from_one_side}


def _put(parts: Mapping[int, tuple[float, float]]) -> Triangle:
    """Return the triangle of a side and the angle opposite, for each index."""
    (a, alpha), (b, beta), (c, gamma) = (parts[i] for i in range(3))
    return Triangle((a, b, c), (alpha, beta, gamma))


def _across(side: float, other: float, between: float) -> float:
    """Return the angle opposite to a side, given another and the angle between the two."""
    return math.atan2(side * math.sin(between), other - side * math.cos(between))


def _of_sides(sides: tuple[float, float, float]) -> Triangle:
    """Return the triangle of three sides; raises InvalidField if one is longer than the two others together."""
    for i, name in enumerate(SIDES):
        p, q = (side for j, side in enumerate(sides) if j != i)
        if sides[i] > (p + q) * (1.0 + FLAT):
            one, other = (n for n in SIDES if n != name)
            rule = f"{name} ≤ {one} + {other}"
            raise InvalidField(name, f"no triangle: {rule} is violated, {sides[i]:.10g} > {p + q:.10g}")
    if Triangle(sides, (0.0, 0.0, 0.0)).is_flat:
        alpha, beta, gamma = (math.pi if side == max(sides) else 0.0 for side in sides)
        return Triangle(sides, (alpha, beta, gamma))
    alpha, beta, gamma = (_opposite(sides[i], *(side for j, side in enumerate(sides) if j != i)) for i in range(3))
    return Triangle(sides, (alpha, beta, gamma))


def _opposite(side: float, p: float, q: float) -> float:
    """Return the angle opposite to a side from tan²(θ/2) = (s - p)(s - q) / (s (s - side)), s half the perimeter."""
    above = max(0.0, (side - (p - q)) * (side + (p - q)))
    below = max(0.0, (p + q + side) * ((p + q) - side))
    return 2.0 * math.atan2(math.sqrt(above), math.sqrt(below))


def _checked(triangles: tuple[Triangle, ...]) -> TriangleCheck:
    side_error = angle_error = 0.0
    for triangle in triangles:
        corners = triangle.corners
        for i in range(3):
            here, one, other = corners[i], corners[(i + 1) % 3], corners[(i + 2) % 3]
            u, v = one - here, other - here
            length = math.hypot(*(other - one).tolist())
            angle = math.atan2(abs(float(u[0] * v[1] - u[1] * v[0])), float(u @ v))
            side_error = max(side_error, abs(length - triangle.sides[i]) / max(triangle.sides))
            angle_error = max(angle_error, abs(angle - triangle.angles[i]))
    slender = max(max(triangle.sides) / min(triangle.sides) for triangle in triangles)
    for what, error, limit in (("sides", side_error, _RECOMPUTED), ("angles", angle_error, _RECOMPUTED * slender)):
        certify(what, error, limit)
    return TriangleCheck(side_error, angle_error)
