"""Worked solutions of velocity kinematics: the course's numbers, and agreement with the core."""

import re
from typing import Any, get_args

import numpy as np
import pytest

from gelenk.course.steps import Step
from gelenk.course.velocity.ellipsoid_steps import EllipsoidQuestion, ellipsoid_steps
from gelenk.course.velocity.geometry import ChainGeometry, chain_geometry
from gelenk.course.velocity.inverse_question import InverseQuestion, derivation
from gelenk.course.velocity.inverse_steps import inverse_steps
from gelenk.course.velocity.inverses import LectureInverse
from gelenk.course.velocity.jacobian_steps import (
    JacobianQuestion,
    derived_jacobian,
    euler_rates,
    euler_rates_variation,
    jacobian_steps,
    time_variation,
)
from gelenk.course.velocity.null_space_steps import NullSpaceWish, ObjectiveName
from gelenk.course.velocity.statics_steps import StaticsQuestion, statics_steps
from gelenk.course.velocity.tip_motion_steps import known_part, tip_motion_steps
from gelenk.course.velocity.writing import number, row
from gelenk.ik.search.problem import Objective
from gelenk.ik.search.task import Task
from gelenk.kinematics.ellipsoids.manipulability import manipulability
from gelenk.kinematics.velocity.inverse_velocity import descent, kept_from_limits
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.linear_inverse import InverseRule, invert
from gelenk.kinematics.velocity.task_space import TaskSpace
from gelenk.robot.arrays import Array
from gelenk.robot.notations import rpy_from_rotations, zyz_from_rotations
from tests.kinematics.test_inverse_velocity import PLANAR_2R, PLANAR_3R
from tests.kinematics.test_jacobian import CHAINS, Ends, chain_of
from tests.oracles.written import value
from tests.robots import of_table, robot, samples

VIEWS = ["local_world_aligned", "local", "world", "space_screws", "body_screws", "zyz", "rpy"]
BENT = [0.3, 0.8]


def planar(q: list[float]) -> ChainGeometry:
    """The course's arm of 1 m and 0.7 m, or of 0.5, 0.4 and 0.3 m."""
    chain = of_table(PLANAR_2R if len(q) == 2 else PLANAR_3R).chain(None, None)
    return chain_geometry(chain.flat, np.array(q))


def question(q: list[float], v: list[float], rank: int = 2, damping: float = 0.0, **options: Any) -> InverseQuestion:
    """An inverse velocity in the plane."""
    weights = np.array(options.pop("weights", [1.0] * len(q)))
    inverse = LectureInverse(planar(q).jacobian()[:2], rank, weights, damping)
    return InverseQuestion(
        inverse, "damped" if damping else "pseudo_inverse", np.array(v), (np.zeros(2), []), **options
    )


def latex(steps: list[Step]) -> str:
    """All formulas; each has its plain text."""
    assert all(len(step.latex) == len(step.plain) and step.title and step.text for step in steps)
    return "\n".join(line for step in steps for line in step.latex)


@pytest.mark.quick(5)
@pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
@pytest.mark.parametrize("view", VIEWS)
def test_columns_by_geometry_are_those_of_the_kernels(ends: Ends, view: str) -> None:
    """Also of joints that follow others, and in each reference and representation, with their time variation."""
    machine, chain = chain_of(ends)
    qs = samples(chain, 3)
    rates = np.random.default_rng(1).uniform(-1.0, 1.0, qs.shape)
    kind: Any = {"reference": view} if view in VIEWS[:5] else {"representation": view}
    expected = jacobians(machine, chain, qs, derivatives=True, **kind)
    angles = (rpy_from_rotations if view == "rpy" else zyz_from_rotations)(expected.poses.rotations)
    variations = expected.time_variations(rates)
    for i, q in enumerate(qs):
        asked = JacobianQuestion(chain_geometry(chain.flat, q), view, angles[i], 1e-10, rates[i])
        size = np.abs(variations[i]).max()
        assert derived_jacobian(asked)[0] == pytest.approx(expected.values[i], abs=1e-11)
        assert time_variation(asked, rates[i])[0] == pytest.approx(variations[i], abs=1e-10 * (1.0 + size))
        shown = latex(jacobian_steps(asked))
        assert number(np.linalg.svd(expected.values[i], compute_uv=False)[0]) in shown


def test_item_30_and_31_name_both_singularities() -> None:
    steps = jacobian_steps(JacobianQuestion(planar(BENT), "local_world_aligned", np.zeros(3), 1e-10))
    assert r"J_{1} = \begin{bmatrix} z_{0} \times p_{0,EE} \\ z_{0} \end{bmatrix} = (-0.919365" in latex(steps)
    angles = np.array([0.4, 0.7, -1.1])
    assert np.linalg.det(euler_rates("zyz", angles)) == pytest.approx(-np.sin(0.7))
    assert np.linalg.det(euler_rates("rpy", angles)) == pytest.approx(np.cos(0.7))
    for view in ("zyz", "rpy"):
        rates, step = np.array([0.3, -0.2, 0.5]), 1e-6
        ahead, behind = (euler_rates(view, angles + sign * step * rates) for sign in (1, -1))
        assert euler_rates_variation(view, angles, rates) == pytest.approx((ahead - behind) / (2 * step), abs=1e-8)


def test_item_32_the_jerk_has_the_factor_two() -> None:
    geometry = planar(BENT)
    rates = np.array([[0.5, -0.4], [0.2, 0.9]])
    J, dJ = geometry.jacobian()[:2], geometry.time_variation(rates[0])[:2]
    shown = latex(tip_motion_steps([J, dJ], rates))
    assert r"\begin{bmatrix} -0.987343 \\ 0.460218 \end{bmatrix}" in shown
    ahead, behind = (planar(list(np.array(BENT) + t * rates[0] + t * t / 2 * rates[1])) for t in (1e-6, -1e-6))
    velocities = [rates[0] + t * rates[1] for t in (1e-6, -1e-6)]
    ddJ = (ahead.time_variation(velocities[0]) - behind.time_variation(velocities[1]))[:2] / 2e-6
    rates = np.vstack((rates, [-0.3, 0.6]))
    steps = tip_motion_steps([J, dJ, ddJ], rates)
    assert r"2\dot J \ddot q" in latex(steps)
    assert steps[2].latex[-1].endswith(r"\begin{bmatrix} -0.452315 \\ -0.605605 \end{bmatrix}")
    known, _ = known_part(3, [J, dJ, ddJ], rates[:2])
    assert known + J @ rates[2] == pytest.approx([-0.452315263417, -0.605605301837], abs=1e-8)


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        (question(BENT, [0.1, 0.3]), [0.435936662598, -0.802739372970]),
        (question([0.3, 0.0], [0.1, 0.3], rank=1), [0.129284962817, 0.053234984689]),
        (question([0.2, 0.7, -0.4], [0.1, -0.2]), [-0.216376453299, 0.063295865052, -0.059267018808]),
        (
            question([0.2, 0.7, -0.4], [0.1, -0.2], weights=[1.0, 2.0, 4.0]),
            [-0.228097579838, 0.063898390588, -0.015831171758],
        ),
        (question([0.3, 0.0], [0.1, 0.3], rank=1, damping=0.01), [0.128903591245, 0.053077949336]),
        (question([0.3, 0.01], [0.1, 0.3], damping=0.01), [0.155292411056, -0.012313177686]),
        (question([0.3, 0.01], [0.1, 0.3]), [18.675406047, -44.988660444]),
        (question(BENT, [0.1, 0.3], damping=0.01), [0.400352039277, -0.717102790513]),
    ],
)
def test_items_33_to_36_by_the_formula_of_the_case(asked: InverseQuestion, expected: list[float]) -> None:
    """And the steps show that solution, and four conditions that hold."""
    assert asked.solution() == pytest.approx(expected, rel=1e-9)
    steps = inverse_steps(asked)
    assert steps[-1].latex[0].endswith(r" \\ ".join(number(x) for x in expected) + r" \end{bmatrix}")
    assert max(derivation(asked).moore_penrose) < 1e-9
    assert len({step.title for step in steps}) == len(steps)


def test_item_35_objective_error_and_gains() -> None:
    found = derivation(question([0.3, 0.0], [0.1, 0.3], rank=1, damping=0.01))
    assert found.damped_error == pytest.approx([0.175739071661, 0.055156171459], abs=1e-12)
    v, x, e = np.array([0.1, 0.3]), np.array([0.128903591245, 0.053077949336]), np.array(found.damped_error)
    assert found.damped_objective == pytest.approx(0.01 * x @ x + e @ e, abs=1e-11)
    J = planar([0.3, 0.0]).jacobian()[:2]
    assert e == pytest.approx(0.01 * np.linalg.solve(J @ J.T + 0.01 * np.eye(2), v), abs=1e-12)
    sigma = np.linalg.svd(J, compute_uv=False)[0]
    assert found.gains == pytest.approx([sigma / (sigma**2 + 0.01), 0.0], abs=1e-12)
    rng = np.random.default_rng(0)
    others = [x + 0.1 * rng.normal(size=2) for _ in range(50)]
    assert all(0.01 * y @ y + np.sum((J @ y - v) ** 2) > (found.damped_objective or 0.0) for y in others)


def test_item_36_pseudo_inverse_and_kernel() -> None:
    stretched = derivation(question([0.3, 0.0], [0.1, 0.3], rank=1))
    assert stretched.case == "rank_deficient"
    expected = [[-0.148634423469, 0.480494683880], [-0.061202409664, 0.197850752186]]
    assert np.array(stretched.pseudo_inverse) == pytest.approx(np.array(expected), abs=1e-12)
    redundant = derivation(question([0.2, 0.7, -0.4], [0.1, -0.2]))
    kernel = np.array([0.260506746411, -0.013391372108, -0.965379151540])
    assert redundant.case == "wide"
    assert np.array(redundant.null_space_projector) == pytest.approx(np.outer(kernel, kernel), abs=1e-11)


@pytest.mark.parametrize("shape", [(2, 2), (2, 5), (5, 2), (6, 7), (3, 3)])
@pytest.mark.parametrize("rank_lost", [0, 1])
@pytest.mark.parametrize("damping", [0.0, 1e-14, 0.3])
@pytest.mark.parametrize("weighted", [False, True])
def test_every_case_solves_as_the_core_does(
    shape: tuple[int, int], rank_lost: int, damping: float, weighted: bool
) -> None:
    rng = np.random.default_rng(3)
    m, n = shape
    rank = min(m, n) - rank_lost
    J = rng.normal(size=(m, rank)) @ rng.normal(size=(rank, n))
    b, xi = rng.normal(size=m), rng.normal(size=n)
    weights = rng.uniform(0.5, 4.0, n) if weighted else np.ones(n)
    rule = InverseRule("damped" if damping else "pseudo_inverse", damping=damping or None, weights=weights)
    expected = invert(J[None], b[None], rule, np.ones(m), xi[None])
    inverse = LectureInverse(J, rank, weights, damping)
    asked = InverseQuestion(inverse, rule.inverse, b, (np.zeros(m), []), wish=NullSpaceWish(xi))
    assert asked.solution() == pytest.approx(expected.xs[0], rel=1e-6, abs=1e-8)
    found = derivation(asked)
    assert max(found.moore_penrose) < 1e-8
    assert np.array(found.null_space_projector) @ xi == pytest.approx(found.null_space_motion)
    assert J @ np.array(found.null_space_motion) == pytest.approx(np.zeros(m), abs=1e-10)
    latex(inverse_steps(asked))


@pytest.mark.parametrize("name", [name for name in get_args(ObjectiveName) if name != "clearance"])
def test_the_gradient_is_that_of_the_objective_shown(name: ObjectiveName) -> None:
    """Differences of H, whose formula shares no code with the gradient's."""
    chain = robot("panda").chain(None, None)
    q = np.array([0.3, -0.9, 0.2, -1.9, 0.4, 1.8, 0.5])
    posture = np.zeros(7) if name == "posture" else None
    space = TaskSpace(Task(("x", "y", "z")))
    xi = descent(chain, q[None], Objective(name, posture), 0.5, space)[0]

    def wish(q: Array) -> float:
        at = kept_from_limits(chain, q[None])[0] if name == "limits" else q
        value = NullSpaceWish(xi, 1.0, name, 0.5, at, chain.lower, chain.upper, posture).value(
            chain_geometry(chain.flat, q).jacobian()[:3]
        )
        assert value is not None
        return value

    differences = [(wish(q + 1e-6 * axis) - wish(q - 1e-6 * axis)) / 2e-6 for axis in np.eye(7)]
    assert NullSpaceWish(xi, gain=0.5).gradient == pytest.approx(differences, abs=1e-6)


def shown_torques(asked: StaticsQuestion) -> Array:
    """The torques by lever arms as they are written; those of joints that follow others add up."""
    torques = np.zeros(asked.geometry.variables)
    for line in statics_steps(asked)[0].latex:
        if found := re.match(r"(?:\\Delta )?\\tau_\{(\d+)\} = .* = (.*)", line):
            torques[int(found[1]) - 1] += value(found[2])
    return torques


@pytest.mark.parametrize("ends", CHAINS.values(), ids=CHAINS)
def test_lever_arms_give_the_torques_of_the_transposed_jacobian(ends: Ends) -> None:
    """For a wrench in other axes at another point too."""
    machine, chain = chain_of(ends)
    q = samples(chain, 1)[0]
    rng = np.random.default_rng(2)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    geometry, wrench = chain_geometry(chain.flat, q), rng.normal(size=6)
    point = geometry.position + rng.normal(size=3)
    moved = jacobians(machine, chain, q[None]).values[0]
    moved[:3] += np.cross(moved[3:], point - geometry.position, axisa=0, axisc=0)
    J = np.vstack((axes.T @ moved[:3], axes.T @ moved[3:]))
    rank = int(np.linalg.matrix_rank(J))
    asked = StaticsQuestion(geometry, J, rank, point, axes, np.arange(6), wrench, J.T @ wrench)
    assert shown_torques(asked) == pytest.approx(J.T @ wrench, rel=1e-5, abs=1e-5)
    assert row(J.T @ wrench) in latex(statics_steps(asked))


def test_items_37_and_38() -> None:
    geometry = planar(BENT)
    J = geometry.jacobian()[:2]
    plane = np.array([0, 1])
    asked = StaticsQuestion(geometry, J, 2, geometry.position, np.eye(3), plane, np.array([10.0, -5.0]), np.zeros(2))
    assert shown_torques(asked) == pytest.approx([-15.5579, -7.82604], abs=1e-9)
    stretched = planar([0.3, 0.0])
    J = stretched.jacobian()[:2]
    asked = StaticsQuestion(stretched, J, 1, stretched.position, np.eye(3), plane, None, np.zeros(2))
    shown = latex(statics_steps(asked))
    assert r"\mathrm{range}(J) \oplus \ker(J^{\mathsf T}) = \mathbb{R}^{2},\quad 1 + 1 = 2" in shown
    assert row(np.linalg.svd(J)[0][:, 1]) in shown


def test_a_wrench_of_torques_says_which_inverse() -> None:
    geometry = planar(BENT)
    J, torques = geometry.jacobian()[:2], np.array([1.0, 2.0])
    gamma = np.linalg.solve(J.T, torques)
    options = (geometry.position, np.eye(3), np.array([0, 1]), gamma, torques, None, True)
    assert rf"\gamma = J^{{-\mathsf T}} \tau = {row(gamma)}" in latex(
        statics_steps(StaticsQuestion(geometry, J, 2, *options))
    )
    assert r"(J^{\mathsf T})^{\#}" in latex(statics_steps(StaticsQuestion(geometry, J, 1, *options)))


def test_items_49_to_51() -> None:
    J = planar(BENT).jacobian()[:3]
    asked = EllipsoidQuestion("translation", J, np.eye(3)[:, :2], 2, 2, np.array([[1.0, 0.0, 0.0]]))
    values, axes = asked.eigenvalues()
    assert np.sqrt(values) == pytest.approx([1.693355501046, 0.296540958658], abs=1e-11)
    assert np.degrees(np.arctan2(axes[1, 0], axes[0, 0])) == pytest.approx(129.959172237, abs=1e-8)
    shown = latex(ellipsoid_steps(asked))
    for expected in (0.590543450198, 3.372215442091, 0.502149263630, 1.577548437624, 5.710359569578, 0.175120320851):
        assert number(expected) in shown
    for expected in (0.382776864892, 0.900055578539):
        assert number(expected) in shown


@pytest.mark.parametrize("name", ["panda", "planar_3r", "scara", "stanford", "ur5"])
def test_eigenvalues_are_the_squares_of_the_cores_semi_axes(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, 5)
    for part, found in manipulability(machine, chain, qs).parts.items():
        space = found.space
        for i, q in enumerate(qs):
            J = chain_geometry(chain.flat, q).jacobian()[list(space.rows)]
            asked = EllipsoidQuestion(part, J, space.basis, space.dimension, int(found.ranks[i]), np.zeros((0, 3)))
            assert np.sqrt(asked.eigenvalues()[0]) == pytest.approx(found.sigmas[i], abs=1e-7)
            latex(ellipsoid_steps(asked))
