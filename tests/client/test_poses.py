"""Poses as programs read and write them: a position in every notation, and what is sent is what was given."""

import json
from typing import Any

import numpy as np
import pytest

from gelenk.contract.pose import Pose, PoseLike, pose_of
from gelenk.operations.pose_arrays import poses_from

GIVEN: list[dict[str, Any]] = [
    {"position": [0.1, 0.2, 0.3], "rpy": [0.1, 0.2, 0.3]},
    {"matrix": [[1.0, 0.0, 0.0, 0.1], [0.0, 1.0, 0.0, 0.2], [0.0, 0.0, 1.0, 0.3], [0.0, 0.0, 0.0, 1.0]]},
    {"ur": [0.1, 0.2, 0.3, 0.0, 0.0, 0.5]},
    {"kuka_abc": [100.0, 200.0, 300.0, 30.0, 0.0, 0.0]},
    {"abb": [100.0, 200.0, 300.0, 1.0, 0.0, 0.0, 0.0]},
    {"fanuc_wpr": [100.0, 200.0, 300.0, 0.0, 0.0, 30.0]},
]


@pytest.mark.parametrize("given", GIVEN, ids=" ".join)
def test_a_pose_has_its_position_in_every_notation_and_sends_what_was_given(given: dict[str, Any]) -> None:
    pose = Pose.model_validate_json(json.dumps(given))
    assert pose.position == pytest.approx([0.1, 0.2, 0.3], abs=1e-15)
    assert pose.transform()[:3, 3] == pytest.approx(pose.position, abs=1e-15)
    assert pose.model_dump() == pose.model_dump(exclude_unset=True) == given
    assert json.loads(pose.model_dump_json()) == given
    assert ("position=" in repr(pose)) == ("position" in given)
    assert pose == Pose(**given) == Pose.model_validate(pose.model_dump())


def test_a_null_in_place_of_a_position_counts_as_none() -> None:
    null = {"position": None, **GIVEN[1]}
    assert Pose.model_validate_json(json.dumps(null)).model_dump() == GIVEN[1]


def test_dicts_are_poses_as_models_are() -> None:
    rotated: PoseLike = {"position": (0.1, 0.2, 0.3), "rotation": np.eye(3)}
    assert pose_of(rotated) == Pose(position=[0.1, 0.2, 0.3], rotation=np.eye(3).tolist())
    (position,) = poses_from([rotated], "targets").positions
    assert position == pytest.approx([0.1, 0.2, 0.3])
