"""Ways through orientations: the lecture's numbers, what is not determined, and SciPy's Slerp and RotationSpline."""

from math import pi

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, RotationSpline, Slerp

from gelenk.robot.arrays import Array
from gelenk.trajectory.paths.orientation_paths import OrientationPath, axis_angle, travelled
from gelenk.trajectory.paths.rotation_rates import angular_motion, rate_matrices
from gelenk.trajectory.paths.rotation_splines import rotation_spline, vector_motion
from gelenk.trajectory.paths.zyz_paths import zyz_turns

HALF = np.array([0.5])
ENDS = np.array([0.0, 1.0])


def zyz(*triple: float) -> Array:
    return np.ascontiguousarray(Rotation.from_euler("ZYZ", triple).as_matrix())


R_I, R_F = zyz(0.2, 0.4, -0.3), zyz(1.0, 0.9, 0.5)


def angle_between(R: Array, S: Array) -> float:
    return float(Rotation.from_matrix(R.T @ S).magnitude())


def differs_by_steps(path: OrientationPath, x: Array, step: float = 1e-5) -> tuple[Array, Array]:
    """ω_x and its derivative by central differences on the rotations."""
    before, at, after = (Rotation.from_matrix(path.at(x + k * step)[0]) for k in (-1, 0, 1))
    rates = (after * before.inv()).as_rotvec() / (2.0 * step)
    changes = ((after * at.inv()).as_rotvec() - (at * before.inv()).as_rotvec()) / step**2
    return rates, changes


# The lecture's numbers


def test_the_axis_and_angle_of_the_lecture() -> None:
    """R_i = zyz(.2, .4, -.3), R_f = zyz(1, .9, .5)."""
    way = axis_angle(R_I, R_F)
    np.testing.assert_allclose(way.axis, [-0.297013915534, 0.351045593249, 0.888003223778], atol=5e-13)
    assert way.angle == pytest.approx(1.587275249684, abs=5e-13)
    np.testing.assert_allclose(R_I @ way.axis, [0.092354010294, 0.450467547491, 0.888003223778], atol=5e-13)


def test_the_peak_angular_velocity_of_the_lecture() -> None:
    """A cubic in T = 2 has its peak rate, 1.5 / T, in the middle."""
    peak = axis_angle(R_I, R_F).at(HALF)[1][0] * 1.5 / 2.0
    np.testing.assert_allclose(peak, [0.109943426062, 0.536261991689, 1.057129154056], atol=5e-13)


def test_the_middle_of_both_ways_of_the_lecture() -> None:
    by_axis, by_angles = axis_angle(R_I, R_F).at(HALF)[0][0], zyz_turns(np.array([R_I, R_F]), [False])[0].at(HALF)[0][0]
    assert angle_between(by_axis, by_angles) == pytest.approx(0.061421714469, abs=5e-13)
    np.testing.assert_allclose(by_angles, zyz(0.6, 0.65, 0.1), atol=1e-15)


# Axis and angle


def test_one_axis_against_slerp() -> None:
    x = np.linspace(0.0, 1.0, 23)
    for seed in range(20):
        both = Rotation.random(2, rng=seed)
        way = axis_angle(*both.as_matrix())
        rotations, rates, changes = way.at(x)
        np.testing.assert_allclose(rotations, Slerp([0.0, 1.0], both)(x).as_matrix(), atol=1e-14)
        np.testing.assert_allclose(rates, differs_by_steps(way, x)[0], atol=1e-9)
        assert not changes.any()
        assert way.angle == pytest.approx(travelled(way))


def test_without_a_turn_there_is_no_axis() -> None:
    way = axis_angle(R_I, R_I)
    assert not way.axis.any()
    assert way.angle == 0.0
    rotations, rates, _ = way.at(ENDS)
    np.testing.assert_array_equal(rotations, [R_I, R_I])
    assert not rates.any()


@pytest.mark.parametrize("axis", [(1, 0, 0), (0, 1, 0), (0, 0, -1), (1, 2, 2), (-1, 2, -2), (0, -3, 4)])
def test_half_a_turn_is_about_the_axis_of_positive_sign(axis: tuple[float, float, float]) -> None:
    r = np.array(axis) / np.linalg.norm(axis)
    for tilt in (0.0, 3e-16, -3e-16, 1e-12, -1e-12):
        R_f = R_I @ Rotation.from_rotvec((pi + tilt) * r).as_matrix()
        way = axis_angle(R_I, R_f)
        assert way.angle == pytest.approx(pi, abs=2e-12)
        assert next(c for c in way.axis if abs(c) > 1e-6) > 0.0, "whatever rounding says"
        np.testing.assert_allclose(way.at(ENDS)[0], [R_I, R_f], atol=5e-16 + 5e-15)


def test_the_lecture_s_half_turn() -> None:
    """Axis (1, 2, 2)/3 at θ = π: R = [-7/9 4/9 4/9; 4/9 -1/9 8/9; 4/9 8/9 -1/9]."""
    R = np.array([[-7.0, 4.0, 4.0], [4.0, -1.0, 8.0], [4.0, 8.0, -1.0]]) / 9.0
    np.testing.assert_allclose(axis_angle(np.eye(3), R).axis, np.array([1.0, 2.0, 2.0]) / 3.0, atol=1e-15)


# Through several


@pytest.mark.parametrize("count", [2, 3, 4, 9])
def test_the_spline_is_that_of_scipy(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(RotationSpline, "TOL", 1e-15)
    monkeypatch.setattr(RotationSpline, "MAX_ITER", 100)
    x = np.linspace(0.0, 1.0, 101)
    for seed in range(3):
        rng = np.random.default_rng(seed)
        rotations = Rotation.from_rotvec(np.cumsum(rng.normal(0.0, 0.6, (count, 3)), axis=0))
        knots = np.concatenate(([0.0], np.cumsum(rng.uniform(0.3, 1.0, count - 1))))
        knots /= knots[-1]
        theirs, mine = RotationSpline(knots, rotations), rotation_spline(rotations.as_matrix(), knots)
        at, rates, changes = mine.at(x)
        np.testing.assert_allclose(at, theirs(x).as_matrix(), atol=1e-10)
        np.testing.assert_allclose(rates, theirs(x).apply(theirs(x, 1)), atol=1e-8)
        np.testing.assert_allclose(changes, theirs(x).apply(theirs(x, 2)), atol=1e-6)


def test_the_spline_passes_its_knots_smoothly() -> None:
    rotations, knots = Rotation.random(7, rng=3).as_matrix(), np.linspace(0.0, 1.0, 7)
    path = rotation_spline(rotations, knots)
    np.testing.assert_allclose(path.at(knots)[0], rotations, atol=1e-14)
    before, after = path.at(knots[1:-1] - 1e-9), path.at(knots[1:-1] + 1e-9)
    scale = float(np.abs(path.at(np.linspace(0.0, 1.0, 200))[2]).max())
    np.testing.assert_allclose(before[1], after[1], atol=1e-8 * scale)
    np.testing.assert_allclose(before[2], after[2], atol=1e-5 * scale)
    x = np.linspace(0.01, 0.99, 60)
    np.testing.assert_allclose(path.at(x)[1], differs_by_steps(path, x, 1e-6)[0], atol=1e-6 * scale)


# The rates of rotation vectors


@pytest.mark.parametrize("size", [0.0, 1e-9, 1e-5, 1e-2, 0.5, 0.999999, 1.000001, 2.0, 3.1, 5.0])
def test_rates_of_a_rotation_vector_by_differences(size: float) -> None:
    rng = np.random.default_rng(0)
    thetas = rng.normal(size=(8, 3))
    thetas *= size / np.linalg.norm(thetas, axis=1)[:, None]
    first, second = rng.normal(size=(2, 8, 3))

    def at(t: float) -> Rotation:
        return Rotation.from_rotvec(thetas + t * first + 0.5 * t * t * second)

    step = 1e-4
    before, here, after = at(-step), at(0.0), at(step)
    rates = here.inv().apply((after * before.inv()).as_rotvec() / (2.0 * step))
    changes = here.inv().apply(((after * here.inv()).as_rotvec() - (here * before.inv()).as_rotvec()) / step**2)
    omegas, alphas = angular_motion(thetas, first, second)
    np.testing.assert_allclose(omegas, rates, atol=1e-6)
    np.testing.assert_allclose(alphas, changes, atol=1e-5)
    np.testing.assert_allclose(np.einsum("nij,nj->ni", rate_matrices(thetas), first), omegas)
    if size < pi:
        rotations = np.ascontiguousarray(Rotation.from_rotvec(thetas).as_matrix())
        for found, given in zip(vector_motion(rotations, omegas, alphas), (thetas, first, second), strict=True):
            np.testing.assert_allclose(found, given, atol=1e-12)
