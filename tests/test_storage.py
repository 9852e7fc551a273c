"""A disk that is full or read-only, for real: what cannot be kept says so, all else goes on, and room makes it good.

The service sees a small disk of its own, in memory, in a name space of mounts that ends with it.
"""

import contextlib
import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.test_faults import QUICK, wait_for
from tests.test_serve import HOST, free_port
from tests.uploads import Upload, ask

MEBIBYTE = 1024 * 1024
SIZE = 4 * MEBIBYTE
_JOB = {"samples": 400_000, "kind": "cloud"}
"""Its positions and measures take 12.8 MB."""

pytestmark = pytest.mark.skipif(
    subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode != 0,
    reason="the system allows no name space of mounts",
)


class Disk:
    """The disk that the service keeps its data on, seen from outside its name space."""

    def __init__(self, pid: int, folder: Path) -> None:
        self._pid, self._folder = pid, folder
        self.root = Path(f"/proc/{pid}/root{folder}")

    def fill(self) -> None:
        """Leave no room at all, for no file either."""
        with (self.root / "filler").open("wb", buffering=0) as filler, contextlib.suppress(OSError):
            while True:
                filler.write(bytes(4096))

    def empty(self) -> None:
        """Make room again."""
        (self.root / "filler").unlink()

    def remount(self, how: str) -> None:
        """Make it `ro` or `rw`."""
        name_space = ["nsenter", f"--target={self._pid}", "--user", "--mount", "--preserve-credentials"]
        subprocess.run([*name_space, "mount", "-o", f"remount,{how}", str(self._folder)], check=True)

    def files(self) -> set[str]:
        """What is on it."""
        return {str(path.relative_to(self.root)) for path in self.root.rglob("*")}


@contextmanager
def service_on_small_disk(folder: Path, options: str = f"size={SIZE}") -> Iterator[tuple[Disk, str]]:
    """The service, its disk and its address, as soon as it says that it lives."""
    port = free_port()
    url = f"http://{HOST}:{port}"
    serve = f'mount -t tmpfs -o {options} none "$0" && exec "$@"'
    command = [
        "unshare",
        "-rm",
        "sh",
        "-c",
        serve,
        str(folder),
        sys.executable,
        "-m",
        "gelenk.serve",
        "--port",
        str(port),
    ]
    environment = {**os.environ, "GELENK_DATA_DIR": str(folder / "data"), "GELENK_CREW_PROCESSES": "2"}
    environment |= {"GELENK_JOB_PROCESSES": "1"}
    with subprocess.Popen(command, env=environment) as run:
        try:
            wait_for(lambda: lives(url))
            yield Disk(run.pid, folder), url
        finally:
            run.terminate()
            run.wait(timeout=60)


def lives(url: str) -> bool:
    try:
        return ask(url, "/readyz").content.get("waiting_for", []) in ([], ["storage"])
    except OSError:
        return False


def ready(url: str) -> tuple[int, list[str]]:
    answer = ask(url, "/readyz")
    return answer.status, answer.content.get("waiting_for", [])


def problem(answer: Any) -> tuple[int, str]:
    return answer.status, answer.content["type"].removeprefix("urn:gelenk:")


def job(url: str, **more: Any) -> Any:
    return ask(url, "/v1/robots/planar_2r/workspace", "POST", json.dumps(_JOB | more).encode())


def check_reading(url: str, name: str | None) -> None:
    """All that needs no room is answered as ever."""
    assert ask(url, "/healthz").status == 200
    assert ask(url, "/v1/robots/planar_2r/fk", "POST", json.dumps(QUICK).encode()).status == 200
    assert ask(url, "/v1/robots").status == 200
    if name is not None:
        assert Upload("urdf", 1).is_what(url, name)


def refused(url: str) -> list[tuple[int, str]]:
    """What comes of everything that would have to be kept."""
    answers = [
        *(Upload(form, 2).send(url, "new", is_new=True) for form in ("urdf", "zip", "dh")),
        Upload("urdf", 2).send(url, "kept", is_new=False),
        job(url),
    ]
    return [problem(answer) for answer in answers]


@pytest.mark.slow
def test_a_read_only_disk_and_a_full_one(tmp_path: Path) -> None:
    with service_on_small_disk(tmp_path) as (disk, url):
        assert ready(url) == (200, [])
        assert Upload("urdf", 1).send(url, "kept", is_new=True).status == 201
        assert Upload("urdf", 1).send(url, "other", is_new=True).status == 201
        disk.remount("ro")
        assert set(refused(url)) == {(503, "storage-failed")}
        removal = ask(url, "/v1/robots/kept", "DELETE")
        assert problem(removal) == (503, "storage-failed")
        assert "Read-only file system" in removal.content["detail"]
        wait_for(lambda: "Read-only" in ask(url, "/readyz").content.get("reasons", {}).get("storage", ""))
        check_reading(url, "kept")

        disk.remount("rw")
        wait_for(lambda: ready(url) == (200, []))
        disk.fill()
        before = disk.files()
        assert set(refused(url)) == {(507, "storage-full")}
        bookkeeping = ("data/jobs/.lock", "data/jobs/.owners", "data/jobs/.database", "data/audit")
        assert {name for name in disk.files() - before if not name.startswith(bookkeeping)} <= {"data/jobs"}
        wait_for(lambda: ready(url) == (503, ["storage"]))
        assert "No space left" in ask(url, "/readyz").content["reasons"]["storage"]
        check_reading(url, "kept")
        assert ask(url, "/v1/robots/other", "DELETE").status == 204  # how room is made

        disk.empty()
        wait_for(lambda: ready(url) == (200, []))
        assert Upload("zip", 2).send(url, "kept", is_new=False).status == 200
        assert Upload("zip", 2).is_what(url, "kept")
        large = job(url)
        assert large.status == 202
        path = f"/v1/jobs/{large.content['id']}"
        wait_for(lambda: ask(url, path).content["state"] == "failed")
        assert problem(ask(url, f"{path}/result")) == (507, "storage-full")
        # What a process of jobs was writing in this very moment goes a minute later.
        leftovers = re.compile(r"part-|\.new-|\.npy$")
        wait_for(lambda: not [name for name in disk.files() if leftovers.search(name)], 200.0)
        small = job(url, samples=1000)
        assert small.status == 202
        wait_for(lambda: ask(url, f"/v1/jobs/{small.content['id']}").content["state"] == "succeeded")


@pytest.mark.slow
def test_a_service_starts_on_a_read_only_disk_and_gets_ready_when_it_can_write(tmp_path: Path) -> None:
    with service_on_small_disk(tmp_path, f"size={SIZE},ro") as (disk, url):
        assert ready(url) == (503, ["storage"])
        check_reading(url, None)
        answer = Upload("urdf", 1).send(url, "kept", is_new=True)
        assert problem(answer) == (503, "storage-failed")
        disk.remount("rw")
        wait_for(lambda: ready(url) == (200, []))
        assert Upload("urdf", 1).send(url, "kept", is_new=True).status == 201
        check_reading(url, "kept")
