"""Parts of the OpenAPI document that FastAPI cannot read from signatures: problems, npy bodies, examples."""

import asyncio
import json
import pathlib
from collections.abc import Awaitable, Callable, Iterable, Mapping
from copy import deepcopy
from http import HTTPStatus
from typing import Annotated, Any

from fastapi import FastAPI, Header, Path, Response
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel, TypeAdapter

from gelenk.contract.endpoint import Endpoint, Resource, RobotEndpoint, Route
from gelenk.contract.endpoints import ENDPOINTS, ROUTES
from gelenk.contract.jobs import JobInfo
from gelenk.contract.kinematics import ByName, Configuration
from gelenk.contract.problem import Problem
from gelenk.contract.resources import RESOURCES
from gelenk.http.messages.payloads import CSV, JSON, MULTIPART, NPY, PICTURES
from gelenk.http.messages.problems import MEDIA_TYPE

RobotPath = Annotated[
    str,
    Path(
        description="Name of a robot.",
        openapi_examples={"panda": {"value": "panda"}, "planar_2r": {"value": "planar_2r"}},
    ),
]
UploadedRobotPath = Annotated[
    str, Path(description="Name of an uploaded robot.", openapi_examples={"my_planar_arm": {"value": "my_planar_arm"}})
]

PreferHeader = Annotated[
    str | None,
    Header(
        description="With `respond-async` (RFC 7240) a job computes the answer; any other preference is ignored.",
        openapi_examples={"at once": {"value": "wait=10"}, "as a job": {"value": "respond-async"}},
    ),
]

_JOB_STARTED: dict[int, dict[str, Any]] = {
    202: {
        "model": JobInfo,
        "description": "The job that `Prefer: respond-async` asks for",
        "headers": {
            "Location": {"description": "Of the job.", "schema": {"type": "string"}},
            "Preference-Applied": {"description": "`respond-async`.", "schema": {"type": "string"}},
        },
    }
}

_JOB_NOTE = (
    "\n\nWith `Prefer: respond-async` the call is checked and a job computes the same answer: the reply is 202 with "
    "the job's address in `Location`. Then there may be {}."
)
_BY_WORKER = (429, 500, 503, 504)
"""Statuses that any operation run by the worker pool may return."""

_NAMED: dict[str, tuple[dict[str, Any], str]] = {
    "Configuration": (
        TypeAdapter(Configuration).json_schema(),
        "One number per joint of the chain, base to tip, or an object of values by joint name.",
    ),
    "JointValues": (TypeAdapter(ByName).json_schema(), "Values by joint name; leaving out a joint is an error."),
}
"""Schemas used in many places, each described once under its name."""

_RESOURCES = {resource.name: resource for resource in RESOURCES}
EXAMPLES = pathlib.Path(__file__).with_name("planar_2r.json")
"""A request of each operation on a robot for the course's two-link arm, with its answer, made by `./dev handbook`.

A further example follows its operation's name, as in `ik/in_cell`.
"""
PLANAR_2R = json.loads(EXAMPLES.read_text(encoding="utf-8"))
_TITLES = {
    "panda": "Panda",
    "planar_2r": "Two-link arm (robot: planar_2r)",
    "in_cell": "Two-link arm beside a post (robot: planar_2r)",
}

_SCHEME = {
    "type": "http",
    "scheme": "bearer",
    "description": "A key of this service, if keys are switched on; create one with `gelenk.keys`. Scopes: `read` "
    "allows queries, `write` storing and removing robots, scenes and jobs, `teach` solutions of exercises, `admin` "
    "reading the metrics. No scope includes another.",
}
_COMPONENT = "#/components/schemas/{model}"
_PROBLEM = {"$ref": _COMPONENT.format(model="Problem")}


def problem_responses(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """Return OpenAPI responses of these statuses, as problems."""
    return {
        status: {"description": HTTPStatus(status).phrase, "content": {MEDIA_TYPE: {"schema": _PROBLEM}}}
        for status in statuses
    }


def documentation(name: str) -> dict[str, Any]:
    """Return the arguments of FastAPI's route that document one of the `RESOURCES`."""
    resource = _RESOURCES[name]
    body = {} if resource.example is None else {JSON: {"example": resource.example}, **_form(resource)}
    return _documentation(resource, resource.answer, resource.status, resource.responses, resource.problems, body)


def endpoint_documentation(endpoint: Endpoint[Any, Any]) -> dict[str, Any]:
    """Return the arguments of FastAPI's route that document one of the `ENDPOINTS`."""
    problems, responses, notes = [400, 413, 415, 422, *_BY_WORKER], {}, ""
    pictures = dict.fromkeys(PICTURES, endpoint.picture)
    contents = _contents({NPY: endpoint.npy_answer, CSV: endpoint.table, **pictures})
    contents |= _contents(endpoint.programs)
    body: dict[str, Any] = {JSON: {"example": endpoint.example}}
    if isinstance(endpoint, RobotEndpoint) or endpoint.robot_field or endpoint.tag == "DH tables":
        problems.append(404)
    if endpoint.options is not None:
        body |= _npy_body(endpoint.npy_body, endpoint.options)
    if endpoint.is_job:
        problems += [409, 507]
    if endpoint.job:
        responses, notes = _JOB_STARTED, _JOB_NOTE.format(endpoint.job)
        problems.append(507)
    if contents:
        responses = {200: {"content": contents}, **responses}
    status = 202 if endpoint.is_job else 200
    return _documentation(endpoint, endpoint.answer, status, responses, problems, body, notes)


def _documentation(
    route: Route,
    answer: Any,
    status: int,
    responses: Mapping[int, Any],
    problems: Iterable[int],
    body: dict[str, Any],
    notes: str = "",
) -> dict[str, Any]:
    return {
        "path": f"/{route.path}",
        "methods": [route.method],
        "operation_id": route.id,
        "summary": route.summary,
        "description": route.text + notes,
        "tags": [route.tag],
        "status_code": status,
        **({"response_class": Response} if answer is None else {"response_model": answer}),
        "responses": {**responses, **problem_responses(*problems)},
        "openapi_extra": {"requestBody": {"content": body}} if body else None,
    }


def _form(resource: Resource) -> dict[str, Any]:
    if resource.form is None:
        return {}
    schema = resource.form.model_json_schema()
    for field in schema["properties"].values():
        _without_null(field)
    schema["properties"] |= resource.files
    schema["required"] = [*schema.get("required", []), *resource.files]
    return {MULTIPART: {"schema": schema}}


def _contents(descriptions: Mapping[str, str]) -> dict[str, Any]:
    """Return further media types of a body by their descriptions; those without one are left out."""
    return {
        kind: {"schema": {**_content_type(kind), "description": description}}
        for kind, description in descriptions.items()
        if description
    }


def _content_type(kind: str) -> dict[str, str]:
    """Return what a body of a media type is once it is read: an object, a text, or bytes."""
    if kind.endswith(("json", "yaml")):
        return {"type": "object"}
    return {"type": "string"} if kind == CSV else {"type": "string", "format": "binary"}


def _npy_body(description: str, options: type[BaseModel]) -> dict[str, Any]:
    """Return an array as a further media type of a request, and the fields that the query may have beside it.

    OpenAPI cannot limit query parameters to one media type: they would be offered beside a JSON body too, which
    refuses them because they are fields of the body. Generators (openapi-python-client, openapi-typescript) would make
    each an argument of the function for both bodies. So the fields form a named schema, of which both generators make
    a type, and `x-query` refers to it.
    """
    names = ", ".join(f"`{name}`" for name in options.model_fields)
    sentences = (
        f"{description} The query takes the fields of `{options.__name__}`, a list by repeating its name and an object "
        f"as JSON: {names}."
    )
    return {NPY: {**_contents({NPY: sentences})[NPY], "x-query": {"$ref": _COMPONENT.format(model=options.__name__)}}}


def _without_null(schema: dict[str, Any]) -> None:
    """Remove null from the schema of a parameter or of a form's field: neither can express it."""
    choices = schema.get("anyOf", [])
    given = [choice for choice in choices if choice != {"type": "null"}]
    if len(given) < len(choices):
        del schema["anyOf"]
        inner = given[0] if len(given) == 1 else {"anyOf": given}
        schema |= {**inner, **schema}  # the field's own entries take precedence
        if schema.get("default", 0) is None:
            del schema["default"]


def describe(app: FastAPI, has_keys: bool) -> None:
    """Make the application build its OpenAPI document once, with problems instead of FastAPI's validation error."""

    def openapi() -> dict[str, Any]:
        if app.openapi_schema is None:
            schema = get_openapi(
                title=app.title,
                version=app.version,
                summary=app.summary,
                description=app.description,
                routes=app.routes,
                tags=app.openapi_tags,
                separate_input_output_schemas=False,
            )
            components = schema.setdefault("components", {}).setdefault("schemas", {})
            for name in ("HTTPValidationError", "ValidationError"):
                components.pop(name, None)
            problem = Problem.model_json_schema(ref_template=_COMPONENT)
            components.update(problem.pop("$defs"))
            components["Problem"] = problem
            queries = [endpoint.options for endpoint in ENDPOINTS if endpoint.options is not None]
            components.update({query.__name__: _query_schema(query) for query in queries})
            _name_what_is_shared(schema)
            schema["components"]["securitySchemes"] = {"key": _SCHEME}
            for operations in schema["paths"].values():
                for operation in operations.values():
                    _replace_validation_error(operation)
                    for parameter in operation.get("parameters", ()):
                        _without_null(parameter["schema"])
                    _add_refusals(operation, has_keys)
                    _add_examples(operation)
            if app.root_path:
                schema["servers"] = [{"url": app.root_path}]
            app.openapi_schema = schema
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]


def publish(app: FastAPI, built: Callable[[], Awaitable[bytes]]) -> None:
    """Serve the document at `/openapi.json`: as `built` returns it on the first request, which takes seconds."""
    building, content = asyncio.Lock(), b""

    @app.get("/openapi.json", include_in_schema=False)
    async def document() -> Response:
        nonlocal content
        async with building:
            content = content or await built()
        return Response(content, media_type=JSON)


def _query_schema(query: type[BaseModel]) -> dict[str, Any]:
    schema = query.model_json_schema(ref_template=_COMPONENT)
    for field in schema["properties"].values():
        _without_null(field)
    return schema


def _name_what_is_shared(schema: dict[str, Any]) -> None:
    """Give the schemas of `_NAMED` their names, so that a generated client has one type for each."""
    _refer(schema)
    for name, (shared, description) in _NAMED.items():
        definition = {"title": name, "description": description, **deepcopy(shared)}
        _refer(definition)
        schema["components"]["schemas"][name] = definition


def _refer(part: Any) -> None:
    """Replace named schemas by references, anywhere inside."""
    for entry in part.values() if isinstance(part, dict) else part if isinstance(part, list) else ():
        for name, (shared, _) in _NAMED.items():
            if isinstance(entry, dict) and shared.items() <= entry.items():
                for key in shared:
                    del entry[key]
                entry["$ref"] = f"#/components/schemas/{name}"
        _refer(entry)


def _add_refusals(operation: dict[str, Any], has_keys: bool) -> None:
    """Add the security of an operation, and the refusals that it may give before it runs; keys may be off."""
    statuses = [HTTPStatus.MISDIRECTED_REQUEST, HTTPStatus.FORBIDDEN]
    if (scope := ROUTES[operation["operationId"]].scope) is not None:
        operation["security"] = [*([] if has_keys else [{}]), {"key": [scope.value]}]
        statuses.append(HTTPStatus.UNAUTHORIZED)
    for status, response in problem_responses(*statuses).items():
        operation["responses"].setdefault(str(int(status)), response)


def _add_examples(operation: dict[str, Any]) -> None:
    """Add the examples on the two-link arm; here because FastAPI leaves out what is null in an answer."""
    route = ROUTES[operation["operationId"]]
    if isinstance(route, RobotEndpoint) and route.name in PLANAR_2R:
        small = {"planar_2r": PLANAR_2R[route.name]}
        small |= {key.partition("/")[2]: one for key, one in PLANAR_2R.items() if key.startswith(f"{route.name}/")}
        body = operation["requestBody"]["content"][JSON]
        body["examples"] = _examples({"panda": body.pop("example"), **_parts(small, "request")})
        if answers := _parts(small, "answer"):
            operation["responses"]["200"]["content"][JSON]["examples"] = _examples(answers)


def _parts(examples: dict[str, Any], part: str) -> dict[str, Any]:
    return {name: example[part] for name, example in examples.items() if part in example}


def _examples(values: dict[str, Any]) -> dict[str, Any]:
    return {name: {"summary": _TITLES[name], "value": value} for name, value in values.items()}


def _replace_validation_error(operation: dict[str, Any]) -> None:
    answer = operation.get("responses", {}).get("422", {})
    if "application/json" in answer.get("content", {}):
        operation["responses"]["422"] = problem_responses(422)[422]
