"""Defaults of a comparison and the names of mistakes, without the code that finds them."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.robot.result import Result

Mistake: TypeAlias = Literal[
    "sign",
    "degrees",
    "millimetres",
    "centimetres",
    "power_of_ten",
    "convention",
    "columns",
    "rows",
    "row_missing",
    "row_doubled",
    "row_extra",
    "joint_sense",
    "number",
    "joint_zero",
    "base",
    "tool",
]

POSITION_TOLERANCE = 1e-5
"""Distance up to which positions count as equal, [m]: descriptions round angles to five digits."""
ORIENTATION_TOLERANCE = 1e-4
"""Angle up to which orientations count as equal, [rad]."""
SAMPLES = 200
LOOKS = 24
"""Number of configurations at which a repaired table is tested."""


@dataclass(frozen=True, slots=True)
class Unverified(Result):
    """A number that is not checked, because what was found would compensate for any error in it.

    Attributes:
        row: The row, from 1.
        joint: Of the row.
        parameter: The parameter that is not checked.
        absorbed_by: What would compensate for an error in it.
    """

    row: int
    joint: str
    parameter: Literal["a", "alpha", "d", "theta"]
    absorbed_by: Literal["base", "tool", "offsets"]
