"""The space in which a task moves the tip: the rows of the Jacobian that count, and what a chain can do in them.

A direction can be missing because the arm never has it (a planar arm, or fewer joints than directions) or because it
is lost at one configuration. The two are told apart by the structure of the chain: what it can do at random
configurations, which are almost surely regular.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from app.kinematics.ik.task import DIRECTIONS, FULL_POSE, Task
from app.kinematics.kernels import chain_hessians, chain_jacobians
from app.kinematics.subspaces import subspaces
from app.model.arrays import Array, Flags
from app.model.chain import Chain

STRUCTURAL_TOLERANCE = 1e-9
"""Singular value, relative to the largest, above which a direction counts as one that the arm can have."""
_TRIALS = 8


@dataclass(frozen=True)
class TaskSpace:
    """The rows of the Jacobian that count, and the length that makes radians comparable with metres.

    x y z are along the base's axes. rx ry rz are about these too where all three count; where only some do, they are
    about the tip's axes, as those of a target that is reached in `ik`.

    Attributes:
        task: Which directions count; m of them.
        characteristic_length: What angular rows are multiplied by, [m]; None leaves metres and radians mixed.
    """

    task: Task = FULL_POSE
    characteristic_length: float | None = None

    def __len__(self) -> int:
        return len(self.task)

    @cached_property
    def rows(self) -> list[int]:
        """Which rows of a geometric Jacobian count."""
        return [i for i, direction in enumerate(DIRECTIONS) if direction in self.task.directions]

    @cached_property
    def turns(self) -> int:
        """How many of them are angular."""
        return sum(row >= 3 for row in self.rows)

    @cached_property
    def scales(self) -> Array:
        """What each of them is multiplied by; shape (m,)."""
        return np.array([1.0 if row < 3 else self.characteristic_length or 1.0 for row in self.rows])

    def jacobians(self, chain: Chain, qs: Array) -> Array:
        """J at configurations of shape (N, n); shape (N, m, n)."""
        _, rotations, Js = chain_jacobians(chain.flat, qs)
        if self.turns in {1, 2}:
            Js[:, 3:] = rotations.transpose(0, 2, 1) @ Js[:, 3:]
        return np.asarray(Js[:, self.rows] * self.scales[:, None])

    def hessians(self, chain: Chain, qs: Array) -> Array:
        """∂J/∂q of the same: [:, k, i, j] = ∂J[k, i]/∂q_j; shape (N, m, n, n)."""
        Hs = chain_hessians(chain.flat, qs)
        if self.turns in {1, 2}:
            # ∂(RᵀJ)/∂q_j = Rᵀ(∂J/∂q_j - ω_j × J).
            _, rotations, Js = chain_jacobians(chain.flat, qs)
            omegas = Js[:, 3:].transpose(0, 2, 1)
            Hs[:, 3:] -= np.cross(omegas[:, None, :, :], omegas[:, :, None, :]).transpose(0, 3, 1, 2)
            Hs[:, 3:] = np.einsum("brk,brij->bkij", rotations, Hs[:, 3:])
        return np.asarray(Hs[:, self.rows] * self.scales[:, None, None])

    def twists(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Directions of the rows, shape (m, k), as unit twists in the base's axes; shape (6, k)."""
        return self._in_base(directions / self.scales[:, None], chain, q)

    def wrenches(self, directions: Array, chain: Chain, q: Array) -> Array:
        """Directions of the rows, shape (m, k), as unit wrenches at the tip in the base's axes; shape (6, k)."""
        return self._in_base(directions * self.scales[:, None], chain, q)

    def _in_base(self, parts: Array, chain: Chain, q: Array) -> Array:
        vectors = np.zeros((6, parts.shape[1]))
        vectors[self.rows] = parts
        if self.turns in {1, 2}:
            vectors[3:] = chain_jacobians(chain.flat, q[None])[1][0] @ vectors[3:]
        return np.asarray(vectors / np.linalg.norm(vectors, axis=0))


FULL_SPACE = TaskSpace()


@dataclass(frozen=True, slots=True)
class Structure:
    """What is the same at all configurations of a chain but the singular ones.

    Attributes:
        rank: The rank of J at random configurations.
        never: Directions that the tip has nowhere, orthonormal, of unscaled rows; shape (m, k).
        idle: Joint velocities that leave the tip at rest everywhere, orthonormal; shape (n, l).
    """

    rank: int
    never: Array
    idle: Array


@lru_cache(maxsize=1024)
def structure(chain: Chain, task: Task) -> Structure:
    """What a chain can do at random configurations, the same ones at each call."""
    qs = random_configurations(chain, _TRIALS)
    Js = TaskSpace(task).jacobians(chain, qs)
    m, n = Js.shape[1:]
    rank = max(subspaces(J, STRUCTURAL_TOLERANCE).rank for J in Js)
    beside = subspaces(Js.transpose(1, 0, 2).reshape(m, _TRIALS * n), STRUCTURAL_TOLERANCE)
    below = subspaces(Js.reshape(_TRIALS * m, n), STRUCTURAL_TOLERANCE)
    return Structure(rank, aligned_basis(beside.left_kernel), aligned_basis(below.kernel))


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
