"""Geometric subproblems of inverse kinematics, each answered by least squares if it has no solution.

A closed form is a composition of these: turning one vector onto another [Paden1986], a point on a circle at a given
height or distance (both linear in cosine and sine), and the intersection of a circle with a quadric, a quartic
[Elias2022]. Rounding may put a target at the boundary of the workspace, where two solutions meet, out of reach. An
equation without solutions therefore returns the nearest values, and recomputing the pose shows whether they are good.
"""

import math
from typing import TypeAlias

import numpy as np

from gelenk.kinematics.simd.vectors import Vector, cross, dot, plus, scaled
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import inlined, unmanaged

Coefficients: TypeAlias = tuple[float, float, float]
"""A function of a joint: coefficients of 1, cos q, sin q for a revolute joint, of 1, q, q² for a prismatic one."""
Quadratic: TypeAlias = tuple[float, float, float, float, float, float]
"""A product of two such functions: coefficients 00, 01, 02, 11, 12, 22."""

Turn: TypeAlias = tuple[float, float]
"""Cosine and sine of an angle, which cost less to find and to apply than the angle."""

BEYOND = 1e-4
"""Largest residual, relative to the largest term, with which the nearest answer is still tried."""
ROUNDING = 2e-15
"""Rounding error of a difference of squares, as a share of them."""
_ROUNDS = 60
"""Most rounds of a bracketed Newton iteration, which usually takes about six."""


@inlined
def angle_onto(axis: Vector, a: Vector, b: Vector) -> float:
    """Angle about a unit axis that turns a as close to b as possible, [rad]."""
    # Remove the parts along the axis first: doing it later would cost all digits of vectors nearly along it.
    u, w = cross(axis, a), cross(axis, b)
    return angle_of((dot(u, w), dot(axis, cross(u, w))))


@inlined
def turn_onto(axis: Vector, a: Vector, b: Vector) -> Turn:
    """Cosine and sine of `angle_onto`."""
    u, w = cross(axis, a), cross(axis, b)
    c, s = dot(u, w), dot(axis, cross(u, w))
    length = math.sqrt(c * c + s * s)
    return (c / length, s / length) if length > 0.0 else (1.0, 0.0)


@inlined
def turn_of(angle: float) -> Turn:
    """Cosine and sine of an angle, [rad]."""
    return math.cos(angle), math.sin(angle)


@inlined
def angle_of(turn: Turn) -> float:
    """Angle of a turn of any length, [rad], within 5e-16; 0 if the length is 0. A sine of -0 counts as 0.

    Unlike `math.atan2` it is no call, which would cost more than the arithmetic, and has no branches. The coefficients
    are those of Moshier's Cephes library.
    """
    run, rise = abs(turn[0]), abs(turn[1])
    steep = rise > run
    far, near = (rise, run) if steep else (run, rise)
    diagonal = near > 0.66 * far
    top, bottom = (near - far, near + far) if diagonal else (near, far)
    x = top / (1.0 if bottom == 0.0 else bottom)
    z = x * x
    p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z
         - 1.228866684490136173410e2) * z - 6.485021904942025371773e1  # fmt: skip
    q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z
         + 4.853903996359136964868e2) * z + 1.945506571482613964425e2  # fmt: skip
    angle = x + x * (z * p / q)
    angle = 0.25 * math.pi + angle if diagonal else angle
    angle = 0.5 * math.pi - angle if steep else angle
    angle = math.pi - angle if turn[0] < 0.0 else angle
    return -angle if turn[1] < 0.0 else angle


@inlined
def back(turn: Turn) -> Turn:
    """Reverse a turn."""
    return turn[0], -turn[1]


@inlined
def both(a: Turn, b: Turn) -> Turn:
    """Turn by two angles."""
    return a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]


@inlined
def turned_by(axis: Vector, turn: Turn, a: Vector) -> Vector:
    """Rotate a vector about a unit axis, as `turned` does by an angle."""
    return plus(plus(scaled(turn[0], a), (1.0 - turn[0]) * dot(axis, a), axis), turn[1], cross(axis, a))


@inlined
def rest_of(length: float, part: float) -> float:
    """Other side of a right triangle, √(length² - part²), to the accuracy of length - part.

    It is 0 if the difference is mere rounding: then the two solutions that differ in its sign coincide.
    """
    square = (length - part) * (length + part)
    return math.sqrt(square) if square > ROUNDING * length * length else 0.0


@inlined
def turns_at(g: Coefficients) -> tuple[float, float, bool]:
    """Solve g₀ + g₁ cos q + g₂ sin q = 0; return midpoint and half-distance of the angles, and whether to try them."""
    middle, half, good = directions_at(g)
    return angle_of(middle), angle_of(half), good


@inlined
def directions_at(g: Coefficients) -> tuple[Turn, Turn, bool]:
    """Solve as `turns_at`, for cosines and sines."""
    length = math.sqrt(g[1] * g[1] + g[2] * g[2])
    if length <= 1e-12 * abs(g[0]) or length < 1e-14:
        return (1.0, 0.0), (1.0, 0.0), False
    cosine = -g[0] / length
    sine = rest_of(1.0, cosine)
    if sine == 0.0:
        cosine = math.copysign(1.0, cosine)
    return (g[1] / length, g[2] / length), (cosine, sine), abs(g[0]) <= (1.0 + BEYOND) * length


@inlined
def slides_at(a: float, b: float, c: float) -> tuple[float, float, bool]:
    """Solve a x² + b x + c = 0; return midpoint and half-distance of the roots, and whether to try them."""
    if abs(a) <= 1e-12 * abs(b):
        return (-c / b, 0.0, True) if b != 0.0 else (0.0, 0.0, False)
    if a == 0.0:
        return 0.0, 0.0, False
    middle = -0.5 * b / a
    square = middle * middle - c / a
    good = square >= -BEYOND * (middle * middle + abs(c / a))
    return middle, math.sqrt(max(square, 0.0)), good


@inlined
def product(a: Coefficients, b: Coefficients) -> Quadratic:
    """Multiply two functions of a joint."""
    return (
        a[0] * b[0],
        a[0] * b[1] + a[1] * b[0],
        a[0] * b[2] + a[2] * b[0],
        a[1] * b[1],
        a[1] * b[2] + a[2] * b[1],
        a[2] * b[2],
    )


@inlined
def value(a: Coefficients, basis: Coefficients) -> float:
    """Evaluate a function of a joint at a value, given as 1, cos q, sin q or 1, q, q²."""
    return a[0] * basis[0] + a[1] * basis[1] + a[2] * basis[2]


@unmanaged
def turns_of_quadratic(f: Quadratic, roots: Array) -> int:
    """Find the angles at which a quadratic function of cosine and sine vanishes, or nearly touches zero.

    The unknown is the tangent of the half-angle, infinite where the function is largest, away from all roots. The
    `roots`, shape (8,), are in ascending order, [rad]; return their number.
    """
    largest, far = -1.0, 0.0
    for k in range(8):
        angle = k * (math.pi / 4.0)
        size = abs(_quadratic_at(f, math.cos(angle), math.sin(angle)))
        if size > largest:
            largest, far = size, angle
    c, s = math.cos(far - math.pi), math.sin(far - math.pi)
    f1, f2 = c * f[1] + s * f[2], c * f[2] - s * f[1]
    f3 = c * c * f[3] + c * s * f[4] + s * s * f[5]
    f4 = 2.0 * c * s * (f[5] - f[3]) + (c * c - s * s) * f[4]
    f5 = s * s * f[3] - c * s * f[4] + c * c * f[5]
    count = roots_of_quartic(
        f[0] - f1 + f3, 2.0 * (f2 - f4), 2.0 * (f[0] - f3) + 4.0 * f5, 2.0 * (f2 + f4), f[0] + f1 + f3, np.inf, roots
    )
    for k in range(count):
        roots[k] = far - math.pi + 2.0 * math.atan(roots[k])
    return count


@inlined
def _quadratic_at(f: Quadratic, c: float, s: float) -> float:
    return f[0] + f[1] * c + f[2] * s + f[3] * c * c + f[4] * c * s + f[5] * s * s


@unmanaged
def slides_of_quadratic(f: Quadratic, reach: float, roots: Array) -> int:
    """Find such roots for a prismatic joint, within ±reach [m]; return their number."""
    return roots_of_quartic(f[5], f[4], f[2] + f[3], f[1], f[0], reach, roots)


@unmanaged
def roots_of_quartic(a: float, b: float, c: float, d: float, e: float, reach: float, roots: Array) -> int:
    """Find the real roots of a x⁴ + b x³ + c x² + d x + e within ±reach, and the points where it nearly touches zero.

    Between neighbouring roots of its derivative a polynomial has at most one root. So the roots of the second
    derivative, a quadratic, bracket those of the first, and these bracket those of the quartic, for Newton's method.
    Neighbouring brackets share the value between them: where it is rounding, its sign must be the same for both.
    If `reach` is infinite, the bound is Cauchy's, which needs a large a. The `roots`, shape (8,), are in ascending
    order; return their number.
    """
    if reach == np.inf:
        reach = 1.0 + max(abs(b), abs(c), abs(d), abs(e)) / abs(a)
    middle, half, _ = slides_at(6.0 * a, 3.0 * b, c)
    cubic = (0.0, 4.0 * a, 3.0 * b, 2.0 * c, d)
    stations = (-reach, min(max(middle - half, -reach), reach), min(max(middle + half, -reach), reach), reach)
    turning = (reach, reach, reach)
    count, at_lower = 0, _polynomial(cubic, -reach)
    for k in range(3):
        at_upper = _polynomial(cubic, stations[k + 1])
        x, crosses = _root_between(cubic, stations[k], stations[k + 1], at_lower, at_upper)
        at_lower = at_upper
        if crosses:
            turning = (x, turning[1], turning[2]) if count == 0 else (
                (turning[0], x, turning[2]) if count == 1 else (turning[0], turning[1], x)
            )  # fmt: skip
            count += 1
    quartic = (a, b, c, d, e)
    found, lower, at_lower, touches = 0, -reach, _polynomial(quartic, -reach), False
    for k in range(count + 1):
        upper = reach if k == count else turning[k]
        at_upper = _polynomial(quartic, upper)
        x, crosses = _root_between(quartic, lower, upper, at_lower, at_upper)
        if touches and not crosses:
            # With no root on either side two meet here, perhaps but for rounding.
            roots[found] = lower
            found += 1
        if crosses:
            roots[found] = x
            found += 1
        touches = not crosses and _nearly_zero(quartic, upper, at_upper)
        lower, at_lower = upper, at_upper
    return found


@inlined
def _polynomial(p: tuple[float, float, float, float, float], x: float) -> float:
    return (((p[0] * x + p[1]) * x + p[2]) * x + p[3]) * x + p[4]


@inlined
def _nearly_zero(p: tuple[float, float, float, float, float], x: float, at_x: float) -> bool:
    y = abs(x)
    scale = (((abs(p[0]) * y + abs(p[1])) * y + abs(p[2])) * y + abs(p[3])) * y + abs(p[4])
    return abs(at_x) <= 0.01 * BEYOND * scale


@unmanaged
def _root_between(
    p: tuple[float, float, float, float, float], lower: float, upper: float, at_lower: float, at_upper: float
) -> tuple[float, bool]:
    """Find the root of a polynomial between two points; the flag is False if its values there have equal signs."""
    if at_lower == 0.0:
        return lower, upper > lower
    if (at_lower < 0.0) == (at_upper < 0.0) or upper <= lower:
        return lower, False
    x = 0.5 * (lower + upper)
    for _ in range(_ROUNDS):
        y = _polynomial(p, x)
        slope = ((4.0 * p[0] * x + 3.0 * p[1]) * x + 2.0 * p[2]) * x + p[3]
        if (y < 0.0) == (at_lower < 0.0):
            lower = x
        else:
            upper = x
        following = x - y / slope if slope != 0.0 else lower
        if y == 0.0 or (slope != 0.0 and abs(following - x) <= 4e-16 * (1.0 + abs(x))):
            return x, True
        if not lower < following < upper:
            following = 0.5 * (lower + upper)
        x = following
    return x, True
