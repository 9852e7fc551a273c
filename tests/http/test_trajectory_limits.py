"""What joints may do where a request says it, in part or not at all; and how many samples there are."""

import xml.etree.ElementTree as ET

import numpy as np
import orjson
import pytest

from gelenk.contract.trajectory_request import MotionOptions, TrajectoryRequest
from gelenk.errors import InvalidField
from gelenk.operations.trajectory_limits import SourcedLimits, bounds_of, limit_notes, own_velocities
from gelenk.operations.trajectory_planned import TrajectorySizeLimits, sample_count, sample_times
from tests.oracles import catalogue
from tests.robots import robot, swept

PANDA = [2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61]


def bounds(*options: dict[str, object], name: str = "panda") -> SourcedLimits:
    """Of a trajectory's options, and of a segment's."""
    own, chain = own_velocities(robot(name), robot(name).chain(None, None)), robot(name).chain(None, None)
    layers = {str(i): MotionOptions.model_validate_json(orjson.dumps(one)) for i, one in enumerate(options)}
    return bounds_of(chain, own, layers)


def test_what_is_left_out_is_the_robots_or_assumed() -> None:
    found = bounds({})
    assert found.limits.velocity.tolist() == PANDA
    assert found.limits.acceleration == pytest.approx(2.0 * np.array(PANDA))
    assert found.limits.jerk == pytest.approx(20.0 * np.array(PANDA))
    assert found.limits.tip.speed == np.inf
    assert found.sources["joint_velocity"] == ("robot",) * 7
    assert found.sources["joint_acceleration"] == found.sources["joint_jerk"] == ("assumed",) * 7


@pytest.mark.parametrize("name", swept(catalogue.URDFS))
def test_velocities_are_those_of_the_document(name: str) -> None:
    chain = robot(name).chain(None, None)
    limits = {
        joint.get("name"): joint.find("limit") for joint in ET.fromstring(catalogue.urdf_text(name)).findall("joint")
    }
    own = own_velocities(robot(name), chain)
    for joint, value, known in zip(chain.joint_names, own.values, own.known, strict=True):
        limit = limits[joint]
        written = 0.0 if limit is None else float(limit.get("velocity", "0"))
        if 0.0 < written < 100.0:
            assert (value, known) == (written, True)
        else:
            assert value in {1.0, 0.25}
            assert not known


def test_a_sliding_joint_without_a_limit_is_slower() -> None:
    found = bounds({}, name="scara")
    joints = robot("scara").description.joint
    chain = robot("scara").chain(None, None)
    for name, value in zip(chain.joint_names, found.limits.velocity, strict=True):
        assert value == (0.25 if joints[name].type == "prismatic" else 1.0)
    notes = limit_notes(chain, own_velocities(robot("scara"), chain), [found])
    assert notes[0].startswith("the robot's description has no velocity limit of all joints")
    assert len(notes) == 3


def test_a_number_a_list_and_names() -> None:
    assert bounds({"limits": {"joint_velocity": 0.5}}).limits.velocity.tolist() == [0.5] * 7
    rising = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    assert bounds({"limits": {"joint_velocity": rising}}).limits.velocity.tolist() == rising
    found = bounds({"limits": {"joint_velocity": {"panda_joint3": 0.3}}})
    assert found.limits.velocity.tolist() == [*PANDA[:2], 0.3, *PANDA[3:]]
    assert found.sources["joint_velocity"] == ("robot", "robot", "request", *("robot",) * 4)
    assert found.limits.acceleration[2] == pytest.approx(0.6)


def test_a_segment_overrides_the_trajectory_field_by_field() -> None:
    whole = {"limits": {"joint_velocity": 1.0, "joint_acceleration": 3.0, "tip_velocity": 0.4}, "velocity_scale": 0.5}
    part = {"limits": {"joint_velocity": {"panda_joint1": 0.2}, "tip_acceleration": 1.0}, "acceleration_scale": 0.5}
    found = bounds(whole, part).limits
    assert found.velocity.tolist() == [0.1] + [0.5] * 6
    assert found.acceleration.tolist() == [1.5] * 7
    assert found.jerk.tolist() == [15.0] * 7
    assert (found.tip.speed, found.tip.acceleration, found.tip.angular_speed) == (0.2, 0.5, np.inf)
    assert bounds(whole, {"velocity_scale": 1.0}).limits.velocity.tolist() == [1.0] * 7


def test_a_limit_beyond_the_robots_own_is_said() -> None:
    chain = robot("panda").chain(None, None)
    own = own_velocities(robot("panda"), chain)
    faster = bounds({"limits": {"joint_velocity": {"panda_joint2": 3.0}}})
    assert "'panda_joint2' are higher than the robot's own" in limit_notes(chain, own, [faster])[-1]
    slower = bounds({"limits": {"joint_velocity": {"panda_joint2": 3.0}}, "velocity_scale": 0.5})
    assert not any("higher" in note for note in limit_notes(chain, own, [slower]))


@pytest.mark.parametrize(
    ("duration", "period", "times"),
    [
        (0.3, 0.1, [0.0, 0.1, 0.2, 0.3]),
        (0.35, 0.1, [0.0, 0.1, 0.2, 0.3, 0.35]),
        (0.30000000000000004, 0.1, [0.0, 0.1, 0.2, 0.30000000000000004]),
        (0.29999999999999993, 0.1, [0.0, 0.1, 0.2, 0.29999999999999993]),
        (0.1 + 1e-9, 0.1, [0.0, 0.1 + 1e-9]),
        (0.05, 0.1, [0.0, 0.05]),
        (0.0, 0.1, [0.0]),
        (1.0, 0.4, [0.0, 0.4, 0.8, 1.0]),
        (0.2, 0.05, [0.0, 0.05, 0.1, 0.15, 0.2]),
    ],
)
def test_samples_end_at_the_end_and_none_is_nearly_doubled(duration: float, period: float, times: list[float]) -> None:
    assert sample_times(duration, period).tolist() == times
    assert sample_count(duration, period) == len(times)


@pytest.mark.parametrize("period", [1e-6, 1e-3, 0.004, 1 / 3, 0.05, 7.0])
def test_samples_are_multiples_of_the_period(period: float) -> None:
    times = sample_times(1000.5 * period, period)
    assert times[:-1] == pytest.approx(period * np.arange(1001), rel=1e-15)
    assert (np.diff(times) > 0.4 * period).all()


@pytest.mark.parametrize(("duration", "most"), [(1e6, 100_000), (1e300, 100_000), (10.0, 1000), (10.0, 2)])
def test_too_many_samples_are_refused_with_the_period_that_is_allowed(duration: float, most: int) -> None:
    bounds, chain = TrajectorySizeLimits(most, 10**9), robot("panda").chain(None, None)

    def check(period: float) -> None:
        call = TrajectoryRequest.model_construct(start=[], segments=[], sample_period=period, tip_poses=False)
        bounds.check(call, chain, duration)

    with pytest.raises(InvalidField) as caught:
        check(1e-6)
    assert caught.value.field == "sample_period"
    least = float(caught.value.reason.split()[-2])
    check(least)
    if least < 1.0:
        with pytest.raises(InvalidField):
            check(least - 2e-6)
