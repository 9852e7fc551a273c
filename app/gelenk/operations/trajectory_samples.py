"""Sample times of a motion, and limits on their number."""

import math

import numpy as np

from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array

_NEARLY = 1e-6
"""Fraction of a period that would be too short a time between the last two samples."""


def sample_times(duration: float, period: float) -> Array:
    """Return every multiple of a period before the end, and the end, [s]; for a duration of zero only 0."""
    count, rate = np.arange(sample_count(duration, period) - 1), round(1.0 / period)
    # 3 · 0.05 is not the double that is nearest to 0.15; 3 / 20 is.
    return np.append(count / rate if rate * period == 1.0 else count * period, duration)


def sample_count(duration: float, period: float) -> int:
    """Return the number of samples."""
    return max(0, math.ceil(duration / period - _NEARLY)) + 1


def check_samples(duration: float, period: float, most: int) -> None:
    """Refuse too many samples.

    Args:
        duration: Duration of the motion, or a lower bound of it, [s].
        period: Time between samples, [s].
        most: Maximum number of samples; at least 2.

    Raises:
        InvalidField: There are too many; the message gives an allowed period.
    """
    if duration / period <= 2.0 * most and sample_count(duration, period) <= most:
        return
    least = duration / (most - 1)
    # Rounded up, so that the period in the message is long enough.
    shown = math.ceil(least * 1e6) / 1e6
    count = duration / period + 1.0
    raise InvalidField(
        "sample_period",
        f"{period:g} s makes {count:.0f} samples of {duration:.6g} s; at most {most} are allowed, every {shown:.6f} s",
    )
