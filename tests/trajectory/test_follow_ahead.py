"""Looking ahead over the self-motion: lines that only another use of the spare joint follows, judged by Pinocchio."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.trajectory.follow.ahead import guides
from gelenk.trajectory.follow.follow import follow
from gelenk.trajectory.follow.integrate import traced
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.paths.paths import line
from gelenk.trajectory.problem.problem import Following
from tests.robots import robot
from tests.trajectory.figures_redundancy import Lines
from tests.trajectory.test_follow import XY, deviations, moved, pinocchio_poses, pose, smallest_sigma

TOLERANCES = (1e-4, 1e-3)
HARD = 35
"""A line along which the shortest joint rates of Talos's arm meet a limit after 83 %."""


def test_a_line_is_followed_where_the_shortest_rates_meet_a_limit() -> None:
    lines = Lines("talos", HARD + 1)
    path, q = lines.jobs()[HARD]
    plain = traced(RateField(lines.chain, path, FULL_POSE, TOLERANCES, 0.01), q)
    assert plain.ending == "joint_limit"
    assert plain.reached < 0.9 * path.extent

    way = lines.followed(path, q)
    assert way.stop is None
    assert way.reached == path.extent
    s = np.linspace(0.0, path.extent, 300)
    qs = way.positions.at(s)
    assert np.abs(qs[0] - q).max() < 1e-12
    assert (qs >= lines.chain.lower - 1e-9).all()
    assert (qs <= lines.chain.upper + 1e-9).all()
    assert max(deviations(path.at(s).poses, pinocchio_poses(lines.robot, lines.chain, qs), FULL_POSE)) < 1e-3
    assert smallest_sigma(lines.chain, FULL_POSE, way.positions)[0] >= 0.0099


def test_a_position_in_the_plane_leaves_three_links_a_self_motion_too() -> None:
    arm = robot("planar_3r")
    chain = arm.chain(None, None)
    q, T = np.array([0.3, 0.9, 0.6]), pose(chain, np.array([0.3, 0.9, 0.6]))
    path = line(T, moved(T, np.array([-0.5, -0.6, 0.0]), np.zeros(3)))
    free = traced(RateField(chain, path, XY, TOLERANCES, 0.01), q)
    assert free.ending == "complete"
    # A limit in the middle of what the shortest rates do to the second joint.
    ends = np.array([q[1], free.pieces[-1].b.q[1]])
    lower, upper = chain.lower.copy(), chain.upper.copy()
    (upper if ends[1] > ends[0] else lower)[1] = ends.mean()
    limited = replace(chain, lower=lower, upper=upper)
    assert traced(RateField(limited, path, XY, TOLERANCES, 0.01), q).ending == "joint_limit"
    way = follow(arm, limited, path, q, Following(task=XY))
    assert way.stop is None
    s = np.linspace(0.0, path.extent, 200)
    qs = way.positions.at(s)
    assert ((qs >= lower - 1e-9) & (qs <= upper + 1e-9)).all()
    assert deviations(path.at(s).poses, pinocchio_poses(arm, chain, qs), XY)[0] < 1e-4


@pytest.mark.parametrize("directions", [FULL_POSE, Task(("x", "y", "z"))], ids=["pose", "position"])
def test_no_guide_leads_out_of_reach(directions: Task) -> None:
    chain = robot("panda").chain(None, None)
    q = np.array([0.1, -0.5, 0.2, -2.0, 0.1, 1.6, 0.8])
    T = pose(chain, q)
    path = line(T, moved(T, np.array([1.2, 0.0, 0.0]), np.zeros(3)))
    assert list(guides(RateField(chain, path, directions, TOLERANCES, 0.01), q)) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "g1"])
def test_what_is_feasible_is_followed(name: str) -> None:
    lines = Lines(name, 8)
    for path, q in lines.jobs():
        stop = lines.followed(path, q).stop
        feasible = lines.is_feasible(path, q)
        assert (stop is None) == feasible, stop
