"""An operation of the API, declared once: server, client, command line, key scopes and reference are made of this."""

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
    """A request in, an answer out, both JSON; nothing is stored.

    Attributes:
        name: Of the client's method, of the operation at the command line, and of the module in `gelenk.operations`.
        path: Below the address of the service, without a leading slash.
        tag: The group that it is documented in.
        request: Model of the request.
        answer: Model of the answer.
        summary: In a few words.
        description: What it does, in Markdown.
        example: A request that runs as it stands, on the Panda where it is about a robot.
        operation_id: In the OpenAPI document; the name if left out.
        robot_field: The field of the request that names a robot; "" where there is none.
        picture: What an image of the answer shows; "" where it has none.
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
        npy_answer: What the npy answer holds.
        batch: The field that an npy body stands for; "" where there is no such body.
        options: Model of the fields in the query beside an npy body.
        npy_body: What an npy body holds.
        npy_holds_more: Whether that is more than the batch.
        table: What the answer holds as CSV; "" where it has none.
        job: What a job may do beyond a direct answer; "" where there is no job.
    """

    path: str = ""
    tag: Tag = "Kinematics"
    npy_answer: str
    batch: str = ""
    options: type[BaseModel] | None = None
    npy_body: str = ""
    npy_holds_more: bool = False
    table: str = ""
    job: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "path", f"v1/robots/{{robot}}/{self.name}")
