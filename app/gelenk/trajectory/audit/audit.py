"""Audit of a motion by evaluating it, with code that shares nothing with the planners.

It finds the peaks of each joint and of the tip, jumps where pieces meet, the distance to joint limits, errors at the
ends, the distance from the demanded path (also between samples), and the smallest singular value. Pinocchio recomputes
the poses of some samples. The result passes, or gives the reasons why not.
"""

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from typing import Any, Literal, TypeVar

import numpy as np

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import MAX_SAMPLES, certify_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.audit.examine import examined
from gelenk.trajectory.audit.joints import joint_figures
from gelenk.trajectory.audit.pieces import Pieces, pieces_of
from gelenk.trajectory.audit.result import (
    Audit,
    Continuity,
    Jump,
    LimitMargin,
    PathError,
    Peak,
    Reason,
    SmallestSingularValue,
    TipPeaks,
)
from gelenk.trajectory.audit.tip import Largest, largest_rates, path_peaks, tip_peaks
from gelenk.trajectory.audit.torques import torque_peaks
from gelenk.trajectory.audit.worst import ENDS, JUMPS, MARGIN, STATED, JointDemands, jumps_of, worst
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_Timed = TypeVar("_Timed", Peak, LimitMargin, SmallestSingularValue, Reason)

DERIVATIVES = ("position", "velocity", "acceleration", "jerk")
_RATES: tuple[Literal["velocity", "acceleration", "jerk"], ...] = ("velocity", "acceleration", "jerk")
_DIGIT = 10.0
"""Factor by which the tolerated jump grows with each derivative: coefficients hold fewer digits of higher ones."""
_AT_REST = np.zeros((0, 1, 1))
_TIP_UNITS = {"speed": "m/s", "angular_speed": "rad/s", "acceleration": "m/s²", "angular_acceleration": "rad/s²"}


def audit(robot: RobotModel, chain: Chain, motion: PiecewisePolynomial, demands: Demands) -> Audit:
    """Audit a motion.

    Raises:
        CertificationFailed: Pinocchio's poses differ, or the motion is invalid: a number is not finite, or a piece
            has no duration.
    """
    found = examined(chain, motion, _of_joints(chain, demands), demands.task, MAX_SAMPLES)
    if found is None:
        raise CertificationFailed("the motion", math.nan, 0.0)
    examination, rows = _Examination(motion, chain, demands, []), found.joints.tolist()
    peaks = examination.joint_peaks(rows)
    tip, deviations = examination.tip(largest_rates(*found.tip))
    continuity = examination.continuity(peaks, rows[JUMPS:MARGIN])
    margin = examination.margin(rows[MARGIN])
    ends = examination.ends(peaks, rows[ENDS:])
    torque = examination.torque()
    return Audit(
        not examination.reasons,
        peaks.get("velocity"),
        peaks.get("acceleration"),
        peaks.get("jerk"),
        deviations.get("position"),
        deviations.get("orientation"),
        continuity,
        SmallestSingularValue(found.sigma, found.sigma_time) if len(chain) else None,
        margin,
        ends,
        tip,
        torque,
        certify_poses(robot, chain, found.qs, {chain.tip_frame: found.poses}),
        demands.way_error,
        tuple(examination.reasons),
    )


def whole_audit(chain: Chain, motion: PiecewisePolynomial, audits: Sequence[Audit], starts: Sequence[float]) -> Audit:
    """Audit a whole motion: the audits of its parts, each against its own limits, and how the parts meet.

    The parts, at least one, begin at `starts`, [s].
    """
    if len(audits) == 1:
        return audits[0]
    timed = list(zip(audits, starts, strict=True))
    meeting = _Examination(motion, chain, Demands(), [])
    jumps = jumps_of(*map(np.ascontiguousarray, (motion.breaks, motion.coefficients))).tolist() if len(chain) else []
    continuity = meeting.continuity({}, jumps)
    reasons = (*(_moved(reason, at) for one, at in timed for reason in one.reasons), *meeting.reasons)
    certificates, errors = [one.certificate for one in audits], [one.way_error for one in audits if one.way_error]

    def moved(name: str) -> list[Any]:
        found = ((getattr(one, name), at) for one, at in timed)
        return [_moved(one, at) for one, at in found if one is not None]

    return Audit(
        not reasons,
        _worst_part(moved("velocity")),
        _worst_part(moved("acceleration")),
        _worst_part(moved("jerk")),
        _worst_part(moved("path_deviation")),
        _worst_part(moved("orientation_deviation")),
        continuity,
        min(moved("min_singular_value"), key=lambda one: one.value, default=None),
        min(moved("limit_margin"), key=lambda one: one.value, default=None),
        _of(audits[0], "start") | _of(audits[-1], "end"),
        TipPeaks(*(_worst_tip([_moved(getattr(one.tip, name), at) for one, at in timed]) for name in _TIP_UNITS)),
        _worst_part(moved("joint_torque")),
        PoseCertificate.of_all(certificates),
        _largest_error(errors) if errors else None,
        reasons,
    )


def _moved(one: _Timed, start: float) -> _Timed:
    return replace(one, time=one.time + start)


def _of(audit: Audit, end: str) -> dict[str, float]:
    return {name: error for name, error in audit.ends.items() if name.startswith(end)}


def _worst_part(peaks: Sequence[Peak]) -> Peak | None:
    limited = [peak for peak in peaks if peak.ratio is not None]
    if limited:
        return max(limited, key=lambda peak: peak.ratio or 0.0)
    return max(peaks, key=lambda peak: abs(peak.value), default=None)


def _worst_tip(peaks: Sequence[Peak]) -> Peak:
    """Return the largest value of all parts, with the largest ratio to the limit of a part."""
    largest = max(peaks, key=lambda peak: peak.value)
    return replace(largest, ratio=max((peak.ratio for peak in peaks if peak.ratio is not None), default=None))


def _largest_error(errors: Sequence[PathError]) -> PathError:
    columns = zip(*(astuple(error) for error in errors), strict=True)
    return PathError(*(None if None in column else max(column) for column in columns))


def _of_joints(chain: Chain, demands: Demands) -> JointDemands:
    given, none = demands.joints, np.full(len(chain), math.inf)
    limits = given.velocity, given.acceleration, given.jerk, demands.stated_jerk
    return JointDemands(
        np.array([none if each is None else each for each in limits]),
        chain.lower if given.lower is None else given.lower,
        chain.upper if given.upper is None else given.upper,
        none[None][:0] if demands.ends is None else np.array(demands.ends),
        _AT_REST if demands.end_rates is None else np.array(demands.end_rates),
    )


@dataclass(frozen=True)
class _Examination:
    """The checks of a motion; each adds to the reasons why it does not pass. The rows are those of `worst`."""

    motion: PiecewisePolynomial
    chain: Chain
    demands: Demands
    reasons: list[Reason]

    @cached_property
    def pieces(self) -> Pieces:
        """The pieces of the motion."""
        return pieces_of(self.motion)

    def peak(self, row: Sequence[float]) -> Peak:
        ratio, value, joint, time = row
        return Peak(None if ratio == -1.0 else ratio, value, self.chain.joint_names[int(joint)], time)

    def joint_peaks(self, rows: list[list[float]]) -> dict[str, Peak]:
        """Compare the peaks of velocity, acceleration and jerk with their limits; empty without joints."""
        demands = self.demands
        peaks: dict[str, Peak] = {}
        for order, check in enumerate(_RATES if len(self.chain) else (), start=1):
            peak = self.joint_peak(check, rows[order - 1], None if demands.stated_jerk is None else rows[STATED])
            for zone in demands.zones:
                if zone.joints is not None:
                    within = joint_figures(self.pieces.between(zone.begin, zone.end))
                    found = within.extremes[order + 1], within.times[order + 1]
                    stated = None if zone.stated_jerk is None else worst(*found, zone.stated_jerk)
                    one = self.joint_peak(check, worst(*found, zone.joints[order - 1]), stated)
                    peak = max(peak, one, key=lambda peak: peak.ratio or 0.0)
            peaks[check] = peak
        return peaks

    def joint_peak(
        self, check: Literal["velocity", "acceleration", "jerk"], row: Sequence[float], stated: Sequence[float] | None
    ) -> Peak:
        """Return the peak nearest to its limit of those of all joints, and check it."""
        peak = self.peak(row)
        enforced: Peak | None = peak
        if check == "jerk" and not self.demands.keeps_jerk:
            enforced = None if stated is None else self.peak(stated)
        if enforced and enforced.ratio is not None and not enforced.ratio <= 1.0 + self.demands.tolerance:
            detail = f"{check} is {enforced.ratio:.6g} times the limit"
            self.reasons.append(Reason(check, detail, enforced.joint, enforced.time))
        return peak

    def continuity(self, peaks: dict[str, Peak], rows: list[list[float]]) -> Continuity:
        names, demands = self.chain.joint_names, self.demands
        if not names:
            return Continuity(None, None, None, None)
        jumps = [Jump(value, names[int(joint)], time) for _, value, joint, time in rows]
        for order, jump in enumerate(jumps[: demands.continuous + 1]):
            if not jump.value <= _DIGIT**order * demands.tolerance * _scale(peaks, DERIVATIVES[order]):
                detail = f"{DERIVATIVES[order]} jumps by {jump.value:.6g}"
                self.reasons.append(Reason("continuity", detail, jump.joint, jump.time))
        return Continuity(*jumps)

    def margin(self, row: list[float]) -> LimitMargin | None:
        side, distance, joint, time = row
        if not len(self.chain) or distance == math.inf:
            return None
        bound: Literal["lower", "upper"] = "lower" if side else "upper"
        margin = LimitMargin(distance, self.chain.joint_names[int(joint)], bound, time)
        if not margin.value >= -self.demands.tolerance:
            detail = f"the joint goes {-margin.value:.6g} beyond its {bound} limit"
            self.reasons.append(Reason("joint_limit", detail, margin.joint, margin.time))
        return margin

    def ends(self, peaks: dict[str, Peak], rows: list[list[float]]) -> dict[str, float]:
        names, demands, breaks = self.chain.joint_names, self.demands, self.motion.breaks
        rates = 1 if demands.end_rates is None else len(demands.end_rates[0])
        orders = range(1 if demands.ends is None else 0, rates + 1)
        errors: dict[str, float] = {}
        for i, end in enumerate(("start", "end") if names else ()):
            for order in orders:
                quantity, (_, error, joint, _) = DERIVATIVES[order], rows[3 * i + order]
                errors[f"{end}_{quantity}"] = error
                if not error <= demands.tolerance * _scale(peaks, quantity):
                    time = float(breaks[-2] + (breaks[-1] - breaks[-2]) if i else breaks[0])
                    detail = f"{quantity} at the {end} is off by {error:.6g}"
                    self.reasons.append(Reason("boundary", detail, names[int(joint)], time))
        return errors

    def torque(self) -> Peak | None:
        """Find the torque nearest to its limit, or the largest if none is limited."""
        stretches = [(-math.inf, math.inf, self.demands.torque)]
        stretches += [(zone.begin, zone.end, zone.torque) for zone in self.demands.zones]
        peaks = []
        for begin, end, limits in stretches:
            if limits is not None and len(self.chain):
                found = torque_peaks(self.pieces.between(begin, end), limits)
                peaks.append(self.peak(worst(*found, limits.most)))
        peak = max(peaks, key=lambda one: one.ratio or 0.0, default=None)
        if peak is not None and peak.ratio is not None and not peak.ratio <= 1.0 + self.demands.tolerance:
            detail = f"torque is {peak.ratio:.6g} times the limit"
            self.reasons.append(Reason("torque", detail, peak.joint, peak.time))
        return peak

    def tip(self, largest: dict[str, Largest]) -> tuple[TipPeaks, dict[str, Peak]]:
        """Check the peaks of the tip, and find its deviations from the path by quantity; none without a path."""
        demands = self.demands
        limits = {name: getattr(demands.tip, name) for name in _TIP_UNITS}
        limits |= {"position": demands.path_tolerance, "orientation": demands.orientation_tolerance}
        peaks: dict[str, Peak] = {}
        if demands.path is not None:
            largest |= path_peaks(self.pieces, self.chain, demands.path, demands.task)
        for quantity, found in largest.items():
            limit = limits[quantity]
            ratio = _ratio(found.value, limit) if math.isfinite(limit) else None
            peaks[quantity] = Peak(ratio, found.value, None, found.time)
            self.check_tip(quantity, found, limit, ratio)
        for zone in demands.zones:
            within = tip_peaks(self.pieces.between(zone.begin, zone.end), self.chain)
            for quantity, found in within.items():
                limit = getattr(zone.tip, quantity)
                if math.isfinite(limit):
                    ratio = found.value / limit
                    self.check_tip(quantity, found, limit, ratio)
                    peaks[quantity] = replace(peaks[quantity], ratio=max(peaks[quantity].ratio or 0.0, ratio))
        return TipPeaks(*(peaks.pop(name) for name in _TIP_UNITS)), peaks

    def check_tip(self, quantity: str, found: Largest, limit: float, ratio: float | None) -> None:
        if ratio is None or ratio <= 1.0 + self.demands.tolerance:
            return
        if quantity in _TIP_UNITS:
            unit, what = _TIP_UNITS[quantity], quantity.replace("_", " ")
            detail = f"the tip's {what} is {found.value:.6g} {unit}; the limit is {limit:g} {unit}"
            self.reasons.append(Reason("tip", detail, None, found.time))
        else:
            unit = "m" if quantity == "position" else "rad"
            detail = f"the tip's {quantity} is {found.value:.6g} {unit} from the path; the limit is {limit:g} {unit}"
            self.reasons.append(Reason("path", detail, None, found.time))


def _ratio(value: float, limit: float) -> float:
    """Divide a magnitude by its limit; if the limit is 0, a value of 0 gives 0 and any other gives infinity."""
    size = abs(value)
    return size / limit if limit > 0.0 else 0.0 if size == 0.0 else math.inf


def _scale(peaks: dict[str, Peak], quantity: str) -> float:
    return max(1.0, abs(peaks[quantity].value)) if quantity in peaks else 1.0
