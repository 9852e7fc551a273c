"""What is too fine to be done is refused before there is a job, and what the refusal allows is taken."""

import re
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fastapi.testclient import TestClient

from gelenk.jobs import workspace_request
from gelenk.kinematics.workspace.voxels import merged
from gelenk.kinematics.workspace.workspace import PART, Wish, plan, sampled
from gelenk.main import create_app
from gelenk.settings import Settings
from gelenk.store.library import Library
from tests.http.test_jobs import ended

CATALOGUE = Path("robots")
LATER = {"Prefer": "respond-async"}


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    with served(tmp_path_factory.mktemp("data")) as service:
        yield service


def served(folder: Path, job_bytes: int = 2**30) -> TestClient:
    return TestClient(create_app(Settings(data_dir=folder, job_processes=1, job_bytes=job_bytes)))


def asked(client: TestClient, path: str, call: dict[str, Any]) -> dict[str, Any]:
    """The refusal, or nothing where it is taken."""
    answer = client.post(f"/v1/robots/{path}", json=call, headers=LATER)
    assert answer.status_code in {202, 422}, answer.text
    if answer.status_code == 202:
        client.delete(answer.headers["location"])
        return {}
    refusal: dict[str, Any] = answer.json()
    return refusal


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "kind"), list(product(("planar_2r", "panda", "scara"), ("cloud", "grid", "dexterity")))
)
def test_voxels(client: TestClient, robot: str, kind: str) -> None:
    refused = 0
    for samples, size in product((30_000, 2_500_000), (0.1, 0.02, 0.002)):
        call = {"kind": kind, "samples": samples, "voxel_size": size}
        refusal = asked(client, f"{robot}/workspace", call)
        if not refusal:
            continue
        refused += 1
        assert refusal["field"] == "voxel_size"
        [fewer] = re.findall(r"at most ([\d,]+) `samples`", refusal["detail"])
        assert asked(client, f"{robot}/workspace", call | {"samples": int(fewer.replace(",", ""))}) == {}
        for larger in re.findall(r"voxels of ([\d.e-]+) m or more", refusal["detail"]):
            assert asked(client, f"{robot}/workspace", call | {"voxel_size": float(larger)}) == {}
    assert refused or kind != "dexterity"


@pytest.mark.slow
def test_a_grid_of_a_millimetre_with_ten_million_samples(client: TestClient) -> None:
    call = {"kind": "grid", "samples": 10_000_000, "voxel_size": 0.001}
    refusal = asked(client, "panda/workspace", call)
    [voxels] = re.findall(r"some ([\d,]+) voxels; at most 2,000,000 are allowed", refusal["detail"])
    assert 5_000_000 < int(voxels.replace(",", "")) < 10_000_000


@pytest.mark.quick(1)
@pytest.mark.parametrize(("robot", "size"), [("planar_2r", 0.002), ("scara", 0.02), ("panda", 0.05)])
def test_voxels_of_many_samples_are_foreseen(robot: str, size: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """From the first part of eight."""
    loaded = Library(CATALOGUE, CATALOGUE / "none").get(robot).robot
    wish = Wish("grid", 8 * PART, voxel_size=size)
    work, _ = plan(loaded.chain(None, None), wish)
    monkeypatch.setattr(workspace_request, "_COUNTED_PARTS", 1)
    foreseen = workspace_request._voxels_met(work)
    counted = len(merged([sampled((work, k)).voxels for k in range(8)]))
    assert 0.95 * counted <= foreseen <= 1.6 * counted


@pytest.mark.quick(1)
@pytest.mark.parametrize(("robot", "size"), [("panda", 0.015), ("scara", 0.006)])
def test_a_fine_grid_for_which_there_is_room_is_taken(client: TestClient, robot: str, size: float) -> None:
    """Ten million samples fall into less than a million voxels each."""
    call = {"kind": "grid", "samples": 10_000_000, "voxel_size": size}
    assert asked(client, f"{robot}/workspace", call) == {}


@pytest.mark.slow
@pytest.mark.parametrize("law", ["quintic", "cubic", "jerk_limited", "trapezoidal", "time_optimal"])
@pytest.mark.parametrize("period", [3e-6, 1e-6, 1e-5])
def test_samples_of_a_motion(client: TestClient, law: str, period: float) -> None:
    move = {"start": [0.0, 0.0], "segments": [{"type": "joint", "target": [1.0, 0.5]}], "law": law}
    refusal = asked(client, "planar_2r/trajectory", move | {"sample_period": period})
    if refusal:
        assert refusal["field"] == "sample_period"
        [allowed] = re.findall(r"every ([\d.]+) s", refusal["detail"])
        assert asked(client, "planar_2r/trajectory", move | {"sample_period": float(allowed)}) == {}
    else:
        call = move | {"sample_period": period}
        location = client.post("/v1/robots/planar_2r/trajectory", json=call, headers=LATER).headers["location"]
        assert ended(lambda: client.get(location).json(), 120.0)["state"] != "failed"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "room"),
    [({}, 4_000_000), ({"solutions": "all"}, 20_000_000), ({"trace": True, "method": "newton"}, 20_000_000)],
)
def test_results_of_inverse_kinematics(tmp_path: Path, options: dict[str, Any], room: int) -> None:
    """One solution a target is stored as an array, which takes little room."""
    with served(tmp_path, room) as client:
        qs = np.random.default_rng(0).uniform(-2.0, 2.0, (100, 6)).tolist()
        told = client.post("/v1/robots/ur5/fk", json={"joint_positions": qs, "pose_format": "matrix"}).json()
        targets = [{"matrix": pose["matrix"]} for pose in told["poses"]]
        call = {"targets": targets * 600, **options}
        refusal = asked(client, "ur5/ik", call)
        assert refusal["field"] == "targets"
        [fewer] = re.findall(r"at most ([\d,]+) at a time", refusal["detail"])
        assert asked(client, "ur5/ik", call | {"targets": call["targets"][: int(fewer.replace(",", ""))]}) == {}
