"""Run the benchmarks that are named, or all of them."""

import sys
from collections.abc import Callable

from tests.benchmarks import batch, ik, requests, start, volume
from tests.benchmarks.table import Row, show

BENCHMARKS: dict[str, Callable[[], list[Row]]] = {
    "requests": requests.measure,
    "batch": batch.measure,
    "volume": volume.measure,
    "start": start.measure,
    "ik": ik.measure,
}
ON_REQUEST: dict[str, Callable[[], list[Row]]] = {"ik-few": ik.measure_few}


def main() -> None:
    """Measure one after the other and print what came out."""
    names = sys.argv[1:] or list(BENCHMARKS)
    known = BENCHMARKS | ON_REQUEST
    unknown = [name for name in names if name not in known]
    if unknown:
        sys.exit(f"no benchmark is named {', '.join(unknown)}; there are {', '.join(known)}")
    rows = []
    for name in names:
        print(f"measuring {name} …", file=sys.stderr)
        rows += known[name]()
    show(rows)


main()
