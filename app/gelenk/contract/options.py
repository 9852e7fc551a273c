"""Fields that several operations share, and physical quantities with their bounds."""

from typing import Annotated

from pydantic import AfterValidator, Field

from gelenk.contract.common import Payload
from gelenk.contract.kinematics import Configurations
from gelenk.course.steps import Step
from gelenk.ik.search.words import Direction
from gelenk.language import Language

RespectLimits = Annotated[bool, Field(description="Whether a configuration beyond the joint limits is an error.")]
Positive = Annotated[float, Field(ge=1e-6, le=1e6)]
"""A quantity that is neither zero nor beyond all measure."""
Fraction = Annotated[float, Field(gt=0, lt=1)]
"""A relative tolerance."""
RankTolerance = Annotated[
    Fraction,
    Field(
        description="A singular value counts where it exceeds this times the largest, and the rounding of the whole "
        "Jacobian; no unit.",
    ),
]
Directions = Annotated[list[Direction], Field(min_length=1, max_length=6)]
"""Directions of the tip that count."""


class BatchRequest(Payload):
    """Addresses a batch of configurations."""

    joint_positions: Configurations


class InLanguage(Payload):
    """Chooses the language of steps, warnings and other texts for people."""

    language: Language = Field(default="en", description="Of titles, texts and warnings for people: English or German.")


class WithSteps(InLanguage):
    """Asks for the worked solution beside the numbers."""

    steps: bool = Field(default=False, description="Whether the answer has the worked solution of each entry.")


MAX_WORKED = 100
"""Maximum number of configurations whose solution is worked out."""
WorkedSolutions = Annotated[
    list[list[Step]] | None,
    Field(
        description="If requested: the worked solution of each configuration, with the numbers put in; of at most "
        f"{MAX_WORKED}."
    ),
]


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
