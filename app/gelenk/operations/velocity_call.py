"""Checks a request of velocity kinematics: one question, its numbers, and how to invert."""

from collections.abc import Sequence
from typing import cast

import numpy as np

from gelenk.contract.velocity import VelocityRequest
from gelenk.errors import InvalidArray, InvalidField, counted, quoted
from gelenk.ik.search.problem import Objective
from gelenk.kinematics.velocity.inverse_velocity import descent
from gelenk.kinematics.velocity.linear_inverse import InverseRule
from gelenk.kinematics.velocity.task_space import TaskSpace
from gelenk.operations.chains import check_count
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import configurations, one_configuration

RATES = ("joint_velocities", "joint_accelerations", "joint_jerks", "joint_snaps")
"""Fields of the joints' derivatives, in their order."""
TIP = {"twists": 0, "tip_accelerations": 1, "tip_jerks": 2}
"""Fields that can be inverted, and how many of the rates each needs."""

_INVERSE_ALONE = ("inverse", "damping", "damping_threshold", "weights", "null_space")
DAMPING_THRESHOLD = 0.05
"""σ₀ of the adaptive damping if none is given."""
_LEAST_WEIGHT, _LARGEST_WEIGHT = 1e-6, 1e6


def positions_and_rates(chain: Chain, call: VelocityRequest) -> tuple[Array, Array]:
    """Return joint positions, shape (N, n), and the given rates q̇, q̈, …, shape (K, N, n).

    Raises InvalidField if a rate is given without those before it, or not once per configuration.
    """
    if isinstance(call.joint_positions, np.ndarray):
        return _split(chain, call.joint_positions)
    qs = configurations(chain, call.joint_positions)
    given = [getattr(call, field) for field in RATES]
    count = sum(values is not None for values in given)
    for field, values, before in zip(RATES[1:], given[1:], given, strict=False):
        if values is not None and before is None:
            raise InvalidField(field, f"they need `{RATES[RATES.index(field) - 1]}`, which are missing")
    rates = np.empty((count, *qs.shape))
    for k, (field, values) in enumerate(zip(RATES[:count], given, strict=False)):
        rows = configurations(chain, values, field)
        check_count(len(rows), len(qs), field)
        rates[k] = rows
    return qs, rates


def _split(chain: Chain, array: Array) -> tuple[Array, Array]:
    if array.ndim != 3 or not 2 <= array.shape[1] <= 1 + len(RATES):
        raise InvalidArray(
            f"joint positions and their derivatives form an array of shape (N, k, {len(chain)}) with 2 ≤ k ≤ 5; this "
            f"one has the shape {array.shape}"
        )
    fields = ("joint_positions", *RATES)
    parts = [configurations(chain, np.ascontiguousarray(array[:, k]), fields[k]) for k in range(array.shape[1])]
    return parts[0], np.array(parts[1:])


def requested_field(call: VelocityRequest, rates: int) -> str | None:
    """Return the field to invert, None if the tip's motion is requested; raises InvalidField if neither is clear."""
    given = [field for field in TIP if getattr(call, field) is not None]
    if not given:
        if rates == 0:
            raise InvalidField("joint_velocities", f"needed, or else one of {', '.join(TIP)} to be inverted")
        for field in _INVERSE_ALONE:
            if field in call.model_fields_set and not isinstance(call.joint_positions, np.ndarray):
                raise InvalidField(field, f"needs one of {', '.join(TIP)}, and none is given")
        return None
    quantity = given[0]
    if len(given) > 1:
        raise InvalidField(given[1], f"`{quantity}` are given too: one of the two, or two calls")
    needed = TIP[quantity]
    if rates < needed:
        raise InvalidField(RATES[rates], f"they are needed with `{quantity}`")
    if rates > needed:
        raise InvalidField(RATES[needed], f"`{quantity}` are given too, from which they follow: one of the two")
    return quantity


def rule_of_call(chain: Chain, call: VelocityRequest, quantity: str, directions: int) -> InverseRule:
    """Return the rule of inversion; raises InvalidField if an option or a weight does not suit the inverse."""
    if call.inverse == "exact":
        for field in ("weights", "null_space"):
            if getattr(call, field) is not None:
                raise InvalidField(field, "the exact inverse leaves nothing to choose")
        if directions != len(chain):
            raise InvalidField(
                "inverse",
                f"`exact` needs as many joints as directions, and here {counted(len(chain), 'joint')} should give "
                f"{directions}: choose a `task` of as many, or `pseudo_inverse`",
            )
    if call.inverse != "damped":
        for field in ("damping", "damping_threshold"):
            if getattr(call, field) is not None:
                raise InvalidField(field, "only for the inverse `damped`")
    damping = None if call.damping in {None, "adaptive"} else cast(float, call.damping)
    if damping is not None and call.damping_threshold is not None:
        raise InvalidField("damping_threshold", "only for adaptive damping")
    if quantity != "twists" and call.null_space is not None and call.null_space.joint_accelerations is None:
        raise InvalidField("null_space", "`joint_velocities` and `objective` are allowed with `twists` only")
    return InverseRule(
        call.inverse,
        call.rank_tolerance,
        damping,
        DAMPING_THRESHOLD if call.damping_threshold is None else call.damping_threshold,
        _weights(chain, call),
    )


def _weights(chain: Chain, call: VelocityRequest) -> Array | None:
    if call.weights is None:
        return None
    weights: Array = one_configuration(chain, call.weights, "weights")[0]
    for name, weight in zip(chain.joint_names, weights.tolist(), strict=True):
        if not _LEAST_WEIGHT <= weight <= _LARGEST_WEIGHT:
            raise InvalidField(
                "weights",
                f"that of joint {quoted(name)} is {weight:g}; allowed: {_LEAST_WEIGHT:g} to {_LARGEST_WEIGHT:g}",
            )
    return weights


def targets_of_call(call: VelocityRequest, quantity: str, space: TaskSpace, count: int) -> Array:
    """Return the rates to invert, in the directions of the task; shape (N, k)."""
    given: Sequence[Sequence[float]] = getattr(call, quantity)
    check_count(len(given), count, quantity)
    targets = np.empty((count, len(space)))
    for i, entry in enumerate(given):
        if len(entry) not in {6, len(space)}:
            allowed = f"6, or {len(space)} for the directions that count"
            if call.task is None:
                allowed = "6, or as many as there are directions in `task`"
            raise InvalidField(f"{quantity}/{i}", f"{counted(len(entry), 'number')}; allowed: {allowed}")
        # Six numbers for six directions are in the order of the directions too.
        targets[i] = entry if len(entry) == len(space) else [entry[row] for row in space.rows]
    return targets


def null_motion_of_call(
    chain: Chain, call: VelocityRequest, qs: Array, quantity: str, space: TaskSpace, climb: Array | None
) -> Array | None:
    """Return the null-space motion ξ, shape (N, n), None if not requested; raises InvalidField if it does not fit.

    `climb` has the gradients of the clearance, shape (N, n), if it is known.
    """
    wanted = call.null_space
    if wanted is None:
        return None
    if wanted.objective == "clearance":
        return None if climb is None else wanted.gain * climb
    if wanted.objective is not None:
        given = wanted.posture
        posture = None if given is None else one_configuration(chain, given, "null_space/posture")
        return descent(chain, qs, Objective(wanted.objective, posture), wanted.gain, space)
    field = "joint_velocities" if quantity == "twists" else "joint_accelerations"
    values = getattr(wanted, field)
    if values is None or quantity == "tip_jerks":
        raise InvalidField("null_space", f"its result cannot be combined with `{quantity}`")
    rows = configurations(chain, values, f"null_space/{field}")
    if len(rows) != 1:
        check_count(len(rows), len(qs), f"null_space/{field}", ": one for all or each")
    return np.broadcast_to(rows, qs.shape)
