"""Factorisation of a polynomial of joint angles into the product that a textbook prints.

Three methods, the cheapest first: what all terms share; factors in different variables, for which the table of
coefficients has rank one; and, for the rest, factors of a polynomial in the tangents of the half angles, in which the
identity s² + c² = 1 is no longer in the way. Each product is multiplied out and compared before it is accepted.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from functools import reduce
from itertools import combinations
from typing import Any, TypeAlias

from gelenk.dh.derive.algebra import (
    LENGTH,
    ONE,
    TRIGONOMETRIC,
    VARIABLE,
    Atom,
    Group,
    Monomial,
    Polynomial,
    TooManyTerms,
    cosine,
    number,
    quotient,
    reduced,
    shared_monomial,
    shared_number,
    sine,
    symbol,
    total,
)

Degrees: TypeAlias = tuple[int, ...]

MAX_FACTORED_TERMS = 60
"""Maximum number of terms of a polynomial that is searched for factors with common variables."""
MAX_FACTORED_ANGLES = 4
MAX_HALF_ANGLE_TERMS = 400
"""Maximum number of terms of a polynomial in the tangents of the half angles: those of known arms have up to 160."""


def factorised(polynomial: Polynomial, group: Group) -> tuple[Fraction, list[Polynomial]]:
    """Return a number and factors whose product is a reduced polynomial, not zero; each occurs as often as its power.

    Atoms come first, then sums with whole coefficients without a common divisor, the first one positive.
    """
    factor, atoms, rest = _shared(polynomial)
    sums: list[Polynomial] = []
    pending = [rest] if len(rest) > 1 else []
    while pending:
        candidate = pending.pop()
        parts = _separated(candidate, group) or _searched(candidate, group)
        if parts is None:
            sums.append(candidate)
            continue
        for part in parts:
            scale, more, remainder = _shared(part)
            factor *= scale
            atoms += more
            if len(remainder) > 1:
                pending.append(remainder)
    halves = [_halved(atom) for atom in atoms]
    factor *= 2 ** sum(len(half) > 1 for half in halves)
    atoms = [atom for half in halves for atom in half]
    atoms.sort(key=lambda atom: (atom.kind == TRIGONOMETRIC, atom))
    return factor, [*(symbol(atom) for atom in atoms), *sorted(sums, key=lambda item: sorted(item.terms))]


def without_multiples(polynomial: Polynomial) -> tuple[Fraction, Polynomial]:
    """Return a number and a polynomial; sin 2x and cos 2x are written with sin x and cos x if that is shorter.

    cos 2x is 2 cos² x - 1 or 1 - 2 sin² x; the shortest of the three is taken.
    """
    options = [polynomial, _doubled(polynomial, "c"), _doubled(polynomial, "s")]
    best = min(options, key=len)
    content = shared_number(best)
    return content, quotient(best, content)


def _doubled(polynomial: Polynomial, square: str) -> Polynomial:
    return total(_doubled_monomial(monomial, square) * number(factor) for monomial, factor in polynomial)


def _doubled_monomial(monomial: Monomial, square: str) -> Polynomial:
    result = ONE
    for atom, power in monomial:
        k, *others = atom.indices
        if atom.kind != TRIGONOMETRIC or others != [k]:
            result = result * Polynomial({((atom, power),): Fraction(1)})
        elif atom.name == "s":
            result = result * number(2) * sine((k,)) * cosine((k,))
        elif square == "c":
            result = result * (number(2) * cosine((k,)) * cosine((k,)) - ONE)
        else:
            result = result * (ONE - number(2) * sine((k,)) * sine((k,)))
    return result


def _shared(polynomial: Polynomial) -> tuple[Fraction, list[Atom], Polynomial]:
    """Return the number and the atoms that all terms share, and the rest, whose first coefficient is positive."""
    shared, content = shared_monomial(polynomial), shared_number(polynomial)
    if polynomial.terms[min(polynomial.terms)] < 0:
        content = -content
    atoms = [atom for atom, power in shared for _ in range(power)]
    return content, atoms, quotient(polynomial, content, shared)


def _halved(atom: Atom) -> tuple[Atom, ...]:
    """Return sine and cosine of half the angle of a sine, as sin 2x = 2 sin x cos x; the atom if there is no half."""
    counts = Counter(atom.indices)
    if atom.kind != TRIGONOMETRIC or atom.name != "s" or any(count % 2 for count in counts.values()):
        return (atom,)
    half = tuple(index for index, count in counts.items() for _ in range(count // 2))
    return Atom(TRIGONOMETRIC, half, "s"), Atom(TRIGONOMETRIC, half, "c")


def _slot(atom: Atom, group: Group) -> tuple[int, int] | None:
    """Return what an atom varies with: a group of joint angles or a prismatic variable; None if it is constant."""
    if atom.kind == TRIGONOMETRIC:
        return (0, group(abs(atom.indices[0])))
    return (1, atom.indices[0]) if atom.kind == VARIABLE else None


def _separated(polynomial: Polynomial, group: Group) -> list[Polynomial] | None:
    """Return two factors without a common variable, the second with all constants; None if there are none."""
    slots = sorted({slot for atom in polynomial.atoms if (slot := _slot(atom, group))})
    for count in range(1, len(slots) + 1):
        for chosen in combinations(slots, count):
            inside = {atom for atom in polynomial.atoms if _slot(atom, group) in chosen}
            parts = separated(polynomial, inside.__contains__)
            if parts is not None:
                return parts
    return None


def separated(polynomial: Polynomial, is_inside: Callable[[Atom], bool]) -> list[Polynomial] | None:
    """Return two factors, one with some of the atoms and one with the others; None if there are none.

    If there are, the table of coefficients, with a row for each product of the other atoms, has rank one.
    """
    table: dict[Monomial, dict[Monomial, Fraction]] = {}
    for monomial, factor in polynomial:
        inside = tuple(item for item in monomial if is_inside(item[0]))
        outside = tuple(item for item in monomial if not is_inside(item[0]))
        table.setdefault(outside, {})[inside] = factor
    first = next(iter(table.values()))
    if len(table) < 2 or len(first) < 2:
        return None
    pivot = next(iter(first))
    ratios = {outside: row.get(pivot, Fraction(0)) / first[pivot] for outside, row in table.items()}
    scaled = {outside: {key: value * ratio for key, value in first.items()} for outside, ratio in ratios.items()}
    return [Polynomial(first), Polynomial(ratios)] if table == scaled else None


def _searched(polynomial: Polynomial, group: Group) -> list[Polynomial] | None:
    """Return factors that share variables, by half angles; None if there are none, or the search would be long."""
    angles = sorted({abs(i) for atom in polynomial.atoms if atom.kind == TRIGONOMETRIC for i in atom.indices})
    if (
        _is_irreducible(polynomial)
        or not angles
        or len(angles) > MAX_FACTORED_ANGLES
        or len(polynomial) > MAX_FACTORED_TERMS
    ):
        return None
    half = _HalfAngles(polynomial, angles, group)
    if len(half) > MAX_HALF_ANGLE_TERMS:
        return None
    found = half.factors()
    if len(found) < 2:
        return None
    product = reduce(lambda left, right: reduced(left * right, group), found, ONE)
    first = min(polynomial.terms)
    if first not in product.terms:
        return None
    scale = number(polynomial.terms[first] / product.terms[first])
    return [found[0] * scale, *found[1:]] if product * scale == polynomial else None


def _is_irreducible(polynomial: Polynomial) -> bool:
    """Check whether the polynomial obviously has no factors.

    If a length occurs in only one term, the polynomial is linear in it, so that a factor would divide the rest of this
    term. With two such lengths it would divide both rests; sines and cosines of different angles, without multiples,
    have no common factor, nor have the sine and the cosine of one angle.
    """
    where: dict[Atom, list[Monomial]] = {}
    for monomial in polynomial.terms:
        for atom, _ in monomial:
            where.setdefault(atom, []).append(monomial)
    beside = []
    for atom, monomials in where.items():
        if atom.kind != LENGTH or len(monomials) > 1 or dict(monomials[0])[atom] > 1:
            continue
        rest = [item for item in monomials[0] if item[0] != atom]
        if all(other.kind == TRIGONOMETRIC and len(set(other.indices)) == len(other.indices) for other, _ in rest):
            beside.append({other for other, _ in rest})
    return any(not left & right for left, right in combinations(beside, 2))


class _HalfAngles:
    """A polynomial in t_k = tan(ϑ_k/2) over powers of 1 + t_k², and its factors as functions of the angles again.

    The degree 2N_k of the denominator in t_k counts: what the numerator lacks in degree is a zero at ϑ_k = π, where
    t_k is infinite. A factor of odd degree has twice the period and no form in ϑ_k: it is combined with others.
    """

    def __init__(self, polynomial: Polynomial, angles: Sequence[int], group: Group) -> None:
        from sympy.polys.domains import ZZ  # noqa: PLC0415 - half a second, and seldom needed
        from sympy.polys.rings import ring  # noqa: PLC0415

        self._angles, self._group = list(angles), group
        self._constants = sorted(atom for atom in polynomial.atoms if atom.kind != TRIGONOMETRIC)
        names = [f"t{k}" for k in angles] + [f"x{i}" for i in range(len(self._constants))]
        self._ring, *generators = ring(names, ZZ)
        self._tangents = dict(zip(angles, generators, strict=False))
        self._symbols = dict(zip(self._constants, generators[len(angles) :], strict=True))
        self._degrees = {
            k: max(
                sum(abs(i) == k for atom, _ in monomial if atom.kind == TRIGONOMETRIC for i in atom.indices)
                for monomial in polynomial.terms
            )
            for k in angles
        }
        self._numerator = self._half(polynomial)

    def __len__(self) -> int:
        return len(self._numerator)

    def factors(self) -> list[Polynomial]:
        """Return the factors up to a number, without those that the denominator cancels.

        SymPy draws at random where it evaluates a polynomial, and a bad draw takes it minutes where most take a
        second. The draws are the same each time, so that a polynomial is always factored or never.
        """
        from sympy.core.random import seed  # noqa: PLC0415 - see above

        seed(0)
        items: list[tuple[Degrees, Any]] = []
        squares = [self._tangents[k] ** 2 + 1 for k in self._angles]
        lacking = {k: 2 * self._degrees[k] for k in self._angles}
        for factor, power in self._numerator.factor_list()[1]:
            degrees = tuple(factor.degree(self._tangents[k]) for k in self._angles)
            for k, degree in zip(self._angles, degrees, strict=True):
                lacking[k] -= degree * power
            if factor not in squares:
                items += [(degrees, factor)] * power
        for k, count in lacking.items():
            items += [(tuple(int(j == k) for j in self._angles), self._ring.one)] * count
        return [part for part in self._paired(items) if len(part) > 1 or () not in part.terms]

    def _paired(self, items: list[tuple[Degrees, Any]]) -> list[Polynomial]:
        """Return factors of even degree alone, the others in the smallest sets of even degree, short products first."""
        done = [self._whole([item]) for item in items if not any(degree % 2 for degree in item[0])]
        rest = [item for item in items if any(degree % 2 for degree in item[0])]
        while rest:
            for count in range(2, len(rest) + 1):
                sets = combinations(range(len(rest)), count)
                even = [chosen for chosen in sets if not any(d % 2 for d in _summed(rest[i][0] for i in chosen))]
                if even:
                    break
            else:
                raise TooManyTerms
            products = [(self._whole([rest[i] for i in chosen]), chosen) for chosen in even]
            whole, chosen = min(products, key=lambda item: len(item[0]))
            done.append(whole)
            rest = [item for i, item in enumerate(rest) if i not in chosen]
        return done

    def _half(self, polynomial: Polynomial) -> Any:
        scale = shared_number(polynomial)
        result = self._ring.zero
        for monomial, factor in polynomial:
            term = self._ring.one * int(factor / scale)
            left = dict(self._degrees)
            for atom, power in monomial:
                if atom.kind != TRIGONOMETRIC:
                    term *= self._symbols[atom] ** power
                    continue
                real, imaginary = self._ring.one, self._ring.zero
                for index in atom.indices:
                    t = self._tangents[abs(index)] * (1 if index > 0 else -1)
                    left[abs(index)] -= 1
                    for _ in range(2):
                        real, imaginary = real - imaginary * t, imaginary + real * t
                term *= real if atom.name == "c" else imaginary
            for k, count in left.items():
                term *= (self._tangents[k] ** 2 + 1) ** count
            result += term
        return result

    def _whole(self, items: Sequence[tuple[Degrees, Any]]) -> Polynomial:
        """Return the product of some factors as a function of the angles; the sums of their degrees are even."""
        product = reduce(lambda left, right: left * right, (factor for _, factor in items), self._ring.one)
        totals = _summed(degrees for degrees, _ in items)
        result = Polynomial({})
        for powers, factor in product.terms():
            term = number(int(factor))
            for k, power, degree in zip(self._angles, powers, totals, strict=False):
                term = term * _half_powers(k, power, degree)
            constants = zip(self._constants, powers[len(self._angles) :], strict=True)
            monomial = tuple((atom, power) for atom, power in constants if power)  # in order, as the constants are
            result = result + term * Polynomial({monomial: Fraction(1)})
        whole = reduced(result, self._group)
        return quotient(whole, shared_number(whole))


def _summed(degrees: Iterable[Degrees]) -> list[int]:
    return [sum(column) for column in zip(*degrees, strict=True)]


def _half_powers(k: int, power: int, degree: int) -> Polynomial:
    """Return sin(ϑ/2)^power · cos(ϑ/2)^(degree - power) as a polynomial in cos ϑ and sin ϑ; the degree is even."""
    half = number(Fraction(1, 2))
    c, s = cosine((k,)), sine((k,))
    result = s * half if power % 2 else ONE
    for _ in range(power // 2):
        result = result * (ONE - c) * half
    for _ in range((degree - power) // 2):
        result = result * (ONE + c) * half
    return result
