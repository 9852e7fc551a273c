"""Everything about a robot except its poses."""

from dataclasses import asdict

from gelenk.contract.common import ChainEnds
from gelenk.contract.dh import DhTablePayload, table_content
from gelenk.contract.pose import Pose
from gelenk.contract.robots import (
    BoxShape,
    CylinderShape,
    JointInfo,
    LimitsInfo,
    LinkShape,
    MeshInfo,
    MimicInfo,
    RobotInfo,
)
from gelenk.robot.appearance import Solid, skeleton
from gelenk.robot.description import Joint
from gelenk.robot.notations import quaternions_xyzw_from_rotations
from gelenk.store.index import ABOUT
from gelenk.store.records import LoadedRobot


def info(loaded: LoadedRobot) -> RobotInfo:
    """Return everything about a robot except its poses."""
    record, robot = loaded.record, loaded.robot
    description = robot.description
    chain = robot.chain(None, None)
    return RobotInfo(
        name=record.name,
        **{field: getattr(record.file, field) for field in ABOUT},
        source=record.source,
        format=record.file.format,
        default_chain=ChainEnds(base_frame=chain.base_frame, tip_frame=chain.tip_frame),
        payload=record.file.payload,
        reach=record.file.reach,
        controller=record.file.controller,
        chains=record.file.chains,
        root=description.root,
        joints=[_joint(joint) for joint in description.joints],
        joint_names=list(chain.joint_names),
        dh=None if loaded.table is None else DhTablePayload.model_validate(table_content(loaded.table)),
        degrees_of_freedom=len(description.movable),
        links=list(description.frames),
        frames=list(description.frames),
        leaf_tips=list(description.leaves),
        meshes=[MeshInfo(reference=reference, path=path) for reference, path in loaded.meshes.items()],
        skeleton=_skeleton(loaded),
        licence=record.file.licence,
        provenance=record.file.source,
        warnings=list(loaded.warnings),
    )


def _joint(joint: Joint) -> JointInfo:
    return JointInfo(
        name=joint.name,
        type=joint.type,
        parent=joint.parent,
        child=joint.child,
        origin=Pose(position=list(joint.origin.xyz), rpy=list(joint.origin.rpy)),
        axis=None if joint.type in {"fixed", "floating"} else list(joint.axis),
        limits=LimitsInfo(**asdict(joint.limits)),
        mimic=None if joint.mimic is None else MimicInfo(**asdict(joint.mimic)),
    )


def _skeleton(loaded: LoadedRobot) -> list[LinkShape]:
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
