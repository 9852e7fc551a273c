"""Arms whose axes are all parallel: two or three revolute joints in a plane, and perhaps a slide across it (SCARA).

Of two links base, elbow and end are a triangle of which all sides are known.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.course.inverse.arm import ByHand, HandArm, HandSolution, HandTarget
from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, atan2, number, term, theta, vector, wrapped
from gelenk.language import translated as _
from gelenk.robot.dh import about_x

Reach: TypeAlias = Literal["two", "one", "all", "none"]


@dataclass(frozen=True, slots=True)
class Links:
    """Two links; the end of the second is at (x, y) in the frame that turns with it, [m].

    Attributes:
        first, second: Indices of the two joints; the second one is the next if left out.
        length: Of the first link, perhaps negative, [m].
        symbol, end_symbol: LaTeX of the first length, and of the second if the end lies on the x axis.
        place: LaTeX of the coordinates of the target.
    """

    first: int
    length: float
    end: tuple[float, float]
    symbol: str
    end_symbol: str
    place: tuple[str, str] = ("x", "y")
    second: int | None = None

    @property
    def is_straight(self) -> bool:
        """Whether the end lies on the x axis of its frame."""
        return abs(self.end[1]) < ROUNDING

    @property
    def reach(self) -> float:
        """Length of the second link, [m]; negative where the end lies on the x axis, behind the joint."""
        return self.end[0] if self.is_straight else math.hypot(*self.end)

    @property
    def bend(self) -> float:
        """Angle of the end in its frame, [rad]."""
        return 0.0 if self.is_straight else math.atan2(self.end[1], self.end[0])


@dataclass(frozen=True, slots=True)
class Bends:
    """The elbow's solutions: pairs of the two angles; NaN where the first one is free."""

    reach: Reach
    cosine: float
    pairs: tuple[tuple[float, float], ...]


def bends(links: Links, x: float, y: float) -> Bends:
    """Return the angles that bring the end to (x, y) [m]; the first angle is free where the end is at the base."""
    l1, l2 = links.length, links.reach
    cosine = (x * x + y * y - l1 * l1 - l2 * l2) / (2.0 * l1 * l2)
    if math.hypot(x, y) < ROUNDING and abs(abs(l1) - abs(l2)) < ROUNDING:
        return Bends("all", cosine, ((math.nan, wrapped(math.acos(_unit(cosine)) - links.bend)),))
    if abs(cosine) > 1.0 + ROUNDING:
        return Bends("none", cosine, ())
    is_one = abs(cosine) > 1.0 - ROUNDING
    sine = 0.0 if is_one else math.sqrt(1.0 - cosine * cosine)
    pairs = []
    for s in (sine,) if is_one else (sine, -sine):
        first = math.atan2(y, x) - math.atan2(l2 * s, l1 + l2 * _unit(cosine))
        pairs.append((wrapped(first), wrapped(math.atan2(s, _unit(cosine)) - links.bend)))
    return Bends("one" if is_one else "two", cosine, tuple(pairs))


def _unit(cosine: float) -> float:
    return max(-1.0, min(1.0, cosine))


def elbow_step(links: Links, places: list[tuple[float, float]], found: list[Bends]) -> Step:
    """Return the step that bends the elbow, for each place (x, y) [m] that the end may have to reach."""
    second = links.first + 1 if links.second is None else links.second
    one, two, psi = theta(links.first), theta(second), r"\psi"
    X, Y = links.place
    l1, l2 = links.symbol, links.end_symbol if links.is_straight else r"\ell"
    known = _("Shoulder, elbow and end form a triangle of which all three sides are known.")
    lines = []
    if not links.is_straight:
        ex, ey = (number(value) for value in links.end)
        lines.append(rf"\ell = \sqrt{{({ex})^2 + ({ey})^2}} = {number(links.reach)}, \quad "
                     rf"\gamma = {atan2(ey, ex)} = {number(links.bend)}")  # fmt: skip
    bent = rf"{two} + \gamma" if not links.is_straight else two
    psi = two if links.is_straight else psi
    cosine = rf"\cos {psi} = \frac{{{X}^2 + {Y}^2 - {l1}^2 - {l2}^2}}{{2 {l1} {l2}}}"
    names = "" if links.is_straight else rf", \quad \psi = {bent}"
    lines.append(cosine + names)
    turned = atan2(rf"\sin {psi}", rf"\cos {psi}") + ("" if links.is_straight else r" - \gamma")
    inner = atan2(rf"{l2} \sin {psi}", rf"{l1} + {l2} \cos {psi}")
    lines.append(rf"\sin {psi} = \pm\sqrt{{1 - \cos^2 {psi}}}, \quad {two} = {turned}")
    lines.append(rf"{one} = {atan2(Y, X)} - {inner}")
    for (x, y), bend in zip(places, found, strict=True):
        lines.append(_numbers(links, x, y, bend, psi))
        lines += [_pair(one, two, pair) for pair in bend.pairs]
    return step(_("The elbow, by the law of cosines"), " ".join([known, *_verdicts(found)]), *lines)


def _numbers(links: Links, x: float, y: float, bend: Bends, psi: str) -> str:
    square = rf"\frac{{{number(x * x + y * y)}{term(-(links.length**2))}{term(-(links.reach**2))}}}"
    below = number(2.0 * links.length * links.reach)
    place = rf"({links.place[0]}, {links.place[1]}) = ({number(x)},\; {number(y)})"
    return rf"{place}: \quad \cos {psi} = {square}{{{below}}} = {number(bend.cosine)}"


def _pair(one: str, two: str, pair: tuple[float, float]) -> str:
    free = math.isnan(pair[0])
    return rf"{two} = {number(pair[1])}" if free else rf"{two} = {number(pair[1])}, \quad {one} = {number(pair[0])}"


def _verdicts(found: list[Bends]) -> list[str]:
    texts = {
        "two": _("The sign of the sine chooses the elbow: two solutions, mirror images in the line to the end."),
        "one": _("The cosine is ±1: the arm is stretched or folded, and both solutions are the same."),
        "all": _("The links are equally long and the end is in the first axis: its angle is free."),
        "none": _("A cosine beyond ±1: the three sides do not close to a triangle, and the point is out of reach."),
    }
    return [texts[kind] for kind in texts if any(bend.reach == kind for bend in found)]


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
