"""The way to every other operation: its fields as JSON."""

import json
from pathlib import Path
from typing import Annotated, Any

import typer

from app.calls.call import Call, Sent
from app.calls.operations import Operations
from app.cli.inputs import STDIN
from app.cli.outputs import Format, Output, Rows
from app.cli.session import session
from app.model.errors import InvalidField

_ABOUT_ROBOTS = {"velocity", "statics", "dynamics", "singularities"}
_OTHERS = {
    *("dc_motor", "gear", "pulse_width_modulation", "encoder", "planar_workspace", "fly_over", "mobility"),
    *("orientation", "time_law", "spline", "time_scaling"),
}


def ask(
    context: typer.Context,
    operation: Annotated[str, typer.Argument(help=f"One of {', '.join(sorted(_ABOUT_ROBOTS | _OTHERS))}.")],
    fields: Annotated[str, typer.Argument(help="JSON, or a file with it; - is standard input.")],
    robot: Annotated[str | None, typer.Option(help="The robot, where the operation is about one.")] = None,
) -> None:
    """Any other operation of the API, with its fields as JSON; the answer is JSON too."""
    shared, body = session(context), _object(fields)
    if operation not in _ABOUT_ROBOTS | _OTHERS:
        raise InvalidField("operation", f"must be one of {', '.join(sorted(_ABOUT_ROBOTS | _OTHERS))}")
    if (operation in _ABOUT_ROBOTS) != (robot is not None):
        raise InvalidField("robot", "is needed by this operation" if robot is None else "means nothing to it")
    method: Sent[Any, Any] = vars(Operations)[operation]
    if robot is None:
        with shared.client() as client:
            answer = client.send(_call(method, **body))
    else:
        with shared.robot(robot) as (client, name):
            answer = client.send(_call(method, name, **body))
    output = shared.output
    content = answer.model_dump(mode="json", exclude_unset=True)
    Output(output.form or Format.JSON, output.file).write(content, Rows(("field", "value"), list(content.items())))


def _call(method: Sent[Any, Any], *arguments: str, **fields: Any) -> Call[Any]:
    call: Call[Any] = method.describe(*arguments, **fields)
    return call


def _object(text: str) -> dict[str, Any]:
    if text == STDIN:
        text = typer.get_text_stream("stdin").read()
    elif not text.lstrip().startswith("{"):
        text = Path(text).read_text(encoding="utf-8")
    try:
        content = json.loads(text)
    except json.JSONDecodeError as error:
        raise InvalidField("fields", f"is not JSON: {error}") from None
    if not isinstance(content, dict):
        raise InvalidField("fields", "must be a JSON object")
    return content
