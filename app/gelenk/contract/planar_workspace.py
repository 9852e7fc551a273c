"""Workspaces of planar arms: request, answer, operation."""

from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Steps
from gelenk.course.planar import WorkspacePlace, WorkspaceTrial

MAX_LENGTH = 1e6

Length = Annotated[float, Field(ge=0.0, le=MAX_LENGTH)]
Coordinate = Annotated[float, Field(ge=-MAX_LENGTH, le=MAX_LENGTH)]


class PlanarWorkspaceRequest(InLanguage):
    """A planar arm of two or three revolute joints without limits."""

    links: Annotated[list[Length], Field(min_length=2, max_length=3)] = Field(
        description="Lengths l_1, l_2 and perhaps l_3, from the base on, [m]."
    )
    point: Annotated[list[Coordinate], Field(min_length=2, max_length=2)] | None = optional(
        "x and y of a point, relative to the first joint, [m]."
    )
    tolerance: Annotated[float, Field(ge=0.0, le=1.0)] = Field(
        default=1e-9, description="Distance within which the point lies on a boundary, [m]."
    )


class RegionInfo(Answer):
    """A workspace as rings around the base."""

    intervals: list[list[float]] = Field(
        description="Smallest and largest distance from the base of each ring, both included, from the inside out, "
        "[m]. From 0 on it is a disc; with both the same a circle, or the base alone; empty where there is none."
    )
    area: float = Field(description="Of the region, [m²].")


class PointInfo(Answer):
    """A point and the orientations of the last link with which the tip reaches it."""

    radius: float = Field(description="Distance from the base, [m].")
    primary: WorkspacePlace
    secondary: WorkspacePlace
    orientations: list[list[float]] = Field(
        description="Intervals of φ, the angle of the last link to the x axis, both ends included, [rad]. Each begins "
        "in (-π, π] and may end beyond π; -π to π are all; one with both ends the same is a single orientation."
    )
    orientation_share: float = Field(description="Part of all orientations; 1 within WS₂; no unit.")


class PlanarWorkspaceAnswer(Answer):
    """Both workspaces of a planar arm."""

    primary: RegionInfo = Field(description="WS₁: reached with at least one orientation.")
    secondary: RegionInfo = Field(description="WS₂: reached with all orientations.")
    point: PointInfo | None = Field(description="Null where no point was given.")
    steps: Steps
    certificate: WorkspaceTrial


ENDPOINT = Endpoint(
    name="planar_workspace",
    path="v1/course/workspace",
    tag="Course",
    request=PlanarWorkspaceRequest,
    answer=PlanarWorkspaceAnswer,
    summary="Workspaces of a planar arm",
    description="""
    Primary and secondary workspace of a planar arm of two or three revolute joints, exactly.

    WS₁ is the set of points reached with at least one orientation, WS₂ the set reached with all. Both are rings
    around the base, given as intervals of the distance r. With three links WS₂ is where the circle of the wrist, of
    radius l_3, lies within the ring of the first two: r + l_3 ≤ l_1 + l_2, and r ≥ l_3 + |l_1 - l_2| or r ≤ l_3 -
    |l_1 - l_2|: up to two pieces. Known solutions of this exercise give the outer ring alone, from l_1 - l_2 + l_3
    to l_1 + l_2 - l_3; they miss the disc around the base that the second condition adds. With two links WS₂ is
    empty, or the base alone where both are of the same length.

    For a `point`: where it lies relative to both, and with which orientations it is reached. The joints turn
    without limits; with limits the boundaries differ, and the workspace of a robot has to be sampled. As a picture
    with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Both workspaces, and the arm with its tip at `point`.",
    example={"links": [1.0, 0.9, 0.5], "point": [0.3, 0.2]},
)
