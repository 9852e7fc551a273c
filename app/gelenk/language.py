"""The language of what people read: steps of solutions, exercises, names of mistakes.

A message is written in English where it is used, as `_("{n} links meet.").format(n=n)`, with this module's
`translated` imported as `_`. One that is written before its language is known, such as in a table of a module, is
`marked` there and `translated` where it is used. The catalogues in `app/gelenk/texts` hold all of them in the other
languages; `./dev texts` compiles them.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from gettext import NullTranslations, translation
from typing import Literal, TypeAlias

from gelenk.package_data import texts

Language: TypeAlias = Literal["en", "de"]

_current: ContextVar[Language] = ContextVar("language", default="en")


def translated(message: str) -> str:
    """Return a message in the current language; in English, and where no catalogue has it, as it is."""
    return _catalogue(_current.get()).gettext(message)


def marked(message: str) -> str:
    """Return a message as it is, to be translated where it is used; the mark lets `./dev texts` find it."""
    return message


def current_language() -> Language:
    """Return the language of this thread or task, for what keeps texts."""
    return _current.get()


@contextmanager
def language(code: Language) -> Iterator[None]:
    """Let messages be in a language, for this thread or task."""
    token = _current.set(code)
    try:
        yield
    finally:
        _current.reset(token)


@cache
def _catalogue(code: Language) -> NullTranslations:
    return NullTranslations() if code == "en" else translation("gelenk", texts(), [code], fallback=True)
