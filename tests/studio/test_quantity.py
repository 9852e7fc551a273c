"""Numbers as people type them."""

import math

import pytest

from tests.studio.pure import values

TYPED = ["90", "-180", "6.3", "6.28", "90°", "90 rad", "3pi", "pi/2", "1.5", "9,5", "x", ""]
DEGREES = "{millimetres: true, degrees: true}"
TURNS = {"90": 90, "-180": -180, "6.3": 6.3, "9,5": 9.5}


def test_a_bare_angle_of_more_than_a_turn_may_be_degrees() -> None:
    """Not where a unit or a π says what is meant, nor where degrees are typed anyhow."""
    found = values("ui/quantity.ts", [f"m.ifDegrees('{text}', m.SI)" for text in TYPED])
    assert dict(zip(TYPED, found, strict=True)) == {
        text: pytest.approx(math.radians(TURNS[text])) if text in TURNS else None for text in TYPED
    }
    assert values("ui/quantity.ts", [f"m.ifDegrees('{text}', {DEGREES})" for text in ("90", "700")]) == [None, None]


def test_what_is_measured_follows_from_the_unit() -> None:
    """Rates of lengths and angles too; no area, no force, no time: another unit of length would change these."""
    kinds = {
        "length": ["m", "m/s", "m/s²", "m/s³"],
        "angle": ["rad", "rad/s", "rad/s²"],
        "number": ["", "s", "N", "N m", "m²", "kg", "°", "mm"],
    }
    units = [unit for units in kinds.values() for unit in units]
    found = values("ui/quantity.ts", [f"m.kindOfUnit('{unit}')" for unit in units])
    assert dict(zip(units, found, strict=True)) == {unit: kind for kind, units in kinds.items() for unit in units}


def test_a_time_is_no_length() -> None:
    texts = ["m.parse('5 m', 'length', m.SI)", "m.parse('5 m', 'number', m.SI)", f"m.parse('5', 'number', {DEGREES})"]
    assert values("ui/quantity.ts", texts) == [5, None, 5]
    calls = ("m.format(90, 'number'", "m.exact(0.5, 'number'", "m.unitOf('number'")
    shown = [f"{call}, {DEGREES})" for call in calls]
    assert values("ui/quantity.ts", shown) == ["90", "0.5", ""]
