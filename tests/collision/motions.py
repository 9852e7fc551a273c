"""Random motions in random cells, and what denser samples say against the continuous check."""

from typing import NamedTuple, cast

import numpy as np

from gelenk.collision.contact.kernels import first_contacts, nearest_pairs
from gelenk.collision.contact.room import FlatWorld
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.audit.contact.search import Least, least_slack
from gelenk.trajectory.audit.pieces import pieces_of
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.motion import point_to_point_motion
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.problem.problem import SegmentLimits

RESOLUTION = 1e-4
_REACH = 3.0
"""Range of joints without limits, [rad or m]."""


class Checked(NamedTuple):
    """The result of a check; times of its places, [s]; what is wrong with it."""

    least: Least
    time: float
    free_until: float
    faults: tuple[str, ...]


def random_motion(rng: np.random.Generator, chain: Chain) -> PiecewisePolynomial:
    """Return a motion between two random configurations by a random law, or a spline through some."""
    lower, upper = np.fmax(chain.lower, -_REACH), np.fmin(chain.upper, _REACH)
    start, *rest = rng.uniform(lower, upper, (4, len(chain)))
    law = str(rng.choice([*LAWS, "spline"]))
    if law == "spline":
        times = np.append(0.0, np.cumsum(rng.uniform(0.2, 1.0, len(rest))))
        return cubic_spline(times, np.vstack((start, *rest)), "natural").motion
    ones = np.ones(len(chain))
    limits = SegmentLimits(2.0 * ones, 8.0 * ones, 80.0 * ones)
    return point_to_point_motion(start, start + rng.uniform(0.05, 1.0) * (rest[0] - start), cast(Law, law), limits)


def checked(world: FlatWorld, motion: PiecewisePolynomial, density: float = 100.0) -> Checked:
    """Check a motion, and compare with as many even samples for each place that was looked at."""
    pieces = pieces_of(motion)
    least = least_slack(world, pieces, RESOLUTION)

    def time_of(x: float) -> float:
        piece = min(int(x), len(pieces.widths) - 1) if np.isfinite(x) else 0
        return float(pieces.starts[piece] + (x - piece) * pieces.widths[piece])

    time, free_until = time_of(least.place), time_of(least.free_until)
    times = np.linspace(0.0, motion.duration, int(density * least.looks))
    qs, faults = motion.at(times), []
    touching = first_contacts(world, qs) >= 0
    if touching[times < free_until - 1e-9].any():
        faults.append(f"in contact at {times[touching.argmax()]} s, free until {free_until} s")
    if (
        np.isfinite(free_until)
        and free_until > 0.0
        and nearest_pairs(world, motion.at(np.array([free_until])))[0] > 2e-6
    ):
        faults.append(f"no contact after {free_until} s")
    slacks = _slacks(world, qs[:: max(1, len(qs) // 2000)])
    if slacks.min() < least.slack - RESOLUTION - 1e-9:
        faults.append(f"{slacks.min()} m apart, but the least was {least.slack} m")
    if abs(_slacks(world, motion.at(np.array([time])))[0] - least.slack) > 1e-7:
        faults.append(f"not {least.slack} m apart at {time} s")
    return Checked(least, time, free_until, tuple(faults))


def _slacks(world: FlatWorld, qs: Array) -> Array:
    return nearest_pairs(world, qs)[0]
