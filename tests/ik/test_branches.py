"""Every solution: nothing that others find is missing, nothing stands twice, and every full turn that limits allow."""

from itertools import product

import numpy as np
import pytest

from gelenk.ik.search.task import Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.branches import thin_out, wound_near
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from tests.ik.arms import (
    DECOUPLED,
    IRB,
    PLANAR,
    POSITION,
    PUMA,
    Q6,
    UR5,
    assert_solved,
    at,
    catalogue_arm,
    contains,
    draw,
    inside,
    limited,
    middle,
    part,
    planar_arm,
    poses,
    same_turn,
    table_arm,
)
from tests.oracles import catalogue, dh_columns
from tests.oracles.dh_columns import Table
from tests.oracles.many_starts import solutions

ARMS = {"ur5": UR5, "puma": PUMA, "irb": IRB, "decoupled": DECOUPLED}


def distinct(qs: Array, close: float = 1e-4) -> bool:
    """Whether no two are the same up to full turns."""
    return all((np.abs(same_turn(qs[:i] - q)).max(axis=1, initial=0.0) > close).all() for i, q in enumerate(qs))


@pytest.mark.slow
@pytest.mark.parametrize("arm", ARMS)
def test_nothing_is_missing_that_an_independent_search_finds(arm: str) -> None:
    machine, chain = table_arm(ARMS[arm])
    textbook = Table(True, ARMS[arm], [False] * 6)
    targets = poses(machine, chain, draw(chain, 20, seed=31))
    answer = inverse_kinematics(machine, chain, targets, np.full((1, 6), 0.1), Options(every=True))
    assert_solved(machine, chain, targets, answer)
    found_by_others = 0
    for i, T in enumerate(targets.matrices()):
        found = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        expected = solutions(textbook, T, None)
        found_by_others += len(expected)
        missing = [q for q in expected if not contains(found, q, close=1e-4)]
        assert not missing
        assert distinct(found)
        assert answer.complete == [True] * 20
    assert found_by_others >= 20 * 4


@pytest.mark.slow
@pytest.mark.parametrize("name", ["puma560", "stanford", "ur5_dh", "anthropomorphic_wrist"])
def test_nothing_is_missing_within_limits(name: str) -> None:
    machine, chain = catalogue_arm(name)
    textbook = dh_columns.from_json(catalogue.dh_table(name))
    targets = poses(machine, chain, draw(chain, 15, seed=32))
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(every=True))
    assert_solved(machine, chain, targets, answer)
    bounds = list(zip(chain.lower.tolist(), chain.upper.tolist(), strict=True))
    for i, T in enumerate(targets.matrices()):
        found = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        expected = solutions(textbook, T, bounds)
        assert len(expected) >= 1
        assert all(contains(found, q, close=1e-4) for q in expected)
        assert distinct(found)
        assert answer.complete is not None
        assert answer.complete[i]


@pytest.mark.parametrize("arm", ARMS)
def test_solutions_come_nearest_to_the_seed_first(arm: str) -> None:
    machine, chain = table_arm(ARMS[arm])
    qs = draw(chain, 10, seed=33)
    answer = inverse_kinematics(machine, chain, poses(machine, chain, qs), qs, Options(every=True))
    for i, q in enumerate(qs):
        found = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        lengths = np.linalg.norm(found - q, axis=1)
        assert (np.diff(lengths) >= -1e-12).all()
        assert lengths[0] < 1e-8


def test_the_number_of_solutions_is_bounded_as_asked() -> None:
    machine, chain = table_arm(UR5)
    target, seed = poses(machine, chain, draw(chain, 1, seed=34)), np.zeros((1, 6))
    every = inverse_kinematics(machine, chain, target, seed, Options(every=True))
    count = len(every.qs)
    assert count >= 4
    for most in (1, 2, count - 1):
        some = inverse_kinematics(machine, chain, target, seed, Options(every=True, most=most))
        assert len(some.qs) <= most
        assert some.complete == [False]
    exact = inverse_kinematics(machine, chain, target, seed, Options(every=True, most=count))
    np.testing.assert_array_equal(exact.qs, every.qs)
    assert exact.complete == [True]


def test_the_answer_depends_neither_on_the_batch_nor_much_on_the_random_seed() -> None:
    machine, chain = table_arm(IRB)
    targets = poses(machine, chain, draw(chain, 10, seed=35))
    together = inverse_kinematics(machine, chain, targets, np.zeros((1, 6)), Options(every=True))
    for i in range(10):
        options = Options(every=True)
        alone = inverse_kinematics(machine, chain, part(targets, slice(i, i + 1)), np.zeros((1, 6)), options)
        np.testing.assert_array_equal(alone.qs, together.qs[together.firsts[i] : together.firsts[i + 1]])
    other = inverse_kinematics(machine, chain, targets, np.zeros((1, 6)), Options(every=True, random_seed=5))
    np.testing.assert_array_equal(other.firsts, together.firsts)
    np.testing.assert_allclose(same_turn(other.qs - together.qs), 0.0, atol=1e-6)


# Full turns


def windings(chain: Chain, q: Array) -> set[tuple[float, ...]]:
    """All the full turns of a configuration within the limits, one joint after the other."""
    choices = [
        [value + 2 * np.pi * k for k in range(-5, 6) if low - 1e-9 <= value + 2 * np.pi * k <= high + 1e-9]
        for value, low, high in zip(q, chain.lower, chain.upper, strict=True)
    ]
    return {tuple(np.round(choice, 5)) for choice in product(*choices)}


def test_all_full_turns_within_limits_and_none_beyond() -> None:
    machine, chain = table_arm(UR5)
    chain = limited(chain, [-9.0, -4.0, -3.0, -7.0, -2 * np.pi, -10.0], [9.0, 4.0, 3.5, 3.0, 2 * np.pi, 1.0])
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    target, seed = poses(machine, chain, q[None]), q[None] + 0.1
    plain = inverse_kinematics(machine, chain, target, seed, Options(every=True))
    wound = inverse_kinematics(machine, chain, target, seed, Options(every=True, windings=True, most=100_000))
    assert distinct(plain.qs)
    assert wound.complete == [True]
    assert_solved(machine, chain, target, wound)
    expected = set().union(*(windings(chain, solution) for solution in plain.qs))
    assert len(expected) > 100
    assert len(wound.qs) == len(expected)
    assert {tuple(row) for row in np.round(wound.qs, 5)} == expected
    assert (np.diff(np.linalg.norm(wound.qs - seed, axis=1)) >= -1e-12).all()
    bounded = inverse_kinematics(machine, chain, target, seed, Options(every=True, windings=True, most=50))
    np.testing.assert_array_equal(bounded.qs, wound.qs[:50])
    assert bounded.complete == [False]


def test_a_joint_with_exactly_a_full_turn_may_stand_at_both_ends() -> None:
    machine, chain = planar_arm(1.0, 0.7)
    target = poses(machine, chain, np.array([[-np.pi, 1.0]]))
    options = Options(task=PLANAR, every=True, windings=True)
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 2)), options)
    assert inside(chain, answer.qs).all()
    assert contains(answer.qs, [-np.pi, 1.0], turns=False, close=1e-6)
    assert contains(answer.qs, [np.pi, 1.0], turns=False, close=1e-6)
    assert len(answer.qs) == 3


def test_endless_joints_and_missing_limits_have_one_turn_each() -> None:
    machine, chain = catalogue_arm("kinova")
    target, seed = poses(machine, chain, draw(chain, 1)), np.full((1, 6), 20.0)
    answer = inverse_kinematics(machine, chain, target, seed, Options(every=True, windings=True))
    endless = ~np.isfinite(chain.upper)
    assert endless.sum() == 3
    assert np.abs(answer.qs[:, endless] - 20.0).max() <= np.pi + 1e-9
    free = inverse_kinematics(machine, chain, target, seed, Options(every=True, windings=True, respect_limits=False))
    assert np.abs(free.qs - 20.0).max() <= np.pi + 1e-9
    assert distinct(free.qs)
    assert len(free.qs) >= len(answer.qs)


def test_turning_into_limits_takes_the_nearest_place() -> None:
    _, chain = planar_arm(1.0, 0.7)
    rng = np.random.default_rng(3)
    for _ in range(200):
        lower = rng.uniform(-20.0, 10.0, 2)
        upper = lower + rng.uniform(2 * np.pi, 30.0, 2)
        q, seed = rng.uniform(-40.0, 40.0, (1, 2)), rng.uniform(-40.0, 40.0, 2)
        found = wound_near(chain, q, seed, lower, upper)[0]
        for j in range(2):
            places = q[0, j] + 2 * np.pi * np.arange(-20, 21)
            places = places[(places >= lower[j]) & (places <= upper[j])]
            assert abs(found[j] - seed[j]) <= np.abs(places - seed[j]).min() + 1e-9
            assert np.abs(places - found[j]).min() < 1e-9


def test_turning_towards_limits_without_a_place_within() -> None:
    _, chain = planar_arm(1.0, 0.7)
    lower, upper = np.array([-1.0, -1.0]), np.array([1.0, 1.0])
    found = wound_near(chain, np.array([[2.0, 2.0 + 6 * np.pi], [-2.5, 3.0], [4.0, -4.0]]), np.zeros(2), lower, upper)
    np.testing.assert_allclose(found, [[2.0, 2.0], [-2.5, 3.0], [4.0 - 2 * np.pi, 2 * np.pi - 4.0]], atol=1e-12)


def test_thinning_keeps_the_first_of_each_cluster() -> None:
    rng = np.random.default_rng(6)
    centers = rng.uniform(-3.0, 3.0, (12, 3))
    qs = np.repeat(centers, 5, axis=0) + rng.uniform(-1e-5, 1e-5, (60, 3))
    qs[:, 0] += 2 * np.pi * rng.integers(-2, 3, 60)
    free = np.array([True, False, False])
    np.testing.assert_array_equal(thin_out(qs, free, 1e-4, 100), np.arange(0, 60, 5))
    np.testing.assert_array_equal(thin_out(qs, free, 1e-4, 4), np.arange(0, 20, 5))
    assert len(thin_out(qs, np.zeros(3, dtype=bool), 1e-4, 100)) > 12
    assert len(thin_out(np.empty((0, 3)), free, 1e-4, 5)) == 0


# Continua and double solutions


def check_sample(chain: Chain, answer_qs: Array) -> None:
    """A sample of a continuum keeps its distances."""
    assert distinct(answer_qs, 0.2)
    assert inside(chain, answer_qs).all()


def test_a_redundant_arm_gives_a_sample() -> None:
    machine, chain = catalogue_arm("panda")
    q = draw(chain, 1)
    target = poses(machine, chain, q)
    answer = inverse_kinematics(machine, chain, target, q + 0.02, Options(every=True, most=40))
    assert_solved(machine, chain, target, answer)
    assert answer.complete == [False]
    assert len(answer.qs) == 40
    check_sample(chain, answer.qs)
    # The nearest to the seed is at least as near as the one that is known.
    assert np.linalg.norm(answer.qs[0] - q - 0.02) <= np.linalg.norm(np.full(7, 0.02)) + 1e-6


@pytest.mark.parametrize("most", [20, 100])
@pytest.mark.parametrize("arm", ["ur5", "decoupled"])
def test_a_singular_wrist_gives_a_sample(arm: str, most: int) -> None:
    machine, chain = table_arm(ARMS[arm])
    q = np.array([[0.1, -1.2, 1.4, -0.7, 0.0, 0.3]])
    answer = inverse_kinematics(
        machine, chain, poses(machine, chain, q), np.zeros((1, 6)), Options(every=True, most=most)
    )
    assert answer.complete == [False]
    check_sample(chain, answer.qs)
    assert 8 < len(answer.qs) <= most


def test_a_singular_wrist_is_no_complete_answer_however_many_are_asked_for() -> None:
    machine, chain = table_arm(DECOUPLED)
    q = Q6.copy()
    q[4] = 0.0
    target = poses(machine, chain, q[None])
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 6)), Options(every=True, most=5000))
    assert answer.complete == [False]


@pytest.mark.parametrize("scale", [1.0, 0.1, 10.0])
@pytest.mark.parametrize("elbow", [0.0, np.pi])
def test_a_double_solution_stands_once(elbow: float, scale: float) -> None:
    machine, chain = planar_arm(scale, 0.7 * scale)
    target = poses(machine, chain, np.array([[0.3, elbow]]))
    answer = inverse_kinematics(machine, chain, target, np.array([[0.1, 0.4]]), Options(task=PLANAR, every=True))
    assert len(answer.qs) == 1
    assert np.abs(same_turn(answer.qs - [0.3, elbow])).max() < 1e-3


def test_a_double_solution_of_three_links_stands_once() -> None:
    machine, chain = planar_arm(0.5, 0.4, 0.3)
    rng = np.random.default_rng(2)
    qs = np.column_stack((rng.uniform(-3, 3, 30), rng.choice([0.0, np.pi], 30), rng.uniform(-3, 3, 30)))
    answer = inverse_kinematics(machine, chain, poses(machine, chain, qs), np.full((1, 3), 0.5), Options(every=True))
    assert np.diff(answer.firsts).tolist() == [1] * 30


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", [0, 1])
def test_a_stretched_elbow_halves_the_number_of_solutions(seed: int) -> None:
    machine, chain = table_arm(DECOUPLED)
    q = Q6.copy()
    q[2] = np.pi / 2
    options = Options(every=True, random_seed=seed)
    answer = inverse_kinematics(machine, chain, poses(machine, chain, q[None]), np.full((1, 6), 0.4), options)
    assert len(answer.qs) == 4
    assert contains(answer.qs, q, close=1e-3)


def test_a_target_above_the_shoulder_is_a_continuum() -> None:
    machine, chain = table_arm([(0, np.pi / 2, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")
    answer = inverse_kinematics(machine, chain, at(0.0, 0.0, 0.6), np.zeros((1, 3)), Options(task=POSITION, every=True))
    assert answer.complete == [False]
    assert len(answer.qs) > 20
    check_sample(chain, answer.qs)


def test_every_says_why_there_is_none() -> None:
    machine, chain = table_arm(UR5)
    near = poses(machine, chain, draw(chain, 3, seed=36))
    near.positions[1] = [5.0, 0.0, 0.0]
    answer = inverse_kinematics(machine, chain, near, np.zeros((1, 6)), Options(every=True))
    assert answer.statuses == ["solved", "unreachable", "solved"]
    assert answer.firsts[1] == answer.firsts[2]
    assert set(answer.failures) == {1}
    assert np.diff(answer.firsts)[[0, 2]].min() >= 2


def test_every_with_a_partial_task_is_a_sample() -> None:
    machine, chain = table_arm(UR5)
    target = poses(machine, chain, draw(chain, 1, seed=37))
    task = Task(("x", "y", "z", "rx", "ry"))
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 6)), Options(every=True, task=task))
    assert answer.complete == [False]
    check_sample(chain, answer.qs)
    reached = poses(machine, chain, answer.qs)
    np.testing.assert_allclose(
        reached.rotations[:, :, 2], np.tile(target.rotations[0, :, 2], (len(answer.qs), 1)), atol=1e-6
    )
