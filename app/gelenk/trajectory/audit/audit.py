"""Audit of a motion by evaluating it, with code that shares nothing with the planners.

It finds the peaks of each joint and of the tip, jumps where pieces meet, the distance to joint limits, errors at the
ends, the distance from the demanded path (also between samples), and the smallest singular value. Pinocchio recomputes
the poses of some samples. The result passes, or gives the reasons why not.
"""

import math
from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace
from operator import sub
from typing import Any, Literal, TypeVar

import numpy as np

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import MAX_SAMPLES, certify_poses
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.audit.examine import examined
from gelenk.trajectory.audit.joints import JointFigures, joint_figures
from gelenk.trajectory.audit.pieces import Pieces, are_pieces, pieces_of
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
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_Timed = TypeVar("_Timed", Peak, LimitMargin, SmallestSingularValue, Reason)

DERIVATIVES = ("position", "velocity", "acceleration", "jerk")
_RATES: tuple[Literal["velocity", "acceleration", "jerk"], ...] = ("velocity", "acceleration", "jerk")
_DIGIT = 10.0
"""Factor by which the tolerated jump grows with each derivative: coefficients hold fewer digits of higher ones."""
_TIP_UNITS = {"speed": "m/s", "angular_speed": "rad/s", "acceleration": "m/s²", "angular_acceleration": "rad/s²"}


def audit(robot: RobotModel, chain: Chain, motion: PiecewisePolynomial, demands: Demands) -> Audit:
    """Audit a motion.

    Raises:
        CertificationFailed: Pinocchio's poses differ, or the motion is invalid: a number is not finite, or a piece
            has no duration.
    """
    if not are_pieces(np.ascontiguousarray(motion.breaks), np.ascontiguousarray(motion.coefficients)):
        raise CertificationFailed("the motion", math.nan, 0.0)
    found = examined(chain, motion, demands.task, MAX_SAMPLES)
    examination = _Examination(found.pieces, chain, demands, [])
    values, times = found.joints.extremes.tolist(), found.joints.times.tolist()
    peaks = examination.joint_peaks(values[2:], times[2:])
    tip, deviations = examination.tip(largest_rates(found.tip, found.tip_times))
    continuity = examination.continuity(peaks, found.joints)
    margin = examination.margin(values, times)
    ends = examination.ends(peaks, found.ends)
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
    meeting = _Examination(pieces_of(motion), chain, Demands(), [])
    continuity = meeting.continuity({}, joint_figures(meeting.pieces))
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


@dataclass(frozen=True, slots=True)
class _Examination:
    """The checks of a motion; each adds to the reasons why it does not pass."""

    pieces: Pieces
    chain: Chain
    demands: Demands
    reasons: list[Reason]

    def joint_peaks(self, values: list[list[float]], times: list[list[float]]) -> dict[str, Peak]:
        """Compare the peaks of velocity, acceleration and jerk with their limits; empty without joints."""
        demands, names = self.demands, self.chain.joint_names
        peaks: dict[str, Peak] = {}
        for order, check in enumerate(_RATES if names else (), start=1):
            whole = values[order - 1], times[order - 1]
            found = [self.joint_peak(order, *whole, getattr(demands.joints, check), demands.stated_jerk)]
            for zone in demands.zones:
                if zone.joints is not None:
                    within = joint_figures(self.pieces.between(zone.begin, zone.end))
                    sizes, at = within.extremes[order + 1].tolist(), within.times[order + 1].tolist()
                    found.append(self.joint_peak(order, sizes, at, zone.joints[order - 1], zone.stated_jerk))
            peaks[check] = max(found, key=lambda peak: peak.ratio or 0.0)
        return peaks

    def joint_peak(
        self, order: int, values: list[float], times: list[float], limits: Array | None, stated_jerk: Array | None
    ) -> Peak:
        """Return the peak nearest to its limit of those of all joints, and check it."""
        check, names = _RATES[order - 1], self.chain.joint_names
        peak = _worst(values, times, names, limits)
        enforced: Peak | None = peak
        if check == "jerk" and not self.demands.keeps_jerk:
            enforced = None if stated_jerk is None else _worst(values, times, names, stated_jerk)
        if enforced and enforced.ratio is not None and not enforced.ratio <= 1.0 + self.demands.tolerance:
            detail = f"{check} is {enforced.ratio:.6g} times the limit"
            self.reasons.append(Reason(check, detail, enforced.joint, enforced.time))
        return peak

    def continuity(self, peaks: dict[str, Peak], joints: JointFigures) -> Continuity:
        names, tolerance = self.chain.joint_names, self.demands.tolerance
        if not names:
            return Continuity(None, None, None, None)
        jumps = []
        values, times = joints.jumps.tolist(), joints.jump_times.tolist()
        for order, quantity in enumerate(DERIVATIVES):
            joint = _worst_index(values[order])
            jump = Jump(values[order][joint], names[joint], times[order][joint])
            jumps.append(jump)
            allowed = _DIGIT**order * tolerance * _scale(peaks, quantity)
            if order <= self.demands.continuous and not jump.value <= allowed:
                detail = f"{quantity} jumps by {jump.value:.6g}"
                self.reasons.append(Reason("continuity", detail, jump.joint, jump.time))
        return Continuity(*jumps)

    def margin(self, values: list[list[float]], times: list[list[float]]) -> LimitMargin | None:
        chain, limits = self.chain, self.demands.joints
        if not chain.joint_names:
            return None
        lower = chain.lower if limits.lower is None else limits.lower
        upper = chain.upper if limits.upper is None else limits.upper
        # 0 - 0 is 0, and the opposite of 0 is -0.
        below = [0.0 - value - bound for value, bound in zip(values[0], lower.tolist(), strict=True)]
        above = [bound - value for value, bound in zip(values[1], upper.tolist(), strict=True)]
        joint = _worst_index([-distance for distance in (*above, *below)])
        side, joint = divmod(joint, len(above))
        if (distance := (above, below)[side][joint]) == math.inf:
            return None
        bound: Literal["lower", "upper"] = "lower" if side else "upper"
        margin = LimitMargin(distance, chain.joint_names[joint], bound, times[1 - side][joint])
        if not margin.value >= -self.demands.tolerance:
            detail = f"the joint goes {-margin.value:.6g} beyond its {bound} limit"
            self.reasons.append(Reason("joint_limit", detail, margin.joint, margin.time))
        return margin

    def ends(self, peaks: dict[str, Peak], at_ends: Array) -> dict[str, float]:
        pieces, names, demands = self.pieces, self.chain.joint_names, self.demands
        errors: dict[str, float] = {}
        rest = [[0.0] * len(names)]
        for i, end in enumerate(("start", "end") if names else ()):
            rates = rest if demands.end_rates is None else demands.end_rates[i].tolist()
            position = None if demands.ends is None else demands.ends[i].tolist()
            for quantity, values, wanted in zip(DERIVATIVES, at_ends[i].tolist(), (position, *rates), strict=False):
                if wanted is None:
                    continue
                off = list(map(abs, map(sub, values, wanted)))
                joint = _worst_index(off)
                errors[f"{end}_{quantity}"] = error = off[joint]
                if not error <= demands.tolerance * _scale(peaks, quantity):
                    time = float(pieces.starts[-1] + pieces.widths[-1] if i else pieces.starts[0])
                    detail = f"{quantity} at the {end} is off by {error:.6g}"
                    self.reasons.append(Reason("boundary", detail, names[joint], time))
        return errors

    def torque(self) -> Peak | None:
        """Find the torque nearest to its limit, or the largest if none is limited."""
        stretches = [(self.pieces, self.demands.torque)]
        stretches += [(self.pieces.between(zone.begin, zone.end), zone.torque) for zone in self.demands.zones]
        names, peaks = self.chain.joint_names, []
        for pieces, limits in stretches:
            if limits is not None and names:
                values, times = torque_peaks(pieces, limits)
                peaks.append(_worst(values.tolist(), times.tolist(), names, limits.most))
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


def _worst(values: list[float], times: list[float], names: tuple[str, ...], bounds: Array | None) -> Peak:
    """Return the joint nearest to its limit, or the largest value if none is limited."""
    limits = [math.inf] if bounds is None else bounds.tolist()
    limited = min(limits) < math.inf
    ratios = list(map(_ratio, values, limits)) if limited else list(map(abs, values))
    joint = _worst_index(ratios)
    return Peak(ratios[joint] if limited else None, values[joint], names[joint], times[joint])


def _worst_index(values: list[float]) -> int:
    """Return where the largest value is; one that is not a number is the largest."""
    if math.isnan(sum(values)):
        values = [math.inf if math.isnan(value) else value for value in values]
    return values.index(max(values))


def _ratio(value: float, limit: float) -> float:
    """Divide a magnitude by its limit; if the limit is 0, a value of 0 gives 0 and any other gives infinity."""
    size = abs(value)
    return size / limit if limit > 0.0 else math.inf if size > 0.0 else 0.0


def _scale(peaks: dict[str, Peak], quantity: str) -> float:
    return max(1.0, abs(peaks[quantity].value)) if quantity in peaks else 1.0
