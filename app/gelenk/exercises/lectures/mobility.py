"""Links, pairs and Grübler's count."""

from collections.abc import Mapping
from typing import NamedTuple

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, mechanism
from gelenk.course.mobility.mobility import Tally, tally, tally_of_counts, verdict
from gelenk.course.mobility.pairs import FREEDOMS, KINDS, Space
from gelenk.course.mobility.steps import steps as mobility_steps
from gelenk.course.steps import Step, step
from gelenk.exercises.draw import Draw
from gelenk.exercises.exercise import Answers, Exercise
from gelenk.exercises.fields import AnswerField, ChoiceField, NumberField, VectorField
from gelenk.language import marked
from gelenk.language import translated as _


def _whole(name: str, label: str, points: float = 1.0) -> NumberField:
    return NumberField(name=name, label=label, points=points)


def _verdict_field() -> ChoiceField:
    options = {
        "mechanism": _("it moves: a mechanism"),
        "structure": _("it does not move: a structure"),
        "overconstrained": _("it has more constraints than freedoms"),
    }
    return ChoiceField(name="verdict", label=_("What is it?"), options=options)


# Counts of pairs in the plane


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
    is_degenerate=lambda one: not -2 <= one.tally.mobility <= 4,
    text=_linkage_text,
    fields=lambda _numbers: (
        _whole("constraints", _("Constraints of all pairs, Σc")),
        _whole("mobility", _("Mobility M")),
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


# Coincident joints


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
    fields=lambda _numbers: (_whole("pairs", _("Kinematic pairs j")), _whole("mobility", _("Mobility M"))),
    solve=lambda one: {"pairs": one.tally.pairs, "mobility": one.tally.mobility},
    steps=lambda one: mobility_steps(one.tally, None),
    wrong={
        "split_forgotten": lambda one: _coincident_answers(one, one.joints),
        "pair_per_link": lambda one: _coincident_answers(one, one.simple + 3 * one.triple + 4 * one.quadruple),
        "ground_moves": lambda one: {"mobility": one.tally.mobility + 3},
        "freedoms_for_constraints": lambda one: {"mobility": 3 * (one.links - 1) - one.tally.pairs},
    },
)


# The table of pairs


def _names() -> dict[str, str]:
    return {
        "revolute": _("revolute"),
        "prismatic": _("prismatic"),
        "screw": _("screw"),
        "universal": _("universal"),
        "cylindrical": _("cylindrical"),
        "spherical": _("spherical"),
        "planar": _("planar"),
        "sphere_in_groove": _("sphere in a groove"),
        "point_contact": _("point contact"),
    }


def _constraints(kinds: tuple[str, ...], space: Space = "spatial") -> list[int]:
    return [KINDS[kind].constraints(space) or 0 for kind in kinds]


def _table_steps(kinds: tuple[str, ...]) -> list[Step]:
    names = _names()
    formulas = [rf"c_{i} = 6 - {6 - c} = {c}" for i, c in enumerate(_constraints(kinds), start=1)]
    text = _("A free body has 6 freedoms in space; the pairs are, in this order: {kinds}.")
    return [step(_("Freedoms that are left"), text.format(kinds=", ".join(names[kind] for kind in kinds)), *formulas)]


TABLE = Exercise(
    id="mobility.pairs",
    title=marked("Constraints of kinematic pairs"),
    difficulty=1,
    draw=lambda draw: tuple(
        draw.sample(("revolute", "prismatic", "screw", "universal", "cylindrical", "spherical", "planar",
                     "sphere_in_groove", "point_contact"), 5)
    ),
    is_degenerate=lambda kinds: len(set(_constraints(kinds))) < 4,
    text=lambda kinds: _(
        "How many of the 6 freedoms of a body in space does each of these pairs remove? In this order: {kinds}."
    ).format(kinds=", ".join(_names()[kind] for kind in kinds)),
    fields=lambda kinds: (VectorField(name="constraints", label=_("Constraints c of the pairs"), size=len(kinds)),),
    solve=lambda kinds: {"constraints": _constraints(kinds)},
    steps=_table_steps,
    wrong={
        "freedoms_for_constraints": lambda kinds: {"constraints": [6 - c for c in _constraints(kinds)]},
        "universal_as_two": lambda kinds: {"constraints": _table_with(kinds, universal=5)},
        "spherical_as_universal": lambda kinds: {"constraints": _table_with(kinds, spherical=4)},
        "plane_for_space": lambda kinds: {"constraints": [c - 3 for c in _constraints(kinds)]},
    },
)  # fmt: skip


def _table_with(kinds: tuple[str, ...], **other: int) -> list[int]:
    return [other.get(kind, c) for kind, c in zip(kinds, _constraints(kinds), strict=True)]


# Chains as graphs


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
        _whole("loops", _("Independent loops L")),
        _whole("bridges", _("Pairs on no loop")),
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


# An exam: a platform on legs


class Platform(NamedTuple):
    """A platform on equal legs; `leg` has the pairs of each from the ground up."""

    legs: int
    leg: tuple[str, ...]

    @property
    def mechanism(self) -> Mechanism:
        """All links and pairs."""
        links, given = ["ground", "platform"], []
        for i in range(self.legs):
            inner = [f"leg {i} link {k}" for k in range(len(self.leg) - 1)]
            ends = ["ground", *inner, "platform"]
            links += inner
            given += [GivenPair(f"{i}.{k}", ends[k], ends[k + 1], kind) for k, kind in enumerate(self.leg)]
        return mechanism("spatial", links, 0, given)


_LETTERS = {"prismatic": "P", "revolute": "R", "universal": "U", "spherical": "S", "cylindrical": "C"}
_LEGS: tuple[tuple[str, ...], ...] = (
    ("universal", "prismatic", "spherical"),
    ("spherical", "prismatic", "spherical"),
    ("revolute", "prismatic", "spherical"),
    ("revolute", "revolute", "spherical"),
    ("prismatic", "spherical", "spherical"),
    ("revolute", "spherical", "spherical"),
    ("prismatic", "universal", "spherical"),
    ("cylindrical", "prismatic", "spherical"),
)


def _platform_text(numbers: Platform) -> str:
    names = _names()
    return _(
        "A platform rests on {legs} equal legs of type {letters}: from the ground to the platform each has these "
        "pairs: {pairs}. Ground, platform and the links between the pairs of the legs are the links.\n\n"
        "Count the links n and the pairs j, the constraints Σc, and the mobility M by the formula of Grübler and "
        "Kutzbach. How many freedoms are idle, because a part spins between two spherical joints and moves nothing "
        "else? What mobility remains without them?"
    ).format(
        legs=numbers.legs,
        letters="".join(_LETTERS[kind] for kind in numbers.leg),
        pairs=", ".join(names[kind] for kind in numbers.leg),
    )


def _platform_fields(_numbers: Platform) -> tuple[AnswerField, ...]:
    return (
        _whole("links", _("Links n")),
        _whole("pairs", _("Pairs j")),
        _whole("constraints", _("Constraints Σc")),
        _whole("mobility", _("Mobility M"), 2.0),
        _whole("idle", _("Idle freedoms")),
        _whole("remaining", _("Mobility without idle freedoms")),
    )


def _platform_answers(numbers: Platform) -> Answers:
    counted, idle = tally(numbers.mechanism), len(numbers.mechanism.idle_spins())
    return {
        "links": counted.links,
        "pairs": counted.pairs,
        "constraints": counted.constraints,
        "mobility": counted.mobility,
        "idle": idle,
        "remaining": counted.mobility - idle,
    }


def _platform_with(numbers: Platform, change: Mapping[str, int]) -> Answers:
    right = {**_platform_answers(numbers), **change}
    mobility = FREEDOMS["spatial"] * (right["links"] - 1) - right["constraints"]
    return {**change, "mobility": mobility, "remaining": mobility - right["idle"]}


def _one_leg(numbers: Platform) -> Answers:
    right = _platform_answers(numbers)
    change = {name: right[name] // numbers.legs for name in ("pairs", "constraints")}
    return _platform_with(numbers, change | {"links": 1 + len(numbers.leg)})


def _kind_as(numbers: Platform, kind: str, constraints: int) -> Answers:
    count, right = numbers.legs * numbers.leg.count(kind), _platform_answers(numbers)
    change = count * (constraints - (KINDS[kind].constraints("spatial") or 0))
    return _platform_with(numbers, {"constraints": right["constraints"] + change})


PLATFORM = Exercise(
    id="mobility.platform",
    title=marked("Exam: a platform on legs"),
    difficulty=5,
    draw=lambda draw: Platform(draw.integer(3, 6), draw.choice(_LEGS)),
    text=_platform_text,
    fields=_platform_fields,
    solve=_platform_answers,
    steps=lambda one: mobility_steps(tally(one.mechanism), one.mechanism),
    wrong={
        "platform_forgotten": lambda one: _platform_with(one, {"links": _platform_answers(one)["links"] - 1}),
        "leg_counted_once": _one_leg,
        "freedoms_for_constraints": lambda one: _platform_with(
            one, {"constraints": 6 * _platform_answers(one)["pairs"] - _platform_answers(one)["constraints"]}
        ),
        "spherical_as_universal": lambda one: _kind_as(one, "spherical", 4),
        "idle_forgotten": lambda one: {"remaining": _platform_answers(one)["mobility"]},
        "idle_as_mobility": lambda one: {"remaining": _platform_answers(one)["idle"]},
        "ground_moves": lambda one: {"mobility": _platform_answers(one)["mobility"] + 6},
    },
)

EXERCISES = (TABLE, LINKAGE, COINCIDENT, CHAIN, PLATFORM)
