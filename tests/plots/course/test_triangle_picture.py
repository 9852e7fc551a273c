"""Pictures of triangles: that each shows its corners where they are."""

import math

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from gelenk.course.triangle.triangle import solved_triangle
from gelenk.plots.course.triangle import triangle_picture
from gelenk.plots.figure import PictureFormat


def test_both_triangles_are_drawn_with_their_corners(monkeypatch: pytest.MonkeyPatch) -> None:
    figures: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        figures.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    found = solved_triangle({"a": 3.0, "b": 4.0, "alpha": 0.6})
    triangle_picture(found, "svg")
    for axes, triangle in zip(figures[0].axes, found.triangles, strict=True):
        (area,) = (patch for patch in axes.patches if isinstance(patch, Polygon))
        np.testing.assert_allclose(area.get_xy()[:3], triangle.corners)
        assert {"A", "B", "C", "a", "b", "c"} <= {text.get_text() for text in axes.texts}
    assert "c = 5.276 m" in figures[0].texts[0].get_text()


@pytest.mark.parametrize("given", [{"a": 1.0, "b": 2.0, "c": 3.0}, {"a": 1.0, "b": 1.0, "gamma": 1e-6}])
def test_a_slender_triangle_is_drawn(given: dict[str, float]) -> None:
    assert triangle_picture(solved_triangle(given), "png").startswith(b"\x89PNG")
    assert math.isfinite(solved_triangle(given).triangles[0].area)
