"""Links and pairs as a graph: connected parts, pairs on loops, and the number of independent loops.

A link is a node, a pair is an edge; two pairs between the same links are a loop. A spanning forest holds all pairs but
L, each of which closes one loop: L = j - n + (number of components).
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

Edge: TypeAlias = tuple[int, int]
ChainKind: TypeAlias = Literal["open", "closed", "mixed"]


@dataclass(frozen=True, slots=True)
class Topology:
    """Properties of a graph of links and pairs.

    Attributes:
        components: Indices of the links in each connected part, in ascending order.
        bridges: Indices of the pairs that lie on no loop.
        pendants: Indices of the links that a single pair holds.
    """

    components: tuple[tuple[int, ...], ...]
    loops: int
    bridges: tuple[int, ...]
    pendants: tuple[int, ...]

    @property
    def chain(self) -> ChainKind:
        """Closed if two paths without a common pair join any two links, open without loops, else mixed."""
        if self.loops == 0:
            return "open"
        return "closed" if len(self.components) == 1 and not self.bridges else "mixed"


def topology(count: int, edges: Sequence[Edge]) -> Topology:
    """Compute the topology of `count` links, joined by pairs."""
    beside: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for number, (a, b) in enumerate(edges):
        beside[a].append((b, number))
        beside[b].append((a, number))
    components, parents, seen = [], dict[int, tuple[int, int]](), set[int]()
    for root in range(count):
        if root in seen:
            continue
        part = [root]
        seen.add(root)
        for node in part:  # which grows meanwhile
            for other, number in beside[node]:
                if other not in seen:
                    seen.add(other)
                    parents[other] = node, number
                    part.append(other)
        components.append(tuple(sorted(part)))
    tree = {number for _, number in parents.values()}
    closing = [edge for number, edge in enumerate(edges) if number not in tree]
    bridges = tuple(sorted(_bridges(parents, closing)))
    pendants = tuple(node for node, around in enumerate(beside) if len(around) == 1)
    return Topology(tuple(components), len(closing), bridges, pendants)


def _bridges(parents: dict[int, tuple[int, int]], closing: Sequence[Edge]) -> list[int]:
    """Return the edges of a forest below which no closing edge leaves; `parents` in the order of the walk.

    Bit k of a node is set if one end of the k-th closing edge, and not both, is the node or below it.
    """
    leaving: Counter[int] = Counter()
    for k, edge in enumerate(closing):
        for node in edge:
            leaving[node] ^= 1 << k
    for node, (parent, _) in reversed(parents.items()):
        leaving[parent] ^= leaving[node]
    return [number for node, (_, number) in parents.items() if not leaving[node]]
