"""An encoder behind a gear."""

import math
from typing import NamedTuple

from gelenk.course.actuators.encoders import resolution, resolution_steps
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, whole
from gelenk.language import marked
from gelenk.language import translated as _


class EncoderTask(NamedTuple):
    """An incremental encoder with quadrature on the motor of a geared joint."""

    lines: int
    ratio: float
    milliseconds: float

    @property
    def counts(self) -> int:
        """Counts per turn of the motor."""
        return 4 * self.lines


def _encoder_text(task: EncoderTask) -> str:
    return _(
        "An incremental encoder of {lines} lines is on the motor shaft of a joint; its two channels are decoded with "
        "quadrature (x4). The gear ratio is N = {ratio:g}. The counter is read every {milliseconds:g} ms. How many "
        "counts has a turn of the motor, which angle is a count at the motor and at the joint, and which step of the "
        "joint's speed is one count in a period?"
    ).format(**task._asdict())


def _encoder_with(task: EncoderTask, counts: float) -> Answers:
    motor = 2.0 * math.pi / counts
    joint = motor / task.ratio
    return {"counts": counts, "motor": motor, "joint": joint, "quantum": joint / (1e-3 * task.milliseconds)}


def _encoder_answers(task: EncoderTask) -> Answers:
    found = resolution(task.counts, task.ratio, 1e-3 * task.milliseconds)
    return {"counts": task.counts, "motor": found.motor, "joint": found.load, "quantum": found.load_velocity_quantum}


def _encoder_steps(task: EncoderTask) -> tuple[Step, ...]:
    found = resolution(task.counts, task.ratio, 1e-3 * task.milliseconds)
    at_joint = step(
        _("At the joint"),
        _("Behind the gear both are smaller by its ratio."),
        rf"\Delta\varphi_L = {tex(found.load, 'rad')}",
        rf"\Delta\omega_L = {tex(found.load_velocity_quantum or 0.0, 'rad/s')}",
    )
    how = rf"4 \cdot {task.lines}"
    return (*resolution_steps(task.counts, task.ratio, how, 1e-3 * task.milliseconds), at_joint)


ENCODER = Exercise(
    id="actuators.encoder",
    title=marked("An encoder behind a gear"),
    difficulty=2,
    draw=lambda draw: EncoderTask(
        draw.choice((256, 360, 500, 512, 1000, 1024, 2000)), draw.decimal(20.0, 160.0, 5.0), draw.decimal(1.0, 5.0, 1.0)
    ),
    text=_encoder_text,
    fields=lambda _task: (
        whole("counts", _("Counts of a turn")),
        quantity("motor", _("Angle of a count at the motor"), "rad"),
        quantity("joint", _("Angle of a count at the joint"), "rad"),
        quantity("quantum", _("Step of the joint's speed"), "rad/s"),
    ),
    solve=_encoder_answers,
    steps=_encoder_steps,
    wrong={
        "quadrature_forgotten": lambda task: _encoder_with(task, task.lines),
        "quadrature_halved": lambda task: _encoder_with(task, 2 * task.lines),
        "gear_forgotten": lambda task: {
            "joint": 2.0 * math.pi / task.counts,
            "quantum": 2e3 * math.pi / task.counts / task.milliseconds,
        },
        "gear_multiplied": lambda task: {"joint": 2.0 * math.pi / task.counts * task.ratio},
        "period_multiplied": lambda task: {
            "quantum": 2.0 * math.pi / task.counts / task.ratio * 1e-3 * task.milliseconds
        },
    },
)

EXERCISES = (ENCODER,)
