"""The configurations at which a factor of a determinant vanishes.

A factor in one sine and cosine, A c + B s + C, is solved for its angle; one that is linear in a prismatic variable for
that; any other stays an equation. Each gets a configuration that fulfils it, all other joints drawn at random.
"""

import math
import re
from random import Random
from typing import NamedTuple

from gelenk.dh.derive.algebra import ONE, TRIGONOMETRIC, VARIABLE, ZERO, Angle, Atom, Polynomial
from gelenk.dh.derive.table import Table
from gelenk.dh.derive.texts import SingularCondition, SingularValue
from gelenk.dh.derive.typeset import Formula, Notation, decimal, summed

_DRAWS = 200
_STEPS = 64
_HALVINGS = 60
_REACH = 2.0
"""Range of a prismatic variable in which a zero is searched for, [m]."""


_NOTHING, _PI, _RIGHT = Formula("0", "0"), Formula(r"\pi", "pi"), Formula(r"\frac{\pi}{2}", "pi/2")


class _Solution(NamedTuple):
    """A value, [rad or m], of a sum of joint variables, by their signed indices, and its formula."""

    variables: Angle
    formula: Formula
    value: float


class _Wave(NamedTuple):
    """The form A cos ϑ + B sin ϑ + C of one angle."""

    angle: Angle
    cosine: Polynomial
    sine: Polynomial
    constant: Polynomial


def singular_condition(factor: Polynomial, table: Table, notation: Notation) -> SingularCondition | None:
    """Return when a factor vanishes; None if it depends on no joint."""
    moving = {atom for atom in factor.atoms if _moves(atom, table)}
    if not moving:
        return None
    solutions: list[_Solution] | None = None
    if (wave := _as_wave(factor, moving)) is not None:
        solutions = _of_wave(wave, table, notation)
    elif (line := _as_line(factor, moving)) is not None:
        solutions = _of_line(*line, table, notation)
    text = notation.text(factor)
    condition = Formula(f"{text.latex} = 0", f"{text.plain} = 0")
    if solutions is None:
        return SingularCondition("equation", condition, [], _found(factor, table), None)
    if not solutions:
        return SingularCondition("never", condition, [], None, None)
    values = [
        SingularValue(
            [table.as_read.rows[abs(i) - 1].name for i in one.variables],
            [1 if i > 0 else -1 for i in one.variables],
            notation.variables(one.variables),
            one.formula,
            one.value,
        )
        for one in solutions
    ]
    return SingularCondition("solved", condition, values, _placed(solutions[0], table), None)


def _moves(atom: Atom, table: Table) -> bool:
    """Check whether an atom depends on a joint; the angle of a prismatic row is constant."""
    return atom.kind == VARIABLE or (
        atom.kind == TRIGONOMETRIC and any(table.rows[abs(i) - 1].is_revolute for i in atom.indices)
    )


def _as_wave(factor: Polynomial, moving: set[Atom]) -> _Wave | None:
    angles = {atom.indices for atom in moving}
    if len(angles) != 1 or any(atom.kind == VARIABLE for atom in moving):
        return None
    angle = angles.pop()
    if len(set(angle)) < len(angle):
        return None
    sums = {"c": ZERO, "s": ZERO, "": ZERO}
    for monomial, value in factor:
        waves = [(atom, power) for atom, power in monomial if atom in moving]
        if len(waves) > 1 or any(power > 1 for _, power in waves):
            return None
        name = waves[0][0].name if waves else ""
        rest = tuple(item for item in monomial if item not in waves)
        sums[name] = sums[name] + Polynomial({rest: value})
    return _Wave(angle, sums["c"], sums["s"], sums[""])


def _of_wave(wave: _Wave, table: Table, notation: Notation) -> list[_Solution] | None:
    """Return the solutions; None if the wave vanishes everywhere with these lengths."""
    atoms = wave.cosine.atoms | wave.sine.atoms | wave.constant.atoms
    values = table.atom_values(tuple(0.0 for _ in table.rows), atoms)
    a, b, c = wave.cosine.value(values), wave.sine.value(values), wave.constant.value(values)
    if abs(c) > math.hypot(a, b):
        return []
    if not a and not b:
        return None
    turning = tuple(i for i in wave.angle if table.rows[abs(i) - 1].is_revolute)
    offset = sum(table.rows[abs(i) - 1].offset * (1 if i > 0 else -1) for i in wave.angle)
    solutions = []
    for text, angle in _zeros(wave, notation, a, b, c):
        formula = summed((text, decimal(-offset))) if offset else text
        solutions.append(_Solution(turning, formula, _principal(angle - offset)))
    return solutions


def _zeros(wave: _Wave, notation: Notation, a: float, b: float, c: float) -> list[tuple[Formula, float]]:
    """Solve R cos(ϑ - φ) = -C with R² = A² + B² and φ = atan2(B, A) for ϑ, in symbols and numbers."""
    if not wave.constant and not wave.cosine:
        return [(_NOTHING, 0.0), (_PI, math.pi)]
    if not wave.constant and not wave.sine:
        return [(_RIGHT, math.pi / 2), (Formula(f"-{_RIGHT.latex}", f"-{_RIGHT.plain}"), -math.pi / 2)]
    if not wave.constant:
        first, value = _atan2(-wave.cosine, wave.sine, notation), math.atan2(-a, b)
        return [(first, value), (summed((first, _PI)), value + math.pi)]
    if not wave.sine:
        size, radius, phase, middle = notation.text(wave.cosine), a, _NOTHING, 0.0
    elif not wave.cosine:
        size, radius, phase, middle = notation.text(wave.sine), b, _RIGHT, math.pi / 2
    else:
        left, right = notation.bracketed(wave.cosine), notation.bracketed(wave.sine)
        size = Formula(rf"\sqrt{{{left.latex}^2 + {right.latex}^2}}", f"sqrt({left.plain}**2 + {right.plain}**2)")
        radius, phase, middle = math.hypot(a, b), _atan2(wave.sine, wave.cosine, notation), math.atan2(b, a)
    ratio, half = _quotient(notation.text(-wave.constant), size), math.acos(-c / radius)
    turn = Formula(rf"\arccos\left({ratio.latex}\right)", f"acos({ratio.plain})")
    back = Formula(f"-{turn.latex}", f"-{turn.plain}")
    if phase is not _NOTHING:
        back = Formula(f"{phase.latex} - {turn.latex}", f"{phase.plain} -{turn.plain}")
    return [(summed((phase, turn)), middle + half), (back, middle - half)]


def _atan2(y: Polynomial, x: Polynomial, notation: Notation) -> Formula:
    top, bottom = notation.text(y), notation.text(x)
    return Formula(
        rf"\operatorname{{atan2}}\left({top.latex}, {bottom.latex}\right)", f"atan2({top.plain}, {bottom.plain})"
    )


def _quotient(top: Formula, bottom: Formula) -> Formula:
    """Write a fraction; a single symbol needs no brackets."""
    above, below = (text.plain if re.fullmatch(r"-?\w+", text.plain) else f"({text.plain})" for text in (top, bottom))
    sign = "-" if re.fullmatch(r"-\w+", top.plain) else ""
    return Formula(rf"{sign}\frac{{{top.latex.removeprefix(sign)}}}{{{bottom.latex}}}", f"{above}/{below}")


def _as_line(factor: Polynomial, moving: set[Atom]) -> tuple[Atom, Polynomial, Polynomial] | None:
    """Return q, k and C if the factor is k · q + C with one prismatic variable q, else None."""
    if len(moving) != 1:
        return None
    (variable,) = moving
    if variable.kind != VARIABLE:
        return None
    slope, constant = ZERO, ZERO
    for monomial, value in factor:
        power = dict(monomial).get(variable, 0)
        if power > 1:
            return None
        rest = Polynomial({tuple(item for item in monomial if item[0] != variable): value})
        slope, constant = (slope + rest, constant) if power else (slope, constant + rest)
    return variable, slope, constant


def _of_line(
    variable: Atom, slope: Polynomial, constant: Polynomial, table: Table, notation: Notation
) -> list[_Solution] | None:
    """Return the solution; none if the slope is zero with these lengths, None if the constant is zero too."""
    values = table.atom_values(tuple(0.0 for _ in table.rows), slope.atoms | constant.atoms)
    k, c = slope.value(values), constant.value(values)
    if not k:
        return [] if c else None
    text = notation.text(-constant)
    if slope != ONE:
        text = _quotient(text, notation.text(slope))
    return [_Solution(variable.indices, text, -c / k + 0.0)]


def _placed(solution: _Solution, table: Table) -> list[float]:
    """Return a configuration with this value, the other joints drawn at random."""
    q = list(_drawn(table, Random(0)))  # noqa: S311
    *others, last = solution.variables
    rest = solution.value - sum(q[abs(i) - 1] * (1 if i > 0 else -1) for i in others)
    value = rest if last > 0 else -rest
    q[abs(last) - 1] = _principal(value) if table.rows[abs(last) - 1].is_revolute else value
    return q


def _drawn(table: Table, random: Random) -> tuple[float, ...]:
    """Draw a configuration away from the usual singular ones."""
    return tuple(random.uniform(0.3, 1.3) * random.choice((-1, 1)) for _ in table.rows)


def _found(factor: Polynomial, table: Table) -> list[float] | None:
    """Return a configuration at which the factor changes its sign, searched for along one joint after the other."""
    indices = sorted({abs(i) for atom in factor.atoms if _moves(atom, table) for i in atom.indices})
    random = Random(0)  # noqa: S311
    for _ in range(_DRAWS // max(1, len(indices))):
        q = _drawn(table, random)
        for index in reversed(indices):
            value = _zero_along(factor, table, q, index)
            if value is not None:
                return [*q[: index - 1], value, *q[index:]]
    return None


def _zero_along(factor: Polynomial, table: Table, q: tuple[float, ...], index: int) -> float | None:
    atoms = factor.atoms
    reach = math.pi if table.rows[index - 1].is_revolute else _REACH

    def value(x: float) -> float:
        return factor.value(table.atom_values((*q[: index - 1], x, *q[index:]), atoms))

    grid = [-reach + 2 * reach * k / _STEPS for k in range(_STEPS + 1)]
    heights = [value(x) for x in grid]
    for low, high, height, next_height in zip(grid, grid[1:], heights, heights[1:], strict=False):
        if height * next_height < 0:
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                low, high = (middle, high) if value(middle) * height > 0 else (low, middle)  # noqa: PLW2901
            return (low + high) / 2
    return None


def _principal(angle: float) -> float:
    """Return the same angle in (-π, π]."""
    turned = math.remainder(angle, 2 * math.pi)
    return math.pi if turned <= -math.pi + 1e-12 else turned + 0.0
