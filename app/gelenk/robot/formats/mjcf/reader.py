"""Reads the kinematic part of MJCF: bodies, joints, frames, sites, shapes, inertias, and equalities of joints.

Every body is a link of its name, and every site one that is fixed to it. What the format has and a robot here has not,
such as tendons and actuators, is a warning with its line.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gelenk.errors import InvalidUrdf, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.description import MOVABLE, Description, Inertial, Joint, JointType, Link, UrdfLimits
from gelenk.robot.formats.mjcf.equalities import mimicking
from gelenk.robot.formats.mjcf.masses import Masses, bounded, scaled, together
from gelenk.robot.formats.mjcf.model import read_model
from gelenk.robot.formats.mjcf.scope import Model, ModelScope, below, placed
from gelenk.robot.formats.mjcf.solids import MassBody
from gelenk.robot.formats.mjcf.values import Compiler, form, inertial, numbers, placement, shapes, turn, unit, vector
from gelenk.robot.formats.sources import Fault, Sources
from gelenk.robot.notations import origin_of
from gelenk.robot.poses import transform
from gelenk.robot.tree import check_tree
from gelenk.robot.urdf import MAX_LINKS, MAX_SHAPES
from gelenk.robot.xml import Element

_WORLD = "world"
_TYPES: dict[str, JointType] = {"hinge": "revolute", "slide": "prismatic", "ball": "floating", "free": "floating"}
_UNSEEN = frozenset({"camera", "light", "joint", "freejoint", "inertial"})
_REACH = 1.0
"""Taken on both sides for a slide joint without a range, [m]: a prismatic joint must have one."""


def read_mjcf(root: Element, sources: Sources) -> Description:
    """Read a model as a robot; what is not read is in `warnings`.

    Raises:
        InvalidUrdf: It is no robot, or not read; the error names the file, the line and the reason.
    """
    model = read_model(root, sources)
    tree = _Tree(model)
    tree.read()
    joints = mimicking(model, tree.joints, tree.refs)
    name = root.attributes.get("model", "")
    links = _weighing(tuple(tree.links.values()), model.compiler.total_mass)
    description = Description(name, links, tuple(joints.values()))
    check_tree(description, tree.lines)
    return replace(description, warnings=tuple(model.upload.warnings))


def _weighing(links: tuple[Link, ...], total: float) -> tuple[Link, ...]:
    """Return links whose masses are scaled to a total, unchanged unless it is above zero."""
    mass = sum(link.inertial.mass for link in links if link.inertial)
    if total <= 0.0 or mass <= 0.0:
        return links
    return tuple(
        replace(link, inertial=scaled(link.inertial, total / mass)) if link.inertial else link for link in links
    )


_Part: TypeAlias = tuple[Element, ModelScope, Array]
"""An element of a body, its scope, and the pose of the frame it is in, in the body."""


class _Tree:
    """Links and joints of a model by name; `refs` are the positions of joints in which the bodies are drawn."""

    def __init__(self, model: Model) -> None:
        self.links: dict[str, Link] = {}
        self.joints: dict[str, Joint] = {}
        self.refs: dict[str, float] = {}
        self.lines: dict[str, int] = {}
        self._model, self._warn = model, model.upload.warn
        named = [(each.tag, each.attributes["name"]) for each in below(model.root) if "name" in each.attributes]
        self._taken = {
            "link": {_WORLD, *(name for tag, name in named if tag == "body")},
            "joint": {name for tag, name in named if tag in {"joint", "freejoint"}},
        }
        count = sum(each.tag in {"body", "site"} for each in below(model.root))
        self._has_sites = count < MAX_LINKS
        self._shape_count = 0
        self._masses = Masses(model.upload.sources, model.upload.file)

    def read(self) -> None:
        """Read all bodies, from the world, or from the only body if that floats in it; raises InvalidUrdf."""
        root = self._model.root
        sections = list(self._model.sections("worldbody"))
        moving = sum(each.tag in {"body", "joint", "freejoint"} for part in sections for each in below(part))
        if moving > 2 * MAX_LINKS:  # each makes a link or is one of its joints: building them all takes long
            reason = f"the model has {moving} bodies and joints; at most {2 * MAX_LINKS} are read"
            raise InvalidUrdf(reason, None, root.line, root.file or None)
        world = [part for section in sections for part in self._parts(section, ModelScope(self._model))]
        bodies = [part for part in world if part[0].tag == "body"]
        if not bodies:
            raise InvalidUrdf("the model has no body", None, root.line, root.file or None)
        first, scope, T = bodies[0]
        with placed(first):
            floats = len(bodies) == 1 and any(self._type(*part[:2]) == "free" for part in self._parts(first, scope))
            if floats:
                self._warn(first, "the only body floats in the world: it is the root, without its free joint")
                self._body(first, scope, T, None)
        if not floats:
            self.links[_WORLD] = Link(_WORLD)
            self._fill(_WORLD, world)
        if not self._has_sites:
            self._warn(root, f"with its sites the model has more than {MAX_LINKS} links: sites are not read")

    def _parts(self, element: Element, scope: ModelScope, T: Array | None = None) -> Iterator[_Part]:
        """Yield what is in a body, and in frames in it: element, its scope, and pose of the frame in the body."""
        T, scope = np.eye(4) if T is None else T, scope.inside(element)
        for child in element.children:
            if child.tag == "frame":
                with placed(child):
                    T_frame = T @ placement(scope.given(child), scope.model.compiler)
                yield from self._parts(child, scope, T_frame)
            else:
                yield child, scope, T

    def _type(self, element: Element, scope: ModelScope) -> str | None:
        """Return the type of a joint; None if the element is none."""
        if element.tag == "freejoint":
            return "free"
        return scope.given(element).get("type", "hinge") if element.tag == "joint" else None

    def _fresh(self, kind: str, wanted: str) -> str:
        """Return a name like this one that no other link, or joint, has."""
        name, count = wanted, 1
        while name in self._taken[kind]:
            count += 1
            name = f"{wanted}_{count}"
        self._taken[kind].add(name)
        return name

    def _add_link(self, element: Element, name: str) -> None:
        self.links[name] = Link(name)
        self.lines[f"link {name}"] = element.line

    def _add_joint(self, element: Element, joint: Joint) -> None:
        if joint.name in self.joints:
            raise Fault("a second joint of this name")
        self.joints[joint.name] = joint
        self.lines[f"joint {joint.name}"] = element.line

    def _body(self, element: Element, scope: ModelScope, T: Array, parent: str | None) -> None:
        """Read a body that is placed in a frame with pose T in link `parent`; of the root, in nothing."""
        T = T @ placement(element.attributes, scope.model.compiler)
        name = element.attributes.get("name") or self._fresh("link", "body")
        if name in self.links:
            raise Fault("a second body of this name")
        parts = list(self._parts(element, scope))
        joints = [part for part in parts if self._type(*part[:2])] if parent is not None else []
        for index, (joint, around, T_body_frame) in enumerate(joints):
            is_last = index == len(joints) - 1
            with placed(joint):
                parent, T = self._joint(joint, around, T_body_frame, T, str(parent), name, is_last)
        if name not in self.links:
            self._add_link(element, name)
            if parent is not None:
                fixed = self._fresh("joint", f"{name}_fixed")
                self._add_joint(element, Joint(fixed, "fixed", parent, name, origin_of(T)))
        self.links[name] = replace(self.links[name], inertial=self._inertial(parts, scope.model.compiler))
        self._fill(name, parts)

    def _joint(
        self, element: Element, scope: ModelScope, T_body_frame: Array, T: Array, parent: str, body: str, is_last: bool
    ) -> tuple[str, Array]:
        """Add a joint of a body that has pose T in `parent`; return the link it moves, and the body's pose in that."""
        given, compiler = scope.given(element), scope.model.compiler
        kind = self._type(element, scope) or ""
        if kind not in _TYPES:
            raise Fault(f"the joint's type is {quoted(kind)}: hinge, slide, ball or free")
        name = given.get("name") or self._fresh("joint", f"{body}_joint")
        axis = T_body_frame[:3, :3] @ unit(vector(given, "axis", (0.0, 0.0, 1.0)), "axis")
        at = T_body_frame[:3, :3] @ vector(given, "pos") + T_body_frame[:3, 3]
        (ref,) = numbers(given, "ref", 1) or [0.0]
        if kind == "hinge":
            ref = compiler.angle(ref)
            T_parent_joint = T @ transform(at, turn(axis, -ref))
        elif kind == "slide":
            at = np.zeros(3)
            T_parent_joint = T @ transform(-ref * axis, np.eye(3))
        else:
            T_parent_joint = T @ transform(at, np.eye(3))
            self._warn(element, f"a {kind} joint is read as a floating one: no chain may lead across it")
        self.refs[name] = ref
        is_at_body = not at.any()
        link = body if is_last and is_at_body else self._fresh("link", f"{body}_{name}")
        self._add_link(element, link)
        limits = self._limits(element, given, kind, compiler)
        type_ = "continuous" if kind == "hinge" and limits.lower is None else _TYPES[kind]
        direction = (float(axis[0]), float(axis[1]), float(axis[2])) if type_ in MOVABLE else (1.0, 0.0, 0.0)
        self._add_joint(element, Joint(name, type_, parent, link, origin_of(T_parent_joint), direction, limits))
        return link, transform(-at, np.eye(3))

    def _limits(self, element: Element, given: dict[str, str], kind: str, compiler: Compiler) -> UrdfLimits:
        if kind not in {"hinge", "slide"}:
            return UrdfLimits()
        found = numbers(given, "range", 2)
        limited = given.get("limited", "auto")
        is_limited = found is not None and (
            limited == "true" or (limited == "auto" and compiler.has_autolimits and found[0] < found[1])
        )
        force = numbers(given, "actuatorfrcrange", 2)
        effort = (max(map(abs, force)) or None) if force and given.get("actuatorfrclimited") != "false" else None
        if found is None or not is_limited:
            if kind == "hinge":
                return UrdfLimits(effort=effort)
            self._warn(element, f"a slide joint without a range: ±{_REACH:g} m is taken")
            return UrdfLimits(-_REACH, _REACH, effort=effort)
        lower, upper = (compiler.angle(value) if kind == "hinge" else value for value in found)
        if lower > upper:
            raise Fault(f"the range begins at {found[0]:g} and ends at {found[1]:g}")
        return UrdfLimits(lower, upper, effort=effort)

    def _fill(self, link: str, parts: list[_Part]) -> None:
        """Read shapes, sites and bodies in a link."""
        for element, scope, T in parts:
            with placed(element):
                self._part(link, element, scope, T)

    def _part(self, link: str, element: Element, scope: ModelScope, T: Array) -> None:
        match element.tag:
            case "body":
                self._body(element, scope, T, link)
            case "geom":
                self._geom(link, element, scope, T)
            case "site":
                self._site(link, element, scope, T)
            case tag if tag not in _UNSEEN:
                self._warn(element, f"{quoted(tag)} is not read")

    def _inertial(self, parts: list[_Part], compiler: Compiler) -> Inertial | None:
        """Return the mass of a body: what its `inertial` says, or what its geoms have together."""
        said, geoms = None, []
        for element, scope, T in parts:
            if element.tag == "inertial":
                with placed(element):
                    said = inertial(element.attributes, scope.model.compiler, T)
        if compiler.from_geoms == "true" or (compiler.from_geoms == "auto" and said is None):
            geoms = [part for part in parts if part[0].tag == "geom"]
        found = [body for part in geoms if (body := self._mass(*part)) is not None]
        return bounded(together(found) or said, compiler)

    def _mass(self, element: Element, scope: ModelScope, T: Array) -> MassBody | None:
        model = scope.model
        if self._masses.is_full:
            return None
        with placed(element):
            given = scope.given(element)
            try:
                return self._masses.of(given, form(given, model.compiler, model.meshes, T), model.compiler)
            except Fault as fault:
                self._warn(element, f"its mass is not counted: {fault}")
        return None

    def _geom(self, link: str, element: Element, scope: ModelScope, T: Array) -> None:
        if self._shape_count > MAX_SHAPES:
            return
        try:
            given = scope.given(element)
            found = shapes(given, form(given, scope.model.compiler, scope.model.meshes, T))
        except Fault as fault:
            self._warn(element, f"not drawn: {fault}")
            return
        self._shape_count += len(found)
        if self._shape_count <= MAX_SHAPES:
            self.links[link] = replace(self.links[link], shapes=(*self.links[link].shapes, *found))
        else:
            self._warn(element, f"more than {MAX_SHAPES} shapes: this one and those after it are not drawn")

    def _site(self, link: str, element: Element, scope: ModelScope, T: Array) -> None:
        if not self._has_sites or "fromto" in element.attributes:
            return
        name = self._fresh("link", element.attributes.get("name") or f"{link}_site")
        origin = origin_of(T @ placement(scope.given(element), scope.model.compiler))
        self._add_link(element, name)
        self._add_joint(element, Joint(self._fresh("joint", f"{name}_fixed"), "fixed", link, name, origin))
