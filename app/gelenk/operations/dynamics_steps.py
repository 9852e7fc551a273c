"""Worked solutions of dynamics: from the numbers of the bodies, and of short planar arms also in symbols."""

import time

import numpy as np

from gelenk.course.dynamics.dynamics_steps import DynamicsQuestion, dynamics_steps
from gelenk.course.steps import Step, step
from gelenk.course.writing import number
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody, MassProperties
from gelenk.dh.tables.from_chain import standard_table
from gelenk.dh.worked import worked_solution
from gelenk.kinematics.dynamics.bodies import Load, Motions, motions
from gelenk.kinematics.dynamics.lagrangian import State
from gelenk.kinematics.dynamics.mechanism import ChainMechanism
from gelenk.language import translated as _
from gelenk.operations.derive_dh import in_time
from gelenk.robot.arrays import Array
from gelenk.robot.dh import DhTable

_MOST_JOINTS = 2
"""Number of joints up to which the equations of motion are short enough to stand before their numbers."""
_SECONDS = 4.0
"""Time limit of the equations in symbols, [s]."""
_ROUNDING = 1e-9
"""Coordinates of a centre of mass below this count as zero, [m]."""


def worked_dynamics(
    found: ChainMechanism,
    state: State,
    gravity: Array,
    load: Load | None,
    *,
    holds: bool,
    accelerations: Array | None,
    torques: Array | None,
) -> list[list[Step]]:
    """Return the steps at each state; `holds` if there is a wrench, the other arguments are those of `dynamics`."""
    closed = _closed_form(found, gravity) if load is None else []
    moving = motions(found.carried(load), state.qs)
    return [
        [
            *closed,
            *dynamics_steps(
                DynamicsQuestion(
                    moving.masses,
                    moving.centers[i],
                    moving.inertias[i],
                    moving.linear[i],
                    moving.angular[i],
                    _slopes(found, load, q),
                    gravity,
                    state.speeds[i],
                    state.held[i] if holds else None,
                    None if accelerations is None else accelerations[i],
                    None if torques is None else torques[i],
                )
            ),
        ]
        for i, q in enumerate(state.qs)
    ]


def _slopes(found: ChainMechanism, load: Load | None, q: Array) -> Array:
    """Return ∂M/∂q_k at [:, :, k]: Ṁ = S + Sᵀ while joint k moves at unit speed; shape (n, n, n)."""
    n = len(q)
    products = motions(found.carried(load), np.tile(q, (n, 1)), np.eye(n)).velocity_products()
    return np.asarray((products + products.swapaxes(1, 2)).transpose(1, 2, 0))


def _closed_form(found: ChainMechanism, gravity: Array) -> list[Step]:
    """Return the equations of motion of a short planar arm in symbols, and what these are; else nothing."""
    chain = found.chain
    if not 0 < len(chain) == len(chain.flat.joints) <= _MOST_JOINTS or found.base[0] or len(found.bodies) != len(chain):
        return []
    table = standard_table(found.robot.description, chain)
    if table is None:
        return []
    R = found.base[1].rotation
    size = float(np.linalg.norm(gravity))
    x, y, z = (R.T @ gravity / size if size else -R[2]).tolist()
    bodies = _link_bodies(found, table, motions(found.bodies, np.zeros((1, len(chain)))))
    properties = MassProperties(bodies, Gravity(size, (x, y, z)))
    solved = worked_solution(table, dynamics=properties, run=in_time, deadline=time.monotonic() + _SECONDS)
    if solved.motion is None or solved.formulas is None:
        return []
    legend = {entry.latex: entry.value for entry in (*solved.formulas.legend, *solved.motion.texts.legend)}
    values = [f"{symbol} = {number(value)}" for symbol, value in legend.items() if value is not None]
    text = _(
        "Lengths of the table, g_0 of gravity, and for each body its mass, its centre of mass in the frame of its "
        "link, or how far along the link it is, l_c, and its inertia about that."
    )
    return [step(_("The symbols"), text, r",\quad ".join(values)), *solved.motion.steps]


def _link_bodies(found: ChainMechanism, table: DhTable, still: Motions) -> tuple[LinkBody, ...]:
    """Return the bodies in the frames of a table with all joints at zero; inertias are about the axis that turns."""
    base = found.base[1]
    turning = [i for i, row in enumerate(table.joints) if row.type == "revolute"]
    frames = table.frames([0.0] * len(table.joints))
    normal = base.rotation @ frames[turning[0]][:3, 2] if turning else np.zeros(3)
    bodies = []
    for b, (row, frame) in enumerate(zip(table.joints, frames[1:], strict=True)):
        point = base.actInv(still.centers[0, b])
        x, y, z = frame[:3, :3].T @ (point - frame[:3, 3])
        on_line = row.type == "revolute" and max(abs(y), abs(z)) < _ROUNDING
        center = float(row.a + x) if on_line else (float(x), float(y), float(z))
        bodies.append(LinkBody(float(still.masses[b]), center, float(normal @ still.inertias[0, b] @ normal)))
    return tuple(bodies)
