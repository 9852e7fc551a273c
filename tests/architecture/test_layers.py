"""Who may know whom, asked of a fresh interpreter; and what no committed file may hold."""

import ast
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "app" / "gelenk"


def in_room(room: str, without: tuple[str, ...] = ()) -> list[str]:
    """Full names of the modules in a folder and in those below it."""
    files = sorted((PACKAGE / room.replace(".", "/")).rglob("[a-z]*.py"))
    return [module(file) for file in files if file.stem not in without]


def module(file: Path) -> str:
    return ".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts)


WITHOUT_PINOCCHIO = [
    *in_room("robot", without=("robot", "compilation")),
    *in_room("dh.tables"),
    *in_room("kinematics.simd"),
    "gelenk.kinematics.dynamics.bodies",
    "gelenk.kinematics.velocity.subspaces",
    *(f"gelenk.kinematics.workspace.{name}" for name in ("sampling", "voxels", "tip_motion", "workspace")),
    *in_room("ik.search"),
    *in_room("ik.closed"),
    "gelenk.ik.verdict.branches",
    *in_room("trajectory.motion"),
    *in_room("trajectory.paths", without=("segment_paths", "path_geometry")),
    *(f"gelenk.trajectory.laws.{name}" for name in ("trapezoid", "time_scaling")),
    "gelenk.trajectory.joints.parabolic_blends",
    *(f"gelenk.trajectory.audit.{name}" for name in ("pieces", "peaks", "tip", "demands")),
    *in_room("course"),
]
CORE = [name for room in ("robot", "dh", "ik", "kinematics", "trajectory", "course", "plots") for name in in_room(room)]
OF_THE_SERVER = (
    "fastapi",
    "starlette",
    "pydantic",
    "orjson",
    "uvicorn",
    "gelenk.settings",
    "gelenk.http",
    "gelenk.contract",
    "gelenk.store",
)


def loaded(*modules: str) -> set[str]:
    """What a fresh interpreter has loaded after importing these."""
    code = f"import sys, {', '.join(modules)}; print(*sys.modules)"
    answer = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    return set(answer.stdout.split())


@pytest.mark.slow
def test_independent_ways_to_the_same_number_never_meet_pinocchio() -> None:
    assert "pinocchio" not in loaded(*WITHOUT_PINOCCHIO)


@pytest.mark.slow
def test_the_core_knows_neither_http_nor_settings() -> None:
    modules = loaded(*CORE)
    assert "pinocchio" in modules
    assert not modules & set(OF_THE_SERVER)


def test_a_client_carries_numbers_and_computes_none() -> None:
    """What computes takes seconds to load, for which nobody at a shell wants to wait."""
    computing = {
        "pinocchio",
        "numba",
        "scipy",
        "sympy",
        "matplotlib",
        "gelenk.kinematics.simd.kernels",
        "gelenk.robot.notations",
    }
    assert not loaded("gelenk.cli.main", "gelenk.client") & computing


@pytest.mark.parametrize("path", sorted((ROOT / "tests" / "oracles").rglob("*.py")), ids=lambda path: path.stem)
def test_oracles_share_no_code_with_what_they_judge(path: Path) -> None:
    assert not re.search(r"^\s*(from|import) (gelenk|tests\.(?!oracles))", path.read_text(), re.MULTILINE)


@pytest.mark.parametrize(
    "package",
    [file.parent for file in sorted(PACKAGE.glob("*/**/__init__.py")) if file.parent.name != "client"],
    ids=str,
)
def test_packages_hold_a_docstring_and_nothing_else(package: Path) -> None:
    code = compile((package / "__init__.py").read_text(), str(package), "exec")
    assert code.co_consts[0]
    assert set(code.co_names) <= {"__doc__"}


LISTS = {"contract", "operations"}
"""Folders that are lists: a module an operation."""


def test_a_folder_has_at_most_fifteen_modules() -> None:
    sizes = {folder: len(list(folder.glob("*.py"))) for folder in PACKAGE.rglob("*") if folder.is_dir()}
    assert {folder.name: size for folder, size in sizes.items() if size > 15 and folder.name not in LISTS} == {}


@pytest.mark.slow
def test_no_class_name_stands_for_two_things() -> None:
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in PACKAGE.rglob("*.py")]
    names = Counter(node.name for tree in trees for node in tree.body if isinstance(node, ast.ClassDef))
    assert {name for name, count in names.items() if count > 1} == set()
