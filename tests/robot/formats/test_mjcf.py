"""Reading MJCF: poses as MuJoCo computes them, and what is warned of or refused."""

import json
import math
from collections.abc import Mapping

import numpy as np
import pytest

from gelenk.errors import InvalidUrdf
from gelenk.robot.description import Description
from gelenk.robot.formats.mjcf.model import read_model
from gelenk.robot.formats.mjcf.reader import read_mjcf
from gelenk.robot.formats.reading import as_urdf
from gelenk.robot.formats.sources import Sources, placed_xml
from gelenk.robot.urdf import read_urdf
from gelenk.store.meshes import MeshFiles
from tests.corpus.mjcf import MODELS, POSES
from tests.oracles.urdf_product import UrdfProduct


def sources(files: Mapping[str, str]) -> Sources:
    return Sources(lambda name, folder: MeshFiles(files, folder).find(name), lambda path: files[path].encode())


def read(content: str, files: Mapping[str, str] | None = None) -> Description:
    return read_mjcf(placed_xml(f"<mujoco>\n{content}\n</mujoco>", "arm.xml"), sources(files or {}))


def bodies(content: str, before: str = "") -> Description:
    return read(f"{before}<worldbody>{content}</worldbody>")


@pytest.mark.parametrize("name", MODELS)
def test_frames_are_where_mujoco_has_them(name: str) -> None:
    robot = UrdfProduct(as_urdf(MODELS[name].encode(), "", Sources()).urdf.decode())
    for case in json.loads(POSES.read_text())[name]:
        q = {joint: np.array([value]) for joint, value in case["q"].items()}
        assert set(case["poses"]) <= set(robot.links)
        for frame, T in case["poses"].items():
            np.testing.assert_allclose(robot.poses(robot.root, frame, q)[0], T, rtol=0, atol=1e-12)


def test_limits_and_types_are_kept() -> None:
    arm = bodies(
        '<body name="a"><joint name="h" range="-90 45" actuatorfrcrange="-5 8"/><joint name="c"/>'
        '<joint name="s" type="slide" range="-1 2"/><joint name="n" range="-1 1" limited="false"/>'
        '<joint name="t" type="slide"/></body>'
    )
    types = {name: joint.type for name, joint in arm.joint.items()}
    assert types == {"h": "revolute", "c": "continuous", "s": "prismatic", "n": "continuous", "t": "prismatic"}
    limits = arm.joint["h"].limits
    assert (limits.lower, limits.upper, limits.effort) == (-math.pi / 2, math.pi / 4, 8.0)
    assert (arm.joint["s"].limits.lower, arm.joint["t"].limits.upper) == (-1.0, 1.0)
    assert arm.warnings == ("line 2: a slide joint without a range: ±1 m is taken",)
    assert bodies('<body><joint range="-1 1"/></body>', '<compiler autolimits="false"/>').joints[0].type == "continuous"


def test_shapes_are_whole_lengths_in_the_role_that_they_have() -> None:
    geoms = {
        '<geom type="box" size="1 2 3" contype="0" conaffinity="0"/>': [("visual", "box", (2.0, 4.0, 6.0))],
        '<geom size="0.5" group="3"/>': [("collision", "sphere", (0.5,))],
        '<geom type="capsule" size="0.5" fromto="0 0 0 0 3 4"/>': [
            (role, "capsule", (0.5, 5.0)) for role in ("visual", "collision")
        ],
        '<geom type="mesh" mesh="part" group="3"/>': [("collision", "mesh", (0.1, 0.1, 0.1))],
    }
    before = '<compiler meshdir="assets"/><asset><mesh file="part.stl" scale="0.1 0.1 0.1" refpos="1 0 0"/></asset>'
    for geom, expected in geoms.items():
        shapes = bodies(f'<body name="a" pos="0 0 1">{geom}</body>', before).links[1].shapes
        assert [(shape.role, shape.kind, shape.size) for shape in shapes] == expected
    assert shapes[0].mesh == "assets/part.stl"
    assert shapes[0].origin.xyz == (-1.0, 0.0, 0.0)
    capsule = bodies('<body><geom type="capsule" size="0.5" fromto="0 0 0 0 3 4"/></body>').links[1].shapes[0]
    assert capsule.origin.xyz == (0.0, 1.5, 2.0)


def test_an_inertia_is_kept_with_its_frame() -> None:
    found = bodies(
        '<body><inertial pos="1 2 3" quat="0 1 0 0" mass="2" diaginertia="3 4 5"/></body>'
        '<body><inertial pos="0 0 0" mass="2" fullinertia="3 4 5 0.1 0.2 0.3"/></body>'
    )
    one, other = (link.inertial for link in found.links[1:])
    assert one is not None and other is not None
    assert (one.mass, one.origin.xyz, one.inertia) == (2.0, (1.0, 2.0, 3.0), (3.0, 0.0, 0.0, 4.0, 0.0, 5.0))
    assert abs(one.origin.rpy[0]) == pytest.approx(math.pi)
    assert other.inertia == (3.0, 0.1, 0.2, 4.0, 0.3, 5.0)


def test_files_are_included_from_the_upload_alone() -> None:
    part = '<mujocoinclude><body name="b"><joint name="q"/></body></mujocoinclude>'
    whole = '<worldbody><body name="a"><include file="parts/b.xml"/></body></worldbody>'
    assert read(whole, {"arm.xml": "", "parts/b.xml": part}).frames == ("world", "a", "b")
    with pytest.raises(InvalidUrdf, match="line 2: include: there is no file 'parts"):
        read(whole)
    with pytest.raises(InvalidUrdf, match="is included twice"):
        read(whole, {"parts/b.xml": '<mujocoinclude><include file="parts/b.xml"/></mujocoinclude>'})
    fault = part.replace("<joint", '<joint type="screw"')
    with pytest.raises(InvalidUrdf, match=r"file 'parts/b\.xml': line 1: joint 'q': the joint's type is 'screw'"):
        read(whole, {"parts/b.xml": fault})


JOINTS = '<body name="a"><joint name="x"/><body name="b"><joint name="y"/></body></body>'
WARNED = {
    "<actuator><motor joint='x'/></actuator>": "line 3: actuator is not read",
    "<tendon><fixed/></tendon>": "line 3: tendon is not read",
    "<equality><connect body1='a'/></equality>": "equality of kind 'connect' is not read: it would close a loop",
    "<equality><joint joint1='x' joint2='y' polycoef='0 1 2'/></equality>": "line 3: the equality is not linear",
    "<equality><joint joint1='x'/></equality>": "joint 'x' is a constant",
    "<equality><joint joint1='x' joint2='y'/><joint joint1='y' joint2='x'/></equality>": "follows another one",
    "<worldbody><body><geom type='ellipsoid' size='1 2 3'/></body></worldbody>": "line 3: not drawn: a ellipsoid",
    "<worldbody><body><composite/></body></worldbody>": "line 3: 'composite' is not read",
    "<worldbody><body><joint type='ball'/></body></worldbody>": "a ball joint is read as a floating one",
}


@pytest.mark.parametrize("content", WARNED)
def test_what_is_not_read_is_a_warning_with_its_line(content: str) -> None:
    found = read(f"<worldbody>{JOINTS}</worldbody>\n{content}")
    assert any(WARNED[content] in warning for warning in found.warnings)
    assert read_urdf(as_urdf(f"<mujoco><worldbody>{JOINTS}</worldbody></mujoco>".encode(), "", Sources()).urdf.decode())


REFUSED = {
    "<worldbody/>": "the model has no body",
    "<worldbody><body pos='0 0'/></worldbody>": "pos is '0 0' but must be 3 numbers",
    "<worldbody><body pos='0 0 nan'/></worldbody>": "pos is '0 0 nan' but must be 3 numbers",
    "<worldbody><body quat='0 0 0 0'/></worldbody>": "quat is zero",
    "<worldbody><body quat='1 0 0 0' euler='0 0 0'/></worldbody>": "quat and euler both say the orientation",
    "<worldbody><body><joint axis='0 0 0'/></body></worldbody>": "axis is zero",
    "<worldbody><body><joint range='1 0' limited='true'/></body></worldbody>": "the range begins at 1 and ends at 0",
    "<worldbody><body childclass='no'><joint/></body></worldbody>": "there is no default class 'no'",
    "<worldbody><body name='a'/><body name='a'/></worldbody>": "a second body of this name",
    "<worldbody><body><inertial pos='0 0 0'/></body></worldbody>": "no mass",
    "<default class='x'/><worldbody/>": "the outermost default is 'main' and takes no other name, such as 'x'",
    f"<worldbody>{'<body><joint/></body>' * 513}</worldbody>": "the model has 1026 bodies and joints; at most 1024",
    "<compiler coordinate='global'/><worldbody/>": "coordinate='global'",
    "<compiler eulerseq='xyq'/><worldbody/>": "must be three letters",
    "<worldbody><body><joint name='x'/></body></worldbody><equality><joint joint1='x' joint2='z'/></equality>": "'z'",
}


@pytest.mark.parametrize("content", REFUSED)
def test_what_is_no_robot_is_refused_with_its_line(content: str) -> None:
    with pytest.raises(InvalidUrdf) as refused:
        read(content)
    assert REFUSED[content] in str(refused.value)
    assert str(refused.value).startswith("file 'arm.xml': line ")


def test_a_cut_model_is_read_or_refused() -> None:
    for text in MODELS.values():
        for end in range(0, len(text), 37):
            for cut in (text[:end], text[:end] + text[end + 11 :]):
                try:
                    as_urdf(cut.encode(), "", Sources())
                except InvalidUrdf:
                    continue


def test_what_is_nested_too_deeply_is_refused() -> None:
    files = {
        f"{n}.xml": f'<mujocoinclude><frame><include file="{n + 1}.xml"/></frame></mujocoinclude>' for n in range(1000)
    }
    text = '<mujoco><worldbody><include file="0.xml"/></worldbody></mujoco>'
    with pytest.raises(InvalidUrdf, match="bodies, frames or includes are nested too deeply"):
        as_urdf(text.encode(), "arm.xml", Sources(lambda name, _: [name], lambda path: files[path].encode()))


def test_a_range_without_extent_is_none_unless_it_is_said_to_limit() -> None:
    for range_ in ("0 0", "1 0"):
        assert bodies(f'<body><joint range="{range_}"/></body>').joints[0].type == "continuous"
    assert bodies('<body><joint range="0 0" limited="true"/></body>').joints[0].type == "revolute"


def test_warnings_are_few() -> None:
    found = bodies("<body>" + "<geom type='plane'/>" * 99 + "</body>").warnings
    assert len(found) == 51
    assert found[0] == "line 2: not drawn: a plane"
    assert found[-1] == "and more that is not read"


def test_classes_share_what_they_inherit() -> None:
    classes = '<default><tendon width="1"/><geom size="1"/><default class="b"/><default class="c"/></default>'
    defaults = read_model(placed_xml(f"<mujoco>{classes}</mujoco>", ""), Sources()).defaults
    assert defaults["main"] == {"geom": {"size": "1"}}
    assert defaults["b"]["geom"] is defaults["c"]["geom"] is defaults["main"]["geom"]


def test_shapes_beyond_the_allowed_number_are_not_read() -> None:
    geoms = '<geom size="1" group="3"/>' * 513 + '<geom size="no"/>'
    arm = bodies(f'<body name="a">{geoms}</body>', '<compiler inertiafromgeom="false"/>')
    assert len(arm.links[1].shapes) == 512
    assert arm.warnings == ("line 2: more than 512 shapes: this one and those after it are not drawn",)
