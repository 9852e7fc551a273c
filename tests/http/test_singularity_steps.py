"""Worked solutions of singularities hold for Pinocchio's Jacobian, and their determinant is that of the task."""

from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.kinematics.judge.judge import pinocchio_jacobian
from tests.http.test_velocity_steps import post
from tests.oracles.written import matrix, value, vector
from tests.robots import robot

WRIST = [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]
SOLVED = "Singular configurations"


def worked(client: TestClient, name: str, q: list[float], **call: Any) -> dict[str, dict[str, Any]]:
    """The steps at a configuration, by their titles."""
    (steps,) = post(client, "singularities", name, joint_positions=[q], steps=True, **call)["steps"]
    return {step["title"]: step for step in steps}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "q", "task"),
    [
        ("ur5_dh", WRIST, ["x", "y", "z", "rx", "ry", "rz"]),
        ("planar_2r", [0.3, 0.0], ["y", "x"]),
        ("scara", [0.4, 0.0, 0.12, -0.3], ["x", "y", "z", "rx", "ry", "rz"]),
        ("panda", [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785], ["x", "y", "z"]),
    ],
)
def test_numbers_are_those_of_the_jacobian_of_pinocchio(
    client: TestClient, name: str, q: list[float], task: list[str]
) -> None:
    found = robot(name)
    rows = [["x", "y", "z", "rx", "ry", "rz"].index(one) for one in task]
    J = pinocchio_jacobian(found, found.chain(None, None), np.array(q), "local_world_aligned")[rows]
    steps = worked(client, name, q, task=task)
    assert matrix(steps["The Jacobian"]["latex"][0]) == pytest.approx(J, abs=1e-9)
    sigmas = np.linalg.svd(J, compute_uv=False)
    assert vector(steps["Rank"]["latex"][0]) == pytest.approx(sigmas, abs=1e-9)
    product = steps["Determinant at this configuration"]["latex"][-1].split(" = ")[-1]
    assert value(product) == pytest.approx(np.prod(sigmas), abs=1e-9)
    for line in steps.get("Lost directions", {"latex": [""]})["latex"][1:]:
        u = vector(line.split(r",\quad")[0])
        assert u @ u == pytest.approx(1.0)
        assert u @ J == pytest.approx(np.zeros(J.shape[1]), abs=1e-9)
    for line in steps.get("Internal motions", {"latex": [""]})["latex"][1:]:
        assert J @ vector(line.split(r",\quad")[0].split(" = ")[1]) == pytest.approx(np.zeros(len(J)), abs=1e-9)


def test_item_34_names_the_factor_that_vanishes(client: TestClient) -> None:
    steps = worked(client, "ur5_dh", WRIST)
    factors = r"a_{2} a_{3} s_{3} s_{5} \left(a_{2} c_{2} + a_{3} c_{23} + d_{5} s_{234}\right)"
    assert steps["Determinant"]["latex"][0].endswith(factors)
    assert "d_{5} = 0.09465" in steps["Determinant"]["latex"][1]
    assert any(line.startswith("s_{5} = 0") and "q_{5} = 0" in line for line in steps[SOLVED]["latex"])
    assert steps["Rank"]["text"].endswith("Wrist: two of its axes lie on one line.")


def test_the_determinant_in_symbols_is_only_shown_where_it_is_that_of_the_task(client: TestClient) -> None:
    """Two joints always turn the tip, so that in six directions nothing is lost; the wrist hides behind `x y z`."""
    assert SOLVED in worked(client, "planar_2r", [0.3, 0.8], task=["x", "y"])
    assert SOLVED not in worked(client, "planar_2r", [0.3, 0.8])
    assert SOLVED in worked(client, "scara", [0.4, 0.8, 0.12, -0.3], task=["rz", "x", "y", "z"])
    assert SOLVED not in worked(client, "ur5_dh", WRIST, task=["x", "y", "z"])


def test_a_length_multiplies_the_angular_rows(client: TestClient) -> None:
    plain, scaled = (
        worked(client, "ur5_dh", [0.1, -1.2, 1.4, -0.7, 0.5, 0.3], **call)["Determinant at this configuration"]
        for call in ({}, {"characteristic_length": 0.5})
    )
    first, second = (value(step["latex"][-1].split(" = ")[-1]) for step in (plain, scaled))
    assert first == pytest.approx(0.045981129777, abs=1e-10)
    assert second == pytest.approx(first / 8, abs=1e-10)
