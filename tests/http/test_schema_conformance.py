"""The schema's own word, tried out: of any request that it allows or forbids, the answer is one that it tells of.

No answer may be a 5xx, of an undocumented status, or of another media type or shape than its schema says.
"""

import time
from collections import Counter
from collections.abc import Iterator
from typing import Any

import jsonschema_rs
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, given, seed, settings, strategies as st
from schemathesis import GenerationMode
from schemathesis.core.failures import FailureGroup
from starlette.testclient import TestClient

from gelenk.contract.scene import EXAMPLE_SCENE
from tests.corpus import dh
from tests.http.schema_cases import CHECKS, JOB, NEW_JOB, UPLOADED, make_real, sent
from tests.openapi import NO_ANSWER, document, example_of

SCHEMA = schemathesis.openapi.from_dict(document())
OPERATIONS: list[Any] = [found.ok() for found in SCHEMA.get_all_operations()]  # type: ignore[union-attr]
CHOOSY = [operation for operation in OPERATIONS if operation.body or operation.query]
"""Those of which the schema can forbid anything but another path."""
_DRAWS = 12
"""Requests to each operation, of each kind."""


def put_there(client: TestClient, operation: Any) -> None:
    """The scene that the operation asks for, or what it is going to replace or remove."""
    if "{scene}" in operation.path:
        assert client.post("/v1/scenes", json=EXAMPLE_SCENE).status_code in {200, 201, 409, 413}
    elif operation.method.upper() in {"PUT", "DELETE"}:
        if "{robot}" in operation.path:
            assert client.post("/v1/robots", json={"name": UPLOADED, "dh": dh.TABLE}).status_code in {200, 201, 409}
        else:
            call = {"samples": 100, "job_id": NEW_JOB}
            assert client.post("/v1/robots/panda/workspace", json=call).status_code in {202, 409, 429}


def try_out(client: TestClient, operation: Any, mode: GenerationMode, count: int, first: int = 7) -> Counter[int]:
    """Send requests, and judge the answers; how many were of which status."""
    statuses: Counter[int] = Counter()
    offered = [kind for answer in operation.definition.raw["responses"].values() for kind in answer.get("content", {})]

    @seed(first)
    @settings(
        max_examples=count,
        deadline=None,
        database=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )
    @given(case=operation.as_strategy(generation_mode=mode), data=st.data())
    def judge(case: Any, data: st.DataObject) -> None:
        if mode is GenerationMode.POSITIVE:
            make_real(case, data)
            put_there(client, operation)
        case.headers["Accept"] = data.draw(st.sampled_from(offered), label="accepted") if offered else "*/*"
        answer = sent(client, case)
        statuses[answer.status_code] += 1
        case.validate_response(answer, checks=CHECKS[mode])

    judge()
    return statuses


@pytest.fixture(scope="module", autouse=True)
def finished_job(client: TestClient) -> None:
    """A job whose result can be asked for."""
    call = {"samples": 1000, "tip_frame": "panda_link8", "job_id": JOB}
    assert client.post("/v1/robots/panda/workspace", json=call).status_code == 202
    deadline = time.monotonic() + 120
    while client.get(f"/v1/jobs/{JOB}").json()["state"] in {"queued", "running"}:
        assert time.monotonic() < deadline
        time.sleep(0.05)


@pytest.fixture(autouse=True)
def nothing_added(client: TestClient) -> Iterator[None]:
    """What requests add is gone after them: each operation finds the same, whichever was asked before it."""
    before = added(client)
    yield
    for path in added(client) - before:
        client.delete(path)
    for _ in range(2):  # it is cancelled before it can be removed
        client.delete(f"/v1/jobs/{NEW_JOB}", params={"finished": "remove"})


def added(client: TestClient) -> set[str]:
    """Paths of the robots and scenes that there are."""
    kinds = ("robots", "scenes")
    return {f"/v1/{kind}/{one['name']}" for kind in kinds for one in client.get(f"/v1/{kind}").json()[kind]}


@pytest.mark.slow
def test_the_schema_allows_its_own_examples() -> None:
    for operation in OPERATIONS:
        content = operation.definition.raw.get("requestBody", {}).get("content", {}).get("application/json")
        if content is not None:
            schema = {**content["schema"], "components": SCHEMA.raw_schema["components"]}
            for example in [example_of(content), *(one["value"] for one in content.get("examples", {}).values())]:
                jsonschema_rs.validator_for(schema).validate(example)


@pytest.mark.parametrize(
    "change", [{"status_code": 418}, {"status_code": 500}, {"json": {"robots": 1}}, {"text": "[]"}]
)
def test_an_answer_that_the_schema_does_not_tell_of_would_be_seen(
    client: TestClient, monkeypatch: pytest.MonkeyPatch, change: dict[str, Any]
) -> None:
    answer = client.get("/v1/robots")
    other = type(answer)(**{"status_code": 200, "request": answer.request, **change})
    other.elapsed = answer.elapsed
    monkeypatch.setattr("tests.http.test_schema_conformance.sent", lambda *_: other)
    with pytest.raises(FailureGroup):
        try_out(client, OPERATIONS[0], GenerationMode.POSITIVE, 1)


@pytest.mark.quick(1)
@pytest.mark.parametrize("operation", OPERATIONS, ids=lambda operation: operation.label)
def test_requests_that_the_schema_allows(client: TestClient, operation: Any) -> None:
    """Further ones are drawn where none had an answer."""
    statuses: Counter[int] = Counter()
    for first in range(4):
        statuses += try_out(client, operation, GenerationMode.POSITIVE, _DRAWS, first)
        if any(200 <= status < 300 for status in statuses):
            break
    else:
        assert operation.definition.raw["operationId"] in NO_ANSWER, statuses


@pytest.mark.quick(1)
@pytest.mark.parametrize("operation", CHOOSY, ids=lambda operation: operation.label)
def test_requests_that_the_schema_forbids(client: TestClient, operation: Any) -> None:
    assert try_out(client, operation, GenerationMode.NEGATIVE, _DRAWS)
