"""Run the benchmarks that are named, or all of them."""

import sys
from collections.abc import Callable

from tests.benchmarks import (
    batch,
    collision,
    fairness,
    ik,
    ik_all,
    jobs,
    load,
    quality,
    requests,
    soak,
    start,
    studio,
    trajectory,
    volume,
    workspace,
)
from tests.benchmarks.table import Row, show

BENCHMARKS: dict[str, Callable[[], list[Row]]] = {
    "solvers": ik.measure,
    "ik-all": ik_all.measure,
    "quality": quality.measure,
    "batch": batch.measure,
    "requests": requests.measure,
    "volume": volume.measure,
    "workspace": workspace.measure,
    "jobs": jobs.measure,
    "trajectory": trajectory.measure,
    "collision": collision.measure,
    "start": start.measure,
    "studio": studio.measure,
}
ON_REQUEST: dict[str, Callable[[], list[Row]]] = {
    "solvers-few": ik.measure_few,
    "load": load.measure,
    "fairness": fairness.measure,
    "soak": soak.measure,
}
GROUPS = {"ik": ["solvers", "quality", "batch", "requests", "volume"]}


def main() -> None:
    """Measure one after the other and print what came out."""
    given = sys.argv[1:] or list(BENCHMARKS)
    names = list(dict.fromkeys(name for word in given for name in GROUPS.get(word, [word])))
    known = BENCHMARKS | ON_REQUEST
    unknown = [name for name in names if name not in known]
    if unknown:
        sys.exit(f"no benchmark is named {', '.join(unknown)}; there are {', '.join([*known, *GROUPS])}")
    rows = []
    for name in names:
        print(f"measuring {name} …", file=sys.stderr)
        rows += known[name]()
    show(rows)


main()
