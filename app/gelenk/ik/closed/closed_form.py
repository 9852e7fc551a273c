"""Recognition of arms with a closed form by the lines of their joints, and the names of the branches.

The plan of an arm follows from which axes are parallel, intersect or slide. It is then tested: random configurations
of the arm must be among the branches of their own poses, else the plan is dropped. So an arm that is recognised here
is also solved, whatever its description says.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import accumulate, pairwise

import numpy as np

from gelenk.ik.closed.branch_kernels import BranchTable, branches, elbow_angles
from gelenk.ik.closed.elimination import left_sides
from gelenk.ik.closed.subproblem_chains import (
    ARM_ROOT,
    COPLANAR,
    DECOUPLED,
    ELBOW,
    FIRST_ROOT,
    GENERAL,
    LAST_ROOT,
    MOST,
    OBLIQUE,
    PARALLEL,
    RAILS,
    ROOT_NUMBER,
    SECOND_ROOT,
    SKEW,
    SQUARE,
    SubproblemPlan,
)
from gelenk.ik.search.bounds import limits_of, make_goal, mid_range, target_rows, whole_turns_removed
from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.poses import Poses, inverse, transform

GENERAL_NAME = "six revolute joints, by elimination"
_EXACTLY, _ROUNDED, _NEARLY = 1e-14, 1e-10, 1e-6
"""Distance [m] at which lines intersect, and sine of the angle at which they are parallel: descriptions round π."""
_CLEARLY = 1e-4
"""Distance or sine above which they clearly do not."""
_SINGULAR = 1e-6
"""Smallest singular value below which rounding may cost a solution, [m, rad]."""
_TESTS, _MUST_PASS = 48, 46
"""Test configurations, and how many must be found again: a few may lie next to a singularity."""
_NAMING = 64
"""Number of random configurations used to name the roots."""
_GENERAL_TESTS, _GENERAL_MUST_PASS = 500, 498
_FOUND_AGAIN = 1e-6
_LINES = 16
_NO_ANGLE = np.zeros(1)


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """The closed form of a chain.

    Attributes:
        name: The geometric property that allows it, in words.
        tolerance: Allowed deviation of the geometry from the plan: sine of an angle, or distance [m].
    """

    name: str
    chain: Chain
    task: Task
    plan: SubproblemPlan
    choices: tuple["Choice", ...] = ()
    tolerance: float = 0.0

    def solve(
        self,
        targets: Poses,
        seeds: Array,
        *,
        tolerances: tuple[float, float] = (1e-9, 1e-9),
        respect_limits: bool = True,
        elbow_angles: Array | float | None = None,
        most: int = MOST,
    ) -> BranchTable:
        """Compute the branches of each target, nearest to the seed first.

        Args:
            seeds: One configuration for all targets or one each; shape (1 or N, n), [rad or m].
            tolerances: Of position [m] and orientation [rad].
            elbow_angles: Angles of a free elbow, one for all targets or one each; by default the seeds', [rad].
        """
        chain = self.chain
        goal = make_goal(chain, self.task, tolerances, False, 1)
        if elbow_angles is None:
            elbow_angles = self.elbow_angles(seeds) if self.has_free_elbow else _NO_ANGLE
        angles = np.atleast_1d(np.asarray(elbow_angles, dtype=float)) if self.has_free_elbow else _NO_ANGLE
        rows = _in_reach_of(self, target_rows(targets))
        limits = limits_of(chain, respect_limits)
        return branches(chain.flat, self.plan, goal, limits, rows, np.ascontiguousarray(seeds), angles, most)

    @property
    def is_exact(self) -> bool:
        """Whether the geometry is what the plan assumes, up to rounding."""
        return self.tolerance <= _EXACTLY

    @property
    def doubt(self) -> float:
        """Smallest singular value [m, rad] below which the arm may have other solutions than those reported.

        Where two solutions meet, a deviation ε of the geometry, or of rounding, moves the joints by √ε.
        """
        return max(_SINGULAR, 10.0 * float(np.sqrt(self.tolerance)))

    @property
    def method(self) -> str:
        """Name of the method in answers: `elimination` or `analytic`."""
        return "elimination" if self.plan.kind == GENERAL else "analytic"

    @property
    def has_double_roots(self) -> bool:
        """Whether the form uses a quartic, whose double roots are accurate only to half the digits."""
        return self.plan.form in {SKEW, OBLIQUE}

    @property
    def has_free_elbow(self) -> bool:
        """Whether the arm has a seventh joint, so that its elbow can turn about the line from shoulder to wrist."""
        return self.plan.kind == ELBOW

    def elbow_angles(self, qs: Array) -> Array:
        """Elbow angles about the line from shoulder to wrist, of configurations (N, 7) [rad]; shape (N,), [rad].

        They are zero in the plane of that line and axis 1.
        """
        return elbow_angles(self.chain.flat, self.plan, np.ascontiguousarray(qs))

    @lru_cache(maxsize=64)  # noqa: B019
    def branch(self, code: int) -> dict[str, str | int]:
        """Return the names of the roots in a branch code, by choice."""
        named: dict[str, str | int] = {}
        for choice in self.choices:
            if choice.bit:
                bit = bool(code & choice.bit)
                if choice.turned_by and code & choice.turned_by:
                    bit = bit != choice.turns
                named[choice.name] = choice.values[bit]
            else:
                named[choice.name] = (code >> ROOT_NUMBER) + 1
        return named

    def free_joints(self, mask: int) -> list[str]:
        """Return the names of the joints that a bit mask marks as free."""
        return [name for j, name in enumerate(self.chain.joint_names) if mask >> j & 1]


@dataclass(frozen=True, slots=True)
class Choice:
    """The meaning of a root in branch codes; the bit is 0 if roots are numbered.

    Attributes:
        name: `shoulder`, `elbow` or `wrist`; `arm` if roots are numbered.
        values: Names of the root if the bit is 0, and if it is 1.
        turned_by, turns: Another bit, and whether it swaps the two names.
    """

    name: str
    bit: int
    values: tuple[str, str] = ("", "")
    turned_by: int = 0
    turns: bool = False


_VALUES: dict[str, tuple[str, str]] = {
    "shoulder": ("front", "back"),
    "elbow": ("up", "down"),
    "wrist": ("no_flip", "flip"),
}


def closed_form(chain: Chain, task: Task = FULL_POSE) -> ClosedForm | None:
    """Return the closed form that gives all solutions of a task, or None if none is known."""
    holder = _recognised(chain, task)
    if not holder:
        holder.append(_recognise(chain, task))
    return holder[0]


def is_looked_at(chain: Chain, task: Task = FULL_POSE) -> bool:
    """Check whether the result of `closed_form` is cached; if not, it takes some hundredths of a second."""
    return bool(_recognised(chain, task))


def look_at(chain: Chain, task: Task, found: ClosedForm | None) -> None:
    """Cache a result of `closed_form` from another process for the same chain."""
    holder = _recognised(chain, task)
    if not holder:
        holder.append(None if found is None else replace(found, chain=chain))


@lru_cache(maxsize=1024)
def _recognised(chain: Chain, task: Task) -> list[ClosedForm | None]:  # noqa: ARG001
    """Cache entry of a closed form; an empty list at first."""
    return []


def _recognise(chain: Chain, task: Task) -> ClosedForm | None:
    if not _is_simple(chain) or not _is_independent(chain, task):
        return None
    for tolerance in (_EXACTLY, _ROUNDED, _NEARLY):
        for name, plan in _plans(chain, tolerance):
            form = ClosedForm(name, chain, task, plan)
            if _fits(form) and _found_again(form, _TESTS) >= _MUST_PASS:
                return replace(form, choices=_choices(form), tolerance=tolerance)
    return None


@lru_cache(maxsize=256)
def elimination(chain: Chain) -> ClosedForm | None:
    """Return the elimination that solves six revolute joints of any geometry; None if it fails on the chain."""
    if not _is_simple(chain) or len(chain) != 6 or chain.flat.joints[:, 0].any():
        return None
    ahead = _screws(chain, _NEARLY)
    plans = (_general_plan(ahead), _general_plan(ahead.reversed()))
    forms = [ClosedForm(GENERAL_NAME, chain, FULL_POSE, plan, (Choice("arm", 0),)) for plan in plans]
    # If the geometry is special, one of the two is better, or neither works.
    scores = [_found_again(form, _GENERAL_TESTS) for form in forms]
    best = int(np.argmax(scores))
    return forms[best] if scores[best] >= _GENERAL_MUST_PASS else None


def screws_of_six(chain: Chain) -> "JointScrews | None":
    """Return the joint lines of a chain with six independent variables; None for other chains."""
    if len(chain) != 6 or not _is_simple(chain) or not _is_independent(chain, FULL_POSE):
        return None
    return _screws(chain, _NEARLY)


def _is_simple(chain: Chain) -> bool:
    """Check for 2 to 7 joints, each with its own variable and a drive ratio of ±1."""
    flat = chain.flat
    own = len(flat.joints) == len(chain) and (flat.joints[:, 1] == np.arange(len(chain))).all()
    return bool(own) and 2 <= len(chain) <= 7 and bool((np.abs(flat.drives[:, 0]) == 1.0).all())


def _is_independent(chain: Chain, task: Task) -> bool:
    """Check that no joint can compensate another in the task, except by the elbow motion of seven joints."""
    reach = np.where(chain.flat.joints[:, 0] == 1, 0.5, np.pi)
    qs = np.random.default_rng(1).uniform(-reach, reach, (5, len(chain)))
    Js = linearise(chain, Poses(*chain_poses(chain.flat, qs)), qs, task)[1]
    if len(task) < min(len(chain), 6):
        return False
    sizes = np.linalg.svd(Js, compute_uv=False)[:, min(len(chain), 6) - 1]
    return bool(np.median(sizes) > 1e-9)


@dataclass(frozen=True, slots=True)
class JointScrews:
    """The lines of the joints at the zero configuration, in solving order.

    Attributes:
        axes, points: Unit vectors, and a point on each line [m]; shape (n, 3) each.
        tip: Origin of the tip at zero if solving starts at the base, else of the base; shape (3,), [m].
        zero: T_0⁻¹, rotation row by row, then translation; shape (12,).
        tolerance: Distance [m] at which lines count as intersecting, and sine at which they count as parallel.
    """

    axes: Array
    points: Array
    slides: Flags
    tip: Array
    zero: Array
    backwards: bool
    tolerance: float

    def reversed(self) -> "JointScrews":
        """Return the same arm from its other end: M⁻¹ = E_n⁻¹ ⋯ E_1⁻¹."""
        return replace(
            self,
            axes=-self.axes[::-1],
            points=self.points[::-1].copy(),
            slides=self.slides[::-1].copy(),
            tip=np.zeros(3),
            backwards=True,
        )


def _screws(chain: Chain, tolerance: float) -> JointScrews:
    flat = chain.flat
    steps = [transform(row[9:], row[:9].reshape(3, 3)) for row in flat.placements]
    *lines, end = accumulate(steps, np.matmul)
    zero = inverse(end)
    return JointScrews(
        np.array([T[:3, 2] for T in lines]),
        np.array([T[:3, 3] for T in lines]),
        flat.joints[:, 0] == 1,
        end[:3, 3].copy(),
        np.append(zero[:3, :3], zero[:3, 3]),
        False,
        tolerance,
    )


def _plans(chain: Chain, tolerance: float) -> Iterator[tuple[str, SubproblemPlan]]:
    """Yield names and plans by which an arm may be solved, the best first."""
    ahead = _screws(chain, tolerance)
    n = len(chain)
    if n == 7:
        yield from _elbow_plans(ahead)
        return
    candidates: list[tuple[str, SubproblemPlan]] = []
    for screws in (ahead, ahead.reversed()):
        for last in (3, 2, 1, 0):
            candidates += _decoupled_plans(screws, last)
        candidates += _parallel_plans(screws)
    # Pairs of roots come before quartics; the sort is stable.
    yield from sorted(candidates, key=lambda candidate: candidate[1].form in {SKEW, OBLIQUE})


def _decoupled_plans(screws: JointScrews, last: int) -> Iterator[tuple[str, SubproblemPlan]]:
    """Yield plans for joints that position the point in which the last axes intersect."""
    n = len(screws.axes)
    placed = n - last
    if placed not in {0, 2, 3} or screws.slides[placed:].any():
        return
    centre = _meeting_point(screws, placed, n)
    if centre is None or not _is_positioned(screws, placed, centre):
        return
    ends = ("base", "shoulder") if screws.backwards else ("tip", "wrist")
    name = (
        f"positioning arm of {placed} joints",
        f"positioning arm of {placed} joints and a revolute joint at its {ends[0]}",
        f"positioning arm of {placed} joints and two intersecting revolute axes",
        f"spherical {ends[1]}",
    )[last]
    for order in {0: ((0, 1, 2),), 2: ((0, 1), (1, 0)), 3: ((0, 1, 2), (2, 1, 0))}[placed]:
        elimination = _elimination(screws, order) if placed else (COPLANAR, np.zeros((_LINES, 3)))
        if elimination is not None:
            form, lines = elimination
            lines[13] = centre
            lines[6] = _square_to(screws.axes[-1])
            yield name, _plan(screws, DECOUPLED, form, placed, order, lines)


def _is_positioned(screws: JointScrews, placed: int, centre: Array) -> bool:
    """Check that the first joints move a point in independent directions, so that its position determines them."""
    step, rng = 1e-5, np.random.default_rng(2)
    ranks = []
    for _ in range(5):
        q = rng.uniform(-1.0, 1.0, placed)
        columns = [
            (_carried(screws, q + step * unit, centre) - _carried(screws, q - step * unit, centre)) / (2.0 * step)
            for unit in np.eye(placed)
        ]
        ranks.append(int(np.linalg.matrix_rank(np.array(columns), tol=1e-7)) if placed else 0)
    return int(np.median(ranks)) == placed


def _carried(screws: JointScrews, q: Array, point: Array) -> Array:
    for i in reversed(range(len(q))):
        h, o = screws.axes[i], screws.points[i]
        if screws.slides[i]:
            point = point + q[i] * h
        else:
            arm, c, s = point - o, np.cos(q[i]), np.sin(q[i])
            point = o + c * arm + (1.0 - c) * (h @ arm) * h + s * np.cross(h, arm)
    return np.asarray(point)


def _plan(screws: JointScrews, kind: int, form: int, placed: int, order: Sequence[int], lines: Array) -> SubproblemPlan:
    reach = 10.0 * float(np.abs(screws.points).sum() + np.abs(screws.tip).sum() + np.abs(screws.zero[9:]).sum()) + 10.0
    return SubproblemPlan(
        kind,
        int(screws.backwards),
        form,
        placed,
        np.ascontiguousarray(screws.axes),
        np.ascontiguousarray(screws.points),
        screws.slides.astype(np.int64),
        np.array([*order, 2][:3], dtype=np.int64),
        lines,
        screws.zero,
        reach,
        np.empty((0, 0)),
    )


def _meeting_point(screws: JointScrews, first: int, n: int) -> Array | None:
    """Point in which axes `first` to n - 1 intersect, or None; tip's foot on a single axis, tip without axes; (3,)."""
    axes, points = screws.axes[first:n], screws.points[first:n]
    if len(axes) == 0:
        return screws.tip
    if len(axes) == 1:
        return np.asarray(points[0] + axes[0] * (axes[0] @ (screws.tip - points[0])))
    for a, b in pairwise(axes):
        if np.linalg.norm(np.cross(a, b)) < _CLEARLY:
            return None
    squares = [np.eye(3) - np.outer(a, a) for a in axes]
    centre = np.linalg.solve(sum(squares), sum(P @ p for P, p in zip(squares, points, strict=True)))
    apart = max(float(np.linalg.norm(P @ (centre - p))) for P, p in zip(squares, points, strict=True))
    return np.asarray(centre) if apart <= screws.tolerance else None


def _elimination(screws: JointScrews, order: Sequence[int]) -> tuple[int, Array] | None:
    """Return how to solve the positioning joints in an order of elimination, and the constants for it.

    Rows of the constants: 0-2 axes and 3-5 points in that order, 8 components of the two β along axis 2, 9 and 10
    directions perpendicular to it, 11 and 12 combinations of the two equations, 14 and 15 β (see `compositions`).
    """
    sign = 1.0 if order[0] < order[1] else -1.0
    axes, points = sign * screws.axes[list(order)], screws.points[list(order)].copy()
    slides = screws.slides[list(order)]
    (h1, h2), lines = axes[:2], np.zeros((_LINES, 3))
    if slides[1]:
        points[1] = points[0]
    elif not slides[0]:
        points[0], points[1] = _feet(points[0], h1, points[1], h2, screws.tolerance)
    lines[: len(order)], lines[3 : 3 + len(order)] = axes, points
    if slides[0]:
        across = np.cross(h1, h2)
        across = across / np.linalg.norm(across) if np.linalg.norm(across) > screws.tolerance else _square_to(h1)
        betas = np.array([across, np.cross(h1, across)])
    else:
        betas = np.array([h1, 2.0 * (points[1] - points[0])])
    lines[8, :2] = betas @ h2
    lines[14:16] = betas
    if slides[1]:
        if slides[0]:
            return (RAILS, lines) if abs(betas[1] @ h2) > screws.tolerance else None
        return (OBLIQUE if abs(h1 @ h2) > screws.tolerance else SQUARE), lines
    x = _square_to(h2)
    return _combination(lines, betas, x, np.cross(h2, x), screws.tolerance)


def _combination(lines: Array, betas: Array, x: Array, y: Array, tolerance: float) -> tuple[int, Array] | None:
    """Choose how to solve B u = b for a plane vector u of known length; the rows of B are β in the axes x, y."""
    B = np.column_stack((betas @ x, betas @ y))
    lengths = np.linalg.norm(B, axis=1)
    if lengths.max() <= tolerance:
        return None
    apart = abs(np.linalg.det(B)) / lengths.max()
    if tolerance < apart <= _CLEARLY and tolerance < _NEARLY:
        return None
    if apart > tolerance:
        lines[9], lines[10] = x, y
        lines[11:13, :2] = np.linalg.inv(B)
        return SKEW, lines
    strongest = int(np.argmax(lengths))
    e = B[strongest] / lengths[strongest]
    along = B @ e
    lines[9], lines[10] = e[0] * x + e[1] * y, e[0] * y - e[1] * x
    lines[11, :2] = np.array([-along[1], along[0]]) / np.linalg.norm(along)
    lines[12, :2] = along / (along @ along)
    return COPLANAR, lines


def _parallel_plans(screws: JointScrews) -> Iterator[tuple[str, SubproblemPlan]]:
    """Yield the plan for six revolute joints whose axes 2, 3 and 4 are parallel."""
    if len(screws.axes) != 6 or screws.slides.any():
        return
    h = screws.axes[1]
    if np.linalg.norm(np.cross(screws.axes[2:4], h), axis=1).max() > screws.tolerance:
        return
    points = screws.points.copy()
    feet = _feet(points[4], screws.axes[4], points[5], screws.axes[5], screws.tolerance)
    points[5] = feet[1]
    if np.linalg.norm(feet[1] - feet[0]) <= screws.tolerance:
        points[4] = feet[0]
    screws = replace(screws, points=points)
    h5, lines = screws.axes[4], np.zeros((_LINES, 3))
    for k, (start, arm) in enumerate(((h @ points[4], points[5] - points[4]), (0.0, screws.axes[5]))):
        axial = (h @ h5) * (h5 @ arm)
        lines[14 + k] = start + axial, h @ arm - axial, h @ np.cross(h5, arm)
    # The plane vector u is (cos q_5, sin q_5).
    combined = _combination(lines, lines[14:16] @ np.eye(3)[:, [1, 2, 0]], np.eye(3)[0], np.eye(3)[1], screws.tolerance)
    if combined is not None:
        lines[6] = _square_to(h)
        yield "three parallel axes", _plan(screws, PARALLEL, combined[0], 3, (0, 1, 2), lines)


def _general_plan(screws: JointScrews) -> SubproblemPlan:
    lines = np.zeros((_LINES, 3))
    points = screws.points.copy()
    for i in range(5):
        _, points[i + 1] = _feet(points[i], screws.axes[i], points[i + 1], screws.axes[i + 1], screws.tolerance)
    size = 1.0 / max(float(np.linalg.norm(points - points[2], axis=1).max()), 1e-9)
    lines[:6] = size * (points - points[2])
    lines[6], lines[7], lines[8, 0] = _square_to(screws.axes[5]), points[2], size
    plan = _plan(replace(screws, points=points), GENERAL, SKEW, 3, (0, 1, 2), lines)
    return plan._replace(terms=left_sides(plan.axes, np.ascontiguousarray(lines[:6])))


def _elbow_plans(screws: JointScrews) -> Iterator[tuple[str, SubproblemPlan]]:
    """Yield the plan for seven revolute joints with a spherical shoulder and wrist."""
    if screws.slides.any():
        return
    shoulder, wrist = _meeting_point(screws, 0, 3), _meeting_point(screws, 4, 7)
    if shoulder is None or wrist is None:
        return
    points, lines = screws.points.copy(), np.zeros((_LINES, 3))
    h4 = screws.axes[3]
    points[3] += h4 * (h4 @ (shoulder - points[3]))
    if np.linalg.norm(points[3] - shoulder) <= screws.tolerance:
        return
    lines[3], lines[13] = shoulder, wrist
    lines[6], lines[7] = _square_to(screws.axes[6]), _square_to(screws.axes[2])
    yield "spherical shoulder and wrist", _plan(replace(screws, points=points), ELBOW, COPLANAR, 3, (0, 1, 2), lines)


def _feet(p: Array, a: Array, q: Array, b: Array, tolerance: float) -> tuple[Array, Array]:
    """Closest points of two lines; for parallel ones, p and its foot on the second line; shape (3,) each."""
    normal = np.cross(a, b)
    square = float(normal @ normal)
    if square <= tolerance**2:
        return p, np.asarray(q + b * (b @ (p - q)))
    between = q - p
    s, t = np.cross(between, b) @ normal / square, np.cross(between, a) @ normal / square
    first, second = p + s * a, q + t * b
    if np.linalg.norm(second - first) <= tolerance:
        # The lines intersect: use one point for both.
        first = second = 0.5 * (first + second)
    return np.asarray(first), np.asarray(second)


def _square_to(h: Array) -> Array:
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(h)))], h)
    return np.asarray(x / np.linalg.norm(x))


def _found_again(form: ClosedForm, count: int) -> int:
    """Count random configurations that are among the branches of their own poses, with no joint left free.

    The plan does not determine a joint that is always free, so it would not find solutions from other seeds.
    """
    qs, table = _trial(form, count)
    free = np.add.reduceat(np.append(table.free, 0), table.firsts[:-1]) * (np.diff(table.firsts) > 0)
    return sum(_row_of(form.chain, table, i, q) >= 0 and not free[i] for i, q in enumerate(qs))


def _trial(form: ClosedForm, count: int) -> tuple[Array, BranchTable]:
    """Draw random configurations and solve their poses from other seeds."""
    chain = form.chain
    reach = np.where(chain.flat.joints[:, 0] == 1, 0.5, np.pi)
    draws = np.random.default_rng(0).uniform(-reach, reach, (2, count, len(chain)))
    qs, seeds = mid_range(chain) + draws
    return qs, _branches_of(form, qs, seeds)


def _branches_of(form: ClosedForm, qs: Array, seeds: Array) -> BranchTable:
    poses = Poses(*chain_poses(form.chain.flat, qs))
    elbows = form.elbow_angles(qs) if form.has_free_elbow else None
    return form.solve(poses, seeds, respect_limits=False, elbow_angles=elbows)


def _row_of(chain: Chain, table: BranchTable, i: int, q: Array) -> int:
    """Return the row of configuration q among the branches of target i in the table; -1 if it is missing."""
    first, last = table.firsts[i], table.firsts[i + 1]
    differences = whole_turns_removed(chain, table.qs[first:last] - q)
    near = np.flatnonzero(np.abs(differences).max(axis=1, initial=0.0) <= _FOUND_AGAIN)
    return int(first + near[0]) if len(near) else -1


def _roots(plan: SubproblemPlan) -> dict[str, int]:
    """Return the code bits of the shoulder, elbow and wrist choices that the arm has."""
    ends = ("wrist", "shoulder") if plan.backwards else ("shoulder", "wrist")
    if plan.kind == PARALLEL:
        roots = {"elbow": SECOND_ROOT}
        return roots if plan.form == SKEW else {ends[0]: FIRST_ROOT, **roots, ends[1]: LAST_ROOT}
    if plan.kind == ELBOW:
        return {"shoulder": ARM_ROOT, "elbow": SECOND_ROOT, "wrist": LAST_ROOT}
    parallel = np.linalg.norm(np.cross(plan.lines[0], plan.lines[1])) <= _NEARLY
    # Names of the first and the second root of three positioning joints; of two there is only the second.
    names = {
        COPLANAR: (ends[0], "elbow") if parallel else ("elbow", ends[0]),
        SQUARE: ("elbow", ends[0]),
        RAILS: ("elbow",),
    }.get(plan.form, ())
    roots = dict(zip(names, (FIRST_ROOT, SECOND_ROOT), strict=False)) if plan.placed == 3 else {}
    if plan.placed == 2 and len(names) == 2:
        roots = {names[1]: SECOND_ROOT}
    if len(plan.axes) - plan.placed == 3:
        roots[ends[1]] = LAST_ROOT
    return roots


def _choices(form: ClosedForm) -> tuple[Choice, ...]:
    """Name the roots by trial.

    The shoulder is `front` in the branch of the mid-range configuration. The elbow is `up` where the joints lie higher
    along the base's z or, at equal heights, where the sine of the elbow joint is smaller. The wrist is `no_flip` where
    the sine of its middle joint is positive.
    """
    roots = _roots(form.plan)
    qs, table = _trial(form, _NAMING)
    rows = np.array([_row_of(form.chain, table, i, q) for i, q in enumerate(qs)])
    qs, codes, all_codes = qs[rows >= 0], table.codes[rows[rows >= 0]], table.codes
    choices = []
    if form.plan.kind != ELBOW and form.plan.form in {SKEW, OBLIQUE} and form.plan.placed == 3:
        choices.append(Choice("arm", 0))
    shoulder = roots.get("shoulder", 0)
    for name, bit in roots.items():
        if len(np.unique(all_codes & bit)) < 2:
            continue  # The two roots always coincide.
        is_set, turned_by, turns = (codes & bit) != 0, 0, False
        if name == "shoulder":
            # The tenth of the configurations that is nearest to mid-range.
            distances = np.square(qs - mid_range(form.chain)).sum(axis=1)
            first = _mostly(is_set[distances <= np.quantile(distances, 0.1)])
        elif name == "wrist":
            first = _mostly(is_set[_middle_of_wrist(form, qs) > 0.0])
        else:
            higher, back, turned_by = _elbow_heights(form, qs, codes, bit), (codes & shoulder) != 0, shoulder
            first = _mostly(is_set[higher & ~back])
            turns = bool(shoulder) and first != _mostly(is_set[higher & back])
        choices.append(Choice(name, bit, _VALUES[name][::-1] if first else _VALUES[name], turned_by, turns))
    return tuple(choices)


def _mostly(flags: Flags) -> bool:
    return bool(len(flags)) and float(flags.mean()) > 0.5


def _middle_of_wrist(form: ClosedForm, qs: Array) -> Array:
    """Sine of the middle wrist joint, or of joint 5 of an arm with three parallel axes; shape (N,)."""
    if form.plan.kind == PARALLEL:
        j = 1 if form.plan.backwards else 4
    else:
        j = -2 if _roots(form.plan).get("wrist") == LAST_ROOT else -1 - int(form.plan.order[0])
    return np.asarray(np.sin(qs[:, j]))


def _elbow_heights(form: ClosedForm, qs: Array, codes: Array, bit: int) -> Flags:
    """Flag configurations whose elbow is higher than in the branch that differs in its bit alone; shape (N,)."""
    higher = np.zeros(len(qs), dtype=bool)
    table = _branches_of(form, qs, qs)
    for i, q in enumerate(qs):
        part = slice(table.firsts[i], table.firsts[i + 1])
        other = np.flatnonzero(table.codes[part] == (codes[i] ^ bit))
        if len(other):
            own, others = _heights(form, np.stack((q, table.qs[part][other[0]])))
            higher[i] = own > others
    return higher


def _heights(form: ClosedForm, qs: Array) -> Array:
    """Sum of the joints' heights along the base's z, with the sine of the elbow joint as a tie-breaker; shape (N,)."""
    flat, heights = form.chain.flat, np.zeros(len(qs))
    at_joint = np.append(np.eye(3), np.zeros(3))
    for k in range(1, len(flat.joints) + 1):
        part = FlatChain(np.vstack((flat.placements[:k], at_joint)), flat.joints[:k], flat.drives[:k])
        heights += chain_poses(part, qs)[0][:, 2]
    elbow = int(form.plan.order[1])
    return heights - 1e-6 * np.sin(qs[:, -1 - elbow if form.plan.backwards else elbow])


def _fits(form: ClosedForm) -> bool:
    """Check that a plan gives all solutions of the task: a full pose, or one with as many directions as joints."""
    n, plan, wanted = len(form.chain), form.plan, frozenset(form.task.directions)
    if len(wanted) == 6:
        return True
    # Solving from the tip would use the target's full orientation.
    if plan.kind != DECOUPLED or n != len(wanted) or plan.backwards:
        return False
    if n == 3 and wanted in {frozenset("xyz"), frozenset(("rx", "ry", "rz"))}:
        return plan.placed == (3 if "x" in wanted else 0)
    k = _plane_of(form)
    if k is None:
        return False
    whole = frozenset({*"xyz", "r" + "xyz"[k]})
    return wanted == whole or (not plan.slides.any() and wanted in {whole - {"xyz"[k]}, frozenset("xyz") - {"xyz"[k]}})


def _plane_of(form: ClosedForm) -> int | None:
    """Return the index of the base axis parallel to all joint axes; None if there is none."""
    k = int(np.argmax(np.abs(form.plan.axes[0])))
    along = np.abs(form.plan.axes @ np.eye(3)[k])
    return k if (along >= 1.0 - _NEARLY**2).all() else None


def _in_reach_of(form: ClosedForm, rows: Array) -> Array:
    """Move the targets of a planar task into the plane of the arm; shape (N, 12)."""
    wanted = form.task.directions
    if len(wanted) == 6 or {*"xyz"} <= set(wanted) or not {"x", "y"} & set(wanted):
        return rows
    k = next(i for i in range(3) if "xyz"[i] not in wanted)
    rows = rows.copy()
    rows[:, 9 + k] = chain_poses(form.chain.flat, np.zeros((1, len(form.chain))))[0][0, k]
    return rows
