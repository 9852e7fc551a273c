"""The Jacobian of a robot."""

from typing import Any

import numpy as np

from gelenk.contract.jacobian import JacobianRequest
from gelenk.errors import InvalidField
from gelenk.kinematics.velocity.jacobian import condition_numbers, jacobians, ranks, singular_values
from gelenk.operations.chains import chain_and_positions, check_count, check_numbers, check_worked, head
from gelenk.operations.outcome import Limits, Outcome
from gelenk.operations.velocity_steps import worked_jacobians
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations
from gelenk.store.records import LoadedRobot

_QUICK = 10
"""Configurations that take the event loop less than about a millisecond; more go to a worker."""


def run(loaded: LoadedRobot, call: JacobianRequest, limits: Limits) -> Outcome:
    """Compute the Jacobian at each configuration, and its derivatives if requested."""
    chain, qs = chain_and_positions(loaded.robot, call)
    n, derivatives = len(chain), bool(call.derivatives)
    check_numbers(len(qs) * (12 + 6 * n * (1 + len(call.derivatives) + n * derivatives)), limits)
    check_worked(call, len(qs))
    velocities = _velocities(chain, call, len(qs))
    result = jacobians(
        loaded.robot, chain, qs, reference=call.reference, representation=call.representation, derivatives=derivatives
    )

    def content() -> dict[str, Any]:
        sigmas = singular_values(result.values)
        counts = ranks(sigmas, call.rank_tolerance)
        answer = {
            **head(chain),
            "reference": call.reference,
            "representation": call.representation,
            "jacobians": np.ascontiguousarray(result.values),
            "ranks": counts,
            "singular_values": np.ascontiguousarray(sigmas),
            "condition_numbers": condition_numbers(sigmas, counts),
            "rank_tolerance": call.rank_tolerance,
        }
        if velocities is not None:
            answer["time_variations"] = np.ascontiguousarray(result.time_variations(velocities))
        if "hessian" in call.derivatives:
            answer["hessians"] = np.ascontiguousarray(result.hessians)
        if call.steps:
            answer["steps"] = worked_jacobians(chain, call, qs, result.poses, velocities)
        return answer | {"certificate": result.certificate}

    return Outcome(content, None if derivatives or call.steps else lambda: (result.values, {}))


def is_heavy(call: JacobianRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return bool(call.derivatives) or call.steps or len(call.joint_positions) > _QUICK


def _velocities(chain: Chain, call: JacobianRequest, count: int) -> Array | None:
    if "time_variation" not in call.derivatives:
        return None
    if call.joint_velocities is None:
        raise InvalidField("joint_velocities", "a time variation needs them, so send the call as JSON")
    velocities = configurations(chain, call.joint_velocities, "joint_velocities")
    check_count(len(velocities), count, "joint_velocities")
    return velocities
