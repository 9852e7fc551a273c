"""Links and kinematic pairs, with joints of more than two links split.

The notes call a joint coincident if it holds more than two pairs; what counts is more than two *links*: k links at one
joint are k - 1 pairs. A pair may name its joint, and a list of nodes may give the links that meet there. Pairs that a
node still needs are added and marked, because forgetting them is the most common mistake in counting.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from gelenk.course.mobility.pairs import FREEDOMS, KINDS, Order, PairGeometry, Space, allowed_kinds
from gelenk.course.mobility.topology import Topology, topology
from gelenk.errors import InvalidField, listed, quoted
from gelenk.robot.description import Description

FLOATING = "floating"
"""URDF's name for a joint that removes no freedom: not a pair, and c = 0."""
_KIND_OF_JOINT = {"continuous": "revolute"}


@dataclass(frozen=True, slots=True)
class Pair:
    """A kinematic pair of a mechanism.

    Attributes:
        name: Name for people.
        kind: Key of `KINDS`, or `FLOATING`.
        links: Indices of the two links.
        order: Low or high; None for `floating`.
        constraints: c.
        freedoms: f = λ - c.
        joint: Joint it is part of, if known.
        added: Whether it was missing at a joint of more than two links, and has been added.
        geometry: Position and axes, if known.
    """

    name: str
    kind: str
    links: tuple[int, int]
    order: Order | None
    constraints: int
    freedoms: int
    joint: str | None = None
    added: bool = False
    geometry: PairGeometry | None = None


@dataclass(frozen=True, slots=True)
class Node:
    """A joint where links meet.

    Attributes:
        joint: Name of the joint.
        links: Names of the links.
        kind: Kind of the missing pairs there; if None, that of the other pairs, or revolute.
    """

    joint: str
    links: tuple[str, ...]
    kind: str | None = None


@dataclass(frozen=True, slots=True)
class Split:
    """A joint of k > 2 links as k - 1 pairs, of which `added` were missing, each with c = `constraints`."""

    joint: str
    links: int
    pairs: int
    added: int
    constraints: int


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
class IdleSpin:
    """Links that can spin about the line through two spherical joints' centres without moving anything else."""

    links: tuple[str, ...]
    joints: tuple[str, str]


@dataclass(frozen=True, slots=True)
class Mechanism:
    """Links joined by pairs.

    Attributes:
        space: Planar or spatial.
        links: Names of the links.
        ground: Index of the link at rest.
        pairs: Pairs after splitting.
        splits: Joints of more than two links.
        couplings: Number of joints that follow another one, each a further constraint.
        topology: Graph of links and pairs.
    """

    space: Space
    links: tuple[str, ...]
    ground: int
    pairs: tuple[Pair, ...]
    splits: tuple[Split, ...]
    couplings: int
    topology: Topology

    def idle_spins(self) -> tuple[IdleSpin, ...]:
        """Find the parts that spherical joints at exactly two points hold, so that each may spin idly.

        Removing the spherical pairs leaves the parts; the part with the ground counts as at rest.
        """
        balls = [pair for pair in self.pairs if pair.kind == "spherical"]
        rest = [pair.links for pair in self.pairs if pair.kind != "spherical"]
        parts = topology(len(self.links), rest).components if balls else ()
        spins = []
        for part in parts:
            inside = set(part)
            # A spherical joint between two links of the same part does not hold the part.
            holding = [ball for ball in balls if (ball.links[0] in inside) != (ball.links[1] in inside)]
            centres = {(ball.joint is None, ball.joint or ball.name): None for ball in holding}
            if self.ground not in inside and len(centres) == 2:
                (_, first), (_, second) = centres
                spins.append(IdleSpin(tuple(self.links[link] for link in part), (first, second)))
        return tuple(spins)


def mechanism(
    space: Space, links: Sequence[str], ground: int, given: Sequence[GivenPair], nodes: Sequence[Node] = ()
) -> Mechanism:
    """Build a mechanism from its description, and split its coincident joints.

    Raises:
        InvalidField: An unknown or duplicate name, a pair of a link with itself, a kind that the space does not have,
            or a joint with more pairs than its links need.
    """
    index = {name: i for i, name in enumerate(links)}
    if len(index) < len(links):
        raise InvalidField("links", f"{listed(_repeated(links))} is used for more than one link")
    pairs = [_pair(space, index, one, f"pairs/{i}") for i, one in enumerate(given)]
    if repeated := _repeated([pair.name for pair in pairs]):
        raise InvalidField("pairs", f"{listed(repeated)} is used for more than one pair")
    pairs, splits = _split(space, index, pairs, nodes)
    edges = [pair.links for pair in pairs]
    return Mechanism(space, tuple(links), ground, tuple(pairs), tuple(splits), 0, topology(len(links), edges))


def mechanism_of_tree(description: Description) -> Mechanism:
    """Convert a robot to links and pairs in space: an open tree, each mimic joint with one more constraint."""
    index = {link.name: i for i, link in enumerate(description.links)}
    pairs = []
    for joint in description.joints:
        links = (index[joint.parent], index[joint.child])
        if joint.type == FLOATING:
            pairs.append(Pair(joint.name, FLOATING, links, None, 0, FREEDOMS["spatial"]))
        else:
            pairs.append(_of_kind("spatial", joint.name, _KIND_OF_JOINT.get(joint.type, joint.type), links))
    couplings = sum(joint.mimic is not None for joint in description.joints)
    found = topology(len(index), [pair.links for pair in pairs])
    return Mechanism("spatial", tuple(index), index[description.root], tuple(pairs), (), couplings, found)


def check_kind(space: Space, kind: str, field: str) -> None:
    """Refuse a kind of pair that a space does not have."""
    if KINDS[kind].constraints(space) is None:
        where = "the plane (λ = 3)" if space == "planar" else "space (λ = 6)"
        raise InvalidField(
            field, f"there is no {quoted(kind)} pair in {where}; allowed: {', '.join(allowed_kinds(space))}"
        )


def _of_kind(
    space: Space, name: str, kind: str, links: tuple[int, int], joint: str | None = None, added: bool = False
) -> Pair:
    c = KINDS[kind].constraints(space)
    assert c is not None  # noqa: S101 - checked before by `check_kind`
    return Pair(name, kind, links, KINDS[kind].order, c, FREEDOMS[space] - c, joint, added)


def _pair(space: Space, index: dict[str, int], given: GivenPair, field: str) -> Pair:
    for end in ("link_a", "link_b"):
        name = getattr(given, end)
        if name not in index:
            raise InvalidField(f"{field}/{end}", f"there is no link {quoted(name)}; the links are {listed((*index,))}")
    if given.link_a == given.link_b:
        raise InvalidField(
            f"{field}/link_b", f"a pair joins two links; this one joins {quoted(given.link_a)} to itself"
        )
    check_kind(space, given.kind, f"{field}/type")
    pair = _of_kind(space, given.name, given.kind, (index[given.link_a], index[given.link_b]), given.joint)
    return replace(pair, geometry=given.geometry)


def _repeated(names: Sequence[str]) -> tuple[str, ...]:
    return tuple(name for name, count in Counter(names).items() if count > 1)


def _split(
    space: Space, index: dict[str, int], pairs: list[Pair], nodes: Sequence[Node]
) -> tuple[list[Pair], list[Split]]:
    """Return the pairs, with those added that joints of more than two links still need, and the splits."""
    meeting = {node.joint: _node_links(space, index, node, i) for i, node in enumerate(nodes)}
    kinds = {node.joint: node.kind for node in nodes}
    if repeated := _repeated([node.joint for node in nodes]):
        raise InvalidField("coincident", f"{listed(repeated)} is used for more than one joint")
    pairs = [_placed(pair, meeting, i) for i, pair in enumerate(pairs)]
    at: dict[str, list[int]] = {joint: [] for joint in meeting}
    for i, pair in enumerate(pairs):
        if pair.joint is not None:
            at.setdefault(pair.joint, []).append(i)
            if pair.joint not in kinds:
                meeting[pair.joint] = tuple(dict.fromkeys((*meeting.get(pair.joint, ()), *pair.links)))
    splits: list[Split] = []
    added: list[Pair] = []
    for joint, links in meeting.items():
        here = [pairs[i] for i in at[joint]]
        missing = _missing(joint, links, here, at[joint])
        kind = kinds.get(joint) or _common_kind(here)
        added += [_of_kind(space, f"{joint} +{i}", kind, two, joint, True) for i, two in enumerate(missing, start=1)]
        if len(links) > 2:
            c = KINDS[kind].constraints(space) or 0
            splits.append(Split(joint, len(links), len(links) - 1, len(missing), c))
    return [*pairs, *added], splits


def _node_links(space: Space, index: dict[str, int], node: Node, number: int) -> tuple[int, ...]:
    field = f"coincident/{number}/links"
    for name in node.links:
        if name not in index:
            raise InvalidField(field, f"there is no link {quoted(name)}; the links are {listed((*index,))}")
    if repeated := _repeated(node.links):
        raise InvalidField(field, f"{listed(repeated)} is named twice")
    if node.kind is not None:
        check_kind(space, node.kind, f"coincident/{number}/type")
    return tuple(index[name] for name in node.links)


def _placed(pair: Pair, meeting: dict[str, tuple[int, ...]], number: int) -> Pair:
    """Return the pair with its joint: the one it names, else the only node where both of its links meet."""
    if pair.joint is not None:
        links = meeting.get(pair.joint)
        if links is not None and not set(pair.links) <= set(links):
            reason = f"`coincident` does not name both links of this pair at joint {quoted(pair.joint)}"
            raise InvalidField(f"pairs/{number}/joint", reason)
        return pair
    fitting = tuple(joint for joint, links in meeting.items() if pair.links[0] in links and pair.links[1] in links)
    if len(fitting) > 1:
        reason = f"the pair {quoted(pair.name)} could belong to any of {listed(fitting)}: set `joint`"
        raise InvalidField(f"pairs/{number}/joint", reason)
    if not fitting:
        return pair
    return replace(pair, joint=fitting[0])


def _missing(joint: str, links: tuple[int, ...], here: list[Pair], numbers: list[int]) -> list[tuple[int, int]]:
    """Return the pairs needed to connect the separate parts that the pairs at a joint leave of its links."""
    part = {link: link for link in links}
    for pair, number in zip(here, numbers, strict=True):
        first, second = part[pair.links[0]], part[pair.links[1]]
        if first == second:
            reason = (
                f"{len(links)} links meet at joint {quoted(joint)}, which makes {len(links) - 1} pairs; the pair "
                f"{quoted(pair.name)} is redundant"
            )
            raise InvalidField(f"pairs/{number}", reason)
        part = {link: first if which == second else which for link, which in part.items()}
    firsts = list(dict.fromkeys(part.values()))
    return list(pairwise(firsts))


def _common_kind(here: list[Pair]) -> str:
    kinds = {pair.kind for pair in here}
    return kinds.pop() if len(kinds) == 1 else "revolute"
