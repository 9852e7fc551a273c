"""Handler of the worked solution of a DH table: workers derive the formulas, this process computes the numbers."""

import time
from concurrent.futures import Executor
from typing import Any

from starlette.responses import Response

from gelenk.contract.derive import DeriveRequest
from gelenk.dh.derive.jacobian import ROW_NAMES
from gelenk.dh.derive.numeric import NumericSolution
from gelenk.dh.derive.steps import which_block
from gelenk.dh.derive.texts import ColumnText, ConditionText, Singularities, SolutionText, SymbolEntry
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.errors import InvalidField
from gelenk.http.derive.lagrangian import formula_content, matrix_content, motion_content
from gelenk.http.messages.payloads import JSON, BoundedRequest, json_response, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import Handler, in_thread
from gelenk.http.workers.blocking_pool_client import BlockingPoolClient
from gelenk.http.workers.fair_semaphore import FairSemaphore
from gelenk.http.workers.pool_client import client_of, while_wanted
from gelenk.pool.pool import WorkerPool

SECONDS = 8.0
"""Time limit of the symbolic part, from the request's arrival, [s]; what is not done by then stays numeric."""
_AT_ONCE = 2
"""Maximum number of requests handled in threads of this process at a time, while the pool derives their formulas."""


def derive_handler(pool: WorkerPool, executor: Executor) -> Handler:
    """Return the handler of the derive endpoint: a thread of this process answers, with formulas from workers."""
    places = FairSemaphore(_AT_ONCE)

    async def handle(request: BoundedRequest) -> Response:
        deadline = time.monotonic() + SECONDS
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        if request.scope["query_string"]:
            raise InvalidField("query", "this call has its parameters as fields of the body")
        body = await request.body()

        client = client_of(request)
        blocking_client = BlockingPoolClient(pool, client)

        def work() -> Response:
            call = read_json(DeriveRequest, body)
            return json_response(_answer(call, _solved(call, blocking_client, deadline)))

        async def worked() -> Response:
            async with places.taken(client):
                return await in_thread(executor, work)

        try:
            return await while_wanted(request.receive, worked())
        finally:
            blocking_client.end()

    return handle


def _solved(call: DeriveRequest, blocking_client: BlockingPoolClient, deadline: float) -> WorkedSolution:
    return worked_solution(
        call.dh.table(),
        call.joint_positions,
        call.notation,
        keeps_symbols=call.symbolic,
        dynamics=None if call.dynamics is None else call.dynamics.dynamics(),
        run=blocking_client.run,
        deadline=deadline,
    )


def _answer(call: DeriveRequest, solution: WorkedSolution) -> dict[str, Any]:
    found, singular = solution.formulas, solution.singularities
    n, has_tip = len(solution.joint_names), found is not None and found.tip is not None
    rows, frames = (found.rows, found.frames) if found else ([None] * n, [None] * n)
    return {
        "convention": call.dh.convention,
        "joint_names": solution.joint_names,
        "notation": call.notation,
        "symbolic": call.symbolic,
        "legend": _legend(solution),
        "A": [matrix_content(f"A_{i}", matrix) for i, matrix in enumerate(rows, start=1)],
        "T_0": [matrix_content(f"T_0_{i}", matrix) for i, matrix in enumerate(frames, start=1)],
        "T_base_tool": matrix_content("T_base_tool", found.tip) if found and has_tip else None,
        "position": matrix_content("p", found.position) if found and has_tip else None,
        "rotation": matrix_content("R", found.rotation) if found and has_tip else None,
        "jacobian": _jacobian(solution),
        "determinant": None if singular is None else _determinant(singular),
        "singularities": _singularities(solution),
        "dynamics": None if solution.motion is None else motion_content(solution.motion, solution.joint_names),
        "numeric": [
            _numbers(one, determinant) for one, determinant in zip(solution.numeric, solution.determinants, strict=True)
        ],
        "steps": [{"title": step.title, "text": step.text, "latex": step.latex} for step in solution.steps],
        "notes": solution.notes,
        "certificate": _formula_certificate(solution),
        "numeric_certificate": _numeric_certificate(solution),
    }


def _legend(solution: WorkedSolution) -> list[dict[str, Any]]:
    entries: dict[str, SymbolEntry] = {}
    motion = solution.motion.texts if solution.motion is not None else None
    for part in (solution.formulas, solution.singularities, motion):
        for entry in part.legend if part else ():
            entries.setdefault(entry.symbol.plain, entry)
    return [
        {**formula_content(entry.symbol), "meaning_latex": entry.meaning.latex, "meaning": entry.meaning.plain}
        | {"value": entry.value}
        for entry in entries.values()
    ]


def _jacobian(solution: WorkedSolution) -> dict[str, Any] | None:
    found = solution.formulas
    if found is None or found.columns is None:
        return None
    columns = [
        _column(name, i, column)
        for i, (name, column) in enumerate(zip(solution.joint_names, found.columns, strict=True), start=1)
    ]
    return {"matrix": matrix_content("J", found.jacobian), "columns": columns}


def _column(joint: str, i: int, column: ColumnText) -> dict[str, Any]:
    return {
        "joint": joint,
        "axis": matrix_content("z", column.axis),
        "arm": None if column.arm is None else matrix_content("p", column.arm),
        "linear": matrix_content(f"J_v_{i}", column.linear),
        "angular": matrix_content(f"J_omega_{i}", column.angular),
    }


def _determinant(singular: Singularities) -> dict[str, Any] | None:
    block, formula = singular.block, singular.formula
    if block is None:
        return None
    return {
        "block": block.kind,
        "rows": [ROW_NAMES[i] for i in block.rows],
        "frame": block.frame,
        "why": which_block(singular),
        "latex": None if formula is None else formula.latex,
        "plain": None if formula is None else formula.plain,
        "factors": [formula_content(factor) for factor in singular.factors],
    }


def _singularities(solution: WorkedSolution) -> list[dict[str, Any]]:
    conditions: list[ConditionText] = solution.singularities.conditions if solution.singularities else []
    return [
        {
            "kind": condition.kind,
            "condition": {"latex": f"{condition.factor.latex} = 0", "plain": f"{condition.factor.plain} = 0"},
            "solutions": [_singular_value(one, solution.joint_names) for one in condition.solutions],
            "example": condition.example,
            "example_singular_value": sigma,
        }
        for condition, sigma in zip(conditions, solution.examples, strict=True)
    ]


def _singular_value(one: SolutionText, names: tuple[str, ...]) -> dict[str, Any]:
    return {
        "joints": [names[abs(i) - 1] for i in one.variables],
        "signs": [1 if i > 0 else -1 for i in one.variables],
        "variable": formula_content(one.variable),
        "formula": formula_content(one.formula),
        "value": one.value,
    }


def _numbers(one: NumericSolution, determinant: float | None) -> dict[str, Any]:
    return {
        "joint_positions": one.q.tolist(),
        "A": [A.tolist() for A in one.rows],
        "T_0": [T.tolist() for T in one.frames],
        "T_base_tool": one.tip.tolist(),
        "position": one.tip[:3, 3].tolist(),
        "rotation": one.tip[:3, :3].tolist(),
        "columns": [
            {
                "axis": column.axis.tolist(),
                "arm": column.arm.tolist(),
                "linear": column.linear.tolist(),
                "angular": column.angular.tolist(),
            }
            for column in one.columns
        ],
        "jacobian": one.jacobian.tolist(),
        "singular_values": one.singular_values.tolist(),
        "rank": one.rank,
        "determinant": determinant,
    }


def _formula_certificate(solution: WorkedSolution) -> dict[str, Any] | None:
    certificate = solution.certificate
    if certificate is None:
        return None
    return {"samples": certificate.samples, "max_error": certificate.max_error, "seed": certificate.seed}


def _numeric_certificate(solution: WorkedSolution) -> dict[str, Any] | None:
    poses, jacobians = solution.pose_certificate, solution.jacobian_certificate
    if poses is None or jacobians is None:
        return None
    return {
        "samples": poses.samples,
        "max_position_error": poses.max_position_error,
        "max_orientation_error": poses.max_orientation_error,
        "max_jacobian_error": jacobians.max_error,
    }
