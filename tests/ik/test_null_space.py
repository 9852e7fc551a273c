"""Freedom put to use: the target stays reached, the objective falls as far as it can."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from gelenk.ik.search.null_space import _value, objective_gradients, settle
from gelenk.ik.search.problem import Objective
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.ik.arms import (
    PLANAR,
    POSITION,
    angles,
    assert_solved,
    catalogue_arm,
    distances,
    draw,
    inside,
    limited,
    middle,
    planar_arm,
    poses,
    problem,
)

CASES = {
    "panda": ("panda", FULL_POSE),
    "xarm7": ("xarm7", FULL_POSE),
    "tiago": ("tiago", FULL_POSE),
    "kinova, position": ("kinova", POSITION),
    "ur5, position": ("ur5", POSITION),
    "puma560, position": ("puma560", POSITION),
    "scara, position": ("scara", POSITION),
}
every_case = pytest.mark.parametrize(("name", "task"), CASES.values(), ids=CASES)
NAMES = ["posture", "mid_range", "limits", "manipulability"]
every_objective = pytest.mark.parametrize("objective", NAMES)


def narrow(chain: Chain) -> Chain:
    """Less than a full turn for each joint."""
    return limited(chain, np.maximum(chain.lower, -3.0), np.minimum(chain.upper, 3.0))


def objective_of(name: str, chain: Chain, count: int) -> Objective:
    """An objective; the posture is one each."""
    if name != "posture":
        return Objective(name)  # type: ignore[arg-type]
    return Objective("posture", draw(chain, count, seed=41))


def value(name: str, machine: RobotModel, chain: Chain, qs: Array, task: Task, posture: Array | None = None) -> Array:
    """The objective by its definition; of the directions that count, all or those of the position."""
    lower, upper = chain.lower, chain.upper
    both = np.isfinite(lower) & np.isfinite(upper) & (upper > lower)
    low, high = lower[both], upper[both]
    if name == "posture":
        assert posture is not None
        return np.asarray(0.5 * ((qs - posture) ** 2).sum(axis=1))
    if name == "mid_range":
        return np.asarray(0.5 * (((qs[:, both] - (low + high) / 2) / (high - low)) ** 2).sum(axis=1))
    if name == "limits":
        room = np.maximum((high - qs[:, both]) * (qs[:, both] - low), 1e-12)
        return np.asarray(((high - low) ** 2 / (4 * room)).sum(axis=1))
    Js = jacobians(machine, chain, qs).values[:, : 3 if task is POSITION else 6]
    return np.asarray(-np.log(np.linalg.svd(Js, compute_uv=False)).sum(axis=1))


@every_objective
@every_case
def test_values_and_gradients_are_what_they_are_said_to_be(name: str, task: Task, objective: str) -> None:
    machine, chain = catalogue_arm(name)
    lower = np.where(np.isfinite(chain.lower), chain.lower, -np.pi)
    upper = np.where(np.isfinite(chain.upper), chain.upper, np.pi)
    qs = lower + (upper - lower) * np.random.default_rng(42).uniform(0.2, 0.8, (12, len(chain)))
    posture = draw(chain, 12, seed=41)
    targets = poses(machine, chain, qs)
    goal = objective_of(objective, chain, 12)
    expected = value(objective, machine, chain, qs, task, posture)
    np.testing.assert_allclose(_value(chain, targets, qs, goal, task), expected, rtol=1e-9, atol=1e-9)
    gradients = objective_gradients(chain, targets, qs, goal, task)
    count = 3 if task is POSITION else 6
    smallest = np.linalg.svd(jacobians(machine, chain, qs).values[:, :count], compute_uv=False)[:, -1]
    compared = 0
    for i, q in enumerate(qs):
        if objective == "manipulability" and smallest[i] < 0.03:
            continue

        steps = 1e-6 * np.eye(len(q))
        ahead, behind = (
            value(objective, machine, chain, around, task, posture[i]) for around in (q + steps, q - steps)
        )
        slope = (ahead - behind) / 2e-6
        np.testing.assert_allclose(gradients[i], slope, rtol=1e-4, atol=1e-5)
        compared += 1
    assert compared >= 3


@pytest.mark.quick(2)
@every_objective
@every_case
def test_the_objective_falls_and_the_target_stays_reached(name: str, task: Task, objective: str) -> None:
    machine, chain = catalogue_arm(name)
    chain = narrow(chain)
    qs = draw(chain, 40, seed=43)
    targets = poses(machine, chain, qs)
    goal = objective_of(objective, chain, len(qs))
    settled = settle(problem(chain, targets, qs, task=task), qs, goal)
    reached = poses(machine, chain, settled)
    assert distances(targets, reached).max() < 1.1e-10
    if task is FULL_POSE:
        assert angles(targets, reached).max() < 1.1e-10
    assert inside(chain, settled, 0.0).all()
    posture = goal.posture
    before, after = (value(objective, machine, chain, each, task, posture) for each in (qs, settled))
    assert (after <= before + 1e-9 * np.abs(before)).all()
    moved = np.abs(settled - qs).max(axis=1) > 1e-3
    # Where the wrist is the tip, or one joint alone lifts it, no freedom changes how the tip can move.
    if not (objective == "manipulability" and name in {"scara", "puma560"}):
        assert moved.mean() > 0.5
        assert (after < before)[moved].all()


def steepest(machine: RobotModel, chain: Chain, q: Array, task: Task, gradient: Array) -> float:
    """The length of the steepest way down that keeps the target and the limits: a least-squares problem by SciPy."""
    J = jacobians(machine, chain, q[None]).values[0][: 3 if task is POSITION else 6]
    # ‖d + g‖² over Jd = 0, d ≥ 0 at a lower limit and ≤ 0 at an upper one.
    low = np.where(q <= chain.lower + 2e-6, 0.0, -np.inf)
    high = np.where(q >= chain.upper - 2e-6, 0.0, np.inf)
    high = np.where(high <= low, low + 1e-12, high)
    stacked = np.vstack((np.eye(len(q)), 1e4 * J))
    solution = lsq_linear(stacked, np.append(-gradient, np.zeros(len(J))), bounds=(low, high), method="bvls", tol=1e-14)
    return float(np.linalg.norm(solution.x))


@pytest.mark.quick(2)
@pytest.mark.parametrize("objective", ["posture", "mid_range", "limits"])
@pytest.mark.parametrize("name", ["panda", "xarm7", "ur5, position", "scara, position"])
def test_at_the_end_nothing_that_is_allowed_makes_it_smaller(name: str, objective: str) -> None:
    robot_name, task = CASES[name]
    machine, chain = catalogue_arm(robot_name)
    chain = narrow(chain)
    qs = draw(chain, 30, seed=44)
    goal = objective_of(objective, chain, len(qs))
    targets = poses(machine, chain, qs)
    settled = settle(problem(chain, targets, qs, task=task), qs, goal)
    gradients = objective_gradients(chain, targets, settled, goal, task)
    ends = np.array([steepest(machine, chain, q, task, g) for q, g in zip(settled, gradients, strict=True)])
    first = objective_gradients(chain, targets, qs, goal, task)
    starts = np.array([steepest(machine, chain, q, task, g) for q, g in zip(qs, first, strict=True)])
    scale = np.linalg.norm(gradients, axis=1)
    assert np.median(ends / np.maximum(scale, 1e-3)) < 1e-5
    assert (ends < 1e-3 * np.maximum(1.0, scale)).mean() >= 0.85
    assert (starts < 1e-3).mean() < 0.2


@pytest.mark.parametrize(
    ("name", "task"), [CASES["kinova, position"], CASES["tiago"]], ids=["kinova, position", "tiago"]
)
def test_a_joint_beside_its_limit_does_not_end_the_descent(name: str, task: Task) -> None:
    machine, chain = catalogue_arm(name)
    chain = narrow(chain)
    qs = draw(chain, 60, seed=44)
    goal = objective_of("posture", chain, len(qs))
    targets = poses(machine, chain, qs)
    settled = settle(problem(chain, targets, qs, task=task), qs, goal)
    gradients = objective_gradients(chain, targets, settled, goal, task)
    ends = np.array([steepest(machine, chain, q, task, g) for q, g in zip(settled, gradients, strict=True)])
    assert (ends > 0.05 * np.linalg.norm(gradients, axis=1)).sum() <= 3


@every_objective
def test_without_freedom_a_solution_stays(objective: str) -> None:
    machine, chain = catalogue_arm("puma560")
    qs = draw(chain, 20, seed=45)
    regular = np.linalg.svd(jacobians(machine, chain, qs).values, compute_uv=False)[:, -1] > 0.01
    goal = objective_of(objective, chain, len(qs))
    settled = settle(problem(chain, poses(machine, chain, qs), qs, task=FULL_POSE), qs, goal)
    assert regular.sum() > 10
    np.testing.assert_allclose(settled[regular], qs[regular], atol=1e-6)


def test_a_posture_that_solves_the_target_is_reached() -> None:
    machine, chain = catalogue_arm("panda")
    postures = 0.9 * (draw(chain, 30, seed=46) - middle(chain)) + middle(chain)
    targets = poses(machine, chain, postures)
    nearby = inverse_kinematics(machine, chain, targets, postures + 0.05, Options())
    assert_solved(machine, chain, targets, nearby)
    settled = settle(problem(chain, targets, nearby.qs, task=FULL_POSE), nearby.qs, Objective("posture", postures))
    assert np.median(np.abs(settled - postures).max(axis=1)) < 1e-6


@pytest.mark.parametrize("objective", NAMES)
def test_solutions_are_settled_where_it_is_asked_for(objective: str) -> None:
    machine, chain = catalogue_arm("panda")
    targets = poses(machine, chain, draw(chain, 30, seed=47))
    seeds = draw(chain, 30, seed=48)
    plain_answer = inverse_kinematics(machine, chain, targets, seeds, Options())
    name: Objective = Objective(objective)  # type: ignore[arg-type]
    settled = inverse_kinematics(machine, chain, targets, seeds, Options(objective=name))
    assert_solved(machine, chain, targets, settled)
    goal = Objective("posture", seeds) if objective == "posture" else name
    before, after = (
        value(objective, machine, chain, qs, FULL_POSE, goal.posture) for qs in (plain_answer.qs, settled.qs)
    )
    assert (after <= before + 1e-12).all()
    assert (after < before - 1e-4).mean() > 0.7


def test_a_posture_for_each_target_goes_with_its_target() -> None:
    machine, chain = catalogue_arm("panda")
    targets = poses(machine, chain, draw(chain, 20, seed=49))
    targets.positions[::4] += 3.0
    postures = draw(chain, 20, seed=50)
    answer = inverse_kinematics(
        machine, chain, targets, middle(chain), Options(objective=Objective("posture", postures))
    )
    assert [status == "solved" for status in answer.statuses] == [i % 4 != 0 for i in range(20)]
    for i in (1, 7, 19):
        alone = inverse_kinematics(
            machine,
            chain,
            type(targets)(targets.positions[i : i + 1], targets.rotations[i : i + 1]),
            middle(chain),
            Options(objective=Objective("posture", postures[i])),
        )
        np.testing.assert_allclose(answer.qs[answer.firsts[i]], alone.qs[0], atol=1e-9)


def test_a_posture_is_needed_and_said_to_be() -> None:
    machine, chain = catalogue_arm("panda")
    qs = draw(chain, 1)
    with pytest.raises(ValueError, match="posture"):
        settle(problem(chain, poses(machine, chain, qs), qs, task=FULL_POSE), qs, Objective("posture"))


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "objective", [Objective("posture", np.full(6, 4.0)), Objective("manipulability")], ids=["posture", "manipulability"]
)
def test_joints_with_a_full_turn_keep_within_their_limits(objective: Objective) -> None:
    machine, chain = catalogue_arm("anthropomorphic_wrist")
    qs = draw(chain, 100)
    if objective.name == "manipulability":
        qs[:, 1] = np.pi - 1e-3
    targets = poses(machine, chain, qs)
    answer = inverse_kinematics(machine, chain, targets, qs, Options(task=POSITION, objective=objective))
    assert answer.statuses == ["solved"] * 100
    assert inside(chain, answer.qs).all()


def test_manipulability_is_that_of_the_task() -> None:
    machine, chain = planar_arm(0.5, 0.4, 0.3)
    chain = narrow(chain)
    qs = draw(chain, 30, seed=51)
    settled = settle(problem(chain, poses(machine, chain, qs), qs, task=PLANAR), qs, Objective("manipulability"))

    def measure(qs: Array) -> Array:
        Js = jacobians(machine, chain, qs).values[:, :2]
        return np.asarray(np.sqrt(np.linalg.det(Js @ Js.transpose(0, 2, 1))))

    assert (measure(settled) >= measure(qs) - 1e-9).all()
    assert (measure(settled) > measure(qs) + 1e-3).mean() > 0.5
