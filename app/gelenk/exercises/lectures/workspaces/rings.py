"""The two workspaces of planar arms, as rings around the base."""

import math
from typing import Annotated, NamedTuple

import numpy as np

from gelenk.course.planar import PlanarWorkspace, area, planar_workspace, workspace_steps
from gelenk.course.steps import Step, step, tex
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, quantity, vector
from gelenk.language import marked, translated as _

CLOSE = 0.002
"""Tolerance of radii, [m]."""


class RingLinks(NamedTuple):
    """Lengths of a planar arm with two links, [m]."""

    l1: Annotated[float, Draw.decimal, 0.3, 1.2, 0.05]
    l2: Annotated[float, Draw.decimal, 0.2, 1.0, 0.05]

    @property
    def arm(self) -> PlanarWorkspace:
        """The workspaces of the core."""
        return planar_workspace(self)

    def answers(self, inner: float, outer: float) -> Answers:
        """Return the answers from both radii."""
        return {"inner": inner, "outer": outer, "area": math.pi * (outer**2 - inner**2)}


def area_step(arm: PlanarWorkspace) -> Step:
    """Return the step with the area of the primary workspace."""
    return step(
        _("Area"),
        _("The outer disc less the inner one."),
        rf"A = \pi (r_{{\max}}^2 - r_{{\min}}^2) = {tex(area(arm.primary), 'm^2')}",
    )


RING = Exercise(
    id="workspaces.ring",
    title=marked("What two links reach"),
    difficulty=1,
    draw=drawn(RingLinks),
    is_degenerate=lambda one: abs(one.l1 - one.l2) < 0.1 or abs(one.l1 - 1.0) < 0.01,
    text=lambda one: _(
        "A planar arm has two links of {l1:g} m and {l2:g} m whose joints turn without limits. Between which distances "
        "from the base are the points that its tip reaches, and how large is the area of the ring?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("inner", _("Smallest distance"), "m", within=CLOSE),
        quantity("outer", _("Largest distance"), "m", within=CLOSE),
        quantity("area", _("Area"), "m²"),
    ),
    solve=lambda one: {
        "inner": one.arm.primary[0][0],
        "outer": one.arm.primary[0][1],
        "area": area(one.arm.primary),
    },
    steps=lambda one: [*workspace_steps(one.arm)[:1], area_step(one.arm)],
    wrong={
        "hole_forgotten": lambda one: one.answers(0.0, one.l1 + one.l2),
        "disc_without_pi": lambda one: {"area": area(one.arm.primary) / math.pi},
        "width_squared": lambda one: {"area": math.pi * (one.arm.primary[0][1] - one.arm.primary[0][0]) ** 2},
        "first_link_alone": lambda one: one.answers(one.l1, one.l1 + one.l2),
        "right_angle_as_limit": lambda one: one.answers(abs(one.l1 - one.l2), math.hypot(one.l1, one.l2)),
    },
)


class WristLinks(NamedTuple):
    """Lengths of a planar arm with three links, [m]."""

    l1: Annotated[float, Draw.decimal, 0.2, 1.6, 0.1]
    l2: Annotated[float, Draw.decimal, 0.2, 1.6, 0.1]
    l3: Annotated[float, Draw.decimal, 0.1, 1.2, 0.1]

    @property
    def arm(self) -> PlanarWorkspace:
        """The workspaces of the core."""
        return planar_workspace(self)


def _primary(one: WristLinks) -> Answers:
    return dict(zip(("inner", "outer"), one.arm.primary[0], strict=True))


PRIMARY = Exercise(
    id="workspaces.primary",
    title=marked("The primary workspace of three links"),
    difficulty=2,
    draw=drawn(WristLinks),
    is_degenerate=lambda one: abs(2.0 * max(one) - sum(one)) < 0.05 or abs(one.l1 - one.l2) < 0.05,
    text=lambda one: _(
        "A planar arm has three links of {l1:g} m, {l2:g} m and {l3:g} m whose joints turn without limits. Between "
        "which distances from the base are the points of its primary workspace WS₁, reached with at least one "
        "orientation, and how large is its area?"
    ).format(**one._asdict()),
    fields=lambda _one: (
        quantity("inner", _("Smallest distance"), "m", 2.0, within=CLOSE),
        quantity("outer", _("Largest distance"), "m", within=CLOSE),
        quantity("area", _("Area"), "m²"),
    ),
    solve=lambda one: {**_primary(one), "area": area(one.arm.primary)},
    steps=lambda one: [*workspace_steps(one.arm)[:1], area_step(one.arm)],
    wrong={
        "hole_forgotten": lambda one: {"inner": 0.0, "area": math.pi * sum(one) ** 2},
        "always_a_hole": lambda one: {"inner": abs(2.0 * max(one) - sum(one))},
        "last_link_forgotten": lambda one: {"inner": abs(one.l1 - one.l2), "outer": one.l1 + one.l2},
        "disc_without_pi": lambda one: {"area": area(one.arm.primary) / math.pi},
    },
)


def _secondary_answers(one: WristLinks) -> Answers:
    pieces = one.arm.secondary
    inner = [outer for inner, outer in pieces if inner == 0.0]
    rings = [piece for piece in pieces if piece[0] > 0.0]
    return {
        "shape": ("disc_and_ring" if inner else "ring") if rings else ("disc" if inner else "empty"),
        "disc": inner[0] if inner else 0.0,
        "ring": np.array(rings[0] if rings else (0.0, 0.0)),
    }


def _is_useless_secondary(one: WristLinks) -> bool:
    """Check whether a piece is about to vanish, or two of them meet."""
    gap = abs(one.l1 - one.l2)
    bounds = (one.l1 + one.l2 - 2.0 * one.l3 - gap, one.l3 - gap, one.l1 + one.l2 - one.l3)
    return min(map(abs, bounds)) < 0.08 or gap < 0.05


def shape_field(points: float = 1.0) -> ChoiceField:
    """Return the field of what the secondary workspace consists of."""
    options = {
        "empty": _("nothing"),
        "disc": _("a disc"),
        "ring": _("a ring"),
        "disc_and_ring": _("a disc and a ring"),
    }
    return ChoiceField(name="shape", label=_("WS₂ consists of"), options=options, points=points)


def _ring_of(inner: float, outer: float) -> Answers:
    if outer <= inner:
        raise ValueError("there is no ring")
    return {"ring": np.array([inner, outer])}


SECONDARY = Exercise(
    id="workspaces.secondary",
    title=marked("The secondary workspace of three links"),
    difficulty=3,
    draw=drawn(
        WristLinks,
        l1=(Draw.decimal, 0.4, 1.2, 0.1),
        l2=(Draw.decimal, 0.3, 1.0, 0.1),
        l3=(Draw.decimal, 0.1, 0.7, 0.1),
    ),
    is_degenerate=_is_useless_secondary,
    text=lambda one: _(
        "A planar arm has three links of {l1:g} m, {l2:g} m and {l3:g} m whose joints turn without limits. What does "
        "its secondary workspace WS₂, the points reached with all orientations, consist of? Give the radius of the "
        "disc around the base, 0 without one, and the inner and the outer radius of the ring, (0, 0) without one."
    ).format(**one._asdict()),
    fields=lambda _one: (
        shape_field(),
        quantity("disc", _("Radius of the disc"), "m", 2.0, within=CLOSE),
        vector("ring", _("Radii of the ring"), 2, "m", 3.0, within=CLOSE),
    ),
    solve=_secondary_answers,
    steps=lambda one: workspace_steps(one.arm),
    wrong={
        "inner_disc_forgotten": lambda _one: {"shape": "ring", "disc": 0.0},
        "primary_for_secondary": lambda one: _ring_of(*one.arm.primary[0]),
        "ring_of_wrist": lambda one: _ring_of(*one.arm.wrist),
        "hole_of_wrist_forgotten": lambda one: {
            "shape": "disc",
            "disc": one.l1 + one.l2 - one.l3,
            "ring": np.array([0.0, 0.0]),
        },
        "last_link_only_outside": lambda one: _ring_of(abs(one.l1 - one.l2), one.l1 + one.l2 - one.l3),
    },
)
