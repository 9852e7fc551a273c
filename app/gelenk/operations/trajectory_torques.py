"""Limits of torque on a motion: from the request or the robot's description, with the payload and gravity."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from gelenk.contract.trajectory_request import Motion, MotionOptions
from gelenk.errors import InvalidField, listed
from gelenk.kinematics.dynamics.mechanism import ChainMechanism, mechanism
from gelenk.kinematics.dynamics.torques import torque_limits
from gelenk.operations.loads import gravity_of, load_of, mass_notes
from gelenk.operations.trajectory_limits import SourcedLimits, joint_row
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.torques import TorqueLimits

_FIELD = "limits.joint_torque"


def with_torques(
    robot: RobotModel, chain: Chain, call: Motion, bounds: Sequence[SourcedLimits]
) -> tuple[SourcedLimits, ...]:
    """Give limits of torque to those of the whole motion, which come first, and of each segment.

    Without a limit, a payload, or samples of torque in the request they stay as they are.
    """
    if not len(chain) or not has_torques(call):
        return tuple(bounds)
    found = mechanism(robot, chain)
    if _limits_torques(call):
        _refuse_without_mass(found)
    load, gravity = load_of(call.payload), gravity_of(call.gravity)
    overall = _most(robot, chain, call, "", np.full(len(chain), np.inf))
    limits = torque_limits(found, overall, np.zeros(3) if gravity is None else gravity, load)
    each = [_most(robot, chain, one, f"segments.{i}.", overall) for i, one in enumerate(call.moves())]
    return tuple(_with(one, replace(limits, most=most)) for one, most in zip(bounds, (overall, *each), strict=True))


def has_torques(call: Motion) -> bool:
    """Check whether torques count in a request."""
    return call.torques or call.payload is not None or _limits_torques(call)


def _limits_torques(call: Motion) -> bool:
    return any(
        (limits := one.own_limits()) is not None and limits.joint_torque is not None for one in (call, *call.moves())
    )


def torque_notes(robot: RobotModel, chain: Chain, call: Motion) -> list[str]:
    """Return a sentence on each thing that the torques leave out."""
    return mass_notes(mechanism(robot, chain), load_of(call.payload))


def _with(bounds: SourcedLimits, torque: TorqueLimits) -> SourcedLimits:
    return replace(bounds, limits=replace(bounds.limits, torque=torque))


def _most(robot: RobotModel, chain: Chain, options: MotionOptions, prefix: str, otherwise: Array) -> Array:
    """Return the limit of each joint's torque, infinite for none; shape (n,), [N m or N]."""
    limits, field = options.own_limits(), f"{prefix}{_FIELD}"
    given = None if limits is None else limits.joint_torque
    if given is None:
        return otherwise
    if given != "effort":
        found = joint_row(chain, given, field)
        return np.where(np.isfinite(found), found, otherwise)
    efforts = np.array([robot.description.joint[name].limits.effort or np.inf for name in chain.joint_names])
    if np.isinf(efforts).any():
        without = listed(tuple(name for name, most in zip(chain.joint_names, efforts, strict=True) if np.isinf(most)))
        raise InvalidField(field, f"the robot's description gives no effort limit of {without}: give the limits")
    return efforts


def _refuse_without_mass(found: ChainMechanism) -> None:
    """Refuse limits of torque on a robot of which something that moves has no mass: it would seem to cost nothing."""
    light = tuple(link for body in found.bodies if body.mass == 0.0 for link in body.links)
    if light:
        raise InvalidField(
            _FIELD,
            f"the description gives no mass to {listed(light)}, so torques would be too small: upload a description "
            "with `inertial` elements",
        )
