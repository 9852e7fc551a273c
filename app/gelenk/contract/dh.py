"""Denavit-Hartenberg tables as payloads, and types that their conversions share."""

from dataclasses import asdict
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from gelenk.contract.common import Answer, Payload, optional
from gelenk.contract.options import WithSteps
from gelenk.contract.pose import Pose
from gelenk.course.steps import Step
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.errors import InvalidField, InvalidPose
from gelenk.robot.arrays import Array
from gelenk.robot.description import Mimic
from gelenk.robot.dh import MAX_JOINTS, MAX_SNAP_TOLERANCE, DhJoint, DhTable

JointName = Annotated[str, Field(min_length=1, max_length=128, pattern=r"^[^\x00-\x1f\x7f-\x9f]+$")]


class MimicPayload(Payload):
    """The row's position is `multiplier` · position of `joint` + `offset`."""

    joint: JointName = Field(
        description="A row with a position of its own, or a joint outside the table: that is a variable then, in its "
        "place where the first row needs it."
    )
    multiplier: float = Field(default=1.0, description="Of the position of the leader, [rad or m] per [rad or m].")
    offset: float = Field(default=0.0, description="Added to the multiple of the leader's position, [rad or m].")


class DhJointRow(Payload):
    """A row of the table; the joint's position adds to `theta` (revolute) or to `d` (prismatic)."""

    name: JointName | None = optional("Unique in the table; `joint_1`, `joint_2`, … if left out.")
    type: Literal["revolute", "prismatic"] = Field(
        description="Whether the joint turns about or slides along its axis."
    )
    a: float = Field(description="Length of the common normal, [m].")
    alpha: float = Field(description="Twist about the common normal, [rad].")
    d: float = Field(description="Offset along the joint axis, [m].")
    theta: float = Field(description="Angle about the joint axis, [rad].")
    lower: float | None = optional("Lower limit of the position, [rad or m]; -π or -1 m if left out.")
    upper: float | None = optional("Upper limit of the position, [rad or m]; π or 1 m if left out.")
    velocity: float | None = optional("Velocity limit, [rad/s or m/s].", ge=0)
    effort: float | None = optional("Effort limit, [N m or N].", ge=0)
    mimic: MimicPayload | None = optional(
        "The joint that this one follows; if left out, its position is a variable of the table."
    )

    def row(self, number: int) -> DhJoint:
        """Return the core's row, the `number`-th from 1."""
        fields = {**dict(self), "name": self.name or f"joint_{number}"}
        return DhJoint(**{**fields, "mimic": None if self.mimic is None else Mimic(**dict(self.mimic))})


class DhTablePayload(Payload):
    """A Denavit-Hartenberg table: T_base_tool = base · A_1 ⋯ A_n · tool.

    `standard` (distal): A_i = Rz(θ_i) Tz(d_i) Tx(a_i) Rx(α_i).
    `modified` (Craig): A_i = Rx(α_i) Tx(a_i) Rz(θ_i) Tz(d_i).
    """

    convention: Literal["standard", "modified"] = Field(description="How the four parameters of a row are composed.")
    joints: list[DhJointRow] = Field(min_length=1, max_length=MAX_JOINTS, description="The rows, base to tip.")
    base: Pose | None = optional("T_base_0; the identity if left out.")
    tool: Pose | None = optional("T_n_tool; the identity if left out.")

    def table(self) -> DhTable:
        """Return the core's table.

        Raises:
            InvalidPose: The orientation of base or tool is not a rotation.
            InvalidDhTable: The table is not a robot.
        """
        joints = tuple(row.row(number) for number, row in enumerate(self.joints, start=1))
        return DhTable(self.convention, joints, placed("base", self.base), placed("tool", self.tool))


def placed(place: str, pose: Pose | None) -> Array:
    """Return a pose as (4, 4), the identity for None; raises InvalidPose, which names `place`."""
    if pose is None:
        return np.eye(4)
    try:
        return pose.transform()
    except InvalidPose as error:
        raise InvalidPose(error.reason, error.distance, place) from error


def table_content(table: DhTable) -> dict[str, Any]:
    """Return a table as JSON content: a valid `DhTablePayload` that gives the same numbers again.

    Base and tool are matrices, which keep quarter turns exact, and are left out if they are the identity.
    """
    joints = [{key: value for key, value in asdict(row).items() if value is not None} for row in table.joints]
    places = {place: T for place, T in (("base", table.base), ("tool", table.tool)) if not np.array_equal(T, np.eye(4))}
    matrices = {place: {"matrix": T.tolist()} for place, T in places.items()}
    return {"convention": table.convention, "joints": joints, **matrices}


# Conversions

Convention = Annotated[
    Literal["standard", "modified"],
    Field(description="Convention of the table: standard (distal) or modified (Craig)."),
]
SnapTolerance = Annotated[
    float,
    Field(
        ge=0.0,
        le=MAX_SNAP_TOLERANCE,
        description="Angles within this distance [rad] of a multiple of π/2 are rounded to it, and lengths within this "
        "distance [m] of zero become zero: the table a person would write for a description with truncated numbers. "
        "The certificate gives the resulting error. At 0 the table is exact, except for axes that `notes` lists as "
        "taken to be parallel.",
    ),
]


class InOrder(Payload):
    """Chooses the order of the columns of the tables in steps."""

    column_order: Annotated[
        list[Column],
        Field(
            min_length=len(COLUMNS),
            max_length=len(COLUMNS),
            json_schema_extra={"uniqueItems": True},
            description="Order of the columns in the tables of `steps`, such as a, d, alpha, theta; each once.",
        ),
    ] = list(COLUMNS)  # noqa: RUF012

    @property
    def columns(self) -> list[Column]:
        """The order; raises InvalidField if a column is there twice."""
        if set(self.column_order) != set(COLUMNS):
            raise InvalidField("column_order", f"each of {', '.join(COLUMNS)} must be there once")
        return self.column_order


class InColumns(WithSteps, InOrder):
    """Asks for steps, and for an order of the columns of the tables in them."""


TableSteps = Annotated[
    list[Step] | None, Field(description="The way to the table, with its numbers; null unless `steps` asks for it.")
]


class TableCertificate(Answer):
    """Difference between the two sides of a conversion, measured through Pinocchio at random configurations.

    These are `lower + r (upper - lower)` with `r = numpy.random.default_rng(seed).random((samples, n))`. In the first
    half of the rows the bounds are the joints' limits (at most 10 rad or m from the position nearest to zero), in the
    second half revolute joints turn within ±π.
    """

    samples: int = Field(description="Number of configurations.")
    max_position_error: float = Field(description="Largest distance of the two poses, [m].")
    max_orientation_error: float = Field(description="Largest angle between the two poses, [rad].")
    seed: int = Field(description="Random seed of the configurations.")


EXAMPLE_TABLE: dict[str, Any] = {
    "convention": "modified",
    "joints": [
        {"name": "shoulder", "type": "revolute", "a": 0.0, "alpha": 0.0, "d": 0.333, "theta": 0.0}
        | {"lower": -2.8, "upper": 2.8, "velocity": 2.1, "effort": 87.0},
        {"name": "elbow", "type": "revolute", "a": 0.0, "alpha": -1.5707963267948966, "d": 0.0, "theta": 0.0}
        | {"lower": -1.7, "upper": 1.7},
        {"name": "slide", "type": "prismatic", "a": 0.1, "alpha": 1.5707963267948966, "d": 0.3, "theta": 0.0}
        | {"lower": 0.0, "upper": 0.25},
    ],
    "tool": {"position": [0.0, 0.0, 0.1], "quaternion_xyzw": [0.0, 0.0, 0.0, 1.0]},
}
EXAMPLE_URDF = """<robot name="two_links">
  <link name="foot"/><link name="upper"/><link name="fore"/><link name="hand"/>
  <joint name="shoulder" type="revolute"><parent link="foot"/><child link="upper"/>
    <origin xyz="0 0 0.4" rpy="1.5708 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" velocity="1.5" effort="40"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/>
    <origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-2.5" upper="2.5" velocity="2" effort="20"/></joint>
  <joint name="wrist" type="fixed"><parent link="fore"/><child link="hand"/><origin xyz="0.35 0 0"/></joint>
</robot>
"""
