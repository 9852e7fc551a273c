"""Answers in the one form that systems compare number by number: the same for all forms of an answer."""

from random import Random

import numpy as np
import pytest

from gelenk.exercises.exercise import exercise
from gelenk.exercises.fields import basis
from gelenk.sheets.normal_form import allowed, form_note, has_normal_form, normal_form
from tests.exercises.forms import same, sent


@pytest.mark.parametrize(
    "name", ["dh_tables.arm", "dh_tables.conventions", "statics.subspaces", "velocities.redundant"]
)
def test_all_forms_of_an_answer_have_the_same_normal_form(name: str) -> None:
    for seed in range(10):
        variant = exercise(name).variant(seed)
        for one in variant.fields:
            if one.kind not in ("basis", "dh_table"):
                continue
            right = variant.answers[one.name]
            found = normal_form(one, right)
            assert one.distance(found, right) < 1e-6
            assert normal_form(one, found) == pytest.approx(found, abs=1e-12)
            for form in same(one, sent(right), Random(seed)):
                other = normal_form(one, one.read(form)) - found
                if one.kind == "dh_table":
                    other[:, [1, 3]] = 2.0 * np.sin(0.5 * other[:, [1, 3]])
                assert np.abs(other).max() < 1e-9, form


def test_a_direction_is_a_unit_vector_whose_first_number_is_positive() -> None:
    one = basis("x", "x", (3, 1))
    assert normal_form(one, [[0.0], [-3.0], [4.0]]) == pytest.approx(np.array([[0.0], [0.6], [-0.8]]))
    assert allowed(one, None) == one.tolerance
    assert form_note(one).startswith("Scaled to length 1")
    assert has_normal_form(one)
    assert not has_normal_form(basis("x", "x", (3, 2)))


def test_a_table_has_one_choice_of_axes() -> None:
    (one,) = exercise("dh_tables.conventions").variant(0).fields
    rows = [[-0.3, 0.0, 0.2, 0.0], [0.0, -np.pi / 2, 0.4, 0.0], [0.1, 0.0, 0.0, 0.0]]
    expected = [[0.3, 0.0, 0.0, np.pi], [0.0, np.pi / 2, 0.6, 0.0], [0.1, 0.0, 0.0, np.pi]]
    turned = np.abs(normal_form(one, rows) - expected)
    assert np.minimum(turned, np.abs(turned - 2 * np.pi)).max() < 1e-12
