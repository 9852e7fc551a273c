"""What an operator can set, and what nobody can, as Markdown from the code that keeps to it."""

import inspect
import re
from collections.abc import Iterator
from dataclasses import MISSING, fields

from docs.handbook.schema_words import anchor, defined
from gelenk.contract import ik
from gelenk.http.access import keyring
from gelenk.http.workers import pool_client
from gelenk.robot import dh, tree, urdf, xml
from gelenk.settings import Settings
from gelenk.store import archive

_OF_THE_MACHINE = {
    "data_dir": "the user's data folder",
    "catalogue_dir": "`robots` in the folder of the project",
    "crew_processes": "one a processor, 2 to 8",
    "job_processes": "one a processor, at most 8",
}
"""Defaults that depend on where the service runs."""
_ATTRIBUTE = re.compile(r"^ {4}(\w+): (.*?)(?=^ {4}\w+: |\Z)", re.MULTILINE | re.DOTALL)
_VARIABLE = re.compile(r" \(`(GELENK_\w+)`\)\.$")
_MEBIBYTE = 1024 * 1024

_BOUNDS = (
    ("URDF", f"{xml.MAX_BYTES // _MEBIBYTE} MiB"),
    ("elements of a URDF", xml.MAX_ELEMENTS),
    ("attributes of an element", xml.MAX_ATTRIBUTES),
    ("elements inside each other", xml.MAX_DEPTH),
    ("characters of an attribute", xml.MAX_VALUE_LENGTH),
    ("links", urdf.MAX_LINKS),
    ("geometries", urdf.MAX_SHAPES),
    ("joints from the root to a leaf", tree.MAX_DEPTH),
    ("movable joints", tree.MAX_MOVABLE),
    ("length, angle or coordinate in a URDF, magnitude", urdf.MAX_MAGNITUDE),
    ("joints of a DH table", dh.MAX_JOINTS),
    ("length in a DH table, magnitude [m]", dh.MAX_LENGTH),
    ("entries of a zip", archive.MAX_ENTRIES),
    ("zip, unpacked", f"{archive.MAX_UNPACKED // _MEBIBYTE} MiB"),
    ("bytes of a path in a zip", archive.MAX_PATH_BYTES),
    ("keys", keyring.MAX_KEYS),
    ("targets of a call by a method of the course, or with `trace`", ik.MAX_STEPWISE),
    ("the same of a job", ik.MAX_JOB_STEPWISE),
    ("a body of `workspace`", f"{pool_client.PARSED_HERE_BYTES // 1024} KiB"),
    ("configurations of a target's `trace`", ik.MAX_TRACE),
    ("targets of a job", ik.MAX_JOB_TARGETS),
)
"""What is at most taken, whatever is set."""


def settings() -> str:
    """The environment variables as a list."""
    return "\n\n".join(_settings())


def bounds() -> str:
    """What no setting changes, as a table."""
    rows = [f"| {what} | {most if isinstance(most, str) else f'{most:,.0f}'} |" for what, most in _BOUNDS]
    return "\n".join(["| what | at most |", "|---|---|", *rows])


def _settings() -> Iterator[str]:
    document = inspect.cleandoc(Settings.__doc__ or "")
    meanings = {name: " ".join(text.split()) for name, text in _ATTRIBUTE.findall(document.partition("Attributes:")[2])}
    for entry in fields(Settings):
        meaning, variable = meanings[entry.name], f"GELENK_{entry.name.upper()}"
        default = _OF_THE_MACHINE[entry.name] if entry.default is MISSING else _written(entry.name, entry.default)
        named = _VARIABLE.sub(".", meaning)
        yield defined(anchor("setting", entry.name), variable, f"default: {default}", named)


def _written(name: str, value: object) -> str:
    """A default as it would stand in the environment, and bytes in words too."""
    match value:
        case bool():
            return f"`{'yes' if value else 'no'}`"
        case int() if name.endswith("_bytes"):
            return f"`{value}` ({value // _MEBIBYTE} MiB)"
        case "" | ():
            return "none"
    return f"`{value}`"
