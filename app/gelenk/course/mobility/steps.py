"""The worked solution of a mobility, as a lecturer writes it on the board."""

from gelenk.course.mobility.mechanism import Mechanism
from gelenk.course.mobility.mobility import PairCount, Tally, verdict
from gelenk.course.mobility.pairs import FREEDOMS
from gelenk.course.mobility.screws import PostureMobility
from gelenk.course.steps import Step, step
from gelenk.errors import quoted

_VERDICTS = {
    "mechanism": "it moves: a mechanism",
    "structure": "it does not move: a structure, statically determinate",
    "overconstrained": "more constraints than freedoms: over-constrained",
}
_CHAINS = {
    "open": "no loop: an open chain",
    "closed": "two paths join each link to each other: a closed chain",
    "mixed": "some links lie on no loop, or on none with the others: a mixed chain",
}


def steps(counted: Tally, found: Mechanism | None, stands: PostureMobility | None = None) -> list[Step]:
    """Return the worked solution from the links to the verdict; the arguments are those of `warnings`."""
    total = counted.mobility if stands is None else stands.mobility
    idle = 0 if found is None else len(found.idle_spins())
    left = total - idle
    freedoms, n, j = FREEDOMS[counted.space], counted.links, counted.pairs
    parts = "1 of orientation and 2 of position" if counted.space == "planar" else "3 of orientation and 3 of position"
    ground = "" if found is None else f" {quoted(found.links[found.ground])}"
    listed = ", ".join(f"{kind.count} {_words(kind)}" for kind in counted.kinds) or "none"
    result = [
        step("Space", f"A free body has λ = {freedoms} freedoms: {parts}.", rf"\lambda = {freedoms}"),
        step("Links", f"n = {n}, the ground{ground} included.", f"n = {n}"),
        *(_split(split.joint, split.links) for split in counted.splits),
        step("Pairs", f"j = {j}: {listed}.", f"j = {j}"),
        _constraints(counted),
        _formula(counted),
    ]
    if stands is not None:
        result.append(_geometry(counted, stands))
    if idle:
        text = f"Idle freedoms, parts that spin between two spherical joints: {idle}. {total} − {idle} = {left}."
        result.append(step("Idle freedoms", text, f"{total} - {idle} = {left}"))
    if found is not None:
        result.append(_loops(found))
    return [*result, step("Verdict", f"M = {left}: {_VERDICTS[verdict(left)]}.", f"M = {left}")]


def _split(joint: str, links: int) -> Step:
    text = f"{links} links meet at joint {quoted(joint)}: it is split into {links} − 1 = {links - 1} pairs."
    return step("Coincident joint", text, f"{links} - 1 = {links - 1}")


def _words(kind: PairCount) -> str:
    order = f", {kind.order} order" if kind.order else ""
    return f"{kind.type.replace('_', ' ')} (c = {kind.constraints}{order})"


def _constraints(counted: Tally) -> Step:
    terms = [(kind.count, kind.constraints) for kind in counted.kinds]
    total = counted.constraints
    plain, latex = " + ".join(f"{k}·{c}" for k, c in terms), " + ".join(rf"{k} \cdot {c}" for k, c in terms)
    text = f"Σc = {plain} = {total}." if terms else "Σc = 0."
    if counted.couplings:
        who = "One joint follows" if counted.couplings == 1 else f"{counted.couplings} joints follow"
        text += f" {who} another one, a constraint each."
    return step("Constraints", text, rf"\sum c_i = {latex} = {total}" if terms else r"\sum c_i = 0")


def _formula(counted: Tally) -> Step:
    freedoms, n, total, m = FREEDOMS[counted.space], counted.links, counted.constraints, counted.couplings
    coupled = f" − {m}" if m else ""
    text = (
        f"n = {n}, j = {counted.pairs}, Σc = {total}, "
        f"M = λ(n − 1) − Σc = {freedoms}({n} − 1) − {total}{coupled} = {counted.mobility}."
    )
    latex = rf"M = \lambda (n - 1) - \sum c_i = {freedoms} \, ({n} - 1) - {total}{coupled} = {counted.mobility}"
    return step("Grübler", text, latex.replace("−", "-"))


def _geometry(counted: Tally, stands: PostureMobility) -> Step:
    freedoms, n, total, extra = FREEDOMS[counted.space], counted.links, counted.constraints, stands.redundant
    text = (
        f"Of the {total} constraints {total - extra} are independent as the linkage stands, {extra} redundant: "
        f"M = {freedoms}({n} − 1) − {total - extra} = {stands.mobility}."
    )
    latex = rf"M = \lambda (n - 1) - r = {freedoms} \, ({n} - 1) - {total - extra} = {stands.mobility}"
    return step("Geometry", text, latex)


def _loops(found: Mechanism) -> Step:
    graph, j, n = found.topology, len(found.pairs), len(found.links)
    parts = len(graph.components)
    text = f"Independent loops: L = j − n + {parts} = {j} − {n} + {parts} = {graph.loops}; {_CHAINS[graph.chain]}."
    return step("Loops", text, f"L = j - n + {parts} = {j} - {n} + {parts} = {graph.loops}")
