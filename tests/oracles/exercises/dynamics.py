"""Solutions by energies and their differences."""

from typing import Any

import numpy as np

from tests.oracles.dh_columns import Table
from tests.oracles.lagrangian import Arm, Link

G = (0.0, -9.81, 0.0)


def pendulum(one: Any) -> dict[str, Any]:
    arm = Arm(Table(True, [(one.center, 0.0, 0.0, 0.0)], (False,)), [Link(one.mass, (0, 0, 0), one.inertia)], G)
    q = np.radians([one.angle])
    inertia, gravity = arm.mass_matrix(q)[0, 0], arm.gravity_vector(q)[0]
    return {"inertia": inertia, "gravity": gravity, "torque": inertia * one.acceleration + gravity}


def everything(one: Any) -> dict[str, Any]:
    rows = [(one.length, 0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)]
    links = [Link(one.m1, (one.c1 - one.length, 0, 0), one.i1), Link(one.m2, (one.c2 - 1.0, 0, 0), one.i2)]
    arm = Arm(Table(True, rows, (False, False)), links, G)
    q, v, a = np.radians([one.q1, one.q2]), np.array([one.v1, one.v2]), np.array([one.a1, one.a2])
    M, g = arm.mass_matrix(q), arm.gravity_vector(q)
    speed = arm.christoffel(q) @ v @ v
    release = np.linalg.inv(M) @ -g
    return {"mass": M, "speed": speed, "gravity": g, "torque": M @ a + speed + g, "release": release}


def only(*names: str) -> Any:
    return lambda one: {name: everything(one)[name] for name in names}


SOLUTIONS = {
    "dynamics.pendulum": pendulum,
    "dynamics.gravity": only("gravity"),
    "dynamics.mass_matrix": only("mass"),
    "dynamics.coriolis": only("speed"),
    "dynamics.equations": everything,
}
DIGESTS = {
    "dynamics.pendulum:1": "ac95e6a338abdc77",
    "dynamics.gravity:1": "072d59daa74127b4",
    "dynamics.mass_matrix:1": "d02d140627179edf",
    "dynamics.coriolis:1": "64d362a89fe7ab67",
    "dynamics.equations:1": "bcac9e580a7e1a90",
}
