"""The clearance of a whole motion, and its second way: Coal at the nearest moment and at even samples."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.collision.cell import Cell, Nearest
from gelenk.collision.contact.judge import certify_free
from gelenk.collision.contact.words import ContactCertificate, together
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.contact.search import least_slack
from gelenk.trajectory.audit.pieces import Pieces, even_positions, pieces_of, values_at
from gelenk.trajectory.audit.result import ClosestPair, Moment, MotionClearance
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

RESOLUTION = 1e-4
"""By so much the clearance may be less between the places that were looked at, [m]."""
_SAMPLES = 16
"""Even samples that Coal looks at."""


class Nearness(NamedTuple):
    """How near a motion comes to anything: when it is nearest, and when it first comes too near; None if it never does.

    `certificate` is of these moments, and of samples in between if it never does.
    """

    nearest: Moment
    first_contact: Moment | None
    certificate: ContactCertificate


def nearness(cell: Cell, motion: PiecewisePolynomial) -> Nearness:
    """Find the nearest moment and the first contact of a motion that takes time.

    Raises CertificationFailed if Coal finds other distances.
    """
    pieces = pieces_of(motion)
    least = least_slack(cell.world.flat, pieces, RESOLUTION)
    is_free = least.free_until == math.inf
    places = [least.place] if is_free else [least.place, least.free_until]
    moments, certificate = _moments(cell, pieces, np.array(places))
    if is_free:
        free = certify_free(cell.world, even_positions(pieces, _SAMPLES), max(least.slack - RESOLUTION, 0.0))
        certificate = together((certificate, free))
    return Nearness(moments[0], None if is_free else moments[1], certificate)


def free_time(cell: Cell, motion: PiecewisePolynomial) -> float:
    """Return up to when a motion that takes time touches nothing, [s]; infinite if it never does."""
    place = least_slack(cell.world.flat, pieces_of(motion), RESOLUTION).free_until
    if place == math.inf:
        return place
    piece = min(int(place), len(motion.breaks) - 2)
    return float(motion.breaks[piece] + (place - piece) * (motion.breaks[piece + 1] - motion.breaks[piece]))


def clearance_of(cell: Cell, found: Nearness) -> MotionClearance:
    """Return the clearance of a motion as part of its audit."""
    value, bound = found.nearest.value, None
    if value is not None:
        bound = value - RESOLUTION if found.first_contact else max(value - RESOLUTION, cell.min_clearance)
    moment = {name: getattr(found.nearest, name) for name in Moment.__slots__}
    return MotionClearance(**moment, lower_bound=bound, resolution=RESOLUTION, certificate=found.certificate)


def _moments(cell: Cell, pieces: Pieces, places: Array) -> tuple[list[Moment], ContactCertificate]:
    piece = np.minimum(places.astype(np.int64), len(pieces.widths) - 1)
    qs = values_at(pieces, piece, places - piece, 0)
    found = cell.nearest(qs)
    certificate = cell.certified_nearest(qs, found)
    times = pieces.times(piece, places - piece)
    return [_moment(cell, float(times[i]), qs[i], found, i) for i in range(len(qs))], certificate


def _moment(cell: Cell, time: float, q: Array, found: Nearest, i: int) -> Moment:
    joints, number = tuple(q.tolist()), int(found.pairs[i])
    if number < 0:
        return Moment(None, time, joints, None)
    points = found.points[i].tolist()
    pair = ClosestPair(*cell.names(number), float(found.distances[i]), tuple(points[:3]), tuple(points[3:]))
    return Moment(float(found.clearances[i]), time, joints, pair)
