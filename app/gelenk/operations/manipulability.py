"""Manipulability of a robot: ellipsoids, measures, transmission ratios, polytopes; as numbers or as a picture."""

import math
from typing import Any

import numpy as np

from gelenk.contract.manipulability import MAX_DETAILED, MAX_WITH_POLYTOPES, ManipulabilityRequest
from gelenk.errors import InvalidField, TooLarge
from gelenk.kinematics.ellipsoids.limited_motion import JointBounds, LimitedMotion, joint_bounds, limited_motion
from gelenk.kinematics.ellipsoids.manipulability import (
    Ellipsoids,
    Manipulability,
    Part,
    is_within_task,
    manipulability,
    transmission_ratios,
)
from gelenk.operations.chains import chain_and_positions, check_numbers, check_worked, head
from gelenk.operations.outcome import Limits, Outcome, PictureFormat
from gelenk.operations.velocity_steps import worked_ellipsoids
from gelenk.robot.arrays import Array, Configuration
from gelenk.robot.chain import Chain
from gelenk.robot.configuration import one_configuration
from gelenk.store.records import LoadedRobot

_QUICK = 4
_QUICK_DIRECTIONS = 8
"""Configurations, and directions, that take the event loop less than about a millisecond; more go to a worker."""
_NUMBERS_A_PART = 40
"""Numbers in a part of an answer besides the directions and the gradient."""
_NUMBERS_A_DIRECTION = 13


def run(loaded: LoadedRobot, call: ManipulabilityRequest, limits: Limits) -> Outcome:
    """Compute the ellipsoids and measures of manipulability, and if requested ratios, gradients and polytopes."""
    chain, qs = chain_and_positions(loaded.robot, call)
    directions = _directions(call)
    bounds = _bounds(loaded, chain, call)
    _check_size(chain, call, len(qs), limits)
    check_worked(call, len(qs))

    def result() -> Manipulability:
        return manipulability(
            loaded.robot,
            chain,
            qs,
            task=call.task,
            reference=call.reference,
            characteristic_length=call.characteristic_length,
            rank_tolerance=call.rank_tolerance,
            gradient=call.gradient,
        )

    def content() -> dict[str, Any]:
        if call.polytopes and len(qs) > MAX_WITH_POLYTOPES:
            raise TooLarge("configurations of a call with polytopes", len(qs), MAX_WITH_POLYTOPES)
        if len(qs) > MAX_DETAILED:
            raise TooLarge("configurations of an answer in JSON (as npy there may be more)", len(qs), MAX_DETAILED)
        return _content(chain, call, result(), directions, bounds)

    def array() -> tuple[Array, dict[str, str]]:
        return np.concatenate([part.sigmas for part in result().parts.values()], axis=1), {}

    def picture(kind: PictureFormat) -> bytes:
        if call.reference != "local_world_aligned":
            raise InvalidField("reference", "an image is drawn in the base's axes, `local_world_aligned`")
        if len(qs) != 1:
            return _postures(loaded, chain, qs, result().parts.get("translation"), kind)
        return _picture(loaded, chain, qs[0], result(), call, bounds, kind)

    fits = not (call.gradient or call.polytopes or call.directions or call.steps)
    return Outcome(content, array if fits else None, picture)


def is_heavy(call: ManipulabilityRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    many = len(call.joint_positions) > _QUICK or len(call.directions or ()) > _QUICK_DIRECTIONS
    return many or call.gradient or call.polytopes or call.steps


def _directions(call: ManipulabilityRequest) -> Array | None:
    """Return unit vectors, shape (D, 3); the coordinate axes if polytopes are requested without any."""
    if call.directions is None:
        return np.eye(3) if call.polytopes else None
    vectors: Array = np.array(call.directions)
    largest = np.abs(vectors).max(axis=1, keepdims=True)
    if not largest.all():
        raise InvalidField(f"directions/{int(np.argmin(largest))}", "a vector of length zero has no direction")
    # Divide by the largest component first: squares of very large or small numbers overflow or underflow.
    vectors /= largest
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors


def _bounds(loaded: LoadedRobot, chain: Chain, call: ManipulabilityRequest) -> JointBounds | None:
    if not call.polytopes:
        if call.limits is not None:
            raise InvalidField("limits", "only allowed with `polytopes`")
        return None
    own = joint_bounds(loaded.robot, chain)
    if call.limits is None:
        return own
    return JointBounds(
        _given(chain, call.limits.joint_velocity, "limits/joint_velocity", own.velocity),
        _given(chain, call.limits.joint_effort, "limits/joint_effort", own.effort),
    )


def _given(chain: Chain, value: Configuration | None, field: str, otherwise: Array) -> Array:
    if value is None:
        return otherwise
    row: Array = one_configuration(chain, value, field)[0]
    if (row < 1e-6).any():
        raise InvalidField(field, "each limit must be at least 1e-06")
    return row


def _check_size(chain: Chain, call: ManipulabilityRequest, count: int, limits: Limits) -> None:
    parts = 2 if call.characteristic_length is None else 3
    directions = len(call.directions or ()) + 3 * call.polytopes
    a_part = _NUMBERS_A_PART + _NUMBERS_A_DIRECTION * directions + len(chain) * (call.gradient + 12 * call.polytopes)
    check_numbers(count * parts * a_part, limits)


def _content(
    chain: Chain,
    call: ManipulabilityRequest,
    result: Manipulability,
    directions: Array | None,
    bounds: JointBounds | None,
) -> dict[str, Any]:
    answer: dict[str, Any] = {
        **head(chain),
        "reference": call.reference,
        "task": call.task,
        "rank_tolerance": call.rank_tolerance,
        "characteristic_length": call.characteristic_length,
        "spaces": [_space(chain, part, ellipsoids) for part, ellipsoids in result.parts.items()],
    }
    if bounds is not None:
        answer["joints_without_velocity_limit"] = _unlimited(chain, bounds.velocity)
        answer["joints_without_effort_limit"] = _unlimited(chain, bounds.effort)
    columns: dict[Part, list[dict[str, Any]]] = {}
    for part, ellipsoids in result.parts.items():
        entries = _entries(ellipsoids)
        if directions is not None and part != "combined":
            if call.directions is not None:
                _add_transmission(entries, ellipsoids, directions, call.rank_tolerance)
            if bounds is not None:
                _add_polytopes(
                    entries, ellipsoids, directions, limited_motion(ellipsoids, result.Js, bounds, directions)
                )
        columns[part] = entries
    parts: tuple[Part, ...] = ("translation", "rotation", "combined")
    answer["results"] = [
        {part: columns[part][row] if part in columns else None for part in parts} for row in range(len(result.Js))
    ]
    if call.steps:
        answer["steps"] = worked_ellipsoids(result, call.characteristic_length, directions if call.directions else None)
    answer["certificate"] = result.certificate
    return answer


def _unlimited(chain: Chain, limits: Array) -> list[str]:
    return [name for name, limit in zip(chain.joint_names, limits, strict=True) if np.isnan(limit)]


def _space(chain: Chain, part: str, ellipsoids: Ellipsoids) -> dict[str, Any]:
    space = ellipsoids.space
    turning, sliding = ("rad/s", "N m"), ("m/s", "N")
    kinds = {sliding if slides else turning for slides in chain.flat.joints[:, 0].tolist()}
    joint_velocity, joint_force = kinds.pop() if len(kinds) == 1 else ("rad/s or m/s", "N m or N")
    velocity, force = ("rad/s", "N m") if part == "rotation" else ("m/s", "N")
    unit = f"{velocity} per {joint_velocity}"
    return {
        "part": part,
        "dimension": space.dimension,
        "basis": space.spread(space.basis.T).tolist(),
        "velocity_unit": unit,
        "force_unit": f"{force} per {joint_force}",
        "measure_unit": unit if space.dimension == 1 else f"({unit})^{space.dimension}",
    }


def _entries(ellipsoids: Ellipsoids) -> list[dict[str, Any]]:
    d = ellipsoids.space.dimension
    axes = ellipsoids.space.spread(ellipsoids.axes.transpose(0, 2, 1)).tolist()
    columns = zip(
        axes, ellipsoids.sigmas.tolist(), ellipsoids.measures.tolist(), ellipsoids.volumes.tolist(), strict=True
    )
    entries: list[dict[str, Any]] = []
    for vectors, sigmas, measure, volume in columns:
        rank = sum(sigma > 0.0 for sigma in sigmas)
        inverses = [_number(1.0 / sigma) if sigma > 0.0 else None for sigma in sigmas]
        entries.append(
            {
                "rank": rank,
                "singular": rank < d,
                "velocity_ellipsoid": {"axes": vectors, "semi_axes": sigmas, "unbounded": [False] * d},
                "force_ellipsoid": {
                    "axes": vectors,
                    "semi_axes": inverses,
                    "unbounded": [inverse is None for inverse in inverses],
                },
                "measure": measure if d else None,
                "volume": volume if d else None,
                "condition_number": _number(sigmas[0] / sigmas[-1]) if d and rank == d else None,
                "isotropy": sigmas[-1] / sigmas[0] if rank else None,
            }
        )
        if ellipsoids.gradients is not None:
            gradient = ellipsoids.gradients[len(entries) - 1]
            entries[-1]["gradient"] = gradient.tolist() if np.isfinite(gradient).all() else None
    return entries


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _add_transmission(
    entries: list[dict[str, Any]], ellipsoids: Ellipsoids, directions: Array, tolerance: float
) -> None:
    velocities, forces = transmission_ratios(ellipsoids, directions, tolerance)
    inside = is_within_task(ellipsoids.space, directions).tolist()
    vectors = directions.tolist()
    for entry, speeds, strengths in zip(entries, velocities.tolist(), forces.tolist(), strict=True):
        entry["transmission"] = [
            {
                "direction": direction,
                "velocity": speed if counts else None,
                "force": _number(strength) if counts else None,
                "force_unbounded": counts and _number(strength) is None,
            }
            for direction, speed, strength, counts in zip(vectors, speeds, strengths, inside, strict=True)
        ]


def _add_polytopes(
    entries: list[dict[str, Any]], ellipsoids: Ellipsoids, directions: Array, motions: list[LimitedMotion]
) -> None:
    space = ellipsoids.space
    inside = is_within_task(space, directions)
    vectors = directions[inside].tolist()

    def polytope(pairs: Array | None, vertices: Array | None) -> dict[str, Any] | None:
        if pairs is None:
            return None
        along = [
            {"direction": direction, "alone": _number(alone), "component": _number(component)}
            for direction, (alone, component) in zip(vectors, pairs[inside].tolist(), strict=True)
        ]
        return {"along": along, "vertices": None if vertices is None else space.spread(vertices).tolist()}

    for entry, motion in zip(entries, motions, strict=True):
        entry["velocity_polytope"] = polytope(motion.velocities, motion.velocity_vertices)
        entry["force_polytope"] = polytope(motion.forces, motion.force_vertices)


def _postures(
    loaded: LoadedRobot, chain: Chain, qs: Array, translation: Ellipsoids | None, kind: PictureFormat
) -> bytes:
    from gelenk.plots.motion.postures import postures_picture  # noqa: PLC0415

    if translation is None or len(qs) == 0:
        reason = f"an image shows the velocities of the tip at one or more configurations; these are {len(qs)}"
        raise InvalidField("task" if len(qs) else "joint_positions", reason)
    return postures_picture(loaded.record.name, chain, qs, translation, kind)


def _picture(
    loaded: LoadedRobot,
    chain: Chain,
    q: Array,
    result: Manipulability,
    call: ManipulabilityRequest,
    bounds: JointBounds | None,
    kind: PictureFormat,
) -> bytes:
    from gelenk.plots.ellipsoids import Overlay, manipulability_picture  # noqa: PLC0415

    translation, limited = result.parts.get("translation"), None
    directions = None if call.directions is None else _directions(call)
    if bounds is not None:
        if translation is None or not translation.space.is_plane:
            reason = "an image shows them of a translation in a plane, as of a planar arm or the task x, y"
            raise InvalidField("polytopes", reason)
        limited = limited_motion(translation, result.Js, bounds, np.eye(3))[0]
    overlay = Overlay(np.zeros((0, 3)) if directions is None else directions, call.rank_tolerance, limited)
    return manipulability_picture(loaded.record.name, chain, q, translation, kind, overlay)
