"""A straight line without a robot: request, answer, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.course_motion import Bound, Coordinate, Duration, PeakInfo, SampleTimesRequest
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import Steps, Warnings
from gelenk.contract.orientation import OrientationPayload
from gelenk.contract.time_law import ProfileInfo
from gelenk.course.cartesian.line import AxesComparison
from gelenk.course.motion.check import MotionCertificate
from gelenk.trajectory.audit.words import PolynomialLaw

LinePoint = Annotated[list[Coordinate], Field(min_length=2, max_length=3)]
EndSpeed = Annotated[float, Field(ge=0.0, le=1e6)]
_AxisBounds = Annotated[list[Bound], Field(min_length=2, max_length=3)]


class LineRequest(SampleTimesRequest):
    """Two points, and the law of time between them."""

    start: LinePoint = Field(description="p_i: x, y and, in space, z, [m].")
    target: LinePoint = Field(description="p_f, as many coordinates, [m].")
    law: Literal["trapezoidal", PolynomialLaw] = Field(
        default="trapezoidal",
        description="Of σ, the distance covered: `trapezoidal` is bang-coast-bang within `velocity` and "
        "`acceleration`; a polynomial takes `duration`.",
    )
    velocity: Bound | None = optional("v, the largest speed, > 0, [m/s]; none if left out.")
    acceleration: Bound | None = optional("a, of bang-coast-bang, > 0, [m/s²].")
    axis_velocity: _AxisBounds | None = optional(
        "Instead of `velocity`: of each axis of a PPP robot, one number per coordinate, > 0, [m/s]."
    )
    axis_acceleration: _AxisBounds | None = optional("Instead of `acceleration`, likewise, > 0, [m/s²].")
    start_velocity: EndSpeed = Field(default=0.0, description="σ̇ at p_i, ≥ 0, [m/s].")
    end_velocity: EndSpeed = Field(default=0.0, description="σ̇ at p_f, ≥ 0, [m/s].")
    duration: Duration | None = optional("T, [s]. Of bang-coast-bang: the shortest if left out.")
    may_reverse: bool = Field(
        default=False, description="Whether bang-coast-bang may go beyond p_f and come back where it cannot brake."
    )
    start_orientation: OrientationPayload | None = optional("R_i, in any notation; together with `target_orientation`.")
    target_orientation: OrientationPayload | None = optional("R_f, likewise.")


class SigmaInfo(Answer):
    """σ(t) as polynomials: Σ c_k (t - t_i)ᵏ from t_i to the next break."""

    breaks: list[float] = Field(description="Where the pieces begin and end, [s].")
    coefficients: list[list[float]] = Field(description="One row per piece, lowest power first, [m per sᵏ].")
    peak_velocity: PeakInfo = Field(description="Of σ̇, [m/s].")
    peak_acceleration: PeakInfo = Field(description="Of σ̈, [m/s²].")


class LineSamples(Answer):
    """The motion at the requested times; accelerations that jump are those after the jump."""

    times: list[float] = Field(description="From the start on, [s].")
    sigma: list[float] = Field(description="σ, [m].")
    sigma_velocity: list[float] = Field(description="σ̇, [m/s].")
    sigma_acceleration: list[float] = Field(description="σ̈, [m/s²].")
    s: list[float] = Field(description="σ/L, from 0 to 1, no unit; where L = 0, that of the orientation.")
    positions: list[list[float]] = Field(description="p, [m].")
    velocities: list[list[float]] = Field(description="ṗ = (p_f - p_i)/L σ̇, [m/s].")
    accelerations: list[list[float]] = Field(description="p̈ = (p_f - p_i)/L σ̈, [m/s²].")


class TurnSamples(Answer):
    """Orientations at the times of the samples, one of the two ways."""

    rotations: list[list[list[float]]] = Field(description="R, row by row, no unit.")
    angular_velocities: list[list[float]] = Field(description="ω in the base frame, [rad/s].")
    angular_accelerations: list[list[float]] = Field(description="ω̇ in the base frame, [rad/s²].")


class LineTurn(Answer):
    """The orientation along the line, in proportion to s, planned in both ways."""

    axis: list[float] | None = Field(description="r in the frame R_i, no unit; null where θ = 0.")
    base_axis: list[float] | None = Field(description="R_i r, the same axis in the base frame, no unit.")
    other_axis: list[float] | None = Field(description="The opposite axis, as good where θ = π, no unit; else null.")
    angle: float = Field(description="θ in [0, π], of R_iᵀ R_f = Rot(r, θ), [rad].")
    peak_angular_velocity: list[float] = Field(description="ω about the axis where it is largest, base frame, [rad/s].")
    zyz_start: list[float] = Field(description="φ, θ, ψ of R_i, [rad].")
    zyz_target: list[float] = Field(description="Of R_f, nearest to them, [rad].")
    middle: list[list[float]] = Field(description="R at s = 1/2 about the axis, no unit.")
    zyz_middle: list[list[float]] = Field(description="R at s = 1/2 by Euler angles, no unit.")
    middle_difference: float = Field(description="Angle between these two, [rad].")
    about_axis: TurnSamples
    by_angles: TurnSamples
    max_rotation_error: float = Field(
        description="Largest entry by which orientations differ from Rodrigues' formula, from products of elementary "
        "rotations, and at the ends from those given; no unit."
    )


class LineAnswer(Answer):
    """A motion along a straight line."""

    length: float = Field(description="L = ‖p_f - p_i‖, [m].")
    direction: list[float] | None = Field(description="K, a unit vector, no unit; null where L = 0.")
    duration: float = Field(description="T, [s].")
    profile: ProfileInfo | None = Field(description="Bang-coast-bang of σ; null with a polynomial.")
    sigma: SigmaInfo
    samples: LineSamples
    axes: AxesComparison | None = Field(description="With `axis_acceleration`; null without.")
    orientation: LineTurn | None = Field(description="Null without orientations.")
    steps: Steps
    warnings: Warnings
    certificate: MotionCertificate


ENDPOINT = Endpoint(
    name="line",
    path="v1/course/line",
    tag="Course",
    request=LineRequest,
    answer=LineAnswer,
    summary="A straight line with bang-coast-bang, without a robot",
    description="""
    A straight line p(s) = p_i + s (p_f - p_i), s = σ/L, with a law of time on σ, and its worked solution.

    Bang-coast-bang: T_s = v/a and T = (La + v²)/(av) where L > v²/a, else T_s = √(L/a) and T = 2 T_s; also with end
    velocities, or in a given `duration`. Along the line ṗ = (p_f - p_i)/L σ̇ and p̈ = (p_f - p_i)/L σ̈, for d²p/ds² = 0.
    Where both points are the same, nothing moves: T = 0.

    No motion from rest to rest within the same speed and acceleration is quicker. With `axis_velocity` and
    `axis_acceleration`, limits of each axis of a PPP robot, the answer says whether that holds for the line too.

    With two orientations the answer has both ways of the course: about one axis, R(t) = R_i Rot(r, s θ), and by Euler
    angles ZYZ. Where L = 0, an orientation changes by a polynomial `law` in `duration`.

    As a picture of σ, σ̇ and σ̈ with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="The distance covered, its speed and its acceleration over time, with the limits.",
    example={
        "start": [0.4, -0.2, 0.3],
        "target": [0.6, 0.5, 0.1],
        "velocity": 0.5,
        "acceleration": 1.0,
        "samples": 5,
    },
)
