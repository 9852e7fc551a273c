"""Worked steps of a trajectory's segments: the law with its numbers, lines and arcs along s = σ/L, corners."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.course.cartesian.line_steps import sigma_pieces
from gelenk.course.motion.time_law_steps import SHOWN_JOINTS, tex_row
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.laws.trapezoid import JointMove, fastest
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.curves import Arc

_MOST_PIECES = 7
_SAME = 1e-6
_NOTHING = 1e-12
_SHAPES: dict[Law, str] = {
    "cubic": r"s(\lambda) = 3 \lambda^2 - 2 \lambda^3",
    "quintic": r"s(\lambda) = 10 \lambda^3 - 15 \lambda^4 + 6 \lambda^5",
    "septic": r"s(\lambda) = 35 \lambda^4 - 84 \lambda^5 + 70 \lambda^6 - 20 \lambda^7",
}


@dataclass(frozen=True, slots=True)
class JointTask:
    """A motion of all joints from rest to rest.

    Attributes:
        start, target: Shape (n,), [rad or m].
        limits: Of velocity, acceleration and jerk; shape (n,) each.
        duration: T of the motion as planned, [s].
    """

    start: Array
    target: Array
    limits: tuple[Array, Array, Array]
    duration: float


def joint_steps(task: JointTask, law: Law) -> tuple[Step, ...]:
    """Return how the slowest joint sets the time, and how the others keep in step."""
    delta = task.target - task.start
    way = step(
        _("All joints together"),
        _("From rest to rest, all joints start and end together."),
        rf"q_i = ({tex_row(task.start)})",
        rf"\Delta q = ({tex_row(delta)})",
    )
    if law in _SHAPES:
        return way, _polynomial(task, law, delta)
    if law == "trapezoidal":
        return way, *_trapezoids(task, delta)
    return way, step(_("Time law"), _("The fastest motion within the limits."), rf"T = {tex(task.duration, 's')}")


def moving_step(states: Sequence[Sequence[Array]], duration: float) -> Step:
    """Return the conditions of a motion whose ends move: positions, (n,), and rates at both, and its duration, [s]."""
    formulas = [
        rf"{name}({time}) = ({tex_row(row)})"
        for time, state in zip(("0", "T"), states, strict=True)
        for name, row in zip(("q", r"\dot q", r"\ddot q"), state, strict=False)
    ]
    text = _("At its ends the joints have the velocities and accelerations that are given there.")
    return step(_("From state to state"), text, *formulas, rf"T = {tex(duration, 's')}")


def _least_text(least: float, duration: float) -> str:
    if duration <= least * (1.0 + _SAME):
        return _("The slowest joint sets the time for all.")
    return _("It takes longer than the joints need: a duration is given, or the tip has limits of its own.")


def _polynomial(task: JointTask, law: Law, delta: Array) -> Step:
    formulas, times = [], [0.0]
    for order, (peak, limits) in enumerate(zip(LAWS[law].peaks, task.limits, strict=False), start=1):
        needed = (peak * np.abs(delta) / limits) ** (1.0 / order)
        j = int(needed.argmax())
        times.append(float(needed[j]))
        quotient = rf"\frac{{{tex(peak)} \cdot {tex(abs(float(delta[j])))}}}{{{tex(float(limits[j]))}}}"
        root = (quotient, rf"\sqrt{{{quotient}}}", rf"\sqrt[3]{{{quotient}}}")[order - 1]
        symbol = ("v", "a", "j")[order - 1]
        general = rf"\frac{{{tex(peak)}\,|\Delta q_{{{j + 1}}}|}}{{{symbol}_{{{j + 1}}}}}"
        rooted = (general, rf"\sqrt{{{general}}}", rf"\sqrt[3]{{{general}}}")[order - 1]
        formulas.append(rf"T \ge {rooted} = {root} = {tex(times[-1], 's')}")
    return step(
        _("Time law"),
        _least_text(max(times), task.duration),
        rf"q(t) = q_i + s(\lambda)\,\Delta q,\quad \lambda = \frac{{t}}{{T}},\quad {_SHAPES[law]}",
        *formulas,
        rf"T = {tex(task.duration, 's')}",
    )


def _trapezoids(task: JointTask, delta: Array) -> tuple[Step, ...]:
    numbers = zip(np.abs(delta).tolist(), task.limits[0].tolist(), task.limits[1].tolist(), strict=True)
    own = [fastest(JointMove(length, 0.0, 0.0, v, a)) for length, v, a in numbers]
    least, shown = max(profile.duration for profile in own), range(min(len(own), SHOWN_JOINTS))
    alone = step(
        _("Bang-coast-bang of each joint"),
        _("With a coast where |Δq| > v²/a, else without: T_s = v/a and T = |Δq|/v + v/a, or T = 2 √(|Δq|/a)."),
        *(
            rf"T_{{{j + 1}}} = {tex(own[j].first)} + {tex(own[j].coast)} + {tex(own[j].last)} = "
            rf"{tex(own[j].duration, 's')},\quad v_p = {tex(own[j].peak_velocity)}"
            for j in shown
        ),
        rf"T_{{\min}} = \max_j T_j = {tex(least, 's')}",
    )
    text = _least_text(least, task.duration)
    if task.duration > least * (1.0 + _SAME):
        return alone, step(_("In step"), text, rf"T = {tex(task.duration, 's')}")
    slower = [
        rf"k_{{{j + 1}}} = \frac{{T}}{{T_{{{j + 1}}}}} = {tex(k)},\quad v = {tex(own[j].peak_velocity / k)},\quad "
        rf"a = {tex(own[j].acceleration / k**2)}"
        for j in shown
        if own[j].duration > 0.0
        for k in (task.duration / own[j].duration,)
    ]
    return alone, step(_("In step"), text, r"v \to \frac{v}{k},\quad a \to \frac{a}{k^2}", *slower)


def path_law_step(law: PiecewisePolynomial, unit: str) -> Step:
    """Return σ(t) of a path of the tip, in full if it has few pieces."""
    ends = law.at(law.breaks[[0, -1]])[:, 0]
    whole = rf"L = {tex(float(ends[1] - ends[0]), unit)},\quad T = {tex(law.duration, 's')}"
    count = len(law.coefficients)
    if count > _MOST_PIECES:
        text = _("{count} polynomials, each as fast as the limits allow at its place; too many to write out.")
        return step(_("Time law"), text.format(count=count), whole)
    return step(_("Time law"), _("τ is the time since the piece begins."), whole, *sigma_pieces(law))


def arc_segment_step(arc: Arc) -> Step:
    """Return p(σ), ṗ and p̈ of an arc; here d²p/ds² is not zero."""
    return step(
        _("Along the circle"),
        _("The second derivative points to the centre: the speed alone makes a centripetal acceleration σ̇²/r."),
        rf"c = {vector(arc.centre)},\quad r = {tex(arc.radius, 'm')},\quad L = r\,\varphi_f = "
        rf"{tex(arc.radius)} \cdot {tex(arc.angle)} = {tex(arc.length, 'm')}",
        rf"x = {vector(arc.x)},\quad y = {vector(arc.y)}",
        r"p = c + r\,(\cos\varphi\,x + \sin\varphi\,y),\quad \varphi = \frac{\sigma}{r} = s\,\varphi_f",
        r"\dot p = \frac{dp}{ds}\,\dot s = (-\sin\varphi\,x + \cos\varphi\,y)\,\dot\sigma",
        r"\ddot p = \frac{d^2 p}{ds^2}\,\dot s^2 + \frac{dp}{ds}\,\ddot s = "
        r"-\frac{\dot\sigma^2}{r}\,(\cos\varphi\,x + \sin\varphi\,y) + "
        r"(-\sin\varphi\,x + \cos\varphi\,y)\,\ddot\sigma",
    )


def corner_step(
    corner: Array, directions: tuple[Array, Array], radius: float, duration: float, *, is_smooth: bool
) -> Step:
    """Return the blend of two lines around a corner, (3,), with their unit vectors and a radius d, [m]."""
    before, after = directions
    parabola = _("A parabola that begins and ends at the distance d from the corner B, without a stop.")
    quartic = _(
        "A curve of fourth degree that begins and ends at the distance d from the corner B, without a stop; its "
        "curvature does not jump."
    )
    return step(
        _("Blend into the next line"),
        quartic if is_smooth else parabola,
        rf"B = {vector(corner)},\quad d = {tex(radius, 'm')},\quad \Delta T = {tex(duration, 's')}",
        rf"A' = B - d\,K_{{AB}} = {vector(corner - radius * before)}",
        rf"C' = B + d\,K_{{BC}} = {vector(corner + radius * after)}",
    )


def knots_step(times: Array, velocities: Array) -> Step:
    """Return the times and velocities at the knots of a spline; shape (N,), [s], and (N, n)."""
    size = np.abs(velocities).max(initial=0.0)
    velocities = np.where(np.abs(velocities) > _NOTHING * size, velocities, 0.0)
    rows = (rf"v_{{{j + 1}}} = ({tex_row(velocities[:, j])})" for j in range(min(velocities.shape[1], SHOWN_JOINTS)))
    return step(
        _("Cubic spline"),
        _("A(h) v = b makes the acceleration continuous at the inner knots; the velocities at the knots are:"),
        rf"t = ({tex_row(times)})",
        *rows,
    )


def tip_spline_step(waypoints: int) -> Step:
    """Return what is said of a spline of the tip."""
    text = _("A spline of the tip's position by its length through {count} points.")
    return step(
        _("Path through points"), text.format(count=waypoints), r"p = p(s),\quad \dot p = \frac{dp}{ds}\,\dot s"
    )


def titled(steps: Sequence[Step], index: int) -> list[Step]:
    """Return steps with the number of their segment in the title."""
    title = _("Segment {index}: {title}")
    return [Step(title.format(index=index, title=one.title), one.text, one.latex, one.plain) for one in steps]
