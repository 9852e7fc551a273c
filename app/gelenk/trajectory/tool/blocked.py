"""Why a sequence of a tool's poses goes no further."""

from dataclasses import replace

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.errors import counted, quoted
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.verdict.fixed import HeldChain, widened
from gelenk.robot.arrays import Array
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.words import StopReason
from gelenk.trajectory.problem.result import PlanningFailure
from gelenk.trajectory.tool.candidates import Clear

_REASONS = ("out_of_reach", "joint_limit", "singularity", "collision", "branch_change")
"""From what stops soonest to what does last."""


def blocked(
    forms: list[ClosedForm], pose: Poses, axis: Array, turns: Array, clear: Clear, place: tuple[int, bool]
) -> PlanningFailure:
    """Return why a pose, the first that no form can reach, is not: by the form that comes furthest.

    `place` is the last pose of the request up to there, and whether it is this one; the limits are those of the forms.
    The failure's segment and time are left at zero.
    """
    found = [_blocked(form, pose, axis, turns, clear, place) for form in forms]
    furthest = max(found, key=lambda failure: _REASONS.index(failure.reason))
    chain = forms[0].chain
    if isinstance(chain, HeldChain):
        (name,) = set(chain.whole.joint_names) - set(chain.joint_names)
        detail = f"{furthest.detail}; {name} was held, at {counted(len(forms), 'value')}"
        return replace(furthest, detail=detail)
    return furthest


def _blocked(
    form: ClosedForm, pose: Poses, axis: Array, turns: Array, clear: Clear, place: tuple[int, bool]
) -> PlanningFailure:
    near, is_own = place
    where = f"way-point {near}" if is_own else f"the path between way-points {near} and {near + 1}"
    targets = Poses(
        np.repeat(pose.positions, len(turns), axis=0),
        pose.rotations @ rotations_from_vectors(turns[:, None] * axis),
    )
    seed, at = mid_range(form.chain)[None], f" at any turn of the tool ({len(turns)} tried)" if len(turns) > 1 else ""
    anywhere = form.solve(targets, seed, respect_limits=False).qs
    inside = form.solve(targets, seed).qs
    reason: StopReason
    joint = None
    if len(anywhere) == 0:
        reason, detail = "out_of_reach", f"{where} is out of reach{at}"
    elif len(inside) == 0:
        reason, (joint, beyond) = "joint_limit", _nearest_to_limits(form, anywhere)
        detail = f"{where} is beyond the joint limits{at}: in the best case {joint} by {beyond:.4g}"
    elif not len(regular := inside[Clear(clear.least).flags(form, inside)]):
        reason = "singularity"
        detail = f"{where} is near a singularity{at}: the smallest singular value is below {clear.least:g}"
    elif clear.cell is not None and not clear.flags(form, regular).any():
        reason = "collision"
        detail = f"{where} is too near to something{at}: in the best case {_best(form, regular, clear.cell)}"
    else:
        reason = "branch_change"
        before = near - 1 if is_own else near
        detail = f"no continuous step leads from way-point {before} to {before + 1}: the joints would have to jump"
    return PlanningFailure(reason, 0, 0.0, tuple(pose.positions[0].tolist()), joint, detail)


def _best(form: ClosedForm, qs: Array, cell: Cell) -> str:
    """Return the contact at the configuration that comes furthest from one."""
    nearest = cell.nearest(widened(form.chain, qs)[1])
    row = int(nearest.clearances.argmax())
    (a, b), distance = map(quoted, cell.names(int(nearest.pairs[row]))), float(nearest.distances[row])
    return f"{a} and {b} overlap by {-distance:.3g} m" if distance < 0.0 else f"{a} and {b} are {distance:.3g} m apart"


def _nearest_to_limits(form: ClosedForm, qs: Array) -> tuple[str, float]:
    """Return the joint that is furthest beyond a limit, and how far, where that is least, [rad or m]."""
    chain = form.chain
    beyond = np.maximum(chain.lower - qs, qs - chain.upper)
    row = int(beyond.max(axis=1).argmin())
    joint = int(beyond[row].argmax())
    return chain.joint_names[joint], float(beyond[row, joint])
