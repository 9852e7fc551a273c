"""Every operation is sent what it does not take: each verdict is right, soon, small, and says what is wrong.

Time is that of the processor, in which the service runs too: a pause of a busy machine is nobody's fault.
"""

import time
from collections.abc import Iterable, Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.http.workers.pool_client import PARSED_HERE_BYTES
from tests.corpus.bodies import Call, of_json
from tests.corpus.calls import FORMS, HEADERS, NPY, PATHS, PLANAR, QUERIES
from tests.corpus.dh import TABLE
from tests.corpus.fields import FIELDS, PANDA
from tests.corpus.judging import MAX_SECONDS, complaints
from tests.corpus.npy import GOOD_NPY, REFUSED_NPY, GoodNpy, RefusedNpy
from tests.corpus.zips import ODD_ZIPS, REFUSED_ZIPS, OddZip, RefusedZip
from tests.http.test_openapi import OPERATIONS
from tests.openapi import example_of

JSON_OPERATIONS = [
    (method.upper(), path, example_of(operation["requestBody"]["content"]["application/json"]))
    for path, method, operation in OPERATIONS
    if "application/json" in operation.get("requestBody", {}).get("content", {})
]

EXERCISE = "mobility.linkage"
GRADE = "/v1/course/exercises/{exercise}/grade"
"""Whose answers may be anything that JSON has: one of the wrong form earns nothing, and is told why."""
TAKE_LITTLE = {"/v1/robots/{robot}/workspace"}


def is_large(call: Call) -> bool:
    """Whether it is too much for an operation that takes little."""
    return len(call.body) > PARSED_HERE_BYTES or "67108864" in call.mentions


def wrong_bodies(method: str, path: str, robot: str, example: dict[str, Any]) -> Iterator[Call]:
    """Bodies that an operation does not take, and how it refuses each."""
    place = path.replace("{robot}", robot).replace("{scene}", robot).replace("{exercise}", EXERCISE)
    for call in of_json(method, place, example):
        if path == GRADE and " at answers." in call.name:
            call = call._replace(statuses=(200, 400, 422))  # noqa: PLW2901
        refused = path in TAKE_LITTLE and is_large(call)
        yield call._replace(statuses=(413,), mentions=(str(PARSED_HERE_BYTES),)) if refused else call


GROUPS = {"fields": FIELDS, "paths": PATHS, "queries": QUERIES, "forms": FORMS, "headers": HEADERS}


@pytest.fixture(scope="module", autouse=True)
def still_there(client: TestClient) -> Iterator[None]:
    """After all of it the service answers as before, and has no robot or scene that it had not."""
    before = client.get("/v1/robots").json()
    scenes = client.get("/v1/scenes").json()
    yield
    assert client.get("/healthz").status_code == 200
    answer = client.post(f"{PLANAR}/fk", json={"joint_positions": [[0.0, 0.0]]})
    assert answer.json()["poses"][0]["position"] == [1.7, 0.0, 0.0]
    assert client.get("/v1/robots").json() == before
    assert client.get("/v1/scenes").json() == scenes


def check(client: TestClient, calls: Iterable[Call]) -> None:
    """Make all of the calls, then say what is wrong with their answers."""
    found = []
    for call in calls:
        headers = [(name.encode(), value.encode("utf-8")) for name, value in call.headers]
        started = time.process_time()
        answer = client.request(call.method, call.path, content=call.body, headers=headers)
        seconds = time.process_time() - started
        kind = answer.headers.get("content-type")
        wrong = complaints(call.body, call.statuses, call.mentions, answer.status_code, kind, answer.content)
        if seconds > MAX_SECONDS:
            wrong.append(f"{seconds:.1f} s")
        found += [f"{call.method} {call.path[:80]}, {call.name}: {one}" for one in wrong]
    assert not found, "\n".join(found)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("method", "path", "example"), JSON_OPERATIONS, ids=[f"{method} {path}" for method, path, _ in JSON_OPERATIONS]
)
def test_a_body_that_an_operation_does_not_take(
    client: TestClient, method: str, path: str, example: dict[str, Any]
) -> None:
    name = "hostile" if method == "PUT" else "panda"
    if method == "PUT":
        things, thing = ("scenes", example) if "{scene}" in path else ("robots", {"dh": example.get("dh", TABLE)})
        assert client.post(f"/v1/{things}", json={"name": name, **thing}).status_code == 201
    try:
        check(client, wrong_bodies(method, path, name, example))
    finally:
        for added in ("hostile", example.get("name")):
            client.delete(f"/v1/robots/{added}")
            client.delete(f"/v1/scenes/{added}")


@pytest.mark.quick(1)
@pytest.mark.filterwarnings("ignore:Exception ignored in. <function SpooledTemporaryFile")  # of a form that is cut
@pytest.mark.parametrize(
    "calls", [FIELDS, PATHS, QUERIES, FORMS, HEADERS], ids=["fields", "paths", "queries", "forms", "headers"]
)
def test_a_call_that_is_none(client: TestClient, calls: tuple[Call, ...]) -> None:
    check(client, calls)


def test_every_operation_with_a_body_is_sent_some() -> None:
    """None is left out because its example is missing."""
    with_body = {(method.upper(), path) for path, method, operation in OPERATIONS if "requestBody" in operation}
    assert {(method, path) for method, path, _ in JSON_OPERATIONS} == with_body


@pytest.mark.parametrize("case", REFUSED_NPY, ids=lambda case: case.name)
def test_an_array_that_is_none(client: TestClient, case: RefusedNpy) -> None:
    call = Call(case.name, "POST", f"{PLANAR}/fk", (case.status,), case.mentions, case.body, (NPY,))
    check(client, [call])


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "operation", ["jacobian", "ik", "statics", "dynamics", "manipulability", "velocity", "singularities", "collisions"]
)
def test_no_operation_takes_an_array_that_is_none(client: TestClient, operation: str) -> None:
    """The array is of the wrong chain for most of them, so that what is wrong with it may differ."""
    calls = (Call(case.name, "POST", f"{PANDA}/{operation}", (422,), (), case.body, (NPY,)) for case in REFUSED_NPY)
    check(client, calls)


@pytest.mark.parametrize("case", GOOD_NPY, ids=lambda case: case.name)
def test_an_array_of_any_kind_of_number(client: TestClient, case: GoodNpy) -> None:
    answer = client.post(f"{PLANAR}/fk", content=case.body, headers=dict([NPY]))
    assert answer.status_code == 200, answer.text
    wanted = client.post(f"{PLANAR}/fk", json={"joint_positions": case.values.tolist()})
    assert answer.json()["poses"] == wanted.json()["poses"]


@pytest.mark.quick(7)
@pytest.mark.parametrize("case", REFUSED_ZIPS, ids=lambda case: case.name)
def test_an_archive_that_is_no_robot(client: TestClient, case: RefusedZip) -> None:
    content = case.make()
    started = time.process_time()
    answer = client.post("/v1/robots", data={"name": "bad_archive"}, files={"archive": ("robot.zip", content)})
    assert time.process_time() - started < MAX_SECONDS
    kept = client.delete("/v1/robots/bad_archive").status_code != 404
    kind = answer.headers["content-type"]
    assert complaints(content, {case.status}, {case.word}, answer.status_code, kind, answer.content) == []
    assert not kept


@pytest.mark.quick(4)
@pytest.mark.parametrize("case", ODD_ZIPS, ids=lambda case: case.name)
def test_an_odd_archive_is_a_robot(client: TestClient, case: OddZip) -> None:
    answer = client.post("/v1/robots", data={"name": "odd_archive"}, files={"archive": ("robot.zip", case.make())})
    assert answer.status_code == 201, answer.text
    assert client.delete("/v1/robots/odd_archive").status_code == 204
