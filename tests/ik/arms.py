"""What the tests of inverse kinematics share: chains, targets that can be reached, and answers looked at anew.

Poses come from Pinocchio, differences of orientations from SciPy; neither from the kernels under test.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pinocchio as pin
from scipy.spatial.transform import Rotation

from gelenk.ik.search.problem import Options, TargetProblem
from gelenk.ik.search.search import MAX_ITERATIONS, Found, search as search_problem
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import Direction
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.robots import of_table, robot, rows

WITHIN = 1e-12
"""How far beyond a limit rounding may put a joint, [rad or m]."""

PLANAR = Task(("x", "y"))
POSITION = Task(("x", "y", "z"))
TASKS: dict[str, Task] = {
    "full": Task(),
    "free about x": Task(("x", "y", "z", "ry", "rz")),
    "free about y": Task(("x", "y", "z", "rx", "rz")),
    "free about z": Task(("x", "y", "z", "rx", "ry")),
    "position": POSITION,
    "orientation": Task(("rx", "ry", "rz")),
    "in the plane": Task(("x", "y", "rz")),
}
SINGLES: tuple[Direction, ...] = ("x", "y", "z", "rx", "ry", "rz")

DECOUPLED = [
    (0.0, np.pi / 2, 0.3, 0.0),
    (0.5, 0.0, 0.0, 0.0),
    (0.0, np.pi / 2, 0.0, 0.0),
    (0.0, -np.pi / 2, 0.4, 0.0),
    (0.0, np.pi / 2, 0.0, 0.0),
    (0.0, 0.0, 0.1, 0.0),
]
UR5 = [
    (0.0, np.pi / 2, 0.089159, 0.0),
    (-0.425, 0.0, 0.0, 0.0),
    (-0.39225, 0.0, 0.0, 0.0),
    (0.0, np.pi / 2, 0.10915, 0.0),
    (0.0, -np.pi / 2, 0.09465, 0.0),
    (0.0, 0.0, 0.0823, 0.0),
]
PUMA = [
    (0.0, np.pi / 2, 0.0, 0.0),
    (0.4318, 0.0, 0.0, 0.0),
    (0.0203, -np.pi / 2, 0.15005, 0.0),
    (0.0, np.pi / 2, 0.4318, 0.0),
    (0.0, -np.pi / 2, 0.0, 0.0),
    (0.0, 0.0, 0.0563, 0.0),
]
IRB = [
    (0.15, -np.pi / 2, 0.475, 0.0),
    (0.6, 0.0, 0.0, -np.pi / 2),
    (0.12, -np.pi / 2, 0.0, 0.0),
    (0.0, np.pi / 2, 0.72, 0.0),
    (0.0, -np.pi / 2, 0.0, 0.0),
    (0.0, 0.0, 0.085, np.pi),
]
"""Proportions of an industrial arm with an offset between its first two axes and at its elbow."""

Q6 = np.array([0.3, 0.6, 0.7, 0.2, 0.9, -0.5])


def problem(chain: Chain, targets: Poses, seeds: Array, **options: Any) -> TargetProblem:
    """A problem for what does without the robot."""
    return TargetProblem(cast(RobotModel, None), chain, targets, seeds, Options(**options))


def search(
    chain: Chain,
    targets: Poses,
    seeds: Array,
    *,
    max_iterations: int = MAX_ITERATIONS,
    threads: int | None = None,
    **options: Any,
) -> Found:
    """The results of the search alone."""
    return search_problem(problem(chain, targets, seeds, **options), max_iterations, threads=threads)


def catalogue_arm(name: str) -> tuple[RobotModel, Chain]:
    """A robot of the catalogue and its default chain."""
    machine = robot(name)
    return machine, machine.chain(None, None)


def table_arm(
    parameters: Sequence[tuple[float, float, float, float]], types: str = "RRRRRR"
) -> tuple[RobotModel, Chain]:
    """The arm of a table by the standard convention."""
    machine = of_table(rows("standard", parameters, types))
    return machine, machine.chain(None, None)


def planar_arm(*lengths: float) -> tuple[RobotModel, Chain]:
    """Links in a plane."""
    return table_arm([(length, 0.0, 0.0, 0.0) for length in lengths], "R" * len(lengths))


def limited(chain: Chain, lower: Array | list[float], upper: Array | list[float]) -> Chain:
    """The chain with other limits."""
    return replace(chain, lower=np.array(lower, dtype=float), upper=np.array(upper, dtype=float))


def draw(chain: Chain, count: int, seed: int = 1) -> Array:
    """Configurations within the limits, ±π where there are none; shape (count, n)."""
    lower = np.where(np.isinf(chain.lower), -np.pi, chain.lower)
    upper = np.where(np.isinf(chain.upper), np.pi, chain.upper)
    return np.random.default_rng(seed).uniform(lower, upper, (count, len(chain)))


def middle(chain: Chain) -> Array:
    """The middle of the limits, 0 where there are none, as the only seed; shape (1, n)."""
    both = np.isfinite(chain.lower) & np.isfinite(chain.upper)
    return np.where(both, 0.5 * (chain.lower + np.where(both, chain.upper, 0.0)), 0.0)[None]


def poses(machine: RobotModel, chain: Chain, qs: Array) -> Poses:
    """T_base_tip as Pinocchio has it."""
    model, data, expansion = machine.model, machine.data, machine.expansion(chain)
    base, tip = machine.frame_id(chain.base_frame), machine.frame_id(chain.tip_frame)
    Ts = np.empty((len(qs), 4, 4))
    for i, q in enumerate(qs):
        pin.framesForwardKinematics(model, data, expansion.offset + expansion.matrix @ q)
        Ts[i] = data.oMf[base].actInv(data.oMf[tip]).homogeneous
    return Poses(Ts[:, :3, 3].copy(), Ts[:, :3, :3].copy())


def part(targets: Poses, chosen: slice | Indices | Flags) -> Poses:
    """Some of the targets."""
    return Poses(targets.positions[chosen], targets.rotations[chosen])


def repeated(targets: Poses, count: int) -> Poses:
    """A single target so many times."""
    return Poses(np.repeat(targets.positions, count, axis=0), np.repeat(targets.rotations, count, axis=0))


def at(x: float, y: float, z: float = 0.0) -> Poses:
    """A single target by its position."""
    return Poses(np.array([[x, y, z]]), np.eye(3)[None])


def moved(targets: Poses, by: Array, turned: Array) -> Poses:
    """Targets shifted in the base's axes and turned about their own by rotation vectors."""
    return Poses(
        targets.positions + by,
        np.ascontiguousarray(targets.rotations @ Rotation.from_rotvec(turned).as_matrix()),
    )


def distances(targets: Poses, others: Poses) -> Array:
    """How far apart each two are, [m]."""
    return np.asarray(np.linalg.norm(targets.positions - others.positions, axis=1))


def angles(targets: Poses, others: Poses) -> Array:
    """The angle between each two, [rad]."""
    return np.asarray(Rotation.from_matrix(targets.rotations.transpose(0, 2, 1) @ others.rotations).magnitude())


def inside(chain: Chain, qs: Array, slack: float = WITHIN) -> Flags:
    """Which configurations keep within the limits; shape (N,)."""
    return np.asarray(((qs >= chain.lower - slack) & (qs <= chain.upper + slack)).all(axis=1))


def same_turn(differences: Array) -> Array:
    """Differences of turning joints up to full turns."""
    return np.asarray(differences - 2.0 * np.pi * np.rint(differences / (2.0 * np.pi)))


def assert_solved(
    machine: RobotModel, chain: Chain, targets: Poses, answer: InverseKinematics, far: float = 1e-6
) -> None:
    """Every target has a solution, within the limits, and Pinocchio finds it there, as far off as the answer says."""
    unsolved = [(i, answer.failures[i].reason) for i, status in enumerate(answer.statuses) if status != "solved"]
    assert not unsolved, unsolved[:3]
    owners = np.repeat(np.arange(len(answer)), np.diff(answer.firsts))
    reached, wanted = poses(machine, chain, answer.qs), part(targets, owners)
    assert distances(wanted, reached).max(initial=0.0) <= far
    assert angles(wanted, reached).max(initial=0.0) <= far
    assert np.abs(distances(wanted, reached) - answer.position_errors).max(initial=0.0) < 1e-14
    assert np.abs(angles(wanted, reached) - answer.orientation_errors).max(initial=0.0) < 1e-14
    assert inside(chain, answer.qs).all()


def contains(table: Array, q: Array | list[float], turns: bool = True, close: float = 1e-7) -> bool:
    """Whether a configuration is among those of a table, up to full turns."""
    difference = table - np.asarray(q)
    return bool((np.abs(same_turn(difference) if turns else difference).max(axis=1, initial=0.0) < close).any())
