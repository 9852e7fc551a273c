"""The worked solution in the order of the lecture: short texts, and the formulas that they refer to."""

from collections.abc import Sequence

from gelenk.course.steps import Step, step
from gelenk.dh.derive.jacobian import Block
from gelenk.dh.derive.texts import Formulas, SingularCondition, Singularities
from gelenk.dh.derive.typeset import MatrixFormula
from gelenk.language import translated as _

_ROWS = (r"v_{x}", r"v_{y}", r"v_{z}", r"\omega_{x}", r"\omega_{y}", r"\omega_{z}")


def steps(convention: str, found: Formulas, singular: Singularities | None) -> list[Step]:
    """Return the solution in sections: table, A_i, position, pose, Jacobian, determinant, singular configurations."""
    standard = convention == "standard"
    all_ = [_table(standard, found), _rows(standard, found), _position(found), _pose(found), _jacobian(standard, found)]
    if singular is not None and singular.block is not None:
        all_ += [_determinant(singular, singular.block), _singular(singular)]
    return [step for step in all_ if step is not None]


def _table(standard: bool, found: Formulas) -> Step:
    links = [("i", "a_i", r"\alpha_i"), ("i", "a_{i-1}", r"\alpha_{i-1}")][not standard]
    head = " & ".join((*links, "d_i", r"\vartheta_i"))
    lines = [" & ".join((str(i), *(text.latex for text in row))) for i, row in enumerate(found.parameters, start=1)]
    array = rf"\begin{{array}}{{c|cccc}} {head} \\ \hline " + r" \\ ".join(lines) + r" \end{array}"
    text = _(
        "One row per joint. The variable adds to the angle of a revolute joint and to d of a prismatic one; "
        "a parameter that is zero leaves the formulas, an angle that is a multiple of 90° becomes a number."
    )
    if not standard:
        index = _("In the modified convention a and alpha carry the index of the link before the joint.")
        text = f"{text} {index}"
    return step(_("Denavit-Hartenberg table"), text, array)


def _rows(standard: bool, found: Formulas) -> Step:
    rule = (
        r"A_i = R_z(\vartheta_i)\, T_z(d_i)\, T_x(a_i)\, R_x(\alpha_i)"
        if standard
        else r"A_i = R_x(\alpha_{i-1})\, T_x(a_{i-1})\, R_z(\vartheta_i)\, T_z(d_i)"
    )
    text = _("Each row put into the rule of the convention gives the pose of frame i in frame i - 1.")
    return step(_("Transforms between neighbours"), text, rule, *_named("A", found.rows))


def _position(found: Formulas) -> Step | None:
    if found.chain is None:
        return None
    n = len(found.rows)
    product = " ".join(f"A_{{{i}}}" for i in range(1, n + 1))
    lines = [rf"{{}}^{{0}}p = {product}\, {{}}^{{{n}}}p"]
    lines += [rf"{{}}^{{{n - k}}}p = {vector.latex}" for k, vector in enumerate(found.chain)]
    text = _(
        "The position of the tip is best worked out from the right: a matrix times a vector at every step, never a "
        "matrix times a matrix. Superscripts name the frame in which the point is written."
    )
    return step(_("Position of the tip"), text, *lines)


def _pose(found: Formulas) -> Step:
    lines = _named("T^{0}", found.frames)
    last = found.frames[-1]
    if found.tip is not None and (last is None or found.tip.latex != last.latex):
        lines.append(rf"T^{{\mathrm{{base}}}}_{{\mathrm{{tool}}}} = {found.tip.latex}")
    text = _(
        "T_0_i = A_1 A_2 … A_i. About parallel axes angles add up, so that each sum is in one sine and cosine. "
        "The last column is the position, the first three are the axes of frame i written in frame 0."
    )
    return step(_("Forward kinematics"), text, *lines)


def _jacobian(standard: bool, found: Formulas) -> Step | None:
    if found.columns is None or found.jacobian is None:
        return None
    lines = []
    for i, column in enumerate(found.columns, start=1):
        k = i - 1 if standard else i
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
    ).format(frame="i - 1" if standard else "i")
    return step(_("Geometric Jacobian"), text, *lines, f"J = {found.jacobian.latex}")


def _determinant(singular: Singularities, block: Block) -> Step:
    setting = singular.setting
    rows = ", ".join(_ROWS[i] for i in block.rows)
    text = which_block(block)
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
        text = f"{text} {triangular.format(frame=setting.frame, point=setting.point)}"
    if singular.formula is None:
        unwritten = _("It is not written out: see the notes.")
        return step(_("Determinant"), f"{text} {unwritten}")
    return step(_("Determinant"), text, rf"\det J_{{({rows})}} = {singular.formula.latex}")


def which_block(block: Block) -> str:
    """Say which block of the Jacobian has the determinant, and why that one."""
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
    return words[block.kind].format(count=len(block.rows), frame=block.frame)


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


def _named(letter: str, matrices: Sequence[MatrixFormula | None]) -> list[str]:
    return [f"{letter}_{{{i}}} = {matrix.latex}" for i, matrix in enumerate(matrices, start=1) if matrix is not None]
