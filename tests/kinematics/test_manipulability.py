"""Ellipsoids, measures, gradients and polytopes against the course, brute force, differences and linear programmes."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.spatial import ConvexHull

from gelenk.errors import CertificationFailed, InvalidField, TooLarge
from gelenk.kinematics.ellipsoids import manipulability as module
from gelenk.kinematics.ellipsoids.limited_motion import JointBounds, LimitedMotion, joint_bounds, limited_motion
from gelenk.kinematics.ellipsoids.manipulability import (
    Ellipsoids,
    Manipulability,
    Part,
    is_within_task,
    manipulability,
    space_of,
    transmission_ratios,
)
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_measures
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from tests.oracles import catalogue
from tests.oracles.differences import derivatives, plain
from tests.robots import of_table, robot, rows, samples, swept

SLICES: dict[Part, slice] = {"translation": slice(0, 3), "rotation": slice(3, 6)}
X = np.array([[1.0, 0.0, 0.0]])
every_robot = pytest.mark.parametrize("name", swept(catalogue.NAMES))


def arm(*lengths: float) -> RobotModel:
    """A planar arm of revolute joints."""
    return of_table(rows("standard", [(length, 0.0, 0.0, 0.0) for length in lengths], "R" * len(lengths)))


def at(machine: RobotModel, q: list[float] | Array, **options: Any) -> Manipulability:
    return manipulability(machine, machine.chain(None, None), np.array([q], dtype=float), **options)


def translation(machine: RobotModel, q: list[float] | Array, **options: Any) -> Ellipsoids:
    return at(machine, q, **options).parts["translation"]


def degrees(axis: Array) -> float:
    """Angle of an axis in the plane, in [0°, 180°)."""
    return float(np.degrees(np.arctan2(axis[1], axis[0])) % 180.0)


# The lecture


def test_item_49_the_velocity_ellipsoid_of_two_links() -> None:
    ellipse = translation(arm(1.0, 0.7), [0.3, 0.8])
    assert ellipse.sigmas[0] == pytest.approx([1.693355501046, 0.296540958658], abs=5e-13)
    assert degrees(ellipse.axes[0, :, 0]) == pytest.approx(129.959172237, abs=5e-10)


def test_item_50_the_force_ellipsoid_has_the_same_axes_and_reciprocal_semi_axes() -> None:
    ellipse = translation(arm(1.0, 0.7), [0.3, 0.8])
    assert 1.0 / ellipse.sigmas[0] == pytest.approx([0.590543450198, 3.372215442091], abs=5e-12)


def test_item_51_measures() -> None:
    ellipse = translation(arm(1.0, 0.7), [0.3, 0.8])
    sigmas = ellipse.sigmas[0]
    assert ellipse.measures[0] == pytest.approx(0.502149263630, abs=5e-13)
    assert ellipse.measures[0] == pytest.approx(0.7 * np.sin(0.8), abs=1e-15)
    assert ellipse.volumes[0] == pytest.approx(1.577548437624, abs=5e-13)
    assert sigmas[0] / sigmas[1] == pytest.approx(5.710359569578, abs=5e-12)
    assert sigmas[1] / sigmas[0] == pytest.approx(0.175120320851, abs=5e-13)


def test_item_51_transmission_ratios_along_x() -> None:
    velocities, forces = transmission_ratios(translation(arm(1.0, 0.7), [0.3, 0.8]), X, 1e-10)
    assert velocities[0, 0] == pytest.approx(0.382776864892, abs=5e-13)
    assert forces[0, 0] == pytest.approx(0.900055578539, abs=5e-13)


def test_item_51_the_teachers_remark_an_almost_stretched_arm_is_fast_sideways_and_strong_lengthwise() -> None:
    machine = arm(1.0, 0.7)
    ellipse = translation(machine, [0.3, 0.05])
    assert ellipse.sigmas[0] == pytest.approx([1.837903156868, 0.019035507044], abs=5e-13)
    assert degrees(ellipse.axes[0, :, 0]) == pytest.approx(108.612649959, abs=5e-10)
    assert degrees(ellipse.axes[0, :, 1]) == pytest.approx(18.612649959, abs=5e-10)
    tip = chain_jacobians(machine.chain(None, None).flat, np.array([[0.3, 0.05]]))[0][0]
    assert degrees(tip) == pytest.approx(18.368301810, abs=5e-10)


def test_item_51_the_best_posture_of_two_links_is_a_right_angle() -> None:
    machine = arm(1.0, 0.7)
    chain = machine.chain(None, None)
    angles = np.linspace(0.01, np.pi - 0.01, 2001)
    measures = manipulability(machine, chain, np.stack((0.0 * angles, angles), axis=1)).parts["translation"].measures
    assert angles[np.argmax(measures)] == pytest.approx(np.pi / 2, abs=2e-3)
    assert np.abs(translation(machine, [0.3, np.pi / 2], gradient=True).gradients).max() < 1e-15  # type: ignore[arg-type]


def test_item_51_the_isotropic_arm() -> None:
    sigmas = translation(arm(np.sqrt(2.0), 1.0), [0.3, np.radians(135.0)]).sigmas[0]
    assert sigmas == pytest.approx([1.0, 1.0], abs=1e-15)


def test_item_51_three_links() -> None:
    assert translation(arm(0.5, 0.4, 0.3), [0.2, 0.7, -0.4]).measures[0] == pytest.approx(0.179381922813, abs=5e-13)


def test_item_51_the_ur5() -> None:
    ellipsoid = translation(robot("ur5_dh"), [0.1, -1.2, 1.4, -0.7, 0.5, 0.3])
    assert ellipsoid.sigmas[0] == pytest.approx([0.788333144, 0.650798031, 0.265575803], abs=5e-10)
    assert ellipsoid.measures[0] == pytest.approx(0.136252512298, abs=5e-13)


def test_stretched_the_ellipse_is_a_segment_and_the_force_along_the_arm_unbounded() -> None:
    ellipse = translation(arm(1.0, 0.7), [0.3, 0.0], gradient=True)
    assert ellipse.sigmas[0, 1] == 0.0
    assert ellipse.ranks[0] == 1
    assert ellipse.measures[0] == 0.0
    along = np.array([[np.cos(0.3), np.sin(0.3), 0.0], [-np.sin(0.3), np.cos(0.3), 0.0]])
    assert np.abs(np.abs(ellipse.axes[0].T @ along.T) - [[0.0, 1.0], [1.0, 0.0]]).max() < 1e-15
    velocities, forces = transmission_ratios(ellipse, along, 1e-10)
    assert velocities[0].tolist() == [0.0, pytest.approx(ellipse.sigmas[0, 0])]
    assert np.isnan(forces[0, 0])
    assert forces[0, 1] == pytest.approx(1.0 / ellipse.sigmas[0, 0])
    assert ellipse.gradients is not None
    assert np.isnan(ellipse.gradients).all()


# Rounding

VANISHED = [
    ("planar_2r", None, None, [np.pi, 0.0], ("x",), [0.0]),
    ("planar_2r", None, None, [np.pi / 2, 0.0], ("y",), [0.0]),
    ("spherical_wrist", None, None, [0.3, np.pi, 0.2], ("z",), [0.0]),
    ("hextilt", "flying_arm_5__link_4", "flying_arm_5__gripper", [1.08], ("x", "z", "ry", "rz"), []),
    ("xarm7", "link6", "link_eef", [1.1], ("x", "z", "ry"), []),
    ("ur3_dh", "frame_4", "frame_3", [1.5706], ("x", "z", "ry"), []),
]


@pytest.mark.parametrize("tolerance", [1e-10, 1e-300])
@pytest.mark.parametrize(("name", "base", "tip", "q", "task", "semi_axes"), VANISHED)
def test_what_is_left_of_rows_that_vanish_is_no_ellipsoid(
    name: str, base: str, tip: str, q: list[float], task: Any, semi_axes: list[float], tolerance: float
) -> None:
    machine = robot(name)
    found = manipulability(machine, machine.chain(base, tip), np.array([q]), task=task, rank_tolerance=tolerance)
    ellipsoid = found.parts["translation"]
    assert ellipsoid.sigmas[0].tolist() == semi_axes
    forces = transmission_ratios(ellipsoid, np.eye(3)[[0, 2]], tolerance)[1]
    assert np.isnan(forces).all()


def test_a_force_that_no_joint_feels_is_unbounded_with_any_tolerance() -> None:
    along = np.array([[np.cos(0.3), np.sin(0.3), 0.0]])
    for tolerance in (1e-10, 1e-300):
        ellipse = translation(arm(1.0, 0.7), [0.3, 0.0], rank_tolerance=tolerance)
        velocities, forces = transmission_ratios(ellipse, along, tolerance)
        assert (ellipse.ranks[0], velocities[0, 0]) == (1, 0.0)
        assert np.isnan(forces[0, 0])


@pytest.mark.parametrize("length", [None, 1e-3, 1e3])
def test_numbers_of_a_description_that_are_rounded_do_not_fail_the_certificate(length: float | None) -> None:
    """At zero these rows are 3e-14, and what the structure calls no direction is as large."""
    machine = robot("anymal_c")
    chain = machine.chain("LH_hip_fixed", "RH_THIGH")
    found = manipulability(
        machine, chain, np.zeros((1, 3)), task=("x", "y", "rx", "ry", "rz"), characteristic_length=length
    )
    assert found.certificate.max_ellipsoid_error <= module.ELLIPSOID_TOLERANCE


# The axes of the tip


@every_robot
def test_in_the_tips_axes_everything_is_turned(name: str) -> None:
    """Whole ellipsoids are the same bodies; gradients, which have no axes, the same numbers."""
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, 2)
    base, tip = (
        manipulability(machine, chain, qs, reference=reference, gradient=True)
        for reference in ("local_world_aligned", "local")
    )
    R = chain_jacobians(chain.flat, qs)[1]
    for part, ours in tip.parts.items():
        theirs = base.parts[part]
        assert ours.sigmas == pytest.approx(theirs.sigmas, abs=1e-12)
        bodies = [(body.axes * body.sigmas[:, None, :] ** 2) @ body.axes.transpose(0, 2, 1) for body in (theirs, ours)]
        assert R.transpose(0, 2, 1) @ bodies[0] @ R == pytest.approx(bodies[1], abs=1e-11)
        assert ours.gradients == pytest.approx(theirs.gradients, abs=1e-9, nan_ok=True)


def test_rows_of_the_tips_axes() -> None:
    """Along the last link of the blackboard's arm the tip is as fast as the first one turned across: l₁ sin q₂."""
    ellipse = translation(arm(1.0, 0.7), [0.3, 0.8], task=("x",), reference="local", gradient=True)
    assert ellipse.sigmas[0] == pytest.approx([np.sin(0.8)], abs=1e-15)
    assert ellipse.gradients == pytest.approx(np.array([[0.0, np.cos(0.8)]]), abs=1e-15)


@pytest.mark.parametrize("task", [("x", "y"), ("x", "rz"), ("rz",)])
def test_vectors_of_the_combined_part_have_six_numbers(task: Any) -> None:
    combined = at(arm(1.0, 0.7), [0.3, 0.8], task=task, characteristic_length=0.5).parts["combined"]
    assert combined.space.spread(combined.axes[0].T).shape == (combined.space.dimension, 6)
    assert combined.space.spread(combined.space.basis.T).shape[1] == 6


# Structure


def test_directions_in_which_an_arm_never_moves_are_not_counted() -> None:
    planar = arm(1.0, 0.7).chain(None, None)
    assert space_of(planar, (0, 1, 2)).basis.T.tolist() == [[1, 0, 0], [0, 1, 0]]
    assert space_of(planar, (3, 4, 5)).basis.T.tolist() == [[0, 0, 1]]
    assert space_of(planar, (0,)).dimension == 1
    assert space_of(planar, (2,)).dimension == 0
    assert space_of(planar, tuple(range(6))).dimension == 2
    wrist = space_of(robot("spherical_wrist").chain(None, None), (0, 1, 2))
    assert (wrist.dimension, wrist.basis.shape) == (2, (3, 3))  # its tip keeps to a sphere


def test_a_plane_that_is_tilted_is_found() -> None:
    tilted = of_table(rows("modified", [(0.0, 0.6, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0), (0.7, 0.0, 0.0, 0.0)], "RRP"))
    chain = tilted.chain(None, None)
    normal = np.array([0.0, -np.sin(0.6), np.cos(0.6)])
    space = space_of(chain, (3, 4, 5))
    assert space.dimension == 1
    assert np.abs(space.basis[:, 0]) == pytest.approx(np.abs(normal))
    stretched = space_of(chain, tuple(range(6)), 2.0)
    assert stretched.basis.T @ stretched.basis == pytest.approx(np.eye(stretched.basis.shape[1]), abs=1e-15)
    assert np.abs(stretched.basis.T @ np.append(np.zeros(3), [0.0, np.cos(0.6), np.sin(0.6)])).max() < 1e-12


def test_a_chain_without_joints_has_no_axes() -> None:
    panda = robot("panda")
    chain = panda.chain("panda_link8", "panda_hand")
    result = manipulability(panda, chain, np.zeros((2, 0)), characteristic_length=0.3, gradient=True)
    assert {ellipsoids.sigmas.shape for ellipsoids in result.parts.values()} == {(2, 0)}
    bounds = joint_bounds(panda, chain)
    motions = limited_motion(result.parts["translation"], result.Js, bounds, np.eye(3))
    assert all(not motion.velocities.any() and np.isnan(motion.forces).all() for motion in motions)  # type: ignore[union-attr,arg-type]


@pytest.mark.parametrize("name", ["planar_2r", "scara", "asr_twodof", "spherical_wrist", "panda"])
def test_a_structure_that_is_missed_is_not_certified(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    right = space_of(chain, (3, 4, 5))
    wrong = module.Space(right.rows, right.basis[:, 1:], max(0, right.dimension - 1))
    monkeypatch.setattr(module, "space_of", lambda *_, **__: wrong)
    if wrong.dimension:
        with pytest.raises(CertificationFailed):
            manipulability(machine, chain, samples(chain, 5), task=["rx", "ry", "rz"])


def test_rows_of_a_task() -> None:
    q = samples(robot("ur5").chain(None, None), 1)[0]
    whole = at(robot("ur5"), q)
    some = at(robot("ur5"), q, task=["rz", "y", "x"], characteristic_length=0.5)
    J = whole.Js[0]
    assert some.parts["translation"].sigmas[0] == pytest.approx(np.linalg.svd(J[:2], compute_uv=False))
    assert some.parts["rotation"].sigmas[0] == pytest.approx([np.linalg.norm(J[5])])
    combined = np.linalg.svd(J[[0, 1, 5]] * [[1.0], [1.0], [0.5]], compute_uv=False)
    assert some.parts["combined"].sigmas[0] == pytest.approx(combined)
    assert "rotation" not in at(robot("ur5"), q, task=["x"]).parts
    inside = is_within_task(some.parts["translation"].space, np.eye(3))
    assert inside.tolist() == [True, True, False]
    with pytest.raises(InvalidField, match="task"):
        at(robot("ur5"), q, task=["x", "x"])


# Every robot


def jacobians_of(name: str, count: int) -> tuple[RobotModel, Chain, Array, Array]:
    machine = robot(name)
    chain = machine.chain(None, None)
    qs = samples(chain, count, seed=4)
    return machine, chain, qs, chain_jacobians(chain.flat, qs)[2]


def sphere(count: int) -> Array:
    directions = np.random.default_rng(5).normal(size=(count, 3))
    return np.asarray(directions / np.linalg.norm(directions, axis=1, keepdims=True))


@every_robot
def test_ellipsoids_are_where_brute_force_finds_their_surface(name: str) -> None:
    """In 4000 directions, the largest velocity component and the torque of a unit force are both |Jᵀu|."""
    machine, chain, qs, Js = jacobians_of(name, 3)
    result = manipulability(machine, chain, qs)
    directions = sphere(4000)
    for part, some in SLICES.items():
        ellipsoids = result.parts[part]
        for J, axes, sigmas in zip(Js, ellipsoids.axes, ellipsoids.sigmas, strict=True):
            assert np.abs(axes.T @ axes - np.eye(len(sigmas))).max(initial=0.0) < 1e-13
            widths = np.linalg.norm(directions @ J[some], axis=1)
            scale = max(1.0, sigmas.max(initial=0.0))
            claimed = np.linalg.norm(directions @ axes * sigmas, axis=1)
            assert np.abs(claimed - widths).max() < 1e-8 * scale
            if len(sigmas) and sigmas[0] > 0.0:
                best = directions[np.argmax(widths)]
                assert sigmas[0] >= widths.max() - 1e-9 * scale
                assert np.linalg.norm(best @ J[some]) > 0.99 * sigmas[0]
                assert np.linalg.norm(axes[:, 0] @ J[some]) == pytest.approx(sigmas[0], rel=1e-9)


@every_robot
def test_measures_are_those_of_the_kernel_and_of_the_determinant(name: str) -> None:
    machine, chain, qs, Js = jacobians_of(name, 5)
    result = manipulability(machine, chain, qs)
    for part, some in SLICES.items():
        ellipsoids = result.parts[part]
        if ellipsoids.space.dimension == 3:
            kernel = chain_measures(chain.flat, qs, np.arange(6)[some])[2]
            by_determinant = np.sqrt(np.maximum(np.linalg.det(Js[:, some] @ Js[:, some].transpose(0, 2, 1)), 0.0))
            scale = ellipsoids.sigmas[:, 0].max() ** 3
            assert np.abs(ellipsoids.measures - kernel).max() < 1e-12 * scale
            assert np.abs(ellipsoids.measures - by_determinant).max() < 1e-7 * scale


@every_robot
def test_transmission_ratios_reach_the_surface(name: str) -> None:
    machine, chain, qs, Js = jacobians_of(name, 2)
    result = manipulability(machine, chain, qs)
    directions = sphere(20)
    for part, some in SLICES.items():
        ellipsoids = result.parts[part]
        velocities, forces = transmission_ratios(ellipsoids, directions, 1e-10)
        for J, speeds, strengths in zip(Js[:, some], velocities, forces, strict=True):
            for u, speed, strength in zip(directions, speeds, strengths, strict=True):
                if np.isfinite(strength):
                    assert np.linalg.norm(J.T @ u * strength) == pytest.approx(1.0, rel=1e-6)
                else:
                    assert np.linalg.norm(J.T @ u) < 1e-9
                rates = np.linalg.lstsq(J, u, rcond=1e-10)[0]
                if np.linalg.norm(J @ rates - u) < 1e-8:
                    assert np.linalg.norm(rates) * speed == pytest.approx(1.0, rel=1e-6)
                else:
                    assert speed == 0.0


@every_robot
def test_gradients_are_differences_of_measures(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    q = samples(chain, 1, seed=6)[0]
    result = at(machine, q, gradient=True, characteristic_length=0.4)
    for part, ellipsoids in result.parts.items():
        sigmas = ellipsoids.sigmas[0]
        if not len(sigmas) or sigmas[-1] < 0.05 * sigmas[0]:
            continue

        def measures(qs: Array, part: Part = part) -> Array:
            return manipulability(machine, chain, qs, characteristic_length=0.4).parts[part].measures

        expected = np.array(derivatives(measures, q, plain))
        assert ellipsoids.gradients is not None
        assert np.abs(ellipsoids.gradients[0] - expected).max() < 1e-6 * max(1.0, sigmas[0] ** len(sigmas))


# Limits


def programme(J: Array, limits: Array, u: Array, *, alone: bool) -> float:
    """Largest speed along u, or largest component, by a linear programme over joint velocities and the speed."""
    n = len(limits)
    bounds = [*((-limit, limit) for limit in limits), (None, None)]
    rows_ = np.column_stack((J, -u)) if alone else np.append(u @ J, -1.0)[None]
    answer = linprog(np.append(np.zeros(n), -1.0), A_eq=rows_, b_eq=np.zeros(len(rows_)), bounds=bounds)
    return float(-answer.fun)


def force_programme(J: Array, limits: Array, u: Array) -> float:
    """Largest component along u of a force within the limits; NaN where there is no end."""
    answer = linprog(
        -u, A_ub=np.vstack((J.T, -J.T)), b_ub=np.concatenate((limits, limits)), bounds=[(None, None)] * len(u)
    )
    return float(-answer.fun) if answer.status == 0 else np.nan


LIMITED = ["panda", "ur5", "talos", "asr_twodof", "solo8", "a1", "tiago", "so100"]


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", LIMITED)
def test_polytopes_are_the_optima_of_linear_programmes(name: str) -> None:
    machine, chain, qs, Js = jacobians_of(name, 2)
    result = manipulability(machine, chain, qs)
    bounds = joint_bounds(machine, chain)
    directions = np.concatenate((np.eye(3), sphere(3)))
    for part, some in SLICES.items():
        for J, motion in zip(Js[:, some], limited_motion(result.parts[part], Js, bounds, directions), strict=True):
            assert motion.velocities is not None
            assert motion.forces is not None
            for u, velocity, force in zip(directions, motion.velocities, motion.forces, strict=True):
                assert velocity[0] == pytest.approx(programme(J, bounds.velocity, u, alone=True), rel=1e-6, abs=1e-6)
                assert velocity[1] == pytest.approx(programme(J, bounds.velocity, u, alone=False), rel=1e-6)
                torques = np.abs(J.T @ u)
                if np.isfinite(force[0]):
                    assert np.max(torques * force[0] / bounds.effort) == pytest.approx(1.0)
                else:
                    assert torques.max() < 1e-9
                assert force[1] == pytest.approx(force_programme(J, bounds.effort, u), rel=1e-6, nan_ok=True)


def planar_motion(q: list[float], velocity: list[float], effort: list[float]) -> tuple[Array, LimitedMotion]:
    result = at(robot("planar_3r"), q)
    bounds = JointBounds(np.array(velocity), np.array(effort))
    return result.Js[0, :2], limited_motion(result.parts["translation"], result.Js, bounds, X)[0]


@pytest.mark.parametrize("q", [[0.3, 0.8, -0.4], [0.0, np.pi / 2, 0.0], [1.0, 0.0, 0.7]])
def test_the_velocity_polygon_is_the_hull_of_all_corners_of_the_box(q: list[float]) -> None:
    limits = np.array([1.0, 2.0, 0.5])
    J, motion = planar_motion(q, limits.tolist(), [1.0] * 3)
    corners = np.array([J @ (limits * signs) for signs in product((-1.0, 1.0), repeat=3)])
    hull = ConvexHull(corners)
    assert motion.velocity_vertices is not None
    ours = motion.velocity_vertices[:, :2]
    assert sorted(np.round(ours, 9).tolist()) == sorted(np.round(corners[hull.vertices], 9).tolist())
    assert _area(ours) == pytest.approx(hull.volume)


@pytest.mark.parametrize("q", [[0.3, 0.8, -0.4], [1.0, 0.0, 0.7]])
def test_the_force_polygon_is_tight_at_each_vertex_and_holds_every_optimum(q: list[float]) -> None:
    limits = np.array([10.0, 5.0, 3.0])
    J, motion = planar_motion(q, [1.0] * 3, limits.tolist())
    assert motion.force_vertices is not None
    vertices = motion.force_vertices[:, :2]
    used = np.abs(vertices @ J) / limits
    assert used.max() < 1.0 + 1e-9
    assert (np.sum(used > 1.0 - 1e-9, axis=1) >= 2).all()
    for angle in np.linspace(0.0, np.pi, 25):
        u = np.array([np.cos(angle), np.sin(angle)])
        assert (vertices @ u).max() == pytest.approx(force_programme(J, limits, u), rel=1e-8)
    assert _area(vertices) > 0.0


def _area(vertices: Array) -> float:
    """Positive where they go round anticlockwise."""
    x, y = vertices.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2.0)


def test_a_stretched_arm_has_a_flat_velocity_polygon_and_no_force_polygon() -> None:
    J, motion = planar_motion([0.3, 0.0, 0.0], [1.0, 2.0, 0.5], [1.0] * 3)
    assert motion.velocity_vertices is not None
    assert motion.velocity_vertices.shape == (2, 3)
    assert np.linalg.norm(motion.velocity_vertices[0]) == pytest.approx(np.linalg.norm(J, axis=0) @ [1.0, 2.0, 0.5])
    assert motion.force_vertices is None


@pytest.mark.parametrize(
    ("lengths", "q", "corners"),
    [
        # The folded arm of equal links: the tip is on the first axis, which leaves rounding of its column.
        ((1.0, 1.0), [0.3, np.pi], 2),
        ((1.0, 0.7), [np.pi, 0.0], 2),
        ((0.5, 0.4, 0.0), [0.2, 0.9, 0.1], 4),
    ],
)
def test_columns_that_vanish_are_no_sides_of_a_polygon(
    lengths: tuple[float, ...], q: list[float], corners: int
) -> None:
    machine = arm(*lengths)
    result = at(machine, q)
    bounds = JointBounds(np.full(len(q), 1e3), np.full(len(q), 1e3))
    motion = limited_motion(result.parts["translation"], result.Js, bounds, X)[0]
    assert motion.velocity_vertices is not None
    assert len(motion.velocity_vertices) == corners


def test_missing_limits_are_no_limits_of_zero() -> None:
    machine = robot("planar_2r")
    result = at(machine, [0.3, 0.8])
    bounds = joint_bounds(machine, machine.chain(None, None))
    assert limited_motion(result.parts["translation"], result.Js, bounds, X) == [LimitedMotion(None, None, None, None)]


def test_work_on_polytopes_is_bounded() -> None:
    machine, chain, qs, _ = jacobians_of("panda", 1000)
    result = manipulability(machine, chain, qs)
    with pytest.raises(TooLarge, match="sets of joints"):
        limited_motion(result.parts["translation"], result.Js, joint_bounds(machine, chain), sphere(64))
