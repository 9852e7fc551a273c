"""What covers add: known volumes and distances, points drawn in the spheres and on them, and Coal's distances."""

import math

import coal
import numpy as np
import pytest
import trimesh
from scipy.spatial import ConvexHull

from gelenk.collision.bodies import Body, PieceKind
from gelenk.collision.shapes.balls import ball_around
from gelenk.collision.shapes.cover_excess import excess_of_cover, protrusion, volume_of, volume_of_union
from gelenk.collision.shapes.covers import covered_body
from gelenk.robot.arrays import Array
from gelenk.robot.notations import placement
from tests.collision.shapes.test_covers import NOTHING, PIECES

PLACE = placement((0.5, -2.0, 1.0), (0.3, -1.0, 2.0))


def body_of(kind: PieceKind, size: tuple[float, ...] = (), points: Array = NOTHING) -> Body:
    return covered_body("piece", "link", kind, size, PLACE, points)


@pytest.fixture(params=PIECES, ids=lambda piece: f"{piece[0]} {piece[1]}")
def body(request: pytest.FixtureRequest) -> Body:
    return body_of(*request.param)


def coal_shape(body: Body) -> coal.CollisionGeometry:
    """The piece as a shape of Coal's, with a hull that scipy found."""
    if body.kind != "convex":
        return {"sphere": coal.Sphere, "capsule": coal.Capsule, "cylinder": coal.Cylinder, "box": coal.Box}[body.kind](
            *body.size
        )
    hull = ConvexHull(body.points)
    points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    points.extend(list(hull.points))
    triangles.extend([coal.Triangle(*face) for face in hull.simplices.tolist()])
    return coal.Convex(points, triangles)


def directions(count: int) -> Array:
    """Unit vectors all around, in a spiral; shape (count, 3)."""
    turn, z = math.pi * (3.0 - math.sqrt(5.0)) * np.arange(count), 1.0 - (2.0 * np.arange(count) + 1.0) / count
    across = np.sqrt(1.0 - z**2)
    return np.column_stack((np.cos(turn) * across, np.sin(turn) * across, z))


def test_no_point_of_the_spheres_is_farther_away_and_one_is_as_far(body: Body) -> None:
    shape, place = coal_shape(body), coal.Transform3s(PLACE[:3, :3], PLACE[:3, 3])
    request, point, farthest = coal.DistanceRequest(), coal.Sphere(1e-12), 0.0
    for spot in np.concatenate([c[:3] + c[3] * directions(150) for c in body.spheres]):
        at = coal.Transform3s(np.eye(3), spot)
        farthest = max(farthest, coal.distance(shape, place, point, at, request, coal.DistanceResult()))
    assert protrusion(body) - 0.03 * body.spheres[:, 3].max() <= farthest <= protrusion(body) + 1e-5


def test_the_volume_of_the_spheres_is_the_share_of_points_in_them(body: Body) -> None:
    centres, radii = body.spheres[:, :3], body.spheres[:, 3]
    low, high = (centres - radii[:, None]).min(axis=0), (centres + radii[:, None]).max(axis=0)
    points = np.random.default_rng(3).uniform(low, high, (40_000, 3))
    share = (np.linalg.norm(points[:, None] - centres, axis=2) <= radii).any(axis=1).mean()
    error = math.sqrt((1.0 - share) / share / len(points))
    assert volume_of_union(body.spheres) == pytest.approx(share * np.prod(high - low), rel=4.0 * error + 1e-3)
    assert (1.0 + excess_of_cover(body)) * volume_of(body) == pytest.approx(volume_of_union(body.spheres))


def test_two_spheres_share_a_lens() -> None:
    radius, apart = 0.3, 0.4
    lens = math.pi * (4.0 * radius + apart) * (2.0 * radius - apart) ** 2 / 12.0
    spheres = np.array([[1.0, 2.0, 3.0, radius], [1.0, 2.0, 3.0, radius]])
    for axis in range(3):
        spheres[1, :3] = spheres[0, :3] + apart * np.eye(3)[axis]
        assert volume_of_union(spheres) == pytest.approx(8.0 / 3.0 * math.pi * radius**3 - lens, rel=1e-3)


def test_volumes_are_those_of_meshes() -> None:
    meshes = {
        body_of("sphere", (0.2,)): trimesh.creation.icosphere(5, 0.2),
        body_of("capsule", (0.1, 0.8)): trimesh.creation.capsule(0.8, 0.1, count=[100, 100]),
        body_of("cylinder", (0.1, 0.8)): trimesh.creation.cylinder(0.1, 0.8, sections=200),
        body_of("box", (1.0, 0.3, 0.02)): trimesh.creation.box((1.0, 0.3, 0.02)),
        body_of(*PIECES[-1]): trimesh.convex.convex_hull(PIECES[-1][2]),
    }
    for body, mesh in meshes.items():
        assert volume_of(body) == pytest.approx(mesh.volume, rel=2e-3), body.kind


def test_a_cube_has_the_ball_around_it_and_a_ball_is_its_own_cover() -> None:
    cube, ball, disc = body_of("box", (2.0, 2.0, 2.0)), body_of("sphere", (0.2,)), body_of("capsule", (0.1, 0.0))
    assert protrusion(cube) == pytest.approx(math.sqrt(3.0) - 1.0)
    assert excess_of_cover(cube) == pytest.approx(math.pi * math.sqrt(3.0) / 2.0 - 1.0)
    for body in (ball, disc):
        assert protrusion(body) == pytest.approx(0.0, abs=1e-12)
        assert excess_of_cover(body) == pytest.approx(0.0, abs=1e-12)


def test_of_a_flat_piece_only_the_distance_is_known() -> None:
    square = body_of("convex", (), np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]))
    assert math.isnan(excess_of_cover(square))
    assert protrusion(square) == pytest.approx(square.spheres[:, 3].max(), rel=1e-5)


@pytest.mark.parametrize("seed", range(20))
def test_the_centre_of_a_ball_is_within_the_points(seed: int) -> None:
    random = np.random.default_rng(seed)
    points = random.normal(size=(int(random.integers(4, 9)), 3)) ** 3
    planes = ConvexHull(points).equations
    assert (planes[:, :3] @ ball_around(points)[:3] + planes[:, 3]).max() <= 1e-12 * np.abs(points).max()
