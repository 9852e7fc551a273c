"""Poses of every robot of the catalogue against an independent product of transforms, and against Pinocchio."""

import numpy as np
import pytest

from gelenk.errors import FrameNotOnChain, UnknownFrame
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.poses import Poses
from tests.oracles import catalogue
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, robot, samples, swept

TOLERANCE = 1e-12


@pytest.mark.parametrize("name", swept(catalogue.URDFS))
def test_every_leaf_of_every_description(name: str) -> None:
    machine, product = robot(name), UrdfProduct(catalogue.urdf_text(name))
    assert list(machine.description.leaves) == product.leaves
    for leaf in product.leaves:
        chain = machine.chain(machine.description.root, leaf)
        qs = samples(chain, 200)
        Ts = Poses(*chain_poses(chain.flat, qs)).matrices()
        assert np.abs(Ts - product.poses(product.root, leaf, by_name(chain, qs))).max() < TOLERANCE, leaf


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_every_leaf_of_every_robot_through_pinocchio(name: str) -> None:
    machine = robot(name)
    for leaf in machine.description.leaves:
        chain = machine.chain(machine.description.root, leaf)
        qs = samples(chain, 16, seed=1)
        certificate = certify_poses(machine, chain, qs, {leaf: Poses(*chain_poses(chain.flat, qs))})
        assert certificate.samples == 16
        assert max(certificate.max_position_error, certificate.max_orientation_error) < TOLERANCE, leaf


@pytest.mark.parametrize("name", ["baxter", "panda", "talos", "ur5_dh", "stanford"])
def test_all_frames_of_a_chain(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, 20)
    frames = machine.frames_on(chain)
    answer = forward_kinematics(machine, chain, qs, frames)
    assert list(answer.frames) == list(frames)
    assert {chain.base_frame, chain.tip_frame} <= set(frames)
    for frame, poses in answer.frames.items():
        part, columns = machine.frame_on(chain, frame)
        alone = forward_kinematics(machine, part, np.ascontiguousarray(qs[:, columns])).poses
        assert np.array_equal(poses.matrices(), alone.matrices()), frame
    assert np.array_equal(answer.frames[chain.tip_frame].matrices(), answer.poses.matrices())
    assert np.array_equal(answer.frames[chain.base_frame].matrices(), np.tile(np.eye(4), (20, 1, 1)))


def test_frames_that_cannot_be_given() -> None:
    panda = robot("panda")
    arm = panda.chain("panda_link0", "panda_link8")
    with pytest.raises(UnknownFrame):
        forward_kinematics(panda, arm, samples(arm, 1), ["nowhere"])
    with pytest.raises(FrameNotOnChain):
        forward_kinematics(panda, arm, samples(arm, 1), ["panda_leftfinger"])


def test_no_configuration() -> None:
    panda = robot("panda")
    chain = panda.chain(None, None)
    answer = forward_kinematics(panda, chain, np.empty((0, len(chain))), ["panda_link3"])
    assert answer.poses.matrices().shape == (0, 4, 4)
    assert len(answer.frames["panda_link3"]) == answer.certificate.samples == 0


@pytest.mark.parametrize(("base", "tip"), [("panda_hand", "panda_hand"), ("panda_hand", "panda_hand_tcp")])
def test_no_joint(base: str, tip: str) -> None:
    panda = robot("panda")
    answer = forward_kinematics(panda, panda.chain(base, tip), np.empty((3, 0)))
    expected = UrdfProduct(catalogue.urdf_text("panda")).poses(base, tip, {})
    assert len(answer.poses) == 3
    assert np.abs(answer.poses.matrices() - expected).max() < 1e-15


def test_far_positions_keep_their_digits() -> None:
    """A turn by q and by q + 2000 π is the same but for the rounding of q."""
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    qs = samples(chain, 20)
    near, far = (forward_kinematics(ur5, chain, q).poses.matrices() for q in (qs, qs + 2000 * np.pi))
    assert np.abs(near - far).max() < 1e-11
