"""Cubic splines: request, answer, operation."""

from math import pi
from typing import Annotated

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.course_motion import Coordinates, MotionAnswer, SampledRequest, Time, Times, Waypoints
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import Steps, Warnings
from gelenk.trajectory.motion.splines import Boundary


class SplineRequest(SampledRequest):
    """Knots of a spline, and conditions at both ends."""

    times: Times = Field(description="Of the knots, increasing, [s].")
    waypoints: Waypoints = Field(
        description="Positions at the knots, one row per knot with one number per joint, [rad or m]; a single number "
        "is a row of one."
    )
    boundary: Boundary = Field(
        default="clamped",
        description="`clamped`: velocities given; `natural`: no acceleration; `not_a_knot`: the jerk goes on across "
        "the second and the last but one knot; `periodic`: velocity and acceleration continue from the end to the "
        "start; "
        "`assigned`: velocities and accelerations given, by two fictitious knots.",
    )
    start_velocity: Coordinates | None = optional("Of `clamped` or `assigned`; 0 if left out, [rad/s or m/s].")
    end_velocity: Coordinates | None = optional("The same at the end, [rad/s or m/s].")
    start_acceleration: Coordinates | None = optional("Of `assigned`; 0 if left out, [rad/s² or m/s²].")
    end_acceleration: Coordinates | None = optional("The same at the end, [rad/s² or m/s²].")
    fictitious_times: Annotated[list[Time], Field(min_length=2, max_length=2)] | None = optional(
        "Of `assigned`: when the fictitious knots are, one within the first and one within the last "
        "segment, [s]; in their middles if left out, at the thirds of a single segment."
    )


class SystemInfo(Answer):
    """The tridiagonal system A(h) v = b; A depends on the times alone."""

    matrix: list[list[float]] | None = Field(description="A, [s]; null with more than 32 unknowns.")
    lower: list[float] = Field(description="Its lower diagonal, with A_1N of a periodic one first (else 0), [s].")
    diagonal: list[float] = Field(description="Its diagonal, [s].")
    upper: list[float] = Field(description="Its upper diagonal, with A_N1 of a periodic one last (else 0), [s].")
    right_side: list[list[float]] = Field(description="b, one row per unknown, one column per joint, [rad or m].")
    unknowns: list[int] = Field(description="Whose velocities are unknown, as numbers of `knots`, from 1; no unit.")


class KnotInfo(Answer):
    """State of each joint at a knot."""

    time: float = Field(description="When the knot is passed, [s].")
    positions: list[float] = Field(description="One per joint, [rad or m].")
    velocities: list[float] = Field(description="v, one per joint, [rad/s or m/s].")
    accelerations: list[float] = Field(description="One per joint, [rad/s² or m/s²].")
    fictitious: bool = Field(description="Whether the knot was added for an end acceleration, its position computed.")


class SplineAnswer(MotionAnswer):
    """A cubic spline."""

    boundary: Boundary = Field(description="What holds at its ends.")
    system: SystemInfo | None = Field(description="Null where no velocity is unknown.")
    knots: list[KnotInfo] = Field(description="In order, fictitious ones among them.")
    steps: Steps
    warnings: Warnings


ENDPOINT = Endpoint(
    name="spline",
    path="v1/course/spline",
    tag="Course",
    operation_id="cubic_spline",
    request=SplineRequest,
    answer=SplineAnswer,
    summary="Cubic splines through knots",
    description="""
    The cubic spline through knots, by the tridiagonal system A(h) v = b of the velocities there.

    A, b and v as the lecture writes them, the pieces, velocity and acceleration at the knots, the exact peaks (the
    roots of quadratics), samples, and the worked solution. Several joints share A. With `assigned` velocities and
    accelerations at both ends, two fictitious knots are put in and their positions found. Not-a-knot through three
    knots is the parabola, through two the straight line.

    As a picture of the profiles with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Position, velocity, acceleration and jerk over time, with the limits.",
    example={
        "times": [0.0, 2.0, 3.0, 5.0],
        "waypoints": [0.0, 2.0 * pi, 0.5 * pi, pi],
        "boundary": "clamped",
        "samples": 6,
    },
)
