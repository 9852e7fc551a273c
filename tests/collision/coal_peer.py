"""Distances of two pieces by Coal, for comparison."""

import coal
import numpy as np

from gelenk.collision.bodies import Body
from gelenk.robot.arrays import Array


def coal_shape(body: Body) -> coal.CollisionGeometry:
    """Return the piece as one of Coal's shapes."""
    if body.kind == "convex":
        points = coal.StdVec_Vec3s()
        points.extend(list(body.points))
        return coal.Convex.convexHull(points, True, "Qt")
    kinds = {"sphere": coal.Sphere, "capsule": coal.Capsule, "cylinder": coal.Cylinder, "box": coal.Box}
    return kinds[body.kind](*body.size)


def coal_distance(a: Body, b: Body, poses: Array) -> float:
    """Return the distance of two pieces at poses of twelve numbers, (2, 12), [m]; in contact 0 or less."""
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.enable_signed_distance = False
    request.gjk_tolerance, request.gjk_max_iterations = 1e-10, 500
    places = [coal.Transform3s(np.array(pose[:9]).reshape(3, 3), np.array(pose[9:])) for pose in poses]
    return float(coal.distance(coal_shape(a), places[0], coal_shape(b), places[1], request, result))
