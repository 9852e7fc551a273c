"""The pose directions that count in a task, and the errors of poses in these directions."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gelenk.ik.search.iteration import AXIS, FULL, SOME
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled
from gelenk.robot.notations import vectors_from_rotations
from gelenk.robot.poses import Poses


@dataclass(frozen=True)
class Task:
    """The pose directions that count: x y z along the base's axes, rx ry rz about the target's axes.

    With two rotations, the tip's axis of the missing name must point like the target's (`x y z rx ry` means a position
    and an approach axis). With one, that component of the rotation vector from target to tip must vanish.
    """

    directions: tuple[Direction, ...] = DIRECTIONS

    @cached_property
    def weights(self) -> Array:
        """Weights: 1 for each direction that counts, else 0; shape (6,)."""
        return np.array([float(direction in self.directions) for direction in DIRECTIONS])

    @cached_property
    def kind(self) -> int:
        """Kind of task in the kernels: `FULL`, `AXIS` or `SOME`."""
        if len(self.directions) == len(DIRECTIONS):
            return FULL
        return AXIS if self._rotations == 2 else SOME

    @cached_property
    def axis(self) -> int:
        """Index of the axis to align if two rotations count; else 0."""
        if self._rotations != 2:
            return 0
        return next(i for i in range(3) if DIRECTIONS[3 + i] not in self.directions)

    @cached_property
    def positions(self) -> int:
        """Number of position directions that count."""
        return len(self.directions) - self._rotations

    @property
    def has_rotations(self) -> bool:
        """Whether any part of the orientation counts."""
        return self._rotations > 0

    @cached_property
    def _rotations(self) -> int:
        return sum(direction in self.directions for direction in DIRECTIONS[3:])

    def __len__(self) -> int:
        return len(self.directions)

    def errors(self, targets: Poses, poses: Poses) -> Array:
        """Distance [m] and angle [rad] from each pose to its target in the directions that count; shape (2, N)."""
        errors: Array = task_errors(
            self.weights, self.kind, self.axis, targets.positions, targets.rotations, poses.positions, poses.rotations
        )
        return errors


FULL_POSE = Task()


@compiled
def task_errors(
    weights: Array, kind: int, axis: int, goals: Array, goal_Rs: Array, positions: Array, Rs: Array
) -> Array:
    """Compute distances [m] and angles [rad] for `Task.errors`; shape (2, N)."""
    errors = np.empty((2, len(goals)))
    vectors = vectors_from_rotations(_relative(goal_Rs, Rs))
    for i in range(len(goals)):
        distance, angle = 0.0, 0.0
        for k in range(3):
            distance += weights[k] * (goals[i, k] - positions[i, k]) ** 2
            angle += weights[3 + k] * vectors[i, k] ** 2
        errors[0, i], errors[1, i] = math.sqrt(distance), math.sqrt(angle)
        if kind == AXIS:
            errors[1, i] = _angle_between(goal_Rs[i, :, axis], Rs[i, :, axis])
    return errors


@compiled
def _relative(Rs: Array, others: Array) -> Array:
    """RᵀS of each pair; shape (N, 3, 3)."""
    products = np.zeros((len(Rs), 3, 3))
    for i in range(len(Rs)):
        for row in range(3):
            for column in range(3):
                for k in range(3):
                    products[i, row, column] += Rs[i, k, row] * others[i, k, column]
    return products


@compiled
def _angle_between(a: Array, b: Array) -> float:
    """Angle between two unit vectors, accurate to rounding even near 0 and π."""
    difference, total = 0.0, 0.0
    for k in range(3):
        difference += (a[k] - b[k]) ** 2
        total += (a[k] + b[k]) ** 2
    return 2.0 * math.atan2(math.sqrt(difference), math.sqrt(total))
