"""The worked solutions of an inverse kinematics answer."""

from gelenk.contract.ik import InverseRequest
from gelenk.course.inverse.solver import solver_step
from gelenk.course.steps import Step
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.language import language


def worked(problem: TargetProblem, call: InverseRequest, result: InverseKinematics) -> list[list[Step]]:
    """Return the worked solution of each target, in the language of the request."""
    methods: set[str] = set() if call.method == "auto" else {call.method}
    with language(call.language):
        return [[solver_step(result.closed_form, methods)] for _ in range(len(problem))]
