"""Pictures of ellipsoids: that they show what is computed, are small and the same each time, and never fail."""

import re
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.patches import Ellipse, Polygon

from app.kinematics.manipulability import manipulability
from app.model.arrays import Array
from app.plots import ellipsoids as module
from app.plots.ellipsoids import manipulability_picture
from app.plots.figure import FORCE, VELOCITY, PictureFormat
from tests.oracles import catalogue
from tests.robots import robot, samples


def picture(name: str, q: Array, kind: PictureFormat = "svg", tip: str | None = None) -> bytes:
    machine = robot(name)
    chain = machine.chain(None, tip)
    result = manipulability(machine, chain, q[None])
    return manipulability_picture(name, chain, q, result.parts["translation"], kind)


@pytest.fixture
def figures(monkeypatch: pytest.MonkeyPatch) -> list[Figure]:
    """What is drawn, instead of its bytes."""
    drawn: list[Figure] = []

    def kept(figure: Figure, _: PictureFormat) -> bytes:
        drawn.append(figure)
        return b""

    monkeypatch.setattr(module, "as_bytes", kept)
    return drawn


def ellipses(axes: Axes, color: str) -> list[Ellipse]:
    rgb = tuple(int(color[i : i + 2], 16) / 255 for i in (1, 3, 5))
    found = [patch for patch in axes.patches if isinstance(patch, Ellipse)]
    return [patch for patch in found if np.allclose(patch.get_edgecolor()[:3], rgb)]


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
    assert len(ellipses(axes, VELOCITY)) == 1
    assert ellipses(axes, FORCE) == []
    (strip,) = (patch for patch in axes.patches if isinstance(patch, Polygon))
    corners = np.asarray(strip.get_xy())[:4]
    along, across = np.array([np.cos(0.3), np.sin(0.3)]), np.array([-np.sin(0.3), np.cos(0.3)])
    assert np.abs((corners - [1.7 * along]) @ across) == pytest.approx(np.full(4, 1.0 / 1.838477631085), rel=1e-6)
    assert np.abs(corners @ along).min() > 100.0
    assert "unbounded" in " ".join(text.get_text() for text in figures[0].texts)


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


@pytest.mark.parametrize("name", catalogue.NAMES)
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
