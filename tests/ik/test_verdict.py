"""Why a target has no solution: what is said must be so, whoever checks it."""

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from gelenk.errors import counted
from gelenk.ik.closed.closed_form import closed_form
from gelenk.ik.search.problem import DescentRule
from gelenk.ik.search.reach import Reach
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import StepMethod
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics, UnsolvedTarget
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.ik.arms import (
    DECOUPLED,
    PLANAR,
    POSITION,
    Q6,
    TASKS,
    UR5,
    angles,
    assert_solved,
    at,
    catalogue_arm,
    distances,
    draw,
    inside,
    limited,
    middle,
    moved,
    part,
    planar_arm,
    poses,
    repeated,
    same_turn,
    table_arm,
)
from tests.robots import robot

TWO = planar_arm(1.0, 0.7)
START = np.array([[0.1, 0.4]])


def ask(target: Poses, task: Task = PLANAR, **options: object) -> InverseKinematics:
    """What the blackboard's two links make of a target."""
    return inverse_kinematics(*TWO, target, START, Options(task=task, **options))  # type: ignore[arg-type]


def check_nearest(
    machine: RobotModel, chain: Chain, target: Poses, failure: UnsolvedTarget, task: Task = FULL_POSE
) -> None:
    """The nearest configuration is within the limits and as far off as it is said to be, in what counts."""
    reached = poses(machine, chain, failure.nearest[None])
    assert inside(chain, failure.nearest[None], 1e-9).all()
    assert distances(target, reached)[0] == pytest.approx(failure.position_error, abs=1e-12)
    angle = angles(target, reached)[0] if task is FULL_POSE else 0.0
    assert angle == pytest.approx(failure.orientation_error, abs=1e-7)


# Reach


@pytest.mark.parametrize("angle", [0.0, 0.4, -2.8])
@pytest.mark.parametrize("radius", [1.7, 0.3])
def test_at_the_boundary_of_reach(radius: float, angle: float) -> None:
    target = at(radius * np.cos(angle), radius * np.sin(angle))
    for task in (PLANAR, POSITION):
        answer = ask(target, task)
        assert answer.statuses == ["solved"]
        assert distances(target, poses(*TWO, answer.qs))[0] <= 1e-6


@pytest.mark.parametrize("beyond", [5e-6, 1e-5, 1e-3, 0.1, 1.0, 1e3, 1e5])
def test_out_of_reach(beyond: float) -> None:
    target = at((1.7 + beyond) * np.cos(0.4), (1.7 + beyond) * np.sin(0.4))
    answer = ask(target)
    assert answer.statuses == ["unreachable"]
    failure = answer.failures[0]
    assert failure.position_error == pytest.approx(beyond, rel=1e-6)
    assert "beyond reach" in failure.reason
    np.testing.assert_allclose(failure.nearest, [0.4, 0.0], atol=2e-3)
    check_nearest(*TWO, target, failure, PLANAR)
    directions = failure.unserved_directions
    assert directions is not None
    if beyond <= 0.1:
        np.testing.assert_allclose(np.abs(directions), [[np.cos(0.4), np.sin(0.4), 0, 0, 0, 0]], atol=5e-3)


@pytest.mark.parametrize("short", [5e-6, 1e-5, 1e-3, 0.1, 0.3])
@pytest.mark.parametrize("task", [PLANAR, POSITION], ids=["plane", "space"])
def test_in_the_hole(task: Task, short: float) -> None:
    target = at((0.3 - short) * np.cos(0.4), (0.3 - short) * np.sin(0.4))
    answer = ask(target, task)
    assert answer.statuses == ["unreachable"]
    assert answer.failures[0].position_error == pytest.approx(short, rel=1e-6)
    if task is POSITION:
        assert "at least 0.3 m" in answer.failures[0].reason


@pytest.mark.parametrize("radius", [0.0, 0.05, 0.09, 1.91, 2.5])
def test_the_hole_of_three_links(radius: float) -> None:
    machine, chain = planar_arm(1.0, 0.7, 0.2)
    target = at(radius * np.cos(1.0), radius * np.sin(1.0))
    answer = inverse_kinematics(machine, chain, target, middle(chain) + 0.3, Options(task=POSITION))
    assert answer.statuses == ["unreachable"]
    failure = answer.failures[0]
    assert failure.position_error == pytest.approx(max(0.1 - radius, radius - 1.9), abs=1e-9)
    check_nearest(machine, chain, target, failure, POSITION)


@pytest.mark.parametrize("radius", [0.1, 0.101, 0.5, 1.899, 1.9])
def test_between_hole_and_boundary_of_three_links(radius: float) -> None:
    machine, chain = planar_arm(1.0, 0.7, 0.2)
    target = at(radius * np.cos(1.0), radius * np.sin(1.0))
    answer = inverse_kinematics(machine, chain, target, middle(chain) + 0.3, Options(task=POSITION))
    assert answer.statuses == ["solved"]
    assert distances(target, poses(machine, chain, answer.qs))[0] <= 1e-6


@pytest.mark.parametrize("method", ["newton", "gradient", "damped_least_squares"])
def test_a_single_method_knows_about_reach_too(method: StepMethod) -> None:
    answer = ask(at(3.0, 0.0), method=method)
    assert answer.statuses == ["unreachable"]
    assert "1.3 m more than the links allow" in answer.failures[0].reason


def test_far_targets_in_a_batch_leave_the_others_alone() -> None:
    machine, chain = catalogue_arm("panda")
    targets = poses(machine, chain, draw(chain, 300))
    far = np.arange(300) % 5 == 0
    mixed = Poses(targets.positions + 4.0 * far[:, None], targets.rotations)
    answer = inverse_kinematics(machine, chain, mixed, middle(chain), Options())
    assert answer.statuses == ["unreachable" if hopeless else "solved" for hopeless in far]
    assert sorted(answer.failures) == np.flatnonzero(far).tolist()
    assert answer.verdicts == {"solved": 240, "unreachable": 60}
    np.testing.assert_array_equal(np.diff(answer.firsts), 1 - far)
    for i in np.flatnonzero(far).tolist():
        check_nearest(machine, chain, part(mixed, slice(i, i + 1)), answer.failures[i])
        bound = np.linalg.norm(mixed.positions[i]) - 1.5
        assert answer.failures[i].position_error >= bound


@pytest.mark.parametrize("tolerance", [0.3, 0.7])
def test_a_loose_orientation_gives_room_for_the_position(tolerance: float) -> None:
    machine, chain = planar_arm(1.0, 0.7, 0.3)
    # With the last link turned by half the tolerance the wrist comes back within reach.
    stretched = poses(machine, chain, np.array([[0.0, 0.3, 0.6 - tolerance / 2]]))
    target = moved(stretched, np.zeros((1, 3)), np.array([[0.0, 0.0, tolerance / 2]]))
    straight = poses(machine, chain, np.array([[0.0, 0.0, 0.6]]))
    target = moved(straight, np.array([[0.01, 0.0, 0.0]]), np.zeros((1, 3)))
    witness = least_squares(
        lambda q: (poses(machine, chain, q[None]).positions - target.positions)[0], [0.0, 0.1, 0.4], xtol=1e-15
    ).x
    reached = poses(machine, chain, witness[None])
    assert distances(target, reached)[0] < 1e-5
    assert angles(target, reached)[0] < tolerance
    options = Options(position_tolerance=1e-4, orientation_tolerance=tolerance)
    assert inverse_kinematics(machine, chain, target, np.full((1, 3), 0.1), options).statuses == ["solved"]


@pytest.mark.parametrize(
    ("name", "tolerance"),
    [(name, tolerance) for name in ("so100", "so101", "scara") for tolerance in (0.05, 0.3, 1.0)],
)
def test_few_joints_use_what_a_loose_orientation_allows(name: str, tolerance: float) -> None:
    machine, chain = catalogue_arm(name)
    count = 60
    known = poses(machine, chain, middle(chain) + 0.8 * (draw(chain, count) - middle(chain)))
    turned = np.random.default_rng(1).normal(size=(count, 3))
    turned *= 0.6 * tolerance / np.linalg.norm(turned, axis=1)[:, None]
    targets = moved(known, np.zeros((count, 3)), turned)
    options = Options(position_tolerance=1e-4, orientation_tolerance=tolerance)
    answer = inverse_kinematics(machine, chain, targets, middle(chain), options)
    assert answer.statuses == ["solved"] * count
    reached = poses(machine, chain, answer.qs)
    assert distances(targets, reached).max() <= 1e-4
    assert angles(targets, reached).max() <= tolerance
    assert inside(chain, answer.qs).all()


@pytest.mark.parametrize("tolerance", [1e-9, 1e-3, 0.5, 2.0, 2.5, 3.1])
def test_any_tolerance_is_kept(tolerance: float) -> None:
    machine, chain = catalogue_arm("ur5")
    targets = poses(machine, chain, draw(chain, 60))
    options = Options(position_tolerance=min(tolerance, 1.0), orientation_tolerance=tolerance)
    answer = inverse_kinematics(machine, chain, targets, middle(chain), options)
    assert answer.statuses == ["solved"] * 60
    reached = poses(machine, chain, answer.qs)
    assert distances(targets, reached).max() <= min(tolerance, 1.0)
    assert angles(targets, reached).max() <= tolerance + 1e-8


# Singularities


SINGULAR = {
    "wrist": [0.3, 0.6, 0.7, 0.2, 0.0, -0.5],
    "elbow": [0.3, 0.6, np.pi / 2, 0.2, 0.9, -0.5],
    "elbow folded": [0.3, 0.6, -np.pi / 2, 0.2, 0.9, -0.5],
    "elbow and wrist": [0.3, 0.6, np.pi / 2, 0.2, 0.0, -0.5],
    "zero": [0.0] * 6,
}


@pytest.mark.parametrize("q", SINGULAR.values(), ids=SINGULAR)
@pytest.mark.parametrize("arm", ["decoupled", "ur5"])
def test_targets_at_singularities_are_solved(arm: str, q: list[float]) -> None:
    machine, chain = table_arm(DECOUPLED if arm == "decoupled" else UR5)
    target = poses(machine, chain, np.array([q]))
    for seed in (np.zeros((1, 6)), np.full((1, 6), 0.7), np.array([q])):
        answer = inverse_kinematics(machine, chain, target, seed, Options())
        assert_solved(machine, chain, target, answer)


def test_targets_above_the_shoulder_are_solved() -> None:
    machine, chain = table_arm(DECOUPLED)
    # The wrist's centre on the first axis: the second joint undoes what the third bends.
    q3 = 1.4
    bend = q3 - np.pi / 2
    q2 = np.pi / 2 - np.arctan2(0.4 * np.sin(bend), 0.5 + 0.4 * np.cos(bend))
    q = np.array([[0.3, q2, q3, 0.2, 0.9, -0.5]])
    target = poses(machine, chain, q)
    wrist = target.positions[0] - 0.1 * target.rotations[0, :, 2]
    assert np.hypot(wrist[0], wrist[1]) < 1e-12
    for seed in (np.zeros((1, 6)), np.full((1, 6), 0.7)):
        assert_solved(machine, chain, target, inverse_kinematics(machine, chain, target, seed, Options()))


@pytest.mark.parametrize("method", ["newton", "gradient", "damped_least_squares"])
def test_a_singular_start_is_told_as_singular(method: StepMethod) -> None:
    answer = inverse_kinematics(*TWO, at(0.5, 0.0), np.zeros((1, 2)), Options(task=PLANAR, method=method))
    assert answer.statuses == ["singular"]
    directions = answer.failures[0].unserved_directions
    assert directions is not None
    np.testing.assert_allclose(np.abs(directions), [[1, 0, 0, 0, 0, 0]], atol=1e-9)
    assert answer.paths is not None
    assert answer.paths[0].stop_reason in {"near_singular", "stagnated"}


@pytest.mark.parametrize("start", [1e-6, 1e-9, 1e-11, 1e-13, 0.0])
def test_newton_from_almost_singular_starts_always_comes_to_an_end(start: float) -> None:
    answer = inverse_kinematics(*TWO, at(0.9, 0.8), np.array([[0.3, start]]), Options(task=PLANAR, method="newton"))
    if answer.statuses == ["solved"]:
        assert distances(at(0.9, 0.8), poses(*TWO, answer.qs))[0] <= 1e-6
        assert inside(TWO[1], answer.qs).all()
    else:
        assert answer.statuses[0] in {"singular", "not_converged"}


@pytest.mark.parametrize("types", ["P", "PP"])
def test_a_diverging_gradient_is_not_converged(types: str) -> None:
    parameters = [(0.0, np.pi / 2, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)][: len(types)]
    machine, chain = table_arm(parameters, types)
    options = Options(
        task=POSITION, method="gradient", rule=DescentRule("gradient", step_size=3.0), respect_limits=False
    )
    target = poses(machine, chain, np.full((1, len(types)), 0.7))
    answer = inverse_kinematics(machine, chain, target, np.full((1, len(types)), 0.1), options)
    assert answer.statuses == ["not_converged"]


# Half turns


@pytest.mark.quick(8)
@pytest.mark.parametrize("axis", [*np.eye(3), None], ids=["x", "y", "z", "random"])
@pytest.mark.parametrize("name", ["spherical_wrist", "ur5", "panda", "puma560", "kinova"])
def test_a_half_turn_away(name: str, axis: Array | None) -> None:
    machine, chain = catalogue_arm(name)
    seeds = draw(chain, 25, seed=61)
    axes = np.random.default_rng(6).normal(size=(25, 3)) if axis is None else np.tile(axis, (25, 1))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    targets = moved(poses(machine, chain, seeds), np.zeros((25, 3)), np.pi * axes)
    turned = Task(("rx", "ry", "rz"))
    answer = inverse_kinematics(machine, chain, targets, seeds, Options(task=turned))
    assert answer.statuses == ["solved"] * 25
    assert angles(targets, poses(machine, chain, answer.qs)).max() <= 1e-6
    for free in range(3):
        directions = ["rx", "ry", "rz"]
        del directions[free]
        task = Task(("x", "y", "z", *directions)) if name != "spherical_wrist" else Task(tuple(directions))  # type: ignore[arg-type]
        pointed = inverse_kinematics(machine, chain, targets, seeds, Options(task=task))
        for i, status in enumerate(pointed.statuses):
            if status == "solved":
                reached = poses(machine, chain, pointed.qs[pointed.firsts[i]][None])
                chord = reached.rotations[0, :, free] - targets.rotations[i, :, free]
                assert np.linalg.norm(chord) < 1.1e-6


# Limits


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["panda", "z1", "puma560", "kinova", "talos_left_arm", "stanford"])
def test_what_limits_keep_from_being_solved_is_solved_without_them(name: str) -> None:
    machine, chain = catalogue_arm(name)
    lower = np.where(np.isinf(chain.lower), -np.pi, chain.lower)
    upper = np.where(np.isinf(chain.upper), np.pi, chain.upper)
    shares = np.random.default_rng(7).uniform(-0.15, 1.15, (80, len(chain)))
    targets = poses(machine, chain, lower + shares * (upper - lower))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options())
    blocked = [i for i, status in enumerate(answer.statuses) if status == "outside_limits"]
    assert len(blocked) >= 3
    assert set(answer.statuses) <= {"solved", "outside_limits"}
    for i in blocked:
        failure, target = answer.failures[i], part(targets, slice(i, i + 1))
        check_nearest(machine, chain, target, failure)
        wider_lower, wider_upper = chain.lower.copy(), chain.upper.copy()
        assert failure.blocking_joints
        for joint in failure.blocking_joints:
            j = chain.joint_names.index(joint.name)
            assert (joint.lower, joint.upper) == (chain.lower[j], chain.upper[j])
            assert joint.excess > 0.0
            if joint.position < joint.lower:
                assert joint.excess == pytest.approx(joint.lower - joint.position)
                wider_lower[j] -= joint.excess
            else:
                assert joint.excess == pytest.approx(joint.position - joint.upper)
                wider_upper[j] += joint.excess
            assert joint.name in failure.reason
        wider = limited(chain, wider_lower, wider_upper)
        assert_solved(machine, wider, target, inverse_kinematics(machine, wider, target, middle(wider), Options()))
    freed = inverse_kinematics(
        machine, chain, part(targets, np.array(blocked)), middle(chain), Options(respect_limits=False)
    )
    assert freed.statuses == ["solved"] * len(blocked)


def test_the_excess_of_two_links_is_the_closed_forms() -> None:
    machine, chain = TWO
    narrow = limited(chain, [-1.0, -1.0], [1.0, 1.2])
    # Elbow up wants 1.599371644064 of joint 2, elbow down 1.346698710425 of joint 1 and -1.599371644064 of joint 2.
    answer = inverse_kinematics(machine, narrow, at(0.9, 0.8), np.zeros((1, 2)), Options(task=PLANAR))
    assert answer.statuses == ["outside_limits"]
    (joint,) = answer.failures[0].blocking_joints
    assert joint.name == chain.joint_names[1]
    assert joint.position == pytest.approx(1.599371644064, abs=1e-6)
    assert joint.excess == pytest.approx(0.399371644064, abs=1e-6)
    other = limited(chain, [-1.0, -1.3], [1.2, 1.0])
    answer = inverse_kinematics(machine, other, at(0.9, 0.8), np.zeros((1, 2)), Options(task=PLANAR))
    first, second = answer.failures[0].blocking_joints
    assert first.excess == pytest.approx(0.146698710425, abs=1e-6)
    assert second.excess == pytest.approx(0.299371644064, abs=1e-6)


@pytest.mark.slow
def test_the_nearest_pose_within_limits_is_the_nearest() -> None:
    machine, chain = catalogue_arm("z1")
    rng = np.random.default_rng(8)
    shares = rng.uniform(-0.3, 1.3, (25, 6))
    targets = poses(machine, chain, chain.lower + shares * (chain.upper - chain.lower))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options())
    compared = 0
    for i, failure in list(answer.failures.items())[:6]:
        ours, best = nearest_by_scipy(machine, chain, part(targets, slice(i, i + 1)), failure.nearest, rng)
        assert ours <= best * 1.001 + 1e-12
        compared += 1
    assert compared >= 4


def test_a_joint_at_its_limit_stops_a_single_method() -> None:
    machine, chain = TWO
    narrow = limited(chain, [-0.1, -1.0], [0.1, 1.0])
    for method in ("gradient", "damped_least_squares"):
        options = Options(task=PLANAR, method=method)
        answer = inverse_kinematics(machine, narrow, at(-0.5, 1.2), np.zeros((1, 2)) + 0.05, options)
        assert answer.statuses == ["not_converged"]
        assert answer.paths is not None
        assert answer.paths[0].stop_reason == "at_limits"
        assert "joint_1" in answer.failures[0].reason
        assert inside(narrow, answer.failures[0].nearest[None], 0.0).all()


def test_a_joint_at_its_limit_is_named_and_within_whatever_the_seed() -> None:
    machine, chain = catalogue_arm("panda")
    targets = poses(machine, chain, draw(chain, 50))
    options = Options(method="damped_least_squares")
    answer = inverse_kinematics(machine, chain, targets, np.full((1, 7), -2e3 * np.pi), options)
    reasons = [failure.reason for failure in answer.failures.values() if "joints at their limits" in failure.reason]
    assert len(reasons) > 10
    assert not [reason for reason in reasons if reason.endswith(": ")]
    assert inside(chain, answer.qs, 0.0).all()


# Fewer joints than directions


def residual(machine: RobotModel, chain: Chain, target: Poses, q: Array) -> Array:
    """Metres and radians alike, the rotation as 2 sin(θ/2) times its axis."""
    reached = poses(machine, chain, q[None])
    w = Rotation.from_matrix(target.rotations[0] @ reached.rotations[0].T).as_rotvec()
    angle = float(np.linalg.norm(w))
    return np.concatenate(
        (target.positions[0] - reached.positions[0], w * (2 * np.sin(angle / 2) / angle if angle else 1.0))
    )


def nearest_by_scipy(
    machine: RobotModel, chain: Chain, target: Poses, q: Array, rng: np.random.Generator
) -> tuple[float, float]:
    """½‖e‖² of a configuration, and the least that SciPy finds from many starts."""
    ours = 0.5 * float(np.square(residual(machine, chain, target, q)).sum())
    best = min(
        least_squares(
            lambda q: residual(machine, chain, target, q),
            rng.uniform(chain.lower, chain.upper),
            bounds=(chain.lower, chain.upper),
            xtol=1e-10,
            ftol=1e-10,
        ).cost
        for _ in range(20)
    )
    return ours, float(best)


@pytest.mark.slow
def test_an_arm_of_five_joints_comes_as_near_to_a_full_pose_as_any() -> None:
    machine, chain = catalogue_arm("so100")
    rng = np.random.default_rng(3)
    count = 8
    targets = moved(
        poses(machine, chain, draw(chain, count, seed=3)),
        0.03 * rng.normal(size=(count, 3)),
        0.8 * rng.normal(size=(count, 3)),
    )
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options())
    assert answer.statuses == ["unreachable"] * count
    for i in range(count):
        failure, target = answer.failures[i], part(targets, slice(i, i + 1))
        check_nearest(machine, chain, target, failure)
        ours, best = nearest_by_scipy(machine, chain, target, failure.nearest, rng)
        assert ours <= best * 1.0001
        directions = failure.unserved_directions
        assert directions is not None
        assert len(directions) >= 1
        np.testing.assert_allclose(directions @ directions.T, np.eye(len(directions)), atol=1e-9)
        J = jacobians(machine, chain, failure.nearest[None]).values[0]
        held = (failure.nearest <= chain.lower + 1e-9) | (failure.nearest >= chain.upper - 1e-9)
        assert np.abs(directions @ J[:, ~held]).max() < 2e-3 * np.linalg.norm(J, 2)
        # With as many directions as joints that are free to move, they are all that is left.
        assert len(directions) >= 6 - int((~held).sum())


def test_a_pointing_arm_of_five_joints_loses_nothing_that_counts() -> None:
    machine, chain = catalogue_arm("so100")
    targets = poses(machine, chain, draw(chain, 30))
    targets = moved(targets, np.zeros((30, 3)), np.outer(np.linspace(-2, 2, 30), np.eye(3)[2]))
    task = Task(("x", "y", "z", "rx", "ry"))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(task=task))
    assert answer.statuses == ["solved"] * 30
    full = inverse_kinematics(machine, chain, targets, middle(chain), Options())
    assert full.statuses.count("solved") < 5


def test_unserved_directions_of_a_partial_task_are_in_the_base() -> None:
    machine, chain = table_arm(UR5)
    narrow = limited(chain, Q6 - 0.05, Q6 + 0.05)
    target = moved(poses(machine, narrow, Q6[None]), np.array([[0.0, 0.0, 0.4]]), np.array([[1.0, 0.3, 0.2]]))
    task = Task(("x", "y", "z", "rx", "ry"))
    answer = inverse_kinematics(machine, narrow, target, Q6[None], Options(task=task))
    directions = answer.failures[0].unserved_directions
    assert answer.statuses[0] in {"outside_limits", "unreachable"}
    if directions is not None and len(directions):
        np.testing.assert_allclose(np.linalg.norm(directions, axis=1), 1.0, atol=1e-9)
        # Turns about the target's free axis do not count.
        np.testing.assert_allclose(directions[:, 3:] @ target.rotations[0, :, 2], 0.0, atol=1e-9)


# Budgets


@pytest.mark.parametrize("name", ["panda", "ur5", "puma560", "so100", "talos_left_arm"])
@pytest.mark.parametrize("budget", [1, 20, 100])
def test_a_small_budget_never_calls_a_target_unreachable_that_can_be_reached(name: str, budget: int) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 200, seed=62))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(max_iterations=budget))
    assert set(answer.statuses) <= {"solved", "not_converged"}
    if closed_form(chain) is None:
        assert answer.statuses.count("not_converged") > (0 if budget < 100 else -1)
    else:
        assert set(answer.statuses) == {"solved"}
    for i, failure in answer.failures.items():
        assert "allow more iterations" in failure.reason
        check_nearest(machine, chain, part(targets, slice(i, i + 1)), failure)


def test_with_few_starts_the_nearest_pose_keeps_within_the_limits() -> None:
    machine, chain = TWO
    narrow = limited(chain, [1.0, 1.0], [2.0, 2.0])
    target = poses(machine, chain, np.zeros((1, 2)))
    options = Options(task=PLANAR, max_iterations=20)
    answer = inverse_kinematics(machine, narrow, target, np.full((1, 2), 1.5), options)
    assert answer.statuses == ["not_converged"]
    assert inside(narrow, answer.failures[0].nearest[None]).all()


def test_no_time_is_not_converged() -> None:
    machine, chain = catalogue_arm("panda")
    many = repeated(poses(machine, chain, draw(chain, 500)), 8)
    answer = inverse_kinematics(machine, chain, many, middle(chain), Options(time_limit=0.0))
    late = [i for i, status in enumerate(answer.statuses) if status != "solved"]
    assert len(late) > 1000
    assert {answer.statuses[i] for i in late} == {"not_converged"}
    assert "time limit" in answer.failures[late[0]].reason
    every = inverse_kinematics(
        machine, chain, part(many, slice(0, 3)), middle(chain), Options(every=True, time_limit=-1.0)
    )
    assert every.complete == [False] * 3
    single = inverse_kinematics(
        machine, chain, part(many, slice(0, 3)), middle(chain), Options(method="newton", time_limit=-1.0)
    )
    assert single.statuses == ["not_converged"] * 3
    assert "time limit" in single.failures[2].reason


def test_without_time_the_nearest_pose_keeps_within_the_limits() -> None:
    machine, chain = catalogue_arm("panda")
    many = repeated(poses(machine, chain, draw(chain, 500)), 8)
    answer = inverse_kinematics(machine, chain, many, middle(chain), Options(time_limit=0.0))
    assert inside(chain, answer.failures[max(answer.failures)].nearest[None]).all()


@pytest.mark.parametrize("method", ["newton", "gradient", "gradient_then_newton", "damped_least_squares"])
@pytest.mark.parametrize("most", [1, 2])
def test_few_steps_are_not_converged(method: StepMethod, most: int) -> None:
    answer = ask(at(0.9, 0.8), method=method, max_iterations=most)
    assert answer.statuses == ["not_converged"]
    assert answer.paths is not None
    assert answer.paths[0].stop_reason == "iterations"
    assert f"after {counted(most, 'iteration')}" in answer.failures[0].reason


def test_the_reach_of_a_target_is_looked_at_a_few_times(monkeypatch: pytest.MonkeyPatch) -> None:
    count, looks = 200, 0
    original = Reach.distances

    def counted(reach: Reach, targets: Poses) -> Array:
        nonlocal looks
        looks += len(targets)
        return original(reach, targets)

    monkeypatch.setattr(Reach, "distances", counted)
    targets = Poses(np.random.default_rng(1).uniform(-5, 5, (count, 3)), np.tile(np.eye(3), (count, 1, 1)))
    answer = inverse_kinematics(*TWO, targets, START, Options(task=PLANAR, method="newton", max_iterations=1))
    assert answer.statuses.count("unreachable") > 100
    assert looks <= 10 * count


# The trace


@pytest.mark.quick(1)
@pytest.mark.parametrize("task", ["full", "position", "free about x", "free about y", "free about z", "in the plane"])
@pytest.mark.parametrize("name", ["ur5", "panda", "so100", "kinova", "stanford"])
def test_a_trace_ends_at_the_solution(name: str, task: str) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 60))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(task=TASKS[task], trace=True))
    assert answer.paths is not None
    assert answer.statuses == ["solved"] * 60
    for q, path in zip(answer.qs, answer.paths, strict=True):
        assert path.trace is not None
        assert path.stop_reason == "converged"
        np.testing.assert_allclose(same_turn(np.array(path.trace[-1].joint_positions) - q), 0.0, atol=2e-3)


def test_a_trace_begins_at_the_seed_or_at_a_start_of_its_own() -> None:
    machine, chain = catalogue_arm("puma560")
    targets = poses(machine, chain, draw(chain, 60))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(trace=True))
    assert answer.paths is not None
    for restarts, path in zip(answer.restarts, answer.paths, strict=True):
        assert path.trace is not None
        begins_at_seed = np.array_equal(path.trace[0].joint_positions, middle(chain)[0])
        assert begins_at_seed == (restarts == 0)
    assert (answer.restarts > 0).any()


def test_a_task_without_orientation_ignores_it() -> None:
    machine, chain = robot("ur5"), robot("ur5").chain(None, None)
    targets = poses(machine, chain, draw(chain, 20))
    turned = moved(targets, np.zeros((20, 3)), np.full((20, 3), 1.0))
    options = Options(task=POSITION)
    a = inverse_kinematics(machine, chain, targets, middle(chain), options)
    b = inverse_kinematics(machine, chain, turned, middle(chain), options)
    np.testing.assert_allclose(a.qs, b.qs, atol=1e-9)
    assert (a.orientation_errors == 0.0).all()
    assert FULL_POSE.directions == ("x", "y", "z", "rx", "ry", "rz")
