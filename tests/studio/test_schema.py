"""The types that the studio takes from the OpenAPI document."""

import pytest

from studio.schema import declarations, type_of

_OPTIONAL = {"anyOf": [{"$ref": "#/components/schemas/Pose"}, {"type": "null"}]}
_SCHEMAS = {
    "Pose": {"type": "object", "properties": {"position": {"type": "array", "items": {"type": "number"}}}},
    "Answer": {"type": "object", "properties": {"pose": _OPTIONAL, "rank": {"type": "integer"}}, "required": ["rank"]},
    "Other": {"type": "string"},
}


def test_declares_what_is_named_and_what_that_refers_to() -> None:
    text = declarations(_SCHEMAS, {"Answer"})
    assert "export type Answer = { pose?: Pose | null; rank: number };" in text
    assert "export type Pose = { position?: number[] };" in text
    assert "Other" not in text


def test_refuses_a_name_that_the_document_does_not_have() -> None:
    with pytest.raises(KeyError, match="Missing"):
        declarations(_SCHEMAS, {"Missing"})


def test_lists_of_alternatives_and_words() -> None:
    words = {"type": "string", "enum": ["x", "y"]}
    assert type_of({"type": "array", "items": words}) == '("x" | "y")[]'
    assert type_of({"type": "object", "additionalProperties": words}) == 'Record<string, "x" | "y">'
    assert type_of({"type": "object", "properties": {"type": {"const": "box"}}}) == '{ type: "box" }'
