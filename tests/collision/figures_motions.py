"""Counts motions that touch although the continuous check calls them free, and other faults of it.

`python -m tests.collision.figures_motions N seed`: N random motions of robots of the catalogue, in scenes of ten random
boxes, against a hundred times as many samples as the check has looked at places.
"""

import sys
import time
from collections.abc import Iterator

import numpy as np

from gelenk.collision.contact.world import World, build_world
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.operations.robot_bodies import bodies_of
from gelenk.package_data import catalogue
from gelenk.robot.robot import RobotModel
from gelenk.store.records import load, read_record
from tests.collision.motions import checked, random_motion

ROBOTS = ("panda", "ur5", "xarm7", "kinova", "z1", "ur10")
_EACH = 20
"""Motions in a scene."""


def worlds(rng: np.random.Generator) -> Iterator[tuple[str, World]]:
    """Yield robots in scenes without end."""
    loaded = {name: load(record) for name in ROBOTS if (record := read_record(catalogue() / name, "catalogue"))}
    while True:
        for name, one in loaded.items():
            scene = tuple(_box(rng, i, one.robot) for i in range(10))
            yield name, build_world(one.robot, one.robot.chain(None, None), bodies_of(one), scene)


def _box(rng: np.random.Generator, i: int, robot: RobotModel) -> Obstacle:
    T = np.eye(4)
    while np.linalg.norm(T[:2, 3]) < 0.4:
        T[:3, 3] = rng.uniform((-1.0, -1.0, -0.2), (1.0, 1.0, 1.2))
    name = f"box {i}"
    size = tuple(rng.uniform(0.05, 0.3, 3).tolist())
    return Obstacle(name, (covered_body(name, robot.description.root, "box", size, T),))


def main(count: int = 10_000, seed: int = 0) -> None:
    """Print the number of motions, of those in contact, and of those at fault; and how long the checks took."""
    rng, touching, wrong, looks = np.random.default_rng(seed), 0, 0, []
    began, done = time.monotonic(), 0
    for name, world in worlds(rng):
        for _ in range(min(_EACH, count - done)):
            motion = random_motion(rng, world.chain)
            found = checked(world.flat, motion)
            touching += bool(np.isfinite(found.free_until))
            looks.append(found.least.looks)
            wrong += bool(found.faults)
            done += 1
            if found.faults:
                print(name, done, *found.faults, flush=True)
        if done >= count:
            break
    print(f"{done} motions, {touching} in contact, {wrong} at fault; {np.median(looks):.0f} places looked at (median)")
    print(f"{time.monotonic() - began:.0f} s")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
