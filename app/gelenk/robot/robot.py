"""A robot: its description, its chains, and its Pinocchio model, which only ever reads XML written by this package."""

import threading
from dataclasses import dataclass, replace
from functools import lru_cache, partial

import numpy as np
import pinocchio as pin

from gelenk.errors import FrameNotOnChain, UnknownFrame, UnsupportedJoint
from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain, build_chain, default_ends, frame_on_chain
from gelenk.robot.description import MOVABLE, Description, UrdfLimits
from gelenk.robot.urdf import write_urdf

_CHAINS_KEPT = 64
_FRAMES_KEPT = 1024


@dataclass(frozen=True, slots=True)
class Expansion:
    """Linear map from a chain's configuration to Pinocchio's: q = q₀ + M · configuration.

    `offset` is q₀, shape (nq,), `matrix` M: multipliers of all joints that the chain's variables move, shape (nq, n).
    """

    offset: Array
    matrix: Array


class RobotModel:
    """A description prepared for computation; threads can share it, but must hold `lock` while they use `data`.

    Each robot has one Pinocchio workspace `data`: it can be large, concurrent use gives wrong numbers, and because
    Pinocchio's calls hold the GIL, one for each thread would gain nothing. The default chain is base and tip where a
    call names none: the longest chain if omitted. It is built here, and raises as `build_chain` does.
    """

    def __init__(self, description: Description, default_chain: tuple[str, str] | None = None) -> None:
        self.description = description
        self.model = _pinocchio_model(description)
        self.default_chain = default_chain or default_ends(description)
        self._chain = lru_cache(_CHAINS_KEPT)(partial(build_chain, description))
        self.frame_on = lru_cache(_FRAMES_KEPT)(partial(frame_on_chain, description))
        self.frames_on = lru_cache(_CHAINS_KEPT)(self._frames_on)
        self.expansion = lru_cache(_CHAINS_KEPT)(self._expansion)
        self.data = self.model.createData()
        self.lock = threading.Lock()
        self._frame_ids = {name: self.model.getFrameId(_link(i)) for i, name in enumerate(description.frames)}
        self._joint_ids = {
            joint.name: self.model.getJointId(_joint(i))
            for i, joint in enumerate(description.joints)
            if joint.type in MOVABLE
        }
        self.chain(None, None)

    def chain(self, base_frame: str | None, tip_frame: str | None) -> Chain:
        """Return the chain between two frames, None standing for the default chain's; raises as `build_chain` does."""
        return self._chain(base_frame or self.default_chain[0], tip_frame or self.default_chain[1])

    def _frames_on(self, chain: Chain) -> tuple[str, ...]:
        """Return all frames whose pose in the base depends only on the chain's variables, in description order."""
        frames = []
        for frame in self.description.frames:
            try:
                self.frame_on(chain, frame)
            except (FrameNotOnChain, UnsupportedJoint):
                continue
            frames.append(frame)
        return tuple(frames)

    def frame_id(self, frame: str) -> int:
        """Return Pinocchio's index of a frame; raises UnknownFrame."""
        try:
            return int(self._frame_ids[frame])
        except KeyError:
            raise UnknownFrame(frame, self.description.frames) from None

    def position_index(self, joint: str) -> int:
        """Return where Pinocchio's configuration has the position of a movable joint."""
        return int(self.model.joints[self._joint_ids[joint]].idx_q)

    def _expansion(self, chain: Chain) -> Expansion:
        """Map a configuration of the chain to one of the whole model; other joints stay at zero."""
        offset = np.zeros(self.model.nq)
        matrix = np.zeros((self.model.nq, len(chain)))
        column = {name: i for i, name in enumerate(chain.joint_names)}
        for name, drive in self.description.drives.items():
            if drive.leader in column:
                row = self.position_index(name)
                offset[row] = drive.offset
                matrix[row, column[drive.leader]] = drive.multiplier
        return Expansion(offset, matrix)


def _link(i: int) -> str:
    return f"link_{i}"


def _joint(i: int) -> str:
    return f"joint_{i}"


def _pinocchio_model(description: Description) -> pin.Model:
    """Build Pinocchio's model of the same kinematics and inertias, under generated names.

    Continuous joints are written as revolute ones with very wide bounds, so that each joint has one number in q
    (Pinocchio gives a continuous one two). Mimic joints are written as independent joints because `Expansion` moves
    them: Pinocchio refuses leaders that come later or are continuous. Floating and planar joints are part of no chain
    and are written as fixed. Shapes are left out, so that no mesh file is opened.
    """
    wide = UrdfLimits(-1e9, 1e9, 1e9, 1e9)
    link_name = {link.name: _link(i) for i, link in enumerate(description.links)}
    links = tuple(replace(link, name=link_name[link.name], shapes=()) for link in description.links)
    joints = tuple(
        replace(
            joint,
            name=_joint(i),
            type=("prismatic" if joint.type == "prismatic" else "revolute") if joint.type in MOVABLE else "fixed",
            parent=link_name[joint.parent],
            child=link_name[joint.child],
            limits=wide,
            mimic=None,
        )
        for i, joint in enumerate(description.joints)
    )
    return pin.buildModelFromXML(write_urdf(Description("robot", links, joints)))
