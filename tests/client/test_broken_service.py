"""Both clients at a service that breaks off, is busy, slow, gone or none: what is sent again, and what is said."""

import asyncio
import threading
import time
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from email.utils import format_datetime
from typing import Any

import httpx2
import pytest

from gelenk import errors
from gelenk.client import AsyncClient, Client
from gelenk.client.call import Call
from gelenk.client.operations import Operations
from gelenk.client.refusals import NotAnswering, Refused
from tests.client.scripted import (
    Scripted,
    Step,
    hangs_up,
    keeps_silent,
    reads_on,
    refuses,
    says,
    scripted,
    stops_halfway,
    then,
)

ROBOTS = says("200 OK", {"robots": []})
MOMENTS = {"created": "2026-01-01T00:00:00Z", "started": None, "attempts": 1}


def job(progress: float, state: str = "running") -> dict[str, Any]:
    finished = "2026-01-01T00:00:01Z" if state == "succeeded" else None
    info = {"id": "mine", "kind": "ik", "state": state, "progress": progress, "finished": finished, "error": None}
    return {**info, **MOMENTS}


JOB = says("202 Accepted", job(0.0, "queued"))
READ = Operations.robots.describe()
UPLOAD = Operations.add_robot.describe(name="arm", urdf="<robot/>")
ARCHIVE = Operations.add_archive.describe("arm", b"PK" + bytes(3_000_000))
BEGIN = Operations.workspace.describe("arm")
BEGIN_NAMED = Operations.workspace.describe("arm", job_id="mine")
REMOVE = Operations.remove_robot.describe("arm")

Ask = Callable[[str, Call[Any]], Any]


def waiting(url: str, call: Call[Any]) -> Any:
    with Client(url) as gelenk:
        return gelenk.send(call)


def awaited(url: str, call: Call[Any]) -> Any:
    async def ask() -> Any:
        async with AsyncClient(url) as gelenk:
            return await gelenk.send(call)

    return asyncio.run(ask())


@pytest.fixture(params=[waiting, awaited])
def ask(request: pytest.FixtureRequest) -> Ask:
    """Either client, for one call."""
    found: Ask = request.param
    return found


@pytest.fixture(autouse=True)
def hurried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.client.responses._FIRST_PAUSE", 0.001)
    monkeypatch.setattr("gelenk.client.client._BETWEEN_STREAMS", 0.001)


@pytest.mark.quick(5)
@pytest.mark.parametrize("fault", [hangs_up, stops_halfway, says("502 Bad Gateway", b"<html>", "text/html")])
@pytest.mark.parametrize(
    ("call", "done", "is_repeatable"),
    [
        (READ, ROBOTS, True),
        (UPLOAD, None, True),
        (ARCHIVE, None, True),
        (BEGIN_NAMED, JOB, True),
        (BEGIN, JOB, False),
        (REMOVE, says("204 No Content", b""), False),
    ],
    ids=["read", "upload", "archive", "named job", "job", "removal"],
)
def test_what_breaks_off_is_sent_again_where_it_leaves_nothing_new(
    ask: Ask, fault: Step, call: Call[Any], done: Step | None, is_repeatable: bool
) -> None:
    finish = done or refuses("409 Conflict", "robot-exists", robot="arm")
    with scripted(fault, fault, finish) as service:
        if not is_repeatable:
            with pytest.raises((NotAnswering, Refused)) as gone:
                ask(service.url, call)
            assert len(service.visits) == 1
            if isinstance(gone.value, NotAnswering):
                assert str(gone.value).endswith("; whether the call was executed is not known")
        elif done is None:
            with pytest.raises(errors.RobotExists):
                ask(service.url, call)
        else:
            ask(service.url, call)
        if is_repeatable:
            assert len(service.visits) == 3
            assert len({(visit.line, len(visit.body)) for visit in service.visits}) == 1  # the same, all of it


@pytest.mark.parametrize(
    ("call", "answer"),
    [(READ, ROBOTS), (BEGIN, JOB), (REMOVE, says("204 No Content", b""))],
    ids=["read", "job", "removal"],
)
def test_whoever_is_told_to_come_again_does(ask: Ask, call: Call[Any], answer: Step) -> None:
    soon = format_datetime(datetime.now(UTC) - timedelta(seconds=5), usegmt=True)
    busy = refuses("503 Service Unavailable", "service-busy", retry_after=0)
    later = says("429 Too Many Requests", {}, retry_after=soon)
    with scripted(busy, later, answer) as service:
        ask(service.url, call)
        assert len(service.visits) == 3


@pytest.mark.parametrize("wanted", ["31", "86400", "soon", "-1", "²", "", "Fri, 31 Dec 2999 23:59:59 GMT"])
def test_nobody_waits_for_ever_or_comes_too_early(ask: Ask, wanted: str) -> None:
    with scripted(says("503 Service Unavailable", b"<html>", "text/html", retry_after=wanted)) as service:
        with pytest.raises(Refused) as refused:
            ask(service.url, READ)
        assert len(service.visits) == 1
    assert refused.value.status == 503


def test_how_long_it_would_have_been_is_told(ask: Ask) -> None:
    busy = refuses("503 Service Unavailable", "service-busy", retry_after=120)
    with scripted(busy) as service, pytest.raises(errors.ServiceBusy) as refused:
        ask(service.url, READ)
    assert refused.value.retry_after == 120


def test_what_takes_too_long_is_given_up_once(ask: Ask, monkeypatch: pytest.MonkeyPatch) -> None:
    short = httpx2.Timeout(5.0, read=0.2)
    monkeypatch.setattr("gelenk.client.client.TIMEOUT", short)
    monkeypatch.setattr("gelenk.client.responses.TIMEOUT", short)
    with scripted(keeps_silent) as service:
        with pytest.raises(NotAnswering, match=r"it took longer than 0\.2 s$"):
            ask(service.url, READ)
        assert len(service.visits) == 1


def test_a_body_that_is_too_large_is_refused_by_its_sentence(ask: Ask) -> None:
    """The service does not read on to the end of it."""
    answer = refuses("413 Content Too Large", "too-large", what="bytes", given=3_000_000, allowed=2_000_000)
    with scripted(then(answer, reads_on), most_read=1000) as service:
        with pytest.raises(errors.TooLarge, match="it is too-large"):
            ask(service.url, ARCHIVE)
        assert len(service.visits) == 1


def test_an_upload_that_is_broken_off_in_the_middle_is_begun_anew(ask: Ask) -> None:
    with scripted(hangs_up, most_read=1000) as service:
        with pytest.raises(NotAnswering):
            ask(service.url, ARCHIVE)
        assert service.lines == ["POST /v1/robots"] * 4


def test_a_connection_that_was_closed_meanwhile_costs_nothing() -> None:
    """Not even of a call that may not be sent again."""
    with scripted(then(ROBOTS, hangs_up), JOB) as service, Client(service.url) as gelenk:
        gelenk.robots()
        assert service.left.wait(60)
        assert gelenk.workspace("arm").id == "mine"
        assert [visit.number for visit in service.visits] == [1, 2]


ELSEWHERE: dict[str, tuple[Step, str]] = {
    "a page": (says("200 OK", b"<html>", "text/html"), "what is there answers with text/html, not as Gelenk does"),
    "other JSON": (says("200 OK", {"name": "x"}), "what is there answers with application/json, not as Gelenk does"),
    "nothing": (says("204 No Content", b""), "not as Gelenk does"),
    "another API": (says("404 Not Found", {"detail": "Not Found"}), "answers with 404 Not Found, not as Gelenk does"),
    "a list": (says("400 Bad Request", [1]), "answers with 400 Bad Request, not as Gelenk does"),
    "a gate": (says("401 Unauthorized", b"", "text/html"), "answers with 401 Unauthorized, not as Gelenk does"),
    "a proxy": (says("504 Gateway Timeout", b"<html>", "text/html"), "the service behind it may not be running"),
    "a way": (says("301 Moved", b"", location="https://lab/v1/robots"), "leads to https://lab/v1/robots"),
}


@pytest.mark.quick(7)
@pytest.mark.parametrize("case", ELSEWHERE)
def test_what_is_not_the_service_is_called_so(ask: Ask, case: str) -> None:
    step, sentence = ELSEWHERE[case]
    with scripted(step) as service:
        with pytest.raises(errors.KinematicsError) as wrong:
            ask(service.url, READ)
        assert sentence in str(wrong.value)
        assert service.url in str(wrong.value)
        assert len(str(wrong.value).splitlines()) == 1


def test_an_array_that_is_none_is_called_so() -> None:
    with scripted(ELSEWHERE["a page"][0]) as service, Client(service.url) as gelenk, pytest.raises(NotAnswering):
        gelenk.arrays.job_result("mine")


def test_a_call_that_is_cancelled_leaves_nothing_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.client.client.AT_ONCE", 1)

    async def ask(service: Scripted) -> None:
        async with AsyncClient(service.url) as gelenk:
            asked = asyncio.create_task(gelenk.robots())
            while not service.visits:
                await asyncio.sleep(0.01)
            asked.cancel()
            with pytest.raises(asyncio.CancelledError):
                await asked
            assert await asyncio.to_thread(service.left.wait, 60)  # the service is told by the end of the connection
            assert (await gelenk.robots()).robots == []  # its turn is free again

    with scripted(keeps_silent, ROBOTS) as service:
        asyncio.run(ask(service))
        assert len(service.visits) == 2


def test_a_pause_is_cancelled_too(monkeypatch: pytest.MonkeyPatch) -> None:
    sleep = asyncio.sleep

    async def ask(service: Scripted) -> None:
        pausing = asyncio.Event()

        async def noted(seconds: float) -> None:
            pausing.set()
            await sleep(seconds)

        monkeypatch.setattr("gelenk.client.client.asyncio.sleep", noted)
        async with AsyncClient(service.url) as gelenk:
            asked = asyncio.create_task(gelenk.robots())
            await asyncio.wait_for(pausing.wait(), 60.0)
            asked.cancel()
            with pytest.raises(asyncio.CancelledError):
                await asked

    with scripted(refuses("503 Service Unavailable", "service-busy", retry_after=30)) as service:
        begin = time.monotonic()
        asyncio.run(ask(service))
        assert time.monotonic() - begin < 25
        assert len(service.visits) == 1


def test_no_more_at_a_time_than_the_service_takes_of_one() -> None:
    slowly = then(lambda _: time.sleep(0.02), ROBOTS)

    async def ask(url: str) -> int:
        async with AsyncClient(url) as gelenk:
            return len(await asyncio.gather(*(gelenk.robots() for _ in range(60))))

    with scripted(slowly) as service:
        assert asyncio.run(ask(service.url)) == 60
        assert 2 <= service.most <= 16
    with scripted(slowly) as service, Client(service.url) as gelenk:
        threads = [threading.Thread(target=gelenk.robots) for _ in range(40)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        assert len(service.visits) == 40
        assert 2 <= service.most <= 16


def test_who_has_closed_it_is_told_so() -> None:
    with scripted(ROBOTS) as service:
        gelenk = Client(service.url)
        gelenk.close()
        with pytest.raises(RuntimeError, match="closed"):
            gelenk.robots()
        assert not service.visits


def events(*told: dict[str, Any]) -> Step:
    """A stream that ends after these."""
    words = [f"event: {'finished' if info['finished'] else 'progress'}\ndata: {said(info)}\n\n" for info in told]
    return then(says("200 OK", "".join(words).encode(), "text/event-stream"), hangs_up)


def said(info: dict[str, Any]) -> str:
    return httpx2.Response(200, json=info).text


@pytest.mark.parametrize(
    "no_stream",
    [hangs_up, says("504 Gateway Timeout", b"<html>", "text/html"), says("200 OK", b"<html>", "text/html"), events()],
    ids=["broken off", "refused", "a page", "empty"],
)
def test_a_job_is_watched_where_no_stream_comes_through(no_stream: Step) -> None:
    steps = [no_stream, says("200 OK", job(0.4)), no_stream, says("200 OK", job(1.0, "succeeded"))]
    with scripted(*steps) as service, Client(service.url) as gelenk:
        assert [info.progress for info in gelenk.watch("mine")] == [0.4, 1.0]
        assert service.lines == ["GET /v1/jobs/mine/events", "GET /v1/jobs/mine"] * 2
    with scripted(*steps) as service:

        async def watch() -> list[float]:
            async with AsyncClient(service.url) as gelenk:
                return [info.progress async for info in gelenk.watch("mine")]

        assert asyncio.run(watch()) == [0.4, 1.0]


def test_a_stream_goes_on_where_it_broke_off_and_tells_nothing_twice() -> None:
    first, last = events(job(0.1), job(0.5)), events(job(0.5), job(1.0, "succeeded"))
    with scripted(first, says("200 OK", job(0.5)), last) as service, Client(service.url) as gelenk:
        assert [info.progress for info in gelenk.watch("mine")] == [0.1, 0.5, 1.0]


def test_a_job_that_is_gone_is_watched_no_longer() -> None:
    gone = refuses("404 Not Found", "unknown-job", job="mine")
    with scripted(events(job(0.1)), gone) as service, Client(service.url) as gelenk:
        seen: list[float] = []
        with pytest.raises(errors.UnknownJob) as unknown:
            gelenk.wait("mine", lambda info: seen.append(info.progress))
        assert (seen, unknown.value.job) == ([0.1], "mine")


def test_who_looks_no_longer_hangs_up() -> None:
    """Of a job that is awaited, by leaving the loop in `wait` with an exception."""
    stream = f"event: progress\ndata: {said(job(0.1))}\n\n".encode()
    head = b"HTTP/1.1 200 OK\r\ncontent-type: text/event-stream\r\n\r\n"

    def begins(visit: Any) -> None:
        visit.connection.sendall(head + stream)
        keeps_silent(visit)

    def stop(_: object) -> None:
        raise KeyError("enough")

    async def ask(service: Scripted) -> None:
        async with AsyncClient(service.url) as gelenk:
            with pytest.raises(KeyError):
                await gelenk.wait("mine", stop)
            assert await asyncio.to_thread(service.left.wait, 60)

    with scripted(begins) as service:
        asyncio.run(ask(service))
