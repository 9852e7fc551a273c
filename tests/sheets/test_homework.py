"""Who gets which numbers."""

import hashlib
import hmac

import pytest

from gelenk.errors import InvalidField, TooLarge, UnknownExercise
from gelenk.exercises.exercise import exercise
from gelenk.sheets.homework import Homework, seed_of, unprotected
from tests.sheets.examples import SECRET, homework

LINKAGE = "mobility.linkage"


def test_seeds_are_those_of_the_definition() -> None:
    digest = hmac.new(SECRET.encode(), b"Ada\0mobility.linkage", hashlib.sha256).hexdigest()
    assert seed_of(SECRET, "Ada", LINKAGE) == int(digest, 16) >> (256 - 53)


def test_secret_participant_and_exercise_each_change_the_numbers() -> None:
    seeds = {
        seed_of(secret, who, which)
        for secret in (SECRET, "another phrase of the lecturer")
        for who in ("Ada", "Ben", "")
        for which in (LINKAGE, "actuators.gear")
    }
    assert len(seeds) == 12


def test_numbers_do_not_depend_on_who_else_takes_part() -> None:
    alone, together = homework(LINKAGE, participants=("Ben",)), homework("actuators.gear", LINKAGE)
    assert alone.sheets[0].variants[0].numbers == together.sheets[1].variants[1].numbers
    assert alone.sheets[0].variants[0].numbers == exercise(LINKAGE).variant(seed_of(SECRET, "Ben", LINKAGE)).numbers


@pytest.mark.parametrize("text", [" Zo\u00eb\n", "Zoe\u0308", "Zo\u00eb"])
def test_a_name_is_the_same_however_it_is_written(text: str) -> None:
    assert unprotected(text) == "Zo\u00eb"


def test_an_apostrophe_that_protects_a_cell_does_not_count() -> None:
    assert unprotected("'=x") == unprotected("=x")
    assert unprotected("'t Hooft") == "'t Hooft"


@pytest.mark.parametrize(
    ("ids", "participants", "title", "field"),
    [
        ((LINKAGE, LINKAGE), ("Ada",), "", "exercises/1"),
        ((LINKAGE,), ("Ada", " Ada"), "", "participants/1"),
        ((LINKAGE,), ("  ",), "", "participants/0"),
        ((LINKAGE,), ("a\nb",), "", "participants/0"),
        ((LINKAGE,), ("Ada",), "a\0", "title"),
    ],
)
def test_what_is_wrong_is_named(ids: tuple[str, ...], participants: tuple[str, ...], title: str, field: str) -> None:
    with pytest.raises(InvalidField) as error:
        Homework(ids, participants, title, SECRET)
    assert error.value.field == field


def test_there_are_bounds() -> None:
    with pytest.raises(TooLarge):
        homework(*(f"a.{i}" for i in range(21)), participants=tuple(map(str, range(50))))
    with pytest.raises(UnknownExercise):
        homework("no.such").exercises  # noqa: B018
    assert SECRET not in repr(homework(LINKAGE))
