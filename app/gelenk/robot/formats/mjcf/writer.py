"""A description as MJCF, MuJoCo's format: one body a link, in the link's frame, so that each keeps its name and pose.

What MJCF has no word for is left out: velocity limits, and meshes in formats that MuJoCo does not read.
"""

import re
from collections.abc import Mapping
from pathlib import PurePosixPath
from xml.etree import ElementTree as xml

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.description import MOVABLE, Description, Inertial, Joint, Origin, Shape
from gelenk.robot.notations import placement, quaternions_xyzw_from_rotations

_WORLD = "world"
"""Name that MuJoCo gives to what does not move."""
_MESHES = frozenset({".stl", ".obj", ".msh"})
_COMPILER = {
    "angle": "radian",
    "autolimits": "true",
    "fusestatic": "false",
    "inertiafromgeom": "false",
    # MuJoCo refuses moving bodies without mass, and inertias that no body can have.
    "balanceinertia": "true",
    "boundmass": "1e-6",
    "boundinertia": "1e-9",
}
_MASSLESS = Inertial(Origin(), 0.0, (0.0,) * 6)
"""What a link without a mass has: readers look for one in each body."""


def write_mjcf(description: Description, meshes: Mapping[str, str] | None = None, remarks: str = "") -> str:
    """Write a description as MJCF, numbers with up to 17 significant digits.

    Args:
        meshes: File of each mesh name of the description, to be named by the text; meshes are left out if None.
        remarks: A comment at its head.
    """
    return _MjcfWriter(description, meshes or {}).text(remarks)


def body_name(link: str) -> str:
    """Return the name of a link's body: its own, unless it could be taken for MuJoCo's world."""
    return f"{link}_" if link.rstrip("_") == _WORLD else link


class _MjcfWriter:
    def __init__(self, description: Description, meshes: Mapping[str, str]) -> None:
        self._description = description
        self._links = {link.name: link for link in description.links}
        self._meshes = {name: file for name, file in meshes.items() if PurePosixPath(file).suffix.lower() in _MESHES}
        self._assets: dict[tuple[str, tuple[float, ...]], str] = {}

    def text(self, remarks: str) -> str:
        root = xml.Element("mujoco", model=self._description.name or "robot")
        if remarks:
            root.append(xml.Comment(re.sub("-(?=-)", "- ", f" {remarks} ")))
        xml.SubElement(root, "compiler", _COMPILER)
        assets, world = xml.SubElement(root, "asset"), xml.SubElement(root, "worldbody")
        self._fill(xml.SubElement(world, "body", name=body_name(self._description.root)), self._description.root)
        for (name, scale), asset in self._assets.items():
            xml.SubElement(assets, "mesh", name=asset, file=self._meshes[name], scale=_words(scale))
        self._equalities(root)
        xml.indent(root)
        return f'<?xml version="1.0" encoding="utf-8"?>\n{xml.tostring(root, encoding="unicode")}\n'

    def _fill(self, body: xml.Element, link: str) -> None:
        """Write what a link has and all below it; without recursion, because chains may be long."""
        waiting = [(body, link)]
        while waiting:
            body, name = waiting.pop()
            _inertial(body, self._links[name].inertial or _MASSLESS)
            for shape in self._links[name].shapes:
                self._geometry(body, shape)
            for joint in self._description.joints_below[name]:
                child = xml.SubElement(body, "body", name=body_name(joint.child))
                _place(child, joint.origin)
                _joint(child, joint)
                waiting.append((child, joint.child))

    def _geometry(self, body: xml.Element, shape: Shape) -> None:
        kind, size = shape.kind, shape.size
        if shape.mesh is not None:
            if shape.mesh not in self._meshes:
                return
            asset = self._assets.setdefault((shape.mesh, size), f"mesh_{len(self._assets)}")
            geometry = {"type": "mesh", "mesh": asset}
        else:
            halves = tuple(0.5 * length for length in size)
            lengths = {"box": halves, "sphere": size}.get(kind, (size[0], *halves[1:]))
            geometry = {"type": kind, "size": _words(lengths)}
        seen = {"group": "2", "contype": "0", "conaffinity": "0"}
        _place(
            xml.SubElement(body, "geom", geometry | (seen if shape.role == "visual" else {"group": "3"})), shape.origin
        )

    def _equalities(self, root: xml.Element) -> None:
        followers = [joint for joint in self._description.joints if joint.mimic is not None and joint.type in MOVABLE]
        equality = xml.SubElement(root, "equality")
        for joint in followers:
            drive = self._description.drives[joint.name]
            terms = _words((drive.offset, drive.multiplier, 0.0, 0.0, 0.0))
            xml.SubElement(equality, "joint", joint1=joint.name, joint2=drive.leader, polycoef=terms)


def _place(element: xml.Element, origin: Origin) -> None:
    if origin != Origin():
        T = placement(origin.xyz, origin.rpy)
        element.set("pos", _words(origin.xyz))
        element.set("quat", _quaternion(T[:3, :3]))


def _joint(body: xml.Element, joint: Joint) -> None:
    limits = joint.limits
    if joint.type in MOVABLE:
        kind = "slide" if joint.type == "prismatic" else "hinge"
        found = xml.SubElement(body, "joint", name=joint.name, type=kind, axis=_words(joint.axis))
        if joint.type != "continuous" and limits.lower is not None and limits.upper is not None:
            found.set("range", _words((limits.lower, limits.upper)))
        if limits.effort:
            found.set("actuatorfrcrange", _words((-limits.effort, limits.effort)))
    elif joint.type in {"planar", "floating"}:
        # A free joint is for bodies of the world alone.
        axes = np.eye(3) if joint.type == "floating" else _across(joint.axis)
        for letter, axis in zip("xyz", axes, strict=False):
            xml.SubElement(body, "joint", name=f"{joint.name}_{letter}", type="slide", axis=_words(axis))
        turn = {"type": "ball"} if joint.type == "floating" else {"type": "hinge", "axis": _words(joint.axis)}
        xml.SubElement(body, "joint", turn | {"name": f"{joint.name}_angle"})


def _across(normal: tuple[float, float, float]) -> Array:
    x = np.cross(np.eye(3)[int(np.argmin(np.abs(normal)))], normal)
    x /= np.linalg.norm(x)
    return np.array([x, np.cross(normal, x)])


def _inertial(body: xml.Element, inertial: Inertial) -> None:
    """Write the principal inertias with their axes: MuJoCo takes no full matrix that is not positive definite."""
    ixx, ixy, ixz, iyy, iyz, izz = inertial.inertia
    R = placement(inertial.origin.xyz, inertial.origin.rpy)[:3, :3]
    values, axes = np.linalg.eigh(np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]]))
    axes[:, 2] *= np.sign(np.linalg.det(axes))
    where = {"pos": _words(inertial.origin.xyz), "quat": _quaternion(R @ axes)}
    principal = {"mass": repr(inertial.mass), "diaginertia": _words(np.maximum(values, 0.0).tolist())}
    xml.SubElement(body, "inertial", where | principal)


def _quaternion(R: Array) -> str:
    return _words(np.roll(quaternions_xyzw_from_rotations(np.ascontiguousarray(R[None]))[0], 1).tolist())


def _words(values: "Array | tuple[float, ...] | list[float]") -> str:
    return " ".join(repr(float(value)) for value in values)
