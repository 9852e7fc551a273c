"""MJCF: parts that a model repeats or takes from another one are those that it would have if they were written out."""

import pytest

from gelenk.errors import InvalidUrdf
from gelenk.robot.description import Description, Shape
from gelenk.robot.formats.mjcf.scope import MAX_COPIED, MAX_COPIES
from gelenk.robot.formats.reading import as_urdf, is_robot
from tests.robot.formats.test_mjcf import bodies, read, sources

LEG = '<body name="leg"><joint name="q"/><geom size="0.1"/></body>'
ARM = """<mujoco model="arm">
  <compiler angle="radian" eulerseq="ZYX" meshdir="m"/>
  <default><geom size="0.3"/><default class="hinges"><joint range="-1 1"/></default></default>
  <asset><mesh name="part" file="part.stl"/></asset>
  <worldbody>
    <frame name="stand" pos="0 0 3">
      <body name="a" pos="0 0 1" childclass="hinges"><joint name="x"/><geom/>
        <body name="b" euler="0.1 0.2 0.3"><joint name="y"/><geom type="mesh" mesh="part"/></body>
      </body>
    </frame>
    <body name="other"><joint name="z"/></body>
  </worldbody>
  <equality><joint joint1="x" joint2="y"/><joint joint1="z" joint2="y"/></equality>
</mujoco>"""
FILES = {"arm.xml": "", "sub/arm.xml": ARM, "sub/m/part.stl": "", "loop.xml": "", "robot.urdf": "<robot/>"}
ASSET = '<asset><model name="arm" file="sub/arm.xml"/></asset>'


def shape_of(description: Description, link: str) -> Shape:
    return next(each.shapes[0] for each in description.links if each.name == link)


def attached(content: str, asset: str = ASSET) -> str:
    return f'{asset}<worldbody><frame pos="1 0 0">{content}</frame></worldbody>'


def test_a_part_of_another_model_keeps_its_units_defaults_and_meshes() -> None:
    found = read(
        attached('<attach model="arm" body="b" prefix="l_"/><attach model="arm" body="a" prefix="r_"/>'), FILES
    )
    assert found.frames == ("world", "l_b", "r_a", "r_b")
    assert shape_of(found, "r_b").mesh == "sub/m/part.stl"
    assert shape_of(found, "r_a").size == (0.3,)
    left, right = found.joint["l_y"], found.joint["r_y"]
    assert (left.limits.lower, left.limits.upper) == (right.limits.lower, right.limits.upper) == (-1.0, 1.0)
    assert left.origin.xyz == (1.0, 0.0, 0.0)
    written = bodies('<body name="b" euler="0.1 0.2 0.3"/>', '<compiler angle="radian" eulerseq="ZYX"/>').joints[0]
    assert left.origin.rpy == right.origin.rpy == pytest.approx(written.origin.rpy)
    assert {name: joint.mimic and joint.mimic.joint for name, joint in found.joint.items()} == {
        "l_y": None, "r_x": "r_y", "r_y": None,
    }  # fmt: skip


def test_all_of_another_world_or_a_frame_of_it_is_attached() -> None:
    assert read(attached('<attach model="arm" prefix="p_"/>'), FILES).frames == ("world", "p_a", "p_b", "p_other")
    stand = read(attached('<attach model="arm" frame="stand" prefix="p_"/>'), FILES)
    assert stand.frames == ("world", "p_a", "p_b")
    assert stand.joint["p_x"].origin.xyz == (1.0, 0.0, 4.0)
    unnamed = ASSET.replace('name="arm"', "")
    assert len(read(attached('<attach model="arm" prefix=""/>', unnamed), FILES).links) == 4


def test_models_are_attached_by_attached_ones_and_repeated() -> None:
    inner = f'<mujoco>{ASSET.replace("sub/", "")}<worldbody><body name="m"><attach model="arm" body="b" prefix="i_"/>'
    files = FILES | {"sub/two.xml": f"{inner}</body></worldbody></mujoco>"}
    asset = '<asset><model name="two" file="sub/two.xml"/></asset>'
    twice = '<replicate count="2" offset="1 0 0" sep="_"><attach model="two" prefix="o_"/></replicate>'
    found = read(attached(twice, asset), files)
    assert found.frames == ("world", "o_m_0", "o_i_b_0", "o_m_1", "o_i_b_1")
    assert shape_of(found, "o_i_b_1").mesh == "sub/m/part.stl"
    assert found.joint["o_m_1_fixed"].origin.xyz == (2.0, 0.0, 0.0)


def test_equalities_that_lead_out_of_copies_are_not_read() -> None:
    found = read(
        f'<worldbody><body><joint name="z"/></body><replicate count="2">{LEG}</replicate></worldbody>'
        '<equality><joint joint1="q" joint2="z"/></equality>'
    )
    assert found.warnings == ("line 2: it joins a joint of the copies of line 2 with another one: it is not read",)
    assert all(joint.mimic is None for joint in found.joints)


def test_what_is_in_another_file_is_warned_of_by_its_name() -> None:
    files = FILES | {"sub/arm.xml": ARM.replace("<geom/>", "<composite/>")}
    found = read(attached('<attach model="arm" body="a" prefix="p_"/>'), files)
    assert "file 'sub/arm.xml': line 7: 'composite' is not read" in found.warnings


def test_a_model_of_copies_alone_is_a_robot() -> None:
    assert is_robot(f'<mujoco><worldbody><replicate count="2">{LEG}</replicate></worldbody></mujoco>'.encode())


NESTED = "<replicate count='10'>" * 50 + LEG + "</replicate>" * 50
REFUSED = {
    f'<replicate count="{10**9}">{LEG}</replicate>': f"with 1000000000 more the model has more than {MAX_COPIES}",
    NESTED: f"replicate: with 10 more the copies have more than {MAX_COPIED} elements",
    f'<replicate count="{10**30}">{LEG}</replicate>': "must be a whole number",
    '<replicate count="2.5"/>': "count is '2.5' but must be a whole number",
    "<replicate/>": "count is '' but must be a whole number",
    f'<replicate count="2" sep="{"a" * 65}"/>': "sep has 65 characters; at most 64 are allowed",
    '<attach model="no" prefix="a"/>': "attach: there is no model 'no' among the assets",
    '<attach model="arm" body="no"/>': "attach: the model 'arm' has no body 'no'",
    '<attach model="arm" frame="no"/>': "attach: the model 'arm' has no frame 'no'",
    '<attach model="arm" body="a"/><attach model="arm" body="a"/>': "a second body of this name",
    '<attach model="arm" body="a"/>' * 1025: f"the model has more than {MAX_COPIES} copies",
}  # fmt: skip


@pytest.mark.parametrize("content", REFUSED, ids=range(len(REFUSED)))
def test_copies_are_bounded(content: str) -> None:
    with pytest.raises(InvalidUrdf, match=r"^file '(sub/)?arm\.xml': line \d+: ") as refused:
        read(attached(content), FILES)
    assert REFUSED[content] in str(refused.value)


ASSETS = {
    "../../etc/passwd": "there is no file '../../etc/passwd'",
    "/etc/passwd": "'/etc/passwd' is not looked for",
    "no.xml": "there is no file 'no.xml'",
    "robot.urdf": "'robot.urdf' is no MJCF: its element is 'robot'",
    "arm.xml": "'arm.xml' attaches itself: arm.xml → arm.xml",
    "a.xml": "file 'b.xml': line 1: attach: 'a.xml' attaches itself: a.xml → b.xml → a.xml",
    "c0.xml": "more than 8 models attach each other in a chain",
}


def link(name: str) -> str:
    asset = f'<asset><model name="next" file="{name}"/></asset>'
    return f'<mujoco>{asset}<worldbody><attach model="next" prefix="n"/></worldbody></mujoco>'


@pytest.mark.parametrize("name", ASSETS)
def test_models_come_from_the_upload_and_never_attach_themselves(name: str) -> None:
    chain = {f"c{n}.xml": link(f"c{n + 1}.xml") for n in range(9)}
    files = FILES | {"a.xml": link("b.xml"), "b.xml": link("a.xml")} | chain
    with pytest.raises(InvalidUrdf) as refused:
        as_urdf(link(name).encode(), "arm.xml", sources(files))
    assert ASSETS[name] in str(refused.value)


def test_equalities_are_few() -> None:
    with pytest.raises(InvalidUrdf, match="the model has more than 1024 equalities"):
        read(f"<worldbody>{LEG}</worldbody><equality>{'<connect/>' * 1025}</equality>")
