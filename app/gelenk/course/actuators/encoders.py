"""Shaft encoders: the angle of a count, and the encoder that a resolution requires.

An incremental encoder has two channels, A and B, a quarter of a line apart; a counter registers one, two or four counts
per line (x1, x2, x4). An absolute encoder reads a code of `bits` digits from as many tracks. Both sit on the motor, so
a count at the load is 1/N of the angle that it is at the motor.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, tex

Decoding: TypeAlias = Literal["x1", "x2", "x4"]

COUNTS_A_LINE: dict[str, int] = {"x1": 1, "x2": 2, "x4": 4}

TURN = 2.0 * math.pi
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class Scale:
    """Resolution of an encoder with a given number of counts per motor turn.

    Attributes:
        counts_per_revolution: Counts per turn of the motor.
        gear_ratio: N = ω_motor / ω_load > 0.
    """

    counts_per_revolution: int
    gear_ratio: float

    @property
    def motor_resolution(self) -> float:
        """Motor angle per count, 2π over the counts, [rad]."""
        return TURN / self.counts_per_revolution

    @property
    def load_resolution(self) -> float:
        """Load angle per count, [rad]."""
        return self.motor_resolution / self.gear_ratio

    def velocity_quantum(self, sample_period: float) -> float:
        """Return 2π / (counts · T_s), the motor speed [rad/s] of one count per sample period T_s [s]."""
        return self.motor_resolution / sample_period

    def count_rate(self, angular_velocity: float) -> float:
        """Return the counts per second at a speed of the motor, [rad/s]."""
        return self.counts_per_revolution * abs(angular_velocity) / TURN


@dataclass(frozen=True, slots=True)
class Required:
    """The coarsest encoder that resolves an angle at the load.

    Attributes:
        motor_resolution: That angle at the motor, [rad].
        counts_per_revolution: Counts per turn of the motor, rounded up.
        bits: Bits of an absolute encoder.
        pulses_per_revolution: Lines of an incremental encoder.
    """

    motor_resolution: float
    counts_per_revolution: int
    bits: int
    pulses_per_revolution: int


def required(resolution: float, gear_ratio: float, decoding: Decoding) -> Required:
    """Compute the encoder needed for a resolution at the load, [rad].

    A quotient within rounding of a whole number counts as that number: 0.01° needs 36000 counts, not 36001.
    """
    exact = TURN / (resolution * gear_ratio)
    counts = max(1, math.ceil(exact * (1.0 - _ROUNDING)))
    return Required(
        resolution * gear_ratio, counts, max(1, (counts - 1).bit_length()), -(-counts // COUNTS_A_LINE[decoding])
    )


def scale_steps(scale: Scale, how: str) -> tuple[Step, ...]:
    """Return the worked resolution; `how` is the formula for the counts per turn."""
    degrees = 360.0 / scale.counts_per_revolution
    at_load = rf"{tex(degrees)}^\circ / {tex(scale.gear_ratio)} = {tex(degrees / scale.gear_ratio)}^\circ"
    return (
        Step(
            "Resolution",
            "A turn divided by its counts; behind a gear the load turns less for each.",
            (
                rf"n = {how} = {scale.counts_per_revolution}",
                rf"\Delta\varphi_m = \frac{{360^\circ}}{{n}} = {tex(degrees)}^\circ",
                rf"\Delta\varphi_L = \frac{{\Delta\varphi_m}}{{N}} = {at_load}",
            ),
        ),
    )


def required_step(found: Required, decoding: Decoding) -> Step:
    """Return the worked solution for the coarsest encoder."""
    n, lines = found.counts_per_revolution, COUNTS_A_LINE[decoding]
    return Step(
        "Encoder needed",
        "The resolution wanted at the load is N times as coarse at the motor; counts, bits and lines are rounded up.",
        (
            rf"\Delta\varphi_m = N\,\Delta\varphi_L = {tex(math.degrees(found.motor_resolution))}^\circ",
            rf"n = \left\lceil \frac{{360^\circ}}{{\Delta\varphi_m}} \right\rceil = {n}",
            rf"\lceil \log_2 {n} \rceil = {found.bits}\ \mathrm{{bit}}",
            rf"\lceil {n} / {lines} \rceil = {found.pulses_per_revolution}\ \mathrm{{lines}}",
        ),
    )
