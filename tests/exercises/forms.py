"""Answers as they travel, and other forms of the same answer."""

import math
from collections.abc import Iterator
from random import Random
from typing import Any

import numpy as np

from gelenk.contract.common import as_lists
from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.fields import BasisField, ChoiceField, MatrixField, NumberField, SetField, VectorField
from gelenk.exercises.table_field import COLUMNS, DhTableField


def sent(answer: Any) -> Any:
    """An answer as JSON has it."""
    found = as_lists(answer)
    return found.item() if isinstance(found, np.generic) else found


def same(one: AnswerField, right: Any, random: Random) -> Iterator[Any]:
    """The right answer in other forms."""
    if isinstance(one, BasisField):
        basis = np.asarray(right, float)
        mix = np.array([[random.uniform(-1, 1) for _ in basis.T] for _ in basis.T]) + 2 * np.eye(basis.shape[1])
        yield (basis @ mix).tolist()
    elif isinstance(one, DhTableField):
        yield from _tables(np.asarray(right, float), random)
    elif isinstance(one, NumberField | VectorField | MatrixField):
        yield from _numbers(one, right, random)
    elif isinstance(one, ChoiceField):
        yield f" {one.options[right]} "
    elif isinstance(one, SetField):
        items = [next(iter(same(one.item, item, random)), item) for item in right]
        yield random.sample(items, len(items))
        yield sent([*right, right[0]])


def _tables(rows: Any, random: Random) -> Iterator[Any]:
    """With the other sense of an x axis, whole turns, and origins elsewhere on parallel axes."""
    other, k = rows.copy(), random.randrange(len(rows) - 1)
    other[k] = other[k] * [-1, -1, 1, 1] + [0, 0, 0, math.pi]
    other[k + 1, 3] += math.pi
    yield other.tolist()
    other = rows + np.array([0, 2 * math.pi, 0, -4 * math.pi])
    for k, (_, alpha, _, _) in enumerate(rows[:-1]):
        if abs(math.remainder(alpha, 2 * math.pi)) < 1e-9:
            other[k : k + 2, 2] += [0.3, -0.3]
    yield {"convention": "standard", "joints": [dict(zip(COLUMNS, row, strict=True)) for row in other.tolist()]}


def _numbers(one: NumberField | VectorField | MatrixField, right: Any, random: Random) -> Iterator[Any]:
    numbers = np.asarray(right, float)
    allowed = one.tolerance * (np.abs(numbers).max() if one.is_relative else 1.0)
    signs = np.array([random.choice((-1, 1)) for _ in range(numbers.size)]).reshape(numbers.shape)
    turn = 2 * math.pi if one.unit == "rad" else 360.0
    turns = np.array([random.randint(-2, 2) for _ in range(numbers.size)]).reshape(numbers.shape)
    moved = numbers + signs * allowed / 3 + (turn * turns if one.is_angle else 0.0)
    yield moved.tolist()
    yield _with_commas(moved.tolist())
    yield np.round(numbers, math.ceil(-math.log10(allowed)) if allowed else 0).tolist()


def _with_commas(numbers: Any) -> Any:
    """Numbers as texts, as they stand in a German table."""
    return [_with_commas(one) for one in numbers] if isinstance(numbers, list) else f"{numbers:.15g}".replace(".", ",")
