"""Meshes of an archive are found by what their names and the files' paths have in common, and never by a guess."""

from collections.abc import Sequence
from pathlib import Path

import pytest

from gelenk.store.library import Library
from gelenk.store.meshes import MeshFiles, mesh_warnings
from tests.store.test_archive import CATALOGUE, kept, urdf, zipped

SOLID = b"solid s\nendsolid s\n"
REPOSITORY = [
    "robots-main/README.md",
    *(
        f"robots-main/{robot}_support/meshes/{robot}/{role}/link_{number}.stl"
        for robot in ("irb140", "irb120")
        for role in ("visual", "collision")
        for number in range(7)
    ),
    "robots-main/irb140_support/urdf/irb140.xacro",
    "robots-main/irb140_support/urdf/irb140_macro.xacro",
]
"""A repository as it is downloaded, with two packages; `urdf/irb140.urdf` is added to the first."""
NAMES = [f"irb140/{role}/link_{number}.stl" for role in ("visual", "collision") for number in range(7)]


@pytest.mark.parametrize("name", ["package://irb140_support/meshes/{}", "package://renamed/meshes/{}", "../meshes/{}"])
@pytest.mark.parametrize("top", ["", "below/"])
def test_all_meshes_of_a_downloaded_repository_are_found(tmp_path: Path, name: str, top: str) -> None:
    library = Library(CATALOGUE, tmp_path)
    description = urdf(*(name.format(mesh) for mesh in NAMES))
    files = [(top + path, path.encode()) for path in REPOSITORY]
    kept(library, "arm", zipped([*files, (f"{top}robots-main/irb140_support/urdf/irb140.urdf", description)]))
    found = library.get("arm")
    assert list(found.meshes.values()) == [f"{top}robots-main/irb140_support/meshes/{mesh}" for mesh in NAMES]
    assert all(
        library.mesh("arm", path).read_bytes() == path[len(top) :].encode() for path in found.meshes.values() if path
    )
    left_out = [text for text in found.warnings if "that nothing refers to" in text]
    assert len(left_out) == 1
    by_address = library.mesh("arm", name.format(NAMES[0]).removeprefix("package://")) if "//" in name else None
    assert by_address in {None, library.mesh("arm", found.meshes[name.format(NAMES[0])] or "")}


@pytest.mark.parametrize(
    ("reference", "paths", "urdf_folder", "found"),
    [
        ("package://p/m/a.stl", ["m/a.stl"], "", ["m/a.stl"]),
        ("package://p/m/a.stl", ["a.stl"], "", ["a.stl"]),
        ("package://p/m/a.stl", ["a.stl", "r/p/m/a.stl"], "", ["r/p/m/a.stl"]),
        ("package://p/m/a.stl", ["r/p/m/a.stl", "r/q/m/a.stl"], "r/q", ["r/p/m/a.stl"]),
        ("package://p/m/a.stl", ["r/o/m/a.stl", "r/q/m/a.stl"], "r/q/urdf", ["r/q/m/a.stl"]),
        ("package://p/m/a.stl", ["src/p/m/a.stl", "install/p/m/a.stl"], "src/p/urdf", ["src/p/m/a.stl"]),
        ("package://p/m/a.stl", ["r/o/m/a.stl", "r/q/m/a.stl"], "r", ["r/o/m/a.stl", "r/q/m/a.stl"]),
        ("package://p/visual/a.stl", ["r/p/collision/a.stl"], "r/p", []),
        ("package://p/visual/a.stl", ["r/p/a.stl"], "r/p", []),
        ("model://p/m/a.stl", ["r/p/m/a.stl"], "", ["r/p/m/a.stl"]),
        ("file:///opt/p/m/a.stl", ["opt/p/m/a.stl"], "", []),
        ("https://p/m/a.stl", ["p/m/a.stl"], "", []),
        ("/p/m/a.stl", ["p/m/a.stl"], "", []),
        ("package://o/robots/p/m/a.stl", ["w/src/p/m/a.stl"], "w/src/p/urdf", ["w/src/p/m/a.stl"]),
        ("package://o/robots/p/m/a.stl", ["w/src/p/m/a.stl"], "w", []),
        ("package://o/robots/p/m/a.stl", ["w/src/p/m/a.stl", "w/p/m/a.stl"], "w/src/p/urdf", ["w/src/p/m/a.stl"]),
        ("package://o/robots/q/m/a.stl", ["w/src/p/m/a.stl"], "w/src/p/urdf", []),
        ("file:///opt/share/p/m/a.stl", ["w/src/p/m/a.stl"], "w/src/p/urdf", ["w/src/p/m/a.stl"]),
        ("file:///opt/share/p/m/a.stl", ["m/a.stl", "a.stl"], "urdf", []),
        ("m/a.stl", ["r/m/a.stl", "m/a.stl"], "r", ["r/m/a.stl"]),
        ("m/a.stl", ["r/m/a.stl"], "r/urdf", ["r/m/a.stl"]),
        ("../m/a.stl", ["r/m/a.stl"], "r/urdf", ["r/m/a.stl"]),
        ("../../m/a.stl", ["m/a.stl"], "", ["m/a.stl"]),
        ("visual/a.stl", ["r/collision/a.stl"], "r", []),
        ("A.stl", ["a.stl"], "", []),
    ],
)
def test_which_file_a_name_means(reference: str, paths: list[str], urdf_folder: str, found: list[str]) -> None:
    assert sorted(MeshFiles(paths, urdf_folder).find(reference)) == sorted(found)


@pytest.mark.parametrize(
    ("found", "words"),
    [
        ({"a.stl": ["a.stl"]}, []),
        ({"a.glb": []}, ["mesh 'a.glb' is not shown: glb is not read: STL, OBJ, DAE, MSH"]),
        ({"a.glb": [], "b.PLY": []}, ["2 meshes ('a.glb', 'b.PLY') are not shown: PLY, glb are not read"]),
        ({"a.stl": []}, ["mesh 'a.stl' is missing"]),
        ({f"{n}.stl": [] for n in range(14)}, ["14 meshes ('0.stl', '1.stl'"]),
        ({"a.stl": ["p/a.stl", "q/a.stl"]}, ["mesh 'a.stl' is not shown: several files match: 'p/a.stl', 'q/a.stl'"]),
        ({"a.stl": [], "a.glb": [], "b.stl": ["p/b.stl", "q/b.stl"]}, ["glb", "missing", "several files match"]),
    ],
)
def test_one_warning_for_all_meshes_with_the_same_fault(found: dict[str, Sequence[str]], words: list[str]) -> None:
    told = mesh_warnings(found)
    assert len(told) == len(words)
    assert all(word in text for word, text in zip(words, told, strict=True))


def test_files_that_fit_alike_are_told_and_none_is_taken(tmp_path: Path) -> None:
    library = Library(CATALOGUE, tmp_path)
    files = [("r/r.urdf", urdf("package://p/m/a.stl", "b.glb", "c.dae", "d.dae")), ("r/b.glb", b"glTF")]
    kept(library, "arm", zipped([*files, ("r/o/m/a.stl", b"o"), ("r/q/m/a.stl", b"q")]))
    found = library.get("arm")
    assert set(found.meshes.values()) == {None}
    told = " ".join(found.warnings)
    assert "glb is not read: STL, OBJ, DAE, MSH" in told
    assert "2 meshes ('c.dae', 'd.dae') are missing" in told
    assert "several files match: 'r/o/m/a.stl', 'r/q/m/a.stl'" in told


def test_a_robot_kept_with_folders_by_an_earlier_version_keeps_its_meshes(tmp_path: Path) -> None:
    folder = tmp_path / "arm" / "files-0123456789ab"
    (folder / "meshes" / "r" / "m").mkdir(parents=True)
    (folder / "meshes" / "r" / "m" / "a.stl").write_bytes(SOLID)
    (folder / "robot.urdf").write_bytes(urdf("package://p/m/a.stl"))
    (tmp_path / "arm" / "robot.json").write_text(
        '{"format": "urdf", "model": "files-0123456789ab/robot.urdf", "meshes": "files-0123456789ab/meshes"}'
    )
    library = Library(CATALOGUE, tmp_path)
    assert library.get("arm").meshes == {"package://p/m/a.stl": "r/m/a.stl"}
    assert library.mesh("arm", "r/m/a.stl").read_bytes() == SOLID
