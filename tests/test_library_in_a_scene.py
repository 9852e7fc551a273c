"""`gelenk.Robot` in a scene: the verdicts and the numbers of the service, the bodies found in this process."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import gelenk
from gelenk import errors
from gelenk.cli.local import InProcess
from gelenk.client import Client

ARM = "ur5_dh"
Q = [[0.2, -1.3, 1.1, 0.4, 0.9, -0.5], [0.0, -1.5, 1.5, 0.1, 0.2, 0.3], [0.2, 0.3, 0.1, 0.4, 0.9, -0.5]]
TABLE = {"name": "table", "shape": {"type": "box", "size": [0.6, 1.6, 0.1]}, "pose": {"position": [-0.5, 0.0, -0.2]}}
SCENE: Any = {"objects": [TABLE]}


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    with Client(transport=InProcess()) as client:
        yield client


@pytest.fixture(scope="module")
def arm() -> gelenk.Robot:
    return gelenk.Robot.load(ARM)


def test_contacts_are_those_of_the_service(client: Client, arm: gelenk.Robot) -> None:
    found, answer = arm.collisions(Q, SCENE), client.collisions(ARM, joint_positions=Q, scene=SCENE, clearance=True)
    assert found.in_collision.tolist() == [one.in_collision for one in answer.results]
    assert {True, False} == set(found.in_collision.tolist())
    assert found.clearances.tolist() == [one.clearance for one in answer.results]
    pairs = [one.pairs[0] for one in answer.results if one.pairs]
    assert found.pairs == [(pair.a, pair.b) for pair in pairs]
    assert found.points.tolist() == [[pair.point_a, pair.point_b] for pair in pairs]
    assert found.certificate.samples == answer.certificate.samples == 3


def test_solutions_keep_clear_as_those_of_the_service(client: Client, arm: gelenk.Robot) -> None:
    targets = arm.fk(Q).poses.matrices()
    more: dict[str, Any] = {"scene": SCENE, "min_clearance": 0.01}
    found, answer = arm.ik(targets, **more), client.ik(ARM, targets=targets, **more)
    assert found.statuses == [one.status for one in answer.results]
    assert {"solved", "in_collision"} == set(found.statuses)
    qs = [one.joint_positions for result in answer.results for one in result.solutions]
    assert found.qs == pytest.approx(np.array(qs), abs=1e-9)
    assert arm.collisions(found.qs, SCENE).clearances.min() > 0.01
    every = arm.ik(targets[:1], solutions="all", **more)
    assert every.touching is not None
    assert every.touching.tolist() == (arm.collisions(every.qs, SCENE).clearances <= 0.01).tolist()


def test_a_motion_ends_before_a_contact_as_in_the_service(client: Client, arm: gelenk.Robot) -> None:
    segments: Any = [{"type": "joint", "target": Q[1]}, {"type": "joint", "target": Q[2]}]
    found = arm.trajectory(Q[0], segments, scene=SCENE)
    answer = client.trajectory(ARM, start=Q[0], segments=segments, scene=SCENE)
    assert found.failure is not None and answer.failure is not None
    assert (found.failure.reason, found.failure.detail) == (answer.failure.reason, answer.failure.detail)
    assert found.motion.duration == pytest.approx(answer.duration)
    assert found.audit.clearance is not None and answer.audit.clearance is not None
    assert found.audit.clearance.value == answer.audit.clearance.value


GRIPPER = """<robot name="gripper">
  <link name="base"/>
  <link name="hand"><collision><geometry><mesh filename="{mesh}"/></geometry></collision></link>
  <link name="finger"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="up" type="prismatic"><parent link="base"/><child link="hand"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="5" velocity="1" effort="100"/></joint>
  <joint name="grip" type="prismatic"><parent link="hand"/><child link="finger"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="5" velocity="1" effort="100"/></joint></robot>"""
POST = {
    "objects": [{"name": "post", "shape": {"type": "sphere", "radius": 0.5}, "pose": {"position": [0.0, 0.0, 2.0]}}]
}


@pytest.mark.parametrize("name", ["../meshes/cube.stl", "package://my_arm/meshes/cube.stl", "file://{here}/cube.stl"])
def test_meshes_and_fingers_of_a_file_count(tmp_path: Path, name: str) -> None:
    (tmp_path / "my_arm" / "urdf").mkdir(parents=True)
    meshes = tmp_path / "my_arm" / "meshes"
    meshes.mkdir()
    trimesh.creation.box([0.2, 0.2, 0.2]).export(meshes / "cube.stl")
    file = tmp_path / "my_arm" / "urdf" / "arm.urdf"
    file.write_text(GRIPPER.format(mesh=name.format(here=meshes)))
    arm = gelenk.Robot.from_urdf(file, "base", "hand")
    found = arm.collisions([[0.0], [1.5]], POST, {"grip": 3.0})
    assert found.clearances == pytest.approx([1.4, -0.1], abs=1e-6)
    assert found.pairs == [("hand", "post")] * 2
    assert arm.collisions([1.0], POST).clearances == pytest.approx([0.4], abs=1e-6)
    assert arm.collisions([2.0], POST, {"grip": 0.7}).pairs == [("hand", "post")]


def test_what_has_no_body_is_a_warning(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(GRIPPER.format(mesh="gone.stl"))
    for arm in (gelenk.Robot.from_urdf(file, "base", "hand"), gelenk.Robot.from_urdf(file.read_text(), "base", "hand")):
        with pytest.warns(UserWarning, match=r"without a body: .*gone\.stl"):
            assert arm.collisions([0.0], POST).pairs == [("finger", "post")]


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda arm: arm.ik(np.eye(4), scene="cell"), "scene 'cell' is not here: give its objects"),
        (lambda arm: arm.ik(np.eye(4), min_clearance=-1.0), "min_clearance.*greater"),
        (lambda arm: arm.ik(np.eye(4), objective="clearance"), "objective.*needs a `scene`"),
        (lambda arm: arm.collisions(Q, {"objects": [TABLE, TABLE]}), "scene.*both named 'table'"),
        (lambda arm: arm.collisions(Q, {"objects": [{"name": "a"}]}), r"scene\.objects\.0\.shape"),
        (lambda arm: arm.collisions(Q, other_joints={"thumb": 1.0}), "other_joints.*no independent joint"),
        (lambda arm: arm.trajectory(Q[0], [{"type": "joint", "target": Q[1]}], scene={"object": []}), "scene"),
    ],
)
def test_a_refusal_names_what_is_wrong(arm: gelenk.Robot, call: Any, words: str) -> None:
    with pytest.raises(errors.InvalidInput, match=words):
        call(arm)


@pytest.mark.slow
def test_meshes_of_the_catalogue_are_those_of_the_service(client: Client) -> None:
    q = [0.0, 0.6, 0.0, -2.0, 0.0, 2.6, 0.785]
    ends: Any = {"tip_frame": "panda_hand"}
    arm = gelenk.Robot.load("panda", **ends)
    fields: dict[str, Any] = {"scene": SCENE, "other_joints": {"panda_finger_joint1": 0.04}}
    (answer,) = client.collisions("panda", joint_positions=[q], clearance=True, **ends, **fields).results
    assert answer.clearance != arm.collisions(q, SCENE).clearances[0]
    assert arm.collisions(q, **fields).clearances.tolist() == [answer.clearance]
