"""Two links in a plane: base, elbow and end are a triangle of which all sides are known."""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.steps import Step, step
from gelenk.course.writing import ROUNDING, atan2, number, term, theta, wrapped
from gelenk.language import translated as _

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
