"""Expanding xacro: as ROS's xacro does, and within bounds."""

import os
import time
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

import pytest
import xacro

from gelenk.errors import InvalidField, InvalidUrdf, KinematicsError
from gelenk.robot.formats import values
from gelenk.robot.formats.reading import as_urdf
from gelenk.robot.formats.scope import XacroScope, parameters_of
from gelenk.robot.formats.sources import Sources, placed_xml
from gelenk.robot.formats.xacro import _XacroExpansion, expand
from gelenk.robot.urdf import read_urdf
from gelenk.robot.xml import Element, read_xml
from gelenk.store.meshes import MeshFiles


def document(content: str) -> str:
    return f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{content}\n</robot>'


def sources(files: Mapping[str, str]) -> Sources:
    return Sources(lambda name, folder: MeshFiles(files, folder).find(name), lambda path: files[path].encode())


def ours(content: str, files: Mapping[str, str] | None = None, arguments: Mapping[str, str] | None = None) -> Element:
    root = placed_xml(document(content), "arm.xacro")
    return read_xml(expand(root, sources(files or {}), arguments or {}).text)


def test_folder() -> None:
    """The files below are those of one folder."""
    assert set(FILES) == {"parts.xacro", "sizes.yaml"}


FILES = {
    "parts.xacro": document(
        '<xacro:property name="far" value="0.25"/><xacro:macro name="part" params="n"><b n="${n}"/></xacro:macro>'
    ),
    "sizes.yaml": "a: {b: [1, 2.5], c: left}\nangle: !degrees 90\nbase: &x {k: 1}\nmore: {<<: *x, l: 2}\n",
}
AS_IN_ROS = {
    "numbers": '<a x="${1 + 2 * 3.5}" y="${7 // 2} ${7 / 2} ${2 ** 0.5}" z="${-pi / 2}"/>',
    "texts": "<a x=\"${'left' + '_' + str(3)}\" y=\"${'%' in 'a%'} ${'abc'[1:]}\" z=\"$${kept} $$(kept) 5$\"/>",
    "conditions": "<a x=\"${1 if 2 > 1 and not False else 'no'}\" y=\"${1 &lt; 2 &lt;= 2} ${'a' == 'b' or 3}\"/>",
    "functions": '<a x="${radians(180)} ${sin(pi/6)} ${math.hypot(3, 4)}" y="${max(1, 2)} ${round(2.567, 1)}"/>',
    "lists": '<a x="${[1, 2, 3][1]} ${len([1, 2])} ${sorted([3, 1])}" y="${[2 * i for i in range(3) if i]}"/>',
    "dictionaries": "<xacro:property name='d' value=\"${dict(a=1, b='x')}\"/><a x=\"${d['a']} ${d.get('z', 4)}\"/>",
    "a property": '<xacro:property name="w" value="0.5"/><xacro:property name="h" value="${2*w}"/><a x="${h} ${w}"/>',
    "a lazy property": '<xacro:property name="h" value="${2*w}"/><xacro:property name="w" value="3"/><a x="${h}"/>',
    "an eager property": '<xacro:property name="w" value="1"/><xacro:property name="h" value="${w}" lazy_eval="false"/>'
    '<xacro:property name="w" value="2"/><a x="${h} ${w}"/>',
    "a default": '<xacro:property name="w" value="1"/><xacro:property name="w" default="2"/>'
    '<xacro:property name="v" default="2"/><a x="${w}${v}"/>',
    "a text that looks like one": '<xacro:macro name="m" params="w"><a x="${w + str(1)}"/></xacro:macro>'
    "<xacro:m w=\"'5'\"/>",
    "truth": '<xacro:property name="w" value="true"/><a x="${w} ${not w}"/>',
    "underscores": '<xacro:property name="w" value="1_0"/><a x="${w}"/>',
    "a macro": '<xacro:macro name="m" params="a b:=2 c=${a}"><x a="${a}" b="${b}"/></xacro:macro>'
    '<xacro:property name="a" value="9"/><xacro:m a="1"/><xacro:m a="${a}" b="q r"/>',
    "a macro of texts": '<xacro:macro name="m" params="a:=\'\' b:=\'x y\' *block"><x a="${a}" b="${b}"/>'
    '<xacro:insert_block name="block"/></xacro:macro><xacro:m><o z="${1+1}"/></xacro:m>',
    "blocks": '<xacro:macro name="m" params="*one **many"><xacro:insert_block name="many"/>'
    '<xacro:insert_block name="one"/></xacro:macro><xacro:m><a/><b><c/><d/></b></xacro:m>',
    "a property that is a block": '<xacro:property name="p"><a/></xacro:property><c><xacro:insert_block name="p"/></c>',
    "forwarding": '<xacro:macro name="m" params="a:=^ b:=^|5"><x a="${a}" b="${b}"/></xacro:macro>'
    '<xacro:property name="a" value="1"/><xacro:m/><xacro:m b="2"/>',
    "scopes": '<xacro:macro name="m" params="v"><xacro:property name="g" value="${v}" scope="global"/>'
    '<xacro:property name="q" value="${v + 1}" scope="parent"/><xacro:property name="own" value="1"/></xacro:macro>'
    '<xacro:m v="4"/><a x="${g} ${q}"/>',
    "a macro that calls itself": '<xacro:macro name="m" params="n"><xacro:if value="${n > 0}"><a n="${n}"/>'
    '<xacro:m n="${n - 1}"/></xacro:if></xacro:macro><xacro:m n="5"/>',
    "a macro by its name": '<xacro:macro name="m" params="n"><a n="${n}"/></xacro:macro>'
    '<xacro:call macro="${\'m\'}" n="1"/>',
    "if and unless": '<xacro:if value="1"><a/></xacro:if><xacro:unless value="true"><b/></xacro:unless>'
    '<xacro:if value="${1 == 2}"><c/></xacro:if>',
    "an element and an attribute": '<xacro:property name="t" value="link"/><xacro:element xacro:name="${t}" name="b">'
    '<xacro:attribute name="k" value="${t}"/></xacro:element>',
    "arguments": '<xacro:arg name="side" default="left"/><xacro:arg name="n" default="3"/>'
    '<a x="$(arg side)_link" y="${2 * $(arg n)}"/><xacro:if value="${\'$(arg side)\' == \'left\'}"><b/></xacro:if>',
    "eval": '<xacro:arg name="n" default="3"/><a x="$(eval n * 2)" y="$(eval 1 + 1)"/>',
    "the environment's default": '<a x="$(optenv GELENK_NO_SUCH_NAME some words)"/>',
    "an include": '<xacro:include filename="parts.xacro"/><xacro:part n="${far}"/>',
    "an include of a namespace": '<xacro:include filename="parts.xacro" ns="p"/><xacro:p.part n="${p.far}"/>',
    "an include that may be missing": '<xacro:include filename="none.xacro" optional="true"/><a/>',
    "yaml": '<xacro:property name="y" value="${xacro.load_yaml(\'sizes.yaml\')}"/>'
    "<a x=\"${y['a']['b'][1]} ${y.a.c}\" y=\"${y['angle']} ${y.more.k}\"/>",
    "what a control system reads": '<a/><gazebo><plugin x="$(nonsense)"/></gazebo>'.replace("$(nonsense)", "1"),
}


@pytest.mark.parametrize("name", AS_IN_ROS)
def test_it_gives_what_ros_gives(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for path, content in FILES.items():
        (tmp_path / path).write_text(content)
    (tmp_path / "arm.xacro").write_text(document(AS_IN_ROS[name]))
    monkeypatch.chdir(tmp_path)
    theirs = read_xml(str(xacro.process_file("arm.xacro").toxml()))
    theirs.children = [child for child in theirs.children if child.tag != "gazebo"]
    found = ours(AS_IN_ROS[name], FILES)
    theirs.attributes.pop("xmlns:xacro", None)
    assert found == theirs
    assert found.children


def test_a_package_is_found_by_the_end_of_its_path() -> None:
    files = {
        "top/arm/urdf/inc/link.xacro": document('<a x="$(find arm)/meshes/a.stl" y="file://$(find arm)/b"/>'),
        "other/urdf/inc/link.xacro": document("<b/>"),
    }
    found = ours('<xacro:include filename="$(find arm)/urdf/inc/link.xacro"/>', files)
    assert [child.tag for child in found.children] == ["a"]
    assert found.children[0].attributes == {"x": "package://arm/meshes/a.stl", "y": "package://arm/b"}


def test_arguments_are_those_that_the_files_declare() -> None:
    content = '<xacro:arg name="side" default="left"/><a x="$(arg side) $(arg other)"/>'
    given = {"side": "right", "other": "1"}
    assert ours(content, arguments=given).children[0].attributes == {"x": "right 1"}
    with pytest.raises(InvalidField, match="no argument 'lenght'; the description's arguments are 'other', 'side'"):
        ours(content, arguments={**given, "lenght": "1"})
    with pytest.raises(InvalidField, match="takes none"):
        as_urdf(b'<robot name="r"><link name="a"/></robot>', "", Sources(), {"side": "left"})


def test_the_name_of_the_robot_may_be_an_argument() -> None:
    text = document('<xacro:arg name="name" default="ur"/><link name="base"/>').replace('"r"', '"$(arg name)"')
    read = as_urdf(text.encode(), "", Sources(), {"name": "mine"})
    assert read_urdf(read.urdf.decode()).name == "mine"


def test_what_it_warns_of_is_kept() -> None:
    text = document("<xacro:property name='x' value=\"${xacro.warning('no', 'tool')}\"/><link name='a${x}'/>")
    assert as_urdf(text.encode(), "", Sources()).notes == ("no tool",)


ARM = """<xacro:include filename="parts.xacro"/>
<link name="base"/>
<xacro:arm n="${1}"/>"""
PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="arm" params="n">
    <link name="tool"/>
    <joint name="j" type="ball">
      <parent link="base"/><child link="tool"/>
    </joint>
  </xacro:macro>
</robot>"""


def test_a_fault_of_the_robot_is_told_where_the_xacro_has_it() -> None:
    with pytest.raises(InvalidUrdf) as refused:
        as_urdf(document(ARM).encode(), "arm.xacro", sources({"parts.xacro": PARTS}))
    assert (refused.value.file, refused.value.line) == ("parts.xacro", 4)
    assert "unknown type 'ball'" in str(refused.value)
    assert str(refused.value).startswith("file 'parts.xacro': line 4: joint 'j': ")


REFUSED = {
    "no macro": ("<xacro:nothing/>", "there is no macro 'nothing'"),
    "no block": ('<xacro:insert_block name="b"/>', "there is no block 'b'"),
    "no parameter": ('<xacro:macro name="m" params="a"/><xacro:m/>', "needs the parameter 'a'"),
    "an unknown parameter": ('<xacro:macro name="m"/><xacro:m b="1"/>', "has no parameter 'b'"),
    "too few blocks": ('<xacro:macro name="m" params="*a"/><xacro:m/>', "takes 1 block, and 0 are given"),
    "no property": ('<a x="${nothing}"/>', "there is no 'nothing'"),
    "a circle of properties": (
        '<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><a x="${a}"/>',
        "the property 'a' is defined by itself",
    ),
    "the machine": ('<a x="$(env HOME)"/>', "does not depend on the machine"),
    "another command": ('<a x="$(anon x)"/>', "is not known: arg, find, eval"),
    "no file": ('<xacro:include filename="b.xacro"/>', "there is no file 'b.xacro'"),
    "an absolute path": ('<xacro:include filename="/etc/passwd"/>', "'/etc/passwd' is not looked for"),
    "an address": ('<xacro:include filename="file:///etc/passwd"/>', "is not looked for"),
    "out of the folder": ("<a x=\"${load_yaml('../../../etc/passwd')}\"/>", "there is no file"),
    "an attribute of nothing": ('<xacro:if value="1"><xacro:attribute name="a" value="1"/></xacro:if>', "directly in"),
    "no truth": ('<xacro:if value="maybe"/>', "it must be true or false"),
    "a brace": ('<a x="${1"/>', "has no end"),
    "its own words": ("<a x=\"${xacro.fatal('no', 'arm')}\"/>", "no arm, in the expression"),
}
HOSTILE = {
    "itself": ('<xacro:include filename="arm.xacro"/>', "nested deeper than 100"),
    "a macro without end": (
        '<xacro:macro name="m"><xacro:m/></xacro:macro><xacro:m/>',
        "nested deeper than 100",
    ),
    "laughs": (
        "".join(
            f'<xacro:macro name="m{n}">{f"<xacro:m{n - 1}/>" * 10 if n else "<a/>"}</xacro:macro>' for n in range(9)
        )
        + "<xacro:m8/>",
        "more than",
    ),
    "laughs in texts": (
        "".join(f'<xacro:property name="a{n}" value="${{a{n - 1}}}${{a{n - 1}}}"/>' for n in range(1, 40))
        + '<xacro:property name="a0" value="lol"/><a x="${a39}"/>',
        "a text of more than 65536 characters",
    ),
    "laughs in yaml": ("<a x=\"${str(load_yaml('bomb.yaml'))}\"/>", "aliases counted as copies"),
    "a yaml within itself": ("<a x=\"${load_yaml('loop.yaml')}\"/>", "contains itself"),
    "a yaml of objects": ("<a x=\"${load_yaml('object.yaml')}\"/>", "is not read as YAML"),
    "a deep yaml": ("<a x=\"${load_yaml('deep.yaml')}\"/>", "more than 32 brackets"),
    "a deeper yaml": ("<a x=\"${load_yaml('deeper.yaml')}\"/>", "is not read as YAML: it is nested too deeply"),
}
BOMBS = {
    "arm.xacro": document('<xacro:include filename="arm.xacro"/>'),
    "bomb.yaml": "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n"
    + "".join(f"a{n}: &a{n} [{','.join([f'*a{n - 1}'] * 10)}]\n" for n in range(1, 9)),
    "loop.yaml": "&a [*a]",
    "object.yaml": "!!python/object/apply:os.system ['true']",
    "deep.yaml": "[" * 5000,
    "deeper.yaml": "\n".join(" " * depth + "a:" for depth in range(500)),
}


@pytest.mark.parametrize("name", [*REFUSED, *HOSTILE])
def test_what_cannot_be_expanded_is_refused_with_its_place(name: str) -> None:
    content, reason = (REFUSED | HOSTILE)[name]
    with pytest.raises(InvalidUrdf) as refused:
        ours(content, BOMBS)
    assert reason in str(refused.value)
    assert refused.value.line in {1, 2}


def test_parameters_are_read_in_one_way_at_once() -> None:
    """A default of many letters and a quote that is not closed can be cut in very many ways."""
    assert set(parameters_of("a:=1 b:=" + "x" * 4000 + "'")) == {"a", "b:=" + "x" * 4000 + "'"}


def test_the_steps_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(values, "MAX_STEPS", 1000)
    monkeypatch.setattr(values.Steps.__init__, "__defaults__", (1000,))
    with pytest.raises(InvalidUrdf, match="takes more than 1000 steps"):
        ours('<a x="${[i for i in range(2000)]}"/>')


def test_no_environment_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(os.environ, "ARM_SECRET", "told")
    assert ours('<a x="$(optenv ARM_SECRET none)"/>').children[0].attributes == {"x": "none"}


@pytest.mark.parametrize("length", [10, 1000])
def test_any_prefix_of_a_document_is_expanded_or_refused(length: int) -> None:
    whole = document("".join(AS_IN_ROS.values()))
    for end in range(0, len(whole), max(1, len(whole) // (length // 5))):
        with suppress(KinematicsError):
            expand(placed_xml(whole[:end], ""), sources(FILES), {})


@pytest.mark.parametrize(
    "text", ["'\\\\ud800'", "xacro.fatal('\\\\udfff')", "load_yaml('half.yaml')", "['a\\\\udc00']"]
)
def test_half_a_character_is_refused(text: str) -> None:
    with pytest.raises(InvalidUrdf, match="half of a surrogate pair") as refused:
        ours(f'<a x="${{{text}}}"/>'.replace("\\\\", "\\"), {"half.yaml": '"\\ud800"'})
    assert str(refused.value).encode()


def test_many_dollars_take_no_longer_than_many_letters() -> None:
    dollars = "$" * 4000
    assert ours(f'<a x="{dollars}" y="{dollars}{{kept}}"/>').children[0].attributes == {
        "x": dollars,
        "y": f"{dollars[1:]}{{kept}}",
    }
    started = time.process_time()
    ours("".join(f'<a x="{dollars}"/>' for _ in range(50)))
    assert time.process_time() - started < 5


def test_words_of_a_description_are_shortened_and_few() -> None:
    with pytest.raises(InvalidUrdf) as refused:
        ours("<a x=\"${xacro.fatal('no' * 4000)}\"/>")
    assert len(str(refused.value)) < 1500
    text = document(
        '<xacro:property name="w" value="${[xacro.warning(i) for i in range(99)]}"/><link name="a${len(w)}"/>'
    )
    assert as_urdf(text.encode(), "", Sources()).notes == tuple(map(str, range(20)))


def test_long_attributes_are_refused_while_they_are_made(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Element] = []
    plain = _XacroExpansion._plain

    def noted(expansion: _XacroExpansion, element: Element, tag: str, scope: XacroScope) -> Element:
        made.append(element)
        return plain(expansion, element, tag, scope)

    monkeypatch.setattr(_XacroExpansion, "_plain", noted)
    text = "${'a' * 9999}" * 6
    with pytest.raises(InvalidUrdf, match="it expands to more than 2097152 bytes"):
        ours(f'<xacro:property name="t" value="{text}"/>' + '<a x="${t}"/>' * 9999)
    assert len(made) < 50


def test_a_yaml_is_read_once_and_its_values_are_counted_first() -> None:
    reads: list[str] = []

    def content(path: str) -> bytes:
        reads.append(path)
        return b"a: 1"

    files = Sources(lambda name, _: [name], content)
    text = document('<xacro:property name="n" value="${load_yaml(\'a.yaml\')[\'a\']}" lazy_eval="false"/>' * 5)
    expand(placed_xml(text, "arm.xacro"), files, {})
    assert reads == ["a.yaml"]
    started = time.process_time()
    for long in ("1,", "- 1\n", "? \n", "a: \n"):
        with pytest.raises(InvalidUrdf, match="more than 10000 commas, lines, colons and dashes"):
            ours("<a x=\"${load_yaml('a.yaml')}\"/>", {"a.yaml": long * 20_000})
    assert time.process_time() - started < 5
