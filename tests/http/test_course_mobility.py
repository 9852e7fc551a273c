"""The count of a mobility over HTTP: what it answers, and everything that it refuses."""

import json
from itertools import pairwise
from typing import Any, cast

import numpy as np
import pytest
from starlette.testclient import TestClient

from gelenk.contract.mobility import MobilityAnswer
from gelenk.kinematics.judge.judge import pinocchio_jacobian
from tests.course import linkages
from tests.robots import robot as machine, samples

PATH = "/v1/course/mobility"
RR: dict[str, Any] = {
    "space": "planar",
    "links": ["frame", "crank", "rod"],
    "pairs": linkages.pairs("frame R crank, crank R rod"),
}


def count(client: TestClient, **body: Any) -> dict[str, Any]:
    answer = client.post(PATH, json=body)
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    MobilityAnswer.model_validate_json(answer.content, strict=True)
    return content


def linkage(text: str) -> dict[str, Any]:
    return {"links": linkages.links(text), "pairs": linkages.pairs(text)}


@pytest.mark.parametrize("name", linkages.MECHANISMS)
def test_the_lectures_mechanisms(client: TestClient, name: str) -> None:
    space, text, n, j, constraints, mobility = linkages.MECHANISMS[name]
    found = count(client, space=space, **linkage(text))
    assert (found["link_count"], found["pair_count"], found["constraint_count"]) == (n, j, constraints)
    assert found["mobility"] == found["mobility_by_loops"] == mobility
    assert found["verdict"] in {"mechanism", "structure", "overconstrained"}


@pytest.mark.parametrize(
    ("space", "n", "pairs", "mobility"),
    [
        ("planar", 4, {"revolute": 3, "prismatic": 1}, 1),
        ("planar", 3, {"R": 2, "gear": 1}, 1),
        ("spatial", 14, {"U": 6, "P": 6, "S": 6}, 6),
        ("spatial", 1, {}, 0),
    ],
)
def test_counts_are_enough_for_the_formula(
    client: TestClient, space: str, n: int, pairs: dict[str, int], mobility: int
) -> None:
    found = count(client, space=space, links=n, pairs=pairs)
    assert found["mobility"] == mobility
    assert (found["chain"], found["loop_count"], found["idle"], found["mobility_without_idle"]) == (None,) * 4


def test_the_ground_is_the_link_that_says_so(client: TestClient) -> None:
    links = ["crank", {"name": "frame", "ground": True}, {"name": "rod"}]
    assert count(client, **{**RR, "links": links})["ground"] == "frame"
    assert count(client, **RR)["ground"] == "frame"


def test_a_forgotten_split_is_made_and_told(client: TestClient) -> None:
    text = linkages.SIX_BAR.replace("rocker R rod@B, ", "").replace("rocker@B", "rocker")
    wrong = count(client, space="planar", **linkage(text))
    assert wrong["mobility"] == 3
    assert any("rod" in sentence for sentence in wrong["warnings"])
    node = {"joint": "B", "links": ["plate", "rocker", "rod"]}
    right = count(client, space="planar", **linkage(text), coincident=[node])
    assert (right["mobility"], right["mobility_without_split"], right["pair_count"]) == (1, 3, 7)
    assert right["splits"] == [{"joint": "B", "links": 3, "pairs": 2, "added": 1, "constraints": 2}]
    counted = count(client, space="planar", links=6, pairs={"R": 6}, coincident=[{"links": 3}])
    assert (counted["mobility"], counted["mobility_without_split"]) == (1, 3)


def test_idle_freedoms_are_taken_off(client: TestClient) -> None:
    found = count(client, space="spatial", **linkage(linkages.MECHANISMS["Stewart 6-SPS"][1]))
    assert (found["mobility"], len(found["idle"]), found["mobility_without_idle"]) == (12, 6, 6)
    assert found["idle"][0]["links"] == ["lower1", "upper1"]


@pytest.mark.parametrize(("robot", "mobility"), [("panda", 8), ("ur5", 6), ("planar_2r", 2), ("scara", 4)])
def test_a_robot_of_the_service(client: TestClient, robot: str, mobility: int) -> None:
    """The Panda has two fingers, of which one follows the other."""
    found = count(client, robot=robot)
    assert (found["mobility"], found["chain"], found["loop_count"]) == (mobility, "open", 0)
    assert found["coupling_count"] == (1 if robot == "panda" else 0)


def test_a_robot_that_was_uploaded(client: TestClient) -> None:
    dh = {"convention": "standard", "joints": [{"type": "revolute", "a": 1, "alpha": 0, "d": 0, "theta": 0}]}
    assert client.post("/v1/robots", json={"name": "one_link", "dh": dh}).status_code == 201
    assert count(client, robot="one_link")["mobility"] == 1
    assert client.delete("/v1/robots/one_link").status_code == 204
    assert client.post(PATH, json={"robot": "one_link"}).status_code == 404


PARALLEL_BARS = [
    {"link_a": "frame", "link_b": "crank", "type": "R", "point": [0, 0, 0], "axis": [0, 0, 2]},
    {"link_a": "crank", "link_b": "coupler", "type": "R", "point": [0.3, 0.9, 0], "axis": [0, 0, 1]},
    {"link_a": "coupler", "link_b": "rocker", "type": "R", "point": [1.7, 1.4, 0], "axis": [0, 0, 1]},
    {"link_a": "rocker", "link_b": "frame", "type": "R", "point": [2, 0, 0], "axis": [0, 0, 1]},
]


def test_a_four_bar_counted_in_space_moves_by_where_its_axes_lie(client: TestClient) -> None:
    links = ["frame", "crank", "coupler", "rocker"]
    found = count(client, space="spatial", links=links, pairs=PARALLEL_BARS, output="coupler")
    assert (found["mobility"], found["verdict"], found["mobility_without_idle"]) == (-2, "mechanism", 1)
    posture = found["posture"]
    assert (posture["mobility"], posture["redundant"], posture["output"]) == (1, 3, 1)
    assert found["rank_tolerance"] == 1e-10
    assert posture["residual"] < 1e-14 < posture["smallest_counted"]
    assert "3 of its 20 constraints are redundant" in found["warnings"][0]
    without = [{key: pair[key] for key in ("link_a", "link_b", "type")} for pair in PARALLEL_BARS]
    bare = count(client, space="spatial", links=links, pairs=without)
    assert (bare["mobility"], bare["verdict"], bare["posture"]) == (-2, "overconstrained", None)
    assert bare["rank_tolerance"] is None
    assert "ignores geometry" in bare["warnings"][0]


@pytest.mark.parametrize(
    ("robot", "n", "solutions"),
    [
        ("planar_3r", 3, {"xy": "infinite", "xy_phi": "finite", "xyz": "none", "pose": "none"}),
        ("double_pendulum", 2, {"xy": "none", "xy_phi": "none", "xyz": "none", "pose": "none"}),
        ("anthropomorphic", 3, {"xy": "infinite", "xy_phi": "none", "xyz": "finite", "pose": "none"}),
        ("ur5", 6, {"xy": "infinite", "xy_phi": "infinite", "xyz": "infinite", "pose": "finite"}),
        ("panda", 7, {"xy": "infinite", "xy_phi": "infinite", "xyz": "infinite", "pose": "infinite"}),
        ("so101", 5, {"xy": "infinite", "xy_phi": "infinite", "xyz": "infinite", "pose": "none"}),
    ],
)
def test_joint_space_against_task_spaces(client: TestClient, robot: str, n: int, solutions: dict[str, str]) -> None:
    """Redundancy is n > m where the tip has m directions, as a planar arm in space has not; n = m gives branches."""
    content = count(client, robot=robot)
    spaces = content["spaces"]
    assert spaces["configuration_dimension"] == n
    assert {task["task"]: task["solutions"] for task in spaces["tasks"]} == solutions
    assert all(task["redundancy"] == n - task["dimension"] for task in spaces["tasks"])
    ranks = {task["task"]: task["rank"] for task in spaces["tasks"]}
    assert ranks == by_pinocchio(robot)
    assert spaces["workspace_dimension"] == ranks["xyz"]
    assert content["steps"][-1]["latex"][-1].startswith(rf"m = 6,\quad \mathrm{{rank}}\, J = {ranks['pose']},")


def by_pinocchio(name: str) -> dict[str, int]:
    """The largest ranks at some configurations of the rows x y, x y rz, x y z and all six."""
    found = machine(name)
    chain = found.chain(None, None)
    Js = [pinocchio_jacobian(found, chain, q, "local_world_aligned") for q in samples(chain, 3)]
    rows = {"xy": [0, 1], "xy_phi": [0, 1, 5], "xyz": [0, 1, 2], "pose": range(6)}
    return {task: max(int(np.linalg.matrix_rank(J[list(one)], 1e-9)) for J in Js) for task, one in rows.items()}


PAIR = {"link_a": "frame", "link_b": "crank", "type": "revolute"}
NODE = {"links": ["frame", "crank", "rod"]}
REFUSED: dict[str, tuple[dict[str, Any], str, str]] = {
    "nothing": ({}, "#/space", "`space` is missing"),
    "robot and mechanism": ({**RR, "robot": "panda"}, "#/space", "`robot` is given alone"),
    "no pairs": ({"space": "planar", "links": 4}, "#/pairs", "`pairs` is missing"),
    "no space": ({"links": 4, "pairs": {}}, "#/space", "`space` is missing"),
    "another space": ({**RR, "space": "flat"}, "#/space", "'planar' or 'spatial'"),
    "no links": ({**RR, "links": []}, "#/links", "at least 1"),
    "zero links": ({"space": "planar", "links": 0, "pairs": {}}, "#/links", "greater than or equal to 1"),
    "too many links": ({"space": "planar", "links": 501, "pairs": {}}, "#/links", "less than or equal to 500"),
    "half a link": ({"space": "planar", "links": 2.5, "pairs": {}}, "#/links", "integer"),
    "a number with named pairs": ({**RR, "links": 3}, "#/links", "`links` are named where `pairs` are"),
    "a nameless link": ({**RR, "links": ["frame", "", "rod"]}, "#/links/1", "at least 1 character"),
    "a control character": ({**RR, "links": ["frame", "a\nb"]}, "#/links/1", "match pattern"),
    "the same link twice": ({**RR, "links": ["frame", "crank", "rod", "rod"]}, "#/links", "'rod' is used for more"),
    "two grounds": (
        {**RR, "links": [{"name": name, "ground": True} for name in ("frame", "crank", "rod")]},
        "#/links",
        "3 links are marked as ground",
    ),
    "an unknown link": (
        {**RR, "pairs": [PAIR, {**PAIR, "link_b": "knob"}]},
        "#/pairs/1/link_b",
        "no link 'knob'; the links are 'frame', 'crank', 'rod'",
    ),
    "a link with itself": ({**RR, "pairs": [{**PAIR, "link_b": "frame"}]}, "#/pairs/0/link_b", "'frame' to itself"),
    "an unknown pair type": ({**RR, "pairs": [{**PAIR, "type": "glue"}]}, "#/pairs/0/type", "'point_contact'"),
    "a ball in the plane": (
        {**RR, "pairs": [{**PAIR, "type": "S"}]},
        "#/pairs/0/type",
        "no 'spherical' pair in the plane (λ = 3); allowed: revolute, prismatic, rolling, pin_in_slot, cam, gear",
    ),
    "gears in space": (
        {"space": "spatial", "links": 3, "pairs": {"gear": 1}},
        "#/pairs/gear",
        "no 'gear' pair in space (λ = 6); allowed: revolute, prismatic, screw",
    ),
    "a negative count": (
        {"space": "planar", "links": 3, "pairs": {"R": -1}},
        "#/pairs/R",
        "greater than or equal to 0",
    ),
    "a huge count": (
        {"space": "planar", "links": 3, "pairs": {"R": 10**30}},
        "#/pairs/R",
        "less than or equal to 1000",
    ),
    "a count of NaN": ({"space": "planar", "links": 3, "pairs": {"R": float("nan")}}, "#/pairs/R", "integer"),
    "a pair without links": ({**RR, "pairs": [{"type": "R"}]}, "#/pairs/0/link_a", "required"),
    "one more field": ({**RR, "pairs": [{**PAIR, "friction": 1}]}, "#/pairs/0/friction", "not permitted"),
    "the same pair twice": (
        {**RR, "pairs": [{**PAIR, "name": "a"}] * 2},
        "#/pairs",
        "'a' is used for more than one pair",
    ),
    "a node of two links": ({**RR, "coincident": [{"links": ["frame", "rod"]}]}, "#/coincident/0/links", "at least 3"),
    "a node of an unknown link": (
        {**RR, "coincident": [{"links": ["frame", "rod", "knob"]}]},
        "#/coincident/0/links",
        "no link 'knob'",
    ),
    "a node with a link twice": (
        {**RR, "coincident": [{"links": ["frame", "rod", "rod"]}]},
        "#/coincident/0/links",
        "'rod' is named twice",
    ),
    "a node twice": (
        {**RR, "coincident": [{**NODE, "joint": "B"}] * 2},
        "#/coincident",
        "'B' is used for more than one joint",
    ),
    "a node by number with named pairs": (
        {**RR, "coincident": [{"links": 3}]},
        "#/coincident/0/links",
        "list of names",
    ),
    "a node of balls in the plane": (
        {**RR, "coincident": [{**NODE, "type": "S"}]},
        "#/coincident/0/type",
        "no 'spherical'",
    ),
    "a pair that is not of its node": (
        {**RR, "links": ["frame", "crank", "rod", "d"], "coincident": [{"joint": "B", "links": ["rod", "d", "frame"]}]}
        | {"pairs": [{**PAIR, "joint": "B"}]},
        "#/pairs/0/joint",
        "does not name both links",
    ),
    "a pair too many at a node": (
        {**RR, "pairs": [*RR["pairs"], {**PAIR, "link_b": "rod"}], "coincident": [NODE]},
        "#/pairs/2",
        "3 links meet at joint 'node_1', which makes 2 pairs",
    ),
    "a node that no count has": (
        {"space": "planar", "links": 4, "pairs": {"P": 1}, "coincident": [{"links": 3, "type": "R"}]},
        "#/coincident/0",
        "counts 0 revolute joints",
    ),
    "a node of more links than there are": (
        {"space": "planar", "links": 4, "pairs": {"R": 4}, "coincident": [{"links": 5}]},
        "#/coincident/0/links",
        "5 links meet where there are 4",
    ),
    "an output without geometry": ({**RR, "output": "rod"}, "#/output", "`output` needs pairs that say where they are"),
    "an output that is no link": (
        {**RR, "pairs": [{**PAIR, "point": [0, 0, 0]}], "output": "knob"},
        "#/output",
        "no link 'knob'",
    ),
    "an output of a robot": (
        {"robot": "panda", "output": "panda_hand"},
        "#/output",
        "`robot` is given alone, without `output`",
    ),
    "a tolerance of a robot": (
        {"robot": "ur5", "rank_tolerance": 1e-6},
        "#/rank_tolerance",
        "`robot` is given alone, without `rank_tolerance`",
    ),
    "a tolerance without geometry": ({**RR, "rank_tolerance": 1e-6}, "#/rank_tolerance", "needs pairs that say where"),
    "a kind counted twice": (
        {"space": "spatial", "links": 7, "pairs": {"R": 3, "revolute": 3}},
        "#/pairs/revolute",
        "`R` and `revolute` are the same kind",
    ),
    "an axis out of the plane": (
        {"space": "planar", "links": ["a", "b"]}
        | {"pairs": [{"link_a": "a", "link_b": "b", "type": "R", "point": [0, 0, 5], "axis": [1, 0, 0]}]},
        "#/pairs/0/axis",
        "the axis to turn about is z",
    ),
    "a lone pair with a pitch": (
        {"space": "spatial", "links": ["a", "b"]}
        | {"pairs": [{"link_a": "a", "link_b": "b", "type": "R", "pitch": 0.1}]},
        "#/pairs/0/pitch",
        "only a screw has a pitch",
    ),
    "half of the geometry": (
        {**RR, "pairs": [{**PAIR, "point": [0, 0, 0]}, {**PAIR, "link_b": "rod"}]},
        "#/pairs/1/point",
        "'pair_2' needs point, because other pairs say where they are",
    ),
    "an axis without direction": (
        {**RR, "pairs": [{**PAIR, "point": [0, 0, 0], "axis": [0, 0, 0]}]},
        "#/pairs/0/axis",
        "an axis has a direction",
    ),
    "a slider that leaves the plane": (
        {**RR, "pairs": [{**PAIR, "type": "P", "axis": [0, 0, 1]}]},
        "#/pairs/0",
        "freedoms are not independent",
    ),
    "a flat point": ({**RR, "pairs": [{**PAIR, "point": [0, 0]}]}, "#/pairs/0/point", "at least 3"),
    "a huge point": ({**RR, "pairs": [{**PAIR, "point": [1e300, 0, 0]}]}, "#/pairs/0/point/0", "less than or equal"),
    "a huge pitch": ({**RR, "pairs": [{**PAIR, "pitch": 1e300}]}, "#/pairs/0/pitch", "less than or equal"),
    "a tolerance of zero": ({**RR, "rank_tolerance": 0}, "#/rank_tolerance", "greater than 0"),
    "a tolerance of one": ({**RR, "rank_tolerance": 1}, "#/rank_tolerance", "less than 1"),
    "a robot's name that is none": ({"robot": "../etc"}, "#/robot", "match pattern"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_a_bad_request_is_refused_at_its_place(client: TestClient, name: str) -> None:
    body, pointer, reason = REFUSED[name]
    sent = json.dumps(body)
    answer = client.post(PATH, content=sent, headers={"content-type": "application/json"})
    problem = answer.json()
    if "NaN" in sent:
        assert answer.status_code in {400, 422}
        return
    assert answer.status_code == 422, answer.text
    assert problem.get("pointer", problem.get("errors", [{}])[0].get("pointer")) == pointer
    assert reason in problem["detail"]


def test_an_unknown_robot(client: TestClient) -> None:
    answer = client.post(PATH, json={"robot": "pandda"})
    assert (answer.status_code, answer.json()["close"][0]) == (404, "panda")


def test_what_is_no_json_body(client: TestClient) -> None:
    assert client.post(PATH, content=b"x", headers={"content-type": "text/plain"}).status_code == 415
    assert client.post(PATH, content=b"{", headers={"content-type": "application/json"}).status_code == 400
    assert client.post(PATH + "?robot=panda", json={"robot": "panda"}).status_code == 422
    assert client.get(PATH).status_code == 405


def test_the_largest_mechanism_is_quick_and_bounded(client: TestClient) -> None:
    names = [f"link{i}" for i in range(500)]
    pairs = [{"link_a": names[i % 500], "link_b": names[(i * 7 + 1) % 500], "type": "S"} for i in range(1000)]
    pairs = [pair for pair in pairs if pair["link_a"] != pair["link_b"]]
    found = count(client, space="spatial", links=names, pairs=pairs)
    assert found["mobility"] == 6 * 499 - 3 * len(pairs)
    too_many = [PAIR] * 1001
    assert client.post(PATH, json={**RR, "pairs": too_many}).status_code == 422


def test_a_linkage_too_large_to_be_looked_at_as_it_stands(client: TestClient) -> None:
    names = [f"link{i}" for i in range(65)]
    pairs = [
        {"link_a": a, "link_b": b, "type": "R", "point": [0, 0, i], "axis": [1, 0, 0]}
        for i, (a, b) in enumerate(pairwise(names))
    ]
    answer = client.post(PATH, json={"space": "spatial", "links": names, "pairs": pairs})
    assert (answer.status_code, answer.json()["allowed"]) == (413, 64)
    count(client, space="spatial", links=names[:64], pairs=pairs[:63])


@pytest.mark.parametrize("tolerance", [1e-300, 1e-12, 1e-6, 1e-2, 0.999])
@pytest.mark.parametrize("size", [1e-300, 1e-9, 4e5])
def test_any_tolerance_and_size_give_an_answer(client: TestClient, tolerance: float, size: float) -> None:
    pairs = [{**pair, "point": [size * x for x in cast(list[float], pair["point"])]} for pair in PARALLEL_BARS]
    links = ["frame", "crank", "coupler", "rocker"]
    found = count(client, space="spatial", links=links, pairs=pairs, rank_tolerance=tolerance)
    assert found["mobility"] == -2
