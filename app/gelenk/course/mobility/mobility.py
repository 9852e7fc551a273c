"""Mobility of a mechanism by the formula of Grübler and Kutzbach: M = λ(n - 1) - Σ c_i.

λ is 3 in the plane and 6 in space, n counts the links including the ground, and the sum is over the j kinematic
*pairs*, not the joints: a joint where k links meet is k - 1 pairs. c_i is the i-th pair's (c_j once in the notes).

The formula ignores geometry. It is too low where constraints are redundant (a planar linkage counted in space,
Bennett's, Sarrus'), which the counts cannot show, so M ≤ 0 comes with a warning. It also counts freedoms that only spin
a bar about itself; the graph shows these, so they are named and subtracted.

Every result is checked by a second count over loops: M = Σ f_i - λ L + λ (components - 1).
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.mobility.mechanism import FLOATING, JointSplit, Mechanism, Pair, check_kind, joint_split
from gelenk.course.mobility.pairs import FREEDOMS, KINDS, Order, Space
from gelenk.course.mobility.screws import PostureMobility
from gelenk.errors import CertificationFailed, InvalidField, counted, quoted
from gelenk.language import marked, translated as _
from gelenk.robot.result import Result

_SHOWN_NAMES = 12

Verdict: TypeAlias = Literal["mechanism", "structure", "overconstrained"]
NodeCount: TypeAlias = tuple[str, int, str | None]
"""A joint, the number of links that meet there, and the kind of its pairs if that is not the others'."""


@dataclass(frozen=True, slots=True)
class PairCount(Result):
    """The pairs of one kind.

    Attributes:
        type: Of the pairs.
        order: Low where links touch in a surface, high where in a line or a point; null if it does not say.
        count: How many.
        constraints: c of each.
    """

    type: str
    order: Order | None
    count: int
    constraints: int


@dataclass(frozen=True, slots=True)
class Tally:
    """The numbers in the formula; a coupling, a joint that follows another one, is one more constraint."""

    space: Space
    links: int
    kinds: tuple[PairCount, ...]
    splits: tuple[JointSplit, ...] = ()
    couplings: int = 0

    @property
    def pairs(self) -> int:
        """Number of pairs, j."""
        return sum(kind.count for kind in self.kinds)

    @property
    def constraints(self) -> int:
        """Constraints of all pairs, Σ c_i."""
        return sum(kind.count * kind.constraints for kind in self.kinds)

    @property
    def mobility(self) -> int:
        """M = λ(n - 1) - Σ c_i, minus the couplings."""
        return FREEDOMS[self.space] * (self.links - 1) - self.constraints - self.couplings

    @property
    def mobility_without_split(self) -> int | None:
        """Mobility without the pairs that were added at joints of many links; None if none was added."""
        if not any(split.added for split in self.splits):
            return None
        return self.mobility + sum(split.added * split.constraints for split in self.splits)


def tally(found: Mechanism) -> Tally:
    """Return the numbers of a mechanism."""
    counts = Counter((pair.type, pair.order, pair.constraints) for pair in found.pairs)
    kinds = tuple(PairCount(kind, order, count, c) for (kind, order, c), count in counts.items())
    return Tally(found.space, len(found.links), kinds, found.splits, found.couplings)


def tally_of_counts(space: Space, links: int, counts: Mapping[str, int], nodes: Sequence[NodeCount]) -> Tally:
    """Return the numbers of a mechanism that is given only by how many pairs of each kind it has.

    Raises InvalidField for a kind that the space does not have, or more joints of many links than joints.

    Args:
        counts: Joints by the kind of their pairs; each joint counts once, however many links meet there.
        nodes: Those of the joints where more than two links meet; each adds k - 2 pairs.
    """
    for kind in counts:
        check_kind(space, kind, f"pairs/{kind}")
    totals, joints = Counter(counts), Counter[str]()
    common = next((kind for kind, count in counts.items() if count), "revolute") if len(counts) == 1 else "revolute"
    splits = []
    for i, (joint, meeting, own) in enumerate(nodes):
        kind = own or common
        check_kind(space, kind, f"coincident/{i}/type")
        joints[kind] += 1
        if joints[kind] > counts.get(kind, 0):
            reason = f"`pairs` counts {counted(counts.get(kind, 0), f'{kind} joint')}, which must include this joint"
            raise InvalidField(f"coincident/{i}", reason)
        if meeting > links:
            raise InvalidField(f"coincident/{i}/links", f"{meeting} links meet where there are {links}")
        totals[kind] += meeting - 2
        if meeting > 2:
            splits.append(joint_split(space, joint, meeting, meeting - 2, kind))
    kinds = (
        PairCount(kind, KINDS[kind].order, count, KINDS[kind].constraints(space) or 0)
        for kind, count in totals.items()
        if count
    )
    return Tally(space, links, tuple(kinds), tuple(splits))


def verdict(mobility: int) -> Verdict:
    """Classify a linkage by its mobility without idle freedoms."""
    if mobility > 0:
        return "mechanism"
    return "structure" if mobility == 0 else "overconstrained"


def certify_mobility(found: Mechanism) -> int:
    """Count M by loops, each of which removes λ of the freedoms; raises CertificationFailed if the formula differs."""
    freedoms, graph = FREEDOMS[found.space], found.topology
    by_pairs = sum(pair.freedoms for pair in found.pairs) - found.couplings
    by_loops = by_pairs - freedoms * graph.loops + freedoms * (len(graph.components) - 1)
    error = abs(by_loops - tally(found).mobility)
    if error:
        raise CertificationFailed("mobility", float(error), 0.0)
    return by_loops


def warnings(counted: Tally, found: Mechanism | None, stands: PostureMobility | None = None) -> list[str]:
    """Return what the number alone does not show, one sentence each; `found` is None if only the numbers are known."""
    sentences = [_split_sentence(split) for split in counted.splits if split.added and found is not None]
    idle = 0 if found is None else len(found.idle_spins())
    if found is not None:
        sentences += _graph_sentences(found)
    elif any(kind.type == "spherical" and kind.count > 1 for kind in counted.kinds):
        sentences.append(
            _(
                "Counts alone do not show whether a bar between two spherical joints spins idly about itself: give the "
                "links of each pair to have such freedoms found."
            )
        )
    if idle:
        text = _(
            "Of the mobility {mobility}, {idle} is idle: a part that two spherical joints hold spins about the line "
            "through their centres and moves nothing else."
        )
        sentences.append(text.format(mobility=counted.mobility, idle=idle))
    is_open = found is not None and found.topology.loops == 0
    if stands is not None and stands.redundant:
        sentences.append(_geometry_sentence(counted, stands))
    elif stands is None and counted.mobility - idle <= 0 and counted.pairs and not is_open:
        sentences.append(_(_GEOMETRY[counted.space]))
    return sentences


def _geometry_sentence(counted: Tally, stands: PostureMobility) -> str:
    text = _(
        "The formula ignores geometry: as the linkage stands, 1 of its {constraints} constraints is redundant, and its "
        "mobility is {actual}, not {mobility}."
        if stands.redundant == 1
        else "The formula ignores geometry: as the linkage stands, {redundant} of its {constraints} constraints are "
        "redundant, and its mobility is {actual}, not {mobility}."
    )
    return text.format(
        redundant=stands.redundant,
        constraints=counted.constraints,
        actual=stands.mobility,
        mobility=counted.mobility,
    )


_GEOMETRY: dict[Space, str] = {
    "planar": marked(
        "The formula ignores geometry: with special dimensions, such as equal, parallel cranks, constraints are "
        "redundant and the linkage may move nonetheless."
    ),
    "spatial": marked(
        "The formula ignores geometry: where axes are parallel or meet in a point, or with special dimensions, "
        "constraints are redundant and the linkage may move nonetheless, as a planar linkage counted with λ = 6, "
        "Bennett's and Sarrus' do, each with mobility 1. A planar linkage is to be counted with λ = 3."
    ),
}


def _split_sentence(split: JointSplit) -> str:
    text = _(
        "{links} links meet at joint {joint}: that is {pairs} pairs, of which 1 was missing and has been added."
        if split.added == 1
        else "{links} links meet at joint {joint}: that is {pairs} pairs, of which {added} were missing and have been "
        "added."
    )
    return text.format(links=split.links, joint=quoted(split.joint), pairs=split.pairs, added=split.added)


def _graph_sentences(found: Mechanism) -> list[str]:
    graph, names = found.topology, found.links
    sentences = []
    if len(graph.components) > 1:
        lost = [part for part in graph.components if found.ground not in part]
        text = _(
            "The links are not all connected: a part, that with {links}, is not joined to the ground, and each such "
            "part counts with the {freedoms} freedoms of a free body."
            if len(lost) == 1
            else "The links are not all connected: {count} parts, those with {links}, are not joined to the ground, "
            "and each such part counts with the {freedoms} freedoms of a free body."
        )
        loose = _names([names[part[0]] for part in lost])
        sentences.append(text.format(count=len(lost), links=loose, freedoms=FREEDOMS[found.space]))
    if graph.loops:
        hanging = [names[link] for link in graph.pendants]
        if hanging:
            text = _(
                "A single pair holds {links}, while other links form loops. Should such a link meet others at a joint "
                "as well, that joint has more than two links and must be split: name it in `coincident`."
            )
            sentences.append(text.format(links=_names(hanging)))
        if rollers := _rollers(found):
            text = _("If {links} is a round roller, its spin about its own pin is idle.")
            sentences.append(text.format(links=_names(rollers)))
    if any(pair.type == FLOATING for pair in found.pairs):
        sentences.append(_("A floating joint removes no freedom: the links below it are unconstrained."))
    return sentences


def _names(names: Sequence[str]) -> str:
    """Return the first names, quoted, and how many more there are."""
    shown, more = ", ".join(map(quoted, names[:_SHOWN_NAMES])), len(names) - _SHOWN_NAMES
    return shown if more <= 0 else _("{names} and {more} more").format(names=shown, more=more)


def _rollers(found: Mechanism) -> tuple[str, ...]:
    """Return links pinned to a moving link and touching another one, as a roller on a cam does."""
    at: dict[str, list[Pair]] = {}
    for pair in found.pairs:
        for link in pair.links:
            at.setdefault(link, []).append(pair)
    rollers, ground = [], found.links[found.ground]
    for link, pairs in at.items():
        kinds = {pair.type: pair for pair in pairs}
        if len(pairs) == 2 and kinds.keys() == {"cam", "revolute"} and ground not in {link, *kinds["revolute"].links}:
            rollers.append(link)
    return tuple(rollers)
