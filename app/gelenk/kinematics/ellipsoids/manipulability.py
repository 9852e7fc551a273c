"""Manipulability: tip velocities and forces for joint velocities, or torques, of norm one [Yoshikawa1985].

J = U Σ Vᵀ maps the unit sphere of joint velocities to the velocity ellipsoid vᵀ(JJᵀ)#v = 1 with semi-axes σ_i along
u_i. Jᵀ maps the force ellipsoid FᵀJJᵀF = 1, with semi-axes 1/σ_i along the same u_i, to the unit sphere of joint
torques. Translation and rotation have separate ellipsoids, because metres and radians have no common norm; a
characteristic length L gives a third one, of (v; L ω) and (F; M / L).

Directions in which a chain never moves are not axes: a planar arm has an ellipse. They belong to the chain's structure,
found at random configurations. A configuration is singular where one of the remaining semi-axes vanishes.
"""

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Literal, TypeAlias, cast

import numpy as np

from gelenk.errors import InvalidField, certify
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.judge.words import EllipsoidCertificate, Reference
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.subspaces import rounding
from gelenk.kinematics.velocity.task_space import STRUCTURAL_TOLERANCE, aligned_basis, jacobians_with_terms, structure
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

Part: TypeAlias = Literal["translation", "rotation", "combined"]

ELLIPSOID_TOLERANCE = 10.0 * STRUCTURAL_TOLERANCE
"""Allowed relative difference between JJᵀ and its ellipsoids, including motion in directions that do not count."""
WITHIN = 1e-9
"""Largest distance of a unit vector from a space that still counts as lying in it."""
_ROUNDING = 1e-14
"""A torque up to this share of the largest counts as zero."""


@dataclass(frozen=True, slots=True)
class Space:
    """The directions of translation, rotation or both in which a chain moves at some configuration.

    Attributes:
        rows: The k rows of J that count.
        basis: Orthonormal columns that span the velocities at all configurations together; shape (k, e).
        dimension: Rank of these rows of J at almost every configuration; at most e, and less where the tip stays on a
            curved line or surface.
        components: Number of components of a vector: 3, or 6 for translation and rotation together.
    """

    rows: tuple[int, ...]
    basis: Array
    dimension: int
    components: int = 3

    @property
    def is_plane(self) -> bool:
        """Whether all motion stays in one plane."""
        return int(self.basis.shape[1]) == 2

    def spread(self, vectors: Array) -> Array:
        """Expand vectors in the rows that count to all components; shape (..., k) → (..., 3) or (..., 6)."""
        full = np.zeros((*vectors.shape[:-1], self.components))
        full[..., [row % self.components for row in self.rows]] = vectors
        return full


@dataclass(frozen=True, slots=True)
class Ellipsoids:
    """Velocity and force ellipsoids of one part (translation, rotation or both) at N configurations, d axes each.

    Attributes:
        sigmas: Semi-axes of the velocity ellipsoids, largest first, exactly 0 where they vanish; shape (N, d).
        axes: Principal axes of both ellipsoids as unit columns in `space.rows`; shape (N, k, d).
        gradients: Gradient of Yoshikawa's measure by the variables, NaN where the measure vanishes and has a kink;
            shape (N, n). None if not requested.
    """

    space: Space
    sigmas: Array
    axes: Array
    gradients: Array | None

    @property
    def measures(self) -> Array:
        """Yoshikawa's measure, the product of the semi-axes: √det(JJᵀ) if all k rows are independent; shape (N,)."""
        return np.asarray(np.prod(self.sigmas, axis=1))

    @property
    def volumes(self) -> Array:
        """Volumes of the velocity ellipsoids, areas of ellipses or lengths of segments; shape (N,)."""
        d = self.space.dimension
        return cast(Array, self.measures * (math.pi ** (d / 2) / math.gamma(d / 2 + 1)))

    @property
    def ranks(self) -> Indices:
        """Number of axes that do not vanish; shape (N,)."""
        return np.asarray(np.count_nonzero(self.sigmas, axis=1))


@dataclass(frozen=True, slots=True)
class Manipulability:
    """Ellipsoids at N configurations, by part, and the Jacobians in the reference; shape (N, 6, n)."""

    parts: dict[Part, Ellipsoids]
    Js: Array
    certificate: EllipsoidCertificate


def manipulability(
    robot: RobotModel,
    chain: Chain,
    qs: Array,
    *,
    task: Sequence[Direction] = DIRECTIONS,
    reference: Reference = "local_world_aligned",
    characteristic_length: float | None = None,
    rank_tolerance: float = 1e-10,
    gradient: bool = False,
) -> Manipulability:
    """Compute and certify velocity and force ellipsoids of a chain.

    Args:
        qs: Configurations in the chain's order; shape (N, n), [rad or m].
        task: The directions that count, in the axes of the reference.
        reference: Axes of all vectors: `local_world_aligned` (the base's) or `local` (the tip's).
        characteristic_length: L > 0 of the combined ellipsoid, [m]; None for no combined ellipsoid.
        rank_tolerance: A semi-axis vanishes if it is no longer than this times the longest.
        gradient: Whether to compute the gradients of Yoshikawa's measure.

    Raises:
        InvalidField: A direction of the task appears twice.
        CertificationFailed: Pinocchio's Jacobians differ, or the ellipsoids do not match the Jacobians.
    """
    rows = task_rows(task)
    found = jacobians(robot, chain, qs, reference=reference, derivatives=gradient)
    _, terms = jacobians_with_terms(chain, qs, reference)
    wanted: list[tuple[Part, tuple[int, ...], float]] = [
        ("translation", tuple(row for row in rows if row < 3), 1.0),
        ("rotation", tuple(row for row in rows if row >= 3), 1.0),
    ]
    if characteristic_length is not None:
        wanted.append(("combined", rows, characteristic_length))
    parts: dict[Part, Ellipsoids] = {}
    worst = 0.0
    for part, some, length in wanted:
        if some:
            space = space_of(chain, some, length, reference, components=6 if part == "combined" else 3)
            stretched = terms * _stretches(some, length).max()
            parts[part], error = _ellipsoids(space, found.values, found.hessians, length, stretched, rank_tolerance)
            worst = max(worst, error)
    return Manipulability(
        parts, found.values, EllipsoidCertificate(**asdict(found.certificate), max_ellipsoid_error=worst)
    )


def task_rows(task: Sequence[Direction]) -> tuple[int, ...]:
    """Return the rows of J that a task selects, ascending; raises InvalidField if a direction appears twice."""
    if len(set(task)) < len(task):
        raise InvalidField("task", "each direction may appear only once")
    return tuple(row for row, direction in enumerate(DIRECTIONS) if direction in task)


def space_of(
    chain: Chain,
    rows: tuple[int, ...],
    length: float = 1.0,
    reference: Reference = "local_world_aligned",
    components: int = 3,
) -> Space:
    """Find the directions among some rows of J in which a chain moves at all, angular rows scaled by a length [m]."""
    fixed = structure(chain, Task(tuple(DIRECTIONS[row] for row in rows)), reference)
    basis = fixed.moving
    if length != 1.0 and basis.shape[1] < len(rows):
        stretched = _stretches(rows, length)[:, None] * basis
        basis = aligned_basis(np.linalg.svd(stretched, full_matrices=False)[0], STRUCTURAL_TOLERANCE)
    return Space(rows, basis, fixed.rank, components)


def _stretches(rows: tuple[int, ...], length: float) -> Array:
    return np.array([length if row >= 3 else 1.0 for row in rows])


def _ellipsoids(
    space: Space, Js: Array, Hs: Array | None, length: float, terms: Array, rank_tolerance: float
) -> tuple[Ellipsoids, float]:
    """Ellipsoids of a part and their largest relative error; semi-axes within the rounding of `terms` vanish."""
    d, stretches = space.dimension, _stretches(space.rows, length)
    Js = Js[:, space.rows] * stretches[:, None]
    if d == 0:
        gradients = None if Hs is None else np.full((len(Js), Js.shape[2]), np.nan)
        return Ellipsoids(space, np.zeros((len(Js), 0)), np.zeros((*Js.shape[:2], 0)), gradients), 0.0
    left, sigmas, right = np.linalg.svd(space.basis.T @ Js, full_matrices=False)
    axes, sigmas, right = _signed(space.basis @ left[:, :, :d]), sigmas[:, :d], right[:, :d]
    error = _ellipsoid_error(Js, axes, sigmas, np.abs(terms).max(axis=(1, 2), initial=0.0))
    counted = np.where(sigmas > np.maximum(rank_tolerance * sigmas[:, :1], rounding(terms)[:, None]), sigmas, 0.0)
    gradients = None
    if Hs is not None:
        # The pseudo-inverse needs the columns with the signs of the decomposition.
        inverses = _pseudo_inverses(space.basis @ left[:, :, :d], counted, right)
        traces = np.einsum("bik,bkij->bj", inverses, Hs[:, space.rows] * stretches[:, None, None])
        gradients = np.prod(counted, axis=1)[:, None] * traces
    return Ellipsoids(space, counted, axes, gradients), error


def _pseudo_inverses(left: Array, sigmas: Array, right: Array) -> Array:
    """J# of J = Σ u_i σ_i v_iᵀ; NaN where a σ_i vanishes; shape (N, n, k)."""
    with np.errstate(divide="ignore"):
        inverted = np.where(sigmas > 0.0, 1.0 / sigmas, np.nan)
    return np.asarray(np.einsum("bdi,bd,bkd->bik", right, inverted, left))


def _signed(axes: Array) -> Array:
    """Unit columns with signs chosen so that the largest component of each is positive; shape (N, k, d)."""
    largest = np.argmax(np.abs(axes) > np.abs(axes).max(axis=1, keepdims=True) - WITHIN, axis=1)
    signs = np.sign(np.take_along_axis(axes, largest[:, None, :], axis=1))
    return axes * np.where(signs == 0.0, 1.0, signs)


def _ellipsoid_error(Js: Array, axes: Array, sigmas: Array, sizes: Array) -> float:
    """Difference of Σ u_i σ_i² u_iᵀ from JJᵀ, relative to the square of the largest semi-axis or entry of the whole J.

    Where all rows of a part nearly vanish, motion that the structure excludes is as large as they are.
    """
    squares = (Js @ Js.transpose(0, 2, 1)) - (axes * sigmas[:, None, :] ** 2) @ axes.transpose(0, 2, 1)
    largest = np.maximum(sigmas[:, 0], sizes)
    scales = np.where(largest > 0.0, largest, 1.0) ** 2
    error = float((np.abs(squares).max(axis=(1, 2)) / scales).max(initial=0.0))
    certify("an ellipsoid", error, ELLIPSOID_TOLERANCE)
    return error


def is_within_task(space: Space, directions: Array) -> Flags:
    """Return whether each unit vector lies in the rows that count; shape (D, 3) → (D,)."""
    return np.asarray(np.linalg.norm(directions[:, [row % 3 for row in space.rows]], axis=1) > 1.0 - WITHIN)


def transmission_ratios(ellipsoids: Ellipsoids, directions: Array, tolerance: float) -> tuple[Array, Array]:
    """Compute the extent of ellipsoids of translation or of rotation along unit vectors u; shape (N, D) each.

    The velocity [uᵀ(JJᵀ)#u]^(-½) is the largest purely along u for joint velocities of norm one; 0 where the tip cannot
    move along u alone. The force [uᵀJJᵀu]^(-½) is the largest along u that joint torques of norm one balance; NaN where
    it is unbounded.

    Args:
        directions: Unit vectors in the axes of the ellipsoids; shape (D, 3).
        tolerance: The force is unbounded where u needs no more torque than this times the largest.
    """
    along = directions[:, [row % 3 for row in ellipsoids.space.rows]]
    sigmas = ellipsoids.sigmas[:, None, :]
    shares = np.einsum("dk,bki->bdi", along, ellipsoids.axes)
    torques = np.linalg.norm(shares * sigmas, axis=2)
    moving = np.where(sigmas > 0.0, shares, 0.0)
    lost = np.linalg.norm(along - np.einsum("bdi,bki->bdk", moving, ellipsoids.axes), axis=2)
    speeds = np.linalg.norm(np.divide(shares, sigmas, out=np.zeros_like(shares), where=sigmas > 0.0), axis=2)
    largest = ellipsoids.sigmas.max(axis=1, initial=0.0)[:, None]
    velocities = np.divide(1.0, speeds, out=np.zeros_like(speeds), where=(lost <= WITHIN) & (speeds > 0.0))
    felt = torques > max(tolerance, _ROUNDING) * largest
    forces = np.divide(1.0, torques, out=np.full_like(torques, np.nan), where=felt)
    return velocities, forces
