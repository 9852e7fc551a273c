"""Pulse width modulation: averages of a switched voltage, and the ripple that it causes in a motor's current.

The voltage is V_s for the time D/f, then zero for (1 - D)/f, while a second switch lets the current continue in either
direction. A negative average needs an H-bridge: the same pulses with the supply reversed.
"""

import math
from dataclasses import dataclass

from gelenk.course.actuators.dc_motor import Motor
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.errors import CertificationFailed
from gelenk.language import translated as _
from gelenk.robot.result import Result

_CLOSING_TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True)
class Pulses:
    """Pulses of V_s > 0, [V], D in [0, 1] and f > 0, [Hz]; the direction is -1 if an H-bridge reverses the supply."""

    supply_voltage: float
    duty: float
    frequency: float
    direction: int = 1

    @property
    def high_voltage(self) -> float:
        """Voltage at the motor during a pulse, ±V_s, [V]."""
        return self.direction * self.supply_voltage

    @property
    def average_voltage(self) -> float:
        """Average voltage, ±D V_s, [V]."""
        return self.duty * self.high_voltage

    @property
    def rms_voltage(self) -> float:
        """Root mean square of the voltage, √D V_s, [V]."""
        return math.sqrt(self.duty) * self.supply_voltage

    @property
    def on_time(self) -> float:
        """Duration of a pulse, D / f, [s]."""
        return self.duty / self.frequency

    @property
    def off_time(self) -> float:
        """Time between pulses, (1 - D) / f, [s]."""
        return (1.0 - self.duty) / self.frequency


def voltage_for_speed(motor: Motor, angular_velocity: float, load_torque: float) -> float:
    """Return the average voltage that holds a speed, [rad/s], under τ_L, [N m]: k_e ω + R (b ω + τ_L) / k_t, [V]."""
    torque = motor.viscous_friction * angular_velocity + load_torque
    return motor.back_emf_constant * angular_velocity + motor.resistance * torque / motor.torque_constant


def speed_step(motor: Motor, angular_velocity: float, load_torque: float) -> Step:
    """Return the worked voltage for a speed."""
    k_t, k_e, R, b = map(
        tex, (motor.torque_constant, motor.back_emf_constant, motor.resistance, motor.viscous_friction)
    )
    omega, load = tex_factor(angular_velocity), tex_factor(load_torque)
    numbers = rf"{k_e} \cdot {omega} + {R} \cdot \frac{{{b} \cdot {omega} + {load}}}{{{k_t}}}"
    return step(
        _("Voltage for the speed"),
        _("The average voltage stands against the back-EMF, and drives the current whose torque the load takes."),
        r"V = k_e\,\omega + R\,\frac{b\,\omega + \tau_L}{k_t}",
        rf"V = {numbers} = {tex(voltage_for_speed(motor, angular_velocity, load_torque), 'V')}",
    )


def approximate_ripple(pulses: Pulses, inductance: float) -> float:
    """Return the ripple without resistance, V_s D (1 - D) / (L f), [A]; it is exact at R = 0."""
    return pulses.supply_voltage * pulses.duty * (1.0 - pulses.duty) / (inductance * pulses.frequency)


@dataclass(frozen=True, slots=True)
class Ripple(Result):
    """The current in the steady state, through R and L against a constant back-EMF.

    Attributes:
        average: (V_avg - E) / R, [A].
        lowest: Smallest in a period, [A].
        highest: Largest in a period, [A].
        ripple: highest - lowest, [A].
        closing_error: Certificate: how far the current is from where it began after one period of both equations, [A].
    """

    average: float
    lowest: float
    highest: float
    ripple: float
    closing_error: float


def exact_ripple(pulses: Pulses, resistance: float, inductance: float, back_emf: float) -> Ripple:
    """Compute the current's extremes from the exponentials of both parts of a period.

    With a = e^{-t_on R/L} and c = e^{-t_off R/L}: highest = (V_s (1 - a)/(1 - a c) - E)/R, lowest = (V_s c (1 - a)/(1 -
    a c) - E)/R, ripple = V_s (1 - a)(1 - c)/(R (1 - a c)). At D = 0 or 1 nothing switches. Raises CertificationFailed
    if the current does not return to its lowest value after one period.

    Args:
        resistance: R > 0, [Ω].
        inductance: L ≥ 0, [H]; at zero the current follows the voltage instantly.
        back_emf: E, constant through a period, [V].
    """
    still = -back_emf / resistance
    peak = pulses.high_voltage / resistance
    average = (pulses.average_voltage - back_emf) / resistance
    if pulses.duty in {0.0, 1.0}:
        return Ripple(average, average, average, 0.0, 0.0)
    if inductance == 0.0:
        return Ripple(average, min(still, still + peak), max(still, still + peak), abs(peak), 0.0)
    rate = resistance / inductance
    rise, fall = -math.expm1(-pulses.on_time * rate), -math.expm1(-pulses.off_time * rate)
    period = -math.expm1(-(pulses.on_time + pulses.off_time) * rate)
    after_pulse = still + peak * (rise / period)
    after_pause = after_pulse - peak * (rise * fall / period)
    # Integrate each part of the period from the end of the other, as an exponential approach to its final value.
    there = after_pause + (peak + still - after_pause) * rise
    back = there + (still - there) * fall
    error = max(abs(there - after_pulse), abs(back - after_pause))
    size = abs(peak) + abs(still)
    if error > _CLOSING_TOLERANCE * size:
        raise CertificationFailed("the current after one period", error / size, _CLOSING_TOLERANCE)
    low, high = sorted((after_pause, after_pulse))
    return Ripple(average, low, high, abs(peak) * (rise * fall / period), error)


def pwm_warnings(pulses: Pulses, ripple: Ripple | None) -> tuple[str, ...]:
    """Return warnings to consider before building the circuit, one sentence each."""
    found = []
    if pulses.direction < 0:
        found.append(_("the average voltage is negative: that takes an H-bridge, which turns the supply round"))
    if pulses.duty == 0.0:
        found.append(_("at D = 0 nothing is switched on: with a back-EMF the motor brakes through the closed switch"))
    if pulses.duty == 1.0:
        found.append(_("at D = 1 nothing is switched off: the motor sees the supply itself"))
    if ripple is not None and min(pulses.direction * ripple.lowest, pulses.direction * ripple.highest) < 0.0:
        found.append(
            _(
                "the current flows against the pulses, in a part of the period at least: that takes a switch on the "
                "way back; through a diode alone it would stop at zero, and the average voltage would be another"
            )
        )
    return tuple(found)


def pwm_steps(pulses: Pulses, inductance: float | None, ripple: Ripple | None) -> tuple[Step, ...]:
    """Return the worked solution of averages, times and ripple."""
    D, V, f = tex(pulses.duty), tex(pulses.supply_voltage), tex(pulses.frequency)
    mean = rf"D\,V_s = {D} \cdot {tex_factor(pulses.high_voltage)} = {tex(pulses.average_voltage, 'V')}"
    steps = (
        step(
            _("Averages"),
            _("Over a period the motor sees the mean; the heater in it sees the root mean square."),
            rf"V_{{\mathrm{{avg}}}} = {mean}",
            rf"V_{{\mathrm{{rms}}}} = \sqrt{{D}}\,V_s = {tex(pulses.rms_voltage, 'V')}",
        ),
        step(
            _("Times"),
            _("The period is divided by the duty."),
            rf"t_{{\mathrm{{on}}}} = \frac{{D}}{{f}} = \frac{{{D}}}{{{f}}} = {tex(pulses.on_time, 's')}",
            rf"t_{{\mathrm{{off}}}} = \frac{{1 - D}}{{f}} = {tex(pulses.off_time, 's')}",
        ),
    )
    formulas = []
    if inductance:
        numbers = rf"\frac{{{V} \cdot {D} \cdot (1 - {D})}}{{{tex(inductance)} \cdot {f}}}"
        value = tex(approximate_ripple(pulses, inductance), "A")
        formulas.append(rf"\Delta i \approx \frac{{V_s D (1 - D)}}{{L f}} = {numbers} = {value}")
    if ripple is not None:
        parts = r"\frac{(1 - e^{-t_{\mathrm{on}} R/L})(1 - e^{-t_{\mathrm{off}} R/L})}{1 - e^{-R/(L f)}}"
        formulas.append(rf"\Delta i = \frac{{V_s}}{{R}} \cdot {parts} = {tex(ripple.ripple, 'A')}")
        formulas.append(rf"i \in [{tex(ripple.lowest)},\ {tex(ripple.highest)}]\,\mathrm{{A}}")
    text = _("The current rises in a pulse and falls after it, along exponentials of the time constant L/R.")
    return (*steps, step(_("Ripple"), text, *formulas)) if formulas else steps
