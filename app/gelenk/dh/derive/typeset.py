"""Polynomials and matrices as LaTeX and as plain text.

A sum is written factor by factor in the order of the axes: what all terms share stands before a bracket, then the
terms are collected by the sines and cosines of the first group of parallel axes, and within each bracket by those of
the next one: c_1 (a_2 c_2 + a_3 c_23). The plain text is valid in Python and in most computer algebra systems.
"""

import math
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal, TypeAlias

from gelenk.course.steps import bmatrix
from gelenk.dh.derive.algebra import (
    ONE,
    ROOT,
    TRIGONOMETRIC,
    Atom,
    Group,
    Monomial,
    Polynomial,
    collected,
    monomial_product,
    number,
    quotient,
    shared_monomial,
    shared_number,
)
from gelenk.robot.result import Result

Style: TypeAlias = Literal["short", "full"]

_SYMBOLS = {
    "sqrt": (r"\sqrt{{{}}}", "sqrt({})"),
    "lc": ("l_{{c{}}}", "lc{}"),
    "xc": ("x_{{c{}}}", "xc{}"),
    "yc": ("y_{{c{}}}", "yc{}"),
    "zc": ("z_{{c{}}}", "zc{}"),
    "gammax": (r"\gamma_{{x}}", "gammax"),
    "gammay": (r"\gamma_{{y}}", "gammay"),
    "gammaz": (r"\gamma_{{z}}", "gammaz"),
    "qd": (r"\dot{{q}}_{{{}}}", "qd{}"),
    "qdd": (r"\ddot{{q}}_{{{}}}", "qdd{}"),
}
"""Symbols by the names of their atoms; any other one is the last letter of the name with an index."""
_OF_ITS_OWN = frozenset({"pb", "pt", "rb", "rt", "sqrt", "g"})
"""Names of atoms whose indices are not those of rows."""


@dataclass(frozen=True, slots=True)
class Formula(Result):
    """A formula in both notations.

    Attributes:
        latex: For KaTeX or LaTeX with amsmath.
        plain: An expression of Python and of most computer algebra systems.
    """

    latex: str
    plain: str


@dataclass(frozen=True, slots=True)
class MatrixFormula(Result):
    """A matrix; null if an entry has too many terms to write out.

    Attributes:
        name: Such as `T_base_tool`.
        latex: The whole matrix, for KaTeX or for LaTeX with amsmath.
        plain: Entry by entry, row by row.
    """

    name: str
    latex: str | None
    plain: list[list[str]] | None


@dataclass(frozen=True, slots=True)
class Notation:
    """How formulas are written.

    Attributes:
        style: `short` writes c_{12}, `full` cos(q_1 + q_2).
        group: Returns the group of parallel axes of a joint angle.
        offset_angles: Indices of angles ϑ_i that consist of more than the variable q_i.
        numbers: Values to put in place of symbols; empty to keep the symbols.
        has_commas: Whether indices of a sum are separated: with ten joints c_{1,2} is not c_{12}.
        before: Number of joints before the table's first, added to its indices: 3 for the rows 4 to 6 of a wrist.
    """

    style: Style
    group: Group
    offset_angles: Collection[int] = ()
    numbers: Mapping[Atom, float] = field(default_factory=dict)
    has_commas: bool = False
    before: int = 0

    def text(self, polynomial: Polynomial) -> Formula:
        """Write a polynomial."""
        return self._product((), Fraction(1), self.numbered(polynomial))

    def bracketed(self, polynomial: Polynomial) -> Formula:
        """Write a polynomial as a factor of a product: a sum, or a term with a minus, stands in brackets."""
        text = self.text(polynomial)
        is_term = len(self.numbered(polynomial)) == 1 and not text.plain.startswith("-")
        return text if is_term else in_brackets(text)

    def matrix(self, name: str, rows: Sequence[Sequence[Polynomial]]) -> MatrixFormula:
        """Write a matrix of polynomials."""
        return matrix_of(name, rows, self.text)

    def vector(self, name: str, entries: Sequence[Polynomial]) -> MatrixFormula:
        """Write a column of polynomials."""
        return self.matrix(name, [[entry] for entry in entries])

    def factors(self, factor: Fraction, factors: Sequence[Polynomial]) -> Formula:
        """Write a product: the number and all factors of one term together, then the sums in brackets.

        Roots of numbers are combined here: in separate factors they would not meet.
        """
        counts = Counter(self.numbered(part) for part in factors)
        single, sums = number(factor), list[Formula]()
        for part, power in counts.items():
            if len(part) == 1:
                for _ in range(power):
                    single = single * part
            else:
                sums.append(in_brackets(self._product((), Fraction(1), part), power))
        single = _without_squared_roots(single)
        if not sums or not single:
            return self.text(single)
        if single == ONE and counts.total() == 1:
            return self._product((), Fraction(1), factors[0])
        if single.constant in {1, -1}:
            return times(sums, "" if single == ONE else "-")
        return times([self.text(single), *sums])

    def variables(self, indices: Sequence[int]) -> Formula:
        """Write a sum of the joints' variables themselves."""
        return replace(self, offset_angles=()).angle(indices)

    def atom(self, atom: Atom) -> Formula:
        """Write an atom by its symbol."""
        if atom.kind == TRIGONOMETRIC:
            return self._wave(atom)
        before = 0 if atom.name in _OF_ITS_OWN else self.before
        index = "".join(str(i + before) for i in atom.indices)
        if atom.name in {"ca", "sa"}:
            if self.style == "full":
                return function_of(atom.name, indexed(r"\alpha", "alpha", index))
            return Formula(rf"{atom.name[0]}_{{\alpha_{{{index}}}}}", f"{atom.name[0]}alpha{index}")
        if atom.name in _SYMBOLS:
            return Formula(*(form.format(index) for form in _SYMBOLS[atom.name]))
        letter = atom.name[-1]
        return indexed(letter, letter, "xyz"[atom.indices[0] - 1] if atom.name in {"pb", "pt"} else index)

    def angle(self, indices: Sequence[int]) -> Formula:
        """Write a sum of joint angles."""
        terms = []
        for index in sorted(set(indices), key=abs):
            count, sign, name = indices.count(index), "-" * (index < 0), self.angle_name(abs(index))
            multiple = ("", "") if count == 1 else (f"{count} ", f"{count}*")
            terms.append(Formula(sign + multiple[0] + name.latex, sign + multiple[1] + name.plain))
        return summed(terms)

    def angle_name(self, index: int) -> Formula:
        """Write q_i, or ϑ_i if the angle consists of more than the variable."""
        shown = index + self.before
        return indexed(r"\vartheta", "theta", shown) if index in self.offset_angles else indexed("q", "q", shown)

    def _wave(self, atom: Atom) -> Formula:
        if self.style == "full" or len(set(atom.indices)) < len(atom.indices):
            return function_of(atom.name, self.angle(atom.indices))
        comma, underscore = (",", "_") if self.has_commas else ("", "")
        indices = [str(index + (self.before if index > 0 else -self.before)) for index in atom.indices]
        plain = underscore.join(index.replace("-", "m") for index in indices)
        return Formula(f"{atom.name}_{{{comma.join(indices)}}}", f"{atom.name}{plain}")

    def numbered(self, polynomial: Polynomial) -> Polynomial:
        """Put values in place of symbols, if values are wanted."""
        if not self.numbers:
            return polynomial
        terms = []
        for monomial, factor in polynomial:
            rest = tuple(item for item in monomial if item[0] not in self.numbers)
            for atom, power in monomial:
                if atom in self.numbers:
                    factor *= Fraction(repr(self.numbers[atom])) ** power  # noqa: PLW2901
            terms.append((rest, factor))
        return collected(terms)

    def _product(self, before: Monomial, factor: Fraction, polynomial: Polynomial) -> Formula:
        if not polynomial:
            return Formula("0", "0")
        shared = shared_monomial(polynomial)
        content = Fraction(1) if self.numbers else shared_number(polynomial)
        if len(polynomial) == 1:
            (content,) = polynomial.terms.values()
        rest = quotient(polynomial, content, shared)
        factor, before = factor * content, monomial_product(before, shared)
        if len(rest) == 1:
            return self.monomial(factor, before)
        if not before and abs(factor) == 1:
            return self._sum(rest if factor > 0 else -rest)
        inner = self._sum(rest)
        if inner.plain.startswith("-"):
            factor, inner = -factor, self._sum(-rest)
        return times([self.monomial(factor, before), in_brackets(inner)])

    def _sum(self, polynomial: Polynomial) -> Formula:
        return summed([self._product(before, Fraction(1), part) for before, part in self._parts(polynomial)])

    def _parts(self, polynomial: Polynomial) -> list[tuple[Monomial, Polynomial]]:
        """Return the sines and cosines of the first group with their coefficients; constants come first."""
        waves = [atom for atom in polynomial.atoms if atom.kind == TRIGONOMETRIC]
        if not waves:
            return [((), Polynomial({monomial: factor})) for monomial, factor in sorted(polynomial)]
        first = min(self.group(abs(atom.indices[0])) for atom in waves)
        parts: dict[Monomial, dict[Monomial, Fraction]] = {}
        for monomial, factor in sorted(polynomial):
            inside = tuple(item for item in monomial if self._is_of(item[0], first))
            outside = tuple(item for item in monomial if not self._is_of(item[0], first))
            parts.setdefault(inside, {})[outside] = factor
        found = []
        for before, terms in parts.items():
            if before or any(atom.kind == TRIGONOMETRIC for monomial in terms for atom, _ in monomial):
                found.append(((1 if before else 2, before), before, Polynomial(terms)))
            else:
                found += [((0, rest), (), Polynomial({rest: factor})) for rest, factor in terms.items()]
        return [(before, part) for _, before, part in sorted(found, key=lambda item: item[0])]

    def _is_of(self, atom: Atom, group: int) -> bool:
        return atom.kind == TRIGONOMETRIC and self.group(abs(atom.indices[0])) == group

    def monomial(self, factor: Fraction, monomial: Monomial) -> Formula:
        """Write a number times powers of atoms."""
        return self.signed(factor, [_power(self.atom(atom), power) for atom, power in monomial])

    def signed(self, factor: Fraction, factors: Sequence[Formula]) -> Formula:
        """Write a number times formulas: exactly if lengths are symbols, else as a decimal."""
        size, pieces = abs(factor), list(factors)
        if size != 1 or not pieces:
            text = self._number(size)
            pieces.insert(0, Formula(text.latex, f"({text.plain})") if "/" in text.plain and factors else text)
        return times(pieces, "-" if factor < 0 else "")

    def _number(self, value: Fraction) -> Formula:
        if value.denominator == 1:
            return Formula(str(value), str(value))
        if not self.numbers:
            return Formula(rf"\frac{{{value.numerator}}}{{{value.denominator}}}", str(value))
        return decimal(float(value))


def matrix_of(name: str, rows: Sequence[Sequence[Polynomial]], write: Callable[[Polynomial], Formula]) -> MatrixFormula:
    """Write a matrix, entry by entry."""
    texts = [[write(entry) for entry in row] for row in rows]
    latex = bmatrix((text.latex for text in row) for row in texts)
    return MatrixFormula(name, latex, [[text.plain for text in row] for row in texts])


def times(formulas: Sequence[Formula], sign: str = "") -> Formula:
    """Write a product of formulas after a sign."""
    return Formula(sign + " ".join(f.latex for f in formulas), sign + "*".join(f.plain for f in formulas))


def summed(formulas: Iterable[Formula]) -> Formula:
    """Write a sum of formulas; zeros are left out, and a minus at the front of one becomes the sum's."""
    latex, plain = "", ""
    for text in formulas:
        if text.plain == "0":
            continue
        if not plain:
            latex, plain = text.latex, text.plain
        elif text.plain.startswith("-"):
            latex, plain = f"{latex} - {text.latex[1:].lstrip()}", f"{plain} - {text.plain[1:]}"
        else:
            latex, plain = f"{latex} + {text.latex}", f"{plain} + {text.plain}"
    return Formula(latex, plain) if plain else Formula("0", "0")


def in_brackets(text: Formula, power: int = 1) -> Formula:
    """Write a formula in brackets, to a power."""
    latex, plain = ("", "") if power == 1 else (f"^{{{power}}}", f"**{power}")
    return Formula(rf"\left({text.latex}\right){latex}", f"({text.plain}){plain}")


def indexed(latex: str, plain: str, index: int | str) -> Formula:
    """Write a letter with an index."""
    return Formula(f"{latex}_{{{index}}}", f"{plain}{index}")


def function_of(name: str, angle: Formula) -> Formula:
    """Write the cosine (name c…) or sine (s…) of an angle."""
    function = "cos" if name.startswith("c") else "sin"
    return Formula(rf"\{function}\left({angle.latex}\right)", f"{function}({angle.plain})")


def decimal(value: float) -> Formula:
    """Write the shortest decimal that is this double."""
    plain = repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    mantissa, _, exponent = plain.partition("e")
    return Formula(rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else plain, plain)


def multiple_of_pi(value: float) -> Formula | None:
    """Write a multiple of π/12 with π; return None if the value is no such multiple."""
    fraction = Fraction(round(value / math.pi * 12), 12)
    if abs(value - float(fraction) * math.pi) > 1e-12 * max(1.0, abs(value)):
        return None
    if not fraction:
        return Formula("0", "0")
    sign, top, bottom = "-" if fraction < 0 else "", abs(fraction.numerator), fraction.denominator
    latex, plain = (r"\pi", "pi") if top == 1 else (rf"{top} \pi", f"{top}*pi")
    if bottom == 1:
        return Formula(sign + latex, sign + plain)
    return Formula(rf"{sign}\frac{{{latex}}}{{{bottom}}}", f"{sign}{plain}/{bottom}")


def _without_squared_roots(polynomial: Polynomial) -> Polynomial:
    terms = []
    for monomial, factor in polynomial:
        rest: Monomial = ()
        for atom, power in monomial:
            is_root = atom.kind == ROOT
            factor *= Fraction(atom.indices[0]) ** (power // 2) if is_root else 1  # noqa: PLW2901
            left = power % 2 if is_root else power
            rest = monomial_product(rest, ((atom, left),) if left else ())
        terms.append((rest, factor))
    return collected(terms)


def _power(text: Formula, power: int) -> Formula:
    """Write a power with the exponent where it belongs: cos²(x), c_2², (cos α)²."""
    if power == 1:
        return text
    latex, exponent = text.latex, f"^{{{power}}}"
    for name in (r"\cos", r"\sin"):
        if latex.startswith(name):
            return Formula(f"{name}{exponent}{latex.removeprefix(name)}", f"{text.plain}**{power}")
    return Formula(latex + exponent, f"{text.plain}**{power}")
