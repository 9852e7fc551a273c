"""How fast the tip moves and turns, by differences of poses: along the parabola that joints have at each moment."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

_PLACES = np.array([-2.0, -1.0, 0.0, 1.0, 2.0])
_FIRST = np.array([1.0, -8.0, 0.0, 8.0, -1.0]) / 12.0
_SECOND = np.array([-1.0, 16.0, -30.0, 16.0, -1.0]) / 12.0
_REACH = 3e-3
"""How far joints move from place to place, [rad or m]."""


def tip_rates(poses: Callable[[Array], Array], q: Array, velocity: Array, acceleration: Array) -> Array:
    """Speed, angular speed, acceleration and angular acceleration; shape (N, n) each → (N, 4).

    Args:
        poses: T_base_tip of configurations; shape (N, n) → (N, 4, 4).
        q: Configurations, [rad or m].
        velocity: [rad/s or m/s].
        acceleration: [rad/s² or m/s²].
    """
    paces = np.maximum(np.abs(velocity).max(axis=1), np.sqrt(np.abs(acceleration).max(axis=1)))
    step = _REACH / np.maximum(paces, 1e-9)
    times = _PLACES[:, None, None] * step[:, None]
    Ts = poses((q + times * velocity + 0.5 * times**2 * acceleration).reshape(-1, q.shape[1]))
    Ts = Ts.reshape(len(_PLACES), len(q), 4, 4)
    first, second = (
        np.tensordot(stencil, Ts, 1) / step[:, None, None] ** k for k, stencil in ((1, _FIRST), (2, _SECOND))
    )
    back = Ts[2, :, :3, :3].transpose(0, 2, 1)
    spins = [rates[:, :3, :3] @ back for rates in (first, second)]
    # The skew part of R̈ Rᵀ = [ω̇]× + [ω]×² is the first.
    turns = [0.5 * (spin - spin.transpose(0, 2, 1)) for spin in spins]
    vectors = (first[:, :3, 3], turns[0][:, (2, 0, 1), (1, 2, 0)], second[:, :3, 3], turns[1][:, (2, 0, 1), (1, 2, 0)])
    return np.stack([np.linalg.norm(vector, axis=1) for vector in vectors], axis=1)
