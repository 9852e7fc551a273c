"""The Lagrangian of a planar arm: energies, mass matrix, Christoffel symbols, Coriolis and gravity terms.

    T_i = ½ m_i v_ciᵀ v_ci + ½ I_i ω_i²,   U_i = -m_i gᵀ p_ci,   L = Σ T_i - Σ U_i
    c_ijk = ½ (∂M_ij/∂q_k + ∂M_ik/∂q_j - ∂M_jk/∂q_i),   C_ij = Σ_k c_ijk q̇_k,   g_i = ∂U/∂q_i

With this C, Ṁ - 2C is skew symmetric, which is checked term by term [Spong2020, ch. 6; Siciliano2009, ch. 7].
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields
from fractions import Fraction
from typing import Any, TypeAlias

from gelenk.dh.derive.algebra import (
    CONSTANT,
    GRAVITY,
    MASS,
    RATE,
    ZERO,
    Atom,
    Polynomial,
    TooManyTerms,
    Vector,
    derivative,
    dot,
    number,
    reduced,
    symbol,
    total,
)
from gelenk.dh.derive.table import exact_number
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody
from gelenk.dh.lagrangian.plane import PlanarArm, one_group, quantity

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
