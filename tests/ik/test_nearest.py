"""What is told to come nearest to a target out of reach comes as near as any of many independent descents."""

import numpy as np
import pytest

from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot.arrays import Array
from gelenk.robot.poses import Poses
from tests.ik.arms import TASKS, middle
from tests.ik.out_of_reach import CATALOGUE, RANDOM, arm_of, least_distances, targets_beyond

LEAST: dict[tuple[str, str], list[float]] = {
    ("panda", "full"): [
        0,
        0,
        0.0437621316,
        0,
        0,
        0.00109263424,
        0,
        0.0187432666,
        0.0613428966,
        0.000910952291,
        0,
        0.00300606967,
    ],
    ("puma560", "full"): [
        0.000882744019,
        0.0406593617,
        0.23334289,
        0.000965546087,
        0.133330495,
        0.00238659164,
        0.000911317171,
        0.0680723756,
        0.014019609,
        0,
        0.0641604992,
        0.0730983053,
    ],
    ("talos_left_arm", "full"): [
        0.000638129291,
        0.0201703934,
        0.0102165204,
        0.000949277928,
        0.265853844,
        0.00221070372,
        0.000996106116,
        0.158512332,
        0.0017451781,
        0.000975203926,
        0.00112490566,
        0.156882295,
    ],
    ("stanford", "position"): [
        0,
        0.00881412245,
        0.00189757251,
        0,
        0,
        0.187218278,
        0.00025933905,
        0.0040732492,
        0,
        0,
        0.0108450731,
        0.00272457602,
    ],
    ("baxter", "position"): [
        0.000122528015,
        0.00391523277,
        0,
        0.00070994136,
        0,
        0,
        0,
        0.048382022,
        0.0353474847,
        0,
        0.0063139904,
        0,
    ],
}
"""As `python -m tests.ik.out_of_reach panda full`, and so on, prints them."""


def told(name: str, task: str, targets: Poses) -> Array:
    """√(distance² + angle²) of what comes nearest to each target, 0 of one that is solved; shape (N,)."""
    machine, chain = arm_of(name)
    answer = inverse_kinematics(machine, chain, targets, middle(chain), Options(task=TASKS[task]))
    return np.array(
        [
            np.hypot(failure.position_error, failure.orientation_error * (task == "full")) if failure else 0.0
            for failure in map(answer.failures.get, range(len(targets)))
        ]
    )


@pytest.mark.parametrize(("name", "task"), LEAST)
def test_the_nearest_is_as_near_as_any_of_two_thousand_descents_comes(name: str, task: str) -> None:
    least = np.array(LEAST[name, task])
    assert (told(name, task, targets_beyond(name, task, len(least))) <= 1.001 * least + 2e-6).all()


def test_the_search_does_not_stop_in_a_long_flat_valley() -> None:
    target = Poses(np.array([[0.3879913350382318, -0.3375814987450167, -0.5382831202882434]]), np.eye(3)[None])
    assert told("kinova", "position", target) <= 1.0001 * 0.000756777237


def test_of_several_valleys_that_end_at_limits_the_deepest_is_found() -> None:
    targets = targets_beyond("baxter", "position", 24)
    assert told("baxter", "position", Poses(targets.positions[14:15], targets.rotations[14:15])) <= 1.001 * 0.0031163812


def test_what_comes_near_enough_is_a_solution() -> None:
    machine, chain = arm_of("random 20")
    target = Poses(np.array([[1.0871345098346796, -0.9268627066740941, -1.716043225047256]]), np.eye(3)[None])
    answer = inverse_kinematics(machine, chain, target, middle(chain), Options(task=TASKS["position"]))
    assert answer.statuses == ["solved"]


@pytest.mark.slow
@pytest.mark.parametrize("task", ["full", "position"])
@pytest.mark.parametrize("name", [*CATALOGUE, *RANDOM])
def test_the_nearest_is_the_nearest_on_many_arms(name: str, task: str) -> None:
    targets = targets_beyond(name, task, 1)
    assert (told(name, task, targets) <= 1.001 * least_distances(name, task, targets) + 2e-6).all()
