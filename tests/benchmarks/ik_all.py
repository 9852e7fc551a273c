"""All solutions of a target: closed forms and elimination against EAIK and ssik, in one run.

Each arm is asked for the poses of up to 1,000 random configurations, without joint limits. All solvers get the same
targets and stand on one core, each in a process of its own; they take turns, a round of each after the other, and
medians over all rounds count. What a solver returns counts as a solution only where Pinocchio finds it at the target.
What there is to be found is what all solvers together have found.
"""

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, version
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from gelenk.ik.closed.closed_form import closed_form
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from tests.benchmarks.all_arms import CASES, CLOSED, ELBOW_ANGLE, GENERAL, REDUNDANT, arm_of, drawn, sliding
from tests.benchmarks.all_peers import LISTERS, EaikForms, GelenkForms, Lister, Ssik
from tests.benchmarks.ik import digits
from tests.benchmarks.table import Row
from tests.benchmarks.worker import Attendant, Failed, timed
from tests.ik.arms import angles, distances, part, poses

TARGETS, FEW = 1_000, 200
"""Of an arm, and how many of them are also given in calls of their own and in verified ones."""
PIECE = 100
"""Targets of one call; the clock is read before and after."""
ROUNDS = 5
ROUND_SECONDS = 1.5
"""What a round of a solver may take; where it is slower it gets fewer targets."""
ACCURATE = 1e-6
"""Largest error of a solution, [m and rad]."""
SAME = 1e-3
"""Solutions no further apart in any joint are one: next to a singularity an error of the pose is the square of theirs.
[rad or m]"""
LIMIT = 10.0
"""Time of a target that closed forms are to keep to, [µs]."""


class Timing(NamedTuple):
    """Times of a target, medians in [µs].

    Attributes:
        together: Of many in one call.
        single: Of one in a call from Python.
        verified: Of many with each solution recomputed, where a solver does that.
    """

    together: float
    single: float
    verified: float | None


class Found(NamedTuple):
    """What a solver found.

    Attributes:
        qs: Of all targets, one after the other; shape (M, n).
        counts: How many of each target; shape (N,).
        marked: Which of them it says to be no solutions; shape (M,).
    """

    qs: Array
    counts: Indices
    marked: Flags


class Judged(NamedTuple):
    """What the answers of a solver are worth.

    Attributes:
        solutions: Different ones that hold, all targets together.
        known: Those that are known of its targets, None where it was asked for others than the rest.
        invalid: Answers that do not hold.
        unmarked: Those of them that the solver does not say to be no solutions.
        worst: Largest error of those that hold, [m or rad].
    """

    solutions: int
    known: int | None
    invalid: int
    unmarked: int
    worst: float


class Score(NamedTuple):
    """How a solver did on an arm.

    Attributes:
        timing: Of a target, at all elbow angles of its own choice together.
        angles: How many of these there are.
        targets: How many it was given.
        judged: What its answers are worth.
    """

    timing: Timing
    angles: int
    targets: int
    judged: Judged

    @property
    def per_angle(self) -> float:
        """Time of a target among many, [µs], at one elbow angle."""
        return self.timing.together / self.angles


Scores: TypeAlias = Mapping[str, Mapping[type[Lister], Score | str]]
"""For each arm and solver how it did, or why it did not."""


def measure(count: int = TARGETS) -> list[Row]:
    """Let all solvers loose on all arms; the tables arm by arm are printed."""
    scores: dict[str, dict[type[Lister], Score | str]] = {}
    with attendants() as all_attendants:
        for name in CASES:
            print(f"  {name} …", file=sys.stderr)
            scores[name] = on_arm(name, count, all_attendants)
    show_arms(scores)
    return summary(scores)


# In a solver's process


class Desk:
    """What a solver's process does when it is asked; it keeps the solver that it has made ready."""

    def __init__(self, lister: type[Lister]) -> None:
        self._lister = lister
        self._ready: Lister | None = None
        self._pieces: list[slice] = []
        self._answers: list[Any] = []

    def __call__(self, what: str, *arguments: Any) -> Any:
        """Do one of the following."""
        tasks: dict[str, Callable[..., Any]] = {"begin": self.begin, "round": self.round, "answers": self.answers}
        return tasks[what](*arguments)

    def begin(self, arm: str, targets: Poses, qs: Array) -> tuple[int, int]:
        """Make the solver ready; how many of the targets it gets, and how many elbow angles it chooses."""
        self._ready = solver = self._lister(arm, targets, qs)
        probe = slice(0, min(10, len(qs)))
        seconds, _ = timed([solver.ask_some(probe)] * 3 + [solver.ask(i) for i in range(probe.stop)])
        if (verified := solver.ask_for_verified(probe)) is not None:
            verified()
        fitting = int(ROUND_SECONDS / max(seconds[1:3].min() / probe.stop, 1e-9))
        count = min(len(qs), max(fitting, probe.stop))
        self._pieces = [slice(first, min(first + PIECE, count)) for first in range(0, count, PIECE)]
        return count, solver.angles

    def round(self) -> tuple[Array, Array, Array | None]:
        """Times of a target in a piece, in a call of its own and verified, [s]."""
        solver, pieces = self._solver(), self._pieces
        sizes = np.array([piece.stop - piece.start for piece in pieces])
        together, self._answers = timed([solver.ask_some(piece) for piece in pieces])
        few = min(FEW, pieces[-1].stop)
        single, _ = timed([solver.ask(i) for i in range(few)])
        checks = [solver.ask_for_verified(piece) for piece in pieces if piece.stop <= max(few, PIECE)]
        calls = [call for call in checks if call is not None]
        verified = timed(calls)[0] / sizes[: len(calls)] if calls else None
        return together / sizes, single, verified

    def answers(self) -> "Found":
        """What the last round found."""
        solver = self._solver()
        tables = [table for answer in self._answers for table in solver.read(answer)]
        counts = np.array([len(table) for table in tables])
        marks = [mark for answer in self._answers if (mark := solver.marked(answer)) is not None]
        qs = np.concatenate([table for table in tables if len(table)] or [np.empty((0, 0))])
        return Found(qs, counts, np.concatenate(marks) if marks else np.zeros(len(qs), dtype=bool))

    def _solver(self) -> Lister:
        assert self._ready is not None
        return self._ready


@contextmanager
def attendants() -> Iterator[dict[type[Lister], Attendant]]:
    """A process for each solver."""
    started = {lister: Attendant(Desk(lister), lister.one_core) for lister in LISTERS}
    try:
        yield started
    finally:
        for attendant in started.values():
            attendant.stop()


# One arm


def on_arm(name: str, count: int, all_attendants: Mapping[type[Lister], Attendant]) -> dict[type[Lister], Score | str]:
    """How all solvers do on an arm, or why they do not."""
    machine, chain = arm_of(name)
    qs = drawn(chain, count)
    targets = poses(machine, chain, qs)
    begun: dict[type[Lister], tuple[int, int]] = {}
    reasons: dict[type[Lister], str] = {}
    times: dict[type[Lister], list[tuple[Array, Array, Array | None]]] = {lister: [] for lister in LISTERS}
    found: dict[type[Lister], Found] = {}

    def asked(lister: type[Lister], *question: Any) -> Any:
        try:
            return all_attendants[lister].ask(*question) if lister not in reasons else None
        except Failed as failure:
            reasons[lister] = str(failure)
            return None

    for lister in LISTERS:
        begun[lister] = asked(lister, "begin", name, targets, qs)
    for _ in range(ROUNDS):
        for lister in LISTERS:
            times[lister].append(asked(lister, "round"))
    for lister in LISTERS:
        found[lister] = asked(lister, "answers")
    judged = judge(name, targets, {lister: found[lister] for lister in LISTERS if lister not in reasons})
    return {
        lister: reasons[lister]
        if lister in reasons
        else Score(timing(times[lister]), begun[lister][1], begun[lister][0], judged[lister])
        for lister in LISTERS
    }


def timing(rounds: Sequence[tuple[Array, Array, Array | None]]) -> Timing:
    """Medians over all rounds."""
    together, single = (float(np.median([one[k] for one in rounds])) * 1e6 for k in (0, 1))
    verified = [one[2] for one in rounds if one[2] is not None]
    return Timing(together, single, float(np.median(verified)) * 1e6 if verified else None)


def judge(name: str, targets: Poses, found: Mapping[type[Lister], Found]) -> dict[type[Lister], Judged]:
    """What the answers of each solver are worth."""
    held: dict[type[Lister], list[Array]] = {}
    rest: dict[type[Lister], tuple[int, int, float]] = {}
    for lister, (qs, counts, marked) in found.items():
        good, errors = holds(name, targets, qs, counts)
        owners = np.repeat(np.arange(len(counts)), counts)[good]
        held[lister] = distinct_tables(arm_of(name)[1], qs[good], np.bincount(owners, minlength=len(counts)))
        rest[lister] = int((~good).sum()), int((~good & ~marked).sum()), float(errors[good].max(initial=0.0))
    return {
        lister: Judged(sum(len(table) for table in tables), known_to(name, targets, lister, held), *rest[lister])
        for lister, tables in held.items()
    }


def known_to(name: str, targets: Poses, lister: type[Lister], held: Mapping[type[Lister], list[Array]]) -> int | None:
    """How many solutions of its targets all solvers together have found; None where each chose its own."""
    chain, own = arm_of(name)[1], held[lister]
    if CASES[name].kind != REDUNDANT:
        return sum(len(union(chain, [of[i] for of in held.values() if i < len(of)])) for i in range(len(own)))
    if lister is GelenkForms:
        return sum(len(table) for table in own) + missing_elsewhere(name, targets, held)
    return None


def holds(name: str, targets: Poses, qs: Array, counts: Indices) -> tuple[Flags, Array]:
    """Which configurations are solutions, looked at by Pinocchio; and the larger of their two errors."""
    owners = np.repeat(np.arange(len(counts)), counts)
    if len(qs) == 0:
        return np.zeros(0, dtype=bool), np.zeros(0)
    real = np.asarray(np.isfinite(qs).all(axis=1))
    reached, wanted = poses(*arm_of(name), np.where(real[:, None], qs, 0.0)), part(targets, owners)
    errors = np.maximum(distances(wanted, reached), angles(wanted, reached))
    return real & (errors <= ACCURATE), errors


def distinct_tables(chain: Chain, qs: Array, counts: Indices) -> list[Array]:
    """The different ones among the solutions of each target."""
    edges = np.concatenate(([0], np.cumsum(counts)))
    return [union(chain, [qs[first:last]]) for first, last in pairwise(edges)]


def union(chain: Chain, tables: Sequence[Array]) -> Array:
    """The different ones among some configurations, up to full turns."""
    qs = np.concatenate([table for table in tables if len(table)] or [np.empty((0, len(chain)))])
    apart = qs[:, None] - qs[None]
    turns = 2.0 * np.pi * np.rint(apart / (2.0 * np.pi))
    same = np.abs(apart - np.where(sliding(chain), 0.0, turns)).max(axis=2, initial=0.0) <= SAME
    # One that equals none before it.
    return np.asarray(qs[~np.tril(same, -1).any(axis=1)])


def missing_elsewhere(name: str, targets: Poses, held: Mapping[type[Lister], list[Array]], most: int = 20) -> int:
    """How many solutions of others ours does not find when it is asked at the elbow angles that they have."""
    chain = arm_of(name)[1]
    form = closed_form(chain)
    assert form is not None
    missing = 0
    for lister, tables in held.items():
        if lister is GelenkForms:
            continue
        for i, table in enumerate(tables[:most]):
            rows = np.full(len(table), i)
            ours = form.solve(
                part(targets, rows),
                np.zeros((1, len(chain))),
                respect_limits=False,
                elbow_angles=form.elbow_angles(table),
            )
            for k, (first, last) in enumerate(pairwise(ours.firsts)):
                missing += len(union(chain, [ours.qs[first:last], table[k : k + 1]])) > last - first
    return missing


# The tables


def show_arms(scores: Scores) -> None:
    """Print times, what was found and what was missing or wrong, arm by arm."""
    print("\nTime of a target with all its solutions, many in one call / one in a call from Python, µs:\n")
    heads = ["arm", *(lister.name for lister in LISTERS), "Gelenk, verified"]
    heads += [f"{peer.name} ÷ Gelenk" for peer in (EaikForms, Ssik)] + ["wanted"]
    show_table(heads, [[name, *time_cells(name, of_arm)] for name, of_arm in scores.items()])
    print("\nDifferent solutions of a target that hold, share of those that are known / answers that do not hold, in")
    print("brackets those that the solver does not mark as such / largest error of those that do:\n")
    show_table(
        ["arm", "targets", *(lister.name for lister in LISTERS)],
        [[name, *solution_cells(of_arm)] for name, of_arm in scores.items()],
    )
    print()
    for lister in LISTERS:
        for note in notes(scores, lister):
            print(f"- {lister.name}: {note}")
    print()


def show_table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a Markdown table."""
    for row in (heads, ["---"] * len(heads), *rows):
        print("| " + " | ".join(row) + " |")


def time_cells(name: str, of_arm: Mapping[type[Lister], Score | str]) -> list[str]:
    """An arm's times, the ratios of them and what they are to be."""
    cells = []
    for found in of_arm.values():
        if isinstance(found, str):
            cells.append(found.partition(":")[0])
        else:
            cells.append(f"{digits(found.per_angle)} / {digits(found.timing.single / found.angles)}")
    ours = of_arm[GelenkForms]
    if isinstance(ours, str) or ours.timing.verified is None:
        return [*cells, "", "", "", wanted_of(name)]
    ratios = [ratio_of(of_arm, peer) for peer in (EaikForms, Ssik)]
    texts = ["" if ratio is None else f"{ratio:.2f}" for ratio in ratios]
    return [*cells, digits(ours.timing.verified), *texts, wanted_of(name)]


def wanted_of(name: str) -> str:
    """What is asked of ours."""
    return {CLOSED: f"≤ {LIMIT:.0f} µs", GENERAL: "faster than ssik", REDUNDANT: ""}[CASES[name].kind]


def ratio_of(of_arm: Mapping[type[Lister], Score | str], peer: type[Lister]) -> float | None:
    """How many times longer a peer takes for a target among many."""
    ours, theirs = of_arm[GelenkForms], of_arm[peer]
    return None if isinstance(ours, str) or isinstance(theirs, str) else theirs.per_angle / ours.per_angle


def solution_cells(of_arm: Mapping[type[Lister], Score | str]) -> list[str]:
    """What an arm's solvers found."""
    cells, counts = [], []
    for found in of_arm.values():
        if isinstance(found, str):
            cells.append(found.partition(":")[0])
            continue
        counts.append(found.targets)
        each, known, invalid, unmarked, worst = found.judged
        share = "others" if known is None else f"{each / max(known, 1):.2%}"
        cells.append(f"{each / found.targets:.2f}, {share} / {invalid} ({unmarked}) / {worst:.0e}")
    return ["–".join(f"{count:,}" for count in sorted(set(counts))), *cells]


def notes(scores: Scores, lister: type[Lister]) -> Iterator[str]:
    """The solver's version, and why it gave no answers."""
    try:
        yield f"version {version(lister.package)}"
    except PackageNotFoundError:
        if lister is not GelenkForms:
            yield "not installed"
    reasons: dict[str, list[str]] = {}
    for name, of_arm in scores.items():
        if isinstance(reason := of_arm[lister], str):
            reasons.setdefault(reason, []).append(name)
    for reason, names in reasons.items():
        yield f"{', '.join(names)}: {reason}"
    if lister is GelenkForms:
        yield f"the iiwa is asked for an elbow angle of {ELBOW_ANGLE} rad"
    elif lister is EaikForms:
        yield "of the iiwa its third joint is locked where the target was drawn with it"
    else:
        yield "of the iiwa it lists 16 elbow angles of its own; the time is a sixteenth"


# The summary


def summary(scores: Scores) -> list[Row]:
    """What is asked of ours; ratios are of one arm, the worst one's and the median one's."""
    closed = {name: of_arm for name, of_arm in scores.items() if CASES[name].kind == CLOSED}
    others = {name: of_arm for name, of_arm in scores.items() if CASES[name].kind == GENERAL}
    what, general = "all IK solutions of a target, many in one call", "all IK solutions of a target, general 6R"
    return [
        *slowest_row(f"{what}, spherical wrist or three parallel axes", closed),
        *ratio_rows(what, closed, EaikForms),
        *ratio_rows(what, closed, Ssik),
        *ratio_rows(general, others, Ssik, "> 1"),
        *missing_rows(scores),
        *verified_row(scores),
    ]


def ours_on(scores: Scores) -> dict[str, Score]:
    """The arms on which ours has answers."""
    found = {name: of_arm[GelenkForms] for name, of_arm in scores.items()}
    return {name: score for name, score in found.items() if isinstance(score, Score)}


def slowest_row(what: str, scores: Scores) -> list[Row]:
    """The arm on which ours takes longest, against the limit."""
    ours, wanted = ours_on(scores), f"≤ {LIMIT:.0f} µs"
    if len(ours) < len(scores):
        return [Row(what, f"{len(ours)} of {len(scores)} arms answered", wanted=wanted)]
    name = max(ours, key=lambda name: ours[name].per_angle)
    return [Row(f"{what}, worst arm of {len(ours)} ({name})", f"{digits(ours[name].per_angle)} µs", wanted=wanted)]


def ratio_rows(what: str, scores: Scores, peer: type[Lister], wanted: str = "") -> list[Row]:
    """How many times longer a peer takes, on the worst arm and on the median one."""
    ratios = {name: ratio for name, of_arm in scores.items() if (ratio := ratio_of(of_arm, peer)) is not None}
    if not ratios:
        return [Row(what, "missing", f"{peer.name}: missing", wanted=wanted)]
    order = sorted(ratios, key=lambda name: ratios[name])
    rows = []
    for which, name in (("worst", order[0]), ("median", order[len(order) // 2])):
        ours, theirs = scores[name][GelenkForms], scores[name][peer]
        assert isinstance(ours, Score) and isinstance(theirs, Score)
        against = f"{peer.name}, {digits(theirs.per_angle)} µs"
        label = f"{what}, {which} arm of {len(order)} ({name})"
        rows.append(Row(label, f"{digits(ours.per_angle)} µs", against, ratios[name], wanted))
    return rows


def missing_rows(scores: Scores) -> list[Row]:
    """How many solutions are known, and how many of them each solver lacks on the arms that it takes."""
    rows = []
    for label, kinds in (("spherical wrist or three parallel axes", {CLOSED}), ("general 6R", {GENERAL})):
        chosen = {name: of_arm for name, of_arm in scores.items() if CASES[name].kind in kinds}
        texts = {lister: missing_text(chosen, lister) for lister in LISTERS}
        against = "; ".join(f"{lister.name} {texts[lister]}" for lister in LISTERS if lister is not GelenkForms)
        rows.append(Row(f"all IK solutions, {label}", texts[GelenkForms], against, wanted="none missing"))
    return rows


def missing_text(scores: Scores, lister: type[Lister]) -> str:
    """Of how many known solutions how many are missing, and how many answers are none."""
    scored = [score for of_arm in scores.values() if isinstance(score := of_arm[lister], Score)]
    if not scored:
        return "takes none of the arms"
    found = [score.judged for score in scored]
    known = sum(judged.known or 0 for judged in found)
    missing = sum(judged.known - judged.solutions for judged in found if judged.known is not None)
    invalid, unmarked = sum(judged.invalid for judged in found), sum(judged.unmarked for judged in found)
    wrong = f"{invalid:,} wrong answers ({unmarked:,} unmarked)"
    return f"{len(found)} arms, {missing:,} of {known:,} missing, {wrong}"


def verified_row(scores: Scores) -> list[Row]:
    """What ours takes with each solution recomputed through Pinocchio, on the arm where that is longest."""
    times = {name: score.timing.verified for name, score in ours_on(scores).items() if score.timing.verified}
    if not times:
        return []
    name = max(times, key=lambda name: times[name] or 0.0)
    what = f"all IK solutions of a target, each recomputed through Pinocchio, worst arm of {len(times)} ({name})"
    return [Row(what, f"{digits(times[name] or 0.0)} µs")]
