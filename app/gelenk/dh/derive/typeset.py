"""Polynomials and matrices as LaTeX and as plain text.

A sum is written factor by factor in the order of the axes: what all terms share stands before a bracket, then the
terms are collected by the sines and cosines of the first group of parallel axes, and within each bracket by those of
the next one: c_1 (a_2 c_2 + a_3 c_23). The plain text is valid in Python and in most computer algebra systems.
"""

import math
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal, NamedTuple, TypeAlias

from gelenk.dh.derive.algebra import (
    LENGTH,
    ONE,
    ROOT,
    TRIGONOMETRIC,
    VARIABLE,
    Atom,
    Group,
    Monomial,
    Polynomial,
    collected,
    monomial_product,
    number,
)

Style: TypeAlias = Literal["short", "full"]

_MOVING = {
    "m": ("m_{{{}}}", "m{}"),
    "I": ("I_{{{}}}", "I{}"),
    "g": ("g_{{{}}}", "g{}"),
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
"""Symbols of the equations of motion, by the names of their atoms."""


class Text(NamedTuple):
    """A formula in both notations."""

    latex: str
    plain: str


class MatrixText(NamedTuple):
    """A matrix: one formula in LaTeX, its entries in plain text."""

    latex: str
    plain: list[list[str]]


@dataclass(frozen=True, slots=True)
class Notation:
    """How formulas are written.

    Attributes:
        style: `short` writes c_{12}, `full` cos(q_1 + q_2).
        group: Returns the group of parallel axes of a joint angle.
        offset_angles: Indices of angles ϑ_i that consist of more than the variable q_i.
        numbers: Values to put in place of symbols; empty to keep the symbols.
        has_commas: Whether indices of a sum are separated: with ten joints c_{1,2} is not c_{12}.
    """

    style: Style
    group: Group
    offset_angles: Collection[int] = ()
    numbers: Mapping[Atom, float] = field(default_factory=dict)
    has_commas: bool = False

    def text(self, polynomial: Polynomial) -> Text:
        """Write a polynomial."""
        return self._product((), Fraction(1), self.numbered(polynomial))

    def bracketed(self, polynomial: Polynomial) -> Text:
        """Write a polynomial as a factor of a product: a sum, or a term with a minus, stands in brackets."""
        polynomial = self.numbered(polynomial)
        text = self._product((), Fraction(1), polynomial)
        if len(polynomial) == 1 and not text.plain.startswith("-"):
            return text
        return Text(rf"\left({text.latex}\right)", f"({text.plain})")

    def matrix(self, rows: Sequence[Sequence[Polynomial]]) -> MatrixText:
        """Write a matrix of polynomials."""
        texts = [[self.text(entry) for entry in row] for row in rows]
        body = r" \\ ".join(" & ".join(text.latex for text in row) for row in texts)
        return MatrixText(rf"\begin{{bmatrix}} {body} \end{{bmatrix}}", [[text.plain for text in row] for row in texts])

    def vector(self, entries: Sequence[Polynomial]) -> MatrixText:
        """Write a column of polynomials."""
        return self.matrix([[entry] for entry in entries])

    def factors(self, factor: Fraction, factors: Sequence[Polynomial]) -> Text:
        """Write a product: the number and all factors of one term together, then the sums in brackets.

        Roots of numbers are combined here: in separate factors they would not meet.
        """
        counts = Counter(self.numbered(part) for part in factors)
        single, sums = number(factor), list[Text]()
        for part, power in counts.items():
            if len(part) == 1:
                for _ in range(power):
                    single = single * part
                continue
            text = self._product((), Fraction(1), part)
            exponent = Text("" if power == 1 else f"^{{{power}}}", "" if power == 1 else f"**{power}")
            sums.append(Text(rf"\left({text.latex}\right){exponent.latex}", f"({text.plain}){exponent.plain}"))
        single = _without_squared_roots(single)
        if not sums or not single:
            return self.text(single)
        if len(sums) == 1 and single == ONE and counts.total() == 1:
            return self._product((), Fraction(1), factors[0])
        first = self.text(single)
        if single.constant in {1, -1}:
            first = Text(*(text.removesuffix("1") for text in first))
            return Text(first.latex + " ".join(t.latex for t in sums), first.plain + "*".join(t.plain for t in sums))
        return Text(
            " ".join((first.latex, *(t.latex for t in sums))), "*".join((first.plain, *(t.plain for t in sums)))
        )

    def variables(self, indices: Sequence[int]) -> Text:
        """Write a sum of the joints' variables themselves."""
        return replace(self, offset_angles=()).angle(indices)

    def atom(self, atom: Atom) -> Text:
        """Write an atom by its symbol."""
        index = ",".join(str(i) for i in atom.indices)
        if atom.kind == TRIGONOMETRIC:
            return self._wave(atom)
        if atom.kind == ROOT:
            return Text(rf"\sqrt{{{index}}}", f"sqrt({index})")
        if atom.kind == VARIABLE:
            return Text(f"q_{{{index}}}", f"q{index}")
        if atom.name in {"ca", "sa"}:
            return self._constant(atom, index)
        if atom.name in _MOVING:
            return Text(*(form.format(index) for form in _MOVING[atom.name]))
        letter = atom.name[-1]
        if atom.kind == LENGTH and len(atom.name) == 1:
            return Text(f"{letter}_{{{index}}}", f"{letter}{index}")
        subscript = "xyz"[atom.indices[0] - 1] if atom.kind == LENGTH else "".join(str(i) for i in atom.indices)
        return Text(f"{letter}_{{{subscript}}}", f"{letter}{subscript}")

    def angle(self, indices: Sequence[int]) -> Text:
        """Write a sum of joint angles."""
        latex, plain = "", ""
        for index in sorted(set(indices), key=abs):
            count, sign = indices.count(index), "-" if index < 0 else "+"
            name = self.angle_name(abs(index))
            times = Text("" if count == 1 else f"{count} ", "" if count == 1 else f"{count}*")
            latex += (f" {sign} " if latex else sign.strip("+")) + times.latex + name.latex
            plain += (f" {sign} " if plain else sign.strip("+")) + times.plain + name.plain
        return Text(latex, plain)

    def angle_name(self, index: int) -> Text:
        """Write q_i, or ϑ_i if the angle consists of more than the variable."""
        if index in self.offset_angles:
            return Text(rf"\vartheta_{{{index}}}", f"theta{index}")
        return Text(f"q_{{{index}}}", f"q{index}")

    def _constant(self, atom: Atom, index: str) -> Text:
        if self.style == "full":
            name = {"c": "cos", "s": "sin"}[atom.name[0]]
            return Text(rf"\{name}\left(\alpha_{{{index}}}\right)", f"{name}(alpha{index})")
        return Text(rf"{atom.name[0]}_{{\alpha_{{{index}}}}}", f"{atom.name[0]}alpha{index}")

    def _wave(self, atom: Atom) -> Text:
        repeated = len(set(atom.indices)) < len(atom.indices)
        if self.style == "full" or repeated:
            name, angle = {"c": "cos", "s": "sin"}[atom.name], self.angle(atom.indices)
            return Text(rf"\{name}\left({angle.latex}\right)", f"{name}({angle.plain})")
        separators = (",", "_") if self.has_commas else ("", "")
        latex = separators[0].join(str(index) for index in atom.indices)
        plain = separators[1].join(str(index).replace("-", "m") for index in atom.indices)
        return Text(f"{atom.name}_{{{latex}}}", f"{atom.name}{plain}")

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

    def _product(self, before: Monomial, factor: Fraction, polynomial: Polynomial) -> Text:
        """Write the product of a monomial, a number and a polynomial."""
        if not polynomial:
            return Text("0", "0")
        content, shared, rest = _taken_out(polynomial, exact=not self.numbers)
        factor, before = factor * content, monomial_product(before, shared)
        if len(rest) == 1:
            return self.monomial(factor, before)
        if not before and abs(factor) == 1:
            return self._sum(rest if factor > 0 else -rest)
        inner = self._sum(rest)
        if inner.plain.startswith("-"):
            factor, inner = -factor, self._sum(-rest)
        text = self.monomial(factor, before)
        return Text(rf"{text.latex} \left({inner.latex}\right)", f"{text.plain}*({inner.plain})")

    def _sum(self, polynomial: Polynomial) -> Text:
        """Write a sum, collected by the first group of parallel axes that occurs."""
        latex, plain = "", ""
        for before, part in self._parts(polynomial):
            text = self._product(before, Fraction(1), part)
            if latex and text.plain.startswith("-"):
                latex, plain = f"{latex} - {text.latex[1:].lstrip()}", f"{plain} - {text.plain[1:]}"
            elif latex:
                latex, plain = f"{latex} + {text.latex}", f"{plain} + {text.plain}"
            else:
                latex, plain = text
        return Text(latex, plain)

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
            if before or _has_waves(terms):
                found.append(((1 if before else 2, before), before, Polynomial(terms)))
            else:
                found += [((0, rest), (), Polynomial({rest: factor})) for rest, factor in terms.items()]
        return [(before, part) for _, before, part in sorted(found, key=lambda item: item[0])]

    def _is_of(self, atom: Atom, group: int) -> bool:
        return atom.kind == TRIGONOMETRIC and self.group(abs(atom.indices[0])) == group

    def monomial(self, factor: Fraction, monomial: Monomial) -> Text:
        """Write a number times powers of atoms."""
        sign, size = "-" if factor < 0 else "", abs(factor)
        powers = [(self.atom(atom), power) for atom, power in monomial]
        latex = [text.latex if power == 1 else _power(text.latex, power) for text, power in powers]
        plain = [text.plain if power == 1 else f"{text.plain}**{power}" for text, power in powers]
        if size != 1 or not powers:
            written = self.number(size)
            latex.insert(0, written.latex)
            plain.insert(0, written.plain if "/" not in written.plain or not powers else f"({written.plain})")
        return Text(sign + " ".join(latex), sign + "*".join(plain))

    def number(self, value: Fraction) -> Text:
        """Write a number: exactly if lengths are symbols, as a decimal if their values stand in the formula."""
        if value.denominator == 1:
            return Text(str(value), str(value))
        if not self.numbers:
            sign, size = "-" if value < 0 else "", abs(value)
            return Text(rf"{sign}\frac{{{size.numerator}}}{{{size.denominator}}}", str(value))
        return decimal(float(value))


def decimal(value: float) -> Text:
    """Write the shortest decimal that is this double."""
    plain = repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    mantissa, _, exponent = plain.partition("e")
    return Text(rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else plain, plain)


def _without_squared_roots(polynomial: Polynomial) -> Polynomial:
    """Apply √n² = n."""
    terms = []
    for monomial, factor in polynomial:
        kept: Monomial = ()
        for atom, power in monomial:
            is_root = atom.kind == ROOT
            factor *= Fraction(atom.indices[0]) ** (power // 2) if is_root else 1  # noqa: PLW2901
            left = power % 2 if is_root else power
            kept = monomial_product(kept, ((atom, left),) if left else ())
        terms.append((kept, factor))
    return collected(terms)


def multiple_of_pi(value: float) -> Text | None:
    """Write a multiple of π/12 with π; return None if the value is no such multiple."""
    fraction = Fraction(round(value / math.pi * 12), 12)
    if abs(value - float(fraction) * math.pi) > 1e-12 * max(1.0, abs(value)):
        return None
    if not fraction:
        return Text("0", "0")
    sign, top, bottom = "-" if fraction < 0 else "", abs(fraction.numerator), fraction.denominator
    times = Text("" if top == 1 else f"{top} ", "" if top == 1 else f"{top}*")
    if bottom == 1:
        return Text(rf"{sign}{times.latex}\pi", f"{sign}{times.plain}pi")
    return Text(rf"{sign}\frac{{{times.latex}\pi}}{{{bottom}}}", f"{sign}{times.plain}pi/{bottom}")


def joined(first: Text, second: Text) -> Text:
    """Write a sum of two; zero is left out, and a minus of the second becomes the sum's."""
    if first.plain == "0" or second.plain == "0":
        return first if second.plain == "0" else second
    if second.plain.startswith("-"):
        return Text(f"{first.latex} - {second.latex[1:]}", f"{first.plain} - {second.plain[1:]}")
    return Text(f"{first.latex} + {second.latex}", f"{first.plain} + {second.plain}")


def _has_waves(terms: Mapping[Monomial, Fraction]) -> bool:
    return any(atom.kind == TRIGONOMETRIC for monomial in terms for atom, _ in monomial)


def _power(latex: str, power: int) -> str:
    """Write a power with the exponent where it belongs: cos²(x), c_2², (cos α)²."""
    for name in (r"\cos", r"\sin"):
        if latex.startswith(name):
            return f"{name}^{{{power}}}{latex.removeprefix(name)}"
    return f"{latex}^{{{power}}}"


def _taken_out(polynomial: Polynomial, *, exact: bool) -> tuple[Fraction, Monomial, Polynomial]:
    """Return the number and the monomial that all terms share, and the rest."""
    shared: dict[Atom, int] | None = None
    for monomial in polynomial.terms:
        powers = dict(monomial)
        shared = (
            powers
            if shared is None
            else {atom: min(power, powers[atom]) for atom, power in shared.items() if atom in powers}
        )
    common = tuple(sorted((shared or {}).items()))
    content = shared_number(polynomial) if exact or len(polynomial) == 1 else Fraction(1)
    if len(polynomial) == 1:
        content = next(iter(polynomial.terms.values()))
    rest = {monomial_quotient(monomial, common): factor / content for monomial, factor in polynomial}
    return content, common, Polynomial(rest)


def shared_number(polynomial: Polynomial) -> Fraction:
    """Return the positive number that all coefficients share."""
    factors = list(polynomial.terms.values())
    top = math.gcd(*(factor.numerator for factor in factors))
    return Fraction(top, math.lcm(*(factor.denominator for factor in factors)))


def monomial_quotient(monomial: Monomial, divisor: Monomial) -> Monomial:
    """Return the quotient of two monomials; the first must be divisible by the second."""
    powers = dict(monomial)
    for atom, power in divisor:
        powers[atom] -= power
    return tuple((atom, power) for atom, power in powers.items() if power)
