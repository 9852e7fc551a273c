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
_INERTIA = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_SHAPE_SIZES = {
    "box": ("size",),
    "cylinder": ("radius", "length"),
    "capsule": ("radius", "length"),
    "sphere": ("radius",),
}


def read_urdf(text: str, strict: bool = False) -> Description:
    """Read and check a description with xacro already expanded; its oddities are in `warnings`.

    If `strict`, faults that do not affect kinematics are refused too, instead of only warned of.

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
    def __init__(self, strict: bool, warnings: list[str]) -> None:
        self._strict = strict
        self._warnings = warnings
        self._lines: dict[str, int] = {}
        self._shape_count = 0
        self._where: str | None = None

    def robot(self, root: Element) -> Description:
        links = [element for element in root.children if element.tag == "link"]
        joints = [element for element in root.children if element.tag == "joint"]
        if not links:
            raise self._error(root, without_links(root))
        self._check_known(root)
        if len(links) > MAX_LINKS:
            raise self._error(root, f"the robot has {len(links)} links; at most {MAX_LINKS} are allowed")
        name = root.attributes.get("name", "")
        description = Description(name, tuple(map(self._link, links)), tuple(map(self._joint, joints)))
        check_tree(description, self._lines)
        self._warn_of_meshes(description)
        self._warn_of_massless(description)
        return replace(description, warnings=tuple(self._warnings))

    def _error(self, element: Element, reason: str) -> InvalidUrdf:
        return InvalidUrdf(reason, self._where, element.line)

    def _warn(self, element: Element, oddity: str) -> None:
        self._warnings.append(f"line {element.line}: {f'{self._where}: ' if self._where else ''}{oddity}")

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
            consequence = "outside the description's folder: not opened there; looked up only in an archive"
            self._warnings.append(f"{meshes_are(outside)} {consequence}")

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
        self._check_known(element)
        inertial = None
        if (found := self._only(element, "inertial", is_felt=False)) is not None:
            with self._harmless("the inertial is ignored"):
                inertial = self._inertial(found)
        shapes = [child for child in element.children if child.tag in {"visual", "collision"}]
        self._shape_count += len(shapes)
        if self._shape_count > MAX_SHAPES:
            raise self._error(element, f"more than {MAX_SHAPES} geometries")
        drawn = []
        for shape in shapes:
            with self._harmless("it is not drawn"):
                drawn.append(self._shape(shape))
        return Link(name, inertial, tuple(drawn))

    def _inertial(self, element: Element) -> Inertial | None:
        self._check_known(element)
        mass_element, inertia_element = self._only(element, "mass"), self._only(element, "inertia")
        if mass_element is None or inertia_element is None:
            missing = "mass" if mass_element is None else "inertia"
            self._warn(element, f"inertial without {missing} is ignored")
            return None
        mass = self._number(mass_element, "value", most=MAX_BOUND)
        if mass < 0:
            raise self._error(mass_element, f"mass {mass:g} is negative")
        ixx, ixy, ixz, iyy, iyz, izz = (self._number(inertia_element, key, most=MAX_BOUND) for key in _INERTIA)
        self._warn_of_inertia(element, mass, (ixx, ixy, ixz, iyy, iyz, izz))
        return Inertial(self._origin(element), mass, (ixx, ixy, ixz, iyy, iyz, izz))

    def _warn_of_inertia(self, element: Element, mass: float, inertia: tuple[float, ...]) -> None:
        ixx, ixy, ixz, iyy, iyz, izz = inertia
        slack = 1e-9 * max(abs(value) for value in inertia)
        minors = (
            ixx,
            ixx * iyy - ixy * ixy,
            ixx * iyy * izz + 2 * ixy * iyz * ixz - ixx * iyz**2 - iyy * ixz**2 - izz * ixy**2,
        )
        if mass == 0.0 and any(inertia):
            self._warn(element, "inertia without mass")
        elif any(minor < -slack for minor in minors):
            self._warn(element, "inertia is not positive definite, which no real body has")
        elif 2 * max(ixx, iyy, izz) > ixx + iyy + izz + slack:
            self._warn(element, "inertia violates the triangle inequality of a real body")

    def _shape(self, element: Element) -> Shape:
        shape = self._geometry(element)
        role: Literal["visual", "collision"] = "visual" if element.tag == "visual" else "collision"
        self._check_known(element)
        origin = self._origin(element)
        if shape.tag == "mesh":
            filename = shape.attributes.get("filename", "")
            if not filename or not filename.isprintable():
                raise self._error(shape, "mesh must have a filename of printable characters")
            return Shape(role, origin, "mesh", self._scale(shape), filename)
        if shape.tag not in _SHAPE_SIZES:
            kinds = "box, cylinder, capsule, sphere or mesh"
            raise self._error(shape, f"geometry {quoted(shape.tag)} is not known: {kinds}")
        keys = _SHAPE_SIZES[shape.tag]
        size = tuple(value for key in keys for value in self._numbers(shape, key, 3 if shape.tag == "box" else 1))
        if min(size) < 0:
            raise self._error(shape, f"{shape.tag} has a negative {' or '.join(keys)}")
        return Shape(role, origin, shape.tag, size)  # type: ignore[arg-type]

    def _geometry(self, element: Element) -> Element:
        """Return the element of a shape: the only one in its geometry, or else the first one of a known kind."""
        geometry = self._only(element, "geometry", is_felt=False)
        found = [] if geometry is None else geometry.children
        if len(found) == 1:
            return found[0]
        error = self._error(element, f"{element.tag} must have one geometry with one shape")
        shapes = [shape for shape in found if shape.tag == "mesh" or shape.tag in _SHAPE_SIZES]
        if not shapes:
            raise error
        with self._harmless(f"of its {len(found)} elements only the first, {quoted(shapes[0].tag)}, is used"):
            raise error
        return shapes[0]

    def _scale(self, mesh: Element) -> Triple:
        words = mesh.attributes.get("scale", "1 1 1").split()
        if len(words) > 3:
            with self._harmless("the first three count"):
                self._triple(mesh, "scale")
        return self._triple(Element("mesh", {"scale": " ".join(words[:3])}, mesh.line), "scale")

    # Joints

    def _joint(self, element: Element) -> Joint:
        name = self._name(element)
        self._check_known(element)
        type_ = element.attributes.get("type")
        if type_ not in _JOINT_TYPES:
            given = "no type" if type_ is None else f"unknown type {quoted(type_)}"
            raise self._error(element, f"{given}; allowed: {', '.join(_JOINT_TYPES)}")
        if type_ in {"floating", "planar"}:
            self._warn(element, f"no chain may lead across a {type_} joint")
        ends = self._end(element, "parent"), self._end(element, "child")
        joint = Joint(name, cast(JointType, type_), *ends, self._origin(element))
        with self._harmless("a fixed joint does not move") if type_ == "fixed" else nullcontext():
            axis, limits = self._axis(element, type_), self._limits(element, type_)
            return replace(joint, axis=axis, limits=limits, mimic=self._mimic(element, type_))
        return joint

    def _end(self, element: Element, tag: str) -> str:
        end = self._only(element, tag)
        if end is None or not end.attributes.get("link"):
            raise self._error(element, f"must have a {tag} with a link")
        return end.attributes["link"]

    def _axis(self, element: Element, type_: str) -> Triple:
        axis = self._only(element, "axis")
        if type_ in {"fixed", "floating"}:
            return (1.0, 0.0, 0.0)
        if axis is None:
            self._warn(element, "no axis given, so it is 1 0 0")
            return (1.0, 0.0, 0.0)
        self._check_known(axis)
        x, y, z = self._triple(axis, "xyz")
        length = math.hypot(x, y, z)
        if length < 1e-9:
            raise self._error(axis, "the axis is zero: it must have a direction")
        if abs(length - 1.0) <= 1e-15:
            return (x, y, z)
        if abs(length - 1.0) > 1e-6:
            self._warn(axis, f"axis of length {length:.6g} is taken as a direction")
        return (x / length, y / length, z / length)

    def _limits(self, element: Element, type_: str) -> UrdfLimits:
        limit = self._only(element, "limit")
        if limit is None:
            if type_ in {"revolute", "prismatic"}:
                raise self._error(element, f"a {type_} joint must have a limit")
            return UrdfLimits()
        self._check_known(limit)
        positions = self._positions(limit, type_)
        bounds = [self._bound(limit, key, type_) for key in ("velocity", "effort")]
        return UrdfLimits(*positions, *bounds) if type_ in MOVABLE else UrdfLimits()

    def _positions(self, limit: Element, type_: str) -> tuple[float | None, float | None]:
        keys = ("lower", "upper")
        given = {key: self._number(limit, key, most=MAX_BOUND) for key in keys if key in limit.attributes}
        if type_ not in {"revolute", "prismatic"}:
            if type_ != "fixed" and any(given.values()):
                self._warn(limit, f"the position limits of a {type_} joint are ignored")
            return None, None
        for key in keys:
            if key not in given:
                self._warn(limit, f"limit without {key}, which is 0 by URDF's rule")
        lower, upper = given.get("lower", 0.0), given.get("upper", 0.0)
        if lower > upper:
            raise self._error(limit, f"limit: lower {lower:g} is greater than upper {upper:g}")
        return lower, upper

    def _bound(self, limit: Element, key: str, type_: str) -> float | None:
        if key not in limit.attributes:
            if type_ in MOVABLE:
                self._warn(limit, f"limit without {key}")
            return None
        value = self._number(limit, key, most=MAX_BOUND)
        if value < 0:
            raise self._error(limit, f"limit: {key} {value:g} is negative")
        if value == 0 and type_ in MOVABLE:
            self._warn(limit, f"limit of zero {key} is taken as not given")
        return value if 0.0 < value < UNLIMITED else None

    def _mimic(self, element: Element, type_: str) -> Mimic | None:
        mimic = self._only(element, "mimic")
        if mimic is None:
            return None
        if type_ not in MOVABLE:
            if type_ != "fixed":
                raise self._error(mimic, f"a {type_} joint cannot mimic another")
            self._warn(mimic, "the mimic of a fixed joint is ignored")
            return None
        self._check_known(mimic)
        leader = mimic.attributes.get("joint")
        if not leader:
            raise self._error(mimic, "mimic must name a joint")
        numbers = {key: self._number(mimic, key) for key in ("multiplier", "offset") if key in mimic.attributes}
        return Mimic(leader, **numbers)

    # Shared by links and joints

    def _only(self, element: Element, tag: str, is_felt: bool = True) -> Element | None:
        """Return the child with a tag; of several, the first if they are equal or kinematics does not depend on it."""
        found = [child for child in element.children if child.tag == tag]
        if len(found) > 1:
            error = self._error(found[1], f"{len(found)} elements {quoted(tag)} where one is allowed")
            if is_felt and any(child != found[0] for child in found):
                raise error
            with self._harmless("the first counts"):
                raise error
        return found[0] if found else None

    def _name(self, element: Element) -> str:
        """Return the name of a link or joint, where later messages are about."""
        self._where, name = None, element.attributes.get("name", "")
        if not name.strip():
            raise self._error(element, f"{element.tag} must have a name")
        self._where = f"{element.tag} {quoted(name)}"
        if len(name) > MAX_NAME_LENGTH:
            raise self._error(element, f"the name has {len(name)} characters; at most {MAX_NAME_LENGTH} are allowed")
        if not name.isprintable():
            raise self._error(element, "control or invisible characters in the name")
        self._lines[f"{element.tag} {name}"] = element.line
        return name

    def _origin(self, element: Element) -> Origin:
        origin = self._only(element, "origin")
        if origin is None:
            return Origin()
        self._check_known(origin)
        return Origin(**{key: self._triple(origin, key) for key in ("xyz", "rpy") if key in origin.attributes})

    def _check_known(self, element: Element) -> None:
        """Warn of attributes and elements that are not part of URDF, often misspelt, and refuse xacro elements."""
        for key in element.attributes:
            if key not in _KNOWN_ATTRIBUTES[element.tag] and ":" not in key:
                self._warn(element, f"unknown attribute {quoted(key)} of {element.tag} is ignored")
        for child in element.children:
            if child.tag.startswith("xacro:"):
                reason = "xacro must be expanded before the upload"
                raise InvalidUrdf(reason, f"element {quoted(child.tag)}", child.line)
            if child.tag not in _KNOWN_ELEMENTS.get(element.tag, ()):
                self._warn(child, f"unknown element {quoted(child.tag)} is ignored")

    def _number(self, element: Element, key: str, most: float = MAX_MAGNITUDE) -> float:
        return self._numbers(element, key, 1, most)[0]

    def _triple(self, element: Element, key: str) -> Triple:
        x, y, z = self._numbers(element, key, 3)
        return x, y, z

    def _numbers(self, element: Element, key: str, count: int, most: float = MAX_MAGNITUDE) -> tuple[float, ...]:
        """Parse an attribute as exactly `count` finite numbers, none of greater magnitude than `most`."""
        text, what = element.attributes.get(key), f"{element.tag} {key}"
        if text is None:
            raise self._error(element, f"{element.tag} must have the attribute {quoted(key)}")
        words = text.split()
        if len(words) != count or not all(_NUMBER.fullmatch(word) for word in words):
            allowed = f"{count} finite number{'s' * (count > 1)}"
            raise self._error(element, f"{what} is {quoted(text)} but must be {allowed}")
        values = tuple(float(word) for word in words)
        if not all(abs(value) <= most for value in values):
            raise self._error(element, f"{what} has a magnitude beyond {most:g}")
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
        inertia = {key: repr(value) for key, value in zip(_INERTIA, link.inertial.inertia, strict=True)}
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
        numbers = {key: repr(getattr(joint.mimic, key)) for key in ("multiplier", "offset")}
        lines += _element("mimic", {"joint": joint.mimic.joint, **numbers})
    return lines
