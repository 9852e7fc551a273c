"""Endpoints of homework, answered by workers: its sheets in several forms, and the grades of a file of answers."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from starlette.responses import Response

from gelenk.contract.sheets import MAX_CSV, SheetsGradeRequest, SheetsRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.http.messages.openapi import documentation
from gelenk.http.messages.payloads import CSV, JSON, BoundedRequest, read_json
from gelenk.http.messages.problems import UnsupportedMediaType
from gelenk.http.messages.routes import DocumentedRoute
from gelenk.http.workers.pool_client import PoolClient
from gelenk.http.workers.task import Context, TaskRequest, buffers
from gelenk.language import language
from gelenk.sheets.bounds import Content
from gelenk.sheets.bundle import bundle
from gelenk.sheets.document import booklet_page, sheets_page
from gelenk.sheets.grades import grades_table
from gelenk.sheets.homework import Homework
from gelenk.sheets.key import key_table
from gelenk.sheets.moodle import moodle_xml
from gelenk.sheets.pdf import printed
from gelenk.store.course_secret import kept_secret

_PAGES: dict[Content, Callable[[Homework], str]] = {"sheets": sheets_page, "solutions": booklet_page}
_FORMS: dict[str, Callable[[Homework, Content], bytes]] = {
    "text/html": lambda homework, content: _PAGES[content](homework).encode(),
    "application/pdf": lambda homework, content: printed(_PAGES[content](homework)),
    "application/zip": lambda homework, _: bundle(homework),
    "application/xml": lambda homework, _: moodle_xml(homework),
    CSV: lambda homework, _: key_table(homework).encode(),
}
"""By media type; the first unless the caller prefers another one."""
_NEVER_KEPT = {"Cache-Control": "no-store"}


def sheet_routes(pool_client: PoolClient, max_body_bytes: int, secret: str, folder: Path) -> list[DocumentedRoute]:
    """Return the routes; without a secret, one is kept in the data folder."""

    def write(request: SheetsRequest) -> Any: ...

    def grade(request: SheetsGradeRequest) -> Any: ...

    async def written(request: BoundedRequest) -> Response:
        if request.media_type != JSON:
            raise UnsupportedMediaType(request.media_type, (JSON,))
        task_request = TaskRequest(buffers(await request.pieces()), wanted=request.preferred(tuple(_FORMS)))
        return await pool_client.answer(request, WriteSheets(secret, folder), task_request)

    async def graded(request: BoundedRequest) -> Response:
        if request.media_type not in (JSON, CSV):
            raise UnsupportedMediaType(request.media_type, (JSON, CSV))
        is_german = request.headers.get("accept-language", "").strip().lower().startswith("de")
        task = GradeSheets(secret, folder, request.media_type == CSV, is_german)
        return await pool_client.answer(request, task, TaskRequest(buffers(await request.pieces())))

    return [
        DocumentedRoute(write, written, max_body_bytes, **documentation("write_sheets")),
        DocumentedRoute(grade, graded, max_body_bytes, **documentation("grade_sheets")),
    ]


@dataclass(frozen=True, slots=True)
class _WithSecret:
    secret: str = field(repr=False)
    folder: Path

    def chosen(self, given: str | None) -> str:
        return given or self.secret or kept_secret(self.folder)


@dataclass(frozen=True, slots=True)
class WriteSheets(_WithSecret):
    """Writes the sheets in a worker."""

    def __call__(self, _: Context, task_request: TaskRequest) -> Response:
        """Answer in the form that is wanted."""
        call = read_json(SheetsRequest, task_request.body)
        homework = Homework(call.exercises, call.labels, call.title, self.chosen(call.secret))
        with language(call.language):
            content = _FORMS[task_request.wanted](homework, call.content)
        return Response(content, headers=_NEVER_KEPT, media_type=task_request.wanted)


@dataclass(frozen=True, slots=True)
class GradeSheets(_WithSecret):
    """Grades a table in a worker; as CSV its language is the one that the caller's program prefers."""

    is_csv: bool
    is_german: bool

    def __call__(self, _: Context, task_request: TaskRequest) -> Response:
        """Answer with a table."""
        call = self._of_csv(task_request.body) if self.is_csv else read_json(SheetsGradeRequest, task_request.body)
        with language(call.language):
            content = grades_table(call.csv, self.chosen(call.secret))
        return Response(content, headers=_NEVER_KEPT, media_type=f"{CSV}; header=present")

    def _of_csv(self, body: bytes) -> SheetsGradeRequest:
        if len(body) > MAX_CSV:
            raise TooLarge("bytes of the table", len(body), MAX_CSV)
        try:
            text = body.decode("utf-8-sig")
        except UnicodeDecodeError:
            raise InvalidField("body", "the table must be UTF-8") from None
        return SheetsGradeRequest(csv=text, language="de" if self.is_german else "en")
