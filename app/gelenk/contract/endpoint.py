"""An operation of the API, declared once: server, client, command line, scopes and reference are built from it."""

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any, Generic, Literal, ParamSpec, TypeAlias, TypeVar

from pydantic import BaseModel

from gelenk.contract.common import Answer

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)

Tag: TypeAlias = Literal["Robots", "Scenes", "DH tables", "Course", "Kinematics", "Jobs", "Service"]
Method: TypeAlias = Literal["GET", "POST", "PUT", "DELETE"]


class Scope(StrEnum):
    """A permission that a key grants.

    None includes another: a key for the metrics needs `admin`, which alone can neither compute nor change anything.
    """

    READ = "read"
    WRITE = "write"
    TEACH = "teach"
    ADMIN = "admin"


@dataclass(frozen=True, slots=True, kw_only=True)
class Route:
    """What every operation of the API declares.

    Attributes:
        name: Name of the operation.
        path: Path below the address of the service, without a leading slash.
        tag: Group that it is documented in.
        summary: Summary in a few words.
        description: Description in Markdown.
        method: Its method; HEAD is GET without the body.
        scope: Scope that a key needs for it; None if it needs no key.
        operation_id: Id in the OpenAPI document; the name if left out.
    """

    name: str
    path: str
    tag: Tag
    summary: str
    description: str = ""
    method: Method = "POST"
    scope: Scope | None = Scope.READ
    operation_id: str = ""

    @property
    def id(self) -> str:
        """Its id in the OpenAPI document, and its label in logs and metrics."""
        return self.operation_id or self.name

    @property
    def text(self) -> str:
        """The description without the indentation of the source."""
        return inspect.cleandoc(self.description)


@dataclass(frozen=True, slots=True, kw_only=True)
class Resource(Route):
    """An operation on what the service stores, or about the service itself; its handler is in `gelenk.http`.

    Unless it says otherwise it needs `write`, so that a new one is protected.

    Attributes:
        answer: Model of the answer in JSON; None if it has none.
        status: Status of the answer.
        responses: OpenAPI's responses besides problems, by status.
        problems: Statuses of the problems that it may answer with.
        example: Request that works unchanged; None without a body.
        form: Model of the fields that come with files, if it accepts some.
        files: Schema of the field of the form that holds the files, by its name.
    """

    scope: Scope | None = Scope.WRITE
    answer: Any = None
    status: int = 200
    responses: Mapping[int, dict[str, Any]] = field(default_factory=dict)
    problems: tuple[int, ...] = ()
    example: dict[str, Any] | None = None
    form: type[BaseModel] | None = None
    files: Mapping[str, dict[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Endpoint(Route, Generic[P, A]):
    """An operation with a request and an answer in JSON; it stores nothing, unless it runs as a job.

    Its name is that of the client's method, of the command line's operation, and of the module in `gelenk.operations`.

    Attributes:
        request: Model of the request.
        answer: Model of the answer.
        example: Request that works unchanged, on the Panda if it is about a robot.
        robot_field: Field of the request that names a robot; "" if there is none.
        picture: What an image of the answer shows; "" if it has none.
        is_picture: Whether the image is sent unless the caller prefers JSON.
        npy_answer: Content of the npy answer; "" if it has none.
        batch: Field that an npy body stands for; "" if there is no such body.
        options: Model of the query fields beside an npy body.
        npy_body: Content of an npy body.
        npy_holds_more: Whether an npy body holds more than the batch.
        table: Content of the CSV answer; "" if it has none.
        programs: Content of each further form of the answer, by media type; the query's `format` names them too.
        job: What a job may do beyond a direct answer; "" if there is no choice between the two.
        is_job: Whether it always runs as a job.
    """

    request: Callable[P, BaseModel]
    answer: type[A]
    example: dict[str, Any]
    robot_field: str = ""
    picture: str = ""
    is_picture: bool = False
    npy_answer: str = ""
    batch: str = ""
    options: type[BaseModel] | None = None
    npy_body: str = ""
    npy_holds_more: bool = False
    table: str = ""
    programs: Mapping[str, str] = field(default_factory=dict)
    job: str = ""
    is_job: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotEndpoint(Endpoint[P, A]):
    """POST /v1/robots/{robot}/{name}: an operation on a robot, most often at a batch of configurations."""

    path: str = ""
    tag: Tag = "Kinematics"
    batch: str = "joint_positions"
    npy_body: str = "`joint_positions` as an array of shape (N, n)."

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", f"v1/robots/{{robot}}/{self.name}")
