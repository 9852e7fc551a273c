"""Triangles, by the laws of cosines and sines: request, answer, operation."""

import math
from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Steps, Warnings
from gelenk.course.triangle.triangle import TriangleCase, TriangleCheck

Side = Annotated[float, Field(ge=1e-6, le=1e6)]
InnerAngle = Annotated[float, Field(ge=1e-6, le=math.pi - 1e-6)]


class TriangleRequest(InLanguage):
    """Exactly three of the six parts of a triangle, one of them a side."""

    a: Side | None = optional("The side opposite to α, from B to C, [m].")
    b: Side | None = optional("The side opposite to β, from A to C, [m].")
    c: Side | None = optional("The side opposite to γ, from A to B, [m].")
    alpha: InnerAngle | None = optional("α, at the corner A, [rad].")
    beta: InnerAngle | None = optional("β, at the corner B, [rad].")
    gamma: InnerAngle | None = optional("γ, at the corner C, [rad].")


class TriangleInfo(Answer):
    """All six parts of a triangle, and where it may lie in the plane."""

    a: float = Field(description="The side from B to C, [m].")
    b: float = Field(description="The side from A to C, [m].")
    c: float = Field(description="The side from A to B, [m].")
    alpha: float = Field(description="The angle at A, opposite to a, [rad].")
    beta: float = Field(description="The angle at B, opposite to b, [rad].")
    gamma: float = Field(description="The angle at C, opposite to c, [rad].")
    area: float = Field(description="Its area, [m²].")
    corners: list[list[float]] = Field(description="A in the origin, B on the x axis and C above it, [m].")


class TriangleAnswer(Answer):
    """All triangles that have the given parts."""

    case: TriangleCase = Field(description="What is given: S for a side, A for an angle, in order around the triangle.")
    triangles: list[TriangleInfo] = Field(description="One; of SSA perhaps two, the longer third side first.")
    steps: Steps
    warnings: Warnings
    certificate: TriangleCheck


ENDPOINT = Endpoint(
    name="triangle",
    path="v1/course/triangle",
    tag="Course",
    operation_id="solve_triangle",
    request=TriangleRequest,
    answer=TriangleAnswer,
    summary="A triangle, by the law of cosines",
    description="""
    A triangle from three of its parts, by the laws of cosines and sines: the calculation behind every elbow.

    Side a is opposite to the angle α at corner A, and so on. Three sides (SSS), two sides and the angle between them
    (SAS), or a side and two angles (ASA, AAS) fix one triangle. Two sides and an angle that is not between them (SSA)
    leave two, one or none, like the elbow of a robot arm. Parts that no triangle has are refused, with the inequality
    that they violate. The corners' coordinates are measured again as a check. As a picture with
    `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Each triangle with its sides and angles.",
    example={"a": 3.0, "b": 4.0, "gamma": 1.0471975511965976},
)
