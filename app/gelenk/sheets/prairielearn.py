"""Questions for PrairieLearn: a folder for each exercise, with the variants of all participants to choose from."""

import json
from collections.abc import Iterable, Iterator
from html import escape
from typing import Any
from uuid import NAMESPACE_URL, uuid5

import numpy as np

from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.exercise import Exercise, Variant
from gelenk.exercises.fields import NumberField
from gelenk.language import translated as _
from gelenk.sheets.document import paragraphs, picture
from gelenk.sheets.homework import Homework
from gelenk.sheets.moodle import fits
from gelenk.sheets.normal_form import allowed, form_note, normal_form, turns_of

_SERVER = '''"""Chooses one of the variants in `variants.json`; PrairieLearn seeds `random` for each of its own."""

import json
import pathlib
import random

import numpy as np
import prairielearn as pl


def generate(data):
    file = pathlib.Path(data["options"]["question_path"]) / "variants.json"
    variant = random.choice(json.loads(file.read_text(encoding="utf-8")))
    data["params"].update(variant["params"])
    for name, answer in variant["answers"].items():
        data["correct_answers"][name] = pl.to_json(np.array(answer)) if isinstance(answer, list) else answer


def grade(data):
    """Accept angles that differ by whole turns."""
    for name, turns in data["params"]["turns"].items():
        given, right = data["submitted_answers"].get(name), data["correct_answers"][name]
        if given is None or data["partial_scores"].get(name) is None:
            continue
        apart = np.array(pl.from_json(given), float) - np.array(pl.from_json(right), float)
        turns = np.array(turns)
        whole = np.where(turns > 0, turns * np.round(apart / np.where(turns > 0, turns, 1)), 0)
        if np.abs(apart - whole).max() <= data["params"][name]["tolerance"]:
            data["partial_scores"][name]["score"] = 1.0
    pl.set_weighted_score_data(data)
'''


def prairielearn_files(homework: Homework) -> Iterator[tuple[str, str]]:
    """Yield the files of all exercises that PrairieLearn's elements can ask, by their paths."""
    for exercise, variants in homework.pools():
        if all(map(fits, variants)):
            for name, content in _folder(homework, exercise, variants).items():
                yield f"prairielearn/{exercise.id.replace('.', '_')}/{name}", content


def _folder(homework: Homework, exercise: Exercise[Any], variants: tuple[Variant[Any], ...]) -> dict[str, str]:
    info = {
        "uuid": str(uuid5(NAMESPACE_URL, f"urn:gelenk:exercise:{exercise.id}:{exercise.version}")),
        "title": _(exercise.title),
        "topic": homework.title or exercise.lecture,
        "tags": [exercise.lecture],
        "type": "v3",
    }
    inputs = "\n".join(map(_input, variants[0].fields))
    return {
        "info.json": json.dumps(info, indent=2, ensure_ascii=False) + "\n",
        "question.html": "<pl-question-panel>\n{{{params.text}}}\n</pl-question-panel>\n" + inputs + "\n"
        "<pl-answer-panel>\n{{{params.solution}}}\n</pl-answer-panel>\n",
        "server.py": _SERVER,
        "variants.json": json.dumps([_variant(one) for one in variants], ensure_ascii=False) + "\n",
    }


def _input(one: AnswerField) -> str:
    """Return the element for a field; what differs between variants comes from the parameters."""
    label, name = escape(one.label), escape(one.name)
    compared = f'answers-name="{name}" comparison="relabs" rtol="0" atol="{{{{params.{name}.tolerance}}}}"'
    if choices := one.choices():
        options = "\n".join(
            f'  <pl-answer correct="{{{{params.{one.name}.c{i}}}}}">{escape(text)}</pl-answer>'
            for i, text in enumerate(choices.values())
        )
        return (
            f"<p>{label}</p>\n"
            f'<pl-multiple-choice answers-name="{name}" order="fixed">\n{options}\n</pl-multiple-choice>'
        )
    if isinstance(one, NumberField):
        unit = f' suffix="{escape(one.unit)}"' if one.unit else ""
        return f'<pl-number-input {compared} label="{label}"{unit}></pl-number-input>'
    unit = f" [{escape(one.unit)}]" if one.unit else ""
    note = f"<p>{label}{unit}. {escape(form_note(one))}</p>"
    return f"{note}\n<pl-matrix-component-input {compared}></pl-matrix-component-input>"


def _variant(variant: Variant[Any]) -> dict[str, Any]:
    fields = {one.name: (one, variant.answers[one.name]) for one in variant.fields}
    steps = "".join(
        f"<h5>{escape(one.title)}</h5>{paragraphs(one.text)}"
        + "".join(f"<p>$${escape(latex, quote=False)}$$</p>" for latex in one.latex)
        for one in variant.steps
    )
    return {
        "params": {
            "text": paragraphs(variant.exercise.text(variant.numbers)) + picture(variant),
            "solution": steps,
            "turns": _turns(fields.values()),
            **{name: _params(one, right) for name, (one, right) in fields.items()},
        },
        "answers": {name: _answer(one, right) for name, (one, right) in fields.items() if not one.choices()},
    }


def _turns(fields: Iterable[tuple[AnswerField, Any]]) -> dict[str, Any]:
    """Return the turns of the numbers of each field that has angles."""
    found = {one.name: turns_of(one, np.shape(_answer(one, right))) for one, right in fields if not one.choices()}
    return {name: turns.tolist() for name, turns in found.items() if turns.any()}


def _params(one: AnswerField, right: Any) -> dict[str, Any]:
    if choices := one.choices():
        return {f"c{i}": str(word == right).lower() for i, word in enumerate(choices)}
    return {"tolerance": allowed(one, right)}


def _answer(one: AnswerField, right: Any) -> Any:
    array = np.asarray(normal_form(one, right))
    return float(array) if array.ndim == 0 else np.atleast_2d(array).tolist()
