"""Values of MJCF elements: numbers, orientations in all their forms, and shapes."""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from gelenk.errors import counted, quoted
from gelenk.robot.arrays import Array
from gelenk.robot.description import Inertial, Shape
from gelenk.robot.formats.sources import Fault
from gelenk.robot.notations import origin_of
from gelenk.robot.poses import transform
from gelenk.robot.urdf import MAX_MAGNITUDE

ORIENTATIONS = ("quat", "axisangle", "euler", "xyaxes", "zaxis")
_SHORTEST = 1e-9
"""Least length of a vector that has a direction."""


@dataclass(slots=True)
class Compiler:
    """How the numbers of a model are meant, as its `compiler` says.

    Attributes:
        from_geoms: Whether bodies have the masses of their geoms: "true", "false", or "auto", those without `inertial`.
        inertia_groups: First and last group of the geoms that count.
        is_exact: Whether meshes that do not say it themselves have the mass of the space within them.
        least_mass: Of each body, [kg]; `least_inertia` is that of its principal inertias, [kg m²].
        balances: Whether inertias that no body can have are replaced.
        total_mass: To which all masses are scaled if it is above zero, [kg].
    """

    is_degree: bool = True
    eulerseq: str = "xyz"
    has_autolimits: bool = True
    meshdir: str = ""
    strips_path: bool = False
    from_geoms: str = "auto"
    inertia_groups: tuple[float, float] = (0.0, 5.0)
    is_exact: bool = False
    least_mass: float = 0.0
    least_inertia: float = 0.0
    balances: bool = False
    total_mass: float = -1.0

    def read(self, given: Mapping[str, str]) -> None:
        """Take over what a `compiler` element says; raises Fault for what cannot be read."""
        if given.get("coordinate", "local") != "local":
            raise Fault("coordinate='global' is of old versions: save the model with local coordinates")
        self.is_degree = given.get("angle", "degree" if self.is_degree else "radian") != "radian"
        self.eulerseq = given.get("eulerseq", self.eulerseq)
        if not re.fullmatch(r"[xyzXYZ]{3}", self.eulerseq):
            raise Fault(f"eulerseq is {quoted(self.eulerseq)} but must be three letters of xyzXYZ")
        self.has_autolimits = given.get("autolimits", str(self.has_autolimits).lower()) == "true"
        self.meshdir = given.get("meshdir", given.get("assetdir", self.meshdir))
        self.strips_path = given.get("strippath", str(self.strips_path).lower()) == "true"
        self.from_geoms = given.get("inertiafromgeom", self.from_geoms)
        if self.from_geoms not in {"auto", "false", "true"}:
            raise Fault(f"inertiafromgeom is {quoted(self.from_geoms)} but must be auto, false or true")
        if (found := numbers(given, "inertiagrouprange", 2)) is not None:
            self.inertia_groups = found[0], found[1]
        self.is_exact = given.get("exactmeshinertia", str(self.is_exact).lower()) == "true"
        self.balances = given.get("balanceinertia", str(self.balances).lower()) == "true"
        (self.least_mass,) = numbers(given, "boundmass", 1) or [self.least_mass]
        (self.least_inertia,) = numbers(given, "boundinertia", 1) or [self.least_inertia]
        (self.total_mass,) = numbers(given, "settotalmass", 1) or [self.total_mass]

    def angle(self, value: float) -> float:
        """Return an angle as the model writes it in radians."""
        return math.radians(value) if self.is_degree else value


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """A mesh of the assets: its file, scale, and T_file_mesh, the frame in which geoms place it.

    Its mass is, by `inertia`, that of the space within it, "exact" or as the "legacy" way counts it, of its "convex"
    hull, or of its surface, a "shell".
    """

    file: str
    scale: tuple[float, float, float]
    T_file_mesh: Array = field(default_factory=lambda: np.eye(4))
    inertia: str = "legacy"


@dataclass(frozen=True, slots=True)
class Form:
    """What a geom is: kind, half lengths as MJCF has them, pose in its link, and the mesh if it is one."""

    kind: str
    size: tuple[float, ...]
    T: Array
    mesh: Mesh | None = None


def numbers(given: Mapping[str, str], key: str, least: int, most: int | None = None) -> list[float] | None:
    """Return the numbers of an attribute, None without it; raises Fault unless there are so many, all finite."""
    if key not in given:
        return None
    words, most = given[key].split(), most or least
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if not least <= len(values) <= most or not all(abs(value) <= MAX_MAGNITUDE for value in values):
        wanted = counted(least, "number") if least == most else f"from {least} to {counted(most, 'number')}"
        raise Fault(f"{key} is {quoted(given[key])} but must be {wanted} up to {MAX_MAGNITUDE:g}")
    return values


def vector(given: Mapping[str, str], key: str, default: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Array:
    """Return an attribute of three numbers; raises Fault."""
    return np.array(numbers(given, key, 3) or default)


def unit(values: Array, what: str) -> Array:
    """Return a vector of length 1; raises Fault if it has no direction."""
    length = float(np.linalg.norm(values))
    if length < _SHORTEST:
        raise Fault(f"{what} is zero: it must have a direction")
    scaled: Array = values / length
    return scaled


def turn(axis: Array, angle: float) -> Array:
    """Return the rotation about a unit axis by an angle, [rad]; shape (3, 3)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    R: Array = np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * cross @ cross
    return R


def rotation(given: Mapping[str, str], compiler: Compiler) -> Array:
    """Return the orientation that an element gives in one of five forms; shape (3, 3). Raises Fault."""
    if len(named := [key for key in ORIENTATIONS if key in given]) > 1:
        raise Fault(f"{' and '.join(named)} both say the orientation")
    if (found := numbers(given, "quat", 4)) is not None:
        w, *xyz = unit(np.array(found), "quat")
        length = float(np.linalg.norm(xyz))
        return turn(np.array(xyz) / length, 2.0 * math.atan2(length, w)) if length else np.eye(3)
    if (found := numbers(given, "axisangle", 4)) is not None:
        return turn(unit(np.array(found[:3]), "axisangle"), compiler.angle(found[3]))
    if (found := numbers(given, "euler", 3)) is not None:
        return from_euler(np.array(found), compiler)
    if (found := numbers(given, "xyaxes", 6)) is not None:
        x = unit(np.array(found[:3]), "xyaxes")
        y = unit(np.array(found[3:]) - x * (x @ np.array(found[3:])), "xyaxes")
        return np.column_stack((x, y, np.cross(x, y)))
    if (found := numbers(given, "zaxis", 3)) is not None:
        return towards(np.array(found))
    return np.eye(3)


def from_euler(angles: Array, compiler: Compiler) -> Array:
    """Return the rotation by three angles as the model writes them, in its sequence; shape (3, 3)."""
    R: Array = np.eye(3)
    for letter, angle in zip(compiler.eulerseq, angles, strict=True):
        step = turn(np.eye(3)["xyz".index(letter.lower())], compiler.angle(float(angle)))
        R = R @ step if letter.islower() else step @ R
    return R


def towards(z: Array) -> Array:
    """Return the least rotation that turns the z axis into a direction; shape (3, 3). Raises Fault."""
    z = unit(z, "zaxis")
    axis = np.cross([0.0, 0.0, 1.0], z)
    sine = float(np.linalg.norm(axis))
    return turn(axis / sine if sine > 1e-12 else np.array([1.0, 0.0, 0.0]), math.atan2(sine, float(z[2])))


def placement(given: Mapping[str, str], compiler: Compiler) -> Array:
    """Return the pose of an element in the one around it; shape (4, 4). Raises Fault."""
    return transform(vector(given, "pos"), rotation(given, compiler))


def inertial(given: Mapping[str, str], compiler: Compiler, T_link_body: Array) -> Inertial:
    """Return what an `inertial` says; raises Fault."""
    mass = numbers(given, "mass", 1)
    diagonal, full = numbers(given, "diaginertia", 3), numbers(given, "fullinertia", 6)
    if mass is None or mass[0] < 0.0:
        raise Fault("the inertial has no mass of zero or more")
    xx, yy, zz, xy, xz, yz = full or (*(diagonal or (0.0, 0.0, 0.0)), 0.0, 0.0, 0.0)
    return Inertial(origin_of(T_link_body @ placement(given, compiler)), mass[0], (xx, xy, xz, yy, yz, zz))


def roles(given: Mapping[str, str]) -> list[str]:
    """Return what a geom is for: `visual` if it touches nothing, `collision` in a group that is hidden, else both."""
    if given.get("contype") == given.get("conaffinity") == "0":
        return ["visual"]
    group = (numbers(given, "group", 1) or [0.0])[0]
    return ["collision"] if group >= 3 else ["visual", "collision"]


def form(given: Mapping[str, str], compiler: Compiler, meshes: Mapping[str, Mesh], T_link_body: Array) -> Form:
    """Return what a geom is; raises Fault with why it is nothing."""
    kind = given.get("type", "mesh" if "mesh" in given and "type" not in given else "sphere")
    T, size = placement(given, compiler), numbers(given, "size", 1, 3) or []
    if kind == "mesh":
        mesh = meshes.get(given.get("mesh", ""))
        if mesh is None:
            raise Fault(f"the mesh {quoted(given.get('mesh', ''))} has no file")
        return Form(kind, (), T_link_body @ T @ np.linalg.inv(mesh.T_file_mesh), mesh)
    if "mesh" in given:
        raise Fault(f"a {kind} that is fitted to a mesh")
    if (ends := numbers(given, "fromto", 6)) is not None:
        start, end = np.array(ends[:3]), np.array(ends[3:])
        T = transform((start + end) / 2.0, towards(start - end))
        across = size[:1] * (2 if kind in {"box", "ellipsoid"} else 1)
        size = [*across, float(np.linalg.norm(end - start)) / 2.0]
    if kind in _COUNTS and (len(size) < _COUNTS[kind] or min(size[: _COUNTS[kind]]) < 0.0):
        raise Fault(f"a {kind} of the size {size}")
    return Form(kind, tuple(size), T_link_body @ T)


_COUNTS = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}


def shapes(given: Mapping[str, str], form: Form) -> list[Shape]:
    """Return the shapes of a geom in its link, one for each role; raises Fault with why it has none."""
    kind, size, origin = form.kind, form.size, origin_of(form.T)
    values: tuple[float, ...]
    if form.mesh is not None:
        values = form.mesh.scale
    elif kind == "box":
        values = 2.0 * size[0], 2.0 * size[1], 2.0 * size[2]
    elif kind in {"capsule", "cylinder"}:
        values = size[0], 2.0 * size[1]
    elif kind == "sphere":
        values = (size[0],)
    else:
        raise Fault(f"a {kind}")
    file = None if form.mesh is None else form.mesh.file
    return [Shape(role, origin, kind, values, file) for role in roles(given)]  # type: ignore[arg-type]
