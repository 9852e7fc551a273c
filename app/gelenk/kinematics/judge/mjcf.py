"""Check of a robot written as MJCF: Pinocchio's own reader of that format against the description's model."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pinocchio as pin

from gelenk.kinematics.judge.judge import Differences
from gelenk.kinematics.judge.words import PoseCertificate
from gelenk.robot.arrays import Array
from gelenk.robot.description import Description
from gelenk.robot.formats.mjcf.writer import body_name
from gelenk.robot.notations import pose_errors
from gelenk.robot.robot import RobotModel

SAMPLES = 20
"""Number of configurations of the whole robot at which every link is compared."""
_REACH = 3.0
"""Largest distance of a position from the allowed one nearest to zero, [rad or m]."""


def certify_mjcf(robot: RobotModel, text: str, seed: int = 0) -> PoseCertificate:
    """Compare the poses of all links of a robot with those of its MJCF at random configurations; followers follow.

    Raises CertificationFailed if they differ by more than rounding.
    """
    description = robot.description
    with TemporaryDirectory() as folder:
        path = Path(folder) / "robot.xml"
        path.write_text(text, encoding="utf-8")
        model = pin.buildModelFromMJCF(path)
    data, ours = model.createData(), robot.model.createData()
    names = [link.name for link in description.links]
    bodies = [model.getFrameId(body_name(name), pin.FrameType.BODY) for name in names]
    frames = [robot.frame_id(name) for name in names]
    worst = Differences(max_position_error=0.0, max_orientation_error=0.0)
    for positions in _positions(description, seed):
        pin.framesForwardKinematics(model, data, _read(model, positions))
        pin.framesForwardKinematics(robot.model, ours, _expected(robot, positions))
        distance, angle, extent = pose_errors(*_stacked(data, bodies), *_stacked(ours, frames))
        worst.add("max_position_error", "a position", distance, extent)
        worst.add("max_orientation_error", "an orientation", angle, 1.0)
    return PoseCertificate(samples=SAMPLES, seed=seed, **worst)


def _positions(description: Description, seed: int) -> list[dict[str, float]]:
    """Draw positions of all movable joints, followers included, by joint name."""
    rng = np.random.default_rng(seed)
    drawn = []
    for _ in range(SAMPLES):
        free = {joint.name: _drawn(rng, joint.limits.lower, joint.limits.upper) for joint in description.movable}
        drives = description.drives.items()
        drawn.append({name: drive.multiplier * free[drive.leader] + drive.offset for name, drive in drives})
    return drawn


def _drawn(rng: np.random.Generator, lower: float | None, upper: float | None) -> float:
    low, high = -_REACH if lower is None else lower, _REACH if upper is None else upper
    near = min(max(0.0, low), high)
    return float(rng.uniform(max(low, near - _REACH), min(high, near + _REACH)))


def _read(model: pin.Model, positions: dict[str, float]) -> Array:
    q = np.array(pin.neutral(model))
    for name, position in positions.items():
        q[model.joints[model.getJointId(name)].idx_q] = position
    return q


def _expected(robot: RobotModel, positions: dict[str, float]) -> Array:
    q = np.array(pin.neutral(robot.model))
    for name, position in positions.items():
        q[robot.position_index(name)] = position
    return q


def _stacked(data: pin.Data, frames: list[int]) -> tuple[Array, Array]:
    poses = [data.oMf[frame] for frame in frames]
    return np.array([pose.translation for pose in poses]), np.array([pose.rotation for pose in poses])
