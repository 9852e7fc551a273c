"""Gradients of distances, against differences of Coal's at Pinocchio's poses, and the soft minimum against scipy's."""

import numpy as np
import pytest
from scipy.special import logsumexp

from gelenk.collision.cell import cell_in
from gelenk.collision.contact.gradient import pair_gradients, soft_clearances
from gelenk.collision.contact.judge import ContactJudge, certify_gradients
from gelenk.collision.contact.kernels import nearest_pairs, pair_distances
from gelenk.errors import CertificationFailed
from tests.collision.arms import world

WORLD = world()
QS = np.random.default_rng(0).uniform(-3.0, 3.0, (32, 4))


def test_gradients_are_differences_of_coals_distances() -> None:
    judge, step = ContactJudge(WORLD), 1e-5
    _, pairs, _ = nearest_pairs(WORLD.flat, QS)
    for q, k, gradient in zip(QS, pairs, pair_gradients(WORLD.flat, QS, pairs), strict=True):
        ends = [
            [judge.distance(judge.poses(q + s * d), int(k), is_signed=True) for s in (step, -step)] for d in np.eye(4)
        ]
        np.testing.assert_allclose(gradient, np.array(ends) @ [0.5, -0.5] / step, atol=2e-4)


def test_a_wrong_gradient_is_withheld() -> None:
    cell, qs = cell_in(WORLD), QS[:8]
    nearest = cell.nearest(qs)
    gradients = cell.gradients(qs, nearest)
    assert 0 < (nearest.distances < 0.0).sum() < 8
    assert cell.certified_gradients(qs, nearest, gradients).max_gradient_error < 1e-4
    for row in range(8):
        wrong = gradients[row].copy()
        wrong[np.abs(wrong).argmax()] *= -1.0
        one = cell.nearest(qs[row : row + 1])
        with pytest.raises(CertificationFailed, match="the gradient"):
            certify_gradients(WORLD, qs[row : row + 1], one.contact, wrong[None])


def test_the_soft_minimum_is_that_of_all_pairs_and_has_its_gradient() -> None:
    width, step = 0.01, 1e-6
    values, gradients = soft_clearances(WORLD.flat, QS, width)
    every = [pair_distances(WORLD.flat, QS, np.full(len(QS), k))[0] for k in range(len(WORLD.flat.pairs))]
    slacks = np.array(every) - WORLD.flat.margins[:, None]
    np.testing.assert_allclose(values, -width * logsumexp(-slacks / width, axis=0), atol=1e-8)
    for j, d in enumerate(np.eye(4)):
        ends = [soft_clearances(WORLD.flat, QS + s * d, width)[0] for s in (step, -step)]
        np.testing.assert_allclose(gradients[:, j], (ends[0] - ends[1]) / (2.0 * step), atol=1e-4)
