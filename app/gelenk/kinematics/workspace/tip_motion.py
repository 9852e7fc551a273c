"""Directions in which a chain's tip can move: the line, plane or space of its velocities, and its reach."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from gelenk.errors import counted
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.kinematics.velocity.subspaces import rounding
from gelenk.kinematics.workspace.sampling import Ranges, Sampling
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, FlatChain

_PROBES = 4096
"""Number of samples that estimate the size of the workspace, to choose the cells."""
_DIRECTIONS = 64
"""Number of configurations that determine in which directions the tip moves at all."""
_STRUCTURAL = 1e-9
"""The tip never moves in a direction if its velocity stays below this share of the largest."""


class TipReach:
    """The directions in which a chain's tip moves at all, and its reach, from sampled configurations."""

    def __init__(self, chain: Chain, sampling: Sampling) -> None:
        qs = sampling.configurations(0, min(_PROBES, sampling.count))
        # Directions depend on structure only: use separate samples, even if a single configuration is requested.
        probes = replace(sampling, sequence="random", seed=0).configurations(0, _DIRECTIONS)
        self.positions = chain_poses(chain.flat, qs)[0]
        _, self._rotations, self._Js = chain_jacobians(chain.flat, probes)
        self._moves = sampling.ranges.upper > sampling.ranges.lower
        self._velocities = self._Js.transpose(1, 0, 2).reshape(6, -1)
        self.farthest = _farthest(chain, sampling.ranges)

    @cached_property
    def _decomposition(self) -> tuple[Array, int]:
        return _span(self._velocities[:3])

    @property
    def dimensions(self) -> int:
        """Dimension of the smallest line, plane or space that contains all velocities of the tip."""
        return self._decomposition[1]

    @cached_property
    def axes(self) -> Array:
        """Right-handed unit vectors as columns, directions of motion first; shape (3, 3)."""
        left, rank = self._decomposition
        if rank == 2:
            return plane_axes(left[:, 2])
        return np.roll(plane_axes(left[:, 0]), 1, axis=1) if rank == 1 else np.eye(3)

    @cached_property
    def rows(self) -> list[int] | None:
        """Indices of the base's axes that span the directions of motion; None if these are oblique to the axes."""
        still = np.abs(self._velocities[:3]).max(axis=1, initial=0.0)
        moving = np.flatnonzero(still > _STRUCTURAL * max(float(still.max()), np.finfo(float).tiny))
        return moving.tolist() if len(moving) == self.dimensions else None

    @cached_property
    def local_dimensions(self) -> int:
        """Dimension of the set of positions: less than `dimensions` for a curve or a curved surface."""
        return _largest_rank(self._Js[:, :3])

    @property
    def kept_to(self) -> str | None:
        """`curve` or `surface` if the tip stays on a curved one, else None."""
        if self.local_dimensions == self.dimensions:
            return None
        return "surface" if self.local_dimensions == 2 else "curve"

    def notes(self) -> list[str]:
        """Return remarks on the positions that the tip reaches."""
        if self.dimensions == 0:
            return ["the tip does not move"]
        if self.kept_to is None:
            return []
        dimensions = counted(self.local_dimensions, "direction")
        why = f"the tip stays on a {self.kept_to}: the volume of the voxels it passes through shrinks with their size"
        return [f"{why}, and the measure of more than {dimensions} vanishes everywhere"]

    def slice_notes(self, normal: Array) -> list[str]:
        """Explain why a slice with this unit normal, shape (3,), has no area; empty if it has one."""
        crosses = bool(np.abs(normal @ self.axes[:, : self.dimensions]).max(initial=0.0) > _STRUCTURAL)
        left = self.local_dimensions - crosses
        if left >= 2 or self.dimensions == 0:
            return []
        what = "points" if left == 0 else "a line" if self.kept_to is None else "a curve"
        return [f"the slice meets the reachable set only in {what}: the area of its voxels shrinks with their size"]

    def is_singular(self, rows: list[int], turn: Array | None) -> bool:
        """Return whether some rows of the Jacobian are dependent at every configuration, so that their measure is zero.

        The columns of `turn`, shape (3, 3), are the axes of the rows; None for the base's.
        """
        Js = in_axes(self._Js, turn)
        if not rows or Js.shape[2] == 0:
            return True
        return bool((np.linalg.svd(Js[:, rows], compute_uv=False)[:, -1] <= rounding(Js)).all())

    @cached_property
    def turning(self) -> tuple[Array, int]:
        """Unit vectors as columns, the tip's rotation axes first, and the number of these; shape (3, 3)."""
        return _span(self._velocities[3:])

    def ranks(self, direction_only: bool) -> tuple[int, int]:
        """Count the independent velocities of the tip: in position, and in position and orientation together.

        With `direction_only`, only the direction of the tip's z axis counts as orientation.
        """
        Js = self._Js[:, :, self._moves]
        moving = Js[:, :3] / max(self.farthest, np.finfo(float).tiny)
        turning = (self._rotations.transpose(0, 2, 1) @ Js[:, 3:])[:, : 2 if direction_only else 3]
        return _largest_rank(moving), _largest_rank(np.concatenate((moving, turning), axis=1))


def in_axes(Js: Array, turn: Array | None) -> Array:
    """Express Jacobians, shape (N, 6, n), in the axes that are columns of a rotation; the base's if None."""
    return Js if turn is None else np.concatenate((turn.T @ Js[:, :3], turn.T @ Js[:, 3:]), axis=1)


def _largest_rank(matrices: Array) -> int:
    scale = float(np.abs(matrices).max(initial=np.finfo(float).tiny))
    return int(np.linalg.matrix_rank(matrices, tol=_STRUCTURAL * scale).max()) if matrices.size else 0


def _span(vectors: Array) -> tuple[Array, int]:
    """Orthonormal columns, those that span the vectors first, shape (3, 3), and the number of these."""
    left, sigmas, _ = np.linalg.svd(np.hstack((vectors, np.zeros((3, 3)))), full_matrices=False)
    return left, int(np.sum(sigmas > _STRUCTURAL * max(float(sigmas[0]), np.finfo(float).tiny)))


def plane_axes(normal: Array) -> Array:
    """Return two unit vectors in a plane and its normal as right-handed columns, along the base's axes if possible.

    The second vector's largest component is positive: for the plane x z it is z, and the normal is reversed for that.
    """
    smallest = int(np.argmin(np.abs(normal)))
    u = np.eye(3)[smallest] - normal[smallest] * normal
    u /= np.linalg.norm(u)
    v = np.cross(normal, u)
    sign = 1.0 if v[int(np.argmax(np.abs(v)))] > 0.0 else -1.0
    # Adding zero turns -0.0 into 0.0.
    return np.column_stack((u, sign * v, sign * normal)) + 0.0


def turned(flat: FlatChain, axes: Array) -> FlatChain:
    """Return the chain expressed in a base whose axes are the given columns."""
    first = flat.placements[0]
    rotation, position = axes.T @ first[:9].reshape(3, 3), axes.T @ first[9:]
    placements = flat.placements.copy()
    placements[0] = np.concatenate((rotation.ravel(), position))
    return flat._replace(placements=placements)


def _farthest(chain: Chain, ranges: Ranges) -> float:
    """Upper bound of the tip's distance from the base's origin, [m]: the sum of all lengths."""
    total = float(np.linalg.norm(chain.flat.placements[:, 9:], axis=1).sum())
    for (prismatic, variable), (multiplier, offset) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        if prismatic:
            largest = max(abs(ranges.lower[variable]), abs(ranges.upper[variable]))
            total += abs(multiplier) * float(largest) + abs(offset)
    return total
