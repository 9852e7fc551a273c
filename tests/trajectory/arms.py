"""Arms of the catalogue with limits to plan under, plain chains, and what a motion does, found by evaluating it."""

import math
from dataclasses import dataclass, replace

import numpy as np

from gelenk.robot.arrays import Array
from gelenk.robot.chain import Chain
from gelenk.trajectory.audit.words import Law
from gelenk.trajectory.joints.splines import JointSpline
from gelenk.trajectory.motion.polynomial import PiecewisePolynomial
from gelenk.trajectory.motion.splines import Boundary
from gelenk.trajectory.problem.problem import Segment, SegmentLimits
from tests.robots import robot

LAWS: tuple[Law, ...] = ("cubic", "quintic", "septic", "trapezoidal", "jerk_limited", "time_optimal")
BOUNDARIES: tuple[Boundary, ...] = ("clamped", "natural", "not_a_knot", "periodic", "assigned")
ARMS = ("panda", "ur5", "xarm7", "kinova", "puma560", "talos_left_arm")


@dataclass(frozen=True)
class Arm:
    """A chain, the velocities its description allows (2 rad/s where it says nothing), and where its joints can be."""

    chain: Chain
    velocity: Array
    lower: Array
    upper: Array

    def limits(self, rng: np.random.Generator) -> SegmentLimits:
        """Its velocities, and accelerations and jerks that go with them."""
        n = len(self.chain)
        acceleration = self.velocity * 10.0 ** rng.uniform(0.0, 1.0, n)
        return SegmentLimits(self.velocity, acceleration, acceleration * 10.0 ** rng.uniform(0.5, 1.7, n))

    def configurations(self, rng: np.random.Generator, count: int, share: float = 1.0) -> Array:
        """Anywhere within a share of the joints' ranges about their middles; shape (count, n)."""
        middle, half = 0.5 * (self.lower + self.upper), 0.5 * share * (self.upper - self.lower)
        return rng.uniform(middle - half, middle + half, (count, len(self.chain)))


def arm(name: str) -> Arm:
    one = robot(name)
    chain = one.chain(*one.default_chain)
    velocity = np.array([one.description.joint[joint].limits.velocity or 2.0 for joint in chain.joint_names])
    return Arm(chain, velocity, np.maximum(chain.lower, -np.pi), np.minimum(chain.upper, np.pi))


def limits(velocity: list[float], acceleration: list[float], jerk: float = 1e9) -> SegmentLimits:
    return SegmentLimits(np.array(velocity), np.array(acceleration), np.full(len(velocity), jerk))


def free(joints: int, lower: float = -math.inf, upper: float = math.inf) -> Chain:
    """A chain of some joints, all with the same range."""
    chain = arm("panda").chain
    names = tuple(f"joint_{j}" for j in range(joints))
    return replace(chain, joint_names=names, lower=np.full(joints, lower), upper=np.full(joints, upper))


SLOW = limits([1.0] * 2, [3.0] * 2, 20.0)
START = np.array([0.0, 0.5])
WAYPOINTS = np.array([[0.6, 0.1], [0.2, -0.4], [1.0, 0.3]])


def through(law: Law = "trapezoidal", bound: SegmentLimits = SLOW, **kept: object) -> Segment:
    segment = Segment("spline", law, bound, configurations=WAYPOINTS)
    return replace(segment, **kept)  # type: ignore[arg-type]


def spline_motion(start: Array, segment: Segment, chain: Chain) -> PiecewisePolynomial:
    return JointSpline.of(start, segment, chain).motion()


def excess(motion: PiecewisePolynomial, limits: SegmentLimits, *, jerk: bool, per_piece: int = 40) -> float:
    """By how much limits are passed on a grid of each piece, in fractions of them, at most; negative where none is."""
    shares = np.linspace(0.0, 1.0, per_piece)
    lengths = np.diff(motion.breaks)
    worst = -1.0
    for order, bound in ((1, limits.velocity), (2, limits.acceleration), (3, limits.jerk))[: 3 if jerk else 2]:
        c = motion.coefficients
        for _ in range(order):
            c = c[:, 1:] * np.arange(1, c.shape[1])[:, None]
        if c.shape[1] == 0:
            continue
        dts = lengths[:, None] * shares
        values = np.einsum("mkj,mpk->mpj", c, dts[:, :, None] ** np.arange(c.shape[1]))
        worst = max(worst, float((np.abs(values) / bound).max()) - 1.0)
    return worst


def jump(motion: PiecewisePolynomial, order: int) -> float:
    """The largest jump of a derivative where pieces meet, relative to 1 or its largest value."""
    derivative = motion.derivative(order) if order else motion
    c = derivative.coefficients
    powers = np.diff(derivative.breaks)[:, None] ** np.arange(c.shape[1])
    ends = np.einsum("mk,mkj->mj", powers, c)
    scale = max(1.0, float(np.abs(ends).max(initial=0.0)))
    return float(np.abs(ends[:-1] - c[1:, 0]).max(initial=0.0)) / scale


def end_state(motion: PiecewisePolynomial, order: int, *, last: bool) -> Array:
    """A derivative at one end; shape (n,)."""
    derivative = motion.derivative(order) if order else motion
    c = derivative.coefficients[-1 if last else 0]
    dt = float(motion.breaks[-1] - motion.breaks[-2]) if last else 0.0
    value: Array = dt ** np.arange(len(c)) @ c
    return value
