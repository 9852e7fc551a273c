"""The strict base of all payloads, and types that many of them share."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Annotated, Any, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from gelenk.robot.arrays import Array
from gelenk.robot.result import Result


def as_lists(value: Any) -> Any:
    """Convert arrays, and other sequences and mappings, to lists and dicts, at any depth."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {name: as_lists(item) for name, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str | bytes | bytearray):
        return [as_lists(item) for item in value]
    return value


@dataclass(frozen=True, slots=True)
class OnTheWire:
    """Gives a field a JSON type of its own; its annotation says what Python code may pass, and the core accepts.

    So type checkers accept arrays and tuples, and the schema of the API does not mention them.

    Attributes:
        kind: Type in JSON.
        of_python: Converts a value from Python code to this type.
    """

    kind: Any
    of_python: Callable[[Any], Any] = as_lists

    def __get_pydantic_core_schema__(self, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Build a schema that reads JSON as before, no slower, and converts values from Python code first."""
        wire = handler.generate_schema(self.kind)
        return core_schema.json_or_python_schema(
            wire, core_schema.no_info_before_validator_function(self.of_python, wire)
        )


Vectors: TypeAlias = Sequence[Sequence[float] | Array] | Array
"""Rows of numbers as Python code may pass them; shape (N, m)."""


class Shown(BaseModel):
    """A model whose `repr` takes a few lines, however much it holds."""

    def __repr_args__(self) -> Iterator[tuple[str | None, Any]]:
        """Yield the fields that are not None; lists are shortened to their first entries."""
        for name, value in super().__repr_args__():
            if value is not None:
                yield name, _Brief(value)

    def __str__(self) -> str:
        return repr(self)


@dataclass(frozen=True, slots=True)
class _Brief:
    value: Any

    def __repr__(self) -> str:
        value = self.value
        if isinstance(value, list):
            many = len(value) > _MOST_SHOWN
            shown = [repr(_Brief(item)) for item in (value[:_FIRST_SHOWN] if many else value)]
            return f"[{', '.join([*shown, f'... {len(value)} in all'] if many else shown)}]"
        if isinstance(value, dict):
            return "{" + ", ".join(f"{key!r}: {_Brief(item)!r}" for key, item in value.items()) + "}"
        if isinstance(value, Result):
            known = ((one.name, getattr(value, one.name)) for one in fields(value))  # type: ignore[arg-type]
            parts = ", ".join(f"{name}={_Brief(item)!r}" for name, item in known if item is not None)
            return f"{type(value).__name__}({parts})"
        text = repr(value)
        return text if not isinstance(value, str) or len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}...'"


_MOST_SHOWN, _FIRST_SHOWN = 12, 3
"""Longest list that is shown whole, and number of entries shown of a longer one."""
_LONGEST_SHOWN = 300


class Payload(Shown):
    """The base of all requests: no unknown fields, no NaN, no text for numbers."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)


def optional(description: str, **constraints: Any) -> Any:
    """Return a field that is None unless given; the constraints are those of pydantic's `Field`."""
    return Field(default=None, description=description, **constraints)


class Answer(Shown):
    """The base of all answers."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


def content_of(answer: type[BaseModel], found: object, **others: Any) -> dict[str, Any]:
    """Return the content of an answer: each field from `others`, or else what was found under the same name."""
    return {name: others[name] if name in others else getattr(found, name) for name in answer.model_fields}


FrameName = Annotated[str, Field(min_length=1, max_length=128, description="Name of a frame: each link has one.")]

Strict = Annotated[
    bool,
    Field(
        description="Whether to refuse a URDF for faults that do not affect kinematics (in shapes, in masses, in a "
        "fixed joint, before the XML declaration, elements repeated word for word) instead of accepting it with a "
        "warning for each."
    ),
]

RobotName = Annotated[
    str,
    Field(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]{0,63}$",
        description="1 to 64 letters, digits, `_`, `.` or `-`, the first one a letter or digit.",
        examples=["my_arm"],
    ),
]


class ChainEnds(Payload):
    """A chain, given by its two end frames."""

    base_frame: FrameName
    tip_frame: FrameName


class ChainOptions(Payload):
    """The chain a call addresses."""

    base_frame: FrameName | None = optional("Frame in which poses are expressed; the default chain's if left out.")
    tip_frame: FrameName | None = optional("Frame whose pose is computed; the default chain's if left out.")
