"""Shaft encoders: request, answer, operation."""

from typing import Annotated, Any, Literal

from pydantic import Field

from gelenk.contract.common import Answer, Payload
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.quantities import Ratio, Steps
from gelenk.course.actuators.encoders import TURN, Decoding
from gelenk.course.actuators.gray import Code
from gelenk.course.actuators.quadrature import Direction

MAX_READINGS = 10_000
MAX_BITS = 32

Reading = Annotated[str, Field(max_length=MAX_BITS)]


class EncoderRequest(Payload):
    """An encoder on the motor's shaft, or the resolution for which one is wanted."""

    type: Literal["incremental", "absolute"] = Field(description="Two channels and a counter, or a code disc.")
    gear_ratio: Ratio = Field(default=1.0, description="N = ω_motor / ω_load, no unit.")
    sample_period: Annotated[float, Field(ge=1e-12, le=1e6)] | None = Field(
        default=None, description="T_s over which counts are read as a speed, [s]; requests the velocity quantum."
    )
    motor_angular_velocity: Annotated[float, Field(ge=-1e9, le=1e9)] | None = Field(
        default=None, description="Speed of the motor, [rad/s]; requests the count rate."
    )
    wanted_resolution: Annotated[float, Field(ge=1e-12, le=TURN)] | None = Field(
        default=None, description="Smallest angle to resolve at the load, [rad]; requests the encoder needed."
    )
    decoding: Decoding = Field(
        default="x4",
        description="Counts per line of an incremental encoder; of an absolute one only with `wanted_resolution`.",
    )

    pulses_per_revolution: Annotated[int, Field(ge=1, le=10_000_000)] | None = Field(
        default=None, description="Lines of an incremental encoder, no unit."
    )
    samples: Annotated[str, Field(max_length=300_000)] | None = Field(
        default=None,
        description='Samples of an incremental encoder\'s channels A and B, such as "00 10 11 01": A leads forward. '
        "With a third digit also of the index channel Z.",
    )
    counter_bits: Annotated[int, Field(ge=1, le=64)] | None = Field(
        default=None, description="Width of the counter, no unit; requests its reading with wrap-around."
    )

    bits: Annotated[int, Field(ge=1, le=MAX_BITS)] | None = Field(
        default=None, description="Tracks of an absolute encoder, no unit."
    )
    code: Code = Field(default="gray", description="Code of an absolute encoder's disc, and so of `readings`.")
    readings: Annotated[list[Reading], Field(max_length=MAX_READINGS, fail_fast=True)] | None = Field(
        default=None, description='Codes as read from an absolute encoder, `bits` digits each, such as "0110".'
    )
    values: (
        Annotated[list[Annotated[int, Field(ge=0, lt=1 << MAX_BITS)]], Field(max_length=MAX_READINGS, fail_fast=True)]
        | None
    ) = Field(default=None, description="Numbers below 2^bits, no unit, to be written in both codes.")
    table: bool = Field(default=False, description="Whether to list all positions of an absolute encoder of ≤ 8 bits.")


class ResolutionInfo(Answer):
    """Size of one count."""

    counts_per_revolution: int = Field(description="Of the motor, no unit.")
    motor: float = Field(description="Angle of a count at the motor, [rad].")
    load: float = Field(description="Angle of a count at the load, [rad].")
    motor_velocity_quantum: float | None = Field(
        description="2π / (counts · T_s): one count more in a sample period, at the motor, [rad/s]; null without T_s."
    )
    load_velocity_quantum: float | None = Field(description="The same at the load, [rad/s].")
    count_rate: float | None = Field(description="Counts per second at the given speed, [1/s]; null without one.")


class RequiredInfo(Answer):
    """The coarsest encoder with the wanted resolution."""

    motor_resolution: float = Field(description="The wanted resolution at the motor, [rad].")
    counts_per_revolution: int = Field(description="Of the motor, no unit.")
    bits: int = Field(description="Of an absolute encoder, no unit.")
    pulses_per_revolution: int = Field(description="Lines of an incremental one with this decoding, no unit.")
    count_rate: float | None = Field(
        description="With exactly these counts, at the given speed, [1/s]; null without one."
    )


class IndexPulseInfo(Answer):
    """A rise of channel Z: the shaft is at the same angle each time."""

    sample: int = Field(description="Sample at which it rises, from 0.")
    count: int = Field(description="The count there, no unit.")
    count_error: int | None = Field(
        description="How far the count since the first pulse is from whole turns: counts that were lost, or the width "
        "of the pulse where the direction has changed. No unit; null without `pulses_per_revolution`."
    )


class QuadratureInfo(Answer):
    """Motion decoded from the samples of A and B."""

    count: int = Field(description="Of the last sample, from 0 at the first one; no unit.")
    counts: list[int] = Field(description="At each sample, no unit.")
    direction: Direction = Field(description="Of the count.")
    reversals: int = Field(description="How often the motion changes its direction.")
    illegal_transitions: list[int] = Field(
        description="Samples, from 0, at which both channels have changed: a sample between was missed, and two "
        "quarters of a line in an unknown direction are lost. They count nothing."
    )
    motor_angle: float | None = Field(description="Since the first sample, [rad]; null without lines.")
    load_angle: float | None = Field(description="The same at the load, [rad].")
    motor_angle_in_turn: float | None = Field(description="motor_angle in [0, 2π), [rad].")
    register_value: int | None = Field(description="Of a counter of `counter_bits`, no unit; null without them.")
    index_pulses: list[IndexPulseInfo] = Field(description="Of channel Z; none where it was not read.")
    count_from_index: int | None = Field(
        description="Count since the last index pulse: from here on the angle is absolute. No unit; null without one."
    )


class CodeInfo(Answer):
    """A position of an absolute encoder."""

    value: int = Field(description="Number of the position, no unit.")
    binary: str = Field(description="In binary digits.")
    gray: str = Field(description="In Gray code.")
    angle: float = Field(description="Of the motor, in [0, 2π), [rad].")


class AbsoluteInfo(Answer):
    """Readings and codes of an absolute encoder."""

    readings: list[CodeInfo] = Field(description="One entry per reading.")
    unwrapped: list[int] = Field(
        description="The readings' numbers, counted on across the end of a turn, each step the shorter way; no unit."
    )
    motor_travel: float | None = Field(description="From the first to the last reading, [rad]; null without readings.")
    load_travel: float | None = Field(description="The same at the load, [rad].")
    values: list[CodeInfo] = Field(description="One entry per value.")
    table: list[CodeInfo] | None = Field(description="All positions; null if not requested.")


class EncoderAnswer(Answer):
    """Resolution, counts and codes of an encoder."""

    resolution: ResolutionInfo | None = Field(description="Null when only the required encoder is requested.")
    required: RequiredInfo | None = Field(description="Null without `wanted_resolution`.")
    quadrature: QuadratureInfo | None = Field(description="Null without `samples`.")
    absolute: AbsoluteInfo | None = Field(description="Null for an incremental encoder, or without `bits`.")
    steps: Steps


EXAMPLE_ENCODER: dict[str, Any] = {
    "type": "incremental",
    "pulses_per_revolution": 1024,
    "decoding": "x4",
    "gear_ratio": 50.0,
    "sample_period": 0.001,
    "samples": "00 10 11 01 00 10 11 10",
}


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
    """,
    example=EXAMPLE_ENCODER,
)
