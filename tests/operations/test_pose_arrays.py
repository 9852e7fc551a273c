"""Poses of requests as arrays: many quaternions at once give what each gives alone, and the same refusals."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.contract.pose import Pose
from gelenk.errors import InvalidPose
from gelenk.operations.pose_arrays import poses_from

COUNT = 20


def given(count: int = COUNT) -> list[Pose]:
    """Poses by quaternions that are as rounded as a client's may be."""
    rng = np.random.default_rng(6)
    quaternions = Rotation.random(count, rng=rng).as_quat() * (1.0 + 5e-7 * rng.uniform(-1.0, 1.0, (count, 1)))
    places = rng.normal(size=(count, 3))
    return [
        Pose(position=place, quaternion_xyzw=quaternion)
        for place, quaternion in zip(places.tolist(), quaternions.tolist(), strict=True)
    ]


def test_quaternions_together_are_what_each_is_alone() -> None:
    together = poses_from(given(), "targets")
    for i, pose in enumerate(given()):
        assert pose.quaternion_xyzw is not None
        alone = poses_from([pose], "targets")
        x, y, z, w = pose.quaternion_xyzw
        other_order = poses_from([Pose(position=pose.position, quaternion_wxyz=[w, x, y, z])], "targets")
        for one in (alone, other_order):
            np.testing.assert_array_equal(one.positions[0], together.positions[i])
            np.testing.assert_array_equal(one.rotations[0], together.rotations[i])
        np.testing.assert_allclose(together.rotations[i], Rotation.from_quat([x, y, z, w]).as_matrix(), atol=1e-15)


def test_notations_may_be_mixed() -> None:
    plain = poses_from(given(), "targets")
    mixed = [pose if i % 2 else Pose(matrix=pose.transform().tolist()) for i, pose in enumerate(given())]
    found = poses_from(mixed, "targets")
    np.testing.assert_array_equal(found.positions, plain.positions)
    np.testing.assert_allclose(found.rotations, plain.rotations, atol=1e-15)


@pytest.mark.parametrize("mixed", [False, True])
def test_the_first_that_is_no_rotation_is_named_by_its_place(mixed: bool) -> None:
    poses = given()
    for i in (7, 12):
        poses[i] = Pose(position=[0.0, 0.0, 0.0], quaternion_xyzw=[0.0, 0.0, 0.0, 1.001])
    if mixed:
        poses[3] = Pose(position=[0.0, 0.0, 0.0], rpy=[0.0, 0.0, 0.0])
    with pytest.raises(InvalidPose, match="length") as caught:
        poses_from(poses, "targets")
    assert (caught.value.field, caught.value.index) == ("targets", 7)


def test_none_are_none() -> None:
    found = poses_from([], "targets")
    assert (found.positions.shape, found.rotations.shape) == ((0, 3), (0, 3, 3))


@pytest.mark.parametrize(
    "fields",
    [
        {"quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]},
        {"position": [0.0] * 3, "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0], "rpy": [0.0] * 3},
        {"position": [0.0] * 3, "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0], "matrix": np.eye(4).tolist()},
        {"position": None, "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]},
    ],
)
def test_a_quaternion_needs_its_position_and_no_other_orientation(fields: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r"has a `position`|exactly one|given alone"):
        Pose.model_validate(fields)


def test_what_is_null_is_not_given() -> None:
    pose = Pose.model_validate({"position": [0.0] * 3, "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0], "rpy": None})
    assert pose.transform().tolist() == np.eye(4).tolist()
