"""Tables as text for other programs: each text read by a small reader of its language gives the poses of the table."""

import csv
import json
import re
import shutil
import subprocess
import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gelenk.cli.files.inputs import table_from
from gelenk.contract.dh import DhTablePayload
from gelenk.dh.written import written_table
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.description import Mimic
from gelenk.robot.dh import Convention, DhJoint, DhTable
from tests.oracles.dh_columns import Table

BASE = np.array([[0, -1, 0, 0.1], [1, 0, 0, 0.2], [0, 0, 1, 0.3], [0, 0, 0, 1.0]])
TOOL = np.array([[1, 0, 0, 0], [0, 0, -1, 0.05], [0, 1, 0, 0.01], [0, 0, 0, 1.0]])
ROWS = (
    DhJoint("hip", "revolute", 0.1, -np.pi / 2, 0.4, 1 / 3, -2.0, 2.0, 1.5, 40.0),
    DhJoint("slide", "prismatic", -0.2, 0.7, 0.05, -0.3, 0.0, 0.3),
    DhJoint("wrist, left", "revolute", 0.0, 0.1, 0.2, 0.0),
)
CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")
QS = np.array([[0.3, 0.1, -1.2], [-1.0, 0.25, 2.0]])


def table(convention: Convention, *more: DhJoint) -> DhTable:
    """A table with base and tool, of three joints, the second of which slides."""
    return DhTable(convention, (*ROWS, *more), BASE, TOOL)


COUPLED = DhJoint("coupled", "revolute", 0.3, 0.0, 0.0, 0.0, mimic=Mimic("hip", -0.5, 0.25))


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("more", [(), (COUPLED,)], ids=["plain", "coupled"])
def test_csv_is_the_table_that_the_command_line_reads(
    convention: Convention, more: tuple[DhJoint, ...], tmp_path: Path
) -> None:
    described = table(convention, *more)
    file = tmp_path / "arm.csv"
    file.write_text(written_table(described, "csv", "arm", ["arm, base to tool"]))
    read = DhTablePayload.model_validate_json(json.dumps(table_from(file))).table()
    assert (read.convention, read.joints) == (convention, described.joints)
    assert all(np.abs(read.pose(q) - described.pose(q)).max() < 1e-15 for q in QS.tolist())


def test_csv_is_plain_rows_below_comments() -> None:
    text = written_table(DhTable("modified", ROWS), "csv", "arm", ["arm, base to tool"])
    assert text.splitlines()[:2] == ["# convention: modified", "# arm, base to tool"]
    rows = list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
    assert [row["name"] for row in rows] == ["hip", "slide", "wrist, left"]
    assert (rows[0]["velocity"], rows[2]["lower"]) == ("1.5", "")


def of_matlab(text: str) -> Callable[[Array], Array]:
    """The poses that a written function gives: its matrices read, and its loop of known lines in their order."""

    def read(name: str) -> Array:
        found = re.search(rf"^{name} = \[(.*?)\]", text, re.MULTILINE | re.DOTALL)
        assert found is not None
        body = re.sub(r"\.\.\..*\n", "\n", found[1])
        return np.array([[float(x) for x in row.split(",")] for row in body.split(";") if row.strip()])

    rows, coupling = read("table"), re.search(r"positions = \[(.*?)\] \* q\(:\) \+ \[(.*?)\];", text)
    assert coupling is not None
    C, offsets = ([[float(x) for x in row.split(",")] for row in part.split(";")] for part in coupling.groups())
    order = re.search(r"T = T \* (\w+) \* (\w+);", text)
    assert order is not None
    assert set(order.groups()) == {"about_x", "about_z"}
    textbook = Table(
        order[1] == "about_z", [tuple(row) for row in rows[:, :4].tolist()], [s == 1.0 for s in rows[:, 4]]
    )
    base, tool = read("T_base_0"), read("T_n_tool")
    return lambda q: np.asarray(base @ textbook.pose(np.array(C) @ q + np.array(offsets)[:, 0]) @ tool)


@pytest.mark.parametrize("convention", CONVENTIONS)
@pytest.mark.parametrize("more", [(), (COUPLED,)], ids=["plain", "coupled"])
def test_the_function_for_matlab_gives_the_poses(convention: Convention, more: tuple[DhJoint, ...]) -> None:
    described = table(convention, *more)
    poses = of_matlab(written_table(described, "matlab", "7 arm-s", ["a remark"]))
    assert all(np.abs(poses(q) - described.pose(q.tolist())).max() < 1e-15 for q in QS)


@pytest.mark.skipif(shutil.which("octave-cli") is None, reason="octave-cli is not installed")
@pytest.mark.slow
@pytest.mark.parametrize("convention", CONVENTIONS)
def test_octave_runs_the_function(convention: Convention, tmp_path: Path) -> None:
    described = table(convention, COUPLED)
    (tmp_path / "arm.m").write_text(written_table(described, "matlab", "arm", ["a remark"]))
    for q in QS:
        call = f"printf('%.17g ', arm([{' '.join(map(repr, q.tolist()))}])')"
        run = ["octave-cli", "--no-init-file", "--no-window-system", "--eval", call]
        done = subprocess.run(run, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=120)
        found = np.array(done.stdout.split(), dtype=float).reshape(4, 4)
        assert np.abs(found - described.pose(q.tolist())).max() < 1e-14


def toolbox() -> tuple[dict[str, types.ModuleType], dict[str, Any]]:
    """Modules with the classes that the text uses, as the toolbox documents them, and the robot made of them."""
    made: dict[str, Any] = {}
    module, maths = types.ModuleType("roboticstoolbox"), types.ModuleType("spatialmath")

    def link(kind: str, standard: bool) -> Callable[..., Any]:
        def row(*, a: float, alpha: float, offset: float, qlim: list[float], d: float = 0.0, theta: float = 0.0) -> Any:
            slides = kind == "Prismatic"
            return standard, slides, (a, alpha, offset if slides else d, theta if slides else offset), qlim

        return row

    for kind in ("Revolute", "Prismatic"):
        for suffix in ("DH", "MDH"):
            setattr(module, kind + suffix, link(kind, suffix == "DH"))

    def robot(links: list[Any], *, name: str, base: Array, tool: Array) -> None:
        made.update(links=links, name=name, base=base, tool=tool)

    module.DHRobot, maths.SE3 = robot, lambda T, **_: T  # type: ignore[attr-defined]
    return {"roboticstoolbox": module, "spatialmath": maths}, made


@pytest.mark.parametrize("convention", CONVENTIONS)
def test_the_robot_for_the_toolbox_gives_the_poses(convention: Convention, monkeypatch: pytest.MonkeyPatch) -> None:
    described = table(convention)
    modules, made = toolbox()
    for name, module in modules.items():
        monkeypatch.setitem(sys.modules, name, module)
    exec(written_table(described, "roboticstoolbox", "arm", ['a "remark" \\']), {})  # noqa: S102
    standard, slides, rows, limits = zip(*made["links"], strict=True)
    assert set(standard) == {convention == "standard"}
    assert limits[:2] == ([-2.0, 2.0], [0.0, 0.3])
    textbook = Table(convention == "standard", list(rows), list(slides))
    for q in QS:
        assert np.abs(made["base"] @ textbook.pose(q) @ made["tool"] - described.pose(q.tolist())).max() < 1e-15


def test_the_toolbox_has_no_followers() -> None:
    with pytest.raises(InvalidField, match="follows another one, as 'coupled' does"):
        written_table(table("standard", COUPLED), "roboticstoolbox", "arm", [])


def test_latex_has_the_rows_with_their_variables_base_and_tool() -> None:
    text = written_table(table("standard"), "latex", "arm", ["from base to tool"])
    assert text.splitlines()[1] == "% from base to tool"
    assert text.count(r"\[") == text.count(r"\]") == 3
    for part in (r"-\frac{\pi}{2}", "q_{2}", "q_{1} + 0.333333333", r"T^{b}_{0}", r"T^{n}_{t}"):
        assert part in text
    plain = DhTable("standard", ROWS)
    assert written_table(plain, "latex", "arm", []).count(r"\[") == 1
