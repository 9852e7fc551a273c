"""Forward kinematics and the Jacobian of a robot."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from app.api.routes import Computation, Operation, Outcome
from app.kinematics.certify import Certificate, JacobianCertificate
from app.kinematics.configuration import check_limits, configurations
from app.kinematics.forward import forward_kinematics
from app.kinematics.jacobian import Jacobians, jacobians, ranks, singular_values
from app.model.arrays import Array
from app.model.chain import Chain
from app.model.errors import InvalidArray, TooLarge
from app.model.robot import Robot
from app.schemas.kinematics import (
    ForwardAnswer,
    ForwardOptions,
    ForwardRequest,
    JacobianAnswer,
    JacobianOptions,
    JacobianRequest,
)
from app.schemas.pose import pose_array, pose_list
from app.store.records import LoadedRobot

_PANDA_READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]


def kinematics_operations(max_answer_numbers: int) -> list[Operation]:
    """The operations on a robot, none of whose answers holds more numbers than given."""

    def fk(loaded: LoadedRobot, call: ForwardRequest) -> Outcome:
        """Pose of the tip, and of other frames on the chain, at each configuration.

        Poses are those of `tip_frame` in `base_frame`. Every answer is recomputed through Pinocchio before it is
        sent (a sample of a large batch), and `certificate` says how far the two are apart.
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
                lists = [pose_list(poses, call.pose_format) for poses in result.frames.values()]
                names = tuple(result.frames)
                answer["frames"] = [dict(zip(names, entry, strict=True)) for entry in zip(*lists, strict=True)] or [
                    {} for _ in range(len(qs))
                ]
            answer["certificate"] = _certificate(result.certificate)
            return answer

        array = None if call.frames is not None else lambda: pose_array(result.poses, call.pose_format)
        return Outcome(content, array)

    def jacobian(loaded: LoadedRobot, call: JacobianRequest) -> Outcome:
        """Jacobian of the tip at each configuration, with rank, singular values and condition number.

        Rows are linear before angular. `local_world_aligned` is the course's geometric Jacobian; `zyz` and `rpy`
        give the analytic one, which does not exist where its angles degenerate. Every answer is recomputed through
        Pinocchio before it is sent (a sample of a large batch).
        """
        if call.representation != "geometric" and call.reference != "local_world_aligned":
            raise InvalidArray("reference: an analytic Jacobian goes with `local_world_aligned` only")
        chain, qs = _chain_and_positions(loaded.robot, call)
        n = len(chain)
        _check_size(len(qs) * 6 * n * (1 + len(call.derivatives) + n * bool(call.derivatives)), max_answer_numbers)
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
            None if call.derivatives else lambda: result.values,
        )

    return [
        Operation(
            "fk",
            "forward_kinematics",
            "Forward kinematics",
            Computation(fk, ForwardRequest, ForwardOptions, "joint_positions", lambda call: call.frames is not None),
            ForwardAnswer,
            "Poses as one array: (N, 7) position and quaternion, (N, 6) with a triple of angles, (N, 4, 4) matrices.",
            {"joint_positions": [_PANDA_READY], "tip_frame": "panda_link8", "pose_format": "rpy"},
        ),
        Operation(
            "jacobian",
            "jacobian",
            "Jacobian",
            Computation(
                jacobian, JacobianRequest, JacobianOptions, "joint_positions", lambda call: bool(call.derivatives)
            ),
            JacobianAnswer,
            "Jacobians as one array of shape (N, 6, n).",
            {"joint_positions": [_PANDA_READY], "reference": "local_world_aligned"},
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
    given = getattr(call, "joint_velocities", None)
    if given is None:
        raise InvalidArray("joint_velocities: a time variation needs them")
    velocities = configurations(chain, given)
    if len(velocities) != count:
        raise InvalidArray(f"joint_velocities: {len(velocities)} entries for {count} configurations")
    return velocities


def _check_size(numbers: int, allowed: int) -> None:
    if numbers > allowed:
        raise TooLarge("numbers in the answer", numbers, allowed)


def _head(chain: Chain) -> dict[str, Any]:
    return {"joint_names": chain.joint_names, "base_frame": chain.base_frame, "tip_frame": chain.tip_frame}


def _certificate(certificate: Certificate) -> dict[str, Any]:
    return {
        "samples": certificate.samples,
        "max_position_error": certificate.max_position_error,
        "max_orientation_error": certificate.max_orientation_error,
        "seed": certificate.seed,
    }


def _jacobian_certificate(certificate: JacobianCertificate) -> dict[str, Any]:
    return {
        "samples": certificate.samples,
        "max_error": certificate.max_error,
        "max_time_variation_error": certificate.max_time_variation_error,
        "seed": certificate.seed,
    }


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
    answer["certificate"] = _jacobian_certificate(result.certificate)
    return answer


def _condition_numbers(sigmas: Array, counts: Sequence[int] | Any) -> list[float | None]:
    full = sigmas.shape[1]
    return [
        float(sigma[0] / sigma[-1]) if full and rank == full else None
        for sigma, rank in zip(sigmas, counts, strict=True)
    ]
