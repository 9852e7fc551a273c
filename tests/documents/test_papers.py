"""What stands beside the code says the same as the code."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

from tests.documents.blocks import PAGES, README, blocks

PROJECT = tomllib.loads(Path("pyproject.toml").read_text(encoding="utf-8"))
LINK = re.compile(r"\]\(([^)\s]+)\)")


@pytest.mark.quick(11)
@pytest.mark.parametrize("page", PAGES, ids=str)
def test_every_link_leads_somewhere(page: Path) -> None:
    targets = [target for target in LINK.findall(page.read_text(encoding="utf-8")) if "://" not in target]
    for target in targets:
        name, _, heading = target.partition("#")
        file = page.parent / name if name else page
        assert file.exists(), target
        if heading and file.suffix == ".md":
            assert heading in anchors(file), target


def anchors(page: Path) -> set[str]:
    text = page.read_text(encoding="utf-8")
    headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return set(re.findall(r'<a id="([^"]+)">', text)) | {
        re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings
    }


def test_the_citation() -> None:
    cited = yaml.safe_load(Path("CITATION.cff").read_text(encoding="utf-8"))
    assert (cited["cff-version"], cited["type"]) == ("1.2.0", "software")
    assert cited["authors"] == [{"name": "The Gelenk authors"}]
    assert cited["title"].startswith("Gelenk")
    assert cited["message"]
    assert (cited["version"], cited["license"]) == (PROJECT["project"]["version"], PROJECT["project"]["license"])
    assert f"version {cited['version']}" in README.read_text(encoding="utf-8")


def test_the_changelog_begins_with_this_version() -> None:
    versions = re.findall(r"^## (\S+),", Path("CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert versions[0] == PROJECT["project"]["version"]
    assert len(set(versions)) == len(versions)


def test_the_layers_are_told_as_they_are() -> None:
    contract = PROJECT["tool"]["importlinter"]["contracts"][0]["layers"]
    layers = [re.findall(r"gelenk\.(\w+)", layer) for layer in contract]
    above_the_core = layers[: layers.index(["plots"]) + 1]
    (told,) = (block for block in blocks(Path("CONTRIBUTING.md"), "text") if "→" in block)
    assert [re.findall(r"\w+", layer) for layer in told.split("→")] == above_the_core


def test_every_folder_is_told() -> None:
    text = Path("CONTRIBUTING.md").read_text(encoding="utf-8")
    folders = {path.parent.name for path in Path().glob("[!.]*/__init__.py")} | {"docs", "deploy", "robots"}
    assert {folder for folder in folders if f"`{folder}/`" not in text} == set()


def test_the_readme_is_short_and_shows_a_call_in_the_first_screen() -> None:
    lines = README.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 120
    first = "\n".join(lines[:25])
    assert "./dev serve" in first
    assert "$ curl" in first
    assert '"certificate"' in first
    assert "not that the arm on your table does" in " ".join(lines[:35])


def test_figures_beside_other_tools_are_those_of_the_page_about_speed() -> None:
    """Each number of a row, with its unit, stands in a row of the page."""
    neighbours = Path("docs/explanation/neighbours.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\|(.*)\|(.*)\|(.*)\| `\./dev bench [\w-]+` \|$", neighbours, re.MULTILINE)
    assert len(rows) >= 8
    speed = Path("docs/explanation/speed.md").read_text(encoding="utf-8")
    tables = [line for line in speed.splitlines() if line.startswith("|")]
    for _, ours, others in rows:
        figures = re.findall(r"\d[\d,.]*(?: ?%| µs| ms)?", f"{ours} {others.replace('ik_LM', '')}")
        figures = [figure.rstrip(",") for figure in figures if len(figure) > 1]
        assert any(all(figure in row for figure in figures) for row in tables), figures
