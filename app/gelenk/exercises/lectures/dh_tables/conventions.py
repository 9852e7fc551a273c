"""From Craig's table to the standard one."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.dh.tables.convert import converted
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.table_field import DhTableField, table_of
from gelenk.language import marked
from gelenk.language import translated as _
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
    return "; ".join(f"{a:g} m, {alpha:g}°, {d:g} m, {theta:g}°" for a, alpha, d, theta in rows)


def standard_rows(one: CraigTable) -> Array:
    """Return the rows of the standard table, whose last frame is that of Craig's: shape (n, 4)."""
    found = converted(one.table, "standard")
    return np.array([(row.a, row.alpha, row.d, row.theta) for row in found.joints])


def table_steps(rows: Array) -> Step:
    """Return the step with a table in the course's order, angles in radians."""
    lines = (" & ".join([str(i), *(tex(round(float(x), 9) + 0.0) for x in row)]) for i, row in enumerate(rows, start=1))
    table = r"\begin{array}{c|cccc} i & a_i & \alpha_i & d_i & \vartheta_i \\ \hline "
    text = _("Lengths in metres, angles in radians, all at the zeros of the joints.")
    return step(_("Table"), text, table + r" \\ ".join(lines) + r" \end{array}")


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

EXERCISES = (CONVENTIONS,)
