"""Fields of an answer: what a student gives, when it is the same as the right one, and what slips look like."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

import numpy as np

from gelenk.exercises.answer_field import AnswerField, FieldKind, Unreadable
from gelenk.exercises.mistakes.catalogue import Mistake, mistake
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

TURNS = {"rad": 2.0 * math.pi, "°": 360.0}
_MOST_DIGITS = 40
_SHARE = 0.01
"""Usual tolerance of a quantity, as a share of it."""
_ANGLE = {"rad": 0.005, "°": 0.5}
"""Usual tolerances of angles."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberArray(AnswerField):
    """Numbers in a fixed shape; `is_angle` says that whole turns do not count."""

    is_angle: bool = False

    def read(self, given: Any) -> Any:
        """Return a number, or an array."""
        found = _numbers(given, self.shape())
        return float(found) if found.ndim == 0 else found

    def distance(self, answer: Any, reference: Any) -> float:
        """Compare the numbers; the farthest counts."""
        apart = np.asarray(answer, float) - np.asarray(reference, float)
        if self.is_angle:
            turn = TURNS[self.unit]
            apart = apart - turn * np.round(apart / turn)
        return _in_tolerances(apart, self.allowed(reference))

    def allowed(self, reference: Any) -> float:
        """Return how far a number may be from the right one, where this is the right answer."""
        return self.tolerance * float(np.max(np.abs(reference))) if self.is_relative else self.tolerance

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield what a wrong sign, factor or unit makes of the answer."""
        if self.tolerance == 0.0:
            return
        right = np.asarray(right, float)
        factors = {"sign": -1.0, "twice": 2.0, "half": 0.5, **_OF_UNIT.get(self.unit, {})}
        if self.unit and not self.is_angle:
            factors |= {"thousand_too_large": 1e3, "thousand_too_small": 1e-3}
        yield from ((code, right * factor) for code, factor in factors.items())


_OF_UNIT: dict[str, dict[str, float]] = {
    "rad": {"degrees_for_radians": 180.0 / math.pi, "turns_for_radians": 0.5 / math.pi},
    "°": {"radians_for_degrees": math.pi / 180.0},
    "rad/s": {
        "degrees_for_radians": 180.0 / math.pi,
        "turns_for_radians": 0.5 / math.pi,
        "turns_per_minute": 30.0 / math.pi,
    },
}


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberField(NumberArray):
    """A number; a tolerance of 0 makes it a whole one."""

    kind: ClassVar[FieldKind] = "number"

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield what general mistakes make of the number, a forgotten root among them."""
        yield from NumberArray.slips(self, right)
        if self.tolerance and not self.is_angle:
            yield "square", np.square(right)
            if not self.unit and abs(right) <= 1.0:
                yield "percent", 100.0 * right


def whole(name: str, label: str, points: float = 1.0) -> NumberField:
    """Return the field of a whole number."""
    return NumberField(name=name, label=label, points=points)


def quantity(name: str, label: str, unit: str = "", points: float = 1.0, *, within: float | None = None) -> NumberField:
    """Return the field of a quantity, to one per cent or, where it may be near zero, `within` an absolute tolerance."""
    return NumberField(name=name, label=label, unit=unit, points=points, **_tolerance(within))


def angle(name: str, label: str, points: float = 1.0, *, unit: Literal["rad", "°"] = "rad") -> NumberField:
    """Return the field of an angle, to 0.005 rad or half a degree; whole turns do not count."""
    return NumberField(name=name, label=label, unit=unit, tolerance=_ANGLE[unit], is_angle=True, points=points)


def _tolerance(within: float | None) -> dict[str, Any]:
    return {"tolerance": _SHARE, "is_relative": True} if within is None else {"tolerance": within}


@dataclass(frozen=True, slots=True, kw_only=True)
class VectorField(NumberArray):
    """A vector of `size` numbers."""

    kind: ClassVar[FieldKind] = "vector"
    size: int

    def shape(self) -> tuple[int, ...]:
        """Return the number of entries."""
        return (self.size,)

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield what general mistakes make of the vector, its entries in the opposite order among them."""
        yield from NumberArray.slips(self, right)
        yield "reversed", np.asarray(right)[::-1]


@dataclass(frozen=True, slots=True, kw_only=True)
class MatrixField(NumberArray):
    """A matrix of `rows` and `columns`."""

    kind: ClassVar[FieldKind] = "matrix"
    rows: int
    columns: int

    def shape(self) -> tuple[int, ...]:
        """Return the numbers of rows and columns."""
        return self.rows, self.columns

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield what general mistakes make of the matrix, its transpose among them."""
        yield from NumberArray.slips(self, right)
        if self.rows == self.columns:
            yield "transposed", np.asarray(right).T


def vector(
    name: str, label: str, size: int, unit: str = "", points: float = 1.0, *, within: float | None = None
) -> VectorField:
    """Return the field of a vector, to one per cent of its largest entry, or `within` an absolute tolerance."""
    return VectorField(name=name, label=label, size=size, unit=unit, points=points, **_tolerance(within))


def angles(name: str, label: str, size: int, points: float = 1.0) -> VectorField:
    """Return the field of several angles in radians."""
    return VectorField(
        name=name, label=label, size=size, unit="rad", tolerance=_ANGLE["rad"], is_angle=True, points=points
    )


def matrix(
    name: str,
    label: str,
    shape: tuple[int, int],
    unit: str = "",
    points: float = 1.0,
    *,
    within: float | None = None,
) -> MatrixField:
    """Return the field of a matrix, to one per cent of its largest entry, or `within` an absolute tolerance."""
    rows, columns = shape
    return MatrixField(
        name=name, label=label, rows=rows, columns=columns, unit=unit, points=points, **_tolerance(within)
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class BasisField(MatrixField):
    """A basis of a space of `rows` dimensions, its vectors as columns: any basis of the same space is right.

    The tolerance is one of the projector on the space.
    """

    kind: ClassVar[FieldKind] = "basis"

    def distance(self, answer: Any, reference: Any) -> float:
        """Compare the projectors on both spaces."""
        return _in_tolerances(_projector(answer) - _projector(reference), self.tolerance)

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:  # noqa: ARG002
        """Yield nothing: sign, length and order of a basis are free."""
        yield from ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ChoiceField(AnswerField):
    """One of several words; `options` has what each means, for people."""

    kind: ClassVar[FieldKind] = "choice"
    options: Mapping[str, str] = field(default_factory=dict)

    def choices(self) -> Mapping[str, str]:
        """Return the words to choose from."""
        return self.options

    def read(self, given: Any) -> Any:
        """Return the word; what it means counts as well."""
        words = {text: word for word, text in self.options.items()} | {word: word for word in self.options}
        if not isinstance(given, str) or given.strip() not in words:
            raise Unreadable("not_a_choice", choices=", ".join(self.options))
        return words[given.strip()]

    def distance(self, answer: Any, reference: Any) -> float:
        """Compare the words."""
        return 0.0 if answer == reference else math.inf


@dataclass(frozen=True, slots=True, kw_only=True)
class SetField(AnswerField):
    """A set of solutions, each of them a number or a vector as `item` says; their order does not count."""

    kind: ClassVar[FieldKind] = "set"
    item: VectorField | NumberField

    def shape(self) -> tuple[int, ...]:
        """Return the shape of one solution."""
        return self.item.shape()

    def read(self, given: Any) -> Any:
        """Return the solutions, each of them once."""
        if not isinstance(given, Sequence) or isinstance(given, str):
            raise Unreadable("wrong_shape", shape=_("a list of solutions"))
        return self._distinct(map(self.item.read, given))

    def _distinct(self, solutions: Iterable[Any]) -> list[Any]:
        found: list[Any] = []
        for one in solutions:
            if all(self.item.distance(one, other) > 1.0 for other in found):
                found.append(one)
        return found

    def distance(self, answer: Any, reference: Any) -> float:
        """Return the largest distance of a solution from its partner; infinite if there are more or fewer of them."""
        left, reference, worst = self._distinct(answer), self._distinct(reference), 0.0
        if len(left) != len(reference):
            return math.inf
        for one in reference:
            apart = [self.item.distance(other, one) for other in left]
            nearest = int(np.argmin(apart))
            worst = max(worst, apart[nearest])
            left.pop(nearest)
        return worst

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield what general mistakes make of every solution."""
        found = [dict(self.item.slips(one)) for one in right]
        yield from ((code, [one[code] for one in found]) for code in found[0])

    def share(self, answer: Any, right: Any) -> float:
        """Return the share of the solutions that are there, less the wrong ones."""
        found = sum(any(self.item.distance(one, other) <= 1.0 for one in answer) for other in right)
        return max(0.0, (2 * found - len(answer)) / len(right)) if len(answer) > found else found / len(right)

    def incomplete(self, answer: Any, right: Any) -> Mistake | None:
        """Return the mistake of solutions that are missing, or too many, if what is there is right otherwise."""
        is_right = [any(self.item.distance(one, other) <= 1.0 for other in right) for one in answer]
        missing = len(right) - sum(is_right)
        if missing == 0:
            return mistake("solutions_too_many")
        return mistake("solutions_missing", missing=missing, count=len(right)) if answer and all(is_right) else None


def solution_set(item: VectorField | NumberField, points: float = 1.0) -> SetField:
    """Return the field of a set of solutions, each of them as `item` says."""
    return SetField(name=item.name, label=item.label, unit=item.unit, item=item, points=points)


def basis(name: str, label: str, shape: tuple[int, int], points: float = 1.0) -> BasisField:
    """Return the field of a basis, with a tolerance of two per cent in the projector."""
    return BasisField(name=name, label=label, rows=shape[0], columns=shape[1], tolerance=2.0 * _SHARE, points=points)


def _in_tolerances(apart: Array, allowed: float) -> float:
    largest = float(np.max(np.abs(apart)))
    if allowed == 0.0:
        return 0.0 if largest == 0.0 else math.inf
    return largest / allowed


def _projector(basis: Array) -> Array:
    u, sigma, _ = np.linalg.svd(np.asarray(basis, float), full_matrices=False)
    u = u[:, sigma > 1e-9 * max(sigma.max(initial=0.0), 1e-300)]
    return np.asarray(u @ u.T)


def _numbers(given: Any, shape: tuple[int, ...]) -> Array:
    """Return numbers of a shape; raises Unreadable."""
    if not shape:
        return np.array(number(given))
    if isinstance(given, str | Mapping) or not isinstance(given, Sequence) or len(given) != shape[0]:
        told = _("{size} numbers").format(size=shape[0])
        if len(shape) > 1:
            told = _("{rows} rows of {columns} numbers").format(rows=shape[0], columns=shape[1])
        raise Unreadable("wrong_shape", shape=told)
    return np.array([_numbers(one, shape[1:]) for one in given])


def number(given: Any) -> float:
    """Return a number, also one that is written with a decimal comma; raises Unreadable."""
    if isinstance(given, str):
        given = given.strip().replace(",", ".").replace("−", "-")[:_MOST_DIGITS]
    try:
        found = math.nan if isinstance(given, bool) else float(given)
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found):
        raise Unreadable("not_a_number")
    return found
