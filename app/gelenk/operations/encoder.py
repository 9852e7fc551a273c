"""POST /v1/course/encoder: resolution of a shaft encoder, and decoding of its signals."""

from dataclasses import asdict
from typing import Any

from gelenk.contract.encoder import EncoderRequest
from gelenk.course.actuators import gray, quadrature
from gelenk.course.actuators.encoders import COUNTS_A_LINE, TURN, Scale, required, required_step, scale_steps
from gelenk.course.steps import Step, tex
from gelenk.errors import InvalidField, counted
from gelenk.operations.outcome import Outcome

_FIELDS = {
    "incremental": ("pulses_per_revolution", "samples", "counter_bits", "decoding"),
    "absolute": ("bits", "code", "readings", "values", "table"),
}
_QUICK_READINGS = 200


def run(call: EncoderRequest) -> Outcome:
    """Compute the resolution that an encoder has or needs, and decode its signals."""
    return Outcome(lambda: _encoder(call))


def is_heavy(call: EncoderRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return len(call.readings or ()) + len(call.values or ()) > _QUICK_READINGS or call.table


def _encoder(call: EncoderRequest) -> dict[str, Any]:
    _check(call)
    steps: list[Step] = []
    scale = _scale(call)
    if scale is not None:
        how = rf"2^{{{call.bits}}}"
        if call.bits is None:
            how = rf"{call.pulses_per_revolution} \cdot {COUNTS_A_LINE[call.decoding]}"
        steps += scale_steps(scale, how)
        if call.sample_period is not None:
            steps.append(_velocity_step(scale, call.sample_period))
    needed = None
    if call.wanted_resolution is not None:
        found = required(call.wanted_resolution, call.gear_ratio, call.decoding)
        steps.append(required_step(found, call.decoding))
        needed = {**asdict(found), "count_rate": _count_rate(call, Scale(found.counts_per_revolution, call.gear_ratio))}
    absolute = None if call.bits is None else _absolute(call, call.bits, steps)
    return {
        "resolution": None if scale is None else _resolution(call, scale),
        "required": needed,
        "quadrature": None if call.samples is None else _quadrature(call, call.samples, scale),
        "absolute": absolute,
        "steps": [asdict(step) for step in steps],
    }


def _check(call: EncoderRequest) -> None:
    """Refuse combinations of fields that exclude each other."""
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


def _scale(call: EncoderRequest) -> Scale | None:
    if call.bits is not None:
        return Scale(1 << call.bits, call.gear_ratio)
    if call.pulses_per_revolution is not None:
        return Scale(call.pulses_per_revolution * COUNTS_A_LINE[call.decoding], call.gear_ratio)
    return None


def _resolution(call: EncoderRequest, scale: Scale) -> dict[str, Any]:
    quantum = None if call.sample_period is None else scale.velocity_quantum(call.sample_period)
    return {
        "counts_per_revolution": scale.counts_per_revolution,
        "motor": scale.motor_resolution,
        "load": scale.load_resolution,
        "motor_velocity_quantum": quantum,
        "load_velocity_quantum": None if quantum is None else quantum / call.gear_ratio,
        "count_rate": _count_rate(call, scale),
    }


def _count_rate(call: EncoderRequest, scale: Scale) -> float | None:
    return None if call.motor_angular_velocity is None else scale.count_rate(call.motor_angular_velocity)


def _velocity_step(scale: Scale, period: float) -> Step:
    numbers, quantum = rf"{scale.counts_per_revolution} \cdot {tex(period)}", tex(scale.velocity_quantum(period))
    return Step(
        "Velocity quantum",
        "Speed as counts in a sample period is a multiple of one count in one period.",
        (rf"\Delta\omega = \frac{{2\pi}}{{n\,T_s}} = \frac{{2\pi}}{{{numbers}}} = {quantum}\,\mathrm{{rad/s}}",),
    )


def _quadrature(call: EncoderRequest, text: str, scale: Scale | None) -> dict[str, Any]:
    cpr = None if scale is None else scale.counts_per_revolution
    found = quadrature.decoded(quadrature.read_samples(text, "samples"), call.decoding, cpr)
    count = int(found.counts[-1])
    angle = None if cpr is None else TURN * count / cpr
    return {
        "count": count,
        "counts": found.counts,
        "direction": found.direction,
        "reversals": found.reversals,
        "illegal_transitions": found.illegal,
        "motor_angle": angle,
        "load_angle": None if angle is None else angle / call.gear_ratio,
        "motor_angle_in_turn": None if cpr is None else TURN * (count % cpr) / cpr,
        "register_value": None if call.counter_bits is None else quadrature.register(count, call.counter_bits),
        "index_pulses": [asdict(pulse) for pulse in found.pulses],
        "count_from_index": count - found.pulses[-1].count if found.pulses else None,
    }


def _absolute(call: EncoderRequest, bits: int, steps: list[Step]) -> dict[str, Any]:
    readings = gray.read_codes(call.readings or (), call.code, bits, "readings")
    for number, value in enumerate(call.values or ()):
        if value >> bits:
            raise InvalidField(
                f"values/{number}", f"is {value}; numbers of {counted(bits, 'bit')} are below {1 << bits}"
            )
    if call.table and bits > gray.MOST_TABLE_BITS:
        raise InvalidField("table", f"is written for at most {gray.MOST_TABLE_BITS} bits; `values` take any position")
    values = [gray.position(value, bits) for value in call.values or ()]
    if readings or values:
        steps.append(gray.code_step((*readings, *values)[0]))
    going_on = gray.unwrapped([reading.value for reading in readings], bits)
    travel = TURN * (going_on[-1] - going_on[0]) / (1 << bits) if going_on else None
    return {
        "readings": [asdict(reading) for reading in readings],
        "unwrapped": going_on,
        "motor_travel": travel,
        "load_travel": None if travel is None else travel / call.gear_ratio,
        "values": [asdict(value) for value in values],
        "table": [asdict(row) for row in gray.table(bits)] if call.table else None,
    }
