"""How fast this machine is at the moment: limits of time are written for an idle one, and a busy one has more."""

import time

_IDLE_SECONDS = 0.09
"""What `_work` takes on the two idle cores that limits of time are written for."""


def is_within(seconds: float, limit: float) -> bool:
    """Whether something has taken less than a limit on an idle machine, or so much more as all takes here and now."""
    return seconds < limit or seconds < limit * max(times_as_slow() for _ in range(5))


def times_as_slow() -> float:
    """How many times as long as on an idle machine something takes here and now; at least 1."""
    began = time.perf_counter()
    _work()
    return max(1.0, (time.perf_counter() - began) / _IDLE_SECONDS)


def _work() -> int:
    total = 0
    for i in range(1_000_000):
        total += i * i % 7
    return total
