"""A table laid on a chain: base, tool, zeros and senses of the joints, and how far the two are then apart."""

import itertools
from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.certify import pinocchio_poses
from gelenk.kinematics.comparison.alignment import Alignment, Freedom, alignments
from gelenk.kinematics.comparison.screws import (
    BASE_DIRECTIONS,
    Geometry,
    Screws,
    Tables,
    fit,
    geometry,
    jacobians,
    parameters_of,
    polished,
)
from gelenk.model.arrays import Array, Indices
from gelenk.model.chain import Chain
from gelenk.model.dh import MAX_LENGTH, DhTable
from gelenk.model.notations import pose_errors
from gelenk.model.poses import Poses, inverse, nearest_rotation, transform
from gelenk.model.robot import Robot

_INDEPENDENT = 1e-6
"""Part of a unit change that others must leave for it to count as a change of its own."""
_ROUNDING = 1e-9
"""Errors that a plain base or tool may always bring with it, [m] and [rad]."""
_STEPS_WHERE_IT_FITS = 8
_LOOSENESS = 30.0
"""How much larger than the tolerances least squares may be where a look through Pinocchio is still worth it."""


@dataclass(frozen=True, slots=True)
class Subject:
    """A chain that tables are compared with.

    Attributes:
        robot: The robot.
        chain: Base → tip.
        target: The screws of its joints.
        senses: 1 or -1 where a table turns the same way or the other by its own account (multipliers); shape (n,).
        tolerances: Position [m] and orientation [rad] within which poses count as equal.
        qs: Configurations to compare at; shape (N, variables).
        expected: Pinocchio's poses there.
    """

    robot: Robot
    chain: Chain
    target: Screws
    senses: Array
    tolerances: tuple[float, float]
    qs: Array
    expected: Poses

    def accepts(self, errors: tuple[float, float]) -> bool:
        """Whether poses so far apart count as equal."""
        return errors[0] <= self.tolerances[0] and errors[1] <= self.tolerances[1]

    @property
    def promising(self) -> float:
        """Sum of squares, its root, within which least squares speak for a table."""
        return _LOOSENESS * max(self.tolerances) * float(np.sqrt(len(self.target)))

    def fewer(self, count: int) -> "Subject":
        """The same with the first few configurations."""
        fewer = Poses(self.expected.positions[:count], self.expected.rotations[:count])
        return replace(self, qs=self.qs[:count], expected=fewer)


@dataclass(frozen=True, slots=True)
class Placement:
    """How a table lies on a chain.

    Attributes:
        table: The table with base and tool as they are given or found.
        offsets: Of each variable, added to it; shape (n,), [rad or m].
        signs: 1 or -1 each; shape (n,).
        position_error: Largest distance between the two, [m].
        orientation_error: Largest angle between the two, [rad].
    """

    table: DhTable
    offsets: Array
    signs: Array
    position_error: float
    orientation_error: float

    @property
    def errors(self) -> tuple[float, float]:
        """Both errors, [m] and [rad]."""
        return self.position_error, self.orientation_error


def subject(
    robot: Robot, chain: Chain, target: Screws, senses: Array, tolerances: tuple[float, float], samples: int, seed: int
) -> Subject:
    """A chain with random configurations to compare at: all the way round for turning joints, ±1 m for sliding ones."""
    reach = np.full(len(chain), np.pi)
    for slides, variable in chain.flat.joints:
        if slides:
            reach[variable] = 1.0
    qs = np.random.default_rng(seed).uniform(-reach, reach, (samples, len(chain)))
    expected = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(samples))
    return Subject(robot, chain, target, senses, tolerances, qs, expected)


def placed(
    on: Subject, table: DhTable, freedom: Freedom, strict: bool = False, senses: Array | None = None
) -> Placement | None:
    """Lay a table on a chain as well as it goes.

    Args:
        on: The chain.
        table: Its rows are the chain's joints in number and type; base and tool count where they are not free.
        freedom: What may be found.
        strict: Give None where it does not fit, rather than the nearest.
        senses: -1 where a joint of the table turns the other way; shape (n,). None turns where left out.
    """
    turned = on if senses is None else replace(on, senses=on.senses * senses)
    tables, costs = fitted(turned, table, freedom, strict)
    if not len(costs) or (strict and costs.min() > on.promising):
        return None
    nearest = _best(on, tables, costs, freedom)
    signs = nearest.signs[0] * on.senses
    offsets = (nearest.rows[0] - parameters_of(table))[np.arange(len(on.target)), variable_columns(on.target)]
    offsets = _nearest_zero(offsets, on.target)
    if len(on.chain) != len(on.target):
        signs, offsets = np.ones(len(on.chain)), np.zeros(len(on.chain))
    placement = _judged(on, replace(table, base=_within_reach(nearest.bases[0])), offsets, signs, freedom)
    return None if strict and not on.accepts(placement.errors) else placement


def _best(on: Subject, tables: Tables, costs: Array, freedom: Freedom) -> Tables:
    """The table that fits best, of those that fit as well the one with the fewest reversed senses, polished."""
    equally_good = np.flatnonzero(costs <= 3.0 * costs.min() + 1e-9)
    best = min(equally_good, key=lambda c: (-tables.signs[c].sum(), costs[c]))
    unknowns = unknowns_of(on.target, tables, freedom)[None]
    return polished(on.target, tables.only(np.array([best])), unknowns, with_tip=not freedom.tool)


def _judged(on: Subject, table: DhTable, offsets: Array, signs: Array, freedom: Freedom) -> Placement:
    """What Pinocchio says of a table, its tool found where that is free; base and tool as plain as costs nothing."""
    bare = replace(table, base=np.eye(4), tool=np.eye(4))
    products = np.array([bare.pose(tuple(signs * q + offsets)) for q in on.qs])
    if freedom.tool:
        table = replace(table, tool=_within_reach(_tool(on, table.base @ products)))
    found = Placement(table, offsets, signs, *_errors(on, table, products))
    for plainer in _plainer(table, on.tolerances, freedom):
        errors = _errors(on, plainer, products)
        costs_nothing = all(e <= max(_ROUNDING, 10.0 * before) for e, before in zip(errors, found.errors, strict=True))
        if on.accepts(errors) and costs_nothing:
            return Placement(plainer, offsets, signs, *errors)
    return found


def fitted(on: Subject, table: DhTable, freedom: Freedom, strict: bool) -> tuple[Tables, Array]:
    """Least squares from every alignment of a table: the tables, and the root of each one's sum of squares."""
    free_base = replace(table, base=np.eye(4)) if freedom.base else table
    tables = started(on, free_base, parameters_of(table)[None], freedom, strict=strict)
    if not len(tables.rows):
        return tables, np.empty(0)
    unknowns = np.tile(unknowns_of(on.target, tables, freedom), (len(tables.rows), 1))
    if strict:
        # Aligned axes need no long way.
        return fit(on.target, tables, unknowns, not freedom.tool, _STEPS_WHERE_IT_FITS)
    return fit(on.target, tables, unknowns, with_tip=not freedom.tool)


def started(on: Subject, table: DhTable, rows: Array, freedom: Freedom, strict: bool = False) -> Tables:
    """Tables that differ from one in their numbers, each aligned in every way that fits.

    Args:
        on: The chain.
        table: Convention, types, base and tool of all of them.
        rows: Numbers; shape (C, n, 4).
        freedom: What alignment may turn.
        strict: Leave out what does not fit.
    """
    plain = Tables(
        table.convention, on.target.slides, np.ones(rows.shape[:2]), rows, _repeated(table, rows), table.tool
    )
    found = geometry(plain)
    starts: list[tuple[int, Alignment]] = []
    for c in range(len(rows)):
        axes = Screws(found.twists[c], on.target.slides, found.tips[c])
        starts += [(c, way) for way in alignments(on.target, axes, freedom, on.senses, strict)]
    chosen = np.array([c for c, _ in starts], dtype=np.int64)
    tables = plain.only(chosen)
    if not starts:
        return tables
    turned, bases = tables.rows.copy(), tables.bases.copy()
    for k, (_, way) in enumerate(starts):
        turned[k, :, 3] += way.offsets
        bases[k] = transform(np.zeros(3), way.base) @ bases[k]
    return tables._replace(rows=turned, bases=bases, signs=np.array([way.signs for _, way in starts]))


def _repeated(table: DhTable, rows: Array) -> Array:
    return np.tile(table.base, (len(rows), 1, 1))


def variable_columns(target: Screws) -> Indices:
    """The parameter of each row that its joint's variable adds to: θ, or d where it slides; shape (n,)."""
    return np.where(target.slides, 2, 3)


def unknowns_of(target: Screws, tables: Tables, freedom: Freedom) -> Indices:
    """Numbers of the unknowns that are free: the base's, and of the joints' zeros those that nothing else makes up for.

    The first variable's zero goes into a free base, the last one's into a free tool, that of one of two collinear
    joints into the other's: those stay at zero.
    """
    n = len(target)
    base = np.arange(BASE_DIRECTIONS) if freedom.base else np.empty(0, dtype=np.int64)
    if not freedom.offsets:
        return base
    zeros = BASE_DIRECTIONS + 4 * np.arange(n) + variable_columns(target)
    movers = np.zeros((1, 4 * n, 6))
    movers[0, zeros - BASE_DIRECTIONS] = target.twists
    chain = Geometry(target.twists[None], movers, target.tip[None])
    J = jacobians(tables.convention, chain, np.concatenate((base, zeros))[None], with_tip=not freedom.tool)[0]
    kept = independent(J[:, len(base) :].T, J[:, : len(base)].T)
    return np.concatenate((base, zeros[kept]))


def independent(vectors: Array, given: Array) -> Indices:
    """Which vectors are no combination of given ones and of those before them; shapes (k, m), (g, m)."""
    basis: list[Array] = []
    kept = []
    for i, vector in enumerate(itertools.chain(given, vectors)):
        rest = vector.copy()
        for _ in range(2):  # once more, against what rounding leaves
            for direction in basis:
                rest -= (rest @ direction) * direction
        length = float(np.linalg.norm(rest))
        if length > _INDEPENDENT * max(1.0, float(np.linalg.norm(vector))):
            basis.append(rest / length)
            if i >= len(given):
                kept.append(i - len(given))
    return np.array(kept, dtype=np.int64)


def _nearest_zero(offsets: Array, target: Screws) -> Array:
    """Offsets, angles within half a turn of zero."""
    wrapped: Array = np.where(target.slides, offsets, np.remainder(offsets + np.pi, 2.0 * np.pi) - np.pi)
    return wrapped + 0.0


def _errors(on: Subject, table: DhTable, products: Array) -> tuple[float, float]:
    """Largest distance [m] and angle [rad] between Pinocchio's poses and base · product of the rows · tool."""
    Ts = table.base @ products @ table.tool
    ps, Rs = np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3])
    distance, angle, _ = pose_errors(ps, Rs, on.expected.positions, on.expected.rotations)
    return distance, angle


def _within_reach(T: Array) -> Array:
    """A transform no further away than a table may have it: absurd lengths ask for absurd bases."""
    return transform(np.clip(T[:3, 3], -MAX_LENGTH, MAX_LENGTH), T[:3, :3])


def _tool(on: Subject, Ts: Array) -> Array:
    """The tool that brings frames T_base_n nearest to the tip: the mean of what each of them needs."""
    tools = np.array([inverse(T) for T in Ts]) @ on.expected.matrices()
    U, _, Vt = np.linalg.svd(tools[:, :3, :3].mean(axis=0))
    return transform(tools[:, :3, 3].mean(axis=0), U @ np.diag([1.0, 1.0, np.linalg.det(U @ Vt)]) @ Vt)


def _plainer(table: DhTable, tolerances: tuple[float, float], freedom: Freedom) -> list[DhTable]:
    """The same with both, or one, of base and tool made plain, as far as they are free."""
    base = plain(table.base, tolerances) if freedom.base else table.base
    tool = plain(table.tool, tolerances) if freedom.tool else table.tool
    return [replace(table, base=base, tool=tool), replace(table, base=base), replace(table, tool=tool)]


def plain(T: Array, tolerances: tuple[float, float]) -> Array:
    """A transform whose coordinates and angles are made plain where they are so within tolerance.

    Coordinates next to zero become zero, and a rotation next to one that takes axes to axes becomes that one.
    """
    position = np.where(np.abs(T[:3, 3]) <= tolerances[0], 0.0, T[:3, 3])
    rounded = np.round(T[:3, :3])
    is_near = float(np.abs(T[:3, :3] - rounded).max()) <= tolerances[1]
    # Adding zero turns -0.0 into 0.0.
    return transform(position + 0.0, rounded + 0.0 if is_near else nearest_rotation(T[:3, :3]))
