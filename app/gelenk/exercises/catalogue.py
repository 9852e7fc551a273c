"""All exercises: those of each module in `lectures` that there is, in the order of the course."""

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
    """Return all exercises by id, by lectures in the order of the course."""
    names = [module.name for module in pkgutil.iter_modules(lectures.__path__)]
    names.sort(key=lambda name: (LECTURES.index(name) if name in LECTURES else len(LECTURES), name))
    modules = [import_module(f"{lectures.__name__}.{name}") for name in names]
    return {one.id: one for module in modules for one in module.EXERCISES}


def exercise(name: str) -> Exercise[Any]:
    """Return an exercise by its id; raises UnknownExercise."""
    found = exercises().get(name)
    if found is None:
        raise UnknownExercise(name, tuple(exercises()))
    return found
