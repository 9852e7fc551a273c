"""A Denavit-Hartenberg table as an answer: right if it gives the right pose at every configuration.

So x axes may point the other way, origins may slide along parallel axes, and angles may differ by whole turns; frame 0
and the last frame are given, and so are the senses of the joints.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from gelenk.exercises.answer_field import AnswerField, FieldKind, Unreadable
from gelenk.exercises.fields import number
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import Convention, DhJoint, DhTable

COLUMNS = ("a", "alpha", "d", "theta")


def table_of(rows: Array, slides: Sequence[bool], convention: Convention = "standard") -> DhTable:
    """Return rows of a, α, d, ϑ, shape (n, 4), as a table; `slides` says which joints are prismatic."""
    joints = []
    for i, (row, slide) in enumerate(zip(rows, slides, strict=True), start=1):
        a, alpha, d, theta = map(float, row)
        joints.append(DhJoint(f"joint_{i}", "prismatic" if slide else "revolute", a, alpha, d, theta))
    return DhTable(convention, tuple(joints))


@dataclass(frozen=True, slots=True, kw_only=True)
class DhTableField(AnswerField):
    """A standard table; each row an object or a list of a, α, d, ϑ, with ϑ or d at the joint's zero.

    The tolerance is one of poses: of each entry of the rotation, and of the position in metres.
    """

    kind: ClassVar[FieldKind] = "dh_table"
    slides: tuple[bool, ...]

    def shape(self) -> tuple[int, ...]:
        """Return the numbers of rows and columns."""
        return len(self.slides), len(COLUMNS)

    def read(self, given: Any) -> Any:
        """Return the rows, shape (n, 4)."""
        rows = given.get("joints") if isinstance(given, Mapping) else given
        if not isinstance(rows, Sequence) or isinstance(rows, str) or len(rows) != len(self.slides):
            raise self._unreadable()
        return np.array([self._row(row) for row in rows])

    def _row(self, row: Any) -> list[float]:
        if isinstance(row, Mapping) and row.keys() >= set(COLUMNS):
            return [number(row[column]) for column in COLUMNS]
        if isinstance(row, Mapping | str) or not isinstance(row, Sequence) or len(row) != len(COLUMNS):
            raise self._unreadable()
        return [number(one) for one in row]

    def _unreadable(self) -> Unreadable:
        shape = _("{rows} rows of {columns} numbers: a, α, d, ϑ").format(rows=len(self.slides), columns=len(COLUMNS))
        return Unreadable("wrong_shape", shape=shape)

    def distance(self, answer: Any, reference: Any) -> float:
        """Return the largest difference of the poses at fixed, irregular configurations."""
        return float(np.abs(self._poses(answer) - self._poses(reference)).max()) / self.tolerance

    def _poses(self, rows: Any) -> Array:
        rows, slides = np.asarray(rows, float), np.array(self.slides)
        count = len(slides)
        positions = np.sin(1.7 * np.arange(2 * count + 1)[:, None] + 2.3 * np.arange(count) + 1.0)
        moved = np.repeat(rows[None], len(positions), axis=0)
        moved[:, slides, 2] += positions[:, slides]
        moved[:, ~slides, 3] += 3.0 * positions[:, ~slides]
        return _products(moved)

    def slips(self, right: Any) -> Iterator[tuple[str, Any]]:
        """Yield the table with the usual mistakes."""
        rows = np.asarray(right, float)
        yield "alpha_sign", rows * [1.0, -1.0, 1.0, 1.0]
        yield "a_and_d_exchanged", rows[:, [2, 1, 0, 3]]
        yield "angles_exchanged", rows[:, [0, 3, 2, 1]]
        yield "offset_forgotten", rows * [1.0, 1.0, 1.0, 0.0]
        yield "craig_for_standard", np.column_stack([np.vstack([np.zeros(2), rows[:-1, :2]]), rows[:, 2:]])
        yield "degrees_for_radians", rows * [1.0, 180.0 / math.pi, 1.0, 180.0 / math.pi]
        yield "thousand_too_large", rows * [1e3, 1.0, 1e3, 1.0]
        yield "reversed", rows[::-1]


def _products(rows: Array) -> Array:
    """Return the products of standard transforms; rows of shape (K, n, 4), products of shape (K, 4, 4)."""
    a, alpha, d, theta = np.moveaxis(rows, -1, 0)
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    zero, one = np.zeros_like(a), np.ones_like(a)
    entries = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [zero, sa, ca, d], [zero, zero, zero, one]]
    As = np.moveaxis(np.array(entries), (0, 1), (-2, -1))
    T = As[:, 0]
    for i in range(1, As.shape[1]):
        T = T @ As[:, i]
    return T
