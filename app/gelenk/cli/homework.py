"""Commands about exercises: what there is, sheets for a class, and the grades of its answers."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gelenk.cli.files.outputs import AnswerRows
from gelenk.cli.session import session
from gelenk.errors import InvalidField
from gelenk.language import Language
from gelenk.sheets.bounds import Content

if TYPE_CHECKING:
    from gelenk.cli.session import Session

_FORMS = ("html", "pdf", "zip", "xml", "csv")
LanguageOption = Annotated[Language, typer.Option("--lang", help="English or German.")]
SecretOption = Annotated[
    str | None,
    typer.Option(
        envvar="GELENK_COURSE_SECRET",
        help="Decides everybody's numbers, 16 characters or more; with --server the service has one of its own.",
    ),
]


def exercises(
    context: typer.Context,
    exercise: Annotated[str | None, typer.Argument(help="An id: shows a variant of it.")] = None,
    seed: Annotated[int, typer.Option(min=0, help="Number of the variant.")] = 1,
    lang: LanguageOption = "en",
) -> None:
    """List the exercises, or show one."""
    shared = session(context)
    with shared.client() as client:
        if exercise is not None:
            drawn = client.draw_exercise(exercise, seed=seed, language=lang)
            fields = [(one.name, one.kind, one.unit or "", one.label) for one in drawn.fields]
            shared.write(drawn, AnswerRows(("field", "kind", "unit", "label"), fields, (drawn.text,)))
            return
        answer = client.exercises(lang)
    rows = [(one.id, one.difficulty, one.title) for one in answer.exercises]
    shared.write(answer, AnswerRows(("id", "difficulty", "title"), rows))


def sheet(
    context: typer.Context,
    exercises: Annotated[list[str], typer.Argument(help="Ids, in the order of the sheet.")],
    participants: Annotated[
        str, typer.Option("--class", help="How many participants, or a file with a name in each line.")
    ] = "1",
    title: Annotated[str, typer.Option(help="Printed on every sheet.")] = "",
    content: Annotated[
        Content, typer.Option(help="What a page has: the tasks, or answers and solutions too.")
    ] = "sheets",
    secret: SecretOption = None,
    lang: LanguageOption = "en",
) -> None:
    """Write sheets for a class: HTML, or as --output ends: .html, .pdf, .csv (key), .xml (Moodle), .zip (all)."""
    shared = session(context)
    file = shared.output.file
    kind: Any = "html" if file is None else file.suffix.removeprefix(".").lower()
    if kind not in _FORMS:
        raise InvalidField("output", f"must end in one of {', '.join(f'.{form}' for form in _FORMS)}")
    fields = {"exercises": exercises, "participants": _participants(participants), "title": title, "content": content}
    with shared.client() as client:
        file_content = client.picture("v1/course/sheets", kind, {**fields, "language": lang, **_secret(shared, secret)})
    shared.output.put(file_content)


def grade(
    context: typer.Context,
    answers: Annotated[str, typer.Argument(help="CSV: participant, exercise, field, answer; - is standard input.")],
    secret: SecretOption = None,
    lang: LanguageOption = "en",
) -> None:
    """Grade the answers of a class: points and mistakes as CSV. The secret must be that of the sheets."""
    shared = session(context)
    content = sys.stdin.buffer.read() if answers == "-" else Path(answers).read_bytes()
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InvalidField("answers", "must be UTF-8") from None
    with shared.client() as client:
        graded = client.grade_sheets(csv=text, language=lang, **_secret(shared, secret))
    shared.output.put(graded)


def _participants(text: str) -> int | list[str]:
    if text.isdecimal():
        return int(text)
    return [line.strip() for line in Path(text).read_text(encoding="utf-8-sig").splitlines() if line.strip()]


def _secret(shared: "Session", secret: str | None) -> dict[str, Any]:
    """Return the field of the secret; without a server there must be one, else nobody could grade the sheets."""
    if secret is None and not shared.server:
        raise InvalidField("secret", "is needed without --server: set GELENK_COURSE_SECRET, also for grading")
    return {} if secret is None else {"secret": secret}
