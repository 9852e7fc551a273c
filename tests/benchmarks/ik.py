"""Inverse kinematics against others, by the protocol of the TRAC-IK paper (Beeson and Ames, 2015).

For each arm the poses of 2,000 random configurations within the limits are to be reached to 1e-5 m and 1e-5 rad
from the middle of the range, in 5 ms where a solver takes a time. Every solve is one timed call from Python. What a
solver returns counts as solved only where Pinocchio finds it at the target and within the limits. All solvers do
one arm before any does the next, each in a process of its own, one after the other.
"""

import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from typing import NamedTuple, TypeAlias

import numpy as np

from gelenk.robot.arrays import Array
from tests.benchmarks.arms import ARMS, Arm, Targets, draw, poses
from tests.benchmarks.peers import (
    PEERS,
    TOLERANCE,
    Eaik,
    Gelenk,
    GelenkForm,
    IkLm,
    IkLmTuned,
    Peer,
    TracIk,
    TracIkOnOneCore,
)
from tests.benchmarks.table import Row
from tests.benchmarks.worker import Failed, Run, Worker

TARGETS = 2_000
FEW_TARGETS = 100
SLACK = 1.01
"""Of the tolerance, for solvers that measure errors a little differently."""
LIMIT_SLACK = 1e-9
"""[rad or m]"""


class Score(NamedTuple):
    """How a solver did on an arm.

    Attributes:
        solved: Share of the targets with an answer that holds.
        wrong: Answers that do not hold.
        median: Time of a solve, [µs].
        p99: Likewise, of a hundred solves all but the slowest.
        mean: Likewise.
        rate: Solves per second, all targets in one call.
        solved_together: Share of the targets with an answer that holds, from that call.
        inside: Time of a solve without the call around it, median and 99th percentile, [µs].
    """

    solved: float
    wrong: int
    median: float
    p99: float
    mean: float
    rate: float | None = None
    solved_together: float | None = None
    inside: tuple[float, float] | None = None


Scores: TypeAlias = Mapping[Arm, Mapping[type[Peer], Score | str]]
"""For each arm and solver how it did, or why it did not."""


def measure(count: int = TARGETS) -> list[Row]:
    """Let all solvers loose on all arms; the tables arm by arm are printed."""
    scores: dict[Arm, dict[type[Peer], Score | str]] = {}
    with workers() as all_workers:
        for arm in ARMS:
            print(f"  {arm.robot} …", file=sys.stderr)
            targets = draw(arm, count)
            scores[arm] = {worker.peer: score(worker, arm, targets) for worker in all_workers}
    show_arms(scores)
    return summary(scores)


def measure_few() -> list[Row]:
    """The same with few targets, to see that everything works."""
    return measure(FEW_TARGETS)


@contextmanager
def workers() -> Iterator[list[Worker]]:
    """A worker for each solver."""
    started = [Worker(peer) for peer in PEERS]
    try:
        yield started
    finally:
        for worker in started:
            worker.stop()


# One solver on one arm


def score(worker: Worker, arm: Arm, targets: Targets) -> Score | str:
    """How a solver does on an arm, or why it does not."""
    Ts = targets.Ts[:: worker.peer.every]
    try:
        run = worker.run(arm, Targets(Ts, targets.seed))
    except Failed as failure:
        return str(failure)
    return judge(arm, Ts, run)


def judge(arm: Arm, Ts: Array, run: Run) -> Score:
    """Look at answers with Pinocchio."""
    right = holds(arm, Ts, run.qs)
    wrong = int((~right & ~np.isnan(run.qs).any(axis=1)).sum())
    median, p99 = np.percentile(run.seconds, [50, 99]) * 1e6
    times = (float(median), float(p99), float(run.seconds.mean() * 1e6))
    if run.batch_seconds is None or run.batch_qs is None:
        return Score(float(right.mean()), wrong, *times)
    together = holds(arm, Ts, run.batch_qs)
    inside = None
    if run.inside is not None:
        inside = (float(np.median(run.inside)) * 1e6, float(np.percentile(run.inside, 99)) * 1e6)
    return Score(float(right.mean()), wrong, *times, len(Ts) / run.batch_seconds, float(together.mean()), inside)


def holds(arm: Arm, Ts: Array, qs: Array) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """Whether configurations reach their poses and keep within the limits; NaN never does."""
    reached = poses(arm, qs)
    distances = np.linalg.norm(reached[:, :3, 3] - Ts[:, :3, 3], axis=1)
    chords = np.linalg.norm(reached[:, :3, :3] - Ts[:, :3, :3], axis=(1, 2))
    angles = 2.0 * np.arcsin(np.minimum(1.0, chords / np.sqrt(8.0)))
    inside = (qs >= arm.chain.lower - LIMIT_SLACK) & (qs <= arm.chain.upper + LIMIT_SLACK)
    close = (distances <= TOLERANCE * SLACK) & (angles <= TOLERANCE * SLACK)
    return np.asarray(close & inside.all(axis=1))


# The tables


def show_arms(scores: Scores) -> None:
    """Print what was solved and how quickly, arm by arm, and what was missing or wrong."""
    print("\nSolved and verified, %:\n")
    show_table(scores, lambda found: f"{found.solved * 100:.2f}")
    print("\nTime of one solve, median / 99th percentile / mean, µs:\n")
    show_table(scores, lambda found: " / ".join(digits(time) for time in (found.median, found.p99, found.mean)))
    print()
    for peer in PEERS:
        for note in notes(scores, peer):
            print(f"- {peer.name}: {note}")
    print()


def show_table(scores: Scores, cell: Callable[[Score], str]) -> None:
    """Print a Markdown table with a row for each arm and a column for each solver."""
    print("| arm | joints | " + " | ".join(peer.name for peer in PEERS) + " |")
    print("|---|---|" + "---|" * len(PEERS))
    for arm, of_arm in scores.items():
        cells = [cell(found) if isinstance(found, Score) else found.partition(":")[0] for found in of_arm.values()]
        print(f"| {arm.robot} | {len(arm.chain)} | " + " | ".join(cells) + " |")


def digits(time: float) -> str:
    """A time with three digits."""
    return f"{time:.{max(0, 2 - int(np.floor(np.log10(time))))}f}"


def notes(scores: Scores, peer: type[Peer]) -> Iterator[str]:
    """The solver's version and targets, what it gave out as an answer and was none, and why it gave none."""
    try:
        yield f"version {version(peer.package)}" + (f", every {peer.every}th target" if peer.every > 1 else "")
    except PackageNotFoundError:
        if peer not in {Gelenk, GelenkForm}:
            yield "not installed"
    wrong = {arm.robot: found.wrong for arm, found in of_peer(scores, peer).items() if found.wrong}
    if wrong:
        yield "answers that do not hold: " + ", ".join(f"{name} {count}" for name, count in wrong.items())
    reasons: dict[str, list[str]] = {}
    for arm, of_arm in scores.items():
        if isinstance(reason := of_arm[peer], str):
            reasons.setdefault(reason, []).append(arm.robot)
    for reason, names in reasons.items():
        yield f"{', '.join(names)}: {reason}"


# The summary


def summary(scores: Scores) -> list[Row]:
    """What is asked of ours, each against a peer; ratios are of one arm, the worst one's and the median one's."""
    few = {arm: of_arm for arm, of_arm in scores.items() if len(arm.chain) in {6, 7}}
    engine, one = "one IK solve inside the engine, median", "one IK solve called from Python, median"
    batch = "IK, all targets of an arm in one call"
    return [
        *solved_rows(scores),
        *ratio_rows(engine, scores, TracIk, inside, median, "≥ 50"),
        *ratio_rows(engine, scores, TracIkOnOneCore, inside, median, "≥ 50"),
        *ratio_rows(engine, scores, IkLm, inside, median, "≥ 8"),
        *ratio_rows(engine, scores, IkLmTuned, inside, median),
        *ratio_rows(one, scores, TracIk, median, median),
        *ratio_rows(one, scores, IkLm, median, median),
        *ratio_rows(f"{one}, arms with a closed form", scores, Eaik, median, median, "≥ 1", GelenkForm),
        *slowest_row(scores),
        *ratio_rows(f"{batch}, 6 and 7 joints", few, TracIk, together, mean, "≥ 150"),
        *ratio_rows(f"{batch}, 6 and 7 joints", few, TracIkOnOneCore, together, mean),
    ]


def median(found: Score) -> float:
    """Median time of a solve, [µs]."""
    return found.median


def mean(found: Score) -> float:
    """Mean time of a solve, [µs]."""
    return found.mean


def inside(found: Score) -> float:
    """Median time of a solve without the call around it, [µs]."""
    assert found.inside is not None
    return found.inside[0]


def together(found: Score) -> float:
    """Time of a solve among all in one call, [µs]."""
    assert found.rate is not None
    return 1e6 / found.rate


def of_peer(scores: Scores, peer: type[Peer]) -> dict[Arm, Score]:
    """What a solver did on the arms for which it has answers."""
    found = {arm: of_arm[peer] for arm, of_arm in scores.items()}
    return {arm: score for arm, score in found.items() if isinstance(score, Score)}


def solved_rows(scores: Scores) -> list[Row]:
    """The worst arm of each solver; of ours call by call, and in one call."""
    worst = {}
    for peer in PEERS:
        if found := of_peer(scores, peer):
            worst[peer.name] = min(score.solved for score in found.values())
    against = ", ".join(f"{name} {solved:.2%}" for name, solved in worst.items() if Gelenk.name not in name)
    what = f"IK solved and verified, worst of {len(scores)} arms"
    ours = of_peer(scores, Gelenk)
    if len(ours) < len(scores):
        return [Row(what, f"{len(ours)} arms answered", against, wanted="100 %")]
    batch = min(score.solved_together or 0.0 for score in ours.values())
    return [
        Row(what, f"{worst[Gelenk.name]:.2%}", against, wanted="100 %"),
        Row(f"{what}, all targets in one call", f"{batch:.2%}", wanted="100 %"),
    ]


def ratio_rows(
    what: str,
    scores: Scores,
    peer: type[Peer],
    of_ours: Callable[[Score], float],
    of_theirs: Callable[[Score], float],
    wanted: str = "",
    of: type[Peer] = Gelenk,
) -> list[Row]:
    """How many times longer a peer takes, on the worst arm and on the median one."""
    ours, theirs = of_peer(scores, of), of_peer(scores, peer)
    times = {arm: (of_ours(ours[arm]), of_theirs(theirs[arm])) for arm in ours if arm in theirs}
    if not times:
        return [Row(what, "missing", f"{peer.name}: {'missing' if not theirs else 'measured'}", wanted=wanted)]
    order = sorted(times, key=lambda arm: times[arm][1] / times[arm][0])
    return [
        Row(
            f"{what}, {which} arm of {len(order)} ({arm.robot})",
            f"{digits(times[arm][0])} µs",
            f"{peer.name}, {digits(times[arm][1])} µs",
            times[arm][1] / times[arm][0],
            wanted,
        )
        for which, arm in (("worst", order[0]), ("median", order[len(order) // 2]))
    ]


def slowest_row(scores: Scores) -> list[Row]:
    """The 99th percentile of ours on its worst arm."""
    ours = of_peer(scores, Gelenk)
    what, wanted = "one IK solve, 99th percentile", "≤ 60 µs"
    if not ours:
        return [Row(what, "missing", wanted=wanted)]
    arm = max(ours, key=lambda arm: ours[arm].p99)
    return [Row(f"{what}, worst arm ({arm.robot})", f"{digits(ours[arm].p99)} µs", wanted=wanted)]
