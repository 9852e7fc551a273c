"""Ways by the Euler angles ZYZ: both branches, where they degenerate, through several orientations and over corners."""

from itertools import pairwise
from math import pi

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from gelenk.robot.arrays import Array
from gelenk.trajectory.paths.orientation_paths import OrientationPath
from gelenk.trajectory.paths.zyz_paths import ZyzPath, zyz_spline, zyz_triples, zyz_turns
from tests.trajectory.test_orientation_paths import ENDS, angle_between, differs_by_steps, zyz

KNOTS = np.array([0.0, 0.3, 0.45, 1.0])


def turns_by(path: OrientationPath) -> None:
    x = np.linspace(0.01, 0.99, 40)
    _, rates, changes = path.at(x)
    by_steps = differs_by_steps(path, x)
    np.testing.assert_allclose(rates, by_steps[0], atol=1e-6)
    np.testing.assert_allclose(changes, by_steps[1], atol=2e-3)


def rotations(count: int, seed: int) -> Array:
    return np.ascontiguousarray(Rotation.random(count, rng=seed).as_matrix())


def both_branches(start: Array, end: Array) -> list[ZyzPath]:
    """The turns that keep the sign of θ and that change it."""
    return [zyz_turns(np.array([start, end]), [flip])[0] for flip in (False, True)]


def change(path: ZyzPath) -> Array:
    """The change of the angles along the whole turn."""
    difference: Array = path.triple_at(1.0) - path.triple_at(0.0)
    return difference


def test_both_branches_of_zyz_arrive() -> None:
    for seed in range(20):
        start, end = Rotation.random(2, rng=seed).as_matrix()
        regular, flipped = both_branches(start, end)
        assert flipped.triple_at(1.0)[1] < 0.0
        for path in (regular, flipped):
            np.testing.assert_allclose(path.at(ENDS)[0], [start, end], atol=1e-14)
            assert np.abs(change(path)[[0, 2]]).max() <= pi
            assert path.angle >= angle_between(start, end) - 1e-9, "one axis is the shortest way"
            turns_by(path)


def test_zyz_goes_the_short_way_round() -> None:
    path = both_branches(zyz(3.0, 0.5, -3.0), zyz(-3.0, 0.5, 3.0))[0]
    np.testing.assert_allclose(change(path), [2.0 * pi - 6.0, 0.0, 6.0 - 2.0 * pi], atol=1e-13)


@pytest.mark.parametrize("theta", [0.0, pi])
def test_zyz_where_it_degenerates(theta: float) -> None:
    """The angle that is not determined is that of the other end, so that φ does not move for nothing."""
    flat, regular = zyz(0.4, theta, 0.5), zyz(1.0, 0.9, 0.5)
    for start, end in ((flat, regular), (regular, flat), (flat, flat)):
        for path in both_branches(start, end):
            np.testing.assert_allclose(path.at(ENDS)[0], [start, end], atol=1e-14)
        assert change(both_branches(start, end)[0])[0] == pytest.approx(0.0, abs=1e-15)
    assert not change(both_branches(flat, flat)[0]).any()


@pytest.mark.parametrize("flips", [(False, False, False), (True, False, False), (True, True, False)])
def test_a_spline_of_the_angles_passes_all_and_is_smooth(flips: tuple[bool, ...]) -> None:
    for seed in range(6):
        wanted = rotations(4, seed)
        path = zyz_spline(wanted, KNOTS, flips)
        np.testing.assert_allclose(path.at(KNOTS)[0], wanted, atol=1e-13)
        signs = np.logical_xor.accumulate([False, *flips])
        triples = path.angles.at(KNOTS)
        assert ((triples[:, 1] < 0.0) == signs).all()
        assert (np.abs(np.diff(triples[:, [0, 2]], axis=0)) <= pi + 1e-12).all(), "the short way round"
        x = np.linspace(0.0, 1.0, 50)
        by_scipy = CubicSpline(KNOTS, triples, bc_type="natural")(x)
        np.testing.assert_allclose(path.at(x)[0], Rotation.from_euler("ZYZ", by_scipy).as_matrix(), atol=1e-12)
        turns_by(path)
        below, above = path.at(KNOTS[1:-1] - 1e-12), path.at(KNOTS[1:-1] + 1e-12)
        for i in (1, 2):
            np.testing.assert_allclose(below[i], above[i], atol=1e-7)


def test_a_spline_of_two_is_the_straight_way() -> None:
    ends = rotations(2, 3)
    x = np.linspace(0.0, 1.0, 21)
    for straight, flip in zip(both_branches(*ends), (False, True), strict=True):
        curve = zyz_spline(ends, ENDS, [flip])
        for one, other in zip(straight.at(x), curve.at(x), strict=True):
            np.testing.assert_allclose(one, other, atol=1e-12)
        assert curve.angle == pytest.approx(straight.angle, rel=1e-9)


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("theta", [0.0, pi])
def test_a_degenerate_orientation_takes_the_angle_of_its_neighbour(place: int, theta: float) -> None:
    wanted = rotations(4, 11)
    wanted[place] = zyz(0.7, theta, -0.2)
    triples = zyz_triples(wanted, [False, True, False])
    neighbour = 1 if place == 0 else place - 1
    assert abs(np.remainder(triples[place, 0] - triples[neighbour, 0] + pi, 2.0 * pi) - pi) < 1e-12
    np.testing.assert_allclose(Rotation.from_euler("ZYZ", triples).as_matrix(), wanted, atol=1e-13)


def test_orientations_that_are_all_degenerate_turn_about_one_axis() -> None:
    wanted = np.array([zyz(angle, 0.0, 0.0) for angle in (0.2, 1.0, 2.5)])
    triples = zyz_triples(wanted, [False, False])
    np.testing.assert_allclose(triples[:, 0], triples[0, 0], atol=1e-15)
    np.testing.assert_allclose(np.diff(triples[:, 2]), [0.8, 1.5], atol=1e-14)


def test_turns_in_a_row_begin_where_the_one_before_ends() -> None:
    wanted = rotations(5, 4)
    turns = zyz_turns(wanted, [False, True, True, False])
    assert [turn.triple_at(1.0)[1] < 0.0 for turn in turns] == [False, True, False, False]
    for before, after in pairwise(turns):
        np.testing.assert_allclose(before.triple_at(1.0), after.triple_at(0.0), atol=1e-15)
    for turn, pair in zip(turns, pairwise(wanted), strict=True):
        np.testing.assert_allclose(turn.at(ENDS)[0], pair, atol=1e-13)
