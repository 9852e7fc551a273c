"""Homogeneous transforms as URDF origins."""

import numpy as np

from gelenk.model.arrays import Array
from gelenk.model.description import Origin
from gelenk.model.notations import rpy_from_rotations


def origin_of(T: Array) -> Origin:
    """Return a homogeneous transform (4, 4) as a URDF origin; its angles reproduce the rotation to rounding."""
    # Adding zero turns -0.0 into 0.0, which reads better.
    x, y, z = (float(value) + 0.0 for value in T[:3, 3])
    roll, pitch, yaw = (float(value) + 0.0 for value in rpy_from_rotations(np.ascontiguousarray(T[None, :3, :3]))[0])
    return Origin((x, y, z), (roll, pitch, yaw))
