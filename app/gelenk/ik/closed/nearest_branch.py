"""One target at a time, as Python calls it: the branch of a closed form that is nearest to a seed.

Each argument of a compiled function costs a call from Python a tenth of a microsecond, and to allocate and divide its
memory would cost more than a third of the solution. So one array holds all: what an arm's solver needs, laid out once,
and behind it the memory. The call keeps the GIL, and so all threads may use the same memory.
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
from gelenk.robot.compilation import compiled, exclusive, inlined

_HEAD = 16
"""Number of single numbers before the arrays: ten integers, then four others."""
_SMALL = 92
"""Numbers of the memory before those that depend on the arm: the target, and space for positioning joints."""
_ROWS = MOST + 1
"""Rows of sorted solutions, and the spare one."""


def nearest_branch(
    form: ClosedForm, tolerances: tuple[float, float] = (1e-9, 1e-9), respect_limits: bool = True
) -> Callable[[Array, Array], Array | None]:
    """Return a function that finds the branch of a target nearest to a seed; to be called often, from any thread.

    It takes T_base_tip, shape (4, 4), and a configuration, shape (n,), [rad or m], both contiguous, and returns the
    nearest configuration within the limits, shape (n,), or None if there is none: the first of `ClosedForm.solve`. It
    raises ValueError if a shape is wrong.

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
        count = solve(numbers, T, seed, q)
        if count < 0:
            raise ValueError(f"a target has the shape (4, 4), and a seed ({n},); not {T.shape} and {seed.shape}")
        return q if count else None

    return nearest


def _laid_out(flat: FlatChain, plan: SubproblemPlan, goal: Goal, limits: Array) -> Array:
    """Return all numbers in one array, in the order in which `_nearest` reads them; integers bit by bit."""
    n, m = limits.shape[1], len(flat.joints)
    singles = np.zeros(_HEAD)
    integers = [n, m, plan.kind, plan.backwards, plan.form, plan.placed]
    singles[:10].view(np.int64)[:] = [*integers, goal.kind, goal.axis, goal.starts, goal.random_seed]
    singles[10:14] = plan.reach, goal.position_tolerance, goal.chord_tolerance, goal.slack
    arrays = (*flat, plan.axes, plan.points, plan.slides, plan.order, plan.lines, plan.zero)
    memory = np.zeros(_ends(n, m)[-1])
    return np.concatenate(
        [singles, *(a.ravel().view(np.float64) for a in (*arrays, goal.bounds, goal.weights, limits, memory))]
    )


@exclusive
def _nearest(numbers: Array, T: Array, seed: Array, q: Array) -> int:
    """Put the nearest branch into q; return how many there are, or -1 if a shape is wrong."""
    integers = numbers.view(np.int64)
    n, m = integers[0], integers[1]
    if T.shape[0] != 4 or T.shape[1] != 4 or len(seed) != n:
        return -1
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
    limits = numbers[e + 6 * n + 6 : e + 8 * n + 6].reshape(2, n)
    found, kept, work, target = _memory(flat, n, numbers[e + 8 * n + 6 :])
    none, table = numbers[:0], numbers[:0].reshape(0, 0)
    space = Scratch(
        table, table, table, table, table, none, none, table, table, none, none, table, none, integers[:0], table
    )  # fmt: skip
    for i in range(3):
        for j in range(3):
            target[3 * i + j] = T[i, j]
        target[9 + i] = T[i, 3]
    count = _solve(flat, plan, goal, limits, target, seed, 0.0, found, space, kept, work)
    for j in range(n if count else 0):
        q[j] = kept.qs[0, j]
    return count


@compiled
def _ends(n: int, m: int) -> tuple[int, int, int, int, int, int, int, int, int, int]:
    """Where the parts of the memory end, for n variables and m joints."""
    values = _SMALL + MOST * n
    kept = values + _ROWS * (n + 2)
    system = kept + DIRECTIONS * (DIRECTIONS + 1)
    residuals = system + (DIRECTIONS + 1) * LANES
    state = residuals + STATE_ROWS * LANES
    q = state + n * LANES
    previous = q + n * LANES
    columns = previous + 6 * m * LANES
    J = columns + 6 * n * LANES
    return values, kept, system, residuals, state, q, previous, columns, J, J + 2 * MOST + 2 * _ROWS + 23


@inlined
def _memory(flat: FlatChain, n: int, reals: Array) -> tuple[Candidates, _Kept, Work, Array]:
    """Divide the memory for one target, and the target itself; shape (12,)."""
    m = len(flat.joints)
    coupled = m != n
    for i in range(m):
        coupled |= flat.joints[i, 1] != i or flat.drives[i, 0] != 1.0
    a, b, c, d, e, f, g, h, i, _ = _ends(n, m)
    integers = reals[i:].view(np.int64)
    none, whole = reals[:0], integers[:0]
    k = 2 * MOST + 2 * _ROWS
    found = Candidates(
        reals[_SMALL:a].reshape(MOST, n), integers[:MOST], integers[MOST : 2 * MOST], reals[12:20],
        reals[20:44].reshape(8, 3), reals[44:_SMALL].reshape(8, 3, 2),
        integers[k : k + 16].reshape(2, 8), integers[k + 16 : k + 17],
    )  # fmt: skip
    kept = _Kept(
        reals[a : a + _ROWS * n].reshape(_ROWS, n), reals[b - 2 * _ROWS : b - _ROWS], reals[b - _ROWS : b],
        integers[2 * MOST : k].reshape(2, _ROWS), reals[b:c].reshape(DIRECTIONS, DIRECTIONS + 1),
        reals[c:d], integers[k + 17 : k + 23],
    )  # fmt: skip
    work = Work(reals[d:e], reals[e:f], reals[f:g], reals[g:h], reals[h:i], none, none, whole, whole, coupled)
    return found, kept, work, reals[:12]
