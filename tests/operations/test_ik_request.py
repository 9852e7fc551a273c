"""Requests of inverse kinematics as problems of the core."""

import json
from typing import Any

import pytest

from gelenk.contract.ik import InverseRequest
from gelenk.operations.ik_request import TargetLimits, options_of, parse
from tests.robots import robot

PLAIN: list[dict[str, Any]] = [
    {},
    {"position_tolerance": 1e-4, "orientation_tolerance": 1e-3},
    {"respect_limits": False, "random_seed": 7, "seeds": [[0.1] * 7], "pose_format": "rpy"},
]


@pytest.mark.parametrize("fields", PLAIN)
def test_the_options_of_a_plain_call_are_those_of_any(fields: dict[str, Any]) -> None:
    machine = robot("panda")
    target = {"position": [0.4, 0.0, 0.4], "quaternion_xyzw": [1.0, 0.0, 0.0, 0.0]}
    call = InverseRequest.model_validate_json(json.dumps({"targets": [target], **fields}))
    problem = parse(machine, call, TargetLimits(10, 10, None))
    assert problem.options == options_of(problem.chain, call, None)
    assert parse(machine, call, TargetLimits(10, 10, None)).options is problem.options
