"""Chains as graphs, Grübler's formula in the plane, and joints where more than two links meet."""

from typing import Annotated, NamedTuple

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, mechanism
from gelenk.course.mobility.mobility import Tally, tally_of_counts, verdict
from gelenk.course.mobility.steps import steps as mobility_steps
from gelenk.course.steps import Step, step
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.draw import Draw, drawn
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, whole
from gelenk.language import marked, translated as _


class Graph(NamedTuple):
    """Links 0 … n - 1, the ground among them, and pairs between them."""

    links: int
    pairs: tuple[tuple[int, int], ...]

    @property
    def mechanism(self) -> Mechanism:
        """The graph as a mechanism of revolute pairs."""
        given = [GivenPair(f"p{i}", str(a), str(b), "revolute") for i, (a, b) in enumerate(self.pairs)]
        return mechanism("planar", [str(i) for i in range(self.links)], 0, given)


def _draw_graph(draw: Draw) -> Graph:
    links = draw.integer(5, 8)
    tree = [(draw.integer(max(0, i - 2), i - 1), i) for i in range(1, links)]
    further = [(a, b) for b in range(links) for a in range(b) if (a, b) not in tree]
    return Graph(links, tuple(sorted([*tree, *draw.sample(further, draw.integer(0, 3))])))


def _graph_fields(_numbers: Graph) -> tuple[AnswerField, ...]:
    kinds = {"open": _("open"), "closed": _("closed"), "mixed": _("mixed")}
    return (
        whole("loops", _("Independent loops L")),
        whole("bridges", _("Pairs on no loop")),
        ChoiceField(name="chain", label=_("The chain"), options=kinds),
    )


def _graph_steps(numbers: Graph) -> list[Step]:
    found, j, n = numbers.mechanism.topology, len(numbers.pairs), numbers.links
    lost = ", ".join("{}-{}".format(*numbers.pairs[i]) for i in found.bridges) or _("none")
    return [
        step(
            _("Loops"),
            _("A tree that connects all links has n - 1 pairs; each further pair closes a loop."),
            rf"L = j - n + 1 = {j} - {n} + 1 = {found.loops}",
        ),
        step(
            _("Pairs on no loop"),
            _("Without such a pair the chain falls apart: {pairs}.").format(pairs=lost),
            rf"b = {len(found.bridges)}",
        ),
        step(
            _("Kind of chain"),
            _("Without loops it is open; it is closed if every pair lies on a loop; else it is mixed."),
            rf"L = {found.loops},\ b = {len(found.bridges)}",
        ),
    ]


def _graph_answers(numbers: Graph) -> Answers:
    found = numbers.mechanism.topology
    return {"loops": found.loops, "bridges": len(found.bridges), "chain": found.chain}


CHAIN = Exercise(
    id="mobility.chain",
    title=marked("Open, closed and mixed chains"),
    difficulty=2,
    draw=_draw_graph,
    text=lambda one: _(
        "A mechanism has {links} links, 0 to {last}; link 0 is the ground. These links are joined by a pair: {pairs}. "
        "How many independent loops does it have, how many of its pairs lie on no loop, and is the chain open, closed, "
        "or mixed?"
    ).format(links=one.links, last=one.links - 1, pairs=", ".join(f"{a}-{b}" for a, b in one.pairs)),
    fields=_graph_fields,
    solve=_graph_answers,
    steps=_graph_steps,
    wrong={
        "loops_without_one": lambda one: {"loops": len(one.pairs) - one.links},
        "links_for_pairs": lambda one: {"loops": one.links - len(one.pairs) + 1},
        "pairs_in_loops": lambda one: {"bridges": len(one.pairs) - len(one.mechanism.topology.bridges)},
    },
)


class Linkage(NamedTuple):
    """A planar mechanism, by how many links and pairs it has."""

    links: Annotated[int, Draw.integer, 4, 10]
    revolute: Annotated[int, Draw.integer, 2, 11]
    prismatic: Annotated[int, Draw.integer, 0, 3]
    cam: Annotated[int, Draw.integer, 1, 2]

    @property
    def tally(self) -> Tally:
        """The numbers in the formula."""
        counts = {"revolute": self.revolute, "prismatic": self.prismatic, "cam": self.cam}
        return tally_of_counts("planar", self.links, counts, ())


def _with(numbers: Linkage, constraints: int, freedoms: int = 3) -> Answers:
    return {"constraints": constraints, "mobility": freedoms * (numbers.links - 1) - constraints}


LINKAGE = Exercise(
    id="mobility.linkage",
    title=marked("Grübler's formula in the plane"),
    difficulty=1,
    draw=drawn(Linkage),
    is_degenerate=lambda one: one.tally.pairs < one.links or not -1 <= one.tally.mobility <= 3,
    text=lambda one: _(
        "A planar mechanism has {links} links, the frame included. Number of pairs: revolute {revolute}, prismatic "
        "{prismatic}, cam (two links touch at a point, roll and slide) {cam}. How many constraints do the pairs impose "
        "in all, what is the mobility by Grübler's formula, and what does it mean?"
    ).format(**one._asdict()),
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

    links: Annotated[int, Draw.integer, 6, 12]
    simple: Annotated[int, Draw.integer, 3, 11]
    triple: Annotated[int, Draw.integer, 1, 3]
    quadruple: Annotated[int, Draw.integer, 0, 1]

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


COINCIDENT = Exercise(
    id="mobility.coincident",
    title=marked("Joints where more than two links meet"),
    difficulty=2,
    draw=drawn(Coincident),
    is_degenerate=lambda one: not 1 <= one.tally.mobility <= 3,
    text=lambda one: _(
        "A planar linkage has {links} links, the frame included, and only revolute joints. Number of joints where two "
        "links meet: {simple}; where three meet: {triple}; where four meet: {quadruple}. How many kinematic pairs are "
        "that, and what is the mobility?"
    ).format(**one._asdict()),
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
