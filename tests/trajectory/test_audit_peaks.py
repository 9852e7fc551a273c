"""Peaks between samples, of functions whose peaks are known."""

import numpy as np
import pytest

from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.peaks import MOST, highest, promising

ROUNDING = np.full(1, 1e-13)


def smooth(x: Array) -> Array:
    """1 at 0.3, where it is neither even nor a parabola."""
    return np.asarray(np.exp(-np.square(np.expm1(x - 0.3))))


def kinked(x: Array) -> Array:
    return np.asarray(1.0 - np.abs(x - 0.3) * (1.0 + 0.5 * (x > 0.3)))


@pytest.mark.parametrize("width", [1e-3, 0.1, 1.0])
@pytest.mark.parametrize("at", [0.02, 0.31, 0.5, 0.97])
def test_a_smooth_peak_is_found_to_the_last_digits_in_few_rounds(at: float, width: float) -> None:
    calls = []

    def values_at(x: Array) -> Array:
        calls.append(x)
        return smooth(x)

    places = 0.3 + width * (np.array([[0.0, 0.5, 1.0]]) - at)
    best, where = highest(values_at, places, smooth(places), ROUNDING)
    assert best[0] == pytest.approx(1.0, abs=1e-13)
    assert where[0] == pytest.approx(0.3, abs=1e-6)
    assert smooth(where)[0] == best[0]
    assert len(calls) <= 4


@pytest.mark.parametrize("at", [0.02, 0.31, 0.5, 0.97])
def test_a_kink_is_found_by_what_is_spread_evenly(at: float) -> None:
    places = 0.3 + 1e-2 * (np.array([[0.0, 0.5, 1.0]]) - at)
    best, where = highest(kinked, places, kinked(places), ROUNDING)
    assert best[0] == pytest.approx(1.0, abs=1e-6)
    assert kinked(where)[0] == best[0]


def test_of_samples_those_count_between_which_it_gets_higher() -> None:
    x = np.linspace(0.0, 1.0, 41)
    values = np.column_stack((np.sin(40.0 * x) + x, -x, np.full(41, 0.5)))
    rows, columns, tops, _ = promising(x, values, np.arange(1, 40), np.full(3, 1e-12))
    assert set(columns) == {0}
    assert tops.tolist() == values.argmax(axis=0).tolist()
    fine = np.linspace(0.0, 1.0, 100_001)
    peak = fine[np.argmax(np.sin(40.0 * fine) + fine)]
    assert np.abs(x[rows] - peak).min() <= 0.025


def test_there_are_never_too_many() -> None:
    x = np.arange(4001.0)
    values = np.cos(np.pi * (x - 0.3))[:, None] * [1.0, 1.0]
    rows, columns, *_ = promising(x, values, np.arange(1, 4000), np.zeros(2))
    assert np.bincount(columns).tolist() == [MOST, MOST]
    assert len(rows) == 2 * MOST


def test_what_is_no_number_is_no_peak() -> None:
    x, values = np.arange(5.0), np.array([[0.0], [1.0], [np.inf], [1.0], [0.0]])
    assert len(promising(x, values, np.arange(1, 4), np.zeros(1))[0]) == 0
