"""DH tables in steps: the rows as the lecture writes them, columns in any order, a change of convention, and a pose."""

import math
from collections.abc import Sequence

import numpy as np

from gelenk.course.orientation.orientation import notations
from gelenk.course.orientation.orientation_steps import axis_angle_step, quaternion_step, rpy_step, zyz_step
from gelenk.course.steps import Step, step, tex
from gelenk.course.velocity.geometry import joint_motion
from gelenk.course.writing import decimal, matrix, number, rounded, vector
from gelenk.dh.derive.steps import transform_rule
from gelenk.dh.derive.texts import array_of
from gelenk.dh.derive.typeset import multiple_of_pi
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
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


_TURNS = {
    "quaternion_xyzw": (axis_angle_step, quaternion_step),
    "quaternion_wxyz": (axis_angle_step, quaternion_step),
    "rotation_vector": (axis_angle_step,),
    "rpy": (rpy_step,),
    "zyz": (zyz_step,),
}
"""Steps from R to the notation of the answer; none to a matrix."""


def forward_steps(table: DhTable, q: Array, notation: str) -> list[Step]:
    """Return how a table's pose at a configuration is found; q of shape (n,), [rad or m]."""
    positions = table.positions(q.tolist())
    rows = list(zip(table.joints, positions, strict=True))
    text = _("The joint positions go into the table: they add to the angle of a turning joint, to d of a sliding one.")
    if any(row.mimic is not None for row in table.joints):
        text += " " + _("The position of a joint that follows another is the one that it follows to.")
    given = step(_("Denavit-Hartenberg table"), text, table_array(table), f"q = {vector(positions)}")
    rule, entries = transform_rule(standard=table.convention == "standard")
    transforms = [row.transform(position, table.convention) for row, position in rows]
    lines = [
        rf"{_variable(i, row, position)},\quad A^{{{i - 1}}}_{{{i}}} = {matrix(A)}"
        for i, ((row, position), A) in enumerate(zip(rows, transforms, strict=True), start=1)
    ]
    text = _("Each row put into the rule of the convention gives the pose of frame i in frame i - 1.")
    neighbours = step(_("Transforms between neighbours"), text, rf"A^{{i-1}}_{{i}} = {rule} = {entries}", *lines)
    return [given, neighbours, *_from_base_to_tip(transforms, table.base, table.tool, notation)]


def placement_steps(flat: FlatChain, q: Array, notation: str) -> list[Step]:
    """Return the same for a chain that no table describes, from the constant placements of its description."""
    transforms, lines = [], []
    drives = zip(flat.joints.tolist(), flat.drives.tolist(), strict=True)
    for i, ((slides, variable), (rate, offset)) in enumerate(drives, start=1):
        P, position = flat.placement(i - 1), rate * float(q[variable]) + offset
        transforms.append(P @ joint_motion(slides == 1, position))
        product = rf"P_{{{i}}}\, {'T' if slides else 'R'}_z(q_{{{i}}})"
        lines.append(
            rf"P_{{{i}}} = {matrix(P)},\quad q_{{{i}}} = {number(position)},\quad "
            rf"A^{{{i - 1}}}_{{{i}}} = {product} = {matrix(transforms[-1])}"
        )
    text = _("No table describes this chain: each joint turns about or slides along z of its placement P in the URDF.")
    neighbours = [step(_("Transforms between neighbours"), text, *lines)] if lines else []
    return [*neighbours, *_from_base_to_tip(transforms, np.eye(4), flat.placement(len(lines)), notation)]


def _variable(i: int, row: DhJoint, position: float) -> str:
    """Write the entry of a row that varies, with its number."""
    if row.type == "revolute":
        name, constant, text = rf"\vartheta_{{{i}}}", row.theta, angle_text(rounded(row.theta))
    else:
        name, constant, text = f"d_{{{i}}}", row.d, number(row.d)
    return f"{name} = {with_variable(i, rounded(constant), text)} = {number(constant + position)}"


def _from_base_to_tip(transforms: Sequence[Array], base: Array, tool: Array, notation: str) -> list[Step]:
    """Multiply, and read off position and orientation."""
    T, n, lines = np.eye(4), len(transforms), []
    for i, A in enumerate(transforms, start=1):
        T = T @ A
        product = rf"T^{{0}}_{{{i - 1}}}\, A^{{{i - 1}}}_{{{i}}}" if i > 1 else r"A^{0}_{1}"
        lines.append(rf"T^{{0}}_{{{i}}} = {product} = {matrix(T)}")
    factors = [(r"T^{\mathrm{base}}_{0}", base), (f"T^{{0}}_{{{n}}}", T), (rf"T^{{{n}}}_{{\mathrm{{tool}}}}", tool)]
    own = [(name, A) for name, A in factors if not np.array_equal(A, np.eye(4))]
    whole = base @ T @ tool
    if len(own) > 1 or not lines:
        lines += [f"{name} = {matrix(A)}" for name, A in own if A is not T]
        product = r"\, ".join(name for name, _A in own) or "I"
        lines.append(rf"T^{{\mathrm{{base}}}}_{{\mathrm{{tool}}}} = {product} = {matrix(whole)}")
    text = _("Neighbours are multiplied from the base on: each product is the pose of one more frame in the base.")
    pose = _("The last column is the position, the first three columns are the axes of the tip: R.")
    read = (f"p = {vector(whole[:3, 3])}", f"R = {matrix(whole[:3, :3])}")
    products = step(_("Forward kinematics"), text, *lines)
    turns = _TURNS.get(notation, ())
    found = notations(whole[:3, :3]) if turns else None
    return [products, step(_("Position and orientation"), pose, *read), *(turn(found) for turn in turns if found)]
