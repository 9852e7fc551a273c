"""The certificate of contacts, without the code that computes it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from gelenk.robot.result import Result


@dataclass(frozen=True, slots=True)
class ContactCertificate(Result):
    """Differences of these contacts from those computed through Pinocchio and Coal.

    Attributes:
        samples: Configurations that were recomputed: all of a small batch.
        pairs: Pairs of pieces that were compared there.
        max_distance_error: Largest difference of a distance, [m]; in contact, of what is left after the stated
            displacement.
        touching: Samples with another verdict, but within `tolerance` of touching, so that either is right.
        tolerance: Allowed difference, [m].
        seed: Random seed of the sampling.
    """

    samples: int
    pairs: int
    max_distance_error: float
    touching: int
    tolerance: float
    seed: int


@dataclass(frozen=True, slots=True)
class GradientCertificate(ContactCertificate):
    """The same of clearances and their gradients.

    Attributes:
        max_gradient_error: Largest difference of an entry from the slopes of Coal's distances to both sides, between
            which it is, [m/rad, or no unit], relative where it is above 1; 1e-3 is allowed.
    """

    max_gradient_error: float


def together(certificates: Sequence[ContactCertificate]) -> ContactCertificate:
    """Return the certificate of an answer whose parts, at least one, were checked each by itself."""
    return replace(
        certificates[0],
        samples=sum(one.samples for one in certificates),
        pairs=sum(one.pairs for one in certificates),
        max_distance_error=max(one.max_distance_error for one in certificates),
        touching=sum(one.touching for one in certificates),
    )
