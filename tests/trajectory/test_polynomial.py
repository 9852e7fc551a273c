"""Pieces of polynomials against SciPy's."""

import numpy as np
import pytest
from scipy.interpolate import PPoly

from gelenk.trajectory.motion.extremes import largest_ratio
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial, joined


def some(pieces: int, degree: int, n: int, seed: int) -> PiecewisePolynomial:
    rng = np.random.default_rng(seed)
    return PiecewisePolynomial(np.cumsum(rng.uniform(0.1, 1.0, pieces + 1)), rng.normal(size=(pieces, degree + 1, n)))


def by_scipy(motion: PiecewisePolynomial) -> PPoly:
    return PPoly(motion.coefficients[:, ::-1].swapaxes(0, 1), motion.breaks)


@pytest.mark.parametrize("order", [0, 1, 2, 3, 4, 5])
@pytest.mark.parametrize(("pieces", "degree", "n"), [(1, 0, 1), (3, 3, 2), (5, 7, 6)])
def test_values_and_derivatives(pieces: int, degree: int, n: int, order: int) -> None:
    motion = some(pieces, degree, n, 0)
    times = np.concatenate((motion.breaks, np.linspace(motion.breaks[0] - 0.1, motion.breaks[-1] + 0.1, 50)))
    values = (motion.derivative(order) if order else motion).at(times)
    np.testing.assert_allclose(values, by_scipy(motion)(times, nu=order), rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize(("pieces", "degree", "n"), [(1, 0, 1), (1, 1, 2), (4, 2, 3), (5, 7, 6)])
def test_values_with_two_derivatives_at_once(pieces: int, degree: int, n: int) -> None:
    motion = some(pieces, degree, n, 4)
    times = np.concatenate((motion.breaks, np.linspace(motion.breaks[0] - 0.1, motion.breaks[-1] + 0.1, 50)))
    for order, values in enumerate(motion.rates_at(times)):
        assert values.shape == (len(times), n)
        np.testing.assert_allclose(values, by_scipy(motion)(times, nu=order), rtol=1e-12, atol=1e-10)


def test_values_do_not_depend_on_the_order_of_the_times() -> None:
    motion = some(7, 3, 2, 5)
    times = np.sort(np.concatenate((motion.breaks, np.linspace(motion.breaks[0] - 0.1, motion.breaks[-1] + 0.1, 50))))
    for each in (times, times[::-1], np.random.default_rng(0).permutation(times)):
        np.testing.assert_allclose(motion.at(each), by_scipy(motion)(each), rtol=1e-12, atol=1e-10)


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize(("pieces", "degree", "n"), [(1, 0, 1), (1, 1, 2), (4, 2, 3), (5, 7, 6), (9, 10, 2)])
def test_the_largest_ratio_by_brute_force(pieces: int, degree: int, n: int, order: int) -> None:
    motion, limits = some(pieces, degree, n, 5), np.random.default_rng(6).uniform(0.5, 2.0, (pieces, n))
    inside = np.linspace(1e-9, 1.0 - 1e-9, 3001)
    times = (motion.breaks[:-1, None] + inside * np.diff(motion.breaks)[:, None]).ravel()
    rates = np.abs(by_scipy(motion)(times, nu=order)).reshape(pieces, -1, n)
    for one in (limits[0], limits):
        ratios = (rates / np.broadcast_to(one, (pieces, n))[:, None]).max(axis=(0, 1))
        largest, coordinate = largest_ratio(motion, order, one)
        assert largest == pytest.approx(ratios.max(), rel=1e-4)
        assert coordinate == ratios.argmax()


def test_scaling_in_time_scales_the_derivatives() -> None:
    motion, factor = some(4, 5, 3, 1), 2.5
    slow, times = motion.scaled(factor), np.linspace(0.0, 1.0, 9)
    start = motion.breaks[0]
    assert slow.duration == pytest.approx(factor * motion.duration)
    for order in range(4):
        fast = motion.derivative(order).at(start + times * motion.duration)
        np.testing.assert_allclose(
            slow.derivative(order).at(start + times * slow.duration), fast / factor**order, rtol=1e-9
        )


def test_motions_are_joined_end_to_start() -> None:
    first, second = some(2, 3, 2, 2), some(3, 5, 2, 3)
    both = joined([first, second])
    assert both.duration == pytest.approx(first.duration + second.duration)
    local = np.linspace(0.0, second.duration, 7)
    np.testing.assert_allclose(
        both.at(both.breaks[0] + first.duration + local), second.at(second.breaks[0] + local), rtol=1e-9
    )
