"""The space in which a task moves the tip: the rows of the Jacobian that count, and what a chain can do in them.

A direction can be missing because the arm never has it (a planar arm, or fewer joints than directions) or because it
is lost at one configuration. The two are distinguished by the structure of the chain: what it can do at random
configurations, which are almost surely regular.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from gelenk.kinematics.ik.task import FULL_POSE, Task
from gelenk.kinematics.ik.words import DIRECTIONS
from gelenk.kinematics.jacobian import Reference
from gelenk.kinematics.kernels import chain_hessians, chain_jacobians
from gelenk.kinematics.subspaces import rounding, subspaces
from gelenk.model.arrays import Array, Flags
from gelenk.model.chain import Chain

STRUCTURAL_TOLERANCE = 1e-9
"""Singular value, relative to the largest, above which a direction counts as one that the arm can have."""
_TRIALS = 8


@dataclass(frozen=True)
class TaskSpace:
    """The rows of the Jacobian that count, and the length that makes radians comparable with metres.

    Attributes:
        task: Which directions count, in the order of the rows; m of them.
        characteristic_length: What angular rows are multiplied by, [m]; None leaves metres and radians mixed.
        reference: Whose rows they are. `local_world_aligned`: along and about the base's axes, at the tip. `local`:
            the tip's axes. `world`: the base's axes, of the point of the tip's body that passes the base's origin.
    """

    task: Task = FULL_POSE
    characteristic_length: float | None = None
    reference: Reference = "local_world_aligned"

    def __len__(self) -> int:
        return len(self.task)

    @cached_property
    def rows(self) -> list[int]:
        """Which rows of a Jacobian in the reference count, in their order."""
        return [DIRECTIONS.index(direction) for direction in self.task.directions]

    @cached_property
    def turns(self) -> int:
        """How many of them are angular."""
        return sum(row >= 3 for row in self.rows)

    @cached_property
    def scales(self) -> Array:
        """The factor of each direction; shape (m,)."""
        return np.array([1.0 if row < 3 else self.characteristic_length or 1.0 for row in self.rows])

    @cached_property
    def is_of_the_geometric_rows(self) -> bool:
        """Whether singular values are those of the same rows in the base's axes at the tip."""
        linear = len(self) - self.turns
        whole_halves = linear in {0, 3} and self.turns in {0, 3}
        return self.reference == "local_world_aligned" or (self.reference == "local" and whole_halves)

    def jacobians(self, chain: Chain, qs: Array) -> Array:
        """J at configurations of shape (N, n); shape (N, m, n)."""
        return self.picked(jacobians_with_terms(chain, qs, self.reference)[0])

    def with_rounding(self, chain: Chain, qs: Array) -> tuple[Array, Array]:
        """J, shape (N, m, n), and singular values that may be none but rounding of what J is the rest of; (N,).

        What a description's rounded angles make of a direction that the tip has nowhere is taken off: it is large
        where the others vanish.
        """
        whole, terms = jacobians_with_terms(chain, qs, self.reference)
        fixed = structure(chain, self.task, self.reference)
        Js, never = self.picked(whole), self.never(fixed)
        Js = Js - never @ (never.T @ Js) - (Js @ fixed.idle) @ fixed.idle.T
        return np.asarray(Js), rounding(terms) * self.scales.max()

    def never(self, fixed: "Structure") -> Array:
        """An orthonormal basis of the directions that the tip has nowhere, of the scaled rows; shape (m, k)."""
        if self.characteristic_length is None:
            return fixed.never
        return np.asarray(np.linalg.qr(fixed.never / self.scales[:, None])[0])

    def picked(self, Js: Array) -> Array:
        """The rows that count of whole Jacobians in the reference; shape (N, 6, n) → (N, m, n)."""
        return np.asarray(Js[:, self.rows] * self.scales[:, None])

    def hessians(self, chain: Chain, qs: Array) -> Array:
        """∂J/∂q of the same: [:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, m, n, n)."""
        Hs = hessians_in_reference(chain, qs, self.reference)
        return np.asarray(Hs[:, self.rows] * self.scales[:, None, None])

    def twists(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Directions of the rows, shape (m, k), as unit twists of the tip in the base's axes; shape (6, k)."""
        vectors, p = self._in_base_axes(directions / self.scales[:, None], chain, q)
        if self.reference == "world":
            vectors[:3] -= np.cross(p, vectors[3:], axisb=0, axisc=0)
        return np.asarray(vectors / np.linalg.norm(vectors, axis=0))

    def wrenches(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Directions of the rows, shape (m, k), as unit wrenches at the tip in the base's axes; shape (6, k)."""
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
    """Jacobians whose columns are twists in a reference, and these with what their linear rows are sums of.

    Rounding is relative to the terms: to the tip's distance from the base where z × (p - o) vanishes because the tip is
    on the axis.

    Returns:
        Shapes (N, 6, n) and (N, 9, n).
    """
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    levers = Js[:, 3:] * (2.0 * np.linalg.norm(positions, axis=1)[:, None, None])
    if reference == "local":
        Js = np.concatenate((_turned(rotations, Js[:, :3]), _turned(rotations, Js[:, 3:])), axis=1)
    elif reference == "world":
        Js[:, :3] += np.cross(positions[:, :, None], Js[:, 3:], axis=1)
    return Js, np.concatenate((Js, levers), axis=1)


def hessians_in_reference(chain: Chain, qs: Array, reference: Reference) -> Array:
    """∂J/∂q of these: [:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, 6, n, n)."""
    Hs = chain_hessians(chain.flat, qs)
    if reference == "local_world_aligned":
        return Hs
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    linear, angular = Js[:, :3], Js[:, 3:]
    if reference == "local":
        # ∂(RᵀJ)/∂q_j = Rᵀ(∂J/∂q_j - ω_j × J).
        omegas = angular[:, :, None, :]
        halves = [_turned(rotations, Hs[:, :3] - np.cross(omegas, linear[:, :, :, None], axis=1))]
        halves.append(_turned(rotations, Hs[:, 3:] - np.cross(omegas, angular[:, :, :, None], axis=1)))
        return np.concatenate(halves, axis=1)
    # ∂(v + p × ω)/∂q_j = ∂v/∂q_j + v_j × ω + p × ∂ω/∂q_j, because ∂p/∂q_j = v_j.
    Hs[:, :3] += np.cross(linear[:, :, None, :], angular[:, :, :, None], axis=1)
    Hs[:, :3] += np.cross(positions[:, :, None, None], Hs[:, 3:], axis=1)
    return Hs


def _turned(rotations: Array, rows: Array) -> Array:
    """Rᵀ times rows of shape (N, 3, …)."""
    return np.asarray(np.einsum("brk,br...->bk...", rotations, rows))


@dataclass(frozen=True, slots=True)
class Structure:
    """Properties of a chain that hold at all but its singular configurations.

    Attributes:
        rank: The rank of J at random configurations.
        never: Directions that the tip has nowhere, orthonormal, of unscaled rows; shape (m, k).
        idle: Joint velocities that leave the tip at rest everywhere, orthonormal; shape (n, l).
    """

    rank: int
    never: Array
    idle: Array


@lru_cache(maxsize=1024)
def structure(chain: Chain, task: Task, reference: Reference = "local_world_aligned") -> Structure:
    """The structure of a chain, from random configurations that are the same at each call."""
    # With one row each, a configuration gives at most one joint velocity that moves the tip.
    trials = _TRIALS + 2 * len(chain)
    space = TaskSpace(task, None, reference)
    whole, terms = jacobians_with_terms(chain, random_configurations(chain, trials), reference)
    Js = space.picked(whole)
    m, n = Js.shape[1:]
    everything = terms.reshape(trials * terms.shape[1], n)
    rank = max(subspaces(J, STRUCTURAL_TOLERANCE, everything).rank for J in Js)
    beside = subspaces(_triangle(Js.transpose(1, 0, 2).reshape(m, trials * n).T).T, STRUCTURAL_TOLERANCE, everything)
    below = subspaces(_triangle(Js.reshape(trials * m, n)), STRUCTURAL_TOLERANCE, everything)
    # What is next to the tolerance may count at one configuration and not in all of them together.
    rank = min(rank, beside.rank, below.rank)
    return Structure(rank, aligned_basis(beside.left_kernel), aligned_basis(below.kernel))


def _triangle(rows: Array) -> Array:
    """R of the decomposition QR: as many columns as these rows, the same kernel and singular values, and few rows."""
    return np.asarray(np.linalg.qr(rows, mode="r")) if rows.size else rows


def random_configurations(chain: Chain, count: int, seed: int = 0) -> Array:
    """All the way round for turning joints and ±1 m for sliding ones, whatever the limits; shape (count, n)."""
    reach = np.where(slides(chain), 1.0, np.pi)
    return np.random.default_rng(seed).uniform(-reach, reach, (count, len(chain)))


def slides(chain: Chain) -> Flags:
    """Which variables move a sliding joint; shape (n,)."""
    sliding = np.zeros(len(chain), dtype=bool)
    sliding[chain.flat.joints[chain.flat.joints[:, 0] == 1, 1]] = True
    return sliding


def aligned_basis(basis: Array) -> Array:
    """An orthonormal basis of the same space, as near to coordinate axes as it goes, largest entries positive."""
    if basis.size == 0:
        return basis
    left = basis @ basis.T
    vectors = np.empty_like(basis)
    for k in range(basis.shape[1]):
        # Of equals the first, though rounding makes them differ.
        column = left[:, int(np.argmax(np.round(np.diag(left), 9)))]
        vectors[:, k] = column / np.linalg.norm(column)
        left = left - np.outer(vectors[:, k], vectors[:, k] @ left)
        left = left - np.outer(left @ vectors[:, k], vectors[:, k])
    largest = vectors[np.argmax(np.abs(vectors), axis=0), range(basis.shape[1])]
    return vectors * np.where(largest < 0.0, -1.0, 1.0) + 0.0
