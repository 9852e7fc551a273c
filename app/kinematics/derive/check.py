"""Formulas against the numbers of the table itself."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.kinematics.derive.numeric import NumericSolution, numeric_solution
from app.kinematics.derive.texts import Singularities, Values
from app.model.arrays import Array
from app.model.dh import DhTable
from app.model.errors import CertificationFailed

TOLERANCE = 1e-9
"""Allowed difference of formulas and numbers, absolute and relative to the largest number compared."""
SINGULAR = 1e-6
"""Smallest singular value, relative to the largest, below which a configuration counts as singular."""


@dataclass(frozen=True, slots=True)
class FormulaCertificate:
    """How far formulas and numbers are apart.

    Attributes:
        samples: Configurations at which every matrix, the Jacobian and its determinant were compared.
        max_error: Largest difference of an entry.
        seed: Of the choice of samples.
    """

    samples: int
    max_error: float
    seed: int


def formulas_error(values: Sequence[Values], solutions: Sequence[NumericSolution]) -> float:
    """The largest difference of formulas and numbers.

    Raises:
        CertificationFailed: It is more than rounding.
    """
    worst = 0.0
    for value, solution in zip(values, solutions, strict=True):
        for i, (A, T) in enumerate(zip(value.rows, value.frames, strict=True)):
            worst = max(worst, _demand(f"A_{i + 1}", A, solution.rows[i]))
            if T is not None:
                worst = max(worst, _demand(f"T_0_{i + 1}", T, solution.frames[i]))
        if value.tip is not None:
            worst = max(worst, _demand("T_base_tool", value.tip, solution.tip))
        if value.jacobian is not None:
            worst = max(worst, _demand("the Jacobian", value.jacobian, solution.jacobian))
    return worst


def determinants_error(singular: Singularities, solutions: Sequence[NumericSolution]) -> float:
    """The largest difference of the determinant's product and the numbers.

    Raises:
        CertificationFailed: It is more than rounding.
    """
    worst, block = 0.0, singular.block
    if block is not None:
        for value, solution in zip(singular.values, solutions, strict=False):
            numbers = solution.block(block.rows, block.frame)
            bound = float(np.prod(np.linalg.norm(numbers, axis=0)))  # Hadamard's: rounding grows with it
            wanted = float(np.linalg.det(numbers))
            worst = max(worst, _demand("the determinant", [[value]], wanted, bound))
    return worst


def _demand(quantity: str, formula: Sequence[Sequence[float]], numbers: Array | float, scale: float = 1.0) -> float:
    error = float(np.abs(np.array(formula) - numbers).max())
    tolerance = TOLERANCE * max(1.0, scale, float(np.abs(numbers).max()))
    if not error <= tolerance:
        raise CertificationFailed(f"{quantity} in symbols", error, tolerance)
    return error


def example_singular_values(singular: Singularities, table: DhTable) -> list[float | None]:
    """The smallest singular value of the block at each example.

    Raises:
        CertificationFailed: The block is regular there.
    """
    found: list[float | None] = []
    for condition in singular.conditions:
        if condition.example is None or singular.block is None:
            found.append(None)
            continue
        solution = numeric_solution(table, np.array(condition.example))
        sigmas = np.linalg.svd(solution.block(singular.block.rows, singular.block.frame), compute_uv=False)
        if not sigmas[-1] <= SINGULAR * max(1.0, sigmas[0]):
            raise CertificationFailed("a singular configuration", float(sigmas[-1]), SINGULAR)
        found.append(float(sigmas[-1]))
    return found
