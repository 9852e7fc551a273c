"""The course's pictures: they show what they should, the same each time, and no text gets in the way of another."""

import re
from collections.abc import Callable
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.image import imread

from gelenk.course.actuators.dc_motor import Motor
from gelenk.course.actuators.encoders import gray
from gelenk.course.actuators.pwm import Pulses, exact_ripple
from gelenk.course.mobility.mechanism import GivenPair, Mechanism, Node, mechanism, mechanism_of_tree
from gelenk.course.mobility.pairs import KINDS, PairGeometry
from gelenk.errors import UnknownPicture
from gelenk.language import Language, language
from gelenk.plots.course.encoders import disc_figure, tracks_figure
from gelenk.plots.course.gallery import coincident_figure, gallery_figure
from gelenk.plots.course.mechanism import mechanism_figure
from gelenk.plots.course.motor import motor_figure
from gelenk.plots.course.planar_arm import PlanarJoint, arm_points, elbows_figure, levers_figure, planar_arm_figure
from gelenk.plots.course.pulses import pulses_figure
from gelenk.plots.course.titles import TITLES
from gelenk.plots.figure import as_bytes
from tests.plots.labels import flaws, words
from tests.robots import robot

MOTOR = Motor(1.2, 2e-3, 0.05, 0.05, 1e-4, 2e-4)
ARM = [PlanarJoint("R", 0.6, 0.5), PlanarJoint("R", 0.9, 0.4), PlanarJoint("R", -0.7, 0.3)]
FOUR_BAR = (("frame", "crank"), ("crank", "coupler"), ("coupler", "rocker"), ("rocker", "frame"))
POINTS = ((0.0, 0.0), (0.2, 0.3), (0.85, 0.5), (0.8, 0.0))
STAR = tuple(map(str, range(12)))


def four_bar(*, stands: bool) -> Mechanism:
    pairs = [
        GivenPair(f"{i}", *ends, "revolute", None, PairGeometry((*point, 0.0)) if stands else None)
        for i, (ends, point) in enumerate(zip(FOUR_BAR, POINTS, strict=True))
    ]
    return mechanism("planar", ("frame", "crank", "coupler", "rocker"), 0, pairs)


def slider_crank() -> Mechanism:
    at = [PairGeometry((x, y, 0.0)) for x, y in ((0.0, 0.0), (0.2, 0.25), (0.9, 0.0))]
    slide = GivenPair("4", "slider", "frame", "prismatic", None, PairGeometry((0.9, 0.0, 0.0), (1.0, 0.0, 0.0)))
    ends = (("frame", "crank"), ("crank", "rod"), ("rod", "slider"))
    pairs = [GivenPair(f"{i}", *two, "revolute", None, at[i]) for i, two in enumerate(ends)]
    return mechanism("planar", ("frame", "crank", "rod", "slider"), 0, [*pairs, slide])


def wipers() -> Mechanism:
    """Three links that meet at a joint, whose pairs are added."""
    pairs = [GivenPair(f"{i}", "frame", f"arm {i}", "revolute") for i in range(3)]
    links = ("arm 0", "arm 1", "arm 2")
    return mechanism("planar", ("frame", *links), 0, pairs, [Node("B", links)])


def pulses(*, current: bool) -> Figure:
    given = Pulses(24.0, 0.35, 20e3)
    ripple = exact_ripple(given, 1.2, 2e-3, 0.0)
    return pulses_figure(given, (ripple.lowest, ripple.highest, 20.0, 0.0) if current else None, 2e-3 / 1.2)


PICTURES: dict[str, tuple[Callable[[], Figure], tuple[str, ...]]] = {
    **{name: (lambda name=name: gallery_figure(name), ()) for name in TITLES},  # type: ignore[misc]
    "motor": (lambda: motor_figure(MOTOR, 24.0, 0.1), ("458 rad/s", "1 N m, 20 A", "412.2 rad/s, 2.824 A", "1.2 Ω")),
    "motor driven back": (lambda: motor_figure(MOTOR, -24.0, 1.5), ("$V$ = −24 V",)),
    "pulses": (lambda: pulses(current=False), ("8.4 V", "14.2 V", "17.5 µs", "32.5 µs")),
    "pulses and ripple": (lambda: pulses(current=True), ("6.9319 A", "7.0684 A", "0.1365 A")),
    "samples": (lambda: tracks_figure([0, 2, 3, 1, 0, 2, 3, 2]), ("A", "B", "sample")),
    "many samples": (lambda: tracks_figure([0, 2, 3, 1] * 12, [False] * 48), ("Z",)),
    "disc": (lambda: disc_figure(4), tuple(f"{gray(value):04b}" for value in range(16))),
    "binary disc": (lambda: disc_figure(6, "binary", (5,)), ("000101", "64 positions of 5.625°")),
    "four-bar": (lambda: mechanism_figure(four_bar(stands=True)), ("1  frame (ground)", "n = 4", "j = 4")),
    "four-bar graph": (lambda: mechanism_figure(four_bar(stands=False)), ("R", "4  rocker")),
    "slider-crank": (lambda: mechanism_figure(slider_crank()), ("4  slider",)),
    "coincident": (lambda: mechanism_figure(wipers()), ("Joint B: k = 3 links meet, k − 1 = 2", "j = 5")),
    "tree": (lambda: mechanism_figure(mechanism_of_tree(robot("panda").description)), ("9  panda_link8", "fixed")),
    "arm": (lambda: planar_arm_figure(ARM), (r"$l_{2}$", r"$\vartheta_{3}$", "$P$")),
    "arm with values": (lambda: planar_arm_figure(ARM, values=True), ("= 0.4 m", "= −40.11°")),
    "arm that slides": (
        lambda: planar_arm_figure([PlanarJoint("R", 2.1, 0.3), PlanarJoint("P", 0.4)], values=True),
        (r"$d_{2}$ = 0.4 m", "= 120.3°"),
    ),
    "elbows": (lambda: elbows_figure((0.5, 0.4), (0.6, 0.35)), ("elbow up", "elbow down", r"$\alpha$", "$r$")),
    "star": (
        lambda: mechanism_figure(
            mechanism("spatial", STAR, 0, [GivenPair(x, STAR[0], x, "revolute") for x in STAR[1:]])
        ),
        ("12  11", "n = 12"),
    ),
    "long names": (lambda: mechanism_figure(mechanism("planar", [f"$x${i}" * 15 for i in range(6)], 0, [])), ("…",)),
    "parallel pairs": (
        lambda: mechanism_figure(mechanism("planar", "ab", 0, [GivenPair(x, "a", "b", "gear") for x in "123"])),
        ("gear",),
    ),
    "one place": (
        lambda: mechanism_figure(
            mechanism("planar", "ab", 0, [GivenPair("1", "a", "b", "cam", None, PairGeometry((0.0, 0.0, 0.0)))])
        ),
        ("cam",),
    ),
    "one sample": (lambda: tracks_figure([0]), ("B",)),
    "fine disc": (lambda: disc_figure(10, marked=(0, 1, 2, 1023)), ("1024 positions",)),
    "no voltage": (lambda: motor_figure(Motor(1.2, 0.0, 0.05, 0.05, 0.0, 2e-4), 0.0, 0.0), ("no load: 0 rad/s",)),
    "no pulses": (lambda: pulses_figure(Pulses(24.0, 0.0, 1e12)), ("0 V",)),
    "no force": (lambda: levers_figure(np.zeros((3, 2)), (0.0, 0.0), (0.0, 0.0), (False, True)), ("0 N",)),
    "no arm": (lambda: planar_arm_figure([PlanarJoint("R", 0.0), PlanarJoint("P", 0.0)]), ("$P$",)),
    "levers": (
        lambda: levers_figure(arm_points(ARM)[0], (0.0, -10.0), (1.0, 2.0, 3.0), (False,) * 3),
        ("$F$ = 10 N", r"$\tau_{3}$ = 3 N m", r"$h_{1}$"),
    ),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", PICTURES)
def test_labels_are_there_and_apart(name: str) -> None:
    draw, labels = PICTURES[name]
    figure = draw()
    assert not flaws(figure)
    shown = words(figure)
    assert not [label for label in labels if label not in shown]
    svg = as_bytes(figure, "svg")
    assert ElementTree.fromstring(svg).tag.endswith("svg")
    assert svg == as_bytes(draw(), "svg")


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", TITLES)
def test_labels_are_apart_in_german_too(name: str) -> None:
    with language("de"):
        figure = gallery_figure(name)
    assert not flaws(figure)
    assert words(figure) != words(gallery_figure(name))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", PICTURES)
def test_a_german_picture_has_decimal_commas(name: str) -> None:
    draw, _ = PICTURES[name]
    with language("de"):
        assert not re.search(r"\d\.\d", words(draw()))


@pytest.mark.slow
def test_pixels() -> None:
    assert imread(BytesIO(as_bytes(gallery_figure("joint-pairs"), "png"))).std() > 0.01


def test_the_chart_has_every_kind_with_its_numbers() -> None:
    shown = words(gallery_figure("joint-pairs"))
    for kind in KINDS.values():
        for space, freedoms, c in (("plane", 3, kind.planar), ("space", 6, kind.spatial)):
            assert c is None or f"{space}: c = {c}, f = {freedoms - c}" in shown
    assert shown.count("space: c = 5, f = 1") == 3  # revolute, prismatic, screw


def test_another_name_is_refused_with_those_that_are_there() -> None:
    with pytest.raises(UnknownPicture, match="joint-pairs"):
        gallery_figure("joint-pair")


def test_coincident_joints_of_any_number() -> None:
    figure = coincident_figure((2, 5))
    assert "k = 5 links, k − 1 = 4" in words(figure)
    assert not flaws(figure)


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", range(40))
def test_arms_of_any_posture(seed: int) -> None:
    """No label covers another one or a line, whatever the arm."""
    random = np.random.default_rng(seed)
    kinds = ["RR", "RRR", "RP"][seed % 3]
    joints = [
        PlanarJoint("R", random.uniform(-2.5, 2.5), random.uniform(0.2, 0.6)) if kind == "R"
        else PlanarJoint("P", random.uniform(0.2, 0.5))
        for kind in kinds
    ]  # fmt: skip
    points, angles = arm_points(joints)
    ways = np.exp(1j * np.cumsum([joint.value if joint.kind == "R" else 0.0 for joint in joints]))
    tip = sum(way * (joint.length or joint.value) for way, joint in zip(ways, joints, strict=True))
    np.testing.assert_allclose(points[-1], [tip.real, tip.imag])
    assert len(angles) == len(joints)
    assert not flaws(planar_arm_figure(joints, values=seed % 2 == 0))


def test_the_two_elbows_have_the_lengths_of_the_links() -> None:
    figure = elbows_figure((0.5, 0.4), (0.6, 0.35))
    arms = [np.column_stack([np.asarray(v) for v in line.get_data()]) for line in figure.axes[0].lines
            if line.get_linewidth() == 4.0]  # fmt: skip
    assert len(arms) == 2
    for arm in arms:
        np.testing.assert_allclose(np.hypot(*np.diff(arm, axis=0).T), [0.5, 0.4])
        np.testing.assert_allclose(arm[-1], [0.6, 0.35])
    with pytest.raises(ValueError, match="within reach"):
        elbows_figure((0.5, 0.4), (1.0, 0.0))


def test_a_lever_times_the_force_is_the_torque() -> None:
    points = arm_points(ARM)[0]
    force = np.array([6.0, -8.0])
    shown = words(levers_figure(points, force.tolist(), (0.0, 0.0, 0.0), (False,) * 3))
    for i, joint in enumerate(points[:-1]):
        r = points[-1] - joint
        assert rf"$h_{{{i + 1}}}$ = {abs(r[0] * force[1] - r[1] * force[0]) / 10.0:.4g} m" in shown


def test_the_current_closes_over_a_period() -> None:
    """The drawn exponentials begin and end at the two extremes, without a jump."""
    line = pulses(current=True).axes[1].lines[0]
    times, currents = (np.asarray(v) for v in line.get_data())
    assert np.all(np.diff(times) >= 0.0)
    assert np.abs(np.diff(currents)[np.diff(times) == 0.0]).max() < 1e-9
    np.testing.assert_allclose([currents.min(), currents.max()], [6.931853537, 7.068351208], rtol=1e-9)


@pytest.mark.parametrize("code", ["gray", "binary"])
def test_neighbours_on_a_gray_disc_differ_in_one_track(code: str) -> None:
    figure = disc_figure(4, code)  # type: ignore[arg-type]
    dark = np.zeros((16, 4), dtype=bool)
    for sector in figure.axes[0].patches:
        track = round((sector.r - 0.3) / sector.width) - 1  # type: ignore[attr-defined]
        ends = np.rint(np.array([sector.theta1, sector.theta2]) / 22.5).astype(int)  # type: ignore[attr-defined]
        dark[np.arange(*ends) % 16, track] = to_rgb(sector.get_facecolor())[0] < 0.5
    changes = (dark != np.roll(dark, -1, axis=0)).sum(axis=1)
    assert set(changes) == ({1} if code == "gray" else {1, 2, 3, 4})


def test_texts_follow_the_language() -> None:
    codes: tuple[Language, ...] = ("en", "de")
    found = []
    for code in codes:
        with language(code):
            found.append(words(motor_figure(MOTOR, 24.0, 0.1)))
    assert "no load" in found[0]
    assert "Leerlauf" in found[1]


def test_a_hanging_arm_leaves_room_for_the_axes_of_its_base() -> None:
    figure = planar_arm_figure([PlanarJoint("R", -0.96, 0.6), PlanarJoint("R", -2.1, 0.6)])
    low, high = figure.axes[0].get_ylim()
    assert high > 0.85 * (high - low) / figure.get_figheight()  # where the arrow of y ends, above the base at 0
