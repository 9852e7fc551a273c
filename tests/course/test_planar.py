"""Planar workspaces: the lecture's numbers, and every orientation tried one by one."""

from math import acos, atan2, cos, hypot, pi, sin

import numpy as np
import pytest

from gelenk.course.planar import (
    Interval,
    area,
    orientations,
    place,
    planar_workspace,
    posture,
    share,
    tried,
    workspace_steps,
)
from gelenk.errors import CertificationFailed
from gelenk.robot.arrays import Array, Flags

LECTURE = {
    (1.0, 0.7): ([(0.3, 1.7)], []),
    (1.0, 1.0): ([(0.0, 2.0)], [(0.0, 0.0)]),
    (1.0, 0.7, 0.2): ([(0.1, 1.9)], [(0.5, 1.5)]),
    (1.0, 0.2, 0.3): ([(0.5, 1.5)], []),
    (0.5, 0.5, 0.5): ([(0.0, 1.5)], [(0.0, 0.5)]),
    (1.0, 0.9, 0.5): ([(0.0, 2.4)], [(0.0, 0.4), (0.6, 1.4)]),
}


def random_links(seed: int) -> tuple[float, ...]:
    rng = np.random.default_rng(seed)
    return tuple(rng.uniform(0.05, 1.0, 3).tolist())


ARMS = [*LECTURE, *(random_links(seed) for seed in range(12)), (0.3, 0.3, 0.3), (1.0, 0.7, 0.0), (0.5, 0.5, 0.0)]


def reached(links: tuple[float, ...], radius: float, phis: Array) -> Flags:
    """Whether the tip at (radius, 0) can have these orientations: the law of cosines for the first two links."""
    wrists = np.hypot(radius - links[2] * np.cos(phis), links[2] * np.sin(phis))
    l1, l2 = links[:2]
    cosines = (wrists**2 - l1**2 - l2**2) / (2.0 * l1 * l2)
    found: Flags = np.abs(cosines) <= 1.0
    return found


@pytest.mark.parametrize(("links", "workspaces"), LECTURE.items(), ids=str)
def test_the_workspaces_of_the_lecture(
    links: tuple[float, ...], workspaces: tuple[list[Interval], list[Interval]]
) -> None:
    arm = planar_workspace(links)
    for found, expected in zip((arm.primary, arm.secondary), workspaces, strict=True):
        assert len(found) == len(expected)
        assert np.allclose(found, expected, rtol=0.0, atol=1e-12)


def test_the_exam_that_knows_the_ring_alone_misses_the_disc() -> None:
    """For l = (1, 0.9, 0.5): the ring l_1 - l_2 + l_3 … l_1 + l_2 - l_3, and a disc of 0.4 m around the base."""
    disc, ring = planar_workspace((1.0, 0.9, 0.5)).secondary
    assert ring == pytest.approx((1.0 - 0.9 + 0.5, 1.0 + 0.9 - 0.5))
    assert disc == pytest.approx((0.0, 0.4))
    assert reached((1.0, 0.9, 0.5), 0.39, np.linspace(-pi, pi, 3600)).all()
    assert not reached((1.0, 0.9, 0.5), 0.41, np.linspace(-pi, pi, 3600)).all()


@pytest.mark.quick(6)
@pytest.mark.parametrize("links", [links for links in ARMS if len(links) == 3], ids=str)
def test_3600_orientations_at_each_distance(links: tuple[float, ...]) -> None:
    arm = planar_workspace(links)
    phis = np.linspace(-pi, pi, 3600, endpoint=False)
    bounds = [bound for ring in (*arm.primary, *arm.secondary) for bound in ring]
    for radius in np.linspace(0.0, 1.1 * sum(links), 150).tolist():
        if min(abs(radius - bound) for bound in bounds) < 1e-4:
            continue
        found = reached(links, radius, phis)
        assert (place(arm.primary, radius, 0.0).location == "inside") == bool(found.any()), radius
        assert (place(arm.secondary, radius, 0.0).location == "inside") == bool(found.all()), radius
        assert share(orientations(arm, radius, 0.0)) == pytest.approx(found.mean(), abs=2e-3)


@pytest.mark.parametrize("links", ARMS, ids=str)
def test_the_primary_workspace_by_moving_the_joints(links: tuple[float, ...]) -> None:
    turned = np.exp(1j * np.linspace(0.0, 2.0 * pi, 721))
    tips = links[0] + links[1] * turned
    if len(links) == 3:
        tips = tips[:, None] + links[2] * turned
    ((inner, outer),) = planar_workspace(links).primary
    assert np.abs(tips).max() == pytest.approx(outer)
    assert np.abs(tips).min() == pytest.approx(inner, abs=0.01)
    assert np.abs(tips).min() >= inner - 1e-12


@pytest.mark.parametrize("links", [links for links in ARMS if len(links) == 3 and min(links) > 0.0], ids=str)
def test_orientations_are_those_and_no_others(links: tuple[float, ...]) -> None:
    arm, rng = planar_workspace(links), np.random.default_rng(3)
    phis = np.linspace(-pi, pi, 1801)
    for _ in range(20):
        radius, towards = rng.uniform(0.0, sum(links)), rng.uniform(-pi, pi)
        found = orientations(arm, radius * cos(towards), radius * sin(towards))
        expected = reached(links, radius, phis - towards)
        said = np.zeros(len(phis), dtype=bool)
        near = np.zeros(len(phis), dtype=bool)
        for lower, upper in found:
            assert -pi <= lower <= pi
            assert lower <= upper <= lower + 2.0 * pi
            for turn in (-2.0 * pi, 0.0, 2.0 * pi):
                said |= (phis + turn >= lower) & (phis + turn <= upper)
                near |= np.minimum(np.abs(phis + turn - lower), np.abs(phis + turn - upper)) < 1e-6
        assert np.array_equal(said | near, expected | near)


def test_a_two_link_arm_has_two_orientations_those_of_its_elbows() -> None:
    """For l = (1, 0.7), p = (0.9, 0.8): q1 + q2 of both solutions of the lecture."""
    found = orientations(planar_workspace((1.0, 0.7)), 0.9, 0.8)
    expected = sorted((0.106585970938 + 1.599371644064, 1.346698710425 - 1.599371644064))
    np.testing.assert_allclose(found, [(phi, phi) for phi in expected], atol=1e-11)
    assert share(found) == 0.0
    elbow = acos((0.9**2 + 0.8**2 + 0.7**2 - 1.0) / (2.0 * 0.7 * hypot(0.9, 0.8)))
    assert found[1][0] == pytest.approx(atan2(0.8, 0.9) + elbow)


@pytest.mark.parametrize(
    ("links", "point", "expected"),
    [
        ((1.0, 0.7), (1.7, 0.0), [(0.0, 0.0)]),
        ((1.0, 0.7), (0.3, 0.0), [(pi, pi)]),
        ((1.0, 0.7), (1.8, 0.0), []),
        ((1.0, 0.7), (0.0, 0.0), []),
        ((1.0, 1.0), (0.0, 0.0), [(-pi, pi)]),
        ((1.0, 0.7, 0.2), (0.0, 1.9), [(pi / 2, pi / 2)]),
        ((1.0, 0.7, 0.2), (0.0, 1.0), [(-pi, pi)]),
        ((0.5, 0.5, 0.5), (0.0, 0.0), [(-pi, pi)]),
        ((0.5, 0.5, 0.0), (0.7, 0.0), [(-pi, pi)]),
        ((1.0, 0.9, 0.5), (-0.5, 0.0), None),
    ],
)
def test_orientations_on_boundaries_and_at_the_base(
    links: tuple[float, ...], point: tuple[float, float], expected: list[Interval] | None
) -> None:
    found = orientations(planar_workspace(links), *point)
    if expected is None:
        ((lower, upper),) = found
        assert 0.9 < (upper - lower) / (2.0 * pi) < 1.0
        return
    assert len(found) == len(expected)
    assert np.allclose(found, expected, atol=1e-7)


@pytest.mark.parametrize("links", ARMS, ids=str)
def test_a_posture_has_the_links_the_tip_and_the_orientation(links: tuple[float, ...]) -> None:
    arm, rng = planar_workspace(links), np.random.default_rng(6)
    tried_points = 0
    while tried_points < 20:
        x, y = rng.uniform(-sum(links), sum(links), 2)
        for lower, upper in orientations(arm, x, y):
            phi = rng.uniform(lower, upper)
            points = posture(arm, x, y, phi)
            np.testing.assert_allclose(np.hypot(*np.diff(points, axis=0).T), links, atol=1e-7)
            np.testing.assert_allclose(points[[0, -1]], [[0.0, 0.0], [x, y]], atol=1e-15)
            np.testing.assert_allclose(points[-1] - points[-2], links[-1] * np.array([cos(phi), sin(phi)]), atol=1e-12)
            tried_points += 1


@pytest.mark.parametrize(
    ("links", "secondary"),
    [
        ((1.0, 0.7, 0.0), [(0.3, 1.7)]),
        ((0.5, 0.5, 0.0), [(0.0, 1.0)]),
        ((0.1, 0.2, 0.3), [(0.0, 0.0)]),
        ((0.5, 0.5, 1.0), [(0.0, 0.0)]),
        ((0.6, 0.2, 0.2), [(0.6, 0.6)]),
        ((0.1 + 0.2, 0.3), [(0.0, 0.0)]),
        ((0.8, 0.7, 0.5), [(0.0, 0.4), (0.6, 1.0)]),
        ((0.4, 0.3, 0.9), []),
        ((1.0, 0.0), [(1.0, 1.0)]),
        ((0.0, 0.0), [(0.0, 0.0)]),
    ],
    ids=str,
)
def test_secondary_workspaces_that_are_a_circle_a_point_or_lost_to_rounding(
    links: tuple[float, ...], secondary: list[Interval]
) -> None:
    found = planar_workspace(links).secondary
    assert len(found) == len(secondary)
    assert np.allclose(found, secondary, atol=1e-12)


def test_without_a_third_link_the_secondary_workspace_is_all_that_is_reached() -> None:
    arm = planar_workspace((1.0, 0.7, 0.0))
    assert np.allclose(arm.primary, arm.secondary)


@pytest.mark.parametrize("links", [*LECTURE], ids=str)
def test_areas_by_scattering_points(links: tuple[float, ...]) -> None:
    arm, reach = planar_workspace(links), sum(links)
    points = np.random.default_rng(4).uniform(-reach, reach, (20_000, 2))
    radii = np.hypot(*points.T)
    for rings in (arm.primary, arm.secondary):
        hit = np.any([(radii >= inner) & (radii <= outer) for inner, outer in rings], axis=0).mean() if rings else 0.0
        assert area(rings) == pytest.approx(4.0 * reach**2 * hit, abs=0.05 * reach**2)


def test_where_a_point_lies() -> None:
    rings = ((0.0, 0.4), (0.6, 1.4))
    for radius, location, boundary, distance in (
        (0.0, "inside", 0.4, 0.4),
        (0.4, "boundary", 0.4, 0.0),
        (0.55, "outside", 0.6, -0.05),
        (0.6 - 1e-10, "boundary", 0.6, -1e-10),
        (1.2, "inside", 1.4, 0.2),
        (2.0, "outside", 1.4, -0.6),
    ):
        found = place(rings, radius, 1e-9)
        assert found.location == location
        assert found.boundary == boundary
        assert found.distance == pytest.approx(distance)
    assert place((), 1.0, 1e-9) == place((), 0.0, 1e-9)
    assert place(((0.0, 0.0),), 0.0, 1e-9).location == "boundary"


@pytest.mark.parametrize("links", ARMS, ids=str)
def test_what_is_sent_has_been_tried(links: tuple[float, ...]) -> None:
    assert tried(planar_workspace(links)).radii > 40


@pytest.mark.parametrize("lost", ["primary", "secondary"])
def test_a_workspace_that_is_another_one_is_withheld(lost: str) -> None:
    arm = planar_workspace((1.0, 0.9, 0.5))
    wrong = type(arm)(arm.links, arm.wrist, arm.primary, arm.secondary[1:])
    if lost == "primary":
        wrong = type(arm)(arm.links, arm.wrist, ((0.2, 2.4),), arm.secondary)
    with pytest.raises(CertificationFailed, match=lost):
        tried(wrong)


def test_the_worked_solution_holds_the_numbers() -> None:
    text = str(workspace_steps(planar_workspace((1.0, 0.9, 0.5))))
    for number in ("2.4", "[0,\\\\ 0.4]", "[0.6,\\\\ 1.4]", "1.9"):
        assert number in text
    assert "varnothing" in str(workspace_steps(planar_workspace((1.0, 0.2, 0.3))))
