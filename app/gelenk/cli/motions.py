"""Commands that may take long: motions of a robot, and the workspace that it reaches."""

from collections.abc import Sequence
from itertools import chain
from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from gelenk.cli.arms import UNREACHED, joint_names_of
from gelenk.cli.completion import LAWS, WORKSPACES, one_of
from gelenk.cli.files.inputs import fields_of
from gelenk.cli.files.outputs import AnswerRows, Format, check_place
from gelenk.cli.files.rows import numbers_of, rows_of, target_of
from gelenk.cli.session import (
    BaseOption,
    ClearanceOption,
    FieldsOption,
    LaterOption,
    RobotArgument,
    SceneOption,
    TipOption,
    cell_fields,
    draw,
    plot_option,
    session,
    word_option,
)
from gelenk.errors import InvalidField

_AXES = ("rx", "ry", "rz")


def trajectory(
    context: typer.Context,
    robot: RobotArgument,
    start: Annotated[
        str | None, typer.Option("--start", help="Start configuration; not with a motion out of a running one.")
    ] = None,
    joint: Annotated[list[str] | None, typer.Option("--joint", help="Move the joints to a configuration.")] = None,
    line: Annotated[list[str] | None, typer.Option("--line", help="Go there straight: a pose.")] = None,
    path: Annotated[
        str | None,
        typer.Option(help="Lead the tool through the poses in a file, `-` for stdin: CSV, npy or JSON."),
    ] = None,
    waypoints: Annotated[
        str | None,
        typer.Option(
            help="Lead the joints along a spline through the configurations in a file, the first the start unless "
            "--start is given; `-` for stdin: CSV, npy or JSON."
        ),
    ] = None,
    free: Annotated[
        str | None,
        typer.Option(help="Axis about which that tool may turn: rx, ry, rz.", autocompletion=one_of(_AXES)),
    ] = None,
    motion: Annotated[
        str | None,
        typer.Option("--motion", help="Segments and all other fields as in the API: JSON, or a file with it."),
    ] = None,
    base: BaseOption = None,
    tip: TipOption = None,
    law: Annotated[str, word_option(LAWS)] = LAWS[0],
    period: Annotated[float, typer.Option(help="Between samples, [s].")] = 0.01,
    scene: SceneOption = None,
    clearance: ClearanceOption = None,
    plot: Annotated[Path | None, plot_option("profiles")] = None,
    program: Annotated[Path | None, typer.Option(help="Write it for ROS (.yaml, .json) or a UR (.script).")] = None,
    later: LaterOption = False,
) -> None:
    """A motion through configurations and poses, joints first, or of a tool; exit code 1 if it cannot be completed."""
    shared, fields = session(context), _motion(start, joint or [], line or [], motion, path, free, waypoints)
    around = cell_fields(scene, clearance)
    fields = {"base_frame": base, "tip_frame": tip, "law": law, "sample_period": period, **around, **fields}
    kind = None if program is None else _program_kind(program)
    through = None if waypoints is None else rows_of([], waypoints, "waypoints")
    with shared.robot(robot) as (client, name):
        if through is not None:
            fields |= _spline(through.configurations(lambda: joint_names_of(client, name, fields)), start)
        if later:
            shared.tell_job(client.jobs.trajectory(name, **fields).info)
            return
        with shared.bar("trajectory", is_measured=False):
            answer = client.trajectory(name, **fields)
            draw(client, plot, f"v1/robots/{name}/trajectory", fields)
            if program is not None and kind is not None:
                program.write_bytes(client.picture(f"v1/robots/{name}/trajectory", kind, fields))
    names = answer.joint_names
    columns = ("t", *names, *(f"d {name}" for name in names), *(f"dd {name}" for name in names))
    table = zip(
        *(answer.times, answer.joint_positions, answer.joint_velocities, answer.joint_accelerations), strict=True
    )
    rows = [(time, *chain(*values)) for time, *values in table]
    notes = [f"{answer.duration:.6g} s, {answer.completed_fraction:.0%} of it can be done"]
    if (clearance_found := answer.audit.clearance) is not None and clearance_found.value is not None:
        notes.append(f"clearance {clearance_found.value:.6g} m at {clearance_found.time:.6g} s")
    if answer.failure is not None:
        notes.append(answer.failure.detail)
    shared.write(answer, AnswerRows(columns, rows, (*notes, *answer.notes)))
    if answer.failure is not None:
        raise typer.Exit(UNREACHED)


def _program_kind(file: Path) -> Literal["joint_trajectory", "yaml", "urscript"]:
    """Return the format that a file's suffix asks for; raises OSError as `check_place` does."""
    check_place(file)
    match file.suffix.lower():
        case ".yaml":
            return "yaml"
        case ".json":
            return "joint_trajectory"
        case ".script":
            return "urscript"
    raise InvalidField("program", f"{file.name!r} must end in .yaml, .json or .script")


def _motion(
    start: str | None,
    joint: list[str],
    line: list[str],
    motion: str | None,
    path: str | None,
    free: str | None,
    waypoints: str | None,
) -> dict[str, Any]:
    if free is not None and path is None:
        raise InvalidField("free", "is for the tool that --path leads: give that too, or `path` in --motion")
    first = {} if start is None else {"start": numbers_of(start, "start")}
    whole = [name for name, one in (("motion", motion), ("path", path), ("waypoints", waypoints)) if one is not None]
    if whole and (joint or line or len(whole) > 1):
        raise InvalidField(whole[0], "leads all the way: give no --joint, no --line and no other beside it")
    if waypoints is not None:
        return first
    if motion is not None:
        return first | fields_of(motion)
    if path is not None:
        poses = rows_of([], path, "poses").targets(position_suffices=False)
        return {**first, "path": {"poses": poses, "free": [] if free is None else [free]}}
    segments: list[dict[str, Any]] = [{"type": "joint", "target": numbers_of(text, "joint")} for text in joint]
    segments += [{"type": "line", "target": target_of(numbers_of(text, "line"), False)} for text in line]
    if not segments:
        raise InvalidField(
            "segments", "none are given: --joint, --line, --path, --waypoints, or --motion with all of them"
        )
    if start is None:
        raise InvalidField("start", "where the motion begins: --start, or `start` or `at` in --motion")
    return {**first, "segments": segments}


def _spline(configurations: list[Any], start: str | None) -> dict[str, Any]:
    """Return the fields of a motion through configurations; raises InvalidField if there is nowhere to go."""
    first, rest = ({}, configurations) if start is not None else ({"start": configurations[0]}, configurations[1:])
    if not rest:
        raise InvalidField("waypoints", "a start alone is no motion: give at least one more row")
    return {**first, "segments": [{"type": "spline", "waypoints": rest}]}


def workspace(
    context: typer.Context,
    robot: RobotArgument,
    samples: Annotated[int, typer.Option(help="How many configurations.")] = 100_000,
    kind: Annotated[str, word_option(WORKSPACES)] = WORKSPACES[0],
    base: BaseOption = None,
    tip: TipOption = None,
    plot: Annotated[Path | None, plot_option("picture")] = None,
    fields: FieldsOption = None,
    later: LaterOption = False,
) -> None:
    """What the tip can reach: points as CSV or npy, a summary otherwise."""
    shared = session(context)
    body: dict[str, Any] = {"samples": samples, "kind": kind, "base_frame": base, "tip_frame": tip, **fields_of(fields)}
    with shared.robot(robot) as (client, name):
        job = client.jobs.workspace(name, **body)
        if later:
            shared.tell_job(job.info)
            return
        with job:
            answer = shared.result_of(job)
            wants_points = shared.output.format in {Format.CSV, Format.NPY}
            points = job.array().tolist() if wants_points else []
            draw(client, plot, f"v1/jobs/{job.id}/result")
    if wants_points:
        shared.write(answer, AnswerRows(answer.array.columns, points))
        return
    box, reach = answer.bounding_box, answer.reach
    rows: list[tuple[str, Any]] = [("samples", answer.samples_counted), ("volume [m³]", answer.voxels.volume)]
    if box is not None and reach is not None:
        rows += [("lower [m]", _vector(box.lower)), ("upper [m]", _vector(box.upper))]
        rows += [("reach [m]", f"{reach.min:.6f} … {reach.max:.6f}")]
    rows.append(("best measure", answer.measure.max))
    shared.write(answer, AnswerRows(("", "value"), rows, answer.notes))


def _vector(values: Sequence[float]) -> str:
    return " ".join(f"{value:.6f}" for value in values)
