"""Worked solutions of singularities: numbers of the core, and the determinant in symbols where the chain has one."""

import re
import time
from collections.abc import Sequence

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.singularity_steps import SingularityQuestion, singularity_steps
from gelenk.course.writing import number
from gelenk.dh.derive.steps import determinant_steps
from gelenk.dh.tables.from_chain import standard_table
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.kinematics.singularity.report import SingularityReport
from gelenk.kinematics.velocity.task_space import TaskSpace, random_configurations
from gelenk.operations.derive_dh import in_time
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

_SECONDS = 4.0
"""Time limit of the determinant in symbols, [s]."""
_TRIALS = 5
_SAME = 1e-6


def worked_singularities(
    robot: RobotModel, chain: Chain, space: TaskSpace, qs: Array, reports: Sequence[SingularityReport]
) -> list[list[Step]]:
    """Return the steps at each configuration."""
    Js, factored = space.with_rounding(chain, qs)[0], _factored(robot, chain, space)
    return [
        singularity_steps(
            SingularityQuestion(
                space.task.directions,
                J,
                report.rank,
                report.structural_rank,
                report.lost_directions,
                report.internal_motions,
                report.kinds,
                space.characteristic_length if space.turns else None,
            ),
            factored,
        )
        for J, report in zip(Js, reports, strict=True)
    ]


def _factored(robot: RobotModel, chain: Chain, space: TaskSpace) -> list[Step]:
    """Return the determinant of a table's square block, if it is what the rows of the task lose their rank by.

    That is so where its size is the product of the singular values at random configurations.
    """
    if not 0 < len(chain) <= 6:
        return []
    trials = random_configurations(chain, _TRIALS)
    table = standard_table(robot.description, chain)
    if table is None or any(row.mimic is not None for row in table.joints):
        return []
    found = worked_solution(table, list(map(tuple, trials.tolist())), run=in_time, deadline=time.monotonic() + _SECONDS)
    plain = TaskSpace(space.task, None, space.reference)
    products = np.prod(np.linalg.svd(plain.jacobians(chain, trials), compute_uv=False), axis=1)
    sizes = np.abs(np.array(found.determinants, dtype=float))
    if not np.allclose(products, sizes, rtol=_SAME, atol=_SAME * sizes.max(initial=0.0)):
        return []
    return _with_lengths(found)


def _with_lengths(found: WorkedSolution) -> list[Step]:
    """Return the steps of a determinant, and what the symbols of its lengths are."""
    steps, singular = determinant_steps(found.singularities), found.singularities
    if not steps or singular is None or singular.formula is None or found.formulas is None:
        return []
    names = set(re.findall(r"\w+", singular.formula.plain))
    legend = {entry.latex: entry for entry in (*found.formulas.legend, *singular.legend)}
    values = [
        f"{entry.latex} = {number(entry.value)}"
        for entry in legend.values()
        if entry.value is not None and entry.plain in names
    ]
    first = steps[0]
    lines = (*first.latex, r",\quad ".join(values)) if values else first.latex
    return [step(first.title, first.text, *lines), *steps[1:]]
