"""Quadrature decoding: the counts and the direction in a sequence of samples of channels A and B.

Forward, A leads B: 00 → 10 → 11 → 01 → 00, written as AB. At most one channel may change between two samples. If both
change, a sample was missed: the shaft has moved by two quarters of a line, in an unknown direction.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.actuators.encoders import TURN, Decoding
from gelenk.course.steps import Step, step, tex
from gelenk.errors import InvalidField, counted
from gelenk.language import translated as _
from gelenk.robot.arrays import Flags, Indices
from gelenk.robot.result import Result

Direction: TypeAlias = Literal["forward", "backward", "none"]

_SEPARATORS = re.compile(r"[\s,;]+")
_SHOWN = 12

# Quarter of a line for each state 2 A + B: 00, 10, 11 and 01 are quarters 0, 1, 2 and 3.
_QUARTER = np.array([0, 3, 1, 2])


@dataclass(frozen=True, slots=True)
class Samples:
    """States 2 A + B of each sample, and its Z, or None if that was not read; shape (S,) each."""

    states: Indices
    index: Flags | None


def read_samples(text: str, field: str) -> Samples:
    """Parse samples such as "00 10 11 01", or "001 100 110" with the index channel Z as a third digit.

    Spaces, commas or semicolons separate them. Raises InvalidField, which names `field`, for no sample, other
    characters, or samples of different lengths.
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
    for number, group in enumerate(groups):
        if len(group) not in {2, 3} or not set(group) <= {"0", "1"}:
            shown = "".join(c if c.isprintable() else "�" for c in group[:_SHOWN])
            return f"sample {number} is {shown!r}; it is A and B, or A, B and Z, each 0 or 1"
        if len(group) != width:
            return f"sample {number} has {counted(len(group), 'digit')}, the first one has {width}"
    raise AssertionError("one of them is at fault")


@dataclass(frozen=True, slots=True)
class IndexPulse(Result):
    """A rise of channel Z: the shaft is at the same angle each time.

    Attributes:
        sample: Sample at which it rises, from 0.
        count: The count there, no unit.
        count_error: How far the count since the first pulse is from whole turns: counts that were lost, or the width of
            the pulse where the direction has changed. No unit; null without `pulses_per_revolution`.
    """

    sample: int
    count: int
    count_error: int | None


@dataclass(frozen=True, slots=True)
class Quadrature(Result):
    """Motion decoded from the samples of A and B.

    Attributes:
        count: Of the last sample, from 0 at the first one; no unit.
        counts: At each sample, no unit.
        direction: Of the count.
        reversals: How often the motion changes its direction.
        illegal_transitions: Samples, from 0, at which both channels have changed: a sample between was missed, and two
            quarters of a line in an unknown direction are lost. They count nothing.
        motor_angle: Since the first sample, [rad]; null without lines.
        load_angle: The same at the load, [rad].
        motor_angle_in_turn: motor_angle in [0, 2π), [rad].
        register_value: Of a counter of `counter_bits`, no unit; null without them.
        index_pulses: Of channel Z; none where it was not read.
        count_from_index: Count since the last index pulse: from here on the angle is absolute. No unit; null without
            one.
    """

    count: int
    counts: list[int]
    direction: Direction
    reversals: int
    illegal_transitions: list[int]
    motor_angle: float | None
    load_angle: float | None
    motor_angle_in_turn: float | None
    register_value: int | None
    index_pulses: list[IndexPulse]
    count_from_index: int | None


def decoded(
    samples: Samples,
    decoding: Decoding,
    counts_per_revolution: int | None = None,
    gear_ratio: float = 1.0,
    counter_bits: int | None = None,
) -> Quadrature:
    """Decode the counts, direction and faults of a sequence of samples.

    x4 counts each change of a channel, x2 those of A, x1 only the edge of A between 00 and 10, up when it rises and
    down when it falls there: so a shaft that trembles on an edge counts up and down without drifting. An illegal change
    counts nothing.

    Args:
        counts_per_revolution: Counts per turn of the encoder, for angles and to check the index pulses.
        gear_ratio: N = ω_motor / ω_load > 0.
        counter_bits: Width of a counter, which wraps from 2^bits - 1 to 0, and from 0 to 2^bits - 1.
    """
    quarters = _QUARTER[samples.states]
    moved = (np.diff(quarters) + 1) % 4 - 1
    illegal = np.flatnonzero(moved == 2) + 1
    moved[moved == 2] = 0
    lower = np.where(moved > 0, quarters[:-1], quarters[1:])
    counting = {"x4": moved, "x2": np.where(lower % 2 == 0, moved, 0), "x1": np.where(lower == 0, moved, 0)}[decoding]
    counts = np.concatenate(([0], np.cumsum(counting))).tolist()
    count, cpr = counts[-1], counts_per_revolution
    angle = None if cpr is None else TURN * count / cpr
    pulses = [] if samples.index is None else _pulses(samples.index, counts, cpr)
    return Quadrature(
        count,
        counts,
        "none" if count == 0 else "forward" if count > 0 else "backward",
        int(np.count_nonzero(np.diff(moved[moved != 0]))),
        illegal.tolist(),
        angle,
        None if angle is None else angle / gear_ratio,
        None if cpr is None else TURN * (count % cpr) / cpr,
        None if counter_bits is None else count % (1 << counter_bits),
        pulses,
        count - pulses[-1].count if pulses else None,
    )


def decoding_step(found: Quadrature, counts_per_revolution: int | None = None) -> Step:
    """Return the worked decoding: which way it counts, the counts, the angle."""
    text = _(
        "A leads B in one direction, and B leads A in the other. x4 counts each change of a channel, x2 those of A, "
        "x1 those of A while B is 0."
    )
    if found.illegal_transitions:
        text += " " + _("Where both channels change at once, a sample was missed: it counts nothing.")
    shown = ", ".join(map(str, found.counts[:_SHOWN])) + (r",\ \dots" if len(found.counts) > _SHOWN else "")
    lines = [r"00 \to 10 \to 11 \to 01 \to 00:\ +1", rf"z = ({shown}),\quad z_{{end}} = {found.count}"]
    if counts_per_revolution is not None:
        degrees = rf"{tex(360.0 * found.count / counts_per_revolution)}^\circ"
        lines.append(rf"\varphi_m = z_{{end}} \cdot \frac{{360^\circ}}{{{counts_per_revolution}}} = {degrees}")
    return step(_("Decoding"), text, *lines)


def _pulses(index: Flags, counts: Sequence[int], counts_per_revolution: int | None) -> list[IndexPulse]:
    rises = np.flatnonzero(np.diff(index.astype(np.int64), prepend=0) > 0).tolist()
    pulses = []
    for sample in rises:
        count, error = counts[sample], None
        if counts_per_revolution is not None:
            since, half = count - counts[rises[0]], counts_per_revolution // 2
            error = (since + half) % counts_per_revolution - half
        pulses.append(IndexPulse(sample, count, error))
    return pulses
