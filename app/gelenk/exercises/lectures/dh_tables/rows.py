"""A row of a table and its matrix, both ways, and the forward kinematics of the anthropomorphic arm."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix as written, rounded
from gelenk.exercises import sketches
from gelenk.exercises.arms import misread
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import angle, matrix, quantity, vector
from gelenk.exercises.table_field import table_of
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import Convention, DhJoint

_FORM = (
    r"A^{i-1}_i = \begin{bmatrix} "
    r"\cos\vartheta & -\sin\vartheta\cos\alpha & \sin\vartheta\sin\alpha & a\cos\vartheta \\ "
    r"\sin\vartheta & \cos\vartheta\cos\alpha & -\cos\vartheta\sin\alpha & a\sin\vartheta \\ "
    r"0 & \sin\alpha & \cos\alpha & d \\ 0 & 0 & 0 & 1 \end{bmatrix}"
)


class MatrixRow(NamedTuple):
    """A row of a standard table: lengths in metres, angles in degrees."""

    a: Annotated[float, Draw.decimal, 0.1, 0.8, 0.05]
    alpha: Annotated[float, Draw.signed, 15.0, 165.0, 15.0]
    d: Annotated[float, Draw.decimal, 0.1, 0.8, 0.05]
    theta: Annotated[float, Draw.signed, 15.0, 165.0, 15.0]

    def matrix(self, convention: Convention = "standard") -> Array:
        """Return A."""
        alpha, theta = math.radians(self.alpha), math.radians(self.theta)
        return DhJoint("", "revolute", self.a, alpha, self.d, theta).transform(0.0, convention)


def _is_too_plain(row: MatrixRow) -> bool:
    return bool(90.0 in {abs(row.alpha), abs(row.theta)} or row.a == row.d or abs(row.alpha) == abs(row.theta))


def typeset(matrix: Array) -> str:
    """Return a matrix in LaTeX, rounded to six decimals."""
    return written(matrix, lambda entry: tex(rounded(entry, 6)))


MATRIX = Exercise(
    id="dh_tables.matrix",
    title=marked("From a row to its matrix"),
    difficulty=1,
    draw=drawn(MatrixRow),
    is_degenerate=_is_too_plain,
    text=lambda row: _(
        "A row of a standard DH table has a = {a:g} m, α = {alpha:g}°, d = {d:g} m and, at the present position of the "
        "joint, ϑ = {theta:g}°. What is the homogeneous transform from frame i-1 to frame i, A = Rz(ϑ) Tz(d) Tx(a) "
        "Rx(α)?"
    ).format(**row._asdict()),
    fields=lambda _row: (matrix("matrix", _("Transform A"), (4, 4), points=2.0, within=0.002),),
    solve=lambda row: {"matrix": row.matrix()},
    steps=lambda row: [
        step(
            _("The matrix of a row"),
            _("Turn about z by ϑ, move along z by d, move along the new x by a, turn about it by α."),
            _FORM,
        ),
        step(_("With the numbers"), _("The angles are in degrees here."), rf"A^{{i-1}}_i = {typeset(row.matrix())}"),
    ],
    wrong={
        "alpha_sign": lambda row: row._replace(alpha=-row.alpha),
        "a_and_d_exchanged": lambda row: row._replace(a=row.d, d=row.a),
        "angles_exchanged": lambda row: row._replace(alpha=row.theta, theta=row.alpha),
        "craig_product": lambda row: {"matrix": row.matrix("modified")},
        "degrees_in_radians": lambda row: misread(row, "alpha", "theta"),
        "inverse_transform": lambda row: {"matrix": np.linalg.inv(row.matrix())},
        "distance_forgotten": lambda row: row._replace(a=0.0, d=0.0),
    },
    sketch=sketches.one_row,
)


# From the matrix to its row


class RoundedMatrix(NamedTuple):
    """The entries of a row's matrix that are needed, rounded as the text shows them."""

    cosine_theta: float
    sine_theta: float
    sine_alpha: float
    cosine_alpha: float
    x: float
    y: float
    d: float

    @property
    def theta(self) -> float:
        """Angle ϑ, [rad]."""
        return math.atan2(self.sine_theta, self.cosine_theta)

    @property
    def alpha(self) -> float:
        """Angle α, [rad]."""
        return math.atan2(self.sine_alpha, self.cosine_alpha)


def _draw_entries(draw: Draw) -> RoundedMatrix:
    row = drawn(MatrixRow)(draw)
    while _is_too_plain(row):
        row = drawn(MatrixRow)(draw)
    A = np.round(row.matrix(), 4)
    return RoundedMatrix(*(float(A[i, j]) + 0.0 for i, j in ((0, 0), (1, 0), (2, 1), (2, 2), (0, 3), (1, 3), (2, 3))))


def _entries_steps(one: RoundedMatrix) -> list[Step]:
    return [
        step(
            _("Angles"),
            _("Sine and cosine of each stand in the matrix; together they give the quadrant."),
            rf"\vartheta = \mathrm{{atan2}}(a_{{21}}, a_{{11}}) = {tex(one.theta, 'rad')}",
            rf"\alpha = \mathrm{{atan2}}(a_{{32}}, a_{{33}}) = {tex(one.alpha, 'rad')}",
        ),
        step(
            _("Lengths"),
            _("In the last column stand a cos ϑ, a sin ϑ and d."),
            rf"a = \sqrt{{a_{{14}}^2 + a_{{24}}^2}} = {tex(math.hypot(one.x, one.y), 'm')}",
            rf"d = a_{{34}} = {tex(one.d, 'm')}",
        ),
    ]


ENTRIES = Exercise(
    id="dh_tables.entries",
    title=marked("From the matrix to its row"),
    difficulty=2,
    draw=_draw_entries,
    text=lambda one: _(
        "A joint's transform A from frame i-1 to frame i, by a standard DH row, has these entries: first column "
        "({cosine_theta}, {sine_theta}, 0); third row 0, {sine_alpha}, {cosine_alpha}, {d}; position ({x}, {y}, {d}), "
        "in metres. Which a, α, d and ϑ has the row? The length a is positive."
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("a", "a", "m", within=0.002),
        angle("alpha", "α"),
        quantity("d", "d", "m", within=0.002),
        angle("theta", "ϑ"),
    ),
    solve=lambda one: {"a": math.hypot(one.x, one.y), "alpha": one.alpha, "d": one.d, "theta": one.theta},
    steps=_entries_steps,
    wrong={
        "quadrant": lambda one: {
            "theta": math.atan(one.sine_theta / one.cosine_theta),
            "alpha": math.atan(one.sine_alpha / one.cosine_alpha),
        },
        "alpha_sign": lambda one: {"alpha": -one.alpha},
        "projection_for_length": lambda one: {"a": one.x},
        "a_and_d_exchanged": lambda one: {"a": one.d, "d": math.hypot(one.x, one.y)},
        "angles_exchanged": lambda one: {"alpha": one.theta, "theta": one.alpha},
    },
    sketch=sketches.one_row,
)


class ElbowArm(NamedTuple):
    """An anthropomorphic arm: lengths in metres, joint angles in degrees."""

    height: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    upper: Annotated[float, Draw.decimal, 0.3, 0.7, 0.05]
    lower: Annotated[float, Draw.decimal, 0.2, 0.6, 0.05]
    q1: Annotated[float, Draw.signed, 10.0, 160.0, 5.0]
    q2: Annotated[float, Draw.signed, 10.0, 80.0, 5.0]
    q3: Annotated[float, Draw.signed, 20.0, 140.0, 5.0]

    @property
    def rows(self) -> Array:
        """The table at q = 0."""
        return np.array([[0, math.pi / 2, self.height, 0], [self.upper, 0, 0, 0], [self.lower, 0, 0, 0]])

    @property
    def angles(self) -> tuple[float, float, float]:
        """Joint angles, [rad]."""
        return math.radians(self.q1), math.radians(self.q2), math.radians(self.q3)

    def position(self, *, reverse: bool = False) -> Array:
        """Return the position of the tip; `reverse` multiplies in the wrong order."""
        table = table_of(self.rows, (False,) * 3)
        parts = [row.transform(q, "standard") for row, q in zip(table.joints, self.angles, strict=True)]
        return np.asarray(np.linalg.multi_dot(parts[::-1] if reverse else parts)[:3, 3])


def _arm_steps(arm: ElbowArm) -> list[Step]:
    _q1, q2, q3 = arm.angles
    r = arm.upper * math.cos(q2) + arm.lower * math.cos(q2 + q3)
    x, y, z = arm.position()
    return [
        step(
            _("In the arm's plane"),
            _("The second and third joint turn in a vertical plane: distance from the axis, and height."),
            rf"r = a_2 \cos q_2 + a_3 \cos(q_2 + q_3) = {tex(r, 'm')}",
            rf"p_z = d_1 + a_2 \sin q_2 + a_3 \sin(q_2 + q_3) = {tex(z, 'm')}",
        ),
        step(
            _("About the vertical"),
            _("The first joint turns that plane."),
            rf"p_x = r \cos q_1 = {tex(x, 'm')}",
            rf"p_y = r \sin q_1 = {tex(y, 'm')}",
        ),
        step(
            _("Direction of the last link"),
            _("In the plane it is inclined by the sum of both angles."),
            rf"q_2 + q_3 = {tex(math.remainder(q2 + q3, 2.0 * math.pi), 'rad')}",
        ),
    ]


FORWARD = Exercise(
    id="dh_tables.forward",
    title=marked("Forward kinematics of an anthropomorphic arm"),
    difficulty=2,
    draw=drawn(ElbowArm),
    is_degenerate=lambda arm: math.hypot(*arm.position()[:2]) < 0.2 or abs(arm.upper - arm.lower) < 0.05,
    text=lambda arm: _(
        "An anthropomorphic arm has the standard DH rows (a, α, d, ϑ): (0, 90°, {height:g} m, q1), ({upper:g} m, 0, 0, "
        "q2), ({lower:g} m, 0, 0, q3). Where is its tip, the origin of frame 3, at q1 = {q1:g}°, q2 = {q2:g}°, q3 = "
        "{q3:g}°? By which angle is the last link inclined against the horizontal plane, measured in the arm's plane?"
    ).format(**arm._asdict()),
    fields=lambda _arm: (
        vector("position", _("Position of the tip"), 3, "m", 2.0, within=0.002),
        angle("incline", _("Inclination")),
    ),
    solve=lambda arm: {"position": arm.position(), "incline": arm.angles[1] + arm.angles[2]},
    steps=_arm_steps,
    wrong={
        "absolute_angles": lambda arm: arm._replace(q3=arm.q3 - arm.q2),
        "lengths_exchanged": lambda arm: {"position": arm._replace(upper=arm.lower, lower=arm.upper).position()},
        "degrees_in_radians": lambda arm: {"position": misread(arm).position()},
        "product_reversed": lambda arm: {"position": arm.position(reverse=True)},
        "first_joint_still": lambda arm: {"position": arm._replace(q1=0.0).position()},
        "distance_forgotten": lambda arm: {"position": arm._replace(height=0.0).position()},
    },
    sketch=sketches.anthropomorphic,
)
