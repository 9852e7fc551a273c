"""Audit of a motion by evaluating it, with code that shares nothing with the planners.

`audit` takes a joint motion and its demands. It finds the largest velocity, acceleration and jerk of each joint, jumps
where pieces meet, the distance to joint limits, errors at the ends, the tip's speeds and accelerations, the distance
from the demanded path (also between samples), and the smallest singular value. Pinocchio recomputes the poses of some
samples. The result passes, or gives the reasons why not.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import MAX_SAMPLES, PoseCertificate, certify_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import Demands, Zone
from gelenk.trajectory.audit.pieces import Extremes, Pieces, extremes, largest_jumps, pieces_of
from gelenk.trajectory.audit.result import (
    Continuity,
    Jump,
    LimitMargin,
    PathError,
    Peak,
    Reason,
    SmallestSingularValue,
    TipPeaks,
)
from gelenk.trajectory.audit.tip import Largest, poses_at, smallest_singular_value, tip_peaks
from gelenk.trajectory.audit.words import Check
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

DERIVATIVES = ("position", "velocity", "acceleration", "jerk")
_RATES: tuple[Check, ...] = ("velocity", "acceleration", "jerk")
_DIGIT = 10.0
"""Factor by which the tolerated jump grows with each derivative: coefficients hold fewer digits of higher ones."""
_ZONE_SAMPLES = 200
"""Samples of a zone that has its own limits."""
_TIP_UNITS = {"speed": "m/s", "angular_speed": "rad/s", "acceleration": "m/s²", "angular_acceleration": "rad/s²"}


@dataclass(frozen=True, slots=True)
class Audit:
    """The result of auditing a motion.

    Attributes:
        passed: Whether the motion passes, with no reason against it.
        velocity: The joint velocity nearest to or furthest beyond its limit; None without joints.
        acceleration: Likewise.
        jerk: Likewise, within pieces: a jump of acceleration, where jerk is infinite, appears in `continuity` only.
        path_deviation: Largest distance from the demanded path, [m]; None without one.
        orientation_deviation: Largest angle from its orientation, [rad]; None without one.
        continuity: The largest jump of position, velocity, acceleration and jerk where pieces meet.
        min_singular_value: None without joints.
        limit_margin: Distance to the joint limits; None if no joint has limits.
        ends: Largest joint error of each demanded quantity at an end, such as `end_velocity`, [rad or m per sᵏ].
        tip: Largest speed, angular speed, acceleration and angular acceleration, [m/s, rad/s, m/s², rad/s²].
        certificate: How far Pinocchio's poses are from ours at some samples.
        way_error: How much ratios to joint limits may differ from the exact path's; None without such a path.
        reasons: Reasons why the motion does not pass.
    """

    passed: bool
    velocity: Peak | None
    acceleration: Peak | None
    jerk: Peak | None
    path_deviation: Peak | None
    orientation_deviation: Peak | None
    continuity: Continuity
    min_singular_value: SmallestSingularValue | None
    limit_margin: LimitMargin | None
    ends: dict[str, float]
    tip: TipPeaks
    certificate: PoseCertificate
    way_error: PathError | None
    reasons: tuple[Reason, ...]


def audit(robot: RobotModel, chain: Chain, motion: PiecewisePolynomial, demands: Demands) -> Audit:
    """Audit a motion.

    Args:
        robot: The robot.
        chain: The moving chain; n variables.
        motion: Joint values over time; n coordinates.
        demands: Limits, ends and path that the motion must keep.

    Raises:
        CertificationFailed: Pinocchio's poses differ, or the motion is invalid: a number is not finite, or a piece
            has no duration.
    """
    if not (np.isfinite(motion.coefficients).all() and (np.diff(motion.breaks) > 0.0).all()):
        raise CertificationFailed("the motion", math.nan, 0.0)
    pieces, names = pieces_of(motion), chain.joint_names
    reasons: list[Reason] = []
    peaks = _joint_peaks(pieces, names, demands, reasons)
    tip, deviations = _tip(pieces, chain, demands, reasons)
    qs, poses = poses_at(pieces, chain, MAX_SAMPLES)
    continuity = _continuity(pieces, names, demands, peaks, reasons)
    margin = _margin(pieces, chain, demands, reasons)
    ends = _ends(pieces, names, demands, peaks, reasons)
    return Audit(
        not reasons,
        peaks.get("velocity"),
        peaks.get("acceleration"),
        peaks.get("jerk"),
        deviations.get("position"),
        deviations.get("orientation"),
        continuity,
        smallest_singular_value(pieces, chain, demands.task) if names else None,
        margin,
        ends,
        tip,
        certify_poses(robot, chain, qs, {chain.tip_frame: poses}),
        demands.way_error,
        tuple(reasons),
    )


def continuity_of(chain: Chain, motion: PiecewisePolynomial) -> tuple[Continuity, tuple[Reason, ...]]:
    """Return the largest jumps where pieces meet, and a reason for each of position or velocity; no other checks."""
    reasons: list[Reason] = []
    found = _continuity(pieces_of(motion), chain.joint_names, Demands(), {}, reasons)
    return found, tuple(reasons)


def _joint_peaks(pieces: Pieces, names: tuple[str, ...], demands: Demands, reasons: list[Reason]) -> dict[str, Peak]:
    """Find the peaks of velocity, acceleration and jerk, and add reasons; empty without joints."""
    peaks: dict[str, Peak] = {}
    for order, check in enumerate(_RATES, start=1):
        if not names:
            break
        found = extremes(pieces, order, "absolute")
        bounds = getattr(demands.joints, check)
        peaks[check] = peak = _worst(found, names, bounds)
        if check == "jerk" and not demands.keeps_jerk:
            if demands.stated_jerk is None:
                continue
            peak = _worst(found, names, demands.stated_jerk)
        if peak.ratio is not None and not peak.ratio <= 1.0 + demands.tolerance:
            detail = f"{check} is {peak.ratio:.6g} times the limit"
            reasons.append(Reason(check, detail, peak.joint, peak.time))
    return peaks


def _worst(found: Extremes, names: tuple[str, ...], bounds: Array | None) -> Peak:
    """Return the joint nearest to its limit, or the largest value if none is limited."""
    sizes = np.abs(found.values)
    limited = bounds is not None and bool(np.isfinite(bounds).any())
    ratios = _ratios(sizes, bounds) if limited and bounds is not None else sizes
    joint = int(ratios.argmax())
    ratio = float(ratios[joint]) if limited else None
    return Peak(ratio, float(found.values[joint]), names[joint], float(found.times[joint]))


def _ratios(sizes: Array, bounds: Array) -> Array:
    """Divide sizes by limits; where the limit is 0, a size of 0 gives 0 and any other gives infinity."""
    beyond = np.where(sizes > 0.0, np.inf, 0.0)
    ratios: Array = np.divide(sizes, bounds, out=beyond, where=bounds > 0.0)
    return ratios


def _continuity(
    pieces: Pieces, names: tuple[str, ...], demands: Demands, peaks: dict[str, Peak], reasons: list[Reason]
) -> Continuity:
    """Find the largest jump of each derivative, and add reasons."""
    if not names:
        return Continuity(None, None, None, None)
    jumps = []
    for order, quantity in enumerate(DERIVATIVES):
        found = _worst(largest_jumps(pieces, order), names, None)
        jump = Jump(found.value, found.joint, found.time)
        jumps.append(jump)
        if order <= demands.continuous and not jump.value <= _DIGIT**order * demands.tolerance * _scale(
            peaks, quantity
        ):
            detail = f"{quantity} jumps by {jump.value:.6g}"
            reasons.append(Reason("continuity", detail, jump.joint, jump.time))
    return Continuity(*jumps)


def _scale(peaks: dict[str, Peak], quantity: str) -> float:
    """Return the peak of a derivative, but at least 1."""
    return max(1.0, abs(peaks[quantity].value)) if quantity in peaks else 1.0


def _margin(pieces: Pieces, chain: Chain, demands: Demands, reasons: list[Reason]) -> LimitMargin | None:
    """Find the smallest distance to a joint limit, and add a reason if it is beyond."""
    lower = chain.lower if demands.joints.lower is None else demands.joints.lower
    upper = chain.upper if demands.joints.upper is None else demands.joints.upper
    if not (np.isfinite(lower).any() or np.isfinite(upper).any()):
        return None
    lowest, highest = extremes(pieces, 0, "lowest"), extremes(pieces, 0, "highest")
    below, above = lowest.values - lower, upper - highest.values
    bound: Literal["lower", "upper"] = "lower" if below.min() < above.min() else "upper"
    distances, times = (below, lowest.times) if bound == "lower" else (above, highest.times)
    joint = int(distances.argmin())
    margin = LimitMargin(float(distances[joint]), chain.joint_names[joint], bound, float(times[joint]))
    if not margin.value >= -demands.tolerance:
        detail = f"the joint goes {-margin.value:.6g} beyond its {bound} limit"
        reasons.append(Reason("joint_limit", detail, margin.joint, margin.time))
    return margin


def _ends(
    pieces: Pieces, names: tuple[str, ...], demands: Demands, peaks: dict[str, Peak], reasons: list[Reason]
) -> dict[str, float]:
    """Return the largest error of each demanded quantity at both ends, and add reasons."""
    errors: dict[str, float] = {}
    still = np.zeros(len(names))
    last = len(pieces.widths) - 1
    for end, piece, tau in (("start", 0, 0.0), ("end", last, 1.0)):
        for order, quantity in enumerate(DERIVATIVES[:3]):
            wanted = getattr(demands.ends, end if order == 0 else f"{end}_{quantity}")
            if order == 1 and wanted is None:
                wanted = still
            if wanted is None or not names:
                continue
            off = np.abs(pieces.at(np.array([piece]), np.array([tau]), order)[0] - wanted)
            joint = int(off.argmax())
            errors[f"{end}_{quantity}"] = error = float(off[joint])
            if not error <= demands.tolerance * _scale(peaks, quantity):
                time = float(pieces.starts[piece] + tau * pieces.widths[piece])
                detail = f"{quantity} at the {end} is off by {error:.6g}"
                reasons.append(Reason("boundary", detail, names[joint], time))
    return errors


def _tip(pieces: Pieces, chain: Chain, demands: Demands, reasons: list[Reason]) -> tuple[TipPeaks, dict[str, Peak]]:
    """Find the peaks of the tip and its deviations from the path, and add reasons."""
    tolerances = {"position": demands.path_tolerance, "orientation": demands.orientation_tolerance}
    tip: dict[str, Peak] = {}
    deviations: dict[str, Peak] = {}
    for quantity, found in tip_peaks(pieces, chain, demands.path, demands.task).items():
        of_tip = quantity in _TIP_UNITS
        limit = getattr(demands.tip, quantity) if of_tip else tolerances[quantity]
        ratio = float(_ratios(np.array(found.value), np.array(limit))) if math.isfinite(limit) else None
        (tip if of_tip else deviations)[quantity] = Peak(ratio, found.value, None, found.time)
        if ratio is not None and not ratio <= 1.0 + demands.tolerance:
            reasons.append(_tip_reason(quantity, found.value, limit, found.time))
    for zone in demands.zones:
        within = tip_peaks(pieces.between(zone.begin, zone.end), chain, None, least=_ZONE_SAMPLES)
        for quantity in _TIP_UNITS:
            tip[quantity] = _in_zone(tip[quantity], quantity, within[quantity], zone, demands, reasons)
    return TipPeaks(**tip), deviations


def _in_zone(peak: Peak, quantity: str, found: Largest, zone: Zone, demands: Demands, reasons: list[Reason]) -> Peak:
    """Raise a peak's ratio to that of a zone with its own limit if larger, and add a reason if it is exceeded."""
    limit = getattr(zone.tip, quantity)
    if not math.isfinite(limit):
        return peak
    ratio = found.value / limit
    if not ratio <= 1.0 + demands.tolerance:
        reasons.append(_tip_reason(quantity, found.value, limit, found.time))
    return replace(peak, ratio=max(peak.ratio or 0.0, ratio))


def _tip_reason(quantity: str, value: float, limit: float, time: float) -> Reason:
    if quantity in _TIP_UNITS:
        what = quantity.replace("_", " ")
        unit = _TIP_UNITS[quantity]
        return Reason("tip", f"the tip's {what} is {value:.6g} {unit}; the limit is {limit:g} {unit}", None, time)
    unit = "m" if quantity == "position" else "rad"
    detail = f"the tip's {quantity} is {value:.6g} {unit} from the path; the limit is {limit:g} {unit}"
    return Reason("path", detail, None, time)
