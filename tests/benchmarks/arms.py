"""The arms on which inverse kinematics is measured, and the targets that they are given.

A target is the pose of a random configuration within the limits, so each can be reached. Pinocchio computes it.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, rotation_to_axis
from gelenk.robot.description import Description, Joint, Link
from gelenk.robot.notations import origin_of, placement
from gelenk.robot.poses import inverse, transform
from tests.robots import robot

BASE, TIP = "base", "tip"
"""Ends of an arm that stands alone."""


class Arm(NamedTuple):
    """A chain of a robot of the catalogue, straight down its tree and without mimic joints."""

    robot: str
    base_frame: str
    tip_frame: str

    @property
    def chain(self) -> Chain:
        """The chain."""
        return robot(self.robot).chain(self.base_frame, self.tip_frame)


class Targets(NamedTuple):
    """What all solvers of an arm are asked.

    Attributes:
        Ts: Poses of the tip in the base; shape (N, 4, 4).
        seed: Where each search starts, the middle of the range; shape (n,).
    """

    Ts: Array
    seed: Array


ARMS = (
    Arm("so100", "base", "gripper"),
    Arm("so101", "base_link", "gripper_frame_link"),
    Arm("anthropomorphic_wrist", "base", "tool"),
    Arm("centauro", "torso_2", "ball2_tip"),
    Arm("kinova", "j2s6s200_link_base", "j2s6s200_end_effector"),
    Arm("puma560", "base", "tool"),
    Arm("stanford", "base", "tool"),
    Arm("ur5", "base_link", "tool0"),
    Arm("ur10", "base_link", "tool0"),
    Arm("z1", "link00", "gripperStator"),
    Arm("baxter", "base", "right_gripper"),
    Arm("g1", "torso_link", "right_rubber_hand"),
    Arm("icub", "chest", "r_gripper"),
    Arm("panda", "panda_link0", "panda_hand_tcp"),
    Arm("pr2", "torso_lift_link", "r_gripper_tool_frame"),
    Arm("talos", "torso_2_link", "gripper_right_base_link"),
    Arm("tiago_pro", "torso_lift_link", "arm_right_tool_link"),
    Arm("xarm7", "link_base", "link_eef"),
    Arm("human", "middle_thorax", "right_hand"),
    Arm("tiago", "base_footprint", "arm_tool_link"),
)
"""By the number of joints, from 5 to 8."""


def draw(arm: Arm, count: int) -> Targets:
    """Poses of random configurations, the same in every run; a joint without limits is drawn from ±π."""
    lower = np.where(np.isinf(arm.chain.lower), -np.pi, arm.chain.lower)
    upper = np.where(np.isinf(arm.chain.upper), np.pi, arm.chain.upper)
    qs = np.random.default_rng(1).uniform(lower, upper, (count, len(arm.chain)))
    return Targets(poses(arm, qs), (lower + upper) / 2)


def poses(arm: Arm, qs: Array) -> Array:
    """Poses of the tip in the base as Pinocchio has them; shape (N, n) → (N, 4, 4)."""
    machine = robot(arm.robot)
    model, data, expansion = machine.model, machine.data, machine.expansion(arm.chain)
    base, tip = machine.frame_id(arm.base_frame), machine.frame_id(arm.tip_frame)
    Ts = np.empty((len(qs), 4, 4))
    for i, q in enumerate(qs):
        pin.framesForwardKinematics(model, data, expansion.offset + expansion.matrix @ q)
        Ts[i] = data.oMf[base].actInv(data.oMf[tip]).homogeneous
    return Ts


def alone(arm: Arm) -> Description:
    """The arm as a robot of its own: n joints about or along their z axes, then one fixed placement of the tip.

    Every solver gets this same short chain: what else there is in a robot costs none of them time, nor trips one.
    """
    T = np.eye(4)
    links = [Link(BASE)]
    joints = []
    for joint in way_down(arm):
        T = T @ placement(joint.origin.xyz, joint.origin.rpy)
        if joint.type == "fixed":
            continue
        to_axis = transform(np.zeros(3), rotation_to_axis(joint.axis))
        links.append(Link(f"link_{len(links)}"))
        parent, child = links[-2].name, links[-1].name
        origin = origin_of(T @ to_axis)
        joints.append(replace(joint, parent=parent, child=child, origin=origin, axis=(0.0, 0.0, 1.0)))
        T = inverse(to_axis)
    joints.append(Joint(f"to_{TIP}", "fixed", links[-1].name, TIP, origin_of(T)))
    return Description(arm.robot, (*links, Link(TIP)), tuple(joints))


def way_down(arm: Arm) -> Iterator[Joint]:
    """The joints from the base to the tip."""
    upwards = []
    for joint in robot(arm.robot).description.path_to_root(arm.tip_frame):
        upwards.append(joint)
        if joint.parent == arm.base_frame:
            return reversed(upwards)
    raise ValueError(f"{arm.base_frame} is not above {arm.tip_frame}")
