"""A target is a position alone where the task leaves the orientation out, and nowhere else."""

from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.http.test_inverse import ik, refused
from tests.http.test_kinematics import fk

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
HERE = [0.4, 0.1, 0.5]
XYZ = ["x", "y", "z"]


@pytest.mark.parametrize(
    ("robot", "task", "position", "options"),
    [
        ("panda", XYZ, HERE, {}),
        ("panda", XYZ, HERE, {"method": "newton", "seeds": [READY]}),
        ("planar_2r", ["x", "y"], [1.2, 0.6, 9.0], {"solutions": "all"}),
    ],
)
def test_inverse_kinematics_takes_positions(
    client: TestClient, robot: str, task: list[str], position: list[float], options: dict[str, Any]
) -> None:
    answer = ik(client, robot, targets=[{"position": position}], task=task, **options)
    found = [entry["joint_positions"] for entry in answer["results"][0]["solutions"]]
    assert found
    for pose in fk(client, robot, joint_positions=found)["poses"]:
        assert pose["position"][: len(task)] == pytest.approx(position[: len(task)], abs=2e-6)


@pytest.mark.parametrize("task", [None, ["x", "y", "z", "rx", "ry"]])
def test_where_an_orientation_counts_its_absence_is_told_with_the_task(
    client: TestClient, task: list[str] | None
) -> None:
    problem = refused(client, targets=[{"position": HERE, "rpy": [0, 0, 0]}, {"position": HERE}], task=task)
    assert problem["pointer"] == "#/targets/1"
    assert "none is given" in problem["detail"]
    assert "`task` has none of rx, ry, rz" in problem["detail"]


def segments(**orientation: Any) -> dict[str, list[dict[str, Any]]]:
    def at(x: float, y: float) -> dict[str, Any]:
        return {"position": [START[0] + x, START[1] + y, START[2]], **orientation}

    line = {"type": "line", "target": at(0.0, 0.1)}
    return {
        "line": [line],
        "blended": [{"type": "line", "target": at(0.1, 0.1), "blend_radius": 0.02}, line],
        "circle": [{"type": "circle", "via": at(0.05, 0.05), "target": at(0.1, 0.0)}],
        "spline": [{"type": "spline", "waypoints": [at(0.05, 0.05), at(0.1, 0.0)]}],
        "joint": [{"type": "joint", "target": at(0.0, 0.1)}],
    }


START = [0.3071, 0.0, 0.5902]
"""About where the tip is at `READY`."""


@pytest.mark.parametrize("kind", segments())
def test_a_motion_through_positions_keeps_the_orientation_of_its_start(client: TestClient, kind: str) -> None:
    """The path is the same as with that orientation written out: the task leaves it free either way."""
    common = {"start": READY, "task": XYZ, "tip_frame": "panda_link8", "sample_period": 0.1}
    (pose,) = fk(client, joint_positions=[READY], tip_frame="panda_link8")["poses"]
    given = {"quaternion_xyzw": pose["quaternion_xyzw"]}
    alone, written = (
        client.post("/v1/robots/panda/trajectory", json={**common, "segments": made[kind]}).json()
        for made in (segments(), segments(**given))
    )
    assert alone["completed_fraction"] == 1.0, alone["failure"]
    assert alone["duration"] == pytest.approx(written["duration"], abs=1e-9)
    ends = [answer["tip_poses"][-1]["position"] for answer in (alone, written)]
    assert ends[0] == pytest.approx(ends[1], abs=2e-4)


def test_a_motion_whose_orientation_counts_needs_one(client: TestClient) -> None:
    made = segments()
    for kind in ("line", "circle", "spline", "joint"):
        answer = client.post("/v1/robots/panda/trajectory", json={"start": READY, "segments": made[kind]}).json()
        assert answer["status"] == 422, kind
        assert answer["pointer"].startswith("#/segments/0/"), kind
        assert "`task` has none of rx, ry, rz" in answer["detail"], kind


def test_a_table_cannot_leave_it_out(client: TestClient) -> None:
    joint = {"name": "a", "type": "revolute", "a": 1, "alpha": 0, "d": 0, "theta": 0}
    table = {"convention": "standard", "joints": [joint]}
    answer = client.post("/v1/dh/derive", json={"dh": {**table, "tool": {"position": HERE}}}).json()
    assert (answer["status"], answer["pointer"]) == (422, "#/dh/tool")
