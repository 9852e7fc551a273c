"""Expands xacro: properties, macros with parameters and blocks, includes, conditions, arguments and expressions.

Meant to give what ROS's xacro gives, without ROS and without evaluating Python: files come from the upload alone, and
depth, steps, bytes and elements are bounded. What only simulators and controllers read is left out.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from gelenk.errors import InvalidUrdf, counted, quoted
from gelenk.robot.formats.scope import Macro, Shared, XacroScope, is_name, literal, parameters_of, truth
from gelenk.robot.formats.sources import Fault, Sources
from gelenk.robot.xml import MAX_BYTES, MAX_ELEMENTS, Element

MAX_NESTING = 100
"""Largest number of macros, conditions and includes within each other."""
_UNREAD = frozenset({"gazebo", "transmission", "ros2_control"})
_PREFIX = "xacro:"


@dataclass(frozen=True, slots=True)
class Expanded:
    """A URDF in which each element starts on a line of its own.

    Attributes:
        origins: File and line, 1-based, of the element on each line of the text.
        notes: What the files warn of.
    """

    text: str
    origins: tuple[tuple[str, int], ...]
    notes: tuple[str, ...]

    def at_its_origin(self, error: InvalidUrdf) -> InvalidUrdf:
        """Return an error about this text as one about the file that it was expanded from."""
        if error.line is None or error.line > len(self.origins):
            return error
        file, line = self.origins[error.line - 1]
        return InvalidUrdf(error.reason, error.element, line, file or None)


def is_xacro(root: Element) -> bool:
    """Return whether a description has elements with xacro's prefix; or expressions, if it declares that prefix."""
    is_declared, waiting = "xmlns:xacro" in root.attributes, [root]
    while waiting:
        element = waiting.pop()
        has_expression = is_declared and any("${" in text or "$(" in text for text in element.attributes.values())
        if has_expression or element.tag.startswith(_PREFIX):
            return True
        waiting += element.children
    return False


def expand(root: Element, sources: Sources, arguments: Mapping[str, str]) -> Expanded:
    """Expand a description with values of its `xacro:arg`s.

    Raises:
        InvalidUrdf: It cannot be expanded; the error names the file, the line and the reason.
        InvalidField: An argument is unknown; the error names the known ones.
    """
    expansion = _XacroExpansion(Shared(sources, dict(arguments)))
    try:
        (robot,) = expansion.element(root, XacroScope(expansion.shared))
    except RecursionError:
        raise InvalidUrdf("macros, includes or expressions are nested too deeply", None, root.line) from None
    expansion.shared.check_arguments(arguments)
    lines = ['<?xml version="1.0" encoding="utf-8"?>']
    origins = [(root.file, 1)]
    _write(robot, 0, lines, origins)
    text = "\n".join([*lines, ""])
    if len(text.encode()) > MAX_BYTES:
        raise InvalidUrdf(f"it expands to more than {MAX_BYTES} bytes", None, root.line, root.file or None)
    return Expanded(text, tuple(origins), tuple(expansion.shared.notes))


def _write(element: Element, depth: int, lines: list[str], origins: list[tuple[str, int]]) -> None:
    space = " " * depth
    start = f"{space}<{element.tag}" + "".join(f" {key}={quoteattr(text)}" for key, text in element.attributes.items())
    origins.append((element.file, element.line))
    lines.append(start + (">" if element.children else "/>"))
    for child in element.children:
        _write(child, depth + 1, lines, origins)
    if element.children:
        origins.append((element.file, element.line))
        lines.append(f"{space}</{element.tag}>")


class _XacroExpansion:
    def __init__(self, shared: Shared) -> None:
        self.shared = shared
        self._nesting = 0
        self._elements = 0
        self._letters = 0

    def element(self, element: Element, scope: XacroScope) -> list[Element]:
        """Return what stands in the place of an element; raises InvalidUrdf with the innermost place."""
        try:
            self.shared.steps.take(20)
            return self._expanded(element, scope)
        except Fault as fault:
            raise InvalidUrdf(
                str(fault), f"element {quoted(element.tag)}", element.line, element.file or None
            ) from None

    def _expanded(self, element: Element, scope: XacroScope) -> list[Element]:
        tag = element.tag
        if not tag.startswith(_PREFIX):
            return [] if tag in _UNREAD else [self._plain(element, tag, scope)]
        name = tag.removeprefix(_PREFIX)
        known = getattr(self, f"_{name}", None) if name in _ELEMENTS else None
        self._nesting += 1
        try:
            if self._nesting > MAX_NESTING:
                raise Fault(f"macros, conditions and includes are nested deeper than {MAX_NESTING}")
            found: list[Element] = known(element, scope) if known else self._call(element, name, scope)
        finally:
            self._nesting -= 1
        return found

    def _plain(self, element: Element, tag: str, scope: XacroScope) -> Element:
        self._elements += 1
        if self._elements > MAX_ELEMENTS:
            raise Fault(f"it expands to more than {MAX_ELEMENTS} elements")
        made = Element(tag, {}, element.line, file=element.file)
        if scope.outer is not None or tag != "robot":
            made.attributes |= self._attributes(element, scope)
            self._add_children(element, made, scope)
        else:  # the name of a robot is often one of the arguments, which come after it
            self._add_children(element, made, scope)
            made.attributes |= self._attributes(element, scope)
        return made

    def _attributes(self, element: Element, scope: XacroScope) -> dict[str, str]:
        found = {}
        for key, text in element.attributes.items():
            if not key.startswith(_PREFIX) and key != "xmlns:xacro":
                value = str(scope.evaluated(text, element.file)).replace("file://package://", "package://")
                found[key] = self._counted(value)
        return found

    def _counted(self, value: str) -> str:
        """Return an attribute's value; raises Fault when those of all elements are too long together."""
        self._letters += len(value)
        if self._letters > MAX_BYTES:
            raise Fault(f"it expands to more than {MAX_BYTES} bytes")
        return value

    def _add_children(self, element: Element, made: Element, scope: XacroScope) -> None:
        for child in element.children:
            if child.tag == f"{_PREFIX}attribute":
                self._set_attribute(child, made, scope)
            else:
                made.children += self.element(child, scope)

    def _children(self, element: Element, scope: XacroScope) -> list[Element]:
        return [made for child in element.children for made in self.element(child, scope)]

    def _text(self, element: Element, key: str, scope: XacroScope) -> str:
        return str(scope.evaluated(_given(element, key), element.file))

    def _set_attribute(self, element: Element, made: Element, scope: XacroScope) -> None:
        name, value = (self._text(element, key, scope) for key in ("name", "value"))
        if not name.strip():
            raise Fault("the attribute has no name")
        made.attributes[name] = self._counted(value)

    # The elements of xacro

    def _attribute(self, element: Element, scope: XacroScope) -> list[Element]:  # noqa: ARG002
        raise Fault("an attribute must stand directly in the element that it is for")

    def _element(self, element: Element, scope: XacroScope) -> list[Element]:
        name = self._text(element, f"{_PREFIX}name", scope)
        if not name.replace(":", "_").isidentifier():
            raise Fault(f"{quoted(name)} is not the name of an element")
        return [self._plain(element, name, scope)]

    def _arg(self, element: Element, scope: XacroScope) -> list[Element]:
        name = _given(element, "name")
        self.shared.known.add(name)
        if "default" in element.attributes and name not in self.shared.arguments:
            self.shared.arguments[name] = self._text(element, "default", scope)
        return []

    def _if(self, element: Element, scope: XacroScope, is_wanted: bool = True) -> list[Element]:
        text = _given(element, "value")
        holds = truth(scope.evaluated(text, element.file), text)
        return self._children(element, scope) if holds is is_wanted else []

    def _unless(self, element: Element, scope: XacroScope) -> list[Element]:
        return self._if(element, scope, is_wanted=False)

    def _property(self, element: Element, scope: XacroScope) -> list[Element]:
        name, given, file = self._text(element, "name", scope), element.attributes, element.file
        if not is_name(name):
            raise Fault(f"{quoted(name)} cannot be the name of a property")
        if truth(scope.evaluated(given.get("remove", "false"), file), "remove"):
            while (holder := scope.holder(name)) is not None:
                del holder.values[name]
            return []
        if "default" in given and scope.holder(name) is not None:
            return []
        where, value = given.get("scope"), given.get("value", given.get("default"))
        target = scope.top if where == "global" else scope
        if where == "parent":
            target = scope.outer or scope
            while target.is_namespace and target.outer is not None and not scope.is_namespace:
                target = target.outer
        if value is None:
            target.blocks[f"**{name}"] = element
            return []
        is_lazy = where not in {"global", "parent"}
        is_lazy = is_lazy and truth(scope.evaluated(given.get("lazy_eval", "true"), file), "lazy_eval")
        target.set(name, value if is_lazy else scope.evaluated(value, file), file, is_lazy)
        return []

    def _macro(self, element: Element, scope: XacroScope) -> list[Element]:
        name = _given(element, "name").removeprefix(_PREFIX)
        if name == "call" or "." in name:
            raise Fault(f"{quoted(name)} cannot be the name of a macro")
        scope.macros[name] = Macro(name, parameters_of(element.attributes.get("params", "")), element)
        return []

    def _insert_block(self, element: Element, scope: XacroScope) -> list[Element]:
        name = _given(element, "name")
        if (block := scope.block(f"**{name}")) is not None:
            return self._children(block, scope)
        if (block := scope.block(f"*{name}")) is not None:
            return self.element(block, scope)
        raise Fault(f"there is no block {quoted(name)}")

    def _include(self, element: Element, scope: XacroScope) -> list[Element]:
        name = self._text(element, "filename", scope)
        if any(sign in name for sign in "*?["):
            raise Fault(f"{quoted(name)} is a pattern: each file is included by its name")
        try:
            path = self.shared.sources.path(name, element.file)
        except Fault:
            if truth(element.attributes.get("optional", "false"), "optional"):
                return []
            raise
        inner = scope
        if "ns" in element.attributes:
            inner = XacroScope(self.shared, scope, is_namespace=True)
            scope.values[self._text(element, "ns", scope)] = inner
        return self._children(self.shared.sources.xml(path), inner)

    # Calls of macros

    def _call(self, element: Element, name: str, scope: XacroScope) -> list[Element]:
        given = dict(element.attributes)
        if name == "call":
            _given(element, "macro")
            name = str(scope.evaluated(given.pop("macro"), element.file))
        macro, around = scope.macro(name)
        inner = XacroScope(self.shared, around)
        values = self._values(macro, given, element, scope)
        for parameter, value in values.items():
            inner.set(parameter, value, element.file, is_lazy=False)
        blocks = self._children(element, scope)
        wanted = [parameter for parameter in macro.parameters if parameter.startswith("*")]
        if len(blocks) != len(wanted):
            raise Fault(f"the macro {quoted(name)} takes {counted(len(wanted), 'block')}, and {len(blocks)} are given")
        inner.blocks |= dict(zip(wanted, blocks, strict=True))
        return self._children(macro.body, inner)

    def _values(self, macro: Macro, given: Mapping[str, str], element: Element, scope: XacroScope) -> dict[str, object]:
        """Return the values of a macro's parameters, in the scope of the call."""
        values: dict[str, object] = {}
        for key, written in given.items():
            if key.startswith("xmlns:"):
                continue
            if key not in macro.parameters:
                raise Fault(f"the macro {quoted(macro.name)} has no parameter {quoted(key)}")
            values[key] = scope.evaluated(written, element.file)
        for key, default in macro.parameters.items():
            if key in values or key.startswith("*"):
                continue
            text, is_outer = default or (None, False)
            if is_outer and scope.holder(key) is not None:
                values[key] = scope.value(key)
            elif text is not None or (default is not None and not is_outer):
                values[key] = literal(scope.evaluated(text or "", macro.body.file))
            else:
                raise Fault(f"the macro {quoted(macro.name)} needs the parameter {quoted(key)}")
        return values


_ELEMENTS = frozenset({"arg", "attribute", "element", "if", "include", "insert_block", "macro", "property", "unless"})


def _given(element: Element, key: str) -> str:
    """Return an attribute; raises Fault without it."""
    if key not in element.attributes:
        raise Fault(f"{element.tag} must have the attribute {quoted(key)}")
    return element.attributes[key]
