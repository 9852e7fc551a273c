"""Arms of six joints without a closed form, or nearly with one; targets at, beside and far from their singularities."""

from collections.abc import Iterator

import numpy as np

from gelenk.kinematics.simd.kernels import chain_jacobians
from gelenk.robot.arrays import Array
from tests.ik.arm_classes import QUARTER, Arm, Row, general, length, meeting, offset_elbow, parallel

_CRX = ((540.0, 540.0), (710.0, 540.0), (700.0, 550.0), (410.0, 430.0))
"""Upper arm and forearm of Fanuc's CRX series [mm]; their wrists are offset by 150 mm."""
_UR = (
    (-0.24365, -0.21325, 0.1519, 0.11235, 0.08535, 0.0819),
    (-0.425, -0.3922, 0.1625, 0.1333, 0.0997, 0.0996),
    (-0.6127, -0.57155, 0.1807, 0.17415, 0.11985, 0.11655),
)
_DIGITS = (3, 4, 6, 9)
_OFF = (1e-6, 25e-6, 1e-4, 1e-3)


def crx(upper: float, fore: float) -> list[Row]:
    """Fanuc's CRX series: the last three axes do not meet."""
    return [
        (0.0, -QUARTER, 0.0, 0.0),
        (upper / 1000.0, np.pi, 0.0, -QUARTER),
        (0.0, -QUARTER, 0.0, 0.0),
        (0.0, QUARTER, -fore / 1000.0, 0.0),
        (0.0, -QUARTER, 0.15, 0.0),
        (0.0, np.pi, -0.16, 0.0),
    ]


def jaco(half: float) -> list[Row]:
    """Kinova's Jaco 2 with a wrist that is bent twice by an angle; its manual's table."""
    share = np.sin(half) / np.sin(2.0 * half)
    fore, wrist, hand = 0.2073 + share * 0.0741, 2.0 * share * 0.0741, share * 0.0741 + 0.16
    return [
        (0.0, QUARTER, 0.2755, 0.0),
        (0.41, np.pi, 0.0, -QUARTER),
        (0.0, QUARTER, -0.0098, QUARTER),
        (0.0, 2.0 * half, -fore, 0.0),
        (0.0, 2.0 * half, -wrist, -np.pi),
        (0.0, np.pi, -hand, 1.7453292519943295),
    ]


GEN3_LITE: list[Row] = [
    (0.0, QUARTER, 0.2433, 0.0),
    (0.28, np.pi, 0.03, QUARTER),
    (0.0, QUARTER, 0.02, QUARTER),
    (0.0, QUARTER, 0.245, QUARTER),
    (0.0, QUARTER, 0.057, np.pi),
    (0.0, 0.0, 0.235, QUARTER),
]
XARM6: list[Row] = [
    (0.0, -QUARTER, 0.267, 0.0),
    (0.2894886, 0.0, 0.0, -1.3849179),
    (0.0775, -QUARTER, 0.0, 1.3849179),
    (0.0, QUARTER, 0.3425, 0.0),
    (0.076, -QUARTER, 0.0, 0.0),
    (0.0, 0.0, 0.097, 0.0),
]
WELDER: list[Row] = [
    (0.15, -QUARTER, 0.45, 0.0),
    (0.6, 0.0, 0.0, -QUARTER),
    (0.2, -QUARTER, 0.0, 0.0),
    (0.0, QUARTER, 0.64, 0.0),
    (0.03, -QUARTER, 0.0, 0.0),
    (0.0, 0.0, 0.2, 0.0),
]
"""An arc welder with a hollow wrist, whose last axis is 30 mm off."""


def universal(lengths: tuple[float, ...], digits: int) -> list[Row]:
    """The UR series, its angles rounded."""
    a2, a3, d1, d4, d5, d6 = lengths
    quarter = round(QUARTER, digits)
    return [
        (0.0, quarter, d1, 0.0),
        (a2, 0.0, 0.0, 0.0),
        (a3, 0.0, 0.0, 0.0),
        (0.0, quarter, d4, 0.0),
        (0.0, -quarter, d5, 0.0),
        (0.0, 0.0, d6, 0.0),
    ]


def nearly_spherical(rng: np.random.Generator, off: float, skew: bool) -> list[Row]:
    """An industrial arm whose wrist is spherical but for a little."""
    drawn = [*offset_elbow(rng), *meeting(rng, square=not skew)]
    a, alpha, d, theta = drawn[4]
    drawn[4] = a + off, alpha, d + 0.5 * off, theta
    return drawn


def nearly_parallel(rng: np.random.Generator, off: float) -> list[Row]:
    """Axes 2, 3 and 4 parallel but for a little, the others skew."""
    drawn = parallel(1)(rng)
    a, alpha, d, theta = drawn[1]
    drawn[1] = a, alpha + off, d, theta
    return drawn


def offset_wrist(rng: np.random.Generator) -> list[Row]:
    """Axes 2 and 3 parallel, axes 4 and 6 apart, all square: the pattern of most painters and collaborative arms."""
    return [
        (0.0, QUARTER, length(rng), 0.0),
        (length(rng), 0.0, 0.0, 0.0),
        (0.2 * length(rng), QUARTER, 0.3 * length(rng), 0.0),
        (0.0, -QUARTER, length(rng), 0.0),
        (0.0, QUARTER, 0.4 * length(rng), 0.0),
        (0.0, 0.0, length(rng), 0.0),
    ]


def _drawn() -> Iterator[tuple[str, list[Row], str]]:
    for k, (upper, fore) in enumerate(_CRX):
        yield f"crx {k}", crx(upper, fore), "RRRRRR"
    yield "jaco 2, 60 degrees", jaco(np.pi / 6.0), "RRRRRR"
    yield "jaco 2, 55 degrees", jaco(11.0 * np.pi / 72.0), "RRRRRR"
    yield "gen3 lite", GEN3_LITE, "RRRRRR"
    yield "xarm6", XARM6, "RRRRRR"
    yield "arc welder", WELDER, "RRRRRR"
    for k, lengths in enumerate(_UR):
        for digits in _DIGITS:
            yield f"ur {k}, {digits} digits", universal(lengths, digits), "RRRRRR"
    rng = np.random.default_rng(19)
    for k in range(4):
        yield f"axes 1 2 3 parallel, {k}", parallel(0)(rng), "RRRRRR"
    for k in range(3):
        yield f"axes 4 5 6 parallel, {k}", parallel(3)(rng), "RRRRRR"
    for off in _OFF:
        yield f"square wrist off by {off:g} m", nearly_spherical(rng, off, skew=False), "RRRRRR"
        yield f"skew wrist off by {off:g} m", nearly_spherical(rng, off, skew=True), "RRRRRR"
        yield f"axes 2 3 4 off by {off:g} rad", nearly_parallel(rng, off), "RRRRRR"
    for k in range(5):
        yield f"offset wrist {k}", offset_wrist(rng), "RRRRRR"
    for k in range(10):
        yield f"general {k}", general(rng, 6), "RRRRRR"
    for types in ("PRRRRR", "RPRRRR", "RRPRRR", "RRRPRR", "RRRRRP", "PRPRRR", "RRRPPR", "PRRRPR"):
        yield f"general {types}", general(rng, 6), types


TABLES = {name: (table, types) for name, table, types in _drawn()}


def arm(name: str) -> Arm:
    """One of the arms."""
    return Arm(*TABLES[name])


def regular(arm: Arm, count: int, seed: int) -> Array:
    """Configurations of any kind; shape (count, 6)."""
    return arm.configurations(count, seed)


def singular(arm: Arm, count: int, seed: int) -> Array:
    """Configurations where the Jacobian loses rank, by bisection of its determinant; shape (count, 6)."""
    rng = np.random.default_rng(seed)
    ends = arm.configurations(8 * count, seed), arm.configurations(8 * count, seed + 1)
    low, high = (end.copy() for end in ends)
    at_low = np.linalg.det(chain_jacobians(arm.chain.flat, low)[2])
    apart = at_low * np.linalg.det(chain_jacobians(arm.chain.flat, high)[2]) < 0.0
    low, high, at_low = low[apart][:count], high[apart][:count], at_low[apart][:count]
    for _ in range(60):
        middle = 0.5 * (low + high)
        left = np.linalg.det(chain_jacobians(arm.chain.flat, middle)[2]) * at_low > 0.0
        low, high = np.where(left[:, None], middle, low), np.where(left[:, None], high, middle)
    return np.asarray(rng.permutation(low))


def beside_singular(arm: Arm, offset: float, count: int, seed: int) -> Array:
    """Configurations so far from a singular one, in any direction; shape (count, 6)."""
    qs = singular(arm, count, seed)
    away = np.random.default_rng(seed + 2).normal(size=qs.shape)
    return np.asarray(qs + offset * away / np.linalg.norm(away, axis=1, keepdims=True))
