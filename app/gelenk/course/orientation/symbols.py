r"""Products of elementary rotations in symbols: entries such as c_1 s_2 of R_z(\vartheta_1) R_y(\vartheta_2)."""

from functools import lru_cache
from typing import TypeAlias

from gelenk.course.steps import bmatrix

_Term: TypeAlias = tuple[int, tuple[str, ...]]
"""A sign, and the factors of a product."""
_Entry: TypeAlias = list[_Term]
_Matrix: TypeAlias = list[list[_Entry]]


@lru_cache(maxsize=64)
def product(turns: tuple[tuple[str, str], ...]) -> str:
    r"""Return the matrix of rotations about coordinate axes, given as (axis, LaTeX of the angle), as a `bmatrix`."""
    rows: _Matrix = [[[(1, ())] if i == j else [] for j in range(3)] for i in range(3)]
    for axis, angle in turns:
        rows = _times(rows, _elementary(axis, angle))
    return bmatrix(map(_written, row) for row in rows)


def _elementary(axis: str, angle: str) -> _Matrix:
    """Return Rx, Ry or Rz; the minus sign stands above, but for y below."""
    k = "xyz".index(axis)
    i, j = (k + 1) % 3, (k + 2) % 3
    rows: _Matrix = [[[] for _ in range(3)] for _ in range(3)]
    rows[k][k] = [(1, ())]
    rows[i][i] = rows[j][j] = [(1, (f"c_{{{angle}}}",))]
    rows[j][i], rows[i][j] = [(1, (f"s_{{{angle}}}",))], [(-1, (f"s_{{{angle}}}",))]
    return rows


def _times(left: _Matrix, right: _Matrix) -> _Matrix:
    return [
        [
            [(s * t, p + q) for k in range(3) for s, p in left[i][k] for t, q in right[k][j]]
            for j in range(3)
        ]
        for i in range(3)
    ]  # fmt: skip


def _written(entry: _Entry) -> str:
    text = ""
    for sign, factors in entry:
        joined = " ".join(factors) or "1"
        text += f" {'-' if sign < 0 else '+'} {joined}" if text else f"{'-' if sign < 0 else ''}{joined}"
    return text or "0"
