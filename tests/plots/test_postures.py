"""Pictures of an arm's postures: that they show the arm and its ellipses where they are."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse

from gelenk.kinematics.ellipsoids.manipulability import manipulability
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.plots.figure import PictureFormat
from gelenk.plots.motion.postures import postures_picture
from gelenk.robot.arrays import Array
from tests.robots import robot


def drawn(monkeypatch: pytest.MonkeyPatch, name: str, qs: Array) -> Figure:
    """What is drawn, instead of its bytes."""
    figures: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        figures.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    machine = robot(name)
    chain = machine.chain(None, None)
    translation = manipulability(machine, chain, qs).parts["translation"]
    postures_picture(name, chain, qs, translation, "svg")
    return figures[0]


def test_each_posture_has_the_ellipse_of_its_jacobian(monkeypatch: pytest.MonkeyPatch) -> None:
    qs = np.array([[0.3, 0.8], [0.6, 1.2], [1.0, 1.5]])
    axes = drawn(monkeypatch, "planar_2r", qs).axes[0]
    ellipses = [one for one in axes.patches if isinstance(one, Ellipse)]
    centres = {tuple(np.round(one.get_center(), 9)) for one in ellipses}
    scales = set()
    for q in qs:
        a, b = q[0], q.sum()
        tip = (np.cos(a) + 0.7 * np.cos(b), np.sin(a) + 0.7 * np.sin(b))
        assert tuple(np.round(tip, 9)) in centres
        J = np.array([[-tip[1], -0.7 * np.sin(b)], [tip[0], 0.7 * np.cos(b)]])
        mine = next(one for one in ellipses if np.allclose(one.get_center(), tip))
        sizes = sorted((mine.width, mine.height), reverse=True)
        ratios = np.array(sizes) / (2.0 * np.linalg.svd(J, compute_uv=False))
        scales.update(np.round(ratios, 9).tolist())
    assert len(scales) == 1


def test_of_many_configurations_a_dozen_are_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    qs = np.column_stack((np.linspace(0.0, 1.0, 60), np.linspace(0.5, 1.5, 60)))
    figure = drawn(monkeypatch, "planar_2r", qs)
    centres = {one.get_center() for one in figure.axes[0].patches if isinstance(one, Ellipse)}
    assert len(centres) == 12
    assert "60 configurations" in figure.texts[0].get_text()


def test_a_stretched_arm_is_drawn_too(monkeypatch: pytest.MonkeyPatch) -> None:
    assert drawn(monkeypatch, "planar_2r", np.array([[0.3, 0.0], [0.3, np.pi]])).axes


def test_an_arm_in_space_is_projected(monkeypatch: pytest.MonkeyPatch) -> None:
    """Along y, in which it extends least; half the height of an ellipse is what a unit of joint speed gives in z."""
    qs = np.array([[0.0, -0.8, 0.0, -2.3, 0.0, 1.6, 0.8], [0.0, -0.2, 0.0, -1.6, 0.0, 1.4, 0.8]])
    axes = drawn(monkeypatch, "panda", qs).axes[0]
    assert (axes.get_xlabel()[0], axes.get_ylabel()[0]) == ("x", "z")
    machine = robot("panda")
    _, _, Js = chain_jacobians(machine.chain(None, None).flat, qs)
    ellipses = [one for one in axes.patches if isinstance(one, Ellipse)]
    turns = [np.radians(one.angle) for one in ellipses]
    heights = [np.hypot(one.width * np.sin(a), one.height * np.cos(a)) for one, a in zip(ellipses, turns, strict=True)]
    wanted = [float(np.linalg.norm(J[2])) for J in Js]
    ratios = np.array(sorted(set(np.round(heights, 9)))) / sorted(wanted)
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-6)
