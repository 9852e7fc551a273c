"""What compiling must not do: take time from a limit, or end a program that can write nowhere."""

import os
import re
import shutil
import subprocess
import sys
import threading
import time
import zlib
from pathlib import Path
from typing import Any, cast

import llvmlite.binding
import numba
import numpy as np
import pytest
from numba.core.compiler_lock import global_compiler_lock

from gelenk.ik import solve
from gelenk.ik.search.bounds import mid_range
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.robot import compilation
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import clock, when_compiling
from gelenk.robot.notations import rotations_from_zyz
from tests.robots import robot

COMPILING, LIMIT = 2.5, 2.0
"""Seconds; inverse kinematics needs some milliseconds."""


def compile_something() -> None:
    """What numba does when a function is called for the first time, for as long as a large one takes."""
    with global_compiler_lock:
        time.sleep(COMPILING)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["ur5", "panda"])
@pytest.mark.parametrize("options", [{}, {"every": True}, {"method": "newton"}], ids=str)
def test_a_limit_of_time_does_not_count_compiling(
    name: str, options: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = mid_range(chain)[None] + 0.1
    targets = forward_kinematics(machine, chain, qs).poses
    inverse_kinematics(machine, chain, targets, qs - 0.02, Options(**options))  # what is really compiled here is now

    answered = solve._answered

    def cold(problem: TargetProblem) -> InverseKinematics:
        compile_something()
        return answered(problem)

    monkeypatch.setattr(solve, "_answered", cold)
    found = inverse_kinematics(machine, chain, targets, qs - 0.02, Options(**options, time_limit=LIMIT))
    assert found.statuses == ["solved"]


def test_the_cache_knows_every_source_that_kernels_are_made_of() -> None:
    """Numba itself looks at the file of a function alone."""
    package = Path(compilation.__file__).parents[1]
    decorated = re.compile(r"^@(compiled|unmanaged|inlined|exclusive)$", re.MULTILINE)
    defining = {str(p.relative_to(package)) for p in package.rglob("*.py") if decorated.search(p.read_text("utf-8"))}
    assert len(defining) >= 10
    assert defining <= compilation.kernel_digests().keys()


def test_code_is_the_same_whichever_function_calls_it_first(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numba's default is to inline what an inlined function calls, and to store that for all."""
    monkeypatch.setitem(compilation._UNMANAGED, "cache", False)

    def half(x: float) -> float:
        return 0.5 * x

    def half_and_one(x: float) -> float:
        return inside(x) + 1.0

    alone, inside, around = compilation.unmanaged(half), compilation.unmanaged(half), compilation.inlined(half_and_one)
    assert (alone(3.0), around(3.0)) == (1.5, 2.5)
    for one, is_inlined in ((alone, False), (inside, False), (around, True)):
        (code,) = cast(Any, one).overloads.values()
        assert code.fndesc.inline == is_inlined


def test_a_change_recompiles_what_it_is_compiled_into_and_nothing_else(monkeypatch: pytest.MonkeyPatch) -> None:
    sources = {
        "robot/low.py": b"x = 1",
        "ik/middle.py": b"from gelenk.robot.low import x",
        "ik/top.py": b"from gelenk.ik.middle import x\n@compiled\ndef top(): pass",
        "ik/alone.py": b"@compiled\ndef alone(): pass",
    }
    monkeypatch.setattr(compilation, "_sources", lambda: sources)
    before = compilation.kernel_digests()
    sources["robot/low.py"] = b"x = 2"
    after = compilation.kernel_digests()
    assert before.keys() == {"ik/top.py", "ik/alone.py"}
    assert before["ik/alone.py"] == after["ik/alone.py"]
    assert before["ik/top.py"] != after["ik/top.py"]


@pytest.mark.slow
def test_the_clock_stands_still_while_any_thread_compiles_or_waits_for_that() -> None:
    began, threads = clock(), [threading.Thread(target=compile_something) for _ in range(2)]
    for thread in threads:
        thread.start()
        time.sleep(0.1)
    first = clock()
    time.sleep(0.2)
    assert clock() == first
    for thread in threads:
        thread.join()
    assert first - began < COMPILING
    second = clock()
    time.sleep(0.1)
    assert clock() - second >= 0.1


def test_what_is_compiled_is_told_once() -> None:
    told: list[None] = []
    function = numba.njit(lambda x: x + 1)
    with when_compiling(lambda: told.append(None)):
        for value in (1, 1.0, 2.0):
            function(value)
    function(True)
    assert len(told) == 1


@pytest.mark.slow
@pytest.mark.parametrize("is_set", [True, False])
def test_where_nothing_can_be_written_it_says_so_and_goes_on(is_set: bool, tmp_path: Path) -> None:
    """A tree and a home that nobody can write to: files are where folders would have to be."""
    shutil.copytree("app/gelenk/robot", tmp_path / "gelenk" / "robot", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy("app/gelenk/errors.py", tmp_path / "gelenk")
    (tmp_path / "gelenk" / "__init__.py").touch()
    nowhere = tmp_path / "gelenk" / "__pycache__"
    for file in (nowhere, tmp_path / "gelenk" / "robot" / "__pycache__"):
        file.touch()
    environment = {
        name: value for name, value in os.environ.items() if name not in {"NUMBA_CACHE_DIR", "XDG_CACHE_HOME"}
    }
    environment |= {"HOME": str(nowhere)} | ({"NUMBA_CACHE_DIR": str(nowhere / "kernels")} if is_set else {})
    program = "import numpy; from gelenk.robot import notations; notations.rotations_from_rpy(numpy.zeros((1, 3)))"
    command = [sys.executable, "-c", program]
    run = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stderr.count("\n") == 1
    assert f"nothing can be written to {nowhere}" in run.stderr


@pytest.mark.skipif(compilation.STORE is None, reason="nothing is stored")
def test_a_stored_kernel_brings_the_names_that_its_code_defines(monkeypatch: pytest.MonkeyPatch) -> None:
    rotations_from_zyz(np.zeros((1, 3)))
    kernel: Any = rotations_from_zyz
    engine = kernel.targetctx.codegen()._engine
    monkeypatch.setattr(engine, "_defined_symbols", set())
    library = kernel._cache.load_overload(kernel.signatures[0], kernel.targetctx).library
    module = llvmlite.binding.parse_bitcode(zlib.decompress(library._packed))
    values = [*module.functions, *module.global_variables]
    assert engine._defined_symbols == {value.name for value in values if not value.is_declaration}
    assert library.get_pointer_to_function(kernel.overloads[kernel.signatures[0]].fndesc.llvm_cpython_wrapper_name)


@pytest.mark.skipif(compilation.STORE is None, reason="nothing is stored")
def test_the_code_of_a_stored_kernel_is_unpacked_when_another_one_is_compiled_with_it() -> None:
    angles = np.array([[0.1, 0.2, 0.3]])
    expected = rotations_from_zyz(angles)
    kernel: Any = rotations_from_zyz
    (signature,) = kernel.signatures
    stored = kernel._cache.load_overload(signature, kernel.targetctx)
    assert isinstance(stored.library._packed, bytes)
    kernel.overloads[signature].library._shared_module = stored.library._packed

    def turned(angles: Array) -> Array:
        return rotations_from_zyz(angles)

    compile_function: Any = numba.njit
    np.testing.assert_array_equal(compile_function(turned)(angles), expected)
    assert not isinstance(kernel.overloads[signature].library._packed, bytes)
