"""Fly-over of a corner without a stop: request, answer, operation."""

from typing import Annotated

from pydantic import AfterValidator, Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Steps, Warnings
from gelenk.course.motion.blended_motion import Phase
from gelenk.course.motion.fly_over import Given, Turn
from gelenk.course.motion.fly_over_check import BlendCheck

MAX_SAMPLES = 10_000


def _zero_or_measurable(value: float) -> float:
    if 0.0 < value < 1e-6:
        raise ValueError("a speed is 0, or at least 1e-6 m/s")
    return value


Coordinate = Annotated[float, Field(ge=-1e6, le=1e6)]
Point = Annotated[list[Coordinate], Field(min_length=2, max_length=3)]
Speed = Annotated[float, Field(ge=0.0, le=1e4), AfterValidator(_zero_or_measurable)]
Distance = Annotated[float, Field(ge=1e-9, le=1e7)]
Acceleration = Annotated[float, Field(ge=1e-6, le=1e6)]


class FlyOverRequest(InLanguage):
    """Three points, two speeds, and exactly one of the quantities that determine the blend."""

    start: Point = Field(description="A: x, y and, in space, z, [m].")
    corner: Point = Field(description="B, which is passed without a stop; as many coordinates, [m].")
    end: Point = Field(description="C, likewise, [m].")
    speed_before: Speed = Field(description="v₁ along AB, [m/s]; 0 to begin at rest in B.")
    speed_after: Speed = Field(description="v₂ along BC, [m/s]; 0 to come to rest in B. Not both are 0.")
    blend_time: Annotated[float, Field(ge=1e-6, le=1e6)] | None = optional("ΔT, [s].")
    distance_before: Distance | None = optional("d₁ from where the blend begins to B, [m].")
    distance_after: Distance | None = optional("d₂ from B to where the blend ends, [m].")
    radius: Distance | None = optional("The larger of d₁ and d₂, [m].")
    max_acceleration: Acceleration | None = optional(
        "Constant acceleration in the blend, which is then as short as possible, [m/s²]."
    )
    rest_acceleration: Acceleration | None = optional(
        "For the whole motion from rest in A to rest in C: acceleration with which it begins and ends, "
        "[m/s²]. Without it, the blend alone."
    )
    samples: Annotated[int, Field(ge=2, le=MAX_SAMPLES)] | None = optional(
        "Number of evenly spaced times at which to sample the motion, both ends included, no unit; none if left out."
    )


class FlyOverBlend(Answer):
    """The parabola at the corner."""

    blend_time: float = Field(description="ΔT, [s]; 0 where no velocity has to change.")
    distance_before: float = Field(description="d₁ = v₁ ΔT / 2, [m].")
    distance_after: float = Field(description="d₂ = v₂ ΔT / 2, [m].")
    entry: list[float] = Field(description="A' = B - d₁ K_AB, where it begins, [m].")
    exit: list[float] = Field(description="C' = B + d₂ K_BC, where it ends, [m].")
    direction_before: list[float] = Field(description="K_AB, a unit vector, no unit.")
    direction_after: list[float] = Field(description="K_BC, a unit vector, no unit.")
    turn: Turn = Field(
        description="`corner`; `straight`: a change of speed alone; `reversal`: it slows down, turns before B, returns."
    )
    angle: float = Field(description="Between the two directions, in [0, π], [rad].")
    acceleration: list[float] = Field(description="Constant: (v₂ K_BC - v₁ K_AB) / ΔT, [m/s²].")
    acceleration_norm: float = Field(description="Its magnitude, [m/s²].")
    closest_distance: float = Field(description="Smallest distance to B, [m].")
    closest_time: float = Field(description="Time of that since A', [s].")
    longest_blend_time: float = Field(description="ΔT with which the blend would take all of AB or BC, [s].")


class RestToRestInfo(Answer):
    """The whole motion, from rest in A to rest in C."""

    phases: list[Phase]
    duration: float = Field(description="Of all phases, [s].")
    stopping_duration: float = Field(description="The same with a stop in B, each leg with its own trapezoid, [s].")
    time_saved: float = Field(description="The difference, [s].")


class MotionInfo(Answer):
    """The position as polynomials in time: of the whole motion, or of the blend alone."""

    breaks: list[float] = Field(description="Where the pieces begin and end, [s].")
    coefficients: list[list[list[float]]] = Field(
        description="Of each piece the coefficients of 1, t and t², t since the piece began, each with one number per "
        "coordinate; [m], [m/s], [m/s²]."
    )


class FlyOverSamples(Answer):
    """The motion at evenly spaced times."""

    times: list[float] = Field(description="Since its start, the last one its end, [s].")
    positions: list[list[float]] = Field(description="p(t), [m].")
    velocities: list[list[float]] = Field(description="ṗ(t), [m/s].")
    accelerations: list[list[float]] = Field(description="p̈(t), [m/s²]; where it jumps, that of the later phase.")


class FlyOverAnswer(Answer):
    """A corner passed without a stop."""

    given: Given = Field(description="The quantity that determined the blend.")
    blend: FlyOverBlend
    rest_to_rest: RestToRestInfo | None = Field(description="Null without `rest_acceleration`.")
    motion: MotionInfo | None = Field(description="Null where a blend alone takes no time.")
    samples: FlyOverSamples | None = Field(description="Null if none were requested or there is no motion.")
    steps: Steps
    warnings: Warnings
    certificate: BlendCheck


ENDPOINT = Endpoint(
    name="fly_over",
    path="v1/course/fly-over",
    tag="Course",
    request=FlyOverRequest,
    answer=FlyOverAnswer,
    summary="Fly-over: a corner without a stop",
    description="""
    A corner B on the way A-B-C, passed without a stop along a parabola, at constant acceleration.

    p(t) = A' + v₁ K_AB t + (v₂ K_BC - v₁ K_AB) t² / (2 ΔT) leads in the time ΔT from A' = B - d₁ K_AB to
    C' = B + d₂ K_BC, with d₁ = v₁ ΔT / 2 and d₂ = v₂ ΔT / 2. Give exactly one of `blend_time`, `distance_before`,
    `distance_after`, `radius` and `max_acceleration`. Straight on, the blend is a change of speed; where BC leads
    back along AB it slows down, turns before B, and returns. A blend that is longer than a leg is refused, with
    the largest that fits.

    With `rest_acceleration` the whole motion: from rest in A, a trapezoid of speed whose middle is the blend, to
    rest in C. It is refused where the blend and the ramps overlap. As a picture with `Accept: image/svg+xml`,
    `image/png` or `application/pdf`.
    """,
    picture="The corner in its plane, and the distance covered, the speed and the acceleration over time.",
    example={
        "start": [3.0, 3.0],
        "corner": [1.0, 9.0],
        "end": [8.0, 9.0],
        "speed_before": 1.0,
        "speed_after": 2.0,
        "blend_time": 4.0,
        "samples": 5,
    },
)
