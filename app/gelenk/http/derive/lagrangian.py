"""The equations of motion of a worked solution as JSON content."""

from collections.abc import Sequence
from typing import Any

from gelenk.dh.derive.typeset import MatrixText, Text
from gelenk.dh.lagrangian.check import EquationCertificate
from gelenk.dh.lagrangian.numeric import NumericMotion
from gelenk.dh.lagrangian.solution import MotionSolution
from gelenk.dh.lagrangian.texts import BodyText


def matrix_content(name: str, matrix: MatrixText | None) -> dict[str, Any]:
    """Return a matrix as JSON content; null in place of one that is too long."""
    if matrix is None:
        return {"name": name, "latex": None, "plain": None}
    return {"name": name, "latex": matrix.latex, "plain": matrix.plain}


def formula_content(text: Text) -> dict[str, str]:
    """Return a formula in both notations."""
    return {"latex": text.latex, "plain": text.plain}


def motion_content(solution: MotionSolution, joint_names: Sequence[str]) -> dict[str, Any]:
    """Return the equations of motion with their numbers and certificates."""
    found = solution.texts
    judged = solution.numeric_certificate
    return {
        "gravity": matrix_content("g", found.gravity),
        "links": [
            _link(name, i, body) for i, (name, body) in enumerate(zip(joint_names, found.bodies, strict=True), 1)
        ],
        "mass_matrix": matrix_content("M", found.mass_matrix),
        "christoffel": [{"i": c.i, "j": c.j, "k": c.k, **formula_content(c.formula)} for c in found.christoffel],
        "coriolis": matrix_content("C", found.coriolis),
        "coriolis_vector": matrix_content("C qd", found.coriolis_vector),
        "gravity_vector": matrix_content("g", found.gravity_vector),
        "skew": matrix_content("Md - 2 C", found.skew),
        "equations_of_motion": [formula_content(row) for row in found.rows],
        "numeric": [_numbers(one) for one in solution.numeric],
        "certificate": _certificate(solution.certificate),
        "numeric_certificate": None if judged is None else _certificate(judged),
    }


def _link(joint: str, i: int, body: BodyText) -> dict[str, Any]:
    return {
        "joint": joint,
        "center_of_mass": matrix_content(f"p_c{i}", body.center),
        "velocity": matrix_content(f"v_c{i}", body.velocity),
        "angular_velocity": formula_content(body.angular_velocity),
        "kinetic_energy": formula_content(body.kinetic),
        "potential_energy": formula_content(body.potential),
    }


def _numbers(one: NumericMotion) -> dict[str, Any]:
    C, vector = one.coriolis, one.coriolis_vector
    return {
        "joint_positions": one.q.tolist(),
        "joint_velocities": None if one.v is None else one.v.tolist(),
        "mass_matrix": one.mass_matrix.tolist(),
        "coriolis": None if C is None else C.tolist(),
        "coriolis_vector": None if vector is None else vector.tolist(),
        "gravity_vector": one.gravity_vector.tolist(),
    }


def _certificate(certificate: EquationCertificate) -> dict[str, Any]:
    return {
        "samples": certificate.samples,
        "max_mass_matrix_error": certificate.mass_matrix,
        "max_coriolis_error": certificate.coriolis,
        "max_gravity_error": certificate.gravity,
        "seed": certificate.seed,
    }
