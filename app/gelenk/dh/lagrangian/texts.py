"""Input and output of the symbolic part of the equations of motion, as plain data."""

from dataclasses import dataclass

from gelenk.dh.derive.table import TableNumbers
from gelenk.dh.derive.texts import Configuration, Grid, SymbolEntry
from gelenk.dh.derive.typeset import MatrixText, Style, Text
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody


@dataclass(frozen=True, slots=True)
class MotionSample:
    """A state of the arm, and its bodies with a number for each quantity that was left out.

    Attributes:
        q: Joint positions, [rad or m].
        v: Joint velocities, [rad/s or m/s].
        a: Joint accelerations, [rad/s² or m/s²].
        bodies: One per joint.
    """

    q: Configuration
    v: Configuration
    a: Configuration
    bodies: tuple[LinkBody, ...]


@dataclass(frozen=True, slots=True)
class MotionQuestion:
    """The request as plain data.

    Attributes:
        table: The table.
        style: `short` for c_{12}, `full` for cos(q_1 + q_2).
        keeps_symbols: Whether lengths and masses stay symbols; otherwise the formulas contain the given values.
        bodies: One per joint.
        gravity: Free fall in the axes of frame 0.
        samples: States at which the formulas are also evaluated.
    """

    table: TableNumbers
    style: Style
    keeps_symbols: bool
    bodies: tuple[LinkBody, ...]
    gravity: Gravity
    samples: tuple[MotionSample, ...]


@dataclass(frozen=True, slots=True)
class BodyText:
    """A link: its centre of mass, its motion, and its energies."""

    center: MatrixText
    velocity: MatrixText
    angular_velocity: Text
    kinetic: Text
    potential: Text


@dataclass(frozen=True, slots=True)
class ChristoffelText:
    """A Christoffel symbol c_ijk = c_ikj; joints are numbered from 1, and j ≤ k."""

    i: int
    j: int
    k: int
    formula: Text


@dataclass(frozen=True, slots=True)
class MotionValues:
    """All quantities at one sample; vectors in frame 0, Christoffel symbols as c[i][j][k]."""

    centers: Grid
    velocities: Grid
    kinetic: list[float]
    potential: list[float]
    mass_matrix: Grid
    christoffel: list[Grid]
    coriolis: Grid
    coriolis_vector: list[float]
    gravity_vector: list[float]
    skew: Grid
    torques: list[float]


@dataclass(frozen=True, slots=True)
class MotionTexts:
    """The equations of motion as text.

    Attributes:
        legend: Symbols beyond those of the transforms.
        gravity: The acceleration of free fall in frame 0.
        bodies: One per joint.
        mass_matrix: M.
        christoffel: The symbols that differ from zero.
        coriolis: C.
        coriolis_vector: C q̇.
        gravity_vector: g.
        skew: Ṁ - 2C.
        rows: M q̈ + C q̇ + g = τ, row by row.
        missing: Symbols of M, C and g that have no value.
        values: Values at each sample.
    """

    legend: list[SymbolEntry]
    gravity: MatrixText
    bodies: list[BodyText]
    mass_matrix: MatrixText
    christoffel: list[ChristoffelText]
    coriolis: MatrixText
    coriolis_vector: MatrixText
    gravity_vector: MatrixText
    skew: MatrixText
    rows: list[Text]
    missing: tuple[str, ...]
    values: list[MotionValues]


@dataclass(frozen=True, slots=True)
class NoMotion:
    """The reason why there are no equations of motion."""

    reason: str
