"""Names of singularities, wrist, elbow or shoulder, where the axes of the joints determine them.

The Jacobian determinant of an arm with a closed-form solution is a product, and each factor vanishes for its own
reason: two wrist axes coincide; wrist, elbow and shoulder are in line; or the first joint cannot move the wrist out of
the plane of the arm. Such arms are recognised by their axes at random configurations; in other arms some or all
singularities have no name.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from gelenk.ik.search.task import Task
from gelenk.ik.search.words import Direction
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.kinematics.velocity.task_space import TaskSpace, random_configurations, structure
from gelenk.kinematics.velocity.words import SingularityKind
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain

_LINEAR: tuple[Direction, ...] = ("x", "y", "z")
_TRIALS = 4
_SAME = 1e-6
"""Relative distance below which lines meet, and sine below which they are parallel."""
_CLEARLY = 1e-4
_VANISHED = 1e-7
"""Largest factor, scaled to order one, that counts as zero."""


@dataclass(frozen=True, slots=True)
class JointAxes:
    """The axes of a chain's joints at one configuration, from the columns of its Jacobian.

    Attributes:
        axes: Unit vectors along the axes, for a prismatic joint along its motion; shape (n, 3).
        points: A point on each axis relative to the tip, zero if prismatic; shape (n, 3), [m].
        turning: Which joints are revolute; shape (n,).
    """

    axes: Array
    points: Array
    turning: Flags

    @classmethod
    def of(cls, J: Array) -> "JointAxes":
        """Create the lines from a geometric Jacobian in the base's axes; shape (6, n)."""
        turning = np.linalg.norm(J[3:], axis=0) > 0.5
        axes = np.where(turning, J[3:], J[:3]).T
        # v = z × (tip - o), so the vector from the tip to its foot on the axis is z × v.
        return cls(axes, np.where(turning[:, None], np.cross(axes, J[:3].T), 0.0), turning)

    def velocities(self, point: Array) -> Array:
        """Compute the velocity of a point of the last body for unit speed of each joint; shape (n, 3)."""
        return np.where(self.turning[:, None], np.cross(self.axes, point - self.points), self.axes)

    def meeting_point(self, first: int, last: int) -> tuple[Array, float]:
        """Find the point nearest to axes `first` to `last - 1`, and its largest distance from one of them, [m]."""
        squares = np.eye(3) - self.axes[first:last, :, None] * self.axes[first:last, None, :]
        feet = np.einsum("kij,kj->ki", squares, self.points[first:last])
        point = np.linalg.lstsq(squares.sum(axis=0), feet.sum(axis=0), rcond=1e-12)[0]
        return point, float(np.linalg.norm(squares @ point - feet, axis=1).max())


Factors: TypeAlias = Callable[[JointAxes], dict[SingularityKind | None, float]]
"""The factors of a determinant, scaled to order one, by the name of their singularity; None for one without a name."""


def singularity_kinds(chain: Chain, q: Array, space: TaskSpace, tolerance: float) -> tuple[SingularityKind, ...]:
    """Return the names of a singularity; none if the geometry of the arm does not determine them.

    Args:
        q: A singular configuration; shape (n,), [rad or m].
        tolerance: Relative size up to which a singular value counted as zero.
    """
    factors = _factors(chain, space.task, space.reference)
    if factors is None:
        return ()
    values = factors(JointAxes.of(chain_jacobians(chain.flat, q[None])[2][0]))
    limit = max(_VANISHED, 10.0 * tolerance, min(values.values()))
    return tuple(kind for kind, value in values.items() if kind is not None and value <= limit)


@lru_cache(maxsize=1024)
def _factors(chain: Chain, task: Task, reference: Reference) -> Factors | None:
    """Factors that distinguish the singularities of a chain; None if the chain is not of a known type."""
    flat = chain.flat
    own = len(flat.joints) == len(chain) and bool((np.abs(flat.drives[:, 0]) == 1.0).all())
    if not own or len(chain) == 0:
        return None
    n, wanted = len(chain), frozenset(task.directions)
    if reference == "world" and len(wanted) < 6 and wanted != {"rx", "ry", "rz"}:
        # The point at the base's origin is not part of the arm.
        return None
    trials = [JointAxes.of(J) for J in chain_jacobians(chain.flat, random_configurations(chain, _TRIALS))[2]]
    if _is_planar(trials):
        # With only some directions of the plane, rank is lost for other reasons.
        linear: Task = Task(tuple(direction for direction in task.directions if direction in _LINEAR))
        whole = structure(chain, Task(_LINEAR), reference).rank
        in_plane = len(linear) > 0 and structure(chain, linear, reference).rank == whole
        return _planar if in_plane and trials[0].turning.sum() >= 2 else None
    if n == 3 and wanted == frozenset("xyz"):
        return _positioning(trials, n, with_wrist=False)
    if _meet(trials, n - 3, n) and (len(wanted) == 6 or (n == 3 and wanted == {"rx", "ry", "rz"})):
        return _positioning(trials, n - 3, with_wrist=True)
    if n == 6 and len(wanted) == 6 and _has_three_parallel(trials):
        return _parallel
    return None


def _is_planar(trials: list[JointAxes]) -> bool:
    axes = trials[0].axes
    return bool((np.linalg.norm(np.cross(axes, axes[0]), axis=1) < _SAME).all())


def _meet(trials: list[JointAxes], first: int, last: int) -> bool:
    """Whether consecutive revolute axes meet in one point, none of them parallel to the next."""
    if first < 0 or not trials[0].turning[first:last].all():
        return False
    for lines in trials:
        axes = lines.axes[first:last]
        if np.linalg.norm(np.cross(axes[:-1], axes[1:]), axis=1).min() < _CLEARLY:
            return False
        if lines.meeting_point(first, last)[1] > _SAME * _extent(lines):
            return False
    return True


def _extent(lines: JointAxes) -> float:
    """Characteristic length of the arm, [m]."""
    return float(np.linalg.norm(lines.points - lines.points.mean(axis=0), axis=1).max()) or 1.0


def _has_three_parallel(trials: list[JointAxes]) -> bool:
    """Whether axes 2 to 4 of six revolute axes are parallel and perpendicular to axes 1 and 5.

    The last two must meet: then the determinant is a product.
    """
    for lines in trials:
        z = lines.axes[1]
        apart = np.linalg.norm(np.cross(lines.axes[2:4], z), axis=1).max()
        if not lines.turning.all() or apart > _SAME or np.abs(lines.axes[[0, 4]] @ z).max() > _SAME:
            return False
        if lines.meeting_point(4, 6)[1] > _SAME * _extent(lines):
            return False
    return True


def _planar(_: JointAxes) -> dict[SingularityKind | None, float]:
    """The singularities of a planar arm, which all count as elbow: links in line."""
    return {"elbow": 0.0}


def _parallel(lines: JointAxes) -> dict[SingularityKind | None, float]:
    """Three parallel axes. Elbow: coplanar; wrist: the last axis parallel too; shoulder: wrist over the first axis."""
    z, extent = lines.axes[1], _extent(lines)
    centre = lines.meeting_point(4, 6)[0]
    upper, lower = np.cross(z, lines.points[2] - lines.points[1]), np.cross(z, lines.points[3] - lines.points[2])
    return {
        "wrist": float(np.linalg.norm(np.cross(lines.axes[5], z))),
        "elbow": abs(float(np.cross(upper, lower) @ z)) / float(np.linalg.norm(upper) * np.linalg.norm(lower)),
        "shoulder": abs(float(z @ np.cross(lines.axes[0], centre - lines.points[0]))) / extent,
    }


def _positioning(trials: list[JointAxes], placed: int, *, with_wrist: bool) -> Factors | None:
    """An arm that positions a point, the wrist centre or the tip, and possibly a wrist that rotates about it."""
    arm = _arm_factors(trials, placed)
    if arm is None and not with_wrist:
        return None

    def factors(lines: JointAxes) -> dict[SingularityKind | None, float]:
        found: dict[SingularityKind | None, float] = {}
        centre = np.zeros(3)
        if with_wrist:
            centre = lines.meeting_point(placed, placed + 3)[0]
            found["wrist"] = abs(float(np.linalg.det(lines.axes[placed:])))
        if arm is not None:
            found |= arm(lines, centre, _extent(lines))
        elif placed:
            velocities = lines.velocities(centre)[:placed] / _extent(lines)
            found[None] = float(np.linalg.svd(velocities, compute_uv=False)[-1])
        return found

    return factors


def _arm_factors(
    trials: list[JointAxes], placed: int
) -> Callable[[JointAxes, Array, float], dict[SingularityKind | None, float]] | None:
    if placed == 3:
        z = [lines.axes[1] for lines in trials]
        follows = all(
            np.linalg.norm(np.cross(lines.axes[2], axis)) < _SAME
            if lines.turning[2]
            else abs(lines.axes[2] @ axis) < _SAME
            for lines, axis in zip(trials, z, strict=True)
        )
        return _upright if follows and trials[0].turning[:2].all() else None
    if placed == 4 and _meet(trials, 0, 3) and trials[0].turning[3]:
        return _spherical
    return None


def _upright(lines: JointAxes, centre: Array, extent: float) -> dict[SingularityKind | None, float]:
    """An arm whose second and third joint move the wrist in a plane, which only the first joint leaves."""
    first, second, third = lines.velocities(centre)[:3] / extent
    in_plane = float(np.linalg.norm(np.cross(second, third)))
    return {"elbow" if lines.turning[2] else None: in_plane, "shoulder": abs(float(first @ lines.axes[1]))}


def _spherical(lines: JointAxes, centre: Array, extent: float) -> dict[SingularityKind | None, float]:
    """An arm whose first three axes meet in the shoulder: only the fourth joint changes the wrist's distance to it."""
    shoulder = lines.meeting_point(0, 3)[0]
    velocities = lines.velocities(centre)[:4] / extent
    elbow = abs(float(velocities[3] @ (centre - shoulder))) / extent
    found: dict[SingularityKind | None, float] = {"elbow": elbow}
    if elbow > _VANISHED:
        # Besides the radial motion of the wrist, two directions remain.
        found["shoulder"] = float(np.linalg.svd(velocities, compute_uv=False)[2])
    return found
