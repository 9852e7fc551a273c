"""Compares verdicts with those of Coal on the triangles of meshes: `python -m tests.collision.figures_meshes`.

Arguments: a seed, the number of scenes a robot, and names of robots, else it takes all of the catalogue. Each scene has
`EACH` random configurations; a robot without a body has none. The same seed gives the same scenes; a run that was
stopped goes on with the robots left.
An alarm is a contact of pieces where no triangle touches: because they are larger than the mesh, or because one is
inside of what the triangles enclose. Coal finds these pieces in contact too, or the alarm is unexplained.
"""

import sys
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from gelenk.collision.contact.judge import ContactJudge
from gelenk.collision.contact.kernels import first_contacts, nearest_pairs
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.operations.robot_bodies import bodies_of
from gelenk.robot.arrays import Array
from gelenk.settings import Settings
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot
from tests.collision.arms import random_piece
from tests.collision.coal_peer import TrianglesPeer, drawn_links

EACH = 500
TOUCHING = 1e-6
"""Distance within which either verdict is right, [m]."""
SMALLEST = 0.1
"""Of a robot whose links turn about one point, [m]: objects have a size."""


def random_world(rng: np.random.Generator, loaded: LoadedRobot, own: RobotBodies) -> World:
    """Return a robot among up to ten objects, each near to a link at some configuration; some hang on the tip."""
    robot, chain, description = loaded.robot, loaded.robot.chain(None, None), loaded.robot.description
    others = {
        joint.name: float(rng.uniform(max(joint.limits.lower or 0.0, -np.pi), min(joint.limits.upper or 0.0, np.pi)))
        for joint in description.movable
        if joint.name not in chain.joint_names and joint.type != "continuous"
    }
    alone = build_world(robot, chain, own, (), others)
    judge = ContactJudge(alone)
    spots = np.array([pose.translation for q in draw(rng, alone, 4) for pose in judge.poses(q)])
    size = max(float(np.linalg.norm(spots - spots.mean(axis=0), axis=1).max()), SMALLEST)
    obstacles = []
    for i in range(int(rng.integers(1, 11))):
        is_held, T = bool(rng.random() < 0.1), np.eye(4)
        T[:3, :3] = Rotation.random(random_state=rng).as_matrix()
        T[:3, 3] = rng.normal(size=3) * (0.05 if is_held else 0.3) * size + (0.0 if is_held else rng.choice(spots))
        piece, link = random_piece(rng, 0.3 * size), chain.tip_frame if is_held else description.root
        body = covered_body(f"object {i}", link, piece.kind, piece.size, T, piece.points)
        touch = frozenset(one.name for one in description.links[-4:]) if is_held else frozenset[str]()
        obstacles.append(Obstacle(f"object {i}", (body,), link if is_held else None, touch))
    return build_world(robot, chain, own, tuple(obstacles), others)


def draw(rng: np.random.Generator, world: World, count: int) -> Array:
    """Return configurations within limits, and within a turn; shape (count, n)."""
    lower, upper = np.maximum(world.chain.lower, -np.pi), np.minimum(world.chain.upper, np.pi)
    return rng.uniform(lower, upper, (count, len(lower)))


def compared(world: World, links: Mapping[str, Any], qs: Array) -> tuple[Counter[str], float]:
    """Count verdicts, and return the largest distance of triangles at an alarm, [m]."""
    peer, judge = TrianglesPeer(world, dict(links)), ContactJudge(world)
    counts, largest = Counter[str](), 0.0
    for q, k in zip(qs, first_contacts(world.flat, qs).tolist(), strict=True):
        is_contact = peer.touches(q)
        counts["configurations"] += 1
        counts["contacts"] += is_contact
        if is_contact and k < 0:
            slack = float(nearest_pairs(world.flat, q[None])[0][0])
            counts["touching" if slack <= TOUCHING else "missed"] += 1
            if slack > TOUCHING:
                print("missed by", slack, q.tolist(), flush=True)
        elif k >= 0 and not is_contact:
            a, b = world.flat.pairs[k].tolist()
            excess = max(abs(np.nan_to_num(world.bodies[i].excess, nan=np.inf)) for i in (a, b))
            is_explained = judge.distance(judge.poses(q), k) <= TOUCHING
            counts["alarms" if excess > TOUCHING else "inside" if is_explained else "touching"] += 1
            counts["unexplained"] += not is_explained
            largest = max(largest, peer.gap(world.names[a], world.names[b]))
    return counts, largest


def main(seed: int, scenes: int, names: list[str]) -> None:
    """Print a line for each robot, and the sum."""
    total, worst = Counter[str](), 0.0
    with TemporaryDirectory() as folder:
        library = Library(Settings().catalogue_dir, Path(folder))
        for name in names or library.catalogue_names:
            started, loaded = time.perf_counter(), library.get(name)
            own, links, counts, largest = bodies_of(loaded), drawn_links(loaded), Counter[str](), 0.0
            for scene in range(scenes if own.bodies else 0):
                rng = np.random.default_rng([seed, scene, *name.encode()])
                world = random_world(rng, loaded, own)
                some, gap = compared(world, links, draw(rng, world, EACH))
                counts, largest = counts + some, max(largest, gap)
            total, worst = total + counts, max(worst, largest)
            print(
                f"{name:24} {time.perf_counter() - started:6.1f} s", dict(counts), f"gap ≤ {largest:.3f} m", flush=True
            )
    print(dict(total), f"gap ≤ {worst:.3f} m, missed: {total['missed']}")


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:])
