"""A dataclass of the core in the schema of an answer: described by its docstring, and strict."""

from dataclasses import dataclass

import orjson
import pytest
from pydantic import TypeAdapter, ValidationError

from gelenk.robot.result import Result


@dataclass(frozen=True, slots=True)
class Span(Result):
    """A stretch of a joint's range.

    Both ends belong to it.

    Attributes:
        joint: Name of the joint.
        lower: Where it begins,
            [rad or m].
        upper: Where it ends; null if it does not.
    """

    joint: str
    lower: float
    upper: float | None = None


def test_the_docstring_describes_the_class_and_its_fields() -> None:
    schema = TypeAdapter(list[Span]).json_schema()
    span = schema["$defs"]["Span"]
    assert span["description"] == "A stretch of a joint's range.\n\nBoth ends belong to it."
    described = {name: field["description"] for name, field in span["properties"].items()}
    assert described == {
        "joint": "Name of the joint.",
        "lower": "Where it begins, [rad or m].",
        "upper": "Where it ends; null if it does not.",
    }
    assert (span["additionalProperties"], span["required"]) == (False, ["joint", "lower"])


@dataclass(frozen=True, slots=True)
class LimitedSpan(Span):
    """A stretch with a limit.

    Attributes:
        lower: Where it begins, at the limit.
        limit: Largest speed in it, [rad/s].
    """

    limit: float | None = None


def test_what_a_base_describes_holds_where_the_class_says_nothing_else() -> None:
    span = TypeAdapter(list[LimitedSpan]).json_schema()["$defs"]["LimitedSpan"]
    described = {name: field["description"] for name, field in span["properties"].items()}
    assert span["description"] == "A stretch with a limit."
    assert described == {
        "joint": "Name of the joint.",
        "lower": "Where it begins, at the limit.",
        "upper": "Where it ends; null if it does not.",
        "limit": "Largest speed in it, [rad/s].",
    }


def test_it_is_written_as_it_is_and_read_back() -> None:
    span = Span("elbow", 0.5)
    written = orjson.dumps(span)
    assert written == b'{"joint":"elbow","lower":0.5,"upper":null}'
    assert TypeAdapter(Span).validate_json(written) == span


@pytest.mark.parametrize("more", [b'"other": 1', b'"upper": "far"', b'"upper": 1e400'])
def test_what_does_not_belong_there_is_refused(more: bytes) -> None:
    with pytest.raises(ValidationError):
        TypeAdapter(Span).validate_json(b'{"joint": "elbow", "lower": 0.5, ' + more + b"}")
