"""DH tables in steps: the rows as the lecture writes them, columns in any order, and how a table changes convention."""

import math
from collections.abc import Sequence

from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import decimal, rounded
from gelenk.dh.derive.columns import COLUMNS, Column, array_of
from gelenk.dh.derive.steps import transform_rule
from gelenk.dh.derive.typeset import multiple_of_pi
from gelenk.language import translated as _
from gelenk.robot.dh import DhJoint, DhTable

_SAME_ANGLE = 2e-9
"""Two units of the last decimal shown, [rad]."""


def table_array(table: DhTable, columns: Sequence[Column] = COLUMNS) -> str:
    """Return a table in LaTeX, columns in this order, with the variable q_i in each row."""
    rows = [_cells(i, row) for i, row in enumerate(table.joints, start=1)]
    return array_of(rows, "i" if table.convention == "standard" else "i-1", columns)


def _cells(i: int, row: DhJoint) -> dict[Column, str]:
    values = {name: rounded(getattr(row, name)) for name in COLUMNS}
    cells = {name: tex(value) if name in ("a", "d") else angle_text(value) for name, value in values.items()}
    variable: Column = "theta" if row.type == "revolute" else "d"
    cells[variable] = with_variable(i, values[variable], cells[variable])
    return cells


def conversion_steps(table: DhTable, other: DhTable, columns: Sequence[Column] = COLUMNS) -> list[Step]:
    """Return how a table is written in the other convention; a table in its own convention only appears."""
    steps = [step(_("The given table"), _("Each row has the variable of its joint."), table_array(table, columns))]
    if table.convention == other.convention:
        return steps
    rules = [f"A^{{i-1}}_i = {transform_rule(standard=one)[0]}" for one in (True, False)]
    text = _(
        "Both conventions multiply the same factors and only cut the product at other places: a standard row ends with "
        "a and α of its link, a modified row begins with those of the link before. So a and α move by one row, d and ϑ "
        "stay; what has no row at the one end goes into the base or the tool."
    )
    rows = other.joints if other.convention == "standard" else table.joints
    moved = [
        rf"a_{{{i}}} = {decimal(row.a)},\quad \alpha_{{{i}}} = {angle_text(rounded(row.alpha))}"
        for i, row in enumerate(rows, start=1)
    ]
    shift = step(_("Where a and α belong"), text, *rules, *moved)
    result = _("In the modified convention a and alpha carry the index of the link before the joint.")
    return [*steps, shift, step(_("The table in the other convention"), result, table_array(other, columns))]


def with_variable(i: int, value: float, text: str) -> str:
    """Write q_i, plus a value that is not zero."""
    if value == 0.0:
        return rf"q_{{{i}}}"
    return rf"q_{{{i}}} - {text[1:]}" if text.startswith("-") else rf"q_{{{i}}} + {text}"


def angle_text(value: float) -> str:
    """Return an angle as a multiple of π if it is one up to the shown digits, else in radians."""
    multiple = round(value * 12 / math.pi) * math.pi / 12
    known = multiple_of_pi(multiple)
    return known.latex if known is not None and abs(value - multiple) < _SAME_ANGLE else tex(value)
