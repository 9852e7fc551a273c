"""Joint path along a path of the tip: q(s) on one continuous branch of the inverse kinematics.

Between exact knots q is the quintic with their q, q' and q'', so it is continuous up to q'' except where the tip path's
derivatives jump. The tolerances determine the knot spacing; then `exact` refines it. Spare joints move as little
as they can; if that leads to no end, they look `ahead`. Where the branch cannot be followed any further the path ends,
and `verdict` says why; `damped` leaves the path near singularities instead.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.follow.ahead import guides
from gelenk.trajectory.follow.damped import damped
from gelenk.trajectory.follow.exact import refined
from gelenk.trajectory.follow.guided import guided
from gelenk.trajectory.follow.integrate import Trace, traced
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.follow.swept import swept
from gelenk.trajectory.follow.verdict import Stop, end_is_reached, never_back, verdict
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.problem.problem import Following

_STILL = 1e-12
"""Width of the single piece for a path of zero length, [m or rad]."""
_LOOSE = (1e-3, 1e-2)
"""Largest distance of a start from the path's first pose, [m and rad]."""


@dataclass(frozen=True, slots=True)
class FollowedPath:
    """The joint path along a path of the tip.

    Attributes:
        positions: q(s) from 0 to `reached`; its breaks include the path's. If nothing was followed, or the path has
            zero length, one constant piece from 0 to 1e-12.
        reached: s up to which the path was followed; the path's extent if completely, [m or rad].
        path_deviation: Largest distance of the tip from the path, between the knots that the tolerances require, [m].
        orientation_deviation: Largest angle likewise, [rad].
        bend_errors: Bound on the error of q'' against the exact path, for each piece and joint; shape (M, n). None
            if nothing moves, or the path is left.
    """

    positions: PiecewisePolynomial
    reached: float
    stop: Stop | None
    path_deviation: float = 0.0
    orientation_deviation: float = 0.0
    bend_errors: Array | None = None

    def until(self, stop: Stop) -> "FollowedPath":
        """Return the path up to an earlier stop."""
        q = self.positions
        count = int(np.searchsorted(q.breaks[:-1], stop.s))
        if count == 0:
            return _motionless(q.coefficients[0, 0], stop)
        positions = PiecewisePolynomial(np.append(q.breaks[:count], stop.s), q.coefficients[:count])
        errors = None if self.bend_errors is None else self.bend_errors[:count]
        return replace(self, positions=positions, reached=stop.s, stop=stop, bend_errors=errors)


def follow(
    robot: RobotModel,
    chain: Chain,
    path: Path,
    start: Array,
    following: Following,
    guide: PiecewisePolynomial | None = None,
) -> FollowedPath:
    """Find the joint path that leads the tip along a path, from a configuration, (n,), at the path's first pose.

    Spare joints stay near a guide, if there is one and they can.

    Raises:
        InvalidField: The tolerances require too many knots.
        ValueError: The start is not at the path's first pose.
    """
    first = path.at(np.zeros(1)).poses
    errors = following.task.errors(first, Poses(*chain_poses(chain.flat, start[None])))[:, 0]
    if not (errors <= _LOOSE).all():
        raise ValueError(f"the start is {errors[0]:.3g} m and {errors[1]:.3g} rad from the path's first pose")
    if path.extent <= 0.0:
        return _motionless(start, None)
    if len(chain) == 0:
        detail = "the chain has no joints: its tip cannot move"
        return _motionless(start, Stop("out_of_reach", 0.0, first.positions[0], None, detail))
    tolerances = following.position_tolerance, following.orientation_tolerance
    threshold = 0.0 if following.near_singularity == "slow_down" else following.min_singular_value
    field = RateField(chain, path, following.task, tolerances, threshold)
    trace = None if guide is None else guided(field, start, guide)
    if trace is None or trace.ending != "complete":
        whole = swept(field, start)
        if whole is not None:
            return _exactly(field, FollowedPath(whole[0], path.extent, None, *whole[1].tolist()))
        trace = traced(field, start)
    if trace.ending != "complete" and field.is_redundant and end_is_reached(robot, field, trace):
        trace = _ahead(field, trace)
    if following.near_singularity == "damp":
        return _damped_path(robot, field, trace)
    return _exactly(field, _joint_path(trace, verdict(robot, field, trace)))


def _damped_path(robot: RobotModel, field: RateField, trace: Trace) -> FollowedPath:
    """Follow the exact path up to a singularity, and the damped one from there."""
    began_near = bool(trace.pieces) and trace.pieces[0].a.sigma < field.threshold
    if trace.ending != "threshold" and not began_near:
        return _exactly(field, _joint_path(trace, verdict(robot, field, trace)))
    exact = [] if began_near else trace.pieces
    since, q = (exact[-1].b.s, exact[-1].b.q) if exact else (0.0, trace.start)
    rest = damped(field, q, since)
    rest.start, rest.pieces = trace.start, exact + rest.pieces
    return _joint_path(rest, (never_back if rest.ending == "lost" else verdict)(robot, field, rest))


def _exactly(field: RateField, path: FollowedPath) -> FollowedPath:
    if path.reached <= 0.0:
        return path
    positions, bend_errors = refined(field, path.positions)
    return replace(path, positions=positions, bend_errors=bend_errors)


def _ahead(field: RateField, plain: Trace) -> Trace:
    """Return a trace to the end by another use of the spare joints than the shortest one, else the plain trace."""
    for guide in guides(field, plain.start):
        trace = guided(field, plain.start, guide)
        if trace.ending == "complete":
            return trace
    return plain


def _motionless(start: Array, stop: Stop | None) -> FollowedPath:
    return FollowedPath(PiecewisePolynomial(np.array([0.0, _STILL]), start[None, None]), 0.0, stop)


def _joint_path(trace: Trace, stop: Stop | None) -> FollowedPath:
    pieces = trace.pieces
    if not pieces:
        return _motionless(trace.start, stop)
    breaks = np.array([pieces[0].a.s, *(piece.b.s for piece in pieces)])
    starts = np.array([[piece.a.q, piece.a.dq, piece.a.ddq] for piece in pieces]).transpose(1, 0, 2)
    ends = np.array([[piece.b.q, piece.b.dq, piece.b.ddq] for piece in pieces]).transpose(1, 0, 2)
    positions = PiecewisePolynomial(breaks, hermite_pieces(starts, ends, np.diff(breaks)))
    deviations = np.array([piece.deviations for piece in pieces]).max(axis=0)
    return FollowedPath(positions, trace.reached, stop, *deviations.tolist())
