"""The same contacts a second way: poses by Pinocchio, pieces by Coal.

Nothing here is shared with the kernels but the pieces themselves. A verdict that differs by more than the tolerance
explains is never sent.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import TypeAlias

import coal
import numpy as np
import pinocchio as pin

from gelenk.collision.bodies import Body
from gelenk.collision.contact.nodes import joint_position
from gelenk.collision.contact.words import ContactCertificate
from gelenk.collision.contact.world import World
from gelenk.collision.shapes.hulls import convex_hull
from gelenk.errors import CertificationFailed
from gelenk.kinematics.judge.judge import sampled_rows
from gelenk.robot.arrays import Array, Flags, Indices
from gelenk.robot.description import MOVABLE

PairContacts: TypeAlias = tuple[Indices, Array, Array]
"""Pairs at one configuration: numbers (P,), distances (P,) [m], negative in contact, and nearest points (P, 6) [m]."""

TOLERANCE = 1e-6
"""Allowed difference of a distance, [m]."""
GRADIENT_TOLERANCE = 1e-3
"""Allowed difference of an entry of a gradient, [m/rad or 1], relative where that is above 1."""
_STEP = 1e-4
"""Of differences, [rad or m]."""
_GAP = 1e-3
"""Distance to which pieces in contact are moved apart for differences, [m]: Coal is exact there."""
_ROUNDING = 1e-9
"""Depth up to which nearest points are too near to each other to show a direction, [m]."""
_GJK_TOLERANCE = 1e-9
_MOST_STEPS = 500
_FAR = 1e9


class ContactJudge:
    """Coal's pieces of a world, and Pinocchio's poses of them."""

    def __init__(self, world: World) -> None:
        robot, self._world = world.robot, world
        self._frames = {body.link: robot.frame_id(body.link) for body in world.bodies}
        self._places = [(body.link, pin.SE3(body.T_link_body)) for body in world.bodies]
        self._drives = [
            (robot.model.joints[robot.model.frames[robot.frame_id(joint.child)].parentJoint].idx_q, drive)
            for joint in robot.description.joints
            if joint.type in MOVABLE
            for drive in [robot.description.drives[joint.name]]
        ]
        self.shapes = [_shape(body) for body in world.bodies]
        self._boxes = np.array([_local_box(shape) for shape in self.shapes]).reshape(-1, 6)
        self._first, self._second = world.flat.pairs.T
        self._unsigned, self._signed = _request(False), _request(True)

    def poses(self, q: Array) -> list[pin.SE3]:
        """Return the poses of all pieces in the root at a configuration of the chain."""
        return self._placed(q, self._places)

    def _placed(self, q: Array, places: Sequence[tuple[str, pin.SE3]]) -> list[pin.SE3]:
        robot = self._world.robot
        with robot.lock:
            pin.forwardKinematics(robot.model, robot.data, self.whole(q))
            links = {
                link: pin.updateFramePlacement(robot.model, robot.data, self._frames[link]).copy()
                for link in {link for link, _ in places}
            }
        return [links[link] * place for link, place in places]

    def whole(self, q: Array) -> Array:
        """Return Pinocchio's configuration: the chain's joints, and all others where the world has them."""
        values = {**self._world.others, **dict(zip(self._world.chain.joint_names, q.tolist(), strict=True))}
        whole = np.zeros(self._world.robot.model.nq)
        for index, drive in self._drives:
            whole[index] = joint_position(drive, values)
        return whole

    def distance(self, poses: list[pin.SE3], k: int, is_signed: bool = False, shift: Array | None = None) -> float:
        """Return the distance of the k-th pair, [m], its second piece perhaps shifted in the root.

        In contact it is at most 0, the depth only if it is signed: Coal then needs twenty times as long.
        """
        return self._apart(k, poses[self._first[k]], poses[self._second[k]], is_signed, shift)

    def distance_at(self, q: Array, k: int, shift: Array) -> float:
        """Return the same, at most 0 in contact, at a configuration of the chain."""
        one, other = self._placed(q, [self._places[i] for i in (self._first[k], self._second[k])])
        return self._apart(k, one, other, False, shift)

    def _apart(self, k: int, one: pin.SE3, other: pin.SE3, is_signed: bool, shift: Array | None) -> float:
        place = coal.Transform3s(other.rotation, other.translation + (0.0 if shift is None else shift))
        request, result = self._signed if is_signed else self._unsigned, coal.DistanceResult()
        own = coal.Transform3s(one.rotation, one.translation)
        shapes = self.shapes[self._first[k]], self.shapes[self._second[k]]
        return float(coal.distance(shapes[0], own, shapes[1], place, request, result))

    def least_slack(self, poses: list[pin.SE3], most: float, is_signed: bool = False) -> tuple[float, int]:
        """Return the smallest distance less its margin, of those up to `most`, and the number of pairs compared."""
        near = np.flatnonzero(self._gaps(poses) - self._world.flat.margins <= most)
        margins = self._world.flat.margins
        return min((self.distance(poses, int(k), is_signed) - float(margins[k]) for k in near), default=np.inf), len(
            near
        )

    def _gaps(self, poses: list[pin.SE3]) -> Array:
        """Return lower bounds of the distances of all pairs: of boxes along the axes of the root."""
        if not poses:
            return np.zeros(0)
        Rs = np.array([pose.rotation for pose in poses])
        centres = np.einsum("bij,bj->bi", Rs, self._boxes[:, :3]) + [pose.translation for pose in poses]
        halves = np.einsum("bij,bj->bi", np.abs(Rs), self._boxes[:, 3:])
        apart = np.abs(centres[self._first] - centres[self._second]) - halves[self._first] - halves[self._second]
        return np.asarray(apart.max(axis=1, initial=-np.inf))


_judge = lru_cache(16)(ContactJudge)


def certify_contacts(
    world: World, qs: Array, touching: Flags, contacts: Callable[[int], PairContacts], seed: int = 0
) -> ContactCertificate:
    """Compare verdicts with Coal's: all of a few, a sample of many; raises CertificationFailed.

    Args:
        world: The robot and its scene.
        qs: Configurations of the chain; shape (N, n), [rad or m].
        touching: Whether each was found to be in contact; shape (N,).
        contacts: What was found of single pairs at a row of `qs`. Coal checks that the stated displacement takes each
            pair in contact apart.
        seed: Seed of the choice.
    """
    comparison, rows = _Comparison(_judge(world)), sampled_rows(len(qs), seed)
    for row in rows:
        poses = comparison.judge.poses(qs[row])
        comparison.count(poses, bool(touching[row]), TOLERANCE)
        comparison.displace(poses, contacts(row))
    return comparison.certificate(len(rows), seed)


def certify_clearances(
    world: World, qs: Array, slacks: Array, contacts: Callable[[int], PairContacts], seed: int = 0
) -> ContactCertificate:
    """Compare smallest distances less their margins, (N,) [m], with Coal's; otherwise as `certify_contacts`."""
    judge = _judge(world)
    comparison, rows = _Comparison(judge), sampled_rows(len(qs), seed)
    for row in rows:
        poses, slack = judge.poses(qs[row]), float(slacks[row])
        least = comparison.count(poses, slack <= 0.0, max(slack, 0.0) + 2.0 * TOLERANCE)
        if slack > 0.0:
            comparison.add(least - slack if np.isfinite(slack) or np.isfinite(least) else 0.0)
        comparison.displace(poses, contacts(row))
    return comparison.certificate(len(rows), seed)


def certify_gradients(
    world: World, qs: Array, contacts: Callable[[int], PairContacts], gradients: Array, seed: int = 0
) -> float:
    """Return the largest difference of gradients, (N, n), from differences of Coal's distances, as `certify_contacts`.

    Where nearest points jump, or distances curve, the slopes to both sides differ, and a gradient is between them.
    """
    judge, worst = _judge(world), 0.0
    for row in sampled_rows(len(qs), seed):
        for k, distance, points in zip(*contacts(row), strict=True):
            shift = np.zeros(3)
            if distance < -_ROUNDING:
                shift = (points[:3] - points[3:]) * (1.0 - _GAP / distance)
            low, high = _slopes(judge, qs[row], int(k), shift)
            outside = np.maximum(low - gradients[row], gradients[row] - high)
            error = float((outside / np.maximum(1.0, np.abs(gradients[row]))).max(initial=0.0))
            worst = max(worst, error)
            if not error <= GRADIENT_TOLERANCE:
                raise CertificationFailed("the gradient of a distance", error, GRADIENT_TOLERANCE)
    return worst


def _slopes(judge: ContactJudge, q: Array, k: int, shift: Array) -> tuple[Array, Array]:
    """Return the smaller and the larger of the slopes to both sides of each joint; shape (n,) each."""
    here, steps = judge.distance_at(q, k, shift), _STEP * np.eye(len(q))
    ahead = np.array([judge.distance_at(q + step, k, shift) - here for step in steps]) / _STEP
    behind = np.array([here - judge.distance_at(q - step, k, shift) for step in steps]) / _STEP
    return np.minimum(ahead, behind), np.maximum(ahead, behind)


def certify_free(world: World, qs: Array, least: float) -> ContactCertificate:
    """Check at each configuration, (N, n), that no distance less its margin is below `least`, [m] ≥ 0, by Coal.

    Raises CertificationFailed.
    """
    comparison = _Comparison(_judge(world))
    for q in qs:
        slack = comparison.count(comparison.judge.poses(q), False, least + 2.0 * TOLERANCE)
        comparison.add(min(slack - least, 0.0))
    return comparison.certificate(len(qs), 0)


class _Comparison:
    """What a certificate says, so far."""

    def __init__(self, judge: ContactJudge) -> None:
        self.judge = judge
        self.pairs = self.touching = 0
        self.error = 0.0

    def count(self, poses: list[pin.SE3], is_contact: bool, most: float) -> float:
        """Count a verdict, and return Coal's slack up to `most`; raises CertificationFailed if it contradicts."""
        slack, compared = self.judge.least_slack(poses, most)
        self.pairs += compared
        if (slack <= 0.0) != is_contact:
            slack, _ = self.judge.least_slack(poses, most, is_signed=True)
        if (slack <= 0.0) != is_contact:
            self.touching += 1
            if not abs(slack) <= TOLERANCE:
                raise CertificationFailed("a contact", abs(slack), TOLERANCE)
        return slack

    def displace(self, poses: list[pin.SE3], contacts: PairContacts) -> None:
        """Check that each pair in contact is apart where its second piece is moved as stated."""
        for k, distance, points in zip(*contacts, strict=True):
            if distance < 0.0:
                shift = points[:3] - points[3:]
                self.add(float(np.linalg.norm(shift)) + float(distance))
                self.add(min(self.judge.distance(poses, int(k), True, shift), 0.0))

    def add(self, difference: float) -> None:
        """Count a difference of distances; raises CertificationFailed if it is too large."""
        self.error = max(self.error, abs(difference))
        if not abs(difference) <= TOLERANCE:
            raise CertificationFailed("a distance", abs(difference), TOLERANCE)

    def certificate(self, samples: int, seed: int) -> ContactCertificate:
        """Return the certificate of all that was counted."""
        return ContactCertificate(samples, self.pairs, self.error, self.touching, TOLERANCE, seed)


def _request(is_signed: bool) -> coal.DistanceRequest:
    request = coal.DistanceRequest()
    request.enable_signed_distance = is_signed
    request.gjk_tolerance = request.epa_tolerance = _GJK_TOLERANCE
    request.gjk_max_iterations = request.epa_max_iterations = _MOST_STEPS
    return request


def _local_box(shape: coal.CollisionGeometry) -> Array:
    """Return centre and half sizes of Coal's box around a shape; a half-space has none, and so is never left out."""
    if isinstance(shape, coal.Halfspace):
        return np.array([0.0, 0.0, 0.0, _FAR, _FAR, _FAR])
    shape.computeLocalAABB()
    low, high = np.ravel(shape.aabb_local.min_), np.ravel(shape.aabb_local.max_)
    return np.concatenate((0.5 * (low + high), 0.5 * (high - low)))


def _shape(body: Body) -> coal.CollisionGeometry:
    match body.kind:
        case "sphere":
            return coal.Sphere(*body.size)
        case "capsule":
            return coal.Capsule(*body.size)
        case "cylinder":
            return coal.Cylinder(*body.size)
        case "box":
            return coal.Box(*body.size)
        case "half_space":
            return coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
        case _:
            return _polytope(body.points)


def _polytope(corners: Array) -> coal.Convex:
    """Return a convex polytope; the triangles are found here, because Coal crashes at warnings of its Quickhull."""
    hull = convex_hull(corners)
    points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    points.extend(list(hull.vertices))
    triangles.extend([coal.Triangle(*face) for face in hull.faces.tolist()])
    return coal.Convex(points, triangles)
