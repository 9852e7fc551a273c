"""Convert a DH table to a URDF description, and between the standard and the modified convention.

DH frames are not where URDF puts link frames: joint i of a URDF turns about the z axis of its own frame, which for a
standard table is z_{i-1}. So link i carries the motion of joint i, and DH frame i is fixed to it [Corke2017, ch. 7].
The links of the robot are

    base → (base transform) → frame_0 → joint 1 → link_1 → joint 2 → … → link_n → (tool transform) → tool

with the DH frames `frame_1 … frame_n` fixed to their links, so that each T_0_i of the table can be computed. A leader
that is not a row itself moves a small link of its own beside the chain: `leader_1, leader_2, …`.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from gelenk.errors import quoted
from gelenk.robot.appearance import Solid, Stock, inertial_of
from gelenk.robot.arrays import Array
from gelenk.robot.description import MAX_BOUND, Description, Joint, Link, UrdfLimits
from gelenk.robot.dh import MAX_LENGTH, Convention, DhJoint, DhTable, about_x, about_z
from gelenk.robot.notations import origin_of

BASE_FRAME = "base"
TOOL_FRAME = "tool"

_EXACT = 1e-15
"""Rounding within which a transform counts as Tx(a) Rx(α), so that a row can absorb it."""


def describe_dh(name: str, table: DhTable, bodies: Mapping[str, list[Solid]] | None = None) -> Description:
    """Convert a DH table to a description, with the module docstring's frames and simple solids as bodies.

    `bodies` are the solids of `base` and of each link, if they are others than rods along the table's lengths.
    The table may begin with a prismatic joint and contain links of zero length. The description warns of omitted
    limits, of angles beyond a full turn, and of leaders that are not rows.
    """
    n = len(table.joints)
    taken = frozenset((*table.variables, *(row.name for row in table.joints)))
    joints = [_fixed(taken, BASE_FRAME, "frame_0", table.base)]
    parent, pending = "frame_0", np.eye(4)
    for i, row in enumerate(table.joints, start=1):
        before, after = _around_motion(row, table.convention)
        link = f"link_{i}"
        joints.append(_moving(row, parent, link, pending @ before))
        joints.append(_fixed(taken, link, f"frame_{i}", after))
        parent, pending = link, after
    joints.append(_fixed(taken, f"frame_{n}", TOOL_FRAME, table.tool))
    leaders = _leaders(table)
    return Description(name, _links(table, len(leaders), bodies), (*joints, *leaders), _warnings(table))


def _around_motion(row: DhJoint, convention: Convention) -> tuple[Array, Array]:
    """Return the constant parts of A_i before and after the joint's motion."""
    if convention == "modified":
        return row.transform(0.0, convention), np.eye(4)
    return about_z(row.theta, row.d), about_x(row.alpha, row.a)


def _moving(row: DhJoint, parent: str, child: str, T: Array) -> Joint:
    lower, upper = row.limits
    limits = UrdfLimits(lower, upper, row.velocity, row.effort)
    return Joint(row.name, row.type, parent, child, origin_of(T), (0.0, 0.0, 1.0), limits, row.mimic)


def _fixed(taken: frozenset[str], parent: str, child: str, T: Array) -> Joint:
    """Create a fixed joint with a name that the table does not use."""
    name = f"{parent}_to_{child}"
    while name in taken:
        name += "_"
    return Joint(name, "fixed", parent, child, origin_of(T))


# Joints outside the table


def _leaders(table: DhTable) -> list[Joint]:
    followers = _followers(table)
    return [
        Joint(name, rows[0].type, BASE_FRAME, f"leader_{k}", axis=(0.0, 0.0, 1.0), limits=_limits_of_leader(rows))
        for k, (name, rows) in enumerate(followers.items(), start=1)
    ]


def _followers(table: DhTable) -> dict[str, list[DhJoint]]:
    """Map each leader that is not a row to the rows that follow it."""
    names = {row.name for row in table.joints}
    return {
        leader: [row for row in table.joints if row.mimic is not None and row.mimic.joint == leader]
        for leader in table.variables
        if leader not in names
    }


def _limits_of_leader(rows: Sequence[DhJoint]) -> UrdfLimits:
    """Return the limits of a leader that keep all its followers within the limits given in their rows."""
    default = math.pi if rows[0].type == "revolute" else 1.0
    lower, upper, velocity = -math.inf, math.inf, MAX_BOUND
    for row in rows:
        mimic = row.mimic
        if mimic is None or mimic.multiplier == 0.0:
            continue
        ends = [
            (end - mimic.offset) / mimic.multiplier
            for end in ((-math.inf if row.lower is None else row.lower), (math.inf if row.upper is None else row.upper))
        ]
        lower, upper = max(lower, min(ends)), min(upper, max(ends))
        if row.velocity is not None:
            velocity = min(velocity, row.velocity / abs(mimic.multiplier))
    lower, upper = (lower if abs(lower) <= MAX_LENGTH else -default), (upper if abs(upper) <= MAX_LENGTH else default)
    return UrdfLimits(min(lower, upper), upper, velocity if velocity < MAX_BOUND else None)


# Bodies


def _links(table: DhTable, leaders: int, bodies: Mapping[str, list[Solid]] | None) -> tuple[Link, ...]:
    """Return the links with their bodies: first the chain from base to tool, then DH frames and leaders beside it."""
    stock = Stock(length for row in table.joints for length in (row.a, row.d))
    bodies = _rods(table, stock) if bodies is None else bodies
    n = len(table.joints)
    chain = ["frame_0", *(f"link_{i}" for i in range(1, n + 1)), f"frame_{n}", TOOL_FRAME]
    beside = [f"frame_{i}" for i in range(1, n)]
    rotors = {f"leader_{k}": [stock.hub()] for k in range(1, leaders + 1)}
    moving = {f"link_{i}" for i in range(1, n + 1)}
    links = []
    for name in (BASE_FRAME, *chain, *beside):
        solids = bodies.get(name, [])
        inertial = inertial_of(solids) if name in moving else None
        links.append(Link(name, inertial, tuple(solid.shape() for solid in solids)))
    return (*links, *(Link(name, inertial_of(solids)) for name, solids in rotors.items()))


def _rods(table: DhTable, stock: Stock) -> Mapping[str, list[Solid]]:
    """Return rods and the bodies of joints: the solids of the base and of each link, in the frame of the link."""
    origin = np.zeros(3)
    bodies = {BASE_FRAME: stock.rod(origin, table.base[:3, 3]), "frame_0": []}
    parent, pending = "frame_0", np.eye(4)
    for i, row in enumerate(table.joints, start=1):
        standard, slides = table.convention == "standard", row.type == "prismatic"
        # In the parent's frame: where the joint's d begins, and where the rod along the parent's a ends.
        foot = pending if standard else replace(row, d=0.0).transform(0.0, "modified")
        elbow = origin if standard else foot[:3, 3]
        bodies[parent] += stock.rod(origin, elbow)
        own = stock.rod(origin, (row.a, 0.0, 0.0)) if standard else []
        if slides:
            bodies[parent] += stock.rod(foot[:3, 3], foot[:3, 3] + row.d * foot[:3, 2])
            own += stock.slide(*row.limits)
        else:
            own += [stock.hub(-row.d), *stock.rod((0.0, 0.0, -row.d), origin)]
        parent, pending = f"link_{i}", _around_motion(row, table.convention)[1]
        bodies[parent] = own
    bodies[parent] += stock.rod(pending[:3, 3], (pending @ table.tool)[:3, 3])
    return bodies


def _warnings(table: DhTable) -> tuple[str, ...]:
    warnings = []
    for row in table.joints:
        for key in ("alpha", "theta"):
            angle = getattr(row, key)
            if abs(angle) > 2.0 * math.pi:
                more = f"{key} = {angle:.6g} rad is more than a full turn, in degrees it would be {angle / 180:.6g} π"
                warnings.append(f"joint {quoted(row.name)}: {more}")
        if row.mimic is not None:
            continue
        left_out = [key for key in ("lower", "upper") if getattr(row, key) is None]
        if left_out:
            default = "±π rad" if row.type == "revolute" else "±1 m"
            warnings.append(f"joint {quoted(row.name)}: no {' and '.join(left_out)} limit given, {default} is taken")
    for leader, rows in _followers(table).items():
        names = ", ".join(quoted(row.name) for row in rows)
        warnings.append(
            f"joint {quoted(leader)} is not a row of the table: it is taken as a joint that moves {names} alone"
        )
    return tuple(warnings)


# Standard and modified


def converted(table: DhTable, convention: Convention) -> DhTable:
    """Express the same chain in the other convention; return the table itself if it already uses that convention.

    A = Rz(θ) Tz(d) and X = Tx(a) Rx(α) alternate in both: standard tables pair A_i with the X after it, modified ones
    with the X before it. So a and α move by one row, and the X left over goes into the tool or the base. If the base or
    the tool is itself such an X, it goes back into the first or the last row.
    """
    if table.convention == convention:
        return table
    none = (0.0, 0.0)
    between = [(row.alpha, row.a) for row in table.joints]
    base, tool = table.base, table.tool
    if convention == "modified":
        first = _along_x(base)
        before = [first or none, *between[:-1]]
        base, tool = (np.eye(4) if first else base), about_x(*between[-1]) @ tool
    else:
        last = _along_x(tool)
        before = [*between[1:], last or none]
        base, tool = base @ about_x(*between[0]), (np.eye(4) if last else tool)
    rows = tuple(replace(row, a=a, alpha=alpha) for row, (alpha, a) in zip(table.joints, before, strict=True))
    return DhTable(convention, rows, base, tool)


def _along_x(T: Array) -> tuple[float, float] | None:
    """Return (α, a) if a transform is Tx(a) Rx(α) and nothing else."""
    alpha, a = math.atan2(T[2, 1], T[2, 2]), float(T[0, 3])
    return (alpha, a) if np.abs(T - about_x(alpha, a)).max() <= _EXACT else None
