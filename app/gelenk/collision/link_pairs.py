"""Which pairs of a robot's links can touch: not neighbours, nor those that an SRDF leaves out."""

from collections.abc import Sequence
from itertools import combinations

from gelenk.collision.bodies import Body
from gelenk.collision.pairs import LinkPair, PairReason
from gelenk.robot.description import Description
from gelenk.robot.xml import read_xml


def disabled_pairs(srdf: bytes) -> list[tuple[str, str]]:
    """Return the links of each `disable_collisions` in an SRDF; raises InvalidUrdf if it is no well-formed XML."""
    root = read_xml(srdf.decode("utf-8", "replace"))
    found = (child.attributes for child in root.children if child.tag == "disable_collisions")
    return [(pair["link1"], pair["link2"]) for pair in found if {"link1", "link2"} <= pair.keys()]


def find_pairs(
    description: Description, bodies: Sequence[Body], disabled: Sequence[tuple[str, str]] = ()
) -> tuple[LinkPair, ...]:
    """Find all pairs of links that have bodies, and why some need no look; `disabled` are those of an SRDF."""
    links = list(dict.fromkeys(body.link for body in bodies))
    apart = _neighbours(description, frozenset(links))
    left_out = {frozenset(pair) for pair in disabled}
    pairs = []
    for a, b in combinations(links, 2):
        pair = frozenset((a, b))
        reason: PairReason | None = "neighbours" if pair in apart else "srdf" if pair in left_out else None
        pairs.append(LinkPair(a, b, reason is None, reason))
    return tuple(pairs)


def _neighbours(description: Description, links: frozenset[str]) -> set[frozenset[str]]:
    """Return pairs of links with bodies that are rigidly joined, or have one joint and no other body between them."""
    found = set()
    for link in links:
        waiting, seen = [(link, 0, False)], {link}
        while waiting:
            here, moved, is_past_body = waiting.pop()
            above = [joint] if (joint := description.joint_above.get(here)) else []
            for joint in (*description.joints_below[here], *above):
                other = joint.child if joint.parent == here else joint.parent
                crossed = moved + (joint.type != "fixed")
                if other in seen or crossed > 1 or (crossed and is_past_body):
                    continue
                seen.add(other)
                if other in links:
                    found.add(frozenset((link, other)))
                if other not in links or not crossed:
                    waiting.append((other, crossed, is_past_body or other in links))
    return found
