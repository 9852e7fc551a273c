"""Six revolute joints of any geometry, solved by eliminating all joints but the third [Raghavan1993].

E_3 E_4 E_5 moves the line of joint 6 to where E_2⁻¹ E_1⁻¹ M has it. For a point p and the direction l of that line,
the fourteen numbers (p, l, p·p, p·l, p × l, (p·p) l - 2 (p·l) p) are linear in the cosine and sine of each joint on
either side. Eliminating the eight products of joints 1 and 2 from these fourteen equations leaves six. Written in the
tangents of half of q_4 and q_5, and also multiplied by the tangent for q_4, they are twelve equations in twelve
products, whose determinant vanishes at a solution. As a function of joint 3 it is a trigonometric polynomial of degree
eight. A few samples determine it, and its roots determine all other joints.

Where two solutions meet, the polynomial touches zero; such places count as roots too, and are checked like the others.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from gelenk.kinematics.simd.vectors import Vector, cross, dot, minus, plus, row, turned
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.compilation import compiled, inlined, unmanaged

EQUATIONS, PRODUCTS, ORDER = 14, 27, 12
"""Number of equations, of products of (1, cos q_3, sin q_3) with powers 0 to 2 of two tangents, and matrix size."""
_DEGREE, _SAMPLES = 8, 32
_ARCS, _TERMS, _NARROW = 64, 15, 1e-7
"""Arcs on which a polynomial replaces the slope of the determinant, its terms, and the narrowest arc [rad]."""
_HALF_ARC = math.pi / _ARCS
_TOUCHES = 1e-5
"""Share of the largest determinant below which an extremum counts as a root."""
_ROUNDS = 40
_DEFICIENT = 1e-3
"""Share of the largest pivot below which a second small one means that two solutions (nearly) share joint 3."""


def _to_bernstein() -> Array:
    """Matrix from powers of t on [-1, 1] to Bernstein polynomials; shape (_TERMS, _TERMS)."""
    degree = _TERMS - 1
    table = np.zeros((_TERMS, _TERMS))
    for m in range(_TERMS):
        # t^m = (2 s - 1)^m, and coefficient k of s^j is C(k, j) / C(degree, j).
        for j in range(m + 1):
            share = math.comb(m, j) * 2.0**j * (-1.0) ** (m - j)
            for k in range(j, _TERMS):
                table[k, m] += share * math.comb(k, j) / math.comb(degree, j)
    return table


_TO_BERNSTEIN = _to_bernstein()


class Scratch(NamedTuple):
    """Working space for one target.

    Attributes:
        left: Left sides of the equations, one column per product; shape (EQUATIONS, PRODUCTS).
        right: Right sides without their constants; shape (EQUATIONS, 8).
        values: Right sides at nine pairs of angles; shape (9, EQUATIONS).
        matrix: Matrix of the determinant; shape (ORDER, ORDER).
        series, samples: Cosine and sine coefficients of the determinant, (2, _DEGREE + 1), and samples, (_SAMPLES,).
        turns: Zeros of its slope, [rad]; shape (48,).
        stack: Bernstein coefficients of the slope on arcs still to examine; shape (64, _TERMS).
        edges: Beginnings and widths of these arcs, [rad]; shape (2, 64).
        powers: Power coefficients of the slope on an arc; shape (_TERMS,).
        roots: Roots of the determinant, [rad]; shape (32,).
        vectors, combined: Null vectors of the matrix, and a combination of two; shapes (3, ORDER) and (ORDER,).
        order: Column order after pivoting; shape (ORDER,).
        pairs: Joints 4 and 5 of a root, [rad]; shape (3, 2).
    """

    left: Array
    right: Array
    values: Array
    matrix: Array
    series: Array
    samples: Array
    turns: Array
    stack: Array
    edges: Array
    powers: Array
    roots: Array
    vectors: Array
    combined: Array
    order: Indices
    pairs: Array


@compiled
def make_space(is_used: bool) -> Scratch:
    """Allocate the working space for one target at a time; of a solver that does not eliminate, nearly none."""
    if not is_used:  # to make all arrays takes a third of a microsecond
        A, x, order = np.empty((0, 0)), np.empty(0), np.empty(0, np.int64)
        return Scratch(A, A, A, A, A, x, x, A, A, x, x, A, x, order, A)
    return Scratch(
        np.empty((EQUATIONS, PRODUCTS)),
        np.empty((EQUATIONS, 8)),
        np.empty((9, EQUATIONS)),
        np.empty((ORDER, ORDER)),
        np.empty((2, _DEGREE + 1)),
        np.empty(_SAMPLES),
        np.empty(48),
        np.empty((64, _TERMS)),
        np.empty((2, 64)),
        np.empty(_TERMS),
        np.empty(32),
        np.empty((3, ORDER)),
        np.empty(ORDER),
        np.empty(ORDER, np.int64),
        np.empty((3, 2)),
    )


@inlined
def invariants(p: Vector, d: Vector, out: Array) -> None:
    """Fill `out` with the fourteen numbers of a line through p along d, linear in each joint; shape (14,)."""
    square, mixed = dot(p, p), dot(p, d)
    moment = cross(p, d)
    for k in range(3):
        out[k], out[3 + k], out[8 + k] = p[k], d[k], moment[k]
        out[11 + k] = square * d[k] - 2.0 * mixed * p[k]
    out[6], out[7] = square, mixed


@unmanaged
def eliminated(terms: Array, axes: Array, points: Array, p: Vector, d: Vector, space: Scratch) -> None:
    """Fill the last six rows of `left` with the equations from which joints 1 and 2 are eliminated.

    `terms` are the left sides, see `left_sides`; the last line goes through p along d at the target, and all points are
    relative to that of joint 3, in units of the arm's size.
    """
    left, right = space.left, space.right
    for k in range(EQUATIONS):
        for m in range(PRODUCTS):
            left[k, m] = terms[k, m]
    third = 2.0 * math.pi / 3.0
    values = space.values
    h1, h2, o1, o2 = row(axes, 0), row(axes, 1), row(points, 0), row(points, 1)
    for i in range(3):
        x = plus(o1, 1.0, turned(h1, -third * i, minus(p, o1)))
        u = turned(h1, -third * i, d)
        for j in range(3):
            y = plus(o2, 1.0, turned(h2, -third * j, minus(x, o2)))
            invariants(y, turned(h2, -third * j, u), values[3 * i + j])
    for k in range(EQUATIONS):
        _interpolate(values, k, right, left)
    _triangulate(left, right)


@unmanaged
def _interpolate(values: Array, k: int, right: Array, left: Array) -> None:
    """Interpolate values at thirds of a turn of two joints by products of 1, cosine and sine of each."""
    half = 1.0 / math.sqrt(3.0)
    for j in range(3):
        a, b, c = values[j, k], values[3 + j, k], values[6 + j, k]
        values[j, k] = (a + b + c) / 3.0
        values[3 + j, k] = (2.0 * a - b - c) / 3.0
        values[6 + j, k] = (b - c) * half
    for i in range(3):
        a, b, c = values[3 * i, k], values[3 * i + 1, k], values[3 * i + 2, k]
        constant, cosine, sine = (a + b + c) / 3.0, (2.0 * a - b - c) / 3.0, (b - c) * half
        if i == 0:
            # The constant moves to the left side, which is multiplied by (1 + x²)(1 + y²).
            left[k, 0] -= constant
            left[k, 2] -= constant
            left[k, 6] -= constant
            left[k, 8] -= constant
            right[k, 0], right[k, 1] = cosine, sine
        else:
            right[k, 3 * i - 1], right[k, 3 * i], right[k, 3 * i + 1] = constant, cosine, sine


@unmanaged
def _triangulate(left: Array, right: Array) -> None:
    """Make the right sides triangular by Householder reflections of both sides, so that their last six rows vanish."""
    for j in range(8):
        norm = 0.0
        for k in range(j, EQUATIONS):
            norm += right[k, j] * right[k, j]
        norm = math.sqrt(norm)
        if norm < 1e-300:
            continue
        pivot = right[j, j] + (norm if right[j, j] >= 0.0 else -norm)
        right[j, j] = pivot
        factor = 0.0
        for k in range(j, EQUATIONS):
            factor += right[k, j] * right[k, j]
        factor = 2.0 / factor
        for m in range(j + 1, 8):
            total = 0.0
            for k in range(j, EQUATIONS):
                total += right[k, j] * right[k, m]
            for k in range(j, EQUATIONS):
                right[k, m] -= factor * total * right[k, j]
        for m in range(PRODUCTS):
            total = 0.0
            for k in range(j, EQUATIONS):
                total += right[k, j] * left[k, m]
            for k in range(j, EQUATIONS):
                left[k, m] -= factor * total * right[k, j]


@inlined
def _fill(space: Scratch, q3: float) -> None:
    c, s = math.cos(q3), math.sin(q3)
    M, left = space.matrix, space.left
    for r in range(6):
        for m in range(9):
            value = left[8 + r, m] + c * left[8 + r, 9 + m] + s * left[8 + r, 18 + m]
            M[r, m], M[6 + r, 3 + m] = value, value
        for m in range(3):
            M[r, 9 + m], M[6 + r, m] = 0.0, 0.0


@unmanaged
def _determinant(space: Scratch, q3: float) -> float:
    _fill(space, q3)
    M = space.matrix
    product = 1.0
    for j in range(ORDER):
        best = j
        for k in range(j + 1, ORDER):
            if abs(M[k, j]) > abs(M[best, j]):
                best = k
        pivot = M[best, j]
        if pivot == 0.0:
            return 0.0
        if best != j:
            product = -product
            for m in range(j, ORDER):
                M[j, m], M[best, m] = M[best, m], M[j, m]
        product *= pivot
        inverse = 1.0 / pivot
        for k in range(j + 1, ORDER):
            factor = M[k, j] * inverse
            if factor != 0.0:
                for m in range(j + 1, ORDER):
                    M[k, m] -= factor * M[j, m]
    return product


@unmanaged
def third_joint(space: Scratch) -> int:
    """Put the values of joint 3 where the determinant vanishes or touches zero into `roots`; return their number."""
    series, samples = space.series, space.samples
    largest = 0.0
    for k in range(_SAMPLES):
        samples[k] = _determinant(space, 2.0 * math.pi * k / _SAMPLES)
        largest = max(largest, abs(samples[k]))
    if largest == 0.0:
        return 0
    for m in range(_DEGREE + 1):
        a, b = 0.0, 0.0
        for k in range(_SAMPLES):
            angle = 2.0 * math.pi * ((m * k) % _SAMPLES) / _SAMPLES
            a += samples[k] * math.cos(angle)
            b += samples[k] * math.sin(angle)
        share = (1.0 if m == 0 else 2.0) / (_SAMPLES * largest)
        series[0, m], series[1, m] = share * a, share * b
    return _roots_on_circle(space)


@unmanaged
def _series_at(series: Array, q: float) -> tuple[float, float, float]:
    c, s = math.cos(q), math.sin(q)
    value, slope, bend = series[0, 0], 0.0, 0.0
    cm, sm = 1.0, 0.0
    for m in range(1, _DEGREE + 1):
        cm, sm = cm * c - sm * s, sm * c + cm * s
        a, b = series[0, m], series[1, m]
        along, across = a * cm + b * sm, b * cm - a * sm
        value += along
        slope += m * across
        bend -= m * m * along
    return value, slope, bend


@unmanaged
def _roots_on_circle(space: Scratch) -> int:
    """Find one root between neighbouring extrema of opposite signs, and one at each extremum close to zero."""
    series, roots, turns = space.series, space.roots, space.turns
    count = _turning_points(space)
    found = 0
    for k in range(count):
        here, _, _ = _series_at(series, turns[k])
        following = turns[k + 1] if k + 1 < count else turns[0] + 2.0 * math.pi
        before, _, _ = _series_at(series, turns[k - 1 if k > 0 else count - 1])
        after, _, _ = _series_at(series, following)
        if found == len(roots):
            break
        if (here < 0.0) != (after < 0.0):
            roots[found] = _bisected(series, turns[k], following, here, False)
            found += 1
        elif (here < 0.0) == (before < 0.0) and abs(here) <= min(abs(before), abs(after), _TOUCHES):
            roots[found] = turns[k]
            found += 1
    return found


@unmanaged
def _turning_points(space: Scratch) -> int:
    """Write the zeros of the slope, ascending, into `turns`; return their number.

    On each arc the slope is a polynomial up to rounding. Its Bernstein coefficients change sign as often as it has
    zeros, or more often by an even number, which halving the arc reduces [Lane1981].
    """
    series, stack, turns = space.series, space.stack, space.turns
    count = 0
    for arc in range(_ARCS):
        centre = (2 * arc + 1) * _HALF_ARC
        if not _bernstein(series, centre, space.powers, stack[0]):
            continue
        lefts, widths = space.edges[0], space.edges[1]
        lefts[0], widths[0] = centre - _HALF_ARC, 2.0 * _HALF_ARC
        depth = 1
        while depth > 0:
            depth -= 1
            left, width = lefts[depth], widths[depth]
            changes = _sign_changes(stack[depth])
            if changes == 0 or count == len(turns) - 1:
                continue
            if changes == 1:
                turns[count] = _bisected(series, left, left + width, stack[depth, 0], True)
                count += 1
            elif width < _NARROW:
                turns[count] = left + 0.5 * width
                count += 1
            else:
                # The left half goes on top, so that the points come in ascending order.
                _halve(stack[depth], stack[depth + 1])
                lefts[depth], widths[depth] = left + 0.5 * width, 0.5 * width
                lefts[depth + 1], widths[depth + 1] = left, 0.5 * width
                depth += 2
    return count


@unmanaged
def _bernstein(series: Array, centre: float, powers: Array, out: Array) -> bool:
    """Compute the Bernstein coefficients of the slope on an arc into `out`.

    Return False, without them, if the constant outweighs the rest, so that the slope has no zero on the arc.
    """
    for k in range(_TERMS):
        powers[k] = 0.0
    c, s = math.cos(centre), math.sin(centre)
    cm, sm = 1.0, 0.0
    for m in range(1, _DEGREE + 1):
        cm, sm = cm * c - sm * s, sm * c + cm * s
        along, across = series[0, m] * cm + series[1, m] * sm, series[1, m] * cm - series[0, m] * sm
        factor, x = float(m), m * _HALF_ARC
        for k in range(_TERMS):
            powers[k] += factor * (across if k % 2 == 0 else along) * (-1.0 if (k + 1) // 2 % 2 else 1.0)
            factor *= x / (k + 1)
    rest = 0.0
    for k in range(1, _TERMS):
        rest += abs(powers[k])
    if abs(powers[0]) > rest:
        return False
    for k in range(_TERMS):
        total = 0.0
        for m in range(_TERMS):
            total += _TO_BERNSTEIN[k, m] * powers[m]
        out[k] = total
    return True


@inlined
def _sign_changes(coefficients: Array) -> int:
    changes, sign = 0, 0.0
    for k in range(_TERMS):
        value = coefficients[k]
        if value * sign < 0.0:
            changes += 1
        if value != 0.0:
            sign = 1.0 if value > 0.0 else -1.0
    return changes


@unmanaged
def _halve(coefficients: Array, left: Array) -> None:
    """Divide by de Casteljau: `coefficients` become those of the right half, `left` those of the left half."""
    for k in range(_TERMS):
        left[k] = coefficients[0]
        for m in range(_TERMS - 1 - k):
            coefficients[m] = 0.5 * (coefficients[m] + coefficients[m + 1])


@unmanaged
def _bisected(series: Array, lower: float, upper: float, at_lower: float, of_slope: bool) -> float:
    """Find the root of the polynomial, or of its slope, between two points by bracketed Newton iteration."""
    x = 0.5 * (lower + upper)
    for _ in range(_ROUNDS):
        value, slope, bend = _series_at(series, x)
        if of_slope:
            value, slope = slope, bend
        if (value < 0.0) == (at_lower < 0.0):
            lower = x
        else:
            upper = x
        following = x - value / slope if slope != 0.0 else lower
        if value == 0.0 or (slope != 0.0 and abs(following - x) < 1e-15):
            return x
        if not lower < following < upper:
            following = 0.5 * (lower + upper)
        x = following
    return x


@unmanaged
def next_two(space: Scratch, q3: float) -> int:
    """Put joints 4 and 5 [rad] of a root into `pairs`; return their number, 3 if two solutions seem to share joint 3.

    The null vector of the matrix consists of products of powers of their two tangents.
    """
    _fill(space, q3)
    nullity = _null_vectors(space)
    v, pairs = space.vectors, space.pairs
    _angles_of(v[2], pairs[0])
    if nullity == 1:
        return 1
    # A combination consists of powers if its entries 3 to 11 are x times its entries 0 to 8.
    a00, a01, a10, a11, b00, b01, b11 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for m in range(9):
        a00 += v[0, m] * v[0, m + 3]
        a01 += v[0, m] * v[1, m + 3]
        a10 += v[1, m] * v[0, m + 3]
        a11 += v[1, m] * v[1, m + 3]
        b00 += v[0, m] * v[0, m]
        b01 += v[0, m] * v[1, m]
        b11 += v[1, m] * v[1, m]
    a = b00 * b11 - b01 * b01
    b = -(a00 * b11 + a11 * b00 - a01 * b01 - a10 * b01)
    c = a00 * a11 - a01 * a10
    root = math.sqrt(max(b * b - 4.0 * a * c, 0.0))
    for k in range(2):
        y = -b + (root if k else -root)
        x = 2.0 * a
        # (A - y/x B) w = 0, by the larger of its two rows.
        r0, r1 = x * a00 - y * b00, x * a01 - y * b01
        t0, t1 = x * a10 - y * b01, x * a11 - y * b11
        if r0 * r0 + r1 * r1 < t0 * t0 + t1 * t1:
            r0, r1 = t0, t1
        for m in range(ORDER):
            space.combined[m] = -r1 * v[0, m] + r0 * v[1, m]
        _angles_of(space.combined, pairs[1 + k])
    return 3


@unmanaged
def _angles_of(v: Array, pair: Array) -> None:
    """Compute two angles from products of their half-angle tangents' powers, up to 3 of the first, 2 of the second."""
    top, bottom = 0.0, 0.0
    for m in range(9):
        top += v[m] * v[m + 3]
        bottom += v[m] * v[m]
    pair[0] = 2.0 * math.atan2(top, bottom)
    top, bottom = 0.0, 0.0
    for i in range(4):
        for j in range(2):
            top += v[3 * i + j] * v[3 * i + j + 1]
            bottom += v[3 * i + j] * v[3 * i + j]
    pair[1] = 2.0 * math.atan2(top, bottom)


@unmanaged
def _null_vectors(space: Scratch) -> int:
    """Compute unit null vectors of the matrix by elimination with full pivoting; return the rank deficiency, 1 or 2.

    The third of `vectors` is the regular null vector; if the matrix nearly loses another rank, the first two span its
    approximate null space.
    """
    M, order = space.matrix, space.order
    for j in range(ORDER):
        order[j] = j
    largest, nullity = 0.0, 1
    for j in range(ORDER - 1):
        best = pivoted(M, j, order)
        if j == 0:
            largest = best
        if j == ORDER - 2 and best <= _DEFICIENT * largest:
            nullity = 2
        if best == 0.0:
            break
        inverse = 1.0 / M[j, j]
        for k in range(j + 1, ORDER):
            factor = M[k, j] * inverse
            if factor != 0.0:
                for m in range(j + 1, ORDER):
                    M[k, m] -= factor * M[j, m]
    _back_substituted(space, ORDER - 1, ORDER - 1, space.vectors[2])
    if nullity == 2:
        _back_substituted(space, ORDER - 2, ORDER - 2, space.vectors[0])
        _back_substituted(space, ORDER - 2, ORDER - 1, space.vectors[1])
    return nullity


@unmanaged
def pivoted(M: Array, j: int, order: Indices) -> float:
    """Swap the largest entry of the lower right block, from j on, onto the diagonal; return its absolute value.

    M has n rows, and may have further columns on the right; `order` is the order of the others; shape (n,).
    """
    n, row_, column, best = len(M), j, j, 0.0
    for k in range(j, n):
        for m in range(j, n):
            if abs(M[k, m]) > best:
                row_, column, best = k, m, abs(M[k, m])
    for m in range(M.shape[1]):
        M[j, m], M[row_, m] = M[row_, m], M[j, m]
    for k in range(n):
        M[k, j], M[k, column] = M[k, column], M[k, j]
    order[j], order[column] = order[column], order[j]
    return best


@unmanaged
def _back_substituted(space: Scratch, rank: int, free: int, x: Array) -> None:
    """Back-substitute for a null vector with one free entry; scale it to unit length and restore the column order."""
    M, order = space.matrix, space.order
    # Store the entries, in elimination order, in the last row, which is no longer needed.
    for j in range(rank, ORDER):
        M[ORDER - 1, j] = 1.0 if j == free else 0.0
    length = 1.0
    for i in range(rank):
        j = rank - 1 - i
        total = 0.0
        for m in range(j + 1, ORDER):
            total += M[j, m] * M[ORDER - 1, m]
        M[ORDER - 1, j] = -total / M[j, j] if M[j, j] != 0.0 else 0.0
        length += M[ORDER - 1, j] * M[ORDER - 1, j]
    scale = 1.0 / math.sqrt(length)
    for j in range(ORDER):
        x[order[j]] = scale * M[ORDER - 1, j]


@unmanaged
def first_two(axes: Array, points: Array, u: Vector, m: Vector, p: Vector, d: Vector) -> tuple[float, float]:
    """Solve E_1 E_2 (u, m) = (p, d), a point and a direction each, for joints 1 and 2 by least squares; [rad]."""
    h1, h2, o1, o2 = row(axes, 0), row(axes, 1), row(points, 0), row(points, 1)
    arm, offset = minus(u, o2), minus(o2, o1)
    reach = minus(p, o1)
    along = dot(h2, arm)
    lean = dot(h1, h2)
    # Joint 1 preserves these, linear in (cos q_2, sin q_2): height of direction and point, and the point's distance.
    a0, a1 = dot(h1, m) - lean * dot(h2, m), dot(h1, cross(h2, m))
    a2 = dot(h1, d) - lean * dot(h2, m)
    b0, b1 = dot(h1, arm) - lean * along, dot(h1, cross(h2, arm))
    b2 = dot(h1, reach) - dot(h1, offset) - lean * along
    c0, c1 = dot(offset, arm) - dot(offset, h2) * along, dot(offset, cross(h2, arm))
    c2 = 0.5 * (dot(reach, reach) - dot(arm, arm) - dot(offset, offset)) - dot(offset, h2) * along
    n00, n01, n11 = a0 * a0 + b0 * b0 + c0 * c0, a0 * a1 + b0 * b1 + c0 * c1, a1 * a1 + b1 * b1 + c1 * c1
    r0, r1 = a0 * a2 + b0 * b2 + c0 * c2, a1 * a2 + b1 * b2 + c1 * c2
    q2 = math.atan2(n00 * r1 - n01 * r0, n11 * r0 - n01 * r1)
    w, v = turned(h2, q2, m), plus(offset, 1.0, turned(h2, q2, arm))
    # Joint 1 from the direction and the point together, weighted by their distances from the axis.
    x, y = cross(h1, w), cross(h1, v)
    s, t = cross(h1, d), cross(h1, reach)
    return math.atan2(dot(h1, cross(x, s)) + dot(h1, cross(y, t)), dot(x, s) + dot(y, t)), q2


def left_sides(axes: Array, points: Array) -> Array:
    """Compute the left sides of the equations, which are the same for all targets.

    Args:
        axes: Joint axes at zero; shape (6, 3).
        points: A point on each axis, relative to that of joint 3, in units of the arm's size; shape (6, 3).

    Returns:
        Coefficients of (1, cos q_3, sin q_3) times powers 0 to 2 of x and y, the tangents of half of q_4 and q_5, of
        the equations multiplied by (1 + x²)(1 + y²); shape (EQUATIONS, PRODUCTS).
    """
    angles = 2.0 * np.pi / 3.0 * np.arange(3)
    basis = np.column_stack((np.ones(3), np.cos(angles), np.sin(angles)))
    values = np.empty((EQUATIONS, 3, 3, 3))
    for i, j, k in np.ndindex(3, 3, 3):
        p, d = points[5], axes[5]
        for joint, angle in ((4, angles[k]), (3, angles[j]), (2, angles[i])):
            R = _rotation(axes[joint], angle)
            p, d = points[joint] + R @ (p - points[joint]), R @ d
        values[:, i, j, k] = np.concatenate((p, d, [p @ p, p @ d], np.cross(p, d), (p @ p) * d - 2.0 * (p @ d) * p))
    to_products = np.linalg.inv(basis)
    to_powers = np.array([[1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [0.0, 2.0, 0.0]])
    tangents = to_products.T @ to_powers
    table = np.einsum("eijk,ai,jb,kc->eabc", values, to_products, tangents, tangents)
    return np.ascontiguousarray(table.reshape(EQUATIONS, PRODUCTS))


def _rotation(h: Array, angle: Any) -> Array:
    x, y, z = h
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * K + (1.0 - np.cos(angle)) * K @ K)
