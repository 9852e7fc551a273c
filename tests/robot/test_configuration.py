"""Configurations by order and by name, and what is refused."""

from math import inf, nan, pi

import numpy as np
import pytest

from gelenk.errors import (
    InvalidArray,
    InvalidField,
    MissingJoint,
    OutsideLimits,
    UnknownJoint,
    WrongJointCount,
    counted,
)
from gelenk.robot.arrays import Configuration
from gelenk.robot.configuration import MAX_MAGNITUDE, check_limits, checked_rows, configurations
from tests.robots import robot, samples

ARM = robot("planar_3r").chain("base", "tool")
NAMES = ARM.joint_names
BY_ORDER = [0.1, 0.2, 0.3]
BY_NAME = {NAMES[2]: 0.3, NAMES[0]: 0.1, NAMES[1]: 0.2}


@pytest.mark.parametrize(
    "values", [[BY_ORDER, BY_ORDER], [BY_NAME, BY_NAME], [BY_ORDER, BY_NAME], [(0.1, 0.2, 0.3)] * 2]
)
def test_by_order_or_by_name(values: list[Configuration]) -> None:
    assert np.array_equal(configurations(ARM, values), [BY_ORDER, BY_ORDER])


def test_no_configuration() -> None:
    assert configurations(ARM, []).shape == (0, 3)


def test_no_joint() -> None:
    still = robot("planar_3r").chain("base", "base")
    assert configurations(still, [[], {}]).shape == (2, 0)


@pytest.mark.parametrize("value", [[], [0.1, 0.2], [0.1] * 4])
def test_wrong_count(value: list[float]) -> None:
    with pytest.raises(WrongJointCount) as caught:
        configurations(ARM, [BY_ORDER, value])
    assert caught.value.facts() == {"given": len(value), "expected": NAMES, "index": 1, "field": "joint_positions"}


def test_missing_joint() -> None:
    with pytest.raises(MissingJoint) as caught:
        configurations(ARM, [BY_ORDER, {NAMES[0]: 0.1, NAMES[2]: 0.3}])
    assert caught.value.facts() == {"joint": NAMES[1], "expected": NAMES, "index": 1, "field": "joint_positions"}


def test_unknown_joint() -> None:
    with pytest.raises(UnknownJoint) as caught:
        configurations(ARM, [{**BY_NAME, "elbow": 1.0}])
    assert caught.value.facts() == {"joint": "elbow", "expected": NAMES, "index": 0, "field": "joint_positions"}


@pytest.mark.parametrize("number", [nan, inf, -inf, 1.1e6, -1e300])
@pytest.mark.parametrize("by_name", [True, False])
def test_numbers_that_are_no_position(number: float, by_name: bool) -> None:
    value: Configuration = {**BY_NAME, NAMES[1]: number} if by_name else [0.1, number, 0.3]
    with pytest.raises(InvalidField, match=f"joint_positions.*entry 1: the value of joint '{NAMES[1]}'"):
        configurations(ARM, [BY_ORDER, value])


def test_the_largest_position() -> None:
    assert configurations(ARM, [[MAX_MAGNITUDE, -MAX_MAGNITUDE, 0.0]])[0, 0] == MAX_MAGNITUDE


@pytest.mark.parametrize("shape", [(3,), (2, 3, 1), ()])
def test_arrays_of_other_dimensions(shape: tuple[int, ...]) -> None:
    with pytest.raises(InvalidArray, match=f"has {counted(len(shape), 'dimension')}"):
        checked_rows(ARM, np.zeros(shape), "q")


@pytest.mark.parametrize("columns", [0, 2, 4])
def test_arrays_of_other_width(columns: int) -> None:
    with pytest.raises(WrongJointCount) as caught:
        checked_rows(ARM, np.zeros((5, columns)), "q")
    assert caught.value.given == columns


def test_a_good_array_stays_as_it_is() -> None:
    qs = samples(ARM, 10)
    assert checked_rows(ARM, qs, "q") is qs


# Limits


def test_limits_are_inclusive() -> None:
    panda = robot("panda").chain("panda_link0", "panda_link8")
    check_limits(panda, np.array([panda.lower, panda.upper]))


@pytest.mark.parametrize("joint", range(7))
@pytest.mark.parametrize("side", ["lower", "upper"])
def test_outside_limits(joint: int, side: str) -> None:
    panda = robot("panda").chain("panda_link0", "panda_link8")
    middle = (panda.lower + panda.upper) / 2
    beyond = middle.copy()
    beyond[joint] = panda.upper[joint] + 1e-9 if side == "upper" else panda.lower[joint] - 1e-9
    with pytest.raises(OutsideLimits) as caught:
        check_limits(panda, np.array([middle, beyond]))
    assert caught.value.facts() == {
        "joint": panda.joint_names[joint],
        "value": beyond[joint],
        "lower": panda.lower[joint],
        "upper": panda.upper[joint],
        "index": 1,
        "field": "joint_positions",
    }


def test_continuous_joints_have_no_limits() -> None:
    pendulum = robot("double_pendulum_continuous").chain(None, None)
    check_limits(pendulum, np.full((1, len(pendulum)), 100 * pi))
