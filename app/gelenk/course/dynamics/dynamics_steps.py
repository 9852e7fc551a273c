"""The worked solution of the equations of motion, M q̈ + C q̇ + g + Jᵀγ = τ, from the bodies of the arm.

M and g are sums over the bodies, C comes from the slopes of M by Christoffel's symbols, as in the lecture.
"""

from dataclasses import dataclass

import numpy as np

from gelenk.course.steps import Step, step
from gelenk.course.writing import matrix, number, vector
from gelenk.language import translated as _
from gelenk.robot.arrays import Array

_MOST_LISTED = 3
"""Number of joints up to which Christoffel's symbols are listed one by one."""
_NOTHING = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class DynamicsQuestion:
    """An arm in motion; B bodies, n joints, vectors in the axes of the root.

    Attributes:
        masses, centers: Of the bodies, [kg], and their centres of mass, [m]; shape (B,) and (B, 3).
        inertias: About the centres of mass; shape (B, 3, 3), [kg m²].
        linear, angular: J_v of the centres of mass, and J_ω; shape (B, 3, n) each.
        slopes: ∂M/∂q_k at [:, :, k]; shape (n, n, n).
        gravity: g₀, shape (3,), [m/s²].
        q_dot: q̇; shape (n,), [rad/s or m/s].
        held: Jᵀγ, the torques for the wrench at the tip; shape (n,), [N m or N]; None without a wrench.
        accelerations, torques: q̈ for inverse, τ for forward dynamics; shape (n,). At most one of them is given.
    """

    masses: Array
    centers: Array
    inertias: Array
    linear: Array
    angular: Array
    slopes: Array
    gravity: Array
    q_dot: Array
    held: Array | None = None
    accelerations: Array | None = None
    torques: Array | None = None

    @property
    def shares(self) -> Array:
        """What each body adds to M; shape (B, n, n)."""
        by_mass = self.masses[:, None, None] * self.linear.swapaxes(1, 2) @ self.linear
        return np.asarray(by_mass + self.angular.swapaxes(1, 2) @ self.inertias @ self.angular)

    @property
    def mass_matrix(self) -> Array:
        """M; shape (n, n)."""
        return np.asarray(self.shares.sum(axis=0))

    @property
    def christoffel(self) -> Array:
        """The symbols c[i, j, k], symmetric in j and k; shape (n, n, n)."""
        D = self.slopes
        return np.asarray(0.5 * (D + D.swapaxes(1, 2) - D.transpose(2, 0, 1)))

    @property
    def coriolis(self) -> Array:
        """C; shape (n, n)."""
        return np.asarray(self.christoffel @ self.q_dot)

    @property
    def weights(self) -> Array:
        """What each body adds to g; shape (B, n), [N m or N]."""
        return np.asarray(-self.masses[:, None] * (self.linear.swapaxes(1, 2) @ self.gravity))

    @property
    def bias(self) -> Array:
        """The torques that are needed even without acceleration, C q̇ + g + Jᵀγ; shape (n,), [N m or N]."""
        held = 0.0 if self.held is None else self.held
        return np.asarray(self.coriolis @ self.q_dot + self.weights.sum(axis=0) + held)


def dynamics_steps(question: DynamicsQuestion) -> list[Step]:
    """Return the worked solution: bodies, M, C, g, and what was asked for."""
    steps = [_bodies(question), _mass_matrix(question), _coriolis(question), _gravity(question)]
    if question.accelerations is not None:
        steps.append(_inverse(question, question.accelerations))
    if question.torques is not None:
        steps.append(_forward(question, question.torques))
    return steps


def _heavy(question: DynamicsQuestion) -> list[int]:
    return np.flatnonzero(question.masses > 0.0).tolist()


def _bodies(question: DynamicsQuestion) -> Step:
    text = _(
        "All links that one joint carries are one body. Its Jacobians belong to its centre of mass, joint by joint as "
        "for the tip; joints behind the body do not move it. All is written in the axes of the root link."
    )
    lines = [r"v_{ci} = J_{v_i}\, \dot q,\quad \omega_i = J_{\omega_i}\, \dot q"]
    for b in _heavy(question):
        i = b + 1
        mass, center = number(float(question.masses[b])), vector(question.centers[b])
        lines += [
            rf"m_{{{i}}} = {mass},\quad p_{{c{i}}} = {center},\quad I_{{{i}}} = {matrix(question.inertias[b])}",
            rf"J_{{v_{{{i}}}}} = {matrix(question.linear[b])}",
            rf"J_{{\omega_{{{i}}}}} = {matrix(question.angular[b])}",
        ]
    return step(_("Bodies"), text, *lines)


def _mass_matrix(question: DynamicsQuestion) -> Step:
    rule = r"M(q) = \sum_i \left(m_i\, J_{v_i}^{\mathsf T} J_{v_i} + J_{\omega_i}^{\mathsf T} I_i\, J_{\omega_i}\right)"
    shares = [f"M_{{{b + 1}}} = {matrix(question.shares[b])}" for b in _heavy(question)]
    M, v = question.mass_matrix, question.q_dot
    energy = r"T = \frac{1}{2}\, \dot q^{\mathsf T} M(q)\, \dot q"
    text = _("The kinetic energy of the bodies is a quadratic form of the joint velocities: M is its matrix.")
    lines = [
        energy,
        rule,
        *shares,
        f"M = {matrix(M)}",
        rf"\dot q = {vector(v)},\quad T = {number(0.5 * float(v @ M @ v))}",
    ]
    return step(_("Mass matrix in numbers"), text, *lines)


def _coriolis(question: DynamicsQuestion) -> Step:
    rule = (
        r"c_{ijk} = \frac{1}{2} \left(\frac{\partial M_{ij}}{\partial q_k} + \frac{\partial M_{ik}}{\partial q_j} "
        r"- \frac{\partial M_{jk}}{\partial q_i}\right)"
    )
    lines, c, n = [rule], question.christoffel, len(question.q_dot)
    text = _("How M changes with the joints gives the centrifugal (j = k) and Coriolis terms (j ≠ k).")
    if n <= _MOST_LISTED:
        for i, j, k in np.argwhere(np.abs(c) > _NOTHING).tolist():
            if j <= k:
                same = "" if j == k else rf" = c_{{{i + 1}{k + 1}{j + 1}}}"
                lines.append(rf"c_{{{i + 1}{j + 1}{k + 1}}}{same} = {number(c[i, j, k])}")
        text += " " + _("The symbols that are not listed are zero.")
    lines += [
        rf"C_{{ij}} = \sum_k c_{{ijk}}\, \dot q_k:\quad C(q, \dot q) = {matrix(question.coriolis)}",
        rf"C\, \dot q = {vector(question.coriolis @ question.q_dot)}",
    ]
    return step(_("Coriolis and centrifugal terms"), text, *lines)


def _gravity(question: DynamicsQuestion) -> Step:
    lines = [r"g(q) = -\sum_i m_i\, J_{v_i}^{\mathsf T}\, g_0", f"g_0 = {vector(question.gravity)}"]
    lines += [f"g_{{{b + 1}}}(q) = {vector(question.weights[b])}" for b in _heavy(question)]
    lines.append(f"g(q) = {vector(question.weights.sum(axis=0))}")
    return step(_("Gravity in numbers"), _("The motors hold each weight, which pulls at its centre of mass."), *lines)


def _terms(question: DynamicsQuestion) -> list[tuple[str, Array]]:
    """Return the terms without acceleration, as they are called."""
    held = [] if question.held is None else [(r"J^{\mathsf T} \gamma", question.held)]
    return [(r"C\, \dot q", question.coriolis @ question.q_dot), ("g", question.weights.sum(axis=0)), *held]


def _inverse(question: DynamicsQuestion, a: Array) -> Step:
    inertial = question.mass_matrix @ a
    terms = [(r"M\, \ddot q", inertial), *_terms(question)]
    text = _("The torques of the motors: what accelerates the bodies, what bends their paths, what holds their weight.")
    if question.held is not None:
        text += " " + _("And what the tip pushes with, γ, against its surroundings.")
    names, numbers = " + ".join(name for name, _x in terms), " + ".join(vector(x) for _name, x in terms)
    return step(
        _("Inverse dynamics"),
        text,
        rf"\ddot q = {vector(a)},\quad M\, \ddot q = {vector(inertial)}",
        rf"\tau = {names} = {numbers}",
        rf"\tau = {vector(inertial + question.bias)}",
    )


def _forward(question: DynamicsQuestion, torques: Array) -> Step:
    rest = torques - question.bias
    a = np.linalg.solve(question.mass_matrix, rest)
    names = "".join(f" - {name}" for name, _x in _terms(question))
    numbers = "".join(f" - {vector(x)}" for _name, x in _terms(question))
    text = _("What the torques have left after the other terms accelerates the bodies: a linear system with M.")
    return step(
        _("Forward dynamics"),
        text,
        rf"M\, \ddot q = \tau{names} = {vector(torques)}{numbers} = {vector(rest)}",
        rf"\ddot q = M^{{-1}} {vector(rest)} = {vector(a)}",
    )
