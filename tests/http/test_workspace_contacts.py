"""The workspace of a robot among objects over HTTP, against `collisions` and `fk` of the same configurations."""

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.workspace import WorkspaceAnswer
from gelenk.jobs.workspace_picture import captions
from tests.http.test_velocity import npy
from tests.http.test_workspace import NPY, array, finished

WALL = {"name": "wall", "shape": {"type": "half_space", "normal": [1.0, 0.0, 0.0], "offset": -0.2}}
CELL: dict[str, Any] = {"scene": {"objects": [WALL]}, "min_clearance": 0.02}
COUNT = 2000


def configurations(summary: dict[str, Any]) -> Any:
    lower, upper = np.array(summary["joint_ranges"]).T
    return lower + np.random.default_rng(0).random((COUNT, len(lower))) * (upper - lower)


def test_the_samples_that_count_are_those_without_contact(client: TestClient) -> None:
    result = finished(client, {"samples": COUNT, **CELL})
    summary, points = client.get(result).json(), array(client, result)
    WorkspaceAnswer.model_validate(summary)
    qs = configurations(summary)
    wider = {**WALL, "clearance": 0.02}
    call = {"joint_positions": qs.tolist(), "scene": {"objects": [wider]}, "clearance": True}
    results = client.post("/v1/robots/panda/collisions", json=call).json()["results"]
    # A `min_clearance` holds of the robot and itself too.
    free = np.array([not one["in_collision"] for one in results]) & _apart_from_itself(client, qs)
    poses = client.post("/v1/robots/panda/fk", content=npy(qs[free]), headers={"content-type": NPY, "accept": NPY})
    assert 100 < free.sum() < COUNT - 100
    assert summary["samples_free"] == summary["samples_counted"] == len(points) == free.sum()
    np.testing.assert_allclose(points[:, :3], np.load(BytesIO(poses.content))[:, :3], atol=1e-9)
    assert summary["contact_certificate"]["samples"] == 16
    assert f"{free.sum():,} of 2,000 samples without contact" in list(captions(summary))


def _apart_from_itself(client: TestClient, qs: Any) -> Any:
    call = {"joint_positions": qs.tolist(), "clearance": True}
    results = client.post("/v1/robots/panda/collisions", json=call).json()["results"]
    return np.array([one["clearance"] > 0.02 for one in results])


@pytest.mark.slow
def test_a_stored_scene_is_that_of_when_the_job_was_sent(client: TestClient) -> None:
    client.post("/v1/scenes", json={"name": "walled", "objects": [WALL]}).raise_for_status()
    call: dict[str, Any] = {"kind": "grid", "samples": COUNT, "voxel_size": 0.2}
    result = finished(client, {**call, "scene": "walled"})
    named = client.get(result).json()
    inline = client.get(finished(client, {**call, "scene": CELL["scene"]})).json()
    assert named == inline
    assert array(client, result)[:, 3].sum() == named["samples_free"] < COUNT
    plain = client.get(finished(client, call)).json()
    assert {"samples_free", "contact_certificate"}.isdisjoint(plain)
    assert plain["samples_counted"] == COUNT
    plane = {"origin": [0.0, 0.0, 0.5], "normal": [0.0, 0.0, 1.0], "thickness": 0.3}
    sliced = client.get(finished(client, {**call, "scene": CELL["scene"], "plane": plane})).json()
    assert sliced["samples_counted"] < sliced["samples_free"] == named["samples_free"]


@pytest.mark.slow
def test_orientations_reached_in_contact_do_not_count(client: TestClient) -> None:
    call: dict[str, Any] = {"kind": "dexterity", "samples": 500, "orientations": 8, "voxel_size": 0.3}
    post = {"name": "post", "shape": {"type": "sphere", "radius": 0.2}, "pose": {"position": [0.5, 0.5, 0.0]}}
    walled, plain = (
        {tuple(row[:3].round(6)): row[5] for row in array(client, finished(client, {**call, **extra}, "planar_3r"))}
        for extra in ({"scene": {"objects": [post]}}, {})
    )
    assert all(walled[place] <= plain[place] for place in walled)
    assert sum(walled[place] < plain[place] for place in walled) > 5
    assert max(walled.values()) > 0.5


@pytest.mark.parametrize(
    ("call", "place"),
    [
        ({"min_clearance": -0.1}, "#/min_clearance"),
        ({"scene": "nowhere"}, "#/scene"),
        ({"scene": {"objects": [{**WALL, "attached_to": "nose"}]}}, "#/scene/objects/0/attached_to"),
    ],
)
def test_a_cell_that_is_none_is_refused(client: TestClient, call: dict[str, Any], place: str) -> None:
    answer = client.post("/v1/robots/panda/workspace", json=call)
    problem = answer.json()
    assert place in [problem.get("pointer"), *(error["pointer"] for error in problem.get("errors", []))], problem
