"""Small meshes against the files that they are made of, read by Trimesh; and files that stay as they are."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
import trimesh

from gelenk.operations.display.normals import shaded
from gelenk.operations.display.simplify import simplified
from gelenk.operations.display.stored import small_mesh
from gelenk.robot.arrays import Array
from gelenk.store.records import package_data
from tests.collision.shapes.test_meshes import CORNERS, FACES, INSTANCE, OBJ, binary_stl, dae

PANDA = package_data() / "robots" / "panda_description" / "meshes" / "visual"
BOUND = (
    '<instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" target="#m"/>'
    "</technique_common></bind_material></instance_geometry>"
)
MATERIALS = """<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_effects><effect id="e"><profile_COMMON><technique>{look}</technique></profile_COMMON></effect>
</library_effects><library_geometries>"""
GREY = "<phong><diffuse><color>0.5 0 1 1</color></diffuse></phong>"


def coloured(look: str = GREY, content: str = BOUND) -> bytes:
    """A Collada file whose faces are of a material with this look."""
    named = dae(content=content).decode().replace('<triangles count="4">', '<triangles count="4" material="m">')
    return named.replace("<library_geometries>", MATERIALS.format(look=look)).encode()


def read(content: bytes) -> trimesh.Trimesh:
    """A GLB file as another program reads it, in its root's axes."""
    scene: Any = trimesh.load(BytesIO(content), file_type="glb", process=False)
    found: trimesh.Trimesh = scene.to_geometry()
    return found


def farthest(points: Array, surface: trimesh.Trimesh) -> float:
    """Largest distance of points from a surface, by samples of it, [its unit]."""
    import scipy.spatial

    dense = surface.sample(400_000, seed=1)
    return float(scipy.spatial.KDTree(np.concatenate([dense, surface.vertices])).query(points)[0].max())


@pytest.mark.slow
def test_a_link_of_the_panda_keeps_its_shape_with_a_fraction_of_its_triangles() -> None:
    content = (PANDA / "link2.dae").read_bytes()
    scene: Any = trimesh.load(BytesIO(content), file_type="dae")
    whole: trimesh.Trimesh = scene.to_geometry()
    small = read(small_mesh("link2.dae", content))
    side = np.ptp(whole.vertices, axis=0).max()
    assert len(small.faces) < len(whole.faces) / 4
    assert len(small_mesh("link2.dae", content)) < len(content) / 10
    assert small.bounds == pytest.approx(whole.bounds, abs=1e-3 * side)
    assert small.area == pytest.approx(whole.area, rel=0.01)
    assert farthest(small.sample(2000, seed=2), whole) < 5e-3 * side
    assert farthest(whole.sample(2000, seed=2), small) < 5e-3 * side


def test_a_ball_stays_round_with_fewer_triangles() -> None:
    ball = trimesh.creation.icosphere(subdivisions=4)
    small = read(small_mesh("a.stl", binary_stl(ball.triangles)))
    assert len(small.faces) < len(ball.faces) / 2.5
    assert small.is_watertight
    distances = np.linalg.norm(small.sample(5000, seed=1), axis=1)
    assert np.abs(distances - 1).max() < 3 * 2e-3, "a thousandth of two metres, as a mean, and a polyhedron's sag"
    assert small.volume == pytest.approx(4 / 3 * np.pi, rel=5e-3)


@pytest.mark.parametrize(("name", "content"), [("a.stl", binary_stl(FACES)), ("a.OBJ", OBJ)])
def test_a_simple_mesh_stays_as_it_is(name: str, content: bytes) -> None:
    small = read(small_mesh(name, content))
    assert len(small.faces) == 4
    corners = small.vertices[small.faces].reshape(-1, 3)
    assert corners[np.lexsort(corners.T)] == pytest.approx(
        np.array(sorted(FACES.reshape(-1, 3).tolist(), key=lambda point: point[::-1])), abs=3 / 65535
    )
    assert np.abs(np.linalg.norm(small.vertex_normals, axis=1) - 1).max() < 0.02
    outward = small.triangles_center - CORNERS.mean(axis=0)
    assert ((small.face_normals * outward).sum(axis=1) > 0).all(), "all are seen from outside"


def test_a_mirrored_part_is_seen_from_outside_too() -> None:
    mirrored = dae(content=f"<node><scale>-1 1 1</scale>{INSTANCE}</node>")
    small = read(small_mesh("a.dae", mirrored))
    assert small.volume == pytest.approx(8.0, rel=1e-3)  # twice as large along each axis, of 1 · 2 · 3 / 6


def test_colours_are_those_of_the_file() -> None:
    scene: Any = trimesh.load(BytesIO(small_mesh("a.dae", coloured())), file_type="glb")
    (mesh,) = scene.geometry.values()
    red, green, blue, _ = np.asarray(mesh.visual.material.baseColorFactor) / 255
    assert red == pytest.approx(0.2140, abs=3e-3)  # the light of sRGB 0.5, by IEC 61966-2-1
    assert (green, blue) == (0.0, 1.0)


@pytest.mark.parametrize(
    "look",
    [
        "<phong><diffuse><texture texture='t'/></diffuse></phong>",
        f"{GREY[:-8]}<transparency><float>0.5</float></transparency></phong>",
        f"{GREY[:-8]}<transparent opaque='RGB_ZERO'><color>0 0 0 0</color></transparent></phong>",
        "<constant/>",
        "<phong><diffuse><color>red</color></diffuse></phong>",
    ],
    ids=["texture", "half transparent", "in another way", "not shaded", "no number"],
)
def test_what_colours_alone_do_not_show_stays_as_it_is(look: str) -> None:
    assert small_mesh("a.dae", coloured(look)) == b""


def test_a_file_that_names_no_material_has_none() -> None:
    for content in (coloured(content=INSTANCE), coloured(content=BOUND.replace('target="#m"', 'target="#none"'))):
        assert b'"materials"' not in small_mesh("a.dae", content)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.stl", b"solid"),
        ("a.dae", b"<COLLADA/>"),
        ("a.obj", b"f 1 2 3"),
        ("a.stl", binary_stl(FACES * 1e9)),
        ("a.stl", binary_stl(np.zeros((5, 3, 3)))),
        ("a.stl", binary_stl(FACES, count=2**31)),
    ],
    ids=["empty", "no scene", "no points", "far", "without area", "fewer than said"],
)
def test_a_broken_file_has_no_small_form(name: str, content: bytes) -> None:
    assert small_mesh(name, content) == b""


def test_flat_parts_lose_all_but_their_borders() -> None:
    line = np.linspace(0.0, 1.0, 21)
    points = np.array([[x, y, 0.0] for x in line for y in line])
    first = np.array([21 * i + j for i in range(20) for j in range(20)])
    triangles = np.concatenate([first[:, None] + [0, 21, 1], first[:, None] + [21, 22, 1]])
    fewer, corners = simplified(points, triangles, 1e-9)
    assert len(corners) < len(triangles) / 4
    border = {tuple(point) for point in points if {0.0, 1.0} & set(point[:2].tolist())}
    assert border <= {tuple(point) for point in fewer}
    p, q, r = (fewer[corners[:, i]] for i in range(3))
    areas = np.cross(q - p, r - p)[:, 2] / 2
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(1.0, abs=1e-12)


def test_edges_are_sharp_and_round_parts_round() -> None:
    box = trimesh.creation.box()
    of, normals, corners = shaded(np.array(box.vertices), np.array(box.faces))
    assert len(of) == 24  # a corner of a box has the normals of three faces
    assert np.array_equal(np.sort(np.abs(normals), axis=1), np.tile([0, 0, 127], (24, 1)))
    assert np.array_equal(of[corners], box.faces)
    ball = trimesh.creation.icosphere(subdivisions=3)
    of, normals, _ = shaded(np.array(ball.vertices), np.array(ball.faces))
    assert len(of) == len(ball.vertices)
    assert np.abs(normals / 127 - ball.vertices[of]).max() < 0.02


def test_a_point_of_very_many_triangles_takes_no_longer() -> None:
    """Compared in pairs they would be ten thousand million."""
    count = 100_000
    angles = np.linspace(0.0, 2 * np.pi, count, endpoint=False)
    points = np.concatenate([[[0, 0, 1]], np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])])
    around = 1 + np.arange(count)
    of, normals, _ = shaded(points, np.column_stack([0 * around, around, 1 + around % count]))
    assert np.abs(np.linalg.norm(normals, axis=1) - 127).max() < 2
    assert len(of) > count
