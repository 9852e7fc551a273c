"""Laws along random splines of poses: their durations over the time-optimal one.

`python -m tests.trajectory.figures_splines`
"""

import argparse
import time
from collections.abc import Iterator

import numpy as np

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.poses import Poses
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.follow.follow import follow
from gelenk.trajectory.paths.path_geometry import LimitedPath, geometry_of, tip_through
from gelenk.trajectory.paths.segment_paths import path_through
from gelenk.trajectory.problem.problem import Following, Segment, SegmentLimits
from gelenk.trajectory.timing.timing import timed
from tests.robots import robot
from tests.trajectory.arms import ARMS, LAWS, arm

REACH = 0.6
"""Largest difference of a joint between two waypoints, [rad]."""


def geometries(count: int, seed: int = 7) -> Iterator[LimitedPath]:
    """Yield splines of three to six poses that the joints of several arms follow to their ends."""
    rng = np.random.default_rng(seed)
    arms = {name: arm(name) for name in ARMS}
    found = 0
    while found < count:
        name = ARMS[int(rng.integers(len(ARMS)))]
        one = arms[name]
        chain = one.chain
        limits = SegmentLimits(one.velocity, 2.0 * one.velocity, 20.0 * one.velocity)
        qs = [one.configurations(rng, 1, 0.7)[0]]
        for _ in range(int(rng.integers(2, 6))):
            qs.append(np.clip(qs[-1] + rng.uniform(-REACH, REACH, len(chain)), one.lower, one.upper))
        Ts = Poses(*chain_poses(chain.flat, np.array(qs))).matrices()
        segment = Segment("spline", "cubic", limits, poses=Poses(Ts[1:, :3, 3], Ts[1:, :3, :3]))
        path = path_through(Ts[0], [segment], 0)
        joints = follow(robot(name), chain, path.path, qs[0], Following())
        if joints.stop is None:
            found += 1
            yield geometry_of(path.path, joints.positions, limits, tip_through(chain), path.zones)


def main() -> None:
    """Print the ratios by law."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    count = parser.parse_args().count
    ratios: dict[Law, list[float]] = {law: [] for law in LAWS}
    seconds: dict[Law, float] = dict.fromkeys(LAWS, 0.0)
    for geometry in geometries(count):
        durations = {}
        for law in LAWS:
            begin = time.perf_counter()
            durations[law] = timed(geometry, law, slow_down=True).motion.duration
            seconds[law] += time.perf_counter() - begin
        for law in LAWS:
            ratios[law].append(durations[law] / durations["time_optimal"])
    print(f"{'law':14}{'median':>8}{'90 %':>8}{'99 %':>8}{'worst':>8}{'ms':>8}")
    for law, values in ratios.items():
        q = np.quantile(values, [0.5, 0.9, 0.99, 1.0])
        print(f"{law:14}" + "".join(f"{x:8.3f}" for x in q) + f"{1e3 * seconds[law] / count:8.1f}")


if __name__ == "__main__":
    main()
