"""Every operation of the API is one of the client, with arrays and jobs; `tests/cli` compares what they answer."""

import asyncio
import inspect
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, assert_type

import numpy as np
import pytest

from gelenk.client import AsyncClient, Client
from gelenk.client.arrays import ArrayOperations, Reached
from gelenk.client.call import Call, Sent
from gelenk.client.operations import Operations
from gelenk.contract.fk import ForwardAnswer
from gelenk.contract.jobs import JobInfo
from gelenk.contract.pose import Pose
from gelenk.errors import InvalidArchive, InvalidField
from gelenk.robot.arrays import Array
from tests.corpus import zips
from tests.robots import robot, samples
from tests.test_serve import get

IN_OTHER_WORDS = {"watch_job", "get_job_result"}
"""What `watch` does, and a method for each kind of job."""
OF_ITS_OWN = {
    "add_archive",
    "replace_archive",
    "add_scene_files",
    "replace_scene_files",
    "dh_file",
    "workspace_result",
    "ik_result",
    "trajectories_result",
    "trajectory_result",
    "picture",
}
"""Methods that share an operation with another one."""
NAMES = {
    "list_robots": "robots",
    "get_robot": "robot",
    "get_robot_urdf": "urdf",
    "get_robot_mesh": "mesh",
    "get_robot_mjcf": "mjcf",
    "get_robot_screws": "screws",
    "get_robot_dh": "dh_table",
    "get_collision_bodies": "collision_bodies",
    "get_collision_pairs": "collision_pairs",
    "forward_kinematics": "fk",
    "inverse_kinematics": "ik",
    "list_scenes": "scenes",
    "get_scene": "scene",
    "get_scene_file": "scene_file",
    "get_job": "job",
    "list_exercises": "exercises",
    "list_pictures": "course_pictures",
    "get_picture": "course_picture",
    "get_dh_picture": "dh_parameters",
    "count_mobility": "mobility",
    "convert_orientation": "orientation",
    "cubic_spline": "spline",
    "solve_triangle": "triangle",
}
"""Methods by the operation that they ask, where the two have other names."""


@pytest.fixture(scope="module")
def schema(url: str) -> Any:
    return get(f"{url}/openapi.json")[1]


def operations(schema: Any) -> Iterator[tuple[str, str, Any]]:
    for path, methods in schema["paths"].items():
        for method, operation in methods.items():
            yield path, method, operation


def test_every_operation_is_a_method(schema: Any) -> None:
    offered = {name for name, value in vars(Operations).items() if isinstance(value, Sent)}
    asked = {operation["operationId"] for _, _, operation in operations(schema)} - IN_OTHER_WORDS
    assert {NAMES.get(name, name) for name in asked} == offered - OF_ITS_OWN


def test_every_array_is_taken_that_the_api_takes(schema: Any) -> None:
    npy = {
        NAMES.get(operation["operationId"], operation["operationId"])
        for _, method, operation in operations(schema)
        if method == "post" and "application/x-npy" in operation["responses"].get("200", {}).get("content", {})
    }
    assert npy == {name for name, value in vars(ArrayOperations).items() if isinstance(value, Sent)} - {"job_result"}


def test_what_is_told_at_a_prompt(gelenk: Client) -> None:
    parameters = inspect.signature(gelenk.ik).parameters
    assert next(iter(parameters)) == "robot"
    assert {"targets", "seeds", "method", "position_tolerance"} <= set(parameters)
    assert "batch of targets" in (gelenk.ik.__doc__ or "")


def test_arrays_lists_and_models_are_one(gelenk: Client) -> None:
    machine = robot("panda")
    chain = machine.chain(machine.description.root, "panda_link8")
    qs = samples(chain, 5)
    by_list = gelenk.fk("panda", joint_positions=qs.tolist(), tip_frame="panda_link8", pose_format="matrix")
    assert_type(by_list, ForwardAnswer)
    by_array = gelenk.arrays.fk("panda", qs, tip_frame="panda_link8", pose_format="matrix")
    assert_type(by_array, Array)
    assert np.array_equal(by_array, np.array([pose.matrix for pose in by_list.poses]))
    assert gelenk.fk("panda", joint_positions=qs, tip_frame="panda_link8", pose_format="matrix") == by_list
    targets = [Pose(matrix=T.tolist()) for T in by_array]
    answer = gelenk.ik("panda", targets=targets, tip_frame="panda_link8")
    found = gelenk.arrays.ik("panda", by_array, tip_frame="panda_link8")
    assert_type(found, Reached)
    assert found.unsolved == 0
    one_by_one = [result.solutions[0].joint_positions for result in answer.results]
    np.testing.assert_allclose(found.joint_positions, one_by_one, atol=1e-9)


def test_options_of_a_batch_reach_the_service(gelenk: Client) -> None:
    far = np.array([[5.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], [0.4, 0.1, 0.5, 1.0, 0.0, 0.0, 0.0]])
    found = gelenk.arrays.ik("panda", far, tip_frame="panda_link8", task=["x", "y", "z"], respect_limits=False)
    assert found.unsolved_rows == (0,)
    q = np.array([[0.2, -0.7, 0.1, -2.3, 0.3, 1.5, 0.7]])
    local = gelenk.arrays.jacobian("panda", q, tip_frame="panda_link8", reference="local")
    answer = gelenk.jacobian("panda", joint_positions=q.tolist(), tip_frame="panda_link8", reference="local")
    assert np.array_equal(local, answer.jacobians)


def test_a_motion_as_samples(gelenk: Client) -> None:
    start, end = [0.0, -0.5, 0.0, -2.0, 0.0, 1.5, 0.8], [0.3, -0.4, 0.1, -1.9, 0.2, 1.4, 0.7]
    motion: dict[str, Any] = {"start": start, "segments": [{"type": "joint", "target": end}]}
    answer = gelenk.trajectory("panda", **motion)
    sampled = gelenk.arrays.trajectory("panda", **motion)
    assert sampled.failure is None
    assert sampled.completed_fraction == 1.0
    assert sampled.duration == answer.duration
    assert np.array_equal(sampled.samples[:, 0], answer.times)


def test_a_robot_comes_and_goes(gelenk: Client) -> None:
    table = gelenk.dh_table("planar_2r")
    added = gelenk.add_robot(name="twin", dh=table.dh, description="The same once more")
    assert added.description == "The same once more"
    assert "twin" in {one.name for one in gelenk.robots().robots}
    replaced = gelenk.replace_robot("twin", urdf=gelenk.urdf("planar_3r"))
    assert len(replaced.joint_names) == 3
    assert gelenk.robot("twin") == replaced
    gelenk.remove_robot("twin")
    assert "twin" not in {one.name for one in gelenk.robots().robots}


def test_a_robot_with_its_meshes(gelenk: Client, tmp_path: Path) -> None:
    archive = tmp_path / "robot.zip"
    archive.write_bytes(zips.good())
    info = gelenk.add_archive("packed", archive)
    assert info.meshes
    assert gelenk.replace_archive("packed", archive.read_bytes(), description="Again").description == "Again"
    two = zips.zipped({"left.urdf": zips.URDF, "right.urdf": zips.URDF})
    with pytest.raises(InvalidArchive) as several:
        gelenk.replace_archive("packed", two)
    assert several.value.files == ("left.urdf", "right.urdf")
    assert gelenk.replace_archive("packed", two, file="right.urdf").name == "packed"
    assert gelenk.add_archive("packed_too", two, file="left.urdf").name == "packed_too"
    for name in ("packed", "packed_too"):
        gelenk.remove_robot(name)


@pytest.mark.slow
def test_a_job_tells_how_far_it_is(gelenk: Client) -> None:
    seen: list[float] = []
    job = gelenk.workspace("panda", samples=200_000, tip_frame="panda_link8")
    assert_type(job, JobInfo)
    done = gelenk.wait(job.id, lambda info: seen.append(info.progress))
    assert done.state == "succeeded"
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    answer = gelenk.workspace_result(job.id)
    assert answer.samples == 200_000
    assert gelenk.arrays.job_result(job.id).shape == tuple(answer.array.shape)
    assert gelenk.picture(f"v1/jobs/{job.id}/result", "svg").startswith(b"<?xml")
    assert gelenk.cancel_job(job.id, finished="remove").state == "succeeded"


def test_many_calls_at_once(url: str) -> None:
    async def ask() -> tuple[list[ForwardAnswer], Array, JobInfo, list[float]]:
        async with AsyncClient(url) as gelenk:
            calls = [gelenk.fk("planar_2r", joint_positions=[[0.1 * i, 0.2]]) for i in range(20)]
            answers = await asyncio.gather(*calls)
            array = await gelenk.arrays.fk("planar_2r", np.array([[0.0, 0.2]]))
            job = await gelenk.workspace("planar_2r", samples=10_000)
            seen: list[float] = []
            done = await gelenk.wait(job.id, lambda info: seen.append(info.progress))
            await gelenk.cancel_job(job.id, finished="remove")
            return answers, array, done, seen

    answers, array, done, seen = asyncio.run(ask())
    first = answers[0].poses[0]
    assert first.position is not None
    assert array[0, :3].tolist() == list(first.position)
    assert len({answer.poses[0].model_dump_json() for answer in answers}) == 20
    assert done.state == "succeeded"
    assert seen[-1] == 1.0


def test_a_call_is_data() -> None:
    call = vars(Operations)["fk"].describe("two/links", joint_positions=[[0.0, 0.0]])
    assert isinstance(call, Call)
    assert (call.method, call.path) == ("POST", "v1/robots/two%2Flinks/fk")


def test_what_is_wrong_at_sight_is_not_sent() -> None:
    """Nobody listens at this address, and nobody is asked."""
    with Client("http://127.0.0.1:9") as nobody:
        loose: Any = nobody
        with pytest.raises(TypeError, match="fk has no argument 'pose_fromat': did you mean 'pose_format'"):
            loose.fk("ur5", joint_positions=[[0.0] * 6], pose_fromat="rpy")
        with pytest.raises(TypeError, match="health has no argument 'loud'"):
            loose.health(loud=True)
        with pytest.raises(InvalidField, match=r"joint_positions.*at 0/1 is not finite"):
            nobody.fk("ur5", joint_positions=[[0.0, math.nan, 0.0, 0.0, 0.0, 0.0]])
        target: Any = {"position": [0.4, 0.0, math.inf], "rpy": [0.0, 0.0, 0.0]}
        with pytest.raises(InvalidField, match=r"targets.*at 0/position/2 is not finite"):
            nobody.ik("ur5", targets=[target])
        with pytest.raises(InvalidField, match=r"position_tolerance.*the number is not finite"):
            nobody.ik("ur5", targets=[], position_tolerance=math.nan)
