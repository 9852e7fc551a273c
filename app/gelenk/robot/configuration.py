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
    # Most are lists; to ask whether something is a mapping takes long.
    rows = [
        value if type(value) is list or not isinstance(value, Mapping) else _by_name(chain, i, value, field)
        for i, value in enumerate(values)
    ]
    count = len(chain)
    for i, row in enumerate(rows):
        if len(row) != count:
            raise WrongJointCount(len(row), chain.joint_names, i, field)
    return checked_rows(chain, np.array(rows, dtype=float).reshape(len(rows), count), field)


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
    if (beyond := _beyond(chain.flat.drives, chain.flat.joints, rows, MAX_MAGNITUDE)) == _NUMBER:
        row, column = np.argwhere(~(np.abs(rows) <= MAX_MAGNITUDE))[0]
        name = quoted(chain.joint_names[column])
        raise InvalidField(
            field, f"entry {row}: the value of joint {name} must be a finite number of magnitude ≤ {MAX_MAGNITUDE:g}"
        )
    if beyond == _MIMIC:
        raise InvalidField(field, f"a mimic joint must also have a value of magnitude ≤ {MAX_MAGNITUDE:g}")
    return rows


_NUMBER, _MIMIC = 1, 2


@compiled
def _beyond(drives: Array, joints: Indices, qs: Array, most: float) -> int:
    """Return `_NUMBER` if a number is NaN or larger than `most`, else `_MIMIC` if so is a mimic joint's value, else 0.

    All numbers are looked at, without leaving the loops early: that is several times quicker where all are fine.
    """
    count = 0
    for row in range(qs.shape[0]):
        for column in range(qs.shape[1]):
            count += not abs(qs[row, column]) <= most
    if count:
        return _NUMBER
    for i in range(len(joints)):
        if drives[i, 0] != 1.0 or drives[i, 1] != 0.0:
            for row in range(qs.shape[0]):
                count += not abs(drives[i, 0] * qs[row, joints[i, 1]] + drives[i, 1]) <= most
    return _MIMIC if count else 0


def check_limits(chain: Chain, qs: Array) -> None:
    """Raise OutsideLimits for the first joint beyond its limits in configurations of shape (N, n), [rad or m]."""
    if _is_outside(chain.lower, chain.upper, qs):
        outside = (qs < chain.lower) | (qs > chain.upper)
        row, column = (int(index) for index in np.argwhere(outside)[0])
        value, lower, upper = (float(each) for each in (qs[row, column], chain.lower[column], chain.upper[column]))
        raise OutsideLimits(chain.joint_names[column], value, lower, upper, row)


@compiled
def _is_outside(lower: Array, upper: Array, qs: Array) -> bool:
    count = 0
    for row in range(qs.shape[0]):
        for column in range(qs.shape[1]):
            count += (qs[row, column] < lower[column]) | (qs[row, column] > upper[column])
    return count > 0


def _by_name(chain: Chain, index: int, value: Mapping[str, float], field: str) -> list[float]:
    for name in value:
        if name not in chain.robot_joints:
            raise UnknownJoint(name, chain.joint_names, index, field)
    for name in chain.joint_names:
        if name not in value:
            raise MissingJoint(name, chain.joint_names, index, field)
    return [value[name] for name in chain.joint_names]
