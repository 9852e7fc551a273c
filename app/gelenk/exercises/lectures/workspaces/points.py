"""A point in the workspace: with which orientations it is reached, and by which links."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.planar import PlanarWorkspace, orientations, planar_workspace, share, workspace_steps
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import quantity, vector
from gelenk.exercises.lectures.workspaces.rings import CLOSE, WristLinks, shape_field
from gelenk.language import marked, translated as _


class PointTask(NamedTuple):
    """Three links and a point on the x axis, [m]."""

    l1: Annotated[float, Draw.decimal, 0.4, 1.2, 0.1]
    l2: Annotated[float, Draw.decimal, 0.3, 1.0, 0.1]
    l3: Annotated[float, Draw.decimal, 0.2, 0.6, 0.1]
    x: Annotated[float, Draw.decimal, 0.5, 2.4, 0.1]

    @property
    def arm(self) -> PlanarWorkspace:
        """The workspaces of the core."""
        return planar_workspace(self[:3])

    def limit(self, radius: float) -> float:
        """Return the orientation at which the wrist is at a distance from the base, [rad]; raises ValueError."""
        return math.acos((self.x**2 + self.l3**2 - radius**2) / (2.0 * self.x * self.l3))

    def answers(self, limit: float) -> Answers:
        """Return the answers from the largest |φ|."""
        return {"limit": limit, "share": limit / math.pi}


def _is_useless_point(one: PointTask) -> bool:
    """Check whether not the outer circle of the wrist alone sets a limit, well within both ends."""
    nearest, farthest = abs(one.x - one.l3), one.x + one.l3
    inner, outer = one.arm.wrist
    if one.l1 == one.l2 or nearest < inner + 0.03 or not nearest + 0.05 < outer < farthest - 0.05:
        return True
    limit: float = _point_answers(one)["limit"]
    return abs(limit - 0.5 * math.pi) < 0.1


def _point_answers(one: PointTask) -> Answers:
    found = orientations(one.arm, one.x, 0.0)
    return {"limit": found[0][1], "share": share(found)}


def _point_steps(one: PointTask) -> list[Step]:
    found = _point_answers(one)
    return [
        step(
            _("The wrist"),
            _("With the orientation φ the wrist is l₃ behind the tip; it must not be farther than l₁ + l₂."),
            rf"\rho^2 = x^2 + l_3^2 - 2 x l_3 \cos\varphi \le (l_1 + l_2)^2 = {tex(one.arm.wrist[1] ** 2)}",
        ),
        step(
            _("Limit of the orientation"),
            _("Solved for the cosine; both signs of φ are possible."),
            rf"\cos\varphi \ge \frac{{x^2 + l_3^2 - (l_1 + l_2)^2}}{{2 x l_3}} = {tex(math.cos(found['limit']))}",
            rf"|\varphi| \le {tex(found['limit'], 'rad')}",
            rf"\frac{{2 \varphi_{{\max}}}}{{2 \pi}} = {tex(found['share'])}",
        ),
    ]


ORIENTATIONS = Exercise(
    id="workspaces.orientations",
    title=marked("The orientations at a point"),
    difficulty=4,
    draw=drawn(PointTask),
    is_degenerate=_is_useless_point,
    text=lambda one: _(
        "A planar arm has three links of {l1:g} m, {l2:g} m and {l3:g} m whose joints turn without limits. Its tip is "
        "to be at ({x:g}, 0) m. Up to which |φ| is that possible, φ being the angle of the last link to the x axis, "
        "and which share of all orientations is that?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("limit", _("Largest |φ|"), "rad", 3.0, within=0.005),
        quantity("share", _("Share of all orientations")),
    ),
    solve=_point_answers,
    steps=_point_steps,
    wrong={
        "supplement": lambda one: one.answers(math.pi - one.limit(one.arm.wrist[1])),
        "reach_of_first_link": lambda one: one.answers(one.limit(one.l1)),
        "hypotenuse_for_reach": lambda one: one.answers(one.limit(math.hypot(one.l1, one.l2))),
        "one_side_alone": lambda one: {"share": 0.5 * _point_answers(one)["share"]},
        "two_of_cosine": lambda one: one.answers(
            math.acos((one.x**2 + one.l3**2 - one.arm.wrist[1] ** 2) / (one.x * one.l3))
        ),
    },
)


class DesignTask(NamedTuple):
    """A ring that has to be the workspace of two links, [m], and a third link for these."""

    inner: Annotated[float, Draw.decimal, 0.1, 0.6, 0.1]
    outer: Annotated[float, Draw.decimal, 1.0, 2.4, 0.1]
    l3: Annotated[float, Draw.decimal, 0.15, 0.65, 0.1]

    @property
    def links(self) -> tuple[float, float]:
        """The longer and the shorter link."""
        return round(0.5 * (self.outer + self.inner), 6), round(0.5 * (self.outer - self.inner), 6)

    @property
    def arm(self) -> PlanarWorkspace:
        """The workspaces of all three links."""
        return planar_workspace((*self.links, self.l3))


def _design_answers(one: DesignTask) -> Answers:
    pieces = one.arm.secondary
    whole = "disc_and_ring" if len(pieces) == 2 else "ring" if pieces[0][0] > 0.0 else "disc"
    inner, outer = pieces[-1]
    return {
        "links": np.array(one.links),
        "primary": np.array(one.arm.primary[0]),
        "shape": whole,
        "secondary": np.array([inner, outer]),
        "area": math.pi * (outer**2 - inner**2),
    }


def _is_useless_design(one: DesignTask) -> bool:
    links = WristLinks(*one.links, one.l3)
    bounds = (one.outer - 2.0 * one.l3 - one.inner, one.l3 - one.inner)
    return one.outer - one.inner < 0.5 or bounds[0] < 0.1 or abs(bounds[1]) < 0.06 or min(links) < 0.1


def _design_steps(one: DesignTask) -> list[Step]:
    l1, l2 = one.links
    found = _design_answers(one)
    return [
        step(
            _("Two links"),
            _("Stretched they reach the outer circle, folded the inner one."),
            rf"l_1 + l_2 = {tex(one.outer)},\quad l_1 - l_2 = {tex(one.inner)}",
            rf"l_1 = {tex(l1, 'm')},\quad l_2 = {tex(l2, 'm')}",
        ),
        *workspace_steps(one.arm),
        step(
            _("Area"),
            _("The outer disc less the inner one."),
            rf"A = \pi (r_{{\max}}^2 - r_{{\min}}^2) = {tex(found['area'], 'm^2')}",
        ),
    ]


def _secondary_of(inner: float, outer: float) -> Answers:
    return {"secondary": np.array([inner, outer]), "area": math.pi * (outer**2 - inner**2)}


DESIGN: Exercise[DesignTask] = Exercise(
    id="workspaces.design",
    title=marked("Exam: links for a workspace"),
    difficulty=5,
    draw=drawn(DesignTask),
    is_degenerate=_is_useless_design,
    text=lambda one: _(
        "A planar arm with two links has to reach exactly the ring of points between {inner:g} m and {outer:g} m from "
        "its base; the first link is the longer one, and the joints turn without limits. Which lengths have the "
        "links?\n\n"
        "A third link of {l3:g} m is added. Between which distances from the base is the primary workspace WS₁ now, "
        "what does the secondary workspace WS₂ consist of, between which radii is its ring, and how large is the area "
        "of this ring?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        vector("links", _("Lengths of the two links"), 2, "m", 2.0, within=CLOSE),
        vector("primary", _("Radii of WS₁"), 2, "m", 2.0, within=CLOSE),
        shape_field(),
        vector("secondary", _("Radii of the ring"), 2, "m", 3.0, within=CLOSE),
        quantity("area", _("Area"), "m²"),
    ),
    solve=_design_answers,
    steps=_design_steps,
    wrong={
        "radii_as_links": lambda one: {"links": np.array([one.outer, one.inner])},
        "outside_by_last_link": lambda one: {
            "primary": np.array([one.inner, one.outer + one.l3]),
        },
        "inner_disc_forgotten": lambda _one: {"shape": "ring"},
        "primary_for_secondary": lambda one: _secondary_of(*one.arm.primary[0]),
        "ring_of_wrist": lambda one: _secondary_of(*one.arm.wrist),
        "last_link_only_outside": lambda one: _secondary_of(one.inner, one.outer - one.l3),
        "disc_without_pi": lambda one: {"area": _design_answers(one)["area"] / math.pi},
    },
)
