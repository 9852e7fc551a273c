"""Trajectories of a robot: planned, audited, sampled; as JSON, CSV, npy or a picture."""

from typing import Any

from gelenk.contract.trajectory_request import MAX_SAMPLES, TrajectoryRequest
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.trajectory_planned import PlannedTrajectory, TrajectorySizeLimits
from gelenk.robot.arrays import Array
from gelenk.store.records import LoadedRobot


def run(loaded: LoadedRobot, call: TrajectoryRequest, limits: Limits) -> Outcome:
    """Plan and audit a trajectory, and sample it."""
    planned = PlannedTrajectory.of(loaded.robot, call, TrajectorySizeLimits(MAX_SAMPLES, limits.answer_numbers))

    def content() -> dict[str, Any]:
        samples = planned.samples(planned.times())
        return planned.to_json(samples.to_json(call.pose_format), planned.certificate(samples))

    def array() -> tuple[Array, dict[str, str]]:
        return planned.table(planned.times()), planned.headers

    return Outcome(content, array, lambda kind: planned.picture(loaded.record.name, kind), planned.columns)


def is_heavy(_: TrajectoryRequest) -> bool:
    """Return True: planning a motion takes milliseconds."""
    return True
