"""Everything in the corpus is posted: a refusal is a problem within a second, and the service goes on.

The second is one of processor time, in which the service runs too: a pause of a busy machine is nobody's fault.
"""

import json
import time
from collections.abc import Iterator
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk.contract.dh_from_urdf import FromUrdfRequest
from gelenk.http.messages.payloads import read_json
from tests.corpus.dh import GOOD_BODY, REFUSED_DH, REFUSED_JSON, TABLE, RefusedDh
from tests.corpus.urdf import EXPANDED, ODD, REFUSED, VALID, Odd, Refused, Valid
from tests.speed import is_within

JSON = {"content-type": "application/json"}
MAX_PROBLEM_BYTES = 16 * 1024


@pytest.fixture(scope="module", autouse=True)
def still_there(client: TestClient) -> Iterator[None]:
    """After all of it the service answers as before."""
    yield
    assert client.get("/healthz").status_code == 200
    answer = client.post("/v1/robots/planar_2r/fk", json={"joint_positions": [[0.0, 0.0]]})
    assert answer.json()["poses"][0]["position"] == [1.7, 0.0, 0.0]


def check_refusal(client: TestClient, body: Any, mentions: tuple[str, ...], statuses: set[int]) -> None:
    started = time.process_time()
    if isinstance(body, bytes):
        answer = client.post("/v1/robots", content=body, headers=JSON)
    else:
        answer = client.post("/v1/robots", json=body)
    assert is_within(time.process_time() - started, 1.0)
    assert answer.status_code in statuses, answer.text[:500]
    assert answer.headers["content-type"] == "application/problem+json"
    assert len(answer.content) < MAX_PROBLEM_BYTES
    problem = answer.json()
    assert {"type", "title", "status", "detail", "instance"} <= set(problem)
    assert problem["status"] == answer.status_code
    assert problem["detail"].isprintable()
    for word in mentions:
        assert word in answer.text.lower(), problem["detail"]


@pytest.mark.quick(5)
@pytest.mark.parametrize("case", [case for case in REFUSED if case.name not in EXPANDED], ids=lambda case: case.name)
def test_a_urdf_that_is_no_robot(client: TestClient, case: Refused) -> None:
    body = b'{"name": "refused", "urdf": ' + to_json(case.text) + b"}"
    check_refusal(client, body, case.mentions, {400, 422})
    assert client.get("/v1/robots/refused").status_code == 404


@pytest.mark.quick(27)
@pytest.mark.parametrize("case", REFUSED_DH, ids=lambda case: case.name)
def test_a_table_that_is_no_robot(client: TestClient, case: RefusedDh) -> None:
    check_refusal(client, {"name": "refused", "dh": case.table}, case.mentions, {422})


@pytest.mark.quick(31)
@pytest.mark.parametrize(("name", "body"), REFUSED_JSON, ids=[name for name, _ in REFUSED_JSON])
def test_a_body_that_is_no_upload(client: TestClient, name: str, body: bytes) -> None:  # noqa: ARG001
    check_refusal(client, body, (), {400, 422})


@pytest.mark.quick(11)
@pytest.mark.parametrize("case", ODD, ids=lambda case: case.name)
def test_an_odd_robot_is_accepted_with_a_warning(client: TestClient, case: Odd) -> None:
    answer = client.post("/v1/robots", json={"name": "odd", "urdf": case.text})
    assert answer.status_code == 201, answer.text
    warnings = " / ".join(answer.json()["warnings"]).lower()
    assert warnings
    for word in case.mentions:
        assert word in warnings
    assert client.delete(answer.headers["location"]).status_code == 204


@pytest.mark.quick(11)
@pytest.mark.parametrize("case", VALID, ids=lambda case: case.name)
def test_a_good_robot_is_accepted_and_moves(client: TestClient, case: Valid) -> None:
    answer = client.post("/v1/robots", json={"name": "good", "urdf": case.text})
    assert answer.status_code == 201, answer.text
    assert answer.json()["degrees_of_freedom"] == case.joint_count
    location = answer.headers["location"]
    moved = client.post(f"{location}/fk", json={"joint_positions": [[0.1] * len(answer.json()["joint_names"])]})
    assert moved.status_code == 200, moved.text
    assert client.delete(location).status_code == 204


def test_what_the_bad_tables_and_bodies_were_made_from_is_good(client: TestClient) -> None:
    assert client.post("/v1/robots", json={"name": "table", "dh": TABLE}).status_code == 201
    good = GOOD_BODY if isinstance(GOOD_BODY, bytes) else to_json(GOOD_BODY)
    assert client.post("/v1/robots", content=good, headers=JSON).status_code == 201


@pytest.mark.parametrize(
    "body",
    [b'{"joint_positions": [[NaN]]}', b'{"joint_positions": [[1e400]]}', b'{"joint_positions": [["0"]]}',
     b'{"joint_positions": [[true]]}', b'{"joint_positions": [[null]]}', b'{"joint_positions": 5}', b"[]", b"",
     b'{"joint_positions": [[0, 0]], "pose_format": "euler"}', b'{"joint_positions": [[0, 0]], "more": 1}',
     b'{"joint_positions": [[0, 0]], "tip_frame": ""}', b'{"joint_positions": [[0, 0]], "frames": "none"}',
     b"[" * 100_000, '{"joint_positions": [[0, 0]]}'.encode("utf-16"), b'{"joint_positions": [{"\\ud800": 0}]}',
     b'{"joint_positions": [[' + b"0," * 1000 + b"0]]}", b'{"joint_positions": [[0, 0]], "' + b"x" * 5000 + b'": 1}'],
)  # fmt: skip
@pytest.mark.parametrize("operation", ["fk", "jacobian"])
def test_a_call_that_is_none(client: TestClient, operation: str, body: bytes) -> None:
    answer = client.post(f"/v1/robots/planar_2r/{operation}", content=body, headers=JSON)
    assert answer.status_code in {400, 422}, answer.text
    assert answer.headers["content-type"] == "application/problem+json"
    assert len(answer.content) < MAX_PROBLEM_BYTES


BOTH = b'{"joint_1": 0, "joint_2": 0},'
FK = b'{"joint_positions": [%s], "tip_frame": "tool"%s}'


@pytest.mark.parametrize(
    ("body", "name"),
    [
        (FK % (b"[0, 0]", b', "tip_frame": "base"'), "tip_frame"),
        (FK % (b"[0, 0]", b', "tip_\\u0066rame": "tool"'), "tip_frame"),
        (FK % (b"[0, 0]", b', "joint_positions" \n : []'), "joint_positions"),
        (FK % (b'{"joint_1": 0, "joint_2": 0, "joint_1": 1}', b""), "joint_1"),
        (FK % (b"[0, 0]," * 9000 + b'{"joint_1": 0, "joint_2": 0, "joint_2": 1}', b""), "joint_2"),
        (FK % (BOTH * 9000 + b'{"joint_1": 0, "joint_2": 0, "joint_2": 1}', b""), "joint_2"),
    ],
)
def test_two_members_of_one_name_are_refused(client: TestClient, body: bytes, name: str) -> None:
    answer = client.post("/v1/robots/planar_2r/fk", content=body, headers=JSON)
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:gelenk:invalid-payload"), answer.text
    assert f"two members of the name '{name}'" in answer.json()["detail"]
    assert len(answer.content) < MAX_PROBLEM_BYTES


@pytest.mark.parametrize(
    "body",
    [
        FK % (b'{"joint_1": 0, "joint_2": 0}, {"joint_2": 0, "joint_1": 0}', b""),
        FK % (b'{"joint_1": 0, "joint_2": 0}', b', "pose_format" : "rpy"'),
        FK % (b'{"joint_\\u0031": 0, "joint_2": 0}', b""),
        FK % (BOTH * 9000 + b"[0, 0]", b""),
    ],
)
def test_names_may_come_again_in_another_object(client: TestClient, body: bytes) -> None:
    assert client.post("/v1/robots/planar_2r/fk", content=body, headers=JSON).status_code == 200


def test_names_in_strings_are_no_names(client: TestClient) -> None:
    """Quotes and colons in a string are text, and of two robots with such a text both are added."""
    texts = '", "urdf": "', '\\": "', '": ": ":', '"\\', "\\u0022name\\u0022:"
    for text in texts:
        body = {
            "name": "quoting",
            "urdf": '<robot name="r"><link name="l"/></robot>',
            "description": f'"name": "{text}',
        }
        answer = client.post("/v1/robots", json=body)
        assert answer.status_code == 201, answer.text
        assert answer.json()["description"] == body["description"]
        assert client.delete("/v1/robots/quoting").status_code == 204


def test_a_parameter_given_twice_is_refused(client: TestClient) -> None:
    answer = client.get("/v1/robots/planar_2r/dh?tip_frame=tool&tip_frame=base")
    assert (answer.status_code, answer.json()["type"]) == (422, "urn:gelenk:invalid-payload")
    assert "twice" in answer.json()["detail"]


def test_a_hundred_thousand_unknown_keys_are_a_small_answer(client: TestClient) -> None:
    body = "{" + ",".join(f'"key{i}":{i}' for i in range(100_000)) + "}"
    answer = client.post("/v1/robots/panda/fk", content=body, headers=JSON)
    assert answer.status_code == 422
    assert len(answer.content) < MAX_PROBLEM_BYTES


@pytest.mark.parametrize("entry", ["1", '"a"', "null", '["a"]', "{}", '{"a": "b"}'])
def test_a_large_list_of_nonsense_is_refused_at_its_first_entry(client: TestClient, entry: str) -> None:
    """Collecting every error of a megabyte would hold up everybody else for seconds."""
    body = '{"joint_positions": [' + ",".join([entry] * 200_000) + "]}"
    started = time.process_time()
    answer = client.post("/v1/robots/panda/fk", content=body, headers=JSON)
    assert is_within(time.process_time() - started, 1.0)
    assert answer.status_code == 422
    assert len(answer.content) < MAX_PROBLEM_BYTES


@pytest.mark.parametrize("text", ['"' * 500_000, '\\"' * 300_000, "\\" * 500_000, 'a="1" ' * 100_000])
def test_a_long_text_of_quotes_is_read_at_once(text: str) -> None:
    """A request may be answered in another process, whose time is not seen from here: so without one."""
    started = time.process_time()
    assert read_json(FromUrdfRequest, to_json({"urdf": text})).urdf == text
    assert is_within(time.process_time() - started, 0.5)


def test_unknown_paths_and_methods_are_problems(client: TestClient) -> None:
    for method, path, status in (
        ("GET", "/nothing", 404),
        ("POST", "/v1/robots/panda/dance", 404),
        ("GET", "/v1/robots/panda/fk", 405),
        ("PATCH", "/v1/robots", 405),
        ("GET", "/v1/robots/..%2f..%2fetc", 404),
        ("GET", "/v1/robots/.lock", 404),
    ):
        answer = client.request(method, path)
        assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json"), path
        if status == 405:
            assert answer.headers["allow"] == {"GET": "POST", "PATCH": "GET, HEAD, POST"}[method]


def test_head_is_get_without_a_body(client: TestClient) -> None:
    for path in ("/healthz", "/readyz", "/v1/robots/panda", "/docs"):
        assert client.head(path).status_code == 200


def to_json(value: object) -> bytes:
    """JSON that keeps lone surrogates as escapes, as a hostile client would send them."""
    return json.dumps(value).encode("ascii")
