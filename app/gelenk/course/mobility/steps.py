"""The worked solution of a mobility, as a lecturer writes it on the board."""

from gelenk.course.mobility.mechanism import Mechanism
from gelenk.course.mobility.mobility import PairCount, Tally, verdict
from gelenk.course.mobility.pairs import FREEDOMS, KINDS
from gelenk.course.mobility.screws import PostureMobility
from gelenk.course.steps import Step, step
from gelenk.errors import quoted
from gelenk.language import marked, translated as _

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
