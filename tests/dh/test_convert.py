"""The URDF that a table becomes, after a journey through XML, against the table's own product of transforms.

And the same chain by a table of the other convention, which is the same by the textbook.
"""

from dataclasses import replace
from io import BytesIO
from math import pi

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.dh.tables.convert import converted, describe_dh
from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import pinocchio_poses
from gelenk.kinematics.judge.tables import certify_conversion, certify_table, table_configurations
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.robot.arrays import Array
from gelenk.robot.description import Mimic
from gelenk.robot.dh import Convention, DhJoint, DhTable
from gelenk.robot.notations import origin_of, placement
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import write_urdf
from tests.oracles import catalogue, dh_columns
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, of_table, reread, robot, rows, samples, swept, table, without_warnings

SPECIAL = (0.0, pi / 2, -pi / 2, pi, -pi, 1e-9, pi / 2 + 1e-12, pi / 2 - 5e-13, 2 * pi)
"""Angles at which roll, pitch and yaw degenerate, or nearly so."""


def random_table(convention: Convention, seed: int) -> DhTable:
    """One to ten joints of both types, half of the parameters special, between a random base and tool."""
    rng = np.random.default_rng(seed)

    def length() -> float:
        return float(rng.choice([0.0, rng.uniform(-1, 1)]))

    def angle() -> float:
        return float(rng.choice([rng.choice(SPECIAL), rng.uniform(-pi, pi)]))

    def place() -> Array:
        T = np.eye(4)
        T[:3, :3] = Rotation.from_euler("xyz", [angle(), angle(), angle()]).as_matrix()
        T[:3, 3] = rng.uniform(-1, 1, 3)
        return T

    joints = tuple(
        DhJoint(f"q{i}", "prismatic" if rng.random() < 0.3 else "revolute", length(), angle(), length(), angle())
        for i in range(rng.integers(1, 11))
    )
    return DhTable(convention, joints, place(), place())


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("seed", list(range(10)))
def test_every_frame_of_a_table(convention: Convention, seed: int) -> None:
    """Fifty tables each; poses by the kernels, and by Pinocchio itself, against the table's."""
    for number in range(50):
        dh = random_table(convention, 50 * seed + number)
        machine = of_table(dh)
        chain = machine.chain("base", "tool")
        qs = samples(chain, 4, number)
        names = [f"frame_{i}" for i in range(len(dh.joints) + 1)]
        answer = forward_kinematics(machine, chain, qs, names)
        frames = np.array([dh.frames(q) for q in qs])
        ours = np.array([answer.frames[name].matrices() for name in names]).swapaxes(0, 1)
        assert np.abs(ours - frames).max() < 1e-12, number
        assert np.abs(answer.poses.matrices() - [dh.pose(q) for q in qs]).max() < 1e-12, number
        certificate = answer.certificate
        assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-12, number
        judge = pinocchio_poses(machine, chain, "tool", qs, range(len(qs))).matrices()
        assert np.abs(judge - [dh.pose(q) for q in qs]).max() < 1e-12, number


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_certificate_of_a_table_is_what_is_measured(convention: Convention) -> None:
    for seed in range(1000, 1020):
        dh = random_table(convention, seed)
        machine = of_table(dh)
        chain = machine.chain("base", "tool")
        certificate = certify_table(machine, chain, dh, seed=seed)
        assert (certificate.samples, certificate.seed) == (100, seed)
        qs = table_configurations(chain, 100, seed)
        assert np.array_equal(qs, as_documented(dh, seed))
        judge = UrdfProduct(write_urdf(machine.description)).poses("base", "tool", by_name(chain, qs))
        ours = np.array([dh.pose(q) for q in qs])
        stated = certificate.max_position_error, certificate.max_orientation_error
        measured = np.linalg.norm((ours - judge)[:, :3, 3], axis=1).max()
        assert max(stated) < 1e-12
        assert stated[0] == pytest.approx(measured, abs=1e-14)


def as_documented(dh: DhTable, seed: int) -> Array:
    """The configurations of a certificate, by the words of its schema."""
    r = np.random.default_rng(seed).random((100, len(dh.joints)))
    bounds = np.array([(-pi, pi) if row.type == "revolute" else (-1.0, 1.0) for row in dh.joints])
    return np.asarray(bounds[:, 0] + r * (bounds[:, 1] - bounds[:, 0]))


@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_catalogue_tables_by_the_textbook(name: str) -> None:
    machine, textbook = robot(name), dh_columns.from_json(catalogue.dh_table(name))
    chain = machine.chain("base", "tool")
    assert list(chain.joint_names) == [joint["name"] for joint in catalogue.dh_table(name)["joints"]]
    qs = samples(chain, 200)
    expected = [textbook.pose(q) for q in qs]
    assert np.abs(forward_kinematics(machine, chain, qs).poses.matrices() - expected).max() < 1e-12


def test_limits_go_along() -> None:
    joints = (
        DhJoint("slide", "prismatic", 0.1, 0.2, 0.3, 0.4, lower=-0.2, upper=0.7, velocity=2.0, effort=30.0),
        DhJoint("turn", "revolute", 0.1, 0.2, 0.3, 0.4),
    )
    description = describe_dh("arm", DhTable("standard", joints))
    slide, turn = (description.joint[name].limits for name in ("slide", "turn"))
    assert (slide.lower, slide.upper, slide.velocity, slide.effort) == (-0.2, 0.7, 2.0, 30.0)
    assert (turn.lower, turn.upper, turn.velocity, turn.effort) == (-pi, pi, None, None)
    assert [warning for warning in description.warnings if "'turn'" in warning] == list(description.warnings) != []


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_written_and_read_again(convention: Convention) -> None:
    for seed in range(20):
        description = describe_dh("arm", random_table(convention, seed))
        assert without_warnings(reread(description)) == without_warnings(description)


@pytest.mark.parametrize("name", ["base_to_frame_0", "link_1_to_frame_1", "frame_1_to_tool", "link_1", "tool"])
def test_a_row_may_have_any_name(name: str) -> None:
    dh = DhTable("standard", (DhJoint(name, "revolute", 1.0, 0.0, 0.0, 0.0),))
    machine = of_table(dh)
    assert machine.chain("base", "tool").joint_names == (name,)


@pytest.mark.parametrize("angle", SPECIAL)
def test_origin_gives_the_transform_again(angle: float) -> None:
    for outer in SPECIAL:
        T = dh_columns.turn(2, outer) @ dh_columns.turn(1, angle) @ dh_columns.turn(0, 0.3) @ dh_columns.shift(0, 2.0)
        origin = origin_of(T)
        assert np.abs(placement(origin.xyz, origin.rpy) - T).max() < 2e-14


@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_another_reader_sees_the_same_robot(name: str) -> None:
    import yourdfpy

    dh = table(catalogue.dh_table(name))
    other = yourdfpy.URDF.load(BytesIO(write_urdf(describe_dh(name, dh)).encode()))
    chain = robot(name).chain("base", "tool")
    for q in samples(chain, 20):
        other.update_cfg({joint: value[0] for joint, value in by_name(chain, q[None]).items()})
        assert np.abs(other.get_transform("tool", "base") - dh.pose(q)).max() < 1e-12


def test_a_table_of_the_largest_lengths() -> None:
    dh = rows("standard", [(1e6, 1.0, 1e6, 1.0)] * 5, "RPRRP")
    machine = of_table(dh)
    chain = machine.chain("base", "tool")
    qs = samples(chain, 5)
    ours = forward_kinematics(machine, chain, qs).poses.matrices()
    assert np.abs(ours - [dh.pose(q) for q in qs]).max() < 1e-8


def test_default_chain_of_a_table() -> None:
    assert RobotModel(describe_dh("arm", rows("modified", [(1, 0, 0, 0)] * 3, "RRR"))).default_chain == ("base", "tool")


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_another_reader_sees_random_tables_the_same(convention: Convention) -> None:
    """It takes a placement within 1e-8 of the identity for the identity, so a few tables differ by that much."""
    import yourdfpy

    errors = []
    for seed in range(2000, 2030):
        dh = random_table(convention, seed)
        other = yourdfpy.URDF.load(BytesIO(write_urdf(describe_dh("arm", dh)).encode()))
        for q in samples(of_table(dh).chain("base", "tool"), 3, seed):
            other.update_cfg(dict(zip(dh.variables, q, strict=True)))
            errors.append(np.abs(other.get_transform("tool", "base") - dh.pose(q)).max())
    assert max(errors) < 2e-8
    assert np.mean(np.array(errors) < 1e-12) > 0.8


# Rows that follow


def geared(convention: Convention) -> DhTable:
    """Four rows of which two follow: one a row, one a joint outside."""
    row = DhJoint("row", "revolute", 0.3, 0.4, 0.1, 0.2, -1.0, 2.0)
    return DhTable(
        convention,
        (
            row,
            replace(row, name="second", type="prismatic", lower=-0.1, upper=0.5, mimic=Mimic("motor", -0.5, 0.1)),
            replace(row, name="third", lower=-3.0, upper=3.0, mimic=Mimic("row", -2.0, 0.3)),
            replace(row, name="fourth", type="prismatic", velocity=3.0, mimic=Mimic("motor", 2.0, -0.2)),
        ),
    )


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_joint_outside_the_table_leads_from_a_link_of_its_own(convention: Convention) -> None:
    import yourdfpy

    dh = geared(convention)
    machine = of_table(dh)
    assert machine.default_chain == ("base", "tool")
    chain = machine.chain(None, None)
    assert chain.joint_names == dh.variables == ("row", "motor")
    certificate = certify_table(machine, chain, dh)
    assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-14
    # Within [-0.1, 0.5] at -0.5 q + 0.1, and within [-1, 2] at 2 q - 0.2: the tighter of both at each end.
    assert (chain.lower[1], chain.upper[1]) == pytest.approx((-0.4, 0.4))
    motor = machine.description.joint["motor"]
    assert (motor.type, motor.limits.velocity) == ("prismatic", 1.5)
    assert any("'motor'" in warning for warning in describe_dh("arm", dh).warnings)
    other = yourdfpy.URDF.load(BytesIO(write_urdf(machine.description).encode()))
    for q in samples(chain, 5):
        other.update_cfg(dict(zip(dh.variables, q, strict=True)))
        assert np.abs(other.get_transform("tool", "base") - dh.pose(q)).max() < 1e-14


def test_a_last_row_that_follows_keeps_the_default_chain() -> None:
    row = DhJoint("row", "revolute", 0.3, 0.4, 0.1, 0.2)
    dh = DhTable("standard", (row, replace(row, name="last", mimic=Mimic("row"))))
    assert of_table(dh).default_chain == ("base", "tool")


def test_a_leader_of_the_name_of_a_fixed_joint() -> None:
    dh = DhTable("standard", (DhJoint("row", "revolute", 1, 0, 0, 0, mimic=Mimic("base_to_frame_0")),))
    assert of_table(dh).chain("base", "tool").joint_names == ("base_to_frame_0",)


@pytest.mark.parametrize("multiplier", [0.0, 1e-300, 1e6])
def test_a_leader_of_any_multiplier_has_limits(multiplier: float) -> None:
    row = DhJoint("row", "revolute", 0.3, 0.4, 0.1, 0.2, -1.0, 1.0, 1e18, mimic=Mimic("motor", multiplier))
    chain = of_table(DhTable("standard", (row,))).chain("base", "tool")
    assert -1e6 <= chain.lower[0] <= chain.upper[0] <= 1e6


# The other convention


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_other_convention_is_the_same_chain(convention: Convention) -> None:
    other: Convention = "modified" if convention == "standard" else "standard"
    for seed in range(200):
        dh = random_table(convention, seed)
        answer = converted(dh, other)
        assert answer.convention == other
        assert answer.variables == dh.variables
        for q in np.random.default_rng(seed).uniform(-pi, pi, (3, len(dh.joints))):
            assert np.abs(answer.pose(q) - dh.pose(q)).max() < 5e-14
        assert converted(dh, convention) is dh
        again = converted(answer, convention)
        for q in np.random.default_rng(seed).uniform(-pi, pi, (3, len(dh.joints))):
            assert np.abs(again.pose(q) - dh.pose(q)).max() < 5e-14


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_there_and_back_again_is_the_same_table(convention: Convention) -> None:
    """Where base (modified) or tool (standard) holds nothing that a row could not say."""
    other: Convention = "modified" if convention == "standard" else "standard"
    for seed in range(50):
        dh = replace(random_table(convention, seed), base=np.eye(4), tool=np.eye(4))
        again = converted(converted(dh, other), convention)
        for row, row_again in zip(dh.joints, again.joints, strict=True):
            turns = (row_again.alpha - row.alpha) / (2 * pi)
            assert abs(turns - round(turns)) < 1e-15
            assert replace(row_again, alpha=row.alpha) == row
        assert np.array_equal(again.base, np.eye(4))
        assert np.array_equal(again.tool, np.eye(4))


def test_numbers_move_by_one_row() -> None:
    craig = table(catalogue.dh_table("panda_dh"))
    standard = converted(craig, "standard")
    assert [row.a for row in standard.joints] == [0.0, 0.0, 0.0825, -0.0825, 0.0, 0.088, 0.0]
    assert [row.alpha for row in standard.joints[:-1]] == [row.alpha for row in craig.joints[1:]]
    assert [(row.d, row.theta, row.name, row.limits) for row in standard.joints] == [
        (row.d, row.theta, row.name, row.limits) for row in craig.joints
    ]
    assert np.array_equal(standard.base, np.eye(4))
    certificate = certify_conversion(craig, standard)
    assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-15


def test_a_wrong_conversion_is_withheld() -> None:
    craig = table(catalogue.dh_table("panda_dh"))
    wrong = replace(converted(craig, "standard"), tool=np.eye(4))
    with pytest.raises(CertificationFailed):
        certify_conversion(craig, wrong)
    machine = of_table(craig)
    chain = machine.chain("base", "tool")
    with pytest.raises(CertificationFailed):
        certify_table(machine, chain, wrong)
    assert certify_table(machine, chain, wrong, exact=False).max_position_error > 0.1
