"""The fastest motion along a clamped spline through waypoints in one compiled call: Python between takes as long."""

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled
from gelenk.trajectory.joints.excess import swings_within
from gelenk.trajectory.joints.waypoints import WITHIN, are_distinct, spacing
from gelenk.trajectory.laws.time_scaling import LARGEST, SMALLEST
from gelenk.trajectory.motion.evaluation import are_apart, clamped
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import NEAREST, RESOLVED
from gelenk.trajectory.motion.time_laws import END_CONDITIONS
from gelenk.trajectory.problem.problem import Segment
from gelenk.trajectory.timing.nodes import LARGEST_PATH, even_counts, measures
from gelenk.trajectory.timing.time_optimal import INTERVALS, MARGIN, is_usual, unlimited


def fastest_way(chain: Chain, start: Array, segment: Segment) -> PiecewisePolynomial | None:
    """Return the motion that `JointSpline` plans from a start of shape (n,), [rad or m], through waypoints.

    None for all but the usual: another law or boundary, limits of torque, given times, and whatever is refused, leaves
    the joint limits, or comes so near to them that it has to be looked at closely.
    """
    waypoints, limits = segment.configurations, segment.limits
    is_fastest = segment.law == "time_optimal" and segment.boundary == "clamped" and limits.torque is None
    if waypoints is None or not is_fastest or segment.times is not None or segment.duration is not None:
        return None
    breaks, coefficients = _planned(start, waypoints, limits.joints, chain.lower, chain.upper, END_CONDITIONS[2])
    return PiecewisePolynomial(breaks, coefficients) if len(breaks) else None


@compiled
def _planned(
    start: Array, waypoints: Array, limits: Array, lower: Array, upper: Array, conditions: Array
) -> tuple[Array, Array]:
    """Return breaks and coefficients of the motion, none where a check fails."""
    nothing = np.empty(0), np.empty((0, 0, 0))  # global arrays are read-only, and so would be those of the motion
    positions = np.empty((len(waypoints) + 1, len(start)))
    positions[0], positions[1:] = start, waypoints
    is_fine = len(waypoints) > 0 and (np.abs(positions) <= LARGEST).all()
    is_fine = is_fine and (limits >= SMALLEST).all() and (limits <= LARGEST).all()
    is_fine = is_fine and (waypoints >= lower - WITHIN).all() and (waypoints <= upper + WITHIN).all()
    if not is_fine:
        return nothing
    times, lengths, steps = spacing(positions, limits[0])
    if not (are_distinct(lengths, steps).all() and are_apart(times, NEAREST, RESOLVED)):
        return nothing
    rest = np.zeros(len(start))
    pieces = clamped(times, positions, rest, rest, conditions)[-1]
    path = measures(times, pieces)
    if not (swings_within(np.diff(times), pieces, lower, upper) and is_usual(path)):
        return nothing
    most = limits[:2] * (1.0 - MARGIN)
    counts = even_counts(path.breaks, path.travels, most[0], INTERVALS // 2)
    if counts.sum() * len(start) > LARGEST_PATH:
        return nothing
    found, _, motion = unlimited(path, counts, most, INTERVALS)
    return (found, motion) if np.isfinite(found[-1]) else nothing
