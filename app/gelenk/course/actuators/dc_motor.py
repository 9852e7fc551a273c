"""The brushed DC motor: steady state, the ends of its torque-speed line, its poles.

v = R i + L i̇ + k_e ω and J ω̇ + b ω = k_t i - τ_L. The load torque is that of a hanging load: it keeps its direction
whichever way the shaft turns. In SI units k_t and k_e are the same number; both are kept because data sheets give both.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.errors import CertificationFailed
from gelenk.language import translated as _
from gelenk.robot.result import Result

Regime: TypeAlias = Literal["motoring", "standstill", "assisted", "generating", "driven_backwards", "braking"]
Damping: TypeAlias = Literal["first_order", "overdamped", "critically_damped", "underdamped"]

SAME_CONSTANTS = 1e-6
"""Relative difference of k_t and k_e above which the energy balance is visibly violated."""

_ROUNDING = 1e-12
_BALANCE = 1e-9
_NEXT_TO_NOTHING = 1e-280
"""Threshold below which products lose digits, because they approach the smallest doubles."""
_EPSILON = 2.0**-52


@dataclass(frozen=True, slots=True)
class Motor:
    """A motor, with everything that turns rigidly on its shaft.

    Attributes:
        resistance: R > 0, [Ω].
        inductance: L ≥ 0, [H]; at zero the current follows the voltage instantly.
        torque_constant: k_t > 0, [N m/A].
        back_emf_constant: k_e > 0, [V s/rad].
        viscous_friction: b ≥ 0, [N m s/rad].
        inertia: J > 0, [kg m²].
    """

    resistance: float
    inductance: float
    torque_constant: float
    back_emf_constant: float
    viscous_friction: float
    inertia: float

    @property
    def stiffness(self) -> float:
        """R b + k_t k_e, [V N m s/rad/A]: the denominator of speed and current in the steady state."""
        return self.resistance * self.viscous_friction + self.torque_constant * self.back_emf_constant

    @property
    def mechanical_time_constant(self) -> float:
        """τ_m ≈ J R / (R b + k_t k_e), [s]: exact if L = 0."""
        return self.inertia * self.resistance / self.stiffness

    @property
    def electrical_time_constant(self) -> float:
        """τ_e = L / R, [s]: exact if the shaft is held."""
        return self.inductance / self.resistance


@dataclass(frozen=True, slots=True)
class OperatingPoint(Result):
    """The motor's steady state.

    Attributes:
        angular_velocity: ω, [rad/s].
        current: i, [A].
        torque: k_t i, friction included, [N m].
        electrical_power: V i, [W]: negative where it flows to the supply.
        shaft_power: τ_L ω, power delivered to the load, [W]: negative where the load drives.
        copper_loss: R i², [W].
        friction_loss: b ω², [W].
        efficiency: Shaft over electrical power where the motor drives, electrical over shaft power where it is a
            generator, in [0, 1]; null where neither is useful, and where `back_emf_constant` is not `torque_constant`:
            the powers do not add up then.
        regime: `motoring`; `standstill`; `assisted`: the load helps; `generating`: the load is faster than the motor
            without load, and power flows to the supply; `driven_backwards`: the load is beyond the stall torque;
            `braking`: no voltage, the terminals shorted.
    """

    angular_velocity: float
    current: float
    torque: float
    electrical_power: float
    shaft_power: float
    copper_loss: float
    friction_loss: float
    efficiency: float | None
    regime: Regime


def operating_point(motor: Motor, voltage: float, load_torque: float) -> OperatingPoint:
    """Compute the steady state under a constant voltage, [V], and a constant load torque, [N m].

    ω = (k_t V - R τ_L) / (R b + k_t k_e) and i = (b V + k_e τ_L) / (R b + k_t k_e), which is (V - k_e ω) / R without
    its cancellation.
    """
    drive, drag = motor.torque_constant * voltage, motor.resistance * load_torque
    omega = (drive - drag) / motor.stiffness
    if abs(drive - drag) <= _ROUNDING * (abs(drive) + abs(drag)):
        omega = 0.0
    current = (motor.viscous_friction * voltage + motor.back_emf_constant * load_torque) / motor.stiffness
    electrical, shaft = voltage * current, load_torque * omega
    regime = _regime(voltage, omega, electrical, shaft)
    efficiency = _efficiency(regime, electrical, shaft) if _constants_are_one(motor) else None
    copper, friction = motor.resistance * current**2, motor.viscous_friction * omega**2
    torque = motor.torque_constant * current
    return OperatingPoint(omega, current, torque, electrical, shaft, copper, friction, efficiency, regime)


def balance(motor: Motor, voltage: float, load_torque: float, point: OperatingPoint) -> tuple[float, float]:
    """Return V - R i - k_e ω, [V], and k_t i - b ω - τ_L, [N m]; raises CertificationFailed beyond rounding."""
    volts = (voltage, -motor.resistance * point.current, -motor.back_emf_constant * point.angular_velocity)
    torques = (motor.torque_constant * point.current, -motor.viscous_friction * point.angular_velocity, -load_torque)
    for name, terms in (("the voltage of the steady state", volts), ("the torque of the steady state", torques)):
        size = max(sum(map(abs, terms)), _NEXT_TO_NOTHING)
        if abs(sum(terms)) > _BALANCE * size:
            raise CertificationFailed(name, abs(sum(terms)) / size, _BALANCE)
    return sum(volts), sum(torques)


def _regime(voltage: float, omega: float, electrical: float, shaft: float) -> Regime:
    if omega == 0.0:
        return "standstill"
    if voltage == 0.0:
        return "braking"
    if voltage * omega < 0.0:
        return "driven_backwards"
    if shaft >= 0.0:
        return "motoring"
    return "assisted" if electrical >= 0.0 else "generating"


def _constants_are_one(motor: Motor) -> bool:
    difference = abs(motor.torque_constant - motor.back_emf_constant)
    return difference <= SAME_CONSTANTS * max(motor.torque_constant, motor.back_emf_constant)


def _efficiency(regime: Regime, electrical: float, shaft: float) -> float | None:
    # Constants that differ in their last digits may put a motor without losses slightly above 1.
    if regime == "motoring" and electrical > 0.0:
        return min(shaft / electrical, 1.0)
    return min(electrical / shaft, 1.0) if regime == "generating" else None


@dataclass(frozen=True, slots=True)
class TorqueSpeedLine(Result):
    """The torque-speed line at this voltage.

    Attributes:
        no_load_angular_velocity: ω₀ = k_t V / (R b + k_t k_e), [rad/s].
        no_load_current: Current that friction alone needs, [A].
        stall_torque: k_t V / R, [N m].
        stall_current: V / R, [A].
        slope: dω/dτ_L, [rad/s per N m].
        most_power: Largest shaft power, reached at half the stall torque, [W].
    """

    no_load_angular_velocity: float
    no_load_current: float
    stall_torque: float
    stall_current: float
    slope: float
    most_power: float


def torque_speed_line(motor: Motor, voltage: float) -> TorqueSpeedLine:
    """Compute the torque-speed line at a voltage, [V]."""
    free = motor.torque_constant * voltage / motor.stiffness
    stall = motor.torque_constant * voltage / motor.resistance
    slope, idle = -motor.resistance / motor.stiffness, motor.viscous_friction * voltage / motor.stiffness
    return TorqueSpeedLine(free, idle, stall, voltage / motor.resistance, slope, 0.25 * free * stall)


@dataclass(frozen=True, slots=True)
class Modes:
    """Eigenvalues of the motor's two equations, from (i̇, ω̇) = A (i, ω) + constant.

    Attributes:
        mean: Half the trace of A, [1/s].
        discriminant: ((a₁₁ - a₂₂) / 2)² + a₁₂ a₂₁, [1/s²]: positive for two real poles, negative for a complex pair.
        poles: Slowest first, [1/s]; one if L = 0.
    """

    mean: float
    discriminant: float
    poles: tuple[complex, ...]
    damping: Damping


def modes(motor: Motor) -> Modes:
    """Compute the exact poles; the slow one of two real poles is det A over the fast one, to avoid cancellation."""
    if motor.inductance == 0.0:
        pole = -1.0 / motor.mechanical_time_constant
        return Modes(pole, 0.0, (complex(pole),), "first_order")
    electrical, mechanical, coupling = rates(motor)
    mean, half = -0.5 * (electrical + mechanical), 0.5 * (electrical - mechanical)
    discriminant = (half - coupling) * (half + coupling)
    if abs(discriminant) <= 8.0 * _EPSILON * mean**2:
        return Modes(mean, discriminant, (complex(mean), complex(mean)), "critically_damped")
    root = math.sqrt(abs(discriminant))
    if discriminant < 0.0:
        return Modes(mean, discriminant, (complex(mean, root), complex(mean, -root)), "underdamped")
    fast = mean - root
    slow = (electrical * mechanical + coupling**2) / fast
    return Modes(mean, discriminant, (complex(slow), complex(fast)), "overdamped")


def rates(motor: Motor) -> tuple[float, float, float]:
    """Return R/L, b/J and √(k_t k_e / (L J)), [1/s]."""
    coupling = math.sqrt(motor.torque_constant / motor.inductance * motor.back_emf_constant / motor.inertia)
    return motor.resistance / motor.inductance, motor.viscous_friction / motor.inertia, coupling


def motor_warnings(motor: Motor, voltage: float, load_torque: float, point: OperatingPoint) -> tuple[str, ...]:
    """Return warnings about the constants and the operating point, one sentence each."""
    stall = motor.torque_constant * voltage / motor.resistance
    texts = {
        "driven_backwards": _(
            "the load torque of {load:g} N m is beyond the stall torque of {stall:g} N m: the load drives the motor "
            "backwards, against its voltage, and both turn into heat"
        ).format(load=load_torque, stall=stall),
        "generating": _(
            "the load drives the motor faster than it would turn without load: current flows to the supply"
        ),
        "assisted": _("the load helps to turn the motor; load and supply share the losses"),
        "braking": _("without voltage the terminals are shorted: the motor brakes the load"),
    }
    constants = _(
        "torque_constant and back_emf_constant differ: in SI, [N m/A] and [V s/rad], they are the same number; "
        "with two of them the powers do not add up, so that there is no efficiency. Was one given per 1000 rpm, or "
        "in another unit?"
    )
    of_regime = (texts[point.regime],) if point.regime in texts else ()
    return of_regime if _constants_are_one(motor) else (constants, *of_regime)


def motor_steps(motor: Motor, voltage: float, load_torque: float, point: OperatingPoint) -> tuple[Step, ...]:
    """Return the worked solution of the steady state, the ends of the line and the time constants."""
    line = torque_speed_line(motor, voltage)
    R, b, k_t, k_e = map(
        tex, (motor.resistance, motor.viscous_friction, motor.torque_constant, motor.back_emf_constant)
    )
    V, load = tex_factor(voltage), tex_factor(load_torque)
    omega = rf"\omega = \frac{{k_t V - R\,\tau_L}}{{R\,b + k_t k_e}} = \frac{{{k_t} \cdot {V} - {R} \cdot {load}}}"
    divided = rf"{{{R} \cdot {b} + {k_t} \cdot {k_e}}} = {tex(point.angular_velocity, 'rad/s')}"
    free, stall = tex(line.no_load_angular_velocity, "rad/s"), tex(line.stall_torque, "N m")
    poles = ", ".join(map(_tex_pole, modes(motor).poles))
    return (
        step(
            _("Two equations"),
            _("The voltage drives a current against resistance and back-EMF, its torque turns the inertia."),
            r"v = R\,i + L\,\dot{i} + k_e\,\omega",
            r"J\,\dot{\omega} + b\,\omega = k_t\,i - \tau_L",
        ),
        step(
            _("Steady state"),
            _("Nothing changes any more: both derivatives are zero."),
            omega + divided,
            rf"i = \frac{{V - k_e\,\omega}}{{R}} = {tex(point.current, 'A')}",
        ),
        step(
            _("Without load, and held"),
            _("The two ends of the torque-speed line."),
            rf"\omega_0 = \frac{{k_t V}}{{R\,b + k_t k_e}} = {free}",
            rf"\tau_s = \frac{{k_t V}}{{R}} = {stall}",
            rf"i_s = \frac{{V}}{{R}} = {tex(line.stall_current, 'A')}",
        ),
        step(
            _("Time constants"),
            _("The poles are exact; the two time constants are what is left of them when the other one is far away."),
            rf"\lambda = {poles}\;\mathrm{{s^{{-1}}}}",
            rf"\tau_m \approx \frac{{J R}}{{R\,b + k_t k_e}} = {tex(motor.mechanical_time_constant, 's')}",
            rf"\tau_e = \frac{{L}}{{R}} = {tex(motor.electrical_time_constant, 's')}",
        ),
    )


def _tex_pole(pole: complex) -> str:
    if pole.imag == 0.0:
        return tex(pole.real)
    return f"{tex(pole.real)} {'+' if pole.imag > 0.0 else '-'} {tex(abs(pole.imag))}\\,\\mathrm{{j}}"
