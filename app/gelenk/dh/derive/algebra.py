"""Polynomials in sines and cosines of sums of joint angles, lengths and constants: the algebra of a worked solution.

Coefficients are exact. An angle is a sum of joint angles ϑ_i of parallel axes, written as its signed indices in order
of magnitude: (2, 3) is ϑ_2 + ϑ_3, (1, 2, -4) is ϑ_1 + ϑ_2 - ϑ_4; an index that occurs twice counts twice. The first
index of an atom is positive, so that each sine and cosine has one name.

No simplification is searched for: sums of angles come from the chain itself, and `reduced` turns products of sines and
cosines of parallel axes into sums of single ones, which no identity can shorten further: two polynomials are the same
function if and only if their reduced forms are equal.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import Literal, NamedTuple, TypeAlias

Angle: TypeAlias = tuple[int, ...]

ROOT, MASS, GRAVITY, LENGTH, VARIABLE, CONSTANT, TRIGONOMETRIC, RATE = range(8)
"""Kinds of atoms, in the order in which a product is written."""

MAX_TERMS = 4000
"""Maximum number of terms: a longer polynomial is unreadable."""


class TooManyTerms(Exception):
    """A polynomial has become too long to be read."""


class Atom(NamedTuple):
    """An indivisible factor: √2, a mass m_1, g_0, a length a_2, a variable q_3, a constant cos α_3, c_{23}, or q̇_1.

    These are its kinds; its indices are the row's or the angle's, its name is the quantity's, such as "a", "q" and "c".
    """

    kind: int
    indices: tuple[int, ...]
    name: str


Monomial: TypeAlias = tuple[tuple[Atom, int], ...]
Group: TypeAlias = Callable[[int], int]
"""Maps the index of a joint angle to the number of its group of parallel axes."""


class Polynomial:
    """A sum of monomials with exact coefficients, none of them zero. It never changes."""

    __slots__ = ("terms",)

    def __init__(self, terms: Mapping[Monomial, Fraction]) -> None:
        if len(terms) > MAX_TERMS:
            raise TooManyTerms
        self.terms = terms

    def __add__(self, other: "Polynomial") -> "Polynomial":
        return total((self, other))

    def __sub__(self, other: "Polynomial") -> "Polynomial":
        return total((self, -other))

    def __neg__(self) -> "Polynomial":
        return Polynomial({monomial: -factor for monomial, factor in self.terms.items()})

    def __mul__(self, other: "Polynomial") -> "Polynomial":
        if len(self.terms) * len(other.terms) > 16 * MAX_TERMS:
            raise TooManyTerms
        return collected(
            (monomial_product(left, right), p * q) for left, p in self.terms.items() for right, q in other.terms.items()
        )

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Polynomial) and self.terms == other.terms

    def __hash__(self) -> int:
        return hash(frozenset(self.terms.items()))

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __len__(self) -> int:
        return len(self.terms)

    def __iter__(self) -> Iterator[tuple[Monomial, Fraction]]:
        return iter(self.terms.items())

    @property
    def atoms(self) -> set[Atom]:
        """All atoms that occur in it."""
        return {atom for monomial in self.terms for atom, _ in monomial}

    @property
    def constant(self) -> Fraction | None:
        """The value if it is a rational number, else None."""
        if not self.terms:
            return Fraction(0)
        return self.terms.get(()) if len(self.terms) == 1 else None

    def value(self, values: Mapping[Atom, float]) -> float:
        """Evaluate the polynomial with these values of the atoms."""
        result = 0.0
        for monomial, factor in self:
            result += math.prod((values[atom] ** power for atom, power in monomial), start=float(factor))
        return result

    def size(self, values: Mapping[Atom, float]) -> float:
        """Return the sum of its terms' magnitudes: the rounding error of its value grows with it."""
        return sum(
            abs(float(factor)) * math.prod(abs(values[atom]) ** power for atom, power in monomial)
            for monomial, factor in self.terms.items()
        )


Vector: TypeAlias = tuple[Polynomial, ...]
Matrix: TypeAlias = tuple[Vector, ...]
"""A 3×3 matrix, row by row."""


def number(value: int | Fraction) -> Polynomial:
    """Return a constant polynomial."""
    return Polynomial({(): Fraction(value)} if value else {})


ZERO, ONE = number(0), number(1)


def symbol(atom: Atom) -> Polynomial:
    """Return an atom as a polynomial."""
    return Polynomial({((atom, 1),): Fraction(1)})


def total(polynomials: Iterable[Polynomial]) -> Polynomial:
    """Return the sum of polynomials."""
    return collected(term for polynomial in polynomials for term in polynomial)


def collected(terms: Iterable[tuple[Monomial, Fraction]]) -> Polynomial:
    """Return the polynomial of these terms, with equal monomials added up."""
    sums: dict[Monomial, Fraction] = {}
    for monomial, factor in terms:
        value = sums.get(monomial, Fraction(0)) + factor
        if value:
            sums[monomial] = value
        else:
            sums.pop(monomial, None)
    return Polynomial(sums)


def monomial_product(left: Monomial, right: Monomial) -> Monomial:
    """Return the product of two monomials, its atoms in order."""
    if not left or not right:
        return left or right
    powers = dict(left)
    for atom, power in right:
        powers[atom] = powers.get(atom, 0) + power
    return tuple(sorted(powers.items()))


def angle_sum(left: Angle, right: Angle, sign: int = 1) -> Angle:
    """Return left + sign · right."""
    counts: dict[int, int] = {}
    for angle, factor in ((left, 1), (right, sign)):
        for index in angle:
            counts[abs(index)] = counts.get(abs(index), 0) + (factor if index > 0 else -factor)
    return tuple(index if count > 0 else -index for index, count in sorted(counts.items()) for _ in range(abs(count)))


def cosine(angle: Angle, quarters: int = 0) -> Polynomial:
    """Return cos(angle + quarters · π/2)."""
    if quarters % 4:
        return -sine(angle, quarters - 1)
    if not angle:
        return ONE
    return symbol(Atom(TRIGONOMETRIC, angle if angle[0] > 0 else tuple(-index for index in angle), "c"))


def sine(angle: Angle, quarters: int = 0) -> Polynomial:
    """Return sin(angle + quarters · π/2)."""
    if quarters % 4:
        return cosine(angle, quarters - 1)
    if not angle:
        return ZERO
    if angle[0] < 0:
        return -sine(tuple(-index for index in angle))
    return symbol(Atom(TRIGONOMETRIC, angle, "s"))


def dot(left: Sequence[Polynomial], right: Sequence[Polynomial]) -> Polynomial:
    """Return the scalar product."""
    return total(x * y for x, y in zip(left, right, strict=True))


def cross(left: Vector, right: Vector) -> Vector:
    """Return the vector product."""
    (a, b, c), (x, y, z) = left, right
    return b * z - c * y, c * x - a * z, a * y - b * x


def product(left: Matrix, right: Matrix) -> Matrix:
    """Return the product of two matrices."""
    columns = tuple(zip(*right, strict=True))
    return tuple(applied(columns, row) for row in left)


def applied(matrix: Matrix, vector: Vector) -> Vector:
    """Return matrix times vector."""
    return tuple(dot(row, vector) for row in matrix)


def column(matrix: Matrix, index: Literal[0, 1, 2]) -> Vector:
    """Return a column of a matrix."""
    return tuple(row[index] for row in matrix)


def plus(left: Vector, right: Vector) -> Vector:
    """Return the sum of two vectors."""
    return tuple(x + y for x, y in zip(left, right, strict=True))


def minus(left: Vector, right: Vector) -> Vector:
    """Return the difference of two vectors."""
    return tuple(x - y for x, y in zip(left, right, strict=True))


def scaled(factor: Polynomial, vector: Vector) -> Vector:
    """Return a vector times a polynomial."""
    return tuple(factor * x for x in vector)


def shared_number(polynomial: Polynomial) -> Fraction:
    """Return the positive number that all coefficients share."""
    factors = polynomial.terms.values()
    top = math.gcd(*(factor.numerator for factor in factors))
    return Fraction(top, math.lcm(*(factor.denominator for factor in factors)))


def shared_monomial(polynomial: Polynomial) -> Monomial:
    """Return the product of the atoms that all terms share; the polynomial is not zero."""
    powers = [dict(monomial) for monomial in polynomial.terms]
    shared = {atom: min(power.get(atom, 0) for power in powers) for atom in powers[0]}
    return tuple(sorted((atom, power) for atom, power in shared.items() if power))


def quotient(polynomial: Polynomial, factor: Fraction, divisor: Monomial = ()) -> Polynomial:
    """Return a polynomial divided by a number and by a monomial that all its terms contain."""
    terms = {}
    for monomial, value in polynomial:
        powers = dict(monomial)
        for atom, power in divisor:
            powers[atom] -= power
        terms[tuple((atom, power) for atom, power in powers.items() if power)] = value / factor
    return Polynomial(terms)


def derivative(polynomial: Polynomial, index: int, *, slides: bool = False) -> Polynomial:
    """Return ∂/∂ϑ of joint `index`; with `slides` ∂/∂q of a prismatic joint, whose angle is constant."""
    kind = VARIABLE if slides else TRIGONOMETRIC
    return collected(
        (monomial_product(tuple(item for item in monomial if item[0] != atom), rest), factor * scale)
        for monomial, factor in polynomial
        for atom, power in monomial
        if atom.kind == kind
        for rest, scale in _derivatives(atom, power, index)
    )


def _derivatives(atom: Atom, power: int, index: int) -> list[tuple[Monomial, int]]:
    """Return the derivative of atom^power, [] if it is zero; sines and cosines may only have the power 1."""
    if atom.kind == VARIABLE and atom.indices == (index,):
        return [(((atom, power - 1),) if power > 1 else (), power)]
    rate = sum((1 if i > 0 else -1) for i in atom.indices if abs(i) == index) if atom.kind == TRIGONOMETRIC else 0
    if not rate:
        return []
    if power != 1:
        raise TooManyTerms
    name, factor = ("s", -rate) if atom.name == "c" else ("c", rate)
    return [(((atom._replace(name=name), 1),), factor)]


def reduced(polynomial: Polynomial, group: Group) -> Polynomial:
    """Return the same function with at most one sine or cosine per group in each term, and s_α² = 1 - c_α².

    A group holds parallel axes. This form is unique: it is zero only if the function is.
    """
    return collected(
        (monomial, factor * scale)
        for whole, factor in polynomial
        for monomial, scale in _reduced_monomial(whole, group)
    )


def reduced_vector(vector: Vector, group: Group) -> Vector:
    """Return a vector with each entry reduced."""
    return tuple(reduced(entry, group) for entry in vector)


def reduced_matrix(matrix: Matrix, group: Group) -> Matrix:
    """Return a matrix with each entry reduced."""
    return tuple(reduced_vector(row, group) for row in matrix)


def _reduced_monomial(whole: Monomial, group: Group) -> list[tuple[Monomial, Fraction]]:
    waves: dict[int, list[Atom]] = {}
    plain: list[tuple[Atom, int]] = []
    for atom, power in whole:
        if atom.kind == TRIGONOMETRIC:
            waves.setdefault(group(abs(atom.indices[0])), []).extend([atom] * power)
        else:
            plain.append((atom, power))
    if all(len(atoms) == 1 for atoms in waves.values()) and all(_is_reduced(*item) for item in plain):
        return [(whole, Fraction(1))]
    terms = _constants(plain)
    for atoms in waves.values():
        merged = _merged(atoms)
        terms = [(monomial_product(left, right), p * q) for left, p in terms for right, q in merged]
        if len(terms) > MAX_TERMS:
            raise TooManyTerms
    return terms


def _is_reduced(atom: Atom, power: int) -> bool:
    return power == 1 or not (atom.kind == ROOT or (atom.kind == CONSTANT and atom.name.startswith("s")))


def _constants(items: Sequence[tuple[Atom, int]]) -> list[tuple[Monomial, Fraction]]:
    """Apply √n² = n, and sin² = 1 - cos² of a constant angle."""
    terms: list[tuple[Monomial, Fraction]] = [((), Fraction(1))]
    for atom, power in items:
        if _is_reduced(atom, power):
            factors: list[tuple[Monomial, Fraction]] = [(((atom, power),), Fraction(1))]
        else:
            odd: Monomial = ((atom, 1),) if power % 2 else ()
            factors = [(odd, Fraction(1))]
            for _ in range(power // 2):
                if atom.kind == ROOT:
                    factors = [(monomial, factor * atom.indices[0]) for monomial, factor in factors]
                else:
                    square: Monomial = ((atom._replace(name="c" + atom.name[1:]), 2),)
                    factors += [(monomial_product(monomial, square), -factor) for monomial, factor in factors]
        terms = [(monomial_product(left, right), p * q) for left, p in terms for right, q in factors]
    return terms


def _merged(atoms: Sequence[Atom]) -> list[tuple[Monomial, Fraction]]:
    """Return a product of sines and cosines of sums in one group, as a sum of single ones."""
    waves: dict[tuple[Angle, str], Fraction] = {(atoms[0].indices, atoms[0].name): Fraction(1)}
    for atom in atoms[1:]:
        sums: dict[tuple[Angle, str], Fraction] = {}
        for (angle, name), factor in waves.items():
            for sign in (1, -1):
                other, kind, part = _wave(angle, name, atom, sign)
                if part:
                    sums[other, kind] = sums.get((other, kind), Fraction(0)) + factor * part / 2
        waves = sums
    return [
        (((Atom(TRIGONOMETRIC, angle, name), 1),) if angle else (), factor)
        for (angle, name), factor in waves.items()
        if factor
    ]


def _wave(angle: Angle, name: str, atom: Atom, sign: int) -> tuple[Angle, str, int]:
    """Return one of the two waves of twice a product: its angle, whether sine or cosine, and its factor.

    2 cos x cos y = cos(x+y) + cos(x-y),  2 sin x sin y = cos(x-y) - cos(x+y),
    2 sin x cos y = sin(x+y) + sin(x-y),  2 cos x sin y = sin(x+y) - sin(x-y).
    """
    combined = angle_sum(angle, atom.indices, sign)
    kind = "c" if name == atom.name else "s"
    factor = -sign if (name, atom.name) == ("s", "s") else sign if (name, atom.name) == ("c", "s") else 1
    if combined and combined[0] < 0:
        combined = tuple(-index for index in combined)
        factor = factor if kind == "c" else -factor
    return (combined, kind, 0 if kind == "s" and not combined else factor)
