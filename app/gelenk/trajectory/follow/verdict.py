"""Verdict on why the joints cannot follow a path further: reach, a joint limit, a singularity, or a change of branch.

If some of the remaining path is out of reach, its end above all, no branch can follow it. Otherwise the branch ends
where J loses rank in a direction that the path needs. Inverse kinematics from many starts just beyond that place then
shows whether only solutions beyond joint limits go on, or another branch. Counts bound all this work, so that a verdict
is fast and does not depend on the load of the machine.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.errors import InvalidField, counted, quoted
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search.words import DIRECTIONS
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.words import StopReason
from gelenk.trajectory.follow.integrate import Trace, traced
from gelenk.trajectory.follow.rate_field import Course
from gelenk.trajectory.follow.rows import task_rows

_BEYOND = np.array([1e-4, 1e-3, 1e-2])
"""Distances beyond the end, in fractions of the path or of 1 m or rad, at which other solutions are looked for."""
_IK_TOLERANCE = 1e-8
_SAME = 0.05
"""Distance below which two configurations may be the same, [rad or m]."""
_POSES = 16
"""Number of poses examined on the rest of the path, the last one at its end."""
_EXACT = 1e-6
"""Tolerance of inverse kinematics at these poses, [m and rad]."""
_MOST_BRANCHES, _MOST_SAMPLED = 16, 8
"""Largest number of branches tried, for arms with as many joints as directions and for redundant ones."""
_MOST_PIECES = 300
"""Pieces traced to see whether a branch goes on beyond a threshold, and to see how far other branches lead."""
_ABOVE_ALL = 1e300
"""σ that no arm reaches: tracing then only stops early where the end of a branch is extrapolated."""
_MISSED = 0.05
"""Smallest share of the missing motion for a direction to be named."""


@dataclass(frozen=True, slots=True)
class Stop:
    """Why and where the joints cannot go on.

    Attributes:
        reason: `out_of_reach`: the path's end, or a pose before it, is out of reach. `joint_limit`: a joint limit
            prevents it. `singularity`: the branch goes on, but too near to a singularity. `branch_change`: the branch
            ends, and another one goes on.
        s: Place where the path cannot be followed further, [m or rad]; a threshold of σ may end it a little earlier.
        position: Position of the tip there; shape (3,), [m].
        joint: Name of the joint at its limit, if any.
        detail: An explanation in words.
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
        course: The course that was followed.
        tolerances: Of position [m] and orientation [rad].
        threshold: σ at which following had to end; 0 if at none.
        start: First configuration; shape (n,).
    """

    robot: RobotModel
    course: Course
    tolerances: tuple[float, float]
    threshold: float
    start: Array


def verdict(inquiry: Inquiry, trace: Trace) -> Stop | None:
    """Return why a trace ends before the path does; None if it is complete."""
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
    """Return the verdict on a damped path whose tip leaves the path and is still off it at the end."""
    stop = _at_end_of_branch(inquiry, trace.reached, trace)
    detail = f"{stop.detail}; the damped tip leaves the path there and is still off it at its end"
    return _with_the_rest(inquiry, replace(stop, detail=detail), trace)


def _with_the_rest(inquiry: Inquiry, stop: Stop, trace: Trace) -> Stop:
    """Extend a verdict on a branch: what no branch can reach goes before it, what other branches can do after it."""
    farthest, words = _of_all_branches(inquiry, trace)
    stop, left = replace(stop, detail=f"{stop.detail}{words}"), inquiry.course.path.extent - farthest
    if not left > 0.0:
        return stop
    places = farthest + left * np.arange(1, _POSES + 1) / _POSES
    # An arm with too few joints for all directions follows the path only approximately.
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
    """Solve inverse kinematics for poses on the path, starting at the last configuration that was reached."""
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
    """Return the verdict at a threshold: whether the branch ends while σ is below it, or goes on beyond."""
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
    """Return the verdict that the solutions of inverse kinematics just beyond the end give."""
    extent = inquiry.course.path.extent
    places = np.minimum(s + _BEYOND * min(extent, 1.0), extent)
    found = _solved(inquiry, places, trace, (_IK_TOLERANCE, _IK_TOLERANCE))
    near = next((i for i in range(len(found)) if not _is_the_same(found, i, trace)), None)
    if near is None:
        detail = f"the joints cannot be followed through a singularity {where(inquiry, s)}"
        return _stop(inquiry, "singularity", s, detail)
    # A branch that goes on for a short distance only does not count.
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
    """Return whether the solution of a target beyond the end of a branch is that end, within tolerances."""
    if found.statuses[i] != "solved" or not trace.pieces:
        return False
    return float(np.abs(found.qs[found.firsts[i]] - trace.pieces[-1].b.q).max()) < _SAME


def _missing(inquiry: Inquiry, s: float, trace: Trace) -> str:
    """Describe the directions of the task in which the joints cannot move the tip."""
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
    return f": the joints cannot move the tip further in {' '.join(named)} as the path requires{few}"


def _of_all_branches(inquiry: Inquiry, trace: Trace) -> tuple[float, str]:
    """Return how far the branches of the path's first pose lead at best, and a description."""
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
    # A joint at its limit might have started one turn away from it; a path given up as too fast might lead on.
    turns = course.chain.upper - course.chain.lower >= 2.0 * np.pi
    joints = [end.joint for end in ends if end.joint is not None]
    if is_whole and not turns[joints].any() and all(one.ending != "too_fast" for one in traces):
        return farthest, f"; followed exactly, no configuration {share}: tried on all {tried}"
    return farthest, f"; tried on {tried}, none {share}; others may exist"


def where(inquiry: Inquiry, s: float) -> str:
    """Describe a place on the path, with a preceding "at"."""
    return f"at {place(inquiry, s)}"


def place(inquiry: Inquiry, s: float) -> str:
    """Describe a place on the path by s, its share of the path, and its position [m]."""
    path = inquiry.course.path
    x, y, z = path.at(np.array([s])).poses.positions[0]
    return f"s = {s:.6g} {path.unit} ({s / path.extent:.4%} of the path, ({x:.6g}, {y:.6g}, {z:.6g}) m)"


def _stop(inquiry: Inquiry, reason: StopReason, s: float, detail: str, joint: str | None = None) -> Stop:
    position = inquiry.course.path.at(np.array([s])).poses.positions[0]
    return Stop(reason, s, position, joint, detail)


def _last(inquiry: Inquiry, trace: Trace) -> Array:
    return trace.pieces[-1].b.q if trace.pieces else inquiry.start


def unit_of(chain: Chain, joint: int) -> str:
    """Return the unit of a joint variable: "m" if prismatic, else "rad"."""
    own = chain.flat.joints[chain.flat.joints[:, 1] == joint]
    return "m" if len(own) and own[:, 0].all() else "rad"
