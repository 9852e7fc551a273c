"""Pictures of a fly-over: that they show the corner and the motion that are computed."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from gelenk.course.motion.blended_motion import rest_to_rest
from gelenk.course.motion.fly_over import Blend, blended, corner_of
from gelenk.plots.figure import PictureFormat
from gelenk.plots.fly_over import fly_over_picture
from gelenk.robot.arrays import Array
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial

FLAT = [np.array(point, dtype=float) for point in ((3, 3), (1, 9), (8, 9))]
IN_SPACE = [np.array(point, dtype=float) for point in ((3, 3, 0), (1, 9, 1), (8, 9, 4))]


def blend_of(points: list[Array], time: float, speeds: tuple[float, float] = (1.0, 2.0)) -> Blend:
    start, corner, end = points
    return blended(corner_of(start, corner, end, *speeds), "blend_time", time)


def drawn(monkeypatch: pytest.MonkeyPatch, blend: Blend, motion: PiecewisePolynomial) -> Figure:
    """What is drawn, instead of its bytes."""
    figures: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        figures.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    fly_over_picture(blend, motion, "svg")
    return figures[0]


def test_the_way_and_its_points_are_those_of_the_blend(monkeypatch: pytest.MonkeyPatch) -> None:
    blend = blend_of(FLAT, 4.0)
    figure = drawn(monkeypatch, blend, blend.motion)
    way, distance, speed, acceleration = figure.axes
    points = {text.get_text(): text.xy for text in way.texts}  # type: ignore[attr-defined]
    wanted = {"A": FLAT[0], "B": FLAT[1], "C": FLAT[2], "A'": blend.entry, "C'": blend.exit}
    assert set(points) == set(wanted)
    for name, place in wanted.items():
        np.testing.assert_allclose(points[name], place, atol=1e-12)
    line = np.column_stack(way.lines[1].get_data())
    nearest = np.linalg.norm(line - FLAT[1], axis=1).min()
    assert nearest == pytest.approx(blend.closest_distance, rel=1e-3)
    assert speed.lines[0].get_ydata()[[0, -1]] == pytest.approx([1.0, 2.0])  # type: ignore[index]
    times = np.linspace(0.0, blend.time, 2001)[:, None]
    path = times ** np.arange(3) @ blend.coefficients
    length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    assert distance.lines[0].get_ydata()[[0, -1]] == pytest.approx([0.0, length], rel=1e-4)  # type: ignore[index]
    constant = float(np.linalg.norm(blend.acceleration))
    np.testing.assert_allclose(np.asarray(acceleration.lines[0].get_ydata(), dtype=float), constant)


def test_in_space_it_is_the_plane_of_the_corner(monkeypatch: pytest.MonkeyPatch) -> None:
    blend = blend_of(IN_SPACE, 2.0)
    whole = rest_to_rest(blend, 0.8)
    figure = drawn(monkeypatch, blend, whole.motion)
    A, B, C = np.column_stack(figure.axes[0].lines[0].get_data())
    np.testing.assert_allclose(B, [0.0, 0.0], atol=1e-12)
    assert np.linalg.norm(A - B) == pytest.approx(blend.corner.length_before)
    assert np.linalg.norm(C - B) == pytest.approx(blend.corner.length_after)
    assert pytest.approx((IN_SPACE[1] - IN_SPACE[0]) @ (IN_SPACE[2] - IN_SPACE[1])) == (B - A) @ (C - B)
    assert figure.axes[1].get_xlim()[1] == pytest.approx(whole.duration)


@pytest.mark.parametrize("end", [(3.0, 0.0, 0.0), (0.2, 0.0, 0.0)], ids=["straight on", "back"])
def test_a_corner_without_a_plane_is_drawn(end: tuple[float, ...]) -> None:
    points = [np.zeros(3), np.array([1.0, 0.0, 0.0]), np.array(end)]
    blend = blend_of(points, 0.5, (0.5, 0.5))
    assert fly_over_picture(blend, blend.motion if blend.time else None, "png").startswith(b"\x89PNG")
