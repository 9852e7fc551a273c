"""Torques of a motion's planner and of its audit, for one chain with a payload; the audit's are Pinocchio's."""

import numpy as np

from gelenk.kinematics.dynamics.bodies import Load, RigidBody
from gelenk.kinematics.dynamics.mechanism import ChainMechanism, PinocchioDynamics
from gelenk.kinematics.dynamics.newton_euler import add_torques
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.torques import TorqueLimits


def torque_limits(found: ChainMechanism, most: Array, gravity: Array, load: Load | None) -> TorqueLimits:
    """Return limits of torque with both ways to compute them.

    Args:
        most: Of each joint, infinite for none; shape (n,), [N m or N].
        gravity: In the axes of the robot's root; shape (3,), [m/s²].
    """
    carried = [(body.flat, body.columns, _weights(body)) for body in found.carried(load) if len(body.columns)]

    def parts(q: Array, v: Array, a: Array) -> tuple[Array, Array]:
        states = np.ascontiguousarray(q), np.ascontiguousarray(v), np.ascontiguousarray(a)
        inertial, weight = np.zeros(q.shape), np.zeros(q.shape)
        for flat, columns, weights in carried:
            add_torques(flat, columns, weights, gravity, states, inertial, weight)
        return inertial, weight

    def recomputed(q: Array, v: Array, a: Array) -> Array:
        return PinocchioDynamics(found, gravity, load).inverses(q, v, a)

    joints, names = found.robot.description.joint, found.chain.joint_names
    units = tuple("N" if joints[name].type == "prismatic" else "N m" for name in names)
    return TorqueLimits(most, parts, recomputed, names, units)


def _weights(body: RigidBody) -> Array:
    return np.concatenate(([body.mass], body.center, body.inertia.ravel()))
