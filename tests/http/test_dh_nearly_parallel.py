"""Axes that are nearly parallel: a table that a person can read, or the reason why its lengths are so large."""

from math import pi
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.dh.test_from_chain import Joint, serial

GEN3_LITE: list[Joint] = [
    ("revolute", (0, 0, 0.12825), (0, 0, 0), (0, 0, 1)),
    ("revolute", (0, -0.03, 0.115), (1.5708, 0, 0), (0, 0, 1)),
    ("revolute", (0, 0.28, 0), (-3.1416, 0, 0), (0, 0, 1)),
    ("revolute", (0, -0.14, 0.02), (1.5708, 0, 0), (0, 0, 1)),
    ("revolute", (0.0285, 0, 0.105), (0, 1.5708, 0), (0, 0, 1)),
    ("revolute", (-0.105, 0, 0.0285), (0, -1.5708, 0), (0, 0, 1)),
]
"""Kinova's, whose description writes π with four decimals."""


def random_arm(rng: np.random.Generator) -> list[Joint]:
    """Two to seven joints, each axis parallel, square or skew to the one before, and often tilted a little."""
    joints: list[Joint] = []
    for _ in range(rng.integers(2, 8)):
        xyz = rng.uniform(-0.5, 0.5, 3) * rng.integers(0, 2, 3)
        rpy = rng.choice([0.0, 0.0, pi / 2, pi]) * np.array([1.0, 0.0, 0.0])
        if rng.random() < 0.6:
            way = rng.uniform(0, 2 * pi)
            rpy[:2] += 10.0 ** rng.uniform(-12, -2) * np.array([np.cos(way), np.sin(way)])
        elif rng.random() < 0.2:
            rpy = rng.uniform(-pi, pi, 3)
        kind = str(rng.choice(["revolute", "revolute", "revolute", "prismatic"]))
        joints.append((kind, xyz.tolist(), rpy.tolist(), (0, 0, 1)))
    return joints


def table(client: TestClient, joints: list[Joint], **body: Any) -> dict[str, Any]:
    answer = client.post("/v1/dh/from-urdf", json={"urdf": serial(joints), **body})
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    return content


def longest(answer: dict[str, Any]) -> float:
    return max(abs(float(row[key])) for row in answer["dh"]["joints"] for key in ("a", "d"))


def test_an_arm_whose_description_rounds_pi(client: TestClient) -> None:
    answer = table(client, GEN3_LITE)
    assert longest(answer) < 1.0
    assert 1e-7 < answer["certificate"]["max_position_error"] < 1e-5
    first = answer["notes"][0]
    assert "'joint_2' and 'joint_3'" in first
    assert "7.35e-06 rad" in first
    assert f"{answer['certificate']['max_position_error']:.2g} m" in first


@pytest.mark.quick(6)
@pytest.mark.parametrize("seed", range(40))
def test_a_table_is_readable_or_says_why_not(client: TestClient, seed: int) -> None:
    rng = np.random.default_rng(seed)
    for convention in ("standard", "modified"):
        joints = random_arm(rng)
        answer = table(client, joints, convention=convention)
        reach = sum(float(np.linalg.norm(xyz)) for _, xyz, _, _ in joints)
        error = answer["certificate"]["max_position_error"]
        first = answer["notes"][0]
        if longest(answer) > 10 * reach:
            assert first.startswith("exact, but with a length")
        else:
            assert error < 1e-5
            assert error < 1e-9 or first.startswith("treated as parallel")


def test_what_cannot_be_rounded_is_exact_and_explained(client: TestClient) -> None:
    joints = [GEN3_LITE[0], ("revolute", (0, 0.5, 0), (1e-3, 0, 0), (0, 0, 1)), *GEN3_LITE[3:]]
    answer = table(client, joints)
    assert longest(answer) == pytest.approx(0.5 / np.tan(1e-3), rel=1e-3)
    assert answer["certificate"]["max_position_error"] < 1e-9
    assert answer["notes"][0].startswith("exact, but with a length")
    assert "'joint_1' and 'joint_2' (0.001 rad" in answer["notes"][0]


def test_of_two_pairs_the_one_that_costs_little_is_rounded(client: TestClient) -> None:
    def near(tilt: float) -> Joint:
        return ("revolute", (0, 0.5, 0), (tilt, 0, 0), (0, 0, 1))

    answer = table(client, [GEN3_LITE[0], near(1e-3), GEN3_LITE[1], near(1e-6), *GEN3_LITE[3:]])
    assert answer["notes"][0].startswith("exact, but with a length")
    assert answer["notes"][1].startswith("treated as parallel")
    assert answer["certificate"]["max_position_error"] < 1e-5
    assert 499 < longest(answer) < 501
