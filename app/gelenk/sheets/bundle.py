"""All files of a homework in one."""

import io
import zipfile
from collections.abc import Iterator

from gelenk.sheets.document import booklet_page, sheets_page
from gelenk.sheets.homework import Homework
from gelenk.sheets.key import key_table
from gelenk.sheets.moodle import moodle_xml
from gelenk.sheets.prairielearn import prairielearn_files

_DATE = (1980, 1, 1, 0, 0, 0)
"""Of every file, so that the same homework is the same bundle."""


def bundle(homework: Homework) -> bytes:
    """Return a zip of the sheets, the solutions, the key, and the questions for Moodle and PrairieLearn."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in _files(homework):
            archive.writestr(zipfile.ZipInfo(name, _DATE), content, zipfile.ZIP_DEFLATED)
    return file.getvalue()


def _files(homework: Homework) -> Iterator[tuple[str, str | bytes]]:
    yield "sheets.html", sheets_page(homework)
    yield "booklet.html", booklet_page(homework)
    yield "key.csv", key_table(homework)
    yield "moodle.xml", moodle_xml(homework, is_partial=True)
    yield from prairielearn_files(homework)
