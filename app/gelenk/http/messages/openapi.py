"""Parts of the OpenAPI document that FastAPI cannot read from signatures: problems, npy bodies, examples."""

from collections.abc import Sequence
from copy import deepcopy
from http import HTTPStatus
from typing import Annotated, Any

from fastapi import FastAPI, Header, Path, Response
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel, TypeAdapter

from gelenk.contract.endpoints import ROUTES
from gelenk.contract.jobs import JobInfo
from gelenk.contract.kinematics import ByName, Configuration
from gelenk.contract.problem import Problem
from gelenk.contract.resources import RESOURCES
from gelenk.http.messages.payloads import CSV, MULTIPART, NPY, PNG, SVG
from gelenk.http.messages.problems import MEDIA_TYPE

RobotPath = Annotated[str, Path(description="Name of a robot.", openapi_examples={"panda": {"value": "panda"}})]
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

JOB_BEGUN: dict[int | str, dict[str, Any]] = {
    202: {
        "model": JobInfo,
        "description": "The job that `Prefer: respond-async` asks for",
        "headers": {
            "Location": {"description": "Of the job.", "schema": {"type": "string"}},
            "Preference-Applied": {"description": "`respond-async`.", "schema": {"type": "string"}},
        },
    }
}

BY_THE_CREW = (429, 500, 503, 504)
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
_SCHEME = {
    "type": "http",
    "scheme": "bearer",
    "description": "A key of this service, if keys are switched on; create one with `gelenk.keys`. Scopes: `read` "
    "allows queries, `write` storing and removing robots and jobs, `admin` reading the metrics. No scope includes "
    "another.",
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
    body = {} if resource.example is None else json_example(resource.example)
    return {
        "path": f"/{resource.path}",
        "methods": [resource.method],
        "operation_id": resource.id,
        "summary": resource.summary,
        "description": resource.text,
        "tags": [resource.tag],
        "status_code": resource.status,
        **({"response_class": Response} if resource.answer is None else {"response_model": resource.answer}),
        "responses": {**resource.responses, **problem_responses(*resource.problems)},
        "openapi_extra": {"requestBody": {"content": body | _form(resource.form)}} if body else None,
    }


def _form(fields: type[BaseModel] | None) -> dict[str, Any]:
    """Return a form with these fields and an archive, as a further media type of a request."""
    if fields is None:
        return {}
    schema = fields.model_json_schema()
    for field in schema["properties"].values():
        without_null(field)
    schema["properties"]["archive"] = {
        "type": "string",
        "format": "binary",
        "description": "Zip of one URDF and its meshes.",
    }
    schema["required"] = [*schema.get("required", []), "archive"]
    return {MULTIPART: {"schema": schema}}


def json_example(value: dict[str, Any]) -> dict[str, Any]:
    """Return the JSON content of a request, with an example body that works unchanged."""
    return {"application/json": {"example": value}}


def npy_content(description: str) -> dict[str, Any]:
    """Return an array as a further media type of a body; nothing if the description is empty."""
    return {NPY: {"schema": {"type": "string", "format": "binary", "description": description}}} if description else {}


def npy_body(description: str, options: type[BaseModel]) -> dict[str, Any]:
    """Return an array as a further media type of a request, and the fields that the query may have beside it.

    OpenAPI cannot limit query parameters to one media type: they would be offered beside a JSON body too, which
    refuses them because they are fields of the body. Generators (openapi-python-client, openapi-typescript) would make
    each an argument of the function for both bodies. So the fields form a named schema, of which both generators make
    a type, and `x-query` refers to it.

    Args:
        description: Content of the array.
        options: Fields of the query.
    """
    names = ", ".join(f"`{name}`" for name in options.model_fields)
    told = (
        f"{description} The query takes the fields of `{options.__name__}`, a list by repeating its name and an object "
        f"as JSON: {names}."
    )
    (content,) = npy_content(told).values()
    return {NPY: {**content, "x-query": {"$ref": _COMPONENT.format(model=options.__name__)}}}


def csv_content(description: str) -> dict[str, Any]:
    """Return a table as a further media type of a response; nothing if the description is empty."""
    return {CSV: {"schema": {"type": "string", "description": description}}} if description else {}


def picture_content(description: str) -> dict[str, Any]:
    """Return images as further media types of a response; nothing if the description is empty."""
    if not description:
        return {}
    return {kind: {"schema": {"type": "string", "format": "binary", "description": description}} for kind in (SVG, PNG)}


def without_null(schema: dict[str, Any]) -> None:
    """Remove null from the schema of a parameter or of a form's field: neither can express it."""
    choices = schema.get("anyOf", [])
    given = [choice for choice in choices if choice != {"type": "null"}]
    if len(given) < len(choices):
        del schema["anyOf"]
        inner = given[0] if len(given) == 1 else {"anyOf": given}
        schema |= {**inner, **schema}  # the field's own entries take precedence
        if schema.get("default", 0) is None:
            del schema["default"]


def describe(app: FastAPI, has_keys: bool, queries: Sequence[type[BaseModel]] = ()) -> None:
    """Make the application build its OpenAPI document once, with problems instead of FastAPI's validation error.

    Args:
        app: The application.
        has_keys: Whether its operations need keys.
        queries: Query parameters beside an array body.
    """

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
            components.update({query.__name__: _query_schema(query) for query in queries})
            _name_what_is_shared(schema)
            schema["components"]["securitySchemes"] = {"key": _SCHEME}
            for operations in schema["paths"].values():
                for operation in operations.values():
                    _replace_validation_error(operation)
                    for parameter in operation.get("parameters", ()):
                        without_null(parameter["schema"])
                    _add_refusals(operation, has_keys)
            app.openapi_schema = schema
        return app.openapi_schema

    app.openapi = openapi  # type: ignore[method-assign]


def _query_schema(query: type[BaseModel]) -> dict[str, Any]:
    schema = query.model_json_schema(ref_template=_COMPONENT)
    for field in schema["properties"].values():
        without_null(field)
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


def _replace_validation_error(operation: dict[str, Any]) -> None:
    answer = operation.get("responses", {}).get("422", {})
    if "application/json" in answer.get("content", {}):
        operation["responses"]["422"] = problem_responses(422)[422]
