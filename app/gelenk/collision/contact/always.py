"""Links that are in contact at every configuration: their pieces overlap, and a contact there says nothing.

Pairs never in contact at the samples stay active: rare contacts may lie between samples, and far pieces cost little.
"""

from dataclasses import replace

import numpy as np

from gelenk.collision.contact.kernels import always_in_contact
from gelenk.collision.contact.nodes import Nodes, without_free_joints
from gelenk.collision.contact.world import flat_world
from gelenk.collision.pairs import SAMPLES
from gelenk.collision.robot_bodies import RobotBodies
from gelenk.robot.arrays import Array
from gelenk.robot.description import Description, Joint

_REACH = 2.0 * np.pi
"""How far from the allowed position nearest zero a joint is moved where its limits are wider, [rad or m]."""


def without_lasting_contacts(description: Description, own: RobotBodies) -> RobotBodies:
    """Leave out pairs of links that are in contact at each of `SAMPLES` random configurations of all joints."""
    active = [(pair.a, pair.b) for pair in own.pairs if pair.active]
    names = [body.link for body in own.bodies]
    nodes = Nodes(without_free_joints(description), [joint.name for joint in description.movable], {})
    world = flat_world(nodes, own.bodies, names, ((a, b, 0.0) for a, b in active))
    numbers = {pair: i for i, pair in enumerate(active)}
    groups = np.array([numbers[names[i], names[j]] for i, j in world.pairs], dtype=np.int64)
    always = always_in_contact(world, _configurations(description.movable), groups, len(active))
    lasting = {pair for pair, is_lasting in zip(active, always, strict=True) if is_lasting}
    pairs = (
        replace(pair, active=False, reason="always") if (pair.a, pair.b) in lasting else pair for pair in own.pairs
    )
    return replace(own, pairs=tuple(pairs))


def _configurations(joints: tuple[Joint, ...]) -> Array:
    """Draw configurations within limits, always the same ones; shape (SAMPLES, number of joints), [rad or m]."""
    limits = [(joint.limits.lower, joint.limits.upper) for joint in joints]
    lower = np.array([-np.inf if lower is None else lower for lower, _ in limits], dtype=float)
    upper = np.array([np.inf if upper is None else upper for _, upper in limits], dtype=float)
    near = np.clip(0.0, lower, upper)
    lower, upper = np.maximum(lower, near - _REACH), np.minimum(upper, near + _REACH)
    return np.asarray(lower + np.random.default_rng(0).random((SAMPLES, len(joints))) * (upper - lower))
