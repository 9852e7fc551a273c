"""Settings, limits and counts that a page tells are those of the code."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from gelenk.ik.search import search
from gelenk.ik.verdict import branches
from gelenk.robot import urdf
from gelenk.settings import Settings
from tests.documents.blocks import PAGES, README
from tests.openapi import document

OF_CLIENTS = {"GELENK_SERVER", "GELENK_KEY"}


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_setting_that_is_named_is_one(page: Path) -> None:
    known = {f"GELENK_{field.name.upper()}" for field in fields(Settings)} | OF_CLIENTS
    assert set(re.findall(r"GELENK_[A-Z_]+", page.read_text(encoding="utf-8"))) <= known


def test_the_search_is_told_as_it_is() -> None:
    text = " ".join(Path("docs/explanation/inverse-kinematics.md").read_text(encoding="utf-8").split())
    assert f"until the target is reached within the limits or {search.MAX_ITERATIONS:,} iterations are used up" in text
    assert f"collects the results of {branches.STARTS:,} starts" in text


def test_the_readme_counts_right() -> None:
    text = README.read_text(encoding="utf-8")
    assert f"({len(list(Path('robots').glob('*/robot.json')))} robots come with the service" in text
    settings = Settings()
    most = f"{settings.max_body_bytes // 2**20} MiB and take {settings.request_seconds} s"
    assert f"{most}, an answer {settings.max_answer_numbers:,} numbers, a robot {urdf.MAX_LINKS} links" in text


def test_where_the_service_has_a_copy_of_the_keys_the_page_says_so() -> None:
    unit = Path("deploy/systemd/gelenk.service").read_text(encoding="utf-8")
    text = " ".join(Path("docs/how-to/run-it-for-a-lab.md").read_text(encoding="utf-8").split())
    assert "LoadCredential=keys" in unit
    assert "# After a change of the keys: `systemctl restart gelenk`" in unit
    reminder = "restart it after a change: with the [systemd](#with-the-machine-systemd) unit by `systemctl restart"
    assert reminder in text


def test_all_calculators_write_their_steps_down() -> None:
    """As the page on conventions has it; exercises and sheets are not calculators."""
    schemas = document()
    calculators = {
        path: item["post"]["responses"]["200"]["content"]["application/json"]["schema"]["$ref"].rpartition("/")[2]
        for path, item in schemas["paths"].items()
        if re.fullmatch(r"/v1/course/[a-z-]+", path) and "post" in item and not path.endswith("sheets")
    }
    assert len(calculators) > 10
    without = {
        path
        for path, name in calculators.items()
        if "steps" not in schemas["components"]["schemas"][name]["properties"]
    }
    text = " ".join(Path("docs/explanation/conventions.md").read_text(encoding="utf-8").split())
    assert not without
    assert "all of them write their steps down" in text
