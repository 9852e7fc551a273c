"""Conversion of configurations, given in order or by joint name, to one checked array in the chain's order."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from gelenk.errors import (
    InvalidArray,
    InvalidField,
    MissingJoint,
    OutsideLimits,
    UnknownJoint,
    WrongJointCount,
    counted,
    quoted,
)
from gelenk.robot.arrays import Array, Configuration, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import compiled

MAX_MAGNITUDE = 1e6
"""Largest joint position or velocity, [rad or m (/s)]: a larger double does not resolve a nanoradian."""


def configurations(chain: Chain, values: Sequence[Configuration] | Array, field: str = "joint_positions") -> Array:
    """Convert configurations (or velocities) to rows in the chain's order; shape (N, n), [rad or m (/s)].

    Values are in the chain's order or by joint name; an array must already have this shape. Messages name the `field`.

    Raises:
        WrongJointCount: A configuration does not have one number per joint.
        MissingJoint: A configuration given by name omits a joint.
        UnknownJoint: A configuration names a joint that the robot does not have; its joints off the chain are ignored.
        InvalidField: A number is not finite or exceeds `MAX_MAGNITUDE`.
        InvalidArray: The array is not two-dimensional.
    """
    if isinstance(values, np.ndarray):
        return checked_rows(chain, values, field)
    rows = [_by_name(chain, i, value, field) if isinstance(value, Mapping) else value for i, value in enumerate(values)]
    for i, row in enumerate(rows):
        if len(row) != len(chain):
            raise WrongJointCount(len(row), chain.joint_names, i, field)
    return checked_rows(chain, np.array(rows, dtype=float).reshape(len(rows), len(chain)), field)


def one_configuration(chain: Chain, value: Configuration, field: str) -> Array:
    """Convert a single configuration; shape (1, n). Raises as `configurations` does."""
    try:
        return configurations(chain, [value], field)
    except (WrongJointCount, MissingJoint, UnknownJoint) as error:
        raise replace(error, index=None) from None


def checked_rows(chain: Chain, rows: Array, field: str) -> Array:
    """Return rows of one number per joint, of sensible size, unchanged; raises as `configurations` does."""
    if rows.ndim != 2:
        raise InvalidArray(
            f"{field} form an array of shape (N, {len(chain)}); this one has {counted(rows.ndim, 'dimension')}"
        )
    if rows.shape[1] != len(chain):
        raise WrongJointCount(rows.shape[1], chain.joint_names, None, field)
    if not _within(rows, MAX_MAGNITUDE):
        row, column = np.argwhere(~(np.abs(rows) <= MAX_MAGNITUDE))[0]
        name = quoted(chain.joint_names[column])
        raise InvalidField(
            field, f"entry {row}: the value of joint {name} must be a finite number of magnitude ≤ {MAX_MAGNITUDE:g}"
        )
    if not _joints_within(chain.flat.drives, chain.flat.joints, rows, MAX_MAGNITUDE):
        raise InvalidField(field, f"a mimic joint must also have a value of magnitude ≤ {MAX_MAGNITUDE:g}")
    return rows


@compiled
def _joints_within(drives: Array, joints: Indices, qs: Array, most: float) -> bool:
    """Whether all joint positions, mimic joints included, have at most a magnitude; false for NaN."""
    for i in range(len(joints)):
        for row in range(qs.shape[0]):
            if not abs(drives[i, 0] * qs[row, joints[i, 1]] + drives[i, 1]) <= most:
                return False
    return True


@compiled
def _within(qs: Array, most: float) -> bool:
    """Whether all numbers have at most a magnitude; false for NaN."""
    for row in range(qs.shape[0]):
        for column in range(qs.shape[1]):
            if not abs(qs[row, column]) <= most:
                return False
    return True


def check_limits(chain: Chain, qs: Array) -> None:
    """Raise OutsideLimits for the first joint beyond its limits in configurations of shape (N, n), [rad or m]."""
    outside = (qs < chain.lower) | (qs > chain.upper)
    if outside.any():
        row, column = (int(index) for index in np.argwhere(outside)[0])
        value, lower, upper = (float(each) for each in (qs[row, column], chain.lower[column], chain.upper[column]))
        raise OutsideLimits(chain.joint_names[column], value, lower, upper, row)


def _by_name(chain: Chain, index: int, value: Mapping[str, float], field: str) -> list[float]:
    for name in value:
        if name not in chain.robot_joints:
            raise UnknownJoint(name, chain.joint_names, index, field)
    for name in chain.joint_names:
        if name not in value:
            raise MissingJoint(name, chain.joint_names, index, field)
    return [value[name] for name in chain.joint_names]
