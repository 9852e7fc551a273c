"""Trajectories of several segments: how they are joined, timed, stopped and refused."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp

from gelenk.errors import AuditFailed, InvalidField, OutsideLimits
from gelenk.ik.search.task import Task
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from gelenk.trajectory import plan as planning
from gelenk.trajectory.audit.audit import audit
from gelenk.trajectory.audit.demands import Demands, TipLimits, Zone
from gelenk.trajectory.audit.words import Law, OrientationLaw
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Following, Segment, SegmentLimits, Trajectory, TrajectoryProblem
from tests.robots import robot

PANDA = robot("panda")
ARM = PANDA.chain(None, None)
READY = np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785])
VELOCITY = np.array([2.175] * 4 + [2.61] * 3)
LIMITS = SegmentLimits(VELOCITY, 2.0 * VELOCITY, 20.0 * VELOCITY)
TIP = replace(LIMITS, tip=TipLimits(0.25, 0.8, 1.5, 4.0))


def pose(q: Array) -> Array:
    T: Array = Poses(*chain_poses(ARM.flat, q[None])).matrices()[0]
    return T


def moved(T: Array, x: float, y: float, z: float) -> Array:
    target = T.copy()
    target[:3, 3] += (x, y, z)
    return target


HERE = pose(READY)
SIDE = moved(HERE, 0.0, 0.3, 0.0)
ABOVE = moved(SIDE, 0.0, 0.0, 0.2)


def planned(*segments: Segment, following: Following | None = None, **options: object) -> Trajectory:
    problem = TrajectoryProblem(READY, segments, following or Following())
    return plan(PANDA, ARM, replace(problem, **options))  # type: ignore[arg-type]


def line(target: Array, law: Law = "trapezoidal", limits: SegmentLimits = LIMITS, **options: object) -> Segment:
    return Segment("line", law, limits, pose=target, **options)  # type: ignore[arg-type]


def joint(target: Array, law: Law = "trapezoidal", limits: SegmentLimits = LIMITS, **options: object) -> Segment:
    return Segment("joint", law, limits, configuration=target, **options)  # type: ignore[arg-type]


def arc(start: Array, share: float = 0.5, law: Law = "trapezoidal", **options: object) -> Segment:
    """Half a circle of 5 cm upwards, by a place at a share of it."""
    angle = share * np.pi
    via = moved(start, 0.05 * np.sin(angle), 0.0, 0.05 * (1.0 - np.cos(angle)))
    return Segment("circle", law, LIMITS, via=via, pose=moved(start, 0.0, 0.0, 0.1), **options)  # type: ignore[arg-type]


def check_smoothness(found: Trajectory) -> None:
    """The acceleration is continuous and the jerk within its limits, by the audit."""
    jump, jerk = found.audit.continuity.acceleration, found.audit.jerk
    assert jump is not None
    assert jump.value < 1e-6
    assert jerk is not None
    assert jerk.ratio is not None
    assert jerk.ratio <= 1.0 + 1e-9


def tip_at(found: Trajectory, times: Array) -> Poses:
    return Poses(*chain_poses(ARM.flat, found.motion.at(times)))


def speeds(found: Trajectory, report: int) -> Array:
    """Of the tip in a segment, by differences."""
    begin, end = found.segments[report].start_time, found.segments[report].end_time
    times = np.linspace(begin, end, 4001)
    step = 1e-6
    ahead, behind = (tip_at(found, np.clip(times + one, begin, end)).positions for one in (step, -step))
    rates: Array = np.linalg.norm(ahead - behind, axis=1)[1:-1] / (2.0 * step)
    return rates


def test_segments_follow_each_other_at_rest() -> None:
    found = planned(joint(READY + 0.1), line(HERE), joint(READY - 0.1, "quintic"))
    assert [report.index for report in found.segments] == [0, 1, 2]
    ends = [report.end_time for report in found.segments]
    assert [0.0, *ends[:-1]] == [report.start_time for report in found.segments]
    assert ends[-1] == found.motion.duration
    assert np.abs(found.motion.derivative().at(np.array([0.0, *ends]))).max() < 1e-12
    assert found.motion.at(np.array([ends[0]]))[0] == pytest.approx(READY + 0.1, abs=1e-12)
    assert found.completed_fraction == 1.0
    assert found.failure is None


def test_a_pose_is_reached_in_the_nearest_configuration() -> None:
    arm = robot("ur5")
    chain = arm.chain(None, None)
    start = np.array([0.4, -1.2, 1.4, -1.7, -1.4, 0.2])
    limits = SegmentLimits(np.full(6, 3.0), np.full(6, 6.0), np.full(6, 60.0))
    goal = start + 0.2
    T = Poses(*chain_poses(chain.flat, goal[None])).matrices()[0]
    found = plan(arm, chain, TrajectoryProblem(start, (Segment("joint", "cubic", limits, pose=T),)))
    assert found.motion.at(found.motion.breaks[-1:])[0] == pytest.approx(goal, abs=1e-9)


def test_a_pose_out_of_reach_ends_the_trajectory_before_it() -> None:
    far = Segment("joint", "cubic", LIMITS, pose=moved(HERE, 2.0, 0.0, 0.0))
    found = planned(joint(READY + 0.1), far, line(HERE))
    assert found.failure is not None
    assert (found.failure.reason, found.failure.segment) == ("out_of_reach", 1)
    assert found.failure.time == found.motion.duration == found.segments[0].end_time
    assert found.completed_fraction == pytest.approx(1 / 3)
    assert len(found.segments) == 1


def test_a_line_is_left_at_its_radius_and_no_further() -> None:
    radius = 0.08
    found = planned(line(SIDE, blend_radius=radius), line(ABOVE))
    assert [report.blended for report in found.segments] == [True, False]
    points = tip_at(found, np.linspace(0.0, found.motion.duration, 3000)).positions
    first = np.linalg.norm(np.cross(points - HERE[:3, 3], [0.0, 1.0, 0.0]), axis=1)
    second = np.linalg.norm(np.cross(points - SIDE[:3, 3], [0.0, 0.0, 1.0]), axis=1)
    away = np.minimum(first, second) > 1e-4
    assert np.linalg.norm(points[away] - SIDE[:3, 3], axis=1).max() <= radius + 1e-4
    # The parabola's nearest point to the corner is half way to the chord's middle: r/2 cos 45°.
    nearest = np.linalg.norm(points - SIDE[:3, 3], axis=1).min()
    assert nearest == pytest.approx(0.5 * radius * np.cos(np.pi / 4), abs=2e-4)
    assert np.linalg.norm(found.motion.derivative().at(np.array([found.segments[0].end_time]))) > 0.05


@pytest.mark.parametrize("law", ["trapezoidal", "time_optimal"])
def test_a_blend_of_a_given_time_is_the_course_s_fly_over(law: Law) -> None:
    speed, time = TIP.tip.speed, 0.4
    found = planned(line(SIDE, law, limits=TIP, blend_time=time), line(ABOVE, law, limits=TIP))
    blend = found.segments[0].blend
    assert blend is not None
    assert blend.radius == pytest.approx(0.5 * speed * time, rel=1e-12)
    assert blend.acceleration == pytest.approx(speed * np.sqrt(2.0) / time, rel=1e-12), "‖v K_BC - v K_AB‖ / ΔT"
    assert blend.end_time - blend.start_time == pytest.approx(time, rel=5e-3)
    # The way of constant acceleration, by the course's formula: p = A' + v K_AB t + (v K_BC - v K_AB) t² / 2ΔT.
    t = np.linspace(0.0, time, 50)[:, None]
    along, across = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    wanted = SIDE[:3, 3] + along * (speed * t - blend.radius) + speed * (across - along) * t**2 / (2.0 * time)
    times = np.linspace(blend.start_time, blend.end_time, 50)
    assert np.linalg.norm(tip_at(found, times).positions - wanted, axis=1).max() < 3e-4


@pytest.mark.quick(3)
@pytest.mark.parametrize("law", ["cubic", "trapezoidal", "jerk_limited", "time_optimal"])
@pytest.mark.parametrize("limits", [TIP, replace(LIMITS, tip=TipLimits(speed=0.25))], ids=["limits", "speed alone"])
def test_a_blend_keeps_to_its_acceleration(law: Law, limits: SegmentLimits) -> None:
    found = planned(line(SIDE, law, limits=limits, blend_acceleration=0.4), line(ABOVE, law, limits=limits))
    blend = found.segments[0].blend
    assert blend is not None
    assert blend.radius == pytest.approx(0.25**2 * np.sqrt(2.0) / 0.4 / 2.0, rel=1e-12)
    step = 1e-3
    times = np.linspace(blend.start_time + step, blend.end_time - step, 400)
    before, at, after = (tip_at(found, times + offset).positions for offset in (-step, 0.0, step))
    accelerations = np.linalg.norm(before - 2.0 * at + after, axis=1) / step**2
    assert accelerations.max() <= 0.4 * (1.0 + 1e-3)
    if law in {"trapezoidal", "time_optimal"}:
        assert accelerations.max() >= 0.4 * (1.0 - 1e-2), "and makes use of it"
    slowed = found.motion.duration * 1.5
    lasting = planned(
        *(line(SIDE, law, limits=limits, blend_acceleration=0.4), line(ABOVE, law, limits=limits)), duration=slowed
    )
    later = lasting.segments[0].blend
    assert later is not None
    assert later.start_time == pytest.approx(1.5 * blend.start_time, rel=1e-9)


@pytest.mark.parametrize("law", ["quintic", "septic", "jerk_limited"])
def test_smooth_laws_pass_a_corner_without_a_jump(law: Law) -> None:
    radius = 0.06
    found = planned(line(SIDE, law, blend_radius=radius), line(ABOVE, law))
    assert [report.law for report in found.segments] == [law, law]
    assert found.audit.passed
    check_smoothness(found)
    assert not any("curvature jumps" in note for report in found.segments for note in report.notes)
    points = tip_at(found, np.linspace(0.0, found.motion.duration, 3000)).positions
    nearest = np.linalg.norm(points - SIDE[:3, 3], axis=1).min()
    assert nearest == pytest.approx(0.375 * radius * np.cos(np.pi / 4), abs=2e-4)
    sharp = planned(line(SIDE, law), line(ABOVE, law))
    assert found.motion.duration < sharp.motion.duration, "sooner than with a stop"


@pytest.mark.quick(3)
@pytest.mark.parametrize("law", ["cubic", "quintic", "septic", "trapezoidal", "jerk_limited"])
@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_along_a_spline_a_law_slows_down_only_where_it_bends(law: Law, turn: float) -> None:
    waypoints = np.array([moved(HERE, 0.02, 0.1, 0.0), moved(HERE, 0.0, 0.1, 0.1), moved(HERE, 0.0, -0.1, 0.1)])
    waypoints[1:, :3, :3] = waypoints[1:, :3, :3] @ Rotation.from_rotvec([0.0, 0.0, turn]).as_matrix()
    poses = Poses(waypoints[:, :3, 3], waypoints[:, :3, :3])
    found, optimal = (planned(Segment("spline", one, LIMITS, poses=poses)) for one in (law, "time_optimal"))
    assert found.audit.passed
    assert found.motion.duration < 1.5 * optimal.motion.duration
    smooth = law in {"quintic", "septic", "jerk_limited"}
    assert found.segments[0].law == (law if smooth else "time_optimal")
    if smooth:
        check_smoothness(found)


def test_a_blend_beyond_its_acceleration_fails_the_audit() -> None:
    found = planned(line(SIDE, limits=TIP, blend_radius=0.08), line(ABOVE, limits=TIP))
    blend = found.segments[0].blend
    assert blend is not None
    assert blend.acceleration is None
    demands = Demands(tip=TIP.tip, zones=(Zone(blend.start_time, blend.end_time, TipLimits(acceleration=0.3)),))
    judged = audit(PANDA, ARM, found.motion, demands)
    assert [reason.check for reason in judged.reasons] == ["tip"]
    assert "the limit is 0.3 m/s²" in judged.reasons[0].detail
    ratio = judged.tip.acceleration.ratio
    assert ratio is not None
    assert ratio > 1.0
    stretch = Demands(tip=TIP.tip, zones=(Zone(blend.start_time, blend.end_time, TipLimits(acceleration=1.5)),))
    assert audit(PANDA, ARM, found.motion, stretch).passed


def test_blended_lines_keep_each_to_its_own_limits_of_the_tip() -> None:
    slow = replace(LIMITS, tip=TipLimits(0.05, 0.8, 1.5, 4.0))
    found = planned(line(SIDE, limits=TIP, blend_radius=0.05), line(ABOVE, limits=slow))
    assert speeds(found, 0).max() == pytest.approx(0.25, rel=1e-4)
    assert speeds(found, 1).max() == pytest.approx(0.05, rel=1e-4)


def test_tip_limits_slow_joints_down() -> None:
    free, limited = planned(joint(READY + 0.3)), planned(joint(READY + 0.3, limits=TIP))
    assert limited.motion.duration > free.motion.duration
    assert speeds(limited, 0).max() <= 0.25 * (1.0 + 1e-6)
    with pytest.raises(InvalidField, match=r"segments\.0\.duration.*the tip would be too fast"):
        planned(joint(READY + 0.3, limits=TIP, duration=free.motion.duration * 1.01))


@pytest.mark.parametrize("law", ["cubic", "trapezoidal", "time_optimal"])
def test_a_duration_of_the_whole_slows_all_down(law: Law) -> None:
    segments = (joint(READY + 0.1, law), line(HERE, law))
    least = planned(*segments)
    slowed = planned(*segments, duration=2.0 * least.motion.duration)
    assert slowed.motion.duration == pytest.approx(2.0 * least.motion.duration, rel=1e-12)
    assert slowed.audit.velocity is not None
    assert least.audit.velocity is not None
    assert abs(slowed.audit.velocity.value) == pytest.approx(0.5 * abs(least.audit.velocity.value), rel=1e-9)
    assert slowed.segments[0].end_time == pytest.approx(2.0 * least.segments[0].end_time, rel=1e-12)
    with pytest.raises(InvalidField, match=rf"duration.*no less than {least.motion.duration:.6g}"):
        planned(*segments, duration=0.99 * least.motion.duration)


def test_two_durations_contradict_each_other() -> None:
    with pytest.raises(InvalidField, match=r"segments\.0\.duration.*give one of them"):
        planned(joint(READY + 0.1, duration=3.0), duration=3.0)


def test_a_segment_lasts_as_long_as_it_is_to() -> None:
    found = planned(joint(READY + 0.1, duration=3.0), line(HERE, duration=4.0))
    assert [report.end_time for report in found.segments] == [3.0, 7.0]
    with pytest.raises(InvalidField, match=r"segments\.1\.duration.*must be at least"):
        planned(joint(READY + 0.1), line(HERE, duration=0.01))


def test_poses_are_passed_at_their_times() -> None:
    targets = [SIDE, ABOVE, moved(HERE, 0.1, 0.1, 0.1)]
    poses = Poses(np.array([T[:3, 3] for T in targets]), np.array([T[:3, :3] for T in targets]))
    times = np.array([2.0, 4.0, 6.5])
    found = planned(Segment("spline", "cubic", LIMITS, poses=poses, times=times))
    assert found.segments[0].law == "cubic"
    assert tip_at(found, times).positions == pytest.approx(poses.positions, abs=4e-5)
    assert found.motion.duration == 6.5
    with pytest.raises(InvalidField, match=r"segments\.0\.times.*multiply all times by"):
        planned(Segment("spline", "cubic", LIMITS, poses=poses, times=0.1 * times))
    with pytest.raises(InvalidField, match=r"segments\.0\.times.*go backwards along its path"):
        planned(Segment("spline", "cubic", LIMITS, poses=poses, times=np.array([0.1, 30.0, 30.2])))


def test_a_line_turns_about_one_axis_or_by_euler_angles() -> None:
    begin, target = pose(READY + 0.3), moved(pose(READY + 0.3), 0.1, 0.1, 0.0)
    target[:3, :3] = begin[:3, :3] @ Rotation.from_euler("xyz", [0.3, -0.3, 0.4]).as_matrix()

    def halfway(orientation: OrientationLaw) -> Array:
        problem = TrajectoryProblem(READY + 0.3, (line(target, "cubic", orientation=orientation),))
        found = plan(PANDA, ARM, problem)
        assert found.failure is None
        middle: Array = tip_at(found, np.array([0.5 * found.motion.duration])).rotations[0]
        return middle

    wanted = Slerp([0.0, 1.0], Rotation.from_matrix([begin[:3, :3], target[:3, :3]]))(0.5).as_matrix()
    assert Rotation.from_matrix(wanted.T @ halfway("axis_angle")).magnitude() < 1e-4
    angles = [Rotation.from_matrix(T[:3, :3]).as_euler("ZYZ") for T in (begin, target)]
    shorter = (angles[1] - angles[0] + np.pi) % (2.0 * np.pi) - np.pi
    by_angles = Rotation.from_euler("ZYZ", angles[0] + 0.5 * shorter).as_matrix()
    assert Rotation.from_matrix(by_angles.T @ halfway("zyz")).magnitude() < 1e-4
    assert Rotation.from_matrix(by_angles.T @ wanted).magnitude() > 1e-3


@pytest.mark.parametrize("kind", ["circle", "spline", "lines"])
def test_every_way_of_the_tip_turns_by_euler_angles(kind: str) -> None:
    begin = pose(READY + 0.3)
    turns = Rotation.from_euler("xyz", [[0.2, -0.1, 0.2], [0.3, -0.3, 0.4]]).as_matrix()
    via, end = moved(begin, 0.08, 0.05, 0.03), moved(begin, 0.1, 0.15, 0.0)
    via[:3, :3], end[:3, :3] = begin[:3, :3] @ turns

    def segments(orientation: OrientationLaw) -> tuple[Segment, ...]:
        if kind == "circle":
            return (Segment("circle", "cubic", LIMITS, via=via, pose=end, orientation=orientation),)
        if kind == "spline":
            both = np.array([via, end])
            poses = Poses(both[:, :3, 3].copy(), both[:, :3, :3].copy())
            return (Segment("spline", "cubic", LIMITS, poses=poses, orientation=orientation),)
        return (
            line(via, "cubic", blend_radius=0.02, orientation=orientation),
            line(end, "cubic", orientation=orientation),
        )

    found = {
        law: plan(PANDA, ARM, TrajectoryProblem(READY + 0.3, segments(law)))
        for law in ("axis_angle", "zyz", "zyz_other")
    }
    assert found["axis_angle"].failure is found["zyz"].failure is None
    assert found["zyz_other"].completed_fraction < 1.0, "the other triple is a turn of nearly π further"
    poses = {law: tip_at(one, np.linspace(0.0, one.motion.duration, 400)) for law, one in found.items()}
    for law in ("axis_angle", "zyz"):
        np.testing.assert_allclose(poses[law].matrices()[-1], end, atol=1e-6)
    triples = Rotation.from_matrix(poses["zyz"].rotations).as_euler("ZYZ")
    if kind != "lines":
        nearest = np.linalg.norm(poses["zyz"].positions - via[:3, 3], axis=1).argmin()
        at_via = Rotation.from_matrix(via[:3, :3]).as_euler("ZYZ")
        assert np.abs(triples[nearest] - at_via).max() < 0.01
    # Each angle is a function of the place alone, and it does not go back but over a corner or a bend of the spline.
    assert np.abs(np.diff(triples, axis=0)).max() < 0.02
    axis_angle = Rotation.from_matrix(poses["axis_angle"].rotations).as_euler("ZYZ")
    assert np.abs(axis_angle - triples).max() > 1e-3, "another way"


def test_two_timings_are_compared_on_request() -> None:
    blended = (line(SIDE, "cubic", blend_radius=0.05), line(ABOVE, "cubic"))
    found = planned(joint(READY + 0.1, "cubic"), line(HERE, "cubic"), *blended, compares_timing=True)
    assert [timing.segments for timing in found.timing] == [(0,), (1,), (2, 3)]
    for timing, begin, end in zip(found.timing, (0, 1, 2), (0, 1, 3), strict=True):
        lasts = found.segments[end].end_time - found.segments[begin].start_time
        # Along blended lines the motion slows down at the corner, not everywhere like the scaled law.
        expected = timing.time_optimal_duration if end == 3 else timing.uniform_duration
        assert expected == pytest.approx(lasts, rel=1e-9)
        assert timing.time_optimal_duration < timing.uniform_duration
        k = max(timing.velocity_factor, np.sqrt(timing.acceleration_factor))
        assert timing.uniform_duration == pytest.approx(k, rel=1e-6)


def test_nothing_to_do_takes_no_time() -> None:
    found = planned(line(HERE), joint(READY))
    assert found.motion.duration == 0.0
    assert found.motion.at(np.zeros(1))[0] == pytest.approx(READY, abs=1e-15)
    assert found.completed_fraction == 1.0
    assert found.audit.passed


def test_waypoints_are_passed_beside_and_the_answer_says_how_far() -> None:
    waypoints = READY + np.array([[0.3] * 7, [-0.2] * 7, [0.1] * 7])
    segment = Segment("spline", "trapezoidal", LIMITS, configurations=waypoints, blends=True)
    found = planned(segment)
    assert "pass beside" in found.segments[0].notes[0]
    told = float(found.segments[0].notes[0].split(" by ")[1].split()[0])
    qs = found.motion.at(np.linspace(0.0, found.motion.duration, 20_001))
    gaps = [np.abs(qs - waypoint).max(axis=1).min() for waypoint in waypoints[:-1]]
    assert 0.0 < max(gaps) <= told * (1.0 + 1e-5)
    assert qs[-1] == pytest.approx(waypoints[-1], abs=1e-12)


def test_a_spline_that_swings_beyond_a_limit_ends_at_an_earlier_waypoint() -> None:
    lower, upper = ARM.lower, ARM.upper
    waypoints = np.array([READY] * 4)
    waypoints[:, 0] = [0.5, upper[0] - 0.05, upper[0] - 0.06, -2.0]
    found = planned(Segment("spline", "cubic", LIMITS, configurations=waypoints))
    assert found.failure is not None
    assert (found.failure.reason, found.failure.joint) == ("joint_limit", "panda_joint1")
    assert 0.0 < found.completed_fraction < 1.0
    qs = found.motion.at(np.linspace(0.0, found.motion.duration, 2001))
    assert (qs <= upper + 1e-9).all()
    assert (qs >= lower - 1e-9).all()
    done = round(found.completed_fraction * len(waypoints))
    assert qs[-1] == pytest.approx(waypoints[done - 1], abs=1e-9)


@pytest.mark.parametrize(
    ("segments", "field", "reason"),
    [
        ((line(SIDE, blend_radius=0.1),), "segments.0.blend_radius", "only into one that follows"),
        ((line(SIDE, blend_radius=0.1), joint(READY)), "segments.0.blend_radius", "only into one that follows"),
        ((line(SIDE, blend_radius=0.1), line(HERE)), "segments.0.blend_radius", "turns back"),
        ((line(SIDE, blend_radius=0.31), line(ABOVE)), "segments.0.blend_radius", "0.3 m long"),
        ((line(SIDE, blend_radius=0.25), line(ABOVE)), "segments.0.blend_radius", "segment 1 is 0.2 m long"),
        (
            (line(SIDE, blend_radius=0.1), line(ABOVE, blend_radius=0.15), line(moved(ABOVE, 0.2, 0, 0))),
            "segments.1.blend_radius",
            "with the blend before",
        ),
        ((line(SIDE, blend_radius=0.1), line(ABOVE, "cubic")), "segments.0.law", "share one law"),
        ((line(SIDE, blend_radius=0.1, duration=2.0), line(ABOVE)), "segments.0.duration", "timed together"),
        ((line(SIDE, blend_time=0.1), line(ABOVE)), "segments.0.blend_time", "tip_velocity"),
        ((line(SIDE, blend_radius=0.1), arc(SIDE)), "segments.0.blend_radius", "has 0.0785398 m to its `via`"),
        (
            (line(SIDE, blend_radius=0.08), arc(SIDE, 0.9)),
            "segments.0.blend_radius",
            "a quarter of its circle",
        ),
        ((arc(HERE, blend_radius=0.2), line(ABOVE)), "segments.0.blend_radius", "segment 0 is 0.15708 m long"),
        (
            (line(SIDE, blend_radius=0.16, orientation="zyz_other"), line(ABOVE)),
            "segments.0.blend_radius",
            "segment 0 turns by more than 180°",
        ),
        ((line(SIDE, blend_radius=0.1), line(SIDE)), "segments.1.target", "share one position"),
        ((joint(READY + 9.0),), "segments.0.target", "joint panda_joint1 at 9 is outside its limits"),
        (
            (Segment("circle", "cubic", LIMITS, via=moved(HERE, 0.0, 0.1, 0.0), pose=SIDE),),
            "segments.0.via",
            "lie on one line",
        ),
    ],
)
def test_what_makes_no_sense_is_refused_by_name(segments: tuple[Segment, ...], field: str, reason: str) -> None:
    with pytest.raises(InvalidField) as refused:
        planned(*segments)
    assert refused.value.field == field
    assert reason in refused.value.reason


def test_a_start_outside_limits_is_refused() -> None:
    with pytest.raises(OutsideLimits, match="panda_joint1"):
        plan(PANDA, ARM, TrajectoryProblem(READY + 9.0, (joint(READY),)))


def test_damping_states_what_it_costs() -> None:
    arm = robot("planar_2r")
    chain = arm.chain(None, None)
    limits = SegmentLimits(np.full(2, 3.0), np.full(2, 6.0), np.full(2, 60.0))
    # Past the base at 0.35 m, where 0.3 m is the nearest that links of 1 and 0.7 m allow.
    T = Poses(*chain_poses(chain.flat, np.array([[0.0, 2.4]]))).matrices()[0]
    start = np.array([np.arcsin(0.35 / np.hypot(*T[:2, 3])) - np.arctan2(T[1, 3], T[0, 3]), 2.4])
    T = Poses(*chain_poses(chain.flat, start[None])).matrices()[0]
    through = moved(T, -2.0 * T[0, 3], 0.0, 0.0)
    xy = Following(task=Task(("x", "y")), min_singular_value=0.3)
    problem = TrajectoryProblem(start, (Segment("line", "cubic", limits, pose=through),), xy)
    stopped = plan(arm, chain, problem)
    assert stopped.failure is not None
    assert stopped.failure.reason == "singularity"
    slow = plan(arm, chain, replace(problem, following=replace(xy, near_singularity="slow_down")))
    assert slow.failure is None
    damped = plan(arm, chain, replace(problem, following=replace(xy, near_singularity="damp")))
    cost = damped.segments[0].joint_deviation
    assert cost is not None
    assert cost.distance > xy.position_tolerance
    assert damped.audit.path_deviation is not None
    assert damped.audit.path_deviation.value == pytest.approx(cost.distance, rel=0.05)


def test_a_motion_that_fails_its_audit_is_withheld(monkeypatch: pytest.MonkeyPatch) -> None:
    def spoilt(motion: PiecewisePolynomial) -> PiecewisePolynomial:
        coefficients = motion.coefficients.copy()
        coefficients[-1, 0] += 1e-6
        return PiecewisePolynomial(motion.breaks, coefficients)

    monkeypatch.setattr(planning, "audit", lambda arm, chain, motion, wish: audit(arm, chain, spoilt(motion), wish))
    with pytest.raises(AuditFailed, match="position jumps"):
        planned(joint(READY + 0.1))
