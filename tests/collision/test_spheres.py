"""Verdicts by spheres: they may see a contact where there is none, and never miss one."""

import numpy as np

from gelenk.collision.contact.kernels import all_contacts, first_contacts
from gelenk.collision.contact.world import World, build_world
from gelenk.collision.robot_bodies import find_bodies
from gelenk.collision.scene import Obstacle
from gelenk.collision.shapes.covers import covered_body
from gelenk.robot.arrays import Array
from tests.collision.arms import arm, obstacles

RNG = np.random.default_rng(3)
QS = RNG.uniform(-3.0, 3.0, (99, 4))


def world_of_many_pieces() -> World:
    """Return an arm among objects, one of twenty balls and one that moves."""
    robot, pile = arm(), []
    for i in range(20):
        T = np.eye(4)
        T[:3, 3] = RNG.uniform((-0.5, -0.5, 0.4), (0.0, 0.0, 1.0))
        pile.append(covered_body(f"pile {i}", "l0", "sphere", (0.05,), T))
    own = find_bodies(robot.description, lambda _: None)
    return build_world(robot, robot.chain(None, None), own, (*obstacles(), Obstacle("pile", tuple(pile))))


WORLD = world_of_many_pieces()


def in_contact(q: Array) -> set[int]:
    """Return the pairs in contact, looked for one by one."""
    return set(np.flatnonzero(np.isfinite(all_contacts(WORLD.flat, q)[0])).tolist())


def test_the_found_pair_is_one_in_contact_and_none_is_found_where_none_is() -> None:
    found, every = first_contacts(WORLD.flat, QS), [in_contact(q) for q in QS]
    assert all(pair in some if some else pair == -1 for pair, some in zip(found.tolist(), every, strict=True))
    assert 5 < sum(map(bool, every)) < 94
    piles = [pair for pair in set.union(*every) if "pile" in {WORLD.names[i] for i in WORLD.flat.pairs[pair]}]
    assert len(piles) > 4


def test_spheres_miss_no_contact_and_let_most_free_ones_pass() -> None:
    touching, near = (first_contacts(WORLD.flat, QS, is_exact=exact) >= 0 for exact in (True, False))
    assert not (touching & ~near).any()
    assert (~near).sum() > 0.7 * (~touching).sum()


def test_a_verdict_is_the_same_alone_and_among_others() -> None:
    alone = [first_contacts(WORLD.flat, q[None])[0] for q in QS]
    np.testing.assert_array_equal(first_contacts(WORLD.flat, QS), alone)
    assert first_contacts(WORLD.flat, QS[:0]).shape == (0,)
