"""Contacts of a robot with itself and a scene."""

from typing import Any

import numpy as np

from gelenk.collision.contact.judge import PairContacts, certify_clearances, certify_contacts
from gelenk.collision.contact.kernels import all_contacts, first_contacts, nearest_pairs, pair_distances
from gelenk.collision.contact.world import World
from gelenk.contract.collisions import CollisionRequest
from gelenk.operations.cells import bodies_in
from gelenk.operations.chains import check_numbers, head
from gelenk.operations.outcome import Limits, Outcome
from gelenk.robot.arrays import Array
from gelenk.robot.configuration import configurations
from gelenk.store.records import LoadedRobot

_NUMBERS = 9
"""Numbers of a result with one pair."""


def run(loaded: LoadedRobot, call: CollisionRequest, limits: Limits) -> Outcome:
    """Find contacts, and the nearest pair, at each configuration."""
    chain = loaded.robot.chain(call.base_frame, call.tip_frame)
    qs = configurations(chain, call.joint_positions)
    check_numbers(len(qs) * _NUMBERS, limits)
    bodies = bodies_in(loaded, call)
    world = bodies.world(loaded.robot, chain)
    if call.clearance:
        slacks, pairs, points = nearest_pairs(world.flat, qs)
        touching, distances = slacks <= 0.0, slacks + np.append(world.flat.margins, 0.0)[pairs]
    else:
        pairs = first_contacts(world.flat, qs)
        touching, slacks = pairs >= 0, np.full(len(qs), np.nan)
        shown = pairs if call.pairs == "first" else np.full_like(pairs, -1)
        distances, points = pair_distances(world.flat, qs, shown)

    def contacts(row: int) -> PairContacts:
        if call.pairs == "all":
            return _every_pair(world, qs[row])
        end = row + int(pairs[row] >= 0)
        return pairs[row:end], distances[row:end], points[row:end]

    if call.clearance:
        certificate = certify_clearances(world, qs, slacks, contacts)
    else:
        certificate = certify_contacts(world, qs, touching, contacts)

    def content() -> dict[str, Any]:
        results: list[dict[str, Any]] = [{"in_collision": one} for one in touching.tolist()]
        if call.clearance:
            for result, slack in zip(results, slacks.tolist(), strict=True):
                result["clearance"] = slack if slack < np.inf else None
        if call.pairs != "none":
            count = 0
            for row, result in enumerate(results):
                result["pairs"] = _by_name(world, contacts(row))
                count += len(result["pairs"])
                check_numbers(count * _NUMBERS, limits)
        about = {"root_frame": loaded.robot.description.root, "warnings": bodies.warnings, "certificate": certificate}
        return head(chain) | about | {"results": results}

    return Outcome(content, lambda: (np.column_stack((touching, slacks)), {}))


def is_heavy(_: CollisionRequest) -> bool:
    """Return True: the first call about a robot or a scene prepares it, which takes long."""
    return True


def _every_pair(world: World, q: Array) -> PairContacts:
    """Return the contacts at a configuration, the deepest first."""
    distances, points = all_contacts(world.flat, q)
    pairs = np.argsort(distances)[: np.isfinite(distances).sum()]
    return pairs, distances[pairs], points[pairs]


def _by_name(world: World, contacts: PairContacts) -> list[dict[str, Any]]:
    """Return pairs as they are sent, of several pieces of the same two only the first."""
    pairs: dict[tuple[str, str], dict[str, Any]] = {}
    for k, distance, row in zip(*contacts, strict=True):
        pair = _pair(world, int(k), float(distance), row)
        pairs.setdefault((pair["a"], pair["b"]), pair)
    return list(pairs.values())


def _pair(world: World, k: int, distance: float, points: Array) -> dict[str, Any]:
    a, b = (world.names[i] for i in world.flat.pairs[k])
    return {"a": a, "b": b, "distance": distance, "point_a": points[:3].tolist(), "point_b": points[3:].tolist()}
