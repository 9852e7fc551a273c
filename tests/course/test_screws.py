"""Mobilities that the formula misses, from where the axes lie, against the closure of loops."""

from dataclasses import replace
from math import atan, cos, pi, sin, tan

import numpy as np
import pytest

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, Node, mechanism
from gelenk.course.mobility.mobility import tally, verdict, warnings
from gelenk.course.mobility.pairs import LETTERS, PairGeometry, Space
from gelenk.course.mobility.screws import MAX_LINKS, PostureMobility, posture
from gelenk.course.mobility.steps import steps
from gelenk.errors import InvalidField, TooLarge
from gelenk.robot.arrays import Array
from tests.oracles import closure

Placed = tuple[str, str, str, PairGeometry]
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
TOLERANCE = 1e-9


def at(point: object, axis: object = None, second: object = None, pitch: float | None = None) -> PairGeometry:
    return PairGeometry(vector(point), unit(axis), unit(second), pitch)


def vector(numbers: object) -> tuple[float, float, float] | None:
    if numbers is None:
        return None
    x, y, z = np.asarray(numbers, dtype=float).tolist()
    return x, y, z


def unit(numbers: object) -> tuple[float, float, float] | None:
    return None if numbers is None else vector(np.asarray(numbers) / np.linalg.norm(np.asarray(numbers)))


def linkage(space: Space, placed: list[Placed], nodes: tuple[Node, ...] = ()) -> Mechanism:
    names = list(dict.fromkeys(name for link_a, _, link_b, _ in placed for name in (link_a, link_b)))
    given = [
        GivenPair(
            f"pair_{i}", link_a, link_b, LETTERS.get(kind, kind), geometry=needed(LETTERS.get(kind, kind), geometry)
        )
        for i, (link_a, kind, link_b, geometry) in enumerate(placed, start=1)
    ]
    return mechanism(space, names, 0, given, nodes)


def needed(kind: str, geometry: PairGeometry) -> PairGeometry:
    """The geometry without axes that a kind of pair does not have."""
    axis = None if kind in {"spherical", "fixed"} else geometry.axis
    return replace(geometry, axis=axis, second_axis=geometry.second_axis if kind == "universal" else None)


def stands(found: Mechanism, output: str | None = None) -> PostureMobility:
    link = None if output is None else found.links.index(output)
    result = posture(found, link, TOLERANCE)
    assert result is not None
    assert result.residual < 1e-12
    return result


def freedoms(kind: str, geometry: PairGeometry) -> list[closure.Freedom]:
    """What a spatial pair leaves, as turns and slides."""
    point = None if geometry.point is None else np.array(geometry.point)
    axis = np.zeros(3) if geometry.axis is None else np.array(geometry.axis)
    ball: list[closure.Freedom] = [(direction, point) for direction in np.eye(3)]
    across: list[closure.Freedom] = [
        (np.cross(axis, direction), None) for direction in ((0.3, 0.5, 0.9), (0.8, -0.4, 0.1))
    ]
    turn, slide = (axis, point), (axis, None)
    match kind:
        case "revolute":
            return [turn]
        case "prismatic":
            return [slide]
        case "universal":
            return [turn, (np.array(geometry.second_axis), point)]
        case "cylindrical":
            return [turn, slide]
        case "planar":
            return [(axis, np.zeros(3)), *across]
        case "sphere_in_groove":
            return [*ball, slide]
        case "point_contact":
            return [*ball, *across]
        case "fixed":
            return []
    assert kind == "spherical"
    return ball


def by_closure(found: Mechanism) -> int:
    geometries = [geometry or PairGeometry() for geometry in found.geometries]
    left = [freedoms(pair.type, geometry) for pair, geometry in zip(found.pairs, geometries, strict=True)]
    return closure.mobility(len(found.links), found.ends, left)


def ring(kinds: str, geometries: list[PairGeometry]) -> list[Placed]:
    count = len(kinds)
    return [
        (f"link{i}", kind, f"link{(i + 1) % count}", one)
        for i, (kind, one) in enumerate(zip(kinds, geometries, strict=True))
    ]


def bennett() -> list[Placed]:
    """Bennett's linkage: opposite links alike, a / sin α = b / sin β, closed at θ1 = 1.1."""
    a, alpha, beta, theta1 = 1.0, 0.6, 1.2, 1.1
    b = a * sin(beta) / sin(alpha)
    theta2 = 2.0 * atan(sin(0.5 * (beta + alpha)) / sin(0.5 * (beta - alpha)) / tan(0.5 * theta1))
    T, geometries = np.eye(4), []
    for theta, length, twist in ((theta1, a, alpha), (theta2, b, beta), (-theta1, a, alpha), (-theta2, b, beta)):
        geometries.append(at(T[:3, 3], T[:3, 2]))
        T = T @ turned("z", theta) @ shifted(length) @ turned("x", twist)
    assert pytest.approx(np.eye(4), abs=1e-14) == T
    return ring("RRRR", geometries)


def turned(axis: str, angle: float) -> Array:
    T = np.eye(4)
    i, j = {"x": (1, 2), "z": (0, 1)}[axis]
    T[i, i] = T[j, j] = cos(angle)
    T[j, i], T[i, j] = sin(angle), -sin(angle)
    return T


def shifted(length: float) -> Array:
    T = np.eye(4)
    T[0, 3] = length
    return T


def sarrus() -> list[Placed]:
    """Two folding plates, hinged along x and along y."""
    one = [at((0, 1, 0), X), at((0, 1.7, 0.5), X), at((0, 1, 1), X)]
    other = [at((1, 0, 1), Y), at((1.8, 0, 0.4), Y), at((1, 0, 0), Y)]
    return ring("RRRRRR", [*one, *other])


def four_bar(points: list[tuple[float, float, float]]) -> list[Placed]:
    return ring("RRRR", [at(point, Z) for point in points])


GENERAL = [(0.0, 0.0, 0.0), (0.3, 0.9, 0.0), (1.7, 1.4, 0.0), (2.0, 0.0, 0.0)]
STRETCHED = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.5, 0.0, 0.0), (3.0, 0.0, 0.0)]


def rssr() -> list[Placed]:
    return [
        ("frame", "R", "crank", at((0, 0, 0), (0, 0.2, 1))), ("crank", "S", "rod", at((0.3, 0.4, 0.1))),
        ("rod", "S", "rocker", at((1.5, 0.9, 0.8))), ("rocker", "R", "frame", at((2, 0, 0.1), (0.3, 1, 0))),
    ]  # fmt: skip


def stewart(first: str, last: str) -> list[Placed]:
    placed: list[Placed] = []
    for i in range(6):
        foot, head = pi / 3 * i + 0.2 * (-1) ** i, pi / 3 * i - 0.15 * (-1) ** i
        low = np.array([cos(foot), sin(foot), 0.0])
        high = np.array([0.6 * cos(head) + 0.1, 0.6 * sin(head) - 0.05, 1.1 + 0.02 * i])
        along = high - low
        second = np.cross(along, (0.0, 0.0, 1.0))
        placed += [
            ("base", first, f"lower{i}", at(low, Z, second)),
            (f"lower{i}", "P", f"upper{i}", at(None, along)),
            (f"upper{i}", last, "platform", at(high)),
        ]
    return placed


def delta(halved: bool) -> list[Placed]:
    """Three arms that turn about tangents of the base; the two rods of each are equal and parallel."""
    placed: list[Placed] = []
    for i in range(3):
        angle = 2 * pi / 3 * i
        out, along = np.array([cos(angle), sin(angle), 0.0]), np.array([-sin(angle), cos(angle), 0.0])
        elbow = 0.3 * out + (0.2 + 0.03 * i) * np.array([cos(angle), sin(angle), -1.0])
        head = 0.1 * out + np.array([0.05, 0.03, -0.8])
        placed.append(("base", "R", f"arm{i}", at(0.3 * out, along)))
        for side in (0.06, -0.06):
            low, high, name = elbow + side * along, head + side * along, f"rod{i}{'lr'[side < 0]}"
            placed.append((f"arm{i}", "S", name, at(low)))
            if halved:
                placed.append((name, "R", f"{name}end", at(low, high - low)))
            placed.append((f"{name}end" if halved else name, "S", "platform", at(high)))
    return placed


LINKAGES: dict[str, tuple[list[Placed], int, int, str, int]] = {
    "four-bar in space": (four_bar(GENERAL), -2, 1, "link2", 1),
    "four-bar stretched to a line": (four_bar(STRETCHED), -2, 2, "link2", 2),
    "Bennett": (bennett(), -2, 1, "link2", 1),
    "Sarrus": (sarrus(), 0, 1, "link3", 1),
    "RSSR": (rssr(), 2, 2, "rocker", 1),
    "6-UPS": (stewart("U", "S"), 6, 6, "platform", 6),
    "6-SPS": (stewart("S", "S"), 12, 12, "platform", 6),
    "Delta, rods of one piece": (delta(halved=False), 9, 9, "platform", 3),
    "Delta, rods in two halves": (delta(halved=True), 15, 15, "platform", 3),
}
"""Of each: its pairs, M of the formula, M as it stands, a link and how it moves."""


@pytest.mark.parametrize("name", LINKAGES)
def test_a_linkage_as_it_stands(name: str) -> None:
    placed, formula, mobility, output, moves = LINKAGES[name]
    found = linkage("spatial", placed)
    result = stands(found, output)
    assert tally(found).mobility == formula
    assert (result.mobility, result.redundant, result.output) == (mobility, mobility - formula, moves)
    assert by_closure(found) == mobility


@pytest.mark.parametrize("name", LINKAGES)
def test_singular_values_are_told_apart_by_far(name: str) -> None:
    result = stands(linkage("spatial", LINKAGES[name][0]))
    assert result.smallest_counted is not None
    assert result.smallest_counted > 1e-3
    assert (result.largest_neglected or 0.0) < 1e-14


def test_a_bennett_that_is_not_quite_one_stands_still() -> None:
    placed = bennett()
    link_a, kind, link_b, one = placed[2]
    assert one.point is not None
    placed[2] = (link_a, kind, link_b, at(np.add(one.point, (0.0, 1e-3, 0.0)), one.axis))
    found = linkage("spatial", placed)
    assert (stands(found).mobility, by_closure(found)) == (0, 0)


# In the plane


def flat(
    kind: str, link_a: str, link_b: str, point: tuple[float, float], axis: tuple[float, float] | None = None
) -> Placed:
    return link_a, kind, link_b, at((*point, 0.0), None if axis is None else (*axis, 0.0))


SLIDER_CRANK = [
    flat("R", "frame", "crank", (0, 0)), flat("R", "crank", "rod", (0.3, 0.4)),
    flat("R", "rod", "slider", (1.5, 0)), flat("P", "slider", "frame", (1.5, 0), (1, 0)),
]  # fmt: skip
PARALLEL_CRANKS = [
    placed
    for i, x in enumerate((0.0, 1.0, 2.5))
    for placed in (
        flat("R", "frame", f"crank{i}", (x, 0)),
        flat("R", f"crank{i}", "coupler", (x + 0.3, 0.8 + 0.0)),
    )
]
UNEQUAL_CRANKS = [*PARALLEL_CRANKS[:-1], flat("R", "crank2", "coupler", (2.9, 0.8))]
CAM = [
    flat("R", "frame", "disc", (0, 0)), flat("cam", "disc", "follower", (0.1, 0.5), (0.2, 1)),
    flat("P", "follower", "frame", (0, 1), (0, 1)),
]  # fmt: skip
GEARS = [
    flat("R", "frame", "pinion", (0, 0)), flat("gear", "pinion", "wheel", (1, 0), (0.34, 0.94)),
    flat("R", "wheel", "frame", (3, 0)),
]  # fmt: skip
ROLLERS = [
    flat("R", "frame", "wheel1", (0, 0)), flat("rolling", "wheel1", "wheel2", (1, 0)),
    flat("R", "wheel2", "frame", (3, 0)),
]  # fmt: skip
SLOT = [
    flat("R", "frame", "crank", (0, 0)), flat("pin_in_slot", "crank", "rocker", (0.5, 0.3), (0.4, 1)),
    flat("R", "rocker", "frame", (0, -1)),
]  # fmt: skip


@pytest.mark.parametrize(
    ("placed", "formula", "mobility"),
    [
        (SLIDER_CRANK, 1, 1),
        (PARALLEL_CRANKS, 0, 1),
        (UNEQUAL_CRANKS, 0, 0),
        (CAM, 1, 1),
        (GEARS, 1, 1),
        (ROLLERS, 0, 1),
        (SLOT, 1, 1),
    ],
    ids=["slider-crank", "equal cranks", "unequal cranks", "cam", "gears", "wheels that roll", "slot"],
)
def test_a_planar_linkage_as_it_stands(placed: list[Placed], formula: int, mobility: int) -> None:
    """Three equal parallel cranks, and fixed wheels that roll on each other, move against the formula."""
    found = linkage("planar", placed)
    assert (tally(found).mobility, stands(found).mobility) == (formula, mobility)
    said = [sentence for sentence in warnings(tally(found), found, stands(found)) if "redundant" in sentence]
    assert bool(said) == (mobility > formula)


def test_rolling_wheels_turn_in_the_ratio_of_their_radii() -> None:
    """The contact is where both have the same velocity: ω1 r1 = -ω2 r2; with a third axis elsewhere nothing moves."""
    off = [*ROLLERS[:2], flat("R", "wheel2", "frame", (3, 0.5))]
    assert stands(linkage("planar", off)).mobility == 0


def test_an_added_pair_is_where_its_joint_is() -> None:
    placed = [flat("R", "a", "b", (0, 0)), flat("R", "b", "c", (1, 0)), flat("R", "c", "a", (0.4, 0.8))]
    node = Node("B", ("a", "b", "d"))
    found = mechanism(
        "planar", ["a", "b", "c", "d"], 0,
        [GivenPair(f"p{i}", a, b, LETTERS[kind], geometry=one) for i, (a, kind, b, one) in enumerate(placed)], [node],
    )  # fmt: skip
    assert stands(found).mobility == tally(found).mobility == 1


# Every kind of pair by itself, and in random loops


SPATIAL = {
    "revolute": at((1, 2, 3), (1, 1, 0)), "prismatic": at(None, (1, 1, 0)),
    "screw": at((1, 2, 3), (0, 1, 1), None, 0.1),
    "universal": at((1, 2, 3), X, Y), "cylindrical": at((1, 2, 3), (1, 0, 2)), "spherical": at((1, 2, 3)),
    "planar": at(None, (1, 2, 3)), "sphere_in_groove": at((1, 0, 0), (3, 1, 0)),
    "point_contact": at((1, 0, 0), (1, 1, 1)),
    "fixed": PairGeometry(),
}  # fmt: skip


@pytest.mark.parametrize("kind", SPATIAL)
def test_a_pair_leaves_as_many_freedoms_as_the_table_says(kind: str) -> None:
    loose = ("a", "revolute", "c", at((0, 0, 0), Z))
    found = linkage("spatial", [("a", kind, "b", SPATIAL[kind]), loose])
    assert stands(found, "b").mobility == tally(found).mobility
    assert stands(found, "b").output == tally(found).mobility - 1


@pytest.mark.parametrize("seed", range(30))
def test_random_loops_agree_with_their_closure(seed: int) -> None:
    rng = np.random.default_rng(seed)
    kinds = rng.choice([kind for kind in SPATIAL if kind != "screw"], int(rng.integers(3, 9))).tolist()
    placed = [
        (
            f"link{i}",
            kind,
            f"link{(i + 1) % len(kinds)}",
            at(rng.normal(size=3), rng.normal(size=3), rng.normal(size=3)),
        )
        for i, kind in enumerate(kinds)
    ]
    found = linkage("spatial", placed)
    assert stands(found).mobility == by_closure(found)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("shift", [0.0, 1e4])
def test_the_size_and_the_place_of_a_linkage_do_not_matter(scale: float, shift: float) -> None:
    placed = [
        (a, kind, b, at(None if one.point is None else scale * np.array(one.point) + shift, one.axis, one.second_axis))
        for a, kind, b, one in sarrus()
    ]
    result = posture(linkage("spatial", placed), None, 1e-7)
    assert result is not None
    assert result.mobility == 1


# What is told, and what is refused


def test_what_stands_is_what_counts() -> None:
    found = linkage("spatial", bennett())
    result = stands(found)
    assert verdict(result.mobility) == "mechanism"
    (sentence,) = warnings(tally(found), found, result)
    assert "as the linkage stands, 3 of its 20 constraints are redundant, and its mobility is 1, not -2" in sentence
    assert any(step.latex[0].endswith("= 6 \\, (4 - 1) - 17 = 1") for step in steps(tally(found), found, result))


def test_pairs_that_say_nothing_of_where_they_are_have_no_posture() -> None:
    assert posture(mechanism("planar", ["a", "b"], 0, [GivenPair("p", "a", "b", "revolute")]), None, TOLERANCE) is None


def test_a_pair_that_leaves_out_what_others_say_is_refused() -> None:
    placed = [("a", "R", "b", at((0, 0, 0), Z)), ("b", "R", "c", at((1, 0, 0)))]
    with pytest.raises(InvalidField, match="'pairs/1/axis': 'pair_2' needs point and axis"):
        posture(linkage("spatial", placed), None, TOLERANCE)


@pytest.mark.parametrize(
    ("space", "kind", "geometry"),
    [("spatial", "U", at((0, 0, 0), X, X)), ("planar", "P", at((0, 0, 0), Z)), ("planar", "cam", at((0, 0, 0), Z))],
)
def test_axes_that_are_not_what_they_should_be_are_refused(space: Space, kind: str, geometry: PairGeometry) -> None:
    with pytest.raises(InvalidField, match="freedoms are not independent"):
        posture(linkage(space, [("a", kind, "b", geometry)]), None, TOLERANCE)


@pytest.mark.parametrize(
    ("space", "kind", "geometry", "reason"),
    [
        ("planar", "revolute", at((0, 0, 0), X), "pairs/0/axis'.*the axis to turn about is z"),
        ("planar", "prismatic", at(None, (1, 0, 1)), "pairs/0/axis'.*no component along z"),
        ("planar", "cam", at((0, 0, 0), (1, 1, 0.1)), "pairs/0/axis'.*no component along z"),
        ("planar", "revolute", at((0, 0, 0), pitch=0.1), "pairs/0/pitch'.*only a screw"),
        ("spatial", "revolute", at((0, 0, 0), X, Y), "pairs/0/second_axis'.*only a universal"),
        ("spatial", "spherical", at((0, 0, 0), X), "pairs/0/axis'.*a spherical pair has no axis"),
        ("spatial", "revolute", at((0, 0, 0)), "pairs/0/axis'.*needs point and axis to say where it is$"),
        ("spatial", "screw", at(None, None, None, 0.1), "pairs/0/point'.*to say where it is$"),
    ],
)
def test_what_a_pair_does_not_have_or_leaves_out_is_refused(
    space: Space, kind: str, geometry: PairGeometry, reason: str
) -> None:
    found = mechanism(space, ["a", "b"], 0, [GivenPair("one", "a", "b", kind, geometry=geometry)])
    with pytest.raises(InvalidField, match=reason):
        posture(found, None, TOLERANCE)


def test_a_planar_linkage_lies_in_one_plane_at_any_height() -> None:
    """An axis along -z is as good as one along z."""
    raised = [(x, y, 0.7) for x, y, _ in GENERAL]
    down = ring("RRRR", [at(point, (0, 0, -1)) for point in raised])
    assert stands(linkage("planar", down)).mobility == 1
    with pytest.raises(InvalidField, match=r"pairs/2/point'.*the same z"):
        stands(linkage("planar", four_bar([*raised[:2], GENERAL[2], raised[3]])))


def test_no_tolerance_counts_rounding() -> None:
    for tolerance in (1e-300, 1e-16, 1e-10):
        result = posture(linkage("spatial", bennett()), None, tolerance)
        assert result is not None
        assert result.mobility == 1


def test_a_linkage_of_very_many_links_is_refused() -> None:
    placed = [flat("R", f"link{i}", f"link{i + 1}", (i, 0)) for i in range(MAX_LINKS)]
    with pytest.raises(TooLarge, match="65 is more than the 64"):
        posture(linkage("planar", placed), None, TOLERANCE)
