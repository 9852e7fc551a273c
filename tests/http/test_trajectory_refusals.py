"""What a trajectory cannot be is refused at once, and the problem points at the field."""

import json
import time
from typing import Any

import pytest
from starlette.testclient import TestClient

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
BESIDE = [0.2, -0.6, 0.1, -2.2, 0.1, 1.7, 0.9]
JOINTS = [f"panda_joint{i}" for i in range(1, 8)]
# The tip of panda_link8 at READY, to four digits.
HERE = [0.3071, 0.0, 0.5902]
DOWN = [3.141592653589793, 0.0, 0.0]


def pose(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> dict[str, Any]:
    """Displaced from the start."""
    return {"position": [HERE[0] + x, HERE[1] + y, HERE[2] + z], "rpy": DOWN}


JOINT = {"type": "joint", "target": BESIDE}
LINE = {"type": "line", "target": pose(0.1)}
CIRCLE = {"type": "circle", "via": pose(0.05, 0.05), "target": pose(0.1)}
SPLINE = {"type": "spline", "waypoints": [BESIDE, READY]}
POSES = {"type": "spline", "waypoints": [pose(0.1), pose(0.2, 0.1)]}
BLENDED = {**LINE, "blend_radius": 0.02}


def refused(client: TestClient, status: int = 422, **changes: Any) -> dict[str, Any]:
    call = {"start": READY, "segments": [JOINT], "tip_frame": "panda_link8", **changes}
    used: list[float] = []
    while not used or (used[-1] >= 1.0 and len(used) < 3):  # other threads of the process may be busy at the time
        started = time.process_time()
        answer = client.post("/v1/robots/panda/trajectory", json=call)
        used.append(time.process_time() - started)
    assert min(used) < 1.0
    assert answer.status_code == status, answer.text[:500]
    assert answer.headers["content-type"] == "application/problem+json"
    return dict(answer.json())


def places(problem: dict[str, Any]) -> list[str]:
    return [problem["pointer"]] if "pointer" in problem else [error["pointer"] for error in problem["errors"]]


@pytest.mark.quick(19)
@pytest.mark.parametrize(
    ("changes", "pointer", "words"),
    [
        ({"start": None}, "#/start", "a list of one number per joint"),
        ({"start": READY[:6]}, "#/start", "'panda_joint1', 'panda_joint2'"),
        ({"start": dict.fromkeys(JOINTS[:6], 0.0)}, "#/start", "'panda_joint7'"),
        ({"start": {**dict.fromkeys(JOINTS, 0.0), "nose": 0.0}}, "#/start", "'nose'"),
        ({"start": [1e300] * 7}, "#/start", "finite"),
        ({"start": [3.0, *READY[1:]]}, "#/start", "'panda_joint1' at 3 is outside its limits [-2.8973, 2.8973]"),
        ({"segments": []}, "#/segments", "at least 1"),
        ({"segments": [JOINT] * 101}, "#/segments", "at most 100"),
        ({"segments": "line"}, "#/segments", "array"),
        ({"segments": [[]]}, "#/segments/0", "joint, line, circle or spline"),
        ({"segments": [{}]}, "#/segments/0", "joint, line, circle or spline"),
        ({"segments": [{"type": "dance"}]}, "#/segments/0", "joint, line, circle or spline"),
        ({"segments": [{"type": "joint"}]}, "#/segments/0/target", "required"),
        ({"segments": [JOINT, {**JOINT, "via": pose()}]}, "#/segments/1/via", "not permitted"),
        ({"segments": [JOINT, {**JOINT, "target": [0.0] * 8}]}, "#/segments/1/target", "8 numbers"),
        ({"segments": [{**JOINT, "target": [4.0] * 7}]}, "#/segments/0/target", "'panda_joint1' at 4 is outside"),
        ({"segments": [{**JOINT, "target": {"panda_joint1": 0.0}}]}, "#/segments/0/target", "'panda_joint2'"),
        ({"segments": [{**JOINT, "target": {"position": HERE}}]}, "#/segments/0/target", "exactly one orientation"),
        ({"segments": [{**JOINT, "target": {"position": HERE, "rpy": [0]}}]}, "#/segments/0/target/rpy", "at least 3"),
        ({"segments": [{**LINE, "target": BESIDE}]}, "#/segments/0/target", "object"),
        (
            {"segments": [{**LINE, "target": {"position": HERE, "quaternion_xyzw": [0, 0, 0, 2]}}]},
            "#/segments/0/target",
            "quaternion",
        ),
        ({"segments": [{**CIRCLE, "via": {"matrix": [[0.0] * 4] * 4}}]}, "#/segments/0/via", "last row"),
        ({"segments": [{"type": "circle", "target": pose()}]}, "#/segments/0/via", "required"),
        ({"segments": [LINE, {**CIRCLE, "via": pose(0.15), "target": pose(0.2)}]}, "#/segments/1/via", "one line"),
        ({"segments": [{**CIRCLE, "via": pose(0.1)}]}, "#/segments/0/via", "via and target are the same point"),
        ({"segments": [{**SPLINE, "waypoints": []}]}, "#/segments/0/waypoints", "at least 1"),
        ({"segments": [{**SPLINE, "waypoints": [BESIDE] * 1001}]}, "#/segments/0/waypoints", "at most 1000"),
        ({"segments": [{**SPLINE, "waypoints": [BESIDE] * 600}] * 2}, "#/segments", "1200 waypoints"),
        ({"segments": [{**SPLINE, "waypoints": [BESIDE, [0.0]]}]}, "#/segments/0/waypoints/1", "1 number where"),
        ({"segments": [{**SPLINE, "waypoints": [BESIDE, pose()]}]}, "#/segments/0/waypoints", "entry 1 is a pose"),
        (
            {"segments": [{**SPLINE, "waypoints": [BESIDE, [0.0] * 7]}]},
            "#/segments/0/waypoints/1",
            "'panda_joint4' at 0 is outside its limits",
        ),
        (
            {"segments": [{**SPLINE, "waypoints": [pose(0.1), {"position": HERE, "quaternion_xyzw": [0, 0, 0, 9]}]}]},
            "#/segments/0/waypoints/1",
            "quaternion",
        ),
        ({"segments": [{**SPLINE, "times": [1.0]}]}, "#/segments/0/times", "1 entry for 2 waypoints"),
        ({"segments": [{**SPLINE, "times": [2.0, 1.0]}]}, "#/segments/0/times", "entry 1, 1 s, is not after entry 0"),
        ({"segments": [{**SPLINE, "times": [1.0, 1.0]}]}, "#/segments/0/times", "is not after"),
        ({"segments": [{**SPLINE, "times": [0.0, 1.0]}]}, "#/segments/0/times/0", "greater than"),
        ({"segments": [{**SPLINE, "times": [1.0, 9.0], "duration": 9.0}]}, "#/segments/0/duration", "`times`"),
        ({"segments": [{**SPLINE, "boundary": "loose"}]}, "#/segments/0/boundary", "'clamped', 'natural'"),
        ({"segments": [{**SPLINE, "waypoint_options": [None, None]}]}, "#/segments/0/waypoint_options", "are of poses"),
        ({"segments": [{**POSES, "waypoint_options": [None]}]}, "#/segments/0/waypoint_options", "1 entry for 2"),
        (
            {"segments": [{**POSES, "waypoint_options": [None, {"limits": {"joint_torque": 9.0}}]}]},
            "#/segments/0/waypoint_options/1/limits/joint_torque",
            "along a whole segment",
        ),
        (
            {"segments": [{**POSES, "waypoint_options": [{"limits": {"joint_jerk": [1.0]}}, None]}]},
            "#/segments/0/waypoint_options/0/limits/joint_jerk",
            "panda_joint1",
        ),
        ({"segments": [BLENDED]}, "#/segments/0/blend_radius", "last segment"),
        ({"segments": [BLENDED, JOINT]}, "#/segments/0/blend_radius", "type joint"),
        ({"segments": [{**LINE, "blend_time": 0.1}, JOINT]}, "#/segments/0/blend_time", "type joint"),
        ({"segments": [{**LINE, "blend_acceleration": 1.0}]}, "#/segments/0/blend_acceleration", "last segment"),
        ({"segments": [{**BLENDED, "blend_time": 0.1}, LINE]}, "#/segments/0/blend_time", "`blend_radius`"),
        (
            {"segments": [{**LINE, "blend_time": 0.1, "blend_acceleration": 1.0}, LINE]},
            "#/segments/0/blend_time",
            "`blend_acceleration`",
        ),
        ({"segments": [{**LINE, "blend_radius": -0.1}, LINE]}, "#/segments/0/blend_radius", "greater than or equal"),
        (
            {"segments": [JOINT, {**LINE, "blend_radius": 0.5}, {**LINE, "target": pose(0.1, 0.2)}]},
            "#/segments/1/blend_radius",
            "0.5",
        ),
        ({"segments": [{**JOINT, "blend_radius": 0.1}, LINE]}, "#/segments/0/blend_radius", "not permitted"),
        ({"segments": [{**JOINT, "duration": 0.0}]}, "#/segments/0/duration", "greater than"),
        ({"segments": [{**JOINT, "duration": 1e-3}]}, "#/segments/0/duration", "s"),
        ({"segments": [{**JOINT, "law": "linear"}]}, "#/segments/0/law", "'trapezoidal'"),
        ({"segments": [{**JOINT, "velocity_scale": 1.5}]}, "#/segments/0/velocity_scale", "less than or equal to 1"),
        ({"law": "linear"}, "#/law", "'trapezoidal'"),
        ({"duration": 0.0}, "#/duration", "greater than"),
        ({"duration": -1.0}, "#/duration", "greater than"),
        ({"duration": 1e-3}, "#/duration", "s"),
        ({"duration": 9.0, "segments": [{**JOINT, "duration": 9.0}]}, "#/segments/0/duration", "`duration`"),
        ({"sample_period": 0.0}, "#/sample_period", "greater than"),
        ({"sample_period": -0.1}, "#/sample_period", "greater than"),
        ({"sample_period": 1e-6}, "#/sample_period", "at most 100000 are allowed, every 0.0000"),
        ({"sample_period": 1e-3, "duration": 1e4}, "#/sample_period", "makes 10000001 samples of 10000 s"),
        ({"path_tolerance": 0.0}, "#/path_tolerance", "greater than"),
        ({"orientation_tolerance": -1.0}, "#/orientation_tolerance", "greater than"),
        ({"velocity_scale": 0.0}, "#/velocity_scale", "greater than"),
        ({"velocity_scale": 1.01}, "#/velocity_scale", "less than or equal to 1"),
        ({"acceleration_scale": -0.5}, "#/acceleration_scale", "greater than"),
        ({"limits": {"joint_velocity": 0.0}}, "#/limits/joint_velocity", "greater than"),
        ({"limits": {"joint_velocity": [1.0] * 6}}, "#/limits/joint_velocity", "'panda_joint1', 'panda_joint2'"),
        ({"limits": {"joint_acceleration": [1.0] * 6 + [-1.0]}}, "#/limits/joint_acceleration/6", "greater than"),
        ({"limits": {"joint_jerk": {"nose": 1.0}}}, "#/limits/joint_jerk", "'nose'"),
        ({"limits": {"joint_jerk": {"panda_joint1": 1e300}}}, "#/limits/joint_jerk/panda_joint1", "less than"),
        ({"limits": {"tip_velocity": 0.0}}, "#/limits/tip_velocity", "greater than"),
        ({"limits": {"tip_speed": 1.0}}, "#/limits/tip_speed", "not permitted"),
        (
            {"segments": [JOINT, {**JOINT, "limits": {"joint_velocity": [1.0]}}]},
            "#/segments/1/limits/joint_velocity",
            "1 number where",
        ),
        ({"task": []}, "#/task", "at least 1"),
        ({"task": ["x", "x"]}, "#/task", "may appear only once"),
        ({"task": ["up"]}, "#/task/0", "'x', 'y'"),
        ({"near_singularity": "pray"}, "#/near_singularity", "'stop', 'damp'"),
        ({"min_singular_value": 0.0}, "#/min_singular_value", "greater than"),
        ({"pose_format": "euler"}, "#/pose_format", "'quaternion_xyzw'"),
        ({"speed": 1.0}, "#/speed", "not permitted"),
        ({"coefficients": 1}, "#/coefficients", "boolean"),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused(client: TestClient, changes: dict[str, Any], pointer: str, words: str) -> None:
    problem = refused(client, **changes)
    assert places(problem)[0] == pointer, problem
    assert words in problem["detail"] or words in str(problem.get("errors")), problem["detail"]


def test_an_unknown_frame_lists_those_there_are(client: TestClient) -> None:
    assert "panda_link8" in refused(client, 404, tip_frame="nose")["known"]


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e400"])
@pytest.mark.parametrize(
    "place", ["start", "target", "duration", "sample_period", "joint_velocity", "tip_velocity", "blend_radius"]
)
def test_what_is_no_number_is_refused(client: TestClient, number: str, place: str) -> None:
    call: dict[str, Any] = {
        "start": READY,
        "segments": [{**LINE, "blend_radius": 0.01}],
        "limits": {"joint_velocity": [1.0] * 7, "tip_velocity": 1.0},
        "duration": 1.0,
        "sample_period": 0.1,
    }
    mark = 123456.5
    match place:
        case "start":
            call["start"] = [mark, *READY[1:]]
        case "target":
            call["segments"] = [{**LINE, "target": {"position": [mark, 0.0, 0.0], "rpy": DOWN}}]
        case "blend_radius":
            call["segments"][0]["blend_radius"] = mark
        case "joint_velocity":
            call["limits"]["joint_velocity"] = [mark] * 7
        case "tip_velocity":
            call["limits"]["tip_velocity"] = mark
        case _:
            call[place] = mark
    body = json.dumps(call).replace(str(mark), number)
    headers = {"content-type": "application/json"}
    answer = client.post("/v1/robots/panda/trajectory", content=body, headers=headers)
    assert answer.status_code in {400, 422}, answer.text
    assert answer.headers["content-type"] == "application/problem+json"


def test_it_takes_json_alone_and_no_query(client: TestClient) -> None:
    path, body = "/v1/robots/panda/trajectory", {"start": READY, "segments": [JOINT]}
    answer = client.post(path, content=b"\x93NUMPY", headers={"content-type": "application/x-npy"})
    assert (answer.status_code, answer.json()["allowed"]) == (415, ["application/json"])
    assert client.post(f"{path}?law=cubic", json=body).json()["pointer"] == "#/query"
    assert client.get(path).status_code == 405


def test_other_operations_offer_no_csv(client: TestClient) -> None:
    answer = client.post("/v1/robots/panda/fk", json={"joint_positions": [READY]}, headers={"accept": "text/csv"})
    assert answer.headers["content-type"] == "application/json"
