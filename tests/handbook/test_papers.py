"""A page that wants a PDF has a link to it where it could be printed, and no link where it could not."""

from pathlib import Path

import pytest

from docs.handbook import papers

PAGE = "<html><head></head><body><!-- pdf: As a PDF --></body></html>"


def test_a_printed_page_links_to_its_pdf(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pages: list[str] = []

    def printed(page: str) -> bytes:
        pages.append(page)
        return b"%PDF"

    monkeypatch.setattr(papers, "printed", printed)
    (tmp_path / "sheet.html").write_text(PAGE)
    (tmp_path / "other.html").write_text("<html><head></head></html>")
    assert list(papers.print_papers(tmp_path)) == []
    assert f'<base href="{(tmp_path / "sheet.html").as_uri()}">' in pages[0]
    assert '<a href="sheet.pdf">As a PDF</a>' in (tmp_path / "sheet.html").read_text()
    assert [path.read_bytes() for path in tmp_path.glob("*.pdf")] == [b"%PDF"]


def test_without_chromium_there_is_no_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    (tmp_path / "sheet.html").write_text(PAGE)
    reason = "there is no Chromium on the machine of the service"
    assert list(papers.print_papers(tmp_path)) == [f"sheet.pdf is left out: {reason}"]
    assert (tmp_path / "sheet.html").read_text() == PAGE
    assert not list(tmp_path.glob("*.pdf"))
