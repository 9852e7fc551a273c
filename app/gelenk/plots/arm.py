"""An arm as a line through its joints."""

from dataclasses import dataclass

import numpy as np

from gelenk.model.arrays import Array, Flags
from gelenk.model.chain import Chain
from gelenk.model.poses import transform


@dataclass(frozen=True, slots=True)
class ArmLine:
    """Points of a chain at a configuration, in its base frame.

    Attributes:
        points: The base, one point on the axis of each of the m joints of the way, the tip; shape (m + 2, 3), [m].
        slides: Which of the joints slide; shape (m,).
    """

    points: Array
    slides: Flags

    @property
    def tip(self) -> Array:
        """The last point; shape (3,)."""
        return np.asarray(self.points[-1])


def arm_line(chain: Chain, q: Array) -> ArmLine:
    """The line from base to tip at a configuration of shape (n,), mimic joints included.

    A sliding joint's point is that of its carriage.
    """
    flat = chain.flat
    T = np.eye(4)
    points = [T[:3, 3]]
    for placement, (slides, variable), (multiplier, offset) in zip(
        flat.placements[:-1], flat.joints.tolist(), flat.drives, strict=True
    ):
        T = (
            T
            @ transform(placement[9:], placement[:9].reshape(3, 3))
            @ _motion(slides, multiplier * q[variable] + offset)
        )
        points.append(T[:3, 3])
    T = T @ transform(flat.placements[-1, 9:], flat.placements[-1, :9].reshape(3, 3))
    return ArmLine(np.array([*points, T[:3, 3]]), flat.joints[:, 0] == 1)


def _motion(slides: int, value: float) -> Array:
    """The motion of a joint along or about its z axis."""
    if slides:
        return transform(np.array([0.0, 0.0, value]), np.eye(3))
    c, s = np.cos(value), np.sin(value)
    return transform(np.zeros(3), np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))
