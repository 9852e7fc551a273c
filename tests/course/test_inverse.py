"""Inverse kinematics by hand against the lecture's numbers, against the solver, and where arms degenerate."""

import json
import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from gelenk.contract.ik import InverseRequest
from gelenk.course.inverse.agreement import SentSolutions, hand_steps
from gelenk.course.inverse.arm import HandArm, hand_arm
from gelenk.course.steps import Step
from gelenk.ik.solve import solve
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.ik_request import TargetLimits, parse
from gelenk.operations.ik_steps import worked
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.poses import Poses
from tests.robots import robot

POSE = frozenset({"x", "y", "z", "rx", "ry", "rz"})
POSITION = frozenset("xyz")


def solved_by_hand(name: str, qs: Any, **call: Any) -> tuple[list[list[Step]], InverseKinematics]:
    """The steps and what is sent, for the poses of some configurations."""
    chain = robot(name).chain(None, None)
    poses = Poses(*chain_poses(chain.flat, np.atleast_2d(np.array(qs, dtype=float))))
    return asked_of_poses(name, [{"matrix": T} for T in poses.matrices().tolist()], **call)


def asked_of_poses(name: str, targets: Any, **call: Any) -> tuple[list[list[Step]], InverseKinematics]:
    body = {"targets": targets, "steps": True, "solutions": "all", **call}
    request = InverseRequest.model_validate_json(json.dumps(body))
    problem = parse(robot(name), request, TargetLimits(1000, 1000, None))
    found = solve(problem)
    return worked(problem, request, found), found


def listed(steps: list[Step]) -> list[str]:
    return [line for step in steps if step.title == "All solutions" for line in step.plain]


def numbers(line: str) -> list[float]:
    return [float(part) for part in re.findall(r"-?\d+(?:\.\d+)?", line.split("=")[1])]


def apart(lines: list[str], solutions: Array) -> float:
    """How far the solution by hand that is furthest from all others is from them, or one of them from it."""
    gaps = np.abs(np.array([numbers(line) for line in lines])[:, None] - solutions[None]).max(axis=2)
    return float(max(gaps.min(axis=0).max(), gaps.min(axis=1).max()))


def text(steps: list[Step]) -> str:
    return "\n".join(part for step in steps for part in (step.title, step.text, *step.plain))


def arm(*rows: tuple[float, float, float], slides: tuple[int, ...] = ()) -> HandArm:
    """An arm of rows (a, α, d)."""
    kinds: list[Any] = ["prismatic" if i in slides else "revolute" for i in range(len(rows))]
    joints = (DhJoint(f"q{i}", kinds[i], a, alpha, d, 0.0) for i, (a, alpha, d) in enumerate(rows))
    return hand_arm(DhTable("standard", tuple(joints)))


def by_hand(of: HandArm, q: list[float], directions: frozenset[str] = POSE) -> list[Step]:
    found = hand_steps(of, SentSolutions(of.pose(of.values(np.array(q))), directions, np.array([q])))
    assert found is not None
    return found


UP = 0.5 * math.pi
TWO_LINKS = arm((1.0, 0.0, 0.0), (0.7, 0.0, 0.0))
ANTHROPOMORPHIC = arm((0.0, UP, 0.0), (0.5, 0.0, 0.0), (0.4, 0.0, 0.0))
WRIST = arm((0.0, -UP, 0.0), (0.0, UP, 0.0), (0.0, 0.0, 0.1))
SIX = arm((0.0, UP, 0.3), (0.5, 0.0, 0.0), (0.0, UP, 0.0), (0.0, -UP, 0.4), (0.0, UP, 0.0), (0.0, 0.0, 0.1))
SCARA = arm((0.325, 0.0, 0.387), (0.275, math.pi, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.05), slides=(2,))
LECTURE: dict[str, tuple[HandArm, frozenset[str], list[list[float]]]] = {
    "two links": (
        TWO_LINKS,
        frozenset("xy"),
        [[0.106585970938, 1.599371644064], [1.346698710425, -1.599371644064]],
    ),
    "scara": (SCARA, POSE, [[0.4, 0.8, 0.12, -0.3], [1.129563599263, -0.8, 0.12, -1.170436400737]]),
    "anthropomorphic": (
        ANTHROPOMORPHIC,
        POSITION,
        [
            [0.3, -0.106114973898, 0.8],
            [0.3, 0.6, -0.8],
            [-2.841592653590, 2.541592653590, 0.8],
            [-2.841592653590, -3.035477679692, -0.8],
        ],
    ),
    "wrist": (
        WRIST,
        frozenset({"rx", "ry", "rz"}),
        [[0.2, 0.9, -0.5], [-2.941592653590, -0.9, 2.641592653590]],
    ),
}


@pytest.mark.parametrize("name", LECTURE)
def test_the_lectures_solutions_by_hand(name: str) -> None:
    of, directions, wanted = LECTURE[name]
    lines = listed(by_hand(of, wanted[0], directions))
    assert apart(lines, np.array(wanted)) < 1e-9
    assert sum(line.startswith("*") for line in lines) == len(wanted) - 1


def test_the_lectures_decoupling() -> None:
    q = [0.3, 0.6, 0.7, 0.2, 0.9, -0.5]
    steps = by_hand(SIX, q)
    shown = text(steps)
    assert "= (0.7624455319, 0.2358520414, 0.4753217052)" in shown
    assert "(ϑ_4, ϑ_5, ϑ_6) = (0.2, 0.9, -0.5)" in shown
    solutions = np.array([numbers(line) for line in listed(steps)])
    assert solutions.shape == (8, 6)
    for other in solutions:
        assert SIX.pose(other) == pytest.approx(SIX.pose(np.array(q)), abs=1e-8)


ARMS = [
    *("planar_2r", "planar_3r", "scara", "anthropomorphic", "anthropomorphic_wrist", "stanford", "puma560", "kinova"),
    *("ur5", "ur3_gripper", "z1", "solo12", "a1", "finger_edu"),
]


@pytest.mark.quick(5)
@pytest.mark.parametrize("name", ARMS)
def test_by_hand_are_all_the_solutions_of_the_solver(name: str) -> None:
    chain = robot(name).chain(None, None)
    qs = np.random.default_rng(4).uniform(np.maximum(chain.lower, -3.0), np.minimum(chain.upper, 3.0), (6, len(chain)))
    worked_out, found = solved_by_hand(name, qs, respect_limits=False)
    for i, steps in enumerate(worked_out):
        sent = found.qs[found.firsts[i] : found.firsts[i + 1]]
        lines = listed(steps)
        assert len(lines) == len(sent) > 0
        assert not any(line.startswith("*") for line in lines)
        assert apart(lines, sent) < 1e-9


def test_what_is_beyond_the_limits_has_a_star() -> None:
    (steps,), found = solved_by_hand("stanford", [0.2, 0.5, 0.6, -0.3, 0.7, 0.1])
    stars = [line.startswith("*") for line in listed(steps)]
    assert (len(stars), stars.count(False)) == (8, len(found.qs))


@pytest.mark.parametrize("error", [1e-8, -1e-3])
def test_numbers_that_do_not_agree_are_not_stated(error: float) -> None:
    q = np.array([0.3, 0.6, -0.8])
    pose = ANTHROPOMORPHIC.pose(q)
    assert hand_steps(ANTHROPOMORPHIC, SentSolutions(pose, POSITION, q[None])) is not None
    assert hand_steps(ANTHROPOMORPHIC, SentSolutions(pose, POSITION, q[None] + error)) is None


def test_an_iteration_that_is_less_exact_gets_no_solution_by_hand() -> None:
    target = [{"position": [0.9, 0.8, 0.0], "rpy": [0, 0, 0]}]
    body: dict[str, Any] = {"task": ["x", "y"], "seeds": [[0.3, 1.2]], "method": "gradient", "solutions": "one"}
    (steps,), _ = asked_of_poses("planar_2r", target, **body)
    assert [step.title for step in steps] == ["How it was solved"]
    assert "gradient" in steps[0].text


@pytest.mark.parametrize(
    ("x", "y", "words"),
    [(1.7, 0.0, "stretched or folded"), (0.0, -0.3, "stretched or folded"), (1.8, 0.0, "out of reach"),
     (0.0, 0.1, "out of reach"), (0.9, 0.8, "two solutions")],
)  # fmt: skip
def test_the_triangle_of_two_links(x: float, y: float, words: str) -> None:
    (steps,), found = asked_of_poses("planar_2r", [{"position": [x, y, 0], "rpy": [0, 0, 0]}], task=["x", "y"])
    assert words in text(steps)
    assert len(listed(steps)) == len(found.qs)


def test_a_folded_arm_of_equal_links_turns_freely() -> None:
    of = arm((0.5, 0.0, 0.0), (0.5, 0.0, 0.0))
    steps = by_hand(of, [0.4, math.pi], frozenset("xy"))
    assert "its angle is free" in text(steps)
    assert listed(steps) == ["q = ( · , 3.141592654)"]


def test_a_point_on_the_first_axis_leaves_its_angle_free() -> None:
    target = [{"position": [0.0, 0.0, 0.6], "rpy": [0, 0, 0]}]
    (steps,), _ = asked_of_poses("anthropomorphic", target, task=["x", "y", "z"])
    assert "the angle is free" in text(steps)
    assert all(line.startswith("q = ( · ,") for line in listed(steps))
    assert len(listed(steps)) == 2


@pytest.mark.parametrize(("middle", "known"), [(0.0, "ϑ_4 + ϑ_6 = -0.3"), (math.pi, "ϑ_4 - ϑ_6 = 0.7")])
def test_a_wrist_in_line_has_only_a_sum(middle: float, known: str) -> None:
    steps = by_hand(SIX, [0.3, 0.6, 0.7, 0.2, middle, -0.5])
    assert known in text(steps)
    assert "only their sum or difference is known" in text(steps)


def test_a_wrist_centre_on_the_first_axis_is_a_family() -> None:
    third = math.asin(-0.5 * math.cos(1.0) / 0.4) - 1.0
    (steps,), found = solved_by_hand("anthropomorphic_wrist", [0.3, 1.0, third, 0.2, 0.9, -0.5], respect_limits=False)
    assert len(found.qs) > 8
    assert "A family of solutions" in text(steps)


def test_an_orientation_that_an_arm_cannot_have_is_no_solution() -> None:
    (steps,), found = asked_of_poses("scara", [{"position": [0.3, 0.3, 0.2], "rpy": [0, 0, 0]}])
    assert found.statuses == ["unreachable"]
    assert steps[-1].title == "No solution"


@pytest.mark.parametrize("offset", [0.0, 0.6])
@pytest.mark.parametrize("turned", range(3))
def test_the_choice_of_the_tables_axes_does_not_matter(turned: int, offset: float) -> None:
    """Turning a frame about x by π, and another zero, give other tables of the same arm."""
    rows = list(SIX.rows)
    rows[turned] = replace(rows[turned], alpha=rows[turned].alpha + math.pi)
    after = rows[turned + 1]
    rows[turned + 1] = replace(after, theta=-after.theta, d=-after.d, alpha=after.alpha + math.pi, sign=-1)
    rows[4] = replace(rows[4], theta=rows[4].theta + offset)
    of = replace(SIX, rows=tuple(rows))
    q = np.array([0.3, 0.6, 0.7, 0.2, 0.9, -0.5])
    pose: Array = of.pose(of.values(q))
    steps = hand_steps(of, SentSolutions(pose, POSE, q[None]))
    assert steps is not None
    assert len(listed(steps)) == 8


def test_arms_without_a_solution_by_hand_say_so() -> None:
    (steps,), _ = solved_by_hand("so100", [0.1, 0.3, 0.2, 0.5, 0.3], solutions="one")
    assert [step.title for step in steps] == ["How it was solved"]


def test_a_third_joint_that_does_not_move_the_tip_is_no_elbow() -> None:
    of = arm((0.0, UP, 0.0), (0.5, 0.0, 0.0), (0.0, 0.0, 0.0))
    q = np.array([0.3, 0.6, -0.8])
    assert hand_steps(of, SentSolutions(of.pose(q), POSITION, q[None])) is None


@pytest.mark.parametrize("seed", range(20))
def test_arms_of_special_geometry_in_special_postures_are_solved_or_left(seed: int) -> None:
    """Parallel, square and skew axes, slides, zero lengths; what is stated has the posture among its solutions."""
    rng = np.random.default_rng(seed)
    for _ in range(20):
        count = int(rng.choice([2, 3, 3, 4, 6, 6]))
        lengths = rng.choice([0.0, 0.3, -0.4, 0.2], (count, 2)).tolist()
        alphas = rng.choice([0.0, UP, -UP, math.pi, 0.4], count, p=[0.2, 0.35, 0.3, 0.1, 0.05]).tolist()
        slides = tuple(np.flatnonzero(rng.uniform(size=count) < 0.15).tolist())
        rows = ((a, alpha, d) for (a, d), alpha in zip(lengths, alphas, strict=True))
        of = arm(*rows, slides=slides)
        q = rng.choice([0.0, 0.3, UP, -2.0, math.pi], count)
        pose = of.pose(of.values(q))
        for directions in (POSE, POSITION):
            found = hand_steps(of, SentSolutions(pose, directions, q[None]))
            assert found is None or any(not line.startswith("*") for line in listed(found))
            hand_steps(of, SentSolutions(pose + np.eye(4, k=3), directions, np.empty((0, count))))
