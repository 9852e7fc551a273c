"""Pictures of ellipsoids: that they show what is computed, are small and the same each time, and never fail."""

import re
from collections.abc import Sequence
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Polygon

from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.ellipsoids.limited_motion import JointBounds, limited_motion
from gelenk.kinematics.ellipsoids.manipulability import manipulability
from gelenk.plots.ellipsoids import NOTHING_MORE, Overlay, manipulability_picture
from gelenk.plots.figure import FORCE, LINK, VELOCITY, PictureFormat
from gelenk.robot.arrays import Array
from tests.oracles import catalogue
from tests.robots import robot, samples, swept

SOLID_WIDTH = 4.5
"""Of a segment of velocities, [pt]."""


def picture(
    name: str,
    q: Array,
    kind: PictureFormat = "svg",
    base: str | None = None,
    tip: str | None = None,
    task: Sequence[Direction] = DIRECTIONS,
    overlay: Overlay = NOTHING_MORE,
) -> bytes:
    machine = robot(name)
    chain = machine.chain(base, tip)
    result = manipulability(machine, chain, q[None], task=task)
    return manipulability_picture(name, chain, q, result.parts.get("translation"), kind, overlay)


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """What is drawn, instead of its bytes."""
    drawn: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        drawn.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    return drawn


def ellipses(axes: Axes, color: str) -> list[Ellipse]:
    rgb = tuple(int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    found = [patch for patch in axes.patches if isinstance(patch, Ellipse)]
    return [patch for patch in found if np.allclose(patch.get_edgecolor()[:3], rgb)]


def lines(axes: Axes, color: str, width: float) -> list[Line2D]:
    """Segments, without the marks at their ends."""
    found = [line for line in axes.lines if line.get_color() == color and line.get_linewidth() == width]
    lengths = [float(np.linalg.norm(np.ptp(np.array(line.get_data()), axis=1))) for line in found]
    return [line for line, length in zip(found, lengths, strict=True) if length > 0.99 * max(lengths)]


def arm_of(axes: Axes) -> Line2D:
    return next(line for line in axes.lines if line.get_color() == LINK)


def words_of(figure: Figure) -> str:
    return " ".join(text.get_text() for text in figure.texts)


def matrix(patch: Ellipse) -> Array:
    """An ellipse as A, where uᵀAu is the square of its half width along u."""
    angle = np.radians(patch.angle)
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    return np.asarray(turn @ np.diag([patch.width / 2, patch.height / 2]) ** 2 @ turn.T)


def test_the_blackboards_picture(figures: list[Figure]) -> None:
    picture("planar_2r", np.array([0.3, 0.8]))
    axes = figures[0].axes[0]
    assert axes.get_aspect() == 1.0
    J = np.array([[-0.919365358704, -0.623845152043], [1.272853774124, 0.317517284998]])
    (velocity,), (force,) = ellipses(axes, VELOCITY), ellipses(axes, FORCE)
    tip = [1.272853774124, 0.919365358704]
    assert velocity.center == pytest.approx(tip)
    assert force.center == pytest.approx(tip)
    assert matrix(velocity) == pytest.approx(0.2**2 * J @ J.T, abs=1e-9)
    assert matrix(force) == pytest.approx(0.1**2 * np.linalg.inv(J @ J.T), abs=1e-9)
    texts = " ".join(text.get_text() for text in figures[0].texts)
    for words in ("semi-axes 1.693, 0.2965", "semi-axes 0.5905, 3.372", "drawn as 0.2 m", "drawn as 0.1 m", "0.5021"):
        assert words in texts


def test_projections_are_shadows(figures: list[Figure]) -> None:
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    picture("ur5", q)
    machine = robot("ur5")
    J = manipulability(machine, machine.chain(None, None), q[None]).Js[0, :3]
    labels = {"x / m": 0, "y / m": 1, "z / m": 2}
    assert len(figures[0].axes) == 3
    for axes in figures[0].axes:
        rows = [labels[axes.get_xlabel()], labels[axes.get_ylabel()]]
        for color, whole in ((VELOCITY, J @ J.T), (FORCE, np.linalg.inv(J @ J.T))):
            (shadow,) = ellipses(axes, color)
            ratio = matrix(shadow) / whole[np.ix_(rows, rows)]
            assert ratio == pytest.approx(np.full((2, 2), ratio[0, 0]), rel=1e-6)
    limits = {axes.get_xlabel() + axes.get_ylabel(): (axes.get_xlim(), axes.get_ylim()) for axes in figures[0].axes}
    assert limits["x / mz / m"][0] == limits["x / my / m"][0]
    assert limits["x / mz / m"][1] == limits["y / mz / m"][1]


def test_a_force_without_end_is_a_strip_along_the_arm(figures: list[Figure]) -> None:
    picture("planar_2r", np.array([0.3, 0.0]))
    axes = figures[0].axes[0]
    assert ellipses(axes, VELOCITY) == ellipses(axes, FORCE) == []
    (strip,) = (patch for patch in axes.patches if isinstance(patch, Polygon))
    corners = np.asarray(strip.get_xy())[:4]
    along, across = np.array([np.cos(0.3), np.sin(0.3)]), np.array([-np.sin(0.3), np.cos(0.3)])
    assert np.abs((corners - [1.7 * along]) @ across) == pytest.approx(np.full(4, 1.0 / 1.838477631085), rel=1e-6)
    assert np.abs(corners @ along).min() > 100.0
    assert strip.get_zorder() < arm_of(axes).get_zorder()
    assert "Force strip, semi-axes 0.5439, unbounded" in words_of(figures[0])


def test_a_velocity_that_has_lost_an_axis_is_a_segment(figures: list[Figure]) -> None:
    """Across the arm, of half length σ₁, with nothing inside; the legend calls it what it is."""
    for q2, sigma in ((0.0, 1.838477631085), (np.pi, 0.761577310586)):
        picture("planar_2r", np.array([0.3, q2]))
        figure = figures.pop()
        (segment,) = lines(figure.axes[0], VELOCITY, SOLID_WIDTH)
        first, last = np.array(segment.get_data()).T
        across = np.array([-np.sin(0.3), np.cos(0.3)])
        assert np.abs((last - first) @ across) == pytest.approx(2 * 0.2 * sigma)
        assert np.linalg.norm(last - first) == pytest.approx(2 * 0.2 * sigma)
        assert f"Velocity segment, semi-axes {sigma:.4g}, 0" in words_of(figure)
        assert "Rank 1 of 2: singular" in words_of(figure)


def test_fills_do_not_tint_the_arm(figures: list[Figure]) -> None:
    for q in ([0.3, 0.8], [0.3, 0.0]):
        picture("planar_2r", np.array(q))
        axes = figures.pop().axes[0]
        filled = [patch for patch in axes.patches if patch.get_fill() and to_rgba(patch.get_facecolor())[3] > 0]
        assert filled
        assert max(patch.get_zorder() for patch in filled) < arm_of(axes).get_zorder()


def test_two_segments_on_each_other_can_be_told_apart(figures: list[Figure]) -> None:
    """The broad one below, the thin dashed one above, in all of the one-axis chains."""
    picture("panda", np.array([0.02]), base="panda_hand", tip="panda_leftfinger")
    axes = next(axes for axes in figures[0].axes if (axes.get_xlabel(), axes.get_ylabel()) == ("y / m", "z / m"))
    (broad,), (thin,) = lines(axes, VELOCITY, SOLID_WIDTH), lines(axes, FORCE, 1.6)
    assert np.array(broad.get_data()) == pytest.approx(np.array(thin.get_data()))
    assert broad.get_linewidth() > 2 * thin.get_linewidth()
    assert broad.get_zorder() < thin.get_zorder()
    assert (broad.get_linestyle(), thin.get_linestyle()) == ("-", "--")


def test_a_task_without_translation_keeps_the_plane_and_says_so(figures: list[Figure]) -> None:
    picture("planar_2r", np.array([0.3, 0.8]), task=("rz",))
    (axes,) = figures[0].axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x / m", "y / m")
    assert "The task has no translation" in words_of(figures[0])
    picture("planar_2r", np.array([0.3, 0.8]), task=("x",))
    assert len(figures[1].axes) == 1
    picture("planar_2r", np.array([0.3, 0.8]), task=("z",))
    assert "No joint moves the tip" in words_of(figures[2])


@pytest.mark.parametrize(
    ("name", "q", "words"),
    [
        ("planar_2r", [0.3, -0.8], "q = (0.3, -0.8) rad"),
        ("scara", [0.3, 0.5, 0.1, -0.2], "q = (0.3 rad, 0.5 rad, 0.1 m, -0.2 rad)"),
    ],
)
def test_the_configuration_is_told(figures: list[Figure], name: str, q: list[float], words: str) -> None:
    picture(name, np.array(q))
    assert words in words_of(figures[0])


def test_directions_are_arrows_with_their_ratios(figures: list[Figure]) -> None:
    """A dot stands where the ray leaves each ellipse: 1/√(uᵀ(JJᵀ)⁻¹u) and 1/√(uᵀJJᵀu), to scale."""
    u = np.array([np.cos(0.4), np.sin(0.4), 0.0])
    picture("planar_2r", np.array([0.3, 0.8]), overlay=Overlay(u[None], 1e-10, None))
    J = np.array([[-0.919365358704, -0.623845152043], [1.272853774124, 0.317517284998]])
    velocity, force = 1 / np.sqrt(u[:2] @ np.linalg.inv(J @ J.T) @ u[:2]), 1 / np.linalg.norm(J.T @ u[:2])
    assert f"v {velocity:.4g}, F {force:.4g}" in words_of(figures[0])
    dots = [line for line in figures[0].axes[0].lines if len(np.atleast_1d(line.get_xdata())) == 1]
    found = {str(line.get_color()): np.array(line.get_data()).ravel() for line in dots}
    tip = np.array([1.272853774124, 0.919365358704])
    assert found[VELOCITY] - tip == pytest.approx(0.2 * velocity * u[:2])
    assert found[FORCE] - tip == pytest.approx(0.1 * force * u[:2])


def test_polytopes_of_a_planar_arm_are_outlined(figures: list[Figure]) -> None:
    machine, q = robot("planar_2r"), np.array([0.3, 0.8])
    result = manipulability(machine, machine.chain(None, None), q[None])
    bounds = JointBounds(np.array([1.0, 2.0]), np.array([10.0, 5.0]))
    (limited,) = limited_motion(result.parts["translation"], result.Js, bounds, np.eye(3))
    picture("planar_2r", q, overlay=Overlay(np.zeros((0, 3)), 1e-10, limited))
    J, tip = result.Js[0, :2], np.array([1.272853774124, 0.919365358704])
    polygons = [patch for patch in figures[0].axes[0].patches if isinstance(patch, Polygon)]
    velocities, forces = (np.asarray(patch.get_xy())[:4] - tip for patch in polygons)
    corners = np.array([J @ (a, b) for a in (1, -1) for b in (2, -2)])
    for corner in velocities:
        assert np.abs(corners * 0.2 - corner).max(axis=1).min() < 1e-12
    torques = np.abs(forces / 0.02 @ J)
    assert torques == pytest.approx(np.tile([10.0, 5.0], (4, 1)))
    assert "Velocity polytope" in words_of(figures[0])
    unlimited = JointBounds(np.full(2, np.nan), np.full(2, np.nan))
    (limited,) = limited_motion(result.parts["translation"], result.Js, unlimited, np.eye(3))
    picture("planar_2r", q, overlay=Overlay(np.zeros((0, 3)), 1e-10, limited))
    assert "not every joint has a velocity limit" in words_of(figures[1])


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "kind"),
    [("planar_2r", "svg"), ("planar_2r", "png"), ("panda", "svg"), ("panda", "png"), ("iris", "svg"), ("tiago", "svg")],
)
def test_pictures_are_small_and_the_same_each_time(name: str, kind: PictureFormat) -> None:
    q = samples(robot(name).chain(None, None), 1)[0]
    first = picture(name, q, kind)
    assert first == picture(name, q, kind)
    assert len(first) < (110_000 if kind == "svg" else 250_000)
    if kind == "svg":
        ElementTree.fromstring(first)
        assert b"<script" not in first
        assert not re.search(rb"\d{4}-\d\d-\d\dT", first)
    else:
        height, width, _ = imread(BytesIO(first)).shape
        assert 800 <= width <= 1400
        assert 800 <= height <= 1400


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_every_robot_can_be_drawn(name: str, figures: list[Figure]) -> None:
    """Also where all joints are zero, which is singular for many."""
    chain = robot(name).chain(None, None)
    for q in (samples(chain, 1)[0], np.zeros(len(chain))):
        picture(name, q)
    for figure in figures:
        for axes in figure.axes:
            assert np.isfinite([*axes.get_xlim(), *axes.get_ylim()]).all()


def test_a_chain_without_joints_can_be_drawn() -> None:
    panda = robot("panda")
    chain = panda.chain("panda_link8", "panda_hand")
    for parts in (manipulability(panda, chain, np.zeros((1, 0))).parts, {}):
        content = manipulability_picture("panda", chain, np.zeros(0), parts.get("translation"), "svg")
        assert len(content) > 1000
