"""Why the joints cannot follow a way any further: reach, a limit, a singularity, or a change of branch.

The branch ends where J loses rank and the way asks for what it has lost. Inverse kinematics from many starts, just
beyond that place, then tells whether nothing reaches the way there, or only what lies beyond joint limits, or another
branch.
"""

from dataclasses import dataclass, replace

import numpy as np

from app.kinematics.ik.closed_form import closed_form
from app.kinematics.ik.result import InverseKinematics
from app.kinematics.ik.solve import Options, inverse_kinematics
from app.kinematics.ik.words import DIRECTIONS
from app.model.arrays import Array
from app.model.chain import Chain
from app.model.errors import InvalidField, counted, quoted
from app.model.robot import Robot
from app.trajectory.follow_course import Course
from app.trajectory.follow_rows import task_rows
from app.trajectory.follow_trace import Trace, traced
from app.trajectory.words import StopReason

_BEYOND = np.array([1e-4, 1e-3, 1e-2])
"""How far beyond, in fractions of the path or of 1 m or rad, other solutions are looked for."""
_IK_TOLERANCE = 1e-8
_SAME = 0.05
"""Between two configurations that may be one, [rad or m]."""
_MOST_BRANCHES = 8
_MISSED = 0.05
"""Share of what is missing that a direction has to have to be named."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Why and where the joints cannot go on.

    Attributes:
        reason: `out_of_reach`: nothing reaches the way beyond. `joint_limit`: a joint is in the way. `singularity`: the
            branch goes on, but too near to a singularity. `branch_change`: the branch ends, another one goes on.
        s: Where the way cannot be followed any more, [m or rad]: a threshold of σ may have ended it a little before.
        position: Of the tip there; shape (3,), [m].
        joint: Whose limit it is.
        detail: In a sentence.
    """

    reason: StopReason
    s: float
    position: Array
    joint: str | None
    detail: str


@dataclass(frozen=True, slots=True)
class Inquiry:
    """What a verdict is about.

    Attributes:
        robot: The robot.
        course: What was followed.
        tolerances: Of position [m] and orientation [rad].
        threshold: σ at which it had to end; 0 if at none.
        start: Where it began; shape (n,).
    """

    robot: Robot
    course: Course
    tolerances: tuple[float, float]
    threshold: float
    start: Array


def verdict(inquiry: Inquiry, trace: Trace) -> Stop | None:
    """Why a trace ends before the path does; None where it does not."""
    if trace.ending == "complete" or trace.crossing is None:
        return None
    s = trace.crossing.bad
    match trace.ending:
        case "joint_limit":
            stop = _at_limit(inquiry, s, trace)
        case "threshold":
            lost = _lost_ahead(inquiry, trace)
            stop = _near_singularity(inquiry, s) if lost is None else _at_end_of_branch(inquiry, lost, trace)
        case "too_fast":
            stop = _too_fast(inquiry, s, trace)
        case _:
            stop = _at_end_of_branch(inquiry, s, trace)
    if stop.reason == "out_of_reach":
        return stop
    other = _other_branch(inquiry)
    if other is None:
        return stop
    numbers = ", ".join(f"{value:.6g}" for value in other)
    return replace(stop, detail=f"{stop.detail}; another branch can do the whole way, beginning at ({numbers})")


def never_back(inquiry: Inquiry, trace: Trace) -> Stop:
    """Of a damped way whose tip leaves the path and is still off it at its end."""
    s = trace.reached
    stop = _at_end_of_branch(inquiry, s, trace)
    reason: StopReason = "branch_change" if stop.reason == "branch_change" else "out_of_reach"
    detail = f"{stop.detail}; the damped tip leaves the way there and is still off it at its end"
    return replace(stop, reason=reason, joint=None, detail=detail)


def _at_limit(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    chain, crossing = inquiry.course.chain, trace.crossing
    joint = 0 if crossing is None or crossing.joint is None else crossing.joint
    q = _last(inquiry, trace)[joint]
    lower, upper = float(chain.lower[joint]), float(chain.upper[joint])
    side, limit = ("lower", lower) if abs(q - lower) < abs(q - upper) else ("upper", upper)
    name = chain.joint_names[joint]
    detail = f"joint {quoted(name)} meets its {side} limit of {limit:.6g} {unit_of(chain, joint)} {where(inquiry, s)}"
    return _stop(inquiry, "joint_limit", s, detail, name)


def _near_singularity(inquiry: Inquiry, s: float) -> Stop:
    detail = (
        f"the smallest singular value falls to {inquiry.threshold:.6g}, the threshold min_singular_value, "
        f"{where(inquiry, s)}; the branch goes on beyond"
    )
    return _stop(inquiry, "singularity", s, detail)


def _too_fast(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    sigma, chain = trace.pieces[-1].b.sigma, inquiry.course.chain
    joint = int(np.abs(trace.pieces[-1].b.dq).argmax())
    detail = (
        f"joint {quoted(chain.joint_names[joint])} would have to go {abs(trace.pieces[-1].b.dq[joint]):.3g} "
        f"{unit_of(chain, joint)} per {inquiry.course.path.unit} of the way {where(inquiry, s)}, where the smallest "
        f"singular value is {sigma:.3g}"
    )
    return _stop(inquiry, "singularity", s, detail)


def _lost_ahead(inquiry: Inquiry, trace: Trace) -> float | None:
    """Where the exact branch ends while σ is below the threshold; None where it comes out again."""
    course = replace(inquiry.course, limited=False)
    try:
        ahead = traced(course, inquiry.tolerances, _last(inquiry, trace), 0.0, trace.reached, 1.01 * inquiry.threshold)
    except InvalidField:
        return None
    return None if ahead.ending != "lost" or ahead.crossing is None else ahead.crossing.bad


def _at_end_of_branch(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    """By what inverse kinematics find just beyond."""
    course, extent = inquiry.course, inquiry.course.path.extent
    at = course.path.at(np.minimum(s + _BEYOND * min(extent, 1.0), extent))
    options = Options(task=course.task, position_tolerance=_IK_TOLERANCE, orientation_tolerance=_IK_TOLERANCE)
    found = inverse_kinematics(inquiry.robot, course.chain, at.poses, _last(inquiry, trace)[None], options)
    near = next((i for i in range(len(found)) if not _is_the_same(found, i, trace)), None)
    if near is None:
        detail = f"the joints cannot be followed through a singularity {where(inquiry, s)}"
        return _stop(inquiry, "singularity", s, detail)
    # What goes on for a little only, does not go on.
    near = next((i for i in range(near, len(found)) if found.statuses[i] != "solved"), near)
    if found.statuses[near] == "outside_limits":
        failure = found.failures[near]
        name = failure.blocking_joints[0].name if failure.blocking_joints else None
        detail = f"the branch ends {where(inquiry, s)}, and the way beyond is reached {failure.reason}"
        return _stop(inquiry, "joint_limit", s, detail, name)
    if found.statuses[near] != "solved":
        detail = f"no configuration reaches the way beyond {place(inquiry, s)}{_missing(inquiry, s, trace)}"
        return _stop(inquiry, "out_of_reach", s, detail)
    q = ", ".join(f"{value:.6g}" for value in found.qs[found.firsts[near]])
    detail = (
        f"the branch ends at a singularity {where(inquiry, s)}; beyond it only another branch of the inverse "
        f"kinematics reaches the way, near ({q})"
    )
    return _stop(inquiry, "branch_change", s, detail)


def _is_the_same(found: InverseKinematics, i: int, trace: Trace) -> bool:
    """Whether what solves a target beyond the end of a branch is that end itself, as near as tolerances can tell."""
    if found.statuses[i] != "solved" or not trace.pieces:
        return False
    return float(np.abs(found.qs[found.firsts[i]] - trace.pieces[-1].b.q).max()) < _SAME


def _missing(inquiry: Inquiry, s: float, trace: Trace) -> str:
    """Which directions of the task the joints cannot serve, in words."""
    course = inquiry.course
    at, q = course.samples(np.array([s]), 0.0, course.path.extent), _last(inquiry, trace)
    rows = task_rows(course.chain, course.task, at, q[None])
    left, sigmas, _ = np.linalg.svd(rows.jacobians[0])
    rank = int(np.sum(sigmas > max(2.0 * inquiry.threshold, 1e-3 * float(sigmas[0]))))
    lost = left[:, rank:]
    missing = np.abs(lost @ (lost.T @ rows.rates[0]))
    if not missing.max(initial=0.0) > 0.0:
        return ""
    names = [name for name in DIRECTIONS if name in course.task.directions]
    named = [name for name, part in zip(names, missing, strict=True) if part > _MISSED * missing.max()]
    few = (
        f"; {counted(len(q), 'joint')} cannot serve {counted(len(names), 'direction')}: `task` says which count"
        if len(q) < len(names)
        else ""
    )
    return f": the joints cannot move the tip on in {' '.join(named)} as the way asks{few}"


def _other_branch(inquiry: Inquiry) -> Array | None:
    """Another configuration of the path's first pose from which the whole way can be done; shape (n,)."""
    course = inquiry.course
    if closed_form(course.chain, course.task) is None:
        return None
    at = course.path.at(np.zeros(1))
    options = Options(task=course.task, every=True, most=_MOST_BRANCHES)
    found = inverse_kinematics(inquiry.robot, course.chain, at.poses, inquiry.start[None], options)
    for q in found.qs[:_MOST_BRANCHES]:
        if float(np.abs(q - inquiry.start).max()) < 1e-3:
            continue
        try:
            if traced(course, inquiry.tolerances, q, inquiry.threshold).ending == "complete":
                return np.asarray(q)
        except InvalidField:
            continue
    return None


def where(inquiry: Inquiry, s: float) -> str:
    """That something is at a place on the path."""
    return f"at {place(inquiry, s)}"


def place(inquiry: Inquiry, s: float) -> str:
    """A place on the path in words."""
    path = inquiry.course.path
    x, y, z = path.at(np.array([s])).poses.positions[0]
    return f"s = {s:.6g} {path.unit} ({s / path.extent:.4%} of the way, ({x:.6g}, {y:.6g}, {z:.6g}) m)"


def _stop(inquiry: Inquiry, reason: StopReason, s: float, detail: str, joint: str | None = None) -> Stop:
    position = inquiry.course.path.at(np.array([s])).poses.positions[0]
    return Stop(reason, s, position, joint, detail)


def _last(inquiry: Inquiry, trace: Trace) -> Array:
    return trace.pieces[-1].b.q if trace.pieces else inquiry.start


def unit_of(chain: Chain, joint: int) -> str:
    """Of a variable."""
    own = chain.flat.joints[chain.flat.joints[:, 1] == joint]
    return "m" if len(own) and own[:, 0].all() else "rad"
