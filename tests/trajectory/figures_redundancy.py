"""How many lines arms with seven joints follow to the end, of those that any joint path from the start can do.

`python -m tests.trajectory.figures_redundancy [LINES [SEED [ARM …]]]` prints a row for each arm: lines of 10 to 40 cm
from configurations at random, how many are followed, how many of the others are feasible by the walk over the whole
self-motion in `tests.trajectory.self_motion` (a pose out of reach needs no walk), and the slowest answer.
"""

import sys
import time
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from gelenk.ik.search.task import FULL_POSE
from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.paths.paths import Path, line
from gelenk.trajectory.problem.problem import Following
from tests.robots import robot
from tests.trajectory.self_motion import SelfMotion
from tests.trajectory.test_follow import moved, pose, starts

ARMS = ("panda", "xarm7", "baxter", "pr2", "talos", "tiago_pro", "g1", "icub", "simple_humanoid", "tiago_dual")
_PLACES = 31
"""Places on a line at which the self-motion is walked."""
_LEAST = 0.05
"""Least σ of a start."""


@dataclass
class Lines:
    """Lines of the tip of an arm of the catalogue, each with the configuration at its beginning."""

    name: str
    count: int
    seed: int = 5

    def __post_init__(self) -> None:
        self.robot = robot(self.name)
        self.chain = self.robot.chain(*self.robot.default_chain)

    def jobs(self) -> list[tuple[Path, Array]]:
        found: list[tuple[Path, Array]] = []
        rng = np.random.default_rng(self.seed)
        for q in starts(self.chain, FULL_POSE, self.count, seed=self.seed, least=_LEAST):
            shift, T = rng.normal(size=3), pose(self.chain, q)
            shift *= rng.uniform(0.1, 0.4) / np.linalg.norm(shift)
            found.append((line(T, moved(T, shift, np.zeros(3))), q))
        return found

    def followed(self, path: Path, q: Array) -> FollowedPath:
        return follow(self.robot, self.chain, path, q, Following())

    def is_feasible(self, path: Path, q: Array) -> bool:
        poses = path.at(np.linspace(0.0, path.extent, _PLACES)).poses
        targets = [pin.SE3(R, p) for R, p in zip(poses.rotations, poses.positions, strict=True)]
        walk = SelfMotion(self.robot, self.chain, Following().min_singular_value)
        return walk.share(targets, q) == 1.0


def _row(lines: Lines) -> tuple[int, int, float]:
    followed, missed, slowest = 0, 0, 0.0
    for path, q in lines.jobs():
        began = time.process_time()
        stop = lines.followed(path, q).stop
        slowest = max(slowest, time.process_time() - began)
        followed += stop is None
        if stop is not None and stop.reason != "out_of_reach" and lines.is_feasible(path, q):
            missed += 1
            print(f"missed: {stop.detail}")
    return followed, missed, slowest


def main() -> None:
    numbers, names = [int(number) for number in sys.argv[1:3]], sys.argv[3:] or ARMS
    count, seed = numbers + [100, 5][len(numbers) :]
    print(f"{'arm':16} {'lines':>6} {'feasible':>9} {'followed':>9} {'slowest [s of processor]':>25}")
    total = np.zeros(3)
    for name in names:
        Lines(name, 1).followed(*Lines(name, 1).jobs()[0])
        followed, missed, slowest = _row(Lines(name, count, seed))
        total += count, followed + missed, followed
        print(f"{name:16} {count:6} {followed + missed:9} {followed:9} {slowest:25.2f}", flush=True)
    print(f"{'all':16} {total[0]:6.0f} {total[1]:9.0f} {total[2]:9.0f} {total[2] / max(total[1], 1.0):25.2%}")


if __name__ == "__main__":
    main()
