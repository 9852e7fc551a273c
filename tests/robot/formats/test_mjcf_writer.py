"""Descriptions written as MJCF: poses by Pinocchio's reader of that format, and what the text says of each part."""

from typing import Any
from xml.etree import ElementTree as xml

import numpy as np
import pytest

from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.mjcf import certify_mjcf
from gelenk.robot.description import Description
from gelenk.robot.formats.mjcf.writer import write_mjcf
from gelenk.robot.notations import placement
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.oracles import catalogue
from tests.robots import robot, swept

URDF = """<robot name="parts">
  <link name="world"/>
  <link name="base"><inertial><origin xyz="0.1 0 0" rpy="0 0 0.5"/><mass value="2"/>
    <inertia ixx="0.3" ixy="0.01" ixz="0.02" iyy="0.4" iyz="0.03" izz="0.5"/></inertial>
    <visual><geometry><box size="1 2 3"/></geometry></visual>
    <collision><origin xyz="0 0 1"/><geometry><cylinder radius="0.2" length="0.6"/></geometry></collision>
    <collision><geometry><sphere radius="0.7"/></geometry></collision></link>
  <link name="arm"><visual><geometry><mesh filename="package://parts/arm.STL" scale="2 2 2"/></geometry></visual></link>
  <link name="hand"><visual><geometry><mesh filename="package://parts/hand.dae"/></geometry></visual></link>
  <link name="finger"/>
  <joint name="mount" type="fixed"><parent link="world"/><child link="base"/><origin rpy="0 0 -1.57"/></joint>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1" rpy="0.1 0.2 0.3"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="2" velocity="3" effort="40"/></joint>
  <joint name="spin" type="continuous"><parent link="arm"/><child link="hand"/><axis xyz="1 0 0"/></joint>
  <joint name="slide" type="prismatic"><parent link="hand"/><child link="finger"/><axis xyz="0 0 1"/>
    <limit lower="-9" upper="9" velocity="1" effort="1"/><mimic joint="turn" multiplier="-0.5" offset="0.25"/></joint>
</robot>"""


def parts(**options: Any) -> tuple[Description, xml.Element]:
    """The robot above, and its MJCF."""
    description = read_urdf(URDF)
    return description, xml.fromstring(write_mjcf(description, **options))


def only(root: xml.Element, path: str) -> xml.Element:
    """The one element there."""
    (found,) = root.findall(path)
    return found


def numbers(text: str | None) -> list[float]:
    return [float(word) for word in (text or "").split()]


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_pinocchio_reads_the_same_poses(name: str) -> None:
    machine = robot(name)
    certificate = certify_mjcf(machine, write_mjcf(machine.description))
    assert max(certificate.max_position_error, certificate.max_orientation_error) < 1e-13


def test_another_robot_is_told_apart() -> None:
    machine = RobotModel(read_urdf(URDF))
    text = write_mjcf(machine.description)
    moved = text.replace('name="arm" pos="0.0 0.0 1.0"', 'name="arm" pos="0.0 0.0 1.001"')
    assert moved != text
    with pytest.raises(CertificationFailed, match=r"differs by 0\.001"):
        certify_mjcf(machine, moved)


def test_joints_keep_types_axes_limits_and_leaders() -> None:
    _, root = parts()
    turn = only(root, ".//joint[@name='turn']")
    assert (turn.get("type"), numbers(turn.get("axis")), numbers(turn.get("range"))) == ("hinge", [0, 1, 0], [-1, 2])
    assert numbers(turn.get("actuatorfrcrange")) == [-40, 40]
    spin = only(root, ".//joint[@name='spin']")
    assert (spin.get("type"), spin.get("range")) == ("hinge", None)
    assert only(root, ".//body/joint[@name='slide']").get("type") == "slide"
    equality = only(root, "equality/joint")
    assert (equality.get("joint1"), equality.get("joint2")) == ("slide", "turn")
    assert numbers(equality.get("polycoef")) == [0.25, -0.5, 0, 0, 0]


def test_the_link_called_world_is_a_body_of_another_name() -> None:
    _, root = parts()
    assert [body.get("name") for body in root.findall("worldbody/body")] == ["world_"]
    assert numbers(only(root, ".//body[@name='base']").get("quat"))[3] == pytest.approx(np.sin(-1.57 / 2))


def test_principal_inertias_are_those_of_the_link() -> None:
    """The matrix by principal values and axes, in the link's axes, is that of the URDF turned by its origin."""
    _, root = parts()
    inertial = only(root, ".//body[@name='base']/inertial")
    w, x, y, z = numbers(inertial.get("quat"))
    v = np.array([x, y, z])
    R = np.eye(3) * (w * w - v @ v) + 2 * np.outer(v, v) + 2 * w * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    found = R @ np.diag(numbers(inertial.get("diaginertia"))) @ R.T
    turn = placement((0.1, 0, 0), (0, 0, 0.5))[:3, :3]
    given = np.array([[0.3, 0.01, 0.02], [0.01, 0.4, 0.03], [0.02, 0.03, 0.5]])
    assert found == pytest.approx(turn @ given @ turn.T, abs=1e-12)
    assert (inertial.get("mass"), numbers(inertial.get("pos"))) == ("2.0", [0.1, 0, 0])


def test_sizes_are_halves_and_only_collision_shapes_touch() -> None:
    _, root = parts()
    box, cylinder, sphere = root.findall(".//body[@name='base']/geom")
    assert [numbers(geometry.get("size")) for geometry in (box, cylinder, sphere)] == [[0.5, 1, 1.5], [0.2, 0.3], [0.7]]
    assert numbers(cylinder.get("pos")) == [0, 0, 1]
    assert (box.get("contype"), cylinder.get("contype")) == ("0", None)


def test_meshes_are_named_only_where_asked_and_readable() -> None:
    description, root = parts()
    assert root.findall(".//geom[@type='mesh']") == []
    files = {mesh: f"files/{mesh.rpartition('/')[2]}" for mesh in description.meshes}
    _, root = parts(meshes=files)
    asset = only(root, "asset/mesh")
    assert (asset.get("file"), numbers(asset.get("scale"))) == ("files/arm.STL", [2, 2, 2])
    assert only(root, ".//geom[@type='mesh']").get("mesh") == asset.get("name")


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_joints_of_several_axes_stay_at_zero(kind: str) -> None:
    text = f"""<robot name="r"><link name="a"/><link name="b"/>
      <joint name="j" type="{kind}"><parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/>
      <axis xyz="0 0 1"/></joint></robot>"""
    machine = RobotModel(read_urdf(text))
    assert certify_mjcf(machine, write_mjcf(machine.description)).max_position_error < 1e-14
    kinds = [joint.get("type") for joint in xml.fromstring(write_mjcf(machine.description)).iter("joint")]
    assert kinds == (["slide", "slide", "slide", "ball"] if kind == "floating" else ["slide", "slide", "hinge"])
