"""Results of the core that are part of an answer as they are, described by their docstring."""

import inspect
import re
from collections.abc import Callable
from typing import Any, ClassVar

_ATTRIBUTE = re.compile(r"^ {4}(\w+): (.*(?:\n {8}.*)*)", re.MULTILINE)


class Result:
    """The base of the dataclasses that are part of an answer, so that each is declared and described once.

    The docstring becomes the description in the API's schema, its section "Attributes" that of the fields. This class
    only offers what pydantic looks for, and does not import it.
    """

    __slots__ = ()
    __pydantic_config__: ClassVar[dict[str, Any]] = {"extra": "forbid", "allow_inf_nan": False}

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: Any, handler: Callable[[Any], dict[str, Any]]) -> dict[str, Any]:
        """Return the JSON schema, with the descriptions that the docstring gives, and those of inherited fields."""
        reference = handler(schema)
        whole: dict[str, Any] = handler.resolve_ref_schema(reference)  # type: ignore[attr-defined]
        for each in reversed(cls.__mro__[: cls.__mro__.index(Result)]):
            text, _, attributes = inspect.cleandoc(each.__doc__ or "").partition("\n\nAttributes:\n")
            whole["description"] = text
            for name, description in _ATTRIBUTE.findall(attributes):
                whole["properties"][name]["description"] = re.sub(r"\s+", " ", description)
        return reference
