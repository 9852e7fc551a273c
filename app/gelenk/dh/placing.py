"""How the frames of a chain's DH table are placed, step by step: from the lines of its axes to its rows.

Everything is worked out again from the lines, by cross products and common normals, as on paper: the numbers check the
table's, from which only the signs of the normals are taken, and where the axes of prismatic joints are. All vectors are
those of the base, with every joint at zero.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import decimal, rounded, vector
from gelenk.dh.table_steps import angle_text, table_array, with_variable
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.dh import DhTable

PairKind: TypeAlias = Literal["skew", "intersecting", "parallel", "collinear"]

_SQUARE = 1e-4
"""Tilt [rad] of the tip's z against the last axis up to which the two are taken as parallel."""
_ILL = 1e-8
"""Sine of the angle of two axes below which rounding may move their common normal by nanometres or more."""

_vector = partial(vector, write=decimal)


@dataclass(frozen=True, slots=True)
class AxisPair:
    """Axis i and the next one, and what follows of them: x_i, and a, α, d and ϑ of the same index.

    Attributes:
        z, z_next: Directions of both axes; (3,) each.
        x_before, x: The x axes before and after, along the normals that end and begin on axis i; (3,) each.
        arrival, foot, end: Where the normal before meets axis i, and where this one meets it and the next; (3,), [m].
    """

    kind: PairKind
    z: Array
    z_next: Array
    x_before: Array
    x: Array
    arrival: Array
    foot: Array
    end: Array

    @property
    def a(self) -> float:
        """From axis to axis along x, [m]."""
        return float(self.x @ (self.end - self.foot))

    @property
    def d(self) -> float:
        """From normal to normal along z, [m]."""
        return float(self.z @ (self.foot - self.arrival))

    @property
    def alpha(self) -> float:
        """Turn of z into the next z about x, [rad]."""
        return _turn(self.z, self.z_next, self.x)

    @property
    def theta(self) -> float:
        """Turn of the x before into x about z, [rad]."""
        return _turn(self.x_before, self.x, self.z)


def axis_pairs(chain: Chain, table: DhTable) -> list[AxisPair]:
    """Return the pairs of neighbouring axes of a chain and its table, the last one with z of the tip."""
    frames, lines, standard = _frames(table), _lines(chain), table.convention == "standard"
    for i, row in enumerate(table.joints):
        if row.type == "prismatic":  # its axis is where the table has put it
            lines[i] = frames[i if standard else i + 1][:3, 3], lines[i][1]
    point, z = lines[0]
    arrival, x_before = point - (point @ z) * z, frames[0][:3, 0]
    pairs: list[AxisPair] = []
    for i in range(len(table.joints)):
        is_last = i + 1 == len(table.joints)
        kind, x = _kind(table, i), frames[i + 1][:3, 0]
        crossed = np.cross(lines[i][1], lines[i + 1][1])
        if kind in ("skew", "intersecting") and (size := float(np.linalg.norm(crossed))) < _ILL:
            # Where along them two all but parallel axes have their normal, rounding decides: as in the table.
            foot = frames[i + 1][:3, 3] - (table.joints[i].a * x if standard else 0.0)
            end = foot + (x @ (lines[i + 1][0] - foot)) * x
        else:
            if kind in ("skew", "intersecting"):
                x = crossed / size * (1.0 if crossed @ x > 0.0 else -1.0)
            foot, end = _feet(kind, lines[i], lines[i + 1], arrival, is_last)
        pairs.append(AxisPair(kind, lines[i][1], lines[i + 1][1], x_before, x, arrival, foot, end))
        arrival, x_before = end, x
    return pairs


def placing_steps(chain: Chain, table: DhTable, columns: Sequence[Column] = COLUMNS) -> list[Step]:
    """Return the construction of a table: its axes, frame 0, a step for each pair of axes, and the rows."""
    pairs = axis_pairs(chain, table)
    steps = [_axes(chain, table), _first(table)]
    steps += [_pair(i, pair, table) for i, pair in enumerate(pairs, start=1)]
    return [*steps, step(_("The table"), _("Row i collects what the steps have found."), table_array(table, columns))]


# Geometry


def _lines(chain: Chain) -> list[tuple[Array, Array]]:
    """Return a point and the direction of each axis, and of z of the tip, with every joint at zero."""
    T, lines = np.eye(4), []
    for i in range(len(chain.flat.placements)):
        T = T @ chain.flat.placement(i)
        lines.append((T[:3, 3], T[:3, 2]))
    return lines


def _frames(table: DhTable) -> list[Array]:
    Ts = [table.base]
    for row in table.joints:
        Ts.append(Ts[-1] @ row.transform(0.0, table.convention))
    return Ts


def _kind(table: DhTable, i: int) -> PairKind:
    """Return what two axes were taken as: their a and α are exactly 0, or π, where they are special."""
    if table.convention == "modified" and i + 1 == len(table.joints):  # the tool has what leads to z of the tip
        T = table.tool
        a, is_parallel = float(T[0, 3]), math.hypot(*T[:2, 2]) <= _SQUARE
    else:
        row = table.joints[i if table.convention == "standard" else i + 1]
        a, is_parallel = row.a, row.alpha in (0.0, math.pi)
    if is_parallel:
        return "parallel" if a else "collinear"
    return "skew" if a else "intersecting"


def _feet(
    kind: PairKind, line: tuple[Array, Array], following: tuple[Array, Array], arrival: Array, is_last: bool
) -> tuple[Array, Array]:
    """Return where the common normal of two axes meets the first and the second; where many do, the agreed one."""
    (p, z), (p_next, z_next) = line, following
    if kind in {"parallel", "collinear"}:
        if is_last:
            return p + (z @ (p_next - p)) * z, p_next
        return arrival, p_next + (z_next @ (arrival - p_next)) * z_next if kind == "parallel" else arrival
    n = np.cross(z, z_next)
    between, square = p_next - p, float(n @ n)
    along: Array = np.cross(between, z_next) @ n / square * z
    along_next: Array = np.cross(between, z) @ n / square * z_next
    return p + along, p_next + along_next


def _turn(start: Array, end: Array, about: Array) -> float:
    angle = math.atan2(float(about @ np.cross(start, end)), float(start @ end))
    return math.pi if angle == -math.pi else angle


# Words


def _axes(chain: Chain, table: DhTable) -> Step:
    shift = 1 if table.convention == "standard" else 0
    lines = [
        rf"z_{{{i - shift}}} = {_vector(direction)},\quad P_{{{i}}} = {_vector(point)}"
        for i, (point, direction) in enumerate(_lines(chain), start=1)
    ]
    text = _(
        "First the axes: z lies along the axis that a revolute joint turns about, or along the direction in which a "
        "prismatic one moves. Each is a line through a point P_i, here in the axes of the base with every joint at "
        "zero. The last one is z of the tip, which is treated as one more axis."
    )
    return step(_("Axes of the joints"), text, *lines)


def _first(table: DhTable) -> Step:
    T = table.base
    text = _(
        "Frame 0 may be anywhere on axis 1 as long as z_0 lies along it. Its origin is the foot of the base's origin "
        "on that axis; the transform from the base to frame 0 is kept beside the table."
    )
    lines = rf"O_0 = {_vector(T[:3, 3])},\quad x_0 = {_vector(T[:3, 0])},\quad z_0 = {_vector(T[:3, 2])}"
    return step(_("Frame 0"), text, lines)


def _pair(i: int, pair: AxisPair, table: DhTable) -> Step:
    title = {
        "skew": _("Frame {i}: skew axes"),
        "intersecting": _("Frame {i}: intersecting axes"),
        "parallel": _("Frame {i}: parallel axes"),
        "collinear": _("Frame {i}: axes on one line"),
    }[pair.kind]
    is_last = i == len(table.joints)
    text = [_why(pair.kind, is_last).format(i=i, next=i + 1)]
    if table.joints[i - 1].type == "prismatic":
        text.append(_("Joint {i} is prismatic: its axis has a direction, but may be moved sideways.").format(i=i))
    if pair.kind in ("skew", "parallel") and pair.a < 0.0:
        text.append(_("x_{i} points away from the next axis, so that a_{i} is negative.").format(i=i))
    if is_last and table.convention == "modified":
        text.append(_("a_{i} and α_{i} are in no row of a modified table: they become part of the tool.").format(i=i))
    return step(title.format(i=i), " ".join(text), *_formulas(i, pair, table))


def _why(kind: PairKind, is_last: bool) -> str:
    """Return why x_i is where it is."""
    if kind == "skew":
        return _(
            "Axes {i} and {next} have exactly one common normal. x_{i} lies along it; of its two directions the one is "
            "taken that turns ϑ_{i} by at most 90° at zero."
        )
    if kind == "intersecting":
        return _(
            "Axes {i} and {next} meet in a point, so that a_{i} = 0. x_{i} is normal to both, along their cross "
            "product or against it: the direction is taken that turns ϑ_{i} by at most 90° at zero."
        )
    if is_last:
        return _("z of the tip is parallel to the last axis; the last frame is put at the height of the tip.")
    if kind == "parallel":
        return _(
            "Axes {i} and {next} are parallel and have a normal at every height. The one through the origin before is "
            "taken, so that d_{i} = 0."
        )
    return _("Axes {i} and {next} are one line: the origin and x stay where they are.")


def _formulas(i: int, pair: AxisPair, table: DhTable) -> Iterator[str]:
    standard = table.convention == "standard"
    z, after = (rf"z_{{{i - 1}}}", rf"z_{{{i}}}") if standard else (rf"z_{{{i}}}", rf"z_{{{i + 1}}}")
    x, before = rf"x_{{{i}}}", rf"x_{{{i - 1}}}"
    # A standard frame has its origin at the end of its normal, a modified one at the foot.
    foot, end, arrival = rf"F_{{{i}}}", rf"O_{{{i}}}", rf"O_{{{i - 1}}}"
    if not standard:
        foot, end, arrival = rf"O_{{{i}}}", rf"E_{{{i}}}", rf"E_{{{i - 1}}}" if i > 1 else "O_0"
    crossed = np.cross(pair.z, pair.z_next)
    if pair.kind in ("skew", "intersecting"):
        yield rf"{z} \times {after} = {_vector(crossed)}"
        sign = "" if crossed @ pair.x > 0.0 else "-"
        yield rf"{x} = {sign}\frac{{{z} \times {after}}}{{\lVert {z} \times {after} \rVert}} = {_vector(pair.x)}"
    else:
        yield rf"{z} \times {after} = 0,\quad {x} = {_vector(pair.x)}"
    yield rf"{foot} = {_vector(pair.foot)},\quad {end} = {_vector(pair.end)}"
    yield rf"a_{{{i}}} = {x} \cdot ({end} - {foot}) = {decimal(pair.a)}"
    angle = r"\operatorname{atan2}"
    turned = rf"{angle}({x} \cdot ({z} \times {after}),\, {z} \cdot {after})"
    yield rf"\alpha_{{{i}}} = {turned} = {angle_text(rounded(pair.alpha))}"
    slides = table.joints[i - 1].type == "prismatic"
    variable = rf"q_{{{i}}} + "
    offset = f" = {with_variable(i, rounded(pair.d), decimal(pair.d))}" if slides else f" = {decimal(pair.d)}"
    yield rf"d_{{{i}}} = {variable if slides else ''}{z} \cdot ({foot} - {arrival}){offset}"
    theta = rounded(pair.theta)
    offset = angle_text(theta) if slides else with_variable(i, theta, angle_text(theta))
    turned = rf"{angle}({z} \cdot ({before} \times {x}),\, {before} \cdot {x})"
    yield rf"\vartheta_{{{i}}} = {'' if slides else variable}{turned} = {offset}"
