"""Dynamics of a chain: M(q) q̈ + C(q, q̇) q̇ + g(q) + Jᵀγ = τ, with γ the wrench that the tip exerts on its surroundings.

The terms are Pinocchio's. Each result is compared with the Lagrangian's sums over the bodies (`bodies`), which share
only the checked description with it, and inverse dynamics must give back the torques of forward dynamics.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from gelenk.errors import InvalidField, listed
from gelenk.kinematics.dynamics.bodies import Load, motions
from gelenk.kinematics.dynamics.lagrangian import SINGULAR, Lagrangian, State, scaled, unit_scales
from gelenk.kinematics.dynamics.mechanism import ChainMechanism, PinocchioDynamics, mechanism
from gelenk.kinematics.judge.judge import agreed, sampled_rows
from gelenk.kinematics.judge.words import DynamicsCertificate
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

Term: TypeAlias = Literal["mass_matrix", "coriolis_matrix", "coriolis_torques", "gravity_torques", "energies"]
TERMS: tuple[Term, ...] = ("mass_matrix", "coriolis_matrix", "coriolis_torques", "gravity_torques", "energies")


@dataclass(frozen=True, slots=True, eq=False)
class Dynamics:
    """The requested terms at N configurations; the others are None.

    Attributes:
        mass_matrices: M; shape (N, n, n).
        coriolis_matrices: C, with Ṁ - 2C skew; shape (N, n, n).
        coriolis_torques: C q̇; shape (N, n), [N m or N].
        gravity_torques: g; shape (N, n), [N m or N].
        kinetic_energies: T; shape (N,), [J].
        potential_energies: U, zero where the moving bodies' centre of mass is level with the root; shape (N,), [J].
        torques: τ by inverse dynamics; shape (N, n), [N m or N].
        accelerations: q̈ by forward dynamics; shape (N, n), [rad/s² or m/s²].
        is_definite: Whether M is positive definite at all recomputed configurations.
        certificate: Differences from the second computation.
    """

    mass_matrices: Array | None
    coriolis_matrices: Array | None
    coriolis_torques: Array | None
    gravity_torques: Array | None
    kinetic_energies: Array | None
    potential_energies: Array | None
    torques: Array | None
    accelerations: Array | None
    is_definite: bool
    certificate: DynamicsCertificate


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
        chain: Base and tip.
        state: Configurations, velocities and the torques of the wrench at the tip.
        terms: The requested terms.
        gravity: Gravity in the axes of the robot's root; shape (3,), [m/s²].
        load: A payload on the tip.
        accelerations: q̈, for inverse dynamics; shape (N, n), [rad/s² or m/s²].
        torques: τ, for forward dynamics; shape (N, n), [N m or N].

    Raises:
        InvalidField: The mass matrix is singular, so forward dynamics has no solution.
        CertificationFailed: The two computations differ by more than rounding.
    """
    found = mechanism(robot, chain)
    by = PinocchioDynamics(found, gravity, load)
    ours = _Computation(found, state, by)
    wanted = ours.terms(terms)
    if accelerations is not None:
        wanted["torques"] = ours.inverse(accelerations) + state.held
    elif torques is not None:
        wanted["accelerations"] = ours.forward(torques - state.held)
    certificate, is_definite = _certify(ours, gravity, load, wanted, accelerations, torques)
    return Dynamics(**{name: wanted.get(name) for name in _ARRAYS}, is_definite=is_definite, certificate=certificate)


_ARRAYS = (
    "mass_matrices",
    "coriolis_matrices",
    "coriolis_torques",
    "gravity_torques",
    "kinetic_energies",
    "potential_energies",
    "torques",
    "accelerations",
)


class _Computation:
    """Pinocchio's dynamics for a batch of states."""

    def __init__(self, found: ChainMechanism, state: State, by: PinocchioDynamics) -> None:
        self.found, self.state, self.by = found, state, by

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
        """Compute τ from q̈; shape (N, n), [N m or N]."""
        by = self.by
        return self._each(accelerations.shape[1:], by.inverse, self.state.qs, self.state.speeds, accelerations)

    def forward(self, torques: Array) -> Array:
        """Compute q̈ from τ; shape (N, n), [rad/s² or m/s²]."""
        by, state = self.by, self.state
        Ms = self._each((torques.shape[1],) * 2, by.mass_matrix, state.qs)
        self._refuse_singular(Ms)
        if not by.has_followers:
            return self._each(torques.shape[1:], by.forward, state.qs, state.speeds, torques)
        # A mimic joint carries a constraint torque, which the articulated body algorithm ignores.
        bias = self.inverse(np.zeros_like(torques))
        scales = unit_scales(Ms)
        accelerations: Array = (
            np.linalg.solve(scaled(Ms, scales), ((torques - bias) / scales)[..., None])[..., 0] / scales
        )
        return accelerations

    def _each(self, shape: tuple[int, ...], term: Callable[..., Array | tuple[float, float]], *rows: Array) -> Array:
        """Evaluate a term at each configuration; zeros for a chain without joints."""
        values = np.zeros((len(self.state.qs), *shape))
        if len(self.found.chain):
            for k, row in enumerate(zip(*rows, strict=True)):
                values[k] = term(*row)
        return values

    def _refuse_singular(self, Ms: Array) -> None:
        """Refuse forward dynamics if some motion needs no torque.

        Raises:
            InvalidField: A mass matrix is singular; names the joints involved, and the links without mass.
        """
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
    wanted: dict[str, Array],
    accelerations: Array | None,
    torques: Array | None,
    seed: int = 0,
) -> tuple[DynamicsCertificate, bool]:
    """Compare with the sums over the bodies; also return whether M is positive definite."""
    found, state = made.found, made.state
    rows = sampled_rows(len(state.qs) if len(found.chain) else 0, seed)
    if not rows:
        return DynamicsCertificate(0, *(None,) * 7, seed), True
    ours = {name: values[rows] for name, values in wanted.items()}
    part = State(state.qs[rows], state.speeds[rows], state.held[rows])
    judge = Lagrangian(motions(found.carried(load), part.qs, part.speeds), part, gravity)
    given_a = ours.get("accelerations") if accelerations is None else accelerations[rows]
    given_t = ours.get("torques") if torques is None else torques[rows]
    torque_error = round_trip = None
    if given_a is not None and given_t is not None:
        torque_error = judge.torque_error(given_a, given_t)
        if "accelerations" in ours:
            again = _Computation(found, part, made.by).inverse(given_a) + part.held
            round_trip = agreed("the torque of inverse after forward dynamics", again - given_t, judge.scale(given_a))
    certificate = DynamicsCertificate(
        len(rows),
        judge.mass_error(ours.get("mass_matrices")),
        judge.coriolis_error(ours.get("coriolis_torques")),
        judge.skew_error(ours.get("coriolis_matrices")),
        judge.gravity_error(ours.get("gravity_torques")),
        judge.energy_error(ours.get("kinetic_energies"), ours.get("potential_energies")),
        torque_error,
        round_trip,
        seed,
    )
    return certificate, judge.is_definite()
