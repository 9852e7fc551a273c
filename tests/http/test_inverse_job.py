"""Parts of a job of inverse kinematics, as the processes that compute them get them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import orjson
import pytest

from gelenk.contract.ik import InverseRequest
from gelenk.errors import UnknownJob
from gelenk.http.jobs.inverse_job import WORK, solved_part
from gelenk.http.jobs.long_work import npy_file
from gelenk.ik.search import search
from gelenk.jobs.robot_files import robot_files
from gelenk.operations.outcome import Limits
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import write_urdf
from tests.robots import robot as model

COUNT = 400
"""Targets enough for several threads."""


class _Told(Exception):
    pass


class _Run:
    """A run that only says of which argument its first part would be computed."""

    def __init__(self, is_here: bool) -> None:
        self.is_here = is_here
        self.argument: Any = None

    def map(self, _: str, function: object, argument: Callable[[int], Any], *__: object) -> None:
        assert function is solved_part
        self.argument = argument(0)
        raise _Told


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    request = tmp_path / "job" / "request"
    request.mkdir(parents=True)
    robot: RobotModel = model("panda")
    rng = np.random.default_rng(5)
    quaternions = rng.normal(size=(COUNT, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    rows = np.column_stack((rng.uniform(-0.4, 0.4, (COUNT, 3)), quaternions))
    base_frame, tip_frame = robot.default_chain
    call = InverseRequest.model_construct(targets=[], base_frame=base_frame, tip_frame=tip_frame, max_iterations=100)
    chain = robot.chain(base_frame, tip_frame)
    files = {
        **robot_files("panda", robot, write_urdf(robot.description)),
        "call.json": call.model_dump_json().encode(),
        "targets.npy": npy_file(rows),
        "seeds.npy": npy_file(np.zeros((1, len(chain)))),
    }
    for name, content in files.items():
        (request / name).write_bytes(content)
    return request


def _argument(folder: Path, is_here: bool) -> Any:
    run: Any = _Run(is_here)
    with pytest.raises(_Told):
        WORK.work(Limits(1000, 10.0), folder)(run)
    return run.argument


def test_here_a_part_reads_its_targets_itself_and_elsewhere_it_is_sent_them(folder: Path) -> None:
    here, elsewhere = _argument(folder, True), _argument(folder, False)
    assert not any(isinstance(value, np.ndarray) for value in here[3])
    assert elsewhere[3][0].shape == (COUNT, 7)
    assert solved_part(here) == solved_part(elsewhere)


def test_a_part_takes_one_thread(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(_: int) -> None:
        raise AssertionError("several threads")

    monkeypatch.setattr(search, "processors", lambda: 2)
    monkeypatch.setattr(search, "_pool", refused)
    part = solved_part(_argument(folder, False))
    with pytest.raises(AssertionError, match="threads"):
        search.in_pieces(lambda _: None, COUNT, 1, small=False)
    assert orjson.loads(part[16 : 16 + int.from_bytes(part[:16], "little")])


def test_a_part_of_a_removed_job_says_so(folder: Path) -> None:
    part = _argument(folder, True)
    for path in folder.iterdir():
        path.unlink()
    with pytest.raises(UnknownJob):
        solved_part(part)
