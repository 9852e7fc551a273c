"""Degrees of freedom of a mechanism: the operation."""

from gelenk.contract.endpoint import Endpoint
from gelenk.contract.mobility_answer import MobilityAnswer
from gelenk.contract.mobility_request import EXAMPLE_FOUR_BAR, MobilityRequest

ENDPOINT = Endpoint(
    name="mobility",
    path="v1/course/mobility",
    tag="Course",
    operation_id="count_mobility",
    request=MobilityRequest,
    answer=MobilityAnswer,
    summary="Freedoms of a mechanism",
    description="""
    Counts the degrees of freedom of a mechanism, M = λ(n - 1) - Σc, and classifies its chain.

    Give `space`, `links` and `pairs`; `pairs` as a list gives their links and so the loops, as an object the number
    of each type. Or give the name of a `robot`, whose tree is counted with its mimic joints, as Pinocchio's
    `model.nv`; `spaces` sets its default chain's n joints against the m numbers of a task (n > m is redundancy,
    which is not the same as several inverse solutions).

    Σc is over pairs, not joints: k links that meet at one joint are k - 1 pairs. `coincident` names such joints,
    or the pairs themselves name their `joint`; missing pairs are added, with a warning. (The
    notes have "more than two pairs in a joint"; it is more than two links. And the i-th pair takes c_i.)

    The formula ignores geometry: Bennett's linkage and a planar one counted with λ = 6 come out at -2 and move.
    M ≤ 0 is answered with that warning. Where each pair says where it is, by `point` and `axis`, `posture` has
    the mobility from the constraints that are independent there. Parts that spin between two spherical joints are
    found and subtracted in `mobility_without_idle`.
    """,
    robot_field="robot",
    example=EXAMPLE_FOUR_BAR,
)
