"""The time laws from rest to rest, and what each of them promises: the one table that all others read."""

import math
from dataclasses import dataclass
from typing import Final

from gelenk.trajectory.audit.words import Law


@dataclass(frozen=True, slots=True)
class TimeLaw:
    """The properties of a time law.

    Attributes:
        continuous: Order up to which its derivatives are continuous, also at both ends, where it is at rest.
        conditions: Number of derivatives given at each end of a polynomial, counting the position as one; None for the
            other laws, whose shape depends on path and limits.
        peaks: Largest magnitudes of a polynomial's velocity, acceleration and, if it is kept, jerk, from 0 to 1 in 1 s.
        scales_splines: Whether a spline that is at rest at both ends is the motion itself, all times multiplied by one
            factor; another law leads along the spline.
        end_rates: How many derivatives of joints may be given at its ends, from the velocity on; else it rests there.
    """

    continuous: int
    conditions: int | None = None
    peaks: tuple[float, ...] = ()
    scales_splines: bool = False
    end_rates: int = 0

    @property
    def keeps_jerk(self) -> bool:
        """Whether it keeps jerk limits: the acceleration does not jump, not even at the ends."""
        return self.continuous > 1


LAWS: Final[dict[Law, TimeLaw]] = {
    "cubic": TimeLaw(continuous=1, conditions=2, peaks=(1.5, 6.0), scales_splines=True, end_rates=1),
    "quintic": TimeLaw(continuous=2, conditions=3, peaks=(1.875, 10.0 / math.sqrt(3.0), 60.0), end_rates=2),
    # s' = 140 y³, s'' = 420 y² (1 - 2λ), s''' = 840 (y - 5y²) with y = λ (1 - λ).
    "septic": TimeLaw(continuous=3, conditions=4, peaks=(2.1875, 16.8 / math.sqrt(5.0), 52.5), end_rates=2),
    "trapezoidal": TimeLaw(continuous=1, scales_splines=True),
    "jerk_limited": TimeLaw(continuous=2, end_rates=2),
    "time_optimal": TimeLaw(continuous=1),
}

POLYNOMIALS: Final = {name: law.conditions for name, law in LAWS.items() if law.conditions is not None}
"""The polynomial laws, and the number of derivatives given at each end, counting the position as one."""


def scaled_law(law: Law) -> Law:
    """Return the law to compare with the time-optimal one: the cubic, as in the course, in place of that one itself."""
    return "cubic" if law == "time_optimal" else law
