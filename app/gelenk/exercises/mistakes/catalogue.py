"""The table of all mistakes."""

import pkgutil
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

from gelenk.exercises import mistakes
from gelenk.language import translated as _


@dataclass(frozen=True, slots=True)
class Mistake:
    """A recognized mistake: its code, and a sentence about it."""

    code: str
    text: str


def mistake(code: str, **places: Any) -> Mistake:
    """Return a mistake in the current language, its named places filled; raises KeyError for an unknown code."""
    return Mistake(code, _(catalogue()[code]).format(**places))


@cache
def catalogue() -> dict[str, str]:
    """Return the messages of all mistakes by code."""
    names = (module.name for module in pkgutil.iter_modules(mistakes.__path__) if module.name != "catalogue")
    modules = [import_module(f"{mistakes.__name__}.{name}") for name in names]
    return {code: text for module in modules for code, text in module.MISTAKES.items()}
