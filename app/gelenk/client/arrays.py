"""Operations on large batches: NumPy arrays in and out, sent as plain numbers."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Concatenate, ParamSpec, TypeVar

from httpx2 import Response
from pydantic import BaseModel

from gelenk.client.call import NPY, ROBOT, Awaited, Blocking, Call, Sent, documented
from gelenk.client.exchange import encoded, packed, query_of, segment, unpacked
from gelenk.contract.collisions import CollisionOptions
from gelenk.contract.dynamics import DynamicsOptions
from gelenk.contract.endpoints import BY_NAME
from gelenk.contract.fk import ForwardOptions
from gelenk.contract.ik import InverseOptions
from gelenk.contract.jacobian import JacobianOptions
from gelenk.contract.manipulability import ManipulabilityOptions
from gelenk.contract.singularities import SingularityOptions
from gelenk.contract.statics import StaticsOptions
from gelenk.contract.trajectories import MotionsOptions
from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.contract.velocity import VelocityOptions
from gelenk.robot.arrays import Array

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Reached:
    """Inverse kinematics of a batch of targets.

    Attributes:
        joint_positions: Shape (N, n), [rad or m]: for each target a solution, or the nearest configuration.
        unsolved: Number of targets without a solution.
        unsolved_rows: Indices of the first two hundred of them.
    """

    joint_positions: Array
    unsolved: int
    unsolved_rows: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Sampled:
    """A trajectory at its sample times.

    Attributes:
        samples: Shape (N, 1 + 3n): time [s], joint positions [rad or m], velocities [rad/s or m/s], accelerations.
        duration: Duration of the whole motion, [s].
        completed_fraction: Completed fraction of the segments, each weighted equally, 0 to 1.
        failure: Why the rest cannot be done, or None.
    """

    samples: Array
    duration: float
    completed_fraction: float
    failure: str | None


def _reached(response: Response) -> Reached:
    rows = response.headers["gelenk-unsolved-rows"]
    unsolved_rows = tuple(int(row) for row in rows.split(",") if row)
    return Reached(unpacked(response), int(response.headers["gelenk-unsolved"]), unsolved_rows)


def _sampled(response: Response) -> Sampled:
    headers, failure = response.headers, response.headers["gelenk-failure"]
    fraction = float(headers["gelenk-completed-fraction"])
    duration = float(headers["gelenk-duration"])
    return Sampled(unpacked(response), duration, fraction, None if failure == "none" else failure)


def _batch(
    name: str, options: Callable[P, BaseModel], read: Callable[[Response], T]
) -> Sent[Concatenate[str, Array, P], T]:
    """Define `POST /v1/robots/{robot}/{name}` with an array in both directions, and fields besides it."""

    def describe(robot: str, array: Array, /, *_: P.args, **fields: P.kwargs) -> Call[T]:
        path = f"v1/robots/{segment(robot)}/{name}"
        return Call("POST", path, read, query_of(fields), packed(array), NPY, accept=NPY)

    array = inspect.Parameter("array", inspect.Parameter.POSITIONAL_ONLY, annotation=Array)
    body = BY_NAME[name].npy_body
    return Sent(documented(describe, options, f"The operation `{name}` of a batch. The array: {body}", ROBOT, array))


def _trajectory(request: Callable[P, BaseModel]) -> Sent[Concatenate[str, P], Sampled]:
    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[Sampled]:
        return Call("POST", f"v1/robots/{segment(robot)}/trajectory", _sampled, body=encoded(fields), accept=NPY)

    return Sent(documented(describe, request, "A motion, planned and audited, as samples alone.", ROBOT))


def _result(job: str) -> Call[Array]:
    """Return the array of a job's result."""
    return Call("GET", f"v1/jobs/{segment(job)}/result", unpacked, accept=NPY)


class ArrayOperations:
    """Operations on a robot that take an array, and the arrays of jobs."""

    fk = _batch("fk", ForwardOptions, unpacked)
    jacobian = _batch("jacobian", JacobianOptions, unpacked)
    ik = _batch("ik", InverseOptions, _reached)
    velocity = _batch("velocity", VelocityOptions, unpacked)
    statics = _batch("statics", StaticsOptions, unpacked)
    dynamics = _batch("dynamics", DynamicsOptions, unpacked)
    manipulability = _batch("manipulability", ManipulabilityOptions, unpacked)
    singularities = _batch("singularities", SingularityOptions, unpacked)
    collisions = _batch("collisions", CollisionOptions, unpacked)
    trajectories = _batch("trajectories", MotionsOptions, unpacked)
    trajectory = _trajectory(TrajectoryRequest)
    job_result = Sent(_result)


class Arrays(ArrayOperations):
    """Array operations of a client that waits."""

    def __init__(self, client: Blocking) -> None:
        self.send = client.send


class AsyncArrays(ArrayOperations):
    """Array operations of a client that is awaited."""

    def __init__(self, client: Awaited) -> None:
        self.send = client.send
