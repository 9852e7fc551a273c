"""An arm as a line through its joints."""

import numpy as np

from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import transform


def arm_line(chain: Chain, q: Array) -> tuple[Array, Flags]:
    """Return base, a point on the axis of each of m joints, and tip; shape (m + 2, 3), [m]; and which joints slide.

    All are in the base frame, mimic joints included. The point of a prismatic joint moves with its carriage.
    """
    flat = chain.flat
    T = np.eye(4)
    points = [T[:3, 3]]
    for placement, (slides, variable), (multiplier, offset) in zip(
        flat.placements[:-1], flat.joints.tolist(), flat.drives, strict=True
    ):
        T = T @ transform(placement[9:], placement[:9].reshape(3, 3))
        T = T @ _motion(slides, multiplier * q[variable] + offset)
        points.append(T[:3, 3])
    T = T @ transform(flat.placements[-1, 9:], flat.placements[-1, :9].reshape(3, 3))
    return np.array([*points, T[:3, 3]]), flat.joints[:, 0] == 1


def _motion(slides: int, value: float) -> Array:
    """Return the transform of a joint's motion along or about its z axis; shape (4, 4)."""
    if slides:
        return transform(np.array([0.0, 0.0, value]), np.eye(3))
    c, s = np.cos(value), np.sin(value)
    return transform(np.zeros(3), np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))
