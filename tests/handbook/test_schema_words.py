"""What a schema allows is told in words."""

from typing import Any

import pytest

from docs.handbook.schema_words import anchor, fields, words

NUMBER = {"type": "number", "minimum": -1, "maximum": 1e6}


@pytest.mark.parametrize(
    ("schema", "told"),
    [
        (NUMBER, "number from −1 to 1,000,000"),
        ({"type": "number", "exclusiveMinimum": 0, "maximum": 0.5}, "number > 0, ≤ 0.5"),
        ({"type": "integer", "minimum": 1}, "whole number ≥ 1"),
        ({"type": "boolean"}, "`true` or `false`"),
        ({"type": "string"}, "text"),
        ({"type": "string", "minLength": 1, "maxLength": 128}, "text of 1 to 128 characters"),
        ({"type": "string", "pattern": "^[a-z]$"}, "text of the form `^[a-z]$`"),
        ({"type": "string", "format": "binary"}, "bytes"),
        ({"const": "line", "type": "string"}, '`"line"`'),
        ({"enum": ["one", "all"], "type": "string"}, 'one of `"one"`, `"all"`'),
        ({"type": "array", "items": NUMBER, "minItems": 3, "maxItems": 3}, "list of 3 numbers from −1 to 1,000,000"),
        ({"type": "array", "items": {"$ref": "#/c/Pose"}, "maxItems": 64}, "list of at most 64 [Pose](#object-pose)"),
        ({"type": "array", "items": {"enum": ["x", "y"]}, "minItems": 1}, 'list of at least 1 of `"x"`, `"y"`'),
        (
            {"type": "array", "items": {"type": "array", "items": {"anyOf": [{"type": "null"}, {"type": "number"}]}}},
            "list of lists of (numbers or `null`)",
        ),
        ({"anyOf": [{"type": "null"}, {"type": "number"}, {"type": "string"}]}, "number or text or `null`"),
        (
            {"type": "object", "additionalProperties": {"type": "number"}, "maxProperties": 2},
            "object of at most 2 numbers by name",
        ),
        ({"type": "object", "additionalProperties": True}, "object"),
        ({}, "any value"),
    ],
)
def test_a_value(schema: dict[str, Any], told: str) -> None:
    assert words(schema) == told


def test_anchors_do_not_change() -> None:
    assert anchor("operation", "inverse_kinematics") == "operation-inverse-kinematics"
    assert anchor("object", "InverseRequest") == "object-inverse-request"
    assert anchor("field", "InverseRequest", "position_tolerance") == "field-inverse-request-position-tolerance"


def test_a_field_says_what_it_is_or_what_it_holds() -> None:
    objects = {"Pose": {"description": "A pose.\n\nLonger."}}
    schema = {
        "required": ["targets"],
        "properties": {
            "targets": {"type": "array", "items": {"$ref": "#/c/Pose"}},
            "seed": {"type": "integer", "default": 0, "description": "Of the\nsearch."},
        },
    }
    assert fields("Call", schema, objects) == (
        '- <a id="field-call-targets"></a>**`targets`** list of [Pose](#object-pose); required\\\n  A pose.\n\n'
        '- <a id="field-call-seed"></a>**`seed`** whole number; default `0`\\\n  Of the search.'
    )
