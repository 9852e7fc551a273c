"""A JSON schema in words of Markdown: what a value may be, `list of 1 to 64 [Pose](#object-pose)`, and fields."""

import json
import re
from collections.abc import Mapping
from typing import Any, TypeAlias

Schema: TypeAlias = Mapping[str, Any]
Objects: TypeAlias = Mapping[str, Schema]
"""All objects of a schema, by name."""

_ONE = {
    "number": "number",
    "integer": "whole number",
    "string": "text",
    "boolean": "`true` or `false`",
    "null": "`null`",
}
_MANY = _ONE | {"number": "numbers", "integer": "whole numbers", "string": "texts"}
_MODULES = "app__schemas__"
"""What the names of objects begin with where two modules have one of the same name."""
_WORD_BEGINS = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


def component(reference: str) -> str:
    """The name of the object that a `$ref` leads to."""
    return reference.rsplit("/", 1)[-1]


def anchor(kind: str, *names: str) -> str:
    """The name of a place in the reference: `anchor("object", "InverseRequest")` → `object-inverse-request`.

    Args:
        kind: Of what stands there: `operation`, `object`, `field`, `problem`, `setting`.
        names: Of the thing itself, from the outermost one.
    """
    joined = "-".join([kind, *(_WORD_BEGINS.sub("-", name.removeprefix(_MODULES)) for name in names)])
    return joined.replace("__", "-").replace("_", "-").lower()


def place(name: str) -> str:
    """What a link can lead to."""
    return f'<a id="{name}"></a>'


def defined(anchor: str, name: str, kind: str, meaning: str) -> str:
    """An entry of a list of definitions."""
    return f"- {place(anchor)}**`{name}`** {kind}" + (f"\\\n  {meaning}" if meaning else "")


def linked(name: str) -> str:
    """The name of an object as a link to its fields."""
    return f"[{shown(name)}](#{anchor('object', name)})"


def shown(name: str) -> str:
    """The name of an object without the module that tells it from another one of that name."""
    return name.rsplit("__", 1)[-1]


def words(schema: Schema) -> str:
    """What a value may be, with its limits."""
    return _words(schema, is_many=False)


def _words(schema: Schema, is_many: bool) -> str:
    match schema:
        case {"$ref": reference}:
            return linked(component(reference))
        case {"const": value}:
            return _code(value)
        case {"enum": values}:
            return f"{'of' if is_many else 'one of'} {', '.join(map(_code, values))}"
        case {"anyOf": choices} | {"oneOf": choices}:
            return _alternatives(choices, is_many)
        case {"type": "array"}:
            return _list(schema, is_many)
        case {"type": "object"}:
            return _mapping(schema, is_many)
        case {"type": "string"}:
            return _text(schema, is_many)
        case {"type": kind}:
            return (_MANY if is_many else _ONE)[kind] + _range(schema)
    return "any values" if is_many else "any value"


def _alternatives(choices: list[Schema], is_many: bool) -> str:
    found = dict.fromkeys(_words(choice, is_many) for choice in choices)
    told = " or ".join(sorted(found, key=_ONE["null"].__eq__))
    return f"({told})" if is_many and len(found) > 1 else told


def _list(schema: Schema, is_many: bool) -> str:
    count = _count(schema.get("minItems", 0), schema.get("maxItems"))
    return f"{'lists' if is_many else 'list'} of {count}{_words(schema.get('items', {}), is_many=True)}"


def _count(least: int, most: int | None) -> str:
    """How many there may be, with a space behind it; empty where nothing is said of it."""
    if most is None:
        return f"at least {least:,} " if least else ""
    if least == most:
        return f"{most:,} "
    return f"{least:,} to {most:,} " if least else f"at most {most:,} "


def _mapping(schema: Schema, is_many: bool) -> str:
    noun = "objects" if is_many else "object"
    values = schema.get("additionalProperties")
    if not isinstance(values, Mapping) or "properties" in schema:
        return noun
    count = _count(schema.get("minProperties", 0), schema.get("maxProperties"))
    return f"{noun} of {count}{_words(values, is_many=True)} by name"


def _text(schema: Schema, is_many: bool) -> str:
    if schema.get("format") == "binary":
        return "bytes"
    noun = _MANY["string"] if is_many else _ONE["string"]
    if "pattern" in schema:
        return f"{noun} of the form `{schema['pattern']}`"
    count = _count(schema.get("minLength", 0), schema.get("maxLength"))
    return f"{noun} of {count}characters" if count else noun


def _range(schema: Schema) -> str:
    """The bounds of a number, in brackets."""
    bounds = [
        (schema.get("minimum"), "≥"),
        (schema.get("exclusiveMinimum"), ">"),
        (schema.get("maximum"), "≤"),
        (schema.get("exclusiveMaximum"), "<"),
    ]
    low, high = schema.get("minimum"), schema.get("maximum")
    if low is not None and high is not None:
        return f" from {number(low)} to {number(high)}"
    told = [f"{sign} {number(bound)}" for bound, sign in bounds if bound is not None]
    return f" {', '.join(told)}" if told else ""


def number(value: float) -> str:
    """A bound or a default as a person writes it: `-1,000,000`, `1e-06`."""
    if value == int(value):
        return f"{int(value):,}".replace("-", "−")
    return f"{value:g}".replace("-", "−", 1) if value < 0 else f"{value:g}"


def _code(value: object) -> str:
    return f"`{json.dumps(value, ensure_ascii=False)}`"


def fields(owner: str, schema: Schema, objects: Objects) -> str:
    """The fields of an object as a list.

    Args:
        owner: Name of the object.
        schema: Its own.
        objects: All objects, by name.
    """
    required = schema.get("required", ())
    entries = schema.get("properties", {}).items()
    return "\n\n".join(field(owner, name, entry, objects, name in required) for name, entry in entries)


def field(owner: str, name: str, schema: Schema, objects: Objects, is_required: bool, *places: str) -> str:
    """A field: its name, what it may be, whether it is needed, what it means.

    Args:
        owner: Name of the object or the operation that has it.
        name: Its own.
        schema: Of its value.
        objects: All objects, by name.
        is_required: Whether it must be there.
        places: Where it stands, in words, if not in the object.
    """
    told = [words(schema), *places]
    if "default" in schema:
        told.append(f"default {_code(schema['default'])}")
    elif is_required:
        told.append("required")
    meaning = " ".join(_meaning(schema, objects).split())
    return defined(anchor("field", owner, name), name, "; ".join(told), meaning)


def _meaning(schema: Schema, objects: Objects) -> str:
    """What a field is, or where it does not say so, what the first object is that it may hold."""
    match schema:
        case {"description": str(description)}:
            return description
        case {"$ref": reference}:
            return _meaning(objects[component(reference)], objects).partition("\n\n")[0]
        case {"items": items}:
            return _meaning(items, objects)
        case {"anyOf": choices} | {"oneOf": choices}:
            return next(filter(None, (_meaning(choice, objects) for choice in choices)), "")
    return ""
