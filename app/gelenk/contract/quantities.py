"""Physical quantities with their bounds, and the fields that answers of the course share."""

from typing import Annotated

from pydantic import AfterValidator, Field

from gelenk.course.steps import Step


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

Steps = Annotated[list[Step], Field(description="The worked solution, with the numbers put in.")]
Warnings = Annotated[list[str], Field(description="What to know before using the numbers.")]
