"""Denavit-Hartenberg tables, standard and modified, and their products of transforms.

Standard (distal): A_i = Rz(θ_i) Tz(d_i) Tx(a_i) Rx(α_i), the course's convention.
Modified (proximal, Craig): A_i = Rx(α_i) Tx(a_i) Rz(θ_i) Tz(d_i).

A row may follow another joint, as some joints of real robots do: its position is then multiplier · leader + offset. The
leader is an independent row, or a joint outside the table, which becomes an additional variable.

The product here shares no code with the URDF written from a table, so that each can verify the other.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidDhTable, WrongJointCount, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.description import MAX_BOUND, MAX_NAME_LENGTH, Mimic

Convention: TypeAlias = Literal["standard", "modified"]
JointType: TypeAlias = Literal["revolute", "prismatic"]

MAX_JOINTS = 64
MAX_LENGTH = 1e6
"""Largest length in a table, [m]: beyond it, a double cannot resolve a nanometre."""
MAX_ANGLE = 1e6
"""Largest angle in a table, [rad]: beyond it, a double cannot resolve a nanoradian."""
MAX_SNAP_TOLERANCE = 0.1
"""Largest tolerance for snapping a number of a table to one that a person would write, [m or rad]."""
MAX_MULTIPLIER = 1e6
"""Largest multiplier of a row that follows another joint, as in a URDF."""


@dataclass(frozen=True, slots=True)
class DhJoint:
    """One row. The joint's position adds to `theta` (revolute) or `d` (prismatic); lengths [m], angles [rad].

    Limits apply to the position alone, without the offset; velocity in [rad/s or m/s], effort in [N m or N]. The
    position is a variable of the table, unless `mimic` makes the row follow another joint.
    """

    name: str
    type: JointType
    a: float
    alpha: float
    d: float
    theta: float
    lower: float | None = None
    upper: float | None = None
    velocity: float | None = None
    effort: float | None = None
    mimic: Mimic | None = None

    @property
    def limits(self) -> tuple[float, float]:
        """Lower and upper bound of the position, [rad or m]; ±π rad or ±1 m where the table omits one."""
        default = math.pi if self.type == "revolute" else 1.0
        return (
            -default if self.lower is None else self.lower,
            default if self.upper is None else self.upper,
        )

    def transform(self, position: float, convention: Convention) -> Array:
        """Return A_i at a position of the joint, [rad or m]; shape (4, 4)."""
        revolute = self.type == "revolute"
        theta = self.theta + position if revolute else self.theta
        d = self.d if revolute else self.d + position
        turn, shift = about_z(theta, d), about_x(self.alpha, self.a)
        return turn @ shift if convention == "standard" else shift @ turn


@dataclass(frozen=True)
class DhTable:
    """A chain as a table between a base and a tool transform: T_base_tool = base · A_1 ⋯ A_n · tool.

    The rows go from base to tip; `base` is T_base_0 and `tool` is T_n_tool, each of shape (4, 4).

    Raises:
        InvalidDhTable: No rows or too many, duplicate or invalid names, a lower limit above the upper one, lengths or
            angles out of range, or a row that follows a follower.
    """

    convention: Convention
    joints: tuple[DhJoint, ...]
    base: Array = field(default_factory=lambda: np.eye(4))
    tool: Array = field(default_factory=lambda: np.eye(4))

    def __post_init__(self) -> None:
        if not 1 <= len(self.joints) <= MAX_JOINTS:
            raise InvalidDhTable(f"the table has {len(self.joints)} joints; allowed: 1 to {MAX_JOINTS}")
        for place, T in (("base", self.base), ("tool", self.tool)):
            if not np.all(np.abs(T[:3, 3]) <= MAX_LENGTH):
                raise InvalidDhTable(f"the position of {place} is beyond {MAX_LENGTH:g} m")
        names: set[str] = set()
        for i, joint in enumerate(self.joints):
            _check_row(i, joint)
            if joint.name in names:
                raise InvalidDhTable(f"{quoted(joint.name)} is used twice", i, "name")
            names.add(joint.name)
        followers = {joint.name for joint in self.joints if joint.mimic is not None}
        for i, joint in enumerate(self.joints):
            if joint.mimic is not None:
                _check_mimic(i, joint.mimic, followers)

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """Names of the variables, in the order of a configuration, which is also that of the chain.

        An independent row keeps its place; a leader that is not a row comes where it is first needed.
        """
        rows = {row.name for row in self.joints}
        names = [
            row.name if row.mimic is None else row.mimic.joint
            for row in self.joints
            if row.mimic is None or row.mimic.joint not in rows
        ]
        return tuple(dict.fromkeys(names))

    def positions(self, q: Sequence[float]) -> list[float]:
        """Return the position of each row, [rad or m], for one number per variable; else raises WrongJointCount."""
        if len(q) != len(self.variables):
            raise WrongJointCount(len(q), self.variables)
        value = dict(zip(self.variables, q, strict=True))
        return [
            value[row.name] if row.mimic is None else row.mimic.multiplier * value[row.mimic.joint] + row.mimic.offset
            for row in self.joints
        ]

    def frames(self, q: Sequence[float]) -> list[Array]:
        """Return T_base_0, T_base_1, …, T_base_n at one configuration, as for `positions`; each of shape (4, 4)."""
        Ts = [self.base]
        for joint, position in zip(self.joints, self.positions(q), strict=True):
            Ts.append(Ts[-1] @ joint.transform(position, self.convention))
        return Ts

    def pose(self, q: Sequence[float]) -> Array:
        """Return T_base_tool at one configuration; shape (4, 4)."""
        return self.frames(q)[-1] @ self.tool


def _check_row(i: int, joint: DhJoint) -> None:
    _check_name(i, joint.name, "name")
    lower, upper = joint.limits
    lengths = {"a": joint.a, "d": joint.d, "lower": lower, "upper": upper}
    for most, numbers in ((MAX_LENGTH, lengths), (MAX_ANGLE, {"alpha": joint.alpha, "theta": joint.theta})):
        for parameter, number in numbers.items():
            if not abs(number) <= most:
                raise InvalidDhTable(f"must be a number of magnitude ≤ {most:g}", i, parameter)
    if lower > upper:
        raise InvalidDhTable(f"lower = {lower:.17g} is greater than upper = {upper:.17g}", i, "lower")
    for parameter in ("velocity", "effort"):
        value = getattr(joint, parameter)
        if value is not None and not 0 <= value <= MAX_BOUND:
            raise InvalidDhTable(f"must be a number from 0 to {MAX_BOUND:g}", i, parameter)


def _check_name(i: int, name: str, parameter: str) -> None:
    if not (name.strip() and name.isprintable() and len(name) <= MAX_NAME_LENGTH):
        reason = f"{quoted(name)} must be 1 to {MAX_NAME_LENGTH} printable characters"
        raise InvalidDhTable(reason, i, parameter)


def _check_mimic(i: int, mimic: Mimic, followers: set[str]) -> None:
    _check_name(i, mimic.joint, "mimic")
    if mimic.joint in followers:
        reason = f"{quoted(mimic.joint)} follows another joint itself: name the joint at the end of the chain"
        raise InvalidDhTable(reason, i, "mimic")
    for parameter, most in (("multiplier", MAX_MULTIPLIER), ("offset", MAX_LENGTH)):
        if not abs(getattr(mimic, parameter)) <= most:
            raise InvalidDhTable(f"{parameter} must be a number of magnitude ≤ {most:g}", i, "mimic")


def about_z(theta: float, d: float) -> Array:
    """Return Rz(θ) Tz(d)."""
    c, s = math.cos(theta), math.sin(theta)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, d], [0, 0, 0, 1]])


def about_x(alpha: float, a: float) -> Array:
    """Return Tx(a) Rx(α); the order does not matter because the two commute."""
    c, s = math.cos(alpha), math.sin(alpha)
    return np.array([[1, 0, 0, a], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
