"""The printed pages: a sheet for each participant, and the booklet with all solutions."""

from collections.abc import Callable
from html import escape
from typing import Any

from gelenk.exercises.exercise import Variant
from gelenk.language import translated as _
from gelenk.sheets.document import boxes, marked_up, page, paragraphs, picture, shown, worked
from gelenk.sheets.homework import Homework, Sheet


def sheets_page(homework: Homework) -> str:
    """Return all sheets as one document, each on pages of its own; it tells nothing of the solutions."""
    title = homework.title or _("Exercises")
    return page(title, (_section(title, sheet, _task) for sheet in homework.sheets))


def booklet_page(homework: Homework) -> str:
    """Return the tasks of all participants with answers and worked solutions."""
    title = _("Solutions: {title}").format(title=homework.title) if homework.title else _("Solutions")
    return page(title, (_section(title, sheet, _solution) for sheet in homework.sheets))


def _section(title: str, sheet: Sheet, part: Callable[[Variant[Any]], str]) -> str:
    who = f'<header><h1>{escape(title)}</h1><span class="who">{escape(sheet.participant)}</span></header>'
    start = '<article class="task">' if part is _task else "<article>"
    parts = (
        f"{start}{_heading(number, one)}{paragraphs(one.exercise.text(one.numbers))}{part(one)}</article>"
        for number, one in enumerate(sheet.variants, 1)
    )
    return f'<section class="sheet">\n{who}\n' + "\n".join(parts) + "\n</section>"


def _heading(number: int, variant: Variant[Any]) -> str:
    title = _("{number}. {title}").format(number=number, title=_(variant.exercise.title))
    points = _("Points: {points:g}").format(points=sum(one.points for one in variant.fields))
    return f'<h2><span>{escape(title)}</span><span class="points">{escape(points)}</span></h2>'


def _task(variant: Variant[Any]) -> str:
    rows = (
        f"<tr><th>{marked_up(one.label)}</th><td>{boxes(one)}</td><td>{_unit(one.unit)}</td></tr>"
        for one in variant.fields
    )
    return f'{picture(variant)}<table class="answers"><tbody>{"".join(rows)}</tbody></table>'


def _solution(variant: Variant[Any]) -> str:
    rows = (
        f'<tr><th>{marked_up(one.label)}</th><td class="right">{escape(shown(one, variant.answers[one.name]))}</td>'
        f"<td>{_unit(one.unit)}</td></tr>"
        for one in variant.fields
    )
    steps = worked(variant.steps)
    return f'<table class="answers"><tbody>{"".join(rows)}</tbody></table>{steps}'


def _unit(unit: str) -> str:
    return f'<span class="unit">{escape(unit)}</span>' if unit else ""
