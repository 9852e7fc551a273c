"""Every notation of a rotation against SciPy's, and against the reference numbers of the course."""

from collections.abc import Callable
from math import pi
from typing import NamedTuple

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.errors import InvalidPose
from gelenk.robot import notations
from gelenk.robot.arrays import Array
from gelenk.robot.notations import placement, pose_errors
from gelenk.robot.poses import Poses, _is_rotation, inverse, nearest_rotation, transform, unit_quaternion

NEAR = [sign * size for size in (1e-15, 1e-13, 1e-12, 1e-9, 1e-7, 1e-6, 1e-3) for sign in (1, -1)] + [0.0]
"""Distances from an angle at which something degenerates."""


class Notation(NamedTuple):
    """How it becomes a rotation here and comes back, and both by SciPy."""

    rotations: Callable[[Array], Array]
    values: Callable[[Array], Array]
    reference_rotations: Callable[[Array], Rotation]
    reference_values: Callable[[Rotation], Array]


NOTATIONS = {
    "rpy": Notation(
        notations.rotations_from_rpy,
        notations.rpy_from_rotations,
        lambda values: Rotation.from_euler("xyz", values),
        lambda rotations: rotations.as_euler("xyz"),
    ),
    "zyz": Notation(
        notations.rotations_from_zyz,
        notations.zyz_from_rotations,
        lambda values: Rotation.from_euler("ZYZ", values),
        lambda rotations: rotations.as_euler("ZYZ"),
    ),
    "quaternion": Notation(
        notations.rotations_from_quaternions_xyzw,
        notations.quaternions_xyzw_from_rotations,
        Rotation.from_quat,
        lambda rotations: rotations.as_quat(canonical=True),
    ),
    "vector": Notation(
        notations.rotations_from_vectors,
        notations.vectors_from_rotations,
        Rotation.from_rotvec,
        lambda rotations: rotations.as_rotvec(),
    ),
}
every_notation = pytest.mark.parametrize("notation", NOTATIONS.values(), ids=NOTATIONS)


def directions(count: int = 20) -> Array:
    """Unit vectors: the coordinate axes both ways, and some at random."""
    drawn = np.random.default_rng(1).normal(size=(count, 3))
    return np.concatenate((np.eye(3), -np.eye(3), drawn / np.linalg.norm(drawn, axis=1, keepdims=True)))


def about_axes(angles: list[float]) -> Array:
    """Rotations by these angles about each of the directions."""
    return np.concatenate([Rotation.from_rotvec(angle * directions()).as_matrix() for angle in angles])


def euler_near(sequence: str, middles: list[float]) -> Array:
    """Rotations whose middle Euler angle is one of these, the outer ones at random and on purpose."""
    outer = [*np.random.default_rng(2).uniform(-pi, pi, (10, 2)), (0, 0), (pi / 2, -pi / 2), (pi, pi), (-pi / 2, 0)]
    triples = [(first, middle, last) for first, last in outer for middle in middles]
    return np.asarray(Rotation.from_euler(sequence, triples).as_matrix())


HARD = {
    "random": Rotation.random(500, rng=np.random.default_rng(0)).as_matrix(),
    "near the identity": about_axes(NEAR),
    "near half a turn": about_axes([pi + near for near in NEAR]),
    "quarter turns": about_axes([pi / 2, -pi / 2, pi, 2 * pi]).round(15),
    "pitch near ±π/2": euler_near("ZYX", [sign * pi / 2 + near for near in NEAR for sign in (1, -1)]),
    "θ near 0": euler_near("ZYZ", NEAR),
    "θ near π": euler_near("ZYZ", [pi + near for near in NEAR]),
}


@every_notation
@pytest.mark.parametrize("Rs", HARD.values(), ids=HARD)
def test_notation_gives_the_rotation_again(notation: Notation, Rs: Array) -> None:
    again = notation.rotations(notation.values(Rs))
    assert np.abs(again - Rs).max() < 2e-14


@every_notation
def test_rotations_are_scipys(notation: Notation) -> None:
    values = notation.reference_values(Rotation.random(500, rng=np.random.default_rng(3)))
    assert np.abs(notation.rotations(values) - notation.reference_rotations(values).as_matrix()).max() < 4e-15


@every_notation
def test_values_are_scipys(notation: Notation) -> None:
    rotations = Rotation.random(500, rng=np.random.default_rng(4))
    assert np.abs(notation.values(rotations.as_matrix()) - notation.reference_values(rotations)).max() < 1e-12


@pytest.mark.parametrize("angle", [1e-300, 1e-30, 1e-13, 1e-8, 1e-4])
def test_small_rotation_vectors_keep_their_digits(angle: float) -> None:
    vectors = angle * directions()
    again = notations.vectors_from_rotations(notations.rotations_from_vectors(vectors))
    assert np.abs(again - vectors).max() < 1e-15 * angle + 1e-300


@pytest.mark.parametrize("Rs", HARD.values(), ids=HARD)
def test_values_lie_on_their_branch(Rs: Array) -> None:
    assert np.all(np.abs(notations.rpy_from_rotations(Rs)[:, 1]) <= pi / 2 + 1e-14)
    assert np.all(notations.zyz_from_rotations(Rs)[:, 1] >= 0)
    assert np.all(notations.quaternions_xyzw_from_rotations(Rs)[:, 3] >= 0)
    assert np.all(np.linalg.norm(notations.vectors_from_rotations(Rs), axis=1) <= pi + 1e-14)


# The reference numbers of the course


def zyz(*angles: float) -> Array:
    return np.asarray(notations.rotations_from_zyz(np.array([angles]))[0])


def rpy(*angles: float) -> Array:
    return np.asarray(notations.rotations_from_rpy(np.array([angles]))[0])


def test_inverse_of_a_transform() -> None:
    T = transform(np.array([1.0, 2.0, 3.0]), rpy(0, 0, 0.3) @ rpy(0.2, 0, 0))
    assert inverse(T)[:3, 3] == pytest.approx([-1.546376902448, -2.178965241928, -2.619318413260], abs=1e-12)
    assert np.abs(inverse(T) @ T - np.eye(4)).max() < 1e-15


def test_composition_of_frames() -> None:
    p_0 = rpy(0, 0, 0.3) @ rpy(0.4, 0, 0) @ [1, 2, 3]
    assert p_0 == pytest.approx([0.756195185525, 0.939289903397, 3.542019666626], abs=1e-12)


def test_zyz() -> None:
    R = zyz(0.3, 0.7, -1.1)
    rows = [
        [0.594804145631, 0.517142044740, 0.615444663558],
        [-0.748878247785, 0.634773247189, 0.190379344067],
        [-0.292214644285, -0.574131544348, 0.764842187284],
    ]
    assert np.abs(R - rows).max() < 1e-12
    assert notations.zyz_from_rotations(R[None])[0] == pytest.approx([0.3, 0.7, -1.1], abs=1e-15)
    assert np.abs(zyz(-2.841592653590, -0.7, 2.041592653590) - R).max() < 1e-12


@pytest.mark.parametrize(("theta", "first"), [(0.0, 0.9), (pi, -0.1)])
def test_zyz_where_only_a_sum_or_difference_is_determined(theta: float, first: float) -> None:
    assert notations.zyz_from_rotations(zyz(0.4, theta, 0.5)[None])[0] == pytest.approx([first, theta, 0.0], abs=1e-15)


def test_rpy() -> None:
    R = rpy(-0.2, 0.5, 0.9)
    assert notations.rpy_from_rotations(R[None])[0] == pytest.approx([-0.2, 0.5, 0.9], abs=1e-15)
    assert np.abs(rpy(2.941592653590, 2.641592653590, -2.241592653590) - R).max() < 1e-12


def test_rpy_where_only_a_difference_is_determined() -> None:
    assert notations.rpy_from_rotations(rpy(0.2, pi / 2, 0.9)[None])[0] == pytest.approx([-0.7, pi / 2, 0.0], abs=1e-15)


def test_rotation_vector() -> None:
    axis = np.array([1.0, 2.0, 2.0]) / 3
    R, half_turn = notations.rotations_from_vectors(np.array([1.2 * axis, pi * axis]))
    assert R[0] == pytest.approx([0.433206892868, -0.479661113862, 0.763057667428], abs=1e-12)
    assert np.abs(9 * half_turn - [[-7, 4, 4], [4, -1, 8], [4, 8, -1]]).max() < 1e-14


def test_elementary_rotation() -> None:
    T = placement((1.0, 2.0, 3.0), (pi / 6, 0.0, 0.0))
    c, s = 0.866025403784, 0.5
    assert np.abs(T - [[1, 0, 0, 1], [0, c, -s, 2], [0, s, c, 3], [0, 0, 0, 1]]).max() < 1e-12


def test_homogeneous_matrices() -> None:
    positions = np.arange(6.0).reshape(2, 3)
    Ts = Poses(positions, np.array([np.eye(3), zyz(1, 2, 3)])).matrices()
    assert np.array_equal(Ts[1], transform(positions[1], zyz(1, 2, 3)))


# What is refused


@pytest.mark.parametrize(
    ("matrix", "word", "distance"),
    [
        (np.diag([1.0, 1.0, -1.0]), "reflection", 2.0),
        (-np.eye(3), "reflection", 2.0),
        (np.zeros((3, 3)), "not a rotation", np.sqrt(3)),
        (2 * np.eye(3), "not a rotation", np.sqrt(3)),
        (np.diag([1.0, 1.0, 1.0 + 2e-6]), "not a rotation", 2e-6),
        (np.diag([1.0, 1.0, -1e200]), "not a rotation", 1e200),
        (np.full((3, 3), 1e308), "not a rotation", None),
    ],
)
def test_a_matrix_far_from_a_rotation_is_refused(matrix: Array, word: str, distance: float | None) -> None:
    with pytest.raises(InvalidPose, match=word) as caught:
        nearest_rotation(matrix)
    assert caught.value.distance == (None if distance is None else pytest.approx(distance))


@pytest.mark.parametrize("Rs", HARD.values(), ids=HARD)
def test_a_matrix_near_a_rotation_is_projected(Rs: Array) -> None:
    noise = np.random.default_rng(5).uniform(-1e-7, 1e-7, (3, 3))
    R = nearest_rotation(Rs[0] + noise)
    assert np.abs(R @ R.T - np.eye(3)).max() < 1e-14
    assert np.abs(R - Rs[0]).max() < 2e-7


@pytest.mark.parametrize("quaternion", [[0, 0, 0, 0], [0, 0, 0, 1.001], [0.5, 0.5, 0.5, 0.4], [1e308] * 4])
def test_a_quaternion_far_from_unit_length_is_refused(quaternion: list[float]) -> None:
    with pytest.raises(InvalidPose, match="quaternion has length"):
        unit_quaternion(quaternion)


def test_a_quaternion_near_unit_length_is_normalised() -> None:
    assert unit_quaternion([part * (1 + 5e-7) for part in (0.6, 0.0, 0.8, 0.0)]) == pytest.approx(
        [0.6, 0, 0.8, 0], abs=1e-15
    )


# How far two batches are apart


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-6, 0.5, pi / 2, pi])
def test_pose_errors(angle: float) -> None:
    Rs = HARD["random"][:20]
    positions = np.random.default_rng(6).uniform(-1, 1, (20, 3))
    turned = Rs @ Rotation.from_rotvec(angle * directions()[:20]).as_matrix()
    shifted = positions + np.array([0.0, 3.0, 4.0])
    distance, measured, extent = pose_errors(positions, Rs, shifted, turned)
    assert distance == pytest.approx(5.0)
    assert measured == pytest.approx(angle, rel=1e-3, abs=2e-15)
    assert extent == np.abs(shifted).max()


@pytest.mark.parametrize("where", ["position", "rotation"])
def test_pose_errors_of_nan_are_nan(where: str) -> None:
    positions, Rs = np.zeros((2, 3)), np.array([np.eye(3)] * 2)
    (positions if where == "position" else Rs)[1, 2] = np.nan
    assert np.isnan(pose_errors(positions, Rs, np.zeros((2, 3)), np.array([np.eye(3)] * 2))[:2]).all()


@pytest.mark.parametrize("noise", [0.0, 1e-16, 1e-15, 3e-15, 1e-14, 1e-9])
def test_what_is_taken_for_a_rotation_unseen_is_as_near_as_its_decomposition_says(noise: float) -> None:
    rng = np.random.default_rng(4)
    taken = 0
    for R in notations.rotations_from_vectors(rng.normal(size=(300, 3))):
        matrix = R + noise * rng.normal(size=(3, 3))
        U, _, Vt = np.linalg.svd(matrix)
        distance = np.linalg.norm(matrix - U @ Vt)
        if _is_rotation(*matrix.tolist()):
            taken += 1
            assert distance <= 5e-15
        assert not _is_rotation(*(-matrix).tolist())
    assert taken == 300 if noise <= 1e-16 else taken < 300
