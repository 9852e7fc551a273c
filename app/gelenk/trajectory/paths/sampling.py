"""Compiled samples of lines, turns and curves, as paths are made of: one call for many places."""

import math

import numpy as np

from gelenk.kinematics.simd.vectors import Vector, dot, plus, row, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import compiled, inlined
from gelenk.robot.notations import rotations_from_vectors
from gelenk.trajectory.motion.evaluation import evaluated
from gelenk.trajectory.paths.rotation_rates import angular_motion

_TINY = 1e-300


@compiled
def on_line(start: Array, end: Array, length: float, s: Array) -> tuple[Array, Array, Array]:
    """Return position [m], unit tangent and its derivative, zero, on a line at arc lengths [m]; (N,) → (N, 3) each."""
    positions, tangents = np.empty((len(s), 3)), np.zeros((len(s), 3))
    for k in range(3):
        direction = (end[k] - start[k]) / length if length > 0.0 else 0.0
        for i in range(len(s)):
            tangents[i, k] = direction
            # Measure from the nearer end, so that both ends are exact.
            is_near = s[i] <= 0.5 * length
            positions[i, k] = start[k] + s[i] * direction if is_near else end[k] + (s[i] - length) * direction
    return positions, tangents, np.zeros((len(s), 3))


@compiled
def about_axis(start: Array, vector: Array, x: Array) -> tuple[Array, Array, Array]:
    """Return R_0 Exp(x θ), ω_x and dω_x/dx, zero, for a rotation vector θ; (N,) → (N, 3, 3), (N, 3) twice, [rad]."""
    rates, vectors = np.empty((len(x), 3)), np.empty((len(x), 3))
    for i in range(len(x)):
        for k in range(3):
            vectors[i, k] = x[i] * vector[k]
            rates[i, k] = start[k, 0] * vector[0] + start[k, 1] * vector[1] + start[k, 2] * vector[2]
    if not vector.any():
        return _same(start, len(x)), rates, np.zeros((len(x), 3))
    rotations = rotations_from_vectors(vectors)
    _turn(start, rotations, 0, len(x))
    return rotations, rates, np.zeros((len(x), 3))


@compiled
def _same(rotation: Array, count: int) -> Array:
    """Repeat a rotation, where the tip does not turn; shape (count, 3, 3)."""
    rotations = np.empty((count, 3, 3))
    rotations[:] = rotation
    return rotations


@compiled
def by_vectors(starts: Array, breaks: Array, coefficients: Array, x: Array) -> tuple[Array, Array, Array]:
    """Return R_k Exp(θ(x)), ω_x and dω_x/dx for piecewise polynomials θ, (M, d + 1, 3), and R_k, (M, 3, 3)."""
    if len(starts) == 1 and not coefficients.any():
        return _same(starts[0], len(x)), np.zeros((len(x), 3)), np.zeros((len(x), 3))
    thetas = evaluated(breaks, coefficients, x, 2)
    rotations = rotations_from_vectors(thetas[0])
    omegas, alphas = angular_motion(thetas[0], thetas[1], thetas[2])
    for i in range(len(x)):
        _turn(starts[np.searchsorted(breaks[1:-1], x[i], side="right")], rotations, i, i + 1)
        for rates in (omegas, alphas):
            _store(rates, i, 0, _applied(rotations[i], row(rates, i)))
    return rotations, omegas, alphas


@compiled
def in_proportion(
    tangents: Array, bends: Array, rates: Array, changes: Array, stretch: float, turning: float
) -> tuple[Array, Array]:
    """Return ξ_s and its derivative, (N, 6), from those of position and turn by their own coordinates, (N, 3) each."""
    first, second = np.empty((len(tangents), 6)), np.empty((len(tangents), 6))
    for i in range(len(tangents)):
        for k in range(3):
            first[i, k], first[i, 3 + k] = stretch * tangents[i, k], turning * rates[i, k]
            second[i, k], second[i, 3 + k] = stretch**2 * bends[i, k], turning**2 * changes[i, k]
    return first, second


@compiled
def turning_line(
    start: Array, end: Array, rotation: Array, vector: Array, length: float, s: Array
) -> tuple[Array, Array, Array, Array]:
    """Return positions, rotations, ξ_s and its derivative on a line of a length > 0 that turns about one axis."""
    positions, tangents, bends = on_line(start, end, length, s)
    rotations, rates, changes = about_axis(rotation, vector, s / length)
    first, second = in_proportion(tangents, bends, rates, changes, 1.0, 1.0 / length)
    return positions, rotations, first, second


@compiled
def by_arc_length(velocities: Array, bends: Array, turns: Array, changes: Array, width: float) -> tuple[Array, Array]:
    """Return ξ_s and its derivative, (N, 6), along a curve p(u).

    Args:
        velocities, bends: dp/du and d²p/du²; shape (N, 3).
        turns, changes: ω_x and dω_x/dx, where x runs from 0 to 1 over the width of u; shape (N, 3).
    """
    first, second = np.empty((len(turns), 6)), np.empty((len(turns), 6))
    for i in range(len(turns)):
        velocity, bend = row(velocities, i), row(bends, i)
        speed = math.sqrt(dot(velocity, velocity))
        tangent = scaled(1.0 / max(speed, _TINY), velocity)
        growth, turn = dot(tangent, bend), scaled(1.0 / (width * speed), row(turns, i))
        change = scaled(1.0 / width**2, row(changes, i))
        _store(first, i, 0, tangent)
        _store(first, i, 3, turn)
        _store(second, i, 0, scaled(1.0 / speed**2, plus(bend, -growth, tangent)))
        _store(second, i, 3, scaled(1.0 / speed**2, plus(change, -growth, turn)))
    return first, second


@inlined
def _store(rows: Array, i: int, first: int, vector: Vector) -> None:
    for k in range(3):
        rows[i, first + k] = vector[k]


@inlined
def _applied(R: Array, vector: Vector) -> Vector:
    return dot(row(R, 0), vector), dot(row(R, 1), vector), dot(row(R, 2), vector)


@inlined
def _turn(R: Array, rotations: Array, begin: int, end: int) -> None:
    """Multiply rotations from the left, in place."""
    for i in range(begin, end):
        for k in range(3):
            column = _applied(R, (rotations[i, 0, k], rotations[i, 1, k], rotations[i, 2, k]))
            rotations[i, 0, k], rotations[i, 1, k], rotations[i, 2, k] = column
