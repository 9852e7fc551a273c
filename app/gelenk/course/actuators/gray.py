"""Gray code of an absolute encoder: neighbours, including the last and the first, differ in a single track.

A sensor that reads between two positions then shows one of the two, never a third. Encoding is g = b ⊕ (b ≫ 1); to
decode, each binary digit is the exclusive or of all Gray digits from the left up to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.actuators.encoders import TURN
from gelenk.course.steps import Step, step, tex
from gelenk.errors import InvalidField, counted
from gelenk.language import translated as _
from gelenk.robot.result import Result

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
