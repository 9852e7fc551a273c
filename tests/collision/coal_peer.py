"""Coal and Pinocchio, for comparison: distances of two pieces, and contacts of the triangles of meshes."""

import gzip
from itertools import product

import coal
import numpy as np
import pinocchio as pin

from gelenk.collision.bodies import Body
from gelenk.collision.contact.judge import ContactJudge
from gelenk.collision.contact.world import World
from gelenk.collision.shapes.meshes import read_triangles
from gelenk.robot.arrays import Array
from gelenk.robot.description import Shape
from gelenk.robot.notations import placement
from gelenk.store.records import LoadedRobot, mesh_file

_FLAT = 1e-9
"""Height up to which a triangle counts as one without area, [m]."""


def coal_shape(body: Body) -> coal.CollisionGeometry:
    """Return the piece as one of Coal's shapes."""
    if body.kind == "convex":
        points = coal.StdVec_Vec3s()
        points.extend(list(body.points))
        return coal.Convex.convexHull(points, True, "Qt")
    if body.kind == "half_space":
        return coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
    kinds = {"sphere": coal.Sphere, "capsule": coal.Capsule, "cylinder": coal.Cylinder, "box": coal.Box}
    return kinds[body.kind](*body.size)


def coal_distance(a: Body, b: Body, poses: Array) -> float:
    """Return the distance of two pieces at poses of twelve numbers, (2, 12), [m]; in contact 0 or less."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.enable_signed_distance = False
    request.gjk_tolerance, request.gjk_max_iterations = 1e-10, 500
    places = [coal.Transform3s(np.array(pose[:9]).reshape(3, 3), np.array(pose[9:])) for pose in poses]
    return float(coal.distance(coal_shape(a), places[0], coal_shape(b), places[1], request, result))


def drawn_shape(loaded: LoadedRobot, shape: Shape) -> coal.CollisionGeometry:
    """Return a shape of a link: of a mesh its triangles, no hulls.

    Those without area are left out: Coal takes each sphere to touch them, wherever it is.
    """
    if shape.mesh is None:
        return {"sphere": coal.Sphere, "cylinder": coal.Cylinder, "box": coal.Box}[shape.kind](*shape.size)
    file = mesh_file(loaded, loaded.meshes[shape.mesh] or "")
    assert file is not None
    content = gzip.decompress(file.read_bytes()) if file.suffix == ".gz" else file.read_bytes()
    triangles = read_triangles(shape.mesh, content) * np.array(shape.size)
    sides = triangles - np.roll(triangles, 1, axis=1)
    areas, longest = (
        np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1),
        np.linalg.norm(sides, axis=2).max(axis=1),
    )
    corners = triangles[areas > _FLAT * longest].reshape(-1, 3)
    vertices, faces = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    vertices.extend(list(corners))
    for i in range(0, len(corners), 3):
        faces.append(coal.Triangle(i, i + 1, i + 2))
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(len(faces), len(vertices))
    mesh.addSubModel(vertices, faces)
    mesh.endModel()
    return mesh


def drawn_links(loaded: LoadedRobot) -> dict[str, list[tuple[coal.CollisionGeometry, pin.SE3]]]:
    """Return the shapes of each link, and their places in it; without those whose mesh is missing."""
    found = {}
    for link in loaded.robot.description.links:
        shapes = [shape for shape in link.shapes if shape.role == "collision"] or link.shapes
        there = [shape for shape in shapes if shape.mesh is None or loaded.meshes[shape.mesh] is not None]
        found[link.name] = [
            (drawn_shape(loaded, shape), pin.SE3(placement(shape.origin.xyz, shape.origin.rpy))) for shape in there
        ]
    return found


class TrianglesPeer:
    """A world whose links are as they are drawn."""

    def __init__(self, world: World, links: dict[str, list[tuple[coal.CollisionGeometry, pin.SE3]]]) -> None:
        self._model, self._data = world.robot.model, world.robot.model.createData()
        self._geometry, numbers = pin.GeometryModel(), dict[str, list[int]]()
        drawn = {name: [(name, *one) for one in some] for name, some in links.items()}
        for body, name in zip(world.bodies, world.names, strict=True):
            if name not in links:
                drawn.setdefault(name, []).append((body.link, coal_shape(body), pin.SE3(body.T_link_body)))
        for name, some in drawn.items():
            numbers[name] = [self._add(world.robot.frame_id(link), shape, place) for link, shape, place in some]
        self._of: dict[tuple[str, str], list[int]] = {}
        for a, b in dict.fromkeys((world.names[i], world.names[j]) for i, j in world.flat.pairs.tolist()):
            for i, j in product(numbers[a], numbers[b]):
                self._of.setdefault((a, b), []).append(len(self._geometry.collisionPairs))
                self._geometry.addCollisionPair(pin.CollisionPair(i, j))
        self._found = self._geometry.createData()
        zero, judge = np.zeros(len(world.chain)), ContactJudge(world)
        self._rest = judge.whole(zero)
        self._columns = np.array([judge.whole(one) - self._rest for one in np.eye(len(zero))])

    def _add(self, frame: int, shape: coal.CollisionGeometry, place: pin.SE3) -> int:
        number, at = self._geometry.ngeoms, self._model.frames[frame]
        one = pin.GeometryObject(str(number), at.parentJoint, at.placement * place, shape)
        return int(self._geometry.addGeometryObject(one))

    def touches(self, q: Array) -> bool:
        """Return whether any pair is in contact at a configuration of the chain."""
        whole = self._rest + q @ self._columns
        return bool(pin.computeCollisions(self._model, self._data, self._geometry, self._found, whole, True))

    def gap(self, a: str, b: str) -> float:
        """Return the distance of two links or objects at the configuration last looked at, [m]."""
        return min(float(pin.computeDistance(self._geometry, self._found, k).min_distance) for k in self._of[a, b])
