"""The service as a process: it starts, several workers see the same robots, and requests in flight finish."""

import asyncio
import errno
import json
import os
import select
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from http.client import HTTPConnection
from itertools import pairwise
from pathlib import Path
from threading import Semaphore
from typing import IO, Any

import pytest
import uvicorn
import uvloop

from gelenk import serve, supervisor
from gelenk.contract.endpoint import Scope
from gelenk.http.access.keyring import new_key
from gelenk.settings import Settings

HOST = "127.0.0.1"


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind((HOST, 0))
        return int(probe.getsockname()[1])


def get(url: str, method: str = "GET", body: Any = None) -> tuple[int, Any]:
    request = urllib.request.Request(url, method=method, headers={"Content-Type": "application/json"})
    request.data = None if body is None else json.dumps(body).encode()
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, json.loads(answer.read() or b"null")
    except urllib.error.HTTPError as error:
        return error.code, json.loads(error.read())


@contextmanager
def service(data_dir: Path, *arguments: str, **settings: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A running service and its address; it is told to stop at the end, and must."""
    with service_that_writes(subprocess.PIPE, data_dir, *arguments, **settings) as (run, url):
        yield run, url


@contextmanager
def service_that_writes(
    output: int | IO[bytes], data_dir: Path, *arguments: str, **settings: str
) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The same with a place for what it writes."""
    port = free_port()
    environment = {**os.environ, "GELENK_DATA_DIR": str(data_dir), **settings}
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(port), *arguments]
    with subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT, text=True) as run:
        try:
            url = f"http://{HOST}:{port}"
            wait_until_ready(url, run)
            yield run, url
        finally:
            run.terminate()
            run.wait(timeout=60)


def wait_until_ready(url: str, run: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 300  # Kernels may have to be compiled.
    while time.monotonic() < deadline:
        assert run.poll() is None, "the service has ended"
        try:
            if get(f"{url}/readyz")[0] == 200:
                return
        except OSError:
            pass
        time.sleep(0.1)
    raise AssertionError("the service does not get ready")


@pytest.mark.slow
def test_every_worker_sees_an_upload_at_once(tmp_path: Path) -> None:
    row = {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}
    with service(tmp_path, "--workers", "2") as (_, url):
        for length in (1.0, 2.0, 3.0):
            dh = {"convention": "standard", "joints": [{**row, "a": length}]}
            if length == 1.0:
                assert get(f"{url}/v1/robots", "POST", {"name": "arm", "dh": dh})[0] == 201
            else:
                assert get(f"{url}/v1/robots/arm", "PUT", {"dh": dh})[0] == 200
            for _ in range(12):  # each on a new connection, so that both workers get some
                status, answer = get(f"{url}/v1/robots/arm/fk", "POST", {"joint_positions": [[0.0]]})
                assert (status, answer["poses"][0]["position"]) == (200, [length, 0.0, 0.0])
        assert get(f"{url}/v1/robots/arm", "DELETE")[0] == 204
        assert {get(f"{url}/v1/robots/arm")[0] for _ in range(8)} == {404}


@pytest.mark.slow
def test_every_worker_sees_a_scene_at_once(tmp_path: Path) -> None:
    ball = {"name": "ball", "shape": {"type": "sphere", "radius": 0.1}}
    call = {"joint_positions": [[0.0, 0.0]], "scene": "cell", "clearance": True}

    def answers(url: str) -> list[tuple[int, dict[str, Any]]]:
        # Each on a new connection, so that both workers get some.
        return [get(f"{url}/v1/robots/planar_2r/collisions", "POST", call) for _ in range(12)]

    with service(tmp_path, "--workers", "2") as (_, url):
        clearances = []
        for height in (1.0, 2.0, 3.0):
            objects = [{**ball, "pose": {"position": [0.0, 0.0, height]}}]
            if height == 1.0:
                assert get(f"{url}/v1/scenes", "POST", {"name": "cell", "objects": objects})[0] == 201
            else:
                assert get(f"{url}/v1/scenes/cell", "PUT", {"objects": objects})[0] == 200
            found = {answer["results"][0]["clearance"] for _, answer in answers(url)}
            assert len(found) == 1
            clearances.append(found.pop())
        assert [round(b - a, 6) for a, b in pairwise(clearances)] == [1.0, 1.0]
        assert get(f"{url}/v1/scenes/cell", "DELETE")[0] == 204
        assert {(status, answer["pointer"]) for status, answer in answers(url)} == {(404, "#/scene")}


@pytest.mark.slow
@pytest.mark.parametrize("stop", [signal.SIGTERM, signal.SIGINT])
def test_a_request_in_flight_finishes(tmp_path: Path, stop: signal.Signals) -> None:
    """Half of a request is sent, the service is told to stop, the other half follows: the answer comes."""
    body = json.dumps({"joint_positions": [[0.0, 0.0]]}).encode()
    head = (
        f"POST /v1/robots/planar_2r/fk HTTP/1.1\r\nHost: {HOST}\r\nContent-Type: application/json\r\n"
        f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n"
    ).encode()
    with service(tmp_path) as (run, url):
        port = int(url.rsplit(":", 1)[1])
        with socket.create_connection((HOST, port), timeout=60) as connection:
            connection.sendall(head + body[:10])
            while not is_read(port):
                time.sleep(0.05)
            run.send_signal(stop)
            time.sleep(0.5)
            assert run.poll() is None
            connection.sendall(body[10:])
            answer = b""
            while chunk := connection.recv(65536):
                answer += chunk
        assert answer.startswith(b"HTTP/1.1 200")
        assert b'"position":[1.7' in answer
        run.wait(timeout=60)


def is_read(port: int) -> bool:
    """Whether a connection has been let in, and all that has come on those of a port has been read."""
    table = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    ours = [row for row in table if row[1].endswith(f":{port:04X}") and row[3] == "01"]
    return bool(ours) and all(row[4].endswith(":00000000") and row[9] != "0" for row in ours)


@pytest.mark.slow
def test_whoever_asks_while_it_ends_is_told_so_and_not_cut_off(tmp_path: Path) -> None:
    body = json.dumps({"joint_positions": [[0.0] * 7]})
    begun = Semaphore(0)

    def ask_on(url: str) -> tuple[int, str | None]:
        """What the last answer says over a connection that is used until its end."""
        connection = HTTPConnection(url.removeprefix("http://"), timeout=60)
        connection.connect()
        begun.release()
        while True:
            connection.request("POST", "/v1/robots/panda/fk", body, {"Content-Type": "application/json"})
            answer = connection.getresponse()
            answer.read()
            if connection.sock is None:
                return answer.status, answer.getheader("connection")

    with service(tmp_path, "--workers", "2") as (run, url), ThreadPoolExecutor(24) as pool:
        asking = [pool.submit(ask_on, url) for _ in range(24)]
        for _ in asking:
            begun.acquire()
        time.sleep(0.5)
        run.terminate()
        assert {one.result() for one in asking} <= {(200, "close"), (503, "close")}
        assert run.wait(timeout=60) == 0


def test_connections_that_come_at_once_are_let_in_within_few_turns() -> None:
    """The loop is busy for 5 ms in each turn: a hundred connections one by one would take half a second."""
    count, turns, at_most = 100, 0, 30
    connected: list[int] = []

    class Counting(asyncio.Protocol):
        def connection_made(self, transport: asyncio.BaseTransport) -> None:
            connected.append(turns)
            transport.close()

    async def let_in() -> None:
        loop = asyncio.get_running_loop()
        listeners = supervisor.several(socket.create_server((HOST, 0), backlog=count))
        servers = [await loop.create_server(Counting, sock=listener, backlog=count) for listener in listeners]
        clients = [socket.create_connection(listeners[0].getsockname()) for _ in range(count)]
        nonlocal turns
        while len(connected) < count:
            time.sleep(0.005)
            turns += 1
            await asyncio.sleep(0)
        for client in clients:
            client.close()
        for server in servers:
            server.close()

    # In a thread of its own: a browser that tests have used before leaves a running loop in this one.
    with ThreadPoolExecutor(1) as pool:
        pool.submit(uvloop.run, let_in()).result()
    assert connected[-1] < at_most


def test_connections_spread_evenly_over_the_workers() -> None:
    """Of 5,000 a worker gets between 2,273 and 2,727, which is more than six standard deviations from the middle."""
    counts = [0, 0]
    with ExitStack() as stack:
        listeners = [stack.enter_context(one) for one in serve.listeners(HOST, free_port(), 2)]
        for _ in range(5000):
            with socket.create_connection(listeners[0].getsockname()):
                ready, _, _ = select.select(listeners, [], [], 20.0)
                connection, _ = ready[0].accept()
                connection.close()
                counts[listeners.index(ready[0])] += 1
    assert max(counts) <= 1.2 * min(counts), counts


@pytest.mark.parametrize("workers", [1, 2])
def test_an_address_that_several_workers_share_is_taken_for_every_other_service(workers: int) -> None:
    port = free_port()
    with ExitStack() as stack:
        for one in serve.listeners(HOST, port, 2):
            stack.enter_context(one)
        with pytest.raises(SystemExit, match="another program has it"):
            serve.listeners(HOST, port, workers)


def test_what_a_killed_service_has_counted_goes_at_the_next_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    left, foreign = tmp_path / "gelenk-metrics-left", tmp_path / "gelenk-metrics-foreign"
    left.mkdir()
    (left / "lock").touch()
    foreign.mkdir()
    with serve.metrics_folder(2):
        (ours,) = {path for path in tmp_path.iterdir() if path not in {left, foreign}}
        assert not left.exists()
        with serve.metrics_folder(2):
            assert ours.exists()
        assert ours.exists()
    assert list(tmp_path.iterdir()) == [foreign]


@pytest.mark.slow
def test_a_crowd_takes_no_more_files_than_there_may_be(tmp_path: Path) -> None:
    port = free_port()
    few = {"GELENK_DATA_DIR": str(tmp_path), "GELENK_CREW_PROCESSES": "2", "GELENK_JOB_PROCESSES": "2"}
    command = f"ulimit -n 64; exec {sys.executable} -m gelenk.serve --port {port}"
    with subprocess.Popen(["bash", "-c", command], env={**os.environ, **few}, text=True) as run, ExitStack() as crowd:
        try:
            url = f"http://{HOST}:{port}"
            wait_until_ready(url, run)
            for _ in range(120):
                crowd.enter_context(socket.create_connection((HOST, port), timeout=60))
            assert get(f"{url}/healthz")[0] == 200
            assert get(f"{url}/v1/robots/planar_2r/fk", "POST", {"joint_positions": [[0.0, 0.0]]})[0] == 200
        finally:
            run.terminate()
            run.wait(timeout=60)


def test_hardly_any_files_end_it_with_one_line() -> None:
    command = f"ulimit -n 40; exec {sys.executable} -m gelenk.serve --port {free_port()}"
    run = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode == 1
    assert run.stderr.startswith("only 40 files may be open (`ulimit -n`): the service needs ")
    assert run.stderr.count("\n") == 1


@pytest.mark.slow
def test_a_path_prefix_of_a_proxy(tmp_path: Path) -> None:
    with service(tmp_path, GELENK_ROOT_PATH="/gelenk") as (_, url):
        call = {"joint_positions": [[0.0, 0.0]]}
        for prefix in ("", "/gelenk"):
            assert get(f"{url}{prefix}/v1/robots/planar_2r/fk", "POST", call)[0] == 200
            for file in ("", "studio/studio.js", "docs", "documentation/bundles/swagger-ui.css", "v1/robots"):
                with urllib.request.urlopen(f"{url}{prefix}/{file}", timeout=60) as answer:
                    assert answer.status == 200
        with urllib.request.urlopen(f"{url}/gelenk", timeout=60) as answer:
            assert answer.url == f"{url}/gelenk/"
        assert get(f"{url}/gelenkx/v1/robots")[0] == 404
        for prefix in ("", "/gelenk"):
            path = f"{prefix}/v1/robots/nobody/fk"
            status, refusal = get(f"{url}{path}", "POST", call)
            assert (status, refusal["instance"]) == (404, "/gelenk/v1/robots/nobody/fk")
            request = urllib.request.Request(f"{url}{prefix}/v1/robots", headers={"Host": "evil.example.com"})
            with pytest.raises(urllib.error.HTTPError) as refused, urllib.request.urlopen(request, timeout=60):
                pass
            with refused.value as answer:
                assert (answer.code, json.loads(answer.read())["instance"]) == (421, "/gelenk/v1/robots")


def test_the_path_prefix_as_an_argument(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GELENK_ROOT_PATH", "/other")
    started_with(monkeypatch, "--root-path", "/gelenk")
    assert Settings.from_environment(os.environ).root_path == "/gelenk"
    with pytest.raises(SystemExit, match="GELENK_ROOT_PATH must start with a slash"):
        started_with(monkeypatch, "--root-path", "gelenk")


def test_a_wrong_setting_ends_it_with_one_line(tmp_path: Path) -> None:
    environment = {**os.environ, "GELENK_DATA_DIR": str(tmp_path), "GELENK_DATA_DRI": "x"}
    run = subprocess.run(
        [sys.executable, "-m", "gelenk.serve"], env=environment, capture_output=True, text=True, timeout=60, check=False
    )
    assert run.returncode == 1
    assert run.stderr.count("\n") == 1
    assert "GELENK_DATA_DRI" in run.stderr


@pytest.mark.quick(1)
@pytest.mark.parametrize("arguments", [[], ["--workers", "3"]], ids=str)
@pytest.mark.parametrize("host", [HOST, "localhost"])
def test_a_taken_port_is_all_that_it_tells_of(host: str, arguments: list[str], tmp_path: Path) -> None:
    """Also where the other one has only just begun, and does not serve yet."""
    environment = {
        **os.environ,
        "GELENK_DATA_DIR": str(tmp_path / "data"),
        "NUMBA_CACHE_DIR": str(tmp_path / "kernels"),
    }
    with socket.socket() as other:
        other.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        other.bind((HOST, 0))
        other.listen()
        port = other.getsockname()[1]
        command = [sys.executable, "-m", "gelenk.serve", "--host", host, "--port", str(port), *arguments]
        run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    assert run.returncode != 0
    assert (run.stdout, run.stderr.count("\n")) == ("", 1)
    assert f"{host}:{port}: another program has it" in run.stderr
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize("workers", ["1", "2"])
def test_of_two_that_begin_at_once_one_is_told_at_once(workers: str, tmp_path: Path) -> None:
    port = free_port()
    environment = {**os.environ, "GELENK_DATA_DIR": str(tmp_path)}
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(port), "--workers", workers]
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as first:
        try:
            assert first.stdout is not None
            first.stdout.readline()  # it has only said where it is going to be
            second = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
            assert second.returncode != 0
            assert second.stderr.count("\n") == 1
        finally:
            first.terminate()
            first.wait(timeout=60)


def started_with(monkeypatch: pytest.MonkeyPatch, *arguments: str, **settings: str) -> uvicorn.Config:
    """What the server would be started with."""
    found: list[uvicorn.Config] = []

    class Caught(Exception):
        pass

    def catch(config: uvicorn.Config, _: object) -> None:
        found.append(config)
        raise Caught

    monkeypatch.setattr("sys.argv", ["serve", *arguments])
    monkeypatch.setattr(serve, "Supervisor", catch)
    monkeypatch.setattr(serve, "listeners", lambda *_: [])
    monkeypatch.setattr("logging.config.dictConfig", lambda _: None)
    for variable, value in settings.items():
        monkeypatch.setenv(variable, value)
    with pytest.raises(Caught):
        serve.main()
    return found[0]


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.0.2.1", "lab.example.org", ""])
def test_beyond_this_machine_it_wants_keys_or_a_word(host: str, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(SystemExit, match="without a key: create keys with"):
        started_with(monkeypatch, "--host", host)
    with pytest.raises(SystemExit, match="without a key"):
        started_with(monkeypatch, "--host", host, GELENK_OPEN_ACCESS="no")
    assert started_with(monkeypatch, "--host", host, "--open").host == host
    assert started_with(monkeypatch, "--host", host, GELENK_OPEN_ACCESS="yes").host == host
    _, key = new_key("anna", [Scope.READ])
    keys = {"GELENK_OPEN_ACCESS": "no", "GELENK_API_KEYS": key.entry()}
    assert started_with(monkeypatch, "--host", host, **keys).host == host


@pytest.mark.parametrize("host", ["127.0.0.1", "127.8.8.8", "::1", "localhost"])
def test_on_this_machine_it_wants_neither(host: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert started_with(monkeypatch, "--host", host).host == host


def test_keys_that_cannot_be_read_end_it(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match=r"GELENK_API_KEYS: .*No such file"):
        started_with(monkeypatch, GELENK_API_KEYS=str(tmp_path / "none"))


def test_only_a_trusted_proxy_says_where_a_request_comes_from(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "*")
    options = started_with(monkeypatch)
    assert (options.proxy_headers, options.forwarded_allow_ips) == (False, [])
    options = started_with(monkeypatch, GELENK_TRUSTED_PROXIES="10.0.0.5")
    assert (options.proxy_headers, options.forwarded_allow_ips) == (True, ["10.0.0.5"])


@pytest.mark.slow
def test_keys_over_real_connections(tmp_path: Path) -> None:
    token, key = new_key("anna", [Scope.READ])
    with service(tmp_path / "data", GELENK_API_KEYS=key.entry()) as (_, url):
        assert get(f"{url}/v1/robots")[0] == 401
        for path, method, status in (("/v1/robots", "GET", 200), ("/v1/robots/nobody", "DELETE", 403)):
            request = urllib.request.Request(url + path, method=method, headers={"Authorization": f"Bearer {token}"})
            try:
                with urllib.request.urlopen(request, timeout=60) as answer:
                    assert answer.status == status
            except urllib.error.HTTPError as error:
                assert error.code == status
                assert json.loads(error.read())["missing_scope"] == "write"


@pytest.mark.slow
def test_a_home_that_cannot_be_written_is_told_with_what_to_do() -> None:
    environment = {
        name: value for name, value in os.environ.items() if name not in {"GELENK_DATA_DIR", "XDG_DATA_HOME"}
    }
    command = [sys.executable, "-m", "gelenk.serve", "--port", str(free_port())]
    with subprocess.Popen(command, env={**environment, "HOME": "/proc/none"}, stderr=subprocess.PIPE, text=True) as run:
        try:
            assert run.stderr is not None
            assert "GELENK_DATA_DIR names another folder" in run.stderr.readline()
        finally:
            run.terminate()
            run.communicate(timeout=60)


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(errno.EACCES, "Permission denied"), "Permission denied; --port names another one than 80"),
        (OSError(errno.EADDRNOTAVAIL, "Cannot assign"), "Cannot assign; --host takes an address of this machine"),
        (socket.gaierror(socket.EAI_NONAME, "unknown"), "unknown; --host takes an address of this machine"),
    ],
)
def test_why_it_cannot_listen_is_told_with_what_to_do(
    monkeypatch: pytest.MonkeyPatch, error: OSError, words: str
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr("sys.argv", ["gelenk serve", "--port", "80"])
    monkeypatch.setattr("socket.create_server", refuse)
    with pytest.raises(SystemExit, match=words):
        serve.main()


def family(pid: int) -> Iterator[int]:
    """A process, and all that it and those have started."""
    yield pid
    for task in Path(f"/proc/{pid}/task").iterdir():
        for child in (task / "children").read_text().split():
            yield from family(int(child))


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_it_takes_little_memory_while_it_is_idle(workers: int, tmp_path: Path) -> None:
    """At most 300 MB for each worker with its pool; of a page that several processes share, each has its part."""
    with service(tmp_path, "--workers", str(workers)) as (run, url):
        wait_until_ready(url, run)
        time.sleep(5.0)  # whatever it might load then
        kilobytes = [
            int(next(line for line in rollup.splitlines() if line.startswith("Pss:")).split()[1])
            for rollup in (Path(f"/proc/{pid}/smaps_rollup").read_text() for pid in family(run.pid))
        ]
    assert len(kilobytes) >= 2 + 3 * workers
    supervisor, *others = kilobytes
    assert sum(others) * 1024 <= 300e6 * workers
    assert supervisor * 1024 <= 50e6
