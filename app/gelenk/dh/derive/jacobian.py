"""The geometric Jacobian in symbols, and the square block of it that has a determinant.

The column of a revolute joint is z × p_EE over z, that of a prismatic one z over 0; z is its axis, and p_EE leads from
its frame to the tip.

The determinant of a block does not depend on the axes in which it is written, nor, if the block holds the whole
motion, on the point whose velocity is meant. So the frame and the point are chosen that make the block triangular with
the smallest parts: it is then the product of small determinants. With a spherical wrist that point is where its axes
meet (decoupling), with three parallel axes the frame is one of theirs.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from random import Random
from typing import Any, Literal, NamedTuple, TypeAlias

from gelenk.dh.derive.algebra import (
    ONE,
    ZERO,
    Polynomial,
    TooManyTerms,
    Vector,
    column,
    cross,
    derivative,
    minus,
    reduced,
    reduced_vector,
    total,
)
from gelenk.dh.derive.table import Table, Transform
from gelenk.dh.derive.transforms import composed, frames_from

Kind: TypeAlias = Literal["full", "moving", "linear", "angular"]
Pattern: TypeAlias = list[list[bool]]
Grid: TypeAlias = list[list[Polynomial]]

ROW_NAMES = ("v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z")
LARGEST_PART = 4
"""Maximum number of rows of a part with few zeros whose determinant is computed in symbols."""
MAX_RELATIVE_TERMS = 200
MAX_MINOR_TERMS = 400
"""Maximum number of terms of a minor: beyond that the determinant would not be short."""
_NOUGHT = 1e-9
_SAMPLES = 3


class Column(NamedTuple):
    """A column of the geometric Jacobian, in the axes of the base: z, p_EE (None if prismatic), and the two parts."""

    axis: Vector
    arm: Vector | None
    linear: Vector
    angular: Vector


@dataclass(frozen=True, slots=True)
class Block:
    """The square block that has a determinant: the whole Jacobian, the rows that ever move, the linear or angular rows.

    Its rows are indices 0 to 5; the frame in whose axes they are written only matters without whole triples of rows.
    """

    kind: Kind
    rows: tuple[int, ...]
    frame: int


@dataclass(frozen=True, slots=True)
class DiagonalBlock:
    """A square part on the diagonal of a block triangular matrix."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Setting:
    """How a determinant is computed: axes, point (None: the tip), parts, and the sign of their order."""

    frame: int
    point: int | None
    parts: tuple[DiagonalBlock, ...]
    sign: int


def columns(table: Table, frames: Sequence[Transform], tip: Vector) -> list[Column]:
    """Return the columns in the axes of frame 0, from the frames T_0_0 … T_0_n and the tip's position in frame 0.

    The linear part of a revolute joint is ∂p/∂ϑ, the vector product as a textbook simplifies it: that the two are the
    same function is checked here, term by term. Raises TooManyTerms if the check has too many.
    """
    found = []
    for row in table.rows:
        frame = frames[table.axis_frame(row.index)]
        axis = column(frame.rotation, 2)
        if not row.is_revolute:
            found.append(Column(axis, None, axis, (ZERO, ZERO, ZERO)))
            continue
        arm = minus(tip, frame.position)
        linear = tuple(derivative(entry, row.index) for entry in tip)
        for simplified, entry in zip(linear, cross(axis, arm), strict=True):
            if reduced(simplified - entry, table.group):
                raise ArithmeticError(f"column {row.index}: z × p is not ∂p/∂q")
        found.append(Column(axis, arm, linear, axis))
    return found


class ZeroPattern:
    """Finds entries of the Jacobian that vanish for every configuration, in any frame and for any point.

    It checks a few configurations and lengths drawn at random: an entry that vanishes at all of them vanishes always.
    """

    def __init__(self, table: Table, frames: Sequence[Transform], tip: Vector) -> None:
        self._table = table
        self._samples = [_sampled(table, frames, tip, Random(seed)) for seed in range(_SAMPLES)]  # noqa: S311

    @property
    def frames(self) -> range:
        """Numbers of all frames."""
        return range(len(self._table.rows) + 1)

    def pattern(self, frame: int, point: int | None) -> Pattern:
        """Return which entries differ from zero; (6, n)."""
        matrices = [self.matrix(sample, frame, point) for sample in range(_SAMPLES)]
        return [[any(abs(m[i][j]) > _NOUGHT for m in matrices) for j in range(len(matrices[0][0]))] for i in range(6)]

    def matrix(self, sample: int, frame: int, point: int | None) -> list[list[float]]:
        """Return the Jacobian at a sample, in the axes of a frame, for a point (None: the tip); (6, n)."""
        rotations, positions = self._samples[sample]
        target = positions[-1] if point is None else positions[point]
        result: list[list[float]] = [[] for _ in range(6)]
        for row in self._table.rows:
            k = self._table.axis_frame(row.index)
            z = [rotations[k][i][2] for i in range(3)]
            r = [target[i] - positions[k][i] for i in range(3)]
            v = [z[1] * r[2] - z[2] * r[1], z[2] * r[0] - z[0] * r[2], z[0] * r[1] - z[1] * r[0]]
            twist = (v, z) if row.is_revolute else (z, [0.0, 0.0, 0.0])
            for half, vector in enumerate(twist):
                for i in range(3):
                    result[3 * half + i].append(sum(rotations[frame][j][i] * vector[j] for j in range(3)))
        return result

    def is_regular(self, rows: Sequence[int], frame: int) -> bool:
        """Check whether the block of these rows is regular at a sample."""
        for sample in range(_SAMPLES):
            matrix = self.matrix(sample, frame, None)
            if abs(_expanded(matrix, rows, range(len(rows)), 1.0, math.fsum)) > _NOUGHT:
                return True
        return False


def _sampled(
    table: Table, frames: Sequence[Transform], tip: Vector, random: Random
) -> tuple[list[list[list[float]]], list[list[float]]]:
    """Return rotations and positions of all frames, the tip's position last; lengths and angles are random."""
    atoms = {atom for frame in frames for row in frame.rows for entry in row for atom in entry.atoms}
    atoms |= {atom for entry in tip for atom in entry.atoms}
    q = tuple(random.uniform(-3.0, 3.0) for _ in table.rows)
    values = table.atom_values(q, atoms)
    for atom in table.values:
        if atom.name in {"a", "d", "pt"}:
            values[atom] = random.uniform(0.5, 1.5)
    rotations = [[[entry.value(values) for entry in row] for row in frame.rotation] for frame in frames]
    positions = [[entry.value(values) for entry in frame.position] for frame in frames]
    return rotations, [*positions, [entry.value(values) for entry in tip]]


def square_block(table: Table, structure: ZeroPattern) -> Block | None:
    """Return the block whose determinant shows the singular configurations; None if no block is square.

    With six joints it is the whole Jacobian; else the rows that ever differ from zero, if they are as many as the
    joints (a planar arm with its orientation, a SCARA); else the linear ones of these, else the angular ones. A block
    that is singular everywhere is skipped if another one is left.
    """
    n = len(table.rows)
    if n == 6:
        return Block("full", tuple(range(6)), 0)
    kinds: tuple[tuple[Kind, range], ...] = (("moving", range(6)), ("linear", range(3)), ("angular", range(3, 6)))
    patterns = [structure.pattern(frame, None) for frame in ((0,) if table.is_standard else (0, 1))]
    blocks = [
        Block(kind, tuple(i for i in rows if any(pattern[i])), frame)
        for kind, rows in kinds
        for frame, pattern in enumerate(patterns)
    ]
    candidates = [block for block in blocks if len(block.rows) == n]
    regular = [block for block in candidates if structure.is_regular(block.rows, block.frame)]
    return next(iter(regular or candidates), None)


def best_setting(structure: ZeroPattern, block: Block, size: int) -> Setting | None:
    """Return the axes and the point that give the smallest parts; None if a part must vanish identically."""
    is_free = block.kind in {"full", "linear", "angular"} and len(block.rows) in {3, 6}
    frames = structure.frames if is_free else (block.frame,)
    points: Sequence[int | None] = (None, *structure.frames) if block.kind in {"full", "moving"} else (None,)
    best: tuple[tuple[int, ...], Setting] | None = None
    for frame in frames:
        for point in points:
            pattern = structure.pattern(frame, point)
            parts = triangular_parts(pattern, block.rows, tuple(range(size)))
            if parts is None:
                return None
            entries = sum(pattern[i][j] for part in parts for i in part.rows for j in part.columns)
            largest = max(len(part.rows) for part in parts)
            cost = (largest, sum(len(part.rows) ** 3 for part in parts), entries, abs(2 * frame - size), point or 0)
            if best is None or cost < best[0]:
                rows = [block.rows.index(i) for part in parts for i in part.rows]
                sign = parity(rows) * parity([j for part in parts for j in part.columns])
                best = (cost, Setting(frame, point, tuple(parts), sign))
    return best[1] if best else None


def triangular_parts(pattern: Pattern, rows: tuple[int, ...], cols: tuple[int, ...]) -> list[DiagonalBlock] | None:
    """Return the parts on the diagonal of the finest block triangular order; None if the determinant must vanish.

    A set of columns that differ from zero in as many rows as it has columns is split off with these rows.
    """
    for count in range(1, len(cols)):
        for chosen in combinations(cols, count):
            touched = tuple(i for i in rows if any(pattern[i][j] for j in chosen))
            if len(touched) < count:
                return None
            if len(touched) == count:
                rest = triangular_parts(
                    pattern, tuple(i for i in rows if i not in touched), tuple(j for j in cols if j not in chosen)
                )
                return None if rest is None else [DiagonalBlock(touched, chosen), *rest]
    if any(not any(pattern[i][j] for j in cols) for i in rows):
        return None
    return [DiagonalBlock(rows, cols)]


def parity(order: Sequence[int]) -> int:
    """Return the sign of a permutation."""
    inversions = sum(x > y for x, y in combinations(order, 2))
    return -1 if inversions % 2 else 1


def relative_jacobian(table: Table, setting: Setting) -> Grid:
    """Return the Jacobian in the axes and for the point of a setting, (6, n); raises TooManyTerms."""
    found = frames_from(table, setting.frame, MAX_RELATIVE_TERMS)
    frames = [frame for frame in found if frame is not None]
    if len(frames) < len(found):
        raise TooManyTerms
    target = composed(frames[-1], table.tool, table.group) if setting.point is None else frames[setting.point]
    result: Grid = [[] for _ in range(6)]
    for row in table.rows:
        frame = frames[table.axis_frame(row.index)]
        axis = column(frame.rotation, 2)
        if row.is_revolute:
            linear = reduced_vector(cross(axis, minus(target.position, frame.position)), table.group)
            twist = (*linear, *axis)
        else:
            twist = (*axis, ZERO, ZERO, ZERO)
        for i, entry in enumerate(twist):
            result[i].append(entry)
    return result


def determinant(matrix: Grid, part: DiagonalBlock, table: Table) -> Polynomial:
    """Return the determinant of a part, reduced, by expansion along its columns; raises TooManyTerms."""
    if len(part.rows) > LARGEST_PART:
        raise TooManyTerms

    def minor(terms: Sequence[Polynomial]) -> Polynomial:
        found = reduced(total(terms), table.group)
        if len(found) > MAX_MINOR_TERMS:
            raise TooManyTerms
        return found

    whole: Polynomial = _expanded(matrix, part.rows, part.columns, ONE, minor)
    return whole


def _expanded(
    matrix: Sequence[Sequence[Any]],
    rows: Sequence[int],
    columns: Sequence[int],
    one: Any,
    added: Callable[[Sequence[Any]], Any],
) -> Any:
    """Return the determinant of some rows and columns, expanded along the columns; `added` adds up a minor's terms."""
    minors: dict[tuple[int, ...], Any] = {(): one}
    for count, j in enumerate(columns, start=1):
        grown = {}
        for chosen in combinations(rows, count):
            terms = []
            for place, i in enumerate(chosen):
                minor = minors[chosen[:place] + chosen[place + 1 :]]
                if matrix[i][j] and minor:
                    term = matrix[i][j] * minor
                    terms.append(term if (place + count - 1) % 2 == 0 else -term)
            grown[chosen] = added(terms)
        minors = grown
    return minors[tuple(rows)]
