"""Compares the solutions by hand with those that are sent, and puts the steps together; says how others were found."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gelenk.course.inverse.arm import ByHand, HandArm, HandSolution, HandTarget
from gelenk.course.inverse.by_hand import prepared, solver_of
from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, difference, matrix, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.poses import inverse

AGREEMENT = 1e-9
"""Largest difference of a joint by hand from the one that is sent, and of its pose from the target, [rad, m]."""


@dataclass(frozen=True, slots=True)
class SentSolutions:
    """What is sent for a target.

    Attributes:
        pose: The target, T_base_tip; shape (4, 4).
        directions: Those that count.
        solutions: The solutions that are sent; shape (k, n), [rad or m].
    """

    pose: Array
    directions: frozenset[str]
    solutions: Array


def hand_steps(arm: HandArm, sent: SentSolutions) -> list[Step] | None:
    """Return the solution by hand; None if there is none, or if it does not lead to what is sent."""
    solve = solver_of(arm, sent.directions)
    if solve is None:
        return None
    turned = prepared(arm)
    guess = np.zeros(len(arm.rows)) if not len(sent.solutions) else turned.values(sent.solutions[0])
    pose = inverse(turned.base) @ sent.pose
    found = solve(turned, HandTarget(pose, sent.directions, guess))
    listed = _confirmed(turned, sent, found)
    if listed is None:
        return None
    return [*_start(turned, sent.pose, pose), *found.steps, *listed]


def _confirmed(arm: HandArm, sent: SentSolutions, found: ByHand) -> list[Step] | None:
    """Return the step that lists the solutions; None if one does not hold, or one that is sent is not among them."""
    kept: list[tuple[HandSolution, bool]] = []
    left = [arm.values(q) for q in sent.solutions]
    has_family = found.is_family or any(np.isnan(solution.values).any() for solution in found.solutions)
    for solution in found.solutions:
        matching = [values for values in left if _agrees(arm, solution, values)]
        filled = arm.pose(solution.filled(matching[0] if matching else np.zeros(len(arm.rows))))
        if matching or _meets(filled, sent):
            kept.append((solution, bool(matching)))
        elif len(sent.directions) == 6 and len(arm.rows) >= 6:
            return None
    alone = [values for values in left if not any(_agrees(arm, one, values) for one, _sent in kept)]
    if (alone and not (has_family and kept)) or (len(sent.solutions) and not kept):
        return None
    if kept:
        return [_list_step(arm, sent, kept)]
    return [_none_step()] if found.solutions else []


def _agrees(arm: HandArm, solution: HandSolution, values: Array) -> bool:
    known = ~np.isnan(solution.values)
    gap = difference(solution.values, values, arm.slides)[known]
    if solution.pair is not None:
        i, j, sign, total = solution.pair
        gap = np.append(gap, math.remainder(values[i] + sign * values[j] - total, 2.0 * math.pi))
    return bool((np.abs(gap) <= AGREEMENT).all())


def _meets(pose: Array, sent: SentSolutions) -> bool:
    """Check whether a pose agrees with the target in the directions that count."""
    R, wanted = pose[:3, :3], sent.pose
    turn = wanted[:3, :3].T @ R
    turned = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    if np.trace(turn) < 1.0:
        turned = np.ones(3)
    errors = dict(zip(("x", "y", "z"), pose[:3, 3] - wanted[:3, 3], strict=True))
    if len(sent.directions & {"rx", "ry", "rz"}) == 3:
        errors |= dict(zip(("rx", "ry", "rz"), turned, strict=True))
    return all(abs(errors.get(name, 0.0)) <= AGREEMENT for name in sent.directions)


def _start(arm: HandArm, pose: Array, in_table: Array) -> list[Step]:
    """Return the steps that write the target in frame 0, and relate the table's angles to the joints."""
    steps = []
    relations = arm.relations()
    if relations:
        text = _("The formulas use the angles of the DH table, with parallel axes turned to point the same way.")
        steps.append(step(_("Angles of the table"), text, *relations))
    if np.abs(pose - in_table).max() > ROUNDING:
        text = _("The base transform of the table is taken off.")
        steps.append(step(_("Target in frame 0"), text, rf"p = {vector(in_table[:3, 3])}",
                          rf"R = {matrix(in_table[:3, :3])}"))  # fmt: skip
    return steps


def _list_step(arm: HandArm, sent: SentSolutions, kept: Sequence[tuple[HandSolution, bool]]) -> Step:
    lines = []
    for solution, is_sent in kept:
        known = ~np.isnan(solution.values)
        shown = arm.positions(np.where(known, solution.values, 0.0))
        if is_sent:
            values = next(arm.values(q) for q in sent.solutions if _agrees(arm, solution, arm.values(q)))
            shown = arm.positions(values - np.nan_to_num(difference(values, solution.values, arm.slides)))
        else:
            shown = np.array([x if slide else wrapped(x) for x, slide in zip(shown.tolist(), arm.slides, strict=True)])
        text = vector(shown) if known.all() else _with_gaps(shown, known)
        lines.append(("" if is_sent else r"\star\; ") + f"q = {text}")
    text = _("Each solution is put into the forward kinematics of the table, which gives the target again.")
    if not all(is_sent for _solution, is_sent in kept):
        text += " " + _("A star marks those that are not sent: beyond the limits, or not the one that was asked for.")
    if any(np.isnan(solution.values).any() for solution, _sent in kept):
        text += " " + _("A dot stands for a joint that is free.")
    return step(_("All solutions"), text, *lines)


def _none_step() -> Step:
    text = _("None of these gives the target in the forward kinematics: the arm cannot have all that is asked of it.")
    return step(_("No solution"), text)


def _with_gaps(shown: Array, known: Array) -> str:
    parts = [vector([x])[1:-1] if is_known else r"\cdot" for x, is_known in zip(shown.tolist(), known, strict=True)]
    return "(" + r",\; ".join(parts) + ")"


_SHOWN = 8


def solver_step(
    closed_form: str | None, method: str, solutions: Array, branches: Sequence[Mapping[str, str | int]]
) -> Step:
    """Return the step that says how solutions were found.

    Args:
        closed_form: Name of the geometry or the method that solved the arm; None after a search.
        method: Name of the iteration otherwise.
        solutions: What is sent, shape (k, n), [rad or m].
        branches: The names of their branches; none after a search.
    """
    text, equation = _geometry(closed_form, method)
    lines = [equation] if equation else []
    for q, branch in zip(solutions[:_SHOWN].tolist(), branches[:_SHOWN], strict=False):
        names = ", ".join(f"{choice} {value}" for choice, value in branch.items()).replace("_", " ")
        lines.append(f"q = {vector(q)}" + (rf"\quad \text{{{names}}}" if names else ""))
    return step(_("How it was solved"), text, *lines)


def _geometry(closed_form: str | None, method: str) -> tuple[str, str]:
    """Return why there is a solution in closed form, or that there is none, and the equation that fixes a joint."""
    if closed_form in {"spherical wrist", "spherical shoulder"}:
        text = _("Three axes meet in a point that their angles do not move: the other three joints must bring it here.")
        return text, r"p_w(q) = p - R\, w"
    if closed_form == "spherical shoulder and wrist":
        text = _("Shoulder and wrist are points, whose distance fixes the elbow; its turn about their line is free.")
        return text, r"\lVert p_w - p_s \rVert^2 = l_1^2 + l_2^2 + 2 l_1 l_2 \cos \psi_4"
    if closed_form is None:
        text = _("An iteration from a first guess found these numbers ({method}); `trace` shows all of it.")
        return text.format(method=method), ""
    if closed_form.startswith("six"):
        return _("This arm has no solution by hand: all joints but one are eliminated, or solutions are followed."), ""
    return _("The geometry of the axes gives the angles one by one, but not by the lecture's formulas."), ""
