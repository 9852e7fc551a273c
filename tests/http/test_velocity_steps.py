"""Worked solutions of operations on a robot: they agree with the answer beside them, in both languages."""

import re
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.course.velocity.writing import number
from tests.http.test_inverse import ik
from tests.http.test_velocity import NPY, PLANE, READY, refusal, velocity
from tests.oracles.written import with_points

BENT = [0.3, 0.8]
CALLS: list[tuple[str, str, dict[str, Any]]] = [
    ("fk", "planar_2r", {"joint_positions": [BENT, [0.1, 0.2]], "pose_format": "rpy"}),
    ("fk", "panda", {"joint_positions": [READY], "frames": ["panda_link4"]}),
    ("fk", "panda", {"joint_positions": [[]], "base_frame": "panda_hand", "tip_frame": "panda_link8"}),
    ("singularities", "planar_2r", {"joint_positions": [[0.3, 0.0], BENT], "task": PLANE}),
    ("singularities", "panda", {"joint_positions": [READY], "characteristic_length": 0.5, "path": True}),
    ("dynamics", "planar_2r", {"joint_positions": [BENT], "torques": [[1.0, 0.1]]}),
    ("dynamics", "panda", {"joint_positions": [READY], "joint_accelerations": [[0.1] * 7]}),
    ("jacobian", "planar_2r", {"joint_positions": [BENT, [0.1, 0.2]]}),
    (
        "jacobian",
        "panda",
        {
            "joint_positions": [READY],
            "representation": "rpy",
            "derivatives": ["time_variation"],
            "joint_velocities": [[0.1] * 7],
            "tip_frame": "panda_hand_tcp",
        },
    ),
    ("jacobian", "scara", {"joint_positions": [[0.4, 0.8, 0.12, -0.3]], "reference": "world"}),
    ("velocity", "scara", {"joint_positions": [[0.4, 0.8, 0.12, -0.3]], "twists": [[0.1, 0, 0, 0, 0, 0.2]]}),
    ("statics", "scara", {"joint_positions": [[0.4, 0.8, 0.12, -0.3]], "gravity": True}),
    ("statics", "panda", {"joint_positions": [READY], "torques": [[1.0] * 7], "reference": "local"}),
    ("statics", "planar_2r", {"joint_positions": [[0.3, 0.0]], "wrenches": [[10.0, -5.0]], "task": PLANE}),
    ("manipulability", "ur5", {"joint_positions": [[0.0] * 6], "characteristic_length": 0.5}),
    ("manipulability", "planar_2r", {"joint_positions": [BENT], "directions": [[1.0, 0.0, 0.0]]}),
    *(
        ("velocity", "panda", {"joint_positions": [READY], "twists": [[0.1, 0.0, -0.05, 0.0, 0.0, 0.2]], **options})
        for options in (
            {"inverse": "damped", "damping": "adaptive", "null_space": {"objective": "limits"}},
            {"inverse": "damped", "damping": 0.01, "weights": [1, 2, 3, 4, 5, 6, 7], "characteristic_length": 0.3},
            {"null_space": {"objective": "posture", "posture": [0.0] * 7}, "reference": "local"},
            {"null_space": {"objective": "clearance"}, "min_clearance": 0.0},
            {"null_space": {"joint_velocities": [[0.1] * 7]}, "task": ["x", "y", "rz"], "singularity_reports": True},
        )
    ),
]


def post(client: TestClient, operation: str, robot: str, **call: Any) -> dict[str, Any]:
    answer = client.post(f"/v1/robots/{robot}/{operation}", json=call)
    assert answer.status_code == 200, answer.text
    return dict(answer.json())


@pytest.mark.quick(5)
@pytest.mark.parametrize(("operation", "robot", "call"), CALLS)
def test_steps_come_beside_the_same_numbers_in_the_language_asked_for(
    client: TestClient, operation: str, robot: str, call: dict[str, Any]
) -> None:
    plain = post(client, operation, robot, **call)
    english, german = (
        post(client, operation, robot, **call, steps=True, language=language) for language in ("en", "de")
    )
    worked, translated = english.pop("steps"), german.pop("steps")
    assert plain.pop("steps", None) is None
    for answer in (english, plain):
        for result in answer.get("results", []):
            result.pop("derivation", None)
    assert english == plain
    assert len(worked) == len(translated) == len(call["joint_positions"])
    for one, other in zip(worked, translated, strict=True):
        assert [formulas(step) for step in one] == [formulas(step) for step in other]


def formulas(step: dict[str, Any]) -> list[str]:
    """The formulas of a step, without their words, and with the decimal marks of English."""
    return [re.sub(r"\\text\{[^}]*\}", "", with_points(line)) for line in step["latex"]]


def test_the_last_step_of_an_inversion_is_the_answer(client: TestClient) -> None:
    """The steps invert by the lecture's formulas, the answer by singular values."""
    for robot, call in [(robot, call) for _, robot, call in CALLS if "twists" in call]:
        answer = velocity(client, robot, **call, steps=True)
        for found, result, steps in zip(answer["joint_velocities"], answer["results"], answer["steps"], strict=True):
            shown = re.findall(r"\\begin{bmatrix} ([^&]*?) \\end{bmatrix}", steps[-1]["latex"][0])[-1].split(r" \\ ")
            assert [_value(text) for text in shown] == pytest.approx(found, rel=1e-5, abs=1e-12)
            derived = result["derivation"]
            J, inverse = np.array(derived["jacobian"]), np.array(derived["pseudo_inverse"])
            assert J @ inverse @ J == pytest.approx(J, abs=1e-9)
            assert max(derived["moore_penrose"]) < 1e-9


def _value(text: str) -> float:
    mantissa, _, power = text.partition(r" \cdot 10^{")
    return float(mantissa) * 10.0 ** int(power.rstrip("}") or 0)


def test_forward_steps_show_what_is_sent(client: TestClient) -> None:
    rates = {"joint_velocities": [[0.5, -0.4]], "joint_accelerations": [[0.2, 0.9]], "joint_jerks": [[-0.3, 0.6]]}
    for reference in ("local_world_aligned", "local", "world"):
        answer = velocity(client, "planar_2r", joint_positions=[BENT], **rates, reference=reference, steps=True)
        steps = answer["steps"][0]
        assert [step["title"] for step in steps[:3]] == ["Twist", "Acceleration", "Jerk"]
        for k, name in enumerate(("twists", "accelerations", "jerks")):
            line = steps[-1]["latex"][k] if reference != "local_world_aligned" else steps[k]["latex"][-1]
            assert all(number(value) in line for value in answer[name][0] if value)


@pytest.mark.parametrize("reference", ["local_world_aligned", "local"])
def test_known_rates_go_to_the_other_side(client: TestClient, reference: str) -> None:
    call: dict[str, Any] = {"joint_positions": [BENT], "joint_velocities": [[0.5, -0.4]], "reference": reference}
    answer = velocity(client, "planar_2r", **call, tip_accelerations=[[0.0, 0.0]], task=PLANE, steps=True)
    found = answer["joint_accelerations"][0]
    if reference == "local_world_aligned":
        assert found == pytest.approx([0.252561704898, -0.760133786401], abs=1e-11)
    assert all(number(value) in answer["steps"][0][-1]["latex"][0] for value in found)


def test_a_singular_matrix_ends_the_solution(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [[0.3, 0.0]], "twists": [[0.1, 0.3]], "task": PLANE}
    answer = velocity(client, "planar_2r", **call, inverse="exact", steps=True)
    assert answer["joint_velocities"] == [None]
    assert [step["title"] for step in answer["steps"][0]] == ["The equation", "Which case"]


def test_items_27_and_28_as_a_trace(client: TestClient) -> None:
    """Newton's first errors, and the gradient's with the bound on its step."""
    target: dict[str, Any] = {"targets": [{"position": [0.9, 0.8, 0.0], "rpy": [0, 0, 0]}], "task": PLANE}
    call = {**target, "seeds": [[0.3, 1.2]], "trace": True, "steps": True, "respect_limits": False}
    (newton,) = ik(client, "planar_2r", **call, method="newton")["results"]
    (gradient,) = ik(client, "planar_2r", **call, method="gradient", step_size=0.3)["results"]
    for result, errors in (
        (newton, [2.203170127e-1, 3.397687680e-2, 4.742096728e-4, 9.258881658e-8]),
        (gradient, [0.2203170127, 0.2048157232, 0.1924963978, 0.1809979782]),
    ):
        table = result["steps"][-1]["latex"][0]
        assert all(number(error) in table for error in errors)
        assert [at["error"] for at in result["trace"][:4]] == pytest.approx(errors, rel=1e-8)
    titles = [step["title"] for step in newton["steps"]]
    assert titles[-5:] == ["Newton's method", "Iteration 1", "Iteration 2", "Iteration 3", "Table of the iteration"]
    rule = next(step for step in gradient["steps"] if step["title"] == "Gradient method")
    assert _value(rule["latex"][-1].split(" = ")[-1]) == pytest.approx(1.218183589694, rel=1e-5)
    assert gradient["steps"][-1]["latex"][0].count(r"\\") == 41


def test_a_trace_shows_free_joints_only(client: TestClient) -> None:
    call: dict[str, Any] = {"targets": [{"position": [0.4, 0.1, 0.5], "rpy": [3.1, 0.0, 0.0]}], "trace": True}
    (result,) = ik(client, "panda", **call, fixed_joints={"panda_joint7": 0.6}, steps=True)["results"]
    assert "q_{6}" in result["steps"][-1]["latex"][0]
    assert "q_{7}" not in result["steps"][-1]["latex"][0]


@pytest.mark.parametrize(
    "operation", ["fk", "jacobian", "velocity", "singularities", "statics", "dynamics", "manipulability"]
)
def test_at_most_a_hundred_solutions_are_worked_out(client: TestClient, operation: str) -> None:
    call: dict[str, Any] = {"joint_positions": [BENT] * 101, "steps": True}
    call |= {"joint_velocities": [BENT] * 101} if operation == "velocity" else {}
    call |= {"gravity": True} if operation == "statics" else {}
    answer = client.post(f"/v1/robots/planar_2r/{operation}", json=call)
    assert answer.status_code == 413
    assert "configurations with `steps`" in answer.json()["detail"]
    assert client.post(f"/v1/robots/planar_2r/{operation}", json={**call, "steps": False}).status_code == 200


def test_a_table_holds_no_steps(client: TestClient) -> None:
    for operation, robot, call in CALLS:
        answer = client.post(f"/v1/robots/{robot}/{operation}", json={**call, "steps": True}, headers={"accept": NPY})
        assert answer.status_code == 422


def test_numbers_of_a_twist_are_in_the_order_of_the_task(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [BENT]}
    for task, twist in ((PLANE, [0.1, 0.3]), (PLANE[::-1], [0.3, 0.1])):
        (found,) = velocity(client, "planar_2r", **call, task=task, twists=[twist])["joint_velocities"]
        assert found == pytest.approx([0.435936662598, -0.802739372970], abs=1e-11)


def test_refusals_of_an_arm_with_few_joints_name_the_task(client: TestClient) -> None:
    call: dict[str, Any] = {"joint_positions": [BENT], "twists": [[0.1, 0.3]]}
    assert "as many as there are directions in `task`" in refusal(client, call, "planar_2r")["detail"]
    whole = velocity(client, "planar_2r", **{**call, "twists": [[0.1, 0.3, 0.0, 0.0, 0.0, 0.0]]})
    assert "2 joints cannot serve 6 directions: name those that count in `task`" in whole["results"][0]["reason"]
    answer = client.post("/v1/robots/planar_2r/statics", json={"joint_positions": [BENT], "wrenches": [[1.0, 2.0]]})
    assert "`task` can name fewer" in answer.json()["detail"]
