"""The worked solution of a mobility, as a lecturer writes it on the board; joint space and task space.

Solutions of the inverse problem need n ≥ m, and more: J must have rank m somewhere, which a planar arm of any number of
joints never has for a pose in space. Where it has, almost every target that the tip reaches is one at which J has rank
m (Sard), and its solutions form a surface of n - m dimensions: finitely many, as joints and poses are algebraic, where
n = m. Two notions that the notes mix are kept apart: n = m has finitely many solutions, its branches; only n > m is
redundancy, with infinitely many solutions and an internal motion of n - m dimensions (more at a singular posture).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.course.mobility.mechanism import Mechanism
from gelenk.course.mobility.mobility import PairCount, Tally, verdict
from gelenk.course.mobility.pairs import FREEDOMS, KINDS
from gelenk.course.mobility.screws import PostureMobility
from gelenk.course.steps import Step, step
from gelenk.errors import quoted
from gelenk.language import marked, translated as _
from gelenk.robot.result import Result

_VERDICTS = {
    "mechanism": marked("M = {mobility}: it moves: a mechanism."),
    "structure": marked("M = {mobility}: it does not move: a structure, statically determinate."),
    "overconstrained": marked("M = {mobility}: more constraints than freedoms: over-constrained."),
}
_CHAINS = {
    "open": marked("Independent loops: {sum} = {loops}; no loop: an open chain."),
    "closed": marked(
        "Independent loops: {sum} = {loops}; two paths without a common pair join each link to each other: a closed "
        "chain."
    ),
    "mixed": marked(
        "Independent loops: {sum} = {loops}; some links lie on no loop, or on none with the others: a mixed chain."
    ),
}
_ORDERS = {
    "low": marked("{count} {kind} (c = {constraints}, low order)"),
    "high": marked("{count} {kind} (c = {constraints}, high order)"),
    None: marked("{count} {kind} (c = {constraints})"),
}


def steps(counted: Tally, found: Mechanism | None, stands: PostureMobility | None = None) -> list[Step]:
    """Return the worked solution from the links to the verdict; the arguments are those of `warnings`."""
    total = counted.mobility if stands is None else stands.mobility
    idle = 0 if found is None else len(found.idle_spins())
    left = total - idle
    freedoms, n, j = FREEDOMS[counted.space], counted.links, counted.pairs
    space = _(
        "A free body has λ = 3 freedoms: 1 of orientation and 2 of position."
        if counted.space == "planar"
        else "A free body has λ = 6 freedoms: 3 of orientation and 3 of position."
    )
    links = _("n = {n}, the ground included.") if found is None else _("n = {n}, the ground {ground} included.")
    ground = "" if found is None else quoted(found.links[found.ground])
    pairs = _("j = {j}: {pairs}.") if counted.kinds else _("j = {j}: none.")
    result = [
        step(_("Space"), space, rf"\lambda = {freedoms}"),
        step(_("Links"), links.format(n=n, ground=ground), f"n = {n}"),
        *(_split(split.joint, split.links) for split in counted.splits),
        step(_("Pairs"), pairs.format(j=j, pairs=", ".join(map(_words, counted.kinds))), f"j = {j}"),
        _constraints(counted),
        _formula(counted),
    ]
    if stands is not None:
        result.append(_geometry(counted, stands))
    if idle:
        text = _("Idle freedoms, parts that spin between two spherical joints: {idle}. {total} − {idle} = {left}.")
        text = text.format(idle=idle, total=total, left=left)
        result.append(step(_("Idle freedoms"), text, f"{total} - {idle} = {left}"))
    if found is not None:
        result.append(_loops(found))
    return [*result, step(_("Verdict"), _(_VERDICTS[verdict(left)]).format(mobility=left), f"M = {left}")]


def _split(joint: str, links: int) -> Step:
    text = _("{links} links meet at joint {joint}: it is split into {links} − 1 = {pairs} pairs.")
    text = text.format(links=links, joint=quoted(joint), pairs=links - 1)
    return step(_("Coincident joint"), text, f"{links} - 1 = {links - 1}")


def _words(kind: PairCount) -> str:
    name = KINDS[kind.type].name if kind.type in KINDS else _("floating")
    return _(_ORDERS[kind.order]).format(count=kind.count, kind=name, constraints=kind.constraints)


def _constraints(counted: Tally) -> Step:
    terms = [(kind.count, kind.constraints) for kind in counted.kinds]
    total = counted.constraints
    plain, latex = " + ".join(f"{k}·{c}" for k, c in terms), " + ".join(rf"{k} \cdot {c}" for k, c in terms)
    text = f"Σc = {plain} = {total}." if terms else "Σc = 0."
    if counted.couplings:
        follow = _(
            "{sum} One joint follows another one, a constraint each."
            if counted.couplings == 1
            else "{sum} {couplings} joints follow another one, a constraint each."
        )
        text = follow.format(sum=text, couplings=counted.couplings)
    return step(_("Constraints"), text, rf"\sum c_i = {latex} = {total}" if terms else r"\sum c_i = 0")


def _formula(counted: Tally) -> Step:
    freedoms, n, total, m = FREEDOMS[counted.space], counted.links, counted.constraints, counted.couplings
    coupled = f" − {m}" if m else ""
    text = (
        f"n = {n}, j = {counted.pairs}, Σc = {total}, "
        f"M = λ(n − 1) − Σc = {freedoms}({n} − 1) − {total}{coupled} = {counted.mobility}."
    )
    latex = rf"M = \lambda (n - 1) - \sum c_i = {freedoms} \, ({n} - 1) - {total}{coupled} = {counted.mobility}"
    return step(_("Grübler"), text, latex.replace("−", "-"))


def _geometry(counted: Tally, stands: PostureMobility) -> Step:
    freedoms, n, total, extra = FREEDOMS[counted.space], counted.links, counted.constraints, stands.redundant
    text = _(
        "Of the {total} constraints {independent} are independent as the linkage stands, {redundant} redundant: {sum}."
    ).format(
        total=total,
        independent=total - extra,
        redundant=extra,
        sum=f"M = {freedoms}({n} − 1) − {total - extra} = {stands.mobility}",
    )
    latex = rf"M = \lambda (n - 1) - r = {freedoms} \, ({n} - 1) - {total - extra} = {stands.mobility}"
    return step(_("Geometry"), text, latex)


def _loops(found: Mechanism) -> Step:
    graph, j, n = found.topology, len(found.pairs), len(found.links)
    parts = len(graph.components)
    text = _(_CHAINS[graph.chain]).format(sum=f"L = j − n + {parts} = {j} − {n} + {parts}", loops=graph.loops)
    return step(_("Loops"), text, f"L = j - n + {parts} = {j} - {n} + {parts} = {graph.loops}")


TaskName: TypeAlias = Literal["xy", "xy_phi", "xyz", "pose"]
Solutions: TypeAlias = Literal["none", "finite", "infinite"]

_WORDS: dict[Solutions, str] = {
    "none": marked(
        "the tip never has all these directions (rank < m), so that a target at random is out of its reach."
    ),
    "finite": marked("of almost every target in reach there are finitely many solutions, the branches (rank = m = n)."),
    "infinite": marked(
        "of almost every target in reach there are infinitely many solutions: redundancy (rank = m < n)."
    ),
}
_TASKS: dict[TaskName, str] = {
    "xy": marked("Position in the plane"),
    "xy_phi": marked("Position in the plane with its angle"),
    "xyz": marked("Position in space"),
    "pose": marked("Pose in space"),
}


@dataclass(frozen=True, slots=True)
class TaskKind(Result):
    """A task, and what solutions of it a chain has.

    Attributes:
        task: The kind of task: a position in the plane x y or in space, without or with an orientation.
        dimension: m: numbers that a task of this kind sets.
        rank: Of the Jacobian's rows of the task, at random configurations: how many of its directions the tip has.
        redundancy: n - m: its degree, where ≥ 0; negative if joints are missing.
        solutions: Of the inverse problem. None for a target at random, where the rank is below m: too few joints, or a
            planar arm in space. Else, for almost every target in reach, finitely many branches (n = m), or infinitely
            many (n > m), which is redundancy; branches are not.
    """

    task: TaskName
    dimension: int
    rank: int
    redundancy: int
    solutions: Solutions


DIMENSIONS: dict[TaskName, int] = {"xy": 2, "xy_phi": 3, "xyz": 3, "pose": 6}
"""Dimension m of each task."""


def tasks(n: int, ranks: Mapping[TaskName, int]) -> tuple[TaskKind, ...]:
    """Return every kind of task, for a chain of n joints whose Jacobian has these ranks."""

    def solutions(m: int, rank: int) -> Solutions:
        return "none" if rank < m else "finite" if n == m else "infinite"

    return tuple(TaskKind(name, m, ranks[name], n - m, solutions(m, ranks[name])) for name, m in DIMENSIONS.items())


def spaces_step(n: int, found: tuple[TaskKind, ...]) -> Step:
    """Return the comparison of joint space and task spaces."""
    lines = [rf"n = {n},\quad m \le n,\quad \mathrm{{rank}}\, J \le \min(m, n)"]
    texts = [_("Joint space has n dimensions, task space m.")]
    for one in found:
        lines.append(rf"m = {one.dimension},\quad \mathrm{{rank}}\, J = {one.rank},\quad n - m = {one.redundancy}")
        texts.append(f"{_(_TASKS[one.task])}: {_(_WORDS[one.solutions])}")
    return step(_("Kinematic spaces"), " ".join(texts), *lines)
