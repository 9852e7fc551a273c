"""Shaft encoders: the angle of a count, and the encoder that a resolution requires.

An incremental encoder has two channels, A and B, a quarter of a line apart; a counter registers one, two or four counts
per line (x1, x2, x4). An absolute encoder reads a code of `bits` digits from as many tracks. Both sit on the motor, so
a count at the load is 1/N of the angle that it is at the motor.

In Gray code neighbours, including the last and the first, differ in a single track. A sensor that reads between two
positions then shows one of the two, never a third. Encoding is g = b ⊕ (b ≫ 1); to decode, each binary digit is the
exclusive or of all Gray digits from the left up to it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step, tex
from gelenk.errors import InvalidField, counted
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


Code: TypeAlias = Literal["gray", "binary"]

MOST_TABLE_BITS = 8
_MOST_SHOWN = 100
"""Number of readings, and of values, that are worked out."""


def gray(value: int) -> int:
    """Return the Gray code of a number ≥ 0."""
    return value ^ (value >> 1)


def binary(code: int) -> int:
    """Return the number ≥ 0 that a Gray code stands for."""
    value, shift = code, 1
    while code >> shift:
        value ^= code >> shift
        shift += 1
    return value


@dataclass(frozen=True, slots=True)
class DiscPosition(Result):
    """A position of an absolute encoder.

    Attributes:
        value: Number of the position, no unit.
        binary: In binary digits.
        gray: In Gray code.
        angle: Of the motor, in [0, 2π), [rad].
    """

    value: int
    binary: str
    gray: str
    angle: float


def position(value: int, bits: int) -> DiscPosition:
    """Return the position of a number below 2^bits."""
    return DiscPosition(value, f"{value:0{bits}b}", f"{gray(value):0{bits}b}", TURN * value / (1 << bits))


def table(bits: int) -> tuple[DiscPosition, ...]:
    """Return all positions of a disc with at most `MOST_TABLE_BITS` tracks."""
    return tuple(position(value, bits) for value in range(1 << bits))


def read_codes(codes: Sequence[str], code: Code, bits: int, field: str) -> tuple[DiscPosition, ...]:
    """Decode readings, most significant digit first; raises InvalidField if one is not `bits` digits of 0 and 1."""
    found = []
    for number, text in enumerate(codes):
        if len(text) != bits or not set(text) <= {"0", "1"}:
            raise InvalidField(
                f"{field}/{number}", f"a reading is {counted(bits, 'digit')}, each 0 or 1, one per track"
            )
        digits = int(text, 2)
        found.append(position(binary(digits) if code == "gray" else digits, bits))
    return tuple(found)


def unwrapped(values: Sequence[int], bits: int) -> list[int]:
    """Continue numbers across the end of a turn by the shorter rotation; exactly half a turn counts as backward."""
    turn, half = 1 << bits, 1 << (bits - 1)
    result: list[int] = []
    for value in values:
        last = result[-1] if result else value
        result.append(last + (value - last + half) % turn - half)
    return result


def reading_step(readings: Sequence[DiscPosition], code: Code, bits: int) -> Step:
    """Return how readings are decoded, one a line, the first ones of many."""
    text, rule = _("The digits are the number of the position in binary."), []
    if code == "gray":
        text = _("Each binary digit is the exclusive or of all Gray digits from the left up to it.")
        rule = [r"b_i = g_{n-1} \oplus \cdots \oplus g_i"]
    lines = [
        (rf"g = {one.gray}:\quad " if code == "gray" else "") + f"{_number(one)},"
        rf"\quad \vartheta = \frac{{{one.value}}}{{2^{{{bits}}}}} \cdot 2\pi = {tex(one.angle, 'rad')}"
        for one in readings[:_MOST_SHOWN]
    ]
    return step(_("Decoding of the readings"), text + _more(readings), *rule, *lines)


def code_step(values: Sequence[DiscPosition]) -> Step:
    """Return how numbers are encoded, one a line, the first ones of many."""
    text = _("Each digit is compared with its left neighbour: equal gives 0, different gives 1.")
    lines = [rf"{_number(one)},\quad g = {one.gray}" for one in values[:_MOST_SHOWN]]
    return step(_("Gray code"), text + _more(values), r"g = b \oplus (b \gg 1)", *lines)


def _number(one: DiscPosition) -> str:
    return f"b = {one.binary}_2 = {one.value}"


def _more(positions: Sequence[DiscPosition]) -> str:
    if len(positions) <= _MOST_SHOWN:
        return ""
    return " " + _("Shown are the first {shown} of {count}.").format(shown=_MOST_SHOWN, count=len(positions))
