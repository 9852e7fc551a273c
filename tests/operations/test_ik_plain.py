"""A plain call of inverse kinematics: the same answer as in the general way, and all else left to that."""

import json
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any

import numpy as np
import orjson
import pytest

from gelenk.contract.ik import InverseRequest
from gelenk.errors import InvalidInput, TooLarge
from gelenk.ik.closed.closed_form import closed_form
from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.operations import ik, ik_plain
from gelenk.operations.ik_plain import plain_outcome
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.pose_arrays import pose_list
from gelenk.robot.poses import Poses
from gelenk.settings import Settings
from gelenk.store.library import Library
from gelenk.store.records import LoadedRobot

LIMITS = Limits(1000, 60.0)


@cache
def loaded(name: str, base_frame: str | None = None, tip_frame: str | None = None) -> LoadedRobot:
    """A robot of which it is known whether the chain has a closed form."""
    folder = Settings().catalogue_dir
    found = Library(folder, folder / "none").get(name)
    closed_form(found.robot.chain(base_frame, tip_frame))
    return found


def call_for(name: str, count: int, first: int = 0, **fields: Any) -> InverseRequest:
    machine = loaded(name).robot
    chain = machine.chain(fields.get("base_frame"), fields.get("tip_frame"))
    qs = np.random.default_rng(first).uniform(chain.lower, chain.upper, (count, len(chain)))
    targets = pose_list(Poses(*chain_poses(chain.flat, qs)), "quaternion_xyzw")
    if fields.get("seeds") == "near":
        fields["seeds"] = (qs + 0.05).tolist()
    return InverseRequest.model_validate_json(json.dumps({"targets": targets, **fields}))


def parts_of(outcome: Outcome | None, count: int) -> tuple[Any, ...]:
    """All that an answer may be made of."""
    assert outcome is not None
    assert outcome.array is not None
    assert outcome.solved is not None
    rows, headers = outcome.array()
    content = orjson.dumps(outcome.content(), option=orjson.OPT_SERIALIZE_NUMPY)
    return content, rows.tolist(), headers, outcome.solved(count)


@pytest.mark.parametrize(
    "fields",
    [
        {},
        {"seeds": "near"},
        {"seeds": [[0.1] * 7]},
        {"respect_limits": False, "random_seed": 3},
        {"position_tolerance": 1e-3, "orientation_tolerance": 1e-2},
        {"base_frame": "panda_link1", "tip_frame": "panda_link8", "seeds": [[0.1] * 6]},
    ],
)
@pytest.mark.parametrize("count", [1, 4])
def test_it_is_what_the_general_way_answers(count: int, fields: dict[str, Any]) -> None:
    robot, compared = loaded("panda", fields.get("base_frame"), fields.get("tip_frame")), 0
    for first in range(0, 40, count):
        call = call_for("panda", count, first, **fields)
        if (found := plain_outcome(robot, call, LIMITS)) is not None:
            assert parts_of(found, count) == parts_of(ik.run(robot, call, LIMITS), count)
            compared += 1
    assert compared * count > 20


@pytest.mark.parametrize(
    ("name", "fields"),
    [
        ("panda", {"task": ["x", "y", "z"]}),
        ("panda", {"method": "analytic"}),
        ("panda", {"targets": []}),
        ("panda", {"targets": [{"position": [0.4, 0.0, 0.4], "rpy": [3.0, 0.0, 0.0]}]}),
        ("panda", {"targets": [{"position": [0.4, 0.0, 0.4], "quaternion_xyzw": [1.0, 1.0, 0.0, 0.0]}]}),
        ("ur5", {}),
    ],
)
def test_it_leaves_other_calls_to_the_general_way(name: str, fields: dict[str, Any]) -> None:
    assert plain_outcome(loaded(name), call_for(name, 1, **fields), LIMITS) is None


def test_it_leaves_refusals_and_large_answers_to_the_general_way() -> None:
    robot, call = loaded("panda"), call_for("panda", 2)
    assert plain_outcome(robot, call, Limits(22, 60.0)) is not None
    small = Limits(21, 60.0)
    assert plain_outcome(robot, call, small) is None
    with pytest.raises(TooLarge, match="numbers in the answer"):
        ik.attempt(robot, call, small)
    assert plain_outcome(robot, call_for("panda", 8), LIMITS) is not None
    assert plain_outcome(robot, call_for("panda", 9), LIMITS) is None
    for seeds in ([[0.0] * 7] * 3, [[0.0] * 6]):
        wrong = call_for("panda", 2, seeds=seeds)
        with pytest.raises(InvalidInput) as general:
            ik.run(robot, wrong, LIMITS)
        with pytest.raises(type(general.value)) as plain:
            plain_outcome(robot, wrong, LIMITS)
        assert str(plain.value) == str(general.value)


def test_a_target_without_a_solution_is_left_to_a_worker() -> None:
    robot, call = loaded("panda"), call_for("panda", 2)
    call.targets[1].position[:] = [9.0, 9.0, 9.0]  # type: ignore[union-attr]
    assert plain_outcome(robot, call, LIMITS) is None
    assert ik.attempt(robot, call, LIMITS) is None


def test_nothing_is_prepared_that_would_take_long(monkeypatch: pytest.MonkeyPatch) -> None:
    folder = Settings().catalogue_dir
    robot, call = Library(folder, folder / "none").get("panda"), call_for("panda", 1)
    assert plain_outcome(robot, call, LIMITS) is None
    assert not ik.WARM_UP.is_known(robot, call), "it has not been found on the way"
    ik.WARM_UP.keep(robot, call, ik.WARM_UP.find(robot, call))
    monkeypatch.setattr(ik_plain, "is_awaited", lambda: True)
    assert plain_outcome(robot, call, LIMITS) is None, "the kernels are still compiled"
    monkeypatch.undo()
    assert plain_outcome(robot, call, LIMITS) is not None
    monkeypatch.setattr(ik_plain, "is_awaited", lambda: True)
    assert plain_outcome(robot, call, LIMITS) is not None, "this search is prepared"


def test_threads_share_it() -> None:
    robot = loaded("panda")
    calls = [call_for("panda", 1, i) for i in range(30)] * 4

    def positions(call: InverseRequest) -> Any:
        found = plain_outcome(robot, call, LIMITS)
        return found and parts_of(found, 1)[1]

    alone = [positions(call) for call in calls]
    with ThreadPoolExecutor(8) as threads:
        together = list(threads.map(positions, calls))
    assert sum(one is not None for one in alone) > 100
    for one, other in zip(alone, together, strict=True):
        np.testing.assert_array_equal(one, other)
