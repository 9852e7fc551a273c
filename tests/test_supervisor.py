"""Workers that end, hang or cannot begin: another one is there within a second, or the service says why not."""

import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
import uvicorn

from gelenk.supervisor import STARTUP_FAILURE, STILL_STARTING, Worker
from tests.raw_http import processes
from tests.speed import times_as_slow
from tests.test_faults import QUICK, called, children, is_alive, wait_for
from tests.test_serve import HOST, free_port, get, service

WORKERS, CREW = 2, 2
KILLS = 5


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[int, str]]:
    with service(tmp_path_factory.mktemp("data"), "--workers", "2", GELENK_CREW_PROCESSES="2") as (run, url):
        wait_for(lambda: is_whole(run.pid))
        yield run.pid, url


def is_whole(pid: int) -> bool:
    return len(called("worker", pid)) == WORKERS and len(called("crew", pid)) == WORKERS * CREW


@pytest.mark.slow
def test_a_killed_worker_is_replaced_at_once(running: tuple[int, str]) -> None:
    """With its pool, whose processes end with it; and nobody who asks meanwhile is refused."""
    pid, url = running
    seconds = []
    for _ in range(KILLS):
        victim, crews = called("worker", pid)[0], set(called("crew", pid))
        os.kill(victim, signal.SIGKILL)
        killed = time.monotonic()
        wait_for(
            lambda victim=victim, crews=crews: (
                is_whole(pid) and victim not in called("worker", pid) and len(crews - set(called("crew", pid))) == CREW
            )
        )
        seconds.append((time.monotonic() - killed) / times_as_slow())
        assert get(f"{url}/v1/robots/planar_2r/fk", "POST", QUICK)[0] == 200
    assert min(seconds) < 1.0, seconds  # 0.3 s on an idle machine


@pytest.mark.slow
def test_connections_that_wait_for_a_worker_that_is_killed_are_answered_by_its_replacement(
    running: tuple[int, str],
) -> None:
    """About half of them wait for it: the others have gone to the other worker."""
    pid, url = running
    victim = called("worker", pid)[0]
    os.kill(victim, signal.SIGSTOP)
    with ThreadPoolExecutor(40) as threads:
        answers = [threads.submit(get, f"{url}/healthz") for _ in range(40)]
        time.sleep(2.0)
        assert any(not answer.done() for answer in answers)
        os.kill(victim, signal.SIGKILL)
        assert {answer.result()[0] for answer in answers} == {200}
    wait_for(lambda: is_whole(pid))


@pytest.mark.slow
def test_the_fork_server_is_replaced_with_all_its_children(running: tuple[int, str]) -> None:
    pid, url = running
    (fork_server,) = children(pid)
    workers = children(fork_server)
    os.kill(fork_server, signal.SIGKILL)
    wait_for(lambda: not any(is_alive(one) for one in workers))
    wait_for(lambda: is_whole(pid))
    assert get(f"{url}/v1/robots/planar_2r/fk", "POST", QUICK)[0] == 200


@pytest.mark.slow
def test_no_worker_outlives_the_supervisor(running: tuple[int, str]) -> None:
    """The last test with this service."""
    pid, url = running
    everything = list(processes(pid))
    assert len(everything) == 2 + WORKERS * (1 + CREW)
    os.kill(pid, signal.SIGKILL)
    wait_for(lambda: not any(is_alive(one) for one in everything))
    with pytest.raises(OSError, match="refused"):
        get(f"{url}/healthz")


@pytest.mark.slow
def test_a_service_that_cannot_begin_ends_and_says_why(tmp_path: Path) -> None:
    environment = {**os.environ, "GELENK_DATA_DIR": str(tmp_path), "GELENK_CATALOGUE_DIR": str(tmp_path / "none")}
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(free_port())]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == STARTUP_FAILURE
    assert str(tmp_path / "none") in run.stderr
    assert "could not start serving" in run.stderr


def test_a_worker_that_hangs_is_killed_unless_the_supervisor_was_stopped_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GELENK_DATA_DIR", str(tmp_path))
    config = uvicorn.Config("gelenk.main:from_environment", factory=True, log_config=None)
    with socket.create_server((HOST, 0)) as listener:
        worker = Worker(config, "worker", [listener])
        worker.start()
        worker.serve()
        try:
            assert worker.process is not None
            pid = worker.process.pid
            os.kill(pid, signal.SIGSTOP)
            for later, is_forgiving in ((59.0, False), (61.0, True), (61.0 + 59.0, False)):
                worker.check(time.monotonic() + later, is_forgiving)
                assert is_alive(pid)
            worker.check(time.monotonic() + 61.0 + 61.0, is_forgiving=False)
            assert not is_alive(pid)
            assert not worker.cannot_start
        finally:
            worker.join(0.0)


@pytest.mark.slow
def test_who_waits_for_the_kernels_is_told(tmp_path: Path) -> None:
    """The first start on a processor: it says where it is, then what it does, and answers meanwhile."""
    port = free_port()
    environment = {
        **os.environ,
        "GELENK_DATA_DIR": str(tmp_path / "data"),
        "NUMBA_CACHE_DIR": str(tmp_path / "kernels"),
    }
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(port), "--root-path", "/gelenk"]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as run:
        try:
            assert run.stdout is not None
            assert run.stdout.readline().startswith(f"Gelenk at http://{HOST}:{port}/gelenk/, ")
            assert run.stdout.readline() == f"{STILL_STARTING}\n"
            wait_for(lambda: answers(f"http://{HOST}:{port}/readyz") == 503)
        finally:
            run.terminate()
            assert run.wait(timeout=60) == 0


def answers(url: str) -> int | None:
    """The status, if there is an answer."""
    try:
        return get(url)[0]
    except OSError:
        return None
