"""The list of robots: its small pictures, its groups, and what cuts it down."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from gelenk.package_data import studio as bundle
from tests.oracles import catalogue
from tests.robots import robot
from tests.studio.browser import Studio
from tests.studio.pure import values

PICTURES = Path(__file__).parents[2] / "app" / "studio" / "thumbnails"
LARGEST = 4000


def summary(name: str, kind: str | None = None, maker: str | None = None, source: str = "catalogue") -> dict[str, Any]:
    described = {"name": name, "description": f"The {name}.", "format": "urdf", "closed_form": None}
    return {**described, "kind": kind, "maker": maker, "source": source}


ROBOTS = [
    summary("alpha", "quadruped", "Acme"),
    summary("beta", "textbook arm"),
    summary("gamma", "quadruped", "Other"),
    summary("delta", None, None, "uploaded"),
    summary("omega"),
]
JOINTS = {"alpha": 12, "beta": 2, "gamma": 3, "delta": 6, "constructor": 1}
ALL = {"words": "", "joints": "", "kind": "", "maker": ""}


def shown(**wanted: str) -> list[Any]:
    given = ", ".join(json.dumps(part) for part in (ROBOTS, JOINTS, {**ALL, **wanted}))
    found: list[Any] = values("panels/robot/groups.ts", [f"m.groups({given})"])[0]
    return [[group["title"], [entry["name"] for entry in group["robots"]]] for group in found]


def test_robots_stand_in_groups_by_kind_uploads_first() -> None:
    assert shown() == [
        ["Uploaded", ["delta"]],
        ["Textbook arm", ["beta"]],
        ["Other", ["omega"]],
        ["Quadruped", ["alpha", "gamma"]],
    ]


def test_each_choice_cuts_the_list_down() -> None:
    assert shown(words="QUAD acme") == [["Quadruped", ["alpha"]]]
    assert shown(kind="quadruped", maker="Other") == [["Quadruped", ["gamma"]]]
    assert shown(joints="8+") == [["Quadruped", ["alpha"]]]
    assert shown(joints="6") == [], "whose joints nobody has counted"
    assert shown(joints="2", kind="quadruped") == []


def test_small_pictures_are_small_and_served_under_names_of_their_content() -> None:
    pictures = {path.stem: path for path in PICTURES.glob("*.webp")}
    assert {"planar_2r", "scara", "anthropomorphic_wrist", "ur5", "panda"} <= set(pictures)
    assert set(pictures) <= set(catalogue.NAMES)
    assert max(path.stat().st_size for path in pictures.values()) <= LARGEST
    served = {path.name for path in (bundle() / "thumbnails").iterdir()}
    assert {re.sub(r"-[0-9A-F]{8}\.webp$", "", name) for name in served} == set(pictures)


def test_joints_are_counted_as_the_core_counts_them() -> None:
    counted = json.loads((PICTURES / "joints.json").read_text("utf-8"))
    assert len(counted) >= 73
    for name in ("planar_2r", "scara", "panda"):
        assert counted[name] == len(robot(name).chain(None, None).joint_names)


@pytest.mark.slow
def test_the_catalogue_is_cut_down_and_picked_from_by_its_pictures(studio: Studio) -> None:
    studio.open("robot", robot="planar_2r")
    studio.field("Joints").select_option("6")
    studio.field("Kind").select_option("collaborative arm")
    studio.field("Maker").select_option("Universal Robots")
    listed = studio.run("[...document.querySelectorAll('.robot')].map((made) => made.dataset.robot)")
    assert {"ur3", "ur5", "ur10"} <= set(listed)
    assert all(name.startswith("ur") for name in listed)
    assert studio.run("[...document.querySelectorAll('.robots h3')].map((e) => e.textContent)") == ["Collaborative arm"]
    source = studio.page.locator("[data-robot=ur5] img").get_attribute("src") or ""
    assert re.fullmatch(r"studio/thumbnails/ur5-[0-9A-F]{8}\.webp", source)
    studio.until("document.querySelector('[data-robot=ur5] img').naturalWidth === 256")
    header = f"fetch('{source}').then((answer) => answer.headers.get('cache-control'))"
    assert "immutable" in studio.run(header)
    studio.page.locator("[data-robot=ur5]").click()
    studio.wait_for_robot("ur5")
    studio.field("Maker").select_option("")
    studio.field("Kind").select_option("")
    studio.field("Joints").select_option("")
    assert studio.page.locator(".robot").count() >= 70
