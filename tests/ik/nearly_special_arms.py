"""Arms of six turning joints that are special but for a little: wrists, shoulders, parallel axes, all that at once."""

from collections.abc import Callable

import numpy as np

from tests.ik import six_joint_arms
from tests.ik.arm_classes import QUARTER, Arm, Row, anthropomorphic, general, meeting, offset_elbow, parallel, shoulder
from tests.ik.arms import UR5

OFFSETS = (1e-2, 1e-3, 1e-5, 1e-7)
_Little = Callable[[], float]


def _all_off(drawn: list[Row], little: _Little) -> list[Row]:
    """As a calibration leaves an arm: every number is off."""
    return [(a + little(), alpha + little(), d + little(), theta + little()) for a, alpha, d, theta in drawn]


def _row_off(drawn: list[Row], k: int, little: _Little) -> list[Row]:
    """The lengths of one row are off."""
    a, alpha, d, theta = drawn[k]
    return [*drawn[:k], (a + little(), alpha, d + little(), theta), *drawn[k + 1 :]]


def _leaning(drawn: list[Row], first: int, little: _Little) -> list[Row]:
    """Two angles between axes are off."""
    return [
        (a, alpha + little() if k in {first, first + 1} else alpha, d, theta)
        for k, (a, alpha, d, theta) in enumerate(drawn)
    ]


def _short(drawn: list[Row], k: int, little: _Little) -> list[Row]:
    """A length is next to nothing."""
    a, alpha, _, theta = drawn[k]
    return [*drawn[:k], (a, alpha, little(), theta), *drawn[k + 1 :]]


_KINDS: dict[str, Callable[[np.random.Generator, _Little], list[Row]]] = {
    "square wrist": lambda r, little: _row_off([*offset_elbow(r), *meeting(r, square=True)], 4, little),
    "skew wrist": lambda r, little: _row_off([*offset_elbow(r), *meeting(r)], 4, little),
    "three joints and a wrist": lambda r, little: _row_off([*general(r, 3), *meeting(r)], 4, little),
    "a shoulder and three joints": lambda r, little: _row_off([*shoulder(r), *general(r, 3)], 1, little),
    **{
        f"axes {k + 1} {k + 2} {k + 3}": lambda r, little, k=k: _leaning(parallel(k)(r), k, little)  # type: ignore[misc]
        for k in range(4)
    },
    "calibrated ur": lambda _, little: _all_off(UR5, little),
    "calibrated industrial": lambda r, little: _all_off([*offset_elbow(r), *meeting(r, square=True)], little),
    "calibrated anthropomorphic": lambda r, little: _all_off(
        [*anthropomorphic(r)[:2], (0.0, QUARTER, 0.0, 0.0), *meeting(r, square=True)], little
    ),
    "calibrated crx": lambda _, little: _all_off(six_joint_arms.crx(540.0, 540.0), little),
    "short wrist": lambda r, little: _short(six_joint_arms.offset_wrist(r), 4, little),
}
KINDS = tuple(_KINDS)


def arm(kind: str, off: float, seed: int) -> Arm:
    """A random arm that is special but for so much, [m, rad]."""
    rng = np.random.default_rng([seed, round(-10.0 * np.log10(off))])
    return Arm(_KINDS[kind](rng, lambda: off * rng.uniform(0.3, 1.0) * rng.choice((-1.0, 1.0))), "RRRRRR")
