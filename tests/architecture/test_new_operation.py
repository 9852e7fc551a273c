"""A new operation is two files: what travels, and the answer. Everything else is made of them."""

import json
import os
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

import pytest

CONTRACT = '''
from gelenk.contract.common import Answer, ChainOptions
from gelenk.contract.endpoint import RobotEndpoint
from gelenk.contract.kinematics import Configurations


class SpreadOptions(ChainOptions):
    """Options of the spread."""

    respect_limits: bool = False


class SpreadRequest(SpreadOptions):
    """Configurations."""

    joint_positions: Configurations


class SpreadAnswer(Answer):
    """How far each joint goes."""

    spread: list[float]


ENDPOINT = RobotEndpoint(
    name="spread",
    request=SpreadRequest,
    answer=SpreadAnswer,
    summary="Spread of configurations",
    description="How far each joint goes in a batch.",
    batch="joint_positions",
    options=SpreadOptions,
    npy_body="`joint_positions`, shape (N, n).",
    npy_answer="The spread, shape (n,).",
    example={"joint_positions": [[0.0, 0.0], [1.0, 2.0]]},
)
'''

OPERATION = """
import os

from gelenk.operations.chains import chain_and_positions
from gelenk.operations.outcome import Outcome


def run(robot, request, limits):
    chain, qs = chain_and_positions(robot.robot, request)
    spread = qs.max(axis=0) - qs.min(axis=0)
    return Outcome(lambda: {"spread": spread.tolist()}, lambda: (spread, {"Where": str(os.getpid())}))


def is_heavy(request):
    return len(request.joint_positions) > 2
"""

AT_START = """
import sys
from pathlib import Path

import gelenk.contract
import gelenk.operations

folder = Path(__file__).parent
gelenk.contract.__path__.append(str(folder / "contract"))
gelenk.operations.__path__.append(str(folder / "operations"))
"""

PROGRAM = """
import io, json, os, tempfile
from pathlib import Path

import numpy as np
from fastapi.testclient import TestClient

from gelenk.cli.ask import operations
from gelenk.cli.local import InProcess
from gelenk.client import Client
from gelenk.main import create_app
from gelenk.settings import Settings

found = {}
with TestClient(create_app(Settings(data_dir=Path(tempfile.mkdtemp()), crew_processes=1))) as service:
    path = "/v1/robots/planar_2r/spread"
    found["quick"] = service.post(path, json={"joint_positions": [[0, 0], [1, 2]]}).json()
    body = io.BytesIO()
    np.save(body, np.array([[0.0, 0.0], [1.0, 2.0], [3.0, 1.0]]))
    headers = dict.fromkeys(("Content-Type", "Accept"), "application/x-npy")
    answer = service.post(path, content=body.getvalue(), headers=headers)
    found["worker"] = [np.load(io.BytesIO(answer.content)).tolist(), answer.headers["Where"] != str(os.getpid())]
    found["refused"] = service.post(path, json={"joint_position": []}).json()["status"]
    operation = service.get("/openapi.json").json()["paths"]["/v1/robots/{robot}/spread"]["post"]
    found["documented"] = [operation["summary"], sorted(operation["requestBody"]["content"])]
    found["scope"] = operation["security"]
    found["counted"] = 'operation="spread"' in service.get("/metrics").text
with Client(transport=InProcess()) as client:
    found["client"] = client.spread("planar_2r", joint_positions=[[0, 0], [1, 2]]).spread
found["asked"] = "spread" in operations()
print(json.dumps(found))
"""


@pytest.mark.slow
def test_two_files_make_an_operation_of_all_parts(tmp_path: Path) -> None:
    for folder, text in (("contract", CONTRACT), ("operations", OPERATION)):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "spread.py").write_text(dedent(text))
    (tmp_path / "sitecustomize.py").write_text(AT_START)
    paths = os.pathsep.join([str(tmp_path), *(entry for entry in sys.path if entry)])
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": paths},
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout.splitlines()[-1]) == {
        "quick": {"spread": [1.0, 2.0]},
        "worker": [[3.0, 2.0], True],
        "refused": 422,
        "documented": ["Spread of configurations", ["application/json", "application/x-npy"]],
        "scope": [{}, {"key": ["read"]}],
        "counted": True,
        "client": [1.0, 2.0],
        "asked": True,
    }
