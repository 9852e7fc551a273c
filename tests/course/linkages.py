"""The lecture's linkages, each pair written as `link kind link`, at a joint where it is one of several: `@joint`."""

from typing import Any


def pairs(text: str) -> list[dict[str, Any]]:
    """`frame R crank, crank R rod@B` as pairs."""
    found = []
    for entry in text.split(","):
        link_a, kind, link_b = entry.split()
        link_b, _, joint = link_b.partition("@")
        found.append({"link_a": link_a, "type": kind, "link_b": link_b} | ({"joint": joint} if joint else {}))
    return found


def links(text: str) -> list[str]:
    """The links of such a text in the order in which they appear: the ground comes first."""
    return list(dict.fromkeys(pair[end] for pair in pairs(text) for end in ("link_a", "link_b")))


def serial(kinds: str) -> str:
    """An open chain of these pairs."""
    return ", ".join(f"link{i} {kind} link{i + 1}" for i, kind in enumerate(kinds))


def legs(count: int, first: str, middle: str, last: str) -> str:
    """A platform on legs of two links each."""
    parts = [
        f"base {first} lower{i}, lower{i} {middle} upper{i}, upper{i} {last} platform" for i in range(1, count + 1)
    ]
    return ", ".join(parts)


def delta(rod: str) -> str:
    """Three arms, each carrying the platform by two rods; `rod` writes one, from {arm} to the platform."""
    parts = []
    for i in (1, 2, 3):
        parts.append(f"base R arm{i}")
        parts += [rod.format(arm=f"arm{i}", rod=f"rod{i}{side}") for side in ("left", "right")]
    return ", ".join(parts)


FOUR_BAR = "frame R crank, crank R coupler, coupler R rocker, rocker R frame"
SIX_BAR = "frame R crank, crank R plate, plate R rocker@B, rocker R frame, rocker R rod@B, rod R output, output R frame"
WIPERS = (
    "frame R motor, motor R rod1, rod1 R bell1@B, bell1 R rod2@B, rod2 R bell2, bell1 R frame, bell2 R frame, "
    "bell1 R blade1, blade1 R follower1, follower1 R frame, bell2 R blade2, blade2 R follower2, follower2 R frame"
)
SQUARE = (
    "bottom R left@A, left R diagonal1@A, bottom R right@B, right R diagonal2@B, "
    "right R top@C, top R diagonal1@C, top R left@D, left R diagonal2@D"
)
MECHANISMS: dict[str, tuple[str, str, int, int, int, int]] = {
    "four-bar": ("planar", FOUR_BAR, 4, 4, 8, 1),
    "slider-crank": ("planar", "frame R crank, crank R rod, rod R slider, slider P frame", 4, 4, 8, 1),
    "oscillating cylinder": (
        "planar",
        "frame R crank, crank R piston, piston P cylinder, cylinder R frame",
        4,
        4,
        8,
        1,
    ),
    "rocker with swivelling slider": (
        "planar",
        "frame R crank, crank R block, block P rocker, rocker R frame",
        4,
        4,
        8,
        1,
    ),
    "six-bar with ternary plate": ("planar", SIX_BAR, 6, 7, 14, 1),
    "five-bar": ("planar", "frame R a, a R b, b R c, c R d, d R frame", 5, 5, 10, 2),
    "two windscreen wipers": ("planar", WIPERS, 10, 13, 26, 1),
    "cam and follower": ("planar", "frame R disc, disc cam follower, follower P frame", 3, 3, 5, 1),
    "two gears": ("planar", "frame R pinion, pinion gear wheel, wheel R frame", 3, 3, 5, 1),
    "truss triangle": ("planar", "a R b, b R c, c R a", 3, 3, 6, 0),
    "double-braced square": ("planar", SQUARE, 6, 8, 16, -1),
    "serial 6R": ("spatial", serial("RRRRRR"), 7, 6, 30, 6),
    "serial 7R": ("spatial", serial("RRRRRRR"), 8, 7, 35, 7),
    "SCARA RRPR": ("spatial", serial("RRPR"), 5, 4, 20, 4),
    "Stewart-Gough 6-UPS": ("spatial", legs(6, "U", "P", "S"), 14, 18, 72, 6),
    "Stewart 6-SPS": ("spatial", legs(6, "S", "P", "S"), 14, 18, 66, 12),
    "Delta, rods in two halves": (
        "spatial",
        delta("{arm} S {rod}, {rod} R {rod}end, {rod}end S platform"),
        17,
        21,
        81,
        15,
    ),
    "Delta, rods of one piece": ("spatial", delta("{arm} S {rod}, {rod} S platform"), 11, 15, 51, 9),
    "RSSR": ("spatial", "frame R crank, crank S rod, rod S rocker, rocker R frame", 4, 4, 16, 2),
    "four-bar counted in space": ("spatial", FOUR_BAR, 4, 4, 20, -2),
    "Bennett 4R": ("spatial", FOUR_BAR, 4, 4, 20, -2),
    "Sarrus": ("spatial", "base R a, a R b, b R table, table R c, c R d, d R base", 6, 6, 30, 0),
}
"""Of each: the space, its pairs, and the lecture's n, j, Σc and M."""
