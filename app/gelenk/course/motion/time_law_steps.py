"""Worked solutions of the polynomial time laws, in the notation of the lecture."""

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from math import factorial, perm

import numpy as np

from gelenk.course.steps import Step, step, tex, tex_factor
from gelenk.course.writing import matrix
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import Bound, Quantity, Scaling
from gelenk.trajectory.motion.extremes import Peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

SHOWN_JOINTS = 4
"""Largest number of joints that a worked solution shows; others are computed in the same manner."""
_SHOWN_NUMBERS = 12


def tex_polynomial(coefficients: Sequence[float]) -> str:
    """Format a polynomial in t, highest power first in formula and list; 0 if all coefficients are."""
    text = ""
    for power, value in zip(range(len(coefficients) - 1, -1, -1), coefficients, strict=True):
        if value != 0.0:
            symbol = {0: "", 1: r"\,t"}.get(power, rf"\,t^{{{power}}}")
            sign = "-" if value < 0.0 else "+" if text else ""
            text += f" {sign} " if text else sign
            text += tex(abs(value)) + symbol
    return text or "0"


def tex_row(values: Array) -> str:
    """Format numbers in a row, at most twelve of them."""
    shown = ", ".join(map(tex, values[:_SHOWN_NUMBERS].tolist()))
    return shown if len(values) <= _SHOWN_NUMBERS else shown + r", \dots"


def of_joint(step: Step, joint: int, joints: int) -> Step:
    """Return the step with its joint in the title, if there are several joints."""
    if joints == 1:
        return step
    return replace(step, title=_("Joint {number}: {title}").format(number=joint + 1, title=step.title))


_LETTERS = "abcdefgh"
_RATES = "qvaj"
_UPPER: dict[int, tuple[tuple[int | str, ...], ...]] = {
    2: ((3, -1), (-2, 1)),
    3: ((10, -4, "1/2"), (-15, 7, -1), (6, -3, "1/2")),
    4: ((35, -15, "5/2", "-1/6"), (-84, 39, -7, "1/2"), (70, -34, "13/2", "-1/2"), (-20, 10, -2, "1/6")),
}
"""For each m, the upper coefficients by the remainders r of the m conditions at λ = 1."""
_SAME_ACCELERATIONS = (
    (
        r"\left(\frac{6}{h_1} + \frac{4}{h_2}\right) v_1 + \frac{2}{h_2} v_2 = "
        r"\frac{12 (q_1 - q_0)}{h_1^2} + \frac{6 (q_2 - q_1)}{h_2^2} - \frac{6 v_0}{h_1} - a_0"
    ),
    (
        r"\frac{2}{h_2} v_1 + \left(\frac{4}{h_2} + \frac{6}{h_3}\right) v_2 = "
        r"\frac{6 (q_2 - q_1)}{h_2^2} + \frac{12 (q_3 - q_2)}{h_3^2} - \frac{6 v_3}{h_3} + a_3"
    ),
)
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
            form = step(
                _("No normalised form"), text, r"\Delta q = 0", *_general(starts[:, j], ends[:, j], motion.duration)
            )
        elif degree == 3:
            form = _cubic(starts[:, j].tolist(), ends[:, j].tolist(), motion.duration, own)
        else:
            found = ",\\ ".join(f"{name} = {tex(value)}" for name, value in zip(names, own, strict=True))
            general_form = _general(starts[:, j], ends[:, j], motion.duration)
            text = _("Lowest powers from the start, the others from the end.")
            form = step(_("Coefficients"), text, *general_form, found)
        polynomial = tex_polynomial(motion.coefficients[0, ::-1, j].tolist())
        in_time = step(_("In time"), _("λ = t/T put in."), f"q(t) = {polynomial}")
        steps += [of_joint(form, j, joints), of_joint(in_time, j, joints)]
    return tuple(steps)


def _general(start: Array, end: Array, duration: float) -> list[str]:
    """Return the coefficients of q = Σ c_k λᵏ, which need no Δq: lower from the start, upper from the rest."""
    m, formulas = len(start), []
    c = [float(start[k]) * duration**k / factorial(k) for k in range(m)]
    for k, value in enumerate(c):
        power = "" if k == 0 else "\\,T" if k == 1 else rf"\,T^{k}"
        divided = rf"\frac{{{_RATES[k]}_0{power}}}{{{factorial(k)}}}" if k > 1 else f"{_RATES[k]}_0{power}"
        formulas.append(rf"c_{k} = {divided} = {tex(value)}")
    r = []
    for d in range(m):
        taken = [(perm(k, d), k) for k in range(max(d, 0), m)]
        r.append(float(end[d]) * duration**d - sum(count * c[k] for count, k in taken))
        power = "" if d == 0 else "\\,T" if d == 1 else rf"\,T^{d}"
        rest = "".join(rf" - {count if count > 1 else ''}c_{k}" for count, k in taken)
        formulas.append(rf"r_{d} = {_RATES[d]}_1{power}{rest} = {tex(r[d])}")
    for i, row in enumerate([list(map(Fraction, weights)) for weights in _UPPER[m]]):
        terms = ""
        for d, weight in enumerate(row):
            sign = " - " if weight < 0 else " + " if terms else ""
            factor = "" if abs(weight) == 1 else str(abs(weight)) if weight.denominator == 1 else _fraction(weight)
            terms += (sign if terms else sign.strip()) + f"{factor} r_{d}".strip()
        value = sum(float(weight) * one for weight, one in zip(row, r, strict=True))
        formulas.append(rf"c_{m + i} = {terms} = {tex(value)}")
    return formulas


def _fraction(weight: Fraction) -> str:
    return rf"\frac{{{abs(weight.numerator)}}}{{{weight.denominator}}}"


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
        system = _lift_system(motion, knots[:, j], j)
        pieces = (f"{name}(t) = {tex_polynomial(row)}" for name, row in zip("LTS", rows, strict=True))
        found = rf"v_1 = {v1},\quad v_2 = {v2}"
        steps.append(of_joint(step(_("Coefficients"), text, *_SAME_ACCELERATIONS, system, found, *pieces), j, joints))
    return tuple(steps)


def _lift_system(motion: PiecewisePolynomial, knots: Array, j: int) -> str:
    """Return the two equations for the inner velocities of joint `j` with their numbers; `knots` has shape (4,)."""
    h, delta = np.diff(motion.breaks), np.diff(knots)
    v0, a0 = motion.coefficients[0, 1, j], 2.0 * motion.coefficients[0, 2, j]
    v3, a3 = (float(motion.derivative(order).at(motion.breaks[-1:])[0, j]) for order in (1, 2))
    A = np.array([[6.0 / h[0] + 4.0 / h[1], 2.0 / h[1]], [2.0 / h[1], 4.0 / h[1] + 6.0 / h[2]]])
    travel = 6.0 * delta[1] / h[1] ** 2
    before = travel + 12.0 * delta[0] / h[0] ** 2 - 6.0 * v0 / h[0] - a0
    after = travel + 12.0 * delta[2] / h[2] ** 2 - 6.0 * v3 / h[2] + a3
    return rf"{matrix(A)} \begin{{bmatrix}} v_1 \\ v_2 \end{{bmatrix}} = {matrix(np.array([before, after]))}"


def peak_step(velocity: Peaks, acceleration: Peaks) -> Step:
    """Return the step with the largest velocity and acceleration of each joint, and their times."""
    lines = []
    for j in range(min(len(velocity.values), SHOWN_JOINTS)):
        index = "" if len(velocity.values) == 1 else f"_{{{j + 1}}}"
        for symbol, found in ((r"\dot q", velocity), (r"\ddot q", acceleration)):
            value, time = float(found.values[j]), float(found.times[j])
            lines.append(rf"\max|{symbol}{index}| = {tex(abs(value))} \text{{ {_('at')} }} t = {tex(time)}")
    return step(_("Peaks"), _("Where the next derivative is zero, or at an end of a piece."), *lines)


_SYMBOLS: dict[Quantity, tuple[str, str, str]] = {
    "velocity": (r"\dot q", "v", r"k_{\mathrm{vel}}"),
    "acceleration": (r"\ddot q", "a", r"k_{\mathrm{acc}}"),
    "jerk": (r"\dddot q", "j", r"k_{\mathrm{jerk}}"),
}
_TITLES: dict[Quantity, str] = {
    "velocity": marked("Velocity"),
    "acceleration": marked("Acceleration"),
    "jerk": marked("Jerk"),
}
_ROOTS: dict[Quantity, str] = {"velocity": "{}", "acceleration": r"\sqrt{{{}}}", "jerk": r"\sqrt[3]{{{}}}"}


def scaling_steps(scaling: Scaling, duration: float) -> tuple[Step, ...]:
    """Return the worked steps: ratios, the course's k, and k without the 1; `duration` in [s]."""
    roots = ", ".join(_ROOTS[bound.quantity].format(_SYMBOLS[bound.quantity][2]) for bound in scaling.bounds)

    def largest(terms: str, k: float) -> tuple[str, str]:
        return rf"k = \max\{{{terms}\}} = {tex(k)}", rf"k T = {tex(k)} \cdot {tex(duration)} = {tex(k * duration)}"

    scaled = step(
        _("Scaling the time"),
        _("The same path in k times the time: each derivative is divided by k once more."),
        r"T \to k T:\quad \dot q \to \frac{\dot q}{k},\quad \ddot q \to \frac{\ddot q}{k^2}",
    )
    text = _("The 1 in the maximum lets it slow down alone.")
    course = step(_("k of the course"), text, *largest(f"1, {roots}", scaling.course_factor))
    steps = (scaled, *map(_ratio_step, scaling.bounds), course)
    if scaling.factor is None:
        return steps
    text = _(
        'It slows down or speeds up, until a limit is just reached. (The notes say "slow down or speed up" of the '
        "maximum with the 1, which only slows down.)"
    )
    return (*steps, step(_("k without the 1"), text, *largest(roots, scaling.factor)))


def _ratio_step(bound: Bound) -> Step:
    symbol, limit, name = _SYMBOLS[bound.quantity]
    j = bound.joint
    return step(
        _(_TITLES[bound.quantity]),
        _("The largest ratio of a peak to its limit: joint {joint}, at {time:.10g} s.").format(
            joint=j, time=bound.time
        ),
        rf"{name} = \max_j \frac{{\max_t |{symbol}_j|}}{{{limit}_{{\max,j}}}} = "
        rf"\frac{{|{symbol}_{{{j}}}|}}{{{limit}_{{\max,{j}}}}} = "
        rf"\frac{{{tex(abs(bound.peak))}}}{{{tex(bound.limit)}}} = {tex(bound.ratio)}",
    )
