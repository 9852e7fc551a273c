"""Input and output of the symbolic part of the equations of motion, as plain data."""

from dataclasses import dataclass
from typing import Any

from gelenk.dh.derive.texts import Configuration, SymbolEntry, SymbolicRequest
from gelenk.dh.derive.typeset import Formula, MatrixFormula
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody
from gelenk.robot.result import Result


@dataclass(frozen=True, slots=True)
class MotionSample:
    """A state of the arm: positions q [rad or m], velocities v [rad/s or m/s], accelerations a [rad/s² or m/s²].

    There is one body per joint, with a number for each quantity that was left out.
    """

    q: Configuration
    v: Configuration
    a: Configuration
    bodies: tuple[LinkBody, ...]


@dataclass(frozen=True, slots=True)
class MotionQuestion:
    """The request as plain data: `formulas` has the table, and how to write its formulas.

    There is one body per joint. Gravity is in the axes of frame 0. The formulas are also evaluated at the samples.
    """

    formulas: SymbolicRequest
    bodies: tuple[LinkBody, ...]
    gravity: Gravity
    samples: tuple[MotionSample, ...]


@dataclass(frozen=True, slots=True)
class LinkFormulas(Result):
    """A link in the Lagrangian; vectors in the axes of frame 0.

    Attributes:
        joint: The joint that moves the body.
        center_of_mass: p_ci from the origin of frame 0.
        velocity: v_ci, of the centre of mass.
        angular_velocity: ω_i about the normal of the plane.
        kinetic_energy: T_i.
        potential_energy: U_i, zero at the origin of frame 0.
    """

    joint: str
    center_of_mass: MatrixFormula
    velocity: MatrixFormula
    angular_velocity: Formula
    kinetic_energy: Formula
    potential_energy: Formula


@dataclass(frozen=True, slots=True)
class ChristoffelSymbol(Result):
    """A Christoffel symbol of the first kind, c_ijk = c_ikj.

    Attributes:
        i: Number of the row of C, from 1.
        j: Number of the column, from 1.
        k: Number of the velocity beside it, from j on.
        latex: For KaTeX or LaTeX with amsmath.
        plain: An expression of Python and of most computer algebra systems.
    """

    i: int
    j: int
    k: int
    latex: str
    plain: str


@dataclass(frozen=True, slots=True)
class EquationsCertificate(Result):
    """Comparison of the equations of motion with Pinocchio, which builds the arm from the table with these masses.

    Attributes:
        samples: States that were compared; in symbols, also with random values for what has none.
        max_mass_matrix_error: Largest difference of an entry of M, [kg m², kg m or kg].
        max_coriolis_error: Of a Christoffel symbol, [kg m², kg m or kg].
        max_gravity_error: Of an entry of g, [N m or N].
        seed: Random seed of the sampling; null where configurations were given.
    """

    samples: int
    max_mass_matrix_error: float
    max_coriolis_error: float
    max_gravity_error: float
    seed: int | None


@dataclass(frozen=True, slots=True)
class MotionTexts:
    """The equations of motion as text; quantities have the names that they have in `Equations`.

    Attributes:
        legend: Symbols beyond those of the transforms.
        christoffel: The symbols that differ from zero.
        equations_of_motion: M q̈ + C q̇ + g = τ, row by row.
        missing: Symbols of M, C and g that have no value.
        values: Values at each sample of all quantities of `Equations`, by name.
    """

    legend: list[SymbolEntry]
    gravity: MatrixFormula
    links: list[LinkFormulas]
    mass_matrix: MatrixFormula
    christoffel: list[ChristoffelSymbol]
    coriolis: MatrixFormula
    coriolis_vector: MatrixFormula
    gravity_vector: MatrixFormula
    skew: MatrixFormula
    equations_of_motion: list[Formula]
    missing: tuple[str, ...]
    values: list[dict[str, Any]]


@dataclass(frozen=True, slots=True)
class NoMotion:
    """The reason why there are no equations of motion."""

    reason: str
