"""What a shell shows before a command is run: examples that answer, and words that complete."""

import os
import shlex
import subprocess
import sys
from pathlib import Path
from typing import Any, get_args

import pytest

from gelenk.cli import completion
from gelenk.cli.completion import one_of
from gelenk.cli.session import EXAMPLES
from gelenk.contract.ik import InverseOptions
from gelenk.contract.jacobian import JacobianOptions
from gelenk.trajectory.audit.words import Law
from tests.cli.conftest import Shell
from tests.cli.test_ends import ran

URDF = "<robot name='a'><link name='base'/>\n<link  name=\"tool\"><visual/></link></robot>"


@pytest.mark.slow
def test_each_command_shows_a_call_and_each_call_answers(
    shell: Shell, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for command in ("dh from-urdf", *EXAMPLES):
        told = " ".join(shell(*command.split(), "--help")[0].split())
        assert EXAMPLES[command] in told
        program, *arguments = shlex.split(EXAMPLES[command])
        assert program == "gelenk"
        if command == "add":
            shell("-o", "arm.urdf", "robots", "planar_2r", "--urdf")
        if command == "grade":
            Path("answers.csv").write_text("participant,exercise,field,answer\n7,actuators.gear,speed,60\n", "utf-8")
        shell(*arguments)
    shell.remove_added()
    assert {path.name for path in tmp_path.iterdir()} == {
        *("arm.urdf", "table.csv", "motion.csv", "points.npy", "ellipse.svg", "reach.png"),
        *("sheets.zip", "answers.csv", "frames.svg"),
    }


def chosen(model: Any, field: str) -> tuple[str, ...]:
    """The words of a field, whose type is one list of them or several."""
    kinds = get_args(model.model_fields[field].annotation)
    return tuple(word for kind in kinds for word in (get_args(kind) or (kind,)))


def test_words_that_complete_are_those_of_the_schema() -> None:
    assert set(completion.METHODS) == set(chosen(InverseOptions, "method"))
    assert set(completion.REFERENCES) == set(chosen(JacobianOptions, "reference"))
    assert set(completion.REPRESENTATIONS) == set(chosen(JacobianOptions, "representation"))
    assert set(completion.LAWS) == set(get_args(Law))
    assert one_of(completion.LAWS)("t") == ["trapezoidal", "time_optimal"]


def completed(words: str, server: str = "") -> list[str]:
    """What a shell offers for the last word, by a process of its own."""
    typed = {"_GELENK_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": str(len(words.split(" ")) - 1)}
    return ran(**typed, **({"GELENK_SERVER": server} if server else {})).split()


@pytest.mark.slow
@pytest.mark.parametrize("shell_name", ["bash", "zsh", "fish"])
def test_completion_is_installed(tmp_path: Path, shell_name: str) -> None:
    """And bash, which is everywhere, completes with it."""
    program = tmp_path / "gelenk"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m gelenk.cli.main "$@"\n')
    program.chmod(0o755)
    ran("--install-completion", shell_name, HOME=str(tmp_path), _TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION="1")
    written = "".join(path.read_text() for path in tmp_path.rglob("*") if path.is_file() and path != program)
    assert f"complete_{shell_name}" in written
    if shell_name == "bash":
        script = (
            "source ~/.bashrc; COMP_WORDS=(gelenk trajectory planar_2r --law t); COMP_CWORD=4; "
            '_gelenk_completion gelenk; echo "${COMPREPLY[@]}"'
        )
        environment = {**os.environ, "HOME": str(tmp_path), "PATH": f"{tmp_path}:{os.environ['PATH']}"}
        run = subprocess.run(
            ["bash", "-c", script], capture_output=True, text=True, env=environment, timeout=120, check=True
        )
        assert run.stdout.split() == ["trapezoidal", "time_optimal"]


@pytest.mark.slow
def test_frames_are_completed(url: str, tmp_path: Path) -> None:
    """Those of the server; without one the ends of chains, and the links of a file."""
    assert completed("gelenk fk panda --tip panda_h", url) == ["panda_hand", "panda_hand_tcp"]
    assert completed("gelenk fk panda --tip panda_h") == ["panda_hand_tcp"]
    (tmp_path / "arm.urdf").write_text(URDF)
    assert completed(f"gelenk dh compare table.csv {tmp_path / 'arm.urdf'} --base ") == ["base", "tool"]
    assert completed("gelenk fk nobody --tip p") == []
