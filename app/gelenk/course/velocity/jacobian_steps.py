"""The worked solution of a Jacobian: columns by geometry, rank, Euler rates, time variation."""

from dataclasses import dataclass, replace

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.velocity.geometry import ChainGeometry, JointAxis
from gelenk.course.velocity.writing import matrix, number, row
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_EULER = {
    "zyz": (
        (
            r"\begin{bmatrix} 0 & -s_\varphi & c_\varphi s_\vartheta \\ 0 & c_\varphi & s_\varphi s_\vartheta \\ "
            r"1 & 0 & c_\vartheta \end{bmatrix}"
        ),
        r"-\sin\vartheta",
        r"\vartheta = 0, \pi",
    ),
    "rpy": (
        (
            r"\begin{bmatrix} c_\psi c_\vartheta & -s_\psi & 0 \\ s_\psi c_\vartheta & c_\psi & 0 \\ "
            r"-s_\vartheta & 0 & 1 \end{bmatrix}"
        ),
        r"\cos\vartheta",
        r"\vartheta = \pm\frac{\pi}{2}",
    ),
}
"""T(φ) of each kind of angles, its determinant, and where that vanishes."""

_SCREWS = {"space_screws": "world", "body_screws": "local"}
"""The view that is the same but for the order of its rows."""


@dataclass(frozen=True, slots=True)
class JacobianQuestion:
    """A Jacobian to be derived, and how.

    Attributes:
        view: `local_world_aligned`, `local`, `world`, `space_screws`, `body_screws`, `zyz` or `rpy`.
        angles: The Euler angles of the tip, for `zyz` and `rpy`; shape (3,), [rad].
        rank_tolerance: A singular value counts where it exceeds this times the largest.
        q_dot: Joint velocities for the time variation, None without it; shape (n,).
    """

    geometry: ChainGeometry
    view: str
    angles: Array
    rank_tolerance: float
    q_dot: Array | None = None


def jacobian_steps(question: JacobianQuestion) -> list[Step]:
    """Return the worked solution, from the axes of the joints to rank and time variation."""
    J, conversion = derived_jacobian(question)
    result = [
        _levers(question.geometry),
        _columns(question.geometry),
        *conversion,
        _rank(J, question.rank_tolerance, "J_a" if question.view in {"zyz", "rpy"} else "J"),
    ]
    if question.q_dot is not None:
        result.append(_time_variation(question, question.q_dot))
    return result


def _levers(geometry: ChainGeometry) -> Step:
    lines = []
    for i, joint in enumerate(geometry.joints):
        line = rf"z_{{{i}}} = {row(joint.axis)}"
        if not joint.slides:
            line += rf",\quad p_{{{i},EE}} = {row(geometry.position - joint.origin)}"
        lines.append(line)
    text = _(
        "Joint i turns about, or slides along, z of frame i-1; the lever arm leads from that frame's origin to the "
        "tip. Both are columns of A^0_(i-1), the product of the transforms before the joint: z is the third column, "
        "and the origin the last one. All are written in the base's axes."
    )
    return step(_("Axes and lever arms"), text, r"p_{i-1,EE} = p_{0,EE} - p_{0,i-1}", *lines)


def _columns(geometry: ChainGeometry) -> Step:
    lines = [
        rf"J_{{{k + 1}}} = {' + '.join(_terms(geometry, k)) or '0'} = {row(geometry.jacobian()[:, k])}"
        for k in range(geometry.variables)
    ]
    text = _(
        "A revolute joint turns the tip about its axis and moves it across the lever arm; a prismatic joint moves it "
        "along its axis and does not turn it. Linear rows stand above angular ones."
    )
    if any(joint.rate != 1.0 for joint in geometry.joints):
        text += " " + _("A joint that follows another adds to the column of that one, times its factor.")
    return step(_("Columns"), text, *lines, f"J = {matrix(geometry.jacobian())}")


def _terms(geometry: ChainGeometry, variable: int) -> list[str]:
    def term(i: int, joint: JointAxis) -> str:
        parts = (f"z_{{{i}}}", "0") if joint.slides else (rf"z_{{{i}}} \times p_{{{i},EE}}", f"z_{{{i}}}")
        factor = "" if joint.rate == 1.0 else f"{number(joint.rate)} "
        return rf"{factor}\begin{{bmatrix}} {parts[0]} \\ {parts[1]} \end{{bmatrix}}"

    return [term(i, joint) for i, joint in enumerate(geometry.joints) if joint.variable == variable]


def derived_jacobian(question: JacobianQuestion) -> tuple[Array, list[Step]]:
    """Return J in the requested view, (6, n), and the steps that lead there from the base's axes at the tip."""
    geometry, view = question.geometry, question.view
    J = geometry.jacobian()
    if view == "local_world_aligned":
        return J, []
    if view in {"zyz", "rpy"}:
        return _analytic(question, J)
    if view in _SCREWS:
        return _angular_first(question)
    if view == "local":
        R = geometry.tip[:3, :3]
        J = np.concatenate((R.T @ J[:3], R.T @ J[3:]))
        title, text = _("In the tip's axes"), _("Both halves of each column are turned into the tip's axes.")
        rule = r"J' = \begin{bmatrix} R^{\mathsf T} & 0 \\ 0 & R^{\mathsf T} \end{bmatrix} J"
        return J, [step(title, text, f"R = {matrix(R)}", f"{rule} = {matrix(J)}")]
    p = geometry.position
    J = np.concatenate((J[:3] + np.cross(p, J[3:].T).T, J[3:]))
    title = _("At the base's origin")
    text = _("The linear rows become the velocity of the point of the tip's body that passes the base's origin.")
    rule = r"J' = \begin{bmatrix} J_L + p_{EE} \times J_A \\ J_A \end{bmatrix}"
    return J, [step(title, text, f"p_{{EE}} = {row(p)}", f"{rule} = {matrix(J)}")]


def _angular_first(question: JacobianQuestion) -> tuple[Array, list[Step]]:
    J, steps = derived_jacobian(replace(question, view=_SCREWS[question.view]))
    J = np.roll(J, 3, axis=0)
    text = _(
        "A screw (ω, v) names the angular velocity first: in the order of the product of exponentials the halves of "
        "each column change places."
    )
    name = "J_s" if question.view == "space_screws" else "J_b"
    rule = rf"{name} = \begin{{bmatrix}} 0 & I \\ I & 0 \end{{bmatrix}} J' = {matrix(J)}"
    return J, [*steps, step(_("Angular rows first"), text, rule)]


def euler_rates(view: str, angles: Array) -> Array:
    """Return T(φ) with ω = T(φ) φ̇; shape (3, 3)."""
    (c1, c2, c3), (s1, s2, s3) = np.cos(angles), np.sin(angles)
    if view == "zyz":
        return np.array([[0.0, -s1, c1 * s2], [0.0, c1, s1 * s2], [1.0, 0.0, c2]])
    return np.array([[c3 * c2, -s3, 0.0], [s3 * c2, c3, 0.0], [-s2, 0.0, 1.0]])


def _analytic(question: JacobianQuestion, J: Array) -> tuple[Array, list[Step]]:
    T = euler_rates(question.view, question.angles)
    form, determinant, where = _EULER[question.view]
    analytic = np.concatenate((J[:3], np.linalg.solve(T, J[3:])))
    rates = step(
        _("Angular velocity and rates of the angles"),
        _("Each angle turns about an axis that others of the angles have turned: these axes are the columns of T."),
        rf"\omega = T(\phi)\, \dot\phi,\quad T(\phi) = {form}",
        rf"\phi = (\varphi, \vartheta, \psi) = {row(question.angles)},\quad T(\phi) = {matrix(T)}",
    )
    singular = step(
        _("Singularity of the representation"),
        _(
            "Where the determinant of T vanishes, these angles cannot follow every angular velocity. That is a fault "
            "of the angles, not of the arm: the geometric Jacobian keeps its rank there."
        ),
        rf"\det T(\phi) = {determinant} = {number(float(np.linalg.det(T)))}",
        rf"\det T(\phi) = 0 \;\Leftrightarrow\; {where}",
    )
    rule = r"J_a = \begin{bmatrix} I & 0 \\ 0 & T^{-1}(\phi) \end{bmatrix} J"
    text = _("The linear rows stay; the angular ones are multiplied by the inverse of T.")
    return analytic, [rates, singular, step(_("Analytic Jacobian"), text, f"{rule} = {matrix(analytic)}")]


def _rank(J: Array, tolerance: float, name: str) -> Step:
    sigmas = np.asarray(np.linalg.svd(J, compute_uv=False), dtype=np.float64)
    rank, (m, n) = int(np.sum((sigmas > tolerance * sigmas[:1]) & (sigmas > 0.0))), J.shape
    lines = [rf"\sigma({name}) = {row(sigmas)}", rf"\rho = \mathrm{{rank}}\, {name} = {rank} \le \min({m}, {n})"]
    if m == n:
        lines.append(rf"\det {name} = {number(float(np.linalg.det(J)))}")
    text = _("Singular values of 0 do not count: the rank is not full, and the condition number is infinite.")
    if len(sigmas) and rank == len(sigmas):
        text = _("Every singular value counts: the rank is full.")
        quotient = rf"\frac{{{number(sigmas[0])}}}{{{number(sigmas[-1])}}} = {number(sigmas[0] / sigmas[-1])}"
        lines.append(rf"\mathrm{{cond}}\, {name} = \frac{{\sigma_{{max}}}}{{\sigma_{{min}}}} = {quotient}")
    return step(_("Rank and condition"), text, *lines)


def time_variation(question: JacobianQuestion, q_dot: Array) -> tuple[Array, str]:
    """Return dJ/dt in the requested view, shape (6, n), and its formula; empty in the base's axes at the tip."""
    geometry = question.geometry
    J, dJ = geometry.jacobian(), geometry.time_variation(q_dot)
    v, w = J[:3] @ q_dot, J[3:] @ q_dot
    if question.view in _SCREWS:
        same, rule = time_variation(replace(question, view=_SCREWS[question.view]), q_dot)
        name = "J_s" if question.view == "space_screws" else "J_b"
        return np.roll(same, 3, axis=0), rf"{rule},\quad \dot {name}"
    if question.view == "local":
        R = geometry.tip[:3, :3].T
        halves = [R @ (rates - np.cross(w, part.T).T) for part, rates in ((J[:3], dJ[:3]), (J[3:], dJ[3:]))]
        return np.concatenate(halves), r"\dot J' = R^{\mathsf T} (\dot J - \omega \times J)"
    if question.view == "world":
        linear = dJ[:3] + np.cross(v, J[3:].T).T + np.cross(geometry.position, dJ[3:].T).T
        rule = r"\dot J_L' = \dot J_L + \dot p_{EE} \times J_A + p_{EE} \times \dot J_A,\quad \dot J'"
        return np.concatenate((linear, dJ[3:])), rule
    if question.view in {"zyz", "rpy"}:
        T = euler_rates(question.view, question.angles)
        dT = euler_rates_variation(question.view, question.angles, np.asarray(np.linalg.solve(T, w), dtype=np.float64))
        angular = np.linalg.solve(T, dJ[3:] - dT @ np.linalg.solve(T, J[3:]))
        rule = r"\dot J_{a,A} = T^{-1} (\dot J_A - \dot T\, T^{-1} J_A),\quad \dot J_a"
        return np.concatenate((dJ[:3], angular)), rule
    return dJ, ""


def _time_variation(question: JacobianQuestion, q_dot: Array) -> Step:
    dJ, rule = time_variation(question, q_dot)
    turning = (
        r"\begin{bmatrix} \dot z_{i-1} \times p_{i-1,EE} + z_{i-1} \times \dot p_{i-1,EE} \\ \dot z_{i-1} \end{bmatrix}"
    )
    lines = [
        r"\dot z_{i-1} = \omega_{i-1} \times z_{i-1},\quad \dot p_{i-1,EE} = \dot p_{EE} - \dot p_{i-1}",
        rf"\dot J_i = {turning},\quad \dot J_i = \begin{{bmatrix}} \dot z_{{i-1}} \\ 0 \end{{bmatrix}}",
        rf"\dot q = {row(q_dot)}",
        r"\dot J = \sum_j \frac{\partial J}{\partial q_j} \dot q_j = "
        + matrix(question.geometry.time_variation(q_dot)),
    ]
    if rule:
        lines.append(f"{rule} = {matrix(dJ)}")
    text = _(
        "The columns are differentiated by the product rule: an axis turns with the bodies before it, a lever arm "
        "changes with the velocities of its ends. Left a revolute joint, right a prismatic one."
    )
    return step(_("Time variation"), text, *lines)


def euler_rates_variation(view: str, angles: Array, rates: Array) -> Array:
    """Return dT/dt at given rates of the angles, by the derivative of each entry; shape (3, 3)."""
    (c1, c2, c3), (s1, s2, s3) = np.cos(angles), np.sin(angles)
    d1, d2, d3 = rates
    if view == "zyz":
        return np.array(
            [
                [0.0, -c1 * d1, -s1 * s2 * d1 + c1 * c2 * d2],
                [0.0, -s1 * d1, c1 * s2 * d1 + s1 * c2 * d2],
                [0.0, 0.0, -s2 * d2],
            ]
        )
    return np.array(
        [
            [-s3 * c2 * d3 - c3 * s2 * d2, -c3 * d3, 0.0],
            [c3 * c2 * d3 - s3 * s2 * d2, -s3 * d3, 0.0],
            [-c2 * d2, 0.0, 0.0],
        ]
    )
