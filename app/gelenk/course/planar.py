"""Workspaces of planar arms with revolute joints that turn without limits.

WS₁, the primary workspace, is every point that the tip reaches with at least one orientation φ; WS₂, the secondary one,
is every point that it reaches with all of them. Both consist of rings around the base, so intervals of the distance r
from the base describe them fully; a ring that begins at r = 0 is a disc.

The arm is divided into an arm without its last link, whose own WS₁ is one ring [a, b], and a last link of length l that
can have any orientation at the wrist: WS₁ is [max(0, a - l, l - b), b + l]. With the tip at r, the wrist moves on a
circle of radius l, which stays within the ring where r + l ≤ b and |r - l| ≥ a: that is WS₂, in up to two pieces.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.errors import CertificationFailed
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result

Interval: TypeAlias = tuple[float, float]
Location: TypeAlias = Literal["inside", "boundary", "outside"]

_ROUNDING = 1e-12
_RADII = 48
_ORIENTATIONS = 181


@dataclass(frozen=True, slots=True)
class PlanarWorkspace:
    """The workspaces of a planar arm.

    Attributes:
        links: l_1 … l_n ≥ 0, [m].
        wrist: WS₁ of all but the last link, one ring, [m].
        primary, secondary: WS₁ and WS₂ as intervals of r, [m], from the inside out; WS₂ may have none, one or two.
    """

    links: tuple[float, ...]
    wrist: Interval
    primary: tuple[Interval, ...]
    secondary: tuple[Interval, ...]


def planar_workspace(links: Sequence[float]) -> PlanarWorkspace:
    """Compute the exact workspaces of a planar arm of two or three links, [m].

    Lengths that differ only by rounding count as equal, so that a piece of WS₂ that is a circle or a point is not lost.
    """
    tolerance = _ROUNDING * sum(links)
    wrist = (links[0], links[0])
    for length in links[1:-1]:
        wrist = _with_link(wrist, length, tolerance)
    primary = (_with_link(wrist, links[-1], tolerance),)
    return PlanarWorkspace(tuple(links), wrist, primary, _secondary(wrist, links[-1], tolerance))


def _with_link(ring: Interval, length: float, tolerance: float) -> Interval:
    inner = max(0.0, ring[0] - length, length - ring[1])
    return (inner if inner > tolerance else 0.0, ring[1] + length)


def _secondary(wrist: Interval, length: float, tolerance: float) -> tuple[Interval, ...]:
    """Return the rings where r + l ≤ b and either r ≤ l - a or r ≥ l + a, joined where they touch."""
    inner, outer = wrist
    pieces: list[Interval] = []
    for lower, upper in ((0.0, min(length - inner, outer - length)), (length + inner, outer - length)):
        if upper < lower - tolerance:
            continue
        if abs(upper - lower) <= tolerance:
            upper = lower  # noqa: PLW2901
        if pieces and lower <= pieces[-1][1] + tolerance:
            pieces[-1] = (pieces[-1][0], max(upper, pieces[-1][1]))
        else:
            pieces.append((lower, upper))
    return tuple(pieces)


def area(rings: Sequence[Interval]) -> float:
    """Return the area of rings, Σ π (r_max² - r_min²), [m²]."""
    return sum(math.pi * (outer - inner) * (outer + inner) for inner, outer in rings)


@dataclass(frozen=True, slots=True)
class WorkspacePlace(Result):
    """Where the point lies relative to a workspace.

    Attributes:
        location: `boundary` within the tolerance.
        boundary: Radius of the nearest boundary, [m]; null for an empty workspace.
        distance: To that boundary, [m]: positive inside, negative outside.
    """

    location: Location
    boundary: float | None
    distance: float | None


def place(rings: Sequence[Interval], radius: float, tolerance: float) -> WorkspacePlace:
    """Locate a radius, [m], relative to rings; the centre of a disc is not a boundary."""
    bounds = [bound for inner, outer in rings for bound in (inner, outer) if bound > 0.0 or outer == 0.0]
    inside = any(inner <= radius <= outer for inner, outer in rings)
    if not bounds:
        return WorkspacePlace("outside", None, None)
    nearest = min(bounds, key=lambda bound: abs(bound - radius))
    distance = abs(nearest - radius)
    location: Location = "boundary" if distance <= tolerance else "inside" if inside else "outside"
    return WorkspacePlace(location, nearest, distance if inside else -distance)


def orientations(arm: PlanarWorkspace, x: float, y: float) -> tuple[Interval, ...]:
    """Return the orientations φ of the last link with which a point is reached, as closed intervals, [rad].

    With ψ = φ - atan2(y, x), the wrist's distance ρ² = r² + l² - 2 r l cos ψ must lie in its ring, which bounds cos ψ
    from both sides. An interval begins in (-π, π] and may end beyond π; a whole turn is (-π, π).
    """
    length, radius = arm.links[-1], math.hypot(x, y)
    inner, outer = arm.wrist
    size = sum(arm.links) + radius
    nearest, farthest, rounding = abs(radius - length), radius + length, _ROUNDING * size
    if farthest < inner - rounding or nearest > outer + rounding:
        return ()
    if min(radius, length) <= rounding:
        return ((-math.pi, math.pi),)
    smallest = 0.0 if inner <= nearest + rounding else _angle(min(inner, farthest), nearest, farthest)
    largest = math.pi if outer >= farthest - rounding else _angle(max(outer, nearest), nearest, farthest)
    if largest < smallest:
        return ()
    towards = math.atan2(y, x)
    if smallest == 0.0:
        if largest == math.pi:
            return ((-math.pi, math.pi),)
        return (_shifted(towards - largest, towards + largest),)
    if largest == math.pi:
        return (_shifted(towards + smallest, towards + 2.0 * math.pi - smallest),)
    return tuple(
        sorted((_shifted(towards - largest, towards - smallest), _shifted(towards + smallest, towards + largest)))
    )


def _angle(distance: float, nearest: float, farthest: float) -> float:
    """Return ψ at which the wrist has a given distance, by tan²(ψ/2) = (ρ² - ρ_min²) / (ρ_max² - ρ²)."""
    above = (distance - nearest) * (distance + nearest)
    below = (farthest - distance) * (farthest + distance)
    return 2.0 * math.atan2(math.sqrt(max(above, 0.0)), math.sqrt(max(below, 0.0)))


def _shifted(lower: float, upper: float) -> Interval:
    """Shift an interval by whole turns so that it begins in (-π, π]."""
    turns = math.ceil((lower - math.pi) / (2.0 * math.pi))
    return lower - 2.0 * math.pi * turns, upper - 2.0 * math.pi * turns


def share(intervals: Sequence[Interval]) -> float:
    """Return the fraction of all orientations that intervals cover, in [0, 1]."""
    return min(1.0, sum(upper - lower for lower, upper in intervals) / (2.0 * math.pi))


def posture(arm: PlanarWorkspace, x: float, y: float, orientation: float) -> Array:
    """Return base, joints and tip, the elbow to the right, for a tip at (x, y); shape (n + 1, 2), [m].

    The last link's orientation φ is one of `orientations`, [rad].
    """
    wrist = np.array([x, y]) - arm.links[-1] * np.array([math.cos(orientation), math.sin(orientation)])
    between = []
    if len(arm.links) == 3:
        l1, l2 = arm.links[:2]
        distance = float(np.hypot(*wrist))
        below = 2.0 * l1 * distance
        cosine = (l1**2 + distance**2 - l2**2) / below if below > 0.0 else 0.0
        angle = math.atan2(wrist[1], wrist[0]) - math.acos(min(1.0, max(-1.0, cosine)))
        between = [np.array([l1 * math.cos(angle), l1 * math.sin(angle)])]
    return np.array([np.zeros(2), *between, wrist, np.array([x, y])])


@dataclass(frozen=True, slots=True)
class WorkspaceTrial(Result):
    """Comparison of both workspaces with moving the joints, before anything is sent.

    Attributes:
        radii: Distances at which they were compared.
        orientations: Orientations tried at each.
    """

    radii: int
    orientations: int


def tried(arm: PlanarWorkspace) -> WorkspaceTrial:
    """Check both workspaces by trying orientations of the last link at distances inside and outside their boundaries.

    The wrist's ring comes from positions of the links before it, from folded to stretched. Since the wrist's distance
    is a continuous function of the orientation, its extremes show whether some or all orientations are reached. Raises
    CertificationFailed if a distance within WS₁ is not reached, a distance outside is, or likewise for WS₂.
    """
    reach = sum(arm.links)
    if reach == 0.0:
        return WorkspaceTrial(0, 0)
    turned = np.exp(1j * np.linspace(0.0, math.pi, _ORIENTATIONS))
    before = np.abs(arm.links[0] + sum(arm.links[1:-1]) * turned)
    bounds = np.array([bound for ring in (*arm.primary, *arm.secondary) for bound in ring])
    radii = np.linspace(0.0, 1.1 * reach, _RADII)
    radii = radii[np.min(np.abs(radii[:, None] - bounds), axis=1) > 1e-3 * reach]
    wrists = np.abs(radii[:, None] - arm.links[-1] * turned)
    nearest, farthest, rounding = wrists.min(axis=1), wrists.max(axis=1), _ROUNDING * reach
    inner, outer = before.min() - rounding, before.max() + rounding
    for name, rings, found in (
        ("the primary workspace", arm.primary, (nearest <= outer) & (farthest >= inner)),
        ("the secondary workspace", arm.secondary, (nearest >= inner) & (farthest <= outer)),
    ):
        said = np.array([any(lower <= radius <= upper for lower, upper in rings) for radius in radii.tolist()])
        if wrong := int(np.count_nonzero(said != found)):
            raise CertificationFailed(f"{name}, in number of distances,", wrong, 0.0)
    return WorkspaceTrial(len(radii), _ORIENTATIONS)


def workspace_steps(arm: PlanarWorkspace) -> tuple[Step, ...]:
    """Return the worked solution: the reach, and the circle of the wrist."""
    lengths = ", ".join(rf"l_{number} = {tex(length)}" for number, length in enumerate(arm.links, start=1))
    (inner, outer), n, last = arm.wrist, len(arm.links), arm.links[-1]
    total, excess = sum(arm.links), tex(2.0 * max(arm.links) - sum(arm.links))
    near, far = tex(last - inner), tex(last + inner, "m")
    rings = r" \cup ".join(rf"[{tex(lower)},\ {tex(upper)}]" for lower, upper in arm.secondary) or r"\varnothing"
    beyond = rf"r \ge {far} \text{{ {_('or')} }} r \le {near}\,\mathrm{{m}}"
    return (
        step(
            _("Primary workspace"),
            _(
                "Stretched the arm reaches farthest. It reaches the base unless one link is longer than all the others "
                "together."
            ),
            lengths,
            rf"r_{{\max}} = \sum l_i = {tex(total, 'm')}",
            rf"r_{{\min}} = \max(0,\ 2\,l_{{\max}} - \sum l_i) = \max(0,\ {excess}) = {tex(arm.primary[0][0], 'm')}",
        ),
        step(
            _("Secondary workspace"),
            _(
                "With all orientations at distance r the wrist goes round a circle of radius l_{n} about the tip, and "
                "comes as near to the base as |r - l_{n}| and as far as r + l_{n}: all of it has to be within the ring "
                "that the wrist can reach."
            ).format(n=n),
            rf"\rho \in [{tex(inner)},\ {tex(outer)}]\,\mathrm{{m}}",
            rf"r + l_{n} \le {tex(outer)} \;\Rightarrow\; r \le {tex(outer - last, 'm')}",
            rf"|r - l_{n}| \ge {tex(inner)} \;\Rightarrow\; {beyond}",
            rf"\mathrm{{WS}}_2:\ r \in {rings}",
        ),
    )
