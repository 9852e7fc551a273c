"""Why the joints cannot follow a path any further: reach, a limit, a singularity, or a change of branch.

What is out of reach on the rest of the path, at its end above all, no branch can do. Else it is the branch: it ends
where J loses rank and the path asks for what it has lost, and inverse kinematics from many starts, just beyond that
place, tell whether only what lies beyond joint limits goes on, or another branch. All this is bounded by counts, so
that a verdict neither takes long nor depends on how busy the machine is.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.ik.closed_form import closed_form
from gelenk.kinematics.ik.result import InverseKinematics
from gelenk.kinematics.ik.solve import Options, inverse_kinematics
from gelenk.kinematics.ik.words import DIRECTIONS
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.errors import InvalidField, counted, quoted
from gelenk.model.robot import Robot
from gelenk.trajectory.follow_course import Course
from gelenk.trajectory.follow_rows import task_rows
from gelenk.trajectory.follow_trace import Trace, traced
from gelenk.trajectory.words import StopReason

_BEYOND = np.array([1e-4, 1e-3, 1e-2])
"""How far beyond, in fractions of the path or of 1 m or rad, other solutions are looked for."""
_IK_TOLERANCE = 1e-8
_SAME = 0.05
"""Between two configurations that may be one, [rad or m]."""
_POSES = 16
"""Poses on the rest of the path that are examined, the last one at its end."""
_EXACT = 1e-6
"""Tolerance of inverse kinematics there, [m and rad]."""
_MOST_BRANCHES, _MOST_SAMPLED = 16, 8
"""That are tried, of arms with as many joints as directions and with more."""
_MOST_PIECES = 300
"""That are traced at most to tell whether a branch goes on beyond a threshold, and how far the others go."""
_ABOVE_ALL = 1e300
"""σ that no arm has: the end of a branch is wanted as soon as it is known where."""
_MISSED = 0.05
"""Share of what is missing that a direction has to have to be named."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Why and where the joints cannot go on.

    Attributes:
        reason: `out_of_reach`: nothing reaches the way's end, or a pose before it. `joint_limit`: a joint is in the
            way. `singularity`: the branch goes on, but too near to a singularity. `branch_change`: the branch ends,
            another one goes on.
        s: Where the path cannot be followed any more, [m or rad]: a threshold of σ may have ended it a little before.
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
    """The problem that a verdict is about.

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
            stop = _at_threshold(inquiry, s, trace)
        case "too_fast":
            stop = _too_fast(inquiry, s, trace)
        case _:
            stop = _at_end_of_branch(inquiry, s, trace)
    return _with_the_rest(inquiry, stop, trace)


def never_back(inquiry: Inquiry, trace: Trace) -> Stop:
    """The verdict on a damped path whose tip leaves the path and is still off it at its end."""
    stop = _at_end_of_branch(inquiry, trace.reached, trace)
    detail = f"{stop.detail}; the damped tip leaves the path there and is still off it at its end"
    return _with_the_rest(inquiry, replace(stop, detail=detail), trace)


def _with_the_rest(inquiry: Inquiry, stop: Stop, trace: Trace) -> Stop:
    """A verdict on a branch, before it what no branch can do, and after it what the others can."""
    farthest, words = _of_all_branches(inquiry, trace)
    stop, left = replace(stop, detail=f"{stop.detail}{words}"), inquiry.course.path.extent - farthest
    if not left > 0.0:
        return stop
    places = farthest + left * np.arange(1, _POSES + 1) / _POSES
    # What has too few joints for all directions follows the way but nearly.
    few = len(inquiry.start) < len(inquiry.course.task)
    found = _solved(inquiry, places, trace, inquiry.course.residuals if few else (_EXACT, _EXACT))
    missed = [i for i in range(_POSES) if found.statuses[i] == "unreachable"]
    if not missed:
        return stop
    i = missed[-1]
    what = "the end of the path" if i == _POSES - 1 else f"the path {where(inquiry, places[i])}"
    detail = f"{what} is out of reach: {found.failures[i].reason}; {stop.detail}"
    return replace(stop, reason="out_of_reach", detail=detail)


def _solved(inquiry: Inquiry, places: Array, trace: Trace, tolerances: tuple[float, float]) -> InverseKinematics:
    """Inverse kinematics of poses on the way, from where the joints came to."""
    course = inquiry.course
    options = Options(task=course.task, position_tolerance=tolerances[0], orientation_tolerance=tolerances[1])
    poses = course.path.at(places).poses
    return inverse_kinematics(inquiry.robot, course.chain, poses, _last(inquiry, trace)[None], options)


def _at_limit(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    chain, crossing = inquiry.course.chain, trace.crossing
    joint = 0 if crossing is None or crossing.joint is None else crossing.joint
    q = _last(inquiry, trace)[joint]
    lower, upper = float(chain.lower[joint]), float(chain.upper[joint])
    side, limit = ("lower", lower) if abs(q - lower) < abs(q - upper) else ("upper", upper)
    name = chain.joint_names[joint]
    detail = f"joint {quoted(name)} meets its {side} limit of {limit:.6g} {unit_of(chain, joint)} {where(inquiry, s)}"
    return _stop(inquiry, "joint_limit", s, detail, name)


def _at_threshold(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    """Whether the exact branch ends while σ is below the threshold, or comes out again."""
    course, onward = replace(inquiry.course, limited=False), "the branch continues beyond"
    bounds = trace.reached, 1.01 * inquiry.threshold, _MOST_PIECES
    try:
        ahead = traced(course, inquiry.tolerances, _last(inquiry, trace), 0.0, *bounds)
        if ahead.ending != "complete" and ahead.crossing is not None:
            return _at_end_of_branch(inquiry, ahead.crossing.bad, trace)
    except InvalidField:
        onward = f"the next {_MOST_PIECES} pieces do not show whether the branch continues beyond"
    detail = (
        f"the smallest singular value falls to {inquiry.threshold:.6g}, the threshold min_singular_value, "
        f"{where(inquiry, s)}; {onward}"
    )
    return _stop(inquiry, "singularity", s, detail)


def _too_fast(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    sigma, chain = trace.pieces[-1].b.sigma, inquiry.course.chain
    joint = int(np.abs(trace.pieces[-1].b.dq).argmax())
    detail = (
        f"joint {quoted(chain.joint_names[joint])} would have to go {abs(trace.pieces[-1].b.dq[joint]):.3g} "
        f"{unit_of(chain, joint)} per {inquiry.course.path.unit} of the path {where(inquiry, s)}, where the smallest "
        f"singular value is {sigma:.3g}"
    )
    return _stop(inquiry, "singularity", s, detail)


def _at_end_of_branch(inquiry: Inquiry, s: float, trace: Trace) -> Stop:
    """The verdict from the solutions of inverse kinematics just beyond."""
    extent = inquiry.course.path.extent
    places = np.minimum(s + _BEYOND * min(extent, 1.0), extent)
    found = _solved(inquiry, places, trace, (_IK_TOLERANCE, _IK_TOLERANCE))
    near = next((i for i in range(len(found)) if not _is_the_same(found, i, trace)), None)
    if near is None:
        detail = f"the joints cannot be followed through a singularity {where(inquiry, s)}"
        return _stop(inquiry, "singularity", s, detail)
    # What goes on for a little only, does not go on.
    near = next((i for i in range(near, len(found)) if found.statuses[i] != "solved"), near)
    if found.statuses[near] == "outside_limits":
        failure = found.failures[near]
        name = failure.blocking_joints[0].name if failure.blocking_joints else None
        detail = f"the branch ends {where(inquiry, s)}, and the path beyond is reached {failure.reason}"
        return _stop(inquiry, "joint_limit", s, detail, name)
    if found.statuses[near] != "solved":
        is_unreachable = found.statuses[near] == "unreachable"
        detail = (
            f"the branch ends at a singularity {where(inquiry, s)}{_missing(inquiry, s, trace)}; the path just beyond "
            f"is {'out of reach' if is_unreachable else 'not solved'}: {found.failures[near].reason}"
        )
        return _stop(inquiry, "out_of_reach" if is_unreachable else "singularity", s, detail)
    q = ", ".join(f"{value:.6g}" for value in found.qs[found.firsts[near]])
    detail = (
        f"the branch ends at a singularity {where(inquiry, s)}; beyond it only another branch of the inverse "
        f"kinematics reaches the path, near ({q})"
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
    return f": the joints cannot move the tip on in {' '.join(named)} as the path asks{few}"


def _of_all_branches(inquiry: Inquiry, trace: Trace) -> tuple[float, str]:
    """How far the branches of the path's first pose lead at best, also in words."""
    course = inquiry.course
    if course.is_redundant and closed_form(course.chain, course.task) is None:
        return trace.reached, ""
    at = course.path.at(np.zeros(1))
    most = _MOST_SAMPLED if course.is_redundant else _MOST_BRANCHES
    options = Options(task=course.task, every=True, most=most)
    found = inverse_kinematics(inquiry.robot, course.chain, at.poses, inquiry.start[None], options)
    apart = np.abs(found.qs - inquiry.start).max(axis=1)
    traces, left = [trace], _MOST_PIECES
    is_whole = found.complete == [True]
    for q in found.qs[(apart > apart.min(initial=np.inf)) | (apart > _SAME)]:
        try:
            other = traced(course, inquiry.tolerances, q, inquiry.threshold, until_above=_ABOVE_ALL, most=left)
        except InvalidField:
            is_whole = False
            break
        if other.ending == "complete":
            numbers = ", ".join(f"{value:.6g}" for value in q)
            return course.path.extent, f"; another branch can do the whole path, beginning at ({numbers})"
        left -= len(other.pieces)
        traces.append(other)
    ends = [one.crossing for one in traces if one.crossing is not None]
    farthest = max(end.bad for end in ends)
    share = f"leads beyond {farthest / course.path.extent:.4%} of the path"
    tried = f"{counted(len(traces), 'configuration')} of its first pose"
    # A joint that meets its limit might have begun a turn away from it; and what is given up might lead on.
    turns = course.chain.upper - course.chain.lower >= 2.0 * np.pi
    joints = [end.joint for end in ends if end.joint is not None]
    if is_whole and not turns[joints].any() and all(one.ending != "too_fast" for one in traces):
        return farthest, f"; followed exactly, no configuration {share}: tried on all {tried}"
    return farthest, f"; tried on {tried}, none {share}; others may exist"


def where(inquiry: Inquiry, s: float) -> str:
    """Words for a place on the path."""
    return f"at {place(inquiry, s)}"


def place(inquiry: Inquiry, s: float) -> str:
    """A place on the path in words."""
    path = inquiry.course.path
    x, y, z = path.at(np.array([s])).poses.positions[0]
    return f"s = {s:.6g} {path.unit} ({s / path.extent:.4%} of the path, ({x:.6g}, {y:.6g}, {z:.6g}) m)"


def _stop(inquiry: Inquiry, reason: StopReason, s: float, detail: str, joint: str | None = None) -> Stop:
    position = inquiry.course.path.at(np.array([s])).poses.positions[0]
    return Stop(reason, s, position, joint, detail)


def _last(inquiry: Inquiry, trace: Trace) -> Array:
    return trace.pieces[-1].b.q if trace.pieces else inquiry.start


def unit_of(chain: Chain, joint: int) -> str:
    """The unit of a variable."""
    own = chain.flat.joints[chain.flat.joints[:, 1] == joint]
    return "m" if len(own) and own[:, 0].all() else "rad"
