"""What a checker of types lets pass of a program that uses the client: what can be sent, and nothing else."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any, get_type_hints

import numpy as np
import pytest
from pydantic import BaseModel

import gelenk
from gelenk.contract.pose import Pose
from gelenk.contract.segment_dicts import CircleDict, JointDict, LimitsDict, LineDict, OptionsDict, SplineDict
from gelenk.contract.trajectory_request import (
    CircleSegment,
    JointSegment,
    LineSegment,
    MotionOptions,
    SplineSegment,
    TrajectoryLimits,
)

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
from gelenk.contract.trajectory_request import CircleSegment, JointSegment, LineSegment, SplineSegment

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
    assert_type(poses[0].position, list[float])
    assert_type(poses[0].position[0] + 0.1, float)
    gelenk.ik("panda", targets=[{"position": [0.4, 0.1, 0.5], "quaternion_xyzw": [0.0, 1.0, 0.0, 0.0]}])
    gelenk.ik("panda", targets=[{"position": (0.4, 0.1, 0.5), "rpy": qs[0]}, {"matrix": Ts[0]}, poses[0]])
    gelenk.ik("panda", targets=[{"position": poses[0].position}], task=["x", "y", "z"])
    gelenk.ik("panda", targets=[{"kuka_abc": [400.0, 100.0, 500.0, 0.0, 90.0, 0.0]}])
    gelenk.arrays.ik("panda", Ts, respect_limits=False)
    gelenk.velocity("panda", joint_positions=qs, twists=np.zeros((9, 6)))
    gelenk.statics("panda", joint_positions=qs, wrenches=rows, payload=PayloadInfo(mass=1.0))
    gelenk.dynamics("panda", joint_positions=qs, joint_velocities=qs, torques=rows)
    gelenk.trajectory("panda", start=qs[0], segments=[JointSegment(type="joint", target=qs[1])])
    gelenk.trajectory(
        "panda",
        start=qs[0],
        segments=[
            {"type": "joint", "target": {"joint_1": 0.3}, "law": "quintic"},
            {"type": "joint", "target": qs[1]},
            {"type": "joint", "target": {"position": [0.4, 0.1, 0.5], "rpy": [0.0, 1.0, 0.0]}},
            {"type": "line", "target": {"position": (0.4, 0.1, 0.5), "rpy": qs[0]}, "blend_radius": 0.05},
            {"type": "line", "target": poses[0], "limits": {"tip_velocity": 0.2, "joint_velocity": [1.0, 2.0]}},
            {"type": "circle", "via": {"matrix": Ts[0]}, "target": {"kuka_abc": [400, 100, 500, 0, 90, 0]}},
            {"type": "spline", "waypoints": [qs[0], qs[1]], "times": [1.0, 2.0], "boundary": "natural"},
            {"type": "spline", "waypoints": [{"position": [0.4, 0.1, 0.5], "rpy": [0.0, 1.0, 0.0]}, poses[0]]},
            JointSegment(type="joint", target=qs[1]),
            JointSegment(type="joint", target={"position": [0.4, 0.1, 0.5], "rpy": [0.0, 1.0, 0.0]}),
            LineSegment(type="line", target={"position": (0.4, 0.1, 0.5), "rpy": qs[0]}, limits={"tip_velocity": 0.2}),
            CircleSegment(type="circle", via={"matrix": Ts[0]}, target=poses[0]),
            SplineSegment(type="spline", waypoints=[{"matrix": Ts[0]}, poses[0]], waypoint_options=[None, {}]),
        ],
        limits={"joint_velocity": qs[0], "joint_torque": "effort", "tip_velocity": 0.3},
    )
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
    gelenk.ik("panda", targets=[{"position": [0.4, 0.1, 0.5], "euler": [0.0, 1.0, 0.0]}])  # refused
    gelenk.ik("panda", targets=[{"position": [0.4, 0.1, 0.5], "rpy": "none"}])  # refused
    gelenk.ik("panda", targets=[{"rpy": [0.0, 1.0, 0.0]}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[{"type": "line", "goal": poses[0]}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[{"type": "arc", "target": poses[0]}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[{"type": "line", "target": {"euler": qs[0]}}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[{"type": "line", "target": qs[0], "speed": 1.0}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[{"type": "joint", "target": [0.4], "law": "x"}])  # refused
    gelenk.trajectory("panda", start=qs[0], segments=[], limits={"velocity": 1.0})  # refused
    LineSegment(type="line", target=rows[0])  # refused
    LineSegment(type="line", target={"euler": [0.0, 1.0, 0.0]})  # refused
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
    assert len(expected) == 26
    assert sorted({int(error.split(":")[1]) for error in errors}) == expected, checked.stdout


DICTS: dict[type, Any] = {
    TrajectoryLimits: LimitsDict, MotionOptions: OptionsDict, JointSegment: JointDict, LineSegment: LineDict,
    CircleSegment: CircleDict, SplineSegment: SplineDict,
}  # fmt: skip


@pytest.mark.parametrize("model", DICTS, ids=lambda model: model.__name__)
def test_the_dicts_of_segments_have_the_fields_of_their_models(model: type[BaseModel]) -> None:
    fields = model.model_fields
    assert set(get_type_hints(DICTS[model])) == set(fields)
    assert DICTS[model].__required_keys__ == {name for name, field in fields.items() if field.is_required()}


def test_dicts_within_models_become_models_with_lists_in_place_of_arrays() -> None:
    place: Any = {"position": np.array([0.4, 0.1, 0.5]), "rpy": (0.0, 1.0, 0.0)}
    line = LineSegment(type="line", target=place, limits={"joint_velocity": np.ones(7)})
    as_models = Pose(position=[0.4, 0.1, 0.5], rpy=[0.0, 1.0, 0.0]), TrajectoryLimits(joint_velocity=[1.0] * 7)
    assert (line.target, line.own_limits()) == as_models
    through = SplineSegment(type="spline", waypoints=[place], waypoint_options=[{"limits": {"tip_velocity": 0.2}}])
    assert through.waypoint_options == [MotionOptions(limits=TrajectoryLimits(tip_velocity=0.2))]
