"""Closed forms: every branch of every class, nothing missing, named, near singularities and at them.

Poses of branches come from Pinocchio, arms from random tables; what is missing is told by a search in NumPy that knows
nothing of geometry. To look at more targets, call `assert_nothing_missing` with more of them.
"""

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
from scipy.optimize import brentq

from gelenk.errors import InvalidField
from gelenk.ik.closed.branch_kernels import BranchTable
from gelenk.ik.closed.closed_form import ClosedForm, closed_form
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.ik.verdict.branches import all_branches
from gelenk.ik.verdict.result import InverseKinematics
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from tests.ik.arm_classes import CLASSES, FOUR, Arm, ArmClass, Row
from tests.ik.arms import (
    DECOUPLED,
    IRB,
    PLANAR,
    POSITION,
    PUMA,
    Q6,
    UR5,
    angles,
    assert_solved,
    at,
    catalogue_arm,
    contains,
    draw,
    inside,
    limited,
    middle,
    part,
    poses,
    problem,
    same_turn,
)
from tests.oracles import catalogue
from tests.oracles.many_starts import solutions
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name

CONFIGURATIONS = 2000
MEMBERS = 4
"""Random arms of each class, which share the configurations among them."""
EXACT = 1e-10
SCARA: list[Row] = [
    (0.325, 0.0, 0.387, 0.0),
    (0.275, np.pi, 0.0, 0.0),
    (0.0, 0.0, 0.0, 0.0),
    (0.0, 0.0, 0.05, 0.0),
]
ANTHROPOMORPHIC: list[Row] = [(0.0, np.pi / 2, 0.0, 0.0), (0.5, 0.0, 0.0, 0.0), (0.4, 0.0, 0.0, 0.0)]
WRIST: list[Row] = [(0.0, -np.pi / 2, 0.0, 0.0), (0.0, np.pi / 2, 0.0, 0.0), (0.0, 0.0, 0.1, 0.0)]
STANFORD: list[Row] = [
    (0.0, -np.pi / 2, 0.412, 0.0),
    (0.0, np.pi / 2, 0.154, 0.0),
    (0.0203, 0.0, 0.0, -np.pi / 2),
    (0.0, -np.pi / 2, 0.0, 0.0),
    (0.0, np.pi / 2, 0.0, 0.0),
    (0.0, 0.0, 0.263, 0.0),
]
LIMBS = ["ur3", "ur5", "ur10", "ur5_gripper", "z1", "b1_z1", "kinova", "anymal_b_kinova", "puma560", "stanford",
         "talos_left_arm", "centauro", "anthropomorphic_wrist", "so100", "so101", "scara", "hyq", "go2", "solo12",
         "bolt", "allegro_left_hand"]  # fmt: skip


def form_of(chain: Chain, task: Task = FULL_POSE) -> ClosedForm:
    """The closed form, which there must be."""
    form = closed_form(chain, task)
    assert form is not None
    return form


def branches(form: ClosedForm, targets: Poses, seed: Array | float = 0.1, elbows: Array | None = None) -> BranchTable:
    """All branches, limits aside."""
    seeds = np.zeros((1, len(form.chain))) + seed
    return form.solve(targets, seeds, respect_limits=False, elbow_angles=elbows)


def own(table: BranchTable, i: int) -> Array:
    """The branches of one target."""
    return table.qs[table.firsts[i] : table.firsts[i + 1]]


def all_of(
    machine: RobotModel, chain: Chain, targets: Poses, seed: Array | float = 0.0, **options: object
) -> InverseKinematics:
    """Every solution by closed form alone, through the front door."""
    seeds = np.zeros((1, len(chain))) + seed
    asked = replace(Options(method="analytic", every=True), **options)  # type: ignore[arg-type]
    return inverse_kinematics(machine, chain, targets, seeds, asked)


def of(answer: InverseKinematics, i: int = 0) -> Array:
    return answer.qs[answer.firsts[i] : answer.firsts[i + 1]]


def misses(task: Task, targets: Poses, reached: Poses) -> Array:
    """Distances [m] and angles [rad] of what counts; shape (N,)."""
    counts = np.array([direction in task.directions for direction in "xyz"])
    far = np.asarray(np.linalg.norm((targets.positions - reached.positions)[:, counts], axis=1))
    turned = angles(targets, reached) if len(task.directions) > counts.sum() else np.zeros(len(far))
    return np.asarray(np.maximum(far, turned))


def pose_errors(arm: Arm, task: Task, targets: Poses, table: BranchTable) -> Array:
    """Of every branch, through Pinocchio."""
    owners = np.repeat(np.arange(len(targets.positions)), np.diff(table.firsts))
    return misses(task, part(targets, owners), poses(arm.robot, arm.chain, table.qs))


def found_again(arm: Arm, table: BranchTable, qs: Array) -> Array:
    """How far each configuration is from the nearest branch of its own pose; shape (N,)."""
    return np.array(
        [np.abs(arm.differences(own(table, i), q)).max(axis=1).min(initial=np.inf) for i, q in enumerate(qs)]
    )


def are_distinct(arm: Arm, qs: Array) -> bool:
    return all(np.abs(arm.differences(qs[:i], q)).max(axis=1).min(initial=np.inf) > 1e-7 for i, q in enumerate(qs))


# Every branch, and the configuration that a target was made of.


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", CLASSES)
def test_the_generating_configuration_is_among_the_branches(name: str) -> None:
    kind = CLASSES[name]
    for seed in range(MEMBERS):
        arm = kind.arm(seed)
        form = form_of(arm.chain, kind.task)
        qs = arm.configurations(CONFIGURATIONS // MEMBERS, seed)
        targets = poses(arm.robot, arm.chain, qs)
        table = branches(form, targets, elbows=form.elbow_angles(qs) if form.has_free_elbow else None)
        again = found_again(arm, table, qs)
        assert again.max() < 1e-7, (seed, qs[again.argmax()])
        assert pose_errors(arm, kind.task, targets, table).max() <= EXACT
        assert np.diff(table.firsts).max() <= kind.most
        assert not table.free.any()
        assert all(are_distinct(arm, own(table, i)) for i in range(0, len(qs), 20))


def assert_nothing_missing(arm: Arm, kind: ArmClass, seed: int, targets: int, starts: int) -> int:
    """Compare with a search from many starts; the number of solutions that it found."""
    form = form_of(arm.chain, kind.task)
    wanted = poses(arm.robot, arm.chain, arm.configurations(targets, 100 + seed))
    table = branches(form, wanted)
    count = 0
    for i, T in enumerate(wanted.matrices()):
        expected = solutions(arm.table, T, None, starts, seed=i)
        for q in expected:
            apart = np.abs(arm.differences(own(table, i), q)).max(axis=1).min(initial=np.inf)
            assert apart < 1e-4, (seed, i, q, own(table, i))
        count += len(expected)
    return count


STANDARD_FULL = [
    name
    for name, kind in CLASSES.items()
    if kind.convention == "standard" and kind.task is FULL_POSE and len(kind.types) < 7
]


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", STANDARD_FULL)
def test_nothing_is_missing_that_a_search_from_many_starts_finds(name: str) -> None:
    arm = CLASSES[name].arm(0)
    assert assert_nothing_missing(arm, CLASSES[name], seed=0, targets=2, starts=256) >= 2


@pytest.mark.parametrize("name", ["planar 2R", "planar 3R", "scara", "anthropomorphic", "cylindrical", "spherical arm"])
def test_of_an_arm_that_positions_nothing_is_missing(name: str) -> None:
    kind = CLASSES[name]
    arm = kind.arm(5)
    qs = arm.configurations(200, 5)
    targets = poses(arm.robot, arm.chain, qs)
    counts = np.diff(branches(form_of(arm.chain, kind.task), targets).firsts)
    # Cosines decide: in reach in every way there are as many solutions as roots.
    assert (counts == kind.most).mean() > (0.99 if name != "anthropomorphic" else 0.4)
    assert counts.min() >= 1


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", LIMBS)
def test_arms_of_the_catalogue(name: str) -> None:
    machine, chain = catalogue_arm(name)
    form = form_of(chain)
    qs = draw(chain, 200)
    targets = poses(machine, chain, qs)
    # With fewer than six joints a pose near another one is no solution, whatever the tolerance.
    answer = all_of(machine, chain, targets, position_tolerance=EXACT, orientation_tolerance=EXACT)
    assert_solved(machine, chain, targets, answer, far=EXACT)
    assert answer.closed_form == form.name
    assert answer.complete is not None
    for i, complete in enumerate(answer.complete):
        # Not sure to be all next to a singularity alone, and then a search may add to them.
        sizes = np.linalg.svd(jacobians(machine, chain, of(answer, i)).values, compute_uv=False)[:, -1]
        assert complete or sizes.min() < max(form.doubt, 1e-3)
        codes = answer.codes[answer.firsts[i] : answer.firsts[i + 1]]
        assert (codes >= 0).all() or not complete
    turning = chain.flat.joints[:, 0] == 0
    for i, q in enumerate(qs):
        apart = np.abs(np.where(turning, same_turn(of(answer, i) - q), of(answer, i) - q)).max(axis=1)
        assert apart.min() < 1e-7
    for i in range(2):
        searched = all_branches(problem(chain, targets, np.zeros((1, len(chain)))), i)
        for q in searched.qs:
            assert contains(of(answer, i), q, close=1e-4)


@pytest.mark.parametrize("name", [name for name in LIMBS if name in catalogue.URDFS])
def test_branches_of_a_urdf_by_the_product_of_its_transforms(name: str) -> None:
    machine, chain = catalogue_arm(name)
    targets = poses(machine, chain, draw(chain, 20, seed=3))
    answer = all_of(machine, chain, targets)
    owners = np.repeat(np.arange(20), np.diff(answer.firsts))
    transforms = UrdfProduct(catalogue.urdf_text(name)).poses(
        chain.base_frame, chain.tip_frame, by_name(chain, answer.qs)
    )
    assert np.abs(transforms - targets.matrices()[owners]).max() < EXACT


@pytest.mark.parametrize("name", ["panda", "xarm7", "tiago", "pr2", "baxter", "talos", "panda_dh"])
def test_what_has_no_closed_form_is_refused(name: str) -> None:
    machine, chain = catalogue_arm(name)
    assert closed_form(chain) is None
    with pytest.raises(InvalidField, match="closed form"):
        all_of(machine, chain, poses(machine, chain, middle(chain)))


# The course's examples, digit for digit.


def assert_these(found: Array, expected: list[list[float]], close: float = 1e-11) -> None:
    """The same configurations in any order, and no others."""
    assert len(found) == len(expected)
    for q in expected:
        assert contains(found, q, close=close), (q, found)


def test_two_links_by_the_law_of_cosines() -> None:
    arm = Arm([(1.0, 0.0, 0.0, 0.0), (0.7, 0.0, 0.0, 0.0)], "RR")
    answer = all_of(arm.robot, arm.chain, at(0.9, 0.8), task=PLANAR)
    assert_these(of(answer), [[0.106585970938, 1.599371644064], [1.346698710425, -1.599371644064]])
    assert answer.position_errors.max() < 1e-15
    assert answer.complete == [True]


def test_a_triangle_by_the_law_of_cosines() -> None:
    # a = 3, b = 4, γ = 60°: two links of 3 and 4 over a distance c enclose γ, so joint 2 turns by π - γ.
    arm = Arm([(3.0, 0.0, 0.0, 0.0), (4.0, 0.0, 0.0, 0.0)], "RR")
    answer = all_of(arm.robot, arm.chain, at(3.605551275464, 0.0), task=PLANAR)
    # The angle between link 1 and the line is opposite to link 2: β.
    beta = np.radians(73.897886248)
    assert_these(of(answer), [[-beta, 2.0 * np.pi / 3.0], [beta, -2.0 * np.pi / 3.0]], close=2e-11)


def test_two_links_stretched_folded_and_beyond() -> None:
    arm = Arm([(1.0, 0.0, 0.0, 0.0), (0.7, 0.0, 0.0, 0.0)], "RR")
    for target, expected in ((at(1.7, 0.0), [0.0, 0.0]), (at(-0.3, 0.0), [np.pi, np.pi])):
        answer = all_of(arm.robot, arm.chain, target, task=PLANAR)
        assert_these(of(answer), [expected], close=1e-7)
    for target in (at(1.8, 0.0), at(0.1, 0.1)):
        answer = all_of(arm.robot, arm.chain, target, task=PLANAR)
        assert answer.statuses == ["unreachable"]
        assert len(answer.qs) == 0


def test_equal_links_that_meet_the_base_leave_joint_1_free() -> None:
    arm = Arm([(0.5, 0.0, 0.0, 0.0), (0.5, 0.0, 0.0, 0.0)], "RR")
    form = form_of(arm.chain, PLANAR)
    table = branches(form, at(0.0, 0.0), np.array([[0.7, 0.2]]))
    assert len(table.qs) == 1
    np.testing.assert_allclose(table.qs[0], [0.7, np.pi], atol=1e-7)
    assert form.free_joints(int(table.free[0])) == ["joint_1"]


def test_scara() -> None:
    arm = Arm(SCARA, "RRPR")
    target = poses(arm.robot, arm.chain, np.array([[0.4, 0.8, 0.12, -0.3]]))
    np.testing.assert_allclose(target.positions[0], [0.398993205532, 0.382871709891, 0.217], atol=1e-12)
    for task in (FULL_POSE, FOUR):
        answer = all_of(arm.robot, arm.chain, target, task=task)
        assert_these(of(answer), [[0.4, 0.8, 0.12, -0.3], [1.129563599263, -0.8, 0.12, -1.170436400737]])


def test_the_position_of_the_anthropomorphic_arm() -> None:
    arm = Arm(ANTHROPOMORPHIC, "RRR")
    answer = all_of(arm.robot, arm.chain, at(0.768753959783, 0.237803466792, 0.202853504379), task=POSITION)
    expected = [
        [0.3, -0.106114973898, 0.8],
        [0.3, 0.6, -0.8],
        [-2.841592653590, 2.541592653590, 0.8],
        [-2.841592653590, -3.035477679692, -0.8],
    ]
    assert_these(of(answer), expected, close=5e-12)


def test_above_its_base_joint_1_of_the_anthropomorphic_arm_is_free() -> None:
    arm = Arm(ANTHROPOMORPHIC, "RRR")
    form = form_of(arm.chain, POSITION)
    table = branches(form, at(0.0, 0.0, 0.6), np.array([[1.1, 0.0, 0.0]]))
    assert len(table.qs) >= 2
    np.testing.assert_allclose(table.qs[:, 0], 1.1, atol=1e-9)
    assert {tuple(form.free_joints(int(mask))) for mask in table.free} == {("joint_1",)}


def test_decoupling() -> None:
    arm = Arm(DECOUPLED, "RRRRRR")
    target = poses(arm.robot, arm.chain, Q6[None])
    np.testing.assert_allclose(target.positions[0], [0.843884090787, 0.244754073854, 0.532667280031], atol=1e-12)
    p_w = target.positions[0] - 0.1 * target.rotations[0, :, 2]
    np.testing.assert_allclose(p_w, [0.762445531919, 0.235852041375, 0.475321705248], atol=1e-12)
    answer = all_of(arm.robot, arm.chain, target)
    assert len(answer.qs) == 8
    assert contains(answer.qs, Q6, close=1e-13)
    assert np.maximum(answer.position_errors, answer.orientation_errors).max() < 1.3e-15
    for q in answer.qs:
        np.testing.assert_allclose(arm.table.frames(q)[4][:3, 3], p_w, atol=1e-14)


def test_the_spherical_wrist_alone() -> None:
    arm = Arm(WRIST, "RRR")
    target = poses(arm.robot, arm.chain, np.array([[0.2, 0.9, -0.5]]))
    np.testing.assert_allclose(target.positions[0], [0.076771252365, 0.015562303293, 0.062160996827], atol=1e-12)
    answer = all_of(arm.robot, arm.chain, target)
    assert_these(of(answer), [[0.2, 0.9, -0.5], [-2.941592653590, -0.9, 2.641592653590]])


@pytest.mark.parametrize(("middle_joint", "sum_or_difference"), [(0.0, 0.9), (np.pi, -0.1)])
def test_where_the_wrist_is_straight_only_a_sum_of_angles_counts(middle_joint: float, sum_or_difference: float) -> None:
    arm = Arm(WRIST, "RRR")
    form = form_of(arm.chain)
    target = poses(arm.robot, arm.chain, np.array([[0.4, middle_joint, 0.5]]))
    table = branches(form, target, np.array([[-1.3, 0.3, 0.2]]))
    assert len(table.qs) == 1
    q = table.qs[0]
    assert q[0] == -1.3
    assert abs(same_turn(q[1] - middle_joint)) < 1e-9
    assert abs(same_turn(q[0] + np.cos(middle_joint) * q[2] - sum_or_difference)) < 1e-9
    assert form.free_joints(int(table.free[0])) == ["joint_1"]


def test_the_stanford_arm() -> None:
    arm = Arm(STANFORD, "RRPRRR")
    q = np.array([0.2, 0.5, 0.6, -0.3, 0.7, 0.1])
    target = poses(arm.robot, arm.chain, q[None])
    np.testing.assert_allclose(target.positions[0], [0.338967591045, 0.039977404438, 1.139083062081], atol=1e-12)
    answer = all_of(arm.robot, arm.chain, target)
    assert contains(answer.qs, q, close=1e-12)
    assert sorted(np.round(answer.qs[:, 2], 9).tolist()) == [-0.6] * 4 + [0.6] * 4


def test_three_parallel_axes() -> None:
    arm = Arm(UR5, "RRRRRR")
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    answer = all_of(arm.robot, arm.chain, poses(arm.robot, arm.chain, q[None]))
    assert len(answer.qs) == 8
    assert contains(answer.qs, q, close=1e-12)
    # Heights along the parallel axes tell joint 5 up to its sign, for each of two joints 1.
    assert len(np.unique(np.round(np.cos(answer.qs[:, 4]), 9))) == 2
    assert len(np.unique(np.round(same_turn(answer.qs[:, 0]), 9))) == 2


# Names of branches.

NAMED: dict[str, tuple[list[Row], str]] = {
    "puma": (PUMA, "RRRRRR"),
    "irb": (IRB, "RRRRRR"),
    "decoupled": (DECOUPLED, "RRRRRR"),
    "ur5": (UR5, "RRRRRR"),
    "stanford": (STANFORD, "RRPRRR"),
}


def names(form: ClosedForm, table: BranchTable) -> list[tuple[tuple[str, str | int], ...]]:
    return [tuple(sorted(form.branch(int(code)).items())) for code in table.codes]


@pytest.mark.quick(5)
@pytest.mark.parametrize("name", CLASSES)
def test_no_two_branches_of_a_target_have_the_same_name(name: str) -> None:
    kind = CLASSES[name]
    arm = kind.arm(1)
    form = form_of(arm.chain, kind.task)
    qs = arm.configurations(100, 9)
    table = branches(form, poses(arm.robot, arm.chain, qs))
    for i in range(100):
        named = names(form, table)[table.firsts[i] : table.firsts[i + 1]]
        assert len(set(named)) == len(named)
        for choices in named:
            for choice, taken in choices:
                assert taken in {"shoulder": ("front", "back"), "elbow": ("up", "down"), "wrist": ("flip", "no_flip"),
                                 "arm": tuple(range(1, 9))}[choice]  # fmt: skip


@pytest.mark.parametrize("name", ["puma", "irb", "decoupled", "ur5"])
def test_eight_branches_have_the_eight_names(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    qs = arm.configurations(50, 4)
    table = branches(form, poses(arm.robot, arm.chain, qs))
    every = {
        (("elbow", elbow), ("shoulder", shoulder), ("wrist", wrist))
        for elbow in ("up", "down")
        for shoulder in ("front", "back")
        for wrist in ("flip", "no_flip")
    }
    seen = 0
    for i in np.flatnonzero(np.diff(table.firsts) == 8):
        assert set(names(form, table)[table.firsts[i] : table.firsts[i + 1]]) == every
        seen += 1
    assert seen >= 10


def names_of(form: ClosedForm, arm: Arm, qs: Array) -> set[tuple[tuple[str, str | int], ...]]:
    """What the branches are called that configurations lie on."""
    table = branches(form, poses(arm.robot, arm.chain, qs), qs[0])
    called = names(form, table)
    found = set()
    for i, q in enumerate(qs):
        apart = np.abs(arm.differences(own(table, i), q)).max(axis=1)
        assert apart.min() < 1e-7
        found.add(called[table.firsts[i] + int(apart.argmin())])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMED)
def test_a_name_stays_the_same_along_a_path_without_singularity(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    kept, changed = 0, 0
    for first, second in pairwise(arm.configurations(60, 7)):
        path = np.linspace(first, first + 0.25 * (second - first), 60)
        determinants = np.array([np.linalg.det(arm.table.jacobian(q)) for q in path])
        called = names_of(form, arm, path[::5])
        if (np.abs(determinants) > 1e-5).all() and len(set(np.sign(determinants))) == 1:
            assert len(called) == 1, (first, path[-1], called)
            kept += 1
        else:
            changed += len(called) > 1
    assert kept >= 5
    assert changed >= 5


def in_front_of_axis_2(arm: Arm, q: Array) -> bool:
    """Whether the wrist's point is further from axis 1 than axis 2 is."""
    frames = arm.table.frames(q)
    return bool(np.linalg.norm(frames[4][:2, 3]) > np.linalg.norm(frames[1][:2, 3]))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["puma", "irb", "decoupled"])
def test_the_elbow_that_is_up_is_higher(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    table = branches(form, poses(arm.robot, arm.chain, arm.configurations(200, 8)))
    compared = 0
    for i in range(200):
        rows = range(table.firsts[i], table.firsts[i + 1])
        if name == "irb" and not in_front_of_axis_2(arm, table.qs[rows[0]]):
            continue
        heights = {
            tuple(sorted(form.branch(int(table.codes[k])).items())): arm.table.frames(table.qs[k])[2][2, 3]
            for k in rows
        }
        for shoulder in ("front", "back"):
            pair = [(("elbow", elbow), ("shoulder", shoulder), ("wrist", "flip")) for elbow in ("up", "down")]
            if all(key in heights for key in pair):
                assert heights[pair[0]] > heights[pair[1]]
                compared += 1
    assert compared > 100


@pytest.mark.parametrize("name", ["puma", "irb", "decoupled", "stanford", "ur5"])
def test_the_wrist_flips_where_joint_5_is_negative(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    table = branches(form, poses(arm.robot, arm.chain, arm.configurations(100, 9)))
    for q, code in zip(table.qs, table.codes, strict=True):
        assert form.branch(int(code))["wrist"] == ("no_flip" if np.sin(q[4]) > 0.0 else "flip")


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["puma", "decoupled", "irb"])
def test_in_front_the_first_joint_turns_towards_the_wrist(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    table = branches(form, poses(arm.robot, arm.chain, arm.configurations(200, 10)))
    # The side of the plane of axes 1 and 2 on which the wrist's point lies is one at the front and another at the back.
    sides: dict[str, list[float]] = {"front": [], "back": []}
    for q, code in zip(table.qs, table.codes, strict=True):
        frames = arm.table.frames(q)
        outwards = frames[1][:3, 3] * 0.0 + np.cross(frames[1][:3, 2], [0.0, 0.0, 1.0])
        sides[str(form.branch(int(code))["shoulder"])].append(float(np.sign(outwards @ frames[4][:3, 3])))
    assert {len(set(signs)) for signs in sides.values()} == {1}
    assert sides["front"][0] == -sides["back"][0]


# Near singularities and at them.


def root_of(level: Callable[[float], float], first: float, last: float) -> float:
    """The first angle between two at which a function changes its sign."""
    grid = np.linspace(first, last, 61)
    values = np.array([level(float(x)) for x in grid])
    k = int(np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))[0])
    return float(brentq(level, grid[k], grid[k + 1], xtol=1e-15))


SINGULAR = ("wrist", "elbow", "shoulder", "wrist and elbow", "wrist and shoulder")
DELTAS = (1e-3, 1e-6, 1e-9, 0.0)
COUPLED = {"decoupled": (0, 3, 4, 5), "puma": (0, 3, 4, 5), "ur5": (0, 1, 2, 3, 5)}
"""Joints that a singularity couples, or that depend on what these are."""


def near_singular(name: str, where: str, delta: float) -> Array:
    """A configuration so far from a singularity, [rad]: straight wrist, stretched elbow, wrist's point over axis 1."""
    q4, q5 = 0.2, delta if "wrist" in where else 0.9
    if name == "decoupled":
        q3 = np.pi / 2.0 + delta if "elbow" in where else 0.7
        q2 = 0.6
        if "shoulder" in where:
            q2 = delta + root_of(lambda x: float(0.5 * np.cos(x) + 0.4 * np.sin(x + q3)), 0.3, 3.0)
    elif name == "puma":
        q3 = np.arctan2(-0.4318, 0.0203) + delta if "elbow" in where else 0.9
        q2 = 0.4
        if "shoulder" in where:
            # As near to axis 1 as the offset of the shoulder allows.
            q2 = delta + root_of(
                lambda x: float(0.4318 * np.cos(x) + 0.0203 * np.cos(x + q3) - 0.4318 * np.sin(x + q3)), -3.0, 3.0
            )
    else:
        q2, q3, q4 = -1.4, delta if "elbow" in where else -0.3, -0.7
        if "shoulder" in where:
            # The point where axes 5 and 6 meet is in the plane of axes 1 and 2.
            a, b, d = -0.425 * np.cos(q2), -0.39225 * np.cos(q2 + q3), 0.09465
            q4 = delta + root_of(lambda x: float(a + b + d * np.sin(q2 + q3 + x)), -1.5 - q2 - q3, 1.5 - q2 - q3)
    return np.array([0.3, q2, q3, q4, q5, -0.5])


def roots_meet(name: str, where: str) -> bool:
    """Whether two branches become one there; elsewhere they stay half a turn apart in some joint."""
    return "elbow" in where or ("shoulder" in where and name != "decoupled")


@pytest.mark.quick(22)
@pytest.mark.parametrize("delta", DELTAS)
@pytest.mark.parametrize("where", SINGULAR)
@pytest.mark.parametrize("name", ["decoupled", "puma", "ur5"])
def test_near_a_singularity_the_configuration_is_found_again(name: str, where: str, delta: float) -> None:
    arm = Arm(*NAMED[name])
    q = near_singular(name, where, delta)
    sigma = float(np.linalg.svd(arm.table.jacobian(q), compute_uv=False)[-1])
    assert sigma <= max(delta, 1e-15)
    form = form_of(arm.chain)
    targets = poses(arm.robot, arm.chain, q[None])
    # The seed settles what is free.
    table = branches(form, targets, q)
    assert pose_errors(arm, FULL_POSE, targets, table).max() <= EXACT
    apart = np.abs(arm.differences(table.qs, q)).max(axis=1).min()
    # A rounding of the pose over the least singular value; where two roots meet no more than a rounding's square root.
    allowed = 5e-15 / max(sigma, 1e-300)
    if "and" not in where and (delta == 0.0 or roots_meet(name, where)):
        allowed = min(allowed, 2e-7)
    assert apart <= allowed, (apart, sigma, table.qs)


@pytest.mark.quick(11)
@pytest.mark.parametrize("delta", DELTAS)
@pytest.mark.parametrize("where", SINGULAR)
@pytest.mark.parametrize("name", ["decoupled", "puma", "ur5"])
def test_near_a_singularity_no_branch_is_lost(name: str, where: str, delta: float) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    regular = near_singular(name, where, 1e-2)
    expected = branches(form, poses(arm.robot, arm.chain, regular[None])).qs
    q = near_singular(name, where, delta)
    table = branches(form, poses(arm.robot, arm.chain, q[None]), q)
    if delta > 1e-7 or (delta > 0.0 and not roots_meet(name, where)):
        assert len(table.qs) == len(expected)
    if delta > 0.0:
        assert not table.free.any()
    rigid = np.array([j not in COUPLED[name] for j in range(6)])
    for other in expected:
        # Each leads on from one at a hundredth of a radian.
        assert np.abs(arm.differences(table.qs, other))[:, rigid].max(axis=1).min() < 0.2, (other, table.qs)


@pytest.mark.parametrize("delta", [1e-6, 1e-7, 3e-8, 1e-8, 3e-9, 1e-9])
def test_closer_and_closer_to_axis_1_nothing_is_lost(delta: float) -> None:
    arm = Arm(DECOUPLED, "RRRRRR")
    form = form_of(arm.chain)
    for seed in range(20):
        q = np.random.default_rng(seed).uniform(-2.5, 2.5, 6)
        q[1] = delta + root_of(lambda x, q3=q[2]: float(0.5 * np.cos(x) + 0.4 * np.sin(x + q3)), -3.0, 3.0)  # type: ignore[misc]
        targets = poses(arm.robot, arm.chain, q[None])
        table = branches(form, targets)
        assert len(table.qs) == 8, seed
        assert pose_errors(arm, FULL_POSE, targets, table).max() <= EXACT
        sigma = float(np.linalg.svd(arm.table.jacobian(q), compute_uv=False)[-1])
        assert found_again(arm, table, q[None])[0] <= 1e-14 / sigma


@pytest.mark.slow
def test_an_arm_that_folds_its_wrist_onto_axis_2() -> None:
    """Both its links are of one length, so that where it folds two singularities come together."""
    parameters: list[Row] = [
        (0.3, np.pi / 2, 0.2, np.pi / 2),
        (0.25, np.pi / 2, 0.0, 0.0),
        (0.25, 0.0, 0.0, np.pi / 2),
        (0.0, -np.pi / 2, 0.0, 0.0),
        (0.0, -np.pi / 2, 0.0, 0.0),
        (0.4, 0.0, 0.0, 0.0),
    ]
    arm = Arm(parameters, "RRRRRR")
    form = form_of(arm.chain)
    qs = arm.configurations(2000, 24)
    qs[:200, 2] = np.pi / 2 + np.random.default_rng(25).uniform(-5e-3, 5e-3, 200)
    targets = poses(arm.robot, arm.chain, qs)
    table = branches(form, targets)
    sigmas = np.array([np.linalg.svd(arm.table.jacobian(q), compute_uv=False)[-1] for q in qs])
    # Where both are within 1e-4 two directions are weak at once, and polishing may stop short of the last digits.
    assert pose_errors(arm, FULL_POSE, targets, table).max() <= 1e-9
    again = found_again(arm, table, qs)
    regular = sigmas > 1e-6
    assert (again[regular] <= 1e-14 / sigmas[regular] + 1e-7).all(), again[regular].max()


@pytest.mark.parametrize("delta", [1e-3, 1e-6, 1e-7, 1e-8, 1e-9])
def test_an_arm_whose_stretched_elbow_lines_two_axes_up(delta: float) -> None:
    """There shoulder and forearm turn against each other, and a solution is where on that motion the rest fits."""
    machine, chain = catalogue_arm("talos_left_arm")
    qs = np.random.default_rng(3).uniform(-np.pi, np.pi, (100, len(chain)))
    qs[:, chain.joint_names.index("arm_left_4_joint")] = delta
    table = branches(form_of(chain), poses(machine, chain, qs))
    assert set(np.diff(table.firsts).tolist()) == {8}
    again = [np.abs(same_turn(own(table, i) - q)).max(axis=1).min() for i, q in enumerate(qs)]
    # As good as the pose allows, which is known to rounding: along that motion it changes by less than δ².
    assert max(again) <= 2e-13 / delta**1.5


LEG = ("RIGHT_HIP_Z", "RIGHT_KNEE_Y")


@pytest.mark.slow
@pytest.mark.parametrize("delta", [1e-7, 1e-3, 1e-6, 1e-8, 1e-9])
def test_a_leg_whose_first_axis_lines_up_with_three_others(delta: float) -> None:
    """Four parallel axes move freely, and the quartic of it has a double root, known to half the digits."""
    machine, chain = catalogue_arm("alexander")
    qs = np.random.default_rng(3).uniform(-np.pi, np.pi, (60, len(chain)))
    qs[:, chain.joint_names.index(LEG[0])] = 0.5 * np.pi + delta
    assert_none_lost(machine, chain, qs)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("bent", "delta"),
    [
        # Closer still rounding leaves nothing of the least singular value: all of a motion is a solution.
        *product(["as little"], [1e-3, 1e-5, 1e-6]),
        *product(["a little more"], [1e-3, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]),
    ],
)
def test_such_a_leg_with_its_knee_nearly_straight(bent: str, delta: float) -> None:
    machine, chain = catalogue_arm("alexander")
    rng = np.random.default_rng(4)
    qs = rng.uniform(-np.pi, np.pi, (40, len(chain)))
    qs[:, chain.joint_names.index(LEG[0])] = 0.5 * np.pi + delta
    knees = delta if bent == "as little" else 10.0 ** rng.uniform(-3.0, -1.0, len(qs))
    qs[:, chain.joint_names.index(LEG[1])] = knees * rng.choice([-1.0, 1.0], len(qs))
    assert_none_lost(machine, chain, qs)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "where", "delta"),
    [
        *product(["decoupled", "puma", "ur5"], ["wrist and elbow", "wrist and shoulder"], [1e-3, 1e-4, 1e-5, 1e-6]),
        *product(["decoupled", "puma"], ["elbow and shoulder"], [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]),
    ],
)
def test_near_two_singularities_at_once_none_is_lost(name: str, where: str, delta: float) -> None:
    arm = Arm(*NAMED[name])
    qs = np.tile(near_singular(name, where, delta), (4, 1))
    qs[:, [0, 5]] = np.random.default_rng(5).uniform(-np.pi, np.pi, (4, 2))
    assert_none_lost(arm.robot, arm.chain, qs)


def assert_none_lost(machine: RobotModel, chain: Chain, qs: Array) -> None:
    """Each is among the solutions of its pose, as well as the pose tells it, and what is said to be all is all."""
    targets = poses(machine, chain, qs)
    answer = all_of(machine, chain, targets, respect_limits=False)
    sigmas = np.linalg.svd(jacobians(machine, chain, qs).values, compute_uv=False)[:, -1]
    again = np.array([np.abs(same_turn(of(answer, i) - q)).max(axis=1).min(initial=np.inf) for i, q in enumerate(qs)])
    # A rounding of the pose over the least singular value.
    lost = again > np.maximum(2e-3, 1e-14 / np.maximum(sigmas, 1e-300))
    assert not lost.any(), (qs[lost], again[lost], sigmas[lost])
    assert not np.array(answer.complete)[again > 2e-3].any()


@pytest.mark.parametrize(
    ("name", "where", "joints"),
    [
        ("decoupled", "wrist", {"joint_4"}),
        ("decoupled", "shoulder", {"joint_1"}),
        # With joint 1 where the seed has it, the wrist is not straight any more.
        ("decoupled", "wrist and shoulder", {"joint_1"}),
        ("puma", "wrist", {"joint_4"}),
        ("ur5", "wrist", {"joint_6"}),
    ],
)
def test_at_a_singularity_the_free_joint_is_named_and_keeps_the_seed(name: str, where: str, joints: set[str]) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    q = near_singular(name, where, 0.0)
    # Joint 6 of the UR5 is free only as far as the others can follow.
    seed = q + (-0.2 if name == "ur5" else 1.0) * np.array([0.7, 0.1, -0.2, 0.9, 0.3, -0.8])
    targets = poses(arm.robot, arm.chain, q[None])
    table = branches(form, targets, seed)
    assert pose_errors(arm, FULL_POSE, targets, table).max() <= EXACT
    named = [set(form.free_joints(int(mask))) for mask in table.free]
    assert joints in named
    for row, free in zip(table.qs, named, strict=True):
        for joint in free:
            j = int(joint[-1]) - 1
            assert abs(row[j] - seed[j]) < 1e-7, (joint, row, seed)
    answer = all_of(arm.robot, arm.chain, targets, seed, respect_limits=False)
    assert answer.complete == [False]


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["decoupled", "puma", "irb", "ur5", "stanford"])
def test_many_targets_near_singularities_of_joint_5(name: str) -> None:
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    for delta in (1e-3, 1e-6, 1e-9):
        qs = arm.configurations(200, 21)
        qs[:, 4] = delta
        targets = poses(arm.robot, arm.chain, qs)
        table = branches(form, targets)
        assert pose_errors(arm, FULL_POSE, targets, table).max() <= EXACT
        sigmas = np.array([np.linalg.svd(arm.table.jacobian(q), compute_uv=False)[-1] for q in qs])
        # As good as the pose allows, which is known to rounding.
        assert (found_again(arm, table, qs) * sigmas).max() <= 5e-15
        assert not table.free.any()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["decoupled", "puma", "irb", "ur5"])
def test_the_search_finds_no_more_at_a_singular_wrist(name: str) -> None:
    """At a straight wrist every arm posture must be there that a search finds, whatever joints 4 and 6 are."""
    arm = Arm(*NAMED[name])
    form = form_of(arm.chain)
    q = np.array([0.4, 0.3, 0.8, 0.5, 0.0, -0.7])
    targets = poses(arm.robot, arm.chain, q[None])
    table = branches(form, targets)
    rigid = slice(0, 3) if name != "ur5" else slice(0, 1)
    searched = solutions(arm.table, targets.matrices()[0], None, starts=256)
    assert len(searched) > 8
    for found in searched:
        apart = np.abs(arm.differences(table.qs, found))[:, rigid].max(axis=1)
        assert apart.min() < 1e-3


def test_a_free_joint_whose_seed_does_not_serve_is_put_elsewhere() -> None:
    """Of the UR5 at a straight wrist joint 6 is free only as far as the other joints can follow."""
    arm = Arm(UR5, "RRRRRR")
    q = near_singular("ur5", "wrist", 0.0)
    targets = poses(arm.robot, arm.chain, q[None])
    for turned in np.linspace(-3.0, 3.0, 13):
        answer = all_of(arm.robot, arm.chain, targets, q + np.array([0.0, 0.0, 0.0, 0.0, 0.0, turned]))
        # There is a continuum of solutions with joint 1 where it is, wherever the seed is.
        assert answer.complete == [False], turned
        assert np.abs(same_turn(of(answer)[:, 0] - q[0])).min() < 1e-6, turned


@pytest.mark.slow
@pytest.mark.parametrize("name", ["RRR and a skew wrist", "RRP and a skew wrist", "RPR and a skew wrist",
                                  "a skew shoulder and RRR", "parallel axes 2 3 4"])  # fmt: skip
def test_near_a_root_that_is_double_both_are_found(name: str) -> None:
    arm = CLASSES[name].arm(2)
    form = form_of(arm.chain)
    near = 0
    for first, second in pairwise(arm.configurations(40, 12)):

        def determinant(x: float, first: Array = first, second: Array = second) -> float:
            return float(np.linalg.det(arm.table.jacobian(first + x * (second - first))))

        grid = np.linspace(0.0, 0.3, 31)
        signs = np.sign([determinant(float(x)) for x in grid])
        for k in np.flatnonzero(signs[1:] != signs[:-1])[:1]:
            x = brentq(determinant, grid[k], grid[k + 1], xtol=1e-15)
            for delta in (1e-3, 1e-5, 1e-6, 0.0):
                q = first + (x + delta) * (second - first)
                targets = poses(arm.robot, arm.chain, q[None])
                table = branches(form, targets)
                assert pose_errors(arm, FULL_POSE, targets, table).max() <= EXACT
                sigma = float(np.linalg.svd(arm.table.jacobian(q), compute_uv=False)[-1])
                assert found_again(arm, table, q[None])[0] <= min(1e-14 / max(sigma, 1e-300), 1e-5), (q, delta)
                near += 1
    assert near >= 20


# Limits, full turns and seeds.


@pytest.mark.slow
def test_limits_and_seeds_choose_among_the_branches() -> None:
    arm = Arm(PUMA, "RRRRRR")
    whole = limited(arm.chain, [-np.inf] * 6, [np.inf] * 6)
    qs = arm.configurations(60, 13)
    targets = poses(arm.robot, whole, qs)
    every = branches(form_of(whole), targets)
    rng = np.random.default_rng(14)
    for i in range(60):
        lower = rng.uniform(-4.0, 0.0, 6)
        chain = limited(arm.chain, lower, lower + rng.uniform(1.0, 9.0, 6))
        seed = rng.uniform(-100.0, 100.0, 6)
        answer = all_of(arm.robot, chain, part(targets, slice(i, i + 1)), seed)
        assert inside(chain, of(answer)).all()
        expected = [q for q in own(every, i) if fits(chain, q)]
        assert len(answer.qs) == len(expected)
        assert all(contains(of(answer), q, close=1e-9) for q in expected)
        far = np.linalg.norm(of(answer) - seed, axis=1)
        assert (np.diff(far) >= -1e-9).all()
        for q in of(answer):
            # No full turn that the limits allow brings a joint nearer to the seed.
            for turns in (-1.0, 1.0):
                moved = q + turns * 2.0 * np.pi
                better = (
                    (np.abs(moved - seed) < np.abs(q - seed) - 1e-9) & (moved >= chain.lower) & (moved <= chain.upper)
                )
                assert not better.any()
        one = inverse_kinematics(
            arm.robot, chain, part(targets, slice(i, i + 1)), seed[None], Options(method="analytic")
        )
        if expected:
            np.testing.assert_allclose(one.qs[0], of(answer)[0], atol=1e-9)
        else:
            assert one.statuses == ["outside_limits"]


def fits(chain: Chain, q: Array) -> bool:
    """Whether full turns bring every joint within the limits."""
    lowest = q + 2.0 * np.pi * np.ceil((chain.lower - q) / (2.0 * np.pi))
    return bool((lowest <= chain.upper).all())


def test_one_sided_limits_and_none() -> None:
    arm = Arm(DECOUPLED, "RRRRRR")
    lower = np.array([-np.inf, 0.0, -np.inf, 5.0, -np.inf, -20.0])
    upper = np.array([np.inf, np.inf, 0.0, np.inf, np.inf, -10.0])
    chain = limited(arm.chain, lower, upper)
    targets = poses(arm.robot, chain, arm.configurations(20, 15))
    for seed in (0.0, 30.0, -30.0):
        answer = all_of(arm.robot, chain, targets, seed)
        assert answer.statuses == ["solved"] * 20
        assert inside(chain, answer.qs).all()
        assert (np.diff(answer.firsts) == 8).sum() > 3


def test_every_full_turn_that_limits_allow() -> None:
    arm = Arm(UR5, "RRRRRR")
    chain = limited(arm.chain, [-2.0 * np.pi] * 6, [2.0 * np.pi] * 6)
    targets = poses(arm.robot, chain, Q6[None])
    plain = all_of(arm.robot, chain, targets)
    turned = all_of(arm.robot, chain, targets, windings=True, most=10_000)
    counts = [(np.abs(same_turn(turned.qs - q)).max(axis=1) < 1e-7).sum() for q in plain.qs]
    assert counts == [64] * len(plain.qs)
    assert len(turned.qs) == 64 * len(plain.qs)
    assert len(np.unique(np.round(turned.qs, 7), axis=0)) == len(turned.qs)
    assert turned.complete == [True]
    few = all_of(arm.robot, chain, targets, windings=True, most=50)
    assert len(few.qs) == 50
    assert few.complete == [False]


def test_a_target_of_the_seed_itself() -> None:
    for parameters, types in NAMED.values():
        arm = Arm(parameters, types)
        qs = arm.configurations(50, 16)
        answer = inverse_kinematics(
            arm.robot, arm.chain, poses(arm.robot, arm.chain, qs), qs, Options(method="analytic", respect_limits=False)
        )
        np.testing.assert_allclose(answer.qs, qs, atol=1e-9)


@pytest.mark.slow
def test_the_rim_of_what_can_be_reached_and_a_little_beyond() -> None:
    arm = Arm(DECOUPLED, "RRRRRR")
    q = near_singular("decoupled", "elbow", 0.0)
    targets = poses(arm.robot, arm.chain, q[None])
    outwards = arm.table.frames(q)[4][:3, 3] - arm.table.frames(q)[1][:3, 3]
    outwards /= np.linalg.norm(outwards)
    for beyond in (0.0, 1e-12, 1e-9, 1e-7):
        moved = Poses(targets.positions + beyond * outwards, targets.rotations)
        answer = all_of(arm.robot, arm.chain, moved)
        assert answer.statuses == ["solved"], beyond
        assert contains(answer.qs, q, close=1e-3)
        # No further than the target is beyond.
        assert answer.position_errors.min() <= beyond + 1e-12
    moved = Poses(targets.positions + 1e-5 * outwards, targets.rotations)
    assert all_of(arm.robot, arm.chain, moved).statuses == ["unreachable"]
    within = Poses(targets.positions - 1e-7 * outwards, targets.rotations)
    answer = all_of(arm.robot, arm.chain, within)
    assert len(answer.qs) == 8
    assert answer.position_errors.max() <= EXACT


# The same arm elsewhere, larger, smaller, and from other frames.


@pytest.mark.quick(1)
@pytest.mark.parametrize("size", [1e-3, 1e-2, 1.0, 10.0, 100.0])
@pytest.mark.parametrize("name", ["puma", "ur5", "stanford", "irb"])
def test_arms_of_a_millimetre_and_of_a_hundred_metres(name: str, size: float) -> None:
    parameters, types = NAMED[name]
    arm = Arm([(size * a, alpha, size * d, theta) for a, alpha, d, theta in parameters], types)
    form = form_of(arm.chain)
    qs = arm.configurations(200, 17)
    qs[:, ~arm.turns] *= size
    targets = poses(arm.robot, arm.chain, qs)
    table = branches(form, targets)
    assert pose_errors(arm, FULL_POSE, targets, table).max() <= max(EXACT, 1e-13 * size)
    expected = Arm(parameters, types)
    same = arm.configurations(200, 17)
    counts = np.diff(branches(form_of(expected.chain), poses(expected.robot, expected.chain, same)).firsts)
    assert found_again(arm, table, qs).max() < 1e-7
    assert (np.diff(table.firsts) == counts).all()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["ur5", "z1", "kinova", "talos_left_arm"])
def test_a_chain_up_the_tree(name: str) -> None:
    machine, down = catalogue_arm(name)
    up = machine.chain(down.tip_frame, down.base_frame)
    form = form_of(up)
    qs = draw(up, 100)
    answer = all_of(machine, up, poses(machine, up, qs))
    assert_solved(machine, up, poses(machine, up, qs), answer, far=EXACT)
    assert all(contains(of(answer, i), q) for i, q in enumerate(qs))
    assert form.name in {"three parallel axes", "spherical wrist", "spherical shoulder"}
    assert np.diff(answer.firsts).max() >= 2


def test_a_base_and_a_tool_and_frames_beyond_the_last_joint() -> None:
    plain, chain = catalogue_arm("ur5")
    frames = ["wrist_3_link", "ee_link", "tool0"]
    qs = draw(chain, 50)
    counts = []
    for frame in frames:
        other = plain.chain(None, frame)
        targets = poses(plain, other, qs)
        answer = all_of(plain, other, targets)
        assert_solved(plain, other, targets, answer, far=EXACT)
        assert all(contains(of(answer, i), q) for i, q in enumerate(qs))
        counts.append(np.diff(answer.firsts).tolist())
    assert all(count == counts[0] for count in counts)


SMALL: dict[str, tuple[list[Row], str]] = {
    "three turns, the tip on the last axis": (
        [(0.0, np.pi / 2, 0.2, 0.0), (0.0, -np.pi / 2, 0.2, 0.0), (0.0, -np.pi / 2, 0.0, 0.0)],
        "RRR",
    ),
    "two parallel turns and a skew one": ([(0.3, 0.0, 0.0, 0.0), (0.0, 0.3, 0.2, 0.0), (0.13, 0.0, 0.0, 0.0)], "RRR"),
    "two turns, the tip on the last axis": ([(0.4, 0.0, 0.0, 0.0), (0.0, -np.pi / 2, 0.2, np.pi / 2)], "RR"),
    "a slide and a turn": ([(0.15, -np.pi / 2, 0.0, 1.1), (0.0, np.pi / 2, 0.2, 0.0)], "PR"),
    "four turns": (
        [
            (0.3, np.pi / 2, 0.0, 0.0),
            (0.0, -np.pi / 2, 0.36, 0.0),
            (0.0, np.pi / 2, 0.0, 0.0),
            (0.0, -np.pi / 2, 0.0, 0.0),
        ],
        "RRRR",
    ),
    "four turns of which the last three meet": (
        [
            (0.0, -np.pi / 2, -0.39, 0.0),
            (0.0, -np.pi / 2, 0.4, 0.0),
            (0.0, -1.88, 0.0, 0.0),
            (0.02, np.pi / 2, 0.0, 0.0),
        ],
        "RRRR",
    ),
    "a slide and three turns": (
        [(0.1, 2.05, 0.0, 0.0), (0.0, 2.08, 0.2, -2.57), (0.0, -2.68, 0.0, 0.0), (0.3, np.pi / 2, 0.0, 0.2)],
        "PRRR",
    ),
    "three turns and a slide": (
        [(0.0, -np.pi / 2, 0.0, 0.0), (0.0, -2.03, 0.0, -2.29), (0.3, -np.pi / 2, 0.15, 0.0), (0.3, 0.0, 0.2, 1.64)],
        "RRRP",
    ),
}


@pytest.mark.parametrize("name", SMALL)
def test_small_arms_whose_position_alone_does_not_tell_every_joint(name: str) -> None:
    """Their orientation does: no joint is free, and no solution hangs on the seed."""
    arm = Arm(*SMALL[name])
    form = closed_form(arm.chain)
    if form is None:
        return
    qs = arm.configurations(100, 18)
    targets = poses(arm.robot, arm.chain, qs)
    for seed in (0.1, 2.0):
        table = branches(form, targets, seed)
        assert found_again(arm, table, qs).max() < 1e-6
        assert (table.free != 0).mean() < 0.05
        assert pose_errors(arm, FULL_POSE, targets, table).max() <= 1e-8


def drawn_tables(count: int) -> list[tuple[list[Row], str]]:
    """Tables of square and parallel axes with few lengths, two to seven joints that turn or slide."""
    rng = np.random.default_rng(19)
    tables: list[tuple[list[Row], str]] = []
    while len(tables) < count:
        n = int(rng.choice([2, 3, 4, 5, 6, 6, 6, 7]))
        turned, lengths = (0.0, np.pi / 2, -np.pi / 2, np.pi), (0.0, 0.0, 0.3, 0.45)
        drawn: list[Row] = [
            (
                float(rng.choice(lengths)),
                float(rng.choice(turned)),
                float(rng.choice(lengths)),
                float(rng.choice(turned)),
            )
            for _ in range(n)
        ]
        types = "".join(rng.choice(list("RRRP"), n))
        if n == 6:
            # Every other arm has a wrist, so that some are solved.
            drawn[3], drawn[4] = (0.0, np.pi / 2, drawn[3][2], 0.0), (0.0, -np.pi / 2, 0.0, 0.0)
            types = types[:3] + "RRR"
        tables.append((drawn, types))
    return tables


@pytest.mark.slow
@pytest.mark.parametrize("part_of_them", range(4))
def test_of_tables_drawn_at_random_what_is_reported_solved_is_solved(part_of_them: int) -> None:
    solved = 0
    for parameters, types in drawn_tables(120)[part_of_them::4]:
        arm = Arm(parameters, types)
        form = closed_form(arm.chain)
        qs = arm.configurations(30, 20)
        ranks = [np.linalg.matrix_rank(arm.table.jacobian(q), tol=1e-7) for q in qs[:3]]
        if form is None:
            continue
        targets = poses(arm.robot, arm.chain, qs)
        if max(ranks) < len(types):
            answer = all_of(arm.robot, arm.chain, part(targets, slice(0, 2)), 0.1, respect_limits=False, time_limit=5.0)
            assert not any(answer.complete or []), (parameters, types)
            continue
        table = branches(form, targets)
        assert found_again(arm, table, qs).max() < 1e-5, (parameters, types)
        assert pose_errors(arm, FULL_POSE, targets, table).max() <= 1e-8
        assert (table.free != 0).mean() < 0.1, (parameters, types)
        solved += 1
    assert solved >= 5


# Seven joints: a family by the angle of the elbow.


@pytest.mark.parametrize(
    "name", ["spherical shoulder and wrist", "the same with an offset elbow", "the same with skew axes"]
)
def test_the_elbow_turns_about_the_line_from_shoulder_to_wrist(name: str) -> None:
    arm = CLASSES[name].arm(3)
    form = form_of(arm.chain)
    q = arm.configurations(1, 22)
    targets = poses(arm.robot, arm.chain, q)
    shoulder = arm.table.frames(q[0])[1][:3, 3]
    reference = None
    solved = 0
    for angle in np.linspace(-np.pi, np.pi, 25)[:-1]:
        table = branches(form, targets, elbows=np.array([angle]))
        assert pose_errors(arm, FULL_POSE, targets, table).max(initial=0.0) <= EXACT
        np.testing.assert_allclose(same_turn(form.elbow_angles(table.qs) - angle), 0.0, atol=1e-8)
        solved += len(table.qs) > 0
        for row in table.qs:
            frames = arm.table.frames(row)
            measured = dihedral(shoulder, frames[5][:3, 3], on_axis_4(frames[3], shoulder))
            if reference is None:
                reference = measured - angle
            # Measured from the plane of the line and axis 1, whatever the branch; as the sense is chosen, so it stays.
            assert abs(same_turn(np.array(measured - angle - reference))) < 1e-7
    assert solved >= 12


def on_axis_4(frame: Array, shoulder: Array) -> Array:
    """The point of axis 4 that is nearest to the shoulder."""
    along = frame[:3, 2]
    return np.asarray(frame[:3, 3] + along * (along @ (shoulder - frame[:3, 3])))


def dihedral(shoulder: Array, wrist: Array, elbow: Array) -> float:
    """Of the elbow about the line from shoulder to wrist, from the upward direction, [rad]."""
    n = (wrist - shoulder) / np.linalg.norm(wrist - shoulder)
    up = np.array([0.0, 0.0, 1.0]) - n[2] * n
    out = (elbow - shoulder) - n * (n @ (elbow - shoulder))
    return float(np.arctan2(n @ np.cross(up, out), up @ out))


def test_a_seed_keeps_its_elbow() -> None:
    arm = CLASSES["spherical shoulder and wrist"].arm(1)
    qs = arm.configurations(100, 23)
    targets = poses(arm.robot, arm.chain, qs)
    options = Options(method="analytic", respect_limits=False)
    answer = inverse_kinematics(arm.robot, arm.chain, targets, qs, options)
    np.testing.assert_allclose(answer.qs, qs, atol=1e-7)
    form = form_of(arm.chain)
    for angle in (-2.0, 0.3):
        asked = replace(options, every=True, elbow_angle=angle)
        answer = inverse_kinematics(arm.robot, arm.chain, targets, qs, asked)
        np.testing.assert_allclose(same_turn(form.elbow_angles(answer.qs) - angle), 0.0, atol=1e-8)
        assert (np.diff(answer.firsts) == 8).mean() > 0.9
        assert all(answer.complete or [])


def test_a_stretched_elbow_turns_freely() -> None:
    """Shoulder, elbow and wrist in line, where joints 3 and 5 turn about the same line: no finite number is all."""
    arm = CLASSES["spherical shoulder and wrist"].arm(1)
    form = form_of(arm.chain)
    q = np.array([0.3, 0.5, -0.2, 0.0, 0.4, -0.6, 0.1])
    targets = poses(arm.robot, arm.chain, q[None])
    angle = float(form.elbow_angles(q[None])[0])
    answer = all_of(arm.robot, arm.chain, targets, q, elbow_angle=angle)
    assert answer.position_errors.max() <= EXACT
    assert answer.complete == [False]


def test_an_arm_whose_joints_never_are_independent_has_no_finite_number_of_solutions() -> None:
    parameters: list[Row] = [
        (-0.3, -np.pi / 2, -0.15, 0.0),
        (0.4, np.pi / 2, 0.0, -np.pi / 2),
        (0.25, -np.pi / 2, 0.0, np.pi),
        (0.3, -np.pi / 2, 0.0, 0.0),
    ]
    arm = Arm(parameters, "PRPR")
    if closed_form(arm.chain) is None:
        return
    qs = arm.configurations(5, 26)
    assert all(np.linalg.matrix_rank(arm.table.jacobian(q), tol=1e-9) == 3 for q in qs)
    answer = all_of(arm.robot, arm.chain, poses(arm.robot, arm.chain, qs), 0.1, respect_limits=False)
    assert not any(answer.complete or [])
