"""What is left of a xacro in a description: elements and expressions that mean nothing before they are expanded."""

import re

from gelenk.model.errors import listed, quoted
from gelenk.model.xml import Element

_EXPRESSION = re.compile(r"\$[({]")
_OLD_TAGS = frozenset({"arg", "if", "include", "insert_block", "macro", "property", "unless"})
"""Xacro's elements as it once had them: without a prefix."""


def left_of_xacro(root: Element, ignored: frozenset[str]) -> str | None:
    """The first element or attribute that only xacro understands, in words; None where there is none.

    Args:
        root: Of the description.
        ignored: Elements of the robot that are not looked into.
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
    """Why a description without links has none."""
    names = tuple(child.attributes.get("name", "") for child in root.children if child.tag in {"macro", "xacro:macro"})
    if not names:
        return "the robot has no link"
    return f"the robot has no link: the xacro defines only the macros {listed(names)}; expand one that calls them"
