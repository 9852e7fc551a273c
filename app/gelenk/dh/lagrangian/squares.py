"""Finds squares of sums, and products of sums of rates, in a polynomial by its coefficients."""

from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from itertools import combinations
from math import isqrt

from gelenk.dh.derive.algebra import (
    MASS,
    RATE,
    TRIGONOMETRIC,
    ZERO,
    Atom,
    Monomial,
    Polynomial,
    collected,
    monomial_product,
    symbol,
    total,
)

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
