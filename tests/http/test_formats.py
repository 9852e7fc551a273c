"""Robots uploaded in other formats than URDF: alone as text, and in a zip with the files that they include."""

import json
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from tests.corpus.zips import zipped
from tests.http.conftest import ready_client

NAMESPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
XACRO = f"""<robot name="two" {NAMESPACE}>
  <xacro:arg name="length" default="1.0"/>
  <xacro:include filename="$(find arm)/inc/link.xacro"/>
  <link name="base"/>
  <xacro:arm_link length="$(arg length)"/>
</robot>"""
LINK = f"""<robot {NAMESPACE}>
  <xacro:property name="limits" value="${{xacro.load_yaml('limits.yaml')}}"/>
  <xacro:macro name="arm_link" params="length">
    <link name="tool"><visual><geometry><mesh filename="file://$(find arm)/meshes/a.stl"/></geometry></visual></link>
    <joint name="slide" type="prismatic">
      <parent link="base"/><child link="tool"/><origin xyz="${{2 * length}} 0 0"/><axis xyz="0 0 1"/>
      <limit lower="0" upper="${{limits['upper']}}" velocity="1" effort="1"/>
    </joint>
  </xacro:macro>
</robot>"""
FILES: dict[str, str | bytes] = {
    "main/arm/urdf/arm.urdf.xacro": XACRO,
    "main/arm/inc/link.xacro": LINK,
    "main/arm/inc/limits.yaml": "upper: 0.5\n",
    "main/arm/package.xml": "<package><name>arm</name></package>",
    "main/arm/meshes/a.stl": "solid a\nendsolid a\n",
}


@pytest.fixture
def own(tmp_path: Path) -> Any:
    """A client of an application with an empty data folder."""
    yield from ready_client(tmp_path)


def send(client: TestClient, files: dict[str, str | bytes], method: str = "POST", path: str = "", **fields: str) -> Any:
    archive = {"archive": ("robot.zip", zipped(files))}
    return client.request(method, f"/v1/robots{path}", data=fields, files=archive)


def test_a_xacro_in_a_zip_is_expanded_with_its_files(own: TestClient) -> None:
    answer = send(own, FILES, name="two")
    assert answer.status_code == 201, answer.text
    robot = answer.json()
    assert robot["joints"][0]["limits"]["upper"] == 0.5
    assert robot["meshes"] == [{"reference": "package://arm/meshes/a.stl", "path": "main/arm/meshes/a.stl"}]
    assert "xacro" not in own.get("/v1/robots/two/urdf").text
    at = own.post("/v1/robots/two/fk", json={"joint_positions": [[0.5]]}).json()["poses"][0]["position"]
    assert at == [2.0, 0.0, 0.5]
    assert send(own, FILES, name="two").status_code == 200
    assert send(own, FILES, name="two", arguments='{"length": 2}').status_code == 409
    assert send(own, FILES, "PUT", "/two", arguments='{"length": 2}').status_code == 200
    at = own.post("/v1/robots/two/fk", json={"joint_positions": [[0.5]]}).json()["poses"][0]["position"]
    assert at == [4.0, 0.0, 0.5]


def test_arguments_are_checked(own: TestClient) -> None:
    unknown = send(own, FILES, name="two", arguments='{"lenght": 2}')
    assert unknown.status_code == 422
    assert unknown.json()["type"] == "urn:gelenk:invalid-field"
    assert "no argument 'lenght'; the description's arguments are 'length'" in unknown.json()["detail"]
    for wrong in ("{", "[]", '{"length": [1]}', '{"length": NaN}', json.dumps({"length": "x" * 2000})):
        refused = send(own, FILES, name="two", arguments=wrong)
        assert refused.status_code in {400, 422}, wrong
    bad = send(own, FILES, name="two", arguments='{"length": "x + y"}').json()
    assert bad["type"] == "urn:gelenk:invalid-urdf"
    assert (bad["file"], bad["line"]) == ("main/arm/inc/link.xacro", 6)


def test_a_xacro_of_several_is_chosen(own: TestClient) -> None:
    other = XACRO.replace("two", "three")
    several = send(own, {**FILES, "main/arm/urdf/other.urdf.xacro": other}, name="two")
    assert several.status_code == 422
    files = ["main/arm/urdf/arm.urdf.xacro", "main/arm/urdf/other.urdf.xacro"]
    assert several.json()["files"] == files
    chosen = send(own, {**FILES, "main/arm/urdf/other.urdf.xacro": other}, name="two", file=files[1])
    assert chosen.status_code == 201
    assert 'name="three"' in own.get("/v1/robots/two/urdf").text
    macros = send(own, FILES, name="macros", file="main/arm/inc/link.xacro").json()
    assert "defines only the macros 'arm_link'" in macros["detail"]


def test_a_xacro_alone_is_expanded_too(own: TestClient) -> None:
    text = f"""<robot name="one" {NAMESPACE}>
      <xacro:arg name="side" default="left"/>
      <link name="$(arg side)_base"/>
    </robot>"""
    answer = own.post("/v1/robots", json={"name": "one", "urdf": text, "arguments": {"side": "right"}})
    assert answer.status_code == 201, answer.text
    assert answer.json()["root"] == "right_base"
    missing = own.post("/v1/robots", json={"name": "x", "urdf": XACRO})
    assert missing.json()["detail"].startswith("line 3: element 'xacro:include': there is no file 'package://arm/inc")
    plain = own.post("/v1/robots", json={"name": "x", "urdf": '<robot name="r"/>', "arguments": {"side": 1}})
    assert "takes none" in plain.json()["detail"]


MJCF = """<mujoco model="swing">
  <compiler meshdir="assets"/>
  <asset><mesh file="part.stl"/></asset>
  <worldbody>
    <include file="parts/arm.xml"/>
  </worldbody>
  <actuator><motor joint="q"/></actuator>
</mujoco>"""
PART = """<mujocoinclude>
  <body name="arm" pos="0 0 1"><joint name="q" axis="0 1 0" range="-90 90"/><geom type="mesh" mesh="part"/>
    <site name="tip" pos="1 0 0"/>
  </body>
</mujocoinclude>"""
MODEL: dict[str, str | bytes] = {
    "m/swing.xml": MJCF,
    "m/parts/arm.xml": PART,
    "m/assets/part.stl": FILES["main/arm/meshes/a.stl"],
}


def test_an_mjcf_in_a_zip_is_the_same_robot(own: TestClient) -> None:
    answer = send(own, {**MODEL, "m/package.xml": "<package/>"}, name="swing")
    assert answer.status_code == 201, answer.text
    robot = answer.json()
    assert robot["default_chain"] == {"base_frame": "world", "tip_frame": "tip"}
    assert robot["meshes"] == [{"reference": "assets/part.stl", "path": "m/assets/part.stl"}]
    assert "line 7: actuator is not read" in robot["warnings"]
    down = own.post("/v1/robots/swing/fk", json={"joint_positions": [[1.5707963267948966]]}).json()["poses"][0]
    assert down["position"] == pytest.approx([0, 0, 0], abs=1e-15)
    refused = send(own, {**MODEL, "m/parts/arm.xml": PART.replace("0 1 0", "0 0 0")}, name="other").json()
    assert (refused["type"], refused["file"], refused["line"]) == ("urn:gelenk:invalid-urdf", "m/parts/arm.xml", 2)


def test_an_mjcf_alone_is_read_too(own: TestClient) -> None:
    text = MJCF.replace('<include file="parts/arm.xml"/>', '<body name="a"><joint name="q"/></body>')
    answer = own.post("/v1/robots", json={"name": "alone", "urdf": text})
    assert answer.status_code == 201, answer.text
    assert answer.json()["joint_names"] == ["q"]
    refused = own.post("/v1/robots", json={"name": "x", "urdf": text.replace("<joint", '<joint type="screw"')}).json()
    assert refused["detail"].startswith("line 5: joint 'q': the joint's type is 'screw'")


def test_a_mesh_of_the_zip_gives_a_body_its_mass(own: TestClient) -> None:
    box = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
    faces = "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
    model = """<mujoco><asset><mesh file="box.obj"/></asset><worldbody><body name="a"><joint name="q"/>
      <geom type="mesh" mesh="box" density="7"/></body></worldbody></mujoco>"""
    assert send(own, {"arm.xml": model, "box.obj": box + faces}, name="heavy").json()["warnings"] == []
    assert 'mass value="7' in own.get("/v1/robots/heavy/urdf").text
    lost = send(own, {"arm.xml": model}, name="light").json()["warnings"]
    assert any("line 2: its mass is not counted: there is no file 'box.obj'" in warning for warning in lost)
