"""Names of a xacro: properties, macros and arguments by scope, and texts with `${…}` and `$(…)` in them."""

import keyword
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from gelenk.errors import InvalidField, listed, quoted
from gelenk.robot.formats.expressions import evaluate
from gelenk.robot.formats.functions import MATH, PYTHON
from gelenk.robot.formats.sources import Fault, Sources, folder_of
from gelenk.robot.formats.values import MAX_TEXT, Function, Names, Steps, Value, checked
from gelenk.robot.xml import Element

MAX_NOTES = 20
"""Largest number of a description's warnings that are kept."""
_PIECE = re.compile(
    r"(?P<escaped>\$\$++(?=[{(]))|\$\{(?P<expression>[^}]*)\}|\$\((?P<command>(?:[^()]|\([^()]*\))*)\)"
    r"|(?P<text>[^$]+|\$++(?![{(]))"
)
_PARAMETER = re.compile(
    r"\s*(?P<name>[^\s:=]+)\s*:?=\s*(?P<outer>\^\|?)?"
    r"(?P<value>\$\{.*?\}|\$\(.*?\)|(?:'[^']*'|\"[^\"]*\"|[^\s'\"]+)++|)(?:\s+|$)|\s*(?P<bare>\S+)\s*"
)
_BOOLEANS = {"true": True, "True": True, "false": False, "False": False}
_NUMBERS = Names(MATH)
_OF_EVAL = Names({**MATH, **PYTHON, **_BOOLEANS})


@dataclass(frozen=True, slots=True)
class Macro:
    """A macro: its parameters in order, with default and whether the caller's value counts first; and its body."""

    name: str
    parameters: Mapping[str, tuple[str | None, bool] | None]
    body: Element


@dataclass(slots=True)
class Shared:
    """What all scopes of one expansion share.

    Attributes:
        arguments: Values of `xacro:arg`, given or by default; `known` are all names that the files have declared.
        notes: What the files say about themselves.
        yamls: Content of the YAML files read, by path.
        messages: Functions that a name after `xacro.` stands for; `common` are those of every file.
    """

    sources: Sources
    arguments: dict[str, str]
    steps: Steps = field(default_factory=Steps)
    known: set[str] = field(default_factory=set)
    notes: list[str] = field(default_factory=list)
    yamls: dict[str, Value] = field(default_factory=dict)
    messages: dict[str, Value] = field(init=False)
    common: Names = field(init=False)

    def __post_init__(self) -> None:
        """Make the tables of functions, once."""
        self.messages = _messages(self)
        spaces = {"math": Names(MATH), "python": Names(PYTHON), "xacro": Names(self.messages)}
        self.common = Names({**MATH, **PYTHON, **spaces})

    def argument(self, name: str) -> str:
        """Return the value of an argument; raises Fault if it has none."""
        self.known.add(name)
        if name not in self.arguments:
            raise Fault(f"the argument {quoted(name)} has no value: give one, or a default in <xacro:arg>")
        return self.arguments[name]

    def check_arguments(self, given: Mapping[str, str]) -> None:
        """Check that each argument given is one of the description's; raises InvalidField."""
        if unknown := tuple(sorted(set(given) - self.known)):
            known = listed(tuple(sorted(self.known)))
            raise InvalidField("arguments", f"no argument {listed(unknown)}; the description's arguments are {known}")


@dataclass(slots=True)
class _Lazy:
    """A property's text, evaluated when it is first used."""

    text: str
    file: str
    is_open: bool = False


class XacroScope:
    """Properties, blocks and macros of a file, a macro's call or a namespace, within an outer scope."""

    def __init__(self, shared: Shared, outer: "XacroScope | None" = None, is_namespace: bool = False) -> None:
        self.shared, self.outer, self.is_namespace = shared, outer, is_namespace
        self.macros: dict[str, Macro] = {}
        self.blocks: dict[str, Element] = {}
        self.values: dict[str, Value] = {}

    def set(self, name: str, value: Value, file: str, is_lazy: bool) -> None:
        """Define a property: a text is read as a number or truth value if it is one, else evaluated when used."""
        value = literal(value)
        self.values[name] = _Lazy(value, file) if is_lazy and isinstance(value, str) else value

    def value(self, name: str) -> Value:
        """Return the value of a property, or of a function that every xacro has; raises Fault."""
        scope = self.holder(name)
        if scope is None:
            return self.shared.common.value(name)
        found = scope.values[name]
        if isinstance(found, _Lazy):
            if found.is_open:
                raise Fault(f"the property {quoted(name)} is defined by itself")
            found.is_open = True
            try:
                scope.values[name] = literal(scope.evaluated(found.text, found.file))
            finally:
                found.is_open = False
        return scope.values[name]

    def holder(self, name: str) -> "XacroScope | None":
        """Return the innermost scope that defines a property."""
        scope: XacroScope | None = self
        while scope is not None and name not in scope.values:
            scope = scope.outer
        return scope

    def block(self, name: str) -> Element | None:
        """Return a block by its name with `*` or `**` before it."""
        scope: XacroScope | None = self
        while scope is not None:
            if name in scope.blocks:
                return scope.blocks[name]
            scope = scope.outer
        return None

    def macro(self, name: str) -> "tuple[Macro, XacroScope]":
        """Return a macro, and the scope around its call: this one, or the namespace that its name begins with."""
        scope: XacroScope | None = self
        while scope is not None:
            if name in scope.macros:
                return scope.macros[name], self
            scope = scope.outer
        space, dot, rest = name.partition(".")
        within = self.value(space) if dot and self.holder(space) is not None else None
        if isinstance(within, XacroScope):
            return within.macro(rest)
        raise Fault(f"there is no macro {quoted(name)}")

    @property
    def top(self) -> "XacroScope":
        """The scope of the first file."""
        return self if self.outer is None else self.outer.top

    def evaluated(self, text: str, file: str) -> Value:
        """Return a text with its `${…}` and `$(…)` evaluated; the value itself if the text is nothing else."""
        found: list[Value] = []
        at = 0
        self.shared.steps.take(1 + len(text) // 64)
        while at < len(text):
            piece = _PIECE.match(text, at)
            if piece is None:  # an opening bracket that is not closed
                raise Fault(f"{quoted(text[at:])} has no end")
            at = piece.end()
            if piece["escaped"] is not None:
                opening = text[at]
                end = text.find("}" if opening == "{" else ")", at)
                at = len(text) if end < 0 else end + 1
                found.append(piece["escaped"][1:] + text[piece.end() : at])
            elif piece["expression"] is not None:
                inner = str(self.evaluated(piece["expression"], file))
                found.append(evaluate(inner, _InFile(self, file), self.shared.steps))
            elif piece["command"] is not None:
                found.append(self._command(str(self.evaluated(piece["command"], file)), file))
            else:
                found.append(piece["text"])
        if len(found) == 1:
            return found[0]
        return self._joined(found)

    def _joined(self, parts: list[Value]) -> str:
        """Return values as one text; raises Fault as soon as that is too long."""
        texts, length = [], 0
        for part in parts:
            texts.append(str(part))
            length += len(texts[-1])
            if length > MAX_TEXT:
                raise Fault(f"a text of more than {MAX_TEXT} characters")
        self.shared.steps.take(length // 64)
        return "".join(texts)

    def _command(self, text: str, file: str) -> str:
        """Return what `$(text)` stands for."""
        self.shared.steps.take()
        word, _, rest = text.strip().partition(" ")
        rest = rest.strip()
        if word == "arg":
            return self.shared.argument(rest)
        if word == "find":
            return f"package://{rest}"
        if word == "optenv":
            return rest.partition(" ")[2].strip()
        if word == "env":
            raise Fault(f"$(env {rest}) is not read: the description of a robot does not depend on the machine")
        if word in {"dirname", "cwd"}:
            return folder_of(file) or "."
        if word == "eval":
            return str(evaluate(rest, _Arguments(self.shared), self.shared.steps))
        raise Fault(f"$({word} …) is not known: arg, find, eval, optenv, dirname")


@dataclass(frozen=True, slots=True)
class _InFile:
    """The names of a scope, and the functions that read files, from the file in which they stand."""

    scope: XacroScope
    file: str

    def value(self, name: str) -> Value:
        if name in {"load_yaml", "abs_filename", "xacro"} and self.scope.holder(name) is None:
            reading = {"load_yaml": Function("load_yaml", self._yaml), "abs_filename": Function("abs_filename", str)}
            if name in reading:
                return reading[name]
            if name == "xacro":
                return Names({**self.scope.shared.messages, **reading})
        return self.scope.value(name)

    def _yaml(self, name: str) -> Value:
        shared = self.scope.shared
        path = shared.sources.path(str(name), self.file)
        if path not in shared.yamls:
            content = shared.sources.yaml(path, lambda text: float(evaluate(text, _NUMBERS, shared.steps)))
            shared.yamls[path] = {} if content is None else content
        return shared.yamls[path]


@dataclass(frozen=True, slots=True)
class _Arguments:
    """The names of `$(eval …)`: the arguments, by name or by `arg('name')`, and the functions of `math`."""

    shared: Shared

    def value(self, name: str) -> Value:
        if name == "arg":
            return Function("arg", lambda of: literal(self.shared.argument(of)))
        if name in self.shared.arguments:
            return literal(self.shared.argument(name))
        return _OF_EVAL.value(name)


def _messages(shared: Shared) -> dict[str, Value]:
    def fatal(*words: Value) -> Value:
        raise Fault(_shortened(words, 1000))

    def note(*words: Value, **_: Value) -> str:
        if len(shared.notes) < MAX_NOTES:
            shared.notes.append(_shortened(words, 200))
        return ""

    functions: dict[str, Callable[..., Value]] = {
        "fatal": fatal,
        **dict.fromkeys(("warning", "error"), note),
        **dict.fromkeys(("message", "print_location"), lambda *_, **__: ""),
        "arg": shared.argument,
        "dotify": lambda value: value,
        "tokenize": _tokens,
    }
    return {name: Function(name, call) for name, call in functions.items()}


def _shortened(words: tuple[Value, ...], most: int) -> str:
    text = " ".join(str(word)[:most] for word in words[:most])[:most]
    checked(text)
    return text


def _tokens(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    if len(sep) > 16:
        raise Fault("tokenize takes at most 16 separators")
    for sign in sep[1:]:
        text = text.replace(sign, sep[0])
    return [word for word in text.split(sep[0]) if word or not skip_empty]


def literal(value: Value) -> Value:
    """Return a text as the number or truth value that it is, without its single quotes if it has them."""
    if not isinstance(value, str):
        return value
    if len(value) >= 2 and value[0] == value[-1] == "'":
        return value[1:-1]
    if "_" in value or len(value) > 64:
        return value
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            pass
    return _BOOLEANS.get(value, value)


def truth(value: Value, text: str) -> bool:
    """Return the truth value of a condition; raises Fault if it is a text that has none."""
    if isinstance(value, str):
        value = _BOOLEANS.get(value.strip(), literal(value.strip()))
    if isinstance(value, str):
        raise Fault(f"the condition {quoted(text)} is {quoted(value)}: it must be true or false")
    return bool(value)


def parameters_of(text: str) -> dict[str, tuple[str | None, bool] | None]:
    """Return the parameters of a macro by name: default, and whether the caller's value counts first."""
    found: dict[str, tuple[str | None, bool] | None] = {}
    at, text = 0, text.strip()
    while at < len(text):
        given = _PARAMETER.match(text, at)
        if given is None:
            raise Fault(f"the parameters {quoted(text[at:])} cannot be read")
        at = given.end()
        if given["bare"] is not None:
            found[given["bare"]] = None
        else:
            found[given["name"]] = given["value"] or None, given["outer"] is not None
    return found


def is_name(text: str) -> bool:
    """Return whether a text can be the name of a property."""
    return text.isidentifier() and not text.startswith("__") and not keyword.iskeyword(text)
