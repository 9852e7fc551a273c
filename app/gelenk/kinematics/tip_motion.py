"""Where a chain's tip moves at all: the line, plane or space of its velocities, and how far it can get."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from gelenk.kinematics.kernels import chain_jacobians, chain_poses
from gelenk.kinematics.sampling import Ranges, Sampling
from gelenk.kinematics.subspaces import rounding
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain, FlatChain
from gelenk.model.errors import counted

_PROBES = 4096
"""Samples that say how large the workspace is before it is cut into cells."""
_DIRECTIONS = 64
"""Configurations that say in which directions the tip moves at all."""
_STRUCTURAL = 1e-9
"""Share of the largest velocity below which a direction is one in which the tip never moves."""


class Motion:
    """The directions in which the tip moves at all, and how far, from some configurations.

    Args:
        chain: The chain.
        sampling: Its configurations.
    """

    def __init__(self, chain: Chain, sampling: Sampling) -> None:
        qs = sampling.configurations(0, min(_PROBES, sampling.count))
        # Directions are a matter of structure, and a few samples of their own tell them even where one is asked for.
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
        """The dimension of the smallest line, plane or space that holds all velocities of the tip."""
        return self._decomposition[1]

    @cached_property
    def axes(self) -> Array:
        """Unit vectors as columns, right-handed, the directions that the tip moves in first; shape (3, 3)."""
        left, rank = self._decomposition
        if rank == 2:
            return plane_axes(left[:, 2])
        return np.roll(plane_axes(left[:, 0]), 1, axis=1) if rank == 1 else np.eye(3)

    @cached_property
    def rows(self) -> list[int] | None:
        """The base's axes that these directions are; None where they lie askew to them."""
        still = np.abs(self._velocities[:3]).max(axis=1, initial=0.0)
        moving = np.flatnonzero(still > _STRUCTURAL * max(float(still.max()), np.finfo(float).tiny))
        return moving.tolist() if len(moving) == self.dimensions else None

    @cached_property
    def local_dimensions(self) -> int:
        """Of what the tip keeps to: less than `dimensions` where that is a curve or a surface that is not flat."""
        if self.dimensions == 0:
            return 0
        velocities = self._velocities[:3].reshape(3, _DIRECTIONS, -1).transpose(1, 0, 2)
        return int(np.linalg.matrix_rank(velocities, tol=_STRUCTURAL * float(np.abs(velocities).max())).max())

    @property
    def kept_to(self) -> str | None:
        """`curve` or `surface`, where the tip keeps to one that is not flat."""
        if self.local_dimensions == self.dimensions:
            return None
        return "surface" if self.local_dimensions == 2 else "curve"

    def notes(self) -> list[str]:
        """Remarks on the places that the tip reaches."""
        if self.dimensions == 0:
            return ["the tip does not move"]
        if self.kept_to is None:
            return []
        note = (
            f"the tip stays on a {self.kept_to}: the voxels that it meets have a volume that shrinks with their size, "
            f"and the measure of more than {counted(self.local_dimensions, 'direction')} vanishes everywhere"
        )
        return [note]

    def slice_notes(self, normal: Array) -> list[str]:
        """Why a slice with this unit normal, shape (3,), has no area, where it has none."""
        crosses = bool(np.abs(normal @ self.axes[:, : self.dimensions]).max(initial=0.0) > _STRUCTURAL)
        left = self.local_dimensions - crosses
        if left >= 2 or self.dimensions == 0:
            return []
        what = "points" if left == 0 else "a line" if self.kept_to is None else "a curve"
        return [f"the slice meets where the tip gets in {what} only: the area of its voxels shrinks with their size"]

    def is_singular(self, rows: list[int], turn: Array | None) -> bool:
        """Whether some of the Jacobian's rows depend on each other wherever the chain is: their measure is zero.

        Args:
            rows: Which rows count.
            turn: Along which axes, as columns, shape (3, 3); the base's where None.
        """
        Js = self._Js
        if turn is not None:
            Js = np.concatenate((turn.T @ Js[:, :3], turn.T @ Js[:, 3:]), axis=1)
        if not rows or Js.shape[2] == 0:
            return True
        return bool((np.linalg.svd(Js[:, rows], compute_uv=False)[:, -1] <= rounding(Js)).all())

    @cached_property
    def turning(self) -> tuple[Array, int]:
        """Unit vectors as columns, those that the tip turns about first, and how many these are."""
        return _span(self._velocities[3:])

    def ranks(self, direction_only: bool) -> tuple[int, int]:
        """Independent velocities of the tip, at most: in position, and in position and orientation together.

        Args:
            direction_only: Whether of the orientation the direction of the tip's z axis alone counts.
        """
        Js = self._Js[:, :, self._moves]
        moving = Js[:, :3] / max(self.farthest, np.finfo(float).tiny)
        turning = (self._rotations.transpose(0, 2, 1) @ Js[:, 3:])[:, : 2 if direction_only else 3]
        return _largest_rank(moving), _largest_rank(np.concatenate((moving, turning), axis=1))


def _largest_rank(matrices: Array) -> int:
    """Shape (N, m, n)."""
    scale = float(np.abs(matrices).max(initial=np.finfo(float).tiny))
    return int(np.linalg.matrix_rank(matrices, tol=_STRUCTURAL * scale).max()) if matrices.size else 0


def _span(vectors: Array) -> tuple[Array, int]:
    """Orthonormal columns, those that span the vectors first, shape (3, 3), and how many these are."""
    left, sigmas, _ = np.linalg.svd(np.hstack((vectors, np.zeros((3, 3)))), full_matrices=False)
    return left, int(np.sum(sigmas > _STRUCTURAL * max(float(sigmas[0]), np.finfo(float).tiny)))


def plane_axes(normal: Array) -> Array:
    """Two unit vectors in a plane and its normal, as columns; right-handed, along the base's axes where these fit.

    The second looks upwards: for the plane x z it is z, and the normal changes its sign for that.
    """
    smallest = int(np.argmin(np.abs(normal)))
    u = np.eye(3)[smallest] - normal[smallest] * normal
    u /= np.linalg.norm(u)
    v = np.cross(normal, u)
    sign = 1.0 if v[int(np.argmax(np.abs(v)))] > 0.0 else -1.0
    # Sums with zero leave no negative zeros.
    return np.column_stack((u, sign * v, sign * normal)) + 0.0


def turned(flat: FlatChain, axes: Array) -> FlatChain:
    """The chain with a base whose axes are the given columns."""
    first = flat.placements[0]
    rotation, position = axes.T @ first[:9].reshape(3, 3), axes.T @ first[9:]
    placements = flat.placements.copy()
    placements[0] = np.concatenate((rotation.ravel(), position))
    return flat._replace(placements=placements)


def _farthest(chain: Chain, ranges: Ranges) -> float:
    """No position of the tip is further from the base's origin, [m]: all lengths in a row."""
    total = float(np.linalg.norm(chain.flat.placements[:, 9:], axis=1).sum())
    for (prismatic, variable), (multiplier, offset) in zip(chain.flat.joints, chain.flat.drives, strict=True):
        if prismatic:
            largest = max(abs(ranges.lower[variable]), abs(ranges.upper[variable]))
            total += abs(multiplier) * float(largest) + abs(offset)
    return total
