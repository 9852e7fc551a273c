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
from gelenk.trajectory.follow.rate_field import RateField
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
_MOST_PIECES, _MOST_SPARE = 300, 60
"""Pieces traced to see whether a branch goes on beyond a threshold, and to see how far other branches lead; the second
for redundant arms, which have looked ahead before."""
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
    """

    reason: StopReason
    s: float
    position: Array
    joint: str | None
    detail: str


@dataclass(frozen=True, slots=True)
class _Ended:
    """A path that could not be followed to its end."""

    robot: RobotModel
    field: RateField
    trace: Trace

    def followable(self, places: Array) -> InverseKinematics:
        """Solve at places as closely as the path is followed: with too few joints for all directions, approximately."""
        field = self.field
        return self.solved(places, *(field.residuals if len(field.chain) < len(field.task) else (_EXACT, _EXACT)))

    def solved(self, places: Array, position_tolerance: float, orientation_tolerance: float) -> InverseKinematics:
        field = self.field
        options = Options(
            task=field.task, position_tolerance=position_tolerance, orientation_tolerance=orientation_tolerance
        )
        return inverse_kinematics(self.robot, field.chain, field.path.at(places).poses, self.trace.last[None], options)

    @property
    def most(self) -> int:
        """Largest number of pieces that a verdict traces."""
        return _MOST_SPARE if self.field.is_redundant else _MOST_PIECES

    def place(self, s: float) -> str:
        path = self.field.path
        x, y, z = path.at(np.array([s])).poses.positions[0]
        return f"at s = {s:.6g} {path.unit} ({s / path.extent:.4%} of the path, ({x:.6g}, {y:.6g}, {z:.6g}) m)"

    def stop(self, reason: StopReason, s: float, detail: str, joint: str | None = None) -> Stop:
        return Stop(reason, s, self.field.path.at(np.array([s])).poses.positions[0], joint, detail)


def end_is_reached(robot: RobotModel, field: RateField, trace: Trace) -> bool:
    """Return whether inverse kinematics finds a configuration within the joint limits at the end of the path."""
    return _Ended(robot, field, trace).followable(np.array([field.path.extent])).statuses == ["solved"]


def verdict(robot: RobotModel, field: RateField, trace: Trace) -> Stop | None:
    """Return why a trace ends before the path does; None if it is complete."""
    if trace.ending == "complete" or trace.crossing is None:
        return None
    verdicts = {"joint_limit": _at_limit, "threshold": _at_threshold, "too_fast": _too_fast, "lost": _at_end_of_branch}
    ended = _Ended(robot, field, trace)
    return _with_the_rest(ended, verdicts[trace.ending](ended, trace.crossing.bad))


def never_back(robot: RobotModel, field: RateField, trace: Trace) -> Stop:
    """Return the verdict on a damped path whose tip leaves the path and is still off it at the end."""
    ended = _Ended(robot, field, trace)
    stop = _at_end_of_branch(ended, trace.reached)
    detail = f"{stop.detail}; the damped tip leaves the path there and is still off it at its end"
    return _with_the_rest(ended, replace(stop, detail=detail))


def _with_the_rest(ended: _Ended, stop: Stop) -> Stop:
    """Extend a verdict on a branch: what no branch can reach goes before it, what other branches can do after it."""
    field = ended.field
    end = ended.followable(np.array([field.path.extent]))
    farthest, words = _of_all_branches(ended, end.statuses == ["solved"])
    stop, left = (
        replace(stop, detail=f"{stop.detail}{_of_spare_joints(field, end)}{words}"),
        field.path.extent - farthest,
    )
    if not left > 0.0:
        return stop
    places, found = farthest + left * np.arange(1, _POSES + 1) / _POSES, end
    if end.statuses != ["unreachable"]:
        found = ended.followable(places[:-1])
    missed = [i for i in range(len(found)) if found.statuses[i] == "unreachable"]
    if not missed:
        return stop
    i = missed[-1]
    what = "the end of the path" if found is end else f"the path {ended.place(places[i])}"
    detail = f"{what} is out of reach: {found.failures[i].reason}; {stop.detail}"
    return replace(stop, reason="out_of_reach", detail=detail)


def _of_spare_joints(field: RateField, end: InverseKinematics) -> str:
    """Say what is known of other uses of the spare joints; a path out of reach needs no words on them."""
    if not field.is_redundant or end.statuses == ["unreachable"]:
        return ""
    if end.statuses == ["solved"]:
        return "; looking ahead over the self-motion has found no way to the end"
    return f"; the end of the path: {end.failures[0].reason}"


def _at_limit(ended: _Ended, s: float) -> Stop:
    chain, crossing = ended.field.chain, ended.trace.crossing
    joint = 0 if crossing is None or crossing.joint is None else crossing.joint
    q = ended.trace.last[joint]
    lower, upper = float(chain.lower[joint]), float(chain.upper[joint])
    side, limit = ("lower", lower) if abs(q - lower) < abs(q - upper) else ("upper", upper)
    name = chain.joint_names[joint]
    detail = f"joint {quoted(name)} meets its {side} limit of {limit:.6g} {unit_of(chain, joint)} {ended.place(s)}"
    return ended.stop("joint_limit", s, detail, name)


def _at_threshold(ended: _Ended, s: float) -> Stop:
    """Tell whether the branch ends while σ is below the threshold, or goes on beyond."""
    beyond, onward = replace(ended.field, limited=False, threshold=0.0), "the branch continues beyond"
    threshold, trace = ended.field.threshold, ended.trace
    try:
        ahead = traced(beyond, trace.last, trace.reached, 1.01 * threshold, ended.most)
        if ahead.ending != "complete" and ahead.crossing is not None:
            return _at_end_of_branch(ended, ahead.crossing.bad)
    except InvalidField:
        onward = f"the next {counted(ended.most, 'piece')} do not show whether the branch continues beyond"
    detail = (
        f"the smallest singular value falls to {threshold:.6g}, the threshold min_singular_value, "
        f"{ended.place(s)}; {onward}"
    )
    return ended.stop("singularity", s, detail)


def _too_fast(ended: _Ended, s: float) -> Stop:
    knot, chain = ended.trace.pieces[-1].b, ended.field.chain
    joint = int(np.abs(knot.dq).argmax())
    detail = (
        f"joint {quoted(chain.joint_names[joint])} would have to go {abs(knot.dq[joint]):.3g} "
        f"{unit_of(chain, joint)} per {ended.field.path.unit} of the path {ended.place(s)}, where the smallest "
        f"singular value is {knot.sigma:.3g}"
    )
    return ended.stop("singularity", s, detail)


def _at_end_of_branch(ended: _Ended, s: float) -> Stop:
    """Judge by the solutions of inverse kinematics just beyond the end."""
    extent = ended.field.path.extent
    places = np.minimum(s + _BEYOND * min(extent, 1.0), extent)
    found = ended.solved(places, _IK_TOLERANCE, _IK_TOLERANCE)
    near = next((i for i in range(len(found)) if not _is_the_same(found, i, ended.trace)), None)
    if near is None:
        detail = f"the joints cannot be followed through a singularity {ended.place(s)}"
        return ended.stop("singularity", s, detail)
    # A branch that goes on for a short distance only does not count.
    near = next((i for i in range(near, len(found)) if found.statuses[i] != "solved"), near)
    if found.statuses[near] == "outside_limits":
        failure = found.failures[near]
        name = failure.blocking_joints[0].name if failure.blocking_joints else None
        detail = f"the branch ends {ended.place(s)}, and the path beyond is {failure.reason}"
        return ended.stop("joint_limit", s, detail, name)
    if found.statuses[near] != "solved":
        is_unreachable = found.statuses[near] == "unreachable"
        detail = (
            f"the branch ends at a singularity {ended.place(s)}{_missing(ended, s)}; the path just beyond "
            f"is {'out of reach' if is_unreachable else 'not solved'}: {found.failures[near].reason}"
        )
        return ended.stop("out_of_reach" if is_unreachable else "singularity", s, detail)
    q = ", ".join(f"{value:.6g}" for value in found.qs[found.firsts[near]])
    detail = (
        f"the branch ends at a singularity {ended.place(s)}; beyond it only another branch of the inverse "
        f"kinematics reaches the path, near ({q})"
    )
    return ended.stop("branch_change", s, detail)


def _is_the_same(found: InverseKinematics, i: int, trace: Trace) -> bool:
    """Return whether the solution of a target beyond the end of a branch is that end, within tolerances."""
    if found.statuses[i] != "solved" or not trace.pieces:
        return False
    return float(np.abs(found.qs[found.firsts[i]] - trace.pieces[-1].b.q).max()) < _SAME


def _missing(ended: _Ended, s: float) -> str:
    """Describe the directions of the task in which the joints cannot move the tip."""
    field, q = ended.field, ended.trace.last
    rows = task_rows(field.chain, field.task, field.samples(np.array([s]), 0.0, field.path.extent), q[None])
    left, sigmas, _ = np.linalg.svd(rows.jacobians[0])
    rank = int(np.sum(sigmas > max(2.0 * field.threshold, 1e-3 * float(sigmas[0]))))
    lost = left[:, rank:]
    missing = np.abs(lost @ (lost.T @ rows.rates[0]))
    if not missing.max(initial=0.0) > 0.0:
        return ""
    names = [name for name in DIRECTIONS if name in field.task.directions]
    named = [name for name, part in zip(names, missing, strict=True) if part > _MISSED * missing.max()]
    few = (
        f"; {counted(len(q), 'joint')} cannot serve {counted(len(names), 'direction')}: `task` says which count"
        if len(q) < len(names)
        else ""
    )
    return f": the joints cannot move the tip further in {' '.join(named)} as the path requires{few}"


def _of_all_branches(ended: _Ended, end_is_solved: bool) -> tuple[float, str]:
    """Return how far the branches of the path's first pose lead at best, and a description."""
    field, trace = ended.field, ended.trace
    if field.is_redundant and (not end_is_solved or closed_form(field.chain, field.task) is None):
        return trace.reached, ""
    at = field.path.at(np.zeros(1))
    most = _MOST_SAMPLED if field.is_redundant else _MOST_BRANCHES
    options = Options(task=field.task, every=True, most=most)
    found = inverse_kinematics(ended.robot, field.chain, at.poses, trace.start[None], options)
    apart = np.abs(found.qs - trace.start).max(axis=1)
    traces, left = [trace], ended.most
    is_whole = found.complete == [True]
    for q in found.qs[(apart > apart.min(initial=np.inf)) | (apart > _SAME)]:
        try:
            other = traced(field, q, until_above=_ABOVE_ALL, most=left)
        except InvalidField:
            is_whole = False
            break
        if other.ending == "complete":
            numbers = ", ".join(f"{value:.6g}" for value in q)
            return field.path.extent, f"; another branch can do the whole path, beginning at ({numbers})"
        left -= len(other.pieces)
        traces.append(other)
    ends = [one.crossing for one in traces if one.crossing is not None]
    farthest = max(end.bad for end in ends)
    share = f"leads beyond {farthest / field.path.extent:.4%} of the path"
    tried = f"{counted(len(traces), 'configuration')} of its first pose"
    # A joint at its limit might have started one turn away from it; a path given up as too fast might lead on.
    turns = field.chain.upper - field.chain.lower >= 2.0 * np.pi
    joints = [end.joint for end in ends if end.joint is not None]
    if is_whole and not turns[joints].any() and all(one.ending != "too_fast" for one in traces):
        return farthest, f"; followed exactly, no configuration {share}: tried on all {tried}"
    return farthest, f"; tried on {tried}, none {share}; others may exist"


def unit_of(chain: Chain, joint: int) -> str:
    """Return the unit of a joint variable: "m" if prismatic, else "rad"."""
    own = chain.flat.joints[chain.flat.joints[:, 1] == joint]
    return "m" if len(own) and own[:, 0].all() else "rad"
