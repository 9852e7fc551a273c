"""Converts the loads on a robot in a request of statics or dynamics: gravity, payload, wrenches at a point."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from gelenk.contract.common import Vectors
from gelenk.contract.dynamics import DynamicsRequest
from gelenk.contract.statics import CarriedLoad, PayloadInfo, StaticsRequest, WrenchOptions, WrenchRequest
from gelenk.errors import InvalidField, UnknownFrame, counted, quoted
from gelenk.kinematics.dynamics.bodies import Load, tensor
from gelenk.kinematics.dynamics.mechanism import STANDARD_GRAVITY, ChainMechanism, known_mechanism, mechanism
from gelenk.kinematics.force.statics import WrenchFrame
from gelenk.language import translated as _
from gelenk.operations.chains import check_count
from gelenk.operations.outcome import WarmUp
from gelenk.robot.appearance import invented_masses
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_QUICK_BODIES = 8


def chain_of(robot: RobotModel, call: WrenchOptions) -> Chain:
    """Return the chain of a request; raises UnknownFrame, with the field, for a frame that the robot lacks."""
    for field in ("base_frame", "tip_frame", "expressed_in", "point_frame"):
        name = getattr(call, field)
        if name is not None and name not in robot.description.joints_below:
            raise UnknownFrame(name, robot.description.frames, field)
    return robot.chain(call.base_frame, call.tip_frame)


def _build(loaded: LoadedRobot, call: WrenchOptions, _: None = None) -> None:
    mechanism(loaded.robot, chain_of(loaded.robot, call))


MECHANISM: WarmUp[Any] = WarmUp(
    lambda loaded, call: known_mechanism(loaded.robot, chain_of(loaded.robot, call)) is not None, _build, _build
)
"""The mechanism of a chain, which takes some milliseconds to build; a worker only sees whether it can be built."""


def is_quick(call: StaticsRequest | DynamicsRequest) -> bool:
    """Check whether a request may take the event loop less than about a millisecond."""
    return len(call.joint_positions) == 1 and call.payload is None


def has_few_bodies(loaded: LoadedRobot, call: WrenchOptions) -> bool:
    """Check whether the mechanism, which must be known, has few bodies."""
    return len(mechanism(loaded.robot, chain_of(loaded.robot, call)).bodies) <= _QUICK_BODIES


def gravity_of(value: bool | Sequence[float]) -> Array | None:
    """Return the gravity vector in the root's axes, [m/s²]; None without gravity."""
    if isinstance(value, bool):
        return np.array(STANDARD_GRAVITY) if value else None
    return np.array(value, dtype=float)


def load_of(payload: PayloadInfo | CarriedLoad | None) -> Load | None:
    """Return the payload in the core's form; raises InvalidField if no body has this inertia."""
    if payload is None:
        return None
    inertia = tensor(payload.inertia or np.zeros(6))
    moments = np.linalg.eigvalsh(inertia)
    slack = 1e-9 * np.abs(moments).max()
    # Each moment is the sum of two of the positive integrals of x², y² and z².
    if moments[0] + moments[1] < moments[2] - slack or moments[0] < -slack:
        raise InvalidField(
            "payload",
            "no body has this inertia: its principal moments must not be negative, and none larger than the sum "
            "of the two others",
        )
    return Load(payload.mass, np.array(payload.center, dtype=float), inertia)


def wrench_frame(call: WrenchRequest) -> WrenchFrame:
    """Return the axes and the point of the wrenches; raises InvalidField if fields contradict each other."""
    frame = WrenchFrame(call.reference, call.expressed_in, call.point, call.point_frame)
    frame.check()
    return frame


def unused_frame(call: WrenchRequest) -> str | None:
    """Return the first given field that sets axes or point, for a call that has nothing to express in them."""
    if call.reference != "local_world_aligned":
        return "reference"
    fields = ("expressed_in", "point", "point_frame")
    return next((field for field in fields if getattr(call, field) is not None), None)


def wrench_rows(wrenches: Vectors, count: int, components: Sequence[str], hint: str = "") -> Array:
    """Return one wrench per configuration; shape (N, m), [N] and [N m]; raises InvalidField, with a hint."""
    for i, wrench in enumerate(wrenches):
        if len(wrench) != len(components):
            raise InvalidField(
                "wrenches",
                f"entry {i} has {counted(len(wrench), 'number')}; there is one for each of {', '.join(components)}"
                + hint,
            )
    return one_each(np.array(wrenches, dtype=float).reshape(len(wrenches), len(components)), count, "wrenches")


def one_each(rows: Array, count: int, field: str) -> Array:
    """Return one row per configuration, from as many rows or from one for all; raises InvalidField for others."""
    if len(rows) != 1:
        check_count(len(rows), count, field, ": one for all of them or one each")
        return rows
    return np.repeat(rows, count, axis=0)


def weight_notes(loaded: LoadedRobot, found: ChainMechanism, load: Load | None) -> list[str]:
    """Return a sentence on each thing that the numbers leave out or assume."""
    notes = mass_notes(found, load)
    if loaded.table is not None and found.bodies:
        text = _("{reason}, as placeholders; for real numbers upload a URDF with `inertial` elements")
        notes.insert(0, text.format(reason=invented_masses()))
    return notes


def mass_notes(found: ChainMechanism, load: Load | None) -> list[str]:
    """Return a sentence on each thing that has no mass, and on a payload that loads no joint."""
    notes = []
    if found.without_mass:
        text = _("the description gives no mass to {links}, which move: they weigh nothing")
        notes.append(text.format(links=", ".join(map(quoted, found.without_mass))))
    if found.bodies and not any(body.mass > 0.0 for body in found.bodies):
        notes.append(_("nothing that the chain's joints move has a mass: all terms of inertia and weight are zero"))
    if load is not None and not found.moves_tip:
        notes.append(_("the chain's joints do not move the tip against the root, so the payload loads none of them"))
    return notes
