"""Reads and writes URDF: untrusted XML → checked `Description`; `Description` → XML written by this package.

The reader refuses whatever it would read as a different robot; each refusal names the element and the line. It only
warns of oddities and of faults that do not affect kinematics: in shapes, in masses, in the limits of a fixed joint.
Pinocchio never sees the incoming text, only what `write_urdf` writes from the description.
"""

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import replace
from typing import Literal, cast
from xml.sax.saxutils import quoteattr

from gelenk.errors import InvalidUrdf, meshes_are, quoted
from gelenk.robot.description import (
    MAX_BOUND,
    MAX_NAME_LENGTH,
    MOVABLE,
    Description,
    Inertial,
    Joint,
    JointType,
    Link,
    Mimic,
    Origin,
    Shape,
    Triple,
    UrdfLimits,
)
from gelenk.robot.tree import check_tree
from gelenk.robot.xml import Element, left_of_xacro, read_xml, with_declaration_first, without_links

MAX_LINKS = 512
MAX_SHAPES = 512
MAX_MAGNITUDE = 1e6
"""Largest length [m], angle [rad] or multiplier: beyond it, a double cannot resolve a nanometre."""


UNLIMITED = 1e16
"""A velocity or effort that means "not given", here and in many files: URDF has no notation for that."""
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_ELSEWHERE = re.compile(r"^[/\\]|^(?!package:|model:)\w+:|(^|[/\\])\.\.([/\\]|$)")
"""Matches a mesh name outside the folder: an absolute path, a drive, a URL, or a path that leads out by `..`."""
_JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
_SILENT = frozenset({"gazebo", "transmission", "material", "sensor", "ros2_control", "frame", "loop_joint"})
"""Elements of a robot that other tools read and kinematics does not need."""
_KNOWN_ELEMENTS = {
    "robot": _SILENT | {"link", "joint"},
    "link": {"inertial", "visual", "collision", "contact", "gravity", "kinematic", "self_filter", "collision_checking"},
    "joint": {"origin", "parent", "child", "axis", "limit", "mimic", "dynamics", "calibration", "safety_controller"},
    "inertial": {"origin", "mass", "inertia"},
    "visual": {"origin", "geometry", "material"},
    "collision": {"origin", "geometry", "material", "verbose"},
}
_KNOWN_ATTRIBUTES = {
    "robot": {"name", "version"},
    "link": {"name", "type"},
    "joint": {"name", "type"},
    "inertial": set(),
    "visual": {"name"},
    "collision": {"name"},
    "limit": {"lower", "upper", "velocity", "effort"},
    "mimic": {"joint", "multiplier", "offset"},
    "origin": {"xyz", "rpy"},
    "axis": {"xyz"},
}
_SHAPE_SIZES = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "capsule": ("radius", "length"),
    "sphere": ("radius",),
}


def read_urdf(text: str, strict: bool = False) -> Description:
    """Read and check a description.

    Args:
        text: The URDF, with xacro already expanded.
        strict: Whether faults that do not affect kinematics are refused too, instead of only warned of.

    Returns:
        The robot, with its oddities in `warnings`.

    Raises:
        InvalidUrdf: The text is not well-formed XML, does not describe a robot, or exceeds a limit.
    """
    warnings = []
    if not strict and (put_right := with_declaration_first(text)) != text.removeprefix("\ufeff"):
        warnings.append("line 1: nothing may come before the XML declaration: it is ignored")
        text = put_right
    root = read_xml(text)
    if root.tag != "robot":
        raise InvalidUrdf(f"the root element is {quoted(root.tag)} where a URDF has 'robot'", None, root.line)
    unexpanded = left_of_xacro(root, _SILENT)
    if unexpanded:
        warnings.append(unexpanded)
    try:
        return _DocumentReader(strict, warnings).robot(root)
    except InvalidUrdf as error:
        if unexpanded is None:
            raise
        raise InvalidUrdf(f"{error.reason}; {unexpanded}", error.element, error.line) from error


class _DocumentReader:
    """Reads one document and collects warnings."""

    def __init__(self, strict: bool, warnings: list[str]) -> None:
        self._strict = strict
        self._warnings = warnings
        self._lines: dict[str, int] = {}
        self._shape_count = 0

    def robot(self, root: Element) -> Description:
        links = [element for element in root.children if element.tag == "link"]
        joints = [element for element in root.children if element.tag == "joint"]
        if not links:
            raise InvalidUrdf(without_links(root), None, root.line)
        self._check_known(root, None)
        if len(links) > MAX_LINKS:
            raise InvalidUrdf(f"the robot has {len(links)} links; at most {MAX_LINKS} are allowed", None, root.line)
        description = Description(
            root.attributes.get("name", ""),
            tuple(self._link(element) for element in links),
            tuple(self._joint(element) for element in joints),
        )
        check_tree(description, self._lines)
        self._warn_of_meshes(description)
        self._warn_of_massless(description)
        return Description(description.name, description.links, description.joints, tuple(self._warnings))

    @contextmanager
    def _harmless(self, consequence: str) -> Iterator[None]:
        """Unless strict, turn a refusal that does not affect kinematics into a warning with its consequence."""
        try:
            yield
        except InvalidUrdf as error:
            if self._strict:
                raise
            self._warnings.append(f"{error.detail}: {consequence}")

    def _warn_of_meshes(self, description: Description) -> None:
        if outside := tuple(mesh for mesh in description.meshes if _ELSEWHERE.search(mesh)):
            told = "outside the description's folder: not opened there; looked up only in an archive"
            self._warnings.append(f"{meshes_are(outside)} {told}")

    def _warn_of_massless(self, description: Description) -> None:
        moved = {joint.child for joint in description.joints if joint.type in MOVABLE}
        names = [link.name for link in description.links if link.name in moved and link.inertial is None]
        if names:
            self._warnings.append(
                f"no inertia for moving link {', '.join(quoted(name) for name in names[:8])}"
                + (f" and {len(names) - 8} more" if len(names) > 8 else "")
                + ": dynamics treats it as massless"
            )

    # Links

    def _link(self, element: Element) -> Link:
        name = self._name(element)
        where = f"link {quoted(name)}"
        self._check_known(element, where)
        inertial = None
        if (found := self._only(element, "inertial", where, is_felt=False)) is not None:
            with self._harmless("the inertial is ignored"):
                inertial = self._inertial(found, where)
        shapes = [child for child in element.children if child.tag in {"visual", "collision"}]
        self._shape_count += len(shapes)
        if self._shape_count > MAX_SHAPES:
            raise InvalidUrdf(f"more than {MAX_SHAPES} geometries", where, element.line)
        drawn = []
        for shape in shapes:
            with self._harmless("it is not drawn"):
                drawn.append(self._shape(shape, where))
        return Link(name, inertial, tuple(drawn))

    def _inertial(self, element: Element, where: str) -> Inertial | None:
        self._check_known(element, where)
        mass_element, inertia_element = self._only(element, "mass", where), self._only(element, "inertia", where)
        if mass_element is None or inertia_element is None:
            missing = "mass" if mass_element is None else "inertia"
            self._warnings.append(f"line {element.line}: {where}: inertial without {missing} is ignored")
            return None
        mass = _number(mass_element, "value", where, most=MAX_BOUND)
        if mass < 0:
            raise InvalidUrdf(f"mass {mass:g} is negative", where, mass_element.line)
        ixx, ixy, ixz, iyy, iyz, izz = (
            _number(inertia_element, key, where, most=MAX_BOUND) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        self._warn_of_inertia(mass, (ixx, ixy, ixz, iyy, iyz, izz), where, element.line)
        return Inertial(self._origin(element, where), mass, (ixx, ixy, ixz, iyy, iyz, izz))

    def _warn_of_inertia(self, mass: float, inertia: tuple[float, ...], where: str, line: int) -> None:
        ixx, ixy, ixz, iyy, iyz, izz = inertia
        slack = 1e-9 * max(abs(value) for value in inertia)
        minors = (
            ixx,
            ixx * iyy - ixy * ixy,
            ixx * iyy * izz + 2 * ixy * iyz * ixz - ixx * iyz**2 - iyy * ixz**2 - izz * ixy**2,
        )
        if mass == 0.0 and any(inertia):
            self._warnings.append(f"line {line}: {where}: inertia without mass")
        elif any(minor < -slack for minor in minors):
            self._warnings.append(f"line {line}: {where}: inertia is not positive definite, which no real body has")
        elif 2 * max(ixx, iyy, izz) > ixx + iyy + izz + slack:
            self._warnings.append(f"line {line}: {where}: inertia violates the triangle inequality of a real body")

    def _shape(self, element: Element, where: str) -> Shape:
        shape = self._geometry(element, where)
        role: Literal["visual", "collision"] = "visual" if element.tag == "visual" else "collision"
        self._check_known(element, where)
        origin = self._origin(element, where)
        if shape.tag == "mesh":
            filename = shape.attributes.get("filename", "")
            if not filename or not filename.isprintable():
                raise InvalidUrdf("mesh must have a filename of printable characters", where, shape.line)
            return Shape(role, origin, "mesh", self._scale(shape, where), filename)
        if shape.tag not in _SHAPE_SIZES:
            raise InvalidUrdf(
                f"geometry {quoted(shape.tag)} is not known: box, cylinder, capsule, sphere or mesh",
                where,
                shape.line,
            )
        keys = _SHAPE_SIZES[shape.tag]
        count = 3 if shape.tag == "box" else 1
        size = tuple(value for key in keys for value in _numbers(shape, key, count, where))
        if min(size) < 0:
            raise InvalidUrdf(f"{shape.tag} has a negative {' or '.join(keys)}", where, shape.line)
        return Shape(role, origin, shape.tag, size)  # type: ignore[arg-type]

    def _geometry(self, element: Element, where: str) -> Element:
        """Return the element of a shape: the only one in its geometry, or else the first one of a known kind."""
        geometry = self._only(element, "geometry", where, is_felt=False)
        found = [] if geometry is None else geometry.children
        if len(found) == 1:
            return found[0]
        error = InvalidUrdf(f"{element.tag} must have one geometry with one shape", where, element.line)
        shapes = [shape for shape in found if shape.tag == "mesh" or shape.tag in _SHAPE_SIZES]
        if not shapes:
            raise error
        with self._harmless(f"of its {len(found)} elements only the first, {quoted(shapes[0].tag)}, is used"):
            raise error
        return shapes[0]

    def _scale(self, mesh: Element, where: str) -> Triple:
        words = mesh.attributes.get("scale", "1 1 1").split()
        if len(words) > 3:
            with self._harmless("the first three count"):
                _triple(mesh, "scale", where)
        return _triple(Element("mesh", {"scale": " ".join(words[:3])}, mesh.line), "scale", where)

    # Joints

    def _joint(self, element: Element) -> Joint:
        name = self._name(element)
        where = f"joint {quoted(name)}"
        self._check_known(element, where)
        type_ = element.attributes.get("type")
        if type_ not in _JOINT_TYPES:
            given = "no type" if type_ is None else f"unknown type {quoted(type_)}"
            raise InvalidUrdf(f"{given}; allowed: {', '.join(_JOINT_TYPES)}", where, element.line)
        if type_ in {"floating", "planar"}:
            self._warnings.append(f"line {element.line}: {where}: no chain may lead across a {type_} joint")
        ends = self._end(element, "parent", where), self._end(element, "child", where)
        joint = Joint(name, cast(JointType, type_), *ends, self._origin(element, where))
        with self._harmless("a fixed joint does not move") if type_ == "fixed" else nullcontext():
            axis, limits = self._axis(element, type_, where), self._limits(element, type_, where)
            return replace(joint, axis=axis, limits=limits, mimic=self._mimic(element, type_, where))
        return joint

    def _end(self, element: Element, tag: str, where: str) -> str:
        end = self._only(element, tag, where)
        if end is None or not end.attributes.get("link"):
            raise InvalidUrdf(f"must have a {tag} with a link", where, element.line)
        return end.attributes["link"]

    def _axis(self, element: Element, type_: str, where: str) -> Triple:
        axis = self._only(element, "axis", where)
        if type_ in {"fixed", "floating"}:
            return (1.0, 0.0, 0.0)
        if axis is None:
            self._warnings.append(f"line {element.line}: {where}: no axis given, so it is 1 0 0")
            return (1.0, 0.0, 0.0)
        self._check_known(axis, where)
        x, y, z = _numbers(axis, "xyz", 3, where)
        length = math.hypot(x, y, z)
        if length < 1e-9:
            raise InvalidUrdf("the axis is zero: it must have a direction", where, axis.line)
        if abs(length - 1.0) <= 1e-15:
            return (x, y, z)
        if abs(length - 1.0) > 1e-6:
            self._warnings.append(f"line {axis.line}: {where}: axis of length {length:.6g} is taken as a direction")
        return (x / length, y / length, z / length)

    def _limits(self, element: Element, type_: str, where: str) -> UrdfLimits:
        limit = self._only(element, "limit", where)
        bounded = type_ in {"revolute", "prismatic"}
        if limit is None:
            if bounded:
                raise InvalidUrdf(f"a {type_} joint must have a limit", where, element.line)
            return UrdfLimits()
        self._check_known(limit, where)
        lower, upper = self._positions(limit, type_, where)
        velocity, effort = (self._bound(limit, key, type_, where) for key in ("velocity", "effort"))
        return UrdfLimits(lower, upper, velocity, effort) if type_ in MOVABLE else UrdfLimits()

    def _positions(self, limit: Element, type_: str, where: str) -> tuple[float | None, float | None]:
        given = {
            key: _number(limit, key, where, most=MAX_BOUND) for key in ("lower", "upper") if key in limit.attributes
        }
        if type_ not in {"revolute", "prismatic"}:
            if type_ != "fixed" and any(given.values()):
                self._warnings.append(f"line {limit.line}: {where}: the position limits of a {type_} joint are ignored")
            return None, None
        for key in ("lower", "upper"):
            if key not in given:
                self._warnings.append(f"line {limit.line}: {where}: limit without {key}, which is 0 by URDF's rule")
        lower, upper = given.get("lower", 0.0), given.get("upper", 0.0)
        if lower > upper:
            raise InvalidUrdf(f"limit: lower {lower:g} is greater than upper {upper:g}", where, limit.line)
        return lower, upper

    def _bound(self, limit: Element, key: str, type_: str, where: str) -> float | None:
        if key not in limit.attributes:
            if type_ in MOVABLE:
                self._warnings.append(f"line {limit.line}: {where}: limit without {key}")
            return None
        value = _number(limit, key, where, most=MAX_BOUND)
        if value < 0:
            raise InvalidUrdf(f"limit: {key} {value:g} is negative", where, limit.line)
        if value == 0 and type_ in MOVABLE:
            self._warnings.append(f"line {limit.line}: {where}: limit of zero {key} is taken as not given")
        return value if 0.0 < value < UNLIMITED else None

    def _mimic(self, element: Element, type_: str, where: str) -> Mimic | None:
        mimic = self._only(element, "mimic", where)
        if mimic is None:
            return None
        if type_ not in MOVABLE:
            if type_ != "fixed":
                raise InvalidUrdf(f"a {type_} joint cannot mimic another", where, mimic.line)
            self._warnings.append(f"line {mimic.line}: {where}: the mimic of a fixed joint is ignored")
            return None
        self._check_known(mimic, where)
        leader = mimic.attributes.get("joint")
        if not leader:
            raise InvalidUrdf("mimic must name a joint", where, mimic.line)
        return Mimic(
            leader,
            _number(mimic, "multiplier", where) if "multiplier" in mimic.attributes else 1.0,
            _number(mimic, "offset", where) if "offset" in mimic.attributes else 0.0,
        )

    # Shared by links and joints

    def _only(self, element: Element, tag: str, where: str, is_felt: bool = True) -> Element | None:
        """Return the child with a tag; of several, the first if they are equal or kinematics does not depend on it."""
        found = [child for child in element.children if child.tag == tag]
        if len(found) > 1:
            error = InvalidUrdf(f"{len(found)} elements {quoted(tag)} where one is allowed", where, found[1].line)
            if is_felt and any(child != found[0] for child in found):
                raise error
            with self._harmless("the first counts"):
                raise error
        return found[0] if found else None

    def _name(self, element: Element) -> str:
        name = element.attributes.get("name", "")
        if not name.strip():
            raise InvalidUrdf(f"{element.tag} must have a name", None, element.line)
        if len(name) > MAX_NAME_LENGTH:
            raise InvalidUrdf(
                f"the name has {len(name)} characters; at most {MAX_NAME_LENGTH} are allowed",
                f"{element.tag} {quoted(name)}",
                element.line,
            )
        if not name.isprintable():
            raise InvalidUrdf(
                "control or invisible characters in the name", f"{element.tag} {quoted(name)}", element.line
            )
        self._lines[f"{element.tag} {name}"] = element.line
        return name

    def _origin(self, element: Element, where: str) -> Origin:
        origin = self._only(element, "origin", where)
        if origin is None:
            return Origin()
        self._check_known(origin, where)
        return Origin(
            _triple(origin, "xyz", where) if "xyz" in origin.attributes else (0.0, 0.0, 0.0),
            _triple(origin, "rpy", where) if "rpy" in origin.attributes else (0.0, 0.0, 0.0),
        )

    def _check_known(self, element: Element, where: str | None) -> None:
        """Warn of attributes and elements that are not part of URDF, often misspelt, and refuse xacro elements."""
        inside = f"{where}: " if where else ""
        for key in element.attributes:
            if key not in _KNOWN_ATTRIBUTES[element.tag] and ":" not in key:
                what = f"unknown attribute {quoted(key)} of {element.tag}"
                self._warnings.append(f"line {element.line}: {inside}{what} is ignored")
        for child in element.children:
            if child.tag.startswith("xacro:"):
                raise InvalidUrdf(
                    "xacro must be expanded before the upload", f"element {quoted(child.tag)}", child.line
                )
            if child.tag not in _KNOWN_ELEMENTS.get(element.tag, ()):
                self._warnings.append(f"line {child.line}: {inside}unknown element {quoted(child.tag)} is ignored")


def _number(element: Element, key: str, where: str, most: float = MAX_MAGNITUDE) -> float:
    return _numbers(element, key, 1, where, most)[0]


def _triple(element: Element, key: str, where: str) -> Triple:
    x, y, z = _numbers(element, key, 3, where)
    return x, y, z


def _numbers(element: Element, key: str, count: int, where: str, most: float = MAX_MAGNITUDE) -> tuple[float, ...]:
    """Parse an attribute as exactly `count` finite numbers, none of greater magnitude than `most`."""
    text = element.attributes.get(key)
    what = f"{element.tag} {key}"
    if text is None:
        raise InvalidUrdf(f"{element.tag} must have the attribute {quoted(key)}", where, element.line)
    words = text.split()
    if len(words) != count or not all(_NUMBER.fullmatch(word) for word in words):
        raise InvalidUrdf(
            f"{what} is {quoted(text)} but must be {count} finite number{'s' * (count > 1)}",
            where,
            element.line,
        )
    values = tuple(float(word) for word in words)
    if not all(abs(value) <= most for value in values):
        raise InvalidUrdf(f"{what} has a magnitude beyond {most:g}", where, element.line)
    return values


# Writing


def write_urdf(description: Description) -> str:
    """Write a description as XML with up to 17 significant digits; reading it gives the same description."""
    lines = ['<?xml version="1.0" encoding="utf-8"?>', f"<robot name={quoteattr(description.name)}>"]
    for link in description.links:
        lines += _element("link", {"name": link.name}, _link_body(link), indent=1)
    for joint in description.joints:
        lines += _element("joint", {"name": joint.name, "type": joint.type}, _joint_body(joint), indent=1)
    return "\n".join([*lines, "</robot>", ""])


def _element(tag: str, attributes: dict[str, str], body: Sequence[str] = (), indent: int = 0) -> list[str]:
    """Return the lines of a tag with its attributes around the lines of its body."""
    space = "  " * indent
    start = f"{space}<{tag}" + "".join(f" {key}={quoteattr(value)}" for key, value in attributes.items())
    if not body:
        return [start + "/>"]
    return [start + ">", *(space + "  " + line for line in body), f"{space}</{tag}>"]


def _text(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _origin_element(origin: Origin) -> list[str]:
    return [] if origin == Origin() else _element("origin", {"xyz": _text(origin.xyz), "rpy": _text(origin.rpy)})


def _link_body(link: Link) -> list[str]:
    lines: list[str] = []
    if link.inertial is not None:
        keys = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        inertia = {key: repr(value) for key, value in zip(keys, link.inertial.inertia, strict=True)}
        body = _element("mass", {"value": repr(link.inertial.mass)}) + _element("inertia", inertia)
        lines += _element("inertial", {}, _origin_element(link.inertial.origin) + body)
    for shape in link.shapes:
        lines += _element(
            shape.role, {}, _origin_element(shape.origin) + _element("geometry", {}, _shape_element(shape))
        )
    return lines


def _shape_element(shape: Shape) -> list[str]:
    if shape.mesh is not None:
        return _element("mesh", {"filename": shape.mesh, "scale": _text(shape.size)})
    if shape.kind == "box":
        return _element("box", {"size": _text(shape.size)})
    keys = _SHAPE_SIZES[shape.kind]
    return _element(shape.kind, {key: repr(value) for key, value in zip(keys, shape.size, strict=True)})


def _joint_body(joint: Joint) -> list[str]:
    lines = _origin_element(joint.origin)
    lines += _element("parent", {"link": joint.parent}) + _element("child", {"link": joint.child})
    if joint.type not in {"fixed", "floating"}:
        lines += _element("axis", {"xyz": _text(joint.axis)})
    limits = joint.limits
    if joint.type in MOVABLE and limits != UrdfLimits():
        # Other readers refuse a limit without velocity and effort, and do not move a joint whose limit is zero.
        given = {"velocity": limits.velocity or UNLIMITED, "effort": limits.effort or UNLIMITED}
        if limits.lower is not None and limits.upper is not None:
            given = {"lower": limits.lower, "upper": limits.upper, **given}
        lines += _element("limit", {key: repr(value) for key, value in given.items()})
    if joint.mimic is not None:
        mimic = {
            "joint": joint.mimic.joint,
            "multiplier": repr(joint.mimic.multiplier),
            "offset": repr(joint.mimic.offset),
        }
        lines += _element("mimic", mimic)
    return lines
