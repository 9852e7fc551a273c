"""Planning of a whole trajectory: plan and time its segments one after the other, then audit the result.

A trajectory that can only be completed in part is planned as far as possible, from rest to rest, and reports where and
why it ends. A motion that fails its audit is never returned.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import accumulate
from typing import cast

import numpy as np

from gelenk.errors import AuditFailed, InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import check_limits
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.audit import audit, whole_audit
from gelenk.trajectory.audit.contact.clearance import clearance_of, nearness
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.audit.result import Audit, Peak, Reason, TipPeaks
from gelenk.trajectory.contact_end import ContactEnd, contact_ends
from gelenk.trajectory.joint_part import joint_part
from gelenk.trajectory.joints.moving_ends import given_rates
from gelenk.trajectory.motion.extremes import largest_ratio
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, joined
from gelenk.trajectory.paths.segment_paths import is_blended
from gelenk.trajectory.problem.parts import PlannedPart, lasting, standing
from gelenk.trajectory.problem.problem import BLENDABLE, Segment, Trajectory, TrajectoryProblem
from gelenk.trajectory.timing.torque_constraints import torque_factor
from gelenk.trajectory.tip_part import tip_part
from gelenk.trajectory.tool.placing import placed_tool, stopped

_SAME_DURATION = 1e-9
"""Relative tolerance for a requested duration that falls short of the shortest one, and then means it."""

_LIMITS = {"velocity", "acceleration", "jerk", "tip"}
_ROUNDING, _MARGIN = 1e-5, 1e-12
"""Relative excess over a limit that counts as rounding, and the least extra margin of a motion slowed down to it."""
_MOST_TRIES = 3
"""Times that a part is slowed down for torques that the audit finds beyond their limits."""
_WORTH_A_NOTE = 1.001
"""Least factor on the time of a part that its notes mention."""
_MOST_REASONS = 4
"""Largest number of reasons that a refusal lists."""
_CUBIC = 3
"""Degree from which on a polynomial has a jerk, and the order of the jerk."""


def plan(robot: RobotModel, chain: Chain, problem: TrajectoryProblem) -> Trajectory:
    """Plan a trajectory.

    Raises:
        InvalidField: A segment is inconsistent, or demands less time than its limits allow.
        OutsideLimits: The start is outside a joint's limits.
        AuditFailed: The motion fails its audit.
    """
    check_limits(chain, problem.start[None])
    if problem.tool is None:
        return _clear(robot, chain, problem, lambda end: _parts(robot, chain, problem, end))
    placed, sequence = placed_tool(chain, problem, problem.tool)
    found = _clear(robot, chain, placed, lambda end: stopped(_parts(robot, chain, placed, end), placed, sequence))
    return replace(found, choice=sequence.choice)


def _clear(
    robot: RobotModel, chain: Chain, problem: TrajectoryProblem, parts: Callable[[ContactEnd | None], list[PlannedPart]]
) -> Trajectory:
    """Return the trajectory, which ends at rest before the first contact in the problem's cell."""
    found, cell = _whole(robot, chain, problem, parts(None)), problem.cell
    if cell is None:
        return found
    near = nearness(cell, lasting(found.motion))
    for end in () if near.first_contact is None else contact_ends(chain, cell, found, near.first_contact, near.nearest):
        found = _whole(robot, chain, problem, parts(end))
        near = nearness(cell, lasting(found.motion))
        if near.first_contact is None:
            break
    judgement = replace(found.audit, clearance=clearance_of(cell, near))
    if near.first_contact is not None and found.failure is not None:  # at the start, before which nothing can end
        reason = Reason("clearance", found.failure.detail, None, near.first_contact.time)
        judgement = replace(judgement, passed=False, reasons=(reason,))
    return replace(found, audit=judgement)


def _whole(robot: RobotModel, chain: Chain, problem: TrajectoryProblem, planned: list[PlannedPart]) -> Trajectory:
    """Time, join and audit the parts of a trajectory."""
    parts = [_with_torques(_with_stated_jerk(part, problem), problem) for part in planned]
    factor, share, failure = _factor(parts, problem), parts[-1].share, parts[-1].failure
    parts, audits = _judged(robot, chain, [part.slowed(factor) for part in parts], problem)
    starts = list(accumulate((part.motion.duration for part in parts), initial=0.0))
    moving = [i for i, part in enumerate(parts) if part.motion.duration > 0.0]
    if moving:
        motion = parts[moving[0]].motion if len(moving) == 1 else joined([parts[i].motion for i in moving])
        judgement = whole_audit(chain, motion, audits, [starts[i] for i in moving])
    else:  # An audit needs pieces that take time.
        motion = standing(problem.start)
        judgement = audit(robot, chain, lasting(motion), Demands())
    refuse_failed(judgement)
    return Trajectory(
        motion,
        tuple(
            report.retimed(start=start) for part, start in zip(parts, starts, strict=False) for report in part.reports
        ),
        1.0 if failure is None else (failure.segment + share) / len(problem.segments),
        None if failure is None else replace(failure, time=motion.duration),
        judgement,
        tuple(part.timing for part in parts if part.timing is not None),
        tuple((part.reports[0].index, part.law) for part in parts if part.law is not None),
    )


def _parts(
    robot: RobotModel, chain: Chain, problem: TrajectoryProblem, end: ContactEnd | None = None
) -> list[PlannedPart]:
    """Plan the parts one after the other, as far as it goes, or to a given end."""
    parts: list[PlannedPart] = []
    for first, segments in _grouped(problem.segments):
        configuration = parts[-1].motion.at(parts[-1].motion.breaks[-1:])[0] if parts else problem.start
        if segments[0].turn is not None and segments[0].turn.is_blocked:
            break
        if end is not None and first + len(segments) > end.failure.segment:
            parts.append(_ending(robot, chain, configuration, segments, first, problem, end))
            break
        if segments[0].type == "joint" or segments[0].configurations is not None:
            part = joint_part(robot, chain, configuration, segments[0], first, problem)
        else:
            part = tip_part(robot, chain, configuration, segments, first, problem)
        parts.append(part)
        if part.failure is not None:
            break
    return parts


def _ending(
    robot: RobotModel,
    chain: Chain,
    start: Array,
    segments: tuple[Segment, ...],
    first: int,
    problem: TrajectoryProblem,
    end: ContactEnd,
) -> PlannedPart:
    """Plan the part in which a trajectory ends before a contact: a path of the tip up to there, no other motion."""
    if end.stop is None:
        return PlannedPart(standing(start), (), Demands(), replace(end.failure, segment=first), 0.0)
    part = tip_part(robot, chain, start, segments, first, problem, end.stop)
    segment = end.failure.segment if part.failure is None else part.failure.segment
    return replace(part, failure=replace(end.failure, segment=segment))


def _grouped(segments: tuple[Segment, ...]) -> Iterator[tuple[int, tuple[Segment, ...]]]:
    """Yield single segments and groups of blended ones, each with the index of its first segment."""
    first = 0
    for i, segment in enumerate(segments):
        if is_blended(segment):
            _refuse_unblendable(segments, i)
            continue
        yield first, segments[first : i + 1]
        first = i + 1


def _refuse_unblendable(segments: tuple[Segment, ...], i: int) -> None:
    """Refuse to blend segment `i` unless it and the next are lines or circles with one law and no own durations."""
    field = f"segments.{i}.blend_radius"
    if i + 1 == len(segments) or not {segments[i].type, segments[i + 1].type} <= set(BLENDABLE):
        raise InvalidField(field, "only a line or a circle can be blended, and only into one that follows it")
    if segments[i].law != segments[i + 1].law:
        reason = f"segments that are blended share one law: segment {i + 1} has `{segments[i + 1].law}`"
        raise InvalidField(f"segments.{i}.law", reason)
    for k in (i, i + 1):
        if segments[k].duration is not None:
            reason = "segments that are blended are timed together: give the `duration` of the trajectory"
            raise InvalidField(f"segments.{k}.duration", reason)


def _factor(parts: list[PlannedPart], problem: TrajectoryProblem) -> float:
    """Return the factor that makes the whole motion last as long as requested, if limits and segments allow it."""
    if problem.duration is None:
        return 1.0
    for i, segment in enumerate(problem.segments):
        if segment.duration is not None or segment.times is not None:
            field = "duration" if segment.duration is not None else "times"
            raise InvalidField(f"segments.{i}.{field}", "the trajectory has a `duration` already: give one of them")
    least = sum(part.motion.duration for part in parts)
    if parts[-1].failure is not None or least == 0.0:
        return 1.0
    if any(segment.ends is not None for segment in problem.segments):
        if len(problem.segments) == 1:
            return 1.0
        reason = "would change the velocities at the ends: give the segments durations of their own"
        raise InvalidField("duration", reason)
    if problem.duration < least * (1.0 - _SAME_DURATION):
        raise InvalidField("duration", f"the limits allow no less than {least:.6g} s")
    return max(1.0, problem.duration / least)


def _with_stated_jerk(part: PlannedPart, problem: TrajectoryProblem) -> PlannedPart:
    """Slow a part down to requested jerk limits that its law does not keep; `InvalidField` if its times are given."""
    demands, has_jerk = part.demands, part.motion.coefficients.shape[1] > _CUBIC
    is_stated = demands.stated_jerk is not None or demands.zones
    if demands.keeps_jerk or not is_stated or part.motion.duration == 0.0 or not has_jerk:
        return part
    stretches = [(motion, zone.stated_jerk) for motion, zone in part.stretches()]
    jerks = [largest_ratio(motion, _CUBIC, stated)[0] for motion, stated in stretches if stated is not None]
    factor = float(np.cbrt(max(jerks, default=0.0)))
    if factor <= 1.0:
        return part
    for report in part.reports:
        segment = problem.segments[report.index]
        for name in ("duration", "times"):
            if getattr(segment, name) is not None:
                reason = f"the requested limit of jerk is kept in {factor:.6g} times the time"
                raise InvalidField(f"segments.{report.index}.{name}", reason)
    law = part.reports[0].law
    note = f"`{law}` keeps no limit of jerk by itself: it takes {factor:.4g} times its time for those that are given"
    return part.slowed(factor * (1.0 + _margin(part.motion))).noted((note,))


def _margin(motion: PiecewisePolynomial) -> float:
    """Return by how much more to slow a motion down: what the times of its shortest piece lose by rounding."""
    shortest = float(np.diff(motion.breaks).min())
    return float(np.clip(4.0 * np.finfo(float).eps * motion.duration / shortest, _MARGIN, _ROUNDING))


def _with_torques(part: PlannedPart, problem: TrajectoryProblem, tighter: float = 1.0) -> PlannedPart:
    """Slow a part down until its torques keep their limits; `InvalidField` if its times or its ends' rates are given.

    It is refused too where the weight alone asks for more than a limit. The limits are first divided by `tighter`.
    """
    if (part.demands.torque is None and not part.demands.zones) or part.motion.duration == 0.0:
        return part
    stretches = [(motion, zone.torque) for motion, zone in part.stretches()]
    factors = (torque_factor(motion, torque.tightened(tighter)) for motion, torque in stretches if torque is not None)
    factor = max(factors, default=1.0)
    if factor == 1.0:
        return part
    for report in part.reports:
        segment = problem.segments[report.index]
        if segment.ends is not None:
            reason = "with it the joints would need more torque than their limits allow"
            raise InvalidField(given_rates(segment.ends), reason)
        for name in ("duration", "times"):
            if getattr(segment, name) is not None:
                reason = f"the limits of torque are kept in {factor:.6g} times the time"
                raise InvalidField(f"segments.{report.index}.{name}", reason)
    slowed = part.slowed(factor * (1.0 + _ROUNDING))
    if part.reports[0].law == "time_optimal" or factor < _WORTH_A_NOTE:
        return slowed
    return slowed.noted((f"the limits of torque make it take {factor:.4g} times the time",))


def _judged(
    robot: RobotModel, chain: Chain, parts: list[PlannedPart], problem: TrajectoryProblem
) -> tuple[list[PlannedPart], list[Audit]]:
    """Audit each part that moves; slow down a part that exceeds a limit by rounding alone."""
    judged, audits = [], []
    for planned in parts:
        part = planned
        if part.motion.duration > 0.0:
            part, found = _within_torques(robot, chain, part, problem)
            excess = _excess(found)
            if 1.0 < excess <= 1.0 + _ROUNDING:
                part = part.slowed(excess * (1.0 + _margin(part.motion)))
                found = audit(robot, chain, part.motion, part.demands)
            audits.append(found)
            part = part.noted(_of_jerk(part, found))
        judged.append(part)
    return judged, audits


def _within_torques(
    robot: RobotModel, chain: Chain, part: PlannedPart, problem: TrajectoryProblem
) -> tuple[PlannedPart, Audit]:
    """Audit a part, and slow it down by what its torques exceed their limits between the planner's places."""
    found = audit(robot, chain, part.motion, part.demands)
    for _ in range(_MOST_TRIES):
        if not any(reason.check == "torque" for reason in found.reasons):
            break
        ratio = cast(float, cast(Peak, found.joint_torque).ratio)
        part = _with_torques(part, problem, ratio * (1.0 + _ROUNDING))
        found = audit(robot, chain, part.motion, part.demands)
    return part, found


def _of_jerk(part: PlannedPart, found: Audit) -> tuple[str, ...]:
    jerk = found.jerk
    if part.demands.keeps_jerk or jerk is None or jerk.ratio is None or jerk.ratio <= 1.0 + _ROUNDING:
        return ()
    return (f"jerk limits are exceeded: {jerk.joint} reaches {jerk.ratio:.6g} times its limit",)


def _excess(found: Audit) -> float:
    """Return the largest ratio to a limit if exceeded limits are the only reasons for failure, else 1."""
    if found.passed or any(reason.check not in _LIMITS for reason in found.reasons):
        return 1.0
    checks = {reason.check for reason in found.reasons}
    peaks = {"velocity": found.velocity, "acceleration": found.acceleration, "jerk": found.jerk}
    beyond = [peak for check, peak in peaks.items() if check in checks] + [
        getattr(found.tip, name) for name in TipPeaks.__slots__
    ]
    return max(peak.ratio or 0.0 for peak in beyond if peak is not None)


def refuse_failed(judgement: Audit) -> None:
    """Refuse a motion that failed its audit, with `AuditFailed`."""
    if not judgement.passed:
        raise AuditFailed("; ".join(reason.detail for reason in judgement.reasons[:_MOST_REASONS]))
