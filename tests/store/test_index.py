"""The file that the list of robots is made from: derived from the folders, whatever becomes of it."""

import json
import random
from collections.abc import Callable
from pathlib import Path

import pytest

from gelenk.store import index
from gelenk.store.library import Library, RobotUpload
from gelenk.store.records import Record, uploaded_record

URDF = (
    b'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous">'
    b'<parent link="a"/><child link="b"/></joint></robot>'
)


@pytest.fixture
def new(tmp_path: Path) -> Callable[[], Library]:
    """Makes libraries of one folder, as another process would."""
    (tmp_path / "catalogue").mkdir()
    return lambda: Library(tmp_path / "catalogue", tmp_path / "robots")


def upload(name: str, description: str = "") -> RobotUpload:
    return RobotUpload(name, "urdf", URDF, description)


def listed(library: Library) -> dict[str, str]:
    robots = [json.loads(line) for line in library.summaries()]
    assert [robot["name"] for robot in robots] == sorted(robot["name"] for robot in robots)
    return {robot["name"]: robot["description"] for robot in robots}


def edit(folder: Path, description: str) -> None:
    file = folder / "robot.json"
    content = json.loads(file.read_bytes())
    file.write_text(json.dumps(content | {"description": description}))


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", range(6))
def test_the_list_is_what_the_folders_are_whatever_happens_to_the_index(
    seed: int, new: Callable[[], Library], tmp_path: Path
) -> None:
    """Two processes write, a person edits and removes folders, and the index is cut, scribbled over and removed."""
    rng, root = random.Random(seed), tmp_path / "robots"
    processes, there, file = [new(), new()], dict[str, str](), root / ".index"
    for step in range(60):
        process, name, text = rng.choice(processes), f"r{rng.randrange(6)}", f"as of step {step}\t\n"
        match rng.randrange(8):
            case 0 | 1 | 2 if name not in there:
                process.add(upload(name, text))
                there[name] = text
            case 0 | 1 if name in there:
                process.replace(upload(name, text))
                there[name] = text
            case 2 | 3 if name in there:
                process.remove(name)
                del there[name]
            case 4 if name in there:
                edit(root / name, text)
                there[name] = text
            case 5 if file.exists():
                content = file.read_bytes()
                file.write_bytes(content[: rng.randrange(len(content) + 1)])
            case 6 if file.exists():
                scribbled = bytearray(file.read_bytes())
                for _ in range(len(scribbled) and 5):
                    scribbled[rng.randrange(len(scribbled))] = rng.randrange(256)
                file.write_bytes(scribbled)
            case 7:
                file.unlink(missing_ok=True)
        if rng.random() < 0.7:
            assert listed(rng.choice(processes)) == there
    for library in (*processes, new()):
        assert listed(library) == there


def test_another_process_lists_robots_without_reading_each(
    new: Callable[[], Library], monkeypatch: pytest.MonkeyPatch
) -> None:
    one, other = new(), new()
    for number in range(10):
        one.add(upload(f"r{number}"))
    read: list[str] = []

    def noted(folder: Path) -> Record | None:
        read.append(folder.name)
        return uploaded_record(folder)

    monkeypatch.setattr(index, "uploaded_record", noted)
    assert len(listed(other)) == 10
    one.replace(upload("r3", "another"))
    one.remove("r4")
    one.add(upload("r5x"))
    assert listed(other)["r3"] == "another"
    assert read == []


def test_of_many_robots_each_list_looks_at_some_and_at_all_in_turn(
    new: Callable[[], Library], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(index.Index.entries, "__defaults__", (3,))
    library = new()
    for number in range(10):
        library.add(upload(f"r{number}"))
    assert set(listed(library).values()) == {""}
    for number in range(10):
        edit(tmp_path / "robots" / f"r{number}", "edited")
    counts = [list(listed(library).values()).count("edited") for _ in range(4)]
    assert counts == [3, 6, 9, 10]


def test_a_service_that_starts_looks_at_all(new: Callable[[], Library], tmp_path: Path) -> None:
    library = new()
    for number in range(3):
        library.add(upload(f"r{number}"))
    edit(tmp_path / "robots" / "r1", "edited")
    lines = (tmp_path / "robots" / ".index").read_bytes()
    new().prepare()
    added = (tmp_path / "robots" / ".index").read_bytes().removeprefix(lines)
    assert b"edited" in added
    assert len(added.split()) < 30


def test_outdated_lines_are_dropped_when_there_are_many(
    new: Callable[[], Library], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(index, "_SPARE_LINES", 10)
    library, other = new(), new()
    library.add(upload("still"))
    library.add(upload("arm"))
    for number in range(60):
        library.replace(upload("arm", str(number)))
        assert listed(other) == {"arm": str(number), "still": ""} == listed(library)
        assert (tmp_path / "robots" / ".index").read_bytes().count(b"arm") < 60
    assert listed(new()) == {"arm": "59", "still": ""}


def test_lines_of_another_release_are_read_anew(
    new: Callable[[], Library], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A list kept by an older release lacks the fields that were added since."""
    with monkeypatch.context() as older:
        older.setattr(index, "ABOUT", ("description",))
        older.setattr(index, "_FORM", 0)
        new().add(upload("arm", "kept"))
        assert b"maker" not in (tmp_path / "robots" / ".index").read_bytes()
    (line,) = new().summaries()
    assert json.loads(line)["maker"] is None
    assert json.loads(line)["description"] == "kept"
