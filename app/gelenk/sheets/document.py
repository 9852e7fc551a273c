"""The printed pages: a sheet for each participant, and the booklet with all solutions.

Their parts: escaped texts, formulas as MathML, pictures, boxes for answers.
"""

import base64
import re
from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from html import escape
from typing import Any

import numpy as np
from latex2mathml.converter import convert

from gelenk.course.steps import Step
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Variant
from gelenk.language import current_language, translated as _
from gelenk.sheets.homework import Homework, Sheet

_POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
_MOST_ROWS = 8
_SIGN = re.compile(r"\\[A-Za-z]+|\\.|.", re.DOTALL)
_OPENING, _CLOSING = {"{", r"\begin", r"\left"}, {"}", r"\end", r"\right"}
_INDEXED = re.compile(r"(?<![\w&#])([^\W\d_])(?=[\^_])(?:\^([^\W_]+))?(?:_([^\W_]+|\([^)]+\)))?(?!\w)")
_STYLE = """
@page { size: A4; margin: 18mm 18mm 20mm; }
* { box-sizing: border-box; }
body { font: 10.5pt/1.45 "DejaVu Serif", Georgia, serif; color: #1f2933; margin: 0 auto; max-width: 174mm; }
.sheet { break-after: page; }
.sheet:last-of-type { break-after: auto; }
header { display: flex; justify-content: space-between; align-items: baseline; gap: 8mm;
  border-bottom: 1.5pt solid #1f2933; padding-bottom: 2mm; margin-bottom: 6mm; }
h1 { font-size: 15pt; margin: 0; }
.who { font-size: 11pt; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; max-width: 80mm; }
h2 { font-size: 12pt; margin: 7mm 0 2mm; break-after: avoid; display: flex; justify-content: space-between; gap: 6mm; }
h2 .points { font-weight: normal; font-size: 10pt; color: #6b7580; white-space: nowrap; }
h3 { font-size: 10.5pt; margin: 4mm 0 1mm; break-after: avoid; }
p { margin: 0 0 2.5mm; white-space: pre-line; overflow-wrap: anywhere; }
sub, sup { font-size: 75%; line-height: 0; }
img { display: block; max-width: 110mm; max-height: 75mm; margin: 3mm auto; break-inside: avoid; }
table.answers { border-collapse: collapse; margin: 2mm 0 0; break-inside: avoid; }
table.answers > tbody > tr { break-inside: avoid; }
table.answers th { text-align: left; font-weight: normal; vertical-align: middle; padding: 1.2mm 5mm 1.2mm 0;
  max-width: 80mm; }
table.answers td { vertical-align: middle; padding: 1.2mm 0; }
.box { display: inline-block; border: 0.8pt solid #6b7580; border-radius: 0.8mm; width: 34mm; height: 8mm; }
.row { display: flex; gap: 1.5mm; margin: 0.8mm 0; }
.row .box { width: 19mm; }
.unit { padding-left: 2.5mm; }
.choice { display: block; padding-left: 5.8mm; text-indent: -5.8mm; margin: 0.8mm 0; }
.choice::before { content: ""; display: inline-block; width: 3.4mm; height: 3.4mm; border: 0.8pt solid #6b7580;
  margin-right: 2.2mm; vertical-align: -0.4mm; }
.task { break-inside: avoid; }
.right { font-weight: bold; white-space: pre-line; }
.formula { margin: 1.2mm 0 1.2mm 6mm; text-align: left; break-inside: avoid; max-width: 100%; }
math { font-family: "STIX Two Math", "Latin Modern Math", "DejaVu Math TeX Gyre", math, "DejaVu Serif", serif;
  font-size: 10.5pt; }
math[display="block"] { display: inline math; math-style: normal; }
@media screen { body { padding: 8mm 4mm; } .sheet { margin-bottom: 25mm; } }
"""


def page(title: str, sections: Iterable[str]) -> str:
    """Return a document of its own, which loads nothing from elsewhere and runs nothing."""
    return (
        f'<!DOCTYPE html>\n<html lang="{current_language()}">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">\n'
        f"<title>{escape(title)}</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n"
        + "\n".join(sections)
        + "\n</body>\n</html>\n"
    )


def paragraphs(text: str) -> str:
    """Return a text, whose paragraphs are separated by empty lines, as HTML."""
    return "".join(f"<p>{marked_up(part.strip())}</p>" for part in text.split("\n\n") if part.strip())


def marked_up(text: str) -> str:
    """Return a text as HTML, with the indices of single letters as such: of R^3_6, k_t, p_wx."""
    return _INDEXED.sub(_with_indices, escape(text))


def _with_indices(found: re.Match[str]) -> str:
    letter, above, below = found.groups(default="")
    return letter + (above and f"<sup>{above}</sup>") + (below and f"<sub>{below.strip('()')}</sub>")


@lru_cache(maxsize=4096)  # formulas without numbers come again in every sheet
def formula(latex: str) -> str:
    """Return a formula as MathML, in parts between which a line may break."""
    upright = latex.replace(r"^{\circ}", "°").replace(r"^\circ", "°")  # browsers draw it as small as a raised star
    parts = "<wbr>".join(convert(part, display="block") for part in _parts(upright))
    return f'<div class="formula">{parts}</div>'


def _parts(latex: str) -> list[str]:
    """Cut a formula behind wide spaces and items of a vector, and before all but the first of its equality signs."""
    parts, depth, equals = [""], 0, 0
    for sign in _SIGN.findall(latex):
        depth += (sign in _OPENING) - (sign in _CLOSING)
        is_equality = depth == 0 and sign == "="
        equals += is_equality
        if is_equality and equals > 1:
            parts.append("{}")  # else the sign would stand close to what follows it
        parts[-1] += sign
        if depth == 0 and sign in {r"\quad", r"\;"}:
            parts.append("")
        equals *= sign != r"\quad"
    return [part for part in parts if part.strip()]


def picture(variant: Variant[Any]) -> str:
    """Return the picture of a variant inside the page, or "": as a file of its own, so that no two ids meet."""
    if variant.svg is None:
        return ""
    name = escape(_(variant.exercise.title), quote=True)
    return f'<img alt="{name}" src="data:image/svg+xml;base64,{base64.b64encode(variant.svg).decode()}">'


def worked(steps: Sequence[Step]) -> str:
    """Return a worked solution."""
    return "".join(
        f"<h3>{escape(one.title)}</h3>{paragraphs(one.text)}{''.join(map(formula, one.latex))}" for one in steps
    )


def boxes(one: AnswerField) -> str:
    """Return the place for an answer."""
    if choices := one.choices():
        return "".join(f'<span class="choice">{marked_up(text)}</span>' for text in choices.values())
    shape = one.shape()
    if one.kind == "set":
        rows, columns = _MOST_ROWS, shape[0] if shape else 1
    elif not shape:
        return '<span class="box"></span>'
    else:
        rows, columns = (1, shape[0]) if len(shape) == 1 else shape
    row = '<span class="box"></span>' * columns
    return f'<div class="row">{row}</div>' * rows


def shown(one: AnswerField, answer: Any) -> str:
    """Return an answer for people, as text; its rows on lines of their own."""
    if choices := one.choices():
        return choices[answer]
    if np.ndim(answer) == 0:
        return _number(answer)
    if np.ndim(answer) == 1:
        return "(" + ", ".join(map(_number, answer)) + ")"
    return "\n".join(shown(one, row) for row in answer)


def _number(value: Any) -> str:
    return f"{round(float(value), 10) + 0.0:.6g}".replace("-", "−")


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
