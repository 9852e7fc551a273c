"""Run the benchmarks that are named, or all of them."""

import sys
from collections.abc import Callable

from tests.benchmarks import batch, requests, start, volume
from tests.benchmarks.table import Row, show

BENCHMARKS: dict[str, Callable[[], list[Row]]] = {
    "requests": requests.measure,
    "batch": batch.measure,
    "volume": volume.measure,
    "start": start.measure,
}


def main() -> None:
    """Measure one after the other and print what came out."""
    names = sys.argv[1:] or list(BENCHMARKS)
    unknown = [name for name in names if name not in BENCHMARKS]
    if unknown:
        sys.exit(f"no benchmark is named {', '.join(unknown)}; there are {', '.join(BENCHMARKS)}")
    rows = []
    for name in names:
        print(f"measuring {name} …", file=sys.stderr)
        rows += BENCHMARKS[name]()
    show(rows)


main()
