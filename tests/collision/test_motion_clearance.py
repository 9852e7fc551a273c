"""The clearance of a motion between its samples, against samples a hundred times as dense."""

import numpy as np
import pytest

from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import find_bodies
from gelenk.collision.scene import Obstacle, half_space
from gelenk.trajectory.audit.contact.search import least_slack
from gelenk.trajectory.audit.pieces import pieces_of
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from tests.collision.arms import arm, obstacles, world
from tests.collision.motions import RESOLUTION, checked, random_motion

WORLD = world()


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_no_denser_sample_is_in_contact_where_a_motion_is_free(seed: int) -> None:
    rng, free = np.random.default_rng(seed), 0
    for _ in range(200 if seed else 5):
        found = checked(WORLD.flat, random_motion(rng, WORLD.chain), 100.0 if seed else 10.0)
        assert found.faults == ()
        free += found.free_until == np.inf
    assert free


def test_a_half_space_on_a_moving_link_sweeps_what_stands_still() -> None:
    robot = arm()
    plane = half_space("shield", "l3", np.array([1.0, 0.0, 0.0]), -0.3, np.eye(4))
    scene = *obstacles()[1:3], Obstacle("shield", (plane,), "l3")
    own = find_bodies(robot.description, lambda _: None)
    here = build_world(robot, robot.chain("l0", "left"), own, scene)  # With a finger that slides, and its mirror.
    rng = np.random.default_rng(0)
    assert all(checked(here.flat, random_motion(rng, here.chain), 10.0).faults == () for _ in range(5))


def test_a_touch_between_samples_is_found_where_it_is() -> None:
    # The first joint turns the arm, stretched out along x, through a box that it passes in a hundredth of the time.
    q = np.array([-1.0, 0.5 * np.pi, 0.0, 0.0])
    turn = PiecewisePolynomial(np.array([0.0, 1.0]), np.array([q, [2.0, 0.0, 0.0, 0.0]])[None])
    least = least_slack(WORLD.flat, pieces_of(turn), RESOLUTION)
    assert np.isfinite(least.free_until)
    assert WORLD.names[WORLD.flat.pairs[least.pair, 1]] == "box"
    part = PiecewisePolynomial(np.array([0.0, least.free_until]), turn.coefficients)
    assert least_slack(WORLD.flat, pieces_of(part), RESOLUTION).slack == pytest.approx(0.0, abs=2e-6)


def test_standing_still_is_a_motion_too() -> None:
    for q, is_free in ((np.array([0.0, 0.0, 0.0, 0.0]), True), (np.array([0.2, 1.5, 0.0, 0.0]), False)):
        still = PiecewisePolynomial(np.array([0.0, 1e-9]), q[None, None])
        least = least_slack(WORLD.flat, pieces_of(still), RESOLUTION)
        assert (least.free_until == np.inf) == is_free == (least.slack > 0.0)
