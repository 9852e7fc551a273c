"""How commands end and what else a shell sees of them: codes, bars, completion, the benchmark, `serve`."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import httpx2
import numpy as np
import pytest

import gelenk
from gelenk.cli.local import InProcess
from gelenk.cli.main import EXIT_CODES
from gelenk.client import Client
from tests.cli.conftest import Shell
from tests.test_serve import free_port, get, wait_until_ready

COMMAND = [sys.executable, "-m", "gelenk.cli.main"]


def refusing(status: int, kind: str, **headers: str) -> Callable[..., Client]:
    """A client of a service that refuses everything."""
    problem = {"type": f"urn:gelenk:{kind}", "status": status, "detail": f"the service says {kind}"}

    def answer(_: httpx2.Request) -> httpx2.Response:
        return httpx2.Response(status, json=problem, headers=headers)

    return lambda url, transport=None: Client(url, transport=httpx2.MockTransport(answer))  # noqa: ARG005


@pytest.mark.parametrize(
    ("status", "kind", "code"),
    [
        (422, "invalid-payload", 2),
        (404, "unknown-robot", 2),
        (403, "forbidden", 2),
        (409, "name-taken", 2),
        (413, "too-large", 2),
        (401, "unauthorized", 4),
        (429, "too-many-requests", 4),
        (500, "internal-error", 4),
        (503, "service-busy", 4),
    ],
)
def test_a_refusal_ends_with_its_code(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, status: int, kind: str, code: int
) -> None:
    monkeypatch.setattr("gelenk.client.Client", refusing(status, kind))
    out, err = shell("--server", "http://gelenk.invalid", "robots", code=code)
    how = " (gelenk sends the one in GELENK_KEY)" if status == 401 else ""
    assert (out, err) == ("", f"gelenk: the service says {kind}{how}\n")


def test_the_codes_are_those_that_the_help_tells(shell: Shell) -> None:
    told = " ".join(shell("--help")[0].split())
    assert EXIT_CODES in told
    shell("robots", "panda")
    shell("ik", "planar_2r", "--to", "9 0 0", "--task", "x,y", code=1)
    shell("fk", "planar_2r", code=2)
    shell("no-such-command", code=2)
    shell("fk", "planar_2r", "--no-such-option", code=2)


def test_an_interrupt_has_a_code_of_its_own(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the job that was waited for is gone."""

    def interrupted(*_: object) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr("gelenk.client.jobs.Job.result", interrupted)
    ended: list[str] = []
    monkeypatch.setattr("gelenk.client.jobs.Job.cancel", lambda job, _: ended.append(job.id))
    shell("workspace", "planar_2r", "--samples", 1000, code=130)
    assert len(ended) == 1


@pytest.mark.slow
def test_a_job_is_begun_for_later(shell: Shell, url: str, tmp_path: Path) -> None:
    """With the answer that the command waits for otherwise; nothing is left behind."""
    angles = np.random.default_rng(1).uniform(0.2, 1.2, (60, 2))
    np.save(tmp_path / "q.npy", angles)
    poses = tmp_path / "poses.npy"
    shell("--output", poses, "fk", "planar_2r", "--from", tmp_path / "q.npy")
    asked = ["--server", url, "ik", "planar_2r", "--from", poses, "--task", "x,y"]
    at_once = shell.json(*asked)
    begun = shell.json(*asked, "--job")
    assert begun["kind"] == "ik"
    assert shell.json("--server", url, "jobs", "watch", begun["id"])["state"] == "succeeded"
    assert shell.json("--server", url, "jobs", "result", begun["id"]) == at_once
    rows = shell.bytes("--server", url, "--format", "npy", "-o", tmp_path / "found.npy", "jobs", "result", begun["id"])
    assert rows == b""
    expected = [result["solutions"][0]["joint_positions"] for result in at_once["results"]]
    assert np.array_equal(np.load(tmp_path / "found.npy"), expected)
    assert shell.json("--server", url, "jobs", "cancel", begun["id"], "--finished", "remove")["state"] == "succeeded"
    shell("--server", url, "jobs", "show", begun["id"], code=2)


def test_a_job_that_nobody_would_do_is_not_begun(shell: Shell) -> None:
    for arguments in (["ik", "planar_2r", "--to", "1 1 0 0 0 0"], ["trajectory", "planar_2r", "--start", "0 0"]):
        assert "needs --server" in shell(*arguments, "--job", code=2)[1]
    assert "needs --server" in shell("workspace", "planar_2r", "--job", code=2)[1]


@pytest.mark.slow
def test_progress_is_told_as_it_goes_on(own: InProcess) -> None:
    """Without a server too, where an answer comes as a whole."""
    told: list[tuple[float, float]] = []
    gelenk = Client("http://127.0.0.1", transport=own)  # not closed: others go on with what is behind it
    with gelenk.jobs.workspace("panda", samples=600_000) as job:
        job.wait(lambda info: told.append((time.monotonic(), info.progress)))
    moments, progress = zip(*told, strict=True)
    assert progress[-1] == 1.0
    assert list(progress) == sorted(progress)
    assert moments[-1] - moments[0] > 0.1


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "head"), [("m.yaml", "# Robot ur5"), ("m.json", '{"header"'), ("m.script", "# Robot ur5")]
)
def test_programs_into_files(shell: Shell, tmp_path: Path, name: str, head: str) -> None:
    motion = ["trajectory", "ur5", "--start", "0 -1.2 1.6 -0.4 1.2 0", "--joint", "0.1 -1.2 1.6 -0.4 1.2 0"]
    shell(*motion, "--program", tmp_path / name)
    assert (tmp_path / name).read_text("utf-8").startswith(head)


def test_a_motion_out_of_another_needs_no_start(shell: Shell) -> None:
    running = {"start": [0.3, 0.8], "segments": [{"type": "joint", "target": [0.9, 0.2]}], "law": "jerk_limited"}
    call = {"at": {"trajectory": running, "time": 0.1}, "segments": [{"type": "joint", "target": [0.5, 0.5]}]}
    shell("trajectory", "planar_2r", "--motion", json.dumps({**call, "law": "jerk_limited"}))
    assert "start" in shell("trajectory", "planar_2r", "--joint", "0.5 0.2", code=2)[1]


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", ["svg", "png"])
def test_pictures_into_files(shell: Shell, tmp_path: Path, kind: str) -> None:
    head = {"svg": b"<?xml", "png": b"\x89PNG"}[kind]
    motion = ["trajectory", "planar_2r", "--start", "0.3 0.8", "--joint", "0.5 0.2"]
    shell(*motion, "--plot", tmp_path / f"motion.{kind}")
    shell("manipulability", "planar_2r", "-q", "0.3 0.8", "--plot", tmp_path / f"ellipse.{kind}")
    for name in ("motion", "ellipse"):
        assert (tmp_path / f"{name}.{kind}").read_bytes().startswith(head)


def test_what_cannot_be_drawn_is_refused_before_the_work(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.cli.local.InProcess", lambda: pytest.fail("it was asked"))
    assert "must end in .svg, .png or .pdf" in shell("workspace", "planar_2r", "--plot", "reach.gif", code=2)[1]


@pytest.mark.slow
def test_the_benchmark_measures_what_it_says(shell: Shell, url: str) -> None:
    for options in ((), ("--server", url)):
        told = shell.json(*options, "bench", "planar_2r", "--batch", "200", "--seconds", "0.1")
        assert [row["operation"] for row in told["rows"]] == ["fk", "jacobian", "ik"]
        for row in told["rows"]:
            ratio = 1e3 * row["single_milliseconds"] / row["batch_microseconds_each"]
            assert row["ratio"] == pytest.approx(ratio)
            assert row["single_milliseconds"] > 0.0
        assert told["where"] == (url if options else "this very process")
    assert "one call [ms]" in shell("bench", "planar_2r", "--batch", "20", "--seconds", "0.1")[0]


def ran(*arguments: str, **environment: str) -> str:
    """What a command of its own process writes."""
    known = {name: value for name, value in os.environ.items() if not name.startswith("GELENK_")}
    run = subprocess.run(
        [*COMMAND, *arguments], capture_output=True, text=True, timeout=120, check=True, env={**known, **environment}
    )
    return run.stdout


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["bash", "zsh", "fish"])
def test_a_shell_completes(name: str) -> None:
    script = ran("--show-completion", name, _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1")
    assert "gelenk" in script
    assert f"complete_{name}" in script


@pytest.mark.slow
def test_names_of_robots_are_completed(url: str) -> None:
    dh = {"convention": "standard", "joints": [{"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0}]}
    assert get(f"{url}/v1/robots", "POST", {"name": "panda_of_mine", "dh": dh})[0] == 201
    typed = {"_GELENK_COMPLETE": "complete_bash", "COMP_WORDS": "gelenk fk panda", "COMP_CWORD": "2"}
    assert ran(**typed).split() == ["panda", "panda_collision", "panda_dh"]
    there = {**typed, "GELENK_SERVER": url}
    assert ran(**there).split() == ["panda", "panda_collision", "panda_dh", "panda_of_mine"]
    assert get(f"{url}/v1/robots/panda_of_mine", "DELETE")[0] == 204
    assert ran(**{**typed, "GELENK_SERVER": f"http://127.0.0.1:{free_port()}"}) == "\n"


def test_help_and_completion_need_not_wait_for_what_computes() -> None:
    heavy = {"pinocchio", "numba", "numpy", "fastapi", "pydantic", "matplotlib", "gelenk.client.client"}
    script = f"import sys, gelenk.cli.main; print({heavy} & set(sys.modules))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=True)
    assert run.stdout == "set()\n"


@pytest.mark.slow
def test_the_service_is_served(tmp_path: Path) -> None:
    port = free_port()
    command = [*COMMAND, "serve", "--port", str(port), "--workers", "2"]
    environment = {**os.environ, "GELENK_DATA_DIR": str(tmp_path)}
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as run:
        try:
            url = f"http://127.0.0.1:{port}"
            wait_until_ready(url, run)
            assert json.loads(ran("--server", url, "--format", "json", "fk", "planar_2r", "-q", "0 0"))["poses"]
        finally:
            run.send_signal(signal.SIGTERM)
            told = run.communicate(timeout=60)[0]
    assert run.returncode in {0, -signal.SIGTERM}
    assert f"Gelenk at http://127.0.0.1:{port}/" in told
    usage = subprocess.run([*COMMAND, "serve", "--help"], capture_output=True, text=True, timeout=120, check=True)
    assert usage.stdout.startswith("usage: gelenk serve ")


def test_an_error_of_the_command_itself_is_no_verdict(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    """Code 1 is an answer; and Ctrl-C is one wherever it strikes."""

    def fails(*_: object) -> Any:
        raise ZeroDivisionError

    def interrupted(*_: object) -> Any:
        raise ValueError("Error calling function `_given_alone`: KeyboardInterrupt: ")

    monkeypatch.setattr("gelenk.cli.arms._answer_at", fails)
    out, err = shell("fk", "planar_2r", "-q", "0 0", code=4)
    assert "ZeroDivisionError" in err
    assert err.endswith("gelenk: something went wrong in the command itself: see above\n")
    monkeypatch.setattr("gelenk.cli.arms._answer_at", interrupted)
    assert shell("fk", "planar_2r", "-q", "0 0", code=130) == (out, "")


_STARTED = "from gelenk.cli.start import main; print(flush=True); main()"


@pytest.mark.slow
@pytest.mark.parametrize("tenths", [0, 1, 2, 4, 8, 16, 32])
def test_an_interrupt_at_any_time_leaves_no_traceback(tenths: int) -> None:
    """While modules load, while it computes, and while it ends."""
    command = [sys.executable, "-c", _STARTED, "fk", "planar_2r", "-q", "0.3 0.8"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        run.stdout.readline()
        time.sleep(0.02 + 0.1 * tenths)  # whenever that is: each time is right
        run.send_signal(signal.SIGINT)
        told = run.communicate(timeout=120)[1]
    assert run.returncode in {0, 130, -signal.SIGINT}  # the last where Python has put its own handlers away already
    assert "Traceback" not in told


def started(before: str) -> subprocess.CompletedProcess[str]:
    """A command that does something before its first module loads, and nothing after that."""
    program = f"import signal, sys, time, types\n{before}\nfrom gelenk.cli.start import main\nmain()\nprint('went on')"
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120, check=False)


def test_an_interrupt_that_a_callback_swallows_comes_again() -> None:
    """Otherwise it would be told with a traceback, and the command would go on."""
    run = started("""
class Swallowing:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

def work():
    from gelenk.cli.start import raised_interrupts
    with raised_interrupts():
        Swallowing()
        time.sleep(60)

sys.modules["gelenk.cli.main"] = types.SimpleNamespace(main=work)""")
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "")


def test_other_exceptions_that_callbacks_swallow_are_told() -> None:
    run = started("""
class Failing:
    def __del__(self):
        raise ZeroDivisionError

def work():
    from gelenk.cli.start import raised_interrupts
    with raised_interrupts():
        Failing()

sys.modules["gelenk.cli.main"] = types.SimpleNamespace(main=work)""")
    assert (run.returncode, run.stdout) == (0, "went on\n")
    assert "ZeroDivisionError" in run.stderr


def test_an_interrupt_ends_at_once_what_has_nothing_to_close() -> None:
    """Also code that would swallow it: libraries do while they load."""
    run = started("""
def work():
    try:
        signal.raise_signal(signal.SIGINT)
    except KeyboardInterrupt:
        pass

sys.modules["gelenk.cli.main"] = types.SimpleNamespace(main=work)""")
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "")


def test_an_interrupt_closes_what_is_open() -> None:
    run = started("""
def work():
    from gelenk.cli.start import raised_interrupts
    with raised_interrupts():
        try:
            signal.raise_signal(signal.SIGINT)
        finally:
            print("closed")

sys.modules["gelenk.cli.main"] = types.SimpleNamespace(main=work)""")
    assert (run.returncode, run.stdout, run.stderr) == (130, "closed\n", "")


def test_an_interrupt_before_it_is_heard_leaves_no_traceback_either() -> None:
    """While the first module of the command loads what hears it."""
    run = started("""
class Interrupted:
    def find_spec(self, name, *_):
        if name == "signal":
            raise KeyboardInterrupt

del sys.modules["signal"]
sys.meta_path.insert(0, Interrupted())""")
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "")


def test_nothing_loads_before_ctrl_c_is_heard() -> None:
    """As `typing`, which takes longer than `start`; without site, which loads what it likes."""
    load = f"import sys; sys.path.append({str(Path(gelenk.__file__).parents[1])!r}); import gelenk.cli.start"
    program = f"{load}; print('typing' in sys.modules)"
    run = subprocess.run([sys.executable, "-I", "-S", "-c", program], capture_output=True, text=True, check=True)
    assert run.stdout == "False\n"
