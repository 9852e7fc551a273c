"""Robots whose links have nothing to show: shapes between their joints are offered, and nothing else changes."""

import re
from typing import Any

import numpy as np
import pytest
from starlette.testclient import TestClient

from tests.corpus.zips import URDF, zipped
from tests.http.conftest import ready_client
from tests.oracles import catalogue


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory) -> Any:
    yield from ready_client(tmp_path_factory.mktemp("data"))


def added(client: TestClient, urdf: str) -> Any:
    """What the service tells of a robot that it has for this moment only."""
    answer = client.post("/v1/robots", json={"name": "bare", "urdf": urdf})
    assert answer.status_code == 201, answer.text
    assert client.get("/v1/robots/bare/urdf").text == urdf
    assert client.delete("/v1/robots/bare").status_code == 204
    return answer.json()


def ends(shape: dict[str, Any]) -> np.ndarray:
    """Both ends of a cylinder in its link."""
    x, y, z, w = shape["pose"]["quaternion_xyzw"]
    axis = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
    half = 0.5 * shape["shape"]["length"] * axis
    return np.array([shape["pose"]["position"] - half, shape["pose"]["position"] + half])


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["panda", "ur5", "talos_left_arm", "xarm7", "so101", "icub"])
@pytest.mark.parametrize("left", ["no visuals", "meshes without files"])
def test_a_rod_leads_from_each_joint_to_the_next(own: TestClient, name: str, left: str) -> None:
    urdf = catalogue.urdf_text(name)
    if left == "no visuals":
        urdf = re.sub(r"<(visual|collision)\b.*?</\1>", "", urdf, flags=re.DOTALL)
    info = added(own, urdf)
    if left == "meshes without files" and re.search("<(box|cylinder|sphere) ", urdf):
        return
    skeleton = info["skeleton"]
    for joint in info["joints"]:
        mine = [one for one in skeleton if one["link"] == joint["parent"] and one["shape"]["type"] == "cylinder"]
        there = np.array(joint["origin"]["position"])
        if np.linalg.norm(there) > 1e-6:
            found = [ends(one) for one in mine]
            assert min(np.abs(rod - [np.zeros(3), there]).max() for rod in found) < 1e-9, joint["name"]
        if joint["type"] in {"revolute", "continuous", "prismatic"}:
            at_joint = [one for one in skeleton if one["link"] == joint["child"]]
            wanted = "box" if joint["type"] == "prismatic" else "cylinder"
            assert any(
                one["shape"]["type"] == wanted and np.abs(one["pose"]["position"]).max() == 0.0 for one in at_joint
            )
    assert {one["link"] for one in skeleton} <= set(info["links"])


def test_links_with_something_to_show_get_nothing(own: TestClient) -> None:
    box = '<visual><geometry><box size="1 1 1"/></geometry></visual>'
    info = added(own, URDF.replace('<link name="base"/>', f'<link name="base">{box}</link>'))
    assert {one["link"] for one in info["skeleton"]} == {"arm"}
    files: dict[str, str | bytes] = {"arm.urdf": URDF, "meshes/arm.stl": "solid arm\nendsolid arm\n"}
    packed = own.post("/v1/robots", data={"name": "packed"}, files={"archive": ("arm.zip", zipped(files))}).json()
    assert {one["link"] for one in packed["skeleton"]} == {"base"}
    for name in ("planar_2r", "panda"):
        assert own.get(f"/v1/robots/{name}").json()["skeleton"] == []


def test_a_sliding_joint_stays_on_its_rod(own: TestClient) -> None:
    slide = URDF.replace('type="revolute"', 'type="prismatic"').replace('lower="-1"', 'lower="0.2"')
    shapes = [one for one in added(own, slide)["skeleton"] if one["link"] == "arm"]
    (rod,) = [ends(one) for one in shapes if one["shape"]["type"] == "cylinder"]
    assert np.allclose(sorted(rod[:, 2]), [-1.0, 0.0])  # from where the way begins to the carriage at its upper end


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e5])
def test_it_is_of_the_arms_size(own: TestClient, length: float) -> None:
    for one in added(own, URDF.replace("0 0 1", f"0 0 {length}", 1))["skeleton"]:
        sizes = [one["shape"].get("radius", 0.0), one["shape"].get("length", 0.0)]
        assert 0 < max(sizes) <= max(1.2 * length, 1e-3)
        assert np.isfinite(sizes).all()


def test_nothing_weighs_more_for_it(own: TestClient) -> None:
    assert own.post("/v1/robots", json={"name": "light", "urdf": URDF}).status_code == 201
    answer = own.post("/v1/robots/light/dynamics", json={"joint_positions": [[0.3]]})
    assert answer.status_code == 200, answer.text
    assert any("weigh nothing" in note for note in answer.json()["notes"])
