"""Pictures of profiles: that they show the motion, its jumps and its limits."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from gelenk.plots.figure import QUIET, PictureFormat
from gelenk.plots.profiles import ProfileLines, Span, curve, profiles_picture
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.trapezoid import JointMove, point_to_point
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline

UNITS = ("rad", "rad/s", "rad/s²", "rad/s³")


def lines(joints: int, limits: tuple[Array | None, ...] = (None, None, None)) -> ProfileLines:
    return ProfileLines([f"joint {j}" for j in range(joints)], UNITS, limits)


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """What is drawn, instead of its bytes."""
    drawn: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        drawn.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    return drawn


def trapezoid() -> PiecewisePolynomial:
    tasks = [JointMove(-1.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.0, 0.0, 0.8, 0.5)]
    return point_to_point(np.zeros(2), tasks).motion


def test_four_panels_with_the_motion_and_its_limits(figures: list[Figure]) -> None:
    motion = trapezoid()
    limits = (np.array([0.5, 0.8]), np.array([0.8, 0.8]), None)
    profiles_picture("A motion", motion, lines(2, limits), "svg")
    panels = figures[0].axes
    assert [axes.get_ylabel().split("\n")[0] for axes in panels] == ["position", "velocity", "acceleration", "jerk"]
    for order, axes in enumerate(panels):
        for j in range(2):
            times, values = (np.asarray(data, dtype=float) for data in axes.lines[j].get_data())
            inside = ~np.isin(times, motion.breaks)
            assert np.allclose(values[inside], motion.derivative(order).at(times[inside])[:, j])
            assert times[0] == 0.0
            assert times[-1] == motion.breaks[-1]
    levels = [
        {float(np.asarray(line.get_ydata(), dtype=float)[0]) for line in axes.lines if line.get_linestyle() == "--"}
        for axes in panels
    ]
    assert levels == [set(), {0.5, -0.5, 0.8, -0.8}, {0.8, -0.8}, set()]


def test_a_jump_is_a_vertical_line() -> None:
    times, values = curve(trapezoid().derivative(2))
    jumps = np.flatnonzero(np.diff(times) == 0.0)
    assert times[jumps] == pytest.approx([0.625, 1.3125, 2.0])
    assert values[jumps[0], 0] == pytest.approx(-0.8)
    assert values[jumps[0] + 1, 0] == pytest.approx(0.0)


@pytest.mark.quick(1)
@pytest.mark.parametrize("joints", [1, 2, 7, 32])
def test_any_number_of_joints_and_pieces(joints: int) -> None:
    rng = np.random.default_rng(joints)
    times = np.cumsum(rng.uniform(0.1, 1.0, 300))
    motion = cubic_spline(times, rng.normal(size=(300, joints)), "natural").motion
    picture = profiles_picture("x" * 200 + "$", motion, lines(joints), "png")
    assert picture.startswith(b"\x89PNG")


def test_the_same_bytes_each_time() -> None:
    first, second = (profiles_picture("A motion", trapezoid(), lines(2), "svg") for _ in range(2))
    assert first == second
    assert len(first) < 200_000


@pytest.mark.slow
@pytest.mark.parametrize("size", [0.0, 1e-30, 1e6, 1e25])
def test_sizes(size: float) -> None:
    c = np.zeros((1, 4, 1))
    c[0, 1:, 0] = size
    for breaks in (np.array([0.0, 1.0]), np.zeros(2), np.array([1e6 - 1e-3, 1e6])):
        assert profiles_picture("", PiecewisePolynomial(breaks, c), lines(1), "svg").startswith(b"<?xml")


def test_parts_are_marked_and_have_their_own_limits(figures: list[Figure]) -> None:
    motion = trapezoid()
    wide, narrow = [np.array([0.5, 0.8])] * 3, [np.array([0.4, 0.4])] * 3
    spans = [Span("0 joint", 0.0, 1.0, wide), Span("1 line", 1.0, float(motion.breaks[-1]), narrow)]
    profiles_picture("A motion", motion, ProfileLines(["a", "b"], UNITS, (None, None, None), spans=spans), "svg")
    panels = figures[0].axes
    assert [text.get_text() for text in panels[0].texts] == ["0 joint", "1 line"]
    assert all(any(np.all(np.asarray(line.get_xdata()) == 1.0) for line in axes.lines) for axes in panels)
    drawn = [np.array(line.get_data()) for line in panels[1].lines if line.get_linestyle() == "--"]
    steps = {tuple(values[np.isfinite(times)].tolist()) for times, values in drawn}
    assert steps == {(k * a, k * a, k * 0.4, k * 0.4) for a in (0.5, 0.8) for k in (1, -1)}


def test_a_limit_that_joints_share_has_no_ones_colour(figures: list[Figure]) -> None:
    bounds = np.array([0.5, 0.5, 0.7])
    motion = cubic_spline(np.array([0.0, 1.0]), np.array([[0.0, 0.0, 0.0], [0.1, 0.2, 0.3]]), "clamped").motion
    profiles_picture("A motion", motion, lines(3, (bounds, None, None)), "svg")
    colours = {
        float(np.asarray(line.get_ydata())[0]): line.get_color()
        for line in figures[0].axes[1].lines
        if line.get_linestyle() == "--"
    }
    assert colours[0.5] == QUIET
    assert colours[0.7] == "#009e73"
