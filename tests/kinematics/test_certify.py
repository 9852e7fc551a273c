"""What is withheld: answers that differ from Pinocchio's by more than rounding."""

from collections.abc import Callable

import numpy as np
import pytest

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge import judge
from gelenk.kinematics.judge.judge import (
    MAX_SAMPLES,
    TOLERANCE,
    certify_jacobians,
    certify_poses,
    pinocchio_poses,
    recomputed_poses,
)
from gelenk.kinematics.judge.placements import walk_to
from gelenk.kinematics.judge.words import Reference, View
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians, chain_poses
from gelenk.kinematics.velocity.jacobian import Representation, jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from tests.oracles.dh_columns import turn
from tests.robots import of_table, robot, rows, samples

ENDS = [
    ("panda", None, None),
    ("baxter", "left_gripper", "right_gripper"),
    ("panda", "panda_rightfinger", "panda_link2"),
]
VIEWS: dict[View, tuple[Reference, Representation]] = {
    "local_world_aligned": ("local_world_aligned", "geometric"),
    "local": ("local", "geometric"),
    "world": ("world", "geometric"),
    "zyz": ("local_world_aligned", "zyz"),
    "rpy": ("local_world_aligned", "rpy"),
}
every_chain = pytest.mark.parametrize("ends", ENDS, ids=["arm", "across", "up from a follower"])


def tampered(array: Array, amount: float) -> Array:
    """The array with one number in its last row changed."""
    changed = array.copy()
    changed[-1].flat[7 % changed[-1].size] += amount
    return changed


def turned(rotations: Array, angle: float) -> Array:
    """The rotations, the last one turned further by an angle."""
    changed = rotations.copy()
    changed[-1] = changed[-1] @ turn(1, angle)[:3, :3]
    return changed


@every_chain
def test_poses_over_placements_are_pinocchios(ends: tuple[str, str | None, str | None]) -> None:
    arm = robot(ends[0])
    chain = arm.chain(*ends[1:])
    qs = samples(chain, 200)
    ours, exact = recomputed_poses(arm, chain, qs), pinocchio_poses(arm, chain, chain.tip_frame, qs, range(200))
    np.testing.assert_allclose(ours.positions, exact.positions, rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(ours.rotations, exact.rotations, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("count", [1, 600])
@pytest.mark.parametrize(("column", "quantity"), [(1, "position"), (5, "orientation")])
def test_a_model_read_wrongly_is_noticed(
    column: int, quantity: str, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    arm = robot("panda")
    chain = arm.chain(None, None)
    wrong = walk_to(arm, chain.tip_frame).copy()
    wrong[-1, column] += 1e-6
    monkeypatch.setattr(judge, "walk_to", lambda _, frame: wrong if frame == chain.tip_frame else walk_to(_, frame))
    with pytest.raises(CertificationFailed, match=quantity):
        recomputed_poses(arm, chain, samples(chain, count))


@every_chain
@pytest.mark.parametrize(
    ("quantity", "spoil"),
    [
        ("position", lambda p, R: (tampered(p, 1e-6), R)),
        ("position", lambda p, R: (tampered(p, np.nan), R)),
        ("position", lambda p, R: (tampered(p, np.inf), R)),
        ("orientation", lambda p, R: (p, turned(R, 1e-6))),
        ("orientation", lambda p, R: (p, turned(R, np.pi))),
        ("position", lambda p, R: (p, tampered(R, np.nan))),
    ],
)
def test_a_wrong_pose_is_withheld(
    ends: tuple[str, str | None, str | None], quantity: str, spoil: Callable[[Array, Array], tuple[Array, Array]]
) -> None:
    machine = robot(ends[0])
    chain = machine.chain(*ends[1:])
    qs = samples(chain, 10)
    positions, rotations = chain_poses(chain.flat, qs)
    certificate = certify_poses(machine, chain, qs, {chain.tip_frame: Poses(positions, rotations)})
    assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-14
    with pytest.raises(CertificationFailed, match=quantity) as caught:
        certify_poses(machine, chain, qs, {chain.tip_frame: Poses(*spoil(positions, rotations))})
    assert not caught.value.error <= caught.value.tolerance


def test_a_wrong_frame_among_right_ones_is_withheld() -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    qs = samples(chain, 5)
    tip = Poses(*chain_poses(chain.flat, qs))
    with pytest.raises(CertificationFailed):
        certify_poses(ur5, chain, qs, {chain.tip_frame: tip, "wrist_2_link": tip})


@every_chain
@pytest.mark.parametrize("amount", [1e-6, -1e-6, np.nan])
@pytest.mark.parametrize("what", ["Jacobian", "derivative"])
def test_a_wrong_jacobian_is_withheld(ends: tuple[str, str | None, str | None], what: str, amount: float) -> None:
    machine = robot(ends[0])
    chain = machine.chain(*ends[1:])
    qs = samples(chain, 10)
    Js, Hs = chain_jacobians(chain.flat, qs)[2], chain_hessians(chain.flat, qs)
    certificate = certify_jacobians(machine, chain, qs, Js, Hs)
    assert certificate.max_time_variation_error is not None
    assert max(certificate.max_error, certificate.max_time_variation_error) < 1e-13
    with pytest.raises(CertificationFailed, match=what):
        if what == "Jacobian":
            certify_jacobians(machine, chain, qs, tampered(Js, amount))
        else:
            certify_jacobians(machine, chain, qs, Js, tampered(Hs, amount))


@every_chain
@pytest.mark.parametrize("amount", [1e-6, np.nan])
@pytest.mark.parametrize("view", VIEWS)
def test_a_wrong_view_of_a_right_jacobian_is_withheld(
    ends: tuple[str, str | None, str | None], view: View, amount: float
) -> None:
    machine = robot(ends[0])
    chain = machine.chain(*ends[1:])
    qs = samples(chain, 10)
    reference, representation = VIEWS[view]
    Js = jacobians(machine, chain, qs).values
    values = jacobians(machine, chain, qs, reference=reference, representation=representation).values
    assert certify_jacobians(machine, chain, qs, Js, view=view, values=values).max_error < 1e-12
    for row in (0, 5):
        wrong = values.copy()
        wrong[-1, row, -1] += amount
        with pytest.raises(CertificationFailed, match="Jacobian"):
            certify_jacobians(machine, chain, qs, Js, view=view, values=wrong)


def test_a_large_batch_is_certified_by_samples() -> None:
    panda = robot("panda")
    chain = panda.chain(None, None)
    qs = samples(chain, 1000)
    poses = Poses(*chain_poses(chain.flat, qs))
    certificate = certify_poses(panda, chain, qs, {chain.tip_frame: poses}, seed=3)
    assert (certificate.samples, certificate.seed) == (MAX_SAMPLES, 3)
    assert certificate == certify_poses(panda, chain, qs, {chain.tip_frame: poses}, seed=3)
    assert certificate != certify_poses(panda, chain, qs, {chain.tip_frame: poses}, seed=4)
    with pytest.raises(CertificationFailed):
        certify_poses(panda, chain, qs, {chain.tip_frame: Poses(poses.positions + 1e-6, poses.rotations)})


def test_rounding_of_large_numbers_is_no_error() -> None:
    """A robot of 1000 km may be off by a fraction of its size, one of a metre may not."""
    large = of_table(rows("standard", [(1e6, 0.5, 0.0, 0.0)] * 3, "RRR"))
    chain = large.chain(None, None)
    qs = samples(chain, 10)
    positions, rotations = chain_poses(chain.flat, qs)
    certify_poses(large, chain, qs, {"tool": Poses(positions + 1e-6, rotations)})
    with pytest.raises(CertificationFailed) as caught:
        certify_poses(large, chain, qs, {"tool": Poses(positions + 1.0, rotations)})
    assert TOLERANCE < caught.value.tolerance < 1.0
