"""Equations of motion: what textbooks print, and every formula by its text alone against energies and their slopes."""

import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import hypot, pi
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pinocchio as pin
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from gelenk.dh import worked
from gelenk.dh.derive.algebra import Polynomial, derivative
from gelenk.dh.derive.typeset import MatrixFormula, Style
from gelenk.dh.lagrangian import equations, solution as solution_module, symbolic
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody, MassProperties
from gelenk.dh.lagrangian.numeric import NumericMotion, numeric_motion
from gelenk.dh.lagrangian.solution import MotionSolution
from gelenk.dh.lagrangian.texts import MotionQuestion, MotionTexts
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.errors import CertificationFailed, InvalidField, WrongJointCount
from gelenk.robot.dh import Convention, DhTable
from tests.oracles import dh_columns, expressions
from tests.oracles.lagrangian import Arm, Link
from tests.robots import rows

Array = npt.NDArray[np.float64]
H = pi / 2
UPRIGHT = Gravity(9.81, (0.0, -1.0, 0.0))
"""For an arm whose plane of motion is x-y of the base."""

PLANAR_2R = rows("standard", [(1.0, 0, 0, 0), (0.7, 0, 0, 0)], "RR")
PLANAR_2R_CRAIG = rows("modified", [(0, 0, 0, 0), (1.0, 0, 0, 0)], "RR")
PLANAR_3R = rows("standard", [(0.5, 0, 0, 0), (0.4, 0, 0, 0), (0.3, 0, 0, 0)], "RRR")
POLAR = rows("standard", [(0, H, 0, H), (0, 0, 0, 0)], "RP")
ANTHROPOMORPHIC = rows("standard", [(0, H, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")

BODIES_2 = (LinkBody(2.0, 0.5, 0.2), LinkBody(1.2, 0.3, 0.06))
BODIES_3 = (LinkBody(2.0, 0.2, 0.05), LinkBody(1.5, 0.15, 0.03), LinkBody(0.7, 0.12, 0.01))


def motion(solution: WorkedSolution) -> MotionSolution:
    assert solution.motion is not None, solution.notes
    return solution.motion


def derived(dh: DhTable, *bodies: LinkBody, gravity: Gravity = UPRIGHT, style: Style = "short") -> MotionTexts:
    return motion(worked_solution(dh, style=style, dynamics=MassProperties(bodies, gravity))).texts


def plain(matrix: MatrixFormula) -> list[list[str]]:
    assert matrix.plain is not None
    return matrix.plain


class Reader:
    """Reads formulas by the legend and by nothing else, but for what the legend says has no value."""

    def __init__(self, found: MotionTexts, q: Sequence[float], extra: Mapping[str, float]) -> None:
        entries: list[dict[str, Any]] = [
            {"plain": one.plain, "latex": one.latex, "meaning": one.meaning, "value": one.value}
            for one in found.legend
            if not one.plain.startswith("tau")
        ]
        for entry in entries:
            if entry["value"] is None:
                entry["value"] = extra.get(entry["plain"])
        self.names = expressions.namespace(entries, q)
        # The reader of LaTeX takes words of small letters.
        self.entries = [{**entry, "plain": entry["plain"].replace("I", "moment")} for entry in entries]
        self.words = {name.replace("I", "moment"): value for name, value in self.names.items()}

    def value(self, formula: str) -> float:
        return expressions.value(formula, self.names)

    def grid(self, matrix: MatrixFormula) -> Array:
        assert matrix.latex is not None
        cells = expressions.latex_entries(matrix.latex)
        latex = [[expressions.latex_value(cell, self.entries, self.words) for cell in row] for row in cells]
        values = np.array([[self.value(cell) for cell in row] for row in plain(matrix)])
        np.testing.assert_allclose(latex, values, rtol=1e-12, atol=1e-12)
        return values

    def row(self, found: MotionTexts, i: int) -> float:
        """The left side of an equation of motion, in both notations."""
        left, right = found.equations_of_motion[i].plain.split(" = ")
        latex = found.equations_of_motion[i].latex.removesuffix(rf" = \tau_{{{i + 1}}}")
        assert right == f"tau{i + 1}"
        value = self.value(left)
        assert expressions.latex_value(latex, self.entries, self.words) == pytest.approx(value, rel=1e-11, abs=1e-11)
        return value


def states(dh: DhTable, count: int, seed: int = 3) -> list[tuple[Array, Array, Array]]:
    random = np.random.default_rng(seed)
    return [(*random.uniform(-2.0, 2.0, (3, len(dh.joints))),) for _ in range(count)]


def rates(v: Array, a: Array) -> dict[str, float]:
    names = {f"qd{i}": value for i, value in enumerate(v.tolist(), start=1)}
    return names | {f"qdd{i}": value for i, value in enumerate(a.tolist(), start=1)}


def oracle(dh: DhTable, links: Sequence[Link], gravity: Gravity = UPRIGHT) -> Arm:
    parameters = [(row.a, row.alpha, row.d, row.theta) for row in dh.joints]
    slides = [row.type == "prismatic" for row in dh.joints]
    table = dh_columns.Table(dh.convention == "standard", parameters, slides, dh.base, dh.tool)
    return Arm(table, links, gravity.vector)


def check_by_text(
    dh: DhTable, found: MotionTexts, judge: Arm, extra: Mapping[str, float] | None = None, count: int = 3
) -> None:
    """Every formula by its text and the legend alone, against energies and their slopes."""
    for q, v, a in states(dh, count):
        read = Reader(found, q.tolist(), {**rates(v, a), **(extra or {})})
        M, c, g = judge.mass_matrix(q), judge.christoffel(q), judge.gravity_vector(q)
        scale = max(1.0, float(np.abs(M).max()), float(np.abs(g).max()))
        C = c @ v
        np.testing.assert_allclose(read.grid(found.mass_matrix), M, rtol=0, atol=2e-7 * scale)
        np.testing.assert_allclose(read.grid(found.coriolis), C, rtol=0, atol=2e-7 * scale)
        np.testing.assert_allclose(read.grid(found.coriolis_vector)[:, 0], C @ v, rtol=0, atol=2e-7 * scale)
        np.testing.assert_allclose(read.grid(found.gravity_vector)[:, 0], g, rtol=0, atol=2e-7 * scale)
        np.testing.assert_allclose(read.grid(found.skew), C.T - C, rtol=0, atol=2e-7 * scale)
        left = [read.row(found, i) for i in range(len(q))]
        np.testing.assert_allclose(left, M @ a + C @ v + g, rtol=0, atol=2e-7 * scale)
        kinetic = sum(read.value(body.kinetic_energy.plain) for body in found.links)
        assert kinetic == pytest.approx(0.5 * v @ M @ v, abs=1e-7 * scale)
        heights = sum(read.value(body.potential_energy.plain) for body in found.links)
        frame_0 = replace(
            judge, table=replace(judge.table, base=np.eye(4)), gravity=(dh.base[:3, :3].T @ judge.gravity).tolist()
        )
        assert heights == pytest.approx(frame_0.potential(q), abs=1e-9 * scale)
        centers = np.array([read.grid(body.center_of_mass)[:, 0] for body in found.links])
        np.testing.assert_allclose(centers, frame_0.centers(q), atol=1e-12)
        for one in found.christoffel:
            wanted = c[one.i - 1, one.j - 1, one.k - 1]
            assert read.value(one.plain) == pytest.approx(wanted, abs=2e-7 * scale)


# What textbooks print


def test_the_planar_2r_arm_letter_by_letter() -> None:
    found = derived(PLANAR_2R)
    assert plain(found.mass_matrix) == [
        ["m1*lc1**2 + m2*(a1**2 + lc2**2 + 2*a1*lc2*c2) + I1 + I2", "m2*(lc2**2 + a1*lc2*c2) + I2"],
        ["m2*(lc2**2 + a1*lc2*c2) + I2", "m2*lc2**2 + I2"],
    ]
    assert plain(found.coriolis) == [
        ["-m2*a1*lc2*s2*qd2", "-m2*a1*lc2*s2*(qd1 + qd2)"],
        ["m2*a1*lc2*s2*qd1", "0"],
    ]
    assert plain(found.gravity_vector) == [["(m1*lc1 + m2*a1)*g0*c1 + m2*g0*lc2*c12"], ["m2*g0*lc2*c12"]]
    assert found.equations_of_motion[1].plain == (
        "(m2*(lc2**2 + a1*lc2*c2) + I2)*qdd1 + (m2*lc2**2 + I2)*qdd2 + m2*a1*lc2*s2*qd1**2 + m2*g0*lc2*c12 = tau2"
    )
    assert str(found.mass_matrix.latex).startswith(
        r"\begin{bmatrix} m_{1} l_{c1}^{2} + m_{2} \left(a_{1}^{2} + l_{c2}^{2} + 2 a_{1} l_{c2} c_{2}\right) + I_{1} "
    )
    assert found.links[1].kinetic_energy.plain == (
        "(1/2)*m2*(a1**2*qd1**2 + lc2**2*(qd1 + qd2)**2 + 2*a1*lc2*c2*qd1*(qd1 + qd2)) + (1/2)*I2*(qd1 + qd2)**2"
    )
    assert found.links[1].potential_energy.plain == "m2*g0*(a1*s1 + lc2*s12)"
    assert [(one.i, one.j, one.k, one.plain) for one in found.christoffel] == [
        (1, 1, 2, "-m2*a1*lc2*s2"),
        (1, 2, 2, "-m2*a1*lc2*s2"),
        (2, 1, 1, "m2*a1*lc2*s2"),
    ]


class Textbook(NamedTuple):
    """M, C and g of the planar 2R arm as a book has them."""

    M: Array
    C: Array
    g: Array


def spong(q: Array, v: Array) -> Textbook:
    """Spong, Hutchinson, Vidyasagar, planar elbow manipulator: d_11 …, h, φ_1, φ_2."""
    l1, lc1, lc2, m1, m2, I1, I2, g = 1.0, 0.5, 0.3, 2.0, 1.2, 0.2, 0.06, 9.81
    d11 = m1 * lc1**2 + m2 * (l1**2 + lc2**2 + 2 * l1 * lc2 * np.cos(q[1])) + I1 + I2
    d12 = m2 * (lc2**2 + l1 * lc2 * np.cos(q[1])) + I2
    d22 = m2 * lc2**2 + I2
    h = -m2 * l1 * lc2 * np.sin(q[1])
    phi1 = (m1 * lc1 + m2 * l1) * g * np.cos(q[0]) + m2 * lc2 * g * np.cos(q[0] + q[1])
    phi2 = m2 * lc2 * g * np.cos(q[0] + q[1])
    C = [[h * v[1], h * v[1] + h * v[0]], [-h * v[0], 0.0]]
    return Textbook(np.array([[d11, d12], [d12, d22]]), np.array(C), np.array([phi1, phi2]))


def siciliano(q: Array, v: Array) -> Textbook:
    """Siciliano et al., two-link planar arm, by its dynamic parameters π, motors of no mass; a_2 counts from the tip.

    Their links' masses are taken about the joints: Y π with π_1 = m_1, π_2 = m_1 (l_1 - a_1), π_3 = I_1 + m_1 (l_1 -
    a_1)², and so on, each parameter linear in the torques.
    """
    a1, a2, g = 1.0, 0.7, 9.81
    p1, p2, p3 = 2.0, 2.0 * (0.5 - a1), 0.2 + 2.0 * (0.5 - a1) ** 2
    p4, p5, p6 = 1.2, 1.2 * (0.3 - a2), 0.06 + 1.2 * (0.3 - a2) ** 2
    c1, c2, s2, c12 = np.cos(q[0]), np.cos(q[1]), np.sin(q[1]), np.cos(q[0] + q[1])
    b11 = a1**2 * p1 + 2 * a1 * p2 + p3 + (a1**2 + 2 * a1 * a2 * c2 + a2**2) * p4 + 2 * (a1 * c2 + a2) * p5 + p6
    b12 = (a1 * a2 * c2 + a2**2) * p4 + (a1 * c2 + 2 * a2) * p5 + p6
    b22 = a2**2 * p4 + 2 * a2 * p5 + p6
    h = -a1 * s2 * (a2 * p4 + p5)
    g1 = g * (c1 * (a1 * p1 + p2 + a1 * p4) + c12 * (a2 * p4 + p5))
    C = [[h * v[1], h * (v[0] + v[1])], [-h * v[0], 0.0]]
    return Textbook(np.array([[b11, b12], [b12, b22]]), np.array(C), np.array([g1, g * c12 * (a2 * p4 + p5)]))


@pytest.mark.quick(2)
@pytest.mark.parametrize("book", [spong, siciliano])
@pytest.mark.parametrize("dh", [PLANAR_2R, PLANAR_2R_CRAIG], ids=["standard", "modified"])
@pytest.mark.parametrize("style", ["short", "full"])
def test_the_planar_2r_arm_has_the_values_of_the_textbook(book: Any, dh: DhTable, style: Style) -> None:
    found = derived(dh, *BODIES_2, style=style)
    for q, v, a in states(dh, 20):
        read, wanted = Reader(found, q.tolist(), rates(v, a)), book(q, v)
        np.testing.assert_allclose(read.grid(found.mass_matrix), wanted.M, rtol=1e-12)
        np.testing.assert_allclose(read.grid(found.coriolis), wanted.C, atol=1e-12)
        np.testing.assert_allclose(read.grid(found.gravity_vector)[:, 0], wanted.g, atol=1e-12)


def test_craigs_arm_that_turns_and_slides_letter_by_letter() -> None:
    """Point of mass m_2 at d_2 = q_2, m_1 at l_1, inertias of both: Craig's RP manipulator."""
    found = derived(POLAR, LinkBody(), LinkBody(center=0.0))
    assert plain(found.mass_matrix) == [["m1*lc1**2 + m2*q2**2 + I1 + I2", "0"], ["0", "m2"]]
    assert plain(found.coriolis_vector) == [["2*m2*q2*qd1*qd2"], ["-m2*q2*qd1**2"]]
    assert plain(found.gravity_vector) == [["(m1*lc1 + m2*q2)*g0*c1"], ["m2*g0*s1"]]
    symbols = {one.plain: one.meaning for one in found.legend}
    assert "along that of joint 2" in symbols["lc1"]
    assert symbols["tau1"].startswith("torque")
    assert symbols["tau2"].startswith("force")
    assert "lc2" not in symbols


def test_a_slide_with_its_centre_of_mass_beside_the_frame_is_a_square() -> None:
    found = derived(POLAR)
    assert plain(found.mass_matrix)[0][0] == "m1*lc1**2 + m2*(lc2 + q2)**2 + I1 + I2"


def test_angles_add_up_across_a_slide() -> None:
    dh = rows("standard", [(0, H, 0, H), (0, -H, 0.1, 0), (0.2, 0, 0, 0)], "RPR")
    found = derived(dh)
    assert plain(found.gravity_vector) == [
        ["(m1*lc1 + m2*(d2 + lc2 + q2) + m3*(d2 + q2))*g0*c1 - m3*g0*lc3*s13"],
        ["(m2 + m3)*g0*s1"],
        ["-m3*g0*lc3*s13"],
    ]


def test_a_cartesian_arm_has_a_constant_mass_matrix_and_needs_no_inertia() -> None:
    dh = rows("standard", [(0, H, 0, 0), (0, 0, 0.2, 0)], "PP")
    solution = worked_solution(
        dh, [[0.1, 0.2]], dynamics=MassProperties((LinkBody(2.0), LinkBody(1.0)), Gravity(9.81, (0, 0, -1)))
    )
    found = motion(solution)
    assert plain(found.texts.mass_matrix) == [["m1 + m2", "0"], ["0", "m2"]]
    assert found.texts.christoffel == []
    assert plain(found.texts.gravity_vector) == [["(m1 + m2)*g0"], ["0"]]
    assert found.numeric[0].gravity_vector == pytest.approx([3.0 * 9.81, 0.0])


# By the text alone


class Case(NamedTuple):
    """An arm, its bodies, and where these are in the frames of their links."""

    dh: DhTable
    bodies: tuple[LinkBody, ...]
    links: tuple[Link, ...]
    gravity: Gravity = UPRIGHT


def turned(dh: DhTable, base: Array) -> DhTable:
    return replace(dh, base=base)


CASES = {
    "3R": Case(
        PLANAR_3R,
        BODIES_3,
        (Link(2.0, (-0.3, 0, 0), 0.05), Link(1.5, (-0.25, 0, 0), 0.03), Link(0.7, (-0.18, 0, 0), 0.01)),
    ),
    "3R, modified": Case(
        rows("modified", [(0, 0, 0, 0), (0.5, 0, 0, 0.4), (0.4, pi, 0.1, 0)], "RRR"),
        BODIES_3,
        (Link(2.0, (0.2, 0, 0), 0.05), Link(1.5, (0.15, 0, 0), 0.03), Link(0.7, (0.12, 0, 0), 0.01)),
    ),
    "3R beside its links": Case(
        PLANAR_3R,
        (
            LinkBody(2.0, (-0.3, 0.1, 0.05), 0.05),
            LinkBody(1.5, (-0.2, -0.03, 0.0), 0.0),
            LinkBody(0.7, (0.0, 0.02, 0.0), 0.01),
        ),
        (Link(2.0, (-0.3, 0.1, 0.05), 0.05), Link(1.5, (-0.2, -0.03, 0), 0.0), Link(0.7, (0, 0.02, 0), 0.01)),
    ),
    "2R upright by its base": Case(
        turned(PLANAR_2R, dh_columns.shift(2, 0.4) @ dh_columns.turn(0, H)),
        BODIES_2,
        (Link(2.0, (-0.5, 0, 0), 0.2), Link(1.2, (-0.4, 0, 0), 0.06)),
        Gravity(9.81, (0.0, 0.0, -1.0)),
    ),
    "2R on a slope": Case(
        turned(PLANAR_2R, dh_columns.turn(2, 0.3) @ dh_columns.turn(0, 0.7)),
        BODIES_2,
        (Link(2.0, (-0.5, 0, 0), 0.2), Link(1.2, (-0.4, 0, 0), 0.06)),
        Gravity(9.81, (0.0, 0.0, -1.0)),
    ),
    "RP": Case(POLAR, BODIES_2, (Link(2.0, (0, 0, 0.5), 0.2), Link(1.2, (0, 0, 0.3), 0.06))),
    "RP, modified": Case(
        rows("modified", [(0, 0, 0, 0.2), (0, H, 0.3, 0)], "RP"),
        BODIES_2,
        (Link(2.0, (0, -0.5, 0), 0.2), Link(1.2, (0, 0, 0.3), 0.06)),
    ),
    "PR": Case(
        rows("standard", [(0, -H, 0, 0), (0.3, 0, 0, 0)], "PR"),
        BODIES_2,
        (Link(2.0, (0, -0.5, 0), 0.2), Link(1.2, (0, 0, 0), 0.06)),
        Gravity(9.81, (0.6, 0.0, -0.8)),
    ),
    "RPR": Case(
        rows("standard", [(0, H, 0, H), (0, -H, 0.1, 0), (0.2, 0, 0, 0)], "RPR"),
        BODIES_3,
        (Link(2.0, (0, 0, 0.2), 0.05), Link(1.5, (0, -0.15, 0), 0.03), Link(0.7, (-0.08, 0, 0), 0.01)),
    ),
    "PPR": Case(
        rows("standard", [(0, H, 0, H), (0, H, 0, H), (0.3, 0, 0.1, 0.2)], "PPR"),
        BODIES_3,
        (Link(2.0, (0, 0.2, 0), 0.05), Link(1.5, (0, 0.15, 0), 0.03), Link(0.7, (-0.18, 0, 0), 0.01)),
        Gravity(9.81, (0.0, 0.0, -1.0)),
    ),
    "1R": Case(rows("standard", [(0.4, 0, 0, 0)], "R"), BODIES_2[:1], (Link(2.0, (0.1, 0, 0), 0.2),)),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", CASES)
def test_every_formula_has_the_value_of_energies_and_their_slopes(name: str) -> None:
    case = CASES[name]
    found = derived(case.dh, *case.bodies, gravity=case.gravity)
    assert found.missing == ()
    check_by_text(case.dh, found, oracle(case.dh, case.links, case.gravity))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["3R", "3R beside its links", "RPR"])
@pytest.mark.parametrize("style", ["short", "full"])
def test_values_in_place_of_symbols_change_nothing(name: str, style: Style) -> None:
    case = CASES[name]
    dynamics = MassProperties(case.bodies, case.gravity)
    found = motion(worked_solution(case.dh, style=style, keeps_symbols=False, dynamics=dynamics)).texts
    assert not {"m1", "lc1", "a1", "g0"} & {one.plain for one in found.legend}
    check_by_text(case.dh, found, oracle(case.dh, case.links, case.gravity), count=1)


def test_what_is_left_out_stays_a_symbol_of_any_value() -> None:
    found = derived(PLANAR_2R, LinkBody(mass=2.0), LinkBody(center=0.3))
    assert set(found.missing) == {"I1", "I2", "m2", "lc1"}
    extra = {"I1": 0.4, "I2": 0.3, "m2": 0.9, "lc1": 0.45}
    links = (Link(2.0, (0.45 - 1.0, 0, 0), 0.4), Link(0.9, (0.3 - 0.7, 0, 0), 0.3))
    check_by_text(PLANAR_2R, found, oracle(PLANAR_2R, links), extra)


@pytest.mark.slow
def test_three_joints_against_pinocchio() -> None:
    """A description by hand: three bars that hang on each other, turning about y, gravity along -z."""
    links = ["<link name='l0'/>"]
    for i, body in enumerate(BODIES_3, start=1):
        inertia = f"<inertia ixx='0.01' iyy='{body.inertia}' izz='0.02' ixy='0' ixz='0' iyz='0'/>"
        links.append(
            f"<link name='l{i}'><inertial><origin xyz='{body.center} 0 0'/><mass value='{body.mass}'/>{inertia}"
            f"</inertial></link><joint name='j{i}' type='continuous'><parent link='l{i - 1}'/><child link='l{i}'/>"
            f"<origin xyz='{[0, 0.5, 0.4][i - 1]} 0 0'/><axis xyz='0 -1 0'/></joint>"
        )
    model = pin.buildModelFromXML(f"<robot name='r'>{''.join(links)}</robot>")
    data = model.createData()
    found = derived(PLANAR_3R, *BODIES_3)
    for q, v, a in states(PLANAR_3R, 20):
        read = Reader(found, q.tolist(), rates(v, a))
        x = np.column_stack((np.cos(q), np.sin(q))).ravel()
        M = pin.crba(model, data, x)
        np.testing.assert_allclose(read.grid(found.mass_matrix), np.triu(M) + np.triu(M, 1).T, atol=1e-12)
        g = pin.computeGeneralizedGravity(model, data, x)
        np.testing.assert_allclose(read.grid(found.gravity_vector)[:, 0], g, atol=1e-12)
        bias = pin.nonLinearEffects(model, data, x, v) - g
        np.testing.assert_allclose(read.grid(found.coriolis) @ v, bias, atol=1e-11)
        torques = pin.rnea(model, data, x, v, a)
        np.testing.assert_allclose([read.row(found, i) for i in range(3)], torques, atol=1e-11)


LENGTHS = st.sampled_from([0.0, 0.3, -0.2, 0.45])


@pytest.mark.slow
@given(
    convention=st.sampled_from(["standard", "modified"]),
    types=st.text("RP", min_size=1, max_size=3),
    lengths=st.lists(st.tuples(LENGTHS, LENGTHS), min_size=3, max_size=3),
    signs=st.lists(st.sampled_from([0, 2, 1, -1]), min_size=3, max_size=3),
    points=st.lists(st.tuples(LENGTHS, LENGTHS, LENGTHS), min_size=3, max_size=3),
    fall=st.sampled_from([(0.0, -1.0, 0.0), (0.6, 0.0, -0.8), (0.48, 0.6, 0.64)]),
)
@settings(max_examples=30, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_any_planar_arm_is_derived(
    convention: Convention,
    types: str,
    lengths: list[tuple[float, float]],
    signs: list[int],
    points: list[tuple[float, float, float]],
    fall: tuple[float, float, float],
) -> None:
    dh = planar(convention, types, lengths, signs)
    bodies = tuple(LinkBody(1.0 + i, point, 0.1 * i) for i, point in enumerate(points[: len(types)]))
    links = [Link(1.0 + i, point, 0.1 * i) for i, point in enumerate(points[: len(types)])]
    gravity = Gravity(9.81, fall)
    found = derived(dh, *bodies, gravity=gravity)
    check_by_text(dh, found, oracle(dh, links, gravity), count=1)


def planar(convention: Convention, types: str, lengths: Sequence[tuple[float, float]], signs: Sequence[int]) -> DhTable:
    """A table whose revolute axes all point along z or against it, and whose slides are across."""
    parameters, across = [], False
    twists = []
    for kind, sign in zip(types, signs, strict=False):
        needed = kind == "P"
        if needed != across:
            twists.append(H if sign in {0, 1} else -H)
        else:
            twists.append(pi if sign == 2 else 0.0)
        across = needed
    shifted = twists if convention == "modified" else [*twists[1:], 0.0]
    base = dh_columns.turn(0, twists[0]) if convention == "standard" else np.eye(4)
    for i, ((a, d), alpha, kind, sign) in enumerate(zip(lengths, shifted, types, signs, strict=False)):
        parameters.append((a, alpha, d, 0.3 if sign == 1 and (kind == "R" or i + 1 == len(types)) else 0.0))
    return turned(rows(convention, parameters, types), base)


# Properties, numbers and what stays out


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", CASES)
def test_the_rate_of_m_less_twice_c_is_skew_symmetric(name: str) -> None:
    """Ṁ by differences of M along the motion, C by the text."""
    case = CASES[name]
    found = derived(case.dh, *case.bodies, gravity=case.gravity)
    for q, v, a in states(case.dh, 3):
        steps = [Reader(found, (q + x * v).tolist(), rates(v, a)).grid(found.mass_matrix) for x in (1e-5, -1e-5)]
        read = Reader(found, q.tolist(), rates(v, a))
        N = (steps[0] - steps[1]) / 2e-5 - 2.0 * read.grid(found.coriolis)
        np.testing.assert_allclose(N, -N.T, atol=1e-8)
        np.testing.assert_allclose(read.grid(found.skew), N, atol=1e-8)
        assert np.all(np.linalg.eigvalsh(read.grid(found.mass_matrix)) > 0)


def test_a_horizontal_arm_has_no_gravity_term_and_the_notes_say_so() -> None:
    solution = worked_solution(PLANAR_2R, dynamics=MassProperties((), Gravity(9.81, (0.0, 0.0, -1.0))))
    assert plain(motion(solution).texts.gravity_vector) == [["0"], ["0"]]
    assert motion(solution).texts.equations_of_motion[1].plain.endswith("+ m2*a1*lc2*s2*qd1**2 = tau2")
    assert "plane of motion" in solution.notes[-1]


def test_without_gravity_there_is_none_and_nothing_to_note() -> None:
    solution = worked_solution(PLANAR_2R, dynamics=MassProperties((), Gravity(0.0, (0.0, 0.0, 0.0))))
    assert plain(motion(solution).texts.gravity_vector) == [["0"], ["0"]]
    assert motion(solution).texts.links[0].potential_energy.plain == "0"
    assert solution.notes == []


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", CASES)
def test_numbers_at_configurations(name: str) -> None:
    case = CASES[name]
    judge = oracle(case.dh, case.links, case.gravity)
    found = states(case.dh, 3)
    qs, vs = [q.tolist() for q, _, _ in found], [v.tolist() for _, v, _ in found]
    solution = motion(worked_solution(case.dh, qs, dynamics=MassProperties(case.bodies, case.gravity, vs)))
    assert solution.numeric_certificate is not None
    assert solution.numeric_certificate.samples == 3
    for one, (q, v, _) in zip(solution.numeric, found, strict=True):
        np.testing.assert_allclose(one.mass_matrix, judge.mass_matrix(q), atol=1e-9)
        np.testing.assert_allclose(one.christoffel, judge.christoffel(q), atol=1e-7)
        np.testing.assert_allclose(one.gravity_vector, judge.gravity_vector(q), atol=1e-8)
        assert one.coriolis is not None
        assert one.coriolis_vector is not None
        np.testing.assert_allclose(one.coriolis, judge.christoffel(q) @ v, atol=1e-7)
        np.testing.assert_allclose(one.coriolis_vector, one.coriolis @ v, atol=1e-12)


def test_numbers_need_values_and_the_notes_name_what_is_missing() -> None:
    solution = worked_solution(
        PLANAR_2R, [[0.1, 0.2]], dynamics=MassProperties((BODIES_2[0], LinkBody(center=0.3)), UPRIGHT)
    )
    assert motion(solution).numeric == []
    assert motion(solution).numeric_certificate is None
    assert "I2, m2" in solution.notes[-1]


def test_a_rounded_right_angle_is_certified_on_both_sides() -> None:
    dh = rows("standard", [(0, 1.5708, 0, 1.5708), (0, 0, 0, 0)], "RP")
    solution = worked_solution(dh, [[0.3, 0.5]], dynamics=MassProperties(BODIES_2, UPRIGHT))
    assert plain(motion(solution).texts.mass_matrix)[0][1] == "0"
    assert motion(solution).numeric[0].mass_matrix == pytest.approx(np.diag([0.7 + 0.06 + 1.2 * 0.64, 1.2]), abs=1e-4)


@pytest.mark.quick(1)
@pytest.mark.parametrize("scale", [1e6, 1e-6])
def test_neither_huge_nor_tiny_numbers_spoil_the_comparison(scale: float) -> None:
    joints = tuple(replace(row, a=row.a * scale) for row in PLANAR_3R.joints)
    bodies = tuple(LinkBody(1e6, 0.3 * scale, 1e9 * scale) for _ in joints)
    solution = worked_solution(
        replace(PLANAR_3R, joints=joints), [[0.1, -0.4, 1e6]], dynamics=MassProperties(bodies, UPRIGHT)
    )
    assert motion(solution).certificate.samples == 20


@pytest.mark.parametrize(
    ("dh", "reason"),
    [
        (ANTHROPOMORPHIC, "joint 2 is not parallel"),
        (rows("standard", [(0.1, 0, 0, 0), (0, 0, 0, 0)], "RP"), "prismatic joint 2 is not across"),
        (rows("standard", [(0, 0, 0, 0), (0.1, 0, 0, 0)], "PR"), "prismatic joint 1 is not across"),
        (rows("standard", [(0, -H, 0, -H), (0, -H, 0, -H), (0, 0, 0, 0)], "PPP"), "three independent directions"),
        (rows("standard", [(0.1, 0, 0, 0)] * 4, "RRRR"), "up to 3 joints"),
    ],
    ids=["spatial", "along", "before", "Cartesian", "4R"],
)
def test_what_is_not_planar_or_too_long_is_noted_and_the_rest_unaffected(dh: DhTable, reason: str) -> None:
    without, solution = worked_solution(dh), worked_solution(dh, dynamics=MassProperties((), UPRIGHT))
    assert solution.motion is None
    assert reason in solution.notes[-1]
    assert solution.formulas == without.formulas
    assert solution.steps == without.steps


def test_too_many_terms_are_noted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gelenk.dh.lagrangian.equations.MAX_ENTRY_TERMS", 3)
    symbolic.motion.cache_clear()
    solution = worked_solution(PLANAR_3R, dynamics=MassProperties((), UPRIGHT))
    symbolic.motion.cache_clear()
    assert solution.motion is None
    assert "too many terms" in solution.notes[-1]


def test_steps_tell_the_derivation_in_order() -> None:
    titles = [step.title for step in worked_solution(PLANAR_2R, dynamics=MassProperties((), UPRIGHT)).steps]
    assert titles[-6:] == [
        "Centres of mass and their velocities",
        "Kinetic and potential energy",
        "Mass matrix",
        "Christoffel symbols and Coriolis matrix",
        "Gravity",
        "Equations of motion",
    ]


QUANTITIES = {
    "centers": "a centre of mass",
    "velocities": "the velocity of a centre of mass",
    "kinetic": "a kinetic energy",
    "potential": "a potential energy",
    "mass_matrix": "the mass matrix",
    "christoffel": "a Christoffel symbol",
    "coriolis": "the Coriolis matrix",
    "coriolis_vector": "the Coriolis vector",
    "gravity_vector": "the gravity vector",
    "skew": "Ṁ - 2C",
    "torques": "the torques",
}


@pytest.mark.parametrize("field", QUANTITIES)
def test_a_formula_that_disagrees_with_pinocchio_leaves_out_the_equations_and_nothing_else(
    field: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    honest = symbolic.motion

    def wrong(question: MotionQuestion) -> MotionTexts:
        found = honest(question)
        assert isinstance(found, MotionTexts)
        values = [{**one, field: (np.array(one[field]) + 1e-6).tolist()} for one in found.values]
        return replace(found, values=values)

    monkeypatch.setattr(worked, "motion", wrong)
    solution = worked_solution(PLANAR_2R, dynamics=MassProperties((), UPRIGHT))
    without = worked_solution(PLANAR_2R)
    assert solution.motion is None
    (note,) = solution.notes
    assert note.startswith(f"{QUANTITIES[field]} of the equations of motion in symbols failed")
    assert note.endswith("the equations of motion are left out")
    assert [record.levelname for record in caplog.records] == ["ERROR"]
    assert QUANTITIES[field] in caplog.records[0].getMessage()
    assert (solution.formulas, solution.singularities) == (without.formulas, without.singularities)


def test_numbers_that_disagree_with_pinocchio_are_withheld(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = numeric_motion

    def wrong(*given: Any) -> NumericMotion:
        found = honest(*given)
        return replace(found, mass_matrix=found.mass_matrix + 1e-6)

    monkeypatch.setattr(solution_module, "numeric_motion", wrong)
    with pytest.raises(CertificationFailed, match="mass matrix"):
        worked_solution(PLANAR_2R, [[0.1, 0.2]], dynamics=MassProperties(BODIES_2, UPRIGHT))


ODD = {
    "P": rows("standard", [(1, 0, 0, 0.3)], "P"),
    "R-P": rows("standard", [(1, -H, 0, 0), (0.5, 0, 0, 0.3)], "RP"),
    "P, modified": rows("modified", [(1, 0.4, 0.2, 0.3)], "P"),
    "R-P-R": rows("standard", [(0.5, -H, 0, 0.2), (0.4, H, 0, 0), (0.3, 0, 0, 0.1)], "RPR"),
    "P-P": rows("standard", [(0.5, H, 0, 0.3), (0.4, 0, 0, -1.2)], "PP"),
    "P-P, modified": rows("modified", [(0.2, 0.7, 0, 0.3), (0.5, H, 0, 1.1)], "PP"),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ODD)
def test_the_constant_angle_of_a_slide_is_not_differentiated(name: str) -> None:
    dh, count = ODD[name], len(ODD[name].joints)
    points = [(0.1, -0.2, 0.3), (0.2, 0.1, -0.1), (0.15, 0.05, 0.2)][:count]
    bodies = tuple(LinkBody(1.0 + i, point, 0.1) for i, point in enumerate(points))
    links = [Link(1.0 + i, point, 0.1) for i, point in enumerate(points)]
    gravity = Gravity(9.81, (0.48, 0.6, 0.64))
    check_by_text(dh, derived(dh, *bodies, gravity=gravity), oracle(dh, links, gravity))


def test_a_slide_that_is_differentiated_by_its_angle_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    def careless(polynomial: Polynomial, index: int, *, slides: bool = False) -> Polynomial:
        slope = derivative(polynomial, index)
        return slope + derivative(polynomial, index, slides=True) if slides else slope

    monkeypatch.setattr(equations, "derivative", careless)
    monkeypatch.setattr(worked, "motion", symbolic.motion.__wrapped__)  # without what it remembers
    solution = worked_solution(ODD["R-P"], [[0.1, 0.2]], dynamics=MassProperties((), UPRIGHT))
    assert solution.motion is None
    assert "the equations of motion are left out" in solution.notes[-1]
    assert solution.formulas is not None
    assert solution.determinants[0] is not None


def test_without_time_there_are_no_equations_and_the_rest_remains() -> None:
    def overdue(function: Any, question: Any, seconds: float) -> Any:
        if isinstance(question, MotionQuestion):
            raise TimeoutError
        return worked.directly(function, question, seconds)

    solution = worked_solution(PLANAR_2R, run=overdue, dynamics=MassProperties((), UPRIGHT))
    assert solution.motion is None
    assert solution.singularities is not None
    assert "equations of motion could not be worked out" in solution.notes[-1]
    assert "left out" in solution.notes[-1]


def test_without_time_for_the_transforms_the_equations_are_left_out_too() -> None:
    def overdue(*_: object) -> Any:
        raise TimeoutError

    solution = worked_solution(PLANAR_2R, run=overdue, dynamics=MassProperties((), UPRIGHT))
    assert solution.motion is None
    assert solution.notes[-1].endswith("the equations of motion are left out too")


def test_links_and_velocities_must_fit_the_table() -> None:
    with pytest.raises(InvalidField, match="one link per joint"):
        worked_solution(PLANAR_2R, dynamics=MassProperties(BODIES_3, UPRIGHT))
    with pytest.raises(InvalidField, match="one per configuration"):
        worked_solution(PLANAR_2R, [[0.1, 0.2]], dynamics=MassProperties((), UPRIGHT, []))
    with pytest.raises(WrongJointCount):
        worked_solution(PLANAR_2R, [[0.1, 0.2]], dynamics=MassProperties((), UPRIGHT, [[0.1]]))


@pytest.mark.slow
def test_three_joints_take_no_minutes() -> None:
    bodies = tuple(LinkBody(center=(0.1, 0.05, 0.02)) for _ in range(3))
    direction = (0.48 / hypot(0.48, 0.6, 0.64), 0.6, 0.64)
    started = time.process_time()
    worked_solution(PLANAR_3R, dynamics=MassProperties(bodies, Gravity(9.81, direction)))
    assert time.process_time() - started < 10.0  # about one on a slow machine


def test_the_symbolic_side_knows_neither_numpy_nor_pinocchio_nor_sympy() -> None:
    code = "import sys, gelenk.dh.lagrangian.symbolic; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numpy", "pinocchio", "numba", "sympy", "gelenk.robot.dh"} & set(loaded)
