"""Meshes against Assimp, which Coal reads them with; and hostile files, each refused with its name and a reason."""

import struct
from pathlib import Path

import coal
import numpy as np
import pytest

from gelenk.collision.shapes import meshes
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.errors import InvalidMesh
from gelenk.robot.arrays import Array
from gelenk.store.records import package_data

CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3]], dtype=float)
FACES = CORNERS[[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]]
OBJ = b"v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf -4 -3 -1\nf 1/1 4/1 3/1\nf 2//1 3//1 4//1\n"
DAE = """<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="{unit}"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3
</float_array><technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><translate>1 0 0</translate>
<node><scale>2 2 2</scale>{content}</node></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""
INSTANCE = '<instance_geometry url="#g"/>'


def dae(unit: float | str = 1.0, content: str = INSTANCE) -> bytes:
    return DAE.format(unit=unit, content=content).encode()


def binary_stl(triangles: Array, count: int | None = None) -> bytes:
    records = b"".join(struct.pack("<12fH", *np.zeros(3), *triangle.ravel(), 0) for triangle in triangles)
    return (
        b"solid is how some begin too".ljust(80)
        + struct.pack("<I", len(triangles) if count is None else count)
        + records
    )


def text_stl(triangles: Array) -> bytes:
    corner = "vertex {} {} {}\n".format
    loops = ("outer loop\n" + "".join(corner(*point) for point in triangle) + "endloop\n" for triangle in triangles)
    return ("solid s\n" + "".join(f"facet normal 0 0 0\n{loop}endfacet\n" for loop in loops) + "endsolid s\n").encode()


def msh(
    vertices: Array, faces: Array | None = None, has_normals: bool = False, counts: tuple[int, ...] | None = None
) -> bytes:
    """Return MuJoCo's binary form of a mesh; without faces it stands for the hull of its vertices."""
    normals = vertices if has_normals else vertices[:0]
    corners = np.zeros((0, 3)) if faces is None else faces
    heads = counts or (len(vertices), len(normals), len(normals), len(corners))
    parts = vertices.astype("<f4"), normals.astype("<f4"), normals[:, :2].astype("<f4"), corners.astype("<i4")
    return struct.pack("<4i", *heads) + b"".join(part.tobytes() for part in parts)


NUMBERS = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


@pytest.mark.parametrize("has_normals", [False, True])
def test_a_msh_is_read_with_what_surrounds_its_vertices(has_normals: bool) -> None:
    np.testing.assert_array_equal(read_triangles("a.MSH", msh(CORNERS, NUMBERS, has_normals)), FACES)


def test_a_msh_without_faces_is_the_hull_of_its_vertices() -> None:
    inside = np.array([[0.1, 0.1, 0.1]])
    found = read_triangles("a.msh", msh(np.concatenate([CORNERS, inside])))
    np.testing.assert_array_equal(in_order(found), in_order(FACES))


BROKEN_MSH = {
    "short": (b"\4\0\0\0", "it ends within its four counts"),
    "few vertices": (msh(CORNERS[:3], NUMBERS[:1] * 0), "its counts are 3, 0, 0, 1, but must be"),
    "negative": (msh(CORNERS, NUMBERS, counts=(4, 0, 0, -4)), "its counts are 4, 0, 0, -4, but must be"),
    "normals of some": (msh(CORNERS, NUMBERS, counts=(4, 3, 0, 1)), "its counts are 4, 3, 0, 1, but must be"),
    "huge": (msh(CORNERS, NUMBERS, counts=(2**31 - 1, 0, 0, 4)), "it has 112 bytes, but its counts make 25769803828"),
    "faces": (msh(CORNERS, NUMBERS, counts=(4, 0, 0, 2**31 - 1)), "more than 1000000 triangles"),
    "longer": (msh(CORNERS, NUMBERS) + b"x", "it has 113 bytes, but its counts make 112"),
    "beyond": (msh(CORNERS, NUMBERS + 1), "a face has a vertex beyond its 4"),
    "below": (msh(CORNERS, NUMBERS - 1), "a face has a vertex beyond its 4"),
    "not finite": (msh(CORNERS * np.nan, NUMBERS), "a coordinate is not finite"),
    "flat": (msh(CORNERS * 0.0), "it is flat: its hull has no volume"),
}


@pytest.mark.parametrize("name", BROKEN_MSH)
def test_a_broken_msh_is_refused_with_what_is_wrong(name: str) -> None:
    content, reason = BROKEN_MSH[name]
    with pytest.raises(InvalidMesh, match=f"'a.msh'.*({reason})"):
        read_triangles("a.msh", content)


def in_order(triangles: Array) -> Array:
    """Return the corners of all triangles, sorted."""
    corners = triangles.reshape(-1, 3).round(6) + 0.0
    return np.asarray(corners[np.lexsort(corners.T)])


@pytest.mark.parametrize(
    ("name", "content"),
    [("a.STL", binary_stl(FACES)), ("a.stl", text_stl(FACES)), ("a.obj", OBJ)],
    ids=["binary", "text", "obj"],
)
def test_the_same_triangles_from_each_format(name: str, content: bytes) -> None:
    np.testing.assert_allclose(in_order(read_triangles(name, content)), in_order(FACES))


def test_collada_has_its_unit_and_its_nodes_but_not_its_up_axis() -> None:
    expected = (2.0 * FACES + [1.0, 0.0, 0.0]) * 0.01
    np.testing.assert_allclose(in_order(read_triangles("a.dae", dae(0.01))), in_order(expected))


@pytest.mark.parametrize("unit", [1.0, 0.01])
def test_collada_is_placed_as_pinocchio_places_it(unit: float, tmp_path: Path) -> None:
    file = tmp_path / "a.dae"
    file.write_bytes(dae(unit))
    theirs = coal.MeshLoader().load(str(file), np.full(3, unit)).vertices()  # it drops the unit
    ours = read_triangles("a.dae", dae(unit)).reshape(-1, 3)
    np.testing.assert_allclose([ours.min(0), ours.max(0)], [theirs.min(0), theirs.max(0)], atol=1e-9)


CATALOGUE = sorted(
    path
    for path in package_data().rglob("*")
    if path.suffix.lower() in {".stl", ".obj", ".dae"} and "alex" not in path.parts
)


@pytest.mark.slow
@pytest.mark.parametrize("file", CATALOGUE[::40], ids=lambda path: path.name)
def test_meshes_of_the_catalogue_are_those_that_coal_reads(file: Path) -> None:
    theirs = coal.MeshLoader().load(str(file), np.ones(3))
    ours = read_triangles(file.name, file.read_bytes())
    corners, expected = ours.reshape(-1, 3), theirs.vertices()
    assert len(ours) >= theirs.num_tris
    limits = [expected.min(0), expected.max(0)]
    np.testing.assert_allclose([corners.min(0), corners.max(0)], limits, atol=1e-5 * np.ptp(corners, axis=0).max())


def _doubled(levels: int) -> str:
    """Return nodes of which each shows the next one twice."""
    twice = '<node id="{}"><instance_node url="#{}"/><instance_node url="#{}"/></node>'.format
    return "".join(twice(f"n{i}", f"n{i + 1}", f"n{i + 1}") for i in range(levels)) + f'<node id="n{levels}"/>'


HOSTILE = {
    "empty.stl": b"",
    "empty.obj": b"",
    "empty.dae": b"",
    "noise.stl": bytes(range(256)) * 4,
    "noise.dae": bytes(range(256)) * 4,
    "more_than_it_has.stl": binary_stl(FACES, 4_000_000_000),
    "not_a_number.stl": binary_stl(np.full((1, 3, 3), np.nan)),
    "infinite.stl": binary_stl(np.full((1, 3, 3), np.inf)),
    "huge.stl": binary_stl(np.full((1, 3, 3), 1e30)),
    "words.stl": b"solid s\nfacet normal 0 0 0\nouter loop\nvertex a b c\n",
    "no_triangle.obj": b"v 0 0 0\nv 1 0 0\n",
    "no_such_corner.obj": b"v 0 0 0\nf 1 2 3\n",
    "not_a_number.obj": OBJ.replace(b"v 1 0 0", b"v nan 0 0"),
    "unit.dae": dae(0.0),
    "unit_word.dae": dae("long"),
    "cut_off.dae": dae()[:-40],
    "no_geometry.dae": dae(content='<instance_geometry url="#other"/>'),
    "cycle.dae": dae(content='<node id="n"><instance_node url="#n"/></node>'),
    "explosion.dae": dae(content=_doubled(40)),
    "skinned.dae": dae(content='<instance_controller url="#g"/>'),
    "deep.dae": dae(content="<node>" * 5000 + INSTANCE + "</node>" * 5000),
    "many.dae": dae(content="<node/>" * 20_000 + INSTANCE),
    "entities.dae": b'<!DOCTYPE l [<!ENTITY a "aaa"><!ENTITY b "&a;&a;">]>' + dae()[21:],
    "outside.dae": b'<!DOCTYPE l SYSTEM "file:///etc/passwd">' + dae()[21:],
    "unknown.xyz": OBJ,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_broken_file_is_refused_with_its_name_and_a_reason(name: str) -> None:
    with pytest.raises(InvalidMesh) as refusal:
        read_triangles(name, HOSTILE[name])
    assert str(refusal.value).startswith(f"mesh '{name}': ")


def test_a_large_file_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(meshes, "MAX_TRIANGLES", 3)
    with pytest.raises(InvalidMesh, match="it has more than 3 triangles"):
        read_triangles("a.obj", OBJ)
    with pytest.raises(InvalidMesh, match="it has more than 3 triangles"):
        read_triangles("a.dae", dae())
    monkeypatch.setattr(meshes, "MAX_BYTES", 50)
    with pytest.raises(InvalidMesh, match="it has more than 50 bytes"):
        read_triangles("a.obj", OBJ)


POLYLIST = """<polylist><input semantic="VERTEX" source="#v" offset="1"/><input semantic="NORMAL" offset="0"/>
<vcount>3 3 3 3</vcount><p>9 0 9 2 9 1 9 0 9 1 9 3 9 0 9 3 9 2 9 1 9 2 9 3</p></polylist>"""


@pytest.mark.parametrize(
    "faces",
    [
        POLYLIST,
        '<tristrips><input semantic="VERTEX" source="#v"/><p>0 2 1 3 0 2</p></tristrips>',
        '<trifans><input semantic="VERTEX" source="#v"/><p>0 1 2 3 1</p><p>1 2 3</p></trifans>',
        '<polygons><input semantic="VERTEX" source="#v"/><p>0 2 1</p><p>0 1 3</p><p>0 3 2</p><p>1 2 3</p></polygons>',
    ],
    ids=["polylist", "tristrips", "trifans", "polygons"],
)
def test_collada_has_several_kinds_of_faces(faces: str) -> None:
    before, _, after = dae().decode().partition("<triangles")
    triangles = read_triangles("a.dae", (before + faces + after.partition("</triangles>")[2]).encode())
    assert {tuple(sorted(map(tuple, triangle))) for triangle in triangles.round(9).tolist()} == {
        tuple(sorted(map(tuple, triangle))) for triangle in (2.0 * FACES + [1.0, 0.0, 0.0]).tolist()
    }


def test_nodes_turn_and_show_what_others_hold() -> None:
    content = f'<node id="n"><rotate>0 0 2 90</rotate>{INSTANCE}</node><instance_node url="#n"/>'
    once = 2.0 * FACES @ np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]) + [1.0, 0.0, 0.0]
    found = read_triangles("a.dae", dae(content=content))
    np.testing.assert_allclose(in_order(found), in_order(np.concatenate((once, once))), atol=1e-9)


def test_files_that_a_mesh_names_are_not_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.mtl").write_text("newmtl m\nmap_Kd m.png\n")
    opened = []
    monkeypatch.setattr(Path, "open", lambda path, *_, **__: opened.append(path))
    assert len(read_triangles("a.obj", b"mtllib m.mtl\nusemtl m\n" + OBJ)) == 4
    assert opened == []
