"""Arms that are special but for a little: rounding loses solutions of theirs on the way to infinity, no list may."""

import numpy as np
import pytest

from tests.ik import nearly_special_arms, six_joint_arms
from tests.ik.arm_classes import Arm
from tests.ik.test_complete import doubts_of, every, missed
from tests.oracles import many_starts
from tests.oracles.dh_columns import Array


def drawn(arm: Arm, each: int, seed: int) -> Array:
    """Configurations far from singularities and beside them; shape (k, 6)."""
    beside = [six_joint_arms.beside_singular(arm, 10.0**-k, each, seed + k) for k in range(1, 6)]
    return np.concatenate((arm.configurations(2 * each, seed), *beside))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "off", "seed", "chosen"),
    [
        ("a shoulder and three joints", 1e-2, 0, 35),
        ("short wrist", 1e-5, 1, 40),
        ("calibrated anthropomorphic", 1e-5, 2, 19),
    ],
)
def test_a_solution_that_rounding_loses_is_listed_or_doubted(kind: str, off: float, seed: int, chosen: int) -> None:
    """Fifteen of sixteen solutions in complex numbers, or those of the ideal arm alone, are no count."""
    arm = nearly_special_arms.arm(kind, off, seed)
    q = drawn(arm, 6, seed)[chosen : chosen + 1]
    answer = every(arm, q)
    assert not (missed(arm, q, answer) & ~doubts_of(answer)).any()


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", nearly_special_arms.KINDS)
def test_regular_targets_are_proved_by_the_arm_that_is_exactly_special(kind: str) -> None:
    arm = nearly_special_arms.arm(kind, 1e-7, 0)
    qs = arm.configurations(8, seed=2)
    answer = every(arm, qs)
    assert not missed(arm, qs, answer).any()
    assert answer.complete is not None
    assert sum(answer.complete) >= 7


@pytest.mark.slow
@pytest.mark.parametrize("off", nearly_special_arms.OFFSETS)
@pytest.mark.parametrize("kind", nearly_special_arms.KINDS)
def test_no_complete_list_of_a_nearly_special_arm_lacks_a_solution(kind: str, off: float) -> None:
    """Neither the configuration that made its target nor, of one target, what a thousand starts find."""
    arm = nearly_special_arms.arm(kind, off, 7)
    qs = drawn(arm, 3, 7)
    answer = every(arm, qs)
    doubtful = doubts_of(answer)
    assert not (missed(arm, qs, answer) & ~doubtful).any()
    for i in np.flatnonzero(~doubtful)[-1:].tolist():
        found = many_starts.solutions(arm.table, arm.table.pose(qs[i]), None, starts=256)
        listed = answer.qs[answer.firsts[i] : answer.firsts[i + 1]]
        assert all(np.abs(arm.differences(listed, q)).max(axis=1).min() < 1e-3 for q in found)
