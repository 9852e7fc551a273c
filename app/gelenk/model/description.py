"""A robot's description, checked: links joined to a tree by joints.

A `Description` holds what a URDF may say, and nothing that it may not: it is always a tree
with one root, finite numbers, unit axes, ordered limits and mimic joints that lead to a joint of their own.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

JointType: TypeAlias = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]
Triple: TypeAlias = tuple[float, float, float]

MOVABLE = frozenset({"revolute", "continuous", "prismatic"})
"""Joint types with one degree of freedom: those a chain may consist of."""
MAX_NAME_LENGTH = 128
MAX_BOUND = 1e18
"""Largest mass, inertia and limit: real files write 1e16 for "no limit"."""


@dataclass(frozen=True, slots=True)
class Origin:
    """A constant placement as URDF writes it: translation `xyz` [m], fixed-axes angles `rpy` [rad]."""

    xyz: Triple = (0.0, 0.0, 0.0)
    rpy: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass [kg] at `origin` in the link, and ixx, ixy, ixz, iyy, iyz, izz about it [kg m²]."""

    origin: Origin
    mass: float
    inertia: tuple[float, float, float, float, float, float]


@dataclass(frozen=True, slots=True)
class Shape:
    """A geometry of a link, for display or collision.

    Attributes:
        role: What it is for.
        origin: Its placement in the link.
        kind: box (x, y, z), cylinder or capsule (radius, length), sphere (radius), mesh (scale x, y, z).
        size: The numbers of that kind, [m] (a mesh's scale has no unit).
        mesh: The mesh's file as the description names it; never opened here.
    """

    role: Literal["visual", "collision"]
    origin: Origin
    kind: Literal["box", "cylinder", "capsule", "sphere", "mesh"]
    size: tuple[float, ...]
    mesh: str | None = None


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body and the frame of the same name."""

    name: str
    inertial: Inertial | None = None
    shapes: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class Limits:
    """Bounds of a joint: position [rad or m], velocity [rad/s or m/s], effort [N m or N]; None where not given."""

    lower: float | None = None
    upper: float | None = None
    velocity: float | None = None
    effort: float | None = None


@dataclass(frozen=True, slots=True)
class Mimic:
    """This joint's position is `multiplier` times that of joint `joint`, plus `offset` [rad or m]."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Joint:
    """What holds link `child` to link `parent`.

    Attributes:
        name: Its name, unique in the robot.
        type: One of URDF's six.
        parent: The link nearer to the root.
        child: The link whose frame this joint's frame is.
        origin: The joint's frame in the parent's, at position zero.
        axis: Unit vector in the joint's frame to turn about or slide along; normal of the plane (planar).
        limits: Its bounds.
        mimic: The joint it follows, where it has no position of its own.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Triple = (1.0, 0.0, 0.0)
    limits: Limits = Limits()
    mimic: Mimic | None = None


@dataclass(frozen=True, slots=True)
class Drive:
    """What moves a joint: position = multiplier · (position of `leader`) + offset; a joint of its own drives itself."""

    leader: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Description:
    """A checked robot.

    Attributes:
        name: What the description calls itself.
        links: In the order of the document.
        joints: In the order of the document.
        warnings: What is odd about it though allowed, one sentence each.
    """

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    warnings: tuple[str, ...] = field(default=())

    @cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Of each link but the root: the joint that holds it."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def joints_below(self) -> dict[str, tuple[Joint, ...]]:
        """Of each link: the joints it is the parent of."""
        below: dict[str, list[Joint]] = {link.name: [] for link in self.links}
        for joint in self.joints:
            below[joint.parent].append(joint)
        return {name: tuple(joints) for name, joints in below.items()}

    @cached_property
    def root(self) -> str:
        """The link without a parent."""
        return next(link.name for link in self.links if link.name not in self.joint_above)

    @cached_property
    def frames(self) -> tuple[str, ...]:
        """Names of all frames: each link has one."""
        return tuple(link.name for link in self.links)

    @cached_property
    def leaves(self) -> tuple[str, ...]:
        """Links without children, in the order of the document."""
        return tuple(name for name in self.frames if not self.joints_below[name])

    @cached_property
    def joint(self) -> dict[str, Joint]:
        """Each joint by its name."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def drives(self) -> dict[str, Drive]:
        """What moves each movable joint, chains of mimic joints followed to their end."""
        return {joint.name: self._drive(joint) for joint in self.joints if joint.type in MOVABLE}

    @property
    def movable(self) -> tuple[Joint, ...]:
        """The joints with a position of their own, in the order of the document."""
        return tuple(joint for joint in self.joints if joint.type in MOVABLE and joint.mimic is None)

    @property
    def meshes(self) -> tuple[str, ...]:
        """Mesh files as the description names them, each once."""
        named = (shape.mesh for link in self.links for shape in link.shapes if shape.mesh is not None)
        return tuple(dict.fromkeys(named))

    def _drive(self, joint: Joint) -> Drive:
        multiplier, offset = 1.0, 0.0
        while joint.mimic is not None:
            offset += multiplier * joint.mimic.offset
            multiplier *= joint.mimic.multiplier
            joint = self.joint[joint.mimic.joint]
        return Drive(joint.name, multiplier, offset)

    def path_to_root(self, frame: str) -> Iterator[Joint]:
        """The joints from a frame up to the root."""
        while (joint := self.joint_above.get(frame)) is not None:
            yield joint
            frame = joint.parent
