"""Bodies of robots: of the shapes meant for contacts, placed as the description places them."""

import numpy as np
import pytest

from gelenk.collision.link_pairs import disabled_pairs, find_pairs
from gelenk.collision.robot_bodies import RobotBodies, find_bodies
from gelenk.errors import InvalidMesh
from gelenk.operations.robot_bodies import bodies_of
from gelenk.package_data import catalogue
from gelenk.robot.urdf import read_urdf
from gelenk.store.records import load, read_record

ARM = """<robot name="arm">
  <link name="base"><collision><origin xyz="0 0 0.1" rpy="0 1.5707963267948966 0"/>
    <geometry><cylinder radius="0.05" length="0.4"/></geometry></collision></link>
  <link name="flange"/>
  <link name="upper"><visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual>
    <collision><geometry><sphere radius="0.07"/></geometry></collision></link>
  <link name="lower"><visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual></link>
  <link name="tool"><collision><origin xyz="1 0 0"/><geometry><mesh filename="tool.obj" scale="2 2 2"/></geometry>
    </collision></link>
  <joint name="a" type="fixed"><parent link="base"/><child link="flange"/></joint>
  <joint name="b" type="continuous"><parent link="flange"/><child link="upper"/></joint>
  <joint name="c" type="continuous"><parent link="upper"/><child link="lower"/></joint>
  <joint name="d" type="fixed"><parent link="lower"/><child link="tool"/></joint>
</robot>"""
TETRAHEDRON = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def arm(mesh: bytes | None = TETRAHEDRON) -> RobotBodies:
    return find_bodies(read_urdf(ARM), lambda _: mesh)


def test_each_shape_is_a_body_in_its_place() -> None:
    found = {body.name: body for body in arm().bodies}
    assert [(body.link, body.kind, body.size) for body in found.values()] == [
        ("base", "cylinder", (0.05, 0.4)),
        ("upper", "sphere", (0.07,)),
        ("lower", "box", (0.1, 0.2, 0.3)),
        ("tool", "convex", ()),
    ]
    np.testing.assert_allclose(found["base"].T_link_body @ [0, 0, 0.2, 1], [0.2, 0, 0.1, 1], atol=1e-12)
    tool = found["tool"]
    corners = tool.points + tool.T_link_body[:3, 3]
    assert {tuple(corner.round(9) + 0.0) for corner in corners} == {(1, 0, 0), (3, 0, 0), (1, 2, 0), (1, 0, 2)}
    assert tool.excess == pytest.approx(0.0, abs=1e-9)
    assert np.abs(found["base"].spheres[:, 0]).max() > 0.1  # its cover lies along x as it does
    assert np.allclose(found["base"].spheres[:, 2], 0.1)


def test_visual_shapes_stand_in_with_a_warning_and_a_missing_mesh_leaves_none() -> None:
    found = arm(None)
    assert {body.link for body in found.bodies} == {"base", "upper", "lower"}
    assert found.warnings == (
        "no collision shapes: the visual ones are the bodies of 'lower'",
        "without a body: mesh 'tool.obj' is missing",
    )


def test_a_link_without_its_collision_mesh_is_what_it_looks_like() -> None:
    mesh = '<geometry><mesh filename="{}.obj"/></geometry>'.format
    urdf = f"""<robot name="r"><link name="base"><collision>{mesh("lost")}</collision><collision><geometry>
    <sphere radius="0.1"/></geometry></collision><visual>{mesh("shown")}</visual></link></robot>"""
    found = find_bodies(read_urdf(urdf), lambda name: TETRAHEDRON if name == "shown.obj" else None)
    assert [body.kind for body in found.bodies] == ["convex"]
    assert found.warnings == ("collision meshes are missing: the visual shapes are the bodies of 'base'",)
    without = find_bodies(read_urdf(urdf), lambda _: None)
    assert [body.kind for body in without.bodies] == ["sphere"]
    assert without.warnings == ("without a body: mesh 'lost.obj' is missing",)


def test_a_broken_mesh_is_named() -> None:
    with pytest.raises(InvalidMesh, match=r"mesh 'tool.obj': "):
        arm(b"f 1 2 3\n")


def test_neighbours_are_rigidly_joined_or_have_one_joint_and_no_body_between_them() -> None:
    pairs = {(pair.a, pair.b): pair.reason for pair in arm().pairs}
    assert len(pairs) == 6
    assert {pair for pair, reason in pairs.items() if reason == "neighbours"} == {
        ("base", "upper"),
        ("upper", "lower"),
        ("lower", "tool"),
    }


def test_an_srdf_leaves_pairs_out() -> None:
    srdf = b"<robot><disable_collisions link1='tool' link2='base'/><group name='a'/><disable_collisions/></robot>"
    disabled = disabled_pairs(srdf)
    assert disabled == [("tool", "base")]
    pairs = {(pair.a, pair.b): pair for pair in find_pairs(read_urdf(ARM), arm().bodies, disabled)}
    assert (pairs["base", "tool"].active, pairs["base", "tool"].reason) == (False, "srdf")


def test_a_robot_without_any_shape_says_so() -> None:
    assert find_bodies(read_urdf('<robot name="r"><link name="base"/></robot>'), lambda _: None).warnings == (
        "no link has a body: nothing of this robot can touch anything",
    )


def test_a_dh_table_has_the_cylinders_drawn_for_it() -> None:
    record = read_record(catalogue() / "scara", "catalogue")
    assert record is not None
    loaded = load(record)
    found = bodies_of(loaded)
    assert {body.kind for body in found.bodies} <= {"cylinder", "box"}
    assert found.warnings == ()
    assert bodies_of(loaded) is found
