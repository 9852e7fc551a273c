"""Where a piece of the joint path leaves the joint limits or comes too near to a singularity, also between knots.

A quintic stays between its Bernstein coefficients; if these do not decide, its roots do. The smallest singular value σ
changes by at most ‖dJ/ds‖ per unit of s: samples are added until no dip below the floor can stay hidden.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.rate_field import Knot, RateField
from gelenk.trajectory.follow.step import HULL, INNER, TO_POWERS, Piece, knot_within, pieces_between

SLACK = 1e-10
"""Distance beyond a limit at which a joint still counts as within, [rad or m]."""
CERTAIN = 1.5
"""Safety factor on the change of σ that the derivatives at both knots give."""
FINEST = 0.05
"""Depth of a dip of σ below the floor that may stay undetected, in fractions of the floor."""
_MOST_PLACES = 4000
_GROWING = 1.0 + 1e-9
_SAG = 0.99
"""Share of the largest σ so far that σ must keep on the way out of a singularity."""
_ROUNDS = 60
_CLOSEST = 1e-9
"""Accuracy of a located place, in fractions of a piece."""

Violation: TypeAlias = Literal["joint_limit", "threshold", "lost"]


@dataclass(frozen=True, slots=True)
class Crossing:
    """The first place at which a bound is violated.

    Attributes:
        good: The last place known to be good, [m or rad].
        bad: A place beyond it where the bound is violated.
        joint: Index of the joint that leaves its limits, if any.
        floor: Lower bound on σ there.
    """

    good: float
    bad: float
    kind: Violation
    joint: int | None = None
    floor: float = 0.0


def limit_crossing(field: RateField, piece: Piece) -> Crossing | None:
    """Find the first place in a piece at which a joint leaves its limits."""
    lower, upper = field.chain.lower - SLACK, field.chain.upper + SLACK
    hull = HULL @ piece.data
    found: Crossing | None = None
    for joint in np.flatnonzero((hull.min(axis=0) < lower) | (hull.max(axis=0) > upper)):
        powers = TO_POWERS @ piece.data[:, joint]
        for bound, side in ((lower[joint], -1.0), (upper[joint], 1.0)):
            taus = _first_outside(powers, bound, side) if np.isfinite(bound) else None
            if taus is not None and (found is None or piece.a.s + piece.width * taus[0] < found.good):
                good, bad = (piece.a.s + piece.width * tau for tau in taus)
                found = Crossing(good, bad, "joint_limit", int(joint))
    return found


def _first_outside(powers: Array, bound: float, side: float) -> tuple[float, float] | None:
    """Return start and middle of the first part of 0 ≤ τ ≤ 1 in which a polynomial is beyond a bound."""
    shifted = side * (powers - bound * (np.arange(6) == 0))
    roots = np.roots(shifted[::-1]) if np.abs(shifted[1:]).max() > 0.0 else np.empty(0)
    real = np.sort(roots.real[(np.abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < 1.0)])
    edges = np.concatenate(([0.0], real, [1.0]))
    middles = 0.5 * (edges[:-1] + edges[1:])
    outside = np.flatnonzero(middles[:, None] ** np.arange(6) @ shifted > 0.0)
    return (float(edges[outside[0]]), float(middles[outside[0]])) if len(outside) else None


def threshold_crossing(
    field: RateField, piece: Piece, best: float, stretch: tuple[float, float]
) -> tuple[Crossing | None, float]:
    """Find the first place in a piece at which σ falls below the threshold, and the largest σ so far.

    If the path began below the threshold, σ must grow instead until it is above; `best` is the largest σ before the
    piece. The path has no break between the two ends of `stretch`.
    """
    threshold = field.threshold
    taus, sigmas = _resolved(field, piece, _floor(threshold, best), stretch)
    largest = np.maximum.accumulate(np.maximum(sigmas, best))
    below = sigmas < np.where(largest >= threshold, threshold, _SAG * largest)
    if best < threshold and largest[-1] <= best * _GROWING:
        return Crossing(piece.a.s, piece.a.s, "threshold", None, threshold), best
    bad = np.flatnonzero(below[1:])
    if not len(bad):
        return None, float(largest[-1])
    good_s, bad_s = (float(piece.a.s + piece.width * taus[bad[0] + i]) for i in (0, 1))
    floor = _floor(threshold, float(largest[bad[0]]))
    return Crossing(good_s, bad_s, "threshold", None, floor), float(largest[-1])


def _floor(threshold: float, best: float) -> float:
    return threshold if best >= threshold else _SAG * best


def _resolved(field: RateField, piece: Piece, floor: float, stretch: tuple[float, float]) -> tuple[Array, Array]:
    """Return places from 0 to 1 and σ there, so dense that σ cannot fall below the floor between them unnoticed."""
    taus, sigmas = np.linspace(0.0, 1.0, len(piece.sigmas)), piece.sigmas
    change = CERTAIN * piece.width * max(piece.a.change, piece.b.change)
    while len(taus) < _MOST_PLACES:
        widths = np.diff(taus)
        lowest = 0.5 * (sigmas[:-1] + sigmas[1:] - change * widths)
        seen = np.minimum(sigmas[:-1], sigmas[1:])
        open_ = (lowest < (1.0 - FINEST) * floor) & (seen >= floor) & (change * widths > FINEST * floor)
        if not open_.any():
            break
        places = (taus[:-1] + 0.5 * widths)[open_]
        at = field.samples(piece.a.s + piece.width * places, *stretch)
        more = field.velocities(at, piece.at(places))[1]
        order = np.argsort(np.concatenate((taus, places)), kind="stable")
        taus, sigmas = np.concatenate((taus, places))[order], np.concatenate((sigmas, more))[order]
    return taus, sigmas


def located(
    field: RateField, piece: Piece, crossing: Crossing, stretch: tuple[float, float]
) -> tuple[Piece | None, Crossing]:
    """Locate a violation in a piece more exactly; return the part of the piece before it (None if empty) too."""
    good, bad, end = piece.a.s, crossing.bad, None
    kind, joint = crossing.kind, crossing.joint
    room, lack = _margin(field, piece.a, crossing.floor), -np.inf
    closest = _CLOSEST * piece.width
    for _ in range(_ROUNDS):
        if bad - good <= closest:
            break
        middle = _between(good, bad, room, lack, closest)
        knot = knot_within(field, piece, middle, stretch)
        margin = -np.inf if knot is None else _margin(field, knot, crossing.floor)
        if knot is not None and margin >= 0.0:
            good, end, room, lack = middle, knot, margin, 0.5 * lack
            continue
        joint = None if knot is None else _outside(field, knot)
        kind = "lost" if knot is None else "threshold" if joint is None else "joint_limit"
        bad, lack, room = middle, margin, 0.5 * room
    found = Crossing(good, bad, kind, joint, crossing.floor)
    if end is None:
        return None, found
    at = field.samples(piece.a.s + (end.s - piece.a.s) * INNER, *stretch)
    return pieces_between(field, [piece.a, end], at)[0], found


def _between(good: float, bad: float, room: float, lack: float, closest: float) -> float:
    """Estimate where the margin is zero by the Illinois method, a little away from both ends."""
    if not np.isfinite(lack) or room <= 0.0:
        return 0.5 * (good + bad)
    guess = good + (bad - good) * room / (room - lack)
    return float(np.clip(guess, good + 0.4 * closest, bad - 0.4 * closest))


def _margin(field: RateField, knot: Knot, floor: float) -> float:
    """Return the smallest margin: of σ to its floor, or of a joint to its limits."""
    margin = knot.sigma - floor
    if field.limited:
        rooms = np.minimum(knot.q - field.chain.lower, field.chain.upper - knot.q)
        margin = min(margin, float(rooms.min()) + SLACK)
    return margin


def _outside(field: RateField, knot: Knot) -> int | None:
    """Return the joint that is furthest beyond its limits, if any."""
    excess = np.maximum(field.chain.lower - knot.q, knot.q - field.chain.upper)
    joint = int(excess.argmax())
    return joint if field.limited and excess[joint] > SLACK else None
