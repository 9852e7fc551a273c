"""A matrix in the clipboard is the same matrix where it is pasted."""

import io
import json
import re

import numpy as np
import pytest

from tests.studio.browser import Studio
from tests.studio.pure import values

MATRIX = [[0.1, -2.5e-17, 1 / 3], [-1e6, 0.0, 7.0]]


@pytest.mark.slow
def test_other_programs_read_it_to_the_last_digit() -> None:
    """NumPy's readers of its own code, of MATLAB's brackets and of CSV; of LaTeX the digits that are shown."""
    forms = ["NumPy", "MATLAB", "CSV", "LaTeX"]
    numpy, matlab, csv, latex = values("ui/matrices.ts", [f"m.matrixText({MATRIX}, '{form}')" for form in forms])
    assert numpy.startswith("np.array(")
    assert json.loads(numpy.removeprefix("np.array(").removesuffix(")")) == MATRIX
    with pytest.warns(PendingDeprecationWarning):
        read = np.matrix(matlab)
    assert read.tolist() == MATRIX
    assert np.loadtxt(io.StringIO(csv), delimiter=",").tolist() == MATRIX
    inside = re.fullmatch(r"\\begin{bmatrix} (.*) \\end{bmatrix}", latex)
    assert inside is not None
    shown = [[float(cell) for cell in row.split("&")] for row in inside[1].split(r"\\")]
    assert shown == [[pytest.approx(number, abs=5e-5) for number in row] for row in MATRIX]


@pytest.mark.slow
@pytest.mark.parametrize(("panel", "name"), [("pose", "Homogeneous"), ("jacobian", "the Jacobian")])
def test_it_is_copied_from_the_page(studio: Studio, panel: str, name: str) -> None:
    studio.open(panel, robot="planar_2r", q="0.3,0.8")
    if panel == "pose":
        studio.page.locator("summary", has_text="As matrices").click()
    else:
        studio.until("document.querySelector('[data-jacobian]')")
    copy = studio.page.get_by_role("button", name=re.compile(f"Copy {name} as NumPy", re.IGNORECASE))
    copied = studio.copied(copy)
    shown = studio.page.locator("[data-matrix], [data-jacobian]").first
    whole = shown.get_attribute("data-matrix") or shown.get_attribute("data-jacobian")
    assert whole is not None
    assert json.loads(copied.removeprefix("np.array(").removesuffix(")")) == json.loads(whole)
