"""Files of numbers, of robots and for answers: what is read, what is refused in a sentence, what can be read again."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest

from gelenk.cli.files.rows import rows_of
from gelenk.errors import InvalidArray
from tests.cli.conftest import Shell

TABLE = b"type,a,alpha,d,theta\nrevolute,1.0,0,0,0\nrevolute,0.7,0,0,0\n"
EXPECTED = [[0.1, 0.2], [0.3, 0.4]]


def npy(array: object) -> bytes:
    stream = BytesIO()
    np.save(stream, np.array(array))
    return stream.getvalue()


def packed() -> bytes:
    stream = BytesIO()
    np.savez(stream, q=np.zeros((1, 2)))
    return stream.getvalue()


READ = {
    "commas": b"0.1,0.2\n0.3,0.4\n",
    "semicolons": b"0.1; 0.2\n0.3; 0.4\n",
    "blanks": b"0.1 0.2\n\n0.3\t0.4\n",
    "words above": b"first,second\n0.1,0.2\n0.3,0.4\n",
    "joints above": b"joint_1,joint_2\n0.1,0.2\n0.3,0.4\n",
    "joints in another order": b"joint_2,joint_1\n0.2,0.1\n0.4,0.3\n",
    "more than joints": b"t,joint_1,status,joint_2\n0,0.1,solved,0.2\n1,0.3,solved,0.4\n",
    "as spreadsheets write it": b"\xef\xbb\xbfjoint_1,joint_2\r\n0.1,0.2,\r\n0.3,0.4,\r\n",
    "a comment": b"# joint_1 joint_2\n0.1 0.2\n0.3 0.4\n",
    "npy": npy(EXPECTED),
    "single precision": npy(np.array(EXPECTED, dtype=np.float32).astype(">f4")),
    "json": json.dumps(EXPECTED).encode(),
    "json by name": b'[{"joint_1": 0.1, "joint_2": 0.2}, {"joint_2": 0.4, "joint_1": 0.3}]',
    "a request": json.dumps({"joint_positions": EXPECTED}).encode(),
}


@pytest.mark.parametrize("name", READ)
def test_configurations_are_read(shell: Shell, name: str) -> None:
    """Two turns in a plane: the angle of the tip is their sum, and its place follows from the two."""
    out = shell.run("--format", "json", "fk", "planar_2r", "--pose", "rpy", "--from", "-", stdin=READ[name])[0]
    answer = json.loads(out)
    for pose, (first, second) in zip(answer["poses"], EXPECTED, strict=True):
        x, y = np.cos(first) + 0.7 * np.cos(first + second), np.sin(first) + 0.7 * np.sin(first + second)
        assert pose["position"] == pytest.approx([x, y, 0.0], abs=1e-6)
        assert pose["rpy"][2] == pytest.approx(first + second, abs=1e-6)


REFUSED = {
    "empty": (b"", "there are no rows in it"),
    "a header alone": (b"joint_1,joint_2\n", "there are no rows in it"),
    "no rows of npy": (npy(np.zeros((0, 2))), "there are no rows in it"),
    "ragged": (b"0.1,0.2\n0.3\n", "all rows must have as many numbers; these have [1, 2]"),
    "ragged below a header": (b"a,b\n0.1,0.2\n0.3\n", "line 3: '0.3' has 1 cell where the header has 2"),
    "a hole": (b"0.1,,0.2\n", "line 1: '0.1,,0.2' holds something that is not a finite number"),
    "nan": (b"0.1,0.2\n0.1,nan\n", "line 2: '0.1,nan' holds something that is not a finite number"),
    "some of the joints": (b"joint_1,elbow\n0.1,0.2\n", "names joints of the chain, but not joint_2"),
    "bytes": (b"\xff\xfe\x00", "must be text in UTF-8"),
    "npz": (packed(), "must be text in UTF-8"),
    "half an npy": (npy(EXPECTED)[:100], "cannot be read as npy"),
    "a promise of terabytes": (
        npy(EXPECTED).replace(b"(2, 2), }".ljust(20), b"(999999999999, 2), }"),
        "cannot be read as npy",
    ),
    "words in npy": (npy([["a", "b"]]), "it holds <U1 of shape (1, 2)"),
    "objects in npy": (npy(np.array([{}], dtype=object)), "cannot be read as npy"),
    "complex numbers": (npy([[1j, 2.0]]), "it holds complex128"),
    "too many axes": (npy(np.zeros((2, 2, 2))), "of shape (2, 2, 2)"),
    "nan in npy": (npy([[0.0, 0.0], [0.0, np.nan]]), "row 1: numbers must be finite"),
    "half a json": (b"[[0.1,", "cannot be read as JSON"),
    "nan in json": (b"[[0.1, NaN]]", "NaN is not finite"),
    "another object": (b'{"q": []}', "there is no list 'joint_positions'"),
    "ragged json": (b"[[0.1, 0.2], [0.3]]", "configuration 1 has 1 number where the chain has 2 joints"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_batch_is_refused_in_a_sentence(shell: Shell, name: str) -> None:
    content, sentence = REFUSED[name]
    out, err = shell("fk", "planar_2r", "--from", "-", stdin=content, code=2)
    assert out == ""
    assert err.startswith("gelenk: ")
    assert sentence in err
    assert err.count("\n") == 1


def test_what_one_command_writes_another_reads(shell: Shell, tmp_path: Path) -> None:
    """By the names of columns: verdicts and a motion as configurations, poses in another notation as targets."""
    solved, motion, poses = tmp_path / "solved.csv", tmp_path / "motion.csv", tmp_path / "poses.csv"
    there = ["0.4 0.2 0.5 pi 0 0", "0.4 0.25 0.5 3 0.1 0.2"]
    shell("-o", solved, "ik", "ur5", *(word for pose in there for word in ("--to", pose)))
    for notation in ("rpy", "zyz", "quaternion_wxyz", "rotation_vector", "ur", "kuka_abc", "abb", "fanuc_wpr"):
        shell("-o", poses, "fk", "ur5", "--from", solved, "--pose", notation)
        again = shell.json("ik", "ur5", "--from", poses)
        assert [result["status"] for result in again["results"]] == ["solved", "solved"]
        qs = [result["solutions"][0]["joint_positions"] for result in again["results"]]
        np.save(tmp_path / "q.npy", qs)
        found = shell.json("fk", "ur5", "--from", tmp_path / "q.npy")
        expected = shell.json("fk", "ur5", "--from", solved)
        for one, other in zip(found["poses"], expected["poses"], strict=True):
            assert one["position"] == pytest.approx(other["position"], abs=2e-6)
            assert abs(np.dot(one["quaternion_xyzw"], other["quaternion_xyzw"])) == pytest.approx(1.0, abs=1e-10)
    shell("-o", motion, "trajectory", "planar_2r", "--start", "0 0", "--joint", "0.5 0.2")
    columns = np.loadtxt(motion, delimiter=",", skiprows=1)
    told = shell.json("fk", "planar_2r", "--from", motion, "--pose", "rpy")
    assert [pose["rpy"][2] for pose in told["poses"]] == pytest.approx(columns[:, 1] + columns[:, 2], abs=1e-12)
    (tmp_path / "told.json").write_text(json.dumps(told))
    asked = ["ik", "planar_2r", "--from", tmp_path / "told.json", "--task", "x,y"]
    assert len(shell.json(*asked)["results"]) == len(columns)


def test_arrays_as_npy(shell: Shell, tmp_path: Path) -> None:
    """Of the shapes that the API's have; of a target that cannot be reached what comes nearest."""
    q, found = tmp_path / "q.npy", tmp_path / "found.npy"
    np.save(q, EXPECTED)
    shell("-o", found, "jacobian", "planar_2r", "--from", q)
    assert np.array_equal(np.load(found), shell.json("jacobian", "planar_2r", "--from", q)["jacobians"])
    asked = ["ik", "planar_2r", "--task", "x,y", "--to", "1 0.9 0", "--to", "9 0 0"]
    shell("-o", found, *asked, code=1)
    first, second = shell.json(*asked, code=1)["results"]
    expected = [first["solutions"][0]["joint_positions"], second["nearest"]["joint_positions"]]
    assert np.array_equal(np.load(found), expected)


def test_a_table_as_csv_is_the_table_again(shell: Shell, tmp_path: Path) -> None:
    """With its convention, its ends and its limits."""
    for convention in ("standard", "modified"):
        chosen = ("dh", "from-urdf", "ur5", "--convention", convention)
        (tmp_path / "arm.csv").write_bytes(shell.bytes("--format", "csv", *chosen))
        table = shell.json(*chosen)["dh"]
        other = {"standard": "modified", "modified": "standard"}[convention]
        converted = ("dh", "convert", tmp_path / "arm.csv", "--convention", other)
        (tmp_path / "arm.json").write_text(json.dumps(table))
        assert shell.json(*converted) == shell.json(*converted[:2], tmp_path / "arm.json", *converted[3:])
        assert "tool" in table or "base" in table


WRONG_TABLES = {
    "too many cells": (TABLE + b"revolute,1,0,0,0,7\n", "joint 3 of the table: 6 cells for 5 columns"),
    "no number": (TABLE + b"revolute,1,pi/x,0,0\n", "joint 3 of the table: alpha: 'pi/x' is not a number"),
    "bytes": (b"\xff\xfe", "must be text in UTF-8"),
    "no rows": (b"type,a,alpha,d,theta\n", "at least 1 item"),
    "another convention": (b"# convention: Craig\n" + TABLE, "#/dh/convention"),
    "half a pose": (b"# tool: {\n" + TABLE, "cannot be read"),
}


@pytest.mark.parametrize("name", WRONG_TABLES)
def test_what_is_no_table_is_refused_in_a_sentence(shell: Shell, tmp_path: Path, name: str) -> None:
    content, sentence = WRONG_TABLES[name]
    (tmp_path / "arm.csv").write_bytes(content)
    assert sentence in shell("fk", tmp_path / "arm.csv", "-q", "0 0", code=2)[1]


@pytest.mark.parametrize("write", [bytes, lambda t: b"\xef\xbb\xbf" + t, lambda t: t.replace(b",", b";")])
def test_tables_as_spreadsheets_write_them(shell: Shell, tmp_path: Path, write: Callable[[bytes], bytes]) -> None:
    (tmp_path / "ARM.CSV").write_bytes(write(TABLE))
    answer = shell.json("fk", tmp_path / "ARM.CSV", "-q", "0.1 0.2")
    assert answer["poses"] == shell.json("fk", "planar_2r", "-q", "0.1 0.2")["poses"]


@pytest.mark.parametrize(
    ("robot", "sentence"),
    [
        ("missing.urdf", "missing.urdf: No such file or directory"),
        ("notes.txt", "'notes.txt' must end in one of .urdf, "),
        (".", "'.' is not a robot's name"),
        ("", "'' is not a robot's name"),
        ("arms/panda", "'arms/panda' is not a robot's name"),
        ("planar_9r", "there is no robot named 'planar_9r'"),
    ],
)
def test_no_robot(shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, robot: str, sentence: str) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "notes.txt").write_text("<robot/>")
    (tmp_path / "planar_9r").mkdir()  # a folder that happens to have the name
    assert sentence in shell("fk", robot, "-q", "0 0", code=2)[1]


@pytest.mark.parametrize(
    "arguments",
    [
        ["--output", "away/x.json", "fk", "planar_2r", "-q", "0 0"],
        ["--output", ".", "fk", "planar_2r", "-q", "0 0"],
        ["workspace", "planar_2r", "--plot", "away/x.svg"],
    ],
    ids=" ".join,
)
def test_a_file_that_cannot_be_is_refused_before_the_work(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("gelenk.cli.local.InProcess", lambda: pytest.fail("it was asked"))
    err = shell(*arguments, code=2)[1]
    assert "No such file or directory" in err or "Is a directory" in err


def test_names_of_files_say_the_format_in_capitals_too(shell: Shell, tmp_path: Path) -> None:
    shell("-o", tmp_path / "POSES.NPY", "fk", "planar_2r", "-q", "0 0")
    assert np.load(tmp_path / "POSES.NPY").shape == (1, 7)
    shell("manipulability", "planar_2r", "-q", "0.3 0.8", "--plot", tmp_path / "E.SVG")
    assert b"<svg" in (tmp_path / "E.SVG").read_bytes()


def test_npy_is_nothing_for_a_terminal(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    assert "write it to a file with --output" in shell("-f", "npy", "fk", "planar_2r", "-q", "0 0", code=2)[1]


@pytest.mark.slow
@pytest.mark.parametrize("form", ["table", "json"])
def test_who_has_read_enough_is_no_error(url: str, form: str) -> None:
    """`gelenk … | head -1`: no code that means something else, and not a word."""
    command = [sys.executable, "-m", "gelenk.cli.main", "--server", url, "--format", form, "robots"]
    reading, writing = os.pipe()
    with subprocess.Popen(command, stdout=writing, stderr=subprocess.PIPE) as run:
        os.close(writing)
        os.close(reading)
        assert run.stderr is not None
        assert run.stderr.read() == b""
    assert run.returncode == 0


def test_a_full_disk_is_no_fault_of_the_question(shell: Shell) -> None:
    assert shell("-o", "/dev/full", "robots", code=4)[1] == "gelenk: No space left on device\n"


def test_motions_are_given_in_one_way(shell: Shell) -> None:
    motion = ["trajectory", "planar_2r", "--start", "0 0"]
    assert "none are given: --joint" in shell(*motion, code=2)[1]
    assert "give no --joint" in shell(*motion, "--joint", "0.1 0.1", "--motion", "{}", code=2)[1]
    assert "give no --joint" in shell(*motion, "--path", "-", "--motion", "{}", code=2)[1]
    assert "is for the tool that --path leads" in shell(*motion, "--joint", "0 1", "--free", "rz", code=2)[1]
    assert "name it" in shell("robots", "--urdf", code=2)[1]


def test_rows_of_arguments_are_plain() -> None:
    assert rows_of(["0.1, pi/2", "-3*pi/4 1e-3"], None, "joint_positions").configurations(list) == [
        [0.1, np.pi / 2],
        [-3 * np.pi / 4, 1e-3],
    ]


def test_angles_may_be_in_degrees() -> None:
    given = rows_of(["30deg, -90°, 0.5rad", "90 1e2deg pi/2"], None, "joint_positions")
    expected = [[np.pi / 6, -np.pi / 2, 0.5], [90.0, np.deg2rad(100.0), np.pi / 2]]
    assert np.allclose(given.configurations(list), expected, rtol=1e-15, atol=0.0)


@pytest.mark.parametrize("text", ["deg", "30degdeg", "30deg5", "30 grad", "infdeg"])
def test_other_units_are_refused(text: str) -> None:
    with pytest.raises(InvalidArray, match="not a finite number"):
        rows_of([text], None, "joint_positions").configurations(list)


def test_way_points_come_from_a_file(shell: Shell, tmp_path: Path) -> None:
    """The first row is the start; a header sets the order."""
    (tmp_path / "points.csv").write_text("joint_2,joint_1\n0.1,0.2\n20deg,0.5\n0.4,0.3\n")
    words = "trajectory", "planar_2r", "--waypoints", tmp_path / "points.csv", "--period", 0.1
    answer = shell.json(*words)
    assert answer["joint_positions"][0] == [0.2, 0.1]
    assert answer["joint_positions"][-1] == pytest.approx([0.3, 0.4], abs=1e-12)
    apart = np.abs(np.array(answer["joint_positions"]) - [0.5, np.deg2rad(20.0)]).max(axis=1)
    assert apart.min() < 0.05  # samples come that near to the point between
    assert shell.json(*words, "--start", "0 0")["joint_positions"][0] == [0.0, 0.0]
    (tmp_path / "points.csv").write_text("0.1,0.2\n")
    assert "give at least one more row" in shell(*words, code=2)[1]
    assert "give no --joint" in shell(*words, "--joint", "0 0", code=2)[1]
