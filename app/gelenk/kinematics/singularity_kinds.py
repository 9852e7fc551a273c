"""What a singularity is called: of the wrist, the elbow or the shoulder, where the lines of the joints tell it.

The determinant of an arm that can be solved in closed form is a product, and each factor vanishes for a reason of its
own: two axes of the wrist fall on one line; the wrist, the elbow and the shoulder are in line; the wrist stands where
the first joint cannot move it out of the plane of the arm. Such arms are recognised by their axes at random
configurations; other arms have no such names, or some of their singularities have none.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from gelenk.kinematics.ik.task import Task
from gelenk.kinematics.ik.words import Direction
from gelenk.kinematics.jacobian import Reference
from gelenk.kinematics.kernels import chain_jacobians
from gelenk.kinematics.task_space import TaskSpace, random_configurations, structure
from gelenk.kinematics.words import SingularityKind
from gelenk.model.arrays import Array, Flags
from gelenk.model.chain import Chain

_LINEAR: tuple[Direction, ...] = ("x", "y", "z")
_TRIALS = 4
_SAME = 1e-6
"""Distance relative to the arm at which lines meet, sine at which they are parallel."""
_CLEARLY = 1e-4
_VANISHED = 1e-7
"""Factor, of numbers of the size of one, that counts as zero."""


@dataclass(frozen=True, slots=True)
class Lines:
    """The axes of a chain's joints at one configuration, from the columns of its Jacobian.

    Attributes:
        axes: Unit vectors, along which a sliding joint moves; shape (n, 3).
        points: A point on each axis, against the tip; shape (n, 3), [m].
        turning: Which joints turn; shape (n,).
    """

    axes: Array
    points: Array
    turning: Flags

    @classmethod
    def of(cls, J: Array) -> "Lines":
        """The lines by a geometric Jacobian in the base's axes; shape (6, n)."""
        turning = np.linalg.norm(J[3:], axis=0) > 0.5
        axes = np.where(turning, J[3:], J[:3]).T
        # v = z × (tip - o), so the foot of the tip on the axis is z × v away from it.
        return cls(axes, np.where(turning[:, None], np.cross(axes, J[:3].T), 0.0), turning)

    def velocities(self, point: Array) -> Array:
        """How each joint moves a point of the last body; shape (n, 3)."""
        return np.where(self.turning[:, None], np.cross(self.axes, point - self.points), self.axes)

    def meeting_point(self, first: int, last: int) -> tuple[Array, float]:
        """The point that is nearest to some of the axes, and its largest distance from one of them."""
        squares = np.eye(3) - self.axes[first:last, :, None] * self.axes[first:last, None, :]
        feet = np.einsum("kij,kj->ki", squares, self.points[first:last])
        point = np.linalg.lstsq(squares.sum(axis=0), feet.sum(axis=0), rcond=1e-12)[0]
        return point, float(np.linalg.norm(squares @ point - feet, axis=1).max())


Factors: TypeAlias = Callable[[Lines], dict[SingularityKind | None, float]]
"""The factors of a determinant by the name of what vanishes with them, each of the size of one; None has no name."""


def singularity_kinds(chain: Chain, q: Array, space: TaskSpace, tolerance: float) -> tuple[SingularityKind, ...]:
    """The names of what makes a configuration singular; none where the geometry of the arm does not tell.

    Args:
        chain: Base and tip.
        q: A singular configuration; shape (n,), [rad or m].
        space: The rows that count.
        tolerance: Relative size at which a singular value counted as zero.
    """
    factors = _factors(chain, space.task, space.reference)
    if factors is None:
        return ()
    values = factors(Lines.of(chain_jacobians(chain.flat, q[None])[2][0]))
    limit = max(_VANISHED, 10.0 * tolerance, min(values.values()))
    return tuple(kind for kind, value in values.items() if kind is not None and value <= limit)


@lru_cache(maxsize=1024)
def _factors(chain: Chain, task: Task, reference: Reference) -> Factors | None:
    """How the singularities of a chain are distinguished; None where they are not."""
    flat = chain.flat
    own = len(flat.joints) == len(chain) and bool((np.abs(flat.drives[:, 0]) == 1.0).all())
    if not own or len(chain) == 0:
        return None
    n, wanted = len(chain), frozenset(task.directions)
    if reference == "world" and len(wanted) < 6 and wanted != {"rx", "ry", "rz"}:
        # The point that passes the base's origin is no part of the arm.
        return None
    trials = [Lines.of(J) for J in chain_jacobians(chain.flat, random_configurations(chain, _TRIALS))[2]]
    if _is_planar(trials):
        # With a part of the plane other rows lose rank for other reasons.
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


def _is_planar(trials: list[Lines]) -> bool:
    """Whether all joints turn about one direction or slide along it."""
    axes = trials[0].axes
    return bool((np.linalg.norm(np.cross(axes, axes[0]), axis=1) < _SAME).all())


def _meet(trials: list[Lines], first: int, last: int) -> bool:
    """Whether some neighbouring axes turn about one point, no two of them parallel to the next."""
    if first < 0 or not trials[0].turning[first:last].all():
        return False
    for lines in trials:
        axes = lines.axes[first:last]
        if np.linalg.norm(np.cross(axes[:-1], axes[1:]), axis=1).min() < _CLEARLY:
            return False
        if lines.meeting_point(first, last)[1] > _SAME * _extent(lines):
            return False
    return True


def _extent(lines: Lines) -> float:
    """A length of the arm, [m]."""
    return float(np.linalg.norm(lines.points - lines.points.mean(axis=0), axis=1).max()) or 1.0


def _has_three_parallel(trials: list[Lines]) -> bool:
    """Whether the second to the fourth of six turning axes are parallel and square to their neighbours.

    The last two meet: then the determinant is a product.
    """
    for lines in trials:
        z = lines.axes[1]
        apart = np.linalg.norm(np.cross(lines.axes[2:4], z), axis=1).max()
        if not lines.turning.all() or apart > _SAME or np.abs(lines.axes[[0, 4]] @ z).max() > _SAME:
            return False
        if lines.meeting_point(4, 6)[1] > _SAME * _extent(lines):
            return False
    return True


def _planar(_: Lines) -> dict[SingularityKind | None, float]:
    """The singularities of a planar arm, all of the elbow: links in line."""
    return {"elbow": 0.0}


def _parallel(lines: Lines) -> dict[SingularityKind | None, float]:
    """Three parallel axes: those in one plane; the last axis parallel to them; the wrist over the first axis."""
    z, extent = lines.axes[1], _extent(lines)
    centre = lines.meeting_point(4, 6)[0]
    upper, lower = np.cross(z, lines.points[2] - lines.points[1]), np.cross(z, lines.points[3] - lines.points[2])
    return {
        "wrist": float(np.linalg.norm(np.cross(lines.axes[5], z))),
        "elbow": abs(float(np.cross(upper, lower) @ z)) / float(np.linalg.norm(upper) * np.linalg.norm(lower)),
        "shoulder": abs(float(z @ np.cross(lines.axes[0], centre - lines.points[0]))) / extent,
    }


def _positioning(trials: list[Lines], placed: int, *, with_wrist: bool) -> Factors | None:
    """An arm that moves a point, the centre of the wrist or the tip, and the wrist that turns about it."""
    arm = _arm_factors(trials, placed)
    if arm is None and not with_wrist:
        return None

    def factors(lines: Lines) -> dict[SingularityKind | None, float]:
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
    trials: list[Lines], placed: int
) -> Callable[[Lines, Array, float], dict[SingularityKind | None, float]] | None:
    """The factors of the joints that move the centre of the wrist."""
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


def _upright(lines: Lines, centre: Array, extent: float) -> dict[SingularityKind | None, float]:
    """The second and the third joint move the wrist in a plane, out of which only the first one leads."""
    first, second, third = lines.velocities(centre)[:3] / extent
    in_plane = float(np.linalg.norm(np.cross(second, third)))
    return {"elbow" if lines.turning[2] else None: in_plane, "shoulder": abs(float(first @ lines.axes[1]))}


def _spherical(lines: Lines, centre: Array, extent: float) -> dict[SingularityKind | None, float]:
    """Three joints turn about the shoulder, so that only the fourth one moves the wrist nearer to it."""
    shoulder = lines.meeting_point(0, 3)[0]
    velocities = lines.velocities(centre)[:4] / extent
    elbow = abs(float(velocities[3] @ (centre - shoulder))) / extent
    found: dict[SingularityKind | None, float] = {"elbow": elbow}
    if elbow > _VANISHED:
        # Without the wrist's own motion to and fro what is left are two directions.
        found["shoulder"] = float(np.linalg.svd(velocities, compute_uv=False)[2])
    return found
