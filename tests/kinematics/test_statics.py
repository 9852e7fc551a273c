"""Forces at rest against virtual work of independent motions, differences of energy, and the course."""

from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

import numpy as np
import pytest

import gelenk.kinematics.force.statics as module
from gelenk.errors import CertificationFailed, InvalidField, UnknownFrame
from gelenk.kinematics.dynamics.bodies import Load
from gelenk.kinematics.dynamics.mechanism import mechanism
from gelenk.kinematics.force.statics import (
    Statics,
    WrenchFrame,
    balance,
    certify_statics,
    components,
    overloaded_joints,
    statics,
)
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from tests.oracles import catalogue
from tests.oracles.differences import aligned, along
from tests.oracles.urdf_energy import UrdfEnergy
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, of_table, robot, rows, samples, swept

G = np.array([0.0, 0.0, -9.81])
Ends: TypeAlias = tuple[str, str | None, str | None]
CHAINS: dict[str, Ends] = {
    "arm": ("ur5", None, None),
    "hand with a follower": ("panda", "panda_link0", "panda_leftfinger"),
    "up from a follower": ("panda", "panda_rightfinger", "panda_link5"),
    "from gripper to gripper": ("baxter", "left_gripper", "right_gripper"),
    "up the tree": ("talos", "arm_left_7_link", "base_link"),
    "sliding joint": ("pr2", "base_footprint", "l_gripper_tool_frame"),
}
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
every_robot = pytest.mark.parametrize("name", swept(catalogue.NAMES))


def chain_of(ends: Ends) -> tuple[RobotModel, Chain]:
    machine = robot(ends[0])
    return machine, machine.chain(ends[1], ends[2])


def text_of(machine: RobotModel, name: str) -> str:
    return catalogue.urdf_text(name) if name in catalogue.URDFS else write_urdf(machine.description)


def poses_by_text(machine: RobotModel, chain: Chain, name: str) -> Callable[[str], Callable[[Array], Array]]:
    """T_base_frame as a function of configurations, from the text of the description."""
    product = UrdfProduct(text_of(machine, name))
    return lambda frame: lambda qs: product.poses(chain.base_frame, frame, by_name(chain, qs))


def certified(still: Statics, wrenches: Array) -> Array:
    """τ = Jᵀγ + g, after comparison with Pinocchio."""
    torques = still.wrench_torques(wrenches) + still.gravity_torques
    certificate = certify_statics(still, wrenches, torques)
    assert certificate.max_torque_error < 1e-10
    assert certificate.max_virtual_work_error < 1e-10
    return torques


# Virtual work


@every_robot
def test_virtual_work(name: str) -> None:
    """τᵀq̇ = γᵀv, where v is a difference of poses along q̇."""
    machine, chain = chain_of((name, None, None))
    poses = poses_by_text(machine, chain, name)(chain.tip_frame)
    rng = np.random.default_rng(0)
    qs = samples(chain, 2)
    wrenches, speeds = rng.uniform(-1, 1, (2, 6)), rng.uniform(-1, 1, qs.shape)
    torques = certified(statics(machine, chain, qs), wrenches)
    for k, q in enumerate(qs):
        twist = along(poses, q, speeds[k], aligned)
        assert torques[k] @ speeds[k] == pytest.approx(wrenches[k] @ twist, abs=1e-10)


def wrench_frames(chain: Chain) -> dict[str, WrenchFrame]:
    point = (0.1, -0.2, 0.3)
    return {
        "local": WrenchFrame("local"),
        "world": WrenchFrame("world"),
        "at a point of the tip": WrenchFrame(point=point),
        "in axes of the tip at a point of the base": WrenchFrame("local", point=point, point_frame=chain.base_frame),
        "in axes of the base by name": WrenchFrame(expressed_in=chain.base_frame),
        "in axes of the tip by name": WrenchFrame(expressed_in=chain.tip_frame, point=point),
    }


@every_chain
def test_virtual_work_at_any_point_in_any_axes(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    poses = poses_by_text(machine, chain, ends[0])
    rng = np.random.default_rng(1)
    q, q_dot, wrench = samples(chain, 1), rng.uniform(-1, 1, len(chain)), rng.uniform(-1, 1, (1, 6))
    T_base_tip = poses(chain.tip_frame)(q)[0]
    twist = along(poses(chain.tip_frame), q[0], q_dot, aligned)
    for name, frame in wrench_frames(chain).items():
        torques = certified(statics(machine, chain, q, frame), wrench)
        base_axes = frame.reference != "local" and frame.expressed_in != chain.tip_frame
        R = np.eye(3) if base_axes else T_base_tip[:3, :3]
        point = np.zeros(3) if frame.reference == "world" else T_base_tip[:3, 3]
        if frame.point is not None:
            local = frame.point_frame is None
            point = (T_base_tip[:3, :3] @ frame.point + T_base_tip[:3, 3]) if local else np.array(frame.point)
        velocity = twist[:3] + np.cross(twist[3:], point - T_base_tip[:3, 3])
        power = wrench[0, :3] @ R.T @ velocity + wrench[0, 3:] @ R.T @ twist[3:]
        assert torques[0] @ q_dot == pytest.approx(power, abs=1e-10), name


def test_a_frame_on_the_way() -> None:
    """Force along the axis of joint 4 of the UR5 at its origin: joints 4 and on feel nothing of it."""
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    frame = WrenchFrame(expressed_in="wrist_1_link", point=(0, 0, 0), point_frame="wrist_1_link")
    still = statics(ur5, chain, samples(chain, 3), frame)
    torques = certified(still, np.array([[0.0, 7.0, 0.0, 0.0, 0.0, 0.0]] * 3))
    assert np.abs(torques[:, 3]).max() < 1e-14
    assert np.abs(torques[:, :3]).max() > 0.1


def test_frames_that_cannot_be() -> None:
    panda = robot("panda")
    chain = panda.chain("panda_link0", "panda_hand")
    qs = samples(chain, 1)
    for frame, field in (
        (WrenchFrame("local", expressed_in="panda_link0"), "expressed_in"),
        (WrenchFrame("world", point=(0, 0, 0)), "point"),
        (WrenchFrame(point_frame="panda_link0"), "point_frame"),
    ):
        with pytest.raises(InvalidField) as caught:
            statics(panda, chain, qs, frame)
        assert caught.value.field == field
    with pytest.raises(UnknownFrame):
        statics(panda, chain, qs, WrenchFrame(expressed_in="nose"))


@pytest.mark.parametrize(
    ("ends", "frame"),
    [
        (("panda", "panda_link0", "panda_hand"), "panda_leftfinger"),
        (("talos", "torso_2_link", "arm_left_4_link"), "leg_right_6_link"),
        (("icub", "chest", "r_hand"), "l_foot"),
    ],
)
def test_a_frame_that_other_joints_move_is_where_they_are_at_zero(ends: Ends, frame: str) -> None:
    """A pure force of the tip, in the frame's axes through its origin: τᵀq̇ is its power by differences of poses."""
    machine, chain = chain_of(ends)
    poses = poses_by_text(machine, chain, ends[0])
    rng = np.random.default_rng(5)
    q, q_dot, wrench = samples(chain, 1), rng.uniform(-1, 1, len(chain)), rng.uniform(-1, 1, (1, 6))
    still = statics(machine, chain, q, WrenchFrame(expressed_in=frame, point=(0.0, 0.0, 0.0), point_frame=frame))
    torques = certified(still, wrench)
    T_base_frame, T_base_tip = (poses(name)(q)[0] for name in (frame, chain.tip_frame))
    twist = along(poses(chain.tip_frame), q[0], q_dot, aligned)
    velocity = twist[:3] + np.cross(twist[3:], T_base_frame[:3, 3] - T_base_tip[:3, 3])
    R = T_base_frame[:3, :3]
    power = wrench[0, :3] @ R.T @ velocity + wrench[0, 3:] @ R.T @ twist[3:]
    assert torques[0] @ q_dot == pytest.approx(power, abs=1e-9)


# The weight


@pytest.mark.quick(4)
@every_robot
def test_gravity_torques_are_the_slope_of_the_potential_energy(name: str) -> None:
    check_gravity((name, None, None))


@pytest.mark.quick(1)
@every_chain
def test_gravity_torques_of_chains_anywhere(ends: Ends) -> None:
    check_gravity(ends)


def check_gravity(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    energy = UrdfEnergy(text_of(machine, ends[0]), chain.joint_names)
    qs, gravity = samples(chain, 1), np.array([1.0, -2.0, -9.0])
    still = statics(machine, chain, qs, gravity=gravity)
    expected = energy.gravity_torques(qs[0], gravity)
    assert np.abs(still.gravity_torques[0] - expected).max() < 1e-10 * max(1.0, np.abs(expected).max())
    certified(still, np.random.default_rng(2).uniform(-5, 5, (1, 6)))


def test_a_payload_is_a_force_at_its_centre_of_mass() -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    qs = samples(chain, 4)
    load = Load(3.0, np.array([0.1, 0.2, 0.3]), np.zeros((3, 3)))
    with_load, without = (statics(ur5, chain, qs, gravity=G, load=x) for x in (load, None))
    # The payload pushes on the tip with its weight; the tip pushes back, along the root's axes.
    there = statics(ur5, ur5.chain("world", None), qs, WrenchFrame(point=(0.1, 0.2, 0.3)))
    pushed = there.wrench_torques(np.array([[0, 0, 3.0 * 9.81, 0, 0, 0]] * 4))
    assert with_load.gravity_torques - without.gravity_torques == pytest.approx(pushed, abs=1e-12)
    certified(with_load, np.zeros((4, 6)))


def test_a_large_batch_weighs_the_same_in_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    qs = samples(chain, 50)
    whole = statics(ur5, chain, qs, gravity=G)
    monkeypatch.setattr(module, "_NUMBERS_AT_ONCE", 6 * 36 * 7)
    pieces = statics(ur5, chain, qs, gravity=G)
    assert pieces.gravity_torques == pytest.approx(whole.gravity_torques, abs=1e-13)
    assert pieces.gravity_scale == whole.gravity_scale
    assert certify_statics(whole, np.zeros((50, 6)), whole.gravity_torques).samples == 16


def test_links_without_mass_are_named() -> None:
    """Of a link with a shape, or where all that moves with it has none; a mere frame is no link to be weighed."""
    text = """<robot name="arm"><link name="base"/><link name="upper"/><link name="flange"/><link name="lower">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
    <link name="tool0"/><link name="cover"><visual><geometry><sphere radius="1"/></geometry></visual></link>
    <joint name="a" type="continuous"><parent link="base"/><child link="upper"/></joint>
    <joint name="b" type="fixed"><parent link="upper"/><child link="flange"/></joint>
    <joint name="c" type="continuous"><parent link="flange"/><child link="lower"/></joint>
    <joint name="d" type="fixed"><parent link="lower"/><child link="tool0"/></joint>
    <joint name="e" type="fixed"><parent link="lower"/><child link="cover"/></joint></robot>"""
    arm = RobotModel(read_urdf(text))
    assert mechanism(arm, arm.chain("base", "tool0")).without_mass == ("upper", "flange", "cover")
    assert mechanism(robot("panda"), robot("panda").chain(None, None)).without_mass == ()


# From torques to the wrench


@every_robot
def test_torques_tell_the_wrench(name: str) -> None:
    """γ is a least squares solution of Jᵀγ = τ - g, and the shortest one; what is left lies in ker J."""
    machine, chain = chain_of((name, None, None))
    qs = samples(chain, 2)
    still = statics(machine, chain, qs, gravity=G)
    torques = np.random.default_rng(3).uniform(-10, 10, qs.shape)
    found = balance(still, torques, 1e-10)
    for k, J in enumerate(still.Js):
        expected = np.linalg.lstsq(J.T, torques[k] - still.gravity_torques[k], rcond=1e-10)[0]
        assert found.wrenches[k] == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.abs(expected).max())
        assert np.abs(J @ found.residuals[k]).max() < 1e-9
    assert certify_statics(still, found.wrenches, torques - found.residuals).max_torque_error < 1e-9


def test_there_and_back() -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    still = statics(ur5, chain, samples(chain, 5), WrenchFrame("local"), gravity=G)
    wrenches = np.random.default_rng(4).uniform(-10, 10, (5, 6))
    found = balance(still, certified(still, wrenches), 1e-10)
    assert found.wrenches == pytest.approx(wrenches, abs=1e-9)
    assert np.abs(found.residuals).max() < 1e-12


# The four subspaces


@every_robot
def test_the_four_subspaces(name: str) -> None:
    """Orthogonal and complementary: ρ, 6 - ρ, ρ, n - ρ; duality: Jᵀ maps ker(Jᵀ) to zero, J maps ker(J) to zero."""
    machine, chain = chain_of((name, None, None))
    n = len(chain)
    for qs in (samples(chain, 2), np.zeros((1, n))):
        still = statics(machine, chain, qs)
        for J, split in zip(still.Js, still.subspaces(1e-10), strict=True):
            rank = np.linalg.matrix_rank(J, tol=1e-10 * np.linalg.norm(J, 2))
            parts = split.range, split.left_kernel, split.row_space, split.kernel
            assert [part.shape[1] for part in parts] == [rank, 6 - rank, rank, n - rank]
            for inside, outside, size in ((*parts[:2], 6), (*parts[2:], n)):
                assert np.abs(inside.T @ outside).max(initial=0) < 1e-13
                assert np.abs(inside @ inside.T + outside @ outside.T - np.eye(size)).max() < 1e-12
            assert np.abs(J.T @ split.left_kernel).max(initial=0) < 1e-9
            assert np.abs(J @ split.kernel).max(initial=0) < 1e-9


@pytest.mark.parametrize(
    ("name", "q", "row"),
    [
        ("planar_2r", (np.pi, 0.0), 0),
        ("planar_2r", (np.pi / 2, 0.0), 1),
        ("spherical_wrist", (0.3, np.pi, 0.2), 2),
    ],
)
def test_rows_that_vanish_but_for_rounding_have_no_rank(name: str, q: tuple[float, ...], row: int) -> None:
    machine, chain = chain_of((name, None, None))
    still = statics(machine, chain, np.array([q]), rows=np.array([row]))
    assert 0.0 <= np.abs(still.Js).max() < 1e-15
    assert still.subspaces(1e-10)[0].rank == 0
    found = balance(still, np.ones((1, len(q))), 1e-10)
    assert found.wrenches.tolist() == [[0.0]]


def test_rounding_is_that_of_the_lever_arm() -> None:
    """About a point that is 1000 m off and back again, x does not move by more than the rounding of these 1000 m."""
    machine, chain = chain_of(("planar_2r", None, None))
    q = np.array([[0.0, 0.0]])
    tip = statics(machine, chain, q).places.positions[0]
    at_height = WrenchFrame(point=(1000.0, tip[1], 0.0), point_frame=chain.base_frame)
    still = statics(machine, machine.chain(chain.base_frame, None), q, at_height, rows=np.array([0]))
    perturbed = replace(still, Js=still.Js + 1e-13)
    assert perturbed.subspaces(1e-10)[0].rank == 0


def test_membership() -> None:
    inside, outside = np.eye(3)[:, :2], np.eye(3)[:, 2:]
    first, second, lies_in = components(inside, outside, np.array([1.0, 2.0, 3.0]), 1e-9)
    assert (first.tolist(), second.tolist(), lies_in) == ([1, 2, 0], [0, 0, 3], (False, False))
    assert components(inside, outside, np.array([1.0, 0.0, 1e-10]), 1e-9)[2] == (True, False)
    assert components(inside, outside, np.array([0.0, 0.0, -5.0]), 1e-9)[2] == (False, True)
    assert components(inside, outside, np.zeros(3), 1e-9)[2] == (True, True)


# The reference numbers of the course

PLANAR = of_table(rows("standard", [(1, 0, 0, 0), (0.7, 0, 0, 0)], "RR"))
XY = np.array([0, 1])


def planar(*q: float) -> Statics:
    """The arm of two links of 1 m and 0.7 m."""
    return statics(PLANAR, PLANAR.chain(None, None), np.array([q]), rows=XY)


def test_torques_of_the_planar_arm() -> None:
    torques = certified(planar(0.3, 0.8), np.array([[10.0, -5.0]]))
    assert torques[0] == pytest.approx([-15.557922457661, -7.826037945420], abs=1e-12)


def test_the_wrench_of_the_planar_arm_from_its_torques() -> None:
    found = balance(planar(0.3, 0.8), np.array([[-15.557922457661, -7.826037945420]]), 1e-10)
    assert found.wrenches[0] == pytest.approx([10, -5], abs=1e-11)
    assert found.residuals[0] == pytest.approx([0, 0], abs=1e-12)


def test_torques_of_the_ur5() -> None:
    ur5 = robot("ur5_dh")
    still = statics(ur5, ur5.chain(None, None), np.array([[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]]))
    torques = certified(still, np.array([[1, 2, 3, 0.1, 0.2, 0.3]]))
    expected = [-0.652271200382, -2.347825983333, -1.412590818521, -0.352395848388, -0.217813005826, -0.147187849302]
    assert torques[0] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("space", "direction"),
    [
        ("range", (0.295520206661, -0.955336489126)),
        ("left_kernel", (0.955336489126, 0.295520206661)),
        ("row_space", (0.924678098475, 0.380749805254)),
        ("kernel", (0.380749805254, -0.924678098475)),
    ],
)
def test_subspaces_of_the_stretched_arm(space: str, direction: tuple[float, float]) -> None:
    """A force along the arm needs no torque; the kernel is along (l2, -(l1 + l2)). Compared by projectors."""
    split = planar(0.3, 0.0).subspaces(1e-10)[0]
    basis = getattr(split, space)
    assert basis @ basis.T == pytest.approx(np.outer(direction, direction), abs=1e-12)


def test_a_force_along_the_stretched_arm_needs_no_torque() -> None:
    arm = planar(0.3, 0.0)
    force = np.array([[np.cos(0.3), np.sin(0.3)]])
    assert np.abs(certified(arm, 100 * force)).max() < 1e-13
    found = balance(arm, np.array([[0.7, -1.7]]), 1e-10)
    assert found.wrenches[0] == pytest.approx([0, 0], abs=1e-12)
    assert found.residuals[0] == pytest.approx([0.7, -1.7], abs=1e-12)


# Limits, nothing to do, and what is wrong


def test_joints_beyond_their_effort_limits() -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    torques = np.array([[0.0] * 6, [151.0, -149.0, 0, 0, 0, -29.0]])
    assert overloaded_joints(ur5, chain, torques) == [[], ["shoulder_pan_joint", "wrist_3_joint"]]


def test_no_configuration_and_no_joint() -> None:
    panda = robot("panda")
    arm, link = panda.chain(None, None), panda.chain("panda_link3", "panda_link3")
    for chain, count in ((arm, 0), (link, 2)):
        still = statics(panda, chain, np.zeros((count, len(chain))), gravity=G)
        wrenches = np.ones((count, 6))
        assert still.wrench_torques(wrenches).shape == (count, len(chain))
        found = balance(still, np.zeros((count, len(chain))), 1e-10)
        assert np.array_equal(found.wrenches, np.zeros((count, 6)))
        assert certify_statics(still, wrenches, still.gravity_torques).samples == 0


def test_a_wrong_number_is_never_sent() -> None:
    still = planar(0.3, 0.8)
    wrenches = np.array([[10.0, -5.0]])
    torques = still.wrench_torques(wrenches)
    with pytest.raises(CertificationFailed):
        certify_statics(still, wrenches, torques + np.array([0.0, 1e-6]))
    with pytest.raises(CertificationFailed):
        certify_statics(still, wrenches, torques * np.nan)
