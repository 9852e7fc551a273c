"""Of every operation: its answers keep to their model, every number in them is finite, every rotation is one.

Asked are the examples of the schema and random configurations, targets and motions of robots of all kinds, some of
them singular or at their limits. JSON has no word for NaN: where one would stand there is a null, which the models
refuse where they ask for a number.
"""

import math
import time
from collections.abc import Iterator
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from fastapi.routing import iter_route_contexts
from pydantic import TypeAdapter
from starlette.testclient import TestClient

from tests.http.test_openapi import OPERATIONS
from tests.openapi import NO_ANSWER, example_of

TOLERANCE = 1e-9
"""Of RᵀR - I, entry by entry, and of the length of a quaternion or an axis."""
NPY = {"accept": "application/x-npy"}
FORMATS = ("quaternion_xyzw", "quaternion_wxyz", "rpy", "zyz", "rotation_vector", "rotation", "matrix")
ROBOTS = ("panda", "ur5_dh", "stanford", "scara", "planar_3r", "kinova", "tiago", "double_pendulum_continuous")
"""With closed forms and without, sliding, continuous, of few joints and of many, from URDF and from tables."""
_TRANSFORMS = {"matrix", "A", "T_0", "T_base_tool"}
_ROTATIONS = {"rotation"}
_UNIT = {"quaternion_xyzw", "quaternion_wxyz", "axis"}
Call = tuple[str, dict[str, Any]]


def flaws(content: Any, place: str = "$") -> Iterator[str]:
    """Where a number is not finite or a rotation is none, in the content of an answer."""
    if isinstance(content, dict):
        for key, value in content.items():
            yield from flaws(value, f"{place}.{key}")
            yield from _rotation_flaws(key, value, f"{place}.{key}")
    elif isinstance(content, list):
        for i, value in enumerate(content):
            yield from flaws(value, f"{place}[{i}]")
    elif isinstance(content, float) and not math.isfinite(content):
        yield f"{place} is {content}"


def _rotation_flaws(key: str, value: Any, place: str) -> Iterator[str]:
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        return  # formulas, or several things of that name
    if key in _UNIT and array.shape in {(4,), (3,)} and abs(np.linalg.norm(array) - 1) > TOLERANCE:
        yield f"{place} has the length {np.linalg.norm(array)!r}"
    size = 4 if key in _TRANSFORMS else 3
    if key in _TRANSFORMS | _ROTATIONS and array.ndim >= 2 and array.shape[-2:] == (size, size):
        yield from matrix_flaws(array.reshape(-1, size, size), place)


def matrix_flaws(matrices: np.ndarray, place: str) -> Iterator[str]:
    """Which of some rotations or poses, shape (N, 3, 3) or (N, 4, 4), are none."""
    Rs = matrices[:, :3, :3]
    if not np.allclose(Rs @ Rs.transpose(0, 2, 1), np.eye(3), rtol=0, atol=TOLERANCE):
        yield f"{place} is not orthonormal"
    elif not (np.linalg.det(Rs) > 0).all():
        yield f"{place} is a reflection"
    if matrices.shape[1] == 4 and not (matrices[:, 3] == [0, 0, 0, 1]).all():
        yield f"{place} has another last row"


def models(client: TestClient) -> dict[str, Any]:
    """The model of the JSON answer of each operation that has one, or the models of its several answers."""
    routes = iter_route_contexts(client.app.routes)  # type: ignore[attr-defined]
    found = {getattr(route, "operation_id", None): getattr(route, "response_model", None) for route in routes}
    return {name: model for name, model in found.items() if name and model is not None}


def checked(client: TestClient, operation: str, content: bytes) -> Any:
    """The content of an answer that has no flaw."""
    model: TypeAdapter[Any] = TypeAdapter(models(client)[operation])
    answer = model.dump_python(model.validate_json(content), mode="json")
    assert list(flaws(answer)) == []
    return answer


def test_the_judge_sees_what_is_wrong() -> None:
    wrong = {
        "poses": [{"quaternion_xyzw": [0.0, 0.0, 0.0, 1.0 + 1e-8]}, {"rotation": [[1, 0, 0], [0, 1, 1e-8], [0, 0, 1]]}],
        "duration": math.inf,
        "matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]],
        "T_0": [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]],
    }
    assert len(list(flaws(wrong))) == 5
    right = {"rotation": np.eye(3).tolist(), "matrix": np.eye(4).tolist(), "A": [np.eye(4).tolist()] * 2}
    assert list(flaws(right)) == []


def test_the_answers_to_all_examples(client: TestClient) -> None:
    count = 0
    for path, method, operation in OPERATIONS:
        if operation["operationId"] in NO_ANSWER:
            continue
        for parameter in operation.get("parameters", []):
            example = str(next(iter(parameter["examples"].values()))["value"])
            path = path.replace(f"{{{parameter['name']}}}", example)  # noqa: PLW2901
        body = example_of(operation.get("requestBody", {}).get("content", {}).get("application/json", {}))
        query = {"finished": "remove"} if operation["operationId"] == "cancel_job" else None
        answer = client.request(method, path, params=query, json=body)
        assert answer.status_code < 300, answer.text
        if "panda-workspace" in path:
            wait_for(client, path)
        if answer.headers.get("content-type") == "application/json":
            checked(client, operation["operationId"], answer.content)
            count += 1
    assert count > 30


def wait_for(client: TestClient, job: str) -> None:
    """Until a job has come to its end, so that what follows it is there."""
    deadline = time.monotonic() + 120
    while client.get("/".join(job.split("/")[:4])).json().get("state") in {"queued", "running"}:
        assert time.monotonic() < deadline
        time.sleep(0.05)


class Arm:
    """A robot's default chain and what may be asked of it at random."""

    def __init__(self, client: TestClient, name: str) -> None:
        self.client, self.name = client, name
        info = client.get(f"/v1/robots/{name}").json()
        limits = {joint["name"]: joint["limits"] for joint in info["joints"]}
        self.names: list[str] = info["joint_names"]
        wide = [(limits[joint]["lower"], limits[joint]["upper"]) for joint in self.names]
        self.lower = np.array([-3.1 if low is None else low for low, _ in wide])
        self.upper = np.array([3.1 if high is None else high for _, high in wide])
        self.random = np.random.default_rng(sum(map(ord, name)))

    def ask(self, operation: str, **call: Any) -> Any:
        """The checked answer of an operation."""
        answer = self.client.post(f"/v1/robots/{self.name}/{operation}", json=call)
        assert answer.status_code == 200, (operation, call, answer.text[:1000])
        ids = {"fk": "forward_kinematics", "ik": "inverse_kinematics"}
        return checked(self.client, ids.get(operation, operation), answer.content)

    def ask_array(self, operation: str, **call: Any) -> np.ndarray:
        """The same as an array, whose numbers are finite."""
        answer = self.client.post(f"/v1/robots/{self.name}/{operation}", json=call, headers=NPY)
        assert answer.status_code == 200, answer.text[:1000]
        array: np.ndarray = np.load(BytesIO(answer.content))
        assert np.isfinite(array).all()
        return array

    def configurations(self, count: int) -> list[list[float]]:
        """At random within the limits; then zero where that is allowed, the middle, and both limits."""
        inside = self.random.uniform(self.lower, self.upper, (count, len(self.names)))
        special = [np.clip(0.0, self.lower, self.upper), (self.lower + self.upper) / 2, self.lower, self.upper]
        return [row.tolist() for row in (*inside, *special)]

    def rates(self, count: int, size: int | None = None) -> list[list[float]]:
        """Velocities, accelerations, torques or wrenches."""
        rows: list[list[float]] = self.random.normal(size=(count, size or len(self.names))).tolist()
        return rows


@pytest.fixture(params=ROBOTS)
def arm(client: TestClient, request: pytest.FixtureRequest) -> Arm:
    return Arm(client, request.param)


@pytest.mark.quick(2)
def test_poses_in_all_notations(arm: Arm) -> None:
    qs = arm.configurations(6)
    for notation in FORMATS:
        poses = arm.ask("fk", joint_positions=qs, pose_format=notation, frames="all")["poses"]
        again = arm.ask("ik", targets=poses[:2], seeds=qs[:2], pose_format=notation, respect_limits=False)
        assert [result["status"] for result in again["results"]] == ["solved", "solved"]
        array = arm.ask_array("fk", joint_positions=qs, pose_format=notation)
        if notation in {"matrix", "rotation"}:
            assert array.shape[1:] == (4, 4)
        if array.shape[1:] == (4, 4):
            assert list(matrix_flaws(array, notation)) == []
        if notation.startswith("quaternion"):
            assert np.abs(np.linalg.norm(array[:, 3:], axis=1) - 1).max() < TOLERANCE


@pytest.mark.quick(1)
def test_jacobians_forces_and_motions(arm: Arm) -> None:
    qs = arm.configurations(4)
    count = len(qs)
    for reference in ("local_world_aligned", "local", "world"):
        arm.ask("jacobian", joint_positions=qs, reference=reference, derivatives=["time_variation", "hessian"],
                joint_velocities=arm.rates(count))  # fmt: skip
        arm.ask("statics", joint_positions=qs, wrenches=arm.rates(count, 6), reference=reference, subspaces=True)
        arm.ask("velocity", joint_positions=qs, joint_velocities=arm.rates(count), joint_accelerations=arm.rates(count),
                reference=reference, singularity_reports=True)  # fmt: skip
    for inverse in ("exact", "pseudo_inverse", "damped")[len(arm.names) != 6 :]:
        damping = {"damping": "adaptive"} if inverse == "damped" else {}
        arm.ask("velocity", joint_positions=qs, twists=arm.rates(count, 6), inverse=inverse, **damping)
    arm.ask("statics", joint_positions=qs, torques=arm.rates(count), gravity=True)
    arm.ask("manipulability", joint_positions=qs, directions=[[0.0, 0.6, 0.8]], polytopes=True)
    arm.ask("singularities", joint_positions=qs[:3], nearest=True)
    arm.ask("dynamics", joint_positions=qs, joint_velocities=arm.rates(count), joint_accelerations=arm.rates(count))
    for operation in ("fk", "jacobian", "manipulability"):
        arm.ask_array(operation, joint_positions=qs)


@pytest.mark.quick(1)
def test_solutions_of_random_targets(arm: Arm) -> None:
    """Some are out of reach; what is nearest must be finite as well."""
    poses = arm.ask("fk", joint_positions=arm.configurations(3))["poses"]
    far = [
        {"position": (3 * arm.random.normal(size=3)).tolist(), "rotation_vector": arm.random.normal(size=3).tolist()}
    ]
    for how in ("one", "all"):
        answer = arm.ask("ik", targets=[*poses, *far], solutions=how, max_iterations=2000)
        assert len(answer["results"]) == len(poses) + 1
    for method in ("newton", "gradient_then_newton", "damped_least_squares"):
        arm.ask("ik", targets=[*poses, *far], method=method, trace=True, max_iterations=50)


@pytest.mark.slow
def test_motions_between_random_places(arm: Arm) -> None:
    start, middle, end = arm.configurations(3)[:3]
    tip = arm.ask("fk", joint_positions=[middle])["poses"][0]
    joint, line = {"type": "joint", "target": end}, {"type": "line", "target": tip}
    for law in ("cubic", "quintic", "trapezoidal", "jerk_limited", "time_optimal"):
        for segments in ([joint], [line], [joint, line]):
            call = {"start": start, "segments": segments, "law": law, "sample_period": 0.1}
            answer = arm.client.post(f"/v1/robots/{arm.name}/trajectory", json=call)
            assert answer.status_code == 200, answer.text[:1000]
            checked(arm.client, "trajectory", answer.content)
    spline = {"type": "spline", "waypoints": [middle, end, start]}
    arm.ask("trajectory", start=start, segments=[spline], sample_period=0.1)


@pytest.mark.quick(2)
def test_workspaces(arm: Arm) -> None:
    for kind in ("cloud", "grid"):
        job = f"{arm.name}-{kind}"
        call = {"kind": kind, "samples": 2000, "job_id": job}
        assert arm.client.post(f"/v1/robots/{arm.name}/workspace", json=call).status_code == 202
        wait_for(arm.client, f"/v1/jobs/{job}")
        checked(arm.client, "get_job_result", arm.client.get(f"/v1/jobs/{job}/result").content)
        array = np.load(BytesIO(arm.client.get(f"/v1/jobs/{job}/result", headers=NPY).content))
        assert len(array) > 0
        assert np.isfinite(array).all()


@pytest.mark.quick(1)
def test_conversions_of_real_chains(arm: Arm) -> None:
    for convention in ("standard", "modified"):
        answer = arm.client.get(f"/v1/robots/{arm.name}/dh", params={"convention": convention})
        checked(arm.client, "get_robot_dh", answer.content)
        table = answer.json()["dh"]
        call = {"dh": table, "joint_positions": arm.configurations(1)[:1], "symbolic": False}
        derived = arm.client.post("/v1/dh/derive", json=call)
        assert derived.status_code == 200, derived.text[:500]
        checked(arm.client, "derive_dh", derived.content)
