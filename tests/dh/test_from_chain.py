"""Tables found from axes, against two ways that know nothing of them: the URDF's text, and the textbook's product."""

from collections.abc import Sequence
from functools import cache
from math import pi

import numpy as np
import pytest

from gelenk.dh.tables.convert import describe_dh
from gelenk.dh.tables.from_chain import dh_from_chain
from gelenk.errors import InvalidField
from gelenk.kinematics.judge.tables import certify_table, table_configurations
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, build_chain
from gelenk.robot.description import Description
from gelenk.robot.dh import Convention, DhTable
from gelenk.robot.notations import pose_errors
from gelenk.robot.robot import RobotModel
from gelenk.robot.urdf import read_urdf
from tests.oracles import catalogue, dh_columns
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, robot, samples, swept

CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")
QUARTER = pi / 2
Z = (0, 0, 1)
Joint = tuple[str, Sequence[float], Sequence[float], Sequence[float]]
"""Type, xyz and rpy of the origin, axis."""

both_conventions = pytest.mark.parametrize("convention", CONVENTIONS)


def serial(joints: Sequence[Joint], extra: str = "") -> str:
    """The URDF of links link_0 … link_n in a row."""
    text = [f'<link name="link_{i}"/>' for i in range(len(joints) + 1)]
    for i, (type_, xyz, rpy, axis) in enumerate(joints, start=1):
        place, angles, line = (" ".join(repr(float(x)) for x in values) for values in (xyz, rpy, axis))
        mimic = ""
        if ":" in type_:
            type_, leader = type_.split(":")  # noqa: PLW2901
            mimic = f'<mimic joint="{leader}" multiplier="-1.5" offset="0.2"/>'
        limit = "" if type_ == "continuous" else '<limit lower="-1" upper="1" velocity="2" effort="3"/>'
        text.append(
            f'<joint name="joint_{i}" type="{type_}"><parent link="link_{i - 1}"/><child link="link_{i}"/>'
            f'<origin xyz="{place}" rpy="{angles}"/><axis xyz="{line}"/>{limit}{mimic}</joint>'
        )
    return f'<robot name="serial">{"".join(text)}{extra}</robot>'


def textbook_poses(table: DhTable, qs: Array) -> Array:
    """T_base_tool by elementary transforms; followers moved by a rule of their own."""
    own = [row.name for row in table.joints if row.mimic is None]
    outside = [row.mimic.joint for row in table.joints if row.mimic is not None and row.mimic.joint not in own]
    assert set(table.variables) == {*own, *outside}
    product = dh_columns.Table(
        table.convention == "standard",
        [(row.a, row.alpha, row.d, row.theta) for row in table.joints],
        [row.type == "prismatic" for row in table.joints],
        table.base,
        table.tool,
    )
    poses = []
    for q in qs:
        value = dict(zip(table.variables, q, strict=True))
        poses.append(
            product.pose(
                [
                    value[row.mimic.joint] * row.mimic.multiplier + row.mimic.offset if row.mimic else value[row.name]
                    for row in table.joints
                ]
            )
        )
    return np.array(poses)


def distance(ours: Array, judge: Array) -> tuple[float, float]:
    parts = (np.ascontiguousarray(Ts[:, rows, columns]) for Ts in (ours, judge) for rows, columns in _PARTS)
    return pose_errors(*parts)[:2]


_PARTS = ((slice(3), 3), (slice(3), slice(3)))


@cache
def product_of(name: str) -> UrdfProduct:
    return UrdfProduct(catalogue.urdf_text(name))


def residual(text: str, chain: Chain, table: DhTable, qs: Array) -> tuple[float, float]:
    """Largest distance [m] and angle [rad] between a table and the text of a URDF."""
    judge = UrdfProduct(text).poses(chain.base_frame, chain.tip_frame, by_name(chain, qs))
    return distance(textbook_poses(table, qs), judge)


def found(
    text: str,
    convention: Convention = "standard",
    snap_tolerance: float = 0.0,
    ends: tuple[str, str] | None = None,
    within: float = 1e-13,
) -> tuple[DhTable, tuple[str, ...]]:
    """The table of a chain (all of it if no ends are named), compared with the text on the way."""
    description = read_urdf(text)
    chain = build_chain(description, *(ends or (description.root, description.leaves[0])))
    answer = dh_from_chain(description, chain, convention, snap_tolerance)
    assert answer.table.variables == chain.joint_names
    assert max(residual(text, chain, answer.table, samples(chain, 20))) < within
    return answer.table, answer.notes


def parameters(table: DhTable) -> Array:
    """(a, α, d, θ) of each row."""
    return np.array([(row.a, row.alpha, row.d, row.theta) for row in table.joints])


# Every robot


@both_conventions
@pytest.mark.parametrize("name", swept(catalogue.URDFS))
def test_every_leaf_chain_of_the_catalogue(name: str, convention: Convention) -> None:
    description = robot(name).description
    for leaf in description.leaves:
        if any(joint.type in {"floating", "planar"} for joint in description.path_to_root(leaf)):
            continue
        chain = robot(name).chain(description.root, leaf)
        if not len(chain):
            continue
        table = dh_from_chain(description, chain, convention, parallel_below=1e-10).table
        assert table.variables == chain.joint_names
        qs = samples(chain, 4)
        judge = product_of(name).poses(description.root, leaf, by_name(chain, qs))
        assert max(distance(textbook_poses(table, qs), judge)) < 1e-11, leaf
        for row in table.joints[:-1]:
            assert abs(row.theta) <= QUARTER + 1e-9


@pytest.mark.quick(7)
@both_conventions
@pytest.mark.parametrize("name", swept(catalogue.NAMES))
def test_the_certificate_is_what_is_measured(name: str, convention: Convention) -> None:
    machine = robot(name)
    chain = machine.chain(None, None)
    table = dh_from_chain(machine.description, chain, convention, parallel_below=1e-10).table
    certificate = certify_table(machine, chain, table)
    qs = table_configurations(chain, certificate.samples, certificate.seed)
    if name in catalogue.URDFS:
        judge = product_of(name).poses(chain.base_frame, chain.tip_frame, by_name(chain, qs))
    else:
        judge = np.array([dh_columns.from_json(catalogue.dh_table(name)).pose(q) for q in qs])
    measured = distance(textbook_poses(table, qs), judge)
    stated = certificate.max_position_error, certificate.max_orientation_error
    assert max(*measured, *stated) < 1e-11
    assert stated == pytest.approx(measured, abs=1e-14)


# Published tables


def test_ur_tables_as_published() -> None:
    """From the frame that the manufacturer means; descriptions write π/2 with eleven digits."""
    for name in ("ur3", "ur5", "ur10"):
        machine = robot(name)
        table = dh_from_chain(machine.description, machine.chain("base", "tool0"), "standard", 1e-9).table
        published = [
            (row["a"], row["alpha"], row["d"], row["theta"]) for row in catalogue.dh_table(f"{name}_dh")["joints"]
        ]
        assert np.abs(parameters(table) - published).max() < 1e-15
        assert np.abs(table.base - np.eye(4)).max() == 0.0
        assert np.abs(table.tool - np.eye(4)).max() == 0.0


def test_ur_tables_from_the_other_base_up_to_the_freedoms() -> None:
    """From `base_link`, half a turn away, x points the other way: a and α change their signs, nothing else."""
    machine = robot("ur5")
    table = dh_from_chain(machine.description, machine.chain("base_link", "tool0"), "standard").table
    published = np.array([[row[key] for key in ("a", "alpha", "d")] for row in catalogue.dh_table("ur5_dh")["joints"]])
    assert np.abs(np.abs(parameters(table)[:, :2]) - np.abs(published[:, :2])).max() < 1e-11
    assert np.abs(parameters(table)[:, 2] - published[:, 2]).max() < 1e-11


def test_panda_table_as_published() -> None:
    machine = robot("panda")
    table = dh_from_chain(machine.description, machine.chain("panda_link0", "panda_link8"), "modified").table
    flange = 0.107
    published = np.array(
        [
            (0, 0, 0.333, 0),
            (0, -QUARTER, 0, 0),
            (0, QUARTER, 0.316, 0),
            (0.0825, QUARTER, 0, 0),
            (-0.0825, -QUARTER, 0.384, 0),
            (0, QUARTER, 0, 0),
            (0.088, QUARTER, flange, 0),
        ]
    )
    assert np.abs(parameters(table) - published).max() < 1e-15
    assert np.array_equal(table.base, np.eye(4))
    assert np.array_equal(table.tool, np.eye(4))
    assert table.joints[0].lower == -2.8973


def test_xarm_table_as_published_once_snapped() -> None:
    """Its description writes π/2 as 1.5708: the exact table shows that, the snapped one is the manufacturer's."""
    machine = robot("xarm7")
    chain = machine.chain("link_base", "link_eef")
    published = np.array(
        [(row["a"], row["alpha"], row["d"], row["theta"]) for row in catalogue.dh_table("xarm7_dh")["joints"]]
    )
    snapped = dh_from_chain(machine.description, chain, "modified", 1e-5).table
    assert np.abs(parameters(snapped) - published).max() < 1e-15
    exact = dh_from_chain(machine.description, chain, "modified").table
    assert 1e-7 < np.abs(parameters(exact) - published).max() < 1e-5
    certificate = certify_table(machine, chain, snapped, exact=False)
    assert 1e-7 < certificate.max_position_error < 1e-5
    assert 1e-6 < certificate.max_orientation_error < 3e-5


@pytest.mark.parametrize("name", ["puma560", "scara", "planar_2r", "planar_3r", "anthropomorphic"])
def test_textbook_arms_come_back(name: str) -> None:
    """Lengths and twists of the course's arms; SCARA's heights along four parallel axes are free but for their sum."""
    machine = robot(name)
    table = dh_from_chain(machine.description, machine.chain("base", "tool"), "standard").table
    given = np.array([[row[key] for key in ("a", "alpha", "d")] for row in catalogue.dh_table(name)["joints"]])
    ours = parameters(table)
    assert np.abs(np.abs(ours[:, :2]) - np.abs(given[:, :2])).max() < 1e-15
    if name != "scara":
        assert np.abs(ours[:, 2] - given[:, 2]).max() < 1e-15


# Geometry


def turn(x: float, y: float, z: float, axis: Sequence[float] = Z, rpy: Sequence[float] = (0, 0, 0)) -> Joint:
    return "revolute", (x, y, z), rpy, axis


def slide(x: float, y: float, z: float, axis: Sequence[float] = Z, rpy: Sequence[float] = (0, 0, 0)) -> Joint:
    return "prismatic", (x, y, z), rpy, axis


DOWN, ALONG_X, ALONG_Y = (0, 0, -1), (1, 0, 0), (0, 1, 0)
FIRST = turn(0, 0, 0.3)
KINDS: dict[str, tuple[list[Joint], list[tuple[float, float, float, float]] | None]] = {
    "one turning": ([turn(0.1, 0.2, 0.3, (1, 2, 3), (0.4, 0.5, 0.6))], None),
    "one sliding": ([slide(0.1, 0.2, 0.3, (1, 2, 3), (0.4, 0.5, 0.6))], None),
    "one upright": ([FIRST], [(0, 0, 0.3, 0)]),
    "parallel": ([FIRST, turn(0.5, 0, 0.2)], [(0.5, 0, 0, 0)]),
    "antiparallel": ([FIRST, turn(0.5, 0, 0.2, DOWN)], [(0.5, pi, 0, 0)]),
    "one line": ([turn(0, 0, 0.3, rpy=(0, 0, 0.5)), turn(0, 0, 0.2, rpy=(0, 0, 0.7))], [(0, 0, 0, 0)]),
    "one line, opposite": ([turn(0, 0, 0.3, rpy=(0, 0, 0.5)), turn(0, 0, 0.2, rpy=(pi, 0, 0.7))], [(0, pi, 0, 0)]),
    "intersecting": ([FIRST, turn(0, 0, 0.2, (0, -1, 0))], [(0, QUARTER, 0.5, 0)]),
    "skew": ([FIRST, turn(0.1, 5, 0.2, ALONG_Y)], [(0.1, -QUARTER, 0.5, 0)]),
    "a slide between": ([FIRST, slide(7, 8, 9, ALONG_Y), turn(1, 0, 0)], [(0, -QUARTER, 0, 0)]),
    "a slide on a turn's line": ([FIRST, slide(0.3, 0, 0), turn(0.2, 0, 0)], [(0.5, 0, 0, 0), (0, 0, 0, 0)]),
    "two slides on a turn's line": (
        [slide(0.1, 0.2, 0.3), slide(0.1, 0.2, 0.3, DOWN), turn(0.5, 0, 0)],
        [(0, pi, 0, 0), (0, pi, 0, 0)],
    ),
    "a gantry": ([slide(0.1, 0.2, 0.3, ALONG_X), slide(0.1, 0.2, 0.3, ALONG_Y), slide(0.1, 0.2, 0.3)], None),
    "slides askew": ([slide(0.1, 0.2, 0.3, ALONG_X), slide(0.1, 0.2, 0.3), slide(0, 0, 0, (0.6, 0, 0.8))], None),
}


@both_conventions
@pytest.mark.parametrize(("joints", "expected"), KINDS.values(), ids=KINDS)
def test_axes_of_every_kind(
    convention: Convention, joints: list[Joint], expected: list[tuple[float, float, float, float]] | None
) -> None:
    """`expected` are the first rows of the standard table, heights from the foot of the base's origin on."""
    table, notes = found(serial(joints), convention)
    assert notes
    if expected is not None and convention == "standard":
        assert np.abs(parameters(table)[: len(expected)] - expected).max() < 1e-15


@both_conventions
@pytest.mark.parametrize("tilt", [1e-3, 1e-5, 1e-6])
def test_nearly_parallel_axes_have_their_normal_far_away(convention: Convention, tilt: float) -> None:
    joints: list[Joint] = [
        ("revolute", (0, 0, 0), (0, 0, 0), Z),
        ("revolute", (0.5, 0, 0), (tilt, 0, 0), Z),
        ("revolute", (0, 0.3, 0), (1, 0, 0), Z),
        ("fixed", (0.1, 0.2, 0.3), (0.1, 0.2, 0.3), Z),
    ]
    table, _ = found(serial(joints), convention, within=1e-9)
    assert abs(table.joints[0].d) < 1e-9
    sideways: list[Joint] = [joints[0], ("revolute", (0, 0.5, 0), (tilt, 0, 0), Z), *joints[2:]]
    table, _ = found(serial(sideways), convention, within=1e-9)
    # The axis leans in the plane of both, so they meet at 0.5 / tan(tilt).
    assert abs(table.joints[0].d) == pytest.approx(0.5 / np.tan(tilt), rel=1e-9)


@both_conventions
def test_axes_too_nearly_parallel(convention: Convention) -> None:
    def arm(tilt: float) -> str:
        sideways: Joint = ("revolute", (0, 0.5, 0), (tilt, 0, 0), Z)
        return serial([("revolute", (0, 0, 0), (0, 0, 0), Z), sideways, ("revolute", (0, 0.3, 0), (1, 0, 0), Z)])

    for tilt in (1e-7, 1e-9, 1e-10):
        with pytest.raises(InvalidField, match="common normal") as caught:
            found(arm(tilt), convention)
        assert caught.value.field == "snap_tolerance"
        advice = float(caught.value.reason.split("tolerance of ")[1].split()[0])
        assert tilt <= advice <= 3 * tilt
        table, notes = found(arm(tilt), convention, advice, within=3 * tilt)
        assert table.joints[0].d == 0.0
        assert any(note.startswith("snapped") for note in notes)
    assert found(arm(1e-15), convention, within=2e-14)[0].joints[0].d == 0.0


def random_text(seed: int) -> str:
    """One to eight joints of all types with fixed ones between, half of all numbers special."""
    rng = np.random.default_rng(seed)
    special = (0.0, QUARTER, -QUARTER, pi, 1e-3, QUARTER + 1e-5, 3.1416, 1.5707963)

    def triple(angles: bool) -> list[float]:
        if angles:
            return [float(rng.choice([rng.choice(special), 0.0, rng.uniform(-pi, pi)])) for _ in range(3)]
        return [float(rng.choice([0.0, 0.0, rng.uniform(-1, 1)])) for _ in range(3)]

    def axis() -> list[float]:
        if rng.random() < 0.7:
            return [float(x) for x in np.eye(3)[rng.integers(3)] * rng.choice([-1.0, 1.0])]
        return [float(x) for x in rng.normal(size=3)]

    types = ["revolute", "revolute", "prismatic", "continuous", "fixed"]
    joints: list[Joint] = [("revolute", triple(False), triple(True), axis())]
    for i in range(1, int(rng.integers(1, 9))):
        followed = joints[i - 1][0] == "revolute" and rng.random() < 0.2
        type_ = f"revolute:joint_{i}" if followed else str(rng.choice(types))
        joints.append((type_, triple(False), triple(True), axis()))
    return serial(joints)


@pytest.mark.slow
@both_conventions
@pytest.mark.parametrize("seed", range(5))
def test_random_chains(seed: int, convention: Convention) -> None:
    """Sixty each: exact where it can be said, else refused with a tolerance that works. Also up the tree."""
    refused = 0
    for number in range(60):
        text = random_text(60 * seed + number)
        description = read_urdf(text)
        for ends in ((description.root, description.leaves[0]), (description.leaves[0], description.root)):
            try:
                found(text, convention, ends=ends, within=1e-9)
            except InvalidField as error:
                assert error.field == "snap_tolerance"
                refused += 1
                found(text, convention, 1e-6, ends=ends, within=1e-4)
    assert refused < 30


def test_a_chain_from_the_middle_up_and_down() -> None:
    text = serial(
        [
            ("revolute", (0, 0, 0.3), (0, 0, 0), Z),
            ("revolute", (0.2, 0, 0), (0.3, 0, 0), (0, 1, 0)),
            ("prismatic", (0, 0.1, 0), (0, 0, 1), (1, 0, 0)),
        ],
        extra='<link name="side"/><joint name="branch" type="continuous"><parent link="link_1"/><child link="side"/>'
        '<origin xyz="0.1 0.2 0.3" rpy="1 2 3"/><axis xyz="1 1 0"/></joint>',
    )
    for convention in CONVENTIONS:
        table, notes = found(text, convention, ends=("side", "link_3"))
        assert table.variables == ("branch", "joint_2", "joint_3")
        assert any("±π" in note and "'branch'" in note for note in notes)
        assert (table.joints[0].lower, table.joints[0].upper) == (None, None)
        row = table.joints[2]
        assert (row.lower, row.upper, row.velocity, row.effort) == (-1.0, 1.0, 2.0, 3.0)
        found(text, convention, ends=("link_3", "link_1"))
        found(text, convention, ends=("link_1", "link_2"))


@both_conventions
def test_joints_that_follow_others(convention: Convention) -> None:
    place = turn(0.1, 0.2, 0.3, ALONG_Y, (0.4, 0.5, 0.6))[1:]
    types = ("revolute", "revolute:joint_1", "prismatic", "revolute:joint_2")
    inside = serial([(type_, *place) for type_ in types])
    table, _ = found(inside, convention)
    assert table.variables == ("joint_1", "joint_3")
    follower = table.joints[3].mimic
    assert follower is not None
    assert (follower.joint, follower.multiplier) == ("joint_1", 2.25)
    assert follower.offset == pytest.approx(-0.1)
    table, notes = found(inside, convention, ends=("link_1", "link_4"))
    assert table.variables == ("joint_1", "joint_3")
    assert any("'joint_1'" in note and "not in the chain" in note for note in notes)
    # The leader's limits of ±1 reach its follower, and come back in the robot that the table makes.
    assert (table.joints[0].lower, table.joints[0].upper) == pytest.approx((-1.3, 1.7))
    again = RobotModel(describe_dh("again", table)).chain("base", "tool")
    assert again.joint_names == table.variables
    assert (again.lower[0], again.upper[0]) == pytest.approx((-1.0, 1.0))


@both_conventions
@pytest.mark.parametrize("ends", [("panda_link0", "panda_rightfinger"), ("panda_rightfinger", "panda_leftfinger")])
def test_fingers_of_the_panda(convention: Convention, ends: tuple[str, str]) -> None:
    """One finger follows the other, which is not on the way to it; across, both are."""
    machine = robot("panda")
    chain = machine.chain(*ends)
    table = dh_from_chain(machine.description, chain, convention).table
    assert table.variables == chain.joint_names
    assert certify_table(machine, chain, table).max_position_error < 1e-15
    again = RobotModel(describe_dh("again", table))
    chain_again = again.chain("base", "tool")
    assert chain_again.joint_names == chain.joint_names
    assert certify_table(again, chain_again, table).max_position_error < 1e-15
    assert again.default_chain == ("base", "tool")


def test_without_a_joint_there_is_no_table() -> None:
    description: Description = read_urdf(serial([("fixed", (0, 0, 1), (0, 0, 0), Z)]))
    with pytest.raises(InvalidField, match="no joint moves between 'link_0' and 'link_1'"):
        dh_from_chain(description, build_chain(description, "link_0", "link_1"), "standard")


def test_more_joints_than_a_table_has_rows() -> None:
    text = serial([("revolute", (0.1, 0, 0), (0.1, 0, 0), Z)] * 65)
    with pytest.raises(InvalidField, match="65 joints"):
        found(text)
    assert len(found(text, ends=("link_0", "link_64"), within=1e-12)[0].joints) == 64


@both_conventions
def test_a_chain_too_long_for_a_table(convention: Convention) -> None:
    far = (1e6, 1e6, 1e6)
    joints: list[Joint] = [turn(*far), turn(*far, ALONG_Y, (1, 2, 3)), slide(*far, ALONG_X), turn(*far)]
    with pytest.raises(InvalidField) as caught:
        found(serial(joints), convention)
    assert caught.value.field == "tip_frame"


@pytest.mark.parametrize("tolerance", [-1e-9, 0.2, np.nan, np.inf])
def test_a_tolerance_out_of_range(tolerance: float) -> None:
    with pytest.raises(InvalidField, match=r"from 0 to 0\.1"):
        found(serial([("revolute", (0, 0, 0), (0, 0, 0), Z)]), "standard", tolerance)


def test_limits_that_say_that_there_is_none() -> None:
    text = serial([("revolute", (0, 0, 0), (0, 0, 0), Z)]).replace('upper="1"', 'upper="1e16"')
    table, notes = found(text)
    assert table.joints[0].upper == 1e6
    assert any("cut" in note for note in notes)


# Snapping

RIGHT_ARM: list[Joint] = [
    ("revolute", (0, 0, 0.4), (0, 0, 0), Z),
    ("revolute", (0, 0, 0.1), (QUARTER, 0, 0), Z),
    ("revolute", (0.45, 0, 0), (0, 0, 0), Z),
    ("revolute", (0.05, 0.4, 0), (-QUARTER, 0, pi), Z),
    ("revolute", (0, 0, 0), (QUARTER, 0, 0), Z),
    ("prismatic", (0, 0.1, 0), (-QUARTER, 0, 0), Z),
    ("fixed", (0, 0, 0.08), (0, QUARTER, 0), Z),
]


@both_conventions
@pytest.mark.parametrize("digits", [3, 4, 6, 8, 10, 12])
def test_truncated_angles_give_the_table_of_the_right_ones(digits: int, convention: Convention) -> None:
    rounded: list[Joint] = [(kind, xyz, [round(x, digits) for x in rpy], axis) for kind, xyz, rpy, axis in RIGHT_ARM]
    tolerance = 10.0 ** (1 - digits)
    right, _ = found(serial(RIGHT_ARM), convention)
    snapped, notes = found(serial(rounded), convention, tolerance, within=5 * tolerance)
    assert np.abs(parameters(snapped) - parameters(right)).max() < 1e-15
    assert np.abs(snapped.base - right.base).max() < 1e-15
    assert np.abs(snapped.tool - right.tool).max() < 1e-15
    assert any("snapped" in note for note in notes)


def test_short_lengths_vanish() -> None:
    joints: list[Joint] = [
        ("revolute", (1e-7, -2e-7, 0.4), (0, 0, 0), Z),
        ("revolute", (1e-7, 0, 0.1), (QUARTER, 0, 0), Z),
        ("revolute", (0.45, 0, 2e-7), (0, 0, 0), Z),
        ("fixed", (0.3, 1e-7, 1e-7), (0, 0, 0), Z),
    ]
    table, _ = found(serial(joints), "standard", 1e-6, within=5e-6)
    assert np.abs(parameters(table) - [(0, QUARTER, 0.5, 0), (0.45, 0, 0, 0), (0.3, 0, 0, 0)]).max() < 1e-6
    assert table.joints[0].a == 0.0
    assert table.joints[1].d == table.joints[2].d == 0.0
    assert np.array_equal(table.base, np.eye(4))
    exact, _ = found(serial(joints), "standard")
    assert exact.joints[0].a == pytest.approx(1e-7, rel=1e-6)


# A table is a fixed point


@both_conventions
@pytest.mark.parametrize("name", ["panda", "ur5", "puma560", "stanford", "scara", "kinova", "tiago", "baxter"])
def test_a_table_of_a_table_is_the_same(name: str, convention: Convention) -> None:
    machine = robot(name)
    table = dh_from_chain(machine.description, machine.chain(None, None), convention, 1e-9).table
    again = describe_dh("again", table)
    second = dh_from_chain(again, build_chain(again, "base", "tool"), convention, 1e-9).table
    assert np.abs(parameters(second) - parameters(table)).max() < 1e-12
    assert np.abs(second.base - table.base).max() < 1e-12
    assert np.abs(second.tool - table.tool).max() < 1e-12
