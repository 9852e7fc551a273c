"""Convert a chain to a DH table from the geometry of its axes: any joints, any axes, both conventions.

Between two joints of a chain there is a constant placement P, and each joint turns about or slides along its own z. Any
P can be written as

    P = Rz(u) Tz(s) · Tx(a) Rx(α) · Rz(v) Tz(t),

where Tx(a) Rx(α) follows the common normal of the two axes. The outer factors commute with the joints' motions and go
into the rows of the two joints: θ = v + u and d = t + s, with v and t of the placement before the joint and u and s of
the one after it. So each row depends only on the two placements around its joint, errors do not accumulate, and a table
exists for every chain. z points along a joint's positive direction, so no joint is reversed.

Where the convention leaves a choice, it is made as follows:

- The first frame is at the foot of the base's origin on the first axis; base and tool absorb the rest.
- x points along the common normal, or for intersecting axes along the cross product of their directions, with the sign
  for which |θ| ≤ π/2.
- Parallel axes: the normal passes through the previous origin, d = 0. Collinear axes: origin and x stay, θ = d = 0.
- The axis of a prismatic joint may be anywhere: it is placed on the next axis if the two are parallel, otherwise
  through the previous origin.
- The tip's z axis is treated as the axis of a further joint, which keeps the tool as simple as possible.

A table is exact except for rounding. Nearly parallel axes have their common normal far away; if it is too far to be
readable, they are treated as parallel when the caller allows that for their tilt. A snap tolerance makes nearly
parallel, nearly square and nearly zero values exact, as a person would write the table.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from gelenk.errors import InvalidDhTable, InvalidField, listed, quoted
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, crossed_joints
from gelenk.robot.description import Description, Joint, Mimic, UrdfLimits
from gelenk.robot.dh import (
    MAX_JOINTS,
    MAX_LENGTH,
    MAX_SNAP_TOLERANCE,
    Convention,
    DhJoint,
    DhTable,
    JointType,
    about_x,
    about_z,
)
from gelenk.robot.poses import inverse

ROUNDING = 4e-15
"""Angles [rad], and lengths relative to the robot's size, that count as zero: the rounding of a few products."""
FAR = 10.0
"""Lengths of a table beyond this many times the reach are too large to be readable."""

_DIGITS = 12
"""Decimals of a snapped length."""
_SQUARE = 1e-4
"""Tilt [rad] of the tip's z against the last axis below which the tool absorbs it: the normal could be far away."""
_STEEP = 1e-2
"""Largest tilt [rad] for which a refusal suggests treating the axes as parallel."""
_TIE = 1e-9
"""Distance from ±π/2 within which both directions of x count as equally good, [rad]."""

_PARALLEL = marked("parallel to the next axis, so the normal goes through the previous origin and d is zero")
_ONE_LINE = marked("on one line with the next axis, so origin and x stay, and theta and d are zero")
_INTERSECTING = marked("intersecting the next axis, so a is zero and x the cross product of the two directions")
_THROUGH_TIP = marked("parallel to z of the tip, so the last frame is at the tip's height")
_AT_TIP = marked("on one line with z of the tip, so the last frame is the tip's")
_ON_NEXT = marked("prismatic, so its axis may be anywhere: placed on the next one, which is parallel")
_AS_GIVEN = marked("prismatic, so that the axis may be anywhere: left where the description has it")
_THROUGH_PREVIOUS = marked("prismatic, so that the axis may be anywhere: put through the previous origin")


class FarNormal(NamedTuple):
    """Two axes, `tilt` [rad] from parallel, whose common normal is far away: `distance` [m] along the axes."""

    joints: str
    tilt: float
    distance: float


@dataclass(frozen=True, slots=True)
class ChainTable:
    """The DH table of a chain, and the choices made for it.

    Attributes:
        table: Its variables are the chain's, in the same order.
        notes: Choices where the convention leaves one, one sentence each.
        rounded, far: Axes with a far normal that were treated as parallel, and those that were not.
        reach: Total length of all links, [m].
    """

    table: DhTable
    notes: tuple[str, ...]
    rounded: tuple[FarNormal, ...]
    far: tuple[FarNormal, ...]
    reach: float


@dataclass(frozen=True, slots=True)
class _Normal:
    """A placement decomposed along its common normal as in the module docstring; angles [rad], lengths [m].

    v and t fix x and the origin on the axis behind it.
    """

    u: float
    s: float
    a: float
    alpha: float
    v: float
    t: float


def dh_from_chain(
    description: Description,
    chain: Chain,
    convention: Convention,
    snap_tolerance: float = 0.0,
    parallel_below: float = 0.0,
) -> ChainTable:
    """Compute the DH table of a chain, up or down the tree.

    Args:
        snap_tolerance: Angles within this [rad] of a multiple of π/2, and lengths within this [m] of zero, become
            exact; zero allows for rounding only.
        parallel_below: Axes tilted by less than this [rad] are treated as parallel if their common normal is far away.

    Raises:
        InvalidField: The chain has no joint, or more than a table may have; two axes are so nearly parallel that their
            common normal is out of range; the tolerance is out of range; a number is beyond a table's limits.
    """
    joints = crossed_joints(description, chain)
    if not joints:
        reason = f"no joint moves between {quoted(chain.base_frame)} and {quoted(chain.tip_frame)}: no row for a table"
        raise InvalidField("tip_frame", reason)
    if len(joints) > MAX_JOINTS:
        raise InvalidField("tip_frame", f"{len(joints)} joints are on the path; a table has at most {MAX_JOINTS}")
    if not 0.0 <= snap_tolerance <= MAX_SNAP_TOLERANCE:
        raise InvalidField("snap_tolerance", f"must be a number from 0 to {MAX_SNAP_TOLERANCE:g}")
    lines = _Lines(chain, joints, snap_tolerance, parallel_below)
    base, parameters, tool = lines.parameters(convention)
    rows = [_row(description, joints, joint, row) for joint, row in zip(joints, parameters, strict=True)]
    notes = (*lines.notes(), *_joint_notes(description, joints, rows))
    try:
        table = DhTable(convention, tuple(rows), base, tool)
    except InvalidDhTable as error:
        raise InvalidField("tip_frame", f"no table can describe this chain: {error.detail}") from error
    return ChainTable(table, notes, tuple(lines.rounded), tuple(lines.far), lines.reach)


def standard_table(description: Description, chain: Chain) -> DhTable | None:
    """Return the standard table of a chain; None where no table can describe it."""
    try:
        return dh_from_chain(description, chain, "standard").table
    except InvalidField:
        return None


class _Lines:
    """The axes of one chain, and the frames placed on them; its arguments are those of `dh_from_chain`."""

    def __init__(self, chain: Chain, joints: Sequence[Joint], snap_tolerance: float, parallel_below: float) -> None:
        self._ends = chain.base_frame, chain.tip_frame
        self._names = [joint.name for joint in joints]
        self._slides = [joint.type == "prismatic" for joint in joints]
        self._Ps = [chain.flat.placement(i) for i in range(len(chain.flat.placements))]
        self.reach = sum(math.hypot(*P[:3, 3]) for P in self._Ps)
        self.rounded: list[FarNormal] = []
        self.far: list[FarNormal] = []
        self._parallel_below = parallel_below
        self._size = 1.0 + self.reach
        self._angle = max(ROUNDING, snap_tolerance)
        self._length = max(ROUNDING * self._size, snap_tolerance)
        self._snapping = snap_tolerance > 0.0
        self._most_angle = self._most_length = 0.0
        for P in self._Ps:
            P[:3, :3] = self._quarter_turns(P[:3, :3])
        self._chosen: dict[str, list[str]] = {}

    def parameters(self, convention: Convention) -> tuple[Array, list[tuple[float, float, float, float]], Array]:
        """Return the base transform, (a, α, d, θ) of each row, and the tool transform."""
        on_next = self._put_on_next_axes()
        if self._slides[0] and not on_next[0]:
            self._put_through(0, 0.0)
        first = before = self._first()
        found: list[tuple[float, float, _Normal]] = []
        for i in range(len(self._names)):
            last = i + 1 == len(self._names)
            if not last and self._slides[i + 1] and not on_next[i + 1]:
                self._put_through(i + 1, -before.t)
            found.append(self._normal(i, before))
            before = found[-1][2]
        between = [(normal.a, normal.alpha) for _, _, normal in found]
        if convention == "modified":
            between = [(0.0, 0.0), *between[:-1]]
        end = found[-1][2]
        last_frame = about_z(end.u, end.s)
        if convention == "standard":
            last_frame = last_frame @ about_x(end.alpha, end.a)
        base = self._cleaned(self._Ps[0] @ about_z(-first.v, -first.t))
        tool = self._cleaned(inverse(last_frame) @ self._Ps[-1])
        return base, [(a, alpha, d, theta) for (a, alpha), (theta, d, _) in zip(between, found, strict=True)], tool

    # Where the axes are

    def _put_on_next_axes(self) -> list[bool]:
        """Move each prismatic axis onto the next axis if the two are parallel; return which axes were moved.

        A prismatic axis may be anywhere: its motion commutes with any translation p, so P · T(p) before it and T(-p) ·
        P' after it describe the same chain.
        """
        moved = [False] * len(self._names)
        for i in reversed(range(len(self._names))):
            next_is_fixed = i + 1 == len(self._names) or not self._slides[i + 1] or moved[i + 1]
            P = self._Ps[i + 1]
            if self._slides[i] and next_is_fixed and math.hypot(P[0, 2], P[1, 2]) <= self._angle:
                self._shift(i, np.array([P[0, 3], P[1, 3], 0.0]))
                P[:2, 3] = 0.0
                moved[i] = True
                self._note(_ON_NEXT, i)
        return moved

    def _put_through(self, i: int, height: float) -> None:
        """Move a prismatic axis through the point at a height [m] on the previous axis (the first: on the base's z)."""
        point = np.array([0.0, 0.0, height])
        P = self._Ps[i]
        p = P[:3, :3].T @ (point - P[:3, 3])
        if math.hypot(*p) > self._size:
            # Two nearly parallel axes have put that origin far away: do not measure the following axes from there.
            self._note(_AS_GIVEN, i)
            return
        self._shift(i, p)
        P[:3, 3] = point
        self._note(_THROUGH_PREVIOUS, i)

    def _shift(self, i: int, p: Array) -> None:
        self._Ps[i][:3, 3] += self._Ps[i][:3, :3] @ p
        self._Ps[i + 1][:3, 3] -= p

    # Where the frames are

    def _first(self) -> _Normal:
        """Place frame 0 at the foot of the base's origin on the first axis, x along the base's x or ±z_base × z_0."""
        P = self._Ps[0]
        zx, zy, zz = P[:3, 2].tolist()
        tilt, u = math.hypot(zx, zy), 0.0
        alpha = 0.0 if zz > 0.0 else math.pi
        if tilt > self._angle:
            u, alpha = math.atan2(zx, -zy), self._right(math.atan2(tilt, zz))
            x, y = math.cos(u), math.sin(u)
            if x < -_TIE or (abs(x) <= _TIE and y < 0.0):
                u, alpha = u + math.pi, -alpha
        return _Normal(0.0, 0.0, 0.0, 0.0, _left_over(P, u, alpha), float(P[:3, 2] @ P[:3, 3]))

    def _normal(self, i: int, before: _Normal) -> tuple[float, float, _Normal]:
        """Return θ and d of a joint, and the normal from its axis to the next, if that is not too far away."""
        last = i + 1 == len(self._names)
        P = self._Ps[i + 1]
        tilt = math.hypot(P[0, 2], P[1, 2])
        if tilt <= max(self._angle, _SQUARE if last else 0.0):
            return self._parallel(i, before)
        theta, d, normal = self._skew(i, before)
        far = FarNormal(f"{quoted(self._names[i])} and {self._next(i)}", tilt, max(abs(normal.s), abs(normal.t)))
        # A d leads from one normal to the next: allowing each half the distance keeps d within the limit.
        is_far = far.distance > 0.5 * FAR * self.reach
        if is_far and (last or tilt < self._parallel_below):
            if not last:  # there the tool absorbs the difference
                self.rounded.append(far)
            return self._parallel(i, before)
        furthest = max(abs(d), far.distance)
        if furthest > MAX_LENGTH:
            raise self._too_far(far.joints, tilt, furthest)
        if is_far:
            self.far.append(far)
        if normal.a == 0.0:
            self._note(_INTERSECTING, i)
        return theta, d, normal

    def _too_far(self, pair: str, tilt: float, furthest: float) -> InvalidField:
        if tilt > _STEEP:
            reason = f"{pair} need a length of {furthest:.2g} m, beyond the {MAX_LENGTH:g} m of a table"
            return InvalidField("tip_frame", reason)
        reason = (
            f"the axes of {pair} are {tilt:.2g} rad from parallel, which puts their common normal {furthest:.2g} m "
            f"away, beyond the {MAX_LENGTH:g} m of a table: a tolerance of {2 * tilt:.1g} takes them as parallel, and "
            "the certificate states the resulting error"
        )
        return InvalidField("snap_tolerance", reason)

    def _parallel(self, i: int, before: _Normal) -> tuple[float, float, _Normal]:
        """Return θ, d and the normal of parallel axes, through the previous origin or (last axis) through the tip."""
        last = i + 1 == len(self._names)
        P = self._Ps[i + 1]
        x, y, z = P[:3, 3].tolist()
        alpha = 0.0 if P[2, 2] > 0.0 else math.pi
        d = self._zero(before.t + z) if last else 0.0
        s = d - before.t
        if math.hypot(x, y) > self._length:
            theta = self._theta(before, math.atan2(y, x), positive=True)
            u = theta - before.v
            a = x * math.cos(u) + y * math.sin(u)
            what = _THROUGH_TIP if last else _PARALLEL
        else:
            theta = self._right(_wrapped(before.v + math.atan2(P[1, 0], P[0, 0]))) if last else 0.0
            u, a = theta - before.v, 0.0
            what = _AT_TIP if last else _ONE_LINE
            self._most_length = max(self._most_length, math.hypot(x, y))
        if math.hypot(P[0, 2], P[1, 2]) <= self._angle:
            self._most_angle = max(self._most_angle, math.hypot(P[0, 2], P[1, 2]))
        self._note(what, i)
        t = (z - s) * math.cos(alpha)
        return theta, d, _Normal(u, s, a, alpha, _left_over(P, u, alpha), t)

    def _skew(self, i: int, before: _Normal) -> tuple[float, float, _Normal]:
        """Return θ, d and the normal of axes that are not parallel; only its direction comes from z × z'."""
        P = self._Ps[i + 1]
        x, y, z = P[:3, 3].tolist()
        zx, zy, zz = P[:3, 2].tolist()
        u, alpha = math.atan2(zx, -zy), self._right(math.atan2(math.hypot(zx, zy), zz))
        along = x * math.cos(u) + y * math.sin(u)
        theta = self._theta(before, u, positive=along > -self._length)
        if abs(_wrapped(theta - before.v - u)) > 0.5 * math.pi:
            alpha = -alpha
        u = theta - before.v
        c, s = math.cos(u), math.sin(u)
        a = self._zero(x * c + y * s)
        # Continue with the rounded numbers, so that the far end of a long d is where it should be.
        t = (x * s - y * c) / math.sin(alpha)
        d = self._zero(before.t + z - t * math.cos(alpha))
        return theta, d, _Normal(u, d - before.t, a, alpha, _left_over(P, u, alpha), t)

    def _theta(self, before: _Normal, u: float, *, positive: bool) -> float:
        """Return θ for a normal along u or its opposite: the smaller |θ|; on a tie, along u only if `positive`."""
        theta = _wrapped(before.v + u)
        excess = abs(theta) - 0.5 * math.pi
        tie = abs(excess) <= max(_TIE, self._angle)
        if (tie and not positive) or (not tie and excess > 0.0):
            theta = _wrapped(theta + math.pi)
        return self._right(theta)

    # Rounding and snapping

    def _right(self, angle: float) -> float:
        """Return the angle, or the multiple of π/2 within the tolerance of it."""
        near = round(angle / (0.5 * math.pi)) * 0.5 * math.pi
        if abs(angle - near) > self._angle:
            return angle
        self._most_angle = max(self._most_angle, abs(angle - near))
        return abs(near) if near == -math.pi else near

    def _quarter_turns(self, R: Array) -> Array:
        """Return the rotation, or the one by quarter turns about coordinate axes within the tolerance of it."""
        right = np.rint(R)
        distance = float(np.abs(R - right).max())
        if distance > self._angle:
            return R
        self._most_angle = max(self._most_angle, distance)
        return right

    def _zero(self, length: float) -> float:
        if abs(length) > self._length:
            # Drop the trailing digits that sums of decimals leave.
            return round(length, _DIGITS) if self._snapping else length
        self._most_length = max(self._most_length, abs(length))
        return 0.0

    def _cleaned(self, T: Array) -> Array:
        """Return base or tool, snapped to quarter turns and zeros within rounding or the tolerance."""
        R = self._quarter_turns(T[:3, :3])
        clean = np.eye(4)
        clean[:3, :3] = np.where(np.abs(R) <= ROUNDING, 0.0, R)
        clean[:3, 3] = [self._zero(float(x)) for x in T[:3, 3]]
        # Adding zero turns -0.0 into 0.0, which reads better.
        return clean + 0.0

    # Notes

    def _next(self, i: int) -> str:
        return quoted(self._names[i + 1]) if i + 1 < len(self._names) else f"z of {quoted(self._ends[1])}"

    def _note(self, what: str, i: int) -> None:
        self._chosen.setdefault(what, []).append(self._names[i])

    def notes(self) -> tuple[str, ...]:
        base, tip = (quoted(end) for end in self._ends)
        notes = [
            _("frame 0 is at the foot of the origin of {base} on the first axis; base takes up the rest").format(
                base=base
            ),
            _("the last frame is at the foot of the normal to z of {tip}; tool takes up the rest").format(tip=tip),
            *(f"{_(what)}: {listed(tuple(joints))}" for what, joints in self._chosen.items()),
        ]
        if self._snapping:
            text = _(
                "snapped: angles by up to {angle:.2g} rad, lengths by up to {length:.2g} m; the certificate states the "
                "resulting error"
            )
            notes.append(text.format(angle=self._most_angle, length=self._most_length))
        return tuple(notes)


# Rows


def _row(
    description: Description,
    joints: Sequence[Joint],
    joint: Joint,
    parameters: tuple[float, float, float, float],
) -> DhJoint:
    drive = description.drives[joint.name]
    limits = joint.limits
    mimic = None if drive.leader == joint.name else Mimic(drive.leader, drive.multiplier, drive.offset)
    if mimic is not None and drive.leader not in {other.name for other in joints}:
        limits = _image(description.joint[drive.leader].limits, mimic)
    lower, upper = (
        None if end is None else min(max(end, -MAX_LENGTH), MAX_LENGTH) for end in (limits.lower, limits.upper)
    )
    type_: JointType = "prismatic" if joint.type == "prismatic" else "revolute"
    return DhJoint(joint.name, type_, *parameters, lower, upper, limits.velocity, limits.effort, mimic)


def _image(limits: UrdfLimits, mimic: Mimic) -> UrdfLimits:
    """Return the limits of a follower that correspond to those of its leader."""
    lower, upper = limits.lower, limits.upper
    if lower is None or upper is None:
        return UrdfLimits()
    ends = sorted(mimic.multiplier * end + mimic.offset for end in (lower, upper))
    velocity = None if limits.velocity is None else abs(mimic.multiplier) * limits.velocity
    return UrdfLimits(ends[0], ends[1], velocity)


def _joint_notes(description: Description, joints: Sequence[Joint], rows: Sequence[DhJoint]) -> Iterator[str]:
    """Yield a note for each property of a joint that a URDF can express and a row cannot."""
    on_the_way = {joint.name for joint in joints}
    endless = [joint.name for joint in joints if joint.type == "continuous" and joint.mimic is None]
    if endless:
        text = _("continuous, so their limits are left out, which a table reads as ±π: {joints}")
        yield text.format(joints=listed(tuple(endless)))
    cut = [row.name for row in rows if MAX_LENGTH in {abs(end) for end in (row.lower, row.upper) if end is not None}]
    if cut:
        yield _("limits cut to ±{most:g}: {joints}").format(most=MAX_LENGTH, joints=listed(tuple(cut)))
    for row in rows:
        if row.mimic is None:
            continue
        leader = description.joint[row.mimic.joint]
        text = _("{joint} follows {leader}")
        if leader.name not in on_the_way:
            text = _(
                "{joint} follows {leader}, which is not in the chain and has its own variable; the row's limits are "
                "what its limits allow; unlike its follower it is {type}"
                if (leader.type == "prismatic") != (row.type == "prismatic")
                else "{joint} follows {leader}, which is not in the chain and has its own variable; the row's limits "
                "are what its limits allow"
            )
        yield text.format(joint=quoted(row.name), leader=quoted(leader.name), type=leader.type)


# Transforms


def _left_over(P: Array, u: float, alpha: float) -> float:
    """Return v of R = Rz(u) Rx(α) Rz(v) by undoing the first two rotations; valid for any α."""
    x, y, z = P[:3, 0].tolist()
    c, s = math.cos(u), math.sin(u)
    return math.atan2(math.cos(alpha) * (c * y - s * x) + math.sin(alpha) * z, c * x + s * y)


def _wrapped(angle: float) -> float:
    return math.remainder(angle, 2.0 * math.pi)
