"""Fit of a table to a chain by base, tool, zeros and senses of the joints, and the remaining errors."""

import itertools
from dataclasses import dataclass, replace

import numpy as np

from gelenk.dh.compare.alignment import Alignment, Freedom, alignments
from gelenk.dh.compare.screws import (
    BASE_DIRECTIONS,
    STEPS,
    ChainScrews,
    TableAxes,
    Tables,
    chain_screws,
    fit,
    geometry,
    jacobians,
    parameters_of,
    polished,
)
from gelenk.kinematics.judge.judge import pinocchio_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.dh import MAX_LENGTH, DhTable
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses, inverse, nearest_rotation, transform
from gelenk.robot.robot import RobotModel

_INDEPENDENT = 1e-6
"""A unit change is independent of others if they leave more than this part of it."""
_ROUNDING = 1e-9
"""Errors that a plain base or tool may always cause, [m] and [rad]."""
_STEPS_WHERE_IT_FITS = 8
"""Aligned axes need only a few steps."""
_LOOSENESS = 30.0
"""Ratio of least-squares error to tolerance up to which a test through Pinocchio is worthwhile."""


@dataclass(frozen=True, slots=True)
class Subject:
    """A chain that tables are compared with.

    Attributes:
        senses: -1 where the multipliers of table and chain have opposite signs, else 1; shape (n,).
        tolerances: Position [m] and orientation [rad] within which poses count as equal.
        qs, expected: Configurations to compare, shape (N, variables), and Pinocchio's poses at these.
    """

    chain: Chain
    target: ChainScrews
    senses: Array
    tolerances: tuple[float, float]
    qs: Array
    expected: Poses

    def accepts(self, errors: tuple[float, float]) -> bool:
        """Return whether poses with these errors, [m] and [rad], count as equal."""
        return errors[0] <= self.tolerances[0] and errors[1] <= self.tolerances[1]

    @property
    def promising(self) -> float:
        """Root of the sum of squares up to which least squares makes a table a candidate."""
        return _LOOSENESS * max(self.tolerances) * float(np.sqrt(len(self.target)))

    def fewer(self, count: int) -> "Subject":
        """Return the subject with only the first `count` configurations."""
        fewer = Poses(self.expected.positions[:count], self.expected.rotations[:count])
        return replace(self, qs=self.qs[:count], expected=fewer)


@dataclass(frozen=True, slots=True)
class Placement:
    """A table fitted to a chain, with the given or found base and tool, and its largest errors, [m] and [rad].

    `offsets` (n,) [rad or m] are added to the variables; `signs` (n,), 1 or -1, are the senses of these.
    """

    table: DhTable
    offsets: Array
    signs: Array
    position_error: float
    orientation_error: float

    @property
    def errors(self) -> tuple[float, float]:
        """Position and orientation error, [m] and [rad]."""
        return self.position_error, self.orientation_error


def subject(robot: RobotModel, chain: Chain, tolerances: tuple[float, float], samples: int, seed: int) -> Subject:
    """Create a subject with random configurations: within ±π for revolute and ±1 m for prismatic joints."""
    target, reach = chain_screws(chain.flat), np.full(len(chain), np.pi)
    reach[chain.flat.joints[target.slides, 1]] = 1.0
    qs = np.random.default_rng(seed).uniform(-reach, reach, (samples, len(chain)))
    expected = pinocchio_poses(robot, chain, chain.tip_frame, qs, range(samples))
    return Subject(chain, target, np.ones(len(target)), tolerances, qs, expected)


def placed(
    on: Subject, table: DhTable, freedom: Freedom, strict: bool = False, senses: Array | None = None
) -> Placement | None:
    """Fit a table to a chain as closely as possible; if `strict`, return None if it does not fit.

    The rows match the chain's joints in number and type; a free base or tool is ignored. `senses` (n,) are -1 where a
    joint of the table is reversed, else 1; all 1 if None.
    """
    turned = on if senses is None else replace(on, senses=on.senses * senses)
    tables, costs = fitted(turned, table, freedom, strict)
    if not len(costs) or (strict and costs.min() > on.promising):
        return None
    nearest = _best(on, tables, costs, freedom)
    signs = nearest.signs[0] * on.senses
    offsets = (nearest.rows[0] - parameters_of(table))[np.arange(len(on.target)), variable_columns(on.target)]
    turns = np.remainder(offsets + np.pi, 2.0 * np.pi) - np.pi  # to within half a turn of zero
    offsets = np.where(on.target.slides, offsets, turns) + 0.0
    if len(on.chain) != len(on.target):
        signs, offsets = np.ones(len(on.chain)), np.zeros(len(on.chain))
    placement = _judged(on, replace(table, base=_within_reach(nearest.bases[0])), offsets, signs, freedom)
    return None if strict and not on.accepts(placement.errors) else placement


def _best(on: Subject, tables: Tables, costs: Array, freedom: Freedom) -> Tables:
    """The best-fitting table, polished; of equally good ones the one with the fewest reversed senses."""
    equally_good = np.flatnonzero(costs <= 3.0 * costs.min() + 1e-9)
    best = min(equally_good, key=lambda c: (-tables.signs[c].sum(), costs[c]))
    unknowns = unknowns_of(on.target, tables, freedom)[None]
    return polished(on.target, tables.only(np.array([best])), unknowns, with_tip=not freedom.tool)


def _judged(on: Subject, table: DhTable, offsets: Array, signs: Array, freedom: Freedom) -> Placement:
    """Measure a table through Pinocchio, finding a free tool; simplify base and tool if that adds no error."""
    bare = replace(table, base=np.eye(4), tool=np.eye(4))
    products = np.array([bare.pose(tuple(signs * q + offsets)) for q in on.qs])
    if freedom.tool:
        table = replace(table, tool=_within_reach(_tool(on, table.base @ products)))
    found = Placement(table, offsets, signs, *_errors(on, table, products))
    base = plain(table.base, on.tolerances) if freedom.base else table.base
    tool = plain(table.tool, on.tolerances) if freedom.tool else table.tool
    for plainer in (replace(table, base=base, tool=tool), replace(table, base=base), replace(table, tool=tool)):
        errors = _errors(on, plainer, products)
        costs_nothing = all(e <= max(_ROUNDING, 10.0 * before) for e, before in zip(errors, found.errors, strict=True))
        if on.accepts(errors) and costs_nothing:
            return Placement(plainer, offsets, signs, *errors)
    return found


def fitted(on: Subject, table: DhTable, freedom: Freedom, strict: bool) -> tuple[Tables, Array]:
    """Fit a table by least squares from each of its alignments; return tables and roots of their sums of squares."""
    tables = started(on, table, parameters_of(table)[None], freedom, strict=strict)
    if not len(tables.rows):
        return tables, np.empty(0)
    unknowns = np.tile(unknowns_of(on.target, tables, freedom), (len(tables.rows), 1))
    steps = _STEPS_WHERE_IT_FITS if strict else STEPS
    return fit(on.target, tables, unknowns, not freedom.tool, steps)


def started(on: Subject, table: DhTable, rows: Array, freedom: Freedom, strict: bool = False) -> Tables:
    """Align tables that differ from one in their numbers, with one result per alignment that fits.

    `table` gives convention, types, base (if it is not free) and tool of all, `rows` (C, n, 4) their numbers. If
    `strict`, tables that do not fit are left out.
    """
    bases = np.tile(np.eye(4) if freedom.base else table.base, (len(rows), 1, 1))
    unturned = Tables(table.convention, on.target.slides, np.ones(rows.shape[:2]), rows, bases, table.tool)
    found = geometry(unturned)
    starts: list[tuple[int, Alignment]] = []
    for c in range(len(rows)):
        axes = ChainScrews(found.twists[c], on.target.slides, found.tips[c])
        starts += [(c, alignment) for alignment in alignments(on.target, axes, freedom, on.senses, strict)]
    chosen = np.array([c for c, _ in starts], dtype=np.int64)
    tables = unturned.only(chosen)
    if not starts:
        return tables
    turned, bases = tables.rows.copy(), tables.bases.copy()
    for k, (_, alignment) in enumerate(starts):
        turned[k, :, 3] += alignment.offsets
        bases[k] = transform(np.zeros(3), alignment.base) @ bases[k]
    return tables._replace(rows=turned, bases=bases, signs=np.array([alignment.signs for _, alignment in starts]))


def variable_columns(target: ChainScrews) -> Indices:
    """Return the column of the joint variable in each row: θ, or d if prismatic; shape (n,)."""
    return np.where(target.slides, 2, 3)


def unknowns_of(target: ChainScrews, tables: Tables, freedom: Freedom) -> Indices:
    """Return the indices of the free unknowns: the base's, and the joint zeros that nothing else compensates.

    A free base absorbs the first variable's zero, a free tool the last one's, and of two collinear joints one absorbs
    the other's: absorbed zeros stay at 0.
    """
    n = len(target)
    base = np.arange(BASE_DIRECTIONS) if freedom.base else np.empty(0, dtype=np.int64)
    if not freedom.offsets:
        return base
    zeros = BASE_DIRECTIONS + 4 * np.arange(n) + variable_columns(target)
    movers = np.zeros((1, 4 * n, 6))
    movers[0, zeros - BASE_DIRECTIONS] = target.twists
    chain = TableAxes(target.twists[None], movers, target.tip[None])
    J = jacobians(tables.convention, chain, np.concatenate((base, zeros))[None], with_tip=not freedom.tool)[0]
    kept = independent(J[:, len(base) :].T, J[:, : len(base)].T)
    return np.concatenate((base, zeros[kept]))


def independent(vectors: Array, given: Array) -> Indices:
    """Return which vectors are independent of the given ones and of those before them; shapes (k, m), (g, m)."""
    basis: list[Array] = []
    kept = []
    for i, vector in enumerate(itertools.chain(given, vectors)):
        rest = vector.copy()
        for _ in range(2):  # twice, to remove rounding errors
            for direction in basis:
                rest -= (rest @ direction) * direction
        length = float(np.linalg.norm(rest))
        if length > _INDEPENDENT * max(1.0, float(np.linalg.norm(vector))):
            basis.append(rest / length)
            if i >= len(given):
                kept.append(i - len(given))
    return np.array(kept, dtype=np.int64)


def _errors(on: Subject, table: DhTable, products: Array) -> tuple[float, float]:
    """Largest distance [m] and angle [rad] between Pinocchio's poses and base · products of the rows · tool."""
    Ts = table.base @ products @ table.tool
    ps, Rs = np.ascontiguousarray(Ts[:, :3, 3]), np.ascontiguousarray(Ts[:, :3, :3])
    distance, angle, _ = pose_errors(ps, Rs, on.expected.positions, on.expected.rotations)
    return distance, angle


def _within_reach(T: Array) -> Array:
    """Clip a transform to the lengths that a table may have: absurd lengths lead to absurd bases."""
    return transform(np.clip(T[:3, 3], -MAX_LENGTH, MAX_LENGTH), T[:3, :3])


def _tool(on: Subject, Ts: Array) -> Array:
    """Tool that brings frames T_base_n closest to the tip: the mean over the frames."""
    tools = np.array([inverse(T) for T in Ts]) @ on.expected.matrices()
    U, _, Vt = np.linalg.svd(tools[:, :3, :3].mean(axis=0))
    return transform(tools[:, :3, 3].mean(axis=0), U @ np.diag([1.0, 1.0, np.linalg.det(U @ Vt)]) @ Vt)


def plain(T: Array, tolerances: tuple[float, float]) -> Array:
    """Simplify a transform within tolerances, [m] and per matrix entry.

    Coordinates near zero become zero, and a rotation near one that maps axes to axes becomes that one.
    """
    position = np.where(np.abs(T[:3, 3]) <= tolerances[0], 0.0, T[:3, 3])
    rounded = np.round(T[:3, :3])
    is_near = float(np.abs(T[:3, :3] - rounded).max()) <= tolerances[1]
    # Adding zero turns -0.0 into 0.0.
    return transform(position + 0.0, rounded + 0.0 if is_near else nearest_rotation(T[:3, :3]))
