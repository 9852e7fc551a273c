"""An exam: from the axes of an arm to its table and its poses."""

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import MatrixField, VectorField
from gelenk.exercises.lectures.dh_tables.conventions import table_steps
from gelenk.exercises.lectures.dh_tables.rows import typeset
from gelenk.exercises.table_field import DhTableField, table_of
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

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
    return ", ".join(f"{round(float(x), 6) + 0.0:g}" for x in vector)


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
    names = [f"q{i} = {q:g} {unit}" for i, (q, unit) in enumerate(zip(one.positions, units, strict=True), start=1)]
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
        VectorField(name="position", label=_("Position of frame 3"), unit="m", tolerance=0.003, size=3, points=2.0),
        MatrixField(name="rotation", label=_("Rotation matrix of frame 3"), tolerance=0.003, rows=3, columns=3),
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

EXERCISES = (ARM,)
