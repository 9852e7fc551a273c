"""Everything the core refuses to do, with typed data and no HTTP status.

    KinematicsError
    ├── InvalidInput
    │   ├── InvalidUrdf              a description that is not a robot
    │   ├── InvalidDhTable           a table that is not a robot
    │   ├── InvalidPose              an orientation that is not one
    │   ├── InvalidArchive           a zip that is not one URDF and its meshes
    │   ├── InvalidRobotFolder       a folder, dropped in by hand, that is not a robot
    │   ├── InvalidName              a robot's name with other characters
    │   ├── InvalidField             a field of a request with an unusable value
    │   ├── InvalidArray             an array of the wrong shape or type
    │   ├── WrongJointCount          a configuration with too many or too few numbers
    │   ├── MissingJoint             a configuration by name that leaves a joint out
    │   ├── UnknownJoint             a configuration by name with a joint that the robot does not have
    │   ├── OutsideLimits            a configuration beyond a joint's limits, where the call respects them
    │   ├── UnsupportedJoint         a chain across a floating or planar joint
    │   ├── FrameNotOnChain          a frame that moves with joints the chain does not have
    │   └── RepresentationSingularity  Euler angles without a rate at this orientation
    ├── NotFound
    │   ├── UnknownRobot
    │   ├── UnknownFrame
    │   ├── UnknownMesh
    │   └── UnknownJob
    ├── TooLarge                     more than the service is configured to accept
    ├── QuotaExceeded                more robots, or bytes of them, than one client may store
    ├── RobotExists                  the name is already in use
    ├── ReadOnlyRobot                a robot of the catalogue
    ├── StorageFailed                the disk cannot be written to
    │   └── StorageFull              the disk is full
    ├── JobExists                    the name belongs to another job
    ├── JobNotFinished               a job that has no result yet
    ├── JobFinished                  a job that can no longer be cancelled
    ├── JobCancelled                 a cancelled job, which has no result
    ├── JobFailed                    something went wrong in a job
    ├── JobInterrupted               a job cut off when the service ended
    ├── ServiceStopping              the service is shutting down
    ├── JobTookTooLong               a job stopped at its time limit
    ├── TooManyJobs                  the queue of jobs is full: try again later
    ├── ServiceBusy                  the queue of requests is full: try again later
    ├── TooManyRequests              one client has too many requests in progress
    ├── NoRoomForBody                memory for large bodies is used up: try again later
    ├── DeadlineExceeded             a request stopped at its time limit
    ├── WorkerCrashed                the process handling a request died
    ├── WorkerOutOfMemory            a request needs more memory than allowed
    ├── CertificationFailed          two computations of the same number disagree: never sent
    └── AuditFailed                  a motion violates its limits or tolerances: never sent

Not converging, or a target out of reach, is a result with a reason, not an error.
"""

import re
from dataclasses import dataclass, fields

_QUOTED_LENGTH = 80


def quoted(name: str) -> str:
    """An untrusted name for use in a sentence: quoted, escaped, shortened."""
    shown = name if len(name) <= _QUOTED_LENGTH else name[: _QUOTED_LENGTH - 1] + "…"
    return "'" + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in shown) + "'"


def listed(names: tuple[str, ...], most: int = 12) -> str:
    """The first names of a list, quoted, and how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return (", ".join(quoted(name) for name in names[:most]) or "none") + more


def counted(count: int, thing: str) -> str:
    """How many there are, as a sentence has it: `1 joint`, `2 joints`, `3 entries`."""
    things = f"{thing[:-1]}ies" if thing.endswith("y") else f"{thing}s"
    return f"{count} {thing if count == 1 else things}"


def meshes_are(names: tuple[str, ...]) -> str:
    """How a sentence about meshes begins: `mesh 'a.stl' is`, `2 meshes ('a.stl', 'b.stl') are`."""
    return f"mesh {quoted(names[0])} is" if len(names) == 1 else f"{len(names)} meshes ({listed(names)}) are"


def kind_of(error: type[Exception]) -> str:
    """The name of a class of errors on the wire: `UnknownFrame` → `unknown-frame`."""
    return re.sub(r"(?<!^)(?=[A-Z])", "-", error.__name__).lower()


@dataclass(eq=False)
class KinematicsError(Exception):
    """The root: anything the core can refuse. `detail` is one sentence for the caller."""

    def __str__(self) -> str:
        return self.detail

    @property
    def detail(self) -> str:
        """What is wrong, why, and what is allowed."""
        raise NotImplementedError

    def facts(self) -> dict[str, object]:
        """The typed data of the error, by field name."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), tuple(getattr(self, field.name) for field in fields(self))


class InvalidInput(KinematicsError):
    """The request is invalid."""


@dataclass(eq=False)
class InvalidUrdf(InvalidInput):
    """The description is not a robot: why, in which element, on which line (1-based)."""

    reason: str
    element: str | None = None
    line: int | None = None

    @property
    def detail(self) -> str:
        """The reason behind the place."""
        where = [f"line {self.line}"] if self.line is not None else []
        where += [self.element] if self.element is not None else []
        return ": ".join([*where, self.reason])


@dataclass(eq=False)
class InvalidDhTable(InvalidInput):
    """The table is not a robot: why, in which joint (0-based) and which parameter."""

    reason: str
    joint: int | None = None
    parameter: str | None = None

    @property
    def detail(self) -> str:
        """The reason behind the place."""
        where = [f"joint {self.joint + 1} of the table"] if self.joint is not None else []
        where += [self.parameter] if self.parameter is not None else []
        return ": ".join([*where, self.reason])


@dataclass(eq=False)
class InvalidPose(InvalidInput):
    """The orientation is further from a rotation than rounding explains."""

    reason: str
    distance: float | None = None
    field: str | None = None
    index: int | None = None

    @property
    def detail(self) -> str:
        """Which pose, the reason, and the distance where one was measured."""
        where = "" if self.field is None else f"{quoted(self.field)}: "
        if self.index is not None:
            where += f"entry {self.index}: "
        return where + (self.reason if self.distance is None else f"{self.reason} (distance {self.distance:.3g})")


@dataclass(eq=False)
class InvalidArchive(InvalidInput):
    """The archive is not one URDF and its meshes: why, and which entry."""

    reason: str
    entry: str | None = None

    @property
    def detail(self) -> str:
        """The reason behind the entry."""
        return self.reason if self.entry is None else f"entry {quoted(self.entry)}: {self.reason}"


@dataclass(eq=False)
class InvalidRobotFolder(InvalidInput):
    """A folder among the uploaded robots is not one: why, and which of its files."""

    reason: str
    file: str

    @property
    def detail(self) -> str:
        """The reason behind the file."""
        return f"file {quoted(self.file)}: {self.reason}"


@dataclass(eq=False)
class InvalidName(InvalidInput):
    """A robot's name must be fit for a path and a URL."""

    name: str

    @property
    def detail(self) -> str:
        """The characters and length allowed in a name."""
        return (
            f"{quoted(self.name)} is not a robot's name: 1 to 64 letters, digits, '_', '.' or '-', "
            "the first one a letter or digit"
        )


@dataclass(eq=False)
class InvalidField(InvalidInput):
    """A field of a request has the right type but an unusable value."""

    field: str
    reason: str

    @property
    def detail(self) -> str:
        """The reason behind the field."""
        return f"{quoted(self.field)}: {self.reason}"


@dataclass(eq=False)
class InvalidArray(InvalidInput):
    """An array of numbers has the wrong shape or type."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason."""
        return self.reason


def _configuration(index: int | None, field: str) -> str:
    """The place of a configuration, in words; fields other than positions by name."""
    if field != "joint_positions":
        return quoted(field) if index is None else f"entry {index} of {quoted(field)}"
    return "a configuration" if index is None else f"configuration {index}"


@dataclass(eq=False)
class WrongJointCount(InvalidInput):
    """A configuration does not have one number per joint of the chain."""

    given: int
    expected: tuple[str, ...]
    index: int | None = None
    field: str = "joint_positions"

    @property
    def detail(self) -> str:
        """Both counts, and the names in order."""
        which = _configuration(self.index, self.field)
        return (
            f"{which} has {counted(self.given, 'number')} where the chain has {counted(len(self.expected), 'joint')}, "
            f"in this order: {listed(self.expected)}"
        )


@dataclass(eq=False)
class MissingJoint(InvalidInput):
    """A configuration given by name leaves a joint of the chain out."""

    joint: str
    expected: tuple[str, ...]
    index: int | None
    field: str = "joint_positions"

    @property
    def detail(self) -> str:
        """The joint that has no value."""
        return f"{_configuration(self.index, self.field)} gives no value for joint {quoted(self.joint)} of the chain"


@dataclass(eq=False)
class UnknownJoint(InvalidInput):
    """A configuration given by name has a joint that the robot does not have."""

    joint: str
    expected: tuple[str, ...]
    index: int | None
    field: str = "joint_positions"

    @property
    def detail(self) -> str:
        """The joint, and those that are allowed."""
        return (
            f"{_configuration(self.index, self.field)} gives a value for {quoted(self.joint)}, which is not a joint of "
            f"the robot; the chain's joints are {listed(self.expected)}"
        )


@dataclass(eq=False)
class OutsideLimits(InvalidInput):
    """A configuration lies beyond a joint's limits, and the call respects them."""

    joint: str
    value: float
    lower: float
    upper: float
    index: int | None
    field: str = "joint_positions"

    @property
    def detail(self) -> str:
        """The joint, its value and its limits."""
        return (
            f"{_configuration(self.index, self.field)}: joint {quoted(self.joint)} at {self.value:.17g} "
            f"is outside its limits [{self.lower:.17g}, {self.upper:.17g}]"
        )


@dataclass(eq=False)
class UnsupportedJoint(InvalidInput):
    """A chain would lead across a joint with more than one degree of freedom."""

    joint: str
    joint_type: str
    base_frame: str
    tip_frame: str

    @property
    def detail(self) -> str:
        """The joint that the chain crosses, and what to do."""
        return (
            f"the chain from {quoted(self.base_frame)} to {quoted(self.tip_frame)} would cross joint "
            f"{quoted(self.joint)} of type {self.joint_type}, which has more than one degree of freedom: choose a base "
            "and a tip on the same side of it, or describe it by revolute and prismatic joints"
        )


@dataclass(eq=False)
class FrameNotOnChain(InvalidInput):
    """The pose of a frame depends on joints that the chain does not have."""

    frame: str
    missing_joints: tuple[str, ...]
    base_frame: str
    tip_frame: str

    @property
    def detail(self) -> str:
        """The joints that would be needed."""
        return (
            f"frame {quoted(self.frame)} also moves with {listed(self.missing_joints)}, which the chain from "
            f"{quoted(self.base_frame)} to {quoted(self.tip_frame)} does not have: request it as a tip_frame"
        )


@dataclass(eq=False)
class RepresentationSingularity(InvalidInput):
    """Euler angles have no rate at this orientation, though the robot may move there."""

    representation: str
    angle: str
    value: float
    index: int

    @property
    def detail(self) -> str:
        """The angle at which the representation degenerates."""
        return (
            f"configuration {self.index}: the {self.representation} angles have no unique rate at "
            f"{self.angle} = {self.value:.6g} rad, a singularity of the representation and not of the robot: "
            "use the geometric Jacobian here"
        )


class NotFound(KinematicsError):
    """The named object does not exist."""


@dataclass(eq=False)
class UnknownRobot(NotFound):
    """No robot of this name."""

    robot: str
    close: tuple[str, ...] = ()

    @property
    def detail(self) -> str:
        """The name, and the nearest known ones."""
        hint = f"; did you mean {listed(self.close)}?" if self.close else ""
        return f"there is no robot named {quoted(self.robot)}{hint}"


@dataclass(eq=False)
class UnknownFrame(NotFound):
    """The robot has no frame of this name; in which field, where that is known."""

    frame: str
    known: tuple[str, ...]
    field: str | None = None

    @property
    def detail(self) -> str:
        """The name, and the frames that exist."""
        where = "" if self.field is None else f"{quoted(self.field)}: "
        return f"{where}the robot has no frame {quoted(self.frame)}; its frames are {listed(self.known)}"


@dataclass(eq=False)
class UnknownMesh(NotFound):
    """The robot's description came without this mesh file."""

    path: str

    @property
    def detail(self) -> str:
        """The path."""
        return f"the robot has no mesh file {quoted(self.path)}"


@dataclass(eq=False)
class UnknownJob(NotFound):
    """No job of this name, or none any more."""

    job: str

    @property
    def detail(self) -> str:
        """The name, and why it may be gone."""
        return f"there is no job {quoted(self.job)}; the oldest are removed when there are too many"


@dataclass(eq=False)
class TooLarge(KinematicsError):
    """More than the service is configured to accept in one call."""

    what: str
    given: int
    allowed: int

    @property
    def detail(self) -> str:
        """The quantity, the given number and the limit."""
        return f"{self.what}: {self.given} is more than the {self.allowed} allowed"


@dataclass(eq=False)
class QuotaExceeded(KinematicsError):
    """A client would store more than it may: of what, how much it has, how much is added, and how much is allowed."""

    client: str
    what: str
    used: int
    more: int
    allowed: int

    @property
    def detail(self) -> str:
        """The numbers, and what can be done."""
        return (
            f"{self.used} {self.what} are stored for {quoted(self.client)}, and this would add {self.more}; "
            f"{self.allowed} are allowed: remove robots that are no longer needed (DELETE /v1/robots/{{robot}}), or "
            "have the operator raise GELENK_CLIENT_ROBOTS or GELENK_CLIENT_ROBOT_BYTES"
        )


@dataclass(eq=False)
class RobotExists(KinematicsError):
    """Another robot already uses the name."""

    robot: str

    @property
    def detail(self) -> str:
        """The name, and the ways out."""
        return (
            f"the name {quoted(self.robot)} is already used by another robot: choose another name, "
            "or replace an uploaded one with PUT"
        )


@dataclass(eq=False)
class ReadOnlyRobot(KinematicsError):
    """Robots of the catalogue can be neither replaced nor removed."""

    robot: str

    @property
    def detail(self) -> str:
        """The name."""
        return f"{quoted(self.robot)} belongs to the catalogue and is read-only"


@dataclass(eq=False)
class StorageFailed(KinematicsError):
    """A robot cannot be written to disk durably."""

    reason: str

    @property
    def detail(self) -> str:
        """The system's message, and what to do."""
        return (
            f"the data folder cannot be written, so nothing was stored: {self.reason}; the operator must make it "
            "writable; stored data can still be read"
        )


class StorageFull(StorageFailed):
    """The disk is full."""

    @property
    def detail(self) -> str:
        """The system's message, and what to do."""
        return (
            f"the disk is full, so nothing was stored: {self.reason}; remove robots or jobs that are not needed, or "
            "ask the operator for more space, then try again"
        )


@dataclass(eq=False)
class JobExists(KinematicsError):
    """A job with another request already uses the name."""

    job: str

    @property
    def detail(self) -> str:
        """The name, and the ways out."""
        return (
            f"the name {quoted(self.job)} is already used by a job with another request: choose another name, "
            "leave it out, or DELETE that job"
        )


@dataclass(eq=False)
class JobNotFinished(KinematicsError):
    """A job's result was requested before it finished."""

    job: str
    state: str
    progress: float

    @property
    def detail(self) -> str:
        """How far it is."""
        return (
            f"job {quoted(self.job)} is {self.state!a}, at {self.progress:.0%}: its result is available when it has "
            "finished"
        )


@dataclass(eq=False)
class JobFinished(KinematicsError):
    """A finished job cannot be cancelled."""

    job: str
    state: str

    @property
    def detail(self) -> str:
        """Its state, and how to remove it."""
        return f"job {quoted(self.job)} is {self.state!a} and cannot be cancelled; remove it with `finished=remove`"


@dataclass(eq=False)
class JobCancelled(KinematicsError):
    """The result of a cancelled job was requested."""

    job: str

    @property
    def detail(self) -> str:
        """The name."""
        return f"job {quoted(self.job)} was cancelled and has no result"


@dataclass(eq=False)
class JobFailed(KinematicsError):
    """A job failed through no fault of the request."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason."""
        return self.reason


@dataclass(eq=False)
class JobInterrupted(KinematicsError):
    """A job did not finish because the service, or the job's process, ended first."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason, and what to do."""
        return f"the job has no result: {self.reason}; POST it again"


@dataclass(eq=False)
class ServiceStopping(KinematicsError):
    """The service is shutting down and accepts no more work."""

    @property
    def detail(self) -> str:
        """What to do."""
        return "the service is shutting down: try again when it is back"


@dataclass(eq=False)
class JobTookTooLong(KinematicsError):
    """A job was stopped at the configured time limit."""

    allowed: float

    @property
    def detail(self) -> str:
        """The time limit, and what to do."""
        return f"the job took longer than the {self.allowed:g} s allowed: split the request into smaller ones"


@dataclass(eq=False)
class TooManyJobs(KinematicsError):
    """The queue of jobs, in all or of one client, is full."""

    unfinished: int
    allowed: int
    retry_after: int
    limit: str = "service"

    @property
    def detail(self) -> str:
        """The number of jobs, and whose limit that is."""
        whose = "jobs of this client" if self.limit == "client" else "jobs of all clients"
        return (
            f"{self.unfinished} {whose} are queued or running, of {self.allowed} allowed: try again in "
            f"{self.retry_after} s"
        )


@dataclass(eq=False)
class ServiceBusy(KinematicsError):
    """The queue of requests is full."""

    retry_after: int

    @property
    def detail(self) -> str:
        """When to try again."""
        return f"the service is at capacity: try again in {self.retry_after} s"


@dataclass(eq=False)
class NoRoomForBody(KinematicsError):
    """The memory for large request bodies is used up."""

    allowed: int
    retry_after: int = 1

    @property
    def detail(self) -> str:
        """The number of bytes allowed, and when to try again."""
        return (
            f"large request bodies together are limited to {self.allowed} bytes at a time, and this one would exceed "
            f"that: try again in {self.retry_after} s"
        )


@dataclass(eq=False)
class TooManyRequests(KinematicsError):
    """A client has its maximum number of requests in progress."""

    allowed: int
    retry_after: int
    limit: str = "client"

    @property
    def detail(self) -> str:
        """The number allowed, and when to try again."""
        return (
            f"{self.allowed} requests of this client are in progress, the most it may have at a time: try again in "
            f"{self.retry_after} s"
        )


@dataclass(eq=False)
class DeadlineExceeded(KinematicsError):
    """A request was cancelled at the configured time limit."""

    allowed: float

    @property
    def detail(self) -> str:
        """The time limit, and what to do."""
        return (
            f"the request took longer than the {self.allowed:g} s allowed and was cancelled: split it, or run it as a "
            "job (`Prefer: respond-async`) if the operation allows that"
        )


@dataclass(eq=False)
class WorkerCrashed(KinematicsError):
    """The process handling a request died; other requests are unaffected, and a new process replaces it."""

    reason: str

    @property
    def detail(self) -> str:
        """The cause of death."""
        return f"the process handling the request died ({self.reason}); other requests are not affected"


@dataclass(eq=False)
class WorkerOutOfMemory(KinematicsError):
    """A request needs more memory than the service is configured to give it."""

    allowed: int

    @property
    def detail(self) -> str:
        """The memory limit in bytes, and what to do."""
        return (
            f"the request needs more than the {self.allowed} bytes of memory that one request may use: split it into "
            "smaller ones"
        )


@dataclass(eq=False)
class CertificationFailed(KinematicsError):
    """Two computations that share no code disagree: the answer is withheld."""

    quantity: str
    error: float
    tolerance: float

    @property
    def detail(self) -> str:
        """What disagrees, and by how much."""
        return (
            f"the answer was withheld: {self.quantity} computed in two independent ways differs by "
            f"{self.error:.3g}, more than {self.tolerance:.3g}"
        )


@dataclass(eq=False)
class AuditFailed(KinematicsError):
    """A motion violates its limits or tolerances: the answer is withheld."""

    reason: str

    @property
    def detail(self) -> str:
        """The violation found."""
        return f"the motion was withheld: it failed its audit: {self.reason}"


def kinds() -> dict[str, type[KinematicsError]]:
    """All classes of the tree except its root, by their name on the wire; subclasses defined elsewhere are left out."""
    found: dict[str, type[KinematicsError]] = {}
    left: list[type[KinematicsError]] = [KinematicsError]
    while left:
        children = [child for child in left.pop().__subclasses__() if child.__module__ == __name__]
        found |= {kind_of(child): child for child in children}
        left += children
    return found
