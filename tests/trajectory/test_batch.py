"""Batches of joint motions: each is the motion that is planned and audited by itself."""

from dataclasses import replace

import numpy as np
import pytest

from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.demands import TipLimits
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.batch import plan_batch
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, SegmentLimits, TrajectoryProblem
from tests.robots import robot
from tests.trajectory.arms import LAWS, Arm, arm

PEAK = 1e-7
"""Relative accuracy of a peak between samples."""
LOOSE = 1e-6
"""Accuracy of a singular value with a kink where two branches of it meet."""


def alone(name: str, start: Array, target: Array, move: Segment) -> list[float]:
    """The same row by a motion of its own."""
    machine = robot(name)
    problem = TrajectoryProblem(start, (replace(move, configuration=target),))
    found = plan(machine, machine.chain(*machine.default_chain), problem)
    audit, tip = found.audit, found.audit.tip
    assert audit.velocity
    assert audit.acceleration
    assert audit.jerk
    assert audit.min_singular_value
    ratios = [audit.velocity.ratio, audit.acceleration.ratio, audit.jerk.ratio]
    margin = np.nan if audit.limit_margin is None else audit.limit_margin.value
    peaks = [one.value for one in (tip.speed, tip.angular_speed, tip.acceleration, tip.angular_acceleration)]
    return [1.0, found.motion.duration, *ratios, margin, *peaks, audit.min_singular_value.value]  # type: ignore[list-item]


def agree(name: str, starts: Array, targets: Array, move: Segment) -> None:
    machine = robot(name)
    found = plan_batch(machine, machine.chain(*machine.default_chain), starts, targets, move)
    assert not found.reasons
    singles = np.array([alone(name, *ends, move) for ends in zip(starts, targets, strict=True)])
    np.testing.assert_allclose(found.rows[:, :6], singles[:, :6], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.rows[:, 6:10], singles[:, 6:10], rtol=PEAK)
    np.testing.assert_allclose(found.rows[:, 10], singles[:, 10], atol=LOOSE)


def ends(one: Arm, rng: np.random.Generator, count: int) -> tuple[Array, Array]:
    return one.configurations(rng, count), one.configurations(rng, count)


@pytest.mark.quick(2)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("name", ["panda", "ur5"])
def test_each_motion_is_the_one_planned_by_itself(name: str, law: Law) -> None:
    one, rng = arm(name), np.random.default_rng(3)
    agree(name, *ends(one, rng, 6), Segment("joint", law, one.limits(rng)))


def test_the_tip_s_limits_slow_each_motion_down() -> None:
    one, rng = arm("panda"), np.random.default_rng(4)
    limits = replace(one.limits(rng), tip=TipLimits(speed=0.3, angular_acceleration=2.0))
    agree("panda", *ends(one, rng, 3), Segment("joint", "trapezoidal", limits))


def test_stated_limits_of_jerk_slow_a_cubic_down() -> None:
    one, rng = arm("panda"), np.random.default_rng(5)
    found = one.limits(rng)
    limits = replace(found, jerk=0.1 * found.jerk)
    agree("panda", *ends(one, rng, 2), Segment("joint", "cubic", limits, stated_jerk=limits.jerk))


def test_what_cannot_be_done_says_why_and_leaves_the_others() -> None:
    one, machine = arm("panda"), robot("panda")
    starts, targets = ends(one, np.random.default_rng(6), 4)
    starts[1, 2], targets[2, 3] = one.chain.upper[2] + 0.1, one.chain.lower[3] - 0.1
    targets[3] = starts[3]
    move = Segment("joint", "jerk_limited", SegmentLimits(*np.ones((3, 7))))
    found = plan_batch(machine, one.chain, starts, targets, move)
    assert sorted(found.reasons) == [1, 2]
    assert found.reasons[1].startswith("'start': joint 'panda_joint3' at")
    assert found.reasons[2].startswith("'target': joint 'panda_joint4' at")
    np.testing.assert_array_equal(found.rows[:, 0], [1.0, 0.0, 0.0, 1.0])
    assert np.isnan(found.rows[1:3, 1:]).all()
    assert found.rows[3, 1] == 0.0
    whole = plan_batch(machine, one.chain, starts[:1], targets[:1], move)
    np.testing.assert_array_equal(found.rows[0], whole.rows[0])


def test_a_motion_that_the_kernel_does_not_pass_is_planned_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    one, machine = arm("ur5"), robot("ur5")
    starts, targets = ends(one, np.random.default_rng(7), 3)
    move = Segment("joint", "septic", SegmentLimits(np.ones(6), np.full(6, 2.0), np.full(6, 20.0)))
    expected = plan_batch(machine, one.chain, starts, targets, move).rows
    monkeypatch.setattr("gelenk.trajectory.batch._fill", lambda *_: None)
    found = plan_batch(machine, one.chain, starts, targets, move)
    np.testing.assert_allclose(found.rows[:, :10], expected[:, :10], rtol=1e-7)
