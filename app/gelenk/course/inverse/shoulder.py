"""Three joints that place a point: the first axis, and behind it two links or a slide in a plane.

Frame 1 stands upright in the plane of the arm: x₁ = (c₁, s₁, 0), y₁ = ±z₀. The point is at (ρ - a₁, ±(z - d₁)) in it,
and its distance D from it is constant, so that ρ² + D² = x² + y².
"""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.course.inverse.arm import HandArm
from gelenk.course.inverse.planar import Links, bends, elbow_step
from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, atan2, number, term, theta, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import about_x


@dataclass(frozen=True, slots=True)
class Placed:
    """The steps that place a point, and the values of the three variables; NaN where one is free."""

    steps: list[Step]
    values: list[tuple[float, float, float]]


@dataclass(frozen=True, slots=True)
class Upright:
    """The plane of the arm.

    Attributes:
        side: D, the distance of the point from the plane, on the side of z₁, [m].
        up: Sign of y₁ along z₀.
        turns: Angles of the first joint, [rad]; NaN where it is free.
        places: Coordinates of the point in frame 1 for each of them, [m].
    """

    side: float
    up: int
    turns: tuple[float, ...]
    places: tuple[tuple[float, float], ...]


def placed(arm: HandArm, point: Array, local: Array, name: str = "p") -> Placed:
    """Return how the first three joints bring a point of frame 3, `local`, to a place of frame 0; shape (3,) each, [m].

    The second and third axis are parallel, or the third joint slides perpendicular to the second axis.
    """
    second, third = arm.rows[1:3]
    end = behind_third(arm, local)
    if third.slides:
        end[:2] = _rotated(end[:2], third.theta)
        side = second.d + end[1] * math.sin(second.alpha)
    else:
        side = second.d + third.d + end[2]
    plane = upright(arm, point, float(side))
    steps = [first_step(plane, point, name)]
    if not plane.turns:
        return Placed(steps, [])
    steps.append(_plane_step(arm, plane, name))
    if third.slides:
        return _slid(arm, plane, end, steps)
    straight = abs(end[1]) < ROUNDING
    symbol = "a_3" if straight and abs(end[0] - third.a) < ROUNDING else r"\ell"
    links = Links(1, second.a, (float(end[0]), float(end[1])), "a_2", symbol, ("X", "Y"))
    found = [bends(links, *place) for place in plane.places]
    steps.append(elbow_step(links, list(plane.places), found))
    pairs = zip(plane.turns, found, strict=True)
    return Placed(steps, [(turn, *pair) for turn, bend in pairs for pair in bend.pairs])


def behind_third(arm: HandArm, local: Array) -> Array:
    """Return a point of frame 3 in the frame that the third joint turns or slides; shape (3,) → (3,), [m]."""
    third = arm.rows[2]
    return np.asarray((about_x(third.alpha, third.a) @ np.append(local, 1.0))[:3])


def _rotated(v: Array, angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])


def upright(arm: HandArm, point: Array, side: float) -> Upright:
    """Return the plane that brings a point of frame 0 to a distance from it, `side`, [m]."""
    first = arm.rows[0]
    up = 1 if math.sin(first.alpha) > 0.0 else -1
    x, y, z = point.tolist()
    square, height = x * x + y * y - side * side, up * (z - first.d)
    if math.hypot(x, y) < ROUNDING and abs(side) < ROUNDING:
        return Upright(side, up, (math.nan,), ((-first.a, height),))
    if square < -ROUNDING:
        return Upright(side, up, (), ())
    rho = math.sqrt(max(0.0, square))
    turns = [wrapped(math.atan2(y, x) - math.atan2(-up * side, r)) for r in (rho, -rho)]
    if rho < ROUNDING:
        return Upright(side, up, (turns[0],), ((-first.a, height),))
    return Upright(side, up, tuple(turns), ((rho - first.a, height), (-rho - first.a, height)))


def first_step(plane: Upright, point: Array, name: str) -> Step:
    """Return the step that finds the first angle."""
    x, y = ("p_x", "p_y") if name == "p" else ("p_{wx}", "p_{wy}")
    here = f"({x}, {y}) = {vector(point[:2])}"
    one = theta(0)
    if plane.turns and math.isnan(plane.turns[0]):
        text = _("The point lies on the first axis, which therefore does not move it: the angle is free.")
        return step(_("First joint"), text, here)
    values = rf"{one} \in \{{" + r",\; ".join(map(number, plane.turns)) + r"\}"
    if abs(plane.side) < ROUNDING:
        text = _("Seen along the first axis the arm points at the target, or straight away from it and reaches back.")
        either = atan2(rf"\pm {y}", rf"\pm {x}")
        return step(_("First joint"), text, here, f"{one} = {either}", values)
    sign = "-" if plane.up > 0 else ""
    root = rf"\rho = \pm\sqrt{{{x}^2 + {y}^2 - D^2}}"
    if not plane.turns:
        text = _("The plane of the arm passes the first axis at the distance D; the point is nearer: out of reach.")
        square = float(point[0] ** 2 + point[1] ** 2) - plane.side**2
        lines = f"D = {number(plane.side)}", f"{x}^2 + {y}^2 - D^2 = {number(square)}"
        return step(_("First joint"), text, here, *lines)
    text = _("The plane of the arm passes the first axis at the distance D, on either side of the axis.")
    across = rf"D = {number(plane.side)}, \quad {root} = \pm {number(_rho(plane, point))}"
    turned = f"{one} = {atan2(y, x)} - " + atan2(f"{sign}D", r"\rho")
    return step(_("First joint"), text, here, across, turned, values)


def _rho(plane: Upright, point: Array) -> float:
    return math.sqrt(max(0.0, float(point[0] ** 2 + point[1] ** 2) - plane.side**2))


def _plane_step(arm: HandArm, plane: Upright, name: str) -> Step:
    height = "p_{z}" if name == "p" else "p_{wz}"
    root = r"\pm\sqrt{p_{x}^2 + p_{y}^2}" if name == "p" else r"\pm\sqrt{p_{wx}^2 + p_{wy}^2}"
    across = (root if abs(plane.side) < ROUNDING else r"\rho") + term(-arm.rows[0].a)
    up = f"{height}{term(-arm.rows[0].d)}"
    up = up if plane.up > 0 else f"-({up})"
    lines = [rf"(X, Y) = ({across},\; {up})", *(rf"(X, Y) = {vector(place)}" for place in plane.places)]
    return step(_("In the plane of the arm"), _("The other two joints move the point in this plane alone."), *lines)


def _slid(arm: HandArm, plane: Upright, end: Array, steps: list[Step]) -> Placed:
    """Turn the slide to the point: (X, Y) = R(ϑ₂) (u, v) with u constant, and v = ∓(d₃ + e)."""
    second = arm.rows[1]
    u, sign = second.a + float(end[0]), -math.sin(second.alpha)
    lines = [r"(X, Y) = R(\vartheta_{2}) (u,\; v), \quad u = " + number(u),
             rf"v = \pm\sqrt{{X^2 + Y^2 - u^2}}, \quad d_{{3}} = {'-' if sign < 0.0 else ''}v{term(-float(end[2]))}",
             rf"\vartheta_{{2}} = {atan2('Y', 'X')} - {atan2('v', 'u')}"]  # fmt: skip
    values, reached = [], True
    for turn, (X, Y) in zip(plane.turns, plane.places, strict=True):
        square = X * X + Y * Y - u * u
        if square < -ROUNDING:
            reached = False
            lines.append(rf"X^2 + Y^2 - u^2 = {number(square)}")
            continue
        root = math.sqrt(max(0.0, square))
        for v in (root, -root) if root > ROUNDING else (0.0,):
            tilt, slide = wrapped(math.atan2(Y, X) - math.atan2(v, u)), sign * v - float(end[2])
            lines.append(rf"v = {number(v)}: \quad d_{{3}} = {number(slide)}, \quad \vartheta_{{2}} = {number(tilt)}")
            values.append((turn, tilt, slide))
    text = _("The slide points at the target or away from it; its length is the distance that is left.")
    if not reached:
        text += " " + _("The distance is shorter than what stands beside the slide: out of reach.")
    return Placed([*steps, step(_("Second joint and slide"), text, *lines)], values)
