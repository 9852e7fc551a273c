"""Pictures of planar workspaces: that they show what is computed, and never fail."""

from collections.abc import Sequence
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Annulus, Circle

from gelenk.course.planar import planar_workspace
from gelenk.plots.figure import PictureFormat
from gelenk.plots.planar_workspace import planar_workspace_picture


def drawn(monkeypatch: pytest.MonkeyPatch, links: Sequence[float], point: Sequence[float] | None) -> Figure:
    """What is drawn, instead of its bytes."""
    figures: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        figures.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    planar_workspace_picture(planar_workspace(links), point, "svg")
    return figures[0]


def radii(figure: Figure) -> list[tuple[float, float]]:
    """Inner and outer radius of each ring."""
    found = []
    for patch in figure.axes[0].patches:
        if isinstance(patch, Annulus):
            found.append((float(patch.radii[0] - patch.width), float(patch.radii[0])))
        elif isinstance(patch, Circle):
            found.append((0.0 if patch.get_fill() else patch.radius, patch.radius))
    return found


def words(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.texts)


def test_a_disc_within_a_ring(monkeypatch: pytest.MonkeyPatch) -> None:
    figure = drawn(monkeypatch, (1.0, 0.9, 0.5), (0.3, 0.4))
    np.testing.assert_allclose(radii(figure), [(0.0, 2.4), (0.0, 0.4), (0.6, 1.4)], atol=1e-12)
    assert "0 to 0.4 m and 0.6 to 1.4 m" in words(figure)
    assert "93.62 % of all orientations" in words(figure)
    arm = next(line for line in figure.axes[0].lines if len(np.atleast_1d(line.get_xdata())) == 4)
    corners = np.column_stack((np.asarray(arm.get_xdata()), np.asarray(arm.get_ydata())))
    np.testing.assert_allclose(np.hypot(*np.diff(corners, axis=0).T), [1.0, 0.9, 0.5])
    np.testing.assert_allclose(corners[-1], [0.3, 0.4])


@pytest.mark.parametrize(
    ("links", "point", "rings", "text"),
    [
        ((1.0, 0.7), (0.9, 0.8), [(0.3, 1.7)], "2 orientations"),
        ((1.0, 0.7), (1.7, 0.0), [(0.3, 1.7)], "one orientation"),
        ((1.0, 0.7), (2.0, 0.0), [(0.3, 1.7)], "not reached"),
        ((1.0, 0.7), None, [(0.3, 1.7)], "nowhere"),
        ((1.0, 1.0), (0.0, 0.0), [(0.0, 2.0)], "the base alone"),
        ((0.6, 0.2, 0.2), None, [(0.2, 1.0), (0.6, 0.6)], "a circle at 0.6 m"),
        ((0.0, 0.0), None, [], "the base alone"),
    ],
)
def test_rings_of_every_kind(
    monkeypatch: pytest.MonkeyPatch,
    links: Sequence[float],
    point: Sequence[float] | None,
    rings: list[tuple[float, float]],
    text: str,
) -> None:
    figure = drawn(monkeypatch, links, point)
    assert len(radii(figure)) == len(rings)
    assert np.allclose(radii(figure), rings, atol=1e-12)
    assert text in words(figure)


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("links", "point"),
    [
        ((1.0, 0.9, 0.5), (0.3, 0.2)),
        ((0.0, 0.0), (0.0, 0.0)),
        ((5e-324, 1e-300, 0.0), None),
        ((1e6, 1e6, 1e6), (-1e6, 1e6)),
        ((1e6, 1e-9), (0.0, 1e-9)),
        ((1e-9, 2e-9), (1e6, 0.0)),
    ],
    ids=str,
)
def test_pictures_of_every_size(links: Sequence[float], point: Sequence[float] | None) -> None:
    svg = planar_workspace_picture(planar_workspace(links), point, "svg")
    assert ElementTree.fromstring(svg).tag.endswith("svg")
    assert b"NaN" not in svg
    assert b"nan" not in svg
    pixels = imread(BytesIO(planar_workspace_picture(planar_workspace(links), point, "png")))
    assert pixels.std() > 0.01
