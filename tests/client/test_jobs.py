"""What may take long, as jobs: the same answers, progress on the way, and nothing left behind."""

import asyncio
from typing import Any, assert_type

import numpy as np
import pytest

from gelenk import errors
from gelenk.client import AsyncClient, Client
from gelenk.client.jobs import AsyncJob, Job
from gelenk.client.refusals import Refused
from gelenk.contract.ik import InverseAnswer
from gelenk.contract.trajectory_answer import TrajectoryAnswer
from gelenk.contract.workspace import WorkspaceAnswer
from gelenk.robot.arrays import Array
from tests.robots import robot, samples

MOTION: dict[str, Any] = {"start": [0.3, 0.8], "segments": [{"type": "joint", "target": [0.5, 0.2]}]}
LONG = 2_000_000
"""Samples that take longer than it takes to leave."""


@pytest.mark.slow
def test_a_job_answers_what_the_call_does_at_once(gelenk: Client) -> None:
    matrices = np.array(gelenk.arrays.fk("ur5", samples(robot("ur5").chain(None, None), 40), pose_format="matrix"))
    told: list[float] = []
    with gelenk.jobs.ik("ur5", targets=matrices) as job:
        assert_type(job, Job[InverseAnswer])
        answer = job.result(lambda info: told.append(info.progress))
        assert_type(answer, InverseAnswer)
        at_once = gelenk.ik("ur5", targets=matrices)
        assert answer == at_once
        assert np.array_equal(job.array(), [result.solutions[0].joint_positions for result in at_once.results])
        assert job.info.state == "succeeded"
    assert told == sorted(told)
    assert told[-1] == 1.0
    with pytest.raises(errors.UnknownJob):
        gelenk.job(job.id)


def test_a_joint_is_held_in_a_job_as_in_a_call(gelenk: Client) -> None:
    there = gelenk.fk("panda", joint_positions=[[0.1, -0.5, 0.2, -1.9, 0.3, 1.5, 0.6]]).poses
    held: dict[str, Any] = {"targets": there, "solutions": "all", "fixed_joints": {"panda_joint7": 0.6}}
    with gelenk.jobs.ik("panda", **held) as job:
        answer = job.result()
    assert answer == gelenk.ik("panda", **held)
    assert {solution.joint_positions[6] for solution in answer.results[0].solutions} == {0.6}
    assert answer.results[0].complete


@pytest.mark.slow
def test_motions_and_workspaces(gelenk: Client) -> None:
    with gelenk.jobs.trajectory("planar_2r", **MOTION) as motion:
        assert_type(motion.result(), TrajectoryAnswer)
        assert motion.result() == gelenk.trajectory("planar_2r", **MOTION)
    with gelenk.jobs.workspace("planar_2r", samples=5_000) as job:
        states = [info.state for info in job]
        answer = job.result()
        assert_type(answer, WorkspaceAnswer)
        assert job.array().shape == tuple(answer.array.shape)
    assert states[-1] == "succeeded"


def test_who_leaves_ends_the_job(gelenk: Client) -> None:
    with pytest.raises(KeyboardInterrupt), gelenk.jobs.workspace("panda", samples=LONG, kind="grid") as job:
        raise KeyboardInterrupt
    assert gelenk.job(job.id).state == "cancelled"
    with pytest.raises(errors.JobCancelled):
        job.result()
    with pytest.raises(errors.JobFinished):
        job.cancel()
    assert job.cancel("remove").state == "cancelled"


def test_what_is_wrong_is_said_before_there_is_a_job(gelenk: Client) -> None:
    with pytest.raises(errors.UnknownRobot):
        gelenk.jobs.trajectory("planar_9r", **MOTION)
    with pytest.raises(Refused, match="time_limit"):
        gelenk.jobs.ik("ur5", targets=targets_of(gelenk), time_limit=1.0)


def targets_of(gelenk: Client) -> Any:
    return gelenk.fk("ur5", joint_positions=[[0.1, -1.0, 1.0, 0.2, 0.3, 0.1]]).poses


@pytest.mark.slow
def test_awaited(url: str) -> None:
    async def ask() -> tuple[InverseAnswer, InverseAnswer, Array, list[Any], str]:
        async with AsyncClient(url) as gelenk:
            there = (await gelenk.fk("ur5", joint_positions=[[0.1, -1.0, 1.0, 0.2, 0.3, 0.1]])).poses
            async with await gelenk.jobs.ik("ur5", targets=there, solutions="all") as job:
                assert_type(job, AsyncJob[InverseAnswer])
                states = [info.state async for info in job]
                found, at_once = await job.result(), await gelenk.ik("ur5", targets=there, solutions="all")
            motion = await gelenk.jobs.trajectory("planar_2r", **MOTION)
            samples = await motion.array()
            await motion.cancel("remove")
            return found, at_once, samples, states, job.id

    found, at_once, sampled, states, job = asyncio.run(ask())
    assert found == at_once
    assert states[-1] == "succeeded"
    with Client(url) as gelenk:
        assert np.array_equal(sampled, gelenk.arrays.trajectory("planar_2r", **MOTION).samples)
        with pytest.raises(errors.UnknownJob):
            gelenk.job(job)
