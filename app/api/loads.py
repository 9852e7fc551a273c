"""What a robot bears as a request says it, for statics and dynamics: gravity, payload, wrenches at a point."""

from collections.abc import Sequence

import numpy as np

from app.kinematics.bodies import Load
from app.kinematics.mechanism import STANDARD_GRAVITY, Mechanism
from app.kinematics.wrenches import WrenchFrame
from app.model.arrays import Array
from app.model.errors import InvalidField, listed
from app.schemas.statics import PayloadInfo, WrenchRequest


def gravity_of(value: bool | Sequence[float]) -> Array | None:
    """The vector in the root's axes, [m/s²]; None where there is none."""
    if isinstance(value, bool):
        return np.array(STANDARD_GRAVITY) if value else None
    return np.array(value, dtype=float)


def load_of(payload: PayloadInfo | None) -> Load | None:
    """The payload as the core takes it.

    Raises:
        InvalidField: No body has this inertia.
    """
    if payload is None:
        return None
    inertia = np.zeros((3, 3))
    if payload.inertia is not None:
        ixx, ixy, ixz, iyy, iyz, izz = payload.inertia
        inertia = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
        moments = np.linalg.eigvalsh(inertia)
        slack = 1e-9 * np.abs(moments).max()
        # Each moment is the sum of two of the positive integrals of x², y² and z².
        if moments[0] + moments[1] < moments[2] - slack or moments[0] < -slack:
            raise InvalidField(
                "payload",
                "no body has this inertia: its principal moments must not be negative, and none larger than the sum "
                "of the two others",
            )
    return Load(payload.mass, np.array(payload.center_of_mass, dtype=float), inertia)


def wrench_frame(call: WrenchRequest) -> WrenchFrame:
    """Axes and point of the wrenches."""
    point = None if call.point is None else (call.point[0], call.point[1], call.point[2])
    return WrenchFrame(call.reference, call.expressed_in, point, call.point_frame)


def wrench_rows(wrenches: Sequence[Sequence[float]], count: int, components: Sequence[str]) -> Array:
    """One wrench a configuration; shape (N, m), [N] and [Nm].

    Raises:
        InvalidField: Their number, or that of the components, does not fit.
    """
    for i, wrench in enumerate(wrenches):
        if len(wrench) != len(components):
            raise InvalidField(
                "wrenches", f"entry {i} has {len(wrench)} numbers; there is one for each of {', '.join(components)}"
            )
    return one_each(np.array(wrenches, dtype=float).reshape(len(wrenches), len(components)), count, "wrenches")


def one_each(rows: Array, count: int, field: str) -> Array:
    """One row for all configurations, or one each, as one each.

    Raises:
        InvalidField: Neither.
    """
    if len(rows) == count:
        return rows
    if len(rows) != 1:
        raise InvalidField(field, f"{len(rows)} entries for {count} configurations: one for all of them or one each")
    return np.repeat(rows, count, axis=0)


def weight_notes(found: Mechanism, load: Load | None) -> list[str]:
    """What the numbers leave out, one sentence each."""
    notes = []
    if found.without_mass:
        notes.append(f"the description gives no mass to {listed(found.without_mass)}, which move: they weigh nothing")
    if found.bodies and not any(body.mass > 0.0 for body in found.bodies):
        notes.append("nothing that the chain's joints move has a mass: all terms of inertia and weight are zero")
    if load is not None and not found.moves_tip:
        notes.append("the chain's joints do not move the tip against the root, so the payload burdens none of them")
    return notes
