"""Exceptions of the core, each with typed data and a message, but without an HTTP status.

A solver that does not converge and an unreachable target are results with a reason, not errors.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from string import Formatter
from typing import Any, ClassVar, Protocol, dataclass_transform

_QUOTED_LENGTH = 80
_OPTIONAL = re.compile(r"<(?P<text>[^<>{]*\{(?P<field>\w+)[^<>]*)>")
"""An optional part of a template."""


def quoted(name: str) -> str:
    """Quote, escape and shorten an untrusted name for use in a message."""
    shown = name if len(name) <= _QUOTED_LENGTH else name[: _QUOTED_LENGTH - 1] + "…"
    return "'" + "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in shown) + "'"


def listed(names: tuple[str, ...], most: int = 12) -> str:
    """Join the first names, quoted, and add how many more there are."""
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return (", ".join(quoted(name) for name in names[:most]) or "none") + more


def counted(count: int, thing: str) -> str:
    """Join a count and a noun, in the plural if needed: `1 joint`, `2 joints`, `3 entries`."""
    things = f"{thing[:-1]}ies" if thing.endswith("y") else f"{thing}s"
    return f"{count} {thing if count == 1 else things}"


def meshes_are(names: tuple[str, ...]) -> str:
    """Return the start of a sentence about meshes: `mesh 'a.stl' is`, `2 meshes ('a.stl', 'b.stl') are`."""
    return f"mesh {quoted(names[0])} is" if len(names) == 1 else f"{len(names)} meshes ({listed(names)}) are"


def kind_of(error: type[Exception]) -> str:
    """Convert the name of an error class to its name on the wire: `UnknownFrame` → `unknown-frame`."""
    return re.sub(r"(?<!^)(?=[A-Z])", "-", error.__name__).lower()


class _ErrorFormatter(Formatter):
    """Fills templates with the attributes of an error; `!q` quotes an untrusted name or a list of names."""

    def get_value(self, key: int | str, args: Sequence[Any], _: Mapping[str, Any]) -> Any:
        (error,) = args
        return getattr(error, str(key))

    def convert_field(self, value: Any, conversion: str | None) -> Any:
        if conversion != "q":
            return super().convert_field(value, conversion)
        return quoted(value) if isinstance(value, str) else listed(value)


@dataclass_transform(eq_default=False)
@dataclass(eq=False)
class KinematicsError(Exception):
    """Base class of all errors of the core.

    A subclass declares its data as fields, like a dataclass, and its message as a template.

    Attributes:
        template: One sentence for the caller: what is wrong, why, and what is allowed; see `_ErrorFormatter`. A part in
            `<>` is left out if its first field is unknown. Empty in a class of which only subclasses are raised.
    """

    template: ClassVar[str] = ""

    def __init_subclass__(cls) -> None:
        dataclass(eq=False)(cls)

    def __str__(self) -> str:
        return self.detail

    @property
    def detail(self) -> str:
        """Message for the caller: the filled template."""
        return _ErrorFormatter().format(_OPTIONAL.sub(self._if_known, self.template), self)

    def _if_known(self, part: re.Match[str]) -> str:
        return "" if getattr(self, part["field"]) in (None, (), []) else part["text"]

    def facts(self) -> dict[str, object]:
        """Return the typed data of the error by field name."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), tuple(getattr(self, field.name) for field in fields(self))


class InvalidInput(KinematicsError):
    """The request is invalid."""


class InvalidUrdf(InvalidInput):
    """The URDF does not describe a valid robot; where known, the error names the element and the line (1-based).

    For a xacro or MJCF, which may include others, it names the file too.
    """

    reason: str
    element: str | None = None
    line: int | None = None
    file: str | None = None
    template = "<file {_file}: ><line {line}: ><{element}: >{reason}"

    @property
    def _file(self) -> str | None:
        """The end of the path, which says more than its beginning."""
        path = self.file
        return (
            path if path is None else quoted(path if len(path) <= _QUOTED_LENGTH else f"…{path[1 - _QUOTED_LENGTH :]}")
        )


class InvalidDhTable(InvalidInput):
    """The DH table does not describe a valid robot; where known, the error names the joint (0-based) and parameter."""

    reason: str
    joint: int | None = None
    parameter: str | None = None
    template = "<joint {_row} of the table: ><{parameter}: >{reason}"

    @property
    def _row(self) -> int | None:
        return None if self.joint is None else self.joint + 1


class InvalidPose(InvalidInput):
    """The orientation differs from a rotation by more than rounding explains."""

    reason: str
    distance: float | None = None
    field: str | None = None
    index: int | None = None
    template = "<{field!q}: ><entry {index}: >{reason}< (distance {distance:.3g})>"


class InvalidArchive(InvalidInput):
    """The archive does not contain a URDF, its meshes and its SRDF; where known, the error names the entry.

    Where it is unclear which URDF is meant, `files` lists all of the archive.
    """

    reason: str
    entry: str | None = None
    files: tuple[str, ...] = ()
    template = "<entry {entry!q}: >{reason}<: {files!q}>"


class InvalidMesh(InvalidInput):
    """A mesh file is not one, or exceeds the limits within which it is read."""

    reason: str
    mesh: str
    template = "mesh {mesh!q}: {reason}"


class InvalidRobotFolder(InvalidInput):
    """A folder of the uploaded robots does not contain a valid robot; the error names the file at fault."""

    reason: str
    file: str
    template = "file {file!q}: {reason}"


class InvalidSceneFile(InvalidInput):
    """A file of the data folder does not contain a scene."""

    reason: str
    file: str
    template = "file {file!q} of the stored scenes: {reason}"


class InvalidName(InvalidInput):
    """A name is not suitable for a path and a URL; the error says of what it is to be the name."""

    name: str
    thing: str = "robot"
    template = (
        "{name!q} is not a {thing}'s name: 1 to 64 letters, digits, '_', '.' or '-', the first one a letter or digit"
    )


class InvalidField(InvalidInput):
    """A field of a request has the right type but an unusable value."""

    field: str
    reason: str
    template = "{field!q}: {reason}"


class InvalidArray(InvalidInput):
    """An array of numbers has the wrong shape or type."""

    reason: str
    template = "{reason}"


class _HasConfiguration(Protocol):
    index: int | None
    field: str


def _configuration(error: _HasConfiguration) -> str:
    """Describe where a configuration is in the request; name the field unless it is `joint_positions`."""
    if error.field != "joint_positions":
        return quoted(error.field) if error.index is None else f"entry {error.index} of {quoted(error.field)}"
    return "a configuration" if error.index is None else f"configuration {error.index}"


class WrongJointCount(InvalidInput):
    """A configuration does not have one number per joint of the chain."""

    given: int
    expected: tuple[str, ...]
    index: int | None = None
    field: str = "joint_positions"
    _place = property(_configuration)
    template = "{_place} has {_counts}, in this order: {expected!q}"

    @property
    def _counts(self) -> str:
        return f"{counted(self.given, 'number')} where the chain has {counted(len(self.expected), 'joint')}"


class MissingJoint(InvalidInput):
    """A configuration with values by joint name omits a joint of the chain."""

    joint: str
    expected: tuple[str, ...]
    index: int | None
    field: str = "joint_positions"
    _place = property(_configuration)
    template = "{_place} gives no value for joint {joint!q} of the chain"


class UnknownJoint(InvalidInput):
    """A configuration with values by joint name names a joint that the robot does not have."""

    joint: str
    expected: tuple[str, ...]
    index: int | None
    field: str = "joint_positions"
    _place = property(_configuration)
    template = (
        "{_place} gives a value for {joint!q}, which is not a joint of the robot; the chain's joints are {expected!q}"
    )


class OutsideLimits(InvalidInput):
    """A configuration violates a joint's limits in a call that respects them."""

    joint: str
    value: float
    lower: float
    upper: float
    index: int | None
    field: str = "joint_positions"
    _place = property(_configuration)
    template = "{_place}: joint {joint!q} at {value:.17g} is outside its limits [{lower:.17g}, {upper:.17g}]"


class UnsupportedJoint(InvalidInput):
    """A chain would cross a joint with more than one degree of freedom."""

    joint: str
    joint_type: str
    base_frame: str
    tip_frame: str
    template = (
        "the chain from {base_frame!q} to {tip_frame!q} would cross joint {joint!q} of type {joint_type}, which has "
        "more than one degree of freedom: choose a base and a tip on the same side of it, or describe it by revolute "
        "and prismatic joints"
    )


class FrameNotOnChain(InvalidInput):
    """The pose of a frame depends on joints outside the chain."""

    frame: str
    missing_joints: tuple[str, ...]
    base_frame: str
    tip_frame: str
    template = (
        "frame {frame!q} also moves with {missing_joints!q}, which the chain from {base_frame!q} to {tip_frame!q} "
        "does not have: request it as a tip_frame"
    )


class RepresentationSingularity(InvalidInput):
    """Euler angles have no unique rates at this orientation; the robot itself need not be singular there."""

    representation: str
    angle: str
    value: float
    index: int
    template = (
        "configuration {index}: the {representation} angles have no unique rate at {angle} = {value:.6g} rad, "
        "a singularity of the representation and not of the robot: use the geometric Jacobian here"
    )


class NotFound(KinematicsError):
    """The named object does not exist."""


class UnknownRobot(NotFound):
    """No robot has this name."""

    robot: str
    close: tuple[str, ...] = ()
    template = "there is no robot named {robot!q}<; did you mean {close!q}?>"


class UnknownScene(NotFound):
    """No scene has this name; in a call that names one, the error says in which field."""

    scene: str
    close: tuple[str, ...] = ()
    field: str | None = None
    template = "<{field!q}: >there is no scene named {scene!q}<; did you mean {close!q}?>"


class UnknownFrame(NotFound):
    """The robot has no frame of this name; where known, the error names the field of the request."""

    frame: str
    known: tuple[str, ...]
    field: str | None = None
    template = "<{field!q}: >the robot has no frame {frame!q}; its frames are {known!q}"


class UnknownMesh(NotFound):
    """The robot or scene has no file with this path."""

    path: str
    thing: str = "robot"
    template = "the {thing} has no file {path!q}"


class UnknownJob(NotFound):
    """No job has this name, or it has been removed."""

    job: str
    template = "there is no job {job!q}; the oldest jobs are removed when there are too many"


class UnknownPicture(NotFound):
    """No picture of the course has this name."""

    template = "there is no picture {picture!q}; there are {pictures!q}"
    picture: str
    pictures: tuple[str, ...]


class UnknownExercise(NotFound):
    """The course has no exercise with this id."""

    exercise: str
    known: tuple[str, ...]
    template = "there is no exercise {exercise!q}; the exercises are {known!q}"


class NotPrinted(KinematicsError):
    """A page cannot be printed here."""

    reason: str
    template = "no PDF: {reason}; `Accept: text/html` gets the page, which any browser prints"


class TooLarge(KinematicsError):
    """A call exceeds a size that the service is configured to accept."""

    what: str
    given: int
    allowed: int
    template = "{what}: {given} is more than the {allowed} allowed"


class QuotaExceeded(KinematicsError):
    """A client would exceed its storage quota; the fields give the amounts stored, added and allowed, and of what."""

    client: str
    what: str
    used: int
    more: int
    allowed: int
    thing: str
    _variable = property(lambda self: f"GELENK_CLIENT_{self.thing.upper()}")
    template = (
        "{used} {what} are stored for {client!q}, and this would add {more}; {allowed} are allowed: remove {thing}s "
        "that are no longer needed (DELETE /v1/{thing}s/{{{thing}}}), or have the operator raise {_variable}S or "
        "{_variable}_BYTES"
    )


class RobotExists(KinematicsError):
    """Another robot already uses the name; where known, the error gives a free one like it."""

    robot: str
    is_ours: bool = False
    free: str | None = None
    _whose = property(lambda self: "a robot of the catalogue" if self.is_ours else "another robot")
    _else = property(lambda self: "" if self.is_ours else ", or replace that robot")
    template = "the name {robot!q} is already used by {_whose}: choose another name<, such as {free!q}>{_else}"


class SceneExists(KinematicsError):
    """Another scene already uses the name."""

    scene: str
    template = "the name {scene!q} is already used by another scene: choose another name, or replace that one with PUT"


class ReadOnlyRobot(KinematicsError):
    """Robots of the catalogue can be neither replaced nor removed."""

    robot: str
    template = "{robot!q} belongs to the catalogue and is read-only"


class StorageFailed(KinematicsError):
    """A robot, a scene or a job cannot be written to disk durably."""

    reason: str
    template = (
        "the data folder cannot be written, so nothing was stored: {reason}; the operator must make it writable; "
        "stored data can still be read"
    )


class StorageFull(StorageFailed):
    """The disk is full."""

    template = (
        "the disk is full, so nothing was stored: {reason}; remove robots, scenes or jobs that are not needed, or ask "
        "the operator for more space, then try again"
    )


class JobExists(KinematicsError):
    """A job with another request already uses the name."""

    job: str
    template = (
        "the name {job!q} is already used by a job with another request: choose another name, leave it out, or DELETE "
        "that job"
    )


class JobNotFinished(KinematicsError):
    """A job's result was requested before it finished."""

    job: str
    state: str
    progress: float
    template = "job {job!q} is {state!a}, at {progress:.0%}: its result is available when it has finished"


class JobFinished(KinematicsError):
    """A finished job cannot be cancelled."""

    job: str
    state: str
    template = "job {job!q} is {state!a} and cannot be cancelled; remove it with `finished=remove`"


class JobCancelled(KinematicsError):
    """The result of a cancelled job was requested."""

    job: str
    template = "job {job!q} was cancelled and has no result"


class JobFailed(KinematicsError):
    """A job failed through no fault of the request."""

    reason: str
    template = "{reason}"


class JobInterrupted(KinematicsError):
    """A job did not finish because the service, or the job's process, ended first."""

    reason: str
    template = "the job has no result: {reason}; POST it again"


class ServiceStopping(KinematicsError):
    """The service is shutting down and accepts no more work."""

    template = "the service is shutting down: try again when it is back"


class JobTookTooLong(KinematicsError):
    """A job was stopped at the configured time limit."""

    allowed: float
    template = "the job took longer than the {allowed:g} s allowed: split the request into smaller ones"


class TooManyJobs(KinematicsError):
    """The queue of jobs is full, either for all clients together or for one client."""

    unfinished: int
    allowed: int
    retry_after: int
    limit: str = "service"
    template = "{unfinished} jobs of {_whose} are queued or running, of {allowed} allowed: try again in {retry_after} s"

    @property
    def _whose(self) -> str:
        return "this client" if self.limit == "client" else "all clients"


class ServiceBusy(KinematicsError):
    """The queue of requests is full."""

    retry_after: int
    template = "the service is at capacity: try again in {retry_after} s"


class NoRoomForBody(KinematicsError):
    """The memory for large request bodies is used up."""

    allowed: int
    retry_after: int = 1
    template = (
        "large request bodies together are limited to {allowed} bytes at a time, and this one would exceed that: try "
        "again in {retry_after} s"
    )


class TooManyRequests(KinematicsError):
    """A client has its maximum number of requests in progress."""

    allowed: int
    retry_after: int
    limit: str = "client"
    template = (
        "{allowed} requests of this client are in progress, the most it may have at a time: try again in "
        "{retry_after} s"
    )


class DeadlineExceeded(KinematicsError):
    """A request was cancelled at the configured time limit."""

    allowed: float
    template = (
        "the request took longer than the {allowed:g} s allowed and was cancelled: split it, or run it as a job "
        "(`Prefer: respond-async`) if the operation allows that"
    )


class WorkerCrashed(KinematicsError):
    """The process handling a request died; other requests are unaffected, and a new process replaces it."""

    reason: str
    template = "the process handling the request died ({reason}); other requests are not affected"


class WorkerOutOfMemory(KinematicsError):
    """A request needs more memory than the service is configured to give it."""

    allowed: int
    template = (
        "the request needs more than the {allowed} bytes of memory that one request may use: split it into smaller ones"
    )


class CertificationFailed(KinematicsError):
    """Two computations that share no code disagree, so the answer is withheld."""

    quantity: str
    error: float
    tolerance: float
    template = (
        "the answer was withheld: {quantity} computed in two independent ways differs by {error:.3g}, more than "
        "{tolerance:.3g}"
    )


def certify(quantity: str, error: float, tolerance: float) -> None:
    """Raise CertificationFailed if the difference of two computations is more than a tolerance, or NaN."""
    if not error <= tolerance:
        raise CertificationFailed(quantity, error, tolerance)


class AuditFailed(KinematicsError):
    """A motion violates its limits or tolerances, so the answer is withheld."""

    reason: str
    template = "the motion was withheld because it failed its audit: {reason}"


def kinds() -> dict[str, type[KinematicsError]]:
    """Return all error classes of this module except the base class, by their names on the wire."""
    classes = [cls for cls in globals().values() if isinstance(cls, type) and issubclass(cls, KinematicsError)]
    return {kind_of(cls): cls for cls in classes if cls is not KinematicsError}
