"""Masses, centres and inertias of an MJCF model's bodies: of their geoms, within the bounds that its compiler sets."""

from collections.abc import Mapping

import numpy as np

from gelenk.errors import InvalidMesh, counted
from gelenk.robot.arrays import Array
from gelenk.robot.description import Inertial, Origin
from gelenk.robot.formats.mjcf.solids import MassBody, primitive, shell_of, solid_within
from gelenk.robot.formats.mjcf.values import Compiler, Form, Mesh, numbers
from gelenk.robot.formats.sources import Fault, Sources

MAX_GEOMS = 2048
"""Largest number of geoms whose masses are counted."""
MAX_TRIANGLES = 1_000_000
"""Largest number of triangles of all meshes whose masses are computed."""
_FLAT = frozenset({"plane", "hfield"})
"""Geoms that have no volume in MuJoCo."""


class Masses:
    """Masses of geoms; meshes are named from file `around` of the sources."""

    def __init__(self, sources: Sources, around: str) -> None:
        self._sources, self._around, self._solids = sources, around, dict[int, MassBody]()
        self._geoms = self._count = 0

    @property
    def is_full(self) -> bool:
        """Whether no further geom is counted, which has been said."""
        return self._geoms > MAX_GEOMS

    def of(self, given: Mapping[str, str], form: Form, compiler: Compiler) -> MassBody | None:
        """Return the mass of a geom in its link, None if it has none; raises Fault with why it is not counted."""
        (group,) = numbers(given, "group", 1) or [0.0]
        mass, density = numbers(given, "mass", 1), numbers(given, "density", 1) or [1000.0]
        low, high = compiler.inertia_groups
        if form.kind in _FLAT or not low <= group <= high or (mass or density)[0] == 0.0:
            return None
        if (mass or density)[0] < 0.0:
            raise Fault("its mass is negative")
        self._geoms += 1
        if self._geoms > MAX_GEOMS:
            raise Fault(f"more than {MAX_GEOMS} geoms have one")
        if form.mesh is None:
            solid = primitive(form.kind, form.size, given.get("shellinertia") == "true")
        else:
            solid = self._solid(form.mesh)
        return solid.scaled(mass[0] / solid.mass if mass else density[0]).placed(form.T)

    def _solid(self, mesh: Mesh) -> MassBody:
        if id(mesh) not in self._solids:
            try:
                triangles = self._sources.triangles(self._sources.path(mesh.file, self._around)) * mesh.scale
                self._count += len(triangles)
                if self._count > MAX_TRIANGLES:
                    raise Fault(f"the meshes have more than {counted(MAX_TRIANGLES, 'triangle')}")
                if mesh.inertia == "convex":
                    triangles = self._sources.hull(triangles)
            except (InvalidMesh, ValueError) as error:
                raise Fault(str(error)) from error
            is_shell, is_exact = mesh.inertia == "shell", mesh.inertia != "legacy"
            self._solids[id(mesh)] = shell_of(triangles) if is_shell else solid_within(triangles, is_exact)
        return self._solids[id(mesh)]


def together(bodies: list[MassBody]) -> Inertial | None:
    """Return bodies as one, None without any."""
    if not bodies:
        return None
    mass = sum(body.mass for body in bodies)
    centre = sum((body.mass * body.centre for body in bodies), np.zeros(3)) / mass
    inertia = np.zeros((3, 3))
    for body in bodies:
        x = body.centre - centre
        inertia += body.inertia + body.mass * (x @ x * np.eye(3) - np.outer(x, x))
    at = (float(centre[0]), float(centre[1]), float(centre[2]))
    return Inertial(Origin(at), mass, _upper(inertia))


def bounded(inertial: Inertial | None, compiler: Compiler) -> Inertial | None:
    """Return what a body has within the bounds that the compiler sets, unchanged if it sets none."""
    if not (compiler.least_mass or compiler.least_inertia or compiler.balances):
        return inertial
    inertial = inertial or Inertial(Origin(), 0.0, (0.0,) * 6)
    xx, xy, xz, yy, yz, zz = inertial.inertia
    values, axes = np.linalg.eigh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    if values[0] < compiler.least_inertia:
        values = np.maximum(values, compiler.least_inertia)
    if compiler.balances and values[0] + values[1] < values[2]:
        values = np.full(3, values.mean())
    mass = max(inertial.mass, compiler.least_mass)
    return Inertial(inertial.origin, mass, _upper(axes @ np.diag(values) @ axes.T))


def scaled(inertial: Inertial, factor: float) -> Inertial:
    """Return an inertial that is so many times as heavy."""
    xx, xy, xz, yy, yz, zz = (factor * value for value in inertial.inertia)
    return Inertial(inertial.origin, factor * inertial.mass, (xx, xy, xz, yy, yz, zz))


def _upper(inertia: Array) -> tuple[float, float, float, float, float, float]:
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = inertia.tolist()
    return xx, xy, xz, yy, yz, zz
