"""Every error class of the core has a status, a kind of its own, and something that raises it."""

import asyncio
import errno
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from tempfile import TemporaryDirectory, mkdtemp
from typing import Any

import numpy as np
import pytest
from starlette.requests import Request
from starlette.testclient import TestClient

from gelenk import errors
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.contract.scene import Scene
from gelenk.http.messages.npy import read_npy
from gelenk.http.messages.payloads import Bodies
from gelenk.http.messages.problems import status_of
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context
from gelenk.jobs.job import Failure
from gelenk.jobs.limits import JobLimits
from gelenk.jobs.runner import Runner
from gelenk.jobs.store import JobStore
from gelenk.kinematics.judge.judge import certify_poses
from gelenk.operations.outcome import Limits
from gelenk.pool.pool import WorkerPool
from gelenk.robot.chain import build_chain
from gelenk.robot.poses import Poses
from gelenk.robot.urdf import read_urdf
from gelenk.sheets.pdf import printed
from gelenk.store.archive import unpacked
from gelenk.store.folders import writing
from gelenk.store.library import Library, RobotUpload
from gelenk.store.quota import Quota
from gelenk.store.records import read_record
from gelenk.store.scenes import Scenes, SceneUpload
from gelenk.trajectory.audit.audit import audit
from gelenk.trajectory.audit.demands import Demands
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.plan import refuse_failed
from tests.jobs.workers import Workers
from tests.pool import calls
from tests.robots import robot

CATALOGUE = Path("robots")
LONG = 60.0
SHIP = """<robot name="ship"><link name="sea"/><link name="hull"/><link name="crane"/>
<joint name="waves" type="floating"><parent link="sea"/><child link="hull"/></joint>
<joint name="slew" type="continuous"><parent link="hull"/><child link="crane"/><axis xyz="0 0 1"/></joint>
</robot>"""
PLANAR = robot("planar_2r")
JUMP = PiecewisePolynomial(np.arange(3.0), np.array([[[0.0, 0.0]], [[1.0, 0.0]]]))
WRONG = {"tool": Poses(np.zeros((1, 3)), np.eye(3)[None])}

EXAMPLES: dict[type[errors.KinematicsError], tuple[str, str, object]] = {
    errors.InvalidUrdf: ("POST", "/v1/robots", {"name": "x", "urdf": "<robot/>"}),
    errors.InvalidDhTable: (
        "POST",
        "/v1/robots",
        {
            "name": "x",
            "dh": {
                "convention": "standard",
                "joints": [{"type": "revolute", "a": 0, "alpha": 0, "d": 0, "theta": 0, "lower": 1, "upper": 0}],
            },
        },
    ),
    errors.InvalidPose: (
        "POST",
        "/v1/robots",
        {
            "name": "x",
            "dh": {
                "convention": "standard",
                "joints": [{"type": "revolute", "a": 0, "alpha": 0, "d": 0, "theta": 0}],
                "base": {"position": [0, 0, 0], "quaternion_xyzw": [0, 0, 0, 0]},
            },
        },
    ),
    errors.InvalidField: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[1e9] * 7]}),
    errors.WrongJointCount: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[0]]}),
    errors.MissingJoint: ("POST", "/v1/robots/panda/fk", {"joint_positions": [{}]}),
    errors.UnknownJoint: ("POST", "/v1/robots/panda/fk", {"joint_positions": [{"nose": 0}]}),
    errors.OutsideLimits: (
        "POST",
        "/v1/robots/panda/fk",
        {"joint_positions": [[3] * 7], "respect_limits": True},
    ),
    errors.FrameNotOnChain: (
        "POST",
        "/v1/robots/panda/fk",
        {"joint_positions": [[0] * 7], "frames": ["panda_leftfinger"]},
    ),
    errors.RepresentationSingularity: (
        "POST",
        "/v1/robots/planar_2r/jacobian",
        {"joint_positions": [[0, 0]], "representation": "zyz"},
    ),
    errors.UnknownRobot: ("GET", "/v1/robots/nobody", None),
    errors.UnknownScene: ("GET", "/v1/scenes/nothing", None),
    errors.UnknownFrame: ("POST", "/v1/robots/panda/fk", {"joint_positions": [], "tip_frame": "nose"}),
    errors.UnknownMesh: ("GET", "/v1/robots/panda/meshes/nothing.stl", None),
    errors.TooLarge: ("POST", "/v1/robots/panda/fk", {"joint_positions": [[0] * 7] * 200_000, "frames": "all"}),
    errors.RobotExists: ("POST", "/v1/robots", {"name": "panda", "urdf": '<robot name="r"><link name="l"/></robot>'}),
    errors.ReadOnlyRobot: ("DELETE", "/v1/robots/panda", None),
    errors.UnknownJob: ("GET", "/v1/jobs/nobody", None),
    errors.UnknownExercise: ("POST", "/v1/course/exercises/juggling", {"seed": 1}),
    errors.UnknownPicture: ("GET", "/v1/course/pictures/wrist", None),
}
OTHERWISE: dict[type[errors.KinematicsError], Callable[[], object]] = {
    errors.InvalidArray: lambda: read_npy(b"no array"),
    errors.InvalidArchive: lambda: unpacked(BytesIO(b"no zip")).__enter__(),
    errors.InvalidName: lambda: Library(CATALOGUE, CATALOGUE / "none").add(RobotUpload("a/b", "urdf", b"")),
    errors.QuotaExceeded: lambda: beyond_the_quota(),  # noqa: PLW0108 - it stands below
    errors.InvalidRobotFolder: lambda: read_record(Path("x\0"), "uploaded"),
    errors.InvalidSceneFile: lambda: in_scenes({"odd.zip": b"no zip"}).get("odd"),
    errors.SceneExists: lambda: in_scenes({"odd.zip": b""}).add(SceneUpload("odd", Scene(objects=[]))),
    errors.UnsupportedJoint: lambda: build_chain(read_urdf(SHIP), "sea", "crane"),
    errors.StorageFull: lambda: refused_by_the_system(errno.ENOSPC),
    errors.JobExists: lambda: in_a_store(lambda store: [store.add("workspace", digest, {}, "one") for digest in "ab"]),
    errors.JobNotFinished: lambda: result_of({}),
    errors.NotPrinted: lambda: printed_without_a_browser(),  # noqa: PLW0108 - it stands below
    errors.JobFinished: lambda: in_a_store(cancelled_twice),
    errors.JobCancelled: lambda: result_of({"state": "cancelled"}),
    errors.JobFailed: lambda: result_of({"state": "failed", "failure": Failure.of(errors.JobFailed("it died"))}),
    errors.JobInterrupted: lambda: result_of({"state": "failed", "failure": Failure.of(errors.JobInterrupted("gone"))}),
    errors.ServiceStopping: lambda: in_a_store(submitted_too_late),
    errors.JobTookTooLong: lambda: result_of({"state": "failed", "failure": Failure.of(errors.JobTookTooLong(1.0))}),
    errors.TooManyJobs: lambda: in_a_store(lambda store: [store.add("workspace", "", {}) for _ in range(3)]),
    errors.ServiceBusy: lambda: by_a_crew(calls.double, 1, LONG, waiting=0),
    errors.NoRoomForBody: lambda: Bodies(1).check_room(2),
    errors.TooManyRequests: lambda: of_a_client(share=0),
    errors.DeadlineExceeded: lambda: by_a_crew(calls.sleep, 60.0, 0.1),
    errors.WorkerCrashed: lambda: by_a_crew(calls.leave, 3, LONG),
    errors.WorkerOutOfMemory: lambda: by_a_crew(calls.take, 200, LONG),
    errors.InvalidMesh: lambda: read_triangles("thing.stl", b"solid"),
    errors.AuditFailed: lambda: refuse_failed(audit(PLANAR, PLANAR.chain(None, None), JUMP, Demands())),
    errors.CertificationFailed: lambda: certify_poses(PLANAR, PLANAR.chain(None, None), np.zeros((1, 2)), WRONG),
}
"""What needs more than a request, or a state that no request can bring about."""


def printed_without_a_browser() -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shutil.which", lambda _: None)
        printed("")


def in_scenes(files: dict[str, bytes]) -> Scenes:
    root = Path(mkdtemp())
    for name, content in files.items():
        (root / name).write_bytes(content)
    return Scenes(root)


def beyond_the_quota() -> None:
    with TemporaryDirectory() as folder:
        row = b'<robot name="r"><link name="l"/></robot>'
        Library(CATALOGUE, Path(folder), Quota("robot", 0, 1)).add(RobotUpload("mine", "urdf", row, owner="somebody"))


def in_a_store(do: Callable[[JobStore], object]) -> None:
    """Something with jobs of which no more than two may wait."""
    with TemporaryDirectory() as folder:
        store = JobStore(Path(folder), JobLimits(unfinished=2))
        try:
            do(store)
        finally:
            store.close()


def by_a_crew(function: Callable[[Any], object], argument: object, seconds: float, waiting: int = 1) -> None:
    """What a single process is asked for, within 100 MB."""

    async def run() -> None:
        pool = WorkerPool(1, waiting, 100 * 1024**2)
        try:
            if waiting:
                await pool.start()
            await pool.run(function, argument, seconds)
        finally:
            pool.close()

    asyncio.run(run())


def of_a_client(share: int) -> None:
    request = Request({"type": "http", "headers": [], "client": ("10.0.0.7", 50000)})
    setup = Context(CATALOGUE, CATALOGUE / "none", Limits(1, 1.0), Scenes(CATALOGUE / "none"))
    pool_client = PoolClient(WorkerPool(1, 1, 1), setup, setup.library, 1.0, share)
    asyncio.run(pool_client.resident(request, "somebody"))


def result_of(state: dict[str, object]) -> None:
    """The result of a job that is in a state, if it ever began."""

    def ask(store: JobStore) -> None:
        job, _ = store.add("workspace", "", {})
        store.change(job.id, **state)
        Runner(store, {}, Workers(1), running=1, seconds=1.0).result(job.id, "result.json")

    in_a_store(ask)


def cancelled_twice(store: JobStore) -> None:
    runner, (job, _) = Runner(store, {}, Workers(1), running=1, seconds=1.0), store.add("workspace", "", {})
    for _ in range(2):
        runner.cancel(job.id)


def submitted_too_late(store: JobStore) -> None:
    runner = Runner(store, {}, Workers(1), running=1, seconds=1.0)
    runner.close()
    runner.submit("workspace", "", {})


def refused_by_the_system(number: int) -> None:
    with writing():
        raise OSError(number, "")


CONCRETE = set(errors.kinds().values()) - {cls.__base__ for cls in errors.kinds().values()}


@pytest.mark.parametrize("error", sorted(CONCRETE, key=str), ids=lambda error: error.__name__)
def test_every_error_has_a_status_and_something_raises_it(
    client: TestClient, error: type[errors.KinematicsError]
) -> None:
    status = status_of(error)
    assert 400 <= status < 600
    if error in OTHERWISE:
        with pytest.raises(error):
            OTHERWISE[error]()
        return
    method, path, body = EXAMPLES[error]
    answer = client.request(method, path, json=body)
    assert answer.status_code == status, answer.text
    assert answer.json()["type"] == f"urn:gelenk:{errors.kind_of(error)}"


def test_a_floating_joint_may_stand_in_a_robot_but_not_on_a_chain(client: TestClient) -> None:
    created = client.post("/v1/robots", json={"name": "ship", "urdf": SHIP})
    assert created.status_code == 201, created.text
    refused = client.post("/v1/robots/ship/fk", json={"tip_frame": "crane", "base_frame": "sea", "joint_positions": []})
    assert refused.status_code == 422
    assert refused.json()["type"] == "urn:gelenk:unsupported-joint"
    assert (refused.json()["joint"], refused.json()["joint_type"]) == ("waves", "floating")
    call = {"base_frame": "hull", "tip_frame": "crane", "joint_positions": [[0.5]]}
    assert client.post("/v1/robots/ship/fk", json=call).status_code == 200


@pytest.mark.parametrize(
    ("path", "body", "pointer"),
    [
        ("/v1/robots", {"name": "x", "urdf": "<robot/>"}, "#/urdf"),
        ("/v1/robots/panda/fk", {"joint_positions": [[0] * 7, [0]]}, "#/joint_positions/1"),
        ("/v1/robots/panda/fk", {"joint_positions": [[1e9] * 7]}, "#/joint_positions"),
    ],
)
def test_a_problem_points_at_the_field(client: TestClient, path: str, body: object, pointer: str) -> None:
    assert client.post(path, json=body).json()["pointer"] == pointer


def test_a_problem_stays_small_whatever_the_names_are(client: TestClient) -> None:
    name = "🦾" * 120
    links = "".join(f'<link name="{name}{i}"/>' for i in range(200))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="{name}0"/><child link="{name}{i}"/></joint>'
        for i in range(1, 200)
    )
    urdf = f"<robot name='wide'>{links}{joints}</robot>"
    assert client.post("/v1/robots", json={"name": "wide", "urdf": urdf}).status_code == 201
    answer = client.post("/v1/robots/wide/fk", json={"joint_positions": [], "tip_frame": "nose"})
    assert answer.status_code == 404
    assert len(answer.content) < 16 * 1024
