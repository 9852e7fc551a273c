"""Equations of motion against differences of energies, the textbook's formulas, and what mechanics demands of them."""

import gc
import weakref
from functools import cache
from typing import TypeAlias

import numpy as np
import pytest

from gelenk.errors import CertificationFailed, InvalidField
from gelenk.kinematics.dynamics.bodies import Load
from gelenk.kinematics.dynamics.dynamics import Dynamics, dynamics
from gelenk.kinematics.dynamics.lagrangian import State
from gelenk.kinematics.dynamics.mechanism import PinocchioDynamics, known_mechanism, mechanism
from gelenk.kinematics.force.statics import WrenchFrame, statics
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf
from tests.oracles import catalogue
from tests.oracles.differences import along, plain
from tests.oracles.urdf_energy import UrdfEnergy
from tests.robots import of_table, robot, rows, samples, swept

G = np.array([0.0, 0.0, -9.81])
LOAD = Load(2.5, np.array([0.1, -0.2, 0.3]), np.array([[0.2, 0.01, 0.0], [0.01, 0.3, 0.02], [0.0, 0.02, 0.25]]))

Ends: TypeAlias = tuple[str, str | None, str | None]
CHAINS: dict[str, Ends] = {
    "arm": ("ur5", None, None),
    "hand with a follower": ("panda", "panda_link0", "panda_leftfinger"),
    "up from a follower": ("panda", "panda_rightfinger", "panda_link5"),
    "from gripper to gripper": ("baxter", "left_gripper", "right_gripper"),
    "up the tree": ("talos", "arm_left_7_link", "base_link"),
    "sliding joint": ("pr2", "base_footprint", "l_gripper_tool_frame"),
    "many followers": ("tiago", None, None),
}
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
every_robot = pytest.mark.parametrize("name", swept(catalogue.NAMES))


def chain_of(ends: Ends) -> tuple[RobotModel, Chain]:
    machine = robot(ends[0])
    return machine, machine.chain(ends[1], ends[2])


@cache
def energy(ends: Ends) -> UrdfEnergy:
    """The energies from the text of the description."""
    machine, chain = chain_of(ends)
    name = ends[0]
    text = catalogue.urdf_text(name) if name in catalogue.URDFS else write_urdf(machine.description)
    return UrdfEnergy(text, chain.joint_names)


def moving(chain: Chain, count: int = 3, seed: int = 0) -> State:
    """Random configurations and velocities, no wrench."""
    qs = samples(chain, count, seed)
    return State(qs, np.random.default_rng(seed + 1).uniform(-1, 1, qs.shape), np.zeros_like(qs))


def solved(
    machine: RobotModel, chain: Chain, state: State, *, accelerations: Array | None = None, torques: Array | None = None
) -> Dynamics:
    return dynamics(machine, chain, state, gravity=G, terms=(), accelerations=accelerations, torques=torques)


# Against differences of energies


@pytest.mark.quick(5)
@every_robot
def test_terms_are_those_of_lagrange(name: str) -> None:
    check_lagrange((name, None, None), coriolis=False)


@pytest.mark.quick(1)
@every_chain
def test_terms_of_chains_anywhere_are_those_of_lagrange(ends: Ends) -> None:
    check_lagrange(ends, coriolis=ends[1] == "panda_rightfinger")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ur5", "scara", "finger_edu", "planar_3r"])
def test_coriolis_torques_are_those_of_lagrange(name: str) -> None:
    check_lagrange((name, None, None), coriolis=True)


def check_lagrange(ends: Ends, coriolis: bool) -> None:
    machine, chain = chain_of(ends)
    state, gravity = moving(chain, 1), np.array([1.0, -2.0, -9.0])
    found = dynamics(machine, chain, state, gravity=gravity)
    assert found.mass_matrices is not None
    assert found.gravity_torques is not None
    assert found.coriolis_torques is not None
    assert found.potential_energies is not None
    for k, q in enumerate(state.qs):
        M, scale = energy(ends).mass_matrix(q), np.abs(found.mass_matrices[k]).max()
        assert np.abs(found.mass_matrices[k] - M).max() < 1e-10 * max(1.0, scale)
        g = energy(ends).gravity_torques(q, gravity)
        assert np.abs(found.gravity_torques[k] - g).max() < 1e-10 * max(1.0, np.abs(g).max())
        assert found.potential_energies[k] == pytest.approx(energy(ends).potential(q[None], gravity)[0], abs=1e-9)
        if coriolis:
            expected = energy(ends).coriolis_torques(q, state.speeds[k])
            assert np.abs(found.coriolis_torques[k] - expected).max() < 1e-8 * max(1.0, scale)


# What mechanics demands


@every_robot
def test_mass_matrices_are_symmetric_and_positive_definite(name: str) -> None:
    machine, chain = chain_of((name, None, None))
    found = dynamics(machine, chain, moving(chain, 20), gravity=G, terms=["mass_matrix"])
    assert found.mass_matrices is not None
    assert np.abs(found.mass_matrices - found.mass_matrices.swapaxes(1, 2)).max() < 1e-12
    assert np.linalg.eigvalsh(found.mass_matrices).min() > 0
    assert found.is_definite


@every_robot
def test_inverse_dynamics_undo_forward_dynamics(name: str) -> None:
    machine, chain = chain_of((name, None, None))
    state = moving(chain, 16)
    torques = np.random.default_rng(2).uniform(-10, 10, state.qs.shape)
    there = solved(machine, chain, state, torques=torques)
    assert there.accelerations is not None
    back = solved(machine, chain, state, accelerations=there.accelerations)
    assert back.torques is not None
    assert np.abs(back.torques - torques).max() < 1e-9
    assert there.certificate.max_round_trip_error is not None
    assert there.certificate.max_round_trip_error < 1e-9
    assert there.certificate.samples == 16


@every_robot
def test_mass_matrix_rate_minus_twice_coriolis_is_skew(name: str) -> None:
    machine, chain = chain_of((name, None, None))
    state = moving(chain, 1)
    found = dynamics(machine, chain, state, gravity=G, terms=["coriolis_matrix", "coriolis_torques"])
    assert found.coriolis_matrices is not None
    assert found.coriolis_torques is not None
    judge = PinocchioDynamics(mechanism(machine, chain), G)
    M_dot = along(lambda qs: np.array([judge.mass_matrix(q) for q in qs]), state.qs[0], state.speeds[0], plain)
    skew = M_dot - 2 * found.coriolis_matrices[0]
    assert np.abs(skew + skew.T).max() < 1e-9 * max(1.0, np.abs(M_dot).max())
    assert found.coriolis_torques[0] == pytest.approx(found.coriolis_matrices[0] @ state.speeds[0], abs=1e-12)


@every_chain
def test_columns_of_the_mass_matrix_are_torques_of_unit_accelerations(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    n = len(chain)
    one = moving(chain, 1)
    state = State(*(np.repeat(part, n + 1, axis=0) for part in (one.qs, one.speeds, one.held)))
    units = np.vstack((np.zeros(n), np.eye(n)))
    found = dynamics(machine, chain, state, gravity=G, accelerations=units)
    assert found.torques is not None
    assert found.mass_matrices is not None
    assert found.coriolis_torques is not None
    assert found.gravity_torques is not None
    assert np.abs((found.torques[1:] - found.torques[0]).T - found.mass_matrices[0]).max() < 1e-11
    assert np.abs(found.torques[0] - found.coriolis_torques[0] - found.gravity_torques[0]).max() < 1e-11


@every_chain
@pytest.mark.parametrize("count", [1, 3])
def test_torques_of_many_states_are_those_of_each(ends: Ends, count: int) -> None:
    machine, chain = chain_of(ends)
    judge, state = PinocchioDynamics(mechanism(machine, chain), G, LOAD), moving(chain, count)
    rates = state.qs, state.speeds, samples(chain, count, 5)
    each = [judge.inverse(*rows) for rows in zip(*rates, strict=True)]
    assert judge.inverses(*rates) == pytest.approx(np.array(each), abs=1e-12)


@every_chain
def test_round_trip_of_chains_anywhere(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    state = moving(chain, 4)
    wanted = np.random.default_rng(3).uniform(-1, 1, state.qs.shape)
    torques = dynamics(machine, chain, state, gravity=G, load=LOAD, accelerations=wanted).torques
    assert torques is not None
    found = dynamics(machine, chain, state, gravity=G, load=LOAD, torques=torques)
    assert found.accelerations == pytest.approx(wanted, abs=1e-8)


@every_robot
def test_energy_is_conserved(name: str) -> None:
    """Without torques, along a hundredth of a second by Runge and Kutta's fourth order."""
    machine, chain = chain_of((name, None, None))
    judge, none = PinocchioDynamics(mechanism(machine, chain), G), np.zeros(len(chain))
    start = moving(chain, 1, seed=4)
    q, v = start.qs[0], start.speeds[0]
    h, weights, energies = 5e-4, np.array([1, 2, 2, 1]), [sum(judge.energies(q, v))]
    for _ in range(20):
        slopes: list[tuple[Array, Array]] = []
        for part in (0.0, 0.5, 0.5, 1.0):
            at = (q, v) if not slopes else (q + part * h * slopes[-1][0], v + part * h * slopes[-1][1])
            slopes.append((at[1], judge.forward(*at, none)))
        q_dots, v_dots = (np.array(slope) for slope in zip(*slopes, strict=True))
        q, v = q + h / 6 * weights @ q_dots, v + h / 6 * weights @ v_dots
        energies.append(sum(judge.energies(q, v)))
    kinetic = judge.energies(start.qs[0], start.speeds[0])[0]
    assert np.abs(np.array(energies) - energies[0]).max() < 1e-6 * max(1.0, kinetic)
    assert np.abs(q - start.qs[0]).max() > 1e-3


def test_power_is_the_change_of_energy() -> None:
    """d(T + U)/dt = τᵀq̇, with a hand whose one finger follows the other."""
    machine, chain = chain_of(CHAINS["hand with a follower"])
    state = moving(chain, 1)
    torques = np.random.default_rng(5).uniform(-5, 5, (1, len(chain)))
    a = solved(machine, chain, state, torques=torques).accelerations
    assert a is not None

    def total(times: Array) -> Array:
        t = times[:, :1]
        qs, speeds = state.qs + t * state.speeds + t**2 / 2 * a, state.speeds + t * a
        found = dynamics(machine, chain, State(qs, speeds, np.zeros_like(qs)), gravity=G, load=None, terms=["energies"])
        assert found.kinetic_energies is not None
        assert found.potential_energies is not None
        return np.asarray(found.kinetic_energies + found.potential_energies)

    rate = along(total, np.zeros(1), np.array([1e-3]), plain) / 1e-3
    assert rate == pytest.approx(torques[0] @ state.speeds[0], rel=1e-6)


# The textbook

POINT_MASSES = """<robot name="arm"><link name="base"/>
<link name="upper"><inertial><origin xyz="{l1} 0 0"/><mass value="{m1}"/>
<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<link name="lower"><inertial><origin xyz="{l2} 0 0"/><mass value="{m2}"/>
<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="{l1} 0 0"/>
<axis xyz="0 0 1"/></joint></robot>"""


@pytest.mark.parametrize(("q1", "q2"), [(0.3, 0.8), (0.0, 0.0), (-2.0, 3.1)])
def test_two_links_with_point_masses(q1: float, q2: float) -> None:
    """M, C q̇ and g of the planar arm with its masses at the ends of the links, gravity along -y."""
    l1, l2, m1, m2, g = 1.0, 0.7, 3.0, 2.0, 9.81
    arm = RobotModel(read_urdf(POINT_MASSES.format(l1=l1, l2=l2, m1=m1, m2=m2)))
    v1, v2 = 0.5, -0.4
    state = State(np.array([[q1, q2]]), np.array([[v1, v2]]), np.zeros((1, 2)))
    found = dynamics(arm, arm.chain(None, None), state, gravity=np.array([0, -g, 0]))
    s2, c1, c2, c12 = np.sin(q2), np.cos(q1), np.cos(q2), np.cos(q1 + q2)
    h = m2 * l1 * l2
    M = [
        [(m1 + m2) * l1**2 + m2 * l2**2 + 2 * h * c2, m2 * l2**2 + h * c2],
        [m2 * l2**2 + h * c2, m2 * l2**2],
    ]
    C = [[-h * s2 * v2, -h * s2 * (v1 + v2)], [h * s2 * v1, 0]]
    gravity = [g * ((m1 + m2) * l1 * c1 + m2 * l2 * c12), g * m2 * l2 * c12]
    heights = m1 * l1 * np.sin(q1) + m2 * (l1 * np.sin(q1) + l2 * np.sin(q1 + q2))
    assert found.mass_matrices is not None
    assert found.mass_matrices[0] == pytest.approx(np.array(M), abs=1e-12)
    assert found.coriolis_matrices is not None
    assert found.coriolis_matrices[0] == pytest.approx(np.array(C), abs=1e-12)
    assert found.coriolis_torques == pytest.approx(np.array([C @ np.array([v1, v2])]), abs=1e-12)
    assert found.gravity_torques == pytest.approx(np.array([gravity]), abs=1e-12)
    assert found.potential_energies == pytest.approx([g * heights], abs=1e-12)
    assert found.kinetic_energies == pytest.approx([np.array([v1, v2]) @ M @ [v1, v2] / 2], abs=1e-12)


# Payload and wrench


@every_chain
def test_a_payload_is_a_link_on_the_tip(ends: Ends) -> None:
    machine, chain = chain_of(ends)
    state = moving(chain, 2)
    x, y, z = LOAD.center
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = LOAD.inertia
    link = (
        f'<link name="load"><inertial><origin xyz="{x} {y} {z}"/><mass value="{LOAD.mass}"/>'
        f'<inertia ixx="{xx}" ixy="{xy}" ixz="{xz}" iyy="{yy}" iyz="{yz}" izz="{zz}"/></inertial></link>'
        f'<joint name="holds" type="fixed"><parent link="{chain.tip_frame}"/><child link="load"/></joint></robot>'
    )
    text = write_urdf(machine.description).replace("</robot>", link)
    heavier = RobotModel(read_urdf(text))
    expected = dynamics(heavier, heavier.chain(chain.base_frame, chain.tip_frame), state, gravity=G)
    found = dynamics(machine, chain, state, gravity=G, load=LOAD)
    for field in ("mass_matrices", "coriolis_matrices", "gravity_torques", "kinetic_energies", "potential_energies"):
        assert getattr(found, field) == pytest.approx(getattr(expected, field), abs=1e-11), field
    assert mechanism(machine, chain).moves_tip == (chain.tip_frame not in {"base_link", "panda_link5"})


def test_a_robot_at_rest_stays_at_rest_under_the_torques_of_statics() -> None:
    machine, chain = chain_of(("ur5", None, None))
    qs = samples(chain, 3)
    still = statics(machine, chain, qs, WrenchFrame("local"), gravity=G, load=LOAD)
    held = still.wrench_torques(np.random.default_rng(6).uniform(-20, 20, (3, 6)))
    state = State(qs, np.zeros_like(qs), held)
    found = dynamics(machine, chain, state, gravity=G, load=LOAD, torques=held + still.gravity_torques)
    assert found.accelerations is not None
    assert np.abs(found.accelerations).max() < 1e-9


# Masses that are not there

MASSLESS = """<robot name="arm"><link name="base"/><link name="upper"/><link name="lower"/>
<link name="tip"><inertial><origin xyz="0 0 0.1"/><mass value="{mass}"/>
<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<joint name="turn" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="1 0 0"/></joint>
<joint name="roll" type="continuous"><parent link="upper"/><child link="lower"/><axis xyz="0 0 1"/></joint>
<joint name="grip" type="fixed"><parent link="lower"/><child link="tip"/></joint></robot>"""


@pytest.mark.parametrize("mass", [0.0, 2.0])
def test_forward_dynamics_without_inertia_name_the_joints(mass: float) -> None:
    """A point mass on the second axis: no torque is needed to turn about that."""
    arm = RobotModel(read_urdf(MASSLESS.format(mass=mass)))
    chain = arm.chain(None, None)
    state = moving(chain, 2)
    with pytest.raises(InvalidField) as caught:
        solved(arm, chain, state, torques=np.ones((2, 2)))
    assert caught.value.field == "torques"
    assert "'roll'" in caught.value.reason
    assert ("'turn'" in caught.value.reason) == (mass == 0.0)
    assert "'upper'" in caught.value.reason
    assert not solved(arm, chain, state).is_definite
    assert "upper" in mechanism(arm, chain).without_mass


def test_joints_beyond_the_chain_are_locked() -> None:
    """The fingers of the Panda weigh on its wrist at position zero, a follower where its leader at zero has it."""
    panda = robot("panda")
    hand, finger = (panda.chain("panda_link0", tip) for tip in ("panda_hand", "panda_leftfinger"))
    qs = samples(hand, 3)
    with_finger = np.column_stack((qs, np.zeros(3)))
    wrist = dynamics(panda, hand, State(qs, qs, np.zeros_like(qs)), gravity=G)
    whole = dynamics(panda, finger, State(with_finger, with_finger, np.zeros_like(with_finger)), gravity=G)
    assert wrist.mass_matrices is not None
    assert whole.mass_matrices is not None
    order = [finger.joint_names.index(name) for name in hand.joint_names]
    assert wrist.mass_matrices == pytest.approx(whole.mass_matrices[:, order][:, :, order], abs=1e-12)


def test_a_follower_of_a_locked_leader_stands_at_its_offset() -> None:
    text = """<robot name="arm"><link name="base"/><link name="a"/><link name="c">
    <inertial><origin xyz="0.3 0 0"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial></link><link name="d"/>
    <joint name="first" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
    <joint name="second" type="{kind}"><parent link="a"/><child link="c"/><origin xyz="0.5 0 0" rpy="0.1 0.2 0.3"/>
    <axis xyz="0 0 1"/><limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="far" multiplier="2" offset="0.7"/></joint>
    <joint name="far" type="continuous"><parent link="base"/><child link="d"/><axis xyz="0 0 1"/></joint></robot>"""
    for kind in ("revolute", "prismatic"):
        arm = RobotModel(read_urdf(text.format(kind=kind)))
        chain = arm.chain("base", "c")
        assert chain.joint_names == ("first", "far")
        alone = arm.chain("base", "a")
        found = dynamics(arm, alone, moving(alone, 1), gravity=G, terms=["mass_matrix"]).mass_matrices
        expected = UrdfEnergy(text.format(kind=kind), ["first"]).mass_matrix(np.zeros(1))
        assert found == pytest.approx(expected[None], abs=1e-11), kind


# Nothing to do, and much


def test_no_configuration_and_no_joint() -> None:
    panda = robot("panda")
    arm, link = panda.chain(None, None), panda.chain("panda_link3", "panda_link3")
    for chain, count in ((arm, 0), (link, 2)):
        qs = np.zeros((count, len(chain)))
        state = State(qs, qs, qs)
        for accelerations, torques in ((qs, None), (None, qs)):
            found = dynamics(panda, chain, state, gravity=G, load=LOAD, accelerations=accelerations, torques=torques)
            assert found.mass_matrices is not None
            assert found.mass_matrices.shape == (count, len(chain), len(chain))
            assert found.certificate.samples == 0
    stone = RobotModel(read_urdf('<robot name="stone"><link name="base"/></robot>'))
    qs = np.empty((2, 0))
    found = dynamics(stone, stone.chain(None, None), State(qs, qs, qs), gravity=G, load=LOAD, torques=qs)
    assert found.accelerations is not None
    assert found.accelerations.shape == (2, 0)


@pytest.mark.parametrize("letters", ["R", "P", "RP" * 16])
def test_one_joint_and_thirty_two(letters: str) -> None:
    machine = of_table(rows("standard", [(0.3, 0.4, 0.1, 0.2)] * len(letters), letters))
    chain = machine.chain(None, None)
    state = moving(chain, 2)
    torques = np.ones_like(state.qs)
    found = dynamics(machine, chain, state, gravity=G, torques=torques)
    assert found.mass_matrices is not None
    assert found.mass_matrices.shape == (2, len(letters), len(letters))
    assert found.certificate.samples == 2


def test_a_wrong_number_is_never_sent(monkeypatch: pytest.MonkeyPatch) -> None:
    ur5 = robot("ur5")
    chain = ur5.chain(None, None)
    state = moving(chain, 1)
    for method in ("mass_matrix", "coriolis_matrix", "gravity_torques", "inverse", "forward"):
        right = getattr(PinocchioDynamics, method)
        with monkeypatch.context() as patch:
            patch.setattr(PinocchioDynamics, method, lambda *given, right=right: right(*given) + 1e-6)
            ones, forward = np.ones((1, 6)), method == "forward"
            with pytest.raises(CertificationFailed):
                dynamics(
                    ur5,
                    chain,
                    state,
                    gravity=G,
                    accelerations=None if forward else ones,
                    torques=ones if forward else None,
                )


@pytest.mark.slow
def test_mechanisms_are_kept_but_not_without_end() -> None:
    ur5, many = robot("ur5"), robot("tiago_dual")
    chain = ur5.chain(None, None)
    assert mechanism(ur5, chain) is mechanism(ur5, chain) is known_mechanism(ur5, chain)
    first, *_, last = chains = [many.chain(None, link) for link in many.description.frames[:20]]
    for chain in chains:
        mechanism(many, chain)
    assert known_mechanism(many, last) is not None
    assert known_mechanism(many, first) is None


def test_a_mechanism_does_not_keep_its_robot() -> None:
    arm = RobotModel(read_urdf(MASSLESS.format(mass=1.0)))
    mechanism(arm, arm.chain(None, None))
    gone = weakref.ref(arm)
    del arm
    gc.collect()
    assert gone() is None
