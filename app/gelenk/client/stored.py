"""Calls on stored robots, scenes and jobs, and on the service itself."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Literal, TypeVar
from urllib.parse import quote

from httpx2 import Response

from gelenk.client.call import Call
from gelenk.client.exchange import encoded, json_call, query_of, reader, segment
from gelenk.contract.collision_bodies import CollisionBodies
from gelenk.contract.collision_pairs import CollisionPairs
from gelenk.contract.common import Answer, ChainEnds
from gelenk.contract.dh_from_urdf import FromUrdfAnswer
from gelenk.contract.exercises import CoursePictures, ExerciseList
from gelenk.contract.jobs import Finished, JobInfo, JobList
from gelenk.contract.problem import Health
from gelenk.contract.robots import RobotInfo, RobotList
from gelenk.contract.scene import SceneInfo, SceneList, SceneObject
from gelenk.contract.screws import ScrewsAnswer
from gelenk.contract.trajectory import JOINT_TRAJECTORY, URSCRIPT, YAML
from gelenk.language import Language

A = TypeVar("A", bound=Answer)


def robots() -> Call[RobotList]:
    """All robots: those of the catalogue, and those that were uploaded."""
    return Call("GET", "v1/robots", reader(RobotList))


def robot(robot: str) -> Call[RobotInfo]:
    """A robot's joints, links, limits, licence and warnings."""
    return Call("GET", f"v1/robots/{segment(robot)}", reader(RobotInfo))


def urdf(robot: str) -> Call[str]:
    """A robot as URDF."""
    return Call("GET", f"v1/robots/{segment(robot)}/urdf", _text, accept="application/xml")


def mjcf(robot: str, meshes: bool = False) -> Call[str]:
    """A robot as MJCF; with `meshes` it names the mesh files, which `mesh` returns."""
    return Call(
        "GET", f"v1/robots/{segment(robot)}/mjcf", _text, query_of({"meshes": meshes}), accept="application/xml"
    )


def collision_bodies(robot: str) -> Call[CollisionBodies]:
    """Convex pieces that a robot's links count as where contacts are computed."""
    return Call("GET", f"v1/robots/{segment(robot)}/collision-bodies", reader(CollisionBodies))


def collision_pairs(robot: str) -> Call[CollisionPairs]:
    """Pairs of a robot's links, and whether contacts between them are looked for."""
    return Call("GET", f"v1/robots/{segment(robot)}/collision-pairs", reader(CollisionPairs))


def table(
    robot: str,
    convention: Literal["standard", "modified"] = "standard",
    base_frame: str | None = None,
    tip_frame: str | None = None,
    snap_tolerance: float | None = None,
    steps: bool = False,
    language: Literal["en", "de"] = "en",
    column_order: Sequence[Literal["a", "alpha", "d", "theta"]] | None = None,
) -> Call[FromUrdfAnswer]:
    """A chain of a robot as a Denavit-Hartenberg table, with its certificate.

    Args:
        robot: Name of the robot.
        convention: Convention of the table.
        base_frame: Base of the chain; the default chain's if left out.
        tip_frame: Tip of the chain; the default chain's if left out.
        snap_tolerance: Tolerance within which numbers are rounded to plain ones, [rad or m]; no rounding if left out.
        steps: Whether to show how the frames are placed.
        language: Language of the steps.
        column_order: Order of the columns of the table in the steps; a, alpha, d, theta if left out.
    """
    chosen: dict[str, Any] = {"base_frame": base_frame, "tip_frame": tip_frame, "snap_tolerance": snap_tolerance}
    if steps:
        chosen |= {"steps": True, "language": language, "column_order": column_order}
    query = query_of({"convention": convention, **chosen})
    return Call("GET", f"v1/robots/{segment(robot)}/dh", reader(FromUrdfAnswer), query)


def screws(robot: str, base_frame: str | None = None, tip_frame: str | None = None) -> Call[ScrewsAnswer]:
    """A chain of a robot as a product of exponentials, angular parts first, with its certificate.

    Args:
        robot: Name of the robot.
        base_frame: Base of the chain; the default chain's if left out.
        tip_frame: Tip of the chain; the default chain's if left out.
    """
    query = query_of({"base_frame": base_frame, "tip_frame": tip_frame})
    return Call("GET", f"v1/robots/{segment(robot)}/screws", reader(ScrewsAnswer), query)


def table_file(
    robot: str,
    format: Literal["csv", "latex", "matlab", "roboticstoolbox"],  # noqa: A002
    convention: Literal["standard", "modified"] = "standard",
    base_frame: str | None = None,
    tip_frame: str | None = None,
    snap_tolerance: float | None = None,
) -> Call[str]:
    """The Denavit-Hartenberg table of a robot's chain as text for another program; arguments are those of `table`."""
    query = query_of(
        {"format": format, "convention": convention, "base_frame": base_frame, "tip_frame": tip_frame}
        | {"snap_tolerance": snap_tolerance}
    )
    return Call("GET", f"v1/robots/{segment(robot)}/dh", _text, query, accept="*/*")


def mesh(robot: str, path: str) -> Call[bytes]:
    """A mesh that a robot's URDF names; `meshes` of `robot` lists their paths."""
    return Call("GET", f"v1/robots/{segment(robot)}/meshes/{quote(path)}", _content, accept="*/*")


def add_archive(
    name: str,
    archive: bytes | str | PathLike[str],
    description: str = "",
    default_chain: ChainEnds | None = None,
    strict: bool = False,
    file: str | None = None,
    arguments: Mapping[str, str | float] | None = None,
) -> Call[RobotInfo]:
    """Add a robot with its meshes: a zip of a URDF or xacro and the files that it names.

    `file` is which description of several, `arguments` are those of a xacro.
    """
    form = {"name": name, "description": description}
    return _with_archive("POST", "v1/robots", archive, default_chain, strict, _of_file(file, arguments), form)


def replace_archive(
    robot: str,
    archive: bytes | str | PathLike[str],
    description: str = "",
    default_chain: ChainEnds | None = None,
    strict: bool = False,
    file: str | None = None,
    arguments: Mapping[str, str | float] | None = None,
) -> Call[RobotInfo]:
    """Replace an uploaded robot by a zip, as `add_archive` takes it."""
    form, path = {"description": description}, f"v1/robots/{segment(robot)}"
    return _with_archive("PUT", path, archive, default_chain, strict, _of_file(file, arguments), form)


def _of_file(file: str | None, arguments: Mapping[str, str | float] | None) -> dict[str, str]:
    """Return the fields of a form that say which description is meant, and with which arguments."""
    given = {} if file is None else {"file": file}
    return given | ({"arguments": encoded(dict(arguments)).decode()} if arguments else {})


def _with_archive(
    method: str,
    path: str,
    archive: bytes | str | PathLike[str],
    chain: ChainEnds | None,
    strict: bool,
    of_file: dict[str, str],
    form: dict[str, str],
) -> Call[RobotInfo]:
    ends = {} if chain is None else {"base_frame": chain.base_frame, "tip_frame": chain.tip_frame}
    form = {**form, **ends, **({"strict": "true"} if strict else {}), **of_file}
    content = archive if isinstance(archive, bytes) else Path(archive).read_bytes()
    return Call(method, path, reader(RobotInfo), form=form, files=[("archive", ("robot.zip", content))])


def remove(robot: str) -> Call[None]:
    """Remove an uploaded robot."""
    return Call("DELETE", f"v1/robots/{segment(robot)}", lambda _: None, is_repeatable=False)


def scenes() -> Call[SceneList]:
    """All stored scenes."""
    return Call("GET", "v1/scenes", reader(SceneList))


def scene(scene: str) -> Call[SceneInfo]:
    """A stored scene: its objects as they were sent, and its files."""
    return Call("GET", f"v1/scenes/{segment(scene)}", reader(SceneInfo))


def scene_file(scene: str, file: str) -> Call[bytes]:
    """A file of a stored scene; `files` of `scene` lists them."""
    return Call("GET", f"v1/scenes/{segment(scene)}/files/{quote(file)}", _content, accept="*/*")


def add_scene(name: str, objects: Sequence[SceneObject | Mapping[str, Any]]) -> Call[SceneInfo]:
    """Store a scene, whose name is then the `scene` of calls."""
    return json_call("POST", "v1/scenes", {"name": name, "objects": objects}, SceneInfo)


def replace_scene(scene: str, objects: Sequence[SceneObject | Mapping[str, Any]]) -> Call[SceneInfo]:
    """Replace a stored scene; files that the objects still name stay with it."""
    return json_call("PUT", f"v1/scenes/{segment(scene)}", {"objects": objects}, SceneInfo)


def add_scene_files(
    name: str, objects: Sequence[SceneObject | Mapping[str, Any]], files: Mapping[str, bytes]
) -> Call[SceneInfo]:
    """Store a scene with meshes, or points as npy: the content of each file by the name that the objects have."""
    return _with_files("POST", "v1/scenes", {"name": name, "objects": objects}, files)


def replace_scene_files(
    scene: str, objects: Sequence[SceneObject | Mapping[str, Any]], files: Mapping[str, bytes]
) -> Call[SceneInfo]:
    """Replace a stored scene, with files as `add_scene_files` takes them; those that are not sent again stay."""
    return _with_files("PUT", f"v1/scenes/{segment(scene)}", {"objects": objects}, files)


def _with_files(method: str, path: str, fields: Mapping[str, Any], files: Mapping[str, bytes]) -> Call[SceneInfo]:
    parts = [("files", (file, files[file])) for file in files]
    return Call(method, path, reader(SceneInfo), form={"scene": encoded(fields).decode()}, files=parts)


def remove_scene(scene: str) -> Call[None]:
    """Remove a stored scene with its files."""
    return Call("DELETE", f"v1/scenes/{segment(scene)}", lambda _: None, is_repeatable=False)


def list_jobs(limit: int = 50, before: int | None = None) -> Call[JobList]:
    """Jobs that you have submitted, the newest first; `next` of the answer is the `before` of the next older ones."""
    query = {"limit": limit, **({} if before is None else {"before": before})}
    return Call("GET", "v1/jobs", reader(JobList), query)


def job(job: str) -> Call[JobInfo]:
    """State and progress of a job."""
    return Call("GET", f"v1/jobs/{segment(job)}", reader(JobInfo))


def cancel(job: str, finished: Finished = "keep") -> Call[JobInfo]:
    """Cancel a job; a finished one is refused, or with `finished="remove"` removed."""
    query = {} if finished == "keep" else {"finished": finished}
    return Call("DELETE", f"v1/jobs/{segment(job)}", reader(JobInfo), query, is_repeatable=False)


def result(answer: type[A]) -> Callable[[str], Call[A]]:
    """Define the call that gets the result of a job, with answers of this model."""

    def describe(job: str) -> Call[A]:
        """Result of a job of this kind."""
        return Call("GET", f"v1/jobs/{segment(job)}/result", reader(answer))

    return describe


def picture(
    path: str,
    kind: Literal["svg", "png", "pdf", "zip", "xml", "html", "csv", "joint_trajectory", "yaml", "urscript"],
    fields: Mapping[str, Any] | None = None,
) -> Call[bytes]:
    """An answer as a picture, or as a file of another kind, if the operation makes one.

    Args:
        path: Path of the operation or of a job's result, such as `v1/robots/panda/trajectory`.
        kind: Format of the file.
        fields: Fields of the request; None for a job's result.
    """
    method, body = ("GET", b"") if fields is None else ("POST", encoded(fields))
    return Call(method, path, _content, body=body, accept=_PICTURES[kind])


def dh_parameters(convention: Literal["standard", "modified"] = "standard", language: Language = "en") -> Call[bytes]:
    """The DH parameters on the two links of the lecture as SVG; as PNG or PDF `picture` returns it."""
    query = query_of({"convention": convention, "language": language})
    return Call("GET", "v1/dh/picture", _content, query, accept=_PICTURES["svg"])


def course_pictures(language: Language = "en") -> Call[CoursePictures]:
    """The course's pictures, with their titles."""
    return Call("GET", "v1/course/pictures", reader(CoursePictures), query_of({"language": language}))


def course_picture(picture: str, language: Language = "en") -> Call[bytes]:
    """A picture of the course as SVG, by its name in `course_pictures`; as PNG or PDF `picture` returns it."""
    path, query = f"v1/course/pictures/{segment(picture)}", query_of({"language": language})
    return Call("GET", path, _content, query, accept=_PICTURES["svg"])


def exercises(language: Literal["en", "de"] = "en") -> Call[ExerciseList]:
    """The exercises of the course, by lectures.

    Args:
        language: Language of the titles.
    """
    return Call("GET", "v1/course/exercises", reader(ExerciseList), query_of({"language": language}))


def health() -> Call[Health]:
    """Whether the process is alive."""
    return Call("GET", "healthz", reader(Health))


def readiness() -> Call[Health]:
    """Whether the service is ready for work; retried a few times before it is an error."""
    return Call("GET", "readyz", reader(Health))


def metrics() -> Call[str]:
    """Metrics of the service, in Prometheus's text format."""
    return Call("GET", "metrics", _text, accept="text/plain")


def _content(response: Response) -> bytes:
    return response.content


def _text(response: Response) -> str:
    return response.content.decode()


_PICTURES = {
    "svg": "image/svg+xml",
    "png": "image/png",
    "pdf": "application/pdf",
    "zip": "application/zip",
    "xml": "application/xml",
    "csv": "text/csv",
    "html": "text/html",
    "joint_trajectory": JOINT_TRAJECTORY,
    "yaml": YAML,
    "urscript": URSCRIPT,
}
