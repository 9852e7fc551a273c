"""Robots, tables and fields, from arguments, files and standard input.

A xacro that is no part of a zip is expanded on the user's machine, where the files are that it includes.
"""

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
from xml.etree import ElementTree

from gelenk.cli.files.rows import STDIN, cells_of, number, text_of
from gelenk.errors import InvalidDhTable, InvalidField, InvalidName, counted, quoted

if TYPE_CHECKING:
    from gelenk.client import Client
    from gelenk.robot.formats.reading import Read


def expanded(file: Path, arguments: Mapping[str, str], packages: Mapping[str, Path]) -> "Read":
    """Return the URDF that a file describes, a xacro with values of its `xacro:arg`s, and notes; raises InvalidUrdf.

    `packages` are folders for `$(find NAME)`; other packages are searched for above the file, and in ROS if it is
    installed.
    """
    # Loading them takes a moment, which few calls need.
    from gelenk.collision.shapes.hulls import hull_triangles  # noqa: PLC0415
    from gelenk.collision.shapes.meshes import read_triangles  # noqa: PLC0415
    from gelenk.robot.formats.reading import as_urdf  # noqa: PLC0415
    from gelenk.robot.formats.sources import Fault, Sources  # noqa: PLC0415

    def find(name: str, folder: str) -> list[str]:
        scheme, is_address, rest = name.partition("://")
        package, _, inside = rest.partition("/")
        if not (is_address and scheme == "package"):
            path = file.parent / folder / name
        elif (found := packages.get(package) or _above(file.resolve(), package) or _installed(package)) is not None:
            path = found / inside
        else:
            raise Fault(f"package {package!r} is not found: name its folder with --package {package}=FOLDER")
        return [os.path.relpath(path, file.parent)] if path.is_file() else []

    def read(path: str) -> bytes:
        return (file.parent / path).read_bytes()

    sources = Sources(find, read, lambda path: read_triangles(path, read(path)), hull_triangles)
    return as_urdf(file.read_bytes(), file.name, sources, arguments)


def _installed(name: str) -> Path | None:
    """Return the folder of a package of ROS, if that is installed and has it."""
    try:
        from ament_index_python.packages import get_package_share_directory  # type: ignore[import-not-found]  # noqa: PLC0415

        return Path(get_package_share_directory(name))
    except (ImportError, LookupError):
        return None


def _above(file: Path, name: str) -> Path | None:
    """Return the package of that name which contains the file or lies beside it, if any."""
    for folder in file.parents:
        for candidate in (folder, folder / name):
            manifest = candidate / "package.xml"
            if manifest.is_file() and _name_of(manifest) == name:
                return candidate
    return None


def _name_of(manifest: Path) -> str | None:
    try:
        return ElementTree.parse(manifest).findtext("name")  # noqa: S314 - the user's own file
    except ElementTree.ParseError:
        return None


TABLE_SUFFIXES = (".json", ".toml", ".csv")
_SUFFIXES = (".urdf", ".xacro", ".xml", ".zip", *TABLE_SUFFIXES)
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,63}")
_FOLLOWED = "mimic."
_NUMBERS = {"a", "alpha", "d", "theta", "lower", "upper", "velocity", "effort", "mimic.multiplier", "mimic.offset"}
_HEADING = re.compile(r"#\s*(convention|base|tool)\s*[:=]\s*(.*?)\s*")


@contextmanager
def robot_named(
    client: "Client",
    argument: str,
    describe: Callable[[Path], dict[str, Any]],
    strict: bool,
    arguments: Mapping[str, str],
) -> Iterator[str]:
    """Provide a robot's name at the service: its own, or a temporary one for a file.

    Args:
        argument: Name, or file: URDF, xacro, a zip of one of them and its meshes, a table as JSON, TOML or CSV.
        describe: Returns the robot of a file without meshes as the API takes it.
        arguments: Values of the arguments of a xacro in a zip.
    """
    file = Path(argument)
    if not is_file(file):
        _check_name(file, argument)
        yield argument
        return
    name = f"{name_of(file)[:40]}-{uuid.uuid4().hex[:8]}"
    if file.suffix.lower() == ".zip":
        client.add_archive(name, file, strict=strict, arguments=arguments)
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
    file: Path,
    arguments: Mapping[str, str],
    packages: Mapping[str, Path],
    strict: bool,
    note: Callable[[str], None],
) -> dict[str, Any]:
    """Return a robot without meshes as the API takes it, `dh` or `urdf`; for xacro with arguments and folders.

    `note` is told what is not read of a xacro or MJCF, a sentence at a time: the service gets the URDF alone.
    """
    if file.suffix.lower() in TABLE_SUFFIXES:
        return {"dh": table_from(file)}
    is_plain = file.suffix.lower() == ".urdf" and not arguments
    if is_plain:
        urdf = text_of(file.read_bytes(), file.name)
    else:
        read = expanded(file, arguments, packages)
        urdf = read.urdf.decode("utf-8")
        for oddity in read.notes:
            note(f"file {quoted(file.name)}: {oddity}")
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
        cells = {name: _cell(joint, name, text) for name, text in zip(header, row, strict=False) if text}
        plain = {name: value for name, value in cells.items() if not name.startswith(_FOLLOWED)}
        followed = {name.removeprefix(_FOLLOWED): cells[name] for name in cells.keys() - plain.keys()}
        joints.append(plain | ({"mimic": followed} if followed else {}))
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
