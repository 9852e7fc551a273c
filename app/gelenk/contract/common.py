"""The strict base of all payloads, and what many of them share."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from gelenk.model.arrays import Array


def as_lists(value: Any) -> Any:
    """Arrays, and other sequences and mappings, as lists and dicts, whatever they hold."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Mapping):
        return {name: as_lists(item) for name, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str | bytes | bytearray):
        return [as_lists(item) for item in value]
    return value


@dataclass(frozen=True, slots=True)
class OnTheWire:
    """What JSON has for a field; its annotation says what Python may give for it, and the core takes.

    So a checker of types lets arrays and tuples pass, and the schema of the API knows nothing of them.

    Attributes:
        kind: Of JSON.
        of_python: What turns a value that Python gives into one.
    """

    kind: Any
    of_python: Callable[[Any], Any] = as_lists

    def __get_pydantic_core_schema__(self, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """JSON is read as before, and no slower."""
        wire = handler.generate_schema(self.kind)
        return core_schema.json_or_python_schema(
            wire, core_schema.no_info_before_validator_function(self.of_python, wire)
        )


Vectors: TypeAlias = Sequence[Sequence[float] | Array] | Array
"""What Python may give for rows of numbers; shape (N, m)."""


class Shown(BaseModel):
    """A model that is shown at a prompt in a few lines, however much it holds."""

    def __repr_args__(self) -> Iterator[tuple[str | None, Any]]:
        """What is there, long lists by their first entries."""
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
        told = repr(value)
        return told if not isinstance(value, str) or len(told) <= _LONGEST_SHOWN else f"{told[:_LONGEST_SHOWN]}...'"


_MOST_SHOWN, _FIRST_SHOWN = 12, 3
"""Entries of a list that are all shown, and of a longer one its first."""
_LONGEST_SHOWN = 300


class Payload(Shown):
    """The base of all requests: no unknown fields, no NaN, no text for numbers."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True, allow_inf_nan=False)

    list_fields: ClassVar[frozenset[str]] = frozenset()
    """Fields that a query string gives by repeating their name."""
    vector_fields: ClassVar[frozenset[str]] = frozenset()
    """Fields that it gives so, or once where they are one word."""
    object_fields: ClassVar[frozenset[str]] = frozenset()
    """Fields that it gives as JSON."""


class Answer(Shown):
    """The base of all answers."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


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

    base_frame: FrameName | None = Field(
        default=None, description="Frame in which poses are expressed; the default chain's if left out."
    )
    tip_frame: FrameName | None = Field(
        default=None, description="Frame whose pose is computed; the default chain's if left out."
    )
