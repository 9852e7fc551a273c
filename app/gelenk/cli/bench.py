"""The command `bench`: how fast calls are answered by this process, or by a server over the network."""

import json
import statistics
import time
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.files.outputs import AnswerRows
from gelenk.cli.session import BaseOption, RobotArgument, TipOption, session

if TYPE_CHECKING:
    from gelenk.client import Client
    from gelenk.robot.arrays import Array

_KEYS = ("operation", "single_milliseconds", "batch_microseconds_each", "ratio")
_FEWEST = 5
"""Minimum number of calls in a measurement."""
_WARM = 2
"""Calls before these, which are not measured."""
_WIDEST = 3.141592653589793
"""Bound of a joint without limits, [rad or m]."""


def bench(
    context: typer.Context,
    robot: RobotArgument = "panda",
    batch: Annotated[int, typer.Option(min=2, max=200_000, help="Configurations or targets of a batch.")] = 1_000,
    seconds: Annotated[
        float, typer.Option(min=0.1, max=60.0, help="Duration of each of the six measurements, [s].")
    ] = 1.0,
    base: BaseOption = None,
    tip: TipOption = None,
) -> None:
    """Measure how fast fk, jacobian and ik are answered, one by one and in batches: one caller, call after call."""
    shared = session(context)
    ends = {name: frame for name, frame in (("base_frame", base), ("tip_frame", tip)) if frame is not None}
    with shared.robot(robot) as (client, name), shared.bar("bench") as progress:
        rows = _measured(client, name, ends, batch, seconds, progress)
    columns = ("operation", "one call [ms]", f"of {batch:,} in one call, each [µs]", "ratio")
    where = shared.server or "this very process"
    note = (
        f"{robot} at {where}: medians of calls one after the other for {seconds:g} s, arrays in and out, from the call "
        "to the answer in Python; random configurations within the limits, targets that can be reached"
    )
    entries = [dict(zip(_KEYS, row, strict=True)) for row in rows]
    shown = [(operation, round(single, 3), round(each, 3), round(ratio)) for operation, single, each, ratio in rows]
    answer = {"robot": robot, "where": where, "batch": batch, "rows": entries}
    shared.output.write(lambda: json.dumps(answer), AnswerRows(columns, shown, (note,)))


def _measured(
    client: "Client", name: str, ends: dict[str, Any], batch: int, seconds: float, progress: Callable[[float], None]
) -> list[tuple[Any, ...]]:
    """Return a row per operation: its name, [ms] of a single call, [µs] per row of a batch, ratio of the two."""
    qs = _configurations(client, name, ends, batch)
    given = {"fk": qs, "jacobian": qs, "ik": client.arrays.fk(name, qs, **ends)}
    rows: list[tuple[Any, ...]] = []
    for operation, array in given.items():
        call = partial(getattr(client.arrays, operation), name, **ends)
        single = _median_seconds(call, array, 1, seconds)
        each = _median_seconds(call, array, batch, seconds) / batch
        rows.append((operation, 1e3 * single, 1e6 * each, single / each))
        progress(len(rows) / len(given))
    return rows


def _configurations(client: "Client", name: str, ends: dict[str, Any], count: int) -> "Array":
    """Return random configurations of a chain within its limits, shape (count, n), the same each time."""
    import numpy as np  # noqa: PLC0415 - completion and --help need not wait for it

    names = client.fk(name, joint_positions=[], **ends).joint_names
    limits = {joint.name: joint.limits for joint in client.robot(name).joints}
    lower = [-_WIDEST if (low := limits[joint].lower) is None else low for joint in names]
    upper = [_WIDEST if (high := limits[joint].upper) is None else high for joint in names]
    return np.random.default_rng(0).uniform(lower, upper, (count, len(names)))


def _median_seconds(call: Callable[..., Any], rows: "Array", size: int, seconds: float) -> float:
    """Return the median duration of calls with `size` rows each, [s]; each call takes the next rows."""
    taken: list[float] = []
    begun = time.perf_counter()
    while len(taken) < _FEWEST + _WARM or time.perf_counter() - begun < seconds:
        first = len(taken) * size % (len(rows) - size + 1)
        before = time.perf_counter()
        call(rows[first : first + size])
        taken.append(time.perf_counter() - before)
    return statistics.median(taken[_WARM:])
