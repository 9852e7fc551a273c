"""Pulse width modulation: request, answer, operation."""

from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import (
    AngularVelocity,
    Friction,
    Inductance,
    InLanguage,
    MachineConstant,
    Resistance,
    Steps,
    Torque,
    Voltage,
    Warnings,
)
from gelenk.course.actuators.pwm import Ripple


class PwmRequest(InLanguage):
    """A switched supply; give exactly one of `duty`, `average_voltage` and `angular_velocity`."""

    supply_voltage: Annotated[float, Field(ge=1e-6, le=1e6)] = Field(description="V_s, [V].")
    frequency: Annotated[float, Field(ge=1e-6, le=1e12)] = Field(description="f of the pulses, [Hz].")
    duty: Annotated[float, Field(ge=0.0, le=1.0)] | None = optional("D, no unit.")
    average_voltage: Voltage | None = optional(
        "Wanted average, [V]; negative needs an H-bridge; no further from 0 than V_s."
    )
    angular_velocity: AngularVelocity | None = optional(
        "Wanted speed of a motor, [rad/s]; it needs `resistance` and `torque_constant`."
    )
    resistance: Resistance | None = optional("R of the winding, [Ω].")
    inductance: Inductance | None = optional("L of the winding, [H]; 0, or at least 1e-12.")
    back_emf: Voltage | None = optional(
        "E of the motor through the period, [V]; 0 if left out. With a wanted speed it is k_e ω: leave it "
        "out, or give that."
    )
    torque_constant: MachineConstant | None = optional("k_t, for a wanted speed, [N m/A].")
    back_emf_constant: MachineConstant | None = optional("k_e, for a wanted speed, [V s/rad]; k_t if left out.")
    viscous_friction: Friction | None = optional("b, for a wanted speed, [N m s/rad]; 0 if left out.")
    load_torque: Torque | None = optional("τ_L, for a wanted speed, [N m]; 0 if left out.")


class PwmAnswer(Answer):
    """Voltages, times and current of a switched supply."""

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
    current: Ripple | None = Field(description="Exact; null without both R and L.")
    steps: Steps
    warnings: Warnings


ENDPOINT = Endpoint(
    name="pulse_width_modulation",
    path="v1/course/pwm",
    tag="Course",
    request=PwmRequest,
    answer=PwmAnswer,
    summary="Pulse width modulation: averages and ripple",
    description="""
    A supply switched with a duty D: V_avg = D V_s, V_rms = √D V_s, and the ripple of the current.

    Give `duty`, or a wanted `average_voltage`, or a wanted `angular_velocity` of a motor: the duty is found. A
    negative average needs an H-bridge, and `direction` is -1. The ripple V_s D (1 - D) / (L f) leaves out the
    resistance; with R and L the current's extremes are exact, in the steady state, with a constant back-EMF.

    As a picture with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Three periods of the voltage with its averages, and of the current with its ripple if R and L are given.",
    example={
        "supply_voltage": 24.0,
        "frequency": 20_000.0,
        "duty": 0.35,
        "resistance": 1.2,
        "inductance": 2e-3,
    },
)
