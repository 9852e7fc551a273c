"""Families: which joints move where infinitely many solutions meet a target, and that none is told of elsewhere."""

import re
from collections.abc import Callable

import numpy as np
import pytest

from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from tests.ik.arm_classes import CLASSES, IN_THE_PLANE, QUARTER, Arm, Row
from tests.ik.arms import PLANAR, POSITION

SLIDES: list[Row] = [(0.0, 0.0, 0.1, 0.0), (0.0, 0.0, 0.0, 0.0), (0.3, QUARTER, 0.0, 0.0), (0.2, 0.3, 0.1, 0.0)]


def link(a: float) -> Row:
    return (a, 0.0, 0.0, 0.0)


def of_class(name: str) -> Callable[[np.random.Generator], Arm]:
    return lambda rng: CLASSES[name].arm(int(rng.integers(1000)))


def on_axis(arm: Arm, q: Array) -> Array:
    """Two links over a turning base, whose end is on the base's axis."""
    upper, lower = arm.table.rows[1][0], arm.table.rows[2][0] or arm.table.rows[3][2]
    bend = 0.0 if arm.table.rows[2][0] else -QUARTER
    q[1] = np.pi / 2 + 0.3
    q[2] = np.arccos(-upper / lower * np.cos(q[1])) - q[1] - bend
    return q


def at(joint: int, value: float) -> Callable[[Arm, Array], Array]:
    def put(_: Arm, q: Array) -> Array:
        q[joint] = value
        return q

    return put


# Of each: the arm, its configuration, the task, which joints move, and how they are tied.
CASES: dict[str, tuple[Callable[[np.random.Generator], Arm], Callable[[Arm, Array], Array], Task, str, str | None]] = {
    **{
        f"{name} at {value:.0f}": (of_class(name), at(4, value), FULL_POSE, "4 6", f"q_4 {sign} q_6 = c")
        for name in ("anthropomorphic with a wrist", "offset elbow with a wrist", "stanford")
        for value, sign in ((0.0, "+"), (np.pi, "-"))
    },
    "universal": (of_class("universal"), at(4, 0.0), FULL_POSE, "2 3 4 6", "q_2 + q_3 + q_4 + q_6 = c"),
    "universal, folded": (of_class("universal"), at(4, np.pi), FULL_POSE, "2 3 4 6", "q_2 + q_3 + q_4 - q_6 = c"),
    "tip on the first axis": (of_class("anthropomorphic"), on_axis, POSITION, "1", None),
    "wrist on the first axis": (of_class("anthropomorphic with a wrist"), on_axis, FULL_POSE, "1 4 5 6", None),
    "planar 2R at its base": (lambda _: Arm([link(0.4)] * 2, "RR"), at(1, np.pi), PLANAR, "1", None),
    "planar 3R": (lambda r: Arm([link(a) for a in r.uniform(0.3, 0.4, 3)], "RRR"), at(0, 0.1), PLANAR, "1 2 3", None),
    "planar 4R": (
        lambda r: Arm([link(a) for a in r.uniform(0.3, 0.4, 4)], "RRRR"),
        at(0, 0.1),
        IN_THE_PLANE,
        "1 2 3 4",
        "q_1 + q_2 + q_3 + q_4 = c",
    ),
    "parallel slides": (lambda _: Arm(SLIDES, "PPRR"), at(0, 0.1), FULL_POSE, "1 2", "q_1 + q_2 = c"),
    "position of six joints": (of_class("universal"), at(4, 0.7), POSITION, "1 2 3 4 5 6", None),
    "position of a wrist arm": (
        of_class("offset elbow with a wrist"),
        at(4, 0.7),
        POSITION,
        "1 2 3 4 5 6",
        None,
    ),
    "seven joints": (of_class("spherical shoulder and wrist"), at(3, 1.1), FULL_POSE, "1 2 3 5 6 7", None),
    "seven joints, offset": (of_class("the same with an offset elbow"), at(3, 1.1), FULL_POSE, "1 2 3 5 6 7", None),
}


def answered(arm: Arm, q: Array, task: Task = FULL_POSE) -> InverseKinematics:
    """All solutions of the pose of a configuration, as the textbook has it, from a seed beside it."""
    T = arm.table.pose(q)
    targets = Poses(T[None, :3, 3].copy(), T[None, :3, :3].copy())
    return inverse_kinematics(arm.robot, arm.chain, targets, 0.8 * q[None] + 0.1, Options(task=task, every=True))


def told(arm: Arm, q: Array, answer: InverseKinematics, task: Task) -> list[tuple[str, str | None]]:
    """The joints that move and the relation of each family, whose every claim is looked at by the textbook's poses."""
    assert answer.complete == [False]
    families = answer.families.get(0, ())
    target = arm.table.pose(q)
    for family in families:
        assert family.text in answer.doubts[0]
        sweep = np.array(family.sweep)
        poses = np.array([arm.table.pose(member) for member in sweep])
        goals = np.repeat(target[None], len(poses), axis=0)
        errors = task.errors(*(Poses(Ts[:, :3, 3].copy(), Ts[:, :3, :3].copy()) for Ts in (goals, poses)))
        assert errors.max() < 1e-8
        assert ((sweep >= arm.chain.lower) & (sweep <= arm.chain.upper)).all()
        spans = np.ptp(sweep, axis=0)
        moving = np.array([name in family.free_joints for name in arm.chain.joint_names])
        assert (spans[~moving] < 1e-4).all()
        assert spans.max() > 0.1
        assert np.abs(np.diff(sweep, axis=0)).max() < 2.0
        if family.relation is not None:
            (terms,) = (part.removesuffix(" = c") for part in family.relation.split(", "))
            total = sum(
                (-1.0 if sign == "-" else 1.0) * sweep[:, int(joint) - 1]
                for sign, joint in re.findall(r"([-+]?) ?q_(\d)", terms)
            )
            assert np.ptp(total) < 1e-5
    return [(" ".join(re.findall(r"\d", " ".join(family.free_joints))), family.relation) for family in families]


@pytest.mark.quick(3)
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("case", CASES)
def test_where_infinitely_many_solutions_are_the_joints_that_move_are_told(case: str, seed: int) -> None:
    make, put, task, moving, relation = CASES[case]
    rng = np.random.default_rng(seed)
    arm = make(rng)
    q = put(arm, 0.5 * arm.configurations(1, seed)[0])
    answer = answered(arm, q, task)
    assert (moving, relation) in told(arm, q, answer, task)
    assert len(answer.qs) >= 5


@pytest.mark.quick(9)
@pytest.mark.parametrize("name", [name for name in CLASSES if not name.startswith(("spherical shoulder", "the same"))])
def test_regular_targets_have_no_family(name: str) -> None:
    kind = CLASSES[name]
    arm = kind.arm(3)
    for q in arm.configurations(3, 3):
        assert not answered(arm, q, kind.task).families


@pytest.mark.slow
def test_a_singularity_from_which_nothing_goes_on_is_no_family() -> None:
    """Arms stretched out: the Jacobian is singular, and there is no second solution."""
    for lengths in ((0.4, 0.3), (0.4, 0.3, 0.2)):
        arm = Arm([link(a) for a in lengths], "R" * len(lengths))
        assert not answered(arm, np.array([0.3, 0.0, 0.0])[: len(lengths)], PLANAR).families
    for seed in range(4):
        arm = CLASSES["anthropomorphic with a wrist"].arm(seed)
        q = 0.5 * arm.configurations(1, seed)[0]
        q[2], q[4] = QUARTER, 0.7
        assert not answered(arm, q).families


def test_beside_a_singular_wrist_there_is_no_family() -> None:
    arm = CLASSES["anthropomorphic with a wrist"].arm(1)
    for apart in (1e-2, 1e-4, 1e-6, 1e-7):
        q = np.array([0.3, -0.4, 1.2, 0.5, apart, 0.2])
        assert not answered(arm, q).families, apart


def test_a_stretched_arm_with_a_straight_wrist_moves_its_wrist_alone() -> None:
    """One of the two directions that are lost is a motion, the other is not."""
    arm = CLASSES["anthropomorphic with a wrist"].arm(1)
    q = np.array([0.3, -0.4, QUARTER, 0.5, 0.0, 0.2])
    answer = answered(arm, q)
    assert {joints for joints, _ in told(arm, q, answer, FULL_POSE)} <= {"4 6"}
