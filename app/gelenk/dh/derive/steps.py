"""The worked solution in the order of the lecture: short texts, and the formulas that they refer to."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import decimal, matrix
from gelenk.dh.derive.jacobian import Block
from gelenk.dh.derive.numeric import NumericSolution
from gelenk.dh.derive.texts import Formulas, SingularCondition, Singularities, array_of
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.language import translated as _
from gelenk.robot.dh import DhTable

_STANDARD = (
    r"\begin{bmatrix} c_{\vartheta_i} & -s_{\vartheta_i} c_{\alpha_i} & s_{\vartheta_i} s_{\alpha_i} & "
    r"a_i c_{\vartheta_i} \\ s_{\vartheta_i} & c_{\vartheta_i} c_{\alpha_i} & -c_{\vartheta_i} s_{\alpha_i} & "
    r"a_i s_{\vartheta_i} \\ 0 & s_{\alpha_i} & c_{\alpha_i} & d_i \\ 0 & 0 & 0 & 1 \end{bmatrix}"
)
_MODIFIED = (
    r"\begin{bmatrix} c_{\vartheta_i} & -s_{\vartheta_i} & 0 & a_{i-1} \\ "
    r"s_{\vartheta_i} c_{\alpha_{i-1}} & c_{\vartheta_i} c_{\alpha_{i-1}} & -s_{\alpha_{i-1}} & -d_i s_{\alpha_{i-1}} "
    r"\\ s_{\vartheta_i} s_{\alpha_{i-1}} & c_{\vartheta_i} s_{\alpha_{i-1}} & c_{\alpha_{i-1}} & d_i c_{\alpha_{i-1}} "
    r"\\ 0 & 0 & 0 & 1 \end{bmatrix}"
)
_ROWS = (r"v_{x}", r"v_{y}", r"v_{z}", r"\omega_{x}", r"\omega_{y}", r"\omega_{z}")


@dataclass(frozen=True, slots=True)
class Layout:
    """How the steps are written: convention, number of joints before the first row, order of the table's columns."""

    is_standard: bool
    before: int
    columns: Sequence[Column]


def steps(layout: Layout, found: Formulas, singular: Singularities | None) -> list[Step]:
    """Return the solution in sections: table, A_i, position, pose, Jacobian, determinant, singular configurations."""
    parts = (_table, _rows, _position, _pose, _jacobian)
    all_ = [part(layout, found) for part in parts]
    return [*(step for step in all_ if step is not None), *determinant_steps(singular, layout.before)]


def determinant_steps(singular: Singularities | None, before: int = 0) -> list[Step]:
    """Return determinant and singular configurations; none without a square block. `before` is as in `Layout`."""
    if singular is None or singular.block is None:
        return []
    where = _singular(singular)
    return [_determinant(singular, singular.block, before), *([] if where is None else [where])]


def _table(layout: Layout, found: Formulas) -> Step:
    rows = [{name: text.latex for name, text in zip(COLUMNS, row, strict=True)} for row in found.parameters]
    array = array_of(rows, "i" if layout.is_standard else "i-1", layout.columns, layout.before + 1)
    text = _(
        "One row per joint. The variable adds to the angle of a revolute joint and to d of a prismatic one; "
        "a parameter that is zero leaves the formulas, an angle that is a multiple of 90° becomes a number."
    )
    if not layout.is_standard:
        index = _("In the modified convention a and alpha carry the index of the link before the joint.")
        text = f"{text} {index}"
    return step(_("Denavit-Hartenberg table"), text, array)


def transform_rule(*, standard: bool) -> tuple[str, str]:
    """Return the product that A_i is in a convention, and its entries."""
    if standard:
        return r"R_z(\vartheta_i)\, T_z(d_i)\, T_x(a_i)\, R_x(\alpha_i)", _STANDARD
    return r"R_x(\alpha_{i-1})\, T_x(a_{i-1})\, R_z(\vartheta_i)\, T_z(d_i)", _MODIFIED


def _rows(layout: Layout, found: Formulas) -> Step:
    product, entries = transform_rule(standard=layout.is_standard)
    numbered = enumerate(found.rows, start=layout.before + 1)
    lines = [rf"A^{{{i - 1}}}_{{{i}}} = {row.latex}" for i, row in numbered if row is not None]
    text = _("Each row put into the rule of the convention gives the pose of frame i in frame i - 1.")
    return step(_("Transforms between neighbours"), text, rf"A^{{i-1}}_{{i}} = {product} = {entries}", *lines)


def _position(layout: Layout, found: Formulas) -> Step | None:
    if found.chain is None:
        return None
    lines = [_product(layout, len(found.rows))]
    last = layout.before + len(found.rows)
    lines += [rf"{{}}^{{{last - k}}}p = {vector.latex}" for k, vector in enumerate(found.chain)]
    text = _(
        "The position of the tip is best worked out from the right: a matrix times a vector at every step, never a "
        "matrix times a matrix. Superscripts name the frame in which the point is written."
    )
    return step(_("Position of the tip"), text, *lines)


def _pose(layout: Layout, found: Formulas) -> Step:
    first = layout.before
    numbered = enumerate(found.frames, start=first + 1)
    lines = [rf"T^{{{first}}}_{{{i}}} = {frame.latex}" for i, frame in numbered if frame is not None]
    last = found.frames[-1]
    if found.tip is not None and (last is None or found.tip.latex != last.latex):
        lines.append(rf"T^{{\mathrm{{base}}}}_{{\mathrm{{tool}}}} = {found.tip.latex}")
    text = _(
        "T_{first}_i is the product of all transforms up to A_i. About parallel axes angles add up, so that each sum "
        "is in one sine and cosine. "
        "The last column is the position, the first three are the axes of frame i written in frame {first}."
    ).format(first=first)
    return step(_("Forward kinematics"), text, *lines)


def _jacobian(layout: Layout, found: Formulas) -> Step | None:
    if found.columns is None or found.jacobian is None:
        return None
    lines = []
    for i, column in enumerate(found.columns, start=layout.before + 1):
        k = i - 1 if layout.is_standard else i
        if column.arm is None:
            whole = rf"J_{{{i}}} = \begin{{bmatrix}} z_{{{k}}} \\ 0 \end{{bmatrix}}"
            lines.append(rf"{whole},\quad z_{{{k}}} = {column.axis.latex}")
            continue
        lines.append(
            rf"z_{{{k}}} = {column.axis.latex},\quad p_{{{k},E}} = {column.arm.latex},\quad "
            rf"z_{{{k}}} \times p_{{{k},E}} = {column.linear.latex}"
        )
    text = _(
        "The column of a revolute joint is z × p over z, that of a prismatic one z over 0. The z is that of frame "
        "{frame}, p leads from its origin to the tip. Linear rows are above angular ones, all in the axes of the base."
    ).format(frame="i - 1" if layout.is_standard else "i")
    return step(_("Geometric Jacobian"), text, *lines, f"J = {found.jacobian.latex}")


def _determinant(singular: Singularities, block: Block, before: int) -> Step:
    setting = singular.setting
    rows = ", ".join(_ROWS[i] for i in block.rows)
    text = which_block(block, before)
    if setting is None:
        vanishes = _("A part of it vanishes for every configuration, and so does its determinant.")
        text = f"{text} {vanishes}"
    elif len(setting.parts) > 1:
        triangular = _(
            "In the axes of frame {frame}, which does not change the determinant, it is block triangular: the "
            "determinant is the product of those of its parts."
            if setting.point is None
            else "In the axes of frame {frame}, for the velocity of the origin of frame {point}, which does not change "
            "the determinant, it is block triangular: the determinant is the product of those of its parts."
        )
        point = None if setting.point is None else setting.point + before
        text = f"{text} {triangular.format(frame=setting.frame + before, point=point)}"
    if singular.formula is None:
        unwritten = _("It is not written out: see the notes.")
        return step(_("Determinant"), f"{text} {unwritten}")
    return step(_("Determinant"), text, rf"\det J_{{({rows})}} = {singular.formula.latex}")


def which_block(block: Block, before: int = 0) -> str:
    """Say which block of the Jacobian has the determinant, and why that one; `before` is as in `Layout`."""
    words = {
        "full": _("With six joints the Jacobian is square."),
        "moving": _(
            "Rows that ever differ from zero, written in frame {frame}: {count}, as many as the joints. This square "
            "block holds the whole motion."
        ),
        "linear": _(
            "Linear rows that ever differ from zero, written in frame {frame}: {count}, as many as the joints. This "
            "square block tells where the tip can move to."
        ),
        "angular": _(
            "Angular rows that ever differ from zero, written in frame {frame}: {count}, as many as the joints, and "
            "the linear ones make up no regular block. This square block tells how the tip can turn."
        ),
    }
    return words[block.kind].format(count=len(block.rows), frame=block.frame + before)


def _singular(singular: Singularities) -> Step | None:
    if singular.formula is None:
        return None
    lines = [condition.condition.latex + _solved(condition) for condition in singular.conditions]
    if singular.formula.plain == "0":
        text = _("The determinant vanishes everywhere: the arm never moves the tip in all these directions.")
    elif not lines:
        text = _("No factor depends on a joint: there is no singular configuration.")
    else:
        text = _("The determinant is a product, and vanishes where one of its factors does.")
    return step(_("Singular configurations"), text, *lines)


def _solved(condition: SingularCondition) -> str:
    if condition.kind == "never":
        return rf"\quad\text{{({_('never, with these lengths')})}}"
    values = [f"{solution.variable.latex} = {solution.formula.latex}" for solution in condition.solutions]
    return r" \;\Leftrightarrow\; " + rf" \;\text{{{_('or')}}}\; ".join(values) if values else ""


def numbers_step(layout: Layout, table: DhTable, one: NumericSolution) -> Step:
    """Return the position of the tip in numbers at one configuration, from the right, then T of the whole table."""
    first, last = layout.before, layout.before + len(one.rows)
    point = np.append(table.tool[:3, 3], 1.0)
    lines = [f"q = {matrix(one.q, decimal)}", _product(layout, len(one.rows))]
    lines.append(rf"{{}}^{{{last}}}p = {matrix(point, decimal)}")
    for i, A in zip(range(last, first, -1), reversed(one.rows), strict=True):
        product = f"{matrix(A, decimal)} {matrix(point, decimal)}"
        point = A @ point
        lines.append(
            rf"{{}}^{{{i - 1}}}p = A^{{{i - 1}}}_{{{i}}}\, {{}}^{{{i}}}p = {product} = {matrix(point, decimal)}"
        )
    lines.append(rf"T^{{{first}}}_{{{last}}} = {matrix(one.frames[-1], decimal)}")
    text = _(
        "The same at the first of the given configurations. A point is written with a 1 below, so that one product "
        "turns and shifts it; the last column of T is the origin of the last frame."
    )
    return step(_("The position in numbers"), text, *lines)


def _product(layout: Layout, count: int) -> str:
    first, last = layout.before, layout.before + count
    product = r"\, ".join(f"A^{{{i - 1}}}_{{{i}}}" for i in range(first + 1, last + 1))
    return rf"{{}}^{{{first}}}p = {product}\, {{}}^{{{last}}}p"
