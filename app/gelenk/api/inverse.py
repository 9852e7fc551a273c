"""Inverse kinematics of a robot."""

from collections import Counter
from typing import Any

from gelenk.api.inverse_answer import closed_form_of, table, told, told_results, unsolved_headers
from gelenk.api.inverse_job import inverse_work
from gelenk.api.inverse_request import Bounds, asked, options_of, task_of
from gelenk.api.lesson import Lesson
from gelenk.api.routes import Computation, Operation, Outcome
from gelenk.api.tally import Tally
from gelenk.contract.ik import MAX_STEPWISE, MAX_TARGETS, InverseAnswer, InverseOptions, InverseRequest
from gelenk.kinematics.ik.closed_form import ClosedForm, closed_form, is_looked_at, look_at
from gelenk.kinematics.ik.result import InverseKinematics
from gelenk.kinematics.ik.search import ITERATIONS_PER_START, MAX_ITERATIONS
from gelenk.kinematics.ik.solve import inverse_kinematics, solve_quickly
from gelenk.kinematics.ik.verdict import Question
from gelenk.model.arrays import Array
from gelenk.model.chain import Chain
from gelenk.model.compilation import is_awaited
from gelenk.store.records import LoadedRobot

_QUICK_STARTS = 64
"""Starts of seven joints that take the event loop about 0.1 ms; a target that needs more goes to a thread."""
_QUICK_TARGETS = 8
_SHARE_OF_TIME = 0.8
"""Of the time that a request may take, what a search with a time limit may: what is found is to be sent too."""


def inverse_operation(max_answer_numbers: int, seconds: float, job_bytes: int) -> Operation:
    """The operation `ik`, none of whose answers holds more numbers or takes longer than given, [s].

    `job_bytes` is what the parts of a job may take.
    """
    longest = _SHARE_OF_TIME * seconds
    bounds = Bounds(MAX_TARGETS, MAX_STEPWISE, max_answer_numbers)

    def ik(loaded: LoadedRobot, call: InverseRequest) -> Outcome:
        """Configurations that bring the tip to each target, within the joint limits.

        `auto` takes the closed form where the geometry of the chain has one (`analytic` takes nothing else): of all
        branches within the limits the one that is nearest to the seed. Where there is none it searches from the seed
        and from a thousand random configurations, and takes the first start that reaches the target; from a seed near
        the target it stays on the seed's branch. Every solution is recomputed through Pinocchio before it is sent, and
        its errors are those of that computation. An unsolved target comes with the reason and the nearest configuration
        found. The same call gives the same answer, unless it has a `time_limit`.

        Closed forms: arms whose last three axes meet in a point, or whose first three do (any three joints besides,
        turning or sliding); six joints with three parallel axes; positioning arms of two and three joints, with or
        without turns at their end (planar, SCARA, Cartesian, cylindrical, spherical, anthropomorphic); spherical
        wrists; seven joints with a spherical shoulder and wrist, by the angle of the elbow. Of six joints of any other
        geometry `analytic`, and `auto` where all solutions are wanted, eliminates all joints but one, or follows all
        solutions of another target to this one (continuation).
        """
        chain, targets, seeds = asked(loaded.robot, call, bounds)
        options = options_of(chain, call, None if call.time_limit is None else min(call.time_limit, longest))
        return _outcome(chain, call, inverse_kinematics(loaded.robot, chain, targets, seeds, options))

    def attempt(loaded: LoadedRobot, call: InverseRequest) -> Outcome | None:
        """The same with a few starts; None where they do not suffice."""
        chain, targets, seeds = asked(loaded.robot, call, bounds)
        tolerances = call.position_tolerance, call.orientation_tolerance
        question = Question(loaded.robot, chain, targets, seeds, task_of(call), tolerances, call.respect_limits)
        budget = max(1, (call.max_iterations or MAX_ITERATIONS) // ITERATIONS_PER_START)
        starts = min(budget, max(1, _QUICK_STARTS * 7 // max(7, len(chain))))
        result = solve_quickly(question, starts, call.random_seed, by_form=call.method == "analytic")
        return None if result is None else _outcome(chain, call, result)

    return Operation(
        name="ik",
        operation_id="inverse_kinematics",
        summary="Inverse kinematics",
        computation=Computation(
            run=ik,
            request=InverseRequest,
            options=InverseOptions,
            array_field="targets",
            is_heavy=_is_heavy,
            attempt=attempt,
            lesson=Lesson(_is_looked_at, _closed_form, _look_at),
            long=inverse_work(job_bytes),
        ),
        answer=InverseAnswer,
        npy_body="`targets` as an array of shape (N, 7), position and quaternion x y z w, or (N, 4, 4), matrices.",
        npy_answer="One configuration per target as an array of shape (N, n): the solution, or the nearest "
        "configuration found; the header `Gelenk-Unsolved` counts the targets without a solution and "
        "`Gelenk-Unsolved-Rows` gives the first 200 of them.",
        example={
            "targets": [{"position": [0.4, 0.1, 0.5], "rpy": [3.141592653589793, 0.0, 0.0]}],
            "tip_frame": "panda_link8",
        },
    )


def _chain(loaded: LoadedRobot, call: InverseRequest) -> Chain:
    return loaded.robot.chain(call.base_frame, call.tip_frame)


def _is_looked_at(loaded: LoadedRobot, call: InverseRequest) -> bool:
    return is_looked_at(_chain(loaded, call), task_of(call))


def _closed_form(loaded: LoadedRobot, call: InverseRequest) -> ClosedForm | None:
    return closed_form(_chain(loaded, call), task_of(call))


def _look_at(loaded: LoadedRobot, call: InverseRequest, found: ClosedForm | None) -> None:
    look_at(_chain(loaded, call), task_of(call), found)


def _is_heavy(call: InverseRequest) -> bool:
    one_by_search = (
        call.method in {"auto", "analytic"}
        and call.elbow_angle is None
        and call.fixed_joints is None
        and call.solutions == "one"
        and not call.trace
        and call.objective is None
    )
    return is_awaited() or not one_by_search or len(call.targets) > _QUICK_TARGETS


def _outcome(chain: Chain, call: InverseRequest, result: InverseKinematics) -> Outcome:
    fits = call.solutions == "one" and not call.trace

    def content() -> dict[str, Any]:
        return told(chain, call, closed_form_of(result), told_results(chain, call.pose_format, result))

    def array() -> tuple[Array, dict[str, str]]:
        return table(chain, result), unsolved_headers(list(result.failures))

    return Outcome(
        content,
        array if fits else None,
        solved=lambda targets: Tally(targets, Counter(result.statuses), len(result.qs), int(result.iterations.sum())),
    )
