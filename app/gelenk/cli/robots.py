"""Commands about the robots and the scenes of the service."""

from dataclasses import replace as replaced
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.completion import robots_beginning_with, scenes_beginning_with
from gelenk.cli.files.inputs import fields_of, is_file, name_of, pairs_of
from gelenk.cli.files.outputs import AnswerRows
from gelenk.cli.session import BaseOption, TipOption, session
from gelenk.errors import InvalidField, UnknownScene

if TYPE_CHECKING:
    from gelenk.client.client import Client
    from gelenk.contract.robots import RobotInfo

_FORMS = ("urdf", "mjcf", "screws", "csv", "latex", "matlab", "roboticstoolbox")


def robots(
    context: typer.Context,
    robot: Annotated[
        str | None,
        typer.Argument(help="A robot's name or a file: shows its joints.", autocompletion=robots_beginning_with),
    ] = None,
    urdf: Annotated[bool, typer.Option("--urdf", help="Its URDF instead.")] = False,
    written: Annotated[
        str | None,
        typer.Option("--as", help=f"Its description, or a chain of it, in another form: {', '.join(_FORMS)}."),
    ] = None,
    base: BaseOption = None,
    tip: TipOption = None,
) -> None:
    """List the robots, or show one."""
    shared = session(context)
    form = "urdf" if urdf else written
    if form is not None and robot is None:
        raise InvalidField("as", "is a form of one robot: name it")
    if form not in (None, *_FORMS):
        raise InvalidField("as", f"must be one of {', '.join(_FORMS)}")
    if robot is None:
        with shared.client() as client:
            answer = client.robots()
        rows = [
            (one.name, one.maker or "", one.kind or "", one.source, one.format, one.description)
            for one in answer.robots
        ]
        shared.write(answer, AnswerRows(("name", "maker", "kind", "source", "format", "description"), rows))
        return
    with shared.robot(robot) as (client, name):
        if form is not None:
            shared.output.put(_in_form(client, name, form, {"base_frame": base, "tip_frame": tip}))
            return
        info = client.robot(name)
    shared.write(info, _joints(info))


def _in_form(client: "Client", name: str, form: str, ends: dict[str, str | None]) -> bytes:
    if form in ("urdf", "mjcf"):
        text = client.urdf(name) if form == "urdf" else client.mjcf(name)
        return text.encode()
    if form == "screws":
        return client.screws(name, **ends).model_dump_json(indent=2).encode() + b"\n"
    return client.dh_file(name, format=form, **ends).encode()  # type: ignore[arg-type]


def _joints(info: "RobotInfo") -> AnswerRows:
    columns = ("joint", "type", "parent", "child", "lower", "upper", "velocity", "effort")
    rows = [
        [joint.name, joint.type, joint.parent, joint.child, *(getattr(joint.limits, limit) for limit in columns[4:])]
        for joint in info.joints
    ]
    ends = info.default_chain
    about = f"default chain {ends.base_frame} → {ends.tip_frame}: {', '.join(info.joint_names)}"
    return AnswerRows(columns, rows, (about, *info.warnings))


def add(
    context: typer.Context,
    file: Annotated[
        Path, typer.Argument(help="URDF, xacro, MJCF, a zip of one of them and its meshes, or a DH table.")
    ],
    name: Annotated[str | None, typer.Option(help="Name of the robot; the file's name if left out.")] = None,
    description: Annotated[str, typer.Option(help="A line about it.")] = "",
    base: BaseOption = None,
    tip: TipOption = None,
    replace: Annotated[bool, typer.Option("--replace", help="Replace the uploaded robot of that name.")] = False,
    wanted: Annotated[str | None, typer.Option("--file", help="Which description of a zip.")] = None,
    argument: Annotated[list[str] | None, typer.Option(help="Of a xacro: NAME=VALUE.")] = None,
) -> None:
    """Add a robot to the service; without --server it is only checked."""
    if not is_file(file):
        raise InvalidField("file", f"there is no file {str(file)!r} that a robot can be in")
    if (base is None) != (tip is None):
        raise InvalidField("base" if base is None else "tip", "a default chain has two ends: give --base and --tip")
    from gelenk.contract.common import ChainEnds  # noqa: PLC0415 - takes seconds to load

    ends = None if base is None or tip is None else ChainEnds(base_frame=base, tip_frame=tip)
    shared, name = session(context), name or name_of(file)
    shared = replaced(shared, arguments=(*shared.arguments, *(argument or ())))
    about: dict[str, Any] = {"description": description, **({} if ends is None else {"default_chain": ends})}
    with shared.client() as client:
        if file.suffix.lower() == ".zip":
            send = client.replace_archive if replace else client.add_archive
            info = send(
                name, file, **about, strict=shared.strict, file=wanted, arguments=pairs_of(shared.arguments, "arg")
            )
        else:
            body = {**about, **shared.describe(file)}
            info = client.replace_robot(name, **body) if replace else client.add_robot(name=name, **body)
    shared.write(info, _joints(info))


def remove(
    context: typer.Context,
    robot: Annotated[str, typer.Argument(help="Name of an uploaded robot.", autocompletion=robots_beginning_with)],
) -> None:
    """Remove an uploaded robot from the service."""
    with session(context).client() as client:
        client.remove_robot(robot)


SceneArgument = Annotated[str, typer.Argument(metavar="SCENE", help="Its name.", autocompletion=scenes_beginning_with)]
scenes = typer.Typer(name="scenes", help="Scenes of a service: what stands around a robot or hangs on it.")


@scenes.command("list")
def list_scenes(context: typer.Context) -> None:
    """List the scenes of the service with their sizes."""
    shared = session(context)
    with shared.client() as client:
        answer = client.scenes()
    rows = [(one.name, one.objects, one.size) for one in answer.scenes]
    shared.write(answer, AnswerRows(("name", "objects", "size"), rows))


@scenes.command("show")
def show_scene(context: typer.Context, scene: SceneArgument) -> None:
    """Show a scene: its objects as JSON."""
    shared = session(context)
    with shared.client() as client:
        shared.output.tell(client.scene(scene))


@scenes.command("put")
def put_scene(
    context: typer.Context,
    file: Annotated[Path, typer.Argument(help="JSON with `objects`; files that they name are taken from its folder.")],
    name: Annotated[str | None, typer.Option(help="Name of the scene; the file's name if left out.")] = None,
) -> None:
    """Store a scene, in the place of the one of that name if there is one."""
    shared, objects = session(context), fields_of(str(file)).get("objects", [])
    shapes = [one.get("shape", {}) for one in objects if isinstance(one, dict)]
    beside = {str(shape["file"]): file.parent / Path(str(shape["file"])).name for shape in shapes if "file" in shape}
    files = {known: path.read_bytes() for known, path in beside.items() if path.is_file()}
    name = name or name_of(file)
    with shared.client() as client:
        try:
            info = client.replace_scene_files(name, objects, files) if files else client.replace_scene(name, objects)
        except UnknownScene:
            info = client.add_scene_files(name, objects, files) if files else client.add_scene(name, objects)
    shared.output.tell(info)


@scenes.command("remove")
def remove_scene(context: typer.Context, scene: SceneArgument) -> None:
    """Remove a scene with its files."""
    with session(context).client() as client:
        client.remove_scene(scene)
