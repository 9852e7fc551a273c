"""POST /v1/course/orientation: an orientation in every notation."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from gelenk.contract.orientation import OrientationRequest
from gelenk.course.orientation.orientation import NEARLY_DEGENERATE, Notations, notations
from gelenk.course.orientation.orientation_steps import GivenMotion, orientation_steps
from gelenk.course.orientation.rotations import DEGENERATE, FrameMotion, Validation, composed
from gelenk.language import translated as _
from gelenk.operations.outcome import json_only
from gelenk.robot.arrays import Array

_INLINE_MOTIONS = 2


@json_only
def run(call: OrientationRequest) -> dict[str, Any]:
    """Compose the given motions, and return the resulting orientation in every notation."""
    first, further, validations = call.motions()
    path = composed(first, further, np.array(call.points, dtype=float).reshape(-1, 3))
    T = path.transforms[-1]
    found = notations(np.ascontiguousarray(T[:3, :3]))
    return {
        **_notations(found),
        "position": T[:3, 3].tolist(),
        "inverse": _frame(path.inverse),
        "points": path.points.tolist(),
        "frames": [_frame(one) for one in path.transforms],
        "validations": validations,
        "steps": orientation_steps(_given(call, first, further, validations), path, found),
        "warnings": [*_projections(validations), *_nearly(found)],
        "certificate": {
            "max_rotation_error": found.error,
            "max_inverse_error": path.inverse_error,
            "max_point_error": path.point_error,
        },
    }


def _given(
    call: OrientationRequest, first: Array, further: Sequence[FrameMotion], validations: Sequence[Validation | None]
) -> list[GivenMotion]:
    transforms: list[FrameMotion] = [(first, "moving"), *further]
    written = [motion.written() for motion in (call, *call.then)]
    return [
        GivenMotion(name, np.array(numbers), axis, T, about, validation)
        for (name, numbers, axis), (T, about), validation in zip(written, transforms, validations, strict=True)
    ]


def is_heavy(call: OrientationRequest) -> bool:
    """Check whether a request takes the event loop more than about a millisecond."""
    return len(call.then) > _INLINE_MOTIONS


def _notations(found: Notations) -> dict[str, Any]:
    x, y, z, w = found.quaternion_xyzw
    axis, other_axis = (*found.axis_angle.axes, None, None)[:2]
    return {
        "rotation": found.rotation.tolist(),
        "quaternion_xyzw": (x, y, z, w),
        "quaternion_wxyz": (w, x, y, z),
        "rotation_vector": found.rotation_vector,
        "axis_angle": {"axis": axis, "other_axis": other_axis, "angle": found.axis_angle.angle},
        "zyz": found.zyz.solutions[0],
        "zyz_solutions": found.zyz.solutions,
        "rpy": found.rpy.solutions[0],
        "rpy_solutions": found.rpy.solutions,
        "degenerate": found.degeneracies,
        "degenerate_threshold": DEGENERATE,
    }


def _frame(T: Array) -> dict[str, Any]:
    return {"rotation": T[:3, :3].tolist(), "position": T[:3, 3].tolist()}


def _projections(validations: Sequence[Validation | None]) -> list[str]:
    text = _("Motion {number}: no rotation is nearer to this matrix than all others; one of the nearest was taken.")
    return [
        text.format(number=number)
        for number, found in enumerate(validations, start=1)
        if found is not None and not found.is_unique
    ]


def _nearly(found: Notations) -> list[str]:
    """Return warnings about angle triples that are determined, but badly conditioned."""
    zyz = _(
        "ZYZ is nearly degenerate, sin θ = {sine:.3g}: an error of R grows by the inverse of that in φ and ψ, while "
        "their sum (θ near 0) or difference (θ near π) stays accurate."
    )
    rpy = _(
        "RPY is nearly degenerate, cos pitch = {sine:.3g}: an error of R grows by the inverse of that in roll and yaw, "
        "while their difference (pitch near π/2) or sum (near -π/2) stays accurate."
    )
    return [
        text.format(sine=triple.conditioning)
        for text, triple in ((zyz, found.zyz), (rpy, found.rpy))
        if triple.degeneracy is None and triple.conditioning < NEARLY_DEGENERATE
    ]
