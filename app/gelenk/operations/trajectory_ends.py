"""Where a trajectory begins and ends in motion: rates of the request, or the state of a running motion."""

from collections.abc import Callable
from dataclasses import replace
from typing import cast

import numpy as np

from gelenk.contract.trajectory_request import Motion, RunningMotion, TrajectoryRequest
from gelenk.errors import InvalidField, InvalidInput, listed
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import one_configuration
from gelenk.robot.robot import RobotModel
from gelenk.trajectory.joints.waypoints import WITHIN
from gelenk.trajectory.laws.laws import LAWS
from gelenk.trajectory.motion.splines import EndRates
from gelenk.trajectory.plan import plan
from gelenk.trajectory.problem.problem import Segment, TrajectoryProblem

_STILL = 1e-12
"""Largest velocity or acceleration of a running motion that counts as rest."""
_AFTER = 1e-9
"""Relative excess of a time over the end of a motion that still means its end."""
_NAMES = ("velocities", "accelerations")


def state_of(robot: RobotModel, chain: Chain, at: RunningMotion, parse: Callable[..., TrajectoryProblem]) -> Array:
    """Return position, velocity and acceleration of a running motion at its time; shape (3, n)."""
    former = at.trajectory
    call = TrajectoryRequest.model_construct(former.model_fields_set, **dict(former))
    try:
        own = robot.chain(former.base_frame, former.tip_frame)
        if own.joint_names != chain.joint_names:
            names = f"{listed(own.joint_names)}, and the new motion {listed(chain.joint_names)}"
            raise InvalidField("tip_frame", f"the running motion moves {names}: both move the same joints")
        motion = plan(robot, own, parse(robot, own, call)).motion
    except InvalidInput as error:
        raise _inside(error, "at.trajectory") from None
    if at.time > motion.duration * (1.0 + _AFTER):
        raise InvalidField(
            "at.time", f"{at.time:.10g} s is after the end of the running motion, {motion.duration:.10g} s"
        )
    state = np.concatenate(motion.rates_at(np.array([min(at.time, motion.duration)])))
    state[1:][np.abs(state[1:]) <= _STILL] = 0.0
    inside = np.clip(state[0], chain.lower, chain.upper)
    state[0] = np.where(np.abs(inside - state[0]) <= WITHIN, inside, state[0])
    return state


def _inside(error: InvalidInput, place: str) -> InvalidInput:
    """Return the error with the place of its field."""
    if not hasattr(error, "field"):
        return error
    named = cast(InvalidField, error)
    return replace(named, field=f"{place}.{named.field}")


def with_rates(chain: Chain, call: Motion, segments: tuple[Segment, ...], state: Array | None) -> tuple[Segment, ...]:
    """Give the first and the last segment the rates of the request, or those of a running motion's state, (3, n)."""
    start, end = _given(chain, call, "start"), _given(chain, call, "end")
    if state is not None:
        start = state[1:]
        if _most(segments[0]) < 2:
            start = start * [[1.0], [0.0]]
    if start is None and end is None:
        return segments
    found = list(segments)
    for i, rows, side in ((0, start, "start"), (len(found) - 1, end, "end")):
        if rows is None or not rows.any():
            continue
        _check(found[i], rows, side, is_running=state is not None and side == "start")
        ends = found[i].ends or EndRates.at_rest(len(chain))
        rates = {f"{side}_velocity": rows[0], f"{side}_acceleration": rows[1]}
        found[i] = replace(found[i], ends=replace(ends, **rates))
    return tuple(found)


def _given(chain: Chain, call: Motion, side: str) -> Array | None:
    """Return velocities and accelerations at a side, shape (2, n); None if the request has none."""
    fields = [f"{side}_{name}" for name in _NAMES]
    values = [getattr(call, field) for field in fields]
    if values == [None, None]:
        return None
    rows = np.zeros((2, len(chain)))
    for row, field, value in zip(rows, fields, values, strict=True):
        if value is not None:
            row[:] = one_configuration(chain, value, field)[0]
    return rows


def _most(segment: Segment) -> int:
    """Return how many derivatives may be given at the ends of a segment."""
    if segment.type == "joint":
        return LAWS[segment.law].end_rates
    if segment.configurations is None or segment.blends or segment.law != "cubic":
        return 0
    return {"clamped": 1, "assigned": 2}.get(segment.boundary, 0)


def _check(segment: Segment, rows: Array, side: str, *, is_running: bool) -> None:
    """Refuse rates that a segment cannot have."""
    most, moving = _most(segment), np.asarray(rows.any(axis=1))
    if not moving[most:].any():
        return
    first = int(moving.argmax()) if most == 0 else most
    field = "at" if is_running else f"{side}_{_NAMES[first]}"
    if segment.type == "joint":
        laws = ", ".join(f"`{name}`" for name, law in LAWS.items() if law.end_rates > first)
        reason = f"the law `{segment.law}` has no {_NAMES[first]} at its ends; these laws have them: {laws}"
    elif segment.configurations is not None:
        reason = f"a spline can have {_NAMES[first]} at its ends with the law `cubic` and the boundary " + (
            "`clamped` or `assigned`" if first == 0 else "`assigned`"
        )
    else:
        reason = f"a {segment.type} is at rest at its {side}: let the motion {side} with a segment of type `joint`"
    raise InvalidField(field, reason)
