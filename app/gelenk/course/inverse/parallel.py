"""Six joints whose second, third and fourth axis are parallel, as of Universal Robots: no spherical wrist, yet by hand.

Seen from frame 1 the arm is planar: R^1_6 = Rz(ϑ₂ + ϑ₃ + ϑ₄) Ry(ϑ₅) Rz(ϑ₆) is a ZYZ rotation, which gives the last two
angles and the sum of the others; then two links remain.
"""

import math

import numpy as np

from gelenk.course.inverse.arm import STRAIGHT, ByHand, HandArm, HandSolution, HandTarget
from gelenk.course.inverse.planar import Links, bends, elbow_step
from gelenk.course.inverse.shoulder import first_step, upright
from gelenk.course.inverse.wrist import centre_step, zyz_angles, zyz_formulas
from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix, number, theta, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.dh import about_x

_SUM = r"\vartheta_{234}"


def fits_three_parallel(arm: HandArm, directions: frozenset[str]) -> bool:
    """Check for six revolute joints, the second to fourth parallel and the others square to their neighbours."""
    if len(arm.rows) != 6 or len(directions) != 6 or any(arm.slides):
        return False
    first, second, third, fourth, fifth, _last = arm.rows
    square = first.is_square and fourth.is_square and fifth.is_square
    links = abs(second.a) > STRAIGHT and abs(third.a) > STRAIGHT
    return square and second.is_parallel and third.is_parallel and links and abs(fifth.a) < STRAIGHT


def by_three_parallel(arm: HandArm, target: HandTarget) -> ByHand:
    """Solve an arm that `fits_three_parallel`, turned so that α₄ = -π/2 and α₅ = π/2."""
    tail = arm.tail()
    R = target.pose[:3, :3] @ tail[:3, :3].T
    centre = target.pose[:3, 3] - R @ tail[:3, 3]
    plane = upright(arm, centre, sum(row.d for row in arm.rows[1:4]))
    text = _("The last angle does not move the origin of frame 5: step back to it from the tool.")
    steps = [centre_step(target.pose, tail, centre, text), first_step(plane, centre, "p_w")]
    rule = rf"R^{{1}}_{{6}} = (R^{{0}}_{{1}})^T R = R_z({_SUM})\, R_y(\vartheta_{{5}})\, R_z(\vartheta_{{6}})"
    wrists = [rule, f"{_SUM} = {theta(1)} + {theta(2)} + {theta(3)}", *zyz_formulas(_SUM, theta(4), theta(5))]
    fourth: list[str] = []
    branches: list[tuple[float, tuple[float, float, float], tuple[float, float]]] = []
    free = False
    for turn, place in zip(plane.turns, plane.places, strict=True):
        R01 = arm.frame(np.array([target.guess[0] if math.isnan(turn) else turn]), 1)[:3, :3]
        M = R01.T @ R
        angles, sign = zyz_angles(M)
        free |= bool(sign) or math.isnan(turn)
        wrists.append(rf"\vartheta_{{1}} = {number(turn)}: \quad R^{{1}}_{{6}} = {matrix(M)}")
        for total, middle, last in angles:
            # Where the axes are in line the last angle is free.
            end = last if not sign else float(target.guess[5])
            whole = wrapped(total if not sign else total - sign * end)
            wrists.append(rf"({_SUM}, \vartheta_{{5}}, \vartheta_{{6}}) = {vector((whole, middle, end))}")
            branches.append((turn, (whole, middle, end), _third_axis(arm, place, whole)))
    if not branches:
        return ByHand(steps, [])
    links = Links(1, arm.rows[1].a, (arm.rows[2].a, 0.0), "a_2", "a_3", ("X", "Y"))
    places = [place for _turn, _angles, place in branches]
    found = [bends(links, *place) for place in places]
    steps += [_wrist_step(wrists, free), _plane_step(branches), elbow_step(links, places, found)]
    solutions = []
    for (turn, (whole, middle, end), _place), bend in zip(branches, found, strict=True):
        for two, three in bend.pairs:
            solutions.append(HandSolution(np.array([turn, two, three, wrapped(whole - two - three), middle, end])))
            fourth.append(rf"\vartheta_{{4}} = {number(whole)} - ({number(two)}) - ({number(three)})")
    if solutions:
        rule = rf"\vartheta_{{4}} = {_SUM} - \vartheta_{{2}} - \vartheta_{{3}}"
        steps.append(step(_("Fourth joint"), _("The angles about the parallel axes add up."), rule, *fourth))
    return ByHand(steps, solutions, free)


def _third_axis(arm: HandArm, place: tuple[float, float], whole: float) -> tuple[float, float]:
    """Return where the fourth axis, at the end of the second link, is in frame 1, [m]."""
    c, s = math.cos(whole), math.sin(whole)
    back: Array = about_x(arm.rows[3].alpha, arm.rows[3].a) @ np.array([0.0, 0.0, arm.rows[4].d, 1.0])
    x, y = float(back[0]), float(back[1])
    return place[0] - (c * x - s * y), place[1] - (s * x + c * y)


def _wrist_step(lines: list[str], free: bool) -> Step:
    text = _("Three axes are parallel, so that the rotation behind the first joint is one of ZYZ: two branches each.")
    if free:
        text += " " + _("An angle is free here: these are the solutions for one of its values.")
    return step(_("Fifth and sixth joint"), text, *lines)


def _plane_step(branches: list[tuple[float, tuple[float, float, float], tuple[float, float]]]) -> Step:
    text = _("Back from frame 5 to the fourth axis: two links must reach what is left, in the plane of frame 1.")
    return step(_("In the plane of the arm"), text, *(rf"(X, Y) = {vector(place)}" for _t, _a, place in branches))
