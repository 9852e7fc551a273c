"""Inverse kinematics of a robot: solutions recomputed with Pinocchio, or a verdict on why there are none."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import cast

import numpy as np

from gelenk.collision.cell import Cell
from gelenk.errors import InvalidField
from gelenk.ik import analytic
from gelenk.ik.clear import clear_answer
from gelenk.ik.closed.closed_form import ClosedForm, closed_form, elimination, is_looked_at
from gelenk.ik.count.continuation import Continuation, counted, system_of
from gelenk.ik.count.families import families_of
from gelenk.ik.quick import quick_search
from gelenk.ik.search.descent import descend
from gelenk.ik.search.null_space import settled
from gelenk.ik.search.problem import DescentRule, Options, TargetProblem
from gelenk.ik.search.retrace import retrace
from gelenk.ik.search.search import ITERATIONS_PER_START, MAX_ITERATIONS, Found, nothing_found, search, start_of
from gelenk.ik.search.task import FULL_POSE
from gelenk.ik.search.words import BlockingJoint, IterationPath, StepMethod
from gelenk.ik.verdict.branches import SEARCHED, TRUNCATED, Branches, all_branches, wound, wound_near
from gelenk.ik.verdict.fixed import held_chain, narrowed, widened_answer
from gelenk.ik.verdict.judge import assembled, judged
from gelenk.ik.verdict.result import COUNTED, InverseKinematics
from gelenk.ik.verdict.verdict import (
    ENOUGH_STARTS,
    blocking_joints,
    explain,
    polished,
    refused,
    solved_without_limits,
    verdict_on_path,
)
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.compilation import clock, is_awaited, wait_for_others
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

__all__ = ["Options", "inverse_kinematics", "solve", "solve_quickly"]

_FAR_ITERATIONS = 320
"""Budget for a target out of reach by distance, for which only the nearest configuration is needed."""
_LOOSE, _SLACK = 1e-4, 0.9
"""Tolerance above which an unsolved target is tried again, and the share of the tolerances used then as slack."""
_INTERPRETED_TARGETS, _INTERPRETED_STARTS = 8, 30
"""Most targets of a call, and starts of each, solved by interpreted code while the kernels are being compiled."""


def inverse_kinematics(
    robot: RobotModel, chain: Chain, targets: Poses, seeds: Array, options: Options
) -> InverseKinematics:
    """Solve for the configurations that bring the tip to each target.

    Args:
        targets: Desired T_base_tip; N of them.
        seeds: Initial configurations, to which solutions shall be near; one for all or one each, shape (1 or N, n).

    Raises:
        InvalidField: An option needs a closed form that the chain does not have.
    """
    return solve(TargetProblem(robot, chain, targets, seeds, options))


def solve(problem: TargetProblem, cell: Cell | None = None) -> InverseKinematics:
    """Solve a problem of the whole chain within the time limit of its options; raises as `inverse_kinematics` does.

    In a cell a target is solved only by a configuration that touches nothing.
    """
    options = problem.options
    chain, objective = held_chain(problem.chain, options.fixed_joints), options.objective
    if objective is not None and objective.posture is not None:
        posture = narrowed(chain, np.atleast_2d(objective.posture))
        options = replace(options, objective=replace(objective, posture=posture))
    deadline = None if options.time_limit is None else clock() + options.time_limit
    seeds = narrowed(chain, problem.seeds)
    problem = replace(problem, chain=chain, seeds=seeds, options=options, deadline=deadline)
    if cell is None:
        answer = _answered(problem)
    else:
        if is_awaited():
            wait_for_others()
        answer = clear_answer(problem, cell, _answered)
    return widened_answer(chain, _with_families(problem, answer))


def _answered(problem: TargetProblem) -> InverseKinematics:
    method = problem.options.method
    if method not in {"auto", "analytic"}:
        return _by_method(problem, problem.options.rule or DescentRule(cast(StepMethod, method)))
    if is_awaited():
        found = _interpreted(problem)
        if found is not None:
            return found
        wait_for_others()
    form = _form(problem)
    return _without_form(problem) if form is None else _analytic(problem, form)


def _without_form(problem: TargetProblem) -> InverseKinematics:
    """Solve by continuation if it is available and all solutions or `analytic` are requested, else by search."""
    if problem.options.every:
        return _every(problem)
    if problem.options.method == "analytic" and system_of(problem):
        return analytic.first_of_each(_every(problem))
    return _one(problem)


def _with_families(problem: TargetProblem, answer: InverseKinematics) -> InverseKinematics:
    """Add the families to which the solutions belong, for targets whose solutions may not be all."""
    doubts, families = dict(answer.doubts), {}
    for i in answer.doubts:
        qs = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        found = families_of(problem, i, qs) if len(qs) else ()
        if found:
            families[i] = found
            texts = "; ".join(family.text for family in found)
            doubts[i] = f"infinitely many solutions, of which these are a sample: {texts}"
    return replace(answer, doubts=doubts, families=families) if families else answer


def _form(problem: TargetProblem) -> ClosedForm | None:
    """Return the closed form that answers the problem; None if an option needs another method."""
    options, is_analytic = problem.options, problem.options.method == "analytic"
    form = closed_form(problem.chain, options.task)
    if form is None and len(options.task) == len(FULL_POSE) and (options.every or is_analytic):
        form = elimination(problem.chain)
    if is_analytic and form is None and system_of(problem) is None:
        raise InvalidField("method", "no closed form is known for this chain and task; `auto` solves it")
    if options.elbow_angle is not None and (form is None or not form.has_free_elbow):
        raise InvalidField("elbow_angle", "only for arms of seven joints with a spherical shoulder and wrist")
    return None if options.trace or options.objective is not None else form


def _analytic(problem: TargetProblem, form: ClosedForm) -> InverseKinematics:
    """Solve by the closed form, then by `_without_form` for the rest, which also explains unsolved targets."""
    options = problem.options
    found = analytic.every(problem, form) if options.every else analytic.nearest(problem, form)
    left = np.flatnonzero(np.diff(found.firsts) == 0)
    if len(left) == 0:
        return found
    rest = _without_form(problem.taken(left))
    if options.method == "analytic" and system_of(problem) is None:
        rest = analytic.unmet(rest, options.elbow_angle)
    return analytic.joined(found, left, rest)


def solve_quickly(problem: TargetProblem, starts: int, *, by_form: bool = False) -> InverseKinematics | None:
    """Return one solution for each of a few targets if that takes only tens of microseconds, else None.

    With `by_form`, only solutions of a closed form count.
    """
    chain, options = problem.chain, problem.options
    if not is_looked_at(chain, options.task):
        return None
    form = closed_form(chain, options.task)
    if form is not None:
        found = analytic.nearest(problem, form)
        return found if len(found.qs) == len(problem) else None
    if by_form:
        return None
    respect_limits, random_seed = options.respect_limits, options.random_seed
    quick = quick_search(problem.robot, chain, options.task, problem.tolerances, respect_limits, starts, random_seed)
    return quick.of_each(problem.targets, problem.seeds)


def _one(problem: TargetProblem) -> InverseKinematics:
    options, count = problem.options, len(problem)
    found, too_far, outside = _searched(problem)
    if options.objective is not None and found.solved.any():
        found = replace(found, qs=settled(problem, found.qs, found.solved))
    is_unsettled = options.objective is not None and problem.is_over
    judgement = judged(problem, found.qs, found.solved)
    paths = [_retraced(problem, found, i) for i in range(count)] if options.trace else None
    if is_unsettled:
        traces = [path.trace for path in paths] if paths else [None] * count
        paths = [IterationPath("time_limit", trace) for trace in traces]
    solved, errors = judgement[0], np.array(judgement[1:])
    failures = {
        i: explain(problem, i, found, errors, bool(too_far[i]), outside.get(i, ()))
        for i in np.flatnonzero(~solved).tolist()
    }
    labels = {"iterations": found.iterations, "restarts": found.restarts}
    return assembled(count, np.arange(count), found.qs, judgement, labels, failures=failures, paths=paths)


def _searched(problem: TargetProblem) -> tuple[Found, Flags, dict[int, tuple[BlockingJoint, ...]]]:
    """Search for one solution per target.

    Also return flags of the targets beyond reach by distance alone, shape (N,); and, by the index of a target that is
    solvable only beyond the limits, the joints beyond theirs.
    """
    options = problem.options
    budget = options.max_iterations or MAX_ITERATIONS
    too_far = problem.too_far()
    if too_far.any():
        found = nothing_found(len(problem), len(problem.chain))
        found.put(~too_far, search(problem.taken(~too_far), budget))
        found.put(too_far, search(problem.taken(too_far), min(budget, _FAR_ITERATIONS)))
    else:
        found = search(problem, budget)
    left = ~found.solved & ~too_far
    if max(problem.tolerances) > _LOOSE and left.any():
        found.put(left, search(problem.taken(left), budget, _SLACK))
    unsolved = np.flatnonzero(~found.solved & found.in_time)
    if not len(unsolved):
        return found, too_far, {}
    for i in unsolved.tolist():
        if not problem.is_over:
            found.qs[i] = polished(problem, i, found.qs[i])
    # The nearest configuration may be near enough.
    near_enough = unsolved[judged(problem.taken(unsolved), found.qs[unsolved])[0]]
    found.solved[near_enough], found.iterations[near_enough] = True, 0
    outside: dict[int, tuple[BlockingJoint, ...]] = {}
    # If only a few starts have failed, there may well be a solution within the limits.
    with_limits = options.respect_limits and budget >= ENOUGH_STARTS * ITERATIONS_PER_START
    for i in np.flatnonzero(~found.solved & ~too_far & found.in_time & with_limits).tolist():
        q = None if problem.is_over else solved_without_limits(problem, i)
        if q is None:
            continue
        outside[i] = blocking_joints(problem.chain, q)
        if not outside[i]:
            # Starts that ignore the limits have reached a solution within them.
            found.qs[i], found.solved[i], found.iterations[i] = q, True, 0
    return found, too_far, outside


def _every(problem: TargetProblem) -> InverseKinematics:
    """Find all solutions of each target; targets without any are searched again by `_one`, which explains failures."""
    count, system = len(problem), system_of(problem)
    found = [Branches(np.empty((0, len(problem.chain))), SEARCHED)] * count
    for i in range(count):
        if problem.is_over:
            break
        found[i] = _every_of(problem, i, system)
    missing = np.array([i for i in range(count) if len(found[i].qs) == 0], dtype=np.int64)
    # The search for one solution tries harder, and explains failures.
    single = _one(problem.taken(missing))
    if problem.options.method == "analytic" and system:
        single = analytic.unmet(single, None)
    for k, i in enumerate(missing.tolist()):
        found[i] = Branches(single.qs[single.firsts[k] : single.firsts[k + 1]], SEARCHED)
    failures = {int(missing[k]): failure for k, failure in single.failures.items()}
    owners = np.repeat(np.arange(count), [len(each.qs) for each in found])
    qs = np.concatenate([*(each.qs for each in found), np.empty((0, len(problem.chain)))])
    judgement = solved, *errors = judged(problem.taken(owners), qs)
    for i in sorted(set(range(count)) - set(owners[solved].tolist()) - set(failures)):
        first = int(np.searchsorted(owners, i))
        failures[i] = refused(qs[first], errors[0][first], errors[1][first])
    return assembled(
        count,
        owners,
        qs,
        judgement,
        {"codes": np.array([each.code for each in found], dtype=np.int64)[owners]},
        failures=failures,
        every=True,
        doubts={i: each.doubt for i, each in enumerate(found) if each.doubt and i not in failures},
        is_counted=system is not None,
    )


def _every_of(problem: TargetProblem, i: int, system: Continuation | None) -> Branches:
    options = problem.options
    if system is None:
        return all_branches(problem, i, windings=options.windings)
    alone = options.method == "analytic"
    searched: Callable[[], Branches] | None = None if alone else partial(all_branches, problem, i)
    found = counted(problem, i, system, searched)
    qs, doubt = found.qs, found.doubt
    if options.windings and len(qs):
        qs, _, whole = wound(problem, i, qs, True)
        doubt = doubt or ("" if whole else TRUNCATED)
    elif len(qs) > options.most:
        qs, doubt = qs[: options.most], doubt or TRUNCATED
    return Branches(qs, doubt, COUNTED if alone or not found.doubt else -1)


def _by_method(problem: TargetProblem, rule: DescentRule) -> InverseKinematics:
    """Run one of the course's methods from each seed, without other starts."""
    chain, count = problem.chain, len(problem)
    late = IterationPath("time_limit", [])
    paths = [late if problem.is_over else descend(problem, i, problem.seed(i), rule) for i in range(count)]
    ends = [_end(problem, i, path) for i, path in enumerate(paths)]
    qs = np.concatenate([*ends, np.empty((0, len(chain)))])
    claimed = np.array([path.stop_reason == "converged" for path in paths], dtype=bool)
    judgement = judged(problem, qs, claimed)
    solved, errors, too_far = judgement[0], np.array(judgement[1:]), problem.too_far()
    failures = {
        i: verdict_on_path(problem, i, qs[i], errors[:, i], paths[i], bool(too_far[i]))
        for i in np.flatnonzero(~solved).tolist()
    }
    labels = {"iterations": np.array([max(0, len(path.trace or ()) - 1) for path in paths], dtype=np.int64)}
    if not problem.options.trace:
        paths = [replace(path, trace=None) for path in paths]
    return assembled(count, np.arange(count), qs, judgement, labels, method=rule.method, failures=failures, paths=paths)


def _interpreted(problem: TargetProblem) -> InverseKinematics | None:
    """Solve a few targets without the search kernels, in milliseconds each.

    Return None unless all are solved: only the kernels can find that a target is unreachable or list all solutions.
    """
    options = problem.options
    is_plain = options.method == "auto" and options.objective is None and options.elbow_angle is None
    if not is_plain or options.every or options.trace or len(problem) > _INTERPRETED_TARGETS:
        return None
    unbounded = replace(problem, options=replace(options, max_iterations=None))
    rng, rule, starts = np.random.default_rng(options.random_seed), DescentRule("damped_least_squares"), []
    for i in range(len(problem)):
        start = problem.seed(i)
        for _ in range(_INTERPRETED_STARTS):
            if problem.is_over:
                return None
            if descend(unbounded, i, start, rule).stop_reason == "converged":
                break
            start = rng.uniform(problem.bounds[2], problem.bounds[3])
        starts.append(start)
    found = _by_method(replace(problem, seeds=np.array(starts)), rule)
    return None if found.failures else replace(found, method="interpreted_least_squares", paths=None)


def _end(problem: TargetProblem, i: int, path: IterationPath) -> Array:
    """Last configuration of a method, or the best one if it diverged or was cut off, turned to the seed; (1, n)."""
    q, trace = problem.seed(i), path.trace
    if trace:
        is_cut = path.stop_reason in {"diverged", "time_limit", "iterations"}
        last = min(trace, key=lambda iterate: iterate.error) if is_cut else trace[-1]
        q = np.array(last.joint_positions)
    return wound_near(problem.chain, q[None], problem.seed(i), *problem.limits)


def _retraced(problem: TargetProblem, found: Found, i: int) -> IterationPath:
    """Retrace the start that converged, or the seed; the trace is empty if no single start led to the solution."""
    if found.solved[i] and found.iterations[i] == 0:
        return IterationPath("converged", [])
    if not found.in_time[i]:
        return IterationPath("time_limit", [])
    start = start_of(problem, i, int(found.restarts[i]))
    return retrace(problem, i, start, int(found.followed[i]), float(found.slack[i]))
