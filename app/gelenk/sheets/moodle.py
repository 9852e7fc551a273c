"""Questions for Moodle: a category for each exercise, whose variants one draws from, as Moodle's XML format.

Fields of an answer are embedded questions: `{2:NUMERICAL:=8:0.1~%0%6:0.1#what is wrong}`. Moodle decodes HTML entities
in answers and feedback once, and what it gets is HTML, so texts are escaped twice; the signs of its own notation are
entities as well, which its patterns let through.
"""

import base64
import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from html import escape
from typing import Any, cast
from xml.etree.ElementTree import Comment, Element, SubElement, tostring

import numpy as np

from gelenk.errors import InvalidField
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Variant
from gelenk.exercises.fields import NumberArray
from gelenk.exercises.mistakes.catalogue import mistake
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.sheets.document import paragraphs
from gelenk.sheets.homework import Homework
from gelenk.sheets.normal_form import allowed, form_note, has_normal_form, normal_form, turns_of

_SIGNS = str.maketrans({sign: f"&#{ord(sign)};" for sign in '~#}{\\=%"'})
_FINEST = 10_000
"""Parts of a point that weights tell apart."""


def fits(variant: Variant[Any]) -> bool:
    """Check whether all answers can be compared number by number."""
    return all(map(has_normal_form, variant.fields))


def questions(variant: Variant[Any]) -> Iterator[tuple[AnswerField, str]]:
    """Yield each field with its embedded questions as HTML."""
    weights = _weights(variant)
    for one in variant.fields:
        yield one, _embedded(variant, one, weights[one.name])


def _embedded(variant: Variant[Any], one: AnswerField, weight: int) -> str:
    right, wrong = variant.answers[one.name], variant.mistakes(one)
    if choices := one.choices():
        told = {word: code for code, word in wrong.items()}
        parts = [_option(text, word == right, told.get(word)) for word, text in choices.items()]
        return f"{{{weight}:MULTICHOICE:{'~'.join(parts)}}}"
    if note := form_note(one):
        rows = normal_form(one, right)
        turns, near = turns_of(one, np.shape(rows)), allowed(one, right)
        table = [
            [_numerical(weight, _accepted(*cell, near), ()) for cell in zip(*row, strict=True)]
            for row in zip(rows, turns, strict=True)
        ]
        return f"<p>{escape(note)}</p>{_table(table)}"
    one, array = cast(NumberArray, one), np.asarray(right, float)
    cell = partial(_cell, one, array, {code: np.asarray(answer, float) for code, answer in wrong.items()}, weight)
    if array.ndim == 0:
        return cell(())
    rows = array.shape[0] if array.ndim == 2 else 1
    places = [[(r, c) if array.ndim == 2 else (c,) for c in range(array.shape[-1])] for r in range(rows)]
    return _table([[cell(place) for place in row] for row in places])


def _cell(one: NumberArray, right: Array, wrong: Mapping[str, Array], weight: int, place: tuple[int, ...]) -> str:
    """Return the question for one number of an answer; a wrong number that two mistakes share has no feedback."""
    right_near = one.allowed(right)
    found = [(float(answer[place]), one.allowed(answer), code) for code, answer in wrong.items()]
    apart = [(float(right[place]), right_near), *((value, near) for value, near, _code in found)]
    clear = [
        (value, near, code)
        for i, (value, near, code) in enumerate(found, 1)
        if all(abs(value - other) > near + room for j, (other, room) in enumerate(apart) if j != i)
    ]
    turn = float(turns_of(one, ())[()])
    return _numerical(weight, _accepted(float(right[place]), turn, right_near), clear)


def _accepted(value: float, turn: float, near: float) -> list[tuple[float, float]]:
    """Return the numbers that are right, each with its tolerance: an angle may differ by a turn."""
    return [(value + shift, near) for shift in ((0.0, turn, -turn) if turn else (0.0,))]


def _numerical(weight: int, right: Sequence[tuple[float, float]], wrong: Sequence[tuple[float, float, str]]) -> str:
    parts = [f"={value:.12g}:{near:.6g}" for value, near in right]
    parts += [f"%0%{value:.12g}:{near:.6g}#{_text(mistake(code).text)}" for value, near, code in wrong]
    return f"{{{weight}:NUMERICAL:{'~'.join(parts)}}}"


def _option(text: str, is_right: bool, code: str | None) -> str:
    feedback = f"#{_text(mistake(code).text)}" if code else ""
    return f"{'=' if is_right else '%0%'}{_text(text)}{feedback}"


def _text(text: str) -> str:
    return escape(escape(text, quote=False), quote=False).replace("&", "\0").translate(_SIGNS).replace("\0", "&")


def _table(rows: Sequence[Sequence[str]]) -> str:
    lines = ("".join(f"<td>{cell}</td>" for cell in row) for row in rows)
    return f"<table><tbody>{''.join(f'<tr>{line}</tr>' for line in lines)}</tbody></table>"


def _weights(variant: Variant[Any]) -> dict[str, int]:
    """Return whole numbers in the ratio of what one number of each field is worth."""
    counts = {one.name: _count(one, variant.answers[one.name]) for one in variant.fields}
    whole = math.lcm(*counts.values())
    parts = {one.name: round(one.points * _FINEST) * whole // counts[one.name] for one in variant.fields}
    common = math.gcd(*parts.values())
    return {name: part // common for name, part in parts.items()}


def _count(one: AnswerField, answer: Any) -> int:
    return 1 if one.choices() else sum(np.size(row) for row in answer) if one.kind == "set" else np.size(answer)


_PICTURE = "picture.svg"
_NOT_ASKED = "asks for a basis of several vectors, which Moodle cannot compare"


def moodle_xml(homework: Homework, is_partial: bool = False) -> bytes:
    """Return the variants of all participants, without their names.

    Raises InvalidField for an exercise that Moodle cannot ask; if `is_partial`, a comment says so instead.
    """
    quiz = Element("quiz")
    for i, (exercise, variants) in enumerate(homework.pools()):
        if not all(map(fits, variants)):
            if not is_partial:
                raise InvalidField(f"exercises/{i}", f"{exercise.id} {_NOT_ASKED}; leave it out")
            quiz.append(Comment(f" {exercise.id} {_NOT_ASKED} and is left out "))
            continue
        title = homework.title or _("Exercises")
        category = SubElement(SubElement(quiz, "question", type="category"), "category")
        # A slash would begin a category of its own.
        path = (title, _(exercise.title))
        SubElement(category, "text").text = "$course$/top/" + "/".join(part.replace("/", "//") for part in path)
        for number, variant in enumerate(variants, 1):
            quiz.append(_question(variant, f"{exercise.id} {number:03}"))
    content: bytes = tostring(quiz, encoding="utf-8", xml_declaration=True)
    return content


def _question(variant: Variant[Any], name: str) -> Element:
    question, drawn = Element("question", type="cloze"), variant.svg
    SubElement(SubElement(question, "name"), "text").text = name
    asked = "".join(
        f"<p>{escape(one.label, quote=False)}{f' [{one.unit}]' if one.unit else ''}: {embedded}</p>"
        if not embedded.startswith("<")
        else f"<p>{escape(one.label, quote=False)}{f' [{one.unit}]' if one.unit else ''}:</p>{embedded}"
        for one, embedded in questions(variant)
    )
    image = f'<p><img src="@@PLUGINFILE@@/{_PICTURE}" alt=""></p>' if drawn else ""
    text = _html(question, "questiontext", paragraphs(variant.exercise.text(variant.numbers)) + image + asked)
    if drawn:
        file = SubElement(text, "file", name=_PICTURE, path="/", encoding="base64")
        file.text = base64.b64encode(drawn).decode()
    _html(question, "generalfeedback", _worked(variant))
    SubElement(question, "penalty").text = "0.3333333"
    SubElement(question, "hidden").text = "0"
    return question


def _html(question: Element, tag: str, content: str) -> Element:
    part = SubElement(question, tag, format="html")
    SubElement(part, "text").text = content
    return part


def _worked(variant: Variant[Any]) -> str:
    """Return the worked solution; Moodle's filters show formulas between these marks, and remove MathML."""
    return "".join(
        f"<h5>{escape(one.title, quote=False)}</h5>{paragraphs(one.text)}"
        + "".join(rf"<p>\[{escape(latex, quote=False)}\]</p>" for latex in one.latex)
        for one in variant.steps
    )
