"""The picture of statics: a planar arm, the force at its tip, and its lever arm about each joint."""

import numpy as np

from gelenk.contract.statics import StaticsRequest
from gelenk.errors import InvalidField
from gelenk.ik.search.task import Task
from gelenk.ik.search.words import DIRECTIONS
from gelenk.operations.outcome import PictureFormat
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain

_FLAT = 1e-9


def levers_picture(
    chain: Chain, call: StaticsRequest, q: Array, task: Task, wrenches: Array | None, torques: Array,
    kind: PictureFormat,
) -> bytes:  # fmt: skip
    """Draw the lever arms of a force; raises InvalidField for what such a picture cannot show.

    `q` and `torques` have one row per configuration, `wrenches` one number per direction of the task.
    """
    from gelenk.kinematics.ellipsoids.manipulability import space_of  # noqa: PLC0415
    from gelenk.plots.arm import arm_line  # noqa: PLC0415
    from gelenk.plots.course.planar_arm import levers_figure  # noqa: PLC0415
    from gelenk.plots.figure import as_bytes  # noqa: PLC0415

    _check(call, len(q), wrenches)
    points, slides = arm_line(chain, q[0])
    space = space_of(chain, (0, 1, 2))
    if not space.is_plane or len(slides) != len(chain):
        raise InvalidField("Accept", "an image shows the lever arms of a planar arm without mimic joints")
    wrench = np.zeros(6)
    wrench[[DIRECTIONS.index(direction) for direction in task.directions]] = wrenches[0] if wrenches is not None else 0
    plane = space.spread(space.basis.T)
    force, size = plane @ wrench[:3], float(np.abs(wrench).max())
    if np.abs(plane.T @ force - wrench[:3]).max() > _FLAT * size or np.abs(wrench[3:]).max() > _FLAT * size:
        raise InvalidField("wrenches", "an image shows a force in the plane of the arm, without a moment")
    return as_bytes(levers_figure(points[1:] @ plane.T, force.tolist(), torques[0].tolist(), slides.tolist()), kind)


def _check(call: StaticsRequest, count: int, wrenches: Array | None) -> None:
    if count != 1:
        raise InvalidField("joint_positions", f"an image shows one configuration; these are {count}")
    if call.gravity is not False:
        raise InvalidField("gravity", "an image shows the lever arms of the force at the tip, and not the weight")
    if wrenches is None:
        raise InvalidField("wrenches", "an image needs a force at the tip")
    for field in ("expressed_in", "point_frame", "point"):
        if getattr(call, field) is not None:
            raise InvalidField(field, "an image shows a force at the tip, in the base's axes")
    if call.reference != "local_world_aligned":
        raise InvalidField("reference", "an image shows a force at the tip, in the base's axes, `local_world_aligned`")
