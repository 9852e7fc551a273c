"""Links and kinematic pairs, with joints of more than two links split.

The notes call a joint coincident if it holds more than two pairs; what counts is more than two *links*: k links at one
joint are k - 1 pairs. A pair may name its joint, and a list of nodes may give the links that meet there. Pairs that a
node still needs are added and marked, because forgetting them is the most common mistake in counting.
"""

from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

from gelenk.course.mobility.pairs import FREEDOMS, KINDS, Order, PairGeometry, Space, allowed_kinds
from gelenk.course.mobility.topology import Edge, Topology, topology
from gelenk.errors import InvalidField, listed, quoted
from gelenk.robot.description import Description
from gelenk.robot.result import Result

FLOATING = "floating"
"""URDF's name for a joint that removes no freedom: not a pair, and c = 0."""


@dataclass(frozen=True, slots=True)
class GivenPair:
    """A pair as described: the names of its two links, its kind, the joint it is part of, and its geometry."""

    name: str
    link_a: str
    link_b: str
    kind: str
    joint: str | None = None
    geometry: PairGeometry | None = None


@dataclass(frozen=True, slots=True)
class Pair(Result):
    """A kinematic pair as it is counted.

    Attributes:
        name: Of the pair.
        link_a: One of the two links.
        link_b: The other one.
        type: Kind; of a robot also `floating`, which is not a pair and removes nothing.
        order: Low where the links touch in a surface, high in a line or point.
        constraints: c: degrees of freedom that it removes.
        freedoms: f = λ - c: degrees of freedom that it leaves.
        joint: The joint it is part of, if given.
        added: Whether it was missing at a joint of more than two links.
    """

    name: str
    link_a: str
    link_b: str
    type: str
    order: Order | None
    constraints: int
    freedoms: int
    joint: str | None
    added: bool

    @property
    def links(self) -> tuple[str, str]:
        """Names of the two links."""
        return self.link_a, self.link_b


@dataclass(frozen=True, slots=True)
class Node:
    """A joint where links meet, and the kind of the missing pairs there; if None, that of the others, or revolute."""

    joint: str
    links: tuple[str, ...]
    kind: str | None = None


@dataclass(frozen=True, slots=True)
class JointSplit(Result):
    """A joint of more than two links.

    Attributes:
        joint: Its name.
        links: k: links that meet there.
        pairs: k - 1: pairs that it is.
        added: How many of these had not been given.
        constraints: c of each of those.
    """

    joint: str
    links: int
    pairs: int
    added: int
    constraints: int


def joint_split(space: Space, joint: str, links: int, added: int, kind: str) -> JointSplit:
    """Return a joint of k links as k - 1 pairs, of which a number of a kind had not been given."""
    return JointSplit(joint, links, links - 1, added, KINDS[kind].constraints(space) or 0)


@dataclass(frozen=True, slots=True)
class IdleSpin(Result):
    """A freedom that moves only its own links: they spin about the line through two spherical joints.

    Attributes:
        links: The links that can move alone.
        joints: The two spherical joints.
    """

    links: list[str]
    joints: list[str]


@dataclass(frozen=True)
class Mechanism:
    """Links joined by pairs.

    Attributes:
        ground: Index of the link at rest.
        pairs: Pairs after splitting.
        geometries: Position and axes of each pair, if known.
        couplings: Number of joints that follow another one, each a further constraint.
    """

    space: Space
    links: tuple[str, ...]
    ground: int
    pairs: tuple[Pair, ...]
    geometries: tuple[PairGeometry | None, ...]
    splits: tuple[JointSplit, ...] = ()
    couplings: int = 0

    @cached_property
    def ends(self) -> tuple[Edge, ...]:
        """Indices of the two links of each pair."""
        index = {name: i for i, name in enumerate(self.links)}
        return tuple((index[pair.link_a], index[pair.link_b]) for pair in self.pairs)

    @cached_property
    def topology(self) -> Topology:
        """Graph of links and pairs."""
        return topology(len(self.links), self.ends)

    def idle_spins(self) -> list[IdleSpin]:
        """Find the parts that spherical joints at exactly two points hold, so that each may spin idly.

        Removing the spherical pairs leaves the parts; the part with the ground counts as at rest.
        """
        balls = [pair for pair in self.pairs if pair.type == "spherical"]
        rest = [ends for pair, ends in zip(self.pairs, self.ends, strict=True) if pair.type != "spherical"]
        spins = []
        for part in topology(len(self.links), rest).components if balls else ():
            inside = {self.links[link]: None for link in part}
            # A spherical joint between two links of the same part does not hold the part.
            holding = [ball for ball in balls if (ball.link_a in inside) != (ball.link_b in inside)]
            centres = {(ball.joint is None, ball.joint or ball.name): None for ball in holding}
            if self.ground not in part and len(centres) == 2:
                spins.append(IdleSpin([*inside], [name for _, name in centres]))
        return spins


def mechanism(
    space: Space, links: Sequence[str], ground: int, given: Sequence[GivenPair], nodes: Sequence[Node] = ()
) -> Mechanism:
    """Build a mechanism from its description, and split its coincident joints.

    Raises InvalidField for an unknown or duplicate name, a pair of a link with itself, a kind that the space does not
    have, or a joint with more pairs than its links need.
    """
    known = dict.fromkeys(links)
    _refuse_repeated(links, "links", "is used for more than one link")
    pairs = [_pair(space, known, one, f"pairs/{i}") for i, one in enumerate(given)]
    _refuse_repeated([pair.name for pair in pairs], "pairs", "is used for more than one pair")
    pairs, splits = _split(space, known, pairs, nodes)
    geometries = (*(one.geometry for one in given), *(None for _ in pairs[len(given) :]))
    return Mechanism(space, tuple(links), ground, tuple(pairs), geometries, tuple(splits))


def mechanism_of_tree(description: Description) -> Mechanism:
    """Convert a robot to links and pairs in space: an open tree, each mimic joint with one more constraint."""
    links = [link.name for link in description.links]
    pairs = []
    for joint in description.joints:
        if joint.type == FLOATING:
            free = FREEDOMS["spatial"]
            pairs.append(Pair(joint.name, joint.parent, joint.child, FLOATING, None, 0, free, None, False))
        else:
            kind = "revolute" if joint.type == "continuous" else joint.type
            pairs.append(_of_kind("spatial", joint.name, kind, (joint.parent, joint.child)))
    couplings = sum(joint.mimic is not None for joint in description.joints)
    ground, unknown = links.index(description.root), (None,) * len(pairs)
    return Mechanism("spatial", tuple(links), ground, tuple(pairs), unknown, couplings=couplings)


def check_kind(space: Space, kind: str, field: str) -> None:
    """Refuse a kind of pair that a space does not have."""
    if KINDS[kind].constraints(space) is None:
        where = "the plane (λ = 3)" if space == "planar" else "space (λ = 6)"
        allowed = ", ".join(allowed_kinds(space))
        raise InvalidField(field, f"there is no {quoted(kind)} pair in {where}; allowed: {allowed}")


def _of_kind(
    space: Space, name: str, kind: str, links: tuple[str, str], joint: str | None = None, added: bool = False
) -> Pair:
    c = KINDS[kind].constraints(space) or 0
    return Pair(name, *links, kind, KINDS[kind].order, c, FREEDOMS[space] - c, joint, added)


def _pair(space: Space, links: Collection[str], given: GivenPair, field: str) -> Pair:
    for end in ("link_a", "link_b"):
        _refuse_unknown(links, getattr(given, end), f"{field}/{end}")
    if given.link_a == given.link_b:
        reason = f"a pair joins two links; this one joins {quoted(given.link_a)} to itself"
        raise InvalidField(f"{field}/link_b", reason)
    check_kind(space, given.kind, f"{field}/type")
    return _of_kind(space, given.name, given.kind, (given.link_a, given.link_b), given.joint)


def _refuse_unknown(links: Collection[str], name: str, field: str) -> None:
    if name not in links:
        raise InvalidField(field, f"there is no link {quoted(name)}; the links are {listed(tuple(links))}")


def _refuse_repeated(names: Sequence[str], field: str, reason: str) -> None:
    if repeated := tuple(name for name, count in Counter(names).items() if count > 1):
        raise InvalidField(field, f"{listed(repeated)} {reason}")


def _split(
    space: Space, links: Collection[str], pairs: list[Pair], nodes: Sequence[Node]
) -> tuple[list[Pair], list[JointSplit]]:
    """Return the pairs, with those added that joints of more than two links still need, and the splits."""
    for i, node in enumerate(nodes):
        _check_node(space, links, node, f"coincident/{i}")
    _refuse_repeated([node.joint for node in nodes], "coincident", "is used for more than one joint")
    meeting, kinds = {node.joint: node.links for node in nodes}, {node.joint: node.kind for node in nodes}
    pairs = [_placed(pair, meeting, i) for i, pair in enumerate(pairs)]
    at: dict[str, list[int]] = {joint: [] for joint in meeting}
    for i, pair in enumerate(pairs):
        if pair.joint is not None:
            at.setdefault(pair.joint, []).append(i)
            if pair.joint not in kinds:
                meeting[pair.joint] = tuple(dict.fromkeys((*meeting.get(pair.joint, ()), *pair.links)))
    splits: list[JointSplit] = []
    added: list[Pair] = []
    for joint, here in meeting.items():
        missing = _missing(joint, here, pairs, at[joint])
        common = {pairs[i].type for i in at[joint]}
        kind = kinds.get(joint) or (common.pop() if len(common) == 1 else "revolute")
        added += [_of_kind(space, f"{joint} +{i}", kind, two, joint, True) for i, two in enumerate(missing, start=1)]
        if len(here) > 2:
            splits.append(joint_split(space, joint, len(here), len(missing), kind))
    return [*pairs, *added], splits


def _check_node(space: Space, links: Collection[str], node: Node, field: str) -> None:
    for name in node.links:
        _refuse_unknown(links, name, f"{field}/links")
    _refuse_repeated(node.links, f"{field}/links", "is named twice")
    if node.kind is not None:
        check_kind(space, node.kind, f"{field}/type")


def _placed(pair: Pair, meeting: dict[str, tuple[str, ...]], number: int) -> Pair:
    """Return the pair with its joint: the one it names, else the only node where both of its links meet."""
    field = f"pairs/{number}/joint"
    if pair.joint is not None:
        here = meeting.get(pair.joint, pair.links)
        if pair.link_a not in here or pair.link_b not in here:
            raise InvalidField(
                field, f"`coincident` does not name both links of this pair at joint {quoted(pair.joint)}"
            )
        return pair
    fitting = tuple(joint for joint, links in meeting.items() if pair.link_a in links and pair.link_b in links)
    if len(fitting) > 1:
        reason = f"the pair {quoted(pair.name)} could belong to any of {listed(fitting)}: set `joint`"
        raise InvalidField(field, reason)
    return replace(pair, joint=fitting[0]) if fitting else pair


def _missing(joint: str, links: tuple[str, ...], pairs: list[Pair], numbers: list[int]) -> list[tuple[str, str]]:
    """Return the pairs needed to connect the separate parts that some pairs, at a joint, leave of its links."""
    part = {link: link for link in links}
    for number in numbers:
        first, second = (part[link] for link in pairs[number].links)
        if first == second:
            reason = (
                f"{len(links)} links meet at joint {quoted(joint)}, which makes {len(links) - 1} pairs; the pair "
                f"{quoted(pairs[number].name)} is redundant"
            )
            raise InvalidField(f"pairs/{number}", reason)
        part = {link: first if which == second else which for link, which in part.items()}
    return list(pairwise(dict.fromkeys(part.values())))
