"""Parts of a trajectory's answer: samples, segments, audit, limits."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np
import orjson

from gelenk.contract.pose import PoseFormat
from gelenk.operations.pose_arrays import pose_list
from gelenk.operations.rows import json_list, json_rows
from gelenk.operations.trajectory_limits import SourcedLimits
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.audit import DERIVATIVES, Audit, Margin, Peak
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem.problem import SegmentLimits, SegmentReport, Trajectory

_POSES = 256
"""Poses encoded at once, in less than half a millisecond."""
_ROUNDING = 1e-9

TIP_LIMITS = {
    "tip_velocity": "speed",
    "tip_acceleration": "acceleration",
    "tip_angular_velocity": "angular_speed",
    "tip_angular_acceleration": "angular_acceleration",
}


def samples(motion: PiecewisePolynomial, times: Array) -> list[Array]:
    """Return positions, velocities and accelerations at times of shape (N,); three arrays of shape (N, n)."""
    return [np.ascontiguousarray(values) for values in motion.rates_at(times)]


def table(motion: PiecewisePolynomial, times: Array) -> Array:
    """Return time, positions, velocities and accelerations side by side; shape (N, 1 + 3n)."""
    return np.column_stack((times, *samples(motion, times)))


def columns(chain: Chain) -> list[str]:
    """Return the names of the table's columns."""
    return ["time", *(f"{quantity}_{name}" for quantity in ("q", "qd", "qdd") for name in chain.joint_names)]


def told_poses(poses: Poses, pose_format: PoseFormat) -> orjson.Fragment:
    """Encode poses as JSON, some at a time."""

    def pieces() -> Iterator[bytes]:
        for i in range(0, len(poses), _POSES):
            part = Poses(poses.positions[i : i + _POSES], poses.rotations[i : i + _POSES])
            yield orjson.dumps(pose_list(part, pose_format))

    return json_list(pieces())


def told_limits(limits: SegmentLimits) -> dict[str, Any]:
    """Return limits as JSON content; null for a limit of the tip that is not given."""
    return {
        "joint_velocity": limits.velocity.tolist(),
        "joint_acceleration": limits.acceleration.tolist(),
        "joint_jerk": limits.jerk.tolist(),
        **{name: _number(getattr(limits.tip, quantity)) for name, quantity in TIP_LIMITS.items()},
    }


def told_segments(found: Trajectory, bounds: tuple[SourcedLimits, ...], *, coefficients: bool) -> list[dict[str, Any]]:
    """Return the results of each segment."""
    entries = [_segment(report, bounds[report.index].limits) for report in found.segments]
    if coefficients:
        for entry, pieces in zip(entries, pieces_of_segments(found.motion, found.segments), strict=True):
            entry["polynomials"] = {
                "breaks": found.motion.breaks[pieces.start : pieces.stop + 1].tolist(),
                "coefficients": json_rows(found.motion.coefficients[pieces]),
            }
    return entries


def _segment(report: SegmentReport, limits: SegmentLimits) -> dict[str, Any]:
    entry = asdict(report)
    if report.joint_deviation is not None:
        entry["joint_deviation"] = dict(zip(("distance", "angle"), report.joint_deviation, strict=True))
    return {**entry, "limits": told_limits(limits)}


def pieces_of_segments(motion: PiecewisePolynomial, reports: Sequence[SegmentReport]) -> list[slice]:
    """Return, for each segment, the range of polynomial pieces that begin in it."""
    starts = np.array([report.start_time for report in reports])
    firsts = np.searchsorted(motion.breaks[:-1], starts - _ROUNDING * max(1.0, motion.duration))
    ends = np.append(firsts, len(motion.breaks) - 1)[1:]
    return [slice(first, end) for first, end in zip(firsts.tolist(), ends.tolist(), strict=True)]


def told_failure(found: Trajectory) -> dict[str, Any] | None:
    """Return why a trajectory ends early; None if it does not."""
    if found.failure is None:
        return None
    return {**asdict(found.failure), "position": found.failure.position.tolist()}


def told_audit(audit: Audit) -> dict[str, Any]:
    """Return the audit of a motion as JSON content."""
    jumps: list[Peak | None] = [*audit.jumps] or [None] * 4
    margin, sigma = audit.limit_margin, audit.min_singular_value
    peaks = ("velocity", "acceleration", "jerk", "path_deviation", "orientation_deviation")
    answer: dict[str, Any] = {"passed": audit.passed, **{name: _peak(getattr(audit, name)) for name in peaks}}
    answer["continuity"] = {name: _jump(jump) for name, jump in zip(DERIVATIVES, jumps, strict=True)}
    answer["min_singular_value"] = None if sigma is None else asdict(sigma)
    answer["limit_margin"] = None if margin is None else _margin(margin)
    answer["ends"] = audit.ends
    answer["tip"] = {name: _peak(peak) for name, peak in audit.tip.items()}
    answer["certificate"] = audit.certificate
    error = audit.way_error
    answer["way_error"] = None if error is None else {name: _number(one) for name, one in asdict(error).items()}
    answer["reasons"] = [asdict(reason) for reason in audit.reasons]
    return answer


def _margin(margin: Margin) -> dict[str, Any]:
    return {"value": margin.distance, "joint": margin.joint, "bound": margin.bound, "time": margin.time}


def _jump(jump: Peak | None) -> dict[str, Any] | None:
    return None if jump is None else {"value": abs(jump.value), "joint": jump.joint, "time": jump.time}


def _peak(peak: Peak | None) -> dict[str, Any] | None:
    if peak is None:
        return None
    return {"ratio": _number(peak.ratio), "value": peak.value, "joint": peak.joint, "time": peak.time}


def _number(value: float | None) -> float | None:
    """Return a number if it is finite, else None."""
    return value if value is not None and math.isfinite(value) else None
