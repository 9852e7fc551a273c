"""All solutions of any six joints, followed from a known target to the requested one and proved complete by counting.

Joint values and targets may be complex. Then all targets but special ones have the same number of solutions, 16 for
six revolute joints of general geometry [Raghavan1993], and no target has more isolated ones. Paths lead from the
solutions of one target to those of any other [Morgan1989]. Along a loop of targets the solutions permute, so that one
leads to all [Sommese2005]. If the requested target has that many isolated solutions, they are all, however found.

Loops solve one arm of each combination of joint types; paths lead from it to each arm, and from that to each target.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gelenk.ik.closed.closed_form import screws_of_six
from gelenk.ik.count.homotopy import JOINTS, ComplexArray, follow
from gelenk.ik.count.special import drawn, geometry, reaches
from gelenk.ik.search.problem import TargetProblem
from gelenk.ik.search.words import DIRECTIONS
from gelenk.ik.verdict.branches import SEARCHED, Branches, sorted_by_distance, wound_near
from gelenk.ik.verdict.near_singular import with_partners
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses

_GENERAL = (16, 16, 8, 2)
"""Solutions of six joints of general geometry, by the number of prismatic joints [Mavroidis1994]."""
_LOOPS, _BARREN = 60, 3
"""Most loops, and the number of loops without a new solution that ends the search."""
_LONGEST = (0.05, 0.01)
"""Largest corrections of the first and the second try [rad or sizes of the arm]."""
_FAR = 18.0
"""Imaginary part that counts as infinity: beyond it only rounding is left [rad]."""
_ALONE, _ALONE_FAR = 1e-8, 1e-4
"""Largest last Newton step at an isolated solution: near real values, and far away, where numbers are large."""
_APART, _APART_STEPS = 1e-5, 1e3
"""Distance beyond which solutions are different: absolute [rad or sizes of the arm], and in last Newton steps."""
_AROUND = 0.3
"""Largest imaginary part of a place that may lead to a real solution [rad or sizes of the arm]."""
_EXACTLY, _NEARLY = 1e-12, tuple(10.0**-k for k in range(11, 1, -1))
"""Sines and distances [sizes of the arm] that count as zero by rounding, and those that make an arm nearly special."""
_SEEDS = (11, 12, 13)
"""Random seeds of the targets at which all solutions of an arm are sought."""

_ROUNDING = 1e-14
"""Largest error of a refined solution next to a singularity [m, rad]."""
_AS_IT_IS = np.eye(4)


class Arm(NamedTuple):
    """An arm in complex numbers, a target, and its known solutions.

    Attributes:
        screws: Axes, then points, in sizes of the arm; shape (12, 3).
        slides: 1 for a prismatic joint; shape (6,).
        target: Quaternion w x y z and position; shape (7,).
        starts: Solutions of the target; shape (k, 6).
    """

    screws: ComplexArray
    slides: Indices
    target: ComplexArray
    starts: ComplexArray


class Special(NamedTuple):
    """An exactly special arm that replaces one of nearly special geometry.

    Attributes:
        arm: The special arm, with all its solutions of some target.
        by: Transform that converts targets: (target of the other arm) · by = target of this one; shape (4, 4).
        off: Largest deviation of that over all joint values: angle [rad], and distance [sizes of the arm].
    """

    arm: Arm
    by: Array
    off: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Continuation:
    """A solver for all solutions of an arm with six joints.

    Attributes:
        zero: T_0⁻¹, rotation row by row, then translation; shape (12,).
        centre, size: Origin of the scaled coordinates in the base, shape (3,), and size of the arm, [m].
        arm: The arm in scaled coordinates, with solutions of some target.
        is_counted: Whether these are as many as an arm with the same special geometry has.
        special: An exactly special arm with the full count, used if `is_counted` is False; may be None.
    """

    chain: Chain
    zero: Array
    centre: Array
    size: float
    arm: Arm
    is_counted: bool
    special: Special | None

    def solve(self, target: Poses) -> tuple[Array, str]:
        """Solve one target; return configurations (k, 6) and why there may be others, or "" if proved complete.

        Without that proof, the configurations may be only near solutions.
        """
        goal = self._goal(target)
        if self.special is not None:
            start = self._goal(target, self.special.by)
            ends, near = self._ends(self.special.arm, start, _LONGEST)
            qs = self._carried(self.special, start, goal, ends)
            if qs is not None:
                return self._variables(qs), ""
        else:
            ends, near = self._ends(self.arm, goal, _LONGEST if self.is_counted else _LONGEST[:1])
            if self.is_counted and len(ends) == len(self.arm.starts):
                return self._variables(ends[np.abs(ends.imag).max(axis=1) <= _APART].real), ""
        qs = self._variables(near[np.abs(near.imag).max(axis=1) <= _AROUND].real)
        if not self.is_counted:
            return qs, "the arm has nearly special geometry: rounding may have lost real solutions"
        return qs, (
            f"{min(len(ends), len(self.arm.starts))} of the {len(self.arm.starts)} complex solutions are isolated at "
            "this target; the others meet at a singularity or are lost near one"
        )

    def _ends(self, arm: Arm, goal: ComplexArray, tries: tuple[float, ...]) -> tuple[ComplexArray, ComplexArray]:
        """Follow an arm's solutions to a target; return the isolated ends, and all ends of all tries."""
        found, places = _Ends(), []
        for longest in tries:
            ends, steps = follow(
                np.stack((arm.screws, arm.screws)), np.stack((arm.target, goal)), arm.slides, arm.starts, longest, _FAR
            )
            found = found.joined(ends, steps, arm.slides)
            places.append(ends)
            if found.alone.sum() == len(arm.starts):
                break
        return found.qs[found.alone], np.concatenate(places)

    def _carried(self, special: Special, start: ComplexArray, goal: ComplexArray, qs: ComplexArray) -> Array | None:
        """Carry the real solutions of the special arm over to the arm; None if that may miss or add solutions.

        In a solution of the arm, the special arm reaches a pose next to its own target. If no two of its solutions
        meet as its target moves that far, each has exactly one solution of the arm near it, and there is no other.
        """
        is_whole = len(qs) == len(special.arm.starts)
        boxes = reaches(special.arm.screws, special.off, qs) if is_whole else None
        if boxes is None:
            return None
        real = (np.abs(qs.imag) <= boxes).all(axis=1)
        # Either sign of a quaternion is the same rotation.
        start[:4] *= np.sign((start[:4] * goal[:4]).real.sum())
        screws, targets = np.stack((special.arm.screws, self.arm.screws)), np.stack((start, goal))
        ends, steps = follow(screws, targets, self.arm.slides, qs[real].real.astype(complex), _LONGEST[1], _FAR)
        is_near = (np.abs(ends - qs[real]) <= boxes[real] + _ALONE).all() and (np.abs(ends.imag) <= _APART).all()
        return ends.real if is_near and (steps <= _ALONE).all() else None

    def _variables(self, values: Array) -> Array:
        """Convert joint values, with prismatic ones in sizes of the arm, to variables of the chain [rad or m]."""
        drives, units = self.chain.flat.drives, np.where(self.arm.slides == 1, self.size, 1.0)
        return np.asarray((values * units - drives[:, 1]) * drives[:, 0])

    def _goal(self, target: Poses, by: Array = _AS_IT_IS) -> ComplexArray:
        R = target.rotations[0] @ self.zero[:9].reshape(3, 3)
        p = target.positions[0] + target.rotations[0] @ self.zero[9:]
        p = (p + R @ self.centre - self.centre) / self.size + R @ by[:3, 3]
        return np.append(_quaternion((R @ by[:3, :3]).astype(complex)), p)


class _Ends(NamedTuple):
    """Ends of paths, the lengths of their last Newton steps [rad or sizes of the arm], and flags of isolated ends."""

    qs: ComplexArray = np.empty((0, JOINTS), dtype=complex)
    steps: Array = np.empty(0)
    alone: Flags = np.zeros(0, dtype=bool)

    def joined(self, qs: ComplexArray, steps: Array, slides: Indices) -> "_Ends":
        """Merge further ends and their conjugates, which also solve a real target, without duplicates."""
        good = np.isfinite(steps)
        qs = np.concatenate((self.qs, qs[good], qs[good].conj()))
        steps = np.concatenate((self.steps, steps[good], steps[good]))
        order = np.argsort(steps, kind="stable")
        chosen = order[_distinct(qs[order], steps[order], slides)]
        qs, steps = qs[chosen], steps[chosen]
        far = np.exp(2.0 * np.abs(qs.imag * (slides == 0)).max(axis=1, initial=0.0))
        return _Ends(qs, steps, steps <= np.minimum(_ALONE * far, _ALONE_FAR))


def counted(problem: TargetProblem, i: int, system: Continuation, search: Callable[[], Branches] | None) -> Branches:
    """Find all solutions of one target within the limits, nearest to the seed first, see `Continuation.solve`.

    If the proof fails, add those of `search`, if given.
    """
    qs, doubt = system.solve(problem.target(i))
    if doubt:
        other = search() if search else Branches(qs[:0], doubt)
        if search and other.doubt != SEARCHED:
            return other
        found = with_partners(problem, i, np.concatenate((qs, other.qs)), _ROUNDING * (1.0 + system.size))
        qs = found if len(found) else other.qs
    else:
        qs = within_limits(problem, i, qs)
    return Branches(sorted_by_distance(qs, problem.seed(i)), doubt)


def within_limits(problem: TargetProblem, i: int, qs: Array) -> Array:
    """Turn solutions by full turns into the limits, and keep those that fit; shape (k, n), [rad or m]."""
    lower, upper = problem.limits
    qs = wound_near(problem.chain, qs, problem.seed(i), lower, upper)
    return np.asarray(qs[((qs >= lower) & (qs <= upper)).all(axis=1)])


def system_of(problem: TargetProblem) -> Continuation | None:
    """Return the continuation that counts all solutions; None if the chain or the task has none."""
    return continuation(problem.chain) if len(problem.task) == len(DIRECTIONS) else None


@lru_cache(maxsize=256)
def continuation(chain: Chain) -> Continuation | None:
    """Return the continuation of six independent joints; None for other chains or without isolated solutions."""
    screws = screws_of_six(chain)
    if screws is None:
        return None
    axes, points, slides = screws.axes, screws.points, tuple(screws.slides.tolist())
    centre = points.mean(axis=0)
    points = points - ((points - centre) * axes).sum(axis=1)[:, None] * axes
    size = max(float(np.abs(points - centre).max()), 0.1 * float(np.abs(screws.tip - centre).max()), 1e-3)
    points = (points - centre) / size
    most = _count(geometry(axes, points, _EXACTLY).kind(), slides)
    arm = _arm(slides, axes, points, most)
    if not len(arm.starts):
        return None
    is_counted = len(arm.starts) >= most
    special = None if is_counted or any(slides) else _special(axes, points)
    return Continuation(chain, screws.zero, centre, size, arm, is_counted, special)


def _special(axes: Array, points: Array) -> Special | None:
    """Find the nearest exactly special arm with a full count of solutions, for an arm of revolute joints."""
    slides, before = (False,) * JOINTS, geometry(axes, points, _EXACTLY)
    for tolerance in _NEARLY:
        near = geometry(axes, points, tolerance)
        if near.kind() != before.kind():
            lines, most = near.lines(), _count(near.kind(), slides)
            arm = _arm(slides, *lines[:2], most)
            if len(arm.starts) >= most:
                return Special(arm, near.last @ np.linalg.inv(lines[2]), near.off)
        before = near
    return None


@lru_cache(maxsize=256)
def _count(kind: tuple[tuple[float, ...], ...], slides: tuple[bool, ...]) -> int:
    """Number of solutions of an arm of a special kind, counted on a random arm without other special properties."""
    return len(_arm(slides, *drawn(kind, slides, np.random.default_rng(3)), _general_count(slides)).starts)


def _arm(slides: tuple[bool, ...], axes: Array, points: Array, most: int) -> Arm:
    """Solve an arm at some target from an arm of general geometry, without solutions at infinity."""
    general, lines = _general(slides), np.concatenate((axes, points)).astype(complex)
    found: list[Arm] = []
    for seed in _SEEDS:
        rng = np.random.default_rng(seed)
        target = _drawn_target(rng)
        screws, targets = np.stack((general.screws, lines)), np.stack((general.target, target))
        ends, steps = follow(screws, targets, general.slides, general.starts, _LONGEST[1], _FAR)
        reached = _distinct(ends, np.where(steps <= _ALONE_FAR, steps, np.inf), general.slides)
        found.append(_with_loops(Arm(lines, general.slides, target, ends[reached]), rng, most))
        if len(found[-1].starts) >= most:
            break
    return max(found, key=lambda arm: len(arm.starts))


@lru_cache(maxsize=64)
def _general(slides: tuple[bool, ...]) -> Arm:
    """Build an arm of general geometry, with all its solutions of some target."""
    rng = np.random.default_rng(5)
    flags = np.array(slides, dtype=np.int64)
    axes, points = _drawn(rng, (JOINTS, 3), 0.5), _drawn(rng, (JOINTS, 3), 0.5)
    axes /= np.sqrt((axes * axes).sum(axis=1))[:, None]
    q = _drawn(rng, JOINTS, 0.4)
    R, p = np.eye(3, dtype=complex), np.zeros(3, dtype=complex)
    for h, o, slide, angle in zip(axes, points, slides, q, strict=True):
        cross = np.cross(h, np.eye(3)).T
        turn = np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
        p = p + R @ (angle * h if slide else o - turn @ o)
        R = R if slide else R @ turn
    arm = Arm(np.concatenate((axes, points)), flags, np.append(_quaternion(R), p), q[None])
    return _with_loops(arm, rng, _general_count(slides))


def _general_count(slides: tuple[bool, ...]) -> int:
    return _GENERAL[sum(slides)]


def _with_loops(arm: Arm, rng: np.random.Generator, most: int) -> Arm:
    """Add the solutions of an arm that its known ones reach along loops of the target."""
    starts, barren, screws = arm.starts, 0, np.stack((arm.screws, arm.screws))
    for _ in range(_LOOPS):
        if len(starts) in {0, most} or barren == _BARREN:
            break
        qs, stops = starts, (arm.target, _drawn_target(rng), _drawn_target(rng), arm.target)
        for k in range(3):
            qs, steps = follow(screws, np.stack(stops[k : k + 2]), arm.slides, qs, _LONGEST[0], _FAR)
            qs = qs[steps <= _ALONE]
        together = np.concatenate((starts, qs))
        together = together[_distinct(together, np.zeros(len(together)), arm.slides)]
        barren = barren + 1 if len(together) == len(starts) else 0
        starts = together
    return arm._replace(starts=np.ascontiguousarray(starts))


def _distinct(qs: ComplexArray, steps: Array, slides: Indices) -> list[int]:
    """Indices of distinct solutions, without those whose last step is infinite."""
    chosen: list[int] = []
    for i in np.flatnonzero(np.isfinite(steps)).tolist():
        apart = qs[chosen] - qs[i]
        apart -= np.where(slides == 1, 0.0, 2.0 * np.pi * np.rint(apart.real / (2.0 * np.pi)))
        close = np.maximum(_APART, _APART_STEPS * np.maximum(steps[chosen], steps[i]))
        if (np.abs(apart).max(axis=1, initial=0.0) > close).all():
            chosen.append(i)
    return chosen


def _drawn(rng: np.random.Generator, shape: int | tuple[int, ...], imaginary: float) -> ComplexArray:
    return np.asarray(rng.normal(size=shape) + 1j * imaginary * rng.normal(size=shape))


def _drawn_target(rng: np.random.Generator) -> ComplexArray:
    return np.append(_drawn(rng, 4, 1.0), 0.6 * _drawn(rng, 3, 1.0))


def _quaternion(R: ComplexArray) -> ComplexArray:
    """Quaternion w x y z of a real or complex rotation, up to a factor: the longest row of its products."""
    w = np.array([1.0 + np.trace(R), R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    products = np.empty((4, 4), dtype=complex)
    products[0], products[:, 0] = w, w
    products[1:, 1:] = R + R.T + (1.0 - np.trace(R)) * np.eye(3)
    return np.asarray(products[int(np.argmax(np.linalg.norm(products, axis=1)))])
