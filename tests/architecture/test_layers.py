"""Who may know whom, asked of a fresh interpreter; and what no committed file may hold."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

WITHOUT_PINOCCHIO = [
    *(f"app.model.{name}" for name in ("poses", "dh", "xml", "urdf", "tree", "description", "chain", "convert")),
    "app.kinematics.kernels",
    "app.kinematics.configuration",
]
CORE = [
    f"app.{package}.{path.stem}"
    for package in ("model", "kinematics")
    for path in sorted((ROOT / "app" / package).glob("*.py"))
    if path.stem != "__init__"
]
OF_THE_SERVER = (
    "fastapi",
    "starlette",
    "pydantic",
    "orjson",
    "uvicorn",
    "app.settings",
    "app.api",
    "app.schemas",
    "app.store",
)


def loaded(*modules: str) -> set[str]:
    """What a fresh interpreter has loaded after importing these."""
    code = f"import sys, {', '.join(modules)}; print(*sys.modules)"
    answer = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(answer.stdout.split())


def test_independent_ways_to_the_same_number_never_meet_pinocchio() -> None:
    assert "pinocchio" not in loaded(*WITHOUT_PINOCCHIO)


def test_the_core_knows_neither_http_nor_settings() -> None:
    modules = loaded(*CORE)
    assert "pinocchio" in modules
    assert not modules & set(OF_THE_SERVER)


@pytest.mark.parametrize("path", sorted((ROOT / "tests" / "oracles").glob("*.py")), ids=lambda path: path.stem)
def test_oracles_share_no_code_with_what_they_judge(path: Path) -> None:
    assert not re.search(r"^\s*(from|import) (app|tests\.(?!oracles))", path.read_text(), re.MULTILINE)


@pytest.mark.parametrize("package", sorted(path.parent for path in (ROOT / "app").rglob("__init__.py")), ids=str)
def test_packages_hold_a_docstring_and_nothing_else(package: Path) -> None:
    code = compile((package / "__init__.py").read_text(), str(package), "exec")
    assert code.co_consts[0]
    assert set(code.co_names) <= {"__doc__"}


# What no committed file may hold

FORBIDDEN = {
    "a path of one machine": r"[/]work/|[/]root/|[/]home/\w+/",
    "the address of a package index": r"pypi[.]org/|pythonhosted[.]org|npmjs[.]org|yarnpkg[.]com",
    "who or what wrote it": r"clau[d]e|anthropi[c]|chatgp[t]|opena[i]|co-authored[-]by|\bissue[ ]#?\d|sub-?[a]gent",
}
"""Brackets keep the patterns from finding themselves."""
BINARY = {".npy", ".npz", ".png", ".jpg", ".ico", ".stl", ".dae", ".obj", ".zip", ".woff2", ".glb"}


def committed() -> Iterator[Path]:
    """Text files that are, or would be, committed."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    answer = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    for name in filter(None, answer.stdout.split("\0")):
        path = ROOT / name
        if path.suffix not in BINARY and path.is_file():
            yield path


@pytest.mark.parametrize("pattern", FORBIDDEN.values(), ids=FORBIDDEN)
def test_no_file_names(pattern: str) -> None:
    found = re.compile(pattern, re.IGNORECASE)
    places = [
        f"{path.relative_to(ROOT)}:{number}: {match[0]}"
        for path in committed()
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), start=1)
        if (match := found.search(line))
    ]
    assert not places


def test_the_files_are_seen() -> None:
    assert {ROOT / "pyproject.toml", Path(__file__)} <= set(committed())
