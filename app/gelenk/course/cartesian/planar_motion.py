"""A planar arm along a line by a time law, as one piecewise polynomial: q(s(t)) to within rounding.

Pieces are septics with the exact position, velocity, acceleration and jerk at both ends, and are divided until they
agree with q(s(t)) in between. So the peaks of the polynomial are those of the motion.
"""

import numpy as np

from gelenk.course.cartesian.planar_line import PlanarLine, tips
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix, vector
from gelenk.errors import InvalidField, certify
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import Bound
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, derivatives
from gelenk.trajectory.motion.time_laws import hermite_pieces

_FIRST_PARTS, _MOST_PARTS = 16, 512
_AGREES = 1e-10
"""Error of position, velocity and acceleration between the ends of a piece, in fractions of the largest of each."""
_PROBES = (0.25, 0.5, 0.75)
_CHECKED = 257
_ON_LINE = 1e-9


def along_planar_line(line: PlanarLine, law: PiecewisePolynomial) -> PiecewisePolynomial:
    """Return the joints along a line whose s(t), of one piece, is given.

    Raises InvalidField where the line leads out of reach, through a singularity, or too near to one to be exact.
    """
    if line.beyond is not None:
        raise InvalidField("line", f"leaves what the arm reaches at s = {line.beyond:.6g}: choose another `target`")
    breaks = np.linspace(law.breaks[0], law.breaks[-1], _FIRST_PARTS + 1)
    while len(breaks) <= _MOST_PARTS:
        ends = rates(line, law, breaks)
        motion = PiecewisePolynomial(breaks, hermite_pieces(ends[:, :-1], ends[:, 1:], np.diff(breaks)))
        wrong = _errors(line, law, motion) > _AGREES
        if not wrong.any():
            _check(line, law, motion)
            return motion
        breaks = np.sort(np.concatenate((breaks, 0.5 * (breaks[:-1] + breaks[1:])[wrong])))
    raise InvalidField("line", "leads so near to a singularity that the joints turn too fast to be computed exactly")


def rates(line: PlanarLine, law: PiecewisePolynomial, times: Array) -> Array:
    """Return q, q̇, q̈ and q⃛ by the chain rule from those by s; shape (4, N, 2), [rad per sᵏ]."""
    s, v, a, j = derivatives(law.coefficients, (times - law.breaks[0])[:, None])
    q, first, second, third = line.derivatives(s[:, 0])
    return np.array((q, first * v, first * a + second * v**2, first * j + 3.0 * second * v * a + third * v**3))


def _errors(line: PlanarLine, law: PiecewisePolynomial, motion: PiecewisePolynomial) -> Array:
    """Return the largest error between the ends of each piece, as a fraction of the largest value; shape (M,)."""
    widths, worst = np.diff(motion.breaks), np.zeros(len(motion.coefficients))
    for share in _PROBES:
        wanted = rates(line, law, motion.breaks[:-1] + share * widths)[:3]
        found = np.array(derivatives(motion.coefficients, share * widths[:, None], 2))
        sizes = np.maximum(np.abs(wanted).max(axis=(1, 2)), np.finfo(float).tiny)
        worst = np.maximum(worst, (np.abs(found - wanted).max(axis=2) / sizes[:, None]).max(axis=0))
    return worst


def _check(line: PlanarLine, law: PiecewisePolynomial, motion: PiecewisePolynomial) -> None:
    """See by forward kinematics whether the tip is where the law says; raises CertificationFailed."""
    times = np.linspace(motion.breaks[0], motion.breaks[-1], _CHECKED)
    away = tips(line.lengths, motion.at(times)) - line.points(law.at(times)[:, 0])
    error, allowed = float(np.abs(away).max()), _ON_LINE * sum(line.lengths)
    certify("the tip on its line", error, allowed)


def planar_motion_steps(line: PlanarLine, law: PiecewisePolynomial, bound: Bound) -> tuple[Step, ...]:
    """Return how the line's derivatives become those of the joints, with numbers at the time of a bound."""
    s, v, a = (float(values[0, 0]) for values in law.rates_at(np.array([bound.time])))
    q, first, second, _third = (values[0] for values in line.derivatives(np.array([s])))
    J = _jacobian(line, q)
    way = np.array([(line.target - line.start).real, (line.target - line.start).imag])
    by_path = step(
        _("Joints along the line"),
        _("Derivatives by s, with p'' = 0 on a line; numbers where the limit is reached."),
        rf"s = {tex(s)},\quad q = {vector(q)}",
        rf"J = {matrix(J)},\quad p_f - p_i = {vector(way)}",
        rf"p' = J q' \Rightarrow q' = J^{{-1}} (p_f - p_i) = {vector(first)}",
        rf"p'' = J q'' + J' q' = 0 \Rightarrow q'' = -J^{{-1}} J' q' = {vector(second)}",
    )
    in_time = step(
        _("In time"),
        _("The chain rule with the time law."),
        rf"t = {tex(bound.time, 's')}:\quad \dot s = {tex(v)},\quad \ddot s = {tex(a)}",
        rf"\dot q = q'\,\dot s = {vector(first * v)}",
        rf"\ddot q = q'\,\ddot s + q''\,\dot s^2 = {vector(first * a + second * v**2)}",
    )
    return by_path, in_time


def _jacobian(line: PlanarLine, q: Array) -> Array:
    (l1, l2), (a, b) = line.lengths, np.cumsum(q)
    first, second = np.array([-np.sin(a), np.cos(a)]) * l1, np.array([-np.sin(b), np.cos(b)]) * l2
    return np.column_stack((first + second, second))
