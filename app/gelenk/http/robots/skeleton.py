"""Shapes to draw for a robot whose links have no visuals."""

from gelenk.contract.pose import Pose
from gelenk.contract.shapes import BoxShape, CylinderShape, LinkShape
from gelenk.robot.appearance import Solid, skeleton
from gelenk.robot.notations import quaternions_xyzw_from_rotations
from gelenk.store.records import LoadedRobot


def skeleton_of(loaded: LoadedRobot) -> list[LinkShape]:
    """Return the skeleton of a robot; empty for a DH table, whose description has bodies of its own."""
    if loaded.table is not None:
        return []
    missing = [mesh for mesh, path in loaded.meshes.items() if path is None]
    drawn = skeleton(loaded.robot.description, missing)
    return [_link_shape(link, solid) for link, solids in drawn.items() for solid in solids]


def _link_shape(link: str, solid: Solid) -> LinkShape:
    quaternion = quaternions_xyzw_from_rotations(solid.rotation[None])[0]
    pose = Pose(position=solid.centre.tolist(), quaternion_xyzw=quaternion.tolist())
    if solid.kind == "box":
        return LinkShape(link=link, shape=BoxShape(size=list(solid.size)), pose=pose)
    radius, length = solid.size
    return LinkShape(link=link, shape=CylinderShape(radius=radius, length=length), pose=pose)
