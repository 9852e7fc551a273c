"""Names and parts of results about motions of the tip, without the code that computes these."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from gelenk.robot.result import Result

InverseName: TypeAlias = Literal["exact", "pseudo_inverse", "damped"]
InverseStatus: TypeAlias = Literal["solved", "approximate", "singular"]
SingularityKind: TypeAlias = Literal["wrist", "elbow", "shoulder"]


@dataclass(frozen=True, slots=True)
class ExceededLimit(Result):
    """A joint that is faster than its description allows.

    Attributes:
        joint: Whose limit it is.
        velocity: Of the joint, [rad/s or m/s].
        limit: Of this joint and of those in the chain that mimic it, [rad/s or m/s].
        ratio: Speed over limit, above 1; no unit.
    """

    joint: str
    velocity: float
    limit: float
    ratio: float
