"""Commands about a robot's chain: forward and inverse kinematics, the Jacobian, manipulability."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.batches import in_calls
from gelenk.cli.completion import METHODS, REFERENCES, REPRESENTATIONS, one_of
from gelenk.cli.files.inputs import fields_of
from gelenk.cli.files.outputs import AnswerRows, largest
from gelenk.cli.files.rows import AXES, ORIENTATIONS, PENDANTS, InputRows, numbers_of, rows_of
from gelenk.cli.session import (
    BaseOption,
    ClearanceOption,
    FieldsOption,
    FromOption,
    LaterOption,
    RobotArgument,
    SceneOption,
    Session,
    TipOption,
    cell_fields,
    draw,
    plot_option,
    session,
    word_option,
)
from gelenk.errors import InvalidField

if TYPE_CHECKING:
    from gelenk.client import Client
    from gelenk.contract.fk import ForwardAnswer
    from gelenk.contract.ik import InverseAnswer
    from gelenk.contract.jacobian import JacobianAnswer
    from gelenk.contract.manipulability import ManipulabilityAnswer

QOption = Annotated[
    list[str] | None,
    typer.Option(
        "-q", "--at", help="A configuration: one number per joint, [rad] or [m], separated by commas or blanks."
    ),
]
_POSES = {notation: (*AXES, *columns) for notation, columns in ORIENTATIONS.items()} | PENDANTS
"""Columns of a pose by its notation."""
_DEFAULT_POSE = "quaternion_xyzw"
_TARGETS_FIRST = 50
"""Targets of the first call: an unreachable target takes a thousand times as long as a reachable one."""
UNREACHED = 1
"""Exit code if a target cannot be reached, or a motion cannot be completed."""


def fk(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    pose_format: Annotated[
        str,
        typer.Option("--pose", help=f"Notation: {', '.join(_POSES)}.", autocompletion=one_of(tuple(_POSES))),
    ] = _DEFAULT_POSE,
    fields: FieldsOption = None,
) -> None:
    """Forward kinematics: the pose of the tip at each configuration."""
    if pose_format not in _POSES:
        raise InvalidField("pose", f"must be one of {', '.join(_POSES)}")
    shared, given = session(context), rows_of(at or [], file, "joint_positions")
    body = {"base_frame": base, "tip_frame": tip, "pose_format": pose_format, **fields_of(fields)}
    answer: ForwardAnswer = _answer_at(shared, robot, "fk", given, body)
    place = slice(0 if pose_format in PENDANTS else len(AXES))  # a pendant's notation has it
    rows = [[*pose.position[place], *getattr(pose, pose_format)] for pose in answer.poses]
    note = f"T of {answer.tip_frame} in {answer.base_frame}; Pinocchio's differ by {largest(answer.certificate)}"
    shared.write(answer, AnswerRows(_POSES[pose_format], rows, (note,)))


def joint_names_of(client: "Client", robot: str, body: Mapping[str, Any]) -> list[str]:
    """Return the joints of the chain that a request is about, base to tip."""
    ends = {end: body[end] for end in ("base_frame", "tip_frame")}
    return client.fk(robot, joint_positions=[], **ends).joint_names


def _answer_at(
    shared: Session, robot: str, operation: str, given: InputRows, body: dict[str, Any], plot: Path | None = None
) -> Any:
    """Return what an operation answers at the given configurations, unless the fields of its request have others."""
    if shared.server is None and plot is None and not given.header:
        from gelenk.cli.light.quick import quick_answer  # noqa: PLC0415 - not for a call of a service

        fields = {"joint_positions": given.configurations(list), **body}
        if (found := quick_answer(operation, robot, fields)) is not None:
            return found
    with shared.robot(robot) as (client, name):
        body = {"joint_positions": given.configurations(lambda: joint_names_of(client, name, body)), **body}
        with shared.bar(operation) as progress:
            answer = in_calls(partial(getattr(client, operation), name), body, "joint_positions", progress)
        draw(client, plot, f"v1/robots/{name}/{operation}", body)
    return answer


def jacobian(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    reference: Annotated[str, word_option(REFERENCES)] = REFERENCES[0],
    representation: Annotated[str, word_option(REPRESENTATIONS)] = REPRESENTATIONS[0],
    fields: FieldsOption = None,
) -> None:
    """The Jacobian at each configuration: rows linear, then angular."""
    shared, given = session(context), rows_of(at or [], file, "joint_positions")
    body = {"base_frame": base, "tip_frame": tip, "reference": reference, "representation": representation}
    answer: JacobianAnswer = _answer_at(shared, robot, "jacobian", given, {**body, **fields_of(fields)})
    parts = [*(f"v_{axis}" for axis in AXES), *(f"w_{axis}" for axis in AXES)]
    rows = [
        (index, part, *row)
        for index, matrix in enumerate(answer.jacobians)
        for part, row in zip(parts, matrix, strict=True)
    ]
    notes = [
        f"{index}: rank {rank}, condition number {'none' if condition is None else f'{condition:.6g}'}"
        for index, (rank, condition) in enumerate(zip(answer.ranks, answer.condition_numbers, strict=True))
    ]
    columns = ("configuration", "row", *answer.joint_names)
    shared.write(answer, AnswerRows(columns, rows, notes[:20], array=answer.jacobians))


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
    method: Annotated[str, word_option(METHODS)] = METHODS[0],
    every: Annotated[bool, typer.Option("--all", help="Find all solutions, not just one.")] = False,
    seed: Annotated[str | None, typer.Option(help="Configuration to start at.")] = None,
    task: Annotated[str | None, typer.Option(help="Directions that count, such as x,y,z,rx,ry.")] = None,
    free: Annotated[bool, typer.Option("--ignore-limits", help="Allow solutions beyond the joint limits.")] = False,
    scene: SceneOption = None,
    clearance: ClearanceOption = None,
    fields: FieldsOption = None,
    later: LaterOption = False,
) -> None:
    """Inverse kinematics: configurations that bring the tip to each target; exit code 1 if a target has none."""
    shared, given = session(context), rows_of(target or [], file, "targets")
    body: dict[str, Any] = {"targets": given.targets(position_suffices=task is not None)}
    body |= {"base_frame": base, "tip_frame": tip, "method": method, "respect_limits": not free}
    body["solutions"] = "all" if every else "one"
    if task is not None:
        body["task"] = task.replace(",", " ").split()
    if seed is not None:
        body["seeds"] = [numbers_of(seed, "seeds")]
    body |= cell_fields(scene, clearance) | fields_of(fields)
    with shared.robot(robot) as (client, name):
        if later:
            shared.tell_job(client.jobs.ik(name, **body).info)
            return
        with shared.bar("ik") as progress:
            answer = in_calls(partial(client.ik, name), body, "targets", progress, first=_TARGETS_FIRST)
    shared.write(answer, _solutions(answer))
    if any(result.status != "solved" for result in answer.results):
        raise typer.Exit(UNREACHED)


def _solutions(answer: "InverseAnswer") -> AnswerRows:
    is_in_cell = answer.certificate is not None
    columns = ("target", "status", *answer.joint_names, "position error", "orientation error")
    rows: list[tuple[Any, ...]] = []
    for index, result in enumerate(answer.results):
        found: list[Any] = [*result.solutions] or [result.nearest]
        for one in found:
            status = "in_collision" if getattr(one, "in_collision", False) else result.status
            about = one.position_error, one.orientation_error, *([one.clearance] if is_in_cell else [])
            rows.append((index, status, *one.joint_positions, *about))
    columns += ("clearance",) if is_in_cell else ()
    reasons = [f"{index}: {result.reason}" for index, result in enumerate(answer.results) if result.reason]
    # As in the API's npy: for each target a solution, or the nearest configuration.
    first = [result.solutions[0] if result.solutions else result.nearest for result in answer.results]
    array = [one.joint_positions for one in first if one is not None]
    return AnswerRows(columns, rows, reasons[:20], array=array if len(array) == len(first) == len(rows) else None)


def manipulability(
    context: typer.Context,
    robot: RobotArgument,
    at: QOption = None,
    file: FromOption = None,
    base: BaseOption = None,
    tip: TipOption = None,
    plot: Annotated[Path | None, plot_option("ellipsoids")] = None,
    fields: FieldsOption = None,
) -> None:
    """How well the tip can move and push at each configuration."""
    shared, given = session(context), rows_of(at or [], file, "joint_positions")
    body = {"base_frame": base, "tip_frame": tip, **fields_of(fields)}
    answer: ManipulabilityAnswer = _answer_at(shared, robot, "manipulability", given, body, plot)
    rows = []
    for index, result in enumerate(answer.results):
        for part, info in (("translation", result.translation), ("rotation", result.rotation)):
            if info is not None:
                rows.append((index, part, info.measure, info.condition_number, info.isotropy, info.rank))
    shared.write(answer, AnswerRows(("configuration", "part", "measure", "condition number", "isotropy", "rank"), rows))
