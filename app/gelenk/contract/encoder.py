"""Shaft encoders: request, answer, operation."""

from typing import Annotated, Literal

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.options import InLanguage, Ratio, Steps
from gelenk.course.actuators.encoders import TURN, Code, Decoding, DiscPosition, EncoderResolution, RequiredEncoder
from gelenk.course.actuators.quadrature import Quadrature

MAX_READINGS = 10_000
MAX_BITS = 32

Reading = Annotated[str, Field(max_length=MAX_BITS)]


class EncoderRequest(InLanguage):
    """An encoder on the motor's shaft, or the resolution for which one is wanted."""

    type: Literal["incremental", "absolute"] = Field(description="Two channels and a counter, or a code disc.")
    gear_ratio: Ratio = Field(default=1.0, description="N = ω_motor / ω_load, no unit.")
    sample_period: Annotated[float, Field(ge=1e-12, le=1e6)] | None = optional(
        "T_s over which counts are read as a speed, [s]; requests the velocity quantum."
    )
    motor_angular_velocity: Annotated[float, Field(ge=-1e9, le=1e9)] | None = optional(
        "Speed of the motor, [rad/s]; requests the count rate."
    )
    wanted_resolution: Annotated[float, Field(ge=1e-12, le=TURN)] | None = optional(
        "Smallest angle to resolve at the load, [rad]; requests the encoder needed."
    )
    decoding: Decoding = Field(
        default="x4",
        description="Counts per line of an incremental encoder; of an absolute one only with `wanted_resolution`.",
    )

    pulses_per_revolution: Annotated[int, Field(ge=1, le=10_000_000)] | None = optional(
        "Lines of an incremental encoder, no unit."
    )
    samples: Annotated[str, Field(max_length=300_000)] | None = optional(
        'Samples of an incremental encoder\'s channels A and B, such as "00 10 11 01": A leads forward. '
        "With a third digit also of the index channel Z."
    )
    counter_bits: Annotated[int, Field(ge=1, le=64)] | None = optional(
        "Width of the counter, no unit; requests its reading with wrap-around."
    )

    bits: Annotated[int, Field(ge=1, le=MAX_BITS)] | None = optional("Tracks of an absolute encoder, no unit.")
    code: Code = Field(default="gray", description="Code of an absolute encoder's disc, and so of `readings`.")
    readings: Annotated[list[Reading], Field(max_length=MAX_READINGS, fail_fast=True)] | None = optional(
        'Codes as read from an absolute encoder, `bits` digits each, such as "0110".'
    )
    values: (
        Annotated[list[Annotated[int, Field(ge=0, lt=1 << MAX_BITS)]], Field(max_length=MAX_READINGS, fail_fast=True)]
        | None
    ) = optional("Numbers below 2^bits, no unit, to be written in both codes.")
    table: bool = Field(default=False, description="Whether to list all positions of an absolute encoder of ≤ 8 bits.")


class AbsoluteInfo(Answer):
    """Readings and codes of an absolute encoder."""

    readings: list[DiscPosition] = Field(description="One entry per reading.")
    unwrapped: list[int] = Field(
        description="The readings' numbers, counted on across the end of a turn, each step the shorter way; no unit."
    )
    motor_travel: float | None = Field(description="From the first to the last reading, [rad]; null without readings.")
    load_travel: float | None = Field(description="The same at the load, [rad].")
    values: list[DiscPosition] = Field(description="One entry per value.")
    table: list[DiscPosition] | None = Field(description="All positions; null if not requested.")


class EncoderAnswer(Answer):
    """Resolution, counts and codes of an encoder."""

    resolution: EncoderResolution | None = Field(description="Null when only the required encoder is requested.")
    required: RequiredEncoder | None = Field(description="Null without `wanted_resolution`.")
    quadrature: Quadrature | None = Field(description="Null without `samples`.")
    absolute: AbsoluteInfo | None = Field(description="Null for an incremental encoder, or without `bits`.")
    steps: Steps


ENDPOINT = Endpoint(
    name="encoder",
    path="v1/course/encoder",
    tag="Course",
    request=EncoderRequest,
    answer=EncoderAnswer,
    summary="Encoder: resolution, decoding, Gray code",
    description="""
    An incremental or absolute encoder on the motor's shaft, perhaps before a gear.

    Resolution at motor and load, 2π / (lines · 1, 2 or 4) or 2π / 2^bits; the velocity quantum of a sample period;
    lines and bits needed for a resolution at the load. Samples of the channels A and B are decoded: counts,
    direction, transitions that cannot be (both channels change), angle across whole turns, and with the channel Z
    where the shaft passes its index. Codes of an absolute encoder are decoded, encoded and tabulated in binary and
    Gray.

    x4 counts each edge, x2 those of A, x1 the edge of A while B is 0; all of them come back to the same count when
    the shaft does. Required counts are rounded up before bits and lines are, so a line count times the decoding
    may be a little more than the counts required.

    As a picture with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Channels A, B and Z of an incremental encoder, of its `samples` if given; the disc of an absolute one.",
    example={
        "type": "incremental",
        "pulses_per_revolution": 1024,
        "decoding": "x4",
        "gear_ratio": 50.0,
        "sample_period": 0.001,
        "samples": "00 10 11 01 00 10 11 10",
    },
)
