"""Worked solutions of the polynomial time laws, in the notation of the lecture."""

from collections.abc import Sequence

import numpy as np

from gelenk.course.motion.formulas import SHOWN_JOINTS, of_joint, tex_polynomial, tex_row
from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import Peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

_LETTERS = "abcdefgh"
_CONDITIONS = {
    3: (r"q(0) = q_0", r"\dot q(0) = v_0", r"q(T) = q_1", r"\dot q(T) = v_1"),
    5: (r"q,\ \dot q,\ \ddot q,\quad t \in \{0, T\}",),
    7: (r"q,\ \dot q,\ \ddot q,\ \dddot q,\quad t \in \{0, T\}",),
}


def two_point_steps(
    motion: PiecewisePolynomial, starts: Array, ends: Array, normalised: Sequence[Sequence[float] | None]
) -> tuple[Step, ...]:
    """Return the steps of a cubic, quintic or septic between two points, joint by joint; the motion has one piece.

    Args:
        starts, ends: Position, velocity, … at t = 0 and at t = T; shape (m, n), [rad or m per sᵏ].
        normalised: Coefficients of each joint in the course's normalised form; None if Δq = 0.
    """
    degree, joints = motion.coefficients.shape[1] - 1, starts.shape[1]
    names = _LETTERS[: degree + 1]
    general = " + ".join(f"{name} \\lambda^{{{degree - i}}}" for i, name in enumerate(names[:-2]))
    text = _("{conditions} conditions, {coefficients} coefficients: a polynomial of degree {degree} in λ = t/T.")
    steps = [
        step(
            _("Time law"),
            text.format(conditions=2 * len(starts), coefficients=degree + 1, degree=degree),
            rf"q(\lambda) = q_0 + \Delta q\,({general} + {names[-2]} \lambda + {names[-1]}),"
            r"\quad \lambda = \frac{t}{T}",
            *_CONDITIONS[degree],
        )
    ]
    for j, own in enumerate(normalised[:SHOWN_JOINTS]):
        if own is None:
            text = _("q₁ = q₀: dividing by Δq = 0 is not possible, and the general form in t is used.")
            form = step(_("No normalised form"), text, r"\Delta q = 0")
        elif degree == 3:
            form = _cubic(starts[:, j].tolist(), ends[:, j].tolist(), motion.duration, own)
        else:
            found = ",\\ ".join(f"{name} = {tex(value)}" for name, value in zip(names, own, strict=True))
            form = step(_("Coefficients"), _("Lowest powers from the start, the others from the end."), found)
        polynomial = tex_polynomial(motion.coefficients[0, ::-1, j].tolist())
        in_time = step(_("In time"), _("λ = t/T put in."), f"q(t) = {polynomial}")
        steps += [of_joint(form, j, joints), of_joint(in_time, j, joints)]
    return tuple(steps)


def _cubic(start: Sequence[float], end: Sequence[float], duration: float, coefficients: Sequence[float]) -> Step:
    """Write out the four conditions one after the other."""
    (q0, v0), (q1, v1), (a, b, c) = start, end, coefficients[:3]
    delta = tex(q1 - q0)
    c_value, sum_value = (rf"\frac{{{tex_factor(v)} \cdot {tex(duration)}}}{{{delta}}}" for v in (v0, v1))
    return step(
        _("Coefficients"),
        _("Velocities in λ are those in t times T."),
        rf"\Delta q = q_1 - q_0 = {tex(q1)} - {tex_factor(q0)} = {delta}",
        r"q(0) = q_0 \Rightarrow d = 0",
        rf"q'(0) = \Delta q\,c = v_0 T \Rightarrow c = {c_value} = {tex(c)}",
        r"q(1) = q_1 \Rightarrow a + b + c = 1",
        rf"q'(1) = \Delta q\,(3a + 2b + c) = v_1 T \Rightarrow 3a + 2b + c = {sum_value}",
        rf"a = \frac{{(v_0 + v_1) T}}{{\Delta q}} - 2 = {tex(a)}",
        rf"b = 3 - \frac{{(2 v_0 + v_1) T}}{{\Delta q}} = {tex(b)}",
    )


def lift_steps(motion: PiecewisePolynomial, knots: Array) -> tuple[Step, ...]:
    """Return the steps of the 4-3-4 law, joint by joint; `knots` has shape (4, n), [rad or m]."""
    joints = knots.shape[1]
    steps = [
        step(
            _("Three pieces"),
            _(
                "A quartic to lift off, a cubic to travel, a quartic to set down; each in the time since it begins. 5 "
                "+ 4 + 5 coefficients, 14 conditions: positions at four knots (six of them, twice at the inner ones), "
                "velocity and acceleration at both ends, and both continuous at the two inner knots."
            ),
            r"L(t) = \sum_{k=0}^4 a_k t^k,\quad T(t) = \sum_{k=0}^3 b_k t^k,\quad S(t) = \sum_{k=0}^4 c_k t^k",
            rf"h = ({tex_row(np.diff(motion.breaks))})",
        )
    ]
    text = _("Equal accelerations at the inner knots are two equations for the two velocities there.")
    for j in range(min(joints, SHOWN_JOINTS)):
        v1, v2 = map(tex, motion.coefficients[1:, 1, j].tolist())
        rows = motion.coefficients[:, ::-1, j].tolist()
        pieces = (f"{name}(t) = {tex_polynomial(row)}" for name, row in zip("LTS", rows, strict=True))
        steps.append(of_joint(step(_("Coefficients"), text, rf"v_1 = {v1},\quad v_2 = {v2}", *pieces), j, joints))
    return tuple(steps)


def peak_step(velocity: Peaks, acceleration: Peaks) -> Step:
    """Return the step with the largest velocity and acceleration of each joint, and their times."""
    lines = []
    for j in range(min(len(velocity.values), SHOWN_JOINTS)):
        index = "" if len(velocity.values) == 1 else f"_{{{j + 1}}}"
        for symbol, found in ((r"\dot q", velocity), (r"\ddot q", acceleration)):
            value, time = float(found.values[j]), float(found.times[j])
            lines.append(rf"\max|{symbol}{index}| = {tex(abs(value))} \text{{ {_('at')} }} t = {tex(time)}")
    return step(_("Peaks"), _("Where the next derivative is zero, or at an end of a piece."), *lines)
