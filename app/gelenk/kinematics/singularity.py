"""Singular configurations: what the tip has lost there, which joints make it so, which motions the tip does not see.

A configuration is singular where the Jacobian's rank is below that of the chain's structure, and nearly so where the
last singular value that can be other than zero is small.
"""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.singularity_kinds import singularity_kinds
from gelenk.kinematics.subspaces import Subspaces, subspaces
from gelenk.kinematics.task_space import FULL_SPACE, STRUCTURAL_TOLERANCE, TaskSpace, aligned_basis, structure
from gelenk.kinematics.words import SingularityKind
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain

RANK_TOLERANCE = 1e-10
_INVOLVED = 1e-6
"""Share of a joint in a motion, relative to the largest, above which it takes part."""
_REPEATED = 1e-6
"""Relative gap below which two singular values are the same."""


@dataclass(frozen=True, slots=True)
class SingularityReport:
    """The directions that the tip keeps and loses at a configuration.

    Attributes:
        rank: Singular values that count.
        structural_rank: The same at random configurations: the configuration is singular where `rank` is less.
        tolerance: A singular value counts where it exceeds this times the largest.
        sigmas: Singular values, largest first; shape (min(m, n),).
        lost_directions: Orthonormal basis of ker(Jᵀ), in the rows of J, those that are lost here first;
            shape (m, m - rank).
        twists: The same as unit twists in the base's axes; shape (6, m - rank).
        wrenches: The same as unit wrenches that no joint feels; shape (6, m - rank).
        internal_motions: Orthonormal basis of ker(J), those that only exist here first; shape (n, n - rank).
        joints: Indices of the joints whose columns are dependent here and not elsewhere.
        kinds: What the singularity is called, where the geometry tells.
        exit: Joint motion of unit length along which `smallest` grows fastest; shape (n,). None where it does not to
            first order, as where the singular value is repeated: one of the two falls along nearly every way.
        exit_rate: How fast it grows along that, per [rad or m].
    """

    rank: int
    structural_rank: int
    tolerance: float
    sigmas: Array
    lost_directions: Array
    twists: Array
    wrenches: Array
    internal_motions: Array
    joints: tuple[int, ...]
    kinds: tuple[SingularityKind, ...]
    exit: Array | None
    exit_rate: float

    @property
    def defect(self) -> int:
        """How many directions are lost here that the arm has elsewhere."""
        return self.structural_rank - self.rank

    @property
    def smallest(self) -> float | None:
        """The last singular value that can be other than zero; None where none can."""
        return float(self.sigmas[self.structural_rank - 1]) if self.structural_rank else None


def singularity_report(
    chain: Chain,
    q: Array,
    tolerance: float = RANK_TOLERANCE,
    space: TaskSpace = FULL_SPACE,
) -> SingularityReport:
    """The report on one configuration.

    Where a redundant arm is singular, the directions and motions that it loses or gains there are those that it regains
    or gives up fastest when it moves on; the others are what it lacks or has everywhere.

    Args:
        chain: Base and tip.
        q: Configuration; shape (n,), [rad or m].
        tolerance: A singular value counts where it exceeds this times the largest.
        space: The rows that count.
    """
    Js, least = space.with_rounding(chain, q[None])
    fixed = structure(chain, space.task, space.reference)
    parts = _split_at_rank(Js[0], tolerance, float(least[0]), fixed.rank)
    H = space.hessians(chain, q[None])[0]
    defect = fixed.rank - parts.rank
    T = np.einsum("ka,kij,ib->ajb", parts.left_kernel, H, parts.kernel)
    lost = _ordered(parts.left_kernel, space.never(fixed), T, defect)
    free = _ordered(parts.kernel, fixed.idle, T.transpose(2, 0, 1), defect)
    # Slopes that are rounding beside the Jacobian's own numbers are none.
    slight = max(STRUCTURAL_TOLERANCE * float(parts.sigmas.max(initial=0.0)), float(least[0]))
    exit_, rate = _way_out(T, defect, slight) if defect else _gradient(parts, H, fixed.rank, slight)
    return SingularityReport(
        parts.rank,
        fixed.rank,
        tolerance,
        parts.sigmas + 0.0,
        lost,
        space.twists(lost, chain, q),
        space.wrenches(lost, chain, q),
        free,
        _involved(free[:, :defect], max(_INVOLVED, tolerance)),
        singularity_kinds(chain, q, space, tolerance) if defect else (),
        exit_,
        rate,
    )


def _split_at_rank(J: Array, tolerance: float, least: float, most: int) -> Subspaces:
    """The subspaces of J, whose rank is no more than structural: what rounding adds to that is none."""
    parts = subspaces(J, tolerance)
    rank = min(parts.rank, int(np.sum(parts.sigmas > least)), most)
    return replace(parts, rank=rank)


def _ordered(basis: Array, constant: Array, changes: Array, count: int) -> Array:
    """A basis of the same space, first the `count` vectors that the changes act on most, last the constant ones.

    Args:
        basis: Orthonormal; shape (m, k).
        constant: Orthonormal vectors of that space; shape (m, l).
        changes: What motions do to each vector of the basis; shape (k, …, …).
        count: How many vectors change.
    """
    if basis.shape[1] == 0:
        return basis
    inside = basis.T @ constant
    moving = subspaces(inside, 0.5).left_kernel
    strongest = np.eye(moving.shape[1])
    if changes.size:
        strongest = np.linalg.svd(moving.T @ changes.reshape(len(changes), -1))[0]
    here, rest = np.split(basis @ moving @ strongest, [count], axis=1)
    return np.column_stack((aligned_basis(here), aligned_basis(rest), constant))


def _involved(motions: Array, least: float) -> tuple[int, ...]:
    """The joints that take part in some motions, shape (n, k), by more than a share of the largest part."""
    shares = np.linalg.norm(motions, axis=1)
    return tuple(np.flatnonzero(shares > least * shares.max(initial=0.0)).tolist())


def _gradient(parts: Subspaces, H: Array, rank: int, slight: float) -> tuple[Array | None, float]:
    """The gradient of σ at a regular configuration: ∂σ/∂q_j = uᵀ ∂J/∂q_j v of its singular vectors.

    A singular value that is repeated has a kink: its singular vectors are any of a plane, and no such number.
    """
    if rank == 0:
        return None, 0.0
    if rank > 1 and parts.sigmas[rank - 2] - parts.sigmas[rank - 1] <= _REPEATED * parts.sigmas[rank - 2]:
        return None, 0.0
    gradient = np.einsum("k,kij,i->j", parts.left[:, rank - 1], H, parts.right[:, rank - 1])
    return _direction(gradient, slight)


def _way_out(T: Array, defect: int, slight: float) -> tuple[Array | None, float]:
    """The direction in which σ grows at a singular configuration, equally on both sides.

    To first order what grows along d are the singular values of M(d) = Σ_j d_j Uᵀ ∂J/∂q_j V, U and V those of the two
    kernels; the least of them that can be other than zero counts. Of one lost direction the fastest d is a singular
    vector of the map d ↦ M(d); of several the best of these vectors and of sums of two is taken.
    """
    vectors = np.linalg.svd(T.transpose(1, 0, 2).reshape(T.shape[1], T.shape[0] * T.shape[2]))[0].T
    candidates = vectors[:1]
    if defect > 1:
        sums = [a + sign * b for i, a in enumerate(vectors) for b in vectors[:i] for sign in (1.0, -1.0)]
        candidates = np.array([*vectors, *(np.array(sums) / np.sqrt(2.0))])
    rates = np.linalg.svd(np.einsum("cj,ajb->cab", candidates, T), compute_uv=False)[:, defect - 1]
    best = candidates[np.argmax(rates)]
    return _direction(rates.max() * best * np.sign(best[np.argmax(np.abs(best))]), slight)


def _direction(gradient: Array, slight: float) -> tuple[Array | None, float]:
    """Unit vector and length of a gradient; no direction where it is no longer than rounding."""
    length = float(np.linalg.norm(gradient))
    return (gradient / length + 0.0, length) if length > slight else (None, 0.0)
