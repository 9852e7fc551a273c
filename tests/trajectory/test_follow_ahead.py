"""Looking ahead over the self-motion: lines that only another use of the spare joint follows, judged by Pinocchio."""

from dataclasses import replace
from itertools import islice

import numpy as np
import pytest

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.trajectory.follow import follow as follow_module
from gelenk.trajectory.follow.ahead import guides, ways_on
from gelenk.trajectory.follow.follow import follow
from gelenk.trajectory.follow.integrate import traced
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.follow.rows import CountedRows
from gelenk.trajectory.paths.paths import line
from gelenk.trajectory.problem.problem import Following
from tests.robots import robot
from tests.trajectory.figures_redundancy import Lines
from tests.trajectory.test_follow import XY, deviations, moved, pinocchio_poses, pose, smallest_sigma

TOLERANCES = (1e-4, 1e-3)
HARD = [("talos", 35, 5), pytest.param("simple_humanoid", 75, 71, marks=pytest.mark.slow)]
"""Lines, by arm, number and seed, along which the shortest joint rates meet a limit after 83 and 53 %; the second only
goes on if the elbow turns before the tip has moved far."""


@pytest.mark.parametrize(("name", "number", "seed"), HARD)
def test_a_line_is_followed_where_the_shortest_rates_meet_a_limit(name: str, number: int, seed: int) -> None:
    lines = Lines(name, number + 1, seed)
    path, q = lines.jobs()[number]
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


@pytest.mark.parametrize("directions", [FULL_POSE, Task(("x", "y", "z"))], ids=["pose", "position"])
def test_the_ways_on_are_those_of_singular_values(directions: Task) -> None:
    chain, rng = robot("panda").chain(None, None), np.random.default_rng(3)
    m, n = len(directions), len(chain)
    J, rates = rng.normal(size=(50, m, n)), rng.normal(size=(50, m))
    J[:, 0] = J[:, 1] + rng.uniform(0.01, 1.0, 50)[:, None] * J[:, 0]
    ways, sigmas = ways_on(CountedRows(np.zeros((50, m)), J, rates))
    for k in range(50):
        np.testing.assert_allclose(ways[k, 0], np.linalg.pinv(J[k]) @ rates[k], rtol=1e-3)
        np.testing.assert_allclose(J[k] @ ways[k, 1:].T, 0.0, atol=1e-5)
        np.testing.assert_allclose(ways[k, 1:] @ ways[k, 1:].T, np.eye(n - m), atol=1e-5)
    ratios = sigmas / np.linalg.svd(J, compute_uv=False)[:, -1]
    assert ratios.min() > 6.0 ** (-1.0 / 16.0)
    assert ratios.max() < 1.001


def test_no_guide_is_sought_to_an_end_beyond_the_joint_limits(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = robot("planar_3r")
    chain = replace(arm.chain(None, None), lower=np.array([-3.0, 0.5, 0.4]), upper=np.array([3.0, 1.5, 0.8]))
    q = np.array([0.3, 0.9, 0.6])
    T = pose(chain, q)
    # Stretched, which the limits of the second and third joint do not allow.
    path = line(T, pose(chain, np.array([0.3, 0.0, 0.0])))
    monkeypatch.setattr(follow_module, "guides", lambda *_: pytest.fail("looked ahead"))
    stop = follow(arm, chain, path, q, Following(task=XY)).stop
    assert stop is not None
    assert "; the end of the path: solvable only beyond the joint limits" in stop.detail
    assert "looking ahead" not in stop.detail


def test_a_guide_ends_exactly_where_its_path_does() -> None:
    """What was missing for rounding became a piece of no length, along which no motion could be timed."""
    lines, ends = Lines("panda", 20), []
    for path, q in lines.jobs():
        field = RateField(lines.chain, path, FULL_POSE, TOLERANCES, 0.01)
        ends += [(guide.breaks[0], guide.breaks[-1] - path.extent) for guide in islice(guides(field, q), 1)]
    assert len(ends) > 5
    assert set(ends) == {(0.0, 0.0)}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "g1"])
def test_what_is_not_followed_is_not_feasible(name: str) -> None:
    lines = Lines(name, 8)
    stopped = [(path, q) for path, q in lines.jobs() if lines.followed(path, q).stop is not None]
    assert 0 < len(stopped) < 8
    for path, q in stopped:
        assert not lines.is_feasible(path, q)
