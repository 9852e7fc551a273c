"""Comparison of equations of motion with Pinocchio, whose model is built from the table alone, each link a body.

Pinocchio's recursive algorithms use neither T nor Christoffel symbols. The symbols follow from its torques at chosen
velocities: with h(v) the torque that velocity v costs, 2 c_ijk = h_i(e_j + e_k) - h_i(e_j) - h_i(e_k).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pinocchio as pin

from gelenk.dh.derive.check import TOLERANCE
from gelenk.dh.lagrangian.bodies import LinkBody
from gelenk.dh.lagrangian.numeric import NumericMotion, centers_in_frames
from gelenk.dh.lagrangian.texts import EquationsCertificate, MotionSample
from gelenk.errors import certify
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable


class Judge:
    """Pinocchio's model of the arm with its bodies, one per row; a quantity that was left out counts as zero.

    `gravity` (3,) is free fall in the base, [m/s²].
    """

    def __init__(self, table: DhTable, bodies: Sequence[LinkBody], gravity: Array) -> None:
        self.model, centers = pin.Model(), centers_in_frames(table, bodies)
        self._scales = _Scales(table, bodies, np.array(centers), gravity)
        self._levers: list[Array] = []  # Pinocchio stores none for a body without mass
        standard, joint, placement = table.convention == "standard", 0, table.base
        for row, body, center in zip(table.joints, bodies, centers, strict=True):
            A = row.transform(0.0, table.convention)
            kind = pin.JointModelRZ() if row.type == "revolute" else pin.JointModelPZ()
            before, behind = (placement, A) if standard else (placement @ A, np.eye(4))
            joint = self.model.addJoint(joint, kind, pin.SE3(before), row.name)
            lever = behind[:3, :3] @ center + behind[:3, 3]
            self._levers.append(lever)
            inertia = pin.Inertia(body.mass or 0.0, lever, (body.inertia or 0.0) * np.eye(3))
            self.model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
            placement = behind
        self.model.gravity = pin.Motion(gravity, np.zeros(3))
        self.data = self.model.createData()

    def mass_matrix(self, q: Array) -> Array:
        """Return M; shape (n, n)."""
        upper = np.triu(pin.crba(self.model, self.data, q))
        M: Array = upper + np.triu(upper, 1).T
        return M

    def gravity_vector(self, q: Array) -> Array:
        """Return g; shape (n,)."""
        return np.array(pin.computeGeneralizedGravity(self.model, self.data, q)).reshape(-1)

    def christoffel(self, q: Array) -> Array:
        """Return the Christoffel symbols c[i, j, k]; shape (n, n, n)."""
        n = self.model.nv
        unit, g = np.eye(n), self.gravity_vector(q)
        alone = [self._costs(q, unit[j], g) for j in range(n)]
        c = np.zeros((n, n, n))
        for j in range(n):
            for k in range(j, n):
                both = self._costs(q, unit[j] + unit[k], g) if j != k else 4.0 * alone[j]
                c[:, j, k] = c[:, k, j] = (both - alone[j] - alone[k]) / 2.0
        return c

    def _costs(self, q: Array, v: Array, g: Array) -> Array:
        bias = np.array(pin.nonLinearEffects(self.model, self.data, q, v)).reshape(-1)
        costs: Array = bias - g
        return costs

    def bodies(self, q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
        """Return centres of mass in the base, their velocities, kinetic and potential energies, one row per body."""
        pin.forwardKinematics(self.model, self.data, q, v)
        found = []
        for joint, lever in enumerate(self._levers, start=1):
            T, inertia, twist = self.data.oMi[joint], self.model.inertias[joint], self.data.v[joint]
            center = T.act(lever)
            velocity = T.rotation @ (twist.linear + np.cross(twist.angular, lever))
            height = -inertia.mass * float(self.model.gravity.linear @ center)
            found.append((center, velocity, 0.5 * inertia.vtiv(twist), height))
        centers, velocities, kinetic, potential = (np.array(column) for column in zip(*found, strict=True))
        return centers, velocities, kinetic, potential

    def compare(self, name: str, ours: object, judged: Array, scale: float = 1.0) -> float:
        """Return the largest difference from Pinocchio's; raises CertificationFailed beyond rounding at that scale."""
        error = float(np.abs(np.asarray(ours, dtype=float) - judged).max())
        tolerance = TOLERANCE * max(1.0, scale, float(np.abs(judged).max()))
        certify(name, error, tolerance)
        return error

    def errors(self, q: Array, M: object, c: object, g: object) -> tuple[float, float, float]:
        """Return the largest differences of M, the Christoffel symbols and g from Pinocchio's; raises as `compare`."""
        inertia, weight = self._scales.at(q)
        return (
            self.compare("the mass matrix", M, self.mass_matrix(q), inertia),
            self.compare("a Christoffel symbol", c, self.christoffel(q), inertia),
            self.compare("the gravity vector", g, self.gravity_vector(q), weight),
        )

    def energies_error(self, sample: MotionSample, value: Mapping[str, Any]) -> None:
        """Compare what M, C and g are derived from, and what follows from them; raises as `compare`."""
        q, v, a = np.array(sample.q), np.array(sample.v), np.array(sample.a)
        inertia, weight = self._scales.at(q)
        centers, velocities, kinetic, potential = self.bodies(q, v)
        M, C = self.mass_matrix(q), self.christoffel(q) @ v
        rate = C + C.T  # Ṁ, as the Christoffel symbols give it
        self.compare("a centre of mass", value["centers"], centers, self._scales.reach)
        self.compare("the velocity of a centre of mass", value["velocities"], velocities, self._scales.reach)
        self.compare("a kinetic energy", value["kinetic"], kinetic, inertia)
        self.compare("a potential energy", value["potential"], potential, weight)
        self.compare("the Coriolis matrix", value["coriolis"], C, inertia)
        self.compare("the Coriolis vector", value["coriolis_vector"], C @ v, inertia)
        self.compare("Ṁ - 2C", value["skew"], rate - 2.0 * C, inertia)
        torques = np.array(pin.rnea(self.model, self.data, q, v, a)).reshape(-1)
        self.compare("the torques", value["torques"], torques, inertia + weight + float(np.abs(M).max()))


class _Scales:
    """Sizes of the terms that add up: rounding grows with them, even if they cancel."""

    def __init__(self, table: DhTable, bodies: Sequence[LinkBody], centers: Array, gravity: Array) -> None:
        lengths = sum(abs(row.a) + abs(row.d) for row in table.joints) + float(np.abs(table.base[:3, 3]).sum())
        self.reach = lengths + float(np.abs(centers).sum())
        self._mass = sum(body.mass or 0.0 for body in bodies)
        self._inertia = sum(body.inertia or 0.0 for body in bodies)
        self._gravity = float(np.linalg.norm(gravity))
        self._slides = [row.type == "prismatic" for row in table.joints]

    def at(self, q: Array) -> tuple[float, float]:
        """Return the largest sum of inertias, [kg m²], and of weights, [N m], at a configuration."""
        reach = max(1.0, self.reach + float(np.abs(q[self._slides]).sum()))
        return self._mass * reach**2 + self._inertia, self._mass * self._gravity * reach


def certify_formulas(
    table: DhTable, gravity: Array, samples: Sequence[MotionSample], values: Sequence[Mapping[str, Any]], seed: int
) -> EquationsCertificate:
    """Compare the values of every formula with Pinocchio at the samples, which have a number for every symbol.

    The formulas are written in frame 0: so the table, as they read it, counts without its base, and `gravity` (3,),
    [m/s²], is in that frame. Raises CertificationFailed if one differs by more than rounding.
    """
    worst = np.zeros(3)
    for sample, value in zip(samples, values, strict=True):
        judge = Judge(table, sample.bodies, gravity)
        found = judge.errors(np.array(sample.q), value["mass_matrix"], value["christoffel"], value["gravity_vector"])
        judge.energies_error(sample, value)
        worst = np.maximum(worst, found)
    return _certificate(len(samples), worst, seed)


def certify_numbers(
    table: DhTable, bodies: Sequence[LinkBody], gravity: Array, found: Sequence[NumericMotion]
) -> EquationsCertificate:
    """Compare M, C and g at given configurations with Pinocchio's; raises CertificationFailed if one differs."""
    judge, worst = Judge(table, bodies, gravity), np.zeros(3)
    for one in found:
        worst = np.maximum(worst, judge.errors(one.q, one.mass_matrix, one.christoffel, one.gravity_vector))
    return _certificate(len(found), worst, None)


def _certificate(samples: int, worst: Array, seed: int | None) -> EquationsCertificate:
    mass_matrix, coriolis, gravity = worst.tolist()
    return EquationsCertificate(samples, mass_matrix, coriolis, gravity, seed)
