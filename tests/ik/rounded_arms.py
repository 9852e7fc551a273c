"""Arms of the closed forms' classes as their files write them: lengths to 0.1 mm, angles to a few digits."""

from collections.abc import Iterator

import numpy as np

from gelenk.robot.arrays import Array
from tests.ik.arm_classes import CLASSES, QUARTER, Arm, Row
from tests.ik.arms import DECOUPLED, IRB, PUMA, UR5

DIGITS = (3, 4, 6, 9, None)
"""Of the angles; None where they are exact."""
SPECIAL = (0.0, np.pi, -np.pi, QUARTER, -QUARTER)
OFFSETS = (0.0, *(10.0**-k for k in range(12, 1, -1)))


def _universal(*lengths: float) -> list[Row]:
    """A table of the UR series, by the lengths of UR5 that differ."""
    a2, a3, d1, d4, d5, d6 = lengths
    places = ((0.0, d1), (a2, 0.0), (a3, 0.0), (0.0, d4), (0.0, d5), (0.0, d6))
    return [(a, alpha, d, theta) for (a, d), (_, alpha, _, theta) in zip(places, UR5, strict=True)]


_WRIST: list[Row] = [(0.0, -QUARTER, 0.0, 0.0), (0.0, QUARTER, 0.0, 0.0), (0.0, 0.0, 0.08, 0.0)]
_VENDORS: dict[str, tuple[list[Row], str]] = {
    "ur3e": (_universal(-0.24355, -0.2132, 0.15185, 0.13105, 0.08535, 0.0921), "RRRRRR"),
    "ur5e": (_universal(-0.425, -0.3922, 0.1625, 0.1333, 0.0997, 0.0996), "RRRRRR"),
    "ur10e": (_universal(-0.6127, -0.57155, 0.1807, 0.17415, 0.11985, 0.11655), "RRRRRR"),
    "ur16e": (_universal(-0.4784, -0.36, 0.1807, 0.17415, 0.11985, 0.11655), "RRRRRR"),
    "puma": (PUMA, "RRRRRR"),
    "no offsets": (DECOUPLED, "RRRRRR"),
    "shoulder and elbow offset": (IRB, "RRRRRR"),
    "staubli": (
        [
            (0.05, -QUARTER, 0.0, 0.0),
            (0.425, 0.0, 0.05, -QUARTER),
            (0.0, QUARTER, 0.0, QUARTER),
            (0.0, -QUARTER, 0.425, 0.0),
            *_WRIST[1:2],
            (0.0, 0.0, 0.1, 0.0),
        ],
        "RRRRRR",
    ),
    "gantry": (
        [(0.0, -QUARTER, 0.0, -QUARTER), (0.0, QUARTER, 0.0, -QUARTER), (0.0, 0.0, 0.0, 0.0), *_WRIST],
        "PPPRRR",
    ),
    "scara and a wrist": (
        [(0.35, 0.0, 0.4, 0.0), (0.25, np.pi, 0.0, 0.0), (0.0, QUARTER, 0.0, 0.0), *_WRIST],
        "RRPRRR",
    ),
}


def _rounded(table: list[Row], digits: int | None) -> list[Row]:
    """Lengths to 0.1 mm; angles to so many digits, all if None."""
    if digits is None:
        return [(round(a, 4), alpha, round(d, 4), theta) for a, alpha, d, theta in table]
    return [(round(a, 4), round(alpha, digits), round(d, 4), round(theta, digits)) for a, alpha, d, theta in table]


def _tables() -> Iterator[tuple[str, list[Row], str]]:
    for name, (table, types) in _VENDORS.items():
        yield name, table, types
        if types == "RRRRRR":
            yield f"{name} reversed", _reversed(table), types
    for name, kind in CLASSES.items():
        if len(kind.types) == 6 and kind.convention == "standard":
            yield name, kind.draw(np.random.default_rng(5)), kind.types


def _reversed(table: list[Row]) -> list[Row]:
    """The same arm from its tip: joint i turns about what was the axis of joint n + 1 - i."""
    inner = [(a, alpha, 0.0, 0.0) for a, alpha, _, _ in reversed(table[:-1])]
    offsets = [(d, theta) for _, _, d, theta in reversed(table)]
    rows = [(a, alpha, d, theta) for (a, alpha, _, _), (d, theta) in zip(inner, offsets[:-1], strict=True)]
    return [*rows, (0.0, 0.0, *offsets[-1])]


TABLES = {name: (table, types) for name, table, types in _tables()}


def arm(name: str, digits: int | None) -> Arm:
    """One of the arms, its angles rounded."""
    table, types = TABLES[name]
    return Arm(_rounded(table, digits), types)


def configurations(arm: Arm, count: int, seed: int) -> Array:
    """Random ones, and ones of which one to three joints are beside a special value; shape (count, n)."""
    rng = np.random.default_rng(seed)
    qs = arm.configurations(count, seed)
    for k in range(1, count):
        chosen = rng.choice(qs.shape[1], rng.integers(1, 4), replace=False)
        off = rng.choice(OFFSETS) * rng.choice((-1.0, 1.0), len(chosen))
        special = rng.choice(SPECIAL, len(chosen))
        qs[k, chosen] = np.where(arm.turns[chosen], special + off, qs[k, chosen])
    return qs
