"""An operation of the schema in Markdown: how it is called, what it takes, what it answers with and refuses with."""

import inspect
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any
from urllib.parse import unquote

from docs.handbook.schema_words import Objects, Schema, anchor, component, field, fields, linked, place, words
from gelenk.client.call import Sent
from gelenk.client.operations import Operations

_LINE = 72
"""Letters of a line of an example."""


@dataclass(frozen=True)
class Entry:
    """An operation of the schema.

    Attributes:
        path: With its parameters in braces.
        method: Of HTTP, in capitals.
        content: What the schema says of it.
    """

    path: str
    method: str
    content: Mapping[str, Any]

    @property
    def id(self) -> str:
        """Its name in the schema."""
        return str(self.content["operationId"])

    @property
    def bodies(self) -> Mapping[str, Any]:
        """What it takes, by media type."""
        body: Mapping[str, Any] = self.content.get("requestBody", {}).get("content", {})
        return body

    @property
    def answers(self) -> list[tuple[int, Mapping[str, Any]]]:
        """What it answers with where it does not refuse: status and response."""
        return [(int(status), told) for status, told in self.content["responses"].items() if status < "400"]

    @property
    def refusals(self) -> list[int]:
        """The statuses of its problems."""
        return sorted(int(status) for status in self.content["responses"] if status >= "400")


def entries(schema: Mapping[str, Any]) -> list[Entry]:
    """All operations of a schema, in its order."""
    return [
        Entry(path, method.upper(), content)
        for path, operations in schema["paths"].items()
        for method, content in operations.items()
    ]


def described(entry: Entry, objects: Objects) -> str:
    """An operation below a heading, without the fields of the objects that it names."""
    paragraphs = [
        f"{place(anchor('operation', entry.id))}\n\n## {entry.content['summary']}",
        f"`{entry.method} {entry.path}`",
        _access(entry),
        entry.content.get("description", ""),
        *_parameters(entry, objects),
        *_bodies(entry, objects),
        *_answers(entry),
        f"**Refuses** with {', '.join(f'[{status}](#status-{status})' for status in entry.refusals)}.",
    ]
    return "\n\n".join(paragraph for paragraph in paragraphs if paragraph)


def _access(entry: Entry) -> str:
    """What it is called in Python, and the scope that a key needs."""
    names = " or ".join(f"`gelenk.{name}`" for name in client_methods().get((entry.method, entry.path), ()))
    scopes = [scope for way in entry.content.get("security", []) for scope in way.get("key", [])]
    key = f"Where keys are on, it needs the scope `{scopes[0]}`." if scopes else "It needs no key."
    return f"In Python {names}. {key}" if names else key


@cache
def client_methods() -> Mapping[tuple[str, str], list[str]]:
    """The methods of the client, by the HTTP method and the path of what they ask."""
    found: dict[tuple[str, str], list[str]] = {}
    for name, sent in vars(Operations).items():
        if not isinstance(sent, Sent) or name == "picture":
            continue
        needed = [
            {"archive": b"", "files": {}}.get(parameter.name, f"{{{parameter.name}}}")
            for parameter in inspect.signature(sent.describe).parameters.values()
            if parameter.kind != parameter.KEYWORD_ONLY and parameter.default is parameter.empty
        ]
        call = sent.describe(*needed)
        found.setdefault((call.method, f"/{unquote(call.path)}"), []).append(name)
    return found


def _parameters(entry: Entry, objects: Objects) -> Iterator[str]:
    """Those in the path, the query and the header."""
    for parameter in entry.content.get("parameters", []):
        place = f"in the {parameter['in']}"
        yield field(entry.id, parameter["name"], parameter["schema"], objects, parameter["required"], place)


def _bodies(entry: Entry, objects: Objects) -> Iterator[str]:
    """What is sent."""
    for media, content in entry.bodies.items():
        schema = content["schema"]
        if "$ref" in schema:
            yield f"**Takes** {linked(component(schema['$ref']))} as `{media}`, such as"
        elif "properties" in schema:
            yield f"**Takes** a form as `{media}`:"
            yield fields(f"{entry.id}_form", schema, objects)
        else:
            yield f"**Takes** `{media}`: {schema['description']}"
        yield from (f"```json\n{compact(example)}\n```" for example in examples(content))


def examples(content: Mapping[str, Any]) -> list[Any]:
    """Those of a body, the one that runs on the robot of the path's example first."""
    if "example" in content:
        return [content["example"]]
    return [example["value"] for example in content.get("examples", {}).values()]


def compact(value: Any, indent: int = 0, width: int = _LINE) -> str:
    """JSON with what is short on one line.

    Args:
        value: Of lists, objects with text keys, numbers, texts.
        indent: Spaces before its lines but the first.
        width: Letters of a line; what is longer is written over several.
    """
    line = json.dumps(value, ensure_ascii=False)
    if len(line) + indent <= width or not isinstance(value, dict | list):
        return line
    inner = " " * (indent + 2)
    if isinstance(value, dict):
        items = [f"{inner}{json.dumps(key)}: {compact(item, indent + 2, width)}" for key, item in value.items()]
    else:
        items = [f"{inner}{compact(item, indent + 2, width)}" for item in value]
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    return f"{opening}\n" + ",\n".join(items) + f"\n{' ' * indent}{closing}"


def _answers(entry: Entry) -> Iterator[str]:
    """What comes back."""
    for status, answer in entry.answers:
        told = answer["description"]
        meaning = "" if told == "Successful Response" else f" ({told[0].lower()}{told[1:]})"
        kinds = [_answer(media, content.get("schema", {})) for media, content in answer.get("content", {}).items()]
        yield f"**Answers** {status}{meaning}{' with ' if kinds else ''}{'; or with '.join(kinds)}."


def _answer(media: str, schema: Schema) -> str:
    if "description" in schema:
        return f"`{media}`: {schema['description'].rstrip('.')}"
    return f"{words(schema)} as `{media}`" if schema else f"`{media}`"
