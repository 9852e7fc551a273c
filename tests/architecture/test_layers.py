"""Who may know whom, asked of a fresh interpreter; and what no committed file may hold."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

WITHOUT_PINOCCHIO = [
    *(f"gelenk.model.{name}" for name in ("poses", "dh", "xml", "urdf", "tree", "description", "chain", "convert")),
    *(f"gelenk.model.{name}" for name in ("notations", "appearance", "dh_from_chain", "origins")),
    *(f"gelenk.kinematics.{name}" for name in ("lanes", "vectors", "kernels", "bodies", "configuration", "subspaces")),
    *(f"gelenk.kinematics.{name}" for name in ("sampling", "voxels", "tip_motion", "workspace")),
    *(f"gelenk.kinematics.ik.{name}" for name in ("iteration", "kernels", "task", "steps", "linearise", "reach")),
    *(f"gelenk.kinematics.ik.{name}" for name in ("subproblems", "compositions", "branch_kernels", "closed_form")),
    *(f"gelenk.kinematics.ik.{name}" for name in ("search", "descent", "retrace", "null_space", "branches")),
    *(
        f"gelenk.trajectory.{name}"
        for name in ("polynomial", "extremes", "time_laws", "phases", "trapezoid", "splines")
    ),
    *(
        f"gelenk.trajectory.{name}"
        for name in ("parabolic_blends", "tridiagonal", "time_scaling", "certify", "formulas")
    ),
    *(
        f"gelenk.trajectory.{name}"
        for name in ("fly_over", "blended_motion", "fly_over_check", "fly_over_steps", "curves")
    ),
    *(
        f"gelenk.trajectory.{name}"
        for name in ("paths", "spline_paths", "orientation_paths", "rotation_splines", "so3")
    ),
    *(f"gelenk.trajectory.{name}" for name in ("audit_pieces", "audit_peaks", "audit_tip", "audit_demands")),
    *(f"gelenk.course.{path.stem}" for path in sorted((ROOT / "app" / "gelenk" / "course").glob("[a-z]*.py"))),
]
CORE = [
    ".".join(path.relative_to(ROOT).with_suffix("").parts)
    for package in ("model", "kinematics", "course", "plots")
    for path in sorted((ROOT / "app" / "gelenk" / package).rglob("*.py"))
    if path.stem != "__init__"
]
OF_THE_SERVER = (
    "fastapi",
    "starlette",
    "pydantic",
    "orjson",
    "uvicorn",
    "gelenk.settings",
    "gelenk.api",
    "gelenk.contract",
    "gelenk.store",
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


def test_a_client_carries_numbers_and_computes_none() -> None:
    """What computes takes seconds to load, for which nobody at a shell wants to wait."""
    computing = {
        "pinocchio",
        "numba",
        "scipy",
        "sympy",
        "matplotlib",
        "gelenk.kinematics.kernels",
        "gelenk.model.notations",
    }
    assert not loaded("gelenk.cli.main", "gelenk.client") & computing


@pytest.mark.parametrize("path", sorted((ROOT / "tests" / "oracles").glob("*.py")), ids=lambda path: path.stem)
def test_oracles_share_no_code_with_what_they_judge(path: Path) -> None:
    assert not re.search(r"^\s*(from|import) (gelenk|tests\.(?!oracles))", path.read_text(), re.MULTILINE)


@pytest.mark.parametrize(
    "package", sorted(path.parent for path in (ROOT / "app" / "gelenk").glob("*/**/__init__.py")), ids=str
)
def test_packages_hold_a_docstring_and_nothing_else(package: Path) -> None:
    code = compile((package / "__init__.py").read_text(), str(package), "exec")
    assert code.co_consts[0]
    assert set(code.co_names) <= {"__doc__"}
