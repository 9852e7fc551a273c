"""The worked solution: what textbooks print, letter by letter, and the value of every formula by the text alone."""

import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, replace
from math import pi
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from gelenk.dh import worked
from gelenk.dh.derive import symbolic
from gelenk.dh.derive.texts import Formulas, Singularities, SymbolEntry, SymbolicRequest
from gelenk.dh.derive.typeset import MatrixFormula, Style
from gelenk.dh.worked import WorkedSolution, worked_solution
from gelenk.errors import InvalidDhTable, WrongJointCount
from gelenk.robot.description import Mimic
from gelenk.robot.dh import Convention, DhTable
from tests.oracles import catalogue, dh_columns, expressions
from tests.robots import rows, swept, table

Array = npt.NDArray[np.float64]
H = pi / 2

PLANAR_2R = rows("standard", [(1.0, 0, 0, 0), (0.7, 0, 0, 0)], "RR")
PLANAR_3R = rows("standard", [(0.5, 0, 0, 0), (0.4, 0, 0, 0), (0.3, 0, 0, 0)], "RRR")
ANTHROPOMORPHIC = rows("standard", [(0, H, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")
WRIST = rows("standard", [(0, -H, 0, 0), (0, H, 0, 0), (0, 0, 0.1, 0)], "RRR")
SCARA = rows("standard", [(0.325, 0, 0.387, 0), (0.275, pi, 0, 0), (0, 0, 0, 0), (0, 0, 0.05, 0)], "RRPR")
STANFORD = rows(
    "standard",
    [(0, -H, 0.412, 0), (0, H, 0.154, 0), (0.0203, 0, 0, -H), (0, -H, 0, 0), (0, H, 0, 0), (0, 0, 0.263, 0)],
    "RRPRRR",
)
WITH_WRIST = rows(
    "standard",
    [(0, H, 0.3, 0), (0.5, 0, 0, 0), (0, H, 0, 0), (0, -H, 0.4, 0), (0, H, 0, 0), (0, 0, 0.1, 0)],
    "RRRRRR",
)
UR5 = rows(
    "standard",
    [
        (0, H, 0.089159, 0),
        (-0.425, 0, 0, 0),
        (-0.39225, 0, 0, 0),
        (0, H, 0.10915, 0),
        (0, -H, 0.09465, 0),
        (0, 0, 0.0823, 0),
    ],
    "RRRRRR",
)
PUMA_CRAIG = rows(
    "modified",
    [(0, 0, 0, 0), (0, -H, 0, 0), (0.4318, 0, 0.15, 0), (0.0203, -H, 0.4318, 0), (0, H, 0, 0), (0, -H, 0, 0)],
    "RRRRRR",
)
ORTHOGONAL = rows("standard", [(0.3, -H, 0, 0), (0.4, H, 0.2, 0), (0.5, 0, 0, 0)], "RRR")
POLAR = rows("standard", [(0, H, 0.5, 0), (0, H, 0, H), (0, 0, 0.3, 0)], "RRP")
CYLINDRICAL = rows("standard", [(0, 0, 0.5, 0), (0, -H, 0, 0), (0, 0, 0, 0)], "RPP")
CARTESIAN = rows("standard", [(0, -H, 0, -H), (0, -H, 0, -H), (0, 0, 0, 0)], "PPP")


def latex(matrix: MatrixFormula | None) -> str:
    assert matrix is not None
    assert matrix.latex is not None
    return matrix.latex


def plain(matrix: MatrixFormula | None) -> list[list[str]]:
    assert matrix is not None
    assert matrix.plain is not None
    return matrix.plain


class Arm(NamedTuple):
    """A table, and what a textbook says of it."""

    table: DhTable
    rows: tuple[int, ...]
    determinant: str
    conditions: tuple[str, ...]


ARMS = {
    "planar 2R": Arm(PLANAR_2R, (0, 1), "a1*a2*s2", ("s2",)),
    "planar 3R": Arm(PLANAR_3R, (0, 1, 5), "a1*a2*s2", ("s2",)),
    "anthropomorphic": Arm(ANTHROPOMORPHIC, (0, 1, 2), "-a2*a3*s3*(a2*c2 + a3*c23)", ("s3", "a2*c2 + a3*c23")),
    "spherical wrist": Arm(WRIST, (3, 4, 5), "-s2", ("s2",)),
    "SCARA": Arm(SCARA, (0, 1, 2, 5), "a1*a2*s2", ("s2",)),
    "Stanford": Arm(STANFORD, tuple(range(6)), "q3**2*s2*s5", ("q3", "s2", "s5")),
    "6R with wrist": Arm(WITH_WRIST, tuple(range(6)), "-a2*d4*c3*s5*(a2*c2 + d4*s23)", ("c3", "s5", "a2*c2 + d4*s23")),
    "UR5": Arm(
        UR5, tuple(range(6)), "a2*a3*s3*s5*(a2*c2 + a3*c23 + d5*s234)", ("s3", "s5", "a2*c2 + a3*c23 + d5*s234")
    ),
    "PUMA, Craig": Arm(
        PUMA_CRAIG,
        tuple(range(6)),
        "-a2*s5*(a2*c2 + a3*c23 - d4*s23)*(d4*c3 + a3*s3)",
        ("s5", "a2*c2 + a3*c23 - d4*s23", "d4*c3 + a3*s3"),
    ),
    "orthogonal 3R": Arm(
        ORTHOGONAL,
        (0, 1, 2),
        "a3*(-c2*(d2*c3 - a2*s3) + a1*s3)*(a2 + a3*c3)",
        ("-c2*(d2*c3 - a2*s3) + a1*s3", "a2 + a3*c3"),
    ),
    "polar": Arm(POLAR, (0, 1, 2), "c2*(d3 + q3)**2", ("c2", "d3 + q3")),
    "cylindrical": Arm(CYLINDRICAL, (0, 1, 2), "q3", ("q3",)),
    "Cartesian": Arm(CARTESIAN, (0, 1, 2), "-1", ()),
}


def oracle(dh: DhTable) -> dh_columns.Table:
    parameters = [(row.a, row.alpha, row.d, row.theta) for row in dh.joints]
    slides = [row.type == "prismatic" for row in dh.joints]
    return dh_columns.Table(dh.convention == "standard", parameters, slides, dh.base, dh.tool)


def formulas(solution: WorkedSolution) -> Formulas:
    assert solution.formulas is not None
    return solution.formulas


def singular(solution: WorkedSolution) -> Singularities:
    assert solution.singularities is not None
    return solution.singularities


def legend(solution: WorkedSolution) -> list[dict[str, Any]]:
    entries: list[SymbolEntry] = [*formulas(solution).legend, *singular(solution).legend]
    return [asdict(entry) for entry in entries]


def draws(count: int, n: int, seed: int = 7) -> Array:
    return np.random.default_rng(seed).uniform(-3.0, 3.0, (count, n))


def numbers(matrix: MatrixFormula | None, names: dict[str, float]) -> Array:
    assert matrix is not None
    assert matrix.plain is not None
    return np.array([[expressions.value(entry, names) for entry in row] for row in matrix.plain])


def determinant(jacobian: Array, T_frame: Array, rows: Sequence[int]) -> float:
    R = T_frame[:3, :3].T
    turned = np.vstack((R @ jacobian[:3], R @ jacobian[3:]))
    return float(np.linalg.det(turned[list(rows)]))


def check_by_text(dh: DhTable, solution: WorkedSolution, count: int = 20) -> None:
    """Every plain formula, by its text and the legend alone, against the oracle's numbers."""
    found, entries, judge = formulas(solution), legend(solution), oracle(dh)
    for q in draws(count, len(dh.joints)):
        names = expressions.namespace(entries, q.tolist())
        frames = replace(judge, base=np.eye(4)).frames(q)
        for i, (A, T) in enumerate(zip(found.rows, found.frames, strict=True)):
            np.testing.assert_allclose(numbers(A, names), np.linalg.inv(frames[i]) @ frames[i + 1], atol=1e-12)
            np.testing.assert_allclose(numbers(T, names), frames[i + 1], atol=1e-12)
        pose, J = judge.pose(q), judge.jacobian(q)
        np.testing.assert_allclose(numbers(found.tip, names), pose, atol=1e-12)
        np.testing.assert_allclose(numbers(found.position, names)[:, 0], pose[:3, 3], atol=1e-12)
        np.testing.assert_allclose(numbers(found.rotation, names), pose[:3, :3], atol=1e-12)
        np.testing.assert_allclose(numbers(found.jacobian, names), J, atol=1e-12)
        assert found.columns is not None
        for i, column in enumerate(found.columns):
            twist = np.vstack((numbers(column.linear, names), numbers(column.angular, names)))[:, 0]
            np.testing.assert_allclose(twist, J[:, i], atol=1e-12)
            if column.arm is not None:
                arm, axis = numbers(column.arm, names)[:, 0], numbers(column.axis, names)[:, 0]
                np.testing.assert_allclose(np.cross(axis, arm), J[:3, i], atol=1e-12)
        if singular(solution).formula is not None:
            check_determinant(solution, judge, q, names)


def check_determinant(solution: WorkedSolution, judge: dh_columns.Table, q: Array, names: dict[str, float]) -> None:
    block, formula = singular(solution).block, singular(solution).formula
    assert block is not None
    assert formula is not None
    wanted = determinant(judge.jacobian(q), judge.frames(q)[block.frame], block.rows)
    assert expressions.value(formula.plain, names) == pytest.approx(wanted, abs=1e-11)
    assert expressions.latex_value(formula.latex, legend(solution), names) == pytest.approx(wanted, abs=1e-11)


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", ARMS)
def test_a_textbook_arm_has_the_determinant_that_the_textbook_prints(name: str) -> None:
    arm = ARMS[name]
    found = singular(worked_solution(arm.table))
    assert found.block is not None
    assert found.formula is not None
    assert found.block.rows == arm.rows
    assert found.formula.plain == arm.determinant
    assert tuple(one.condition.plain for one in found.conditions) == tuple(f"{one} = 0" for one in arm.conditions)


@pytest.mark.quick(2)
@pytest.mark.parametrize("style", ["short", "full"])
@pytest.mark.parametrize("keeps_symbols", [True, False])
@pytest.mark.parametrize("name", ARMS)
def test_every_formula_has_the_value_of_the_matrices(name: str, keeps_symbols: bool, style: Style) -> None:
    dh = ARMS[name].table
    check_by_text(dh, worked_solution(dh, style=style, keeps_symbols=keeps_symbols))


@pytest.mark.parametrize("name", ["anthropomorphic", "Stanford", "UR5", "orthogonal 3R"])
def test_latex_says_the_same_as_plain_text(name: str) -> None:
    dh = ARMS[name].table
    solution = worked_solution(dh)
    found, entries = formulas(solution), legend(solution)
    names = expressions.namespace(entries, draws(1, len(dh.joints))[0].tolist())
    for matrix in (*found.rows, *found.frames, found.tip, found.position, found.rotation, found.jacobian):
        assert matrix is not None
        cells = expressions.latex_entries(latex(matrix))
        values = [[expressions.latex_value(cell, entries, names) for cell in row] for row in cells]
        np.testing.assert_allclose(values, numbers(matrix, names), atol=1e-13)


def test_the_anthropomorphic_arm_as_the_lecture_writes_it() -> None:
    found = formulas(worked_solution(ANTHROPOMORPHIC))
    T = found.frames[2]
    assert T is not None
    assert T.plain == [
        ["c1*c23", "-c1*s23", "s1", "c1*(a2*c2 + a3*c23)"],
        ["s1*c23", "-s1*s23", "-c1", "s1*(a2*c2 + a3*c23)"],
        ["s23", "c23", "0", "a2*s2 + a3*s23"],
        ["0", "0", "0", "1"],
    ]
    assert r"c_{1} \left(a_{2} c_{2} + a_{3} c_{23}\right)" in latex(T)
    assert found.rows[0] is not None
    assert found.rows[0].plain == [
        ["c1", "0", "s1", "0"],
        ["s1", "0", "-c1", "0"],
        ["0", "1", "0", "0"],
        ["0", "0", "0", "1"],
    ]
    assert found.jacobian is not None
    assert found.jacobian.plain == [
        ["-s1*(a2*c2 + a3*c23)", "-c1*(a2*s2 + a3*s23)", "-a3*c1*s23"],
        ["c1*(a2*c2 + a3*c23)", "-s1*(a2*s2 + a3*s23)", "-a3*s1*s23"],
        ["0", "a2*c2 + a3*c23", "a3*c23"],
        ["0", "s1", "s1"],
        ["0", "-c1", "-c1"],
        ["1", "0", "0"],
    ]


def test_the_spherical_wrist_is_the_zyz_matrix() -> None:
    found = formulas(worked_solution(WRIST))
    assert found.rotation is not None
    assert found.position is not None
    assert found.rotation.plain == [
        ["c1*c2*c3 - s1*s3", "-c1*c2*s3 - s1*c3", "c1*s2"],
        ["c1*s3 + s1*c2*c3", "c1*c3 - s1*c2*s3", "s1*s2"],
        ["-s2*c3", "s2*s3", "c2"],
    ]
    assert found.position.plain == [["d3*c1*s2"], ["d3*s1*s2"], ["d3*c2"]]


def test_the_planar_arm_and_the_scara() -> None:
    planar, scara = formulas(worked_solution(PLANAR_2R)), formulas(worked_solution(SCARA))
    assert planar.tip is not None
    assert planar.jacobian is not None
    assert scara.tip is not None
    assert plain(planar.tip)[:2] == [["c12", "-s12", "0", "a1*c1 + a2*c12"], ["s12", "c12", "0", "a1*s1 + a2*s12"]]
    assert plain(planar.jacobian)[:2] == [["-a1*s1 - a2*s12", "-a2*s12"], ["a1*c1 + a2*c12", "a2*c12"]]
    assert [row[3] for row in plain(scara.tip)] == ["a1*c1 + a2*c12", "a1*s1 + a2*s12", "d1 - d4 - q3", "1"]
    assert plain(scara.tip)[0][0] == "c12m4"
    assert r"c_{12-4}" in latex(scara.tip)


def test_full_notation_writes_sums_of_angles_out() -> None:
    found = formulas(worked_solution(PLANAR_2R, style="full"))
    assert found.tip is not None
    assert plain(found.tip)[0] == ["cos(q1 + q2)", "-sin(q1 + q2)", "0", "a1*cos(q1) + a2*cos(q1 + q2)"]
    assert r"\cos\left(q_{1} + q_{2}\right)" in latex(found.tip)


def test_the_position_is_worked_out_from_the_right() -> None:
    chain = formulas(worked_solution(ANTHROPOMORPHIC)).chain
    assert chain is not None
    assert [plain(vector)[0][0] for vector in chain] == ["0", "a3*c3", "a2*c2 + a3*c23", "c1*(a2*c2 + a3*c23)"]


@pytest.mark.parametrize(
    ("name", "solutions"),
    [
        ("planar 2R", [[("q2", "0", 0.0), ("q2", "pi", pi)]]),
        ("spherical wrist", [[("q2", "0", 0.0), ("q2", "pi", pi)]]),
        ("polar", [[("q2", "pi/2", pi / 2), ("q2", "-pi/2", -pi / 2)], [("q3", "-d3", -0.3)]]),
        ("UR5", [[("q3", "0", 0.0), ("q3", "pi", pi)], [("q5", "0", 0.0), ("q5", "pi", pi)], []]),
        (
            "orthogonal 3R",
            [[], [("q3", "acos(-a2/a3)", np.arccos(-0.8)), ("q3", "-acos(-a2/a3)", -np.arccos(-0.8))]],
        ),
        (
            "PUMA, Craig",
            [
                [("q5", "0", 0.0), ("q5", "pi", pi)],
                [],
                [
                    ("q3", "atan2(-d4, a3)", np.arctan2(-0.4318, 0.0203)),
                    ("q3", "atan2(-d4, a3) + pi", np.arctan2(0.4318, -0.0203)),
                ],
            ],
        ),
    ],
)
def test_a_factor_in_one_angle_is_solved(name: str, solutions: list[list[tuple[str, str, float]]]) -> None:
    conditions = singular(worked_solution(ARMS[name].table)).conditions
    found = [[(s.variable.plain, s.formula.plain, s.value) for s in condition.solutions] for condition in conditions]
    assert [[s[:2] for s in one] for one in found] == [[s[:2] for s in one] for one in solutions]
    for one, wanted in zip(found, solutions, strict=True):
        np.testing.assert_allclose([s[2] for s in one], [s[2] for s in wanted], atol=1e-12)


@pytest.mark.parametrize("name", [name for name, arm in ARMS.items() if arm.conditions])
def test_the_rank_drops_at_every_solution_and_example_and_nowhere_near(name: str) -> None:
    dh, block = ARMS[name].table, ARMS[name].rows
    judge, solution = oracle(dh), worked_solution(dh)
    names = list(solution.joint_names)
    for condition in singular(solution).conditions:
        sigma = condition.example_singular_value
        assert condition.example is not None
        assert sigma is not None
        q = np.array(condition.example)
        sigmas = np.linalg.svd(judge.jacobian(q)[list(block)], compute_uv=False)
        assert sigmas[-1] < 1e-9
        assert sigma == pytest.approx(sigmas[-1], abs=1e-9)
        for one in condition.solutions:
            (joint,) = one.joints
            moved = q.copy()
            moved[names.index(joint)] = one.value
            assert np.linalg.svd(judge.jacobian(moved)[list(block)], compute_uv=False)[-1] < 1e-9
            moved[names.index(joint)] += 0.2
            assert np.linalg.svd(judge.jacobian(moved)[list(block)], compute_uv=False)[-1] > 1e-4


def test_reference_numbers_of_determinants() -> None:
    planar = worked_solution(PLANAR_2R, [[0.3, 0.8]])
    anthropomorphic = worked_solution(ANTHROPOMORPHIC, [[0.3, 0.6, -0.8]])
    ur5 = worked_solution(UR5, [[0.1, -1.2, 1.4, -0.7, 0.5, 0.3], [0.1, -1.2, 1.4, -0.7, 0.0, 0.3]])
    assert planar.determinants[0] == pytest.approx(0.502149263630, abs=1e-12)
    assert anthropomorphic.determinants[0] == pytest.approx(0.115450491367, abs=1e-12)
    assert ur5.determinants[0] == pytest.approx(-0.045981129777, abs=1e-12)
    assert anthropomorphic.numeric[0].tip[:3, 3] == pytest.approx([0.768753959783, 0.237803466792, 0.202853504379])
    assert [solution.rank for solution in ur5.numeric] == [6, 5]
    assert ur5.numeric[1].singular_values[:3] == pytest.approx([2.073079224, 1.450502321, 0.545464331], abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_every_table_of_the_catalogue_is_derived_and_certified(name: str) -> None:
    dh = table(catalogue.dh_table(name))
    solution = worked_solution(dh, [[0.1 * i for i in range(len(dh.joints))]])
    assert solution.certificate is not None
    assert solution.certificate.samples == 20
    assert solution.certificate.max_error < 1e-13
    assert solution.numeric_certificate is not None
    check_by_text(dh, solution, count=2)


def test_seven_joints_have_no_determinant_and_the_notes_say_so() -> None:
    solution = worked_solution(table(catalogue.dh_table("panda_dh")))
    assert singular(solution).block is None
    assert formulas(solution).jacobian is not None
    assert "6 × 7" in solution.notes[0]


def test_a_long_arm_stays_numeric_from_where_it_is_too_long_and_says_so() -> None:
    dh = rows("standard", [(0.1, H, 0.1, 0)] * 12, "R" * 12)
    solution = worked_solution(dh, [[0.1] * 12])
    found = formulas(solution)
    written = [frame is not None for frame in found.frames]
    assert len(found.rows) == 12
    assert 4 < sum(written) < 12
    assert written == sorted(written, reverse=True)
    assert found.jacobian is None
    assert f"up to i = {sum(written)}" in solution.notes[0]
    np.testing.assert_allclose(solution.numeric[0].tip, oracle(dh).pose([0.1] * 12), atol=1e-12)


@pytest.mark.slow
def test_base_tool_offsets_and_odd_twists_become_symbols() -> None:
    dh = replace(
        rows("modified", [(0, 0.3, 0.2, 0.4), (0.5, -0.7, 0, H), (0.1, H, 0.3, 0.25)], "RRP"),
        base=dh_columns.shift(0, 0.3) @ dh_columns.turn(1, 0.4),
        tool=dh_columns.shift(2, 0.2) @ dh_columns.turn(0, H),
    )
    solution = worked_solution(dh, [{"joint_1": 0.1, "joint_2": 0.2, "joint_3": 0.3}])
    symbols = {entry["plain"] for entry in legend(solution)}
    assert {"calpha0", "salpha1", "a1", "d3", "bx", "b11", "tz", "theta1", "theta3"} <= symbols
    assert "t11" not in symbols
    check_by_text(dh, solution)
    check_by_text(dh, worked_solution(dh, style="full"))
    check_by_text(dh, worked_solution(dh, keeps_symbols=False))


def test_a_rounded_right_angle_is_read_as_one_and_the_notes_say_so() -> None:
    dh = rows("standard", [(0, 1.5708, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)], "RRR")
    solution = worked_solution(dh)
    assert formulas(solution).rows == formulas(worked_solution(ANTHROPOMORPHIC)).rows
    assert solution.notes == ["row 1: alpha = 1.5708 rad is read as 1.5707963267948966, 3.7e-06 rad away"]


def test_ten_joints_and_more_have_symbols_that_cannot_be_confused() -> None:
    found = formulas(worked_solution(rows("standard", [(0.1, 0, 0, 0)] * 12, "R" * 12)))
    symbols = [entry.plain for entry in found.legend]
    assert len(set(symbols)) == len(symbols)
    assert "c1_2_3_4_5_6_7_8_9_10_11_12" in symbols
    assert "c1" in symbols
    assert found.tip is not None
    assert "c_{1,2,3,4,5,6,7,8,9,10,11,12}" in latex(found.tip)


@pytest.mark.parametrize("scale", [1e6, 1e-7])
@pytest.mark.parametrize("name", ["UR5", "Stanford", "anthropomorphic"])
def test_neither_huge_nor_tiny_arms_change_a_formula(name: str, scale: float) -> None:
    arm = ARMS[name]
    joints = tuple(replace(row, a=row.a * scale, d=row.d * scale) for row in arm.table.joints)
    formula = singular(worked_solution(replace(arm.table, joints=joints))).formula
    assert formula is not None
    assert formula.plain == arm.determinant


def test_an_arm_that_is_singular_everywhere_is_told_so() -> None:
    solution = worked_solution(rows("standard", [(0.1, 0, 0, 0)] * 6, "R" * 6), [[0.1] * 6])
    formula = singular(solution).formula
    assert formula is not None
    assert formula.plain == "0"
    assert solution.numeric[0].rank == 3
    assert "everywhere" in solution.steps[-2].text


@pytest.mark.parametrize("ratio", [0.8, 1.5])
def test_a_condition_that_no_angle_fulfils_is_told_apart(ratio: float) -> None:
    dh = rows("standard", [(0.4 * ratio, -H, 0, 0), (0.4, H, 0, 0), (0.1, 0, 0, 0)], "RRR")
    conditions = {one.condition.plain: one for one in singular(worked_solution(dh)).conditions}
    found = conditions["a1 + a2*c2 = 0"]
    assert found.kind == ("solved" if ratio < 1 else "never")
    assert (found.example is None) == (ratio > 1)


def test_steps_tell_the_solution_in_order() -> None:
    titles = [step.title for step in worked_solution(UR5).steps]
    assert titles == [
        "Denavit-Hartenberg table",
        "Transforms between neighbours",
        "Position of the tip",
        "Forward kinematics",
        "Geometric Jacobian",
        "Determinant",
        "Singular configurations",
    ]


# A prismatic joint whose constant angle is odd

SLIDES = {
    "R-P": rows("standard", [(1, -H, 0, 0), (0.5, 0, 0, 0.3)], "RP"),
    "R-P-P": rows("standard", [(1, -H, 0, 0), (1, -H, 0, 0.3), (1, 0, 0, 0)], "RPP"),
    "P-P-P": rows("modified", [(1, -H, 0, 0), (1, -H, 0, 0.3), (1, H, 0, 0)], "PPP"),
    "R-P-R, parallel": rows("standard", [(0.4, 0, 0, 0), (0.3, 0, 0, 0.7), (0.2, 0, 0, -1.1)], "RPR"),
    "R-P-R, parallel, beside": rows("modified", [(0, 0, 0, 0), (0.4, 0, 0, 0.7), (0.3, 0, 0, 0.2)], "RPR"),
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SLIDES)
def test_the_constant_angle_of_a_slide_is_no_variable(name: str) -> None:
    dh = SLIDES[name]
    solution = worked_solution(dh)
    assert not [note for note in solution.notes if "failed" in note]
    check_by_text(dh, solution)
    turning = {row.name for row in dh.joints if row.type == "revolute"}
    for condition in singular(solution).conditions:
        for value in condition.solutions:
            joints = set(value.joints)
            assert joints <= turning or (len(joints) == 1 and "q" in condition.condition.plain)


def test_a_slide_along_an_odd_direction_is_singular_where_it_is_drawn_in() -> None:
    dh = SLIDES["R-P-P"]
    found = singular(worked_solution(dh))
    assert found.formula is not None
    assert found.formula.plain == "q2*c2"
    (condition,) = found.conditions
    assert [(one.joints, one.value) for one in condition.solutions] == [(["joint_2"], 0.0)]
    assert condition.example is not None
    assert np.linalg.svd(oracle(dh).jacobian(condition.example)[:3], compute_uv=False)[-1] < 1e-12


def test_three_slides_in_odd_directions_are_singular_nowhere() -> None:
    solution = worked_solution(SLIDES["P-P-P"])
    assert list(singular(solution).conditions) == []
    assert singular(solution).formula is not None


@pytest.mark.slow
def test_a_turn_beside_the_constant_angle_of_a_slide_is_solved_for_the_joint() -> None:
    dh = rows("modified", [(0, 0, 0, 0), (0.5, 0, 0, 0.7), (0, H, 0, 0)], "RPP")
    for condition in singular(worked_solution(dh)).conditions:
        for value in condition.solutions:
            q = draws(1, 3)[0]
            places = [int(name.removeprefix("joint_")) - 1 for name in value.joints]
            assert all(dh.joints[i].type == "revolute" or len(places) == 1 for i in places)
            q[places[-1]] = 0.0
            q[places[-1]] = (value.value - np.array(value.signs) @ q[places]) * value.signs[-1]
            assert np.linalg.svd(oracle(dh).jacobian(q)[:3], compute_uv=False)[-1] < 1e-9


# Scales


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("lengths", [(1e6, 1e-6), (1e5, 1e-3), (1e-6, 1e6), (1e-4, 1e-5), (3e-8, 2e5)])
def test_long_and_short_links_together_have_their_determinant(
    lengths: tuple[float, float], convention: Convention
) -> None:
    a, b = lengths
    second = (b, 0, 0, 0) if convention == "standard" else (a, 0, 0, 0)
    dh = rows(convention, [(a if convention == "standard" else 0, 0, 0, 0), second], "RR")
    if convention == "modified":
        tool = np.eye(4)
        tool[0, 3] = b
        dh = replace(dh, tool=tool)
    solution = worked_solution(dh)
    assert solution.notes == []
    assert len(singular(solution).factors) == 3
    for value, (_, q2) in zip(singular(solution).values, worked._samples(dh), strict=True):
        assert value == pytest.approx(a * b * np.sin(q2), rel=1e-9)


def test_a_wrong_determinant_of_a_tiny_arm_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = symbolic.singularities

    def wrong(question: SymbolicRequest) -> Singularities:
        found = honest(question)
        return replace(found, values=[value * (1 + 1e-6) for value in found.values])

    monkeypatch.setattr(worked, "singularities", wrong)
    found = singular(worked_solution(rows("standard", [(1e-6, 0, 0, 0), (1e-6, 0, 0, 0)], "RR")))
    assert found.formula is None


def test_a_base_that_is_read_as_a_round_one_is_compared_as_such() -> None:
    base = dh_columns.turn(2, pi / 4) + 9e-10
    base[3] = [0, 0, 0, 1]
    solution = worked_solution(replace(rows("standard", [(50.0, 0, 0, 0), (40.0, 0, 0, 0)], "RR"), base=base))
    assert not [note for note in solution.notes if "failed" in note]


# Formulas that fail


def logged(caplog: pytest.LogCaptureFixture) -> list[str]:
    return [record.getMessage() for record in caplog.records if record.levelname == "ERROR"]


QUANTITIES = {"rows": "A_1", "frames": "T_0_1", "tip": "T_base_tool", "jacobian": "the Jacobian"}


@pytest.mark.parametrize("field", QUANTITIES)
def test_a_formula_that_disagrees_with_the_numbers_is_left_out_and_the_rest_remains(
    field: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    honest = symbolic.formulas

    def wrong(question: SymbolicRequest) -> Formulas:
        found = honest(question)
        values = []
        for value in found.values:
            grids = getattr(value, field)
            first = grids[0] if field in {"rows", "frames"} else grids
            spoilt = [[x + 1e-6 for x in row] for row in first]
            change: dict[str, Any] = {field: [spoilt, *grids[1:]] if field in {"rows", "frames"} else spoilt}
            values.append(replace(value, **change))
        return replace(found, values=values)

    monkeypatch.setattr(worked, "formulas", wrong)
    solution = worked_solution(PLANAR_2R, [[0.3, 0.4]])
    found, right = formulas(solution), honest_formulas()
    for other in QUANTITIES:
        kept, whole = getattr(found, other), getattr(right, other)
        if other == field:
            kept, whole = ([None, *whole[1:]], kept) if field in {"rows", "frames"} else (None, kept)
        assert kept == whole
    assert (found.position is None) == (found.rotation is None) == (field == "tip")
    assert (found.columns is None) == (field == "jacobian")
    assert (found.chain is None) == (field in {"rows", "tip"})
    assert singular(solution).formula is not None
    (note,) = solution.notes
    assert note.startswith(f"{QUANTITIES[field]} in symbols failed the comparison with numbers (by 1e-06")
    (line,) = logged(caplog)
    assert f"{QUANTITIES[field]} in symbols" in line
    assert solution.certificate is not None
    assert solution.certificate.max_error < 1e-12
    np.testing.assert_allclose(solution.numeric[0].tip, oracle(PLANAR_2R).pose([0.3, 0.4]), atol=1e-12)


def honest_formulas() -> Formulas:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(worked, "formulas", symbolic.formulas)
        return formulas(worked_solution(PLANAR_2R))


def test_a_value_that_is_no_number_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    honest = symbolic.formulas

    def wrong(question: SymbolicRequest) -> Formulas:
        found = honest(question)
        return replace(found, values=[replace(one, jacobian=[[float("nan")] * 2] * 6) for one in found.values])

    monkeypatch.setattr(worked, "formulas", wrong)
    assert formulas(worked_solution(PLANAR_2R)).jacobian is None


def test_a_determinant_that_disagrees_with_the_numbers_is_left_out_with_its_conditions(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    honest = symbolic.singularities

    def wrong(question: SymbolicRequest) -> Singularities:
        found = honest(question)
        return replace(found, values=[-value for value in found.values])

    monkeypatch.setattr(worked, "singularities", wrong)
    solution = worked_solution(PLANAR_2R, [[0.3, 0.4]])
    assert singular(solution).formula is None
    assert not singular(solution).factors
    assert not singular(solution).conditions
    assert solution.determinants[0] == pytest.approx(0.7 * np.sin(0.4))
    assert "the determinant in symbols failed" in solution.notes[-1]
    assert "the determinant in symbols" in logged(caplog)[0]
    assert formulas(solution) == honest_formulas()
    assert "Singular configurations" not in [step.title for step in solution.steps]


def test_a_solution_that_is_not_singular_is_left_out_and_its_factor_remains(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    honest = symbolic.singularities

    def wrong(question: SymbolicRequest) -> Singularities:
        found = honest(question)
        return replace(found, conditions=[replace(one, example=[0.3, 0.5]) for one in found.conditions])

    monkeypatch.setattr(worked, "singularities", wrong)
    solution = worked_solution(PLANAR_2R)
    (condition,) = singular(solution).conditions
    assert (condition.kind, condition.solutions, condition.example) == ("equation", [], None)
    assert condition.condition.plain == "s2 = 0"
    assert singular(solution).formula is not None
    assert condition.example_singular_value is None
    assert "s2 = 0 failed" in solution.notes[-1]
    assert len(logged(caplog)) == 1


@pytest.mark.parametrize("part", ["formulas", "singularities"])
def test_a_check_within_the_symbolic_part_that_fails_leaves_the_numbers(
    part: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    def wrong(_: SymbolicRequest) -> Any:
        raise ArithmeticError("z × p is not ∂p/∂q")

    monkeypatch.setattr(worked, part, wrong)
    solution = worked_solution(PLANAR_2R, [[0.3, 0.4]])
    assert getattr(solution, part) is None
    assert "in symbols failed a check of " in solution.notes[-1]
    assert len(logged(caplog)) == 1
    np.testing.assert_allclose(solution.numeric[0].tip, oracle(PLANAR_2R).pose([0.3, 0.4]), atol=1e-12)


def test_without_time_for_symbols_the_numbers_remain() -> None:
    def overdue(*_: object) -> Any:
        raise TimeoutError

    solution = worked_solution(UR5, [[0.1] * 6], run=overdue)
    assert solution.formulas is None
    assert solution.determinants[0] is not None
    assert "time allowed" in solution.notes[0]
    np.testing.assert_allclose(solution.numeric[0].tip, oracle(UR5).pose([0.1] * 6), atol=1e-12)


def test_a_row_that_follows_another_joint_is_refused_by_name() -> None:
    joints = (PLANAR_2R.joints[0], replace(PLANAR_2R.joints[1], mimic=Mimic("joint_1", 2.0, 0.0)))
    with pytest.raises(InvalidDhTable) as caught:
        worked_solution(replace(PLANAR_2R, joints=joints))
    assert asdict(caught.value)["joint"] == 1
    with pytest.raises(WrongJointCount):
        worked_solution(PLANAR_2R, [[0.1]])


def test_the_symbolic_side_knows_neither_numpy_nor_pinocchio_and_sympy_only_when_it_must() -> None:
    code = "import sys, gelenk.dh.derive.symbolic; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numpy", "pinocchio", "numba", "sympy", "gelenk.robot.dh"} & set(loaded)


ANGLES = st.sampled_from([0.0, H, -H, pi, pi / 4, -pi / 3, 0.3])
LENGTHS = st.sampled_from([0.0, 0.0, 0.2, -0.3, 0.45])
ROWS = st.tuples(LENGTHS, ANGLES, LENGTHS, ANGLES)


@pytest.mark.slow
@given(
    convention=st.sampled_from(["standard", "modified"]),
    parameters=st.lists(ROWS, min_size=1, max_size=4),
    data=st.data(),
)
@settings(max_examples=40, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_any_small_table_is_derived(
    convention: Convention, parameters: list[tuple[float, float, float, float]], data: st.DataObject
) -> None:
    types = "".join(data.draw(st.sampled_from("RRRP")) for _ in parameters)
    dh = rows(convention, parameters, types)
    solution = worked_solution(dh, style=data.draw(st.sampled_from(["short", "full"])))
    check_by_text(dh, solution, count=1)


# Part of an arm, and columns in another order


def test_a_wrist_at_the_end_of_an_arm_has_the_indices_of_its_joints() -> None:
    """The lecture's T^3_6: a matrix of ZYZ angles in ϑ_4, ϑ_5, ϑ_6, and p = d_6 R e_z."""
    solution = worked_solution(WRIST, [[0.2, 0.9, -0.5]], first_index=4)
    found = formulas(solution)
    assert [matrix.name for matrix in [*found.rows, *found.frames] if matrix] == [
        "A_4", "A_5", "A_6", "T_3_4", "T_3_5", "T_3_6",
    ]  # fmt: skip
    assert found.position is not None
    assert found.position.plain == [["d6*c4*s5"], ["d6*s4*s5"], ["d6*c5"]]
    assert {entry.plain for entry in found.legend} == {"d6", "c4", "s4", "c5", "s5", "c6", "s6"}
    assert {entry.meaning for entry in found.legend if entry.plain in {"d6", "c4"}} == {
        "length d of row 6, in m", "cos(q4)",
    }  # fmt: skip
    latex = [line for step in solution.steps for line in step.latex]
    for start in (
        "A^{3}_{4} = ",
        "T^{3}_{6} = ",
        "{}^{3}p = A^{3}_{4}\\, A^{4}_{5}\\, A^{5}_{6}\\, {}^{6}p",
        "z_{3} =",
    ):
        assert any(line.startswith(start) for line in latex), start
    assert not any(re.search(r"[cs]_\{?[123]\b|q_\{?[123]\b", line) for line in latex)
    conditions = singular(solution).conditions
    assert [one.condition.plain for one in conditions] == ["s5 = 0"]
    np.testing.assert_allclose(
        solution.numeric[0].tip[:3, 3], [0.076771252365, 0.015562303293, 0.062160996827], atol=1e-11
    )


@pytest.mark.quick(1)
@pytest.mark.parametrize("dh", [STANFORD, PUMA_CRAIG, UR5], ids=["Stanford", "Puma", "UR5"])
def test_other_indices_change_nothing_else(dh: DhTable) -> None:
    usual, other = formulas(worked_solution(dh)), formulas(worked_solution(dh, first_index=4))
    for one, same in zip([*usual.rows, usual.tip], [*other.rows, other.tip], strict=True):
        assert one is not None
        assert same is not None
        assert [[shifted(entry) for entry in row] for row in one.plain or []] == same.plain


def shifted(plain: str) -> str:
    """A formula with 3 added to each index."""
    return re.sub(r"\b(a|d|q|c|s|theta)(\d+)\b", lambda m: m[1] + "".join(str(int(d) + 3) for d in m[2]), plain)


def test_the_position_in_numbers_is_worked_out_from_the_right() -> None:
    """The anthropomorphic arm of the lecture: each vector is in the step, the last one its position."""
    solution = worked_solution(ANTHROPOMORPHIC, [[0.3, 0.6, -0.8]])
    step = solution.steps[-1]
    assert step.title == "The position in numbers"
    last = step.latex[-2]
    assert last.startswith("{}^{0}p = A^{0}_{1}\\, {}^{1}p = ")
    entries = [float(value) for value in last.rsplit(r"\begin{bmatrix} ", 1)[1].split(r" \end")[0].split(r" \\ ")]
    np.testing.assert_allclose(entries, [0.768753959783, 0.237803466792, 0.202853504379, 1.0], atol=1e-9)


def test_the_table_of_the_steps_has_the_columns_asked_for() -> None:
    usual = worked_solution(SCARA).steps[0].latex[0]
    other = worked_solution(SCARA, columns=("a", "d", "alpha", "theta")).steps[0].latex[0]
    assert r"1 & a_{1} & 0 & d_{1} & q_{1} \\" in usual
    assert r"1 & a_{1} & d_{1} & 0 & q_{1} \\" in other
