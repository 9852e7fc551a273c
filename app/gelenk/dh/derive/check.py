"""Comparison of formulas with the numbers of the table itself: one that differs by more than rounding is left out."""

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from gelenk.dh.derive.jacobian import Block
from gelenk.dh.derive.numeric import NumericSolution, numeric_solution
from gelenk.dh.derive.texts import Formulas, SingularCondition, Singularities
from gelenk.errors import CertificationFailed
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

logger = logging.getLogger("gelenk")

SEED = 0
"""Random seed of the samples at which formulas are compared."""
TOLERANCE = 1e-9
"""Allowed difference of formulas and numbers, absolute and relative to the largest number compared."""
ROUNDING = 1e-13
"""Allowed difference relative to the terms that add up to a formula's value, or to an entry, even if they cancel."""
SINGULAR = 1e-6
"""Smallest singular value, relative to the largest, below which a configuration counts as singular."""


@dataclass(slots=True)
class Checks:
    """Collects the results of checks: the largest difference of formulas that hold, and a note per formula left out."""

    worst: float
    notes: list[str]

    def left_out(self, failure: CertificationFailed, instead: str = "it is left out") -> None:
        """Log a formula that fails, which is an error in the program, and note that it is left out."""
        difference = f"by {failure.error:.3g}, more than {failure.tolerance:.3g}"
        logger.error("derived formula left out: %s differs from the numbers %s", failure.quantity, difference)
        self.notes.append(f"{failure.quantity} failed the comparison with numbers ({difference}): {instead}")

    def holds(self, quantity: str, formulas: Sequence[object | None], numbers: Sequence[Array]) -> bool:
        """Check whether a formula has the numbers' values at all samples; one that is not written out passes."""
        if any(formula is None for formula in formulas):
            return True
        worst = 0.0
        for formula, wanted in zip(formulas, numbers, strict=True):
            error = float(np.abs(np.asarray(formula, dtype=float) - wanted).max())
            tolerance = TOLERANCE * max(1.0, float(np.abs(wanted).max()))
            if not error <= tolerance:
                self.left_out(CertificationFailed(f"{quantity} in symbols", error, tolerance))
                return False
            worst = max(worst, error)
        self.worst = max(self.worst, worst)
        return True


def checked_formulas(found: Formulas, solutions: Sequence[NumericSolution], checks: Checks) -> Formulas:
    """Return transforms and Jacobian without the formulas that differ from the numbers at the same samples."""
    values, size = found.values, range(len(found.rows))
    rows = [checks.holds(f"A_{i + 1}", [v.rows[i] for v in values], [s.rows[i] for s in solutions]) for i in size]
    frames = [
        checks.holds(f"T_0_{i + 1}", [v.frames[i] for v in values], [s.frames[i] for s in solutions]) for i in size
    ]
    tip = checks.holds("T_base_tool", [value.tip for value in values], [one.tip for one in solutions])
    jacobian = checks.holds("the Jacobian", [value.jacobian for value in values], [one.jacobian for one in solutions])
    return replace(
        found,
        rows=[row if good else None for row, good in zip(found.rows, rows, strict=True)],
        frames=[frame if good else None for frame, good in zip(found.frames, frames, strict=True)],
        tip=found.tip if tip else None,
        chain=found.chain if tip and all(rows) else None,
        position=found.position if tip else None,
        rotation=found.rotation if tip else None,
        columns=found.columns if jacobian else None,
        jacobian=found.jacobian if jacobian else None,
    )


def checked_singularities(
    singular: Singularities, solutions: Sequence[NumericSolution], table: DhTable, checks: Checks
) -> Singularities:
    """Return the determinant's formulas that agree with the numbers, with the smallest singular value at each example.

    The block must be singular at the example of a condition, which shows that the condition is solved correctly. If it
    is not, the factor remains, since the determinant holds, but is not solved. `table` is as the formulas read it.
    """
    if singular.block is None or not _determinant_holds(singular, singular.block, solutions, table, checks):
        return Singularities(singular.block, singular.setting)
    conditions = []
    for one in singular.conditions:
        sigmas = _at_example(one, singular.block, table)
        if sigmas is None:
            conditions.append(one)
        elif sigmas[-1] <= (most := SINGULAR * max(1.0, sigmas[0])):
            conditions.append(replace(one, example_singular_value=sigmas[-1]))
        else:
            checks.left_out(CertificationFailed(f"the configuration at which {one.condition.plain}", sigmas[-1], most))
            conditions.append(replace(one, kind="equation", solutions=[], example=None))
    return replace(singular, conditions=conditions)


def _determinant_holds(
    singular: Singularities, block: Block, solutions: Sequence[NumericSolution], table: DhTable, checks: Checks
) -> bool:
    worst = 0.0
    for value, size, solution in zip(singular.values, singular.sizes, solutions, strict=False):
        numbers = solution.block(block.rows, block.frame)
        norms = np.linalg.norm(numbers, axis=0)
        bound = float(np.prod(norms))  # Hadamard's bound: rounding grows with it
        rounded = float(np.prod(norms + ROUNDING * _scales(solution, table))) - bound
        error = abs(value - float(np.linalg.det(numbers)))
        tolerance = TOLERANCE * bound + rounded + ROUNDING * size
        if not error <= tolerance:
            checks.left_out(CertificationFailed("the determinant in symbols", error, tolerance))
            return False
        worst = max(worst, error)
    checks.worst = max(checks.worst, worst)
    return True


def _scales(solution: NumericSolution, table: DhTable) -> Array:
    """Return the sizes of the terms that add up to each column of the Jacobian; shape (n,), [m per rad or m]."""
    steps = [float(np.linalg.norm(A[:3, 3])) for A in solution.rows]
    first, tool = (0 if table.convention == "standard" else 1), float(np.linalg.norm(table.tool[:3, 3]))
    arms = [sum(steps[i + first :]) + tool for i in range(len(steps))]
    return 1.0 + np.array(arms) * [row.type == "revolute" for row in table.joints]


def _at_example(condition: SingularCondition, block: Block, table: DhTable) -> list[float] | None:
    """Return the singular values of the block at a condition's example; None without an example."""
    if condition.example is None:
        return None
    solution = numeric_solution(table, np.array(condition.example))
    values: list[float] = np.linalg.svd(solution.block(block.rows, block.frame), compute_uv=False).tolist()
    return values
