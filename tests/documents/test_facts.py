"""Settings, limits and counts that a page tells are those of the code."""

import re
from dataclasses import fields
from pathlib import Path

import pytest

from app.kinematics.ik import branches, search
from app.model import urdf
from app.settings import Settings
from tests.documents.blocks import PAGES, README

OF_CLIENTS = {"GELENK_SERVER", "GELENK_KEY"}


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_setting_that_is_named_is_one(page: Path) -> None:
    known = {f"GELENK_{field.name.upper()}" for field in fields(Settings)} | OF_CLIENTS
    assert set(re.findall(r"GELENK_[A-Z_]+", page.read_text(encoding="utf-8"))) <= known


def test_the_search_is_told_as_it_is() -> None:
    text = Path("docs/explanation/inverse-kinematics.md").read_text(encoding="utf-8")
    assert f"the budget of {search.MAX_ITERATIONS:,} iterations" in text
    assert f"where {branches.STARTS:,} starts converge" in text


def test_the_readme_counts_right() -> None:
    text = README.read_text(encoding="utf-8")
    assert f"({len(list(Path('robots').glob('*/robot.json')))} robots come with the service" in text
    settings = Settings()
    most = f"{settings.max_body_bytes // 2**20} MiB and take {settings.request_seconds} s"
    assert f"{most}, an answer {settings.max_answer_numbers:,} numbers, a robot {urdf.MAX_LINKS} links" in text
