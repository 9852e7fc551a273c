"""Solutions by trying postures: the wrist's ring from turned links, and orientations one after the other."""

from math import pi
from typing import Any

import numpy as np

TURNS = np.exp(1j * np.linspace(0.0, 2 * pi, 721))
RADII = np.linspace(0.0, 4.5, 4501)
"""Every millimetre."""


def wrist(lengths: Any) -> tuple[float, float]:
    distances = np.abs(lengths[0] + (lengths[1] * TURNS if len(lengths) > 1 else 0.0 * TURNS))
    return float(distances.min()), float(distances.max())


def runs(reached: Any) -> list[tuple[float, float]]:
    """Intervals of radii that are reached."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], reached.astype(int), [0]))))
    return [(float(RADII[a]), float(RADII[b - 1])) for a, b in edges.reshape(-1, 2)]


def spans(lengths: Any) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Radii reached with one orientation, and with all."""
    inner, outer = wrist(lengths[:-1])
    distances = np.abs(RADII[:, None] - lengths[-1] * TURNS)
    near, far = distances.min(axis=1), distances.max(axis=1)
    some = (near <= outer + 1e-9) & (far >= inner - 1e-9)
    return runs(some), runs((near >= inner - 1e-9) & (far <= outer + 1e-9))


def size(ring: Any) -> float:
    return float(pi * (ring[1] ** 2 - ring[0] ** 2))


def whole(one: Any) -> dict[str, Any]:
    ring = spans(tuple(one))[0][0]
    return {"inner": ring[0], "outer": ring[1], "area": size(ring)}


def pieces(lengths: Any) -> tuple[str, float, tuple[float, float]]:
    found = spans(lengths)[1]
    disc = next((b for a, b in found if a == 0.0), 0.0)
    ring = next(((a, b) for a, b in found if a > 0.0), (0.0, 0.0))
    names = {(False, False): "empty", (True, False): "disc", (False, True): "ring", (True, True): "disc_and_ring"}
    return names[disc > 0.0, ring[1] > 0.0], disc, ring


def secondary(one: Any) -> dict[str, Any]:
    return dict(zip(("shape", "disc", "ring"), pieces(tuple(one)), strict=True))


def directions(one: Any) -> dict[str, Any]:
    angles = np.linspace(0.0, pi, 400_001)
    far = np.abs(one.x - one.l3 * np.exp(1j * angles)) <= one.l1 + one.l2
    limit = float(angles[far].max())
    return {"limit": limit, "share": float(far.mean())}


def design(one: Any) -> dict[str, Any]:
    l1, l2 = np.linalg.solve([[1, 1], [1, -1]], [one.outer, one.inner])
    lengths = (round(float(l1), 6), round(float(l2), 6), one.l3)
    shape, _, ring = pieces(lengths)
    return {
        "links": [l1, l2],
        "primary": spans(lengths)[0][0],
        "shape": shape,
        "secondary": ring,
        "area": size(ring),
    }


SOLUTIONS = {
    "workspaces.ring": whole,
    "workspaces.primary": whole,
    "workspaces.secondary": secondary,
    "workspaces.orientations": directions,
    "workspaces.design": design,
}
DIGESTS = {
    "workspaces.ring:1": "81c2f29ef4eb7557",
    "workspaces.primary:1": "aff0ff132e021f8d",
    "workspaces.secondary:1": "783b7adcc8d44d9c",
    "workspaces.orientations:1": "be38f8ffa6916873",
    "workspaces.design:1": "5ab28f04ce00998a",
}
