"""Inverse kinematics of a robot: solutions recomputed with Pinocchio, or a verdict on why there are none."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Literal, TypeAlias, cast

import numpy as np

from gelenk.errors import InvalidField
from gelenk.ik import analytic
from gelenk.ik.closed.closed_form import ClosedForm, closed_form, elimination, is_looked_at
from gelenk.ik.count.continuation import Continuation, continuation, counted
from gelenk.ik.count.families import families_of
from gelenk.ik.search import kernels
from gelenk.ik.search.descent import Descent, DescentRule, StepMethod, descend
from gelenk.ik.search.null_space import Objective, settle
from gelenk.ik.search.retrace import retrace
from gelenk.ik.search.search import (
    ITERATIONS_PER_START,
    MAX_ITERATIONS,
    Found,
    is_over,
    make_goal,
    nothing_found,
    search,
    search_bounds,
    start_of,
    target_rows,
)
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import Status
from gelenk.ik.verdict.branches import SEARCHED, TRUNCATED, Branches, all_branches, wound
from gelenk.ik.verdict.fixed import held_chain, narrowed, widened_answer
from gelenk.ik.verdict.judge import judged
from gelenk.ik.verdict.nearest import polished
from gelenk.ik.verdict.result import COUNTED, InverseKinematics, IterationPath, SolutionBranches, UnsolvedTarget
from gelenk.ik.verdict.verdict import (
    ENOUGH_STARTS,
    TargetProblem,
    beyond_limits,
    explain,
    refused,
    solved_without_limits,
    verdict_on_path,
)
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import clock, is_awaited, wait_for_others
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

Method: TypeAlias = Literal["auto", "analytic"] | StepMethod

_FAR_ITERATIONS = 320
"""Budget for a target out of reach by distance, for which only the nearest configuration is needed."""
_LOOSE, _SLACK = 1e-4, 0.9
"""Tolerance above which an unsolved target is tried again, and the share of the tolerances used then as slack."""
_SETTLED_TOGETHER = 4096
"""Solutions moved along their self-motion at once: each needs its own Hessian."""
_INTERPRETED_TARGETS, _INTERPRETED_STARTS = 8, 30
"""Most targets of a call, and starts of each, solved by interpreted code while the kernels are being compiled."""


@dataclass(frozen=True, slots=True)
class Options:
    """Options of an inverse kinematics call.

    Attributes:
        task: Which directions of the pose count.
        position_tolerance: Largest position error, [m].
        orientation_tolerance: Largest orientation error, [rad].
        respect_limits: Whether solutions must be within the joint limits.
        every: Whether to find all solutions.
        most: Largest number of solutions of one target.
        windings: Whether solutions that differ by full turns count as different.
        method: `auto`; `analytic`, a closed form, an elimination or a continuation; or one of the course's methods,
            which start from the seed alone.
        rule: Parameters of the course's method.
        max_iterations: Budget for a target; None for the method's default.
        time_limit: Time for all targets without compilation, [s].
        random_seed: Seed of the random starts.
        objective: Function that a redundant arm minimises by its freedom.
        elbow_angle: Desired angle of a free elbow, [rad]; only for a closed form that has one.
        trace: Whether to report each iteration.
        fixed_joints: Values of the held variables by name, [rad or m].
    """

    task: Task = FULL_POSE
    position_tolerance: float = 1e-6
    orientation_tolerance: float = 1e-6
    respect_limits: bool = True
    every: bool = False
    most: int = 100
    windings: bool = False
    method: Method = "auto"
    rule: DescentRule | None = None
    max_iterations: int | None = None
    time_limit: float | None = None
    random_seed: int = 0
    objective: Objective | None = None
    elbow_angle: float | None = None
    trace: bool = False
    fixed_joints: Mapping[str, float] = field(default_factory=dict)

    @property
    def tolerances(self) -> tuple[float, float]:
        """Tolerances of position [m] and orientation [rad], as a pair."""
        return self.position_tolerance, self.orientation_tolerance


def inverse_kinematics(
    robot: RobotModel, chain: Chain, targets: Poses, seeds: Array, options: Options
) -> InverseKinematics:
    """Solve for the configurations that bring the tip to each target.

    Args:
        robot: The robot.
        chain: Base and tip.
        targets: Desired T_base_tip; N of them.
        seeds: Initial configurations, to which solutions shall be near; one for all or one each, shape (1 or N, n).
        options: Task, method and bounds.

    Raises:
        InvalidField: An option needs a closed form that the chain does not have.
    """
    chain = held_chain(chain, options.fixed_joints)
    seeds = narrowed(chain, seeds)
    objective = options.objective
    if objective is not None and objective.posture is not None:
        posture = narrowed(chain, np.atleast_2d(objective.posture))
        options = replace(options, objective=replace(objective, posture=posture))
    deadline = None if options.time_limit is None else clock() + options.time_limit
    question = TargetProblem(robot, chain, targets, seeds, options.task, options.tolerances, options.respect_limits)
    return widened_answer(chain, _with_families(question, options, _answered(question, options, deadline), deadline))


def _answered(question: TargetProblem, options: Options, deadline: float | None) -> InverseKinematics:
    if options.method in {"auto", "analytic"} and is_awaited():
        found = _interpreted(question, options, deadline)
        if found is not None:
            return found
        wait_for_others()
    form = _form(question, options)
    if form is not None:
        return _analytic(question, options, form, deadline)
    if options.method in {"auto", "analytic"}:
        return _without_form(question, options, deadline)
    return _by_method(question, options, cast(StepMethod, options.method), deadline)


def _without_form(question: TargetProblem, options: Options, deadline: float | None) -> InverseKinematics:
    """Solve by continuation if it is available and all solutions or `analytic` are requested, else by search."""
    if options.every:
        return _every(question, options, deadline)
    if options.method == "analytic" and _system(question):
        return analytic.first_of_each(_every(question, options, deadline))
    return _one(question, options, deadline)


def _system(question: TargetProblem) -> Continuation | None:
    """Return the continuation that counts all solutions; None if the chain or the task has none."""
    return continuation(question.chain) if len(question.task) == len(FULL_POSE) else None


def _with_families(
    question: TargetProblem, options: Options, answer: InverseKinematics, deadline: float | None
) -> InverseKinematics:
    """Add the families to which the solutions belong, for targets whose solutions may not be all."""
    doubts, families = dict(answer.doubts), {}
    for i in answer.doubts:
        qs = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        found = families_of(question, i, qs, options.most, deadline) if len(qs) else ()
        if found:
            families[i] = found
            texts = "; ".join(family.text for family in found)
            doubts[i] = f"infinitely many solutions, of which these are a sample: {texts}"
    return replace(answer, doubts=doubts, families=families) if families else answer


def _form(question: TargetProblem, options: Options) -> ClosedForm | None:
    """Return the closed form that answers the question; None if an option needs another method."""
    if options.method not in {"auto", "analytic"}:
        return None
    form = closed_form(question.chain, options.task)
    if form is None and len(options.task) == len(FULL_POSE) and (options.every or options.method == "analytic"):
        form = elimination(question.chain)
    if options.method == "analytic" and form is None and _system(question) is None:
        raise InvalidField("method", "no closed form is known for this chain and task; `auto` solves it")
    if options.elbow_angle is not None and (form is None or not form.has_free_elbow):
        raise InvalidField("elbow_angle", "only for arms of seven joints with a spherical shoulder and wrist")
    return None if options.trace or options.objective is not None else form


def _analytic(question: TargetProblem, options: Options, form: ClosedForm, deadline: float | None) -> InverseKinematics:
    """Solve by the closed form, then by `_without_form` for the rest, which also explains unsolved targets."""
    if options.every:
        most, angle = options.most, options.elbow_angle
        sample = options.method == "auto"
        found = analytic.every(question, form, most, options.windings, angle, deadline, sample=sample)
    else:
        found = analytic.nearest(question, form, options.elbow_angle, deadline)
    left = np.flatnonzero(np.diff(found.firsts) == 0)
    if len(left) == 0:
        return found
    rest = _without_form(question.taken(left), options, deadline)
    if options.method == "analytic" and _system(question) is None:
        rest = analytic.unmet(rest, options.elbow_angle)
    return analytic.joined(found, left, rest)


def solve_quickly(
    question: TargetProblem, starts: int, random_seed: int, *, by_form: bool = False
) -> InverseKinematics | None:
    """Return one solution per target if that takes only tens of microseconds, else None.

    Args:
        question: The problem, with a few targets.
        starts: Starts of each target.
        random_seed: Seed of the random starts.
        by_form: Whether to accept solutions of a closed form alone.
    """
    chain = question.chain
    if not is_looked_at(chain, question.task):
        return None
    form = closed_form(chain, question.task)
    if form is not None:
        found = analytic.nearest(question, form, None, None)
        return found if len(found.qs) == len(question) else None
    if by_form:
        return None
    goal = make_goal(
        chain,
        question.task,
        *question.tolerances,
        question.respect_limits,
        starts * ITERATIONS_PER_START,
        random_seed,
    )
    rows = target_rows(question.targets)
    qs, winners, iterations, _ = kernels.search(chain.flat, goal, rows, question.seeds, all_or_none=True)
    # For a few numbers, lists are faster than arrays.
    if -1 in winners.tolist():
        return None
    solved, position_errors, orientation_errors = judged(question, qs, np.ones(len(qs), dtype=np.bool_))
    if False in solved.tolist():
        return None
    count = len(qs)
    return InverseKinematics(
        qs,
        position_errors,
        orientation_errors,
        iterations,
        winners,
        "damped_least_squares",
        np.arange(count + 1),
        ["solved"] * count,
    )


def _one(question: TargetProblem, options: Options, deadline: float | None) -> InverseKinematics:
    """Find one solution per target from many starts."""
    found, too_far, relaxed = _searched(question, options, deadline)
    if options.objective is not None and found.solved.any():
        found = _settled(question, options.objective, found, deadline)
    is_unsettled = options.objective is not None and is_over(deadline)
    solved, *errors = judged(question, found.qs, found.solved, found.in_time)
    paths = None
    if options.trace:
        paths = [_retraced(question, options, found, i) for i in range(len(solved))]
    if is_unsettled:
        paths = [
            replace(path, stop_reason="time_limit")
            for path in paths or [IterationPath("time_limit", None)] * len(solved)
        ]
    statuses: list[Status] = ["solved"] * len(solved)
    failures: dict[int, UnsolvedTarget] = {}
    for i in np.flatnonzero(~solved).tolist():
        tried, late = bool(found.in_time[i]), is_over(deadline)
        statuses[i], failure = explain(
            question,
            i,
            found.qs[i],
            (float(errors[0][i]), float(errors[1][i])),
            too_far=bool(too_far[i]),
            beyond_limits=relaxed.get(i),
            budget=options.max_iterations or MAX_ITERATIONS,
            tried=tried,
            late=late,
        )
        failures[i] = replace(failure, is_late=late or not tried)
    return _assembled(
        "damped_least_squares", found.qs, solved, errors, found.iterations, found.restarts, statuses, failures, paths
    )


def _assembled(
    method: str,
    qs: Array,
    solved: Flags,
    errors: Sequence[Array],
    iterations: Indices,
    restarts: Indices,
    statuses: list[Status],
    failures: dict[int, UnsolvedTarget],
    paths: list[IterationPath] | None,
) -> InverseKinematics:
    """Build the answer from one configuration per target, dropping those that are no solutions."""
    return InverseKinematics(
        qs[solved],
        errors[0][solved],
        errors[1][solved],
        iterations[solved],
        restarts[solved],
        method,
        np.concatenate(([0], np.cumsum(solved))),
        statuses,
        failures,
        paths=paths,
    )


def _searched(
    question: TargetProblem, options: Options, deadline: float | None
) -> tuple[Found, Flags, dict[int, Array]]:
    """Search for one solution per target.

    Returns:
        The results; flags of the targets beyond reach by distance alone, shape (N,); and, by the index of an unsolved
        target, the configuration found that solves it with the least excess over the joint limits.
    """
    budget = options.max_iterations or MAX_ITERATIONS

    def run(targets: Poses, seeds: Array, most: int, slack: float = 0.0) -> Found:
        return search(
            question.chain,
            targets,
            seeds,
            task=options.task,
            position_tolerance=options.position_tolerance,
            orientation_tolerance=options.orientation_tolerance,
            respect_limits=options.respect_limits,
            max_iterations=most,
            random_seed=options.random_seed,
            slack=slack,
            deadline=deadline,
        )

    too_far = question.too_far()
    if too_far.any():
        found = nothing_found(len(question), len(question.chain))
        found.put(~too_far, run(*question.part(~too_far), budget))
        found.put(too_far, run(*question.part(too_far), min(budget, _FAR_ITERATIONS)))
    else:
        found = run(question.targets, question.seeds, budget)
    left = ~found.solved & ~too_far
    if max(options.tolerances) > _LOOSE and left.any():
        found.put(left, run(*question.part(left), budget, _SLACK))
    unsolved = np.flatnonzero(~found.solved & found.in_time)
    for i in unsolved.tolist():
        if not is_over(deadline):
            found.qs[i] = polished(question, i, found.qs[i])
    # The nearest configuration may be near enough.
    near_enough = judged(question.taken(unsolved), found.qs[unsolved], np.ones(len(unsolved), dtype=bool))[0]
    found.solved[unsolved[near_enough]], found.iterations[unsolved[near_enough]] = True, 0
    relaxed: dict[int, Array] = {}
    # If only a few starts have failed, there may well be a solution within the limits.
    with_limits = question.respect_limits and budget >= ENOUGH_STARTS * ITERATIONS_PER_START
    for i in np.flatnonzero(~found.solved & ~too_far & found.in_time & with_limits).tolist():
        if is_over(deadline):
            break
        q = solved_without_limits(question, i, options.random_seed)
        if q is not None and beyond_limits(question.chain, q):
            relaxed[i] = q
        elif q is not None:
            # Starts that ignore the limits have reached a solution within them.
            found.qs[i], found.solved[i], found.iterations[i] = q, True, 0
    return found, too_far, relaxed


def _settled(question: TargetProblem, objective: Objective, found: Found, deadline: float | None) -> Found:
    """Move the solutions along their self-motion to reduce the objective; non-redundant ones stay."""
    if objective.name == "posture" and objective.posture is None:
        objective = Objective("posture", question.seeds)
    qs = found.qs.copy()
    for first in range(0, len(qs), _SETTLED_TOGETHER):
        rows = np.arange(first, min(first + _SETTLED_TOGETHER, len(qs)))
        rows = rows[found.solved[rows]]
        own = objective
        if objective.posture is not None and objective.posture.ndim == 2 and len(objective.posture) > 1:
            own = replace(objective, posture=objective.posture[rows])
        qs[rows] = settle(
            question.chain,
            question.part(rows)[0],
            qs[rows],
            own,
            task=question.task,
            respect_limits=question.respect_limits,
            deadline=deadline,
        )
    return replace(found, qs=qs)


def _every(question: TargetProblem, options: Options, deadline: float | None) -> InverseKinematics:
    """Find all solutions of each target; targets without any are searched again by `_one`, which explains failures."""
    rows, count = target_rows(question.targets), len(question)
    tables, doubts = [np.empty((0, len(question.chain)))] * count, [SEARCHED] * count
    codes, system = np.full(count, -1), _system(question)
    alone = options.method == "analytic" and system is not None

    def searched(i: int, windings: bool) -> Branches:
        return all_branches(
            question.chain,
            rows[i],
            question.seed(i),
            task=options.task,
            tolerances=options.tolerances,
            respect_limits=options.respect_limits,
            random_seed=options.random_seed,
            most=options.most,
            windings=windings,
        )

    for i in range(count):
        if is_over(deadline):
            break
        if system is None:
            found = searched(i, options.windings)
            tables[i], doubts[i] = found.qs, found.doubt
            continue
        found = counted(question, i, system, None if alone else partial(searched, i, False))
        tables[i], doubts[i] = found.qs, found.doubt
        if alone or not doubts[i]:
            codes[i] = COUNTED
        if options.windings and len(tables[i]):
            tables[i], _, whole = wound(
                question.chain, tables[i], question.seed(i), options.most, True, options.respect_limits
            )
            doubts[i] = doubts[i] or ("" if whole else TRUNCATED)
        elif len(tables[i]) > options.most:
            tables[i], doubts[i] = tables[i][: options.most], doubts[i] or TRUNCATED
    statuses: list[Status] = ["solved"] * count
    failures: dict[int, UnsolvedTarget] = {}
    missing = np.array([i for i in range(count) if len(tables[i]) == 0], dtype=np.int64)
    # The search for one solution tries harder, and explains failures.
    single = _one(question.taken(missing), replace(options, every=False), deadline)
    if alone:
        single = analytic.unmet(single, None)
    for k, i in enumerate(missing.tolist()):
        statuses[i], doubts[i], codes[i] = single.statuses[k], SEARCHED, -1
        tables[i] = single.qs[single.firsts[k] : single.firsts[k + 1]]
        if k in single.failures:
            failures[i] = single.failures[k]
    owners = np.repeat(np.arange(count), [len(table) for table in tables])
    qs = np.concatenate([*tables, np.empty((0, len(question.chain)))])
    solved, *errors = judged(question.taken(owners), qs, np.ones(len(qs), dtype=bool))
    kept = np.bincount(owners[solved], minlength=count)
    for i in np.flatnonzero(kept == 0).tolist():
        if i not in failures:
            first = int(np.flatnonzero(owners == i)[0])
            statuses[i], failures[i] = "not_converged", refused(qs[first], errors[0][first], errors[1][first])
    zeros = np.zeros(int(kept.sum()), dtype=np.int64)
    return InverseKinematics(
        qs[solved],
        errors[0][solved],
        errors[1][solved],
        zeros,
        zeros,
        "damped_least_squares",
        np.concatenate(([0], np.cumsum(kept))),
        statuses,
        failures,
        complete=[not doubts[i] and i not in failures for i in range(count)],
        doubts={i: doubt for i, doubt in enumerate(doubts) if doubt and i not in failures},
        branches=SolutionBranches(None, codes[owners][solved], zeros) if system else None,
    )


def _by_method(
    question: TargetProblem, options: Options, method: StepMethod, deadline: float | None
) -> InverseKinematics:
    """Run one of the course's methods from each seed, without other starts."""
    rule = options.rule or DescentRule(method)
    if options.max_iterations is not None:
        rule = replace(rule, max_iterations=options.max_iterations)
    descents = [
        None if is_over(deadline) else _descent(question, i, question.seed(i), rule, deadline)
        for i in range(len(question))
    ]
    ends = [question.seed(i) if d is None else _end(d) for i, d in enumerate(descents)]
    qs = np.array(ends).reshape(len(question), len(question.chain))
    wound = question.wound(qs)
    claimed = np.array([d is not None and d.stop_reason == "converged" for d in descents], dtype=bool)
    solved, *all_errors = judged(question, wound, claimed)
    statuses: list[Status] = ["solved"] * len(question)
    failures: dict[int, UnsolvedTarget] = {}
    too_far = question.too_far()
    for i in np.flatnonzero(~solved).tolist():
        errors = float(all_errors[0][i]), float(all_errors[1][i])
        statuses[i], failures[i] = verdict_on_path(question, i, wound[i], errors, descents[i], too_far=bool(too_far[i]))
    counts = np.array([0 if d is None else len(d.trace) - 1 for d in descents], dtype=np.int64)
    paths = [
        IterationPath("time_limit" if d is None else d.stop_reason, (d.trace if d else []) if options.trace else None)
        for d in descents
    ]
    restarts = np.zeros(len(question), dtype=np.int64)
    return _assembled(method, wound, solved, all_errors, counts, restarts, statuses, failures, paths)


def _interpreted(question: TargetProblem, options: Options, deadline: float | None) -> InverseKinematics | None:
    """Solve a few targets without the search kernels, in milliseconds each.

    Return None unless all are solved: only the kernels can find that a target is unreachable or list all solutions.
    """
    is_plain = options.method == "auto" and options.objective is None and options.elbow_angle is None
    if not is_plain or options.every or options.trace or len(question) > _INTERPRETED_TARGETS:
        return None
    rng, rule, starts = np.random.default_rng(options.random_seed), DescentRule("damped_least_squares"), []
    lower, upper = search_bounds(question.chain, options.respect_limits)[2:4]
    for i in range(len(question)):
        start = question.seed(i)
        for _ in range(_INTERPRETED_STARTS):
            if is_over(deadline):
                return None
            if _descent(question, i, start, rule, deadline).stop_reason == "converged":
                break
            start = rng.uniform(lower, upper)
        starts.append(start)
    found = _by_method(replace(question, seeds=np.array(starts)), options, rule.method, deadline)
    return None if found.failures else replace(found, method="interpreted_least_squares", paths=None)


def _descent(question: TargetProblem, i: int, start: Array, rule: DescentRule, deadline: float | None) -> Descent:
    return descend(
        question.chain,
        question.target(i),
        start,
        rule,
        task=question.task,
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
        deadline=deadline,
    )


def _end(descent: Descent) -> Array:
    """Return the last configuration of a method; if it diverged or was cut off, the best one of its trace."""
    if descent.stop_reason in {"diverged", "time_limit", "iterations"}:
        return min(descent.trace, key=lambda iterate: iterate.error).joint_positions
    return descent.joint_positions


def _retraced(question: TargetProblem, options: Options, found: Found, i: int) -> IterationPath:
    """Retrace the start that converged, or the seed; the trace is empty if no single start led to the solution."""
    if found.solved[i] and found.iterations[i] == 0:
        return IterationPath("converged", [])
    if not found.in_time[i]:
        return IterationPath("time_limit", [])
    start = start_of(
        question.chain, question.seed(i), options.respect_limits, options.random_seed, int(found.restarts[i])
    )
    descent = retrace(
        question.chain,
        question.target(i),
        start,
        int(found.followed[i]),
        task=question.task,
        tolerances=question.tolerances,
        respect_limits=question.respect_limits,
        slack=float(found.slack[i]),
    )
    return IterationPath(descent.stop_reason, descent.trace)
