"""What a checker of types lets pass of a program that uses the client: what can be sent, and nothing else."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import gelenk

PROGRAM = """
import asyncio
from typing import assert_type
import numpy as np
import numpy.typing as npt
from gelenk.client.arrays import Reached
from gelenk.client.jobs import Job
from gelenk.client import AsyncClient, Client
from gelenk.contract.ik import InverseAnswer
from gelenk.contract.fk import ForwardAnswer
from gelenk.contract.pose import Pose
from gelenk.contract.statics import PayloadInfo
from gelenk.contract.trajectory_request import JointSegment

Array = npt.NDArray[np.float64]


def ask(
    gelenk: Client, qs: Array, Ts: Array, rows: list[list[float]], one: tuple[float, ...],
    words: npt.NDArray[np.str_], complex_qs: npt.NDArray[np.complex128],
) -> None:
    assert_type(gelenk.fk("panda", joint_positions=qs), ForwardAnswer)
    gelenk.fk("panda", joint_positions=np.linspace([0.0, 0.0], [1.0, 1.0], 9), pose_format="matrix")
    gelenk.fk("panda", joint_positions=rows)
    gelenk.fk("panda", joint_positions=[one, qs[0], {"joint_1": 0.3}])
    gelenk.jacobian("panda", joint_positions=qs, joint_velocities=qs, derivatives=["time_variation"])
    assert_type(gelenk.ik("panda", targets=Ts, seeds=qs, posture=qs[0]), InverseAnswer)
    poses = gelenk.fk("panda", joint_positions=qs).poses
    gelenk.ik("panda", targets=poses, seeds=[qs[0]])
    gelenk.ik("panda", targets=np.array(poses))
    gelenk.velocity("panda", joint_positions=qs, twists=np.zeros((9, 6)))
    gelenk.statics("panda", joint_positions=qs, wrenches=rows, payload=PayloadInfo(mass=1.0))
    gelenk.dynamics("panda", joint_positions=qs, joint_velocities=qs, torques=rows)
    gelenk.trajectory("panda", start=qs[0], segments=[JointSegment(type="joint", target=qs[1])])
    assert_type(gelenk.arrays.ik("panda", Ts), Reached)
    with gelenk.jobs.ik("panda", targets=Ts) as job:
        assert_type(job, Job[InverseAnswer])

    gelenk.fk("panda", joint_positions="0.3 0.8")  # refused
    gelenk.fk("panda", joint_positions=[0.3, 0.8])  # refused
    gelenk.fk("panda", joint_positions=[["a", "b"]])  # refused
    gelenk.fk("panda", joint_positions=words)  # refused
    gelenk.fk("panda", joint_positions=complex_qs)  # refused
    gelenk.fk("panda", joint_positions=None)  # refused
    gelenk.fk("panda", qs)  # refused
    gelenk.fk(7, joint_positions=qs)  # refused
    gelenk.fk("panda", joint_positions=qs, pose_format="euler")  # refused
    gelenk.fk("panda", joint_positions=qs, colour="red")  # refused
    gelenk.ik("panda", targets=rows)  # refused
    gelenk.ik("panda", targets=[Pose(position=[0.4, 0.1, 0.5], rpy="none")])  # refused
    gelenk.arrays.fk("panda", "0.3 0.8")  # refused
    gelenk.jobs.ik("panda", targets=7)  # refused


async def ask_later(qs: Array) -> None:
    async with AsyncClient() as gelenk:
        first, second = await asyncio.gather(gelenk.fk("panda", joint_positions=qs), gelenk.robot("panda"))
        assert_type(first, ForwardAnswer)
        gelenk.fk("panda", joint_positions=qs).poses  # refused
"""


@pytest.mark.slow
def test_what_can_be_sent_passes_and_nothing_else(tmp_path: Path) -> None:
    """Strictly, with no settings of ours and no plugin."""
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    options = ["--strict", "--config-file=", "--follow-imports=silent", f"--cache-dir={tmp_path / 'cache'}"]
    checked = subprocess.run(
        [sys.executable, "-m", "mypy", *options, "--no-error-summary", program.name],
        cwd=tmp_path,
        env={**os.environ, "MYPYPATH": str(Path(gelenk.__file__).parents[1])},
        capture_output=True,
        text=True,
        timeout=500,
        check=False,
    )
    assert not checked.stderr, checked.stderr
    errors = [line for line in checked.stdout.splitlines() if ": error: " in line]
    lines = PROGRAM.splitlines()
    expected = [number for number, line in enumerate(lines, start=1) if line.endswith("# refused")]
    assert len(expected) == 15
    assert sorted({int(error.split(":")[1]) for error in errors}) == expected, checked.stdout
