"""An operation of the API, declared once: server, client, command line, scopes and reference are built from it."""

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, Literal, ParamSpec, TypeAlias, TypeVar

from pydantic import BaseModel

from gelenk.contract.common import Answer

P = ParamSpec("P")
A = TypeVar("A", bound=Answer)

Tag: TypeAlias = Literal["DH tables", "Course", "Kinematics"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Endpoint(Generic[P, A]):
    """An operation with a request and an answer in JSON; it stores nothing.

    Attributes:
        name: Name of the client's method, of the command line's operation, and of the module in `gelenk.operations`.
        path: Path below the address of the service, without a leading slash.
        tag: Group that it is documented in.
        request: Model of the request.
        answer: Model of the answer.
        summary: Summary in a few words.
        description: Description in Markdown.
        example: Request that works unchanged, on the Panda if it is about a robot.
        operation_id: Id in the OpenAPI document; the name if left out.
        robot_field: Field of the request that names a robot; "" if there is none.
        picture: What an image of the answer shows; "" if it has none.
    """

    name: str
    path: str
    tag: Tag
    request: Callable[P, BaseModel]
    answer: type[A]
    summary: str
    description: str
    example: dict[str, Any]
    operation_id: str = ""
    robot_field: str = ""
    picture: str = ""

    @property
    def text(self) -> str:
        """The description without the indentation of the source."""
        return inspect.cleandoc(self.description)


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotEndpoint(Endpoint[P, A]):
    """POST /v1/robots/{robot}/{name}: an operation on a robot, which can also answer with an array.

    Attributes:
        npy_answer: Content of the npy answer.
        batch: Field that an npy body stands for; "" if there is no such body.
        options: Model of the query fields beside an npy body.
        npy_body: Content of an npy body.
        npy_holds_more: Whether an npy body holds more than the batch.
        table: Content of the CSV answer; "" if it has none.
        job: What a job may do beyond a direct answer; "" if it cannot run as a job.
    """

    path: str = ""
    tag: Tag = "Kinematics"
    npy_answer: str
    batch: str = "joint_positions"
    options: type[BaseModel] | None = None
    npy_body: str = "`joint_positions` as an array of shape (N, n)."
    npy_holds_more: bool = False
    table: str = ""
    job: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", f"v1/robots/{{robot}}/{self.name}")
