"""A checked robot description: links joined into a tree by joints.

A `Description` can hold everything that a valid URDF describes, and nothing else: it is always a tree with one root,
unique names, finite numbers, unit axes, ordered limits, and mimic joints that end at an independent joint.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, TypeAlias

JointType: TypeAlias = Literal["revolute", "continuous", "prismatic", "fixed", "floating", "planar"]
Triple: TypeAlias = tuple[float, float, float]

MOVABLE = frozenset({"revolute", "continuous", "prismatic"})
"""Joint types with one degree of freedom, the only movable ones allowed in a chain."""
MAX_NAME_LENGTH = 128
MAX_BOUND = 1e18
"""Largest mass, inertia or limit allowed; real files write 1e16 for "no limit"."""


@dataclass(frozen=True, slots=True)
class Origin:
    """A constant placement as URDF writes it: translation `xyz` [m], fixed-axes angles `rpy` [rad]."""

    xyz: Triple = (0.0, 0.0, 0.0)
    rpy: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True)
class Inertial:
    """Mass [kg], its frame `origin` in the link, and ixx, ixy, ixz, iyy, iyz, izz in that frame [kg m²]."""

    origin: Origin
    mass: float
    inertia: tuple[float, float, float, float, float, float]


@dataclass(frozen=True, slots=True)
class Shape:
    """A geometry of a link, for display or collision checking, at `origin` in the link's frame.

    Attributes:
        kind: box (x, y, z), cylinder or capsule (radius, length), sphere (radius), mesh (scale x, y, z).
        size: Numbers of that kind, [m] (a mesh's scale has no unit).
        mesh: File name of the mesh as in the description; this package never opens the file.
    """

    role: Literal["visual", "collision"]
    origin: Origin
    kind: Literal["box", "cylinder", "capsule", "sphere", "mesh"]
    size: tuple[float, ...]
    mesh: str | None = None


@dataclass(frozen=True, slots=True)
class Link:
    """A rigid body, and the frame of the same name."""

    name: str
    inertial: Inertial | None = None
    shapes: tuple[Shape, ...] = ()


@dataclass(frozen=True, slots=True)
class UrdfLimits:
    """Limits of a joint: position [rad or m], velocity [rad/s or m/s], effort [N m or N]; None if not given."""

    lower: float | None = None
    upper: float | None = None
    velocity: float | None = None
    effort: float | None = None


@dataclass(frozen=True, slots=True)
class Mimic:
    """A rule that sets a joint's position to `multiplier` times that of joint `joint`, plus `offset` [rad or m]."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, slots=True)
class Joint:
    """A connection of link `child`, whose frame is also the joint's, to link `parent`, which is nearer to the root.

    Attributes:
        origin: Frame of the joint in the parent's frame, at position zero.
        axis: Unit vector in the joint's frame: axis of rotation, direction of sliding, or normal of the plane (planar).
        mimic: Rule for following another joint; None for an independent joint.
    """

    name: str
    type: JointType
    parent: str
    child: str
    origin: Origin = Origin()
    axis: Triple = (1.0, 0.0, 0.0)
    limits: UrdfLimits = UrdfLimits()
    mimic: Mimic | None = None


@dataclass(frozen=True, slots=True)
class Drive:
    """Rule of a joint: position = multiplier · (position of `leader`) + offset; an independent joint leads itself."""

    leader: str
    multiplier: float
    offset: float


@dataclass(frozen=True)
class Description:
    """A checked robot description, in document order; `warnings` are allowed oddities, one sentence each."""

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    warnings: tuple[str, ...] = field(default=())

    @cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Joint above each link except the root, by link name."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def joints_below(self) -> dict[str, tuple[Joint, ...]]:
        """Joints directly below each link, by link name."""
        below: dict[str, list[Joint]] = {link.name: [] for link in self.links}
        for joint in self.joints:
            below[joint.parent].append(joint)
        return {name: tuple(joints) for name, joints in below.items()}

    @cached_property
    def root(self) -> str:
        """Name of the link without a parent."""
        return next(link.name for link in self.links if link.name not in self.joint_above)

    @cached_property
    def frames(self) -> tuple[str, ...]:
        """Names of all frames, one for each link."""
        return tuple(link.name for link in self.links)

    @cached_property
    def leaves(self) -> tuple[str, ...]:
        """Names of the links without children, in document order."""
        return tuple(name for name in self.frames if not self.joints_below[name])

    @cached_property
    def joint(self) -> dict[str, Joint]:
        """Joints by name."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def drives(self) -> dict[str, Drive]:
        """Rule of each movable joint, by joint name, with chains of mimic joints resolved."""
        return {joint.name: self._drive(joint) for joint in self.joints if joint.type in MOVABLE}

    @property
    def movable(self) -> tuple[Joint, ...]:
        """Independent movable joints, in document order."""
        return tuple(joint for joint in self.joints if joint.type in MOVABLE and joint.mimic is None)

    @property
    def meshes(self) -> tuple[str, ...]:
        """Mesh files as named in the description, without duplicates."""
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
        """Yield the joints from a frame up to the root."""
        while (joint := self.joint_above.get(frame)) is not None:
            yield joint
            frame = joint.parent
