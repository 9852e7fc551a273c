"""The point and axes of a wrench, and the Jacobian at that point, in these axes.

A wrench and its dual twist refer to the same point and axes, so γᵀv is a power. The twist is that of the tip's body
relative to the base, at the body point that coincides with the given point, so τ = Jᵀγ for any point.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.errors import InvalidField
from gelenk.kinematics.dynamics.mechanism import mechanism
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel


@dataclass(frozen=True, slots=True)
class WrenchFrame:
    """Axes and point of a wrench.

    Attributes:
        reference: `local_world_aligned`: base axes, at the tip. `local`: tip axes, at the tip. `world`: base axes, at
            the base origin.
        expressed_in: Frame whose axes replace those of the reference.
        point: Point that replaces that of the reference, in coordinates of `point_frame`, [m].
        point_frame: Frame of `point`; the tip if None.
    """

    reference: Reference = "local_world_aligned"
    expressed_in: str | None = None
    point: Sequence[float] | None = None
    point_frame: str | None = None

    def check(self) -> None:
        """Refuse contradictory fields: raises InvalidField if one needs or excludes another."""
        if self.expressed_in is not None and self.reference != "local_world_aligned":
            raise InvalidField("expressed_in", "it names the axes itself, so no other `reference` may be given")
        if self.point is not None and self.reference == "world":
            raise InvalidField("point", "not allowed with `world`, which takes the origin of the base")
        if self.point_frame is not None and self.point is None:
            raise InvalidField("point_frame", "it needs `point`")

    def poses(self, chain: Chain, poses_of: Callable[[str], Poses]) -> Poses:
        """Return point and axes in the base frame; `poses_of` gives the poses of a named frame in the base."""
        tip = poses_of(chain.tip_frame)
        points, axes = tip.positions, tip.rotations
        if self.reference != "local":
            axes = np.broadcast_to(np.eye(3), axes.shape)
        if self.reference == "world":
            points = np.zeros_like(points)
        if self.expressed_in is not None:
            axes = poses_of(self.expressed_in).rotations
        if self.point is not None:
            frame = tip if self.point_frame is None else poses_of(self.point_frame)
            points = frame.positions + frame.rotations @ np.array(self.point)
        return Poses(points, axes)


def frame_jacobians(robot: RobotModel, chain: Chain, qs: Array, frame: WrenchFrame) -> tuple[Poses, Array, Array]:
    """Compute the pose of a wrench frame, and the Jacobian in it; joints off the chain are at zero.

    Returns:
        Point and axes in the base frame, Jacobians of shape (N, 6, n), linear before angular, and the terms of their
        linear rows, to which rounding is relative, of shape (N, 3, n).
    """
    frame.check()
    positions, rotations, Js = chain_jacobians(chain.flat, qs)
    tip = Poses(positions, rotations)

    def poses_of(name: str) -> Poses:
        if name == chain.tip_frame:
            return tip
        found = mechanism(robot, chain)
        part, columns = found.robot.frame_on(found.chain, name)
        return Poses(*chain_poses(part.flat, np.ascontiguousarray(qs[:, columns])))

    places = frame.poses(chain, poses_of)
    if places.positions is not positions:
        levers = (places.positions - positions)[:, :, None]
        Js[:, :3] += np.cross(Js[:, 3:], levers, axis=1)
    far = np.linalg.norm(positions, axis=1) + np.linalg.norm(places.positions, axis=1)
    terms = Js[:, 3:] * far[:, None, None]
    inverse = places.rotations.swapaxes(1, 2)
    return places, np.concatenate((inverse @ Js[:, :3], inverse @ Js[:, 3:]), axis=1), terms


def in_base_axes(places: Poses, rows: Indices, wrenches: Array) -> Array:
    """Expand wrenches to six components and rotate them into the base's axes; shape (N, m) → (N, 6)."""
    full = np.zeros((len(wrenches), 6))
    full[:, rows] = wrenches
    return np.asarray(np.einsum("kij,kpj->kpi", places.rotations, full.reshape(-1, 2, 3)).reshape(-1, 6))
