"""Solutions by a table typed from the lecture, and of chains by removing pairs one by one."""

from typing import Any

FREEDOMS_IN_SPACE = {
    "revolute": 1, "prismatic": 1, "screw": 1, "universal": 2, "cylindrical": 2, "spherical": 3, "planar": 3,
    "sphere_in_groove": 4, "point_contact": 5,
}  # fmt: skip


def verdict(mobility: int) -> str:
    return "mechanism" if mobility >= 1 else "structure" if mobility == 0 else "overconstrained"


def linkage(numbers: Any) -> dict[str, Any]:
    low = numbers.revolute + numbers.prismatic
    freedoms = low + 2 * numbers.cam
    loops = low + numbers.cam - numbers.links + 1
    mobility = freedoms - 3 * loops
    return {"constraints": 2 * low + numbers.cam, "mobility": mobility, "verdict": verdict(mobility)}


def coincident(numbers: Any) -> dict[str, Any]:
    pairs = numbers.simple + 2 * numbers.triple + 3 * numbers.quadruple
    return {"pairs": pairs, "mobility": pairs - 3 * (pairs - numbers.links + 1)}


def parts(links: int, pairs: list[tuple[int, int]]) -> int:
    colours = list(range(links))
    for a, b in pairs:
        colours = [colours[a] if colour == colours[b] else colour for colour in colours]
    return len(set(colours))


def chain(numbers: Any) -> dict[str, Any]:
    links, pairs = numbers.links, list(numbers.pairs)
    bridges = sum(parts(links, [*pairs[:i], *pairs[i + 1 :]]) > parts(links, pairs) for i in range(len(pairs)))
    loops = len(pairs) - links + parts(links, pairs)
    return {"loops": loops, "bridges": bridges, "chain": "open" if not loops else "mixed" if bridges else "closed"}


def platform(numbers: Any) -> dict[str, Any]:
    legs, leg = numbers.legs, numbers.leg
    links, pairs = 2 + legs * (len(leg) - 1), legs * len(leg)
    freedoms = legs * sum(FREEDOMS_IN_SPACE[kind] for kind in leg)
    mobility = freedoms - 6 * (pairs - links + 1)
    idle = legs if leg.count("spherical") == 2 else 0
    return {
        "links": links,
        "pairs": pairs,
        "constraints": 6 * pairs - freedoms,
        "mobility": mobility,
        "idle": idle,
        "remaining": mobility - idle,
    }


SOLUTIONS = {
    "mobility.pairs": lambda kinds: {"constraints": [6 - FREEDOMS_IN_SPACE[kind] for kind in kinds]},
    "mobility.linkage": linkage,
    "mobility.coincident": coincident,
    "mobility.chain": chain,
    "mobility.platform": platform,
}
DIGESTS = {
    "mobility.linkage:1": "52b09edc1dc1409d",
    "mobility.pairs:1": "d1ca16bc1b267b63",
    "mobility.chain:1": "a7af218fd9790d96",
    "mobility.coincident:1": "2e611b87c473ac93",
    "mobility.platform:1": "9375b0380d927edf",
}
