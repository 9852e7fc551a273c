"""Errors and their Jacobians against rotation vectors by SciPy and against differences."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.ik.search.linearise import linearise
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS, Direction
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from tests.ik.arms import DECOUPLED, SINGLES, TASKS, catalogue_arm, draw, moved, part, planar_arm, repeated
from tests.oracles import catalogue, dh_columns
from tests.oracles.dh_columns import Table
from tests.oracles.differences import aligned, derivatives, plain
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, of_table, rows

EVERY: dict[str, Task] = {**TASKS, **{single: Task((single,)) for single in SINGLES}}
every_task = pytest.mark.parametrize("task", EVERY.values(), ids=EVERY)

ARM = of_table(rows("standard", DECOUPLED, "RRRRRR"))
CHAIN = ARM.chain(None, None)
TEXTBOOK = Table(True, DECOUPLED, [False] * 6)
QS = draw(CHAIN, 5, seed=3)


def textbook_poses(qs: Array) -> Array:
    """T_base_tip by the table."""
    return np.array([TEXTBOOK.pose(q) for q in qs])


def independent(name: str, chain: Chain) -> Callable[[Array], Array]:
    """T_base_tip as a function of configurations, from the text of the description or from the table."""
    if name in catalogue.TABLES:
        table = dh_columns.from_json(catalogue.dh_table(name))
        return lambda qs: np.array([table.pose(q) for q in qs])
    product = UrdfProduct(catalogue.urdf_text(name))
    return lambda qs: product.poses(chain.base_frame, chain.tip_frame, by_name(chain, qs))


def as_poses(Ts: Array) -> Poses:
    """From homogeneous transforms."""
    return Poses(Ts[:, :3, 3].copy(), Ts[:, :3, :3].copy())


def targets_near(qs: Array, angle: float, axis: Array | None = None) -> Poses:
    """Targets beside the poses of configurations, turned by an angle about a random axis or a given one."""
    rng = np.random.default_rng(8)
    axes = rng.normal(size=(len(qs), 3)) if axis is None else np.tile(axis, (len(qs), 1))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    return moved(as_poses(textbook_poses(qs)), rng.normal(size=(len(qs), 3)), angle * axes)


def rows_of(task: Task) -> list[int]:
    """Which of the six rows count."""
    return [i for i, direction in enumerate(DIRECTIONS) if direction in task.directions]


def is_full(task: Task) -> bool:
    """Whether all six count."""
    return len(task.directions) == 6


def free_axis(task: Task) -> int | None:
    """Which axis of the tip is aligned where one rotation is free."""
    missing = [i for i in range(3) if DIRECTIONS[3 + i] not in task.directions]
    return missing[0] if len(missing) == 1 else None


@every_task
@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-4, 0.7, 2.5, np.pi - 1e-4, np.pi - 1e-9])
def test_the_error_is_the_way_to_the_target(task: Task, angle: float) -> None:
    targets = targets_near(QS, angle)
    es, _ = linearise(CHAIN, targets, QS, task)
    assert es.shape == (len(QS), len(task))
    for e, T, position, R in zip(es, textbook_poses(QS), targets.positions, targets.rotations, strict=True):
        w = Rotation.from_matrix(R @ T[:3, :3].T).as_rotvec()
        axis = free_axis(task)
        if axis is not None:
            a, t = T[:3, axis], R[:, axis]
            normal = np.cross(a, t)
            w = normal * (np.arctan2(np.linalg.norm(normal), a @ t) / np.linalg.norm(normal)) if normal.any() else 0 * a
        expected = np.concatenate((position - T[:3, 3], w if is_full(task) else R.T @ w))
        # Near a half turn SciPy and we may differ by rounding, over the sine of what is left.
        np.testing.assert_allclose(e, expected[rows_of(task)], atol=1e-12 if angle < 3.0 else 1e-6)


@pytest.mark.parametrize("axis", [*np.eye(3), np.array([0.6, 0.0, 0.8]), np.array([1.0, -2.0, 0.5])])
def test_at_a_half_turn_the_error_is_one_of_the_two_ways(axis: Array) -> None:
    targets = targets_near(QS, np.pi, axis)
    es, _ = linearise(CHAIN, targets, QS, Task())
    turned = Rotation.from_rotvec(es[:, 3:]).as_matrix() @ textbook_poses(QS)[:, :3, :3]
    assert np.abs(np.linalg.norm(es[:, 3:], axis=1) - np.pi).max() < 1e-7
    np.testing.assert_allclose(turned, targets.rotations, atol=2e-8)


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("angle", [1e-3, 1.0, 3.0, np.pi])
def test_the_shortest_rotation_brings_an_axis_onto_the_targets(axis: int, angle: float) -> None:
    free: list[Direction] = ["rx", "ry", "rz"]
    del free[axis]
    task = Task(("x", "y", "z", *free))
    square = np.eye(3)[(axis + 1) % 3]
    targets = targets_near(QS, angle, square)
    es, _ = linearise(CHAIN, targets, QS, task)
    Rs = textbook_poses(QS)[:, :3, :3]
    for e, R, goal in zip(es, Rs, targets.rotations, strict=True):
        w = goal @ np.insert(e[3:], axis, 0.0)
        assert np.linalg.norm(w) == pytest.approx(angle, abs=1e-7)
        np.testing.assert_allclose(Rotation.from_rotvec(w).as_matrix() @ R[:, axis], goal[:, axis], atol=1e-7)


@pytest.mark.quick(4)
@every_task
def test_rows_of_the_jacobian_are_derivatives_of_the_pose(task: Task) -> None:
    targets = targets_near(QS, 1.1)
    _, Js = linearise(CHAIN, targets, QS, task)
    assert Js.shape == (len(QS), len(task), 6)
    for q, J, R in zip(QS, Js, targets.rotations, strict=True):
        expected = np.array(derivatives(textbook_poses, q, aligned)).T
        if not is_full(task):
            expected[3:] = R.T @ expected[3:]
        np.testing.assert_allclose(J, expected[rows_of(task)], atol=1e-10)


@every_task
def test_at_the_target_the_error_falls_as_the_jacobian_says(task: Task) -> None:
    for q in QS:
        target = as_poses(textbook_poses(q[None]))
        _, Js = linearise(CHAIN, target, q[None], task)

        def error(qs: Array, target: Poses = target) -> Array:
            return linearise(CHAIN, repeated(target, len(qs)), qs, task)[0]

        slopes = np.array(derivatives(error, q, plain)).T
        np.testing.assert_allclose(slopes, -Js[0], atol=1e-9)


@pytest.mark.parametrize("angle", [0.3, 1.5, 2.7])
@pytest.mark.parametrize("name", ["full", "free about x", "free about y", "free about z", "position", "orientation"])
def test_the_squared_error_falls_along_the_gradient_of_the_course(name: str, angle: float) -> None:
    # ∂(½‖e‖²)/∂q = -Jᵀe, however far the target.
    task = TASKS[name]
    axis = free_axis(task)
    for i, q in enumerate(QS):
        square = None if axis is None else np.eye(3)[(axis + 1) % 3]
        target = part(targets_near(QS, angle, square), slice(i, i + 1))
        es, Js = linearise(CHAIN, target, q[None], task)

        def half_square(qs: Array, target: Poses = target) -> Array:
            found = linearise(CHAIN, repeated(target, len(qs)), qs, task)[0]
            return np.asarray(0.5 * np.square(found).sum(axis=1, keepdims=True))

        slope = np.array(derivatives(half_square, q, plain))[:, 0]
        np.testing.assert_allclose(slope, -Js[0].T @ es[0], atol=1e-7)


def test_in_a_plane_the_rotation_is_the_sum_of_the_joints() -> None:
    _, chain = planar_arm(0.5, 0.4, 0.3)
    q, goal = np.array([0.2, 0.7, -0.4]), np.array([-0.1, 0.4, 0.6])
    textbook = Table(True, [(length, 0, 0, 0) for length in (0.5, 0.4, 0.3)], [False] * 3)
    target = as_poses(textbook.pose(goal)[None])
    es, Js = linearise(chain, target, q[None], TASKS["in the plane"])
    assert es[0, 2] == pytest.approx(goal.sum() - q.sum(), abs=1e-15)
    np.testing.assert_allclose(Js[0, 2], 1.0, atol=1e-15)
    np.testing.assert_allclose(Js[0, :2], textbook.jacobian(q)[:2], atol=1e-15)


@pytest.mark.parametrize("name", ["tiago", "kinova", "scara"])
def test_sliding_and_continuous_joints_too(name: str) -> None:
    _, chain = catalogue_arm(name)
    by_product = independent(name, chain)
    for q, goal in zip(draw(chain, 3), draw(chain, 3, seed=9), strict=True):
        target = as_poses(by_product(goal[None]))
        es, Js = linearise(chain, target, q[None], Task())
        T = by_product(q[None])[0]
        np.testing.assert_allclose(es[0, :3], target.positions[0] - T[:3, 3], atol=1e-12)
        turn = Rotation.from_matrix(target.rotations[0] @ T[:3, :3].T).as_rotvec()
        np.testing.assert_allclose(es[0, 3:], turn, atol=1e-9)
        np.testing.assert_allclose(Js[0], np.array(derivatives(by_product, q, aligned)).T, atol=1e-10)
