"""What the service refuses is raised as the core's own exception; what may be sent again, and what may not."""

import io
import json
import pickle
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import httpx2
import numpy as np
import pytest
from starlette.requests import Request

from docs.handbook.problem_kinds import Kind, all_kinds
from gelenk import errors
from gelenk.client import Client
from gelenk.client.refusals import NotAnswering, Refused, refusal
from gelenk.contract.jobs import JobInfo
from gelenk.http.messages import problems
from tests.test_errors import example
from tests.test_serve import free_port


def test_the_exceptions_are_the_core_s(gelenk: Client) -> None:
    with pytest.raises(errors.UnknownRobot) as unknown:
        gelenk.robot("pandda")
    assert (unknown.value.robot, unknown.value.close[0]) == ("pandda", "panda")
    assert "'pandda'" in str(unknown.value)
    with pytest.raises(errors.UnknownFrame) as frame:
        gelenk.fk("panda", joint_positions=[[0.0] * 7], tip_frame="hand")
    assert frame.value.frame == "hand"
    assert "panda_link8" in frame.value.known
    with pytest.raises(errors.WrongJointCount) as count:
        gelenk.arrays.fk("panda", np.zeros((3, 6)), tip_frame="panda_link8")
    assert (count.value.given, len(count.value.expected)) == (6, 7)
    with pytest.raises(errors.NotFound):
        gelenk.remove_robot("nobody")


def test_what_is_http_s_alone_is_refused_as_well(gelenk: Client) -> None:
    with pytest.raises(Refused) as refused:
        gelenk.fk("panda", joint_positions=[[0.0] * 7], pose_format="red")  # type: ignore[arg-type]
    assert refused.value.kind == "invalid-payload"
    assert refused.value.status == 422
    assert "#/pose_format" in refused.value.detail
    assert not isinstance(refused.value, errors.InvalidInput)


def test_a_refusal_travels_between_processes() -> None:
    problem = {"type": "urn:gelenk:unknown-robot", "status": 404, "detail": "there is no such robot", "close": ["a"]}
    again = pickle.loads(pickle.dumps(refusal(problem)))  # noqa: S301
    assert isinstance(again, Refused)
    assert isinstance(again, errors.UnknownRobot)
    assert (again.problem, again.close, str(again)) == (problem, ("a",), "there is no such robot")
    away = pickle.loads(pickle.dumps(NotAnswering("http://host", "gone")))  # noqa: S301
    assert str(away) == "no answer from http://host: gone"


@pytest.mark.parametrize("kind", all_kinds(), ids=lambda kind: kind.name)
def test_every_kind_of_problem_comes_back_with_its_data(kind: Kind) -> None:
    """As the core's own exception, where it is one of the core's; the wire has no word for a line break in a name."""
    if kind.exception is None:
        facts = dict.fromkeys(kind.facts, "told")
        refused = refusal({"type": f"urn:gelenk:{kind.name}", "status": kind.status, "detail": "no", **facts})
        assert isinstance(refused, Refused)
        assert (refused.kind, refused.status, refused.facts()) == (kind.name, kind.status, facts)
        return
    core = example(errors.kinds()[kind.name], "elbow")
    request = Request({"type": "http", "path": "/", "headers": []})
    told = problems.answer(request, core)
    refused = refusal(json.loads(bytes(told.body)))
    assert isinstance(refused, type(core))
    data = {field.name: getattr(core, field.name) for field in fields(core)}
    assert {name: getattr(refused, name) for name in data} == data
    assert set(data) == set(kind.facts) <= set(refused.facts())
    assert (str(refused), refused.status) == (str(core), kind.status)


def test_no_kind_is_left_out() -> None:
    concrete = {kind for kind, core in errors.kinds().items() if core.template}
    assert {kind.name for kind in all_kinds() if kind.exception} == concrete


def test_what_an_older_service_leaves_out_is_what_the_core_would_have() -> None:
    refused = refusal({"type": "urn:gelenk:wrong-joint-count", "given": 1, "expected": ["a", "b"]})
    assert isinstance(refused, errors.WrongJointCount)
    assert (refused.index, refused.field, refused.expected) == (None, "joint_positions", ("a", "b"))


def test_all_frames_of_a_robot_are_told(gelenk: Client) -> None:
    frames = gelenk.robot("tiago_dual").frames
    with pytest.raises(errors.UnknownFrame) as unknown:
        gelenk.fk("tiago_dual", joint_positions=[], tip_frame="hand")
    assert len(unknown.value.known) == len(frames) > 100
    assert set(unknown.value.known) == set(frames)


class Line:
    """A way to a service that does what a test tells it, call by call."""

    def __init__(self, *steps: Exception | httpx2.Response) -> None:
        self.steps, self.calls = list(steps), 0

    def client(self, monkeypatch: pytest.MonkeyPatch) -> tuple[Client, list[float]]:
        pauses: list[float] = []
        monkeypatch.setattr("gelenk.client.client.time.sleep", pauses.append)
        return Client("http://gelenk.invalid", transport=httpx2.MockTransport(self.answer)), pauses

    def answer(self, _: httpx2.Request) -> httpx2.Response:
        step = self.steps[min(self.calls, len(self.steps) - 1)]
        self.calls += 1
        if isinstance(step, Exception):
            raise step
        return step


def said(status: int, content: Any = None, **headers: str) -> httpx2.Response:
    return httpx2.Response(status, json=content, headers={k.replace("_", "-"): v for k, v in headers.items()})


BUSY = {"type": "urn:gelenk:service-busy", "status": 503, "detail": "too many requests wait"}
ROBOTS: dict[str, Any] = {"robots": []}


def test_a_full_service_is_asked_again_when_it_says(monkeypatch: pytest.MonkeyPatch) -> None:
    line = Line(said(503, BUSY, retry_after="2"), said(429, BUSY, retry_after="1"), said(200, ROBOTS))
    client, pauses = line.client(monkeypatch)
    assert client.robots().robots == []
    assert pauses == [2.0, 1.0]


def test_not_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    line = Line(said(503, BUSY, retry_after="1"))
    client, _ = line.client(monkeypatch)
    with pytest.raises(errors.ServiceBusy):
        client.robots()
    assert line.calls == 4


def test_a_refusal_that_names_no_time_stands(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = {"type": "urn:gelenk:storage-failed", "status": 503, "detail": "the disk cannot be written"}
    line = Line(said(503, problem))
    client, _ = line.client(monkeypatch)
    with pytest.raises(errors.StorageFailed, match="the disk"):
        client.remove_robot("arm")
    assert line.calls == 1


NAMED_JOB: Callable[[Client], Any] = lambda client: client.workspace("arm", job_id="mine")  # noqa: E731
CALLS: dict[str, tuple[Callable[[Client], Any], bool]] = {
    "read": (lambda client: client.robots(), True),
    "computed": (lambda client: client.fk("arm", joint_positions=[[0.0]]), True),
    "kept": (lambda client: client.replace_robot("arm", urdf="<robot/>"), True),
    "removed": (lambda client: client.remove_robot("arm"), False),
    "begun": (lambda client: client.workspace("arm"), False),
    "begun under a name": (NAMED_JOB, True),
    "put off": (lambda client: client.jobs.ik("arm", targets=[]), False),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_may_have_been_done_is_sent_again_only_where_that_is_safe(
    monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    ask, is_repeatable = CALLS[name]
    line = Line(httpx2.ReadError("broken off"))
    client, _ = line.client(monkeypatch)
    with pytest.raises(NotAnswering, match="broken off"):
        ask(client)
    assert line.calls == (4 if is_repeatable else 1)


@pytest.mark.parametrize("name", CALLS)
def test_what_was_never_sent_may_be(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    line = Line(httpx2.ConnectError("refused"))
    client, pauses = line.client(monkeypatch)
    with pytest.raises(NotAnswering, match="refused"):
        CALLS[name][0](client)
    assert line.calls == 4
    assert pauses == sorted(pauses)


def test_what_takes_too_long_is_not_begun_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    line = Line(httpx2.ReadTimeout("timed out"))
    client, _ = line.client(monkeypatch)
    with pytest.raises(NotAnswering, match="longer than 120 s"):
        client.robots()
    assert line.calls == 1


def test_what_stands_in_front_of_the_service_may_answer_anything(monkeypatch: pytest.MonkeyPatch) -> None:
    client, _ = Line(httpx2.Response(502, text="<html>Bad gateway</html>")).client(monkeypatch)
    with pytest.raises(Refused, match="502 Bad Gateway, without a reason") as refused:
        client.robots()
    assert refused.value.status == 502


def test_a_newer_service_may_tell_more(monkeypatch: pytest.MonkeyPatch) -> None:
    client, _ = Line(said(200, {"robots": [], "count": 0})).client(monkeypatch)
    assert client.robots().robots == []


def test_a_stream_that_breaks_off_goes_on(monkeypatch: pytest.MonkeyPatch) -> None:
    def job(progress: float, state: str = "running") -> dict[str, Any]:
        moments = {"created": "2026-01-01T00:00:00Z", "started": None, "finished": None, "attempts": 1}
        return {"id": "mine", "kind": "workspace", "state": state, "progress": progress, **moments}

    def event(name: str, info: dict[str, Any]) -> str:
        return f"event: {name}\ndata: {JobInfo(**info).model_dump_json()}\n\n"

    def stream(text: str) -> httpx2.Response:
        return httpx2.Response(200, text=text, headers={"content-type": "text/event-stream"})

    first, last = stream(event("progress", job(0.5))), stream(event("finished", job(1.0, "succeeded")))
    line = Line(first, httpx2.ReadError("broken off"), said(200, job(0.6)), last)
    client, _ = line.client(monkeypatch)
    assert [info.progress for info in client.watch("mine")] == [0.5, 0.6, 1.0]


def test_an_array_goes_as_one_where_all_else_fits_into_the_query() -> None:
    asked: list[httpx2.Request] = []

    def answer(request: httpx2.Request) -> httpx2.Response:
        asked.append(request)
        return said(404, {"type": "urn:gelenk:unknown-robot", "status": 404, "detail": "there is no such robot"})

    client, qs = Client("http://gelenk.invalid", transport=httpx2.MockTransport(answer)), np.array([[0.1, 0.2]])
    options: list[dict[str, Any]] = [
        {"joint_positions": qs, "tip_frame": "tool", "respect_limits": True, "frames": ["a", "b"]},
        {"joint_positions": qs.tolist(), "tip_frame": "tool"},
    ]
    for given in options:
        with pytest.raises(Refused):
            client.fk("arm", **given)
    with pytest.raises(Refused):
        client.statics("arm", joint_positions=qs, payload={"mass": 1.0})  # type: ignore[arg-type]
    with pytest.raises(Refused):
        client.ik("arm", targets=np.eye(4)[None], seeds=qs.tolist())
    with pytest.raises(Refused):
        client.jobs.ik("arm", targets=np.eye(4)[None])
    array, listed, nested, seeded, later = asked
    assert np.array_equal(np.load(io.BytesIO(array.content)), qs)
    assert dict(array.url.params.multi_items()) == {"tip_frame": "tool", "respect_limits": "true", "frames": "b"}
    assert array.url.params.get_list("frames") == ["a", "b"]
    assert json.loads(listed.content) == {"joint_positions": [[0.1, 0.2]], "tip_frame": "tool"}
    assert json.loads(nested.content) == {"joint_positions": [[0.1, 0.2]], "payload": {"mass": 1.0}}
    assert json.loads(seeded.content) == {"targets": [{"matrix": np.eye(4).tolist()}], "seeds": [[0.1, 0.2]]}
    kinds = [request.headers["content-type"] for request in asked]
    assert kinds == ["application/x-npy", *["application/json"] * 3, "application/x-npy"]
    assert {request.headers["accept"] for request in asked} == {"application/json"}
    assert [request.headers.get("prefer") for request in asked] == [*[None] * 4, "respond-async"]
    assert later.url.path == "/v1/robots/arm/ik"


def test_nobody_there(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.client.client.time.sleep", lambda _: None)
    url = f"http://127.0.0.1:{free_port()}"
    with Client(url) as client, pytest.raises(NotAnswering, match=url):
        client.robots()


@pytest.mark.slow
def test_key_and_address_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GELENK_SERVER", "http://lab.invalid/gelenk/")
    monkeypatch.setenv("GELENK_KEY", "gelenk.secret")
    asked: list[httpx2.Request] = []

    def answer(request: httpx2.Request) -> httpx2.Response:
        asked.append(request)
        return said(200, ROBOTS)

    Client(transport=httpx2.MockTransport(answer)).robots()
    assert str(asked[0].url) == "http://lab.invalid/gelenk/v1/robots"
    assert asked[0].headers["authorization"] == "Bearer gelenk.secret"
