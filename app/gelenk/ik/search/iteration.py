"""One iteration of damped least squares, eight configurations at a time: error, Jacobian, step.

The step is Δq = Jᵀ(JJᵀ + λI)⁻¹e, without variables at a bound that it would push outwards. Orientation errors are
2 sin(θ/2) times the axis, which has no false zero at 180°.
"""

import math
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.kinematics.simd.kernels import Frame, joint_columns, variable_columns
from gelenk.kinematics.simd.lanes import (
    LANES,
    Lanes,
    abs_lanes,
    bits,
    lanes,
    load,
    max_lanes,
    min_lanes,
    sqrt_lanes,
    store,
    where,
)
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, inlined

Error: TypeAlias = tuple[Lanes, Lanes, Lanes, Lanes, Lanes, Lanes]
"""Pose error in registers, linear before angular."""

_Symmetric: TypeAlias = tuple[
    Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes, Lanes,
    Lanes, Lanes, Lanes, Lanes, Lanes,
]  # fmt: skip
"""Symmetric 6 × 6 matrix in registers, lower triangle row by row."""

FULL, AXIS, SOME = 0, 1, 2
"""Requested part of a pose: all of it; position and the direction of one axis; another choice."""

ERROR, BEST, SINCE, COUNT, REACHED, FIRST, STATE_ROWS = 12, 13, 14, 15, 16, 17, 18
"""Row indices of `Work.state`, whose first twelve rows hold the target."""

ROUNDING = 1e-10
"""Distance beyond a limit that still counts as at it, [rad or m]."""

KEPT = 64
"""Number of failed starts remembered, a multiple of the lanes."""


class Goal(NamedTuple):
    """The task, tolerances and bounds of a search.

    Attributes:
        bounds: Rows 0 and 1, bounds of each variable, infinite if it turns freely; 2 and 3, the interval from which
            starts are drawn; 4 and 5, limits of freely turning variables, else NaN; shape (6, n), [rad or m].
        weights: 1 for each direction that counts, else 0: x y z in the base's axes, rx ry rz about the target's;
            shape (6,).
        kind, axis: `FULL`, `AXIS` or `SOME`; for `AXIS`, index of the tip's axis to align with the target's.
        position_tolerance, chord_tolerance: Largest position error [m], and largest 2 sin(θ/2), θ being the angle of
            the orientation error, or of its parts that count.
        slack: Share of the tolerances subtracted from the errors: 0, the best, drives errors to zero; 0.9 makes use
            of loose tolerances.
    """

    bounds: Array
    weights: Array
    kind: int
    axis: int
    position_tolerance: float
    chord_tolerance: float
    slack: float
    starts: int
    random_seed: int


class Work(NamedTuple):
    """Memory of a search, in rows of lanes: the state of each lane, and space for one iteration.

    Attributes:
        state: Target, errors and counts of each lane.
        q, previous: Configuration of each lane, now and when it was last judged.
        columns, J: Jacobian with one column per joint, and per variable.
        candidates: The nearest configurations that failed starts reached, one after another.
        errors: Squared errors of the candidates, infinite in empty places; shape (KEPT,).
        starts, owners: Number of each lane's current start, and index of its target; shape (LANES,) each.
        coupled: Whether the columns by variable differ from those by joint.
    """

    state: Array
    q: Array
    previous: Array
    columns: Array
    J: Array
    candidates: Array
    errors: Array
    starts: Indices
    owners: Indices
    coupled: bool


@compiled
def workspace(flat: FlatChain, n: int) -> Work:
    """Allocate the memory of a search for a chain of n variables."""
    joints = len(flat.joints)
    coupled = joints != n
    for i in range(joints):
        coupled |= flat.joints[i, 1] != i or flat.drives[i, 0] != 1.0
    rows = np.zeros((STATE_ROWS + 8 * n + 6 * joints) * LANES + KEPT * (n + 1))
    integers = np.zeros(2 * LANES, np.int64)
    state, q = STATE_ROWS * LANES, n * LANES
    columns = state + 2 * q + KEPT * n
    J = columns + 6 * joints * LANES
    errors = J + 6 * q
    return Work(
        rows[:state],
        rows[state : state + q],
        rows[state + q : state + 2 * q],
        rows[columns:J],
        rows[J:errors],
        rows[state + 2 * q : columns],
        rows[errors:],
        integers[:LANES],
        integers[LANES:],
        coupled,
    )


@inlined
def linearise(flat: FlatChain, goal: Goal, work: Work, as_angles: bool = False) -> Error:
    """Return the error of every lane and put its Jacobian into `J`; components that do not count are zero in both.

    `as_angles` scales rotation errors from length 2 sin(θ/2) to length θ, at extra cost.
    """
    columns = work.J
    if work.coupled:
        columns = work.columns
    frame = joint_columns(flat, work.q, columns)
    if work.coupled:
        variable_columns(flat, columns, work.J)
    state = work.state
    e0, e1, e2 = load(state, 9) - frame[9], load(state, 10) - frame[10], load(state, 11) - frame[11]
    if goal.kind == FULL:
        w = _turn(state, frame)
        if as_angles:
            w = _with_angles(work, w)
        return e0, e1, e2, w[0], w[1], w[2]
    w = _swing(state, frame, goal.axis) if goal.kind == AXIS else _turn(state, frame)
    if as_angles:
        w = _with_angles(work, w)
    weights = goal.weights
    for j in range(len(work.J) // (6 * LANES)):
        u = _in_target(state, load(work.J, 6 * j + 3), load(work.J, 6 * j + 4), load(work.J, 6 * j + 5))
        for k in range(3):
            store(work.J, 6 * j + k, weights[k] * load(work.J, 6 * j + k))
            store(work.J, 6 * j + 3 + k, weights[3 + k] * u[k])
    w = _in_target(state, w[0], w[1], w[2])
    return weights[0] * e0, weights[1] * e1, weights[2] * e2, weights[3] * w[0], weights[4] * w[1], weights[5] * w[2]


@inlined
def _with_angles(work: Work, w: tuple[Lanes, Lanes, Lanes]) -> tuple[Lanes, Lanes, Lanes]:
    """Scale vectors of length 2 sin(θ/2) to length θ."""
    store(work.state, ERROR, 0.25 * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]))
    for k in range(ERROR * LANES, (ERROR + 1) * LANES):
        sine = math.sqrt(min(work.state[k], 1.0))
        work.state[k] = math.asin(sine) / sine if sine > 0.0 else 1.0
    scale = load(work.state, ERROR)
    return scale * w[0], scale * w[1], scale * w[2]


@inlined
def _in_target(state: Array, w0: Lanes, w1: Lanes, w2: Lanes) -> tuple[Lanes, Lanes, Lanes]:
    return (
        load(state, 0) * w0 + load(state, 3) * w1 + load(state, 6) * w2,
        load(state, 1) * w0 + load(state, 4) * w1 + load(state, 7) * w2,
        load(state, 2) * w0 + load(state, 5) * w1 + load(state, 8) * w2,
    )


@inlined
def _turn(state: Array, frame: Frame) -> tuple[Lanes, Lanes, Lanes]:
    """2 sin(θ/2) times the axis of the rotation from the tip to the target, in the base.

    The skew part of R = R_target R_tipᵀ is sin θ times the axis. It vanishes near 180°, where a column of the
    symmetric part, I cos θ + (1 - cos θ) a aᵀ, gives the axis instead.
    """
    t = (
        load(state, 0), load(state, 1), load(state, 2), load(state, 3), load(state, 4), load(state, 5),
        load(state, 6), load(state, 7), load(state, 8),
    )  # fmt: skip
    m00 = t[0] * frame[0] + t[1] * frame[1] + t[2] * frame[2]
    m01 = t[0] * frame[3] + t[1] * frame[4] + t[2] * frame[5]
    m02 = t[0] * frame[6] + t[1] * frame[7] + t[2] * frame[8]
    m10 = t[3] * frame[0] + t[4] * frame[1] + t[5] * frame[2]
    m11 = t[3] * frame[3] + t[4] * frame[4] + t[5] * frame[5]
    m12 = t[3] * frame[6] + t[4] * frame[7] + t[5] * frame[8]
    m20 = t[6] * frame[0] + t[7] * frame[1] + t[8] * frame[2]
    m21 = t[6] * frame[3] + t[7] * frame[4] + t[8] * frame[5]
    m22 = t[6] * frame[6] + t[7] * frame[7] + t[8] * frame[8]
    cosine_squared = 0.25 * (1.0 + m00 + m11 + m22)
    scale = 0.5 / sqrt_lanes(max_lanes(cosine_squared, 1e-6))
    w0, w1, w2 = scale * (m21 - m12), scale * (m02 - m20), scale * (m10 - m01)
    reversed_ = cosine_squared < 1e-4
    if bits(reversed_):
        c = 2.0 * cosine_squared - 1.0
        first, second = (m00 >= m11) & (m00 >= m22), m11 >= m22
        s01, s02, s12 = 0.5 * (m01 + m10), 0.5 * (m02 + m20), 0.5 * (m12 + m21)
        a0 = where(first, m00 - c, where(second, s01, s02))
        a1 = where(first, s01, where(second, m11 - c, s12))
        a2 = where(first, s02, where(second, s12, m22 - c))
        length = 2.0 * sqrt_lanes(1.0 - cosine_squared) / sqrt_lanes(a0 * a0 + a1 * a1 + a2 * a2)
        length = where(a0 * w0 + a1 * w1 + a2 * w2 < 0.0, -length, length)
        w0 = where(reversed_, length * a0, w0)
        w1 = where(reversed_, length * a1, w1)
        w2 = where(reversed_, length * a2, w2)
    return w0, w1, w2


@inlined
def _swing(state: Array, frame: Frame, axis: int) -> tuple[Lanes, Lanes, Lanes]:
    """2 sin(θ/2) times the axis of the shortest rotation from an axis of the tip to the target's, in the base."""
    t0, t1, t2 = load(state, axis), load(state, axis + 3), load(state, axis + 6)
    a0, a1, a2 = frame[axis], frame[axis + 3], frame[axis + 6]
    cosine_squared = 0.5 * (1.0 + a0 * t0 + a1 * t1 + a2 * t2)
    scale = 1.0 / sqrt_lanes(max_lanes(cosine_squared, 1e-6))
    w0, w1, w2 = scale * (a1 * t2 - a2 * t1), scale * (a2 * t0 - a0 * t2), scale * (a0 * t1 - a1 * t0)
    reversed_ = cosine_squared < 1e-4
    if bits(reversed_):
        # Any perpendicular axis will do: take the tip's next one.
        other = (axis + 1) % 3
        w0 = where(reversed_, 2.0 * frame[other], w0)
        w1 = where(reversed_, 2.0 * frame[other + 3], w1)
        w2 = where(reversed_, 2.0 * frame[other + 6], w2)
    return w0, w1, w2


@inlined
def descend(goal: Goal, work: Work, e: Error, damping: Lanes, keep: Lanes, most: float) -> None:
    """Save q in `previous` and step q by Jᵀ(JJᵀ + λI)⁻¹e within the bounds; where `keep` is 0, restore `previous`.

    No joint moves further than `most` [rad or m].
    """
    J, n = work.J, len(work.J) // (6 * LANES)
    x0, x1, x2, x3, x4, x5 = _solve(_normal_matrix(goal, work, e, damping), e)
    longest = lanes(most)
    for j in range(n):
        c0, c1, c2 = load(J, 6 * j), load(J, 6 * j + 1), load(J, 6 * j + 2)
        c3, c4, c5 = load(J, 6 * j + 3), load(J, 6 * j + 4), load(J, 6 * j + 5)
        step = c0 * x0 + c1 * x1 + c2 * x2 + c3 * x3 + c4 * x4 + c5 * x5
        longest = max_lanes(longest, abs_lanes(step))
        store(J, 6 * j, step)
    scale = most / longest
    kept = keep > 0.5
    for j in range(n):
        q, before = load(work.q, j), load(work.previous, j)
        after = min_lanes(max_lanes(q + scale * load(J, 6 * j), goal.bounds[0, j]), goal.bounds[1, j])
        store(work.q, j, where(kept, after, before))
        store(work.previous, j, where(kept, q, before))


@inlined
def _normal_matrix(goal: Goal, work: Work, e: Error, damping: Lanes) -> _Symmetric:
    """Return JJᵀ + λI, lower triangle row by row, after setting the columns of blocked variables in `J` to zero."""
    J, bounds = work.J, goal.bounds
    n = len(J) // (6 * LANES)
    e0, e1, e2, e3, e4, e5 = e
    a00, a11, a22, a33, a44, a55 = damping, damping, damping, damping, damping, damping
    o = lanes(0.0)
    a10, a20, a21, a30, a31, a32, a40, a41, a42, a43 = o, o, o, o, o, o, o, o, o, o
    a50, a51, a52, a53, a54 = o, o, o, o, o
    for j in range(n):
        c0, c1, c2 = load(J, 6 * j), load(J, 6 * j + 1), load(J, 6 * j + 2)
        c3, c4, c5 = load(J, 6 * j + 3), load(J, 6 * j + 4), load(J, 6 * j + 5)
        if bounds[0, j] > -np.inf or bounds[1, j] < np.inf:
            slope = c0 * e0 + c1 * e1 + c2 * e2 + c3 * e3 + c4 * e4 + c5 * e5
            q = load(work.q, j)
            free = where(((q <= bounds[0, j]) & (slope < 0.0)) | ((q >= bounds[1, j]) & (slope > 0.0)), 0.0, 1.0)
            c0, c1, c2, c3, c4, c5 = free * c0, free * c1, free * c2, free * c3, free * c4, free * c5
            store(J, 6 * j, c0)
            store(J, 6 * j + 1, c1)
            store(J, 6 * j + 2, c2)
            store(J, 6 * j + 3, c3)
            store(J, 6 * j + 4, c4)
            store(J, 6 * j + 5, c5)
        a00, a10, a11 = a00 + c0 * c0, a10 + c1 * c0, a11 + c1 * c1
        a20, a21, a22 = a20 + c2 * c0, a21 + c2 * c1, a22 + c2 * c2
        a30, a31, a32, a33 = a30 + c3 * c0, a31 + c3 * c1, a32 + c3 * c2, a33 + c3 * c3
        a40, a41, a42, a43, a44 = a40 + c4 * c0, a41 + c4 * c1, a42 + c4 * c2, a43 + c4 * c3, a44 + c4 * c4
        a50, a51, a52 = a50 + c5 * c0, a51 + c5 * c1, a52 + c5 * c2
        a53, a54, a55 = a53 + c5 * c3, a54 + c5 * c4, a55 + c5 * c5
    return (
        a00, a10, a11, a20, a21, a22, a30, a31, a32, a33, a40, a41, a42, a43, a44, a50, a51, a52, a53, a54, a55,
    )  # fmt: skip


@inlined
def _solve(a: _Symmetric, e: Error) -> Error:
    """Solve A x = e by A = L D Lᵀ; i_k is 1/d_k, and m_jk is l_jk d_k."""
    a00, a10, a11, a20, a21, a22, a30, a31, a32, a33, a40, a41, a42, a43, a44, a50, a51, a52, a53, a54, a55 = a
    e0, e1, e2, e3, e4, e5 = e
    i0 = 1.0 / a00
    l10, l20, l30, l40, l50 = a10 * i0, a20 * i0, a30 * i0, a40 * i0, a50 * i0
    i1 = 1.0 / (a11 - l10 * a10)
    m21, m31, m41, m51 = a21 - l20 * a10, a31 - l30 * a10, a41 - l40 * a10, a51 - l50 * a10
    l21, l31, l41, l51 = m21 * i1, m31 * i1, m41 * i1, m51 * i1
    i2 = 1.0 / (a22 - l20 * a20 - l21 * m21)
    m32, m42, m52 = a32 - l30 * a20 - l31 * m21, a42 - l40 * a20 - l41 * m21, a52 - l50 * a20 - l51 * m21
    l32, l42, l52 = m32 * i2, m42 * i2, m52 * i2
    i3 = 1.0 / (a33 - l30 * a30 - l31 * m31 - l32 * m32)
    m43, m53 = a43 - l40 * a30 - l41 * m31 - l42 * m32, a53 - l50 * a30 - l51 * m31 - l52 * m32
    l43, l53 = m43 * i3, m53 * i3
    i4 = 1.0 / (a44 - l40 * a40 - l41 * m41 - l42 * m42 - l43 * m43)
    m54 = a54 - l50 * a40 - l51 * m41 - l52 * m42 - l53 * m43
    l54 = m54 * i4
    i5 = 1.0 / (a55 - l50 * a50 - l51 * m51 - l52 * m52 - l53 * m53 - l54 * m54)
    y1 = e1 - l10 * e0
    y2 = e2 - l20 * e0 - l21 * y1
    y3 = e3 - l30 * e0 - l31 * y1 - l32 * y2
    y4 = e4 - l40 * e0 - l41 * y1 - l42 * y2 - l43 * y3
    y5 = e5 - l50 * e0 - l51 * y1 - l52 * y2 - l53 * y3 - l54 * y4
    x5 = y5 * i5
    x4 = y4 * i4 - l54 * x5
    x3 = y3 * i3 - l43 * x4 - l53 * x5
    x2 = y2 * i2 - l32 * x3 - l42 * x4 - l52 * x5
    x1 = y1 * i1 - l21 * x2 - l31 * x3 - l41 * x4 - l51 * x5
    x0 = e0 * i0 - l10 * x1 - l20 * x2 - l30 * x3 - l40 * x4 - l50 * x5
    return x0, x1, x2, x3, x4, x5


@inlined
def wound(q: float, seed: float, lower: float, upper: float) -> float:
    """Turn an angle by full turns into its limits, as near to the seed as possible; only nearly if none fits."""
    turn = 2.0 * np.pi
    q += turn * np.rint((seed - q) / turn)
    # Rounding may carry a joint over its limit, which is no reason for a full turn.
    if q > upper + ROUNDING:
        q -= turn * np.ceil((q - upper - ROUNDING) / turn)
    elif q < lower - ROUNDING:
        q += turn * np.ceil((lower - q - ROUNDING) / turn)
    return q


@inlined
def squares(e: Error) -> tuple[Lanes, Lanes]:
    """Squared lengths of the position and the orientation error."""
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2], e[3] * e[3] + e[4] * e[4] + e[5] * e[5]


@inlined
def within(goal: Goal, position: Lanes, orientation: Lanes) -> Lanes:
    """Flag the lanes whose squared errors are within the tolerances."""
    return (position <= goal.position_tolerance**2) & (orientation <= goal.chord_tolerance**2)


@inlined
def set_target(work: Work, lane: int, target: Array) -> None:
    """Set the target of a lane: rotation row by row, then position; shape (12,)."""
    for k in range(12):
        work.state[k * LANES + lane] = target[k]


@inlined
def read_lane(rows: Array, lane: int, q: Array) -> None:
    """Copy the configuration of a lane into q; shape (n,)."""
    for j in range(len(q)):
        q[j] = rows[j * LANES + lane]
