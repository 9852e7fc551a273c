"""Trajectories of a robot: planned, audited, sampled; as JSON, CSV, npy or a picture."""

from typing import Any

from gelenk.contract.pose import Pose
from gelenk.contract.trajectory_request import MAX_SAMPLES, JointSegment, TrajectoryRequest
from gelenk.operations.cells import cell_bodies, has_cell
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.trajectory_planned import PlannedTrajectory, TrajectorySizeLimits
from gelenk.operations.trajectory_programs import programs
from gelenk.operations.trajectory_torques import has_torques
from gelenk.robot.arrays import Array
from gelenk.robot.compilation import is_awaited
from gelenk.store.records import LoadedRobot

_QUICK_SAMPLES = 1000
"""Samples of a motion that the event loop plans, audits and encodes in about two milliseconds."""

_MOVING = ("at", "start_velocities", "start_accelerations", "end_velocities", "end_accelerations")
"""Fields of a motion that does not begin or end at rest."""


def run(loaded: LoadedRobot, call: TrajectoryRequest, limits: Limits) -> Outcome:
    """Plan and audit a trajectory, and sample it."""
    return _outcome(loaded, call, _planned(loaded, call, limits))


def attempt(loaded: LoadedRobot, call: TrajectoryRequest, limits: Limits) -> Outcome | None:
    """Plan and audit a trajectory; return None if it has so many samples that they would take long."""
    planned = _planned(loaded, call, limits)
    duration = planned.found.motion.duration
    return _outcome(loaded, call, planned) if duration <= _QUICK_SAMPLES * call.sample_period else None


def is_heavy(call: TrajectoryRequest) -> bool:
    """Check whether planning takes more than about a millisecond: all but one movement of resting joints, in no cell.

    The first call in a cell prepares its bodies, which takes long.
    """
    if not (moves := call.moves()):
        return True
    first = moves[0]
    is_move = isinstance(first, JointSegment) and not isinstance(first.target, Pose)
    is_moving = any(getattr(call, name) is not None for name in _MOVING)
    has_more = call.steps or call.coefficients or call.compare_timing or has_torques(call) or has_cell(call)
    return len(moves) > 1 or not is_move or is_moving or has_more or is_awaited()


def _planned(loaded: LoadedRobot, call: TrajectoryRequest, limits: Limits) -> PlannedTrajectory:
    bounds = TrajectorySizeLimits(MAX_SAMPLES, limits.answer_numbers)
    return PlannedTrajectory.of(loaded.robot, call, bounds, cell_bodies(loaded, call))


def _outcome(loaded: LoadedRobot, call: TrajectoryRequest, planned: PlannedTrajectory) -> Outcome:
    def content() -> dict[str, Any]:
        samples = planned.samples(planned.times())
        return planned.to_json(samples.to_json(call.pose_format), planned.certificate(samples))

    def array() -> tuple[Array, dict[str, str]]:
        return planned.table(planned.times()), planned.headers

    name = loaded.record.name
    further = programs(planned, name)
    return Outcome(content, array, lambda kind: planned.picture(name, kind), planned.columns, programs=further)
