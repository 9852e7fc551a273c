"""The worked solution of a DH table. What is not derived in time stays numeric."""

import signal
import threading
import time
from collections.abc import Callable, Sequence
from itertools import chain
from types import FrameType
from typing import Any, TypeVar

from gelenk.contract.common import as_lists, content_of
from gelenk.contract.derive_dh import DeriveRequest, NumericInfo
from gelenk.contract.lagrangian import DynamicsInfo, MotionNumbers
from gelenk.dh.derive.jacobian import ROW_NAMES
from gelenk.dh.derive.numeric import NumericSolution
from gelenk.dh.derive.steps import which_block
from gelenk.dh.derive.texts import Singularities, SymbolEntry
from gelenk.dh.derive.typeset import MatrixFormula
from gelenk.dh.lagrangian.numeric import NumericMotion
from gelenk.dh.lagrangian.solution import MotionSolution
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.errors import InvalidField
from gelenk.operations.outcome import always, json_only

SECONDS = 8.0
"""Processor time of the symbolic part, [s]; what is not done by then stays numeric."""
_IMPORT = "<frozen importlib._bootstrap>"
_AFTER_IMPORT = 0.02
_BY_THE_CLOCK = 5.0
"""How many times as long it may take by the clock: a request that takes longer than allowed gets no answer at all."""
_Question = TypeVar("_Question")
_Result = TypeVar("_Result")


is_heavy = always  # a derivation takes tens of milliseconds, and up to its time limit


@json_only
def run(call: DeriveRequest) -> dict[str, Any]:
    """Derive the worked solution of a DH table in symbols, and evaluate it."""
    if call.first_index != 1 and call.dynamics is not None:
        raise InvalidField("first_index", "must be 1 with `dynamics`: the equations of motion are of a whole arm")
    before = call.first_index - 1
    solution = worked_solution(
        call.dh.table(),
        call.joint_positions,
        call.notation,
        keeps_symbols=call.symbolic,
        first_index=call.first_index,
        columns=call.columns,
        dynamics=None if call.dynamics is None else call.dynamics.dynamics(),
        run=in_time,
        deadline=time.process_time() + SECONDS,
    )
    found, singular, names = solution.formulas, solution.singularities, solution.joint_names
    jacobian = None
    if found is not None and found.columns is not None:
        jacobian = {"matrix": found.jacobian, "columns": found.columns}
    return {
        "convention": call.dh.convention,
        "joint_names": names,
        "notation": call.notation,
        "symbolic": call.symbolic,
        "legend": _legend(solution),
        "A": _matrices("A", [None] * len(names) if found is None else found.rows, before),
        "T_0": _matrices(f"T_{before}", [None] * len(names) if found is None else found.frames, before),
        "T_base_tool": found and found.tip,
        "position": found and found.position,
        "rotation": found and found.rotation,
        "jacobian": jacobian,
        "determinant": singular and _determinant(singular, before),
        "singularities": singular.conditions if singular else (),
        "dynamics": solution.motion and _dynamics(solution.motion),
        "numeric": [
            _numbers(one, determinant) for one, determinant in zip(solution.numeric, solution.determinants, strict=True)
        ],
        "steps": solution.steps,
        "notes": solution.notes,
        "certificate": solution.certificate,
        "numeric_certificate": solution.numeric_certificate,
    }


def in_time(function: Callable[[_Question], _Result], question: _Question, seconds: float) -> _Result:
    """Run a function, but break it off with TimeoutError after `seconds`, though never while it imports a module.

    They are seconds of processor time, so that an answer does not depend on what else the machine has to do; by the
    clock it may take `_BY_THE_CLOCK` times as long. Only a main thread can be broken off, as a worker's is; in another
    one, as at the command line, the function ends by itself.
    """
    timers = {signal.ITIMER_PROF: seconds, signal.ITIMER_REAL: _BY_THE_CLOCK * seconds}

    def stop(_: int, frame: FrameType | None) -> None:
        while frame is not None:
            if frame.f_code.co_filename == _IMPORT:
                signal.setitimer(signal.ITIMER_REAL, _AFTER_IMPORT)
                return
            frame = frame.f_back
        raise _Overdue

    if seconds <= 0.0:
        raise TimeoutError
    if threading.current_thread() is not threading.main_thread():
        return function(question)
    signal.signal(signal.SIGPROF, stop)
    signal.signal(signal.SIGALRM, stop)
    try:
        try:
            for timer, limit in timers.items():
                signal.setitimer(timer, limit)
            return function(question)
        finally:
            for timer in timers:
                signal.setitimer(timer, 0.0)
    except _Overdue:
        raise TimeoutError from None


class _Overdue(BaseException):
    """No handler of other exceptions must stop this one."""


def _legend(solution: WorkedSolution) -> list[SymbolEntry]:
    parts = (solution.formulas, solution.singularities, solution.motion.texts if solution.motion else None)
    unique: dict[str, SymbolEntry] = {}
    for entry in chain.from_iterable(part.legend for part in parts if part is not None):
        unique.setdefault(entry.plain, entry)
    return list(unique.values())


def _matrices(letter: str, matrices: Sequence[MatrixFormula | None], before: int) -> list[MatrixFormula]:
    """Return matrices, with nulls in place of those that are too long."""
    numbered = enumerate(matrices, start=before + 1)
    return [matrix or MatrixFormula(f"{letter}_{i}", None, None) for i, matrix in numbered]


def _determinant(singular: Singularities, before: int) -> dict[str, Any] | None:
    block, formula = singular.block, singular.formula
    if block is None:
        return None
    return {
        "block": block.kind,
        "rows": [ROW_NAMES[i] for i in block.rows],
        "frame": block.frame + before,
        "why": which_block(block, before),
        "latex": formula and formula.latex,
        "plain": formula and formula.plain,
        "factors": singular.factors,
    }


def _numbers(one: NumericSolution, determinant: float | None) -> dict[str, Any]:
    named = {"joint_positions": one.q, "A": one.rows, "T_0": one.frames, "T_base_tool": one.tip}
    parts = {"position": one.tip[:3, 3], "rotation": one.tip[:3, :3], "determinant": determinant}
    numbers: dict[str, Any] = as_lists(content_of(NumericInfo, one, **named, **parts))
    return numbers


def _dynamics(motion: MotionSolution) -> dict[str, Any]:
    certificates = {"certificate": motion.certificate, "numeric_certificate": motion.numeric_certificate}
    return content_of(
        DynamicsInfo, motion.texts, numeric=[_motion_numbers(one) for one in motion.numeric], **certificates
    )


def _motion_numbers(one: NumericMotion) -> dict[str, Any]:
    numbers: dict[str, Any] = as_lists(content_of(MotionNumbers, one, joint_positions=one.q, joint_velocities=one.v))
    return numbers
