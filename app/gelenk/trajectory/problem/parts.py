"""A part of a trajectory, from rest to rest: one segment, or lines blended into one path."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.audit.words import StopReason
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem.problem import SegmentReport
from gelenk.trajectory.problem.result import TimingComparison


@dataclass(frozen=True, slots=True)
class Halt:
    """Why a part could not be completed.

    Attributes:
        reason: Kind of reason.
        segment: Index of the segment that could not be completed, from 0.
        share: Completed fraction of that segment, from 0 to 1.
        position: Position of the tip at which the path could not continue; shape (3,), [m].
        joint: Joint that is at its limit, if any.
        detail: Explanation in a sentence.
    """

    reason: StopReason
    segment: int
    share: float
    position: Array
    joint: str | None
    detail: str


@dataclass(frozen=True, slots=True)
class PlannedPart:
    """A part of a trajectory, as far as it could be completed.

    Attributes:
        motion: Joint motion, starting at 0 s; one piece of zero duration if nothing moves.
        reports: Reports of the segments that were started; their times count from the start of the part.
        demands: Requirements that the motion has to meet.
        halt: Why the part ends early; None if it is complete.
        timing: Comparison of timings, if requested.
    """

    motion: PiecewisePolynomial
    reports: tuple[SegmentReport, ...]
    demands: Demands
    halt: Halt | None = None
    timing: TimingComparison | None = None

    def slowed(self, factor: float) -> "PlannedPart":
        """Return the part slowed down to `factor` times its duration."""
        if factor == 1.0:
            return self
        return replace(
            self,
            motion=self.motion.scaled(factor),
            reports=tuple(report.slowed(factor) for report in self.reports),
            demands=_slowed_demands(self.demands, factor),
        )

    def noted(self, notes: tuple[str, ...]) -> "PlannedPart":
        """Return the part with further notes on all of its segments."""
        if not notes:
            return self
        return replace(self, reports=tuple(replace(one, notes=(*one.notes, *notes)) for one in self.reports))

    def moved(self, start: float) -> tuple[SegmentReport, ...]:
        """Return the reports of its segments for a part that begins at `start`, [s]."""
        return tuple(report.moved(start) for report in self.reports)


def standing(configuration: Array, duration: float = 0.0) -> PiecewisePolynomial:
    """Return joints that stand still at a configuration of shape (n,) for a duration, [s]."""
    return PiecewisePolynomial(np.array([0.0, duration]), configuration[None, None].copy())


@contextmanager
def in_field(field: str) -> Iterator[None]:
    """Name the part of the request in refusals of its fields."""
    try:
        yield
    except InvalidField as error:
        raise InvalidField(f"{field}.{error.field}", error.reason) from error


def _slowed_demands(demands: Demands, factor: float) -> Demands:
    zones = tuple(replace(one, begin=factor * one.begin, end=factor * one.end) for one in demands.zones)
    path = None if demands.path is None else _slowed(demands.path, factor)
    return replace(demands, path=path, zones=zones)


def _slowed(path: Callable[[Array], Poses], factor: float) -> Callable[[Array], Poses]:
    return lambda times: path(times / factor)
