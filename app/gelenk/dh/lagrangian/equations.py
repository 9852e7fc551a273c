"""The Lagrangian of a planar arm: energies, mass matrix, Christoffel symbols, Coriolis and gravity terms.

    T_i = ½ m_i v_ciᵀ v_ci + ½ I_i ω_i²,   U_i = -m_i gᵀ p_ci,   L = Σ T_i - Σ U_i
    c_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j - ∂M_jk/∂q_i),   C_ij = Σ_k c_ijk q̇_k,   g_i = ∂U/∂q_i

Every joint turns about the normal of the arm's plane or slides within it. All angles are then about parallel axes, and
add up: so they do even if a prismatic joint between two revolute ones has its axis in the plane, as in an RPR arm.

With this C, Ṁ - 2C is skew symmetric, which is checked term by term [Spong2020, ch. 6; Siciliano2009, ch. 7].
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any, TypeAlias

from gelenk.dh.derive.algebra import (
    CONSTANT,
    GRAVITY,
    LENGTH,
    MASS,
    MAX_TERMS,
    RATE,
    ZERO,
    Atom,
    Polynomial,
    TooManyTerms,
    Vector,
    applied,
    column,
    cross,
    derivative,
    dot,
    minus,
    number,
    plus,
    reduced,
    reduced_vector,
    scaled,
    symbol,
    total,
)
from gelenk.dh.derive.table import LENGTH_TOLERANCE, Table, Transform, exact_number
from gelenk.dh.derive.transforms import frames_from
from gelenk.dh.lagrangian.bodies import Gravity, Line, LinkBody, Point, line_of
from gelenk.language import translated as _


class NotPlanar(Exception):
    """The arm does not move in a plane; the message names the joint that leaves it."""


@dataclass(frozen=True, slots=True)
class PlanarArm:
    """The arm, with its centres of mass, in the axes of frame 0.

    `senses` are 1 or -1 for joints that turn about the plane's normal or against it, 0 for those that slide; `lines`
    are those on which centres of mass that are one number are measured.
    """

    senses: tuple[int, ...]
    centers: tuple[Vector, ...]
    lines: tuple[Line, ...]


def one_group(_: int) -> int:
    """Return the one group: in a plane all angles are about parallel axes."""
    return 0


def quantity(atom: Atom, value: float | None, values: dict[Atom, float], zero: float = 0.0) -> Polynomial:
    """Return a given quantity as a symbol, with its value in `values` if it has one; one of zero vanishes."""
    if value is not None and abs(value) <= zero:
        return ZERO
    if value is not None:
        values[atom] = value
    return symbol(atom)


def planar_arm(table: Table, bodies: tuple[LinkBody, ...], values: dict[Atom, float]) -> PlanarArm:
    """Place the arm, with one body per row, in its plane.

    `values` collects the value of each given coordinate of a centre of mass. Raises NotPlanar if the arm moves in no
    plane, by the table's exact angles, and TooManyTerms if a coordinate has too many terms.
    """
    frames = [frame for frame in frames_from(table, 0, MAX_TERMS) if frame is not None]
    if len(frames) <= len(table.rows):
        raise TooManyTerms
    axes = [reduced_vector(column(frames[table.axis_frame(row.index)].rotation, 2), one_group) for row in table.rows]
    senses = _senses(table, axes)
    lines = tuple(line_of(table.as_read.rows, i, table.is_standard) for i in range(len(bodies)))
    centers = []
    for row, body, line in zip(table.rows, bodies, lines, strict=True):
        frame = frames[row.index]
        if isinstance(body.center, tuple):
            center = _point(frame, row.index, body.center, values)
        else:
            length = quantity(Atom(LENGTH, (row.index,), "lc"), body.center, values, LENGTH_TOLERANCE)
            x = column(frame.rotation, 0)
            start = minus(frame.position, scaled(row.a, x)) if line == "x" and table.is_standard else frame.position
            direction = x if line == "x" else axes[row.index if line == "next axis" else row.index - 1]
            center = plus(start, scaled(length, direction))
        centers.append(reduced_vector(center, one_group))
    return PlanarArm(senses, tuple(centers), lines)


def _point(frame: Transform, index: int, given: Point, values: dict[Atom, float]) -> Vector:
    inside = tuple(
        quantity(Atom(LENGTH, (index,), name), value, values, LENGTH_TOLERANCE)
        for name, value in zip(("xc", "yc", "zc"), given, strict=True)
    )
    return plus(frame.position, applied(frame.rotation, inside))


def _senses(table: Table, axes: list[Vector]) -> tuple[int, ...]:
    """Return in which sense each joint turns about the normal of the plane, 0 if it slides within it."""
    senses, turning = [], [axis for row, axis in zip(table.rows, axes, strict=True) if row.is_revolute]
    normal = turning[0] if turning else None
    for row, axis in zip(table.rows, axes, strict=True):
        senses.append((axis == normal) - (tuple(-x for x in axis) == normal) if row.is_revolute else 0)
        if row.is_revolute and not senses[-1]:
            what = _("the axis of joint {joint} is not parallel to those of the revolute joints before it")
            raise NotPlanar(what.format(joint=row.index))
    for row, axis in zip(table.rows, axes, strict=True):
        if normal is not None and not row.is_revolute and reduced(dot(normal, axis), one_group):
            what = _("the axis of the prismatic joint {joint} is not across those of the revolute joints")
            raise NotPlanar(what.format(joint=row.index))
    if normal is None and len(axes) == 3 and reduced(dot(axes[0], cross(axes[1], axes[2])), one_group):
        raise NotPlanar(_("its three prismatic joints slide in three independent directions"))
    return tuple(senses)


Rows: TypeAlias = list[list[Polynomial]]

MAX_ENTRY_TERMS = 200
"""Maximum number of terms of an entry: beyond that the equations are not written out."""
_HALF = number(Fraction(1, 2))


@dataclass(frozen=True, slots=True)
class Equations:
    """All quantities in symbols, in frame 0; lists by joint or link, Christoffel symbols as c[i][j][k].

    Attributes:
        gravity: The acceleration of free fall.
        centers, velocities: Those of the centres of mass.
        turns: Angular velocities about the plane's normal.
        kinetic, potential: T_i and U_i.
        christoffel: Christoffel symbols of the first kind, symmetric in j and k.
        coriolis, coriolis_vector: C and C q̇.
        skew: Ṁ - 2C.
        torques: M q̈ + C q̇ + g.
    """

    gravity: Vector
    centers: list[Vector]
    velocities: list[Vector]
    turns: list[Polynomial]
    kinetic: list[Polynomial]
    potential: list[Polynomial]
    mass_matrix: Rows
    christoffel: list[Rows]
    coriolis: Rows
    coriolis_vector: list[Polynomial]
    gravity_vector: list[Polynomial]
    skew: Rows
    torques: list[Polynomial]

    @property
    def all(self) -> list[Polynomial]:
        """All polynomials that are written out."""
        return [entry for field in fields(self) for entry in _polynomials(getattr(self, field.name))]


def _polynomials(entries: Any) -> list[Polynomial]:
    return [entries] if isinstance(entries, Polynomial) else [one for entry in entries for one in _polynomials(entry)]


def equations(arm: PlanarArm, bodies: Sequence[LinkBody], gravity: Gravity, values: dict[Atom, float]) -> Equations:
    """Derive the equations of motion, with one body per joint and gravity in the axes of frame 0.

    `values` collects the value of each symbol that has one. Raises TooManyTerms if an entry has too many terms.
    """
    joints = range(1, len(arm.senses) + 1)
    masses = [quantity(Atom(MASS, (i,), "m"), body.mass, values) for i, body in zip(joints, bodies, strict=True)]
    inertias = [quantity(Atom(MASS, (i,), "I"), body.inertia, values) for i, body in zip(joints, bodies, strict=True)]
    fall = _free_fall(gravity, values)
    slides = tuple(not sense for sense in arm.senses)
    columns = [[_along(center, j, slides) for j in joints] for center in arm.centers]
    velocities = [_combined(column, joints) for column in columns]
    turns = [total(number(arm.senses[j - 1]) * rate(j) for j in joints if j <= i) for i in joints]
    kinetic = [
        _short(_HALF * (m * dot(v, v) + inertia * turn * turn))
        for m, v, inertia, turn in zip(masses, velocities, inertias, turns, strict=True)
    ]
    potential = [_short(-m * dot(fall, center)) for m, center in zip(masses, arm.centers, strict=True)]
    M = _mass_matrix(arm, columns, masses, inertias)
    c = _christoffel(M, slides)
    C = [[_short(total(entry * rate(k) for k, entry in enumerate(row, start=1))) for row in rows] for rows in c]
    Cv = [_short(total(entry * rate(j) for j, entry in enumerate(row, start=1))) for row in C]
    g = [_short(total(derivative(energy, j, slides=slides[j - 1]) for energy in potential)) for j in joints]
    found = Equations(
        fall,
        list(arm.centers),
        velocities,
        turns,
        kinetic,
        potential,
        M,
        c,
        C,
        Cv,
        g,
        _skew(M, C, slides),
        [total((*(e * rate(j, 2) for j, e in enumerate(M[i], start=1)), Cv[i], g[i])) for i in range(len(M))],
    )
    if max(len(entry) for entry in found.all) > MAX_ENTRY_TERMS:
        raise TooManyTerms
    return found


def rate(index: int, order: int = 1) -> Polynomial:
    """Return q̇ or q̈ of a joint."""
    return symbol(Atom(RATE, (index,), "q" + "d" * order))


def _free_fall(gravity: Gravity, values: dict[Atom, float]) -> Vector:
    """Return g_0 times a unit vector; components that are no exact numbers are symbols."""
    if gravity.size == 0.0:
        return ZERO, ZERO, ZERO
    size, parts = quantity(Atom(GRAVITY, (0,), "g"), gravity.size, values), []
    for index, (letter, component) in enumerate(zip("xyz", gravity.direction, strict=True), start=1):
        exact = exact_number(component)
        if exact is None:
            exact = quantity(Atom(CONSTANT, (index,), f"gamma{letter}"), component, values)
        parts.append(exact * size)
    return tuple(parts)


def _short(polynomial: Polynomial) -> Polynomial:
    return reduced(polynomial, one_group)


def _along(vector: Vector, index: int, slides: Sequence[bool]) -> Vector:
    """Return ∂/∂q of a vector for one joint."""
    return tuple(derivative(entry, index, slides=slides[index - 1]) for entry in vector)


def _combined(columns: Sequence[Vector], joints: Sequence[int]) -> Vector:
    """Return Σ_j ∂p/∂q_j q̇_j."""
    entries = zip(*columns, strict=True)
    return tuple(_short(total(x * rate(j) for x, j in zip(entry, joints, strict=True))) for entry in entries)


def _mass_matrix(
    arm: PlanarArm, columns: Sequence[Sequence[Vector]], masses: Sequence[Polynomial], inertias: Sequence[Polynomial]
) -> Rows:
    """Return M_jk = Σ_i m_i (∂p_ci/∂q_j · ∂p_ci/∂q_k) + Σ_(i ≥ j, k) ± I_i."""
    size = len(masses)
    grid: Rows = [[ZERO] * size for _ in range(size)]
    for j in range(size):
        for k in range(j, size):
            moved = [m * dot(column[j], column[k]) for m, column in zip(masses, columns, strict=True)]
            turned = [number(arm.senses[j] * arm.senses[k]) * inertia for inertia in inertias[k:]]
            grid[j][k] = grid[k][j] = _short(total((*moved, *turned)))
    return grid


def _christoffel(M: Rows, slides: Sequence[bool]) -> list[Rows]:
    size = range(len(M))
    slopes = [[[derivative(M[i][j], k + 1, slides=slides[k]) for k in size] for j in size] for i in size]
    return [
        [[_short(_HALF * (slopes[i][j][k] + slopes[i][k][j] - slopes[j][k][i])) for k in size] for j in size]
        for i in size
    ]


def _skew(M: Rows, C: Rows, slides: Sequence[bool]) -> Rows:
    """Return Ṁ - 2C, which is checked to be skew symmetric."""
    size = range(len(M))
    rates = [
        [total(derivative(M[i][j], k + 1, slides=slides[k]) * rate(k + 1) for k in size) for j in size] for i in size
    ]
    N = [[_short(rates[i][j] - number(2) * C[i][j]) for j in size] for i in size]
    if any(_short(N[i][j] + N[j][i]) for i in size for j in size):
        raise ArithmeticError("Ṁ - 2C is not skew symmetric")
    return N
