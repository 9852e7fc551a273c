"""Robots, tables and configurations, from arguments, files and standard input."""

import csv
import json
import math
import re
import sys
import tomllib
import uuid
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from io import BytesIO, StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from app.cli.xacro import expanded
from app.model.errors import InvalidArray, InvalidDhTable, InvalidField

if TYPE_CHECKING:
    from app.client import Client
    from app.model.arrays import Array

STDIN = "-"
_TABLES = {".json", ".toml", ".csv"}
_DESCRIPTIONS = {".urdf", ".xacro", ".xml"}
_NUMBERS = {"a", "alpha", "d", "theta", "lower", "upper", "velocity", "effort"}
_PI = re.compile(r"([+-]?)(?:(\d+(?:\.\d*)?)\s*\*?\s*)?pi(?:\s*/\s*(\d+(?:\.\d*)?))?")
_CONVENTION = re.compile(r"#\s*convention\s*[:=]\s*(standard|modified)\s*")


@contextmanager
def robot_named(
    client: "Client", argument: str, arguments: Mapping[str, str], packages: Mapping[str, Path]
) -> Iterator[str]:
    """The name of a robot at the service: its own, or one that a file goes by until this is over.

    Args:
        client: Of the service.
        argument: A name, or a file: URDF, xacro, a zip of one URDF and its meshes, a table as JSON, TOML or CSV.
        arguments: For xacro.
        packages: For xacro.
    """
    file = Path(argument)
    if not is_file(file):
        yield argument
        return
    name = f"{name_of(file)[:40]}-{uuid.uuid4().hex[:8]}"
    if file.suffix == ".zip":
        client.add_archive(name, file)
    else:
        client.add_robot(name=name, **description_from(file, arguments, packages))
    try:
        yield name
    finally:
        client.remove_robot(name)


def name_of(file: Path) -> str:
    """A robot's name by that of its file."""
    stem = file.name.partition(".")[0]
    return re.sub(r"[^A-Za-z0-9_-]", "_", stem).lstrip("_-")[:64] or "robot"


def description_from(file: Path, arguments: Mapping[str, str], packages: Mapping[str, Path]) -> dict[str, Any]:
    """What the API takes of a robot without meshes: `dh` or `urdf`; for the arguments see `robot_named`."""
    if file.suffix in _TABLES:
        return {"dh": table_from(file)}
    return {"urdf": urdf_from(file, arguments, packages)}


def is_file(path: Path) -> bool:
    """Whether an argument means a file: it looks like one that a robot can be in."""
    return path.suffix in {*_TABLES, *_DESCRIPTIONS, ".zip"} and path.is_file()


def urdf_from(file: Path, arguments: Mapping[str, str], packages: Mapping[str, Path]) -> str:
    """A description as URDF."""
    if file.suffix == ".xacro":
        return expanded(file, arguments, packages)
    return file.read_text(encoding="utf-8")


def table_from(file: Path) -> Any:
    """A Denavit-Hartenberg table: JSON and TOML with the fields of the API, CSV with a column for each.

    Raises:
        InvalidDhTable: The file is not one.
    """
    text = file.read_text(encoding="utf-8")
    try:
        match file.suffix:
            case ".toml":
                return tomllib.loads(text)
            case ".csv":
                return _table_of_rows(text)
            case _:
                content = json.loads(text)
                return content.get("dh", content) if isinstance(content, dict) else content
    except (tomllib.TOMLDecodeError, json.JSONDecodeError) as error:
        raise InvalidDhTable(f"{file.name} cannot be read: {error}") from error


def _table_of_rows(text: str) -> dict[str, Any]:
    """A table of CSV; a line `# convention: modified` says what it is, else it is a standard one."""
    lines = text.splitlines()
    conventions = [found[1] for line in lines if (found := _CONVENTION.fullmatch(line))]
    rows = csv.DictReader(line for line in lines if line.strip() and not line.startswith("#"))
    joints = []
    for number, row in enumerate(rows):
        cells = {str(name).strip(): (text or "").strip() for name, text in row.items()}
        joints.append({name: _cell(number, name, text) for name, text in cells.items() if text})
    return {"convention": conventions[0] if conventions else "standard", "joints": joints}


def _cell(joint: int, name: str, text: str) -> float | str:
    if name not in _NUMBERS:
        return text
    try:
        return number(text)
    except ValueError:
        raise InvalidDhTable(f"{text!r} is not a number, and not one such as -pi/2", joint, name) from None


def number(text: str) -> float:
    """A number, or a multiple of π such as `-pi/2` and `3*pi/4`.

    Raises:
        ValueError: It is neither.
    """
    found = _PI.fullmatch(text.strip())
    if found is None:
        return float(text)
    sign, factor, divisor = found.groups()
    return (-1.0 if sign == "-" else 1.0) * float(factor or 1.0) * math.pi / float(divisor or 1.0)


def fields_of(text: str | None) -> dict[str, Any]:
    """Fields of the API from JSON, from a file with it, or from standard input; nothing where nothing is given.

    Raises:
        InvalidField: It is not a JSON object.
    """
    if text is None:
        return {}
    if text == STDIN:
        text = sys.stdin.buffer.read().decode()
    elif not text.lstrip().startswith("{"):
        text = Path(text).read_text(encoding="utf-8")
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise InvalidField("fields", f"is not JSON: {error}") from None
    if not isinstance(content, dict):
        raise InvalidField("fields", "must be a JSON object")
    return content


def rows_of(given: list[str], file: str | None, field: str) -> "Array":
    """Rows of numbers from arguments, or from a file or standard input: CSV, npy, or JSON.

    Args:
        given: Each a row: numbers between commas or blanks.
        file: Path, or `-`.
        field: What they are, for errors.

    Raises:
        InvalidArray: There are none, or they are no numbers.
    """
    if given and file is not None:
        raise InvalidField(field, "give them as arguments or as a file, not both")
    if file is not None:
        return _rows(_content(file), file)
    if not given:
        raise InvalidField(field, "none are given: as an argument, or in a file, `-` for standard input")
    return _same_length([_numbers(text, f"argument {i + 1}") for i, text in enumerate(given)], field)


def _content(file: str) -> bytes:
    if file == STDIN:
        return sys.stdin.buffer.read()
    return Path(file).read_bytes()


def _rows(content: bytes, file: str) -> "Array":
    import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

    if content.startswith(b"\x93NUMPY"):
        array = np.load(BytesIO(content), allow_pickle=False)
        return np.atleast_2d(np.asarray(array, dtype=float))
    if content.lstrip().startswith(b"["):
        return np.atleast_2d(np.asarray(json.loads(content), dtype=float))
    lines = [row for row in csv.reader(StringIO(content.decode())) if any(cell.strip() for cell in row)]
    if lines and not _is_number(lines[0][0].split()[0] if lines[0][0].split() else ""):
        lines = lines[1:]  # names of columns
    return _same_length([_numbers(",".join(row), f"line {i + 1}") for i, row in enumerate(lines)], file)


def _is_number(text: str) -> bool:
    try:
        number(text)
    except ValueError:
        return False
    return True


def _numbers(text: str, where: str) -> list[float]:
    words = text.replace(",", " ").split()
    try:
        return [number(word) for word in words]
    except ValueError:
        raise InvalidArray(f"{where}: {text.strip()[:80]!r} holds something that is not a number") from None


def _same_length(rows: list[list[float]], what: str) -> "Array":
    import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

    if not rows or len({len(row) for row in rows}) > 1:
        counts = sorted({len(row) for row in rows})
        raise InvalidArray(f"{what}: all rows must have as many numbers; these have {counts or 'none'}")
    return np.array(rows)


def pairs_of(given: list[str], field: str, value: Callable[[str], Any] = str) -> dict[str, Any]:
    """`NAME=VALUE` arguments.

    Raises:
        InvalidField: One is not.
    """
    found = {}
    for text in given:
        name, equals, rest = text.partition("=")
        if not (name and equals):
            raise InvalidField(field, f"{text!r} is not NAME=VALUE")
        found[name] = value(rest)
    return found
