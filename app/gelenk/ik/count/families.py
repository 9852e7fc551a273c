"""Families of infinitely many solutions of a target: the joints that move, and the relations between them.

A singular Jacobian does not prove a family: the arm may be unable to move on from there. So each family is walked step
by step on the target, and only what the walk has shown is reported.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.errors import quoted
from gelenk.ik.search.bounds import free_variables, whole_turns_removed
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import Family
from gelenk.ik.verdict.fixed import widened
from gelenk.ik.verdict.judge import judged
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain

MOST_FAMILIES = 32
"""Most families reported for a target: an arm of six joints has at most 16 branches [Raghavan1993]."""

_SINGULAR, _USELESS = 1e-6, 1e-8
"""Shares of σ_max below which a direction counts as lost, and below which a correction ignores it."""
_STEPS = (0.2, 0.05, 0.0125, 0.003)
"""Step sizes tried in turn, for the joint that moves most, [rad or m]."""
_DRIFT, _OFF_TARGET = 1e-8, 5e-10
"""Largest error after a step, per rad or m of the step and in total, [m, rad]."""
_ROUNDING, _CORRECTIONS = 1e-12, 8
_MOST_STEPS = 200
"""Most steps in each direction, if a walk neither closes nor reaches a limit."""
_EXPLORED = 4
"""Steps in each direction of a family of more than one dimension."""
_MOVES = 1e-3
"""Least motion of a joint that counts as moving, [rad or m]."""
_LARGEST, _TIED = 4.0, 1e-6
"""Largest factor in a constant sum of joints, and its largest variation, [rad or m]."""
_TURN = 2.0 * np.pi


@dataclass(frozen=True, slots=True)
class _Motion:
    """A walk along a family: its configurations (k, n), which joints move (n,), and factors of constant sums (r, n)."""

    path: Array
    moving: Flags
    ties: Array

    def has(self, chain: Chain, q: Array) -> bool:
        """Check whether a configuration has the same unmoved joints and constant sums as the walk."""
        constant = np.concatenate((np.eye(len(q))[~self.moving], self.ties))
        apart = constant @ (q - self.path[0])
        whole_turns = np.abs(constant) @ ~free_variables(chain) == 0.0
        apart -= np.where(whole_turns, _TURN * np.rint(apart / _TURN), 0.0)
        return bool((np.abs(apart) <= _MOVES).all())


def families_of(problem: TargetProblem, i: int, qs: Array) -> tuple[Family, ...]:
    """Find the families to which solutions of a target, shape (k, n), belong, in the order of the solutions.

    All together have at most as many sample configurations as the options allow solutions.
    """
    own, most = problem.taken(slice(i, i + 1)), problem.options.most
    sizes = np.linalg.svd(own.linearised(0, qs)[1], compute_uv=False)
    ranks = (sizes > _SINGULAR * sizes[:, :1]).sum(axis=1)
    motions: list[_Motion] = []
    for q in qs[ranks < qs.shape[1]]:
        if own.is_over or len(motions) == min(most, MOST_FAMILIES):
            break
        if not any(motion.has(own.chain, q) for motion in motions):
            motion = _motion(own, q)
            motions += [motion] if motion else []
    return tuple(_family(own.chain, motion, most // len(motions)) for motion in motions)


def _family(chain: Chain, motion: _Motion, most: int) -> Family:
    whole, path = widened(chain, motion.path)
    names = [quoted(name) for name in chain.joint_names]
    symbols = [f"q_{whole.joint_names.index(name) + 1}" for name in chain.joint_names]
    constants = ["c"] if len(motion.ties) == 1 else [f"c_{k}" for k in range(1, len(motion.ties) + 1)]
    relations = [f"{_sum(tie, symbols)} = {c}" for tie, c in zip(motion.ties, constants, strict=True)]
    moving = [names[j] for j in np.flatnonzero(motion.moving)]
    said = f"{', '.join(moving[:-1])} and {moving[-1]} move together" if len(moving) > 1 else f"{moving[0]} is free"
    sums = [f"{_sum(tie, names)} stays at {tie @ motion.path[0]:.6g}" for tie in motion.ties]
    rows = np.unique(np.linspace(0, len(path) - 1, min(most, len(path))).round().astype(np.int64))
    return Family(
        [chain.joint_names[j] for j in np.flatnonzero(motion.moving)],
        ", ".join(relations) or None,
        ", ".join([said, *sums]),
        path[rows].tolist(),
    )


def _sum(factors: Array, names: list[str]) -> str:
    """Format a sum, such as `q_4 + q_6` or `q_2 - 2 q_3`."""
    terms = [
        f"{'-' if factor < 0 else '+'} {'' if abs(factor) == 1 else f'{abs(factor)} '}{name}"
        for factor, name in zip(factors.astype(int).tolist(), names, strict=True)
        if factor
    ]
    return " ".join(terms).removeprefix("+ ")


def _motion(problem: TargetProblem, q: Array) -> _Motion | None:
    q, kernel, _ = _corrected(problem, q)
    for direction in kernel:
        ahead, is_loop = _walk(problem, q, direction, _MOST_STEPS)
        behind = ahead[:1] if is_loop else _walk(problem, q, -direction, _MOST_STEPS)[0]
        path = np.concatenate((behind[:0:-1], ahead))
        if len(path) > 1:
            break
    else:
        return None
    ways = path
    # Families may cross where the walk began; further on it is in only one, whose dimension is that of the kernel.
    on, kernel, _ = _corrected(problem, path[len(path) // 4])
    if len(kernel) > 1:
        directions = [sign * direction for direction in (*kernel, kernel.sum(axis=0)) for sign in (1.0, -1.0)]
        ways = np.concatenate([path, *(_walk(problem, on, direction, _EXPLORED)[0] for direction in directions)])
    moving = np.ptp(ways, axis=0) > _MOVES
    good, *errors = judged(problem.taken(np.zeros(len(path), dtype=np.int64)), path)
    if not (moving.any() and good.all() and np.max(errors) <= 2.0 * _OFF_TARGET):
        return None
    return _Motion(path, moving, _ties(ways - ways[0], moving))


def _corrected(problem: TargetProblem, q: Array) -> tuple[Array, Array, float]:
    """Bring a configuration onto the target by Newton steps of least length.

    Return it, an orthonormal basis of the kernel of J there, shape (k, n), and the error.
    """
    for k in range(_CORRECTIONS + 1):
        es, Js = problem.linearised(0, q[None])
        U, sizes, Vt = np.linalg.svd(Js[0])
        error = float(np.linalg.norm(es))
        if error <= _ROUNDING or k == _CORRECTIONS:
            break
        used = int((sizes > _USELESS * sizes[0]).sum())
        q = q + (es[0] @ U[:, :used] / sizes[:used]) @ Vt[:used]
    return q, Vt[int((sizes > _SINGULAR * sizes[0]).sum()) :], error


def _walk(problem: TargetProblem, start: Array, direction: Array, most: int) -> tuple[Array, bool]:
    """Walk on the target from a start until a limit or dead end; return the path, and whether it closed."""
    lower, upper = problem.limits
    path = [start]
    while len(path) <= most and np.abs(direction).max() > 0.0:
        for size in _STEPS:
            step = size / np.abs(direction).max() * direction
            q, kernel, error = _corrected(problem, path[-1] + step)
            goes_on = np.abs(q - path[-1] - step).max() <= 0.5 * size
            if goes_on and error <= min(_OFF_TARGET, _DRIFT * size) and ((q >= lower) & (q <= upper)).all():
                break
        else:
            break
        direction = kernel.T @ (kernel @ (q - path[-1]))
        path.append(q)
        if len(path) > 3 and np.abs(whole_turns_removed(problem.chain, q - start)).max() < 0.75 * size:
            return np.array(path), True
    return np.array(path), False


def _ties(ways: Array, moving: Flags) -> Array:
    """Integer factors of the sums of moving joints that stay constant on all paths; shape (r, n)."""
    joints = np.flatnonzero(moving)
    _, sizes, Vt = np.linalg.svd(ways[:, joints])
    rest = _reduced(Vt[int((sizes > _TIED * sizes[0]).sum()) :])
    ties = np.zeros((len(rest), len(moving)))
    ties[:, joints] = rest / np.where(rest == 0.0, np.inf, np.abs(rest)).min(axis=1, initial=np.inf, keepdims=True)
    ties = np.rint(ties)
    stay = (np.abs(ties) <= _LARGEST).all(axis=1) & (np.ptp(ways @ ties.T, axis=0) <= _TIED)
    return np.asarray(ties[stay])


def _reduced(rows: Array) -> Array:
    """Reduced row echelon form of a matrix of full row rank."""
    rows, column = rows.copy(), 0
    for k in range(len(rows)):
        while np.abs(rows[k:, column]).max() < _TIED:
            column += 1
        best = k + int(np.argmax(np.abs(rows[k:, column])))
        rows[[k, best]] = rows[[best, k]]
        rows[k] /= rows[k, column]
        others = np.arange(len(rows)) != k
        rows[others] -= np.outer(rows[others, column], rows[k])
        column += 1
    return np.where(np.abs(rows) < _TIED, 0.0, rows)
