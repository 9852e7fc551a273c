"""Defaults of a comparison and the names of mistakes, without the code that finds them."""

from typing import Literal, TypeAlias

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
