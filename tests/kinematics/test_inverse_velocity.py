"""Inverse velocity against the definitions of each inverse, and the course."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gelenk.ik.search.null_space import Objective
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import Direction, ObjectiveName
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.velocity.inverse_velocity import (
    InverseMotion,
    descent,
    exceeded,
    inverse_motion,
    velocity_limits,
)
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.linear_inverse import InverseRule, invert
from gelenk.kinematics.velocity.task_space import FULL_SPACE, TaskSpace, structure
from gelenk.kinematics.velocity.velocity import tip_motion
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.kinematics.test_jacobian import CHAINS, Ends, chain_of
from tests.oracles import catalogue
from tests.robots import of_table, robot, rows, samples, swept

PLANAR_2R = rows("standard", [(1, 0, 0, 0), (0.7, 0, 0, 0)], "RR")
PLANAR_3R = rows("standard", [(0.5, 0, 0, 0), (0.4, 0, 0, 0), (0.3, 0, 0, 0)], "RRR")
IN_THE_PLANE = TaskSpace(Task(("x", "y")))

every_robot = pytest.mark.parametrize("name", swept(catalogue.NAMES))
every_chain = pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)


def solve(
    machine: RobotModel,
    q: list[float],
    target: list[float],
    rule: InverseRule,
    space: TaskSpace = IN_THE_PLANE,
    rates: list[list[float]] | None = None,
    **options: Any,
) -> InverseMotion:
    """One configuration of the default chain."""
    chain = machine.chain(None, None)
    known = np.empty((0, 1, len(q))) if rates is None else np.array(rates)[:, None]
    return inverse_motion(machine, chain, np.array([q]), known, np.array([target]), rule, space=space, **options)


def random_twists(count: int, directions: int = 6, seed: int = 2) -> Array:
    return np.random.default_rng(seed).uniform(-1.0, 1.0, (count, directions))


def no_rates(qs: Array) -> Array:
    return np.empty((0, *qs.shape))


def jacobians_of(machine: RobotModel, chain: Chain, qs: Array, reference: Reference = "local_world_aligned") -> Array:
    return jacobians(machine, chain, qs, reference=reference).values


# The reference numbers of the course: the planar arm of 1 m and 0.7 m, and that of 0.5, 0.4 and 0.3 m


def test_item_33_the_inverse() -> None:
    found = solve(of_table(PLANAR_2R), [0.3, 0.8], [0.1, 0.3], InverseRule("exact"))
    assert found.inversion.xs[0] == pytest.approx([0.435936662598, -0.802739372970], abs=1e-12)
    assert found.inversion.statuses == ("solved",)


@pytest.mark.parametrize(
    ("q", "expected"),
    [
        ([0.3, 0.0], [0.128903591245, 0.053077949336]),
        ([0.3, 0.01], [0.155292411056, -0.012313177686]),
        ([0.3, 0.8], [0.400352039277, -0.717102790513]),
    ],
)
def test_item_35_damped_least_squares(q: list[float], expected: list[float]) -> None:
    found = solve(of_table(PLANAR_2R), q, [0.1, 0.3], InverseRule("damped", damping=0.01))
    assert found.inversion.xs[0] == pytest.approx(expected, abs=1e-12)
    assert found.inversion.dampings == [0.01]


def test_item_35_what_damping_costs() -> None:
    found = solve(of_table(PLANAR_2R), [0.3, 0.0], [0.1, 0.3], InverseRule("damped", damping=0.01))
    assert found.residuals[0] == pytest.approx([0.175739071661, 0.055156171459], abs=1e-12)
    assert found.inversion.statuses == ("approximate",)


def test_item_35_what_the_exact_inverse_would_do_instead() -> None:
    found = solve(of_table(PLANAR_2R), [0.3, 0.01], [0.1, 0.3], InverseRule("exact"))
    assert found.inversion.xs[0] == pytest.approx([18.675406047, -44.988660444], abs=1e-9)


def test_item_36_the_stretched_arm() -> None:
    machine = of_table(PLANAR_2R)
    columns = [solve(machine, [0.3, 0.0], unit, InverseRule()).inversion.xs[0] for unit in ([1.0, 0.0], [0.0, 1.0])]
    expected = [[-0.148634423469, 0.480494683880], [-0.061202409664, 0.197850752186]]
    np.testing.assert_allclose(np.array(columns).T, expected, atol=1e-12)
    found = solve(machine, [0.3, 0.0], [0.1, 0.3], InverseRule())
    assert found.inversion.xs[0] == pytest.approx([0.129284962817, 0.053234984689], abs=1e-12)
    assert np.linalg.norm(found.residuals[0]) == pytest.approx(0.184189710911, abs=1e-12)
    assert found.inversion.statuses == ("approximate",)


def test_item_36_three_joints_for_two_directions() -> None:
    machine = of_table(PLANAR_3R)
    found = solve(machine, [0.2, 0.7, -0.4], [0.1, -0.2], InverseRule())
    assert found.inversion.xs[0] == pytest.approx([-0.216376453299, 0.063295865052, -0.059267018808], abs=1e-12)
    # The kernel is what is left of any joint velocity; its sign is a matter of choice.
    idle = solve(machine, [0.2, 0.7, -0.4], [0.0, 0.0], InverseRule(), null_motion=np.array([[1.0, 0.0, 0.0]]))
    kernel = idle.inversion.xs[0] / np.linalg.norm(idle.inversion.xs[0])
    assert kernel == pytest.approx([0.260506746411, -0.013391372108, -0.965379151540], abs=1e-12)


def test_item_36_weighted() -> None:
    rule = InverseRule(weights=np.array([1.0, 2.0, 4.0]))
    found = solve(of_table(PLANAR_3R), [0.2, 0.7, -0.4], [0.1, -0.2], rule)
    assert found.inversion.xs[0] == pytest.approx([-0.228097579838, 0.063898390588, -0.015831171758], abs=1e-12)


def test_item_32_joint_accelerations_that_hold_the_velocity() -> None:
    """q̈ = J⁻¹(r̈ - J̇q̇) for r̈ = 0."""
    found = solve(of_table(PLANAR_2R), [0.3, 0.8], [0.0, 0.0], InverseRule("exact"), rates=[[0.5, -0.4]])
    assert found.inversion.xs[0] == pytest.approx([0.252561704898, -0.760133786401], abs=1e-12)


def test_the_rank_of_the_planar_arm() -> None:
    """All six rows have rank 2 always; it is the block of v_x and v_y that loses rank at q₂ = 0 and π."""
    machine = of_table(PLANAR_2R)
    for q2, plane in ((0.8, 2), (0.0, 1), (np.pi, 1)):
        assert solve(machine, [0.3, q2], [0.0] * 6, InverseRule(), FULL_SPACE).inversion.decomposition.ranks == [2]
        assert solve(machine, [0.3, q2], [0.0, 0.0], InverseRule()).inversion.decomposition.ranks == [plane]


def test_the_ur5_with_its_wrist_stretched_has_no_inverse() -> None:
    q = [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]
    found = solve(robot("ur5_dh"), q, [0.1] * 6, InverseRule("exact"), FULL_SPACE)
    assert found.inversion.statuses == ("singular",)
    assert not found.inversion.xs.any()
    lost = found.inversion.decomposition.lost_directions(0)
    J = jacobians_of(robot("ur5_dh"), robot("ur5_dh").chain(None, None), np.array([q]))[0]
    assert lost.shape == (1, 6)
    assert np.abs(lost @ J).max() < 1e-12


# Properties on every robot


@every_robot
def test_the_pseudo_inverse_meets_the_four_conditions_of_moore_and_penrose(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    for q in samples(chain, 2):
        J = jacobians_of(machine, chain, q[None])[0]
        units = np.broadcast_to(J, (6, *J.shape))
        found = invert(units, np.eye(6), InverseRule(), np.ones(6)).xs.T
        size = np.abs(found).max(initial=1.0)
        np.testing.assert_allclose(J @ found @ J, J, atol=1e-12 * size)
        np.testing.assert_allclose(found @ J @ found, found, atol=1e-12 * size**2)
        np.testing.assert_allclose(J @ found, (J @ found).T, atol=1e-12 * size)
        np.testing.assert_allclose(found @ J, (found @ J).T, atol=1e-12 * size)


@every_robot
def test_damped_solutions_solve_their_normal_equations(name: str) -> None:
    """(JᵀS²J + λW) q̇ = JᵀS²v."""
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, 3)
    vs = random_twists(3)
    W = np.random.default_rng(9).uniform(0.2, 5.0, len(chain))
    S2 = np.diag([1.0, 1.0, 1.0, 0.16, 0.16, 0.16])
    rule = InverseRule("damped", damping=0.03, weights=W)
    found = inverse_motion(machine, chain, qs, no_rates(qs), vs, rule, space=TaskSpace(characteristic_length=0.4))
    for J, v, x in zip(jacobians_of(machine, chain, qs), vs, found.inversion.xs, strict=True):
        np.testing.assert_allclose((J.T @ S2 @ J + 0.03 * np.diag(W)) @ x, J.T @ S2 @ v, atol=1e-12)


@every_robot
def test_residuals_are_square_to_what_the_tip_can_do(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs, vs = samples(chain, 2), random_twists(2)
    found = inverse_motion(machine, chain, qs, no_rates(qs), vs, InverseRule())
    Js = jacobians_of(machine, chain, qs)
    np.testing.assert_allclose(found.residuals, vs - np.einsum("bki,bi->bk", Js, found.inversion.xs), atol=1e-9)
    size = np.abs(found.inversion.xs).max(initial=1.0)
    assert np.abs(np.einsum("bki,bk->bi", Js, found.residuals)).max() < 1e-12 * size


@every_robot
def test_null_space_motion_leaves_the_tip_alone(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, 2)
    wish = np.random.default_rng(3).uniform(-1, 1, qs.shape)
    rule = InverseRule(weights=np.linspace(0.5, 2.0, len(chain)))
    plain, moved = (
        inverse_motion(machine, chain, qs, no_rates(qs), random_twists(2), rule, null_motion=motion)
        for motion in (None, wish)
    )
    added = moved.inversion.xs - plain.inversion.xs
    Js = jacobians_of(machine, chain, qs)
    assert np.abs(np.einsum("bki,bi->bk", Js, added)).max() < 1e-9
    # Of all motions that leave the tip alone it is the nearest to ξ, in the metric of the weights.
    weighted = (wish - added) * np.linspace(0.5, 2.0, len(chain))
    for J, left in zip(Js, weighted, strict=True):
        kernel = np.linalg.svd(J)[2][np.linalg.matrix_rank(J, tol=1e-10 * np.linalg.norm(J, 2)) :]
        assert np.abs(kernel @ left).max(initial=0.0) < 1e-9


@every_chain
@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
@pytest.mark.parametrize("order", [1, 2, 3])
def test_inverting_the_tips_motion_gives_back_the_joints(ends: Ends, reference: Reference, order: int) -> None:
    """As far as the kernel of J leaves it open: what is found moves the tip in the same way."""
    machine, chain = chain_of(ends)
    qs = samples(chain, 2)
    rates = np.random.default_rng(order).uniform(-1, 1, (order, 2, len(chain)))
    asked = tip_motion(machine, chain, qs, rates, reference).derivatives[-1]
    found = inverse_motion(machine, chain, qs, rates[:-1], asked, InverseRule(), space=TaskSpace(reference=reference))
    assert found.inversion.statuses == ("solved", "solved")
    Js = jacobians_of(machine, chain, qs, reference)
    np.testing.assert_allclose(np.einsum("bki,bi->bk", Js, found.inversion.xs - rates[-1]), 0.0, atol=1e-9)


@pytest.mark.parametrize("directions", [("x", "y", "z"), ("rz",), ("x", "rx", "ry")])
def test_only_the_directions_that_count_are_met(directions: tuple[Direction, ...]) -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    qs, space = samples(chain, 4), TaskSpace(Task(directions))
    vs = random_twists(4, len(directions))
    found = inverse_motion(machine, chain, qs, no_rates(qs), vs, InverseRule(), space=space)
    assert found.inversion.statuses == ("solved",) * 4
    moved = np.einsum("bki,bi->bk", jacobians_of(machine, chain, qs), found.inversion.xs)
    np.testing.assert_allclose(moved[:, space.rows], vs, atol=1e-10)


def test_a_length_does_not_change_what_can_be_met() -> None:
    """Where J q̇ = v has solutions the smallest is the same; where not, the least residual depends on the length."""
    for name, same in (("panda", True), ("so100", False)):
        machine = robot(name)
        chain = machine.chain(None, None)
        qs, vs = samples(chain, 2), random_twists(2)
        a, b = (
            inverse_motion(
                machine, chain, qs, no_rates(qs), vs, InverseRule(), space=TaskSpace(characteristic_length=length)
            )
            for length in (None, 0.1)
        )
        assert np.allclose(a.inversion.xs, b.inversion.xs, atol=1e-9) == same


# Damping that adapts


@pytest.mark.parametrize("name", ["ur5", "panda", "kinova", "tiago"])
def test_adaptive_damping_keeps_the_velocity_limits_and_damps_no_more_than_needed(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs, limits = samples(chain, 40), velocity_limits(machine, chain)
    vs = 3.0 * random_twists(40)
    found = inverse_motion(machine, chain, qs, no_rates(qs), vs, InverseRule("damped")).inversion
    assert (np.abs(found.xs) <= limits * (1 + 1e-12)).all()
    least = np.maximum(0.0, 0.05**2 - found.decomposition.sigmas[:, -1] ** 2)
    raised = found.dampings > least * (1 + 1e-9)
    assert raised.any()
    Js = jacobians_of(machine, chain, qs)
    for row in np.flatnonzero(raised):
        less = InverseRule("damped", damping=float(found.dampings[row]) * 0.999)
        speeds = np.abs(invert(Js[[row]], vs[[row]], less, np.ones(6)).xs[0])
        assert (speeds > limits).any()


def test_adaptive_damping_is_none_far_from_singularities() -> None:
    found = solve(of_table(PLANAR_2R), [0.3, 0.8], [0.1, 0.3], InverseRule("damped"))
    assert found.inversion.dampings == [0.0]
    assert found.inversion.statuses == ("solved",)


@pytest.mark.parametrize("q2", [0.0, 1e-9, 0.01, 0.05])
def test_no_gain_of_adaptive_damping_exceeds_the_inverse_of_its_threshold(q2: float) -> None:
    found = solve(of_table(PLANAR_2R), [0.3, q2], [0.0, 0.0], InverseRule("damped", damping_threshold=0.05))
    assert found.inversion.decomposition.gains(found.inversion.dampings).max() <= 1 / 0.05
    worst = max(
        float(np.linalg.norm(solve(of_table(PLANAR_2R), [0.3, q2], v, InverseRule("damped")).inversion.xs))
        for v in ([np.cos(0.3), np.sin(0.3)], [0.0, 1.0], [1.0, 0.0])
    )
    assert worst <= 1 / 0.05


def test_null_space_motion_has_what_room_the_limits_leave() -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    qs, limits = samples(chain, 10), velocity_limits(machine, chain)
    wish = np.full(qs.shape, 50.0)
    found = inverse_motion(machine, chain, qs, no_rates(qs), random_twists(10), InverseRule("damped"), null_motion=wish)
    assert (np.abs(found.inversion.xs) <= limits * (1 + 1e-9)).all()
    assert (found.inversion.shares < 1.0).all()
    at_limit = (np.abs(found.inversion.xs) >= limits * (1 - 1e-9)).any(axis=1)
    assert at_limit.all()


# Objectives


@pytest.mark.parametrize("objective", ["mid_range", "limits", "manipulability", "posture"])
def test_an_objective_improves_along_its_motion(objective: ObjectiveName) -> None:
    """Against the objective's definition: a short step along (I - J#J) ξ makes it better, and leaves the tip."""
    machine = robot("panda")
    chain = machine.chain(None, None)
    lower, upper = chain.lower, chain.upper
    posture = 0.5 * (lower + upper) + 0.1

    def value(q: Array) -> float:
        if objective == "manipulability":
            J = jacobians_of(machine, chain, q[None])[0]
            return -0.5 * float(np.linalg.slogdet(J @ J.T)[1])
        if objective == "limits":
            return float(((upper - lower) ** 2 / (4 * (upper - q) * (q - lower))).sum())
        if objective == "posture":
            return 0.5 * float(((q - posture) ** 2).sum())
        return 0.5 * float((((q - (upper + lower) / 2) / (upper - lower)) ** 2).sum())

    rng = np.random.default_rng(1)
    for q in lower + rng.uniform(0.2, 0.8, (5, 7)) * (upper - lower):
        wanted = Objective(objective, posture if objective == "posture" else None)
        xi = descent(chain, q[None], wanted, 1.0, FULL_SPACE)
        # ξ is minus the gradient.
        for j in range(7):
            step = 1e-5 * np.eye(7)[j]
            assert -xi[0, j] == pytest.approx((value(q + step) - value(q - step)) / 2e-5, rel=1e-5, abs=1e-6)
        found = solve(machine, q.tolist(), [0.0] * 6, InverseRule(), FULL_SPACE, null_motion=xi)
        direction = found.inversion.xs[0]
        assert value(q + 1e-4 * direction / np.linalg.norm(direction)) < value(q)


# Limits, ranks


def test_limits_of_followers_bind_their_leader() -> None:
    machine = robot("panda")
    chain = machine.chain("panda_rightfinger", "panda_leftfinger")
    limit = velocity_limits(machine, chain)
    joints = machine.description.joint
    expected = [joints[name].limits.velocity for name in ("panda_finger_joint1", "panda_finger_joint2")]
    assert limit == [min(speed for speed in expected if speed is not None)]


def test_what_exceeds_its_limit_is_named() -> None:
    machine = robot("ur5")
    chain = machine.chain(None, None)
    limits = velocity_limits(machine, chain)
    found = exceeded(chain, limits * [1, 2, -1, -3, 0, 1], limits)
    assert [joint.joint for joint in found] == [chain.joint_names[1], chain.joint_names[3]]
    assert [joint.ratio for joint in found] == pytest.approx([2.0, 3.0])
    assert found[1].velocity == -3 * limits[3]
    unlimited = robot("planar_2r")
    ends = unlimited.chain(None, None)
    assert exceeded(ends, np.array([1e6, -1e6]), velocity_limits(unlimited, ends)) == []


@pytest.mark.parametrize(
    ("name", "directions", "ranks"),
    [
        # The body's point at the base's origin does not move with the first joint, which stands there.
        ("planar_2r", ("x", "y"), [2, 2, 1]),
        ("planar_3r", ("x", "y", "z", "rx", "ry", "rz"), [3, 3, 3]),
        ("panda", ("x",), [1, 1, 1]),
    ],
)
def test_ranks_nearly_everywhere(name: str, directions: tuple[Direction, ...], ranks: list[int]) -> None:
    references: tuple[Reference, ...] = ("local_world_aligned", "local", "world")
    chain = robot(name).chain(None, None)
    assert [structure(chain, Task(directions), reference).rank for reference in references] == ranks


# At the ends of the range


@pytest.mark.parametrize(
    "rule",
    [InverseRule(), InverseRule("damped"), InverseRule("damped", damping=0.0), InverseRule("damped", damping=1e-30)],
)
def test_numbers_stay_numbers(rule: InverseRule) -> None:
    machine = robot("ur5_dh")
    chain = machine.chain(None, None)
    qs = np.concatenate((np.zeros((1, 6)), samples(chain, 3), 1e6 * samples(chain, 2)))
    heavy = replace(rule, rank_tolerance=1e-15, weights=np.array([1e-9, 1e9, 1, 1, 1, 1]))
    for chosen in (rule, heavy):
        vs = 1e6 * random_twists(len(qs))
        found = inverse_motion(machine, chain, qs, no_rates(qs), vs, chosen)
        assert np.isfinite(found.inversion.xs).all()
        assert np.isfinite(found.residuals).all()


def test_the_smallest_null_space_motion_has_all_the_room() -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    qs = samples(chain, 1)
    motion = np.full(qs.shape, 1e-301)
    found = inverse_motion(
        machine, chain, qs, no_rates(qs), np.zeros((1, 6)), InverseRule("damped"), null_motion=motion
    )
    assert found.inversion.shares == [1.0]


def test_tiny_arms_have_no_answer_rather_than_an_infinite_one() -> None:
    found = invert(np.full((1, 1, 1), 1e-200), np.array([[1e6]]), InverseRule(), np.ones(1))
    assert found.statuses == ("singular",)
    assert found.xs == [[0.0]]


@pytest.mark.parametrize("inverse", ["pseudo_inverse", "damped"])
def test_no_configuration_and_no_joint(inverse: Any) -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    qs = np.empty((0, 7))
    assert inverse_motion(
        machine, chain, qs, no_rates(qs), np.empty((0, 6)), InverseRule(inverse)
    ).inversion.xs.shape == (
        0,
        7,
    )
    fixed = machine.chain("panda_hand", "panda_hand")
    still = inverse_motion(machine, fixed, np.empty((1, 0)), np.empty((0, 1, 0)), np.ones((1, 6)), InverseRule(inverse))
    assert still.inversion.xs.shape == (1, 0)
    assert still.residuals.tolist() == [[1.0] * 6]
    assert still.inversion.decomposition.condition_numbers == [None]
    assert structure(fixed, FULL_SPACE.task, "local").rank == 0
