"""Chains as graphs of links and pairs."""

from typing import NamedTuple

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, mechanism
from gelenk.course.steps import Step, step
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import ChoiceField, whole
from gelenk.language import marked
from gelenk.language import translated as _


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


def _graph_text(numbers: Graph) -> str:
    return _(
        "A mechanism has {links} links, 0 to {last}; link 0 is the ground. These links are joined by a pair: {pairs}. "
        "How many independent loops does it have, how many of its pairs lie on no loop, and is the chain open, closed, "
        "or mixed?"
    ).format(links=numbers.links, last=numbers.links - 1, pairs=", ".join(f"{a}-{b}" for a, b in numbers.pairs))


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
    text=_graph_text,
    fields=_graph_fields,
    solve=_graph_answers,
    steps=_graph_steps,
    wrong={
        "loops_without_one": lambda one: {"loops": len(one.pairs) - one.links},
        "links_for_pairs": lambda one: {"loops": one.links - len(one.pairs) + 1},
        "pairs_in_loops": lambda one: {"bridges": len(one.pairs) - len(one.mechanism.topology.bridges)},
    },
)

EXERCISES = (CHAIN,)
