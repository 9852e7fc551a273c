"""Which solution by hand an arm has."""

import math
from collections.abc import Callable

import numpy as np

from gelenk.course.inverse.arm import STRAIGHT, ArmRow, ByHand, HandArm, HandSolution, HandTarget
from gelenk.course.inverse.parallel import by_three_parallel, fits_three_parallel
from gelenk.course.inverse.planar import by_planar, fits_planar
from gelenk.course.inverse.shoulder import behind_third, placed
from gelenk.course.inverse.wrist import centre_step, wrist_formulas, wrist_numbers, wrist_text, zyz_angles
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix, number
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_POSITION = frozenset("xyz")
_ROTATION = frozenset({"rx", "ry", "rz"})


def solver_of(arm: HandArm, directions: frozenset[str]) -> Callable[[HandArm, HandTarget], ByHand] | None:
    """Return what solves an arm by hand for a task; None if nothing here does."""
    if fits_planar(arm, directions):
        return by_planar
    if fits_three_parallel(arm, directions):
        return by_three_parallel
    n = len(arm.rows)
    if n == 3 and directions >= _POSITION and _places(arm.rows) and _bends(arm, arm.tool[:3, 3]):
        return _by_shoulder
    if n == 3 and directions >= _ROTATION and _turns(arm.rows):
        return _by_wrist
    if n == 6 and len(directions) == 6 and _places(arm.rows) and _turns(arm.rows[3:]):
        return _by_decoupling if _bends(arm, _wrist_in_three(arm)) else None
    return None


def prepared(arm: HandArm) -> HandArm:
    """Turn the axes of an arm as its solution needs them."""
    rows, wanted = arm.rows, {}
    if fits_three_parallel(arm, _POSITION | _ROTATION):
        return arm.turned({1: 0.0, 2: 0.0, 3: -0.5 * math.pi, 4: 0.5 * math.pi})
    if len(rows) >= 3 and _places(rows) and not rows[2].slides:
        wanted[1] = 0.0
    first = 3 if len(rows) == 6 else 0
    if _turns(rows[first:]):
        wanted |= {first: -0.5 * math.pi, first + 1: 0.5 * math.pi}
    return arm.turned(wanted) if wanted else arm.turned(dict.fromkeys(range(len(rows) - 1), 0.0))


def _places(rows: tuple[ArmRow, ...]) -> bool:
    """Check for a first axis perpendicular to the second, and a third that is parallel to that, or slides across it."""
    first, second, third = rows[:3]
    behind = second.is_square if third.slides else second.is_parallel and abs(second.a) > STRAIGHT
    return first.is_square and behind and not first.slides and not second.slides


def _bends(arm: HandArm, local: Array) -> bool:
    """Check that the third joint moves a point of frame 3, (3,) [m]."""
    return arm.rows[2].slides or math.hypot(*behind_third(arm, local)[:2].tolist()) > STRAIGHT


def _wrist_in_three(arm: HandArm) -> Array:
    """Return the wrist's centre in frame 3; shape (3,), [m]."""
    return np.array([0.0, 0.0, arm.rows[3].d])


def _turns(rows: tuple[ArmRow, ...]) -> bool:
    """Check for three revolute joints whose axes meet in a point, neighbours at right angles."""
    if len(rows) != 3 or any(row.slides for row in rows):
        return False
    meets = abs(rows[1].a) < STRAIGHT and abs(rows[1].d) < STRAIGHT and abs(rows[0].a) < STRAIGHT
    return meets and rows[0].is_square and rows[1].is_square


def _by_shoulder(arm: HandArm, target: HandTarget) -> ByHand:
    """Place the tip, or the point that the tool puts in its place."""
    found = placed(arm, target.pose[:3, 3], arm.tool[:3, 3])
    return ByHand(found.steps, [HandSolution(np.array(values)) for values in found.values])


def _by_wrist(arm: HandArm, target: HandTarget) -> ByHand:
    """Find the angles of a wrist alone."""
    tail = arm.tail()
    M = target.pose[:3, :3] @ tail[:3, :3].T
    name = "R^{0}_{3}"
    angles, sign = zyz_angles(M)
    lines = [*wrist_formulas(0, name), *wrist_numbers(0, name, M, angles, sign)]
    solutions = [_with_wrist(np.empty(0), one, sign) for one in angles]
    return ByHand([step(_("Wrist"), wrist_text(bool(sign)), *lines)], solutions)


def _by_decoupling(arm: HandArm, target: HandTarget) -> ByHand:
    tail = arm.tail()
    R = target.pose[:3, :3] @ tail[:3, :3].T
    centre = target.pose[:3, 3] - R @ tail[:3, 3]
    text = _("The last three axes meet in a point that their angles do not move: step back to it from the tool.")
    steps = [centre_step(target.pose, tail, centre, text)]
    found = placed(arm, centre, _wrist_in_three(arm), "p_w")
    steps += found.steps
    lines, solutions, degenerate = wrist_formulas(3, "R^{3}_{6}"), [], False
    for number_, values in enumerate(found.values, start=1):
        chosen = np.where(np.isnan(values), target.guess[:3], values)
        R03 = arm.frame(chosen, 3)[:3, :3]
        M = R03.T @ R
        angles, sign = zyz_angles(M)
        degenerate |= bool(sign)
        angles_text = rf"({', '.join(number(float(value)) for value in chosen)})"
        lines.append(rf"\mathrm{{{number_}}}: \quad (\vartheta_{{1}}, {_third(arm)}) = {angles_text}, \quad "
                     rf"R^{{0}}_{{3}} = {matrix(R03)}")  # fmt: skip
        lines += wrist_numbers(3, r"R^{3}_{6} = (R^{0}_{3})^T R", M, angles, sign)
        solutions += [_with_wrist(chosen, one, sign) for one in angles]
    if solutions:
        steps.append(_wrist_step(lines, degenerate))
    is_family = any(np.isnan(values).any() for values in found.values)
    if is_family:
        steps.append(_family_step(target))
    return ByHand(steps, solutions, is_family)


def _third(arm: HandArm) -> str:
    return r"\vartheta_{2}, d_{3}" if arm.rows[2].slides else r"\vartheta_{2}, \vartheta_{3}"


def _with_wrist(values: Array, angles: tuple[float, float, float], sign: int) -> HandSolution:
    first = len(values)
    if not sign:
        return HandSolution(np.append(values, angles))
    free = (math.nan, angles[1], math.nan)
    return HandSolution(np.append(values, free), (first, first + 2, sign, angles[0]))


def _wrist_step(lines: list[str], degenerate: bool) -> Step:
    return step(_("Wrist, by decoupling"), wrist_text(degenerate), *lines)


def _family_step(target: HandTarget) -> Step:
    text = _("The first angle is free: these are the solutions for one of its values, and each value has others.")
    return step(_("A family of solutions"), text, rf"\vartheta_{{1}} = {number(float(target.guess[0]))}")
