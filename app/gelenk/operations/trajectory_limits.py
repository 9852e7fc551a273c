"""Limits of joints and tip on a segment: the request's, else the robot description's, else assumed.

A URDF gives velocities at most. Limits that it lacks are assumed, and the answer says so: accelerations that reach the
velocity limit in half a second and jerks that reach the acceleration limit in a tenth of one, as industrial arms of a
few kilograms do.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gelenk.contract.trajectory_answer import LimitSource
from gelenk.contract.trajectory_request import JointValues, MotionOptions
from gelenk.errors import UnknownJoint, WrongJointCount, quoted
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.problem.problem import SegmentLimits

QUANTITIES = ("joint_velocity", "joint_acceleration", "joint_jerk")
TURNING = 1.0
"""Assumed velocity limit of a revolute joint, [rad/s]."""
SLIDING = 0.25
"""Assumed velocity limit of a prismatic joint, [m/s]: the reduced speed of ISO 10218."""
PLACEHOLDER = 100.0
"""Velocity limit, [rad/s or m/s], from which on a limit means none: robot files use 100, 1000, 10000 and 1e16."""
_OF_TIP = ("tip_velocity", "tip_angular_velocity", "tip_acceleration", "tip_angular_acceleration")
ACCELERATION_RATE = 2.0
JERK_RATE = 10.0
"""Assumed limit divided by that of the derivative before it, [1/s]."""

_KEPT = 64
"""Chains whose own limits are remembered."""

_ASSUMED = {
    "joint_velocity": marked(
        "the robot's description has no velocity limit of {joints}: {turning:g} rad/s is assumed, of a sliding joint "
        "{sliding:g} m/s"
    ),
    "joint_acceleration": marked(
        "the acceleration limits of {joints} are assumed: they reach the velocity limit in {to_velocity:g} s"
    ),
    "joint_jerk": marked(
        "the jerk limits of {joints} are assumed: they reach the acceleration limit in {to_acceleration:g} s"
    ),
}
_NUMBERS = {
    "turning": TURNING,
    "sliding": SLIDING,
    "to_velocity": 1.0 / ACCELERATION_RATE,
    "to_acceleration": 1.0 / JERK_RATE,
}


@dataclass(frozen=True, slots=True)
class SourcedLimits:
    """Limits with the scales applied, and the source of each joint's limit, by quantity."""

    limits: SegmentLimits
    sources: dict[str, tuple[LimitSource, ...]]


@dataclass(frozen=True, slots=True)
class OwnVelocities:
    """Velocity limits of the robot's description, or assumed ones, and which are known; shape (n,), [rad/s or m/s]."""

    values: Array
    known: Flags


@lru_cache(_KEPT)
def own_velocities(robot: RobotModel, chain: Chain) -> OwnVelocities:
    """Return the velocity limits of a chain's variables."""
    joints = [robot.description.joint[name] for name in chain.joint_names]
    given = np.array([joint.limits.velocity or 0.0 for joint in joints], dtype=float)
    known = (given > 0.0) & (given < PLACEHOLDER)
    otherwise = np.array([SLIDING if joint.type == "prismatic" else TURNING for joint in joints], dtype=float)
    return OwnVelocities(np.where(known, given, otherwise), known)


def has_own_limits(options: MotionOptions) -> bool:
    """Check whether options change any limit."""
    scales = options.velocity_scale, options.acceleration_scale
    return options.limits is not None or scales != (None, None)


def bounds_of(chain: Chain, own: OwnVelocities, layers: Mapping[str, MotionOptions]) -> SourcedLimits:
    """Return the limits in force; raises WrongJointCount or UnknownJoint.

    `layers` are options that contain limits, by the prefix of their fields; later ones override earlier ones.
    """
    values: list[float] = own.values.tolist()
    source: list[LimitSource] = ["robot" if is_known else "assumed" for is_known in own.known.tolist()]
    rows: list[Array] = []
    sources: dict[str, tuple[LimitSource, ...]] = {}
    for quantity, rate in zip(QUANTITIES, (None, ACCELERATION_RATE, JERK_RATE), strict=True):
        if rate is not None:
            values, source = [rate * value for value in values], ["assumed"] * len(chain)
        for prefix, options in layers.items():
            limits = options.own_limits()
            given = None if limits is None else getattr(limits, quantity)
            if type(given) is list and len(given) == len(chain):  # as mostly
                values, source = given, ["request"] * len(chain)
            elif given is not None:
                found = joint_row(chain, given, f"{prefix}limits.{quantity}").tolist()
                values = [one if math.isfinite(one) else old for one, old in zip(found, values, strict=True)]
                source = ["request" if math.isfinite(one) else old for one, old in zip(found, source, strict=True)]
        rows.append(np.array(values))
        sources[quantity] = tuple(source)
    faster, harder, tip = 1.0, 1.0, [math.inf] * len(_OF_TIP)
    for options in layers.values():
        faster, harder = options.velocity_scale or faster, options.acceleration_scale or harder
        limits = options.own_limits()
        if limits is not None:
            tip = [getattr(limits, name) or most for name, most in zip(_OF_TIP, tip, strict=True)]
    by_tip = TipLimits(tip[0] * faster, tip[1] * faster, tip[2] * harder, tip[3] * harder)
    return SourcedLimits(SegmentLimits(rows[0] * faster, rows[1] * harder, rows[2] * harder, by_tip), sources)


def joint_row(chain: Chain, given: JointValues, field: str) -> Array:
    """Return one number per joint, NaN if a name is left out; shape (n,)."""
    if isinstance(given, dict):
        for name in given:
            if name not in chain.joint_names:
                raise UnknownJoint(name, chain.joint_names, None, field)
        return np.array([given.get(name, math.nan) for name in chain.joint_names])
    if isinstance(given, list):
        if len(given) != len(chain):
            raise WrongJointCount(len(given), chain.joint_names, None, field)
        return np.array(given, dtype=float)
    return np.full(len(chain), given)


def limit_notes(chain: Chain, own: OwnVelocities, used: Sequence[SourcedLimits]) -> list[str]:
    """Return notes on limits assumed on any of the segments, and on limits beyond the robot's own."""
    notes = []
    for quantity, words in _ASSUMED.items():
        assumed = [any(bounds.sources[quantity][j] == "assumed" for bounds in used) for j in range(len(chain))]
        if any(assumed):
            notes.append(_(words).format(joints=_names(chain, assumed), **_NUMBERS))
    beyond = [
        bool(own.known[j]) and any(bounds.limits.velocity[j] > own.values[j] for bounds in used)
        for j in range(len(chain))
    ]
    if any(beyond):
        text = _("the velocity limits of {joints} are higher than the robot's own, as requested")
        notes.append(text.format(joints=_names(chain, beyond)))
    return notes


def _names(chain: Chain, chosen: Sequence[bool]) -> str:
    if all(chosen):
        return _("all joints")
    return ", ".join(quoted(name) for name, one in zip(chain.joint_names, chosen, strict=True) if one)
