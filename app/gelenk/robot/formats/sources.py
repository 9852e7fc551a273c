"""The files that a description may include: those of its upload, within bounds on their number and size."""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import PurePosixPath
from typing import Any

import numpy as np
import yaml

from gelenk.errors import InvalidUrdf, listed, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.xml import Element, read_xml, with_declaration_first

MAX_READ = 16 * 1024 * 1024
"""Largest number of bytes read for one description, each file counted as often as it is included."""
MAX_YAML_BYTES = 256 * 1024
MAX_YAML_DEPTH = 32
"""Largest number of open brackets in a YAML file: reading one takes longer the deeper it is."""
MAX_YAML_VALUES = 50_000
"""Largest number of values in a YAML file, with each alias counted as a copy of what it stands for."""
MAX_YAML_SIGNS = 10_000
"""Largest number of signs in a YAML file that may each begin a value: composing one takes far longer than counting."""
_OUTSIDE = re.compile(r"^[/\\]|^(?!package:)\w+:")


class Fault(Exception):
    """Something wrong in a description, told without its place; whoever knows the place adds it."""


@dataclass(slots=True)
class Sources:
    """The files of an upload.

    Attributes:
        find: Returns the paths that a name in a file of a folder may refer to, `package://…` or a relative path.
        read: Returns the content of a path.
        triangles: Returns the corners of a mesh's triangles, shape (F, 3, 3); raises InvalidMesh.
        hull: Returns the triangles of the convex hull of such triangles, seen from outside; raises ValueError.
    """

    find: Callable[[str, str], list[str]] = lambda name, folder: []  # noqa: ARG005
    read: Callable[[str], bytes] = lambda path: b""  # noqa: ARG005
    triangles: Callable[[str], Array] = lambda path: np.empty((0, 3, 3))  # noqa: ARG005
    hull: Callable[[Array], Array] = lambda triangles: triangles
    _read_bytes: int = field(default=0, init=False)

    def path(self, name: str, around: str) -> str:
        """Return the path of the file that file `around` names; raises Fault."""
        if _OUTSIDE.search(name):
            raise Fault(f"{quoted(name)} is not looked for: a file is named from the including one, or by $(find …)")
        found = self.find(name, folder_of(around))
        if not found:
            raise Fault(f"there is no file {quoted(name)}")
        if len(found) > 1:
            raise Fault(f"several files match {quoted(name)}: {listed(tuple(found))}")
        return found[0]

    def text(self, path: str) -> str:
        """Return the text of a file; raises Fault, or TooLarge as the archive does."""
        content = self.read(path)
        self._read_bytes += len(content)
        if self._read_bytes > MAX_READ:
            raise Fault(f"the files included have more than {MAX_READ} bytes together")
        return as_text(content, path)

    def xml(self, path: str) -> Element:
        """Return the root element of a file; raises as `text`, and InvalidUrdf."""
        return placed_xml(self.text(path), path)

    def yaml(self, path: str, number: Callable[[str], float]) -> Any:
        """Return the content of a YAML file in plain values; `number` evaluates those with a unit. Raises Fault."""
        text = self.text(path)
        if len(text) > MAX_YAML_BYTES:
            raise Fault(f"{quoted(path)} has more than {MAX_YAML_BYTES} bytes")
        if sum(map(text.count, (",", "\n", ":", "- "))) > MAX_YAML_SIGNS:
            raise Fault(f"{quoted(path)} has more than {MAX_YAML_SIGNS} commas, lines, colons and dashes")
        steps = (1 if sign in "[{" else -1 for sign in re.findall(r"[\[\]{}]", text))
        if max(accumulate(steps), default=0) > MAX_YAML_DEPTH:
            raise Fault(f"{quoted(path)} has more than {MAX_YAML_DEPTH} brackets within each other")
        try:
            return _yaml(text, number)
        except (yaml.YAMLError, ValueError, RecursionError) as error:
            what = "it is nested too deeply" if isinstance(error, RecursionError) else " ".join(str(error).split())
            raise Fault(f"{quoted(path)} is not read as YAML: {what}") from error


def folder_of(path: str) -> str:
    """Return the folder of a path, "" at the top."""
    parent = str(PurePosixPath(path).parent)
    return "" if parent == "." else parent


def as_text(content: bytes, path: str = "") -> str:
    """Return a content as text; raises InvalidUrdf."""
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise InvalidUrdf("the text is not UTF-8", None, line, path or None) from error


def placed_xml(text: str, path: str) -> Element:
    """Return the root element of a text, whose elements and errors know the file."""
    try:
        return read_xml(with_declaration_first(text), path)
    except InvalidUrdf as error:
        raise InvalidUrdf(error.reason, error.element, error.line, path or None) from error


_UNITS = {"radians": 1.0, "degrees": 0.017453292519943295, "meters": 1.0, "millimeters": 0.001}
_UNITS |= {"foot": 0.3048, "inches": 0.0254}


def _yaml(text: str, number: Callable[[str], float]) -> Any:
    class Loader(yaml.SafeLoader):  # type: ignore[misc]
        pass

    def with_unit(factor: float) -> Callable[[Any, Any], float]:
        return lambda loader, node: number(str(loader.construct_scalar(node))) * factor

    for unit, factor in _UNITS.items():
        Loader.add_constructor(f"!{unit}", with_unit(factor))
    loader = Loader(text)
    try:
        node = loader.get_single_node()
        if node is None:
            return None
        if _count(node, {}) > MAX_YAML_VALUES:
            raise Fault(f"the YAML has more than {MAX_YAML_VALUES} values, aliases counted as copies")
        return _plain(loader.construct_document(node))
    finally:
        loader.dispose()


def _count(node: Any, counted: dict[int, int]) -> int:
    """Return the number of values below a node, each alias counted as a copy; raises Fault if it contains itself."""
    if id(node) in counted:
        if (known := counted[id(node)]) == 0:
            raise Fault("a YAML value contains itself")
        return known
    counted[id(node)] = 0
    below = [part for item in node.value for part in (item if isinstance(item, tuple) else (item,))]
    total = 1 if isinstance(node, yaml.ScalarNode) else 1 + sum(_count(part, counted) for part in below)
    counted[id(node)] = total
    return total


def _plain(value: Any) -> Any:
    """Return a value of YAML with dates and the like as text."""
    if isinstance(value, dict):
        return {_plain(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value if value is None or isinstance(value, bool | int | float | str) else str(value)
