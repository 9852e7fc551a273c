"""A part of a trajectory: from rest to rest, of one segment or of lines that are blended."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.poses import Poses
from gelenk.trajectory.audit_demands import Demands
from gelenk.trajectory.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem import SegmentReport, TimingComparison
from gelenk.trajectory.words import StopReason


@dataclass(frozen=True, slots=True)
class Halt:
    """Why a part could not be done wholly.

    Attributes:
        reason: Of what kind.
        segment: Which one could not be done, from 0.
        share: Of it that was done, from 0 to 1.
        position: Of the tip, where it could not go on; shape (3,), [m].
        joint: Which one is at its limit.
        detail: In a sentence.
    """

    reason: StopReason
    segment: int
    share: float
    position: Array
    joint: str | None
    detail: str


@dataclass(frozen=True, slots=True)
class Part:
    """A part of a trajectory, as far as it could be done.

    Attributes:
        motion: Of the joints, from 0 s on; of one piece that takes no time where nothing moves.
        reports: Of its segments, as far as they were started; times from 0 s on.
        demands: What the motion has to keep to.
        halt: Why it ends early; None where it is whole.
        timing: If requested.
    """

    motion: PiecewisePolynomial
    reports: tuple[SegmentReport, ...]
    demands: Demands
    halt: Halt | None = None
    timing: TimingComparison | None = None

    def slowed(self, factor: float) -> "Part":
        """The same in `factor` times the time."""
        if factor == 1.0:
            return self
        return replace(
            self,
            motion=self.motion.scaled(factor),
            reports=tuple(report.slowed(factor) for report in self.reports),
            demands=_slowed_demands(self.demands, factor),
        )

    def noted(self, notes: tuple[str, ...]) -> "Part":
        """The same with further notes on its segments."""
        if not notes:
            return self
        return replace(self, reports=tuple(replace(one, notes=(*one.notes, *notes)) for one in self.reports))

    def moved(self, start: float) -> tuple[SegmentReport, ...]:
        """Its segments, the part beginning at a time, [s]."""
        return tuple(report.moved(start) for report in self.reports)


def standing(configuration: Array) -> PiecewisePolynomial:
    """Joints that stand still, for no time."""
    return PiecewisePolynomial(np.zeros(2), configuration[None, None, :].copy())


def _slowed_demands(demands: Demands, factor: float) -> Demands:
    stretches = tuple(replace(one, begin=factor * one.begin, end=factor * one.end) for one in demands.stretches)
    path = None if demands.path is None else _slowed(demands.path, factor)
    return replace(demands, path=path, stretches=stretches)


def _slowed(path: Callable[[Array], Poses], factor: float) -> Callable[[Array], Poses]:
    return lambda times: path(times / factor)
