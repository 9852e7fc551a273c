"""The reference of fields and errors, written from the service's own schema while the handbook is built.

What a schema says becomes Markdown: a section an operation, a table a request or an answer, a row a field.
"""

import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from html import escape
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from app.api.problems import status_of
from app.model.errors import KinematicsError, kinds
from handbook.session import service

Schema = Mapping[str, Any]

_MARKUP = re.compile(r"([\[\]*_$|#])")
_CODE = re.compile(r"(`[^`]*`)")


def setup(app: Sphinx) -> dict[str, Any]:
    """Add the directives to Sphinx."""
    app.add_directive("operations", Operations)
    app.add_directive("objects", Objects)
    app.add_directive("problems", Problems)
    return {"version": "1", "parallel_read_safe": False, "parallel_write_safe": True}


class Operations(SphinxDirective):
    """The operations of a group, as the schema has it in `tags`."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self) -> list[nodes.Node]:
        """A section each."""
        text = "\n\n".join(operation_sections(service().schema(), self.arguments[0]))
        return self.parse_text_to_nodes(text, allow_section_headings=True)


class Objects(SphinxDirective):
    """What requests and answers are made of."""

    def run(self) -> list[nodes.Node]:
        """A section each."""
        return self.parse_text_to_nodes("\n\n".join(object_sections(service().schema())), allow_section_headings=True)


class Problems(SphinxDirective):
    """What the core refuses."""

    def run(self) -> list[nodes.Node]:
        """A table."""
        return self.parse_text_to_nodes("\n".join(problem_table(kinds())))


def operation_sections(schema: Schema, tag: str) -> Iterator[str]:
    """The operations of a group: what each does, takes, answers with, and is refused with."""
    for path, methods in schema["paths"].items():
        for method, operation in methods.items():
            if tag in operation["tags"]:
                yield "\n\n".join(_operation(schema, f"{method.upper()} {path}", operation))


def object_sections(schema: Schema) -> Iterator[str]:
    """All named schemas, by the names they are shown with."""
    named = schema["components"]["schemas"]
    for key in sorted(named, key=lambda key: _shown(named, key)):
        yield "\n\n".join([f"({_target(key)})=", f"## {_shown(named, key)}", *_object(schema, named[key])])


def problem_table(classes: Mapping[str, type[KinematicsError]]) -> Iterator[str]:
    """The kinds of problems of the core: status, meaning, and what a problem holds beside its sentence."""
    yield from ("| kind | status | what it means | further members |", "|---|---|---|---|")
    for kind, error in sorted(classes.items()):
        meaning = " ".join((error.__doc__ or "").split("\n\n")[0].split())
        members = ", ".join(f"`{field.name}`" for field in fields(error)) or "-"
        yield f"| `{kind}` | {int(status_of(error))} | {_cell(meaning)} | {members} |"


def _operation(schema: Schema, call: str, operation: Schema) -> Iterator[str]:
    yield f"## {operation['summary']}"
    yield f"`{call}`"
    yield _prose(operation.get("description", ""))
    if parameters := [each for each in operation.get("parameters", []) if each["in"] == "query"]:
        yield "**In the query string**"
        rows = {each["name"]: {**each["schema"], "description": each.get("description", "")} for each in parameters}
        yield "\n".join(_table(schema, rows, {each["name"] for each in parameters if each.get("required")}))
    yield from _contents(schema, "Request", operation.get("requestBody", {}).get("content", {}))
    answered = {status: each for status, each in operation["responses"].items() if int(status) < 400}
    for status, response in answered.items():
        yield from _contents(schema, f"Answer, {status}", response.get("content", {}))
    refused = sorted(status for status in operation["responses"] if int(status) >= 400)
    yield f"Refused with {', '.join(refused)}: see [](errors.md)."


def _contents(schema: Schema, title: str, contents: Schema) -> Iterator[str]:
    """A body in each of the media types that it may have."""
    for media_type, content in contents.items():
        body = content.get("schema", {})
        yield f"**{title}** `{media_type}`"
        if "$ref" in body:
            body = schema["components"]["schemas"][_key(body)]
        if "properties" in body:
            yield from _object(schema, body)
        else:
            described = _prose(body.get("description", ""))
            yield ". ".join(part for part in (_type(schema, body), described) if part)
        if "example" in content:
            yield f"For example\n\n```json\n{_example(content['example'])}\n```"


def _example(example: Any) -> str:
    """A line a field."""
    if not isinstance(example, dict):
        return json.dumps(example, ensure_ascii=False)
    lines = ",\n".join(
        f"  {json.dumps(key)}: {json.dumps(value, ensure_ascii=False)}" for key, value in example.items()
    )
    return f"{{\n{lines}\n}}"


def _object(schema: Schema, described: Schema) -> Iterator[str]:
    yield _prose(described.get("description", ""))
    if "properties" in described:
        yield "\n".join(_table(schema, described["properties"], set(described.get("required", ()))))


def _table(schema: Schema, rows: Schema, required: Iterable[str]) -> Iterator[str]:
    yield from ("| field | what it is | meaning |", "|---|---|---|")
    for name, described in rows.items():
        kind = _type(schema, described) + ("; required" if name in required else _default(described))
        yield f"| `{name}` | {kind} | {_cell(described.get('description', ''))} |"


def _default(described: Schema) -> str:
    default = described.get("default")
    return "" if default is None or default == [] else f"; `{json.dumps(default)}` if left out"


def _type(schema: Schema, described: Schema) -> str:
    """What a value may be, in words."""
    if "$ref" in described:
        return f"[{_shown(schema['components']['schemas'], _key(described))}](#{_target(_key(described))})"
    for union in ("anyOf", "oneOf"):
        if union in described:
            return " or ".join(_type(schema, each) for each in described[union])
    if "enum" in described or "const" in described:
        return " · ".join(f"`{json.dumps(each)}`" for each in described.get("enum", [described.get("const")]))
    match described.get("type"):
        case "array":
            return _list(schema, described)
        case "object" if isinstance(described.get("additionalProperties"), Mapping):
            return f"object of {_type(schema, described['additionalProperties'])} by name"
        case "number" | "integer" as kind:
            return ("number" if kind == "number" else "whole number") + _bounds(described)
        case "string":
            return "bytes" if described.get("format") == "binary" else "text"
        case "boolean":
            return "`true` or `false`"
        case "null":
            return "`null`"
        case kind:
            return str(kind or "")


def _list(schema: Schema, described: Schema) -> str:
    items = _type(schema, described.get("items", {}))
    least, most = described.get("minItems", 0), described.get("maxItems")
    if most is not None and least == most:
        return f"list of {most}: {items}"
    size = f" (at most {most:,})" if most is not None else ""
    return f"list{size} of {items}" if items else f"list{size}"


def _bounds(described: Schema) -> str:
    signs = (("minimum", "≥"), ("exclusiveMinimum", ">"), ("maximum", "≤"), ("exclusiveMaximum", "<"))
    bounds = [f"{sign} {described[name]:g}" for name, sign in signs if name in described]
    return f" {', '.join(bounds)}" if bounds else ""


def _key(reference: Schema) -> str:
    return str(reference["$ref"]).rpartition("/")[2]


def _shown(named: Schema, key: str) -> str:
    """The name of a schema; two modules may have one of the same name, and then it says of what it is."""
    title = str(named[key].get("title", key))
    if key == title:
        return title
    return f"{title} ({key.split('__')[-2].replace('_', ' ')})"


def _target(key: str) -> str:
    return f"object-{key.strip('_').replace('__', '-').lower()}"


def _prose(text: str) -> str:
    """Text of the schema as Markdown: nothing but its backticks is markup."""
    parts = enumerate(_CODE.split(text))
    return "".join(part if i % 2 else _MARKUP.sub(r"\\\1", escape(part, False)) for i, part in parts)


def _cell(text: str) -> str:
    """The same in a line of a table."""
    return re.sub(r"(?<!\\)\|", r"\\|", " ".join(_prose(text).split()))
