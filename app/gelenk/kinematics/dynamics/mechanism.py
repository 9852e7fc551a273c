"""A robot reduced to the joints that one chain's variables move, and Pinocchio's dynamics in these variables.

All other joints are locked at zero: a hand and its fingers become one body, and Pinocchio's model has no unneeded
joints. With q_model = q₀ + E q, mimic joints included, constraint forces do no work and

    τ = Eᵀ τ_model,    M = Eᵀ M_model E,    C = Eᵀ C_model E    (E is constant, so Ṁ - 2C stays skew).

The root link is at rest, and gravity is given in its axes.
"""

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np
import pinocchio as pin

from gelenk.kinematics.dynamics.bodies import Load, RigidBody, bodies, loaded, locked
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

STANDARD_GRAVITY = (0.0, 0.0, -9.81)
"""Standard gravity, along -z of the root, [m/s²]."""
_KEPT = 16
"""Number of mechanisms cached per robot: building one takes milliseconds."""


@dataclass(frozen=True, slots=True, eq=False)
class ChainMechanism:
    """A robot whose joints are locked except those that a chain moves.

    Attributes:
        chain: The chain in this robot, with the same variables.
        without_mass: Names of moved links without mass that have a shape or belong to a body without mass; a mere frame
            on a body with mass is omitted.
        base, tip: Pinocchio's joint that carries each of them (0 for none), and its placement on that joint.
    """

    robot: RobotModel
    chain: Chain
    bodies: tuple[RigidBody, ...]
    without_mass: tuple[str, ...]
    base: tuple[int, pin.SE3]
    tip: tuple[int, pin.SE3]

    def carried(self, load: Load | None) -> tuple[RigidBody, ...]:
        """Return the bodies, including a payload if there is one that moves."""
        if load is None or not self.moves_tip:
            return self.bodies
        return *self.bodies, loaded(self.robot.description, self.chain, load)

    @property
    def moves_tip(self) -> bool:
        """Whether the tip moves relative to the root; false if the chain leads up to the root."""
        return self.tip[0] > 0


_known: WeakKeyDictionary[RobotModel, dict[tuple[str, str], ChainMechanism]] = WeakKeyDictionary()
_lock = threading.Lock()


def known_mechanism(robot: RobotModel, chain: Chain) -> ChainMechanism | None:
    """Return the cached mechanism of a chain, if any."""
    with _lock:
        return _known.get(robot, {}).get((chain.base_frame, chain.tip_frame))


def mechanism(robot: RobotModel, chain: Chain) -> ChainMechanism:
    """Return the mechanism of a chain, built once and cached."""
    found = known_mechanism(robot, chain)
    if found is not None:
        return found
    description = locked(robot.description, chain)
    ends = chain.base_frame, chain.tip_frame
    made = RobotModel(description, ends)
    parts = bodies(description, chain)
    base, tip = (_carrier(made, frame) for frame in ends)
    found = ChainMechanism(made, made.chain(*ends), parts, _without_mass(robot, parts), base, tip)
    with _lock:
        by_ends = _known.setdefault(robot, {})
        if len(by_ends) >= _KEPT:
            del by_ends[next(iter(by_ends))]
        by_ends[ends] = found
    return found


def _carrier(robot: RobotModel, frame: str) -> tuple[int, pin.SE3]:
    found = robot.model.frames[robot.frame_id(frame)]
    return int(found.parentJoint), found.placement.copy()


def _without_mass(robot: RobotModel, parts: Sequence[RigidBody]) -> tuple[str, ...]:
    shaped = {link.name for link in robot.description.links if link.shapes}
    heavy = {link.name for link in robot.description.links if link.inertial is not None and link.inertial.mass > 0.0}
    return tuple(
        name for body in parts for name in body.links if name not in heavy and (name in shaped or body.mass == 0.0)
    )


class PinocchioDynamics:
    """Pinocchio's algorithms on a mechanism, with their own model and work space, so that threads need no lock.

    Not for a chain without joints, on which Pinocchio's algorithms crash. Gravity is in the root's axes, [m/s²].
    """

    def __init__(self, found: ChainMechanism, gravity: Array, load: Load | None = None) -> None:
        robot, chain = found.robot, found.chain
        self._model = pin.Model(robot.model)
        self._model.gravity = pin.Motion(gravity, np.zeros(3))
        self._base, self._tip = found.base, found.tip
        if load is not None and found.moves_tip:
            inertia = pin.Inertia(load.mass, load.center, load.inertia)
            self._model.appendBodyToJoint(self._tip[0], inertia, self._tip[1])
        self._data = self._model.createData()
        expansion = robot.expansion(chain)
        self._offset, self._matrix = expansion.offset, expansion.matrix
        self._upper = ~np.tri(self._model.nv, k=-1, dtype=bool)
        # Without mimic joints the matrix is a permutation.
        self.has_followers = self._matrix.shape[0] != self._matrix.shape[1]

    def mass_matrix(self, q: Array) -> Array:
        """Compute M by the composite rigid body algorithm [Featherstone2008, 6.2]; shape (n, n)."""
        M = np.asarray(pin.crba(self._model, self._data, self._full(q))).reshape(self._square)
        # Pinocchio fills only the upper triangle.
        return self._reduced(np.where(self._upper, M, M.T))

    def coriolis_matrix(self, q: Array, v: Array) -> Array:
        """Compute the C for which Ṁ - 2C is skew [Echeandia2021]; shape (n, n)."""
        C = pin.computeCoriolisMatrix(self._model, self._data, self._full(q), self._matrix @ v)
        return self._reduced(np.asarray(C).reshape(self._square))

    def gravity_torques(self, q: Array) -> Array:
        """Compute g(q); shape (n,), [N m or N]."""
        return self._torques(pin.computeGeneralizedGravity(self._model, self._data, self._full(q)))

    def inverse(self, q: Array, v: Array, a: Array) -> Array:
        """Compute τ = M q̈ + C q̇ + g by recursive Newton-Euler [Featherstone2008, 5.3]; shape (n,), [N m or N]."""
        matrix = self._matrix
        return self._torques(pin.rnea(self._model, self._data, self._full(q), matrix @ v, matrix @ a))

    def inverses(self, qs: Array, vs: Array, accelerations: Array) -> Array:
        """Compute `inverse` of N states without Python between them; shape (N, n) each → (N, n), [N m or N]."""
        rates = (self._matrix @ rows.T for rows in (vs, accelerations))
        states = self._offset[:, None] + self._matrix @ qs.T, *rates
        full = np.asarray(pin.rneaInParallel(1, pin.ModelPool(self._model, 1), *states))
        return np.asarray(full.reshape(states[0].shape).T @ self._matrix)

    def forward(self, q: Array, v: Array, torques: Array) -> Array:
        """Compute q̈ by the articulated body algorithm [Featherstone2008, 7.3]; shape (n,). Not with mimic joints."""
        matrix = self._matrix
        a = pin.aba(self._model, self._data, self._full(q), matrix @ v, matrix @ torques)
        return np.asarray(matrix.T @ np.asarray(a).reshape(-1))

    def energies(self, q: Array, v: Array) -> tuple[float, float]:
        """Compute T and U, [J]; U is zero where the moving bodies' centre of mass is level with the root."""
        full_q = self._full(q)
        kinetic = pin.computeKineticEnergy(self._model, self._data, full_q, self._matrix @ v)
        return float(kinetic), float(pin.computePotentialEnergy(self._model, self._data, full_q))

    def static_torques(self, q: Array, v: Array, point: Array, wrench: Array) -> tuple[Array, float]:
        """Compute torques that hold the robot while its tip exerts a wrench, and the power of that wrench at q̇.

        The tip exerts the wrench on surroundings at rest in the base frame: if the chain moves the base relative to the
        root, the reaction acts on the base. The force acts at `point`, [m], in the base frame, whose axes are also
        those of the wrench, shape (6,), [N] and [N m].
        """
        model, data, full_q = self._model, self._data, self._full(q)
        pin.forwardKinematics(model, data, full_q, self._matrix @ v)
        T_root_base = data.oMi[self._base[0]] * self._base[1]
        force = (T_root_base * pin.SE3(np.eye(3), point)).act(pin.Force(wrench[:3], wrench[3:]))
        forces = [pin.Force.Zero() for _ in range(model.njoints)]
        twist = pin.Motion.Zero()
        for sign, joint in ((1.0, self._tip[0]), (-1.0, self._base[0])):
            twist += sign * data.oMi[joint].act(data.v[joint])
            # The surroundings exert the opposite force on the robot.
            forces[joint] -= sign * data.oMi[joint].actInv(force)
        vector = pin.StdVec_Force()
        vector.extend(forces)
        torques = pin.computeStaticTorque(model, data, full_q, vector)
        return self._torques(torques), float(force.dot(twist))

    @property
    def _square(self) -> tuple[int, int]:
        return self._model.nv, self._model.nv

    def _full(self, q: Array) -> Array:
        return np.asarray(self._offset + self._matrix @ q)

    def _torques(self, full: Array) -> Array:
        return np.asarray(self._matrix.T @ np.asarray(full).reshape(-1))

    def _reduced(self, full: Array) -> Array:
        return np.asarray(self._matrix.T @ full @ self._matrix)
