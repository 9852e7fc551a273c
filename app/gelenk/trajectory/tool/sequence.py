"""The cheapest sequence of branches and turns of the tool along poses that leave a turn about one axis open.

The path through the poses is divided into rungs, the poses among them. On each one all branches at all turns are
candidates, and the cheapest way through them is found (`ladder`): no other choice among them has less joint travel.
Of seven joints one is held on the way, at the best of some values (`forms`). Then the turns in between are used
(`smoothing`).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gelenk.collision.cell import Cell, cell_in
from gelenk.errors import InvalidField
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.search.bounds import free_variables, mid_range
from gelenk.ik.verdict.fixed import narrowed, widened
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.follow.ladder import Metric, way_up
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.spline_paths import PolynomialPath, spline
from gelenk.trajectory.problem.problem import FreeTool, ToolTurn
from gelenk.trajectory.problem.result import PlanningFailure, ToolChoice
from gelenk.trajectory.tool.blocked import blocked
from gelenk.trajectory.tool.candidates import Clear, TurnedCandidates, candidates, forms_of, solved_near
from gelenk.trajectory.tool.smoothing import TurnedRungs, smoothed

_TURN = 2.0 * np.pi
_RUNGS = 200
"""Least number of steps from the first pose to the last."""
_AWAY = 1e-3
"""Distance beyond the one that is asked for from all that might be touched, [m]: the arm moves on between two rungs."""
_LONGEST = 0.5
"""Longest step of a joint between two rungs, [rad or m]; a change of branch takes more."""


@dataclass(frozen=True, slots=True)
class ToolSequence:
    """The sequence as far as there is one.

    Attributes:
        start: Configuration at the first pose; shape (n,), [rad or m]; None if there is none.
        turn: Of the tip along the path through the poses, up to the last rung reached.
        failure: What blocks the rest, at the share of the path that is reached; None if nothing does.
    """

    start: Array | None
    turn: ToolTurn
    choice: ToolChoice
    failure: PlanningFailure | None = None
    share: float = 1.0


class _Way(NamedTuple):
    """A way by a form: turns, (R,), [rad], the form's configurations, (R, n), [rad or m], and the cost."""

    form: ClosedForm
    turns: Array
    qs: Array
    cost: float


def tool_sequence(
    chain: Chain,
    poses: Poses,
    tool: FreeTool,
    velocity: Array,
    least: float,
    start: Array | None = None,
    cell: Cell | None = None,
) -> ToolSequence:
    """Find the sequence with the least joint travel, each joint's in units of its velocity limit, [s].

    Args:
        poses: At least two poses of the tip.
        velocity: Limit of each joint; shape (n,), [rad/s or m/s].
        least: Smallest singular value of J from which on a configuration is clear of singularities.
        start: Where the joints come from, which counts as travel; shape (n,), [rad or m].
        cell: What no configuration may touch.

    Raises:
        InvalidField: The arm has no closed form, or there is no path through the poses.
    """
    path, clear = _path(poses), Clear(least, None if cell is None else cell_in(cell.world, _AWAY))
    places, own = _rungs(path.knots)
    along = path.at(places).poses
    turns: Array = np.linspace(0.0, _TURN, tool.steps if tool.axis.any() else 1, endpoint=False)
    forms = forms_of(chain, tool.axis, start)
    ways = (_best(form, candidates(form, along, tool.axis, turns, clear), 1.0 / velocity, start) for form in forms)
    best = max(ways, key=lambda way: (len(way.qs), -way.cost))
    form, count, weights = best.form, len(best.qs), narrowed(best.form.chain, 1.0 / velocity[None])[0]
    rungs = TurnedRungs(_first(along, count), places[:count], best.turns, best.qs)
    if count > 1 and tool.axis.any():
        rungs = smoothed(form, rungs, tool.axis, weights, clear)
    qs = widened(form.chain, rungs.qs)[1]
    guide = cubic_spline(rungs.places, qs, "natural").motion if count > 1 and len(chain) > 6 else None
    turn = ToolTurn(tool.axis, rungs.places, rungs.turns, guide)
    choice = _choice(form, rungs, tool, own[own < count], weights)
    first = qs[0] if count else None
    if count == len(places):
        return ToolSequence(first, turn, choice)
    near = int(np.searchsorted(own, count, side="right")) - 1
    failure = blocked(forms, _one(along, count), tool.axis, turns, clear, (near, bool(own[near] == count)))
    return ToolSequence(first, turn, choice, failure, float(places[max(count - 1, 0)] / places[-1]))


def _path(poses: Poses) -> PolynomialPath:
    try:
        return spline(poses)
    except InvalidField as error:
        raise InvalidField("path.poses", error.reason) from None


def _rungs(knots: Array) -> tuple[Array, Indices]:
    """Return places, (R,), [m], with all knots among them, and which are knots; at least `_RUNGS` steps in all."""
    parts = np.ceil(np.diff(knots) * (_RUNGS / knots[-1]) * (1.0 - 1e-9)).astype(np.int64)
    own = np.concatenate(([0], np.cumsum(parts)))
    places = np.interp(np.arange(own[-1] + 1), own, knots)
    return places, own


def _first(poses: Poses, count: int) -> Poses:
    return Poses(poses.positions[:count], poses.rotations[:count])


def _one(poses: Poses, i: int) -> Poses:
    return Poses(poses.positions[i : i + 1], poses.rotations[i : i + 1])


def _best(form: ClosedForm, found: TurnedCandidates, weights: Array, start: Array | None) -> _Way:
    """Return the cheapest way, without jumps by whole turns; `weights` and `start` are those of the whole chain.

    A joint that turns through its whole range may pass from one end to the other by a whole turn, as long as all of its
    way then fits between its limits; if it does not, these are distinct.
    """
    chain = form.chain
    turning = free_variables(chain) & (chain.upper - chain.lower >= _TURN)
    firsts, own = found.rungs.qs[: found.rungs.firsts[1]], narrowed(chain, weights[None])[0]
    for wraps in (turning, np.zeros_like(turning)):
        metric = Metric(own, np.full(len(chain), _LONGEST), wraps)
        costs, near = np.zeros(len(firsts)), mid_range(chain)
        if start is not None:
            near = narrowed(chain, start[None])[0]
            nearest = widened(chain, near + _differences(firsts - near, wraps))[1]
            costs = np.linalg.norm(weights * (nearest - start), axis=1)
        rows, cost = way_up(found.rungs, metric, costs)
        qs = _unwound(chain, found.rungs.qs[rows], wraps, near)
        if qs is not None:
            break
    qs = found.rungs.qs[rows] if qs is None else qs
    return _Way(form, np.unwrap(found.turns[rows]), qs, cost)


def _differences(differences: Array, turning: Flags) -> Array:
    return differences - np.where(turning, _TURN * np.rint(differences / _TURN), 0.0)


def _unwound(chain: Chain, qs: Array, turning: Flags, near: Array) -> Array | None:
    """Return configurations without jumps by whole turns, near to one, within the limits; None if they do not fit."""
    if len(qs) == 0:
        return qs
    ways = np.cumsum(np.vstack((qs[:1], _differences(np.diff(qs, axis=0), turning))), axis=0)
    lowest, highest = (chain.lower - ways.min(axis=0)) / _TURN, (chain.upper - ways.max(axis=0)) / _TURN
    wanted = np.rint((near - ways[0]) / _TURN)
    turns = np.where(turning, np.clip(wanted, np.ceil(lowest), np.floor(highest)), 0.0)
    ways = ways + _TURN * turns
    fits = ((ways >= chain.lower) & (ways <= chain.upper)).all(axis=0) | ~turning
    return ways if fits.all() else None


def _choice(form: ClosedForm, rungs: TurnedRungs, tool: FreeTool, own: Indices, weights: Array) -> ToolChoice:
    """Return turns, branches and configurations at the poses that are reached, and the joint travel."""
    if len(own) == 0:
        return ToolChoice(0.0, (), (), ())
    qs, turns = rungs.qs[own], rungs.turns[own]
    rotations = rungs.poses.rotations[own] @ rotations_from_vectors(turns[:, None] * tool.axis)
    table, _ = solved_near(form, Poses(rungs.poses.positions[own], rotations), qs)
    travel = float(np.linalg.norm(weights * np.diff(rungs.qs, axis=0), axis=1).sum())
    branches = tuple(form.branch(code) for code in table.codes.tolist())
    return ToolChoice(travel, tuple(turns.tolist()), branches, tuple(map(tuple, widened(form.chain, qs)[1].tolist())))
