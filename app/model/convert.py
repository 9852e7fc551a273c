"""DH table → URDF.

The frames of a table do not sit where URDF puts a link: the joint i of a URDF turns about the z axis of its own
frame, which for a standard table is z_{i-1}. So link i carries joint i's motion and the DH frame i is fixed to it
[Corke2017, ch. 7]. The robot's links are

    base → (base transform) → frame_0 → joint 1 → link_1 → joint 2 → … → link_n → (tool transform) → tool

with the DH frames `frame_1 … frame_n` fixed to their links, so that each T_0_i of the table can be asked for.
"""

import numpy as np

from app.model.arrays import Array
from app.model.description import Description, Joint, Limits, Link, Origin
from app.model.dh import DhJoint, DhTable
from app.model.errors import quoted
from app.model.poses import rpy_from_rotations

BASE_FRAME = "base"
TOOL_FRAME = "tool"


def describe_dh(name: str, table: DhTable) -> Description:
    """The robot that a table describes.

    Args:
        name: Of the robot.
        table: Standard or modified; prismatic first joints and links of zero length are fine.

    Returns:
        Its description, the frames as this module's head says; a limit that was left out is a warning.
    """
    n = len(table.joints)
    links = [BASE_FRAME, "frame_0"]
    taken = frozenset(row.name for row in table.joints)
    joints = [_fixed(taken, BASE_FRAME, "frame_0", table.base)]
    parent, pending = "frame_0", np.eye(4)
    for i, row in enumerate(table.joints, start=1):
        before, after = _around_motion(row, table.convention == "standard")
        link = f"link_{i}"
        joints.append(_moving(row, parent, link, pending @ before))
        joints.append(_fixed(taken, link, f"frame_{i}", after))
        links += [link, f"frame_{i}"]
        parent, pending = link, after
    joints.append(_fixed(taken, f"frame_{n}", TOOL_FRAME, table.tool))
    links.append(TOOL_FRAME)
    return Description(name, tuple(Link(link) for link in links), tuple(joints), _warnings(table))


def _around_motion(row: DhJoint, standard: bool) -> tuple[Array, Array]:
    """The constant part of A_i before the joint's motion, and the one after it."""
    at_zero = row.transform(0.0, "standard" if standard else "modified")
    if not standard:
        return at_zero, np.eye(4)
    turn = DhJoint(row.name, row.type, 0.0, 0.0, row.d, row.theta).transform(0.0, "standard")
    shift = DhJoint(row.name, row.type, row.a, row.alpha, 0.0, 0.0).transform(0.0, "standard")
    return turn, shift


def _moving(row: DhJoint, parent: str, child: str, T: Array) -> Joint:
    lower, upper = row.limits
    return Joint(
        row.name,
        row.type,
        parent,
        child,
        origin_of(T),
        (0.0, 0.0, 1.0),
        Limits(lower, upper, row.velocity, row.effort),
    )


def _fixed(taken: frozenset[str], parent: str, child: str, T: Array) -> Joint:
    """A fixed joint, under a name that no row of the table has."""
    name = f"{parent}_to_{child}"
    while name in taken:
        name += "_"
    return Joint(name, "fixed", parent, child, origin_of(T))


def origin_of(T: Array) -> Origin:
    """A homogeneous transform as URDF writes it; the angles give the rotation again to rounding."""
    # Adding zero turns -0.0 into 0.0, which reads better.
    x, y, z = (float(value) + 0.0 for value in T[:3, 3])
    roll, pitch, yaw = (float(value) + 0.0 for value in rpy_from_rotations(np.ascontiguousarray(T[None, :3, :3]))[0])
    return Origin((x, y, z), (roll, pitch, yaw))


def _warnings(table: DhTable) -> tuple[str, ...]:
    warnings = []
    for row in table.joints:
        left_out = [key for key in ("lower", "upper") if getattr(row, key) is None]
        if left_out:
            default = "±π rad" if row.type == "revolute" else "±1 m"
            warnings.append(f"joint {quoted(row.name)}: no {' and '.join(left_out)} limit given, {default} is taken")
    return tuple(warnings)
