"""The task space of the tip: the rows of the Jacobian that count, and the motions of a chain in them.

A direction can be missing because the arm never has it (a planar arm, or fewer joints than directions) or because it
is lost at one configuration. The chain's structure distinguishes the two: its motions at random configurations, which
are almost surely regular.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians
from gelenk.kinematics.velocity.jacobian import in_reference
from gelenk.kinematics.velocity.subspaces import rounding, subspaces
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

STRUCTURAL_TOLERANCE = 1e-9
"""Relative singular value above which a direction counts as one in which the arm can move."""
_TRIALS = 8


@dataclass(frozen=True)
class TaskSpace:
    """The rows of the Jacobian that count, and the length that makes radians comparable with metres.

    Attributes:
        task: The m directions that count, in the order of the rows.
        characteristic_length: Factor of the angular rows, [m]; None leaves metres and radians mixed.
        reference: Reference of the rows. `local_world_aligned`: base axes, at the tip. `local`: tip axes, at the tip.
            `world`: base axes, at the point of the tip's body that coincides with the base's origin.
    """

    task: Task = FULL_POSE
    characteristic_length: float | None = None
    reference: Reference = "local_world_aligned"

    def __len__(self) -> int:
        return len(self.task)

    @cached_property
    def rows(self) -> list[int]:
        """Indices of the rows that count, in the order of the task."""
        return [DIRECTIONS.index(direction) for direction in self.task.directions]

    @cached_property
    def turns(self) -> int:
        """Number of angular rows."""
        return sum(row >= 3 for row in self.rows)

    @cached_property
    def scales(self) -> Array:
        """Factor of each row; shape (m,)."""
        return np.array([1.0 if row < 3 else self.characteristic_length or 1.0 for row in self.rows])

    @cached_property
    def is_of_the_geometric_rows(self) -> bool:
        """Whether the same rows in the base's axes at the tip have the same singular values."""
        linear = len(self) - self.turns
        whole_halves = linear in {0, 3} and self.turns in {0, 3}
        return self.reference == "local_world_aligned" or (self.reference == "local" and whole_halves)

    def jacobians(self, chain: Chain, qs: Array) -> Array:
        """Compute J at configurations of shape (N, n); shape (N, m, n)."""
        return self.picked(jacobians_with_terms(chain, qs, self.reference)[0])

    def with_rounding(self, chain: Chain, qs: Array) -> tuple[Array, Array]:
        """Compute J, shape (N, m, n), and the level up to which its singular values are rounding, shape (N,).

        Rounded angles in a description cause small motion in directions that the tip never has. It is removed, as it
        would matter where the other directions vanish.
        """
        whole, terms = jacobians_with_terms(chain, qs, self.reference)
        fixed = structure(chain, self.task, self.reference)
        Js, never = self.picked(whole), self.never(fixed)
        Js = Js - never @ (never.T @ Js) - (Js @ fixed.idle) @ fixed.idle.T
        return np.asarray(Js), rounding(terms) * self.scales.max()

    def never(self, fixed: "ChainStructure") -> Array:
        """Return an orthonormal basis of the directions that the tip never has, in scaled rows; shape (m, k)."""
        if self.characteristic_length is None:
            return fixed.never
        return np.asarray(np.linalg.qr(fixed.never / self.scales[:, None])[0])

    def picked(self, Js: Array) -> Array:
        """Select and scale the rows that count of full Jacobians; shape (N, 6, n) → (N, m, n)."""
        return np.asarray(Js[:, self.rows] * self.scales[:, None])

    def hessians(self, chain: Chain, qs: Array) -> Array:
        """Compute ∂J/∂q of these rows: [:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, m, n, n)."""
        Hs = hessians_in_reference(chain, qs, self.reference)
        return np.asarray(Hs[:, self.rows] * self.scales[:, None, None])

    def twists(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Convert directions in the rows to unit twists of the tip in the base's axes; shape (m, k) → (6, k)."""
        vectors, p = self._in_base_axes(directions / self.scales[:, None], chain, q)
        if self.reference == "world":
            vectors[:3] -= np.cross(p, vectors[3:], axisb=0, axisc=0)
        return np.asarray(vectors / np.linalg.norm(vectors, axis=0))

    def wrenches(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Convert directions in the rows to unit wrenches at the tip in the base's axes; shape (m, k) → (6, k)."""
        vectors, p = self._in_base_axes(directions * self.scales[:, None], chain, q)
        if self.reference == "world":
            vectors[3:] -= np.cross(p, vectors[:3], axisb=0, axisc=0)
        return np.asarray(vectors / np.linalg.norm(vectors, axis=0))

    def _in_base_axes(self, parts: Array, chain: Chain, q: Array) -> tuple[Array, Array]:
        """All six components along the base's axes, shape (6, k), and the tip's position, shape (3,)."""
        vectors = np.zeros((6, parts.shape[1]))
        vectors[self.rows] = parts
        positions, rotations, _ = chain_jacobians(chain.flat, q[None])
        if self.reference == "local":
            vectors = (rotations[0] @ vectors.reshape(2, 3, -1)).reshape(6, -1)
        return vectors, positions[0]


FULL_SPACE = TaskSpace()


def jacobians_with_terms(chain: Chain, qs: Array, reference: Reference) -> tuple[Array, Array]:
    """Compute geometric Jacobians in a reference, (N, 6, n), and the terms to which rounding is relative, (N, 9, n).

    The terms are J itself and three rows that scale with the tip's distance from the base, because z × (p - o) rounds
    at that scale even where it vanishes because the tip is on the axis.
    """
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    levers = Js[:, 3:] * (2.0 * np.linalg.norm(positions, axis=1)[:, None, None])
    Js, _ = in_reference(Poses(positions, rotations), Js, None, reference)
    return Js, np.concatenate((Js, levers), axis=1)


def hessians_in_reference(chain: Chain, qs: Array, reference: Reference) -> Array:
    """Compute ∂J/∂q of geometric Jacobians in a reference: [:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, 6, n, n)."""
    Hs: Array | None = chain_hessians(chain.flat, qs)
    if reference != "local_world_aligned":
        positions, rotations, Js = chain_jacobians(chain.flat, qs)
        _, Hs = in_reference(Poses(positions, rotations), Js, Hs, reference)
    return np.asarray(Hs)


@dataclass(frozen=True, slots=True)
class ChainStructure:
    """Properties of a chain at all but its singular configurations.

    Attributes:
        rank: Rank of J at random configurations.
        moving: Orthonormal basis of the directions that the tip has, all configurations together; shape (m, m - k).
        never: Orthonormal basis of the directions that the tip never has, in unscaled rows; shape (m, k).
        idle: Orthonormal basis of the joint velocities that leave the tip at rest everywhere; shape (n, l).
    """

    rank: int
    moving: Array
    never: Array
    idle: Array


@lru_cache(maxsize=1024)
def structure(chain: Chain, task: Task, reference: Reference = "local_world_aligned") -> ChainStructure:
    """Find the structure of a chain from random configurations, the same in each call."""
    # With a single row, each configuration contributes at most one independent joint velocity.
    trials = _TRIALS + 2 * len(chain)
    space = TaskSpace(task, None, reference)
    whole, terms = jacobians_with_terms(chain, random_configurations(chain, trials), reference)
    Js = space.picked(whole)
    m, n = Js.shape[1:]
    everything = terms.reshape(trials * terms.shape[1], n)
    rank = max(subspaces(J, STRUCTURAL_TOLERANCE, everything).rank for J in Js)
    beside = subspaces(_triangle(Js.transpose(1, 0, 2).reshape(m, trials * n).T).T, STRUCTURAL_TOLERANCE, everything)
    below = subspaces(_triangle(Js.reshape(trials * m, n)), STRUCTURAL_TOLERANCE, everything)
    # A value near the tolerance may count at one configuration but not in all of them together.
    rank = min(rank, beside.rank, below.rank)
    moving = aligned_basis(beside.range, STRUCTURAL_TOLERANCE)
    return ChainStructure(rank, moving, aligned_basis(beside.left_kernel), aligned_basis(below.kernel))


def _triangle(rows: Array) -> Array:
    """R of the QR decomposition: it has fewer rows, but the same kernel and singular values."""
    return np.asarray(np.linalg.qr(rows, mode="r")) if rows.size else rows


def random_configurations(chain: Chain, count: int, seed: int = 0) -> Array:
    """Draw configurations within ±π for revolute and ±1 m for prismatic joints, ignoring limits; shape (count, n)."""
    reach = np.where(slides(chain), 1.0, np.pi)
    return np.random.default_rng(seed).uniform(-reach, reach, (count, len(chain)))


def slides(chain: Chain) -> Flags:
    """Return which variables move a prismatic joint; shape (n,)."""
    sliding = np.zeros(len(chain), dtype=bool)
    sliding[chain.flat.joints[chain.flat.joints[:, 0] == 1, 1]] = True
    return sliding


def aligned_basis(basis: Array, snap: float = 0.0) -> Array:
    """Return a basis of the same space, as close to the coordinate axes as possible, with positive largest entries.

    The columns, shape (m, k), are orthonormal. A deviation of up to `snap` from a space spanned by coordinate axes
    counts as rounding.
    """
    if basis.size == 0:
        return basis
    left = basis @ basis.T
    if np.abs(left - np.rint(left)).max() < snap:
        left = np.rint(left)
    vectors = np.empty_like(basis)
    for k in range(basis.shape[1]):
        # Take the first of equal entries, even if rounding makes them differ.
        column = left[:, int(np.argmax(np.round(np.diag(left), 9)))]
        vectors[:, k] = column / np.linalg.norm(column)
        left = left - np.outer(vectors[:, k], vectors[:, k] @ left)
        left = left - np.outer(left @ vectors[:, k], vectors[:, k])
    largest = vectors[np.argmax(np.abs(vectors), axis=0), range(basis.shape[1])]
    return vectors * np.where(largest < 0.0, -1.0, 1.0) + 0.0
