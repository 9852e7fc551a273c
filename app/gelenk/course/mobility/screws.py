"""Mobility at one posture, from the positions of the axes, which the formula ignores.

A pair allows its f freedoms as twists (v, ω), linear first, in the axes of the ground; it forbids the λ - f
combinations of velocities that are orthogonal to all of them. For the twists of all links but the ground, all pairs
together give Σc equations, of which r are independent: M = λ(n - 1) - r, and Σc - r constraints are redundant.

This counts velocities. At a singular posture, such as a four-bar stretched to a line, it exceeds the number of freedoms
that the linkage has elsewhere.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.course.mobility.mechanism import Mechanism, Pair
from gelenk.course.mobility.pairs import FREEDOMS, PairGeometry
from gelenk.errors import InvalidField, TooLarge, certify, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.result import Result

MAX_LINKS = 64
"""Largest number of links: the time of the decomposition grows with its cube."""

_PLANE = [0, 1, 5]
"""Components of a twist in the plane: v_x, v_y and ω_z."""
_DIRECTIONS = 1e-9
_NOISE = 1e-13
"""Singular values up to this, relative to the largest, count as rounding whatever tolerance is requested."""
_ROUNDING = 1e-11
_POINT_AND_AXIS = ("revolute", "cylindrical", "sphere_in_groove", "point_contact", "pin_in_slot", "cam", "gear")
_NEEDS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(_POINT_AND_AXIS, ("point", "axis")),
    **dict.fromkeys(("prismatic", "planar"), ("axis",)),
    **dict.fromkeys(("spherical", "rolling"), ("point",)),
    "screw": ("point", "axis", "pitch"),
    "universal": ("point", "axis", "second_axis"),
    "fixed": (),
}
_WHERE: dict[str, str] = {
    "axis": "a {kind} pair has no axis",
    "second_axis": "only a universal joint has a second axis; this pair is {kind}",
    "pitch": "only a screw has a pitch; this pair is {kind}",
}
"""Reason for refusing a field that a kind of pair does not need; every kind may have a point."""


@dataclass(frozen=True, slots=True)
class PostureMobility(Result):
    """The mobility in the given posture, from the location of the axes; at a singular posture larger than elsewhere.

    Attributes:
        mobility: λ(n - 1) - r with the number r of constraints that are independent there.
        redundant: Σc - r: constraints that others imply, which the formula counts nonetheless.
        output: Freedoms of the link `output`; null where none was named.
        smallest_counted: Smallest singular value that counts for r, no unit; null if none does.
        largest_neglected: Largest singular value that does not count, no unit; null if all do.
        residual: The certificate: largest velocity, of the motions that are left, that a pair does not allow; no unit,
            lengths relative to the size of the linkage.
    """

    mobility: int
    redundant: int
    output: int | None
    smallest_counted: float | None
    largest_neglected: float | None
    residual: float


def posture(found: Mechanism, output: int | None, tolerance: float) -> PostureMobility | None:
    """Compute the mobility at the given posture, and the freedoms of the link of index `output`.

    None if no pair has a position. A singular value counts if it exceeds `tolerance` times the largest, or `tolerance`
    if the largest is below 1. Raises TooLarge for more than `MAX_LINKS` links, and InvalidField if a pair lacks a value
    that its kind needs, has one that its kind does not have, leaves the plane, or has axes that are not independent.
    """
    if not any(found.geometries):
        return None
    if len(found.links) > MAX_LINKS:
        raise TooLarge("links with geometry", len(found.links), MAX_LINKS)
    twists = _freedoms(found)
    equations = _equations(found, twists)
    size = FREEDOMS[found.space] * (len(found.links) - 1)
    # With more equations than unknowns, the triangular factor is equivalent and has fewer rows.
    _, sigma, Vt = np.linalg.svd(np.linalg.qr(equations, mode="r") if len(equations) > size else equations)
    tolerance = max(tolerance, _NOISE)
    rank = int(np.sum(sigma > tolerance * max(float(sigma.max(initial=0.0)), 1.0)))
    return PostureMobility(
        size - rank,
        len(equations) - rank,
        None if output is None else _output(found, Vt[rank:], output, tolerance),
        float(sigma[rank - 1]) if rank else None,
        float(sigma[rank]) if rank < len(sigma) else None,
        _residual(found, twists, Vt[rank:], tolerance),
    )


def _freedoms(found: Mechanism) -> list[Array]:
    """Return the twists that each pair allows, shape (λ, f), with lengths relative to the linkage's size."""
    complete = [_complete(found, pair, number) for number, pair in enumerate(found.pairs)]
    points = np.array([geometry.point for geometry in complete if geometry.point is not None]).reshape(-1, 3)
    centre = points.mean(axis=0) if len(points) else np.zeros(3)
    size = float(np.abs(points - centre).max(initial=0.0)) or 1.0
    if found.space == "planar":
        _refuse_out_of_plane(complete, size)
    twists = []
    for number, (pair, geometry) in enumerate(zip(found.pairs, complete, strict=True)):
        S = _twists(pair.type, geometry, centre, size)
        S = S[_PLANE] if found.space == "planar" else S
        sigma = np.linalg.svd(S, compute_uv=False)
        if S.shape[1] and sigma[-1] <= _DIRECTIONS * sigma[0]:
            reason = "its freedoms are not independent: axes that should differ are parallel, or leave the plane"
            raise InvalidField(f"pairs/{number}", f"{quoted(pair.name)}: {reason}")
        twists.append(S)
    return twists


def _complete(found: Mechanism, pair: Pair, number: int) -> PairGeometry:
    """Return the complete position of a pair; an added pair takes that of another pair at its joint."""
    geometry = found.geometries[number]
    if geometry is None and pair.added:
        others = zip(found.pairs, found.geometries, strict=True)
        like_it = (other for one, other in others if (one.joint, one.type) == (pair.joint, pair.type))
        geometry = next(filter(None, like_it), None)
    says = geometry is not None
    geometry = geometry or PairGeometry()
    needs, takes = _NEEDS[pair.type], _NEEDS[pair.type]
    if found.space == "planar" and pair.type in {"revolute", "rolling"}:
        needs, takes = ("point",), ("point", "axis")
        if geometry.axis is not None and abs(geometry.axis[2]) < 1.0 - _DIRECTIONS:
            reason = f"{quoted(pair.name)}: in the plane the axis to turn about is z; leave it out, or count in space"
            raise InvalidField(f"pairs/{number}/axis", reason)
    for name, reason in _WHERE.items():
        if name not in takes and getattr(geometry, name) is not None:
            raise InvalidField(f"pairs/{number}/{name}", f"{quoted(pair.name)}: {reason.format(kind=pair.type)}")
    for name in needs:
        if getattr(geometry, name) is None:
            why = "to say where it is" if says else "because other pairs say where they are"
            reason = f"{quoted(pair.name)} needs {' and '.join(needs)}{'' if says else ','} {why}"
            raise InvalidField(f"pairs/{number}/{name}", reason)
    turns_in_plane = "axis" in takes and "axis" not in needs
    return replace(geometry, axis=(0.0, 0.0, 1.0)) if turns_in_plane else geometry


def _refuse_out_of_plane(complete: Sequence[PairGeometry], size: float) -> None:
    """Refuse points at different heights, and slots, guides and normals that lead out of the x y plane."""
    heights = [geometry.point[2] for geometry in complete if geometry.point is not None]
    for number, geometry in enumerate(complete):
        if geometry.point is not None and abs(geometry.point[2] - heights[0]) > _DIRECTIONS * size:
            reason = "a planar linkage moves in a plane of x and y: all its points have the same z"
            raise InvalidField(f"pairs/{number}/point", reason)
        if geometry.axis is not None and _DIRECTIONS < abs(geometry.axis[2]) < 1.0 - _DIRECTIONS:
            reason = "in the plane it has no component along z"
            raise InvalidField(f"pairs/{number}/axis", reason)


def _twists(kind: str, geometry: PairGeometry, centre: Array, size: float) -> Array:
    """Return the freedoms of a pair as columns (v, ω); shape (6, f)."""
    p = (np.array(geometry.point or centre) - centre) / size
    a, b = np.array(geometry.axis or (0.0, 0.0, 0.0)), np.array(geometry.second_axis or (0.0, 0.0, 0.0))
    turn = _turn(p, a)
    slide = _slide(a)
    ball = [_turn(p, axis) for axis in np.eye(3)]
    # Two directions orthogonal to the axis and to each other.
    across = [_slide(axis) for axis in np.linalg.svd(a[None])[2][1:]] if geometry.axis else []
    # In the plane the contact turns about its point, and slides along the slot or the common tangent.
    about_normal, tangent = ball[2], _slide(np.array([-a[1], a[0], 0.0]))
    columns: dict[str, list[Array]] = {
        "revolute": [turn],
        "rolling": [turn],
        "prismatic": [slide],
        "screw": [turn + (geometry.pitch or 0.0) / size * slide],
        "universal": [turn, _turn(p, b)],
        "cylindrical": [turn, slide],
        "spherical": ball,
        "planar": [turn, *across],
        "sphere_in_groove": [*ball, slide],
        "point_contact": [*ball, *across],
        "fixed": [],
        "pin_in_slot": [about_normal, slide],
        "cam": [about_normal, tangent],
        "gear": [about_normal, tangent],
    }
    return np.array(columns[kind]).reshape(-1, 6).T


def _turn(point: Array, axis: Array) -> Array:
    """Return the twist of a rotation about an axis through a point: the velocity at the origin, and ω."""
    return np.concatenate((np.cross(point, axis), axis))


def _slide(direction: Array) -> Array:
    return np.concatenate((direction, np.zeros(3)))


def _equations(found: Mechanism, twists: Sequence[Array]) -> Array:
    """Return the constraints of all pairs, as rows on the twists of all links but the ground; shape (Σc, λ(n - 1))."""
    freedoms = FREEDOMS[found.space]
    columns = freedoms * len(found.links)
    rows: list[Array] = [np.zeros((0, columns))]
    for links, S in zip(found.ends, twists, strict=True):
        forbidden = np.linalg.svd(S)[0][:, S.shape[1] :].T
        block = np.zeros((len(forbidden), columns))
        a, b = (slice(freedoms * link, freedoms * (link + 1)) for link in links)
        block[:, b], block[:, a] = forbidden, -forbidden
        rows.append(block)
    ground = range(freedoms * found.ground, freedoms * (found.ground + 1))
    return np.delete(np.concatenate(rows), list(ground), axis=1)


def _output(found: Mechanism, motions: Array, link: int, tolerance: float) -> int:
    """Return the number of a link's freedoms among the possible motions, of shape (M, λ(n - 1))."""
    if link == found.ground or not len(motions):
        return 0
    freedoms = FREEDOMS[found.space]
    first = freedoms * (link - (link > found.ground))
    sigma = np.linalg.svd(motions[:, first : first + freedoms], compute_uv=False)
    return int(np.sum(sigma > tolerance))


def _residual(found: Mechanism, twists: Sequence[Array], motions: Array, tolerance: float) -> float:
    """Return how far the possible motions deviate from what each pair allows, by least squares on its freedoms."""
    if not len(motions):
        return 0.0
    freedoms, worst = FREEDOMS[found.space], 0.0
    still = freedoms * found.ground
    whole = np.concatenate((motions[:, :still], np.zeros((len(motions), freedoms)), motions[:, still:]), axis=1)
    velocities = whole.reshape(len(motions), len(found.links), freedoms)
    for (a, b), S in zip(found.ends, twists, strict=True):
        relative = (velocities[:, b] - velocities[:, a]).T
        rest = relative - S @ np.linalg.lstsq(S, relative, rcond=None)[0]
        worst = max(worst, float(np.abs(rest).max()))
    allowed = max(_ROUNDING, 10.0 * tolerance)
    certify("motion of a linkage", worst, allowed)
    return worst
