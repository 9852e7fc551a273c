"""Joints of an MJCF model that follow others: what `equality` says of pairs of joints, where it is linear."""

from collections.abc import Mapping
from dataclasses import replace

from gelenk.errors import quoted
from gelenk.robot.description import MOVABLE, Joint, Mimic
from gelenk.robot.formats.mjcf.scope import Model, ModelScope, placed
from gelenk.robot.formats.mjcf.values import numbers
from gelenk.robot.formats.sources import Fault
from gelenk.robot.xml import Element


def mimicking(model: Model, joints: Mapping[str, Joint], refs: Mapping[str, float]) -> dict[str, Joint]:
    """Return the joints with their mimics; raises InvalidUrdf.

    `refs` are the positions of joints in which the bodies are drawn, [rad or m].
    """
    reader = _Equalities(model, joints, refs)
    for element, scope in model.equalities:
        with placed(element):
            reader.read(element, scope)
    return reader.joints


class _Equalities:
    def __init__(self, model: Model, joints: Mapping[str, Joint], refs: Mapping[str, float]) -> None:
        self.joints, self._refs, self._warn = dict(joints), refs, model.upload.warn

    def read(self, element: Element, scope: ModelScope) -> None:
        if element.tag != "joint":
            self._warn(element, f"equality of kind {quoted(element.tag)} is not read: it would close a loop")
            return
        given = scope.given(replace(element, tag="equality"))
        if given.get("active") == "false":
            return
        name, leader = given.get("joint1", ""), given.get("joint2")
        for joint in (name, leader):
            if joint is not None and joint not in self.joints:
                raise Fault(f"there is no joint {quoted(joint)}")
        constant, slope, *bends = [*(numbers(given, "polycoef", 1, 5) or [0.0, 1.0]), *[0.0] * 5][:5]
        if leader is None or any(bends):
            oddity = f"joint {quoted(name)} is a constant" if leader is None else "the equality is not linear"
            self._warn(element, f"{oddity}: it is not read, and the joint moves freely")
            return
        if self.joints[name].mimic is not None or self._follows(leader, name):
            self._warn(element, f"joint {quoted(name)} follows another one already: this equality is not read")
            return
        if self.joints[name].type not in MOVABLE or self.joints[leader].type not in MOVABLE:
            raise Fault("only hinge and slide joints can be equal")
        offset = constant + self._refs[name] - slope * self._refs[leader]
        self.joints[name] = replace(self.joints[name], mimic=Mimic(leader, slope, offset))

    def _follows(self, joint: str, leader: str) -> bool:
        """Return whether a joint is, or follows, another one."""
        while joint != leader and (mimic := self.joints[joint].mimic) is not None:
            joint = mimic.joint
        return joint == leader
