"""The schema is complete: each operation has a summary, an id, and an example that runs; no page names another host."""

import json
import re
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from docs.handbook.written import same
from gelenk.contract.endpoint import Endpoint, RobotEndpoint
from gelenk.contract.endpoints import ENDPOINTS as ALL_ENDPOINTS
from gelenk.contract.kinematics import MAX_CONFIGURATIONS
from gelenk.http.messages.openapi import EXAMPLES
from tests.corpus import npy
from tests.openapi import NO_ANSWER, document, example_of

Operation = tuple[str, str, dict[str, Any]]
_ORDER = {"post": 0, "get": 1, "put": 2, "delete": 3}


def operations() -> list[Operation]:
    schema = document()
    found = [(path, method, entry) for path, entries in schema["paths"].items() for method, entry in entries.items()]
    return sorted(found, key=lambda operation: _ORDER[operation[1]])


OPERATIONS = operations()
ENDPOINTS = [endpoint for endpoint in ALL_ENDPOINTS if isinstance(endpoint, RobotEndpoint)]


@pytest.mark.parametrize(("path", "method", "operation"), OPERATIONS, ids=[f"{o[1]} {o[0]}" for o in OPERATIONS])
def test_an_operation_is_described(path: str, method: str, operation: dict[str, Any]) -> None:  # noqa: ARG001
    assert operation["summary"]
    assert operation["description"]
    assert re.fullmatch(r"[a-z]+(_[a-z]+)*", operation["operationId"])
    for status, response in operation["responses"].items():
        media = set(response.get("content", {}))
        assert (media == {"application/problem+json"}) == (int(status) >= 400)


def test_ids_are_unique() -> None:
    ids = [operation["operationId"] for _, _, operation in OPERATIONS]
    assert len(set(ids)) == len(ids)


def test_a_generated_client_finds_a_name_for_everything() -> None:
    """Two models of one name would be told apart by their modules; what cannot be written is not offered."""
    schemas = document()["components"]["schemas"]
    assert [name for name in schemas if not re.fullmatch(r"[A-Z][A-Za-z0-9]*", name)] == []
    null = {"type": "null"}
    for _, _, operation in OPERATIONS:
        assert all(null not in one["schema"].get("anyOf", []) for one in operation.get("parameters", []))
        form = operation.get("requestBody", {}).get("content", {}).get("multipart/form-data")
        fields = form["schema"]["properties"].values() if form else []
        assert all(null not in field.get("anyOf", []) for field in fields)


def test_every_example_runs_as_it_stands(client: TestClient) -> None:
    """In the order of the methods, so that what POST adds is there to be replaced and removed."""
    for path, method, operation in OPERATIONS:
        if operation["operationId"] in NO_ANSWER:
            continue
        query: dict[str, Any] = {}
        for parameter in operation.get("parameters", []):
            example = next(iter(parameter["examples"].values()))["value"]
            path = path.replace(f"{{{parameter['name']}}}", str(example))  # noqa: PLW2901
            if parameter["in"] == "query":
                query[parameter["name"]] = example
        body = operation.get("requestBody", {}).get("content", {}).get("application/json", {})
        answer = client.request(method, path, params=query, json=example_of(body))
        assert answer.status_code < 300, f"{method} {path}: {answer.text}"
        assert str(answer.status_code) in operation["responses"]


@pytest.mark.parametrize("endpoint", ENDPOINTS, ids=lambda endpoint: endpoint.name)
def test_each_operation_on_a_robot_has_the_course_s_arm_as_an_example_with_its_answer(
    client: TestClient, endpoint: Endpoint[Any, Any]
) -> None:
    path = f"/{endpoint.path}"
    operation = document()["paths"][path]["post"]
    content = operation["requestBody"]["content"]["application/json"]["examples"]
    assert list(content)[:2] == ["panda", "planar_2r"]
    for name in list(content)[1:]:
        answer = client.post(path.format(robot="planar_2r"), json=content[name]["value"])
        assert answer.status_code == (202 if endpoint.is_job else 200), answer.text
        if not endpoint.is_job:
            shown = operation["responses"]["200"]["content"]["application/json"]["examples"][name]["value"]
            assert same(json.dumps(shown), json.dumps(answer.json())), "./dev handbook --write"


def test_inverse_kinematics_has_an_example_in_a_cell_where_one_branch_is_free() -> None:
    operation = document()["paths"]["/v1/robots/{robot}/ik"]["post"]
    assert "scene" in operation["requestBody"]["content"]["application/json"]["examples"]["in_cell"]["value"]
    shown = operation["responses"]["200"]["content"]["application/json"]["examples"]["in_cell"]["value"]
    (result,) = shown["results"]
    assert [solution["in_collision"] for solution in result["solutions"]] == [False, True]


def test_the_examples_add_little_to_the_document() -> None:
    assert EXAMPLES.stat().st_size < 0.05 * len(json.dumps(document()))


def query_examples(field: dict[str, Any]) -> list[Any]:
    """Values of a field of a query, one of each kind that its schema allows."""
    kinds = [*field.get("anyOf", []), *field.get("oneOf", [])] or [field]
    simple = {"boolean": True, "number": 0.5, "integer": 1, "string": "panda_link8"}
    found: list[Any] = []
    for kind in kinds:
        words = kind.get("enum", [kind["const"]] if "const" in kind else [])
        if kind.get("type") == "array":
            (inner,) = query_examples(kind["items"])
            found.append([inner] * kind.get("minItems", 1))
        elif kind.get("type") == "object":
            found.append('{"panda_joint7": 0.5}')
        elif "$ref" in kind:
            found.append('{"objects": []}' if kind["$ref"].endswith("/Scene") else '{"joint_velocity": 1.0}')
        else:
            found.append(words[0] if words else next(iter(kind.get("examples", [])), simple[kind["type"]]))
    return found


@pytest.mark.slow
def test_what_the_schema_has_for_a_query_beside_an_array_can_stand_there(client: TestClient) -> None:
    """And beside JSON none is offered, and none taken."""
    schemas = document()["components"]["schemas"]
    ready = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
    pose = [0.4, 0.1, 0.5, 1.0, 0.0, 0.0, 0.0]
    arrays = {"inverse_kinematics": [pose], "velocity": [[ready, [0.1] * 7]], "trajectories": [[ready, ready]]}
    asked = 0
    for path, _, operation in OPERATIONS:
        content = operation.get("requestBody", {}).get("content", {})
        if "application/x-npy" not in content:
            continue
        array = np.array(arrays.get(operation["operationId"], [ready]))
        address = path.format(robot="panda")
        assert [one["name"] for one in operation["parameters"] if one["in"] == "query"] == []
        query = schemas[content["application/x-npy"]["x-query"]["$ref"].rpartition("/")[2]]
        for name, field in query["properties"].items():
            assert f"`{name}`" in content["application/x-npy"]["schema"]["description"]
            for value in query_examples(field):
                contacts = {"min_clearance": 0.0} if name == "other_joints" else {}
                answer = client.post(
                    address,
                    params=contacts | {name: str(value).lower() if isinstance(value, bool) else value},
                    content=npy.saved(array),
                    headers={"content-type": "application/x-npy"},
                )
                # What goes together with what is another question.
                assert answer.json().get("type") not in {"urn:gelenk:invalid-payload", "urn:gelenk:internal-error"}, (
                    name
                )
                asked += 1
            as_json = example_of(content["application/json"])
            assert client.post(address, params={name: "true"}, json=as_json).status_code == 422
    assert asked > 80


def test_gravity_is_a_vector_in_a_query_too(client: TestClient) -> None:
    q, vector = [[0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]], [0.0, 3.0, -9.0]
    call = {"joint_positions": q, "gravity": vector, "terms": ["gravity_torques"]}
    by_json = client.post("/v1/robots/panda/dynamics", json=call).json()["gravity_torques"]
    by_npy = client.post(
        "/v1/robots/panda/dynamics",
        params={"gravity": vector, "terms": ["gravity_torques"]},
        content=npy.saved(np.array(q)),
        headers={"content-type": "application/x-npy"},
    )
    assert by_npy.json()["gravity_torques"] == by_json
    assert np.any(np.abs(by_json) > 1.0)


def holds_numbers(schema: dict[str, Any]) -> bool:
    """Whether a field's schema is a number, or lists or choices of numbers."""
    if schema.get("$ref", "").endswith(("/Configuration", "/JointValues")):
        return True
    parts = [schema, *schema.get("anyOf", []), *schema.get("oneOf", []), schema.get("items", {})]
    if any(part.get("type") in {"number", "integer"} for part in parts):
        return True
    return any(holds_numbers(part) for part in parts[1:] if part)


def test_every_numeric_field_says_what_it_is_and_in_which_unit() -> None:
    schemas = document()["components"]["schemas"]
    numeric = [
        (name, field, schema)
        for name, entry in schemas.items()
        for field, schema in entry.get("properties", {}).items()
        if holds_numbers(schema)
    ]
    assert len(numeric) > 40
    assert [f"{name}.{field}" for name, field, schema in numeric if not schema.get("description")] == []


def test_every_operation_on_a_robot_bounds_its_configurations() -> None:
    """A list beyond the bound takes long to send, so only one operation is sent any."""
    schemas = document()["components"]["schemas"]
    bounds = {}
    for path, _, operation in OPERATIONS:
        body = operation.get("requestBody", {}).get("content", {}).get("application/json")
        if "{robot}" in path and body and "joint_positions" in example_of(body):
            request = schemas[body["schema"]["$ref"].rpartition("/")[2]]
            bounds[path] = request["properties"]["joint_positions"]["maxItems"]
    assert len(bounds) == 8
    assert set(bounds.values()) == {MAX_CONFIGURATIONS}


@pytest.mark.parametrize("page", ["/docs", "/redoc"])
def test_a_page_and_what_it_loads_come_from_here_alone(client: TestClient, page: str) -> None:
    answer = client.get(page)
    assert answer.status_code == 200
    assert "//" not in answer.text.replace("<!doctype html>", "")
    assert "default-src 'self'" in answer.headers["content-security-policy"]
    assert "http" not in answer.headers["content-security-policy"]
    links = re.findall(r'(?:src|href)="([^"]+)"', answer.text)
    assert len(links) >= 3
    for link in links:
        loaded = client.get("/" + link)
        assert loaded.status_code == 200, link
        if link.endswith(".css"):
            assert not re.search(r"url\(\s*['\"]?https?:", loaded.text)
            assert "@import" not in loaded.text


@pytest.mark.slow
def test_the_schema_names_no_host(client: TestClient) -> None:
    assert "://" not in client.get("/openapi.json").text


def test_the_schema_is_made_in_another_process(client: TestClient, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(client.app, "openapi", None)
    assert client.get("/openapi.json").json() == document()
