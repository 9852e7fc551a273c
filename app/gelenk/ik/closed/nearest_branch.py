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
from gelenk.ik.search.iteration import STATE_ROWS, Goal, Work, workspace
from gelenk.kinematics.simd.lanes import LANES, part
from gelenk.robot.arrays import Array
from gelenk.robot.chain import FlatChain
from gelenk.robot.compilation import compiled, exclusive, inlined

_HEAD = 16
"""Number of single numbers before the arrays: eleven integers, then four others."""
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
    integers += [goal.kind, goal.axis, goal.starts, goal.random_seed, workspace(flat, n).coupled]
    singles[:11].view(np.int64)[:] = integers
    singles[11:15] = plan.reach, goal.position_tolerance, goal.chord_tolerance, goal.slack
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
    f = e + 6 * n + 6
    flat = FlatChain(
        part(numbers, _HEAD, (m + 1, 12)), part(integers, a, (m, 2)), part(numbers, a + 2 * m, (m, 2))
    )  # fmt: skip
    plan = SubproblemPlan(
        integers[2], integers[3], integers[4], integers[5],
        part(numbers, b, (n, 3)), part(numbers, b + 3 * n, (n, 3)), part(integers, c, (n,)),
        part(integers, c + n, (3,)), part(numbers, d, (16, 3)), part(numbers, d + 48, (12,)), numbers[11],
        part(numbers, 0, (0, 0)),
    )  # fmt: skip
    goal = Goal(
        part(numbers, e, (6, n)), part(numbers, e + 6 * n, (6,)), integers[6], integers[7],
        numbers[12], numbers[13], numbers[14], integers[8], integers[9],
    )  # fmt: skip
    limits = part(numbers, f, (2, n))
    found, kept, work, target = _memory(n, m, integers[10] != 0, numbers[f + 2 * n :])
    none, table = numbers[:0], part(numbers, 0, (0, 0))
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
def _memory(n: int, m: int, coupled: bool, reals: Array) -> tuple[Candidates, _Kept, Work, Array]:
    """Divide the memory for one target, and the target itself; shape (12,)."""
    a, b, c, d, e, f, g, h, i, _ = _ends(n, m)
    integers = reals[i:].view(np.int64)
    none, whole = reals[:0], integers[:0]
    k = 2 * MOST + 2 * _ROWS
    found = Candidates(
        part(reals, _SMALL, (MOST, n)), part(integers, 0, (MOST,)), part(integers, MOST, (MOST,)),
        part(reals, 12, (8,)), part(reals, 20, (8, 3)), part(reals, 44, (8, 3, 2)),
        part(integers, k, (2, 8)), part(integers, k + 16, (1,)),
    )  # fmt: skip
    kept = _Kept(
        part(reals, a, (_ROWS, n)), part(reals, b - 2 * _ROWS, (_ROWS,)), part(reals, b - _ROWS, (_ROWS,)),
        part(integers, 2 * MOST, (2, _ROWS)), part(reals, b, (DIRECTIONS, DIRECTIONS + 1)),
        part(reals, c, (d - c,)), part(integers, k + 17, (DIRECTIONS,)),
    )  # fmt: skip
    work = Work(
        part(reals, d, (e - d,)), part(reals, e, (f - e,)), part(reals, f, (g - f,)), part(reals, g, (h - g,)),
        part(reals, h, (i - h,)), none, none, whole, whole, coupled,
    )  # fmt: skip
    return found, kept, work, part(reals, 0, (12,))
