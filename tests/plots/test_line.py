"""Pictures of laws along a line and of a planar arm's samples: that they show what is computed."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from gelenk.course.cartesian.line import LineLaw, along_line
from gelenk.course.cartesian.pipeline import pipeline
from gelenk.course.cartesian.planar_line import planar_line
from gelenk.plots.figure import PictureFormat
from gelenk.plots.motion.line import line_picture
from gelenk.plots.motion.pipeline import pipeline_picture


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """What is drawn, instead of its bytes."""
    drawn: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        drawn.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    return drawn


def test_bang_coast_bang_with_its_limits(figures: list[Figure]) -> None:
    found = along_line(np.zeros(2), np.array([2.0, 0.0]), LineLaw(0.8, 1.6))
    line_picture(found.length, found.law, (0.8, 1.6), "svg")
    distance, speed, acceleration = figures[0].axes
    assert np.asarray(distance.lines[0].get_ydata())[[0, -1]] == pytest.approx([0.0, 2.0])
    assert np.asarray(speed.lines[0].get_ydata()).max() == pytest.approx(0.8)
    assert set(np.round(np.asarray(acceleration.lines[0].get_ydata()), 9)) == {1.6, 0.0, -1.6}
    assert [text.get_text() for text in distance.texts] == ["0.5", "2.5"]
    assert [text.get_text() for text in (*speed.texts, *acceleration.texts)] == ["v", "a", "-a"]


def test_an_arm_at_its_samples(figures: list[Figure]) -> None:
    line = planar_line((1.0, 0.7), np.array([0.3, 0.8]), np.array([-0.4, 0.9]))
    found = pipeline(line, np.linspace(0.0, 1.0, 5), 2.0)
    pipeline_picture(found, "svg")
    plane, _, _, deviation = figures[0].axes
    ellipses = [one for one in plane.patches if isinstance(one, Ellipse)]
    points = line.points(found.shares)
    np.testing.assert_allclose([one.get_center() for one in ellipses], np.column_stack((points.real, points.imag)))
    areas = np.array([one.width * one.height for one in ellipses])
    np.testing.assert_allclose(areas / areas[0], np.abs(found.line.determinants(found.configurations)) / 0.50214926363)
    largest = np.abs(np.asarray(deviation.lines[0].get_ydata())).max()
    assert largest == pytest.approx(1e3 * abs(found.largest_deviation().value), rel=1e-3)
