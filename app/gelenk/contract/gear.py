"""A gear: request, answer, operation."""

from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import AngularVelocity, Inertia, InLanguage, Ratio, Steps, Torque
from gelenk.course.actuators.gear import BackDriving, GearSide, PowerFlow, ReflectedInertias


class GearRequest(InLanguage):
    """A gear, with at most one speed, one torque, and both inertias or none."""

    ratio: Ratio = Field(description="N = ω_motor / ω_load, no unit; above 1 it reduces the speed.")
    efficiency: Annotated[float, Field(ge=1e-6, le=1.0)] = Field(
        default=1.0, description="η, power out over power in when the motor drives, no unit."
    )
    motor_angular_velocity: AngularVelocity | None = optional("ω_m, [rad/s].")
    load_angular_velocity: AngularVelocity | None = optional("ω_L, instead of ω_m, [rad/s].")
    motor_torque: Torque | None = optional("τ_m, from the motor into the gear, [N m].")
    load_torque: Torque | None = optional("τ_L, from the gear into the load, instead of τ_m, [N m].")
    motor_inertia: Inertia | None = optional("J_m of the rotor, [kg m²].")
    load_inertia: Inertia | None = optional("J_L of the load, [kg m²].")


class GearAnswer(Answer):
    """Both sides of a gear."""

    motor: GearSide
    load: GearSide
    power_loss: float | None = Field(description="What the gear turns into heat, [W]; null where a power is missing.")
    power_flow: PowerFlow = Field(description="Which side drives; `none` without a torque.")
    inertia: ReflectedInertias | None = Field(description="Null without both inertias.")
    back_driving: BackDriving
    steps: Steps


ENDPOINT = Endpoint(
    name="gear",
    path="v1/course/gear",
    tag="Course",
    request=GearRequest,
    answer=GearAnswer,
    summary="Gear: both sides",
    description="""
    A gear of ratio N = ω_motor / ω_load and efficiency η, from the motor's side or from the load's.

    Speed ω_L = ω_m / N, torque τ_L = η N τ_m, inertias across the gear by N², the ratio √(J_L / J_m) with which a
    given motor torque accelerates the load most. Where speed and torque have different signs the load drives:
    then friction helps to hold it, with the efficiency 2 - 1/η; at η ≤ 1/2 the gear locks itself.
    """,
    example={
        "ratio": 100.0,
        "efficiency": 0.8,
        "motor_torque": 1.0,
        "motor_angular_velocity": 458.015267176,
        "motor_inertia": 2e-4,
        "load_inertia": 3.0,
    },
)
