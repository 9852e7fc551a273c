"""`gelenk.Robot`, the core as a library: the numbers and the refusals of the service, with no service behind them."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import gelenk
from gelenk import errors
from gelenk.cli.local import InProcess
from gelenk.client import Client

ROWS = [
    {"type": "revolute", "a": 1.0, "alpha": 0.0, "d": 0.0, "theta": 0.0},
    {"type": "revolute", "a": 0.7, "alpha": 0.0, "d": 0.0, "theta": 0.0},
]
LIFT = np.array([[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0.05], [0, 0, 0, 0]])
Q = [[0.2, -1.3, 1.1, 0.4, 0.9, -0.5], [0.0, -1.5, 1.5, 0.1, 0.2, 0.3]]


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    with Client(transport=InProcess()) as client:
        yield client


@pytest.fixture(scope="module")
def ur5() -> gelenk.Robot:
    return gelenk.Robot.load("ur5")


def test_numbers_are_those_of_the_service(client: Client, ur5: gelenk.Robot) -> None:
    forward, served = ur5.fk(np.array(Q)), client.fk("ur5", joint_positions=Q)
    assert (forward.poses.matrices() == np.array(client.fk("ur5", joint_positions=Q, pose_format="matrix").poses)).all()
    assert forward.certificate.max_position_error == served.certificate.max_position_error
    assert (ur5.jacobian(Q).values == np.array(client.jacobian("ur5", joint_positions=Q).jacobians)).all()
    (measured,) = client.manipulability("ur5", joint_positions=Q[:1]).results
    assert measured.translation is not None
    assert ur5.manipulability(Q[0]).parts["translation"].measures == [measured.translation.measure]


def test_every_solution_is_that_of_the_service(client: Client, ur5: gelenk.Robot) -> None:
    targets = ur5.fk(Q).poses.matrices()
    found = ur5.ik(targets, seed=Q[0], solutions="all")
    answer = client.ik("ur5", targets=targets, seeds=Q[:1], solutions="all")
    assert found.statuses == [result.status for result in answer.results] == ["solved", "solved"]
    qs = [solution.joint_positions for result in answer.results for solution in result.solutions]
    assert found.qs == pytest.approx(np.array(qs), abs=1e-9)
    assert found.firsts[1] == len(answer.results[0].solutions) > 1


def test_a_motion_is_that_of_the_service(client: Client, ur5: gelenk.Robot) -> None:
    (T,) = ur5.fk(Q[1]).poses.matrices()
    segments: Any = [
        {"type": "joint", "target": Q[1]},
        {"type": "line", "target": {"matrix": T + LIFT}},
    ]
    found = ur5.trajectory(np.array(Q[0]), segments, law="quintic")
    answer = client.trajectory("ur5", start=Q[0], segments=segments, law="quintic", sample_period=0.05)
    assert found.motion.duration == pytest.approx(answer.duration)
    assert found.motion.at(np.array(answer.times)) == pytest.approx(np.array(answer.joint_positions), abs=1e-9)
    assert found.motion.rates_at(np.array(answer.times))[1] == pytest.approx(
        np.array(answer.joint_velocities), abs=1e-9
    )
    assert found.completed_fraction == answer.completed_fraction == 1.0
    assert found.audit.passed


def test_targets_and_configurations_come_in_every_form(ur5: gelenk.Robot) -> None:
    by_name = dict(zip(ur5.joint_names, Q[0], strict=True))
    forms: list[Any] = [Q[0], tuple(Q[0]), np.array(Q[0]), [np.array(Q[0])], by_name, [by_name]]
    (T,) = ur5.fk(Q[0]).poses.matrices()
    assert all((ur5.fk(q).poses.matrices() == [T]).all() for q in forms)
    pose = {"matrix": T.tolist()}
    solved = [ur5.ik(target, seed=Q[0]).qs for target in (T, [T], T.tolist(), pose, [pose])]
    assert all((qs == solved[0]).all() for qs in solved)
    apart = ur5.ik({"position": [5.0, 0.0, 0.0], "rpy": [0.0, 0.0, 0.0]})
    assert apart.statuses == ["unreachable"]
    assert "reach" in apart.failures[0].reason


def test_a_description_is_a_text_a_file_or_a_table(tmp_path: Path, client: Client) -> None:
    file = tmp_path / "an arm.urdf"
    file.write_text(client.urdf("planar_2r"))
    robots = [
        gelenk.Robot.load("planar_2r"),
        gelenk.Robot.from_urdf(file, "base", "tool"),
        gelenk.Robot.from_urdf(str(file), "base", "tool"),
        gelenk.Robot.from_urdf(file.read_text(), "base", "tool"),
        gelenk.Robot.from_dh(ROWS),
        gelenk.Robot.from_dh(ROWS, "standard", base=np.eye(4), tool=np.eye(4)),
    ]
    for robot in robots:
        assert robot.fk([0.3, 0.8]).poses.positions == pytest.approx(np.array([[1.2728537741, 0.9193653587, 0.0]]))
    assert repr(robots[0]) == "<gelenk.Robot 'planar_2r': base to tool, 2 joints>"
    assert {"panda", "planar_2r", "ur5"} <= set(gelenk.Robot.names())


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda _: gelenk.Robot.load("pandas"), errors.UnknownRobot, "did you mean 'panda'"),
        (lambda _: gelenk.Robot.load("../robots/panda"), errors.UnknownRobot, "no robot named"),
        (lambda _: gelenk.Robot.load("ur5", tip_frame="hand"), errors.UnknownFrame, "hand"),
        (lambda _: gelenk.Robot.from_urdf("<robot name='a'/>"), errors.InvalidUrdf, "no link"),
        (lambda _: gelenk.Robot.from_dh([{"type": "revolute"}]), errors.InvalidField, r"joints\.0\.a"),
        (lambda _: gelenk.Robot.from_dh(ROWS, tool=2 * np.eye(4)), errors.InvalidPose, "0 0 0 1"),
        (lambda ur5: ur5.fk([0.0]), errors.WrongJointCount, "1 number where the chain has 6"),
        (lambda ur5: ur5.fk([np.nan] * 6), errors.InvalidField, "finite"),
        (lambda ur5: ur5.ik(np.eye(3)), errors.InvalidArray, r"\(3, 3\)"),
        (lambda ur5: ur5.ik(np.eye(4), solution="all"), errors.InvalidField, "'solution'.*known are.* solutions"),
        (lambda ur5: ur5.ik(np.eye(4), solutions="some"), errors.InvalidField, "'one' or 'all'"),
        (lambda ur5: ur5.trajectory(Q[0], [{"type": "leap"}]), errors.InvalidField, "segments.*joint, line"),
        (lambda ur5: ur5.trajectory(Q[0][:5], []), errors.InvalidField, "segments"),
        (lambda ur5: ur5.trajectory([9.0] * 6, [{"type": "joint", "target": Q[0]}]), errors.OutsideLimits, "limit"),
    ],
)
def test_a_refusal_names_what_is_wrong(
    ur5: gelenk.Robot, call: Callable[[gelenk.Robot], object], kind: type[Exception], words: str
) -> None:
    with pytest.raises(kind, match=words):
        call(ur5)


def test_importing_the_package_loads_nothing_else() -> None:
    code = "import sys; before = set(sys.modules); import gelenk; print(*sorted(set(sys.modules) - before))"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not {"numpy", "pydantic", "numba", "gelenk.engine"} & set(run.stdout.split())
