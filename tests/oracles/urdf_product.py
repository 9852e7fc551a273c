"""Poses of a URDF's links by a product of transforms, read from the XML text by the standard library.

Rotations come from Rodrigues' formula, roll-pitch-yaw from three of them, and mimic joints are followed to the joint
that moves, however many lie between and wherever in the document they stand. Batches have one configuration a row.
"""

from collections.abc import Mapping
from typing import TypeAlias
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]

MOVABLE = {"revolute", "continuous", "prismatic"}


class UrdfProduct:
    """A robot as the text of its description says."""

    def __init__(self, text: str) -> None:
        root = ElementTree.fromstring(text.encode())
        self.links = [link.attrib["name"] for link in root.findall("link")]
        self._joints = {joint.attrib["name"]: joint for joint in root.findall("joint")}
        self._above = {_link(joint, "child"): joint for joint in self._joints.values()}
        parents = {_link(joint, "parent") for joint in self._joints.values()}
        self.root = next(name for name in self.links if name not in self._above)
        self.leaves = [name for name in self.links if name not in parents]

    def path(self, link: str) -> list[str]:
        """The joints from the root to a link."""
        if link not in self._above:
            return []
        joint = self._above[link]
        return [*self.path(_link(joint, "parent")), joint.attrib["name"]]

    def leader(self, joint: str) -> str:
        """The joint that moves this one: itself unless it mimics."""
        mimic = self._joints[joint].find("mimic")
        return joint if mimic is None else self.leader(mimic.attrib["joint"])

    def variables(self, link: str) -> list[str]:
        """The joints that move a link, each once, those further up first."""
        moving = [name for name in self.path(link) if self._joints[name].attrib["type"] in MOVABLE]
        return list(dict.fromkeys(self.leader(name) for name in moving))

    def poses(self, base: str, tip: str, q: Mapping[str, Array]) -> Array:
        """T_base_tip for joint positions by name, zero where none is given; shape (N, 4, 4)."""
        poses: Array = np.linalg.inv(self._from_root(base, q)) @ self._from_root(tip, q)
        return poses

    def _from_root(self, link: str, q: Mapping[str, Array]) -> Array:
        count = max((len(values) for values in q.values()), default=1)
        T = np.tile(np.eye(4), (count, 1, 1))
        for name in self.path(link):
            joint = self._joints[name]
            T = T @ _origin(joint) @ _motion(joint, np.broadcast_to(self._position(name, q), count))
        return T

    def _position(self, joint: str, q: Mapping[str, Array]) -> Array:
        mimic = self._joints[joint].find("mimic")
        if mimic is None:
            return q.get(joint, np.zeros(1))
        factor, offset = (float(mimic.get(key, default)) for key, default in (("multiplier", 1), ("offset", 0)))
        return factor * self._position(mimic.attrib["joint"], q) + offset


def _link(joint: ElementTree.Element, end: str) -> str:
    element = joint.find(end)
    assert element is not None
    return element.attrib["link"]


def _triple(element: ElementTree.Element | None, key: str, default: str) -> Array:
    return np.array((default if element is None else element.get(key, default)).split(), dtype=float)


def _origin(joint: ElementTree.Element) -> Array:
    origin = joint.find("origin")
    roll, pitch, yaw = _triple(origin, "rpy", "0 0 0")
    x, y, z = np.eye(3)
    turns = _turns(z, np.array([yaw])), _turns(y, np.array([pitch])), _turns(x, np.array([roll]))
    return _shifts(_triple(origin, "xyz", "0 0 0")[None]) @ turns[0] @ turns[1] @ turns[2]


def _motion(joint: ElementTree.Element, positions: Array) -> Array:
    if joint.attrib["type"] not in MOVABLE:
        return np.eye(4)
    axis = _triple(joint.find("axis"), "xyz", "1 0 0")
    axis /= np.linalg.norm(axis)
    return _shifts(positions[:, None] * axis) if joint.attrib["type"] == "prismatic" else _turns(axis, positions)


def _shifts(vectors: Array) -> Array:
    Ts = np.tile(np.eye(4), (len(vectors), 1, 1))
    Ts[:, :3, 3] = vectors
    return Ts


def _turns(axis: Array, angles: Array) -> Array:
    """Rodrigues' formula: R = I + sin θ [k]× + (1 - cos θ) [k]×²."""
    K = np.cross(np.eye(3), axis)
    Ts = np.tile(np.eye(4), (len(angles), 1, 1))
    Ts[:, :3, :3] += np.sin(angles)[:, None, None] * K + (1 - np.cos(angles))[:, None, None] * (K @ K)
    return Ts
