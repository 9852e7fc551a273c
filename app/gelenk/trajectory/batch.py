"""Batches of joint motions from rest to rest: planned and audited by one kernel, without an object for each motion.

A motion that the kernel's audit does not pass is planned again by itself, which slows it down or says why it fails.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.collision.contact.room import FlatWorld
from gelenk.collision.contact.words import ContactCertificate
from gelenk.errors import AuditFailed, InvalidInput, OutsideLimits
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.compilation import compiled
from gelenk.robot.configuration import check_limits
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.contact.clearance import RESOLUTION
from gelenk.trajectory.audit.contact.search import least_slack
from gelenk.trajectory.audit.contact.travel import put_position
from gelenk.trajectory.audit.motions import SIGMA_SAMPLES, TIP_SAMPLES, BatchLimits, figures, slowdown
from gelenk.trajectory.audit.pieces import Pieces, rate_bounds, travels
from gelenk.trajectory.audit.result import Audit
from gelenk.trajectory.audit.tip import RATES, least_singular_value, rate_peaks
from gelenk.trajectory.joints.fastest import LawShape, fastest_motion, shape_of
from gelenk.trajectory.laws import time_scaling
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, TrajectoryProblem

_ROWS = np.arange(6)
_MOMENT = 1e-9
"""Duration that stands for zero in an audit, [s]."""
_MARGIN = 1e-9
"""Extra slowdown, because the peaks of the tip that were found may be slightly too low."""


@dataclass(frozen=True, slots=True)
class BatchMotions:
    """Planned and audited motions.

    Attributes:
        rows: Of each motion: 1 if it passed its audit, else 0; its duration, [s]; the largest ratio of a joint to its
            limit of velocity, acceleration and jerk; the least distance of a joint from its limits, [rad or m], NaN
            without limits; the peaks of the tip's `RATES`, [m/s, rad/s, m/s², rad/s²]; the least singular value of
            the Jacobian. NaN from the duration on where there is no motion. Shape (N, 11).
        reasons: Why there is none, by row.
        certificate: Of poses midway between starts and targets.
        clearances: In a cell the least of each motion, also of one that would touch something, [m]; NaN where there is
            no other motion; infinite if nothing can touch anything; shape (N,).
        contact_certificate: Of these.
    """

    rows: Array
    reasons: dict[int, str]
    certificate: PoseCertificate
    clearances: Array | None = None
    contact_certificate: ContactCertificate | None = None


def plan_batch(
    robot: RobotModel, chain: Chain, starts: Array, targets: Array, move: Segment, cell: Cell | None = None
) -> BatchMotions:
    """Plan and audit the fastest motion from each start to its target, from rest to rest.

    Args:
        starts: Shape (N, n), or (1, n) for one start of all, [rad or m].
        targets: Shape (N, n).
        move: Law and limits of all; its target does not count.
        cell: What no motion may touch.

    Raises:
        InvalidField: A limit is out of the supported range.
        CertificationFailed: Pinocchio's poses differ, or Coal's distances.
    """
    time_scaling.check_limits(move.limits.joints)
    starts, targets = np.ascontiguousarray(starts), np.ascontiguousarray(targets)
    rows = np.full((len(targets), 7 + len(RATES)), np.nan)
    rows[:, 0] = 0.0
    possible = _within(chain, starts) & _within(chain, targets)
    law, limits = shape_of(move.law), _limits(chain, move)
    _fill(chain.flat, starts, targets, possible, law, limits, rows)
    rows[np.isinf(rows)] = np.nan
    reasons = dict(_again(robot, chain, starts, targets, move, rows))
    middles = 0.5 * (starts + targets)
    certificate = certify_poses(robot, chain, middles, {chain.tip_frame: Poses(*chain_poses(chain.flat, middles))})
    found = BatchMotions(rows, reasons, certificate)
    return found if cell is None else _in_cell(cell, found, starts, targets, move)


def _in_cell(cell: Cell, found: BatchMotions, starts: Array, targets: Array, move: Segment) -> BatchMotions:
    """Add clearances, and take motions out that would touch something."""
    rows, reasons = found.rows, dict(found.reasons)
    moving = np.flatnonzero(rows[:, 0] == 1.0)
    some = starts if len(starts) == 1 else starts[moving]
    qs, free = _nearest(cell.world.flat, some, targets[moving], shape_of(move.law), move.limits.joints)
    nearest = cell.nearest(qs)
    certificate = cell.certified_nearest(qs, nearest)
    for i in np.flatnonzero(~free).tolist():
        row = int(moving[i])
        reasons[row] = cell.contact(int(nearest.pairs[i]), float(nearest.distances[i]))
        rows[row, 0], rows[row, 1:] = 0.0, np.nan
    clearances = np.full(len(rows), np.nan)
    clearances[moving] = nearest.clearances
    return replace(found, reasons=dict(sorted(reasons.items())), clearances=clearances, contact_certificate=certificate)


@compiled
def _nearest(world: FlatWorld, starts: Array, targets: Array, law: LawShape, limits: Array) -> tuple[Array, Flags]:
    """Return the nearest configuration of each motion, (N, n), and whether it touches nothing; time does not count."""
    qs, free = np.empty_like(targets), np.empty(len(targets), dtype=np.bool_)
    for i in range(len(targets)):
        pieces = _pieces(*fastest_motion(starts[min(i, len(starts) - 1)], targets[i], limits, law))
        least = least_slack(world, pieces, RESOLUTION)
        put_position(pieces, least.place, qs[i])
        free[i] = least.free_until == np.inf
    return qs, free


def _within(chain: Chain, qs: Array) -> Flags:
    within: Flags = np.all((qs >= chain.lower) & (qs <= chain.upper), axis=1)
    return within


def _limits(chain: Chain, move: Segment) -> BatchLimits:
    law, tip = LAWS[move.law], move.limits.tip
    enforced = np.array([True, True, law.keeps_jerk or move.stated_jerk is not None])
    bounds = np.array([getattr(tip, name) for name in RATES])
    return BatchLimits(move.limits.joints, enforced, chain.lower, chain.upper, bounds, law.continuous)


@compiled
def _fill(
    flat: FlatChain,
    starts: Array,
    targets: Array,
    possible: Flags,
    law: LawShape,
    limits: BatchLimits,
    rows: Array,
) -> None:
    """Plan and audit each possible motion, and write its row."""
    for i in range(len(targets)):
        if possible[i]:
            start, target = starts[min(i, len(starts) - 1)], targets[i]
            pieces = _pieces(*fastest_motion(start, target, limits.joints, law))
            tip, _ = rate_peaks(flat, pieces, TIP_SAMPLES, *rate_bounds(pieces))
            factor = slowdown(tip, limits.tip)
            if factor > 1.0:
                factor *= 1.0 + _MARGIN
                pieces = Pieces(factor * pieces.starts, factor * pieces.widths, pieces.scaled)
                tip, _ = rate_peaks(flat, pieces, TIP_SAMPLES, *rate_bounds(pieces))
            found = figures(pieces, start, target, tip, limits)
            sigma, _ = least_singular_value(flat, pieces, _ROWS, False, travels(pieces), SIGMA_SAMPLES)
            row = rows[i]
            row[0], row[5], row[10] = found.passed, found.margin, sigma
            row[1] = pieces.starts[-1] + pieces.widths[-1] if (start != target).any() else 0.0
            row[2:5], row[6:10] = found.ratios, tip


@compiled
def _pieces(breaks: Array, coefficients: Array) -> Pieces:
    """Return the pieces of a motion; one that takes no time gets a moment, because an audit needs pieces that do."""
    widths = np.diff(breaks)
    if breaks[-1] == 0.0:
        widths[0] = _MOMENT
    for i in range(len(widths)):
        for k in range(1, coefficients.shape[1]):
            coefficients[i, k] *= widths[i] ** k
    return Pieces(breaks[:-1], widths, coefficients)


def _again(
    robot: RobotModel, chain: Chain, starts: Array, targets: Array, move: Segment, rows: Array
) -> Iterator[tuple[int, str]]:
    """Plan motions that did not pass by themselves; fill their rows, or yield why there is none."""
    for i in np.flatnonzero(rows[:, 0] == 0.0).tolist():
        start, target = starts[min(i, len(starts) - 1)], targets[i]
        try:
            _check(chain, start, target)
            found = plan(robot, chain, TrajectoryProblem(start, (replace(move, configuration=target),)))
        except (AuditFailed, InvalidInput) as error:
            rows[i, 1:] = np.nan
            yield i, str(error)
        else:
            rows[i] = _row(found.motion.duration, found.audit)


def _check(chain: Chain, start: Array, target: Array) -> None:
    for name, configuration in (("start", start), ("target", target)):
        try:
            check_limits(chain, configuration[None])
        except OutsideLimits as error:
            raise replace(error, index=None, field=name) from None


def _row(duration: float, audit: Audit) -> list[float]:
    joints = (audit.velocity, audit.acceleration, audit.jerk)
    least = (audit.limit_margin, audit.min_singular_value)
    ratios = [math.nan if peak is None or peak.ratio is None else peak.ratio for peak in joints]
    margin, sigma = (math.nan if one is None else one.value for one in least)
    return [1.0, duration, *ratios, margin, *(getattr(audit.tip, name).value for name in RATES), sigma]
