"""Contacts of a whole robot in its scene, against Pinocchio and Coal; what the judge withholds."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from gelenk.collision.contact.judge import PairContacts, certify_clearances, certify_contacts
from gelenk.collision.contact.kernels import all_contacts, first_contacts, first_free, nearest_pairs, pair_distances
from gelenk.collision.contact.world import build_world
from gelenk.collision.robot_bodies import find_bodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.errors import CertificationFailed, InvalidField
from gelenk.robot.arrays import Array, Indices
from tests.collision.arms import arm, obstacles, world

WORLD = world()


def of_pairs(pairs: Indices, distances: Array, points: Array) -> Callable[[int], PairContacts]:
    """One pair at each configuration, as the judge takes it."""
    return lambda row: (pairs[row : row + 1], distances[row : row + 1], points[row : row + 1])


NOTHING = of_pairs(*(np.zeros(shape, dtype=int) for shape in [(0,), (0,), (0, 6)]))
QS = np.random.default_rng(0).uniform(-3.0, 3.0, (32, 4))


@pytest.mark.parametrize("others", [{}, {"jf": 0.06}])
def test_contacts_and_clearances_are_as_coal_says(others: dict[str, float]) -> None:
    here = world(others)
    found, (slacks, pairs, points) = first_contacts(here.flat, QS), nearest_pairs(here.flat, QS)
    assert 4 < (found >= 0).sum() < 28
    assert ((found >= 0) == (slacks <= 0.0)).all()
    for first in range(0, len(QS), 16):
        part = slice(first, first + 16)
        assert certify_contacts(here, QS[part], found[part] >= 0, NOTHING).samples == 16
        distances = slacks[part] + here.flat.margins[pairs[part]]
        certify_clearances(here, QS[part], slacks[part], of_pairs(pairs[part], distances, points[part]))


@pytest.mark.parametrize("sizes", [[], [0], [40], [3, 0, 17], [1] * 20, [5, 0, 1, 2] * 8, [9] * 12])
def test_of_each_group_the_first_free_configuration_is_found(sizes: list[int]) -> None:
    rng, count = np.random.default_rng(len(sizes)), sum(sizes)
    qs = QS[rng.integers(len(QS), size=count + 5)]
    order, firsts = rng.permutation(len(qs))[:count], np.concatenate(([0], np.cumsum(sizes))).astype(np.int64)
    is_free = first_contacts(WORLD.flat, qs) < 0
    if sizes == [40]:
        # Of a group alone, all lanes take the last configuration but a few.
        qs[order[:-2]], is_free[order] = qs[~is_free][0], np.append(np.zeros(38, dtype=bool), is_free[order[-2:]])
    found = first_free(WORLD.flat, qs, order, firsts)
    free = [[row for row in order[a:b] if is_free[row]] for a, b in pairwise(firsts)]
    assert found.tolist() == [rows[0] if rows else -1 for rows in free]


def test_the_nearest_pair_is_the_nearest_of_all() -> None:
    slacks, pairs, points = nearest_pairs(WORLD.flat, QS)
    every = np.array([pair_distances(WORLD.flat, QS, np.full(len(QS), k))[0] for k in range(len(WORLD.flat.pairs))])
    np.testing.assert_allclose(slacks, (every - WORLD.flat.margins[:, None]).min(axis=0), atol=1e-9)
    distances, at = pair_distances(WORLD.flat, QS, pairs)
    np.testing.assert_allclose(distances, slacks + WORLD.flat.margins[pairs], atol=1e-9)
    np.testing.assert_allclose(at, points, atol=1e-6)


def test_all_contacts_are_those_within_their_margins() -> None:
    for q in QS[:8]:
        distances, _ = all_contacts(WORLD.flat, q)
        every = [pair_distances(WORLD.flat, q[None], np.array([k]))[0][0] for k in range(len(WORLD.flat.pairs))]
        np.testing.assert_array_equal(np.isfinite(distances), every <= WORLD.flat.margins)


def test_what_the_chain_does_not_move_is_no_pair() -> None:
    named = {frozenset(WORLD.names[i] for i in pair) for pair in WORLD.flat.pairs}
    assert frozenset(("l0", "floor")) not in named
    assert frozenset(("left", "right")) not in named
    assert frozenset(("l4", "rod")) not in named
    assert {frozenset(("l2", "floor")), frozenset(("rod", "box")), frozenset(("l0", "rod"))} <= named


def test_a_wrong_verdict_is_withheld() -> None:
    touching = first_contacts(WORLD.flat, QS[:8]) >= 0
    with pytest.raises(CertificationFailed, match="a contact"):
        certify_contacts(WORLD, QS[:8], ~touching, NOTHING)


@pytest.mark.parametrize("is_contact", [True, False])
def test_a_wrong_distance_is_withheld(is_contact: bool) -> None:
    slacks, pairs, points = nearest_pairs(WORLD.flat, QS)
    rows = np.flatnonzero((slacks < -0.01) if is_contact else (slacks > 0.01))[:4]
    less = points[rows].copy()
    less[:, :3] += 0.01 * (less[:, 3:] - less[:, :3])
    with pytest.raises(CertificationFailed, match="a distance"):
        certify_clearances(WORLD, QS[rows], slacks[rows] * 1.001, of_pairs(pairs[rows], slacks[rows], less))


@pytest.mark.parametrize("at_fault", ["depth", "direction"])
def test_a_wrong_contact_is_withheld_where_no_clearance_is_asked_for(at_fault: str) -> None:
    pairs = first_contacts(WORLD.flat, QS)
    distances, points = pair_distances(WORLD.flat, QS, pairs)
    rows = np.flatnonzero((pairs >= 0) & (distances < -0.01))[:4]
    told, wrong = distances[rows], points[rows].copy()
    if at_fault == "depth":
        told = told * 1.01
    else:
        wrong[:, 3:] = wrong[:, :3] + 0.01 * (wrong[:, 3:] - wrong[:, :3])
        told = -np.linalg.norm(wrong[:, :3] - wrong[:, 3:], axis=1)
    certify_contacts(WORLD, QS[rows], pairs[rows] >= 0, of_pairs(pairs[rows], distances[rows], points[rows]))
    with pytest.raises(CertificationFailed, match="a distance"):
        certify_contacts(WORLD, QS[rows], pairs[rows] >= 0, of_pairs(pairs[rows], told, wrong))


def test_a_configuration_that_only_touches_is_not_withheld() -> None:
    robot = arm()
    own, T = find_bodies(robot.description, lambda _: None), np.eye(4)
    # The last link's ball ends at 1.25 m + 0.08 m.
    T[2, 3] = 0.1 + 0.4 + 0.4 + 0.3 + 0.05 + 0.08 + 0.5
    top = Obstacle("lid", (covered_body("lid", "l0", "sphere", (0.5,), T),), touch_links=frozenset({"left", "right"}))
    here = build_world(robot, robot.chain(None, None), own, (top,))
    q = np.zeros((1, 4))
    for verdict in (True, False):
        certify_contacts(here, q, np.array([verdict]), NOTHING)


def test_a_scene_of_unknown_frames_is_refused() -> None:
    robot = arm()
    own, box = find_bodies(robot.description, lambda _: None), obstacles()[1].bodies
    for bad, field in (
        (Obstacle("box", box, "hand"), "scene/objects/0/attached_to"),
        (Obstacle("box", box, None, frozenset({"hand"})), "scene/objects/0/touch_links"),
        (Obstacle("l2", box), "scene/objects/0/name"),
    ):
        with pytest.raises(InvalidField) as caught:
            build_world(robot, robot.chain(None, None), own, (bad,))
        assert caught.value.field == field
