"""A DH table in exact terms: angles that are multiples of π/2 as such, everything else as a symbol with a value."""

import math
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Literal, TypeAlias

from gelenk.dh.derive.algebra import (
    CONSTANT,
    LENGTH,
    ONE,
    ROOT,
    VARIABLE,
    ZERO,
    Angle,
    Atom,
    Group,
    Matrix,
    Polynomial,
    Vector,
    number,
    symbol,
)
from gelenk.language import translated as _

Numbers4: TypeAlias = tuple[tuple[float, ...], ...]

ANGLE_TOLERANCE = 1e-5
"""An angle this near to a multiple of π/2, π/4 or π/6 is read as that, [rad]: tables write 1.5708."""
LENGTH_TOLERANCE = 1e-9
"""A length this near to zero is read as zero, [m]."""
ROTATION_TOLERANCE = 1e-9
"""An entry of a base's or tool's rotation this near to 0, ±1/2, ±√2/2, ±√3/2 or ±1 is read as that."""

_HALF = number(Fraction(1, 2))
ROOTS = {Atom(ROOT, (n,), "sqrt"): math.sqrt(n) for n in (2, 3)}
"""Values of the roots that occur in exact numbers."""
_EXACT = (
    (0.0, ZERO),
    (0.5, _HALF),
    *((value / 2, symbol(root) * _HALF) for root, value in ROOTS.items()),
    (1.0, ONE),
)


IDENTITY: Matrix = ((ONE, ZERO, ZERO), (ZERO, ONE, ZERO), (ZERO, ZERO, ONE))


@dataclass(frozen=True, slots=True)
class RowNumbers:
    """A row of the table as given; lengths [m], angles [rad]."""

    name: str
    type: Literal["revolute", "prismatic"]
    a: float
    alpha: float
    d: float
    theta: float


@dataclass(frozen=True, slots=True)
class TableNumbers:
    """A table as given, fit to be sent to another process and to be a key."""

    convention: Literal["standard", "modified"]
    rows: tuple[RowNumbers, ...]
    base: Numbers4
    tool: Numbers4


@dataclass(frozen=True, slots=True)
class Twist:
    """A constant turn about x: its cosine and sine, and `quarters` if it is a multiple of π/2."""

    quarters: int | None
    cosine: Polynomial
    sine: Polynomial


@dataclass(frozen=True, slots=True)
class Row:
    """A row in exact terms; for a prismatic joint `d` contains the variable.

    Attributes:
        index: Number of the row, from 1.
        angle: ϑ_i; empty if a prismatic joint's angle is a multiple of π/2.
        quarters: Multiples of π/2 to add to it.
        offset: Constant part of ϑ_i besides the variable, [rad].
    """

    index: int
    is_revolute: bool
    a: Polynomial
    d: Polynomial
    twist: Twist
    angle: Angle
    quarters: int
    offset: float


@dataclass(frozen=True, slots=True)
class Transform:
    """A pose in symbols."""

    rotation: Matrix
    position: Vector

    @property
    def rows(self) -> list[Vector]:
        """Homogeneous matrix, (4, 4)."""
        upper = [(*row, p) for row, p in zip(self.rotation, self.position, strict=True)]
        return [*upper, (ZERO, ZERO, ZERO, ONE)]

    @property
    def largest(self) -> int:
        """Number of terms of the largest entry."""
        return max(len(entry) for row in self.rows for entry in row)

    @property
    def is_identity(self) -> bool:
        """Whether it changes nothing."""
        return self.rotation == IDENTITY and not any(self.position)


@dataclass(frozen=True, slots=True)
class Table:
    """The table in exact terms, with T_base_0 and T_n_tool.

    Attributes:
        values: Value of each symbol, [m], or the cosine or sine of an angle.
        groups: The group of parallel axes of each row's angle, by index.
        remarks: Notes on numbers that were read as something else.
        as_read: The numbers that the exact terms stand for.
    """

    is_standard: bool
    rows: tuple[Row, ...]
    base: Transform
    tool: Transform
    values: dict[Atom, float]
    groups: dict[int, int]
    remarks: tuple[str, ...]
    as_read: TableNumbers

    @property
    def group(self) -> Group:
        """The group of parallel axes of a joint angle's index."""
        return self.groups.__getitem__

    def axis_frame(self, index: int) -> int:
        """Return the frame whose z is the axis of joint `index` (from 1)."""
        return index - 1 if self.is_standard else index

    def atom_values(self, q: tuple[float, ...], atoms: set[Atom]) -> dict[Atom, float]:
        """Return the values of atoms at a configuration, [rad or m]."""
        angles = {row.index: q[row.index - 1] * row.is_revolute + row.offset for row in self.rows}
        result = dict(self.values)
        for atom in atoms - result.keys():
            if atom.kind == VARIABLE:
                result[atom] = q[atom.indices[0] - 1]
            elif atom.kind == ROOT:
                result[atom] = ROOTS[atom]
            else:
                angle = sum(angles[abs(index)] * (1 if index > 0 else -1) for index in atom.indices)
                result[atom] = math.cos(angle) if atom.name == "c" else math.sin(angle)
        return result


@dataclass(slots=True)
class _TableReader:
    values: dict[Atom, float] = field(default_factory=dict)
    remarks: list[str] = field(default_factory=list)

    def length(self, name: str, index: int, value: float, row: int) -> tuple[Polynomial, float]:
        if abs(value) <= LENGTH_TOLERANCE:
            if value:
                text = _("row {row}: {name} = {value:.3g} m is read as 0")
                self.remarks.append(text.format(row=row, name=name, value=value))
            return ZERO, 0.0
        return self.symbol(Atom(LENGTH, (index,), name), value), value

    def twist(self, index: int, value: float, row: int) -> tuple[Twist, float]:
        for divisor in (2, 4, 6):
            steps = round(value / (math.pi / divisor))
            exact = steps * math.pi / divisor
            if abs(value - exact) <= ANGLE_TOLERANCE:
                self._say_angle("alpha", value, exact, row)
                cosine, sine = exact_number(math.cos(exact)), exact_number(math.sin(exact))
                assert cosine is not None  # noqa: S101 - multiples of π/2, π/4, π/6 are all in the list
                assert sine is not None  # noqa: S101
                return Twist(steps % 4 if divisor == 2 else None, cosine, sine), exact
        cosine = self.symbol(Atom(CONSTANT, (index,), "ca"), math.cos(value))
        return Twist(None, cosine, self.symbol(Atom(CONSTANT, (index,), "sa"), math.sin(value))), value

    def angle(self, is_revolute: bool, index: int, value: float) -> tuple[Angle, int, float, float]:
        """Return ϑ_i, its multiples of π/2, its constant part, and the number that θ_i was read as."""
        steps = round(value / (math.pi / 2))
        exact = steps * math.pi / 2
        if abs(value - exact) > ANGLE_TOLERANCE:
            return (index,), 0, value, value
        self._say_angle("theta", value, exact, index)
        return ((index,) if is_revolute else ()), steps % 4, 0.0, exact

    def pose(self, name: str, place: Numbers4) -> tuple[Transform, Numbers4]:
        rotation: list[Vector] = []
        position: list[Polynomial] = []
        numbers: list[tuple[float, ...]] = []
        for i, (*row, p) in enumerate(place[:3], start=1):
            exact = [self._entry(Atom(CONSTANT, (i, j), f"r{name}"), value) for j, value in enumerate(row, start=1)]
            rotation.append(tuple(entry for entry, _ in exact))
            is_zero = abs(p) <= LENGTH_TOLERANCE
            position.append(ZERO if is_zero else self.symbol(Atom(LENGTH, (i,), f"p{name}"), p))
            numbers.append((*(number for _, number in exact), 0.0 if is_zero else p))
        return Transform(tuple(rotation), tuple(position)), (*numbers, (0.0, 0.0, 0.0, 1.0))

    def _entry(self, atom: Atom, value: float) -> tuple[Polynomial, float]:
        """Return an entry of a rotation, and the number that it was read as."""
        exact = exact_number(value)
        return (self.symbol(atom, value), value) if exact is None else (exact, exact.value(ROOTS))

    def symbol(self, atom: Atom, value: float) -> Polynomial:
        self.values[atom] = value
        return symbol(atom)

    def _say_angle(self, name: str, value: float, exact: float, row: int) -> None:
        if abs(value - exact) > 1e-12:
            text = _("row {row}: {name} = {value!r} rad is read as {exact!r}, {away:.2g} rad away")
            self.remarks.append(text.format(row=row, name=name, value=value, exact=exact, away=abs(value - exact)))


def exact_number(value: float) -> Polynomial | None:
    """Return 0, ±1/2, ±√2/2, ±√3/2 or ±1 if the value is one of them up to rounding, else None."""
    for magnitude, polynomial in _EXACT:
        if abs(abs(value) - magnitude) <= ROTATION_TOLERANCE:
            return polynomial if value >= 0 else -polynomial
    return None


def read_table(numbers: TableNumbers) -> Table:
    """Return the table in exact terms.

    Lengths that are zero vanish; equal lengths in different rows stay different symbols. In a modified table a and α
    carry the index of the link before the joint, as Craig writes them.
    """
    reader, standard = _TableReader(), numbers.convention == "standard"
    rows, read = [], []
    for index, row in enumerate(numbers.rows, start=1):
        link = index if standard else index - 1
        a, a_read = reader.length("a", link, row.a, index)
        d, d_read = reader.length("d", index, row.d, index)
        twist, alpha_read = reader.twist(link, row.alpha, index)
        is_revolute = row.type == "revolute"
        angle, quarters, offset, theta_read = reader.angle(is_revolute, index, row.theta)
        if not is_revolute:
            d = d + symbol(Atom(VARIABLE, (index,), "q"))
        rows.append(Row(index, is_revolute, a, d, twist, angle, quarters, offset))
        read.append(replace(row, a=a_read, alpha=alpha_read, d=d_read, theta=theta_read))
    base, base_read = reader.pose("b", numbers.base)
    tool, tool_read = reader.pose("t", numbers.tool)
    as_read = TableNumbers(numbers.convention, tuple(read), base_read, tool_read)
    groups = _groups(rows, standard)
    return Table(standard, tuple(rows), base, tool, reader.values, groups, tuple(reader.remarks), as_read)


def _groups(rows: list[Row], standard: bool) -> dict[int, int]:
    """Return the group of each row; a row whose axis is parallel to the one before shares its group."""
    groups, group = {}, 0
    for before, row in zip([None, *rows], rows, strict=False):
        twist = before.twist if standard and before else None if standard else row.twist
        if before is not None and (twist is None or twist.quarters not in {0, 2}):
            group += 1
        groups[row.index] = group
    return groups
