"""Joints along a way of the tip: poses by Pinocchio, rates by a pseudo-inverse, ways whose joints are known before."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from gelenk.errors import InvalidField
from gelenk.ik.search.task import FULL_POSE, Task
from gelenk.ik.search.words import Direction
from gelenk.kinematics.simd.kernels import chain_hessians, chain_jacobians, chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.poses import Poses, transform
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from gelenk.trajectory.follow import integrate as follow_trace
from gelenk.trajectory.follow.follow import FollowedPath, follow
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.corners import blended_lines
from gelenk.trajectory.paths.paths import Path, PathSamples, PathSequence, Unit, circle, line
from gelenk.trajectory.paths.spline_paths import spline
from gelenk.trajectory.problem.problem import Following
from tests.robots import of_table, robot, rows, samples

XY = Task(("x", "y"))
SCARA = Task(("x", "y", "z", "rz"))


def pinocchio_poses(arm: RobotModel, chain: Chain, qs: Array) -> Poses:
    """T_base_tip by Pinocchio alone."""
    expansion = arm.expansion(chain)
    base, tip = arm.frame_id(chain.base_frame), arm.frame_id(chain.tip_frame)
    Ts = []
    with arm.lock:
        for q in qs:
            pin.framesForwardKinematics(arm.model, arm.data, expansion.offset + expansion.matrix @ q)
            Ts.append((arm.data.oMf[base].inverse() * arm.data.oMf[tip]).homogeneous.copy())
    Ts_ = np.array(Ts)
    return Poses(np.ascontiguousarray(Ts_[:, :3, 3]), np.ascontiguousarray(Ts_[:, :3, :3]))


def deviations(wanted: Poses, found: Poses, task: Task) -> tuple[float, float]:
    """Largest distance [m] and angle [rad] in the directions that count, by SciPy's rotation vectors."""
    positions = [i for i, name in enumerate("xyz") if name in task.directions]
    rotations = [i for i, name in enumerate(("rx", "ry", "rz")) if name in task.directions]
    off = np.linalg.norm((wanted.positions - found.positions)[:, positions], axis=1)
    if len(rotations) == 2:
        axis = ({0, 1, 2} - set(rotations)).pop()
        cosines = np.einsum("ij,ij->i", wanted.rotations[:, :, axis], found.rotations[:, :, axis])
        return float(off.max()), float(np.arccos(np.clip(cosines, -1.0, 1.0)).max())
    vectors = Rotation.from_matrix(wanted.rotations.transpose(0, 2, 1) @ found.rotations).as_rotvec()
    return float(off.max()), float(np.linalg.norm(vectors[:, rotations], axis=1).max(initial=0.0))


def pose(chain: Chain, q: Array) -> Array:
    T: Array = Poses(*chain_poses(chain.flat, q[None])).matrices()[0]
    return T


def moved(T: Array, shift: Array, turn: Array) -> Array:
    return transform(T[:3, 3] + shift, Rotation.from_rotvec(turn).as_matrix() @ T[:3, :3])


def least_sigma(chain: Chain, q: Array, task: Task) -> float:
    """Of the rows that count; enough of it for tasks whose rotations are about base axes, or all."""
    J = chain_jacobians(chain.flat, q[None])[2][0]
    return float(np.linalg.svd(J[task.weights > 0.0], compute_uv=False)[-1])


def smallest_sigma(chain: Chain, task: Task, positions: PiecewisePolynomial) -> tuple[float, float]:
    """The smallest of `least_sigma` along q(s), and where it is."""
    breaks = positions.breaks
    s = (breaks[:-1] + np.linspace(0.0, 1.0, 33)[:, None] * np.diff(breaks)).ravel()
    Js = chain_jacobians(chain.flat, positions.at(s))[2][:, task.weights > 0.0]
    sigmas = np.linalg.svd(Js, compute_uv=False)[:, -1]
    return float(sigmas.min()), float(s[sigmas.argmin()])


def starts(chain: Chain, task: Task, count: int, seed: int = 0, least: float = 0.12) -> list[Array]:
    """Configurations away from singularities and from limits."""
    lower, upper = np.maximum(chain.lower, -np.pi), np.minimum(chain.upper, np.pi)
    rng = np.random.default_rng(seed)
    found: list[Array] = []
    for _ in range(10_000):
        q = lower + (upper - lower) * rng.uniform(0.25, 0.75, len(chain))
        if least_sigma(chain, q, task) > least:
            found.append(q)
        if len(found) == count:
            break
    assert len(found) == count
    return found


KINDS = ("line", "circle", "spline", "blended", "turn")


def random_path(kind: str, T: Array, rng: np.random.Generator, task: Task, size: float = 0.04) -> Path:
    """A way from a pose; of tasks in the plane it stays in it, and turns about z alone."""
    flat = np.array([1.0, 1.0, float("z" in task.directions)])
    about = np.array([0.0, 0.0, 1.0]) if len(task) < 6 else np.ones(3)
    Ts = [T]
    for _ in range(3):
        Ts.append(moved(Ts[-1], flat * rng.normal(size=3) * size, 0.3 * about * rng.normal(size=3)))
    poses = Poses(np.array([T[:3, 3] for T in Ts]), np.array([T[:3, :3] for T in Ts]))
    legs = np.linalg.norm(np.diff(poses.positions, axis=0), axis=1)
    made: dict[str, Callable[[], Path]] = {
        "line": lambda: line(Ts[0], Ts[1]),
        "circle": lambda: circle(Ts[0], Ts[1], Ts[2]),
        "spline": lambda: spline(poses),
        "blended": lambda: blended_lines(poses, [0.25 * legs[:2].min(), 0.25 * legs[1:].min()]),
        "turn": lambda: line(Ts[0], transform(Ts[0][:3, 3], Ts[1][:3, :3])),
    }
    return made[kind]()


def inside(way: FollowedPath, count: int) -> Array:
    """Places on the way that are no knots."""
    return np.linspace(0.0, way.reached, count + 2)[1:-1] + 1e-9


ARMS: list[tuple[str, Task]] = [
    ("ur5", FULL_POSE),
    ("puma560", FULL_POSE),
    ("stanford", FULL_POSE),
    ("panda", FULL_POSE),
    ("xarm7", FULL_POSE),
    ("scara", SCARA),
    ("planar_2r", XY),
    ("ur5", Task(("x", "y", "z", "rx", "ry"))),
    ("panda", Task(("x", "y", "z"))),
]


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("name", "task"), ARMS)
def test_the_tip_stays_on_the_way_between_knots(name: str, task: Task, kind: str) -> None:
    if kind == "turn" and not {"rx", "ry", "rz"} & set(task.directions):
        return
    arm = robot(name)
    chain = arm.chain(None, None)
    following = Following(task=task)
    rng = np.random.default_rng(KINDS.index(kind))
    done = 0
    for q in starts(chain, task, 3, seed=KINDS.index(kind)):
        if done:
            break
        path = random_path(kind, pose(chain, q), rng, task)
        way = follow(arm, chain, path, q, following)
        done += way.stop is None
        if way.reached == 0.0:
            continue
        s = np.linspace(0.0, way.reached, 200)
        qs = way.positions.at(s)
        off, angle = deviations(path.at(s).poses, pinocchio_poses(arm, chain, qs), task)
        assert off <= following.position_tolerance, (off, way.stop)
        assert angle <= following.orientation_tolerance
        assert (qs >= chain.lower - 1e-9).all()
        assert (qs <= chain.upper + 1e-9).all()
        np.testing.assert_allclose(way.positions.at(np.zeros(1))[0], q, atol=1e-15)
        assert set(path.breaks) <= {*way.positions.breaks.tolist(), *(b for b in path.breaks if b >= way.reached)}
        assert way.reached == path.extent or way.stop is not None
    assert done >= 1


@pytest.mark.parametrize(("name", "task"), ARMS)
def test_rates_are_those_of_the_pseudo_inverse(name: str, task: Task) -> None:
    """To a thousandth; at knots J q' = ξ exactly, and J q'' is what differences of ξ and J along the way say."""
    arm = robot(name)
    chain = arm.chain(None, None)
    q = starts(chain, task, 1, seed=7)[0]
    path = random_path("spline", pose(chain, q), np.random.default_rng(5), task)
    way = follow(arm, chain, path, q, Following(task=task))
    velocities = way.positions.derivative()

    def counting(s: Array, qs: Array) -> tuple[Array, Array]:
        at = path.at(s)
        Js = chain_jacobians(chain.flat, qs)[2]
        turns = at.poses.rotations.transpose(0, 2, 1)
        xi = at.first.copy()
        if 0 < len(task) - task.positions < 3:
            Js[:, 3:], xi[:, 3:] = turns @ Js[:, 3:], (turns @ xi[:, 3:, None])[:, :, 0]
        mask = task.weights > 0.0
        return Js[:, mask], xi[:, mask]

    def times(matrices: Array, vectors: Array) -> Array:
        found: Array = np.einsum("nij,nj->ni", matrices, vectors)
        return found

    def inverses(Js: Array) -> Array:
        found: Array = np.asarray(np.linalg.pinv(Js), dtype=np.float64)
        return found

    s = inside(way, 100)
    Js, xi = counting(s, way.positions.at(s))
    np.testing.assert_allclose(velocities.at(s), times(inverses(Js), xi), atol=1.1e-3 * np.abs(velocities.at(s)).max())
    knots = way.positions.breaks[1:-1]
    qs, dqs, ddqs = way.positions.at(knots), velocities.at(knots), way.positions.derivative(2).at(knots)
    Js, xi = counting(knots, qs)
    np.testing.assert_allclose(
        times(inverses(Js), times(Js, dqs)), times(inverses(Js), xi), atol=1e-9 * np.abs(dqs).max()
    )
    step, missing = 1e-5, []
    for k in (-1.0, 1.0):
        beside, wanted = counting(knots + k * step, qs + k * step * dqs)
        missing.append(times(inverses(Js), wanted - times(beside, dqs)))
    bends = (missing[1] - missing[0]) / (2.0 * step)
    np.testing.assert_allclose(times(inverses(Js), times(Js, ddqs)), bends, atol=1e-4 * (1.0 + np.abs(ddqs).max()))


@pytest.mark.parametrize(("name", "task"), ARMS)
def test_nothing_jumps_but_the_acceleration_where_the_way_bends_suddenly(name: str, task: Task) -> None:
    arm = robot(name)
    chain = arm.chain(None, None)
    q = starts(chain, task, 1, seed=11)[0]
    path = random_path("blended", pose(chain, q), np.random.default_rng(3), task)
    way = follow(arm, chain, path, q, Following(task=task))
    assert len(path.breaks) == 4
    knots = way.positions.breaks[1:-1]
    for order in range(3):
        one = way.positions.derivative(order) if order else way.positions
        jumps = np.abs(one.at(knots) - one.at(np.nextafter(knots, 0.0))).max(axis=1)
        at_break = np.isin(knots, path.breaks)
        scale = 1e-8 * (1.0 + np.abs(one.at(knots)).max())
        assert jumps[~at_break].max(initial=0.0) <= scale
        if order < 2:
            assert jumps[at_break].max() <= scale
        else:
            assert jumps[at_break].max() > 100.0 * scale


# Ways whose joints are known


@dataclass(frozen=True)
class KnownWay:
    """The tip's way of joints q(s) = q_0 + s d + b sin 3s."""

    chain: Chain
    q0: Array
    d: Array
    b: Array
    extent: float
    length: float = 1.0
    angle: float = 1.0
    breaks: tuple[float, ...] = ()
    unit: Unit = "m"

    def joints(self, s: Array, order: int = 0) -> Array:
        waves = (np.sin(3.0 * s), 3.0 * np.cos(3.0 * s), -9.0 * np.sin(3.0 * s))[order]
        linear = (self.q0 + s[:, None] * self.d, self.d + 0.0 * s[:, None], 0.0 * s[:, None])[order]
        joints: Array = linear + waves[:, None] * self.b
        return joints

    def at(self, s: Array) -> PathSamples:
        qs, dqs, ddqs = (self.joints(s, order) for order in range(3))
        positions, rotations, Js = chain_jacobians(self.chain.flat, qs)
        changes = np.einsum("bkij,bj->bki", chain_hessians(self.chain.flat, qs), dqs)
        first = (Js @ dqs[:, :, None])[:, :, 0]
        second = (changes @ dqs[:, :, None] + Js @ ddqs[:, :, None])[:, :, 0]
        return PathSamples(Poses(positions, rotations), first, second)


@pytest.mark.parametrize(
    ("name", "task"), [arm for arm in ARMS if arm[0] in {"ur5", "puma560", "stanford", "scara"}][:4]
)
def test_a_way_made_of_known_joints_gives_them_back(name: str, task: Task) -> None:
    """Continuously over more than half a turn, and through full turns where limits allow: nothing is wrapped."""
    arm = robot(name)
    chain = arm.chain(None, None)
    done = 0
    for seed, q in enumerate(starts(chain, task, 4, seed=2)):
        rng = np.random.default_rng(seed)
        path = KnownWay(chain, q, 0.5 * rng.normal(size=len(chain)), 0.05 * rng.normal(size=len(chain)), 0.6)
        way = follow(arm, chain, path, q, Following(task=task))
        if way.reached == 0.0:
            continue
        s = inside(way, 50)
        known = np.abs(way.positions.at(s) - path.joints(s))
        # Distances in the joints are those of the tip over σ.
        assert known.max() <= 1e-4 / max(smallest_sigma(chain, task, way.positions)[0], 1e-2)
        knots = way.positions.breaks[1:-1]
        for order in range(3):
            one = way.positions.derivative(order) if order else way.positions
            wanted = path.joints(knots, order)
            np.testing.assert_allclose(one.at(knots), wanted, atol=1e-8 * (1.0 + np.abs(wanted).max()))
        done += way.stop is None
    assert done >= 1


def test_joints_turn_on_beyond_a_full_turn() -> None:
    """A wrist that turns once around, and half again, about its last axis."""
    arm = robot("kinova")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, least=0.05)[0]
    d = np.zeros(len(chain))
    d[-1] = 3.0 * np.pi
    path = KnownWay(chain, q, d, np.zeros(len(chain)), 1.0, unit="rad")
    way = follow(arm, chain, path, q, Following(min_singular_value=1e-3))
    assert way.stop is None
    np.testing.assert_allclose(way.positions.at(np.array([1.0]))[0], q + d, atol=1e-9)


def test_an_exact_way_through_a_singularity() -> None:
    """The wrist of a UR5 goes through its singular position while the way asks nothing impossible."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = np.array([0.1, -1.2, 1.4, -0.7, 0.31, 0.3])
    path = KnownWay(chain, q, np.array([0.2, 0.1, 0.1, 0.1, -1.0, 0.1]), np.zeros(6), 0.7)
    way = follow(arm, chain, path, q, Following(near_singularity="slow_down"))
    assert way.stop is None
    s = np.linspace(0.0, 0.7, 100)
    assert smallest_sigma(chain, FULL_POSE, way.positions)[0] < 1e-2
    assert np.abs(way.positions.at(s) - path.joints(s)).max() < 1e-3
    stopped = follow(arm, chain, path, q, Following())
    assert stopped.stop is not None
    assert stopped.stop.reason == "singularity"
    assert stopped.reached < 0.31


# The lecture's line


def test_the_lectures_line_of_two_links() -> None:
    """Unit links, from the pose of (110°, 140°) to (0.816, 1.4): joints at five places, and a spline through more."""
    arm = of_table(rows("standard", [(1.0, 0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)], "RR"))
    chain = arm.chain(None, None)
    q = np.radians([110.0, 140.0])
    T = pose(chain, q)
    end = moved(T, np.array([0.816, 1.4, 0.0]) - T[:3, 3], np.zeros(3))
    printed = [
        (1.919862177194, 2.443460952792),
        (0.958937740441, 2.670339744270),
        (0.265248412194, 2.423137271488),
        (0.208184447121, 1.929984083840),
        (0.416816232314, 1.252522024134),
    ]
    for count, deviation in ((5, 0.037935626952), (9, 0.007526883659), (17, 0.001922985419)):
        shares = np.linspace(0.0, 1.0, count)
        Ts = [moved(T, share * (end - T)[:3, 3], np.zeros(3)) for share in shares]
        path = PathSequence(tuple(line(a, b) for a, b in pairwise(Ts)))
        way = follow(arm, chain, path, q, Following(task=XY))
        assert way.stop is None
        knots = way.positions.at(np.array([0.0, *path.breaks, path.extent]))
        if count == 5:
            np.testing.assert_allclose(knots, printed, rtol=0.0, atol=6e-13)
        times = 2.0 * shares
        joints = cubic_spline(times, knots, "clamped").motion.at(np.linspace(0.0, 2.0, 200_001))
        first, both = joints[:, 0], joints.sum(axis=1)
        tips = np.cos(first) + np.cos(both), np.sin(first) + np.sin(both)
        x, y = (end - T)[:2, 3] / np.linalg.norm((end - T)[:2, 3])
        lateral = np.abs(x * (tips[1] - T[1, 3]) - y * (tips[0] - T[0, 3]))
        assert lateral.max() == pytest.approx(deviation, abs=2e-12)


# All sorts of chains and tasks


@pytest.mark.parametrize("directions", [("x", "y", "z", "ry"), ("x", "z", "rx"), ("y", "rz"), ("rx", "ry"), ("z",)])
def test_some_directions_alone(directions: tuple[Direction, ...]) -> None:
    """Also where the free ones are far off: of one rotation, a component of the rotation vector is kept at zero."""
    arm, task = robot("ur5"), Task(directions)
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, seed=3)[0]
    path = random_path("spline", pose(chain, q), np.random.default_rng(8), FULL_POSE, 0.12)
    way = follow(arm, chain, path, q, Following(task=task))
    assert way.stop is None
    s = np.linspace(0.0, way.reached, 200)
    found = pinocchio_poses(arm, chain, way.positions.at(s))
    assert deviations(path.at(s).poses, found, FULL_POSE)[1] > 0.05
    off, angle = deviations(path.at(s).poses, found, task)
    assert off <= 1e-4
    assert angle <= 1e-3


def test_a_chain_from_the_tool_to_the_base() -> None:
    arm = robot("ur5")
    chain = arm.chain("tool0", "base_link")
    q = starts(chain, FULL_POSE, 1, seed=5)[0]
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.1, 0.05, -0.1]), np.array([0.1, 0.2, 0.0])))
    way = follow(arm, chain, path, q, Following())
    assert way.stop is None
    s = np.linspace(0.0, path.extent, 100)
    assert max(deviations(path.at(s).poses, pinocchio_poses(arm, chain, way.positions.at(s)), FULL_POSE)) < 1e-4


def test_mimic_joints_move_along() -> None:
    """Two links whose second turns twice as far, and a slide."""
    text = """<robot name="arm"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
    <joint name="first" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
    <joint name="second" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/><mimic joint="first" multiplier="2" offset="0.7"/></joint>
    <joint name="third" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>"""
    arm = RobotModel(read_urdf(text))
    chain = arm.chain("base", "c")
    assert chain.joint_names == ("first", "third")
    q = np.array([0.2, 0.4])
    path = line(pose(chain, q), moved(pose(chain, q), np.array([-0.3, 0.2, 0.0]), np.zeros(3)))
    way = follow(arm, chain, path, q, Following(task=XY))
    assert way.stop is None
    s = np.linspace(0.0, path.extent, 100)
    assert deviations(path.at(s).poses, pinocchio_poses(arm, chain, way.positions.at(s)), XY)[0] < 1e-4


def test_parts_of_almost_no_length() -> None:
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, seed=5)[0]
    T = pose(chain, q)
    Ts = [T, *(moved(T, np.array([x, 0.0, 0.0]), np.zeros(3)) for x in (0.05, 0.05 + 2e-9, 0.1))]
    path = PathSequence(tuple(line(a, b) for a, b in pairwise(Ts)))
    way = follow(arm, chain, path, q, Following())
    assert way.stop is None
    assert set(path.breaks) <= set(way.positions.breaks.tolist())
    s = np.linspace(0.0, way.reached, 100)
    assert max(deviations(path.at(s).poses, pinocchio_poses(arm, chain, way.positions.at(s)), FULL_POSE)) < 1e-4


def test_a_way_without_length() -> None:
    arm = robot("panda")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1)[0]
    way = follow(arm, chain, line(pose(chain, q), pose(chain, q)), q, Following())
    assert way.stop is None
    assert way.reached == 0.0
    assert way.positions.breaks.tolist() == [0.0, 1e-12]
    np.testing.assert_array_equal(way.positions.at(np.array([0.0, 1.0])), [q, q])


def test_a_chain_without_joints_goes_nowhere() -> None:
    arm = robot("panda")
    chain = arm.chain("panda_link0", "panda_link0")
    nowhere = np.empty(0)
    path = line(np.eye(4), moved(np.eye(4), np.array([0.1, 0.0, 0.0]), np.zeros(3)))
    way = follow(arm, chain, path, nowhere, Following())
    assert way.stop is not None
    assert (way.stop.reason, way.reached) == ("out_of_reach", 0.0)


def test_a_start_a_little_off_the_way_comes_onto_it() -> None:
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, seed=1)[0]
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.1, 0.0, 0.1]), np.zeros(3)))
    off = q + 1e-6 * np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    way = follow(arm, chain, path, off, Following())
    assert way.stop is None
    np.testing.assert_array_equal(way.positions.at(np.zeros(1))[0], off)
    assert way.path_deviation < 1e-4
    end = pinocchio_poses(arm, chain, way.positions.at(np.array([path.extent])))
    assert max(deviations(path.at(np.array([path.extent])).poses, end, FULL_POSE)) < 1e-12


def test_a_start_elsewhere_is_refused() -> None:
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q, other = starts(chain, FULL_POSE, 2)
    with pytest.raises(ValueError, match="first pose"):
        follow(arm, chain, line(pose(chain, q), pose(chain, other)), other, Following())


def test_deviations_and_sigma_are_told() -> None:
    """What is told of σ is what a fine grid shows; of deviations it is more, since exact knots are put between."""
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, seed=1)[0]
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.2, 0.1, -0.2]), np.array([0.5, 0.0, 0.0])))
    way = follow(arm, chain, path, q, Following())
    s = np.linspace(0.0, way.reached, 2000)
    qs = way.positions.at(s)
    off, angle = deviations(path.at(s).poses, pinocchio_poses(arm, chain, qs), FULL_POSE)
    assert off <= way.path_deviation <= 1e-4
    assert angle <= way.orientation_deviation <= 1e-3


def test_too_many_knots_and_too_small_tolerances_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    arm = robot("ur5")
    chain = arm.chain(None, None)
    q = starts(chain, FULL_POSE, 1, seed=1)[0]
    path = line(pose(chain, q), moved(pose(chain, q), np.array([0.2, 0.1, -0.2]), np.array([0.5, 0.0, 0.0])))
    with pytest.raises(InvalidField, match="path_tolerance"):
        follow(arm, chain, path, q, Following(position_tolerance=1e-17))
    monkeypatch.setattr(follow_trace, "MOST_KNOTS", 2)
    with pytest.raises(InvalidField, match="path_tolerance"):
        follow(arm, chain, path, q, Following(position_tolerance=1e-9))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["ur5", "panda"])
def test_random_ways_between_random_configurations_end_well_or_say_why(name: str) -> None:
    """Long lines anywhere: no exception, no number that is none, and what was done is right."""
    arm = robot(name)
    chain = arm.chain(None, None)
    for seed in range(6):
        a, b = np.clip(samples(chain, 2, seed), chain.lower, chain.upper)
        path = line(pose(chain, a), pose(chain, b))
        way = follow(arm, chain, path, a, Following())
        assert np.isfinite(way.positions.coefficients).all()
        assert 0.0 <= way.reached <= path.extent
        assert (way.stop is None) == (way.reached == path.extent)
        if way.stop is not None:
            assert way.reached - 1e-9 <= way.stop.s <= path.extent
            np.testing.assert_allclose(
                way.stop.position, path.at(np.array([way.stop.s])).poses.positions[0], atol=1e-12
            )
            assert (way.stop.joint is not None) == (way.stop.reason == "joint_limit")
