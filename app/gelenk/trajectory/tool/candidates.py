"""All configurations with the tip at poses turned about an axis of its own: in limits, regular, touching nothing."""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.errors import InvalidField, counted
from gelenk.ik.closed.branch_kernels import BranchTable
from gelenk.ik.closed.closed_form import ClosedForm, closed_form, elimination
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.search import in_pieces
from gelenk.ik.verdict.fixed import held_chain, widened
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.notations import rotations_from_vectors
from gelenk.robot.poses import Poses
from gelenk.trajectory.follow.ladder import Rungs
from gelenk.trajectory.tool.singularity import regular

_PIECE = 1024
"""Targets that one thread solves at a time."""


@dataclass(frozen=True, slots=True)
class TurnedCandidates:
    """Configurations of each rung, with the tip's turn, (M,), [rad], and the branch codes, (M,)."""

    rungs: Rungs
    turns: Array
    codes: Indices


@dataclass(frozen=True, slots=True)
class Clear:
    """What configurations are clear of: singularities, by the least σ of all joints of the arm, and contacts."""

    least: float
    cell: Cell | None = None

    def flags(self, form: ClosedForm, qs: Array) -> Flags:
        """Flag the clear ones of the configurations of a form; shape (N,)."""
        whole, qs = widened(form.chain, qs)
        clear = regular(whole.flat, qs, self.least)
        if self.cell is not None:
            clear[clear] = ~self.cell.touching(qs[clear])
        return clear


def candidates(form: ClosedForm, poses: Poses, axis: Array, turns: Array, clear: Clear) -> TurnedCandidates:
    """Return the configurations within the limits that are clear.

    Args:
        poses: One of each rung.
        axis: About which the tip turns, in its frame; shape (3,).
        turns: The angles to try, [rad]; shape (K,).
    """
    rows, count = np.arange(len(poses) * len(turns)), len(turns)
    turned = poses.rotations[:, None] @ rotations_from_vectors(turns[:, None] * axis)
    targets = Poses(np.repeat(poses.positions, count, axis=0), turned.reshape(-1, 3, 3))
    found: dict[int, tuple[Array, Indices, Indices]] = {}

    def solve(part: slice) -> None:
        each = Poses(targets.positions[part], targets.rotations[part])
        table = form.solve(each, mid_range(form.chain)[None])
        kept = clear.flags(form, table.qs)
        owners = np.repeat(rows[part], np.diff(table.firsts))
        found[part.start] = table.qs[kept], table.codes[kept], owners[kept]

    in_pieces(solve, len(rows), _PIECE, small=False)
    qs, codes, owners = (np.concatenate(each) for each in zip(*(found[k] for k in sorted(found)), strict=True))
    firsts = np.searchsorted(owners, count * np.arange(len(poses) + 1))
    return TurnedCandidates(Rungs(qs, firsts), turns[owners % count], codes)


def solved_near(form: ClosedForm, targets: Poses, qs: Array) -> tuple[BranchTable, Flags]:
    """Return the solution of each target nearest to a configuration, and which targets have one."""
    table = form.solve(targets, qs, most=1)
    return table, np.diff(table.firsts) > 0


_VALUES = 12
"""Values at which a joint is held."""
_SAMPLES = 64
_SAME = 1e-9
"""Largest difference of two columns of Jacobians that are the same motion, [m, rad]."""
_CLEAR, _CLEAR_SHARE = 0.01, 0.01
"""Distance from the joint limits, [rad or m], and at most this share of the range: so much do joints swing out between
two rungs."""


def forms_of(chain: Chain, axis: Array, start: Array | None) -> list[ClosedForm]:
    """Return the forms to choose from, with limits that leave a margin.

    Args:
        axis: About which the tip may turn, in its frame, or zero; shape (3,).
        start: Where the joints come from; a joint is also held there; shape (n,), [rad or m].

    Raises:
        InvalidField: There are none.
    """
    if len(chain) == 7:
        found = _held_forms(chain, axis, start)
    else:
        own = (closed_form(chain) or elimination(chain)) if len(chain) == 6 else None
        found = [] if own is None else [own]
    if not found:
        lacks = {6: "has no closed form", 7: "has none with one of its seven joints held"}
        reason = lacks.get(len(chain), f"has {counted(len(chain), 'joint')}")
        raise InvalidField("path", f"is for six or seven joints whose inverse has a closed form: this chain {reason}")
    return [_clear_of_limits(form) for form in found]


def _held_forms(chain: Chain, axis: Array, start: Array | None) -> list[ClosedForm]:
    """Hold the joint without which the others, and the free turn, are furthest from singularities; (7,) joints."""
    at = mid_range(chain) if start is None else start
    lower, upper = np.fmax(chain.lower, -np.pi), np.fmin(chain.upper, np.pi)
    _, rotations, Js = chain_jacobians(chain.flat, np.random.default_rng(0).uniform(lower, upper, (_SAMPLES, 7)))
    turns = np.concatenate((np.zeros((_SAMPLES, 3)), rotations @ axis), axis=1)[:, :, None]
    rest = [np.concatenate((np.delete(Js, j, axis=2), turns), axis=2) for j in range(7)]
    worths = [float(np.median(np.linalg.svd(J, compute_uv=False)[:, 5])) for J in rest]
    for j in sorted(range(7), key=lambda j: -worths[j]):
        values = np.append(at[j], np.linspace(lower[j], upper[j], _VALUES + 2)[1:-1])
        if min(np.abs(Js[:, :, j] - sign * turns[:, :, 0]).max() for sign in (1.0, -1.0)) <= _SAME:
            values = values[:1]  # The tool's free turn does all that this joint could.
        held = (closed_form(held_chain(chain, {chain.joint_names[j]: value})) for value in values.tolist())
        found = [form for form in held if form is not None]
        if found:
            return found
    return []


def _clear_of_limits(form: ClosedForm) -> ClosedForm:
    chain = form.chain
    with np.errstate(invalid="ignore"):
        margin = np.fmin(_CLEAR, _CLEAR_SHARE * (chain.upper - chain.lower))
    return replace(form, chain=replace(chain, lower=chain.lower + margin, upper=chain.upper - margin))
