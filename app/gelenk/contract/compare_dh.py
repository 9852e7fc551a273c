"""Comparison of a DH table with a robot's chain: request, answer, operation."""

from typing import Any, Literal, TypeAlias

from pydantic import Field

from gelenk.contract.common import Answer, ChainOptions, RobotName, optional
from gelenk.contract.dh import DhTablePayload
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.pose import Pose, PoseFormat
from gelenk.dh.compare.words import ORIENTATION_TOLERANCE, POSITION_TOLERANCE, SAMPLES, Mistake, Unverified

Findable: TypeAlias = Literal["base", "tool", "offsets", "signs"]


class CompareRequest(ChainOptions):
    """A table and the chain to compare it with."""

    dh: DhTablePayload = Field(
        description="The table: one row for each joint of the chain, base to tip. A `base` or `tool` that it gives is "
        "held; one that it leaves out is found, unless `find` says otherwise."
    )
    robot: RobotName
    find: list[Findable] | None = optional(
        "Unknowns to find so that the two agree; everything else is held, `base` and `tool` as in `dh` (the identity "
        "where left out), `offsets` at 0, `signs` at 1. If left out, `base` and `tool` are found where `dh` leaves "
        "them out. A `base` or `tool` named here is found even where `dh` gives one. With `[]` nothing is found. "
        "Offsets and signs can be found for tables with at most 16 rows.",
        max_length=4,
    )
    position_tolerance: float = Field(
        default=POSITION_TOLERANCE, gt=0.0, le=1.0, description="Distance within which positions count as equal, [m]."
    )
    orientation_tolerance: float = Field(
        default=ORIENTATION_TOLERANCE,
        gt=0.0,
        le=1.0,
        description="Angle within which orientations count as equal, [rad].",
    )
    pose_format: PoseFormat = Field(
        default="quaternion_xyzw", description="Notation of `base` and `tool` in the answer."
    )
    random_seed: int = Field(
        default=0, ge=0, le=2**32 - 1, description="Chooses the configurations at which both are compared."
    )


class DifferenceEntry(Answer):
    """A value in the table, and the value the chain needs there."""

    row: int | None = Field(
        description="The row, from 1 as in the textbooks: d₁ is in row 1. Null if it belongs to no row."
    )
    joint: str | None = Field(description="The row's name.")
    parameter: Literal["a", "alpha", "d", "theta", "sign", "type", "mimic", "joints", "base", "tool"] = Field(
        description="Which number differs; or the sense of a joint, its type, what it follows, the count of `joints`, "
        "the `base` or the `tool`."
    )
    value: float | str | None = Field(description="As the table has it, [rad or m].")
    expected: float | str | None = Field(description="As the chain needs it, the rest being held, [rad or m].")
    difference: float | None = Field(description="value - expected, [rad or m]; null if one is not a number.")
    pointer: str | None = Field(description="The place in the request, as a JSON pointer.")


class DiagnosisEntry(Answer):
    """One mistake, or two together, that would explain why the table does not describe the chain."""

    mistake: Mistake = Field(
        description="`sign` of a number or of a column; angles in `degrees`; lengths in `millimetres`, `centimetres` "
        "or off by another `power_of_ten`, one, those of a row, of a column or all; the other `convention`; `columns` "
        "exchanged in a row or throughout; `rows` exchanged or in reverse; a `row_missing`, a `row_doubled` or a "
        "`row_extra`, one too many; a joint that turns the other way (`joint_sense`) or has its zero elsewhere "
        "(`joint_zero`); one wrong `number`; a `base` or `tool` that is held and would have to be another."
    )
    mistakes: list[Mistake] = Field(description="All of them: `mistake`, and the other one where there are two.")
    detail: str = Field(description="The mistakes in a sentence.")
    differences: list[DifferenceEntry] = Field(
        description="Everything that would have to change, in the order of the table."
    )


class CompareAnswer(Answer):
    """Whether the table describes the chain: T_base_tip(q) = base · A_1 ⋯ A_n(signs · q + offsets) · tool."""

    equivalent: bool = Field(description="Whether both poses agree within the tolerances at every configuration.")
    base: Pose | None = Field(
        description="T_base_0 as given or found; what comes nearest where the two are not equivalent. This and the "
        "next five are null where rows and joints differ in number or type."
    )
    tool: Pose | None = Field(description="T_n_tool likewise.")
    offsets: list[float] | None = Field(description="Added to each of the table's variables, [rad or m].")
    signs: list[int] | None = Field(description="1 or -1: by which each of the chain's variables is multiplied first.")
    max_position_error: float | None = Field(description="Largest distance of the two poses, [m].")
    max_orientation_error: float | None = Field(description="Largest angle between the two poses, [rad].")
    first_difference: DifferenceEntry | None = Field(
        description="The first row and parameter that differ, of the likeliest explanation; null where equivalent."
    )
    found: list[Findable] = Field(description="The unknowns that were found.")
    held: list[Findable] = Field(description="The values that were held as given.")
    diagnoses: list[DiagnosisEntry] = Field(
        description="Mistakes that would each explain the difference, the likeliest first; two together where none "
        "does alone, of tables with at most 8 rows."
    )
    unverified: list[Unverified] = Field(
        description="Numbers that a found base, tool or offset compensates for, so that they could be anything. Give "
        "`base` and `tool` in `dh` to have them checked."
    )
    notes: list[str] = Field(description="Further remarks, one sentence each.")
    joint_names: list[str] = Field(description="The chain's variables, in the order of `offsets` and `signs`.")
    base_frame: str = Field(description="Where the chain begins.")
    tip_frame: str = Field(description="Where it ends.")
    samples: int = Field(description=f"Configurations compared at: {SAMPLES}, or 0 where the joints do not match.")
    random_seed: int = Field(description="Random seed of the configurations.")


def _row(name: str, a: float, alpha: float, d: float) -> dict[str, Any]:
    return {"name": name, "type": "revolute", "a": a, "alpha": alpha, "d": d, "theta": 0.0}


_QUARTER = 1.5707963267948966

EXAMPLE_COMPARISON: dict[str, Any] = {
    "robot": "ur5",
    "base_frame": "base",
    "tip_frame": "tool0",
    "dh": {
        "convention": "standard",
        "base": {"position": [0.0, 0.0, 0.0], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]},
        "joints": [
            _row("shoulder_pan", 0.0, _QUARTER, 0.089459),
            _row("shoulder_lift", -0.425, 0.0, 0.0),
            _row("elbow", -0.39225, 0.0, 0.0),
            _row("wrist_1", 0.0, _QUARTER, 0.10915),
            _row("wrist_2", 0.0, -_QUARTER, 0.09465),
            _row("wrist_3", 0.0, 0.0, 0.0823),
        ],
    },
}
"""A published table, 0.3 mm too high at the shoulder: the error shows because the base is held."""


ENDPOINT = Endpoint(
    name="compare_dh",
    path="v1/dh/compare",
    tag="DH tables",
    request=CompareRequest,
    answer=CompareAnswer,
    robot_field="robot",
    summary="Does a table describe a chain?",
    description="""
    Says whether a table describes a chain, and if not, which row and parameter are wrong and by how much.

    Many tables describe the same chain, so individual numbers are not compared: base · A_1 ⋯ A_n · tool must equal
    the chain's pose at random configurations, through Pinocchio. What `dh` gives is held, and a base or tool that
    it leaves out is found; `find` overrides this, and can add the joints' zeros (`offsets`) and senses (`signs`).

    A base that is found makes up for d and theta of the first row, a tool for the whole last row (Craig: the
    whole first row, and d and theta of the last): `unverified` lists such numbers. Give both to have everything
    checked, the identity included.

    Where the table does not describe the chain, mistakes are tried: each number by itself, signs, degrees, lengths
    off by a power of ten, columns and rows exchanged, a row missing or there twice, the other convention, a joint's
    sense or zero; and where none of them explains it, any two together. `diagnoses` has those that explain
    everything, the likeliest first, and `first_difference` is the first number of the likeliest; without a
    diagnosis it is the first difference from the base. A wrong number of rows or a joint of another type is also an
    answer, not an error.
    """,
    example=EXAMPLE_COMPARISON,
)
