"""The worked solution of a DH table: formulas and numbers, each checked by the other.

The formulas come from the symbolic part, which shares no code with the numeric one, and are compared with numbers at
random configurations before anyone sees them; the numbers at given configurations are compared with Pinocchio's. A
formula that fails is left out, and logged. What the symbolic part cannot derive in the time that is left stays
numeric. The notes say both.
"""

import logging
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Protocol, TypeVar

import numpy as np

from gelenk.course.steps import Step
from gelenk.dh.derive.check import SEED, Checks, checked_formulas, checked_singularities
from gelenk.dh.derive.numeric import NumericSolution, numeric_solution
from gelenk.dh.derive.steps import Layout, numbers_step, steps
from gelenk.dh.derive.symbolic import formulas, singularities
from gelenk.dh.derive.table import Numbers4, RowNumbers, TableNumbers
from gelenk.dh.derive.texts import FormulaCertificate, Formulas, NumericCertificate, Singularities, SymbolicRequest
from gelenk.dh.derive.transforms import MAX_ENTRY_TERMS
from gelenk.dh.derive.typeset import Style
from gelenk.dh.lagrangian.bodies import MassProperties
from gelenk.dh.lagrangian.solution import MotionSolution, checked_dynamics, motion_question, motion_solution
from gelenk.dh.lagrangian.symbolic import motion
from gelenk.dh.lagrangian.texts import MotionTexts, NoMotion
from gelenk.dh.tables.columns import COLUMNS, Column
from gelenk.dh.tables.convert import BASE_FRAME, TOOL_FRAME, describe_dh
from gelenk.errors import InvalidDhTable
from gelenk.kinematics.judge.judge import certify_jacobians, certify_poses
from gelenk.language import marked, translated as _
from gelenk.robot.arrays import Array, Configuration
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf, write_urdf

logger = logging.getLogger("gelenk")

SAMPLES = 20
_Question = TypeVar("_Question")
_Result = TypeVar("_Result")


class BoundedRunner(Protocol):
    """Runs a function of plain data somewhere, within a processor time, [s]; TimeoutError if it takes longer."""

    def __call__(self, function: Callable[[_Question], _Result], question: _Question, seconds: float, /) -> _Result:
        """Return the function's result."""
        raise NotImplementedError


def directly(function: Callable[[_Question], _Result], question: _Question, seconds: float) -> _Result:  # noqa: ARG001
    """Run a function in this thread, however long it takes."""
    return function(question)


@dataclass(frozen=True, slots=True)
class WorkedSolution:
    """The worked solution of a table.

    Attributes:
        joint_names: Names of the joints, in the order of a configuration.
        formulas: Transforms and Jacobian; None if there was no time.
        singularities: Determinant, and where it vanishes; None if there was no time.
        motion: The equations of motion; None if they were not requested, or the notes say why there are none.
        numeric: One entry per given configuration.
        determinants: Determinant of the block at each of these; None if no block is square.
        notes: Numbers that were read as something else, and what stays numeric and why.
        certificate: Of the formulas; None without formulas.
        numeric_certificate: Of poses and Jacobians at the configurations, by Pinocchio.
    """

    joint_names: tuple[str, ...]
    formulas: Formulas | None
    singularities: Singularities | None
    motion: MotionSolution | None
    numeric: list[NumericSolution]
    determinants: list[float | None]
    steps: list[Step]
    notes: list[str]
    certificate: FormulaCertificate | None
    numeric_certificate: NumericCertificate | None


def worked_solution(
    table: DhTable,
    values: Sequence[Configuration] = (),
    style: Style = "short",
    *,
    keeps_symbols: bool = True,
    dynamics: MassProperties | None = None,
    first_index: int = 1,
    columns: Sequence[Column] = COLUMNS,
    run: BoundedRunner = directly,
    deadline: float | None = None,
) -> WorkedSolution:
    """Derive the worked solution of a table.

    Args:
        values: Configurations at which numbers are wanted too, in order or by name, [rad or m].
        style: `short` writes c_{12}, `full` writes cos(q_1 + q_2).
        keeps_symbols: Whether lengths stay symbols; otherwise the formulas contain their values.
        dynamics: Masses and gravity, if the equations of motion are wanted; then the first index is 1.
        first_index: Index of the first row: 4 for a wrist at the end of an arm with three joints.
        columns: Order of the columns of the table in the steps.
        run: Runs the symbolic part.
        deadline: Time at which the symbolic part must be done, on `time.process_time`, [s]; none if left out.

    Raises:
        InvalidDhTable: A row follows another joint.
        WrongJointCount, MissingJoint, UnknownJoint, InvalidField: A configuration does not fit the table, or the
            dynamics do not.
        CertificationFailed: Numbers differ from Pinocchio's. A formula that differs is left out, and the notes say so.
    """
    for i, row in enumerate(table.joints):
        if row.mimic is not None:
            raise InvalidDhTable("a worked solution needs rows that follow no other joint", i, "mimic")
    robot = RobotModel(read_urdf(write_urdf(describe_dh("table", table))), (BASE_FRAME, TOOL_FRAME))
    qs = configurations(robot.chain(None, None), values)
    bodies = None if dynamics is None else checked_dynamics(table, robot.chain(None, None), dynamics, len(qs))
    numeric = [numeric_solution(table, q) for q in qs]
    samples = _samples(table)
    points = tuple(tuple(q) for q in samples.tolist())
    question = SymbolicRequest(_numbers(table), style, keeps_symbols, points, first_index - 1)
    notes: list[str] = []
    timed = _Timed(run, deadline, notes)
    found = timed.result(formulas, question, 0.5, "transforms")
    motion_request = None if bodies is None or found is None else motion_question(question, table, bodies)
    moving = timed.result(motion, motion_request, 0.5, "motion") if motion_request else None
    singular = timed.result(singularities, question, 1.0, "determinant") if found else None
    checks, solved = Checks(0.0, []), None
    if found is not None:
        notes = [*found.remarks, *_limits(table, found, singular), *notes]
        as_read = _read_back(found.as_read)
        if motion_request is not None and bodies is not None and isinstance(moving, MotionTexts):
            solved = motion_solution(moving, motion_request, table, as_read, bodies, qs, checks)
        solutions = [numeric_solution(as_read, q) for q in samples]
        found = checked_formulas(found, solutions, checks)
        if singular is not None:
            singular = checked_singularities(singular, solutions, as_read, checks)
        notes += checks.notes
    if isinstance(moving, NoMotion):
        notes.append(moving.reason)
    elif bodies is not None and found is None:
        notes.append(_("without the transforms in symbols the equations of motion are left out too"))
    layout = Layout(table.convention == "standard", first_index - 1, columns)
    derivation = [] if found is None else steps(layout, found, singular)
    if numeric and found is not None:
        derivation.append(numbers_step(layout, table, numeric[0]))
    return WorkedSolution(
        tuple(row.name for row in table.joints),
        found,
        singular,
        solved,
        numeric,
        [_determinant(singular, solution) for solution in numeric],
        [*derivation, *(solved.steps if solved is not None else ())],
        [*notes, *(solved.notes if solved is not None else ())],
        None if found is None else FormulaCertificate(len(samples), checks.worst, SEED),
        _certified(robot, qs, numeric) if numeric else None,
    )


_OVERDUE = {
    "transforms": marked(
        "the transforms and the Jacobian could not be worked out in symbols in the time allowed: only numbers are given"
    ),
    "determinant": marked(
        "the determinant could not be worked out in symbols in the time allowed: only numbers are given"
    ),
    "motion": marked(
        "the equations of motion could not be worked out in symbols in the time allowed: they are left out"
    ),
}
_FAILED = {
    "transforms": marked(
        "the transforms and the Jacobian in symbols failed a check of their own: only numbers are given"
    ),
    "determinant": marked("the determinant in symbols failed a check of its own: only numbers are given"),
    "motion": marked("the equations of motion in symbols failed a check of their own: they are left out"),
}


@dataclass(frozen=True, slots=True)
class _Timed:
    """Runs parts of the symbolic side until a deadline, and notes what fails."""

    run: BoundedRunner
    deadline: float | None
    notes: list[str]

    def result(
        self,
        function: Callable[[_Question], _Result],
        question: _Question,
        share: float,
        what: str,
    ) -> _Result | None:
        """Return the function's result within its share of the time that is left; None and a note if it fails."""
        seconds = float("inf") if self.deadline is None else (self.deadline - time.process_time()) * share
        try:
            return self.run(function, question, seconds)
        except (TimeoutError, MemoryError):
            self.notes.append(_(_OVERDUE[what]))
        except ArithmeticError:
            logger.exception("derived formulas left out: %s failed a check of their own", what)
            self.notes.append(_(_FAILED[what]))
        return None


def _samples(table: DhTable) -> Array:
    reach = np.array([np.pi if row.type == "revolute" else 1.0 for row in table.joints])
    return np.random.default_rng(SEED).uniform(-reach, reach, (SAMPLES, len(reach)))


def _numbers(table: DhTable) -> TableNumbers:
    rows = tuple(RowNumbers(row.name, row.type, row.a, row.alpha, row.d, row.theta) for row in table.joints)
    return TableNumbers(table.convention, rows, _tuples(table.base), _tuples(table.tool))


def _tuples(matrix: Array) -> Numbers4:
    return tuple(tuple(row) for row in matrix.tolist())


def _read_back(numbers: TableNumbers) -> DhTable:
    """Return the table that the formulas stand for: angles and lengths as they were read."""
    joints = tuple(DhJoint(**asdict(row)) for row in numbers.rows)
    return DhTable(numbers.convention, joints, np.array(numbers.base), np.array(numbers.tool))


def _determinant(singular: Singularities | None, solution: NumericSolution) -> float | None:
    if singular is not None and singular.block is not None:
        return solution.determinant(singular.block.rows, singular.block.frame)
    return solution.determinant(range(6), 0) if solution.jacobian.shape[1] == 6 else None


def _certified(robot: RobotModel, qs: Array, numeric: Sequence[NumericSolution]) -> NumericCertificate:
    chain = robot.chain(None, None)
    positions = np.array([solution.tip[:3, 3] for solution in numeric])
    rotations = np.array([solution.tip[:3, :3] for solution in numeric])
    poses = certify_poses(robot, chain, qs, {TOOL_FRAME: Poses(positions, rotations)})
    jacobians = certify_jacobians(robot, chain, qs, np.array([solution.jacobian for solution in numeric]))
    return NumericCertificate(poses.samples, poses.max_position_error, poses.max_orientation_error, jacobians.max_error)


def _limits(table: DhTable, found: Formulas, singular: Singularities | None) -> list[str]:
    notes = []
    written = sum(frame is not None for frame in found.frames)
    n = len(table.joints)
    if written < n:
        notes.append(
            _(
                "T_0_i is in symbols up to i = {written}: the next has an entry of more than {most} terms, so that "
                "from there on, and for the Jacobian, only numbers at given configurations are given"
            ).format(written=written, most=MAX_ENTRY_TERMS)
        )
    elif found.jacobian is None:
        notes.append(
            _("the pose of the tip or the Jacobian has too many terms to be written out: only numbers are given")
        )
    if singular is None or written < n:
        return notes
    if singular.block is None:
        notes.append(
            _(
                "the Jacobian is 6 × {n}, and neither the rows that ever differ from zero nor the linear or angular "
                "ones of these are {n}: there is no determinant, and singular is where the rank drops"
            ).format(n=n)
        )
    elif singular.formula is None:
        notes.append(_("the determinant has too many terms to be written out: only its numbers are given"))
    return notes
