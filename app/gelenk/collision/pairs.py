"""Pairs of a robot's links, and whether contacts between them are looked for."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

PairReason: TypeAlias = Literal["neighbours", "srdf", "always", "edited"]
SAMPLES = 10_000
"""Number of configurations at all of which links must be in contact to be so `always`."""


@dataclass(frozen=True, slots=True)
class LinkPair:
    """Two links that have bodies, in the order of the description.

    Attributes:
        a, b: Names of the links.
        active: Whether contacts between them are looked for.
        reason: Why not; `edited` where a person decided, None for an active pair that nobody touched.
    """

    a: str
    b: str
    active: bool
    reason: PairReason | None = None


def edited(pairs: Sequence[LinkPair], choices: Iterable[tuple[str, str, bool]]) -> tuple[LinkPair, ...]:
    """Return the pairs as a person chose them; what names no pair, or says the same, changes nothing."""
    chosen = {frozenset((a, b)): active for a, b, active in choices}
    return tuple(
        pair
        if chosen.get(frozenset((pair.a, pair.b)), pair.active) == pair.active
        else LinkPair(pair.a, pair.b, not pair.active, "edited")
        for pair in pairs
    )
