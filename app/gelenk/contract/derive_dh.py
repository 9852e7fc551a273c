"""The worked solution of a DH table: request, answer, operation."""

from typing import Annotated, Any, Literal

from pydantic import Field

from gelenk.contract.common import Answer, optional
from gelenk.contract.dh import DhTablePayload, InOrder
from gelenk.contract.endpoint import Endpoint
from gelenk.contract.kinematics import Configuration
from gelenk.contract.lagrangian import EXAMPLE_MOTION, MAX_CONFIGURATIONS, DynamicsInfo, DynamicsPayload, Grid
from gelenk.contract.options import InLanguage
from gelenk.course.steps import Step
from gelenk.dh.derive.texts import (
    ColumnFormulas,
    FormulaCertificate,
    NumericCertificate,
    NumericColumn,
    SingularCondition,
    SymbolEntry,
)
from gelenk.dh.derive.typeset import Formula, MatrixFormula
from gelenk.robot.dh import MAX_JOINTS


class DeriveRequest(InLanguage, InOrder):
    """A table, how to write its solution, and the configurations at which to evaluate it."""

    dh: DhTablePayload
    joint_positions: Annotated[
        list[Configuration],
        Field(
            max_length=MAX_CONFIGURATIONS,
            description="Configurations for `numeric`: each one number per row, or an object of values by joint name; "
            "[rad] for revolute joints, [m] for prismatic ones. If left out, the answer has formulas alone.",
        ),
    ] = []  # noqa: RUF012
    notation: Literal["short", "full"] = Field(
        default="short", description="`short` writes c_{12} for cos(q_1 + q_2), `full` writes cos(q_1 + q_2)."
    )
    symbolic: bool = Field(
        default=True,
        description="Whether lengths and angles of the table stay symbols; otherwise formulas contain their values.",
    )
    first_index: int = Field(
        default=1,
        ge=1,
        le=MAX_JOINTS,
        description="Index of the first row, for part of an arm: with 4 the rows of a spherical wrist have A^3_4, "
        "A^4_5, A^5_6, and the variables are q_4, q_5, q_6. It must be 1 with `dynamics`.",
    )
    dynamics: DynamicsPayload | None = optional(
        "For a planar arm of up to three joints: its equations of motion by the Lagrangian too. `{}` gives them in "
        "symbols throughout.",
        examples=[EXAMPLE_MOTION["dynamics"]],
    )


class JacobianInfo(Answer):
    """The geometric Jacobian, linear rows first, in the axes of the base, at the tip."""

    matrix: MatrixFormula
    columns: list[ColumnFormulas]


class DeterminantInfo(Answer):
    """The determinant of the square block of the Jacobian."""

    block: Literal["full", "moving", "linear", "angular"] = Field(
        description="The whole Jacobian; the rows that ever differ from zero; the linear, or the angular ones of these."
    )
    rows: list[Literal["v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z"]] = Field(
        description="Rows of the Jacobian that form the block."
    )
    frame: int = Field(description="Number of the frame in whose axes these rows are expressed.")
    why: str = Field(description="Why this block.")
    latex: str | None = Field(
        description="The determinant as a product; null where it has too many terms, or failed its check."
    )
    plain: str | None = Field(description="The product as plain text; null where `determinant` is.")
    factors: list[Formula] = Field(description="The factors of the product beside its number, each one once.")


class NumericInfo(Answer):
    """The numbers at one configuration."""

    joint_positions: list[float] = Field(description="At which the numbers are, [rad or m].")
    A: list[Grid] = Field(description="A_1 … A_n, translation in [m].")
    T_0: list[Grid] = Field(description="T_0_1 … T_0_n, translation in [m].")
    T_base_tool: Grid = Field(description="Translation in [m].")
    position: list[float] = Field(description="Of the tool in the base, [m].")
    rotation: Grid = Field(description="Of the tool in the base; no unit.")
    columns: list[NumericColumn]
    jacobian: Grid = Field(description="6 rows, n columns: [m or rad] per [rad or m].")
    singular_values: list[float] = Field(description="Largest first, [m or rad] per [rad or m]: units are mixed.")
    rank: int = Field(description="Singular values above 1e-10 times the largest.")
    determinant: float | None = Field(description="Of the block that `determinant` names; null where none is square.")


class DeriveAnswer(Answer):
    """The worked solution."""

    convention: Literal["standard", "modified"] = Field(description="Of the table.")
    joint_names: list[str] = Field(description="The order of a configuration.")
    notation: Literal["short", "full"] = Field(description="As requested.")
    symbolic: bool = Field(description="Whether the answer has formulas, or numbers alone.")
    legend: list[SymbolEntry] = Field(description="Meaning of each symbol.")
    A: list[MatrixFormula] = Field(description="A_1 … A_n.")
    T_0: list[MatrixFormula] = Field(description="T_0_1 … T_0_n.")
    T_base_tool: MatrixFormula | None
    position: MatrixFormula | None = Field(description="Of the tool in the base.")
    rotation: MatrixFormula | None = Field(description="Of the tool in the base.")
    jacobian: JacobianInfo | None
    determinant: DeterminantInfo | None = Field(description="Null where no block is square, or without time.")
    singularities: list[SingularCondition] = Field(
        description="One for each factor of the determinant that depends on a joint."
    )
    dynamics: DynamicsInfo | None = Field(
        description="The equations of motion; null if they were not requested, or if `notes` says why there are none."
    )
    numeric: list[NumericInfo] = Field(description="One entry per configuration.")
    steps: list[Step] = Field(description="The solution step by step, in the order of a lecture.")
    notes: list[str] = Field(description="What was read differently, what stays numeric or failed its check, and why.")
    certificate: FormulaCertificate | None = Field(description="Null where there are no formulas.")
    numeric_certificate: NumericCertificate | None = Field(description="Null where there are no configurations.")


EXAMPLE_ANTHROPOMORPHIC: dict[str, Any] = {
    "dh": {
        "convention": "standard",
        "joints": [
            {"type": "revolute", "a": 0.0, "alpha": 1.5707963267948966, "d": 0.0, "theta": 0.0},
            {"type": "revolute", "a": 0.5, "alpha": 0.0, "d": 0.0, "theta": 0.0},
            {"type": "revolute", "a": 0.4, "alpha": 0.0, "d": 0.0, "theta": 0.0},
        ],
    },
    "joint_positions": [[0.3, 0.6, -0.8]],
}


ENDPOINT = Endpoint(
    name="derive_dh",
    path="v1/dh/derive",
    tag="DH tables",
    request=DeriveRequest,
    answer=DeriveAnswer,
    summary="Table → worked solution",
    description="""
    Writes the worked solution of a table as a lecturer would, in symbols and in numbers.

    Every homogeneous transform A^{i-1}_i(ϑ_i) of the Denavit-Hartenberg table and every T^0_i, the position from the
    right, A^0_1 (A^1_2 (… p)), the tip's pose (direct kinematics), the geometric Jacobian by its columns z × p, the
    determinant as a product, and the singular configurations; `steps` explains it in words. Formulas are given in
    LaTeX and plain text; sums of angles about parallel axes appear as c_{23}, and `legend` says what each symbol is.
    An angle within 1e-5 of a multiple of 90°, 45° or 30° is taken as that angle, and `notes` says so.

    Each formula is checked against the table's numbers at random configurations, and the numbers at the given ones
    against Pinocchio's. A formula that fails the check is left out, and so are formulas of a large arm that are too
    long to read: `notes` says which, and the numbers remain.

    With `dynamics` a planar arm of up to three joints also gets its equations of motion by the Lagrangian:
    energies, mass matrix, Christoffel symbols, Coriolis and gravity terms, compared with Pinocchio at random
    states. A mass, centre of mass or inertia that is left out stays a symbol.
    """,
    example=EXAMPLE_ANTHROPOMORPHIC,
)
