"""Robots over HTTP: the catalogue, uploads as URDF, DH table and zip, replacing, removing, meshes."""

import errno
import gzip
import json
import os
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from starlette.testclient import TestClient

from gelenk import prune
from gelenk.contract.robots import EXAMPLE_DH, RobotInfo, RobotList
from gelenk.pool.pool import WorkerPool
from tests.corpus.zips import URDF, zipped
from tests.http.conftest import ready_client

CATALOGUE = sorted(path.parent.name for path in Path("robots").glob("*/robot.json"))


@pytest.fixture
def own(tmp_path: Path) -> Any:
    """A client of an application with an empty data folder."""
    yield from ready_client(tmp_path)


def upload_zip(client: TestClient, content: bytes, name: str = "zipped") -> Any:
    return client.post("/v1/robots", data={"name": name}, files={"archive": ("robot.zip", content)})


def test_the_list_holds_the_catalogue(client: TestClient) -> None:
    answer = client.get("/v1/robots")
    RobotList.model_validate_json(answer.content)
    robots = {robot["name"]: robot for robot in answer.json()["robots"]}
    assert set(CATALOGUE) <= set(robots)
    assert len(CATALOGUE) >= 70
    assert robots["panda"]["source"] == "catalogue"
    assert robots["scara"]["format"] == "dh"
    about = {"maker": "Universal Robots", "kind": "collaborative arm", "closed_form": "three parallel axes"}
    assert about.items() <= robots["ur5"].items()
    assert about.items() <= client.get("/v1/robots/ur5").json().items()
    assert robots["panda"]["closed_form"] is None


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", CATALOGUE)
def test_every_robot_of_the_catalogue_is_described_and_moves(client: TestClient, name: str) -> None:
    answer = client.get(f"/v1/robots/{name}")
    assert answer.status_code == 200, answer.text
    info = RobotInfo.model_validate_json(answer.content)
    assert info.licence
    assert info.provenance
    assert info.description.endswith(".")
    assert set(info.leaf_tips) <= set(info.frames)
    for ends in [info.default_chain, *info.chains.values()]:
        call = {"base_frame": ends.base_frame, "tip_frame": ends.tip_frame}
        empty = client.post(f"/v1/robots/{name}/fk", json={**call, "joint_positions": []})
        joints = empty.json()["joint_names"]
        assert joints
        answer = client.post(f"/v1/robots/{name}/fk", json={**call, "joint_positions": [dict.fromkeys(joints, 0.1)]})
        assert answer.status_code == 200, answer.text
    assert client.get(f"/v1/robots/{name}/urdf").headers["content-type"] == "application/xml"


def test_what_the_panda_is(client: TestClient) -> None:
    info = client.get("/v1/robots/panda").json()
    joints = {joint["name"]: joint for joint in info["joints"]}
    assert joints["panda_joint1"]["limits"] == {"lower": -2.8973, "upper": 2.8973, "velocity": 2.175, "effort": 87}
    assert joints["panda_finger_joint2"]["mimic"] == {"joint": "panda_finger_joint1", "multiplier": 1, "offset": 0}
    assert joints["panda_joint8"]["axis"] is None
    assert info["degrees_of_freedom"] == 8
    assert info["licence"] == "Apache-2.0"


def test_a_mesh_of_the_catalogue(client: TestClient) -> None:
    mesh = client.get("/v1/robots/panda").json()["meshes"][0]
    answer = client.get(f"/v1/robots/panda/meshes/{mesh['path']}")
    assert answer.status_code == 200
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert b"COLLADA" in answer.content[:2000]


@pytest.mark.parametrize(
    ("accepted", "encoding"),
    [
        *[(accepted, "gzip") for accepted in ("gzip", "br, GZIP;q=0.5", "deflate,gzip ; q=1.0, *;q=0")],
        *[(accepted, None) for accepted in ("identity", "", "br", "gzip;q=0", "gzip; q=0.000, br", "x-gzip")],
    ],
)
def test_a_compressed_mesh_is_sent_so_where_the_client_takes_it(
    compressed: tuple[TestClient, bytes], accepted: str, encoding: str | None
) -> None:
    client, mesh = compressed
    path = client.get("/v1/robots/arm").json()["meshes"][0]["path"]
    with client.stream("GET", f"/v1/robots/arm/meshes/{path}", headers={"Accept-Encoding": accepted}) as answer:
        assert answer.status_code == 200
        assert answer.headers.get("content-encoding") == encoding
        assert answer.headers["content-type"] == "model/stl"
        assert answer.headers["vary"] == "Accept, Accept-Encoding"
        raw = b"".join(answer.iter_raw())
    assert (gzip.decompress(raw) if encoding else raw) == mesh
    assert len(raw) == int(answer.headers.get("content-length", len(mesh)))


@pytest.fixture(scope="module")
def compressed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[TestClient, bytes]]:
    """A client of an application whose robot has its mesh compressed as in an image, and the mesh itself."""
    data = tmp_path_factory.mktemp("compressed")
    file, mesh = data / "robots" / "arm" / "meshes" / "arm.stl", bytes(range(256)) * 4000
    file.parent.mkdir(parents=True)
    file.write_bytes(mesh)
    prune.compress(file)
    assert [path.name for path in file.parent.iterdir()] == ["arm.stl.gz"]
    (data / "robots" / "arm" / "arm.urdf").write_text(URDF)
    for client in ready_client(data):
        yield client, mesh


@pytest.mark.parametrize(
    "path", ["nothing.stl", "..%2f..%2frobot.json", "%2fetc%2fpasswd", "panda.urdf", "a%00.stl", "robot.json"]
)
def test_nothing_else_is_served_as_a_mesh(client: TestClient, path: str) -> None:
    answer = client.get(f"/v1/robots/panda/meshes/{path}")
    assert answer.status_code == 404
    assert answer.headers["content-type"] == "application/problem+json"


def test_a_urdf_is_added_used_replaced_and_removed(own: TestClient) -> None:
    created = own.post("/v1/robots", json={"name": "arm", "urdf": URDF, "description": "Mine"})
    assert created.status_code == 201, created.text
    assert created.headers["location"] == "/v1/robots/arm"
    assert "arm.stl" in " ".join(created.json()["warnings"])
    assert own.get("/v1/robots/arm/urdf").text == URDF
    assert own.get("/v1/robots").json()["robots"][-1]["name"] == "arm"
    tip = own.post("/v1/robots/arm/fk", json={"joint_positions": [[0.5]]}).json()["poses"][0]
    assert tip["position"] == [0, 0, 1]
    replaced = own.put("/v1/robots/arm", json={"urdf": URDF.replace("0 0 1", "0 0 2", 1)})
    assert replaced.status_code == 200, replaced.text
    tip = own.post("/v1/robots/arm/fk", json={"joint_positions": [[0.5]]}).json()["poses"][0]
    assert tip["position"] == [0, 0, 2]
    assert own.delete("/v1/robots/arm").status_code == 204
    for answer in (
        own.get("/v1/robots/arm"),
        own.delete("/v1/robots/arm"),
        own.put("/v1/robots/arm", json={"urdf": URDF}),
    ):
        assert answer.status_code == 404


def test_the_same_again_is_no_conflict_and_another_is(own: TestClient) -> None:
    new = {"name": "arm", "urdf": URDF}
    assert own.post("/v1/robots", json=new).status_code == 201
    assert own.post("/v1/robots", json=new).status_code == 200
    assert own.post("/v1/robots", json={**new, "description": "other"}).status_code == 409
    assert own.post("/v1/robots", json={**new, "urdf": URDF + "\n"}).status_code == 409
    assert own.post("/v1/robots", json={**new, "name": "panda"}).status_code == 409
    panda = own.get("/v1/robots/panda/urdf").text
    assert own.post("/v1/robots", json={"name": "panda", "urdf": panda}).status_code == 200


def test_the_catalogue_is_read_only(client: TestClient) -> None:
    for answer in (client.delete("/v1/robots/panda"), client.put("/v1/robots/panda", json={"urdf": URDF})):
        assert answer.status_code == 403
        assert answer.json()["robot"] == "panda"


def test_a_dh_table_becomes_a_robot(own: TestClient) -> None:
    created = own.post("/v1/robots", json=EXAMPLE_DH)
    assert created.status_code == 201, created.text
    assert created.json()["joint_names"] == ["shoulder", "elbow"]
    assert sum("±π" in warning for warning in created.json()["warnings"]) == 2
    assert own.post("/v1/robots", json=EXAMPLE_DH).status_code == 200
    answer = own.get(f"/v1/robots/{EXAMPLE_DH['name']}/urdf")
    urdf = answer.text
    remark = re.fullmatch(
        r"Of a DH table, against .* at 100 configurations: at most (\S+) m and (\S+) rad off",
        answer.headers["gelenk-certificate"],
    )
    assert remark is not None
    assert max(map(float, remark.groups())) < 1e-14
    copy = own.post("/v1/robots", json={"name": "copy", "urdf": urdf})
    assert copy.status_code == 201, copy.text
    call = {"joint_positions": [[0.4, -0.9]]}
    poses = [own.post(f"/v1/robots/{name}/fk", json=call).json()["poses"] for name in (EXAMPLE_DH["name"], "copy")]
    assert poses[0] == poses[1]


def test_a_prismatic_first_joint_zero_lengths_base_and_tool(own: TestClient) -> None:
    row = {"type": "prismatic", "a": 0, "alpha": 0, "d": 0.5, "theta": 0}
    tool = {"position": [0, 0, 0.1], "rotation_vector": [0, 0, 0]}
    base = {"position": [1, 0, 0], "zyz": [0, 0, 0]}
    for convention in ("standard", "modified"):
        dh = {"convention": convention, "joints": [row, {**row, "type": "revolute"}], "base": base, "tool": tool}
        created = own.post("/v1/robots", json={"name": convention, "dh": dh})
        assert created.status_code == 201, created.text
        answer = own.post(f"/v1/robots/{convention}/fk", json={"joint_positions": [[0.25, 1.0]]}).json()
        assert answer["poses"][0]["position"] == pytest.approx([1, 0, 1.35], abs=1e-15)


def test_a_default_chain_must_exist(own: TestClient) -> None:
    ends = {"base_frame": "base", "tip_frame": "nose"}
    answer = own.post("/v1/robots", json={"name": "arm", "urdf": URDF, "default_chain": ends})
    assert answer.status_code == 404
    assert answer.json()["known"] == ["base", "arm"]
    assert own.get("/v1/robots/arm").status_code == 404


@pytest.mark.quick(1)
@pytest.mark.parametrize("top", ["", "arm_description/"])
def test_a_zip_of_urdf_and_meshes(own: TestClient, top: str) -> None:
    mesh = b"solid arm\nendsolid arm\n"
    content = zipped({f"{top}urdf/arm.urdf": URDF, f"{top}meshes/arm.stl": mesh, f"{top}notes.txt": "left out"})
    created = upload_zip(own, content)
    assert created.status_code == 201, created.text
    assert not any("missing" in warning for warning in created.json()["warnings"])
    path = created.json()["meshes"][0]["path"]
    for name in (path, "arm_description/meshes/arm.stl"):
        assert own.get(f"/v1/robots/zipped/meshes/{name}").content == mesh
    assert upload_zip(own, content).status_code == 200
    replaced = own.put("/v1/robots/zipped", files={"archive": ("robot.zip", zipped({"arm.urdf": URDF}))})
    assert replaced.status_code == 200, replaced.text
    assert replaced.json()["meshes"][0]["path"] is None


def test_one_of_several_urdfs_of_a_zip(own: TestClient) -> None:
    """A workspace with two packages: none is chosen by itself, and the one that is meant finds its own meshes."""
    files: dict[str, str | bytes] = {
        f"ws/src/{one}/urdf/arm.urdf": URDF.replace("arm_description", one) for one in "lr"
    }
    files |= {f"ws/src/{one}/meshes/arm.stl": f"solid {one}" for one in "lr"}
    packed = {"archive": ("robot.zip", zipped(files))}
    urdfs = [path for path in files if path.endswith(".urdf")]
    for wanted in ({}, {"file": "arm.urdf"}, {"file": "ws/src/l/meshes/arm.stl"}):
        refused = own.post("/v1/robots", data={"name": "arm", **wanted}, files=packed)
        assert refused.status_code == 422
        assert refused.json()["files"] == urdfs
        assert all(path in refused.json()["detail"] for path in ("file", *urdfs))
    for one, path in zip("lr", urdfs, strict=True):
        added = own.post("/v1/robots", data={"name": one, "file": path}, files=packed)
        assert added.status_code == 201, added.text
        assert own.get(f"/v1/robots/{one}/urdf").text == files[path]
        [mesh] = added.json()["meshes"]
        assert own.get(f"/v1/robots/{one}/meshes/{mesh['path']}").text == f"solid {one}"
    replaced = own.put("/v1/robots/l", data={"file": urdfs[1]}, files=packed)
    assert replaced.status_code == 200
    assert own.get("/v1/robots/l/urdf").text == files[urdfs[1]]


def test_what_is_wrong_with_a_file_is_told_before_its_name_is_taken(own: TestClient) -> None:
    own.post("/v1/robots", json={"name": "arm", "urdf": URDF})
    for name in ("panda", "arm"):
        broken = own.post("/v1/robots", json={"name": name, "urdf": URDF.replace("revolute", "ball")})
        assert broken.json()["type"] == "urn:gelenk:invalid-urdf"
    other = URDF.replace("0 0 1", "0 0 2", 1)
    taken = own.post("/v1/robots", json={"name": "panda", "urdf": other}).json()
    assert (taken["is_ours"], taken["free"]) == (True, "panda_2")
    assert "panda_2" in taken["detail"]
    assert "replace" not in taken["detail"]
    own.post("/v1/robots", json={"name": "arm_2", "urdf": URDF})
    taken = own.post("/v1/robots", json={"name": "arm_2", "urdf": other}).json()
    assert (taken["is_ours"], taken["free"]) == (False, "arm_3")
    assert "replace" in taken["detail"]
    own.post("/v1/robots", json={"name": "a" * 64, "urdf": URDF})
    free = own.post("/v1/robots", json={"name": "a" * 64, "urdf": other}).json()["free"]
    assert own.post("/v1/robots", json={"name": free, "urdf": other}).status_code == 201


def test_the_path_says_which_robot_is_replaced(own: TestClient) -> None:
    for name in ("first", "second"):
        assert own.post("/v1/robots", json={"name": name, "urdf": URDF}).status_code == 201
    files = {"archive": ("robot.zip", zipped({"arm.urdf": URDF.replace("0 0 1", "0 0 5", 1)}))}
    assert own.put("/v1/robots/first", data={"name": "second"}, files=files).status_code == 422
    assert own.put("/v1/robots/panda", data={"description": "mine"}, files=files).status_code == 403
    assert own.get("/v1/robots/second/urdf").text == URDF


def test_both_ends_of_a_chain_or_none(own: TestClient) -> None:
    content = {"archive": ("robot.zip", zipped({"arm.urdf": URDF}))}
    half = own.post("/v1/robots", data={"name": "arm", "base_frame": "arm"}, files=content)
    assert half.status_code == 422
    whole = own.post("/v1/robots", data={"name": "arm", "base_frame": "arm", "tip_frame": "base"}, files=content)
    assert whole.json()["default_chain"] == {"base_frame": "arm", "tip_frame": "base"}


def test_mesh_names_that_no_disk_takes_are_missing_and_nothing_more(own: TestClient) -> None:
    urdf = URDF.replace("meshes/arm.stl", "m" * 300 + ".stl")
    created = upload_zip(own, zipped({"arm.urdf": urdf, "other.stl": "solid"}))
    assert created.status_code == 201, created.text
    assert own.get("/v1/robots/zipped").json()["meshes"][0]["path"] is None
    assert own.get(f"/v1/robots/zipped/meshes/{'a' * 5000}.stl").status_code == 404


@pytest.mark.slow
def test_broken_folders_harm_nobody_else_and_say_what_is_wrong(tmp_path: Path) -> None:
    def folder(name: str, robot_json: object = None) -> Path:
        path = tmp_path / "robots" / name
        path.mkdir(parents=True)
        if robot_json is not None:
            (path / "robot.json").write_text(json.dumps(robot_json))
        return path

    (folder("directory") / "x.urdf").mkdir()
    (folder("record_directory") / "robot.json").mkdir()
    for name, model in (("dot", "."), ("empty", ""), ("long", "m" * 300), ("nul", "a\0"), ("gone", "no.urdf")):
        folder(name, {"format": "urdf", "model": model})
    folder("text", "no robot")
    folder("package", {"format": "urdf", "model": {"package": "example-robot-data", "path": "x"}})
    os.mkfifo(folder("pipe") / "x.urdf")
    (folder("loop") / "robot.json").symlink_to("robot.json")
    (tmp_path / "robots" / "file").write_text("")
    for client in ready_client(tmp_path):
        listed = client.get("/v1/robots")
        assert listed.status_code == 200
        assert {robot["source"] for robot in listed.json()["robots"]} == {"catalogue"}
        for name in ("dot", "empty", "long", "nul", "gone", "text", "package", "loop"):
            answer = client.get(f"/v1/robots/{name}")
            assert answer.status_code == 422, (name, answer.text)
            assert answer.json()["type"] == "urn:gelenk:invalid-robot-folder"
        for name in ("directory", "record_directory", "pipe", "file", "nobody"):
            assert client.get(f"/v1/robots/{name}").status_code == 404
        for name in ("dot", "loop", "directory", "pipe"):
            assert client.delete(f"/v1/robots/{name}").status_code == 204
            assert not (tmp_path / "robots" / name).exists()


def test_an_edit_by_hand_is_seen(own: TestClient, tmp_path: Path) -> None:
    own.post("/v1/robots", json={"name": "arm", "urdf": URDF})
    (model,) = (tmp_path / "robots" / "arm").glob("*/robot.urdf")
    model.write_text(URDF.replace("0 0 1", "0 0 7", 1))
    answer = own.post("/v1/robots/arm/fk", json={"joint_positions": [[0.0]]})
    assert answer.json()["poses"][0]["position"] == [0, 0, 7]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("number", "status"), [(errno.ENOSPC, 507), (errno.EROFS, 503), (errno.EIO, 503)])
def test_a_disk_that_refuses_is_said_and_leaves_nothing(
    own: TestClient, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int, status: int
) -> None:
    """The pool's part is done in this process, where the disk can be made to refuse."""

    async def here(__: WorkerPool, function: Callable[[Any], Any], argument: Any, *_: Any) -> Any:
        return function(argument)

    monkeypatch.setattr(WorkerPool, "run", here)
    own.post("/v1/robots", json={"name": "arm", "urdf": URDF})
    before = sorted(tmp_path.rglob("*"))

    def refuse(_: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr("gelenk.store.folders.os.fsync", refuse)
    other = URDF.replace("0 0 1", "0 0 2", 1)
    new = own.post("/v1/robots", json={"name": "new", "urdf": other})
    replaced = own.put("/v1/robots/arm", json={"urdf": other})
    monkeypatch.undo()
    for answer in (new, replaced):
        assert answer.status_code == status, answer.text
        assert os.strerror(number) in answer.json()["detail"]
    assert sorted(tmp_path.rglob("*")) == before
    assert own.get("/v1/robots/arm/urdf").text == URDF


def test_a_form_must_be_one(client: TestClient) -> None:
    no_file = client.post("/v1/robots", data={"name": "x"}, files={"other": ("x.zip", b"")})
    assert no_file.status_code == 422
    no_name = client.post("/v1/robots", files={"archive": ("x.zip", b"")})
    assert no_name.status_code == 422
    assert "name" in no_name.json()["detail"]
    assert client.post("/v1/robots", content=b"x", headers={"content-type": "text/plain"}).status_code == 415


@pytest.mark.slow
def test_a_folder_dropped_in_by_hand_is_a_robot(tmp_path: Path) -> None:
    for client in ready_client(tmp_path):
        folder = tmp_path / "robots" / "by_hand"
        folder.mkdir(parents=True)
        (folder / "mine.urdf").write_text(URDF)
        assert client.get("/v1/robots/by_hand").json()["warnings"]
        (folder / "arm_description" / "meshes").mkdir(parents=True)
        (folder / "arm_description" / "meshes" / "arm.stl").write_text("solid")
        (folder / "robot.json").write_text(
            '{"format": "urdf", "model": "mine.urdf", "meshes": ".", "description": "By hand"}'
        )
        info = client.get("/v1/robots/by_hand").json()
        assert (info["description"], info["warnings"]) == (
            "By hand",
            ["no inertia for moving link 'arm': dynamics treats it as massless"],
        )
        assert [robot["name"] for robot in client.get("/v1/robots").json()["robots"]][-1] == "by_hand"
        (folder / "robot.json").write_text('{"format": "urdf", "model": "../../secret.urdf"}')
        broken = client.get("/v1/robots/by_hand")
        assert broken.status_code == 422
        assert "leads out" in broken.json()["detail"]
        assert client.get("/v1/robots").status_code == 200
        assert client.put("/v1/robots/by_hand", json={"urdf": URDF}).status_code == 200
        assert json.loads((folder / "robot.json").read_text())["digest"]
        assert not (folder / "mine.urdf").exists()
