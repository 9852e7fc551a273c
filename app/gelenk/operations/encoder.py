"""POST /v1/course/encoder: resolution of a shaft encoder, and decoding of its signals."""

from typing import Any

from gelenk.contract.encoder import EncoderRequest
from gelenk.course.actuators import encoders
from gelenk.course.actuators.encoders import COUNTS_A_LINE, TURN, required, required_step, resolution, resolution_steps
from gelenk.course.actuators.quadrature import decoded, decoding_step, read_samples
from gelenk.course.steps import Step
from gelenk.errors import InvalidField, counted
from gelenk.operations.outcome import Outcome, PictureFormat

_FIELDS = {
    "incremental": ("pulses_per_revolution", "samples", "counter_bits", "decoding"),
    "absolute": ("bits", "code", "readings", "values", "table"),
}
_QUICK_READINGS = 200
_MOST_MARKED = 8
"""Largest number of readings that an image of a disc shows."""


def run(call: EncoderRequest) -> Outcome:
    """Compute the resolution that an encoder has or needs, and decode its signals."""
    _check(call)
    return Outcome(lambda: _content(call), picture=lambda kind: _picture(call, kind))


def _picture(call: EncoderRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.course.encoders import MOST_TRACKS, disc_figure, tracks_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    if call.type == "incremental":
        if call.samples is None:
            return as_bytes(tracks_figure(), kind)
        samples = read_samples(call.samples, "samples")
        return as_bytes(tracks_figure(samples.states, samples.index), kind)
    bits = call.bits or 0
    if not 1 <= bits <= MOST_TRACKS:
        raise InvalidField("bits", f"an image shows a disc of 1 to {MOST_TRACKS} tracks; here are {bits}")
    read = {found.value for found in _absolute(call, bits, [])["readings"]}
    return as_bytes(disc_figure(bits, call.code, sorted(read)[:_MOST_MARKED]), kind)


def _content(call: EncoderRequest) -> dict[str, Any]:
    counts, how = None, ""
    if call.bits is not None:
        counts, how = 1 << call.bits, rf"2^{{{call.bits}}}"
    elif call.pulses_per_revolution is not None:
        a_line = COUNTS_A_LINE[call.decoding]
        counts, how = call.pulses_per_revolution * a_line, rf"{call.pulses_per_revolution} \cdot {a_line}"
    ratio, period, velocity = call.gear_ratio, call.sample_period, call.motor_angular_velocity
    steps = [] if counts is None else [*resolution_steps(counts, ratio, how, period)]
    needed = None
    if call.wanted_resolution is not None:
        needed = required(call.wanted_resolution, ratio, call.decoding, velocity)
        steps.append(required_step(needed, call.decoding))
    motion = None
    if call.samples is not None:
        samples = read_samples(call.samples, "samples")
        motion = decoded(samples, call.decoding, counts, ratio, call.counter_bits)
        steps.append(decoding_step(motion, counts))
    return {
        "resolution": None if counts is None else resolution(counts, ratio, period, velocity),
        "required": needed,
        "quadrature": motion,
        "absolute": None if call.bits is None else _absolute(call, call.bits, steps),
        "steps": steps,
    }


def is_heavy(call: EncoderRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return len(call.readings or ()) + len(call.values or ()) > _QUICK_READINGS or call.table


def _check(call: EncoderRequest) -> None:
    other = "absolute" if call.type == "incremental" else "incremental"
    for field in _FIELDS[other]:
        # The lines of an incremental encoder are reported for either type.
        counts = field == "decoding" and call.wanted_resolution is not None
        if field in call.model_fields_set and getattr(call, field) not in (None, False) and not counts:
            raise InvalidField(field, f"is only allowed with an encoder of type `{other}`")
    main = "pulses_per_revolution" if call.type == "incremental" else "bits"
    if getattr(call, main) is None:
        if call.wanted_resolution is None and call.samples is None:
            raise InvalidField(main, "is needed, unless `wanted_resolution` asks for it")
        for field in ("sample_period", "readings", "values", "table"):
            if getattr(call, field) not in (None, False):
                raise InvalidField(field, f"needs `{main}`, which is left out")
    if call.counter_bits is not None and call.samples is None:
        raise InvalidField("counter_bits", "needs `samples`, which are missing")


def _absolute(call: EncoderRequest, bits: int, steps: list[Step]) -> dict[str, Any]:
    readings = encoders.read_codes(call.readings or (), call.code, bits, "readings")
    for number, value in enumerate(call.values or ()):
        if value >> bits:
            raise InvalidField(
                f"values/{number}", f"is {value}; numbers of {counted(bits, 'bit')} are below {1 << bits}"
            )
    if call.table and bits > encoders.MOST_TABLE_BITS:
        raise InvalidField(
            "table", f"is written for at most {encoders.MOST_TABLE_BITS} bits; `values` take any position"
        )
    values = [encoders.position(value, bits) for value in call.values or ()]
    if readings:
        steps.append(encoders.reading_step(readings, call.code, bits))
    if values:
        steps.append(encoders.code_step(values))
    going_on = encoders.unwrapped([reading.value for reading in readings], bits)
    travel = TURN * (going_on[-1] - going_on[0]) / (1 << bits) if going_on else None
    return {
        "readings": readings,
        "unwrapped": going_on,
        "motor_travel": travel,
        "load_travel": None if travel is None else travel / call.gear_ratio,
        "values": values,
        "table": encoders.table(bits) if call.table else None,
    }
