"""Classes of arms that have a closed form: random members of each, by their rows of (a, α, d, θ) and joint types."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.ik.arms import PLANAR, POSITION
from tests.oracles.dh_columns import Table
from tests.robots import of_table, rows

Row: TypeAlias = tuple[float, float, float, float]
Draw: TypeAlias = Callable[[np.random.Generator], list[Row]]

QUARTER = 0.5 * np.pi
IN_THE_PLANE = Task(("x", "y", "rz"))
FOUR = Task(("x", "y", "z", "rz"))
ORIENTATION = Task(("rx", "ry", "rz"))


@dataclass(frozen=True)
class ArmClass:
    """Arms of one geometry.

    Attributes:
        types: One letter a joint, R or P.
        draw: The rows of a random member.
        task: What counts of a target.
        convention: Of the rows.
        most: How many solutions a regular target has at most, where that is known.
    """

    types: str
    draw: Draw
    task: Task = FULL_POSE
    convention: Literal["standard", "modified"] = "standard"
    most: int = 16

    def arm(self, seed: int) -> "Arm":
        """A member of the class."""
        return Arm(self.draw(np.random.default_rng(seed)), self.types, self.convention)


class Arm:
    """A table, as the oracles and as the service see it."""

    def __init__(
        self, parameters: list[Row], types: str, convention: Literal["standard", "modified"] = "standard"
    ) -> None:
        self.types = types
        self.turns = np.array([letter == "R" for letter in types])
        self.table = Table(convention == "standard", parameters, [letter == "P" for letter in types])
        self.robot: RobotModel = of_table(rows(convention, parameters, types))
        self.chain: Chain = self.robot.chain(None, None)

    def configurations(self, count: int, seed: int) -> Array:
        """All the way round for turning joints, ±0.8 m for sliding ones; shape (count, n)."""
        reach = np.where(self.turns, np.pi, 0.8)
        return np.random.default_rng(seed).uniform(-reach, reach, (count, len(reach)))

    def differences(self, qs: Array, q: Array) -> Array:
        """Up to full turns; shape (k, n)."""
        apart = qs - q
        return np.asarray(apart - self.turns * 2.0 * np.pi * np.rint(apart / (2.0 * np.pi)))


def general(rng: np.random.Generator, count: int) -> list[Row]:
    """Rows of skew lines."""
    low, high = np.array([-0.6, -3.0, -0.6, -3.0]), np.array([0.6, 3.0, 0.6, 3.0])
    return [(float(a), float(b), float(c), float(d)) for a, b, c, d in rng.uniform(low, high, (count, 4))]


def length(rng: np.random.Generator) -> float:
    return float(rng.uniform(0.2, 0.6))


def meeting(rng: np.random.Generator, square: bool = False) -> list[Row]:
    """Three axes that meet, square to each other or not."""
    first, second = (QUARTER, QUARTER) if square else rng.uniform(0.4, 2.7, 2)
    tool: Row = (0.0, 0.0, length(rng), 0.0) if square else general(rng, 1)[0]
    return [(0.0, -float(first), length(rng), 0.0), (0.0, float(second), 0.0, 0.0), tool]


def shoulder(rng: np.random.Generator) -> list[Row]:
    """Three axes that meet, at the base."""
    first, second = rng.uniform(0.4, 2.7, 2)
    return [(0.0, float(first), length(rng), 0.3), (0.0, -float(second), 0.0, 0.0), general(rng, 1)[0]]


def anthropomorphic(rng: np.random.Generator) -> list[Row]:
    return [(0.0, QUARTER, length(rng), 0.0), (length(rng), 0.0, 0.0, 0.0), (length(rng), 0.0, 0.0, 0.0)]


def offset_elbow(rng: np.random.Generator) -> list[Row]:
    """An industrial arm: offsets at the shoulder and at the elbow."""
    return [
        (length(rng), -QUARTER, length(rng), 0.0),
        (length(rng), 0.0, 0.1 * length(rng), -QUARTER),
        (0.3 * length(rng), -QUARTER, 0.0, 0.0),
    ]


def universal(rng: np.random.Generator) -> list[Row]:
    """Three parallel axes, the others square to them."""
    return [
        (0.0, QUARTER, length(rng), 0.0),
        (-length(rng), 0.0, 0.0, 0.0),
        (-length(rng), 0.0, 0.0, 0.0),
        (0.0, QUARTER, length(rng), 0.0),
        (0.0, -QUARTER, length(rng), 0.0),
        (0.0, 0.0, length(rng), 0.0),
    ]


def parallel(first: int, antiparallel: bool = False) -> Draw:
    """Axes first, first + 1 and first + 2 parallel (counted from 0), the others skew."""

    def draw(rng: np.random.Generator) -> list[Row]:
        drawn = general(rng, 6)
        for i in (first, first + 1):
            turned = np.pi if antiparallel and i == first else 0.0
            drawn[i] = (length(rng), turned, drawn[i][2], drawn[i][3])
        return drawn

    return draw


def seven(rng: np.random.Generator, offset: float) -> list[Row]:
    """A spherical shoulder and wrist, with the elbow's axis off the line between them or not."""
    upper, lower = length(rng), length(rng)
    return [
        (0.0, -QUARTER, length(rng), 0.0),
        (0.0, QUARTER, 0.0, 0.0),
        (offset, QUARTER, upper, 0.0),
        (-offset, -QUARTER, 0.0, 0.0),
        (0.0, -QUARTER, lower, 0.0),
        (0.0, QUARTER, 0.0, 0.0),
        (0.0, 0.0, length(rng), 0.0),
    ]


def skew_seven(rng: np.random.Generator) -> list[Row]:
    """The same with axes that are not square to each other."""
    first, last = rng.uniform(1.0, 2.1, 2), rng.uniform(1.0, 2.1, 2)
    return [
        (0.0, -float(first[0]), length(rng), 0.0),
        (0.0, float(first[1]), 0.0, 0.0),
        (0.05, 1.3, length(rng), 0.0),
        (0.08, -1.8, 0.0, 0.0),
        (0.0, -float(last[0]), length(rng), 0.0),
        (0.0, float(last[1]), 0.0, 0.0),
        (0.1, 0.4, length(rng), 0.0),
    ]


CLASSES: dict[str, ArmClass] = {
    "planar 2R": ArmClass("RR", lambda r: [(length(r), 0.0, 0.0, 0.0) for _ in range(2)], PLANAR, most=2),
    "planar 3R": ArmClass("RRR", lambda r: [(length(r), 0.0, 0.0, 0.0) for _ in range(3)], IN_THE_PLANE, most=2),
    "scara": ArmClass(
        "RRPR",
        lambda r: [
            (length(r), 0.0, length(r), 0.0),
            (length(r), np.pi, 0.0, 0.0),
            (0.0, 0.0, 0.0, 0.0),
            (0.0, 0.0, length(r), 0.0),
        ],
        FOUR,
        most=2,
    ),
    "anthropomorphic": ArmClass("RRR", anthropomorphic, POSITION, most=4),
    "spherical wrist alone": ArmClass(
        "RRR", lambda r: [(0.0, -QUARTER, 0.0, 0.0), (0.0, QUARTER, 0.0, 0.0), (0.0, 0.0, length(r), 0.0)], most=2
    ),
    "skew wrist alone": ArmClass("RRR", meeting, ORIENTATION, most=2),
    "cartesian": ArmClass(
        "PPP",
        lambda r: [(0.0, -QUARTER, length(r), -QUARTER), (0.0, QUARTER, length(r), -QUARTER), (0.0, 0.0, 0.0, 0.0)],
        POSITION,
        most=1,
    ),
    "cylindrical": ArmClass(
        "RPP",
        lambda r: [(0.0, 0.0, length(r), 0.0), (0.0, -QUARTER, 0.0, 0.0), (0.0, 0.0, length(r), 0.0)],
        POSITION,
        most=2,
    ),
    "spherical arm": ArmClass(
        "RRP",
        lambda r: [(0.0, -QUARTER, length(r), 0.0), (0.0, QUARTER, length(r), 0.0), (0.0, 0.0, 0.0, 0.0)],
        POSITION,
        most=4,
    ),
    "stanford": ArmClass(
        "RRPRRR",
        lambda r: [
            (0.0, -QUARTER, length(r), 0.0),
            (0.0, QUARTER, length(r), 0.0),
            (0.02, 0.0, 0.0, -QUARTER),
            *meeting(r, square=True),
        ],
        most=8,
    ),
    "anthropomorphic with a wrist": ArmClass(
        "RRRRRR",
        lambda r: [*anthropomorphic(r)[:2], (0.0, QUARTER, 0.0, 0.0), *meeting(r, square=True)],
        most=8,
    ),
    "offset elbow with a wrist": ArmClass("RRRRRR", lambda r: [*offset_elbow(r), *meeting(r, square=True)], most=8),
    "skew wrist behind an offset elbow": ArmClass("RRRRRR", lambda r: [*offset_elbow(r), *meeting(r)], most=8),
    "universal": ArmClass("RRRRRR", universal, most=8),
    "parallel axes 2 3 4": ArmClass("RRRRRR", parallel(1)),
    "parallel axes 3 4 5": ArmClass("RRRRRR", parallel(2)),
    "antiparallel axes 2 3 4": ArmClass("RRRRRR", parallel(1, antiparallel=True)),
    "antiparallel axes 3 4 5": ArmClass("RRRRRR", parallel(2, antiparallel=True)),
    "two joints and a wrist": ArmClass("RRRRR", lambda r: [*general(r, 2), *meeting(r)]),
    "a shoulder and two joints": ArmClass("RRRRR", lambda r: [*shoulder(r), *general(r, 2)]),
    "three joints and two that meet": ArmClass(
        "RRRRR", lambda r: [*general(r, 3), (0.0, 1.2, 0.3, 0.0), general(r, 1)[0]]
    ),
    "three parallel joints between two": ArmClass(
        "RRRRR",
        lambda r: [
            (0.03, QUARTER, length(r), 0.0),
            (length(r), 0.0, 0.0, 0.0),
            (length(r), 0.0, 0.0, 0.0),
            (0.0, QUARTER, 0.0, 0.0),
            (0.0, 0.0, length(r), 0.0),
        ],
    ),
    "three joints and a turn": ArmClass("RRRR", lambda r: general(r, 4)),
    "spherical shoulder and wrist": ArmClass("RRRRRRR", lambda r: seven(r, 0.0), most=8),
    "the same with an offset elbow": ArmClass("RRRRRRR", lambda r: seven(r, 0.06), most=8),
    "the same with skew axes": ArmClass("RRRRRRR", skew_seven),
    "modified universal": ArmClass(
        "RRRRRR",
        lambda r: [(0.0, 0.0, 0.1, 0.0), *universal(r)[:5]],
        convention="modified",
        most=8,
    ),
}
for _types in ("RRR", "RRP", "RPR", "RPP", "PRR", "PRP", "PPR", "PPP"):
    CLASSES[f"{_types} and a skew wrist"] = ArmClass(_types + "RRR", lambda r: [*general(r, 3), *meeting(r)])
    CLASSES[f"a skew shoulder and {_types}"] = ArmClass("RRR" + _types, lambda r: [*shoulder(r), *general(r, 3)])
    CLASSES[f"modified {_types} and a wrist"] = ArmClass(
        _types + "RRR",
        lambda r: [*general(r, 4), (0.0, -float(r.uniform(0.5, 2.5)), 0.0, 0.0), (0.0, 1.3, length(r), 0.0)],
        convention="modified",
    )
