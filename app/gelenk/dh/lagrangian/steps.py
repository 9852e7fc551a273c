"""The equations of motion in the order of the lecture: short texts, and the formulas that they refer to."""

from gelenk.course.steps import Step, step
from gelenk.dh.lagrangian.texts import MotionTexts
from gelenk.language import translated as _


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
