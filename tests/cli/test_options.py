"""Each option of each command says to the service what its field does: the answer is the API's, and another one."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlencode

import pytest
import typer
from typer.core import TyperGroup

from gelenk.cli.main import cli
from gelenk.client import Client
from tests.cli.conftest import Shell
from tests.oracles import catalogue
from tests.test_serve import get

START, THERE, ON = [0.0, -1.0, 1.0, 0.0, 1.0, 0.0], [0.2, -1.0, 1.0, 0.0, 1.0, 0.0], [0.4, -1.0, 1.0, 0.0, 1.0, 0.0]
TARGET = {"position": [0.4, 0.2, 0.5], "rpy": [3.0, 0.1, 0.2]}
GOAL = {"position": [0.5, 0.2, 0.4], "rpy": [3.0, 0.0, 0.0]}
FIRST, LAST = {"type": "joint", "target": THERE}, {"type": "joint", "target": ON}
TABLE = catalogue.dh_table("anthropomorphic")


def said(numbers: list[float]) -> str:
    return " ".join(map(str, numbers))


@dataclass(frozen=True)
class Asked:
    """A command and the call that it stands for."""

    words: list[str]
    path: str
    fields: dict[str, Any]


AT = ["ur5", "-q", said(START)]
FK = Asked(["fk", *AT], "robots/ur5/fk", {"joint_positions": [START]})
JACOBIAN = Asked(["jacobian", *AT], "robots/ur5/jacobian", FK.fields)
MEASURES = Asked(["manipulability", *AT], "robots/ur5/manipulability", FK.fields)
IK = Asked(["ik", "ur5", "--to", said([*TARGET["position"], *TARGET["rpy"]])], "robots/ur5/ik", {"targets": [TARGET]})
FAR = Asked(
    ["ik", "panda", "--to", "0.2 0 0.1 0 0 0"],
    "robots/panda/ik",
    {"targets": [{"position": [0.2, 0.0, 0.1], "rpy": [0.0, 0.0, 0.0]}]},
)
MOTION = Asked(
    ["trajectory", "ur5", "--start", said(START), "--joint", said(THERE), "--period", "0.1"],
    "robots/ur5/trajectory",
    {"start": START, "segments": [FIRST], "sample_period": 0.1},
)
SEAM = [{"position": [0.4, y, 0.2], "rpy": [3.1, 0.0, 0.2 + y]} for y in (0.1, 0.12, 0.15)]
AS_CSV = ["x,y,z,roll,pitch,yaw", *(",".join(map(str, [*one["position"], *one["rpy"]])) for one in SEAM)]
WELD = Asked(
    ["trajectory", "ur5", "--path", "seam.csv", "--period", "0.1"],
    "robots/ur5/trajectory",
    {"path": {"poses": SEAM, "free": []}, "sample_period": 0.1},
)
WORKSPACE = Asked(["workspace", "ur5", "--samples", "500"], "robots/ur5/workspace", {"samples": 500})
SCREWS = Asked(["robots", "ur5", "--as", "screws"], "robots/ur5/screws", {})
FROM_URDF = Asked(["dh", "from-urdf", "ur5"], "robots/ur5/dh", {})
TO_URDF = Asked(["dh", "to-urdf", "table.json"], "dh/to-urdf", {"name": "robot", "dh": TABLE})
CONVERT = Asked(
    ["dh", "convert", "table.json", "--convention", "standard"], "dh/convert", {"dh": TABLE, "convention": "standard"}
)
COMPARE = Asked(
    ["dh", "compare", "table.json", "anthropomorphic"], "dh/compare", {"dh": TABLE, "robot": "anthropomorphic"}
)
DERIVE = Asked(["dh", "derive", "table.json"], "dh/derive", {"dh": TABLE})
BASE, TIP = (["--base", "base"], {"base_frame": "base"}), (["--tip", "wrist_3_link"], {"tip_frame": "wrist_3_link"})
CASES: list[tuple[Asked, list[str], dict[str, Any]]] = [
    *(
        (asked, *end)
        for asked in (FK, JACOBIAN, MEASURES, IK, MOTION, WORKSPACE, FROM_URDF, SCREWS)
        for end in (BASE, TIP)
    ),
    (FK, ["--at", said(THERE)], {"joint_positions": [START, THERE]}),
    (FK, ["--pose", "zyz"], {"pose_format": "zyz"}),
    (JACOBIAN, ["--at", said(THERE)], {"joint_positions": [START, THERE]}),
    (JACOBIAN, ["--reference", "local"], {"reference": "local"}),
    (JACOBIAN, ["--representation", "rpy"], {"representation": "rpy"}),
    (MEASURES, ["--at", said(THERE)], {"joint_positions": [START, THERE]}),
    (IK, ["--to", "0.5 0.2 0.4 3 0 0"], {"targets": [TARGET, GOAL]}),
    (IK, ["--method", "damped_least_squares"], {"method": "damped_least_squares"}),
    (IK, ["--all"], {"solutions": "all"}),
    (IK, ["--seed", said(ON)], {"seeds": [ON]}),
    (IK, ["--task", "x,y,z"], {"task": ["x", "y", "z"]}),
    (FAR, ["--ignore-limits"], {"respect_limits": False}),
    (MOTION, ["--start", said(ON)], {"start": ON}),
    (MOTION, ["--joint", said(ON)], {"segments": [FIRST, LAST]}),
    (MOTION, ["--line", "0.5 0.2 0.4 3 0 0"], {"segments": [FIRST, {"type": "line", "target": GOAL}]}),
    (WELD, ["--free", "rz"], {"path": {"poses": SEAM, "free": ["rz"]}}),
    (WELD, ["--path", "back.csv"], {"path": {"poses": SEAM[::-1], "free": []}}),
    (MOTION, ["--law", "cubic"], {"law": "cubic"}),
    (MOTION, ["--period", "0.05"], {"sample_period": 0.05}),
    *((asked, ["--scene", "cell"], {"scene": "cell"}) for asked in (IK, MOTION)),
    *((asked, ["--min-clearance", "0.02"], {"min_clearance": 0.02}) for asked in (IK, MOTION)),
    (WORKSPACE, ["--samples", "700"], {"samples": 700}),
    (WORKSPACE, ["--kind", "grid"], {"kind": "grid"}),
    (FROM_URDF, ["--convention", "modified"], {"convention": "modified"}),
    (FROM_URDF, ["--snap", "0.01"], {"snap_tolerance": 0.01}),
    (TO_URDF, ["--name", "my_arm"], {"name": "my_arm"}),
    (CONVERT, ["--convention", "modified"], {"convention": "modified"}),
    (COMPARE, ["--base", "frame_0"], {"base_frame": "frame_0"}),
    (COMPARE, ["--tip", "link_2"], {"tip_frame": "link_2"}),
    (DERIVE, ["--values"], {"symbolic": False}),
]
ELSEWHERE = {
    **dict.fromkeys(
        ("from", "fields", "output", "plot", "program", "waypoints"), "test_files, test_every_operation, test_ends"
    ),
    **dict.fromkeys(("job", "motion", "description", "replace", "robot", "urdf", "as"), "test_every_operation"),
    **dict.fromkeys(("batch", "seconds"), "test_ends"),
    "latex": "test_commands: only what people see",
    "help": "test_help",
}
"""Options that are not a field of a call, or that are compared in another test."""


def answer(url: str, asked: Asked, further: dict[str, Any]) -> Any:
    """By the API alone."""
    fields = {**asked.fields, **further}
    if asked.path.endswith("/workspace"):
        with Client(url) as gelenk, gelenk.jobs.workspace("ur5", **fields) as job:
            return json.loads(job.result().model_dump_json(exclude_unset=True))
    if asked in (FROM_URDF, SCREWS):
        return get(f"{url}/v1/{asked.path}?{urlencode(fields)}")[1]
    return get(f"{url}/v1/{asked.path}", "POST", fields)[1]


@pytest.fixture(scope="module", autouse=True)
def cell(url: str) -> Iterator[None]:
    """The scene that options name; gone at the end, for other tests may come between those of this module."""
    post = {"name": "post", "shape": {"type": "sphere", "radius": 0.1}, "pose": {"position": [0.0, 0.8, 0.3]}}
    assert get(f"{url}/v1/scenes", "POST", {"name": "cell", "objects": [post]})[0] == 201
    yield
    assert get(f"{url}/v1/scenes/cell", "DELETE")[0] == 204


@pytest.mark.slow
@pytest.mark.parametrize(
    ("asked", "option", "fields"),
    CASES,
    ids=[" ".join([*asked.words[:2], option[0]]) for asked, option, _ in CASES],
)
def test_an_option_is_its_field(
    shell: Shell,
    url: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    asked: Asked,
    option: list[str],
    fields: dict[str, Any],
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.json").write_text(json.dumps(TABLE))
    (tmp_path / "seam.csv").write_text("\n".join(AS_CSV))
    (tmp_path / "back.csv").write_text("\n".join([AS_CSV[0], *AS_CSV[:0:-1]]))
    told = answer(url, asked, fields)
    assert "detail" not in told, told
    assert told != answer(url, asked, {}), "it makes no difference"
    where = ["--server", url] if "--scene" in option else []  # which has the scene
    out, err = shell.run(*where, "--format", "json", *asked.words, *option, code=None)  # an answer may be no
    assert err == ""
    assert json.loads(out) == told


def options() -> Iterator[tuple[str, str]]:
    group = typer.main.get_command(cli)
    assert isinstance(group, TyperGroup)
    for name, command in group.commands.items():
        inner = command.commands if isinstance(command, TyperGroup) else {"": command}
        for part, one in inner.items():
            for parameter in one.params:
                long = [text for text in (*parameter.opts, *parameter.secondary_opts) if text.startswith("--")]
                if long:
                    yield f"{name} {part}".strip(), long[-1].removeprefix("--")


@pytest.mark.slow
def test_each_option_is_compared() -> None:
    compared = set()
    for asked, (option, *_), _ in CASES:
        words = 2 if asked.words[0] == "dh" else 1
        compared.add((" ".join(asked.words[:words]), option.removeprefix("--")))
    others = {(command, option) for command, option in options() if option not in ELSEWHERE} - compared
    left = {(command, option) for command, option in others if command not in {"exercises", "sheet", "grade"}}
    # Those are compared in `test_homework`.
    # No question with an answer to compare; and what is given to a new robot or scene, `test_every_operation` asks for.
    assert left == {
        ("bench", "base"),
        ("bench", "tip"),
        ("add", "base"),
        ("add", "tip"),
        ("add", "name"),
        ("add", "file"),
        ("scenes put", "name"),
        ("add", "argument"),
        ("jobs cancel", "finished"),
        ("jobs list", "limit"),
        ("jobs list", "before"),
    }
