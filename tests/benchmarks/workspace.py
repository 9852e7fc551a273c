"""A million configurations of the Panda, each with the tip's position and its manipulability.

On one thread the kernel against a Python loop over Pinocchio that keeps the same numbers (of fewer samples, by the time
of each); and the whole job over HTTP, from the request to the array on this side.
"""

import http.client
import json
import statistics
import time
from collections.abc import Callable
from io import BytesIO

import numpy as np
import pinocchio as pin

from gelenk.kinematics.simd.kernels import chain_measures
from gelenk.kinematics.workspace.workspace import SamplingPlan, Wish, plan, sampled
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.robot import RobotModel
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.benchmarks.server import running
from tests.benchmarks.table import Row
from tests.test_serve import HOST

COUNT, IN_LOOP = 1_000_000, 20_000
ROUNDS = 5
TIP = "panda_link8"


def measure() -> list[Row]:
    """The kernel, the loop and the job."""
    return [*on_one_thread(), *over_http()]


def on_one_thread() -> list[Row]:
    """Round by round, medians."""
    library = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none")
    robot = library.get("panda").robot
    chain = robot.chain("panda_link0", TIP)
    work, _ = plan(chain, Wish(samples=COUNT))
    qs = work.sampling.configurations(0, COUNT)
    rows = np.arange(3)
    full = qs[:IN_LOOP] @ robot.expansion(chain).matrix.T
    tip = robot.frame_id(TIP)
    runs: dict[str, tuple[int, Callable[[], object]]] = {
        "kernel": (COUNT, lambda: chain_measures(chain.flat, qs, rows)),
        "part": (COUNT, lambda: all_parts(work)),
        "loop": (IN_LOOP, lambda: keeping_loop(robot, full, tip, rows)),
    }
    check(chain_measures(chain.flat, qs[:IN_LOOP], rows), keeping_loop(robot, full, tip, rows))
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(ROUNDS):
        for name, (count, run) in runs.items():
            started = time.perf_counter()
            run()
            times[name].append((time.perf_counter() - started) / count)
    kernel, part, loop = (statistics.median(times[name]) for name in ("kernel", "part", "loop"))
    against = f"Python loop over Pinocchio, {loop * 1e6:.2f} µs"
    return [
        Row(
            "workspace: pose + manipulability of 1,000,000 configurations, one thread",
            f"{kernel * 1e6:.3f} µs each",
            against,
            loop / kernel,
            "≥ 10",
        ),
        Row("workspace: the same, drawn and sorted into voxels", f"{part * 1e6:.3f} µs each", against, loop / part),
    ]


def all_parts(work: SamplingPlan) -> None:
    """Every part of a plan, one after the other: configurations, positions, measures and voxels."""
    for k in range(work.parts):
        sampled((work, k))


def keeping_loop(robot: RobotModel, qs: Array, tip: int, rows: Indices) -> tuple[Array, Array, Array]:
    """What a person would write: position, rotation and √det(JJᵀ) of each configuration, kept in arrays."""
    positions, rotations, measures = np.empty((len(qs), 3)), np.empty((len(qs), 3, 3)), np.empty(len(qs))
    model, data = robot.model, robot.data
    for i, q in enumerate(qs):
        pin.computeJointJacobians(model, data, q)
        T = pin.updateFramePlacement(model, data, tip)
        J = pin.getFrameJacobian(model, data, tip, pin.LOCAL_WORLD_ALIGNED)[rows]
        positions[i], rotations[i] = T.translation, T.rotation
        measures[i] = np.sqrt(np.linalg.det(J @ J.T))
    return positions, rotations, measures


def check(ours: tuple[Array, ...], theirs: tuple[Array, ...]) -> None:
    """Both ways lead to the same numbers."""
    for mine, other in zip(ours, theirs, strict=True):
        if np.abs(mine - other).max() > 1e-9:
            raise AssertionError("the two computations differ")


def over_http() -> list[Row]:
    """The job, from the request until its array is here: with the first job's processes to be started, and without."""
    with running("service", "/readyz") as server:
        seconds = [job_seconds(server.port, seed) for seed in range(1 + ROUNDS)]
    return [
        Row("workspace: job of 1,000,000 samples over HTTP, the first one", f"{seconds[0]:.2f} s"),
        Row(
            "workspace: job of 1,000,000 samples over HTTP", f"{statistics.median(seconds[1:]):.2f} s", wanted="seconds"
        ),
    ]


def job_seconds(port: int, seed: int) -> float:
    """One job: posted, watched by its events, its array of 32 MB fetched."""
    started = time.perf_counter()
    connection = http.client.HTTPConnection(HOST, port, timeout=60)
    call = json.dumps({"samples": COUNT, "random_seed": seed, "tip_frame": TIP})
    connection.request("POST", "/v1/robots/panda/workspace", call, {"Content-Type": "application/json"})
    job = json.loads(connection.getresponse().read())
    connection.request("GET", f"/v1/jobs/{job['id']}/events")
    connection.getresponse().read()
    connection.request("GET", f"/v1/jobs/{job['id']}/result", headers={"Accept": "application/x-npy"})
    array = np.load(BytesIO(connection.getresponse().read()))
    connection.close()
    if array.shape != (COUNT, 4):
        raise AssertionError("the array is not what was asked for")
    return time.perf_counter() - started
