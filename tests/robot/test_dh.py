"""Denavit-Hartenberg tables against the reference numbers of the course, and against a product of their own."""

from collections.abc import Sequence
from math import inf, nan, pi

import numpy as np
import pytest

from gelenk.errors import InvalidDhTable, WrongJointCount
from gelenk.robot.description import Mimic
from gelenk.robot.dh import MAX_JOINTS, Convention, DhJoint, DhTable
from tests.oracles import catalogue, dh_columns
from tests.robots import rows, swept, table

Row = tuple[float, float, float, float]
QUARTER = pi / 2

POSITIONS: dict[str, tuple[Convention, list[Row], str, list[float], list[float]]] = {
    "one standard row": ("standard", [(0.3, 0.5, 0.2, 0.7)], "R", [0], [0.229452656185, 0.193265306171, 0.2]),
    "one modified row": ("modified", [(0.3, 0.5, 0.2, 0.7)], "R", [0], [0.3, -0.095885107721, 0.175516512378]),
    "one sliding row": ("standard", [(0.3, 0.5, 0.05, 0.7)], "P", [0.15], [0.229452656185, 0.193265306171, 0.2]),
    "anthropomorphic arm": (
        "standard",
        [(0, QUARTER, 0, 0), (0.5, 0, 0, 0), (0.4, 0, 0, 0)],
        "RRR",
        [0.3, 0.6, -0.8],
        [0.768753959783, 0.237803466792, 0.202853504379],
    ),
    "spherical wrist": (
        "standard",
        [(0, -QUARTER, 0, 0), (0, QUARTER, 0, 0), (0, 0, 0.1, 0)],
        "RRR",
        [0.2, 0.9, -0.5],
        [0.076771252365, 0.015562303293, 0.062160996827],
    ),
    "planar 2R": (
        "standard",
        [(1, 0, 0, 0), (0.7, 0, 0, 0)],
        "RR",
        [0.3, 0.8],
        [np.cos(0.3) + 0.7 * np.cos(1.1), np.sin(0.3) + 0.7 * np.sin(1.1), 0],
    ),
    "SCARA": (
        "standard",
        [(0.325, 0, 0.387, 0), (0.275, pi, 0, 0), (0, 0, 0, 0), (0, 0, 0.05, 0)],
        "RRPR",
        [0.4, 0.8, 0.12, -0.3],
        [0.398993205532, 0.382871709891, 0.217],
    ),
    "Stanford arm": (
        "standard",
        [
            (0, -QUARTER, 0.412, 0),
            (0, QUARTER, 0.154, 0),
            (0.0203, 0, 0, -QUARTER),
            (0, -QUARTER, 0, 0),
            (0, QUARTER, 0, 0),
            (0, 0, 0.263, 0),
        ],
        "RRPRRR",
        [0.2, 0.5, 0.6, -0.3, 0.7, 0.1],
        [0.338967591045, 0.039977404438, 1.139083062081],
    ),
    "6R with a spherical wrist": (
        "standard",
        [
            (0, QUARTER, 0.3, 0),
            (0.5, 0, 0, 0),
            (0, QUARTER, 0, 0),
            (0, -QUARTER, 0.4, 0),
            (0, QUARTER, 0, 0),
            (0, 0, 0.1, 0),
        ],
        "RRRRRR",
        [0.3, 0.6, 0.7, 0.2, 0.9, -0.5],
        [0.843884090787, 0.244754073854, 0.532667280031],
    ),
}


@pytest.mark.parametrize(("convention", "parameters", "types", "q", "position"), POSITIONS.values(), ids=POSITIONS)
def test_reference_position(
    convention: Convention, parameters: list[Row], types: str, q: list[float], position: list[float]
) -> None:
    assert rows(convention, parameters, types).pose(q)[:3, 3] == pytest.approx(position, abs=1e-12)


def test_wrist_centre() -> None:
    convention, parameters, types, q, _ = POSITIONS["6R with a spherical wrist"]
    T = rows(convention, parameters, types).pose(q)
    assert T[:3, 3] - 0.1 * T[:3, 2] == pytest.approx([0.762445531919, 0.235852041375, 0.475321705248], abs=1e-12)


def test_tool_of_the_scara_points_down() -> None:
    convention, parameters, types, q, _ = POSITIONS["SCARA"]
    assert rows(convention, parameters, types).pose(q)[:3, 2] == pytest.approx([0, 0, -1], abs=1e-15)


def test_spherical_wrist_turns_by_zyz() -> None:
    convention, parameters, types, *_ = POSITIONS["spherical wrist"]
    wrist = rows(convention, parameters, types)
    again = wrist.pose([-2.941592653590, -0.9, 2.641592653590])
    assert np.abs(wrist.pose([0.2, 0.9, -0.5]) - again).max() < 1e-12
    assert np.abs(wrist.pose([0.2, 0, -0.5]) - wrist.pose([0.5, 0, -0.8])).max() < 1e-15


@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_frames_are_those_of_the_textbook(name: str) -> None:
    content = catalogue.dh_table(name)
    ours, textbook = table(content), dh_columns.from_json(content)
    for q in np.random.default_rng(0).uniform(-pi, pi, (20, len(ours.joints))):
        assert np.abs(np.array(ours.frames(q)) - textbook.frames(q)).max() < 1e-14
        assert np.abs(ours.pose(q) - textbook.pose(q)).max() < 1e-14


@pytest.mark.parametrize("q", [[], [0.1], [0.1] * 3])
def test_wrong_number_of_joint_positions(q: Sequence[float]) -> None:
    with pytest.raises(WrongJointCount) as caught:
        rows("standard", [(1, 0, 0, 0)] * 2, "RR").pose(q)
    assert (caught.value.given, caught.value.expected) == (len(q), ("joint_1", "joint_2"))


def joint(**changes: object) -> DhJoint:
    """A good joint with these fields changed."""
    fields = {"name": "elbow", "type": "revolute", "a": 0.3, "alpha": 0.0, "d": 0.1, "theta": 0.0, **changes}
    return DhJoint(**fields)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("changes", "parameter"),
    [
        *(({field: value}, field) for field in ("a", "alpha", "d", "theta") for value in (nan, inf, -inf, 1e300, 2e6)),
        *(({field: value}, field) for field in ("lower", "upper") for value in (nan, inf, -inf)),
        *(({field: value}, field) for field in ("velocity", "effort") for value in (nan, inf, -1.0)),
        ({"lower": 1.0, "upper": -1.0}, "lower"),
        ({"lower": 4.0}, "lower"),
        ({"type": "prismatic", "upper": -1.5}, "lower"),
        *(({"name": name}, "name") for name in ("", " ", "el\nbow", "el\0bow", "e" * 129, "shoulder")),
    ],
)
def test_refused_joint(changes: dict[str, object], parameter: str) -> None:
    with pytest.raises(InvalidDhTable) as caught:
        DhTable("standard", (joint(name="shoulder"), joint(**changes)))
    assert (caught.value.joint, caught.value.parameter) == (1, parameter)


@pytest.mark.parametrize("count", [0, MAX_JOINTS + 1])
def test_refused_number_of_joints(count: int) -> None:
    with pytest.raises(InvalidDhTable, match=f"has {count} joints"):
        rows("standard", [(1, 0, 0, 0)] * count, "R" * count)


@pytest.mark.parametrize("place", ["base", "tool"])
@pytest.mark.parametrize("x", [nan, inf, 2e6])
def test_refused_place(place: str, x: float) -> None:
    T = np.eye(4)
    T[0, 3] = x
    with pytest.raises(InvalidDhTable, match=place):
        DhTable("standard", (joint(),), **{place: T})


@pytest.mark.parametrize(
    ("changes", "limits"),
    [
        ({}, (-pi, pi)),
        ({"type": "prismatic"}, (-1.0, 1.0)),
        ({"lower": -0.5}, (-0.5, pi)),
        ({"lower": 0.0, "upper": 0.0}, (0.0, 0.0)),
    ],
)
def test_limits_left_out(changes: dict[str, object], limits: tuple[float, float]) -> None:
    assert joint(**changes).limits == limits


def following(*leaders: str | None) -> DhTable:
    """A table of joints j0, j1, …, each its own or following one; multiplier 2, offset 0.5."""
    return DhTable(
        "modified",
        tuple(
            joint(name=f"j{i}", mimic=None if leader is None else Mimic(leader, 2.0, 0.5))
            for i, leader in enumerate(leaders)
        ),
    )


@pytest.mark.parametrize(
    ("leaders", "variables"),
    [
        ((None, None), ("j0", "j1")),
        ((None, "j0", None), ("j0", "j2")),
        (("j1", None), ("j1",)),
        (("hand", None, "hand"), ("hand", "j1")),
        ((None, "hand", "arm", "hand", "j0"), ("j0", "hand", "arm")),
    ],
)
def test_variables_stand_where_they_are_first_needed(
    leaders: tuple[str | None, ...], variables: tuple[str, ...]
) -> None:
    assert following(*leaders).variables == variables


def test_a_row_that_follows_is_moved_by_its_leader() -> None:
    dh = following("hand", None, "j1")
    plain = following(None, None, None)
    q = [0.3, -0.2]
    moved = [2 * 0.3 + 0.5, -0.2, 2 * -0.2 + 0.5]
    assert dh.positions(q) == pytest.approx(moved, abs=1e-16)
    assert np.array_equal(dh.pose(q), plain.pose(moved))
    with pytest.raises(WrongJointCount) as caught:
        dh.pose(moved)
    assert (caught.value.given, caught.value.expected) == (3, ("hand", "j1"))


@pytest.mark.parametrize(
    ("mimic", "word"),
    [
        (Mimic("elbow"), "follows another joint itself"),
        (Mimic("follower"), "follows another joint itself"),
        (Mimic(""), "printable"),
        (Mimic("shoul\nder"), "printable"),
        *((Mimic("shoulder", multiplier=value), "multiplier") for value in (nan, inf, 2e6)),
        *((Mimic("shoulder", offset=value), "offset") for value in (nan, -inf, 2e6)),
    ],
)
def test_refused_leader(mimic: Mimic, word: str) -> None:
    others = joint(name="shoulder"), joint(name="follower", mimic=Mimic("shoulder"))
    with pytest.raises(InvalidDhTable, match=word) as caught:
        DhTable("standard", (*others, joint(mimic=mimic)))
    assert (caught.value.joint, caught.value.parameter) == (2, "mimic")
