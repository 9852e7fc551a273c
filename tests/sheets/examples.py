"""Homework for the tests, and an exercise whose texts have every sign that a format could take for its own."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from gelenk.course.steps import step
from gelenk.exercises.exercise import Exercise, exercises
from gelenk.exercises.fields import ChoiceField, MatrixField, NumberField, SetField, VectorField, basis
from gelenk.sheets.homework import Homework, Sheet

SECRET = "only the lecturer knows"  # noqa: S105
SIGNS = """a < b & "c" ~ # } { \\ = %50% ' </p> ]]> &amp; <script>alert(1)</script>"""


class Numbers(NamedTuple):
    size: int


def drawn(_: Numbers) -> Figure:
    figure = Figure(figsize=(2, 1))
    figure.text(0.1, 0.5, "A & B")
    return figure


ODD: Exercise[Numbers] = Exercise(
    id="signs.all",
    title=SIGNS,
    difficulty=1,
    draw=lambda draw: Numbers(draw.integer(1, 9)),
    text=lambda _: f"{SIGNS}\n\nsecond",
    fields=lambda _: (
        NumberField(name="angle", label=SIGNS, unit="rad", tolerance=0.01, is_angle=True, points=2.0),
        VectorField(name="vector", label="v", size=3, tolerance=0.01, is_relative=True),
        MatrixField(name="matrix", label="M", rows=2, columns=3, tolerance=0.001),
        ChoiceField(name="choice", label="c", options={"right": SIGNS, "wrong": "=x%", "other": "o"}),
        SetField(
            name="set",
            label="s",
            item=VectorField(name="one", label="", unit="rad", size=2, is_angle=True, tolerance=0.1),
        ),
    ),
    solve=lambda _: {
        "angle": 3.0,
        "vector": [1.0, 2.0, 3.0],
        "matrix": [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]],
        "choice": "right",
        "set": [[3.0, 1.0], [-2.0, 6.0]],
    },
    steps=lambda _: [step(SIGNS, SIGNS, r"a < b \le \begin{bmatrix} 1 & 2 \end{bmatrix}")],
    wrong={
        "ratio_inverted": lambda _: {"vector": [5.0, 2.0, 7.0], "choice": "wrong"},
        "efficiency_forgotten": lambda _: {"vector": [5.0, 9.0, 11.0]},
    },
    picture=drawn,
)


def homework(*ids: str, participants: tuple[str, ...] = ("Ada", "Ben"), title: str = "Sheet 1") -> Homework:
    return Homework(ids or tuple(exercises()), participants, title, SECRET)


class OddHomework(Homework):
    """A homework of the odd exercise, which is not in the catalogue."""

    exercises = (ODD,)
    sheets = (Sheet("<b>&\"'", (ODD.variant(1),)),)


def odd() -> Homework:
    return OddHomework((), (), "", SECRET)


def unasked() -> Homework:
    """A homework of an exercise that asks for a plane, which no system can compare number by number."""
    plane = basis("plane", "P", (3, 2))
    one = replace(ODD, fields=lambda _: (plane,), solve=lambda _: {"plane": np.eye(3)[:, :2]}, wrong={})
    found = OddHomework((), (), "", SECRET)
    found.__dict__.update(exercises=(one,), sheets=(Sheet("Ada", (one.variant(1),)),))
    return found
