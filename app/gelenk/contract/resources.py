"""The operations on stored robots and jobs, and about the service itself."""

from functools import partial
from typing import Any

from gelenk.contract.collision_bodies import CollisionBodies
from gelenk.contract.collision_pairs import CollisionPairs
from gelenk.contract.dh_from_urdf import FromUrdfAnswer
from gelenk.contract.endpoint import Resource, Scope
from gelenk.contract.exercises import CoursePictures, ExerciseGrade, ExerciseList, ExerciseSolution, ExerciseVariant
from gelenk.contract.ik import InverseAnswer
from gelenk.contract.jobs import JobInfo, JobList
from gelenk.contract.problem import Health
from gelenk.contract.robots import EXAMPLE_DH, ArchiveReplacement, NewArchive, RobotInfo, RobotList
from gelenk.contract.scene import EXAMPLE_SCENE, SceneForm, SceneInfo, SceneList
from gelenk.contract.screws import ScrewsAnswer
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.workspace import WorkspaceAnswer

MESH_TYPES = {
    ".stl": "model/stl",
    ".obj": "model/obj",
    ".dae": "model/vnd.collada+xml",
    ".msh": "model/vnd.mujoco.msh",
    ".mtl": "model/mtl",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
}
"""Media types of the files of a robot, by the ends of their names."""

SMALL_MESH = "model/gltf-binary"
"""Media type of the small form of a mesh, for pictures."""

SCENE_TYPES = {end: MESH_TYPES[end] for end in (".stl", ".obj", ".dae")} | {".npy": "application/x-npy"}
"""Media types of the files of a scene, by the ends of their names."""

_BY_WORKER = (429, 500, 503, 504)
_OF_ROBOT = (404, 422, *_BY_WORKER)
_EXERCISE = (400, 404, 413, 415, 422, *_BY_WORKER)
_SHEETS = ("text/html", "application/pdf", "application/zip", "application/xml", "text/csv")
_HOMEWORK = {
    "exercises": ["mobility.linkage", "actuators.gear"],
    "participants": ["Ada", "Ben"],
    "title": "Sheet 1",
    "secret": "a phrase that only the lecturer knows",
}
_EVENT = {
    "type": "object",
    "properties": {
        "event": {"enum": ["progress", "finished"]},
        "id": {"type": "string", "description": "Same as `Last-Event-ID`, which a browser sends when it reconnects."},
        "data": {
            "type": "string",
            "contentMediaType": "application/json",
            "contentSchema": {"$ref": "#/components/schemas/JobInfo"},
        },
    },
    "required": ["event", "id", "data"],
}
_WORKSPACE_PICTURE = (
    "A workspace from the front, the side and above, or in its plane, coloured by the measure or the dexterity. For a "
    "trajectory what the call itself answers."
)

_BINARY = {"type": "string", "format": "binary"}
_ARCHIVE: dict[str, dict[str, Any]] = {
    "archive": {
        **_BINARY,
        "description": "Zip of a URDF, xacro or MJCF, the files it includes, its meshes, and its SRDF if there is one.",
    }
}
_SCENE_FILES: dict[str, dict[str, Any]] = {
    "files": {
        "type": "array",
        "items": _BINARY,
        "description": "Each file that the scene names, under that name: STL, OBJ, DAE, or npy for points.",
    }
}


def _content(description: str, **more: str) -> dict[str, Any]:
    return {"schema": {"type": "string", **more, "description": description}}


def _file(description: str, *kinds: str) -> dict[int, dict[str, Any]]:
    return {200: {"content": {kind: {} for kind in kinds}, "description": description}}


_query = partial(Resource, method="GET", scope=Scope.READ)
_robot_query = partial(_query, tag="Robots", problems=_OF_ROBOT)
_monitoring = partial(Resource, method="GET", tag="Service", scope=None)
_about_exercise = partial(Resource, tag="Course", scope=Scope.READ, problems=_EXERCISE)

RESOURCES = (
    _query(
        name="list_robots",
        path="v1/robots",
        tag="Robots",
        answer=RobotList,
        problems=_BY_WORKER,
        summary="All robots",
        description="Lists the catalogue's robots, then the uploaded ones, each part sorted by name.",
    ),
    _robot_query(
        name="get_robot",
        path="v1/robots/{robot}",
        answer=RobotInfo,
        summary="A robot",
        description="Joints, links, frames, chains, licence, and warnings about the description.",
    ),
    _robot_query(
        name="get_robot_urdf",
        path="v1/robots/{robot}/urdf",
        responses=_file("The URDF", "application/xml"),
        summary="A robot's URDF",
        description="""
        The description as uploaded; or as generated from the DH table, with a certificate in the header
        `Gelenk-Certificate`.
        """,
    ),
    _robot_query(
        name="get_robot_mesh",
        path="v1/robots/{robot}/meshes/{path:path}",
        responses=_file("The file", *MESH_TYPES.values(), SMALL_MESH),
        summary="A mesh file of a robot",
        description="""
        The file exactly as uploaded.

        For pictures, name `model/gltf-binary` in `Accept`: then a mesh is answered as GLB with fewer triangles, no
        further from its surface than about a thousandth of its longest side, and with its colours. One with textures,
        and a broken one, is answered as it is. Contacts are computed of the file itself.

        A file that is stored compressed is sent compressed to clients whose `Accept-Encoding` names `gzip`.
        """,
    ),
    _robot_query(
        name="get_collision_bodies",
        path="v1/robots/{robot}/collision-bodies",
        answer=CollisionBodies,
        summary="What of a robot can touch anything",
        description="Lists the convex pieces that each link counts as where contacts are computed. The first call on a "
        "robot may take seconds.",
    ),
    _robot_query(
        name="get_collision_pairs",
        path="v1/robots/{robot}/collision-pairs",
        answer=CollisionPairs,
        summary="Which links can touch each other",
        description="""
        Lists the pairs of links that have bodies, whether contacts between them are looked for, and if not, why.

        The bodies are the collision shapes; of a link without them the visual ones, and of meshes the convex hulls of
        the parts that they are cut into. The first call on a robot may take seconds.

        Pairs that never touch stay active: that would be a claim from samples, and they cost next to nothing.
        """,
    ),
    Resource(
        name="choose_collision_pairs",
        method="PUT",
        path="v1/robots/{robot}/collision-pairs",
        tag="Robots",
        answer=CollisionPairs,
        problems=(400, 403, 404, 413, 415, 422, 507, *_BY_WORKER),
        example={"pairs": [{"a": "link_1", "b": "link_2", "active": True}]},
        summary="Choose which links can touch each other",
        description="""
        Replaces the choices of before for an uploaded robot; with no pairs all are as found. They are on disk when the
        answer is sent, and gone when the robot is replaced.
        """,
    ),
    Resource(
        name="remove_robot",
        method="DELETE",
        path="v1/robots/{robot}",
        tag="Robots",
        status=204,
        problems=(403, 404, 503, 507),
        summary="Remove an uploaded robot",
        description="Removes the robot for every worker at once. The catalogue's robots are read-only.",
    ),
    Resource(
        name="add_robot",
        path="v1/robots",
        tag="Robots",
        answer=RobotInfo,
        status=201,
        responses={200: {"model": RobotInfo, "description": "It was there"}},
        problems=(400, 404, 409, 413, 415, 422, 507, *_BY_WORKER),
        example=EXAMPLE_DH,
        form=NewArchive,
        files=_ARCHIVE,
        summary="Add a robot",
        description="""
        Adds a URDF, xacro or MJCF, a DH table, or, as a form, a zip of one of the first three, its meshes, and
        its SRDF if there is one, whose `disable_collisions` leave out pairs of links. A xacro is stored as the URDF
        that it expands to with `arguments`, an MJCF as the URDF of the same links and joints; files that they include
        come from the zip alone.

        The answer is sent once the robot is safely on disk; every worker sees it at once. Adding the same robot under
        the same name again returns 200, a different one 409; a default chain with an unknown frame returns 404.
        Harmless oddities are accepted and listed in `warnings`.
        """,
    ),
    Resource(
        name="replace_robot",
        method="PUT",
        path="v1/robots/{robot}",
        tag="Robots",
        answer=RobotInfo,
        problems=(400, 403, 404, 413, 415, 422, 507, *_BY_WORKER),
        example={key: EXAMPLE_DH[key] for key in ("description", "dh")},
        form=ArchiveReplacement,
        files=_ARCHIVE,
        summary="Replace an uploaded robot",
        description="Replaces an uploaded robot atomically: requests see either the old one or the new one.",
    ),
    _query(
        name="list_scenes",
        path="v1/scenes",
        tag="Scenes",
        answer=SceneList,
        problems=(503,),
        summary="All scenes",
        description="Lists the stored scenes by name.",
    ),
    _query(
        name="get_scene",
        path="v1/scenes/{scene}",
        tag="Scenes",
        answer=SceneInfo,
        problems=(404, 422, 503),
        summary="A scene",
        description="The objects as they were sent, and the names and sizes of the files.",
    ),
    _query(
        name="get_scene_file",
        path="v1/scenes/{scene}/files/{file}",
        tag="Scenes",
        responses=_file("The file", *SCENE_TYPES.values()),
        problems=(404, 422, 503),
        summary="A file of a scene",
        description="A mesh or a cloud of points, exactly as it was sent.",
    ),
    Resource(
        name="add_scene",
        path="v1/scenes",
        tag="Scenes",
        answer=SceneInfo,
        status=201,
        responses={200: {"model": SceneInfo, "description": "It was there"}},
        problems=(400, 409, 413, 415, 422, 507, *_BY_WORKER),
        example=EXAMPLE_SCENE,
        form=SceneForm,
        files=_SCENE_FILES,
        summary="Add a scene",
        description="""
        Stores what stands around a robot or hangs on it, under a name that calls have as their `scene`.

        Poses are in the root frame of the robot that a call is about. A scene with meshes, or with points as npy,
        comes as a form: the same JSON in `scene`, and in `files` each file that its objects name. Files of points are
        checked, those of meshes are opened only where contacts are computed. The answer is sent once the scene is
        safely on disk; every worker sees it at once. Adding the same scene again returns 200, a different one 409.
        """,
    ),
    Resource(
        name="replace_scene",
        method="PUT",
        path="v1/scenes/{scene}",
        tag="Scenes",
        answer=SceneInfo,
        problems=(400, 404, 413, 415, 422, 507, *_BY_WORKER),
        example={"objects": EXAMPLE_SCENE["objects"][:1]},
        form=SceneForm,
        files=_SCENE_FILES,
        summary="Replace a scene",
        description="Replaces a scene atomically: calls see either the old one or the new one. A file that the new "
        "one names and that is not sent again stays as it was.",
    ),
    Resource(
        name="remove_scene",
        method="DELETE",
        path="v1/scenes/{scene}",
        tag="Scenes",
        status=204,
        problems=(404, 503, 507),
        summary="Remove a scene",
        description="Removes the scene with its files, for every worker at once.",
    ),
    _query(
        name="get_robot_dh",
        path="v1/robots/{robot}/dh",
        tag="DH tables",
        answer=FromUrdfAnswer,
        problems=_OF_ROBOT,
        responses=_file("The table", "text/csv", "text/x-tex", "text/x-matlab", "text/x-python"),
        summary="A robot's chain as a table",
        description="""
        Returns the DH table of the default chain, or of the chain between the named frames, as `from-urdf` does.

        With `format` it is the text of a file: `csv`, `latex`, a function for MATLAB and Octave that gives the pose, or
        a `DHRobot` of the Robotics Toolbox for Python. The certificate is in its first lines.
        """,
    ),
    _robot_query(
        name="get_robot_mjcf",
        path="v1/robots/{robot}/mjcf",
        responses=_file("The MJCF", "application/xml"),
        summary="A robot as MJCF",
        description="""
        The whole robot in MuJoCo's format: a body for each link, with its name, joints, masses and shapes. Joints that
        follow others are equalities.

        Before it is sent, Pinocchio's own reader of MJCF reads it: its poses of all links must be the robot's, and a
        comment says how far they are off. MuJoCo has no velocity limits and does not read COLLADA: these are left out.
        """,
    ),
    _robot_query(
        name="get_robot_screws",
        path="v1/robots/{robot}/screws",
        answer=ScrewsAnswer,
        summary="A robot's chain as screws",
        description="""
        Returns the product of exponentials of the default chain, or of the chain between the named frames.

        The home pose M, and the screw axes in the base's and in the tip's axes, angular part first as Modern Robotics
        writes them: transposed, they are its `Slist` and `Blist`. The `jacobian` in their order has the reference
        `space_screws` or `body_screws`. A robot given as `screws` becomes this again.
        """,
    ),
    _query(
        name="get_dh_picture",
        path="v1/dh/picture",
        tag="DH tables",
        responses=_file("The picture", "image/svg+xml", "image/png", "application/pdf"),
        problems=(422, *_BY_WORKER),
        summary="Picture of the DH parameters",
        description="""
        The two links of the lecture with their frames, and a, α, d and ϑ of each, in either convention.

        SVG unless `Accept` says `image/png` or `application/pdf`. The same call with POST draws any table.
        """,
    ),
    _query(
        name="list_pictures",
        path="v1/course/pictures",
        tag="Course",
        answer=CoursePictures,
        problems=(422,),
        summary="The course's pictures",
        description="Lists the pictures, with their titles: those that depend on nothing, and one of each calculator "
        "that draws, of its own example. A calculator draws any other request with `Accept: image/svg+xml`.",
    ),
    _query(
        name="get_picture",
        path="v1/course/pictures/{picture}",
        tag="Course",
        responses=_file("The picture", "image/svg+xml", "image/png", "application/pdf"),
        problems=_OF_ROBOT,
        summary="A picture of the course",
        description="Kinematic pairs, the spherical wrist, a triangle, lever arms, a fly-over and more, as SVG, or as "
        "PNG or PDF with `Accept: image/png` or `application/pdf`. Texts are drawn in the language asked for.",
    ),
    _query(
        name="list_jobs",
        path="v1/jobs",
        tag="Jobs",
        answer=JobList,
        problems=(422,),
        summary="Your jobs",
        description="""
        Lists the jobs that you have submitted, the newest first; `next` continues the list.

        Yours are those of your key; where no keys are on, those of your address. Behind a proxy that does not name
        its clients (`GELENK_TRUSTED_PROXIES`), nobody without a key is shown any.
        """,
    ),
    _query(
        name="get_job",
        path="v1/jobs/{job}",
        tag="Jobs",
        answer=JobInfo,
        problems=(404, 422),
        summary="A job",
        description="""
        A job's state and progress. Every worker knows every job, and jobs survive a restart.

        A job whose process ended is `queued` until another process resumes the unfinished part.
        """,
    ),
    _query(
        name="watch_job",
        path="v1/jobs/{job}/events",
        tag="Jobs",
        responses={
            200: {"content": {"text/event-stream": {"itemSchema": _EVENT}}, "description": "Server-sent events"},
            204: {"description": "The last event was received before"},
        },
        problems=(404, 422),
        summary="A job's progress as events",
        description="""
        Server-sent events until the job finishes.

        `event: progress` on each advance, and at the end `event: finished`; the data of both is the job as
        `GET /v1/jobs/{job}` has it. Comments keep the connection alive between them.
        """,
    ),
    _query(
        name="get_job_result",
        path="v1/jobs/{job}/result",
        tag="Jobs",
        answer=WorkspaceAnswer | InverseAnswer | TrajectoryAnswer,
        responses={
            200: {
                "content": {
                    "application/x-npy": _content(
                        "Of a workspace the array, columns as `array.columns` of the JSON has them: (N, 4) x y z "
                        "measure of a cloud, (M, 5) x y z samples best_measure of a grid, (M, 6) with the share of a "
                        "dexterity map. For other jobs what the call itself answers, headers included.",
                        format="binary",
                    ),
                    "text/csv": _content("For a trajectory what the call itself answers."),
                    "image/svg+xml": _content(_WORKSPACE_PICTURE, format="binary"),
                    "image/png": _content(_WORKSPACE_PICTURE, format="binary"),
                    "application/pdf": _content(_WORKSPACE_PICTURE, format="binary"),
                }
            }
        },
        problems=(404, 409, 413, 422, 500, 503),
        summary="A job's result",
        description="""
        Returns a workspace's summary (JSON), array (npy) or picture, as `Accept` says, or the answer of another job.

        That answer is byte for byte what the operation returns directly. The header `Gelenk-Robot-Digest` has the
        `robot_digest` of the job. A failed job returns its problem.

        A job given up because the service ended every time it was started returns 409: submit it again.
        """,
    ),
    Resource(
        name="cancel_job",
        method="DELETE",
        path="v1/jobs/{job}",
        tag="Jobs",
        answer=JobInfo,
        problems=(404, 409, 422, 503, 507),
        summary="Cancel a job, or remove a finished one",
        description="""
        A queued or running job is cancelled at once, whichever worker runs it, and can still be read.

        A finished job, even if it finished only now, keeps its result: 409 with its `state`. With `finished=remove` it
        is removed together with its result; the answer shows it one last time.
        """,
    ),
    _query(
        name="list_exercises",
        path="v1/course/exercises",
        tag="Course",
        answer=ExerciseList,
        problems=(422,),
        summary="All exercises",
        description="Lists the exercises by lectures, in the order of the course.",
    ),
    _about_exercise(
        name="draw_exercise",
        path="v1/course/exercises/{exercise}",
        answer=ExerciseVariant,
        example={"seed": 7},
        summary="A variant of an exercise",
        description="""
        Draws the numbers of an exercise: the same for the same seed and `version`, whatever else changes.

        `fields` describes the answers. A field's `tolerance` is absolute, or a share of the right answer's size if it
        `is_relative`; whole numbers have tolerance 0. Angles may differ by whole turns, solutions in a set may be in
        any order, and a basis may be any of the same space.
        """,
    ),
    _about_exercise(
        name="solve_exercise",
        path="v1/course/exercises/{exercise}/solution",
        scope=Scope.TEACH,
        answer=ExerciseSolution,
        example={"seed": 7},
        summary="The solution of a variant",
        description="Returns the right answers and the worked solution. Where keys are on, it needs `teach`.",
    ),
    _about_exercise(
        name="grade_exercise",
        path="v1/course/exercises/{exercise}/grade",
        answer=ExerciseGrade,
        example={"seed": 7, "answers": {"constraints": 8, "mobility": 1, "verdict": "mechanism"}},
        summary="Grade the answers to a variant",
        description="""
        Grades each field, and names the mistake if a known wrong model leads to the given answer.

        The right answer is recognized first, in all its forms. A wrong model is named only if its answer differs
        clearly from the right one and no other leads to this answer; where several do, it is the one that explains most
        of the other answers too. Else `mistake` is null. An answer of the wrong form is no error: `mistake` says what
        is wrong with it.
        """,
    ),
    _about_exercise(
        name="write_sheets",
        path="v1/course/sheets",
        scope=Scope.TEACH,
        responses=_file("The sheets, as `Accept` says", *_SHEETS),
        problems=(*_EXERCISE, 501),
        example=_HOMEWORK,
        summary="Sheets for a class",
        description="""
        Writes a sheet for each participant, all with numbers of their own, as one page to be printed; with `content`
        `solutions` the booklet of answers and worked solutions.

        A PDF with `Accept: application/pdf`, if the service has Chromium; the key with `text/csv`; questions for Moodle
        with `application/xml`, a category for each exercise; with `application/zip` all in one: sheets, booklet, key,
        questions for Moodle and PrairieLearn. The numbers follow from the secret, the participant and the exercise, so
        that nothing is stored. Where keys are on, it needs `teach`.
        """,
    ),
    _about_exercise(
        name="grade_sheets",
        path="v1/course/sheets/grade",
        scope=Scope.TEACH,
        responses=_file("A row for each field", "text/csv"),
        example={
            "csv": "participant,exercise,field,answer\nAda,mobility.linkage,constraints,8\n",
            "secret": _HOMEWORK["secret"],
        },
        summary="Grade the answers of a class",
        description="""
        Grades a table of answers, and returns one of points and mistakes; fields without an answer are in it too.

        The table may also be the body itself, as `text/csv`; then the secret is the service's own, and the language
        follows `Accept-Language`. Where keys are on, it needs `teach`.
        """,
    ),
    _monitoring(
        name="health",
        path="healthz",
        answer=Health,
        summary="Is the process alive?",
        description="Answers as long as the process is alive.",
    ),
    _monitoring(
        name="readiness",
        path="readyz",
        answer=Health,
        problems=(503,),
        summary="Is it ready for work?",
        description="""
        503 with `waiting_for` and `reasons` until everything is ready; `failure` says what went wrong.

        `kernels`: compiled at the first start. `crew`: processes for long work. `jobs`: no cluster runs them.
        `storage`: nothing can be stored, because the disk is full or read-only; stored data can still be read.
        """,
    ),
    Resource(
        name="metrics",
        method="GET",
        path="metrics",
        tag="Service",
        scope=Scope.ADMIN,
        responses={
            200: {
                "content": {"text/plain": {"schema": {"type": "string"}}},
                "description": "Prometheus's text format",
            }
        },
        summary="Metrics",
        description="""
        Latencies and batch sizes by operation and robot, verdicts and iterations of inverse kinematics, queues.

        Covers all worker processes together, in Prometheus's text format.
        """,
    ),
)
