"""Lagrange's equations of a URDF by differences of energies, the masses read from the XML text.

T comes from velocities of the links, which are differences of poses; M from T of unit velocities, g from differences
of U, and the Coriolis torques from d/dt ∂T/∂q̇ - ∂T/∂q. Joints that are not named stand at zero.
"""

from collections.abc import Sequence
from functools import partial
from xml.etree import ElementTree

import numpy as np
from scipy.spatial.transform import Rotation

from tests.oracles.differences import Array, aligned, along, derivatives, plain
from tests.oracles.urdf_product import UrdfProduct


class UrdfEnergy:
    """The energies of a robot as its description says, as functions of some of its joints.

    Args:
        text: The description.
        names: The joints, in the order of a configuration.
    """

    def __init__(self, text: str, names: Sequence[str]) -> None:
        self._product, self._names = UrdfProduct(text), tuple(names)
        self._masses = [
            (link.attrib["name"], *_inertial(link))
            for link in ElementTree.fromstring(text.encode()).findall("link")
            if link.find("inertial/mass") is not None and link.find("inertial/inertia") is not None
            if set(self._product.variables(link.attrib["name"])) & set(names)
        ]

    def potential(self, qs: Array, gravity: Array) -> Array:
        """U = -Σ m g₀ᵀ c; shape (N, n) → (N,), [J]."""
        centers = (mass * self._centers(link, T, qs)[:, :3, 3] for link, mass, T, _ in self._masses)
        return np.asarray(-sum(centers, np.zeros((len(qs), 3))) @ gravity)

    def gravity_torques(self, q: Array, gravity: Array) -> Array:
        """∂U/∂q; shape (n,), [N m or N]."""
        return np.array(derivatives(lambda qs: self.potential(qs, gravity), q, plain))

    def mass_matrix(self, q: Array) -> Array:
        """M, from T = ½ Σ (m v² + ωᵀ I ω); shape (n, n)."""
        M = np.zeros((len(q), len(q)))
        for link, mass, T, inertia in self._masses:
            twists = np.array(derivatives(partial(self._centers, link, T), q, aligned))
            R = self._centers(link, T, q[None])[0, :3, :3]
            v, w = twists[:, :3], twists[:, 3:]
            M += mass * v @ v.T + w @ R @ inertia @ R.T @ w.T
        return M

    def coriolis_torques(self, q: Array, speeds: Array) -> Array:
        """Ṁ q̇ - ∂T/∂q; shape (n,), [N m or N]."""
        rate = along(self._mass_matrices, q, speeds, plain)
        by_position = derivatives(lambda qs: speeds @ self._mass_matrices(qs) @ speeds / 2, q, plain)
        return np.asarray(rate @ speeds - np.array(by_position))

    def _mass_matrices(self, qs: Array) -> Array:
        return np.array([self.mass_matrix(q) for q in qs])

    def _centers(self, link: str, T_link_center: Array, qs: Array) -> Array:
        named = dict(zip(self._names, qs.T, strict=True))
        return np.asarray(self._product.poses(self._product.root, link, named) @ T_link_center)


def _inertial(link: ElementTree.Element) -> tuple[float, Array, Array]:
    """Mass [kg], the pose of the centre of mass in the link, and the inertia about it [kg m²]."""
    origin, mass, inertia = (link.find(f"inertial/{name}") for name in ("origin", "mass", "inertia"))
    assert mass is not None
    assert inertia is not None
    T = np.eye(4)
    if origin is not None:
        T[:3, 3] = [float(value) for value in origin.get("xyz", "0 0 0").split()]
        angles = [float(value) for value in origin.get("rpy", "0 0 0").split()]
        T[:3, :3] = Rotation.from_euler("xyz", angles).as_matrix()
    xx, xy, xz, yy, yz, zz = (float(inertia.attrib[f"i{key}"]) for key in ("xx", "xy", "xz", "yy", "yz", "zz"))
    return float(mass.attrib["value"]), T, np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
