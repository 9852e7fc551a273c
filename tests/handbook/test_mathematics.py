"""Formulas become SVG that needs nothing beside it."""

import re
import warnings
from xml.etree import ElementTree

import pytest

from gelenk.course.steps import table

with warnings.catch_warnings():
    # ziafont opens its fonts by a function that Python 3.11 and 3.12 call deprecated, and 3.13 no longer.
    warnings.simplefilter("ignore", DeprecationWarning)
    from docs.handbook.mathematics import drawn


def width(latex: str) -> float:
    found = re.search(r"width:([\d.]+)em", drawn(latex, True, set()))
    assert found is not None
    return float(found[1])


def test_a_formula_is_drawn_in_the_colour_of_the_text_and_stands_on_its_line() -> None:
    svg = drawn(r"\dot q = J^{-1} v", False, set())
    assert ElementTree.fromstring(svg.replace(" style=", " xmlns='http://www.w3.org/2000/svg' style=")) is not None
    assert "currentColor" in svg
    assert "black" not in svg
    assert re.search(r"vertical-align:-?\d", svg)
    assert 'aria-label="\\dot q = J^{-1} v"' in svg
    assert not re.search(r"(src|href)=\"(?!#)", svg)


def test_a_glyph_is_written_once_a_page() -> None:
    known: set[str] = set()
    first, second = drawn("q", False, known), drawn("q", False, known)
    assert first.count("<symbol") == 1
    assert second.count("<symbol") == 0
    assert re.findall('href="(#[^"]+)"', first) == re.findall('href="(#[^"]+)"', second) != []


def test_what_follows_the_empty_glyph_of_a_space_is_drawn_too() -> None:
    known: set[str] = set()
    both = drawn(r"\cos x", False, known) + drawn(r"\tan x", False, known)
    assert set(re.findall(r'href="#([^"]+)"', both)) == set(re.findall(r'symbol id="([^"]+)"', both))


def test_a_sign_stands_next_to_its_number() -> None:
    assert width("x = -1") < width("x - 1 =")
    assert width(r"\begin{bmatrix} 1 & -1 \end{bmatrix}") < width(r"\begin{bmatrix} 1 & 1 - 1 \end{bmatrix}")


def test_a_function_stands_apart() -> None:
    assert width(r"\det R") > width(r"\mathrm{det}R") + 0.1
    assert width(r"a\sin q") > width(r"a\sin(q)") - width("()") + 0.1


def test_what_cannot_be_read_is_refused() -> None:
    with pytest.raises(ValueError, match="cannot be set"):
        drawn(r"\begin{pmatrix} 1", True, set())


def test_a_row_that_ends_with_an_empty_cell_is_drawn() -> None:
    known: set[str] = set()
    drawn(table(["k", "e"], [["1", "2"], ["3", ""]], "rr"), True, known)
    assert len(known) == len("ke123")
