"""Motions that begin and end with velocities and accelerations: against SciPy, by what they promise, out of others."""

from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BPoly, CubicSpline

from gelenk.contract.trajectory_request import TrajectoryRequest
from gelenk.errors import InvalidInput
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations.trajectory_request import parse
from gelenk.operations.trajectory_steps import trajectory_steps
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Trajectory, TrajectoryProblem
from tests.robots import robot
from tests.trajectory.arms import end_state

START = [0.0, -1.2, 1.6, -0.4, 1.2, 0.0]
TARGET = [0.5, -1.0, 1.6, -0.4, 1.3, 0.0]
VELOCITIES, ACCELERATIONS = [0.3, 0.1, 0.0, -0.2, 0.0, 0.2], [-1.0, 0.0, 0.1, 0.0, 0.5, 0.0]
MOVE = {"type": "joint", "target": TARGET}
THROUGH = {"type": "spline", "waypoints": [[0.2, *START[1:]], TARGET], "law": "cubic"}
LIMITS = {"joint_velocity": 2.0, "joint_acceleration": 6.0, "joint_jerk": 60.0}
RATES: tuple[tuple[Law, int], ...] = (("cubic", 1), ("quintic", 2), ("septic", 2), ("jerk_limited", 2))


def problem(**call: Any) -> TrajectoryProblem:
    one = robot("ur5")
    request = TrajectoryRequest.model_validate({"limits": LIMITS, **call})
    return parse(one, one.chain(*one.default_chain), request).problem


def planned(**call: Any) -> Trajectory:
    one = robot("ur5")
    return plan(one, one.chain(*one.default_chain), problem(**call))


def moving(law: Law, count: int, **call: Any) -> Trajectory:
    rates = {"start_velocities": VELOCITIES, "end_velocities": [-v for v in VELOCITIES]}
    if count == 2:
        rates |= {"start_accelerations": ACCELERATIONS, "end_accelerations": [0.5 * a for a in ACCELERATIONS]}
    return planned(**{"start": START, "segments": [MOVE], "law": law, **rates, **call})


def states(found: Trajectory, count: int) -> Array:
    """Position and rates at both ends; shape (2, 1 + count, n)."""
    return np.array([[end_state(found.motion, k, last=last) for k in range(1 + count)] for last in (False, True)])


@pytest.mark.parametrize(("law", "count"), RATES)
def test_the_ends_move_as_asked_and_one_limit_is_reached(law: Law, count: int) -> None:
    found = moving(law, count)
    expected = np.array([[START, VELOCITIES, ACCELERATIONS], [TARGET, VELOCITIES, ACCELERATIONS]])
    expected[1, 1:] *= [[-1.0], [0.5]]
    np.testing.assert_allclose(states(found, count), expected[:, : 1 + count], atol=1e-9)
    times = np.linspace(0.0, found.motion.duration, 20_001)[:-1]
    ratios = [
        float(np.abs(found.motion.derivative(k).at(times)).max() / bound)
        for k, bound in enumerate(LIMITS.values(), start=1)
    ][: 2 if law == "cubic" else 3]
    assert max(ratios) == pytest.approx(1.0, abs=1e-3)
    assert found.audit.passed


@pytest.mark.parametrize(("law", "order"), [("cubic", 2), ("quintic", 3)])
def test_a_polynomial_is_the_one_that_scipy_finds(law: Law, order: int) -> None:
    found = moving(law, order - 1, duration=1.7)
    rows = states(found, order - 1)
    other = BPoly.from_derivatives([0.0, 1.7], rows)
    times = np.linspace(0.0, 1.7, 31)
    np.testing.assert_allclose(found.motion.at(times), other(times), atol=1e-12)


def test_a_spline_is_the_one_that_scipy_finds() -> None:
    times = [1.0, 2.5]
    found = planned(start=START, segments=[{**THROUGH, "times": times}], start_velocities=VELOCITIES)
    points = np.array([START, *THROUGH["waypoints"]])
    other = CubicSpline([0.0, *times], points, bc_type=((1, np.array(VELOCITIES)), (1, np.zeros(6))))
    instants = np.linspace(0.0, 2.5, 41)
    np.testing.assert_allclose(found.motion.at(instants), other(instants), atol=1e-12)


def test_a_spline_keeps_its_rates_in_the_least_time() -> None:
    rates = {"start_velocities": VELOCITIES, "end_accelerations": ACCELERATIONS}
    found = planned(start=START, segments=[{**THROUGH, "boundary": "assigned"}], **rates)
    expected = [[VELOCITIES, [0.0] * 6], [[0.0] * 6, ACCELERATIONS]]
    np.testing.assert_allclose(states(found, 2)[:, 1:], expected, atol=1e-9)
    assert found.audit.acceleration is not None
    assert found.audit.acceleration.ratio == pytest.approx(1.0, abs=1e-6)


def test_the_steps_give_the_states_at_both_ends() -> None:
    call = {"start": START, "segments": [MOVE], "law": "quintic", "start_velocities": VELOCITIES}
    (step,) = trajectory_steps(robot("ur5").chain(None, None), problem(**call).segments, planned(**call))
    assert step.title == "Segment 0: From state to state"
    assert r"\dot q(0) = (0.3, 0.1, 0, -0.2, 0, 0.2)" in step.latex


def test_rates_given_as_zero_are_rest() -> None:
    rest = planned(start=START, segments=[MOVE])
    assert planned(start=START, segments=[MOVE], start_velocities=[0.0] * 6).motion.duration == rest.motion.duration


def test_between_two_segments_joints_rest() -> None:
    found = planned(
        start=START,
        segments=[MOVE, {"type": "joint", "target": START}],
        law="jerk_limited",
        start_velocities=VELOCITIES,
        end_velocities=VELOCITIES,
    )
    at = np.array([found.segments[1].start_time])
    np.testing.assert_allclose(found.motion.derivative().at(at), np.zeros((1, 6)), atol=1e-12)
    np.testing.assert_allclose(states(found, 1)[:, 1], [VELOCITIES, VELOCITIES], atol=1e-9)


RUNNING = {"start": START, "segments": [MOVE], "law": "jerk_limited", "limits": LIMITS}


@pytest.mark.parametrize("share", [0.0, 0.1, 0.37, 0.5, 0.83, 1.0])
def test_a_motion_planned_again_to_its_target_is_the_rest_of_itself(share: float) -> None:
    """The principle of optimality, of the slowest joint."""
    whole = planned(**RUNNING).motion
    time = share * whole.duration
    again = planned(at={"trajectory": RUNNING, "time": time}, segments=[MOVE], law="jerk_limited").motion
    assert again.duration == pytest.approx(whole.duration - time, abs=1e-7)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("law", "count"), [*RATES, ("trapezoidal", 0)])
@pytest.mark.parametrize("former", ["quintic", "jerk_limited", "cubic"])
def test_there_is_no_jump_out_of_a_running_motion(law: Law, count: int, former: Law) -> None:
    running = {**RUNNING, "law": former}
    whole = planned(**running).motion
    for time in np.linspace(0.05, 0.95, 4) * whole.duration if count else (whole.duration,):
        aside = {"type": "joint", "target": [0.2, -1.1, 1.7, -0.4, 1.2, 0.3]}
        call = {"at": {"trajectory": running, "time": time}, "segments": [aside], "law": law}
        motion = planned(**call, limits={"joint_acceleration": 20.0, "joint_jerk": 600.0}).motion
        for order in range(1 + count):
            before = (whole.derivative(order) if order else whole).at(np.array([time]))[0]
            np.testing.assert_allclose(end_state(motion, order, last=False), before, atol=1e-9)


def test_a_motion_begins_out_of_a_path_of_the_tip_too() -> None:
    """The running motion has no law of its own, which allows `slow_down` to choose it."""
    one = robot("ur5")
    T = chain_poses(one.chain(*one.default_chain).flat, np.array([START]))
    pose = {"position": (T[0][0] + [0.0, 0.05, 0.0]).tolist(), "rotation": T[1][0].tolist()}
    running = {"start": START, "segments": [{"type": "line", "target": pose}], "near_singularity": "slow_down"}
    whole = planned(**running, limits=None).motion
    at = {"trajectory": running, "time": 0.4 * whole.duration}
    motion = planned(at=at, segments=[MOVE], law="jerk_limited", limits={"joint_acceleration": 50.0}).motion
    for order in range(3):
        before = (whole.derivative(order) if order else whole).at(np.array([at["time"]]))[0]
        np.testing.assert_allclose(end_state(motion, order, last=False), before, atol=1e-9)


@pytest.mark.parametrize(
    ("field", "words", "changes"),
    [
        ("start", "is missing", {"start": None}),
        ("start", "beside `at`", {"at": {"trajectory": RUNNING, "time": 0.1}}),
        ("start_velocities", "beside `at`", {"start": None, "at": {"trajectory": RUNNING, "time": 0.1}}),
        ("start_velocities", "`cubic`, `quintic`, `septic`, `jerk_limited`", {"law": "trapezoidal"}),
        ("end_accelerations", "`quintic`, `septic`, `jerk_limited`", {"law": "cubic", "end_accelerations": [1.0] * 6}),
        ("start_velocities", "joint 2 is -2.5, beyond its limit 2", {"start_velocities": [0.0, -2.5, 0, 0, 0, 0]}),
        ("end_velocities", "is 7, beyond", {"law": "quintic", "end_velocities": [7.0] * 6}),
        (
            "start_accelerations",
            "takes the velocity to",
            {"start_velocities": [1.9] * 6, "start_accelerations": [5.0] * 6},
        ),
        (
            "start_velocities",
            "beyond its limit",
            {"start": [0.0, -6.2, 1.6, -0.4, 1.2, 0.0], "start_velocities": [0, -2.0, 0, 0, 0, 0]},
        ),
        ("start_velocities", "`clamped` or `assigned`", {"segments": [{**THROUGH, "boundary": "natural"}]}),
        ("start_accelerations", "`assigned`", {"segments": [THROUGH], "start_accelerations": ACCELERATIONS}),
        ("start_velocities", "the tip would be too fast", {"limits": {**LIMITS, "tip_velocity": 0.01}}),
        ("duration", "must be at least", {"duration": 0.1}),
        ("duration", "times its limit of", {"duration": 0.1, "law": "quintic"}),
        ("duration", "durations of their own", {"duration": 9.0, "segments": [MOVE, {**MOVE, "target": START}]}),
        (
            "at.time",
            "after the end",
            {"start": None, "start_velocities": None, "at": {"trajectory": RUNNING, "time": 9.0}},
        ),
        (
            "at",
            "has no velocities",
            {"start": None, "start_velocities": None, "law": "trapezoidal", "at": {"trajectory": RUNNING, "time": 0.2}},
        ),
        (
            "at.trajectory.start",
            "is missing",
            {"start": None, "start_velocities": None, "at": {"trajectory": {**RUNNING, "start": None}, "time": 0.2}},
        ),
    ],
)
def test_what_cannot_be_is_refused_by_name(field: str, words: str, changes: dict[str, Any]) -> None:
    call = {"start": START, "segments": [MOVE], "law": "jerk_limited", "start_velocities": VELOCITIES, **changes}
    with pytest.raises(InvalidInput) as refused:
        planned(**call)
    assert getattr(refused.value, "field", None) == field
    assert words in str(refused.value)
