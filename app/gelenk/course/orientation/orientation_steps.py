"""The worked solution of an orientation: from what is given to R, frames composed, and R in every notation."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from gelenk.course.orientation.orientation import Notations, Triple
from gelenk.course.orientation.rotations import About, Composition, Validation
from gelenk.course.steps import Step, bmatrix, step
from gelenk.course.writing import atan2, matrix, number, vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_Term: TypeAlias = tuple[int, tuple[str, ...]]
"""A sign, and the factors of a product."""
_Entry: TypeAlias = list[_Term]
_Matrix: TypeAlias = list[list[_Entry]]


@lru_cache(maxsize=64)
def product(turns: tuple[tuple[str, str], ...]) -> str:
    r"""Return the matrix of rotations about coordinate axes, given as (axis, LaTeX of the angle), as a `bmatrix`."""
    rows: _Matrix = [[[(1, ())] if i == j else [] for j in range(3)] for i in range(3)]
    for axis, angle in turns:
        rows = _times(rows, _elementary(axis, angle))
    return bmatrix(map(_written, row) for row in rows)


def _elementary(axis: str, angle: str) -> _Matrix:
    """Return Rx, Ry or Rz; the minus sign stands above, but for y below."""
    k = "xyz".index(axis)
    i, j = (k + 1) % 3, (k + 2) % 3
    rows: _Matrix = [[[] for _ in range(3)] for _ in range(3)]
    rows[k][k] = [(1, ())]
    rows[i][i] = rows[j][j] = [(1, (f"c_{{{angle}}}",))]
    rows[j][i], rows[i][j] = [(1, (f"s_{{{angle}}}",))], [(-1, (f"s_{{{angle}}}",))]
    return rows


def _times(left: _Matrix, right: _Matrix) -> _Matrix:
    return [
        [
            [(s * t, p + q) for k in range(3) for s, p in left[i][k] for t, q in right[k][j]]
            for j in range(3)
        ]
        for i in range(3)
    ]  # fmt: skip


def _written(entry: _Entry) -> str:
    text = ""
    for sign, factors in entry:
        joined = " ".join(factors) or "1"
        text += f" {'-' if sign < 0 else '+'} {joined}" if text else f"{'-' if sign < 0 else ''}{joined}"
    return text or "0"


_SHOWN_POINTS = 3
_ZYZ = (("z", r"\varphi"), ("y", r"\vartheta"), ("z", r"\psi"))
_RPY = (("z", r"\psi"), ("y", r"\vartheta"), ("x", r"\phi"))
_NAMES = {"zyz": _ZYZ, "rpy": _RPY}


@dataclass(frozen=True, slots=True)
class GivenMotion:
    """A motion as it was given.

    Attributes:
        notation: Name of the field.
        numbers: Its numbers: angles [rad]; of an axis and angle the unit axis and then the angle.
        axis: Of an elementary rotation, else "".
        transform: What it is; shape (4, 4).
        about: The axes it is expressed in.
        validation: Of a matrix; None for another notation.
    """

    notation: str
    numbers: Array
    axis: str
    transform: Array
    about: About = "moving"
    validation: Validation | None = None


def orientation_steps(given: Sequence[GivenMotion], path: Composition, found: Notations) -> list[Step]:
    """Return the steps for motions, their composition and the notations of the last frame."""
    steps = [given_step(one, index, len(given)) for index, one in enumerate(given, start=1)]
    steps += [_validated(one.validation, one.transform) for one in given if one.validation is not None]
    if len(given) > 1:
        steps.append(composition_step(given, path))
    steps += [zyz_step(found), rpy_step(found), axis_angle_step(found), quaternion_step(found), inverse_step(path)]
    if len(path.points):
        steps.append(points_step(path, given))
    return steps


def given_step(one: GivenMotion, index: int, count: int) -> Step:
    """Return the step from what is given of a motion, the `index`-th of `count` from 1, to its matrix."""
    name = "R" if count == 1 else f"R_{{{index}}}"
    R, values = one.transform[:3, :3], one.numbers.tolist()
    if one.notation in _NAMES:
        turns = _NAMES[one.notation]
        ordered = values if one.notation == "zyz" else values[::-1]
        angles = r", \quad ".join(f"{symbol} = {number(x)}" for (_axis, symbol), x in zip(turns, ordered, strict=True))
        rule = " ".join(f"R_{axis}({symbol})" for axis, symbol in turns)
        text = _("Three elementary rotations about moving axes, multiplied from the left to the right.")
        if one.notation == "rpy":
            text = _("Roll, pitch and yaw about the fixed axes x, y and z: each later one is multiplied from the left.")
        lines = [angles, f"{name} = {rule} = {product(turns)}"]
    elif one.notation == "elementary":
        text = _("A rotation about a coordinate axis, counter-clockwise; only about y the minus sign is below.")
        lines = [
            f"{name} = R_{one.axis}(" + r"\vartheta) = " + product(((one.axis, r"\vartheta"),)),
            rf"\vartheta = {number(values[0])}",
        ]
    elif one.notation in {"axis_angle", "rotation_vector"}:
        text = _("Rodrigues' formula, with a unit axis r and the matrix of its cross product.")
        axis, angle = (one.numbers[:3], values[3]) if len(values) == 4 else _split(one.numbers)
        lines = [rf"r = {vector(axis)}, \quad \vartheta = {number(angle)}",
                 rf"{name} = I + \sin\vartheta\, [r]_{{\times}} + (1 - \cos\vartheta)\, [r]_{{\times}}^2"]  # fmt: skip
    elif one.notation == "rotation":
        return step(
            _("Rotation matrix"),
            _("The columns are the axes of the turned frame."),
            f"{name} = {matrix(one.numbers.reshape(3, 3))}",
        )
    else:
        text = _("A unit quaternion: w = cos(ϑ/2), and x, y, z are sin(ϑ/2) times the axis.")
        x, y, z, w = values if one.notation == "quaternion_xyzw" else (*values[1:], values[0])
        entries = bmatrix(
            (
                ("1 - 2(y^2 + z^2)", "2(x y - z w)", "2(x z + y w)"),
                ("2(x y + z w)", "1 - 2(x^2 + z^2)", "2(y z - x w)"),
                ("2(x z - y w)", "2(y z + x w)", "1 - 2(x^2 + y^2)"),
            )
        )
        lines = [f"(w, x, y, z) = {vector((w, x, y, z))}", f"{name} = {entries}"]
    return step(_("Rotation matrix"), text, *lines, f"{name} = {matrix(R)}")


def _split(turn: Array) -> tuple[Array, float]:
    angle = math.hypot(*turn.tolist())
    return (turn / angle if angle > 0.0 else turn), angle


def _validated(found: Validation, T: Array) -> Step:
    text = _("A rotation has columns of length 1 at right angles, RᵀR = I, and det R = +1; -1 would be a reflection.")
    error, determinant = number(found.orthogonality_error), number(found.determinant)
    lines = [rf"\lVert R^T R - I \rVert = {error}, \quad \det R = {determinant}"]
    if found.projected:
        text += " " + _("This one is not: the nearest rotation is taken, by the singular value decomposition.")
        lines.append(r"R = U \Sigma\, V^T \to U\, \mathrm{diag}(1,\; 1,\; \det U V^T)\, V^T = " + matrix(T[:3, :3]))
        lines.append(rf"\mathrm{{distance}} = {number(found.distance)}")
    return step(_("Is it a rotation?"), text, *lines)


def composition_step(given: Sequence[GivenMotion], path: Composition) -> Step:
    """Return the step that multiplies in order; in symbols where all rotations are elementary, and few."""
    order = [1]
    for index, one in enumerate(given[1:], start=2):
        order = [*order, index] if one.about == "moving" else [index, *order]
    n, factors = len(given), " ".join(f"R_{{{k}}}" for k in order)
    lines = [rf"R^{{0}}_{{{n}}} = {factors}"]
    if all(one.about == "moving" for one in given):
        lines[0] += " = " + " ".join(rf"R^{{{k - 1}}}_{{{k}}}" for k in range(1, n + 1))
    chosen = [given[k - 1] for k in order]
    if n <= 3 and all(one.notation == "elementary" for one in chosen):
        turns = tuple((one.axis, str(k)) for k, one in zip(order, chosen, strict=True))
        lines.append(rf"R^{{0}}_{{{n}}} = {product(turns)}")
        values = r", \quad ".join(rf"\vartheta_{{{k}}} = {number(float(given[k - 1].numbers[0]))}" for k in order)
        lines.append(values)
    last = path.transforms[-1]
    lines.append(rf"R^{{0}}_{{{n}}} = {matrix(last[:3, :3])}")
    if np.abs(last[:3, 3]).max() > 0.0:
        lines.append(rf"p^{{0}}_{{{n}}} = {vector(last[:3, 3])}")
    text = _("A motion about the moved axes is multiplied from the right, one about the fixed axes from the left.")
    return step(_("Composition of frames"), text, *lines)


def zyz_step(found: Notations) -> Step:
    """Return the step that finds the ZYZ angles of R."""
    lines = [
        rf"R_z(\varphi)\, R_y(\vartheta)\, R_z(\psi) = {product(_ZYZ)}",
        r"\vartheta = " + atan2(r"\pm\sqrt{r_{13}^2 + r_{23}^2}", "r_{33}"),
        r"\varphi = " + atan2(r"\pm r_{23}", r"\pm r_{13}") + r", \quad \psi = " + atan2(r"\pm r_{32}", r"\mp r_{31}"),
    ]
    text = _("ϑ and φ follow from the last column, ψ from the last row. Both signs of the root are right.")
    if found.zyz.degeneracy is not None:
        text = _("The last column is ±z, so that sin ϑ = 0: only φ + ψ at ϑ = 0, or φ - ψ at ϑ = π, is known.")
        plus = found.rotation[2, 2] > 0.0
        rule = atan2("r_{21}", "r_{11}") if plus else atan2("-r_{21}", "-r_{11}")
        lines.append(rf"\varphi {'+' if plus else '-'} \psi = {rule} = {number(found.zyz.degeneracy.value or 0.0)}")
    return step(_("ZYZ angles"), text, *lines, *_branches(found.zyz, r"(\varphi,\; \vartheta,\; \psi)"))


def rpy_step(found: Notations) -> Step:
    """Return the step that finds roll, pitch and yaw of R."""
    lines = [
        rf"R_z(\psi)\, R_y(\vartheta)\, R_x(\phi) = {product(_RPY)}",
        r"\vartheta = " + atan2("-r_{31}", r"\pm\sqrt{r_{11}^2 + r_{21}^2}"),
        r"\psi = " + atan2(r"\pm r_{21}", r"\pm r_{11}") + r", \quad \phi = " + atan2(r"\pm r_{32}", r"\pm r_{33}"),
    ]
    text = _("Pitch follows from the first column, yaw from the same, roll from the last row. Both signs are right.")
    if found.rpy.degeneracy is not None:
        text = _("The first column is ±z: cos(pitch) = 0, and only yaw - roll at π/2 or yaw + roll at -π/2 is known.")
        minus = found.rotation[2, 0] < 0.0
        rule = atan2("-r_{12}", "r_{22}")
        lines.append(rf"\psi {'-' if minus else '+'} \phi = {rule} = {number(found.rpy.degeneracy.value or 0.0)}")
    return step(_("Roll, pitch, yaw"), text, *lines, *_branches(found.rpy, r"(\phi,\; \vartheta,\; \psi)"))


def _branches(triple: Triple, names: str) -> list[str]:
    return [f"{names} = {vector(angles)}" for angles in triple.solutions]


def axis_angle_step(found: Notations) -> Step:
    """Return the step that finds axis and angle of R."""
    R, turn = found.rotation, found.axis_angle
    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    trace = float(np.trace(R))
    lines = [
        rf"v = (r_{{32}} - r_{{23}},\; r_{{13}} - r_{{31}},\; r_{{21}} - r_{{12}}) = {vector(v)}",
        r"\vartheta = " + atan2(r"\frac{\lVert v \rVert}{2}", r"\frac{\mathrm{tr} R - 1}{2}")
        + f" = {atan2(number(0.5 * float(np.linalg.norm(v))), number(0.5 * (trace - 1.0)))} = {number(turn.angle)}",
    ]  # fmt: skip
    if not turn.axes:
        text = _("Nothing turns: at angle 0 every axis is right, so that there is none.")
    elif len(turn.axes) == 2:
        text = _("Half a turn: v = 0, and the axis comes from the diagonal, up to its sign.")
        lines.append(r"r_i = \pm\sqrt{\frac{r_{ii} + 1}{2}}, \quad r_i r_j = \frac{r_{ij}}{2} \quad (i \ne j)")
        lines += [f"r = {vector(axis)}" for axis in turn.axes]
    else:
        text = _("The antisymmetric part of R is along the axis, as long as 2 sin ϑ; the trace is 1 + 2 cos ϑ.")
        lines.append(rf"r = \frac{{v}}{{\lVert v \rVert}} = {vector(turn.axes[0])}")
    return step(_("Axis and angle"), text, *lines)


def quaternion_step(found: Notations) -> Step:
    """Return the step from axis and angle to the quaternion of R."""
    x, y, z, w = found.quaternion_xyzw
    text = _("Half of the angle: cos(ϑ/2), and sin(ϑ/2) times the axis. The negative one is the same rotation.")
    lines = [r"q = \left(\cos\frac{\vartheta}{2},\; r \sin\frac{\vartheta}{2}\right)"]
    return step(_("Quaternion"), text, *lines, f"(w, x, y, z) = {vector((w, x, y, z))}")


def inverse_step(path: Composition) -> Step:
    """Return the step that inverts the last transform."""
    T = path.inverse
    rule = r"T^{-1} = \begin{bmatrix} R^T & -R^T p \\ 0 & 1 \end{bmatrix}"
    text = _("The inverse of a rotation is its transpose, and the origin goes back: no matrix has to be inverted.")
    return step(_("Inverse"), text, rule, f"R^T = {matrix(T[:3, :3])}", f"-R^T p = {vector(T[:3, 3])}")


def points_step(path: Composition, given: Sequence[GivenMotion]) -> Step:
    """Return the step that expresses points in the frame that stays."""
    n = len(given)
    lines = [rf"p_0 = R^{{0}}_{{{n}}}\, p_{{{n}}} + p^{{0}}_{{{n}}}"]
    lines += [f"p_0 = {vector(point)}" for point in path.points[:_SHOWN_POINTS]]
    return step(_("Points"), _("Coordinates in the last frame become those in the frame that stays."), *lines)
