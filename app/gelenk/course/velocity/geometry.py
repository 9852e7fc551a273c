"""Axes and lever arms of a chain's joints at one configuration, and the columns of the Jacobian that they give.

A chain's frames are multiplied here one by one with NumPy: a second way beside the kernels.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.dh import about_z


@dataclass(frozen=True, slots=True)
class JointAxis:
    """A joint in the base's axes.

    Attributes:
        variable: Index of the variable that moves it.
        slides: Whether it is prismatic.
        rate: Its velocity per that of the variable: not 1 of a joint that follows another.
        axis, origin: z_{i-1} as a unit vector, and the origin of frame i-1, [m]; shape (3,).
    """

    variable: int
    slides: bool
    rate: float
    axis: Array
    origin: Array

    def column(self, point: Array) -> Array:
        """Return what its unit velocity does to a point of the last body: (z × p; z), or (z; 0); shape (6,)."""
        if self.slides:
            return np.concatenate((self.axis, np.zeros(3)))
        return np.concatenate((np.cross(self.axis, point - self.origin), self.axis))


@dataclass(frozen=True, slots=True)
class ChainGeometry:
    """The joints of a chain at one configuration, with T_base_tip; shape (4, 4)."""

    joints: tuple[JointAxis, ...]
    tip: Array
    variables: int

    @property
    def position(self) -> Array:
        """The tip's position; shape (3,), [m]."""
        return self.tip[:3, 3]

    def jacobian(self, point: Array | None = None) -> Array:
        """Put the columns together, for the tip or another point of the last body; shape (6, n)."""
        J = np.zeros((6, self.variables))
        for joint in self.joints:
            J[:, joint.variable] += joint.rate * joint.column(self.position if point is None else point)
        return J

    def time_variation(self, q_dot: Array) -> Array:
        """Differentiate the columns: (ż × p + z × ṗ; ż), with ż = ω × z and ṗ the rate of the lever arm; (6, n)."""
        dJ = np.zeros((6, self.variables))
        end = self.jacobian() @ q_dot
        for i, joint in enumerate(self.joints):
            before = ChainGeometry(self.joints[:i], self.tip, self.variables).jacobian(joint.origin) @ q_dot
            turned = np.cross(before[3:], joint.axis)
            if joint.slides:
                change = np.concatenate((turned, np.zeros(3)))
            else:
                linear = np.cross(turned, self.position - joint.origin) + np.cross(joint.axis, end[:3] - before[:3])
                change = np.concatenate((linear, turned))
            dJ[:, joint.variable] += joint.rate * change
        return dJ


def chain_geometry(flat: FlatChain, q: Array) -> ChainGeometry:
    """Follow a chain from base to tip at a configuration of shape (n,), [rad or m]."""
    T, joints = flat.placement(0), []
    rows = zip(flat.joints.tolist(), flat.drives.tolist(), strict=True)
    for i, ((slides, variable), (rate, offset)) in enumerate(rows):
        joints.append(JointAxis(variable, slides == 1, rate, T[:3, 2].copy(), T[:3, 3].copy()))
        T = T @ joint_motion(slides == 1, rate * float(q[variable]) + offset) @ flat.placement(i + 1)
    return ChainGeometry(tuple(joints), T, len(q))


def joint_motion(slides: bool, value: float) -> Array:
    """Return the motion along or about z by [m] or [rad]; shape (4, 4)."""
    return about_z(0.0, value) if slides else about_z(value, 0.0)
