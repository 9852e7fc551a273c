"""Writes `src/schema.ts`: the types of what travels over the API, from the service's OpenAPI document.

It holds the schemas that `src/types.ts` takes as `api.Name`, and those they refer to. `./dev studio` runs it.
"""

import json
import re
import sys
from pathlib import Path
from typing import Any

from gelenk.main import create_app
from gelenk.settings import Settings

SOURCES = Path(__file__).parent / "src"
_TAKEN = re.compile(r"\bapi\.(\w+)")
_REFERENCE = "#/components/schemas/"
_WORDS = {"number": "number", "integer": "number", "string": "string", "boolean": "boolean", "null": "null"}


def main() -> None:
    """Write the types to the file that is named, in a form that Prettier still has to lay out."""
    document = create_app(Settings(data_dir=Path("unused"))).openapi()
    taken = set(_TAKEN.findall((SOURCES / "types.ts").read_text("utf-8")))
    Path(sys.argv[1]).write_text(declarations(document["components"]["schemas"], taken), encoding="utf-8")


def declarations(schemas: dict[str, Any], names: set[str]) -> str:
    """Return the declarations of these schemas and of all that they refer to, sorted by name.

    Raises:
        KeyError: The document has no such schema.
    """
    missing, found = set(names), dict[str, str]()
    while missing:
        name = missing.pop()
        found[name] = f"export type {name} = {type_of(schemas[name])};"
        referred = re.findall(rf'"{_REFERENCE}([^"]+)"', json.dumps(schemas[name]))
        missing |= set(referred) - found.keys()
    head = "/** Made by `./dev studio` from the OpenAPI document, which describes each field; not to be edited. */"
    return "\n\n".join([head, *(found[name] for name in sorted(found))]) + "\n"


def type_of(schema: dict[str, Any]) -> str:
    """Return a schema as a type of TypeScript."""
    if "$ref" in schema:
        return str(schema["$ref"]).removeprefix(_REFERENCE)
    if choices := schema.get("anyOf") or schema.get("oneOf"):
        return " | ".join(dict.fromkeys(type_of(choice) for choice in choices))
    if words := schema.get("enum") or ([schema["const"]] if "const" in schema else []):
        return " | ".join(json.dumps(word) for word in words)
    match schema.get("type"):
        case "array":
            item = type_of(schema["items"])
            return f"{item}[]" if re.fullmatch(r"[\w\[\]]+", item) else f"({item})[]"
        case "object" if "properties" in schema:
            return f"{{ {'; '.join(_field(schema, name) for name in schema['properties'])} }}"
        case "object":
            values = schema.get("additionalProperties")
            return f"Record<string, {type_of(values) if isinstance(values, dict) else 'unknown'}>"
        case str(word):
            return _WORDS[word]
    return "unknown"


def _field(schema: dict[str, Any], name: str) -> str:
    """Return a property; one that is always the same word is never left out, as what tells shapes from each other."""
    field = schema["properties"][name]
    mark = "" if name in schema.get("required", ()) or "const" in field else "?"
    return f"{name}{mark}: {type_of(field)}"


if __name__ == "__main__":
    main()
