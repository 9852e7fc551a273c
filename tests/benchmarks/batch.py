"""Pose + Jacobian of the Panda per second on one thread: the kernels against a Python loop over Pinocchio.

The loop calls what a person would call, and keeps the results in arrays as the kernels do; the bare loop throws
them away.
"""

import statistics
import time
from collections.abc import Callable

import numpy as np
import pinocchio as pin

from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.robot import RobotModel
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.benchmarks.table import Row

COUNT = 10_000
ROUNDS = 15


def measure() -> list[Row]:
    """Compare the kernels with both loops, round by round."""
    library = Library(Settings().catalogue_dir, Settings().catalogue_dir / "none")
    robot = library.get("panda").robot
    chain = robot.chain("panda_link0", "panda_link8")
    qs = np.random.default_rng(1).uniform(chain.lower, chain.upper, (COUNT, len(chain)))
    full = qs @ robot.expansion(chain).matrix.T
    tip = robot.frame_id("panda_link8")
    runs: dict[str, Callable[[], object]] = {
        "kernel": lambda: chain_jacobians(chain.flat, qs),
        "poses": lambda: chain_poses(chain.flat, qs),
        "loop": lambda: keeping_loop(robot, full, tip, len(chain)),
        "bare": lambda: bare_loop(robot, full, tip),
    }
    times: dict[str, list[float]] = {name: [] for name in runs}
    for run in runs.values():
        run()
    for _ in range(ROUNDS):
        for name, run in runs.items():
            started = time.perf_counter()
            run()
            times[name].append((time.perf_counter() - started) / COUNT)
    median = {name: statistics.median(values) for name, values in times.items()}
    kernel = median["kernel"]
    return [
        Row(
            "pose + Jacobian, batch of 10,000",
            f"{kernel * 1e6:.3f} µs each",
            f"{what}, {median[name] * 1e6:.2f} µs",
            median[name] / kernel,
            wanted,
        )
        for name, what, wanted in (
            ("loop", "Python loop over Pinocchio", "≥ 8"),
            ("bare", "the same loop, results thrown away", ""),
        )
    ] + [Row("pose alone, batch of 10,000", f"{median['poses'] * 1e6:.3f} µs each")]


def keeping_loop(robot: RobotModel, qs: Array, tip: int, joints: int) -> tuple[Array, Array]:
    """Pose and Jacobian of each configuration, kept in arrays."""
    Ts, Js = np.empty((len(qs), 4, 4)), np.empty((len(qs), 6, joints))
    model, data = robot.model, robot.data
    for i, q in enumerate(qs):
        pin.computeJointJacobians(model, data, q)
        Ts[i] = pin.updateFramePlacement(model, data, tip).homogeneous
        Js[i] = pin.getFrameJacobian(model, data, tip, pin.LOCAL_WORLD_ALIGNED)[:, :joints]
    return Ts, Js


def bare_loop(robot: RobotModel, qs: Array, tip: int) -> None:
    """The same calls, nothing kept."""
    model, data = robot.model, robot.data
    for q in qs:
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacement(model, data, tip)
        pin.getFrameJacobian(model, data, tip, pin.LOCAL_WORLD_ALIGNED)
