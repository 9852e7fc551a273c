"""Tables that manufacturers publish against descriptions that others wrote: B · DH(q) · T, with B and T known.

Base and tool are never fitted: a free base would absorb an error of the first row, a free tool one of the last.
"""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from gelenk.kinematics.simd.kernels import chain_poses
from gelenk.robot.arrays import Array
from gelenk.robot.notations import pose_errors
from gelenk.robot.poses import Poses
from tests.oracles import catalogue, dh_columns
from tests.oracles.dh_columns import Table, shift, turn
from tests.robots import robot, samples

HALF_TURN = turn(2, np.pi)
TO_EE_LINK = turn(0, np.pi / 2) @ turn(2, np.pi / 2)
TO_HAND_TCP = turn(2, -np.pi / 4) @ shift(2, 0.1034)


class Pair(NamedTuple):
    """A table, the frames of the description it speaks of, what stands before and behind, and how well it fits."""

    table: str
    description: str
    base: str
    tip: str
    before: Array
    behind: Array
    position: float
    orientation: float


PAIRS = [
    *(
        Pair(f"{name}_dh", name, base, tip, before, behind, 8e-12, 1.6e-11)
        for name in ("ur3", "ur5", "ur10")
        for base, before in (("base_link", HALF_TURN), ("base", np.eye(4)))
        for tip, behind in (("tool0", np.eye(4)), ("ee_link", TO_EE_LINK))
    ),
    Pair("panda_dh", "panda", "panda_link0", "panda_link8", np.eye(4), np.eye(4), 1e-15, 1e-15),
    Pair("panda_dh", "panda", "panda_link0", "panda_hand_tcp", np.eye(4), TO_HAND_TCP, 1e-15, 1e-15),
    Pair("xarm7_dh", "xarm7", "link_base", "link_eef", np.eye(4), np.eye(4), 6e-6, 2.2e-5),
]


def difference(pair: Pair, table: Table | None = None) -> tuple[float, float]:
    """Largest distance [m] and angle [rad] between the two over 500 configurations."""
    chain = robot(pair.description).chain(pair.base, pair.tip)
    qs = samples(chain, 500)
    textbook = table or dh_columns.from_json(catalogue.dh_table(pair.table))
    expected = pair.before @ [textbook.pose(q) for q in qs] @ pair.behind
    ours = Poses(*chain_poses(chain.flat, qs))
    return pose_errors(ours.positions, ours.rotations, expected[:, :3, 3], expected[:, :3, :3])[:2]


@pytest.mark.quick(2)
@pytest.mark.parametrize("pair", PAIRS, ids=lambda pair: f"{pair.table}-{pair.base}-{pair.tip}")
def test_table_and_description_agree(pair: Pair) -> None:
    position, orientation = difference(pair)
    assert position < pair.position
    assert orientation < pair.orientation


PANDA_STANDARD = Table(
    standard=True,
    rows=[
        (0, -np.pi / 2, 0.333, 0),
        (0, np.pi / 2, 0, 0),
        (0.0825, np.pi / 2, 0.316, 0),
        (-0.0825, -np.pi / 2, 0, 0),
        (0, np.pi / 2, 0.384, 0),
        (0.088, np.pi / 2, 0, 0),
        (0, 0, 0.107, 0),
    ],
    slides=[False] * 7,
)


def pair_of(table: str) -> Pair:
    """The first pair of a table."""
    return next(pair for pair in PAIRS if pair.table == table)


def test_craigs_table_turned_into_a_standard_one() -> None:
    assert max(difference(pair_of("panda_dh"), PANDA_STANDARD)) < 1e-15


def test_craigs_numbers_read_as_standard_ones_are_another_robot() -> None:
    craig = dh_columns.from_json(catalogue.dh_table("panda_dh"))
    assert difference(pair_of("panda_dh"), replace(craig, standard=True))[0] > 1.0


def test_a_wrong_height_of_the_shoulder_shows() -> None:
    """A UR5 table in circulation has d₁ = 0.089459 m: 0.3 mm too high, everywhere."""
    ur5 = dh_columns.from_json(catalogue.dh_table("ur5_dh"))
    (a, alpha, _, theta), *others = ur5.rows
    wrong = replace(ur5, rows=[(a, alpha, 0.089459, theta), *others])
    assert difference(pair_of("ur5_dh"), wrong)[0] == pytest.approx(0.0003, abs=1e-11)
