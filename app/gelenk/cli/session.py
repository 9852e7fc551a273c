"""The options that commands share: the service to call, and where the answer goes."""

import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar

import typer

from gelenk.cli.completion import frames_beginning_with, one_of, robots_beginning_with, scenes_beginning_with
from gelenk.cli.files.inputs import description_from, packages_of, pairs_of, robot_named
from gelenk.cli.files.outputs import AnswerRows, Output, picture_kind
from gelenk.cli.start import raised_interrupts
from gelenk.errors import InvalidField

if TYPE_CHECKING:
    from pydantic import BaseModel

    from gelenk.client import Client
    from gelenk.client.jobs import Job
    from gelenk.contract.jobs import JobInfo


A = TypeVar("A")

_LONG_SECONDS = 0.5
"""Work that takes less, [s], gets no progress bar."""
_COMPILING = "compiling the kernels{}: about a minute …"

RobotArgument = Annotated[
    str,
    typer.Argument(
        metavar="ROBOT",
        autocompletion=robots_beginning_with,
        help="A robot's name, or a file: URDF, xacro, MJCF, a zip of one with meshes, a DH table: JSON, TOML, CSV.",
    ),
]
BaseOption = Annotated[
    str | None,
    typer.Option(
        "--base",
        help="Frame in which poses are expressed; the default chain's if left out.",
        autocompletion=frames_beginning_with,
    ),
]
TipOption = Annotated[
    str | None,
    typer.Option(
        "--tip",
        help="Frame whose pose is computed; the default chain's if left out.",
        autocompletion=frames_beginning_with,
    ),
]
FromOption = Annotated[
    str | None, typer.Option("--from", help="File with one row for each, CSV, npy or JSON; - is standard input.")
]
SceneOption = Annotated[
    str | None,
    typer.Option(
        "--scene", help="Scene of the service in which nothing may touch.", autocompletion=scenes_beginning_with
    ),
]
ClearanceOption = Annotated[
    float | None,
    typer.Option("--min-clearance", help="Least distance from contact, also of the robot with itself, [m]."),
]
FieldsOption = Annotated[
    str | None,
    typer.Option("--fields", help="Further fields of the API as JSON, or a file with it; they override the options."),
]


def _with_server(context: typer.Context, is_later: bool) -> bool:
    if is_later and not session(context).server:
        raise InvalidField("job", "needs --server: without one the job would end with this command")
    return is_later


LaterOption = Annotated[
    bool,
    typer.Option(
        "--job",
        help="Start a job on the service and return at once instead of waiting for it.",
        callback=_with_server,
    ),
]


def word_option(words: Sequence[str]) -> Any:
    """Return an option that takes one of these words."""
    return typer.Option(help=f"One of {', '.join(words)}.", autocompletion=one_of(words))


def _of_known_kind(plot: Path | None) -> Path | None:
    if plot is not None:
        picture_kind(plot)  # before the work, not after it
    return plot


def cell_fields(scene: str | None, clearance: float | None) -> dict[str, Any]:
    """Return the fields of these options that are given."""
    given = {"scene": scene, "min_clearance": clearance}
    return {name: value for name, value in given.items() if value is not None}


def plot_option(what: str) -> Any:
    """Return an option that names the file for a picture of something."""
    return typer.Option(help=f"Draw the {what} into this file, SVG, PNG or PDF.", callback=_of_known_kind)


def draw(client: "Client", plot: Path | None, path: str, fields: Mapping[str, Any] | None = None) -> None:
    """Write the picture of an answer, if a file is named; for the other arguments see `picture` of the client."""
    if plot is not None:
        plot.write_bytes(client.picture(path, picture_kind(plot), fields))


@dataclass(frozen=True, slots=True)
class Session:
    """The options that all commands share; without a server, this process computes.

    `arguments` and `packages` are for xacro, `NAME=VALUE` and `NAME=FOLDER`; `strict` refuses a URDF also for faults
    that do not affect kinematics.
    """

    server: str | None = None
    output: Output = field(default_factory=Output)
    arguments: Sequence[str] = ()
    packages: Sequence[str] = ()
    strict: bool = False

    @property
    def describe(self) -> Callable[[Path], dict[str, Any]]:
        """Function that returns the robot of a file without meshes as the API takes it, `dh` or `urdf`."""
        arguments, packages = pairs_of(self.arguments, "arg"), packages_of(self.packages)
        return lambda file: description_from(file, arguments, packages, self.strict, self.note)

    def note(self, sentence: str) -> None:
        """Tell of an oddity of a file on standard error, unless quiet."""
        if not self.output.is_quiet:
            print(f"gelenk: {sentence}", file=sys.stderr)

    @contextmanager
    def client(self) -> Iterator["Client"]:
        """Open a client of the service, or of the application in this process."""
        # The client takes seconds to load: completion and --help need not wait for it.
        from gelenk.client import Client  # noqa: PLC0415

        with ExitStack() as stack:
            if not self.server:
                from gelenk.cli.local import InProcess  # noqa: PLC0415
                from gelenk.robot.compilation import STORE, when_compiling  # noqa: PLC0415

                if sys.stderr.isatty() and not self.output.is_quiet:
                    text = _COMPILING.format("" if STORE is None else ", once")
                    stack.enter_context(when_compiling(lambda: print(text, file=sys.stderr)))
            stack.enter_context(raised_interrupts())
            transport = None if self.server else InProcess()
            # In this process there is no name to look up, and no key to send.
            yield stack.enter_context(Client(self.server or "http://127.0.0.1", transport=transport))

    @contextmanager
    def robot(self, argument: str) -> Iterator[tuple["Client", str]]:
        """Open a client, and yield it with the name of the robot at the service."""
        describe = self.describe
        with (
            self.client() as client,
            robot_named(client, argument, describe, self.strict, pairs_of(self.arguments, "arg")) as name,
        ):
            yield client, name

    def write(self, answer: "BaseModel", rows: AnswerRows) -> None:
        """Write an answer of the API."""
        self.output.write(lambda: answer.model_dump_json(exclude_unset=True), rows)

    @contextmanager
    def bar(self, what: str, *, is_measured: bool = True) -> Iterator[Callable[[float], None]]:
        """Show progress from 0 to 1 once the work takes long; not if quiet, or if standard error is no terminal.

        Unless it is measured, the bar shows only that the work is running.
        """
        if self.output.is_quiet or not sys.stderr.isatty():  # whatever a variable such as FORCE_COLOR says of colours
            yield lambda _: None
            return
        # Loaded for people who wait at a terminal, and for nobody else.
        from rich.console import Console  # noqa: PLC0415
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn  # noqa: PLC0415

        share = (TextColumn("{task.percentage:>3.0f} %"),) if is_measured else ()
        columns = (TextColumn("{task.description}"), BarColumn(), *share, TimeElapsedColumn())
        shown = Progress(*columns, console=Console(stderr=True), transient=True)
        bar = shown.add_task(what, total=1.0 if is_measured else None)
        begin = threading.Timer(_LONG_SECONDS, shown.start)
        begin.start()
        try:
            yield lambda progress: shown.update(bar, completed=progress)
        finally:
            begin.cancel()
            begin.join()
            shown.stop()

    def result_of(self, job: "Job[A]") -> A:
        """Return the result of a job, and show its progress meanwhile."""
        with self.bar(job.info.kind) as progress:
            return job.result(lambda info: progress(info.progress))

    def tell_job(self, info: "JobInfo") -> None:
        """Write a job as an answer."""
        notes = () if info.error is None else (info.error.detail,)
        self.write(info, AnswerRows(JOB_COLUMNS, [job_row(info)], notes))


JOB_COLUMNS = ("id", "kind", "state", "progress", "created", "finished")


def job_row(info: "JobInfo") -> tuple[Any, ...]:
    """Return the cells of a job below `JOB_COLUMNS`."""
    return tuple(getattr(info, column) for column in JOB_COLUMNS)


def session(context: typer.Context) -> Session:
    """Return the session of a command."""
    found: Any = context.obj
    return found if isinstance(found, Session) else Session()


EXAMPLES = {
    "robots": "gelenk robots panda",
    "add": "gelenk add arm.urdf --name my_arm",
    "fk": "gelenk fk ur5 -q '0 -90deg pi/2 0 0 0' --pose rpy",
    "jacobian": "gelenk jacobian planar_2r -q '0.3 0.8'",
    "ik": "gelenk ik ur5 --to '0.4 0.2 0.5 pi 0 0' --all",
    "manipulability": "gelenk manipulability planar_2r -q '0.3 0.8' --plot ellipse.svg",
    "trajectory": "gelenk -o motion.csv trajectory planar_2r --start '0 0' --joint '0.5 0.2' --law cubic",
    "workspace": "gelenk -o points.npy workspace planar_2r --samples 10000 --plot reach.png",
    "exercises": "gelenk exercises mobility.linkage --seed 7",
    "sheet": "gelenk -o sheets.zip sheet mobility.linkage actuators.gear --class 20 --secret 'known to nobody else'",
    "grade": "gelenk grade answers.csv --secret 'known to nobody else'",
    "bench": "gelenk bench planar_2r --batch 100 --seconds 0.1",
    "ask": 'gelenk ask gear \'{"efficiency": 0.9, "ratio": 50}\'',
    "dh to-urdf": "gelenk -o arm.urdf dh to-urdf table.csv --name my_arm",
    "dh from-urdf": "gelenk -o table.csv dh from-urdf ur5 --convention modified",
    "dh convert": "gelenk dh convert table.csv --convention modified",
    "dh compare": "gelenk dh compare table.csv ur5",
    "dh derive": "gelenk dh derive planar_2r --latex --plot frames.svg",
}
"""Examples by command. Commands that read files use those that other examples have written."""


def example_of(command: str) -> str | None:
    """Return the example shown below the options of a command."""
    return f"\b\nExample:\n  {EXAMPLES[command]}" if command in EXAMPLES else None
