"""A DC motor: request, answer, operation."""

from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import (
    AngularVelocity,
    Current,
    Friction,
    Inductance,
    Inertia,
    InLanguage,
    MachineConstant,
    Resistance,
    Steps,
    Time,
    Torque,
    Voltage,
    Warnings,
)
from gelenk.course.actuators.dc_motor import Damping, Motor, OperatingPoint, TorqueSpeedLine

MAX_SAMPLES = 10_000


class DcMotorRequest(InLanguage):
    """A motor with its supply and load."""

    resistance: Resistance = Field(description="R of the winding, [Ω].")
    inductance: Inductance = Field(description="L of the winding, [H]; 0, or at least 1e-12.")
    torque_constant: MachineConstant = Field(description="k_t, [N m/A].")
    back_emf_constant: MachineConstant | None = optional(
        "k_e, [V s/rad]; k_t if left out, which it equals in these units."
    )
    viscous_friction: Friction = Field(default=0.0, description="b, [N m s/rad].")
    inertia: Inertia = Field(description="J of the rotor and what turns with it, [kg m²].")
    voltage: Voltage = Field(description="V, constant from t = 0 on, [V]; negative turns the other way.")
    load_torque: Torque = Field(
        default=0.0, description="τ_L, constant from t = 0 on, [N m]: it keeps its direction, as a hanging load's does."
    )
    times: Annotated[list[Time], Field(min_length=1, max_length=MAX_SAMPLES, fail_fast=True)] | None = optional(
        "Times at which to compute the response, from the step on, [s]; no response if left out."
    )
    duration: Annotated[float, Field(ge=1e-12, le=1e9)] | None = optional(
        "Instead of `times`: the last of `samples` times, which are evenly spaced from 0 on, [s]."
    )
    samples: Annotated[int, Field(ge=2, le=MAX_SAMPLES)] | None = optional(
        "Number of times that `duration` is sampled at; 101 if left out."
    )
    initial_current: Current = Field(
        default=0.0, description="i(0), [A]; not used without inductance, where the current follows at once."
    )
    initial_angular_velocity: AngularVelocity = Field(default=0.0, description="ω(0), [rad/s].")

    def motor(self) -> Motor:
        """Return the core's motor."""
        return Motor(
            self.resistance,
            self.inductance,
            self.torque_constant,
            self.torque_constant if self.back_emf_constant is None else self.back_emf_constant,
            self.viscous_friction,
            self.inertia,
        )


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

    steady_state: OperatingPoint
    torque_speed_line: TorqueSpeedLine
    dynamics: MotorDynamicsInfo
    response: StepResponseInfo | None = Field(description="Null if no times were requested.")
    steps: Steps
    warnings: Warnings
    certificate: MotorCertificate


ENDPOINT = Endpoint(
    name="dc_motor",
    path="v1/course/dc-motor",
    tag="Course",
    request=DcMotorRequest,
    answer=DcMotorAnswer,
    summary="DC motor: steady state and step response",
    description="""
    A DC motor under a constant voltage and load: v = R i + L i̇ + k_e ω, J ω̇ + b ω = k_t i - τ_L.

    Steady state, no load and stall, powers and efficiency, exact poles beside the usual time constants, and the
    exact response to the step from any initial state, by the matrix exponential in closed form: real, double or
    complex poles, first order where L = 0. The load torque keeps its direction: beyond the stall torque it drives
    the motor backwards, which `regime` names. `back_emf_constant` is `torque_constant` unless given; in SI units
    they are equal, and two different values produce a warning.

    The lecture describes the motor in words; these are the equations behind it.

    As a picture with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="The circuit with the values, and the torque-speed line with the operating point.",
    example={
        "resistance": 1.2,
        "inductance": 2e-3,
        "torque_constant": 0.05,
        "viscous_friction": 1e-4,
        "inertia": 2e-4,
        "voltage": 24.0,
        "load_torque": 0.1,
        "times": [0.0, 0.02, 0.1, 0.5],
    },
)
