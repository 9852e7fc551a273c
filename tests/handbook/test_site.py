"""What must hold of the built pages is found where it does not."""

from pathlib import Path

import pytest

from docs.handbook.site import faults, page_names

FIRST = '<nav><a class="reference internal" href="course/statics.html">Statics</a></nav>'
SECOND = '<h1 id="statics">Statics</h1><a href="../index.html">back</a><a href="https://example.org">elsewhere</a>'


@pytest.fixture
def site(tmp_path: Path) -> Path:
    (tmp_path / "course").mkdir()
    (tmp_path / "index.html").write_text(FIRST)
    (tmp_path / "course" / "statics.html").write_text(SECOND)
    return tmp_path


PAGES = ["course/statics", "index"]


def test_a_sound_handbook_has_no_faults(site: Path) -> None:
    assert faults(site, PAGES) == []


def test_a_link_to_the_studio_leaves_the_handbook(site: Path) -> None:
    page = site / "course" / "statics.html"
    page.write_text(page.read_text() + '<a href="../../#panel=course">')
    assert faults(site, PAGES) == []


@pytest.mark.parametrize(
    ("added", "fault"),
    [
        ('<a href="dynamics.html">', "dynamics.html leads nowhere"),
        ('<a href="#duality">', "#duality leads to a place that statics.html does not have"),
        ('<a href="../index.html#duality">', "leads to a place that index.html does not have"),
        ('<img src="picture.svg">', "picture.svg leads nowhere"),
        ('<img src="//example.org/a.png">', "//example.org/a.png would be loaded from another host"),
        ('<img src="a" srcset="https://example.org/a.png 2x">', "https://example.org/a.png would be loaded"),
        ('<script src="https://example.org/a.js"></script>', "https://example.org/a.js would be loaded"),
        ('<link rel="stylesheet" href="https://example.org/a.css">', "https://example.org/a.css would be loaded"),
        ('<link rel="preconnect" href="https://example.org">', "https://example.org would be loaded"),
        ('<svg><image xlink:href="https://example.org/a.svg"/></svg>', "https://example.org/a.svg would be loaded"),
        ('<p style="background: url(https://example.org/a.png)">', "https://example.org/a.png would be loaded"),
        ("<style>@import 'https://example.org/a.css';</style>", "https://example.org/a.css would be loaded"),
    ],
)
def test_a_fault_of_a_page_is_told(site: Path, added: str, fault: str) -> None:
    with (site / "course" / "statics.html").open("a") as page:
        page.write(added)
    assert any(fault in each for each in faults(site, PAGES))


def test_styles_and_scripts_are_looked_into(site: Path) -> None:
    (site / "a.css").write_text("@font-face { src: url('https://example.org/font.woff2'); }")
    (site / "a.js").write_text("fetch('https://example.org/a.json')")
    assert faults(site, PAGES) == [
        "a.css: https://example.org/font.woff2 would be loaded from another host",
        "a.js: the script loads from another host",
    ]


def test_every_page_is_built_and_in_the_navigation(site: Path) -> None:
    (site / "hidden.html").write_text("")
    assert faults(site, [*PAGES, "absent", "hidden"]) == [
        "absent: the page is not built",
        "hidden: the page is not in the navigation",
    ]


def test_pages_are_named_by_their_place(tmp_path: Path) -> None:
    (tmp_path / "course").mkdir()
    (tmp_path / "index.md").touch()
    (tmp_path / "course" / "statics.md").touch()
    assert page_names(tmp_path) == ["course/statics", "index"]
