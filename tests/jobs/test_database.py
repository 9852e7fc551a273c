"""The jobs' table: true after a kill at any moment, shared by processes, replaced when damaged, readable when full."""

import json
import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from gelenk.errors import TooLarge, UnknownJob
from gelenk.jobs.job import Failure
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.store import JobStore

START = (
    "import os, signal, sys, time; from pathlib import Path; from gelenk.jobs.store import *\n"
    "store = JobStore(Path(sys.argv[1]), JobLimits(unfinished=100))\n"
)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    return tmp_path / "jobs"


@pytest.fixture
def store(root: Path) -> Iterator[JobStore]:
    made = JobStore(root, JobLimits(unfinished=100))
    yield made
    made.close()


def run(code: str, root: Path, prefix: tuple[str, ...] = ()) -> subprocess.CompletedProcess[str]:
    """Another process of the service; not checked, since some are killed."""
    command = [*prefix, sys.executable, "-c", START + code, str(root)]
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)


def table(root: Path) -> Path:
    return root / ".database" / "jobs.sqlite"


def test_progress_rewrites_no_file(store: JobStore, root: Path) -> None:
    job = store.start(store.add("workspace", "x", {"call.json": b"{}"}, "mine")[0])
    store.parts(job).write("all-0", b"part")

    def files() -> dict[Path, tuple[int, int, int]]:
        found = {path: path.stat() for path in root.rglob("*") if ".database" not in path.parts}
        return {path: (status.st_ino, status.st_mtime_ns, status.st_size) for path, status in found.items()}

    before = files()
    assert len(before) == 7
    for k in range(1, 20):
        assert store.change(job, progress=k / 20).progress == k / 20
    assert files() == before


@pytest.mark.slow
def test_two_processes_update_at_once(store: JobStore, root: Path) -> None:
    """Each its own job many times, and both the end of the same jobs: they agree on who was first."""
    names = [f"job-{k}" for k in range(40)]
    for name in ("cancelled", "succeeded", *names):
        store.add("workspace", "x", {}, name)
    code = (
        "print('ready', flush=True); sys.stdin.readline()\n"
        "for k in range(1, 201): store.change(sys.argv[2], progress=k / 200)\n"
        "print(*[store.change(f'job-{k}', state=sys.argv[2]).state for k in range(40)])"
    )
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    commands = [[sys.executable, "-c", START + code, str(root), state] for state in ("cancelled", "succeeded")]
    runs = [subprocess.Popen(command, **pipes) for command in commands]  # type: ignore[call-overload]
    assert [one.stdout.readline() for one in runs] == ["ready\n"] * 2
    for one in runs:
        one.stdin.write("\n")
        one.stdin.flush()
    said = [one.communicate()[0].split() for one in runs]
    states = [store.get(name).state for name in names]
    assert said == [states, states]
    assert [store.get(name).progress for name in ("cancelled", "succeeded")] == [1.0, 1.0]


def test_the_first_end_of_a_job_stays(store: JobStore, root: Path) -> None:
    """Also where another process writes it after this one has looked, and before it writes itself."""
    job, _ = store.add("workspace", "x", {}, "mine")
    with closing(JobStore(root, JobLimits())) as other, ThreadPoolExecutor() as pool:
        with other._database.transaction():
            late = pool.submit(store.change, "mine", state="succeeded")
            time.sleep(0.5)  # by then it waits
            other._database.put(replace(job, state="cancelled", finished=time.time()))
        assert late.result().state == "cancelled"
    assert store.get("mine").state == "cancelled"


def test_threads_update_at_once(store: JobStore) -> None:
    names = [store.add("workspace", "x", {})[0].id for _ in range(8)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda name: [store.change(name, progress=k / 50) for k in range(51)], names))
    assert {store.get(name).progress for name in names} == {1.0}


@pytest.mark.quick(1)
@pytest.mark.parametrize("is_durable", [True, False])
def test_a_kill_in_the_middle_of_a_transaction_changes_nothing(store: JobStore, root: Path, is_durable: bool) -> None:
    job, _ = store.add("workspace", "x", {}, "mine")
    code = (
        "job = store.get('mine')\n"
        f"with store._database.transaction({is_durable}):\n"
        "    store._database.put(replace(job, state='failed', finished=1.0))\n"
        "    store._database.put(replace(job, id='other', number=0))\n"
        "    os.kill(os.getpid(), signal.SIGKILL)"
    )
    assert run(code, root).returncode == -signal.SIGKILL
    assert store.get("mine") == job
    with pytest.raises(UnknownJob):
        store.get("other")
    assert store.change("mine", progress=0.5).progress == 0.5


@pytest.mark.slow
def test_a_kill_leaves_what_was_acknowledged(root: Path, store: JobStore) -> None:
    code = "store.start(store.add('workspace', 'x', {'a': b'b'}, 'mine')[0]); os.kill(os.getpid(), signal.SIGKILL)"
    assert run(code, root).returncode == -signal.SIGKILL
    assert store.get("mine").attempts == 1
    assert (store.request("mine") / "a").read_bytes() == b"b"


@pytest.mark.parametrize("lost", ["row", "folder"])
def test_a_half_submitted_job_is_none(store: JobStore, root: Path, lost: str) -> None:
    """As a kill between the two leaves it; its name is free."""
    store.add("workspace", "x", {"a": b"b"}, "mine")
    if lost == "row":
        with store._database.transaction():
            store._database.delete("mine")
    else:
        shutil.rmtree(root / "mine")
    with pytest.raises(UnknownJob):
        store.get("mine")
    store.tidy()
    assert store.add("workspace", "y", {}, "mine")[1]
    assert list((root / "mine").iterdir()) == []


def _overwritten(content: bytes, offset: int) -> Callable[[Path], object]:
    def damage(path: Path) -> None:
        with path.open("r+b") as file:
            file.seek(offset)
            file.write(content)

    return damage


def _folder_instead(path: Path) -> None:
    path.unlink()
    path.mkdir()


def _of_others(path: Path) -> None:
    path.unlink()
    with sqlite3.connect(path) as other:
        other.execute("CREATE TABLE jobs (id, something)")
        other.execute("INSERT INTO jobs VALUES ('mine', 1)")
    other.close()


def _failed_strangely(path: Path) -> None:
    with sqlite3.connect(path) as other:
        other.execute("UPDATE jobs SET failure = 'no JSON'")
    other.close()


DAMAGES: dict[str, Callable[[Path], object]] = {
    "no database": lambda path: path.write_bytes(b"what a text editor leaves\n" * 1000),
    "cut off": lambda path: os.truncate(path, 5000),
    "a page of zeros": _overwritten(bytes(4096), 4096),
    "noise": _overwritten(bytes(range(256)) * 16, 4096),
    "another table": _of_others,
    "a value that cannot be read": _failed_strangely,
    "folder": _folder_instead,
}


@pytest.mark.parametrize("damage", DAMAGES.values(), ids=DAMAGES)
def test_a_damaged_table_is_moved_aside(
    root: Path, store: JobStore, damage: Callable[[Path], object], caplog: pytest.LogCaptureFixture
) -> None:
    store.add("workspace", "x", {"a": b"b"}, "mine")
    store.close()
    damage(table(root))
    store.prepare()
    assert store.take_up() == []
    assert "are lost" in caplog.text
    with pytest.raises(UnknownJob):
        store.get("mine")
    (aside,) = root.glob(".database/damaged-*")
    assert (aside / "jobs.sqlite").exists()
    assert store.add("workspace", "y", {}, "mine")[1]
    caplog.clear()


def test_damage_beneath_a_running_service_is_survived(
    root: Path, store: JobStore, caplog: pytest.LogCaptureFixture
) -> None:
    """One process moves the table aside; the other ones notice, and write to no file that nobody reads."""
    other = JobStore(root, JobLimits())
    for number in range(20):
        store.change(store.add("workspace", "x", {}, f"job-{number}")[0], state="cancelled")
        other.get(f"job-{number}")
    store.close()
    other.close()
    assert other.states() == {"cancelled": 20}
    _overwritten(b"x" * 40960, 0)(table(root))
    store.prepare()
    assert store.states() == {}
    assert "are lost" in caplog.text
    assert other.add("workspace", "x", {}, "mine")[1]
    assert store.get("mine").state == "queued"
    shutil.rmtree(root)
    assert store.states() == other.states() == {}
    assert store.add("workspace", "x", {}, "mine")[1]
    assert other.get("mine").state == "queued"
    other.close()
    caplog.clear()


def test_jobs_of_the_earlier_layout_are_imported_once(root: Path, store: JobStore) -> None:
    error = TooLarge("voxels", 5, 4)
    failure = {"error": "TooLarge", "detail": error.detail, "facts": error.facts()}
    common = {"kind": "workspace", "digest": "ab" * 32, "owner": "gone", "created": 1.7e9, "client": "key"}
    common |= {"failure": None, "started": 1.7e9 + 1, "finished": None, "attempts": 1, "robot_digest": "cd"}
    left = [
        {"id": "done", "state": "succeeded", "progress": 1.0, "number": 7, "finished": 1.7e9 + 2},
        {"id": "running", "state": "running", "progress": 0.5, "number": 9},
        {"id": "failed", "state": "failed", "progress": 0.0, "number": 8, "finished": 1.7e9 + 3, "failure": failure},
    ]
    for job in left:
        (root / str(job["id"]) / "request").mkdir(parents=True)
        (root / str(job["id"]) / "job.json").write_text(json.dumps({**common, **job}))
    (root / "done" / "result.json").write_text("{}")
    for name, content in (("broken", "{"), ("list", "[1]"), ("another", json.dumps({**common, **left[0]}))):
        (root / name).mkdir()
        (root / name / "job.json").write_text(content)
    store.prepare()
    done, running = store.get("done"), store.get("running")
    assert (done.state, done.progress, done.finished, done.robot_digest) == ("succeeded", 1.0, 1.7e9 + 2, "cd")
    assert (running.state, running.progress, running.attempts, running.client) == ("queued", 0.5, 1, "key")
    assert store.get("failed").failure == Failure.of(error)
    assert [job.id for job in store.take_up()] == ["running"]
    assert [path.parent.name for path in sorted(root.glob("*/job.json"))] == ["another", "broken", "list"]
    assert (root / "done" / "result.json").read_text() == "{}"
    store.remove("done")
    (root / "failed" / "job.json").write_text(json.dumps({**common, **left[2], "state": "running"}))
    store.prepare()  # after a stop of the machine that has brought back a file
    assert store.states() == {"queued": 1, "failed": 1}
    assert [store.add("workspace", "x", {})[0].number] == [4]


ISOLATED = "unshare", "-rm", "sh", "-c"
allows_mounts = pytest.mark.skipif(
    subprocess.run(["unshare", "-rm", "true"], capture_output=True, check=False).returncode != 0,
    reason="the system allows no name space of mounts",
)


@pytest.mark.quick(1)
@allows_mounts
@pytest.mark.parametrize("end", ["store.close()", "os.kill(os.getpid(), 9)"], ids=["closed", "killed"])
def test_a_read_only_folder_is_read(root: Path, store: JobStore, end: str) -> None:
    run(f"store.add('workspace', 'x', {{}}, 'mine'); {end}", root)
    assert (root / ".database" / "jobs.sqlite-wal").exists() is (end != "store.close()")
    code = (
        "store.prepare(); print(store.get('mine').state, *store.states())\n"
        "for write in (lambda: store.change('mine', progress=0.5), lambda: store.remove('mine'), store.take_up):\n"
        "    try: write()\n"
        "    except StorageFailed as error: print(error.reason)"
    )
    read_only = 'mount --bind "$4" "$4" && mount -o remount,bind,ro "$4" && exec "$@"'
    found = run(code, root, (*ISOLATED, read_only, "sh"))
    assert found.stdout.splitlines() == ["queued queued", *["Read-only file system"] * 3]
    assert store.get("mine").progress == 0.0


@pytest.mark.quick(1)
@allows_mounts
@pytest.mark.parametrize(
    "end", ["add()", "add(); store.close()", "os.fork() or (add(), os.kill(os.getpid(), 9)); os.wait()"]
)
def test_a_full_disk_is_read_and_makes_room(root: Path, end: str) -> None:
    code = (
        "def add():\n"
        "    for name in 'abc': store.add('workspace', 'x', {'a': bytes(9000)}, name)\n"
        f"{end}\n"
        "with open(sys.argv[1] + '/filler', 'wb', buffering=0) as filler:\n"
        "    try:\n"
        "        while True: filler.write(bytes(4096))\n"
        "    except OSError: pass\n"
        "print(store.get('a').state, dict(store.states()))\n"
        "for write in (lambda: store.add('workspace', 'x', {}, 'd'), lambda: store.add('w', 'x', {'a': b'b'}, 'e')):\n"
        "    try: write()\n"
        "    except StorageFailed as error: print(type(error).__name__)\n"
        "store.remove('a'); print(*store.states().values())\n"
        "os.remove(sys.argv[1] + '/filler')\n"
        "print(store.change('b', state='cancelled').state, store.add('workspace', 'x', {}, 'a')[1])"
    )
    root.mkdir()
    small = 'mount -t tmpfs -o size=400k none "$4" && exec "$@"'
    found = run(code, root, (*ISOLATED, small, "sh"))
    assert found.returncode == 0
    assert found.stdout.splitlines() == ["queued {'queued': 3}", "StorageFull", "StorageFull", "2", "cancelled True"]
