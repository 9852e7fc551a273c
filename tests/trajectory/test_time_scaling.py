"""Uniform time scaling: the lecture's numbers, and motions that then just keep their limits."""

import numpy as np
import pytest

from gelenk.course.motion.time_law_steps import scaling_steps
from gelenk.robot.arrays import Array
from gelenk.trajectory.laws.time_scaling import ScalingLimits, uniform_scaling
from gelenk.trajectory.motion.extremes import peaks
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline, through_samples
from gelenk.trajectory.motion.time_laws import between


def printed(value: float, text: str) -> bool:
    """Whether a number is the printed one, to its last digit."""
    decimals = len(text.partition(".")[2])
    return abs(value - float(text)) <= 0.5000001 * 10.0**-decimals


def line_by_two_links(count: int) -> tuple[Array, Array, Array, Array]:
    """Two unit links along a line from F(110°, 140°), by a cubic in one second: times, q, q̇, q̈, by differentiation."""
    start = np.array([np.cos(np.radians(110.0)) + np.cos(np.radians(250.0)), 0.0])
    end = np.array([0.816, 1.4])
    t = np.linspace(0.0, 1.0, count)
    s, ds, dds = 3 * t**2 - 2 * t**3, 6 * t - 6 * t**2, 6 - 12 * t
    p = start + s[:, None] * (end - start)
    cosine = (np.sum(p**2, axis=1) - 2.0) / 2.0
    q2 = np.arccos(cosine)
    q1 = np.arctan2(p[:, 1], p[:, 0]) - np.arctan2(np.sin(q2), 1.0 + cosine)
    q = np.stack([np.unwrap(q1), q2], axis=1)
    v, a = np.empty_like(q), np.empty_like(q)
    for i in range(count):
        c1, s1, c12, s12 = np.cos(q[i, 0]), np.sin(q[i, 0]), np.cos(q[i].sum()), np.sin(q[i].sum())
        J = np.array([[-s1 - s12, -s12], [c1 + c12, c12]])
        v[i] = np.linalg.solve(J, (end - start) * ds[i])
        w1, w12 = v[i, 0], v[i].sum()
        centripetal = np.array([c1 * w1**2 + c12 * w12**2, s1 * w1**2 + s12 * w12**2])
        a[i] = np.linalg.solve(J, (end - start) * dds[i] + centripetal)
    return t, q, v, a


def test_the_line_of_the_lecture() -> None:
    motion = through_samples(*line_by_two_links(501))
    limits = ScalingLimits(np.array([3.0, 2.5]), np.array([5.0, 7.0]))
    for text, value in zip(("5.756899290", "3.004575851"), np.abs(peaks(motion, 1).values), strict=True):
        assert value == pytest.approx(float(text), abs=1e-9)
    for text, value in zip(("30.759859736", "20.114406054"), np.abs(peaks(motion, 2).values), strict=True):
        assert value == pytest.approx(float(text), abs=1e-9)
    found = uniform_scaling(motion, limits)
    assert found.bounds[0].ratio == pytest.approx(1.918966430, abs=1e-9)
    assert found.bounds[1].ratio == pytest.approx(6.151971947, abs=1e-9)
    assert found.course_factor == pytest.approx(2.480316904599, abs=1e-10)
    assert found.binding.quantity == "acceleration"
    assert found.binding.joint == 1
    scaled = peaks(motion.scaled(found.course_factor), 2)
    assert abs(scaled.values[0]) == pytest.approx(5.0, abs=1e-12)


def cubic(displacement: Array, duration: float = 1.0) -> PiecewisePolynomial:
    return between(np.zeros((2, len(displacement))), np.array([displacement, np.zeros(len(displacement))]), duration)


def test_the_simple_example() -> None:
    motion = cubic(np.array([1.0, -2.0]))
    found = uniform_scaling(motion, ScalingLimits(np.array([1.0, 2.0]), np.array([8.0, 8.0])))
    assert [bound.ratio for bound in found.bounds] == pytest.approx([1.5, 1.5])
    assert found.course_factor == pytest.approx(1.5)
    assert found.binding.quantity == "velocity"
    assert found.binding.joint == 1
    assert found.binding.time == pytest.approx(0.5)
    assert found.bounds[1].joint == 2


def test_loose_limits_speed_up_only_without_the_one() -> None:
    motion = cubic(np.array([1.0, -2.0]))
    found = uniform_scaling(motion, ScalingLimits(np.array([10.0, 10.0]), np.array([100.0, 100.0])))
    assert found.course_factor == 1.0
    assert found.factor is not None
    assert printed(found.factor, ".346410161514")
    assert np.abs(peaks(motion.scaled(found.factor), 2).values).max() == pytest.approx(100.0)


def test_a_jerk_takes_the_cube_root() -> None:
    found = uniform_scaling(cubic(np.array([1.0])), ScalingLimits(jerk=np.array([1.5])))
    assert found.factor == pytest.approx(2.0)


def test_what_stands_still_has_no_factor() -> None:
    found = uniform_scaling(cubic(np.zeros(2)), ScalingLimits(np.ones(2)))
    assert (found.course_factor, found.factor) == (1.0, None)
    assert all("without the 1" not in step.title for step in scaling_steps(found, 1.0))


@pytest.mark.slow
def test_a_thousand_scaled_motions_just_reach_a_limit_and_go_beyond_none() -> None:
    rng = np.random.default_rng(48)
    binding: set[str] = set()
    for _ in range(1000):
        n, N = int(rng.integers(1, 7)), int(rng.integers(2, 7))
        times = np.cumsum(rng.uniform(0.2, 2.0, N))
        motion = cubic_spline(times, rng.normal(size=(N, n)), "clamped").motion
        limits = ScalingLimits(*(10.0 ** rng.uniform(-1.0, 1.0, (3, n))))
        found = uniform_scaling(motion, limits)
        assert found.factor is not None
        assert found.course_factor == max(1.0, found.factor)
        scaled = motion.scaled(found.factor)
        fine = np.linspace(scaled.breaks[0], scaled.breaks[-1], 300)
        ratios = []
        for order, limit in enumerate((limits.velocity, limits.acceleration, limits.jerk), start=1):
            assert limit is not None
            assert np.all(np.abs(scaled.derivative(order).at(fine)) <= limit * (1.0 + 1e-9))
            ratios.append(float((np.abs(peaks(scaled, order).values) / limit).max()))
        assert max(ratios) == pytest.approx(1.0, rel=1e-9)
        positions = scaled.at(scaled.breaks[0] + found.factor * (times - times[0]))
        assert np.abs(positions - motion.at(times)).max() < 1e-9
        binding.add(found.binding.quantity)
    assert binding == {"velocity", "acceleration", "jerk"}


def test_the_steps_show_the_numbers() -> None:
    found = uniform_scaling(cubic(np.array([1.0, -2.0])), ScalingLimits(np.array([1.0, 2.0]), np.array([8.0, 8.0])))
    text = "\n".join(line for step in scaling_steps(found, 1.0) for line in step.latex)
    assert r"k = \max\{1, k_{\mathrm{vel}}, \sqrt{k_{\mathrm{acc}}}\} = 1.5" in text
    assert r"\frac{12}{8} = 1.5" in text
