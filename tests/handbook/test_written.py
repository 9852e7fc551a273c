"""Values as the handbook writes them, and what it takes for the same value."""

import numpy as np
import pytest

from docs.handbook.written import disagreement, in_line, same, written


def test_numbers_have_significant_digits() -> None:
    assert written(0.502149263630, 4) == "0.5021"
    assert written([1.0, 1e-17, "z", None, True, 12]) == "[1, 0, z, None, True, 12]"
    assert written(1.5e-16, 2) == "1.5e-16"


def test_columns_of_a_matrix_stand_in_line() -> None:
    assert written(np.array([[-0.91936, -0.62384], [1.27285, 1e-18]]), 3) == "[-0.92  -0.62]\n[ 1.27      0]"
    assert written([[1, 20], [300, 4]]) == "[  1  20]\n[300   4]"
    assert written(np.zeros((2, 2))) == "[0  0]\n[0  0]"
    assert written(np.array([[3.0, -1e-7]]).repeat(2, 0), 3) == "[3.00  0.00]\n[3.00  0.00]"


def test_an_object_is_written_by_its_fields() -> None:
    value = {"status": "solved", "solutions": [{"q": [0.1, 0.2], "branch": {"elbow": "up"}}], "empty": []}
    lines = ["status: solved", "solutions:", "  - q: [0.1, 0.2]", "    branch:", "      elbow: up", "empty: []"]
    assert written(value) == "\n".join(lines)


def test_what_is_printed_stays_in_its_line() -> None:
    assert in_line({"status": "solved", "rings": [[0.0, 0.4], [0.6, 1.4]]}) == (
        "{status: solved, rings: [[0, 0.4], [0.6, 1.4]]}"
    )
    assert in_line([1.0, 1e-17]) == "[1, 0]"
    assert in_line("text") == "text"


@pytest.mark.parametrize(
    ("stated", "value"),
    [
        ("0.5021", 0.50214926),
        ("−0.50", -0.502),
        ("2", 2),
        ("1.2e-3", 0.00123),
        ("[0.11, 1.60]", np.array([0.1065, 1.599])),
        ("(1.0, 2.0) and (3.0, 4.0)", [[1.0, 2.0], [3.0, 4.0]]),
        ("0.5", 0.45),
        ("structure", "structure"),
        ("True", True),
        ("2.50 m/s^2", 2.5),
    ],
)
def test_what_rounds_to_the_written_digits_agrees(stated: str, value: object) -> None:
    assert disagreement(stated, value) is None


@pytest.mark.parametrize(
    ("stated", "value"),
    [
        ("0.5021", 0.50221),
        ("0.50", -0.50),
        ("2", 3),
        ("[0.11, 1.60]", [0.1065]),
        ("[0.11]", [0.1065, 1.599]),
        ("structure", "mechanism"),
        ("True", False),
        ("many", 2),
    ],
)
def test_anything_else_does_not(stated: str, value: object) -> None:
    difference = disagreement(stated, value)
    assert difference is not None
    assert repr(stated) in difference


def test_texts_are_the_same_up_to_rounding() -> None:
    assert same("error: 1.1e-16 m\n[1.2729  0]", "error: -2.2e-16 m\n[1.2730    0]")
    assert not same("error: 1.1e-16 m", "error: 1.1e-6 m")
    assert not same("x: 1.27", "x: 1.28")
    assert not same("x: 1.27", "y: 1.27")
    assert not same("1 2", "1")


def test_where_rounding_is_largest_differs_between_processors() -> None:
    peak = '{{"value": {}, "joint": "joint_{}", "time": {}}}'
    assert same(peak.format("2.2e-16", 1, 0.3), peak.format("1.1e-16", 2, 0.4))
    assert not same(peak.format("2.2e-6", 1, 0.3), peak.format("2.2e-6", 1, 0.4))
    assert not same(peak.format("2.2e-6", 1, 0.3), peak.format("2.2e-6", 2, 0.3))
