"""Commands about jobs that a service runs in the background."""

from typing import Annotated, Literal

import typer

from gelenk.cli.files.outputs import AnswerRows, Format
from gelenk.cli.session import JOB_COLUMNS, job_row, session

JobArgument = Annotated[str, typer.Argument(metavar="JOB", help="Its id.")]


jobs = typer.Typer(name="jobs", help="Jobs of a service: list, follow, read, cancel or remove them.")


@jobs.command("list")
def list_jobs(
    context: typer.Context,
    limit: Annotated[int, typer.Option(min=1, max=1000, help="How many at most.")] = 50,
    before: Annotated[
        int | None, typer.Option(min=1, help="`next` of the list before: goes on with older ones.")
    ] = None,
) -> None:
    """Your jobs, the newest first."""
    shared = session(context)
    with shared.client() as client:
        answer = client.list_jobs(limit, before)
    notes = () if answer.next is None else (f"there are older ones: --before {answer.next}",)
    shared.write(answer, AnswerRows(JOB_COLUMNS, [job_row(info) for info in answer.jobs], notes))


@jobs.command("show")
def show(context: typer.Context, job: JobArgument) -> None:
    """Show how far a job is."""
    shared = session(context)
    with shared.client() as client:
        shared.tell_job(client.job(job))


@jobs.command("watch")
def watch(context: typer.Context, job: JobArgument) -> None:
    """Wait until a job has finished, with a bar on a terminal; Ctrl-C leaves the job running."""
    shared = session(context)
    with shared.client() as client, shared.bar(job) as progress:
        info = client.wait(job, lambda info: progress(info.progress))
    shared.tell_job(info)


@jobs.command("result")
def result(context: typer.Context, job: JobArgument) -> None:
    """The result of a job: JSON, or with --format npy the array."""
    shared = session(context)
    with shared.client() as client:
        if shared.output.format is Format.NPY:
            shared.output.save(client.arrays.job_result(job))
            return
        answer = getattr(client, f"{client.job(job).kind}_result")(job)
    shared.output.tell(answer)


@jobs.command("cancel")
def cancel(
    context: typer.Context,
    job: JobArgument,
    finished: Annotated[Literal["keep", "remove"], typer.Option(help="What to do with a finished job.")] = "keep",
) -> None:
    """Cancel a job; a finished one is refused, or removed with --finished remove."""
    shared = session(context)
    with shared.client() as client:
        shared.tell_job(client.cancel_job(job, finished=finished))
