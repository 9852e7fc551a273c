"""The numeric workspace over HTTP: its summary, its array, its picture, and what is refused."""

import math
import re
import time
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.workspace import WorkspaceAnswer
from gelenk.http.workers.pool_client import PARSED_HERE_BYTES
from gelenk.jobs.workspace_picture import captions
from gelenk.main import create_app
from gelenk.robot.arrays import Array
from gelenk.settings import Settings
from tests.oracles import wrist_shell
from tests.test_faults import wait_for

NPY, SVG, PNG = "application/x-npy", "image/svg+xml", "image/png"


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    """An application whose jobs have one process."""
    settings = Settings(data_dir=tmp_path_factory.mktemp("alone"), job_processes=1, max_job_samples=300_000)
    with TestClient(create_app(settings), raise_server_exceptions=False) as client:
        yield client


def finished(client: TestClient, call: dict[str, Any], robot: str = "panda") -> str:
    """The address of a job's result."""
    answer = client.post(f"/v1/robots/{robot}/workspace", json=call)
    assert answer.status_code == 202, answer.text
    location = str(answer.headers["location"])
    deadline = time.monotonic() + 120.0
    while (job := client.get(location).json())["state"] in {"queued", "running"}:
        assert time.monotonic() < deadline
        time.sleep(0.02)
    assert job["state"] == "succeeded", job
    return f"{location}/result"


def array(client: TestClient, result: str) -> Array:
    answer = client.get(result, headers={"Accept": NPY})
    assert (answer.status_code, answer.headers["content-type"]) == (200, NPY)
    loaded: Array = np.load(BytesIO(answer.content))
    return loaded


def test_a_cloud(client: TestClient) -> None:
    result = finished(client, {"samples": 150_000, "random_seed": 3, "tip_frame": "panda_link8"})
    answer = client.get(result)
    assert answer.status_code == 200
    summary = answer.json()
    WorkspaceAnswer.model_validate(summary)
    points = array(client, result)
    assert list(points.shape) == summary["array"]["shape"] == [150_000, 4]
    assert summary["bounding_box"]["lower"] == points[:, :3].min(axis=0).tolist()
    assert summary["bounding_box"]["upper"] == points[:, :3].max(axis=0).tolist()
    radii = np.linalg.norm(points[:, :3], axis=1)
    assert summary["reach"]["max"] == pytest.approx(radii.max(), abs=1e-12)
    measure = summary["measure"]
    assert (measure["min"], measure["max"]) == (points[:, 3].min(), points[:, 3].max())
    assert points[np.argmax(points[:, 3]), :3].tolist() == measure["position"]
    assert summary["certificate"]["max_position_error"] < 1e-9
    call = {"joint_positions": [measure["joint_positions"]], "tip_frame": "panda_link8"}
    pose = client.post("/v1/robots/panda/fk", json=call).json()["poses"][0]
    assert pose["position"] == pytest.approx(measure["position"], abs=1e-12)
    J = np.array(client.post("/v1/robots/panda/jacobian", json=call).json()["jacobians"][0])[:3]
    assert measure["max"] == pytest.approx(math.sqrt(np.linalg.det(J @ J.T)), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    "call",
    [
        {"samples": 150_000, "kind": "cloud", "sequence": "low_discrepancy"},
        {"samples": 150_000, "kind": "grid"},
        {"samples": 5000, "kind": "dexterity", "voxel_size": 0.4, "orientations": 8},
    ],
    ids=lambda call: call["kind"],
)
def test_the_number_of_processes_makes_no_difference(
    client: TestClient, alone: TestClient, call: dict[str, Any]
) -> None:
    results = [(one, finished(one, call)) for one in (client, alone)]
    arrays = [array(*each) for each in results]
    assert np.array_equal(arrays[0], arrays[1])
    summaries = [one.get(result).json() for one, result in results]
    assert summaries[0] == summaries[1]


def test_a_grid_counts_its_samples(client: TestClient) -> None:
    call = {"kind": "grid", "samples": 100_000, "voxel_size": 0.1}
    result = finished(client, call)
    summary, voxels = client.get(result).json(), array(client, result)
    WorkspaceAnswer.model_validate(summary)
    points = array(client, finished(client, {**call, "kind": "cloud"}))
    assert voxels.shape == (summary["voxels"]["count"], 5)
    assert summary["voxels"]["volume"] == pytest.approx(len(voxels) * 1e-3)
    assert voxels[:, 3].sum() == summary["samples_counted"] == 100_000
    assert voxels[:, 4].max() == summary["measure"]["max"] == points[:, 3].max()
    cells = {tuple(cell) for cell in np.rint(points[:, :3] / 0.1).astype(int).tolist()}
    assert cells == {tuple(cell) for cell in np.rint(voxels[:, :3] / 0.1).astype(int).tolist()}


@pytest.mark.slow
def test_the_dexterity_of_three_planar_links(client: TestClient) -> None:
    """planar_3r has lengths 0.5, 0.4, 0.3: WS₂ is the disc to 0.2 and the ring from 0.4 to 0.6."""
    result = finished(client, {"kind": "dexterity", "samples": 5000, "orientations": 24}, "planar_3r")
    summary, voxels = client.get(result).json(), array(client, result)
    WorkspaceAnswer.model_validate(summary)
    dexterity = summary["dexterity"]
    assert (dexterity["spread"], dexterity["orientations"], voxels.shape[1]) == ("turns", 24, 6)
    inside = wrist_shell.secondary([0.5, 0.4, 0.3], np.hypot(voxels[:, 0], voxels[:, 1]))
    assert inside.any()
    assert (voxels[inside, 5] == 1.0).all()
    assert (voxels[~inside, 5] < 1.0).all()
    assert dexterity["full_count"] == inside.sum()
    assert dexterity["excluded"] is None
    lower, upper = dexterity["full_volume_bounds"]
    assert lower <= math.pi * (0.2**2 + 0.6**2 - 0.4**2) <= upper
    assert dexterity["mean_share"] == pytest.approx(voxels[:, 5].mean())


@pytest.mark.slow
def test_two_planar_links_cannot_be_dexterous(client: TestClient) -> None:
    """What a lattice and some angles have in common is no volume."""
    summary = client.get(
        finished(client, {"kind": "dexterity", "voxel_size": 0.1, "orientations": 4}, "planar_2r")
    ).json()
    WorkspaceAnswer.model_validate(summary)
    dexterity = summary["dexterity"]
    assert dexterity["reached_count"] > 0
    assert (dexterity["full_volume"], dexterity["full_volume_bounds"]) == (0.0, [0.0, 0.0])
    assert "2 to move it and 1 to turn it, and the chain has 2" in dexterity["excluded"]
    assert dexterity["excluded"] in summary["notes"]


@pytest.mark.slow
@pytest.mark.parametrize("voxel_size", [None, 0.05])
def test_the_dexterous_volume_of_a_scara_is_between_its_bounds(client: TestClient, voxel_size: float | None) -> None:
    """Its last joint turns all the way, so that it is all that its two links sweep, times the slide."""
    call = {"kind": "dexterity", "orientations": 8} | ({} if voxel_size is None else {"voxel_size": voxel_size})
    summary = client.get(finished(client, call, "scara")).json()
    first, second = (0.5 * (upper - lower) for lower, upper in summary["joint_ranges"][:2])
    elbows = np.linspace(0.0, second, 100_001)
    links = (0.325, 0.275)
    radii = np.sqrt(links[0] ** 2 + links[1] ** 2 + 2.0 * links[0] * links[1] * np.cos(elbows))
    leans = np.arctan2(links[1] * np.sin(elbows), links[0] + links[1] * np.cos(elbows))
    # Bent to either side the first link's fan is turned by the lean: two arcs, which overlap unless they lean far.
    arcs = np.minimum(2.0 * math.pi, 2.0 * np.minimum(first + leans, 2.0 * first))
    exact = float(-np.trapezoid(arcs * radii, radii)) * (summary["joint_ranges"][2][1] - summary["joint_ranges"][2][0])
    assert summary["dexterity"]["excluded"] is None
    lower, upper = summary["dexterity"]["full_volume_bounds"]
    assert lower <= exact <= upper
    assert lower <= summary["dexterity"]["full_volume"] <= upper
    lower, upper = summary["voxels"]["volume_bounds"]
    assert lower <= exact <= upper


def test_ranges_hold_joints_where_they_are_wanted(client: TestClient) -> None:
    ranges = {"joint_1": [0.0, 0.5], "joint_2": [0.0, 0.0]}
    result = finished(client, {"samples": 1000, "joint_ranges": ranges}, "planar_2r")
    points = array(client, result)
    angles = np.arctan2(points[:, 1], points[:, 0])
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(np.full(1000, 1.7))
    assert 0.0 <= angles.min() < angles.max() <= 0.5
    assert client.get(result).json()["joint_ranges"] == [[0.0, 0.5], [0.0, 0.0]]
    call = {"kind": "dexterity", "samples": 1000, "joint_ranges": ranges, "voxel_size": 0.1, "orientations": 16}
    voxels = array(client, finished(client, call, "planar_2r"))
    assert (voxels[:, 5] <= 1.0 / 16).all(), "stretched out, each point is reached in one direction at most"


@pytest.mark.slow
def test_pictures(client: TestClient) -> None:
    plane = {"origin": [0.0, 0.0, 0.5], "normal": [0.0, 0.0, 2.0], "thickness": 0.1}
    for call in ({"samples": 20_000}, {"kind": "grid", "samples": 20_000, "plane": plane}):
        result = finished(client, call)
        svg = client.get(result, headers={"Accept": SVG})
        assert (svg.status_code, svg.headers["content-type"]) == (200, SVG)
        assert svg.content.startswith(b"<?xml")
        assert len(svg.content) < 500_000
        assert not re.search(rb'(href|src)="(?!#|data:image/png)', svg.content)
        assert client.get(result, headers={"Accept": SVG}).content == svg.content
        png = client.get(result, headers={"Accept": PNG})
        assert png.content.startswith(b"\x89PNG")
        assert client.get(result, headers={"Accept": "application/pdf"}).content.startswith(b"%PDF")


def test_an_empty_slice_has_an_answer_and_a_picture(client: TestClient) -> None:
    plane = {"origin": [0.0, 0.0, 50.0], "normal": [1e-3, 0.0, 1.0], "thickness": 1e-3}
    result = finished(client, {"kind": "dexterity", "samples": 100, "plane": plane})
    summary = client.get(result).json()
    WorkspaceAnswer.model_validate(summary)
    assert (summary["samples_counted"], summary["bounding_box"], summary["reach"]) == (0, None, None)
    assert summary["measure"]["max"] is None
    assert array(client, result).shape == (0, 6)
    assert client.get(result, headers={"Accept": PNG}).content.startswith(b"\x89PNG")


@pytest.mark.parametrize("robot", ["spherical_wrist", "double_pendulum_continuous"])
def test_dexterity_beside_what_the_tip_keeps_to_says_so(client: TestClient, robot: str) -> None:
    summary = client.get(finished(client, {"kind": "dexterity", "samples": 100, "orientations": 2}, robot)).json()
    WorkspaceAnswer.model_validate(summary)
    assert summary["dexterity"]["reached_count"] == 0
    assert any("middles of the voxels" in note for note in summary["notes"])
    measure = summary["measure"]
    assert (measure["max"], measure["position"], measure["joint_positions"]) == (0.0, None, None)


def test_a_chain_without_joints_has_no_volume(client: TestClient) -> None:
    result = finished(client, {"samples": 10, "tip_frame": "panda_link0"})
    summary = client.get(result).json()
    WorkspaceAnswer.model_validate(summary)
    assert (summary["voxels"]["volume"], summary["voxels"]["inner_volume"], summary["voxels"]["count"]) == (0.0, 0.0, 1)
    assert client.get(result, headers={"Accept": PNG}).content.startswith(b"\x89PNG")


PLANE = {"origin": [0.0, 0.0, 0.5], "normal": [0.0, 0.0, 2.0], "thickness": 0.1}
SLICE = "Slice 0.1 m thick, normal (0, 0, 1), through (0, 0, 0.5) m"


@pytest.mark.parametrize(
    ("call", "lines"),
    [
        ({"samples": 1}, ["1 sample", "1 voxel of"]),
        ({"samples": 20_000}, ["20,000 samples", "voxels of"]),
        ({"samples": 20_000, "plane": PLANE}, [SLICE, " of 20,000 samples in the slice"]),
        ({"samples": 100, "plane": {**PLANE, "origin": [0, 0, 50]}}, ["The slice is empty: 0 of 100 samples"]),
        ({"samples": 1, "plane": {**PLANE, "origin": [0, 0, 50]}}, ["The slice is empty: 0 of 1 sample"]),
    ],
    ids=str,
)
def test_what_stands_beside_a_picture(client: TestClient, call: dict[str, Any], lines: list[str]) -> None:
    summary = client.get(finished(client, call)).json()
    assert summary["robot"] == "panda"
    assert (summary["plane"] is None) == ("plane" not in call)
    said = list(captions(summary))
    assert all(any(line in one for one in said) for line in lines), said
    assert ("voxel" in "".join(said)) == (summary["samples_counted"] > 0)


@pytest.mark.quick(8)
@pytest.mark.parametrize(
    ("call", "status", "pointer"),
    [
        ({"kind": "ball"}, 422, "#/kind"),
        ({"samples": 0}, 422, "#/samples"),
        ({"samples": 1.5}, 422, "#/samples"),
        ({"samples": 10**30}, 422, "#/samples"),
        ({"samples": 300_001}, 413, None),
        ({"random_seed": -1}, 422, "#/random_seed"),
        ({"voxel_size": 0.0}, 422, "#/voxel_size"),
        ({"voxel_size": -0.1}, 422, "#/voxel_size"),
        ({"voxel_size": 1e300}, 422, "#/voxel_size"),
        ({"voxel_size": 3.0}, 422, "#/voxel_size"),
        ({"voxel_size": 1e-300}, 422, "#/voxel_size"),
        ({"task": []}, 422, "#/task"),
        ({"task": ["w"]}, 422, "#/task/0"),
        ({"task": ["x", "x"]}, 422, "#/task"),
        ({"plane": {}}, 422, "#/plane/origin"),
        ({"plane": {"origin": [0, 0, 0], "normal": [0, 0, 0], "thickness": 1}}, 422, "#/plane/normal"),
        ({"plane": {"origin": [0, 0, 0], "normal": [0, 0, 1], "thickness": 0}}, 422, "#/plane/thickness"),
        ({"plane": {"origin": [0, 0, 1e300], "normal": [0, 0, 1], "thickness": 1}}, 422, "#/plane/origin/2"),
        ({"joint_ranges": {"nose": [0, 1]}}, 422, "#/joint_ranges"),
        ({"joint_ranges": {"panda_joint1": [1, 0]}}, 422, "#/joint_ranges"),
        ({"joint_ranges": {"panda_joint1": [-9, 0]}}, 422, "#/joint_ranges"),
        ({"joint_ranges": {"panda_joint1": [0]}}, 422, "#/joint_ranges/panda_joint1"),
        ({"joint_ranges": {"panda_joint1": [0, 1e300]}}, 422, "#/joint_ranges/panda_joint1/1"),
        ({"orientations": 0}, 422, "#/orientations"),
        ({"orientations": 1001}, 422, "#/orientations"),
        ({"orientations_over": "moods"}, 422, "#/orientations_over"),
        ({"orientations": 32}, 422, "#/orientations"),
        ({"kind": "grid", "orientations": 8}, 422, "#/orientations"),
        ({"orientations_over": "rotations"}, 422, "#/orientations_over"),
        ({"kind": "grid", "orientations_over": "approach_directions"}, 422, "#/orientations_over"),
        ({"kind": "dexterity", "samples": 200_000, "voxel_size": 0.02, "orientations": 1000}, 422, "#/voxel_size"),
        ({"kind": "dexterity", "samples": 5000, "voxel_size": 0.001, "orientations": 1000}, 422, "#/voxel_size"),
        ({"kind": "dexterity", "samples": 300_000, "voxel_size": 0.02, "orientations": 50}, 422, "#/voxel_size"),
        ({"job_id": "../x"}, 422, "#/job_id"),
        ({"job_id": ""}, 422, "#/job_id"),
        ({"grid": True}, 422, "#/grid"),
        ({"tip_frame": "nose"}, 404, None),
    ],
    ids=str,
)
def test_what_cannot_be_is_refused(alone: TestClient, call: dict[str, Any], status: int, pointer: str | None) -> None:
    answer = alone.post("/v1/robots/panda/workspace", json=call)
    assert answer.status_code == status, answer.text
    problem = answer.json()
    if pointer is not None:
        assert pointer in [problem.get("pointer"), *(error["pointer"] for error in problem.get("errors", []))]
    assert "Location" not in answer.headers


@pytest.mark.parametrize(
    ("content", "headers", "status"),
    [
        (b"{", {"Content-Type": "application/json"}, 400),
        (b'{"voxel_size": NaN}', {"Content-Type": "application/json"}, 422),
        (b'{"voxel_size": 1e400}', {"Content-Type": "application/json"}, 422),
        (b"{}", {"Content-Type": "text/plain"}, 415),
        (b"[]", {"Content-Type": "application/json"}, 422),
    ],
)
def test_bodies_that_are_none(client: TestClient, content: bytes, headers: dict[str, str], status: int) -> None:
    answer = client.post("/v1/robots/panda/workspace", content=content, headers=headers)
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == "application/problem+json"


def test_a_large_body_is_not_parsed_beside_the_event_loop(client: TestClient) -> None:
    body = b"{" + b" " * PARSED_HERE_BYTES + b"}"
    answer = client.post("/v1/robots/panda/workspace", content=body, headers={"content-type": "application/json"})
    assert (answer.status_code, answer.json()["allowed"]) == (413, PARSED_HERE_BYTES)


@pytest.mark.slow
def test_the_service_writes_where_it_is_told(tmp_path: Path) -> None:
    with TestClient(create_app(Settings(data_dir=tmp_path, job_processes=1))) as client:
        assert not (tmp_path / "jobs").exists()
        finished(client, {"samples": 10, "job_id": "mine"})
    # What it needed meanwhile goes after it has said that it has succeeded.
    wait_for(lambda: names_in(tmp_path / "jobs" / "mine") == ["result.json", "result.npy"], 60.0)


@pytest.mark.slow
def test_the_service_starts_with_a_damaged_table_of_jobs(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    folder = tmp_path / "jobs" / ".database"
    folder.mkdir(parents=True)
    (folder / "jobs.sqlite").write_bytes(b"SQLite format 3\0" + bytes(range(256)) * 100)
    with TestClient(create_app(Settings(data_dir=tmp_path, job_processes=1))) as client:
        assert client.get("/v1/jobs/mine").status_code == 404
        finished(client, {"samples": 10, "job_id": "mine"})
    assert f"the jobs in {folder}/jobs.sqlite are lost" in caplog.text
    assert (next(folder.glob("damaged-*")) / "jobs.sqlite").stat().st_size == 25616
    caplog.clear()


def names_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())
