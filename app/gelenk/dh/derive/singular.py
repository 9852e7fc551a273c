"""The configurations at which a factor of a determinant vanishes.

A factor in one sine and cosine, A c + B s + C, is solved for its angle; one that is linear in a prismatic variable for
that; any other stays an equation. Each gets a configuration that fulfils it, all other joints drawn at random.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from random import Random
from typing import Literal, TypeAlias

from gelenk.dh.derive.algebra import TRIGONOMETRIC, VARIABLE, ZERO, Angle, Atom, Polynomial, number
from gelenk.dh.derive.table import Table
from gelenk.dh.derive.typeset import Notation, Text, decimal, joined

Kind: TypeAlias = Literal["solved", "equation", "never"]

_DRAWS = 200
_STEPS = 64
_HALVINGS = 60
_REACH = 2.0
"""Range of a prismatic variable in which a zero is searched for, [m]."""


@dataclass(frozen=True, slots=True)
class Solution:
    """A value of a sum of joint variables at which the factor vanishes.

    Attributes:
        variables: Signed indices of the joints; mostly one.
        formula: The value in symbols.
        value: The value, [rad or m].
    """

    variables: Angle
    formula: Text
    value: float


@dataclass(frozen=True, slots=True)
class Condition:
    """A factor that vanishes.

    Attributes:
        kind: Solved for a variable, left as an equation, or never fulfilled with these lengths.
        factor: The factor.
        solutions: Solutions, if it is solved.
        example: A configuration that fulfils it, [rad or m]; None if none was found.
    """

    kind: Kind
    factor: Polynomial
    solutions: tuple[Solution, ...]
    example: tuple[float, ...] | None


@dataclass(frozen=True, slots=True)
class _Wave:
    """The form A cos ϑ + B sin ϑ + C of one angle."""

    angle: Angle
    cosine: Polynomial
    sine: Polynomial
    constant: Polynomial


def condition(factor: Polynomial, table: Table, notation: Notation) -> Condition | None:
    """Return when a factor vanishes; None if it depends on no joint."""
    moving = {atom for atom in factor.atoms if _moves(atom, table)}
    if not moving:
        return None
    solutions: tuple[Solution, ...] | None = None
    if (wave := _as_wave(factor, moving)) is not None:
        solutions = _of_wave(wave, table, notation)
    elif (line := _as_line(factor, moving)) is not None:
        solutions = _of_line(*line, table, notation)
    if solutions is None:
        return Condition("equation", factor, (), _found(factor, table))
    if not solutions:
        return Condition("never", factor, (), None)
    return Condition("solved", factor, solutions, _placed(solutions[0], table))


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


def _of_wave(wave: _Wave, table: Table, notation: Notation) -> tuple[Solution, ...] | None:
    """Return the solutions; None if the wave vanishes everywhere with these lengths."""
    atoms = wave.cosine.atoms | wave.sine.atoms | wave.constant.atoms
    values = table.atom_values(tuple(0.0 for _ in table.rows), atoms)
    a, b, c = wave.cosine.value(values), wave.sine.value(values), wave.constant.value(values)
    if abs(c) > math.hypot(a, b):
        return ()
    if not a and not b:
        return None
    turning = tuple(i for i in wave.angle if table.rows[abs(i) - 1].is_revolute)
    offset = sum(table.rows[abs(i) - 1].offset * (1 if i > 0 else -1) for i in wave.angle)
    solutions = []
    for text, angle in zip(_formulas(wave, notation), _angles(wave, a, b, c), strict=True):
        named = joined(text, decimal(-offset)) if offset else text
        solutions.append(Solution(turning, named, _principal(angle - offset)))
    return tuple(solutions)


def _angles(wave: _Wave, a: float, b: float, c: float) -> tuple[float, float]:
    """Return where a cos ϑ + b sin ϑ + c vanishes, in the same cases as `_formulas`."""
    if not wave.constant and not wave.cosine:
        return 0.0, math.pi
    if not wave.constant and not wave.sine:
        return math.pi / 2, -math.pi / 2
    if not wave.constant:
        return math.atan2(-a, b), math.atan2(-a, b) + math.pi
    if not wave.sine:
        return math.acos(-c / a), -math.acos(-c / a)
    if not wave.cosine:
        return math.pi / 2 + math.acos(-c / b), math.pi / 2 - math.acos(-c / b)
    half = math.acos(-c / math.hypot(a, b))
    return math.atan2(b, a) + half, math.atan2(b, a) - half


def _formulas(wave: _Wave, notation: Notation) -> tuple[Text, Text]:
    """Solve R cos(ϑ - φ) = -C with R² = A² + B² and φ = atan2(B, A) for ϑ, as formulas."""
    if not wave.constant and not wave.cosine:
        return Text("0", "0"), Text(r"\pi", "pi")
    if not wave.constant and not wave.sine:
        return Text(r"\frac{\pi}{2}", "pi/2"), Text(r"-\frac{\pi}{2}", "-pi/2")
    if not wave.constant:
        top, bottom = notation.text(-wave.cosine), notation.text(wave.sine)
        first = Text(
            rf"\operatorname{{atan2}}\left({top.latex}, {bottom.latex}\right)", f"atan2({top.plain}, {bottom.plain})"
        )
        return first, Text(rf"{first.latex} + \pi", f"{first.plain} + pi")
    minus = notation.text(-wave.constant)
    size, phase = _size_and_phase(wave, notation)
    ratio = _quotient(minus, size)
    turned = Text(rf"\arccos\left({ratio.latex}\right)", f"acos({ratio.plain})")
    lead = Text(f"{phase.latex} ", f"{phase.plain} ") if phase.plain else Text("", "")
    plus = "+ " if phase.plain else ""
    return (
        Text(f"{lead.latex}{plus}{turned.latex}", f"{lead.plain}{plus}{turned.plain}"),
        Text(f"{lead.latex}- {turned.latex}" if phase.plain else f"-{turned.latex}", f"{lead.plain}-{turned.plain}"),
    )


def _quotient(top: Text, bottom: Text) -> Text:
    """Write a fraction; a single symbol needs no brackets."""
    above, below = (text.plain if re.fullmatch(r"-?\w+", text.plain) else f"({text.plain})" for text in (top, bottom))
    sign = "-" if re.fullmatch(r"-\w+", top.plain) else ""
    return Text(rf"{sign}\frac{{{top.latex.removeprefix(sign)}}}{{{bottom.latex}}}", f"{above}/{below}")


def _size_and_phase(wave: _Wave, notation: Notation) -> tuple[Text, Text]:
    """Return R and φ of A cos ϑ + B sin ϑ = R cos(ϑ - φ) as formulas; φ is empty without a sine."""
    if not wave.sine:
        return notation.text(wave.cosine), Text("", "")
    if not wave.cosine:
        return notation.text(wave.sine), Text(r"\frac{\pi}{2}", "pi/2")
    a, b = notation.bracketed(wave.cosine), notation.bracketed(wave.sine)
    size = Text(rf"\sqrt{{{a.latex}^2 + {b.latex}^2}}", f"sqrt({a.plain}**2 + {b.plain}**2)")
    top, bottom = notation.text(wave.sine), notation.text(wave.cosine)
    phase = Text(
        rf"\operatorname{{atan2}}\left({top.latex}, {bottom.latex}\right)", f"atan2({top.plain}, {bottom.plain})"
    )
    return size, phase


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
) -> tuple[Solution, ...] | None:
    """Return the solution; () if the slope is zero with these lengths, None if the constant is zero too."""
    values = table.atom_values(tuple(0.0 for _ in table.rows), slope.atoms | constant.atoms)
    k, c = slope.value(values), constant.value(values)
    if not k:
        return () if c else None
    text = notation.text(-constant)
    if slope != number(1):
        text = _quotient(text, notation.text(slope))
    return (Solution(variable.indices, text, -c / k + 0.0),)


def _placed(solution: Solution, table: Table) -> tuple[float, ...]:
    """Return a configuration with this value, the other joints drawn at random."""
    q = list(_drawn(table, Random(0)))  # noqa: S311
    *others, last = solution.variables
    rest = solution.value - sum(q[abs(i) - 1] * (1 if i > 0 else -1) for i in others)
    value = rest if last > 0 else -rest
    q[abs(last) - 1] = _principal(value) if table.rows[abs(last) - 1].is_revolute else value
    return tuple(q)


def _drawn(table: Table, random: Random) -> tuple[float, ...]:
    """Draw a configuration away from the usual singular ones."""
    return tuple(random.uniform(0.3, 1.3) * random.choice((-1, 1)) for _ in table.rows)


def _found(factor: Polynomial, table: Table) -> tuple[float, ...] | None:
    """Return a configuration at which the factor changes its sign, searched for along one joint after the other."""
    indices = sorted({abs(i) for atom in factor.atoms if _moves(atom, table) for i in atom.indices})
    random = Random(0)  # noqa: S311
    for _ in range(_DRAWS // max(1, len(indices))):
        q = _drawn(table, random)
        for index in reversed(indices):
            value = _zero_along(factor, table, q, index)
            if value is not None:
                return (*q[: index - 1], value, *q[index:])
    return None


def _zero_along(factor: Polynomial, table: Table, q: tuple[float, ...], index: int) -> float | None:
    atoms = factor.atoms
    reach = math.pi if table.rows[index - 1].is_revolute else _REACH

    def value(x: float) -> float:
        return factor.value(table.atom_values((*q[: index - 1], x, *q[index:]), atoms))

    grid = [-reach + 2 * reach * k / _STEPS for k in range(_STEPS + 1)]
    heights = [value(x) for x in grid]
    for k in range(_STEPS):
        if heights[k] * heights[k + 1] < 0:
            return _bisected(value, grid[k], grid[k + 1], heights[k])
    return None


def _bisected(value: Callable[[float], float], low: float, high: float, at_low: float) -> float:
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        at_middle = value(middle)
        if at_middle * at_low > 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _principal(angle: float) -> float:
    """Return the same angle in (-π, π]."""
    turned = math.remainder(angle, 2 * math.pi)
    return math.pi if turned <= -math.pi + 1e-12 else turned + 0.0
