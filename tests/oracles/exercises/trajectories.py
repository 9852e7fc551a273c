"""Solutions by conditions as linear equations, by sampling, and by integrating speeds."""

import math
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve
from scipy.spatial.transform import Rotation

FINE = 20_001


def polynomial(conditions: list[tuple[float, int, float]]) -> np.polynomial.Polynomial:
    """Through values (time, order of the derivative, value), as one linear system."""
    size = len(conditions)
    rows = [
        [math.perm(k, order) * time ** (k - order) if k >= order else 0.0 for k in range(size)]
        for time, order, _ in conditions
    ]
    return np.polynomial.Polynomial(np.linalg.solve(rows, [value for _, _, value in conditions]))


def largest(law: Any, total: float) -> float:
    return float(np.abs(law(np.linspace(0.0, total, FINE))).max())


def rest(one: Any) -> dict[str, Any]:
    T, angle = one.time, one.angle * math.pi / 180
    cubic = polynomial([(0, 0, 0), (0, 1, 0), (T, 0, angle), (T, 1, 0)])
    quintic = polynomial([(0, 0, 0), (0, 1, 0), (0, 2, 0), (T, 0, angle), (T, 1, 0), (T, 2, 0)])
    speeds = largest(cubic.deriv(), T), largest(quintic.deriv(), T)
    return {"velocity": speeds[0], "acceleration": largest(cubic.deriv(2), T), "quintic": speeds[1]}


def cubic(one: Any) -> dict[str, Any]:
    T, change = one.time, one.q1 - one.q0
    law = polynomial([(0, 0, one.q0), (0, 1, one.v0), (T, 0, one.q1), (T, 1, one.v1)])
    unit = polynomial([(0, 0, 0), (0, 1, one.v0 * T / change), (1, 0, 1), (1, 1, one.v1 * T / change)])
    return {"coefficients": unit.coef[:0:-1], "middle": law(T / 2), "speed": law.deriv()(T / 2)}


def shortest(length: float, v: float, a: float) -> tuple[float, float, float]:
    """Ramp, time in all and speed: the highest speed whose two ramps fit."""
    speeds = np.linspace(0.0, v, 2_000_001)[1:]
    speed = float(speeds[speeds**2 / a <= length * (1 + 1e-12)][-1])
    return speed / a, 2 * speed / a + (length - speed**2 / a) / speed, speed


def way(length: float, v: float, a: float, time: float) -> float:
    """The area below the speed, by the trapezium rule on the corners."""
    ramp, total, speed = shortest(length, v, a)
    corners = np.unique([t for t in (0.0, ramp, total - ramp, total, time) if t <= time])
    speeds = np.interp(corners, [0.0, ramp, total - ramp, total], [0.0, speed, speed, 0.0])
    return float(np.trapezoid(speeds, corners))


def profile(one: Any) -> dict[str, Any]:
    ramp, total, peak = shortest(one.length, one.velocity, one.acceleration)
    return {
        "ramp": ramp,
        "total": total,
        "peak": peak,
        "place": way(one.length, one.velocity, one.acceleration, one.time),
    }


def pair(one: Any) -> dict[str, Any]:
    found = [shortest(abs(d), v, a) for d, v, a in ((one.d1, one.v1, one.a1), (one.d2, one.v2, one.a2))]
    times = np.array([total for _, total, _ in found])
    ramp, own, peak = found[int(times.argmin())]
    k = times.max() / own
    return {
        "times": times,
        "total": times.max(),
        "factor": k,
        "velocity": peak / k,
        "acceleration": (peak / k) / (ramp * k),
    }


def spline(one: Any) -> dict[str, Any]:
    law = CubicSpline(one.times, one.knots, bc_type="clamped")
    inner = np.array(one.times[1:3])
    return {"velocities": law(inner, 1), "start": law(one.times[0], 2), "middle": law(inner.mean())}


def corner(one: Any) -> dict[str, Any]:
    """The time before B at full speed from which a mean of both velocities leads to the other leg."""
    A, B, C = (complex(*point) for point in (one.start, one.corner, one.end))
    before, after = one.v1 * (B - A) / abs(B - A), one.v2 * (C - B) / abs(C - B)

    def missed(times: Any) -> Any:
        apart = B - before * times[0] + (before + after) / 2 * one.time - (B + after * times[1])
        return apart.real, apart.imag

    if abs((before.conjugate() * after).imag) < 1e-9:
        t1 = t2 = one.time / 2
    else:
        t1, t2 = fsolve(missed, (one.time, 0.0))
    entry, exit_ = B - before * t1, B + after * t2
    return {
        "distances": [abs(entry - B), abs(exit_ - B)],
        "entry": [entry.real, entry.imag],
        "exit": [exit_.real, exit_.imag],
        "acceleration": abs(after - before) / one.time,
    }


def line(one: Any) -> dict[str, Any]:
    start, end = np.array(one.start), np.array(one.end)
    length = math.sqrt(sum((b - a) ** 2 for a, b in zip(one.start, one.end, strict=True)))
    covered = way(length, one.velocity, one.acceleration, one.time)
    _, total, speed = shortest(length, one.velocity, one.acceleration)
    unit = (end - start) / length
    return {"length": length, "total": total, "place": start + covered * unit, "velocity": speed * unit}


def scaling(one: Any) -> dict[str, Any]:
    laws = [polynomial([(0, 0, 0), (0, 1, 0), (one.time, 0, d), (one.time, 1, 0)]) for d in (one.d1, one.d2)]
    k_vel = max(largest(law.deriv(), one.time) / v for law, v in zip(laws, (one.v1, one.v2), strict=True))
    k_acc = max(largest(law.deriv(2), one.time) / a for law, a in zip(laws, (one.a1, one.a2), strict=True))
    k = max(1.0, k_vel, math.sqrt(k_acc))
    return {"k_vel": k_vel, "k_acc": k_acc, "k": k, "time": k * one.time}


def turn(one: Any) -> dict[str, Any]:
    start = Rotation.from_euler("Z", one.first, degrees=True)
    end = Rotation.from_euler("ZX", [one.second, one.tilt], degrees=True)
    vector = (start.inv() * end).as_rotvec()
    angle = float(np.linalg.norm(vector))
    law = polynomial([(0, 0, 0), (0, 1, 0), (one.time, 0, angle), (one.time, 1, 0)])
    speed = largest(law.deriv(), one.time)
    return {"angle": angle, "axis": vector / angle, "velocity": (end * start.inv()).as_rotvec() / angle * speed}


def planned(one: Any) -> dict[str, Any]:
    """Joints by Newton's method along the line, their rates by differences."""

    def tip(q: Any) -> Any:
        return np.array([one.l1 * np.cos(q[0]) + one.l2 * np.cos(q[0] + q[1]),
                         one.l1 * np.sin(q[0]) + one.l2 * np.sin(q[0] + q[1])])  # fmt: skip

    q = np.radians([one.q1, one.q2])
    start, end = tip(q), np.array([one.x, one.y])
    length = math.dist(start, end)
    _, total, speed = shortest(length, one.velocity, one.acceleration)

    def joints(share: float, guess: Any) -> Any:
        return fsolve(lambda x: tip(x) - start - share * (end - start), guess, xtol=1e-11)

    for share in np.linspace(0.0, 0.5, 26):
        q = joints(share, q)
    step = 1e-5
    rates = (joints(0.5 + step, q) - joints(0.5 - step, q)) / (2 * step) * speed / length
    k = max(1.0, max(abs(rates)) / one.joint_limit)
    return {
        "start": start,
        "length": length,
        "total": total,
        "joints": q,
        "rates": rates,
        "factor": k,
        "slowed": k * total,
    }


SOLUTIONS = {
    "trajectories.rest": rest,
    "trajectories.cubic": cubic,
    "trajectories.profile": profile,
    "trajectories.pair": pair,
    "trajectories.spline": spline,
    "trajectories.corner": corner,
    "trajectories.line": line,
    "trajectories.scaling": scaling,
    "trajectories.turn": turn,
    "trajectories.planned": planned,
}
DIGESTS = {
    "trajectories.rest:1": "e9b0821ae67311f8",
    "trajectories.cubic:1": "76fcbe6439042558",
    "trajectories.line:1": "a1f7f60ab71cef45",
    "trajectories.profile:1": "67fe540cdffbc7fb",
    "trajectories.corner:1": "6e5ff7705912abd2",
    "trajectories.pair:1": "2a6276576c405347",
    "trajectories.scaling:1": "73cde3f1797fecd7",
    "trajectories.spline:1": "5ef844a5d00044f2",
    "trajectories.turn:1": "edd392d49cf01d36",
    "trajectories.planned:1": "5c100f5307c86284",
}
