"""Bodies of a table's links: rods along its lengths wherever it moves, and inertias that bodies can have."""

from dataclasses import replace
from itertools import pairwise
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin
import pytest
import trimesh

from gelenk.dh.tables.convert import describe_dh
from gelenk.robot.appearance import MASS_PER_LENGTH
from gelenk.robot.arrays import Array
from gelenk.robot.description import Inertial, Link
from gelenk.robot.dh import Convention, DhJoint, DhTable
from gelenk.robot.urdf import write_urdf
from tests.dh.test_convert import random_table
from tests.oracles import catalogue, dh_columns
from tests.oracles.urdf_product import UrdfProduct
from tests.robots import by_name, of_table, reread, rows, samples, swept, table

CONVENTIONS: tuple[Convention, ...] = ("standard", "modified")
both_conventions = pytest.mark.parametrize("convention", CONVENTIONS)


def rods(text: str, q: dict[str, Array]) -> Array:
    """Both ends of every cylinder of a URDF in the base, at one configuration; shape (N, 2, 3)."""
    product, ends = UrdfProduct(text), []
    for link in ElementTree.fromstring(text.encode()).findall("link"):
        T = product.poses("base", link.attrib["name"], q)[0]
        for visual in link.findall("visual"):
            cylinder, origin = visual.find("geometry/cylinder"), visual.find("origin")
            if cylinder is None:
                continue
            place = {
                key: [0.0] * 3 if origin is None else [float(x) for x in origin.attrib[key].split()]
                for key in ("xyz", "rpy")
            }
            at = T @ dh_columns.placement({"position": place["xyz"], "rpy": place["rpy"]})
            half = 0.5 * float(cylinder.attrib["length"]) * at[:3, 2]
            ends.append((at[:3, 3] - half, at[:3, 3] + half))
    return np.array(ends)


def polyline(dh: DhTable, q: Array) -> list[Array]:
    """Origin of the base, then the ends of each row's d and a, then that of the tool."""
    points = [np.zeros(3), dh.base[:3, 3]]
    for row, (before, after) in zip(dh.joints, pairwise(dh.frames(q.tolist())), strict=True):
        if dh.convention == "standard":
            points.append(after[:3, 3] - row.a * after[:3, 0])
        else:
            points.append(before[:3, 3] + row.a * before[:3, 0])
        points.append(after[:3, 3])
    return [*points, dh.pose(q.tolist())[:3, 3]]


@pytest.mark.quick(1)
@both_conventions
@pytest.mark.parametrize("seed", range(12))
def test_rods_lie_along_d_and_a_wherever_the_robot_moves(convention: Convention, seed: int) -> None:
    given = random_table(convention, seed)
    dh = replace(given, joints=tuple(replace(row, type="revolute") for row in given.joints))
    text = write_urdf(describe_dh("arm", dh))
    chain = of_table(dh).chain("base", "tool")
    for q in samples(chain, 3, seed):
        drawn = rods(text, by_name(chain, q[None]))
        for start, end in pairwise(polyline(dh, q)):
            if np.linalg.norm(end - start) < 1e-9:
                continue
            forth = np.abs(drawn - [start, end]).max(axis=(1, 2))
            back = np.abs(drawn - [end, start]).max(axis=(1, 2))
            assert min(forth.min(), back.min()) < 1e-12


@both_conventions
@pytest.mark.parametrize("limits", [(-0.1, 0.3), (0.2, 0.6), (-0.6, -0.2)])
def test_a_rod_reaches_from_the_parent_to_the_carriage(convention: Convention, limits: tuple[float, float]) -> None:
    """At both ends of the way and between, wherever the way begins."""
    row = DhJoint("slide", "prismatic", 0.2, 0.3, 0.4, 0.5, *limits)
    dh = DhTable(convention, (row,))
    text = write_urdf(describe_dh("arm", dh))
    at_zero = dh.frames([0.0])[1] if convention == "modified" else dh_columns.shift(2, 0.4)
    for q in (limits[0], 0.5 * sum(limits), limits[1]):
        ends = rods(text, {"slide": np.array([q])})
        carriage = at_zero[:3, 3] + q * at_zero[:3, 2]
        assert any(lies_on(at_zero[:3, 3], *rod) and lies_on(carriage, *rod) for rod in ends)
    assert "<box" in text


def lies_on(point: Array, a: Array, b: Array) -> bool:
    """Whether a point is on the way between two others."""
    return bool(np.linalg.norm(point - a) + np.linalg.norm(b - point) <= np.linalg.norm(b - a) + 1e-12)


@pytest.mark.parametrize("name", swept(catalogue.TABLES))
def test_nothing_of_no_length_and_nothing_without_mass(name: str) -> None:
    description = reread(describe_dh(name, table(catalogue.dh_table(name))))
    assert not [warning for warning in description.warnings if "massless" in warning or "inertia" in warning]
    shapes = [shape for link in description.links for shape in link.shapes]
    assert shapes
    assert min(min(shape.size) for shape in shapes) > 1e-4
    assert {shape.kind for shape in shapes} <= {"cylinder", "box"}


EXTREMES = {
    "a point": rows("standard", [(0, 0, 0, 0)], "R"),
    "a slide without a way": DhTable("modified", (DhJoint("s", "prismatic", 0, 0, 0, 0, lower=0.0, upper=0.0),)),
    "a slide without an end": DhTable("modified", (DhJoint("s", "prismatic", 0, 0, 0, 0, lower=-1e6, upper=1e6),)),
    "a micrometre": rows("standard", [(1e-6, 1, 1e-6, 1)] * 3, "RPR"),
    "a thousand kilometres": rows("modified", [(1e6, 1, 1e6, 1)] * 3, "RPR"),
    "both": rows("standard", [(1e6, 1, 1e-6, 1), (1e-6, 1, 1e6, 1)], "RR"),
    "a far normal": rows("standard", [(0.5, 1e-6, 1e5, 0), (0.3, 0, -1e5, 0)], "RR"),
    "sixty-four": rows("modified", [(0.1, 1, 0.2, 1)] * 64, "R" * 64),
}


@pytest.mark.parametrize("dh", EXTREMES.values(), ids=EXTREMES)
def test_inertias_are_those_of_bodies(dh: DhTable) -> None:
    description = describe_dh("arm", dh)
    check_inertias(description.links)
    read = reread(description)
    assert [link.name for link in read.links if link.inertial] == [f"link_{i + 1}" for i in range(len(dh.joints))]
    assert not [warning for warning in read.warnings if "inertia" in warning or "mass" in warning]


def check_inertias(links: tuple[Link, ...]) -> None:
    for link in links:
        if link.inertial is None:
            continue
        moments = np.linalg.eigvalsh(tensor(link.inertial))
        assert link.inertial.mass > 0.0
        assert moments[0] > 0.0
        assert moments[2] <= (moments[0] + moments[1]) * (1 + 1e-12)


def tensor(inertial: Inertial) -> Array:
    ixx, ixy, ixz, iyy, iyz, izz = inertial.inertia
    return np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])


@pytest.mark.parametrize("name", ["puma560", "stanford", "panda_dh"])
def test_inertias_by_the_meshes_of_the_same_bodies(name: str) -> None:
    description = describe_dh(name, table(catalogue.dh_table(name)))
    inertials = {link.name: link.inertial for link in description.links if link.inertial}
    for link in description.links:
        if link.name not in inertials:
            continue
        inertial = inertials[link.name]
        bodies: list[Any] = [mesh(shape.kind, shape.size, shape.origin.xyz, shape.origin.rpy) for shape in link.shapes]
        for body, shape in zip(bodies, link.shapes, strict=True):
            body.density = MASS_PER_LENGTH * shape.size[-1] / body.volume
        mass = sum(body.mass for body in bodies)
        centre = sum(body.mass * body.center_mass for body in bodies) / mass
        moments = sum(
            body.moment_inertia_frame(dh_columns.placement({"position": centre.tolist(), "rpy": [0, 0, 0]}))
            for body in bodies
        )
        assert inertial.mass == pytest.approx(mass, rel=1e-3), link.name
        assert np.abs(np.array(inertial.origin.xyz) - centre).max() < 1e-3 * max(body.scale for body in bodies)
        assert np.abs(tensor(inertial) - moments).max() < 2e-3 * np.abs(moments).max()


def mesh(kind: str, size: tuple[float, ...], xyz: tuple[float, ...], rpy: tuple[float, ...]) -> Any:
    T = dh_columns.placement({"position": xyz, "rpy": rpy})
    if kind == "box":
        return trimesh.creation.box(size, T)
    return trimesh.creation.cylinder(size[0], size[1], sections=128, transform=T)


@pytest.mark.parametrize("length", [0.1, 0.4, 1.0, 1.5])
@both_conventions
def test_a_link_weighs_what_one_of_its_length_may(convention: Convention, length: float) -> None:
    """A link of a metre some kilograms, whatever else it is made of."""
    arm = describe_dh(
        "arm", rows(convention, [(length, 0, 0, 0), (0.7 * length, 0, 0, 0), (0, 0, 0.5 * length, 0)], "RRR")
    )
    for link in arm.links:
        assert link.inertial is None or 1.0 * length < link.inertial.mass < 5.0 * length


def test_a_simulator_can_move_it() -> None:
    """Pinocchio's mass matrix is positive definite, its weight that of an arm of this size."""
    description = describe_dh("arm", table(catalogue.dh_table("puma560")))
    model = pin.buildModelFromXML(write_urdf(description))
    data = model.createData()
    assert 5.0 < pin.computeTotalMass(model) < 100.0
    for q in np.random.default_rng(0).uniform(-3, 3, (5, model.nq)):
        assert np.linalg.eigvalsh(pin.crba(model, data, q))[0] > 1e-4
