"""The orientation along a line: about one axis, R(t) = R_i Rot(r, s θ), and by Euler angles, the course's two ways.

The second way to each orientation: Rodrigues' formula for the one, products of elementary rotations for the other.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gelenk.course.orientation.rotations import about_axis, elementary
from gelenk.course.steps import Step, step, tex
from gelenk.course.writing import matrix, vector
from gelenk.errors import certify
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.paths.orientation_paths import AxisAnglePath, OrientationPath, axis_angle
from gelenk.trajectory.paths.zyz_paths import ZyzPath, zyz_turns

_TOLERANCE = 1e-9
_MIDDLE = np.array([0.5])


@dataclass(frozen=True)
class Turn:
    """From R_i to R_f, (3, 3) each, by both ways."""

    start: Array
    end: Array

    @cached_property
    def by_axis(self) -> AxisAnglePath:
        """About one axis."""
        return axis_angle(self.start, self.end)

    @cached_property
    def by_angles(self) -> ZyzPath:
        """By ZYZ angles, each linear in s; θ keeps its sign."""
        return zyz_turns(np.array([self.start, self.end]), [False])[0]

    @property
    def base_axis(self) -> Array:
        """R_i r, the axis in the base frame; (3,)."""
        axis: Array = self.start @ self.by_axis.axis
        return axis

    @property
    def middles(self) -> tuple[Array, Array]:
        """Orientations at s = 1/2, about the axis and by angles; (3, 3) each."""
        return self.by_axis.at(_MIDDLE)[0][0], self.by_angles.at(_MIDDLE)[0][0]

    @property
    def apart(self) -> float:
        """Angle between the two middles, [rad]."""
        one, other = self.middles
        return axis_angle(one, other).angle

    def error(self, shares: Array) -> float:
        """Return the largest entry by which orientations at s differ from the second way to them, no unit.

        Raises CertificationFailed beyond rounding. The ends are compared with R_i and R_f themselves.
        """
        s = np.concatenate(([0.0, 1.0], shares))
        axis, angle = self.by_axis.axis, self.by_axis.angle
        about = np.array([self.start @ about_axis(axis, x * angle) for x in s.tolist()])
        triples = self.by_angles.angles.at(s).tolist()
        products = np.array([elementary("z", f) @ elementary("y", t) @ elementary("z", p) for f, t, p in triples])
        ends = np.array([self.start, self.end])
        error = 0.0
        for path, second in ((self.by_axis, about), (self.by_angles, products)):
            found = path.at(s)[0]
            error = max(error, float(np.abs(found - second).max()), float(np.abs(found[:2] - ends).max()))
        certify("the orientations along the line", error, _TOLERANCE)
        return error


def rates(path: OrientationPath, share: PiecewisePolynomial, times: Array) -> tuple[Array, Array, Array]:
    """Return R, ω and ω̇ in the base frame at N times; shapes (N, 3, 3), (N, 3), (N, 3), [rad/s], [rad/s²]."""
    s, speed, change = (values[:, 0] for values in share.rates_at(times))
    rotations, first, second = path.at(s)
    return rotations, first * speed[:, None], second * speed[:, None] ** 2 + first * change[:, None]


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
