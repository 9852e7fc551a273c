"""Bang-coast-bang: the lecture's numbers, every branch, and motions that keep what they promise."""

import numpy as np
import pytest

from gelenk.course.motion.check import MotionClaims, certified
from gelenk.course.motion.trapezoid_steps import blend_steps, trapezoid_steps
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.trajectory.joints.parabolic_blends import with_accelerations, with_blend_times
from gelenk.trajectory.laws.trapezoid import JointMove, PointToPoint, fastest, lasting, point_to_point
from gelenk.trajectory.motion.extremes import peaks


def printed(value: float, text: str) -> bool:
    """Whether a number is the printed one, to its last digit."""
    decimals = len(text.partition(".")[2])
    return abs(value - float(text)) <= 0.5000001 * 10.0**-decimals


def shortest(distance: float, v_i: float, v_f: float, v_max: float, a: float) -> float:
    """The least time from (0, v_i) to (L, v_f): over both orders of speeding up and slowing down, by brute algebra."""
    times = []
    for sign in (1.0, -1.0):
        L, u, w = sign * distance, sign * v_i, sign * v_f
        squared = a * L + 0.5 * (u * u + w * w)
        for v in {v_max, np.sqrt(squared) if squared >= 0.0 else v_max}:
            if v > v_max or v < max(u, w) - 1e-12:
                continue
            t1, t3 = (v - u) / a, (v - w) / a
            rest = L - 0.5 * (u + v) * t1 - 0.5 * (v + w) * t3
            t2 = rest / v if v > 0.0 else 0.0
            if t1 >= -1e-9 and t3 >= -1e-9 and t2 >= -1e-9:
                times.append(t1 + max(t2, 0.0) + t3)
    return min(times)


def course(distance: float, v_i: float = 0.0, v_f: float = 0.0) -> JointMove:
    """The lecture's limits."""
    return JointMove(distance, v_i, v_f, 0.8, 1.6)


def driven(
    starts: Array, tasks: list[JointMove], duration: float | None = None, may_reverse: bool = False
) -> PointToPoint:
    """A plan that has been checked against what was asked of it."""
    plan = point_to_point(starts, tasks, duration, may_reverse=may_reverse)
    ends = starts + [task.distance for task in tasks]
    starting, ending = (np.array([[getattr(task, f"{end}_velocity") for task in tasks]]) for end in ("start", "end"))
    motion = plan.motion
    found = {order: peaks(motion, order) for order in (1, 2, 3)}
    promise = MotionClaims(motion.breaks[[0, -1]], np.array([starts, ends]), starting, ending, 1, found)
    certified(motion, promise)
    assert np.abs(motion.at(motion.breaks[[0, -1]]) - [starts, ends]).max() < 1e-9 * max(1.0, np.abs(ends).max())
    for j, task in enumerate(tasks):
        assert abs(found[1].values[j]) <= task.max_velocity * (1.0 + 1e-9)
        assert abs(found[2].values[j]) <= task.acceleration * (1.0 + 1e-9)
    return plan


# From rest to rest


def test_with_a_coast() -> None:
    plan = driven(np.zeros(1), [course(2.0)])
    assert plan.profiles[0].first == pytest.approx(0.5)
    assert plan.motion.duration == pytest.approx(3.0)
    assert plan.motion.at(np.array([0.25, 1.5, 2.8]))[:, 0] == pytest.approx([0.05, 1.0, 1.968], abs=1e-14)
    assert plan.motion.breaks == pytest.approx([0.0, 0.5, 2.5, 3.0])


def test_without_a_coast() -> None:
    profile = fastest(course(0.3))
    assert printed(profile.first, ".433012701892")
    assert printed(profile.duration, ".866025403784")
    assert printed(profile.peak_velocity, ".692820323028")
    assert profile.coast == 0.0
    assert len(driven(np.zeros(1), [course(0.3)]).motion.breaks) == 3


def test_at_the_limit_of_both() -> None:
    profile = fastest(course(0.4))
    assert profile.duration == pytest.approx(1.0, abs=1e-14)
    assert profile.coast == pytest.approx(0.0, abs=1e-14)


def test_no_distance_takes_no_time() -> None:
    plan = driven(np.array([0.7]), [course(0.0)])
    assert plan.motion.duration == 0.0
    assert plan.motion.at(np.zeros(1))[0, 0] == 0.7
    assert peaks(plan.motion, 1).values[0] == 0.0


def test_a_negative_distance_is_the_positive_one_mirrored() -> None:
    there, back = driven(np.zeros(1), [course(2.0)]), driven(np.zeros(1), [course(-2.0)])
    assert np.array_equal(there.motion.breaks, back.motion.breaks)
    assert np.array_equal(there.motion.coefficients, -back.motion.coefficients)


def test_in_a_given_time() -> None:
    profile = lasting(course(2.0), 3.5)
    assert profile is not None
    assert printed(profile.first, ".403708798216")
    assert printed(profile.peak_velocity, ".645934077146")
    assert driven(np.zeros(1), [course(2.0)], 3.5).motion.duration == pytest.approx(3.5, abs=1e-14)


def test_the_least_time_without_a_limit_of_the_velocity() -> None:
    task = JointMove(2.0, 0.0, 0.0, np.inf, 1.6)
    least = 2.0 * np.sqrt(2.0 / 1.6)
    assert fastest(task).duration == pytest.approx(least)
    with pytest.raises(InvalidField, match=r"'duration': joint 1 needs at least 2\.236"):
        point_to_point(np.zeros(1), [task], 0.999 * least)
    assert driven(np.zeros(1), [task], least).profiles[0].coast == pytest.approx(0.0, abs=1e-7)


# With end velocities


@pytest.mark.parametrize(
    ("distance", "times", "peak", "duration"),
    [
        (2.0, (".3125", "2.0390625", ".4375"), ".8", "2.7890625"),
        (0.1, (".098910980935", "0", ".223910980935"), ".458257569496", ".322821961869"),
    ],
)
def test_end_velocities(distance: float, times: tuple[str, str, str], peak: str, duration: str) -> None:
    profile = fastest(course(distance, 0.3, 0.1))
    for value, text in zip((profile.first, profile.coast, profile.last), times, strict=True):
        assert printed(value, text)
    assert printed(profile.peak_velocity, peak)
    assert printed(profile.duration, duration)
    driven(np.zeros(1), [course(distance, 0.3, 0.1)])


def test_from_a_negative_position_with_end_velocities() -> None:
    plan = driven(np.array([-2.0]), [JointMove(3.0, 0.5, 1.0, 2.0, 3.0)])
    assert printed(plan.motion.duration, "1.770833333")


def test_infeasible_end_velocities_are_named_with_what_is_feasible() -> None:
    with pytest.raises(InvalidField) as caught:
        point_to_point(np.zeros(1), [course(0.02, 0.3, 0.1)])
    assert caught.value.field == "start_velocity"
    assert "needs a distance of |v_i² - v_f²|/2a = 0.025, and there is 0.02" in caught.value.reason
    for tried in (
        JointMove(0.02, 0.3, 0.1, 0.8, 2.0),
        course(0.02, np.sqrt(0.074), 0.1),
        course(0.02, 0.3, np.sqrt(0.026)),
    ):
        driven(np.zeros(1), [tried])
    for text in (
        "acceleration of at least 2,",
        "at most 0.2720294102 at the start",
        "at least 0.1612451550 at the end",
    ):
        assert text.replace("1550", "155") in caught.value.reason


def test_what_is_infeasible_straight_can_be_done_turning_back() -> None:
    plan = driven(np.zeros(1), [course(0.02, 0.3, 0.1)], may_reverse=True)
    assert plan.profiles[0].reverses
    assert plan.motion.at(np.linspace(0.0, plan.motion.duration, 200)).max() > 0.02
    assert plan.motion.duration == pytest.approx(shortest(0.02, 0.3, 0.1, 0.8, 1.6))


@pytest.mark.parametrize("field", ["start_velocity", "end_velocity"])
def test_a_velocity_away_from_the_target_or_beyond_its_limit(field: str) -> None:
    for velocity, reason in ((-0.1, "leads away"), (0.9, "beyond the limit of 0.8")):
        rates = (velocity, 0.0) if field == "start_velocity" else (0.0, velocity)
        with pytest.raises(InvalidField, match=reason) as caught:
            point_to_point(np.zeros(1), [course(2.0, *rates)])
        assert caught.value.field == field


def test_a_duration_too_long_to_go_straight() -> None:
    with pytest.raises(InvalidField, match=r"at most 0\.6909830056 s without turning back"):
        point_to_point(np.zeros(1), [JointMove(0.5, 1.0, 1.0, 2.0, 1.6)], 5.0)
    edge = driven(np.zeros(1), [JointMove(0.5, 1.0, 1.0, 2.0, 1.6)], 0.6909830056)
    assert edge.profiles[0].peak_velocity == pytest.approx(np.sqrt(0.2), abs=1e-4)


@pytest.mark.slow
def test_a_thousand_random_joints_with_end_velocities() -> None:
    rng = np.random.default_rng(44)
    coasts = turns = 0
    for _ in range(1000):
        v_max, a = 10.0 ** rng.uniform(-1.0, 1.0, 2)
        v_i, v_f = rng.uniform(-v_max, v_max, 2) * rng.integers(0, 2, 2)
        task = JointMove(
            float(rng.normal() * 10.0 ** rng.uniform(-2, 1)), float(v_i), float(v_f), float(v_max), float(a)
        )
        plan = driven(rng.normal(size=1), [task], may_reverse=True)
        profile = plan.profiles[0]
        assert profile.duration == pytest.approx(shortest(task.distance, v_i, v_f, v_max, a), rel=1e-9)
        fine = np.linspace(0.0, plan.motion.duration, 300)
        velocities = plan.motion.derivative().at(fine)[:, 0]
        assert np.abs(velocities).max() <= v_max * (1.0 + 1e-9)
        steps = np.diff(velocities) / np.diff(fine)
        assert np.abs(steps).max() <= a * (1.0 + 1e-6)
        coasts += profile.coast > 0.0
        turns += profile.reverses
    assert 100 < coasts < 900
    assert turns > 100


# Several joints


def test_the_exam_of_two_joints() -> None:
    tasks = [JointMove(-1.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.0, 0.0, 0.8, 0.5)]
    plan = driven(np.zeros(2), tasks)
    assert printed(plan.own[0].duration, "2.625")
    assert printed(plan.own[1].duration, "2.366431913240")
    assert plan.factors[0] == 1.0
    assert plan.factors[1] == pytest.approx(2.625 / 2.366431913240)
    assert printed(plan.profiles[1].peak_velocity, ".533333333")
    assert printed(plan.profiles[1].acceleration, ".406349206")
    assert plan.motion.duration == pytest.approx(2.625)


@pytest.mark.slow
def test_a_thousand_random_arms_end_together() -> None:
    rng = np.random.default_rng(47)
    for i in range(1000):
        n = int(rng.integers(1, 8))
        limits = 10.0 ** rng.uniform(-0.5, 0.5, (2, n))
        distances = rng.normal(size=n) * (rng.random(n) > 0.2)
        tasks = [JointMove(float(d), 0.0, 0.0, float(v), float(a)) for d, v, a in zip(distances, *limits, strict=True)]
        v, a, L = limits[0], limits[1], np.abs(distances)
        alone = np.where(v * v / a < L, (L * a + v * v) / (a * v), 2.0 * np.sqrt(L / a))
        duration = float(alone.max() * rng.uniform(1.0, 2.0)) if i % 2 else None
        plan = driven(rng.normal(size=n), tasks, duration)
        assert plan.motion.duration == pytest.approx(duration or alone.max(), rel=1e-12)
        for profile, distance in zip(plan.profiles, distances, strict=True):
            assert profile.duration == pytest.approx(plan.motion.duration) or distance == 0.0
        last = plan.motion.derivative().at(plan.motion.breaks[-1:])
        assert np.abs(last).max() < 1e-9


def test_in_step_a_moving_joint_keeps_its_end_velocities() -> None:
    tasks = [JointMove(5.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.1, 0.2, 0.8, 0.5), JointMove(0.0, 0.0, 0.0, 1.0, 1.0)]
    plan = driven(np.zeros(3), tasks)
    assert plan.factors == (1.0, None, None)
    assert plan.profiles[1].acceleration == 0.5


def test_a_moving_joint_that_cannot_wait_is_named() -> None:
    with pytest.raises(InvalidField, match="joint 2 with its end velocities takes at most"):
        point_to_point(np.zeros(2), [JointMove(9.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.7, 0.7, 0.8, 0.5)])
    plan = driven(
        np.zeros(2), [JointMove(9.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.7, 0.7, 0.8, 0.5)], may_reverse=True
    )
    assert plan.profiles[1].reverses


def test_the_course_path_of_a_line() -> None:
    """A line in space, driven by its length."""
    start, end = np.array([0.4, -0.2, 0.3]), np.array([0.6, 0.5, 0.1])
    L = float(np.linalg.norm(end - start))
    plan = driven(np.zeros(1), [JointMove(L, 0.0, 0.0, 0.5, 1.0)])
    assert printed(plan.motion.duration, "2.009966887054")
    point = start + (end - start) * plan.motion.at(np.array([0.7]))[0, 0] / L
    for value, text in zip(point, (".459603956068", ".008613846238", ".240396043932"), strict=True):
        assert printed(value, text)


# Straight segments with parabolic blends

TIMES, POINTS = np.array([0.0, 1.0, 2.0, 3.5]), np.array([[0.0, 1.0], [1.0, 0.0], [0.5, 0.0], [2.0, -1.0]])


def test_blends_of_a_given_time() -> None:
    found = with_blend_times(TIMES, POINTS, np.full(4, 0.3))
    assert found.velocities[:, 0] == pytest.approx([1.0 / 0.85, -0.5, 1.5 / 1.35])
    assert found.motion.at(TIMES[[0, -1]]) == pytest.approx(POINTS[[0, -1]], abs=1e-12)
    assert found.motion.at(TIMES[1:-1]) == pytest.approx(
        POINTS[1:-1] + np.sign(found.accelerations[1:-1]) * found.deviations[1:-1], abs=1e-12
    )
    middle = found.motion.at(np.array([1.5]))[0]
    assert middle == pytest.approx(POINTS[1:3].mean(axis=0), abs=1e-12)
    assert found.motion.derivative().at(np.array([0.15, 1.0]))[0, 0] == pytest.approx(0.5 / 0.85)


def test_blends_of_a_given_acceleration() -> None:
    found = with_accelerations(TIMES, POINTS, np.array([6.0, 8.0]))
    assert np.abs(peaks(found.motion, 2).values) == pytest.approx([6.0, 8.0])
    assert found.motion.at(TIMES[[0, -1]]) == pytest.approx(POINTS[[0, -1]], abs=1e-12)
    assert np.abs(found.motion.derivative().at(TIMES[[0, -1]])).max() < 1e-12
    first = found.durations[0, 0]
    assert first == pytest.approx(1.0 - np.sqrt(1.0 - 2.0 / 6.0))
    assert found.velocities[0, 0] == pytest.approx(6.0 * first)


def test_one_segment_is_a_trapezoid() -> None:
    found = with_accelerations(np.array([0.0, 3.5]), np.array([[0.0], [2.0]]), np.array([1.6]))
    profile = lasting(course(2.0), 3.5)
    assert profile is not None
    assert found.durations[0, 0] == pytest.approx(profile.first)
    assert found.velocities[0, 0] == pytest.approx(profile.peak_velocity)
    same = with_blend_times(np.array([0.0, 3.5]), np.array([[0.0], [2.0]]), np.full(2, profile.first))
    assert same.accelerations[:, 0] == pytest.approx([1.6, -1.6])


def test_a_segment_too_short_is_named() -> None:
    with pytest.raises(InvalidField, match="'blend_time': segment 1 of 1 s is too short") as caught:
        with_blend_times(TIMES, POINTS, np.full(4, 0.7))
    assert "take 1.05 s" in caught.value.reason
    with pytest.raises(InvalidField, match="segment 1 of 1 s is too short for joint 1: it needs an acceleration of at"):
        with_accelerations(TIMES, POINTS, np.array([1.9, 8.0]))
    with pytest.raises(InvalidField, match="segment 1 of 1 s is too short for its blends"):
        with_accelerations(TIMES, POINTS, np.array([2.1, 8.0]))


@pytest.mark.slow
def test_a_thousand_random_via_points() -> None:
    rng = np.random.default_rng(7)
    for i in range(1000):
        N, n = int(rng.integers(2, 8)), int(rng.integers(1, 5))
        times = np.cumsum(rng.uniform(0.5, 2.0, N)) - 1.0
        points = rng.normal(size=(N, n)) * (rng.random((1, n)) > 0.1)
        if i % 2:
            found = with_blend_times(times, points, rng.uniform(0.05, 0.25, N))
        else:
            found = with_accelerations(times, points, rng.uniform(60.0, 90.0, n))
        motion, rest = found.motion, np.zeros((1, n))
        certificate = certified(
            motion,
            MotionClaims(times[[0, -1]], points[[0, -1]], rest, rest, 1, {k: peaks(motion, k) for k in (1, 2)}),
        )
        assert certificate.knot_error < 1e-12
        assert np.abs(motion.at(times) - points).max() <= found.deviations.max() + 1e-9
        assert np.abs(motion.derivative(2).coefficients).max() <= np.abs(found.accelerations).max() * (1 + 1e-12)


# Steps


@pytest.mark.parametrize(
    ("tasks", "duration", "formula"),
    [
        ([course(2.0)], None, r"T_s = \frac{v}{a} = \frac{0.8}{1.6} = 0.5"),
        ([course(0.3)], None, r"v_p = \sqrt{L a} = 0.692820323"),
        ([course(0.0)], None, r"T = 0"),
        ([course(0.1, 0.3, 0.1)], None, r"t_a = \frac{|v_p - v_i|}{a} = \frac{|0.4582575695 - 0.3|}{1.6}"),
        ([course(2.0)], 3.5, "0.4037087982"),
        (
            [JointMove(-1.0, 0.0, 0.0, 0.5, 0.8), JointMove(0.7, 0.0, 0.0, 0.8, 0.5)],
            None,
            r"k = \frac{T}{T_j} = 1.109264959",
        ),
    ],
    ids=["coast", "no coast", "no distance", "end velocities", "given time", "two joints"],
)
def test_the_steps_show_the_numbers(tasks: list[JointMove], duration: float | None, formula: str) -> None:
    plan = point_to_point(np.zeros(len(tasks)), tasks, duration)
    assert formula in "\n".join(line for step in trapezoid_steps(tasks, plan) for line in step.latex)


def test_the_steps_of_blends_show_each_joint() -> None:
    titles = [step.title for step in blend_steps(with_blend_times(TIMES, POINTS, np.full(4, 0.3)))]
    assert titles[1:] == ["Joint 1: Numbers", "Joint 2: Numbers"]
