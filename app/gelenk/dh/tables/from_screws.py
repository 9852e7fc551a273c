"""The description of a robot that is given as a product of exponentials."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME
from gelenk.dh.tables.screws import adjoint
from gelenk.errors import InvalidField, counted, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.description import Description, Joint, JointType, Link, Mimic, Origin, Triple, UrdfLimits
from gelenk.robot.notations import origin_of
from gelenk.robot.poses import transform

_UNIT = 1e-6
"""Largest deviation from a unit axis and from a zero pitch, and of the two lists of axes from each other."""


@dataclass(frozen=True, slots=True)
class ScrewJoint:
    """A joint by its name and limits, [rad or m] and per second; `variable` names the joint that it follows."""

    name: str
    type: str | None = None
    variable: str | None = None
    multiplier: float = 1.0
    lower: float | None = None
    upper: float | None = None
    velocity: float | None = None
    effort: float | None = None


def space_axes(home: Array, space: Array | None, body: Array | None) -> Array:
    """Return the screw axes in the base's axes, from those that are given; shape (n, 6).

    Raises InvalidField if none is given, or both and they disagree.
    """
    if body is None:
        if space is None:
            raise InvalidField("screws", "give `space_screws`, `body_screws`, or both")
        return space
    moved = body @ adjoint(home).T
    if space is None:
        return moved
    if space.shape != moved.shape or np.abs(space - moved).max() > _UNIT * (1.0 + np.abs(space).max()):
        raise InvalidField(
            "screws/body_screws", "they are not the `space_screws` seen from the tool: give one of the two"
        )
    return space


def describe_screws(name: str, home: Array, space: Array, joints: Sequence[ScrewJoint]) -> Description:
    """Return the description of a product of exponentials: links `base`, `link_1`, … `link_n` and `tool`.

    Each link's frame is on the axis of its joint, at the point nearest to the base's origin, parallel to the base.

    Args:
        home: T_base_tool at zero, shape (4, 4).
        space: Screw axes in the base's axes, angular part first; shape (n, 6).

    Raises:
        InvalidField: An axis is no unit vector or has a pitch; names, types or followed joints do not fit.
    """
    if len(joints) != len(space):
        raise InvalidField(
            "screws/joints", f"{counted(len(joints), 'joint')} for {counted(len(space), 'screw')}: each screw needs one"
        )
    _check_names([joint.name for joint in joints])
    links, moving, at = [BASE_FRAME], [], np.zeros(3)
    for i, (axis, joint) in enumerate(zip(space, joints, strict=True)):
        slides, direction, point = _line(axis, i, at)
        _check_type(joint, slides, i)
        link = f"link_{i + 1}"
        moving.append(_moving(joint, slides, (links[-1], link), point - at, direction, joints, i))
        links.append(link)
        at = point
    to_tool = transform(-at, np.eye(3)) @ home
    tool = Joint(_free("to_tool", joints), "fixed", links[-1], TOOL_FRAME, origin_of(to_tool))
    return Description(name, tuple(Link(link) for link in (*links, TOOL_FRAME)), (*moving, tool))


def _line(axis: Array, i: int, before: Array) -> tuple[bool, Array, Array]:
    """Return whether a joint slides, its unit direction and a point of its axis: the last frame's if it slides."""
    field, w, v = f"screws/{i}", axis[:3], axis[3:]
    if not w.any():
        if abs(np.linalg.norm(v) - 1.0) > _UNIT:
            raise InvalidField(field, f"ω is zero, so v must have length 1 and has {np.linalg.norm(v):.9g}")
        return True, v / np.linalg.norm(v), before
    length = float(np.linalg.norm(w))
    if abs(length - 1.0) > _UNIT:
        raise InvalidField(field, f"ω must have length 1, or be zero for a prismatic joint, and has {length:.9g}")
    w = w / length
    if abs(float(w @ v)) > _UNIT * (1.0 + float(np.linalg.norm(v))):
        raise InvalidField(field, f"a joint turns or slides, not both: ω · v must be 0 and is {float(w @ v):.9g}")
    return False, w, np.cross(w, v)


def _check_names(names: Sequence[str]) -> None:
    for i, name in enumerate(names):
        if name in names[:i]:
            raise InvalidField(f"screws/joints/{i}/name", f"{quoted(name)} is used twice")


def _check_type(joint: ScrewJoint, slides: bool, i: int) -> None:
    kind = "prismatic" if slides else "revolute"
    if joint.type not in (None, kind):
        raise InvalidField(f"screws/joints/{i}/type", f"it says {quoted(joint.type or '')} and its axis is {kind}")


def _moving(
    joint: ScrewJoint,
    slides: bool,
    ends: tuple[str, str],
    offset: Array,
    direction: Array,
    joints: Sequence[ScrewJoint],
    i: int,
) -> Joint:
    lower, upper = _bounds(joint, slides, i)
    x, y, z = offset.tolist()
    axis: Triple = (float(direction[0]), float(direction[1]), float(direction[2]))
    limits = UrdfLimits(lower, upper, joint.velocity, joint.effort)
    kind: JointType = "prismatic" if slides else "revolute"
    return Joint(joint.name, kind, *ends, Origin((x, y, z)), axis, limits, _followed(joint, joints, i))


def _bounds(joint: ScrewJoint, slides: bool, i: int) -> tuple[float, float]:
    """Return the limits of a joint; as in a DH table ±π rad or ±1 m where one is left out."""
    default = 1.0 if slides else math.pi
    lower = -default if joint.lower is None else joint.lower
    upper = default if joint.upper is None else joint.upper
    if lower > upper:
        raise InvalidField(f"screws/joints/{i}/lower", f"{lower:.9g} is greater than upper = {upper:.9g}")
    return lower, upper


def _followed(joint: ScrewJoint, joints: Sequence[ScrewJoint], i: int) -> Mimic | None:
    if joint.variable in (None, joint.name):
        if joint.multiplier != 1.0:
            raise InvalidField(f"screws/joints/{i}/multiplier", "must be 1 where a joint does not follow another one")
        return None
    leaders = [one.name for one in joints if one.variable in (None, one.name)]
    if joint.variable not in leaders:
        reason = f"{quoted(joint.variable or '')} is no joint here that moves by itself: {', '.join(leaders) or 'none'}"
        raise InvalidField(f"screws/joints/{i}/variable", reason)
    return Mimic(joint.variable or "", joint.multiplier, 0.0)


def _free(name: str, joints: Sequence[ScrewJoint]) -> str:
    while name in {joint.name for joint in joints}:
        name += "_"
    return name
