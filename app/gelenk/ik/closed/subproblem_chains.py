"""Closed forms as compiled compositions of the geometric subproblems, one target at a time.

A chain is a product of screws: T = E_1 ⋯ E_n T_0, where E_i turns about or slides along the line of joint i at the
zero configuration, and T_0 is the tip's pose there [Brockett1984]. With M = T T_0⁻¹ the classes are

- `DECOUPLED`: the last revolute axes intersect in a point. The joints before them move that point to its image under
  M, and they set the orientation. Backwards, with M⁻¹ = E_n⁻¹ ⋯ E_1⁻¹, this also solves a spherical shoulder.
- `PARALLEL`: axes 2, 3 and 4 are parallel to h. E_2 E_3 E_4 preserves heights along h, which determine q_1 and q_5.
- `ELBOW`: seven joints, the first three axes intersecting in one point and the last three in another. The distance of
  the two points determines the elbow joint; the elbow turns freely about the line between them.
- `GENERAL`: six revolute joints of any geometry, see `elimination`.

The candidates are only as exact as the geometry; `branch_kernels` polishes and checks them.
"""

import math
from typing import NamedTuple, TypeAlias

from gelenk.ik.closed.elimination import Scratch, eliminated, first_two, next_two, third_joint
from gelenk.ik.closed.subproblems import (
    BEYOND,
    Coefficients,
    Quadratic,
    Turn,
    angle_of,
    angle_onto,
    back,
    both,
    directions_at,
    product,
    rest_of,
    slides_at,
    slides_of_quadratic,
    turn_of,
    turn_onto,
    turned_by,
    turns_at,
    turns_of_quadratic,
    value,
)
from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, plus, row, scaled, turned
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import inlined, unmanaged

DECOUPLED, PARALLEL, ELBOW, GENERAL = 0, 1, 2, 3
"""Classes of arms."""
SKEW, COPLANAR, OBLIQUE, SQUARE, RAILS = 0, 1, 2, 3, 4
"""Forms of a positioning arm, by its joints 1 and 2: `SKEW` and `COPLANAR` if joint 2 is revolute; if it is prismatic,
`OBLIQUE` or perpendicular (`SQUARE`) to a revolute joint 1, or `RAILS` with a prismatic one."""

MOST = 32
"""Largest number of candidates of a target."""
FIRST_ROOT, SECOND_ROOT, LAST_ROOT, ARM_ROOT, ROOT_NUMBER = 1, 2, 4, 8, 4
"""Bits of a candidate's code, each for one of two roots; from bit `ROOT_NUMBER` on, the number of a quartic's root."""

_NO_ARM = 1e-10
"""Lever arm [m, or sine of an angle] below which a joint has no effect and is free."""
_FLAT = 1e-7
"""Sine of the middle of three turns below which it may be rounding."""
_NEARLY_FLAT = 1e-2
"""Sine below which its square is more accurate than the cosine."""
_OF_DOUBLE_ROOT = 1e-6
"""Lever arm [sine] below which it may be the error of a quartic's double root, and an angle from it wrong."""

_TURNS_TRIED = 16
"""Number of angles of a free joint at which the other joints are solved for."""
_MOST_BEFORE_LAST = 12
"""Candidates beyond which there may be no room for those at the extreme angles of a free joint."""

Motion: TypeAlias = tuple[float, float, float, float, float, float, float, float, float, float, float, float]
"""A displacement: rotation row by row, then translation."""

_Third: TypeAlias = tuple[Vector, Vector, Vector, Coefficients]
"""The vector v of `_positions` and its square as functions of joint 3."""


class SubproblemPlan(NamedTuple):
    """How an arm is solved, with its joints in solving order: from the tip if `backwards`.

    Attributes:
        kind: `DECOUPLED`, `PARALLEL`, `ELBOW` or `GENERAL`.
        form: How the positioning joints are solved: `SKEW`, `COPLANAR`, `OBLIQUE`, `SQUARE` or `RAILS`.
        placed: Number of joints that position the wrist point; 3 for `ELBOW`.
        axes, points: Joint axes at zero, and a point on each [m]; shape (n, 3) each.
        slides: 1 for a prismatic joint; shape (n,).
        order: The positioning joints in the order of elimination; shape (3,).
        lines: Constants of the positioning arm, see `closed_form`; shape (16, 3).
        zero: T_0⁻¹, rotation row by row, then translation; shape (12,).
        reach: Bound on prismatic joints and on the size of the arm, [m].
        terms: Left sides of the equations of a general arm, see `elimination`; else empty.
    """

    kind: int
    backwards: int
    form: int
    placed: int
    axes: Array
    points: Array
    slides: Indices
    order: Indices
    lines: Array
    zero: Array
    reach: float
    terms: Array


class Candidates(NamedTuple):
    """The candidates that a composition finds for one target, and space for finding them.

    Attributes:
        values: Joint values, in solving order; shape (MOST, n), [rad or m].
        codes, free: Bits of the roots chosen, and of the free joints, which kept the seed's value; shape (MOST,) each.
        roots: Space for the roots of an equation; shape (8,).
        first: Values of the positioning joints, in the order of elimination; shape (8, 3), [rad or m].
        turns: Cosine and sine of those that turn; shape (8, 3, 2).
        marks: Their codes and bit masks of free joints; shape (2, 8).
        doubtful: 1 if a root may be double, so that rounding may have cost solutions; shape (1,).
    """

    values: Array
    codes: Indices
    free: Indices
    roots: Array
    first: Array
    turns: Array
    marks: Indices
    doubtful: Indices


# Rows of `Plan.lines`.
_AXIS, _POINT, _SQUARE, _LEVEL, _ALONG, _ACROSS, _SOLVE, _CENTRE, _LEVER = 0, 3, 6, 8, 9, 10, 11, 13, 14


@inlined
def compose(
    plan: SubproblemPlan, target: Array, seed: Array, elbow_angle: float, found: Candidates, space: Scratch
) -> int:
    """Compute the candidates of one target, T_base_tip as rotation row by row, then position; return their number.

    Free joints keep the values of the seed, which is in solving order. `ELBOW` alone uses the angle, [rad], and
    `GENERAL` alone the space.
    """
    M = _displacement(plan, target)
    found.doubtful[0] = 0
    if plan.kind == PARALLEL:
        return _parallel(plan, M, seed, found)
    if plan.kind == ELBOW:
        return _elbow(plan, M, seed, elbow_angle, found)
    if plan.kind == GENERAL:
        return _general(plan, M, found, space)
    return _decoupled(plan, M, seed, found)


@inlined
def _displacement(plan: SubproblemPlan, t: Array) -> Motion:
    """Compute M = T T_0⁻¹, or its inverse if the arm is solved backwards."""
    z = plan.zero
    T = t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8], t[9], t[10], t[11]
    x, y, w = _rotated(T, (z[0], z[3], z[6])), _rotated(T, (z[1], z[4], z[7])), _rotated(T, (z[2], z[5], z[8]))
    p = (
        t[9] + t[0] * z[9] + t[1] * z[10] + t[2] * z[11],
        t[10] + t[3] * z[9] + t[4] * z[10] + t[5] * z[11],
        t[11] + t[6] * z[9] + t[7] * z[10] + t[8] * z[11],
    )
    if plan.backwards:
        return x[0], x[1], x[2], y[0], y[1], y[2], w[0], w[1], w[2], -dot(x, p), -dot(y, p), -dot(w, p)
    return x[0], y[0], w[0], x[1], y[1], w[1], x[2], y[2], w[2], p[0], p[1], p[2]


@inlined
def _rotated(M: Motion, a: Vector) -> Vector:
    return (
        M[0] * a[0] + M[1] * a[1] + M[2] * a[2],
        M[3] * a[0] + M[4] * a[1] + M[5] * a[2],
        M[6] * a[0] + M[7] * a[1] + M[8] * a[2],
    )


@inlined
def _displaced(M: Motion, a: Vector) -> Vector:
    return plus(_rotated(M, a), 1.0, (M[9], M[10], M[11]))


@inlined
def _about(plan: SubproblemPlan, i: int, turn: Turn, a: Vector) -> Vector:
    """Turn a point about the line of joint i."""
    o = row(plan.points, i)
    return plus(o, 1.0, turned_by(row(plan.axes, i), turn, minus(a, o)))


@inlined
def _decoupled(plan: SubproblemPlan, M: Motion, seed: Array, found: Candidates) -> int:
    """Find the joints that position the wrist point, then for each solution the turns of the wrist."""
    centre = row(plan.lines, _CENTRE)
    goal = _displaced(M, centre)
    ways = 1
    if plan.placed == 0:
        found.marks[0, 0], found.marks[1, 0] = 0, 0
    elif plan.order[0] < plan.order[1]:
        ways = _positions(plan, centre, goal, seed, found)
    else:
        ways = _positions(plan, goal, centre, seed, found)
    count = 0
    for way in range(ways):
        count = _with_wrist(plan, M, way, seed, found, count)
    return count


@inlined
def _with_wrist(plan: SubproblemPlan, M: Motion, way: int, seed: Array, found: Candidates, count: int) -> int:
    """Combine one positioning of the wrist point with all turns of the wrist; return the new number of candidates."""
    last, left = len(plan.axes) - 1, len(plan.axes) - plan.placed
    square = row(plan.lines, _SQUARE)
    a, y = _rotated(M, row(plan.axes, last)), _rotated(M, square)
    for i in range(plan.placed):
        if plan.slides[i] == 0:
            turn = found.turns[way, plan.order[i], 0], -found.turns[way, plan.order[i], 1]
            a, y = turned_by(row(plan.axes, i), turn, a), turned_by(row(plan.axes, i), turn, y)
    for sign in range(2):
        values = found.values[count]
        for k in range(plan.placed):
            values[plan.order[k]] = found.first[way, k]
        found.codes[count], found.free[count] = found.marks[0, way], found.marks[1, way]
        if left < 3:
            _few_turns(plan, a, y, square, values)
            return count + 1
        outcome, lost = _three_turns(plan, plan.placed, a, y, square, sign == 1, seed, values)
        if outcome < 0:
            break
        found.codes[count] += LAST_ROOT * sign
        found.free[count] += lost << plan.placed
        count += 1
        if outcome == 0:
            break
    return count


@inlined
def _few_turns(plan: SubproblemPlan, a: Vector, y: Vector, square: Vector, values: Array) -> None:
    """Solve the last two joints, one or none, from the images of the last axis and a vector perpendicular to it."""
    last, left = len(plan.axes) - 1, len(plan.axes) - plan.placed
    if left == 2:
        h = row(plan.axes, last - 1)
        values[last - 1] = angle_onto(h, row(plan.axes, last), a)
        y = turned(h, -values[last - 1], y)
    if left > 0:
        values[last] = angle_onto(row(plan.axes, last), square, y)


@inlined
def _three_turns(
    plan: SubproblemPlan, i: int, a: Vector, y: Vector, square: Vector, second: bool, seed: Array, values: Array
) -> tuple[int, int]:
    """Solve joints i, i + 1, i + 2, whose axes f, g, h intersect, for their `values`.

    With R = R_f R_g R_h, a is R h, and y is R times the vector `square` to h. Return 1 if there are two solutions, 0 if
    only this one, -1 if none; and 1 if joint i was free, else 0.
    """
    f, g, h = row(plan.axes, i), row(plan.axes, i + 1), row(plan.axes, i + 2)
    axial = dot(g, h) * dot(f, g)
    middle, half, good = directions_at((axial - dot(f, a), dot(f, h) - axial, dot(f, cross(g, h))))
    if not good:
        return -1, 0
    b = turned_by(g, both(middle, half if second else back(half)), h)
    outcome, lost = 1, 0
    across, level = cross(f, b), cross(f, a)
    if dot(across, across) < _NEARLY_FLAT * _NEARLY_FLAT:
        side = 1.0 if second == (half[0] < 0.0) else -1.0
        b = _by_lean(b, g, f, side, dot(level, level))
    if dot(level, level) < _NO_ARM * _NO_ARM and dot(across, across) < _FLAT * _FLAT:
        values[i], first = seed[i], turn_of(seed[i])
        outcome, lost = 0, 1
    else:
        first = turn_onto(f, b, a)
        values[i] = angle_of(first)
    a, y = turned_by(f, back(first), a), turned_by(f, back(first), y)
    following = turn_onto(g, h, a)
    values[i + 1] = angle_of(following)
    values[i + 2] = angle_onto(h, square, turned_by(g, back(following), y))
    return outcome, lost


@inlined
def _by_lean(b: Vector, g: Vector, f: Vector, side: float, lean: float) -> Vector:
    """Refine a direction b, which joint g has turned close to axis f, by its angle to f.

    Where its two solutions nearly meet, the cosine gives joint g to half the digits only. The sine keeps all of them,
    even if rounding of the axes keeps g from ever bringing b exactly onto f.

    `side` is 1 if b lies on the side of f × g, times the sign of b along f, else -1; `lean` is the squared sine of the
    angle between b and f. Return the part of b perpendicular to f.
    """
    beside, aside = plus(g, -dot(f, g), f), cross(f, g)
    along, square = math.copysign(1.0, dot(b, f)), dot(aside, aside)
    part = (dot(b, g) - along * dot(f, g) * math.sqrt(1.0 - lean)) / square
    rest = math.sqrt(max(lean / square - part * part, 0.0))
    return plus(scaled(part, beside), along * side * rest, aside)


@inlined
def _positions(plan: SubproblemPlan, start: Vector, goal: Vector, seed: Array, found: Candidates) -> int:
    """Solve E_1 E_2 E_3 start = goal for the joints in the order of elimination; the third may be missing.

    Joint 1 preserves two quantities of a point: height along the axis and distance from a point on it if revolute, two
    coordinates perpendicular to the axis if prismatic. With v from a point on axis 2 to E_3 start, and u = E_2 v, both
    have the form β·u + γ u² = k. Eliminating joint 2 leaves one equation in joint 3, on which v depends.
    """
    L = plan.lines
    o1, o2 = row(L, _POINT), row(L, _POINT + 1)
    slides = plan.slides
    near = minus(goal, o2)
    k1, k2 = dot(row(L, _LEVER), near), dot(row(L, _LEVER + 1), near)
    bent, off_axis = 0.0, -1.0
    if slides[plan.order[0]] == 0:
        reach, offset = minus(goal, o1), minus(o2, o1)
        k2 = dot(reach, reach) - dot(offset, offset)
        bent = 1.0
        if dot(offset, offset) == 0.0:
            across = cross(row(L, _AXIS), reach)
            off_axis = math.sqrt(dot(across, across))
    reached = _third(plan, start, o2)
    if plan.form <= COPLANAR:
        ways = _by_turn(plan, reached, k1, k2, bent, off_axis, seed, found)
    else:
        ways = _by_slide(plan, reached, k1, k2, seed, found)
    return _finished(plan, start, goal, seed, ways, found)


@inlined
def _third(plan: SubproblemPlan, start: Vector, o2: Vector) -> _Third:
    zero = (0.0, 0.0, 0.0)
    if plan.placed < 3:
        v0 = minus(start, o2)
        return v0, zero, zero, (dot(v0, v0), 0.0, 0.0)
    h3 = row(plan.lines, _AXIS + 2)
    if plan.slides[plan.order[2]]:
        v0 = minus(start, o2)
        return v0, h3, zero, (dot(v0, v0), 2.0 * dot(v0, h3), 1.0)
    o3 = row(plan.lines, _POINT + 2)
    arm = minus(start, o3)
    along = scaled(dot(h3, arm), h3)
    v1 = minus(arm, along)
    v2 = cross(h3, arm)
    v0 = plus(minus(o3, o2), 1.0, along)
    return v0, v1, v2, (dot(v0, v0) + dot(v1, v1), 2.0 * dot(v0, v1), 2.0 * dot(v0, v2))


@inlined
def _along(a: Vector, v0: Vector, v1: Vector, v2: Vector) -> Coefficients:
    return dot(a, v0), dot(a, v1), dot(a, v2)


@inlined
def _sum(a: Coefficients, factor: float, b: Coefficients) -> Coefficients:
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


@inlined
def _total(f: Quadratic, factor: float, g: Quadratic) -> Quadratic:
    return (
        f[0] + factor * g[0], f[1] + factor * g[1], f[2] + factor * g[2],
        f[3] + factor * g[3], f[4] + factor * g[4], f[5] + factor * g[5],
    )  # fmt: skip


@inlined
def _basis(slides: int, q: float) -> Coefficients:
    """Return 1, cos q, sin q for a revolute joint, or 1, q, q² for a prismatic one."""
    if slides:
        return 1.0, q, q * q
    return 1.0, math.cos(q), math.sin(q)


@inlined
def _roots_of(slides: int, g: Coefficients, kept: float) -> tuple[float, float, bool, bool]:
    """Solve a function of joint 3 for zeros, see `turns_at`; also flag a zero function, whose root is `kept`."""
    if abs(g[0]) + abs(g[1]) + abs(g[2]) < _NO_ARM * _NO_ARM:
        return kept, 0.0, True, True
    if slides:
        middle, half, good = slides_at(g[2], g[1], g[0])
    else:
        middle, half, good = turns_at(g)
    return middle, half, good, False


@inlined
def _third_slides(plan: SubproblemPlan) -> int:
    return plan.slides[plan.order[2]] if plan.placed == 3 else 1


@unmanaged
def _quadratic_roots(plan: SubproblemPlan, f: Quadratic, found: Candidates) -> int:
    """Solve a quadratic equation for joint 3; return the number of roots, or one zero without a joint 3."""
    if plan.placed < 3:
        found.roots[0] = 0.0
        return 1
    if _third_slides(plan):
        return slides_of_quadratic(f, plan.reach, found.roots)
    return turns_of_quadratic(f, found.roots)


@inlined
def _by_turn(
    plan: SubproblemPlan,
    reached: _Third,
    k1: float,
    k2: float,
    bent: float,
    off_axis: float,
    seed: Array,
    found: Candidates,
) -> int:
    """Solve joints 2 and 3 if joint 2 is revolute: u has v's height and length, and two equations give its direction.

    If axes 1 and 2 intersect, `off_axis` is the distance of the goal from axis 1, else negative.
    """
    L, slides = plan.lines, _third_slides(plan)
    v0, v1, v2, square = reached
    h2 = row(L, _AXIS + 1)
    height = _along(h2, v0, v1, v2)
    b1 = _sum((k1, 0.0, 0.0), -L[_LEVEL, 0], height)
    b2 = _sum(_sum((k2, 0.0, 0.0), -bent, square), -L[_LEVEL, 1], height)
    radial = _total((square[0], square[1], square[2], 0.0, 0.0, 0.0), -1.0, product(height, height))
    x, y = row(L, _ALONG), row(L, _ACROSS)
    lean = L[_LEVEL, 0]
    first, marks = found.first, found.marks
    count = 0
    if plan.form == SKEW:
        c1 = _sum(_sum((0.0, 0.0, 0.0), L[_SOLVE, 0], b1), L[_SOLVE, 1], b2)
        c2 = _sum(_sum((0.0, 0.0, 0.0), L[_SOLVE + 1, 0], b1), L[_SOLVE + 1, 1], b2)
        f = _total(_total(product(c1, c1), 1.0, product(c2, c2)), -1.0, radial)
        for k in range(_quadratic_roots(plan, f, found)):
            q3 = found.roots[k]
            basis = _basis(slides, q3)
            u = plus(scaled(value(c1, basis), x), value(c2, basis), y)
            v = plus(plus(scaled(basis[0], v0), basis[1], v1), basis[2], v2)
            first[count, 1], first[count, 2] = angle_onto(h2, v, u), q3
            marks[0, count], marks[1, count] = k << ROOT_NUMBER, 0
            count += 1
        return count
    middle, half, good, idle = 0.0, 0.0, True, False
    if plan.placed == 3:
        g = _sum(_sum((0.0, 0.0, 0.0), L[_SOLVE, 0], b1), L[_SOLVE, 1], b2)
        middle, half, good, idle = _roots_of(slides, g, seed[plan.order[2]])
    if not good:
        return 0
    lost = 1 << plan.order[2] if idle else 0
    level = _sum(_sum((0.0, 0.0, 0.0), L[_SOLVE + 1, 0], b1), L[_SOLVE + 1, 1], b2)
    for third in range(2 if plan.placed == 3 else 1):
        q3 = middle + half if third else middle - half
        basis = _basis(slides, q3)
        v = plus(plus(scaled(basis[0], v0), basis[1], v1), basis[2], v2)
        across = cross(h2, v)
        length, w = dot(across, across), value(level, basis)
        if length - w * w < -BEYOND * (length + w * w):
            continue
        side = rest_of(math.sqrt(length), w)
        if 0.0 <= off_axis < math.sqrt(length):
            # A smaller triangle at axis 1 has the same side, and gives it with more digits.
            side = rest_of(off_axis, (value(height, basis) - lean * k1) / math.sqrt(1.0 - lean * lean))
        for sign in range(2):
            u = plus(scaled(w, x), side if sign else -side, y)
            first[count, 1], first[count, 2] = angle_onto(h2, v, u), q3
            marks[0, count], marks[1, count] = FIRST_ROOT * third + SECOND_ROOT * sign, lost
            if length < _NO_ARM * _NO_ARM:
                marks[1, count] |= 1 << plan.order[1]
            count += 1
    return count


@unmanaged
def _by_slide(plan: SubproblemPlan, reached: _Third, k1: float, k2: float, seed: Array, found: Candidates) -> int:
    """Solve joints 2 and 3 if joint 2 is prismatic: u = v + q_2 h_2."""
    L, slides = plan.lines, _third_slides(plan)
    v0, v1, v2, square = reached
    h2, l1, l2 = row(L, _AXIS + 1), row(L, _LEVER), row(L, _LEVER + 1)
    miss = _sum(scaled(-1.0, _along(l1, v0, v1, v2)), 1.0, (k1, 0.0, 0.0))
    first, marks = found.first, found.marks
    count = 0
    if plan.form == OBLIQUE:
        q2 = scaled(1.0 / L[_LEVEL, 0], miss)
        height = _along(h2, v0, v1, v2)
        f = _total(
            _total((square[0] - k2, square[1], square[2], 0.0, 0.0, 0.0), 2.0, product(q2, height)),
            1.0,
            product(q2, q2),
        )
        for k in range(_quadratic_roots(plan, f, found)):
            first[count, 2] = found.roots[k]
            first[count, 1] = value(q2, _basis(slides, found.roots[k]))
            marks[0, count], marks[1, count] = k << ROOT_NUMBER, 0
            count += 1
        return count
    middle, half, good, idle = 0.0, 0.0, True, False
    if plan.placed == 3:
        middle, half, good, idle = _roots_of(slides, miss, seed[plan.order[2]])
    if not good:
        return 0
    lost = 1 << plan.order[2] if idle else 0
    for third in range(2 if plan.placed == 3 and half > 0.0 else 1):
        q3 = middle + half if third else middle - half
        basis = _basis(slides, q3)
        v = plus(plus(scaled(basis[0], v0), basis[1], v1), basis[2], v2)
        if plan.form == RAILS:
            first[count, 1], first[count, 2] = (k2 - dot(l2, v)) / L[_LEVEL, 1], q3
            marks[0, count], marks[1, count] = FIRST_ROOT * third, lost
            count += 1
            continue
        near, far, good = slides_at(1.0, 2.0 * dot(h2, v), value(square, basis) - k2)
        if not good:
            continue
        for sign in range(2):
            first[count, 1], first[count, 2] = near + far if sign else near - far, q3
            marks[0, count], marks[1, count] = FIRST_ROOT * third + SECOND_ROOT * sign, lost
            count += 1
    return count


@inlined
def _finished(plan: SubproblemPlan, start: Vector, goal: Vector, seed: Array, ways: int, found: Candidates) -> int:
    """Solve joint 1 for each solution of the others, and set free joints to the seed's values."""
    L, slides = plan.lines, plan.slides
    h1, h2, o1, o2 = row(L, _AXIS), row(L, _AXIS + 1), row(L, _POINT), row(L, _POINT + 1)
    h3, o3 = row(L, _AXIS + 2), row(L, _POINT + 2)
    reach = minus(goal, o1)
    level = cross(h1, reach)
    for way in range(ways):
        values, turns, p = found.first[way], found.turns[way], start
        if plan.placed == 3:
            p = _moved(slides[plan.order[2]], h3, o3, values[2], turns[2], p)
        if found.marks[1, way] & 1 << plan.order[1]:
            values[1] = seed[plan.order[1]]
        p = _moved(slides[plan.order[1]], h2, o2, values[1], turns[1], p)
        if slides[plan.order[0]]:
            values[0] = dot(h1, minus(goal, p))
        elif dot(level, level) < _NO_ARM * _NO_ARM:
            values[0] = seed[plan.order[0]]
            turns[0, 0], turns[0, 1] = turn_of(values[0])
            found.marks[1, way] |= 1 << plan.order[0]
        else:
            turns[0, 0], turns[0, 1] = turn_onto(h1, minus(p, o1), reach)
            values[0] = angle_of((turns[0, 0], turns[0, 1]))
    return ways


@inlined
def _moved(slides: int, h: Vector, o: Vector, q: float, turn: Array, p: Vector) -> Vector:
    """Move a point by a joint along h, or about the line along h through o; fill in its cosine and sine."""
    if slides:
        return plus(p, q, h)
    turn[0], turn[1] = turn_of(q)
    return plus(o, 1.0, turned_by(h, (turn[0], turn[1]), minus(p, o)))


@inlined
def _parallel(plan: SubproblemPlan, M: Motion, seed: Array, found: Candidates) -> int:
    """Solve joints 1 and 5 by heights along h, of a point on the last axis and of its direction; then 6, 2, 3 and 4.

    E_1⁻¹ M and E_5 E_6 differ by a motion that preserves heights along h. Both heights are linear in cos q_1, sin q_1
    on one side and in cos q_5, sin q_5 on the other, so (cos q_5, sin q_5) is eliminated like joint 2 in `_by_turn`.
    """
    L = plan.lines
    h, h1, o1 = row(plan.axes, 1), row(plan.axes, 0), row(plan.points, 0)
    lean = dot(h, h1)
    r, d = minus(_displaced(M, row(plan.points, 5)), o1), _rotated(M, row(plan.axes, 5))
    rise, tilt = lean * dot(h1, r), lean * dot(h1, d)
    b1 = (dot(h, o1) + rise - L[_LEVER, 0], dot(h, r) - rise, -dot(h, cross(h1, r)))
    b2 = (tilt - L[_LEVER + 1, 0], dot(h, d) - tilt, -dot(h, cross(h1, d)))
    x, y = L[_ALONG, 0], L[_ALONG, 1]
    c1 = _sum(scaled(L[_SOLVE, 0], b1), L[_SOLVE, 1], b2)
    c2 = _sum(scaled(L[_SOLVE + 1, 0], b1), L[_SOLVE + 1, 1], b2)
    count = 0
    if plan.form == SKEW:
        f = _total(_total(product(c1, c1), 1.0, product(c2, c2)), -1.0, (1.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        for k in range(turns_of_quadratic(f, found.roots)):
            first = turn_of(found.roots[k])
            basis = (1.0, first[0], first[1])
            fifth = turn_of(math.atan2(value(c2, basis), value(c1, basis)))
            count = _in_plane(plan, M, first, fifth, 0.0, k << ROOT_NUMBER, seed, found, count)
        return count
    middle, half, good = directions_at(c1)
    if not good:
        return 0
    for one in range(2):
        first = both(middle, half if one else back(half))
        w = value(c2, (1.0, first[0], first[1]))
        if abs(w) > 1.0 + BEYOND:
            continue
        side = rest_of(1.0, w)
        if side == 0.0:
            w = math.copysign(1.0, w)
        for other in range(2):
            s = side if other else -side
            fifth = w * x - s * y, w * y + s * x
            code = FIRST_ROOT * one + LAST_ROOT * other
            count = _in_plane(plan, M, first, fifth, math.copysign(1.0, s * w), code, seed, found, count)
    return count


@inlined
def _in_plane(
    plan: SubproblemPlan,
    M: Motion,
    first: Turn,
    fifth: Turn,
    side: float,
    code: int,
    seed: Array,
    found: Candidates,
    count: int,
) -> int:
    """Solve joint 6 from the image of h, and joints 2, 3 and 4 as a planar arm; return the new number of candidates.

    `fifth`, the turn of joint 5, may be accurate only to half the digits; `side` is its side relative to where its two
    solutions meet, ±1, or 0 if unknown.
    """
    h, h5, h6 = row(plan.axes, 1), row(plan.axes, 4), row(plan.axes, 5)
    outwards = turned_by(row(plan.axes, 0), first, h)
    g = (
        M[0] * outwards[0] + M[3] * outwards[1] + M[6] * outwards[2],
        M[1] * outwards[0] + M[4] * outwards[1] + M[7] * outwards[2],
        M[2] * outwards[0] + M[5] * outwards[1] + M[8] * outwards[2],
    )
    b = turned_by(h5, back(fifth), h)
    across, level = cross(h6, b), cross(h6, g)
    if side != 0.0 and dot(across, across) < _NEARLY_FLAT * _NEARLY_FLAT:
        b = _by_lean(b, h5, h6, side, dot(level, level))
    told = dot(across, across) >= _FLAT * _FLAT or dot(level, level) >= _NO_ARM * _NO_ARM
    before = count
    if told:
        sixth = turn_onto(h6, g, b)
        count = _planar(plan, M, first, g, angle_of(sixth), sixth, 0, code, seed, found, count)
        if side != 0.0 or dot(level, level) >= _OF_DOUBLE_ROOT * _OF_DOUBLE_ROOT:
            return count
    if side == 0.0:
        found.doubtful[0] = 1
    mean, swing, furthest = _reaches(plan, M, first, fifth)
    for k in range(_TURNS_TRIED + 2):
        if count > before:
            break
        # Joint 6 is free: from the seed's angle on, try angles until the planar joints can reach, at last those with
        # the smallest and the largest distance from joint 2 to joint 4.
        q6 = seed[5] + (k + 1) // 2 * (2.0 * math.pi / _TURNS_TRIED) * (1.0 if k % 2 else -1.0)
        if k >= _TURNS_TRIED:
            q6 = furthest + (math.pi if k == _TURNS_TRIED else 0.0)
        count = _planar(plan, M, first, g, q6, turn_of(q6), 1 << 5, code, seed, found, count)
    for k in range(4 if side == 0.0 else 0):
        # The extreme angles that they reach, stretched and folded: joint 3 is singular there too.
        away = _span(plan, k < 2) ** 2 - mean
        if abs(away) <= swing and count < _MOST_BEFORE_LAST:
            q6 = furthest + (1.0 if k % 2 else -1.0) * math.acos(away / swing)
            count = _planar(plan, M, first, g, q6, turn_of(q6), 1 << 5, code, seed, found, count)
    return count


@unmanaged
def _span(plan: SubproblemPlan, stretched: bool) -> float:
    """Distance from joint 2 to joint 4 with joint 3 stretched or, as a signed number, folded, [m]."""
    h, o2, o3, o4 = row(plan.axes, 1), row(plan.points, 1), row(plan.points, 2), row(plan.points, 3)
    base, arm = _flattened(h, minus(o3, o2)), _flattened(h, minus(o4, o3))
    return math.sqrt(dot(base, base)) + (1.0 if stretched else -1.0) * math.sqrt(dot(arm, arm))


@unmanaged
def _reaches(plan: SubproblemPlan, M: Motion, first: Turn, fifth: Turn) -> tuple[float, float, float]:
    """Squared distance from joint 2 to joint 4 as a function of joint 6, if its axis is parallel to theirs.

    Return its mean and amplitude [m²], and the angle of joint 6 where it is largest [rad].
    """
    h, o2, p5 = row(plan.axes, 1), row(plan.points, 1), _about(plan, 4, back(fifth), row(plan.points, 3))
    squares = (0.0, 0.0, 0.0)
    for k in range(3):
        p4 = _about(plan, 0, back(first), _displaced(M, _about(plan, 5, turn_of(-0.5 * math.pi * k), p5)))
        reach = _flattened(h, minus(p4, o2))
        squares = (squares[1], squares[2], dot(reach, reach))
    mean = 0.5 * (squares[0] + squares[2])
    along, across = squares[0] - mean, squares[1] - mean
    return mean, math.hypot(along, across), math.atan2(across, along)


@inlined
def _planar(
    plan: SubproblemPlan,
    M: Motion,
    first: Turn,
    g: Vector,
    q6: float,
    sixth: Turn,
    lost: int,
    code: int,
    seed: Array,
    found: Candidates,
    count: int,
) -> int:
    """Solve joint 5 from the image g of h, then 2, 3 and 4; `lost` has the bits of the free joints; see `_in_plane`."""
    h, h1, h5, h6 = row(plan.axes, 1), row(plan.axes, 0), row(plan.axes, 4), row(plan.axes, 5)
    square = row(plan.lines, _SQUARE)
    fifth = turn_onto(h5, turned_by(h6, sixth, g), h)
    x = turned_by(h1, back(first), _rotated(M, turned_by(h6, back(sixth), turned_by(h5, back(fifth), square))))
    theta = angle_onto(h, square, x)
    o2, o3, o4 = row(plan.points, 1), row(plan.points, 2), row(plan.points, 3)
    p4 = _about(plan, 0, back(first), _displaced(M, _about(plan, 5, back(sixth), _about(plan, 4, back(fifth), o4))))
    h3 = row(plan.axes, 2)
    arm, base, reach = _flattened(h, minus(o4, o3)), _flattened(h, minus(o3, o2)), _flattened(h, minus(p4, o2))
    middle, half, good = directions_at(
        (dot(base, base) + dot(arm, arm) - dot(reach, reach), 2.0 * dot(base, arm), 2.0 * dot(base, cross(h3, arm)))
    )
    if not good:
        return count
    q1, q5 = angle_of(first), angle_of(fifth)
    for sign in range(2):
        values = found.values[count]
        third = both(middle, half if sign else back(half))
        q3 = angle_of(third)
        u = plus(base, 1.0, turned_by(h3, third, arm))
        found.free[count] = lost
        if dot(reach, reach) < _NO_ARM * _NO_ARM:
            q2 = seed[1]
            found.free[count] = lost + 2
        else:
            q2 = angle_onto(row(plan.axes, 1), u, reach)
        rest = theta - q2 - dot(h, h3) * q3
        values[0], values[1], values[2] = q1, q2, q3
        values[3], values[4], values[5] = (rest if dot(h, row(plan.axes, 3)) > 0.0 else -rest), q5, q6
        found.codes[count] = code + SECOND_ROOT * sign
        count += 1
    return count


@inlined
def _flattened(h: Vector, a: Vector) -> Vector:
    return plus(a, -dot(h, a), h)


@unmanaged
def _elbow(plan: SubproblemPlan, M: Motion, seed: Array, elbow_angle: float, found: Candidates) -> int:
    """Solve the elbow joint by the distance from shoulder to wrist, then the shoulder, then the wrist."""
    L = plan.lines
    shoulder, centre = row(L, _POINT), row(L, _CENTRE)
    line = minus(_displaced(M, centre), shoulder)
    h4, o4 = row(plan.axes, 3), row(plan.points, 3)
    arm, base = minus(centre, o4), minus(o4, shoulder)
    axial = scaled(dot(h4, arm), h4)
    fixed, moving = plus(base, 1.0, axial), minus(arm, axial)
    middle, half, good = turns_at(
        (
            dot(fixed, fixed) + dot(moving, moving) - dot(line, line),
            2.0 * dot(fixed, moving),
            2.0 * dot(fixed, cross(h4, arm)),
        )
    )
    count = 0
    if not good:
        return 0
    for bend in range(2):
        q4 = middle + half if bend else middle - half
        at_zero = plus(base, 1.0, turned(h4, q4, arm))
        aside, along = _flattened(_unit(at_zero), base), cross(row(plan.axes, 2), at_zero)
        straight = dot(aside, aside) < _NO_ARM and dot(along, along) < _NO_ARM
        S = _shoulder_turn(row(plan.axes, 0), line, at_zero, base, elbow_angle)
        a, y = _rotated(S, row(plan.axes, 2)), _rotated(S, row(L, _SQUARE + 1))
        for first in range(2):
            values = found.values[count]
            outcome, lost = _three_turns(plan, 0, a, y, row(L, _SQUARE + 1), first == 1, seed, values)
            if outcome < 0:
                break
            if straight:
                # The line from shoulder to wrist is axis 3: the elbow turns without moving.
                values[2], lost = seed[2], lost | 1 << 2
            q1, q2, q3 = values[0], values[1], values[2]
            b, z = _rotated(M, row(plan.axes, 6)), _rotated(M, row(L, _SQUARE))
            values[3] = q4
            for i in range(4):
                b, z = turned(row(plan.axes, i), -values[i], b), turned(row(plan.axes, i), -values[i], z)
            for last in range(2):
                values = found.values[count]
                values[0], values[1], values[2], values[3] = q1, q2, q3, q4
                ending, lost_too = _three_turns(plan, 4, b, z, row(L, _SQUARE), last == 1, seed, values)
                if ending < 0:
                    break
                found.codes[count] = SECOND_ROOT * bend + ARM_ROOT * first + LAST_ROOT * last
                found.free[count] = lost + (lost_too << 4)
                count += 1
                if ending == 0:
                    break
            if outcome == 0:
                break
    return count


@unmanaged
def _shoulder_turn(h1: Vector, line: Vector, at_zero: Vector, elbow: Vector, angle: float) -> Motion:
    """Rotation that turns the wrist point at_zero onto a line, both from the shoulder, and the elbow about it."""
    n, m = _unit(line), _unit(at_zero)
    d = turned(n, angle, _where_zero(n, h1))
    e = _flattened(m, elbow)
    e = _unit(e) if dot(e, e) > 1e-20 else _unit(cross(m, (1.0, 0.0, 0.0) if abs(m[0]) < 0.9 else (0.0, 1.0, 0.0)))
    f, g = cross(n, d), cross(m, e)
    return (
        n[0] * m[0] + d[0] * e[0] + f[0] * g[0], n[0] * m[1] + d[0] * e[1] + f[0] * g[1],
        n[0] * m[2] + d[0] * e[2] + f[0] * g[2],
        n[1] * m[0] + d[1] * e[0] + f[1] * g[0], n[1] * m[1] + d[1] * e[1] + f[1] * g[1],
        n[1] * m[2] + d[1] * e[2] + f[1] * g[2],
        n[2] * m[0] + d[2] * e[0] + f[2] * g[0], n[2] * m[1] + d[2] * e[1] + f[2] * g[1],
        n[2] * m[2] + d[2] * e[2] + f[2] * g[2],
        0.0, 0.0, 0.0,
    )  # fmt: skip


@unmanaged
def _general(plan: SubproblemPlan, M: Motion, found: Candidates, space: Scratch) -> int:
    """Solve joint 3 by elimination, then 4 and 5, then 1 and 2, then 6."""
    L, axes = plan.lines, plan.axes
    size, origin, square = L[_LEVEL, 0], row(L, _SQUARE + 1), row(L, _SQUARE)
    points = L[:6]
    p = scaled(size, minus(_displaced(M, row(plan.points, 5)), origin))
    d, y = _rotated(M, row(axes, 5)), _rotated(M, square)
    eliminated(plan.terms, axes, points, p, d, space)
    count = 0
    for k in range(third_joint(space)):
        q3 = space.roots[k]
        for pair in range(next_two(space, q3)):
            if count == MOST:
                break
            q4, q5 = space.pairs[pair, 0], space.pairs[pair, 1]
            u, m = row(points, 5), row(axes, 5)
            u, m = _screwed(axes, points, 4, q5, u), turned(row(axes, 4), q5, m)
            u, m = _screwed(axes, points, 3, q4, u), turned(row(axes, 3), q4, m)
            u, m = _screwed(axes, points, 2, q3, u), turned(row(axes, 2), q3, m)
            q1, q2 = first_two(axes, points, u, m, p, d)
            x = turned(row(axes, 1), -q2, turned(row(axes, 0), -q1, y))
            x = turned(row(axes, 4), -q5, turned(row(axes, 3), -q4, turned(row(axes, 2), -q3, x)))
            values = found.values[count]
            values[0], values[1], values[2] = q1, q2, q3
            values[3], values[4], values[5] = q4, q5, angle_onto(row(axes, 5), square, x)
            found.codes[count], found.free[count] = count << ROOT_NUMBER, 0
            count += 1
    return count


@inlined
def _screwed(axes: Array, points: Array, i: int, angle: float, p: Vector) -> Vector:
    return plus(row(points, i), 1.0, turned(row(axes, i), angle, minus(p, row(points, i))))


@inlined
def _unit(a: Vector) -> Vector:
    length = math.sqrt(dot(a, a))
    return scaled(1.0 / length if length > 0.0 else 0.0, a)


@inlined
def _where_zero(n: Vector, h1: Vector) -> Vector:
    """Direction of elbow angle zero, perpendicular to the line from shoulder to wrist."""
    d = _flattened(n, h1)
    if dot(d, d) < _NO_ARM:
        # A line along axis 1 spans no plane with it: start from any vector not along the line.
        d = _flattened(n, (1.0, 0.0, 0.0) if abs(n[0]) < 0.9 else (0.0, 1.0, 0.0))
    return _unit(d)


@unmanaged
def elbow_angle(plan: SubproblemPlan, values: Array) -> float:
    """Compute the elbow angle of an arm about the line from spherical shoulder to spherical wrist, [rad]."""
    shoulder = row(plan.lines, _POINT)
    elbow, wrist = row(plan.points, 3), row(plan.lines, _CENTRE)
    for k in range(4):
        i = 3 - k
        turn = turn_of(values[i])
        elbow, wrist = _about(plan, i, turn, elbow), _about(plan, i, turn, wrist)
    n = _unit(minus(wrist, shoulder))
    return angle_onto(n, _where_zero(n, row(plan.axes, 0)), minus(elbow, shoulder))
