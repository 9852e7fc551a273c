"""Links and pairs as a graph: connected parts, pairs on loops, and the number of independent loops.

A link is a node, a pair is an edge; two pairs between the same links are a loop. A spanning forest holds all pairs but
L, each of which closes one loop: L = j - n + (number of components).
"""

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
        loops: L, the number of independent loops: pairs beyond a spanning forest.
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
    depths, parents, through, roots = _spanning_forest(count, edges)
    members: dict[int, list[int]] = {}
    for node, root in enumerate(roots):
        members.setdefault(root, []).append(node)
    tree = {edge for edge in through if edge is not None}
    closing = [edge for number, edge in enumerate(edges) if number not in tree]
    covered = _covered(depths, parents, closing)
    bridges = sorted(edge for node, edge in enumerate(through) if edge is not None and node not in covered)
    degrees = [0] * count
    for a, b in edges:
        degrees[a] += 1
        degrees[b] += 1
    pendants = tuple(node for node, degree in enumerate(degrees) if degree == 1)
    return Topology(tuple(map(tuple, members.values())), len(closing), tuple(bridges), pendants)


def _spanning_forest(count: int, edges: Sequence[Edge]) -> tuple[list[int], list[int], list[int | None], list[int]]:
    """Return for each node its depth, its parent (itself for a root), the edge from the parent, and its root."""
    beside: list[list[tuple[int, int]]] = [[] for _ in range(count)]
    for number, (a, b) in enumerate(edges):
        beside[a].append((b, number))
        beside[b].append((a, number))
    depths, parents, roots = [-1] * count, list(range(count)), list(range(count))
    through: list[int | None] = [None] * count
    for root in range(count):
        if depths[root] >= 0:
            continue
        depths[root] = 0
        waiting = [root]
        while waiting:
            node = waiting.pop()
            for other, number in beside[node]:
                if depths[other] < 0:
                    depths[other], parents[other] = depths[node] + 1, node
                    through[other], roots[other] = number, root
                    waiting.append(other)
    return depths, parents, through, roots


def _covered(depths: list[int], parents: list[int], closing: Sequence[Edge]) -> set[int]:
    """Return the nodes whose edge to the parent lies on a loop, each found once: known stretches are skipped."""
    covered: set[int] = set()
    leap = list(range(len(depths)))

    def top(node: int) -> int:
        while leap[node] != node:
            leap[node] = leap[leap[node]]
            node = leap[node]
        return node

    for a, b in closing:
        low, high = top(a), top(b)
        while low != high:
            if depths[low] < depths[high]:
                low, high = high, low
            covered.add(low)
            leap[low] = parents[low]
            low = top(low)
    return covered
