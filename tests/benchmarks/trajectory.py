"""Trajectories of the Panda, planned, audited and sent, against what plans alone.

From point to point with 1,000 samples: against the calculation of ruckig by itself, and `jtraj` of roboticstoolbox. 1 m
of lines with a corner flown over, a sample each millisecond: against `mstraj` with inverse kinematics of each of its
samples, and against joints by inverse kinematics along the lines, a spline through them, and toppra. And the fastest
motion along five way-points, also within torques, against toppra on the same spline. The peers check nothing; what they
take is their own calculation. Ours is all from the request to the answer's last byte, or in this process from the
checked request to audited and certified samples with poses.
"""

import http.client
import json
import statistics
import time
from collections.abc import Callable
from functools import cache
from io import BytesIO
from typing import Any
from urllib.parse import urlencode

import numpy as np
import ruckig
import toppra
from scipy.spatial.transform import Rotation

from gelenk.contract.trajectory_request import MAX_SAMPLES, TrajectoryRequest
from gelenk.operations.trajectory_planned import PlannedTrajectory, TrajectorySizeLimits
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.settings import Settings
from gelenk.store.library import Library
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.joints.splines import JointSpline
from gelenk.trajectory.problem.problem import FreeTool
from gelenk.trajectory.tool.sequence import tool_sequence
from tests.benchmarks.server import running
from tests.benchmarks.table import Row
from tests.test_serve import HOST
from tests.trajectory.figures_torques import toppra_torques

ROUNDS = 15
SAMPLES, PERIOD = 1000, 1e-3
MOTIONS, LAWS = 1000, ("jerk_limited", "time_optimal")
START = [0.11600954, 0.10720322, -0.70387343, -1.52109506, 0.06933766, 1.60287448, -0.58725217]
TARGET = [-0.4, -0.5, 0.3, -2.2, 0.5, 2.0, 0.9]
POINTS = np.array([[0.5, -0.3, 0.5], [0.5, 0.3, 0.5], [0.5, 0.3, 0.1]])
DOWN = Rotation.from_euler("x", np.pi) * Rotation.from_euler("z", -np.pi / 4)
RADIUS = 0.1
VELOCITY = np.array([2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61])
ACCELERATION = 2.0 * VELOCITY
JERK = 10.0 * ACCELERATION
TORQUE = 0.4 * np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])
TIP_SPEED = 0.5
NPY = "application/x-npy"


@cache
def panda() -> Any:
    """The Panda of a peer."""
    return peer().models.URDF.Panda()


def peer() -> Any:
    """What is installed for the benchmarks that need it alone."""
    import roboticstoolbox

    return roboticstoolbox


def measure() -> list[Row]:
    """Point to point, and the corner."""
    with running("service", "/readyz") as server:
        connection = http.client.HTTPConnection(HOST, server.port, timeout=60)
        rows = [*point_to_point(connection), *many(connection), *corner(connection)]
        connection.close()
    return [*rows, *way(), *way(TORQUE), seam()]


def point_to_point(connection: http.client.HTTPConnection) -> list[Row]:
    """1,000 samples of 7 joints."""
    laws = ("jerk_limited", "time_optimal", "quintic")
    calls = {law: call([{"type": "joint", "target": TARGET}], law) for law in laws}
    for one in calls.values():
        one["sample_period"] = ask(connection, one)["duration"] / (SAMPLES - 1)
    times = medians(
        {
            "here": here(calls["jerk_limited"]),
            "time_optimal": here(calls["time_optimal"]),
            "jerk_limited": lambda: post(connection, calls["jerk_limited"]),
            "npy": lambda: post(connection, calls["jerk_limited"], NPY),
            "quintic": lambda: post(connection, calls["quintic"]),
            "ruckig": ruckig_alone,
            "sampled": lambda: sampled(ruckig_alone()),
            "jtraj": lambda: peer().jtraj(np.array(START), np.array(TARGET), SAMPLES),
        }
    )
    what = "7 joints, 1,000 samples with poses"
    return [
        row(f"jerk-limited, {what}, in process", times, "here", "ruckig", "ruckig alone", wanted="≤ 1.0 ms"),
        row(f"time-optimal, {what}, in process", times, "time_optimal", "ruckig", "ruckig alone", wanted="≤ 1.0 ms"),
        row(f"jerk-limited, {what}, JSON", times, "jerk_limited", "sampled", "ruckig, sampled", wanted="≤ 3.0 ms"),
        row("the same as npy", times, "npy", "sampled", "ruckig, sampled", wanted="≤ 1.5 ms"),
        row(f"quintic, {what}, JSON", times, "quintic", "jtraj", "jtraj, no limits"),
    ]


def many(connection: http.client.HTTPConnection) -> list[Row]:
    """1,000 motions of 7 joints in one call, audited, against one calculation of each after the other."""
    ends, body = np.random.default_rng(0).uniform(-0.4, 0.4, (MOTIONS, 2, 7)) + np.array(START), BytesIO()
    np.save(body, ends)

    def rows(law: str) -> None:
        query = urlencode({"law": law, "limits": json.dumps(limits())})
        headers = {"Content-Type": NPY, "Accept": NPY}
        connection.request("POST", f"/v1/robots/panda/trajectories?{query}", body.getvalue(), headers)
        answer = connection.getresponse()
        content = answer.read()
        assert answer.status == 200, content[:500]

    times = medians(
        {
            "jerk_limited": lambda: rows("jerk_limited"),
            "time_optimal": lambda: rows("time_optimal"),
            "ruckig": lambda: [ruckig_alone() for _ in range(MOTIONS)],
        }
    )
    named, wanted = "ruckig alone, one by one", "≤ 200 ms"
    what = f"{MOTIONS:,} motions of 7 joints, npy"
    return [row(f"{law.replace('_', '-')}, {what}", times, law, "ruckig", named, wanted=wanted) for law in LAWS]


def corner(connection: http.client.HTTPConnection) -> list[Row]:
    """Two lines, 1 m in all."""
    lines: list[dict[str, Any]] = [{"type": "line", "target": pose} for pose in poses()[1:]]
    lines[0]["blend_radius"] = RADIUS
    calls = {law: {**call(lines, law), "sample_period": PERIOD} for law in ("trapezoidal", "time_optimal")}
    limited = {**calls["trapezoidal"], "limits": {**limits(), "tip_velocity": TIP_SPEED}}
    durations = {name: ask(connection, one)["duration"] for name, one in calls.items()}
    durations["limited"] = ask(connection, limited)["duration"]
    times = medians(
        {
            "here": here(calls["time_optimal"]),
            "limited": lambda: post(connection, limited),
            "npy": lambda: post(connection, calls["time_optimal"], NPY),
            "time_optimal": lambda: post(connection, calls["time_optimal"]),
            "mstraj": mstraj,
            "toppra": toppra_alone,
        }
    )
    durations["mstraj"], durations["toppra"] = len(mstraj()) * PERIOD, toppra_alone()[0]
    what = "1 m of lines with a fly-over at 1 kHz"
    return [
        row(f"{what}, trapezoidal, JSON", times, "limited", "mstraj", "mstraj and ik_LM of each sample", durations),
        row(f"{what}, time-optimal, JSON", times, "time_optimal", "toppra", "ik_LM, spline, toppra", durations),
        row(f"{what}, time-optimal, npy", times, "npy", "toppra", "ik_LM, spline, toppra", wanted="≤ 10 ms"),
        row(f"{what}, time-optimal, in process", times, "here", "toppra", "ik_LM, spline, toppra", wanted="≤ 8 ms"),
    ]


def way(torque: Array | None = None) -> list[Row]:
    """The fastest motion along a spline through five way-points; toppra takes the same spline on 1,600 intervals.

    Once in turn with toppra, after which nothing of ours is left in the processor's caches, and once without.
    """
    rng = np.random.default_rng(3)
    line = np.linspace(START, TARGET, 6)
    line[1:-1] += rng.uniform(-0.3, 0.3, (4, 7))
    content = call([{"type": "spline", "waypoints": line[1:].tolist()}], "time_optimal")
    del content["limits"]["joint_jerk"]  # toppra knows none
    if torque is not None:
        content["limits"]["joint_torque"] = torque.tolist()
    planned = here(content)
    segment = planned().question.problem.segments[0]
    knots = JointSpline.of(line[0], segment, planned().chain).path
    grid = np.linspace(knots.breaks[0], knots.breaks[-1], 1601)
    spline = toppra.SplineInterpolator(knots.breaks, knots.at(knots.breaks), bc_type="clamped")
    fastest = toppra.algorithm.TOPPRA(
        toppra_limits(segment.limits.torque), spline, gridpoints=grid, parametrizer="ParametrizeConstAccel"
    )
    times = medians({"here": planned, "toppra": fastest.compute_trajectory}) | medians({"again": planned})
    ours, theirs = planned().found.motion.duration, fastest.compute_trajectory().duration
    within, wanted = ("", "≤ 1 ms, ≤ +0.2 %") if torque is None else (" within torques", "≤ +1 %")
    what = f"time-optimal along 5 way-points of 7 joints{within}, in process"
    more = f"{100.0 * (ours / theirs - 1.0):+.2f} % of the time"
    durations = {"here": ours, "again": ours, "toppra": theirs}
    return [
        row(f"{what}, {how}{more}", times, name, "toppra", "toppra at 1,600 points", durations, wanted)
        for name, how in (("here", ""), ("again", "call after call, "))
    ]


def seam() -> Row:
    """The path of a UR5's tool through 1,000 poses with a free turn: all branches at 36 turns each."""
    a = np.linspace(0.0, 1.5 * np.pi, 1000)
    circle = np.column_stack((0.5 + 0.12 * np.cos(a), 0.12 * np.sin(a), np.full(1000, 0.1)))
    robot = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none").get("ur5").robot
    chain, down = robot.chain(None, None), np.tile(np.diag([1.0, -1.0, -1.0]), (1000, 1, 1))
    tool = FreeTool(np.array([0.0, 0.0, 1.0]), 36)
    times = medians({"here": lambda: tool_sequence(chain, Poses(circle, down), tool, np.full(6, np.pi), 0.01)})
    return Row("trajectory: turns and branches at 1,000 poses", f"{times['here'] * 1e3:.0f} ms", wanted="≤ 500 ms")


def here(content: dict[str, Any]) -> Callable[[], PlannedTrajectory]:
    """What plans, audits, samples and certifies in this process; a motion that exceeds a limit anywhere is refused."""
    robot = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none").get("panda").robot
    request = TrajectoryRequest.model_validate(content)
    bounds = TrajectorySizeLimits(MAX_SAMPLES, 10_000_000)

    def run() -> PlannedTrajectory:
        planned = PlannedTrajectory.of(robot, request, bounds)
        planned.certificate(planned.samples(planned.times()))
        return planned

    run()
    return run


def call(segments: list[dict[str, Any]], law: str) -> dict[str, Any]:
    """A request."""
    return {"start": START, "segments": segments, "law": law, "limits": limits()}


def limits() -> dict[str, Any]:
    """Of the joints."""
    return {
        "joint_velocity": VELOCITY.tolist(),
        "joint_acceleration": ACCELERATION.tolist(),
        "joint_jerk": JERK.tolist(),
    }


def poses() -> list[dict[str, Any]]:
    """The ends of the lines, the tip pointing down."""
    return [{"position": point.tolist(), "quaternion_xyzw": DOWN.as_quat().tolist()} for point in POINTS]


def post(connection: http.client.HTTPConnection, content: object, accept: str = "application/json") -> bytes:
    """The body of an answer that is one."""
    headers = {"Content-Type": "application/json", "Accept": accept}
    connection.request("POST", "/v1/robots/panda/trajectory", json.dumps(content), headers)
    answer = connection.getresponse()
    body = answer.read()
    if answer.status != http.HTTPStatus.OK:
        raise AssertionError(body[:500])
    return body


def ask(connection: http.client.HTTPConnection, content: object) -> dict[str, Any]:
    """A whole answer."""
    answer: dict[str, Any] = json.loads(post(connection, content))
    if answer["completed_fraction"] != 1.0 or not answer["audit"]["passed"]:
        raise AssertionError(answer["failure"])
    return answer


def ruckig_alone() -> ruckig.Trajectory:
    """Its calculation, with what it is made of."""
    planner, given, found = ruckig.Ruckig(7), ruckig.InputParameter(7), ruckig.Trajectory(7)
    given.current_position, given.target_position = START, TARGET
    given.max_velocity, given.max_acceleration, given.max_jerk = VELOCITY, ACCELERATION, JERK
    planner.calculate(given, found)
    return found


def sampled(found: ruckig.Trajectory) -> list[Any]:
    """Position, velocity and acceleration at 1,000 times."""
    return [found.at_time(t) for t in np.linspace(0.0, found.duration, SAMPLES)]


def mstraj() -> Array:
    """The tip's way with a parabolic corner, and the joints of each of its samples, each from the one before."""
    blend = 2.0 * RADIUS / TIP_SPEED
    way = peer().mstraj(POINTS, PERIOD, blend, TIP_SPEED)
    return followed(way.q)


def followed(points: Array) -> Array:
    """Joints by inverse kinematics of the toolbox's compiled Levenberg-Marquardt."""
    T = np.eye(4)
    T[:3, :3] = DOWN.as_matrix()
    chain, q, found = panda().ets(), np.array(START), np.empty((len(points), 7))
    for k, point in enumerate(points):
        T[:3, 3] = point
        q = chain.ik_LM(T, q0=q)[0]
        found[k] = q
    return found


def toppra_alone() -> tuple[float, Array]:
    """Joints along the way at 100 places, a spline through them, the fastest motion along it at 1 kHz."""
    shares = np.linspace(0.0, 1.0, 100)
    joints = followed(rounded(shares))
    path = toppra.SplineInterpolator(shares, joints)
    found = toppra.algorithm.TOPPRA(toppra_limits(), path, parametrizer="ParametrizeConstAccel").compute_trajectory()
    times = np.append(np.arange(0.0, found.duration, PERIOD), found.duration)
    return float(found.duration), np.stack([found(times), found(times, 1), found(times, 2)])


def toppra_limits(torque: TorqueLimits | None = None) -> list[Any]:
    """Of the joints; with torques by Pinocchio, one state after the other."""
    limits = [
        toppra.constraint.JointVelocityConstraint(np.column_stack((-VELOCITY, VELOCITY))),
        toppra.constraint.JointAccelerationConstraint(np.column_stack((-ACCELERATION, ACCELERATION))),
    ]
    if torque is not None:
        limits.append(toppra_torques(torque))
    return limits


def rounded(shares: Array) -> Array:
    """Places on two lines whose corner is a parabola, in shares of the way."""
    before, corner_point, after = POINTS
    lengths = np.linalg.norm(np.diff(POINTS, axis=0), axis=1)
    a, b = (corner_point - before) / lengths[0], (after - corner_point) / lengths[1]
    s = shares * lengths.sum() - lengths[0]
    u = np.clip((s + RADIUS) / (2.0 * RADIUS), 0.0, 1.0)[:, None]
    on_blend = corner_point - RADIUS * (1.0 - u) ** 2 * a + RADIUS * u**2 * b
    straight = corner_point + np.where(s < 0.0, s, 0.0)[:, None] * a + np.where(s > 0.0, s, 0.0)[:, None] * b
    points: Array = np.where((np.abs(s) < RADIUS)[:, None], on_blend, straight)
    return points


def medians(runs: dict[str, Callable[[], object]]) -> dict[str, float]:
    """Seconds of each, in turn again and again."""
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(ROUNDS):
        for name, run in runs.items():
            started = time.perf_counter()
            run()
            times[name].append(time.perf_counter() - started)
    return {name: statistics.median(found) for name, found in times.items()}


def row(
    what: str,
    times: dict[str, float],
    ours: str,
    peer: str,
    named: str,
    durations: dict[str, float] | None = None,
    wanted: str = "",
) -> Row:
    """How much longer theirs takes; and how long the motions last, where that differs."""
    lasts = ["", ""] if durations is None else [f", moves {durations[name]:.2f} s" for name in (ours, peer)]
    return Row(
        f"trajectory: {what}",
        f"{times[ours] * 1e3:.2f} ms{lasts[0]}",
        f"{named}, {times[peer] * 1e3:.2f} ms{lasts[1]}",
        times[peer] / times[ours],
        wanted,
    )
