"""Operations on large batches: NumPy in, NumPy out, nothing but numbers on the wire."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Concatenate, ParamSpec, TypeVar

from pydantic import BaseModel

from gelenk.calls.call import NPY, ROBOT, Awaited, Blocking, Call, Reply, Sent, documented
from gelenk.calls.exchange import encoded, segment
from gelenk.calls.npy import packed, query_of, unpacked
from gelenk.contract.dynamics import DynamicsOptions
from gelenk.contract.fk import ForwardOptions
from gelenk.contract.ik import InverseOptions
from gelenk.contract.jacobian import JacobianOptions
from gelenk.contract.manipulability import ManipulabilityOptions
from gelenk.contract.singularities import SingularityOptions
from gelenk.contract.statics import StaticsOptions
from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.contract.velocity import VelocityOptions
from gelenk.model.arrays import Array

P = ParamSpec("P")
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Reached:
    """The inverse of a batch of targets.

    Attributes:
        joint_positions: Shape (N, n), [rad or m]: of each target a solution, or what comes nearest.
        unsolved: How many targets have none.
        unsolved_rows: The first two hundred of them.
    """

    joint_positions: Array
    unsolved: int
    unsolved_rows: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Sampled:
    """A trajectory at its sample times.

    Attributes:
        samples: Shape (N, 1 + 3n): time [s], joint positions [rad or m], velocities [1/s of it], accelerations.
        duration: Of the whole motion, [s].
        completed_fraction: How much of the way can be done, 0 to 1.
        failure: Why not all of it, or None.
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
    """`POST /v1/robots/{robot}/{name}` with an array in both directions.

    Args:
        name: The operation's.
        options: What it takes beside the array.
        field: What the array stands for.
        read: Makes the answer.
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
    """The array that came out of a job."""
    return Call("GET", f"v1/jobs/{segment(job)}/result", unpacked, accept=NPY)


_POSITIONS = "`joint_positions`, shape (N, n), [rad or m]"


class ArrayOperations:
    """The operations on a robot that take an array, and jobs that end with one."""

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
    """These of a client that waits."""

    def __init__(self, client: Blocking) -> None:
        self._client = client

    def send(self, call: Call[T]) -> T:
        """As the client's."""
        return self._client.send(call)


class AsyncArrays(ArrayOperations):
    """The same operations, awaited."""

    def __init__(self, client: Awaited) -> None:
        self._client = client

    async def send(self, call: Call[T]) -> T:
        """As the client's."""
        return await self._client.send(call)
