"""Motion of the tip for given joint motions: twist, acceleration, jerk and snap.

The Jacobian is expanded as a power series in time, J(q(t)) = Σ J_k tᵏ, by multiplying truncated series along the
chain, so its derivatives J̇, J̈ and J⃛ are exact. The tip's motion follows by the product rule:

    v = J q̇    a = J q̈ + J̇ q̇    jerk = J q⃛ + 2 J̇ q̈ + J̈ q̇    snap = J q⁗ + 3 J̇ q⃛ + 3 J̈ q̈ + J⃛ q̇

A series of matrices has shape (K, …, rows, columns): entry k is the coefficient of tᵏ.
"""

import math
from dataclasses import dataclass

import numpy as np

from gelenk.kinematics.judge.motion import certify_motion
from gelenk.kinematics.judge.words import Reference, TipMotionCertificate
from gelenk.kinematics.simd.kernels import chain_jacobians, chain_poses
from gelenk.robot.arrays import Array, Flags, cross_matrices
from gelenk.robot.chain import Chain, FlatChain
from gelenk.robot.poses import Poses
from gelenk.robot.robot import RobotModel

_ROOM = 4_000_000
"""Largest number of entries in an intermediate array: larger batches are split."""


@dataclass(frozen=True, slots=True)
class TipMotion:
    """The tip's motion at N configurations, linear before angular; order k belongs to q's k-th derivative.

    Attributes:
        poses: T_base_tip.
        derivatives: Twist, acceleration, jerk, snap, as many as rates were given; shape (N, 6) each, [m/sᵏ, rad/sᵏ].
        spatial_accelerations: Spatial accelerations, None for a twist alone; shape (N, 6), [m/s², rad/s²].
        jacobians: J, J̇, J̈, J⃛ of `local_world_aligned`, one per derivative; shape (K, N, 6, n).
    """

    poses: Poses
    derivatives: tuple[Array, ...]
    spatial_accelerations: Array | None
    jacobians: Array
    certificate: TipMotionCertificate


def tip_motion(
    robot: RobotModel, chain: Chain, qs: Array, rates: Array, reference: Reference = "local_world_aligned"
) -> TipMotion:
    """Compute and certify derivatives of the tip's motion.

    Args:
        qs: Configurations; shape (N, n), [rad or m].
        rates: q̇, q̈, q⃛, q⁗, the first one to four of them; shape (K, N, n), [rad/sᵏ or m/sᵏ].
        reference: `local_world_aligned`: derivatives of the tip's position and of its angular velocity, along the
            base's axes. `local`: the same vectors along the tip's axes. `world`: along the base's axes, the linear
            part for the point of the tip's body that coincides with the base's origin.

    Raises:
        CertificationFailed: Pinocchio's derivatives differ by more than rounding.
    """
    poses = Poses(*chain_poses(chain.flat, qs))
    Js = jacobian_derivatives(chain, qs, rates[:-1])
    derivatives = product_rule(Js, rates)
    # It changes its reference as a twist does.
    spatial = in_reference(poses, (spatial_accelerations(derivatives),), reference)[0] if len(rates) > 1 else None
    views = in_reference(poses, derivatives, reference)
    certificate = certify_motion(robot, chain, qs, rates, views, spatial, reference)
    return TipMotion(poses, views, spatial, Js, certificate)


def product_rule(Js: Array, rates: Array) -> tuple[Array, ...]:
    """Combine derivatives of J and q into those of the tip, r⁽ᵏ⁾ = Σ_j (k-1 over j) J⁽ʲ⁾ q⁽ᵏ⁻ʲ⁾; shape (N, 6) each.

    `Js` are J, J̇, …, shape (K, N, 6, n), and `rates` q̇, q̈, …, shape (K, N, n).
    """
    results = []
    for k in range(1, len(rates) + 1):
        result = np.zeros(Js.shape[1:3])
        for j in range(k):
            result += math.comb(k - 1, j) * (Js[j] @ rates[k - 1 - j][:, :, None])[:, :, 0]
        results.append(result)
    return tuple(results)


def spatial_accelerations(derivatives: tuple[Array, ...]) -> Array:
    """Compute the spatial acceleration (p̈ - ω × ṗ; ω̇) from the twist and the classical (p̈; ω̇); shape (N, 6).

    It is the derivative of the twist's coordinates in the moving tip, rotated into the base's axes [Featherstone2008].
    """
    twists, accelerations = derivatives[:2]
    spatial = accelerations.copy()
    spatial[:, :3] -= np.cross(twists[:, 3:], twists[:, :3])
    return spatial


def in_reference(poses: Poses, derivatives: tuple[Array, ...], reference: Reference) -> tuple[Array, ...]:
    """Convert derivatives in `local_world_aligned` to another reference, see `tip_motion`; shape (N, 6) each."""
    if reference == "local":
        return tuple(_turned(poses, derivative) for derivative in derivatives)
    if reference == "world":
        return _at_base_origin(poses, derivatives)
    return derivatives


def jacobian_derivatives(chain: Chain, qs: Array, rates: Array) -> Array:
    """Compute J in the base's axes at the tip and its exact time derivatives J̇, J̈, …; shape (K, N, 6, n).

    The rates are q̇, q̈, …, one per requested derivative; shape (K - 1, N, n), K - 1 may be 0.
    """
    count, n = qs.shape
    orders = len(rates) + 1
    if orders == 1:
        return chain_jacobians(chain.flat, qs)[2][None]
    Js = np.empty((orders, count, 6, n))
    rows = max(1, _ROOM // max(1, len(chain.flat.joints) * (4 * orders) ** 2))
    for first in range(0, count, rows):
        part = slice(first, first + rows)
        Js[:, part] = _jacobian_series(chain.flat, np.concatenate((qs[None, part], rates[:, part])))
    Js *= np.array([math.factorial(k) for k in range(orders)], dtype=float)[:, None, None, None]
    return Js


def _jacobian_series(flat: FlatChain, derivatives: Array) -> Array:
    """J(t) as a power series, from q and its derivatives of shape (K, N, n); shape (K, N, 6, n)."""
    orders, _, n = derivatives.shape
    slides, variables = flat.joints[:, 0] == 1, flat.joints[:, 1]
    factorials = np.array([math.factorial(k) for k in range(orders)], dtype=float)
    values = flat.drives[:, 0] * (derivatives / factorials[:, None, None])[:, :, variables]
    values[0] += flat.drives[:, 1]
    axes, points, tip = _axes_series(flat, _motion_series(values, slides))
    # v = z × (p - o) for a revolute joint, as a product with the matrix [z]×.
    arms = tip[:, :, None] - points
    turning = series_product(cross_matrices(axes), arms[..., None])[..., 0]
    columns = np.concatenate(
        (np.where(slides[:, None], axes, turning), np.where(slides[:, None], 0.0, axes)), axis=-1
    )  # (K, N, m, 6)
    selection = np.zeros((len(variables), n))
    selection[np.arange(len(variables)), variables] = flat.drives[:, 0]
    return np.asarray(columns.swapaxes(-1, -2) @ selection)


def _motion_series(values: Array, slides: Flags) -> Array:
    """Each joint's motion about or along its own z as a series of (4, 4); values (K, N, m) → (K, N, m, 4, 4)."""
    orders = len(values)
    # e = exp(i θ) satisfies ė = i θ̇ e, which gives its coefficients one after another.
    circle = np.zeros(values.shape, dtype=complex)
    circle[0] = np.exp(1j * values[0])
    for k in range(1, orders):
        for j in range(1, k + 1):
            circle[k] += (1j * j / k) * values[j] * circle[k - j]
    motions = np.zeros((*values.shape, 4, 4))
    motions[0, ..., [2, 3], [2, 3]] = 1.0
    turns: Flags = ~slides
    motions[:, :, turns, 0, 0] = motions[:, :, turns, 1, 1] = circle.real[:, :, turns]
    motions[:, :, turns, 1, 0] = circle.imag[:, :, turns]
    motions[:, :, turns, 0, 1] = -circle.imag[:, :, turns]
    motions[0, :, slides, 0, 0] = motions[0, :, slides, 1, 1] = 1.0
    motions[:, :, slides, 2, 3] = values[:, :, slides]
    return motions


def _axes_series(flat: FlatChain, motions: Array) -> tuple[Array, Array, Array]:
    """Series of each joint's axis and a point on it, shape (K, N, m, 3), and of the tip's position, shape (K, N, 3)."""
    orders, count, joints = motions.shape[:3]
    placements = np.zeros((joints + 1, 4, 4))
    placements[:, :3, :3] = flat.placements[:, :9].reshape(-1, 3, 3)
    placements[:, :3, 3] = flat.placements[:, 9:]
    placements[:, 3, 3] = 1.0
    steps = _blocks(motions @ placements[1:])  # (N, m, 4 K, 4 K)
    frames = np.zeros((joints + 1, count, 3, orders * 4))
    frames[0, :, :, :4] = placements[0, :3]
    for i in range(joints):
        np.matmul(frames[i], steps[:, i], out=frames[i + 1])
    series = frames.reshape(joints + 1, count, 3, orders, 4).transpose(3, 1, 0, 2, 4)
    return series[:, :, :-1, :, 2], series[:, :, :-1, :, 3], series[:, :, -1, :, 3]


def series_product(a: Array, b: Array) -> Array:
    """Multiply two truncated series of matrices; shapes (K, …, r, s) and (K, …, s, t) → (K, …, r, t)."""
    product = np.zeros((*a.shape[:-1], b.shape[-1]))
    for k in range(len(a)):
        for j in range(k + 1):
            product[k] += a[j] @ b[k - j]
    return product


def _blocks(series: Array) -> Array:
    """A series as one matrix that multiplies rows of coefficients: block (j, k) is coefficient k - j."""
    orders = len(series)
    padded = np.concatenate((series, np.zeros((1, *series.shape[1:]))))
    lags = np.arange(orders) - np.arange(orders)[:, None]
    blocks = padded[np.where(lags < 0, orders, lags)]  # (K, K, N, m, 4, 4)
    count, joints = series.shape[1:3]
    return blocks.transpose(2, 3, 0, 4, 1, 5).reshape(count, joints, 4 * orders, 4 * orders)


def _turned(poses: Poses, vectors: Array) -> Array:
    """Express both halves of vectors (N, 6) in the tip's axes."""
    halves = vectors.reshape(-1, 2, 3) @ poses.rotations
    return halves.reshape(-1, 6)


def _at_base_origin(poses: Poses, derivatives: tuple[Array, ...]) -> tuple[Array, ...]:
    """Derivatives at the base's origin: p⁽ᵏ⁾ - R⁽ᵏ⁾Rᵀ p, where G = R(t)Rᵀ satisfies Ġ = [ω]× G with G(0) = 1."""
    spins = [cross_matrices(derivative[:, 3:]) / math.factorial(k) for k, derivative in enumerate(derivatives)]
    turns = [np.broadcast_to(np.eye(3), spins[0].shape)]
    results = []
    for k, derivative in enumerate(derivatives, start=1):
        turns.append(np.sum([spins[j] @ turns[k - 1 - j] for j in range(k)], axis=0) / k)
        result = derivative.copy()
        result[:, :3] -= math.factorial(k) * (turns[k] @ poses.positions[:, :, None])[:, :, 0]
        results.append(result)
    return tuple(results)
