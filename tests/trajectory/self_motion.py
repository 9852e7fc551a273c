"""Whether any joint path leads an arm with one spare joint along a path of the tip, by walking its whole self-motion.

At each of many places on the path, Pinocchio's Jacobian leads along the self-motion in small steps, in both directions
from everything that was reached at the place before, as far as the joint limits or σ allow. What is reached at the last
place has a continuous path from the start: along the path, and at standstill along the self-motion.
"""

from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.robot.robot import RobotModel

_STEP = 0.1
_CELL = 0.07
_EXACT = 1e-5
_MOST = 600
"""Steps along the self-motion [rad], the grid on which places count as visited, errors, and configurations."""


@dataclass
class SelfMotion:
    """An arm with one more joint than its tip has directions, and the least σ at which it may be."""

    robot: RobotModel
    chain: Chain
    threshold: float

    def share(self, targets: list[pin.SE3], q: Array) -> float:
        """How much of a way through poses can be done from a configuration at the first, from 0 to 1."""
        reached = self._walked(targets[0], [q])
        for i, target in enumerate(targets[1:], start=1):
            reached = self._walked(target, reached)
            if not reached:
                return (i - 1) / (len(targets) - 1)
        return 1.0

    def _walked(self, target: pin.SE3, seeds: list[Array]) -> list[Array]:
        visited: dict[tuple[int, ...], Array] = {}
        for seed in seeds:
            q, spare = self._onto(target, seed)
            if q is None or _key(q) in visited:
                continue
            visited[_key(q)] = q
            for side in (spare, -spare):
                at, direction = q, side
                while len(visited) < _MOST:
                    after, along = self._onto(target, at + _STEP * direction)
                    if after is None or _key(after) in visited:
                        break
                    visited[_key(after)] = after
                    at, direction = after, along if along @ direction > 0.0 else -along
        return list(visited.values())

    def _onto(self, target: pin.SE3, q: Array) -> tuple[Array | None, Array]:
        """The configuration near another one at a pose, if allowed, and the unit vector along its self-motion."""
        model, data, chain = self.robot.model, self.robot.data, self.chain
        expansion = self.robot.expansion(chain)
        base, tip = (self.robot.frame_id(name) for name in (chain.base_frame, chain.tip_frame))
        for _ in range(8):
            full = expansion.offset + expansion.matrix @ q
            J = pin.computeFrameJacobian(model, data, full, tip, pin.LOCAL) @ expansion.matrix
            pin.framesForwardKinematics(model, data, full)
            error = pin.log6(data.oMf[tip].actInv(data.oMf[base].act(target))).vector
            left, sigmas, right = np.linalg.svd(J)
            if np.abs(error).max() < _EXACT:
                allowed = sigmas[-1] >= self.threshold and (q >= chain.lower).all() and (q <= chain.upper).all()
                return (q if allowed else None), right[-1]
            q = q + right[:6].T @ ((left.T @ error) / np.maximum(sigmas, 1e-3))
        return None, right[-1]


def _key(q: Array) -> tuple[int, ...]:
    return tuple(np.rint(q / _CELL).astype(int).tolist())
