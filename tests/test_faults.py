"""Faults planted into the running service: each fails its own request alone, and the rest goes on."""

import json
import os
import signal
import socket
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest

from tests.raw_http import processes
from tests.test_serve import HOST, get, service

LOST = [{"position": [9.0, 0.0, 0.0], "rotation_vector": [0.0, 0.0, 0.0]}] * 10_000
"""Out of reach of the Panda: looked for until time is up."""
QUICK = {"joint_positions": [[0.0, 0.0]]}


def slow(seconds: float) -> dict[str, Any]:
    return {"targets": LOST, "solutions": "all", "time_limit": seconds}


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[int, str]]:
    """The service with two processes in its pool: its own process, and its address."""
    settings = {"GELENK_CREW_PROCESSES": "2", "GELENK_REQUEST_SECONDS": "8", "GELENK_CREW_MEMORY_BYTES": "300000000"}
    with service(tmp_path_factory.mktemp("data"), **settings) as (run, url):
        wait_for(lambda: len(pool_pids(run.pid)) == 2)
        yield run.pid, url


def pool_pids(pid: int) -> list[int]:
    """The processes that answer what may take long."""
    return called("crew", pid)


def called(name: str, pid: int) -> list[int]:
    """The processes of a service that are called so: copies of one that does nothing but copy itself."""
    return [copy for child in children(pid) for copy in children(child) if name_of(copy) == f"gelenk-{name}"]


def name_of(pid: int) -> str:
    try:
        return Path(f"/proc/{pid}/comm").read_text().strip()
    except OSError:
        return ""


def children(pid: int) -> list[int]:
    tasks = Path(f"/proc/{pid}/task")
    try:
        return [int(child) for task in tasks.iterdir() for child in (task / "children").read_text().split()]
    except (FileNotFoundError, ProcessLookupError):
        return []


def is_alive(pid: int) -> bool:
    """Whether a process is more than an entry that somebody else has yet to take off the list."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def processor_seconds(pid: int) -> float:
    """What a process has worked; nothing, if it is gone."""
    try:
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def busy_one(pid: int, begin: Callable[[], object]) -> int:
    """The process of the pool that something gives work to."""
    wait_for(lambda: len(pool_pids(pid)) == 2 and not changes(pool_pids(pid)))
    before = {one: processor_seconds(one) for one in pool_pids(pid)}
    begin()
    until = time.monotonic() + 60
    while time.monotonic() < until:
        time.sleep(0.05)
        for one in pool_pids(pid):  # one of them may have just been replaced
            if processor_seconds(one) > before.setdefault(one, 0.0) + 0.2:
                return one
    raise AssertionError("none is at work")


def changes(pids: list[int]) -> bool:
    """Whether any of these is at work."""
    before = [processor_seconds(pid) for pid in pids]
    time.sleep(0.3)
    return [processor_seconds(pid) for pid in pids] != before


def wait_for(condition: Any, seconds: float = 120.0) -> None:
    until = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < until
        time.sleep(0.02)


def check_whole(pid: int, url: str) -> None:
    """Both processes answer, and what is answered without them does too."""
    assert get(f"{url}/v1/robots/planar_2r/fk", "POST", QUICK)[0] == 200
    answers: list[int] = []
    heavy = {"joint_positions": [[0.0, 0.0]] * 2000}
    threads = [
        threading.Thread(target=lambda: answers.append(get(f"{url}/v1/robots/planar_2r/fk", "POST", heavy)[0]))
        for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [200] * 4
    wait_for(lambda: len(pool_pids(pid)) == 2)


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT])
def test_a_crash_fails_its_own_request_alone(running: tuple[int, str], how: signal.Signals) -> None:
    pid, url = running
    tasks: list[Future[tuple[int, Any]]] = []
    with ThreadPoolExecutor(2) as pool:
        victim = busy_one(pid, lambda: tasks.append(pool.submit(get, f"{url}/v1/robots/panda/ik", "POST", slow(60.0))))
        other = pool.submit(get, f"{url}/v1/robots/panda/ik", "POST", slow(1.0))
        time.sleep(0.1)
        os.kill(victim, how)
        status, problem = tasks[0].result()
        assert (status, problem["type"]) == (500, "urn:gelenk:worker-crashed"), "sooner than at the deadline"
        assert how.name in problem["detail"]
        assert other.result()[0] == 200
    check_whole(pid, url)
    wait_for(lambda: victim not in pool_pids(pid))


@pytest.mark.slow
def test_a_hang_is_ended_at_its_deadline(running: tuple[int, str]) -> None:
    pid, url = running
    tasks: list[Future[tuple[int, Any]]] = []
    with ThreadPoolExecutor(1) as pool:
        victim = busy_one(pid, lambda: tasks.append(pool.submit(get, f"{url}/v1/robots/panda/ik", "POST", slow(60.0))))
        os.kill(victim, signal.SIGSTOP)
        status, problem = tasks[0].result()
    assert (status, problem["type"]) == (504, "urn:gelenk:deadline-exceeded")
    assert "job" in problem["detail"]
    check_whole(pid, url)
    wait_for(lambda: victim not in pool_pids(pid))


@pytest.mark.slow
def test_a_search_ends_before_its_request_would_be_ended(running: tuple[int, str]) -> None:
    _, url = running
    path = f"{url}/v1/robots/panda/ik"

    def search(count: int) -> tuple[list[dict[str, Any]], float]:
        began = time.monotonic()
        status, answer = get(path, "POST", {**slow(60.0), "targets": LOST[:1] * count})
        assert status == 200
        return answer["results"], time.monotonic() - began

    # Much more than it has time for, however fast the machine is, and slow in the moment in which that is measured.
    seconds = min(search(100)[1] for _ in range(3))
    results, seconds = search(min(len(LOST), int(100 * 25.0 / seconds)))
    assert seconds < 30.0  # of the 60 that it was given
    assert "solved" not in {result["status"] for result in results}
    assert "time_limit" in {result.get("stop_reason") for result in results}


@pytest.mark.slow
def test_a_lack_of_memory_fails_its_own_request_alone(running: tuple[int, str], tmp_path: Path) -> None:
    pid, url = running
    np.save(tmp_path / "many.npy", np.zeros((350_000, 7)))
    path = f"{url}/v1/robots/panda/jacobian"
    status, problem = post_npy(path, (tmp_path / "many.npy").read_bytes())
    assert (status, json.loads(problem)["type"]) == (500, "urn:gelenk:worker-out-of-memory")
    check_whole(pid, url)
    np.save(tmp_path / "few.npy", np.zeros((1000, 7)))
    assert post_npy(path, (tmp_path / "few.npy").read_bytes())[0] == 200


def post_npy(url: str, body: bytes) -> tuple[int, bytes]:
    from urllib.error import HTTPError
    from urllib.request import Request

    npy = "application/x-npy"
    try:
        with urlopen(Request(url, body, {"Content-Type": npy, "Accept": npy}), timeout=60) as answer:
            return answer.status, answer.read()
    except HTTPError as error:
        return error.code, error.read()


@pytest.mark.slow
def test_who_leaves_takes_the_work_along(running: tuple[int, str]) -> None:
    pid, url = running
    body = json.dumps(slow(60.0)).encode()
    head = (
        f"POST /v1/robots/panda/ik HTTP/1.1\r\nHost: {HOST}\r\nContent-Type: application/json\r\n"
        f"Content-Length: {len(body)}\r\n\r\n"
    ).encode()
    with socket.create_connection((HOST, int(url.rsplit(":", 1)[1])), timeout=60) as connection:
        victim = busy_one(pid, lambda: connection.sendall(head + body))
    wait_for(lambda: victim not in pool_pids(pid))
    check_whole(pid, url)


@pytest.mark.slow
def test_a_robot_is_loaded_here_only_after_another_process_has_lived_through_it(running: tuple[int, str]) -> None:
    """Of an uploaded robot that was not asked for yet the first call is one of the pool's, however quick it is."""
    pid, url = running
    row = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
    dh = {"convention": "standard", "joints": [row]}
    assert get(f"{url}/v1/robots", "POST", {"name": "own", "dh": dh})[0] == 201
    for process in pool_pids(pid):
        os.kill(process, signal.SIGSTOP)
    status, problem = get(f"{url}/v1/robots/own/fk", "POST", {"joint_positions": [[0.0]]})
    assert (status, problem["type"]) == (504, "urn:gelenk:deadline-exceeded")
    assert get(f"{url}/v1/robots/planar_2r/fk", "POST", QUICK)[0] == 200
    wait_for(lambda: get(f"{url}/v1/robots/own/fk", "POST", {"joint_positions": [[0.0]]})[0] == 200)


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_nothing_is_left_when_the_service_ends(tmp_path: Path, how: signal.Signals) -> None:
    """In the middle of a request that takes longer than the end may, which is told so where there is time for that."""
    with service(tmp_path, GELENK_CREW_PROCESSES="2") as (run, url), ThreadPoolExecutor(1) as pool:
        tasks: list[Future[tuple[int, Any]]] = []
        busy_one(run.pid, lambda: tasks.append(pool.submit(get, f"{url}/v1/robots/panda/ik", "POST", slow(60.0))))
        pids = list(processes(run.pid))[1:]
        began = time.monotonic()
        run.send_signal(how)
        if how == signal.SIGTERM:
            assert tasks[0].result()[0] == 503
        else:
            assert isinstance(tasks[0].exception(), OSError)
        run.wait(timeout=60)
        assert time.monotonic() - began < 30.0  # of the 60 that it was given
        wait_for(lambda: not any(is_alive(pid) for pid in pids))
