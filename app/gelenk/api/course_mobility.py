"""POST /v1/course/mobility: the freedoms of a mechanism or a robot, counted."""

from dataclasses import asdict
from typing import Any

from gelenk.api.course import course_route
from gelenk.api.errand import RobotErrand
from gelenk.api.remote import Remote
from gelenk.api.routes import DocumentedRoute
from gelenk.contract.course_mobility import EXAMPLE_FOUR_BAR, MobilityRequest
from gelenk.contract.course_mobility_answer import MobilityAnswer
from gelenk.course.mechanism import Mechanism, Pair, mechanism, mechanism_of_tree
from gelenk.course.mobility import KindCount, Tally, certify_mobility, tally, tally_of_counts, verdict, warnings
from gelenk.course.mobility_steps import steps
from gelenk.course.pairs import FREEDOMS
from gelenk.course.screws import Posture, posture
from gelenk.course.spaces import tasks
from gelenk.model.chain import Chain
from gelenk.store.library import Library


def mobility_route(remote: Remote, max_body_bytes: int) -> DocumentedRoute:
    """The count; a robot may have to be loaded first."""

    def count_mobility(call: MobilityRequest) -> MobilityAnswer:
        """Counts the degrees of freedom of a mechanism, M = λ(n - 1) - Σc, and classifies its chain.

        Give `space`, `links` and `pairs`; `pairs` as a list gives their links and so the loops, as an object the number
        of each type. Or give the name of a `robot`, whose tree is counted with its mimic joints, as Pinocchio's
        `model.nv`; `spaces` sets its default chain's n joints against the m numbers of a task (n > m is redundancy,
        which is not the same as several inverse solutions).

        Σc is over pairs, not joints: k links that meet at one joint are k - 1 pairs. `coincident` names such joints,
        or the pairs themselves name their `joint`; missing pairs are added, with a warning. (The
        notes have "more than two pairs in a joint"; it is more than two links. And the i-th pair takes c_i.)

        The formula ignores geometry: Bennett's linkage and a planar one counted with λ = 6 come out at -2 and move.
        M ≤ 0 is answered with that warning. Where each pair says where it is, by `point` and `axis`, `posture` has
        the mobility from the constraints that are independent there. Parts that spin between two spherical joints are
        found and subtracted in `mobility_without_idle`.
        """
        raise NotImplementedError

    return course_route(
        "mobility",
        count_mobility,
        MobilityRequest,
        _counted,
        remote,
        max_body_bytes,
        errand=RobotErrand(MobilityRequest, _counted_robot),
        example=EXAMPLE_FOUR_BAR,
        is_heavy=lambda call: call.robot is not None or call.has_geometry(),
        statuses=(400, 404, 413, 415, 422),
        operation_id="count_mobility",
        summary="Freedoms of a mechanism",
    )


def _counted_robot(call: MobilityRequest, library: Library) -> dict[str, Any]:
    if call.robot is None:
        return _counted(call)
    robot = library.get(call.robot).robot
    found = mechanism_of_tree(robot.description)
    return _content(tally(found), found, chain=robot.chain(None, None))


def _counted(call: MobilityRequest) -> dict[str, Any]:
    space = call.space or "spatial"
    if isinstance(call.pairs, list):
        names, ground = call.link_names()
        found = mechanism(space, names, ground, call.given_pairs(), call.nodes())
        stands = posture(found, call.output_link(names), call.rank_tolerance)
        return {**_content(tally(found), found, stands), "rank_tolerance": stands and call.rank_tolerance}
    return _content(tally_of_counts(space, call.link_count(), call.counts(), call.node_counts()), None)


def _content(
    counted: Tally, found: Mechanism | None, stands: Posture | None = None, chain: Chain | None = None
) -> dict[str, Any]:
    idle = None if found is None else found.idle_spins()
    left = (counted.mobility if stands is None else stands.mobility) - len(idle or ())
    return {
        "mobility": counted.mobility,
        "verdict": verdict(left),
        "space": counted.space,
        "space_freedoms": FREEDOMS[counted.space],
        "link_count": counted.links,
        "pair_count": counted.pairs,
        "constraint_count": counted.constraints,
        "coupling_count": counted.couplings,
        "kinds": [_kind(kind) for kind in counted.kinds],
        "splits": [asdict(split) for split in counted.splits],
        "mobility_without_split": counted.mobility_without_split,
        "idle": None if idle is None else [asdict(spin) for spin in idle],
        "mobility_without_idle": None if idle is None else left,
        **_graph(found),
        "posture": None if stands is None else asdict(stands),
        "rank_tolerance": None,
        "spaces": None if chain is None else _spaces(chain),
        "warnings": warnings(counted, found, stands),
        "steps": [asdict(step) for step in steps(counted, found, stands)],
    }


def _spaces(chain: Chain) -> dict[str, Any]:
    """Joint space and task spaces, by their dimensions."""
    return {
        "base_frame": chain.base_frame,
        "tip_frame": chain.tip_frame,
        "configuration_dimension": len(chain),
        "tasks": [asdict(one) for one in tasks(len(chain))],
    }


def _kind(kind: KindCount) -> dict[str, Any]:
    return {"type": kind.kind, "order": kind.order, "count": kind.count, "constraints": kind.constraints}


_GRAPH = ("ground", "chain", "loop_count", "components", "bridges", "pairs", "mobility_by_loops")


def _graph(found: Mechanism | None) -> dict[str, Any]:
    """What takes more than counts to tell."""
    if found is None:
        return dict.fromkeys(_GRAPH)
    graph, names = found.topology, found.links
    return {
        "ground": names[found.ground],
        "chain": graph.chain,
        "loop_count": graph.loops,
        "components": [[names[link] for link in part] for part in graph.components],
        "bridges": [found.pairs[i].name for i in graph.bridges],
        "pairs": [_pair(pair, names) for pair in found.pairs],
        "mobility_by_loops": certify_mobility(found),
    }


def _pair(pair: Pair, links: tuple[str, ...]) -> dict[str, Any]:
    return {
        "name": pair.name,
        "link_a": links[pair.links[0]],
        "link_b": links[pair.links[1]],
        "type": pair.kind,
        "order": pair.order,
        "constraints": pair.constraints,
        "freedoms": pair.freedoms,
        "joint": pair.joint,
        "added": pair.added,
    }
