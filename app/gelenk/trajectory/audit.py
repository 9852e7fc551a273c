"""A motion judged by code that shares nothing with what planned it: by evaluating it, never by trusting its formulas.

`audit` takes a motion of joints and what it must keep to, and finds the largest velocity, acceleration and jerk of each
joint, jumps where pieces meet, the distance to joint limits, the ends, the tip's speeds and accelerations, the distance
from the path wanted (also between samples), and the nearness to a singularity. Poses at some samples are recomputed
through Pinocchio. It passes or says why not.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from gelenk.kinematics.certify import MAX_SAMPLES, Certificate, certify_poses
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.errors import CertificationFailed
from gelenk.model.robot import Robot
from gelenk.trajectory.audit_demands import Demands, Stretch, WayError
from gelenk.trajectory.audit_pieces import Extremes, Pieces, extremes, largest_jumps, pieces_of
from gelenk.trajectory.audit_tip import Largest, poses_at, smallest_singular_value, tip_peaks
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.words import Check

DERIVATIVES = ("position", "velocity", "acceleration", "jerk")
_RATES: tuple[Check, ...] = ("velocity", "acceleration", "jerk")
_DIGIT = 10.0
"""By how much more than the one before a derivative may jump: coefficients have fewer digits for it."""
_STRETCH = 200
"""Samples of a stretch that has limits of its own."""
_TIP_UNITS = {"speed": "m/s", "angular_speed": "rad/s", "acceleration": "m/s²", "angular_acceleration": "rad/s²"}


@dataclass(frozen=True, slots=True)
class Peak:
    """The largest of something.

    Attributes:
        ratio: To its limit; None where there is none, infinite where it is 0.
        value: What it is there, with its sign.
        joint: Which joint; None for the tip.
        time: When, [s].
    """

    ratio: float | None
    value: float
    joint: str | None
    time: float


@dataclass(frozen=True, slots=True)
class Margin:
    """How far the joints stay from their limits: the smallest distance, negative beyond, [rad or m]."""

    distance: float
    joint: str
    bound: Literal["lower", "upper"]
    time: float


@dataclass(frozen=True, slots=True)
class Singularity:
    """The smallest singular value of the geometric Jacobian's rows that count; metres and radians are mixed."""

    value: float
    time: float


@dataclass(frozen=True, slots=True)
class Reason:
    """Why a motion does not pass.

    Attributes:
        check: What it fails.
        detail: In a sentence.
        joint: Of which joint, where one can be named.
        time: When, [s].
    """

    check: Check
    detail: str
    joint: str | None
    time: float


@dataclass(frozen=True, slots=True)
class Audit:
    """A motion's judgement.

    Attributes:
        velocity: The joint velocity nearest to or furthest beyond its limit; None without joints.
        acceleration: Likewise.
        jerk: Likewise; where acceleration jumps it is infinite, which `jumps` tells and this does not.
        jumps: The largest jump of position, velocity, acceleration and jerk where pieces meet.
        limit_margin: None where no joint has limits.
        ends: Largest error of a joint at each end that is requested, by name, [rad or m per sᵏ].
        tip: Largest speed, angular speed, acceleration and angular acceleration, [m/s, rad/s, m/s², rad/s²].
        path_deviation: Largest distance from the path wanted, [m]; None without one.
        orientation_deviation: Largest angle from it, [rad].
        min_singular_value: None without joints.
        certificate: How far Pinocchio's poses are from ours at some samples.
        reasons: Why it does not pass.
        way_error: By how much the peaks of the joints differ from those of the exact path; None without one.
    """

    velocity: Peak | None
    acceleration: Peak | None
    jerk: Peak | None
    jumps: tuple[Peak, ...]
    limit_margin: Margin | None
    ends: dict[str, float]
    tip: dict[str, Peak]
    path_deviation: Peak | None
    orientation_deviation: Peak | None
    min_singular_value: Singularity | None
    certificate: Certificate
    reasons: tuple[Reason, ...]
    way_error: WayError | None = None

    @property
    def passed(self) -> bool:
        """Whether there is no reason against it."""
        return not self.reasons


def audit(robot: Robot, chain: Chain, motion: PiecewisePolynomial, demands: Demands) -> Audit:
    """Judge a motion.

    Args:
        robot: The robot.
        chain: What moves; n variables.
        motion: Their values in time; n coordinates.
        demands: What it has to keep to.

    Raises:
        CertificationFailed: Pinocchio's poses differ, or the motion is none: a number is not finite, or a piece takes
            no time.
    """
    if not (np.isfinite(motion.coefficients).all() and (np.diff(motion.breaks) > 0.0).all()):
        raise CertificationFailed("the motion", math.nan, 0.0)
    pieces, names = pieces_of(motion), chain.joint_names
    reasons: list[Reason] = []
    peaks = _joint_peaks(pieces, names, demands, reasons)
    tip, deviations = _tip(pieces, chain, demands, reasons)
    qs, poses = poses_at(pieces, chain, MAX_SAMPLES)
    return Audit(
        peaks.get("velocity"),
        peaks.get("acceleration"),
        peaks.get("jerk"),
        _jumps(pieces, names, demands, peaks, reasons),
        _margin(pieces, chain, demands, reasons),
        _ends(pieces, names, demands, peaks, reasons),
        tip,
        deviations.get("position"),
        deviations.get("orientation"),
        _singularity(pieces, chain, demands),
        certify_poses(robot, chain, qs, {chain.tip_frame: poses}),
        tuple(reasons),
        demands.way_error,
    )


def meetings(chain: Chain, motion: PiecewisePolynomial) -> tuple[tuple[Peak, ...], tuple[Reason, ...]]:
    """The largest jumps of a motion whose parts have been judged, and whether position or velocity jumps."""
    reasons: list[Reason] = []
    jumps = _jumps(pieces_of(motion), chain.joint_names, Demands(), {}, reasons)
    return jumps, tuple(reasons)


def _joint_peaks(pieces: Pieces, names: tuple[str, ...], demands: Demands, reasons: list[Reason]) -> dict[str, Peak]:
    """The peaks of velocity, acceleration and jerk; none without joints."""
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
    """The joint nearest to its limit, or the fastest where none has one."""
    sizes = np.abs(found.values)
    limited = bounds is not None and bool(np.isfinite(bounds).any())
    ratios = _ratios(sizes, bounds) if limited and bounds is not None else sizes
    joint = int(ratios.argmax())
    ratio = float(ratios[joint]) if limited else None
    return Peak(ratio, float(found.values[joint]), names[joint], float(found.times[joint]))


def _ratios(sizes: Array, bounds: Array) -> Array:
    """Sizes over their limits; what is at rest keeps to any, what moves is infinitely far beyond a limit of 0."""
    beyond = np.where(sizes > 0.0, np.inf, 0.0)
    ratios: Array = np.divide(sizes, bounds, out=beyond, where=bounds > 0.0)
    return ratios


def _jumps(
    pieces: Pieces, names: tuple[str, ...], demands: Demands, peaks: dict[str, Peak], reasons: list[Reason]
) -> tuple[Peak, ...]:
    """The largest jump of each derivative."""
    jumps = []
    for order, quantity in enumerate(DERIVATIVES):
        if not names:
            break
        jump = _worst(largest_jumps(pieces, order), names, None)
        jumps.append(jump)
        if order <= demands.continuous and not jump.value <= _DIGIT**order * demands.tolerance * _scale(
            peaks, quantity
        ):
            detail = f"{quantity} jumps by {jump.value:.6g}"
            reasons.append(Reason("continuity", detail, jump.joint, jump.time))
    return tuple(jumps)


def _scale(peaks: dict[str, Peak], quantity: str) -> float:
    """The largest value of a derivative, or 1."""
    return max(1.0, abs(peaks[quantity].value)) if quantity in peaks else 1.0


def _margin(pieces: Pieces, chain: Chain, demands: Demands, reasons: list[Reason]) -> Margin | None:
    """The smallest distance to a joint limit."""
    lower = chain.lower if demands.joints.lower is None else demands.joints.lower
    upper = chain.upper if demands.joints.upper is None else demands.joints.upper
    if not (np.isfinite(lower).any() or np.isfinite(upper).any()):
        return None
    lowest, highest = extremes(pieces, 0, "lowest"), extremes(pieces, 0, "highest")
    below, above = lowest.values - lower, upper - highest.values
    bound: Literal["lower", "upper"] = "lower" if below.min() < above.min() else "upper"
    distances, times = (below, lowest.times) if bound == "lower" else (above, highest.times)
    joint = int(distances.argmin())
    margin = Margin(float(distances[joint]), chain.joint_names[joint], bound, float(times[joint]))
    if not margin.distance >= -demands.tolerance:
        detail = f"the joint goes {-margin.distance:.6g} beyond its {bound} limit"
        reasons.append(Reason("joint_limit", detail, margin.joint, margin.time))
    return margin


def _ends(
    pieces: Pieces, names: tuple[str, ...], demands: Demands, peaks: dict[str, Peak], reasons: list[Reason]
) -> dict[str, float]:
    """How far each end is from what is wanted."""
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


def _tip(
    pieces: Pieces, chain: Chain, demands: Demands, reasons: list[Reason]
) -> tuple[dict[str, Peak], dict[str, Peak]]:
    """The tip's peaks, and its deviations from the path."""
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
    for stretch in demands.stretches:
        within = tip_peaks(pieces.between(stretch.begin, stretch.end), chain, None, least=_STRETCH)
        for quantity in _TIP_UNITS:
            tip[quantity] = _in_stretch(tip[quantity], quantity, within[quantity], stretch, demands, reasons)
    return tip, deviations


def _in_stretch(
    peak: Peak, quantity: str, found: Largest, stretch: Stretch, demands: Demands, reasons: list[Reason]
) -> Peak:
    """The largest value everywhere, and the largest ratio to a limit, that of a stretch among them."""
    limit = getattr(stretch.tip, quantity)
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
        return Reason("tip", f"the tip's {what} is {value:.6g} {unit}; allowed is {limit:g} {unit}", None, time)
    unit = "m" if quantity == "position" else "rad"
    detail = f"the tip's {quantity} is {value:.6g} {unit} from the path; allowed is {limit:g} {unit}"
    return Reason("path", detail, None, time)


def _singularity(pieces: Pieces, chain: Chain, demands: Demands) -> Singularity | None:
    if not len(chain):
        return None
    found = smallest_singular_value(pieces, chain, demands.task)
    return Singularity(found.value, found.time)
