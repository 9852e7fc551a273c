"""Processes of the service are killed at random moments while robots and scenes are written and jobs run.

Nothing that was acknowledged is lost, nothing half is shown, and every job comes to an end that is true.
"""

import json
import os
import random
import signal
import subprocess
import sys
import threading
import time
from http.client import HTTPException
from pathlib import Path
from typing import Any

import pytest

from tests.raw_http import processes
from tests.test_faults import called, is_alive, wait_for
from tests.test_serve import HOST, free_port, wait_until_ready
from tests.uploads import Answer, Upload, ask, read

WORKERS = 2
WRITERS, NAMES = 3, 3
_LATE_SECONDS = 0.5
"""By then a process whose service was killed is gone: what it was at has happened, or never will."""
_JOB = {"samples": 150_000, "voxel_size": 0.05, "kind": "grid"}
_TURNS = {"worker": 10, "crew": 4, "jobs": 3, "service": 3}
"""What is killed, and how often of twenty times."""


class Service:
    """A service that can be killed as a whole, and started again on the same data and the same port."""

    def __init__(self, data: Path) -> None:
        self.data, self._port = data, free_port()
        self.url = f"http://{HOST}:{self._port}"
        self._run: subprocess.Popen[str] | None = None

    @property
    def pid(self) -> int:
        assert self._run is not None
        return self._run.pid

    def start(self) -> None:
        variables = {"GELENK_DATA_DIR": str(self.data), "GELENK_CREW_PROCESSES": "2", "GELENK_JOB_PROCESSES": "1"}
        command = [sys.executable, "-m", "gelenk.serve", "--port", str(self._port), "--workers", str(WORKERS)]
        self._run = subprocess.Popen(command, env={**os.environ, **variables}, stderr=subprocess.DEVNULL, text=True)
        wait_until_ready(self.url, self._run)

    def kill(self) -> None:
        assert self._run is not None
        everything = list(processes(self.pid))
        self._run.kill()
        self._run.wait()
        wait_for(lambda: not any(is_alive(pid) for pid in everything))

    def kill_some(self, what: str, chance: random.Random) -> None:
        """Kill a process of a kind, or all; the service is there again afterwards, or soon."""
        if what == "service":
            self.kill()
            self.start()
        elif found := called(what, self.pid):
            os.kill(chance.choice(found), signal.SIGKILL)


class Client(threading.Thread):
    """Asks on and on, whatever happens to the service."""

    def __init__(self, url: str) -> None:
        super().__init__()
        self._url = url
        self.complaints: list[str] = []
        self.interrupted = 0
        self._stopped = threading.Event()

    def run(self) -> None:
        """Ask until told to stop."""
        while not self._stopped.is_set():
            try:
                self.ask()
            except (OSError, HTTPException):
                self.interrupted += 1
                time.sleep(_LATE_SECONDS)
            except Exception as error:
                self.complaints.append(repr(error))
                raise

    def ask(self) -> None:
        """Ask once."""
        raise NotImplementedError

    def stop(self) -> None:
        """Come to an end."""
        self._stopped.set()


class Writer(Client):
    """Writes robots, scenes and jobs of its own, keeps what was acknowledged, and looks at it again."""

    def __init__(self, number: int, url: str) -> None:
        super().__init__(url)
        self._chance, self._number = random.Random(number), number
        self.may_be: dict[str, set[Upload | None]] = {
            f"{what}_{number}_{i}": {None} for what in ("arm", "cell") for i in range(NAMES)
        }
        self.jobs: dict[str, set[str]] = {}
        self.acknowledged = self.looks = 0
        self._result: bytes | None = None

    def ask(self) -> None:
        """Write something."""
        name = self._chance.choice([*self.may_be, "job"])
        self._begin_or_remove_job() if name == "job" else self._write(name)

    def look(self, name: str) -> None:
        """See which of the possible robots it is; none of them is what must not happen."""
        self.looks += 1
        possible = self.may_be[name]
        found: set[Upload | None] = {one for one in possible if one is not None and one.is_what(self._url, name)}
        if not found and (answer := read(self._url, _path(name))).status == 404:
            found = {None}
        if not found & possible:
            self.complaints.append(f"{name} is none of {possible}: {answer}")
        self.may_be[name] = found & possible or found

    def _write(self, name: str) -> None:
        if len(self.may_be[name]) > 1 or self._chance.random() < 0.3:
            self.look(name)
        (before,) = self.may_be[name] or {None}
        after = None
        if before is None or self._chance.random() < 0.7:
            forms: tuple[Any, ...] = ("scene",) if name.startswith("cell") else ("urdf", "zip", "dh")
            after = Upload(self._chance.choice(forms), self._chance.randrange(1000))
        self.may_be[name] = {before, after}
        if after is None:
            answer, allowed = ask(self._url, _path(name), "DELETE"), {204}
        else:
            answer, allowed = after.send(self._url, name, before is None), {200, 201}
        if self._is_done(answer, allowed, name):
            self.may_be[name] = {after}

    def _begin_or_remove_job(self) -> None:
        known = [name for name, states in self.jobs.items() if states == {"there"}]
        if len(known) < 2:
            name = f"job-{self._number}-{len(self.jobs)}"
            self.jobs[name] = {"there", "gone"}
            body = json.dumps(_JOB | {"job_id": name, "random_seed": self._number}).encode()
            if self._is_done(ask(self._url, "/v1/robots/planar_2r/workspace", "POST", body), {202}, name):
                self.jobs[name] = {"there"}
            return
        job = ask(self._url, f"/v1/jobs/{known[0]}")
        if not self._is_done(job, {200}, known[0]) or job.content["state"] not in {"succeeded", "failed"}:
            return
        self.check_end(known[0])
        self.jobs[known[0]] = {"there", "gone"}
        if self._is_done(ask(self._url, f"/v1/jobs/{known[0]}?finished=remove", "DELETE"), {200}, known[0]):
            self.jobs[known[0]] = {"gone"}

    def check_end(self, name: str) -> None:
        """A job that has come to its end has its whole result; one that says that it failed says why."""
        job = ask(self._url, f"/v1/jobs/{name}").content
        result = ask(self._url, f"/v1/jobs/{name}/result")
        if job["state"] == "succeeded":
            if self._is_done(result, {200}, name):
                self._result = self._result or result.body
                if result.body != self._result:
                    self.complaints.append(f"{name} has another result than the others: {result.body[:500]!r}")
        elif job["state"] != "failed" or not _was_killed(job["error"]):
            self.complaints.append(f"{name} ended so: {job}")

    def _is_done(self, answer: Answer, allowed: set[int], name: str) -> bool:
        """Whether an answer acknowledges; one that says that a process has died says that nobody knows."""
        if answer.status in allowed:
            self.acknowledged += 1
            return True
        kind = answer.content["type"].removeprefix("urn:gelenk:")
        if kind not in {"worker-crashed", "service-stopping", "service-busy", "too-many-jobs", "job-failed"}:
            self.complaints.append(f"{name}: {answer.status} {answer.body[:300]!r}")
        time.sleep(_LATE_SECONDS)
        return False


def _path(name: str) -> str:
    return f"/v1/{'scenes' if name.startswith('cell') else 'robots'}/{name}"


def _was_killed(error: dict[str, Any]) -> bool:
    """Whether a job was given up because its service, or the process of one of its parts, was killed three times."""
    return error["type"] == "urn:gelenk:job-interrupted" or "its process died 3 times" in error["detail"]


class Reader(Client):
    """Asks for every robot and scene that is listed: it can be loaded, or has just been removed."""

    def ask(self) -> None:
        """Read all."""
        self.read()

    def read(self) -> set[str]:
        """The uploaded robots and the scenes, each of which has been asked for."""
        listed = ask(self._url, "/v1/robots")
        if listed.status != 200:
            return set()
        names = {robot["name"] for robot in listed.content["robots"] if robot["source"] == "uploaded"}
        names |= {scene["name"] for scene in ask(self._url, "/v1/scenes").content["scenes"]}
        for name in names:
            answer = ask(self._url, _path(name))
            if answer.status not in {200, 404, 500, 503} or b"invalid" in answer.body[:60]:
                self.complaints.append(f"{name} is listed, and cannot be loaded: {answer}")
        return names


def strays(data: Path) -> list[Path]:
    """What interrupted writers have left."""
    # What is removed meanwhile is passed over.
    found = (Path(folder, name) for folder, folders, files in os.walk(data) for name in (*folders, *files))
    return [path for path in found if path.name.startswith((".new-", ".old-"))]


@pytest.mark.slow
def test_nothing_acknowledged_is_lost(tmp_path: Path) -> None:
    kills, chance = 25, random.Random(25)
    service = Service(tmp_path)
    writers, reader = [Writer(number, service.url) for number in range(WRITERS)], Reader(service.url)
    turns = [what for what, times in _TURNS.items() for _ in range(max(1, times * kills // 20))]
    chance.shuffle(turns)
    try:
        service.start()
        for thread in (*writers, reader):
            thread.start()
        for done, what in enumerate(turns):  # no sooner than so much has been acknowledged, however busy the machine is
            wait_for(lambda done=done: sum(writer.acknowledged for writer in writers) > done)
            time.sleep(chance.uniform(0.05, 0.6))
            service.kill_some(what, chance)
            assert len(strays(tmp_path)) < 20
        for thread in (*writers, reader):
            thread.stop()
        for thread in (*writers, reader):
            thread.join()
        judge(service, writers, reader)
        service.kill_some("service", chance)
        judge(service, writers, reader)
        assert strays(tmp_path) == []
    finally:
        for thread in (*writers, reader):
            thread.stop()
        service.kill()
    told = {name: sum(getattr(one, name) for one in writers) for name in ("acknowledged", "interrupted", "looks")}
    print(f"{kills} kills, {told}, jobs {sum(len(writer.jobs) for writer in writers)}")
    assert told["acknowledged"] >= kills
    assert told["interrupted"] > 0


def judge(service: Service, writers: list[Writer], reader: Reader) -> None:
    """All that was acknowledged is there, and nothing else."""
    wait_for(lambda: len(called("worker", service.pid)) == WORKERS)
    time.sleep(_LATE_SECONDS)
    for writer in writers:
        for name in writer.may_be:
            writer.look(name)
        for name, states in writer.jobs.items():
            if states != {"gone"}:
                check_job(service.url, writer, name)
    wanted = {name for writer in writers for name, robots in writer.may_be.items() if robots != {None}}
    assert reader.read() == wanted
    assert [complaint for one in (*writers, reader) for complaint in one.complaints] == []


def check_job(url: str, writer: Writer, name: str) -> None:
    """A job comes to an end; only one that was not acknowledged may not be there at all."""
    answer = ask(url, f"/v1/jobs/{name}")
    if answer.status == 404:
        if writer.jobs[name] == {"there"}:
            writer.complaints.append(f"{name} is lost")
        writer.jobs[name] = {"gone"}
        return
    wait_for(lambda: ask(url, f"/v1/jobs/{name}").content["state"] in {"succeeded", "failed"})
    writer.check_end(name)
    writer.jobs[name] = {"there"}
