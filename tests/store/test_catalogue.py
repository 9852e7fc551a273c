"""The catalogue is complete: each URDF of the package is in it or left out for a reason; images keep what they need."""

import json
import re
from pathlib import Path

import pytest

from gelenk.prune import catalogue_files, mapped_files, unneeded
from gelenk.store.records import package_data

ROBOTS = Path("robots")


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


@pytest.mark.slow
def test_an_image_keeps_every_robot_and_library_and_no_header() -> None:
    needed = {*catalogue_files(), *mapped_files()}
    removed = set(unneeded(needed))
    assert not removed & needed
    assert len([path for path in removed if path.suffix in {".hpp", ".h", ".hxx"}]) > 1000
    kept = {path.suffix for path in package_data().rglob("*") if path.is_file() and path not in removed}
    assert {".urdf", ".stl", ".dae", ".obj"} <= kept
