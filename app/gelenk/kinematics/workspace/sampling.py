"""Sampling of a chain's joint space within its limits.

Row i does not depend on the other rows computed with it, so parts can be computed by any number of processes: the
numbers come from a generator that can jump to any position, or from a sequence with an explicit formula.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField, quoted
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.chain import Chain

Sequence: TypeAlias = Literal["random", "low_discrepancy"]

SLIDE = 1.0
"""Sampling distance to either side for a prismatic joint without limits, [m]."""
FAR = 1000.0
"""A limit at or beyond this magnitude, [rad or m], means no limit."""

_TABLE = 4096
"""Largest number of entries in a table of a low-discrepancy sequence."""


@dataclass(frozen=True, slots=True)
class Ranges:
    """The sampling bounds of each variable, shape (n,), [rad or m], and the assumptions made, one sentence each."""

    lower: Array
    upper: Array
    notes: tuple[str, ...]


def joint_ranges(chain: Chain, given: Mapping[str, tuple[float, float]]) -> Ranges:
    """Return the sampling bounds of a chain's variables: the given ranges, else the joint limits.

    A revolute joint without limits covers one full turn, a prismatic one moves `SLIDE` to either side. Raises
    InvalidField if a range names no variable of the chain, has lower > upper or exceeds the limits.
    """
    sliding = {int(variable) for prismatic, variable in chain.flat.joints if prismatic}
    lower, upper, notes = chain.lower.copy(), chain.upper.copy(), []
    for i, name in enumerate(chain.joint_names):
        if name in given:
            low, high = given[name]
            if not lower[i] <= low <= high <= upper[i]:
                allowed = f"[{lower[i]:.17g}, {upper[i]:.17g}]"
                raise InvalidField("joint_ranges", f"{quoted(name)}: lower ≤ upper, both within the limits {allowed}")
            lower[i], upper[i] = low, high
            continue
        low, high = _sampled_range(lower[i], upper[i], SLIDE if i in sliding else np.pi)
        if i in sliding and (low, high) != (lower[i], upper[i]):
            notes.append(f"joint {quoted(name)} is prismatic without limits: sampled from {low:g} m to {high:g} m")
        lower[i], upper[i] = low, high
    for name in given:
        if name not in chain.joint_names:
            known = ", ".join(map(quoted, chain.joint_names[:12]))
            raise InvalidField("joint_ranges", f"{quoted(name)} is not a joint of the chain; its joints are {known}")
    return Ranges(lower, upper, tuple(notes))


def _sampled_range(lower: float, upper: float, spread: float) -> tuple[float, float]:
    low, high = lower > -FAR, upper < FAR
    if low and high:
        return lower, upper
    if low:
        return lower, lower + 2.0 * spread
    if high:
        return upper - 2.0 * spread, upper
    return -spread, spread


@dataclass(frozen=True, slots=True)
class Sampling:
    """A sequence of configurations, uniform between bounds.

    `random`: row i is row i of `lower + numpy.random.default_rng(seed).random((count, n)) * (upper - lower)`.
    `low_discrepancy`: the Halton sequence with randomly permuted digits in each place [Owen2017]; it leaves smaller
    gaps and no clusters.
    """

    ranges: Ranges
    count: int
    sequence: Sequence
    seed: int

    def configurations(self, first: int, count: int) -> Array:
        """Compute `count` samples from number `first` on; shape (count, n), [rad or m]."""
        lower, upper = self.ranges.lower, self.ranges.upper
        n = len(lower)
        if self.sequence == "random":
            stream = np.random.PCG64(self.seed).advance(first * n)
            shares = np.random.Generator(stream).random((count, n))
        else:
            shares = np.empty((count, n))
            for j in range(n):
                shares[:, j] = _radical_inverses(first, count, j, self.seed)
        return np.asarray(lower + shares * (upper - lower))

    def chosen(self, numbers: Indices) -> Array:
        """Compute the samples with the given numbers; shape (k, n), [rad or m]."""
        rows = [self.configurations(number, 1) for number in numbers.tolist()]
        return np.concatenate([*rows, np.empty((0, len(self.ranges.lower)))])


def _radical_inverses(first: int, count: int, j: int, seed: int) -> Array:
    """Radical inverses of numbers from `first` on, with permuted digits; shape (count,), from 0 to 1.

    The base is the j-th prime. A table gives the low digits; the high ones are computed once for many numbers.
    """
    base, permutations, low, table = _digits(j, seed)
    highs, lows = np.divmod(np.arange(first, first + count), len(table))
    rest = np.arange(highs[0], highs[-1] + 1) if count else highs
    values = np.zeros(len(rest))
    scale = 1.0 / len(table)
    for permutation in permutations[low:]:
        scale /= base
        rest, digits = np.divmod(rest, base)
        values += permutation[digits] * scale
    return np.asarray(table[lows] + values[highs - highs[0]] if count else np.empty(0))


@lru_cache(maxsize=512)
def _digits(j: int, seed: int) -> tuple[int, Indices, int, Array]:
    """The j-th prime, a digit permutation per place, the number of places in the table, and the table's values."""
    primes = [p for p in range(2, 800) if all(p % d for d in range(2, int(p**0.5) + 1))]
    base = primes[j]
    places = math.ceil(32 / math.log2(base))
    generator = np.random.default_rng((seed, j))
    permutations = generator.permuted(np.tile(np.arange(base), (places, 1)), axis=1)
    low = max(1, int(math.log(_TABLE, base)))
    rest, table = np.arange(base**low), np.zeros(base**low)
    for place in range(low):
        rest, digits = np.divmod(rest, base)
        table += permutations[place, digits] * float(base) ** -(place + 1)
    return base, permutations, low, table
