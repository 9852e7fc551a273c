"""Numbers as people type them."""

import math

import pytest

from tests.studio.pure import values

TYPED = ["90", "-180", "6.3", "6.28", "90°", "90 rad", "3pi", "pi/2", "1.5", "9,5", "x", ""]
TURNS = {"90": 90, "-180": -180, "6.3": 6.3, "9,5": 9.5}


def test_a_bare_angle_of_more_than_a_turn_may_be_degrees() -> None:
    """Not where a unit or a π says what is meant, nor where degrees are typed anyhow."""
    found = values("ui/quantity.ts", [f"m.ifDegrees('{text}', false)" for text in TYPED])
    assert dict(zip(TYPED, found, strict=True)) == {
        text: pytest.approx(math.radians(TURNS[text])) if text in TURNS else None for text in TYPED
    }
    assert values("ui/quantity.ts", ["m.ifDegrees('90', true)", "m.ifDegrees('700', true)"]) == [None, None]
