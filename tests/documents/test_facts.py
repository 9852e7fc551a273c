"""Settings, limits and counts that a page tells are those of the code."""

from dataclasses import fields
from pathlib import Path

from app.kinematics.ik import branches, search
from app.model import dh, tree, urdf, xml
from app.schemas import ik
from app.settings import Settings
from app.store import archive
from tests.documents.blocks import README

LAB, LIMITS = Path("docs/how-to/run-it-for-a-lab.md"), Path("docs/explanation/limits.md")


def test_every_setting_is_told() -> None:
    told = "".join(page.read_text(encoding="utf-8") for page in (LAB, LIMITS))
    assert [field.name for field in fields(Settings) if f"`GELENK_{field.name.upper()}`" not in told] == []


def test_the_limits_are_those_of_the_code() -> None:
    text = LIMITS.read_text(encoding="utf-8")
    assert f"| {Settings().max_body_bytes // 2**20} MiB (`GELENK_MAX_BODY_BYTES`)" in text
    assert f"| {Settings().max_answer_numbers:,} (`GELENK_MAX_ANSWER_NUMBERS`)" in text
    limits = (
        f"{xml.MAX_BYTES // 2**20} MiB, {urdf.MAX_LINKS} links, {tree.MAX_DEPTH} joints deep, "
        f"{tree.MAX_MOVABLE} movable joints, {urdf.MAX_SHAPES} geometries"
    )
    assert limits in text
    assert f"| {dh.MAX_JOINTS} joints" in text
    assert f"{archive.MAX_ENTRIES:,} entries, {archive.MAX_UNPACKED // 2**20} MiB unpacked" in text
    assert f"targets in one call | {ik.MAX_TARGETS:,} |" in text
    assert f"with `trace` | {ik.MAX_STEPWISE:,} |" in text


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
