"""Workspaces by samples against exact ones, against differences of independent poses, and part by part."""

import itertools
import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from gelenk.dh.tables.convert import describe_dh
from gelenk.errors import CertificationFailed, InvalidField, TooLarge
from gelenk.kinematics.workspace import survey as survey_module, voxels as voxels_module
from gelenk.kinematics.workspace.dexterity import (
    Over,
    Spread,
    excluded,
    orientations,
    rotation_spiral,
    shares,
    sphere_spiral,
)
from gelenk.kinematics.workspace.sampling import Ranges, Sampling, joint_ranges
from gelenk.kinematics.workspace.survey import Survey, Workspace
from gelenk.kinematics.workspace.tip_motion import plane_axes
from gelenk.kinematics.workspace.voxels import NO_VOXELS, Grid, merged, voxel_table
from gelenk.kinematics.workspace.workspace import PART, Plane, SamplingPlan, Wish, plan, sampled
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.kinematics.test_jacobian import independent_poses
from tests.oracles import catalogue, wrist_shell
from tests.oracles.differences import aligned, derivatives
from tests.robots import reread, robot, rows, swept


def surveyed(machine: RobotModel, chain: Chain, wish: Wish) -> tuple[SamplingPlan, Workspace]:
    """All parts of a workspace, one after the other."""
    work, _ = plan(chain, wish)
    survey = Survey(work)
    for k in range(work.parts):
        survey.add(sampled((work, k)))
    return work, survey.result(machine, chain)


def planar(lengths: list[float], base: Array | None = None) -> RobotModel:
    """A planar arm."""
    table = rows("standard", [(length, 0.0, 0.0, 0.0) for length in lengths], "R" * len(lengths))
    return RobotModel(reread(describe_dh("arm", table if base is None else replace(table, base=base))))


def whole(machine: RobotModel, **wish: object) -> tuple[SamplingPlan, Workspace]:
    return surveyed(machine, machine.chain(None, None), Wish(**wish))  # type: ignore[arg-type]


# Planar arms, exactly


@pytest.mark.parametrize("lengths", [[1.0, 0.7], [1.0, 0.7, 0.2], [1.0, 0.2, 0.3], [0.5, 0.5, 0.5]], ids=str)
@pytest.mark.parametrize("sequence", ["random", "low_discrepancy"])
def test_a_planar_arm_fills_its_annulus(lengths: list[float], sequence: str) -> None:
    near, far = wrist_shell.annulus(lengths)
    work, found = whole(planar(lengths), kind="cloud", samples=100_000, sequence=sequence)
    assert found.points is not None
    assert found.reach is not None
    radii = np.hypot(found.points[:, 0], found.points[:, 1])
    assert found.reach == pytest.approx((radii.min(), radii.max()), abs=1e-12)
    assert near - 1e-12 <= radii.min() <= near + 0.02
    assert far - 0.01 <= radii.max() <= far + 1e-12
    area, cell = math.pi * (far**2 - near**2), work.grid.size**2
    assert work.grid.dimensions == 2
    assert found.inner * cell <= area <= len(found.voxels) * cell
    assert 0.5 * (found.inner + len(found.voxels)) * cell == pytest.approx(area, rel=0.03)
    assert found.late is not None
    assert found.late < 0.01


def test_the_measure_of_two_links_is_the_area_that_they_span() -> None:
    _, found = whole(planar([1.0, 0.7]), kind="cloud", samples=2000)
    assert found.points is not None
    assert found.measures is not None
    radii = np.hypot(found.points[:, 0], found.points[:, 1])
    cosines = (radii**2 - 1.0 - 0.49) / (2.0 * 0.7)
    assert found.points[:, 3] == pytest.approx(0.7 * np.sqrt(np.maximum(0.0, 1.0 - cosines**2)), abs=1e-7)
    assert found.measures.max == found.points[:, 3].max()
    assert found.measures.mean == pytest.approx(found.points[:, 3].mean())
    assert found.measures.joint_positions is not None
    assert abs(math.sin(found.measures.joint_positions[1])) * 0.7 == pytest.approx(found.measures.max)


def test_an_arm_in_a_tilted_plane_is_the_same_arm() -> None:
    base = np.eye(4)
    base[:3, :3], base[:3, 3] = Rotation.from_rotvec([0.4, -0.9, 0.3]).as_matrix(), [0.3, 0.2, 0.1]
    lengths = [0.5, 0.4, 0.3]
    flat_work, flat = whole(planar(lengths), kind="cloud", samples=5000)
    tilted_work, tilted = whole(planar(lengths, base), kind="cloud", samples=5000)
    assert flat.points is not None
    assert tilted.points is not None
    assert tilted_work.grid.dimensions == flat_work.grid.dimensions == 2
    assert tilted.points[:, 3] == pytest.approx(flat.points[:, 3], abs=1e-12)
    assert tilted.points[:, :3] == pytest.approx(flat.points[:, :3] @ base[:3, :3].T + base[:3, 3], abs=1e-12)
    assert len(tilted.voxels) == pytest.approx(len(flat.voxels), rel=0.15)
    centres = tilted_work.grid.centres(tilted.voxels.keys) - base[:3, 3]
    assert np.abs(centres @ base[:3, 2]).max() < 1e-12


# In space


def test_the_volume_of_a_ball_with_a_hole() -> None:
    slide = DhJoint("slide", "prismatic", 0.0, 0.0, 0.0, 0.0, 0.4, 1.0)
    turns = [DhJoint(name, "revolute", 0.0, alpha, 0.0, 0.0) for name, alpha in (("a", -math.pi / 2), ("b", 0.0))]
    lift = DhJoint("b", "revolute", 0.0, math.pi / 2, 0.0, 0.0)
    machine = RobotModel(reread(describe_dh("ball", DhTable("standard", (turns[0], lift, slide)))))
    work, found = whole(machine, kind="grid", samples=400_000, voxel_size=0.08)
    exact, cell = 4.0 / 3.0 * math.pi * (1.0 - 0.4**3), 0.08**3
    assert found.inner * cell < exact < len(found.voxels) * cell
    assert 0.5 * (found.inner + len(found.voxels)) * cell == pytest.approx(exact, rel=0.07)
    assert found.reach == pytest.approx((0.4, 1.0), abs=1e-4)
    assert found.bounds is not None
    assert found.bounds == pytest.approx(np.array([[-1.0] * 3, [1.0] * 3]), abs=0.01)
    radii = np.linalg.norm(work.grid.centres(found.voxels.keys), axis=1)
    diagonal = 0.5 * math.sqrt(3.0) * 0.08
    assert (radii > 0.4 - diagonal).all()
    assert (radii < 1.0 + diagonal).all()


def scara(lengths: tuple[float, float], stroke: float) -> RobotModel:
    turns = [
        DhJoint(name, "revolute", a, alpha, 0.0, 0.0)
        for name, a, alpha in zip("ab", lengths, (0.0, math.pi), strict=True)
    ]
    slide = DhJoint("slide", "prismatic", 0.0, 0.0, 0.0, 0.0, 0.05, 0.05 + stroke)
    return RobotModel(
        reread(describe_dh("scara", DhTable("standard", (*turns, slide, DhJoint("c", "revolute", 0.0, 0.0, 0.0, 0.0)))))
    )


def ball_arm(lengths: tuple[float, float], hand: float) -> RobotModel:
    """Shoulder and elbow, and a wrist whose three axes meet a hand's length before the tip."""
    half = math.pi / 2
    rows_ = [(0.0, half, 0.0, 0.0), (lengths[0], 0.0, 0.0, 0.0), (0.0, half, 0.0, half), (0.0, -half, lengths[1], 0.0)]
    table = rows("standard", [*rows_, (0.0, half, 0.0, 0.0), (0.0, 0.0, hand, 0.0)], "RRRRRR")
    return RobotModel(reread(describe_dh("arm", table)))


def disc(near: float, far: float) -> float:
    return math.pi * (far**2 - near**2)


def shell(near: float, far: float) -> float:
    return 4.0 / 3.0 * math.pi * (far**3 - near**3)


EXACT = [
    *((planar([a, b]), disc(abs(a - b), a + b)) for a, b in ((1.0, 0.7), (1.0, 0.95), (0.3, 0.1))),
    (planar([0.5, 0.4, 0.3]), disc(0.0, 1.2)),
    (planar([1.0, 0.2, 0.3]), disc(0.5, 1.5)),
    *(
        (scara((a, b), stroke), disc(a - b, a + b) * stroke)
        for a, b, stroke in ((0.325, 0.275, 0.2), (0.4, 0.2, 0.5), (0.3, 0.3, 0.1))
    ),
    *(
        (ball_arm((a, b), hand), shell(max(0.0, abs(a - b) - hand), a + b + hand))
        for a, b, hand in ((0.5, 0.4, 0.0), (0.5, 0.4, 0.1), (0.7, 0.3, 0.1))
    ),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("machine", "exact"), EXACT, ids=range(len(EXACT)))
@pytest.mark.parametrize("samples", [20_000, 300, 100_000])
@pytest.mark.parametrize("sequence", ["random", "low_discrepancy"])
def test_the_exact_volume_is_between_its_bounds(machine: RobotModel, exact: float, samples: int, sequence: str) -> None:
    """Also where the samples are far too few for the voxels."""
    for voxel_size in (None, 0.02, 0.05, 0.1, 0.2):
        _, found = whole(machine, kind="grid", samples=samples, voxel_size=voxel_size, sequence=sequence)
        lower, upper = found.volume
        assert lower <= exact <= upper, voxel_size
        if samples == 100_000 and voxel_size is None and found.voxels.keys[-1] >= 1 << 42:
            assert upper - lower < 0.8 * exact


def test_a_few_samples_bound_nothing() -> None:
    for samples in (1, 2, 3):
        lower, upper = whole(planar([1.0, 0.7]), kind="grid", samples=samples)[1].volume
        assert (lower, upper) == pytest.approx((0.0, math.pi * 1.7**2))


@pytest.mark.parametrize(
    "machine", [planar([1.0, 0.7]), scara((0.3, 0.2), 0.1), robot("panda")], ids=["2R", "SCARA", "7R"]
)
@pytest.mark.parametrize("kind", ["grid", "dexterity"])
def test_a_voxel_larger_than_the_arm_is_refused(machine: RobotModel, kind: str) -> None:
    reach = plan(machine.chain(None, None), Wish())[0].extent
    whole(machine, kind=kind, samples=100, voxel_size=reach)
    with pytest.raises(InvalidField, match=rf"larger than the arm: use at most {reach:.3g} m") as refused:
        whole(machine, kind=kind, samples=100, voxel_size=1.01 * reach)
    assert refused.value.field == "voxel_size"


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_measures_are_those_of_differences_of_independent_poses(name: str) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    work, motion = plan(chain, Wish(samples=3))
    qs = work.sampling.configurations(0, 3)
    poses = independent_poses(name, chain)
    positions, measures = work.measured(qs)
    assert positions == pytest.approx(poses(qs)[:, :3, 3], abs=1e-9)
    moving = motion.axes[:, : motion.dimensions]
    for q, measure in zip(qs, measures, strict=True):
        J = moving.T @ np.array(derivatives(poses, q, aligned)).T[:3]
        expected = np.prod(np.linalg.svd(J, compute_uv=False)) if motion.dimensions else 0.0
        assert measure == pytest.approx(expected, abs=1e-8)


def test_chosen_rows_of_the_jacobian() -> None:
    machine = robot("ur5")
    chain = machine.chain(None, None)
    work, _ = plan(chain, Wish(samples=4, directions=("x", "rz")))
    qs = work.sampling.configurations(0, 4)
    poses = independent_poses("ur5", chain)
    for q, measure in zip(qs, work.measured(qs)[1], strict=True):
        J = np.array(derivatives(poses, q, aligned)).T[[0, 5]]
        assert measure == pytest.approx(math.sqrt(np.linalg.det(J @ J.T)), abs=1e-8)


def test_a_chain_without_joints_and_one_that_goes_nowhere() -> None:
    machine = robot("panda")
    work, found = surveyed(machine, machine.chain("panda_link8", "panda_hand_tcp"), Wish(samples=10))
    assert (len(found.voxels), found.count) == (1, 10)
    assert found.measures is not None
    assert found.measures.max == 0.0
    assert work.notes == ("the tip does not move",)
    _, found = whole(robot("iris"), samples=10)
    assert found.measures is not None
    assert found.measures.max == 0.0


@pytest.mark.parametrize("scale", [1e-6, 1e5])
def test_arms_of_any_size(scale: float) -> None:
    base = np.eye(4)
    base[:3, :3] = Rotation.from_rotvec([0.4, -0.9, 0.3]).as_matrix()
    for lengths, place in (([1.0, 0.7, 0.2], None), ([1.0, 0.7], base)):
        _, found = whole(planar([scale * length for length in lengths], place), kind="grid", samples=5000)
        _, one = whole(planar(lengths, place), kind="grid", samples=5000)
        assert found.reach == pytest.approx((one.reach[0] * scale, one.reach[1] * scale))  # type: ignore[index]
        assert len(found.voxels) == pytest.approx(len(one.voxels), rel=0.05)


def test_thirty_two_joints() -> None:
    generator = np.random.default_rng(5)
    table = rows("standard", generator.uniform(-1.0, 1.0, (32, 4)).tolist(), "RRRP" * 8)
    machine = RobotModel(reread(describe_dh("snake", table)))
    work, found = whole(machine, samples=2000)
    assert found.count == 2000
    assert found.measures is not None
    assert found.certificate.max_measure_error < 1e-9 * found.measures.max
    assert work.grid.dimensions == 3


def test_a_tip_that_keeps_to_a_sphere_says_so() -> None:
    work, found = whole(robot("spherical_wrist"), samples=1000)
    assert "surface" in work.notes[0]
    assert found.reach == pytest.approx((0.1, 0.1), abs=1e-12)


@pytest.mark.parametrize("name", ["spherical_wrist", "double_pendulum_continuous"])
def test_a_measure_that_is_rounding_everywhere_is_zero(name: str) -> None:
    work, found = whole(robot(name), samples=500)
    assert work.is_singular
    assert found.measures is not None
    assert (found.measures.min, found.measures.mean, found.measures.max) == (0.0, 0.0, 0.0)
    assert (found.measures.position, found.measures.joint_positions) == (None, None)


def test_an_arm_that_its_ranges_keep_stretched_has_no_measure() -> None:
    stretched = {"ranges": {"joint_2": (0.0, 0.0)}, "samples": 100}
    assert whole(robot("planar_2r"), **stretched)[0].is_singular
    assert not whole(robot("planar_2r"), samples=100)[0].is_singular
    assert not whole(robot("panda"), directions=("x", "y", "z", "rx", "ry", "rz"), samples=100)[0].is_singular


def test_what_does_not_move_fills_nothing() -> None:
    machine = robot("panda")
    for plane in (None, Plane(np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.1)):
        work, found = surveyed(machine, machine.chain(None, "panda_link0"), Wish(samples=10, plane=plane))
        assert (found.count, len(found.voxels), work.grid.cell) == (10, 1, 0.0)


# Slices


@pytest.mark.parametrize(
    ("name", "normal", "what"),
    [
        ("planar_2r", [1.0, 0.0, 0.0], "a line"),
        ("planar_2r", [0.6, 0.0, 0.8], "a line"),
        ("planar_2r", [0.0, 0.0, 1.0], None),
        ("spherical_wrist", [1.0, 0.0, 0.0], "a curve"),
        ("double_pendulum_continuous", [0.6, 0.64, 0.48], "points"),
        ("panda", [1.0, 0.0, 0.0], None),
    ],
)
def test_a_slice_without_an_area_says_so(name: str, normal: list[float], what: str | None) -> None:
    plane = Plane(np.zeros(3), np.array(normal), 0.05)
    notes = [note for note in whole(robot(name), samples=500, plane=plane)[0].notes if "slice" in note]
    assert len(notes) == (what is not None)
    assert what is None or f"only in {what}" in notes[0]


def test_a_slice_holds_what_of_the_cloud_lies_in_it() -> None:
    normal = np.array([1.0, 2.0, 2.0]) / 3.0
    plane = Plane(np.array([0.1, 0.0, 0.3]), normal, 0.05)
    _, everything = whole(robot("panda"), samples=PART + 5000)
    work, found = whole(robot("panda"), samples=PART + 5000, plane=plane)
    assert everything.points is not None
    assert found.points is not None
    heights = (everything.points[:, :3] - plane.origin) @ normal
    assert np.array_equal(found.points, everything.points[np.abs(heights) <= 0.025])
    assert work.grid.dimensions == 2
    assert int(found.voxels.counts.sum()) == found.count == len(found.points)
    centres = work.grid.centres(found.voxels.keys)
    assert np.abs((centres - plane.origin) @ normal).max() < 1e-12


def test_a_slice_out_of_reach_is_empty() -> None:
    plane = Plane(np.array([0.0, 0.0, 50.0]), np.array([0.0, 0.0, 1.0]), 0.1)
    work, found = whole(robot("panda"), kind="grid", samples=1000, plane=plane)
    assert (found.count, found.bounds, found.reach, found.measures, found.late) == (0, None, None, None, None)
    assert found.voxel_rows(work).shape == (0, 5)


@pytest.mark.parametrize("normal", [*np.eye(3), *-np.eye(3), [0.6, 0.0, 0.8], [1 / 3, -2 / 3, 2 / 3]])
def test_the_axes_of_a_plane(normal: list[float]) -> None:
    axes = plane_axes(np.array(normal))
    assert axes.T @ axes == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    assert abs(axes[:, 2] @ normal) == pytest.approx(1.0)
    if max(np.abs(normal)) == 1.0:
        assert (axes[:, :2].sum(axis=0) == 1.0).all(), "along the base's axes, and never against them"


# Samples


def test_random_samples_are_one_stream_however_it_is_cut() -> None:
    ranges = Ranges(np.array([-1.0, 0.0, 2.0]), np.array([1.0, 5.0, 2.0]), ())
    sampling = Sampling(ranges, 1000, "random", 7)
    qs = np.random.default_rng(7).random((1000, 3)) * (ranges.upper - ranges.lower) + ranges.lower
    assert np.array_equal(sampling.configurations(0, 1000), qs)
    assert np.array_equal(sampling.configurations(613, 200), qs[613:813])
    assert np.array_equal(sampling.chosen(np.array([999, 0, 500])), qs[[999, 0, 500]])


@pytest.mark.parametrize("n", [1, 2, 3, 7])
def test_low_discrepancy_fills_boxes_more_evenly_than_chance(n: int) -> None:
    ranges = Ranges(np.zeros(n), np.ones(n), ())
    uneven = {}
    for sequence in ("random", "low_discrepancy"):
        qs = Sampling(ranges, 20_000, sequence, 3).configurations(0, 20_000)
        assert (qs >= 0.0).all()
        assert (qs < 1.0).all()
        places = np.floor(qs[:, [0, -1]] * 20).astype(int) @ np.array([20, 1])
        uneven[sequence] = np.bincount(places, minlength=400)[:: 21 if n == 1 else 1].std()
    assert uneven["low_discrepancy"] < 0.6 * uneven["random"]


def test_joints_without_limits() -> None:
    machine = robot("kinova")
    chain = machine.chain(None, None)
    ranges = joint_ranges(chain, {})
    free = ~np.isfinite(chain.lower)
    assert free.any()
    assert (ranges.lower[free] == -math.pi).all()
    assert (ranges.upper[free] == math.pi).all()
    assert (ranges.lower[~free] == chain.lower[~free]).all()
    assert ranges.notes == ()


@pytest.mark.parametrize(
    ("limits", "expected"),
    [
        ((-1e6, 1e6), (-1.0, 1.0)),
        ((0.0, 1e16), (0.0, 2.0)),
        ((-1e16, 0.5), (-1.5, 0.5)),
        ((0.1, 0.7), (0.1, 0.7)),
    ],
)
def test_a_sliding_joint_without_a_limit_is_moved_by_a_metre(
    limits: tuple[float, float], expected: tuple[float, float]
) -> None:
    urdf = f"""<robot name="r"><link name="a"/><link name="b"/><joint name="slide" type="prismatic"><parent link="a"/>
    <child link="b"/><axis xyz="1 0 0"/><limit lower="{limits[0]}" upper="{limits[1]}" effort="1" velocity="1"/></joint>
    </robot>"""
    chain = RobotModel(read_urdf(urdf)).chain(None, None)
    ranges = joint_ranges(chain, {})
    assert (ranges.lower[0], ranges.upper[0]) == expected
    assert len(ranges.notes) == (limits != expected)
    given = joint_ranges(chain, {"slide": (0.2, 0.3)})
    assert (given.lower[0], given.upper[0], given.notes) == (0.2, 0.3, ())


@pytest.mark.parametrize(
    "given", [{"nose": (0.0, 1.0)}, {"panda_joint1": (1.0, 0.0)}, {"panda_joint1": (-3.0, 0.0)}], ids=str
)
def test_ranges_that_cannot_be_taken(given: dict[str, tuple[float, float]]) -> None:
    with pytest.raises(InvalidField, match="joint_ranges"):
        joint_ranges(robot("panda").chain(None, None), given)


# Voxels


def test_a_table_is_what_counting_one_by_one_gives() -> None:
    generator = np.random.default_rng(0)
    positions, measures = generator.normal(size=(3000, 3)), generator.random(3000)
    grid = Grid(np.array([0.1, 0.2, 0.3]), np.eye(3), 3, 0.4)
    cells: dict[tuple[int, ...], list[int]] = {}
    for i, position in enumerate(positions):
        cells.setdefault(tuple(np.round((position - grid.origin) / grid.size).astype(int)), []).append(i)
    pieces = [slice(2000, 3000), slice(0, 700), slice(700, 2000)]
    table = merged([voxel_table(grid.keys(positions[part]), measures[part], np.arange(3000)[part]) for part in pieces])
    centres = grid.centres(table.keys)
    inner = grid.inner(table.keys)
    assert len(table) == len(cells)
    steps = list(itertools.product((-1, 0, 1), repeat=3))
    grown = set(map(tuple, np.round((grid.centres(grid.grown(table.keys)) - grid.origin) / grid.size).astype(int)))
    assert grown == {tuple(np.array(index) + step) for index in cells for step in steps}
    for row, centre in enumerate(centres):
        index = tuple(np.round((centre - grid.origin) / grid.size).astype(int))
        assert centre == pytest.approx(grid.origin + np.array(index) * grid.size, abs=1e-12)
        held = cells[index]
        assert (table.counts[row], table.first[row]) == (len(held), min(held))
        assert table.best[row] == measures[held].max()
        assert (table.keys[row] in inner) == all(tuple(np.array(index) + step) in cells for step in steps)
    assert len(merged([NO_VOXELS, NO_VOXELS])) == 0


def test_too_many_voxels_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(voxels_module, "MAX_VOXELS", 100)
    with pytest.raises(TooLarge):
        whole(robot("panda"), kind="grid", samples=1000)
    monkeypatch.setattr(survey_module, "_PENDING", 10)
    with pytest.raises(TooLarge):
        whole(robot("panda"), kind="grid", samples=1000, voxel_size=0.01)


def test_voxels_that_cannot_be_told_apart_are_refused() -> None:
    with pytest.raises(InvalidField, match="voxel_size"):
        whole(robot("panda"), kind="grid", samples=10, voxel_size=1e-7)


def test_a_sample_that_is_not_the_robots_is_never_sent() -> None:
    machine = robot("panda")
    chain = machine.chain(None, None)
    work, _ = plan(chain, Wish(samples=100))
    part = sampled((work, 0))
    assert part.points is not None
    part.points[0, 1] += 1e-6
    survey = Survey(work)
    survey.add(part)
    with pytest.raises(CertificationFailed):
        survey.result(machine, chain)


# Dexterity


def dexterous(machine: RobotModel, over: Over, count: int, **wish: object) -> tuple[Array, Array, Array]:
    """Centres of voxels, the share of orientations at each, and the orientations; shapes (M, 3), (M,), (K, 3, 3)."""
    chain = machine.chain(None, None)
    work, found = surveyed(machine, chain, Wish(kind="dexterity", **wish))  # type: ignore[arg-type]
    asked = orientations(chain, plan(chain, Wish(samples=1))[1], over, count)
    centres, seeds = work.grid.centres(found.voxels.keys), work.sampling.chosen(found.voxels.first)
    return centres, shares(machine, chain, centres, seeds, asked), asked.rotations


@pytest.mark.slow
@pytest.mark.parametrize("lengths", [[1.0, 0.7, 0.2], [1.0, 0.9, 0.5], [0.5, 0.5, 0.5], [1.0, 0.2, 0.3]], ids=str)
def test_the_share_of_orientations_of_three_planar_links(lengths: list[float]) -> None:
    """Against the wrist's annulus; where all are reached, that is WS₂, its inner disc included."""
    centres, found, Rs = dexterous(planar(lengths), "rotations", 24, samples=20_000, voxel_size=0.223)
    expected = wrist_shell.share(centres, lengths[2] * Rs[:, :, 0], np.zeros(3), (lengths[0], lengths[1]))
    assert found == pytest.approx(expected, abs=1e-9)
    inside = wrist_shell.secondary(lengths, np.linalg.norm(centres, axis=1))
    assert (found[inside] == 1.0).all()
    assert inside.any() == (lengths != [1.0, 0.2, 0.3])


@pytest.mark.quick(1)
@pytest.mark.parametrize("over", ["rotations", "approach_directions"])
def test_the_share_of_orientations_of_an_arm_with_a_wrist(over: Over) -> None:
    centres, found, Rs = dexterous(robot("anthropomorphic_wrist"), over, 12, samples=3000, voxel_size=0.41)
    expected = wrist_shell.share(centres, 0.1 * Rs[:, :, 2], np.array([0.0, 0.0, 0.3]), (0.5, 0.4))
    assert len(centres) > 50
    assert 0.0 < expected.mean() < 1.0
    assert found == pytest.approx(expected, abs=1e-9)


def generic(types: str) -> RobotModel:
    """An arm without a special geometry."""
    numbers = np.random.default_rng(len(types)).uniform(0.2, 1.2, (len(types), 4))
    return RobotModel(reread(describe_dh("arm", rows("standard", [tuple(row) for row in numbers.tolist()], types))))


@pytest.mark.parametrize(
    ("machine", "spread", "missing"),
    [
        (
            lambda: planar([1.0, 0.7]),
            "turns",
            "3 independent velocities of the tip are needed, 2 to move it and 1 to",
        ),
        (lambda: planar([1.0, 0.7, 0.3]), "turns", None),
        (lambda: scara((0.3, 0.2), 0.1), "turns", None),
        (lambda: robot("planar_2r"), "turns", "and the chain has 2"),
        (lambda: generic("RR"), "rotations", "5 independent velocities"),
        (lambda: generic("RRRR"), "rotations", "6 independent velocities"),
        (
            lambda: generic("RPRRR"),
            "rotations",
            "`approach_directions` needs only the tip's z axis, for which the chain has enough",
        ),
        (lambda: generic("RPRRR"), "approach_directions", None),
        (lambda: generic("RRRR"), "approach_directions", "5 independent velocities"),
        (lambda: generic("PRPP"), "rotations", "6 independent velocities"),
        (lambda: generic("PPP"), "fixed", None),
        (lambda: generic("RRRRRR"), "rotations", None),
        (lambda: ball_arm((0.5, 0.4), 0.1), "rotations", None),
        (lambda: robot("panda"), "rotations", None),
    ],
)
def test_what_excludes_dexterity_is_told(
    machine: Callable[[], RobotModel], spread: Spread, missing: str | None
) -> None:
    motion = plan(machine().chain(None, None), Wish())[1]
    reason = excluded(motion, motion.dimensions, spread)
    assert (reason is None) == (missing is None)
    assert missing is None or missing in str(reason)


def test_a_held_joint_is_none() -> None:
    arm = planar([1.0, 0.7, 0.3])
    motion = plan(arm.chain(None, None), Wish(ranges={"joint_2": (0.4, 0.4)}))[1]
    assert "and the chain has 2" in str(excluded(motion, motion.dimensions, "turns"))


def test_in_a_slice_fewer_velocities_are_needed() -> None:
    arm = generic("RRRRR")
    plane = Plane(np.zeros(3), np.array([0.0, 0.0, 1.0]), 0.1)
    work, motion = plan(arm.chain(None, None), Wish(plane=plane))
    assert excluded(motion, work.grid.dimensions, "rotations") is None
    assert excluded(motion, motion.dimensions, "rotations") is not None


def test_orientations_are_spread_evenly() -> None:
    directions = sphere_spiral(200)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(200))
    nearest = np.sort(directions @ directions.T, axis=1)[:, -2]
    assert np.degrees(np.arccos(nearest)).min() > 0.7 * np.degrees(math.sqrt(4.0 * math.pi / 200))
    anywhere = Rotation.random(2000, random_state=0).as_quat()
    spread = {"spiral": rotation_spiral(200), "random": Rotation.random(200, random_state=1).as_quat()}
    gaps = {}
    for name, some in spread.items():
        assert np.linalg.norm(some, axis=1) == pytest.approx(np.ones(200))
        gaps[name] = float(2.0 * np.arccos(np.clip(np.abs(anywhere @ some.T).max(axis=1), 0.0, 1.0)).max())
    assert gaps["spiral"] < 0.8 * gaps["random"]


def test_a_scara_is_asked_for_turns_and_a_slide_for_its_one_orientation() -> None:
    for name, spread, count in (("scara", "turns", 8), ("panda", "rotations", 8)):
        chain = robot(name).chain(None, None)
        asked = orientations(chain, plan(chain, Wish(samples=1))[1], "rotations", 8)
        assert (asked.spread, len(asked.rotations)) == (spread, count)
    chain = RobotModel(reread(describe_dh("slide", rows("standard", [(0.0, 0.3, 0.0, 0.0)], "P")))).chain(None, None)
    asked = orientations(chain, plan(chain, Wish(samples=1))[1], "rotations", 8)
    assert (asked.spread, len(asked.rotations)) == ("fixed", 1)
