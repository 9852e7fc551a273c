"""Gray code of an absolute encoder: neighbours, including the last and the first, differ in a single track.

A sensor that reads between two positions then shows one of the two, never a third. Encoding is g = b ⊕ (b ≫ 1); to
decode, each binary digit is the exclusive or of all Gray digits from the left up to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.actuators.encoders import TURN
from gelenk.course.steps import Step, step
from gelenk.errors import InvalidField, counted
from gelenk.language import translated as _
from gelenk.robot.result import Result

Code: TypeAlias = Literal["gray", "binary"]

MOST_TABLE_BITS = 8


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


def code_step(example: DiscPosition) -> Step:
    """Return the worked code of one position."""
    return step(
        _("Gray code"),
        _("Each digit is compared with its left neighbour: equal gives 0, different gives 1."),
        r"g = b \oplus (b \gg 1)",
        rf"b = {example.binary}_2 = {example.value},\quad g = {example.gray}",
    )
