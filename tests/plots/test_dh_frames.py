"""Pictures of DH tables: what they show is where the table puts it, and every name can be read."""

import math
import re

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from gelenk.plots.dh_frames import dh_picture
from gelenk.plots.dh_scene import DhScene, dh_scene
from gelenk.plots.figure import PictureFormat
from gelenk.plots.labels import Wanted, placed
from gelenk.robot.dh import Convention, DhJoint, DhTable

H = math.pi / 2.0


def table(convention: Convention, *rows: tuple[float, float, float, float], slides: int = 0) -> DhTable:
    """A table of rows (a, α, d, ϑ), of which the one numbered `slides` is prismatic."""
    joints = [
        DhJoint(f"j{i}", "prismatic" if i == slides else "revolute", a, alpha, d, theta)
        for i, (a, alpha, d, theta) in enumerate(rows, start=1)
    ]
    return DhTable(convention, tuple(joints))


CLASSIC = table("standard", (0.6, 0.6, 0.4, 0.0), (0.5, -0.6, 0.35, 0.0)), [0.6, 0.6]
ARMS: dict[str, tuple[DhTable, list[float]]] = {
    "two links": CLASSIC,
    "anthropomorphic": (table("standard", (0, H, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)), [0.3, 0.6, -0.8]),
    "wrist": (table("standard", (0, -H, 0, 0), (0, H, 0, 0), (0, 0, 0.1, 0)), [0.5, 0.6, 0.7]),
    "SCARA": (
        table("standard", (0.325, 0, 0.387, 0), (0.275, math.pi, 0, 0), (0, 0, 0, 0), (0, 0, 0.05, 0), slides=3),
        [0.4, 0.8, 0.12, -0.3],
    ),
    "Stanford": (
        table(
            "standard", (0, -H, 0.412, 0), (0, H, 0.154, 0), (0.0203, 0, 0, -H), (0, -H, 0, 0), (0, H, 0, 0),
            (0, 0, 0.263, 0), slides=3,
        ),
        [0.2, 0.5, 0.6, -0.3, 0.7, 0.1],
    ),
    "Panda": (
        table(
            "modified", (0, 0, 0.333, 0), (0, -H, 0, 0), (0, H, 0.316, 0), (0.0825, H, 0, 0), (-0.0825, -H, 0.384, 0),
            (0, H, 0, 0), (0.088, H, 0, 0),
        ),
        [0.3, -0.6, 0.4, -1.8, 0.4, 1.6, 0.7],
    ),
    "UR5": (
        table(
            "standard", (0, H, 0.089159, 0), (-0.425, 0, 0, 0), (-0.39225, 0, 0, 0), (0, H, 0.10915, 0),
            (0, -H, 0.09465, 0), (0, 0, 0.0823, 0),
        ),
        [0.5, -1.1, 1.3, -0.6, 0.6, 0.5],
    ),
}  # fmt: skip


def names(scene: DhScene) -> set[str]:
    """All names, without mathematical notation."""
    return {part for name in scene.names for part in re.sub(r"[$\\{}]|,", " ", name.text).replace(" ", "").split()}


def drawn(monkeypatch: pytest.MonkeyPatch, arm: tuple[DhTable, list[float]]) -> Figure:
    figures: list[Figure] = []

    def captured(figure: Figure, _: PictureFormat) -> bytes:
        figures.append(figure)
        return b""

    monkeypatch.setattr("gelenk.plots.figure.as_bytes", captured)
    dh_picture(*arm, "svg")
    return figures[0]


def test_the_two_links_show_every_parameter_and_both_axes_of_each_frame() -> None:
    assert names(dh_scene(*CLASSIC)) == {f"{letter}_{i}" for letter in "xz" for i in range(3)} | {
        f"{letter}_{i}" for letter in ("a", "d", "alpha", "vartheta") for i in (1, 2)
    }


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_normals_and_offsets_have_the_lengths_of_the_table_along_their_axes(convention: Convention) -> None:
    arm = table(convention, (0.6, 0.6, 0.4, 0.2), (-0.5, -0.6, -0.35, 0.0), (0.3, 1.0, 0.2, 0.0))
    q = [0.6, 0.5, -0.4]
    frames, scene = arm.frames(q), dh_scene(arm, q)
    lines = {kind: [one.points for one in scene.strokes if one.kind == kind] for kind in ("a", "d")}
    standard = convention == "standard"
    for i, row in enumerate(arm.joints):
        x, z = (frames[i + 1][:3, 0], frames[i][:3, 2]) if standard else (frames[i][:3, 0], frames[i + 1][:3, 2])
        np.testing.assert_allclose(np.diff(lines["a"][i], axis=0)[0], row.a * x, atol=1e-12)
        np.testing.assert_allclose(np.diff(lines["d"][i], axis=0)[0], row.d * z, atol=1e-12)
        way = (lines["d"][i], lines["a"][i]) if standard else (lines["a"][i], lines["d"][i])
        np.testing.assert_allclose(way[0][0], frames[i][:3, 3], atol=1e-12)
        np.testing.assert_allclose(way[1][1], frames[i + 1][:3, 3], atol=1e-12)


def test_arcs_lead_from_the_axis_before_to_the_axis_after() -> None:
    arm, q = CLASSIC
    frames = arm.frames(q)
    scene = dh_scene(arm, q)
    for kind, axis in (("theta", 0), ("alpha", 2)):
        arcs = [one.points for one in scene.strokes if one.kind == kind]
        assert len(arcs) == 2
        for i, arc in enumerate(arcs):
            before, after = frames[i][:3, axis], frames[i + 1][:3, axis]
            chord = (arc[-1] - arc[0]) / np.linalg.norm(arc[-1] - arc[0])
            np.testing.assert_allclose(chord, (after - before) / np.linalg.norm(after - before), atol=1e-9)


def test_what_is_zero_is_left_out_and_axes_that_coincide_are_one_arrow_with_all_names() -> None:
    wrist = ARMS["wrist"][0]
    scene = dh_scene(wrist, [0.0, 0.0, 0.0])
    texts = [name.text for name in scene.names]
    assert r"$x_{0},\,x_{1},\,x_{2}$" in texts
    assert names(scene) == {"x_0x_1x_2", "x_3", "z_0z_2", "z_1", "z_3", "d_3", "alpha_1", "alpha_2"}


def test_a_prismatic_joint_is_a_box_and_its_offset_has_its_position() -> None:
    scene = dh_scene(*ARMS["SCARA"])
    assert [body.slides for body in scene.bodies] == [False, False, True, False]
    lengths = [float(np.linalg.norm(np.diff(one.points, axis=0))) for one in scene.strokes if one.kind == "d"]
    assert lengths == pytest.approx([0.387, 0.12, 0.05])


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ARMS)
def test_no_name_covers_another_one_or_leaves_the_page(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    figure = drawn(monkeypatch, ARMS[name])
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    boxes = [text.get_window_extent(renderer) for text in figure.axes[0].texts]
    page = figure.bbox
    assert all(page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1 for box in boxes)
    covered = 0.0
    for i, one in enumerate(boxes):
        for other in boxes[:i]:
            width = min(one.x1, other.x1) - max(one.x0, other.x0)
            height = min(one.y1, other.y1) - max(one.y0, other.y0)
            covered += max(0.0, width) * max(0.0, height) / (other.width * other.height)
    assert covered < 0.3


@pytest.mark.slow
def test_the_table_below_has_degrees_and_the_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = [text.get_text() for text in drawn(monkeypatch, ARMS["Stanford"]).texts]
    row = texts[texts.index("3") : texts.index("3") + 5]
    assert row == ["3", "0.0203", "0", "$q_{3}$", "-90"]
    offset = table("standard", (0.1, 0.0, 1e-12, -H), (0.1, 0.0, 0.0, H))
    texts = [text.get_text() for text in drawn(monkeypatch, (offset, [0.0, 0.0])).texts]
    assert texts[texts.index("$q_{1}$ - 90") - 1 :][:2] == ["0", "$q_{1}$ - 90"]
    assert "$q_{2}$ + 90" in texts


def test_a_name_stands_beside_a_line_and_not_on_it() -> None:
    line = np.column_stack((np.linspace(0.0, 100.0, 60), np.zeros(60)))
    names_ = [Wanted(np.array([20.0, 12.0]), np.array([[50.0, 0.0]]))] * 2
    (first, second), _ = placed(names_, line)
    assert min(abs(first[1]), abs(second[1])) > 6.0
    assert abs(first[0] - second[0]) >= 20.0 or abs(first[1] - second[1]) >= 12.0


def test_a_table_of_one_point_is_drawn() -> None:
    assert dh_picture(table("standard", (0, 0, 0, 0)), [0.0], "png").startswith(b"\x89PNG")
