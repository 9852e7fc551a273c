"""DC motor, gear and pulse width modulation on the wire."""

from typing import Annotated, Any

from pydantic import AfterValidator, Field

from gelenk.contract.common import Answer, Payload
from gelenk.contract.derive import StepInfo
from gelenk.course.dc_motor import Damping, Motor, Regime
from gelenk.course.gear import PowerFlow

MAX_SAMPLES = 10_000


def _zero_or_measurable(value: float) -> float:
    if 0.0 < value < 1e-12:
        raise ValueError("an inductance is 0, or at least 1e-12 H")
    return value


Resistance = Annotated[float, Field(ge=1e-6, le=1e9)]
Inductance = Annotated[float, Field(ge=0.0, le=1e6), AfterValidator(_zero_or_measurable)]
MachineConstant = Annotated[float, Field(ge=1e-9, le=1e6)]
Friction = Annotated[float, Field(ge=0.0, le=1e6)]
Inertia = Annotated[float, Field(ge=1e-15, le=1e9)]
Voltage = Annotated[float, Field(ge=-1e6, le=1e6)]
Torque = Annotated[float, Field(ge=-1e9, le=1e9)]
AngularVelocity = Annotated[float, Field(ge=-1e9, le=1e9)]
Current = Annotated[float, Field(ge=-1e9, le=1e9)]
Time = Annotated[float, Field(ge=0.0, le=1e9)]
Ratio = Annotated[float, Field(ge=1e-6, le=1e6)]

Steps = Annotated[list[StepInfo], Field(description="The worked solution, with the numbers put in.")]
Warnings = Annotated[list[str], Field(description="What to know before using the numbers.")]


# DC motor


class DcMotorRequest(Payload):
    """A motor with its supply and load."""

    resistance: Resistance = Field(description="R of the winding, [Ω].")
    inductance: Inductance = Field(description="L of the winding, [H]; 0, or at least 1e-12.")
    torque_constant: MachineConstant = Field(description="k_t, [N m/A].")
    back_emf_constant: MachineConstant | None = Field(
        default=None, description="k_e, [V s/rad]; k_t if left out, which it equals in these units."
    )
    viscous_friction: Friction = Field(default=0.0, description="b, [N m s/rad].")
    inertia: Inertia = Field(description="J of the rotor and what turns with it, [kg m²].")
    voltage: Voltage = Field(description="V, constant from t = 0 on, [V]; negative turns the other way.")
    load_torque: Torque = Field(
        default=0.0, description="τ_L, constant from t = 0 on, [N m]: it keeps its direction, as a hanging load's does."
    )
    times: Annotated[list[Time], Field(min_length=1, max_length=MAX_SAMPLES, fail_fast=True)] | None = Field(
        default=None,
        description="Times at which to compute the response, from the step on, [s]; no response if left out.",
    )
    duration: Annotated[float, Field(ge=1e-12, le=1e9)] | None = Field(
        default=None,
        description="Instead of `times`: the last of `samples` times, which are evenly spaced from 0 on, [s].",
    )
    samples: Annotated[int, Field(ge=2, le=MAX_SAMPLES)] | None = Field(
        default=None, description="Number of times that `duration` is sampled at; 101 if left out."
    )
    initial_current: Current = Field(
        default=0.0, description="i(0), [A]; not used without inductance, where the current follows at once."
    )
    initial_angular_velocity: AngularVelocity = Field(default=0.0, description="ω(0), [rad/s].")

    def motor(self) -> Motor:
        """The core's motor."""
        return Motor(
            self.resistance,
            self.inductance,
            self.torque_constant,
            self.torque_constant if self.back_emf_constant is None else self.back_emf_constant,
            self.viscous_friction,
            self.inertia,
        )


class SteadyStateInfo(Answer):
    """The motor's steady state."""

    angular_velocity: float = Field(description="ω, [rad/s].")
    current: float = Field(description="i, [A].")
    torque: float = Field(description="k_t i, friction included, [N m].")
    electrical_power: float = Field(description="V i, [W]: negative where it flows to the supply.")
    shaft_power: float = Field(description="τ_L ω, power delivered to the load, [W]: negative where the load drives.")
    copper_loss: float = Field(description="R i², [W].")
    friction_loss: float = Field(description="b ω², [W].")
    efficiency: float | None = Field(
        description="Shaft over electrical power where the motor drives, electrical over shaft power where it is a "
        "generator, in [0, 1]; null where neither is useful, and where `back_emf_constant` is not `torque_constant`: "
        "the powers do not add up then."
    )
    regime: Regime = Field(
        description="`motoring`; `standstill`; `assisted`: the load helps; `generating`: the load is faster than the "
        "motor without load, and power flows to the supply; `driven_backwards`: the load is beyond the stall torque; "
        "`braking`: no voltage, the terminals shorted."
    )


class TorqueSpeedInfo(Answer):
    """The torque-speed line at this voltage."""

    no_load_angular_velocity: float = Field(description="ω₀ = k_t V / (R b + k_t k_e), [rad/s].")
    no_load_current: float = Field(description="Current that friction alone needs, [A].")
    stall_torque: float = Field(description="k_t V / R, [N m].")
    stall_current: float = Field(description="V / R, [A].")
    slope: float = Field(description="dω/dτ_L, [rad/s per N m].")
    most_power: float = Field(description="Largest shaft power, reached at half the stall torque, [W].")


class PoleInfo(Answer):
    """An eigenvalue of the motor's equations."""

    real: float = Field(description="Real part, [1/s].")
    imaginary: float = Field(description="Imaginary part, [rad/s].")


class MotorDynamicsInfo(Answer):
    """How the motor reaches the steady state."""

    poles: list[PoleInfo] = Field(description="Exact, slowest first; one where L = 0.")
    damping: Damping = Field(description="What the poles are.")
    time_constants: list[float] = Field(description="-1 / real part of each pole, exact, [s].")
    mechanical_time_constant: float = Field(description="τ_m ≈ J R / (R b + k_t k_e), [s]; exact where L = 0.")
    electrical_time_constant: float = Field(description="τ_e ≈ L / R, [s].")


class StepResponseInfo(Answer):
    """x(t) = x_∞ + e^{A t} (x(0) - x_∞), exact."""

    times: list[float] = Field(description="Since the step, [s].")
    currents: list[float] = Field(description="i(t), [A].")
    angular_velocities: list[float] = Field(description="ω(t), [rad/s].")


class MotorCertificate(Answer):
    """Residuals of the two equations in the steady state, and a second computation of the response.

    The exponential of the response is written out; the second one is a Taylor series of A t / 2^k, squared k times.
    """

    voltage_residual: float = Field(description="V - R i - k_e ω of the steady state, [V].")
    torque_residual: float = Field(description="k_t i - b ω - τ_L of the steady state, [N m].")
    samples: int = Field(description="Times of the response that were recomputed, at most 16.")
    max_current_difference: float | None = Field(description="Largest difference, [A]; null without a response.")
    max_angular_velocity_difference: float | None = Field(
        description="Largest difference, [rad/s]; null without a response."
    )


class DcMotorAnswer(Answer):
    """A motor's behaviour at a voltage and a load."""

    steady_state: SteadyStateInfo
    torque_speed_line: TorqueSpeedInfo
    dynamics: MotorDynamicsInfo
    response: StepResponseInfo | None = Field(description="Null if no times were requested.")
    steps: Steps
    warnings: Warnings
    certificate: MotorCertificate


# Gear


class GearRequest(Payload):
    """A gear, with at most one speed, one torque, and both inertias or none."""

    ratio: Ratio = Field(description="N = ω_motor / ω_load, no unit; above 1 it reduces the speed.")
    efficiency: Annotated[float, Field(ge=1e-6, le=1.0)] = Field(
        default=1.0, description="η, power out over power in when the motor drives, no unit."
    )
    motor_angular_velocity: AngularVelocity | None = Field(default=None, description="ω_m, [rad/s].")
    load_angular_velocity: AngularVelocity | None = Field(default=None, description="ω_L, instead of ω_m, [rad/s].")
    motor_torque: Torque | None = Field(default=None, description="τ_m, from the motor into the gear, [N m].")
    load_torque: Torque | None = Field(
        default=None, description="τ_L, from the gear into the load, instead of τ_m, [N m]."
    )
    motor_inertia: Inertia | None = Field(default=None, description="J_m of the rotor, [kg m²].")
    load_inertia: Inertia | None = Field(default=None, description="J_L of the load, [kg m²].")


class GearSideInfo(Answer):
    """One side of the gear; null where not given."""

    angular_velocity: float | None = Field(description="ω, [rad/s].")
    torque: float | None = Field(description="τ, from the motor towards the load, [N m].")
    power: float | None = Field(description="τ ω, [W]: negative where it flows from the load to the motor.")


class ReflectedInertiaInfo(Answer):
    """Rotor and load as one inertia."""

    at_motor: float = Field(description="J_m + J_L / N², [kg m²].")
    at_load: float = Field(description="N² J_m + J_L, [kg m²].")
    reflected_load: float = Field(description="J_L / N², [kg m²].")
    reflected_motor: float = Field(description="N² J_m, [kg m²].")
    optimal_ratio: float = Field(
        description="N* = √(J_L / J_m), with which a given motor torque accelerates the load most; no unit."
    )
    acceleration_share: float = Field(
        description="Acceleration with this ratio over that with N*, same torque, no losses; in [0, 1]."
    )


class BackDrivingInfo(Answer):
    """What happens when the load drives."""

    efficiency: float | None = Field(description="2 - 1/η, no unit; null where the gear locks itself.")
    self_locking: bool = Field(description="Whether no load can turn the motor: η ≤ 1/2.")
    note: str = Field(description="An explanation in one sentence.")


class GearAnswer(Answer):
    """Both sides of a gear."""

    motor: GearSideInfo
    load: GearSideInfo
    power_loss: float | None = Field(description="What the gear turns into heat, [W]; null where a power is missing.")
    power_flow: PowerFlow = Field(description="Which side drives; `none` without a torque.")
    inertia: ReflectedInertiaInfo | None = Field(description="Null without both inertias.")
    back_driving: BackDrivingInfo
    steps: Steps


# Pulse width modulation


class PwmRequest(Payload):
    """A supply, switched; exactly one of `duty`, `average_voltage` and `angular_velocity`."""

    supply_voltage: Annotated[float, Field(ge=1e-6, le=1e6)] = Field(description="V_s, [V].")
    frequency: Annotated[float, Field(ge=1e-6, le=1e12)] = Field(description="f of the pulses, [Hz].")
    duty: Annotated[float, Field(ge=0.0, le=1.0)] | None = Field(default=None, description="D, no unit.")
    average_voltage: Voltage | None = Field(
        default=None, description="Wanted average, [V]; negative needs an H-bridge; no further from 0 than V_s."
    )
    angular_velocity: AngularVelocity | None = Field(
        default=None, description="Wanted speed of a motor, [rad/s]; it needs `resistance` and `torque_constant`."
    )
    resistance: Resistance | None = Field(default=None, description="R of the winding, [Ω].")
    inductance: Inductance | None = Field(default=None, description="L of the winding, [H]; 0, or at least 1e-12.")
    back_emf: Voltage | None = Field(
        default=None,
        description="E of the motor through the period, [V]; 0 if left out. With a wanted speed it is k_e ω: leave it "
        "out, or give that.",
    )
    torque_constant: MachineConstant | None = Field(default=None, description="k_t, for a wanted speed, [N m/A].")
    back_emf_constant: MachineConstant | None = Field(
        default=None, description="k_e, for a wanted speed, [V s/rad]; k_t if left out."
    )
    viscous_friction: Friction | None = Field(
        default=None, description="b, for a wanted speed, [N m s/rad]; 0 if left out."
    )
    load_torque: Torque | None = Field(default=None, description="τ_L, for a wanted speed, [N m]; 0 if left out.")


class RippleInfo(Answer):
    """The current in the steady state, through R and L against a constant back-EMF."""

    average: float = Field(description="(V_avg - E) / R, [A].")
    lowest: float = Field(description="Smallest in a period, [A].")
    highest: float = Field(description="Largest in a period, [A].")
    ripple: float = Field(description="highest - lowest, [A].")
    closing_error: float = Field(
        description="Certificate: how far the current is from where it began after one period of both equations, [A]."
    )


class PwmAnswer(Answer):
    """What a switched supply gives."""

    duty: float = Field(description="D in [0, 1], no unit.")
    direction: int = Field(description="1, or -1 if the supply is reversed; no unit.")
    needs_h_bridge: bool = Field(description="Whether the average is negative.")
    average_voltage: float = Field(description="±D V_s, [V].")
    rms_voltage: float = Field(description="√D V_s, [V].")
    on_time: float = Field(description="D / f, [s].")
    off_time: float = Field(description="(1 - D) / f, [s].")
    approximate_ripple: float | None = Field(
        description="V_s D (1 - D) / (L f), [A]: without resistance. Null without inductance."
    )
    current: RippleInfo | None = Field(description="Exact; null without both R and L.")
    steps: Steps
    warnings: Warnings


EXAMPLE_MOTOR: dict[str, Any] = {
    "resistance": 1.2,
    "inductance": 2e-3,
    "torque_constant": 0.05,
    "viscous_friction": 1e-4,
    "inertia": 2e-4,
    "voltage": 24.0,
    "load_torque": 0.1,
    "times": [0.0, 0.02, 0.1, 0.5],
}
EXAMPLE_GEAR: dict[str, Any] = {
    "ratio": 100.0,
    "efficiency": 0.8,
    "motor_torque": 1.0,
    "motor_angular_velocity": 458.015267176,
    "motor_inertia": 2e-4,
    "load_inertia": 3.0,
}
EXAMPLE_PWM: dict[str, Any] = {
    "supply_voltage": 24.0,
    "frequency": 20_000.0,
    "duty": 0.35,
    "resistance": 1.2,
    "inductance": 2e-3,
}
