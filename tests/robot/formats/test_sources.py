"""The files of an archive: which of them is the robot, and how they are found."""

import time
from io import BytesIO

import pytest

from gelenk.errors import InvalidArchive
from gelenk.store import archive
from gelenk.store.archive import MAX_CANDIDATES, MAX_INDICES, unpacked
from gelenk.store.meshes import MeshFiles
from tests.corpus.zips import zipped

ROBOT = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="a"/>{}</robot>'


def chosen(files: dict[str, str | bytes]) -> str:
    with unpacked(BytesIO(zipped(files))) as found:
        return found.path


def test_a_part_is_what_another_file_names_wholly() -> None:
    part = ROBOT.format("")
    for path in ("arm.xacro", "$(find arm)/urdf/arm.xacro", "../arm.xacro"):
        whole = ROBOT.format(f"<xacro:include filename='{path}'/>")
        assert chosen({"arm.xacro": part, "cell.xacro": whole}) == "cell.xacro"
    other = ROBOT.format('<xacro:include filename="left_arm.xacro"/>')
    files: dict[str, str | bytes] = {"arm.xacro": part, "cell.xacro": other, "left_arm.xacro": part}
    with pytest.raises(InvalidArchive, match="holds 2 descriptions") as refused:
        chosen(files)
    assert refused.value.files == ("arm.xacro", "cell.xacro")


def test_names_are_looked_for_in_one_way_at_once() -> None:
    started = time.process_time()
    for hostile in (b"a" * 1_000_000, b'"' * 1_000_000, b'"aaaa' * 200_000, b"/" + b"a" * 1_000_000):
        archive._NAMED.findall(hostile)
    assert time.process_time() - started < 20


def test_of_very_many_files_one_is_named() -> None:
    many: dict[str, str | bytes] = {f"{n}.xacro": ROBOT.format("") for n in range(MAX_CANDIDATES + 1)}
    with pytest.raises(InvalidArchive, match="holds 201 xacro and XML files; name the robot's in `file`"):
        chosen(many)
    with unpacked(BytesIO(zipped(many)), wanted="7.xacro") as found:
        assert found.path == "7.xacro"


def test_few_indices_of_folders_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[str] = []

    class Noted(MeshFiles):
        def __init__(self, paths: object, folder: str) -> None:
            made.append(folder)
            super().__init__(paths, folder)  # type: ignore[arg-type]

    monkeypatch.setattr(archive, "MeshFiles", Noted)
    with unpacked(BytesIO(zipped({"a.xacro": ROBOT.format("")}))) as found:
        for folder in [*map(str, range(MAX_INDICES)), "0", "last", "0"]:
            assert found.sources.find("a.xacro", folder) == ["a.xacro"]
    assert made == [*map(str, range(MAX_INDICES)), "last", "0"]
