"""The equations of motion of a table: formulas, and numbers at given configurations, each compared with Pinocchio."""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.dh.derive.check import SEED, Checks
from gelenk.dh.derive.table import ROOTS, exact_number
from gelenk.dh.derive.texts import SymbolicRequest
from gelenk.dh.lagrangian.bodies import LinkBody, MassProperties
from gelenk.dh.lagrangian.check import certify_formulas, certify_numbers
from gelenk.dh.lagrangian.numeric import NumericMotion, numeric_motion
from gelenk.dh.lagrangian.texts import EquationsCertificate, MotionQuestion, MotionSample, MotionTexts
from gelenk.errors import CertificationFailed, InvalidField, counted
from gelenk.language import translated as _
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import DhTable


def motion_steps(found: MotionTexts) -> list[Step]:
    """Return the steps: centres of mass, energies, mass matrix, Coriolis and gravity terms, equations of motion."""
    return [_centers(found), _energies(found), _mass_matrix(found), _coriolis(found), _gravity(found), _rows(found)]


def _centers(found: MotionTexts) -> Step:
    lines = []
    for i, body in enumerate(found.links, start=1):
        lines.append(
            rf"p_{{c{i}}} = {body.center_of_mass.latex},\quad "
            rf"v_{{c{i}}} = \dot{{p}}_{{c{i}}} = {body.velocity.latex},\quad "
            rf"\omega_{{{i}}} = {body.angular_velocity.latex}"
        )
    text = _(
        "The position of each link's centre of mass in frame 0, differentiated by the chain rule, and the angular "
        "velocity about the normal of the plane: the sum of the joint velocities before it."
    )
    return step(_("Centres of mass and their velocities"), text, *lines)


def _energies(found: MotionTexts) -> Step:
    rule = r"T_i = \frac{1}{2} m_i\, v_{ci}^{\mathsf T} v_{ci} + \frac{1}{2} I_i\, \omega_i^{2}"
    lines = [rf"{rule},\quad U_i = -m_i\, g^{{\mathsf T}} p_{{ci}}", f"g = {found.gravity.latex}"]
    for i, body in enumerate(found.links, start=1):
        lines += [f"T_{{{i}}} = {body.kinetic_energy.latex}", f"U_{{{i}}} = {body.potential_energy.latex}"]
    lines.append(r"L = \sum_i T_i - \sum_i U_i")
    text = _(
        "A link's kinetic energy is that of its mass moving with the centre and that of its turning about it. The "
        "potential energy counts from the origin of frame 0, in whose axes gravity is written."
    )
    return step(_("Kinetic and potential energy"), text, *lines)


def _mass_matrix(found: MotionTexts) -> Step:
    lines = [r"\sum_i T_i = \frac{1}{2} \dot{q}^{\mathsf T} M(q)\, \dot{q}", f"M(q) = {found.mass_matrix.latex}"]
    text = _("The kinetic energy is a quadratic form of the joint velocities; its symmetric matrix is the mass matrix.")
    return step(_("Mass matrix"), text, *lines)


def _coriolis(found: MotionTexts) -> Step:
    rule = (
        r"c_{ijk} = \frac{1}{2} \left(\frac{\partial M_{ij}}{\partial q_k} + \frac{\partial M_{ik}}{\partial q_j} "
        r"- \frac{\partial M_{jk}}{\partial q_i}\right)"
    )
    lines = [rule]
    for one in found.christoffel:
        same = "" if one.j == one.k else rf" = c_{{{one.i}{one.k}{one.j}}}"
        lines.append(rf"c_{{{one.i}{one.j}{one.k}}}{same} = {one.latex}")
    lines += [
        rf"C_{{ij}} = \sum_k c_{{ijk}}\, \dot{{q}}_k:\quad C(q, \dot{{q}}) = {found.coriolis.latex}",
        rf"C\, \dot{{q}} = {found.coriolis_vector.latex}",
        rf"\dot{{M}} - 2C = {found.skew.latex} = -\left(\dot{{M}} - 2C\right)^{{\mathsf T}}",
    ]
    text = _(
        "The Christoffel symbols of the mass matrix give the centrifugal (j = k) and Coriolis terms (j ≠ k); those "
        "that are not listed are zero. With C built from them Ṁ - 2C is skew symmetric."
        if found.christoffel
        else "The mass matrix is constant: all Christoffel symbols are zero, and so is C. With C built from them "
        "Ṁ - 2C is skew symmetric."
    )
    return step(_("Christoffel symbols and Coriolis matrix"), text, *lines)


def _gravity(found: MotionTexts) -> Step:
    line = rf"g_i(q) = \frac{{\partial}}{{\partial q_i}} \sum_j U_j:\quad g(q) = {found.gravity_vector.latex}"
    return step(_("Gravity"), _("The torques that hold the arm at rest are the slope of the potential energy."), line)


def _rows(found: MotionTexts) -> Step:
    rule = r"\frac{d}{dt} \frac{\partial L}{\partial \dot{q}} - \frac{\partial L}{\partial q} = \tau"
    lines = [rf"{rule} \;\Leftrightarrow\; M(q)\, \ddot{{q}} + C(q, \dot{{q}})\, \dot{{q}} + g(q) = \tau"]
    lines += [row.latex for row in found.equations_of_motion]
    return step(_("Equations of motion"), _("Lagrange's equations, one row per joint."), *lines)


LINKS, VELOCITIES = "dynamics/links", "dynamics/joint_velocities"
"""Names of these fields of a request in errors."""


@dataclass(frozen=True, slots=True)
class MotionSolution:
    """The equations of motion: in symbols, in numbers, and their derivation in words.

    Attributes:
        numeric: M, C and g at each given configuration; empty if a number is missing.
        notes: What is left out, and why.
        certificate, numeric_certificate: Those of the formulas and of the numbers; None without numbers.
    """

    texts: MotionTexts
    numeric: list[NumericMotion]
    steps: list[Step]
    notes: list[str]
    certificate: EquationsCertificate
    numeric_certificate: EquationsCertificate | None


def checked_dynamics(table: DhTable, chain: Chain, dynamics: MassProperties, count: int) -> MassProperties:
    """Return the dynamics with a body per row, and `count` velocities in the chain's order, if any.

    Raises InvalidField if links are not as many as rows, or velocities as configurations, and as `configurations` does.
    """
    n, given = len(table.joints), len(dynamics.bodies)
    if given not in {0, n}:
        raise InvalidField(
            LINKS,
            f"has {counted(given, 'entry')} where the table has {counted(n, 'joint')}: one link per joint, or none",
        )
    velocities = None
    if dynamics.velocities is not None:
        velocities = configurations(chain, dynamics.velocities, VELOCITIES)
        if len(velocities) != count:
            reason = f"has {counted(len(velocities), 'entry')} where joint_positions has {count}: one per configuration"
            raise InvalidField(VELOCITIES, reason)
    return replace(dynamics, bodies=dynamics.bodies or (LinkBody(),) * n, velocities=velocities)


def motion_question(question: SymbolicRequest, table: DhTable, dynamics: MassProperties) -> MotionQuestion:
    """Return the input of the symbolic part: gravity in frame 0, and samples with a number for every symbol."""
    x, y, z = (_snapped(float(x)) for x in table.base[:3, :3].T @ dynamics.gravity.direction)
    gravity = replace(dynamics.gravity, direction=(x, y, z))
    random = np.random.default_rng(SEED)
    samples = []
    for q in question.samples:
        v, a = random.uniform(-2.0, 2.0, (2, len(q))).tolist()
        numbers = random.uniform(0.1, 1.0, (len(q), 3)).tolist()
        bodies = tuple(_filled(body, *row) for body, row in zip(dynamics.bodies, numbers, strict=True))
        samples.append(MotionSample(q, tuple(v), tuple(a), bodies))
    return MotionQuestion(question, dynamics.bodies, gravity, tuple(samples))


def _snapped(component: float) -> float:
    """Return a component of a unit vector as the formulas read it."""
    exact = exact_number(component)
    return component if exact is None else exact.value(ROOTS)


def _filled(body: LinkBody, mass: float, center: float, inertia: float) -> LinkBody:
    return LinkBody(
        mass if body.mass is None else body.mass,
        center if body.center is None else body.center,
        inertia if body.inertia is None else body.inertia,
    )


def motion_solution(
    texts: MotionTexts,
    question: MotionQuestion,
    table: DhTable,
    as_read: DhTable,
    dynamics: MassProperties,
    qs: Array,
    checks: Checks,
) -> MotionSolution | None:
    """Certify formulas and numbers; return None if a formula differs from Pinocchio.

    Everything after a wrong formula follows from it, so that all formulas are left out then, which `checks` collects.
    `as_read` is the table as the formulas read it. `dynamics` has one body per row, and velocities at the
    configurations `qs` (N, n), [rad or m], in order. Raises CertificationFailed if numbers at these differ.
    """
    in_frame_0 = replace(as_read, base=np.eye(4))
    fall = np.array(question.gravity.vector)
    try:
        certificate = certify_formulas(in_frame_0, fall, question.samples, texts.values, SEED)
    except CertificationFailed as failure:
        quantity = f"{failure.quantity} of the equations of motion in symbols"
        checks.left_out(replace(failure, quantity=quantity), "the equations of motion are left out")
        return None
    notes, numeric = _notes(texts, question, len(qs)), list[NumericMotion]()
    gravity = np.array(dynamics.gravity.vector)
    if not texts.missing:
        rows = [None] * len(qs) if dynamics.velocities is None else np.asarray(dynamics.velocities)
        numeric = [numeric_motion(table, dynamics.bodies, gravity, q, v) for q, v in zip(qs, rows, strict=True)]
    judged = certify_numbers(table, dynamics.bodies, gravity, numeric) if numeric else None
    return MotionSolution(texts, numeric, motion_steps(texts), notes, certificate, judged)


def _notes(texts: MotionTexts, question: MotionQuestion, count: int) -> list[str]:
    notes = []
    if question.gravity.size and all(row == ["0"] for row in texts.gravity_vector.plain or ()):
        notes.append(
            _(
                "gravity does no work in the plane of motion, so that g(q) = 0; for an arm in a vertical plane turn "
                "the base, or give another direction of gravity"
            )
        )
    if count and texts.missing:
        text = _("M, C and g in numbers need values of {missing}: give them in `dynamics`")
        notes.append(text.format(missing=", ".join(texts.missing)))
    return notes
