"""The pose of one configuration: to the last bit that of a batch, with the same certificate, and withheld if wrong."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.poses.quick import QuickPose, poses_in
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.chain import Chain
from gelenk.robot.notations import quaternions_xyzw_from_rotations
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.robots import robot, samples

ENDS = [
    ("panda", None, None),
    ("baxter", "left_gripper", "right_gripper"),
    ("panda", "panda_rightfinger", "panda_link2"),
    ("panda", "panda_link7", "panda_link8"),
]
every_chain = pytest.mark.parametrize("ends", ENDS, ids=["arm", "across", "up from a follower", "without joints"])


def machine_and_chain(ends: tuple[str, str | None, str | None]) -> tuple[RobotModel, Chain]:
    machine = robot(ends[0])
    return machine, machine.chain(*ends[1:])


@every_chain
def test_it_is_that_of_a_batch(ends: tuple[str, str | None, str | None]) -> None:
    machine, chain = machine_and_chain(ends)
    for q in samples(chain, 50):
        found, poses = QuickPose(machine, chain)(q.tolist()), Poses(*chain_poses(chain.flat, q[None]))
        assert found is not None
        assert np.array_equal(Poses(*poses_in(found[0])).matrices(), poses.matrices())
        assert np.array_equal(found[0][12:], quaternions_xyzw_from_rotations(poses.rotations)[0])
        assert found[1] == certify_poses(machine, chain, q[None], {chain.tip_frame: poses})


@pytest.mark.parametrize("q", [[0.0] * 6, [0.0] * 8, [1e7] + [0.0] * 6, [0.0] * 6 + [float("nan")]])
def test_it_leaves_what_is_refused_to_others(q: list[float]) -> None:
    machine, chain = machine_and_chain(ENDS[0])
    assert QuickPose(machine, chain)(q) is None


@every_chain
@pytest.mark.parametrize(("entry", "quantity"), [(9, "position"), (1, "orientation")])
def test_a_wrong_one_is_withheld(ends: tuple[str, str | None, str | None], entry: int, quantity: str) -> None:
    machine, chain = machine_and_chain(ends)
    placements = chain.flat.placements.copy()
    placements[-1, entry] += 1e-6
    wrong = QuickPose(machine, replace(chain, flat=chain.flat._replace(placements=placements)))
    with pytest.raises(CertificationFailed, match=quantity):
        wrong(samples(chain, 1)[0].tolist())


def test_threads_share_it() -> None:
    machine, chain = machine_and_chain(ENDS[0])
    qs = samples(chain, 400)
    expected = Poses(*chain_poses(chain.flat, qs)).positions
    with ThreadPoolExecutor(8) as threads:
        found = [one[0][:3] for one in threads.map(QuickPose(machine, chain), qs) if one]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-14)
