"""Inverse kinematics of a robot."""

from collections import Counter
from functools import lru_cache
from typing import Any

import numpy as np

from app.api.routes import Computation, Operation, Outcome
from app.api.tally import Tally
from app.kinematics.configuration import configurations, one_configuration
from app.kinematics.ik.descent import Rule
from app.kinematics.ik.null_space import Objective
from app.kinematics.ik.result import Failure, InverseKinematics, Path, SolutionBranches
from app.kinematics.ik.search import ITERATIONS_PER_START, MAX_ITERATIONS, mid_range
from app.kinematics.ik.solve import Options, inverse_kinematics, solve_quickly
from app.kinematics.ik.task import DIRECTIONS, FULL_POSE, Direction, Task
from app.kinematics.ik.verdict import Question
from app.kinematics.kernels import chain_poses
from app.model.arrays import Array
from app.model.chain import Chain
from app.model.errors import InvalidField, TooLarge
from app.model.poses import Poses
from app.schemas.ik import MAX_STEPWISE, MAX_TARGETS, InverseAnswer, InverseOptions, InverseRequest
from app.schemas.pose import PoseFormat, pose_list, poses_from
from app.store.records import LoadedRobot

_QUICK_STARTS = 64
"""Starts of seven joints that take the event loop about 0.1 ms; a target that needs more goes to a thread."""
_QUICK_TARGETS = 8
_SHARE_OF_TIME = 0.8
"""Of the time that a request may take, what a search may: what is found is to be recomputed and sent."""
_ROWS_NAMED = 200
"""Unsolved rows that a header names: proxies allow headers of a few kilobytes."""


def inverse_operation(max_answer_numbers: int, seconds: float) -> Operation:
    """The operation `ik`, none of whose answers holds more numbers or takes longer than given, [s]."""
    longest = _SHARE_OF_TIME * seconds

    def ik(loaded: LoadedRobot, call: InverseRequest) -> Outcome:
        """Configurations that bring the tip to each target, within the joint limits.

        `auto` takes the closed form where the geometry of the chain has one (`analytic` takes nothing else): of all
        branches within the limits the one that is nearest to the seed. Where there is none it searches from the seed
        and from a thousand random configurations, and takes the first start that reaches the target; from a seed that
        is near the target it stays on the seed's branch. Every solution is recomputed through Pinocchio before it is
        sent, and its errors are those of that computation. A target that is not solved is told why, with the nearest
        configuration that was found. The same call gives the same answer, unless time runs out.

        Closed forms: arms whose last three axes meet in a point, or whose first three do (any three joints besides,
        turning or sliding); six joints with three parallel axes; positioning arms of two and three joints, with or
        without turns at their end (planar, SCARA, Cartesian, cylindrical, spherical, anthropomorphic); spherical
        wrists; seven joints with a spherical shoulder and wrist, by the angle of the elbow. Of six turning joints of
        most other geometries `analytic`, and `auto` where all solutions are wanted, eliminates all joints but one.
        """
        chain, targets, seeds = _asked(loaded, call)
        _check_size(call, len(targets), len(chain), max_answer_numbers)
        options = _options(call, _objective(chain, call), longest)
        return _outcome(chain, call, inverse_kinematics(loaded.robot, chain, targets, seeds, options))

    def attempt(loaded: LoadedRobot, call: InverseRequest) -> Outcome | None:
        """The same with a few starts; None where they do not suffice."""
        chain, targets, seeds = _asked(loaded, call)
        tolerances = call.position_tolerance, call.orientation_tolerance
        question = Question(loaded.robot, chain, targets, seeds, _task(call), tolerances, call.respect_limits)
        _check_size(call, len(targets), len(chain), max_answer_numbers)
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
        ),
        answer=InverseAnswer,
        npy_body="`targets` as an array of shape (N, 7), position and quaternion x y z w, or (N, 4, 4), matrices; "
        "the other fields go in the query string.",
        npy_answer="One configuration a target as an array of shape (N, n): the solution, or what comes nearest; the "
        "header `Gelenk-Unsolved` counts the targets without a solution and `Gelenk-Unsolved-Rows` names the first "
        "two hundred of them.",
        example={
            "targets": [{"position": [0.4, 0.1, 0.5], "rpy": [3.141592653589793, 0.0, 0.0]}],
            "tip_frame": "panda_link8",
        },
    )


def _check_options(call: InverseRequest) -> None:
    """Refuse what does not go together.

    Raises:
        InvalidField: The field, and what it goes with.
    """
    if call.task is not None and len(set(call.task)) < len(call.task):
        raise InvalidField("task", "each direction at most once")
    if call.solutions == "all" and call.method not in {"auto", "analytic"}:
        raise InvalidField("solutions", "`all` goes with the methods `auto` and `analytic` only")
    if call.method == "analytic" and call.trace:
        raise InvalidField("trace", "a closed form has no iterations to tell of")
    if call.elbow_angle is not None and call.method != "analytic":
        raise InvalidField("elbow_angle", "it goes with the method `analytic` only")
    if call.solutions == "all" and (call.trace or call.objective is not None):
        raise InvalidField("solutions", "`all` goes without `trace` and `objective`")
    if call.windings and (call.solutions != "all" or not call.respect_limits):
        raise InvalidField("windings", "they go with `solutions: all` within the limits, without which there is no end")
    if call.posture is not None and call.objective != "posture":
        raise InvalidField("posture", "it goes with the objective `posture` only")
    if call.step_size is not None and call.method not in {"gradient", "gradient_then_newton"}:
        raise InvalidField("step_size", "it goes with the methods `gradient` and `gradient_then_newton` only")
    if call.damping is not None and call.method != "damped_least_squares":
        raise InvalidField("damping", "it goes with the method `damped_least_squares` only")
    if call.objective is not None and call.method != "auto":
        raise InvalidField("objective", "it goes with the method `auto` only")


def _is_heavy(call: InverseRequest) -> bool:
    one_by_search = (
        call.method in {"auto", "analytic"}
        and call.elbow_angle is None
        and call.solutions == "one"
        and not call.trace
        and call.objective is None
    )
    return not one_by_search or len(call.targets) > _QUICK_TARGETS


def _asked(loaded: LoadedRobot, call: InverseRequest) -> tuple[Chain, Poses, Array]:
    _check_options(call)
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    targets = poses_from(call.targets, "targets")
    if len(targets) > MAX_TARGETS:
        raise TooLarge("targets", len(targets), MAX_TARGETS)
    return chain, targets, _seeds(chain, call, len(targets))


def _seeds(chain: Chain, call: InverseRequest, count: int) -> Array:
    if call.seeds is None and call.posture is not None:
        # Whoever wants to be near a posture starts there.
        return one_configuration(chain, call.posture, "posture")
    if call.seeds is None:
        return mid_range(chain)[None]
    seeds = configurations(chain, call.seeds, "seeds")
    if len(seeds) not in {1, count}:
        raise InvalidField("seeds", f"{len(seeds)} entries for {count} targets: one for all of them or one each")
    return seeds


def _options(call: InverseRequest, objective: Objective | None, longest: float) -> Options:
    match call.method:
        case "auto" | "analytic":
            rule = None
        case step_method:
            rule = Rule(step_method, call.step_size, call.damping, call.switch_error)
    return Options(
        task=_task(call),
        position_tolerance=call.position_tolerance,
        orientation_tolerance=call.orientation_tolerance,
        respect_limits=call.respect_limits,
        every=call.solutions == "all",
        most=call.max_solutions,
        windings=call.windings,
        method=call.method,
        rule=rule,
        max_iterations=call.max_iterations,
        time_limit=min(call.time_limit, longest),
        random_seed=call.random_seed,
        objective=objective,
        elbow_angle=call.elbow_angle,
        trace=call.trace,
    )


def _task(call: InverseRequest) -> Task:
    return FULL_POSE if call.task is None else _task_of(frozenset(call.task))


@lru_cache(maxsize=64)
def _task_of(directions: frozenset[Direction]) -> Task:
    if len(directions) == len(DIRECTIONS):
        return FULL_POSE
    return Task(tuple(direction for direction in DIRECTIONS if direction in directions))


def _objective(chain: Chain, call: InverseRequest) -> Objective | None:
    if call.objective is None:
        return None
    if call.posture is None:
        return Objective(call.objective)
    return Objective(call.objective, one_configuration(chain, call.posture, "posture"))


def _check_size(call: InverseRequest, targets: int, joints: int, allowed: int) -> None:
    if (call.method not in {"auto", "analytic"} or call.trace) and targets > MAX_STEPWISE:
        raise TooLarge("targets of a method that is followed step by step", targets, MAX_STEPWISE)
    numbers = targets * (joints + 4) * (call.max_solutions if call.solutions == "all" else 1)
    if numbers > allowed:
        raise TooLarge("numbers in the answer", numbers, allowed)


def _outcome(chain: Chain, call: InverseRequest, result: InverseKinematics) -> Outcome:
    fits = call.solutions == "one" and not call.trace
    return Outcome(
        lambda: _content(chain, call, result),
        (lambda: _table(chain, result)) if fits else None,
        solved=lambda targets: Tally(targets, Counter(result.statuses), len(result.qs), int(result.iterations.sum())),
    )


def _table(chain: Chain, result: InverseKinematics) -> tuple[Array, dict[str, str]]:
    """One configuration a target, shape (N, n), and the headers that tell which are no solutions."""
    table = np.empty((len(result), len(chain)))
    solved = np.diff(result.firsts) > 0
    table[solved] = result.qs
    for i, failure in result.failures.items():
        table[i] = failure.nearest
    rows = ",".join(str(i) for i in list(result.failures)[:_ROWS_NAMED])
    return table, {"Gelenk-Unsolved": str(len(result.failures)), "Gelenk-Unsolved-Rows": rows}


def _content(chain: Chain, call: InverseRequest, result: InverseKinematics) -> dict[str, Any]:
    return {
        "joint_names": chain.joint_names,
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "task": _task(call).directions,
        "closed_form": None if result.branches is None else result.branches.form.name,
        "results": _results(chain, call.pose_format, result),
    }


def _results(chain: Chain, pose_format: PoseFormat, result: InverseKinematics) -> list[dict[str, Any]]:
    solutions = [
        {
            "joint_positions": q,
            "position_error": position_error,
            "orientation_error": orientation_error,
            "method": result.method,
            "iterations": iterations,
            "restarts": restarts,
            "branch": None,
        }
        for q, position_error, orientation_error, iterations, restarts in zip(
            result.qs.tolist(),
            result.position_errors.tolist(),
            result.orientation_errors.tolist(),
            result.iterations.tolist(),
            result.restarts.tolist(),
            strict=True,
        )
    ]
    if result.branches is not None:
        _name_branches(solutions, result.branches, result.qs)
    firsts = result.firsts.tolist()
    entries: list[dict[str, Any]] = [
        {"status": status, "solutions": solutions[firsts[i] : firsts[i + 1]], "reason": None}
        for i, status in enumerate(result.statuses)
    ]
    for i, failure in result.failures.items():
        entries[i].update(_failure(chain, pose_format, failure))
    if result.complete is not None:
        for entry, complete in zip(entries, result.complete, strict=True):
            entry["complete"] = complete
    if result.paths is not None:
        for entry, path in zip(entries, result.paths, strict=True):
            entry.update(_path(path))
    return entries


def _name_branches(solutions: list[dict[str, Any]], branches: SolutionBranches, qs: Array) -> None:
    """Say of each solution of a closed form which branch it is, and what a singularity leaves free."""
    form = branches.form
    for solution, code, free in zip(solutions, branches.codes.tolist(), branches.free.tolist(), strict=True):
        if code >= 0:
            solution["method"], solution["branch"] = form.method, form.branch(code)
            if free:
                solution["free_joints"] = form.free_joints(free)
    if form.has_free_elbow:
        for solution, angle in zip(solutions, form.elbow_angles(qs).tolist(), strict=True):
            solution["elbow_angle"] = angle


def _failure(chain: Chain, pose_format: PoseFormat, failure: Failure) -> dict[str, Any]:
    nearest = Poses(*chain_poses(chain.flat, failure.nearest[None]))
    entry: dict[str, Any] = {
        "reason": failure.reason,
        "nearest": {
            "joint_positions": failure.nearest.tolist(),
            "pose": pose_list(nearest, pose_format)[0],
            "position_error": failure.position_error,
            "orientation_error": failure.orientation_error,
        },
    }
    if failure.blocking_joints:
        entry["blocking_joints"] = failure.blocking_joints
    if failure.unserved_directions is not None:
        entry["unserved_directions"] = failure.unserved_directions.tolist()
    return entry


def _path(path: Path) -> dict[str, Any]:
    entry: dict[str, Any] = {"stop_reason": path.stop_reason}
    if path.trace is not None:
        entry["trace"] = [
            {
                "error": iterate.error,
                "min_singular_value": iterate.min_singular_value,
                "step_length": iterate.step_length,
                "method": iterate.method,
                "joint_positions": iterate.joint_positions.tolist(),
            }
            for iterate in path.trace
        ]
    return entry
