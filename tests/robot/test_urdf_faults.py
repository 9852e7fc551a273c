"""Faults that kinematics does not feel, put at random places into real descriptions: warnings, and the same robot.

Each fault is one that published files have. `strict` refuses what it refused before there was another reading.
"""

from collections.abc import Callable, Iterator
from functools import cache
from xml.etree import ElementTree as ET

import numpy as np
import pytest

from gelenk.errors import InvalidUrdf
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.robot.description import Description
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.corpus.urdf import ARM, AXIS, FORGIVEN, MOVING, Refused, fixed, link, one_joint, one_shape, robot
from tests.oracles import catalogue
from tests.robots import samples

ROBOTS = ("double_pendulum", "panda", "so101", "talos_left_arm", "xarm7", "z1")
MESH = '<mesh filename="package://arm/part.stl"/>'

Fault = Callable[[ET.Element, np.random.Generator], None]


def one_of(elements: list[ET.Element], rng: np.random.Generator) -> ET.Element:
    return elements[rng.integers(len(elements))]


def put_in(path: str, text: str) -> Fault:
    """An element more, anywhere in one of those that the path finds."""

    def fault(root: ET.Element, rng: np.random.Generator) -> None:
        parent = one_of(root.findall(path), rng)
        parent.insert(int(rng.integers(len(parent) + 1)), ET.fromstring(text))

    return fault


def drawn(geometry: str, origin: str = "", role: str = "visual") -> Fault:
    """A shape more on one of the links."""
    return put_in("link", f"<{role}>{origin}<geometry>{geometry}</geometry></{role}>")


def doubled(path: str) -> Fault:
    """One of the elements once more, somewhere behind itself."""

    def fault(root: ET.Element, rng: np.random.Generator) -> None:
        parents = {child: parent for parent in root.iter() for child in parent}
        child = one_of(root.findall(path), rng)
        parents[child].insert(int(rng.integers(list(parents[child]).index(child) + 1, len(parents[child]) + 1)), child)

    return fault


def inertial(change: Callable[[ET.Element], None]) -> Fault:
    """A change of one link's inertial."""
    return lambda root, rng: change(one_of(root.findall("link/inertial"), rng))


def set_to(path: str, key: str, value: str) -> Callable[[ET.Element], None]:
    return lambda element: element.find(path).set(key, value)  # type: ignore[union-attr]


FAULTS: dict[str, Fault] = {
    "a scale of four numbers": drawn(MESH.replace("/>", ' scale="1 1 1 1"/>')),
    "a scale of one number": drawn(MESH.replace("/>", ' scale="0.001"/>')),
    "a mesh without a name": drawn("<mesh/>"),
    "an origin in a geometry": drawn('<origin xyz="1 2 3"/><box size="1 1 1"/>'),
    "a material in a geometry": drawn('<box size="1 1 1"/><material name="red"/>', role="collision"),
    "a plane": drawn('<plane normal="0 0 1"/>', role="collision"),
    "a cdf": drawn('<cdf filename="part.cdf"/>'),
    "a geometry of nothing": drawn(""),
    "two shapes": drawn('<box size="1 1 1"/><sphere radius="1"/>'),
    "a box of two sides": drawn('<box size="1 1"/>'),
    "a radius below zero": drawn('<sphere radius="-1"/>'),
    "a shape at two numbers": drawn(MESH, origin='<origin xyz="1 2"/>'),
    "a shape nowhere": drawn(MESH, origin='<origin xyz="nan 0 0"/>'),
    "a visual of nothing": put_in("link", "<visual/>"),
    "two geometries": put_in("link", "<visual><geometry/><geometry/></visual>"),
    "an axis twice": doubled("joint/axis"),
    "an origin twice": doubled("joint/origin"),
    "a parent twice": doubled("joint/parent"),
    "a limit twice": doubled("joint/limit"),
    "an inertial twice": doubled("link/inertial"),
    "a mass twice": doubled("link/inertial/mass"),
    "another inertial": put_in("link[inertial]", '<inertial><mass value="7"/></inertial>'),
    "a mass below zero": inertial(set_to("mass", "value", "-1")),
    "a mass that is no number": inertial(set_to("mass", "value", "nan")),
    "an inertia without a moment": inertial(lambda element: element.find("inertia").attrib.clear()),  # type: ignore[union-attr]
}

EARLY = ("\n", "  \r\n\t", "\n<!-- made by hand -->\n", "<!-- a --><!-- <?xml b ?> -->", "\n\ufeff", "\ufeff\ufeff\n")


@cache
def text_of(name: str) -> str:
    return ET.tostring(ET.fromstring(catalogue.urdf_text(name)), encoding="unicode")


@cache
def clean(name: str) -> Description:
    return read_urdf(text_of(name), strict=True)


def poses(description: Description) -> np.ndarray:
    arm = RobotModel(description)
    chain = arm.chain(None, None)
    found = forward_kinematics(arm, chain, samples(chain, 3), arm.frames_on(chain)).poses
    return np.concatenate([found.rotations.ravel(), found.positions.ravel()])


def cases() -> Iterator[tuple[str, str]]:
    rng = np.random.default_rng(0)
    for fault in FAULTS:
        for name in rng.choice(ROBOTS, 2, replace=False):
            yield fault, str(name)


@pytest.mark.quick(6)
@pytest.mark.parametrize(("fault", "name"), list(cases()))
def test_a_fault_that_kinematics_does_not_feel_is_a_warning(fault: str, name: str) -> None:
    rng = np.random.default_rng([len(fault), len(name)])
    for _ in range(3):
        root = ET.fromstring(text_of(name))
        FAULTS[fault](root, rng)
        text = ET.tostring(root, encoding="unicode")
        with pytest.raises(InvalidUrdf) as refused:
            read_urdf(text, strict=True)
        found = read_urdf(text)
        # The refusal of the strict reading, and what follows from it.
        assert any(warning.startswith(refused.value.detail + ": ") for warning in found.warnings), found.warnings
        assert found.joints == clean(name).joints
        assert found.frames == clean(name).frames
    assert np.array_equal(poses(found), poses(clean(name)))


@pytest.mark.parametrize("early", EARLY)
def test_what_stands_before_the_xml_declaration_is_a_warning(early: str) -> None:
    text = '<?xml version="1.0" encoding="UTF-8"?>\n' + text_of("z1")
    with pytest.raises(InvalidUrdf, match="not well-formed"):
        read_urdf(early + text, strict=True)
    found = read_urdf(early + text)
    assert found.joints == clean("z1").joints
    assert "before the XML declaration" in found.warnings[0]
    assert read_urdf("\ufeff" + text).warnings == read_urdf(text).warnings == clean("z1").warnings
    with pytest.raises(InvalidUrdf) as refused:  # lines are those of the file
        read_urdf(early + text.replace("</robot>", "\n<link/></robot>"))
    assert refused.value.line == 1 + (early + text).count("\n") + 1
    with pytest.raises(InvalidUrdf, match="UTF-8"):
        read_urdf(early + text.replace("UTF-8", "latin-1"))


BEFORE = {
    "text": "x",
    "an element": "<a/>",
    "a comment without an end": "<!-- ",
    "a document type": "<!DOCTYPE robot>",
    "comments within comments": "<!--" * 200_000,
    "many comments and a letter": "<!---->" * 200_000 + "x",
}


@pytest.mark.parametrize("early", BEFORE.values(), ids=BEFORE)
def test_nothing_else_may_stand_before_the_declaration(early: str) -> None:
    with pytest.raises(InvalidUrdf):
        read_urdf(early + '<?xml version="1.0"?>' + ARM)


@pytest.mark.parametrize("case", FORGIVEN, ids=lambda case: case.name)
def test_the_strict_reading_refuses_what_is_forgiven(case: Refused) -> None:
    with pytest.raises(InvalidUrdf) as refused:
        read_urdf(case.text, strict=True)
    assert all(word in str(refused.value).lower() for word in case.mentions)
    found = read_urdf(case.text)
    assert found.joints == read_urdf(ARM).joints
    assert any(all(word in warning.lower() for word in case.mentions) for warning in found.warnings), found.warnings


def test_what_can_be_drawn_is() -> None:
    four = read_urdf(one_shape(MESH.replace("/>", ' scale="0.001 0.002 0.003 1"/>')))
    beside = read_urdf(one_shape('<origin xyz="1 2 3"/><box size="1 2 3"/><material name="red"/>'))
    (scaled,), (box,) = (description.links[1].shapes for description in (four, beside))
    assert scaled.size == (0.001, 0.002, 0.003)
    assert (box.kind, box.size, box.origin.xyz) == ("box", (1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
    assert read_urdf(one_shape('<plane normal="0 0 1"/>')).links[1].shapes == ()


def test_the_first_inertial_counts() -> None:
    body = '<inertial><mass value="{}"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    found = read_urdf(robot(link("base", body.format(2) + body.format(3)))).links[0].inertial
    assert found is not None
    assert found.mass == 2.0


def test_a_fixed_joint_needs_no_axis_and_no_limit() -> None:
    still = fixed("rest", "base", "forearm")
    for odd in ('<axis xyz="1 0 0"/><axis xyz="0 1 0"/>', '<limit lower="x"/>', '<limit effort="-1"/>'):
        text = robot(link("base"), link("forearm"), still.replace("</joint>", odd + "</joint>"))
        with pytest.raises(InvalidUrdf) as refused:
            read_urdf(text, strict=True)
        found = read_urdf(text)
        assert found.joints == read_urdf(robot(link("base"), link("forearm"), still)).joints
        assert found.warnings == (f"{refused.value.detail}: a fixed joint does not move",)


@pytest.mark.parametrize(
    "felt",
    [
        one_joint(MOVING + '<axis xyz="0 1 0"/>'),
        one_joint(MOVING + '<axis xyz="0 0 1 0"/>'),
        one_joint('<origin xyz="1 0 0 0"/>' + MOVING),
        one_joint(AXIS + '<limit lower="1" upper="-1" effort="1" velocity="1"/>'),
        one_joint(AXIS + '<limit lower="-1" upper="1" effort="1" velocity="-1"/>'),
    ],
)
def test_what_kinematics_feels_stays_a_refusal(felt: str) -> None:
    with pytest.raises(InvalidUrdf):
        read_urdf(felt)


# What is left of a xacro


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (ARM.replace('xyz="0 0 1"', 'xyz="$(optenv AXIS 0 0 1)"'), "$(optenv AXIS 0 0 1)"),
        (ARM.replace('upper="1"', 'upper="${pi}"'), "${pi}"),
        (ARM.replace('type="revolute"', 'type="$(arg type)"'), "$(arg type)"),
        (ARM.replace('parent link="base"', 'parent link="${prefix}base"'), "${prefix}base"),
        (
            ARM.replace("<link", '<include filename="$(find arm)/more.xacro"/><link', 1).replace("revolute", "", 1),
            "include",
        ),
        (ARM.replace("<link", '<property name="r" value="1"/><link', 1).replace("revolute", "", 1), "property"),
    ],
)
def test_a_refusal_of_what_xacro_left_says_how_to_go_on(text: str, found: str) -> None:
    for strict in (False, True):
        with pytest.raises(InvalidUrdf, match="expand the xacro") as refused:
            read_urdf(text, strict=strict)
        assert found in refused.value.detail


def test_what_xacro_left_in_a_mesh_is_a_warning() -> None:
    found = read_urdf(one_shape('<mesh filename="$(find arm)/part.stl"/>'))
    assert any("expand the xacro" in warning for warning in found.warnings)
    assert not any("xacro" in warning for warning in read_urdf(one_shape(MESH)).warnings)


@pytest.mark.parametrize("prefix", ["", "xacro:"])
def test_a_xacro_of_macros_alone_says_so(prefix: str) -> None:
    macros = "".join(f'<{prefix}macro name="{name}"><link name="base"/></{prefix}macro>' for name in ("arm", "hand"))
    with pytest.raises(InvalidUrdf, match="defines only the macros 'arm', 'hand'"):
        read_urdf(f'<robot name="arm">{macros}</robot>')
