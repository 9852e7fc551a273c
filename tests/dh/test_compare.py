"""Does a table describe a chain: published tables, every freedom of the convention, and what people get wrong."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from typing import Literal, NamedTuple

import numpy as np
import pytest

from gelenk.dh.compare import screws
from gelenk.dh.compare.alignment import Freedom
from gelenk.dh.compare.compare import Comparison, compare
from gelenk.errors import InvalidField
from gelenk.robot.arrays import Array
from gelenk.robot.description import Mimic
from gelenk.robot.dh import DhJoint, DhTable
from gelenk.robot.robot import RobotModel
from tests.oracles import catalogue, dh_columns
from tests.oracles.dh_columns import Table, shift, turn
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import of_table, robot, rows, samples, table

NOTHING = Freedom(base=False, tool=False, offsets=False, signs=False)
PLACES = Freedom(base=True, tool=True, offsets=False, signs=False)
ZEROS = Freedom(base=True, tool=True, offsets=True, signs=False)
SENSES = Freedom(base=True, tool=True, offsets=False, signs=True)
EVERYTHING = Freedom(base=True, tool=True, offsets=True, signs=True)

HALF_TURN = turn(2, np.pi)
TO_EE_LINK = turn(0, np.pi / 2) @ turn(2, np.pi / 2)
FLANGE = shift(2, 0.107)
TO_HAND_TCP = FLANGE @ turn(2, -np.pi / 4) @ shift(2, 0.1034)
PARAMETERS = ("a", "alpha", "d", "theta")

UR5 = ("ur5", "base_link", "tool0")
PANDA = ("panda", "panda_link0", "panda_link8")
STANFORD = ("stanford", "base", "tool")


class Published(NamedTuple):
    """A table, the chain that it speaks of, the base and tool that belong to it, and how well it fits."""

    table: str
    chain: tuple[str, str, str]
    base: Array
    tool: Array
    position: float
    orientation: float


PUBLISHED = [
    *(
        Published(f"{name}_dh", (name, base, tip), before, behind, position, 1.6e-11)
        for name, position in (("ur3", 3.5e-12), ("ur5", 5.3e-12), ("ur10", 7.3e-12))
        for base, before in (("base_link", HALF_TURN), ("base", np.eye(4)))
        for tip, behind in (("tool0", np.eye(4)), ("ee_link", TO_EE_LINK))
    ),
    Published("panda_craig", PANDA, np.eye(4), FLANGE, 1e-15, 2e-15),
    Published("panda_craig", (*PANDA[:2], "panda_hand_tcp"), np.eye(4), TO_HAND_TCP, 1e-15, 2e-15),
    Published("panda_standard", PANDA, np.eye(4), np.eye(4), 1e-15, 2e-15),
    Published("xarm7_dh", ("xarm7", "link_base", "link_eef"), np.eye(4), np.eye(4), 5.3e-6, 2.1e-5),
]
AGAIN = {"panda_dh", "ur3_dh", "ur5_dh", "ur10_dh", "xarm7_dh"} | catalogue.ARMS
OWN = [name for name in catalogue.TABLES if name not in AGAIN]

Q = np.pi / 2
PANDA_STANDARD = rows(
    "standard",
    [
        (0, -Q, 0.333, 0),
        (0, Q, 0, 0),
        (0.0825, Q, 0.316, 0),
        (-0.0825, -Q, 0, 0),
        (0, Q, 0.384, 0),
        (0.088, Q, 0, 0),
        (0, 0, 0.107, 0),
    ],
    "RRRRRRR",
)


def published(name: str) -> DhTable:
    """A table by its name, without base and tool; Panda's is the one without the flange."""
    if name == "panda_standard":
        return PANDA_STANDARD
    content = catalogue.dh_table("panda_dh" if name == "panda_craig" else name)
    bare = replace(table(content), base=np.eye(4))
    return replace(bare, tool=np.eye(4))


def verdict(dh: DhTable, chain: tuple[str, str, str], freedom: Freedom = PLACES) -> Comparison:
    arm = robot(chain[0])
    return compare(arm, arm.chain(*chain[1:]), dh, freedom)


def own_verdict(dh: DhTable, arm: RobotModel, freedom: Freedom = PLACES) -> Comparison:
    return compare(arm, arm.chain(None, None), dh, freedom)


def textbook(dh: DhTable) -> Table:
    """The same table as the oracle has it."""
    numbers = [(row.a, row.alpha, row.d, row.theta) for row in dh.joints]
    slides = [row.type == "prismatic" for row in dh.joints]
    return Table(dh.convention == "standard", numbers, slides, dh.base, dh.tool)


def poses_found(comparison: Comparison, qs: Array) -> Array:
    """What a verdict says that the chain's poses are, by the oracle's product; shape (N, 4, 4)."""
    placement = comparison.placement
    assert placement is not None
    oracle = textbook(placement.table)
    return np.array([oracle.pose(placement.signs * q + placement.offsets) for q in qs])


def changed(dh: DhTable, *changes: tuple[int, str, float]) -> DhTable:
    """A table with other numbers, by row (from 1) and parameter."""
    joints = list(dh.joints)
    for row, parameter, value in changes:
        joints[row - 1] = renumbered(joints[row - 1], {parameter: value})
    return replace(dh, joints=tuple(joints))


def renumbered(joint: DhJoint, numbers: dict[str, float]) -> DhJoint:
    fields = {name: numbers.get(name, getattr(joint, name)) for name in PARAMETERS}
    return replace(joint, a=fields["a"], alpha=fields["alpha"], d=fields["d"], theta=fields["theta"])


def each_row(dh: DhTable, change: Callable[[DhJoint], dict[str, float]]) -> DhTable:
    return replace(dh, joints=tuple(renumbered(joint, change(joint)) for joint in dh.joints))


# Published tables


@pytest.mark.quick(10)
@pytest.mark.parametrize("case", PUBLISHED, ids=lambda case: f"{case.table}-{case.chain[1]}-{case.chain[2]}")
@pytest.mark.parametrize(
    "freedom", [NOTHING, PLACES, SENSES, ZEROS, EVERYTHING], ids=["held", "places", "s", "o", "all"]
)
def test_a_published_table_describes_its_robot(case: Published, freedom: Freedom) -> None:
    dh = published(case.table)
    if freedom is NOTHING:
        dh = replace(dh, base=case.base, tool=case.tool)
    comparison = verdict(dh, case.chain, freedom)
    assert comparison.equivalent
    assert comparison.first_difference is None
    placement = comparison.placement
    assert placement is not None
    assert placement.position_error < case.position
    assert placement.orientation_error < case.orientation
    assert placement.table.base == pytest.approx(case.base, abs=1e-9)
    assert placement.table.tool == pytest.approx(case.tool, abs=1e-9 if case.table != "xarm7_dh" else 1e-4)
    assert placement.signs.tolist() == [1.0] * len(dh.joints)
    assert placement.offsets == pytest.approx(np.zeros(len(dh.joints)), abs=1e-4)


@pytest.mark.quick(4)
@pytest.mark.parametrize("case", PUBLISHED, ids=lambda case: f"{case.table}-{case.chain[1]}-{case.chain[2]}")
def test_the_errors_are_those_of_a_product_that_shares_no_code(case: Published) -> None:
    name, base, tip = case.chain
    comparison = verdict(published(case.table), case.chain)
    chain = robot(name).chain(base, tip)
    qs = samples(chain, 100, seed=9)
    configurations = dict(zip(chain.joint_names, qs.T, strict=True))
    expected = UrdfProduct(catalogue.urdf_text(name)).poses(base, tip, configurations)
    assert poses_found(comparison, qs) == pytest.approx(expected, abs=max(2e-11, 2 * case.orientation))


@pytest.mark.parametrize("name", OWN)
def test_a_table_of_the_catalogue_describes_its_own_robot(name: str) -> None:
    comparison = own_verdict(table(catalogue.dh_table(name)), robot(name), NOTHING)
    assert comparison.equivalent
    assert comparison.placement is not None
    assert max(comparison.placement.errors) < 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize(("first", "second"), [(a, b) for a, b in product(("ur3", "ur5", "ur10"), repeat=2) if a != b])
def test_arms_of_a_family_are_told_apart(first: str, second: str) -> None:
    comparison = verdict(published(f"{first}_dh"), (second, "base_link", "tool0"))
    assert not comparison.equivalent
    assert comparison.first_difference is not None
    difference = comparison.first_difference
    lengths = {"ur3": -0.24365, "ur5": -0.425, "ur10": -0.612}
    assert (difference.row, difference.parameter) == (2, "a")
    assert difference.value == lengths[first]
    assert difference.expected == pytest.approx(lengths[second], abs=1e-9)


# The height of the shoulder, which a free base absorbs


@pytest.mark.slow
def test_a_shoulder_too_high_shows_where_the_base_is_held() -> None:
    dh = replace(changed(published("ur5_dh"), (1, "d", 0.089459)), base=HALF_TURN)
    for freedom in (NOTHING, NOTHING._replace(tool=True), NOTHING._replace(tool=True, offsets=True)):
        comparison = verdict(dh, UR5, freedom)
        assert not comparison.equivalent
        assert comparison.placement is not None
        difference = comparison.first_difference
        assert difference is not None
        assert (difference.row, difference.parameter, difference.value) == (1, "d", 0.089459)
        assert difference.expected == pytest.approx(0.089159, abs=1e-9)
        assert difference.difference == pytest.approx(0.0003, abs=1e-9)
        if freedom is NOTHING:
            assert comparison.placement.position_error == pytest.approx(0.0003, abs=1e-9)


def test_a_free_base_says_that_it_absorbs_the_shoulder() -> None:
    right, wrong = (verdict(changed(published("ur5_dh"), (1, "d", d)), UR5) for d in (0.089159, 0.089459))
    assert right.equivalent
    assert wrong.equivalent
    assert wrong.placement is not None
    assert wrong.placement.table.base == pytest.approx(HALF_TURN @ shift(2, -0.0003), abs=1e-9)
    unverified = [(each.row, each.parameter, each.absorbed_by) for each in wrong.unverified]
    last = [(6, parameter, "tool") for parameter in PARAMETERS]
    assert unverified == [(1, "d", "base"), (1, "theta", "base"), *last]
    assert any("d = 0.089159 instead of 0.089459" in note for note in wrong.notes)
    assert not any("instead of" in note for note in right.notes)
    assert any("rows 2, 3, 4 are parallel" in note for note in right.notes)


def test_with_base_and_tool_held_everything_is_checked() -> None:
    comparison = verdict(replace(published("ur5_dh"), base=HALF_TURN), UR5, NOTHING)
    assert comparison.equivalent
    assert comparison.unverified == ()


# What people get wrong


def degrees(dh: DhTable) -> DhTable:
    return each_row(dh, lambda row: {"alpha": np.degrees(row.alpha), "theta": np.degrees(row.theta)})


def millimetres(dh: DhTable) -> DhTable:
    return each_row(dh, lambda row: {"a": 1000 * row.a, "d": 1000 * row.d})


MISTAKES: dict[str, tuple[DhTable, tuple[str, str, str], str, list[tuple[int, str]]]] = {
    "sign of alpha": (
        changed(published("ur5_dh"), (4, "alpha", -Q)), UR5, "sign", [(4, "alpha")],
    ),
    "sign of a": (changed(published("ur5_dh"), (2, "a", 0.425)), UR5, "sign", [(2, "a")]),
    "sign of d": (changed(published("ur5_dh"), (5, "d", -0.09465)), UR5, "sign", [(5, "d")]),
    "sign in Craig's": (changed(published("panda_craig"), (5, "a", 0.0825)), PANDA, "sign", [(5, "a")]),
    "a and d in a row": (
        changed(published("ur5_dh"), (2, "a", 0.0), (2, "d", -0.425)), UR5, "columns", [(2, "a"), (2, "d")],
    ),
    "a and d throughout": (
        each_row(published("ur5_dh"), lambda row: {"a": row.d, "d": row.a}), UR5, "columns",
        [(1, "a"), (1, "d"), *((i, x) for i in range(2, 7) for x in ("a", "d"))],
    ),
    "alpha and theta in a row": (
        changed(published("ur5_dh"), (5, "alpha", 0.0), (5, "theta", -Q)), UR5, "columns", [(5, "alpha"), (5, "theta")],
    ),
    "alpha and theta throughout": (
        each_row(published("ur5_dh"), lambda row: {"alpha": row.theta, "theta": row.alpha}), UR5, "columns",
        [(i, x) for i in (1, 4, 5) for x in ("alpha", "theta")],
    ),
    "Craig's read as standard": (replace(published("panda_craig"), convention="standard"), PANDA, "convention", []),
    "standard read as Craig's": (replace(published("ur5_dh"), convention="modified"), UR5, "convention", []),
    "degrees": (degrees(published("ur5_dh")), UR5, "degrees", [(1, "alpha"), (4, "alpha"), (5, "alpha")]),
    "degrees with a sliding joint": (
        degrees(published("stanford")), STANFORD, "degrees",
        [(1, "alpha"), (2, "alpha"), (3, "theta"), (4, "alpha"), (5, "alpha")],
    ),
    "degrees once": (changed(published("ur5_dh"), (4, "alpha", 90.0)), UR5, "degrees", [(4, "alpha")]),
    "millimetres": (
        millimetres(published("ur5_dh")), UR5, "millimetres",
        [(1, "d"), (2, "a"), (3, "a"), (4, "d"), (5, "d"), (6, "d")],
    ),
    "millimetres once": (changed(published("ur5_dh"), (5, "d", 94.65)), UR5, "millimetres", [(5, "d")]),
    "degrees and millimetres": (
        degrees(millimetres(published("panda_standard"))), PANDA, "degrees",
        [(i, x) for i, row in enumerate(PANDA_STANDARD.joints, 1) for x in PARAMETERS if getattr(row, x) != 0.0],
    ),
    "rows exchanged": (
        replace(published("ur5_dh"), joints=tuple(published("ur5_dh").joints[i] for i in (0, 1, 2, 4, 3, 5))),
        UR5, "rows", [(4, "alpha"), (4, "d"), (5, "alpha"), (5, "d")],
    ),
    "rows in reverse": (replace(published("stanford"), joints=published("stanford").joints[::-1]), STANFORD, "", []),
    "a zero elsewhere, twice": (
        changed(published("ur5_dh"), (2, "theta", -Q), (4, "theta", -Q)), UR5, "joint_zero",
        [(2, "theta"), (4, "theta")],
    ),
    "one number": (changed(published("panda_craig"), (5, "d", 0.348)), PANDA, "number", [(5, "d")]),
    "digits transposed": (changed(published("ur5_dh"), (3, "a", -0.32925)), UR5, "number", [(3, "a")]),
}  # fmt: skip


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", [name for name, case in MISTAKES.items() if case[2]])
def test_a_mistake_is_diagnosed(name: str) -> None:
    dh, chain, mistake, places = MISTAKES[name]
    comparison = verdict(dh, chain)
    assert not comparison.equivalent
    assert comparison.diagnoses[0].mistakes[0] == mistake
    found = [(each.row, each.parameter) for each in comparison.diagnoses[0].differences]
    if places:
        assert found == places
    assert comparison.first_difference == comparison.diagnoses[0].differences[0]


def test_all_rows_in_reverse_are_diagnosed() -> None:
    arm = of_table(random_table(np.random.default_rng(5), 5, "standard", generic=True))
    dh = random_table(np.random.default_rng(5), 5, "standard", generic=True)
    comparison = own_verdict(replace(dh, joints=dh.joints[::-1]), arm)
    types = [row.type for row in dh.joints]
    expected = "rows" if types == types[::-1] else None
    assert not comparison.equivalent
    assert expected is None or comparison.diagnoses[0].mistakes[0] == expected


def test_craigs_numbers_read_as_standard_differ_first_where_a_standard_table_would() -> None:
    comparison = verdict(replace(published("panda_craig"), convention="standard"), PANDA)
    differences = comparison.diagnoses[0].differences
    wrong = replace(published("panda_craig"), convention="standard")
    numbers = {(each.row, each.parameter): each.expected for each in differences}
    for i, (row, right) in enumerate(zip(wrong.joints, PANDA_STANDARD.joints, strict=True), start=1):
        for parameter in PARAMETERS:
            expected = numbers.get((i, parameter), getattr(row, parameter))
            # The flange is the tool's.
            if (i, parameter) != (7, "d"):
                assert expected == (getattr(right, parameter) if (i, parameter) != (7, "alpha") else 0.0)
    assert comparison.first_difference is not None
    assert (comparison.first_difference.row, comparison.first_difference.parameter) == (1, "alpha")


@pytest.mark.slow
def test_a_joint_that_turns_the_other_way() -> None:
    wrong = z_flipped(textbook(published("ur5_dh")), 2)[0]
    dh = rebuilt(published("ur5_dh"), wrong)
    held = verdict(dh, UR5)
    assert not held.equivalent
    assert "joint_sense" in [each.mistakes[0] for each in held.diagnoses]
    sense = next(each for each in held.diagnoses if each.mistakes == ("joint_sense",))
    assert [(each.row, each.parameter, each.expected) for each in sense.differences] == [(3, "sign", -1.0)]
    free = verdict(dh, UR5, SENSES)
    assert free.equivalent
    assert free.placement is not None
    assert free.placement.signs.tolist() == [1, 1, -1, 1, 1, 1]


def test_a_base_that_is_not_as_given() -> None:
    crooked = turn(0, 0.3) @ shift(1, 0.2)
    comparison = verdict(replace(published("ur5_dh"), base=crooked), UR5, NOTHING)
    assert not comparison.equivalent
    assert [each.mistakes[0] for each in comparison.diagnoses] == ["base"]
    assert comparison.diagnoses[0].placement.table.base == pytest.approx(HALF_TURN, abs=1e-9)
    assert comparison.first_difference is not None
    assert comparison.first_difference.parameter == "base"


def test_a_tool_that_is_not_as_given() -> None:
    crooked = turn(0, 0.3) @ turn(2, 0.4) @ shift(1, 0.2)
    comparison = verdict(replace(published("ur5_dh"), base=HALF_TURN, tool=crooked), UR5, NOTHING)
    assert not comparison.equivalent
    assert [each.mistakes[0] for each in comparison.diagnoses] == ["tool"]
    assert comparison.diagnoses[0].placement.table.tool == pytest.approx(np.eye(4), abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("freedom", [PLACES, Freedom(base=False, tool=True, offsets=False, signs=False), NOTHING])
def test_of_several_wrong_numbers_the_first_is_named(freedom: Freedom) -> None:
    dh = replace(changed(published("ur5_dh"), (2, "a", -0.42), (3, "a", -0.39), (5, "d", 0.1)), base=HALF_TURN)
    comparison = verdict(dh, UR5, freedom)
    difference = comparison.first_difference
    assert comparison.diagnoses == ()
    assert difference is not None
    assert (difference.row, difference.parameter, difference.value) == (2, "a", -0.42)
    assert difference.expected == pytest.approx(-0.425, abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_several_wrong_numbers_of_one_row(convention: Literal["standard", "modified"]) -> None:
    right = random_table(np.random.default_rng(2), 6, convention, generic=True, types="RRRRRR")
    wrong = changed(right, *((3, name, getattr(right.joints[2], name) + 0.2) for name in ("alpha", "d", "a")))
    comparison = own_verdict(wrong, of_table(right))
    assert comparison.first_difference is not None
    # Craig's a and α of a row stand before the row's joint, d and θ behind it.
    assert (comparison.first_difference.row, comparison.first_difference.parameter) == (3, "a")
    assert comparison.first_difference.expected == pytest.approx(right.joints[2].a, abs=1e-6)


def test_another_robot_altogether() -> None:
    comparison = verdict(random_table(np.random.default_rng(1), 6, "standard", generic=True, types="RRRRRR"), UR5)
    assert not comparison.equivalent
    assert comparison.diagnoses == ()
    assert comparison.first_difference is not None
    assert (comparison.first_difference.row, comparison.first_difference.parameter) == (1, "a")


# Rows that are not the joints


def test_a_row_too_many_and_too_few() -> None:
    six = verdict(published("ur5_dh"), PANDA)
    seven = verdict(published("panda_craig"), UR5)
    for comparison, row, value, expected in ((six, 7, 6, 7), (seven, 7, 7, 6)):
        difference = comparison.first_difference
        assert difference is not None
        assert not comparison.equivalent
        assert comparison.placement is None
        assert (difference.row, difference.parameter, difference.value, difference.expected) == (
            row, "joints", value, expected,
        )  # fmt: skip


def test_a_chain_without_joints() -> None:
    comparison = verdict(published("ur5_dh"), ("ur5", "base_link", "base"))
    assert not comparison.equivalent
    assert comparison.first_difference is not None
    assert comparison.first_difference.parameter == "joints"


def test_a_joint_of_another_type() -> None:
    dh = published("stanford")
    joints = tuple(replace(row, type="revolute") if i == 2 else row for i, row in enumerate(dh.joints))
    comparison = verdict(replace(dh, joints=joints), STANFORD)
    difference = comparison.first_difference
    assert difference is not None
    assert (difference.row, difference.parameter, difference.value, difference.expected) == (
        3, "type", "revolute", "prismatic",
    )  # fmt: skip


def coupled(multiplier: float = -0.5, offset: float = 0.3, leader: str = "joint_1") -> DhTable:
    """Three joints of which the third follows the first."""
    dh = rows("standard", [(0.3, 0.4, 0.1, 0.2), (0.4, -0.9, 0.0, 0.5), (0.2, 1.0, 0.1, 0.0)], "RRR")
    last = replace(dh.joints[2], mimic=Mimic(leader, multiplier, offset))
    return replace(dh, joints=(*dh.joints[:2], last))


def test_joints_that_follow_others() -> None:
    arm = of_table(coupled())
    comparison = own_verdict(coupled(), arm)
    assert comparison.equivalent
    assert comparison.placement is not None
    assert max(comparison.placement.errors) < 1e-12
    assert len(comparison.placement.signs) == 2


@pytest.mark.parametrize(
    ("wrong", "row", "parameter"),
    [
        (coupled(multiplier=-0.6), 3, "mimic"),
        (coupled(leader="joint_2"), 3, "mimic"),
        (rows("standard", [(0.3, 0.4, 0.1, 0.2), (0.4, -0.9, 0.0, 0.5), (0.2, 1.0, 0.1, 0.0)], "RRR"), 3, "mimic"),
        (changed(coupled(), (1, "alpha", 0.5)), 1, "alpha"),
    ],
)
def test_joints_that_follow_others_in_another_way(wrong: DhTable, row: int, parameter: str) -> None:
    comparison = own_verdict(wrong, of_table(coupled()))
    assert not comparison.equivalent
    assert comparison.first_difference is not None
    assert (comparison.first_difference.row, comparison.first_difference.parameter) == (row, parameter)


def test_a_follower_whose_sense_is_turned_with_its_axis() -> None:
    """A z axis the other way round and a multiplier of the other sign: the same motion."""
    flipped, _ = z_flipped(textbook(coupled(offset=0.0)), 2)
    dh = rebuilt(coupled(multiplier=0.5, offset=0.0), flipped)
    assert own_verdict(dh, of_table(coupled(offset=0.0))).equivalent


def test_zeros_of_joints_that_follow_others_are_not_found() -> None:
    with pytest.raises(InvalidField, match="mimic"):
        own_verdict(coupled(), of_table(coupled()), ZEROS)


def test_zeros_of_very_many_joints_are_not_found() -> None:
    snake = rows("standard", [(0.1, 1.0, 0.2, 0.0)] * 17, "R" * 17)
    with pytest.raises(InvalidField, match="16 rows"):
        own_verdict(snake, of_table(snake), ZEROS)
    assert own_verdict(snake, of_table(snake)).equivalent


# The freedom of the convention, by random tables


def random_table(
    rng: np.random.Generator,
    count: int,
    convention: Literal["standard", "modified"],
    generic: bool = False,
    types: str | None = None,
) -> DhTable:
    """A table with many parallel, crossing and perpendicular axes, or with none."""
    letters = types or "".join(rng.choice(["R", "P"], count, p=[0.8, 0.2]))
    numbers = rng.uniform([-0.6, -2.8, -0.6, -2.8], [0.6, 2.8, 0.6, 2.8], (count, 4))
    if not generic:
        special = rng.random((count, 4)) < 0.6
        plain = np.column_stack(
            (np.zeros(count), rng.choice([0.0, Q, -Q, np.pi], count), np.zeros(count), rng.choice([0.0, Q], count))
        )
        numbers = np.where(special, plain, numbers)
    return rows(convention, [(row[0], row[1], row[2], row[3]) for row in numbers.tolist()], letters)


def rebuilt(dh: DhTable, oracle: Table) -> DhTable:
    """A table with the numbers of another."""
    joints = (
        renumbered(joint, dict(zip(PARAMETERS, row, strict=True)))
        for joint, row in zip(dh.joints, oracle.rows, strict=True)
    )
    return replace(dh, joints=tuple(joints))


def x_flipped(oracle: Table, i: int) -> Table:
    """Half a turn about z is put in behind row i, and taken out of what follows."""
    numbers = [list(row) for row in oracle.rows]
    numbers[i][3] += np.pi
    if oracle.standard:
        numbers[i][0] *= -1
        numbers[i][1] *= -1
    elif i + 1 < len(numbers):
        numbers[i + 1][0] *= -1
        numbers[i + 1][1] *= -1
    if i + 1 < len(numbers):
        numbers[i + 1][3] += np.pi
    return replace(oracle, rows=[(row[0], row[1], row[2], row[3]) for row in numbers])


def z_flipped(oracle: Table, i: int) -> tuple[Table, int]:
    """Half a turn about x before the motion of joint i is taken out behind it: its sense is the other one."""
    numbers = [list(row) for row in oracle.rows]
    before, behind = (i - 1, i) if oracle.standard else (i, i + 1)
    numbers[i][2] *= -1
    numbers[i][3] *= -1
    for row in (before, behind):
        if 0 <= row < len(numbers):
            numbers[row][1] += np.pi
    return replace(oracle, rows=[(row[0], row[1], row[2], row[3]) for row in numbers]), i


def d_shifted(oracle: Table, i: int, length: float) -> Table:
    """The origin between two parallel axes slides along them."""
    numbers = [list(row) for row in oracle.rows]
    alpha = numbers[i if oracle.standard else i + 1][1]
    if abs(np.sin(alpha)) > 1e-12:
        return oracle
    numbers[i][2] += length
    numbers[i + 1][2] -= length * np.cos(alpha)
    return replace(oracle, rows=[(row[0], row[1], row[2], row[3]) for row in numbers])


def moved(rng: np.random.Generator, dh: DhTable, freedom: Freedom) -> tuple[DhTable, list[int]]:
    """Another table of the same chain, as far as what is free makes up for it, and the joints whose sense it turns."""
    oracle, flipped = textbook(dh), []
    n = len(dh.joints)
    for i in range(n - 1):
        if rng.random() < 0.5:
            oracle = x_flipped(oracle, i)
        if rng.random() < 0.5:
            oracle = d_shifted(oracle, i, rng.uniform(-0.5, 0.5))
    if freedom.signs:
        for i in range(n):
            if rng.random() < 0.4:
                oracle = z_flipped(oracle, i)[0]
                flipped.append(i)
    numbers = [list(row) for row in oracle.rows]
    if freedom.offsets:
        for row, slides in zip(numbers, oracle.slides, strict=True):
            row[2 if slides else 3] += rng.uniform(-0.5, 0.5)
    if freedom.base:
        numbers[0][2] += rng.uniform(-1, 1)
        numbers[0][3] += rng.uniform(-3, 3)
    if freedom.tool:
        numbers[-1][2 if oracle.standard else 3] += 0.4
    oracle = replace(oracle, rows=[(row[0], row[1], row[2], row[3]) for row in numbers])
    return rebuilt(dh, oracle), flipped


@pytest.mark.quick(6)
@pytest.mark.parametrize("freedom", [PLACES, ZEROS, SENSES, EVERYTHING], ids=["places", "zeros", "senses", "all"])
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("seed", [1134, *range(75)])
def test_tables_that_differ_by_the_convention_are_equivalent(
    seed: int, convention: Literal["standard", "modified"], freedom: Freedom
) -> None:
    rng = np.random.default_rng(seed)
    right = random_table(rng, int(rng.integers(1, 8)), convention)
    right = replace(right, base=shift(0, 0.4) @ turn(1, 0.7) @ turn(2, rng.uniform(-3, 3)), tool=turn(0, 0.3))
    other, _ = moved(rng, right, freedom)
    other = replace(other, base=np.eye(4), tool=np.eye(4))
    comparison = own_verdict(other, of_table(right), freedom)
    assert comparison.equivalent, comparison.first_difference
    qs = rng.uniform(-2, 2, (20, len(right.joints)))
    expected = np.array([textbook(right).pose(q) for q in qs])
    assert poses_found(comparison, qs) == pytest.approx(expected, abs=1e-8)


@pytest.mark.quick(3)
@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("freedom", [NOTHING, NOTHING._replace(tool=True), NOTHING._replace(base=True)])
def test_what_is_held_is_held(seed: int, freedom: Freedom) -> None:
    rng = np.random.default_rng(seed)
    right = random_table(rng, int(rng.integers(2, 7)), "standard", generic=True)
    base, tool = turn(1, 0.4) @ shift(0, 0.3), turn(0, 0.5) @ shift(2, 0.2)
    right = replace(right, base=base, tool=tool)
    given = replace(right, base=np.eye(4) if freedom.base else base, tool=np.eye(4) if freedom.tool else tool)
    comparison = own_verdict(given, of_table(right), freedom)
    assert comparison.equivalent
    assert comparison.placement is not None
    assert comparison.placement.table.base == pytest.approx(base, abs=1e-9)
    assert comparison.placement.table.tool == pytest.approx(tool, abs=1e-9)
    elsewhere = replace(given, tool=tool @ shift(0, 0.001)) if not freedom.tool else given
    if not freedom.tool and not freedom.base:
        assert not own_verdict(elsewhere, of_table(right), freedom).equivalent


# One wrong number


def with_one_wrong(rng: np.random.Generator, dh: DhTable) -> tuple[DhTable, tuple[int, str, float]]:
    row, parameter = int(rng.integers(1, len(dh.joints) + 1)), str(rng.choice(PARAMETERS))
    size = rng.uniform(0.05, 1.0) if parameter in {"alpha", "theta"} else rng.uniform(0.001, 0.2)
    value = getattr(dh.joints[row - 1], parameter)
    return changed(dh, (row, parameter, value + rng.choice([-1, 1]) * size)), (row, parameter, value)


def same_number(parameter: str, value: object, expected: float) -> bool:
    assert isinstance(value, float)
    apart = value - expected
    return abs(math.remainder(apart, 2 * math.pi) if parameter in {"alpha", "theta"} else apart) < 1e-6


@pytest.mark.quick(1)
@pytest.mark.parametrize("freedom", [PLACES, NOTHING, ZEROS, EVERYTHING], ids=["places", "nothing", "zeros", "all"])
@pytest.mark.parametrize("generic", [True, False], ids=["generic", "special"])
@pytest.mark.parametrize("seed", list(range(30)))
def test_one_wrong_number_is_named(seed: int, generic: bool, freedom: Freedom) -> None:
    """Exactly, where axes lie in general; else the chain may leave a choice, and it is among what is diagnosed."""
    rng = np.random.default_rng(2 * seed + generic)
    convention: Literal["standard", "modified"] = "standard" if seed % 2 else "modified"
    count = int(rng.integers(3, 7))
    right = random_table(rng, count, convention, generic, "R" * count if generic else None)
    wrong, (row, parameter, value) = with_one_wrong(rng, right)
    arm = of_table(right)
    comparison = own_verdict(wrong, arm, freedom)
    unverified = [(each.row, each.parameter) for each in own_verdict(right, arm, freedom).unverified]
    assert comparison.equivalent == ((row, parameter) in unverified)
    if comparison.equivalent:
        assert (row, parameter) in [(each.row, each.parameter) for each in comparison.unverified]
        return
    named = [each.differences[0] for each in comparison.diagnoses if len(each.differences) == 1]
    if generic and not freedom.signs:
        assert comparison.first_difference == named[0]
        assert (named[0].row, named[0].parameter) == (row, parameter)
    found = next(each for each in named if (each.row, each.parameter) == (row, parameter))
    assert same_number(parameter, found.expected, value)


# The parts


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_derivatives_are_those_of_differences(convention: Literal["standard", "modified"]) -> None:
    rng = np.random.default_rng(3)
    dh = random_table(rng, 4, convention, generic=True, types="RPRR")
    target = screws.chain_screws(of_table(dh).chain(None, None).flat)
    start = screws.parameters_of(dh) + rng.uniform(-0.3, 0.3, (4, 4))
    tables = screws.Tables(
        convention, target.slides, np.array([[1.0, 1.0, -1.0, 1.0]]), start[None], turn(1, 0.4)[None], shift(0, 0.2)
    )
    unknowns = np.arange(6 + 16)[None]
    J = screws.jacobians(convention, screws.geometry(tables), unknowns, with_tip=False)[0]
    for place in range(16):
        ends = []
        for step in (1e-6, -1e-6):
            other = start.copy()
            other.ravel()[place] += step
            found = screws.geometry(tables._replace(rows=other[None]))
            ends.append(screws.residuals(target, found, with_tip=False)[0])
        assert J[:, 6 + place] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-8)


def test_the_screws_of_a_chain_are_those_of_its_table() -> None:
    dh = random_table(np.random.default_rng(4), 5, "modified", types="RPRRP")
    target = screws.chain_screws(of_table(dh).chain(None, None).flat)
    ones = np.ones((1, 5))
    base = dh.base[None]
    tables = screws.Tables("modified", target.slides, ones, screws.parameters_of(dh)[None], base, dh.tool)
    found = screws.geometry(tables)
    assert found.twists[0] == pytest.approx(target.twists, abs=1e-12)
    assert found.tips[0] == pytest.approx(target.tip, abs=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize("numbers", [(1e6, 1e6, -1e6, 1e6), (0.0, 0.0, 0.0, 0.0), (1e-300, 1e-300, 1e6, 0.0)])
@pytest.mark.parametrize("freedom", [PLACES, NOTHING, EVERYTHING])
def test_absurd_numbers_get_an_answer(numbers: tuple[float, float, float, float], freedom: Freedom) -> None:
    comparison = verdict(rows("standard", [numbers] * 6, "RRRRRR"), UR5, freedom)
    assert not comparison.equivalent
    assert comparison.placement is not None
    assert np.isfinite(comparison.placement.errors).all()


def test_the_same_question_has_the_same_answer() -> None:
    ask: Sequence[Comparison] = [
        verdict(changed(published("ur5_dh"), (2, "a", 0.3)), UR5, EVERYTHING) for _ in range(2)
    ]
    assert ask[0].first_difference == ask[1].first_difference
    assert ask[0].placement is not None
    assert ask[1].placement is not None
    assert ask[0].placement.errors == ask[1].placement.errors
    assert np.array_equal(ask[0].placement.table.base, ask[1].placement.table.base)


def test_the_oracle_of_the_moves() -> None:
    """The moves of the tests leave the poses as they are, by the textbook's product."""
    rng = np.random.default_rng(8)
    for convention in ("standard", "modified"):
        right = textbook(random_table(rng, 5, convention, types="RRPRR"))
        q = rng.uniform(-1, 1, 5)
        for other in (x_flipped(right, 1), d_shifted(right, 2, 0.3)):
            assert other.pose(q) == pytest.approx(right.pose(q), abs=1e-12)
        flipped, i = z_flipped(right, 2)
        signs = np.where(np.arange(5) == i, -1.0, 1.0)
        assert flipped.pose(signs * q) == pytest.approx(right.pose(q), abs=1e-12)
    assert dh_columns.turn(2, np.pi) == pytest.approx(HALF_TURN)
