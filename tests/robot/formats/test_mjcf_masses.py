"""MJCF: masses that follow from geoms, by closed forms, by sums of small cubes, and as MuJoCo has them."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import trimesh

from gelenk.collision.shapes.hulls import hull_triangles
from gelenk.errors import InvalidUrdf
from gelenk.robot.arrays import Array
from gelenk.robot.description import Description, Inertial
from gelenk.robot.formats.mjcf.masses import MAX_GEOMS
from gelenk.robot.formats.mjcf.reader import read_mjcf
from gelenk.robot.formats.mjcf.solids import shell_of, solid_within
from gelenk.robot.formats.sources import Fault, Sources, placed_xml
from gelenk.robot.notations import placement
from tests.robot.formats.test_mjcf import bodies

SAID = '<inertial pos="0 0 0.1" mass="1" diaginertia="1 2 2.5"/>'


def of(content: str, before: str = "") -> Inertial | None:
    return bodies(f'<body name="a">{content}</body>', before).links[1].inertial


def numbers_of(inertial: Inertial | None) -> tuple[float, Array, Array]:
    """Return mass, centre and the inertia about it in the link's axes."""
    assert inertial is not None
    T = placement(inertial.origin.xyz, inertial.origin.rpy)
    xx, xy, xz, yy, yz, zz = inertial.inertia
    return inertial.mass, T[:3, 3], T[:3, :3] @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ T[:3, :3].T


INSIDE: dict[str, Callable[[Array, Array, Array], Any]] = {
    'type="sphere" size="0.3"': lambda x, y, z: x**2 + y**2 + z**2 <= 0.09,
    'type="box" size="0.1 0.2 0.3"': lambda x, y, z: (abs(x) <= 0.1) & (abs(y) <= 0.2) & (abs(z) <= 0.3),
    'type="ellipsoid" size="0.1 0.2 0.3"': lambda x, y, z: (x / 0.1) ** 2 + (y / 0.2) ** 2 + (z / 0.3) ** 2 <= 1.0,
    'type="cylinder" size="0.2 0.3"': lambda x, y, z: (x**2 + y**2 <= 0.04) & (abs(z) <= 0.3),
    'type="capsule" size="0.1 0.2"': lambda x, y, z: x**2 + y**2 + np.maximum(abs(z) - 0.2, 0.0) ** 2 <= 0.01,
}


@pytest.mark.parametrize("geom", INSIDE)
def test_a_primitive_has_the_mass_of_its_small_cubes(geom: str) -> None:
    mass, centre, inertia = numbers_of(of(f'<geom {geom} density="800"/>'))
    steps = (np.arange(60) + 0.5) / 100.0 - 0.3
    cubes = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    found = cubes[INSIDE[geom](*cubes.T)]
    weight = 800.0 / 100.0**3
    assert mass == pytest.approx(len(found) * weight, rel=0.02)  # the cubes at the surface count whole or not at all
    np.testing.assert_allclose(centre, 0.0, atol=1e-15)
    expected = weight * ((found**2).sum() * np.eye(3) - found.T @ found)
    np.testing.assert_allclose(inertia, expected, rtol=0.03, atol=1e-9)


SHELLS: dict[str, tuple[Callable[[], Any], float]] = {
    'type="sphere" size="0.3"': (lambda: trimesh.creation.icosphere(5, 0.3), 1e-3),
    'type="box" size="0.1 0.2 0.3"': (lambda: trimesh.creation.box((0.2, 0.4, 0.6)), 1e-14),
    'type="cylinder" size="0.2 0.3"': (lambda: trimesh.creation.cylinder(0.2, 0.6, sections=500), 1e-3),
    'type="capsule" size="0.1 0.2"': (lambda: trimesh.creation.capsule(0.4, 0.1, [400, 400]), 1e-3),
}
"""A fine mesh of each surface, and how well it fits."""


@pytest.mark.parametrize("geom", SHELLS)
def test_the_shell_of_a_primitive_has_the_mass_of_its_surface_s_triangles(geom: str) -> None:
    mass, centre, inertia = numbers_of(of(f'<geom {geom} density="8" shellinertia="true"/>'))
    make, fit = SHELLS[geom]
    expected = shell_of(np.asarray(make().triangles)).scaled(8.0)
    assert mass == pytest.approx(expected.mass, rel=fit)
    np.testing.assert_allclose(centre, expected.centre, atol=1e-3 * fit)
    np.testing.assert_allclose(inertia, expected.inertia, rtol=fit, atol=1e-3 * fit)


def test_the_shell_of_a_mesh_has_the_mass_of_points_spread_over_it() -> None:
    triangles = cube() * (1.0, 2.0, 3.0)
    found = shell_of(triangles)
    assert found.mass == pytest.approx(22.0)
    np.testing.assert_allclose(found.centre, [0.5, 1.0, 1.5], atol=1e-15)
    steps = (np.arange(40) + 0.5) / 40.0
    u, v = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    inertia = np.zeros((3, 3))
    for a, b, c in triangles:  # the map of the square to a triangle stretches by u
        points = a + u[:, None] * (b - a) + (u * v)[:, None] * (c - b) - found.centre
        weights = np.linalg.norm(np.cross(b - a, c - b)) * u / len(u)
        squares = np.einsum("k,ki,kj->ij", weights, points, points)
        inertia += np.trace(squares) * np.eye(3) - squares
    np.testing.assert_allclose(found.inertia, inertia, rtol=1e-3, atol=1e-12)


def test_a_convex_mesh_has_the_mass_of_its_hull_whatever_its_faces_are() -> None:
    open_box = cube(2.0)[2:, ::-1]
    for scale, sign in (("1 1 1", 1.0), ("1 1 -1", -1.0)):
        model = with_mesh(f'inertia="convex" scale="{scale}"', 'density="1"', triangles=open_box)
        mass, centre, inertia = numbers_of(model.links[1].inertial)
        assert not model.warnings
        assert mass == pytest.approx(8.0)
        np.testing.assert_allclose(centre, [1.0, 1.0, sign], atol=1e-14)
        np.testing.assert_allclose(inertia, 8.0 * 4.0 / 6.0 * np.eye(3), atol=1e-13)


def test_a_shell_weighs_what_its_surface_does() -> None:
    mass, centre, inertia = numbers_of(with_mesh('inertia="shell"', 'density="2"').links[1].inertial)
    assert mass == pytest.approx(12.0)
    np.testing.assert_allclose(centre, 0.5, atol=1e-15)
    np.testing.assert_allclose(inertia, 12.0 * 5.0 / 18.0 * np.eye(3), atol=1e-14)


# Mass, centre and inertia (xx, yy, zz, xy, xz, yz) of bodies that MuJoCo 4.0 compiles.
IN_MUJOCO = {
    '<geom type="capsule" size="0.1 0.2" mass="3" pos="1 0 0"/>': (3.0, (1, 0, 0), (0.079875, 0.079875, 0.01425)),
    '<geom type="box" size="0.1 0.2 0.3" density="500"/>': (24.0, (0, 0, 0), (1.04, 0.8, 0.4)),
    '<geom size="0.1" group="3"/><geom type="box" size="0.1 0.1 0.1" pos="1 0 0"/>': (
        12.188790204786393, (0.65634077, 0, 0), (0.07008849, 2.8193623, 2.8193623),
    ),
    '<geom type="cylinder" size="0.2 0.3" density="8" shellinertia="true"/>': (
        8.042477193189871, (0, 0, 0), (0.5026548245743669, 0.5026548245743669, 0.28148670176164553),
    ),
    '<geom type="capsule" size="0.1 0.2" density="8" shellinertia="true"/>': (
        3.0159289474462017, (0, 0, 0), (0.10388199707870252, 0.10388199707870252, 0.02680825731063291),
    ),
}  # fmt: skip


@pytest.mark.parametrize("geoms", IN_MUJOCO)
def test_masses_are_those_that_mujoco_has(geoms: str) -> None:
    mass, centre, inertia = numbers_of(of(geoms))
    expected = IN_MUJOCO[geoms]
    assert mass == pytest.approx(expected[0], rel=1e-14)
    np.testing.assert_allclose(centre, expected[1], atol=1e-8)
    np.testing.assert_allclose(inertia, np.diag(expected[2]), atol=1e-8)


ELLIPSOID = 'type="ellipsoid" size="0.3 0.3 0.3"'


def test_the_shell_of_an_ellipsoid_is_approximated_as_in_mujoco() -> None:
    mass, _, inertia = numbers_of(of('<geom type="ellipsoid" size="0.1 0.2 0.3" density="8" shellinertia="true"/>'))
    assert mass == pytest.approx(3.917754666697385, rel=1e-14)
    found = [0.1446013990607753, 0.11254693261071225, 0.06482144749452345]  # of two ellipsoids that differ by 1e-6 m
    np.testing.assert_allclose(inertia, np.diag(found), rtol=1e-5, atol=1e-15)
    ball, same = (of(f'<geom {size} shellinertia="true"/>') for size in ('size="0.3"', ELLIPSOID))
    assert ball is not None
    assert same is not None
    np.testing.assert_allclose(ball.inertia, same.inertia, rtol=1e-14)
    assert ball.mass == pytest.approx(same.mass, rel=1e-14)


def test_a_turned_geom_turns_its_inertia() -> None:
    box = 'type="box" size="0.1 0.2 0.3"'
    mass, centre, inertia = numbers_of(of(f'<frame euler="0 0 90" pos="1 2 3"><geom {box} pos="0 1 0"/></frame>'))
    assert mass == pytest.approx(48.0)
    np.testing.assert_allclose(centre, [0.0, 2.0, 3.0], atol=1e-15)
    np.testing.assert_allclose(inertia, 16.0 * np.diag([0.10, 0.13, 0.05]), atol=1e-12)
    rod = numbers_of(of('<geom type="cylinder" size="0.01" fromto="0 0 0 0 3 4" mass="12"/>'))
    np.testing.assert_allclose(rod[1], [0.0, 1.5, 2.0])
    assert rod[2][0, 0] == pytest.approx(25.0 + 12.0 * 0.01**2 / 4.0)


CHOICES = {
    ("auto", False): 4.0, ("auto", True): 1.0, ("true", False): 4.0, ("true", True): 4.0,
    ("false", False): None, ("false", True): 1.0,
}  # fmt: skip


@pytest.mark.parametrize(("choice", "said"), CHOICES)
def test_the_compiler_chooses_between_geoms_and_what_is_said(choice: str, said: bool) -> None:
    found = of(f'<geom size="1" mass="4"/>{SAID if said else ""}', f'<compiler inertiafromgeom="{choice}"/>')
    assert (found and found.mass) == CHOICES[choice, said]


def test_without_a_geom_that_weighs_something_there_is_no_mass() -> None:
    for geom in ('type="plane" size="1 1 1"', 'size="1" mass="0"', 'size="1" density="0"'):
        assert of(f"<geom {geom}/>") is None
    assert of('<geom size="1" group="3"/>', '<compiler inertiagrouprange="0 2"/>') is None
    assert bodies('<geom size="1"/><body/>').links[0].inertial is None


def test_bounds_of_the_compiler_hold_for_each_body() -> None:
    mass, _, inertia = numbers_of(of('<geom size="0.1" mass="1"/>', '<compiler boundmass="2" boundinertia="0.5"/>'))
    assert mass == 2.0
    np.testing.assert_allclose(inertia, 0.5 * np.eye(3))
    long = '<inertial pos="0 0 0" mass="1" diaginertia="1 2 5"/>'
    balanced = numbers_of(of(long, '<compiler balanceinertia="true"/>'))
    np.testing.assert_allclose(balanced[2], 8.0 / 3.0 * np.eye(3))
    assert of(long) == of(long, '<compiler balanceinertia="false"/>')
    total = numbers_of(of('<geom size="0.1"/>', '<compiler settotalmass="5"/>'))
    assert total[0] == pytest.approx(5.0)
    assert total[2][0, 0] == pytest.approx(0.4 * 5.0 * 0.01)


def cube(scale: float = 1.0) -> Array:
    """Return the triangles of a cube from 0 to 1 times a scale, seen from outside."""
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float) * scale
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return np.array([corners[list(corner)] for a, b, c, d in squares for corner in ((a, b, c), (a, c, d))])


@pytest.mark.parametrize("is_exact", [False, True])
def test_a_closed_mesh_has_the_mass_of_its_inside(is_exact: bool) -> None:
    for triangles in (cube(2.0), cube(2.0)[:, ::-1]):
        found = solid_within(triangles, is_exact)
        assert found.mass == pytest.approx(8.0)
        np.testing.assert_allclose(found.centre, 1.0, atol=1e-14)
        np.testing.assert_allclose(found.inertia, 8.0 * 4.0 / 6.0 * np.eye(3), atol=1e-13)


def test_a_hollow_is_left_out_if_the_mesh_counts_exactly() -> None:
    hollow = np.concatenate([cube(2.0), cube(1.0)[:, ::-1] + 0.5])
    assert solid_within(hollow, is_exact=True).mass == pytest.approx(7.0)
    assert solid_within(hollow, is_exact=False).mass == pytest.approx(9.0)
    for flat in (np.zeros((1, 3, 3)), np.empty((0, 3, 3))):
        with pytest.raises(Fault, match="it has no volume"):
            solid_within(flat)


MASS_OF_U, CENTRE_OF_U, INERTIA_OF_U = (
    8.61754009163803,
    [1.4999999999999998, 1.4263101374570448, 0.4999999999999999],
    [6.699129129016179, 7.461754009163804, 12.832462462349513],
)
"""Of a U whose middle lies outside of it, with density 1, as MuJoCo 4.0 compiles it."""


def test_a_mesh_that_hides_parts_of_itself_has_the_mass_that_mujoco_gives_it() -> None:
    outline = np.array([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], dtype=float)
    lower, upper = (np.column_stack([outline, np.full(8, height)]) for height in (0.0, 1.0))
    caps = [(0, 1, 4), (0, 4, 5), (0, 5, 6), (0, 6, 7), (1, 2, 3), (1, 3, 4)]
    ends = [upper[list(cap)] for cap in caps] + [lower[list(cap[::-1])] for cap in caps]
    after = np.roll(np.arange(8), -1)
    sides = [(lower[i], lower[j], upper[j]) for i, j in enumerate(after)]
    sides += [(lower[i], upper[j], upper[i]) for i, j in enumerate(after)]
    triangles = np.array([*ends, *sides])
    assert solid_within(triangles, is_exact=True).mass == pytest.approx(7.0)
    as_mujoco = solid_within(triangles, is_exact=False)
    np.testing.assert_allclose(as_mujoco.mass, MASS_OF_U, rtol=1e-12)
    np.testing.assert_allclose(as_mujoco.centre, CENTRE_OF_U, atol=1e-8)
    np.testing.assert_allclose(np.linalg.eigvalsh(as_mujoco.inertia), INERTIA_OF_U, atol=1e-8)


def with_mesh(
    mesh: str = "", geom: str = "", files: tuple[str, ...] = ("m/part.obj",), triangles: Array | None = None
) -> Description:
    content = f"""<mujoco><compiler meshdir="m"/>
      <asset><mesh name="part" file="part.obj" {mesh}/></asset>
      <worldbody><body name="a"><geom type="mesh" mesh="part" {geom}/></body></worldbody></mujoco>"""
    found = Sources(lambda name, _: [name] if name in files else [], hull=hull_triangles)
    found.triangles = lambda _: cube() if triangles is None else triangles
    return read_mjcf(placed_xml(content, "arm.xml"), found)


def test_a_mesh_has_the_mass_of_its_file() -> None:
    mass, centre, _ = numbers_of(
        with_mesh('scale="1 1 -2" refpos="1 0 0"', 'density="3" pos="0 0 5"').links[1].inertial
    )
    assert mass == pytest.approx(6.0)
    np.testing.assert_allclose(centre, [-0.5, 0.5, 4.0], atol=1e-14)


def test_what_is_not_counted_is_warned_of_with_its_line() -> None:
    lost = with_mesh(files=())
    assert lost.links[1].inertial is None
    assert lost.warnings == ("line 3: its mass is not counted: there is no file 'm/part.obj'",)
    told = with_mesh('inertia="convex" maxhullvert="8"').warnings
    assert told == ("line 2: maxhullvert is not read: the mass is that of the whole hull",)
    flat = with_mesh('inertia="convex"', triangles=cube() * (1.0, 1.0, 0.0))
    assert flat.warnings == ("line 3: its mass is not counted: it is flat: its hull has no volume",)
    with pytest.raises(InvalidUrdf, match="inertia is 'thin' but must be one of convex, exact, legacy, shell"):
        with_mesh('inertia="thin"')
    for geom in ('size="1" mass="-1"', 'size="0"', 'type="sdf"'):
        assert "line 2: its mass is not counted: " in bodies(f"<body><geom {geom}/></body>").warnings[0]


def test_geoms_are_counted_up_to_a_number() -> None:
    found = bodies("<body>" + '<geom size="1" mass="1"/>' * (MAX_GEOMS + 2) + "</body>")
    assert found.links[1].inertial is not None
    assert found.links[1].inertial.mass == MAX_GEOMS
    assert f"line 2: its mass is not counted: more than {MAX_GEOMS} geoms have one" in found.warnings
