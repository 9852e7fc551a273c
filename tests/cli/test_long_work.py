"""Large batches: the numbers of one call, errors that name the row, and a bar for those who look at a terminal."""

import json
import sys
from itertools import pairwise
from pathlib import Path
from typing import Any

import httpx2
import numba
import numpy as np
import pytest

from gelenk.cli.batches import in_calls
from gelenk.cli.local import InProcess
from gelenk.client import Client
from gelenk.client.refusals import Refused
from gelenk.contract.fk import ForwardAnswer
from tests.cli.conftest import Shell
from tests.test_serve import get

ROWS = 1_203
QS = np.random.default_rng(2).uniform(-1.5, 1.5, (ROWS, 2)).round(6)
BATCHES: dict[str, dict[str, Any]] = {
    "fk": {"frames": "all"},
    "jacobian": {"derivatives": ["time_variation", "hessian"], "joint_velocities": QS[::-1].tolist()},
    "manipulability": {"characteristic_length": 0.3, "gradient": True},
}


@pytest.fixture
def rows(tmp_path: Path) -> Path:
    np.save(tmp_path / "q.npy", QS)
    return tmp_path / "q.npy"


def answer_of_one_call(url: str, operation: str, fields: dict[str, Any]) -> Any:
    status, answer = get(f"{url}/v1/robots/planar_2r/{operation}", "POST", fields)
    assert status == 200, answer
    return answer


def cut(fields: dict[str, Any], part: slice) -> dict[str, Any]:
    is_each = {name: isinstance(value, list) and len(value) == ROWS for name, value in fields.items()}
    return {name: value[part] if is_each[name] else value for name, value in fields.items()}


@pytest.mark.slow
@pytest.mark.parametrize("operation", BATCHES)
def test_the_numbers_are_those_of_one_call(
    shell: Shell, url: str, rows: Path, operation: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And more of them are recomputed: as many of each call as of the only one."""
    monkeypatch.setattr("gelenk.cli.batches._SECONDS", 1e3)  # two calls, however slow the machine is
    further = BATCHES[operation]
    there = ("--server", url)
    found = shell.json(*there, operation, "planar_2r", "--from", rows, "--fields", json.dumps(further))
    fields = {"joint_positions": QS.tolist(), **further}
    at_once = answer_of_one_call(url, operation, fields)
    parts = [answer_of_one_call(url, operation, cut(fields, part)) for part in (slice(1000), slice(1000, None))]
    certificate, *of_parts = (one.pop("certificate") for one in (found, *parts))
    assert certificate["samples"] == 2 * at_once.pop("certificate")["samples"] > 0
    assert found == at_once
    for name in set(certificate) - {"samples", "seed"}:
        errors = [part[name] for part in of_parts]
        assert certificate[name] == (None if None in errors else max(errors)), name


def test_verdicts_are_those_of_one_call(shell: Shell, url: str, tmp_path: Path) -> None:
    """Each with the seed of its own; some cannot be reached."""
    targets = np.zeros((120, 6))
    targets[:, :2] = np.random.default_rng(3).uniform(-1.9, 1.9, (120, 2)).round(6)
    np.save(tmp_path / "targets.npy", targets)
    poses = [{"position": row[:3], "rpy": row[3:]} for row in targets.tolist()]
    fields = {"task": ["x", "y"], "seeds": QS[:120].tolist(), "solutions": "all"}
    expected = answer_of_one_call(url, "ik", {"targets": poses, **fields})
    asked = ["ik", "planar_2r", "--from", tmp_path / "targets.npy", "--fields", json.dumps(fields)]
    assert shell.json("--server", url, *asked, code=1) == expected
    assert {result["status"] for result in expected["results"]} >= {"solved", "unreachable"}


def test_a_time_limit_is_that_of_the_whole_batch(own: InProcess) -> None:
    asked: list[int] = []

    def ask(joint_positions: Any, **_: Any) -> ForwardAnswer:
        asked.append(len(joint_positions))
        return Client("http://127.0.0.1", transport=own).fk("planar_2r", joint_positions=joint_positions)

    in_calls(ask, {"joint_positions": QS.tolist(), "time_limit": 5.0}, "joint_positions", lambda _: None)
    assert asked == [ROWS]


def test_progress_is_that_of_the_rows(own: InProcess) -> None:
    """Calls grow while they are answered quickly, and none is too large for an answer in JSON."""
    asked: list[int] = []
    told: list[float] = []
    client = Client("http://127.0.0.1", transport=own)

    def ask(joint_positions: Any) -> ForwardAnswer:
        asked.append(len(joint_positions))
        return client.fk("planar_2r", joint_positions=joint_positions)

    answer = in_calls(ask, {"joint_positions": QS.tolist()}, "joint_positions", told.append, first=10)
    assert sum(asked) == len(answer.poses) == ROWS
    assert asked[0] == 10
    assert all(after <= 8 * before for before, after in pairwise(asked))
    assert told == [sum(asked[: i + 1]) / ROWS for i in range(len(asked))]


def test_a_row_is_named_by_its_place_in_the_whole_batch(shell: Shell, url: str, tmp_path: Path) -> None:
    """In the very sentence of the API, where the batch is one call."""
    qs = QS.copy()
    qs[1100, 1] = 1e300
    np.save(tmp_path / "q.npy", qs)
    problem = get(f"{url}/v1/robots/planar_2r/fk", "POST", {"joint_positions": qs.tolist()})[1]
    assert "entry 1100" in problem["detail"]
    assert shell("fk", "planar_2r", "--from", tmp_path / "q.npy", code=2)[1] == f"gelenk: {problem['detail']}\n"
    targets = [{"position": [1.0, 0.5, 0.0], "rpy": [0.0, 0.0, 0.0]} for _ in range(80)]
    targets[77]["position"][0] = 1e9
    problem = get(f"{url}/v1/robots/planar_2r/ik", "POST", {"targets": targets, "task": ["x", "y"]})[1]
    assert "#/targets/77/" in problem["detail"]
    rows = [[*target["position"], *target["rpy"]] for target in targets]
    asked = ["ik", "planar_2r", "--task", "x,y", "--from", "-"]
    assert shell(*asked, stdin=json.dumps(rows).encode(), code=2)[1] == f"gelenk: {problem['detail']}\n"
    with Client(url) as gelenk, pytest.raises(Refused) as refused:
        body = {"joint_positions": [[0.1, 0.2]] * 40 + [[0.1, 0.2, 0.3]]}
        in_calls(lambda **fields: gelenk.fk("planar_2r", **fields), body, "joint_positions", lambda _: None, first=30)
    assert refused.value.index == 40  # type: ignore[attr-defined]
    assert refused.value.problem["pointer"] == "#/joint_positions/40"


LONG = {
    # More configurations than are computed without the application.
    "fk": ["fk", "planar_2r", *["-q", "0 0"] * 17],
    "jacobian": ["jacobian", "planar_2r", *["-q", "0 0"] * 17],
    "manipulability": ["manipulability", "planar_2r", *["-q", "0 0"] * 17],
    "ik": ["ik", "planar_2r", "--to", "1 0 0", "--task", "x,y"],
    "trajectory": ["trajectory", "planar_2r", "--start", "0 0", "--joint", "0.5 0.2"],
    "workspace": ["workspace", "planar_2r", "--samples", "2000"],
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", LONG)
def test_a_bar_is_shown_on_a_terminal_alone_and_only_of_long_work(
    shell: Shell, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    arguments = ["--format", "csv", *LONG[name]]
    monkeypatch.setenv("FORCE_COLOR", "1")
    out, err = shell(*arguments)
    assert err == "", "in a pipe"
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    monkeypatch.setattr("gelenk.cli.session._LONG_SECONDS", 100.0)
    assert shell(*arguments) == (out, ""), "of what is over soon"
    monkeypatch.setattr("gelenk.cli.session._LONG_SECONDS", 0.0)
    shown, bar = shell(*arguments)
    assert name in bar
    assert shown == out


@pytest.mark.parametrize("is_terminal", [True, False])
def test_compiling_is_told_on_a_terminal(
    shell: Shell, own: InProcess, monkeypatch: pytest.MonkeyPatch, is_terminal: bool
) -> None:
    handle = own.handle_request

    def cold(request: httpx2.Request) -> httpx2.Response:
        numba.njit(lambda x: x + 1)(1)
        return handle(request)

    monkeypatch.setattr(own, "handle_request", cold)
    monkeypatch.setattr(sys.stderr, "isatty", lambda: is_terminal)
    told = shell("--format", "csv", *LONG["fk"])[1].count("compiling the kernels, once: about a minute …\n")
    assert told == is_terminal
