"""What a call loads before it answers, counted and not timed: nothing that it does not need."""

import json
import subprocess
import sys
from typing import Any

import pytest
import typer

from gelenk.cli.light.group import SUMMARIES
from gelenk.cli.light.quick import quick_answer
from gelenk.cli.local import InProcess
from gelenk.cli.main import cli
from gelenk.client import Client
from tests.cli.conftest import Shell

HEAVY = ("numpy", "pydantic", "fastapi", "httpx2", "numba", "pinocchio", "matplotlib", "rich", "urllib.request")
"""Parts of which each takes from a fiftieth to a third of a second to load."""


def loaded_by(*words: str) -> set[str]:
    """The modules of a process that has answered a call, or has ended otherwise."""
    code = (
        "import atexit, sys; sys.argv[0] = 'gelenk'; "
        "atexit.register(lambda: print('\\nloaded:', *sys.modules)); "
        "from gelenk.cli.start import main; main()"
    )
    run = subprocess.run([sys.executable, "-c", code, *words], capture_output=True, text=True, timeout=300, check=True)
    return set(run.stdout.rpartition("\nloaded: ")[2].split())


def test_help_loads_nothing_that_computes() -> None:
    loaded = loaded_by("--help")
    assert "gelenk.cli.light.group" in loaded
    assert loaded.isdisjoint(HEAVY)


def test_the_help_of_a_command_loads_that_command() -> None:
    loaded = loaded_by("fk", "--help")
    assert loaded & {f"gelenk.cli.{module}" for module in SUMMARIES} == {"gelenk.cli.arms"}
    assert loaded & set(HEAVY) <= {"pydantic"}  # with which Typer reads options


def test_the_list_of_commands_says_what_each_says_of_itself() -> None:
    group = typer.main.get_command(cli)
    listed = {name: text for commands in SUMMARIES.values() for name, text in commands.items()}
    assert listed == {name: command.help for name, command in group.commands.items()}  # type: ignore[attr-defined]


ASKED: dict[str, dict[str, Any]] = {
    "fk": {"joint_positions": [[0.3, -0.7, 0.2, 1.1], [0.0, 0.0, 0.0, 0.0]], "pose_format": "zyz"},
    "jacobian": {"joint_positions": [[0.3, -0.7, 0.2, 1.1]], "reference": "local"},
    "manipulability": {"joint_positions": [[0.3, -0.7, 0.2, 1.1]]},
}
SERVER_OR_COMPILER = ("fastapi", "starlette", "uvicorn", "httpx2", "matplotlib", "numba", "scipy", "sympy")
MESSAGES_OF_OTHERS = ("gelenk.contract.robots", "gelenk.contract.screws", "gelenk.dh.derive", "gelenk.jobs.store")
ALONE = """
import json, sys
from gelenk.cli.light.quick import quick_answer
answers = {name: json.loads(quick_answer(name, "scara", asked).model_dump_json(exclude_unset=True))
           for name, asked in json.loads(sys.argv[1]).items()}
print(json.dumps([answers, [*sys.modules]]))
"""


def test_a_quick_call_needs_neither_server_nor_compiler_and_has_the_numbers_of_compiled_kernels(
    own: InProcess,
) -> None:
    """It is certified too. Rounding alone differs: a compiled sum of products has one rounding less."""
    line = [sys.executable, "-c", ALONE, json.dumps(ASKED)]
    run = subprocess.run(line, capture_output=True, text=True, timeout=300, check=True)
    answers, loaded = json.loads(run.stdout)
    assert not {*SERVER_OR_COMPILER, *MESSAGES_OF_OTHERS} & set(loaded)
    client = Client("http://127.0.0.1", transport=own)
    for name, asked in ASKED.items():
        expected = json.loads(getattr(client, name)("scara", **asked).model_dump_json(exclude_unset=True))
        certificate, error = answers[name].pop("certificate"), expected.pop("certificate")
        assert certificate.keys() == error.keys()
        errors = [value for key, value in certificate.items() if "error" in key and value is not None]
        assert errors and max(errors) < 1e-14
        assert_close(answers[name], expected)


def assert_close(found: Any, expected: Any) -> None:
    """The same structure, and numbers that differ by rounding."""
    if isinstance(expected, dict):
        assert found.keys() == expected.keys()
        for key, value in expected.items():
            assert_close(found[key], value)
    elif isinstance(expected, list):
        assert len(found) == len(expected)
        for one, other in zip(found, expected, strict=True):
            assert_close(one, other)
    elif isinstance(expected, float):
        assert abs(found - expected) <= 1e-14 * max(1.0, abs(expected))
    else:
        assert found == expected


@pytest.mark.parametrize(
    ("robot", "fields"),
    [
        ("no_such_robot", {"joint_positions": [[0.0, 0.0]]}),
        ("planar_2r", {"joint_positions": [[0.0, 0.0]], "steps": True}),
        ("planar_2r", {"joint_positions": [[0.0, 0.0]] * 17}),
        ("planar_2r", {"joint_positions": [[0.0, float("nan")]]}),
        ("planar_2r", {"joint_positions": [[0.0, 0.0]], "pose_format": "no such one"}),
        ("../robots/planar_2r", {"joint_positions": [[0.0, 0.0]]}),
    ],
)
def test_other_calls_are_left_to_the_application(robot: str, fields: dict[str, Any]) -> None:
    """Which names what is wrong with them."""
    assert quick_answer("fk", robot, fields) is None


@pytest.mark.parametrize("words", [("-q", "0 0 0"), ("-q", "0 0", "--tip", "nothing")])
def test_a_quick_call_is_refused_in_the_words_of_the_application(shell: Shell, words: tuple[str, ...]) -> None:
    _, quick = shell("fk", "planar_2r", *words, code=2)
    _, whole = shell("fk", "planar_2r", *words, "--fields", '{"steps": false}', code=2)
    assert quick == whole != ""
