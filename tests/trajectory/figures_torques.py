"""Fastest motions under limits of torque against toppra on the same splines.

Run it with `python -m tests.trajectory.figures_torques`. The limits are a little above what the weight alone needs on
the path, so that they bind, with a payload on half of the paths. Pinocchio recomputes the torques between the nodes.
"""

import sys
import time
from dataclasses import dataclass

import numpy as np
import pinocchio as pin
import toppra

from gelenk.kinematics.dynamics.bodies import Load
from gelenk.kinematics.dynamics.mechanism import STANDARD_GRAVITY, mechanism
from gelenk.kinematics.dynamics.torques import torque_limits
from gelenk.robot.arrays import Array
from gelenk.trajectory.audit.torques import TorqueLimits
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import cubic_spline
from gelenk.trajectory.paths.path_geometry import geometry_of
from gelenk.trajectory.problem.problem import SegmentLimits
from gelenk.trajectory.timing.torque_constraints import optimal_within, torque_factor
from tests.robots import robot
from tests.trajectory.arms import Arm, arm

ARMS = ("panda", "ur5", "xarm7", "kinova", "talos_left_arm", "z1")
PATHS, POINTS, BETWEEN = 60, 1600, 7
INTERPOLATION = toppra.constraint.DiscretizationType.Interpolation


@dataclass(frozen=True)
class Case:
    """A spline through waypoints, with limits that its weight alone keeps."""

    path: PiecewisePolynomial
    velocity: Array
    acceleration: Array
    torque: TorqueLimits


def case(one: Arm, name: str, rng: np.random.Generator) -> Case:
    """Return a random spline through five waypoints, and limits of torque from 1.1 to 2 times its weight's torques."""
    found = mechanism(robot(name), one.chain)
    load = Load(rng.uniform(0.1, 1.0), rng.uniform(-0.1, 0.1, 3), np.zeros((3, 3))) if rng.random() < 0.5 else None
    knots = one.configurations(rng, 6, 0.5)
    path = cubic_spline(np.arange(6.0), knots, "not_a_knot").motion
    free = torque_limits(found, np.full(len(one.chain), np.inf), np.array(STANDARD_GRAVITY), load)
    q = path.at(np.linspace(0.0, path.duration, 400))
    weight = np.abs(free.parts(q, 0.0 * q, 0.0 * q)[1]).max(axis=0)
    most = weight * rng.uniform(1.1, 2.0) + 0.05 * weight.max()
    limits = torque_limits(found, most, np.array(STANDARD_GRAVITY), load)
    return Case(path, one.velocity, one.velocity * 10.0 ** rng.uniform(0.5, 1.0), limits)


def ours(one: Case) -> PiecewisePolynomial:
    """Plan as a trajectory does: rows, then a uniform factor."""
    free = np.full(len(one.velocity), np.inf)
    limits = SegmentLimits(one.velocity, one.acceleration, free, torque=one.torque)
    motion = optimal_within(geometry_of(None, one.path, limits)).motion
    return motion.scaled(torque_factor(motion, one.torque))


def theirs(one: Case, points: int = POINTS) -> float:
    """Return the duration by toppra, [s]."""
    v, a = (np.stack((-bound, bound), axis=1) for bound in (one.velocity, one.acceleration))
    limits = [
        toppra.constraint.JointVelocityConstraint(v),
        toppra.constraint.JointAccelerationConstraint(a, discretization_scheme=INTERPOLATION),
        toppra_torques(one.torque),
    ]
    knots = toppra.SplineInterpolator(one.path.breaks, one.path.at(one.path.breaks), "not-a-knot")
    grid = np.linspace(0.0, one.path.duration, points)
    speeds = toppra.algorithm.TOPPRA(limits, knots, gridpoints=grid).compute_parameterization(0.0, 0.0)[1]
    return float((2.0 * np.diff(grid) / (speeds[:-1] + speeds[1:])).sum())


def toppra_torques(limits: TorqueLimits) -> toppra.constraint.JointTorqueConstraint:
    """Return the limits as a constraint of toppra, which asks Pinocchio for the torques of one state at a time."""

    def torques(*state: Array) -> Array:
        (found,) = limits.recomputed(*(row[None] for row in state))
        return np.asarray(found)

    most = np.stack((-limits.most, limits.most), axis=1)
    return toppra.constraint.JointTorqueConstraint(
        torques, most, np.zeros(len(most)), discretization_scheme=INTERPOLATION
    )


def worst(one: Case, motion: PiecewisePolynomial) -> float:
    """Return the largest ratio of a torque to its limit, at places between the breaks, one-sided ends included."""
    shares = np.linspace(1e-9, 1.0 - 1e-9, BETWEEN)
    times = (motion.breaks[:-1, None] + np.diff(motion.breaks)[:, None] * shares).ravel()
    return float((np.abs(one.torque.recomputed(*motion.rates_at(times))) / one.torque.most).max())


def main(paths: int = PATHS) -> None:
    toppra.setup_logging("ERROR")
    rng = np.random.default_rng(28)
    ratios, peaks, seconds = [], [], []
    for i in range(paths):
        name = ARMS[i % len(ARMS)]
        one = case(arm(name), name, rng)
        began = time.perf_counter()
        motion = ours(one)
        seconds.append(time.perf_counter() - began)
        ratios.append(motion.duration / theirs(one))
        peaks.append(worst(one, motion))
    print(
        f"{paths} paths of {len(ARMS)} arms through 5 waypoints, Pinocchio {pin.__version__}, toppra at {POINTS} points"
    )
    print(f"duration over toppra's: median {np.median(ratios):.5f}, worst {max(ratios):.5f}")
    print(f"largest torque over its limit: {max(peaks):.6f}; violated on {sum(peak > 1.0 for peak in peaks)} paths")
    print(f"least of the largest ratios: {min(peaks):.4f}; planning: median {1e3 * np.median(seconds):.1f} ms")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
