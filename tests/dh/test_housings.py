"""Bodies of makers' arms that are tables: about their axes, thinner towards the wrist, apart where nothing joins."""

from dataclasses import replace
from itertools import combinations, pairwise

import coal
import numpy as np
import pinocchio as pin
import pytest

from gelenk.collision.robot_bodies import find_bodies
from gelenk.dh.tables.convert import converted, describe_dh
from gelenk.dh.tables.housings import can_be_housed, housed_bodies
from gelenk.robot.dh import DhTable
from gelenk.robot.urdf import write_urdf
from gelenk.store.records import BUILT_KINDS, load, read_record
from tests.oracles import catalogue, dh_columns
from tests.robot.test_appearance import check_inertias
from tests.robots import described, rows, table

BUILT = [name for name in catalogue.TABLES if catalogue.entry(name)["kind"] in BUILT_KINDS]
FOLDED = {"hc10", "jaco2", "jaco2_7dof", "piper", "xarm6"}
"""Arms that lie folded on themselves at zero: there axes are nearer to each other than any arm is thick."""


@pytest.mark.quick(6)
@pytest.mark.parametrize("name", BUILT)
def test_a_housing_lies_about_each_axis_and_they_taper(name: str) -> None:
    """A link's frame is its joint's, so that the axis is z through its origin."""
    description = described(name)
    check_inertias(description.links)
    links = {link.name: link for link in description.links}
    moving = [links[f"link_{i}"] for i, _ in enumerate(catalogue.dh_table(name)["joints"], start=1)]
    radii = []
    for link in moving:
        shape = link.shapes[0]
        axis = dh_columns.placement({"position": [0.0] * 3, "rpy": list(shape.origin.rpy)})[:3, 2]
        assert np.abs(axis[:2]).max() < 1e-9
        assert np.hypot(*shape.origin.xyz[:2]) < 1e-9
        radii.append(shape.size[0])
    assert all(after <= before for before, after in pairwise(radii))
    assert 0.4 * radii[1] < radii[-1] < 0.8 * radii[1]
    assert links["base"].shapes, "a pedestal"


def test_a_strong_arm_is_thicker_than_a_weak_one_of_its_length() -> None:
    given = table(catalogue.dh_table("ur10e"))
    thick, thin = (housed_bodies(given, payload)["link_2"][0].size[0] for payload in (60.0, 5.0))
    assert thick > 1.2 * thin
    long = replace(given, joints=tuple(replace(row, a=2 * row.a, d=2 * row.d) for row in given.joints))
    assert housed_bodies(long, 60.0)["link_2"][0].size[0] > thick


def contacts(name: str) -> set[tuple[str, str]]:
    """Links in contact at zero by coal, of the pairs that the service looks at."""
    description = described(name)
    found = find_bodies(description, lambda _: None, has_own=False)
    model = pin.buildModelFromXML(write_urdf(description))
    data = model.createData()
    pin.framesForwardKinematics(model, data, np.zeros(model.nq))
    placed: dict[str, list[tuple[coal.Cylinder, coal.Transform3s]]] = {}
    for body in found.bodies:
        T = data.oMf[model.getFrameId(body.link)] * pin.SE3(body.T_link_body)
        placed.setdefault(body.link, []).append(
            (coal.Cylinder(*body.size), coal.Transform3s(T.rotation, T.translation))
        )
    active = {(pair.a, pair.b) for pair in found.pairs if pair.active}
    return {
        (a, b)
        for a, b in combinations(placed, 2)
        if {(a, b), (b, a)} & active
        for one in placed[a]
        for other in placed[b]
        if coal.collide(*one, *other, coal.CollisionRequest(), coal.CollisionResult())
    }


@pytest.mark.quick(6)
@pytest.mark.parametrize("name", BUILT)
def test_nothing_touches_at_zero_but_what_is_joined(name: str) -> None:
    assert bool(contacts(name)) == (name in FOLDED)


def test_the_service_has_them_and_a_textbook_table_keeps_its_rods() -> None:
    for name in ("kr210_r2700_2", "panda_dh", "anthropomorphic", "scara"):
        record = read_record(catalogue.CATALOGUE / name, "catalogue")
        assert record
        loaded = load(record)
        given = table(catalogue.dh_table(name))
        payload = catalogue.entry(name).get("payload")
        bodies = housed_bodies(given, payload) if name in BUILT else None
        expected = describe_dh(name, given, bodies)
        assert write_urdf(loaded.robot.description) == write_urdf(expected)


def in_base(given: DhTable) -> list[tuple[float, ...]]:
    """Size and place of each solid at zero in frame `base`."""
    description = describe_dh("arm", given, housed_bodies(given, None))
    model = pin.buildModelFromXML(write_urdf(description))
    data = model.createData()
    pin.framesForwardKinematics(model, data, np.zeros(model.nq))
    return [
        (*shape.size, *data.oMf[model.getFrameId(link.name)].act(np.array(shape.origin.xyz)))
        for link in description.links
        for shape in link.shapes
    ]


def test_both_conventions_have_the_same() -> None:
    given = table(catalogue.dh_table("panda_dh"))
    np.testing.assert_allclose(in_base(given), in_base(converted(given, "standard")), atol=1e-12)


def test_what_cannot_be_housed_is_said() -> None:
    assert not can_be_housed(rows("standard", [(0.3, 0, 0, 0)] * 2, "RP"))
    assert not can_be_housed(rows("standard", [(0.3, 0, 0, 0)], "R"))
    assert not can_be_housed(rows("standard", [(0.0, 1, 0, 0)] * 3, "RRR"))
    assert can_be_housed(rows("modified", [(0.3, 0, 0, 0)] * 3, "RRR"))
