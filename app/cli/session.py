"""What a command is given beside its own arguments: the service that it asks, and where its answer goes."""

import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from pydantic import BaseModel
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from app.cli.inputs import pairs_of, robot_named
from app.cli.local import InProcess
from app.cli.outputs import Output, Rows
from app.client import Client
from app.schemas.jobs import JobInfo

RobotArgument = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        help="A robot's name, or a file: URDF, xacro, a zip of a URDF and its meshes, a DH table as JSON, TOML or CSV.",
    ),
]
BaseOption = Annotated[str | None, typer.Option("--base", help="Frame that poses are in; the default chain's.")]
TipOption = Annotated[str | None, typer.Option("--tip", help="Frame that is meant; the default chain's.")]
FromOption = Annotated[
    str | None, typer.Option("--from", help="File with a row each, CSV, npy or JSON; - is standard input.")
]


class Session:
    """The options that all commands share.

    Args:
        server: Address of the service; None for this very process.
        output: Where the answer goes.
        arguments: For xacro, `NAME=VALUE`.
        packages: For xacro, `NAME=FOLDER`.
    """

    def __init__(self, server: str | None, output: Output, arguments: Sequence[str], packages: Sequence[str]) -> None:
        self.server, self.output = server, output
        self._arguments, self._packages = arguments, packages

    @contextmanager
    def client(self) -> Iterator[Client]:
        """The service."""
        transport = None if self.server else InProcess()
        # In this very process there is no name to look up, and no key to show.
        with Client(self.server or "http://127.0.0.1", transport=transport) as client:
            yield client

    @contextmanager
    def robot(self, argument: str) -> Iterator[tuple[Client, str]]:
        """The service, and the name that a robot has there."""
        arguments = pairs_of(list(self._arguments), "arg")
        packages = pairs_of(list(self._packages), "package", Path)
        with self.client() as client, robot_named(client, argument, arguments, packages) as name:
            yield client, name

    def write(self, answer: BaseModel, rows: Rows) -> None:
        """An answer of the API."""
        self.output.write(answer.model_dump(mode="json", exclude_unset=True), rows)

    def wait(self, client: Client, job: JobInfo) -> JobInfo:
        """A job that has come to its end, its progress on the screen; Ctrl-C cancels it."""
        columns = (TextColumn("{task.description}"), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
        shown = Progress(*columns, TimeElapsedColumn(), transient=True, disable=not sys.stderr.isatty())
        with shown as progress:
            bar = progress.add_task(job.kind, total=1.0)
            try:
                return client.wait(job.id, lambda info: progress.update(bar, completed=info.progress))
            except KeyboardInterrupt:
                client.cancel_job(job.id)
                raise


def session(context: typer.Context) -> Session:
    """That of a command."""
    found: Any = context.obj
    return found if isinstance(found, Session) else Session(None, Output(), (), ())
