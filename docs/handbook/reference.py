"""The reference as Markdown, written from the service's schema: operations by their group, each with its objects.

An object stands below the first operation that takes it or answers with it; every other place links to it.
"""

from collections.abc import Iterator, Mapping
from functools import cached_property
from http import HTTPStatus
from typing import Any

from docs.handbook.operations import Entry, described, entries
from docs.handbook.schema_words import anchor, component, fields, place, shown, words

GROUPS = ("Kinematics", "DH tables", "Robots", "Scenes", "Course", "Jobs", "Service")
"""In the order in which objects are looked for: the first group that uses one has it."""


class Reference:
    """What the service can be asked.

    Args:
        schema: Of OpenAPI.
    """

    def __init__(self, schema: Mapping[str, Any]) -> None:
        self._objects = schema["components"]["schemas"]
        self._entries = entries(schema)

    def group(self, name: str) -> str:
        """All operations of a group, each followed by the objects that stand below it."""
        return "\n\n".join(
            "\n\n".join([described(entry, self._objects), *self._below(entry)]) for entry in self._of_group(name)
        )

    def object(self, name: str, level: int = 3) -> str:
        """The fields of an object below its name, a heading of a level."""
        schema = self._objects[name]
        head = f"{place(anchor('object', name))}\n\n{'#' * level} {shown(name)}"
        content = fields(name, schema, self._objects) if "properties" in schema else f"A value of it: {words(schema)}."
        return "\n\n".join([head, schema.get("description", ""), content])

    def _below(self, entry: Entry) -> Iterator[str]:
        return (self.object(name) for name, home in self._homes.items() if home == entry.id)

    @cached_property
    def _homes(self) -> Mapping[str, str]:
        """By the name of an object the operation that it stands below."""
        homes: dict[str, str] = {}
        for entry in (entry for group in GROUPS for entry in self._of_group(group)):
            # Where a job is begun, it is no more than the way to what was asked for.
            answers = [answer for status, answer in entry.answers if status != HTTPStatus.ACCEPTED]
            for name in self._named([entry.bodies, answers], {}):
                homes.setdefault(name, entry.id)
        return homes

    def _of_group(self, name: str) -> list[Entry]:
        return [entry for entry in self._entries if name in entry.content["tags"]]

    def _named(self, part: Any, found: dict[str, None]) -> dict[str, None]:
        """The names of all objects that a part of the schema leads to, in the order of reading."""
        if isinstance(part, Mapping):
            name = component(str(part.get("$ref", "")))
            if name and name not in found:
                found[name] = None
                self._named(self._objects[name], found)
            part = list(part.values())
        if isinstance(part, list):
            for item in part:
                self._named(item, found)
        return found
