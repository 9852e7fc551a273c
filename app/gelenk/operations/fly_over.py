"""POST /v1/course/fly-over: a corner passed without a stop."""

from typing import Any, get_args

import numpy as np

from gelenk.contract.common import content_of
from gelenk.contract.fly_over import FlyOverBlend, FlyOverRequest, RestToRestInfo
from gelenk.course.motion.blended_motion import BlendedMotion, rest_to_rest
from gelenk.course.motion.fly_over import Blend, Given, blended, corner_of
from gelenk.course.motion.fly_over_check import checked
from gelenk.course.motion.fly_over_steps import fly_over_steps, fly_over_warnings
from gelenk.errors import InvalidField
from gelenk.operations.outcome import Outcome, PictureFormat
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_QUICK_SAMPLES = 500


def run(call: FlyOverRequest) -> Outcome:
    """Compute the blend at a corner, and the whole motion if requested."""
    return Outcome(lambda: _fly_over(call), picture=lambda kind: _picture(call, kind))


def is_heavy(call: FlyOverRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return (call.samples or 0) > _QUICK_SAMPLES


def _planned(call: FlyOverRequest) -> tuple[Given, float, Blend, BlendedMotion | None, PiecewisePolynomial | None]:
    """Return what determines the blend, its value, the blend, the whole motion if requested, and what moves at all."""
    names: tuple[Given, ...] = get_args(Given)
    given = [(name, value) for name in names if (value := getattr(call, name)) is not None]
    if len(given) != 1:
        last = given[-1][0] if given else "blend_time"
        raise InvalidField(last, f"exactly one of {', '.join(names)} is given; here are {len(given)}")
    for field in ("corner", "end"):
        count = len(getattr(call, field))
        if count != len(call.start):
            raise InvalidField(field, f"has {count} coordinates and `start` {len(call.start)}")
    A, B, C = np.array(call.start), np.array(call.corner), np.array(call.end)
    blend = blended(corner_of(A, B, C, call.speed_before, call.speed_after), *given[0])
    if call.rest_acceleration is None:
        return *given[0], blend, None, blend.motion if blend.time > 0.0 else None
    whole = rest_to_rest(blend, call.rest_acceleration)
    return *given[0], blend, whole, whole.motion


def _picture(call: FlyOverRequest, kind: PictureFormat) -> bytes:
    from gelenk.plots.fly_over import fly_over_picture  # noqa: PLC0415

    _, _, blend, whole, motion = _planned(call)
    checked(blend, None if whole is None else whole.motion)
    return fly_over_picture(blend, motion, kind)


def _fly_over(call: FlyOverRequest) -> dict[str, Any]:
    given, value, blend, whole, motion = _planned(call)
    return {
        "given": given,
        "blend": _blend(blend),
        "rest_to_rest": whole
        and content_of(RestToRestInfo, whole, time_saved=whole.stopping_duration - whole.duration),
        "motion": motion,
        "samples": None if motion is None or call.samples is None else _samples(motion, call.samples),
        "steps": fly_over_steps(blend, given, value, whole),
        "warnings": fly_over_warnings(blend),
        "certificate": checked(blend, None if whole is None else whole.motion),
    }


def _blend(blend: Blend) -> dict[str, Any]:
    of_corner = ("direction_before", "direction_after", "turn", "angle", "longest_blend_time")
    return content_of(
        FlyOverBlend,
        blend,
        blend_time=blend.time,
        acceleration_norm=float(np.linalg.norm(blend.acceleration)),
        **{name: getattr(blend.corner, name) for name in of_corner},
    )


def _samples(motion: PiecewisePolynomial, count: int) -> dict[str, Any]:
    times = np.linspace(motion.breaks[0], motion.breaks[-1], count)
    return {
        "times": times,
        "positions": motion.at(times),
        "velocities": motion.derivative().at(times),
        "accelerations": motion.derivative(2).at(times),
    }
