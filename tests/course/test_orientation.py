"""Orientations against the lecture's numbers and against SciPy's, near what degenerates and at it."""

import json
import re
from math import copysign, cos, pi, sin
from typing import Any

import numpy as np
import pytest
from scipy.linalg import polar
from scipy.spatial.transform import Rotation

from gelenk.contract.orientation import OrientationRequest
from gelenk.course.orientation.orientation import Notations, notations, wrapped
from gelenk.course.orientation.orientation_steps import product
from gelenk.course.orientation.rotations import DEGENERATE, About, AxisName, about_axis, composed, elementary, validated
from gelenk.errors import CertificationFailed
from gelenk.operations.orientation import run
from gelenk.robot.arrays import Array
from gelenk.robot.poses import transform

PRINTED = 5e-13
"""Half of the last of twelve printed digits."""
AXES: tuple[AxisName, ...] = ("x", "y", "z")
NEAR = [sign * size for size in (1e-17, 1e-15, 1e-13, 1e-10, 1e-7, 1e-5, 1e-2) for sign in (1, -1)] + [0.0]


def zyz(phi: float, theta: float, psi: float) -> Array:
    return elementary("z", phi) @ elementary("y", theta) @ elementary("z", psi)


def rpy(roll: float, pitch: float, yaw: float) -> Array:
    return elementary("z", yaw) @ elementary("y", pitch) @ elementary("x", roll)


# 10-12: matrices, elementary rotations, composition


@pytest.mark.parametrize("axis", AXES)
def test_elementary_rotation_by_30_degrees(axis: AxisName) -> None:
    c, s = 0.866025403784, 0.5
    lecture = {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }
    assert elementary(axis, pi / 6) == pytest.approx(np.array(lecture[axis]), abs=PRINTED)


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("angle", [0.0, 0.3, -2.0, pi, 100.0])
def test_elementary_rotations_are_scipys_and_rodrigues(axis: AxisName, angle: float) -> None:
    R = elementary(axis, angle)
    assert pytest.approx(Rotation.from_euler(axis, angle).as_matrix(), abs=1e-15) == R
    assert about_axis(np.eye(3)["xyz".index(axis)], angle) == pytest.approx(R, abs=1e-15)


def test_inverse_of_a_homogeneous_transform() -> None:
    """The inverse of (Rz(.3) Rx(.2); 1, 2, 3) has the position -Rᵀp: the last column, not the last row."""
    T = transform(np.array([1.0, 2.0, 3.0]), elementary("z", 0.3) @ elementary("x", 0.2))
    back = composed(T, [], np.empty((0, 3))).inverse
    assert back[:3, 3] == pytest.approx([-1.546376902448, -2.178965241928, -2.619318413260], abs=PRINTED)
    assert back[3].tolist() == [0.0, 0.0, 0.0, 1.0]
    assert back @ T == pytest.approx(np.eye(4), abs=1e-15)


def test_composition_of_two_frames() -> None:
    """The lecture's p_0 = R_0_1 R_1_2 p_2."""
    first, second = (transform(np.zeros(3), R) for R in (elementary("z", 0.3), elementary("x", 0.4)))
    found = composed(first, [(second, "moving")], np.array([[1.0, 2.0, 3.0]]))
    assert found.points[0] == pytest.approx([0.756195185525, 0.939289903397, 3.542019666626], abs=PRINTED)


@pytest.mark.parametrize("seed", range(20))
def test_composition_about_moving_and_fixed_axes(seed: int) -> None:
    """Against SciPy's products: those about moving axes multiply from the right, about fixed ones from the left."""
    rng = np.random.default_rng(seed)
    rotations, positions = Rotation.random(5, rng=rng), rng.normal(size=(5, 3))
    abouts: list[About] = ["fixed" if fixed else "moving" for fixed in rng.integers(0, 2, 5)]
    Ts = [transform(p, R.as_matrix()) for p, R in zip(positions, rotations, strict=True)]
    points = rng.normal(size=(7, 3))
    found = composed(Ts[0], list(zip(Ts[1:], abouts[1:], strict=True)), points)
    R, p = rotations[0], positions[0]
    for further, shift, about in zip(rotations[1:], positions[1:], abouts[1:], strict=True):
        R, p = (R * further, p + R.apply(shift)) if about == "moving" else (further * R, shift + further.apply(p))
    assert found.transforms[-1][:3, :3] == pytest.approx(R.as_matrix(), abs=1e-14)
    assert found.points == pytest.approx(R.apply(points) + p, abs=1e-13)
    assert found.inverse[:3, 3] == pytest.approx(-R.inv().apply(p), abs=1e-13)


def test_roll_pitch_yaw_are_the_same_as_turns_about_fixed_axes() -> None:
    first, *turns = (transform(np.zeros(3), R) for R in map(elementary, AXES, (-0.2, 0.5, 0.9)))
    found = composed(first, [(T, "fixed") for T in turns], np.empty((0, 3)))
    assert found.transforms[-1][:3, :3] == pytest.approx(rpy(-0.2, 0.5, 0.9), abs=1e-15)


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("angle", [pi, -pi, 3 * pi, -3 * pi, 0.0, -0.0])
def test_no_part_of_the_chosen_quaternion_is_a_negative_nothing(axis: AxisName, angle: float) -> None:
    """The scalar of half a turn comes out as ±6e-17: it is 0, and the first part that is not 0 is positive."""
    *vector, scalar = notations(elementary(axis, angle)).quaternion_xyzw
    assert scalar >= 0.0
    assert copysign(1.0, scalar) == 1.0
    if angle:
        assert next(part for part in vector if part != 0.0) > 0.0


# 13: ZYZ


def test_zyz_direct() -> None:
    lecture = [
        [0.594804145631, 0.517142044740, 0.615444663558],
        [-0.748878247785, 0.634773247189, 0.190379344067],
        [-0.292214644285, -0.574131544348, 0.764842187284],
    ]
    assert zyz(0.3, 0.7, -1.1) == pytest.approx(np.array(lecture), abs=PRINTED)


def test_zyz_inverse_has_two_solutions() -> None:
    first, second = notations(zyz(0.3, 0.7, -1.1)).zyz.solutions
    assert first == pytest.approx((0.3, 0.7, -1.1), abs=PRINTED)
    assert second == pytest.approx((-2.841592653590, -0.7, 2.041592653590), abs=PRINTED)


@pytest.mark.parametrize(
    ("theta", "case", "determined", "value"),
    [(0.0, "theta = 0", "phi + psi", 0.9), (pi, "theta = pi", "phi - psi", -0.1)],
)
def test_zyz_degenerates(theta: float, case: str, determined: str, value: float) -> None:
    """Not always the sum, as the notes have it: at θ = π it is the difference."""
    found = notations(zyz(0.4, theta, 0.5)).zyz
    assert found.degeneracy is not None
    assert (found.degeneracy.case, found.degeneracy.determined) == (case, determined)
    assert found.degeneracy.value == pytest.approx(value, abs=PRINTED)
    assert found.solutions == ((found.degeneracy.value, theta, 0.0),)


# 14: RPY


def test_rpy_inverse_has_two_solutions() -> None:
    first, second = notations(rpy(-0.2, 0.5, 0.9)).rpy.solutions
    assert first == pytest.approx((-0.2, 0.5, 0.9), abs=PRINTED)
    assert second == pytest.approx((2.941592653590, 2.641592653590, -2.241592653590), abs=PRINTED)


@pytest.mark.parametrize(
    ("pitch", "case", "determined", "value"),
    [(pi / 2, "pitch = pi/2", "yaw - roll", 0.7), (-pi / 2, "pitch = -pi/2", "yaw + roll", 1.1)],
)
def test_rpy_degenerates(pitch: float, case: str, determined: str, value: float) -> None:
    found = notations(rpy(0.2, pitch, 0.9)).rpy
    assert found.degeneracy is not None
    assert (found.degeneracy.case, found.degeneracy.determined) == (case, determined)
    assert found.degeneracy.value == pytest.approx(value, abs=PRINTED)
    ((roll, middle, yaw),) = found.solutions
    assert (middle, yaw) == (pitch, 0.0)
    assert roll == pytest.approx(-value if pitch > 0 else value, abs=PRINTED)


# 15: axis and angle

R_LECTURE = np.array([1.0, 2.0, 2.0]) / 3.0


def test_axis_and_angle() -> None:
    R = about_axis(R_LECTURE, 1.2)
    assert R[0] == pytest.approx([0.433206892868, -0.479661113862, 0.763057667428], abs=PRINTED)
    found = notations(R).axis_angle
    assert found.angle == pytest.approx(1.2, abs=1e-15)
    assert found.axes[0] == pytest.approx(R_LECTURE, abs=1e-15)


def test_half_a_turn_has_two_axes() -> None:
    lecture = np.array([[-7, 4, 4], [4, -1, 8], [4, 8, -1]]) / 9.0
    assert about_axis(R_LECTURE, pi) == pytest.approx(lecture, abs=1e-15)
    for R in (lecture, about_axis(R_LECTURE, pi), about_axis(-R_LECTURE, pi)):
        found = notations(R).axis_angle
        assert found.angle == pytest.approx(pi, abs=1e-15)
        assert np.array(found.axes) == pytest.approx(np.array([R_LECTURE, -R_LECTURE]), abs=1e-15)
        assert found.degeneracy is not None


def test_no_turn_has_no_axis() -> None:
    found = notations(np.eye(3))
    assert (found.axis_angle.angle, found.axis_angle.axes) == (0.0, ())
    assert found.rotation_vector == (0.0, 0.0, 0.0)
    assert {one.notation for one in found.degeneracies} == {"zyz", "axis_angle"}


# Every notation at random, near what degenerates, and at it


def outer() -> list[tuple[float, float]]:
    drawn = np.random.default_rng(5).uniform(-pi, pi, (6, 2)).tolist()
    return [*((a, b) for a, b in drawn), (0.0, 0.0), (pi / 2, -pi / 2), (pi, pi), (0.4, -0.4)]


def hard(kind: str) -> Array:
    match kind:
        case "random":
            return np.asarray(Rotation.random(100, rng=np.random.default_rng(1)).as_matrix())
        case "θ near 0":
            return np.array([zyz(a, near, b) for a, b in outer() for near in NEAR])
        case "θ near π":
            return np.array([zyz(a, pi + near, b) for a, b in outer() for near in NEAR])
        case "pitch near π/2":
            return np.array([rpy(a, pi / 2 + near, b) for a, b in outer() for near in NEAR])
        case "pitch near -π/2":
            return np.array([rpy(a, near - pi / 2, b) for a, b in outer() for near in NEAR])
        case "quarter turns":
            axes = [elementary(axis, k * pi / 2).round() for axis in AXES for k in range(4)]
            return np.array([A @ B for A in axes for B in axes])
    near_half = [pi + near for near in NEAR]
    axes = [*np.eye(3), *-np.eye(3), R_LECTURE, *np.random.default_rng(3).normal(size=(5, 3))]
    units = [axis / np.linalg.norm(axis) for axis in axes]
    return np.array([about_axis(axis, angle) for axis in units for angle in (*NEAR, *near_half)])


HARD = [
    "random",
    "θ near 0",
    "θ near π",
    "pitch near π/2",
    "pitch near -π/2",
    "quarter turns",
    "near 0 and half a turn",
]


def worst(found: Notations, R: Array) -> float:
    """The largest difference of R to what SciPy makes of each notation."""
    again = [
        Rotation.from_quat(found.quaternion_xyzw),
        Rotation.from_rotvec(found.rotation_vector),
        *(Rotation.from_rotvec(found.axis_angle.angle * np.array(axis)) for axis in found.axis_angle.axes),
        *(Rotation.from_euler("ZYZ", triple) for triple in found.zyz.solutions),
        *(Rotation.from_euler("xyz", triple) for triple in found.rpy.solutions),
    ]
    return max(float(np.abs(one.as_matrix() - R).max()) for one in again)


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", HARD)
def test_every_notation_is_the_rotation_to_scipy(kind: str) -> None:
    for R in hard(kind):
        assert worst(notations(R), R) < 4e-14


@pytest.mark.parametrize("kind", HARD)
def test_branches_lie_where_they_should(kind: str) -> None:
    for R in hard(kind):
        found = notations(R)
        assert found.quaternion_xyzw[3] >= -DEGENERATE
        assert 0.0 <= found.axis_angle.angle <= pi
        assert 0.0 <= found.zyz.solutions[0][1] <= pi
        assert abs(found.rpy.solutions[0][1]) <= pi / 2
        for triple in (found.zyz, found.rpy):
            assert len(triple.solutions) == (1 if triple.degeneracy else 2)
            assert all(-pi <= angle <= pi for solution in triple.solutions for angle in solution)
        if found.zyz.degeneracy is None:
            assert found.zyz.solutions[1][1] <= 0.0
        if found.rpy.degeneracy is None:
            assert abs(found.rpy.solutions[1][1]) >= pi / 2


@pytest.mark.parametrize("near", NEAR)
@pytest.mark.parametrize(("a", "b"), outer())
def test_the_determined_combination_survives_what_the_two_angles_do_not(near: float, a: float, b: float) -> None:
    """Its error is that of R, however small the sine; that of φ and ψ grows with its inverse."""
    found = notations(zyz(a, abs(near), b)).zyz
    phi, _, psi = found.solutions[0]
    assert abs(wrapped(phi + psi - a - b)) < 1e-14
    assert (found.degeneracy is not None) == (sin(abs(near)) <= DEGENERATE)
    found = notations(rpy(a, pi / 2 - abs(near), b)).rpy
    roll, _, yaw = found.solutions[0]
    assert abs(wrapped((yaw - roll) - (b - a))) < 1e-14


@pytest.mark.parametrize("noise", [1e-17, -1e-17, 3e-16])
def test_rounding_in_the_last_column_is_not_taken_for_angles(noise: float) -> None:
    """The entries r13 and r23 decide φ; where they are rounding, atan2 of them is garbage."""
    R = elementary("z", 0.9)
    R[0, 2], R[1, 2], R[2, 0], R[2, 1] = noise, -noise, noise, noise
    found = notations(R).zyz
    assert found.degeneracy is not None
    assert found.solutions[0] == pytest.approx((0.9, 0.0, 0.0), abs=1e-15)


@pytest.mark.parametrize("angle", [1e-300, 1e-100, 1e-20])
def test_a_tiny_rotation_vector_keeps_its_digits_though_it_has_no_axis(angle: float) -> None:
    R = np.eye(3)
    R[2, 1], R[1, 2] = angle, -angle
    found = notations(R)
    assert found.axis_angle.axes == ()
    assert found.rotation_vector[0] == pytest.approx(angle, rel=1e-15)


def test_both_signs_of_a_quaternion_give_the_one_that_is_chosen() -> None:
    assert notations(np.diag([1.0, -1.0, -1.0])).quaternion_xyzw == pytest.approx((1, 0, 0, 0), abs=0)
    assert notations(np.diag([-1.0, 1.0, -1.0])).quaternion_xyzw == pytest.approx((0, 1, 0, 0), abs=0)
    for noise in (1e-16, -1e-16):
        R = about_axis(np.array([0.6, -0.8, 0.0]), pi + noise)
        assert notations(R).quaternion_xyzw[:2] == pytest.approx((0.6, -0.8), abs=1e-15)


def test_what_is_no_rotation_is_not_certified() -> None:
    with pytest.raises(CertificationFailed):
        notations(np.eye(3) + 1e-9)


@pytest.mark.parametrize("angle", [0.0, pi, -pi, 3.5, -3.5, 1e6, 100 * pi])
def test_wrapped_angles(angle: float) -> None:
    found = wrapped(angle)
    assert -pi < found <= pi
    assert (cos(found), sin(found)) == pytest.approx((cos(angle), sin(angle)), abs=1e-9)


# Validation


@pytest.mark.parametrize("seed", range(20))
def test_the_nearest_rotation_is_scipys_polar_factor(seed: int) -> None:
    rng = np.random.default_rng(seed)
    matrix = Rotation.random(rng=rng).as_matrix() + rng.normal(scale=0.1, size=(3, 3))
    found, nearest = validated(matrix)
    U, _ = polar(matrix)
    assert nearest == pytest.approx(U, abs=1e-13)
    assert found.distance == pytest.approx(np.linalg.norm(matrix - U), rel=1e-12)
    assert found.determinant == pytest.approx(np.linalg.det(matrix), rel=1e-12)
    assert found.is_unique
    others = Rotation.random(200, rng=rng).as_matrix()
    assert found.distance <= min(np.linalg.norm(matrix - R) for R in others)


@pytest.mark.parametrize("seed", range(20))
def test_no_rotation_is_nearer_to_a_reflected_matrix(seed: int) -> None:
    """With a determinant below zero the polar factor is a reflection; the nearest rotation is another one."""
    rng = np.random.default_rng(seed)
    matrix = rng.normal(size=(3, 3))
    matrix *= -np.sign(np.linalg.det(matrix))
    found, nearest = validated(matrix)
    assert found.is_reflection
    assert np.linalg.det(nearest) == pytest.approx(1.0)
    # A neighbour by a small turn about any axis is no nearer.
    turns = Rotation.from_rotvec(1e-3 * rng.normal(size=(50, 3))).as_matrix()
    assert found.distance <= min(np.linalg.norm(matrix - nearest @ turn) for turn in turns) + 1e-12


def test_a_reflection_is_called_one() -> None:
    found, _ = validated(np.diag([1.0, 1.0, -1.0]))
    assert (found.orthogonality_error, found.determinant) == (0.0, -1.0)
    assert found.is_reflection
    assert not found.is_unique
    assert found.distance == pytest.approx(2.0)


def test_nothing_is_near_the_zero_matrix() -> None:
    found, _ = validated(np.zeros((3, 3)))
    assert (found.determinant, found.is_unique, found.is_reflection) == (0.0, False, False)
    assert found.distance == pytest.approx(np.sqrt(3))


# The worked solution


def shown(**body: Any) -> str:
    """All titles, texts and formulas for a request, whose numbers and certificate are checked elsewhere."""
    request = OrientationRequest.model_validate_json(json.dumps(body))
    steps = run(request).content()["steps"]
    return "\n".join(part for one in steps for part in (one.title, one.text, *one.plain))


def test_steps_of_a_composition() -> None:
    """The lecture's R⁰₂ = R⁰₁ R¹₂, in symbols and with numbers, and its point."""
    text = shown(
        elementary={"axis": "z", "angle": 0.3}, then=[{"elementary": {"axis": "x", "angle": 0.4}}], points=[[1, 2, 3]]
    )
    assert "R⁰_2 = R_1 R_2 = R⁰_1 R¹_2" in text
    assert "[c_1, -s_1 c_2, s_1 s_2; s_1, c_1 c_2, -c_1 s_2; 0, s_2, c_2]" in text
    assert "p_0 = (0.7561951855, 0.9392899034, 3.54201966" in text


def test_a_motion_about_fixed_axes_stands_first() -> None:
    text = shown(
        elementary={"axis": "z", "angle": 0.3}, then=[{"elementary": {"axis": "x", "angle": 0.4}, "about": "fixed"}]
    )
    assert "R⁰_2 = R_2 R_1" in text
    assert "R⁰_1 R¹_2" not in text


@pytest.mark.parametrize(
    ("body", "lines"),
    [
        ({"zyz": [0.3, 0.7, -1.1]}, ["(φ, ϑ, ψ) = (0.3, 0.7, -1.1)", "(-2.841592654, -0.7, 2.041592654)"]),
        ({"zyz": [0.4, 0.0, 0.5]}, ["φ+ ψ", "= 0.9", "sin ϑ = 0"]),
        ({"zyz": [0.4, pi, 0.5]}, ["φ- ψ", "atan2(-r_21, -r_11) = -0.1"]),
        ({"rpy": [-0.2, 0.5, 0.9]}, ["(ϕ, ϑ, ψ) = (-0.2, 0.5, 0.9)", "(2.941592654, 2.641592654, -2.241592654)"]),
        ({"rpy": [0.2, pi / 2, 0.9]}, ["atan2(-r_12, r_22) = 0.7", "cos(pitch) = 0"]),
        ({"rpy": [0.2, -pi / 2, 0.9]}, ["atan2(-r_12, r_22) = 1.1"]),
        ({"axis_angle": {"axis": [1, 2, 2], "angle": 1.2}}, ["0.4332068929, -0.4796611139, 0.7630576674"]),
        (
            {"axis_angle": {"axis": [1, 2, 2], "angle": pi}},
            ["Half a turn", "(0.3333333333, 0.6666666667, 0.6666666667)"],
        ),
        ({"quaternion_xyzw": [0, 0, 0, 1]}, ["there is none"]),
        ({"rotation": [[2, 0, 0], [0, 1, 0], [0, 0, 1]], "project": True}, ["det R = 2", "distance = 1"]),
    ],
)
def test_steps_name_the_branch_and_what_degenerates(body: dict[str, Any], lines: list[str]) -> None:
    text = shown(**body).replace("φ +", "φ+").replace("φ -", "φ-")
    for line in lines:
        assert line in text


def test_steps_of_an_inverse() -> None:
    text = shown(
        elementary={"axis": "z", "angle": 0.3}, position=[1, 2, 3], then=[{"elementary": {"axis": "x", "angle": 0.2}}]
    )
    assert "(-1.546376902, -2.178965242, -2.619318413)" in text


@pytest.mark.parametrize("turns", ["zyz", "xyz", "zyx", "xx", "y"])
def test_products_in_symbols_are_those_of_the_numbers(turns: str) -> None:
    angles = dict(zip("abc", (0.3, -0.7, 1.1), strict=True))
    names = tuple(zip(turns, angles, strict=False))
    values = {
        f"{function.__name__[0]}_{{{name}}}": function(x) for name, x in angles.items() for function in (cos, sin)
    }
    rows = product(names).removeprefix(r"\begin{bmatrix} ").removesuffix(r" \end{bmatrix}").split(r" \\ ")
    found = [[evaluated(entry, values) for entry in row.split(" & ")] for row in rows]
    wanted = np.linalg.multi_dot([np.eye(3), *(elementary(axis, angles[name]) for axis, name in names)])  # type: ignore[arg-type]
    assert np.array(found) == pytest.approx(wanted, abs=1e-15)


def evaluated(entry: str, values: dict[str, float]) -> float:
    """The value of a sum of products such as c_{a} s_{b} - s_{a}."""
    total = 0.0
    for sign, term in re.findall(r"(^-?|[+-] )((?:[cs]_\{\w\} ?|\d ?)+)", entry):
        factors = [values.get(factor) for factor in term.split()]
        size = float(np.prod([float(f) if v is None else v for f, v in zip(term.split(), factors, strict=True)]))
        total += -size if sign.strip() == "-" else size
    return total
