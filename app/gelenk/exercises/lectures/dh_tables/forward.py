"""Forward kinematics of the anthropomorphic arm."""

import math
from typing import NamedTuple

import numpy as np

from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import NumberField, VectorField
from gelenk.exercises.table_field import table_of
from gelenk.language import marked
from gelenk.language import translated as _
from gelenk.robot.arrays import Array


class ElbowArm(NamedTuple):
    """An anthropomorphic arm: lengths in metres, joint angles in degrees."""

    height: float
    upper: float
    lower: float
    q1: float
    q2: float
    q3: float

    @property
    def rows(self) -> Array:
        """The table at q = 0."""
        return np.array([[0, math.pi / 2, self.height, 0], [self.upper, 0, 0, 0], [self.lower, 0, 0, 0]])

    @property
    def angles(self) -> tuple[float, float, float]:
        """Joint angles, [rad]."""
        return math.radians(self.q1), math.radians(self.q2), math.radians(self.q3)

    def position(self, *, degrees: bool = True, reverse: bool = False) -> Array:
        """Return the position of the tip; with mistakes: angles taken for radians, product in the wrong order."""
        angles = self.angles if degrees else (self.q1, self.q2, self.q3)
        table = table_of(self.rows, (False,) * 3)
        parts = [row.transform(q, "standard") for row, q in zip(table.joints, angles, strict=True)]
        return np.asarray(np.linalg.multi_dot(parts[::-1] if reverse else parts)[:3, 3])


def _draw_arm(draw: Draw) -> ElbowArm:
    lengths = (draw.decimal(0.2, 0.6, 0.05), draw.decimal(0.3, 0.7, 0.05), draw.decimal(0.2, 0.6, 0.05))
    return ElbowArm(
        *lengths, draw.signed(10.0, 160.0, 5.0), draw.signed(10.0, 80.0, 5.0), draw.signed(20.0, 140.0, 5.0)
    )


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
    draw=_draw_arm,
    is_degenerate=lambda arm: math.hypot(*arm.position()[:2]) < 0.2 or abs(arm.upper - arm.lower) < 0.05,
    text=lambda arm: _(
        "An anthropomorphic arm has the standard DH rows (a, α, d, ϑ): (0, 90°, {height:g} m, q1), ({upper:g} m, 0, 0, "
        "q2), ({lower:g} m, 0, 0, q3). Where is its tip, the origin of frame 3, at q1 = {q1:g}°, q2 = {q2:g}°, q3 = "
        "{q3:g}°? By which angle is the last link inclined against the horizontal plane, measured in the arm's plane?"
    ).format(**arm._asdict()),
    fields=lambda _arm: (
        VectorField(name="position", label=_("Position of the tip"), unit="m", tolerance=0.002, size=3, points=2.0),
        NumberField(name="incline", label=_("Inclination"), unit="rad", tolerance=0.005, is_angle=True),
    ),
    solve=lambda arm: {"position": arm.position(), "incline": arm.angles[1] + arm.angles[2]},
    steps=_arm_steps,
    wrong={
        "absolute_angles": lambda arm: {
            "position": arm._replace(q3=arm.q3 - arm.q2).position(),
            "incline": arm.angles[2],
        },
        "lengths_exchanged": lambda arm: {"position": arm._replace(upper=arm.lower, lower=arm.upper).position()},
        "degrees_in_radians": lambda arm: {"position": arm.position(degrees=False)},
        "product_reversed": lambda arm: {"position": arm.position(reverse=True)},
        "first_joint_still": lambda arm: {"position": arm._replace(q1=0.0).position()},
        "distance_forgotten": lambda arm: {"position": arm._replace(height=0.0).position()},
    },
)

EXERCISES = (FORWARD,)
