"""The joint path found all at once is the one traced from knot to knot, and there is none where that has an end."""

import numpy as np
import pytest

from gelenk.ik.search.task import FULL_POSE
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.exact import refined
from gelenk.trajectory.follow.follow import _joint_path
from gelenk.trajectory.follow.integrate import traced
from gelenk.trajectory.follow.kernels.elimination import beside, rates_at
from gelenk.trajectory.follow.rate_field import RateField
from gelenk.trajectory.follow.swept import swept
from gelenk.trajectory.problem.problem import Following
from tests.robots import robot
from tests.trajectory.test_follow import KINDS, pose, random_path, starts
from tests.trajectory.test_follow_nearest import TWIST, judged

STEP = 1e-4


def field_along(name: str, kind: str, size: float, seed: int) -> tuple[RateField, Array]:
    chain, following, rng = robot(name).chain(None, None), Following(), np.random.default_rng(seed)
    q = starts(chain, FULL_POSE, 1, seed)[0]
    path = random_path(kind, pose(chain, q), rng, FULL_POSE, size)
    tolerances = following.position_tolerance, following.orientation_tolerance
    return RateField(chain, path, FULL_POSE, tolerances, following.min_singular_value), q


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_it_is_the_path_traced_from_knot_to_knot(name: str, kind: str) -> None:
    found = 0
    for seed in range(4):
        field, q = field_along(name, kind, 0.04, seed)
        trace, whole = traced(field, q), swept(field, q)
        assert whole is None or trace.ending == "complete"
        if whole is None:
            continue
        found += 1
        assert (whole[1] <= field.tolerances).all()
        s = np.linspace(0.0, field.path.extent, 300)
        quintics = whole[0], _joint_path(trace, None).positions
        one, other = (refined(field, each)[0].at(s) for each in quintics)
        # Of a redundant arm, the same path of the tip leaves open how the spare joint drifts.
        assert np.abs(one - other).max() < (5e-4 if field.is_redundant else 1e-5)
    assert found


@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_it_has_no_answer_where_the_trace_has_an_end(name: str) -> None:
    ends = set()
    for seed in range(12):
        field, q = field_along(name, "line", 0.8, seed)
        trace = traced(field, q)
        if trace.ending != "complete":
            ends.add(trace.ending)
            assert swept(field, q) is None
    assert ends >= {"threshold"}


@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_rates_beside_given_ones_are_exact_and_keep_the_spare_motion(name: str) -> None:
    machine, rng = robot(name), np.random.default_rng(0)
    chain, count = machine.chain(None, None), 5
    qs = np.array(starts(chain, FULL_POSE, count))
    poses = [judged(machine, chain, q)[0] for q in qs]
    places = np.array([one.translation for one in poses]), np.array([one.rotation for one in poses])
    given = np.stack((qs + 1e-3 * rng.normal(size=qs.shape), *rng.normal(size=(2, *qs.shape))))
    bends = rng.normal(size=(count, 6))
    exact, lasts = beside(chain.flat, *places, np.tile(TWIST, (count, 1)), bends, given, 4)
    assert (lasts < 1e-10).all()
    for i in range(count):
        q, dq, ddq = exact[:, i]
        judge, J = judged(machine, chain, q)
        assert np.abs(judge.homogeneous - poses[i].homogeneous).max() < 1e-10
        assert J @ dq == pytest.approx(TWIST, abs=1e-10)
        changes = [judged(machine, chain, q + k * STEP * dq)[1] for k in (-1, 1)]
        assert J @ ddq == pytest.approx(bends[i] - (changes[1] - changes[0]) @ dq / (2.0 * STEP), abs=1e-5)
        spare = np.eye(len(q)) - np.linalg.pinv(J) @ J
        assert spare @ dq == pytest.approx(spare @ given[1, i], abs=1e-9)
        assert spare @ ddq == pytest.approx(spare @ given[2, i], abs=1e-9)


@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_rates_by_elimination_are_the_shortest_and_sigma_is_bounded_from_below(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = np.array(starts(chain, FULL_POSE, 9))
    rates, sigmas = rates_at(chain.flat, np.tile(TWIST, (len(qs), 1)), qs)
    for q, rate, bound in zip(qs, rates, sigmas, strict=True):
        J = judged(machine, chain, q)[1]
        least = np.linalg.svd(J, compute_uv=False)[-1]
        assert rate == pytest.approx(np.linalg.pinv(J) @ TWIST, abs=1e-8)
        assert 1.0 / np.linalg.norm(np.linalg.pinv(J)) == pytest.approx(bound, rel=1e-8)
        assert bound <= least <= np.sqrt(6.0) * bound


def test_elimination_notices_a_lost_rank() -> None:
    chain = robot("ur5").chain(None, None)
    qs = np.array(starts(chain, FULL_POSE, 9))
    qs[4, 4] = 0.0
    given, poses = np.stack((qs, qs, qs)), chain_poses(chain.flat, qs)
    lasts = beside(chain.flat, *poses, np.zeros((9, 6)), np.zeros((9, 6)), given, 1)[1]
    _, sigmas = rates_at(chain.flat, np.tile(TWIST, (9, 1)), qs)
    assert np.flatnonzero(np.isnan(lasts)).tolist() == np.flatnonzero(sigmas == 0.0).tolist() == [4]
