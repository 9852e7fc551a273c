"""Detects unexpanded xacro in a description: elements and expressions that mean nothing before they are expanded."""

import re

from gelenk.model.errors import listed, quoted
from gelenk.model.xml import Element

_EXPRESSION = re.compile(r"\$[({]")
_OLD_TAGS = frozenset({"arg", "if", "include", "insert_block", "macro", "property", "unless"})
"""Elements of older xacro versions, which used no prefix."""


def left_of_xacro(root: Element, ignored: frozenset[str]) -> str | None:
    """Describe the first attribute or element that only xacro understands; return None if the description has none.

    Args:
        root: Root element of the description.
        ignored: Tags of elements of the robot that are not searched.
    """
    waiting = [root]
    while waiting:
        element = waiting.pop()
        children = [child for child in element.children if element is not root or child.tag not in ignored]
        values = [value for value in element.attributes.values() if _EXPRESSION.search(value)]
        values += [child.tag for child in children if element is root and child.tag in _OLD_TAGS]
        if values:
            return f"{quoted(values[0])} (line {element.line}) means nothing here: expand the xacro before the upload"
        waiting += reversed(children)
    return None


def without_links(root: Element) -> str:
    """Explain why a description has no links."""
    names = tuple(child.attributes.get("name", "") for child in root.children if child.tag in {"macro", "xacro:macro"})
    if not names:
        return "the robot has no link"
    return f"the robot has no link: the xacro defines only the macros {listed(names)}; expand one that calls them"
