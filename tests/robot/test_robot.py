"""Chains between any two frames of a robot, against a product of transforms read from the XML."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from gelenk.errors import FrameNotOnChain, UnknownFrame, UnsupportedJoint
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.corpus.urdf import AXIS, MOVING, arm_and, joint, link, robot as urdf
from tests.oracles import catalogue
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, robot, samples, swept

TREES = [
    "anymal_b_kinova",
    "baxter",
    "double_pendulum_continuous",
    "human",
    "icub",
    "panda",
    "pr2",
    "tiago_dual",
    "talos",
]
"""Robots with many arms, mimic joints, continuous joints, sliding joints."""


def poses(machine: RobotModel, base: str, tip: str, count: int = 20) -> tuple[Poses, dict[str, np.ndarray]]:
    """T_base_tip at some configurations of the chain, and these by joint name."""
    chain = machine.chain(base, tip)
    qs = samples(chain, count)
    return Poses(*chain_poses(chain.flat, qs)), by_name(chain, qs)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", TREES)
def test_chains_between_any_two_frames(name: str) -> None:
    machine, product = robot(name), UrdfProduct(catalogue.urdf_text(name))
    rng = np.random.default_rng(0)
    for base, tip in rng.choice(machine.description.frames, (40, 2)):
        Ts_base_tip, q = poses(machine, str(base), str(tip))
        expected = product.poses(base, tip, q)
        assert np.abs(Ts_base_tip.matrices() - expected).max() < 1e-12, (base, tip)
        assert set(q) >= set(product.variables(base)) ^ set(product.variables(tip))


@pytest.mark.parametrize("name", TREES)
def test_the_way_back_undoes_the_way(name: str) -> None:
    machine = robot(name)
    rng = np.random.default_rng(1)
    for a, b in rng.choice(machine.description.frames, (20, 2)):
        there, back = machine.chain(str(a), str(b)), machine.chain(str(b), str(a))
        assert set(there.joint_names) == set(back.joint_names)
        qs = samples(there, 10)
        order = [there.joint_names.index(joint) for joint in back.joint_names]
        Ts_a_b = Poses(*chain_poses(there.flat, qs)).matrices()
        Ts_b_a = Poses(*chain_poses(back.flat, np.ascontiguousarray(qs[:, order]))).matrices()
        assert np.abs(Ts_a_b @ Ts_b_a - np.eye(4)).max() < 1e-13


def test_joints_stand_from_base_to_tip() -> None:
    names = robot("baxter").chain("left_gripper", "right_gripper").joint_names
    order = ["s0", "s1", "e0", "e1", "w0", "w1", "w2"]
    assert list(names) == [f"left_{joint}" for joint in reversed(order)] + [f"right_{joint}" for joint in order]


def test_a_frame_seen_from_itself_does_not_move() -> None:
    chain = robot("panda").chain("panda_hand", "panda_hand")
    assert (len(chain), chain.lower.shape, chain.flat.joints.shape) == (0, (0,), (0, 2))


# Joints that follow others


@pytest.mark.parametrize(
    ("base", "tip"),
    [
        ("panda_leftfinger", "panda_rightfinger"),
        ("panda_hand", "panda_rightfinger"),
        ("panda_rightfinger", "panda_hand"),
    ],
)
def test_the_leader_counts_also_from_outside(base: str, tip: str) -> None:
    panda = robot("panda")
    Ts, q = poses(panda, base, tip)
    assert list(q) == ["panda_finger_joint1"]
    assert np.abs(Ts.matrices() - UrdfProduct(catalogue.urdf_text("panda")).poses(base, tip, q)).max() < 1e-14


FINGERS = urdf(
    *(link(name) for name in ("palm", "first", "second", "third", "thumb")),
    joint("follower", "palm", "first", MOVING + '<mimic joint="middle" multiplier="2" offset="0.1"/>'),
    joint("middle", "first", "second", MOVING + '<mimic joint="leader" multiplier="-3" offset="0.2"/>'),
    joint("own", "second", "third", '<axis xyz="0 1 0"/><limit lower="-1" upper="1"/>'),
    joint("leader", "palm", "thumb", '<origin xyz="0 1 0"/>' + MOVING),
)
"""Two followers in a row, of a leader that comes last and lies elsewhere; both turn about z, at no distance."""


def test_followers_of_followers() -> None:
    chain = RobotModel(read_urdf(FINGERS)).chain("palm", "second")
    assert chain.joint_names == ("leader",)
    qs = np.array([[0.0], [0.3]])
    first = 2 * (-3 * qs[:, 0] + 0.2) + 0.1
    turns = first + -3 * qs[:, 0] + 0.2
    _, Rs = chain_poses(chain.flat, qs)
    assert np.arctan2(Rs[:, 1, 0], Rs[:, 0, 0]) == pytest.approx(turns - 2 * np.pi * np.round(turns / (2 * np.pi)))


@pytest.mark.parametrize(
    ("base", "tip", "names"),
    [
        ("palm", "third", ("leader", "own")),
        ("third", "palm", ("own", "leader")),
        ("third", "thumb", ("own", "leader")),
        ("thumb", "third", ("leader", "own")),
        ("second", "third", ("own",)),
        ("thumb", "first", ("leader",)),
    ],
)
def test_a_leader_stands_where_it_is_on_the_way_or_first_needed(base: str, tip: str, names: tuple[str, ...]) -> None:
    machine = RobotModel(read_urdf(FINGERS))
    Ts, q = poses(machine, base, tip)
    assert tuple(q) == names
    assert np.abs(Ts.matrices() - UrdfProduct(FINGERS).poses(base, tip, q)).max() < 1e-14
    qs = np.array(list(q.values())).T
    assert certify_poses(machine, machine.chain(base, tip), qs, {tip: Ts}).max_orientation_error < 1e-14


def test_a_follower_before_its_leader_does_not_change_the_order() -> None:
    names = ("base", "first", "second", "third")
    text = urdf(
        *map(link, names),
        joint("follower", "base", "first", MOVING + '<mimic joint="leader"/>'),
        joint("own", "first", "second"),
        joint("leader", "second", "third"),
    )
    machine = RobotModel(read_urdf(text))
    assert machine.chain("base", "third").joint_names == ("own", "leader")
    assert machine.chain("base", "second").joint_names == ("leader", "own")


# Limits


def test_limits_of_a_chain() -> None:
    chain = robot("panda").chain("panda_link0", "panda_link8")
    assert (chain.lower[3], chain.upper[3]) == (-3.0718, -0.0698)


def test_continuous_joints_have_one_number_and_no_limits() -> None:
    chain = robot("kinova").chain(None, None)
    kinds = [robot("kinova").description.joint[name].type for name in chain.joint_names]
    assert "continuous" in kinds
    for kind, lower, upper in zip(kinds, chain.lower, chain.upper, strict=True):
        assert (lower == -np.inf and upper == np.inf) == (kind == "continuous")


# Joints with more than one degree of freedom


@pytest.mark.parametrize(("kind", "body"), [("floating", ""), ("planar", AXIS)])
def test_no_chain_across_joints_with_more_than_one_degree_of_freedom(kind: str, body: str) -> None:
    origin = '<origin xyz="0 0 1"/>'
    machine = RobotModel(
        read_urdf(
            arm_and(
                *map(link, ("drone", "rotor")),
                joint("flight", "base", "drone", body, kind),
                joint("spin", "drone", "rotor", origin + MOVING),
            )
        )
    )
    assert machine.default_chain == ("base", "forearm")
    assert len(machine.chain("drone", "rotor")) == 1
    for base, tip in (("base", "rotor"), ("rotor", "forearm")):
        with pytest.raises(UnsupportedJoint) as caught:
            machine.chain(base, tip)
        assert caught.value.facts() == {"joint": "flight", "joint_type": kind, "base_frame": base, "tip_frame": tip}
    with pytest.raises(UnsupportedJoint):
        RobotModel(machine.description, ("base", "rotor"))
    chain = machine.chain("drone", "rotor")
    certify_poses(machine, chain, np.array([[0.5]]), {"rotor": Poses(*chain_poses(chain.flat, np.array([[0.5]])))})
    assert machine.frames_on(machine.chain("base", "forearm")) == ("base", "forearm")


# Frames


@pytest.mark.parametrize("ends", [("nowhere", "panda_hand"), ("panda_hand", "nowhere"), ("panda_joint1", "panda_hand")])
def test_unknown_frames(ends: tuple[str, str]) -> None:
    panda = robot("panda")
    with pytest.raises(UnknownFrame) as caught:
        panda.chain(*ends)
    assert caught.value.frame in ends
    assert caught.value.known == panda.description.frames
    with pytest.raises(UnknownFrame):
        RobotModel(panda.description, ends)
    with pytest.raises(UnknownFrame):
        panda.frame_id("nowhere")


def test_frames_that_a_chain_moves() -> None:
    panda = robot("panda")
    arm = panda.chain("panda_link0", "panda_link8")
    frames = panda.frames_on(arm)
    assert {"panda_link0", "panda_link4", "panda_hand"} <= set(frames)
    assert set(panda.description.frames) - set(frames) == {"panda_leftfinger", "panda_rightfinger"}
    with pytest.raises(FrameNotOnChain) as caught:
        panda.frame_on(arm, "panda_leftfinger")
    assert caught.value.missing_joints == ("panda_finger_joint1",)


def test_a_frame_on_a_chain_uses_the_chains_variables() -> None:
    baxter = robot("baxter")
    chain = baxter.chain("left_gripper", "right_gripper")
    part, columns = baxter.frame_on(chain, "right_upper_elbow")
    assert part.joint_names == tuple(chain.joint_names[i] for i in columns)
    assert (part.base_frame, part.tip_frame) == ("left_gripper", "right_upper_elbow")


# Default chains


@pytest.mark.parametrize("name", swept(catalogue.URDFS))
def test_default_chain_is_the_longest_from_the_root(name: str) -> None:
    product = UrdfProduct(catalogue.urdf_text(name))
    machine = RobotModel(robot(name).description)
    base, tip = machine.default_chain
    assert product.path(base) == []
    assert tip in product.leaves
    assert len(machine.chain(None, None)) == max(len(product.variables(leaf)) for leaf in product.leaves)


def test_default_chain_of_a_single_link() -> None:
    machine = RobotModel(read_urdf(urdf(link("stone"))))
    assert machine.default_chain == ("stone", "stone")
    assert len(machine.chain(None, None)) == 0


def test_of_equal_chains_the_first_in_the_document_counts() -> None:
    assert RobotModel(read_urdf(arm_and(link("twin"), joint("other", "base", "twin")))).default_chain == (
        "base",
        "forearm",
    )


def test_a_robot_is_safe_between_threads() -> None:
    panda = robot("panda")
    chain = panda.chain(None, None)
    qs = samples(chain, 400)
    Ts = Poses(*chain_poses(chain.flat, qs))

    def certify(seed: int) -> float:
        return certify_poses(panda, chain, qs, {chain.tip_frame: Ts}, seed).max_position_error

    with ThreadPoolExecutor(8) as threads:
        assert max(threads.map(certify, range(200))) < 1e-12
