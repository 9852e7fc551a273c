"""Fast test whether tables may describe a chain, thousands at a time, by invariants under any choice of base.

Two axes have an angle and a mutual moment, parallel axes a distance, three axes a handedness. A base that is held adds
the axes of its frame, and so does the tip if the tool is held. Equal invariants are necessary but not always
sufficient, so the tables that pass are then fitted to the chain.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.placement import Subject
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.dh import Convention, DhTable

_LOOSENESS = 10.0
"""Number of tolerances by which invariants may differ if the table may still be within tolerance."""
_PARALLEL = 1e-6


class Axes(NamedTuple):
    """Axes of C tables, from base to tip, as directions and moments; shape (m, 3, C) each."""

    directions: Array
    moments: Array

    def only(self, chosen: Flags) -> "Axes":
        """Select the axes of some tables."""
        return Axes(self.directions[..., chosen], self.moments[..., chosen])


class _Invariant(NamedTuple):
    """An invariant of two or three axes, by their indices; whether two are parallel, and whether positions count."""

    axes: tuple[int, ...]
    parallel: bool
    placed: bool


class Invariants:
    """The invariants of a chain, to be compared with those of tables.

    `straddles` tells whether an invariant spans a link, (invariants, n + 1): link k leads from joint k - 1 to joint k,
    counted from 0, the first one from the base and the last one to the tip.
    """

    def __init__(self, on: Subject, freedom: Freedom) -> None:
        """Compute the invariants that the given freedom leaves: with free zeros, only those of neighbours."""
        n, target = len(on.target), on.target
        self._freedom, self._slides = freedom, target.slides
        moments = np.where(target.slides[:, None], 0.0, target.twists[:, :3])
        joints = list(zip(target.directions[..., None], moments[..., None], strict=True))
        self._target = _with_ends(joints, target.tip[..., None], freedom)
        places = [-1] * (0 if freedom.base else 3) + list(range(n)) + [n] * (0 if freedom.tool else 3)
        self._invariants = self._chosen(places)
        across = [
            [places[each.axes[0]] < k <= places[each.axes[-1]] for k in range(n + 1)] for each in self._invariants
        ]
        self.straddles = np.array(across, dtype=bool).reshape(-1, n + 1)
        reach = 1.0 + float(np.abs(self._target.moments).max(initial=0.0))
        position, orientation = on.tolerances
        self._tolerances = _LOOSENESS * orientation, _LOOSENESS * (position + orientation * reach)

    def _chosen(self, places: list[int]) -> list[_Invariant]:
        """Pairs of axes, neighbours first, then triples of joints."""
        n, free_zeros = len(self._slides), self._freedom.offsets
        turns = [not (0 <= place < n and self._slides[place]) for place in places]
        found = []
        for i, j in sorted(np.ndindex(len(places), len(places)), key=lambda pair: pair[1] - pair[0]):
            if places[i] < places[j] and not (free_zeros and places[j] > places[i] + 1):
                across = np.cross(self._target.directions[i, :, 0], self._target.directions[j, :, 0])
                parallel = float(np.linalg.norm(across)) <= _PARALLEL
                found.append(_Invariant((i, j), parallel, turns[i] and turns[j]))
        first = places.index(0)
        triples = range(first, first + n - 2) if not free_zeros else ()
        return found + [_Invariant((k, k + 1, k + 2), parallel=False, placed=False) for k in triples]

    def axes(self, convention: Convention, rows: Array, senses: Array, table: DhTable) -> Axes:
        """Compute the axes of tables that differ from one table in numbers and senses; shapes (C, n, 4), (C, n)."""
        base = np.eye(4) if self._freedom.base else table.base
        x, y, z, p = (np.repeat(base[:3, k, None], len(rows), axis=1) for k in range(4))
        numbers = np.ascontiguousarray(rows.transpose(1, 2, 0))
        cosines, sines = np.cos(numbers), np.sin(numbers)
        joints = []
        for i, (a, _, d, _) in enumerate(numbers):
            (_, ca, _, ct), (_, sa, _, st) = cosines[i], sines[i]
            if convention == "modified":
                p, y, z = p + a * x, ca * y + sa * z, ca * z - sa * y
            sense = senses[:, i]
            joints.append((sense * z, sense * (np.zeros_like(p) if self._slides[i] else _cross(p, z))))
            p, x, y = p + d * z, ct * x + st * y, ct * y - st * x
            if convention == "standard":
                p, y, z = p + a * x, ca * y + sa * z, ca * z - sa * y
        ends = np.zeros((4, 4, len(rows)))
        ends[:3] = np.stack((x, y, z, p), axis=1)
        ends[3, 3] = 1.0
        tips = np.einsum("ijc,jk->ikc", ends, table.tool)
        return _with_ends(joints, tips, self._freedom)

    def agreeing(self, axes: Axes) -> Indices:
        """Return the indices of the tables that have every invariant."""
        alive = np.arange(axes.directions.shape[-1])
        for each in self._invariants:
            fits = self._fits(each, axes)
            if not fits.all():
                alive, axes = alive[fits], axes.only(fits)
        return alive

    def misfits(self, axes: Axes) -> Flags:
        """Return which invariants each table violates; shape (C, invariants)."""
        misfits = np.empty((axes.directions.shape[-1], len(self._invariants)), dtype=bool)
        for k, each in enumerate(self._invariants):
            misfits[:, k] = ~self._fits(each, axes)
        return misfits

    def _fits(self, each: _Invariant, axes: Axes) -> Flags:
        angle, length = self._tolerances
        fits: Flags = self._apart(each, axes, _angular) <= angle
        if each.placed:
            fits &= self._apart(each, axes, _distance if each.parallel else _moment) <= length
        return fits

    def _apart(self, each: _Invariant, axes: Axes, number: Callable[[tuple[int, ...], Axes], Array]) -> Array:
        found, wanted = number(each.axes, axes), number(each.axes, self._target)
        return np.abs(np.abs(found) - np.abs(wanted)) if self._freedom.signs else np.abs(found - wanted)


def _with_ends(joints: list[tuple[Array, Array]], tips: Array, freedom: Freedom) -> Axes:
    """Axes of joints, preceded by those of the base frame and followed by those of the tip if these are held."""
    bases = np.repeat(np.eye(4)[..., None], tips.shape[-1], axis=2)
    before, behind = (
        [(T[:3, k], _cross(T[:3, 3], T[:3, k])) for k in range(3) if not free]
        for T, free in ((bases, freedom.base), (tips, freedom.tool))
    )
    directions, moments = zip(*before, *joints, *behind, strict=True)
    return Axes(np.array(directions), np.array(moments))


def _angular(which: tuple[int, ...], axes: Axes) -> Array:
    """Cosine of the angle between two axes, or triple product of three."""
    u, w, *rest = (axes.directions[k] for k in which)
    return _dot(_cross(u, w), rest[0]) if rest else _dot(u, w)


def _moment(which: tuple[int, ...], axes: Axes) -> Array:
    i, j = which
    return _dot(axes.directions[i], axes.moments[j]) + _dot(axes.directions[j], axes.moments[i])


def _distance(which: tuple[int, ...], axes: Axes) -> Array:
    """Distance between parallel axes."""
    i, j = which
    apart = axes.moments[i] - _dot(axes.directions[i], axes.directions[j]) * axes.moments[j]
    return np.sqrt(_dot(apart, apart))


def _dot(a: Array, b: Array) -> Array:
    product: Array = a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    return product


def _cross(a: Array, b: Array) -> Array:
    (ax, ay, az), (bx, by, bz) = a, b
    return np.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx))
