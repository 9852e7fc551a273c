"""Robots on disk: what is acknowledged is there after a kill at any moment; every process sees it at once."""

import errno
import json
import multiprocessing
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from gelenk.errors import InvalidName, InvalidUrdf, ReadOnlyRobot, RobotExists, StorageFailed, UnknownRobot
from gelenk.store import folders
from gelenk.store.library import Library, RobotUpload

CATALOGUE = Path("robots")
KILLS = 8


def one_joint(height: float) -> bytes:
    """A robot whose only number tells which one it is."""
    return (
        '<robot name="r"><link name="base"/><link name="tip"/><joint name="j" type="continuous">'
        f'<parent link="base"/><child link="tip"/><origin xyz="0 0 {height}"/><axis xyz="0 0 1"/></joint></robot>'
    ).encode()


def height_of(library: Library, name: str) -> float:
    return float(library.get(name).robot.chain(None, None).flat.placements[0, 11])


@pytest.fixture
def library(tmp_path: Path) -> Library:
    return Library(CATALOGUE, tmp_path / "robots")


def test_add_replace_remove(library: Library) -> None:
    assert library.add(RobotUpload("arm", "urdf", one_joint(1)))
    assert not library.add(RobotUpload("arm", "urdf", one_joint(1)))
    with pytest.raises(RobotExists):
        library.add(RobotUpload("arm", "urdf", one_joint(2)))
    library.replace(RobotUpload("arm", "urdf", one_joint(2)))
    assert height_of(library, "arm") == 2
    library.remove("arm")
    with pytest.raises(UnknownRobot):
        library.get("arm")
    assert library.loaded("arm") is None


@pytest.mark.parametrize("name", ["", ".", "..", ".lock", "a/b", "a\0", "-a", "ä", "a" * 65, "a\n"])
def test_names_fit_for_paths_only(library: Library, name: str) -> None:
    with pytest.raises(InvalidName):
        library.add(RobotUpload(name, "urdf", one_joint(1)))
    for call in (library.get, library.remove):
        with pytest.raises(UnknownRobot):
            call(name)


def test_the_catalogue_is_not_written_to(library: Library) -> None:
    with pytest.raises(ReadOnlyRobot):
        library.remove("panda")
    with pytest.raises(ReadOnlyRobot):
        library.replace(RobotUpload("panda", "urdf", one_joint(1)))


def test_what_is_no_robot_leaves_no_trace(library: Library, tmp_path: Path) -> None:
    library.add(RobotUpload("arm", "urdf", one_joint(1)))
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(InvalidUrdf):
        library.add(RobotUpload("other", "urdf", b"<robot/>"))
    with pytest.raises(InvalidUrdf):
        library.replace(RobotUpload("arm", "urdf", b"<robot/>"))
    assert sorted(tmp_path.rglob("*")) == before
    assert height_of(library, "arm") == 1


def test_a_replacement_leaves_only_its_own_files(library: Library, tmp_path: Path) -> None:
    library.add(RobotUpload("arm", "urdf", one_joint(1), meshes={"meshes/a.stl": b"solid"}))
    library.replace(RobotUpload("arm", "urdf", one_joint(2)))
    names = sorted(path.name for path in (tmp_path / "robots" / "arm").iterdir())
    record = json.loads((tmp_path / "robots" / "arm" / "robot.json").read_text())
    assert names == sorted(["robot.json", record["model"].split("/")[0]])


def test_another_process_sees_it_at_once(library: Library, tmp_path: Path) -> None:
    other = Library(CATALOGUE, tmp_path / "robots")
    for height in (1, 2, 3):
        if height == 1:
            library.add(RobotUpload("arm", "urdf", one_joint(height)))
        else:
            library.replace(RobotUpload("arm", "urdf", one_joint(height)))
        assert height_of(other, "arm") == height
    library.remove("arm")
    with pytest.raises(UnknownRobot):
        other.get("arm")


def replace_many(root: Path, start: int) -> None:
    library = Library(CATALOGUE, root)
    for height in range(start, start + 20):
        library.replace(RobotUpload("arm", "urdf", one_joint(height)))


@pytest.mark.slow
def test_writers_take_turns_and_readers_never_see_half(library: Library, tmp_path: Path) -> None:
    root = tmp_path / "robots"
    library.add(RobotUpload("arm", "urdf", one_joint(1)))
    context = multiprocessing.get_context("spawn")
    writers = [context.Process(target=replace_many, args=(root, start)) for start in (100, 200)]
    for writer in writers:
        writer.start()
    seen = set()
    while any(writer.is_alive() for writer in writers):
        seen.add(height_of(library, "arm"))
    for writer in writers:
        writer.join()
        assert writer.exitcode == 0
    assert height_of(library, "arm") in {119, 219}
    assert seen <= {1, *range(100, 120), *range(200, 220)}
    assert len(seen) > 3
    assert len(list((root / "arm").iterdir())) == 2


WRITER = """
import sys
from pathlib import Path
from gelenk.store.library import Library, RobotUpload
from tests.store.test_library import one_joint
library = Library(Path("robots"), Path(sys.argv[1]))
library.prepare()
for height in range(int(sys.argv[2]), 10**6):
    if height % 5 == 0:
        library.add(RobotUpload(f"new{height}", "urdf", one_joint(height)))
        print("new", height, flush=True)
    else:
        library.replace(RobotUpload("arm", "urdf", one_joint(height)))
        print("arm", height, flush=True)
"""


@pytest.mark.slow
def test_a_kill_at_any_moment_leaves_the_old_robot_or_the_new(library: Library, tmp_path: Path) -> None:
    """A writer is killed again and again; after each kill all that it has acknowledged is there, nothing is half."""
    root = tmp_path / "robots"
    library.add(RobotUpload("arm", "urdf", one_joint(0)))
    chance = random.Random(1)
    added: set[int] = set()
    last = 0
    for _ in range(KILLS):
        command = [sys.executable, "-c", WRITER, str(root), str(last + 1)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as writer:
            assert writer.stdout is not None
            lines = [writer.stdout.readline()]
            time.sleep(chance.uniform(0.0, 0.05))
            os.kill(writer.pid, signal.SIGKILL)
            lines += writer.stdout.readlines()
        acknowledged = [line.split() for line in lines if line.endswith("\n") and line.strip()]
        added |= {int(height) for kind, height in acknowledged if kind == "new"}
        last = max(last, *(int(height) for _, height in acknowledged))
        latest = max([0, *(int(height) for kind, height in acknowledged if kind == "arm")])
        # The write that the kill interrupted may have become visible too, though nobody was told.
        assert height_of(library, "arm") >= latest
        for height in added:
            assert height_of(library, f"new{height}") == height
        last += 2
    library.prepare()
    assert not [path for path in root.rglob("*") if path.name.startswith((".new-", ".old-"))]
    assert added


REPLACER = """
import sys
from pathlib import Path
from gelenk.store.library import Library, RobotUpload
from tests.store.test_library import one_joint
library = Library(Path("robots"), Path(sys.argv[1]))
print("ready", flush=True)
library.replace(RobotUpload("by_hand", "urdf", one_joint(2)))
library.remove("by_hand")
print("removed", flush=True)
"""


@pytest.mark.slow
def test_a_folder_dropped_in_by_hand_is_replaced_and_removed_as_safely(tmp_path: Path) -> None:
    """Killed anywhere between its replacement and its removal, it is the old robot, the new one, or gone."""
    root = tmp_path / "robots"
    chance = random.Random(2)
    for _ in range(KILLS):
        folder = root / "by_hand"
        folder.mkdir(parents=True)
        (folder / "mine.urdf").write_bytes(one_joint(1))
        with subprocess.Popen([sys.executable, "-c", REPLACER, str(root)], stdout=subprocess.PIPE, text=True) as writer:
            assert writer.stdout is not None
            writer.stdout.readline()
            time.sleep(chance.uniform(0.0, 0.03))
            os.kill(writer.pid, signal.SIGKILL)
            removed = "removed" in writer.stdout.read()
        library = Library(CATALOGUE, root)
        library.prepare()
        if folder.exists():
            assert not removed
            assert height_of(library, "by_hand") in {1, 2}
            library.remove("by_hand")
        else:
            with pytest.raises(UnknownRobot):
                library.get("by_hand")
        assert [path.name for path in root.iterdir()] in ([".lock"], [])


def test_a_stale_version_is_swept_and_notes_of_a_person_are_not(library: Library, tmp_path: Path) -> None:
    library.add(RobotUpload("arm", "urdf", one_joint(1)))
    folder = tmp_path / "robots" / "arm"
    (folder / "files-0123456789ab").mkdir()
    (folder / "notes.txt").write_text("mine")
    library.prepare()
    assert not (folder / "files-0123456789ab").exists()
    assert (folder / "notes.txt").exists()
    assert height_of(library, "arm") == 1


@pytest.mark.parametrize("by_hand", [True, False])
def test_a_replacement_that_fails_at_its_last_step_leaves_the_old_robot_and_nothing_else(
    library: Library, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, by_hand: bool
) -> None:
    folder = tmp_path / "robots" / "arm"
    if by_hand:
        folder.mkdir(parents=True)
        (folder / "mine.urdf").write_bytes(one_joint(1))
    else:
        library.add(RobotUpload("arm", "urdf", one_joint(1)))
    before = sorted(folder.rglob("*"))
    monkeypatch.setattr("gelenk.store.folders.Path.replace", refuse_to_write)
    with pytest.raises(StorageFailed):
        library.replace(RobotUpload("arm", "urdf", one_joint(2)))
    assert sorted(folder.rglob("*")) == before
    assert height_of(library, "arm") == 1


def test_a_data_folder_that_cannot_be_written_to_does_not_keep_the_service_from_starting(
    library: Library, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "robots").mkdir()
    monkeypatch.setattr("gelenk.store.folders.fcntl.flock", refuse_to_write)
    library.prepare()
    assert library.get("panda")


def refuse_to_write(*_: object) -> None:
    raise OSError(errno.EROFS, os.strerror(errno.EROFS))


def test_orphans_are_swept_under_the_lock(tmp_path: Path) -> None:
    root = tmp_path / "robots"
    (root / ".new-1").mkdir(parents=True)
    (root / "arm" / ".new-2").mkdir(parents=True)
    with folders.exclusive(root):
        folders.sweep(root)
        folders.sweep(root / "arm")
    assert sorted(path.name for path in root.rglob("*")) == [".lock", "arm"]


def test_who_writes_sweeps_first(library: Library, tmp_path: Path) -> None:
    """Of writers that are killed one after the other no more is left than the last one was at."""
    library.add(RobotUpload("arm", "urdf", one_joint(1)))
    root = tmp_path / "robots"

    def leave_orphans() -> None:
        for folder in (root, root / "arm"):
            (folder / ".new-1" / "meshes").mkdir(parents=True)
        (root / ".old-1").mkdir()

    def orphans() -> set[str]:
        return {str(path.relative_to(root)) for path in root.rglob(".[no][el][wd]-*")}

    leave_orphans()
    library.replace(RobotUpload("arm", "urdf", one_joint(2)))
    assert orphans() == set()
    leave_orphans()
    library.add(RobotUpload("other", "urdf", one_joint(1)))
    assert orphans() == {"arm/.new-1"}
    library.prepare()
    assert orphans() == set()


def test_a_stale_file_beside_the_record_is_harmless(library: Library, tmp_path: Path) -> None:
    library.add(RobotUpload("arm", "urdf", one_joint(1)))
    (tmp_path / "robots" / "arm" / "robot-leftover.urdf").write_text("<robot")
    assert height_of(library, "arm") == 1


def test_names_come_with_those_that_are_near(library: Library) -> None:
    with pytest.raises(UnknownRobot) as caught:
        library.get("pnada")
    assert "panda" in caught.value.close


def test_memory_is_bounded(library: Library, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.store.library._MEMORY", 2_000_000)
    monkeypatch.setattr("gelenk.store.library._weight", lambda _: 500_000)
    for name in ("ur3", "ur5", "ur10", "scara", "planar_2r"):
        library.get(name)
        assert library.loaded("ur3")  # what is in use stays
    assert library.loaded("ur5") is None
    assert library.loaded("planar_2r") is not None
