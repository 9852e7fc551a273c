"""Joint path along a path of the tip: q(s) on one continuous branch of the inverse kinematics.

Between exact knots q is the quintic with their q, q' and q'', so it is continuous up to q'' except where the tip path's
derivatives jump. The tolerances determine the knot spacing; then `follow_exact` refines it. Where the branch cannot be
followed any further the path ends, and `follow_verdict` says why; `damp` leaves the path near singularities instead
(`follow_damped`).
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.follow.damped import damped
from gelenk.trajectory.follow.exact import refined
from gelenk.trajectory.follow.integrate import Trace, traced
from gelenk.trajectory.follow.rate_field import Course
from gelenk.trajectory.follow.step import SHARE, Piece
from gelenk.trajectory.follow.verdict import Inquiry, Stop, never_back, verdict
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.paths.paths import Path
from gelenk.trajectory.problem.problem import Following

_STILL = 1e-12
"""Width of the single piece for a path of zero length, [m or rad]."""
_LOOSE = (1e-3, 1e-2)
"""Largest distance of a start from the path's first pose, [m and rad]."""
_PUSHES = (8.0, 40.0)
"""Gains that push spare joints away from their limits: joint rate per rate of the tip."""


@dataclass(frozen=True, slots=True)
class FollowedPath:
    """The joint path along a path of the tip.

    Attributes:
        positions: q(s) from 0 to `reached`; its breaks include the path's. If nothing was followed, or the path has
            zero length, one constant piece from 0 to 1e-12.
        reached: s up to which the path was followed; the path's extent if completely, [m or rad].
        stop: Why it is incomplete; None if complete.
        path_deviation: Largest distance of the tip from the path, between the knots that the tolerances require, [m].
        orientation_deviation: Largest angle likewise, [rad].
        min_singular_value: The smallest σ of the rows that count along the path, metres and radians mixed.
        min_singular_value_s: s at that value, [m or rad].
        bend_errors: Bound on the error of q'' against the exact path, for each piece and joint; shape (M, n). None
            if nothing moves, or the path is left.
    """

    positions: PiecewisePolynomial
    reached: float
    stop: Stop | None
    path_deviation: float
    orientation_deviation: float
    min_singular_value: float
    min_singular_value_s: float
    bend_errors: Array | None = None


def follow(robot: RobotModel, chain: Chain, path: Path, start: Array, following: Following) -> FollowedPath:
    """Find the joint path that leads the tip along a path, starting at a configuration.

    Args:
        robot: The robot.
        chain: Chain from base to tip.
        path: The path of the tip.
        start: A configuration at the path's first pose; shape (n,), [rad or m].
        following: Directions that count, tolerances, and what to do near singularities.

    Raises:
        InvalidField: The tolerances require too many knots.
        ValueError: The start is not at the path's first pose.
    """
    _check_start(chain, path, start, following)
    if path.extent <= 0.0 or len(chain) == 0:
        return _motionless(chain, path, start, following)
    tolerances = following.position_tolerance, following.orientation_tolerance
    residuals = SHARE * tolerances[0], SHARE * tolerances[1]
    course = Course(chain, path, following.task, residuals)
    threshold = 0.0 if following.near_singularity == "slow_down" else following.min_singular_value
    trace = traced(course, tolerances, start, threshold)
    if following.near_singularity == "damp":
        return _damped_way(robot, course, tolerances, start, threshold, trace)
    if trace.ending == "joint_limit" and course.is_redundant:
        course, trace = _away_from_limits(course, tolerances, start, threshold, trace)
    stop = verdict(Inquiry(robot, course, tolerances, threshold, start), trace)
    return _exactly(course, _joint_way(start, trace, stop))


def _damped_way(
    robot: RobotModel, course: Course, tolerances: tuple[float, float], start: Array, threshold: float, trace: Trace
) -> FollowedPath:
    """Follow the exact path up to a singularity, and the damped one from there."""
    inquiry = Inquiry(robot, course, tolerances, threshold, start)
    began_near = bool(trace.pieces) and trace.pieces[0].a.sigma < threshold
    if trace.ending != "threshold" and not began_near:
        return _exactly(course, _joint_way(start, trace, verdict(inquiry, trace)))
    exact = [] if began_near else trace.pieces
    since, q = (exact[-1].b.s, exact[-1].b.q) if exact else (0.0, start)
    rest = damped(course, tolerances, q, threshold, since)
    rest.pieces = exact + rest.pieces
    stop = verdict(inquiry, rest) if rest.ending != "lost" else never_back(inquiry, rest)
    return _joint_way(start, rest, stop)


def _exactly(course: Course, way: FollowedPath) -> FollowedPath:
    """Add the knots that accurate peaks require."""
    if way.reached <= 0.0:
        return way
    positions, bend_errors = refined(course, way.positions)
    return replace(way, positions=positions, bend_errors=bend_errors)


def _check_start(chain: Chain, path: Path, start: Array, following: Following) -> None:
    errors = following.task.errors(path.at(np.zeros(1)).poses, Poses(*chain_poses(chain.flat, start[None])))[:, 0]
    if not (errors <= _LOOSE).all():
        raise ValueError(f"the start is {errors[0]:.3g} m and {errors[1]:.3g} rad from the path's first pose")


def _away_from_limits(
    course: Course, tolerances: tuple[float, float], start: Array, threshold: float, plain: Trace
) -> tuple[Course, Trace]:
    """Return the course and trace that get farthest, with and without pushing joints away from their limits."""
    best = course, plain
    for push in _PUSHES:
        pushed = replace(course, push=push)
        try:
            trace = traced(pushed, tolerances, start, threshold)
        except InvalidField:
            continue
        if trace.reached > best[1].reached:
            best = pushed, trace
        if trace.ending == "complete":
            break
    return best


def _motionless(chain: Chain, path: Path, start: Array, following: Following) -> FollowedPath:
    """Return the result for a path of zero length, or a chain without joints."""
    stop = None
    at = path.at(np.zeros(1))
    if path.extent > 0.0:
        stop = Stop("out_of_reach", 0.0, at.poses.positions[0], None, "the chain has no joints: its tip cannot move")
    sigma = 0.0
    if len(chain):
        course = Course(chain, path, following.task, (0.0, 0.0))
        sigma = float(course.velocities(at, start[None])[1][0])
    return FollowedPath(_constant(start), 0.0, stop, 0.0, 0.0, sigma, 0.0)


def _constant(q: Array) -> PiecewisePolynomial:
    return PiecewisePolynomial(np.array([0.0, _STILL]), q[None, None])


def _joint_way(start: Array, trace: Trace, stop: Stop | None) -> FollowedPath:
    if not trace.pieces:
        return FollowedPath(_constant(start), 0.0, stop, 0.0, 0.0, trace.best, 0.0)
    deviations = np.array([piece.deviations for piece in trace.pieces]).max(axis=0)
    sigmas = np.array([piece.sigmas for piece in trace.pieces])
    i, k = np.unravel_index(int(sigmas.argmin()), sigmas.shape)
    place = trace.pieces[i].a.s + trace.pieces[i].width * k / (sigmas.shape[1] - 1)
    return FollowedPath(
        _polynomial(trace.pieces),
        trace.reached,
        stop,
        float(deviations[0]),
        float(deviations[1]),
        float(sigmas[i, k]),
        float(place),
    )


def _polynomial(pieces: list[Piece]) -> PiecewisePolynomial:
    """Return the quintics between the knots."""
    breaks = np.array([pieces[0].a.s, *(piece.b.s for piece in pieces)])
    starts = np.array([[piece.a.q, piece.a.dq, piece.a.ddq] for piece in pieces]).transpose(1, 0, 2)
    ends = np.array([[piece.b.q, piece.b.dq, piece.b.ddq] for piece in pieces]).transpose(1, 0, 2)
    return PiecewisePolynomial(breaks, hermite_pieces(starts, ends, np.diff(breaks)))
