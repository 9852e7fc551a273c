"""Answers that may be given in many forms, in the one that is asked for where a system compares number by number."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from gelenk.exercises.answer_field import AnswerField
from gelenk.exercises.fields import TURNS, BasisField, NumberArray, SetField
from gelenk.exercises.table_field import DhTableField
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_NONE = 1e-9
"""Size up to which a length or the sine of an angle is rounding, not a number."""


def has_normal_form(one: AnswerField) -> bool:
    """Check whether numbers can be compared one by one: not those of a basis of several vectors."""
    return not isinstance(one, BasisField) or one.columns == 1


def form_note(one: AnswerField) -> str:
    """Return what to say about the form of an answer; "" if there is only one."""
    if isinstance(one, SetField):
        return _("In ascending order of the first number, each angle between half a turn backwards and forwards.")
    if isinstance(one, BasisField):
        return _("Scaled to length 1, its first number that is not 0 positive.")
    if isinstance(one, DhTableField):
        return _(
            "A row a, α, d, ϑ for each joint. Between two joints x points from the axis of the first to that of the "
            "second, so that a is positive; where these meet, α is between 0 and π; where they are parallel, d is 0 in "
            "the row of the first."
        )
    return ""


def normal_form(one: AnswerField, right: Any) -> Any:
    """Return an answer of numbers in its normal form, as an array, or as the rows of a set."""
    if isinstance(one, SetField):
        return _in_order(one, right)
    if isinstance(one, BasisField):
        return _unit_vector(np.asarray(right, float), one.tolerance)
    return _unique_table(right) if isinstance(one, DhTableField) else np.asarray(right, float)


def turns_of(one: AnswerField, shape: tuple[int, ...]) -> Array:
    """Return for each number of an answer the turn by which it may differ, 0 if by none."""
    item = one.item if isinstance(one, SetField) else one
    if isinstance(one, DhTableField):
        return np.broadcast_to([0.0, TURNS["rad"], 0.0, TURNS["rad"]], shape)
    return np.full(shape, TURNS[item.unit] if isinstance(item, NumberArray) and item.is_angle else 0.0)


def allowed(one: AnswerField, right: Any) -> float:
    """Return how far each number of an answer may be from the right one."""
    if isinstance(one, SetField):
        return min(one.item.allowed(row) for row in right)
    return one.allowed(right) if isinstance(one, NumberArray) else one.tolerance


def _in_order(one: SetField, right: Sequence[Any]) -> list[Array]:
    turn = TURNS[one.item.unit] if one.item.is_angle else math.inf
    rows = [np.atleast_1d(np.asarray(row, float)) for row in right]
    if one.item.is_angle:
        rows = [row - turn * np.round(row / turn) for row in rows]
    return sorted(rows, key=lambda row: [round(number, 6) for number in row.tolist()])


def _unit_vector(column: Array, tolerance: float) -> Array:
    unit = np.asarray(column / np.linalg.norm(column))
    first = unit[np.argmax(np.abs(unit) > tolerance)]
    return np.asarray(unit * np.sign(first))


def _unique_table(right: Any) -> Array:
    """Return the rows whose x axes and origins, up to the last but one, are chosen as `form_note` says."""
    rows = np.array(right, float)
    for row, following in pairwise(rows):
        a, alpha, d, _theta = row
        if a < -_NONE or (abs(a) <= _NONE and math.sin(alpha) < -_NONE):
            row[:] = -a, -alpha, d, row[3] + math.pi
            following[3] += math.pi
        if abs(math.sin(alpha)) <= _NONE:
            row[2], following[2] = 0.0, following[2] + math.copysign(d, d * math.cos(alpha))
    rows[:, [1, 3]] -= 2.0 * math.pi * np.round(rows[:, [1, 3]] / (2.0 * math.pi))
    return rows
