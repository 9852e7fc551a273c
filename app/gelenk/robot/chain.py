"""A chain: the path from a base frame to a tip frame through a description, as flat arrays for the kernels.

The path may go up the tree and down again, so base and tip can be any two frames. A path across m joints (mimic joints
included) has m + 1 constant placements: one before each joint and one after the last, each rotated so that the joint
turns about or slides along its local z axis. A joint crossed from child to parent moves in the opposite direction, so
its axis is reversed. A chain is built from the description alone; Pinocchio checks it but does not provide it.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gelenk.errors import FrameNotOnChain, UnknownFrame, UnsupportedJoint
from gelenk.robot.arrays import Array, Indices
from gelenk.robot.description import MOVABLE, Description, Drive, Joint, Triple
from gelenk.robot.notations import placement
from gelenk.robot.poses import inverse, transform


class FlatChain(NamedTuple):
    """The numbers of a chain for the kernels, with m joints on the path, mimic joints included.

    There are few arrays because passing one to a compiled function takes a tenth of a microsecond.

    Attributes:
        placements: The constant placements: rotation row by row, then translation in [m]; shape (m + 1, 12).
        joints: For each joint, 1 if it slides, else 0, and the index of the variable that moves it; shape (m, 2).
        drives: Multiplier and offset of joint position = multiplier · variable + offset; shape (m, 2), [rad or m].
    """

    placements: Array
    joints: Indices
    drives: Array

    def placement(self, i: int) -> Array:
        """Return a constant placement as a new homogeneous transform; shape (4, 4)."""
        return transform(self.placements[i, 9:], self.placements[i, :9].reshape(3, 3))


@dataclass(frozen=True, eq=False)
class Chain:
    """A kinematic chain of a robot; the pose of `tip_frame` is expressed in `base_frame`.

    Attributes:
        joint_names: Names of the chain's n variables, base to tip; the order of a configuration.
        robot_joints: Names of all movable joints of the robot, including those outside the chain.
        lower, upper: Bounds of each variable, [rad or m], infinite if unbounded; shape (n,).
    """

    base_frame: str
    tip_frame: str
    joint_names: tuple[str, ...]
    robot_joints: frozenset[str]
    lower: Array
    upper: Array
    flat: FlatChain

    def __len__(self) -> int:
        return len(self.joint_names)


def build_chain(description: Description, base_frame: str, tip_frame: str) -> Chain:
    """Build the chain between two frames; raises UnknownFrame, or UnsupportedJoint for a floating or planar joint."""
    upwards, downwards = _path(description, base_frame, tip_frame)
    steps = [(joint, True) for joint in upwards] + [(joint, False) for joint in downwards]
    for joint, _ in steps:
        if joint.type in {"floating", "planar"}:
            raise UnsupportedJoint(joint.name, joint.type, base_frame, tip_frame)
    moving = [joint for joint, _ in steps if joint.type in MOVABLE]
    drives = [description.drives[joint.name] for joint in moving]
    names = _variables(moving, drives)
    placements = _placements(steps)
    limits = [description.joint[name].limits for name in names]
    return Chain(
        base_frame,
        tip_frame,
        names,
        frozenset(description.drives),
        np.array([-np.inf if each.lower is None else each.lower for each in limits], dtype=float),
        np.array([np.inf if each.upper is None else each.upper for each in limits], dtype=float),
        FlatChain(
            np.array([np.append(T[:3, :3], T[:3, 3]) for T in placements]),
            np.array(
                [
                    (joint.type == "prismatic", names.index(drive.leader))
                    for joint, drive in zip(moving, drives, strict=True)
                ],
                dtype=np.int64,
            ).reshape(-1, 2),
            np.array([(drive.multiplier, drive.offset) for drive in drives], dtype=float).reshape(-1, 2),
        ),
    )


def frame_on_chain(description: Description, chain: Chain, frame: str) -> tuple[Chain, Indices]:
    """Build the chain from the same base to another frame that depends only on the chain's variables.

    Return it with the index of each of its variables in the configuration of `chain`. It raises as `build_chain` does,
    and FrameNotOnChain if the frame also depends on other joints.
    """
    part = build_chain(description, chain.base_frame, frame)
    missing = tuple(name for name in part.joint_names if name not in chain.joint_names)
    if missing:
        raise FrameNotOnChain(frame, missing, chain.base_frame, chain.tip_frame)
    return part, np.array([chain.joint_names.index(name) for name in part.joint_names], dtype=np.int64)


def crossed_joints(description: Description, chain: Chain) -> tuple[Joint, ...]:
    """Return the movable joints on a chain's path, base to tip, mimic joints included: one per row of `flat.joints`."""
    upwards, downwards = _path(description, chain.base_frame, chain.tip_frame)
    return tuple(joint for joint in (*upwards, *downwards) if joint.type in MOVABLE)


def default_ends(description: Description) -> tuple[str, str]:
    """Return the root link and the leaf with the longest movable chain; of equals, the first in the document."""
    best, most = description.root, -1
    for leaf in description.leaves:
        joints = list(description.path_to_root(leaf))
        if any(joint.type in {"floating", "planar"} for joint in joints):
            continue
        count = len({description.drives[joint.name].leader for joint in joints if joint.type in MOVABLE})
        if count > most:
            best, most = leaf, count
    return description.root, best


def _path(description: Description, base_frame: str, tip_frame: str) -> tuple[list[Joint], list[Joint]]:
    """Return the joints from the base up to the common ancestor, and those from there down to the tip."""
    for frame in (base_frame, tip_frame):
        if frame not in description.joints_below:
            raise UnknownFrame(frame, description.frames)
    upwards = list(description.path_to_root(base_frame))
    downwards = list(description.path_to_root(tip_frame))
    while upwards and downwards and upwards[-1] is downwards[-1]:
        upwards.pop()
        downwards.pop()
    return upwards, downwards[::-1]


def _variables(moving: list[Joint], drives: list[Drive]) -> tuple[str, ...]:
    """Return the variables in the order of the path; a leader off it comes where a mimic joint first needs it."""
    on_path = {joint.name for joint in moving}
    names = [
        drive.leader
        for joint, drive in zip(moving, drives, strict=True)
        if drive.leader == joint.name or drive.leader not in on_path
    ]
    return tuple(dict.fromkeys(names))


def _placements(steps: list[tuple[Joint, bool]]) -> list[Array]:
    """Return the constant placements around the moving joints, each ending with the next joint's axis along z."""
    placements = []
    T = np.eye(4)
    for joint, reversed_ in steps:
        before, after = _around_motion(joint, reversed_)
        T = T @ before
        if joint.type in MOVABLE:
            placements.append(T)
            T = after
    return [*placements, T]


@lru_cache(maxsize=4096)
def _around_motion(joint: Joint, reversed_: bool) -> tuple[Array, Array]:
    """Return the constant placements before and after a joint's motion on z; a fixed joint has only the first.

    If the joint is crossed from child to parent, its axis is flipped and the inverse of its origin follows the motion.
    """
    origin = placement(joint.origin.xyz, joint.origin.rpy)
    if joint.type not in MOVABLE:
        return (inverse(origin) if reversed_ else origin), np.eye(4)
    to_axis = transform(np.zeros(3), rotation_to_axis(joint.axis))
    if not reversed_:
        return origin @ to_axis, inverse(to_axis)
    flip = np.diag([1.0, -1.0, -1.0, 1.0])
    return to_axis @ flip, flip @ inverse(to_axis) @ inverse(origin)


def rotation_to_axis(axis: Triple) -> Array:
    """Return a rotation whose z axis is the given unit vector, exact for the coordinate axes; shape (3, 3)."""
    z = np.array(axis)
    smallest = int(np.argmin(np.abs(z)))
    x = np.cross(np.eye(3)[smallest], z)
    x /= np.linalg.norm(x)
    return np.column_stack((x, np.cross(z, x), z))
