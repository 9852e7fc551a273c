"""Singularities against the lecture, against factors of determinants, finite differences and brute force."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

from gelenk.errors import CertificationFailed
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import Direction
from gelenk.kinematics.judge.words import Reference
from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.kinematics.singularity.distance import NearestSingularity, can_lose, nearest_singularity
from gelenk.kinematics.singularity.path import PathMinimum, places_along
from gelenk.kinematics.singularity.report import SingularityReport, certify_reports, singularity_report
from gelenk.kinematics.velocity.jacobian import jacobians
from gelenk.kinematics.velocity.task_space import FULL_SPACE, TaskSpace, structure
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from tests.ik.arm_classes import Arm, seven
from tests.ik.arms import DECOUPLED, PUMA, UR5, limited, poses, table_arm
from tests.oracles import catalogue, dh_columns
from tests.oracles.differences import aligned, derivatives, plain
from tests.robots import robot, samples, swept

PLANE = TaskSpace(Task(("x", "y")))
POSITION = TaskSpace(Task(("x", "y", "z")))
ORIENTATION = TaskSpace(Task(("rx", "ry", "rz")))
TASKS: list[tuple[Direction, ...]] = [
    ("x", "y", "z", "rx", "ry"),
    ("x", "y", "rz"),
    ("ry",),
    ("z", "rx", "ry", "rz"),
    ("x", "z"),
]
FAR = 100.0
Q = np.array([0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
A2, A3, D5 = -0.425, -0.39225, 0.09465
"""Of the UR5: det J = a₂ a₃ s₃ s₅ (a₂c₂ + a₃c₂₃ + d₅s₂₃₄)."""


@cache
def default_chain(name: str) -> Chain:
    return robot(name).chain(None, None)


@cache
def named(name: str) -> Chain:
    """An arm by a short name."""
    if name in {"decoupled", "puma", "ur5"}:
        return table_arm({"decoupled": DECOUPLED, "puma": PUMA, "ur5": UR5}[name])[1]
    if name == "seven":
        return Arm(seven(np.random.default_rng(0), 0.0), "RRRRRRR").chain
    return default_chain(name)


def report(chain: Chain, q: Array | list[float], space: TaskSpace = FULL_SPACE) -> SingularityReport:
    return singularity_report(chain, np.array(q, dtype=float), space=space)


def smallest(chain: Chain, qs: Array, space: TaskSpace) -> Array:
    """The last singular value that can be other than zero, of rows of the geometric Jacobian."""
    rows = [["x", "y", "z", "rx", "ry", "rz"].index(direction) for direction in space.task.directions]
    sigmas = np.linalg.svd(chain_jacobians(chain.flat, qs)[2][:, rows], compute_uv=False)
    return np.asarray(sigmas[:, structure(chain, space.task).rank - 1])


def nearest(
    chain: Chain, q: Array, space: TaskSpace = FULL_SPACE, *, radius: float = np.pi, respect_limits: bool = False
) -> NearestSingularity | None:
    return nearest_singularity(chain, q, space, radius=radius, tolerance=1e-10, respect_limits=respect_limits)


def changed(q: Array, **values: float) -> Array:
    """A configuration with some joints elsewhere: `q3=…` is the third."""
    q = q.copy()
    for name, value in values.items():
        q[int(name[1:]) - 1] = value
    return q


def shoulder_of_ur5(q: Array) -> float:
    return float(A2 * np.cos(q[1]) + A3 * np.cos(q[1] + q[2]) + D5 * np.sin(q[1] + q[2] + q[3]))


def test_the_wrist_of_the_lecture() -> None:
    chain = default_chain("ur5_dh")
    found = report(chain, changed(Q, q5=0.0))
    expected = [2.073079224, 1.450502321, 0.545464331, 0.489296516, 0.247862652, 0.0]
    np.testing.assert_allclose(found.sigmas, expected, atol=5e-10)
    assert (found.rank, found.structural_rank, found.kinds, found.joints) == (5, 6, ("wrist",), (1, 2, 3, 5))
    assert found.exit is not None
    np.testing.assert_allclose(found.exit, [0, 0, 0, 0, 1, 0], atol=1e-12)
    J = dh_columns.from_json(catalogue.dh_table("ur5_dh")).jacobian(changed(Q, q5=0.0))
    np.testing.assert_allclose(J @ found.internal_motions, 0.0, atol=1e-14)
    np.testing.assert_allclose(found.wrenches.T @ J, 0.0, atol=1e-14)


@pytest.mark.parametrize("q2", [0.0, np.pi, -np.pi])
def test_the_stretched_and_the_folded_arm_of_the_blackboard(q2: float) -> None:
    """The links in line: lost is the direction along them, which bears a force for free."""
    found = report(default_chain("planar_2r"), [0.3, q2], PLANE)
    assert (found.rank, found.kinds, found.joints) == (1, ("elbow",), (0, 1))
    for lost in (found.twists, found.wrenches):
        np.testing.assert_allclose(lost[:, 0], [np.cos(0.3), np.sin(0.3), 0, 0, 0, 0], atol=1e-15)
    # The tip stands where both links take it: (l1 cos q2 + l2) q̇1 + l2 q̇2 = 0 for l = (1, 0.7).
    first, second = found.internal_motions[:, 0]
    assert (np.cos(q2) + 0.7) * first + 0.7 * second == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("q2", [0.0, 0.8, np.pi])
def test_in_all_six_directions_a_planar_arm_never_loses_rank(q2: float) -> None:
    """What it lacks, it lacks everywhere: z, rx and ry; and one more, because two joints give two directions."""
    found = report(default_chain("planar_2r"), [0.3, q2])
    assert (found.rank, found.structural_rank, found.defect, found.kinds) == (2, 2, 0, ())
    assert found.twists.shape == (6, 4)
    np.testing.assert_allclose(found.twists[:, 1:], np.eye(6)[:, [2, 3, 4]], atol=1e-15)


SINGULAR = {
    "2R": ("planar_2r", [0.3, 0.0], PLANE, {"elbow"}),
    "3R": ("planar_3r", [0.3, 0.0, 0.4], TaskSpace(Task(("x", "y", "rz"))), {"elbow"}),
    "3R in a line": ("planar_3r", [0.3, 0.0, 0.0], PLANE, {"elbow"}),
    "SCARA": ("scara", [0.4, 0.0, 0.1, -0.3], FULL_SPACE, {"elbow"}),
    "anthropomorphic elbow": ("anthropomorphic", [0.3, 0.6, 0.0], POSITION, {"elbow"}),
    "anthropomorphic, folded": ("anthropomorphic", [0.3, 0.6, np.pi], POSITION, {"elbow"}),
    "anthropomorphic shoulder": (
        "anthropomorphic",
        [0.3, 1.2, np.arccos(-0.5 * np.cos(1.2) / 0.4) - 1.2],
        POSITION,
        {"shoulder"},
    ),
    "anthropomorphic, both": ("anthropomorphic", [0.3, np.pi / 2, 0.0], POSITION, {"elbow", "shoulder"}),
    "spherical wrist": ("spherical_wrist", [0.2, 0.0, -0.5], ORIENTATION, {"wrist"}),
    "decoupled wrist": ("decoupled", [0.3, 0.6, 0.7, 0.2, 0.0, -0.5], FULL_SPACE, {"wrist"}),
    "decoupled elbow": ("decoupled", [0.3, 0.6, np.pi / 2, 0.2, 0.9, -0.5], FULL_SPACE, {"elbow"}),
    "decoupled wrist and elbow": ("decoupled", [0.3, 0.6, np.pi / 2, 0.2, 0.0, -0.5], FULL_SPACE, {"wrist", "elbow"}),
    "Puma wrist": ("puma", [0.1, 0.2, 0.3, 0.4, 0.0, 0.6], FULL_SPACE, {"wrist"}),
    "Puma elbow": ("puma", [0.1, 0.2, np.arctan2(0.0203, 0.4318) - np.pi / 2, 0.4, 0.5, 0.6], FULL_SPACE, {"elbow"}),
    "UR5 wrist": ("ur5", [*changed(Q, q5=0.0)], FULL_SPACE, {"wrist"}),
    "UR5 wrist, turned": ("ur5", [*changed(Q, q5=-np.pi)], FULL_SPACE, {"wrist"}),
    "UR5 elbow": ("ur5", [*changed(Q, q3=0.0)], FULL_SPACE, {"elbow"}),
    "UR5, both": ("ur5", [*changed(Q, q3=0.0, q5=0.0)], FULL_SPACE, {"wrist", "elbow"}),
    "Stanford wrist": ("stanford", [0.3, 0.2, 0.3, 0.1, 0.0, 0.4], FULL_SPACE, {"wrist"}),
    "Stanford shoulder": ("stanford", [0.3, 0.0, 0.3, 0.1, 0.7, 0.4], FULL_SPACE, {"shoulder"}),
    "7R elbow": ("seven", [0.1, 0.2, 0.3, 0.0, 0.5, 0.6, 0.7], FULL_SPACE, {"elbow"}),
    "7R shoulder": ("seven", [0.1, 0.0, np.pi / 2, 0.4, 0.5, 0.6, 0.7], FULL_SPACE, {"shoulder"}),
    "7R wrist": ("seven", [0.1, 0.2, 0.3, 0.4, np.pi / 2, 0.0, 0.7], FULL_SPACE, {"wrist"}),
    "no name": ("panda", [0.0] * 7, FULL_SPACE, set()),
}


@pytest.mark.parametrize("case", SINGULAR)
def test_a_singularity_has_a_name(case: str) -> None:
    name, q, space, kinds = SINGULAR[case]
    found = report(named(name), q, space)
    assert found.defect > 0
    assert set(found.kinds) == kinds
    assert report(named(name), np.array(q) + 0.1, space).kinds == ()


@pytest.mark.parametrize("name", ["puma", "ur5", "decoupled"])
def test_the_shoulder_is_found_where_its_factor_vanishes(name: str) -> None:
    """Along the second joint the determinant has a root that is neither the elbow's nor the wrist's."""
    chain = named(name)

    def determinant(q2: float) -> float:
        return float(np.linalg.det(chain_jacobians(chain.flat, changed(Q, q2=q2)[None])[2][0]))

    grid = np.linspace(-np.pi, np.pi, 40)
    values = np.array([determinant(q2) for q2 in grid])
    i = int(np.flatnonzero(values[:-1] * values[1:] < 0.0)[0])
    q = changed(Q, q2=brentq(determinant, grid[i], grid[i + 1], xtol=1e-15))
    found = report(chain, q)
    assert (found.rank, found.kinds) == (5, ("shoulder",))
    assert 0 in found.joints
    if name == "ur5":
        assert shoulder_of_ur5(q) == pytest.approx(0.0, abs=1e-14)


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_what_is_lost_and_what_is_free_on_every_robot(name: str) -> None:
    """At zero, where many are singular, and elsewhere: by the Jacobian from differences of Pinocchio's poses."""
    machine, chain = robot(name), default_chain(name)

    def pose(qs: Array) -> Array:
        Ts = np.tile(np.eye(4), (len(qs), 1, 1))
        found = poses(machine, chain, qs)
        Ts[:, :3, :3], Ts[:, :3, 3] = found.rotations, found.positions
        return Ts

    for q in (np.zeros(len(chain)), samples(chain, 1)[0]):
        J = np.array(derivatives(pose, q, aligned)).reshape(-1, 6).T
        found = report(chain, q)
        assert found.rank == np.linalg.matrix_rank(J, tol=1e-9)
        np.testing.assert_allclose(found.sigmas, np.linalg.svd(J, compute_uv=False), atol=1e-10)
        assert found.twists.shape == (6, 6 - found.rank)
        assert found.internal_motions.shape == (len(chain), len(chain) - found.rank)
        np.testing.assert_allclose(J @ found.internal_motions, 0.0, atol=1e-10)
        np.testing.assert_allclose(found.wrenches.T @ J, 0.0, atol=1e-10)
        for basis in (found.lost_directions, found.internal_motions):
            np.testing.assert_allclose(basis.T @ basis, np.eye(basis.shape[1]), atol=1e-12)
    assert found.defect == 0


REGULAR = [
    ("ur5", FULL_SPACE),
    ("panda", FULL_SPACE),
    ("stanford", FULL_SPACE),
    ("panda", POSITION),
    ("tiago", POSITION),
]


@pytest.mark.parametrize(("name", "space"), REGULAR)
def test_at_a_regular_configuration_the_way_out_is_the_gradient(name: str, space: TaskSpace) -> None:
    chain = named(name)
    q = samples(chain, 1, seed=4)[0]
    found = report(chain, q, space)
    gradient = derivatives(lambda qs: smallest(chain, qs, space), q, plain)
    assert found.exit is not None
    np.testing.assert_allclose(found.exit_rate * found.exit, gradient, atol=1e-7)


@pytest.mark.parametrize(
    "case", ["2R", "anthropomorphic elbow", "anthropomorphic shoulder", "decoupled elbow", "UR5 wrist", "7R elbow"]
)
def test_no_motion_leaves_a_singularity_faster_than_the_way_out(case: str) -> None:
    name, q, space, _ = SINGULAR[case]
    chain = named(name)
    found = report(chain, q, space)
    assert found.exit is not None
    step = 1e-5
    drawn = np.random.default_rng(0).normal(size=(500, len(chain)))
    directions = np.vstack((found.exit, -found.exit, drawn / np.linalg.norm(drawn, axis=1, keepdims=True)))
    rates = smallest(chain, np.array(q) + step * directions, space) / step
    np.testing.assert_allclose(rates[:2], found.exit_rate, rtol=1e-3)
    assert rates.max() < found.exit_rate * (1.0 + 1e-3)


@pytest.mark.parametrize("case", ["decoupled wrist and elbow", "anthropomorphic, both"])
def test_the_way_out_of_two_singularities_at_once_leaves_both(case: str) -> None:
    name, q, space, _ = SINGULAR[case]
    found = report(named(name), q, space)
    assert found.defect == 2 or found.exit is None
    if found.exit is not None:
        assert smallest(named(name), np.array(q) + 1e-5 * found.exit[None], space)[0] > 0.5e-5 * found.exit_rate


def test_redundancy_and_the_motions_of_a_singularity_are_told_apart() -> None:
    """Three axes of the Panda at zero are one line: two motions are free where elsewhere there is one."""
    found = report(default_chain("panda"), [0.0] * 7)
    assert (found.rank, found.defect, found.internal_motions.shape) == (5, 1, (7, 2))
    assert set(np.flatnonzero(np.abs(found.internal_motions).max(axis=1) > 1e-9)) == {0, 2, 4}
    regular = report(default_chain("panda"), samples(default_chain("panda"), 1)[0])
    assert (regular.defect, regular.internal_motions.shape, regular.joints) == (0, (7, 1), ())


@pytest.mark.parametrize("name", ["panda", "stanford", "centauro"])
@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
@pytest.mark.parametrize("directions", TASKS, ids=" ".join)
def test_the_derivative_of_the_rows_that_count(
    name: str, reference: Reference, directions: tuple[Direction, ...]
) -> None:
    chain, space = default_chain(name), TaskSpace(Task(directions), 0.7, reference)
    q = samples(chain, 1, seed=2)[0]
    differences = np.array(derivatives(lambda qs: space.jacobians(chain, qs), q, plain))
    np.testing.assert_allclose(space.hessians(chain, q[None])[0], np.moveaxis(differences, 0, 2), atol=1e-10)


@pytest.mark.parametrize("directions", [*TASKS, ("rz", "y", "x")], ids=" ".join)
def test_rows_are_those_of_the_reference_in_the_order_as_given(directions: tuple[Direction, ...]) -> None:
    chain = default_chain("ur5_dh")
    table = dh_columns.from_json(catalogue.dh_table("ur5_dh"))
    J, T = table.jacobian(Q), table.pose(Q)
    rows = [["x", "y", "z", "rx", "ry", "rz"].index(direction) for direction in directions]
    local = np.vstack((T[:3, :3].T @ J[:3], T[:3, :3].T @ J[3:]))
    world = np.vstack((J[:3] + np.cross(T[:3, 3], J[3:], axisb=0, axisc=0), J[3:]))
    for reference, expected in (("local_world_aligned", J), ("local", local), ("world", world)):
        space = TaskSpace(Task(directions), None, reference)  # type: ignore[arg-type]
        np.testing.assert_allclose(space.jacobians(chain, Q[None])[0], expected[rows], atol=1e-14)


def test_a_length_changes_what_is_square_to_the_motions_and_not_what_is_borne() -> None:
    chain, q = default_chain("ur5_dh"), changed(Q, q5=0.0)
    J = dh_columns.from_json(catalogue.dh_table("ur5_dh")).jacobian(q)
    plain_, scaled = report(chain, q), report(chain, q, TaskSpace(Task(), 0.25))
    np.testing.assert_allclose(scaled.wrenches, plain_.wrenches, atol=1e-13)
    S = np.diag([1.0, 1.0, 1.0, 0.25, 0.25, 0.25])
    np.testing.assert_allclose((S @ scaled.twists).T @ (S @ J), 0.0, atol=1e-13)
    assert np.abs(scaled.twists - plain_.twists).max() > 0.1
    np.testing.assert_allclose(scaled.sigmas, np.linalg.svd(S @ J, compute_uv=False), atol=1e-13)
    assert (scaled.rank, scaled.joints, scaled.kinds) == (plain_.rank, plain_.joints, plain_.kinds)


def test_a_coarse_tolerance_calls_more_configurations_singular() -> None:
    chain = default_chain("ur5_dh")
    found = singularity_report(chain, changed(Q, q5=1e-3), tolerance=1e-2)
    assert (found.rank, found.kinds, found.joints) == (5, ("wrist",), (1, 2, 3, 5))
    assert report(chain, changed(Q, q5=1e-3)).rank == 6


def test_a_chain_without_joints_has_lost_nothing_that_it_had() -> None:
    machine = robot("panda")
    chain = machine.chain("panda_link0", "panda_link0")
    found = report(chain, [])
    assert (found.rank, found.structural_rank, found.smallest, found.exit) == (0, 0, None, None)
    assert found.twists.shape == (6, 6)
    assert nearest(chain, np.zeros(0)) is None
    assert places_along(chain, np.zeros((2, 0)), FULL_SPACE, 1e-10, 1.0) == ()


WIDE: list[tuple[str, str | None, str | None, tuple[Direction, ...]]] = [
    ("human", "middle_pelvis", "right_hand", ("z",)),
    ("human", "middle_pelvis", "right_hand", ("ry",)),
    ("human", "right_foot", "right_hand", ("x", "y")),
    ("baxter", "left_gripper", "right_gripper", ("x",)),
]


@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
@pytest.mark.parametrize(("name", "base", "tip", "directions"), WIDE)
def test_internal_motions_of_many_joints_leave_the_tip_at_rest(
    name: str, base: str | None, tip: str | None, directions: tuple[Direction, ...], reference: Reference
) -> None:
    """By twists through Pinocchio: of few rows and many joints, all motions at a configuration are not all at each."""
    machine = robot(name)
    chain, space = machine.chain(base, tip), TaskSpace(Task(directions), None, reference)
    q: Array = np.linspace(0.1, 0.1 * len(chain), len(chain))
    found = report(chain, q, space)
    motions = found.internal_motions.T
    assert len(motions) == len(chain) - len(directions)
    twists = jacobians(machine, chain, q[None], reference=reference).values[0] @ motions.T
    np.testing.assert_allclose(twists[space.rows], 0.0, atol=1e-13)
    np.testing.assert_allclose(motions @ motions.T, np.eye(len(motions)), atol=1e-12)
    certified = certify_reports(machine, chain, space, q[None], [found])
    assert certified["max_internal_motion"] < 1e-13


@pytest.mark.parametrize("count", [9, 20, 60])
def test_motions_that_are_idle_everywhere_are_found_among_many_joints(count: int) -> None:
    """The first two joints turn about one line; nothing else is idle, however many joints there are."""
    rng = np.random.default_rng(count)
    rows = [(0.0, 0.0, 0.3, 0.0), *rng.uniform(0.2, 1.0, (count - 1, 4)).tolist()]
    chain = table_arm(rows, "R" * count)[1]
    for directions in (("x",), ("x", "y"), FULL_SPACE.task.directions):
        idle = structure(chain, Task(directions)).idle
        np.testing.assert_allclose(np.abs(idle[:, 0]), [0.5**0.5, 0.5**0.5, *[0.0] * (count - 2)], atol=1e-14)
        assert idle.shape == (count, 1)


@pytest.mark.parametrize("part", ["internal_motions", "lost_directions"])
def test_a_motion_that_moves_the_tip_is_not_certified(part: str) -> None:
    machine, chain, q = robot("panda"), default_chain("panda"), np.zeros(7)
    found = report(chain, q)
    wrong = replace(found, **{part: np.roll(getattr(found, part), 1, axis=0)})
    assert certify_reports(machine, chain, FULL_SPACE, q[None], [found])["max_internal_motion"] < 1e-14
    with pytest.raises(CertificationFailed):
        certify_reports(machine, chain, FULL_SPACE, q[None], [wrong])


@pytest.mark.quick(8)
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
@pytest.mark.parametrize("reference", ["local_world_aligned", "local", "world"])
def test_what_is_told_of_every_robot_is_what_pinocchios_jacobian_does(name: str, reference: Reference) -> None:
    machine, chain = robot(name), default_chain(name)
    qs = np.vstack((np.zeros(len(chain)), samples(chain, 1)))
    for directions in (FULL_SPACE.task.directions, ("z", "rx"), ("ry", "y", "x")):
        space = TaskSpace(Task(directions), 0.3, reference)
        certify_reports(machine, chain, space, qs, [report(chain, q, space) for q in qs])
        for q in qs:
            found = report(chain, q, space)
            # Wrenches of the base's axes at the tip, whatever the reference.
            J = jacobians(machine, chain, q[None]).values[0]
            np.testing.assert_allclose(found.wrenches.T @ J, 0.0, atol=1e-9)
            np.testing.assert_allclose(np.linalg.norm(found.twists, axis=0), 1.0)


def test_what_is_lost_at_the_bases_origin_is_told_at_the_tip() -> None:
    """The point at the base's origin stands still about the first joint: its x and y are no motion of one joint."""
    chain = table_arm([(1.0, 0.0, 0.0, 0.0)], "R")[1]
    found = report(chain, [0.4], TaskSpace(Task(("x", "y", "rz")), None, "world"))
    assert (found.rank, found.structural_rank) == (1, 1)
    forces = found.wrenches
    np.testing.assert_allclose(forces[5], -np.cos(0.4) * forces[1] + np.sin(0.4) * forces[0], atol=1e-15)


VANISHED: list[tuple[str, list[float], tuple[Direction, ...]]] = [
    ("planar_2r", [np.pi, 0.0], ("x",)),
    ("planar_2r", [np.pi / 2, 0.0], ("y",)),
    ("spherical_wrist", [0.3, np.pi, 0.2], ("z",)),
]


@pytest.mark.parametrize("tolerance", [1e-10, 1e-300])
@pytest.mark.parametrize(("name", "q", "directions"), VANISHED)
def test_rows_that_vanish_together_have_no_rank(
    name: str, q: list[float], directions: tuple[Direction, ...], tolerance: float
) -> None:
    """What is left of them is the rounding of sines, which is large beside nothing else."""
    chain, space = default_chain(name), TaskSpace(Task(directions))
    found = singularity_report(chain, np.array(q), tolerance, space)
    assert (found.rank, found.structural_rank, found.defect) == (0, 1, 1)
    assert found.exit is not None
    step = smallest(chain, (np.array(q) + 1e-5 * found.exit)[None], space)[0]
    assert step == pytest.approx(1e-5 * found.exit_rate, rel=1e-3)
    near = np.array(q) + 0.4 * np.random.default_rng(0).normal(size=len(q))
    reached = nearest_singularity(chain, near, space, radius=np.pi, tolerance=tolerance, respect_limits=False)
    assert reached is not None
    assert reached.distance <= np.linalg.norm(near - q) + 1e-9


NO_ROW: list[tuple[str, str, str, list[float], tuple[Direction, ...]]] = [
    ("xarm7", "link6", "link_eef", [1.1], ("z", "x")),
    ("ur3_dh", "frame_4", "frame_3", [0.0], ("x", "z")),
    ("ur3_dh", "frame_4", "frame_3", [1.5706], ("z", "x")),
    ("hextilt", "flying_arm_5__link_4", "flying_arm_5__gripper", [1.08], ("x", "z")),
]


@pytest.mark.parametrize(("name", "base", "tip", "q", "directions"), NO_ROW)
def test_rows_that_vanish_everywhere_are_no_structure(
    name: str, base: str, tip: str, q: list[float], directions: tuple[Direction, ...]
) -> None:
    chain, space = robot(name).chain(base, tip), TaskSpace(Task(directions))
    found = report(chain, q, space)
    assert (found.rank, found.structural_rank, found.smallest, found.exit) == (0, 0, None, None)
    np.testing.assert_allclose(np.abs(found.twists), np.eye(6)[:, space.rows], atol=1e-15)
    assert not can_lose(chain, space)


@pytest.mark.parametrize(("name", "base", "tip", "q", "_"), NO_ROW[:1])
def test_about_an_axis_of_the_tip_that_is_square_to_the_joints_nothing_turns(
    name: str, base: str, tip: str, q: list[float], _: Any
) -> None:
    chain, space = robot(name).chain(base, tip), TaskSpace(Task(("x", "z", "ry")), None, "local")
    found = report(chain, q, space)
    assert (found.rank, found.structural_rank) == (0, 0)


def test_what_a_rounded_angle_makes_of_a_missing_direction_is_no_rank() -> None:
    """A half turn to eleven digits turns the joint by 5e-12 about y, which is all that is left where x and z vanish."""
    chain, space = robot("ur10").chain("ee_link", "wrist_2_link"), TaskSpace(Task(("ry", "x", "z")))
    (singular, regular) = (report(chain, [q], space) for q in (0.0, 1.0))
    assert (singular.rank, singular.structural_rank, singular.twists.shape) == (0, 1, (6, 3))
    assert (regular.rank, regular.twists.shape) == (1, (6, 2))
    found = nearest(chain, np.array([1.0]), space)
    assert found is not None
    assert found.distance == pytest.approx(1.0, abs=1e-9)


def test_a_repeated_singular_value_has_no_gradient() -> None:
    """It falls to both sides of where a choice of singular vectors would have it grow."""
    chain, space = default_chain("tiago"), TaskSpace(ORIENTATION.task, 2.0)
    q = np.zeros(len(chain))
    found = report(chain, q, space)
    np.testing.assert_allclose(found.sigmas, [12.0**0.5, 8.0**0.5, 8.0**0.5], atol=1e-12)
    assert (found.exit, found.exit_rate, found.defect) == (None, 0.0, 0)
    apart = report(chain, samples(chain, 1)[0], space)
    assert apart.exit is not None


def test_links_in_line_are_named_only_where_the_plane_counts() -> None:
    """Of the speed along x and the turn, what is lost at q₁ = 0 is no elbow's: y₂ = y₁ with q₂ anywhere."""
    chain = default_chain("planar_2r")
    found = report(chain, [0.0, 0.8], TaskSpace(Task(("x", "rz"))))
    assert (found.rank, found.defect, found.kinds) == (1, 1, ())
    for reference in ("local_world_aligned", "local"):
        assert report(chain, [0.3, 0.0], TaskSpace(PLANE.task, None, reference)).kinds == ("elbow",)


def test_two_joints_about_one_line_are_no_singularity() -> None:
    """They leave the tip at rest everywhere, and a third one makes a rank of two."""
    chain = table_arm([(0.0, 0.0, 0.3, 0.0), (0.5, 0.0, 0.0, 0.0), (0.4, 0.0, 0.0, 0.0)], "RRR")[1]
    found = report(chain, [0.3, 0.4, 0.5], PLANE)
    assert (found.rank, found.structural_rank) == (2, 2)
    np.testing.assert_allclose(np.abs(found.internal_motions[:, 0]), [np.sqrt(0.5), np.sqrt(0.5), 0.0], atol=1e-12)
    stretched = report(chain, [0.3, 0.4, 0.0], PLANE)
    assert (stretched.rank, stretched.defect, stretched.internal_motions.shape) == (1, 1, (3, 2))
    np.testing.assert_allclose(np.abs(stretched.internal_motions[:, 1]), [np.sqrt(0.5), np.sqrt(0.5), 0.0], atol=1e-12)


def to_multiple(angle: float) -> float:
    """Distance to the nearest multiple of π."""
    return float(abs(angle - np.pi * np.rint(angle / np.pi)))


def least(distance: Callable[[Array], Array], bounds: list[tuple[float, float]], count: int) -> float:
    """Least value of a function of one or two numbers: downhill, by Nelder and Mead, from the best places of a grid."""
    axes = [np.linspace(low, high, count) for low, high in bounds]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, len(bounds))
    options = {"xatol": 1e-11, "fatol": 1e-14, "maxiter": 2000}
    return min(
        float(minimize(lambda z: distance(z[None])[0], start, method="Nelder-Mead", options=options).fun)
        for start in points[np.argsort(distance(points))[:12]]
    )


def test_the_distance_of_the_blackboards_arm_is_that_of_its_elbow() -> None:
    chain = default_chain("planar_2r")
    for q in samples(chain, 10):
        found = nearest(chain, q, PLANE)
        assert found is not None
        assert found.distance == pytest.approx(to_multiple(q[1]), abs=1e-9)
        assert found.joints == (1,)


@pytest.mark.slow
def test_the_distance_of_the_anthropomorphic_arm_by_a_dense_search() -> None:
    """The elbow is at s₃ = 0; of the shoulder a₂c₂ + a₃c₂₃ = 0 gives q₃ for each q₂."""
    chain = default_chain("anthropomorphic")
    for q in samples(chain, 12):

        def shoulder(q2: Array, q: Array = q) -> Array:
            cosine = -0.5 * np.cos(q2[:, 0]) / 0.4
            outside = np.abs(cosine) > 1.0
            best = np.full(len(q2), FAR)
            for sign in (1.0, -1.0):
                apart = sign * np.arccos(np.where(outside, 0.0, cosine)) - q2[:, 0] - q[2]
                apart -= 2.0 * np.pi * np.rint(apart / (2.0 * np.pi))
                best = np.minimum(best, np.hypot(q2[:, 0] - q[1], apart))
            return np.where(outside, FAR, best)

        expected = min(to_multiple(q[2]), least(shoulder, [(q[1] - np.pi, q[1] + np.pi)], 2000))
        found = nearest(chain, q, POSITION)
        assert found is not None
        assert found.distance == pytest.approx(expected, abs=1e-7)


@pytest.mark.slow
def test_the_distance_of_the_ur5_by_the_factors_of_its_determinant() -> None:
    """s₃ = 0, s₅ = 0, or a₂c₂ + a₃c₂₃ + d₅s₂₃₄ = 0, which gives q₂ up to π for each (q₃, q₄): a grid of these."""
    chain = default_chain("ur5_dh")
    for q in samples(chain, 12):

        def shoulder(pair: Array, q: Array = q) -> Array:
            q3, q34 = pair[:, 0], pair.sum(axis=1)
            cosine, sine = A2 + A3 * np.cos(q3) + D5 * np.sin(q34), -A3 * np.sin(q3) + D5 * np.cos(q34)
            apart = np.arctan2(-cosine, sine) - q[1]
            apart -= np.pi * np.rint(apart / np.pi)
            return np.asarray(np.sqrt(apart**2 + np.sum((pair - q[2:4]) ** 2, axis=1)))

        # Where the arm is nearly folded the set bends sharply: so more closely next to q.
        windows = [[(q[j] - width, q[j] + width) for j in (2, 3)] for width in (1.6, 0.3, 0.06)]
        expected = min(to_multiple(q[2]), to_multiple(q[4]), *[least(shoulder, window, 150) for window in windows])
        found = nearest(chain, q)
        assert found is not None
        assert found.distance == pytest.approx(expected, abs=1e-8)


def constrained_distance(chain: Chain, q: Array, starts: int, respect_limits: bool) -> float:
    """The same by sequential quadratic programming in q and the lost direction u: Jᵀu = 0, ‖u‖ = 1."""
    n, rng = len(chain), np.random.default_rng(0)
    bounds = list(zip(chain.lower, chain.upper, strict=True)) if respect_limits else [(-np.inf, np.inf)] * n

    def constraint(z: Array) -> Array:
        return np.append(FULL_SPACE.jacobians(chain, z[None, :n])[0].T @ z[n:], z[n:] @ z[n:] - 1.0)

    def slope(z: Array) -> Array:
        J, H = FULL_SPACE.jacobians(chain, z[None, :n])[0], FULL_SPACE.hessians(chain, z[None, :n])[0]
        return np.block([[np.einsum("kij,k->ij", H, z[n:]), J.T], [np.zeros((1, n)), 2.0 * z[None, n:]]])

    best = np.inf
    for _ in range(starts):
        x = np.clip(q + rng.normal(size=n) * rng.uniform(0.05, 1.2), [b[0] for b in bounds], [b[1] for b in bounds])
        u = np.linalg.svd(FULL_SPACE.jacobians(chain, x[None])[0])[0][:, -1]
        answer = minimize(
            lambda z: np.sum((z[:n] - q) ** 2),
            np.concatenate((x, u)),
            jac=lambda z: np.concatenate((2.0 * (z[:n] - q), np.zeros(6))),
            constraints={"type": "eq", "fun": constraint, "jac": slope},
            bounds=[*bounds, *[(-1.0, 1.0)] * 6],
            method="SLSQP",
            options={"ftol": 1e-13, "maxiter": 150},
        )
        if np.abs(constraint(answer.x)).max() < 1e-8:
            best = min(best, float(answer.fun))
    return float(np.sqrt(best))


@pytest.mark.slow
@pytest.mark.parametrize("respect_limits", [False, True])
@pytest.mark.parametrize("name", ["panda", "xarm7", "puma560"])
def test_the_distance_by_another_minimisation(name: str, respect_limits: bool) -> None:
    chain = default_chain(name)
    low, high = np.maximum(chain.lower, -np.pi), np.minimum(chain.upper, np.pi)
    for q in np.random.default_rng(3).uniform(low, high, (4, len(chain))):
        found = nearest(chain, q, respect_limits=respect_limits)
        assert found is not None
        assert found.distance <= constrained_distance(chain, q, 15, respect_limits) + 1e-7
        if respect_limits:
            assert ((chain.lower <= found.q) & (found.q <= chain.upper)).all()


SQUARE = [("ur5", FULL_SPACE), ("puma", FULL_SPACE), ("decoupled", FULL_SPACE), ("anthropomorphic", POSITION)]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "space"), SQUARE)
def test_no_line_meets_a_singularity_inside_the_distance(name: str, space: TaskSpace) -> None:
    """On lines from the configuration the determinant keeps its sign up to there, and vanishes at the end of one."""
    chain = named(name)
    rng = np.random.default_rng(1)
    for q in samples(chain, 5, seed=8):
        found = nearest(chain, q, space)
        assert found is not None
        drawn = rng.normal(size=(300, len(chain)))
        rays = np.vstack((drawn / np.linalg.norm(drawn, axis=1, keepdims=True), (found.q - q) / found.distance))
        stations = found.distance * (1.0 - 1e-6) * np.linspace(0.0, 1.0, 60)
        lines = q + stations[:, None] * rays[:, None, :]
        determinants = np.linalg.det(space.jacobians(chain, lines.reshape(-1, len(chain)))).reshape(len(rays), -1)
        assert (np.sign(determinants) == np.sign(determinants[:, :1])).all()
        assert smallest(chain, found.q[None], space)[0] < 1e-11


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["panda", "baxter", "scara", "stanford", "so101", "tiago"])
def test_what_is_found_is_singular_and_the_way_there_is_as_long_as_said(name: str) -> None:
    chain = default_chain(name)
    for q in samples(chain, 2, seed=6):
        found = nearest(chain, q, radius=6.0)
        assert found is not None
        assert found.distance == pytest.approx(np.linalg.norm(found.q - q), abs=1e-14)
        assert report(chain, found.q).defect > 0
        assert set(np.flatnonzero(np.abs(found.q - q) > 1e-5)) <= set(found.joints)
        repeated = nearest(chain, q, radius=6.0)
        assert repeated is not None
        np.testing.assert_array_equal(repeated.q, found.q)


def test_a_singular_configuration_is_its_own_nearest() -> None:
    for name, q, space, _ in SINGULAR.values():
        found = nearest(named(name), np.array(q, dtype=float), space)
        assert found is not None
        assert (found.distance, found.joints) == (0.0, ())


def test_nothing_is_found_where_there_is_nothing() -> None:
    chain = default_chain("planar_2r")
    assert nearest(chain, np.array([0.3, 1.0])) is None
    assert nearest(chain, np.array([0.3, 1.0]), PLANE, radius=0.99) is None
    assert nearest(chain, np.array([0.3, 1.0]), PLANE, radius=1.01) is not None
    kept = limited(chain, [-3.0, 0.5], [3.0, 2.0])
    assert nearest(kept, np.array([0.3, 1.0]), PLANE, respect_limits=True) is None


def places(chain: Chain, path: list[list[float]], space: TaskSpace, threshold: float = 0.01) -> tuple[PathMinimum, ...]:
    return places_along(chain, np.array(path, dtype=float), space, 1e-10, threshold)


def test_a_path_of_the_blackboards_arm_is_singular_where_its_elbow_passes_zero_and_pi() -> None:
    found = places(default_chain("planar_2r"), [[0, 1], [1, -1], [1.2, -2], [0, 2], [0, 4]], PLANE)
    expected = [0.5, 2.5, 3.0 + (np.pi - 2.0) / 2.0]
    assert [place.start for place in found] == pytest.approx(expected, abs=1e-12)
    assert [place.start for place in found] == [place.end for place in found]
    assert max(place.share for place in found) < 1e-12
    np.testing.assert_allclose([place.q[1] for place in found], [0, 0, np.pi], atol=1e-12)


def test_a_path_of_the_ur5_passes_each_of_its_three_singularities() -> None:
    chain = default_chain("ur5_dh")
    path = [changed(Q, q5=1.0), changed(Q, q5=-1.0), changed(Q, q5=-1.0, q3=-1.0)]
    found = places(chain, [[*q] for q in path], FULL_SPACE)
    third = brentq(lambda s: shoulder_of_ur5((2.0 - s) * path[1] + (s - 1.0) * path[2]), 1.6, 2.0, xtol=1e-15)
    assert [place.start for place in found] == pytest.approx([0.5, 1.0 + 1.4 / 2.4, third], abs=1e-10)
    kinds = [report(chain, place.q).kinds for place in found]
    assert kinds == [("wrist",), ("elbow",), ("shoulder",)]


def test_a_path_that_stays_singular_is_one_place() -> None:
    chain = default_chain("planar_2r")
    (place,) = places(chain, [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0]], PLANE)
    assert (place.start, place.end, place.sigma) == (1.0, 3.0, 0.0)
    (flat,) = places(chain, [[0.0, 0.01], [1.0, 0.01]], PLANE)
    assert (flat.start, flat.end) == (0.0, 1.0)
    assert places(chain, [[0.0, 0.5], [1.0, 0.5]], PLANE) == ()


@pytest.mark.slow
def test_a_path_that_only_comes_near_has_its_lowest_place_there() -> None:
    """Against a scan of a hundred thousand places: as many minima, in the same places."""
    chain = default_chain("panda")
    path = samples(chain, 3, seed=5)
    s = np.linspace(0.0, 2.0, 100_001)
    segment = np.minimum(s.astype(int), 1)
    part = (s - segment)[:, None]
    sigmas = np.linalg.svd(
        chain_jacobians(chain.flat, (1.0 - part) * path[segment] + part * path[segment + 1])[2], compute_uv=False
    )
    low = sigmas[:, 5]
    minima = 1 + np.flatnonzero((low[1:-1] < low[:-2]) & (low[1:-1] <= low[2:]))
    minima = minima[low[minima] <= 0.1 * sigmas[minima, 0]]
    found = [place for place in places_along(chain, path, FULL_SPACE, 1e-10, 0.1) if 0.0 < place.start < 2.0]
    assert len(minima) >= 3
    assert [place.start for place in found] == pytest.approx(s[minima].tolist(), abs=3e-5)
    assert all(place.sigma <= value for place, value in zip(found, low[minima], strict=True))


def test_a_path_on_which_the_only_row_vanishes_is_singular_there() -> None:
    """Of one row the smallest singular value is the largest, so that its share of that tells nothing."""
    (place,) = places(default_chain("planar_2r"), [[-0.1, -0.2], [0.3, 0.6]], TaskSpace(Task(("x",))))
    assert place.start == pytest.approx(0.25, abs=1e-12)
    assert places(default_chain("planar_2r"), [[-0.1, -0.3], [0.3, 0.6]], TaskSpace(Task(("x",)))) == ()


def test_a_path_of_one_configuration_or_none() -> None:
    chain = default_chain("planar_2r")
    assert [place.start for place in places(chain, [[0.3, 0.0]], PLANE)] == [0.0]
    assert places(chain, [[0.3, 0.5]], PLANE) == ()
    assert places_along(chain, np.zeros((0, 2)), PLANE, 1e-10, 1.0) == ()
