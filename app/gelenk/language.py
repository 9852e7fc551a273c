"""The language of what people read: steps of solutions, exercises, names of mistakes.

A message is written in English where it is used, as `_("{n} links meet.").format(n=n)`, with this module's
`translated` imported as `_`. One that is written before its language is known, such as in a table of a module, is
`marked` there and `translated` where it is used. The catalogues in `app/gelenk/texts` hold all of them in the other
languages; `./dev texts` compiles them. Numbers that `.format` puts in get the decimal mark of the language; a number
that is text already goes through `localised`, a list of numbers through `number_list`.
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from gettext import NullTranslations, translation
from string import Formatter
from typing import Any, Literal, TypeAlias

from gelenk.package_data import texts

Language: TypeAlias = Literal["en", "de"]

_current: ContextVar[Language] = ContextVar("language", default="en")


def translated(message: str) -> str:
    """Return a message in the current language; in English, and where no catalogue has it, as it is."""
    found = _catalogue(_current.get()).gettext(message)
    return _WithCommas(found) if has_decimal_comma() else found


def marked(message: str) -> str:
    """Return a message as it is, to be translated where it is used; the mark lets `./dev texts` find it."""
    return message


def has_decimal_comma() -> bool:
    """Return whether the current language writes 0,25."""
    return _current.get() == "de"


def localised(number: str) -> str:
    """Return a number with the decimal mark of the current language."""
    return number.replace(".", ",") if has_decimal_comma() else number


def number(value: float, form: str = ".4g") -> str:
    """Return a number as text, with the decimal mark of the current language."""
    return localised(format(value, form))


def separator() -> str:
    """Return what separates numbers in a list: behind decimal commas, a semicolon."""
    return "; " if has_decimal_comma() else ", "


def number_list(values: Iterable[float], form: str = "g") -> str:
    """Return numbers in a list, with six digits: 0.25, 1 or, behind decimal commas, 0,25; 1."""
    return separator().join(number(value, form) for value in values)


class _CommaFormatter(Formatter):
    def format_field(self, value: Any, format_spec: str) -> Any:
        text = super().format_field(value, format_spec)
        return localised(text) if isinstance(value, float) else text


class _WithCommas(str):
    """A message whose numbers get decimal commas."""

    __slots__ = ()

    def format(self, *args: Any, **kwargs: Any) -> str:
        return _CommaFormatter().vformat(self, args, kwargs)


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
