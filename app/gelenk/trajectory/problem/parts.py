"""A part of a trajectory, from rest to rest: one segment, or several blended into one path."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.demands import Demands, Zone
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.problem.problem import SegmentReport
from gelenk.trajectory.problem.result import PlanningFailure, TimingComparison

_MOMENT = 1e-9
"""Duration that stands for zero in an audit, [s]."""


@dataclass(frozen=True, slots=True)
class PlannedPart:
    """A part of a trajectory, as far as it could be completed.

    Attributes:
        motion: Joint motion, starting at 0 s; one piece of zero duration if nothing moves.
        reports: Of the segments that were started; their times count from the start of the part.
        share: Completed fraction of its last segment, from 0 to 1.
        law: s(t) along a path of the tip, [m or rad], from its start; None of a motion of the joints.
    """

    motion: PiecewisePolynomial
    reports: tuple[SegmentReport, ...]
    demands: Demands
    failure: PlanningFailure | None = None
    share: float = 1.0
    timing: TimingComparison | None = None
    law: PiecewisePolynomial | None = None

    def stretches(self) -> Iterator[tuple[PiecewisePolynomial, Zone]]:
        """Yield the whole motion with the limits that it has everywhere, and each zone's part of it with its own."""
        demands, motion = self.demands, self.motion
        yield motion, Zone(0.0, motion.duration, demands.tip, None, demands.torque, demands.stated_jerk)
        for zone in demands.zones:
            yield motion.between(zone.begin, zone.end), zone

    def slowed(self, factor: float) -> "PlannedPart":
        """Return the part slowed down to `factor` times its duration."""
        if factor == 1.0:
            return self
        path = self.demands.path
        zones = tuple(one.between(factor * one.begin, factor * one.end) for one in self.demands.zones)
        slower = None if path is None else lambda times: path(times / factor)
        return replace(
            self,
            motion=self.motion.scaled(factor),
            reports=tuple(report.retimed(factor) for report in self.reports),
            demands=replace(self.demands, path=slower, zones=zones),
            law=None if self.law is None else self.law.scaled(factor),
        )

    def noted(self, notes: tuple[str, ...]) -> "PlannedPart":
        """Return the part with further notes on all of its segments."""
        if not notes:
            return self
        return replace(self, reports=tuple(replace(one, notes=(*one.notes, *notes)) for one in self.reports))


def standing(configuration: Array, duration: float = 0.0) -> PiecewisePolynomial:
    """Return joints that stand still at a configuration of shape (n,) for a duration, [s]."""
    return PiecewisePolynomial(np.array([0.0, duration]), configuration[None, None].copy())


def lasting(motion: PiecewisePolynomial) -> PiecewisePolynomial:
    """Return a motion that takes time, as an audit needs it: one that does not as a moment of rest."""
    return motion if motion.duration > 0.0 else standing(motion.coefficients[0, 0], _MOMENT)


@contextmanager
def in_field(field: str, *whole: str) -> Iterator[None]:
    """Name the part of the request in refusals of its fields, but for torques, rates at the ends, and the `whole`."""
    try:
        yield
    except InvalidField as error:
        if error.field.startswith(("start_", "end_", "limits.joint_torque")) or error.field in whole:
            raise
        raise InvalidField(f"{field}.{error.field}", error.reason) from error
