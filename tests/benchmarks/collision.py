"""Contacts of the Panda: with itself and ten boxes, and inverse kinematics in shelves and a cage that touches nothing.

The kernels stand against Coal through Pinocchio, on the same pieces. The peer's loop over pairs is Pinocchio's, in C++;
only that over configurations is in Python.
"""

import statistics
import time
from collections.abc import Callable
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pinocchio as pin

from gelenk.collision.cell import cell_in
from gelenk.collision.contact.judge import ContactJudge
from gelenk.collision.contact.kernels import first_contacts, nearest_pairs
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.ik.search.problem import Options, TargetProblem
from gelenk.ik.solve import solve
from gelenk.kinematics.poses.forward import forward_kinematics
from gelenk.operations.robot_bodies import bodies_of
from gelenk.robot.arrays import Array
from gelenk.settings import Settings
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot
from tests.benchmarks.table import Row
from tests.collision.motion_bench_maker import FINGERS, SETS, START, problems

COUNT = 10_000
ROUNDS = 7
PEERS = 200
"""Configurations of a round for the peer, and for single calls."""
SCENES, BATCHES, SPREAD = 25, (100, 1_000), 0.2
"""Scenes of a set, targets in each, and how far configurations are from its goal, [rad]."""


def measure() -> list[Row]:
    """Compare verdicts and clearances, then solve inverse kinematics among the problems of MotionBenchMaker."""
    loaded = Library(Settings().catalogue_dir, Path(mkdtemp())).get("panda")
    return [
        *_verdicts(panda_among_boxes(loaded)),
        *(_solutions(loaded, name, size) for name in SETS for size in BATCHES),
    ]


def _verdicts(world: World) -> list[Row]:
    """Compare verdicts and clearances, round by round."""
    qs = np.random.default_rng(1).uniform(world.chain.lower, world.chain.upper, (COUNT, len(world.chain)))
    some, judge = qs[:PEERS], ContactJudge(world)
    peer, whole = Peer(world, judge), [judge.whole(q) for q in some]
    share, near = (float((first_contacts(world.flat, qs, is_exact=is_exact) >= 0).mean()) for is_exact in (True, False))
    runs: dict[str, Callable[[], object]] = {
        "one": lambda: [first_contacts(world.flat, q[None]) for q in some],
        "batch": lambda: first_contacts(world.flat, qs),
        "spheres": lambda: first_contacts(world.flat, qs, is_exact=False),
        "peer": lambda: [peer.touches(q) for q in whole],
        "distance": lambda: [nearest_pairs(world.flat, q[None]) for q in some],
        "distances": lambda: nearest_pairs(world.flat, qs),
        "peer distance": lambda: [peer.distance(q) for q in whole],
    }
    each = {name: COUNT if name in {"batch", "spheres", "distances"} else PEERS for name in runs}
    times: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(ROUNDS):
        for name, run in runs.items():
            started = time.perf_counter()
            run()
            times[name].append((time.perf_counter() - started) / each[name])
    median = {name: statistics.median(values) * 1e6 for name, values in times.items()}
    return [
        Row(
            f"Panda and 10 boxes, {len(world.flat.pairs)} pairs: {what}",
            f"{median[name]:.2f} µs",
            f"Coal through Pinocchio, {median[other]:.1f} µs",
            median[other] / median[name],
            wanted,
        )
        for name, other, what, wanted in (
            ("one", "peer", f"exact verdict, one call each ({share:.0%} in contact)", "≤ 15 µs"),
            ("batch", "peer", f"exact verdict, {COUNT} at once", "≤ 10 µs"),
            ("spheres", "peer", f"verdict by spheres, {COUNT} at once ({near:.0%} near)", "≤ 1 µs"),
            ("distance", "peer distance", "clearance and nearest points, one call each", "≤ 100 µs"),
            ("distances", "peer distance", f"clearance and nearest points, {COUNT} at once", ""),
        )
    ]


def _solutions(loaded: LoadedRobot, name: str, size: int) -> Row:
    """Solve for tip poses of free configurations around the goals of a set, seeded with its start."""
    rng, robot, chain = np.random.default_rng(2), loaded.robot, loaded.robot.chain(None, None)
    solved, asked, times = 0, 0, list[float]()
    for problem in problems(name)[:SCENES]:
        cell = cell_in(build_world(robot, chain, bodies_of(loaded), problem.obstacles, FINGERS))
        near = problem.goal + rng.normal(0.0, SPREAD, (4 * size, len(chain)))
        qs = np.clip(near, chain.lower, chain.upper)
        qs = qs[~cell.touching(qs)][:size]
        asking = TargetProblem(robot, chain, forward_kinematics(robot, chain, qs).poses, START[None], Options())
        started = time.perf_counter()
        found = solve(asking, cell)
        times.append((time.perf_counter() - started) / len(qs))
        solved, asked = solved + len(found.qs) - int(cell.touching(found.qs).sum()), asked + len(qs)
    what = f"Panda in {name}: ik that touches nothing, {asked} solvable targets in batches of {size}"
    return Row(what, f"{solved / asked:.2%}, {statistics.median(times) * 1e6:.1f} µs", wanted="≥ 99.9 %, ≤ 30 µs")


def panda_among_boxes(loaded: LoadedRobot) -> World:
    """Return the Panda with ten boxes around it, always the same."""
    rng = np.random.default_rng(0)
    root, obstacles = loaded.robot.description.root, []
    for i in range(10):
        T, angle = np.eye(4), 2.0 * np.pi * i / 10
        T[:3, 3] = [*(rng.uniform(0.5, 0.9) * np.array([np.cos(angle), np.sin(angle)])), rng.uniform(0.0, 0.9)]
        size = tuple(rng.uniform(0.05, 0.3, 3).tolist())
        obstacles.append(Obstacle(f"box {i}", (covered_body(f"box {i}", root, "box", size, T),)))
    return build_world(loaded.robot, loaded.robot.chain(None, None), bodies_of(loaded), tuple(obstacles))


class Peer:
    """Pinocchio's own loop over the pairs of a world."""

    def __init__(self, world: World, judge: ContactJudge) -> None:
        self._model, self._data = world.robot.model, world.robot.model.createData()
        self._geometry = pin.GeometryModel()
        for i, (body, shape) in enumerate(zip(world.bodies, judge.shapes, strict=True)):
            frame = self._model.frames[world.robot.frame_id(body.link)]
            place = frame.placement * pin.SE3(body.T_link_body)
            self._geometry.addGeometryObject(pin.GeometryObject(str(i), frame.parentJoint, place, shape))
        for a, b in world.flat.pairs.tolist():
            self._geometry.addCollisionPair(pin.CollisionPair(a, b))
        self._found = self._geometry.createData()

    def touches(self, q: Array) -> bool:
        """Return whether any pair is in contact at a configuration of the whole robot; stops at the first."""
        return bool(pin.computeCollisions(self._model, self._data, self._geometry, self._found, q, True))

    def distance(self, q: Array) -> float:
        """Return the smallest distance."""
        nearest = pin.computeDistances(self._model, self._data, self._geometry, self._found, q)
        return float(self._found.distanceResults[nearest].min_distance)
