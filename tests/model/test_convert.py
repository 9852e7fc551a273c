"""The URDF that a table becomes, after a journey through XML, against the table's own product of transforms."""

from io import BytesIO
from math import pi

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from app.kinematics.forward import forward_kinematics
from app.model.arrays import Array
from app.model.convert import describe_dh, origin_of
from app.model.dh import Convention, DhJoint, DhTable
from app.model.poses import placement
from app.model.robot import Robot
from app.model.urdf import write_urdf
from tests.oracles import catalogue, dh_columns
from tests.robots import by_name, of_table, reread, robot, rows, samples, table, without_warnings

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


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("seed", range(10))
def test_every_frame_of_a_table(convention: Convention, seed: int) -> None:
    """Fifty tables each; poses by the kernels, which are certified by Pinocchio, against the table's."""
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


@pytest.mark.parametrize("name", catalogue.TABLES)
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


@pytest.mark.parametrize("name", catalogue.TABLES)
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
    assert Robot(describe_dh("arm", rows("modified", [(1, 0, 0, 0)] * 3, "RRR"))).default_chain == ("base", "tool")
