"""Whatever stands in the place of a file of the data folder, nothing waits for it, as it would for a pipe, forever."""

import os
import shutil
import signal
import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from gelenk.errors import KinematicsError
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.robot_files import robot_text
from gelenk.jobs.store import JobStore
from gelenk.store.folders import read_plain
from gelenk.store.library import Library, RobotUpload
from tests.store.test_archive import CATALOGUE, urdf

MOST_SECONDS = 60
"""For what takes a few milliseconds: what waits for a pipe waits for ever."""


def _socket(path: Path) -> None:
    short = Path("/proc/self/fd") / str(os.open(path.parent, os.O_RDONLY))
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(short / path.name))


KINDS: dict[str, Callable[[Path], object]] = {
    "pipe": os.mkfifo,
    "folder": Path.mkdir,
    "socket": _socket,
    "dangling link": lambda path: path.symlink_to("nowhere"),
    "link to a device": lambda path: path.symlink_to("/dev/tty"),
}


@contextmanager
def at_most(seconds: int, what: str) -> Iterator[None]:
    """Break off what waits for longer, in the main thread."""

    def late(*_: object) -> None:
        raise AssertionError(f"it waits for {what}")

    before = signal.signal(signal.SIGALRM, late)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def used(data: Path) -> None:
    """Everything that a service does with its data folder, at its start and for requests."""
    library, store = Library(CATALOGUE, data / "robots"), JobStore(data / "jobs", JobLimits(unfinished=100))
    steps: list[Callable[[], object]] = [
        library.prepare,
        library.summaries,
        lambda: library.get("arm"),
        lambda: read_plain(library.mesh("arm", "m/a.stl")),
        lambda: library.add(RobotUpload("arm", "urdf", urdf())),
        lambda: library.add(RobotUpload("new", "urdf", urdf())),
        lambda: library.replace(RobotUpload("arm", "urdf", urdf("m/a.stl"), meshes={"m/a.stl": b"solid"})),
        store.prepare,
        store.states,
        lambda: store.get("mine"),
        lambda: robot_text(store.request("mine")),
        lambda: store.parts(store.get("mine")).read("1"),
        lambda: store.add("ik", "digest", {}, "mine"),
        lambda: store.add("ik", "digest", {}, "other"),
        store.take_up,
        store.tidy,
        lambda: store.remove("mine"),
        lambda: library.remove("arm"),
    ]
    for step in steps:
        with suppress(KinematicsError, OSError, ValueError):
            step()
    store.close()


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    data = tmp_path_factory.mktemp("data")
    library, store = Library(CATALOGUE, data / "robots"), JobStore(data / "jobs", JobLimits())
    library.add(RobotUpload("arm", "urdf", urdf("m/a.stl"), meshes={"m/a.stl": b"solid"}))
    job, _ = store.add("ik", "digest", {"robot.urdf": b"<robot/>", "robot.json": b'["arm", "a", "b"]'}, "mine")
    store.parts(job).write("1", b"part")
    store.close()
    (data / "jobs" / ".owners" / job.owner).touch()  # as a killed process leaves it
    return data


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_nothing_waits_for_what_is_no_file(template: Path, tmp_path: Path, kind: str) -> None:
    files = sorted(path.relative_to(template) for path in template.rglob("*") if path.is_file())
    assert len(files) >= 9
    for number, name in enumerate(files):
        data = tmp_path / str(number)
        shutil.copytree(template, data)
        (data / name).unlink()
        KINDS[kind](data / name)
        with at_most(MOST_SECONDS, f"{kind} {name}"):
            used(data)
