"""Worked solution of a fly-over, and warnings about unusual cases."""

import math

from gelenk.course.motion.blended_motion import BlendedMotion
from gelenk.course.motion.fly_over import Blend, Given
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import vector
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array

_TEXTS: dict[Given, str] = {
    "blend_time": marked("The time of the blend is given."),
    "distance_before": marked("The distance before B determines the time of the blend."),
    "distance_after": marked("The distance after B determines the time of the blend."),
    "radius": marked("The larger of both distances determines the time of the blend."),
    "max_acceleration": marked("The change of velocity takes at least this time."),
}


def fly_over_steps(blend: Blend, given: Given, value: float, whole: BlendedMotion | None) -> tuple[Step, ...]:
    """Return the worked solution of a blend that a value determined, and of the whole motion if requested."""
    corner = blend.corner
    directions = step(
        _("Directions of the legs"),
        _("Unit vectors along both legs."),
        _direction("K_{AB}", "B - A", corner.corner - corner.start, corner.length_before, corner.direction_before),
        _direction("K_{BC}", "C - B", corner.end - corner.corner, corner.length_after, corner.direction_after),
    )
    ends = step(
        _("Where the blend begins and ends"),
        _("With constant acceleration the mean speed along each leg is half of the speed there."),
        _distance("1", corner.speed_before, blend.time, blend.distance_before, "B - A"),
        _distance("2", corner.speed_after, blend.time, blend.distance_after, "C - B"),
        rf"A' = B - d_1 K_{{AB}} = {vector(blend.entry)}",
        rf"C' = B + d_2 K_{{BC}} = {vector(blend.exit)}",
    )
    closest = step(
        _("Closest to B"),
        _("Where the velocity is perpendicular to the path to B."),
        rf"(p - B) \cdot \dot p = 0 \;\Rightarrow\; t = {tex(blend.closest_time, 's')}, \quad "
        rf"\lVert p - B \rVert = {tex(blend.closest_distance, 'm')}",
    )
    time = step(_("Time of the blend"), _(_TEXTS[given]), rf"\Delta T = {_quotient(blend, given, value)}")
    steps = (directions, time, ends, _parabola(blend), closest)
    return steps if whole is None else (*steps, _whole(whole))


def fly_over_warnings(blend: Blend) -> list[str]:
    """Return warnings about unusual blends: straight, reversed, without duration, or with a speed of 0."""
    corner = blend.corner
    is_straight = corner.turn == "straight"
    turns_back = corner.turn == "reversal" and corner.speed_before > 0.0 and corner.speed_after > 0.0
    texts = {
        _("A, B and C lie on one line: the blend only changes the speed, and passes through B"): is_straight,
        _("BC leads back along AB: the motion stops for a moment before B, and returns without reaching B"): turns_back,
        _("nothing has to change in B: the blend takes no time"): blend.time == 0.0,
        _("v₁ is 0: the blend begins in B itself, at rest"): corner.speed_before == 0.0,
        _("v₂ is 0: the blend ends in B itself, at rest"): corner.speed_after == 0.0,
    }
    return [text for text, applies in texts.items() if applies]


def _direction(symbol: str, leg: str, way: Array, length: float, direction: Array) -> str:
    fraction = rf"\frac{{{leg}}}{{\lVert {leg} \rVert}} = \frac{{{vector(way)}}}{{{tex(length)}}}"
    return rf"{symbol} = {fraction} = {vector(direction)}"


def _quotient(blend: Blend, given: Given, value: float) -> str:
    corner, time, shown = blend.corner, tex(blend.time, "s"), tex(value)
    v1, v2 = corner.speed_before, corner.speed_after
    change = tex(math.hypot(*corner.velocity_change))
    return {
        "blend_time": "",
        "distance_before": rf"\frac{{2 d_1}}{{v_1}} = \frac{{2 \cdot {shown}}}{{{tex(v1)}}} = ",
        "distance_after": rf"\frac{{2 d_2}}{{v_2}} = \frac{{2 \cdot {shown}}}{{{tex(v2)}}} = ",
        "radius": rf"\frac{{2 r}}{{\max(v_1, v_2)}} = \frac{{2 \cdot {shown}}}{{{tex(max(v1, v2))}}} = ",
        "max_acceleration": r"\frac{\lVert v_2 K_{BC} - v_1 K_{AB} \rVert}{a_{max}} = "
        rf"\frac{{{change}}}{{{shown}}} = ",
    }[given] + time


def _distance(index: str, speed: float, time: float, distance: float, leg: str) -> str:
    product = rf"\frac{{v_{index} \Delta T}}{{2}} = \frac{{{tex(speed)} \cdot {tex(time)}}}{{2}}"
    return rf"d_{index} = {product} = {tex(distance, 'm')} \le \lVert {leg} \rVert"


def _parabola(blend: Blend) -> Step:
    corner = blend.corner
    if blend.time == 0.0:
        return step(_("The blend"), _("Nothing changes: both velocities are the same."), r"v_2 K_{BC} = v_1 K_{AB}")
    text = _("A parabola in the plane of A, B and C whose tangents at the ends meet in B.")
    if corner.turn != "corner":
        text = _("All three points lie on one line, and so does the blend.")
        if corner.turn == "reversal" and corner.speed_before > 0.0 < corner.speed_after:
            text += " " + _("BC leads back along AB: the motion stops for a moment before B, and returns.")
    velocity, half = corner.speed_before * corner.direction_before, 0.5 * blend.acceleration
    return step(
        _("The blend"),
        text,
        r"p(t) = A' + v_1 K_{AB}\,t + \frac{v_2 K_{BC} - v_1 K_{AB}}{2 \Delta T}\,t^2 = "
        rf"{vector(blend.entry)} + {vector(velocity)}\,t + {vector(half)}\,t^2",
        rf"\ddot p = \frac{{v_2 K_{{BC}} - v_1 K_{{AB}}}}{{\Delta T}} = {vector(blend.acceleration)}, \quad "
        rf"\lVert \ddot p \rVert = {tex(math.hypot(*blend.acceleration), 'm/s^2')}",
    )


def _whole(whole: BlendedMotion) -> Step:
    return step(
        _("From rest to rest"),
        _(
            "Accelerate, coast, blend, coast, decelerate; beside it the same legs with a stop in B. The blend takes as "
            "long as both distances at full speed, so what is saved is the braking and the accelerating in B."
        ),
        rf"T = {' + '.join(tex(phase.duration) for phase in whole.phases)} = {tex(whole.duration, 's')}",
        rf"T_{{\mathrm{{stop}}}} = {tex(whole.stopping_duration, 's')}",
    )
