"""Shaft encoders: the angle of a count, and the encoder that a resolution requires.

An incremental encoder has two channels, A and B, a quarter of a line apart; a counter registers one, two or four counts
per line (x1, x2, x4). An absolute encoder reads a code of `bits` digits from as many tracks. Both sit on the motor, so
a count at the load is 1/N of the angle that it is at the motor.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step, tex
from gelenk.language import translated as _
from gelenk.robot.result import Result

Decoding: TypeAlias = Literal["x1", "x2", "x4"]

COUNTS_A_LINE: dict[str, int] = {"x1": 1, "x2": 2, "x4": 4}

TURN = 2.0 * math.pi
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class EncoderResolution(Result):
    """Size of one count.

    Attributes:
        counts_per_revolution: Of the motor, no unit.
        motor: Angle of a count at the motor, [rad].
        load: Angle of a count at the load, [rad].
        motor_velocity_quantum: 2π / (counts · T_s): one count more in a sample period, at the motor, [rad/s]; null
            without T_s.
        load_velocity_quantum: The same at the load, [rad/s].
        count_rate: Counts per second at the given speed, [1/s]; null without one.
    """

    counts_per_revolution: int
    motor: float
    load: float
    motor_velocity_quantum: float | None
    load_velocity_quantum: float | None
    count_rate: float | None


def resolution(
    counts: int, gear_ratio: float, sample_period: float | None = None, motor_velocity: float | None = None
) -> EncoderResolution:
    """Compute the resolution of `counts` per turn of the motor; `sample_period` in [s], `motor_velocity` in [rad/s]."""
    motor = TURN / counts
    quantum = None if sample_period is None else motor / sample_period
    return EncoderResolution(
        counts,
        motor,
        motor / gear_ratio,
        quantum,
        None if quantum is None else quantum / gear_ratio,
        _count_rate(counts, motor_velocity),
    )


def _count_rate(counts: int, motor_velocity: float | None) -> float | None:
    return None if motor_velocity is None else counts * abs(motor_velocity) / TURN


@dataclass(frozen=True, slots=True)
class RequiredEncoder(Result):
    """The coarsest encoder with the wanted resolution.

    Attributes:
        motor_resolution: The wanted resolution at the motor, [rad].
        counts_per_revolution: Of the motor, no unit.
        bits: Of an absolute encoder, no unit.
        pulses_per_revolution: Lines of an incremental one with this decoding, no unit.
        count_rate: With exactly these counts, at the given speed, [1/s]; null without one.
    """

    motor_resolution: float
    counts_per_revolution: int
    bits: int
    pulses_per_revolution: int
    count_rate: float | None


def required(
    load_resolution: float, gear_ratio: float, decoding: Decoding, motor_velocity: float | None = None
) -> RequiredEncoder:
    """Compute the encoder needed for a resolution at the load, [rad].

    A quotient within rounding of a whole number counts as that number: 0.01° needs 36000 counts, not 36001.
    """
    motor = load_resolution * gear_ratio
    counts = max(1, math.ceil(TURN / motor * (1.0 - _ROUNDING)))
    bits, lines = max(1, (counts - 1).bit_length()), -(-counts // COUNTS_A_LINE[decoding])
    return RequiredEncoder(motor, counts, bits, lines, _count_rate(counts, motor_velocity))


def resolution_steps(counts: int, gear_ratio: float, how: str, sample_period: float | None = None) -> tuple[Step, ...]:
    """Return the worked resolution, with the velocity of a count if T_s is given; `how` is the formula for counts."""
    degrees = 360.0 / counts
    at_load = rf"{tex(degrees)}^\circ / {tex(gear_ratio)} = {tex(degrees / gear_ratio)}^\circ"
    angle = step(
        _("Resolution"),
        _("A turn divided by its counts; behind a gear the load turns less for each."),
        rf"n = {how} = {counts}",
        rf"\Delta\varphi_m = \frac{{360^\circ}}{{n}} = {tex(degrees)}^\circ",
        rf"\Delta\varphi_L = \frac{{\Delta\varphi_m}}{{N}} = {at_load}",
    )
    if sample_period is None:
        return (angle,)
    quotient = rf"\frac{{2\pi}}{{{counts} \cdot {tex(sample_period)}}} = {tex(TURN / counts / sample_period, 'rad/s')}"
    text = _("Speed as counts in a sample period is a multiple of one count in one period.")
    velocity = step(_("Velocity quantum"), text, rf"\Delta\omega = \frac{{2\pi}}{{n\,T_s}} = {quotient}")
    return angle, velocity


def required_step(found: RequiredEncoder, decoding: Decoding) -> Step:
    """Return the worked solution for the coarsest encoder."""
    n, lines = found.counts_per_revolution, COUNTS_A_LINE[decoding]
    return step(
        _("Encoder needed"),
        _(
            "The resolution wanted at the load is N times as coarse at the motor; counts, bits and lines are "
            "rounded up."
        ),
        rf"\Delta\varphi_m = N\,\Delta\varphi_L = {tex(math.degrees(found.motor_resolution))}^\circ",
        rf"n = \left\lceil \frac{{360^\circ}}{{\Delta\varphi_m}} \right\rceil = {n}",
        rf"\lceil \log_2 {n} \rceil = {found.bits}\ \mathrm{{bit}}",
        rf"\lceil {n} / {lines} \rceil = {found.pulses_per_revolution}\ \mathrm{{{_('lines')}}}",
    )
