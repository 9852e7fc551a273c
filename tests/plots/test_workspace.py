"""Pictures of workspaces: each element shows the largest of what lies behind it, on the voxels' own places."""

import numpy as np
import pytest

from gelenk.kinematics.workspace.survey import POINT_COLUMNS, VOXEL_COLUMNS
from gelenk.plots.workspace import Picture, elements, picture_bytes
from gelenk.robot.arrays import Array

DEXTERITY = (*VOXEL_COLUMNS, "dexterity")


def picture(rows: Array, columns: tuple[str, ...] = POINT_COLUMNS, dimensions: int = 3) -> Picture:
    """A picture of some rows."""
    return Picture(
        rows, columns, "arm", ("base", "tip → $\\frac"), ("a line",), np.zeros(3), np.eye(3), dimensions, 0.1
    )


def test_an_element_shows_the_largest_value_behind_it() -> None:
    places = np.array([[0.0, 0.0], [0.0, 0.0], [2.0, 1.0], [-1.0, 0.0], [3.0, 0.0]])
    image = elements(places, np.array([0.3, 0.7, 0.1, 9.0, 9.0]), 3)
    assert image[0, 0] == 0.7
    assert image[1, 2] == 0.1
    assert np.isnan(image).sum() == 7


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("count", "dimensions", "columns"),
    [(0, 3, POINT_COLUMNS), (0, 2, DEXTERITY), (1, 3, DEXTERITY), (1, 2, POINT_COLUMNS), (2000, 3, POINT_COLUMNS)],
)
def test_whatever_there_is_can_be_drawn(count: int, dimensions: int, columns: tuple[str, ...]) -> None:
    rows = np.random.default_rng(0).random((count, len(columns)))
    first, second = (picture_bytes(picture(rows, columns, dimensions), "svg") for _ in range(2))
    assert first == second
    assert first.count(b"<image ") == (1 if dimensions == 2 else 3) + 1, "the projections and the bar of colours"


@pytest.mark.parametrize("cell", [1e-6, 100.0])
def test_the_size_of_voxels_does_not_make_a_picture_large(cell: float) -> None:
    rows = np.random.default_rng(0).uniform(-1.0, 1.0, (500, 5))
    drawn = Picture(rows, VOXEL_COLUMNS, "arm", ("a", "b"), (), np.zeros(3), np.eye(3), 3, cell)
    assert len(picture_bytes(drawn, "svg")) < 500_000


def test_a_voxel_is_one_element(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where the grid's origin is not the base's: no stripes of elements that are missed or met twice."""
    seen: list[Array] = []

    def keep(places: Array, values: Array, count: int) -> Array:
        seen.append(elements(places, values, count))
        return seen[-1]

    monkeypatch.setattr("gelenk.plots.workspace.elements", keep)
    origin = np.array([0.05, 0.15, 0.0])
    i, j = np.meshgrid(np.arange(-6, 7), np.arange(-6, 7))
    centres = origin + 0.1 * np.column_stack((i.ravel(), j.ravel(), np.zeros(i.size)))
    rows = np.column_stack((centres, np.ones(len(centres)), np.arange(len(centres))))
    drawn = Picture(rows, VOXEL_COLUMNS, "arm", ("a", "b"), (), origin, np.eye(3), 2, 0.1)
    picture_bytes(drawn, "svg")
    values = seen[0][np.isfinite(seen[0])]
    assert np.array_equal(np.sort(values), np.arange(169.0))
    rows_met, columns_met = np.nonzero(np.isfinite(seen[0]))
    assert np.ptp(rows_met) == np.ptp(columns_met) == 12


@pytest.mark.quick(2)
@pytest.mark.parametrize("columns", [POINT_COLUMNS, VOXEL_COLUMNS])
@pytest.mark.parametrize(("place", "width"), [([0.4, -0.2, 0.6], 0.6), ([3e-6, 0.0, 0.0], 3e-6), ([0.0] * 3, 1.0)])
def test_a_single_place_is_seen_together_with_the_base(
    columns: tuple[str, ...], place: list[float], width: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing else gives its picture a scale: without the base its axes would be numbered in steps of nothing."""
    seen: list[tuple[float, float]] = []
    monkeypatch.setattr("gelenk.plots.workspace._colour_bar", lambda figure, *_: seen.append(figure.axes[0].get_xlim()))
    rows = np.zeros((1, len(columns)))
    rows[0, :3] = place
    picture_bytes(picture(rows, columns), "png")
    left, right = seen[0]
    assert left < min(0.0, place[0]) <= max(0.0, place[0]) < right
    assert width < right - left < 1.3 * width
    assert picture(rows, columns).element < 0.05 * width


def test_the_title_names_robot_and_chain() -> None:
    figures: list[str] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("gelenk.plots.figure.as_bytes", lambda figure, _: figures.append(figure.texts[-1].get_text()))
        picture_bytes(picture(np.zeros((1, 4))), "png")
    assert figures == ["Workspace of arm: base → tip ? $\\frac"]
