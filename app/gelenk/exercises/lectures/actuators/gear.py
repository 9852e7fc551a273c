"""A gear between motor and joint."""

import math
from typing import NamedTuple

from gelenk.course.actuators.gear import gear_steps, inertias, sides
from gelenk.course.steps import Step
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity
from gelenk.language import marked
from gelenk.language import translated as _


class GearTask(NamedTuple):
    """A gear between a motor and a load that turns and resists."""

    ratio: float
    efficiency: float
    load_speed: float
    load_torque: float
    motor_inertia: float
    load_inertia: float


def _draw_gear(draw: Draw) -> GearTask:
    return GearTask(
        draw.decimal(20.0, 150.0, 5.0),
        draw.decimal(0.6, 0.85, 0.05),
        draw.decimal(0.5, 4.0, 0.1),
        draw.decimal(10.0, 80.0, 1.0),
        draw.decimal(0.0001, 0.0006, 0.0001),
        draw.decimal(0.5, 4.0, 0.1),
    )


def _gear_text(task: GearTask) -> str:
    return _(
        "A motor drives a joint through a gear of ratio N = {ratio:g} and efficiency η = {efficiency:g}. The joint "
        "turns at {load_speed:g} rad/s against a torque of {load_torque:g} N m. The rotor has the inertia J_m = "
        "{motor_inertia:g} kg m², the load J_L = {load_inertia:g} kg m². What are speed and torque of the motor, the "
        "inertia that the motor feels, and the ratio with which a given torque would accelerate the load most?"
    ).format(**task._asdict())


def _gear_answers(task: GearTask) -> Answers:
    motor, _load, _flow = sides(task.ratio, task.efficiency, None, task.load_speed, None, task.load_torque)
    felt = inertias(task.ratio, task.motor_inertia, task.load_inertia)
    return {
        "speed": motor.angular_velocity,
        "torque": motor.torque,
        "inertia": felt.at_motor,
        "optimal": felt.optimal_ratio,
    }


def _gear_steps(task: GearTask) -> tuple[Step, ...]:
    felt = inertias(task.ratio, task.motor_inertia, task.load_inertia)
    found = sides(task.ratio, task.efficiency, None, task.load_speed, None, task.load_torque)
    return gear_steps(task.ratio, task.efficiency, *found, felt)


GEAR = Exercise(
    id="actuators.gear",
    title=marked("A gear between motor and joint"),
    difficulty=2,
    draw=_draw_gear,
    text=_gear_text,
    fields=lambda _task: (
        quantity("speed", _("Speed of the motor"), "rad/s"),
        quantity("torque", _("Torque of the motor"), "N m"),
        quantity("inertia", _("Inertia at the motor"), "kg m²"),
        quantity("optimal", _("Optimal ratio N*")),
    ),
    solve=_gear_answers,
    steps=_gear_steps,
    wrong={
        "ratio_inverted": lambda task: {
            "speed": task.load_speed / task.ratio,
            "torque": task.load_torque * task.ratio / task.efficiency,
        },
        "efficiency_forgotten": lambda task: {"torque": task.load_torque / task.ratio},
        "efficiency_inverted": lambda task: {"torque": task.load_torque * task.efficiency / task.ratio},
        "ratio_not_squared": lambda task: {"inertia": task.motor_inertia + task.load_inertia / task.ratio},
        "inertia_at_load": lambda task: {"inertia": task.ratio**2 * task.motor_inertia + task.load_inertia},
        "inertia_without_rotor": lambda task: {"inertia": task.load_inertia / task.ratio**2},
        "root_forgotten": lambda task: {"optimal": task.load_inertia / task.motor_inertia},
        "inertias_exchanged": lambda task: {"optimal": math.sqrt(task.motor_inertia / task.load_inertia)},
    },
)

EXERCISES = (GEAR,)
