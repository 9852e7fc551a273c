"""The worked solution of a trace of inverse kinematics: residual, Jacobian and step of its configurations."""

import numpy as np

from gelenk.course.steps import Step
from gelenk.course.velocity.iteration_steps import IterationTurn, iteration_steps
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import IterationPath

_LISTED = 40
"""Configurations of a trace in its table, besides the last one."""


def worked_trace(problem: TargetProblem, i: int, path: IterationPath, *, given_step_size: bool) -> list[Step]:
    """Return the steps of a trace to target i, of its free joints; none if no trace was requested."""
    trace = path.trace or []
    numbers = [*range(min(len(trace), _LISTED)), *([len(trace) - 1] if len(trace) > _LISTED else [])]
    if not numbers:
        return []
    free = [j for j, name in enumerate(problem.chain.joint_names) if name not in problem.options.fixed_joints]
    qs = np.array([at.joint_positions for at in trace])
    es, Js = problem.linearised(i, np.ascontiguousarray(qs[numbers]))
    turns = []
    for k, e, J in zip(numbers, es, Js, strict=True):
        delta = qs[k + 1, free] - qs[k, free] if trace[k].method is not None else None
        turns.append(IterationTurn(k, qs[k, free], e, J[:, free], delta, trace[k].method))
    return iteration_steps(turns, len(trace), given_step_size=given_step_size)
