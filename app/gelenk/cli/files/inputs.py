"""Robots, tables and fields, from arguments, files and standard input."""

import errno
import json
import os
import re
import sys
import tomllib
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gelenk.cli.files.rows import STDIN, cells_of, number, text_of
from gelenk.cli.files.xacro import expanded
from gelenk.errors import InvalidDhTable, InvalidField, InvalidName, counted

if TYPE_CHECKING:
    from gelenk.client import Client

_TABLES = (".json", ".toml", ".csv")
_SUFFIXES = (".urdf", ".xacro", ".xml", ".zip", *_TABLES)
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_NUMBERS = {"a", "alpha", "d", "theta", "lower", "upper", "velocity", "effort"}
_HEADING = re.compile(r"#\s*(convention|base|tool)\s*[:=]\s*(.*?)\s*")


@contextmanager
def robot_named(
    client: "Client", argument: str, describe: Callable[[Path], dict[str, Any]], strict: bool
) -> Iterator[str]:
    """Provide a robot's name at the service: its own, or a temporary one for a file.

    Args:
        argument: Name, or file: URDF, xacro, a zip of one URDF and its meshes, a table as JSON, TOML or CSV.
        describe: Returns the robot of a file without meshes as the API takes it.
    """
    file = Path(argument)
    if not is_file(file):
        _check_name(file, argument)
        yield argument
        return
    name = f"{name_of(file)[:40]}-{uuid.uuid4().hex[:8]}"
    if file.suffix.lower() == ".zip":
        client.add_archive(name, file, strict=strict)
    else:
        client.add_robot(name=name, **describe(file))
    try:
        yield name
    finally:
        client.remove_robot(name)


def _check_name(file: Path, argument: str) -> None:
    """Raise an error if the argument means a file, or cannot be a name."""
    if file.suffix.lower() in _SUFFIXES and not file.is_dir():
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), argument)
    if file.suffix and file.is_file():
        raise InvalidField("robot", f"{argument!r} must end in one of {', '.join(_SUFFIXES)}")
    if not _NAME.fullmatch(argument):
        raise InvalidName(argument)


def name_of(file: Path) -> str:
    """Return a robot's name, made from the name of its file."""
    stem = file.name.partition(".")[0]
    return re.sub(r"[^A-Za-z0-9_-]", "_", stem).lstrip("_-")[:64] or "robot"


def description_from(
    file: Path, arguments: Mapping[str, str], packages: Mapping[str, Path], strict: bool
) -> dict[str, Any]:
    """Return a robot without meshes as the API takes it, `dh` or `urdf`; for xacro with arguments and folders."""
    if file.suffix.lower() in _TABLES:
        return {"dh": table_from(file)}
    is_xacro = file.suffix.lower() == ".xacro"
    urdf = expanded(file, arguments, packages) if is_xacro else text_of(file.read_bytes(), file.name)
    return {"urdf": urdf, **({"strict": True} if strict else {})}


def is_file(path: Path) -> bool:
    """Check whether an argument means a file: it exists, and has the suffix of a robot file."""
    return path.suffix.lower() in _SUFFIXES and path.is_file()


def table_from(file: Path) -> Any:
    """Read a Denavit-Hartenberg table: JSON and TOML with the API's fields, or CSV with a column for each."""
    text, suffix = text_of(file.read_bytes(), file.name), file.suffix.lower()
    try:
        if suffix == ".csv":
            return _table_of_rows(text)
        content = tomllib.loads(text) if suffix == ".toml" else json.loads(text)
    except (tomllib.TOMLDecodeError, json.JSONDecodeError) as error:
        raise InvalidDhTable(f"{file.name} cannot be read: {error}") from error
    return content.get("dh", content) if isinstance(content, dict) else content


def _table_of_rows(text: str) -> dict[str, Any]:
    """Read a table from CSV, as `dh from-urdf` writes it.

    Lines such as `# convention: modified` set what the rows do not: `convention` (standard if left out), and the poses
    `base` and `tool` in the API's form.
    """
    lines = [line for line in text.splitlines() if line.strip()]
    headings = {found[1]: found[2] for line in lines if (found := _HEADING.fullmatch(line))}
    header, *rows = [cells_of(line) for line in lines if not line.startswith("#")] or [[]]
    joints = []
    for joint, row in enumerate(rows):
        if len(row) > len(header):
            raise InvalidDhTable(f"{counted(len(row), 'cell')} for {counted(len(header), 'column')}", joint)
        joints.append({name: _cell(joint, name, text) for name, text in zip(header, row, strict=False) if text})
    places = {name: json.loads(headings[name]) for name in ("base", "tool") if name in headings}
    return {"convention": headings.get("convention", "standard"), "joints": joints, **places}


def _cell(joint: int, name: str, text: str) -> float | str:
    if name not in _NUMBERS:
        return text
    try:
        return number(text)
    except ValueError:
        raise InvalidDhTable(f"{text!r} is not a number, and not one such as -pi/2", joint, name) from None


def fields_of(text: str | None) -> dict[str, Any]:
    """Return fields of the API from JSON text, a JSON file or standard input; empty if nothing is given."""
    if text is None:
        return {}
    if text == STDIN:
        text = text_of(sys.stdin.buffer.read(), "standard input")
    elif not text.lstrip().startswith(("{", "[")):
        text = text_of(Path(text).read_bytes(), text)
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise InvalidField("fields", f"is not JSON: {error}") from None
    if not isinstance(content, dict):
        raise InvalidField("fields", "must be a JSON object")
    return content


def pairs_of(given: Sequence[str], field: str) -> dict[str, str]:
    """Parse `NAME=VALUE` arguments; raises InvalidField for another form."""
    found = {}
    for text in given:
        name, equals, rest = text.partition("=")
        if not (name and equals):
            raise InvalidField(field, f"{text!r} is not NAME=VALUE")
        found[name] = rest
    return found


def packages_of(given: Sequence[str]) -> dict[str, Path]:
    """Parse `NAME=FOLDER` arguments; raises InvalidField for another form, or if a folder does not exist."""
    folders = pairs_of(given, "package")
    for name, folder in folders.items():
        if not (folder and Path(folder).is_dir()):
            raise InvalidField("package", f"{f'{name}={folder}'!r} names no folder: it must be NAME=FOLDER")
    return {name: Path(folder) for name, folder in folders.items()}
