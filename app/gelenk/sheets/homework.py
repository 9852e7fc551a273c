"""Who gets which variants: the seed follows from a secret, the participant and the exercise, so nothing is kept."""

import hashlib
import hmac
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from gelenk.errors import InvalidField, TooLarge, quoted
from gelenk.exercises.exercise import Exercise, Variant, exercise
from gelenk.sheets.bounds import MAX_VARIANTS

_SEED_BITS = 53
FORMULA_SIGNS = ("=", "+", "-", "@", "\t", "\r")
"""A spreadsheet takes a cell that begins with one of these for a formula."""


def unprotected(text: str) -> str:
    """Return a cell's text: composed letters, no spaces around it, and no apostrophe against being computed."""
    text = unicodedata.normalize("NFC", text.strip())
    return text[1:] if text.startswith("'") and text[1:].startswith(FORMULA_SIGNS) else text


def seed_of(secret: str, participant: str, exercise_id: str) -> int:
    """Return the seed of a participant's variant; only who knows the secret can find it."""
    message = f"{unprotected(participant)}\0{exercise_id}".encode()
    digest = hmac.digest(secret.encode(), message, hashlib.sha256)
    return int.from_bytes(digest[:8], "big") >> (64 - _SEED_BITS)


def variant_of(secret: str, participant: str, found: Exercise[Any]) -> Variant[Any]:
    """Return a participant's variant of an exercise."""
    return found.variant(seed_of(secret, participant, found.id))


@dataclass(frozen=True, slots=True)
class Sheet:
    """The variants of one participant."""

    participant: str
    variants: tuple[Variant[Any], ...]


@dataclass(frozen=True)
class Homework:
    """Exercises for participants.

    Attributes:
        title: Printed on every sheet; "" for none.
        secret: Decides the numbers.
    """

    exercise_ids: Sequence[str]
    participants: Sequence[str]
    title: str
    secret: str = field(repr=False)

    def __post_init__(self) -> None:
        if self.title and not self.title.isprintable():
            raise InvalidField("title", "must have no control characters")
        _check_different("exercises", self.exercise_ids)
        _check_different("participants", self.participants)
        count = len(self.exercise_ids) * len(self.participants)
        if count > MAX_VARIANTS:
            raise TooLarge("participants times exercises", count, MAX_VARIANTS)

    @cached_property
    def exercises(self) -> tuple[Exercise[Any], ...]:
        """The exercises; raises UnknownExercise."""
        return tuple(map(exercise, self.exercise_ids))

    @cached_property
    def sheets(self) -> tuple[Sheet, ...]:
        """The sheets, in the order of the participants."""
        return tuple(
            Sheet(label, tuple(variant_of(self.secret, label, one) for one in self.exercises))
            for label in map(unprotected, self.participants)
        )

    def pools(self) -> Iterator[tuple[Exercise[Any], tuple[Variant[Any], ...]]]:
        """Yield each exercise with the variants of all participants, in their order."""
        for i, one in enumerate(self.exercises):
            yield one, tuple(sheet.variants[i] for sheet in self.sheets)


def _check_different(where: str, names: Sequence[str]) -> None:
    known: set[str] = set()
    for i, name in enumerate(map(unprotected, names)):
        if name in known:
            raise InvalidField(f"{where}/{i}", f"{quoted(name)} is listed twice; each may be listed once")
        if not name.isprintable() or not name:
            raise InvalidField(f"{where}/{i}", "must have letters or digits, and no control characters")
        known.add(name)
