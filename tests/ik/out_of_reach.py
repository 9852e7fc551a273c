"""Targets from 1 mm to 0.3 m out of the reach of many arms, and how near to them many independent descents come.

`python -m tests.ik.out_of_reach panda full` prints the least distances to the targets of an arm and task.
"""

import sys
import zlib

import numpy as np

from gelenk.ik.search.bounds import target_rows
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.ik.arms import catalogue_arm, draw, limited, poses, table_arm
from tests.oracles.descents import least_distance

# fmt: off
CATALOGUE = [
    "anthropomorphic_wrist", "anthropomorphic", "panda", "panda_dh", "puma560", "scara", "so100", "so101",
    "stanford", "ur10", "ur10_dh", "ur10_joint_limited", "ur3_dh", "ur5", "ur5_joint_limited", "xarm7",
    "xarm7_dh", "z1", "kinova", "spherical_wrist", "baxter", "pr2", "tiago", "talos_left_arm",
    "iris", "planar_3r",
]
# fmt: on
RANDOM = [f"random {number}" for number in range(36)]
"""Arms of four to eight joints, some of which slide; with limits on all joints, on some, or on none that turns."""


def arm_of(name: str) -> tuple[RobotModel, Chain]:
    """A robot of the catalogue or a random arm."""
    if name not in RANDOM:
        return catalogue_arm(name)
    number = RANDOM.index(name)
    rng = np.random.default_rng([77, number])
    n = [6, 6, 6, 7, 5, 6, 7, 4, 6, 8][number % 10]
    rows = [
        (
            float(rng.choice([0.0, 0.05, 0.3, -0.4, 0.6]) * rng.uniform(0.5, 1.5)),
            float(rng.choice([0.0, np.pi / 2, -np.pi / 2, np.pi, 0.6, -1.1])),
            float(rng.choice([0.0, 0.1, 0.3, -0.2]) * rng.uniform(0.5, 1.5)),
            0.0,
        )
        for _ in range(n)
    ]
    types = "".join(rng.choice(list("RRRRRRRP"), n))
    machine, chain = table_arm(rows, types)
    lower, upper = np.full(n, -np.inf), np.full(n, np.inf)
    for j, letter in enumerate(types):
        if letter == "P":
            lower[j], upper[j] = 0.0, rng.uniform(0.1, 0.6)
        elif number % 3 == 0 or (number % 3 == 1 and rng.random() < 0.5):
            span, center = rng.uniform(0.3, 2.8), rng.uniform(-1.0, 1.0)
            lower[j], upper[j] = center - span, center + span
    return machine, limited(chain, lower, upper)


def targets_beyond(name: str, task: str, count: int) -> Poses:
    """Targets in any direction from where the arm comes furthest that way, a third of them 1 mm beyond.

    With the whole pose the tip keeps its orientation on the way there.
    """
    machine, chain = arm_of(name)
    rng = np.random.default_rng(zlib.crc32(f"{name} {task}".encode()))
    qs = draw(chain, count, int(rng.integers(2**31)))
    along = rng.normal(size=(count, 3))
    along /= np.linalg.norm(along, axis=1)[:, None]
    for _ in range(150):
        Js = chain_jacobians(chain.flat, qs)[2]
        slopes = np.einsum("nki,nk->ni", Js[:, :3], along)
        if task == "full":
            turning = Js[:, 3:]
            held = np.linalg.pinv(turning, rcond=1e-6) @ turning
            slopes -= np.einsum("nij,nj->ni", held, slopes)
        qs = np.clip(qs + 0.2 * slopes, chain.lower, chain.upper)
    beyond = 10.0 ** rng.uniform(-3.0, np.log10(0.3), count)
    beyond[::3] = 1e-3
    furthest = poses(machine, chain, qs)
    return Poses(furthest.positions + beyond[:, None] * along, furthest.rotations)


def least_distances(name: str, task: str, targets: Poses) -> Array:
    """The least √(distance² + angle²), of a position the least distance, that 2,000 descents come to; shape (N,)."""
    _, chain = arm_of(name)
    rows = target_rows(targets)
    return np.array(
        [
            least_distance(*chain.flat, chain.lower, chain.upper, row, task == "full", seed=i)[0]
            for i, row in enumerate(rows)
        ]
    )


if __name__ == "__main__":
    wanted = targets_beyond(sys.argv[1], sys.argv[2], 12)
    print(", ".join(f"{distance:.9g}" for distance in least_distances(sys.argv[1], sys.argv[2], wanted)))
