"""Uploads with broken meshes and SRDFs: accepted with warnings, and an error where contacts are asked for."""

from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import pytest

from gelenk.errors import InvalidArchive, InvalidMesh
from gelenk.operations.robot_bodies import bodies_of
from gelenk.store import findings as store_findings
from gelenk.store.archive import unpacked
from gelenk.store.findings import findings
from gelenk.store.library import Library, RobotUpload
from gelenk.store.records import LoadedRobot

TETRAHEDRON = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
URDF = """<robot name="r">{}
<joint name="a" type="continuous"><parent link="1"/><child link="2"/><origin xyz="9 0 0"/></joint>
<joint name="b" type="continuous"><parent link="2"/><child link="3"/><origin xyz="9 0 0"/></joint></robot>"""
LINK = '<link name="{}"><collision><geometry><mesh filename="part.obj"/></geometry></collision></link>'.format
SRDF = b'<robot name="r"><disable_collisions link1="1" link2="3" reason="Never"/></robot>'


def stored(folder: Path, mesh: bytes, srdf: bytes, *more: tuple[str, bytes]) -> LoadedRobot:
    file = BytesIO()
    entries = [("r.urdf", URDF.format("".join(map(LINK, "123"))).encode()), ("part.obj", mesh), ("cfg/r.srdf", srdf)]
    with ZipFile(file, "w") as archive:
        for name, content in (*entries, *more):
            archive.writestr(name, content)
    library = Library(Path("robots"), folder)
    with unpacked(file) as robot:
        library.add(RobotUpload("arm", "urdf", robot.model, meshes=robot.meshes, srdf=robot.srdf))
    return library.get("arm")


def test_an_srdf_in_the_archive_leaves_pairs_out(tmp_path: Path) -> None:
    loaded = stored(tmp_path, TETRAHEDRON, SRDF)
    assert loaded.record.file.findings == []
    assert {(pair.a, pair.b): pair.reason for pair in bodies_of(loaded).pairs}["1", "3"] == "srdf"
    srdf = loaded.record.srdf_path
    assert srdf is not None
    assert srdf.read_bytes() == SRDF


def test_a_broken_srdf_and_a_broken_mesh_are_warnings_of_the_upload(tmp_path: Path) -> None:
    loaded = stored(tmp_path, b"v 0 0 0\nf 1 2 3\n", b"<robot>\n<disable_collisions\n</robot>")
    mesh, srdf = loaded.record.file.findings
    assert {mesh, srdf} <= set(loaded.warnings)
    assert mesh.startswith("mesh 'part.obj': it cannot be read as OBJ: ")
    assert srdf.startswith("the SRDF is not read: line 3: ")
    with pytest.raises(InvalidMesh, match=r"mesh 'part\.obj'"):
        bodies_of(loaded)


def test_a_broken_srdf_leaves_no_pair_out(tmp_path: Path) -> None:
    loaded = stored(tmp_path, TETRAHEDRON, b"\xff\xfe")
    assert {(pair.a, pair.b): pair.reason for pair in bodies_of(loaded).pairs}["1", "3"] is None


def test_two_srdfs_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InvalidArchive, match="the archive holds 2 SRDF files; it may hold one"):
        stored(tmp_path, TETRAHEDRON, SRDF, ("other.srdf", SRDF))


def test_another_srdf_makes_another_robot(tmp_path: Path) -> None:
    digest = stored(tmp_path / "a", TETRAHEDRON, SRDF).record.file.digest
    assert digest != stored(tmp_path / "b", TETRAHEDRON, SRDF + b"\n").record.file.digest


def test_of_many_broken_meshes_some_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    found = findings({f"{i}.stl": b"" for i in range(20)} | {"m.mtl": b""}, None)
    assert (len(found), found[-1]) == (13, "8 more meshes cannot be read")
    monkeypatch.setattr(store_findings, "_SECONDS", -1.0)
    assert findings({"a.stl": b""}, None) == ["not all meshes were opened, because that takes long"]
