"""The arms whose solutions are all listed, and their targets.

A target is the pose of a random configuration all the way round, so each can be reached: joint limits do not count
here, because not every solver knows of them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import accumulate

import numpy as np

from gelenk.robot.arrays import Array, Flags
from gelenk.robot.chain import Chain
from gelenk.robot.poses import transform
from gelenk.robot.robot import RobotModel
from tests.ik.arm_classes import CLASSES, general
from tests.ik.arms import IRB, catalogue_arm, table_arm

CLOSED, GENERAL, REDUNDANT = "closed form", "general", "seven joints"
"""What is asked of an arm's solvers: a limit of time, to be quicker than a peer, and nothing but the figure."""
ELBOW_ANGLE = 0.7
"""At which an arm of seven joints is asked for, about the line from shoulder to wrist, [rad]."""
LOCKED = 2
"""The joint that a solver without elbow angles gets locked where the target was drawn with it."""

_QUARTER = 0.5 * np.pi
_IIWA = [
    (0.0, -_QUARTER, 0.36, 0.0),
    (0.0, _QUARTER, 0.0, 0.0),
    (0.0, _QUARTER, 0.42, 0.0),
    (0.0, -_QUARTER, 0.0, 0.0),
    (0.0, -_QUARTER, 0.4, 0.0),
    (0.0, _QUARTER, 0.0, 0.0),
    (0.0, 0.0, 0.126, 0.0),
]
"""Proportions of a KUKA LBR iiwa 14."""
_MANSEUR_DOTY = [
    (0.3, _QUARTER, 0.0, 0.0),
    (1.0, np.pi / 180.0, 0.0, 0.0),
    (0.0, _QUARTER, 0.2, 0.0),
    (1.5, np.pi / 180.0, 0.0, 0.0),
    (0.0, _QUARTER, 0.0, 0.0),
    (1.1353, 1.4331, 0.0, 0.0),
]
"""The arm of which one target has 16 solutions [Manseur1989]."""
_XARM6 = [
    (0.0, -_QUARTER, 0.267, 0.0),
    (0.2894886, 0.0, 0.0, 0.0),
    (0.0775, -_QUARTER, 0.0, 0.0),
    (0.0, _QUARTER, 0.3425, 0.0),
    (0.076, -_QUARTER, 0.0, 0.0),
    (0.0, 0.0, 0.097, 0.0),
]
"""Proportions of a UFactory xArm6."""


@dataclass(frozen=True)
class Case:
    """An arm to be listed.

    Attributes:
        kind: `CLOSED`, `GENERAL` or `REDUNDANT`.
        build: The robot, and the chain from its base to its tip.
    """

    kind: str
    build: Callable[[], tuple[RobotModel, Chain]]


CASES: dict[str, Case] = {
    "ur5": Case(CLOSED, lambda: catalogue_arm("ur5")),
    "ur10": Case(CLOSED, lambda: catalogue_arm("ur10")),
    "puma560": Case(CLOSED, lambda: catalogue_arm("puma560")),
    "offset shoulder and elbow (IRB)": Case(CLOSED, lambda: table_arm(IRB)),
    "anthropomorphic_wrist": Case(CLOSED, lambda: catalogue_arm("anthropomorphic_wrist")),
    "kinova": Case(CLOSED, lambda: catalogue_arm("kinova")),
    "stanford (RRP and a wrist)": Case(CLOSED, lambda: catalogue_arm("stanford")),
    "skew arm and a wrist (quartic)": Case(CLOSED, lambda: of_class("RRR and a skew wrist")),
    "parallel axes 3, 4, 5": Case(CLOSED, lambda: of_class("parallel axes 3 4 5")),
    "xArm6": Case(GENERAL, lambda: table_arm(_XARM6)),
    "general 6R, first": Case(GENERAL, lambda: table_arm(general(np.random.default_rng(1), 6))),
    "general 6R, second": Case(GENERAL, lambda: table_arm(general(np.random.default_rng(2), 6))),
    "Manseur and Doty": Case(GENERAL, lambda: table_arm(_MANSEUR_DOTY)),
    "iiwa (7R, one elbow angle)": Case(REDUNDANT, lambda: table_arm(_IIWA, "R" * 7)),
}


def of_class(name: str) -> tuple[RobotModel, Chain]:
    """A random member of a class of arms."""
    arm = CLASSES[name].arm(1)
    return arm.robot, arm.chain


@cache
def arm_of(name: str) -> tuple[RobotModel, Chain]:
    """The robot and the chain of a case, built once in a process."""
    return CASES[name].build()


def drawn(chain: Chain, count: int) -> Array:
    """Random configurations: turning joints all the way round, sliding ones within their limits; shape (count, n)."""
    slides = sliding(chain)
    lower, upper = np.where(slides, chain.lower, -np.pi), np.where(slides, chain.upper, np.pi)
    return np.random.default_rng(1).uniform(lower, upper, (count, len(chain)))


def sliding(chain: Chain) -> Flags:
    """Which variables slide; shape (n,)."""
    slides = np.zeros(len(chain), dtype=bool)
    slides[chain.flat.joints[:, 1]] = chain.flat.joints[:, 0] == 1
    return slides


def placements(chain: Chain) -> Array:
    """Of each frame in the one before it at zero: joints about their z axes, then the tip; shape (n + 1, 4, 4).

    Raises:
        NotImplementedError: A joint slides, or is not moved one to one.
    """
    if sliding(chain).any():
        raise NotImplementedError("prismatic joints")
    if len(chain.flat.joints) != len(chain) or (chain.flat.drives != (1.0, 0.0)).any():
        raise NotImplementedError("mimic joints")
    return np.array([transform(row[9:], row[:9].reshape(3, 3)) for row in chain.flat.placements])


def frames(chain: Chain) -> Array:
    """The same in the base; shape (n + 1, 4, 4)."""
    return np.array(list(accumulate(placements(chain), np.matmul)))
