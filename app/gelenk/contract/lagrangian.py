"""The equations of motion of a planar arm, as payloads."""

import math
from typing import Annotated, Any, TypeAlias

from pydantic import Discriminator, Field, Tag, field_validator

from gelenk.contract.common import Answer, Payload, optional
from gelenk.contract.kinematics import Configuration
from gelenk.dh.derive.typeset import Formula, MatrixFormula
from gelenk.dh.lagrangian.bodies import STANDARD_GRAVITY, Gravity, LinkBody, MassProperties
from gelenk.dh.lagrangian.texts import ChristoffelSymbol, EquationsCertificate, LinkFormulas
from gelenk.robot.dh import MAX_JOINTS, MAX_LENGTH

Grid: TypeAlias = list[list[float]]

MAX_CONFIGURATIONS = 100
MAX_MASS = 1e6
"""Largest mass of a link, [kg]."""
MAX_INERTIA = 1e9
"""Largest moment of inertia of a link, [kg m²]."""
MAX_GRAVITY = 1e3
"""Largest component of free fall, [m/s²]."""


def _kind(value: Any) -> str:
    return "<list>" if isinstance(value, list) else "<object>" if isinstance(value, dict) else "<number>"


Coordinate = Annotated[float, Field(ge=-MAX_LENGTH, le=MAX_LENGTH)]
Triple = Annotated[list[Coordinate], Field(min_length=3, max_length=3)]
CenterOfMass = Annotated[
    Annotated[Coordinate, Tag("<number>")] | Annotated[Triple, Tag("<list>")], Discriminator(_kind)
]


class LinkPayload(Payload):
    """The mass of a link; what is left out stays a symbol."""

    mass: float | None = optional("m_i, [kg].", ge=0, le=MAX_MASS)
    center_of_mass: CenterOfMass | None = optional(
        "[x, y, z] in frame i, [m]; or one number along the link, l_ci, [m]: behind a revolute joint from its axis "
        "along x_i (along the next joint's axis where the link has no length along x and that joint slides), behind a "
        "prismatic joint from the origin of frame i along its axis."
    )
    inertia: float | None = optional(
        "I_i, about the centre of mass, the axis normal to the plane, [kg m²].", ge=0, le=MAX_INERTIA
    )

    def body(self) -> LinkBody:
        """Return the core's body."""
        center = self.center_of_mass
        point = (center[0], center[1], center[2]) if isinstance(center, list) else center
        return LinkBody(self.mass, point, self.inertia)


class GravityPayload(Payload):
    """Acceleration of free fall by its magnitude and direction."""

    magnitude: float = Field(default=STANDARD_GRAVITY, ge=0, le=MAX_GRAVITY, description="g_0, [m/s²].")
    direction: Triple = Field(description="Direction of free fall in the base; of any length, no unit.")

    @field_validator("direction")
    @classmethod
    def _has_a_length(cls, value: list[float]) -> list[float]:
        if not math.hypot(*value) > 1e-9:
            raise ValueError("a direction is longer than 1e-9")
        return value


FreeFall = Annotated[list[Annotated[float, Field(ge=-MAX_GRAVITY, le=MAX_GRAVITY)]], Field(min_length=3, max_length=3)]


class DynamicsPayload(Payload):
    """Masses and gravity of a planar arm of up to three joints, for its equations of motion."""

    links: Annotated[
        list[LinkPayload],
        Field(
            max_length=MAX_JOINTS,
            description="One per row of the table, in order; left out, all masses, centres of mass and inertias are "
            "symbols.",
        ),
    ] = []  # noqa: RUF012
    gravity: Annotated[
        Annotated[FreeFall, Tag("<list>")] | Annotated[GravityPayload, Tag("<object>")], Discriminator(_kind)
    ] = Field(
        default=[0.0, 0.0, -STANDARD_GRAVITY],
        description="Acceleration of free fall in the base, [m/s²], or its size and direction. Left out it points "
        "along -z of the base, so that an arm in the x-y plane of the base is horizontal.",
    )
    joint_velocities: Annotated[list[Configuration], Field(max_length=MAX_CONFIGURATIONS)] | None = optional(
        "For C in numbers: one entry per configuration of `joint_positions`, [rad/s or m/s]."
    )

    def dynamics(self) -> MassProperties:
        """Return the core's masses, gravity and velocities."""
        given = self.gravity
        vector, size = (given, math.hypot(*given)) if isinstance(given, list) else (given.direction, given.magnitude)
        length = math.hypot(*vector) or 1.0
        gravity = Gravity(size, (vector[0] / length, vector[1] / length, vector[2] / length))
        return MassProperties(tuple(link.body() for link in self.links), gravity, self.joint_velocities)


class MotionNumbers(Answer):
    """The equations of motion at one configuration."""

    joint_positions: list[float] = Field(description="At which the numbers are, [rad or m].")
    joint_velocities: list[float] | None = Field(description="[rad/s or m/s]; null where none were given.")
    mass_matrix: Grid = Field(description="M, [kg m², kg m or kg].")
    coriolis: Grid | None = Field(description="C, [kg m²/s, kg m/s or kg/s]; null without velocities.")
    coriolis_vector: list[float] | None = Field(description="C q̇, [N m or N]; null without velocities.")
    gravity_vector: list[float] = Field(description="g, [N m or N].")


class DynamicsInfo(Answer):
    """The equations of motion, M(q) q̈ + C(q, q̇) q̇ + g(q) = τ."""

    gravity: MatrixFormula = Field(description="Acceleration of free fall in the axes of frame 0.")
    links: list[LinkFormulas]
    mass_matrix: MatrixFormula = Field(description="M(q), symmetric.")
    christoffel: list[ChristoffelSymbol] = Field(description="Those that differ from zero, j ≤ k.")
    coriolis: MatrixFormula = Field(description="C(q, q̇), with C_ij = Σ_k c_ijk q̇_k.")
    coriolis_vector: MatrixFormula = Field(description="C q̇.")
    gravity_vector: MatrixFormula = Field(description="g(q).")
    skew: MatrixFormula = Field(description="dM/dt - 2C, skew symmetric.")
    equations_of_motion: list[Formula] = Field(description="One per joint, each with its `tau` on the right.")
    numeric: list[MotionNumbers] = Field(
        description="One entry per configuration; empty where a mass or the like has no value."
    )
    certificate: EquationsCertificate
    numeric_certificate: EquationsCertificate | None = Field(description="Null where there are no numbers.")


EXAMPLE_MOTION: dict[str, Any] = {
    "dh": {
        "convention": "standard",
        "joints": [
            {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0},
            {"type": "revolute", "a": 0.7, "alpha": 0.0, "d": 0.0, "theta": 0.0},
        ],
    },
    "joint_positions": [[0.3, 0.8]],
    "dynamics": {
        "links": [
            {"mass": 2.0, "center_of_mass": 0.5, "inertia": 0.2},
            {"mass": 1.2, "center_of_mass": 0.35, "inertia": 0.06},
        ],
        "gravity": [0.0, -9.81, 0.0],
        "joint_velocities": [[0.5, -0.4]],
    },
}
