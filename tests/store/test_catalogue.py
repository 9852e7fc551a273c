"""The catalogue is complete: each URDF of the package is in it or left out for a reason; images keep what they need."""

import json
import re
from pathlib import Path

import pytest

from gelenk.ik.closed.closed_form import closed_form
from gelenk.prune import catalogue_files, mapped_files, unneeded
from gelenk.store.records import package_data
from tests.oracles import catalogue
from tests.robots import robot, swept

ROBOTS = Path("robots")
KINDS = {
    "biped", "collaborative arm", "finger", "flying robot", "hand", "hobby arm", "humanoid", "industrial arm",
    "mobile manipulator", "quadruped", "SCARA", "textbook arm", "two-armed robot",
}  # fmt: skip


def test_every_urdf_of_the_package_is_used_or_left_out_for_a_reason() -> None:
    root = package_data() / "robots"
    there = {str(path.relative_to(root)) for path in root.rglob("*.urdf")}
    records = [json.loads(path.read_text()) for path in ROBOTS.glob("*/robot.json")]
    used = {record["model"]["path"].removeprefix("robots/") for record in records if record["format"] == "urdf"}
    left_out = set(re.findall(r"^\| `([^`]+\.urdf)` \| \S", (ROBOTS / "README.md").read_text(), re.MULTILINE))
    assert not used & left_out
    assert used | left_out == there


def test_every_robot_says_its_licence_and_source() -> None:
    for path in ROBOTS.glob("*/robot.json"):
        record = json.loads(path.read_text())
        assert re.fullmatch(r"[A-Za-z0-9.-]+", record["licence"]), path
        assert record["source"], path


def test_every_robot_says_its_kind_and_a_maker_where_it_has_one() -> None:
    files = {name: catalogue.entry(name) for name in catalogue.NAMES}
    assert {file["kind"] for file in files.values()} == KINDS
    nobodys = {name for name, file in files.items() if "maker" not in file}
    assert {files[name]["kind"] for name in nobodys} <= {"textbook arm", "quadruped", "flying robot"}


@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_the_closed_form_is_that_which_the_service_finds(name: str) -> None:
    found = closed_form(robot(name).chain(None, None))
    assert catalogue.entry(name).get("closed_form") == (found and found.name)


@pytest.mark.slow
def test_an_image_keeps_every_robot_and_library_and_no_header() -> None:
    needed = {*catalogue_files(), *mapped_files()}
    removed = set(unneeded(needed))
    assert not removed & needed
    assert len([path for path in removed if path.suffix in {".hpp", ".h", ".hxx"}]) > 1000
    kept = {path.suffix for path in package_data().rglob("*") if path.is_file() and path not in removed}
    assert {".urdf", ".stl", ".dae", ".obj"} <= kept
