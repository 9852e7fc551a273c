"""The schema is fit for code generation: clients made of it compile, and ask the service.

Python's is made by openapi-python-client, the types of TypeScript by openapi-typescript, which is there after `npm ci`
in the folder `typescript`.
"""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from gelenk.client import Client
from tests.corpus import zips
from tests.openapi import document

HERE = Path(__file__).parent
TYPESCRIPT = HERE / "typescript"
Q = [0.3, 0.8]

ASKING = """
import importlib, io, json, pkgutil, sys
import gelenk_client
from gelenk_client import AuthenticatedClient, Client, models
from gelenk_client.api.kinematics import forward_kinematics, inverse_kinematics
from gelenk_client.api.robots import add_robot, remove_robot
from gelenk_client.types import File

for module in pkgutil.walk_packages(gelenk_client.__path__, "gelenk_client."):
    importlib.import_module(module.name)
client = AuthenticatedClient(base_url=sys.argv[1], token="none is needed")
by_name = models.JointValues.from_dict({"joint_1": 0.3, "joint_2": 0.8})
request = models.ForwardRequest(joint_positions=[[0.3, 0.8], by_name], pose_format="matrix")
poses = forward_kinematics.sync("planar_2r", client=client, body=request)
target = models.Pose(position=[0.4, 0.2, 0.5], rpy=[3.0, 0.2, 0.4])
inverse = inverse_kinematics.sync("ur5", client=client, body=models.InverseRequest(targets=[target], solutions="all"))
archive = File(io.BytesIO(sys.stdin.buffer.read()), "arm.zip")
archive = models.AddRobotFilesNewArchive(name="generated_arm", archive=archive)
added = add_robot.sync(client=client, body=archive)
removed = remove_robot.sync_detailed("generated_arm", client=client)
problem = forward_kinematics.sync("pandda", client=client, body=request)
assert isinstance(problem, models.Problem), problem
print(json.dumps({
    "poses": poses.to_dict(), "inverse": inverse.to_dict(), "meshes": len(added.meshes),
    "removed": removed.status_code, "problem": problem.to_dict(),
}))
"""


@pytest.fixture(scope="module")
def schema(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The schema in a file."""
    file = tmp_path_factory.mktemp("schema") / "openapi.json"
    file.write_text(json.dumps(document()))
    return file


def output_of(*command: object, cwd: Path, stdin: bytes = b"") -> str:
    """What a program writes, errors included; it must not fail."""
    run = subprocess.run(
        [str(word) for word in command],
        cwd=cwd,
        input=stdin,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stdout.decode()
    return run.stdout.decode()


@pytest.mark.slow
def test_a_client_in_python(schema: Path, gelenk: Client, tmp_path: Path) -> None:
    """It is made without a warning, has no error of types, and gets what ours gets."""
    folder, config = tmp_path / "made", HERE / "openapi-python-client.yml"
    module = [sys.executable, "-m", "openapi_python_client"]
    told = output_of(
        *module, "generate", "--path", schema, "--output-path", folder, "--config", config, cwd=schema.parent
    )
    assert told.split() == ["Generating", str(folder)]
    types = ["--strict", "--no-incremental", f"--cache-dir={tmp_path / 'cache'}", "--config-file="]
    assert "Success" in output_of(sys.executable, "-m", "mypy", *types, "gelenk_client", cwd=folder)

    found = json.loads(output_of(sys.executable, "-c", ASKING, gelenk.url, cwd=folder, stdin=zips.good()))
    ours = gelenk.fk(
        "planar_2r", joint_positions=[Q, dict(zip(("joint_1", "joint_2"), Q, strict=True))], pose_format="matrix"
    )
    target = {"position": [0.4, 0.2, 0.5], "rpy": [3.0, 0.2, 0.4]}
    assert found["poses"] == told_by(ours)
    assert found["inverse"] == told_by(gelenk.ik("ur5", targets=[target], solutions="all"))  # type: ignore[list-item]
    assert (found["meshes"], found["removed"]) == (1, 204)
    assert found["problem"]["type"] == "urn:gelenk:unknown-robot"
    assert "panda" in found["problem"]["close"]


def told_by(answer: Any) -> Any:
    return answer.model_dump(mode="json", exclude_unset=True)


@pytest.mark.slow
@pytest.mark.skipif(not (TYPESCRIPT / "node_modules").is_dir(), reason="needs `npm ci` in tests/client/typescript")
def test_types_in_typescript(schema: Path, gelenk: Client, tmp_path: Path) -> None:
    """A program that is typed by them compiles, but for the mistake in it that it expects, and gets what ours gets."""
    for name in ("use.ts", "tsconfig.json"):
        (tmp_path / name).write_bytes((TYPESCRIPT / name).read_bytes())
    tools = TYPESCRIPT / "node_modules" / ".bin"
    told = output_of(
        tools / "openapi-typescript", schema, "--default-non-nullable", "false", "-o", "schema.ts", cwd=tmp_path
    )
    assert "warn" not in told.lower()
    output_of(tools / "tsc", "-p", ".", "--outDir", "made", cwd=tmp_path)
    (tmp_path / "made" / "package.json").write_text('{"type": "module"}')
    where = f"data:text/javascript,globalThis.service='{gelenk.url}'"
    found = json.loads(output_of("node", "--import", where, "made/use.js", cwd=tmp_path))
    target = {"position": [0.4, 0.2, 0.5], "rpy": [3.0, 0.2, 0.4]}
    ours = gelenk.fk("planar_2r", joint_positions=[Q, Q], pose_format="matrix")
    inverse = gelenk.ik("ur5", targets=[target], solutions="all")  # type: ignore[list-item]
    assert found["poses"] == [pose.matrix for pose in ours.poses]
    assert found["branches"] == sum(len(result.solutions) for result in inverse.results) > 1
    assert found["joints"] == gelenk.robot("typed_arm").joint_names
    assert found["status"] == 422
    assert "denavit" in found["detail"] or "convention" in found["detail"]
    gelenk.remove_robot("typed_arm")
