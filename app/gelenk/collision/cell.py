"""A robot in its surroundings, and how near it may come to them and to itself."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from gelenk.collision.contact.gradient import pair_gradients
from gelenk.collision.contact.judge import PairContacts, certify_clearances, certify_contacts, certify_gradients
from gelenk.collision.contact.kernels import first_contacts, first_free, nearest_pairs, pair_distances
from gelenk.collision.contact.words import ContactCertificate, GradientCertificate
from gelenk.collision.contact.world import World
from gelenk.errors import quoted
from gelenk.robot.arrays import Array, Flags, Indices


class Nearest(NamedTuple):
    """The nearest pair of pieces at each of N configurations.

    Attributes:
        clearances: Its distance less what an object demands, the smallest of all; infinite without pairs; (N,), [m].
        pairs: Its number, -1 without pairs; shape (N,).
        distances: Negative the depth; shape (N,), [m].
        points: Its nearest or deepest points in the root; shape (N, 6), [m].
    """

    clearances: Array
    pairs: Indices
    distances: Array
    points: Array

    def contact(self, row: int) -> PairContacts:
        """Return the pair of a row as the judge takes it."""
        rows = slice(row, row + int(self.pairs[row] >= 0))
        return self.pairs[rows], self.distances[rows], self.points[rows]


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """The nearest pair of bodies at each of N configurations.

    Attributes:
        in_collision: Whether anything is in contact, or nearer than its object demands; shape (N,).
        clearances: Smallest distance of all pairs less what an object demands, infinite without pairs; (N,), [m].
        pairs: Names of the nearest two, in contact of the deepest; None without pairs.
        distances: Of these two, negative by how far they overlap; shape (N,), [m].
        points: Their nearest or deepest points in the root frame; shape (N, 2, 3), [m].
        certificate: How Coal has checked them.
    """

    in_collision: Flags
    clearances: Array
    pairs: list[tuple[str, str] | None]
    distances: Array
    points: Array
    certificate: ContactCertificate


@dataclass(frozen=True, slots=True, eq=False)
class Cell:
    """A world whose pairs all count as in contact up to a distance.

    Attributes:
        world: Its margins contain that distance.
        min_clearance: The distance, added to what an object demands, [m].
    """

    world: World
    min_clearance: float

    def touching(self, qs: Array) -> Flags:
        """Return whether any pair is in contact at each configuration; (N, n) → (N,)."""
        return first_contacts(self.world.flat, qs) >= 0

    def first_free(self, qs: Array, order: Indices, firsts: Indices) -> Indices:
        """Return the row of the first free configuration of each group, else -1, see `kernels.first_free`."""
        return first_free(self.world.flat, qs, order, firsts)

    def nearest(self, qs: Array) -> Nearest:
        """Return the nearest pair at each configuration of shape (N, n)."""
        slacks, pairs, points = nearest_pairs(self.world.flat, qs)
        margins = np.append(self.world.flat.margins, 0.0)[pairs]
        return Nearest(slacks + self.min_clearance, pairs, slacks + margins, points)

    def names(self, pair: int) -> tuple[str, str]:
        """Return the names of the links or objects of a pair."""
        a, b = self.world.flat.pairs[pair].tolist()
        return self.world.names[a], self.world.names[b]

    def pair(self, pair: int, distance: float, points: Sequence[float]) -> dict[str, Any] | None:
        """Return a pair as it is sent, by its number, distance and points in lists; None for -1."""
        if pair < 0:
            return None
        a, b = self.names(pair)
        return {"a": a, "b": b, "distance": distance, "point_a": points[:3], "point_b": points[3:]}

    def contact(self, pair: int, distance: float) -> str:
        """Return in words how near a pair is that counts as in contact."""
        a, b = map(quoted, self.names(pair))
        if distance <= 0.0:
            return f"{a} and {b} overlap by {-distance:.3g} m"
        return f"{a} and {b} are {distance:.3g} m apart, at most the {self.world.flat.margins[pair]:.3g} m demanded"

    def certified(self, qs: Array, touching: Flags) -> ContactCertificate:
        """Check verdicts by Coal: all of a few, a sample of many; raises CertificationFailed."""

        def contact(row: int) -> PairContacts:
            pairs = first_contacts(self.world.flat, qs[row : row + 1])
            pairs = pairs[pairs >= 0]
            return pairs, *pair_distances(self.world.flat, qs[row : row + len(pairs)], pairs)

        return certify_contacts(self.world, qs, touching, contact)

    def certified_nearest(self, qs: Array, nearest: Nearest) -> ContactCertificate:
        """Check nearest pairs by Coal: all of a few, a sample of many; raises CertificationFailed."""
        return certify_clearances(self.world, qs, nearest.clearances - self.min_clearance, nearest.contact)

    def contacts(self, qs: Array) -> Contacts:
        """Return the nearest pairs by name, checked by Coal; raises CertificationFailed."""
        found = self.nearest(qs)
        certificate = self.certified_nearest(qs, found)
        names = [self.names(pair) if pair >= 0 else None for pair in found.pairs.tolist()]
        touching = found.clearances <= self.min_clearance
        return Contacts(touching, found.clearances, names, found.distances, found.points.reshape(-1, 2, 3), certificate)

    def gradients(self, qs: Array, nearest: Nearest) -> Array:
        """Return the gradients of the nearest pairs' distances; shape (N, n), [m/rad or 1], 0 without pairs."""
        return pair_gradients(self.world.flat, qs, nearest.pairs)

    def certified_gradients(self, qs: Array, nearest: Nearest, gradients: Array) -> GradientCertificate:
        """Check nearest pairs and their gradients by Coal, likewise."""
        certificate = self.certified_nearest(qs, nearest)
        error = certify_gradients(self.world, qs, nearest.contact, gradients)
        return GradientCertificate(**asdict(certificate), max_gradient_error=error)


def cell_in(world: World, min_clearance: float = 0.0) -> Cell:
    """Return a world as a cell, in which nothing may come nearer than `min_clearance`, [m] ≥ 0."""
    wider = world.flat._replace(margins=world.flat.margins + min_clearance)
    return Cell(replace(world, flat=wider) if min_clearance else world, min_clearance)
