"""Which pairs of a robot's links are looked at for contacts with each other."""

from pydantic import Field

from gelenk.collision.pairs import SAMPLES, PairReason
from gelenk.contract.common import Answer, FrameName, Payload


class PairChoice(Payload):
    """A pair of links, and whether contacts between them are looked for."""

    a: FrameName = Field(description="Name of a link that has a body.")
    b: FrameName = Field(description="Name of the other one.")
    active: bool = Field(description="Whether contacts between them are looked for.")


class PairChoices(Payload):
    """The pairs that differ from what was found; all others stand as found."""

    pairs: list[PairChoice] = Field(max_length=10_000, description="None if all pairs are as found.")


class PairInfo(Answer):
    """A pair of links that have bodies."""

    a: str = Field(description="Name of a link.")
    b: str = Field(description="Name of the other one.")
    active: bool = Field(description="Whether contacts between them are looked for.")
    reason: PairReason | None = Field(
        description="Why not: they are rigidly joined, or by one joint with no body between (`neighbours`), or the "
        "SRDF says so (`srdf`), or they are in contact wherever the joints stand (`always`: at each of "
        f"{SAMPLES:,} random configurations within the limits). `edited`: a person chose. null: nothing "
        "speaks against it."
    )


class CollisionPairs(Answer):
    """All pairs of links of a robot that have bodies."""

    pairs: list[PairInfo]
    warnings: list[str] = Field(description="Why some links have no body, or one not meant for contacts.")
