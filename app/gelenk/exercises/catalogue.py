"""All exercises, in the order of the course: those of each module in `lectures` and in the folders below it."""

import pkgutil
from functools import cache
from importlib import import_module
from typing import Any

from gelenk.errors import UnknownExercise
from gelenk.exercises import lectures
from gelenk.exercises.exercise import Exercise

LECTURES = (
    "mobility",
    "actuators",
    "poses",
    "dh_tables",
    "inverse_kinematics",
    "velocities",
    "statics",
    "manipulability",
    "trajectories",
    "workspaces",
    "dynamics",
)
"""The course; a lecture of one's own follows these."""


@cache
def exercises() -> dict[str, Exercise[Any]]:
    """Return all exercises by id, by lectures in the order of the course, the easier ones first."""
    names = (module.name for module in pkgutil.walk_packages(lectures.__path__, f"{lectures.__name__}."))
    found = [one for name in names for one in vars(import_module(name)).values() if isinstance(one, Exercise)]
    return {one.id: one for one in sorted(found, key=_place)}


def _place(one: Exercise[Any]) -> tuple[int, str, int, str]:
    known = LECTURES.index(one.lecture) if one.lecture in LECTURES else len(LECTURES)
    return known, one.lecture, one.difficulty, one.id


def exercise(name: str) -> Exercise[Any]:
    """Return an exercise by its id; raises UnknownExercise."""
    found = exercises().get(name)
    if found is None:
        raise UnknownExercise(name, tuple(exercises()))
    return found
