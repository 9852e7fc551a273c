"""Pulse width modulation."""

from typing import NamedTuple

from gelenk.course.actuators.pwm import Pulses, approximate_ripple, pwm_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Exercise
from gelenk.exercises.fields import quantity
from gelenk.language import marked
from gelenk.language import translated as _


class PulseTask(NamedTuple):
    """A switched supply at a winding."""

    supply: float
    voltage: float
    kilohertz: float
    millihenry: float

    @property
    def pulses(self) -> Pulses:
        """The pulses with the wanted average."""
        return Pulses(self.supply, self.voltage / self.supply, 1e3 * self.kilohertz)

    @property
    def inductance(self) -> float:
        """L in H."""
        return 1e-3 * self.millihenry


def _draw_pulses(draw: Draw) -> PulseTask:
    supply = draw.choice((12.0, 24.0, 36.0, 48.0))
    return PulseTask(
        supply, draw.decimal(2.0, supply - 1.0, 0.5), draw.decimal(5.0, 30.0, 5.0), draw.decimal(0.5, 4.0, 0.5)
    )


def _pulses_text(task: PulseTask) -> str:
    return _(
        "A supply of {supply:g} V is switched at {kilohertz:g} kHz, so that a motor sees {voltage:g} V on average. Its "
        "winding has L = {millihenry:g} mH; its resistance may be neglected. What are the duty D, the root mean square "
        "of the voltage, the duration of a pulse, and the ripple of the current from peak to peak?"
    ).format(**task._asdict())


PULSES = Exercise(
    id="actuators.pwm",
    title=marked("Pulse width modulation"),
    difficulty=2,
    draw=_draw_pulses,
    is_degenerate=lambda task: not 0.15 <= task.voltage / task.supply <= 0.8,
    text=_pulses_text,
    fields=lambda _task: (
        quantity("duty", _("Duty D")),
        quantity("rms", _("Root mean square of the voltage"), "V"),
        quantity("on_time", _("Duration of a pulse"), "s"),
        quantity("ripple", _("Ripple of the current"), "A", 2.0),
    ),
    solve=lambda task: {
        "duty": task.pulses.duty,
        "rms": task.pulses.rms_voltage,
        "on_time": task.pulses.on_time,
        "ripple": approximate_ripple(task.pulses, task.inductance),
    },
    steps=lambda task: pwm_steps(task.pulses, task.inductance, None),
    wrong={
        "duty_of_pause": lambda task: {"duty": 1.0 - task.pulses.duty, "on_time": task.pulses.off_time},
        "ratio_upside_down": lambda task: {"duty": task.supply / task.voltage},
        "mean_for_rms": lambda task: {"rms": task.voltage},
        "duty_for_rms": lambda task: {"rms": task.pulses.duty**2 * task.supply},
        "frequency_forgotten": lambda task: {"on_time": task.pulses.duty},
        "whole_period": lambda task: {"on_time": 1e-3 / task.kilohertz},
        "ripple_without_pause": lambda task: {"ripple": task.voltage * 1e-3 / task.kilohertz / task.inductance},
        "ripple_of_pause": lambda task: {"ripple": task.supply * task.pulses.off_time / task.inductance},
    },
)

EXERCISES = (PULSES,)
