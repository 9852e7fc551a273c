"""The exact response of a DC motor to a step of voltage and load, and an independent check of it."""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.course.actuators.dc_motor import Motor, OperatingPoint, modes, operating_point, rates
from gelenk.errors import CertificationFailed
from gelenk.robot.arrays import Array

_CERTIFIED_SAMPLES = 16
_RESPONSE_TOLERANCE = 1e-8
_MOST_SQUARINGS = 20
_TAYLOR_TERMS = 18


@dataclass(frozen=True, slots=True)
class Response:
    """Current and speed after a step, and their difference from an independent computation.

    Attributes:
        currents: i(t), [A]; shape (T,).
        angular_velocities: ω(t), [rad/s]; shape (T,).
        samples: Number of times at which both were recomputed by scaling and squaring.
        current_difference, angular_velocity_difference: Largest differences there, [A] and [rad/s].
    """

    currents: Array
    angular_velocities: Array
    samples: int
    current_difference: float
    angular_velocity_difference: float


def step_response(
    motor: Motor, voltage: float, load_torque: float, times: Array, initial_current: float, initial_speed: float
) -> Response:
    """Compute the exact response x(t) = x_∞ + e^{A t} (x(0) - x_∞) to V, [V], and τ_L, [N m], applied at t = 0.

    The matrix exponential is in closed form: for a 2×2 matrix with mean eigenvalue m and discriminant δ = s², e^{A t} =
    e^{m t} (cosh(s t) I + sinh(s t)/s (A - m I)), with cos and sin where δ < 0 and t where δ = 0.

    Args:
        times: Since the step, ≥ 0, [s]; shape (T,).
        initial_current: i(0), [A]; not used without inductance, because the current then has no memory.
        initial_speed: ω(0), [rad/s].
    """
    final = operating_point(motor, voltage, load_torque)
    speed_off = initial_speed - final.angular_velocity
    if motor.inductance == 0.0:
        speeds = final.angular_velocity + np.exp(-times / motor.mechanical_time_constant) * speed_off
        currents = (voltage - motor.back_emf_constant * speeds) / motor.resistance
        start = np.array([speed_off])
    else:
        current_off = initial_current - final.current
        own, other, cross = _transition(motor, times)
        currents = final.current + own * current_off - cross * (motor.back_emf_constant / motor.inductance) * speed_off
        speeds = final.angular_velocity + cross * (motor.torque_constant / motor.inertia) * current_off
        speeds = speeds + other * speed_off
        start = np.array([current_off, speed_off])
    return _certified(motor, voltage, final, start, times, currents, speeds)


def _transition(motor: Motor, times: Array) -> tuple[Array, Array, Array]:
    """Return the diagonal entries of e^{A t}, and its factor S(t) = e^{m t} sinh(s t)/s of A; each of shape (T,)."""
    electrical, mechanical, _ = rates(motor)
    half = 0.5 * (electrical - mechanical)
    found = modes(motor)
    root = math.sqrt(abs(found.discriminant))
    if found.discriminant > 0.0 and found.damping == "overdamped":
        slow, fast = (pole.real for pole in found.poles)
        decayed = np.exp(slow * times)
        even = 0.5 * (decayed + np.exp(fast * times))
        odd = decayed * -np.expm1(-2.0 * root * times) / (2.0 * root)
    else:
        decayed = np.exp(found.mean * times)
        even = decayed * np.cos(root * times) if found.damping == "underdamped" else decayed
        odd = decayed * np.sin(root * times) / root if found.damping == "underdamped" else decayed * times
    return even - half * odd, even + half * odd, odd


def _certified(
    motor: Motor, voltage: float, final: OperatingPoint, start: Array, times: Array, currents: Array, speeds: Array
) -> Response:
    """Recompute the response at a few of its times by Taylor series, scaling and squaring, and return it.

    In the coordinates i √(L k_t), ω √(J k_e) no motor lengthens a state, so squaring is safe. Times that would need
    more than 20 squarings are left out, because rounding would dominate there.
    """
    if len(start) == 1:
        weights, A = np.ones(1), np.array([[-1.0 / motor.mechanical_time_constant]])
    else:
        electrical, mechanical, coupling = rates(motor)
        stored = [motor.inductance * motor.torque_constant, motor.inertia * motor.back_emf_constant]
        weights, A = np.sqrt(stored), np.array([[-electrical, -coupling], [coupling, -mechanical]])
    reach = 2.0 ** (_MOST_SQUARINGS - 1) / float(np.abs(A).sum())
    usable = np.flatnonzero(times <= reach)
    chosen = usable[np.linspace(0, len(usable) - 1, min(len(usable), _CERTIFIED_SAMPLES)).astype(int)]
    states = exponential(A, times[chosen]) @ (weights * start) / weights
    other_speeds = final.angular_velocity + states[:, -1]
    other_currents = (voltage - motor.back_emf_constant * other_speeds) / motor.resistance
    if len(start) == 2:
        other_currents = final.current + states[:, 0]
    speed_errors, current_errors = np.abs(other_speeds - speeds[chosen]), np.abs(other_currents - currents[chosen])
    size = float(np.linalg.norm(weights * start)) + float(weights[-1]) * abs(final.angular_velocity)
    worst = float(np.max(speed_errors, initial=0.0)) * float(weights[-1])
    if len(start) == 2:
        size += float(weights[0]) * abs(final.current)
        worst = max(worst, float(np.max(current_errors, initial=0.0)) * float(weights[0]))
    if worst > _RESPONSE_TOLERANCE * size:
        raise CertificationFailed("the step response", worst / size, _RESPONSE_TOLERANCE)
    differences = (float(np.max(errors, initial=0.0)) for errors in (current_errors, speed_errors))
    return Response(currents, speeds, len(chosen), *differences)


def exponential(A: Array, times: Array) -> Array:
    """Compute e^{A t} by the Taylor series of A t / 2^k, squared k times; shape (T, n, n)."""
    scaled = A * times[:, None, None]
    largest = float(np.max(np.abs(scaled).sum(axis=(1, 2)), initial=0.0))
    squarings = max(0, math.ceil(math.log2(largest)) + 1) if largest > 0.0 else 0
    scaled = scaled / 2.0**squarings
    identity = np.eye(len(A))
    result = np.broadcast_to(identity, scaled.shape)
    for order in range(_TAYLOR_TERMS, 0, -1):
        result = identity + scaled @ result / order
    for _ in range(squarings):
        result = result @ result
    return result
