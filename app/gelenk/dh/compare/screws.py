"""Joints as screws: a chain is given by its joint axes and the pose of its tip, all at position zero.

U(q) = exp(S₁ q₁) ⋯ exp(S_n q_n) U(0), so two chains have equal poses everywhere if and only if their screws and their
tips at zero are equal [LynchPark2017, 4.1]: move one joint at a time. Like a joint, every DH parameter moves all that
follows it about or along an axis of its own; so does a base, in six directions. Such a motion V changes a screw S by
the bracket [V, S], and finding the unknowns is a least-squares problem.

Twists are linear before angular; batches of tables come first in every shape.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, NamedTuple

import numpy as np

from gelenk.dh.tables.screws import screws_of_chain
from gelenk.robot.arrays import Array, Flags, Indices, cross_matrices
from gelenk.robot.chain import FlatChain
from gelenk.robot.dh import Convention, DhTable
from gelenk.robot.notations import rotations_from_vectors, vectors_from_rotations

PARAMETERS: tuple[Literal["a"], Literal["alpha"], Literal["d"], Literal["theta"]] = ("a", "alpha", "d", "theta")
BASE_DIRECTIONS = 6
"""Number of unknowns of the base; they come before the parameters, which follow row by row."""

STEPS = 30
_CONVERGED = 1e-13
"""Root of the sum of squares below which a fit is complete, [m, rad]."""
_SETTLED = 1e-6
"""A step that decreases the sum of squares by at most this share has settled: on approach to zero it falls faster."""
_FIRST_DAMPING = 1e-4
_POLISHING_STEPS = 8
_ROUNDING = 1e-15
_ASTRAY = 1e9
_UNDETERMINED = 1e-9
"""Relative singular value below which a direction counts as undetermined."""


@dataclass(frozen=True)
class ChainScrews:
    """A chain at position zero: unit twists in the base (n, 6), which joints slide (n,), and T_base_tip (4, 4)."""

    twists: Array
    slides: Flags
    tip: Array

    def __len__(self) -> int:
        return len(self.twists)

    @cached_property
    def directions(self) -> Array:
        """Unit vectors along the axes; shape (n, 3)."""
        return np.where(self.slides[:, None], self.twists[:, :3], self.twists[:, 3:])

    @cached_property
    def points(self) -> Array:
        """Point of each axis nearest to the base's origin, zero if prismatic; shape (n, 3), [m]."""
        return np.cross(self.twists[:, 3:], self.twists[:, :3])


class Tables(NamedTuple):
    """C tables of the same form with different numbers.

    Attributes:
        slides: Which rows are prismatic; shape (n,).
        signs: Factor 1 or -1 of each joint's motion; shape (C, n).
        rows: a, α, d, θ of each row, [m] and [rad]; shape (C, n, 4).
        bases, tool: T_base_0, shape (C, 4, 4), and T_n_tool of all tables, shape (4, 4).
    """

    convention: Convention
    slides: Flags
    signs: Array
    rows: Array
    bases: Array
    tool: Array

    def only(self, chosen: Indices) -> "Tables":
        """Select some tables."""
        return self._replace(signs=self.signs[chosen], rows=self.rows[chosen], bases=self.bases[chosen])


class TableAxes(NamedTuple):
    """Twists of the joints (C, n, 6), and T_base_tool (C, 4, 4), of C tables at zero, n rows each.

    `movers` (C, 4 n, 6) are the twists that changes of the parameters cause.
    """

    twists: Array
    movers: Array
    tips: Array


def numbers_of(table: DhTable) -> Array:
    """Return a, α, d, θ as written in the table, without mimic offsets; shape (n, 4)."""
    return np.array([[row.a, row.alpha, row.d, row.theta] for row in table.joints])


def parameters_of(table: DhTable) -> Array:
    """Return a, α, d, θ of each row, including the offsets of mimic rows; shape (n, 4)."""
    rows = numbers_of(table)
    for i, row in enumerate(table.joints):
        if row.mimic is not None:
            rows[i, 2 if row.type == "prismatic" else 3] += row.mimic.offset
    return rows


def chain_screws(flat: FlatChain) -> ChainScrews:
    """Compute the screws of a chain's joints, each mimic joint as a joint of its own, at its offset."""
    found = screws_of_chain(flat)
    return ChainScrews(np.roll(found.space, 3, axis=1), flat.joints[:, 0] == 1, found.home)


def geometry(tables: Tables) -> TableAxes:
    """Compute twists of joints and parameters, and tips, of tables at zero."""
    T = tables.bases
    twists, movers = [], []
    for i, slides in enumerate(tables.slides):
        a, alpha, d, theta = tables.rows[:, i].T
        along_x, along_z = _about_x(alpha, a), _about_z(theta, d)
        if tables.convention == "modified":
            about_x = _twists(T, 0, True), _twists(T, 0, False)
            T = T @ along_x
        about_z = _twists(T, 2, True), _twists(T, 2, False)
        twists.append(about_z[0] if slides else about_z[1])
        T = T @ along_z
        if tables.convention == "standard":
            about_x = _twists(T, 0, True), _twists(T, 0, False)
            T = T @ along_x
        movers += [*about_x, *about_z]
    return TableAxes(np.stack(twists, axis=1) * tables.signs[..., None], np.stack(movers, axis=1), T @ tables.tool)


def residuals(target: ChainScrews, found: TableAxes, with_tip: bool) -> Array:
    """Compute differences of the screws, and of the tips if they count; shape (C, 6 n) or (C, 6 n + 6), [m, rad]."""
    parts = [(found.twists - target.twists).reshape(len(found.twists), -1)]
    if with_tip:
        Rs = np.ascontiguousarray(found.tips[:, :3, :3] @ target.tip[:3, :3].T)
        parts += [found.tips[:, :3, 3] - target.tip[:3, 3], vectors_from_rotations(Rs)]
    return np.concatenate(parts, axis=1)


def jacobians(convention: Convention, found: TableAxes, unknowns: Indices, with_tip: bool) -> Array:
    """Compute derivatives of the residuals by the unknowns with indices (C, k); shape (C, 6 n or 6 n + 6, k)."""
    C, n = found.twists.shape[:2]
    motions = np.concatenate((np.broadcast_to(np.eye(6), (C, 6, 6)), found.movers), axis=1)
    columns = np.swapaxes(np.take_along_axis(motions, unknowns[..., None], axis=1), 1, 2)
    brackets = -_adjoint(found.twists) @ columns[:, None]
    moves = moved_joints(convention, n)[unknowns]
    J = (brackets * np.swapaxes(moves, 1, 2)[:, :, None]).reshape(C, 6 * n, -1)
    if not with_tip:
        return J
    p = found.tips[:, :3, 3]
    linear = columns[:, :3] - cross_matrices(p) @ columns[:, 3:]
    return np.concatenate((J, linear, columns[:, 3:]), axis=1)


def moved_joints(convention: Convention, n: int) -> Flags:
    """Return which joints each unknown moves; shape (6 + 4 n, n)."""
    rows = np.repeat(np.arange(n), 4)
    before_own = np.tile([convention == "modified"] * 2 + [False] * 2, n)
    joints = np.arange(n)
    behind = (joints > rows[:, None]) | ((joints == rows[:, None]) & before_own[:, None])
    return np.concatenate((np.ones((BASE_DIRECTIONS, n), dtype=bool), behind))


def fit(
    target: ChainScrews, tables: Tables, unknowns: Indices, with_tip: bool, steps: int = STEPS
) -> tuple[Tables, Array]:
    """Fit tables to a chain by least squares over their unknowns, whose indices have shape (C, k).

    Levenberg's method on all tables side by side: a step is taken if it reduces the sum of squares, else damped more.
    Unknowns that do not affect the residuals stay unchanged. Unless the tips count, the tool is free. The second result
    is the root of each table's sum of squares, [m, rad]; shape (C,).
    """
    found = geometry(tables)
    r = residuals(target, found, with_tip)
    costs = np.einsum("ci,ci->c", r, r)
    if unknowns.shape[1] == 0:
        return tables, np.sqrt(costs)
    J = jacobians(tables.convention, found, unknowns, with_tip)
    dampings = np.full(len(costs), _FIRST_DAMPING)
    for _ in range(steps):
        trial = _moved(tables, unknowns, _damped_steps(J, r, dampings))
        found = geometry(trial)
        trial_r = residuals(target, found, with_tip)
        trial_costs = np.einsum("ci,ci->c", trial_r, trial_r)
        better = trial_costs < costs
        settled = ~better | (costs - trial_costs <= _SETTLED * costs)
        tables = tables._replace(
            rows=np.where(better[:, None, None], trial.rows, tables.rows),
            bases=np.where(better[:, None, None], trial.bases, tables.bases),
        )
        costs, r = np.where(better, trial_costs, costs), np.where(better[:, None], trial_r, r)
        if np.all((np.sqrt(costs) < _CONVERGED) | (settled & (dampings > 1.0)) | (settled & better)):
            break
        J = np.where(better[:, None, None], jacobians(tables.convention, found, unknowns, with_tip), J)
        dampings = np.where(better, np.maximum(0.02 * dampings, 1e-15), np.maximum(10.0 * dampings, 1e-6))
    return tables, np.sqrt(costs)


def polished(target: ChainScrews, tables: Tables, unknowns: Indices, with_tip: bool) -> Tables:
    """Refine a single table by undamped steps, and return the best one found.

    Damping loses digits where axes barely determine an unknown, such as two axes a millimetre apart: there a step first
    leaves the floor of a curved valley, and the next one returns to it.
    """
    best, least = tables, np.inf
    for _ in range(_POLISHING_STEPS if unknowns.size else 0):
        found = geometry(tables)
        r = residuals(target, found, with_tip)
        size = float(np.linalg.norm(r))
        if size < least:
            best, least = tables, size
        if not _ROUNDING < size < _ASTRAY:
            break
        J = jacobians(tables.convention, found, unknowns, with_tip)
        step = np.linalg.lstsq(J[0], -r[0], rcond=_UNDETERMINED)[0]
        tables = _moved(tables, unknowns, step[None])
    return best


def _damped_steps(J: Array, r: Array, dampings: Array) -> Array:
    """Steps of damped least squares, with columns scaled by their length; shape (C, k)."""
    H = np.swapaxes(J, 1, 2) @ J
    diagonals = np.einsum("cii->ci", H)
    floors = 1e-9 * diagonals.max(axis=1, initial=0.0, keepdims=True) + 1e-300
    k = H.shape[1]
    damped = H + np.eye(k) * (dampings[:, None] * (diagonals + floors) + floors * 1e-3)[:, None]
    g = np.swapaxes(J, 1, 2) @ r[..., None]
    return -np.linalg.solve(damped, g)[..., 0]


def _moved(tables: Tables, unknowns: Indices, steps: Array) -> Tables:
    C, n = tables.rows.shape[:2]
    full = np.zeros((C, BASE_DIRECTIONS + 4 * n))
    np.put_along_axis(full, unknowns, steps, axis=1)
    motions = np.tile(np.eye(4), (C, 1, 1))
    motions[:, :3, :3] = rotations_from_vectors(np.ascontiguousarray(full[:, 3:6]))
    motions[:, :3, 3] = full[:, :3]
    rows = tables.rows + full[:, BASE_DIRECTIONS:].reshape(C, n, 4)
    return tables._replace(rows=rows, bases=motions @ tables.bases)


def _twists(Ts: Array, axis: int, slides: bool) -> Array:
    """Twists along or about a coordinate axis of frames; shape (C, 4, 4) → (C, 6)."""
    direction = Ts[:, :3, axis]
    twists = np.zeros((len(Ts), 6))
    if slides:
        twists[:, :3] = direction
    else:
        x, y, z = Ts[:, 0, 3], Ts[:, 1, 3], Ts[:, 2, 3]
        # Written out: NumPy's cross product spends more time checking its arguments than multiplying them.
        twists[:, 0] = y * direction[:, 2] - z * direction[:, 1]
        twists[:, 1] = z * direction[:, 0] - x * direction[:, 2]
        twists[:, 2] = x * direction[:, 1] - y * direction[:, 0]
        twists[:, 3:] = direction
    return twists


def _adjoint(twists: Array) -> Array:
    """Matrices of the Lie bracket [V, ·] of twists; shape (…, 6) → (…, 6, 6)."""
    ad = np.zeros((*twists.shape[:-1], 6, 6))
    angular = cross_matrices(twists[..., 3:])
    ad[..., :3, :3], ad[..., 3:, 3:], ad[..., :3, 3:] = angular, angular, cross_matrices(twists[..., :3])
    return ad


def _about_z(theta: Array, d: Array) -> Array:
    Ts = np.zeros((len(theta), 4, 4))
    Ts[:, 0, 0] = Ts[:, 1, 1] = np.cos(theta)
    Ts[:, 1, 0] = np.sin(theta)
    Ts[:, 0, 1] = -Ts[:, 1, 0]
    Ts[:, 2, 2] = Ts[:, 3, 3] = 1.0
    Ts[:, 2, 3] = d
    return Ts


def _about_x(alpha: Array, a: Array) -> Array:
    Ts = np.zeros((len(alpha), 4, 4))
    Ts[:, 1, 1] = Ts[:, 2, 2] = np.cos(alpha)
    Ts[:, 2, 1] = np.sin(alpha)
    Ts[:, 1, 2] = -Ts[:, 2, 1]
    Ts[:, 0, 0] = Ts[:, 3, 3] = 1.0
    Ts[:, 0, 3] = a
    return Ts
