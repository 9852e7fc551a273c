"""Writes equations of motion as textbooks print them: m_1 l_{c1}² + m_2 (a_1² + l_{c2}² + 2 a_1 l_{c2} c_2) + I_1.

A product is written in the order number, masses, gravity, brackets of these and of lengths, sines and cosines, rates:
each factor where its first kind of atom belongs. A sum is grouped by masses, by sines and cosines, or by rates, in the
orders that its manner allows; the shortest grouping is taken, and nested brackets count extra. Brackets come from what
all terms share, from factors without a common kind of atom, from squares of sums and from sums of rates; each is
exact, nothing is dropped.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from itertools import combinations, product
from math import isqrt
from typing import TypeAlias

from gelenk.dh.derive.algebra import (
    LENGTH,
    MASS,
    ONE,
    RATE,
    TRIGONOMETRIC,
    ZERO,
    Atom,
    Monomial,
    Polynomial,
    collected,
    monomial_product,
    quotient,
    shared_monomial,
    shared_number,
    symbol,
    total,
)
from gelenk.dh.derive.factors import separated
from gelenk.dh.derive.typeset import Formula, Notation, in_brackets, summed

_MOST_SQUARES = 6
"""Maximum number of terms of a sum whose square is searched for."""


def is_rate(atom: Atom) -> bool:
    """Check whether an atom is q̇ or q̈ of a joint."""
    return atom.kind == RATE


def place_of(monomial: Monomial) -> tuple[object, ...]:
    """Return the sort key of a group: masses before inertias, constants before waves, x² before x y before y²."""
    atoms = [atom for atom, power in monomial for _ in range(power)]
    turning = [atom for atom in atoms if atom.kind == MASS and atom.name == "I"]
    return bool(turning), any(atom.kind == TRIGONOMETRIC for atom in atoms), atoms


@lru_cache(maxsize=1024)
def square_within(polynomial: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Return the largest sum whose square occurs in a polynomial, and the rest; the sum is ZERO if there is none.

    The sum has only rates or none: l² q̇_1² + 2 l² q̇_1 q̇_2 + l² q̇_2² has a factor l² instead.
    """
    if any(is_rate(atom) for atom in polynomial.atoms) and not all(is_rate(atom) for atom in polynomial.atoms):
        return ZERO, polynomial
    roots = [root for monomial, value in polynomial if (root := _root(monomial, value)) is not None]
    for count in range(min(len(roots), _MOST_SQUARES), 1, -1):
        for chosen in combinations(sorted(roots, key=lambda root: place_of(root[0])), count):
            candidate = _with_signs(chosen, polynomial)
            rest = polynomial - candidate * candidate
            if len(rest) == len(polynomial) - count * (count + 1) // 2:
                return candidate, rest
    return ZERO, polynomial


def rate_factors(polynomial: Polynomial) -> list[Polynomial]:
    """Write a quadratic form of rates as two sums of rates, if one of these has only the coefficients 0 and 1."""
    rates = sorted(polynomial.atoms)
    if all(is_rate(atom) for atom in rates) and all(sum(p for _, p in m) == 2 for m in polynomial.terms):
        for count in range(2, len(rates) + 1):
            for chosen in combinations(rates, count):
                sum_of_rates = total(symbol(atom) for atom in chosen)
                other = _quotient(polynomial, chosen, rates)
                if other and other * sum_of_rates == polynomial:
                    return [other, sum_of_rates]
    return [polynomial]


def _quotient(polynomial: Polynomial, chosen: Sequence[Atom], rates: Sequence[Atom]) -> Polynomial:
    """Return the only candidate that, times the sum of the chosen rates, may give the form."""
    terms: dict[Monomial, Fraction] = {}
    for atom in rates:
        pair: Monomial = ((atom, 2),) if atom in chosen else monomial_product(((atom, 1),), ((chosen[0], 1),))
        terms[((atom, 1),)] = polynomial.terms.get(pair, Fraction(0))
    return collected(terms.items())


def _root(monomial: Monomial, value: Fraction) -> tuple[Monomial, Fraction] | None:
    top, bottom = isqrt(max(value.numerator, 0)), isqrt(value.denominator)
    exact = value > 0 and top * top == value.numerator and bottom * bottom == value.denominator
    if not exact or not monomial or any(power % 2 for _, power in monomial):
        return None
    return tuple((atom, power // 2) for atom, power in monomial), Fraction(top, bottom)


def _with_signs(roots: Sequence[tuple[Monomial, Fraction]], polynomial: Polynomial) -> Polynomial:
    """Return the sum of some terms, each with the sign of its product with the first one."""
    (first, size), *others = roots
    signs = [1 if polynomial.terms.get(monomial_product(first, m), Fraction(0)) > 0 else -1 for m, _ in others]
    terms = {m: value * sign for (m, value), sign in zip(others, signs, strict=True)}
    return Polynomial({first: size, **terms})


Key: TypeAlias = Callable[[Atom], bool]
Factor: TypeAlias = tuple[Polynomial, int]
"""A bracket and its power."""

_LARGEST_RATIO = 4
"""A decimal number is taken out of a bracket of rates only if whole numbers up to this are left in it."""
_NESTING = 12
"""Number of characters that a nested bracket counts."""


def _is_mass(atom: Atom) -> bool:
    return atom.kind == MASS


def _is_wave(atom: Atom) -> bool:
    return atom.kind == TRIGONOMETRIC


def _is_static(atom: Atom) -> bool:
    return atom.kind not in {MASS, RATE}


@dataclass(frozen=True, slots=True)
class Manner:
    """How a kind of formula is written.

    Attributes:
        groupings: Ways to group a sum, each by kinds of atoms in turn.
        distributes: Whether a factor that several groups share is written in each, or before a bracket; or both tried.
        keeps_lengths: Whether a length that sines and cosines and constants share stays within the bracket:
            l² + a l c and not l (l + a c).
    """

    groupings: tuple[tuple[Key, ...], ...]
    distributes: tuple[bool, ...] = (False,)
    keeps_lengths: bool = False


BY_MASS = Manner(((_is_mass, _is_wave, is_rate),), keeps_lengths=True)
"""For M: one bracket per mass."""
BY_ENERGY = Manner(((_is_mass, _is_wave, is_rate), (_is_mass, is_rate, _is_wave), (_is_mass, _is_static)), (True,))
"""For T: one sum for the mass, one for the inertia."""
BY_HEIGHT = Manner(((_is_mass, _is_wave),))
"""For U."""
BY_WAVE = Manner(
    ((_is_wave, is_rate, _is_mass), (is_rate, _is_wave, _is_mass), (_is_mass, _is_wave, is_rate)), (True, False)
)
"""For C: one product per sine or cosine."""
BY_WEIGHT = Manner(((_is_wave, _is_mass),), (True,))
"""For g: likewise, with gravity in each product."""


def written(polynomial: Polynomial, notation: Notation, manner: Manner) -> Formula:
    """Write a polynomial in a manner."""
    plain = notation.numbered(polynomial)
    if not plain:
        return Formula("0", "0")
    options = product(manner.groupings, manner.distributes)
    texts = (_Writer(notation, keys, shared, manner.keeps_lengths).whole(plain) for keys, shared in options)
    return min(texts, key=_length)


def _length(text: Formula) -> int:
    depth, deepest = 0, 0
    for character in text.plain:
        depth += {"(": 1, ")": -1}.get(character, 0)
        deepest = max(deepest, depth)
    return len(text.plain) + _NESTING * max(0, deepest - 1)


@dataclass(frozen=True, slots=True)
class _Product:
    """A product: number · powers of atoms · brackets."""

    factor: Fraction
    atoms: Monomial
    brackets: tuple[Factor, ...]

    @property
    def is_a_sum(self) -> bool:
        """Whether it is only one bracket, perhaps with a number before it."""
        return not self.atoms and len(self.brackets) == 1 and self.brackets[0][1] == 1


@dataclass(frozen=True, slots=True)
class _Writer:
    notation: Notation
    keys: tuple[Key, ...]
    distributes: bool
    keeps_lengths: bool

    def whole(self, polynomial: Polynomial) -> Formula:
        """Write a formula that stands alone; if `distributes`, a factor that all groups share stays in each."""
        whole = self._product(polynomial)
        if whole.is_a_sum or (self.distributes and len(_groups(polynomial, self.keys[0])) > 1):
            return self._sum(polynomial)
        return self._text(whole)

    def _product(self, polynomial: Polynomial) -> _Product:
        """Factorise by what all terms share, then by kinds of atoms, then into squares and sums of rates."""
        factor, atoms, rest = self._taken_out(polynomial)
        if rest == ONE:
            return _Product(factor, atoms, ())
        for kind in (is_rate, _is_mass, _is_wave):
            parts = separated(rest, kind)
            if parts is not None and self._is_tidy(parts):
                brackets = list[Factor]()
                for part in map(self._product, parts):
                    factor, atoms = factor * part.factor, monomial_product(atoms, part.atoms)
                    brackets += part.brackets
                return _Product(factor, atoms, tuple(brackets))
        root, remainder = square_within(rest)
        if root and not remainder:
            return _Product(factor, atoms, ((root, 2),))
        return _Product(factor, atoms, tuple((part, 1) for part in rate_factors(rest)))

    def _taken_out(self, polynomial: Polynomial) -> tuple[Fraction, Monomial, Polynomial]:
        shared, factor = shared_monomial(polynomial), self._shared_number(polynomial)
        if self.keeps_lengths and len(_groups(polynomial, _is_wave)) > 1:
            shared = tuple(item for item in shared if item[0].kind != LENGTH)
        return factor, shared, quotient(polynomial, factor, shared)

    def _shared_number(self, polynomial: Polynomial) -> Fraction:
        """Return the number before the bracket; a decimal number only if the bracket gets shorter."""
        values = list(polynomial.terms.values())
        if len(values) == 1:
            return values[0]
        if not self.notation.numbers:
            return shared_number(polynomial)
        least = min(map(abs, values))
        most = _LARGEST_RATIO if all(any(is_rate(atom) for atom, _ in m) for m in polynomial.terms) else 1
        return least if all(_is_small(value / least, most) for value in values) else Fraction(1)

    def _is_tidy(self, parts: Sequence[Polynomial]) -> bool:
        return not self.notation.numbers or all(_is_small(x) for part in parts[1:] for x in part.terms.values())

    def _text(self, whole: _Product) -> Formula:
        factor = whole.factor
        pieces = [
            ((atom.kind, 0, atom.indices), self.notation.monomial(Fraction(1), ((atom, power),)))
            for atom, power in whole.atoms
        ]
        for bracket, power in whole.brackets:
            inner = self._sum(bracket)
            if inner.plain.startswith("-"):
                factor, inner = (-factor if power % 2 else factor), self._sum(-bracket)
            place = min(bracket.atoms, default=Atom(MASS, (), ""))
            pieces.append(((place.kind, 1, place.indices), in_brackets(inner, power)))
        pieces.sort(key=lambda piece: piece[0])
        return self.notation.signed(factor, [text for _, text in pieces])

    def _sum(self, polynomial: Polynomial) -> Formula:
        return summed([self._text(self._product(part)) for part in self._summands(polynomial, self.keys)])

    def _summands(self, polynomial: Polynomial, keys: Sequence[Key]) -> list[Polynomial]:
        """Return groups that are products; a group that is not is divided further."""
        for i, key in enumerate(keys):
            groups = _same_rates(polynomial) if key is _is_static else _groups(polynomial, key)
            if len(groups) > 1:
                found = list[Polynomial]()
                for group in groups:
                    found += self._summands(group, keys[i + 1 :]) if self._product(group).is_a_sum else [group]
                return found
        root, rest = square_within(polynomial)
        squares = [root * root] if root else []
        return [*squares, *(Polynomial({m: rest.terms[m]}) for m in sorted(rest.terms, key=place_of))]


def _is_small(value: Fraction, most: int = 1) -> bool:
    return value.denominator == 1 and abs(value) <= most


def _groups(polynomial: Polynomial, key: Key) -> list[Polynomial]:
    groups: dict[Monomial, dict[Monomial, Fraction]] = {}
    for monomial, value in polynomial:
        groups.setdefault(tuple(item for item in monomial if key(item[0])), {})[monomial] = value
    return [Polynomial(groups[part]) for part in sorted(groups, key=place_of)]


def _same_rates(polynomial: Polynomial) -> list[Polynomial]:
    """Group the terms by lengths, sines and cosines; groups whose rates differ only by a number are joined."""
    alike: dict[Polynomial, list[Polynomial]] = {}
    for group in _groups(polynomial, _is_static):
        rates = {tuple(item for item in m if is_rate(item[0])): value for m, value in group}
        first = rates[min(rates)]
        alike.setdefault(quotient(Polynomial(rates), first), []).append(group)
    return [total(groups) for groups in alike.values()]
