"""When a motion is sampled, and how many numbers that makes."""

import math

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.errors import InvalidField

_NEARLY = 1e-6
"""Share of a period that would be too short a time between the last two samples."""


def sample_times(duration: float, period: float) -> Array:
    """Every multiple of a period before the end, and the end; of no duration the one time 0."""
    count, rate = np.arange(_before_end(duration, period)), round(1.0 / period)
    # 3 · 0.05 is not the double that is nearest to 0.15; 3 / 20 is.
    return np.append(count / rate if rate * period == 1.0 else count * period, duration)


def sample_count(duration: float, period: float) -> int:
    """Number of samples."""
    return _before_end(duration, period) + 1


def check_samples(duration: float, period: float, most: int) -> None:
    """Refuse more samples than there may be.

    Args:
        duration: Of the motion, or what it lasts at least, [s].
        period: From sample to sample, [s].
        most: How many there may be; at least 2.

    Raises:
        InvalidField: There are more; it says what period there may be.
    """
    if duration / period <= 2.0 * most and sample_count(duration, period) <= most:
        return
    least = duration / (most - 1)
    # Rounded up, so that what is said is enough.
    shown = math.ceil(least * 1e6) / 1e6
    count = duration / period + 1.0
    raise InvalidField(
        "sample_period",
        f"{period:g} s makes {count:.0f} samples of {duration:.6g} s; at most {most} are allowed, every {shown:.6f} s",
    )


def _before_end(duration: float, period: float) -> int:
    return max(0, math.ceil(duration / period - _NEARLY))
