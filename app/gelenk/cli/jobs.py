"""Commands about jobs that a service runs in the background."""

from enum import StrEnum
from typing import Annotated

import typer

from gelenk.cli.outputs import Format
from gelenk.cli.session import session

JobArgument = Annotated[str, typer.Argument(metavar="JOB", help="Its id.")]


class Finished(StrEnum):
    """What becomes of a job that has come to its end."""

    KEEP = "keep"
    REMOVE = "remove"


jobs = typer.Typer(name="jobs", help="Jobs of a service: follow, read, cancel or remove them.")


@jobs.command("show")
def show(context: typer.Context, job: JobArgument) -> None:
    """How far a job is."""
    shared = session(context)
    with shared.client() as client:
        info = client.job(job)
    shared.tell_job(info)


@jobs.command("watch")
def watch(context: typer.Context, job: JobArgument) -> None:
    """Wait until a job has come to its end, with a bar on a terminal; Ctrl-C leaves it alone."""
    shared = session(context)
    with shared.client() as client, shared.bar(job) as progress:
        info = client.wait(job, lambda info: progress(info.progress))
    shared.tell_job(info)


@jobs.command("result")
def result(context: typer.Context, job: JobArgument) -> None:
    """What came out of a job: JSON, or with --format npy the array."""
    shared = session(context)
    with shared.client() as client:
        if shared.output.format is Format.NPY:
            shared.output.save(client.arrays.job_result(job))
            return
        read = {"workspace": client.workspace_result, "ik": client.ik_result, "trajectory": client.trajectory_result}
        answer = read[client.job(job).kind](job)
    shared.output.tell(answer)


@jobs.command("cancel")
def cancel(
    context: typer.Context,
    job: JobArgument,
    finished: Annotated[Finished, typer.Option(help="What to do with a finished job.")] = Finished.KEEP,
) -> None:
    """Cancel a job; one that has come to its end is refused, or removed where that is said."""
    shared = session(context)
    with shared.client() as client:
        info = client.cancel_job(job, finished=finished.value)
    shared.tell_job(info)
