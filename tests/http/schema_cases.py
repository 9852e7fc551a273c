"""Requests made from the schema, with what there is in the places of what is named.

Left alone, a generated request names a robot that nobody knows, and gets no further. So robots, frames, jobs and meshes
are made real in it, and rows as long as the chain has joints; every other field stays as it was generated.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import requests
from hypothesis import strategies as st
from schemathesis import GenerationMode
from schemathesis.checks import not_a_server_error
from schemathesis.specs.openapi.checks import (
    content_type_conformance,
    negative_data_rejection,
    response_headers_conformance,
    response_schema_conformance,
    status_code_conformance,
)
from starlette.testclient import TestClient

from gelenk.contract.scene import EXAMPLE_SCENE
from tests.corpus import npy, zips
from tests.openapi import example_of
from tests.robots import robot

_OF_ALL = (
    not_a_server_error,
    status_code_conformance,
    content_type_conformance,
    response_schema_conformance,
    response_headers_conformance,
)
CHECKS = {GenerationMode.POSITIVE: _OF_ALL, GenerationMode.NEGATIVE: (*_OF_ALL, negative_data_rejection)}
"""Of the answers to requests that the schema allows, and that it forbids."""
JOB = "real"
"""A job that is done."""
NEW_JOB = "generated"
"""The job that a generated request for one makes, and that others cancel."""
ROBOTS = ("panda", "planar_2r", "scara", "stanford", "ur5_dh")
UPLOADED = "uploaded_arm"
"""A robot that is replaced and removed."""
NEW_ROBOT = "zipped_arm"
EXAMPLE_EXERCISE = "mobility.linkage"
EXAMPLE_ROBOT = "panda"
"""That of the schema's examples."""
_MESHES = tuple(
    f"example-robot-data/robots/panda_description/meshes/{name}" for name in ("visual/link0.dae", "collision/hand.stl")
)
_PRESENT = st.floats(-1.5, 1.5)


class Chain(NamedTuple):
    """Two frames of a robot, and how many joints are between them."""

    robot: str
    base: str
    tip: str
    joints: int


@st.composite
def chains(draw: st.DrawFn) -> Chain:
    """The default chain of a robot, or one between any two of its frames."""
    name = draw(st.sampled_from(ROBOTS))
    found = robot(name)
    ends = found.default_chain
    if draw(st.booleans()):
        other = (draw(st.sampled_from(found.description.frames)), draw(st.sampled_from(found.description.frames)))
        ends = other if other[0] != other[1] else ends
    return Chain(name, *ends, len(found.chain(*ends)))


def _row(size: int) -> st.SearchStrategy[list[float]]:
    return st.lists(_PRESENT, min_size=size, max_size=size)


def _rows(size: int) -> st.SearchStrategy[list[list[float]]]:
    return st.lists(_row(size), max_size=3)


def _per_joint(chain: Chain) -> st.SearchStrategy[list[list[float]]]:
    return _rows(chain.joints)


REAL: dict[str, Callable[[Chain], st.SearchStrategy[Any]]] = {
    "robot": lambda chain: st.just(chain.robot),
    "base_frame": lambda chain: st.just(chain.base),
    "tip_frame": lambda chain: st.just(chain.tip),
    "frames": lambda chain: st.sampled_from([[chain.tip], [chain.base], "all"]),
    "start": lambda chain: _row(chain.joints),
    "seeds": _per_joint,
    **dict.fromkeys(("joint_positions", "joint_velocities", "joint_accelerations"), _per_joint),
    **dict.fromkeys(("joint_jerks", "joint_snaps", "torques"), _per_joint),
    **dict.fromkeys(("wrenches", "twists", "tip_accelerations", "tip_jerks"), lambda _: _rows(6)),
}
"""What stands in the place of a generated field of a name, wherever in a body that is."""
_MOSTLY = st.sampled_from((True, True, True, False))


def make_real(case: Any, data: st.DataObject) -> None:
    """Put what there is into a request in the places of what is named, mostly."""
    chain = data.draw(chains(), label="chain")
    is_near_example = data.draw(st.booleans(), label="near to the example")
    of_others = case.method in {"PUT", "DELETE"}
    robot_name = EXAMPLE_ROBOT if is_near_example or case.path.endswith("/meshes/{path}") else chain.robot
    places = {
        "robot": UPLOADED if of_others else robot_name,
        "scene": EXAMPLE_SCENE["name"],
        "file": "shelf.stl",
        "job": NEW_JOB if of_others else JOB,
        "path": data.draw(st.sampled_from(_MESHES)),
        "exercise": EXAMPLE_EXERCISE,
        "picture": "joint-pairs",
    }
    case.path_parameters = {name: places[name] for name in case.path_parameters or {}}
    if case.query:
        case.query = _real(case.query, chain, data)
    if any(parameter["name"] == "prefer" for parameter in case.operation.definition.raw.get("parameters", ())):
        case.headers["prefer"] = data.draw(st.sampled_from(("wait=10", "handling=lenient", "wait=1, Respond-Async; x")))
    if case.media_type == "application/x-npy":
        case.body = data.draw(st.sampled_from([found.body for found in npy.GOOD_NPY]) | _npy_of(chain))
    elif case.media_type == "multipart/form-data" and isinstance(case.body, dict) and data.draw(_MOSTLY):
        case.body |= {"archive": zips.good(), **({"name": NEW_ROBOT} if "name" in case.body else {})}
    elif case.media_type == "application/json" and isinstance(case.body, dict):
        if is_near_example:
            case.body = _near_example(case, data)
        elif "robot" in {*case.body, *case.path_parameters}:
            case.body = _real(case.body, chain, data)
        if "job_id" in example_of(_content(case)):
            case.body |= {"samples": data.draw(st.integers(1, 500)), "job_id": NEW_JOB}


def _content(case: Any) -> dict[str, Any]:
    """What the schema tells of a JSON body."""
    content: dict[str, Any] = case.operation.definition.raw["requestBody"]["content"]["application/json"]
    return content


def _near_example(case: Any, data: st.DataObject) -> dict[str, Any]:
    """The example of an operation, with at most two fields as they were generated."""
    kept = data.draw(st.sets(st.sampled_from(sorted(case.body)), max_size=2)) if case.body else set()
    return {**example_of(_content(case)), **{name: case.body[name] for name in kept}}


def _real(value: Any, chain: Chain, data: st.DataObject) -> Any:
    if isinstance(value, list):
        return [_real(item, chain, data) for item in value]
    if not isinstance(value, dict):
        return value
    return {
        name: data.draw(REAL[name](chain)) if name in REAL and data.draw(_MOSTLY) else _real(item, chain, data)
        for name, item in value.items()
    }


def _npy_of(chain: Chain) -> st.SearchStrategy[bytes]:
    shapes = st.sampled_from([(3, chain.joints), (1, chain.joints), (2, 3, chain.joints), (2, 7), (2, 4, 4)])
    return shapes.map(lambda shape: npy.saved(np.full(shape, 0.5)))


def sent(client: TestClient, case: Any) -> Any:
    """The answer to a request."""
    request: Any = requests.Request(**case.as_transport_kwargs(base_url=str(client.base_url))).prepare()
    return client.request(request.method, request.url, headers=dict(request.headers), content=request.body)
