"""Worked solutions of dynamics: sums over the bodies and Christoffel's symbols, beside Pinocchio's terms."""

import re
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.http.test_velocity_steps import post
from tests.oracles.expressions import latex_entries, latex_value
from tests.oracles.written import matrix, vector
from tests.robots import robot

LOAD = {"payload": {"mass": 0.5, "center_of_mass": [0.0, 0.01, 0.05]}}
PUSH = {"wrenches": [[1.0, 2.0, 3.0, 0.1, 0.2, 0.3]]}


def state(name: str, **options: Any) -> dict[str, Any]:
    """Fields of a state of a robot, drawn at random."""
    q, v = np.random.default_rng(3).uniform(-1.0, 1.0, (2, len(robot(name).chain(None, None)))).tolist()
    return {"joint_positions": [q], "joint_velocities": [v], **options}


def titled(answer: dict[str, Any]) -> dict[str, list[str]]:
    return {step["title"]: step["latex"] for step in answer["steps"][0]}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "options"), [("panda", LOAD), ("scara", PUSH), ("double_pendulum_simple", PUSH), ("so100", {})]
)
def test_each_term_is_that_of_pinocchio(client: TestClient, name: str, options: dict[str, Any]) -> None:
    n = len(robot(name).chain(None, None))
    a = np.linspace(-1.0, 1.0, n).tolist()
    call = state(name, **options)
    answer = post(client, "dynamics", name, **call, joint_accelerations=[a], steps=True)
    steps = titled(answer)
    scale = 1e-9 * max(1.0, np.abs(answer["torques"][0]).max())
    assert matrix(steps["Mass matrix in numbers"][-2]) == pytest.approx(np.array(answer["mass_matrices"][0]), abs=scale)
    assert vector(steps["Coriolis and centrifugal terms"][-1]) == pytest.approx(
        np.array(answer["coriolis_torques"][0]), abs=scale
    )
    assert vector(steps["Gravity in numbers"][-1]) == pytest.approx(np.array(answer["gravity_torques"][0]), abs=scale)
    assert vector(steps["Inverse dynamics"][-1]) == pytest.approx(np.array(answer["torques"][0]), abs=scale)
    back = titled(post(client, "dynamics", name, **call, torques=answer["torques"], steps=True))
    assert vector(back["Forward dynamics"][-1]) == pytest.approx(a, abs=1e-6)


def plain(symbol: str) -> str:
    """A symbol as a name of Python; the expressions know small letters only."""
    return re.sub(r"\W", "", symbol).lower()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["double_pendulum_simple", "asr_twodof", "planar_2r"])
def test_a_short_planar_arm_moves_by_the_equations_in_symbols(client: TestClient, name: str) -> None:
    """Their symbols with the values beside them make the mass matrix and the gravity torques of the robot."""
    call = state(name, gravity=[1.0, -9.0, -3.0])
    answer = post(client, "dynamics", name, **call, steps=True)
    steps = titled(answer)
    shown = dict(line.split(" = ") for line in steps["The symbols"][0].split(r",\quad "))
    names = {plain(symbol): float(number) for symbol, number in shown.items()}
    (q1, q2), legend = call["joint_positions"][0], [*shown]
    for letter, function in (("c", np.cos), ("s", np.sin)):
        names |= {f"{letter}_1": function(q1), f"{letter}_2": function(q2), f"{letter}_12": function(q1 + q2)}
        legend += [rf"{letter}_{{{index}}}" for index in ("1", "2", "12")]
    entries = [{"latex": symbol, "plain": plain(symbol)} for symbol in legend]
    for title, expected in (
        ("Mass matrix", np.array(answer["mass_matrices"][0])),
        ("Gravity", np.array(answer["gravity_torques"]).T),
    ):
        cells = latex_entries(steps[title][-1].split("(q) = ")[-1])
        found = [[latex_value(cell, entries, names) for cell in row] for row in cells]
        assert np.array(found) == pytest.approx(expected, abs=1e-8)


def test_longer_arms_and_loaded_ones_have_numbers_only(client: TestClient) -> None:
    for name, options in (("scara", {}), ("planar_2r", LOAD)):
        assert "The symbols" not in titled(post(client, "dynamics", name, **state(name, **options), steps=True))
