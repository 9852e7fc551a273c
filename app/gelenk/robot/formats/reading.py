"""Reads a description by its root element: URDF as it is, xacro expanded, MJCF as the URDF of the same robot."""

from collections.abc import Mapping
from dataclasses import dataclass

from gelenk.errors import InvalidField, InvalidUrdf
from gelenk.robot.formats.mjcf.reader import read_mjcf
from gelenk.robot.formats.sources import Sources, as_text, placed_xml
from gelenk.robot.formats.xacro import expand, is_xacro
from gelenk.robot.urdf import read_urdf, write_urdf
from gelenk.robot.xml import Element, without_links


@dataclass(frozen=True, slots=True)
class Read:
    """A description as URDF, unchanged if it is one, and what else there is to say about it."""

    urdf: bytes
    notes: tuple[str, ...] = ()


_PARTS = frozenset(f"xacro:{part}" for part in ("arg", "if", "include", "macro", "property", "unless"))
"""Elements that a file of macros for other files has too."""
_WITH_BODIES = frozenset({"attach", "body", "frame", "include", "replicate"})
"""Elements of an MJCF's world that may bring a body."""


def is_robot(content: bytes) -> bool:
    """Return whether a file describes a robot by itself, instead of defining parts for others or something else.

    A file that cannot be read counts as one: whoever reads it says why.
    """
    try:
        root = placed_xml(as_text(content), "")
    except InvalidUrdf:
        return b"<robot" in content or b"<mujoco" in content
    if root.tag == "mujoco":
        worlds = [part for section in root.children if section.tag == "worldbody" for part in section.children]
        return any(part.tag in _WITH_BODIES for part in (*root.children, *worlds))
    return root.tag == "robot" and not {child.tag for child in root.children} <= _PARTS


def as_urdf(
    content: bytes, path: str, sources: Sources, arguments: Mapping[str, str] | None = None, strict: bool = False
) -> Read:
    """Return the URDF that a file describes: URDF, xacro or MJCF, by its elements.

    Args:
        content: The file's bytes.
        path: Path of the file among the sources.
        sources: Files that it may include.
        arguments: Values of a xacro's arguments.
        strict: As `read_urdf` takes it.

    Raises:
        InvalidUrdf: It is no robot; the error names the file, the line and the reason.
        InvalidField: An argument is unknown, or given for a file that takes none.
    """
    text = as_text(content, path)
    root = placed_xml(text, path)
    if root.tag != "robot" or not is_xacro(root):
        if arguments:
            raise InvalidField("arguments", "are those of a xacro: a URDF or MJCF takes none")
        return _from_mjcf(root, sources, strict) if root.tag == "mujoco" else Read(content)
    expanded = expand(root, sources, arguments or {})
    try:
        read_urdf(expanded.text, strict)
    except InvalidUrdf as error:
        if "<link" not in expanded.text:
            raise InvalidUrdf(without_links(root), None, root.line, path or None) from error
        raise expanded.at_its_origin(error) from error
    return Read(expanded.text.encode(), expanded.notes)


def _from_mjcf(root: Element, sources: Sources, strict: bool) -> Read:
    try:
        description = read_mjcf(root, sources)
        text = write_urdf(description)
    except RecursionError:
        reason = "bodies, frames or includes are nested too deeply"
        raise InvalidUrdf(reason, None, root.line, root.file or None) from None
    try:
        read_urdf(text, strict)
    except InvalidUrdf as error:  # its line is one of a text that nobody has seen
        raise InvalidUrdf(error.reason, error.element, None, root.file or None) from error
    return Read(text.encode(), description.warnings)
