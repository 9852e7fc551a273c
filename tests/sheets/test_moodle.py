"""Questions for Moodle, read as Moodle reads them."""

import base64
import html
import re
from collections.abc import Iterator
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, fromstring

import numpy as np
import pytest

from gelenk.errors import InvalidField
from gelenk.exercises.exercise import Variant
from gelenk.exercises.mistakes.catalogue import mistake
from gelenk.language import language
from gelenk.sheets.moodle import fits, moodle_xml
from gelenk.sheets.normal_form import normal_form
from tests.sheets.examples import SIGNS, homework, odd, unasked

# The notation as Moodle documents it: {points:TYPE:alternatives}; an alternative is "=" or "%share%", then the answer,
# then "#" and the feedback. In an answer ~ # } end it unless a backslash or an ampersand stands before them.
_ANSWER = r"(?P<answer>.+?(?<!\\|&)(?=[~#}]|$))"
_ALTERNATIVE = rf"(?P<share>=|%-?[0-9.]+%)?{_ANSWER}(?:#(?P<feedback>.*?(?<!\\)(?=[~}}]|$)))?"
_NAMELESS = re.sub(r"\?P<\w+>", "?:", _ALTERNATIVE)
_QUESTION = re.compile(rf"\{{(\d*):(NUMERICAL|MULTICHOICE):({_NAMELESS}(?:~{_NAMELESS})*)\}}", re.DOTALL)
_NUMBER = r"-?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?"


class Alternative(NamedTuple):
    share: float
    answer: str
    feedback: str


class Embedded(NamedTuple):
    points: int
    kind: str
    alternatives: list[Alternative]

    def told(self, value: float) -> Alternative | None:
        """What Moodle says to a number: the first that it is near."""
        for one in self.alternatives:
            found = re.fullmatch(f"({_NUMBER}):({_NUMBER})", one.answer)
            assert found is not None, one.answer
            if abs(value - float(found[1])) <= float(found[2]) + 1e-9 * abs(value):
                return one
        return None


def embedded(text: str) -> list[Embedded]:
    return [Embedded(int(points), kind, list(alternatives(inner))) for points, kind, inner in _QUESTION.findall(text)]


def alternatives(inner: str) -> Iterator[Alternative]:
    for found in re.finditer(f"~?{_ALTERNATIVE}", inner, re.DOTALL):
        share = {"=": 1.0, None: 0.0}.get(found["share"]) if found["share"] in ("=", None) else 0.0
        yield Alternative(share or 0.0, html.unescape(found["answer"]), html.unescape(found["feedback"] or ""))


def questions(xml: bytes) -> list[Element]:
    return [one for one in fromstring(xml).findall("question") if one.get("type") == "cloze"]


def text_of(question: Element, tag: str) -> str:
    return question.findtext(f"{tag}/text") or ""


def shown(text: str) -> str:
    """HTML as a reader sees it."""
    return html.unescape(re.sub(r"<[^>]*>", "", text))


def numbers(variant: Variant[Any]) -> list[tuple[Any, float]]:
    """Each number of the answers with its field, in the order of the question."""
    found: list[tuple[Any, float]] = []
    for one in variant.fields:
        right = variant.answers[one.name]
        if one.choices():
            continue
        found += [(one, float(cell)) for cell in np.ravel(normal_form(one, right))]
    return found


@pytest.mark.slow
def test_every_answer_is_asked_for_and_right() -> None:
    one = homework()
    asked = {text_of(question, "name"): question for question in questions(moodle_xml(one, is_partial=True))}
    possible = [(exercise, all_of) for exercise, all_of in one.pools() if all(map(fits, all_of))]
    assert len(asked) == 2 * len(possible) > 10
    for exercise, all_of in possible:
        for i, variant in enumerate(all_of, 1):
            found = embedded(text_of(asked[f"{exercise.id} {i:03}"], "questiontext"))
            numeric = [part for part in found if part.kind == "NUMERICAL"]
            for part, (_, right) in zip(numeric, numbers(variant), strict=True):
                told = part.told(right)
                assert told is not None
                assert told.share == 1.0
            chosen = [part for part in found if part.kind == "MULTICHOICE"]
            choices = [field for field in variant.fields if field.choices()]
            for part, field in zip(chosen, choices, strict=True):
                right_text = field.choices()[variant.answers[field.name]]
                assert [shown(one.answer) for one in part.alternatives if one.share == 1.0] == [right_text]


@pytest.mark.slow
def test_a_mistake_has_its_sentence() -> None:
    """For scalar fields Moodle says what grading says."""
    one, count = homework(), 0
    asked = {text_of(question, "name"): question for question in questions(moodle_xml(one, is_partial=True))}
    for exercise, all_of in one.pools():
        for i, variant in enumerate(all_of, 1):
            if f"{exercise.id} {i:03}" not in asked:
                continue
            found = embedded(text_of(asked[f"{exercise.id} {i:03}"], "questiontext"))
            numeric = iter(part for part in found if part.kind == "NUMERICAL")
            for field, _ in numbers(variant):
                part = next(numeric)
                if field.kind == "number":
                    for code, wrong in variant.mistakes(field).items():
                        told = part.told(float(wrong))
                        assert told is not None, (exercise.id, field.name, code)
                        assert (told.share, shown(told.feedback)) == (0.0, mistake(code).text)
                        count += 1
    assert count > 50


def test_signs_of_the_notation_are_no_notation() -> None:
    (question,) = questions(moodle_xml(odd()))
    text = text_of(question, "questiontext")
    found = embedded(text)
    assert [part.kind for part in found] == ["NUMERICAL"] * 10 + ["MULTICHOICE"] + ["NUMERICAL"] * 4
    assert [shown(one.answer) for one in found[10].alternatives] == [SIGNS, "=x%", "o"]
    assert [one.share for one in found[10].alternatives] == [1.0, 0.0, 0.0]
    assert shown(found[10].alternatives[1].feedback) == mistake("ratio_inverted").text
    assert "<script" not in html.unescape(text).replace(html.escape(SIGNS, quote=False), "").replace(SIGNS, "")
    assert shown(text_of(question, "generalfeedback")).count(SIGNS) == 2


def test_vectors_and_sets_are_tables_and_angles_may_turn() -> None:
    (question,) = questions(moodle_xml(odd()))
    text = text_of(question, "questiontext")
    found = embedded(text)
    rows = [len(_QUESTION.findall(row)) for row in re.findall(r"<tr>.*?</tr>", text)]
    assert rows == [3, 3, 3, 2, 2]
    for value in (3.0, 3.0 - 2 * np.pi, 3.0 + 2 * np.pi):
        told = found[0].told(value)
        assert told is not None
        assert told.share == 1.0
    in_set = [float(part.alternatives[0].answer.partition(":")[0]) for part in found[11:]]
    assert in_set == pytest.approx([-2.0, 6.0 - 2 * np.pi, 3.0, 1.0])


def test_a_number_that_two_mistakes_share_says_neither() -> None:
    found = embedded(text_of(questions(moodle_xml(odd()))[0], "questiontext"))
    first, second, third = found[1:4]
    assert first.told(5.0) is None
    assert second.told(9.0) == Alternative(0.0, "9:0.11", mistake("efficiency_forgotten").text)
    assert third.told(7.0) == Alternative(0.0, "7:0.07", mistake("ratio_inverted").text)
    right = second.told(2.0)
    assert right is not None
    assert right.share == 1.0


def test_points_are_in_the_ratio_of_the_fields() -> None:
    found = embedded(text_of(questions(moodle_xml(odd()))[0], "questiontext"))
    angle, vector, matrix = found[0].points, found[1:4], found[4:10]
    assert sum(part.points for part in vector) * 2 == angle
    assert sum(part.points for part in matrix) == sum(part.points for part in vector) == found[10].points


def test_pictures_come_along() -> None:
    (question,) = questions(moodle_xml(odd()))
    file = question.find("questiontext/file")
    assert file is not None
    assert f'src="@@PLUGINFILE@@/{file.get("name")}"' in text_of(question, "questiontext")
    assert fromstring(base64.b64decode(file.text or "")).tag == "{http://www.w3.org/2000/svg}svg"


def test_each_exercise_has_a_category() -> None:
    with language("de"):
        quiz = fromstring(moodle_xml(homework("actuators.gear", "actuators.pwm", title="Blatt 1/2")))
    paths = [one.findtext("category/text") for one in quiz if one.get("type") == "category"]
    assert paths[0] == "$course$/top/Blatt 1//2/Ein Getriebe zwischen Motor und Gelenk"
    assert [one.get("type") for one in quiz] == ["category", "cloze", "cloze"] * 2


@pytest.mark.slow
def test_names_of_participants_do_not_leave() -> None:
    xml = moodle_xml(homework(participants=("Ada Lovelace", "Grace Hopper")), is_partial=True).decode()
    assert "Lovelace" not in xml
    assert "Hopper" not in xml


def test_what_moodle_cannot_ask_is_refused_or_said() -> None:
    with pytest.raises(InvalidField, match=r"signs.all asks for a basis of several vectors, .*; leave it out") as error:
        moodle_xml(unasked())
    assert error.value.field == "exercises/0"
    xml = moodle_xml(unasked(), is_partial=True).decode()
    assert re.findall(r"<!-- (\S+) asks .* is left out -->", xml) == ["signs.all"]
    assert questions(xml.encode()) == []
    assert all(fits(one.variant(0)) for one in homework().exercises)
