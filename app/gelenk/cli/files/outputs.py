"""Answers as tables for people, and as JSON, CSV and npy for programs."""

import csv
import errno
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from io import BytesIO, StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from gelenk.errors import InvalidField

if TYPE_CHECKING:
    from pydantic import BaseModel
    from rich.console import Console
    from rich.table import Table

    from gelenk.robot.arrays import Array

_SHOWN = 40
"""Maximum number of rows of a table for people."""
_DIGITS = 6
_WIDEST = 10_000


class Format(StrEnum):
    """Format in which an answer is written."""

    TABLE = "table"
    JSON = "json"
    CSV = "csv"
    NPY = "npy"


@dataclass(frozen=True, slots=True)
class AnswerRows:
    """An answer as rows.

    Attributes:
        notes: Sentences about all rows, for people.
        comments: Lines before the rows in CSV, for programs that read it again.
        array: Numbers in another shape than the rows, for npy.
    """

    columns: Sequence[str]
    rows: Sequence[Sequence[Any]]
    notes: Sequence[str] = ()
    comments: Sequence[str] = ()
    array: Sequence[Any] | None = None


@dataclass(frozen=True, slots=True)
class Output:
    """Where answers are written, by default standard output; in `form`, by default the file's suffix or a table.

    If quiet, a table has no notes.
    """

    form: Format | None = None
    file: Path | None = None
    is_quiet: bool = False

    @property
    def format(self) -> Format:
        """The format in use."""
        if self.form is not None:
            return self.form
        suffix = "" if self.file is None else self.file.suffix.removeprefix(".").lower()
        return Format(suffix) if suffix in set(Format) - {Format.TABLE} else Format.TABLE

    def write(self, content: Callable[[], str], rows: AnswerRows) -> None:
        """Write an answer: `content` returns it as JSON, as the API gives it, and `rows` holds the same."""
        match self.format:
            case Format.JSON:
                self.put(content().encode() + b"\n")
            case Format.CSV:
                self.put(_csv(rows))
            case Format.NPY:
                self.save(_numbers(rows))
            case _:
                self._show(rows)

    def tell(self, answer: "BaseModel") -> None:
        """Write an answer that has no rows: as JSON, unless another format is requested."""
        content = answer.model_dump(mode="json", exclude_unset=True)
        rows = AnswerRows(("field", "value"), list(content.items()))
        form = Format.JSON if self.format is Format.TABLE else self.format
        Output(self.form or form, self.file).write(lambda: answer.model_dump_json(exclude_unset=True), rows)

    def save(self, array: "Array") -> None:
        """Write an array as npy."""
        import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

        if self.file is None and sys.stdout.isatty():
            raise InvalidField("format", "npy is binary: write it to a file with --output, or a pipe")
        stream = BytesIO()
        np.save(stream, array, allow_pickle=False)
        self.put(stream.getvalue())

    def put(self, content: bytes) -> None:
        """Write bytes unchanged."""
        if self.file is not None:
            self.file.write_bytes(content)
            return
        try:
            sys.stdout.buffer.write(content)
            sys.stdout.buffer.flush()
        except BrokenPipeError:
            # The reader has closed the pipe: the rest is discarded, and the exit code stays the same.
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())

    def _show(self, rows: AnswerRows) -> None:
        from rich.console import Console  # noqa: PLC0415 - --help need not wait for it
        from rich.table import Table  # noqa: PLC0415

        table = Table(*map(_word, rows.columns), box=None, header_style="bold", pad_edge=False)
        for row in rows.rows[:_SHOWN]:
            table.add_row(*(_word(cell) for cell in row))
        left = len(rows.rows) - _SHOWN
        said = () if self.is_quiet else rows.notes
        notes = [*said, *([f"and {left} more rows: ask for --format csv or json"] if left > 0 else [])]
        console = Console() if self.file is None else Console(file=StringIO(), width=200)
        # Not by the console itself: on a closed pipe it exits with 1, "the answer is no".
        with console.capture() as shown:
            _write(console, table, notes)
        self.put(shown.get().encode())


def largest(certificate: Any) -> str:
    """Return the largest differences of a certificate of poses in words."""
    return f"{certificate.max_position_error:.1e} m and {certificate.max_orientation_error:.1e} rad at most"


def check_place(file: Path) -> None:
    """Raise OSError if a file cannot be written at this place: before the work, not after it."""
    wrong = errno.EISDIR if file.is_dir() else errno.ENOENT if not file.parent.is_dir() else 0
    if wrong:
        raise OSError(wrong, os.strerror(wrong), str(file))


_ENDINGS = ("", ".txt", *(f".{form}" for form in Format if form is not Format.TABLE))
"""Of files that hold an answer; the first two, a table."""
_OWN_ENDINGS: dict[str, tuple[str, ...]] = {"dh": (".urdf", ".xml"), "robots": (".urdf", ".xml")}
"""Of files that some commands write beside."""
_OF_ANY_ENDING = frozenset({"sheet", "ask"})
"""Commands that say themselves what they write, or that write what comes."""


def check_ending(file: Path, command: str) -> None:
    """Raise InvalidField if a command writes no file that ends like this, unless its format is named."""
    allowed = (*_ENDINGS, *_OWN_ENDINGS.get(command, ()))
    if command not in _OF_ANY_ENDING and file.suffix.lower() not in allowed:
        reason = f"{file.name!r} must end in one of {', '.join(allowed[1:])}; or name the format with --format"
        raise InvalidField("output", reason)


def picture_kind(file: Path) -> Literal["svg", "png", "pdf"]:
    """Return the kind of picture that a file's suffix asks for; raises OSError as `check_place` does."""
    check_place(file)
    match file.suffix.lower():
        case ".svg":
            return "svg"
        case ".png":
            return "png"
        case ".pdf":
            return "pdf"
    raise InvalidField("plot", f"{file.name!r} must end in .svg, .png or .pdf")


def _write(console: "Console", table: "Table", notes: Sequence[str]) -> None:
    # Truncated numbers would be wrong: a table keeps its width, and the terminal wraps what does not fit.
    whole = console.measure(table, options=console.options.update(width=_WIDEST)).maximum
    console.width = max(console.width, whole)
    console.print(table)
    for note in notes:
        console.print(note, style="dim", markup=False, highlight=False, soft_wrap=True)


def _word(cell: Any) -> str:
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, float):
        return f"{cell:.{_DIGITS}g}" if cell and abs(cell) < 1e-4 else f"{cell:.{_DIGITS}f}"
    # No markup: a robot's name may hold brackets.
    return ("" if cell is None else str(cell)).replace("[", r"\[")


def _csv(rows: AnswerRows) -> bytes:
    text = StringIO()
    text.writelines(f"# {comment}\n" for comment in rows.comments)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(rows.columns)
    writer.writerows(rows.rows)
    return text.getvalue().encode()


def _numbers(rows: AnswerRows) -> "Array":
    import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

    if rows.array is not None:
        return np.array(rows.array, dtype=float)
    numbers = [i for i in range(len(rows.columns)) if all(isinstance(row[i], float | int) for row in rows.rows)]
    if len(numbers) < len(rows.columns):
        words = ", ".join(name for i, name in enumerate(rows.columns) if i not in numbers)
        raise InvalidField("format", f"npy holds numbers alone, and these columns hold others: {words}")
    return np.array(rows.rows, dtype=float)
