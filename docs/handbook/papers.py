"""Pages that are also a PDF: printed by Chromium where it is there; elsewhere the page has no link to one."""

import re
from collections.abc import Iterator
from pathlib import Path

from gelenk.errors import NotPrinted
from gelenk.sheets.pdf import printed

_WANTED = re.compile(r"<!-- pdf: (.+?) -->")


def print_papers(site: Path) -> Iterator[str]:
    """Print each page that has a comment such as `<!-- pdf: as a PDF -->`, and let a link with these words replace it.

    Args:
        site: The folder of the built handbook.

    Yields:
        Why a page is not printed.
    """
    for path in sorted(site.rglob("*.html")):
        page = path.read_text(encoding="utf-8")
        if wanted := _WANTED.search(page):
            paper = path.with_suffix(".pdf")
            try:
                paper.write_bytes(printed(page.replace("<head>", f'<head><base href="{path.as_uri()}">', 1)))
            except NotPrinted as error:
                yield f"{paper.name} is left out: {error.reason}"
            else:
                link = f'<p class="paper"><a href="{paper.name}">{wanted[1]}</a></p>'
                path.write_text(page.replace(wanted[0], link), encoding="utf-8")
