"""Operations on large batches: NumPy arrays in and out, sent as plain numbers."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Concatenate, ParamSpec, TypeVar

from pydantic import BaseModel

from gelenk.client.call import NPY, ROBOT, Awaited, Blocking, Call, Reply, Sent, documented
from gelenk.client.exchange import encoded, segment
from gelenk.client.npy import packed, query_of, unpacked
from gelenk.contract.dynamics import DynamicsOptions
from gelenk.contract.fk import ForwardOptions
from gelenk.contract.ik import InverseOptions
from gelenk.contract.jacobian import JacobianOptions
from gelenk.contract.manipulability import ManipulabilityOptions
from gelenk.contract.singularities import SingularityOptions
from gelenk.contract.statics import StaticsOptions
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


def _reached(reply: Reply) -> Reached:
    rows = reply.headers["gelenk-unsolved-rows"]
    named = tuple(int(row) for row in rows.split(",") if row)
    return Reached(unpacked(reply), int(reply.headers["gelenk-unsolved"]), named)


def _sampled(reply: Reply) -> Sampled:
    headers, failure = reply.headers, reply.headers["gelenk-failure"]
    fraction = float(headers["gelenk-completed-fraction"])
    return Sampled(unpacked(reply), float(headers["gelenk-duration"]), fraction, None if failure == "none" else failure)


def _batch(
    name: str, options: Callable[P, BaseModel], field: str, read: Callable[[Reply], T]
) -> Sent[Concatenate[str, Array, P], T]:
    """Define `POST /v1/robots/{robot}/{name}` with an array in both directions.

    Args:
        name: Name of the operation.
        options: Fields besides the array.
        field: Content of the array.
        read: Reads the answer.
    """

    def describe(robot: str, array: Array, /, *_: P.args, **fields: P.kwargs) -> Call[T]:
        path = f"v1/robots/{segment(robot)}/{name}"
        return Call("POST", path, read, query_of(fields), packed(array), NPY, accept=NPY)

    array = inspect.Parameter("array", inspect.Parameter.POSITIONAL_ONLY, annotation=Array)
    sentences = f"The operation `{name}` of a batch; the array holds {field}."
    return Sent(documented(describe, options, sentences, ROBOT, array))


def _trajectory(request: Callable[P, BaseModel]) -> Callable[Concatenate[str, P], Call[Sampled]]:
    def describe(robot: str, /, *_: P.args, **fields: P.kwargs) -> Call[Sampled]:
        return Call("POST", f"v1/robots/{segment(robot)}/trajectory", _sampled, body=encoded(fields), accept=NPY)

    return documented(describe, request, "A motion, planned and audited, as samples alone.", ROBOT)


def _result(job: str) -> Call[Array]:
    """Return the array of a job's result."""
    return Call("GET", f"v1/jobs/{segment(job)}/result", unpacked, accept=NPY)


_POSITIONS = "`joint_positions`, shape (N, n), [rad or m]"


class ArrayOperations:
    """Operations on a robot that take an array, and the arrays of jobs."""

    fk = _batch("fk", ForwardOptions, _POSITIONS, unpacked)
    jacobian = _batch("jacobian", JacobianOptions, _POSITIONS, unpacked)
    ik = _batch(
        "ik",
        InverseOptions,
        "`targets`, shape (N, 7), position and quaternion x y z w, or (N, 4, 4)",
        _reached,
    )
    velocity = _batch(
        "velocity",
        VelocityOptions,
        "joint positions, velocities and further derivatives of each configuration, shape (N, k, n), or with `inverse` "
        "as in the API's reference",
        unpacked,
    )
    statics = _batch("statics", StaticsOptions, _POSITIONS, unpacked)
    dynamics = _batch("dynamics", DynamicsOptions, _POSITIONS, unpacked)
    manipulability = _batch("manipulability", ManipulabilityOptions, _POSITIONS, unpacked)
    singularities = _batch("singularities", SingularityOptions, _POSITIONS, unpacked)
    trajectory = Sent(_trajectory(TrajectoryRequest))
    job_result = Sent(_result)


class Arrays(ArrayOperations):
    """Array operations of a client that waits."""

    def __init__(self, client: Blocking) -> None:
        self._client = client

    def send(self, call: Call[T]) -> T:
        """Send a call with the client."""
        return self._client.send(call)


class AsyncArrays(ArrayOperations):
    """Array operations of a client that is awaited."""

    def __init__(self, client: Awaited) -> None:
        self._client = client

    async def send(self, call: Call[T]) -> T:
        """Send a call with the client."""
        return await self._client.send(call)
