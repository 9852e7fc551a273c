"""Forward kinematics and the Jacobian of a robot."""

from typing import Any

import numpy as np

from gelenk.api.routes import Computation, Operation, Outcome
from gelenk.contract.kinematics import (
    ForwardAnswer,
    ForwardOptions,
    ForwardRequest,
    JacobianAnswer,
    JacobianOptions,
    JacobianRequest,
)
from gelenk.contract.pose_arrays import pose_array, pose_list
from gelenk.kinematics.configuration import check_limits, configurations
from gelenk.kinematics.forward import forward_kinematics
from gelenk.kinematics.jacobian import Jacobians, jacobians, ranks, singular_values
from gelenk.model.arrays import Array, Indices
from gelenk.model.chain import Chain
from gelenk.model.errors import InvalidField, TooLarge, counted
from gelenk.model.robot import Robot
from gelenk.store.records import LoadedRobot

_QUICK_POSES = 100
_QUICK_JACOBIANS = 10
"""Configurations that take the event loop less than about a millisecond; more go to a thread."""

_NPY_BODY = "`joint_positions` as an array of shape (N, n)."
_PANDA_READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]


def kinematics_operations(max_answer_numbers: int) -> list[Operation]:
    """The operations on a robot, none of whose answers holds more numbers than given."""

    def fk(loaded: LoadedRobot, call: ForwardRequest) -> Outcome:
        """Pose of the tip, and of other frames on the chain, at each configuration.

        Poses are those of `tip_frame` in `base_frame`. Every answer is recomputed through Pinocchio before it is
        sent (a sample of a large batch), and `certificate` gives the difference.
        """
        robot = loaded.robot
        chain, qs = _chain_and_positions(robot, call)
        frames = robot.frames_on(chain) if call.frames == "all" else tuple(dict.fromkeys(call.frames or ()))
        _check_size(len(qs) * (1 + len(frames)) * 16, max_answer_numbers)
        result = forward_kinematics(robot, chain, qs, frames)

        def content() -> dict[str, Any]:
            answer = _head(chain)
            answer["poses"] = pose_list(result.poses, call.pose_format)
            if call.frames is not None:
                lists = {name: pose_list(poses, call.pose_format) for name, poses in result.frames.items()}
                answer["frames"] = [{name: poses[row] for name, poses in lists.items()} for row in range(len(qs))]
            answer["certificate"] = result.certificate
            return answer

        fits = call.frames is None
        return Outcome(content, (lambda: (pose_array(result.poses, call.pose_format), {})) if fits else None)

    def jacobian(loaded: LoadedRobot, call: JacobianRequest) -> Outcome:
        """Jacobian of the tip at each configuration, with rank, singular values and condition number.

        Rows are linear before angular. `local_world_aligned` is the course's geometric Jacobian; `zyz` and `rpy`
        give the analytic one, which does not exist where its angles degenerate. Every answer is recomputed through
        Pinocchio before it is sent (a sample of a large batch).
        """
        chain, qs = _chain_and_positions(loaded.robot, call)
        n = len(chain)
        matrices = 1 + len(call.derivatives) + n * bool(call.derivatives)
        _check_size(len(qs) * (12 + 6 * n * matrices), max_answer_numbers)
        velocities = _velocities(chain, call, len(qs))
        result = jacobians(
            loaded.robot,
            chain,
            qs,
            reference=call.reference,
            representation=call.representation,
            derivatives=bool(call.derivatives),
        )
        return Outcome(
            lambda: _jacobian_content(chain, call, result, velocities),
            None if call.derivatives else lambda: (result.values, {}),
        )

    return [
        Operation(
            name="fk",
            operation_id="forward_kinematics",
            summary="Forward kinematics",
            computation=Computation(
                run=fk,
                request=ForwardRequest,
                options=ForwardOptions,
                array_field="joint_positions",
                is_heavy=lambda call: call.frames is not None or len(call.joint_positions) > _QUICK_POSES,
            ),
            answer=ForwardAnswer,
            npy_body=_NPY_BODY,
            npy_answer="Poses as one array: (N, 7) position and quaternion, (N, 6) with a triple of angles, "
            "(N, 4, 4) matrices.",
            example={"joint_positions": [_PANDA_READY], "tip_frame": "panda_link8", "pose_format": "rpy"},
        ),
        Operation(
            name="jacobian",
            operation_id="jacobian",
            summary="Jacobian",
            computation=Computation(
                run=jacobian,
                request=JacobianRequest,
                options=JacobianOptions,
                array_field="joint_positions",
                is_heavy=lambda call: bool(call.derivatives) or len(call.joint_positions) > _QUICK_JACOBIANS,
            ),
            answer=JacobianAnswer,
            npy_body=_NPY_BODY,
            npy_answer="Jacobians as one array of shape (N, 6, n).",
            example={"joint_positions": [_PANDA_READY], "reference": "local_world_aligned"},
        ),
    ]


def _chain_and_positions(robot: Robot, call: ForwardRequest | JacobianRequest) -> tuple[Chain, Array]:
    chain = robot.chain(call.base_frame, call.tip_frame)
    qs = configurations(chain, call.joint_positions)
    if call.respect_limits:
        check_limits(chain, qs)
    return chain, qs


def _velocities(chain: Chain, call: JacobianRequest, count: int) -> Array | None:
    if "time_variation" not in call.derivatives:
        return None
    if call.joint_velocities is None:
        raise InvalidField("joint_velocities", "a time variation needs them, so send the call as JSON")
    velocities = configurations(chain, call.joint_velocities, "joint_velocities")
    if len(velocities) != count:
        raise InvalidField(
            "joint_velocities", f"{counted(len(velocities), 'entry')} for {counted(count, 'configuration')}"
        )
    return velocities


def _check_size(numbers: int, allowed: int) -> None:
    if numbers > allowed:
        raise TooLarge("numbers in the answer", numbers, allowed)


def _head(chain: Chain) -> dict[str, Any]:
    return {"joint_names": chain.joint_names, "base_frame": chain.base_frame, "tip_frame": chain.tip_frame}


def _jacobian_content(
    chain: Chain, call: JacobianRequest, result: Jacobians, velocities: Array | None
) -> dict[str, Any]:
    sigmas = singular_values(result.values)
    counts = ranks(sigmas, call.rank_tolerance)
    answer = {
        **_head(chain),
        "reference": call.reference,
        "representation": call.representation,
        "jacobians": np.ascontiguousarray(result.values),
        "ranks": counts,
        "singular_values": np.ascontiguousarray(sigmas),
        "condition_numbers": _condition_numbers(sigmas, counts),
        "rank_tolerance": call.rank_tolerance,
    }
    if velocities is not None:
        answer["time_variations"] = np.ascontiguousarray(result.time_variations(velocities))
    if "hessian" in call.derivatives:
        answer["hessians"] = np.ascontiguousarray(result.hessians)
    answer["certificate"] = result.certificate
    return answer


def _condition_numbers(sigmas: Array, counts: Indices) -> list[float | None]:
    full = sigmas.shape[1]
    return [
        float(sigma[0] / sigma[-1]) if full and rank == full else None
        for sigma, rank in zip(sigmas, counts, strict=True)
    ]
