"""The course's methods, number by number: sequences of errors, iterations, where they fail, and all solutions."""

import numpy as np
import pytest

from gelenk.ik.search.descent import damped_step, gradient_step, newton_step
from gelenk.ik.search.problem import DescentRule
from gelenk.ik.search.words import IterationPath, StepMethod
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from tests.ik.arms import (
    DECOUPLED,
    PLANAR,
    POSITION,
    Q6,
    UR5,
    assert_solved,
    at,
    contains,
    planar_arm,
    poses,
    table_arm,
)
from tests.oracles.dh_columns import Table

TARGET = at(0.9, 0.8)
START = np.array([0.3, 1.2])
LINKS = np.array([1.0, 0.7])
SIGMA_MAX_BOUND = 1.218183589694
"""2 / σ²_max(J) at the solution that the gradient converges to."""


def followed(
    method: StepMethod,
    start: Array = START,
    target: Poses = TARGET,
    *,
    step_size: float | None = None,
    damping: float | None = None,
    tolerance: float = 1e-6,
    iterations: int | None = None,
) -> tuple[InverseKinematics, IterationPath]:
    """What one method does on the blackboard's two links."""
    machine, chain = planar_arm(*LINKS)
    options = Options(
        task=PLANAR,
        method=method,
        rule=DescentRule(method, step_size=step_size, damping=damping),
        position_tolerance=tolerance,
        max_iterations=iterations,
        respect_limits=False,
        trace=True,
    )
    answer = inverse_kinematics(machine, chain, target, start[None], options)
    assert answer.paths is not None
    return answer, answer.paths[0]


def errors(path: IterationPath) -> list[float]:
    """‖e‖ of each iterate."""
    assert path.trace is not None
    return [iterate.error for iterate in path.trace]


def positions(path: IterationPath) -> Array:
    """Each iterate."""
    assert path.trace is not None
    return np.array([iterate.joint_positions for iterate in path.trace])


def closed_form(q: Array) -> tuple[Array, Array]:
    """Position and Jacobian of the two links as the blackboard has them."""
    (l1, l2), (c1, s1), (c12, s12) = LINKS, *((np.cos(a), np.sin(a)) for a in (q[0], q[0] + q[1]))
    p = np.array([l1 * c1 + l2 * c12, l1 * s1 + l2 * s12])
    return p, np.array([[-l1 * s1 - l2 * s12, -l2 * s12], [l1 * c1 + l2 * c12, l2 * c12]])


# Newton


def test_newton_on_two_links_takes_the_courses_steps() -> None:
    answer, path = followed("newton", tolerance=1e-12)
    expected = [2.203170127e-1, 3.397687680e-2, 4.742096728e-4, 9.258881658e-8]
    np.testing.assert_allclose(errors(path)[:4], expected, rtol=1e-9, atol=1e-15)
    assert len(errors(path)) == 5
    assert errors(path)[4] < 1e-14
    assert answer.statuses == ["solved"]
    assert answer.iterations.tolist() == [4]
    assert path.stop_reason == "converged"


def test_newtons_iterates_carry_their_steps_and_singular_values() -> None:
    _, path = followed("newton", tolerance=1e-12)
    assert path.trace is not None
    qs = positions(path)
    for k, iterate in enumerate(path.trace):
        p, J = closed_form(np.array(iterate.joint_positions))
        assert abs(iterate.error - np.linalg.norm(TARGET.positions[0, :2] - p)) < 1e-15
        assert abs(iterate.min_singular_value - np.linalg.svd(J)[1][-1]) < 1e-14
        if k + 1 < len(path.trace):
            step = np.linalg.solve(J, TARGET.positions[0, :2] - p)
            np.testing.assert_allclose(qs[k + 1] - qs[k], step, rtol=1e-9, atol=1e-14)
            assert iterate.step_length == pytest.approx(np.linalg.norm(step), rel=1e-9, abs=1e-14)
            assert iterate.method == "newton"
        else:
            assert iterate.step_length is None
            assert iterate.method is None


def test_newton_on_a_sliding_arm_takes_the_courses_steps() -> None:
    machine, chain = table_arm([(0, np.pi / 2, 0.5, 0), (0, np.pi / 2, 0, np.pi / 2), (0, 0, 0, 0)], "RRP")
    options = Options(task=POSITION, method="newton", trace=True, respect_limits=False)
    answer = inverse_kinematics(machine, chain, at(1, 1, 1), np.array([[0.0, 0.0, 1.0]]), options)
    assert answer.paths is not None
    expected = [1.118033989, 0.587651404, 0.2089903438, 1.568433273e-2, 6.505797e-5, 1.482e-9]
    np.testing.assert_allclose(errors(answer.paths[0])[:5], expected[:5], rtol=1e-6)
    assert errors(answer.paths[0])[5] == pytest.approx(expected[5], rel=1e-3)
    np.testing.assert_allclose(answer.qs[0], [np.pi / 4, 0.339836909454, 1.5], atol=1e-8)


def test_every_solution_of_the_sliding_arm() -> None:
    machine, chain = table_arm([(0, np.pi / 2, 0.5, 0), (0, np.pi / 2, 0, np.pi / 2), (0, 0, 0, 0)], "RRP")
    options = Options(task=POSITION, every=True, respect_limits=False)
    answer = inverse_kinematics(machine, chain, at(1, 1, 1), np.array([[0.1, 0.1, 1.0]]), options)
    assert answer.complete == [True]
    assert len(answer.qs) == 4
    q2 = 0.339836909454
    for q in ([np.pi / 4, q2, 1.5], [-2.356194490192, 2.801755744136, 1.5]):
        assert contains(answer.qs, q)
    for q in ([np.pi / 4, q2 - np.pi, -1.5], [-3 * np.pi / 4, -q2, -1.5]):
        assert contains(answer.qs, q)


def test_newton_on_a_ur5_takes_the_courses_steps() -> None:
    machine, chain = table_arm(UR5)
    target = poses(machine, chain, np.array([[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]]))
    options = Options(method="newton", trace=True)
    answer = inverse_kinematics(machine, chain, target, np.array([[0.0, -1.0, 1.2, -0.5, 0.7, 0.0]]), options)
    assert answer.paths is not None
    assert answer.statuses == ["solved"]
    found = errors(answer.paths[0])
    np.testing.assert_allclose(found[:4], [0.3825609, 0.04677841, 0.002532375, 5.804e-6], rtol=1e-4)
    assert found[4] == pytest.approx(3.6e-11, rel=0.05)


def test_newton_close_to_a_singularity_leaps() -> None:
    _, path = followed("newton", np.array([0.3, 0.001]))
    qs = positions(path)
    np.testing.assert_allclose(qs[1] - qs[0], [-603.28, 1465.83], atol=0.006)


@pytest.mark.parametrize("elbow", [0.0, np.pi])
def test_newton_at_a_singularity_says_so(elbow: float) -> None:
    answer, path = followed("newton", np.array([0.3, elbow]))
    assert answer.statuses == ["singular"]
    assert path.stop_reason == "near_singular"
    np.testing.assert_array_equal(answer.failures[0].nearest, [0.3, elbow])
    directions = answer.failures[0].unserved_directions
    assert directions is not None
    np.testing.assert_allclose(np.abs(directions), [[np.cos(0.3), np.sin(0.3), 0, 0, 0, 0]], atol=1e-9)


# The gradient


def test_the_gradient_takes_the_courses_steps() -> None:
    answer, path = followed("gradient", step_size=0.3)
    np.testing.assert_allclose(errors(path)[:4], [0.2203170127, 0.2048157232, 0.1924963978, 0.1809979782], rtol=1e-9)
    assert len(errors(path)) - 1 == 137
    assert answer.iterations.tolist() == [137]
    assert path.stop_reason == "converged"


@pytest.mark.parametrize("step_size", [0.3, 1.2, 1.25, 2.0])
def test_the_gradients_first_steps_are_the_transpose_of_the_jacobian(step_size: float) -> None:
    _, path = followed("gradient", step_size=step_size, iterations=15)
    q = START
    for found in positions(path):
        np.testing.assert_allclose(found, q, atol=1e-12)
        p, J = closed_form(q)
        q = q + step_size * J.T @ (TARGET.positions[0, :2] - p)


@pytest.mark.slow
def test_the_gradient_converges_below_its_bound_and_cycles_above() -> None:
    assert 1.2 < SIGMA_MAX_BOUND < 1.25
    answer, _ = followed("gradient", step_size=1.2)
    assert answer.statuses == ["solved"]
    _, J = closed_form(answer.qs[0])
    assert pytest.approx(SIGMA_MAX_BOUND, abs=1e-5) == 2.0 / np.linalg.norm(J, 2) ** 2

    answer, path = followed("gradient", step_size=1.25)
    assert answer.statuses == ["not_converged"]
    assert path.stop_reason == "iterations"
    assert sorted(errors(path)[-2:]) == pytest.approx([0.1953, 0.2080], abs=5e-5)
    np.testing.assert_allclose(errors(path)[-2:], errors(path)[-4:-2], rtol=1e-9)


@pytest.mark.slow
def test_the_gradient_wanders_with_too_long_steps() -> None:
    answer, path = followed("gradient", step_size=2.0)
    assert answer.statuses == ["not_converged"]
    assert max(errors(path)) > 1.28
    assert np.ptp(errors(path)[-100:]) > 0.1


def test_the_gradient_with_line_search_never_gets_worse() -> None:
    answer, path = followed("gradient")
    assert answer.statuses == ["solved"]
    assert (np.diff(errors(path)) < 0.0).all()


@pytest.mark.parametrize("method", ["gradient", "gradient_then_newton", "damped_least_squares"])
def test_an_error_in_the_kernel_of_the_transpose_holds_every_descent(method: StepMethod) -> None:
    answer, path = followed(method, np.zeros(2), at(0.5, 0.0), step_size=0.3)
    assert path.stop_reason == "stagnated"
    assert answer.statuses == ["singular"]
    assert errors(path) == pytest.approx([1.2], abs=1e-15)
    assert "ker J" in answer.failures[0].reason


@pytest.mark.parametrize("step_size", [0.3, None])
def test_the_gradient_ends_at_the_nearest_point_of_an_unreachable_target(step_size: float | None) -> None:
    answer, path = followed("gradient", target=at(2.0, 1.0), step_size=step_size)
    failure = answer.failures[0]
    assert answer.statuses == ["unreachable"]
    assert path.stop_reason == "stagnated"
    np.testing.assert_allclose(failure.nearest, [0.463647609001, 0.0], atol=1e-6)
    assert failure.position_error == pytest.approx(np.sqrt(5.0) - 1.7, abs=1e-12)


def test_gradient_then_newton_changes_over_at_the_bound() -> None:
    answer, path = followed("gradient_then_newton", step_size=0.3, tolerance=1e-12)
    assert answer.statuses == ["solved"]
    assert path.trace is not None
    methods = [iterate.method for iterate in path.trace]
    assert methods == ["gradient"] * 38 + ["newton"] * 3 + [None]
    assert path.trace[37].error > 1e-2 >= path.trace[38].error


# Steps


@pytest.mark.parametrize(
    ("q", "step"),
    [
        ((0.3, 0.0), (0.128903591245, 0.053077949336)),
        ((0.3, 0.01), (0.155292411056, -0.012313177686)),
        ((0.3, 0.8), (0.400352039277, -0.717102790513)),
    ],
)
def test_the_damped_step_is_the_courses(q: tuple[float, float], step: tuple[float, float]) -> None:
    _, J = closed_form(np.array(q))
    np.testing.assert_allclose(damped_step(J, np.array([0.1, 0.3]), 0.01), step, atol=5e-13)


def test_newtons_step_is_the_inverse_and_at_a_singularity_the_pseudo_inverse() -> None:
    e = np.array([0.1, 0.3])
    np.testing.assert_allclose(newton_step(closed_form(np.array([0.3, 0.8]))[1], e), (0.435936662598, -0.802739372970))
    np.testing.assert_allclose(newton_step(closed_form(np.array([0.3, 0.01]))[1], e), (18.675406047, -44.988660444))
    stretched = closed_form(np.array([0.3, 0.0]))[1]
    np.testing.assert_allclose(newton_step(stretched, e), (0.129284962817, 0.053234984689), atol=5e-13)
    assert np.linalg.norm(stretched @ newton_step(stretched, e) - e) == pytest.approx(0.184189710911, abs=1e-12)


def test_newtons_step_of_a_redundant_arm_is_the_shortest() -> None:
    lengths = (0.5, 0.4, 0.3)
    J = Table(True, [(length, 0, 0, 0) for length in lengths], [False] * 3).jacobian([0.2, 0.7, -0.4])[:2]
    step = newton_step(J, np.array([0.1, -0.2]))
    np.testing.assert_allclose(step, (-0.216376453299, 0.063295865052, -0.059267018808), atol=5e-13)
    assert abs(step @ [0.260506746411, -0.013391372108, -0.965379151540]) < 1e-11


def test_a_damped_step_solves_its_least_squares_problem() -> None:
    rng = np.random.default_rng(5)
    for shape in ((6, 7), (6, 6), (6, 4), (2, 3), (3, 1)):
        J, e, damping = rng.normal(size=shape), rng.normal(size=shape[0]), 0.03
        stacked = np.vstack((J, np.sqrt(damping) * np.eye(shape[1])))
        expected = np.linalg.lstsq(stacked, np.append(e, np.zeros(shape[1])), rcond=None)[0]
        np.testing.assert_allclose(damped_step(J, e, damping), expected, atol=1e-12)
        np.testing.assert_allclose(gradient_step(J, e, 0.2), 0.2 * np.einsum("ij,i->j", J, e), atol=1e-14)


def test_constant_damping_is_taken_as_it_stands() -> None:
    _, path = followed("damped_least_squares", damping=0.01, iterations=4)
    q = START
    for found in positions(path):
        np.testing.assert_allclose(found, q, atol=1e-12)
        p, J = closed_form(q)
        e = TARGET.positions[0, :2] - p
        q = q + np.linalg.solve(J.T @ J + 0.01 * np.eye(2), J.T @ e)


# Every solution


def test_two_links_have_two_solutions() -> None:
    machine, chain = planar_arm(*LINKS)
    answer = inverse_kinematics(machine, chain, TARGET, np.array([[0.2, 0.4]]), Options(task=PLANAR, every=True))
    assert answer.complete == [True]
    expected = [[0.106585970938, 1.599371644064], [1.346698710425, -1.599371644064]]
    np.testing.assert_allclose(answer.qs, expected, atol=1e-9)


def test_the_scara_has_two_solutions() -> None:
    parameters = [(0.325, 0, 0.387, 0), (0.275, np.pi, 0, 0), (0, 0, 0, 0), (0, 0, 0.05, 0)]
    machine, chain = table_arm(parameters, "RRPR")
    q = np.array([[0.4, 0.8, 0.12, -0.3]])
    target = poses(machine, chain, q)
    np.testing.assert_allclose(target.positions, [[0.398993205532, 0.382871709891, 0.217]], atol=1e-12)
    answer = inverse_kinematics(machine, chain, target, q + 0.1, Options(every=True))
    assert_solved(machine, chain, target, answer)
    assert answer.complete == [True]
    assert len(answer.qs) == 2
    assert contains(answer.qs, q[0])
    assert contains(answer.qs, [1.129563599263, -0.8, 0.12, -1.170436400737])


def test_the_anthropomorphic_arm_has_four_solutions() -> None:
    machine, chain = table_arm([(0, np.pi / 2, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")
    target = at(0.768753959783, 0.237803466792, 0.202853504379)
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 3)), Options(task=POSITION, every=True))
    assert answer.complete == [True]
    assert len(answer.qs) == 4
    for q in (
        [0.3, -0.106114973898, 0.8],
        [0.3, 0.6, -0.8],
        [-2.841592653590, 2.541592653590, 0.8],
        [-2.841592653590, -3.035477679692, -0.8],
    ):
        assert contains(answer.qs, q)


def by_decoupling(T: Array) -> list[list[float]]:
    """The eight solutions of the decoupled arm: the wrist's centre first, then the wrist as ZYZ angles."""
    table = Table(True, DECOUPLED, [False] * 6)
    wrist = T[:3, 3] - 0.1 * T[:3, 2]
    height = wrist[2] - 0.3
    solutions = []
    for side in (1.0, -1.0):
        out = side * np.hypot(wrist[0], wrist[1])
        q1 = np.arctan2(side * wrist[1], side * wrist[0])
        # The forearm, 0.4 long, leaves the elbow a quarter turn behind q3.
        cosine = (out**2 + height**2 - 0.5**2 - 0.4**2) / (2 * 0.5 * 0.4)
        for bend in (np.arccos(cosine), -np.arccos(cosine)):
            q2 = np.arctan2(height, out) - np.arctan2(0.4 * np.sin(bend), 0.5 + 0.4 * np.cos(bend))
            q3 = bend + np.pi / 2
            R = table.frames([q1, q2, q3, 0.0, 0.0, 0.0])[3][:3, :3].T @ T[:3, :3]
            for flip in (1.0, -1.0):
                q4 = np.arctan2(flip * R[1, 2], flip * R[0, 2])
                q5 = np.arctan2(flip * np.hypot(R[0, 2], R[1, 2]), R[2, 2])
                q6 = np.arctan2(flip * R[2, 1], -flip * R[2, 0])
                solutions.append([q1, q2, q3, q4, q5, q6])
    return solutions


def test_the_decoupled_arm_has_eight_solutions() -> None:
    machine, chain = table_arm(DECOUPLED)
    target = poses(machine, chain, Q6[None])
    np.testing.assert_allclose(target.positions, [[0.843884090787, 0.244754073854, 0.532667280031]], atol=1e-12)
    closed = by_decoupling(target.matrices()[0])
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 6)), Options(every=True))
    assert_solved(machine, chain, target, answer, far=1e-9)
    assert answer.complete == [True]
    assert len(answer.qs) == 8
    for q in closed:
        assert contains(answer.qs, q)


def test_decoupling_and_the_search_agree_on_random_poses() -> None:
    machine, chain = table_arm(DECOUPLED)
    qs = np.random.default_rng(2).uniform(-np.pi, np.pi, (15, 6))
    targets = poses(machine, chain, qs)
    answer = inverse_kinematics(machine, chain, targets, np.full((1, 6), 0.1), Options(every=True))
    for i, T in enumerate(targets.matrices()):
        found = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        closed = by_decoupling(T)
        assert len(found) == len(closed) == 8
        assert all(contains(found, q) for q in closed)


def test_the_ur5_has_eight_solutions() -> None:
    machine, chain = table_arm(UR5)
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    target = poses(machine, chain, q[None])
    answer = inverse_kinematics(machine, chain, target, np.zeros((1, 6)), Options(every=True))
    assert_solved(machine, chain, target, answer, far=1e-9)
    assert answer.complete == [True]
    assert len(answer.qs) == 8
    assert contains(answer.qs, q)
    # Shoulder, wrist and elbow: two of each, independently.
    for joint, count in ((0, 2), (4, 4)):
        values = np.sort(answer.qs[:, joint])
        assert 1 + int((np.diff(values) > 1e-6).sum()) == count


@pytest.mark.quick(1)
@pytest.mark.parametrize(("method", "most"), [("newton", 100), ("gradient", 5000), ("damped_least_squares", 500)])
def test_without_a_bound_a_method_has_its_own_number_of_iterations(method: StepMethod, most: int) -> None:
    _, path = followed(method, target=at(5.0, 0.0), step_size=1e-6, damping=1e3)
    assert path.stop_reason == "iterations"
    assert len(errors(path)) - 1 == most


def test_a_seed_at_the_target_takes_no_step() -> None:
    machine, chain = table_arm(UR5)
    q = np.array([[0.1, -1.2, 1.4, -0.7, 0.5, 0.3]])
    answer = inverse_kinematics(machine, chain, poses(machine, chain, q), q, Options(method="newton"))
    assert answer.iterations.tolist() == [0]
    np.testing.assert_array_equal(answer.qs, q)
