"""Which pairs of links can touch, over HTTP: listed with reasons, chosen on one's own robots, found once."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.collision_bodies import CollisionBodies
from gelenk.contract.collision_pairs import CollisionPairs
from gelenk.contract.robots import EXAMPLE_DH
from gelenk.operations import robot_bodies
from gelenk.operations.robot_bodies import bodies_of
from gelenk.package_data import catalogue
from gelenk.store.library import Library, RobotUpload
from tests.corpus.zips import zipped
from tests.http.conftest import ready_client

NAME = EXAMPLE_DH["name"]
URL = f"/v1/robots/{NAME}/collision-pairs"
CHOICE = {"a": "link_2", "b": "link_1", "active": True}
BROKEN = (
    '<robot name="r"><link name="a"><collision><geometry><mesh filename="package://p/broken.stl"/></geometry></collision>'
    '</link><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint></robot>'
)


@pytest.fixture
def own(tmp_path: Path) -> Iterator[TestClient]:
    for client in ready_client(tmp_path):
        assert client.post("/v1/robots", json=EXAMPLE_DH).status_code == 201
        yield client


@pytest.mark.slow
def test_pairs_are_listed_with_their_reasons(client: TestClient) -> None:
    answer = client.get("/v1/robots/panda/collision-pairs")
    assert answer.status_code == 200, answer.text
    pairs = {(pair.a, pair.b): pair for pair in CollisionPairs.model_validate_json(answer.content).pairs}
    assert len(pairs) == 11 * 10 / 2
    assert pairs["panda_link0", "panda_link1"].reason == "neighbours"
    assert pairs["panda_link0", "panda_link3"].reason == "srdf"
    assert pairs["panda_link1", "panda_hand"].active
    assert all(pair.active == (pair.reason is None) for pair in pairs.values())


def test_a_person_chooses_and_takes_back(own: TestClient) -> None:
    found = own.get(URL).json()
    assert [(pair["a"], pair["b"], pair["reason"]) for pair in found["pairs"]] == [("link_1", "link_2", "neighbours")]
    chosen = own.put(URL, json={"pairs": [CHOICE]})
    assert chosen.json()["pairs"] == [{"a": "link_1", "b": "link_2", "active": True, "reason": "edited"}]
    assert own.get(URL).json() == chosen.json()
    assert own.post("/v1/robots", json=EXAMPLE_DH).status_code == 200  # the same robot, whatever was chosen
    assert own.put(URL, json={"pairs": [{**CHOICE, "active": False}]}).json() == found
    assert own.put(URL, json={"pairs": []}).json() == found


def test_a_choice_survives_a_restart_and_ends_with_the_robot(own: TestClient, tmp_path: Path) -> None:
    own.put(URL, json={"pairs": [CHOICE]})
    (again,) = bodies_of(Library(catalogue(), tmp_path / "robots").get(NAME)).pairs
    assert again.reason == "edited"
    replacement = {"dh": EXAMPLE_DH["dh"]}
    assert own.put(f"/v1/robots/{NAME}", json=replacement).status_code == 200
    assert own.get(URL).json()["pairs"][0]["reason"] == "neighbours"


@pytest.mark.parametrize(
    ("pairs", "field", "reason"),
    [
        ([{**CHOICE, "a": "elbow"}], "pairs[0]", "no link 'elbow' has a body"),
        ([{**CHOICE, "a": "link_1"}], "pairs[0]", "a link has no pair with itself"),
        ([CHOICE, {**CHOICE, "a": "link_1", "b": "link_2"}], "pairs[1]", "this pair has been given before"),
        ([{**CHOICE, "active": "perhaps"}], "active", "boolean"),
        ([{"a": "link_1", "b": "link_2"}], "active", "required"),
    ],
)
def test_what_is_no_pair_is_named(own: TestClient, pairs: list[Any], field: str, reason: str) -> None:
    answer = own.put(URL, json={"pairs": pairs})
    assert answer.status_code == 422
    assert field in answer.text
    assert reason in answer.json()["detail"] + str(answer.json().get("errors"))


def test_the_bodies_are_those_that_contacts_are_computed_of(client: TestClient) -> None:
    answer = client.get("/v1/robots/planar_2r/collision-bodies")
    assert answer.status_code == 200, answer.text
    bodies = CollisionBodies.model_validate_json(answer.content).bodies
    pairs = client.get("/v1/robots/planar_2r/collision-pairs").json()["pairs"]
    assert {body.link for body in bodies} == {link for pair in pairs for link in (pair["a"], pair["b"])}
    assert all(body.size and not body.points and body.excess == 0.0 for body in bodies)
    for body in bodies:
        spheres = np.array(body.cover.spheres)
        in_link = np.array(body.T_link_body) @ [0.0, 0.0, 0.0, 1.0]
        assert (np.linalg.norm(spheres[:, :3] - in_link[:3], axis=1) <= spheres[:, 3]).any()
        assert body.cover.excess is not None and body.cover.excess > 0.0  # none of these links is a ball
        assert 0.0 < body.cover.protrusion < spheres[:, 3].max()
    assert client.get("/v1/robots/nobody/collision-bodies").status_code == 404


def test_the_catalogue_is_read_only_and_others_are_unknown(client: TestClient) -> None:
    assert client.put("/v1/robots/panda/collision-pairs", json={"pairs": []}).status_code == 403
    assert client.get("/v1/robots/nobody/collision-pairs").status_code == 404
    assert client.put("/v1/robots/nobody/collision-pairs", json={"pairs": []}).status_code == 404


@pytest.mark.slow
def test_a_broken_mesh_is_refused_only_where_its_shape_is_needed(own: TestClient) -> None:
    archive = zipped({"p/r.urdf": BROKEN.encode(), "p/broken.stl": b"solid?"})
    added = own.post("/v1/robots", data={"name": "broken"}, files={"archive": ("r.zip", archive)})
    assert added.status_code == 201, added.text
    answer = own.get("/v1/robots/broken/collision-pairs")
    assert (answer.status_code, answer.json()["type"].rpartition(":")[2]) == (422, "invalid-mesh")
    assert answer.json()["detail"] == "mesh 'package://p/broken.stl': it has no triangle"


def test_bodies_are_found_once_and_then_read_from_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    uploads = tmp_path / "robots"
    first = bodies_of(Library(catalogue(), uploads).get("ur5_dh"))
    monkeypatch.setattr(robot_bodies, "find_bodies", None)
    again = bodies_of(Library(catalogue(), uploads).get("ur5_dh"))
    assert again.pairs == first.pairs
    for one, other in zip(first.bodies, again.bodies, strict=True):
        assert (one.name, one.kind, one.size, one.link) == (other.name, other.kind, other.size, other.link)
        assert one.T_link_body.tobytes() == other.T_link_body.tobytes()
        assert one.spheres.tobytes() == other.spheres.tobytes()
        assert (one.cover_excess, one.protrusion) == (other.cover_excess, other.protrusion)


def test_damaged_bodies_are_found_again_and_old_ones_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    library = Library(catalogue(), tmp_path)
    pairs = bodies_of(library.get("scara")).pairs
    (file,) = (tmp_path / ".derived").glob("*.json")
    file.write_bytes(file.read_bytes()[:1000])
    assert bodies_of(Library(catalogue(), tmp_path).get("scara")).pairs == pairs
    monkeypatch.setattr(robot_bodies, "_KEPT", 1)
    bodies_of(library.get("stanford"))
    (left,) = (tmp_path / ".derived").iterdir()
    assert left != file


def test_another_mesh_makes_other_bodies(tmp_path: Path) -> None:
    library = Library(catalogue(), tmp_path)
    box = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 %d\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    urdf = BROKEN.replace("broken.stl", "m.obj").encode()
    heights: list[float] = []
    for height in (1, 2):
        upload = RobotUpload("own", "urdf", urdf, meshes={"p/m.obj": box % height}, urdf_folder="p")
        library.replace(upload) if heights else library.add(upload)
        (body,) = bodies_of(library.get("own")).bodies
        heights.append(round(body.points[:, 2].max(), 9))
    assert heights == [1.0, 2.0]
