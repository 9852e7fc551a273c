"""Answers while another process still compiles the kernels of a search."""

import threading
from collections.abc import Iterator

import numpy as np
import pytest

from gelenk.ik.search.bounds import mid_range
from gelenk.ik.solve import Options, inverse_kinematics
from gelenk.robot import compilation
from gelenk.robot.poses import Poses
from tests.ik.arms import assert_solved, draw, poses
from tests.robots import robot


@pytest.fixture
def stored(monkeypatch: pytest.MonkeyPatch) -> Iterator[threading.Event]:
    """Set when the other process has stored what it compiles."""
    event = threading.Event()
    monkeypatch.setattr(compilation, "is_stored", event.is_set)
    compilation.expect_others(True)
    yield event
    compilation.expect_others(False)


@pytest.mark.parametrize("name", ["panda", "ur5", "scara", "planar_2r"])
def test_few_targets_are_solved_without_them_and_say_so(name: str, stored: threading.Event) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    targets = poses(machine, chain, draw(chain, 8, seed=5))
    answer = inverse_kinematics(machine, chain, targets, mid_range(chain)[None], Options())
    assert answer.method == "interpreted_least_squares"
    assert_solved(machine, chain, targets, answer)
    assert not stored.is_set()


@pytest.mark.slow
@pytest.mark.parametrize("options", [Options(), Options(every=True)], ids=["out of reach", "all"])
def test_what_only_the_kernels_can_tell_waits_for_them(options: Options, stored: threading.Event) -> None:
    machine = robot("ur5")
    chain = machine.chain(None, None)
    far = Poses(np.array([[9.0, 0.0, 0.0]]), np.eye(3)[None])
    waited: list[bool] = []

    def end() -> None:
        waited.append(True)
        stored.set()

    timer = threading.Timer(0.3, end)
    timer.start()
    answer = inverse_kinematics(machine, chain, far, mid_range(chain)[None], options)
    assert waited
    assert answer.statuses == ["unreachable"]
    timer.join()
