"""Mobilities as the lecture counts them, and what the count does not tell."""

import numpy as np
import pinocchio as pin
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from gelenk.course.mobility.mechanism import GivenPair, Mechanism, Node, mechanism, mechanism_of_tree
from gelenk.course.mobility.mobility import certify_mobility, tally, tally_of_counts, verdict, warnings
from gelenk.course.mobility.pairs import FREEDOMS, KINDS, LETTERS, Space, allowed_kinds
from gelenk.course.mobility.steps import steps
from gelenk.course.mobility.topology import topology
from gelenk.errors import InvalidField
from gelenk.robot.urdf import read_urdf, write_urdf
from tests.course import linkages
from tests.oracles.catalogue import NAMES
from tests.robots import robot

_SPACES: dict[str, Space] = {"planar": "planar", "spatial": "spatial"}


def built(space: str, text: str, nodes: tuple[Node, ...] = ()) -> Mechanism:
    names = linkages.links(text)
    given = [
        GivenPair(
            f"pair_{i}", pair["link_a"], pair["link_b"], LETTERS.get(pair["type"], pair["type"]), pair.get("joint")
        )
        for i, pair in enumerate(linkages.pairs(text), start=1)
    ]
    return mechanism(_SPACES[space], names, 0, given, nodes)


def lecture(name: str) -> Mechanism:
    space, text, *_ = linkages.MECHANISMS[name]
    return built(space, text)


@pytest.mark.parametrize(
    ("name", "n", "j", "constraints", "mobility"),
    [(name, *numbers) for name, (_, _, *numbers) in linkages.MECHANISMS.items()],
)
def test_mobility_of_the_lectures_mechanisms(name: str, n: int, j: int, constraints: int, mobility: int) -> None:
    found = lecture(name)
    counted = tally(found)
    assert (counted.links, counted.pairs, counted.constraints, counted.mobility) == (n, j, constraints, mobility)
    assert certify_mobility(found) == mobility


@pytest.mark.parametrize(("space", "kind", "c"), [
    ("planar", "revolute", 2), ("planar", "prismatic", 2), ("planar", "rolling", 2), ("planar", "pin_in_slot", 1),
    ("planar", "cam", 1), ("planar", "gear", 1), ("planar", "fixed", 3),
    ("spatial", "revolute", 5), ("spatial", "prismatic", 5), ("spatial", "screw", 5), ("spatial", "universal", 4),
    ("spatial", "cylindrical", 4), ("spatial", "spherical", 3), ("spatial", "planar", 3),
    ("spatial", "sphere_in_groove", 2), ("spatial", "point_contact", 1), ("spatial", "fixed", 6),
])  # fmt: skip
def test_a_pair_takes_what_the_table_says(space: Space, kind: str, c: int) -> None:
    assert KINDS[kind].constraints(space) == c
    found = mechanism(space, ["a", "b"], 0, [GivenPair("p", "a", "b", kind)])
    assert tally(found).mobility == FREEDOMS[space] - c


@pytest.mark.parametrize("kind", ["spherical", "universal", "cylindrical", "planar", "screw", "point_contact"])
def test_the_plane_has_no_such_pair(kind: str) -> None:
    with pytest.raises(InvalidField, match=f"'{kind}' pair in the plane .* allowed: revolute, prismatic, rolling"):
        mechanism("planar", ["a", "b"], 0, [GivenPair("p", "a", "b", kind)])


def test_orders_are_the_courses() -> None:
    """Low where surfaces touch, high where a line or a point does."""
    high = {name for name, kind in KINDS.items() if kind.order == "high"}
    assert high == {"rolling", "pin_in_slot", "cam", "gear", "sphere_in_groove", "point_contact"}
    assert set(allowed_kinds("planar")) | set(allowed_kinds("spatial")) == set(KINDS)


@pytest.mark.parametrize(
    ("name", "n", "j", "loops", "bridges", "chain"),
    [
        ("four-bar", 4, 4, 1, 0, "closed"),
        ("serial 6R", 7, 6, 0, 6, "open"),
        ("Stewart-Gough 6-UPS", 14, 18, 5, 0, "closed"),
    ],
)
def test_loops_of_the_lectures_chains(name: str, n: int, j: int, loops: int, bridges: int, chain: str) -> None:
    found = lecture(name)
    assert (len(found.links), len(found.pairs)) == (n, j)
    graph = found.topology
    assert (graph.loops, len(graph.bridges), graph.chain) == (loops, bridges, chain)


def test_a_four_bar_with_a_link_that_hangs_is_not_closed() -> None:
    found = built("planar", linkages.FOUR_BAR + ", coupler R pendant")
    assert (len(found.links), len(found.pairs), found.topology.loops) == (5, 5, 1)
    assert [found.pairs[i].name for i in found.topology.bridges] == ["pair_5"]
    assert found.topology.chain == "mixed"
    assert any("'pendant'" in sentence for sentence in warnings(tally(found), found))


def test_a_single_link_is_an_open_chain_without_freedom() -> None:
    found = mechanism("spatial", ["ground"], 0, [])
    assert (tally(found).mobility, found.topology.chain, found.topology.loops) == (0, "open", 0)
    assert warnings(tally(found), found) == []


def test_two_pairs_between_the_same_links_are_a_loop() -> None:
    found = built("planar", "a R b, b R a")
    assert (found.topology.loops, found.topology.chain, tally(found).mobility) == (1, "closed", -1)


def test_links_that_do_not_hang_together_are_named() -> None:
    found = mechanism("planar", ["frame", "crank", "lost", "found"], 0, [
        GivenPair("p", "frame", "crank", "revolute"), GivenPair("q", "lost", "found", "revolute"),
    ])  # fmt: skip
    assert found.topology.components == ((0, 1), (2, 3))
    assert tally(found).mobility == certify_mobility(found) == 5
    assert "'lost'" in warnings(tally(found), found)[0]


# Joints of more than two links


@pytest.mark.parametrize(("links", "pairs"), [(3, 2), (4, 3), (5, 4)])
def test_k_links_at_a_joint_are_k_less_one_pairs(links: int, pairs: int) -> None:
    names = [f"bar{i}" for i in range(links)]
    found = mechanism("planar", names, 0, [], [Node("B", tuple(names))])
    assert len(found.pairs) == pairs
    assert (found.splits[0].links, found.splits[0].pairs, found.splits[0].added) == (links, pairs, pairs)


SIX_BAR_FORGOTTEN = linkages.SIX_BAR.replace("rocker R rod@B, ", "").replace("rocker@B", "rocker")


def test_the_six_bar_with_a_forgotten_split_is_wrong() -> None:
    """The count n = 6, j = 6, Σc = 12 gives 3, which is no six-bar's; the link that hangs is what shows it."""
    found = built("planar", SIX_BAR_FORGOTTEN)
    counted = tally(found)
    assert (counted.links, counted.pairs, counted.constraints, counted.mobility) == (6, 6, 12, 3)
    assert found.topology.chain == "mixed"
    assert any("'rod'" in sentence and "`coincident`" in sentence for sentence in warnings(counted, found))


def test_the_forgotten_split_is_made_where_the_node_is_named() -> None:
    found = built("planar", SIX_BAR_FORGOTTEN, (Node("B", ("plate", "rocker", "rod")),))
    counted = tally(found)
    assert (counted.pairs, counted.constraints, counted.mobility, counted.mobility_without_split) == (7, 14, 1, 3)
    assert [(pair.type, pair.joint) for pair in found.pairs if pair.added] == [("revolute", "B")]
    assert "3 links meet at joint 'B'" in warnings(counted, found)[0]
    assert found.topology.chain == "closed"


def test_the_forgotten_split_by_counts_alone() -> None:
    counted = tally_of_counts("planar", 6, {"revolute": 6}, [("B", 3, None)])
    assert (counted.pairs, counted.constraints, counted.mobility, counted.mobility_without_split) == (7, 14, 1, 3)
    assert tally_of_counts("planar", 6, {"revolute": 6}, []).mobility == 3


def test_links_that_share_a_joint_by_name_only_are_joined() -> None:
    """Two pairs at one axle, of four links: three pairs, of which one is missing."""
    found = built("planar", "a R b@B, c R d@B")
    assert [(split.links, split.pairs, split.added) for split in found.splits] == [(4, 3, 1)]
    assert len(found.topology.components) == 1


def test_a_joint_with_a_pair_too_many_is_refused() -> None:
    with pytest.raises(InvalidField, match="3 links meet at joint 'B', which makes 2 pairs; the pair 'pair_3'"):
        built("planar", "a R b@B, b R c@B, c R a@B")


def test_a_pair_that_may_be_at_two_joints_is_refused() -> None:
    nodes = (Node("A", ("a", "b", "c")), Node("B", ("a", "b", "d")))
    with pytest.raises(InvalidField, match="could belong to any of 'A', 'B'"):
        built("planar", "a R b, b R c, c R d", nodes)


def test_a_joint_has_the_pairs_that_say_so_whatever_others_their_links_have() -> None:
    """Sheet 7: of the two rods at one joint of the bell crank, the second is driven by the first."""
    found = lecture("two windscreen wipers")
    assert [(split.joint, split.links, split.pairs, split.added) for split in found.splits] == [("B", 3, 2, 0)]


# Idle freedoms


@pytest.mark.parametrize(
    ("name", "idle", "left"),
    [
        ("Stewart 6-SPS", 6, 6),
        ("Stewart-Gough 6-UPS", 0, 6),
        ("RSSR", 1, 1),
        ("Delta, rods of one piece", 6, 3),
        ("serial 6R", 0, 6),
    ],
)
def test_idle_freedoms_are_found_and_taken_off(name: str, idle: int, left: int) -> None:
    found = lecture(name)
    assert len(found.idle_spins()) == idle
    assert tally(found).mobility - idle == left
    assert any("is idle" in sentence for sentence in warnings(tally(found), found)) == bool(idle)


def test_an_idle_freedom_names_what_spins_and_where() -> None:
    (spin,) = lecture("RSSR").idle_spins()
    assert (spin.links, spin.joints) == (["rod"], ["pair_2", "pair_3"])


def test_bars_of_a_spatial_truss_spin_about_their_nodes() -> None:
    """A tripod: three bars from the ground to one node, where k = 3 links are 2 pairs; rigid but for the spins."""
    found = built("spatial", "ground S bar1, ground S bar2, ground S bar3, bar1 S bar2@top, bar2 S bar3@top")
    assert (tally(found).mobility, len(found.idle_spins())) == (3, 3)
    assert verdict(tally(found).mobility - 3) == "structure"


def test_what_the_ground_is_part_of_does_not_spin() -> None:
    found = built("spatial", "rod S crank, crank R frame, frame R rocker, rocker S rod")
    assert (found.links[0], len(found.idle_spins())) == ("rod", 1)
    assert set(found.idle_spins()[0].links) == {"crank", "frame", "rocker"}


def test_a_roller_is_pointed_at() -> None:
    found = built("planar", "frame R disc, disc cam roller, roller R follower, follower P frame")
    assert tally(found).mobility == 2
    assert any("'roller' is a round roller" in sentence for sentence in warnings(tally(found), found))


# Where the formula fails


@pytest.mark.parametrize("name", ["four-bar counted in space", "Bennett 4R", "Sarrus"])
def test_a_linkage_that_moves_against_the_formula_is_warned_of(name: str) -> None:
    found = lecture(name)
    assert verdict(tally(found).mobility) in {"structure", "overconstrained"}
    assert any("ignores geometry" in sentence and "λ = 3" in sentence for sentence in warnings(tally(found), found))


def test_a_mechanism_that_moves_is_not_warned_of() -> None:
    assert warnings(tally(lecture("four-bar")), lecture("four-bar")) == []


@pytest.mark.parametrize(
    ("mobility", "word"), [(6, "mechanism"), (1, "mechanism"), (0, "structure"), (-1, "overconstrained")]
)
def test_verdict(mobility: int, word: str) -> None:
    assert verdict(mobility) == word


def test_counts_alone_say_that_they_know_nothing_of_idle_freedoms() -> None:
    counted = tally_of_counts("spatial", 14, {"spherical": 12, "prismatic": 6}, [])
    assert counted.mobility == 12
    assert "spins idly" in warnings(counted, None)[0]


# The board


def test_the_count_is_written_as_a_lecturer_does() -> None:
    found = lecture("four-bar")
    texts = [step.text for step in steps(tally(found), found)]
    assert "n = 4, j = 4, Σc = 8, M = λ(n − 1) − Σc = 3(4 − 1) − 8 = 1." in texts
    assert texts[-1] == "M = 1: it moves: a mechanism."


def test_every_formula_on_the_board_is_true() -> None:
    """Each chain of equal signs, evaluated."""
    for name in linkages.MECHANISMS:
        found = lecture(name)
        for step in steps(tally(found), found):
            for latex in step.latex:
                numeric = latex.replace(r"\cdot", "*").replace(r"\,", "*").split("=")[1:]
                values = {eval(part) for part in numeric if not set(part) & set("jncλ_\\")}  # noqa: S307
                assert len(values) == 1, latex


# Robots


@pytest.mark.quick(39)
@pytest.mark.parametrize("name", NAMES)
def test_mobility_of_a_robot_is_pinocchios(name: str) -> None:
    """Pinocchio's own reading of the same XML: a mimic joint is a joint of its own there, unless asked otherwise."""
    description = robot(name).description
    found = mechanism_of_tree(description)
    model = pin.buildModelFromXML(write_urdf(description))
    followers = sum(joint.mimic is not None for joint in description.joints)
    assert tally(found).mobility == certify_mobility(found) == model.nv - followers
    assert found.topology.loops == 0


def test_mimic_joints_are_a_constraint_each_to_pinocchio_too() -> None:
    description = read_urdf(
        '<robot name="gripper"><link name="palm"/><link name="left"/><link name="right"/>'
        '<joint name="a" type="prismatic"><parent link="palm"/><child link="left"/><axis xyz="1 0 0"/>'
        '<limit lower="0" upper="1" velocity="1" effort="1"/></joint>'
        '<joint name="b" type="prismatic"><parent link="palm"/><child link="right"/><axis xyz="1 0 0"/>'
        '<limit lower="0" upper="1" velocity="1" effort="1"/><mimic joint="a" multiplier="-1"/></joint></robot>'
    )
    counted = tally(mechanism_of_tree(description))
    assert (counted.constraints, counted.couplings, counted.mobility) == (10, 1, 1)
    assert pin.buildModelFromXML(write_urdf(description), mimic=True).nv == 1


def test_floating_and_planar_joints_are_counted() -> None:
    description = read_urdf(
        '<robot name="ship"><link name="sea"/><link name="hull"/><link name="crane"/>'
        '<joint name="waves" type="floating"><parent link="sea"/><child link="hull"/></joint>'
        '<joint name="deck" type="planar"><parent link="hull"/><child link="crane"/><axis xyz="0 0 1"/></joint></robot>'
    )
    found = mechanism_of_tree(description)
    assert tally(found).mobility == 9 == pin.buildModelFromXML(write_urdf(description)).nv
    assert "floating" in warnings(tally(found), found)[0]


# The graph, by removing one edge at a time


def components(count: int, edges: list[tuple[int, int]]) -> int:
    rows = np.array([edge[0] for edge in edges], dtype=int)
    columns = np.array([edge[1] for edge in edges], dtype=int)
    graph = coo_array((np.ones(len(edges)), (rows, columns)), shape=(count, count))
    return int(connected_components(graph, directed=False)[0])


@pytest.mark.parametrize("seed", range(60))
def test_topology_of_a_random_graph(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 14))
    drawn = rng.integers(0, count, (int(rng.integers(0, 2 * count)), 2)).tolist()
    edges = [(a, b) for a, b in drawn if a != b]
    found = topology(count, edges)
    parts = components(count, edges)
    assert len(found.components) == parts
    assert sorted(link for part in found.components for link in part) == list(range(count))
    assert found.loops == len(edges) - count + parts
    without = [components(count, edges[:i] + edges[i + 1 :]) for i in range(len(edges))]
    assert list(found.bridges) == [i for i, more in enumerate(without) if more > parts]


def test_a_long_ring_of_rings_is_quick() -> None:
    """No loop is walked twice: a ladder of 500 links has loops within loops."""
    edges = [(i, i + 1) for i in range(499)] + [(0, i) for i in range(2, 500)]
    found = topology(500, edges)
    assert (found.loops, found.bridges) == (498, ())
