"""Questions for Moodle: a category for each exercise, whose variants one draws from, as Moodle's XML format."""

import base64
from html import escape
from typing import Any
from xml.etree.ElementTree import Comment, Element, SubElement, tostring

from gelenk.errors import InvalidField
from gelenk.exercises.exercise import Variant
from gelenk.language import translated as _
from gelenk.sheets.cloze import fits, questions
from gelenk.sheets.document import paragraphs
from gelenk.sheets.homework import Homework

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
