"""Jacobians and their derivatives against differences of independent poses, the textbook's columns, and the course."""

from collections.abc import Callable
from typing import TypeAlias, get_args

import numpy as np
import pytest

from gelenk.errors import RepresentationSingularity
from gelenk.kinematics.judge.words import Reference, Screws
from gelenk.kinematics.velocity.jacobian import Jacobians, Representation, jacobians, ranks, singular_values
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.oracles import catalogue, dh_columns
from tests.oracles.differences import Difference, aligned, along, body, derivatives, euler, plain, spatial
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, of_table, robot, rows, samples, swept

Kind: TypeAlias = tuple[Reference | Screws, Representation]

KINDS: dict[Kind, Difference] = {
    ("local_world_aligned", "geometric"): aligned,
    ("local", "geometric"): body,
    ("world", "geometric"): spatial,
    ("space_screws", "geometric"): lambda a, b: np.roll(spatial(a, b), 3),
    ("body_screws", "geometric"): lambda a, b: np.roll(body(a, b), 3),
    ("local_world_aligned", "zyz"): euler("ZYZ"),
    ("local_world_aligned", "rpy"): euler("xyz"),
}
"""Which difference of poses each kind of Jacobian is the derivative of."""
GEOMETRIC = [kind for kind in KINDS if kind[1] == "geometric"]
TWISTS = [kind for kind in GEOMETRIC if kind[0] not in get_args(Screws)]
"""Those whose linear rows come first."""
every_kind = pytest.mark.parametrize("kind", KINDS, ids="-".join)

CHAINS = {
    "arm": ("ur5", None, None),
    "hand with a follower": ("panda", "panda_link0", "panda_leftfinger"),
    "up from a follower": ("panda", "panda_rightfinger", "panda_link5"),
    "from gripper to gripper": ("baxter", "left_gripper", "right_gripper"),
    "up the tree": ("talos", "arm_left_7_link", "base_link"),
    "continuous joints": ("kinova", None, None),
    "sliding joint": ("pr2", "base_footprint", "l_gripper_tool_frame"),
}
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
Ends: TypeAlias = tuple[str, str | None, str | None]


def chain_of(ends: Ends) -> tuple[RobotModel, Chain]:
    """A robot and one of its chains."""
    machine = robot(ends[0])
    return machine, machine.chain(ends[1], ends[2])


def independent_poses(name: str, chain: Chain) -> Callable[[Array], Array]:
    """T_base_tip as a function of configurations, from the text of the description or from the table."""
    if name in catalogue.TABLES:
        textbook = dh_columns.from_json(catalogue.dh_table(name))
        return lambda qs: np.array([textbook.pose(q) for q in qs])
    product = UrdfProduct(catalogue.urdf_text(name))
    return lambda qs: product.poses(chain.base_frame, chain.tip_frame, by_name(chain, qs))


def one(machine: RobotModel, chain: Chain, q: Array, kind: Kind, *, derivatives: bool = False) -> Jacobians:
    """Jacobian at one configuration."""
    return jacobians(machine, chain, q[None], reference=kind[0], representation=kind[1], derivatives=derivatives)


# Against differences


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_geometric_jacobians_are_derivatives_of_poses(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    poses = independent_poses(name, chain)
    for q in samples(chain, 3):
        for kind in GEOMETRIC:
            expected = np.array(derivatives(poses, q, KINDS[kind])).T
            assert np.abs(one(machine, chain, q, kind).values[0] - expected).max() < 1e-10, kind


@pytest.mark.quick(3)
@every_kind
@every_chain
def test_jacobians_of_every_kind_are_derivatives_of_poses(ends: Ends, kind: Kind) -> None:
    machine, chain = chain_of(ends)
    poses = independent_poses(ends[0], chain)
    for q in regular(machine, chain, kind):
        expected = np.array(derivatives(poses, q, KINDS[kind])).T
        assert np.abs(one(machine, chain, q, kind).values[0] - expected).max() < 1e-7


@pytest.mark.quick(1)
@every_kind
@every_chain
def test_hessians_are_derivatives_of_jacobians(ends: Ends, kind: Kind) -> None:
    machine, chain = chain_of(ends)
    poses = independent_poses(ends[0], chain)

    def independent_jacobians(qs: Array) -> Array:
        return np.array([np.array(derivatives(poses, q, KINDS[kind])).T for q in qs])

    for q in regular(machine, chain, kind, count=1):
        expected = np.stack(derivatives(independent_jacobians, q, plain), axis=-1)
        Hs = one(machine, chain, q, kind, derivatives=True).hessians
        assert Hs is not None
        assert np.abs(Hs[0] - expected).max() < 1e-6


@every_kind
@every_chain
def test_time_variation_is_the_derivative_along_the_motion(ends: Ends, kind: Kind) -> None:
    machine, chain = chain_of(ends)
    for q in regular(machine, chain, kind):
        q_dot = np.random.default_rng(3).uniform(-1, 1, len(chain))
        expected = along(
            lambda qs: jacobians(machine, chain, qs, reference=kind[0], representation=kind[1]).values, q, q_dot, plain
        )
        J_dot = one(machine, chain, q, kind, derivatives=True).time_variations(q_dot[None])[0]
        assert np.abs(J_dot - expected).max() < 1e-7


def regular(machine: RobotModel, chain: Chain, kind: Kind, count: int = 3) -> Array:
    """Configurations around which the Euler angles of the kind are far from a singularity of theirs."""
    qs = samples(chain, 60, seed=5)
    Rs = jacobians(machine, chain, qs).poses.rotations
    cosines = np.array([np.ones(len(qs)), np.hypot(Rs[:, 0, 2], Rs[:, 1, 2]), np.hypot(Rs[:, 0, 0], Rs[:, 1, 0])])
    chosen: Array = qs[cosines[["geometric", "zyz", "rpy"].index(kind[1])] > 0.5][:count]
    assert len(chosen) == count
    return chosen


@pytest.mark.parametrize("representation", ["zyz", "rpy"])
def test_euler_rates_are_the_same_in_every_reference(representation: Representation) -> None:
    machine, chain = chain_of(CHAINS["arm"])
    qs = samples(chain, 10)
    ours, local, world = (
        jacobians(machine, chain, qs, reference=kind[0], representation=representation) for kind in TWISTS
    )
    assert np.array_equal(ours.values, local.values)
    assert np.array_equal(ours.values, world.values)


# Against the textbook's columns


@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_columns_of_the_textbook(name: str) -> None:
    machine, textbook = robot(name), dh_columns.from_json(catalogue.dh_table(name))
    chain = machine.chain("base", "tool")
    qs = samples(chain, 100)
    expected = np.array([textbook.jacobian(q) for q in qs])
    answer = jacobians(machine, chain, qs)
    assert np.abs(answer.values - expected).max() < 1e-12
    assert answer.certificate.max_error < 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize("standard", [True, False], ids=["standard", "modified"])
def test_columns_of_random_tables(standard: bool) -> None:
    rng = np.random.default_rng(8)
    for _ in range(30):
        parameters = [tuple(row) for row in rng.uniform(-1.5, 1.5, (rng.integers(1, 9), 4))]
        types = "".join(rng.choice(["R", "P"], len(parameters)))
        machine = of_table(rows("standard" if standard else "modified", parameters, types))
        chain = machine.chain("base", "tool")
        qs = samples(chain, 3)
        textbook = dh_columns.Table(standard, parameters, [letter == "P" for letter in types])
        assert np.abs(jacobians(machine, chain, qs).values - [textbook.jacobian(q) for q in qs]).max() < 1e-12


# Between references


@every_chain
def test_references_are_the_same_motion(ends: Ends) -> None:
    """Body twist = Ad(T⁻¹) spatial twist, and both have the rank of the aligned Jacobian."""
    machine, chain = chain_of(ends)
    qs = samples(chain, 10)
    aligned_, local, world = (jacobians(machine, chain, qs, reference=kind[0]) for kind in TWISTS)
    p, R = aligned_.poses.positions, aligned_.poses.rotations
    moved = world.values[:, :3] + np.cross(world.values[:, 3:], p[:, :, None], axis=1)
    assert np.abs(R.swapaxes(1, 2) @ moved - local.values[:, :3]).max() < 1e-13
    assert np.abs(R.swapaxes(1, 2) @ world.values[:, 3:] - local.values[:, 3:]).max() < 1e-13
    assert singular_values(local.values) == pytest.approx(singular_values(aligned_.values), abs=1e-13)


def test_the_way_back_moves_the_other_way() -> None:
    """The spatial twist of tip in base is minus the body twist of base in tip."""
    baxter = robot("baxter")
    there, back = (baxter.chain(*ends) for ends in (("torso", "left_gripper"), ("left_gripper", "torso")))
    qs = samples(there, 10)
    spatial_there = jacobians(baxter, there, qs, reference="world").values
    body_back = jacobians(baxter, back, np.ascontiguousarray(qs[:, ::-1]), reference="local").values
    assert np.abs(spatial_there + body_back[:, :, ::-1]).max() < 1e-13


# The reference numbers of the course

PLANAR = rows("standard", [(1, 0, 0, 0), (0.7, 0, 0, 0)], "RR")
UR5_Q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])


def planar(q: tuple[float, float]) -> Jacobians:
    """The arm of two links of 1 m and 0.7 m."""
    machine = of_table(PLANAR)
    return jacobians(machine, machine.chain(None, None), np.array([q]), derivatives=True)


def of_catalogue(name: str, q: Array) -> Array:
    """The geometric Jacobian of a robot of the catalogue, along its default chain."""
    machine = robot(name)
    J: Array = jacobians(machine, machine.chain(None, None), q[None]).values[0]
    return J


def test_jacobian_of_the_planar_arm() -> None:
    J = planar((0.3, 0.8)).values[0]
    expected = [[-0.919365358704, -0.623845152043], [1.272853774124, 0.317517284998]]
    assert np.abs(J - [*expected, [0, 0], [0, 0], [0, 0], [1, 1]]).max() < 1e-12
    assert np.linalg.det(J[:2]) == pytest.approx(0.502149263630, abs=1e-12)
    assert J[:2] @ [0.2, -0.5] == pytest.approx([0.128049504281, 0.095812112326], abs=1e-12)
    assert singular_values(J[None, :2])[0] == pytest.approx([1.693355501046, 0.296540958658], abs=1e-12)


def test_determinants() -> None:
    arm = rows("standard", [(0, np.pi / 2, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")
    machine = of_table(arm)
    J = jacobians(machine, machine.chain(None, None), np.array([[0.3, 0.6, -0.8]])).values[0]
    assert np.linalg.det(J[:3]) == pytest.approx(0.115450491367, abs=1e-12)
    assert np.linalg.det(of_catalogue("ur5_dh", UR5_Q)) == pytest.approx(-0.045981129777, abs=1e-12)


def test_condition_number_of_the_ur5() -> None:
    sigmas = singular_values(of_catalogue("ur5_dh", UR5_Q)[None])[0]
    assert sigmas[0] / sigmas[-1] == pytest.approx(12.135952466, abs=1e-9)


def test_velocity_acceleration_and_jerk() -> None:
    """Twist v = J q̇, a = J q̈ + J̇ q̇, jerk = J q⃛ + 2 J̇ q̈ + J̈ q̇; the J̈ by differences of J̇ along the motion."""
    machine = of_table(PLANAR)
    chain = machine.chain(None, None)
    q, q_dot, q_ddot, q_dddot = np.array([[0.3, 0.8], [0.5, -0.4], [0.2, 0.9], [-0.3, 0.6]])

    def rates(times: Array) -> Array:
        t = times.reshape(-1, 1)
        qs = q + q_dot * t + q_ddot * t**2 / 2 + q_dddot * t**3 / 6
        speeds = q_dot + q_ddot * t + q_dddot * t**2 / 2
        return jacobians(machine, chain, qs, derivatives=True).time_variations(speeds)

    J, J_dot = planar((0.3, 0.8)).values[0, :2], rates(np.zeros(1))[0, :2]
    J_ddot = along(rates, np.zeros(1), np.ones(1), plain)[:2]
    acceleration = J @ q_ddot + J_dot @ q_dot
    jerk = J @ q_dddot + 2 * J_dot @ q_ddot + J_ddot @ q_dot
    assert J @ q_dot == pytest.approx([-0.210144618535, 0.509419973063], abs=1e-12)
    assert acceleration == pytest.approx([-0.987343003711, 0.460217808137], abs=1e-12)
    assert jerk == pytest.approx([-0.452315263417, -0.605605301837], abs=1e-9)
    assert np.linalg.solve(J, -J_dot @ q_dot) == pytest.approx([0.252561704898, -0.760133786401], abs=1e-12)


# Singular configurations


def test_the_ur5_with_its_wrist_stretched() -> None:
    q = UR5_Q * [1, 1, 1, 1, 0, 1]
    sigmas = singular_values(of_catalogue("ur5_dh", q)[None])
    expected = [2.073079224, 1.450502321, 0.545464331, 0.489296516, 0.247862652, 0]
    assert sigmas[0] == pytest.approx(expected, abs=1e-9)
    assert ranks(sigmas, 1e-10) == [5]


@pytest.mark.parametrize(
    ("name", "q", "linear", "all_rows"),
    [
        ("planar_2r", [0.3, 0.8], 2, 2),
        ("planar_2r", [0.3, 0.0], 1, 2),
        ("planar_2r", [0.3, np.pi], 1, 2),
        ("anthropomorphic", [0.3, 0.6, -0.8], 3, 3),
        ("anthropomorphic", [0.3, 0.6, 0.0], 2, 3),
        ("spherical_wrist", [0.2, 0.9, -0.5], 2, 3),
        ("spherical_wrist", [0.2, 0.0, -0.5], 1, 2),
        ("ur5_dh", [0.1, -1.2, 0.0, -0.7, 0.5, 0.3], 3, 5),
        ("ur5_dh", [0.1, -1.2, 1.4, -0.7, 0.5, 0.3], 3, 6),
    ],
)
def test_ranks(name: str, q: list[float], linear: int, all_rows: int) -> None:
    J = of_catalogue(name, np.array(q))[None]
    assert ranks(singular_values(J[:, :3]), 1e-10) == [linear]
    assert ranks(singular_values(J), 1e-10) == [all_rows]


@pytest.mark.parametrize(
    ("representation", "angle", "q", "value"),
    [
        ("zyz", "theta", [0.2, 0.0, -0.5], 0.0),
        ("zyz", "theta", [0.2, np.pi, -0.5], np.pi),
        ("rpy", "pitch", [0.0, np.pi / 2, 0.0], np.pi / 2),
    ],
)
def test_euler_angles_without_a_rate(representation: Representation, angle: str, q: list[float], value: float) -> None:
    """The wrist turns by ZYZ, so that the representation degenerates with it, and also where the robot does not."""
    wrist = robot("spherical_wrist")
    qs = np.array([[0.1, 0.8, 0.2], q])
    with pytest.raises(RepresentationSingularity) as caught:
        jacobians(wrist, wrist.chain(None, None), qs, representation=representation)
    assert (caught.value.representation, caught.value.angle, caught.value.index) == (representation, angle, 1)
    assert caught.value.value == pytest.approx(value)
    assert jacobians(wrist, wrist.chain(None, None), qs).values.shape == (2, 6, 3)


# Nothing to do


@every_kind
def test_no_configuration(kind: Kind) -> None:
    panda = robot("panda")
    chain = panda.chain(None, None)
    answer = jacobians(
        panda, chain, np.empty((0, len(chain))), reference=kind[0], representation=kind[1], derivatives=True
    )
    assert answer.values.shape == (0, 6, len(chain))
    assert answer.time_variations(np.empty((0, len(chain)))).shape == (0, 6, len(chain))
    assert singular_values(answer.values).shape == (0, 6)
    assert ranks(singular_values(answer.values), 1e-10).shape == (0,)


@every_kind
def test_no_joint(kind: Kind) -> None:
    panda = robot("panda")
    chain = panda.chain("panda_link3", "panda_link3") if kind[1] == "rpy" else panda.chain("panda_hand", "panda_hand")
    if kind[1] == "zyz":
        with pytest.raises(RepresentationSingularity):
            one(panda, chain, np.empty(0), kind)
        return
    answer = one(panda, chain, np.empty(0), kind, derivatives=True)
    assert answer.values.shape == (1, 6, 0)
    assert answer.hessians is not None
    assert answer.hessians.shape == (1, 6, 0, 0)
    assert list(ranks(singular_values(answer.values), 1e-10)) == [0]


def test_a_robot_without_joints() -> None:
    stone = RobotModel(read_urdf('<robot name="stone"><link name="base"/></robot>'))
    answer = jacobians(stone, stone.chain(None, None), np.empty((2, 0)), derivatives=True)
    assert answer.values.shape == (2, 6, 0)
    assert answer.certificate.samples == 0


@pytest.mark.parametrize("letter", ["R", "P"])
def test_a_robot_with_one_joint(letter: str) -> None:
    parameters = [(0.5, 0.4, 0.3, 0.2)]
    machine = of_table(rows("standard", parameters, letter))
    answer = jacobians(machine, machine.chain(None, None), np.array([[0.7]]), derivatives=True)
    textbook = dh_columns.Table(True, parameters, [letter == "P"])
    assert np.abs(answer.values[0] - textbook.jacobian([0.7])).max() < 1e-15
    assert answer.certificate.samples == 1


def test_time_variation_needs_the_hessians() -> None:
    panda = robot("panda")
    chain = panda.chain(None, None)
    with pytest.raises(ValueError, match="Hessians"):
        one(panda, chain, samples(chain, 1)[0], ("local", "geometric")).time_variations(samples(chain, 1))
