"""Commands about a robot: where it is, how it gets there, how it moves."""

import json
from collections.abc import Sequence
from itertools import chain
from pathlib import Path
from typing import Annotated, Any

import typer

from app.cli.inputs import rows_of
from app.cli.outputs import Format, Rows, picture_kind
from app.cli.session import BaseOption, FromOption, RobotArgument, TipOption, session
from app.model.errors import InvalidField, JobFailed
from app.schemas.ik import InverseAnswer, NearestInfo, SolutionInfo
from app.schemas.pose import Pose
from app.schemas.robots import RobotInfo

QOption = Annotated[
    list[str] | None,
    typer.Option("-q", "--at", help="A configuration: a number a joint, [rad] or [m], between commas or blanks."),
]
_AXES = ("x", "y", "z")
_POSE_COLUMNS = {
    "quaternion_xyzw": ("qx", "qy", "qz", "qw"),
    "quaternion_wxyz": ("qw", "qx", "qy", "qz"),
    "rpy": ("roll", "pitch", "yaw"),
    "zyz": ("phi", "theta", "psi"),
    "rotation_vector": ("rx", "ry", "rz"),
}
_DEFAULT_POSE = "quaternion_xyzw"
_UNREACHED = 1


def robots(
    context: typer.Context,
    robot: Annotated[str | None, typer.Argument(help="One of them, or a file: tells its joints.")] = None,
    urdf: Annotated[bool, typer.Option("--urdf", help="Its URDF instead.")] = False,
) -> None:
    """List the robots, or tell about one."""
    shared = session(context)
    if robot is None:
        with shared.client() as client:
            answer = client.robots()
        rows = [(one.name, one.source, one.format, one.description) for one in answer.robots]
        shared.write(answer, Rows(("name", "source", "format", "description"), rows))
        return
    with shared.robot(robot) as (client, name):
        if urdf:
            typer.echo(client.urdf(name), nl=False)
            return
        info = client.robot(name)
    shared.write(info, _joints(info))


def _joints(info: RobotInfo) -> Rows:
    columns = ("joint", "type", "parent", "child", "lower", "upper", "velocity", "effort")
    rows = [
        (
            *(joint.name, joint.type, joint.parent, joint.child),
            *(joint.limits.lower, joint.limits.upper, joint.limits.velocity, joint.limits.effort),
        )
        for joint in info.joints
    ]
    ends = info.default_chain
    about = f"default chain {ends.base_frame} → {ends.tip_frame}: {', '.join(info.joint_names)}"
    return Rows(columns, rows, (about, *info.warnings))


def fk(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    pose_format: Annotated[str, typer.Option("--pose", help=f"Notation: {', '.join(_POSE_COLUMNS)}.")] = _DEFAULT_POSE,
) -> None:
    """Forward kinematics: the pose of the tip at each configuration."""
    if pose_format not in _POSE_COLUMNS:
        raise InvalidField("pose", f"must be one of {', '.join(_POSE_COLUMNS)}")
    shared, qs = session(context), rows_of(at or [], file, "joint_positions")
    fields: dict[str, Any] = {"base_frame": base, "tip_frame": tip, "pose_format": pose_format}
    with shared.robot(robot) as (client, name):
        answer = client.fk(name, joint_positions=qs.tolist(), **fields)
    rows = [_pose_row(pose, pose_format) for pose in answer.poses]
    note = f"T of {answer.tip_frame} in {answer.base_frame}; {_certificate(answer.certificate)}"
    shared.write(answer, Rows((*_AXES, *_POSE_COLUMNS[pose_format]), rows, (note,)))


def _pose_row(pose: Pose, pose_format: str) -> list[float]:
    return [*(pose.position or ()), *getattr(pose, pose_format)]


def _certificate(certificate: Any) -> str:
    return (
        f"Pinocchio's differ by {certificate.max_position_error:.1e} m and "
        f"{certificate.max_orientation_error:.1e} rad at most"
    )


def jacobian(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    reference: Annotated[str, typer.Option(help="local_world_aligned, local or world.")] = "local_world_aligned",
    representation: Annotated[str, typer.Option(help="geometric, zyz or rpy.")] = "geometric",
) -> None:
    """The Jacobian at each configuration: rows linear, then angular."""
    shared, qs = session(context), rows_of(at or [], file, "joint_positions")
    fields: dict[str, Any] = {"base_frame": base, "tip_frame": tip, "reference": reference}
    with shared.robot(robot) as (client, name):
        answer = client.jacobian(name, joint_positions=qs.tolist(), representation=representation, **fields)  # type: ignore[arg-type]
    parts = [*(f"v_{axis}" for axis in _AXES), *(f"w_{axis}" for axis in _AXES)]
    rows = [
        (index, part, *row)
        for index, matrix in enumerate(answer.jacobians)
        for part, row in zip(parts, matrix, strict=True)
    ]
    notes = [
        f"{index}: rank {rank}, condition number {'none' if condition is None else f'{condition:.6g}'}"
        for index, (rank, condition) in enumerate(zip(answer.ranks, answer.condition_numbers, strict=True))
    ]
    shared.write(answer, Rows(("configuration", "row", *answer.joint_names), rows, notes[:20]))


def ik(
    context: typer.Context,
    robot: RobotArgument,
    target: Annotated[
        list[str] | None,
        typer.Option("-t", "--to", help="A target: x y z, then roll pitch yaw or a quaternion x y z w."),
    ] = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    method: Annotated[str, typer.Option(help="auto, analytic, newton, gradient, …")] = "auto",
    every: Annotated[bool, typer.Option("--all", help="All solutions, not only one.")] = False,
    seed: Annotated[str | None, typer.Option(help="Configuration to start at.")] = None,
    task: Annotated[str | None, typer.Option(help="Directions that count, such as x,y,z,rx,ry.")] = None,
    free: Annotated[bool, typer.Option("--ignore-limits", help="Whether solutions may exceed joint limits.")] = False,
) -> None:
    """Inverse kinematics: configurations that bring the tip to each target; exit code 1 if there is none for one."""
    shared, numbers = session(context), rows_of(target or [], file, "targets")
    fields: dict[str, Any] = {"base_frame": base, "tip_frame": tip, "method": method, "respect_limits": not free}
    fields["solutions"] = "all" if every else "one"
    if task is not None:
        fields["task"] = task.replace(",", " ").split()
    if seed is not None:
        fields["seeds"] = rows_of([seed], None, "seeds").tolist()
    with shared.robot(robot) as (client, name):
        answer = client.ik(name, targets=[_target(row, task is not None) for row in numbers.tolist()], **fields)
    shared.write(answer, _solutions(answer))
    if any(not result.solutions for result in answer.results):
        raise typer.Exit(_UNREACHED)


def _target(row: Sequence[float], position_suffices: bool) -> Pose:
    position = [float(value) for value in row[:3]]
    match len(row):
        case 3 if position_suffices:
            return Pose(position=position, quaternion_xyzw=[0.0, 0.0, 0.0, 1.0])
        case 6:
            return Pose(position=position, rpy=list(row[3:]))
        case 7:
            return Pose(position=position, quaternion_xyzw=list(row[3:]))
        case 16:
            return Pose(matrix=[list(row[4 * i : 4 * i + 4]) for i in range(4)])
    raise InvalidField(
        "targets",
        f"a target has {len(row)} numbers; allowed are 6 (x y z roll pitch yaw), 7 (with a quaternion x y z w), 16 (a "
        "matrix by rows), and with --task 3",
    )


def _solutions(answer: InverseAnswer) -> Rows:
    columns = ("target", "status", *answer.joint_names, "position error", "orientation error")
    rows: list[tuple[Any, ...]] = []
    for index, result in enumerate(answer.results):
        found: list[SolutionInfo | NearestInfo] = [*result.solutions]
        if result.nearest is not None:
            found = [result.nearest]
        rows += [
            (index, result.status, *one.joint_positions, one.position_error, one.orientation_error) for one in found
        ]
    reasons = [f"{index}: {result.reason}" for index, result in enumerate(answer.results) if result.reason]
    return Rows(columns, rows, reasons[:20])


def manipulability(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
) -> None:
    """How well the tip can move and push at each configuration."""
    shared, qs = session(context), rows_of(at or [], file, "joint_positions")
    fields: dict[str, Any] = {"base_frame": base, "tip_frame": tip}
    with shared.robot(robot) as (client, name):
        answer = client.manipulability(name, joint_positions=qs.tolist(), **fields)
    rows = []
    for index, result in enumerate(answer.results):
        for part, info in (("translation", result.translation), ("rotation", result.rotation)):
            if info is not None:
                rows.append((index, part, info.measure, info.condition_number, info.isotropy, info.rank))
    shared.write(answer, Rows(("configuration", "part", "measure", "condition number", "isotropy", "rank"), rows))


def trajectory(
    context: typer.Context,
    robot: RobotArgument,
    start: Annotated[str, typer.Option("--start", help="The configuration that it begins at.")],
    joint: Annotated[list[str] | None, typer.Option("--joint", help="Go there by the joints: a configuration.")] = None,
    line: Annotated[list[str] | None, typer.Option("--line", help="Go there straight: a pose.")] = None,
    motion: Annotated[
        Path | None, typer.Option("--motion", help="JSON file with segments and all else, in place of these.")
    ] = None,
    base: BaseOption = None,
    tip: TipOption = None,
    law: Annotated[str, typer.Option(help="trapezoidal, cubic, quintic, time_optimal, …")] = "trapezoidal",
    period: Annotated[float, typer.Option(help="Between samples, [s].")] = 0.01,
    plot: Annotated[Path | None, typer.Option(help="Draw the profiles into this file, SVG or PNG.")] = None,
) -> None:
    """A motion through configurations and poses, joints first; exit code 1 if it cannot be done to its end."""
    shared = session(context)
    fields = _motion(start, joint or [], line or [], motion)
    fields = {"base_frame": base, "tip_frame": tip, "law": law, "sample_period": period, **fields}
    with shared.robot(robot) as (client, name):
        answer = client.trajectory(name, **fields)
        if plot is not None:
            plot.write_bytes(client.picture(f"v1/robots/{name}/trajectory", picture_kind(plot), fields))
    names = answer.joint_names
    columns = ("t", *names, *(f"d {name}" for name in names), *(f"dd {name}" for name in names))
    table = zip(
        *(answer.times, answer.joint_positions, answer.joint_velocities, answer.joint_accelerations), strict=True
    )
    rows = [(time, *chain(*values)) for time, *values in table]
    notes = [f"{answer.duration:.6g} s, {answer.completed_fraction:.0%} of it can be done"]
    if answer.failure is not None:
        notes.append(answer.failure.detail)
    shared.write(answer, Rows(columns, rows, (*notes, *answer.notes)))
    if answer.failure is not None:
        raise typer.Exit(_UNREACHED)


def _motion(start: str, joint: list[str], line: list[str], file: Path | None) -> dict[str, Any]:
    q = rows_of([start], None, "start")[0].tolist()
    if file is not None:
        return {"start": q, **json.loads(file.read_text(encoding="utf-8"))}
    segments: list[dict[str, Any]] = [
        {"type": "joint", "target": row} for text in joint for row in rows_of([text], None, "joint").tolist()
    ]
    segments += [
        {"type": "line", "target": _target(row, False)}
        for text in line
        for row in rows_of([text], None, "line").tolist()
    ]
    return {"start": q, "segments": segments}


def workspace(
    context: typer.Context,
    robot: RobotArgument,
    samples: Annotated[int, typer.Option(help="How many configurations.")] = 100_000,
    kind: Annotated[str, typer.Option(help="cloud, grid or dexterity.")] = "cloud",
    base: BaseOption = None,
    tip: TipOption = None,
    plot: Annotated[Path | None, typer.Option(help="Draw it into this file, SVG or PNG.")] = None,
) -> None:
    """What the tip can reach: points as CSV or npy, a summary otherwise."""
    shared = session(context)
    fields: dict[str, Any] = {"samples": samples, "kind": kind, "base_frame": base, "tip_frame": tip}
    with shared.robot(robot) as (client, name):
        job = shared.wait(client, client.workspace(name, **fields))
        if job.state != "succeeded":
            raise JobFailed(job.error.detail if job.error else f"the job is {job.state}")
        answer = client.workspace_result(job.id)
        wants_points = shared.output.format in {Format.CSV, Format.NPY}
        points = client.arrays.job_result(job.id).tolist() if wants_points else []
        if plot is not None:
            plot.write_bytes(client.picture(f"v1/jobs/{job.id}/result", picture_kind(plot)))
        client.cancel_job(job.id)
    if wants_points:
        shared.write(answer, Rows(answer.array.columns, points))
        return
    box, reach = answer.bounding_box, answer.reach
    rows: list[tuple[str, Any]] = [("samples", answer.samples_counted), ("volume [m³]", answer.voxels.volume)]
    if box is not None and reach is not None:
        rows += [("lower [m]", _vector(box.lower)), ("upper [m]", _vector(box.upper))]
        rows += [("reach [m]", f"{reach.min:.6f} … {reach.max:.6f}")]
    rows.append(("best measure", answer.measure.max))
    shared.write(answer, Rows(("", "value"), rows, answer.notes))


def _vector(values: Sequence[float]) -> str:
    return " ".join(f"{value:.6f}" for value in values)
