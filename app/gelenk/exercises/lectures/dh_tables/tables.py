"""From Craig's table to the standard one, and an exam: from the axes of an arm to its table and its poses."""

import math
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.course.steps import Step, step, table, tex
from gelenk.course.writing import decimal
from gelenk.dh.tables.convert import converted
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import matrix, vector
from gelenk.exercises.lectures.dh_tables.rows import typeset
from gelenk.exercises.table_field import DhTableField, table_of
from gelenk.language import localised, marked, number_list, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

_ROW = tuple[float, float, float, float]


class CraigTable(NamedTuple):
    """Three or four revolute rows a, α, d, ϑ of Craig's convention, lengths in metres, angles in degrees."""

    rows: tuple[_ROW, ...]

    @property
    def array(self) -> Array:
        """The rows, angles in radians."""
        return np.array([(a, math.radians(alpha), d, math.radians(theta)) for a, alpha, d, theta in self.rows])

    @property
    def slides(self) -> tuple[bool, ...]:
        """Which joints are prismatic: none."""
        return (False,) * len(self.rows)

    @property
    def table(self) -> DhTable:
        """The table as given."""
        return table_of(self.array, self.slides, "modified")


def _draw_table(draw: Draw) -> CraigTable:
    first = (0.0, 0.0, draw.decimal(0.0, 0.5, 0.05), 0.0)
    further = [
        (
            draw.choice((0.0, draw.decimal(0.1, 0.6, 0.05))),
            draw.choice((-90.0, 0.0, 90.0)),
            draw.choice((0.0, draw.decimal(0.1, 0.5, 0.05))),
            draw.choice((-90.0, 0.0, 0.0, 90.0)),
        )
        for _ in range(draw.integer(2, 3))
    ]
    return CraigTable((first, *further))


def _is_useless(one: CraigTable) -> bool:
    """Check whether axes coincide, or the conventions hardly differ."""
    coincide = any(a == alpha == 0.0 for a, alpha, _d, _theta in one.rows[1:])
    return coincide or sum(alpha != 0.0 for _a, alpha, _d, _theta in one.rows) < 2


def listing(rows: tuple[_ROW, ...]) -> str:
    """Return rows as text, angles in degrees."""
    return "; ".join(localised(f"{a:g} m, {alpha:g}°, {d:g} m, {theta:g}°") for a, alpha, d, theta in rows)


def standard_rows(one: CraigTable) -> Array:
    """Return the rows of the standard table, whose last frame is that of Craig's: shape (n, 4)."""
    found = converted(one.table, "standard")
    return np.array([(row.a, row.alpha, row.d, row.theta) for row in found.joints])


def table_steps(rows: Array) -> Step:
    """Return the step with a table in the course's order, angles in radians."""
    lines = ((str(i), *map(decimal, row)) for i, row in enumerate(rows, start=1))
    array = table(("i", "a_i", r"\alpha_i", "d_i", r"\vartheta_i"), lines, "c|cccc")
    text = _("Lengths in metres, angles in radians, all at the zeros of the joints.")
    return step(_("Table"), text, array)


def _craig_steps(one: CraigTable) -> list[Step]:
    return [
        step(
            _("The two orders"),
            _("Craig moves along and about x first; so a and α of a row belong to the standard row before it."),
            r"T = R_x(\alpha_0)\,T_x(a_0) \cdot R_z(\vartheta_1)\,T_z(d_1) \cdot R_x(\alpha_1)\,T_x(a_1) \cdots "
            r"R_z(\vartheta_n)\,T_z(d_n)",
            r"T = [R_z(\vartheta_1)\,T_z(d_1)\,T_x(a_1)\,R_x(\alpha_1)] \cdots [R_z(\vartheta_n)\,T_z(d_n)]",
        ),
        table_steps(standard_rows(one)),
    ]


CONVENTIONS = Exercise(
    id="dh_tables.conventions",
    title=marked("From Craig's table to the standard one"),
    difficulty=3,
    draw=_draw_table,
    is_degenerate=_is_useless,
    text=lambda one: _(
        "An arm of {count} revolute joints has this table in Craig's (modified) convention, row by row a(i-1), α(i-1), "
        "d(i), ϑ(i) at the zeros of the joints: {rows}. Which standard (distal) table describes it, with the same "
        "frame 0 and the same last frame? Give a, α, d, ϑ in metres and radians."
    ).format(count=len(one.rows), rows=listing(one.rows)),
    fields=lambda one: (
        DhTableField(name="table", label=_("Standard table"), tolerance=0.003, slides=one.slides, points=3.0),
    ),
    solve=lambda one: {"table": standard_rows(one)},
    steps=_craig_steps,
    wrong={"copied_table": lambda one: {"table": one.array}},
)


_QuarterRow: TypeAlias = tuple[float, int, float, int]
"""a and d in metres, α and ϑ in quarter turns."""


@dataclass(frozen=True)
class AxesTask:
    """An arm of three joints whose axes are along those of frame 0 at q = 0.

    Attributes:
        rows: Its table.
        slides: Which joints are prismatic.
        moved: How far the point that the text gives of each axis is from the frame's origin, [m].
        positions: q of the pose in question, [rad or m].
    """

    rows: tuple[_QuarterRow, ...]
    slides: tuple[bool, ...]
    moved: tuple[float, ...]
    positions: tuple[float, ...]

    @property
    def array(self) -> Array:
        """The numbers of the rows, angles in radians."""
        return np.array([(a, k * math.pi / 2, d, t * math.pi / 2) for a, k, d, t in self.rows])

    @property
    def table(self) -> DhTable:
        """The rows as a table of the core."""
        return table_of(self.array, self.slides)

    def axis(self, i: int) -> tuple[Array, Array]:
        """Return a point, [m], and the direction of axis i from 0, at q = 0."""
        T = self.table.frames((0.0,) * 3)[i]
        return T[:3, 3] + self.moved[i] * T[:3, 2], T[:3, 2]


_KINDS = ((False, False, False), (False, False, True), (False, True, False), (True, False, False), (True, False, True))


def _draw_axes(draw: Draw) -> AxesTask:
    slides = draw.choice(_KINDS)
    rows = tuple(
        (
            draw.choice((0.0, draw.decimal(0.1, 0.6, 0.05))),
            draw.choice((-1, 0, 1)),
            draw.choice((0.0, draw.decimal(0.1, 0.6, 0.05))),
            draw.choice((-1, 0, 0, 1)),
        )
        for _ in slides
    )
    moved = (draw.decimal(0.0, 0.3, 0.1), draw.decimal(0.0, 0.3, 0.1), draw.decimal(0.0, 0.3, 0.1))
    positions = [draw.signed(0.1, 0.4, 0.05) if slide else draw.signed(0.2, 1.4, 0.1) for slide in slides]
    return AxesTask(rows, slides, moved, tuple(positions))


def _is_useless_arm(one: AxesTask) -> bool:
    """Check whether axes coincide, all are parallel, a joint does nothing, or nothing hides in a zero."""
    (a1, k1, _d1, _t1), (a2, k2, _d2, _t2), (a3, _k3, d3, _t3) = one.rows
    if (a1 == 0.0 and k1 == 0) or (a2 == 0.0 and k2 == 0) or (k1 == 0 and k2 == 0) or a3 == d3 == 0.0:
        return True
    if any(one.slides[i] and one.slides[i + 1] for i in (0, 1)) or not any(t for _a, _k, _d, t in one.rows):
        return True
    return float(np.linalg.norm(one.table.pose(one.positions)[:3, 3])) < 0.2


def _direction(vector: Array) -> str:
    k = int(np.argmax(np.abs(vector)))
    return f"{'+' if vector[k] > 0.0 else '-'}{'xyz'[k]}"


def _point(vector: Array) -> str:
    return number_list(round(float(x), 6) + 0.0 for x in vector)


def _axes_text(one: AxesTask) -> str:
    lines = []
    for i, slide in enumerate(one.slides):
        point, direction = one.axis(i)
        line = _("Joint {number} turns about the axis through ({point}) in direction {direction}.")
        if slide:
            line = _("Joint {number} slides along the axis through ({point}) in direction {direction}.")
        lines.append(line.format(number=i + 1, point=_point(point), direction=_direction(direction)))
    tip = one.table.pose((0.0,) * 3)
    units = ["m" if slide else "rad" for slide in one.slides]
    names = [
        f"q{i} = {localised(f'{q:g}')} {unit}"
        for i, (q, unit) in enumerate(zip(one.positions, units, strict=True), start=1)
    ]
    return _(
        "An arm of three joints is described at q = 0, in the axes of the base frame 0, lengths in metres.\n\n"
        "{axes}\n\n"
        "Frame 3 has its origin at ({origin}), its x axis in direction {x}, its z axis in direction {z}.\n\n"
        "Which standard DH table has this arm, such that z(i-1) points in the direction of joint i? Give a, α, d, ϑ of "
        "each row at q = 0, in metres and radians; any table that gives the right pose at every q is right. Which pose "
        "has frame 3 at {positions}: its position, and its rotation matrix?"
    ).format(
        axes="\n".join(lines),
        origin=_point(tip[:3, 3]),
        x=_direction(tip[:3, 0]),
        z=_direction(tip[:3, 2]),
        positions=", ".join(names),
    )


def _pose_of(one: AxesTask, rows: Array) -> Answers:
    pose = table_of(rows, one.slides).pose(one.positions)
    return {"position": pose[:3, 3], "rotation": pose[:3, :3]}


def _with_columns(one: AxesTask, factors: list[float]) -> Answers:
    return _pose_of(one, one.array * factors)


def _reversed_product(one: AxesTask) -> Answers:
    parts = [row.transform(q, "standard") for row, q in zip(one.table.joints, one.positions, strict=True)]
    pose = np.linalg.multi_dot(parts[::-1])
    return {"position": pose[:3, 3], "rotation": pose[:3, :3]}


def _axes_steps(one: AxesTask) -> list[Step]:
    frames = one.table.frames(one.positions)
    directions = [rf"z_{i} = ({', '.join(f'{x:.0f}' for x in np.round(one.axis(i)[1]) + 0.0)})" for i in range(3)]
    return [
        step(
            _("Axes z"),
            _("Each z(i-1) is the axis of joint i; x(i) is the common normal of z(i-1) and z(i)."),
            *directions,
        ),
        table_steps(one.array),
        step(
            _("Pose"),
            _("The product of the three matrices; the position of the joint is added to ϑ, or to d if it slides."),
            *(rf"A^0_{i} = {typeset(T)}" for i, T in enumerate(frames[1:], start=1)),
            rf"\lVert p \rVert = {tex(float(np.linalg.norm(frames[-1][:3, 3])), 'm')}",
        ),
    ]


ARM = Exercise(
    id="dh_tables.arm",
    title=marked("Exam: the table of an arm from its axes"),
    difficulty=5,
    draw=_draw_axes,
    is_degenerate=_is_useless_arm,
    text=_axes_text,
    fields=lambda one: (
        DhTableField(name="table", label=_("Standard table"), tolerance=0.003, slides=one.slides, points=4.0),
        vector("position", _("Position of frame 3"), 3, "m", 2.0, within=0.003),
        matrix("rotation", _("Rotation matrix of frame 3"), (3, 3), within=0.003),
    ),
    solve=lambda one: {"table": one.array, **_pose_of(one, one.array)},
    steps=_axes_steps,
    wrong={
        "alpha_sign": lambda one: _with_columns(one, [1.0, -1.0, 1.0, 1.0]),
        "offset_forgotten": lambda one: _with_columns(one, [1.0, 1.0, 1.0, 0.0]),
        "a_and_d_exchanged": lambda one: _pose_of(one, one.array[:, [2, 1, 0, 3]]),
        "product_reversed": _reversed_product,
    },
)
