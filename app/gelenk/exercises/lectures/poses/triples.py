"""ZYZ angles, roll, pitch and yaw, and what is left of ZYZ angles where they degenerate."""

import math
from collections.abc import Iterable
from typing import Annotated, Literal, NamedTuple

import numpy as np

from gelenk.course.orientation.orientation import Notations, notations
from gelenk.course.orientation.orientation_steps import GivenMotion, given_step, rpy_step, zyz_step
from gelenk.course.orientation.rotations import elementary
from gelenk.course.steps import Step, step
from gelenk.course.writing import number
from gelenk.exercises.draw import Draw, RationalRotation, drawn, drawn_rotation
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, angle, angles, solution_set
from gelenk.exercises.lectures.poses.frames import AXES, rotation_field
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.poses import transform


def zyz_solutions(R: Array) -> list[tuple[float, float, float]]:
    """Return both ZYZ triples of a rotation."""
    return list(notations(R).zyz.solutions)


def without_quadrant(R: Array) -> list[tuple[float, float, float]]:
    """Return the ZYZ triples that the tangents alone give."""
    phi, theta, psi = math.atan(R[1, 2] / R[0, 2]), math.acos(R[2, 2]), math.atan(-R[2, 1] / R[2, 0])
    return [(phi, theta, psi), (phi + math.pi, -theta, psi + math.pi)]


def flipped_without_last(R: Array) -> list[tuple[float, float, float]]:
    """Return the ZYZ triples with half a turn of the last angle forgotten in the second one."""
    (phi, theta, psi), _second = zyz_solutions(R)
    return [(phi, theta, psi), (phi + math.pi, -theta, psi)]


def is_plain(R: Array) -> bool:
    """Check whether a rotation is too near to a case where a notation degenerates, or is nearly symmetric."""
    found = notations(R)
    v = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    return min(found.zyz.conditioning, found.rpy.conditioning, 0.5 * float(np.linalg.norm(v))) < 0.2


def given_matrix(R: Array) -> Step:
    """Return the step that writes the matrix."""
    return given_step(GivenMotion("rotation", R, "", transform(np.zeros(3), R)), 1, 1)


ZYZ = Exercise(
    id="poses.zyz",
    title=marked("ZYZ angles of a rotation matrix"),
    difficulty=2,
    draw=drawn_rotation,
    is_degenerate=lambda one: is_plain(one.matrix) or any(0 in row for row in one.rows),
    text=lambda one: _(
        "A rotation matrix is R = {matrix}, its rows separated by semicolons. Which ZYZ angles (φ, ϑ, ψ) with R = "
        "Rz(φ) Ry(ϑ) Rz(ψ) does it have? Give all solutions with angles between -π and π."
    ).format(matrix=one.text),
    fields=lambda _one: (solution_set(angles("angles", _("All (φ, ϑ, ψ)"), 3), 2.0),),
    solve=lambda one: {"angles": zyz_solutions(one.matrix)},
    steps=lambda one: [given_matrix(one.matrix), zyz_step(notations(one.matrix))],
    wrong={
        "quadrant": lambda one: {"angles": without_quadrant(one.matrix)},
        "rows_for_columns": lambda one: {"angles": zyz_solutions(one.matrix.T)},
        "rpy_for_zyz": lambda one: {"angles": list(notations(one.matrix).rpy.solutions)},
        "flip_incomplete": lambda one: {"angles": flipped_without_last(one.matrix)},
    },
)


# Roll, pitch and yaw


class RollPitchYaw(NamedTuple):
    """Angles about the fixed axes x, y and z, in degrees."""

    roll: Annotated[float, Draw.signed, 20.0, 150.0, 5.0]
    pitch: Annotated[float, Draw.signed, 15.0, 70.0, 5.0]
    yaw: Annotated[float, Draw.signed, 20.0, 150.0, 5.0]

    @property
    def radians(self) -> Array:
        """The same in radians; shape (3,)."""
        return np.radians(self)

    @property
    def rotation(self) -> Array:
        """R = Rz(yaw) Ry(pitch) Rx(roll); shape (3, 3)."""
        return rpy_rotation(self.radians)


def rpy_rotation(angles: Iterable[float], *, reverse: bool = False) -> Array:
    """Return the rotation of roll, pitch and yaw [rad]; `reverse` takes them about moving axes, which is wrong."""
    factors = [elementary(axis, angle) for axis, angle in zip(AXES, angles, strict=True)]
    return np.asarray(np.linalg.multi_dot(factors if reverse else factors[::-1]))


def rpy_motion(angles: Array, position: Array | None = None) -> GivenMotion:
    """Return roll, pitch and yaw [rad], with a position [m], as the steps need them."""
    origin = np.zeros(3) if position is None else position
    return GivenMotion("rpy", angles, "", transform(origin, rpy_rotation(angles)))


def _other_rpy(one: RollPitchYaw) -> tuple[float, float, float]:
    """Return the solution that was not given."""
    found = notations(one.rotation).rpy.solutions
    return max(found, key=lambda angles: float(np.abs(np.sin(0.5 * (np.array(angles) - one.radians))).max()))


def _flipped(one: RollPitchYaw, *signs: float) -> Answers:
    roll, pitch, yaw = one.radians
    return {"other": [roll + signs[0] * math.pi, signs[1] * math.pi - pitch, yaw + signs[2] * math.pi]}


RPY = Exercise(
    id="poses.rpy",
    title=marked("Roll, pitch and yaw"),
    difficulty=2,
    draw=drawn(RollPitchYaw),
    is_degenerate=lambda one: abs(one.roll) == abs(one.yaw),
    text=lambda one: _(
        "A body is turned about the fixed axes: first by {roll:g}° about x (roll), then by {pitch:g}° about y (pitch), "
        "then by {yaw:g}° about z (yaw). Which rotation matrix does it have? Which other triple (roll, pitch, yaw) "
        "with angles between -π and π gives the same matrix?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        rotation_field("rotation", _("Rotation matrix R"), 2.0),
        angles("other", _("The other (roll, pitch, yaw)"), 3),
    ),
    solve=lambda one: {"rotation": one.rotation, "other": _other_rpy(one)},
    steps=lambda one: [given_step(rpy_motion(one.radians), 1, 1), rpy_step(notations(one.rotation))],
    wrong={
        "moving_for_fixed": lambda one: {"rotation": rpy_rotation(one.radians, reverse=True)},
        "roll_and_yaw_exchanged": lambda one: {"rotation": one._replace(roll=one.yaw, yaw=one.roll).rotation},
        "degrees_in_radians": lambda one: {"rotation": rpy_rotation(one)},
        "zyz_for_rpy": lambda one: _flipped(one, 1.0, 0.0, 1.0),
        "flip_incomplete": lambda one: _flipped(one, 0.0, 1.0, 0.0),
    },
)


# Degenerate ZYZ angles


class FlatRotation(NamedTuple):
    """A rotation with sin ϑ = 0, and ψ in degrees."""

    rotation: RationalRotation
    psi: float

    @property
    def sign(self) -> int:
        """Whether φ + ψ is determined, 1, or φ - ψ, -1."""
        return 1 if self.rotation.rows[2][2] > 0 else -1

    def answers(self, sign: int, value: float) -> Answers:
        """Return the answers if φ + `sign` ψ is determined."""
        known: Literal["sum", "difference"] = "sum" if sign > 0 else "difference"
        return {"known": known, "value": value, "phi": value - sign * math.radians(self.psi)}

    def rule(self, sign: int) -> Answers:
        """Return the answers by the rule for one of the two cases."""
        (a, _b, _c), (d, _e, _f), _last = self.rotation.rows
        return self.answers(sign, math.atan2(sign * d, sign * a))


_LEGS = ((3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29))


def _draw_flat(draw: Draw) -> FlatRotation:
    *legs, size = draw.choice(_LEGS)
    a, b = draw.sample(legs, 2)
    a, b, h = a * draw.choice((-1, 1)), b * draw.choice((-1, 1)), draw.choice((-1, 1))
    rows = ((h * a, -b, 0), (h * b, a, 0), (0, 0, h * size))
    return FlatRotation(RationalRotation(rows, size), draw.signed(10.0, 80.0, 5.0))


def _flat_answers(one: FlatRotation) -> Answers:
    degeneracy = notations(one.rotation.matrix).zyz.degeneracy
    if degeneracy is None or degeneracy.value is None:
        raise ValueError("sin ϑ is 0")
    sign = 1 if degeneracy.determined == "phi + psi" else -1
    return {"theta": 0.0 if sign > 0 else math.pi, **one.answers(sign, degeneracy.value)}


def _flat_steps(one: FlatRotation) -> list[Step]:
    found: Notations = notations(one.rotation.matrix)
    phi = number(float(_flat_answers(one)["phi"]))
    lines = [rf"\psi = {number(math.radians(one.psi))}", rf"\varphi = {phi}"]
    text = _("One of the two angles can be chosen; the other one follows.")
    return [given_matrix(one.rotation.matrix), zyz_step(found), step(_("The other angle"), text, *lines)]


def _flat_quadrant(one: FlatRotation) -> Answers:
    (a, _b, _c), (d, _e, _f), _last = one.rotation.rows
    found = one.answers(one.sign, math.atan(d / a))
    return {"value": found["value"], "phi": found["phi"]}


DEGENERATE = Exercise(
    id="poses.degenerate",
    title=marked("ZYZ angles that are not unique"),
    difficulty=3,
    draw=_draw_flat,
    text=lambda one: _(
        "A rotation matrix is R = {matrix}, its rows separated by semicolons. Its ZYZ angles with R = Rz(φ) Ry(ϑ) "
        "Rz(ψ) and ϑ between 0 and π are not unique. What is ϑ? Is the sum φ + ψ or the difference φ - ψ determined, "
        "and which value has it? What is φ if ψ = {psi:g}° is chosen?"
    ).format(matrix=one.rotation.text, psi=one.psi),
    fields=lambda _one: (
        angle("theta", "ϑ"),
        ChoiceField(
            name="known",
            label=_("What is determined?"),
            options={"sum": _("the sum φ + ψ"), "difference": _("the difference φ - ψ")},
        ),
        angle("value", _("Its value")),
        angle("phi", _("φ for this ψ")),
    ),
    solve=_flat_answers,
    steps=_flat_steps,
    wrong={
        "sum_and_difference": lambda one: {
            "theta": math.pi if one.sign > 0 else 0.0,
            **one.rule(-one.sign),
        },
        "quadrant": _flat_quadrant,
        "psi_added": lambda one: {"phi": one._replace(psi=-one.psi).rule(one.sign)["phi"]},
    },
)
