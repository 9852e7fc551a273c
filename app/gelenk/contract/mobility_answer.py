"""The answer of the mobility calculator."""

from typing import Literal

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.course.steps import Step


class PairInfo(Answer):
    """A kinematic pair as it is counted."""

    name: str = Field(description="Of the pair.")
    link_a: str = Field(description="One of the two links.")
    link_b: str = Field(description="The other one.")
    type: str = Field(description="Kind; of a robot also `floating`, which is not a pair and removes nothing.")
    order: Literal["low", "high"] | None = Field(
        description="Low where the links touch in a surface, high in a line or point."
    )
    constraints: int = Field(description="c: degrees of freedom that it removes.")
    freedoms: int = Field(description="f = λ - c: degrees of freedom that it leaves.")
    joint: str | None = Field(description="The joint it is part of, if given.")
    added: bool = Field(description="Whether it was missing at a joint of more than two links.")


class PairCount(Answer):
    """The pairs of one kind."""

    type: str = Field(description="Of the pairs.")
    order: Literal["low", "high"] | None = Field(
        description="Low where links touch in a surface, high where in a line or a point; null if it does not say."
    )
    count: int = Field(description="How many.")
    constraints: int = Field(description="c of each.")


class JointSplitInfo(Answer):
    """A joint of more than two links."""

    joint: str = Field(description="Its name.")
    links: int = Field(description="k: links that meet there.")
    pairs: int = Field(description="k - 1: pairs that it is.")
    added: int = Field(description="How many of these had not been given.")
    constraints: int = Field(description="c of each of those.")


class IdleInfo(Answer):
    """A freedom that moves only its own links: they spin about the line through two spherical joints."""

    links: list[str] = Field(description="The links that can move alone.")
    joints: list[str] = Field(description="The two spherical joints.")


class PostureInfo(Answer):
    """The mobility in the given posture, from the location of the axes; at a singular posture larger than elsewhere."""

    mobility: int = Field(description="λ(n - 1) - r with the number r of constraints that are independent there.")
    redundant: int = Field(description="Σc - r: constraints that others imply, which the formula counts nonetheless.")
    output: int | None = Field(description="Freedoms of the link `output`; null where none was named.")
    smallest_counted: float | None = Field(
        description="Smallest singular value that counts for r, no unit; null if none does."
    )
    largest_neglected: float | None = Field(
        description="Largest singular value that does not count, no unit; null if all do."
    )
    residual: float = Field(
        description="The certificate: largest velocity, of the motions that are left, that a pair does not allow; no "
        "unit, lengths relative to the size of the linkage."
    )


class TaskInfo(Answer):
    """A task, and whether a chain has enough joints for it."""

    task: Literal["xy", "xy_phi", "xyz", "pose"] = Field(
        description="The kind of task: a position in the plane or in space, without or with an orientation."
    )
    dimension: int = Field(description="m: numbers that a task of this kind sets.")
    redundancy: int = Field(description="n - m: its degree, where ≥ 0; negative if joints are missing.")
    solutions: Literal["none", "finite", "infinite"] = Field(
        description="Of the inverse problem, by the counts alone: none for a task at random (n < m), finitely many "
        "branches (n = m), or infinitely many (n > m), which is redundancy; branches are not."
    )


class SpacesInfo(Answer):
    """Joint space and task space of a robot's default chain."""

    base_frame: str = Field(description="Where the chain begins.")
    tip_frame: str = Field(description="Where the chain ends.")
    configuration_dimension: int = Field(description="n: joints of the chain with a position of their own.")
    tasks: list[TaskInfo]


class MobilityAnswer(Answer):
    """The mobility, how it was counted, and how to read it."""

    mobility: int = Field(description="M = λ(n - 1) - Σc, Grübler and Kutzbach; the number of freedoms.")
    verdict: Literal["mechanism", "structure", "overconstrained"] = Field(
        description="By the mobility less the idle freedoms: ≥ 1, 0, < 0; that of `posture` where there is one."
    )
    space: Literal["planar", "spatial"] = Field(description="In which its links move.")
    space_freedoms: int = Field(description="λ: degrees of freedom of a free body.")
    link_count: int = Field(description="n, the ground included.")
    pair_count: int = Field(description="j, after joints of more than two links have been split.")
    constraint_count: int = Field(description="Σc over the pairs.")
    coupling_count: int = Field(description="Mimic joints of a robot: one constraint each, beside those of the pairs.")
    kinds: list[PairCount]
    splits: list[JointSplitInfo] = Field(description="The joints of more than two links.")
    mobility_without_split: int | None = Field(
        description="The wrong result if the missing pairs at such joints are forgotten; null if none is missing."
    )
    idle: list[IdleInfo] | None = Field(description="Idle freedoms; null where only counts of pairs were given.")
    mobility_without_idle: int | None = Field(
        description="Mobility, that of `posture` where there is one, less the idle freedoms; null where only counts of "
        "pairs were given."
    )
    ground: str | None = Field(
        description="The link at rest; null where only counts of pairs were given, as all below."
    )
    chain: Literal["open", "closed", "mixed"] | None = Field(
        description="Closed: each link is joined to each other by two paths that share no pair. Open: no loop. Mixed: "
        "anything else."
    )
    loop_count: int | None = Field(description="L = j - n + number of components: independent loops.")
    components: list[list[str]] | None = Field(description="The links by connected parts.")
    bridges: list[str] | None = Field(description="Pairs that lie on no loop.")
    pairs: list[PairInfo] | None
    mobility_by_loops: int | None = Field(
        description="The certificate: the same number by Σf - λL + λ(components - 1) less the couplings."
    )
    posture: PostureInfo | None = Field(
        description="Where the pairs say where they are: the mobility from that; else null."
    )
    rank_tolerance: float | None = Field(
        description="By which constraints counted in `posture`, relative to the largest; no unit; null where there is "
        "none."
    )
    spaces: SpacesInfo | None = Field(description="Of a robot: joint space and task spaces; else null.")
    warnings: list[str] = Field(description="What the number alone does not show.")
    steps: list[Step] = Field(description="The calculation, step by step.")
