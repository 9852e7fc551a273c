"""Singular configurations: the directions that the tip loses, the joints that cause it, and the internal motions.

A configuration is singular if the Jacobian's rank is below the chain's structural rank, and nearly singular if the
last structurally nonzero singular value is small.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.kinematics.judge.judge import Differences, largest, pinocchio_jacobian, sampled_rows
from gelenk.kinematics.singularity.kinds import singularity_kinds
from gelenk.kinematics.velocity.subspaces import Subspaces, subspaces
from gelenk.kinematics.velocity.task_space import FULL_SPACE, STRUCTURAL_TOLERANCE, TaskSpace, aligned_basis, structure
from gelenk.kinematics.velocity.words import SingularityKind
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

RANK_TOLERANCE = 1e-10
_INVOLVED = 1e-6
"""A joint takes part in a motion if its share exceeds this times the largest."""
_REPEATED = 1e-6
"""Relative gap up to which two singular values count as equal."""


@dataclass(frozen=True, slots=True)
class SingularityReport:
    """The rank of the Jacobian at a configuration, and the directions that the tip loses there.

    Attributes:
        rank: Number of singular values that count.
        structural_rank: Rank at random configurations: the configuration is singular if `rank` is less.
        tolerance: A singular value counts if it exceeds this times the largest.
        sigmas: Singular values, largest first; shape (min(m, n),).
        lost_directions: Orthonormal basis of ker(Jᵀ), in the rows of J, directions lost only here first;
            shape (m, m - rank).
        twists: These directions as unit twists in the base's axes; shape (6, m - rank).
        wrenches: These directions as unit wrenches that need no joint torque; shape (6, m - rank).
        internal_motions: Orthonormal basis of ker(J), motions that exist only here first; shape (n, n - rank).
        joints: Indices of the joints whose columns are dependent here and not elsewhere.
        kinds: Names of the singularity, if the geometry determines them.
        exit: Unit joint motion along which `smallest` grows fastest; shape (n,). None if it does not grow to first
            order, as for a repeated singular value: one of the two falls along nearly every direction.
        exit_rate: Growth rate of `smallest` along `exit`, per [rad or m].
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
        """Number of directions lost here that the arm has elsewhere."""
        return self.structural_rank - self.rank

    @property
    def smallest(self) -> float | None:
        """The last structurally nonzero singular value; None if all are structurally zero."""
        return float(self.sigmas[self.structural_rank - 1]) if self.structural_rank else None


def singularity_report(
    chain: Chain, q: Array, tolerance: float = RANK_TOLERANCE, space: TaskSpace = FULL_SPACE
) -> SingularityReport:
    """Report rank, lost directions and internal motions at one configuration.

    At a singularity of a redundant arm, the directions it loses and the motions it gains are those that change fastest
    as it moves away; the others it lacks or has everywhere.

    Args:
        q: Configuration; shape (n,), [rad or m].
        tolerance: A singular value counts if it exceeds this times the largest.
    """
    Js, least = space.with_rounding(chain, q[None])
    fixed = structure(chain, space.task, space.reference)
    parts = subspaces(Js[0], tolerance)
    parts = replace(parts, rank=min(parts.rank, int(np.sum(parts.sigmas > least[0])), fixed.rank))
    H = space.hessians(chain, q[None])[0]
    defect = fixed.rank - parts.rank
    T = np.einsum("ka,kij,ib->ajb", parts.left_kernel, H, parts.kernel)
    lost = _ordered(parts.left_kernel, space.never(fixed), T, defect)
    free = _ordered(parts.kernel, fixed.idle, T.transpose(2, 0, 1), defect)
    # Slopes at the rounding level of the Jacobian count as zero.
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


def certify_reports(
    robot: RobotModel, chain: Chain, space: TaskSpace, qs: Array, reports: Sequence[SingularityReport], seed: int = 0
) -> Differences:
    """Check with Pinocchio's Jacobian that internal motions leave the tip at rest and lost directions need no torque.

    Both come from our own Jacobians, and from the chain's structure at other configurations. There is one report per
    configuration (N, n). The result has the fields that `SingularityCertificate` adds; raises CertificationFailed if
    motion or torque is more than the singular values allow.
    """
    worst = Differences(max_internal_motion=0.0, max_lost_direction=0.0)
    for row in sampled_rows(len(qs) if len(chain) else 0, seed):
        report = reports[row]
        J = space.picked(pinocchio_jacobian(robot, chain, qs[row], space.reference)[None])[0]
        # The structure was found with unscaled rows, and its tolerance is larger.
        scale = 10.0 * max(1.0, largest(report.sigmas), largest(space.scales))
        passed = largest(report.sigmas[report.rank :])
        moved = np.linalg.norm(J @ report.internal_motions, axis=0)
        worst.add("max_internal_motion", "the tip's rest", moved, scale, passed)
        felt = np.linalg.norm(J.T @ report.lost_directions, axis=0)
        worst.add("max_lost_direction", "a lost direction", felt, scale, passed)
    return worst


def _ordered(basis: Array, constant: Array, changes: Array, count: int) -> Array:
    """Orthonormal basis of the same space: first the `count` vectors most affected by changes, last the constant ones.

    Row k of the changes is the effect of joint motions on vector k of the given basis.
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
    """Joints whose share in some motions, shape (n, k), exceeds `least` times the largest share."""
    shares = np.linalg.norm(motions, axis=1)
    return tuple(np.flatnonzero(shares > least * shares.max(initial=0.0)).tolist())


def _gradient(parts: Subspaces, H: Array, rank: int, slight: float) -> tuple[Array | None, float]:
    """Gradient of σ at a regular configuration: ∂σ/∂q_j = uᵀ ∂J/∂q_j v, with its singular vectors u and v.

    A repeated singular value has a kink: its singular vectors are not unique, and the gradient does not exist.
    """
    if rank == 0:
        return None, 0.0
    if rank > 1 and parts.sigmas[rank - 2] - parts.sigmas[rank - 1] <= _REPEATED * parts.sigmas[rank - 2]:
        return None, 0.0
    gradient = np.einsum("k,kij,i->j", parts.left[:, rank - 1], H, parts.right[:, rank - 1])
    return _direction(gradient, slight)


def _way_out(T: Array, defect: int, slight: float) -> tuple[Array | None, float]:
    """Direction in which σ grows fastest from a singular configuration, equally on both sides.

    To first order, the vanished singular values grow along d as those of M(d) = Σ_j d_j Uᵀ ∂J/∂q_j V, where U and V are
    bases of the two kernels; the smallest structurally nonzero one counts. For one lost direction the fastest d is a
    singular vector of the map d ↦ M(d); for several, the best of these vectors and of sums of two is taken.
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
    """Unit vector and length of a gradient; None and 0 if it is within rounding."""
    length = float(np.linalg.norm(gradient))
    return (gradient / length + 0.0, length) if length > slight else (None, 0.0)
