"""Commands about Denavit-Hartenberg tables."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.completion import CONVENTIONS, one_of, robots_beginning_with
from gelenk.cli.files.inputs import TABLE_SUFFIXES, fields_of, is_file, table_from
from gelenk.cli.files.outputs import AnswerRows, Format, largest
from gelenk.cli.session import (
    BaseOption,
    FieldsOption,
    RobotArgument,
    TipOption,
    draw,
    example_of,
    plot_option,
    session,
)
from gelenk.errors import InvalidField

if TYPE_CHECKING:
    from gelenk.client import Client
    from gelenk.contract.dh import DhTablePayload

TableArgument = Annotated[
    Path,
    typer.Argument(
        metavar="TABLE",
        help="DH table as JSON, TOML or CSV, or the name of a robot: that of its default chain.",
        autocompletion=robots_beginning_with,
    ),
]
ConventionOption = Annotated[str, typer.Option(help="standard or modified.", autocompletion=one_of(CONVENTIONS))]
_DIFFERENT = 1

dh = typer.Typer(name="dh", help="Denavit-Hartenberg tables: to and from URDF, compared, derived.")


def _table(client: "Client", given: Path) -> Any:
    """Return the table of a file, or of the robot that is named."""
    if is_file(given):
        return table_from(given)
    if given.exists() or given.suffix.lower() in TABLE_SUFFIXES or given.name != str(given):
        raise InvalidField("table", f"there is no file {str(given)!r} that ends in .json, .toml or .csv")
    return client.dh_table(str(given)).dh.model_dump(mode="json", exclude_none=True)


def _rows(dh: "DhTablePayload", notes: tuple[str, ...] = ()) -> AnswerRows:
    columns = ("name", "type", "a", "alpha", "d", "theta", "lower", "upper", "velocity", "effort")
    rows = [[getattr(row, column) for column in columns] for row in dh.joints]
    places = {"base": dh.base, "tool": dh.tool}
    written = [
        f"{name}: {pose.model_dump_json(exclude_unset=True)}" for name, pose in places.items() if pose is not None
    ]
    return AnswerRows(
        columns, rows, (f"{dh.convention} convention", *notes), (f"convention: {dh.convention}", *written)
    )


@dh.command("to-urdf", epilog=example_of("dh to-urdf"))
def to_urdf(
    context: typer.Context,
    table: TableArgument,
    name: Annotated[str, typer.Option(help="Name of the robot in the URDF.")] = "robot",
) -> None:
    """A table as URDF."""
    shared = session(context)
    with shared.client() as client:
        answer = client.dh_to_urdf(name=name, dh=_table(client, table))
    if shared.output.format is Format.JSON:
        shared.write(answer, AnswerRows((), ()))
    else:
        shared.output.put(answer.urdf.encode())


@dh.command("from-urdf", epilog=example_of("dh from-urdf"))
def from_urdf(
    context: typer.Context,
    robot: RobotArgument,
    convention: ConventionOption = "standard",
    base: BaseOption = None,
    tip: TipOption = None,
    snap: Annotated[
        float | None, typer.Option(help="Tolerance within which numbers are rounded to plain ones, [rad or m].")
    ] = None,
    plot: Annotated[Path | None, plot_option("frames")] = None,
) -> None:
    """A chain of a robot as a table, with its certificate."""
    shared = session(context)
    with shared.robot(robot) as (client, name):
        answer = client.dh_table(name, convention, base, tip, snap)  # type: ignore[arg-type]
        draw(client, plot, "v1/dh/picture", {"dh": answer.dh})
    shared.write(
        answer, _rows(answer.dh, (f"the table and the robot differ by {largest(answer.certificate)}", *answer.notes))
    )


@dh.command("convert", epilog=example_of("dh convert"))
def convert(context: typer.Context, table: TableArgument, convention: ConventionOption) -> None:
    """A table in the other convention."""
    shared = session(context)
    with shared.client() as client:
        answer = client.convert_dh(dh=_table(client, table), convention=convention)  # type: ignore[arg-type]
    shared.write(answer, _rows(answer.dh))


@dh.command("compare", epilog=example_of("dh compare"))
def compare(
    context: typer.Context,
    table: TableArgument,
    robot: RobotArgument,
    base: BaseOption = None,
    tip: TipOption = None,
    fields: FieldsOption = None,
) -> None:
    """Whether a table describes a chain; exit code 1 if not, with the first difference."""
    shared = session(context)
    with shared.robot(robot) as (client, name):
        body: dict[str, Any] = {"dh": _table(client, table), "robot": name, "base_frame": base, "tip_frame": tip}
        answer = client.compare_dh(**{**body, **fields_of(fields)})
    rows: list[tuple[str, Any]] = [
        ("equivalent", answer.equivalent),
        ("largest position error [m]", answer.max_position_error),
        ("largest orientation error [rad]", answer.max_orientation_error),
    ]
    notes = () if answer.first_difference is None else (str(answer.first_difference),)
    shared.write(answer, AnswerRows(("", "value"), rows, notes))
    if not answer.equivalent:
        raise typer.Exit(_DIFFERENT)


@dh.command("derive", epilog=example_of("dh derive"))
def derive(
    context: typer.Context,
    table: TableArgument,
    latex: Annotated[bool, typer.Option("--latex", help="As LaTeX.")] = False,
    symbolic: Annotated[
        bool, typer.Option("--symbols/--values", help="Keep lengths as symbols, or write them as numbers.")
    ] = True,
    plot: Annotated[Path | None, plot_option("frames")] = None,
    fields: FieldsOption = None,
) -> None:
    """The worked solution: each A_i and T_0_i, the Jacobian, and where it is singular."""
    shared = session(context)
    with shared.client() as client:
        dh = _table(client, table)
        answer = client.derive_dh(**{"dh": dh, "symbolic": symbolic, **fields_of(fields)})
        draw(client, plot, "v1/dh/picture", {"dh": dh})
    matrices = [*answer.A, *answer.T_0, *([answer.jacobian.matrix] if answer.jacobian else [])]
    if latex:
        rows = AnswerRows(("name", "formula"), [(one.name, one.latex) for one in matrices], answer.notes)
    else:
        lines = [
            (one.name if i == 0 else "", "  ".join(row)) for one in matrices for i, row in enumerate(one.plain or [])
        ]
        rows = AnswerRows(("name", "formula"), lines, answer.notes)
    shared.write(answer, rows)
