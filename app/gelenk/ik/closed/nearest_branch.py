"""One target at a time, as Python calls it: the branch of a closed form that is nearest to a seed.

Each argument of a compiled function costs a call from Python a tenth of a microsecond, and each array that it
allocates half as much: in all as long as the solution itself. So what an arm's solver needs is laid out once, in one
array, and a call allocates its memory in two pieces.
"""

from collections.abc import Callable

import numpy as np

from gelenk.ik.closed.branch_kernels import DIRECTIONS, _Kept, _solve
from gelenk.ik.closed.closed_form import ClosedForm
from gelenk.ik.closed.elimination import Scratch
from gelenk.ik.closed.subproblem_chains import ELBOW, GENERAL, MOST, Candidates, SubproblemPlan
from gelenk.ik.search.bounds import limits_of, make_goal
from gelenk.ik.search.iteration import STATE_ROWS, Goal, Work
from gelenk.kinematics.simd.lanes import LANES
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled

_HEAD = 16
"""Number of single numbers before the arrays: ten integers, then four others."""


def nearest_branch(
    form: ClosedForm, tolerances: tuple[float, float] = (1e-9, 1e-9), respect_limits: bool = True
) -> Callable[[Array, Array], Array | None]:
    """Return a function that finds the branch of a target nearest to a seed; to be called often, from any thread.

    It takes T_base_tip, shape (4, 4), and a configuration, shape (n,), [rad or m], both contiguous, and returns the
    nearest configuration within the limits, shape (n,), or None if there is none: the first of `ClosedForm.solve`.

    Args:
        tolerances: Of position [m] and orientation [rad].

    Raises:
        ValueError: The form has a free elbow, or is an elimination.
    """
    if form.plan.kind in {ELBOW, GENERAL}:
        raise ValueError(f"only for arms without a free elbow, in closed form; not for {form.name}")
    goal = make_goal(form.chain, form.task, tolerances, False, 1)
    numbers = _laid_out(form.chain.flat, form.plan, goal, limits_of(form.chain, respect_limits))
    n, empty, solve = len(form.chain), np.empty, _nearest

    def nearest(T: Array, seed: Array) -> Array | None:
        q = empty(n)
        return q if solve(numbers, T, seed, q) else None

    return nearest


def _laid_out(flat: FlatChain, plan: SubproblemPlan, goal: Goal, limits: Array) -> Array:
    """Return all numbers in one array, in the order in which `_nearest` reads them; integers bit by bit."""
    singles = np.zeros(_HEAD)
    integers = [limits.shape[1], len(flat.joints), plan.kind, plan.backwards, plan.form, plan.placed]
    singles[:10].view(np.int64)[:] = [*integers, goal.kind, goal.axis, goal.starts, goal.random_seed]
    singles[10:14] = plan.reach, goal.position_tolerance, goal.chord_tolerance, goal.slack
    arrays = (*flat, plan.axes, plan.points, plan.slides, plan.order, plan.lines, plan.zero)
    return np.concatenate(
        [singles, *(a.ravel().view(np.float64) for a in (*arrays, goal.bounds, goal.weights, limits))]
    )


@compiled
def _nearest(numbers: Array, T: Array, seed: Array, q: Array) -> int:
    """Put the nearest branch into q; return how many there are."""
    integers = numbers.view(np.int64)
    n, m = integers[0], integers[1]
    a = _HEAD + 12 * (m + 1)
    b = a + 4 * m
    c = b + 6 * n
    d = c + n + 3
    e = d + 48 + 12
    flat = FlatChain(
        numbers[_HEAD:a].reshape(m + 1, 12), integers[a : a + 2 * m].reshape(m, 2), numbers[a + 2 * m : b].reshape(m, 2)
    )
    plan = SubproblemPlan(
        integers[2], integers[3], integers[4], integers[5],
        numbers[b : b + 3 * n].reshape(n, 3), numbers[b + 3 * n : c].reshape(n, 3), integers[c : c + n],
        integers[c + n : d], numbers[d : d + 48].reshape(16, 3), numbers[d + 48 : e], numbers[10],
        numbers[:0].reshape(0, 0),
    )  # fmt: skip
    goal = Goal(
        numbers[e : e + 6 * n].reshape(6, n), numbers[e + 6 * n : e + 6 * n + 6], integers[6], integers[7],
        numbers[11], numbers[12], numbers[13], integers[8], integers[9],
    )  # fmt: skip
    limits = numbers[e + 6 * n + 6 :].reshape(2, n)
    found, kept, work, target = _memory(flat, n)
    for i in range(3):
        for j in range(3):
            target[3 * i + j] = T[i, j]
        target[9 + i] = T[i, 3]
    count = _solve(flat, plan, goal, limits, target, seed, 0.0, found, kept, work)
    for j in range(n if count else 0):
        q[j] = kept.qs[0, j]
    return count


@compiled
def _memory(flat: FlatChain, n: int) -> tuple[Candidates, _Kept, Work, Array]:
    """Allocate the memory for one target, and the target itself; shape (12,)."""
    m = len(flat.joints)
    coupled = m != n
    for i in range(m):
        coupled |= flat.joints[i, 1] != i or flat.drives[i, 0] != 1.0
    kept = MOST + 1
    a = 92
    b = a + MOST * n
    c = b + kept * (n + 2)
    d = c + 42 + 7 * LANES
    e = d + STATE_ROWS * LANES
    f = e + 2 * n * LANES
    g = f + 6 * m * LANES
    reals, integers = np.empty(g + 6 * n * LANES), np.empty(2 * MOST + 2 * kept + 23, np.int64)
    none, table, whole = reals[:0], reals[:0].reshape(0, 0), integers[:0]
    space = Scratch(
        table, table, table, table, table, none, none, table, table, none, none, table, none, whole, table
    )  # fmt: skip
    h = 2 * MOST + 2 * kept
    found = Candidates(
        reals[a:b].reshape(MOST, n), integers[:MOST], integers[MOST : 2 * MOST], reals[12:20],
        reals[20:44].reshape(8, 3), reals[44:92].reshape(8, 3, 2),
        integers[h : h + 16].reshape(2, 8), space, integers[h + 16 : h + 17],
    )  # fmt: skip
    sorted_ = _Kept(
        reals[b : b + kept * n].reshape(kept, n), reals[c - 2 * kept : c - kept], reals[c - kept : c],
        integers[2 * MOST : h].reshape(2, kept), reals[c : c + 42].reshape(DIRECTIONS, DIRECTIONS + 1),
        reals[c + 42 : d], integers[h + 17 :],
    )  # fmt: skip
    work = Work(
        reals[d:e], reals[e : e + n * LANES], reals[e + n * LANES : f], reals[f:g], reals[g:],
        none, none, whole, whole, coupled,
    )  # fmt: skip
    reals[d:f] = 0.0
    return found, sorted_, work, reals[:12]
