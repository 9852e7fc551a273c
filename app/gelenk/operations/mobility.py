"""The calculator of mobility: degrees of freedom of a mechanism or of a robot."""

from typing import Any

from gelenk.contract.mobility_request import MobilityRequest
from gelenk.course.mobility.mechanism import Mechanism, mechanism, mechanism_of_tree
from gelenk.course.mobility.mobility import Tally, certify_mobility, tally, tally_of_counts, verdict, warnings
from gelenk.course.mobility.pairs import FREEDOMS
from gelenk.course.mobility.screws import PostureMobility, posture
from gelenk.course.mobility.steps import DIMENSIONS, TaskName, spaces_step, steps, tasks
from gelenk.errors import InvalidField
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.kinematics.velocity.task_space import structure
from gelenk.operations.outcome import Limits, Outcome, PictureFormat
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot


def run(robot: LoadedRobot | None, call: MobilityRequest, _: Limits) -> Outcome:
    """Count the degrees of freedom of a mechanism or of a robot."""
    return Outcome(
        lambda: _counted(call) if robot is None else _counted_robot(robot.robot),
        picture=lambda kind: _picture(call, robot, kind),
    )


def _picture(call: MobilityRequest, robot: LoadedRobot | None, kind: PictureFormat) -> bytes:
    from gelenk.plots.course.mechanism import MOST_LINKS, mechanism_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    if robot is None and not isinstance(call.pairs, list):
        raise InvalidField("pairs", "an image shows pairs that name their links, not numbers of pairs")
    found = _mechanism(call) if robot is None else mechanism_of_tree(robot.robot.description)
    if len(found.links) > MOST_LINKS:
        field = "links" if robot is None else "robot"
        raise InvalidField(field, f"an image shows at most {MOST_LINKS} links; here are {len(found.links)}")
    return as_bytes(mechanism_figure(found), kind)


def _mechanism(call: MobilityRequest) -> Mechanism:
    """Return the mechanism whose pairs name their links."""
    names, ground = call.link_names()
    return mechanism(call.space or "spatial", names, ground, call.given_pairs(), call.nodes())


def is_heavy(call: MobilityRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return call.robot is not None or call.has_geometry()


def _counted_robot(robot: RobotModel) -> dict[str, Any]:
    found = mechanism_of_tree(robot.description)
    chain = robot.chain(None, None)
    kinds = tasks(len(chain), {name: _rank(chain, name) for name in DIMENSIONS})
    content = _content(tally(found), found)
    content["steps"].append(spaces_step(len(chain), kinds))
    ends = {"base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
    sizes = {"configuration_dimension": len(chain), "workspace_dimension": _rank(chain, "xyz")}
    return {**content, "spaces": {**ends, **sizes, "tasks": kinds}}


_DIRECTIONS: dict[TaskName, tuple[Direction, ...]] = {
    "xy": ("x", "y"),
    "xy_phi": ("x", "y", "rz"),
    "xyz": ("x", "y", "z"),
    "pose": DIRECTIONS,
}


def _rank(chain: Chain, task: TaskName) -> int:
    return structure(chain, Task(_DIRECTIONS[task])).rank if len(chain) else 0


def _counted(call: MobilityRequest) -> dict[str, Any]:
    space = call.space or "spatial"
    if isinstance(call.pairs, list):
        found = _mechanism(call)
        stands = posture(found, call.output_link(found.links), call.rank_tolerance)
        return {**_content(tally(found), found, stands), "rank_tolerance": stands and call.rank_tolerance}
    return _content(tally_of_counts(space, call.link_count(), call.counts(), call.node_counts()), None)


def _content(counted: Tally, found: Mechanism | None, stands: PostureMobility | None = None) -> dict[str, Any]:
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
        "kinds": counted.kinds,
        "splits": counted.splits,
        "mobility_without_split": counted.mobility_without_split,
        "idle": idle,
        "mobility_without_idle": None if idle is None else left,
        **_graph(found),
        "posture": stands,
        "rank_tolerance": None,
        "spaces": None,
        "warnings": warnings(counted, found, stands),
        "steps": steps(counted, found, stands),
    }


_GRAPH = ("ground", "chain", "loop_count", "components", "bridges", "pairs", "mobility_by_loops")


def _graph(found: Mechanism | None) -> dict[str, Any]:
    if found is None:
        return dict.fromkeys(_GRAPH)
    graph, names = found.topology, found.links
    return {
        "ground": names[found.ground],
        "chain": graph.chain,
        "loop_count": graph.loops,
        "components": [[names[link] for link in part] for part in graph.components],
        "bridges": [found.pairs[i].name for i in graph.bridges],
        "pairs": found.pairs,
        "mobility_by_loops": certify_mobility(found),
    }
