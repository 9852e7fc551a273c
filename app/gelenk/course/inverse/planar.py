"""Arms whose axes are all parallel: two or three revolute joints in a plane, and perhaps a slide across it (SCARA)."""

import math

import numpy as np

from gelenk.course.inverse.arm import HandArm
from gelenk.course.inverse.elbow import Links, bends, elbow_step
from gelenk.course.inverse.solution import ByHand, HandSolution, HandTarget
from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, number, term, theta, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.dh import about_x


def fits_planar(arm: HandArm, directions: frozenset[str]) -> bool:
    """Check for two or three revolute joints with parallel axes and at most one slide, all fixed by the directions."""
    turns = [i for i, slide in enumerate(arm.slides) if not slide]
    slides = len(arm.rows) - len(turns)
    known = {"x", "y"} | ({"z"} if slides else set()) | ({"rz"} if len(turns) == 3 else set())
    level = abs(abs(arm.base[2, 2]) - 1.0) < ROUNDING or len(directions) == 6
    rows = arm.rows[:-1]
    tilted = not all(row.is_parallel for row in rows) or any(row.slides and abs(row.a) > ROUNDING for row in arm.rows)
    flat = len(turns) in {2, 3} and slides <= 1 and level and known <= directions and not tilted
    return flat and abs(_links(arm, turns).length * _links(arm, turns).reach) > ROUNDING


def by_planar(arm: HandArm, target: HandTarget) -> ByHand:
    """Solve an arm in the plane that `fits_planar`."""
    arm = arm.turned(dict.fromkeys(range(len(arm.rows) - 1), 0.0))
    turns = [i for i, slide in enumerate(arm.slides) if not slide]
    steps, values = [], np.zeros(len(arm.rows))
    end = target.pose[:3, 3]
    constant = sum(row.theta for row in arm.rows if row.slides)
    place = (float(end[0]), float(end[1]))
    phi = math.nan
    if len(turns) == 3:
        wrist, phi = _wrist_step(arm, turns, target, float(constant))
        steps.append(wrist[0])
        place = wrist[1]
    height = _height_step(arm, float(end[2]))
    if height is not None:
        steps.append(height[0])
        values[arm.slides.index(True)] = height[1]
    links = _links(arm, turns)
    found = bends(links, *place)
    steps.append(elbow_step(links, [place], [found]))
    solutions = []
    for pair in found.pairs:
        branch = values.copy()
        branch[turns[:2]] = pair
        sums: tuple[int, int, int, float] | None = None
        if len(turns) == 3:
            branch[turns[2]] = wrapped(phi - float(constant) - pair[0] - pair[1])
            if math.isnan(pair[0]):
                sums = (turns[0], turns[2], 1, wrapped(phi - float(constant) - pair[1]))
        solutions.append(HandSolution(branch, sums))
    if len(turns) == 3:
        steps.append(_last_step(turns, solutions, float(constant)))
    return ByHand(steps, solutions)


def _links(arm: HandArm, turns: list[int]) -> Links:
    """Return the first two links; the second one ends at the third axis, or at the tip."""
    first, second = arm.rows[turns[0]], arm.rows[turns[1]]
    T = np.eye(4)
    for row in arm.rows[turns[0] + 1 : turns[1]]:
        T = T @ row.transform(0.0)
    end = np.array([second.a, 0.0])
    if len(turns) == 2:
        rest = about_x(second.alpha, second.a)
        for row in arm.rows[turns[1] + 1 :]:
            rest = rest @ row.transform(0.0)
        end = (rest @ arm.tool)[:2, 3]
    symbols = (rf"a_{{{turns[0] + 1}}}", rf"a_{{{turns[1] + 1}}}" if abs(end[0] - second.a) < ROUNDING else r"\ell")
    place = ("x", "y") if len(turns) == 2 else ("w_x", "w_y")
    return Links(turns[0], first.a, (float(end[0]), float(end[1])), *symbols, place, turns[1])


def _wrist_step(
    arm: HandArm, turns: list[int], target: HandTarget, constant: float
) -> tuple[tuple[Step, tuple[float, float]], float]:
    """Return the step from the tip back to the third axis, where that is, [m], and the angle of the last link."""
    tail = about_x(arm.rows[turns[2]].alpha, arm.rows[turns[2]].a)
    for row in arm.rows[turns[2] + 1 :]:
        tail = tail @ (about_x(row.alpha, row.a) if row.slides else row.transform(0.0))
    tail = tail @ arm.tool
    R = target.pose[:3, :3] @ tail[:3, :3].T
    phi = math.atan2(R[1, 0], R[0, 0])
    back = R @ tail[:3, 3]
    x, y = target.pose[:2, 3].tolist()
    wrist = (x - float(back[0]), y - float(back[1]))
    angles = " + ".join(theta(i) for i in turns)
    lines = [rf"\varphi = {angles}{term(constant)} = {number(phi)}"]
    length, angle = float(tail[0, 3]), r"\varphi"
    if abs(tail[1, 3]) > ROUNDING:
        length, angle = math.hypot(*tail[:2, 3]), r"(\varphi + \beta)"
        lines.append(rf"\beta = {number(math.atan2(tail[1, 3], tail[0, 3]))}")
    lines.append(rf"w = (x,\; y) - {number(length)}\,(\cos {angle},\; \sin {angle}) = {vector(wrist)}")
    text = _("The orientation fixes the angle of the last link, and the third axis is its length back from the tip.")
    return (step(_("Back to the third axis"), text, *lines), wrist), phi


def _height_step(arm: HandArm, z: float) -> tuple[Step, float] | None:
    """Return the step that finds the slide's length, and the length [m]; None without a slide."""
    if True not in arm.slides:
        return None
    k = arm.slides.index(True)
    rest = sum(row.d for row in arm.rows if not row.slides) + float(arm.tool[2, 3])
    if abs(math.cos(arm.rows[-1].alpha) + 1.0) < ROUNDING:
        rest -= 2.0 * float(arm.tool[2, 3])
    text = _("Only the slide changes the height.")
    line = rf"d_{{{k + 1}}} = z{term(-rest)} = {number(z - rest)}"
    return step(_("Height"), text, line), z - rest


def _last_step(turns: list[int], solutions: list[HandSolution], constant: float) -> Step:
    one, two, three = (theta(i) for i in turns)
    lines = [rf"{three} = \varphi{term(-constant)} - {one} - {two}"]
    for solution in solutions:
        value = solution.values[turns[2]]
        if math.isnan(value) and solution.pair is not None:
            lines.append(rf"{one} + {three} = {number(solution.pair[3])}")
        else:
            lines.append(rf"{three} = {number(float(value))}")
    return step(_("Last angle"), _("The angles add up to that of the last link."), *lines)
