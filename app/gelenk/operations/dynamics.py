"""Dynamics of a robot: terms of the equations of motion, inverse and forward dynamics; worked solutions."""

import time
from typing import Any, TypedDict

import numpy as np

from gelenk.contract.dynamics import DynamicsRequest
from gelenk.course.dynamics.dynamics_steps import DynamicsQuestion, dynamics_steps
from gelenk.course.steps import Step, step
from gelenk.course.writing import number
from gelenk.dh.lagrangian.bodies import Gravity, LinkBody, MassProperties
from gelenk.dh.tables.from_chain import standard_table
from gelenk.dh.worked import worked_solution
from gelenk.errors import InvalidField
from gelenk.ik.search.words import DIRECTIONS
from gelenk.kinematics.dynamics.bodies import Load, Motions, motions
from gelenk.kinematics.dynamics.dynamics import Dynamics, dynamics
from gelenk.kinematics.dynamics.lagrangian import State
from gelenk.kinematics.dynamics.mechanism import ChainMechanism, mechanism
from gelenk.kinematics.force.statics import certify_statics, overloaded_joints, statics
from gelenk.language import translated as _
from gelenk.operations.chains import check_count, check_numbers, check_worked, head, positions
from gelenk.operations.derive_dh import in_time
from gelenk.operations.loads import (
    MECHANISM,
    chain_of,
    gravity_of,
    has_few_bodies,
    is_quick,
    load_of,
    unused_frame,
    weight_notes,
    wrench_frame,
    wrench_rows,
)
from gelenk.operations.outcome import Limits, Outcome
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.robot.dh import DhTable
from gelenk.robot.robot import RobotModel
from gelenk.store.records import LoadedRobot

_MOST_JOINTS = 2
"""Number of joints up to which the equations of motion are short enough to stand before their numbers."""
_SECONDS = 4.0
"""Processor time of the equations in symbols, [s]."""
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
    solved = worked_solution(table, dynamics=properties, run=in_time, deadline=time.process_time() + _SECONDS)
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


_FIELDS = {
    "mass_matrix": "mass_matrices",
    "coriolis_matrix": "coriolis_matrices",
    "coriolis_torques": "coriolis_torques",
    "gravity_torques": "gravity_torques",
}
"""Field of the answer for each term."""


def run(loaded: LoadedRobot, call: DynamicsRequest, limits: Limits) -> Outcome:
    """Compute the requested terms, and joint torques (inverse dynamics) or accelerations (forward dynamics)."""
    robot = loaded.robot
    chain = chain_of(robot, call)
    _check_options(call)
    load, gravity = load_of(call.payload), gravity_of(call.gravity)
    qs = positions(chain, call)
    _check_size(call, len(qs), len(chain), limits)
    check_worked(call, len(qs))
    speeds = _rows(chain, call.joint_velocities, "joint_velocities", len(qs))
    state = State(qs, np.zeros_like(qs) if speeds is None else speeds, _held(robot, chain, call, qs))
    gravity = np.zeros(3) if gravity is None else gravity
    given: _Given = {
        "accelerations": _rows(chain, call.joint_accelerations, "joint_accelerations", len(qs)),
        "torques": _rows(chain, call.torques, "torques", len(qs)),
    }
    found = dynamics(robot, chain, state, terms=call.terms, gravity=gravity, load=load, **given)
    array = _array(call, found)

    def content() -> dict[str, Any]:
        notes = weight_notes(loaded, mechanism(robot, chain), load)
        if not found.is_definite:
            notes.append(_("the mass matrix is singular: some motion of the joints meets no inertia"))
        worked: dict[str, Any] = {}
        if call.steps:
            holds = call.wrenches is not None
            worked["steps"] = worked_dynamics(mechanism(robot, chain), state, gravity, load, holds=holds, **given)
        about = {**head(chain), "root_frame": robot.description.root, "gravity": gravity}
        numbers = _numbers(robot, chain, call, state, found)
        return about | numbers | {"notes": notes} | worked | {"certificate": found.certificate}

    return Outcome(content, None if array is None or call.steps else lambda: (array, {}))


def is_heavy(call: DynamicsRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return not is_quick(call) or call.wrenches is not None or call.steps


def attempt(loaded: LoadedRobot, call: DynamicsRequest, limits: Limits) -> Outcome | None:
    """Run the operation if the chain has few bodies; return None if it has many."""
    return run(loaded, call, limits) if has_few_bodies(loaded, call) else None


WARM_UP = MECHANISM


class _Given(TypedDict):
    """What the equations are solved for from; at most one is not None."""

    accelerations: Array | None
    torques: Array | None


def _check_options(call: DynamicsRequest) -> None:
    if call.joint_accelerations is not None and call.torques is not None:
        raise InvalidField(
            "torques", "they ask for forward dynamics, `joint_accelerations` for inverse: one of the two"
        )
    if len(set(call.terms)) < len(call.terms):
        raise InvalidField("terms", "each term at most once")
    wrench_frame(call)
    if call.wrenches is None and (field := unused_frame(call)) is not None:
        raise InvalidField(field, "only allowed with `wrenches`, whose axes or point it gives")


def _rows(chain: Chain, values: Any, field: str, count: int) -> Array | None:
    """Return one row per configuration; None if no values are given."""
    if values is None:
        return None
    rows = configurations(chain, values, field)
    if len(rows) and not count:
        raise InvalidField("joint_positions", f"is empty, but `{field}` has entries: give one per configuration")
    check_count(len(rows), count, field, ": one each")
    return rows


def _held(robot: RobotModel, chain: Chain, call: DynamicsRequest, qs: Array) -> Array:
    """Return the joint torques Jᵀγ of the wrenches, certified; zero without wrenches. Shape (N, n)."""
    if call.wrenches is None:
        return np.zeros_like(qs)
    wrenches = wrench_rows(call.wrenches, len(qs), DIRECTIONS)
    still = statics(robot, chain, qs, wrench_frame(call))
    held = still.wrench_torques(wrenches)
    certify_statics(still, wrenches, held)
    return held


def _check_size(call: DynamicsRequest, count: int, n: int, limits: Limits) -> None:
    matrices = len({"mass_matrix", "coriolis_matrix", "coriolis_torques"} & set(call.terms))
    matrices += call.torques is not None
    check_numbers(count * (matrices * n * n + 6 * n + 2 + (12 + 6 * n) * (call.wrenches is not None)), limits)


def _array(call: DynamicsRequest, found: Dynamics) -> Array | None:
    if found.torques is not None:
        return found.torques
    if found.accelerations is not None or not call.terms:
        return found.accelerations
    if call.terms[0] == "energies":
        return np.column_stack((found.kinetic_energies, found.potential_energies))  # type: ignore[arg-type]
    return np.asarray(getattr(found, _FIELDS[call.terms[0]]))


def _numbers(robot: RobotModel, chain: Chain, call: DynamicsRequest, state: State, found: Dynamics) -> dict[str, Any]:
    answer: dict[str, Any] = {}
    for field in (*_FIELDS.values(), "kinetic_energies", "potential_energies"):
        value = getattr(found, field)
        if value is not None:
            answer[field] = np.ascontiguousarray(value)
    if call.wrenches is not None:
        answer["wrench_torques"] = state.held
    if found.torques is not None:
        answer["torques"] = found.torques
        answer["overloaded_joints"] = overloaded_joints(robot, chain, found.torques)
    if found.accelerations is not None:
        answer["joint_accelerations"] = found.accelerations
    return answer
