"""The command `ask`, which calls any operation with its fields as JSON."""

import inspect
from functools import cache
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.completion import robots_beginning_with
from gelenk.cli.files.inputs import fields_of
from gelenk.cli.session import session
from gelenk.errors import InvalidField

if TYPE_CHECKING:
    from gelenk.client.call import Call, Sent

_BY_FILES = {"add_archive", "replace_archive", "add_scene_files", "replace_scene_files"}
"""Operations that take files; the commands `add` and `scenes put` call them."""


@cache
def operations() -> "dict[str, Sent[Any, Any]]":
    """Return all operations by name; loaded on demand, because that takes seconds."""
    from gelenk.client.call import Sent  # noqa: PLC0415
    from gelenk.client.operations import Operations  # noqa: PLC0415

    methods = vars(Operations).items()
    return {name: method for name, method in sorted(methods) if isinstance(method, Sent) and name not in _BY_FILES}


def _beginning(incomplete: str) -> list[str]:
    return [name for name in operations() if name.startswith(incomplete)]


def ask(
    context: typer.Context,
    operation: Annotated[
        str, typer.Argument(help="An operation such as velocity; an unknown name lists all.", autocompletion=_beginning)
    ],
    fields: Annotated[str | None, typer.Argument(help="JSON, or a file with it; - is standard input.")] = None,
    robot: Annotated[
        str | None,
        typer.Option(help="The robot, if the operation needs one.", autocompletion=robots_beginning_with),
    ] = None,
) -> None:
    """Any operation of the API, with its fields as JSON; the answer is JSON too."""
    shared, body = session(context), fields_of(fields)
    method = operations().get(operation)
    if method is None:
        raise InvalidField("operation", f"must be one of {', '.join(operations())}")
    if _is_about_robot(method) != (robot is not None):
        raise InvalidField("robot", f"is {'needed by' if robot is None else 'not a field of'} this operation")
    if robot is None:
        with shared.client() as client:
            answer = client.send(_call(method, **body))
    else:
        with shared.robot(robot) as (client, name):
            answer = client.send(_call(method, name, **body))
    if isinstance(answer, str | bytes):
        shared.output.put(answer if isinstance(answer, bytes) else answer.encode())
    elif answer is not None:
        shared.output.tell(answer)


def _is_about_robot(method: "Sent[Any, Any]") -> bool:
    """Check whether the first argument is a robot; as a field of a request it would be keyword-only."""
    first = next(iter(inspect.signature(method.describe).parameters.values()), None)
    return first is not None and first.name == "robot" and first.kind is not inspect.Parameter.KEYWORD_ONLY


def _call(method: "Sent[Any, Any]", /, *arguments: str, **fields: Any) -> "Call[Any]":
    """Describe a call. Raises InvalidField for unknown arguments; unknown fields of a body are left to the service."""
    try:
        return method.describe(*arguments, **fields)
    except TypeError as error:
        raise InvalidField("fields", str(error).partition("() ")[2]) from None
