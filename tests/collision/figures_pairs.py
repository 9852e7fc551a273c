"""Counts what Coal contradicts in many random pairs of pieces: `python -m tests.collision.figures_pairs [count]`."""

import sys
from collections import Counter

import numpy as np

from tests.collision.pairs import faults, random_pair


def main(count: int) -> None:
    """Print the number of pairs by kinds, in contact, and contradicted."""
    rng, wrong = np.random.default_rng(0), 0
    kinds: Counter[str] = Counter()
    for _ in range(count):
        pair = random_pair(rng)
        found = faults(pair)
        kinds["in contact" if pair.is_contact else "apart"] += 1
        if found:
            wrong += 1
            print(pair.a.kind, pair.b.kind, pair.poses.tolist(), *found)
    print(dict(kinds), "contradicted:", wrong)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
