"""Quadrature decoding: the counts and the direction in a sequence of samples of channels A and B.

Forward, A leads B: 00 → 10 → 11 → 01 → 00, written as AB. At most one channel may change between two samples. If both
change, a sample was missed: the shaft has moved by two quarters of a line, in an unknown direction.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.actuators.encoders import Decoding
from gelenk.errors import InvalidField, counted
from gelenk.robot.arrays import Flags, Indices

Direction: TypeAlias = Literal["forward", "backward", "none"]

_SEPARATORS = re.compile(r"[\s,;]+")
_SHOWN = 12

# Quarter of a line for each state 2 A + B: 00, 10, 11 and 01 are quarters 0, 1, 2 and 3.
_QUARTER = np.array([0, 3, 1, 2])


@dataclass(frozen=True, slots=True)
class Samples:
    """Samples read from the channels.

    Attributes:
        states: 2 A + B of each sample; shape (S,).
        index: Z of each sample; shape (S,), or None if it was not read.
    """

    states: Indices
    index: Flags | None


def read_samples(text: str, field: str) -> Samples:
    """Parse samples such as "00 10 11 01", or "001 100 110" with the index channel Z as a third digit.

    Args:
        text: One group of digits per sample, separated by spaces, commas or semicolons.
        field: Name of the field in an error.

    Raises:
        InvalidField: The text has no sample, other characters, or samples of different lengths.
    """
    groups = [group for group in _SEPARATORS.split(text) if group]
    if not groups:
        raise InvalidField(field, 'no sample; it holds groups such as "00 10 11 01"')
    width, together = len(groups[0]), "".join(groups)
    if width not in {2, 3} or set(map(len, groups)) != {width} or not set(together) <= {"0", "1"}:
        raise InvalidField(field, _fault(groups, width))
    digits = np.frombuffer(together.encode(), np.uint8).reshape(-1, width) == ord("1")
    return Samples(2 * digits[:, 0].astype(np.int64) + digits[:, 1], digits[:, 2] if width == 3 else None)


def _fault(groups: Sequence[str], width: int) -> str:
    """Describe what is wrong with the first invalid group."""
    for number, group in enumerate(groups):
        if len(group) not in {2, 3} or not set(group) <= {"0", "1"}:
            shown = "".join(c if c.isprintable() else "�" for c in group[:_SHOWN])
            return f"sample {number} is {shown!r}; it is A and B, or A, B and Z, each 0 or 1"
        if len(group) != width:
            return f"sample {number} has {counted(len(group), 'digit')}, the first one has {width}"
    raise AssertionError("one of them is at fault")


@dataclass(frozen=True, slots=True)
class IndexPulse:
    """A rise of channel Z, once a turn.

    Attributes:
        sample: Index of the sample where Z rises.
        count: Count at that sample.
        count_error: Deviation of the count since the first pulse from whole turns; None if a turn is unknown.
    """

    sample: int
    count: int
    count_error: int | None


@dataclass(frozen=True, slots=True)
class Decoded:
    """The result of decoding samples.

    Attributes:
        counts: Count at each sample, since the first one; shape (S,).
        direction: Overall direction, by the last count.
        reversals: Number of changes of direction.
        illegal: Samples at which both channels have changed; shape (K,).
        pulses: Rises of channel Z, in order.
    """

    counts: Indices
    direction: Direction
    reversals: int
    illegal: Indices
    pulses: tuple[IndexPulse, ...]


def decoded(samples: Samples, decoding: Decoding, counts_per_revolution: int | None) -> Decoded:
    """Decode the counts, direction and faults of a sequence of samples.

    x4 counts each change of a channel, x2 those of A, x1 only the edge of A between 00 and 10, up when it rises and
    down when it falls there: so a shaft that trembles on an edge counts up and down without drifting. An illegal change
    counts nothing.

    Args:
        samples: Samples of the channels.
        decoding: Which changes count.
        counts_per_revolution: Counts per turn of the encoder, to check the index pulses.
    """
    quarters = _QUARTER[samples.states]
    moved = (np.diff(quarters) + 1) % 4 - 1
    illegal = np.flatnonzero(moved == 2) + 1
    moved[moved == 2] = 0
    before, after = quarters[:-1], quarters[1:]
    lower = np.where(moved > 0, before, after)
    counted = {"x4": moved, "x2": np.where(lower % 2 == 0, moved, 0), "x1": np.where(lower == 0, moved, 0)}[decoding]
    counts = np.concatenate(([0], np.cumsum(counted)))
    moving = moved[moved != 0]
    reversals = int(np.count_nonzero(np.diff(moving)))
    pulses = _pulses(samples.index, counts, counts_per_revolution)
    direction: Direction = "none" if counts[-1] == 0 else "forward" if counts[-1] > 0 else "backward"
    return Decoded(counts, direction, reversals, illegal, pulses)


def _pulses(index: Flags | None, counts: Indices, counts_per_revolution: int | None) -> tuple[IndexPulse, ...]:
    if index is None:
        return ()
    rises = np.flatnonzero(np.diff(index.astype(np.int64), prepend=0) > 0)
    pulses = []
    for sample in rises.tolist():
        count, error = int(counts[sample]), None
        if counts_per_revolution is not None:
            since, half = count - int(counts[rises[0]]), counts_per_revolution // 2
            error = (since + half) % counts_per_revolution - half
        pulses.append(IndexPulse(sample, count, error))
    return tuple(pulses)


def register(count: int, bits: int) -> int:
    """Return what a counter with a number of bits shows: it wraps from 2^bits - 1 to 0, and from 0 to 2^bits - 1."""
    return count % (1 << bits)
