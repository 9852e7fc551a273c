"""Every error of the core: its sentence, its data, its journey between processes."""

import pickle
import re
from dataclasses import fields

import pytest

from gelenk import errors
from gelenk.errors import KinematicsError, kinds, listed, quoted

OURS = {"reason", "element", "parameter", "quantity", "what", "joint_type", "representation", "angle", "kind", "thing"}
"""Fields whose text we write; all other texts come from outside."""


def example(cls: type[KinematicsError], name: str = "el\nbow") -> KinematicsError:
    """An error with something in every field; its names from outside are this one."""
    values: dict[object, object] = {
        str: name,
        int: 7,
        int | None: 8,
        bool: False,
        float: 0.5,
        float | None: 0.25,
        str | None: name,
        tuple[str, ...]: ("shoulder", name),
    }
    return cls(*("elbow" if field.name in OURS else values[field.type] for field in fields(cls)))


CONCRETE = [cls for _, cls in sorted(kinds().items()) if cls.template]
"""All classes with a sentence of their own."""

every_error = pytest.mark.parametrize("cls", CONCRETE, ids=lambda cls: cls.__name__)


@every_error
def test_detail_is_one_sentence(cls: type[KinematicsError]) -> None:
    detail = example(cls).detail
    assert detail == str(example(cls)) != ""
    assert not re.search(r"[.!?] [A-Z]|\.$", detail)
    assert detail.isprintable()


@every_error
def test_errors_travel_between_processes(cls: type[KinematicsError]) -> None:
    error = example(cls)
    again = pickle.loads(pickle.dumps(error))  # noqa: S301
    assert type(again) is cls
    assert (again.detail, again.facts()) == (error.detail, error.facts())


def test_only_what_others_derive_from_says_nothing() -> None:
    assert set(kinds().values()) - set(CONCRETE) == {errors.InvalidInput, errors.NotFound}


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("elbow", "'elbow'"),
        ("el\nbow", "'el\\u000abow'"),
        ("\x1b[2J", "'\\u001b[2J'"),
        ("e" * 1000, "'" + "e" * 79 + "…'"),
    ],
)
def test_names_from_outside_are_shown_safely(name: str, shown: str) -> None:
    assert quoted(name) == shown


def test_long_lists_are_cut() -> None:
    assert listed(()) == "none"
    assert listed(tuple("abc"), most=2) == "'a', 'b' and 1 more"
