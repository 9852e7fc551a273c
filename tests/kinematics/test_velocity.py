"""Twist, acceleration, jerk and snap against derivatives of independent poses, Pinocchio, and the course."""

import numpy as np
import pinocchio as pin
import pytest

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.motion import certify_motion
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.velocity import TipMotion, jacobian_derivatives, tip_motion
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.kinematics.test_jacobian import CHAINS, Ends, chain_of, independent_poses
from tests.oracles import catalogue
from tests.oracles.differences import aligned, derivatives
from tests.oracles.time_derivatives import derivatives_in_time, motion_of_poses, path, reach_of
from tests.robots import of_table, robot, rows, samples, swept

DEFAULTS: dict[str, Ends] = {name: (name, None, None) for name in catalogue.NAMES}
EVERY = {**DEFAULTS, **CHAINS}
every_robot = pytest.mark.parametrize("ends", swept(EVERY, EVERY.__getitem__))
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)


def random_rates(chain: Chain, orders: int = 4, count: int = 1, seed: int = 4) -> Array:
    return np.random.default_rng(seed).uniform(-1.5, 1.5, (orders, count, len(chain)))


def one(
    machine: RobotModel, q: list[float], rates: list[list[float]], reference: Reference = "local_world_aligned"
) -> Array:
    """Derivatives of the tip's motion at one configuration; shape (K, 6)."""
    chain = machine.chain(None, None)
    motion = tip_motion(machine, chain, np.array([q]), np.array(rates)[:, None], reference)
    return np.array(motion.derivatives)[:, 0]


# Against differences


@every_robot
def test_derivatives_of_the_motion_are_those_of_poses(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    q, rates = samples(chain, 1)[0], random_rates(chain)
    poses, positions, reach = independent_poses(ends[0], chain), path(q, rates[:, 0]), reach_of(rates[:, 0])
    expected = motion_of_poses(derivatives_in_time(lambda times: poses(positions(times)), reach, 4))
    found = tip_motion(machine, chain, q[None], rates).derivatives
    for k in range(4):
        # Relative to what joints as fast as these can make.
        assert np.abs(found[k][0] - expected[k]).max() < 1e-10 * max(1.0, (2.0 / reach) ** (k + 1)), k


@pytest.mark.slow
@every_robot
def test_derivatives_of_the_jacobian_are_those_of_jacobians_of_poses(ends: Ends) -> None:
    chain = chain_of(ends)[1]
    q, rates = samples(chain, 1)[0], random_rates(chain)
    poses, positions, reach = independent_poses(ends[0], chain), path(q, rates[:, 0]), reach_of(rates[:, 0])

    def independent_jacobians(times: Array) -> Array:
        return np.array([np.array(derivatives(poses, at, aligned)).T for at in positions(times)])

    expected = derivatives_in_time(independent_jacobians, reach, 3)
    found = jacobian_derivatives(chain, q[None], rates[:3])[:, 0]
    # The motion's fourth derivative moves J's first three not at all.
    for k in range(4):
        assert np.abs(found[k] - expected[k]).max() < 1e-8 * max(1.0, (2.0 / reach) ** k), k


@every_chain
def test_derivatives_of_the_jacobian_are_the_hessians(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    qs, rates = samples(chain, 20), random_rates(chain, 1, 20)
    found = jacobians(machine, chain, qs, derivatives=True)
    Js = jacobian_derivatives(chain, qs, rates)
    np.testing.assert_allclose(Js[0], found.values, atol=1e-13)
    np.testing.assert_allclose(Js[1], found.time_variations(rates[0]), atol=1e-12)


# Against Pinocchio


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_twists_and_both_accelerations_are_pinocchios(name: str) -> None:
    """Where the base is the root, Pinocchio gives all three itself, in all three references."""
    machine = robot(name)
    chain = machine.chain(machine.description.root, machine.default_chain[1])
    qs, rates = samples(chain, 2), random_rates(chain, 2, 2)
    frames: dict[Reference, pin.ReferenceFrame] = {
        "local_world_aligned": pin.LOCAL_WORLD_ALIGNED,
        "local": pin.LOCAL,
        "world": pin.WORLD,
    }
    for reference, frame in frames.items():
        found = tip_motion(machine, chain, qs, rates, reference)
        for row in range(len(qs)):
            expected = pinocchio_motion(machine, chain, qs[row], rates[:, row], frame)
            assert found.spatial_accelerations is not None
            np.testing.assert_allclose(found.derivatives[0][row], expected[0], atol=1e-11)
            np.testing.assert_allclose(found.derivatives[1][row], expected[1], atol=1e-11)
            np.testing.assert_allclose(found.spatial_accelerations[row], expected[2], atol=1e-11)


def pinocchio_motion(
    machine: RobotModel, chain: Chain, q: Array, rates: Array, frame: pin.ReferenceFrame
) -> list[Array]:
    """Twist, classical and spatial acceleration of the tip in the world."""
    expansion, model, data = machine.expansion(chain), machine.model, machine.model.createData()
    pin.forwardKinematics(model, data, expansion.offset + expansion.matrix @ q, *(rates @ expansion.matrix.T))
    tip = machine.frame_id(chain.tip_frame)
    pin.updateFramePlacement(model, data, tip)
    ask = (pin.getFrameVelocity, pin.getFrameClassicalAcceleration, pin.getFrameAcceleration)
    return [function(model, data, tip, frame).vector.copy() for function in ask]


@every_chain
def test_motion_in_the_tips_axes_and_of_the_bodys_point_at_the_base(ends: Ends) -> None:
    """`local` turns every vector; `world` is how the body's point that is at the base's origin now moves on."""
    machine, chain = chain_of(ends)
    q, rates = samples(chain, 1)[0], random_rates(chain)
    views: tuple[Reference, ...] = ("local_world_aligned", "local", "world")
    ours, local, world = (tip_motion(machine, chain, q[None], rates, view) for view in views)
    R = ours.poses.rotations[0]
    poses, positions, reach = independent_poses(ends[0], chain), path(q, rates[:, 0]), reach_of(rates[:, 0])
    Ts = derivatives_in_time(lambda times: poses(positions(times)), reach, 4)
    at_origin = np.linalg.solve(Ts[0], [0.0, 0.0, 0.0, 1.0])
    for k in range(4):
        vector, turned, moved = (motion.derivatives[k][0] for motion in (ours, local, world))
        np.testing.assert_allclose(turned, np.concatenate((vector[:3] @ R, vector[3:] @ R)), atol=1e-12 * 10**k)
        assert np.abs(moved[:3] - (Ts[k + 1] @ at_origin)[:3]).max() < 1e-10 * max(1.0, (2.0 / reach) ** (k + 1))
        np.testing.assert_array_equal(moved[3:], vector[3:])


def test_certificates_are_measured() -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    many = tip_motion(machine, chain, samples(chain, 300), random_rates(chain, 3, 300)).certificate
    assert 3 < many.samples < 300
    assert many.max_acceleration_error is not None
    assert many.max_jerk_error is not None
    assert 0.0 < max(many.max_twist_error, many.max_acceleration_error, many.max_jerk_error) < 1e-12
    assert many.max_snap_error is None
    assert tip_motion(machine, chain, samples(chain, 2), random_rates(chain, 4, 2)).certificate.max_snap_error


@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
@pytest.mark.parametrize("order", range(4))
def test_what_pinocchio_does_not_confirm_is_withheld(order: int, reference: Reference) -> None:
    machine = robot("ur5")
    chain = machine.chain(None, None)
    qs, rates = samples(chain, 1), random_rates(chain)
    motion = tip_motion(machine, chain, qs, rates, reference)
    wrong = [derivative.copy() for derivative in motion.derivatives]
    wrong[order][0, 2] += 1e-3
    with pytest.raises(CertificationFailed):
        certify_motion(machine, chain, qs, rates, wrong, reference=reference)
    spatial = np.ones((1, 6))
    with pytest.raises(CertificationFailed, match="spatial"):
        certify_motion(machine, chain, qs, rates, motion.derivatives, spatial, reference)


# The reference numbers of the course, item 32

PLANAR = rows("standard", [(1, 0, 0, 0), (0.7, 0, 0, 0)], "RR")
Q, RATES = [0.3, 0.8], [[0.5, -0.4], [0.2, 0.9], [-0.3, 0.6], [0.0, 0.0]]


@pytest.mark.parametrize(
    ("order", "expected"),
    [
        (1, [-0.210144618535, 0.509419973063]),
        (2, [-0.987343003711, 0.460217808137]),
        (3, [-0.452315263417, -0.605605301837]),
    ],
)
def test_velocity_acceleration_and_jerk_of_the_blackboard(order: int, expected: list[float]) -> None:
    assert one(of_table(PLANAR), Q, RATES)[order - 1, :2] == pytest.approx(expected, abs=1e-12)


def test_snap_of_the_blackboard() -> None:
    assert one(of_table(PLANAR), Q, RATES)[3, 0] == pytest.approx(-0.542558179630, abs=1e-12)


def test_the_jerk_of_the_lecture_notes_lacks_a_factor() -> None:
    """J q⃛ + J̇ q̈ + J̈ q̇ would give -0.321854713154; the third derivative of x is J q⃛ + 2 J̇ q̈ + J̈ q̇."""
    machine = of_table(PLANAR)
    q_dot, q_ddot, q_dddot = np.array(RATES[:3])
    chain = machine.chain(None, None)
    J, J_dot, J_ddot = jacobian_derivatives(chain, np.array([Q]), np.array(RATES[:2])[:, None])[:, 0, 0]
    assert J @ q_dddot + J_dot @ q_ddot + J_ddot @ q_dot == pytest.approx(-0.321854713154, abs=1e-12)
    assert J @ q_dddot + 2 * J_dot @ q_ddot + J_ddot @ q_dot == pytest.approx(-0.452315263417, abs=1e-12)


def test_the_other_twist_of_the_blackboard() -> None:
    """Item 30."""
    assert one(of_table(PLANAR), Q, [[0.2, -0.5]])[0, :2] == pytest.approx([0.128049504281, 0.095812112326], abs=1e-12)


def test_the_spatial_acceleration_is_another() -> None:
    """With q̇ = 0 the two agree; in motion they differ by ω × ṗ."""
    machine = of_table(PLANAR)
    chain = machine.chain(None, None)

    def both(rates: list[list[float]]) -> TipMotion:
        return tip_motion(machine, chain, np.array([Q]), np.array(rates)[:, None])

    still, moving = both([[0.0, 0.0], RATES[1]]), both(RATES[:2])
    assert still.spatial_accelerations is not None
    assert moving.spatial_accelerations is not None
    np.testing.assert_allclose(still.spatial_accelerations, still.derivatives[1], atol=1e-15)
    twist = moving.derivatives[0][0]
    difference = moving.derivatives[1][0, :3] - moving.spatial_accelerations[0, :3]
    np.testing.assert_allclose(difference, np.cross(twist[3:], twist[:3]), atol=1e-15)
    assert np.abs(difference).max() > 0.01


# At the ends of the range


@pytest.mark.parametrize("size", [1e-300, 1e-9, 1.0, 1e6])
def test_rates_of_every_size(size: float) -> None:
    machine = robot("pr2")
    chain = machine.chain("base_footprint", "l_gripper_tool_frame")
    motion = tip_motion(machine, chain, samples(chain, 2), size * random_rates(chain, 4, 2))
    assert all(np.isfinite(derivative).all() for derivative in motion.derivatives)


def test_large_batches_are_those_of_single_calls() -> None:
    machine = robot("ur5")
    chain = machine.chain(None, None)
    qs, rates = samples(chain, 3000), random_rates(chain, 4, 3000)
    Js = jacobian_derivatives(chain, qs, rates[:3])
    for row in (0, 1499, 2999):
        single = jacobian_derivatives(chain, qs[row : row + 1], rates[:3, row : row + 1])
        np.testing.assert_allclose(Js[:, row], single[:, 0], atol=1e-13)


def test_no_configuration_and_no_joint() -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    nothing = tip_motion(machine, chain, np.empty((0, 7)), np.empty((4, 0, 7)))
    assert [derivative.shape for derivative in nothing.derivatives] == [(0, 6)] * 4
    fixed = machine.chain("panda_hand", "panda_hand")
    still = tip_motion(machine, fixed, np.empty((2, 0)), np.empty((4, 2, 0)))
    assert all(not derivative.any() and derivative.shape == (2, 6) for derivative in still.derivatives)
    stone = RobotModel(read_urdf('<robot name="stone"><link name="base"/></robot>'))
    assert tip_motion(stone, stone.chain(None, None), np.empty((1, 0)), np.empty((1, 1, 0))).certificate.samples == 0


@pytest.mark.parametrize("letter", ["R", "P"])
def test_a_robot_with_one_joint(letter: str) -> None:
    machine = of_table(rows("standard", [(0.5, 0.4, 0.3, 0.2)], letter))
    found = one(machine, [0.7], [[2.0], [0.5], [-0.3], [0.1]])
    if letter == "P":
        np.testing.assert_allclose(found[:, 2], [2.0, 0.5, -0.3, 0.1], atol=1e-15)
    assert found.shape == (4, 6)
