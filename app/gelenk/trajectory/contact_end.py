"""Where a trajectory ends that would touch something: along a path of the tip shortly before, else at its last stop."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import takewhile
from typing import cast

import numpy as np

from gelenk.collision.cell import Cell, cell_in
from gelenk.errors import quoted
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.chain import Chain
from gelenk.trajectory.audit.contact.clearance import free_time
from gelenk.trajectory.audit.result import ClosestPair, Moment
from gelenk.trajectory.follow.verdict import Stop
from gelenk.trajectory.problem.problem import Trajectory
from gelenk.trajectory.problem.result import PlanningFailure

_AWAY = 1e-4
"""Distance beyond the one that is asked for at which a path ends, [m]."""
_TOUCH = 1e-5
"""Nearer than this two are said to touch, [m]."""


@dataclass(frozen=True, slots=True)
class ContactEnd:
    """An end before a contact.

    Attributes:
        failure: Why and in which segment it ends.
        stop: Where the path of the tip ends to which that segment belongs; None if that part does not begin.
    """

    failure: PlanningFailure
    stop: Stop | None = None


def contact_ends(chain: Chain, cell: Cell, found: Trajectory, contact: Moment, nearest: Moment) -> Iterator[ContactEnd]:
    """Yield the ends to try of a trajectory that would touch something: as late as it can be, then for certain."""
    begun = [report for report in found.segments if report.start_time <= contact.time]
    position = chain_poses(chain.flat, np.array([contact.joint_positions]))[0][0]
    segment, detail = begun[-1].index if begun else 0, _detail(contact, nearest)
    failure = PlanningFailure("collision", segment, 0.0, tuple(position.tolist()), None, detail, contact, nearest)
    blended = list(takewhile(lambda report: report.blended, reversed(begun[:-1])))
    first, laws = (*begun, *blended)[-1] if begun else None, dict(found.laws)
    if first is not None and (law := laws.get(first.index)) is not None:
        free = free_time(cell_in(cell.world, _AWAY), found.motion) - first.start_time
        if free > 0.0:
            yield ContactEnd(failure, Stop("collision", float(law.at(np.array([free]))[0, 0]), position, None, detail))
    yield ContactEnd(failure)


def _detail(contact: Moment, nearest: Moment) -> str:
    """Say which pair comes too near, when, and how near it would come later."""
    if contact.time == 0.0:
        return f"at the start {_apart(contact)}: nothing can begin there"
    later = "" if nearest.time == contact.time else f", and at {nearest.time:.6g} s {_apart(nearest)}"
    return f"in the motion asked for, at {contact.time:.6g} s {_apart(contact)}{later}: it ends before"


def _apart(moment: Moment) -> str:
    pair = cast(ClosestPair, moment.pair)
    two = f"{quoted(pair.a)} and {quoted(pair.b)}"
    if abs(pair.distance) <= _TOUCH:
        return f"{two} touch"
    return (
        f"{two} overlap by {-pair.distance:.3g} m" if pair.distance < 0.0 else f"{two} are {pair.distance:.3g} m apart"
    )
