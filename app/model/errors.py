"""Everything the core refuses to do, with typed data and no HTTP status.

    KinematicsError
    ├── InvalidInput
    │   ├── InvalidUrdf              a description that is not a robot
    │   ├── InvalidDhTable           a table that is not a robot
    │   ├── InvalidPose              an orientation that is not one
    │   ├── InvalidArchive           a zip that is not one URDF and its meshes
    │   ├── InvalidRobotFolder       a folder, dropped in by hand, that is not a robot
    │   ├── InvalidName              a robot's name with other characters
    │   ├── InvalidField             a field of a request that cannot be taken
    │   ├── InvalidArray             an array of the wrong shape or type
    │   ├── WrongJointCount          a configuration with too many or too few numbers
    │   ├── MissingJoint             a configuration by name that leaves a joint out
    │   ├── UnknownJoint             a configuration by name with a joint that the robot has not
    │   ├── OutsideLimits            a configuration beyond a joint's limits, where asked to respect them
    │   ├── UnsupportedJoint         a chain across a floating or planar joint
    │   ├── FrameNotOnChain          a frame that moves with joints the chain does not have
    │   └── RepresentationSingularity  Euler angles without a rate at this orientation
    ├── NotFound
    │   ├── UnknownRobot
    │   ├── UnknownFrame
    │   ├── UnknownMesh
    │   └── UnknownJob
    ├── TooLarge                     more than the service is set up to take
    ├── QuotaExceeded                more robots, or bytes of them, than one client may keep
    ├── RobotExists                  the name stands for something else
    ├── ReadOnlyRobot                a robot of the catalogue
    ├── StorageFailed                the disk cannot be written to
    │   └── StorageFull              the disk is full
    ├── JobExists                    the name stands for another job
    ├── JobNotFinished               a job that has no result yet
    ├── JobFinished                  a job that cannot be cancelled any more
    ├── JobCancelled                 a job that will have none
    ├── JobFailed                    something went wrong in a job
    ├── JobInterrupted               a job that the end of the service has ended
    ├── ServiceStopping              the service takes no more work
    ├── JobTookTooLong               a job that was ended
    ├── TooManyJobs                  so many wait that another one has to be asked for later
    ├── ServiceBusy                  so many requests wait that another one has to be asked for later
    ├── TooManyRequests              the same of a single client
    ├── NoRoomForBody                so many large bodies are held that another one has to be sent later
    ├── DeadlineExceeded             a request that was ended
    ├── WorkerCrashed                the process that worked on a request has died
    ├── WorkerOutOfMemory            a request that needs more memory than one may have
    ├── CertificationFailed          two computations of the same number disagree: never sent
    └── AuditFailed                  a motion breaks what was promised of it: never sent

Not converging, or a target out of reach, is a result with a reason and no error.
"""

import re
from dataclasses import dataclass, fields

_QUOTED_LENGTH = 80


def quoted(name: str) -> str:
    """A name from outside, fit for a sentence: quoted, escaped, shortened."""
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
    """The root: anything the core can refuse. `detail` is one sentence for the person who asked."""

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
    """Something is wrong in what was sent."""


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
        """What a name may hold."""
        return (
            f"{quoted(self.name)} is not a robot's name: 1 to 64 letters, digits, '_', '.' or '-', "
            "the first one a letter or digit"
        )


@dataclass(eq=False)
class InvalidField(InvalidInput):
    """A field of a request has the right type, and still cannot be taken."""

    field: str
    reason: str

    @property
    def detail(self) -> str:
        """The reason behind the field."""
        return f"{quoted(self.field)}: {self.reason}"


@dataclass(eq=False)
class InvalidArray(InvalidInput):
    """An array of numbers is not of the shape or type that is asked for."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason."""
        return self.reason


def _configuration(index: int | None, field: str) -> str:
    """What has not one number a joint, in words; of other fields than positions their name."""
    if field != "joint_positions":
        return quoted(field) if index is None else f"entry {index} of {quoted(field)}"
    return "a configuration" if index is None else f"configuration {index}"


@dataclass(eq=False)
class WrongJointCount(InvalidInput):
    """A configuration has not one number a joint of the chain."""

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
        """The joint that is missing."""
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
            f"{_configuration(self.index, self.field)} gives a value for {quoted(self.joint)}, which is no joint of "
            f"the robot; the chain's joints are {listed(self.expected)}"
        )


@dataclass(eq=False)
class OutsideLimits(InvalidInput):
    """A configuration lies beyond a joint's limits, and the call asked to respect them."""

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
        """The joint in the way, and what to do."""
        return (
            f"the way from {quoted(self.base_frame)} to {quoted(self.tip_frame)} leads across joint "
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
            f"{quoted(self.base_frame)} to {quoted(self.tip_frame)} does not have: ask for it as a tip_frame"
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
    """What the caller names does not exist."""


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
        return f"there is no job {quoted(self.job)}; old ones are removed when there are many"


@dataclass(eq=False)
class TooLarge(KinematicsError):
    """More than the service is set up to take in one call."""

    what: str
    given: int
    allowed: int

    @property
    def detail(self) -> str:
        """Both numbers."""
        return f"{self.what}: {self.given} is more than the {self.allowed} allowed"


@dataclass(eq=False)
class QuotaExceeded(KinematicsError):
    """A client would keep more than it may: of what, how much it keeps, what comes on top, and what is allowed."""

    client: str
    what: str
    used: int
    more: int
    allowed: int

    @property
    def detail(self) -> str:
        """The numbers, and what can be done."""
        return (
            f"{self.used} {self.what} are kept for {quoted(self.client)}, and {self.more} would come on top; "
            f"allowed are {self.allowed}: remove robots that are no longer needed (DELETE /v1/robots/{{robot}}), or "
            "have whoever runs the service raise GELENK_CLIENT_ROBOTS or GELENK_CLIENT_ROBOT_BYTES"
        )


@dataclass(eq=False)
class RobotExists(KinematicsError):
    """The name stands for another robot already."""

    robot: str

    @property
    def detail(self) -> str:
        """The name, and the ways out."""
        return (
            f"the name {quoted(self.robot)} stands for another robot: choose another name, "
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
        """What the system says, and what is to be done."""
        return (
            f"the data folder cannot be written to, so that nothing was kept: {self.reason}; whoever runs the service "
            "has to make it writable, and what is there can be read meanwhile"
        )


class StorageFull(StorageFailed):
    """There is no room on the disk."""

    @property
    def detail(self) -> str:
        """What the system says, and what is to be done."""
        return (
            f"there is no room for it, so that nothing was kept: {self.reason}; remove robots or jobs that are not "
            "needed, or ask whoever runs the service for more room, and send it again"
        )


@dataclass(eq=False)
class JobExists(KinematicsError):
    """The name stands for a job with another request."""

    job: str

    @property
    def detail(self) -> str:
        """The name, and the ways out."""
        return (
            f"the name {quoted(self.job)} stands for a job with another request: choose another name, "
            "leave it out, or DELETE that job"
        )


@dataclass(eq=False)
class JobNotFinished(KinematicsError):
    """A job whose result is asked for has none yet."""

    job: str
    state: str
    progress: float

    @property
    def detail(self) -> str:
        """How far it is."""
        return f"job {quoted(self.job)} is {self.state!a}, at {self.progress:.0%}: its result comes when it is done"


@dataclass(eq=False)
class JobFinished(KinematicsError):
    """A job that is to be cancelled has come to its end."""

    job: str
    state: str

    @property
    def detail(self) -> str:
        """What has become of it, and how it is removed."""
        return f"job {quoted(self.job)} is {self.state!a} and stays so: with `finished=remove` it is removed"


@dataclass(eq=False)
class JobCancelled(KinematicsError):
    """A job whose result is asked for was cancelled."""

    job: str

    @property
    def detail(self) -> str:
        """The name."""
        return f"job {quoted(self.job)} was cancelled and has no result"


@dataclass(eq=False)
class JobFailed(KinematicsError):
    """Something went wrong in a job that is no fault of the request."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason."""
        return self.reason


@dataclass(eq=False)
class JobInterrupted(KinematicsError):
    """A job whose result is asked for did not come to its end before the service, or its process of it, did."""

    reason: str

    @property
    def detail(self) -> str:
        """The reason, and what to do."""
        return f"the job has no result: {self.reason}; POST it again"


@dataclass(eq=False)
class ServiceStopping(KinematicsError):
    """The service is shutting down and takes no more work."""

    @property
    def detail(self) -> str:
        """What to do."""
        return "the service is shutting down: ask again when it is back"


@dataclass(eq=False)
class JobTookTooLong(KinematicsError):
    """A job was ended because it took longer than the service is set up to allow."""

    allowed: float

    @property
    def detail(self) -> str:
        """How long it may take."""
        return f"the job took longer than the {self.allowed:g} s allowed: ask for less at once"


@dataclass(eq=False)
class TooManyJobs(KinematicsError):
    """So many jobs wait, in all or of a client, that another one has to be asked for later."""

    unfinished: int
    allowed: int
    retry_after: int
    limit: str = "service"

    @property
    def detail(self) -> str:
        """How many there are, and whose limit that is."""
        whose = "jobs of this client" if self.limit == "client" else "jobs of all clients"
        return f"{self.unfinished} {whose} wait or run, of {self.allowed} allowed: ask again in {self.retry_after} s"


@dataclass(eq=False)
class ServiceBusy(KinematicsError):
    """So many requests wait that another one has to be asked for later."""

    retry_after: int

    @property
    def detail(self) -> str:
        """When to come back."""
        return f"the service has as many requests as it can work off: ask again in {self.retry_after} s"


@dataclass(eq=False)
class NoRoomForBody(KinematicsError):
    """So many large bodies are held that another one has to be sent later."""

    allowed: int
    retry_after: int = 1

    @property
    def detail(self) -> str:
        """How many bytes there may be, and when to come back."""
        return (
            f"the large bodies of all requests may have {self.allowed} bytes at a time, and with this one they would "
            f"have more: send it again in {self.retry_after} s"
        )


@dataclass(eq=False)
class TooManyRequests(KinematicsError):
    """A client has so many requests at work that another one has to be asked for later."""

    allowed: int
    retry_after: int
    limit: str = "client"

    @property
    def detail(self) -> str:
        """How many it may have."""
        return (
            f"{self.allowed} requests of this client are being worked on, and it may have no more at a time: "
            f"ask again in {self.retry_after} s"
        )


@dataclass(eq=False)
class DeadlineExceeded(KinematicsError):
    """A request was ended because it took longer than the service is set up to allow."""

    allowed: float

    @property
    def detail(self) -> str:
        """How long it may take."""
        return (
            f"the request took longer than the {self.allowed:g} s allowed and was ended: ask for less at once, or have "
            "it done as a job (`Prefer: respond-async`) where it can be"
        )


@dataclass(eq=False)
class WorkerCrashed(KinematicsError):
    """The process that worked on a request has died; no other request is touched, and a new process is there."""

    reason: str

    @property
    def detail(self) -> str:
        """What it died of."""
        return f"the process that worked on the request has died ({self.reason}); other requests are not touched by it"


@dataclass(eq=False)
class WorkerOutOfMemory(KinematicsError):
    """A request needs more memory than the service is set up to give to one."""

    allowed: int

    @property
    def detail(self) -> str:
        """How much it may take."""
        return f"the request needs more than the {self.allowed} bytes of memory that one may take: ask for less at once"


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
    """A motion does not keep to what was promised of it: the answer is withheld."""

    reason: str

    @property
    def detail(self) -> str:
        """What it breaks."""
        return f"the motion was withheld: it does not pass its audit: {self.reason}"


def kinds() -> dict[str, type[KinematicsError]]:
    """All classes of the tree but its root, by their name on the wire; what others derive from them is none of it."""
    found: dict[str, type[KinematicsError]] = {}
    left: list[type[KinematicsError]] = [KinematicsError]
    while left:
        children = [child for child in left.pop().__subclasses__() if child.__module__ == __name__]
        found |= {kind_of(child): child for child in children}
        left += children
    return found
