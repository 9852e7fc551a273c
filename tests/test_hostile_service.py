"""The whole corpus goes to one running service: nothing brings it down, slows it, fills it, or gets into its log.

What is right for each request is judged in `tests/http`, by the application alone; here is the rest of it too: the
HTTP server, the process with its memory, and what it writes to its log.
"""

import json
import re
from collections.abc import Iterator
from http.client import HTTPException
from pathlib import Path

import pytest

from tests.corpus.bodies import JSON, Call
from tests.corpus.calls import ALL, NPY, PLANAR, RAW_PATHS
from tests.corpus.dh import REFUSED_DH, REFUSED_JSON
from tests.corpus.fields import PANDA
from tests.corpus.judging import MAX_SECONDS, complaints
from tests.corpus.npy import REFUSED_NPY
from tests.corpus.urdf import EXPANDED, REFUSED
from tests.corpus.zips import REFUSED_ZIPS
from tests.http.test_hostile_calls import JSON_OPERATIONS, wrong_bodies
from tests.raw_http import memory_bytes, processor_seconds, send
from tests.test_serve import HOST, get, service_that_writes

MAX_GROWTH = 300 * 1024 * 1024
REFUSALS = (400, 404, 405, 409, 413, 415, 422)
NOT_HTTP = b'"urn:gelenk:malformed-request"'
"""What the server itself cannot read it refuses before anybody looks at the call."""
_LOOK_EVERY = 50
_SOME = (
    "/v1/dh/to-urdf",
    "/v1/robots/{robot}/fk",
    "/v1/robots/{robot}/trajectory",
    "/v1/dh/derive",
    "/v1/course/mobility",
)


def robots() -> Iterator[Call]:
    """Every description, table and body that is no robot, to every place where one may come in."""
    for urdf in REFUSED:
        text = json.dumps(urdf.text).encode("ascii")
        for path, head in (("/v1/robots", b'{"name": "refused", "urdf": '), ("/v1/dh/from-urdf", b'{"urdf": ')):
            if not (urdf.name in EXPANDED and path == "/v1/robots"):
                yield Call(urdf.name, "POST", path, REFUSALS, (), head + text + b"}", (JSON,))
    for table in REFUSED_DH:
        body = json.dumps({"name": "refused", "dh": table.table}).encode("ascii")
        for path in ("/v1/robots", "/v1/dh/to-urdf"):
            yield Call(table.name, "POST", path, REFUSALS, (), body, (JSON,))
    for name, body in REFUSED_JSON:
        yield Call(name, "POST", "/v1/robots", REFUSALS, (), body, (JSON,))


def archives() -> Iterator[Call]:
    """Every archive that is none, in a form."""
    kind = ("content-type", "multipart/form-data; boundary=gelenk")
    name = b'--gelenk\r\nContent-Disposition: form-data; name="name"\r\n\r\nrefused\r\n'
    file = b'--gelenk\r\nContent-Disposition: form-data; name="archive"; filename="r.zip"\r\n\r\n'
    for case in REFUSED_ZIPS:
        yield Call(
            case.name, "POST", "/v1/robots", REFUSALS, (), name + file + case.make() + b"\r\n--gelenk--\r\n", (kind,)
        )


def arrays() -> Iterator[Call]:
    """Every array that is none, as configurations and as targets."""
    for case in REFUSED_NPY:
        for path in (f"{PLANAR}/fk", f"{PANDA}/ik"):
            yield Call(case.name, "POST", path, REFUSALS, (), case.body, (NPY,))


def corpus() -> Iterator[Call]:
    """Everything that is hostile, one after the other."""
    yield from robots()
    yield from archives()
    yield from arrays()
    yield from ALL
    yield from RAW_PATHS
    for method, path, example in JSON_OPERATIONS:
        if path in _SOME and method == "POST":
            yield from wrong_bodies(method, path, "panda", example)


@pytest.mark.slow
def test_a_service_survives_the_whole_corpus(tmp_path: Path) -> None:
    log = tmp_path / "log"
    wrong: list[str] = []
    count = 0
    with log.open("wb") as sink, service_that_writes(sink, tmp_path / "data", GELENK_LOG_LEVEL="info") as (run, url):
        address = (HOST, int(url.rsplit(":", 1)[1]))
        robots_before = get(f"{url}/v1/robots")
        first = memory_bytes(run.pid)
        growth, seconds = 0, processor_seconds(run.pid)
        for call in corpus():
            count += 1
            try:
                answer = send(address, call.method, call.path, call.headers, call.body)
            except HTTPException as error:
                wrong.append(f"{call.method} {call.path[:80]}, {call.name}: no answer, {error}")
                assert run.poll() is None
                continue
            statuses = (*call.statuses, 400) if NOT_HTTP in answer.body else call.statuses
            found = complaints(call.body, statuses, (), answer.status, answer.media_type, answer.body)
            wrong += [f"{call.method} {call.path[:80]}, {call.name}: {one}" for one in found]
            spent = processor_seconds(run.pid) - seconds
            seconds += spent
            if spent > MAX_SECONDS:
                wrong.append(f"{call.method} {call.path[:80]}, {call.name}: {spent:.1f} s")
            if count % _LOOK_EVERY == 0:
                growth = max(growth, memory_bytes(run.pid) - first)
        assert get(f"{url}/v1/robots/planar_2r/fk", "POST", {"joint_positions": [[0.0, 0.0]]})[0] == 200
        robots_after = get(f"{url}/v1/robots")
        growth = max(growth, memory_bytes(run.pid) - first)
    assert not wrong, "\n".join(wrong)
    assert robots_after == robots_before
    assert count > 1500
    assert growth < MAX_GROWTH
    written = log.read_bytes()
    assert written.count(b'"message": "request"') > count / 2
    assert re.findall(rb".{0,80}[^ -~\n].{0,80}", written) == []
