"""Worked solution of an orientation along a line."""

import numpy as np

from gelenk.course.cartesian.turn import Turn
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix, vector
from gelenk.language import translated as _
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial


def turn_steps(turn: Turn, share: PiecewisePolynomial) -> tuple[Step, ...]:
    """Return axis and angle, R(t) with ω, the Euler angles, and the two orientations halfway; s(t) is `share`."""
    path, difference = turn.by_axis, turn.start.T @ turn.end
    if path.angle == 0.0:
        same = _("Both orientations are the same: θ = 0, and the axis is not defined.")
        return (step(_("Axis and angle"), same, r"R_i^T R_f = I,\quad \theta = 0"),)
    d = difference
    v = np.array([d[2, 1] - d[1, 2], d[0, 2] - d[2, 0], d[1, 0] - d[0, 1]])
    axis = step(
        _("Axis and angle"),
        _("Of the rotation from the first orientation to the last, in the frame of the first."),
        rf"R_i^T R_f = {matrix(difference)}",
        rf"v = (r_{{32}} - r_{{23}},\; r_{{13}} - r_{{31}},\; r_{{21}} - r_{{12}}) = {vector(v)}",
        rf"\theta = \mathrm{{atan2}}\left(\tfrac{{1}}{{2}} \lVert v \rVert,\ \tfrac{{1}}{{2}} "
        rf"(\mathrm{{tr}} - 1)\right) = {tex(path.angle, 'rad')}",
        rf"r = {vector(path.axis)}",
    )
    peak = peaks(share, 1)
    fastest = abs(float(peak.values[0]))
    about = step(
        _("About the axis"),
        _("A neutral axis, and the time law on the angle: the axis stays, also seen from the base."),
        r"R(t) = R_i\,\mathrm{Rot}(r, \theta(t)),\quad \theta(t) = s(t)\,\theta",
        rf"\omega = R_i\,r\,\dot\theta = {vector(turn.base_axis)}\,\dot\theta",
        rf"\max \dot\theta = {tex(path.angle)} \cdot {tex(fastest)} = {tex(path.angle * fastest, 'rad/s')} "
        rf",\quad t = {tex(float(peak.times[0]), 's')}",
        rf"\omega_{{\max}} = {vector(turn.base_axis * path.angle * fastest)}",
    )
    first, last = turn.by_angles.triple_at(0.0), turn.by_angles.triple_at(1.0)
    angles = step(
        _("By Euler angles"),
        _("A minimal representation, planned like positions; the axis of rotation changes on the way."),
        r"\phi(t) = \phi_i + s(t)\,(\phi_f - \phi_i)",
        rf"\phi_i = {vector(first)},\quad \phi_f = {vector(last)}",
    )
    one, other = turn.middles
    halfway = step(
        _("Halfway"),
        _("Both ways have the same ends, and other orientations between them."),
        rf"R_{{\mathrm{{axis}}}} = {matrix(one)}",
        rf"R_{{\mathrm{{zyz}}}} = {matrix(other)}",
        rf"\angle(R_{{\mathrm{{axis}}}}, R_{{\mathrm{{zyz}}}}) = {tex(turn.apart, 'rad')}",
    )
    return axis, about, angles, halfway
