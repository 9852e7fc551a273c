"""Gray code of an absolute encoder: neighbours, the last and the first included, differ in a single track.

A sensor that reads between two positions then shows one of the two, never a third. g = b ⊕ (b ≫ 1); back, each binary
digit is the exclusive or of all Gray digits from the left up to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.encoders import TURN
from gelenk.course.steps import Step
from gelenk.model.errors import InvalidField, counted

Code: TypeAlias = Literal["gray", "binary"]

MOST_TABLE_BITS = 8


def gray(value: int) -> int:
    """The Gray code of a number ≥ 0."""
    return value ^ (value >> 1)


def binary(code: int) -> int:
    """The number ≥ 0 of a Gray code."""
    value, shift = code, 1
    while code >> shift:
        value ^= code >> shift
        shift += 1
    return value


@dataclass(frozen=True, slots=True)
class Position:
    """A position of the disc.

    Attributes:
        value: Its number, from 0.
        binary: In binary digits.
        gray: In Gray code.
        angle: Of the motor, [rad] in [0, 2π).
    """

    value: int
    binary: str
    gray: str
    angle: float


def position(value: int, bits: int) -> Position:
    """The position of a number below 2^bits."""
    return Position(value, f"{value:0{bits}b}", f"{gray(value):0{bits}b}", TURN * value / (1 << bits))


def table(bits: int) -> tuple[Position, ...]:
    """All positions of a disc of at most `MOST_TABLE_BITS` tracks."""
    return tuple(position(value, bits) for value in range(1 << bits))


def read_codes(codes: Sequence[str], code: Code, bits: int, field: str) -> tuple[Position, ...]:
    """The positions of codes as they were read, the most significant digit first.

    Raises:
        InvalidField: One has other characters than 0 and 1, or not `bits` of them.
    """
    found = []
    for number, text in enumerate(codes):
        if len(text) != bits or not set(text) <= {"0", "1"}:
            raise InvalidField(f"{field}/{number}", f"a reading is {counted(bits, 'digit')}, each 0 or 1, one a track")
        digits = int(text, 2)
        found.append(position(binary(digits) if code == "gray" else digits, bits))
    return tuple(found)


def unwrapped(values: Sequence[int], bits: int) -> list[int]:
    """Numbers that go on across the end of a turn: each step is taken the shorter way round.

    A step of exactly half a turn counts as backward.
    """
    turn, half = 1 << bits, 1 << (bits - 1)
    result: list[int] = []
    for value in values:
        last = result[-1] if result else value
        result.append(last + (value - last + half) % turn - half)
    return result


def code_step(example: Position) -> Step:
    """The code of one position, worked."""
    return Step(
        "Gray code",
        "Each digit is compared with its left neighbour: equal gives 0, different gives 1.",
        (
            r"g = b \oplus (b \gg 1)",
            rf"b = {example.binary}_2 = {example.value},\quad g = {example.gray}",
        ),
    )
