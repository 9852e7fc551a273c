"""A row of a table and its matrix, both ways."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import MatrixField, NumberField
from gelenk.language import marked
from gelenk.language import translated as _
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

    a: float
    alpha: float
    d: float
    theta: float

    def matrix(self, convention: Convention = "standard", degrees: bool = True) -> Array:
        """Return A; with `degrees` False the angles are taken for radians."""
        alpha, theta = (math.radians(angle) if degrees else angle for angle in (self.alpha, self.theta))
        return DhJoint("", "revolute", self.a, alpha, self.d, theta).transform(0.0, convention)


def _draw_row(draw: Draw) -> MatrixRow:
    return MatrixRow(
        draw.decimal(0.1, 0.8, 0.05),
        draw.signed(15.0, 165.0, 15.0),
        draw.decimal(0.1, 0.8, 0.05),
        draw.signed(15.0, 165.0, 15.0),
    )


def _is_too_plain(row: MatrixRow) -> bool:
    return bool(90.0 in {abs(row.alpha), abs(row.theta)} or row.a == row.d or abs(row.alpha) == abs(row.theta))


def typeset(matrix: Array) -> str:
    """Return a matrix in LaTeX, rounded to six decimals."""
    rows = (" & ".join(tex(round(float(entry), 6) + 0.0) for entry in row) for row in matrix)
    return r"\begin{bmatrix} " + r" \\ ".join(rows) + r" \end{bmatrix}"


def _matrix_steps(row: MatrixRow) -> list[Step]:
    return [
        step(
            _("The matrix of a row"),
            _("Turn about z by ϑ, move along z by d, move along the new x by a, turn about it by α."),
            _FORM,
        ),
        step(_("With the numbers"), _("The angles are in degrees here."), rf"A^{{i-1}}_i = {typeset(row.matrix())}"),
    ]


MATRIX = Exercise(
    id="dh_tables.matrix",
    title=marked("From a row to its matrix"),
    difficulty=1,
    draw=_draw_row,
    is_degenerate=_is_too_plain,
    text=lambda row: _(
        "A row of a standard DH table has a = {a:g} m, α = {alpha:g}°, d = {d:g} m and, at the present position of the "
        "joint, ϑ = {theta:g}°. What is the homogeneous transform from frame i-1 to frame i, A = Rz(ϑ) Tz(d) Tx(a) "
        "Rx(α)?"
    ).format(**row._asdict()),
    fields=lambda _row: (
        MatrixField(name="matrix", label=_("Transform A"), tolerance=0.002, rows=4, columns=4, points=2.0),
    ),
    solve=lambda row: {"matrix": row.matrix()},
    steps=_matrix_steps,
    wrong={
        "alpha_sign": lambda row: {"matrix": row._replace(alpha=-row.alpha).matrix()},
        "a_and_d_exchanged": lambda row: {"matrix": row._replace(a=row.d, d=row.a).matrix()},
        "angles_exchanged": lambda row: {"matrix": row._replace(alpha=row.theta, theta=row.alpha).matrix()},
        "craig_product": lambda row: {"matrix": row.matrix("modified")},
        "degrees_in_radians": lambda row: {"matrix": row.matrix(degrees=False)},
        "inverse_transform": lambda row: {"matrix": np.linalg.inv(row.matrix())},
        "distance_forgotten": lambda row: {"matrix": row._replace(a=0.0, d=0.0).matrix()},
    },
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
    row = _draw_row(draw)
    while _is_too_plain(row):
        row = _draw_row(draw)
    A = np.round(row.matrix(), 4)
    return RoundedMatrix(*(float(A[i, j]) + 0.0 for i, j in ((0, 0), (1, 0), (2, 1), (2, 2), (0, 3), (1, 3), (2, 3))))


def _entries_text(one: RoundedMatrix) -> str:
    return _(
        "A joint's transform A from frame i-1 to frame i, by a standard DH row, has these entries: first column "
        "({cosine_theta}, {sine_theta}, 0); third row 0, {sine_alpha}, {cosine_alpha}, {d}; position ({x}, {y}, {d}), "
        "in metres. Which a, α, d and ϑ has the row? The length a is positive."
    ).format(**one._asdict())


def _entries_answers(one: RoundedMatrix) -> Answers:
    return {"a": math.hypot(one.x, one.y), "alpha": one.alpha, "d": one.d, "theta": one.theta}


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


def _angle(name: str, label: str) -> NumberField:
    return NumberField(name=name, label=label, unit="rad", tolerance=0.005, is_angle=True)


def _length(name: str, label: str) -> NumberField:
    return NumberField(name=name, label=label, unit="m", tolerance=0.002)


ENTRIES = Exercise(
    id="dh_tables.entries",
    title=marked("From the matrix to its row"),
    difficulty=2,
    draw=_draw_entries,
    text=_entries_text,
    fields=lambda _one: (_length("a", "a"), _angle("alpha", "α"), _length("d", "d"), _angle("theta", "ϑ")),
    solve=_entries_answers,
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
)

EXERCISES = (MATRIX, ENTRIES)
