"""The way up a ladder against Dijkstra's algorithm on the whole graph."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from gelenk.robot.arrays import Array
from gelenk.trajectory.follow.ladder import Metric, Rungs, way_up


def _ladder(seed: int, turning: bool = False) -> tuple[Rungs, Metric, Array]:
    rng = np.random.default_rng(seed)
    counts = rng.integers(3, 30, 9)
    firsts = np.concatenate(([0], np.cumsum(counts)))
    metric = Metric(rng.uniform(0.5, 2.0, 4), rng.uniform(1.2, 3.5, 4), np.array([turning, False, turning, False]))
    return Rungs(rng.uniform(-4.0, 4.0, (firsts[-1], 4)), firsts), metric, rng.uniform(0.1, 1.0, counts[0])


def _by_dijkstra(rungs: Rungs, metric: Metric, first_costs: Array) -> Array:
    """The least cost to each configuration; every distance on the graph is shifted by nothing, and starts at a node."""
    (qs, firsts), size = rungs, len(rungs.qs)
    graph = np.zeros((size + 1, size + 1))
    graph[size, : firsts[1]] = first_costs
    for i in range(len(firsts) - 2):
        for a in range(firsts[i], firsts[i + 1]):
            for b in range(firsts[i + 1], firsts[i + 2]):
                step = np.where(metric.turning, np.angle(np.exp(1j * (qs[b] - qs[a]))), qs[b] - qs[a])
                if (np.abs(step) <= metric.longest).all():
                    graph[a, b] = np.linalg.norm(metric.weights * step)
    return np.asarray(dijkstra(csr_array(graph), indices=size)[:size])


@pytest.mark.parametrize("turning", [False, True])
@pytest.mark.parametrize("seed", range(6))
def test_the_way_costs_what_dijkstra_finds_and_goes_as_far(seed: int, turning: bool) -> None:
    rungs, metric, first_costs = _ladder(seed, turning)
    rows, cost = way_up(rungs, metric, first_costs)
    owners = np.repeat(np.arange(len(rungs.firsts) - 1), np.diff(rungs.firsts))
    costs = _by_dijkstra(rungs, metric, first_costs)
    highest = owners[np.isfinite(costs)].max()
    assert (owners[rows] == np.arange(highest + 1)).all()
    assert cost == pytest.approx(costs[owners == highest].min(), rel=1e-12)
    steps = np.diff(rungs.qs[rows], axis=0)
    steps = np.where(metric.turning, np.angle(np.exp(1j * steps)), steps)
    assert cost == pytest.approx(first_costs[rows[0]] + np.linalg.norm(metric.weights * steps, axis=1).sum(), rel=1e-12)
    assert (np.abs(steps) <= metric.longest).all()


def test_there_is_no_way_where_none_may_begin() -> None:
    rungs, metric, first_costs = _ladder(0)
    rows, _ = way_up(rungs, metric, np.full_like(first_costs, np.inf))
    assert len(rows) == 0
