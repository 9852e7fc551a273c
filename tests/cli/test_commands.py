"""Each command answers what the API does, without a server and with one; files, formats and ends."""

import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.cli.conftest import Shell
from tests.corpus.urdf import ARM
from tests.corpus.zips import zipped
from tests.oracles import catalogue, dh_columns
from tests.test_serve import free_port, get

Q = [0.3, 0.8]
TABLE = """# convention: standard
name,type,a,alpha,d,theta
shoulder,revolute,1.0,0,0,0
elbow,revolute,0.7,pi/2,0,-pi/2
"""


MOTION = ["--start", "0.3 0.8", "--joint", "0.5,0.2", "--period", "0.05"]
CALLS: dict[str, tuple[list[str], str, str, Any]] = {
    "jacobian": (
        ["jacobian", "planar_2r", "-q", "0.3,0.8", "--reference", "local"],
        "POST",
        "robots/planar_2r/jacobian",
        {"joint_positions": [Q], "reference": "local"},
    ),
    "ik": (
        ["ik", "planar_2r", "--to", "1.2 0.9 0", "--task", "x,y", "--all"],
        "POST",
        "robots/planar_2r/ik",
        {
            "targets": [{"position": [1.2, 0.9, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]}],
            "task": ["x", "y"],
            "solutions": "all",
        },
    ),
    "trajectory": (
        ["trajectory", "planar_2r", *MOTION],
        "POST",
        "robots/planar_2r/trajectory",
        {"start": Q, "segments": [{"type": "joint", "target": [0.5, 0.2]}], "sample_period": 0.05},
    ),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", CALLS)
def test_core_server_and_api_say_the_same(shell: Shell, url: str, name: str) -> None:
    arguments, method, path, body = CALLS[name]
    expected = get(f"{url}/v1/{path}", method, body)[1]
    here, there = shell.json(*arguments), shell.json("--server", url, *arguments)
    assert here == there == expected


def test_tables_as_files(shell: Shell, url: str, tmp_path: Path) -> None:
    table = tmp_path / "arm.csv"
    table.write_text(TABLE)
    answer = shell.json("fk", table, "-q", "0.3 pi/3")
    joints = [
        {"name": "shoulder", "type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0},
        {"name": "elbow", "type": "revolute", "a": 0.7, "alpha": np.pi / 2, "d": 0.0, "theta": -np.pi / 2},
    ]
    judge = dh_columns.from_json({"convention": "standard", "joints": joints})
    np.testing.assert_allclose(answer["poses"][0]["position"], judge.pose([0.3, np.pi / 3])[:3, 3], atol=1e-12)
    assert get(f"{url}/v1/robots")[1] == shell.json("--server", url, "robots"), "nothing is left behind"
    shell("--server", url, "fk", table, "-q", "0.3 0.8")
    assert {one["source"] for one in get(f"{url}/v1/robots")[1]["robots"]} == {"catalogue"}
    toml = tmp_path / "arm.toml"
    toml.write_text(
        'convention = "standard"\n'
        + "".join(
            "[[joints]]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in joint.items())
            for joint in joints
        )
    )
    assert shell.json("fk", toml, "-q", f"0.3 {np.pi / 3}") == answer | {"joint_names": ["shoulder", "elbow"]}


def test_a_table_to_urdf_and_back(shell: Shell, tmp_path: Path) -> None:
    table, urdf = tmp_path / "arm.json", tmp_path / "arm.urdf"
    table.write_text(json.dumps(catalogue.dh_table("anthropomorphic")))
    shell("--output", urdf, "dh", "to-urdf", table, "--name", "arm")
    assert '<robot name="arm"' in urdf.read_text()
    back = shell.json("dh", "from-urdf", urdf)
    assert back["certificate"]["max_position_error"] < 1e-9
    assert shell.json("dh", "compare", table, urdf)["equivalent"]
    assert "c1" in shell("dh", "derive", table)[0]
    assert r"\begin{bmatrix}" in shell("dh", "derive", table, "--latex")[0]
    assert shell.json("dh", "compare", table, "planar_3r", code=1)["equivalent"] is False


XACRO = """<robot name="two" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="length" default="1.0"/>
  <xacro:include filename="$(find my_arm)/link.xacro"/>
  <link name="base"/>
  <xacro:arm_link length="$(arg length)"/>
</robot>"""
LINK = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="arm_link" params="length">
  <link name="tool"/>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="tool"/><origin xyz="${2 * length} 0 0"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" velocity="1" effort="1"/>
  </joint>
</xacro:macro></robot>"""


def test_xacro_is_expanded_here(shell: Shell, url: str, tmp_path: Path) -> None:
    package = tmp_path / "my_arm"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>my_arm</name></package>")
    (package / "link.xacro").write_text(LINK)
    arm = package / "urdf" / "arm.urdf.xacro"
    arm.write_text(XACRO)
    assert shell.json("fk", arm, "-q", "0.5")["poses"][0]["position"] == [2.0, 0.0, 0.5]
    answer = shell.json("--server", url, "--arg", "length=1.5", "fk", arm, "-q", "0.5")
    assert answer["poses"][0]["position"] == [3.0, 0.0, 0.5]
    away = tmp_path / "elsewhere.xacro"
    away.write_text(XACRO.replace("my_arm", "other_arm"))
    assert "--package other_arm=FOLDER" in shell("fk", away, "-q", "0.5", code=2)[1]
    found = shell.json("--package", f"other_arm={package}", "fk", away, "-q", "0.5")
    assert found["poses"][0]["position"] == [2.0, 0.0, 0.5]


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        ("<xacro:include filename='away.xacro'/>", "there is no file 'away.xacro'"),
        (
            "<xacro:include filename='$(find nowhere)/a.xacro'/>",
            "package 'nowhere' is not found: name its folder with ",
        ),
        ("<xacro:include filename='arm.xacro'/>", "macros, conditions and includes are nested deeper than 100"),
        ("<link name='$(arg length)'/>", "the argument 'length' has no value: give one, or a default in <xacro:arg>"),
        ("<link name='${1/0}'/>", "division by zero in the expression '1/0'"),
        ("<xacro:elbow/>", "there is no macro 'elbow'"),
        ("<link", "not well-formed (invalid token)"),
    ],
)
def test_what_is_wrong_with_xacro_is_said_once_and_on_a_line(
    shell: Shell, tmp_path: Path, content: str, sentence: str
) -> None:
    arm = tmp_path / "arm.xacro"
    arm.write_text(f'<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">{content}</robot>')
    err = shell("fk", arm, "-q", "0", code=2)[1]
    assert err.startswith("gelenk: file 'arm.xacro': line 1: ")
    assert err.count(sentence) == err.count("\n") == 1


def test_what_is_not_read_of_an_mjcf_is_told_on_standard_error(shell: Shell, tmp_path: Path) -> None:
    arm = tmp_path / "arm.xml"
    body = '<body name="a"><joint name="q"/><geom size="1"/></body>'
    arm.write_text(f"<mujoco><worldbody>{body}</worldbody>\n<actuator><motor joint='q'/></actuator></mujoco>")
    for command in (("fk", arm, "-q", "0.5"), ("robots", arm), ("add", arm, "--name", "told")):
        assert shell(*command)[1] == "gelenk: file 'arm.xml': line 2: actuator is not read\n"
    assert shell("--quiet", "fk", arm, "-q", "0.5")[1] == ""
    shell.remove_added()


@pytest.mark.parametrize("prefix", ["", "xacro:"])
def test_a_xacro_of_macros_alone_says_so(shell: Shell, tmp_path: Path, prefix: str) -> None:
    macros = "".join(
        f'<xacro:macro name="{prefix}{name}"><link name="base"/></xacro:macro>' for name in ("arm", "hand")
    )
    file = tmp_path / "macros.xacro"
    file.write_text(f'<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">{macros}</robot>')
    err = shell("fk", file, "-q", "0", code=2)[1]
    assert f"defines only the macros '{prefix}arm', '{prefix}hand'; expand one that calls them" in err
    around = tmp_path / "around.xacro"
    around.write_text(file.read_text().replace(macros, '<xacro:include filename="macros.xacro"/>'))
    assert "file 'around.xacro': line 1: the robot has no link" in shell("fk", around, "-q", "0", code=2)[1]


def test_a_faulty_file_is_taken_unless_strict(shell: Shell, tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text('\n<?xml version="1.0"?>' + ARM)
    archive = tmp_path / "arm.zip"
    archive.write_bytes(zipped({"arm.urdf": file.read_text()}))
    for given in (file, archive):
        for command in (["fk", given, "-q", "0.5"], ["dh", "from-urdf", given], ["add", given]):
            shell(*command)
            assert "not well-formed XML" in shell("--strict", *command, code=2)[1]
    assert "before the XML declaration" in shell("add", file)[0]
    shell.remove_added()


def test_one_of_several_urdfs_of_a_zip_is_added(shell: Shell, tmp_path: Path) -> None:
    archive = tmp_path / "two.zip"
    archive.write_bytes(zipped({"left.urdf": ARM, "right.urdf": ARM}))
    assert "name one of them in `file`: 'left.urdf', 'right.urdf'" in shell("add", archive, code=2)[1]
    shell("add", archive, "--file", "right.urdf")
    shell("remove", "two")


def test_configurations_in_and_out(shell: Shell, tmp_path: Path) -> None:
    rows = np.array([[0.1, 0.2], [0.3, 0.4], [-0.5, 0.6]])
    np.save(tmp_path / "q.npy", rows)
    np.savetxt(tmp_path / "q.csv", rows, delimiter=",", header="joint_1,joint_2", comments="")
    (tmp_path / "q.json").write_text(json.dumps(rows.tolist()))
    expected = shell.json("fk", "planar_2r", "--from", tmp_path / "q.npy")
    assert len(expected["poses"]) == 3
    for name in ("q.csv", "q.json"):
        assert shell.json("fk", "planar_2r", "--from", tmp_path / name) == expected
    piped = shell("--format", "csv", "fk", "planar_2r", "--from", "-", stdin=(tmp_path / "q.csv").read_bytes())[0]
    header, *lines = piped.splitlines()
    assert header == "x,y,z,qx,qy,qz,qw"
    positions = np.array([[float(cell) for cell in line.split(",")[:3]] for line in lines])
    assert np.array_equal(positions, [pose["position"] for pose in expected["poses"]])
    shell("--output", tmp_path / "poses.npy", "fk", "planar_2r", "--from", tmp_path / "q.npy")
    assert np.array_equal(np.load(tmp_path / "poses.npy")[:, :3], positions)
    shell("--output", tmp_path / "poses.json", "fk", "planar_2r", "--from", tmp_path / "q.npy")
    assert json.loads((tmp_path / "poses.json").read_text()) == expected


def test_a_table_for_people_cuts_no_number(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    out = shell("ik", "panda", "--tip", "panda_link8", "--to", "0.4 0.1 0.5 3.0 0.2 0.4")[0]
    assert "…" not in out
    assert "panda_joint7" in out


def test_what_cannot_be_reached_ends_with_one(shell: Shell) -> None:
    out, _ = shell("ik", "planar_2r", "--to", "9 0 0", "--task", "x,y", code=1)
    assert "beyond reach" in out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["fk", "planar_9r", "-q", "1 2"], "there is no robot named 'planar_9r'"),
        (["fk", "planar_2r", "-q", "1 2 3"], "has 3 numbers where the chain has 2 joints"),
        (["fk", "planar_2r", "-q", "1 two"], "holds something that is not a finite number"),
        (["fk", "planar_2r"], "none are given"),
        (["fk", "planar_2r", "-q", "1 2", "-q", "1"], "all rows must have as many numbers"),
        (["fk", "planar_2r", "--from", "missing.csv"], "missing.csv: No such file"),
        (["fk", "planar_2r", "-q", "1 2", "--pose", "euler"], "must be one of quaternion_xyzw"),
        (["ik", "planar_2r", "--to", "1 2 3 4"], "a target has 4 numbers; allowed: 6"),
        (["dh", "derive", "missing.csv"], "there is no file 'missing.csv'"),
        (["ask", "levitate", "{}"], "must be one of"),
        (["ask", "gear", "{]"], "is not JSON"),
        (["ask", "velocity", "{}"], "is needed by this operation"),
        (["--format", "npy", "robots"], "these columns hold others: name"),
        (["trajectory", "planar_2r", *MOTION, "--plot", "motion.gif"], "must end in .svg, .png or .pdf"),
        (["trajectory", "planar_2r", *MOTION, "--program", "motion.src"], "must end in .yaml, .json or .script"),
        (["--arg", "length", "fk", "arm.xacro", "-q", "1"], "is not NAME=VALUE"),
        (["--package", "my_arm=", "fk", "arm.xacro", "-q", "1"], "'my_arm=' names no folder: it must be NAME=FOLDER"),
        (["--package", "my_arm=no/where", "fk", "arm.xacro", "-q", "1"], "'my_arm=no/where' names no folder"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_is_wrong_is_said_in_a_sentence(shell: Shell, arguments: list[str], sentence: str) -> None:
    out, err = shell(*arguments, code=2)
    assert sentence in err
    assert err.startswith("gelenk: ")
    assert "Traceback" not in err + out


def test_nobody_there(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.client.client.time.sleep", lambda _: None)
    url = f"http://127.0.0.1:{free_port()}"
    assert f"no answer from {url}" in shell("--server", url, "robots", code=3)[1]


@pytest.mark.slow
def test_a_workspace_with_its_picture(shell: Shell, tmp_path: Path) -> None:
    shell("-o", tmp_path / "points.npy", "workspace", "planar_2r", "--samples", 2000, "--plot", tmp_path / "reach.svg")
    points = np.load(tmp_path / "points.npy")
    assert points.shape == (2000, 4)
    assert np.hypot(points[:, 0], points[:, 1]).max() <= 1.7 + 1e-12
    assert b"<svg" in (tmp_path / "reach.svg").read_bytes()
    assert "samples" in shell("workspace", "planar_2r", "--samples", 2000)[0]


@pytest.mark.slow
def test_as_a_program() -> None:
    environment = {name: value for name, value in os.environ.items() if name != "GELENK_SERVER"}
    command = [sys.executable, "-m", "gelenk.cli.main", "--format", "csv", "fk", "planar_2r", "-q", "0 0"]
    run = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True, env=environment)
    assert run.stdout.splitlines()[1].startswith("1.7,0.0,0.0,")
    assert run.stderr == ""


def test_the_readme_prints_what_a_command_does(shell: Shell) -> None:
    readme = Path("README.md").read_text(encoding="utf-8")
    ((command, printed),) = re.findall(r"```console\n\$ ./dev gelenk (.*?)\n(.*?)```", readme, re.DOTALL)
    out = shell(*shlex.split(command))[0]
    assert [words(line) for line in out.splitlines()] == [words(line) for line in printed.splitlines()]


def words(line: str) -> list[str]:
    """What a line says, but for errors: these are rounding, and a machine's own."""
    return [word for word in line.split() if "e-1" not in word]


def test_a_joint_is_held_by_its_field(shell: Shell) -> None:
    held = json.dumps({"fixed_joints": {"panda_joint7": 0.6}, "solutions": "all"})
    to = ["--to", "0.4 0.1 0.5 3.1 0 0", "--tip", "panda_link8"]
    (result,) = shell.json("ik", "panda", *to, "--fields", held)["results"]
    assert {solution["joint_positions"][6] for solution in result["solutions"]} == {0.6}
    assert result["complete"]


def test_options_of_all_commands_stand_anywhere(shell: Shell, tmp_path: Path) -> None:
    words = "planar_2r", "-q", "0.3 0.8"
    first = shell("-f", "json", "fk", *words)[0]
    assert json.loads(first)["joint_names"] == ["joint_1", "joint_2"]
    lines = (("fk", *words, "-f", "json"), ("fk", "--format=json", *words), ("fk", "-fjson", *words))
    for line in lines:
        assert shell(*line)[0] == first
    shell("fk", *words, "-o", tmp_path / "pose.json")
    assert json.loads((tmp_path / "pose.json").read_text()) == json.loads(first)
    assert json.loads(shell("dh", "from-urdf", "planar_2r", "-f", "json")[0])["dh"]["convention"] == "standard"
    assert "requires an argument" in shell("fk", *words, "-o", code=2)[1]


def test_an_ending_that_nothing_writes_is_refused_before_the_work(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = "fk", "planar_2r", "-q", "0.3 0.8", "-o"
    with monkeypatch.context() as patch:
        patch.setattr("gelenk.cli.arms._answer_at", lambda *_: pytest.fail("it computes"))
        for name in ("pose.xlsx", "pose.pdf", "pose.urdf"):
            error = shell(*words, tmp_path / name, code=2)[1]
            assert f"'{name}' must end in one of .txt, .json, .csv, .npy; or name the format" in error
    shell(*words, tmp_path / "pose.dat", "--format", "csv")
    assert (tmp_path / "pose.dat").read_text().startswith("x,y,z,")
    shell(*words, tmp_path / "pose")
    assert (tmp_path / "pose").read_text().split()[0] == "x"


def test_quiet_leaves_the_answer(shell: Shell) -> None:
    words = "fk", "planar_2r", "-q", "0.3 0.8"
    told, quiet = shell(*words)[0].splitlines(), shell(*words, "--quiet")[0].splitlines()
    assert quiet == told[:2]
    assert told[2].startswith("T of tool in base")


def test_a_table_is_named_by_its_robot(shell: Shell) -> None:
    told = shell("dh", "derive", "planar_2r")[0]
    assert "a1*c1" in told
    table = shell.json("dh", "from-urdf", "planar_2r")["dh"]
    assert shell.json("dh", "convert", "planar_2r", "--convention", "standard")["dh"]["joints"] == table["joints"]
    assert "no_such_robot" in shell("dh", "derive", "no_such_robot", code=2)[1]
    assert "there is no file" in shell("dh", "derive", "missing.csv", code=2)[1]


def test_a_field_that_no_call_has_is_named(shell: Shell) -> None:
    error = shell("jacobian", "planar_2r", "-q", "0 0", "--fields", '{"referense": "local"}', code=2)[1]
    assert error == "gelenk: jacobian has no argument 'referense': did you mean 'reference'?\n"
