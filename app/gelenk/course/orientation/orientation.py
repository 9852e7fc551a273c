"""An orientation in every notation of the course, with both branches of the Euler triples and the degenerate cases.

- ZYZ, R = Rz(φ) Ry(θ) Rz(ψ): (φ, θ, ψ) and (φ + π, -θ, ψ + π) are the same. The notes say that in the degenerate case
  "only the sum" is known: that holds at θ = 0; at θ = π it is the difference φ - ψ. They also omit the second branch, θ
  < 0.
- RPY, R = Rz(yaw) Ry(pitch) Rx(roll): (r, p, y) and (r + π, π - p, y + π) are the same. At pitch = π/2 only yaw - roll
  is determined, at -π/2 only yaw + roll.
- Axis and angle: at 0 the axis is undefined, at π it is determined except for its sign.
- Quaternions: q and -q are the same; the one with scalar part ≥ 0 is chosen, and if that is 0, the one whose first
  other non-zero part is positive.

Sines and cosines below `DEGENERATE` count as zero. The notations come from `gelenk.robot.notations`; each result is
turned back into R by products of elementary rotations, Rodrigues' formula and the quaternion's own product.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from gelenk.course.orientation.rotations import DEGENERATE, about_axis, elementary
from gelenk.errors import certify
from gelenk.robot.arrays import Array
from gelenk.robot.notations import (
    quaternions_xyzw_from_rotations,
    rpy_from_rotations,
    vectors_from_rotations,
    zyz_from_rotations,
)
from gelenk.robot.result import Result

NEARLY_DEGENERATE = 1e-6
"""Sine or cosine below which fewer than ten digits of the two outer angles are determined."""
_RECOMPUTED = 1e-12


@dataclass(frozen=True, slots=True)
class Degeneracy(Result):
    """A notation that degenerates at this orientation.

    Attributes:
        notation: Which one it is.
        case: What makes it so.
        determined: What is still determined; null if nothing is.
        value: Of the combination that is determined, in (-π, π], [rad].
        chosen: How the given triple was chosen among all.
    """

    notation: Literal["zyz", "rpy", "axis_angle"]
    case: str
    determined: str | None
    value: float | None
    chosen: str


@dataclass(frozen=True, slots=True)
class Triple:
    """The solutions of an Euler triple.

    Attributes:
        solutions: Both branches, [rad]; the representative alone in a degenerate case.
        conditioning: |sin θ| or |cos pitch|: errors of R are amplified by its inverse in the outer angles.
    """

    solutions: tuple[tuple[float, float, float], ...]
    conditioning: float
    degeneracy: Degeneracy | None


@dataclass(frozen=True, slots=True)
class AxisAngle:
    """A rotation by an angle in [0, π], [rad]; its unit axes are none at 0, both at π, and otherwise one."""

    angle: float
    axes: tuple[tuple[float, float, float], ...]
    degeneracy: Degeneracy | None


@dataclass(frozen=True, slots=True)
class Notations:
    """A rotation in every notation.

    Attributes:
        rotation: R; shape (3, 3).
        quaternion_xyzw: The unit quaternion with the chosen sign.
        rotation_vector: Axis times angle, [rad].
        zyz: (φ, θ, ψ), θ ≥ 0 first.
        rpy: (roll, pitch, yaw), pitch in [-π/2, π/2] first.
        error: Largest deviation of an entry of R when it is recomputed from the other notations.
    """

    rotation: Array
    quaternion_xyzw: tuple[float, float, float, float]
    rotation_vector: tuple[float, float, float]
    axis_angle: AxisAngle
    zyz: Triple
    rpy: Triple
    error: float

    @property
    def degeneracies(self) -> tuple[Degeneracy, ...]:
        """Degenerate cases of ZYZ, RPY and axis-angle at this rotation."""
        found = (self.zyz.degeneracy, self.rpy.degeneracy, self.axis_angle.degeneracy)
        return tuple(one for one in found if one is not None)


def notations(R: Array) -> Notations:
    """Convert a rotation (3, 3) to every notation; raises CertificationFailed if one does not reproduce it."""
    Rs = np.ascontiguousarray(R)[None]
    quaternion = _signed(quaternions_xyzw_from_rotations(Rs)[0])
    turn = _axis_angle(quaternion)
    vector = vectors_from_rotations(Rs)[0]
    if len(turn.axes) == 2:
        vector = turn.angle * np.array(turn.axes[0])
    zyz, rpy = _zyz(R), _rpy(R)
    error = _recomputed(R, quaternion, vector, turn, zyz, rpy)
    x, y, z, w = quaternion.tolist()
    a, b, c = vector.tolist()
    return Notations(R, (x, y, z, w), (a, b, c), turn, zyz, rpy, error)


def wrapped(angle: float) -> float:
    """Return the same angle in (-π, π]; one already in this interval is returned unchanged."""
    if -math.pi < angle <= math.pi:
        return angle
    reduced = math.remainder(angle, 2.0 * math.pi)
    return math.pi if reduced <= -math.pi else reduced


def _signed(quaternion: Array) -> Array:
    """Choose the quaternion's sign, after setting parts that count as zero at half a turn to 0; no part is -0."""
    if abs(quaternion[3]) > DEGENERATE:
        return (quaternion if quaternion[3] > 0.0 else -quaternion) + 0.0
    quaternion = np.where(np.abs(quaternion) > DEGENERATE, quaternion, 0.0)
    first = next(part for part in quaternion[:3] if part != 0.0)
    return (quaternion if first > 0.0 else -quaternion) + 0.0


def _axis_angle(quaternion: Array) -> AxisAngle:
    x, y, z, w = quaternion.tolist()
    sine = math.hypot(x, y, z)
    angle = 2.0 * math.atan2(sine, w)
    if sine <= DEGENERATE:
        return AxisAngle(0.0, (), Degeneracy("axis_angle", "angle = 0", None, None, "no axis"))
    axis = (x / sine, y / sine, z / sine)
    if abs(w) > DEGENERATE:
        return AxisAngle(angle, (axis,), None)
    opposite = (-axis[0], -axis[1], -axis[2])
    both = Degeneracy("axis_angle", "angle = pi", "axis up to sign", None, "first non-zero part is positive")
    return AxisAngle(math.pi, (axis, opposite), both)


def _zyz(R: Array) -> Triple:
    phi, theta, psi = zyz_from_rotations(np.ascontiguousarray(R)[None])[0].tolist()
    sine = math.hypot(R[0, 2], R[1, 2])
    if sine > DEGENERATE:
        return Triple(((phi, theta, psi), (wrapped(phi + math.pi), -theta, wrapped(psi + math.pi))), sine, None)
    if R[2, 2] > 0.0:
        total = wrapped(math.atan2(R[1, 0], R[0, 0]))
        found = Degeneracy("zyz", "theta = 0", "phi + psi", total, "psi = 0")
        return Triple(((total, 0.0, 0.0),), sine, found)
    difference = wrapped(math.atan2(-R[1, 0], -R[0, 0]))
    found = Degeneracy("zyz", "theta = pi", "phi - psi", difference, "psi = 0")
    return Triple(((difference, math.pi, 0.0),), sine, found)


def _rpy(R: Array) -> Triple:
    roll, pitch, yaw = rpy_from_rotations(np.ascontiguousarray(R)[None])[0].tolist()
    cosine = math.hypot(R[0, 0], R[1, 0])
    if cosine > DEGENERATE:
        other = (wrapped(roll + math.pi), wrapped(math.pi - pitch), wrapped(yaw + math.pi))
        return Triple(((roll, pitch, yaw), other), cosine, None)
    turned = wrapped(math.atan2(-R[0, 1], R[1, 1]))
    if R[2, 0] < 0.0:
        found = Degeneracy("rpy", "pitch = pi/2", "yaw - roll", turned, "yaw = 0")
        return Triple(((wrapped(-turned), 0.5 * math.pi, 0.0),), cosine, found)
    found = Degeneracy("rpy", "pitch = -pi/2", "yaw + roll", turned, "yaw = 0")
    return Triple(((turned, -0.5 * math.pi, 0.0),), cosine, found)


def _recomputed(R: Array, quaternion: Array, vector: Array, turn: AxisAngle, zyz: Triple, rpy: Triple) -> float:
    """Return the largest deviation from R of a notation that is turned back into a matrix by another method."""
    angle = math.hypot(*vector.tolist())
    again = [_sandwich(quaternion), _sandwich(-quaternion)]
    again.append(about_axis(vector / angle, angle) if angle > 0.0 else np.eye(3))
    again += [about_axis(np.array(axis), turn.angle) for axis in turn.axes]
    again += [elementary("z", a) @ elementary("y", b) @ elementary("z", c) for a, b, c in zyz.solutions]
    again += [elementary("z", c) @ elementary("y", b) @ elementary("x", a) for a, b, c in rpy.solutions]
    error = max(float(np.abs(one - R).max()) for one in again)
    certify("rotation matrix", error, _RECOMPUTED)
    return error


def _sandwich(quaternion: Array) -> Array:
    """Return q e q* for the three unit vectors e, as columns: q multiplies from the left, q* from the right."""
    x, y, z, w = quaternion.tolist()
    left = np.array([[w, -z, y, x], [z, w, -x, y], [-y, x, w, z], [-x, -y, -z, w]])
    right = np.array([[w, -z, y, -x], [z, w, -x, -y], [-y, x, w, -z], [x, y, z, w]])
    product: Array = left @ right
    return product[:3, :3]
