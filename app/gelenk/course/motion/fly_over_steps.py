"""Worked solution of a fly-over, and warnings about unusual cases."""

import math

from gelenk.course.motion.blended_motion import BlendedMotion
from gelenk.course.motion.fly_over import Blend, Given
from gelenk.course.steps import Step, tex
from gelenk.robot.arrays import Array


def fly_over_steps(blend: Blend, given: Given, value: float, whole: BlendedMotion | None) -> tuple[Step, ...]:
    """Return the worked solution.

    Args:
        blend: The blend that was found.
        given: The quantity that determined it.
        value: Value of that quantity.
        whole: The motion around it, if requested.
    """
    steps = [_directions(blend), _time(blend, given, value), _ends(blend), _parabola(blend), _closest(blend)]
    if whole is not None:
        steps.append(_whole(whole))
    return tuple(steps)


def fly_over_warnings(blend: Blend) -> list[str]:
    """Return warnings about unusual blends: straight, reversed, without duration, or with a speed of 0."""
    warnings, corner = [], blend.corner
    if corner.turn == "straight":
        warnings.append("A, B and C lie on one line: the blend only changes the speed, and passes through B")
    if corner.turn == "reversal" and corner.speed_before > 0.0 and corner.speed_after > 0.0:
        warnings.append(
            "BC leads back along AB: the motion stops for a moment before B, and returns without reaching B"
        )
    if blend.time == 0.0:
        warnings.append("nothing has to change in B: the blend takes no time")
    if corner.speed_before == 0.0:
        warnings.append("v₁ is 0: the blend begins in B itself, at rest")
    if corner.speed_after == 0.0:
        warnings.append("v₂ is 0: the blend ends in B itself, at rest")
    return warnings


def _directions(blend: Blend) -> Step:
    corner = blend.corner
    return Step(
        "Directions of the legs",
        "Unit vectors along both legs.",
        (
            _direction("K_{AB}", "B - A", corner.corner - corner.start, corner.length_before, corner.direction_before),
            _direction("K_{BC}", "C - B", corner.end - corner.corner, corner.length_after, corner.direction_after),
        ),
    )


def _direction(symbol: str, leg: str, vector: Array, length: float, direction: Array) -> str:
    return (
        rf"{symbol} = \frac{{{leg}}}{{\lVert {leg} \rVert}} = \frac{{{_vector(vector)}}}{{{tex(length)}}} = "
        rf"{_vector(direction)}"
    )


def _time(blend: Blend, given: Given, value: float) -> Step:
    corner, found, shown = blend.corner, tex(blend.time), tex(value)
    change = math.hypot(*corner.velocity_change)
    formulas = {
        "blend_time": rf"\Delta T = {found}\,\mathrm{{s}}",
        "distance_before": rf"\Delta T = \frac{{2 d_1}}{{v_1}} = \frac{{2 \cdot {shown}}}{{{tex(corner.speed_before)}}}"
        rf" = {found}\,\mathrm{{s}}",
        "distance_after": rf"\Delta T = \frac{{2 d_2}}{{v_2}} = \frac{{2 \cdot {shown}}}{{{tex(corner.speed_after)}}}"
        rf" = {found}\,\mathrm{{s}}",
        "radius": rf"\Delta T = \frac{{2 r}}{{\max(v_1, v_2)}} = \frac{{2 \cdot {shown}}}"
        rf"{{{tex(max(corner.speed_before, corner.speed_after))}}} = {found}\,\mathrm{{s}}",
        "max_acceleration": rf"\Delta T = \frac{{\lVert v_2 K_{{BC}} - v_1 K_{{AB}} \rVert}}{{a_{{max}}}} = "
        rf"\frac{{{tex(change)}}}{{{shown}}} = {found}\,\mathrm{{s}}",
    }
    texts = {
        "blend_time": "The time of the blend is given.",
        "distance_before": "The distance before B determines the time of the blend.",
        "distance_after": "The distance after B determines the time of the blend.",
        "radius": "The larger of both distances determines the time of the blend.",
        "max_acceleration": "The change of velocity takes at least this time.",
    }
    return Step("Time of the blend", texts[given], (formulas[given],))


def _ends(blend: Blend) -> Step:
    corner = blend.corner
    return Step(
        "Where the blend begins and ends",
        "With constant acceleration the mean speed along each leg is half of the speed there.",
        (
            _distance("1", corner.speed_before, blend.time, blend.distance_before, "B - A"),
            _distance("2", corner.speed_after, blend.time, blend.distance_after, "C - B"),
            rf"A' = B - d_1 K_{{AB}} = {_vector(blend.entry)}",
            rf"C' = B + d_2 K_{{BC}} = {_vector(blend.exit)}",
        ),
    )


def _distance(index: str, speed: float, time: float, distance: float, leg: str) -> str:
    return (
        rf"d_{index} = \frac{{v_{index} \Delta T}}{{2}} = \frac{{{tex(speed)} \cdot {tex(time)}}}{{2}} = "
        rf"{tex(distance)}\,\mathrm{{m}} \le \lVert {leg} \rVert"
    )


def _parabola(blend: Blend) -> Step:
    corner = blend.corner
    if blend.time == 0.0:
        return Step("The blend", "Nothing changes: both velocities are the same.", (r"v_2 K_{BC} = v_1 K_{AB}",))
    text = "A parabola in the plane of A, B and C whose tangents at the ends meet in B."
    if corner.turn != "corner":
        text = "All three points lie on one line, and so does the blend."
    position = (
        r"p(t) = A' + v_1 K_{AB}\,t + \frac{v_2 K_{BC} - v_1 K_{AB}}{2 \Delta T}\,t^2 = "
        rf"{_vector(blend.entry)} + {_vector(corner.speed_before * corner.direction_before)}\,t + "
        rf"{_vector(0.5 * blend.acceleration)}\,t^2"
    )
    acceleration = (
        rf"\ddot p = \frac{{v_2 K_{{BC}} - v_1 K_{{AB}}}}{{\Delta T}} = {_vector(blend.acceleration)}, \quad "
        rf"\lVert \ddot p \rVert = {tex(math.hypot(*blend.acceleration))}\,\mathrm{{m/s^2}}"
    )
    return Step("The blend", text, (position, acceleration))


def _closest(blend: Blend) -> Step:
    formula = (
        rf"(p - B) \cdot \dot p = 0 \;\Rightarrow\; t = {tex(blend.closest_time)}\,\mathrm{{s}}, \quad "
        rf"\lVert p - B \rVert = {tex(blend.closest_distance)}\,\mathrm{{m}}"
    )
    return Step("Closest to B", "Where the velocity is perpendicular to the path to B.", (formula,))


def _whole(whole: BlendedMotion) -> Step:
    durations = " + ".join(tex(phase.duration) for phase in whole.phases)
    return Step(
        "From rest to rest",
        "Accelerate, coast, blend, coast, decelerate; beside it the same legs with a stop in B. The blend takes as "
        "long as both distances at full speed, so what is saved is the braking and the accelerating in B.",
        (
            rf"T = {durations} = {tex(whole.duration)}\,\mathrm{{s}}",
            rf"T_{{\mathrm{{stop}}}} = {tex(whole.stopping_duration)}\,\mathrm{{s}}",
        ),
    )


def _vector(values: Array) -> str:
    return "(" + r",\; ".join(tex(float(value)) for value in values) + ")"
