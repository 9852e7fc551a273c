"""Grübler's formula in the plane, and joints where more than two links meet."""

from typing import NamedTuple

from gelenk.course.mobility.mobility import Tally, tally_of_counts, verdict
from gelenk.course.mobility.steps import steps as mobility_steps
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, whole
from gelenk.language import marked
from gelenk.language import translated as _


class Linkage(NamedTuple):
    """A planar mechanism, by how many links and pairs it has."""

    links: int
    revolute: int
    prismatic: int
    cam: int

    @property
    def tally(self) -> Tally:
        """The numbers in the formula."""
        counts = {"revolute": self.revolute, "prismatic": self.prismatic, "cam": self.cam}
        return tally_of_counts("planar", self.links, counts, ())


def _draw_linkage(draw: Draw) -> Linkage:
    return Linkage(draw.integer(4, 10), draw.integer(2, 11), draw.integer(0, 3), draw.integer(1, 2))


def _linkage_text(numbers: Linkage) -> str:
    return _(
        "A planar mechanism has {links} links, the frame included. Number of pairs: revolute {revolute}, prismatic "
        "{prismatic}, cam (two links touch at a point, roll and slide) {cam}. How many constraints do the pairs impose "
        "in all, what is the mobility by Grübler's formula, and what does it mean?"
    ).format(**numbers._asdict())


def _with(numbers: Linkage, constraints: int, freedoms: int = 3) -> Answers:
    return {"constraints": constraints, "mobility": freedoms * (numbers.links - 1) - constraints}


LINKAGE = Exercise(
    id="mobility.linkage",
    title=marked("Grübler's formula in the plane"),
    difficulty=1,
    draw=_draw_linkage,
    is_degenerate=lambda one: one.tally.pairs < one.links or not -1 <= one.tally.mobility <= 3,
    text=_linkage_text,
    fields=lambda _numbers: (
        whole("constraints", _("Constraints of all pairs, Σc")),
        whole("mobility", _("Mobility M")),
        _verdict_field(),
    ),
    solve=lambda one: {
        "constraints": one.tally.constraints,
        "mobility": one.tally.mobility,
        "verdict": verdict(one.tally.mobility),
    },
    steps=lambda one: mobility_steps(one.tally, None),
    wrong={
        "ground_moves": lambda one: {"mobility": 3 * one.links - one.tally.constraints},
        "ground_forgotten": lambda one: {"mobility": 3 * (one.links - 2) - one.tally.constraints},
        "higher_pair_as_lower": lambda one: _with(one, one.tally.constraints + one.cam),
        "freedoms_for_constraints": lambda one: _with(one, one.revolute + one.prismatic + 2 * one.cam),
        "space_for_plane": lambda one: _with(one, 5 * (one.revolute + one.prismatic + one.cam), freedoms=6),
    },
)


class Coincident(NamedTuple):
    """A planar linkage of revolute joints; at some of them three or four links meet."""

    links: int
    simple: int
    triple: int
    quadruple: int

    @property
    def tally(self) -> Tally:
        """The numbers in the formula."""
        nodes = [(f"T{i}", 3, None) for i in range(self.triple)] + [(f"Q{i}", 4, None) for i in range(self.quadruple)]
        return tally_of_counts("planar", self.links, {"revolute": self.joints}, nodes)

    @property
    def joints(self) -> int:
        """Joints, before they are split."""
        return self.simple + self.triple + self.quadruple


def _coincident_answers(numbers: Coincident, pairs: int) -> Answers:
    return {"pairs": pairs, "mobility": 3 * (numbers.links - 1) - 2 * pairs}


def _coincident_text(numbers: Coincident) -> str:
    return _(
        "A planar linkage has {links} links, the frame included, and only revolute joints. Number of joints where two "
        "links meet: {simple}; where three meet: {triple}; where four meet: {quadruple}. How many kinematic pairs are "
        "that, and what is the mobility?"
    ).format(**numbers._asdict())


COINCIDENT = Exercise(
    id="mobility.coincident",
    title=marked("Joints where more than two links meet"),
    difficulty=2,
    draw=lambda draw: Coincident(draw.integer(6, 12), draw.integer(3, 11), draw.integer(1, 3), draw.integer(0, 1)),
    is_degenerate=lambda one: not 1 <= one.tally.mobility <= 3,
    text=_coincident_text,
    fields=lambda _numbers: (whole("pairs", _("Kinematic pairs j")), whole("mobility", _("Mobility M"))),
    solve=lambda one: {"pairs": one.tally.pairs, "mobility": one.tally.mobility},
    steps=lambda one: mobility_steps(one.tally, None),
    wrong={
        "split_forgotten": lambda one: _coincident_answers(one, one.joints),
        "pair_per_link": lambda one: _coincident_answers(one, one.simple + 3 * one.triple + 4 * one.quadruple),
        "ground_moves": lambda one: {"mobility": one.tally.mobility + 3},
        "freedoms_for_constraints": lambda one: {"mobility": 3 * (one.links - 1) - one.tally.pairs},
    },
)


def _verdict_field() -> ChoiceField:
    options = {
        "mechanism": _("it moves: a mechanism"),
        "structure": _("it does not move: a structure"),
        "overconstrained": _("it has more constraints than freedoms"),
    }
    return ChoiceField(name="verdict", label=_("What is it?"), options=options)


EXERCISES = (LINKAGE, COINCIDENT)
