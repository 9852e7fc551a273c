"""Tracking of solutions in complex joint values while the arm and its target change.

The loop E_1 E_2 E_3 = M E_6⁻¹ E_5⁻¹ E_4⁻¹ is closed in its middle, between joints 3 and 4, where the fewest joints
amplify rounding. Arm and target are linear in a parameter t from 0 to 1, directions and quaternions up to their
length. Cubic extrapolation predicts, Newton's method corrects, and the corrections control the step size.
"""

import cmath
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from gelenk.kinematics.simd.vectors import cross, dot, minus, plus, scaled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged

ComplexArray: TypeAlias = npt.NDArray[np.complex128]
_Vector: TypeAlias = tuple[Any, Any, Any]

JOINTS = 6
_HALF = JOINTS // 2
_ROTATION, _POSITION = 12, 15
"""Rows of `Room.place` where the target's rotation and position begin, after the axes and the points."""
_STEPS, _SHORTEST, _LAST = 3000, 1e-14, 1e-10
"""Most steps of a path, the shortest step, and the distance to its end that Newton's method alone may cover."""
_FIRST = 0.02
_CORRECTIONS, _CORRECTED = 4, 1e-6
_POLISHING, _POLISHED = 60, 1e-15
_BEYOND = 1e6
"""Value of a prismatic joint that counts as infinite, in sizes of the arm."""


class Room(NamedTuple):
    """Working space for one path.

    Attributes:
        q, slope: Joint values, and their derivatives by t; shape (6,) each.
        before, slope_before: The same one step before.
        trial: Predicted, then corrected joint values; shape (6,).
        turns: Cosine and sine of each joint value; shape (6, 2).
        place: Axes, points and target at some t; shape (16, 3).
        system: Jacobian and error of the loop; shape (6, 7).
    """

    q: ComplexArray
    slope: ComplexArray
    before: ComplexArray
    slope_before: ComplexArray
    trial: ComplexArray
    turns: ComplexArray
    place: ComplexArray
    system: ComplexArray


@compiled
def follow(
    screws: ComplexArray, targets: ComplexArray, slides: Indices, starts: ComplexArray, longest: float, far: float
) -> tuple[ComplexArray, Array]:
    """Follow the solutions of an arm and a target while both change into others.

    Args:
        screws: Axes, then points, of the arm at either end; shape (2, 12, 3).
        targets: Quaternion w x y z, then position, at either end; shape (2, 7).
        starts: Solutions at t = 0; shape (k, 6).
        longest: Largest first correction [rad or sizes of the arm]; a larger one shortens the step.
        far: Imaginary part [rad] beyond which a path counts as lost to infinity.

    Returns:
        Solutions at t = 1, shape (k, 6), and the lengths of the last Newton steps there, shape (k,): as small as
        rounding at an isolated solution, infinite for a lost path.
    """
    ends, lengths = np.empty_like(starts), np.empty(len(starts))
    rows = np.empty((5, JOINTS), np.complex128)
    room = Room(
        rows[0],
        rows[1],
        rows[2],
        rows[3],
        rows[4],
        np.empty((JOINTS, 2), np.complex128),
        np.empty((16, 3), np.complex128),
        np.empty((JOINTS, JOINTS + 1), np.complex128),
    )
    for i in range(len(starts)):
        for j in range(JOINTS):
            room.q[j] = starts[i, j]
        lengths[i] = _followed(screws, targets, slides, longest, far, room)
        for j in range(JOINTS):
            ends[i, j] = room.q[j]
    return ends, lengths


@unmanaged
def _followed(
    screws: ComplexArray, targets: ComplexArray, slides: Indices, longest: float, far: float, room: Room
) -> float:
    t, h, t_before = 0.0, _FIRST, -1.0
    _rates(screws, targets, slides, t, room)
    for _ in range(_STEPS):
        following = t + h if t + h < 1.0 - _LAST else 1.0
        _predict(t_before, t, following, room)
        _put_in_place(screws, targets, following, room.place)
        first = _corrected(slides, longest, room)
        if first < 0.0:
            h = 0.4 * (following - t)
            if h < _SHORTEST:
                return np.inf
            if following == 1.0 and h < _LAST:
                break
            continue
        if _is_far(slides, far, room.trial):
            return np.inf
        for j in range(JOINTS):
            room.before[j], room.slope_before[j], room.q[j] = room.q[j], room.slope[j], room.trial[j]
        h = (following - t) * min(2.0, 0.9 * (0.1 * longest / max(first, 1e-12)) ** 0.25)
        t_before, t = t, following
        if t == 1.0:
            break
        _rates(screws, targets, slides, t, room)
    if t < 1.0 - 2.0 * _LAST:
        return np.inf
    _put_in_place(screws, targets, 1.0, room.place)
    return _polished(slides, room)


@inlined
def _predict(t_before: float, t: float, following: float, room: Room) -> None:
    """Extrapolate by the cubic through the last two points and their derivatives; linearly from the first point."""
    step, back = following - t, t - t_before
    if t_before < 0.0:
        for j in range(JOINTS):
            room.trial[j] = room.q[j] + step * room.slope[j]
        return
    s = 1.0 + step / back
    a, b = (1.0 + 2.0 * s) * (1.0 - s) ** 2, s * (1.0 - s) ** 2 * back
    c, d = s * s * (3.0 - 2.0 * s), s * s * (s - 1.0) * back
    for j in range(JOINTS):
        room.trial[j] = a * room.before[j] + b * room.slope_before[j] + c * room.q[j] + d * room.slope[j]


@unmanaged
def _corrected(slides: Indices, longest: float, room: Room) -> float:
    """Correct `trial` to a solution; return the length of the first step, or -1 if too long or without convergence."""
    first = 0.0
    for k in range(_CORRECTIONS):
        length = _newton(slides, room.trial, room)
        if k == 0:
            first = length
        if not first <= longest or (k > 0 and length > max(0.3 * first, _CORRECTED)):
            return -1.0
        if length < _CORRECTED:
            return first
    return -1.0


@unmanaged
def _polished(slides: Indices, room: Room) -> float:
    """Refine `q` to rounding; return the length of the last step."""
    least = np.inf
    for _ in range(_POLISHING):
        length = _newton(slides, room.q, room)
        if not length < 1e3:
            return np.inf
        if length <= _POLISHED:
            return length
        if length < _CORRECTED and length >= 0.5 * least:
            return max(length, least)
        least = min(length, least)
    return least


@inlined
def _is_far(slides: Indices, far: float, q: ComplexArray) -> bool:
    for j in range(JOINTS):
        if (slides[j] == 0 and abs(q[j].imag) > far) or (slides[j] == 1 and _size(q[j]) > _BEYOND):
            return True
    return False


@unmanaged
def _newton(slides: Indices, q: ComplexArray, room: Room) -> float:
    _close(slides, q, True, room)
    length = _solve(room.system)
    if length < 1e3:
        for j in range(JOINTS):
            q[j] += room.system[j, JOINTS]
    return length


@unmanaged
def _rates(screws: ComplexArray, targets: ComplexArray, slides: Indices, t: float, room: Room) -> None:
    """Compute the derivatives of the joint values by t from a difference of the loop's error; leave `place` at t."""
    step = 1e-7
    _put_in_place(screws, targets, t + step, room.place)
    _close(slides, room.q, False, room)
    for k in range(JOINTS):
        room.slope[k] = room.system[k, JOINTS]
    _put_in_place(screws, targets, t, room.place)
    _close(slides, room.q, True, room)
    for k in range(JOINTS):
        room.system[k, JOINTS] = (room.slope[k] - room.system[k, JOINTS]) / step
    _solve(room.system)
    for k in range(JOINTS):
        room.slope[k] = room.system[k, JOINTS]


@inlined
def _row(rows: ComplexArray, i: int) -> _Vector:
    return rows[i, 0], rows[i, 1], rows[i, 2]


@inlined
def _put(rows: ComplexArray, i: int, a: _Vector) -> None:
    rows[i, 0], rows[i, 1], rows[i, 2] = a


@unmanaged
def _put_in_place(screws: ComplexArray, targets: ComplexArray, t: float, place: ComplexArray) -> None:
    for i in range(2 * JOINTS):
        p = plus(scaled(1.0 - t, _row(screws[0], i)), t, _row(screws[1], i))
        length: Any = cmath.sqrt(dot(p, p))
        _put(place, i, scaled(1.0 / length, p) if i < JOINTS else p)
    a, b, u = targets[0], targets[1], 1.0 - t
    w, x, y, z = u * a[0] + t * b[0], u * a[1] + t * b[1], u * a[2] + t * b[2], u * a[3] + t * b[3]
    n = 2.0 / (w * w + x * x + y * y + z * z)
    _put(place, _ROTATION, (1.0 - n * (y * y + z * z), n * (x * y - w * z), n * (x * z + w * y)))
    _put(place, _ROTATION + 1, (n * (x * y + w * z), 1.0 - n * (x * x + z * z), n * (y * z - w * x)))
    _put(place, _ROTATION + 2, (n * (x * z - w * y), n * (y * z + w * x), 1.0 - n * (x * x + y * y)))
    for k in range(3):
        place[_POSITION, k] = u * a[4 + k] + t * b[4 + k]


@inlined
def _turned(h: _Vector, c: Any, s: Any, a: _Vector) -> _Vector:
    return plus(plus(scaled(c, a), (1.0 - c) * dot(h, a), h), s, cross(h, a))


@inlined
def _moved(place: ComplexArray, slides: Indices, i: int, q: Any, turn: tuple[Any, Any], p: _Vector) -> _Vector:
    """Turn a point about the line of joint i, or slide it along."""
    h, o = _row(place, i), _row(place, JOINTS + i)
    return plus(p, q, h) if slides[i] else plus(o, 1.0, _turned(h, *turn, minus(p, o)))


@inlined
def _by_target(place: ComplexArray, a: _Vector) -> _Vector:
    return dot(_row(place, _ROTATION), a), dot(_row(place, _ROTATION + 1), a), dot(_row(place, _ROTATION + 2), a)


@unmanaged
def _close(slides: Indices, q: ComplexArray, with_jacobian: bool, room: Room) -> None:
    """Fill `system` with the error of the loop and, if requested, its Jacobian."""
    turns, place, system = room.turns, room.place, room.system
    for i in range(JOINTS):
        ahead, back = cmath.exp(1j * q[i]), cmath.exp(-1j * q[i])
        turns[i, 0], turns[i, 1] = 0.5 * (ahead + back), -0.5j * (ahead - back)
    zero, one = 0j, 1.0 + 0j
    p: _Vector = zero, zero, zero
    x: _Vector = one, zero, zero
    y: _Vector = zero, one, zero
    # At a solution, moving once around the loop from its middle is the identity.
    for k in range(JOINTS):
        i = (_HALF + k) % JOINTS
        if k == _HALF:
            p = plus(_by_target(place, p), 1.0, _row(place, _POSITION))
            x, y = _by_target(place, x), _by_target(place, y)
        turn = turns[i, 0], -turns[i, 1]
        p = _moved(place, slides, i, -q[i], turn, p)
        if slides[i] == 0:
            x, y = _turned(_row(place, i), *turn, x), _turned(_row(place, i), *turn, y)
    z = cross(x, y)
    for k in range(3):
        system[k, JOINTS] = p[k]
    system[3, JOINTS], system[4, JOINTS] = 0.5 * (y[2] - z[1]), 0.5 * (z[0] - x[2])
    system[5, JOINTS] = 0.5 * (x[1] - y[0])
    if with_jacobian:
        _fill_jacobian(slides, q, room)


@unmanaged
def _fill_jacobian(slides: Indices, q: ComplexArray, room: Room) -> None:
    """Fill the Jacobian with the joints' twists, moved to the middle of the loop by the joints in between."""
    turns, place, system = room.turns, room.place, room.system
    for i in range(JOINTS):
        h, o = _row(place, i), _row(place, JOINTS + i)
        sign = -1.0 if i < _HALF else 1.0
        for k in range(_HALF - 1 - i if i < _HALF else i - _HALF):
            j = i + 1 + k if i < _HALF else i - 1 - k
            turn = turns[j, 0], sign * turns[j, 1]
            o = _moved(place, slides, j, sign * q[j], turn, o)
            if slides[j] == 0:
                h = _turned(_row(place, j), *turn, h)
        v = h if slides[i] else cross(o, h)
        for k in range(3):
            system[k, i], system[3 + k, i] = v[k], 0.0 if slides[i] else h[k]


@inlined
def _size(a: Any) -> float:
    size: float = abs(a.real) + abs(a.imag)
    return size


@unmanaged
def _solve(A: ComplexArray) -> float:
    """Solve by elimination with partial pivoting into the last column; return the largest entry of the solution."""
    for j in range(JOINTS):
        best = j
        for k in range(j + 1, JOINTS):
            if _size(A[k, j]) > _size(A[best, j]):
                best = k
        if not _size(A[best, j]) > 1e-300:
            return np.inf
        for m in range(j, JOINTS + 1):
            A[j, m], A[best, m] = A[best, m], A[j, m]
        inverse = 1.0 / A[j, j]
        for k in range(j + 1, JOINTS):
            factor = A[k, j] * inverse
            for m in range(j + 1, JOINTS + 1):
                A[k, m] -= factor * A[j, m]
        A[j, j] = inverse
    largest = 0.0
    for i in range(JOINTS):
        j = JOINTS - 1 - i
        total = A[j, JOINTS]
        for m in range(j + 1, JOINTS):
            total -= A[j, m] * A[m, JOINTS]
        A[j, JOINTS] = total * A[j, j]
        largest = max(largest, _size(A[j, JOINTS]))
    return largest
