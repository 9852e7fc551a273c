"""Degrees of freedom of a mechanism: answer, operation."""

from pydantic import Field

from gelenk.contract.common import Answer
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.mobility_request import MobilityRequest
from gelenk.course.mobility.mechanism import IdleSpin, JointSplit, Pair
from gelenk.course.mobility.mobility import PairCount, Verdict
from gelenk.course.mobility.pairs import Space
from gelenk.course.mobility.screws import PostureMobility
from gelenk.course.mobility.steps import TaskKind
from gelenk.course.mobility.topology import ChainKind
from gelenk.course.steps import Step


class SpacesInfo(Answer):
    """Joint space and task space of a robot's default chain."""

    base_frame: str = Field(description="Where the chain begins.")
    tip_frame: str = Field(description="Where the chain ends.")
    configuration_dimension: int = Field(description="n: joints of the chain with a position of their own.")
    workspace_dimension: int = Field(
        description="Of the positions that the tip reaches: 3 in space, 2 on a surface such as a plane, 1 on a curve."
    )
    tasks: list[TaskKind]


class MobilityAnswer(Answer):
    """The mobility, how it was counted, and how to read it."""

    mobility: int = Field(description="M = λ(n - 1) - Σc, Grübler and Kutzbach; the number of freedoms.")
    verdict: Verdict = Field(
        description="By the mobility less the idle freedoms: ≥ 1, 0, < 0; that of `posture` where there is one."
    )
    space: Space = Field(description="In which its links move.")
    space_freedoms: int = Field(description="λ: degrees of freedom of a free body.")
    link_count: int = Field(description="n, the ground included.")
    pair_count: int = Field(description="j, after joints of more than two links have been split.")
    constraint_count: int = Field(description="Σc over the pairs.")
    coupling_count: int = Field(description="Mimic joints of a robot: one constraint each, beside those of the pairs.")
    kinds: list[PairCount]
    splits: list[JointSplit] = Field(description="The joints of more than two links.")
    mobility_without_split: int | None = Field(
        description="The wrong result if the missing pairs at such joints are forgotten; null if none is missing."
    )
    idle: list[IdleSpin] | None = Field(description="Idle freedoms; null where only counts of pairs were given.")
    mobility_without_idle: int | None = Field(
        description="Mobility, that of `posture` where there is one, less the idle freedoms; null where only counts of "
        "pairs were given."
    )
    ground: str | None = Field(
        description="The link at rest; null where only counts of pairs were given, as all below."
    )
    chain: ChainKind | None = Field(
        description="Closed: each link is joined to each other by two paths that share no pair. Open: no loop. Mixed: "
        "anything else."
    )
    loop_count: int | None = Field(description="L = j - n + number of components: independent loops.")
    components: list[list[str]] | None = Field(description="The links by connected parts.")
    bridges: list[str] | None = Field(description="Pairs that lie on no loop.")
    pairs: list[Pair] | None
    mobility_by_loops: int | None = Field(
        description="The certificate: the same number by Σf - λL + λ(components - 1) less the couplings."
    )
    posture: PostureMobility | None = Field(
        description="Where the pairs say where they are: the mobility from that; else null."
    )
    rank_tolerance: float | None = Field(
        description="By which constraints counted in `posture`, relative to the largest; no unit; null where there is "
        "none."
    )
    spaces: SpacesInfo | None = Field(description="Of a robot: joint space and task spaces; else null.")
    warnings: list[str] = Field(description="What the number alone does not show.")
    steps: list[Step] = Field(description="The calculation, step by step.")


ENDPOINT = Endpoint(
    name="mobility",
    path="v1/course/mobility",
    tag="Course",
    operation_id="count_mobility",
    request=MobilityRequest,
    answer=MobilityAnswer,
    summary="Freedoms of a mechanism",
    description="""
    Counts the degrees of freedom (DOF) of a mechanism by Grübler, M = λ(n - 1) - Σc, and classifies its chain.

    Give `space`, `links` and `pairs`; `pairs` as a list gives their links and so the loops, as an object the number
    of each type. Or give the name of a `robot`, whose tree is counted with its mimic joints, as Pinocchio's
    `model.nv`; `spaces` sets its default chain's n joints against the m numbers of a task and the directions
    that its tip has (n > m is redundancy, which is not the same as several inverse solutions).

    Σc is over pairs, not joints: k links that meet at one joint are k - 1 pairs. `coincident` names such joints,
    or the pairs themselves name their `joint`; missing pairs are added, with a warning. (The
    notes have "more than two pairs in a joint"; it is more than two links. And the i-th pair takes c_i.)

    The formula ignores geometry: Bennett's linkage and a planar one counted with λ = 6 come out at -2 and move.
    M ≤ 0 is answered with that warning. Where each pair says where it is, by `point` and `axis`, `posture` has
    the mobility from the constraints that are independent there. Parts that spin between two spherical joints are
    found and subtracted in `mobility_without_idle`.

    As a picture with `Accept: image/svg+xml`, `image/png` or `application/pdf`.
    """,
    picture="Links and pairs: in their posture if each pair of a planar mechanism has a `point`, else as a graph.",
    robot_field="robot",
    example={
        "space": "planar",
        "links": [{"name": "frame", "ground": True}, "crank", "coupler", "rocker"],
        "pairs": [
            {"link_a": "frame", "link_b": "crank", "type": "revolute"},
            {"link_a": "crank", "link_b": "coupler", "type": "revolute"},
            {"link_a": "coupler", "link_b": "rocker", "type": "revolute"},
            {"link_a": "rocker", "link_b": "frame", "type": "revolute"},
        ],
    },
)
