"""Dynamics of a chain: M(q) q̈ + C(q, q̇) q̇ + g(q) + Jᵀγ = τ, with γ the wrench that the tip exerts on its surroundings.

The terms are Pinocchio's. Each result is compared with the Lagrangian's sums over the bodies (`bodies`), which share
only the checked description with it, and inverse dynamics must give back the torques of forward dynamics.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass, fields
from typing import get_args

import numpy as np

from gelenk.errors import InvalidField, listed
from gelenk.kinematics.dynamics.bodies import Load, motions
from gelenk.kinematics.dynamics.lagrangian import SINGULAR, Lagrangian, State, scaled, unit_scales
from gelenk.kinematics.dynamics.mechanism import ChainMechanism, PinocchioDynamics, mechanism
from gelenk.kinematics.judge.judge import Differences, sampled_rows
from gelenk.kinematics.judge.words import DynamicsCertificate, Term
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

TERMS: tuple[Term, ...] = get_args(Term)


@dataclass(frozen=True, slots=True, eq=False)
class Dynamics:
    """The requested terms at N configurations; the others are None.

    Attributes:
        is_definite: Whether M is positive definite at all recomputed configurations.
        mass_matrices, coriolis_matrices: M, and C with Ṁ - 2C skew; shape (N, n, n) each.
        coriolis_torques, gravity_torques: C q̇ and g; shape (N, n) each, [N m or N].
        kinetic_energies, potential_energies: T, and U, which is zero where the moving bodies' centre of mass is level
            with the root; shape (N,) each, [J].
        torques, accelerations: τ by inverse, q̈ by forward dynamics; shape (N, n) each, [N m or N], [rad/s² or m/s²].
    """

    is_definite: bool
    certificate: DynamicsCertificate
    mass_matrices: Array | None = None
    coriolis_matrices: Array | None = None
    coriolis_torques: Array | None = None
    gravity_torques: Array | None = None
    kinetic_energies: Array | None = None
    potential_energies: Array | None = None
    torques: Array | None = None
    accelerations: Array | None = None


def dynamics(
    robot: RobotModel,
    chain: Chain,
    state: State,
    *,
    terms: Collection[Term] = TERMS,
    gravity: Array,
    load: Load | None = None,
    accelerations: Array | None = None,
    torques: Array | None = None,
) -> Dynamics:
    """Compute and certify terms of the equations of motion, and solve them for torques or accelerations.

    Args:
        robot: The robot; joints off the chain are locked at zero.
        gravity: Gravity in the axes of the robot's root; shape (3,), [m/s²].
        accelerations, torques: q̈ for inverse, τ for forward dynamics; shape (N, n) each, as in `Dynamics`.

    Raises:
        InvalidField: The mass matrix is singular, so forward dynamics has no solution.
        CertificationFailed: The two computations differ by more than rounding.
    """
    found = mechanism(robot, chain)
    ours = _Computation(found, state, PinocchioDynamics(found, gravity, load))
    results = ours.terms(terms)
    if accelerations is not None:
        results["torques"] = ours.inverse(accelerations) + state.held
        given = {"accelerations": accelerations}
    elif torques is not None:
        results["accelerations"] = ours.forward(torques - state.held)
        given = {"torques": torques}
    else:
        given = {}
    certificate, is_definite = _certify(ours, gravity, load, results, given)
    return Dynamics(is_definite, certificate, **results)


@dataclass(frozen=True, slots=True, eq=False)
class _Computation:
    found: ChainMechanism
    state: State
    by: PinocchioDynamics

    def terms(self, terms: Collection[Term]) -> dict[str, Array]:
        """Compute the requested terms, by their field names in `Dynamics`."""
        n, by = len(self.found.chain), self.by
        found: dict[str, Array] = {}
        if "mass_matrix" in terms:
            found["mass_matrices"] = self._each((n, n), by.mass_matrix, self.state.qs)
        if {"coriolis_matrix", "coriolis_torques"} & set(terms):
            Cs = self._each((n, n), by.coriolis_matrix, self.state.qs, self.state.speeds)
            if "coriolis_matrix" in terms:
                found["coriolis_matrices"] = Cs
            if "coriolis_torques" in terms:
                found["coriolis_torques"] = np.einsum("kij,kj->ki", Cs, self.state.speeds)
        if "gravity_torques" in terms:
            found["gravity_torques"] = self._each((n,), by.gravity_torques, self.state.qs)
        if "energies" in terms:
            both = self._each((2,), by.energies, self.state.qs, self.state.speeds)
            found["kinetic_energies"], found["potential_energies"] = both.T
        return found

    def inverse(self, accelerations: Array) -> Array:
        by = self.by
        return self._each(accelerations.shape[1:], by.inverse, self.state.qs, self.state.speeds, accelerations)

    def forward(self, torques: Array) -> Array:
        by, state = self.by, self.state
        Ms = self._each((torques.shape[1],) * 2, by.mass_matrix, state.qs)
        self._refuse_singular(Ms)
        if not by.has_followers:
            return self._each(torques.shape[1:], by.forward, state.qs, state.speeds, torques)
        # A mimic joint carries a constraint torque, which the articulated body algorithm ignores.
        bias = self.inverse(np.zeros_like(torques))
        scales = unit_scales(Ms)
        rates = np.linalg.solve(scaled(Ms, scales), ((torques - bias) / scales)[..., None])[..., 0]
        return np.asarray(rates / scales)

    def _each(self, shape: tuple[int, ...], term: Callable[..., Array | tuple[float, float]], *rows: Array) -> Array:
        """Evaluate a term at each configuration; zeros for a chain without joints."""
        values = np.zeros((len(self.state.qs), *shape))
        if len(self.found.chain):
            for k, row in enumerate(zip(*rows, strict=True)):
                values[k] = term(*row)
        return values

    def _refuse_singular(self, Ms: Array) -> None:
        """Refuse forward dynamics if some motion needs no torque; names its joints, and the links without mass."""
        values, vectors = np.linalg.eigh(scaled(Ms, unit_scales(Ms)))
        if not values.size:
            return
        singular = ~(values[:, 0] > SINGULAR)
        if not singular.any():
            return
        row = int(np.argmax(singular))
        motion = np.abs(vectors[row][:, ~(values[row] > SINGULAR)]).max(axis=1)
        names = tuple(np.array(self.found.chain.joint_names)[motion > 0.1 * motion.max()].tolist())
        links = tuple(link for body in self.found.bodies if body.mass == 0.0 for link in body.links)
        without = f", and these links have no mass: {listed(links)}" if links else ""
        raise InvalidField(
            "torques",
            f"configuration {row}: the mass matrix is singular, so torques do not determine the accelerations; "
            f"no inertia beyond rounding resists a motion of {listed(names)}{without}",
        )


def _certify(
    made: _Computation,
    gravity: Array,
    load: Load | None,
    results: dict[str, Array],
    given: dict[str, Array],
    seed: int = 0,
) -> tuple[DynamicsCertificate, bool]:
    """Compare with the sums over the bodies; also return whether M is positive definite."""
    found, state = made.found, made.state
    rows = sampled_rows(len(state.qs) if len(found.chain) else 0, seed)
    worst, is_definite = Differences(), True
    if rows:
        part = State(state.qs[rows], state.speeds[rows], state.held[rows])
        judge = Lagrangian(motions(found.carried(load), part.qs, part.speeds), part, gravity)
        both = {name: values[rows] for name, values in (results | given).items()}
        worst, is_definite = judge.errors(both), judge.is_definite()
        if given:
            a, torques = both["accelerations"], both["torques"]
            worst["max_torque_error"] = judge.torque_error(a, torques)
            if "accelerations" in results:
                error = _Computation(found, part, made.by).inverse(a) + part.held - torques
                quantity = "the torque of inverse after forward dynamics"
                worst.add("max_round_trip_error", quantity, error, judge.scale(a))
    names = [field.name for field in fields(DynamicsCertificate)]
    errors = {name: worst.get(name) for name in names if name.startswith("max_")}
    return DynamicsCertificate(samples=len(rows), seed=seed, **errors), is_definite
