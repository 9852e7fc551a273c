"""Rows of numbers, configurations and targets, from arguments, files and standard input."""

import csv
import json
import math
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import Any

from gelenk.errors import InvalidArray, InvalidField, counted

STDIN = "-"
ORIENTATIONS = {
    "quaternion_xyzw": ("qx", "qy", "qz", "qw"),
    "quaternion_wxyz": ("qw", "qx", "qy", "qz"),
    "rpy": ("roll", "pitch", "yaw"),
    "zyz": ("phi", "theta", "psi"),
    "rotation_vector": ("rx", "ry", "rz"),
}
"""Names of columns by notation of the orientation."""
PENDANTS = {
    "ur": ("x", "y", "z", "rx", "ry", "rz"),
    "kuka_abc": ("X", "Y", "Z", "A", "B", "C"),
    "abb": ("X", "Y", "Z", "q1", "q2", "q3", "q4"),
    "fanuc_wpr": ("X", "Y", "Z", "W", "P", "R"),
}
"""Names of columns by notation of a whole pose, as the pendants of controllers show it."""
AXES = ("x", "y", "z")
_ANSWERED = {"targets": "poses"}
"""By input field, the field of another command's answer that may stand for it."""
_UNIT = re.compile(r"(?s)(.*?)\s*(deg|°|rad)?")
_RADIANS = {"deg": math.pi / 180.0, "°": math.pi / 180.0}
_PI = re.compile(r"([+-]?)(?:(\d+(?:\.\d*)?)\s*\*?\s*)?pi(?:\s*/\s*(\d+(?:\.\d*)?))?")


@dataclass(frozen=True, slots=True)
class InputRows:
    """Rows as the user gave them: each with cells as text or numbers, or what JSON holds in place of a row.

    `source` names their source, for errors; `lines` are their line numbers in a text; the header holds the names of
    the columns, if the first row does.
    """

    source: str
    rows: Sequence[Any]
    lines: Sequence[int] = ()
    header: tuple[str, ...] = ()

    def configurations(self, joint_names: Callable[[], Sequence[str]]) -> list[Any]:
        """Return configurations in the order of a chain's joints; a header with their names sets the columns.

        `joint_names` is called only if there is a header. Raises InvalidArray if a cell is not a number, or the header
        names only some of the joints.
        """
        if not self.header:
            return self._numbers(None)
        names = joint_names()
        missing = [name for name in names if name not in self.header]
        if missing and len(missing) < len(names):
            raise InvalidArray(f"{self.source}: the header names joints of the chain, but not {', '.join(missing)}")
        return self._numbers(None if missing else [self.header.index(name) for name in names])

    def targets(self, *, position_suffices: bool) -> list[Any]:
        """Return poses in the API's form; a header that names a notation sets the columns."""
        pendant = next((notation for notation, columns in PENDANTS.items() if columns == self.header), None)
        if pendant is not None:
            return [{pendant: row} for row in self._numbers(None)]
        named = {columns: notation for notation, columns in ORIENTATIONS.items()}
        columns = [i for i, name in enumerate(self.header) if name in {*AXES, *(n for one in named for n in one)}]
        names = tuple(self.header[i] for i in columns)
        notation = named.get(names[3:]) if names[:3] == AXES else None
        rows = self._numbers(columns if notation else None)
        return [row if isinstance(row, dict) else target_of(row, position_suffices, notation) for row in rows]

    def _numbers(self, columns: Sequence[int] | None) -> list[Any]:
        if not self.rows:
            raise InvalidArray(f"{self.source}: there are no rows in it")
        if not self.lines:
            return list(self.rows)
        found = [self._row(row, line, columns) for row, line in zip(self.rows, self.lines, strict=True)]
        counts = sorted({len(row) for row in found})
        if len(counts) > 1:
            raise InvalidArray(f"{self.source}: all rows must have as many numbers; these have {counts}")
        return found

    def _row(self, cells: Sequence[str], line: int, columns: Sequence[int] | None) -> list[float]:
        where, text = f"{self.source}, line {line}", ",".join(cells)[:80]
        if self.header and len(cells) != len(self.header):
            raise InvalidArray(
                f"{where}: {text!r} has {counted(len(cells), 'cell')} where the header has {len(self.header)}"
            )
        try:
            numbers = [number(cells[i]) for i in (range(len(cells)) if columns is None else columns)]
        except ValueError:
            numbers = [math.nan]
        if not all(map(math.isfinite, numbers)):
            raise InvalidArray(f"{where}: {text!r} holds something that is not a finite number")
        return numbers


def rows_of(given: Sequence[str], file: str | None, field: str) -> InputRows:
    """Return rows of a field from arguments, or from a file or standard input (`-`): CSV, npy, or JSON.

    Arguments are rows of numbers separated by commas or blanks. Raises InvalidArray if the file cannot be read, and
    InvalidField if no rows are given, or both arguments and a file.
    """
    if given and file is not None:
        raise InvalidField(field, "give them as arguments or as a file, not both")
    if file == STDIN:
        return _rows(sys.stdin.buffer.read(), "standard input", field)
    if file is not None:
        return _rows(Path(file).read_bytes(), file, field)
    if not given:
        raise InvalidField(field, "none are given: as an argument, or in a file, `-` for standard input")
    cells = [text.replace(",", " ").split() for text in given]
    return InputRows("the arguments", cells, range(1, len(cells) + 1))


def numbers_of(text: str, field: str) -> list[float]:
    """Return one row of numbers from an argument; raises as `rows_of` does."""
    row: list[float] = rows_of([text], None, field).configurations(list)[0]
    return row


def target_of(row: Sequence[float], position_suffices: bool, notation: str | None = None) -> dict[str, Any]:
    """Return the pose that a row of numbers stands for; raises InvalidField if it has too few numbers, or too many."""
    position = list(row[:3])
    if notation is not None:
        return {"position": position, notation: list(row[3:])}
    match len(row):
        case 3 if position_suffices:
            return {"position": position, "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}
        case 6:
            return {"position": position, "rpy": list(row[3:])}
        case 7:
            return {"position": position, "quaternion_xyzw": list(row[3:])}
        case 16:
            return {"matrix": [list(row[4 * i : 4 * i + 4]) for i in range(4)]}
    raise InvalidField(
        "targets",
        f"a target has {counted(len(row), 'number')}; allowed: 6 (x y z roll pitch yaw), 7 (with a quaternion x y z "
        "w), 16 (a matrix by rows), and with --task 3",
    )


def number(text: str) -> float:
    """Parse a number, or a multiple of π such as `-pi/2` and `3*pi/4`; `30deg` is an angle, as is `0.5rad`.

    Raises ValueError if it is nothing of this.
    """
    value, unit = _UNIT.fullmatch(text.strip()).groups()  # type: ignore[union-attr]  # it matches any line
    found = _PI.fullmatch(value)
    if found is None:
        return float(value) * _RADIANS.get(unit, 1.0)
    sign, factor, divisor = found.groups()
    return (-1.0 if sign == "-" else 1.0) * float(factor or 1.0) * math.pi / float(divisor or 1.0)


def text_of(content: bytes, source: str) -> str:
    """Decode text in UTF-8, with or without a byte order mark; raises InvalidField if it is none."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InvalidField(source, "must be text in UTF-8") from None


def _rows(content: bytes, source: str, field: str) -> InputRows:
    if content.startswith(b"\x93NUMPY"):
        return InputRows(source, _of_npy(content, source))
    text = text_of(content, source)
    if text.lstrip().startswith(("[", "{")):
        return InputRows(source, _of_json(text, source, field))
    return _of_csv(text, source)


def _of_npy(content: bytes, source: str) -> list[list[float]]:
    import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

    try:
        array = np.load(BytesIO(content), allow_pickle=False)
    except (ValueError, EOFError, MemoryError) as error:
        raise InvalidArray(f"{source}: it cannot be read as npy: {error}") from None
    if array.dtype.kind not in "fiu" or array.ndim > 2:
        raise InvalidArray(
            f"{source}: it holds {array.dtype} of shape {array.shape}; allowed: real ones, shape (N, n) or (n,)"
        )
    rows = np.atleast_2d(np.asarray(array, dtype=float))
    wrong = ~np.isfinite(rows).all(axis=1)
    if wrong.any():
        raise InvalidArray(f"{source}, row {int(np.argmax(wrong))}: numbers must be finite")
    found: list[list[float]] = rows.tolist()
    return found


def _of_json(text: str, source: str, field: str) -> list[Any]:
    """Return rows of JSON in the API's form, alone or within a request or an answer; one row may stand alone."""
    try:
        content = json.loads(text, parse_constant=_refused)
    except ValueError as error:
        raise InvalidArray(f"{source}: it cannot be read as JSON: {error}") from None
    if isinstance(content, dict):
        names = [name for name in (field, _ANSWERED.get(field)) if isinstance(content.get(name), list)]
        if not names:
            raise InvalidArray(f"{source}: in the JSON object there is no list {field!r}")
        content = content[names[0]]
    return content if not content or isinstance(content[0], list | dict) else [content]


def _refused(constant: str) -> float:
    raise ValueError(f"{constant} is not finite")


def _of_csv(text: str, source: str) -> InputRows:
    """Split text into cells at commas, semicolons or blanks; lines that start with # are left out."""
    numbered = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    rows = [cells_of(line) for _, line in numbered]
    lines = [i for i, _ in numbered]
    if rows and not any(map(_is_number, rows[0])):
        return InputRows(source, rows[1:], lines[1:], tuple(rows[0]))
    return InputRows(source, rows, lines)


def cells_of(line: str) -> list[str]:
    """Split a line at commas, semicolons or blanks; it may end with a separator."""
    separator = next((mark for mark in ";," if mark in line), None)
    cells = line.split() if separator is None else next(csv.reader([line], delimiter=separator))
    found = [cell.strip() for cell in cells]
    return found[:-1] if found[-1:] == [""] else found


def _is_number(text: str) -> bool:
    try:
        number(text)
    except ValueError:
        return False
    return True
