"""The lines that bound u on an interval are the innermost of all rows that SciPy makes, and the largest x an LP's."""

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.interpolate import BPoly, PPoly
from scipy.optimize import linprog

from gelenk.robot.arrays import Array
from gelenk.trajectory.timing.reachability import Further, stages


def bernstein(polynomial: Polynomial, degree: int) -> Array:
    """Bernstein coefficients on [0, 1]; shape (degree + 1,)."""
    c = np.append(polynomial.coef, np.zeros(degree + 1 - len(polynomial.coef)))
    found: Array = BPoly.from_power_basis(PPoly(c[::-1, None], np.array([0.0, 1.0]))).c[:, 0]
    return found


def rows(c: Array, length: float, velocity: float, acceleration: float) -> Array:
    """Rows (α, β) of one joint in one interval: its acceleration's on both sides, and its speed's; shape (m, 2)."""
    d, first = len(c) - 1, Polynomial(c * length ** np.arange(len(c))).deriv() / length
    second, gain = first.deriv() / length, Polynomial([0.0, 2.0 * length])
    along = [bernstein(one / acceleration, d - 1) for one in (first + gain * second, second)]
    squares = [bernstein(one / velocity**2, 2 * d - 1) for one in (gain * first * first, first * first)]
    return np.hstack((along, np.negative(along), squares)).T


@pytest.mark.parametrize(("second", "factor"), [(1, 1.0), (1, 0.1), (0, 9.0), (2, 9.0)])
@pytest.mark.parametrize("degree", [1, 3, 5])
def test_lines_and_largest_speeds_are_those_of_all_rows(degree: int, second: int, factor: float) -> None:
    """One joint may be slow everywhere, so that its speed does not count, or slow at the start or the end alone."""
    rng = np.random.default_rng(degree)
    count, n = 11, 3  # More than one block of eight, and an incomplete one.
    pieces, lengths = rng.normal(size=(count, degree + 1, n)), rng.uniform(0.1, 0.7, count)
    limits, squares, shares = rng.uniform(1.0, 3.0, (2, n)), rng.uniform(1.0, 4.0, count), rng.uniform(0.0, 0.5, count)
    more = rng.normal(size=(2, count, 2))
    pieces[:, :, 1] *= factor
    if second != 1 and degree > 1:
        pieces[:, 3:, 1], pieces[:, 1, 1] = 0.0, pieces[:, 2, 1] * -lengths * second
    found = stages(pieces, lengths, limits, Further(more[0], more[1], squares, shares))
    for i, length in enumerate(lengths):
        own = [rows(pieces[i, :, j], length, *limits[:, j]) for j in range(n)]
        every = np.vstack((*own, more[:, i].T)) * squares[i]
        braking = 0.5 * (shares[i] - 1.0) / length
        constraints = np.vstack((every, [-1.0, braking])), np.append(np.ones(len(every)), 0.0)
        most = linprog([0.0, -1.0], *constraints, bounds=(None, None)).x[1]
        assert found.highest[i] == pytest.approx(most, rel=1e-9)
        x, (alpha, beta) = np.linspace(0.0, most, 50)[:, None], every[every[:, 0] != 0.0].T
        u = (1.0 - beta * x) / alpha
        at_most, at_least = np.where(alpha > 0.0, u, np.inf).min(axis=1), np.where(alpha < 0.0, u, -np.inf).max(axis=1)
        above, below = (found.lines[side, i, : found.counts[side, i]].T for side in (0, 1))
        np.testing.assert_allclose((above[0] + above[1] * x).min(axis=1), at_most, rtol=1e-9, atol=1e-9)
        at_least = np.maximum(at_least, braking * x[:, 0])
        np.testing.assert_allclose((below[0] + below[1] * x).max(axis=1), at_least, rtol=1e-9, atol=1e-9)
