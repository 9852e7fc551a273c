"""Joint motions whose ends move, with given velocities and accelerations.

A polynomial and a cubic spline depend linearly on what is given at their ends: with λ = t/T their coefficients are
C₀ + T C₁ + T² C₂, one part each for the positions, velocities and accelerations. More time does not always mean less of
each quantity, so the duration is the first of a grid that keeps the limits, refined; a shorter one may be missed.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.joints.excess import first_limit_excess
from gelenk.trajectory.joints.fastest import NO_LENGTH
from gelenk.trajectory.joints.motion import check_duration
from gelenk.trajectory.joints.waypoints import check_within, knots
from gelenk.trajectory.laws.jerk_limited import check_rates, jerk_limited
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.laws.time_scaling import ScalingLimits, check_limits, uniform_scaling
from gelenk.trajectory.motion.extremes import candidates
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, joined
from gelenk.trajectory.motion.splines import EndRates, cubic_spline
from gelenk.trajectory.motion.time_laws import hermite_pieces
from gelenk.trajectory.problem.parts import standing
from gelenk.trajectory.problem.problem import Segment

_DURATIONS, _REFINED, _ZOOMS = 400, 33, 6
"""Durations of the grid, and of each of its refinements."""
_SHORTEST, _LONGEST = 1e-3, 30.0
"""Ends of the grid, in units of the time that the limits suggest."""
_EXCESS = 1e-10
"""Relative excess over a limit that is rounding."""


def moving_motion(
    chain: Chain, start: Array, target: Array | None, segment: Segment, ends: EndRates
) -> PiecewisePolynomial:
    """Return the motion of a joint segment with given rates at its ends, in the least time or the given one.

    Args:
        start, target: Shape (n,), [rad or m]; the target is None for a spline through the segment's configurations.
        ends: What the law allows; zero elsewhere.

    Raises:
        InvalidField: Rates or times are beyond the limits, or a joint would leave its range.
    """
    check_limits(segment.limits.joints)
    check_duration(segment.duration)
    motion = _motion(chain, start, target, segment, ends)
    excess = first_limit_excess(chain, motion)
    if excess is not None:
        raise InvalidField(
            given_rates(ends),
            f"with it the motion takes {chain.joint_names[excess.joint]} to {excess.value:.6g} at {excess.time:.6g} s, "
            f"beyond its limit {excess.bound:.6g}",
        )
    return motion


def given_rates(ends: EndRates) -> str:
    """Return the field of the request that makes the ends move."""
    names = ("start_velocity", "start_acceleration", "end_velocity", "end_acceleration")
    moving = (name for name in names if np.any(getattr(ends, name)))
    return next(moving, names[0]).replace("velocity", "velocities").replace("acceleration", "accelerations")


def _motion(chain: Chain, start: Array, target: Array | None, segment: Segment, ends: EndRates) -> PiecewisePolynomial:
    limits, given = segment.limits, segment.duration
    rates = np.array([[ends.start_velocity, ends.start_acceleration], [ends.end_velocity, ends.end_acceleration]])
    if target is None:
        points = knots(start, segment.configurations, segment.times, limits.velocity)
        check_within(chain, points.positions[1:], "waypoints.{}")
        family = _Family.of_spline(points.times / points.times[-1], points.positions, segment, rates)
        given = given if segment.times is None else float(points.times[-1])
    elif segment.law == "jerk_limited":
        states = np.concatenate((np.array([start, target])[:, None], rates), axis=1)
        return jerk_limited(states[0], states[1], limits.joints, given)
    elif np.abs(target - start).max(initial=0.0) <= NO_LENGTH and not rates.any():
        return standing(start, given or 0.0)
    else:
        family = _Family.of_polynomial(start, target, LAWS[segment.law].conditions or 2, rates)
    for side, own in zip(("start", "end"), rates, strict=True):
        check_rates(side, own, limits.joints)
    return _within_limits(family, segment, ends, given)


def _within_limits(family: "_Family", segment: Segment, ends: EndRates, given: float | None) -> PiecewisePolynomial:
    """Return the motion of the least duration found, or of the given one, [s], if it keeps the limits."""
    bounds = _scaling_limits(segment)
    if given is None:
        return family.at(_least(family, bounds, ends))
    motion = family.at(given)
    bound = uniform_scaling(motion, bounds).binding
    if bound.ratio > 1.0 + _EXCESS:
        reason = f"joint {bound.joint} would reach {bound.ratio:.6g} times its limit of {bound.quantity}"
        least = _least(family, bounds, ends)
        raise InvalidField(
            "duration" if segment.times is None else "times",
            f"{reason}; {least:.10g} s keeps the limits",
        )
    return motion


def _scaling_limits(segment: Segment) -> ScalingLimits:
    limits = segment.limits
    jerk = limits.jerk if LAWS[segment.law].keeps_jerk else segment.stated_jerk
    return ScalingLimits(limits.velocity, limits.acceleration, jerk)


@dataclass(frozen=True, slots=True)
class _Family:
    """The motions of all durations through the same states.

    Attributes:
        breaks: Of λ, from 0 to 1; shape (M + 1,).
        parts: C₀, C₁ and C₂; shape (3, M, d + 1, n).
    """

    breaks: Array
    parts: Array

    @classmethod
    def of_polynomial(cls, start: Array, target: Array, conditions: int, rates: Array) -> "_Family":
        given = np.concatenate((np.array([start, target])[:, None], rates), axis=1)
        parts = []
        for k in range(3):
            ends = np.zeros((2, conditions, 1, len(start)))
            if k < conditions:
                ends[:, k, 0] = given[:, k]
            parts.append(hermite_pieces(ends[0], ends[1], np.ones(1)))
        return cls(np.array([0.0, 1.0]), np.array(parts))

    @classmethod
    def of_spline(cls, shares: Array, positions: Array, segment: Segment, rates: Array) -> "_Family":
        still, nothing = np.zeros_like(positions), np.zeros_like(rates)
        splines = []
        for k in range(3):
            (v0, a0), (v1, a1) = np.where(np.arange(1, 3)[:, None] == k, rates, nothing)
            knots_k = positions if k == 0 else still
            splines.append(cubic_spline(shares, knots_k, segment.boundary, EndRates(v0, v1, a0, a1)).motion)
        return cls(splines[0].breaks, np.array([spline.coefficients for spline in splines]))

    def at(self, duration: float) -> PiecewisePolynomial:
        """Return the motion of a duration, [s]."""
        c = np.tensordot(duration ** np.arange(3), self.parts, 1)
        return PiecewisePolynomial(duration * self.breaks, c / duration ** np.arange(c.shape[1])[:, None])

    def ratios(self, durations: Array, bounds: ScalingLimits) -> Array:
        """Return the largest ratio to a limit in each duration; shape (K,)."""
        motion = joined([self.at(duration) for duration in durations])
        found = np.zeros(len(durations))
        for order, limits in enumerate((bounds.velocity, bounds.acceleration, bounds.jerk), start=1):
            if limits is not None:
                ratios = np.abs(candidates(motion.derivative(order))[1]) / limits
                found = np.maximum(found, ratios.reshape(len(durations), -1).max(axis=1))
        return found


def _least(family: _Family, bounds: ScalingLimits, ends: EndRates) -> float:
    """Return the least duration on the grid that keeps the limits, [s]; raises InvalidField if none does."""
    rest = PiecewisePolynomial(family.breaks, family.parts[0])
    scale = uniform_scaling(rest, bounds).binding.factor
    for order, rates in enumerate(
        ((ends.start_velocity, ends.end_velocity), (ends.start_acceleration, ends.end_acceleration))
    ):
        limits = (bounds.acceleration, bounds.jerk)[order]
        if limits is not None:
            scale = max(scale, float((np.abs(rates).sum(axis=0) / limits).max()))
    durations = np.geomspace(_SHORTEST * scale, _LONGEST * scale, _DURATIONS)
    for _ in range(_ZOOMS):
        good = np.flatnonzero(family.ratios(durations, bounds) <= 1.0 + _EXCESS)
        if len(good) == 0:
            reason = "no duration was found that keeps the limits: take smaller values, or the law `jerk_limited`"
            raise InvalidField(given_rates(ends), reason)
        i = int(good[0])
        least = float(durations[i])
        durations = np.linspace(durations[max(i - 1, 0)], least, _REFINED)
    return least
