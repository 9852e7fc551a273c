"""A thousand random problems on six arms, each answer looked at without the planner's or the audit's code.

Poses come from Pinocchio, lines and their distance from geometry, velocities and accelerations from polynomials that
NumPy differentiates, on a grid ten times finer than an answer's samples.
"""

from functools import cache
from itertools import product

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import Rotation

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, SegmentLimits, Trajectory, TrajectoryProblem
from tests.robots import robot

ARMS = ("panda", "ur5", "puma560", "xarm7", "stanford", "kinova")
LAWS: tuple[Law, ...] = ("cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal")
EACH = 28
SMOOTH = {"quintic", "septic", "jerk_limited"}
FINER = 10
PERIOD = 0.05
TOLERANCE = 1e-4


def random_limits(chain: Chain, rng: np.random.Generator) -> SegmentLimits:
    n = len(chain)
    velocity = rng.uniform(0.5, 3.0, n)
    return SegmentLimits(velocity, velocity * rng.uniform(1.0, 4.0, n), velocity * rng.uniform(10.0, 60.0, n))


def random_configuration(chain: Chain, rng: np.random.Generator) -> Array:
    lower, upper = np.maximum(chain.lower, -2.0), np.minimum(chain.upper, 2.0)
    configuration: Array = rng.uniform(lower + 0.1 * (upper - lower), upper - 0.1 * (upper - lower))
    return configuration


@cache
def data_of(arm: RobotModel) -> pin.Data:
    return arm.model.createData()


def pose(arm: RobotModel, chain: Chain, q: Array) -> Array:
    """T_base_tip through Pinocchio."""
    full = arm.expansion(chain).matrix @ q + arm.expansion(chain).offset
    data = data_of(arm)
    pin.framesForwardKinematics(arm.model, data, full)
    base, tip = (data.oMf[arm.frame_id(frame)] for frame in (chain.base_frame, chain.tip_frame))
    T: Array = (base.inverse() * tip).homogeneous
    return T


def moved(T: Array, rng: np.random.Generator) -> Array:
    """Beside a pose, by up to 0.2 m and 0.4 rad."""
    target = T.copy()
    target[:3, 3] += rng.uniform(-0.12, 0.12, 3)
    target[:3, :3] = T[:3, :3] @ Rotation.from_rotvec(rng.uniform(-0.25, 0.25, 3)).as_matrix()
    return target


def solved(name: str, law: Law, number: int) -> tuple[RobotModel, Chain, TrajectoryProblem, Trajectory]:
    """A joint segment, and a line after it."""
    rng = np.random.default_rng([ARMS.index(name), LAWS.index(law), number])
    arm = robot(name)
    chain = arm.chain(None, None)
    start, middle = random_configuration(chain, rng), random_configuration(chain, rng)
    target = moved(pose(arm, chain, middle), rng)
    limits, others = random_limits(chain, rng), random_limits(chain, rng)
    segments = (
        Segment("joint", law, limits, configuration=middle),
        Segment("line", law, others, pose=target),
    )
    problem = TrajectoryProblem(start, segments)
    return arm, chain, problem, plan(arm, chain, problem)


def fine_times(start: float, end: float) -> Array:
    return np.linspace(start, end, max(int(FINER * (end - start) / PERIOD), 50))


def derivative(found: Trajectory, times: Array, order: int) -> Array:
    """Of the joints, by NumPy's own polynomials."""
    breaks, coefficients = found.motion.breaks, found.motion.coefficients
    place = np.clip(np.searchsorted(breaks, times, side="right") - 1, 0, len(breaks) - 2)
    values = np.empty((len(times), coefficients.shape[2]))
    for i in np.unique(place):
        rows = place == i
        pieces = np.polynomial.polynomial.polyder(coefficients[i], order)
        values[rows] = np.polynomial.polynomial.polyval(times[rows] - breaks[i], pieces).T
    return values


@pytest.mark.slow
@pytest.mark.parametrize(("name", "law"), list(product(ARMS, LAWS)))
def test_every_answer_keeps_to_what_it_promises(name: str, law: Law) -> None:
    whole = 0
    for number in range(EACH):
        arm, chain, problem, found = solved(name, law, number)
        whole += found.failure is None
        assert found.audit.passed
        ends = found.motion.breaks[[0, -1]]
        assert np.abs(derivative(found, ends[:1], 0)[0] - problem.start).max() <= 1e-9
        assert np.abs(derivative(found, ends, 1)).max() <= 1e-9
        for report, segment in zip(found.segments, problem.segments, strict=False):
            times = fine_times(report.start_time, report.end_time)[:-1]
            check_limits(found, segment, times, law)
            check_position_limits(chain, derivative(found, times, 0))
        if law in SMOOTH:
            jump = found.audit.continuity.acceleration
            assert jump is not None
            assert jump.value <= 1e-6
        check_line(arm, chain, problem, found)
    assert whole >= EACH // 3


def check_limits(found: Trajectory, segment: Segment, times: Array, law: Law) -> None:
    limits = segment.limits
    assert (np.abs(derivative(found, times, 1)) / limits.velocity).max(initial=0.0) <= 1.0 + 1e-9
    assert (np.abs(derivative(found, times, 2)) / limits.acceleration).max(initial=0.0) <= 1.0 + 1e-9
    if law in SMOOTH:
        assert (np.abs(derivative(found, times, 3)) / limits.jerk).max(initial=0.0) <= 1.0 + 1e-9


def check_position_limits(chain: Chain, qs: Array) -> None:
    assert (qs >= chain.lower - 1e-9).all()
    assert (qs <= chain.upper + 1e-9).all()


def check_line(arm: RobotModel, chain: Chain, problem: TrajectoryProblem, found: Trajectory) -> None:
    """Each pose lies on the line, and turns with it; the last one is the target, or where the answer says it ended."""
    middle, target = problem.segments[0].configuration, problem.segments[1].pose
    assert middle is not None
    assert target is not None
    if len(found.segments) < 2:
        return
    begin = pose(arm, chain, middle)
    length = float(np.linalg.norm(target[:3, 3] - begin[:3, 3]))
    direction = (target[:3, 3] - begin[:3, 3]) / length
    turn = Rotation.from_matrix(begin[:3, :3].T @ target[:3, :3]).as_rotvec()
    report = found.segments[1]
    times = np.linspace(report.start_time, report.end_time, 25)
    for time, q in zip(times, derivative(found, times, 0), strict=True):
        T = pose(arm, chain, q)
        s = float((T[:3, 3] - begin[:3, 3]) @ direction)
        assert np.linalg.norm(T[:3, 3] - begin[:3, 3] - s * direction) <= TOLERANCE, time
        wanted = begin[:3, :3] @ Rotation.from_rotvec(turn * s / length).as_matrix()
        assert Rotation.from_matrix(wanted.T @ T[:3, :3]).magnitude() <= 1e-3 + TOLERANCE
    if found.failure is None:
        assert np.abs(T - target).max() <= 1e-9
        assert report.length == pytest.approx(length, abs=1e-12)
    else:
        assert found.failure.segment == 1
        assert s / length == pytest.approx(2.0 * found.completed_fraction - 1.0, abs=1e-3)
